/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sink of `trajectory:` outputs: samples into growing datasets, whole chunks at a time, flushed often enough that a
 * killed run loses about a second. Where a flush comes leaves no trace in a finished file: HDF5 is flushed after each chunk, and
 * its driver holds back what would have to wait for the disk. */
#include "sim/trajectory/trajectory_sink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/trajectory.h"
#include "sim/base/clock.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/measure/sink_grid.h"
#include "sim/run/uncertainty.h"

/* A flush waits for the disk: it comes every second, or less often where it would take more than a fiftieth of the time. */
static const double flush_every = 1; /* s */
static const double flush_part = 1. / 50;
/* Plans say how large a trajectory becomes from this size on. */
static const double planned_bytes = 1e9;

static void close_file(struct bead_sink *sink)
{
    hid_t *objects[] = {&sink->time, &sink->step, &sink->bead_scale, &sink->contact_scale, &sink->spatial_scale};
    for (size_t i = 0; i < sizeof objects / sizeof *objects; i++)
        bead_h5_close(&sink->h5, objects[i]);
    for (size_t i = 0; i < BEAD_SERIES_COUNT; i++)
        bead_h5_close(&sink->h5, &sink->series[i].value);
    bead_h5_shut(&sink->h5);
}

static void trajectory_destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    sink->h5.msg = NULL;
    close_file(sink);
    for (size_t i = 0; i < BEAD_SERIES_COUNT; i++)
        free(sink->series[i].buffer);
    if (sink->open && !sink->closed)
        bead_file_discard(sink->part);
    bead_file_release(sink->claim, sink->closed);
    free(sink->rows);
    free(sink->path);
    free(sink->part);
    free(sink->xdmf);
    free(sink->shift);
    free(sink->uncertainty);
    free(sink->times);
    free(sink->steps);
    free(sink);
}

static enum bead_error no_rows(const struct bead_sink *sink, const char *what, struct bead_message *msg)
{
    return bead_output_wrong(sink->output, msg, "beads: no %s from %zu on", what, sink->output->shown.beads.first);
}

/* Bytes of all samples. */
static double sample_bytes(const struct bead_sink *sink)
{
    double columns = 0;
    for (enum bead_series_id id = 0; id < BEAD_SERIES_COUNT; id++) {
        if (bead_trajectory_wants(sink, id))
            columns += (double)(bead_series[id].components * (bead_series[id].of_contacts ? sink->contacts : sink->beads));
    }
    return sizeof(double) * columns * (double)bead_grid_count(&sink->grid);
}

/* Find the lengths of the axes, the samples in a chunk, and the line for the plan. */
static enum bead_error trajectory_measure(struct bead_sink *sink, struct bead_message *msg)
{
    bead_trajectory_rows(sink->context.chains, sink->context.chain_count, sink->output->shown.beads, sink->rows, &sink->beads,
                         &sink->contacts);
    if (sink->beads == 0)
        return no_rows(sink, "chain has beads", msg);
    if (sink->contacts == 0 && (sink->fields & BEAD_TRAJECTORY_CONTACTS))
        return no_rows(sink, "chain has contacts", msg);
    sink->chunk_rows = bead_trajectory_chunk_rows(sink->beads, sink->contacts);
    char every[32];
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    int fields = __builtin_popcount(sink->fields);
    const double bytes = sample_bytes(sink), room = bead_file_room(sink->path);
    const int length = snprintf(sink->why, sizeof sink->why, "%zu samples of %d field%s, %zu beads, every %s",
                                bead_grid_count(&sink->grid), fields, fields == 1 ? "" : "s", sink->beads, every);
    if (bytes >= planned_bytes)
        snprintf(sink->why + length, sizeof sink->why - (size_t)length, ", %.3g GB", 1e-9 * bytes);
    if (bytes > room)
        snprintf(sink->why + strlen(sink->why), sizeof sink->why - strlen(sink->why),
                 "; only %.3g GB are free: a run would be refused", 1e-9 * room);
    return BEAD_OK;
}

