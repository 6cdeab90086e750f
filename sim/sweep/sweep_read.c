/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the file of a sweep, without trusting its contents, and merges parts. */
#include <float.h>
#include <inttypes.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/hdf5/h5.h"
#include "sim/scene/scene_internal.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/trajectory/file_kinds.h"
#include "sim/yaml/yaml.h"

enum bead_error bead_sweep_is(const char *path, bool *is, struct bead_message *msg)
{
    struct bead_h5 h5;
    char kind[32] = "";
    *is = false;
    if (!bead_h5_is(path))
        return BEAD_OK;
    bead_h5_open(&h5, path, "sweep", msg);
    if (!h5.error && bead_h5_has_attribute(&h5, "format"))
        bead_h5_get_text(&h5, h5.file, "format", kind, sizeof kind);
    bead_h5_shut(&h5);
    *is = strcmp(kind, BEAD_SWEEP_KIND) == 0;
    return h5.error;
}

/* Reads a panel: the `count` configurations of the file's part. */
struct reader {
    struct bead_h5 *h5;
    struct bead_sweep *sweep;
    struct sweep_panel *panel;
    size_t index, count;
    size_t *row; /* [count] */
    char name[64];
};

static const char *name_of(struct reader *r, const char *prefix, const char *name)
{
    snprintf(r->name, sizeof r->name, "/sweeps/%zu/%s%s", r->index, prefix, name);
    return r->name;
}

static void wrong(struct reader *r, const char *what)
{
    if (!r->h5->error)
        bead_h5_fail(r->h5, false, "%s has %s", r->name, what);
}

static void read_spins(struct reader *r, int64_t *whole)
{
    const size_t cells = r->panel->shown.spec->cells;
    bead_h5_read_numbers(r->h5, name_of(r, "", "configuration"), BEAD_H5_INT, whole, sizeof *whole, r->count);
    for (size_t i = 0; i < r->count && !r->h5->error; i++) {
        if (whole[i] != (int64_t)(r->row[i] - 1))
            wrong(r, "configurations of another part than the file claims to be");
    }
    if (bead_sweep_is_over(r->panel)) /* the scene has the values */
        return;
    BEAD_FREED unsigned char *bits = NULL;
    if (r->h5->error || (r->h5->error = bead_new(&bits, r->count * cells, r->h5->msg, "a sweep")))
        return;
    bead_h5_read_table(r->h5, name_of(r, "", "spins"), BEAD_H5_BYTE, r->count, cells, bits);
    for (size_t i = 0; i < r->count * cells && !r->h5->error; i++) {
        if (bits[i] > 1)
            wrong(r, "spins other than 0 and 1");
        r->panel->spins[r->row[i / cells] * cells + i % cells] = bits[i] ? '1' : '0';
    }
}

static double most_of(const struct reader *r, size_t column)
{
    if (bead_sweep_peak_columns[column].unit)
        return DBL_MAX;
    if (column == PEAK_OPEN)
        return 1;
    return bead_sweep_is_over(r->panel) ? UINT32_MAX : (double)(r->panel->shown.beads - 1);
}

static void read_peaks(struct reader *r, const char *prefix, const size_t *rows, size_t count, double *numbers, int64_t *whole)
{
    const size_t places = r->panel->shown.places;
    for (size_t c = 0; c < PEAK_COLUMNS; c++) {
        const struct sweep_peak_column *column = &bead_sweep_peak_columns[c];
        if (column->optional && !bead_h5_has(r->h5, name_of(r, prefix, column->name)))
            continue;
        bead_h5_read_table(r->h5, name_of(r, prefix, column->name), column->unit ? BEAD_H5_DOUBLE : BEAD_H5_INT, count, places,
                           column->unit ? (void *)numbers : whole);
        for (size_t i = 0; i < count * places && !r->h5->error; i++) {
            const double value = column->unit ? numbers[i] : (double)whole[i];
            const uint32_t number = (uint32_t)whole[i];
            if (!(value >= 0 && value <= most_of(r, c)) && !(column->unknown && isnan(value)))
                wrong(r, column->wrong);
            memcpy((char *)&r->panel->peaks[rows[i / places] * places + i % places] + column->offset,
                   column->unit ? (const void *)&value : &number, column->unit ? sizeof value : sizeof number);
        }
    }
}

static void read_profiles(struct reader *r, const char *prefix, const size_t *rows, size_t count, double *numbers)
{
    const size_t beads = r->panel->shown.beads;
    for (size_t what = 0; what < PROFILES; what++) {
        bead_h5_read_table(r->h5, name_of(r, prefix, bead_sweep_profiles[what].name), BEAD_H5_DOUBLE, count, beads, numbers);
        for (size_t i = 0; i < count * beads && !r->h5->error; i++) {
            if (!(numbers[i] >= 0) || !isfinite(numbers[i]))
                wrong(r, "a force or energy that is negative or not finite");
            r->panel->profiles[(PROFILES * rows[i / beads] + what) * beads + i % beads] = numbers[i];
        }
    }
}

