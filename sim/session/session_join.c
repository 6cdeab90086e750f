/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Several trajectories as one source of samples: their chains side by side, or the difference of two. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/kinds/scene_facts.h"
#include "sim/session/session_data.h"
#include "sim/trajectory/trajectory_data.h"

/* A chain of one of the files. */
struct joined_chain {
    struct bead_trajectory *trajectory;
    size_t number;
};

struct bead_joined {
    struct bead_trajectory **others; /* the first is the session's */
    size_t other_count, chain_count;
    struct joined_chain *of; /* [chains] */
    const struct bead_chain **chains;
    struct bead_chain_spec *shown; /* of all chains; borrowed */
    size_t shown_count;
    double *values[2][BEAD_FIELD_COUNT]; /* [beads of the longest]: of a sample, and of the sample to compare with */
    bool difference;
    struct bead_system system; /* for differences */
};

/* ---- samples ---- */

/* A difference may have either sign, whatever the field. */
static bool difference_signed(const struct bead_chain_spec *, enum bead_field)
{
    return true;
}

static const struct bead_field_info *difference_field(enum bead_field field)
{
#define PLACE_BEAD                                   0
#define PLACE_CONTACT                                1
#define DIFFERENCE_ROW(id, name, unit, title, place) {name, unit, "difference in " title, PLACE_##place},
    static const struct bead_field_info fields[BEAD_FIELD_COUNT] = {BEAD_FIELDS(DIFFERENCE_ROW)};
    return &fields[field];
}

/* Values at a time: stored ones, or linearly interpolated between the two samples around it. */
static enum bead_error read_at(const struct joined_chain *of, double time, unsigned fields, double *const into[BEAD_FIELD_COUNT],
                               struct bead_message *msg)
{
    static const double near = 1e-6;
    struct bead_trajectory *t = of->trajectory;
    const struct bead_grid *grid = bead_trajectory_grid(t);
    const struct bead_chain *chain = t->chains[of->number];
    const size_t beads = bead_chain_beads(chain), contacts = bead_chain_contacts(chain), count = bead_grid_count(grid);
    const double place = grid->every > 0 ? (time - grid->start) / grid->every : 0, whole = floor(place + near);
    const double part = place - whole > near ? place - whole : 0;
    if (!(whole >= 0) || !(whole + (part > 0) < (double)count))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s has no sample at %.9g s", t->path, time);
    for (int side = 0; side < 1 + (part > 0); side++) {
        struct bead_sample sample;
        BEAD_TRY(bead_trajectory_read(t, (size_t)whole + (size_t)side, of->number, fields, &sample, msg));
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
            for (size_t j = 0; sample.field[f] && j < (bead_field_info(f)->of_contacts ? contacts : beads); j++)
                into[f][j] = side == 0 ? sample.field[f][j] : into[f][j] + part * (sample.field[f][j] - into[f][j]);
        }
    }
    return BEAD_OK;
}

static enum bead_error read_joined(const struct bead_stored *stored, double time, unsigned fields, struct bead_sample *sample,
                                   struct bead_message *msg)
{
    const struct bead_joined *j = stored->context;
    const size_t chain = sample->chain, beads = bead_chain_beads(j->chains[chain]);
    *sample = (struct bead_sample){.chain = chain, .time = time, .active = beads, .comparison_active = beads};
    BEAD_TRY(read_at(&j->of[chain], time, fields, j->values[0], msg));
    if (j->difference)
        BEAD_TRY(read_at(&j->of[j->chain_count + chain], time, fields, j->values[1], msg));
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        if (!(fields & BEAD_FIELD_BIT(f)))
            continue;
        sample->field[f] = j->values[0][f];
        if (!j->difference)
            continue;
        for (size_t i = 0; i < beads; i++)
            j->values[1][f][i] -= j->values[0][f][i];
        sample->field[f] = j->values[1][f];
        sample->comparison[f] = j->values[0][f]; /* the values they differ from */
    }
    return BEAD_OK;
}

/* ---- their errors ---- */

/* Do both have the same sample times? If not, samples are interpolated linearly, with an error that no bound includes. */
static bool are_together(const struct bead_trajectory *a, const struct bead_trajectory *b)
{
    static const double near = 1e-6;
    return fabs(a->grid.every - b->grid.every) <= near * near * a->grid.every &&
           fabs(a->grid.start - b->grid.start) <= near * a->grid.every;
}

const struct bead_trajectory *bead_session_file_of(const struct bead_session *s, size_t *number)
{
    const struct joined_chain of = s->joined ? s->joined->of[*number] : (struct joined_chain){s->trajectory, *number};
    *number = of.number;
    return of.trajectory;
}

