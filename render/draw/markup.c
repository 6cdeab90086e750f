/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns the texts of figures into Pango markup: subscripts, superscripts, symbols in italics. */
#include "render/draw/markup.h"

#include <glib.h>
#include <pango/pango.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/axis.h"
#include "sim/base/memory.h"

static const char italics[] = "<span face=\"STIX\"><i>", upright[] = "</i></span>";
/* Pango's <sub> is too small to read in 8 pt. */
static const char lower[] = "<span baseline_shift=\"subscript\" size=\"72%\">",
                  higher[] = "<span baseline_shift=\"superscript\" size=\"72%\">";

void bead_text_magnetism(double magnetism, char *out, size_t size)
{
    snprintf(out, size, BEAD_SYMBOL("M") " = %.3g", magnetism);
}

struct writer {
    char *out;
    size_t size, used;
    bool full;
};

static void put_bytes(struct writer *w, const char *text, size_t length)
{
    w->full = w->full || w->used + length >= w->size;
    if (w->full)
        return;
    memcpy(w->out + w->used, text, length);
    w->used += length;
    w->out[w->used] = '\0';
}

static void markup_put(struct writer *w, const char *text)
{
    put_bytes(w, text, strlen(text));
}

/* Bytes of the character at `text`; 1 for a byte of broken UTF-8. */
static size_t character(const char *text)
{
    size_t length = 1;
    while (((unsigned char)text[length] & 0xC0) == 0x80)
        length++;
    return length;
}

/* Writes one character and returns the rest. Lines do not break beside an equals sign. */
static const char *put_character(struct writer *w, const char *text)
{
    static const char fixed_space[] = "\u00a0";
    char plain[8] = "", escaped[16];
    size_t length = character(text);
    if (text[0] == ' ' && text[1] == '=') {
        markup_put(w, fixed_space);
        return text + 1;
    }
    if (text[0] == '=' && text[1] == ' ') {
        markup_put(w, "=");
        markup_put(w, fixed_space);
        return text + 2;
    }
    memcpy(plain, text, length < sizeof plain ? length : sizeof plain - 1);
    bead_text_escape(plain, escaped, sizeof escaped);
    markup_put(w, escaped);
    return text + length;
}

/* The bracket that closes the one before `text`, or NULL. */
static const char *markup_closing(const char *text, const char *end)
{
    int depth = 1;
    for (; text < end; text += character(text)) {
        if (*text == '\\' && text + 1 < end)
            text++;
        else if (*text == '{')
            depth++;
        else if (*text == '}' && --depth == 0)
            return text;
    }
    return NULL;
}

/* The star that ends italics, or NULL. Italics begin and end next to a character other than a space. */
static const char *star(const char *text, const char *end)
{
    for (const char *c = text; c < end && *text != ' '; c += character(c)) {
        if (*c == '\\' && c + 1 < end)
            c++;
        else if (*c == '*' && c > text && c[-1] != ' ')
            return c;
    }
    return NULL;
}

/* ---- a little TeX ---- */

