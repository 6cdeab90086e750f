/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact sheets of sweeps: small space-time images of many configurations, rows by magnetism, with one range of colours.
 * contact_sheet.c (life), contact_sheet_layout.c (which pictures, and where), contact_sheet_draw.c (pictures and words). */
#pragma once

#include "beadreel/sweep.h"
#include "beadreel/view.h"
#include "render/colour/colour_range.h"
#include "render/draw/axis.h"
#include "render/encode/page.h"
#include "render/view/area.h"
#include "sim/sweep/sweep_internal.h"

/* A row of pictures, of one magnetism if the sweep has several. */
struct contact_row {
    size_t panel, first, count; /* configurations first .. first + count - 1 */
    double magnetism;           /* NaN: they differ */
};

struct contact_image {
    size_t panel, index, row;
    enum bead_field field; /* of the area */
    double magnetism;
    struct bead_rect picture, spins; /* px; spins are along the chain: above, or left of pictures with time to the right */
    struct bead_rect words;          /* below: numbers, and the bar of the index */
    signed char *spin;               /* [beads]: 1 up, 0 reversed, -1: no cell */
    size_t beads;
    double rest; /* N: static force; 0: none, or not shown */
    struct bead_area *area;
};

struct contact_sheet {
    const struct bead_output *output;
    const struct bead_sweep *sweep;
    struct bead_page page;
    struct bead_look look;
    double small; /* px: type of the numbers */
    enum bead_orientation orientation;
    struct contact_row *rows;
    size_t row_count, columns;
    struct contact_image *images;
    struct bead_sweep_watch *watches; /* [image_count] */
    size_t image_count;
    struct bead_rect intro, bar;              /* title and explanation; bar of colours */
    double label_width;                       /* of the rows */
    bool several;                             /* sweeps */
    bool by_key;                              /* each row has all values of the last key of a sweep over keys */
    double end;                               /* s */
    bool of_contacts, is_signed;              /* values: of contacts; can be negative */
    bool behind;                              /* forces are measured behind the random cells */
    struct bead_colormap map, map_about_rest; /* the latter where all have one static force */
    struct bead_colours colours;
    struct bead_colour_range range;
};

/* Runs the chains of the sheet of `output` and `sweep`, until it can be drawn; must be cleared even after an error. Errors: SCENE,
 * MEMORY, those of the runs. */
BEAD_CHECK enum bead_error contact_sheet_make(struct contact_sheet *sheet, const struct bead_sweep_settings *settings,
                                              struct bead_message *msg);
void contact_sheet_clear(struct contact_sheet *sheet);
/* px along time. */
static inline int contact_columns(const struct contact_sheet *sheet, const struct contact_image *image)
{
    return sheet->orientation == BEAD_TIME_DOWN ? image->picture.height : image->picture.width;
}
/* Chooses rows, images and their places. Errors: SCENE (no room), MEMORY. */
BEAD_CHECK enum bead_error contact_sheet_arrange(struct contact_sheet *sheet, struct bead_message *msg);
/* A bead_draw. */
BEAD_CHECK enum bead_error contact_sheet_draw(void *sheet, cairo_t *cr, struct bead_message *msg);
/* Draws the title and the explanation into sheet->intro and returns their height, px. cr NULL: only measures. */
double contact_sheet_intro(const struct contact_sheet *sheet, cairo_t *cr, double width);
/* The name of a row, as markup. */
void contact_sheet_row_name(const struct contact_sheet *sheet, const struct contact_row *row, char *text, size_t size);
/* `spin` of a cell: 1 up, 0 reversed, -1 none. */
struct bead_rgb contact_sheet_spin_colour(const struct contact_sheet *sheet, int spin);
