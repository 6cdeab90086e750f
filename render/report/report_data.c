/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contents of a run's page: its pictures as HTML, and all numbers as JSON. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include "render/draw/names.h"
#include "render/report/report_private.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"

/* Larger pictures are not put into the page. */
enum { MOST_PICTURE = 1500000, MOST_MEASURES = 128 };

/* ---- pictures ---- */

static const struct {
    const char *ending, *type;
} picture_types[] = {{".png", "image/png"}, {".svg", "image/svg+xml"}};

static const char *picture_type(const struct bead_output *output)
{
    const char *dot = strrchr(output->path, '.');
    for (size_t i = 0; dot && i < sizeof picture_types / sizeof *picture_types; i++) {
        if (strcasecmp(dot, picture_types[i].ending) == 0)
            return picture_types[i].type;
    }
    return NULL;
}

/* Writes a picture unless it is too large. */
static enum bead_error write_picture(const struct bead_sink *s, const struct bead_output *output, FILE *file,
                                     struct bead_message *msg)
{
    BEAD_FREED char *path = NULL;
    BEAD_FREED char *bytes = NULL;
    size_t count = 0;
    enum bead_error err = bead_file_join(s->context.directory, output->path, &path, msg);
    const uint64_t size = err ? 0 : bead_file_bytes(path);
    if (size <= MOST_PICTURE && size > 0)
        err = bead_file_read(path, size, &bytes, &count, msg);
    if (!err && count > 0) {
        char tale[BEAD_TALE_WORDS];
        bead_tale_words(s->tale, tale, sizeof tale);
        fputs("<figure><img alt=\"", file);
        report_html(file, output->still.caption && *output->still.caption ? output->still.caption : "Picture of the run.");
        fputs(*tale ? " " : "", file);
        report_html(file, tale);
        fprintf(file, "\" src=\"data:%s;base64,", picture_type(output));
        report_base64(file, (const unsigned char *)bytes, count);
        fputs("\"><figcaption>", file);
        report_html(file, output->path);
        fputs("</figcaption></figure>\n", file);
    }
    return err;
}

/* Writes the pictures that other outputs of the scene have made in this run. */
static enum bead_error write_pictures(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    const struct bead_scene *scene = s->context.scene;
    for (size_t i = 0; i < scene->output_count; i++) {
        const struct bead_output *output = &scene->outputs[i];
        bool still = output->kind == BEAD_OUTPUT_IMAGE || output->kind == BEAD_OUTPUT_PLOT;
        if (still && picture_type(output) && s->context.is_made && s->context.is_made(s->context.asker, output))
            BEAD_TRY(write_picture(s, output, file, msg));
    }
    return BEAD_OK;
}

/* ---- numbers ---- */

static void write_colour(FILE *file, const double colour[3])
{
    double levels[3];
    for (int c = 0; c < 3; c++)
        levels[c] = round(255 * fmin(1, fmax(0, colour[c])));
    report_numbers(file, levels, 3);
}

static void write_materials(const struct bead_scene *scene, FILE *file)
{
    fputc('[', file);
    for (size_t i = 0; i < scene->material_count; i++) {
        fputs(i ? ",{\"name\":" : "{\"name\":", file);
        report_string(file, scene->materials[i].label);
        report_key(file, "colour");
        write_colour(file, scene->materials[i].colour);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_sensors(const struct bead_chain *chain, FILE *file)
{
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? ",{\"name\":" : "{\"name\":", file);
        report_string(file, sensors[i].name);
        fprintf(file, ",\"bead\":%zu}", sensors[i].bead);
    }
    fputc(']', file);
}

/* Materials, sizes and places of the beads. */
static void write_beads(const struct report_chain *c, FILE *file)
{
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    const size_t *material = bead_chain_material(c->chain);
    char name[96];
    report_key(file, "radius");
    report_numbers(file, bead_chain_radius(c->chain) + c->bead.first, c->beads_shown);
    report_key(file, "position");
    report_numbers(file, bead_chain_position(c->chain) + c->bead.first, c->beads_shown);
    report_key(file, "material");
    for (size_t i = c->bead.first; i <= c->bead.last; i++)
        fprintf(file, "%c%zu", i == c->bead.first ? '[' : ',', material[i]);
    fputs("],\"sensors\":", file);
    write_sensors(c->chain, file);
    report_named_number(file, "striker", spec->striker_velocity);
    if (*bead_chain_spins(c->chain))
        report_named_number(file, "magnetism", bead_chain_magnetism(c->chain));
    if (spec->wall != BEAD_WALL_NONE && c->bead.last + 1 == bead_chain_beads(c->chain)) {
        static const double grey[3] = {0.5, 0.5, 0.5};
        bead_wall_name(c->chain, name, sizeof name);
        fputs(",\"wall\":{\"name\":", file);
        report_string(file, name);
        report_key(file, "colour");
        write_colour(file,
                     spec->wall == BEAD_WALL_MATERIAL ? bead_chain_scene(c->chain)->materials[spec->wall_material].colour : grey);
        fputc('}', file);
    }
}

static void write_axis(const struct report_chain *c, bool of_contacts, FILE *file)
{
    const struct bead_chain_axis axis = bead_chain_axis(c->chain, of_contacts);
    report_key(file, "axis");
    fputs("{\"title\":", file);
    report_string(file, axis.title);
    fprintf(file, ",\"counts\":%s,\"first\":", *axis.unit ? "true" : "false");
    report_number(file, axis.first + (double)c->value.first * axis.spacing);
    report_named_number(file, "spacing", axis.spacing);
    fputc('}', file);
}

