/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes tables of sweeps: statistics of every magnetism, results of every configuration, decay along the chain. */
#include <locale.h>
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/kinds/output_kinds.h"
#include "sim/output/table.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/sweep/sweep_lines.h"

/* A table being written. */
struct out {
    FILE *file;
    const struct bead_sweep *sweep;
    const struct bead_output *output;
    const struct bead_sweep_settings *settings;
    bool several, places; /* has a column for the sweep's name, and for the place's */
    bool over;            /* of a sweep over keys */
};

static void head(const struct out *o, const char *columns)
{
    fprintf(o->file, "%s%s%s\n", o->several ? "sweep," : "", o->places ? "place," : "", columns);
}

static void names(const struct out *o, size_t panel, size_t place)
{
    if (o->several) {
        bead_table_text(o->file, bead_sweep_panel(o->sweep, panel)->name);
        fputc(',', o->file);
    }
    if (o->places) {
        bead_table_text(o->file, bead_sweep_place(o->sweep, panel, place));
        fputc(',', o->file);
    }
}

/* Relative uncertainties of forces, and of the clean chain's, which normalises them. Errors of chains may be alike, so those of
 * means are no smaller, and those of medians no larger. That of the threshold. */
struct uncertain {
    double force, clean, threshold;
};

static void write_row(const struct out *o, const struct bead_sweep_statistics *s, const struct bead_sweep_row *row,
                      const struct uncertain *uncertain)
{
    const double part = uncertain->force + uncertain->clean;
    const struct bead_summary *m = &row->summary;
    const double normalised[] = {m->mean, m->standard_error, m->median, m->low, m->high, m->quartile[0], m->quartile[1]};
    bead_write_number(o->file, row->magnetism);
    fprintf(o->file, ",%zu", row->count);
    for (size_t i = 0; i < 7; i++)
        bead_table_known(o->file, normalised[i]);
    for (size_t i = 0; i < 3; i++)
        bead_table_known(o->file, normalised[i] * s->clean);
    const double found[] = {s->threshold.plateau, s->threshold.plateau_error, s->threshold.critical, s->threshold.critical_error};
    for (size_t i = 0; i < 4; i++)
        bead_table_known(o->file, s->has_threshold ? found[i] : NAN);
    bead_table_known_uncertainty(o->file, part * m->mean);
    bead_table_known_uncertainty(o->file, uncertain->force * m->mean * s->clean);
    bead_table_known_uncertainty(o->file, s->has_threshold ? part * s->threshold.plateau : NAN);
    bead_table_known_uncertainty(o->file, uncertain->threshold);
    for (size_t i = 2; i < 7; i++)
        bead_table_known_uncertainty(o->file, part * normalised[i]);
    bead_table_known_uncertainty(o->file, uncertain->force * m->median * s->clean);
    fputc('\n', o->file);
}

/* The rows of a place: one for each magnetism. */
static enum bead_error write_magnetisms(const struct out *o, size_t panel, size_t place, const struct bead_sweep_statistics *s,
                                        struct bead_message *msg)
{
    struct uncertain uncertain = {bead_sweep_uncertainty(o->sweep, panel, place),
                                  bead_sweep_clean_uncertainty(o->sweep, panel, place), NAN};
    BEAD_TRY(bead_sweep_threshold_uncertainty(s, o->output->sweep_curves.threshold, uncertain.force, uncertain.clean,
                                              &uncertain.threshold, msg));
    for (size_t i = 0; i < s->row_count; i++) {
        names(o, panel, place);
        write_row(o, s, &s->rows[i], &uncertain);
    }
    return BEAD_OK;
}

static enum bead_error write_magnetism(const struct out *o, struct bead_message *msg)
{
    head(
        o,
        "magnetism,configurations,mean,standard_error,median,minimum,maximum,lower_quartile,upper_quartile,mean_N,standard_error_N,"
        "median_N,plateau,plateau_error,threshold,threshold_error,uncertainty,uncertainty_N,plateau_uncertainty,"
        "threshold_uncertainty,median_uncertainty,minimum_uncertainty,maximum_uncertainty,lower_quartile_uncertainty,"
        "upper_quartile_uncertainty,median_N_uncertainty");
    for (size_t p = 0; p < bead_sweep_panels(o->sweep); p++) {
        for (size_t place = 0; place < bead_sweep_panel(o->sweep, p)->places; place++) {
            struct bead_sweep_statistics s;
            enum bead_error err = bead_sweep_statistics(o->sweep, p, place, o->output->sweep_curves.threshold, &s, msg);
            if (err)
                return err;
            err = write_magnetisms(o, p, place, &s, msg);
            bead_sweep_statistics_free(&s);
            if (err)
                return err;
        }
    }
    return BEAD_OK;
}

