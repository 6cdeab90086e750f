/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of a scouting run: typical values, for the range of colours, and, if they are few, all of them, for images that show
 * their future. */
#include "render/movie/film.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/view/area.h"
#include "sim/kinds/view_kinds.h"

/* Most values to keep: of 1000 beads in 2000 frames, or ten times as many if the run is needed for its range anyway. */
static const double most_values = 2e6, most_scouted = 2e7;
/* The size of the image that gives a typical value. */
enum { COLUMNS = 256, PLACES = 512 };

struct bead_preview {
    size_t chains, samples, room; /* room: values of a sample of a chain */
    struct bead_area **area;      /* [chains] */
    double *time;                 /* [samples] */
    double *value;                /* [samples][chains][room]; NULL: not kept */
    size_t *active;               /* [samples][chains] */
    double *away; /* [room]: the largest distances of forces from those at rest, of any chain; NULL: none is pressed */
    size_t next;
};

static bool range_is_asked(const struct bead_film *film)
{
    return !isnan(film->output->colours.range[0]) && !isnan(film->output->colours.range[1]);
}

/* One field of one run: not for images that compare two runs, nor for those that also read forces. */
static bool is_kept(const struct bead_film *film)
{
    const struct bead_views_asked *views = &film->output->views;
    const struct bead_shown *shown = &film->output->shown;
    const bool wanted = bead_views_any(views, BEAD_SHOWS_IMAGE) && !shown->trust && !shown->theory;
    double values = (double)bead_grid_count(&film->times.grid) * (double)film->context.chain_count * (double)(film->last_bead + 1);
    return wanted && values <= (range_is_asked(film) ? most_values : most_scouted);
}

bool bead_film_scouts(const struct bead_film *film)
{
    return !range_is_asked(film) || is_kept(film);
}

static void preview_free(struct bead_preview *p)
{
    for (size_t i = 0; p && p->area && i < p->chains; i++)
        bead_area_destroy(p->area[i]);
    if (p) {
        free(p->area);
        free(p->time);
        free(p->value);
        free(p->active);
        free(p->away);
    }
    free(p);
}

void bead_film_free(struct bead_film *film)
{
    preview_free(film->preview);
    film->preview = NULL;
}

static enum bead_error preview_create(struct bead_film *film, struct bead_message *msg)
{
    struct bead_preview *p = film->preview = calloc(1, sizeof *p);
    const bool pressed = bead_colour_range_rest(film->context.chains, film->context.chain_count, film->output->shown.field) > 0;
    const size_t chains = film->context.chain_count, beads = film->last_bead + 1 - film->output->shown.beads.first;
    const struct bead_area_setup setup = {.beads = {film->output->shown.beads.first, film->last_bead},
                                          .time = {film->times.time[0], film->times.time[1]},
                                          .places = beads < PLACES ? (int)beads : PLACES,
                                          .columns = COLUMNS};
    if (p) {
        p->chains = chains;
        p->samples = bead_grid_count(&film->times.grid) + 1;
        p->room = film->last_bead + 1;
        p->area = calloc(chains, sizeof(struct bead_area *));
        p->time = calloc(p->samples, sizeof *p->time);
        p->active = calloc(p->samples * chains, sizeof *p->active);
        p->away = pressed ? calloc(p->room, sizeof *p->away) : NULL;
        p->value = is_kept(film) ? calloc(p->samples * chains * p->room, sizeof *p->value) : NULL;
    }
    if (!p || !p->area || !p->time || !p->active || (pressed && !p->away) || (is_kept(film) && !p->value))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a preview");
    for (size_t i = 0; i < chains; i++)
        BEAD_TRY(bead_area_create(&setup, &p->area[i], msg));
    return BEAD_OK;
}

/* The number of a chain's beads, or of its contacts. */
static size_t count_of(const struct bead_film *film, size_t chain)
{
    const struct bead_chain *own = film->context.chains[chain];
    size_t all = bead_field_info(film->output->shown.field)->of_contacts ? bead_chain_contacts(own) : bead_chain_beads(own);
    return all < film->last_bead + 1 ? all : film->last_bead + 1;
}

static void keep_away(struct bead_film *film, size_t chain, const double *row, size_t count)
{
    const struct bead_chain *own = film->context.chains[chain];
    double *away = film->preview->away;
    for (size_t i = film->output->shown.beads.first; away && i < count; i++)
        away[i] = fmax(away[i], fabs(row[i] - bead_force_at_rest(own, film->output->shown.field, i)));
}

enum bead_error bead_film_scout(struct bead_film *film, const struct bead_sample *sample, struct bead_message *msg)
{
    enum bead_error err = film->preview ? BEAD_OK : preview_create(film, msg);
    const double *values = sample->field[film->output->shown.field];
    struct bead_preview *p = film->preview;
    if (err || !values || p->next >= p->samples)
        return err;
    size_t count = count_of(film, sample->chain), at = p->next * p->chains + sample->chain, first = film->output->shown.beads.first;
    double *row = p->value ? p->value + at * p->room : calloc(p->room, sizeof *row);
    if (!row)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a preview");
    if (count > first) /* shorter chains end in zeros */
        memcpy(row + first, values + first, (count - first) * sizeof *row);
    bead_area_feed(p->area[sample->chain], sample->time, row, sample->active);
    keep_away(film, sample->chain, row, count);
    p->time[p->next] = sample->time;
    p->active[at] = sample->active;
    p->next += sample->chain + 1 == p->chains;
    if (!p->value)
        free(row);
    return BEAD_OK;
}

double bead_preview_typical(const struct bead_preview *p)
{
    double most = 0, away;
    for (size_t i = 0; i < p->chains; i++)
        most = fmax(most, bead_area_typical(p->area[i], 0, &away));
    return most > 0 ? most : INFINITY;
}

void bead_preview_away(const struct bead_preview *p, double *largest, double *usual)
{
    *usual = p->away ? bead_area_quantile(p->away, p->room, 0.9) : 0;
    *largest = p->away ? p->away[p->room - 1] : 0; /* sorted */
}

bool bead_preview_whole(const struct bead_preview *p)
{
    return p->value != NULL;
}

enum bead_error bead_preview_feed(const struct bead_preview *p, size_t chain, const struct bead_view_type *type,
                                  struct bead_view *view, struct bead_message *msg)
{
    for (size_t i = 0; i < p->next; i++) {
        struct bead_sample sample = {.chain = chain, .index = i, .time = p->time[i], .active = p->active[i * p->chains + chain]};
        for (unsigned f = 0; f < BEAD_FIELD_COUNT; f++) /* the only field that images read */
            sample.field[f] = p->value + (i * p->chains + chain) * p->room;
        BEAD_TRY(type->feed(view, &sample, msg));
    }
    return BEAD_OK;
}
