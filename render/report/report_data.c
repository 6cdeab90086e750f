/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contents of a run's page: its pictures as HTML, and all numbers as JSON. */
#include <math.h>
#include <strings.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/origin/origin.h"
#include "render/report/report_private.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

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

/* The caption as a sentence, then what happens. */
static enum bead_error write_alternative(const struct bead_sink *s, const char *caption, FILE *file, struct bead_message *msg)
{
    char tale[BEAD_TALE_WORDS];
    const size_t size = caption ? strlen(caption) + 1 : 1;
    BEAD_FREED char *plain = malloc(size);
    if (!plain || !bead_markup_plain(caption ? caption : "", plain, size))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report");
    bead_origin_escape(*plain ? plain : "Picture of the run.", file);
    bead_tale_words(s->tale, tale, sizeof tale);
    if (*tale)
        fputs(*plain && !strchr(".!?", plain[strlen(plain) - 1]) ? ". " : " ", file);
    bead_origin_escape(tale, file);
    return BEAD_OK;
}

/* Writes a picture unless it is too large. */
static enum bead_error write_picture(const struct bead_sink *s, const struct bead_output *output, FILE *file,
                                     struct bead_message *msg)
{
    BEAD_FREED char *path = NULL;
    BEAD_FREED char *bytes = NULL;
    size_t count = 0;
    BEAD_TRY(bead_file_join(s->context.directory, output->path, &path, msg));
    const uint64_t size = bead_file_bytes(path);
    if (size > MOST_PICTURE || size == 0)
        return BEAD_OK;
    BEAD_TRY(bead_file_read(path, size, &bytes, &count, msg));
    fputs("<figure><img alt=\"", file);
    BEAD_TRY(write_alternative(s, output->still.caption, file, msg));
    fprintf(file, "\" src=\"data:%s;base64,", picture_type(output));
    report_base64(file, (const unsigned char *)bytes, count);
    fputs("\"><figcaption>", file);
    bead_origin_escape(output->path, file);
    fputs("</figcaption></figure>\n", file);
    return BEAD_OK;
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

static void write_colour(struct bead_json *json, const double colour[3])
{
    double levels[3];
    for (int c = 0; c < 3; c++)
        levels[c] = round(255 * fmin(1, fmax(0, colour[c])));
    bead_json_numbers(json, "colour", levels, 3);
}

static void write_materials(struct bead_json *json, const struct bead_scene *scene)
{
    bead_json_open(json, "materials", '[');
    for (size_t i = 0; i < scene->material_count; i++) {
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "name", scene->materials[i].label);
        write_colour(json, scene->materials[i].colour);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
}

static void write_wall(struct bead_json *json, const struct bead_chain *chain)
{
    static const double grey[3] = {0.5, 0.5, 0.5};
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    char name[96];
    bead_wall_name(chain, name, sizeof name);
    bead_json_open(json, "wall", '{');
    bead_json_text(json, "name", name);
    write_colour(json, spec->wall == BEAD_WALL_MATERIAL ? bead_chain_scene(chain)->materials[spec->wall_material].colour : grey);
    bead_json_close(json, "}");
}

/* Materials, sizes and places of the beads. */
static void write_beads(struct bead_json *json, const struct report_chain *c)
{
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    const size_t *material = bead_chain_material(c->chain);
    bead_json_numbers(json, "radius", bead_chain_radius(c->chain) + c->bead.first, c->beads_shown);
    bead_json_numbers(json, "position", bead_chain_position(c->chain) + c->bead.first, c->beads_shown);
    bead_json_open(json, "material", '[');
    for (size_t i = c->bead.first; i <= c->bead.last; i++)
        bead_json_number(json, NULL, (double)material[i]);
    bead_json_close(json, "]");
    bead_chain_write_sensors(json, c->chain);
    bead_json_number(json, "striker", spec->striker_velocity);
    if (*bead_chain_spins(c->chain))
        bead_json_number(json, "magnetism", bead_chain_magnetism(c->chain));
    if (spec->wall != BEAD_WALL_NONE && c->bead.last + 1 == bead_chain_beads(c->chain))
        write_wall(json, c->chain);
}

static void write_axis(struct bead_json *json, const struct report_chain *c, bool of_contacts)
{
    const struct bead_chain_axis axis = bead_chain_axis(c->chain, of_contacts);
    bead_json_open(json, "axis", '{');
    bead_json_text(json, "title", axis.title);
    bead_json_flag(json, "counts", *axis.unit);
    bead_json_number(json, "first", axis.first + (double)c->value.first * axis.spacing);
    bead_json_number(json, "spacing", axis.spacing);
    bead_json_close(json, "}");
}

/* Writes the peak forces of all contacts, with uncertainty. */
static void write_peaks(struct bead_json *json, const struct report_chain *c, const struct bead_outcome *outcome)
{
    const size_t count = bead_chain_contacts(c->chain);
    const struct bead_peak *peaks = outcome->contact_peaks;
    bead_json_open(json, "peaks", '{');
    bead_json_open(json, "force", '[');
    for (size_t i = 0; i < count; i++)
        bead_json_number(json, NULL, isnan(peaks[i].time) && peaks[i].value == 0 ? NAN : peaks[i].value);
    bead_json_close(json, "]");
    bead_json_open(json, "time", '[');
    for (size_t i = 0; i < count; i++)
        bead_json_number(json, NULL, peaks[i].time);
    bead_json_close(json, "]");
    bead_json_open(json, "open", '[');
    for (size_t i = 0; i < count; i++) {
        if (peaks[i].open)
            bead_json_number(json, NULL, (double)i);
    }
    bead_json_close(json, "]");
    bead_json_numbers(json, "uncertainty", outcome->contact_uncertainty, outcome->contact_uncertainty ? count : 0);
    bead_json_numbers(json, "time_uncertainty", outcome->contact_time_uncertainty, outcome->contact_time_uncertainty ? count : 0);
    bead_json_close(json, "}");
}

struct named {
    const char *name;
    double value;
};

static void write_named(struct bead_json *json, const struct named *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        bead_json_number(json, numbers[i].name, numbers[i].value);
}

static void write_outcome(struct bead_json *json, const struct bead_outcome *o)
{
    const struct named numbers[] = {{"end", o->end},
                                    {"arrival", o->front_arrival},
                                    {"step", o->step},
                                    {"energyError", o->energy_error},
                                    {"embeddedError", o->embedded_error},
                                    {"eventError", o->event_error}};
    bead_json_open(json, "run", '{');
    bead_json_text(json, "method", o->method ? o->method : "");
    write_named(json, numbers, sizeof numbers / sizeof *numbers);
    bead_json_close(json, "}");
}

static void write_listed(struct bead_json *json, const struct bead_measure *measures, size_t count,
                         const struct bead_measure *checks, size_t checked)
{
    for (size_t i = 0; i < count; i++) {
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "name", measures[i].name);
        bead_json_text(json, "unit", measures[i].unit);
        bead_json_number(json, "value", measures[i].value);
        bead_json_number(json, "uncertainty", bead_measure_uncertainty(&measures[i], checks, checked));
        bead_json_text(json, "note", measures[i].note);
        bead_json_close(json, "}");
    }
}