static enum bead_error trajectory_create(const struct bead_output *output, const struct bead_run_context *context,
                                         struct bead_sink **made, struct bead_message *msg)
{
    BEAD_TRY(bead_new(made, 1, msg, "a trajectory"));
    struct bead_sink *sink = *made;
    *sink =
        (struct bead_sink){.context = *context, .output = output, .time = -1, .step = -1, .bead_scale = -1, .contact_scale = -1};
    sink->spatial_scale = sink->h5.file = -1;
    for (size_t i = 0; i < BEAD_SERIES_COUNT; i++)
        sink->series[i].value = -1;
    sink->fields = output->trajectory.fields;
    if (!sink->fields)
        sink->fields =
            BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
    BEAD_TRY(bead_new(&sink->rows, context->chain_count, msg, "a trajectory"));
    if (output->curves.uncertainty && !context->replayed)
        BEAD_TRY(bead_new(&sink->uncertainty, BEAD_SERIES_COUNT * context->chain_count, msg, "a trajectory"));
    BEAD_TRY(bead_file_join(context->directory, output->path, &sink->path, msg));
    BEAD_TRY(bead_file_part_name(sink->path, &sink->part, msg));
    if (output->trajectory.xdmf)
        BEAD_TRY(bead_file_join(context->directory, output->trajectory.xdmf, &sink->xdmf, msg));
    BEAD_TRY(bead_sink_grid(output, context, &sink->grid, msg));
    return trajectory_measure(sink, msg);
}

static void trajectory_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){
        .fields = sink->fields, .beads = sink->output->shown.beads, .grid = sink->grid, .until = sink->grid.end};
    needs->why = sink->why;
    needs->checked = sink->uncertainty != NULL;
    if (bead_trajectory_wants(sink, BEAD_SERIES_NET_FORCE)) {
        needs->fields |= BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE);
        needs->beads.first -= needs->beads.first > 0;
    }
}

/* Memory for one chunk of every series. */
static enum bead_error reserve(struct bead_sink *sink, struct bead_message *msg)
{
    size_t rows = sink->chunk_rows;
    bool got = (sink->times = calloc(rows, sizeof *sink->times)) != NULL;
    got = got && (sink->steps = calloc(rows, sizeof *sink->steps)) != NULL;
    for (int id = 0; got && id < BEAD_SERIES_COUNT; id++) {
        if (!bead_trajectory_wants(sink, id))
            continue;
        struct bead_series *series = &sink->series[id];
        series->columns = bead_series[id].of_contacts ? sink->contacts : sink->beads;
        got = !__builtin_mul_overflow(rows, series->columns, &(size_t){0});
        got = got && (series->buffer = calloc(rows * series->columns, sizeof(double))) != NULL;
    }
    if (got && sink->context.chain_count > 1 && sink->series[BEAD_SERIES_POSITION].buffer)
        got = (sink->shift = calloc(rows * sink->beads, sizeof(double))) != NULL;
    return got ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "%s: no memory for samples of %zu beads", sink->path, sink->beads);
}

/* Draw chains below each other, two diameters of the largest bead apart. */
static void place_rows(struct bead_sink *sink)
{
    if (!sink->shift)
        return;
    double largest = 0;
    for (size_t c = 0; c < sink->context.chain_count; c++)
        for (size_t j = 0; j < bead_chain_beads(sink->context.chains[c]); j++)
            largest = fmax(largest, bead_chain_radius(sink->context.chains[c])[j]);
    for (size_t row = 0; row < sink->chunk_rows; row++)
        for (size_t c = 0; c < sink->context.chain_count; c++)
            for (size_t i = 0; i < sink->rows[c].beads.count; i++)
                sink->shift[row * sink->beads + sink->rows[c].beads.row + i] = -4 * largest * (double)c;
}

static void flush(struct bead_sink *sink, bool due)
{
    const double began = bead_clock();
    bead_h5_flush(&sink->h5, due);
    if (!due)
        return;
    sink->flushed = bead_clock();
    sink->flush_after = fmax(flush_every, (sink->flushed - began) / flush_part);
}

