/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One frame of a movie, as a PNG file. Views are fed and cameras move as for the film, but nothing else is drawn or encoded, and no
 * sample is taken beyond the frame. A frame chosen for its contents takes two runs: one finds it, the other draws it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "render/movie/film.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/measure/sink_grid.h"

struct bead_sink {
    struct bead_film film;
    char *path;
    bool search, found;      /* the frame is a poster's; its number is known */
    struct bead_poster peak; /* during the search */
    size_t frame, next;      /* its number; the next to pass */
    double seen;             /* s: time that all chains have reached; NaN: none */
    bool begun, drawn;       /* `begun`: the range of colours is known */
    struct bead_composer *composer;
    uint64_t bytes;
    char why[96], makers[96];
};

static void frame_destroy(struct bead_sink *s)
{
    if (!s)
        return;
    bead_composer_destroy(s->composer);
    bead_film_free(&s->film);
    free(s->path);
    free(s);
}

/* ---- choice of the frame ---- */

/* The frame whose picture the film shows at frame `index`: the first of its group. */
static size_t drawn_for(const struct bead_sink *s, size_t index)
{
    while (!bead_movie_draws(&s->film.times, index))
        index--;
    return index;
}

static enum bead_error outside(const struct bead_sink *s, struct bead_message *msg)
{
    const struct bead_run_context *context = &s->film.context;
    const char *unit = bead_chain_time_unit(context->chains[0]);
    char begins[32], ends[32];
    bead_time_text(s->film.times.time[0], unit, begins, sizeof begins);
    bead_time_text(s->film.times.time[1], unit, ends, sizeof ends);
    return bead_fail(msg, BEAD_ERROR_USAGE, "--frame %s: is not in the film, which shows %s to %s, 0%% to 100%%",
                     context->frame->text, begins, ends);
}

/* The frame of a poster at this time of the motion. */
static enum bead_error find_time(struct bead_sink *s, double at, struct bead_message *msg)
{
    const struct bead_movie_times *t = &s->film.times;
    const struct bead_poster choice = bead_poster_choose(at, t->step);
    const double rounding = 1e-9 * t->time[1];
    if (!(at >= t->time[0] - rounding && at <= t->time[1] + rounding))
        return outside(s, msg);
    s->frame = t->frames - 1;
    for (size_t k = t->frames; k-- > t->card;) {
        if (bead_movie_draws(t, k) && bead_poster_reached(&choice, bead_movie_time(t, (double)k)))
            s->frame = k;
    }
    return BEAD_OK;
}

static enum bead_error find_frame(struct bead_sink *s, const struct bead_frame_asked *asked, struct bead_message *msg)
{
    s->seen = NAN;
    s->search = isnan(asked->time) && isnan(asked->part);
    s->found = !s->search;
    s->peak = bead_poster_choose(NAN, s->film.times.step);
    if (!isnan(asked->time))
        return find_time(s, asked->time, msg);
    if (s->search)
        return BEAD_OK;
    if (!(asked->part >= 0 && asked->part <= 1))
        return outside(s, msg);
    s->frame = drawn_for(s, (size_t)round(asked->part * (double)(s->film.times.frames - 1)));
    return BEAD_OK;
}

/* ---- life ---- */

static enum bead_error frame_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(sink, 1, msg, "a frame"));
    struct bead_sink *s = *sink;
    BEAD_TRY(bead_film_prepare(output, context, &s->film, msg));
    BEAD_TRY(find_frame(s, context->frame, msg));
    BEAD_TRY(bead_file_join(context->directory, output->path, &s->path, msg));
    snprintf(s->why, sizeof s->why, "one frame of %zu, of %d x %d pixels", s->film.times.frames, s->film.width, s->film.height);
    return BEAD_OK;
}

/* Needs samples up to the frame, or all of them while the frame or the range of colours is unknown. */
static void frame_needs(const struct bead_sink *s, struct bead_needs *needs)
{
    bead_film_needs(&s->film, s->why, needs);
    if (s->search)
        needs->fields |= BEAD_FIELD_BIT(s->film.output->shown.field); /* a stage alone shows other fields */
    if (!s->found || (bead_film_scouts(&s->film) && !s->begun))
        return;
    const double count = ceil((bead_movie_time(&s->film.times, (double)s->frame) - needs->grid.start) / needs->grid.every - 1e-6);
    needs->grid.end = fmin(needs->grid.end, needs->grid.start + fmax(0, count) * needs->grid.every);
    needs->until = fmin(needs->until, needs->grid.end);
}