struct sign {
    const char *name, *sign;
};
static const struct sign letters[] = {
    {"alpha", "α"},  {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"},      {"epsilon", "ε"}, {"zeta", "ζ"},
    {"eta", "η"},    {"theta", "θ"}, {"kappa", "κ"}, {"lambda", "λ"},     {"mu", "μ"},      {"nu", "ν"},
    {"xi", "ξ"},     {"pi", "π"},    {"rho", "ρ"},   {"sigma", "σ"},      {"tau", "τ"},     {"phi", "φ"},
    {"chi", "χ"},    {"psi", "ψ"},   {"omega", "ω"}, {"Gamma", "Γ"},      {"Delta", "Δ"},   {"Sigma", "Σ"},
    {"Phi", "Φ"},    {"Psi", "Ψ"},   {"Omega", "Ω"}, {"iota", "ι"},       {"upsilon", "υ"}, {"Theta", "Θ"},
    {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "Π"},    {"varepsilon", "ε"}, {"varphi", "φ"},  {"vartheta", "ϑ"}};
static const struct sign signs[] = {{"cdot", "·"},   {"times", "×"},     {"pm", "±"},     {"approx", "≈"}, {"sim", "∼"},
                                    {"propto", "∝"}, {"le", "≤"},        {"ge", "≥"},     {"ne", "≠"},     {"to", "→"},
                                    {"infty", "∞"},  {"partial", "∂"},   {"sum", "∑"},    {"int", "∫"},    {"ll", "≪"},
                                    {"gg", "≫"},     {"quad", "\u2003"}, {",", "\u2009"}, {"leq", "≤"},    {"geq", "≥"},
                                    {"neq", "≠"},    {"equiv", "≡"},     {"circ", "∘"},   {"ldots", "…"},  {"rightarrow", "→"},
                                    {"langle", "⟨"}, {"rangle", "⟩"},    {"left", ""},    {"right", ""}};
static const struct sign accents[] = {
    {"dot", "\u0307"}, {"ddot", "\u0308"}, {"bar", "\u0304"}, {"hat", "\u0302"}, {"vec", "\u20d7"}};

static const char *put_math(struct writer *w, const char *text, const char *end);

static const char *put_command(struct writer *w, const char *text, const char *end);

/* The argument at `text`: the text in braces, a command with its arguments, or one character. */
static const char *put_argument(struct writer *w, const char *text, const char *end)
{
    const bool command = text + 1 < end && *text == '\\';
    const char *after = command ? put_command(w, text, end) : NULL;
    if (command) /* the space behind a name stays */
        return after[-1] == ' ' ? after - 1 : after;
    const char *close = text < end && *text == '{' ? markup_closing(text + 1, end) : NULL, *to = close ? close : text;
    if (!close && text < end)
        to = text + character(text);
    for (const char *at = close ? text + 1 : text; at < to;)
        at = put_math(w, at, to);
    return close ? close + 1 : to;
}

static const char *put_fraction(struct writer *w, const char *text, const char *end)
{
    markup_put(w, higher);
    text = put_argument(w, text, end);
    markup_put(w, "</span>\u2044");
    markup_put(w, lower);
    text = put_argument(w, text, end);
    markup_put(w, "</span>");
    return text;
}

/* Pango draws no line over the argument of a root: more than one character is put in brackets. */
static const char *put_root(struct writer *w, const char *text, const char *end)
{
    const char *close = text < end && *text == '{' ? markup_closing(text + 1, end) : NULL;
    const bool several = close && text + 1 + character(text + 1) < close;
    markup_put(w, several ? "√(" : "√");
    text = put_argument(w, text, end);
    markup_put(w, several ? ")" : "");
    return text;
}

/* Words in equations, which are not products of letters. */
static const char *put_upright(struct writer *w, const char *text, const char *end)
{
    const char *close = text < end && *text == '{' ? markup_closing(text + 1, end) : NULL;
    if (!close)
        return put_argument(w, text, end);
    for (text++; text < close;)
        text = put_character(w, text + (*text == '\\' && text + 1 < close));
    return close + 1;
}

/* A mark over the last character of the argument, within its italics. */
static const char *put_accent(struct writer *w, const char *mark, const char *text, const char *end)
{
    static const char italic[] = "</i>";
    text = put_argument(w, text, end);
    const bool in_italics = !w->full && g_str_has_suffix(w->out, italic);
    w->used -= in_italics ? strlen(italic) : 0;
    markup_put(w, mark);
    markup_put(w, in_italics ? italic : "");
    return text;
}

static const struct {
    const char *name;
    const char *(*put)(struct writer *w, const char *text, const char *end);
} commands[] = {{"frac", put_fraction}, {"sqrt", put_root}, {"mathrm", put_upright}, {"text", put_upright}};

static const char *find_sign(const struct sign *table, size_t count, const char *name, size_t length)
{
    for (size_t i = 0; i < count; i++) {
        if (strlen(table[i].name) == length && strncmp(table[i].name, name, length) == 0)
            return table[i].sign;
    }
    return NULL;
}

/* A command such as \delta; unknown ones are written as they are, without the backslash. */
static const char *put_command(struct writer *w, const char *text, const char *end)
{
    const char *to = text + 1;
    while (to < end && g_ascii_isalpha(*to))
        to++;
    if (to == text + 1 && to < end)
        to += character(to);
    const size_t length = (size_t)(to - text - 1);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strlen(commands[i].name) == length && strncmp(commands[i].name, text + 1, length) == 0)
            return commands[i].put(w, to, end);
    }
    const char *sign = find_sign(accents, sizeof accents / sizeof *accents, text + 1, length);
    if (sign)
        return put_accent(w, sign, to, end);
    sign = find_sign(letters, sizeof letters / sizeof *letters, text + 1, length);
    if (sign) {
        markup_put(w, "<i>");
        markup_put(w, sign);
        markup_put(w, "</i>");
        return to < end && *to == ' ' ? to + 1 : to; /* it ends the name; around signs, it is visible */
    }
    sign = find_sign(signs, sizeof signs / sizeof *signs, text + 1, length);
    if (sign) {
        markup_put(w, sign);
        return to;
    }
    put_bytes(w, text + 1, length);
    return to;
}

