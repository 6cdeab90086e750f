/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks a movie and finds what its frames are made of. The sink of films and that of single frames begin with it. */
#include "render/movie/film.h"

#include <math.h>

#include "render/colour/colour_range.h"
#include "render/movie/captions.h"
#include "render/movie/movie_size.h"

static enum bead_error find_beads(struct bead_film *f, struct bead_message *msg)
{
    for (size_t c = 0; c < f->context.chain_count; c++) {
        size_t last = bead_chain_beads(f->context.chains[c]) - 1;
        f->last_bead = last > f->last_bead ? last : f->last_bead;
    }
    f->last_bead = f->output->shown.beads.last < f->last_bead ? f->output->shown.beads.last : f->last_bead;
    if (f->output->shown.beads.first <= f->last_bead)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: beads: no chain has so many beads", f->context.scene->file,
                     f->output->place.line, f->output->place.column);
}

enum bead_error bead_film_prepare(const struct bead_output *output, const struct bead_run_context *context, struct bead_film *film,
                                  struct bead_message *msg)
{
    const struct bead_chain *first = context->chains[0];
    *film = (struct bead_film){.output = output,
                               .context = *context,
                               .fields = bead_composer_fields(output, first),
                               .comparison = bead_composer_comparison(output, first)};
    enum bead_error err = bead_colour_range_check(output, context->scene->file, msg);
    if (!err)
        err = bead_movie_size(output, context->scene, &film->width, &film->height, msg);
    if (!err)
        err = bead_movie_times_choose(output, context, &film->times, msg);
    if (!err)
        err = bead_captions_check(output, context->scene, film->times.time[1], bead_chain_time_unit(first), msg);
    return err ? err : find_beads(film, msg);
}

bool bead_film_scouts(const struct bead_film *film)
{
    return isnan(film->output->colours.range[0]) || isnan(film->output->colours.range[1]);
}

void bead_film_needs(const struct bead_film *film, const char *why, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = film->fields,
                                 .beads = {film->output->shown.beads.first, film->last_bead},
                                 .grid = film->times.grid,
                                 .range = bead_film_scouts(film),
                                 .range_field = film->output->shown.field,
                                 .comparison = film->comparison,
                                 .until = film->times.time[1],
                                 .why = why};
}

enum bead_error bead_film_compose(const struct bead_film *film, struct bead_range range, bool interest,
                                  struct bead_composer **composer, struct bead_message *msg)
{
    const struct bead_output *output = film->output;
    const struct bead_chain *first = film->context.chains[0];
    const struct bead_colour_range colours = bead_colour_range_find(&output->colours, bead_chain_signed(first, output->shown.field),
                                                                    &(struct bead_shown_values){range.low, range.high, INFINITY});
    struct bead_composer_setup setup = {.output = output,
                                        .chains = film->context.chains,
                                        .chain_count = film->context.chain_count,
                                        .title = film->context.scene->title,
                                        .width = film->width,
                                        .height = film->height,
                                        .time = {film->times.time[0], film->times.time[1]},
                                        .step = film->times.step,
                                        .film = &film->times.film,
                                        .range = {colours.low, colours.high},
                                        .scene = film->context.scene,
                                        .tolerance_factor = film->context.tolerance_factor,
                                        .canvas = film->context.canvas,
                                        .interest = interest};
    bead_colour_range_ends(output, first, &colours, &setup.over, &setup.under);
    return bead_composer_create(&setup, composer, msg);
}
