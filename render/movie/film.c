/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks a movie and finds what its frames need. The sinks of films and of single frames start here. */
#include "render/movie/film.h"

#include <math.h>

#include "render/colour/colour_range.h"
#include "render/view/theory_line.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

static const double most_pixels = 16384;

static enum bead_error find_size(const struct bead_output *output, int *width, int *height, struct bead_message *msg)
{
    double size[2] = {1920, 1080};
    for (int i = 0; i < 2; i++) {
        size[i] = output->paper.size[i] > 0 ? round(output->paper.size[i]) : size[i];
        if (!(size[i] >= 1 && size[i] <= most_pixels))
            return bead_output_wrong(output, msg, "size: movies have 1 to %.0f pixels a side", most_pixels);
    }
    *width = (int)size[0];
    *height = (int)size[1];
    return BEAD_OK;
}

static enum bead_error find_beads(struct bead_film *f, struct bead_message *msg)
{
    for (size_t c = 0; c < f->context.chain_count; c++) {
        size_t last = bead_chain_beads(f->context.chains[c]) - 1;
        f->last_bead = last > f->last_bead ? last : f->last_bead;
    }
    f->last_bead = f->output->shown.beads.last < f->last_bead ? f->output->shown.beads.last : f->last_bead;
    if (f->output->shown.beads.first <= f->last_bead)
        return BEAD_OK;
    return bead_output_wrong(f->output, msg, "beads: no chain has so many beads");
}

/* The film must show the times of captions and poster; scenes without an end could not be checked before. */
static enum bead_error check_times(const struct bead_film *f, struct bead_message *msg)
{
    const struct bead_movie_asked *movie = &f->output->movie;
    const char *unit = bead_chain_time_unit(f->context.chains[0]), *space = *unit ? " " : "";
    double end = f->times.time[1];
    for (size_t i = 0; i < movie->caption_count; i++) {
        if (movie->captions[i].at >= end)
            return bead_output_wrong(f->output, msg,
                                     "captions.%zu.at: is %g%s%s; must be before the end of what is shown, at %g%s%s", i,
                                     movie->captions[i].at, space, unit, end, space, unit);
    }
    if (movie->poster_at > end)
        return bead_output_wrong(f->output, msg, "poster-at: is %g%s%s; the movie ends at %g%s%s", movie->poster_at, space, unit,
                                 end, space, unit);
    return BEAD_OK;
}

enum bead_error bead_film_prepare(const struct bead_output *output, const struct bead_run_context *context, struct bead_film *film,
                                  struct bead_message *msg)
{
    const struct bead_chain *first = context->chains[0];
    *film = (struct bead_film){.output = output,
                               .context = *context,
                               .fields = bead_composer_fields(output, first),
                               .comparison = bead_composer_comparison(output, first)};
    BEAD_TRY(bead_colour_range_check(output, msg));
    for (size_t c = 0; c < context->chain_count && output->shown.theory; c++)
        BEAD_TRY(bead_theory_line_check(output, context->chains[c], msg));
    BEAD_TRY(find_size(output, &film->width, &film->height, msg));
    BEAD_TRY(bead_movie_times_choose(film, msg));
    BEAD_TRY(check_times(film, msg));
    return find_beads(film, msg);
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
    /* Short events are left out only for waves that begin with a strike, not for impacts, which are all short. */
    const bool struck = bead_chain_spec(first)->system->has_striker && !film->times.held;
    const double typical = film->preview && struck ? bead_preview_typical(film->preview) : INFINITY;
    struct bead_shown_values values = {.least = range.low, .largest = range.high, .typical = typical};
    if (film->preview) {
        values.rest = bead_colour_range_rest(film->context.chains, film->context.chain_count, output->shown.field);
        bead_preview_away(film->preview, &values.away, &values.usually_away);
        values.usually_away = struck ? values.usually_away : values.away;
    }
    struct bead_colour_range colours =
        bead_colour_range_find(&output->colours, bead_chain_signed(first, output->shown.field), &values);
    bead_colour_range_ends(output, first, &colours, &colours.over, &colours.under);
    struct bead_composer_setup setup = {.output = output,
                                        .chains = film->context.chains,
                                        .chain_count = film->context.chain_count,
                                        .title = film->context.scene->title,
                                        .width = film->width,
                                        .height = film->height,
                                        .time = {film->times.time[0], film->times.time[1]},
                                        .step = film->times.step,
                                        .film = &film->times.film,
                                        .range = colours,
                                        .scene = film->context.scene,
                                        .tolerance_factor = film->context.tolerance_factor,
                                        .canvas = film->context.canvas,
                                        .interest = interest,
                                        .held = film->times.held,
                                        .fine = film->context.frame || output->movie.quality >= BEAD_QUALITY_HIGH,
                                        .preview = film->preview && bead_preview_whole(film->preview) ? film->preview : NULL};
    return bead_composer_create(&setup, composer, msg);
}