static enum bead_error trajectory_begin(struct bead_sink *sink, struct bead_range, struct bead_message *msg)
{
    BEAD_TRY(reserve(sink, msg));
    place_rows(sink);
    if (!sink->context.claimed)
        BEAD_TRY(bead_file_claim(sink->path, &sink->claim, msg));
    const double bytes = sample_bytes(sink), room = bead_file_room(sink->path);
    if (bytes > room)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: needs %.3g GB for its samples; %.3g GB are free", sink->path, 1e-9 * bytes,
                         1e-9 * room);
    bead_h5_create(&sink->h5, sink->part, msg);
    if (sink->h5.error)
        return sink->h5.error;
    sink->open = true;
    bead_trajectory_lay_out(sink);
    flush(sink, true);
    sink->h5.msg = NULL;
    return sink->h5.error;
}

/* The source of one chain's row: a sample. */
struct cell {
    const struct bead_chain *chain;
    const struct bead_chain_rows *rows;
    const struct bead_sample *sample;
};

static void fill_position(const struct cell *cell, double *row)
{
    const struct bead_rows *beads = &cell->rows->beads;
    const double *rest = bead_chain_position(cell->chain), *u = cell->sample->field[BEAD_FIELD_DISPLACEMENT];
    for (size_t i = 0; i < beads->count; i++)
        row[i] = rest[beads->first + i] + u[beads->first + i];
}

/* The force in contact k less its static part, which is balanced; k = -1: the constant force on the striker. */
static double unbalanced(const struct bead_chain *chain, const double *force, size_t k_plus_1)
{
    if (k_plus_1 == 0)
        return chain->striker_force;
    return k_plus_1 <= chain->contacts ? force[k_plus_1 - 1] - chain->static_force[k_plus_1 - 1] : 0;
}

static void fill_net_force(const struct cell *cell, double *row)
{
    const double *force = cell->sample->field[BEAD_FIELD_CONTACT_FORCE];
    size_t j = cell->rows->beads.first;
    double left = unbalanced(cell->chain, force, j);
    for (size_t i = 0; i < cell->rows->beads.count; i++, j++) {
        double right = unbalanced(cell->chain, force, j + 1);
        row[i] = left - right;
        left = right;
    }
}

/* Series that are not a field of the sample. */
static void (*const derived[BEAD_SERIES_COUNT])(const struct cell *cell, double *row) = {
    [BEAD_SERIES_POSITION] = fill_position, [BEAD_SERIES_NET_FORCE] = fill_net_force};

static void fill(const struct cell *cell, enum bead_series_id id, double *row)
{
    const struct bead_series_info *info = &bead_series[id];
    const struct bead_rows *rows = bead_rows_of(cell->rows, info->of_contacts);
    if (derived[id])
        derived[id](cell, row);
    else
        memcpy(row, cell->sample->field[info->field] + rows->first, rows->count * sizeof *row);
}

/* Compares a sample with that of the check run. */
static void compare(struct bead_sink *sink, const struct bead_sample *sample)
{
    for (size_t id = 0; id < BEAD_SERIES_COUNT; id++) {
        const struct bead_rows *rows = bead_rows_of(&sink->rows[sample->chain], bead_series[id].of_contacts);
        const enum bead_field field = bead_series[id].field;
        double *worst = &sink->uncertainty[id * sink->context.chain_count + sample->chain];
        if (!sink->series[id].buffer || !bead_series[id].stored)
            continue;
        if (!sample->check)
            *worst = NAN;
        for (size_t i = rows->first; sample->check && i < rows->first + rows->count; i++)
            *worst = fmax(*worst, bead_uncertainty_measured(0, sample->field[field][i], sample->check->field[field][i]));
    }
}

/* A failed run must not leave a file that looks complete. */
static void check_finite(struct bead_sink *sink, enum bead_series_id id)
{
    const struct bead_series *series = &sink->series[id];
    for (size_t i = sink->written * series->columns; i < sink->filled * series->columns; i++) {
        if (isfinite(series->buffer[i]))
            continue;
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_NUMBERS, "%s: the %s at the time %g is not a finite number", sink->path,
                                   bead_field_info(bead_series[id].field)->title, sink->times[i / series->columns]);
        return;
    }
}

/* Write the complete samples that are not in the file yet; to the disk where that is due. Values first: a file cut off here has no
 * time without values. */