/* Relative uncertainty of a place's forces and their times, where it was not measured: the worst measured. */
struct worst {
    double force, time;
};

/* The worst of each place; to be freed with free(). Errors: MEMORY. */
static enum bead_error find_worst(const struct out *o, size_t panel, struct worst **worst, struct bead_message *msg)
{
    const size_t places = bead_sweep_panel(o->sweep, panel)->places;
    BEAD_TRY(bead_new(worst, places, msg, "a table"));
    for (size_t i = 0; i < places; i++)
        (*worst)[i] = (struct worst){bead_sweep_uncertainty(o->sweep, panel, i), bead_sweep_time_uncertainty(o->sweep, panel, i)};
    return BEAD_OK;
}

static double force_uncertainty(const struct bead_sweep_peak *peak, const struct worst *worst)
{
    return peak->uncertainty > 0 ? peak->uncertainty : worst->force * peak->force;
}

static double time_uncertainty(const struct bead_sweep_peak *peak, const struct worst *worst)
{
    return peak->time_uncertainty != 0 ? peak->time_uncertainty : worst->time * peak->time;
}

/* The ratio of two forces, which are both uncertain. */
static double ratio_uncertainty(const struct bead_sweep_peak *peak, const struct bead_sweep_peak *by, const struct worst *worst)
{
    return (force_uncertainty(peak, worst) + peak->force / by->force * force_uncertainty(by, worst)) / by->force;
}

/* The keys' values of a chain, as in the scene. */
static void write_keys(const struct out *o, size_t panel, size_t index)
{
    const struct bead_over *over = &bead_sweep_panel(o->sweep, panel)->spec->over;
    for (size_t k = 0; k < over->key_count; k++) {
        fputc(',', o->file);
        bead_table_text(o->file, over->keys[k].text[bead_sweep_value(o->sweep, panel, index, k)]);
    }
}

/* A row of configuration `index`: over keys without its spins, and not normalised. */
static void write_configuration(const struct out *o, size_t panel, size_t index, size_t place, const struct worst *worst)
{
    struct bead_sweep_configuration clean, c;
    const bool normal = bead_sweep_configuration(o->sweep, panel, BEAD_SWEEP_CLEAN, &clean);
    if (!bead_sweep_configuration(o->sweep, panel, index, &c))
        return;
    const struct bead_sweep_peak *peak = &c.peaks[place], *by = normal ? &clean.peaks[place] : NULL;
    names(o, panel, place);
    fprintf(o->file, "%zu", index);
    if (o->over) {
        write_keys(o, panel, index);
    } else {
        bead_table_known(o->file, c.magnetism);
        bead_table_known(o->file, by ? peak->force / by->force : NAN);
    }
    bead_table_known(o->file, peak->force);
    bead_table_known(o->file, peak->time);
    fprintf(o->file, ",%zu", (size_t)peak->bead);
    if (!o->over)
        fprintf(o->file, ",%.*s", (int)bead_sweep_panel(o->sweep, panel)->spec->cells, c.spins);
    fprintf(o->file, ",%s", peak->open ? "open" : "");
    bead_table_known_uncertainty(o->file, force_uncertainty(peak, worst));
    bead_table_known_uncertainty(o->file, time_uncertainty(peak, worst));
    if (!o->over)
        bead_table_known_uncertainty(o->file, by ? ratio_uncertainty(peak, by, worst) : NAN);
    fputc('\n', o->file);
}

static enum bead_error write_configurations(const struct out *o, struct bead_message *msg)
{
    const struct bead_over *over = &bead_sweep_panel(o->sweep, 0)->spec->over;
    if (o->over)
        fprintf(o->file, "%sconfiguration", o->places ? "place," : "");
    else
        head(o, "configuration,magnetism,normalised,peak_force_N,time_s,bead,spins,state,uncertainty_N,time_s_uncertainty,"
                "normalised_uncertainty");
    for (size_t k = 0; k < over->key_count; k++) {
        fputc(',', o->file);
        bead_table_text(o->file, over->keys[k].path);
    }
    if (o->over)
        fputs(",peak_force_N,time_s,bead,state,uncertainty_N,time_s_uncertainty\n", o->file);
    for (size_t p = 0; p < bead_sweep_panels(o->sweep); p++) {
        const struct bead_sweep_panel *panel = bead_sweep_panel(o->sweep, p);
        BEAD_FREED struct worst *worst = NULL;
        BEAD_TRY(find_worst(o, p, &worst, msg));
        for (size_t i = 0; i < panel->configurations * panel->places; i++)
            write_configuration(o, p, i / panel->places, i % panel->places, &worst[i % panel->places]);
    }
    return BEAD_OK;
}