/* Writes the next piece of the text between dollar signs and returns the rest. */
static const char *put_math(struct writer *w, const char *text, const char *end)
{
    if (*text == '\\' && text + 1 < end)
        return put_command(w, text, end);
    if ((*text == '_' || *text == '^') && text + 1 < end) {
        markup_put(w, *text == '_' ? lower : higher);
        text = put_argument(w, text + 1, end);
        markup_put(w, "</span>");
        return text;
    }
    if (*text == '{' || *text == '}')
        return text + 1;
    if (*text == '-') {
        markup_put(w, "\u2212");
        return text + 1;
    }
    if (!g_ascii_isalpha(*text))
        return put_character(w, text);
    markup_put(w, "<i>");
    while (text < end && g_ascii_isalpha(*text))
        put_bytes(w, text++, 1);
    markup_put(w, "</i>");
    return text;
}

/* The dollar sign that ends an equation, or NULL; as with stars, equations do not begin or end beside a space. */
static const char *dollar(const char *text, const char *end)
{
    for (const char *c = text; c < end && *text != ' '; c++) {
        if (*c == '\\')
            c++;
        else if (*c == '$' && c > text && c[-1] != ' ')
            return c;
    }
    return NULL;
}

static const char *put_equation(struct writer *w, const char *text, const char *end)
{
    markup_put(w, "<span face=\"STIX\">");
    while (text < end)
        text = put_math(w, text, end);
    markup_put(w, "</span>");
    return end + 1;
}

/* ---- tags of Pango, where both are there: others, and stray ones, are shown as they are ---- */

static const struct tag {
    const char *from, *to, *markup, *after;
} tags[] = {{"<b>", "</b>", "<b>", "</b>"}, {"<i>", "</i>", "<i>", "</i>"},        {"<u>", "</u>", "<u>", "</u>"},
            {"<s>", "</s>", "<s>", "</s>"}, {"<sub>", "</sub>", lower, "</span>"}, {"<sup>", "</sup>", higher, "</span>"}};

static bool begins(const char *text, const char *end, const char *with)
{
    return (size_t)(end - text) >= strlen(with) && strncmp(text, with, strlen(with)) == 0;
}

/* The closing tag for this one, or NULL. */
static const char *tag_end(const struct tag *tag, const char *text, const char *end)
{
    int depth = 1;
    for (; text < end; text += character(text)) {
        if (*text == '\\' && text + 1 < end)
            text++;
        else if (begins(text, end, tag->from))
            depth++;
        else if (begins(text, end, tag->to) && --depth == 0)
            return text;
    }
    return NULL;
}

/* The tag at `text`, whose closing tag is at `to`; NULL: none with a closing tag. */
static const struct tag *find_tag(const char *text, const char *end, const char **to)
{
    for (const struct tag *tag = tags; *text == '<' && tag < tags + sizeof tags / sizeof *tags; tag++) {
        if (begins(text, end, tag->from) && (*to = tag_end(tag, text + strlen(tag->from), end)) != NULL)
            return tag;
    }
    return NULL;
}

size_t bead_markup_tagged(const char *text)
{
    const char *to;
    const struct tag *tag = find_tag(text, text + strlen(text), &to);
    return tag ? (size_t)(to - text) + strlen(tag->to) : 0;
}

static void put_range(struct writer *w, const char *text, const char *end);

/* Writes the text between two tags and returns the rest; NULL: there are none. */
static const char *put_tagged(struct writer *w, const char *text, const char *end)
{
    const char *to;
    const struct tag *tag = find_tag(text, end, &to);
    if (!tag)
        return NULL;
    markup_put(w, tag->markup);
    put_range(w, text + strlen(tag->from), to);
    markup_put(w, tag->after);
    return to + strlen(tag->to);
}

static const char *put_shifted(struct writer *w, const char *text, const char *end);

static void put_range(struct writer *w, const char *text, const char *end)
{
    while (text < end) {
        const char *to = *text == '*' ? star(text + 1, end) : *text == '$' ? dollar(text + 1, end) : NULL;
        const char *after = put_tagged(w, text, end);
        if (after) {
            text = after;
        } else if (*text == '\\' && text + 1 < end) {
            text = put_character(w, text + 1);
        } else if (to && *text == '$') {
            text = put_equation(w, text + 1, to);
        } else if (to) {
            markup_put(w, italics);
            put_range(w, text + 1, to);
            markup_put(w, upright);
            text = to + 1;
        } else if ((*text == '_' || *text == '^') && text + 1 < end && text[1] != ' ') {
            text = put_shifted(w, text, end);
        } else {
            text = put_character(w, text);
        }
    }
}

/* `_x` or `^{xy}`. */
static const char *put_shifted(struct writer *w, const char *text, const char *end)
{
    bool down = *text == '_';
    const char *from = text + 1, *to = *from == '{' ? markup_closing(from + 1, end) : NULL, *after = to ? to + 1 : NULL;
    if (to)
        from++;
    else if (*from == '*' && (to = star(from + 1, end)) != NULL)
        after = ++to;
    else if (*from == '\\' && from + 1 < end)
        after = to = from + 1 + character(from + 1);
    else
        after = to = from + character(from);
    markup_put(w, down ? lower : higher);
    put_range(w, from, to);
    markup_put(w, "</span>");
    return after;
}