/* The bound of the errors of a chain's field; NaN: unknown. */
static double bound_of(const struct bead_session *s, size_t chain, size_t field)
{
    const struct bead_trajectory *t = bead_session_file_of(s, &chain);
    const bool known = t->bounds && are_together(s->trajectory, t);
    return known ? t->bounds[chain * BEAD_FIELD_COUNT + field] : NAN;
}

enum bead_error bead_session_bound(struct bead_session *s, struct bead_message *msg)
{
    const bool difference = s->joined && s->joined->difference;
    bool any = false;
    BEAD_TRY(bead_new(&s->bounds, s->chain_count * BEAD_FIELD_COUNT, msg, "the uncertainties of trajectories"));
    for (size_t c = 0; c < s->chain_count; c++) {
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
            double *bound = &s->bounds[c * BEAD_FIELD_COUNT + f];
            *bound = bound_of(s, c, f) + (difference ? bound_of(s, s->chain_count + c, f) : 0);
            any = any || !isnan(*bound);
        }
    }
    if (!any) {
        free(s->bounds);
        s->bounds = NULL;
    }
    return BEAD_OK;
}

/* ---- opening ---- */

/* Chains of several files take the names of the files. */
static enum bead_error name_chains(struct bead_trajectory *t, const char *path, struct bead_message *msg)
{
    const char *dot = strrchr(bead_session_base_name(path), '.');
    const int length = dot ? (int)(dot - path) : (int)strlen(path);
    for (size_t i = 0; i < t->scene->chain_count; i++) {
        struct bead_chain_spec *spec = &t->scene->chains[i];
        char *name = NULL, *title = NULL;
        const bool several = t->scene->chain_count > 1;
        if (asprintf(&name, "%.*s%s%s", length, path, several ? "/" : "", several ? spec->name : "") < 0)
            return bead_session_out_of_memory(msg);
        title = strdup(name);
        free(spec->name);
        free(spec->title);
        spec->name = name;
        spec->title = title ? title : spec->name;
        if (!title)
            return bead_session_out_of_memory(msg);
    }
    return BEAD_OK;
}

static enum bead_error check_kind(const struct bead_trajectory *t, const struct bead_trajectory *first, struct bead_message *msg)
{
    const bool beads = !bead_scene_system(t->scene)->equation;
    if (beads == !bead_scene_system(first->scene)->equation)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "%s: is of %s, and %s of %s; their axes differ", t->path,
                     beads ? "beads" : "an equation", first->path, beads ? "an equation" : "beads");
}

static enum bead_error open_others(struct bead_session *s, struct bead_joined *j, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&j->others, s->job.other_count, msg, "trajectories"));
    for (; j->other_count < s->job.other_count; j->other_count++)
        BEAD_TRY(bead_trajectory_open(s->job.others[j->other_count], NULL, &j->others[j->other_count], msg));
    for (size_t i = 0; i < j->other_count; i++)
        BEAD_TRY(check_kind(j->others[i], s->trajectory, msg));
    return BEAD_OK;
}

/* Outputs are checked against the chains of all files, in whatever order these are given. */
static enum bead_error list_shown(struct bead_session *s, struct bead_joined *j, struct bead_message *msg)
{
    size_t all = s->trajectory->scene->chain_count;
    for (size_t i = 0; i < j->other_count; i++)
        all += j->others[i]->scene->chain_count;
    BEAD_TRY(bead_new(&j->shown, all, msg, "trajectories"));
    for (size_t i = 0; i <= j->other_count; i++) {
        struct bead_trajectory *t = i == 0 ? s->trajectory : j->others[i - 1];
        BEAD_TRY(name_chains(t, i == 0 ? s->job.input : s->job.others[i - 1], msg));
        memcpy(j->shown + j->shown_count, t->scene->chains, t->scene->chain_count * sizeof *j->shown);
        j->shown_count += t->scene->chain_count;
    }
    return BEAD_OK;
}

enum bead_error bead_session_open_others(struct bead_session *s, struct bead_message *msg)
{
    if (s->job.other_count == 0)
        return s->job.difference
                   ? bead_fail(msg, BEAD_ERROR_USAGE, "--diff: needs two trajectories, as in --diff a.h5 b.h5 -o diff.png")
                   : BEAD_OK;
    BEAD_TRY(bead_new(&s->joined, 1, msg, "trajectories"));
    s->joined->difference = s->job.difference;
    BEAD_TRY(open_others(s, s->joined, msg));
    return s->joined->difference ? BEAD_OK : list_shown(s, s->joined, msg);
}

