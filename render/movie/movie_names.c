/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The names of chains in a movie: headings, over the tops of stages, preceded by the curve's line; names above images. */
#include <math.h>

#include "render/draw/looks.h"
#include "render/movie/composer_private.h"

/* Length of the sample of the curve before its chain's name, in units of the label's font size. */
static const double sample_length = 1.8;

bool bead_composer_shares_curves(const struct bead_composer *c)
{
    bool stage = c->layout.layout == BEAD_LAYOUT_STAGE;
    return stage ? c->wants.chain_count > 1 && c->layout.overlay < c->wants.view_count : c->layout.layout == BEAD_LAYOUT_OVERLAY;
}

static void draw_sample(const struct bead_composer *c, size_t chain, struct bead_rgb colour, cairo_t *cr, struct bead_rect rect)
{
    const struct bead_look *look = &c->look;
    const struct bead_dashes *dashes = bead_look_dashes(chain % BEAD_DASHES);
    const double width = fmax(1.6, 1.8 * look->line);
    const double line = rect.height - (c->layout.label_lines ? 1.35 * look->label : 0);
    double lengths[6];
    for (int i = 0; i < dashes->count; i++)
        lengths[i] = width * dashes->lengths[i];
    cairo_save(cr);
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
    cairo_set_line_width(cr, width);
    cairo_set_dash(cr, lengths, dashes->count, 0);
    cairo_move_to(cr, rect.x, round(rect.y + 0.5 * line));
    cairo_rel_line_to(cr, sample_length * look->label, 0);
    cairo_stroke(cr);
    cairo_restore(cr);
}

/* Beside the key, if it is over the top of a stage. Width 0: there is no heading. */
static struct bead_rect heading_rect(const struct bead_composer *c, size_t chain)
{
    struct bead_rect rect = c->layout.chains[chain].heading;
    if (rect.width > 0 && c->layout.head > 0) {
        rect.x += (int)round(0.5 * c->look.label);
        rect.width -= (int)round(c->look.label + bead_composer_key(c, chain));
    }
    return rect;
}

/* Samples of the curves before the headings of their chains, which identify curves without colours; labels give way to them, and so
 * does M if it has a separate line. Returns the room for one; 0: some chain has none. */
static int sample_room(const struct bead_composer *c)
{
    const int room = (int)ceil((sample_length + 0.5) * c->look.label);
    bool fits = bead_composer_shares_curves(c);
    for (size_t i = 0; fits && i < c->layout.chain_count; i++) {
        const struct bead_rect rect = heading_rect(c, i);
        fits = rect.width == 0 || bead_heading_least(&c->look, c->setup.chains[i], !c->layout.label_lines) + room <= rect.width;
    }
    return fits ? room : 0;
}

static struct bead_rect after_sample(const struct bead_composer *c, struct bead_rect rect)
{
    const int room = sample_room(c);
    return (struct bead_rect){rect.x + room, rect.y, rect.width - room, rect.height};
}

static struct bead_heading heading_of(const struct bead_composer *c, size_t chain)
{
    const struct bead_rgb colour = bead_composer_shares_curves(c) ? bead_look_curve(&c->look, chain) : c->look.ink;
    return (struct bead_heading){c->setup.chains[chain], colour, c->layout.label_lines, false, 1};
}

/* All names of chains are as small as any one has to be, and so are the labels beside them; all M are below the names if one must
 * be. */
static void size_headings(const struct bead_composer *c, bool *below, double *name, double *label)
{
    *name = *label = 1;
    *below = false;
    for (size_t i = 0; i < c->layout.chain_count; i++) {
        const double least = bead_heading_least(&c->look, c->setup.chains[i], true);
        const struct bead_rect rect = heading_rect(c, i);
        *below = *below || (rect.width > 0 && least > after_sample(c, rect).width - BEAD_HEADING_AIR * c->look.tick);
    }
    for (int pass = 0; pass < 2; pass++) { /* labels depend on names */
        for (size_t i = 0; i < c->layout.chain_count; i++) {
            struct bead_heading heading = heading_of(c, i);
            const struct bead_rect rect = heading_rect(c, i);
            heading.below = *below;
            heading.size = *name;
            if (rect.width > 0 && pass == 0)
                *name = fmin(*name, bead_heading_name(&c->look, &heading, after_sample(c, rect)));
            else if (rect.width > 0)
                *label = fmin(*label, bead_heading_label(&c->look, &heading, after_sample(c, rect)));
        }
    }
}

/* All names above images are as small as any one has to be. */
static double size_of_names(const struct bead_composer *c)
{
    double size = 1;
    for (size_t i = 0; i < c->layout.chain_count; i++) {
        const double width = c->layout.chains[i].name.width;
        size = width > 0 ? fmin(size, bead_name_size(&c->look, c->setup.chains[i], width)) : size;
    }
    return size;
}

void bead_composer_draw_names(const struct bead_composer *c, size_t chain, cairo_t *cr)
{
    struct bead_heading heading = heading_of(c, chain);
    const struct bead_rect rect = heading_rect(c, chain), name = c->layout.chains[chain].name;
    if (rect.width > 0 && sample_room(c) > 0)
        draw_sample(c, chain, heading.colour, cr, rect);
    double label;
    size_headings(c, &heading.below, &heading.size, &label);
    if (rect.width > 0)
        bead_heading_draw(cr, &c->look, &heading, label, after_sample(c, rect));
    if (name.width > 0)
        bead_name_draw(cr, &c->look, &heading, size_of_names(c), name);
}
