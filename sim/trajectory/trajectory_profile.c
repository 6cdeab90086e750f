/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes all of a trajectory but its samples, see trajectory_layout.h. */
#include "sim/trajectory/trajectory_sink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"

bool bead_trajectory_wants(const struct bead_sink *sink, enum bead_series_id id)
{
    if (!(sink->fields & BEAD_FIELD_BIT(bead_series[id].field)))
        return false;
    if (id == BEAD_SERIES_POSITION) /* an equation's displacement need not be a motion along the chain */
        return sink->context.chains[0]->spec->system->has_masses;
    /* A net force needs both contacts; a replayed trajectory may hold bead forces only. */
    if (id == BEAD_SERIES_NET_FORCE && sink->context.native.every > 0)
        return (sink->fields & BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE)) != 0;
    return true;
}

/* Units of series and constants: "1" if numbers have no units. */
static const char *units_of(const struct bead_sink *sink, const char *units)
{
    return *bead_chain_time_unit(sink->context.chains[0]) ? units : "1";
}

/* Zeroed memory for an array; NULL after a failure, of this or before. */
static void *take(struct bead_sink *sink, size_t count, size_t size)
{
    if (sink->h5.error)
        return NULL;
    void *taken = calloc(count ? count : 1, size);
    if (!taken)
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu numbers", sink->part, count);
    return taken;
}

static void write_along(struct bead_sink *sink, const char *name, const char *units, enum bead_h5_type type, bool of_contacts,
                        const void *values)
{
    bead_h5_write_numbers(&sink->h5, sink->h5.file, name, units, of_contacts ? sink->contact_scale : sink->bead_scale, type, values,
                          sizeof(double), of_contacts ? sink->contacts : sink->beads);
}

static void write_constant(struct bead_sink *sink, const char *name, const char *units,
                           const double *(*values)(const struct bead_chain *), bool of_contacts)
{
    double *all = take(sink, of_contacts ? sink->contacts : sink->beads, sizeof *all);
    for (size_t c = 0; all && c < sink->context.chain_count; c++) {
        const struct bead_rows *rows = bead_rows_of(&sink->rows[c], of_contacts);
        if (rows->count)
            memcpy(all + rows->row, values(sink->context.chains[c]) + rows->first, rows->count * sizeof *all);
    }
    if (all)
        write_along(sink, name, units, BEAD_H5_DOUBLE, of_contacts, all);
    free(all);
}

/* The unit of the contacts' coefficients. UDUNITS-2 knows no fractional powers and reads "m-1.5" as 0.5 m-1; it rejects the
 * spelling used here, which is better than a wrong conversion. */
static void coefficient_unit(const struct bead_sink *sink, char *unit, size_t size)
{
    double power = 0;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        const struct bead_law_spec *spec = &bead_chain_spec(sink->context.chains[c])->law;
        const double p = spec->row->coefficient_power(spec);
        if (c > 0 && p != power) {
            snprintf(unit, size, "N/m^p, with the power p of each chain");
            return;
        }
        power = p;
    }
    if (power == floor(power))
        snprintf(unit, size, "N m-%g", power);
    else if (2 * power == floor(2 * power))
        snprintf(unit, size, "N m^(-%g/2)", 2 * power);
    else
        snprintf(unit, size, "N m^(-%g)", power);
}

static void write_stiffness(struct bead_sink *sink)
{
    char unit[48];
    coefficient_unit(sink, unit, sizeof unit);
    write_constant(sink, "/contacts/stiffness", units_of(sink, unit), bead_chain_stiffness, true);
}

/* Integers that label the rows of an axis. */
static int64_t number_of(const struct bead_sink *, size_t, size_t index, size_t)
{
    return (int64_t)index;
}
static int64_t chain_of(const struct bead_sink *, size_t chain, size_t, size_t)
{
    return (int64_t)chain;
}
static int64_t identity_of(const struct bead_sink *, size_t, size_t index, size_t before)
{
    return (int64_t)(before + index);
}
static int64_t species_of(const struct bead_sink *sink, size_t chain, size_t index, size_t)
{
    return (int64_t)bead_chain_material(sink->context.chains[chain])[index];
}

typedef int64_t (*label_function)(const struct bead_sink *, size_t chain, size_t index, size_t before);