static void read_results(struct reader *r, const char *prefix, const size_t *rows, size_t count, double *numbers, int64_t *whole)
{
    if (count > 0 && r->panel->shown.places > 0)
        read_peaks(r, prefix, rows, count, numbers, whole);
    if (count > 0 && r->panel->profiles)
        read_profiles(r, prefix, rows, count, numbers);
    for (size_t i = 0; i < count && !r->h5->error; i++)
        r->sweep->known[r->panel->first_job + rows[i]] = 1;
}

static enum bead_error read_panel(struct bead_h5 *h5, struct bead_sweep *sweep, size_t index, struct bead_message *msg)
{
    struct reader r = {.h5 = h5, .sweep = sweep, .panel = &sweep->panels[index], .index = index};
    const struct bead_sweep_panel *shown = &r.panel->shown;
    const size_t clean = 0, jobs = shown->configurations + 1;
    size_t wide = shown->places > shown->beads ? shown->places : shown->beads;
    BEAD_FREED size_t *rows = NULL;
    BEAD_FREED double *numbers = NULL;
    BEAD_FREED int64_t *whole = NULL;
    BEAD_TRY(bead_new(&rows, jobs, msg, "a sweep"));
    r.row = rows;
    for (size_t row = 1; row < jobs; row++) {
        if (bead_sweep_mine(sweep, r.panel->first_job + row))
            r.row[r.count++] = row;
    }
    BEAD_TRY(bead_new(&numbers, (r.count + 1) * (r.panel->profiles ? wide : shown->places + 1), msg, "a sweep"));
    BEAD_TRY(bead_new(&whole, (r.count + 1) * (shown->places + 1), msg, "a sweep"));
    memset(r.panel->spins, '1', jobs * shown->spec->cells);
    if (r.count)
        read_spins(&r, whole);
    read_results(&r, "", r.row, r.count, numbers, whole);
    read_results(&r, "reference_", &clean, bead_sweep_mine(sweep, r.panel->first_job), numbers, whole);
    return h5->error;
}

static enum bead_error read_scene(struct bead_h5 *h5, const struct bead_own *own, struct bead_scene **scene,
                                  struct bead_message *msg)
{
    BEAD_FREED char *text = bead_h5_read_text(h5, "/scene", BEAD_YAML_BYTES + 1);
    if (!text)
        return h5->error;
    BEAD_TRY(bead_scene_parse(h5->path, text, strlen(text), &(struct bead_overrides){.own = own}, scene, msg));
    if ((*scene)->sweep_count == 0)
        return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: its scene has no sweep", h5->path);
    return BEAD_OK;
}

static enum bead_error read_head(struct bead_h5 *h5, struct bead_sweep *sweep, struct bead_message *msg)
{
    char kind[32] = "", version[64] = "";
    bead_h5_get_text(h5, h5->file, "format", kind, sizeof kind);
    if (!h5->error && strcmp(kind, BEAD_SWEEP_KIND) != 0)
        bead_h5_fail(h5, false, "is not the file of a sweep");
    bead_h5_get_int(h5, h5->file, "format_version", BEAD_SWEEP_FORMAT, BEAD_SWEEP_FORMAT);
    bead_h5_get_text(h5, h5->file, "version", version, sizeof version);
    int64_t parts = bead_h5_get_int(h5, h5->file, "parts", 1, 1000000), part = bead_h5_get_int(h5, h5->file, "part", 1, parts);
    sweep->part = (size_t)part;
    sweep->parts = (size_t)parts;
    free(sweep->version);
    sweep->version = strdup(version);
    if (!sweep->version)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", h5->path);
    return h5->error;
}

static enum bead_error read_sweep(const char *path, const struct bead_own *own, struct bead_sweep **sweep, struct bead_message *msg)
{
    struct bead_h5 h5;
    struct bead_scene *scene = NULL;
    bead_h5_open(&h5, path, "sweep", msg);
    enum bead_error err = h5.error ? h5.error : read_scene(&h5, own, &scene, msg);
    if (!err)
        err = bead_sweep_allocate(scene, sweep, msg);
    if (!err) {
        (*sweep)->own_scene = scene;
        scene = NULL;
        err = read_head(&h5, *sweep, msg);
    }
    for (size_t p = 0; !err && p < (*sweep)->panel_count; p++)
        err = read_panel(&h5, *sweep, p, msg);
    bead_h5_shut(&h5);
    bead_scene_free(scene);
    return err;
}

enum bead_error bead_sweep_show(struct bead_sweep *sweep, struct bead_scene *scene, struct bead_message *msg)
{
    if (scene->fingerprint != sweep->scene->fingerprint) {
        bead_fail(msg, BEAD_ERROR_USAGE,
                  "%s: a setting would change what was computed; only outputs can be changed here: run the scene again",
                  scene->file);
        bead_scene_free(scene);
        return BEAD_ERROR_USAGE;
    }
    for (size_t p = 0; p < sweep->panel_count; p++) {
        sweep->panels[p].shown.spec = &scene->sweeps[p];
        sweep->panels[p].shown.name = scene->sweeps[p].name;
    }
    bead_scene_free(sweep->own_scene);
    sweep->scene = sweep->own_scene = scene;
    return BEAD_OK;
}

