/* Texts of figures to Pango markup: `_x`, `_{xy}`, `^x` and `^{xy}` set what follows lower and higher, `*x*` in mathematical
 * italics; a backslash takes the next character as it stands. Greek and signs are UTF-8. */
#ifndef BEADREEL_RENDER_DRAW_MARKUP_H
#define BEADREEL_RENDER_DRAW_MARKUP_H

#include <stddef.h>

/* The symbol of a quantity in Pango markup. */
#define BEAD_SYMBOL(letter) "<span face=\"STIX\"><i>" letter "</i></span>"

/* Bytes that the markup of this text takes at most, with the zero at its end. */
size_t bead_markup_size(const char *text);
/* Into `out` of `size` bytes; where they do not suffice the text stands there as it is, cut between characters. */
void bead_markup(const char *text, char *out, size_t size);
/* The same in memory of its own, to be freed; NULL: out of memory. */
char *bead_markup_new(const char *text);
/* Plain text to text that bead_markup shows as it is: names with a `_` in them. Cut between characters where it is too long. */
void bead_markup_quote(const char *text, char *out, size_t size);
/* Letters that stand alone are symbols of quantities: "x" to "*x*", "u uₓ = 0" to "*u* *uₓ* = 0"; the article a stays. What is in
 * italics, lowered or raised already stays too. Cut between characters where it is too long. */
void bead_markup_symbols(const char *text, char *out, size_t size);

#endif