static enum bead_error write_decay(const struct out *o, struct bead_message *msg)
{
    head(o, "magnetism,configurations,bead,force_N,energy_J,force_length,force_length_error,energy_length,energy_length_error,"
            "force_exponent,force_exponent_error,energy_exponent,energy_exponent_error,fit_first,fit_last,force_participation,"
            "energy_participation,force_uncertainty_N,energy_uncertainty_J,force_length_uncertainty,energy_length_uncertainty,"
            "force_exponent_uncertainty,energy_exponent_uncertainty,force_participation_uncertainty,"
            "energy_participation_uncertainty");
    for (size_t p = 0; p < bead_sweep_panels(o->sweep); p++) {
        struct bead_sweep_decay *decays = NULL;
        size_t count = 0;
        enum bead_error err = bead_sweep_decays(o->sweep, p, &decays, &count, msg);
        if (err)
            return err;
        for (size_t i = 0; i < count; i++) {
            const struct bead_sweep_decay *d = &decays[i];
            const struct bead_decay *f = &d->of_force, *e = &d->of_energy;
            const struct bead_decay_uncertainty *uf = &d->uncertain[0], *ue = &d->uncertain[1];
            const double fits[] = {f->length,
                                   f->length_error,
                                   e->length,
                                   e->length_error,
                                   f->exponent,
                                   f->exponent_error,
                                   e->exponent,
                                   e->exponent_error,
                                   (double)f->first,
                                   (double)f->last,
                                   d->force_participation,
                                   d->energy_participation};
            const double known[] = {uf->length, ue->length, uf->exponent, ue->exponent, uf->participation, ue->participation};
            for (size_t j = 0; j < bead_sweep_panel(o->sweep, p)->beads; j++) {
                names(o, p, 0);
                bead_write_number(o->file, d->magnetism);
                fprintf(o->file, ",%zu,%zu", d->count, j);
                bead_table_known(o->file, d->force[j]);
                bead_table_known(o->file, d->energy[j]);
                for (size_t k = 0; k < sizeof fits / sizeof *fits; k++)
                    bead_table_known(o->file, fits[k]);
                bead_table_known_uncertainty(o->file, uf->peaks[j]);
                bead_table_known_uncertainty(o->file, ue->peaks[j]);
                for (size_t k = 0; k < sizeof known / sizeof *known; k++)
                    bead_table_known_uncertainty(o->file, known[k]);
                fputc('\n', o->file);
            }
        }
        bead_sweep_decays_free(decays, count);
    }
    return BEAD_OK;
}

/* ---- over keys ---- */

static void write_curve(const struct out *o, size_t place, const struct bead_sweep_curve *curve, const struct bead_over_key *along)
{
    for (size_t i = 0; i < curve->count; i++) {
        const struct bead_summary *m = &curve->points[i].summary;
        const double numbers[] = {m->mean, m->standard_error, m->median, m->low, m->high, m->quartile[0], m->quartile[1]};
        const struct bead_summary *u = &curve->points[i].uncertainty;
        const double known[] = {u->mean, curve->slope_uncertainty, u->median, u->low, u->high, u->quartile[0], u->quartile[1]};
        names(o, 0, place);
        bead_table_text(o->file, along->text[curve->points[i].value]);
        fputc(',', o->file);
        bead_table_text(o->file, curve->name);
        fprintf(o->file, ",%zu", m->count);
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
            bead_table_known(o->file, numbers[k]);
        bead_table_known(o->file, curve->slope);
        bead_table_known(o->file, curve->slope_error);
        for (size_t k = 0; k < sizeof known / sizeof *known; k++)
            bead_table_known_uncertainty(o->file, known[k]);
        fputc('\n', o->file);
    }
}

