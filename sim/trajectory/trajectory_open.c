/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens a trajectory. The file is not trusted: all data are checked against the scene that it stores. */
#include "sim/trajectory/trajectory_data.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"
#include "sim/scene/scene_internal.h"
#include "sim/trajectory/file_kinds.h"

static const size_t longest_scene = 64 << 20; /* bytes */

enum bead_error bead_trajectory_no_memory(struct bead_trajectory *t)
{
    if (!t->h5.error)
        t->h5.error = bead_fail(t->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory to read it", t->path);
    return t->h5.error;
}

size_t bead_trajectory_longest(const struct bead_trajectory *t)
{
    size_t longest = 1;
    for (size_t c = 0; c < t->chain_count; c++)
        longest = bead_chain_beads(t->chains[c]) > longest ? bead_chain_beads(t->chains[c]) : longest;
    return longest;
}

bool bead_trajectory_is(const char *path)
{
    return bead_h5_is(path);
}

void bead_trajectory_close(struct bead_trajectory *t)
{
    if (!t)
        return;
    t->h5.msg = NULL;
    for (size_t i = 0; i < BEAD_SERIES_COUNT; i++) {
        bead_h5_close(&t->h5, &t->sources[i].value);
        free(t->sources[i].block);
        free(t->sources[i].scratch);
    }
    bead_h5_shut(&t->h5);
    for (size_t c = 0; t->chains && c < t->chain_count; c++)
        bead_chain_destroy(t->chains[c]);
    free(t->chains);
    bead_scene_free(t->scene);
    free(t->rows);
    free(t->forces);
    free(t->outcomes);
    free(t->bounds);
    free(t->methods);
    free(t->path);
    free(t);
}

/* Blank-separated names to BEAD_FIELD_BITs. */
static unsigned parse_fields(struct bead_trajectory *t, char *names)
{
    unsigned fields = 0;
    char *rest = NULL;
    for (char *name = strtok_r(names, " ", &rest); name; name = strtok_r(NULL, " ", &rest)) {
        int f = 0;
        while (f < BEAD_FIELD_COUNT && strcmp(name, bead_field_info(f)->name) != 0)
            f++;
        if (f == BEAD_FIELD_COUNT)
            bead_h5_fail(&t->h5, false, "holds an unknown field");
        else
            fields |= BEAD_FIELD_BIT(f);
    }
    return fields;
}

static enum bead_error read_summary(struct bead_trajectory *t)
{
    struct bead_h5 *h5 = &t->h5;
    char names[256] = "";
    hid_t group = bead_h5_open_group(h5, BEAD_PROFILE_GROUP);
    bead_h5_get_int(h5, group, "profile", BEAD_TRAJECTORY_PROFILE, BEAD_TRAJECTORY_PROFILE);
    t->complete = bead_h5_get_int(h5, group, "complete", 0, 1) == 1;
    bead_h5_get_text(h5, group, "fields", names, sizeof names);
    t->fields = parse_fields(t, names);
    t->grid.start = bead_h5_get_double(h5, group, "start");
    t->grid.every = bead_h5_get_double(h5, group, "every");
    t->end = bead_h5_get_double(h5, group, "end");
    t->span.first = (size_t)bead_h5_get_int(h5, group, "first_bead", 0, INT64_MAX);
    int64_t last = bead_h5_get_int(h5, group, "last_bead", -1, INT64_MAX);
    t->span.last = last < 0 ? SIZE_MAX : (size_t)last;
    bead_h5_close(h5, &group);
    if (!h5->error &&
        !(t->grid.start >= 0 && t->grid.start < 1e9 && t->grid.every > 0 && t->grid.every < 1e9 && t->end >= 0 && t->end < 1e9))
        bead_h5_fail(h5, false, "its times are not valid");
    if (!h5->error && t->fields == 0)
        bead_h5_fail(h5, false, "holds no field");
    return h5->error;
}

static enum bead_error read_scene(struct bead_trajectory *t, const struct bead_own *own)
{
    BEAD_FREED char *text = bead_h5_read_text(&t->h5, BEAD_PROFILE_GROUP "/scene", longest_scene);
    if (!text)
        return t->h5.error;
    return bead_scene_parse(t->path, text, strlen(text), &(struct bead_overrides){.own = own}, &t->scene, t->h5.msg);
}

static enum bead_error rebuild(struct bead_trajectory *t)
{
    t->chains = calloc(t->scene->chain_count, sizeof *t->chains);
    t->rows = calloc(t->scene->chain_count, sizeof *t->rows);
    t->outcomes = calloc(t->scene->chain_count, sizeof *t->outcomes);
    t->methods = calloc(t->scene->chain_count, sizeof *t->methods);
    if (!t->chains || !t->rows || !t->outcomes || !t->methods)
        return bead_trajectory_no_memory(t);
    for (; t->chain_count < t->scene->chain_count; t->chain_count++) {
        BEAD_TRY(bead_chain_create(t->scene, t->chain_count, &t->chains[t->chain_count], t->h5.msg));
    }
    bead_trajectory_rows((const struct bead_chain *const *)t->chains, t->chain_count, t->span, t->rows, &t->beads, &t->contacts);
    return t->beads > 0 ? BEAD_OK : bead_h5_fail(&t->h5, false, "holds no bead of its scene");
}

/* Check the stored beads against those of the scene: materials may have changed since the run. */
static enum bead_error check_beads(struct bead_trajectory *t, const char *name, const double *(*values)(const struct bead_chain *))
{
    BEAD_FREED double *stored = t->h5.error ? NULL : calloc(t->beads, sizeof *stored);
    if (!stored)
        return bead_trajectory_no_memory(t);
    bead_h5_read_numbers(&t->h5, name, BEAD_H5_DOUBLE, stored, sizeof *stored, t->beads);
    for (size_t c = 0; !t->h5.error && c < t->chain_count; c++) {
        const struct bead_rows *beads = &t->rows[c].beads;
        const double *wanted = values(t->chains[c]) + beads->first, *found = stored + beads->row;
        for (size_t i = 0; i < beads->count; i++) {
            if (fabs(found[i] - wanted[i]) <= 1e-12 * fabs(wanted[i]))
                continue;
            bead_h5_fail(&t->h5, false, "%s of bead %zu is %g, but its scene and today's materials give %g", name, beads->first + i,
                         found[i], wanted[i]);
            break;
        }
    }
    return t->h5.error;
}

static enum bead_error open_sources(struct bead_trajectory *t)
{
    size_t rows;
    t->samples = SIZE_MAX;
    for (int id = 0; id < BEAD_SERIES_COUNT; id++) {
        if (!bead_series[id].stored || !(t->fields & BEAD_FIELD_BIT(bead_series[id].field)))
            continue;
        char name[128];
        snprintf(name, sizeof name, "%s/value", bead_series[id].group);
        struct bead_source *source = &t->sources[id];
        source->columns = bead_series[id].of_contacts ? t->contacts : t->beads;
        if (source->columns == 0)
            return bead_h5_fail(&t->h5, false, "holds values of contacts, but its scene has no contacts there");
        source->value = bead_h5_open_series(&t->h5, name, source->columns, bead_series[id].components, &rows);
        if (t->h5.error)
            return t->h5.error;
        t->samples = rows < t->samples ? rows : t->samples;
    }
    t->block_rows = bead_trajectory_chunk_rows(t->beads, t->contacts);
    return BEAD_OK;
}

/* Check the times against the grid. Datasets of a killed run may differ in length: the shortest counts. */
static enum bead_error check_times(struct bead_trajectory *t)
{
    double times[1024];
    size_t rows = 0;
    hid_t series = bead_h5_open_series(&t->h5, "/time", 0, 1, &rows);
    t->samples = rows < t->samples ? rows : t->samples;
    if (t->samples > t->h5.bytes / sizeof(double))
        bead_h5_fail(&t->h5, false, "claims %zu samples, more than the file can hold", t->samples);
    for (size_t first = 0; !t->h5.error && first < t->samples; first += 1024) {
        size_t count = t->samples - first < 1024 ? t->samples - first : 1024;
        bead_h5_read_rows(&t->h5, series, first, count, 0, times);
        for (size_t i = 0; !t->h5.error && i < count; i++)
            if (!(fabs(times[i] - bead_grid_time(&t->grid, first + i)) <= 1e-6 * t->grid.every))
                bead_h5_fail(&t->h5, false, "the time of sample %zu is %g s, must be %g s", first + i, times[i],
                             bead_grid_time(&t->grid, first + i));
    }
    bead_h5_close(&t->h5, &series);
    t->grid.end = t->samples ? bead_grid_time(&t->grid, t->samples - 1) : t->grid.start - t->grid.every;
    if (!t->h5.error && t->samples && bead_grid_count(&t->grid) != t->samples)
        bead_h5_fail(&t->h5, false, "its times are not valid");
    return t->h5.error;
}

static enum bead_error read_outcomes(struct bead_trajectory *t)
{
    struct bead_outcome *all = t->outcomes;
    const size_t n = t->chain_count, size = sizeof *all;
    const bool there = bead_h5_has(&t->h5, BEAD_PROFILE_GROUP "/outcome/evaluations"); /* written last */
    for (size_t i = 0; i < bead_outcome_column_count; i++) {
        const size_t offset = bead_outcome_columns[i].offset;
        char name[128];
        snprintf(name, sizeof name, "%s/outcome/%s", BEAD_PROFILE_GROUP, bead_outcome_columns[i].name);
        for (size_t c = 0; c < n; c++)
            memcpy((char *)&all[c] + offset, &(double){NAN}, sizeof(double));
        if (there && bead_h5_has(&t->h5, name))
            bead_h5_read_numbers(&t->h5, name, BEAD_H5_DOUBLE, (char *)all + offset, size, n);
    }
    if (there) {
        bead_h5_read_texts(&t->h5, BEAD_PROFILE_GROUP "/outcome/method", t->methods, n);
        bead_h5_read_numbers(&t->h5, BEAD_PROFILE_GROUP "/outcome/steps", BEAD_H5_INT, &all->steps, size, n);
        bead_h5_read_numbers(&t->h5, BEAD_PROFILE_GROUP "/outcome/evaluations", BEAD_H5_INT, &all->evaluations, size, n);
    }
    for (size_t c = 0; c < n; c++) {
        all[c].method = t->methods[c].text;
        all[c].absorbed = NAN; /* not stored */
    }
    return t->h5.error;
}

/* Reads what the file says about the errors of its samples: NaN is unknown, a number below 0 is invalid. */
static enum bead_error read_bounds(struct bead_trajectory *t)
{
    const size_t count = t->chain_count * BEAD_FIELD_COUNT;
    if (!bead_h5_has(&t->h5, BEAD_PROFILE_GROUP "/uncertainty"))
        return t->h5.error;
    BEAD_TRY(bead_new(&t->bounds, count, t->h5.msg, "the uncertainties of a trajectory"));
    for (size_t i = 0; i < count; i++)
        t->bounds[i] = NAN;
    for (int id = 0; id < BEAD_SERIES_COUNT; id++) {
        char name[128];
        snprintf(name, sizeof name, BEAD_PROFILE_GROUP "/uncertainty%s", strrchr(bead_series[id].group, '/'));
        if (bead_series[id].stored && t->fields & BEAD_FIELD_BIT(bead_series[id].field) && bead_h5_has(&t->h5, name))
            bead_h5_read_numbers(&t->h5, name, BEAD_H5_DOUBLE, t->bounds + bead_series[id].field,
                                 BEAD_FIELD_COUNT * sizeof *t->bounds, t->chain_count);
    }
    for (size_t i = 0; i < count && !t->h5.error; i++) {
        if (t->bounds[i] < 0 || isinf(t->bounds[i]))
            bead_h5_fail(&t->h5, false, "holds an uncertainty that is negative or not finite");
    }
    return t->h5.error;
}

static enum bead_error load(struct bead_trajectory *t)
{
    BEAD_TRY(rebuild(t));
    if (t->scene->chains[0].system->has_contacts) {
        BEAD_TRY(check_beads(t, "/particles/chain/mass", bead_chain_mass));
        BEAD_TRY(check_beads(t, "/particles/chain/radius", bead_chain_radius));
    }
    BEAD_TRY(check_beads(t, "/particles/chain/rest_position", bead_chain_position));
    BEAD_TRY(open_sources(t));
    BEAD_TRY(check_times(t));
    BEAD_TRY(read_bounds(t));
    return read_outcomes(t);
}

static unsigned derivable(const struct bead_trajectory *t)
{
    const bool all =
        t->fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) && t->span.first == 0 && t->span.last >= bead_trajectory_longest(t) - 1;
    return all ? bead_chains_derivable((const struct bead_chain *const *)t->chains, t->chain_count) & ~t->fields : 0;
}