size_t bead_markup_size(const char *text)
{
    /* Two characters, one a `_`, become at most 56 + 5 bytes, two stars 32, any other character 5. */
    return 32 * strlen(text) + 1;
}

void bead_markup(const char *text, char *out, size_t size)
{
    struct writer w = {out, size, 0, size == 0};
    if (size == 0)
        return;
    out[0] = '\0';
    put_range(&w, text, text + strlen(text));
    if (w.full)
        bead_text_escape(text, out, size);
}

bool bead_markup_plain(const char *text, char *out, size_t size)
{
    BEAD_FREED char *markup = bead_markup_new(text);
    char *plain = NULL;
    if (!markup || size == 0)
        return markup != NULL;
    if (!pango_parse_markup(markup, -1, 0, NULL, &plain, NULL, NULL))
        plain = g_strdup(text);
    size_t used = 0;
    for (const char *at = plain, *next; *at; at = next) {
        next = at + character(at);
        const bool fixed = strncmp(at, "\u00a0", 2) == 0;
        if (used + (size_t)(next - at) >= size)
            break;
        memcpy(out + used, fixed ? " " : at, fixed ? 1 : (size_t)(next - at));
        used += fixed ? 1 : (size_t)(next - at);
    }
    out[used] = '\0';
    g_free(plain);
    return true;
}

char *bead_markup_new(const char *text)
{
    size_t size = bead_markup_size(text);
    char *markup = malloc(size);
    if (markup)
        bead_markup(text, markup, size);
    return markup;
}

void bead_markup_quote(const char *text, char *out, size_t size)
{
    size_t used = 0;
    for (size_t length; *text && size > 0; text += length) {
        bool special = strchr("_^*\\{}$<", *text) != NULL;
        length = character(text);
        if (used + length + special >= size)
            break;
        if (special)
            out[used++] = '\\';
        memcpy(out + used, text, length);
        used += length;
    }
    if (size > 0)
        out[used] = '\0';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Letters of all alphabets, and the sign of degrees: the s of µs and the C of °C are not symbols. */
static bool belongs_to_word(const char *at)
{
    const gunichar c = g_utf8_get_char_validated(at, -1);
    if (c == (gunichar)-1 || c == (gunichar)-2)
        return false;
    return c == 0xb0 || (g_unichar_isalpha(c) && g_unichar_type(c) != G_UNICODE_MODIFIER_LETTER); /* those are subscripts */
}

static bool is_single(const char *text, const char *at)
{
    const char *last = at > text ? g_utf8_prev_char(at) : " ", before = at > text ? at[-1] : ' ', after = at[1];
    bool joined = belongs_to_word(last) || belongs_to_word(at + 1) || (before >= '0' && before <= '9') ||
                  (before && strchr("*_^{\\", before));
    return is_letter(*at) && !joined && (*at != 'a' || after != ' ');
}

/* Bytes of the subscript letters and digits (U+2080 to U+209C) at the beginning. */
static size_t lowered(const char *text)
{
    size_t length = 0;
    while ((unsigned char)text[length] == 0xe2 && (unsigned char)text[length + 1] == 0x82 &&
           (unsigned char)text[length + 2] >= 0x80 && (unsigned char)text[length + 2] <= 0x9c)
        length += 3;
    return length;
}

/* The letter or digit that a subscript character represents. */
static char plain_of(const char *lowered_character)
{
    static const char plain[] = "0123456789+-=() aeoxehklmnpst";
    size_t at = (size_t)((unsigned char)lowered_character[2] & 0x3f);
    return at < sizeof plain - 1 ? plain[at] : '?';
}

static void put_symbol(struct writer *w, char symbol, const char *subscript, size_t length)
{
    markup_put(w, (char[]){'*', symbol, '*', '\0'});
    if (length == 0)
        return;
    bool italic = false;
    markup_put(w, "_{");
    for (size_t i = 0; i < length; i += 3) {
        char plain = plain_of(subscript + i);
        if (is_letter(plain) != italic)
            markup_put(w, "*");
        italic = is_letter(plain);
        markup_put(w, (char[]){plain, '\0'});
    }
    markup_put(w, italic ? "*}" : "}");
}

void bead_markup_symbols(const char *text, char *out, size_t size)
{
    struct writer w = {out, size, 0, size == 0};
    if (size > 0)
        out[0] = '\0';
    for (const char *at = text; *at && !w.full;) {
        size_t length = character(at);
        if (is_single(text, at)) {
            length = 1 + lowered(at + 1);
            put_symbol(&w, *at, at + 1, length - 1);
        } else {
            put_bytes(&w, at, length);
        }
        at += length;
    }
}
