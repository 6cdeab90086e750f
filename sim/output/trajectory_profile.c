/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes everything in a trajectory but its samples, see trajectory_layout.h; trajectory_write.c calls it. */
#include "sim/output/trajectory_sink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"

bool bead_trajectory_wants(const struct bead_sink *sink, enum bead_series_id id)
{
    const struct bead_system *system = sink->context.chains[0]->system;
    if (!(sink->fields & BEAD_FIELD_BIT(bead_series[id].field)))
        return false;
    if (id == BEAD_SERIES_POSITION) /* an unknown that is called displacement need not move anything along the chain */
        return !system || system->beads;
    /* A net force needs both contacts; a trajectory that is drawn again may hold bead forces only. */
    if (id == BEAD_SERIES_NET_FORCE && sink->context.native.every > 0)
        return (sink->fields & BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE)) != 0;
    return true;
}

/* Of series and constants that have a unit where there are beads. */
static const char *units_of(const struct bead_sink *sink, const char *units)
{
    return bead_chain_spec(sink->context.chains[0])->equation.name ? "1" : units;
}

/* Values of all chains' stored beads, or contacts, one after the other; to be freed. */
static double *gather(struct bead_sink *sink, const double *(*values)(const struct bead_chain *), bool of_contacts)
{
    size_t total = of_contacts ? sink->contacts : sink->beads;
    double *all = calloc(total ? total : 1, sizeof *all);
    if (!all) {
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu numbers", sink->part, total);
        return NULL;
    }
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        const struct bead_chain_rows *r = &sink->rows[c];
        const double *from = values(sink->context.chains[c]);
        if (of_contacts && r->contacts)
            memcpy(all + r->first_contact_row, from + r->first_contact, r->contacts * sizeof *all);
        else if (!of_contacts && r->beads)
            memcpy(all + r->first_row, from + r->first_bead, r->beads * sizeof *all);
    }
    return all;
}

static void write_constant(struct bead_sink *sink, const char *name, const char *units,
                           const double *(*values)(const struct bead_chain *), bool of_contacts)
{
    double *all = sink->h5.error ? NULL : gather(sink, values, of_contacts);
    if (all)
        bead_h5_write_doubles(&sink->h5, sink->h5.file, name, units, of_contacts ? sink->contact_scale : sink->bead_scale, all,
                              of_contacts ? sink->contacts : sink->beads);
    free(all);
}

/* The unit of the contacts' coefficients. UDUNITS-2 knows no fractional powers and reads "m-1.5" as 0.5 m-1; it refuses this
 * spelling, as it should where it cannot convert. */
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

/* Integers that tell the rows of an axis apart. */
static int64_t number_of(const struct bead_sink *sink, size_t chain, size_t index, size_t before)
{
    (void)sink, (void)chain, (void)before;
    return (int64_t)index;
}
static int64_t chain_of(const struct bead_sink *sink, size_t chain, size_t index, size_t before)
{
    (void)sink, (void)index, (void)before;
    return (int64_t)chain;
}
static int64_t identity_of(const struct bead_sink *sink, size_t chain, size_t index, size_t before)
{
    (void)sink, (void)chain;
    return (int64_t)(before + index);
}
static int64_t species_of(const struct bead_sink *sink, size_t chain, size_t index, size_t before)
{
    (void)before;
    return (int64_t)bead_chain_material(sink->context.chains[chain])[index];
}

typedef int64_t (*label_function)(const struct bead_sink *, size_t chain, size_t index, size_t before);

static int64_t *labels(struct bead_sink *sink, label_function label, bool of_contacts)
{
    size_t total = of_contacts ? sink->contacts : sink->beads, before = 0;
    int64_t *all = sink->h5.error ? NULL : calloc(total ? total : 1, sizeof *all);
    if (!all && !sink->h5.error)
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu numbers", sink->part, total);
    for (size_t c = 0; all && c < sink->context.chain_count; c++) {
        const struct bead_chain_rows *r = &sink->rows[c];
        size_t count = of_contacts ? r->contacts : r->beads, first = of_contacts ? r->first_contact : r->first_bead;
        int64_t *to = all + (of_contacts ? r->first_contact_row : r->first_row);
        for (size_t i = 0; i < count; i++)
            to[i] = label(sink, c, first + i, before);
        before += bead_chain_beads(sink->context.chains[c]);
    }
    return all;
}

static void write_labels(struct bead_sink *sink, const char *name, label_function label, bool of_contacts)
{
    int64_t *all = labels(sink, label, of_contacts);
    if (all)
        bead_h5_write_ints(&sink->h5, sink->h5.file, name, of_contacts ? sink->contact_scale : sink->bead_scale, all,
                           of_contacts ? sink->contacts : sink->beads);
    free(all);
}