static void write_labels(struct bead_sink *sink, const char *name, label_function label, bool of_contacts)
{
    size_t before = 0;
    int64_t *all = take(sink, of_contacts ? sink->contacts : sink->beads, sizeof *all);
    for (size_t c = 0; all && c < sink->context.chain_count; c++) {
        const struct bead_rows *rows = bead_rows_of(&sink->rows[c], of_contacts);
        for (size_t i = 0; i < rows->count; i++)
            all[rows->row + i] = label(sink, c, rows->first + i, before);
        before += bead_chain_beads(sink->context.chains[c]);
    }
    if (all)
        write_along(sink, name, NULL, BEAD_H5_INT, of_contacts, all);
    free(all);
}

/* The axis of beads, or contacts, labelled with their numbers within their chains. */
static hid_t make_axis(struct bead_sink *sink, const char *path, const char *name, bool of_contacts)
{
    write_labels(sink, path, number_of, of_contacts);
    return bead_h5_open_scale(&sink->h5, sink->h5.file, path, name);
}

static void lay_out_axes(struct bead_sink *sink)
{
    struct bead_h5 *h5 = &sink->h5;
    sink->time = bead_h5_make_series(h5, h5->file, "/time", units_of(sink, "s"), false, 1024, 0, 1);
    bead_h5_make_scale(h5, sink->time, "time");
    sink->step = bead_h5_make_series(h5, h5->file, "/step", NULL, true, 1024, 0, 1);
    bead_h5_attach(h5, sink->step, 0, sink->time);
    sink->bead_scale = make_axis(sink, "/particles/chain/bead", "bead", false);
    static const char *const axes[] = {"x", "y", "z"};
    bead_h5_write_texts(h5, h5->file, "/particles/chain/spatial", axes, sizeof *axes, 3);
    sink->spatial_scale = bead_h5_open_scale(h5, h5->file, "/particles/chain/spatial", "spatial");
    if (sink->fields & BEAD_TRAJECTORY_CONTACTS)
        sink->contact_scale = make_axis(sink, "/contacts/contact", "contact", true);
}

static const char *long_name(const struct bead_sink *sink, const struct bead_series_info *info)
{
    const struct bead_chain *chain = sink->context.chains[0];
    return bead_chain_spec(chain)->system->names_fields && info->stored ? bead_chain_field(chain, info->field)->title : info->title;
}

/* Make the group a NeXus plot, which H5Web and silx draw. The axis of several chains has no scale: the numbers of beads begin again
 * with each chain. */
static void describe_plot(struct bead_sink *sink, const struct bead_series_info *info, hid_t group)
{
    const bool several = sink->context.chain_count > 1;
    const char *const axes[] = {"time", several ? "." : info->of_contacts ? "contact" : "bead", "."};
    bead_h5_put_text(&sink->h5, group, "NX_class", "NXdata");
    bead_h5_put_text(&sink->h5, group, "signal", "value");
    bead_h5_put_texts(&sink->h5, group, "axes", axes, info->components > 1 ? 3 : 2);
}

static void lay_out_series(struct bead_sink *sink, enum bead_series_id id)
{
    const struct bead_series_info *info = &bead_series[id];
    struct bead_h5 *h5 = &sink->h5;
    hid_t axis = info->of_contacts ? sink->contact_scale : sink->bead_scale, group = bead_h5_make_group(h5, h5->file, info->group);
    hid_t value = bead_h5_make_series(h5, group, "value", units_of(sink, info->units), false, sink->chunk_rows,
                                      sink->series[id].columns, info->components);
    if (value >= 0)
        bead_h5_put_text(h5, value, "long_name", long_name(sink, info));
    bead_h5_link(h5, sink->time, group, "time");
    bead_h5_link(h5, sink->step, group, "step");
    bead_h5_link(h5, axis, group, info->of_contacts ? "contact" : "bead");
    bead_h5_attach(h5, value, 0, sink->time);
    bead_h5_attach(h5, value, 1, axis);
    if (info->components > 1) {
        bead_h5_link(h5, sink->spatial_scale, group, "spatial");
        bead_h5_attach(h5, value, 2, sink->spatial_scale);
    }
    describe_plot(sink, info, group);
    sink->series[id].value = value;
    bead_h5_close(h5, &group);
}

