/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the page of a run is made of: its title, pictures and scene as HTML, and all numbers as JSON. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "beadreel/api.h"
#include "beadreel/file.h"
#include "render/draw/names.h"
#include "render/report/report_private.h"

/* Larger pictures are not put into the page. */
enum { MOST_PICTURE = 1500000, MOST_MEASURES = 128 };

static enum bead_error write_title(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    const char *title = s->context.scene->title;
    (void)msg;
    report_html(file, title && *title ? title : "beadreel");
    return BEAD_OK;
}

static enum bead_error write_scene(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    (void)msg;
    report_html(file, s->context.scene->text);
    return BEAD_OK;
}

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

/* The whole file; *count 0: it is too large. Errors: IO, MEMORY. */
static enum bead_error read_picture(const char *path, unsigned char **bytes, size_t *count, struct bead_message *msg)
{
    const uint64_t size = bead_file_bytes(path);
    *bytes = NULL;
    *count = 0;
    if (size == 0 || size > MOST_PICTURE)
        return BEAD_OK;
    FILE *file = fopen(path, "rb");
    *bytes = file ? malloc(size) : NULL;
    *count = *bytes ? fread(*bytes, 1, size, file) : 0;
    if (file)
        fclose(file);
    if (*bytes && *count == size)
        return BEAD_OK;
    return bead_fail(msg, file && !*bytes ? BEAD_ERROR_MEMORY : BEAD_ERROR_IO, "%s: cannot be read for a report", path);
}

static enum bead_error write_picture(const struct bead_sink *s, const struct bead_output *output, FILE *file,
                                     struct bead_message *msg)
{
    char *path = NULL;
    unsigned char *bytes = NULL;
    size_t count = 0;
    enum bead_error err = bead_file_join(s->context.directory, output->path, &path, msg);
    if (!err)
        err = read_picture(path, &bytes, &count, msg);
    if (!err && count > 0) {
        fputs("<figure><img alt=\"", file);
        report_html(file, output->still.caption && *output->still.caption ? output->still.caption : "Picture of the run: ");
        report_html(file, output->still.caption && *output->still.caption ? "" : output->path);
        fprintf(file, "\" src=\"data:%s;base64,", picture_type(output));
        report_base64(file, bytes, count);
        fputs("\"><figcaption>", file);
        report_html(file, output->path);
        fputs("</figcaption></figure>\n", file);
    }
    free(bytes);
    free(path);
    return err;
}

/* Those that other outputs of the scene have made in this run. */
static enum bead_error write_pictures(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    const struct bead_scene *scene = s->context.scene;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < scene->output_count && !err; i++) {
        const struct bead_output *output = &scene->outputs[i];
        bool still = output->kind == BEAD_OUTPUT_IMAGE || output->kind == BEAD_OUTPUT_PLOT;
        if (still && picture_type(output) && s->context.is_made && s->context.is_made(s->context.asker, output))
            err = write_picture(s, output, file, msg);
    }
    return err;
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
        report_key(file, true, "colour");
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

/* What the beads are, and where. */
static void write_beads(const struct report_chain *c, FILE *file)
{
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    const size_t *material = bead_chain_material(c->chain);
    char name[96];
    report_key(file, true, "radius");
    report_numbers(file, bead_chain_radius(c->chain) + c->bead.first, c->beads_shown);
    report_key(file, true, "position");
    report_numbers(file, bead_chain_position(c->chain) + c->bead.first, c->beads_shown);
    report_key(file, true, "material");
    for (size_t i = c->bead.first; i <= c->bead.last; i++)
        fprintf(file, "%c%zu", i == c->bead.first ? '[' : ',', material[i]);
    fputs("],\"sensors\":", file);
    write_sensors(c->chain, file);
    report_key(file, true, "striker");
    report_number(file, spec->striker_velocity);
    if (*bead_chain_spins(c->chain)) {
        report_key(file, true, "magnetism");
        report_number(file, bead_chain_magnetism(c->chain));
    }
    if (spec->wall != BEAD_WALL_NONE && c->bead.last + 1 == bead_chain_beads(c->chain)) {
        static const double grey[3] = {0.5, 0.5, 0.5};
        bead_wall_name(c->chain, name, sizeof name);
        fputs(",\"wall\":{\"name\":", file);
        report_string(file, name);
        report_key(file, true, "colour");
        write_colour(file,
                     spec->wall == BEAD_WALL_MATERIAL ? bead_chain_scene(c->chain)->materials[spec->wall_material].colour : grey);
        fputc('}', file);
    }
}

static void write_axis(const struct report_chain *c, bool of_contacts, FILE *file)
{
    const struct bead_chain_axis axis = bead_chain_axis(c->chain, of_contacts);
    report_key(file, true, "axis");
    fputs("{\"title\":", file);
    report_string(file, axis.title);
    fprintf(file, ",\"counts\":%s,\"first\":", *axis.unit ? "true" : "false");
    report_number(file, axis.first + (double)c->value.first * axis.spacing);
    report_key(file, true, "spacing");
    report_number(file, axis.spacing);
    fputc('}', file);
}

/* Peak forces of all contacts, with uncertainty. */
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
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        report_key(file, true, numbers[i].name);
        report_number(file, numbers[i].value);
    }
    fputc('}', file);
}

static void write_measure(const struct bead_measure *measure, bool first, FILE *file)
{
    fputs(first ? "{\"name\":" : ",\n{\"name\":", file);
    report_string(file, measure->name);
    report_key(file, true, "unit");
    report_string(file, measure->unit);
    report_key(file, true, "value");
    report_number(file, measure->value);
    report_key(file, true, "note");
    report_string(file, measure->note);
    fputc('}', file);
}

/* Those of beads, or of an equation. */
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
    const struct report_chain *c = &s->chains[index];
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    fputs(index ? ",\n{\"name\":" : "{\"name\":", file);
    report_string(file, spec->title && *spec->title ? spec->title : bead_chain_name(c->chain));
    report_key(file, true, "label");
    report_string(file, spec->label ? spec->label : "");
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
    report_key(file, true, "field");
    enum bead_error err = report_samples(file, c->field, c->kept * c->values, msg);
    if (!err && c->beads) {
        report_key(file, true, "displacement");
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
    fputs("{\"kind\":\"run\",\"program\":\"beadreel " BEADREEL_VERSION "\",\"title\":", file);
    report_string(file, s->context.scene->title ? s->context.scene->title : "");
    fputs(",\"time\":{\"start\":", file);
    report_number(file, s->grid.start);
    report_key(file, true, "every");
    report_number(file, s->grid.every);
    fprintf(file, ",\"count\":%zu,\"unit\":", samples);
    report_string(file, bead_chain_time_unit(s->context.chains[0]));
    fputs("},", file);
    report_field(file, own ? own : bead_field_info(field), field);
    report_range(file, &s->range, s->output->colours.scale);
    report_maps(file, s->maps);
    fputs("\"magnify\":", file);
    report_number(file, s->magnify);
    fputs(",\"materials\":", file);
    write_materials(s->context.scene, file);
    fputs(",\n\"chains\":[", file);
    for (size_t i = 0; i < s->chain_count && !err; i++)
        err = write_chain(s, i, file, msg);
    fputs("]}", file);
    return err;
}

static const char *const scripts[] = {"data.js", "axes.js", "chain.js", "chart.js", "page.js", "run.js", "start.js", NULL};
static const struct report_part parts[] = {
    {"title", write_title}, {"pictures", write_pictures}, {"scene", write_scene}, {"data", write_data}, {NULL, NULL}};
const struct report_page report_run_page = {"controls", "run.html", scripts, parts};
