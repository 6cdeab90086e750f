/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes tables of the curves of an ensemble: see sweep_lines.h. */
#include <math.h>
#include <stdio.h>

#include "sim/base/number.h"
#include "sim/measure/places.h"
#include "sim/output/table.h"
#include "sim/sweep/sweep_lines.h"

/* The heading of a place's column: its name, and the column's quantity. */
static void write_heading(FILE *file, const struct bead_sweep_lines *lines, size_t column, const char *what)
{
    const struct bead_curves_asked *curves = &lines->output.curves;
    const struct bead_place_shown place = bead_place_shown(&lines->output, lines->of[0].chain, column);
    char name[160];
    bead_table_place_name(&place, curves->beads.all || curves->contacts.all, name, sizeof name);
    fputc(',', file);
    bead_table_text(file, name);
    fputs(what, file);
}

static void lines_head(FILE *file, const struct bead_sweep_lines *lines)
{
    const size_t columns = lines->of[0].mean.columns;
    fprintf(file, "%s,curve,configurations", lines->output.curves.show == BEAD_SHOW_SENSORS ? "time_s" : "frequency_Hz");
    for (size_t p = 0; p < columns; p++) {
        write_heading(file, lines, p, "");
        write_heading(file, lines, p, "_error");
    }
    for (size_t p = 0; lines->of[0].uncertainty && p < columns; p++)
        write_heading(file, lines, p, "_uncertainty");
    fputc('\n', file);
}

static bool lines_have(const struct bead_sweep_line *line, size_t row)
{
    bool has = false;
    for (size_t p = 0; p < line->mean.columns; p++)
        has = has || !isnan(line->mean.values[p * line->mean.rows + row]);
    return has;
}

static void write_line(FILE *file, const struct bead_sweep_lines *lines, const struct bead_sweep_line *line)
{
    const bool sensors = lines->output.curves.show == BEAD_SHOW_SENSORS;
    const double *ends = lines->output.curves.frequencies;
    for (size_t k = 0; k < line->mean.rows; k++) {
        const double x = (sensors ? line->mean.first : 0) + (double)k * line->mean.step;
        if ((!sensors && (x < ends[0] || x > ends[1])) || !lines_have(line, k))
            continue;
        bead_write_number(file, x);
        fputc(',', file);
        bead_table_text(file, line->name);
        fprintf(file, ",%zu", line->chains);
        for (size_t p = 0; p < line->mean.columns; p++) {
            bead_table_known(file, line->mean.values[p * line->mean.rows + k]);
            bead_table_known(file, line->error[p * line->mean.rows + k]);
        }
        for (size_t p = 0; line->uncertainty && p < line->mean.columns; p++)
            bead_table_known_uncertainty(file, line->uncertainty[p * line->mean.rows + k]);
        fputc('\n', file);
    }
}

/* The strongest line of each wave number and band, with the error at the nearest frequency. */
static void write_strongest(FILE *file, const struct bead_sweep_lines *lines, const struct bead_sweep_line *line)
{
    const struct bead_spectral *mean = &line->mean;
    const size_t bands = line->bands;
    for (size_t i = 0; i < mean->columns * bands; i++) {
        const struct bead_spectral_line found = bead_spectral_line(mean, line->medium, i / bands, i % bands);
        const double *ends = lines->output.curves.frequencies;
        if (found.found < ends[0] || found.found > ends[1])
            continue;
        bead_table_text(file, line->name);
        fprintf(file, ",%zu", line->chains);
        bead_table_known(file, mean->first + (double)(i / bands) * mean->between);
        fprintf(file, ",%zu", i % bands + 1);
        bead_table_known(file, found.exact);
        bead_table_known(file, found.found);
        bead_table_known(file, found.amplitude);
        const double row = round(found.found / mean->step);
        bead_table_known(file, row >= 0 ? line->error[i / bands * mean->rows + (size_t)row] : NAN);
        if (line->uncertainty) {
            bead_table_known_uncertainty(file, line->uncertainty[i / bands * mean->rows]);
            bead_table_known_uncertainty(file, line->of_frequency[i]);
        }
        fputc('\n', file);
    }
}

/* Spreading at each time, and the exponents of all. */
static void write_spreading(FILE *file, const struct bead_sweep_lines *lines, const struct bead_sweep_line *line)
{
    const size_t rows = line->mean.rows, laws = bead_sweep_line_law(line, 0);
    const double end = bead_grid_time(&lines->grid, rows - 1);
    for (size_t k = 0; k < rows; k++) {
        const size_t at[] = {k, rows + k, 2 * rows + k, laws, laws + 1};
        bead_write_number(file, bead_grid_time(&lines->grid, k));
        fputc(',', file);
        bead_table_text(file, line->name);
        fprintf(file, ",%zu", line->chains);
        for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
            bead_table_known(file, line->mean.values[at[i]]);
            bead_table_known(file, line->error[at[i]]);
        }
        bead_table_known(file, BEAD_SPREADING_WINDOW * end);
        bead_table_known(file, end);
        for (size_t i = 0; i < sizeof at / sizeof *at; i++)
            bead_table_known_uncertainty(file, line->uncertainty ? line->uncertainty[at[i]] : NAN);
        fputc('\n', file);
    }
}

static const char spreading_head[] =
    "time_s,curve,configurations,second_moment,second_moment_error,participation,participation_error,front,front_error,gamma,"
    "gamma_error,eta,eta_error,fit_from_s,fit_to_s,second_moment_uncertainty,participation_uncertainty,front_uncertainty,"
    "gamma_uncertainty,eta_uncertainty\n";

enum bead_error bead_sweep_lines_write(FILE *file, const struct bead_sweep *sweep, const struct bead_output *output,
                                       const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    struct bead_sweep_lines lines;
    enum bead_error err = bead_sweep_lines_find(sweep, output, settings, output->curves.uncertainty, &lines, msg);
    const bool dispersion = output->curves.show == BEAD_SHOW_DISPERSION;
    if (!err && dispersion)
        fprintf(file, "curve,configurations,wave_number_cell_pi,band,exact_Hz,found_Hz,amplitude,amplitude_error%s\n",
                output->curves.uncertainty ? ",uncertainty,found_Hz_uncertainty" : "");
    else if (!err && lines.laws > 0)
        fputs(spreading_head, file);
    else if (!err)
        lines_head(file, &lines);
    for (size_t i = 0; i < lines.count && !err; i++) {
        if (dispersion)
            write_strongest(file, &lines, &lines.of[i]);
        else if (lines.laws > 0)
            write_spreading(file, &lines, &lines.of[i]);
        else
            write_line(file, &lines, &lines.of[i]);
    }
    bead_sweep_lines_free(&lines);
    return err;
}
