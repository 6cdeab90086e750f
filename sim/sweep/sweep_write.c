/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the file of a finished sweep; beadreel/sweep.h describes its contents. */
#include <stdlib.h>
#include <unistd.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/hdf5/h5.h"
#include "sim/sweep/sweep_data.h"
#include "sim/trajectory/file_kinds.h"

/* Rows of a panel in the file: numbers of jobs within the panel. */
struct rows {
    size_t *row;
    size_t count;
    bool clean; /* the clean chain is known */
};

struct writer {
    struct bead_h5 *h5;
    const struct bead_sweep *sweep;
    const struct sweep_panel *panel;
    hid_t group, configuration, place, bead;
    struct rows rows;
};

static enum bead_error list_rows(struct writer *w, struct bead_message *msg)
{
    size_t jobs = w->panel->shown.configurations + 1;
    BEAD_TRY(bead_new(&w->rows.row, jobs, msg, "a sweep's file"));
    w->rows.clean = w->sweep->known[w->panel->first_job];
    for (size_t row = 1; row < jobs; row++) {
        if (w->sweep->known[w->panel->first_job + row])
            w->rows.row[w->rows.count++] = row;
    }
    return BEAD_OK;
}

static void write_scales(struct writer *w, int64_t *numbers)
{
    const struct bead_sweep_panel *shown = &w->panel->shown;
    BEAD_FREED const char **places = NULL;
    if (w->h5->error || (w->h5->error = bead_new(&places, shown->places, w->h5->msg, "a sweep's file")))
        return;
    for (size_t i = 0; i < shown->places; i++)
        places[i] = bead_sweep_place(w->sweep, (size_t)(w->panel - w->sweep->panels), i);
    if (shown->places) {
        bead_h5_write_texts(w->h5, w->group, "place", places, sizeof *places, shown->places);
        w->place = bead_h5_open_scale(w->h5, w->group, "place", "place");
    }
    if (w->panel->profiles) {
        for (size_t i = 0; i < shown->beads; i++)
            numbers[i] = (int64_t)i;
        bead_h5_write_numbers(w->h5, w->group, "bead", NULL, -1, BEAD_H5_INT, numbers, sizeof *numbers, shown->beads);
        w->bead = bead_h5_open_scale(w->h5, w->group, "bead", "bead");
    }
    for (size_t i = 0; i < w->rows.count; i++)
        numbers[i] = (int64_t)(w->rows.row[i] - 1);
    if (w->rows.count) {
        bead_h5_write_numbers(w->h5, w->group, "configuration", NULL, -1, BEAD_H5_INT, numbers, sizeof *numbers, w->rows.count);
        w->configuration = bead_h5_open_scale(w->h5, w->group, "configuration", "configuration");
    }
}

#define PEAK(member) offsetof(struct bead_sweep_peak, member)
const struct sweep_peak_column bead_sweep_peak_columns[] = {
    {"peak_force", "N", PEAK(force), .wrong = "a force that is negative or not finite"},
    {"peak_time", "s", PEAK(time), .wrong = "a time that is negative or infinite", .unknown = true},
    {"peak_uncertainty", "N", PEAK(uncertainty), .wrong = "an uncertainty that is negative or not finite"},
    {"peak_time_uncertainty", "s", PEAK(time_uncertainty), .wrong = "an uncertainty that is negative or infinite", .unknown = true,
     .optional = true},
    [PEAK_BEAD] = {"peak_bead", NULL, PEAK(bead), .wrong = "a bead that the chain does not have"},
    [PEAK_OPEN] = {"peak_open", NULL, PEAK(open), .wrong = "marks other than 0 and 1"}};

static void write_peaks(struct writer *w, const char *prefix, const size_t *rows, size_t count, hid_t scale, double *numbers,
                        int64_t *whole)
{
    const size_t places = w->panel->shown.places;
    const hid_t scales[2] = {scale, w->place};
    char name[64];
    for (size_t c = 0; c < PEAK_COLUMNS; c++) {
        const struct sweep_peak_column *column = &bead_sweep_peak_columns[c];
        for (size_t i = 0; i < count * places; i++) {
            const char *value = (const char *)&w->panel->peaks[rows[i / places] * places + i % places] + column->offset;
            if (column->unit)
                memcpy(&numbers[i], value, sizeof *numbers);
            else
                whole[i] = *(const uint32_t *)(const void *)value;
        }
        snprintf(name, sizeof name, "%s%s", prefix, column->name);
        bead_h5_write_table(w->h5, w->group, name, column->unit, column->unit ? BEAD_H5_DOUBLE : BEAD_H5_INT, count, places, scales,
                            column->unit ? (const void *)numbers : whole);
    }
}