static size_t read_measures(struct bead_measures *measures, const struct bead_outcome *outcome,
                            struct bead_measure found[MOST_MEASURES])
{
    const size_t count = measures ? bead_measures_read(measures, outcome, found, MOST_MEASURES) : 0;
    return count < MOST_MEASURES ? count : MOST_MEASURES;
}

/* Writes the measures of beads, or of an equation, and how well they are known. */
static void write_measures(struct bead_json *json, const struct report_chain *c, const struct bead_outcome *o)
{
    struct bead_measure found[MOST_MEASURES], checks[MOST_MEASURES];
    static const struct bead_outcome none;
    const struct bead_outcome *check = c->unknown || !o->check ? &none : o->check;
    const size_t count = read_measures(c->measures, o, found), checked = read_measures(c->check, check, checks);
    bead_json_open(json, "measures", '[');
    write_listed(json, found, count, checks, checked);
    write_listed(json, o->measures, o->measure_count, check->measures, check->measure_count);
    bead_json_close(json, "]");
}

static enum bead_error write_chain(const struct bead_sink *s, size_t index, struct bead_json *json, struct bead_message *msg)
{
    char tale[BEAD_TALE_WORDS];
    const struct report_chain *c = &s->chains[index];
    const struct bead_chain_spec *spec = bead_chain_spec(c->chain);
    const struct named numbers[] = {{"first", (double)c->value.first},
                                    {"values", (double)c->values},
                                    {"firstBead", (double)c->bead.first},
                                    {"beads", (double)c->beads_shown},
                                    {"total", (double)bead_chain_beads(c->chain)}};
    bead_tale_of_chain(s->tale, index, tale, sizeof tale);
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "name", spec->title && *spec->title ? spec->title : bead_chain_name(c->chain));
    bead_json_text(json, "label", spec->label ? spec->label : "");
    bead_json_text(json, "tale", tale);
    write_named(json, numbers, sizeof numbers / sizeof *numbers);
    write_axis(json, c, bead_field_info(s->output->shown.field)->of_contacts);
    if (c->beads)
        write_beads(json, c);
    if (s->outcomes) {
        write_outcome(json, &s->outcomes[index]);
        write_measures(json, c, &s->outcomes[index]);
        if (c->beads && s->peaks && s->outcomes[index].contact_peaks)
            write_peaks(json, c, &s->outcomes[index]);
    }
    BEAD_TRY(report_samples(json, "field", c->field, c->kept * c->values, msg));
    if (c->beads)
        BEAD_TRY(report_samples(json, "displacement", c->displacement, c->kept * c->beads_shown, msg));
    bead_json_close(json, "}");
    return BEAD_OK;
}