/* The axis of beads, or contacts, with their numbers within their chains. */
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
    bead_h5_write_texts(h5, h5->file, "/particles/chain/spatial", -1, axes, 3);
    sink->spatial_scale = bead_h5_open_scale(h5, h5->file, "/particles/chain/spatial", "spatial");
    if (bead_trajectory_wants(sink, BEAD_SERIES_CONTACT_FORCE))
        sink->contact_scale = make_axis(sink, "/contacts/contact", "contact", true);
}

/* Equations name their own fields. */
static const char *long_name(const struct bead_sink *sink, const struct bead_series_info *info)
{
    const struct bead_chain *chain = sink->context.chains[0];
    return bead_chain_spec(chain)->equation.name && info->stored ? bead_chain_field(chain, info->field)->title : info->title;
}

/* What NeXus calls a plot: H5Web and silx draw the group. Beads of several chains are numbered through, as their own numbers begin
 * again with each chain. */
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

/* NeXus: from the root, each group names the one to follow to the plot that is shown first. The field that tells most comes first.
 */
static void write_nexus(struct bead_sink *sink)
{
    static const enum bead_series_id order[] = {BEAD_SERIES_BEAD_FORCE,   BEAD_SERIES_STRAIN, BEAD_SERIES_VELOCITY,
                                                BEAD_SERIES_DISPLACEMENT, BEAD_SERIES_ENERGY, BEAD_SERIES_CONTACT_FORCE};
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
    hid_t group = bead_h5_make_group(h5, h5->file, "/h5md");
    bead_h5_put_ints(h5, group, "version", version, 2);
    hid_t author = bead_h5_make_group(h5, group, "author");
    bead_h5_put_text(h5, author, "name", "unknown");
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

/* Names of the fields asked for, separated by blanks. */
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
    /* A run that ends when the front arrives may not know its end yet. */
    bead_h5_put_double(h5, group, "end", sink->context.end < INFINITY ? sink->context.end : sink->grid.end);
    bead_h5_put_ints(h5, group, "first_bead", &first, 0);
    bead_h5_put_ints(h5, group, "last_bead", &last, 0);
    bead_h5_put_text(h5, group, "method", scene->simulate.method ? scene->simulate.method : "auto");
    bead_h5_put_double(h5, group, "step", scene->simulate.step);
    bead_h5_put_double(h5, group, "accuracy", scene->simulate.accuracy);
    bead_h5_write_text(h5, group, "scene", scene->text);
    bead_h5_close(h5, &group);
}

/* A member of each of an array of structures, gathered: doubles at `offset` of `size` bytes each. */
static void write_member(struct bead_sink *sink, hid_t group, const char *name, const char *units, const void *array, size_t size,
                         size_t count, size_t offset)
{
    double *values = sink->h5.error ? NULL : calloc(count ? count : 1, sizeof *values);
    if (!values && !sink->h5.error)
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %s", sink->part, name);
    for (size_t i = 0; values && i < count; i++)
        memcpy(&values[i], (const char *)array + i * size + offset, sizeof *values);
    if (values)
        bead_h5_write_doubles(&sink->h5, group, name, units, -1, values, count);
    free(values);
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
    const struct bead_scene *scene = sink->context.scene;
    size_t count = scene->material_count;
    const char **names = calloc(count ? count : 1, sizeof *names);
    if (!names) {
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu names", sink->part, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        names[i] = scene->materials[i].name;
    hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, BEAD_PROFILE_GROUP "/materials");
    bead_h5_write_texts(&sink->h5, group, "name", -1, names, count);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        write_member(sink, group, members[i].name, members[i].units, scene->materials, sizeof *scene->materials, count,
                     members[i].offset);
    bead_h5_close(&sink->h5, &group);
    free(names);
}