static bool is_sweep(struct bead_trajectory *t)
{
    char kind[32] = "";
    if (bead_h5_has_attribute(&t->h5, "format"))
        bead_h5_get_text(&t->h5, t->h5.file, "format", kind, sizeof kind);
    return strcmp(kind, BEAD_SWEEP_KIND) == 0;
}

/* Read the file up to its scene. `sweep` is set for a sweep's file, of which nothing else is read. */
static enum bead_error open_file(struct bead_trajectory *t, const char *path, bool *sweep, struct bead_message *msg)
{
    t->h5.file = -1;
    for (size_t i = 0; i < BEAD_SERIES_COUNT; i++)
        t->sources[i].value = -1;
    BEAD_TRY(bead_file_join(NULL, path, &t->path, msg));
    bead_h5_open(&t->h5, t->path, "trajectory", msg);
    *sweep = !t->h5.error && is_sweep(t);
    if (!t->h5.error && !*sweep)
        read_summary(t);
    return t->h5.error;
}

enum bead_error bead_trajectory_begin(const char *path, const struct bead_own *own, struct bead_trajectory **trajectory,
                                      struct bead_message *msg)
{
    bool sweep = false;
    struct bead_trajectory *t = *trajectory = calloc(1, sizeof *t);
    if (!t)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: no memory to read it", path);
    enum bead_error err = open_file(t, path, &sweep, msg);
    if (!err && !sweep)
        err = read_scene(t, own);
    t->h5.msg = NULL;
    if (sweep) {
        bead_trajectory_close(t);
        *trajectory = NULL;
    }
    return err;
}

