/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Markup of labels: symbols, subscripts and powers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmocka.h>

#include "beadreel/view.h"
#include "render/draw/markup.h"
#include "tests/missing.h"
#include "tests/torture/fail_alloc.h"

static void test_markup(void **state)
{
    (void)state;
    static const struct {
        const char *text, *has, *lacks;
    } cases[] = {{"F_0", ">0<", "F_"},
                 {"10^{-3}", ">-3<", "{"},
                 {"*x*", "<i>x</i>", "*"},
                 {"2 * 3 * 4", "2 * 3 * 4", "<i>"},
                 {"a<b & c", "a&lt;b &amp; c", NULL},
                 {"chain\\_1", "chain_1", "<"},
                 {"*no star\\*", "*no star*", "<"},
                 {"α_β^γ", ">β<", "α_"},
                 {"*t* = 8.98", "\u00a0=\u00a08.98", " = "},
                 {"open {", "open {", NULL},
                 {"end_", "end_", NULL},
                 {"$F \\propto \\delta^{3/2}$", "<i>F</i> ∝ <i>δ</i><", "$"},
                 {"$\\frac{m}{2}v_0$", "\u2044", "frac"},
                 {"costs $5 each", "$5 each", "<"},
                 {"\\$5 or $6", "$5 or $6", "<"},
                 {"*F*_{max, *N*}", "<i>N</i>", "{"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char out[1024];
        assert_true(bead_markup_size(cases[i].text) <= sizeof out);
        bead_markup(cases[i].text, out, bead_markup_size(cases[i].text));
        if (!strstr(out, cases[i].has) || (cases[i].lacks && strstr(out, cases[i].lacks)))
            fail_msg("'%s' becomes '%s'", cases[i].text, out);
    }
    char quoted[64], out[512], small[4];
    static const char dense[] = "$a_b^c\\xi$";
    bead_markup(dense, out, bead_markup_size(dense)); /* the promised room is enough */
    assert_non_null(strstr(out, "<i>ξ</i>"));
    bead_markup_plain("$F_0 \\sim \\delta$ & *x*<sup>2</sup> = <b>3</b>", out, sizeof out);
    assert_string_equal(out, "F0 ∼ δ & x2 = 3");
    bead_markup_quote("a_b^c*d*\\{e}<b>f</b>", quoted, sizeof quoted);
    bead_markup(quoted, out, sizeof out);
    assert_string_equal(out, "a_b^c*d*\\{e}&lt;b&gt;f&lt;/b&gt;");
    bead_markup_symbols("u\u209c + 6 u u\u2093 of a mode at x; *M*, F_m here", out, sizeof out);
    assert_string_equal(out, "*u*_{*t*} + 6 *u* *u*_{*x*} of a mode at *x*; *M*, *F*_m here");
    bead_markup_symbols("u\u2093\u2093\u2093 and N\u2081", out, sizeof out); /* tight: one subscript, numbers upright */
    assert_string_equal(out, "*u*_{*xxx*} and *N*_{1}");
    bead_markup_symbols("t (\u00b5s) at 20 \u00b0C, s \u03a9", out, sizeof out); /* parts of units */
    assert_string_equal(out, "*t* (\u00b5s) at 20 \u00b0C, *s* \u03a9");
    bead_markup("*long*", small, sizeof small); /* no room: unchanged, cut */
    assert_string_equal(small, "*lo");
}

/* Each argument is there once, where TeX has it: in braces, a command, or one character. */
static void arguments_are_whole(void **state)
{
    (void)state;
    static const char *const cases[][2] = {{"$\\frac{m}{2}v_0$", "m⁄2v0"},   {"$\\frac12x$", "1⁄2x"},
                                           {"$\\frac\\alpha\\beta$", "α⁄β"}, {"$\\frac{x_{max}}{\\delta^2}y$", "xmax⁄δ2y"},
                                           {"$x^{3/2}_n$", "x3/2n"},         {"$\\sqrt{ab}c$", "√(ab)c"}, /* not √a bc */
                                           {"$\\sqrt{x}y$", "√xy"},          {"$\\sqrt\\rho$", "√ρ"},
                                           {"$v_{\\mathrm{max}}$", "vmax"},  {"$E_\\text{at rest}$", "Eat rest"},
                                           {"$\\frac{}{2}$", "⁄2"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[512];
        bead_markup_plain(cases[i][0], out, sizeof out);
        assert_string_equal(out, cases[i][1]);
    }
}

#define DOWN   "<span baseline_shift=\"subscript\" size=\"72%\">"
#define UP     "<span baseline_shift=\"superscript\" size=\"72%\">"
#define END    "</span>"
#define SYMBOL "<span face=\"STIX\"><i>"
#define BACK   "</i></span>"
#define MATH   "<span face=\"STIX\">"

/* Each mark at the beginning, at the end, beside spaces, open, quoted, within others: as it is written. */
static void marks_become_spans(void **)
{
    static const char *const cases[][2] = {
        {"", ""},
        {"F_0x", "F" DOWN "0" END "x"},
        {"_a^b", DOWN "a" END UP "b" END},
        {"a_ b^ c", "a_ b^ c"},
        {"a_", "a_"},
        {"^", "^"},
        {"x_{ab}c", "x" DOWN "ab" END "c"},
        {"x_{a{b}c}d", "x" DOWN "a{b}c" END "d"},
        {"x_{a\\}b}c", "x" DOWN "a}b" END "c"},
        {"x_{ab", "x" DOWN "{" END "ab"},
        {"x_{}y", "x" DOWN END "y"},
        {"x^\\_y", "x" UP "_" END "y"},
        {"x_*ab*c", "x" DOWN SYMBOL "ab" BACK END "c"},
        {"x_*ab c", "x" DOWN "*" END "ab c"},
        {"x_{*i*^2}", "x" DOWN SYMBOL "i" BACK UP "2" END END},
        {"x_αβ", "x" DOWN "α" END "β"},
        {"x_\\αβ", "x" DOWN "α" END "β"},
        {"*a*b*c*", SYMBOL "a" BACK "b" SYMBOL "c" BACK},
        {"*a b*", SYMBOL "a b" BACK},
        {"* a*", "* a*"},
        {"*a *b", "*a *b"},
        {"*a *b*", SYMBOL "a *b" BACK},
        {"**", "**"},
        {"***", SYMBOL "*" BACK},
        {"*a\\*b*", SYMBOL "a*b" BACK},
        {"*x_i*", SYMBOL "x" DOWN "i" END BACK},
        {"a\\*b\\", "a*b\\"},
        {"\\\\", "\\"},
        {"a = b", "a\u00a0=\u00a0b"},
        {"a=b", "a=b"},
        {"a =b= c", "a\u00a0=b=\u00a0c"},
        {"a <& >b", "a &lt;&amp; &gt;b"},
        {"{a}", "{a}"},
        {"<b>a</b>c", "<b>a</b>c"},
        {"<i>a</i><u>b</u><s>c</s>", "<i>a</i><u>b</u><s>c</s>"},
        {"H<sub>2</sub>O, 10<sup>-3</sup>", "H" DOWN "2" END "O, 10" UP "-3" END},
        {"<b><i>a</i> *x*_0 & b</b>", "<b><i>a</i> " SYMBOL "x" BACK DOWN "0" END " &amp; b</b>"},
        {"<b>a<b>c</b>d</b>e", "<b>a<b>c</b>d</b>e"},
        {"<b>a<i>c</b>d</i>", "<b>a&lt;i&gt;c</b>d&lt;/i&gt;"},
        {"<b>a", "&lt;b&gt;a"},
        {"a</b>", "a&lt;/b&gt;"},
        {"\\<b>a</b>", "&lt;b&gt;a&lt;/b&gt;"},
        {"<b>a\\</b>b</b>", "<b>a&lt;/b&gt;b</b>"},
        {"<B>a</B><big>b</big>", "&lt;B&gt;a&lt;/B&gt;&lt;big&gt;b&lt;/big&gt;"},
        {"<span face='x'>a</span>", "&lt;span face='x'&gt;a&lt;/span&gt;"},
        {"<b></b>", "<b></b>"},
        {"*a<b>x</b>*", SYMBOL "a<b>x</b>" BACK},
        {"$x$", MATH "<i>x</i>" END},
        {"$ab1$c", MATH "<i>ab</i>1" END "c"},
        {"$ x$", "$ x$"},
        {"$x $y", "$x $y"},
        {"$x $y$", MATH "<i>x</i> $<i>y</i>" END},
        {"$$", "$$"},
        {"$a\\$b$", MATH "<i>a</i>$<i>b</i>" END},
        {"$x_1y^{2n}$", MATH "<i>x</i>" DOWN "1" END "<i>y</i>" UP "2<i>n</i>" END END},
        {"$x_$", MATH "<i>x</i>_" END},
        {"${a}}b$", MATH "<i>a</i><i>b</i>" END},
        {"$\\delta x$", MATH "<i>δ</i><i>x</i>" END},
        {"$\\delta$", MATH "<i>δ</i>" END},
        {"$\\delta  x$", MATH "<i>δ</i> <i>x</i>" END},
        {"$a \\times b$", MATH "<i>a</i> × <i>b</i>" END},
        {"$a\\,b$", MATH "<i>a</i>\u2009<i>b</i>" END},
        {"$\\unknown1$", MATH "unknown1" END},
        {"$\\del\\deltas$", MATH "deldeltas" END},
        {"$\\{a\\}$", MATH "{<i>a</i>}" END},
        {"$x_\\mu y$", MATH "<i>x</i>" DOWN "<i>μ</i>" END " <i>y</i>" END},
        {"$x_{a_b}c$", MATH "<i>x</i>" DOWN "<i>a</i>" DOWN "<i>b</i>" END END "<i>c</i>" END},
        {"$\\frac{a}{b}c$", MATH UP "<i>a</i>" END "\u2044" DOWN "<i>b</i>" END "<i>c</i>" END},
        {"$\\frac ab$", MATH UP " " END "\u2044" DOWN "<i>a</i>" END "<i>b</i>" END},
        {"$\\frac$", MATH UP END "\u2044" DOWN END END},
        {"$\\fraction$", MATH "fraction" END},
        {"$x^\\frac{a}{b}c$", MATH "<i>x</i>" UP UP "<i>a</i>" END "\u2044" DOWN "<i>b</i>" END END "<i>c</i>" END},
        {"$v_\\mathrm{ab}$", MATH "<i>v</i>" DOWN "ab" END END},
        {"$\\sqrt{E/\\rho}$", MATH "√(<i>E</i>/<i>ρ</i>)" END},
        {"$m\\ddot{u}_n$", MATH "<i>m</i><i>u\u0308</i>" DOWN "<i>n</i>" END END},
        {"$\\dot\\delta$", MATH "<i>δ\u0307</i>" END},
        {"$\\bar{2}$", MATH "2\u0304" END},
        {"$\\vec$", MATH "\u20d7" END},
        {"$\\left(a-1\\right)\\leq b$", MATH "(<i>a</i>\u22121)≤ <i>b</i>" END},
        {"$F = 1$", MATH "<i>F</i>\u00a0=\u00a01" END}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[1024], plain[64];
        const size_t needed = strlen(cases[i][1]) + 1;
        assert_true(needed <= bead_markup_size(cases[i][0]));
        bead_markup(cases[i][0], out, bead_markup_size(cases[i][0]));
        if (strcmp(out, cases[i][1]) != 0)
            fail_msg("'%s' becomes '%s', not '%s'", cases[i][0], out, cases[i][1]);
        bead_text_escape(cases[i][0], plain, sizeof plain);
        for (size_t size = 0; size <= needed; size++) { /* all of it, or the unchanged text, as far as there is room */
            memset(out, '#', sizeof out);
            bead_markup(cases[i][0], out, size);
            assert_true(out[size] == '#' && (size == 0 || strlen(out) < size));
            if (size == needed)
                assert_string_equal(out, cases[i][1]);
            else if (size > 0)
                assert_true(strncmp(out, plain, strlen(out)) == 0 && (size <= strlen(plain) || strcmp(out, plain) == 0));
        }
    }
}

/* Single letters, with subscript characters after them; letters of words, units, numbers and marked text do not count. */
static void symbols_are_single_letters(void **)
{
    static const char *const cases[][2] = {{"x", "*x*"},
                                           {"xy", "xy"},
                                           {"a x", "a *x*"},
                                           {"x a", "*x* *a*"},
                                           {"a", "*a*"},
                                           {"2x", "2x"},
                                           {"9z 0A", "9z 0A"},
                                           {"x2", "*x*2"},
                                           {"*x*", "*x*"},
                                           {"_x^y{z\\q", "_x^y{z\\q"},
                                           {"(x)", "(*x*)"},
                                           {"é x", "é *x*"},
                                           {"éx xé", "éx xé"},
                                           {"A\u2080", "*A*_{0}"},
                                           {"A\u2089Z", "*A*_{9}*Z*"},
                                           {"u\u2090\u2081\u2093", "*u*_{*a*1*x*}"},
                                           {"u\u208a\u208b\u208c\u208d\u208e", "*u*_{+-=()}"},
                                           {"u\u209c", "*u*_{*t*}"},
                                           {"u\u209d", "*u*\u209d"},
                                           {"5 \u00b0C", "5 \u00b0C"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[128];
        bead_markup_symbols(cases[i][0], out, sizeof out);
        if (strcmp(out, cases[i][1]) != 0)
            fail_msg("'%s' becomes '%s', not '%s'", cases[i][0], out, cases[i][1]);
        for (size_t size = 0; size <= strlen(cases[i][1]) + 1; size++) {
            memset(out, '#', sizeof out);
            bead_markup_symbols(cases[i][0], out, size);
            assert_true(out[size] == '#' && (size == 0 || (strlen(out) < size && strncmp(out, cases[i][1], strlen(out)) == 0)));
        }
    }
}

static void write_plain(const char *text, char *out, size_t size)
{
    assert_true(bead_markup_plain(text, out, size));
}

/* Quoted, escaped and plain texts are cut between characters, and end within their room. */
static void texts_are_cut_between_characters(void **)
{
    static const char *const quoted[][2] = {{"a_b", "a\\_b"}, {"^*\\{}$", "\\^\\*\\\\\\{\\}\\$"}, {"αβ", "αβ"}, {"", ""}};
    static const char *const escaped[][2] = {
        {"a<b>&c", "a&lt;b&gt;&amp;c"}, {"tab\there", "tab here"}, {"\xffx\xc3", "?x?"}, {"αβ", "αβ"}};
    static const char *const plain[][2] = {{"*x* = 1", "x = 1"}, {"$\\delta_0$ & <b>", "δ0 & <b>"}, {"αβγ", "αβγ"}};
    char out[64];
    for (int kind = 0; kind < 3; kind++) {
        const size_t count = kind == 2 ? 3 : 4;
        void (*const write)(const char *, char *, size_t) = kind == 0   ? bead_markup_quote
                                                            : kind == 1 ? bead_text_escape
                                                                        : write_plain;
        for (size_t i = 0; i < count; i++) {
            const char *const *row = kind == 0 ? quoted[i] : kind == 1 ? escaped[i] : plain[i];
            size_t last = 0;
            for (size_t size = 0; size <= strlen(row[1]) + 1; size++) {
                memset(out, '#', sizeof out);
                write(row[0], out, size);
                assert_true(out[size] == '#');
                if (size == 0)
                    continue;
                assert_true(strlen(out) < size && strlen(out) >= last && strncmp(out, row[1], strlen(out)) == 0);
                assert_true(((unsigned char)row[1][strlen(out)] & 0xC0) != 0x80 && size - strlen(out) <= 6);
                last = strlen(out);
            }
            assert_string_equal(out, row[1]);
        }
    }
}

/* The first `length` bytes of a text, before a page that cannot be read. */
static const char *at_edge(char *pages, size_t page, const char *text, size_t length)
{
    char *at = pages + page - length - 1;
    memcpy(at, text, length);
    at[length] = '\0';
    return at;
}

/* However a text is cut, between any two bytes, nothing behind its end is read. */
static void texts_end_anywhere(void **)
{
    static const char *const texts[] = {
        "a\\*b*c_{d\\}e}^\\{ \\", "$x_{a\\_b}^\\frac{\\dot{u}}\\sqrt\\rho \\left( \\mathrm{m\\a} \\$ \\unknown$ = *i\\",
        "<b>a\\</b><sub>*x*_0</sub> & <i>c</i>\\ = \u03b1\u03b2_\u03b1\u2080\u0304", "{_{^{*\\*_\\}$\\"};
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(pages != MAP_FAILED && mprotect(pages + page, page, PROT_NONE) == 0);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        for (size_t length = 0; length <= strlen(texts[i]); length++) {
            for (size_t from = 0; from <= length; from++) {
                char out[2048];
                const char *text = at_edge(pages, page, texts[i] + from, length - from);
                bead_markup(text, out, bead_markup_size(text));
                assert_true(strlen(out) < bead_markup_size(text));
                bead_markup_symbols(text, out, sizeof out);
                bead_markup_quote(text, out, sizeof out);
                bead_text_escape(text, out, sizeof out);
            }
        }
    }
    assert_int_equal(munmap(pages, 2 * page), 0);
}

/* Where memory is short, no marks are taken for words. */
static void plain_text_needs_memory(void **)
{
#ifdef FAIL_ALLOC_SANITIZED
    skip_without("a build without sanitizers");
#endif
    char out[16] = "";
    long kept;
    fail_alloc_begin(1);
    const bool made = bead_markup_plain("*F*_{max}", out, sizeof out);
    assert_true(fail_alloc_end(&kept) > 0 && kept == 0);
    assert_false(made);
    assert_string_equal(out, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_markup),
        cmocka_unit_test(arguments_are_whole),
        cmocka_unit_test(marks_become_spans),
        cmocka_unit_test(symbols_are_single_letters),
        cmocka_unit_test(texts_are_cut_between_characters),
        cmocka_unit_test(texts_end_anywhere),
        cmocka_unit_test(plain_text_needs_memory),
    };
    return cmocka_run_group_tests_name("markup", tests, NULL, NULL);
}
