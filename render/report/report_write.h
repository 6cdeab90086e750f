/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text of a report: its page, made from a template, and pieces of HTML and JSON. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/error.h"
#include "beadreel/render.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "render/colour/colour_range.h"
#include "sim/base/json.h"

/* Within <script>, with numbers of 12 digits. */
#define REPORT_JSON(file)                         \
    {                                             \
        .out = (file), .html = true, .digits = 12 \
    }

/* Replaces {{name}} in a template, unless that is a file of assets/report. */
struct report_part {
    const char *name; /* NULL: end of the list */
    enum bead_error (*write)(const void *context, FILE *file, struct bead_message *msg);
};

/* The parts that differ between pages made from assets/report/page.html: {{skip}} leads to `controls`, the id of an element (NULL:
 * is empty), {{body}} is a file with parts of its own, and {{scripts}} are files, up to NULL. */
struct report_page {
    const char *controls, *body;
    const char *const *scripts;
    const struct report_part *parts;
};

/* Writes the page to `path`, whole or not at all, with a decimal point in every locale. {{title}} and {{scene}} come from `scene`,
 * {{version}} is the program's; `context` is for the page's own parts. Errors: IO, MEMORY, FORMAT (the templates), those of the
 * parts. */
BEAD_CHECK enum bead_error report_write_page(const struct report_page *page, const struct bead_scene *scene, const void *context,
                                             const char *path, uint64_t *bytes, struct bead_message *msg);

void report_base64(FILE *file, const unsigned char *bytes, size_t count);
/* A member: a text of base64. */
void report_bytes(struct bead_json *json, const char *key, const unsigned char *bytes, size_t count);
/* The beginning of the object of all data, and members of it: the field shown, its range, its colours (light, dark). */
void report_open(struct bead_json *json, const struct bead_scene *scene);
void report_field(struct bead_json *json, const struct bead_field_info *info, const char *name);
void report_range(struct bead_json *json, const struct bead_colour_range *range, enum bead_scale scale);
void report_maps(struct bead_json *json, const struct bead_colormap maps[2]);
/* An object {step, signed, data}: value = step times a whole number of 16 bits, low byte first. Zero is exact, the error at most
 * half a step. Errors: MEMORY. */
BEAD_CHECK enum bead_error report_samples(struct bead_json *json, const char *key, const float *values, size_t count,
                                          struct bead_message *msg);