/* Names and radii by species, in the order of first appearance: VMD wants one row for each species there is. */
static void write_vmd(struct bead_sink *sink)
{
    const struct bead_scene *scene = sink->context.scene;
    size_t most = scene->material_count ? scene->material_count : 1, count = 0;
    int64_t *species = labels(sink, species_of, false), *index = calloc(most, sizeof *index);
    const char **names = calloc(most, sizeof *names);
    double *radius = calloc(most, sizeof *radius);
    bool *seen = calloc(most, sizeof *seen);
    if (species && index && names && radius && seen) {
        for (size_t i = 0; i < sink->beads; i++) {
            size_t m = (size_t)species[i];
            if (seen[m])
                continue;
            seen[m] = true;
            index[count] = (int64_t)m;
            names[count] = scene->materials[m].name;
            radius[count++] = scene->materials[m].radius;
        }
        hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, "/parameters/vmd_structure");
        bead_h5_write_ints(&sink->h5, group, "indexOfSpecies", -1, index, count);
        bead_h5_write_texts(&sink->h5, group, "name", -1, names, count);
        bead_h5_write_texts(&sink->h5, group, "type", -1, names, count);
        bead_h5_write_doubles(&sink->h5, group, "radius", "m", -1, radius, count);
        bead_h5_close(&sink->h5, &group);
    } else if (!sink->h5.error) {
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for the materials", sink->part);
    }
    free(species);
    free(index);
    free(names);
    free(radius);
    free(seen);
}

static void write_chains(struct bead_sink *sink)
{
    static const struct {
        const char *name;
        size_t offset;
    } members[] = {
        {"first_row", offsetof(struct bead_chain_rows, first_row)},
        {"beads", offsetof(struct bead_chain_rows, beads)},
        {"first_bead", offsetof(struct bead_chain_rows, first_bead)},
        {"first_contact_row", offsetof(struct bead_chain_rows, first_contact_row)},
        {"contacts", offsetof(struct bead_chain_rows, contacts)},
    };
    size_t count = sink->context.chain_count;
    const char **texts = calloc(count, sizeof *texts);
    int64_t *numbers = calloc(count, sizeof *numbers);
    if (texts && numbers) {
        hid_t group = bead_h5_make_group(&sink->h5, sink->h5.file, BEAD_PROFILE_GROUP "/chains");
        for (size_t c = 0; c < count; c++)
            texts[c] = bead_chain_name(sink->context.chains[c]);
        bead_h5_write_texts(&sink->h5, group, "name", -1, texts, count);
        for (size_t c = 0; c < count; c++)
            texts[c] = bead_chain_spins(sink->context.chains[c]);
        bead_h5_write_texts(&sink->h5, group, "spins", -1, texts, count);
        for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
            for (size_t c = 0; c < count; c++)
                numbers[c] = (int64_t) * (const size_t *)((const char *)&sink->rows[c] + members[i].offset);
            bead_h5_write_ints(&sink->h5, group, members[i].name, -1, numbers, count);
        }
        bead_h5_close(&sink->h5, &group);
    } else if (!sink->h5.error) {
        sink->h5.error = bead_fail(sink->h5.msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu chains", sink->part, count);
    }
    free(texts);
    free(numbers);
}

void bead_trajectory_lay_out(struct bead_sink *sink)
{
    write_h5md(sink);
    lay_out_axes(sink);
    const bool beads = !bead_chain_spec(sink->context.chains[0])->equation.name; /* else no materials, radii, forces */
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

void bead_trajectory_write_outcome(struct bead_sink *sink, const struct bead_outcome *outcomes, bool complete)
{
    struct bead_h5 *h5 = &sink->h5;
    size_t count = sink->context.chain_count;
    const char **methods = calloc(count, sizeof *methods);
    int64_t *numbers = calloc(2 * count, sizeof *numbers);
    if (!methods || !numbers)
        h5->error =
            h5->error ? h5->error : bead_fail(h5->msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu chains", sink->part, count);
    if (outcomes && !h5->error) {
        hid_t group = bead_h5_make_group(h5, h5->file, BEAD_PROFILE_GROUP "/outcome");
        for (size_t i = 0; i < bead_outcome_column_count; i++)
            write_member(sink, group, bead_outcome_columns[i].name, units_of(sink, bead_outcome_columns[i].units), outcomes,
                         sizeof *outcomes, count, bead_outcome_columns[i].offset);
        for (size_t c = 0; c < count; c++) {
            methods[c] = outcomes[c].method ? outcomes[c].method : "";
            numbers[c] = (int64_t)outcomes[c].steps;
            numbers[count + c] = (int64_t)outcomes[c].evaluations;
        }
        bead_h5_write_texts(h5, group, "method", -1, methods, count);
        bead_h5_write_ints(h5, group, "steps", -1, numbers, count);
        bead_h5_write_ints(h5, group, "evaluations", -1, numbers + count, count);
        bead_h5_close(h5, &group);
    }
    free(methods);
    free(numbers);
    hid_t summary = bead_h5_open_group(h5, BEAD_PROFILE_GROUP);
    bead_h5_set_int(h5, summary, "complete", complete);
    bead_h5_close(h5, &summary);
}
