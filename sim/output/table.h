/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The insides of the table sink, shared by table.c and the table_*.c, one for each kind of table. */
#ifndef BEADREEL_SIM_OUTPUT_TABLE_H
#define BEADREEL_SIM_OUTPUT_TABLE_H

#include <locale.h>
#include <stdio.h>

#include "beadreel/measure.h"
#include "beadreel/profile_times.h"
#include "beadreel/sink.h"

struct column {
    size_t chain, bead;
    char *name;   /* of the column */
    double value; /* N, of the row being collected */
};

struct bead_sink {
    struct bead_run_context context;
    const struct bead_output *output;
    const struct table *table;
    struct bead_grid grid;
    char *path, *part;
    char why[128];
    FILE *file;
    locale_t locale;        /* "C": a decimal point, whatever the user's language */
    struct column *columns; /* sensors, chain by chain */
    size_t column_count, next_chain, next_sample;
    struct bead_measures **measures;    /* [chains], of those that measures are made for */
    struct bead_profile_times *moments; /* of profiles */
    uint64_t rows;
    bool open, finished;
};

/* What can be shown: its needs and how it is written. */
struct table {
    const char *why;
    enum bead_error (*prepare)(struct bead_sink *sink, struct bead_message *msg); /* may be NULL */
    void (*needs)(const struct bead_sink *sink, struct bead_needs *needs);
    void (*header)(struct bead_sink *sink);
    enum bead_error (*sample)(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg); /* may be NULL */
    void (*end)(struct bead_sink *sink, const struct bead_outcome *outcomes);                                      /* may be NULL */
    enum bead_error (*begin)(struct bead_sink *sink, struct bead_message *msg); /* as the run begins; may be NULL */
};

/* A text, in quotes where it has a comma, a quote or a line break. */
void bead_table_text(FILE *file, const char *text);
/* ",a,b" for the numbers a and b: the fewest digits that read back as the same. */
void bead_table_numbers(FILE *file, size_t count, const double *numbers);

/* A line of the columns' names behind that of the time, and one of their values. */
void bead_table_columns(struct bead_sink *sink, const char *time);
void bead_table_row(struct bead_sink *sink, double time);

/* `show: measures` */
extern const struct table bead_table_measures;
/* `show: energy` */
extern const struct table bead_table_energy;
/* `show: modes` */
extern const struct table bead_table_modes;
/* `show: profiles` */
extern const struct table bead_table_profiles;
/* `show: chain` */
extern const struct table bead_table_chain;
/* `show: sensitivities` */
extern const struct table bead_table_sensitivities;
/* The name of a chain as a column of its own, where there are several. */
void bead_table_chain_name(const struct bead_sink *sink, size_t chain);
/* "chain/what", or "what" where there is one chain only; NULL: no memory. */
char *bead_table_column(const struct bead_sink *sink, size_t chain, const char *what);

#endif