/* Writes the peak forces of all contacts, with uncertainty. */
static void write_peaks(const struct report_chain *c, const struct bead_outcome *outcome, FILE *file)
{
    const size_t count = bead_chain_contacts(c->chain);
    const struct bead_peak *peaks = outcome->contact_peaks;
    fputs(",\"peaks\":{\"force\":[", file);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? "," : "", file);
        report_number(file, isnan(peaks[i].time) && peaks[i].value == 0 ? NAN : peaks[i].value);
    }
    fputs("],\"time\":[", file);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? "," : "", file);
        report_number(file, peaks[i].time);
    }
    fputs("],\"open\":[", file);
    for (size_t i = 0, listed = 0; i < count; i++) {
        if (peaks[i].open)
            fprintf(file, "%s%zu", listed++ ? "," : "", i);
    }
    fputs("],\"uncertainty\":", file);
    report_numbers(file, outcome->contact_uncertainty, outcome->contact_uncertainty ? count : 0);
    fputc('}', file);
}

static void write_outcome(const struct bead_outcome *o, FILE *file)
{
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"end", o->end},
                   {"arrival", o->front_arrival},
                   {"step", o->step},
                   {"steps", (double)o->steps},
                   {"energyStart", o->energy_start},
                   {"energyEnd", o->energy_end},
                   {"energyError", o->energy_error},
                   {"embeddedError", o->embedded_error},
                   {"eventError", o->event_error}};
    fputs(",\"run\":{\"method\":", file);
    report_string(file, o->method ? o->method : "");
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        report_named_number(file, numbers[i].name, numbers[i].value);
    fputc('}', file);
}

static void write_measure(const struct bead_measure *measure, bool first, FILE *file)
{
    fputs(first ? "{\"name\":" : ",\n{\"name\":", file);
    report_string(file, measure->name);
    report_named_string(file, "unit", measure->unit);
    report_named_number(file, "value", measure->value);
    report_named_string(file, "note", measure->note);
    fputc('}', file);
}

/* Writes the measures of beads, or of an equation. */
static void write_measures(const struct report_chain *c, const struct bead_outcome *o, FILE *file)
{
    struct bead_measure found[MOST_MEASURES];
    size_t count = c->measures ? bead_measures_read(c->measures, o, found, MOST_MEASURES) : 0;
    count = count < MOST_MEASURES ? count : MOST_MEASURES;
    fputs(",\"measures\":[", file);
    for (size_t i = 0; i < count; i++)
        write_measure(&found[i], i == 0, file);
    for (size_t i = 0; o->measures && i < o->measure_count; i++)
        write_measure(&o->measures[i], count + i == 0, file);
    fputc(']', file);
}

static enum bead_error write_chain(const struct bead_sink *s, size_t index, FILE *file, struct bead_message *msg)
{
    char tale[BEAD_TALE_WORDS];
    const struct report_chain *c = &s->chains[index];
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    fputs(index ? ",\n{\"name\":" : "{\"name\":", file);
    report_string(file, spec->title && *spec->title ? spec->title : bead_chain_name(c->chain));
    report_named_string(file, "label", spec->label ? spec->label : "");
    bead_tale_of_chain(s->tale, index, tale, sizeof tale);
    report_named_string(file, "tale", tale);
    fprintf(file, ",\"first\":%zu,\"values\":%zu,\"firstBead\":%zu,\"beads\":%zu,\"total\":%zu", c->value.first, c->values,
            c->bead.first, c->beads_shown, bead_chain_beads(c->chain));
    write_axis(c, bead_field_info(s->output->shown.field)->of_contacts, file);
    if (c->beads)
        write_beads(c, file);
    if (s->outcomes) {
        write_outcome(&s->outcomes[index], file);
        write_measures(c, &s->outcomes[index], file);
        if (c->beads && s->peaks && s->outcomes[index].contact_peaks)
            write_peaks(c, &s->outcomes[index], file);
    }
    report_key(file, "field");
    enum bead_error err = report_samples(file, c->field, c->kept * c->values, msg);
    if (!err && c->beads) {
        report_key(file, "displacement");
        err = report_samples(file, c->displacement, c->kept * c->beads_shown, msg);
    }
    fputc('}', file);
    return err;
}

static enum bead_error write_data(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    const enum bead_field field = s->output->shown.field;
    const struct bead_field_info *own = bead_chain_field(s->context.chains[0], field);
    size_t samples = s->chains[0].kept;
    enum bead_error err = BEAD_OK;
    report_open(file, "run", s->context.scene);
    fputs(",\"time\":{\"start\":", file);
    report_number(file, s->grid.start);
    report_named_number(file, "every", s->grid.every);
    fprintf(file, ",\"count\":%zu", samples);
    report_named_string(file, "unit", bead_chain_time_unit(s->context.chains[0]));
    fputc('}', file);
    report_field(file, own ? own : bead_field_info(field), field);
    report_range(file, &s->range, s->output->colours.scale);
    report_maps(file, s->maps);
    report_named_number(file, "magnify", s->magnify);
    fputs(",\"materials\":", file);
    write_materials(s->context.scene, file);
    fputs(",\n\"chains\":[", file);
    for (size_t i = 0; i < s->chain_count && !err; i++)
        err = write_chain(s, i, file, msg);
    fputs("]}", file);
    return err;
}

static const char *const scripts[] = {"data.js", "axes.js", "chain.js", "chart.js", "page.js", "run.js", "start.js", NULL};
static const struct report_part parts[] = {{"pictures", write_pictures}, {"data", write_data}, {NULL, NULL}};
const struct report_page report_run_page = {"controls", "run.html", scripts, parts};