const struct sweep_profile_name bead_sweep_profiles[] = {[PROFILE_FORCE] = {"bead_force", "N"},
                                                         [PROFILE_ENERGY] = {"bead_energy", "J"},
                                                         [PROFILE_LAST_FORCE] = {"last_force", "N"},
                                                         [PROFILE_LAST_ENERGY] = {"last_energy", "J"},
                                                         [PROFILES_OF_RUN + PROFILE_FORCE] = {"finer_bead_force", "N"},
                                                         [PROFILES_OF_RUN + PROFILE_ENERGY] = {"finer_bead_energy", "J"},
                                                         [PROFILES_OF_RUN + PROFILE_LAST_FORCE] = {"finer_last_force", "N"},
                                                         [PROFILES_OF_RUN + PROFILE_LAST_ENERGY] = {"finer_last_energy", "J"}};

static void write_profiles(struct writer *w, const char *prefix, const size_t *rows, size_t count, hid_t scale, double *numbers)
{
    const size_t beads = w->panel->shown.beads;
    const hid_t scales[2] = {scale, w->bead};
    char name[64];
    for (size_t what = 0; what < PROFILES; what++) {
        for (size_t i = 0; i < count; i++)
            memcpy(numbers + i * beads, w->panel->profiles + (PROFILES * rows[i] + what) * beads, beads * sizeof *numbers);
        snprintf(name, sizeof name, "%s%s", prefix, bead_sweep_profiles[what].name);
        bead_h5_write_table(w->h5, w->group, name, bead_sweep_profiles[what].unit, BEAD_H5_DOUBLE, count, beads, scales, numbers);
    }
}

static void write_results(struct writer *w, const char *prefix, const size_t *rows, size_t count, hid_t scale, double *numbers,
                          int64_t *whole)
{
    if (count > 0 && w->panel->shown.places > 0)
        write_peaks(w, prefix, rows, count, scale, numbers, whole);
    if (count > 0 && w->panel->profiles)
        write_profiles(w, prefix, rows, count, scale, numbers);
}

/* Writes the values of keys, for sweeps over keys, instead of spins. */
static void write_values(struct writer *w)
{
    const struct bead_over *over = &w->panel->shown.spec->over;
    const size_t panel = (size_t)(w->panel - w->sweep->panels), keys = over->key_count;
    BEAD_FREED double *values = NULL;
    const char *paths[64];
    const hid_t scales[2] = {w->configuration, -1};
    if (w->h5->error || (w->h5->error = bead_new(&values, w->rows.count * keys, w->h5->msg, "a sweep's file")))
        return;
    for (size_t k = 0; k < keys; k++) {
        paths[k] = over->keys[k].path;
        for (size_t i = 0; i < w->rows.count; i++)
            values[i * keys + k] = over->keys[k].value[bead_sweep_value(w->sweep, panel, w->rows.row[i] - 1, k)];
    }
    bead_h5_write_texts(w->h5, w->group, "key", paths, sizeof *paths, keys);
    bead_h5_write_table(w->h5, w->group, "value", NULL, BEAD_H5_DOUBLE, w->rows.count, keys, scales, values);
}

static void write_spins(struct writer *w, double *numbers)
{
    const size_t cells = w->panel->shown.spec->cells, panel = (size_t)(w->panel - w->sweep->panels);
    const hid_t scales[2] = {w->configuration, -1};
    BEAD_FREED unsigned char *bits = NULL;
    if (w->h5->error || (w->h5->error = bead_new(&bits, w->rows.count * cells, w->h5->msg, "a sweep's file")))
        return;
    for (size_t i = 0; i < w->rows.count; i++) {
        struct bead_sweep_configuration c;
        bead_sweep_configuration(w->sweep, panel, w->rows.row[i] - 1, &c);
        numbers[i] = c.magnetism;
        for (size_t k = 0; k < cells; k++)
            bits[i * cells + k] = c.spins[k] == '1';
    }
    bead_h5_write_table(w->h5, w->group, "spins", NULL, BEAD_H5_BYTE, w->rows.count, cells, scales, bits);
    bead_h5_write_numbers(w->h5, w->group, "magnetism", "1", w->configuration, BEAD_H5_DOUBLE, numbers, sizeof *numbers,
                          w->rows.count);
}