static enum bead_error write_place(const struct out *o, size_t place, const struct bead_sweep_values *values, const char *unit,
                                   struct bead_message *msg)
{
    struct bead_sweep_curves curves;
    enum bead_error err = bead_sweep_curves_find(o->sweep, 0, place, values, o->output->sweep_curves.against, &curves, msg);
    const struct bead_over_key *along = &bead_sweep_panel(o->sweep, 0)->spec->over.keys[curves.key];
    static const char *const columns[] = {"mean",    "standard_error", "median",        "minimum",
                                          "maximum", "lower_quartile", "upper_quartile"};
    if (place == 0 && !err) {
        fprintf(o->file, "%s%s,curve,configurations", o->places ? "place," : "", along->path);
        for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
            fprintf(o->file, ",%s%s%s", columns[i], *unit ? "_" : "", unit);
        fprintf(o->file, ",slope,slope_error,uncertainty%s%s,slope_uncertainty", *unit ? "_" : "", unit);
        for (size_t i = 2; i < sizeof columns / sizeof *columns; i++) /* all but the mean, and its standard error */
            fprintf(o->file, ",%s%s%s_uncertainty", columns[i], *unit ? "_" : "", unit);
        fputc('\n', o->file);
    }
    for (size_t i = 0; !err && i < curves.count; i++)
        write_curve(o, place, &curves.curves[i], along);
    bead_sweep_curves_free(&curves);
    return err;
}

static enum bead_error write_statistics(const struct out *o, struct bead_message *msg)
{
    const char *measure = o->output->sweep_curves.measure, *unit = "N";
    const size_t places = *measure ? 1 : bead_sweep_panel(o->sweep, 0)->places;
    struct bead_sweep_values values = {NULL, NULL};
    enum bead_error err = *measure ? bead_sweep_measured(o->sweep, measure, o->settings, &values, &unit, msg) : BEAD_OK;
    for (size_t place = 0; !err && place < places; place++)
        err = write_place(o, place, *measure ? &values : NULL, unit, msg);
    bead_sweep_values_free(&values);
    return err;
}

static enum bead_error write_lines(const struct out *o, struct bead_message *msg)
{
    return bead_sweep_lines_write(o->file, o->sweep, o->output, o->settings, msg);
}

/* A kind of table, over spins and over keys; NULL: not of these. */
static const struct kind {
    enum bead_sweep_show show;
    const char *why;
    bool of_places;
    enum bead_error (*write)(const struct out *out, struct bead_message *msg),
        (*write_over)(const struct out *out, struct bead_message *msg);
} kinds[] = {{BEAD_SWEEP_MAGNETISM, "statistics of the peak forces of every magnetism, and the threshold, or against a key", true,
              write_magnetism, write_statistics},
             {BEAD_SWEEP_CONFIGURATIONS, "peak force of every configuration, with its spins or values of keys", true,
              write_configurations, write_configurations},
             {BEAD_SWEEP_DECAY, "mean peaks along the chain, and how they decay", false, write_decay, NULL},
             {BEAD_SWEEP_SPREADING, "how far energy has spread, in chains that are run for it, averaged over seeds", false, NULL,
              write_lines},
             {BEAD_SWEEP_SENSORS, "curves of chains that are run for them, averaged over seeds", false, NULL, write_lines}};

static const struct kind *kind_of(const struct bead_output *output)
{
    const enum bead_sweep_show show =
        output->sweep_curves.show > BEAD_SWEEP_SENSORS ? BEAD_SWEEP_SENSORS : output->sweep_curves.show;
    size_t i = sizeof kinds / sizeof *kinds - 1;
    while (i > 0 && kinds[i].show != show)
        i--;
    return &kinds[i];
}

static const char *sweep_table_why(const struct bead_output *output)
{
    return *output->sweep_curves.measure ? "means of a measure of chains that are run for it" : kind_of(output)->why;
}

static enum bead_error sweep_table_fill(void *context, FILE *file, const char *, struct bead_message *msg)
{
    struct out *o = context;
    o->file = file;
    /* "C": a decimal point in any language. */
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a table");
    locale_t before = uselocale(plain);
    const struct kind *kind = kind_of(o->output);
    enum bead_error err = (o->over ? kind->write_over : kind->write)(o, msg);
    uselocale(before);
    freelocale(plain);
    return err;
}

static enum bead_error write_table(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                   uint64_t *bytes, struct bead_message *msg)
{
    const struct bead_sweep *sweep = context->sweep;
    struct out o = {.sweep = sweep,
                    .output = output,
                    .settings = context->sweep_settings,
                    .several = bead_sweep_panels(sweep) > 1,
                    .over = bead_sweep_is_over(sweep->panels)};
    for (size_t p = 0; p < bead_sweep_panels(sweep); p++)
        o.places = o.places || (!*output->sweep_curves.measure && kind_of(output)->of_places &&
                                bead_sweep_panel(sweep, p)->spec->measures.sensor_count > 0);
    return bead_file_write(path, sweep_table_fill, &o, bytes, msg);
}

const struct bead_sink_type bead_sweep_table_sink = {.name = "table",
                                                     .help = "statistics of a sweep, as comma-separated values",
                                                     .kind = BEAD_OUTPUT_TABLE,
                                                     .why = sweep_table_why,
                                                     .write = write_table};
