/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spreading: how far energy has gone from the bead that was excited, over time.
 *
 * With e_n the energy of bead n, its contacts' shared, and n0 the excited bead: the second moment m2 = sum (n - n0)^2 e_n / sum
 * e_n, the participation P = (sum e_n)^2 / sum e_n^2, and the front, the furthest bead from n0 with more than 1e-6 of the energy.
 * The exponents of m2 ~ t^gamma and 1/P ~ t^-eta are slopes of least squares through the logarithms of the samples from 7 % of the
 * time until the time itself, with standard errors: the window is part of the definition. The last row has those of the whole run.
 * A. J. Martinez, P. G. Kevrekidis, M. A. Porter, Phys. Rev. E 93, 022902 (2016). */
#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/chain/chain_data.h"
#include "sim/output/table.h"

static const double window = 0.07, front_part = 1e-6;
/* Fewer samples in the window give no exponent. */
enum { FEWEST = 8 };

/* Logarithms of time, second moment and participation, of one chain. */
struct bead_spreading {
    double *log[3];
    size_t count, room;
    size_t origin;
};

/* The bead that was excited: of those that start otherwise than at rest the one in the middle, or the striker. */
static size_t origin_of(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const bool struck = spec->start_count == 0 || spec->striker_velocity != 0;
    return struck ? 0 : spec->starts[spec->start_count / 2].bead;
}

static enum bead_error spreading_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&sink->spreading, sink->context.chain_count, msg, "a table"));
    for (size_t c = 0; c < sink->context.chain_count; c++)
        sink->spreading[c].origin = origin_of(sink->context.chains[c]);
    return bead_table_choose_times(sink, "the energy of every bead", msg);
}

static enum bead_error spreading_begin(struct bead_sink *sink, struct bead_message *msg)
{
    const size_t room = bead_grid_count(&sink->grid);
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        sink->spreading[c].room = room;
        for (int i = 0; i < 3; i++)
            BEAD_TRY(bead_new(&sink->spreading[c].log[i], room, msg, "a table of %zu times", room));
    }
    return BEAD_OK;
}

void bead_table_spreading_free(struct bead_sink *sink)
{
    for (size_t c = 0; sink->spreading && c < sink->context.chain_count; c++) {
        for (int i = 0; i < 3; i++)
            free(sink->spreading[c].log[i]);
    }
    free(sink->spreading);
}

static void spreading_needs(const struct bead_sink *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_ENERGY);
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

static void spreading_header(struct bead_sink *sink)
{
    if (sink->context.chain_count > 1)
        fputs("chain,", sink->file);
    bead_table_time_header(sink);
    fputs(",second_moment,participation,front,gamma,gamma_error,eta,eta_error\n", sink->file);
}

/* The slope of log[what] against log[0] over the window that ends with the last sample. */
static void fit(const struct bead_spreading *s, int what, double *slope, double *error)
{
    const double *x = s->log[0], *y = s->log[what], from = x[s->count - 1] + bead_log(window);
    size_t first = s->count;
    double mx = 0, my = 0, sxx = 0, sxy = 0, rest = 0;
    while (first > 0 && x[first - 1] >= from)
        first--;
    const double n = (double)(s->count - first);
    *slope = *error = NAN;
    if (n < FEWEST)
        return;
    for (size_t i = first; i < s->count; i++) {
        mx += x[i] / n;
        my += y[i] / n;
    }
    for (size_t i = first; i < s->count; i++) {
        sxx += (x[i] - mx) * (x[i] - mx);
        sxy += (x[i] - mx) * (y[i] - my);
    }
    *slope = sxy / sxx;
    for (size_t i = first; i < s->count; i++) {
        const double off = y[i] - my - *slope * (x[i] - mx);
        rest += off * off;
    }
    *error = sqrt(rest / (n - 2) / sxx);
}

static enum bead_error spreading_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    struct bead_spreading *s = &sink->spreading[sample->chain];
    const double *e = sample->field[BEAD_FIELD_ENERGY], origin = (double)s->origin;
    const size_t beads = bead_chain_beads(sink->context.chains[sample->chain]);
    const size_t count = sample->active < beads ? sample->active : beads;
    double all = 0, squares = 0, moment = 0, front = 0;
    for (size_t n = 0; n < count; n++) {
        all += e[n];
        squares += e[n] * e[n];
        moment += ((double)n - origin) * ((double)n - origin) * e[n];
    }
    for (size_t n = 0; n < count; n++)
        front = e[n] > front_part * all ? fmax(front, fabs((double)n - origin)) : front;
    double numbers[] = {moment / all, all * all / squares, front, NAN, NAN, NAN, NAN};
    if (sample->time > 0 && numbers[0] > 0 && s->count < s->room) {
        s->log[0][s->count] = bead_log(sample->time);
        s->log[1][s->count] = bead_log(numbers[0]);
        s->log[2][s->count++] = bead_log(numbers[1]);
        fit(s, 1, &numbers[3], &numbers[4]);
        fit(s, 2, &numbers[5], &numbers[6]);
    }
    bead_table_chain_name(sink, sample->chain);
    bead_write_number(sink->file, sample->time);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        fputc(',', sink->file);
        if (isfinite(numbers[i]))
            bead_write_number(sink->file, numbers[i]);
    }
    fputc('\n', sink->file);
    sink->rows++;
    return BEAD_OK;
}

const struct table bead_table_spreading = {.why = "how far energy has spread",
                                           .prepare = spreading_prepare,
                                           .needs = spreading_needs,
                                           .begin = spreading_begin,
                                           .header = spreading_header,
                                           .sample = spreading_sample};
