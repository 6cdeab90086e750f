/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formats of files, as far as they concern texts. */
#pragma once

#include <stdint.h>
#include <sys/types.h>

#include "render/origin/origin.h"

struct origin_span {
    const unsigned char *bytes;
    size_t length;
};

/* Finds the text of a file and writes it to `text`. Files may be damaged, or made to mislead: nothing is read beyond their end, and
 * incomplete parts have no text. */
typedef void origin_get(struct origin_span file, FILE *text);

origin_get origin_get_png, origin_get_jpeg, origin_get_tiff, origin_get_webp, origin_get_gif, origin_get_boxes, origin_get_matroska,
    origin_get_svg, origin_get_pdf, origin_get_eps, origin_get_html;

/* A finished file that is open for reading and writing. */
struct origin_file {
    int descriptor;
    off_t size;
};

/* Puts a text into a file. False: it cannot be read or written, or is not of the kind that this program writes. */
typedef bool origin_put(struct origin_file *file, struct origin_span text);

origin_put origin_put_png, origin_put_jpeg, origin_put_tiff, origin_put_webp, origin_put_gif, origin_put_boxes;

/* ---- for these ---- */

/* The first `length` bytes from `at` on; fewer if the span ends before. */
struct origin_span origin_part(struct origin_span span, size_t at, size_t length);
bool origin_begins(struct origin_span span, const char *bytes, size_t length);
/* Whole numbers of at most 8 bytes; 0 if the span has fewer. */
uint64_t origin_big(struct origin_span span, size_t at, size_t bytes);
uint64_t origin_little(struct origin_span span, size_t at, size_t bytes);
/* The head of such a text, with the version between its two parts, and where it ends. False: there is none. */
bool origin_find_head(struct origin_span text, struct origin_span *version, size_t *end);
/* Writes a text only if it says how its file was made. False: it does not. */
bool origin_offer(struct origin_span span, FILE *text);
/* Writes the text between `open` and the next `close`, with the names of its characters resolved. False: there is none. */
bool origin_offer_element(struct origin_span span, const char *open, const char *close, FILE *text);
/* A block of bytes under construction. */
struct origin_block {
    char *bytes;
    size_t length;
    FILE *file; /* NULL: out of memory */
};
void origin_block_begin(struct origin_block *block);
void origin_put_big(uint64_t number, int bytes, FILE *file);
void origin_put_little(uint64_t number, int bytes, FILE *file);
/* Makes an XMP packet (ISO 16684-1) from a text that ends with a NUL, as a complete block, whose bytes are to be freed; false: out
 * of memory. And finds the text of such a packet. */
bool origin_make_xmp(struct origin_span text, struct origin_block *packet);
void origin_get_xmp(struct origin_span packet, FILE *text);
/* Inserts a block at a place in the file, and frees it. */
bool origin_insert(struct origin_file *file, off_t at, struct origin_block *block);
bool origin_read_at(const struct origin_file *file, off_t at, void *bytes, size_t count);
bool origin_write_at(const struct origin_file *file, off_t at, const void *bytes, size_t count);