static void put_default(struct bead_sink *sink, const char *path, const char *class, const char *child)
{
    hid_t group = bead_h5_open_group(&sink->h5, path);
    bead_h5_put_text(&sink->h5, group, "NX_class", class);
    bead_h5_put_text(&sink->h5, group, "default", child);
    bead_h5_close(&sink->h5, &group);
}

/* NeXus: from the root on, each group names the next on the way to the default plot. The most informative field is preferred. */
static void write_nexus(struct bead_sink *sink)
{
    static const enum bead_series_id order[] = {BEAD_SERIES_BEAD_FORCE,   BEAD_SERIES_STRAIN, BEAD_SERIES_VELOCITY,
                                                BEAD_SERIES_DISPLACEMENT, BEAD_SERIES_ENERGY, BEAD_SERIES_CONTACT_FORCE,
                                                BEAD_SERIES_COMPRESSION};
    size_t first = 0, count = sizeof order / sizeof *order;
    while (first + 1 < count && !bead_trajectory_wants(sink, order[first]))
        first++;
    const struct bead_series_info *shown = &bead_series[order[first]];
    const char *name = strrchr(shown->group, '/') + 1;
    put_default(sink, "/", "NXroot", shown->of_contacts ? "contacts" : "particles");
    put_default(sink, "/particles", "NXentry", "chain");
    if (shown->of_contacts)
        put_default(sink, "/contacts", "NXentry", name);
    else
        put_default(sink, "/particles/chain", "NXcollection", name);
}

static void write_h5md(struct bead_sink *sink)
{
    struct bead_h5 *h5 = &sink->h5;
    static const int64_t version[2] = {1, 1};
    static const int64_t dimension = 3;
    static const char *const boundary[] = {"none", "none", "none"};
    const char *named = sink->context.scene->author;
    hid_t group = bead_h5_make_group(h5, h5->file, "/h5md");
    bead_h5_put_ints(h5, group, "version", version, 2);
    hid_t author = bead_h5_make_group(h5, group, "author");
    bead_h5_put_text(h5, author, "name", *named ? named : "unknown");
    hid_t creator = bead_h5_make_group(h5, group, "creator");
    bead_h5_put_text(h5, creator, "name", "beadreel");
    bead_h5_put_text(h5, creator, "version", BEADREEL_VERSION);
    hid_t box = bead_h5_make_group(h5, h5->file, "/particles/chain/box");
    bead_h5_put_ints(h5, box, "dimension", &dimension, 0);
    bead_h5_put_texts(h5, box, "boundary", boundary, 3);
    bead_h5_close(h5, &box);
    bead_h5_close(h5, &creator);
    bead_h5_close(h5, &author);
    bead_h5_close(h5, &group);
}

/* The names of the fields, separated by blanks. */
static void field_names(unsigned fields, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int f = 0; f < BEAD_FIELD_COUNT && used < size; f++)
        if (fields & BEAD_FIELD_BIT(f))
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " " : "", bead_field_info(f)->name);
}

static void write_summary(struct bead_sink *sink)
{
    struct bead_h5 *h5 = &sink->h5;
    const struct bead_scene *scene = sink->context.scene;
    const struct bead_span *span = &sink->output->shown.beads;
    char names[128];
    field_names(sink->fields, names, sizeof names);
    int64_t profile = BEAD_TRAJECTORY_PROFILE, complete = 0, first = (int64_t)span->first;
    int64_t last = span->last == SIZE_MAX ? -1 : (int64_t)span->last;
    hid_t group = bead_h5_make_group(h5, h5->file, BEAD_PROFILE_GROUP);
    bead_h5_put_ints(h5, group, "profile", &profile, 0);
    bead_h5_put_ints(h5, group, "complete", &complete, 0);
    bead_h5_put_text(h5, group, "program", "beadreel " BEADREEL_VERSION);
    bead_h5_put_text(h5, group, "title", scene->title ? scene->title : "");
    bead_h5_put_text(h5, group, "file", scene->file ? scene->file : "");
    bead_h5_put_text(h5, group, "fields", names);
    bead_h5_put_double(h5, group, "start", sink->grid.start);
    bead_h5_put_double(h5, group, "every", sink->grid.every);
    /* If the run ends when the front arrives, the end may be unknown yet. */
    bead_h5_put_double(h5, group, "end", sink->context.end < INFINITY ? sink->context.end : sink->grid.end);
    bead_h5_put_ints(h5, group, "first_bead", &first, 0);
    bead_h5_put_ints(h5, group, "last_bead", &last, 0);
    bead_h5_put_text(h5, group, "method", scene->simulate.method ? scene->simulate.method : "auto");
    bead_h5_put_double(h5, group, "step", scene->simulate.step);
    bead_h5_put_double(h5, group, "accuracy", scene->simulate.accuracy);
    bead_h5_write_text(h5, group, "scene", scene->text);
    bead_h5_close(h5, &group);
}

