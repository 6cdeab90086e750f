/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text of a report: its page from a template, and the pieces that HTML and JSON are made of. */
#ifndef BEADREEL_RENDER_REPORT_REPORT_WRITE_H
#define BEADREEL_RENDER_REPORT_REPORT_WRITE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/colormap.h"
#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "render/colour/colour_range.h"

/* What stands in a template as {{name}} and is not a file of assets/report. */
struct report_part {
    const char *name; /* NULL: behind the last */
    enum bead_error (*write)(const void *context, FILE *file, struct bead_message *msg);
};

/* What differs between pages of assets/report/page.html: {{skip}} leads to `controls`, the id of an element, or is nothing (NULL),
 * {{body}} is a file with parts of its own, and {{scripts}} are files, up to NULL. */
struct report_page {
    const char *controls, *body;
    const char *const *scripts;
    const struct report_part *parts;
};

/* The page, with its files and parts put in, written to `path` whole or not at all, with a decimal point in every locale. Errors:
 * IO, MEMORY, FORMAT (the templates), those of the parts. */
BEAD_CHECK enum bead_error report_write_page(const struct report_page *page, const void *context, const char *path, uint64_t *bytes,
                                             struct bead_message *msg);

/* As text of an element or a quoted attribute; what XML forbids is left out. */
void report_html(FILE *file, const char *text);
/* A string of JSON, also within <script>: no `<` that could end it. */
void report_string(FILE *file, const char *text);
/* "name": in front of a value; `comma`: and a comma before that. */
void report_key(FILE *file, bool comma, const char *name);
/* A number of JSON; null where it is not finite. */
void report_number(FILE *file, double value);
void report_numbers(FILE *file, const double *values, size_t count);
void report_base64(FILE *file, const unsigned char *bytes, size_t count);
/* Members of the object of all data, each with a comma behind it: what is shown, from which value to which, in which colours
 * (light, dark). */
void report_field(FILE *file, const struct bead_field_info *info, enum bead_field field);
void report_range(FILE *file, const struct bead_colour_range *range, enum bead_scale scale);
void report_maps(FILE *file, const struct bead_colormap maps[2]);
/* An object {step, signed, data}: value = step times a whole number of 16 bits, low byte first. Zero is exact, the error at most
 * half a step. Errors: MEMORY. */
BEAD_CHECK enum bead_error report_samples(FILE *file, const float *values, size_t count, struct bead_message *msg);

#endif