static enum bead_error write_data(const void *context, FILE *file, struct bead_message *msg)
{
    const struct bead_sink *s = context;
    const enum bead_field field = s->output->shown.field;
    const struct bead_field_info *own = bead_chain_field(s->context.chains[0], field), *info = own ? own : bead_field_info(field);
    const bool named = bead_chain_spec(s->context.chains[0])->system->names_fields;
    struct bead_json json = REPORT_JSON(file);
    report_open(&json, s->context.scene);
    bead_json_open(&json, "time", '{');
    bead_json_number(&json, "start", s->grid.start);
    bead_json_number(&json, "every", s->grid.every);
    bead_json_number(&json, "count", (double)s->chains[0].kept);
    bead_json_text(&json, "unit", bead_chain_time_unit(s->context.chains[0]));
    bead_json_flag(&json, "held", s->held);
    bead_json_close(&json, "}");
    report_field(&json, info, named ? info->title : bead_field_info(field)->name);
    report_range(&json, &s->range, bead_colour_range_colours(s->output, &s->range, NULL).scale);
    report_maps(&json, s->maps);
    bead_json_number(&json, "magnify", s->magnify);
    write_materials(&json, s->context.scene);
    bead_json_open(&json, "chains", '[');
    for (size_t i = 0; i < s->chain_count; i++)
        BEAD_TRY(write_chain(s, i, &json, msg));
    bead_json_close(&json, "]}");
    return BEAD_OK;
}

static const char *const scripts[] = {"data.js", "axes.js", "chain.js", "chart.js", "page.js",
                                      "save.js", "run.js",  "start.js", NULL};
static const struct report_part parts[] = {{"pictures", write_pictures}, {"data", write_data}, {NULL, NULL}};
const struct report_page report_run_page = {"controls", "run.html", scripts, parts};
