/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Markup of labels: what becomes of symbols, subscripts and powers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/markup.h"

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
    bead_markup_plain("$F_0 \\sim \\delta$ & *x*^2 = 3", out, sizeof out);
    assert_string_equal(out, "F0 ∼ δ & x2 = 3");
    bead_markup_quote("a_b^c*d*\\{e}", quoted, sizeof quoted);
    bead_markup(quoted, out, sizeof out);
    assert_string_equal(out, "a_b^c*d*\\{e}");
    bead_markup_symbols("u\u209c + 6 u u\u2093 of a mode at x; *M*, F_m here", out, sizeof out);
    assert_string_equal(out, "*u*_{*t*} + 6 *u* *u*_{*x*} of a mode at *x*; *M*, *F*_m here");
    bead_markup_symbols("u\u2093\u2093\u2093 and N\u2081", out, sizeof out); /* tight: one subscript, numbers upright */
    assert_string_equal(out, "*u*_{*xxx*} and *N*_{1}");
    bead_markup_symbols("t (\u00b5s) at 20 \u00b0C, s \u03a9", out, sizeof out); /* parts of units */
    assert_string_equal(out, "*t* (\u00b5s) at 20 \u00b0C, *s* \u03a9");
    bead_markup("*long*", small, sizeof small); /* no room: as it stands, cut */
    assert_string_equal(small, "*lo");
}

/* Each argument is there once, where TeX has it: in braces, a command, or one character. */
static void arguments_are_whole(void **state)
{
    (void)state;
    static const char *const cases[][2] = {{"$\\frac{m}{2}v_0$", "m⁄2v0"},   {"$\\frac12x$", "1⁄2x"},
                                           {"$\\frac\\alpha\\beta$", "α⁄β"}, {"$\\frac{x_{max}}{\\delta^2}y$", "xmax⁄δ2y"},
                                           {"$x^{3/2}_n$", "x3/2n"},         {"$\\sqrt{ab}c$", "√abc"},
                                           {"$\\frac{}{2}$", "⁄2"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[512];
        bead_markup_plain(cases[i][0], out, sizeof out);
        assert_string_equal(out, cases[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_markup),
        cmocka_unit_test(arguments_are_whole),
    };
    return cmocka_run_group_tests_name("markup", tests, NULL, NULL);
}