static enum bead_error write_panel(struct bead_h5 *h5, const struct bead_sweep *sweep, size_t index, struct bead_message *msg)
{
    struct writer w = {.h5 = h5, .sweep = sweep, .panel = &sweep->panels[index], .configuration = -1, .place = -1, .bead = -1};
    const struct bead_sweep_panel *shown = &w.panel->shown;
    const size_t clean = 0;
    char name[64];
    snprintf(name, sizeof name, "/sweeps/%zu", index);
    enum bead_error err = list_rows(&w, msg);
    size_t wide = shown->places > shown->beads ? shown->places : shown->beads;
    BEAD_FREED double *numbers = calloc((w.rows.count + 1) * wide, sizeof *numbers);
    BEAD_FREED int64_t *whole = calloc(w.rows.count * (shown->places + 1) + shown->beads + 1, sizeof *whole);
    if (!err && (!numbers || !whole))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a sweep's file");
    if (!err) {
        const int64_t seed = (int64_t)shown->spec->seed;
        w.group = bead_h5_make_group(h5, h5->file, name);
        bead_h5_put_text(h5, w.group, "name", shown->name);
        bead_h5_put_ints(h5, w.group, "seed", &seed, 0);
        write_scales(&w, whole);
        if (w.rows.count)
            bead_sweep_is_over(w.panel) ? write_values(&w) : write_spins(&w, numbers);
        write_results(&w, "", w.rows.row, w.rows.count, w.configuration, numbers, whole);
        write_results(&w, "reference_", &clean, w.rows.clean, -1, numbers, whole);
        bead_h5_close(h5, &w.configuration);
        bead_h5_close(h5, &w.place);
        bead_h5_close(h5, &w.bead);
        bead_h5_close(h5, &w.group);
    }
    free(w.rows.row);
    return err ? err : h5->error;
}

static void write_head(struct bead_h5 *h5, const struct bead_sweep *sweep)
{
    const int64_t format = BEAD_SWEEP_FORMAT, print = (int64_t)sweep->scene->fingerprint, part = (int64_t)sweep->part,
                  parts = (int64_t)sweep->parts;
    bead_h5_put_text(h5, h5->file, "format", BEAD_SWEEP_KIND);
    bead_h5_put_ints(h5, h5->file, "format_version", &format, 0);
    bead_h5_put_text(h5, h5->file, "creator", "beadreel");
    bead_h5_put_text(h5, h5->file, "version", sweep->version);
    bead_h5_put_ints(h5, h5->file, "fingerprint", &print, 0);
    bead_h5_put_ints(h5, h5->file, "part", &part, 0);
    bead_h5_put_ints(h5, h5->file, "parts", &parts, 0);
    if (*sweep->scene->title)
        bead_h5_put_text(h5, h5->file, "title", sweep->scene->title);
    bead_h5_write_text(h5, h5->file, "scene", sweep->scene->text);
}

static enum bead_error write_file(const struct bead_sweep *sweep, const char *name, struct bead_message *msg)
{
    struct bead_h5 h5 = {.file = -1};
    bead_h5_create(&h5, name, msg);
    if (!h5.error)
        write_head(&h5, sweep);
    enum bead_error err = h5.error;
    for (size_t p = 0; p < sweep->panel_count && !err; p++)
        err = write_panel(&h5, sweep, p, msg);
    bead_h5_shut(&h5);
    return err ? err : h5.error;
}

/* `path.part` is the sweep's journal, so the unfinished file has another extension. */
static enum bead_error name_of_new(const char *path, char **name, struct bead_message *msg)
{
    enum bead_error err = bead_file_part_name(path, name, msg);
    if (!err)
        strcpy(*name + strlen(*name) - strlen(".part"), ".new");
    return err;
}

enum bead_error bead_sweep_write(const struct bead_sweep *sweep, const char *path, struct bead_message *msg)
{
    BEAD_FREED char *name = NULL;
    struct bead_file_lock lock;
    enum bead_error err = name_of_new(path, &name, msg);
    if (!err)
        err = bead_file_lock(name, path, &lock, msg);
    if (!err) {
        err = write_file(sweep, name, msg);
        if (err)
            bead_file_discard(name);
        else
            err = bead_file_commit(name, path, msg);
        bead_file_unlock(&lock);
    }
    return err;
}

static enum bead_error write_sweep(const struct bead_output *, const struct bead_run_context *context, const char *path, uint64_t *,
                                   struct bead_message *msg)
{
    return bead_sweep_write(context->sweep, path, msg);
}

static const char *results_why(const struct bead_output *)
{
    return "spins and results of every configuration; in its .part until the end";
}

const struct bead_sink_type bead_sweep_results_sink = {.name = "sweep",
                                                       .help = "all results of a sweep, as HDF5",
                                                       .kind = BEAD_OUTPUT_SWEEP,
                                                       .why = results_why,
                                                       .write = write_sweep};