static enum bead_error frame_begin(struct bead_sink *s, struct bead_range range, struct bead_message *msg)
{
    s->begun = true;
    BEAD_TRY(bead_film_compose(&s->film, range, s->search, &s->composer, msg));
    return bead_composer_open(s->composer, msg);
}

/* Draws, judges or skips a frame that has its own picture. */
static enum bead_error pass_frame(struct bead_sink *s, struct bead_message *msg)
{
    const double time = bead_movie_time(&s->film.times, (double)s->next);
    const bool card = s->next < s->film.times.card;
    struct bead_changes changes = {0};
    s->drawn = s->found && s->next == s->frame;
    if (s->drawn || (s->found && !card && s->film.output->shown.trust)) { /* the line about the horizon depends on earlier frames */
        return card ? bead_composer_card(s->composer, &changes, msg) : bead_composer_draw(s->composer, time, &changes, msg);
    }
    if (s->found)
        return card ? BEAD_OK : bead_composer_pass(s->composer, time, msg);
    bead_interest_advance(s->composer);
    if (!card && bead_poster_prefers(&s->peak, s->composer, time))
        s->frame = s->next;
    return BEAD_OK;
}

static enum bead_error pass_frames(struct bead_sink *s, double until, struct bead_message *msg)
{
    for (; !s->drawn && s->next < s->film.times.frames && bead_movie_time(&s->film.times, (double)s->next) <= until; s->next++)
        BEAD_TRY(bead_movie_draws(&s->film.times, s->next) ? pass_frame(s, msg) : BEAD_OK);
    return BEAD_OK;
}

static enum bead_error frame_sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    if (!s->found)
        bead_interest_feed(s->composer, sample);
    BEAD_TRY(s->found ? bead_composer_feed(s->composer, sample, msg) : BEAD_OK);
    if (sample->chain + 1 < s->film.context.chain_count)
        return BEAD_OK;
    s->seen = sample->time;
    return pass_frames(s, sample->time + 1e-6 * s->film.times.grid.every, msg);
}

static enum bead_error frame_again(struct bead_sink *s, bool *again, struct bead_message *msg)
{
    /* the last sample is shown to the end of its interval */
    enum bead_error err = isnan(s->seen) ? BEAD_OK : pass_frames(s, s->seen + s->film.times.grid.every, msg);
    *again = !err && !s->found;
    if (*again) {
        bead_interest_advance(s->composer); /* the next run starts afresh */
        s->found = true;
        s->next = 0;
        s->seen = NAN;
    }
    return err;
}

/* Comments above the scene give the number of the frame, for --reproduce. */
static enum bead_error write_frame(struct bead_sink *s, struct bead_message *msg)
{
    const struct bead_frame_asked *asked = s->film.context.frame;
    const struct bead_scene *scene = s->film.context.scene;
    BEAD_FREED char *source = NULL;
    if (asprintf(&source, "# beadreel --frame %s\n%s%s%s%s", asked->text, asked->still ? "# beadreel --still " : "",
                 asked->still ? asked->still : "", asked->still ? "\n" : "", scene->text) < 0) {
        source = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for the scene in it", s->path);
    }
    return bead_poster_file(s->path, bead_composer_frame(s->composer), scene->title, source, &s->bytes, msg);
}

static enum bead_error frame_end(struct bead_sink *s, const struct bead_outcome *, struct bead_message *msg)
{
    const char *painter = bead_composer_painter(s->composer);
    if (!s->drawn)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: there are no samples of this frame", s->path);
    snprintf(s->makers, sizeof s->makers, "%s%s", *painter ? "painted by " : "", painter);
    return write_frame(s, msg);
}

static enum bead_error frame_scout(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_film_scout(&s->film, sample, msg);
}

static void frame_result(const struct bead_sink *s, uint64_t *bytes, uint64_t *items)
{
    *bytes = s->bytes;
    *items = 1;
}

static const char *frame_makers(const struct bead_sink *s)
{
    return s->makers;
}

const struct bead_sink_type bead_frame_sink = {
    .name = "frame",
    .help = "one frame of a movie",
    .kind = BEAD_OUTPUT_MOVIE,
    .one_frame = true,
    .create = frame_create,
    .needs = frame_needs,
    .begin = frame_begin,
    .sample = frame_sample,
    .scout = frame_scout,
    .again = frame_again,
    .end = frame_end,
    .destroy = frame_destroy,
    .result = frame_result,
    .makers = frame_makers,
    .looks_at_beads = bead_film_looks_at_beads,
};