enum bead_error bead_sweep_open(const char *path, const struct bead_overrides *overrides, struct bead_sweep **sweep,
                                struct bead_message *msg)
{
    struct bead_scene *changed = NULL;
    *sweep = NULL;
    enum bead_error err = read_sweep(path, overrides ? overrides->own : NULL, sweep, msg);
    if (!err && overrides)
        err = bead_scene_change((*sweep)->scene, overrides, &changed, msg);
    if (!err && changed)
        err = bead_sweep_show(*sweep, changed, msg);
    if (err) {
        bead_sweep_close(*sweep);
        *sweep = NULL;
    }
    return err;
}

/* ---- merging ---- */

/* Fails unless a part belongs to the same sweep as the first one. */
static enum bead_error check_part(const struct bead_sweep *first, const char *first_path, const struct bead_sweep *part,
                                  const char *path, struct bead_message *msg)
{
    const char *differs = strcmp(part->version, first->version) != 0           ? "another version of the program"
                          : strcmp(part->scene->text, first->scene->text) != 0 ? "another scene"
                                                                               : NULL;
    if (differs)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: belongs to %s than %s", path, differs, first_path);
    if (part->parts != first->parts)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: is part %zu of %zu, but %s is one of %zu", path, part->part, part->parts,
                         first_path, first->parts);
    return BEAD_OK;
}

static void take_part(struct bead_sweep *all, const struct bead_sweep *part)
{
    for (size_t job = 0; job < all->jobs; job++) {
        size_t row = 0;
        if (!part->known[job])
            continue;
        struct sweep_panel *to = bead_sweep_panel_of(all, job, &row);
        const struct sweep_panel *from = &part->panels[to - all->panels];
        const size_t cells = to->shown.spec->cells, places = to->shown.places, profile = PROFILES * to->shown.beads;
        memcpy(to->spins + row * cells, from->spins + row * cells, cells);
        if (places)
            memcpy(to->peaks + row * places, from->peaks + row * places, places * sizeof *to->peaks);
        if (to->profiles)
            memcpy(to->profiles + row * profile, from->profiles + row * profile, profile * sizeof *to->profiles);
        all->known[job] = 1;
    }
}

static enum bead_error check_all(const struct bead_sweep *all, size_t parts, const size_t *file_of, struct bead_message *msg)
{
    char missing[200] = "";
    size_t count = 0;
    for (size_t k = 0; k < parts; k++) {
        size_t used = strlen(missing);
        if (file_of[k] == SIZE_MAX && count++ < 8)
            snprintf(missing + used, sizeof missing - used, "%s%zu", used ? ", " : "", k + 1);
    }
    if (count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "part%s %s%s of %zu %s missing", count > 1 ? "s" : "", missing,
                         count > 8 ? ", ..." : "", parts, count > 1 ? "are" : "is");
    for (size_t job = 0; job < all->jobs; job++) {
        if (!all->known[job])
            return bead_fail(msg, BEAD_ERROR_FORMAT, "the parts do not hold all configurations");
    }
    return BEAD_OK;
}

/* Adds a part to *all, or begins it with the first. `file_of`: the number of the file of each part; SIZE_MAX: none. */
static enum bead_error add_part(const char *const *paths, size_t i, struct bead_sweep **all, size_t **file_of,
                                struct bead_message *msg)
{
    struct bead_sweep *part;
    BEAD_TRY(bead_sweep_open(paths[i], NULL, &part, msg));
    enum bead_error err =
        *all ? check_part(*all, paths[0], part, paths[i], msg) : bead_new(file_of, part->parts, msg, "%zu parts", part->parts);
    if (!err && !*all)
        memset(*file_of, 0xff, part->parts * sizeof **file_of);
    size_t *file = err ? NULL : &(*file_of)[part->part - 1];
    if (!err && *file != SIZE_MAX)
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: is part %zu of %zu, as %s is", paths[i], part->part, part->parts, paths[*file]);
    if (!err)
        *file = i;
    if (!err && !*all) {
        *all = part;
        return BEAD_OK;
    }
    if (!err)
        take_part(*all, part);
    bead_sweep_close(part);
    return err;
}

enum bead_error bead_sweep_merge(const char *const *paths, size_t count, struct bead_sweep **sweep, struct bead_message *msg)
{
    *sweep = NULL;
    if (count == 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "no parts to merge");
    struct bead_sweep *all = NULL;
    BEAD_FREED size_t *file_of = NULL;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < count && !err; i++)
        err = add_part(paths, i, &all, &file_of, msg);
    if (!err)
        err = check_all(all, all->parts, file_of, msg);
    if (err) {
        bead_sweep_close(all);
        return err;
    }
    all->part = all->parts = 1;
    *sweep = all;
    return BEAD_OK;
}
