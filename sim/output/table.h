/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of the table sink, shared by table.c and the table_*.c, one for each kind of table. */
#pragma once

#include <locale.h>
#include <stdio.h>

#include "beadreel/sink.h"
#include "sim/measure/measure.h"
#include "sim/measure/places.h"
#include "sim/measure/profile_times.h"

struct column {
    size_t chain, bead;    /* or contact */
    enum bead_field field; /* of sensors and extremes */
    char *name;            /* of the column */
    double value;          /* of the row being collected */
    double uncertainty;    /* of it and all values before; NaN: unknown */
};

struct bead_sink {
    struct bead_run_context context;
    const struct bead_output *output;
    const struct table *table;
    struct bead_sink *check; /* the same table of the check run, which is not written; NULL: there is no such run */
    size_t each;             /* samples of that for each of the run's; 0: 1 */
    const double *bounds;    /* instead of it, for a trajectory's samples: the context's bounds */
    struct bead_grid grid;
    char *path, *part;
    char why[128];
    FILE *file;
    locale_t locale;        /* "C": a decimal point, whatever the user's language */
    struct column *columns; /* sensors, chain by chain */
    size_t column_count, next_chain, next_sample;
    struct bead_measures **measures;    /* [chains]; NULL for a chain without measures */
    struct bead_profile_times *moments; /* of profiles */
    struct bead_spreading *spreading;   /* [chains], of spreading */
    struct bead_energy_front *fronts;   /* [chains], of energies */
    struct bead_spectra *spectra;
    double *largest; /* [chains], for extremes: the first run's so far */
    uint64_t rows;
    bool open, finished;
    bool unknown; /* the check run ended before a sample */
};

/* A kind of table: its needs and how it is written. The sink asks for samples at the times of its grid, if it has one, and for the
 * run until the last of them. */
struct table {
    const char *why;
    enum bead_error (*prepare)(struct bead_sink *sink, struct bead_message *msg); /* may be NULL */
    void (*needs)(const struct bead_sink *sink, struct bead_needs *needs);        /* further needs; may be NULL */
    const char *columns;                                                          /* after those of the chain and the time */
    const char *uncertainties;              /* columns that follow if they are known, each after a comma; NULL: none */
    bool of_times;                          /* has a column for the time */
    void (*header)(struct bead_sink *sink); /* instead of `columns`, where they vary */
    enum bead_error (*sample)(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg); /* may be NULL */
    void (*end)(struct bead_sink *sink, const struct bead_outcome *outcomes);                                      /* may be NULL */
    enum bead_error (*finish)(struct bead_sink *sink, struct bead_message *msg); /* instead of `end`, where it can fail */
    enum bead_error (*begin)(struct bead_sink *sink, struct bead_message *msg);  /* when the run begins; may be NULL */
    double accuracy;                                                             /* see bead_sink_type; 0: any will do */
    bool checked;   /* a check run gives columns of `uncertainty`, if asked for */
    bool of_fields; /* its numbers are values of fields, whose uncertainties a trajectory may know */
};

/* Has the table columns of uncertainties? If a trajectory knows none, they are NaN. */
static inline bool bead_table_is_judged(const struct bead_sink *sink)
{
    return sink->table->checked && sink->output->curves.uncertainty;
}
/* The trajectory's bound of the errors of a field; NaN: unknown. */
static inline double bead_table_bound(const struct bead_sink *sink, size_t chain, enum bead_field field)
{
    return sink->bounds[chain * BEAD_FIELD_COUNT + (size_t)field];
}

/* Writes a text, in quotes if it contains a comma, a quote or a line break, and after a ' if a spreadsheet would compute it. */
void bead_table_text(FILE *file, const char *text);
/* ",a,b" for the numbers a and b, with the fewest digits that read back as the same double. */
void bead_table_numbers(FILE *file, size_t count, const double *numbers);
/* ",a"; "," if the number is not finite. */
void bead_table_known(FILE *file, double number);
/* The same of uncertainties, with three digits. */
void bead_table_uncertainties(FILE *file, size_t count, const double *numbers);
void bead_table_known_uncertainty(FILE *file, double number);

/* The beginning of a header: the columns of the chain, if there are several, and, if `times`, of the time; each ends with a comma.
 */
void bead_table_begin_header(struct bead_sink *sink, bool times);
/* The name of a chain and a comma, if there are several chains. */
void bead_table_chain_name(const struct bead_sink *sink, size_t chain);
/* Ends a line, and counts it as a row. */
void bead_table_end_row(struct bead_sink *sink);
/* "time_s", or "time" if times have no unit. */
void bead_table_time_header(const struct bead_sink *sink);

/* Tables with a row for each time. Adds a column, "chain/what", or "what" for a single chain. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_table_add_column(struct bead_sink *sink, size_t chain, size_t bead, const char *what,
                                                 struct bead_message *msg);
/* The name of a place's column: "bead_20", "bead_20_velocity"; sensors, which are not listed, keep their names. */
void bead_table_place_name(const struct bead_place_shown *place, bool listed, char *name, size_t size);
/* Adds a column for each sensor, or each place that the output lists. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_table_place_columns(struct bead_sink *sink, struct bead_message *msg);
/* Sets the grid that the sink's output asks for, and the sink's reason for the plan: samples of `what`. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_table_choose_times(struct bead_sink *sink, const char *what, struct bead_message *msg);
/* A second name for each column, if uncertainties are known. */
void bead_table_uncertainties_header(const struct bead_sink *sink);
/* With a check run, a second column for each follows the last: the largest uncertainty so far, since errors of single samples cross
 * zero; with a trajectory that knows them, the uncertainty of all its samples. */
void bead_table_columns_header(struct bead_sink *sink);
/* Finds the uncertainties of the columns of a sample's chain, if there is a check run or a trajectory that knows them. */
void bead_table_compare(struct bead_sink *sink, const struct bead_sample *sample);
/* The uncertainty of a curve from the check run's: that of its worst value, since errors cross zero along a curve. NaN: unknown. */
double bead_table_worst(const struct bead_sink *sink, const double *values, const double *checks, size_t count);
/* Call this once the columns have the values of a sample. The row is written after the last chain, so that a stopped run leaves no
 * incomplete row; the check run's is not written. */
void bead_table_end_sample(struct bead_sink *sink, const struct bead_sample *sample);

void bead_table_spreading_free(struct bead_sink *sink);