static void write_materials(struct bead_sink *sink)
{
    static const struct {
        const char *name, *units;
        size_t offset;
    } members[] = {
        {"mass", "kg", offsetof(struct bead_material, mass)},       {"radius", "m", offsetof(struct bead_material, radius)},
        {"modulus", "Pa", offsetof(struct bead_material, modulus)}, {"poisson", "1", offsetof(struct bead_material, poisson)},
        {"red", "1", offsetof(struct bead_material, colour[0])},    {"green", "1", offsetof(struct bead_material, colour[1])},
        {"blue", "1", offsetof(struct bead_material, colour[2])},
    };
    const struct bead_material *first = sink->context.scene->materials;
    const size_t size = sizeof *first, count = sink->context.scene->material_count;
    hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, BEAD_PROFILE_GROUP "/materials");
    bead_h5_write_texts(&sink->h5, group, "name", (const char *const *)&first->name, size, count);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        bead_h5_write_numbers(&sink->h5, group, members[i].name, members[i].units, -1, BEAD_H5_DOUBLE,
                              (const char *)first + members[i].offset, size, count);
    bead_h5_close(&sink->h5, &group);
}

/* Names and radii by species, in order of appearance: VMD wants one row for each species in use. */
static void write_vmd(struct bead_sink *sink)
{
    const struct bead_scene *scene = sink->context.scene;
    struct species {
        int64_t index;
        const char *name;
        double radius;
    } *all = take(sink, scene->material_count, sizeof *all);
    bool *seen = take(sink, scene->material_count, sizeof *seen);
    size_t count = 0;
    for (size_t c = 0; all && seen && c < sink->context.chain_count; c++) {
        const size_t *material = bead_chain_material(sink->context.chains[c]) + sink->rows[c].beads.first;
        for (size_t i = 0; i < sink->rows[c].beads.count; i++) {
            if (!seen[material[i]])
                all[count++] = (struct species){(int64_t)material[i], scene->materials[material[i]].name,
                                                scene->materials[material[i]].radius};
            seen[material[i]] = true;
        }
    }
    if (all && seen) {
        hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, "/parameters/vmd_structure");
        bead_h5_write_numbers(&sink->h5, group, "indexOfSpecies", NULL, -1, BEAD_H5_INT, &all->index, sizeof *all, count);
        bead_h5_write_texts(&sink->h5, group, "name", &all->name, sizeof *all, count);
        bead_h5_write_texts(&sink->h5, group, "type", &all->name, sizeof *all, count);
        bead_h5_write_numbers(&sink->h5, group, "radius", "m", -1, BEAD_H5_DOUBLE, &all->radius, sizeof *all, count);
        bead_h5_close(&sink->h5, &group);
    }
    free(all);
    free(seen);
}

