/* Plain text with a few formulas in it, to markup: indices, powers, Greek letters. */
#include <glib.h>
#include <string.h>

#include "beadreel/look.h"

static const struct {
    const char *name, *letter;
} letters[] = {
    {"alpha", "α"}, {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},  {"epsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},
    {"theta", "θ"}, {"iota", "ι"},   {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},      {"nu", "ν"},     {"xi", "ξ"},
    {"pi", "π"},    {"rho", "ρ"},    {"sigma", "σ"}, {"tau", "τ"},    {"upsilon", "υ"}, {"phi", "φ"},    {"chi", "χ"},
    {"psi", "ψ"},   {"omega", "ω"},  {"Gamma", "Γ"}, {"Delta", "Δ"},  {"Theta", "Θ"},   {"Lambda", "Λ"}, {"Xi", "Ξ"},
    {"Pi", "Π"},    {"Sigma", "Σ"},  {"Phi", "Φ"},   {"Psi", "Ψ"},    {"Omega", "Ω"},   {"times", "×"},  {"cdot", "·"},
    {"pm", "±"},    {"approx", "≈"}, {"leq", "≤"},   {"geq", "≥"},    {"infty", "∞"},   {"to", "→"},     {"propto", "∝"},
};

/* Markup being written; what does not fit whole is left out, with all that follows. */
struct sink {
    char *out;
    size_t size, used;
    bool full;
};

static void put(struct sink *s, const char *text, size_t length)
{
    s->full = s->full || s->used + length >= s->size;
    if (s->full)
        return;
    memcpy(s->out + s->used, text, length);
    s->used += length;
    s->out[s->used] = '\0';
}

/* The letter that `text` begins with behind a backslash, and how long its name is. */
static const char *find_letter(const char *text, size_t *length)
{
    *length = 0;
    while (g_ascii_isalpha(text[*length]))
        ++*length;
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
        if (strlen(letters[i].name) == *length && strncmp(letters[i].name, text, *length) == 0)
            return letters[i].letter;
    }
    return NULL;
}

/* A character as it stands, escaped. */
static const char *put_plain(struct sink *s, const char *at)
{
    char one[8] = "", escaped[16];
    size_t length = 1;
    while (length < 4 && ((unsigned char)at[length] & 0xc0) == 0x80)
        length++;
    memcpy(one, at, length);
    bead_text_escape(one, escaped, sizeof escaped);
    put(s, escaped, strlen(escaped));
    return at + length;
}

static const char *put_letter(struct sink *s, const char *at)
{
    size_t length;
    const char *letter = *at == '\\' ? find_letter(at + 1, &length) : NULL;
    if (!letter)
        return put_plain(s, at);
    put(s, letter, strlen(letter));
    return at + 1 + length;
}

void bead_text_formula(const char *text, char *out, size_t size)
{
    struct sink s = {out, size, 0, size == 0};
    if (size > 0)
        out[0] = '\0';
    while (*text && !s.full) {
        const char *close = (*text == '_' || *text == '^') && text[1] == '{' ? strchr(text, '}') : NULL;
        if (!close) {
            text = put_letter(&s, text);
            continue;
        }
        const char *tag = *text == '_' ? "sub" : "sup";
        struct sink before = s;
        put(&s, "<", 1), put(&s, tag, 3), put(&s, ">", 1);
        for (text += 2; text < close;)
            text = put_letter(&s, text);
        put(&s, "</", 2), put(&s, tag, 3), put(&s, ">", 1);
        text = close + 1;
        if (s.full) { /* markup that is not closed would not be any */
            s = before;
            s.full = true;
            out[s.used] = '\0';
        }
    }
}
