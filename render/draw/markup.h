/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of figures to Pango markup: `_x`, `_{xy}`, `^x` and `^{xy}` set subscripts and superscripts, `*x*` mathematical italics; a
 * backslash keeps the next character as it is. `$F \sim \delta^{3/2}$`: a little TeX. `<b>bold</b>`: so with b, i, u, s, sub and
 * sup. Greek and signs are UTF-8. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The symbol of a quantity in Pango markup. */
#define BEAD_SYMBOL(letter) "<span face=\"STIX\"><i>" letter "</i></span>"

/* The largest number of bytes in the markup of this text, with its final zero. */
size_t bead_markup_size(const char *text);
/* Writes markup into `out` of `size` bytes; if it does not fit, the text is copied as it is, cut between characters. */
void bead_markup(const char *text, char *out, size_t size);
/* Markup in new memory, which the caller frees; NULL: out of memory. */
char *bead_markup_new(const char *text);
/* Bytes of the text enclosed by two tags, with the tags, if the first is here; else 0. Lines do not break within. */
size_t bead_markup_tagged(const char *text);
/* The text as read, without marks: for chapters, subtitles and those who cannot see. Cut if it is too long. false: out of
 * memory. */
bool bead_markup_plain(const char *text, char *out, size_t size);
/* Quotes plain text, such as names with a `_`, so that bead_markup shows it as it is. Too long a text is cut between characters. */
void bead_markup_quote(const char *text, char *out, size_t size);
/* Single letters are symbols of quantities: "x" to "*x*", "u uₓ = 0" to "*u* *uₓ* = 0"; the article a stays, and so does text
 * already in italics, a subscript or a superscript. Too long a text is cut between characters. */
void bead_markup_symbols(const char *text, char *out, size_t size);