static void write_chains(struct bead_sink *sink)
{
    static const struct {
        const char *name;
        size_t offset;
    } members[] = {
        {"first_row", offsetof(struct bead_chain_rows, beads.row)},
        {"beads", offsetof(struct bead_chain_rows, beads.count)},
        {"first_bead", offsetof(struct bead_chain_rows, beads.first)},
        {"first_contact_row", offsetof(struct bead_chain_rows, contacts.row)},
        {"contacts", offsetof(struct bead_chain_rows, contacts.count)},
    };
    _Static_assert(sizeof(size_t) == sizeof(int64_t), "numbers of rows are written as they are");
    const size_t count = sink->context.chain_count;
    const char **texts = take(sink, 2 * count, sizeof *texts);
    for (size_t c = 0; texts && c < count; c++) {
        texts[2 * c] = bead_chain_name(sink->context.chains[c]);
        texts[2 * c + 1] = bead_chain_spins(sink->context.chains[c]);
    }
    hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, BEAD_PROFILE_GROUP "/chains");
    bead_h5_write_texts(&sink->h5, group, "name", texts, 2 * sizeof *texts, count);
    bead_h5_write_texts(&sink->h5, group, "spins", texts + 1, 2 * sizeof *texts, count);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        bead_h5_write_numbers(&sink->h5, group, members[i].name, NULL, -1, BEAD_H5_INT,
                              (const char *)sink->rows + members[i].offset, sizeof *sink->rows, count);
    bead_h5_close(&sink->h5, &group);
    free(texts);
}

void bead_trajectory_lay_out(struct bead_sink *sink)
{
    write_h5md(sink);
    lay_out_axes(sink);
    const bool beads = bead_chain_spec(sink->context.chains[0])->system->has_contacts;
    if (beads)
        write_labels(sink, "/particles/chain/species", species_of, false);
    write_labels(sink, "/particles/chain/id", identity_of, false);
    write_labels(sink, "/particles/chain/chain", chain_of, false);
    if (beads) {
        write_constant(sink, "/particles/chain/mass", "kg", bead_chain_mass, false);
        write_constant(sink, "/particles/chain/radius", "m", bead_chain_radius, false);
    }
    write_constant(sink, "/particles/chain/rest_position", units_of(sink, "m"), bead_chain_position, false);
    if (sink->contact_scale >= 0) {
        write_labels(sink, "/contacts/chain", chain_of, true);
        write_stiffness(sink);
        write_constant(sink, "/contacts/static_force", "N", bead_chain_static_force, true);
    }
    for (int id = 0; id < BEAD_SERIES_COUNT; id++)
        if (bead_trajectory_wants(sink, id))
            lay_out_series(sink, id);
    write_nexus(sink);
    if (beads)
        write_vmd(sink);
    write_summary(sink);
    if (beads)
        write_materials(sink);
    write_chains(sink);
}

/* The uncertainty of the samples of each field, chain by chain. */
static void write_uncertainty(struct bead_sink *sink)
{
    hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, BEAD_PROFILE_GROUP "/uncertainty");
    for (size_t id = 0; id < BEAD_SERIES_COUNT; id++) {
        const double *values = sink->uncertainty + id * sink->context.chain_count;
        if (sink->series[id].buffer && bead_series[id].stored)
            bead_h5_write_numbers(&sink->h5, group, strrchr(bead_series[id].group, '/') + 1, units_of(sink, bead_series[id].units),
                                  -1, BEAD_H5_DOUBLE, values, sizeof *values, sink->context.chain_count);
    }
    bead_h5_close(&sink->h5, &group);
}

void bead_trajectory_write_outcome(struct bead_sink *sink, const struct bead_outcome *outcomes, bool complete)
{
    struct bead_h5 *h5 = &sink->h5;
    const size_t count = sink->context.chain_count, size = sizeof *outcomes;
    if (outcomes) {
        hid_t group = bead_h5_make_group(h5, h5->file, BEAD_PROFILE_GROUP "/outcome");
        for (size_t i = 0; i < bead_outcome_column_count; i++)
            bead_h5_write_numbers(h5, group, bead_outcome_columns[i].name, units_of(sink, bead_outcome_columns[i].units), -1,
                                  BEAD_H5_DOUBLE, (const char *)outcomes + bead_outcome_columns[i].offset, size, count);
        bead_h5_write_texts(h5, group, "method", &outcomes->method, size, count);
        bead_h5_write_numbers(h5, group, "steps", NULL, -1, BEAD_H5_INT, &outcomes->steps, size, count);
        bead_h5_write_numbers(h5, group, "evaluations", NULL, -1, BEAD_H5_INT, &outcomes->evaluations, size, count);
        bead_h5_close(h5, &group);
    }
    if (sink->uncertainty)
        write_uncertainty(sink);
    hid_t summary = bead_h5_open_group(h5, BEAD_PROFILE_GROUP);
    bead_h5_set_int(h5, summary, "complete", complete);
    bead_h5_close(h5, &summary);
}