static void take_scene(struct bead_trajectory *t, struct bead_scene *scene)
{
    bead_scene_free(t->scene);
    t->scene = scene;
}

/* Leaves one chain, which is then that of the changed scene; its rows stay where they are. */
static enum bead_error narrow(struct bead_trajectory *t, struct bead_scene *changed, size_t only)
{
    for (size_t c = 0; c < t->chain_count; c++)
        bead_chain_destroy(t->chains[c]);
    t->chain_count = 0;
    t->rows[0] = t->rows[only];
    t->outcomes[0] = t->outcomes[only];
    t->methods[0] = t->methods[only];
    t->outcomes[0].method = t->methods[0].text;
    if (t->bounds)
        memmove(t->bounds, t->bounds + only * BEAD_FIELD_COUNT, BEAD_FIELD_COUNT * sizeof *t->bounds);
    take_scene(t, changed);
    BEAD_TRY(bead_chain_create(t->scene, 0, &t->chains[0], t->h5.msg));
    t->chain_count = 1;
    return t->rows[0].beads.count > 0 ? BEAD_OK : bead_h5_fail(&t->h5, false, "holds no bead of this chain");
}

enum bead_error bead_trajectory_settle(struct bead_trajectory *t, struct bead_scene *changed, size_t only, struct bead_message *msg)
{
    t->h5.msg = msg;
    if (changed && only == SIZE_MAX)
        take_scene(t, changed);
    enum bead_error err = load(t);
    if (only != SIZE_MAX && err)
        bead_scene_free(changed);
    else if (only != SIZE_MAX)
        err = narrow(t, changed, only);
    if (!err)
        t->derived = derivable(t);
    t->h5.msg = NULL;
    return err;
}

enum bead_error bead_trajectory_open(const char *path, const struct bead_overrides *overrides, struct bead_trajectory **trajectory,
                                     struct bead_message *msg)
{
    struct bead_scene *changed = NULL;
    enum bead_error err = bead_trajectory_begin(path, overrides ? overrides->own : NULL, trajectory, msg);
    if (!err && !*trajectory)
        return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: is a sweep's file, not a trajectory", path);
    if (!err && overrides)
        err = bead_scene_change((*trajectory)->scene, overrides, &changed, msg);
    if (!err)
        err = bead_trajectory_settle(*trajectory, changed, SIZE_MAX, msg);
    if (err) {
        bead_trajectory_close(*trajectory);
        *trajectory = NULL;
    }
    return err;
}
