/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A picture in the picture: the cells of the chains, beside the curve below a stage. */
#include "render/draw/looks.h"
#include "render/movie/composer_private.h"
#include "render/schematic/schematic.h"

/* In units of the drawing's type size, the size of numbers at axes. */
static const double width = 13, pad = 0.4;

static bool has_cell(const struct bead_composer *c)
{
    for (size_t i = 0; i < c->setup.chain_count; i++) {
        const struct bead_chain_spec *spec = bead_chain_spec(c->setup.chains[i]);
        for (size_t s = 0; s < spec->segment_count; s++) {
            if (spec->segments[s].cell_beads > 1)
                return true;
        }
    }
    return false;
}

static enum bead_error refuse(const struct bead_composer *c, struct bead_message *msg)
{
    if (!has_cell(c))
        return bead_output_wrong(c->setup.output, msg, "inset: is cell, but no chain has a cell of two beads");
    return bead_output_wrong(c->setup.output, msg, "inset: %d x %d pixels have no room for a drawing of the cell beside a curve",
                             c->setup.width, c->setup.height);
}

double bead_inset_width(const struct bead_composer *c)
{
    return c->setup.output->movie.inset == BEAD_INSET_CELL ? width * c->look.tick : 0;
}

enum bead_error bead_inset_check(const struct bead_composer *c, struct bead_message *msg)
{
    return c->wants.inset > 0 && (c->layout.inset.width == 0 || !has_cell(c)) ? refuse(c, msg) : BEAD_OK;
}

enum bead_error bead_inset_draw(const struct bead_composer *c, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_rect at = c->layout.inset;
    struct bead_look look = c->look;
    const double air = pad * look.tick;
    if (at.width == 0)
        return BEAD_OK;
    look.label = look.tick;
    bead_look_paint_panel(&look, cr, at.x, at.y, at.width, at.height);
    const struct bead_run_context context = {
        .scene = c->setup.scene, .chains = c->setup.chains, .chain_count = c->setup.chain_count};
    struct bead_sketch sketch = {.cr = cr, .look = &look};
    const struct bead_drafting d = {.sketch = &sketch,
                                    .output = c->setup.output,
                                    .context = &context,
                                    .area = {at.x + air, at.y + air, at.width - 2 * air, at.height - 2 * air},
                                    .once = true};
    cairo_save(cr);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    const bool good = bead_schematic_cell(&d) && !bead_sketch_crowded(&sketch, c->setup.width, c->setup.height);
    cairo_restore(cr);
    const bool failed = sketch.failed;
    bead_sketch_free(&sketch);
    if (failed)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a movie");
    return good ? BEAD_OK : refuse(c, msg);
}
