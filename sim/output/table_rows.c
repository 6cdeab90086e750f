/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the parts of tables, and the columns of tables with a row for each time. The FILE remembers failures until it is closed.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/number.h"
#include "sim/measure/sink_grid.h"
#include "sim/output/table.h"
#include "sim/run/uncertainty.h"

/* Would a spreadsheet compute a cell that begins like this? A number with a sign and a unit stays as it is. */
static bool is_formula(const char *text)
{
    if (*text != '+' && *text != '-')
        return *text && strchr("=@\t\r", *text);
    const char *rest = text + 1 + strspn(text + 1, ".0123456789");
    return rest == text + 1 || rest[strcspn(rest, "+-*/^&|=<>!(")];
}

/* Writes a text and a plain ending. */
static void write_text(FILE *file, const char *text, const char *ending)
{
    const char *const mark = is_formula(text) ? "'" : "";
    if (!text[strcspn(text, ",\"\r\n")]) {
        fprintf(file, "%s%s%s", mark, text, ending);
        return;
    }
    fprintf(file, "\"%s", mark);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fprintf(file, "%s\"", ending);
}

void bead_table_text(FILE *file, const char *text)
{
    write_text(file, text, "");
}

void bead_table_numbers(FILE *file, size_t count, const double *numbers)
{
    for (size_t i = 0; i < count; i++) {
        fputc(',', file);
        bead_write_number(file, numbers[i]);
    }
}

void bead_table_known(FILE *file, double number)
{
    fputc(',', file);
    if (isfinite(number))
        bead_write_number(file, number);
}

void bead_table_uncertainties(FILE *file, size_t count, const double *numbers)
{
    for (size_t i = 0; i < count; i++) {
        fputc(',', file);
        bead_write_uncertainty(file, numbers[i]);
    }
}

void bead_table_known_uncertainty(FILE *file, double number)
{
    fputc(',', file);
    if (isfinite(number))
        bead_write_uncertainty(file, number);
}

void bead_table_begin_header(struct bead_sink *sink, bool times)
{
    fputs(sink->context.chain_count > 1 ? "chain," : "", sink->file);
    if (times) {
        bead_table_time_header(sink);
        fputc(',', sink->file);
    }
}

void bead_table_chain_name(const struct bead_sink *sink, size_t chain)
{
    if (sink->context.chain_count == 1)
        return;
    bead_table_text(sink->file, bead_chain_name(sink->context.chains[chain]));
    fputc(',', sink->file);
}

void bead_table_end_row(struct bead_sink *sink)
{
    fputc('\n', sink->file);
    sink->rows++;
}

/* ---- numbers against time ---- */

enum bead_error bead_table_add_column(struct bead_sink *sink, size_t chain, size_t bead, const char *what, struct bead_message *msg)
{
    const char *owner = sink->context.chain_count > 1 ? bead_chain_name(sink->context.chains[chain]) : "";
    struct column *grown = realloc(sink->columns, (sink->column_count + 1) * sizeof *grown);
    char *name = NULL;
    if (grown)
        sink->columns = grown;
    if (!grown || asprintf(&name, "%s%s%s", owner, *owner ? "/" : "", what) < 0)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    grown[sink->column_count++] = (struct column){.chain = chain, .bead = bead, .name = name};
    return BEAD_OK;
}

enum bead_error bead_table_choose_times(struct bead_sink *sink, const char *what, struct bead_message *msg)
{
    char every[32];
    enum bead_error error = bead_sink_grid(sink->output, &sink->context, &sink->grid, msg);
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    snprintf(sink->why, sizeof sink->why, "%zu samples of %s, every %s%s", bead_grid_count(&sink->grid), what, every,
             sink->grid.widens ? " at first" : "");
    return error;
}

void bead_table_time_header(const struct bead_sink *sink)
{
    const char *unit = bead_chain_time_unit(sink->context.chains[0]);
    fprintf(sink->file, "time%s%s", *unit ? "_" : "", unit);
}

void bead_table_uncertainties_header(const struct bead_sink *sink)
{
    for (size_t i = 0; bead_table_is_judged(sink) && i < sink->column_count; i++) {
        fputc(',', sink->file);
        write_text(sink->file, sink->columns[i].name, "_uncertainty");
    }
}

void bead_table_columns_header(struct bead_sink *sink)
{
    bead_table_time_header(sink);
    for (size_t i = 0; i < sink->column_count; i++) {
        fputc(',', sink->file);
        bead_table_text(sink->file, sink->columns[i].name);
    }
    bead_table_uncertainties_header(sink);
    fputc('\n', sink->file);
}

void bead_table_compare(struct bead_sink *sink, const struct bead_sample *sample)
{
    for (size_t i = 0; bead_table_is_judged(sink) && i < sink->column_count; i++) {
        struct column *c = &sink->columns[i];
        if (c->chain != sample->chain)
            continue;
        if (sink->bounds)
            c->uncertainty = bead_table_bound(sink, c->chain, c->field);
        else
            c->uncertainty =
                sample->check ? fmax(c->uncertainty, bead_uncertainty_measured(0, c->value, sink->check->columns[i].value)) : NAN;
    }
}

double bead_table_worst(const struct bead_sink *sink, const double *values, const double *checks, size_t count)
{
    double largest = NAN;
    for (size_t i = 0; !sink->unknown && i < count; i++)
        largest = fmax(largest, bead_uncertainty_measured(0, values[i], checks[i]));
    return largest;
}

void bead_table_end_sample(struct bead_sink *sink, const struct bead_sample *sample)
{
    bead_table_compare(sink, sample);
    if (!sink->file || sample->chain + 1 < sink->context.chain_count)
        return;
    bead_write_number(sink->file, sample->time);
    for (size_t i = 0; i < sink->column_count; i++)
        bead_table_numbers(sink->file, 1, &sink->columns[i].value);
    for (size_t i = 0; bead_table_is_judged(sink) && i < sink->column_count; i++)
        bead_table_uncertainties(sink->file, 1, &sink->columns[i].uncertainty);
    bead_table_end_row(sink);
}