static void write_pending(struct bead_sink *sink, bool due)
{
    struct bead_h5 *h5 = &sink->h5;
    size_t first = sink->chunk_first + sink->written, rows = sink->filled - sink->written;
    if (rows == 0)
        return;
    for (int id = 0; id < BEAD_SERIES_COUNT; id++) {
        const struct bead_series *series = &sink->series[id];
        if (!series->buffer || h5->error)
            continue;
        check_finite(sink, id);
        bead_h5_write_rows(h5, series->value, BEAD_H5_DOUBLE, first, rows, series->columns, 0,
                           series->buffer + sink->written * series->columns);
        if (id == BEAD_SERIES_POSITION && sink->shift)
            bead_h5_write_rows(h5, series->value, BEAD_H5_DOUBLE, first, rows, series->columns, 1, sink->shift);
    }
    bead_h5_write_rows(h5, sink->step, BEAD_H5_INT, first, rows, 0, 0, sink->steps + sink->written);
    bead_h5_write_rows(h5, sink->time, BEAD_H5_DOUBLE, first, rows, 0, 0, sink->times + sink->written);
    flush(sink, due);
    sink->written = sink->filled;
    if (sink->filled == sink->chunk_rows) {
        sink->chunk_first += sink->chunk_rows;
        sink->filled = sink->written = 0;
    }
}

static enum bead_error trajectory_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    size_t number = sink->chunk_first + sink->filled;
    if (sample->chain != sink->next_chain || sample->index != number)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: sample %zu of chain %zu arrived out of order", sink->path, sample->index,
                         sample->chain);
    struct cell cell = {sink->context.chains[sample->chain], &sink->rows[sample->chain], sample};
    for (int id = 0; id < BEAD_SERIES_COUNT; id++) {
        const struct bead_series *series = &sink->series[id];
        const struct bead_rows *rows = bead_rows_of(cell.rows, bead_series[id].of_contacts);
        if (series->buffer && rows->count > 0)
            fill(&cell, id, series->buffer + sink->filled * series->columns + rows->row);
    }
    if (sink->uncertainty)
        compare(sink, sample);
    if (++sink->next_chain < sink->context.chain_count)
        return BEAD_OK;
    sink->next_chain = 0;
    sink->times[sink->filled] = sample->time;
    sink->steps[sink->filled] = (int64_t)number;
    sink->filled++;
    sink->h5.msg = msg;
    const bool due = bead_clock() - sink->flushed >= sink->flush_after;
    if (due || sink->filled == sink->chunk_rows)
        write_pending(sink, due);
    sink->h5.msg = NULL;
    return sink->h5.error;
}

/* Write the pending samples and the outcome, and close the file. */
static enum bead_error trajectory_stop(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    sink->h5.msg = msg;
    write_pending(sink, false);
    bool complete = sink->chunk_first + sink->filled == bead_grid_count(&sink->grid);
    bead_trajectory_write_outcome(sink, outcomes, complete);
    close_file(sink);
    sink->h5.msg = NULL;
    sink->closed = !sink->h5.error;
    return sink->h5.error;
}

static enum bead_error trajectory_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    BEAD_TRY(trajectory_stop(sink, outcomes, msg));
    sink->finished = true; /* a failing commit removes the part itself */
    enum bead_error err = bead_file_commit(sink->part, sink->path, msg);
    bead_file_release(sink->claim, false); /* HDF5 locks files that it reads */
    sink->claim = NULL;
    return err || !sink->xdmf ? err : bead_trajectory_write_xdmf(sink, msg);
}

static void trajectory_result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = bead_file_bytes(sink->finished ? sink->path : sink->part);
    *items = sink->chunk_first + sink->filled;
}

static const char *trajectory_beside(const struct bead_sink *sink, uint64_t *bytes)
{
    *bytes = sink->xdmf_bytes;
    return sink->xdmf;
}

const struct bead_sink_type bead_trajectory_sink = {
    .name = "trajectory",
    .help = "all samples, as an H5MD 1.1 file that explains itself and can be drawn again",
    .kind = BEAD_OUTPUT_TRAJECTORY,
    .create = trajectory_create,
    .needs = trajectory_needs,
    .begin = trajectory_begin,
    .sample = trajectory_sample,
    .end = trajectory_end,
    .stop = trajectory_stop,
    .destroy = trajectory_destroy,
    .result = trajectory_result,
    .beside = trajectory_beside,
};