struct bead_chain_spec *bead_session_shown(const struct bead_session *s, size_t *count)
{
    *count = s->joined ? s->joined->shown_count : 0;
    return s->joined ? s->joined->shown : NULL;
}

/* Adds its chains to the joined ones, and finds the times that all files have. */
static void add_file(struct bead_session *s, struct bead_joined *j, struct bead_trajectory *t, size_t *used)
{
    for (size_t i = 0; i < t->chain_count; i++)
        j->of[(*used)++] = (struct joined_chain){t, i};
    s->end = fmin(s->end, t->end);
    s->stored.last = fmin(s->stored.last, bead_trajectory_grid(t)->end);
    if (t->grid.start > s->native.start) /* all begin at the session's first sample that is not before their own */
        s->native.start += s->native.every * ceil((t->grid.start - s->native.start) / s->native.every - 1e-6);
}

/* A difference requires chains that are alike. */
static enum bead_error check_alike(const struct bead_session *s, const struct bead_joined *j, struct bead_message *msg)
{
    const struct bead_trajectory *a = s->trajectory, *b = j->others[0];
    bool alike = j->other_count == 1 && a->chain_count == b->chain_count;
    for (size_t i = 0; alike && i < a->chain_count; i++)
        alike = bead_chain_beads(a->chains[i]) == bead_chain_beads(b->chains[i]);
    return alike ? BEAD_OK
                 : bead_fail(msg, BEAD_ERROR_USAGE,
                             "--diff: needs two trajectories of as many chains, each of as many beads: %s, %s", a->path, b->path);
}

static enum bead_error join(struct bead_session *s, struct bead_joined *j, struct bead_message *msg)
{
    size_t all = s->trajectory->chain_count, used = 0, longest = bead_trajectory_longest(s->trajectory);
    BEAD_TRY(j->difference ? check_alike(s, j, msg) : name_chains(s->trajectory, s->job.input, msg));
    for (size_t i = 0; i < j->other_count; i++) {
        all += j->others[i]->chain_count;
        longest = bead_trajectory_longest(j->others[i]) > longest ? bead_trajectory_longest(j->others[i]) : longest;
    }
    BEAD_TRY(bead_new(&j->of, all, msg, "trajectories"));
    BEAD_TRY(bead_new(&j->chains, all, msg, "trajectories"));
    for (int side = 0; side < 1 + j->difference; side++) {
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
            BEAD_TRY(bead_new(&j->values[side][f], longest, msg, "samples of trajectories"));
    }
    add_file(s, j, s->trajectory, &used);
    for (size_t i = 0; i < j->other_count; i++)
        add_file(s, j, j->others[i], &used);
    for (size_t i = 0; i < all; i++)
        j->chains[i] = j->of[i].trajectory->chains[j->of[i].number];
    j->chain_count = j->difference ? s->trajectory->chain_count : all;
    return BEAD_OK;
}

enum bead_error bead_session_join(struct bead_session *s, struct bead_message *msg)
{
    struct bead_joined *j = s->joined;
    if (!j)
        return BEAD_OK;
    BEAD_TRY(join(s, j, msg));
    s->stored.read = read_joined;
    s->stored.context = j;
    s->chains = (const struct bead_chain *const *)j->chains;
    s->chain_count = j->chain_count;
    s->native.end = fmin(s->native.end, s->stored.last);
    s->end = s->needed = fmin(s->end, s->native.end);
    for (size_t i = 0; i < s->trajectory->scene->chain_count && j->difference; i++) {
        struct bead_chain_spec *spec = &s->trajectory->scene->chains[i];
        if (i == 0) {
            j->system = *spec->system;
            j->system.field_signed = difference_signed;
            j->system.field = spec->system->has_contacts ? difference_field : spec->system->field;
        }
        spec->system = &j->system;
    }
    return BEAD_OK;
}

const struct bead_trajectory *bead_session_file(const struct bead_session *s, size_t index)
{
    const size_t others = s->joined ? s->joined->other_count : 0;
    return index == 0 ? s->trajectory : index <= others ? s->joined->others[index - 1] : NULL;
}

void bead_session_part(struct bead_session *s)
{
    struct bead_joined *j = s->joined;
    if (!j)
        return;
    for (size_t i = 0; i < j->other_count; i++)
        bead_trajectory_close(j->others[i]);
    for (int side = 0; side < 2; side++) {
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
            free(j->values[side][f]);
    }
    free(j->others);
    free(j->of);
    free(j->chains);
    free(j->shown);
    free(j);
}
