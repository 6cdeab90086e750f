/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All that a trajectory contains besides its samples, and all of a sweep's file, read by HDF5 alone: attributes, units, tables of
 * chains, beads, materials and results. */
#include "trajectory_support.h"

#include "sim/sweep/sweep_data.h"
#include "sweeps.h"

enum { MOST = 48 };

static void put_value(FILE *to, hid_t type, const char *bytes, size_t size)
{
    double number;
    char converted[64] = "";
    if (H5Tget_class(type) == H5T_STRING) {
        fprintf(to, " %.*s", (int)size, bytes);
        return;
    }
    memcpy(converted, bytes, size);
    H5Tconvert(type, H5T_NATIVE_DOUBLE, 1, converted, NULL, H5P_DEFAULT);
    memcpy(&number, converted, sizeof number);
    fprintf(to, " %.7g", number);
}

/* "path: value value ..." of an attribute or a data set. */
static void put(FILE *to, const char *path, const char *attribute, hid_t object, bool is_set)
{
    hid_t type = is_set ? H5Dget_type(object) : H5Aget_type(object), space = is_set ? H5Dget_space(object) : H5Aget_space(object);
    const size_t size = H5Tget_size(type), count = (size_t)H5Sget_simple_extent_npoints(space);
    const H5T_class_t class = H5Tget_class(type);
    char bytes[4096];
    fprintf(to, "%s%s%s:", path, *attribute ? "@" : "", attribute);
    if (class != H5T_STRING && class != H5T_INTEGER && class != H5T_FLOAT)
        fprintf(to, " references");
    else if (count > MOST)
        fprintf(to, " %zu values", count);
    else {
        assert_true(size * count <= sizeof bytes && !H5Tis_variable_str(type));
        assert_true((is_set ? H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) : H5Aread(object, type, bytes)) >= 0);
        for (size_t i = 0; i < count; i++)
            put_value(to, type, bytes + i * size, size);
    }
    fputc('\n', to);
    H5Sclose(space);
    H5Tclose(type);
}

static herr_t put_attribute(hid_t object, const char *name, const H5A_info_t *, void *path_and_file)
{
    void **both = path_and_file;
    hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    put(both[1], both[0], name, attribute, false);
    H5Aclose(attribute);
    return 0;
}

static herr_t put_object(hid_t file, const char *name, const H5L_info_t *, void *to)
{
    hid_t object = H5Oopen(file, name, H5P_DEFAULT);
    if (H5Iget_type(object) == H5I_DATASET)
        put(to, name, "", object, true);
    else
        fprintf(to, "%s\n", name);
    H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, NULL, put_attribute, (void *[]){(void *)(uintptr_t)name, to});
    H5Oclose(object);
    return 0;
}

/* Lines of the file, each of which is expected once. */
static char *rest;

static void expect(const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    line[0] = '\n';
    const size_t length = (size_t)vsnprintf(line + 1, sizeof line - 2, format, arguments) + 1;
    va_end(arguments);
    strcpy(line + length, "\n");
    char *found = strstr(rest, line);
    if (!found)
        fail_msg("%s is not in what is left of the file: %s", line, rest);
    memmove(found, found + length, strlen(found + length) + 1);
}

/* A function of an index. */
#define NUMBERS(name, expression)                  \
    static double name(size_t i)                   \
    {                                              \
        return i == SIZE_MAX ? NAN : (expression); \
    }

/* `count` numbers as printf has them, from a function of their index. */
static const char *list(size_t count, double (*number)(size_t))
{
    static char text[1024];
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " %.7g", number(i));
    return text;
}

/* Eleven beads and ten contacts of the first chain, seven of each of the second. */
NUMBERS(chain_of_bead, i >= 11)
NUMBERS(chain_of_contact, i >= 10)
NUMBERS(bead_of, i < 11 ? (double)i : (double)i - 11)
NUMBERS(contact_of, i < 10 ? (double)i : (double)i - 10)
NUMBERS(itself, (double)i)
NUMBERS(time_of, 1e-6 * (double)i)
NUMBERS(species_of, i < 12 ? 0 : 3)
NUMBERS(mass_of, i < 12 ? 3.63e-3 : 1.26e-3)
NUMBERS(radius_of, 4.76e-3)
NUMBERS(place_of, 2 * 4.76e-3 * (bead_of(i) - 1)) /* the first bead at 0, and the striker before it */
NUMBERS(static_force_of, i < 10 ? 0 : 5)
static double stiffness_of(size_t i) /* (4/3) sqrt(R*) E* */
{
    static const double steel = (1 - 0.3 * 0.3) / 193e9, aluminium = (1 - 0.33 * 0.33) / 72.4e9, brass = (1 - 0.34 * 0.34) / 90.2e9;
    const double left = i < 11 ? steel : aluminium, right = i < 10 ? steel : i < 16 ? aluminium : brass;
    return 4. / 3 * sqrt(i < 16 ? 4.76e-3 / 2 : 4.76e-3) / (left + right);
}

static void expect_numbers(const char *path, size_t count, double (*number)(size_t), const char *units)
{
    expect("%s:%s", path, list(count, number));
    expect("%s@DIMENSION_LIST: references", path);
    if (units)
        expect("%s@units: %s", path, units);
}

/* An axis of a series, or of all. */
static void expect_axis(const char *within, const char *name, const char *values)
{
    const char *const slash = *within ? "/" : "";
    expect("%s%s%s:%s", within, slash, name, values);
    expect("%s%s%s@CLASS: DIMENSION_SCALE", within, slash, name);
    expect("%s%s%s@NAME: %s", within, slash, name, name);
    expect("%s%s%s@REFERENCE_LIST: references", within, slash, name);
    if (strcmp(name, "time") == 0)
        expect("%s%s%s@units: s", within, slash, name);
    if (strcmp(name, "time") == 0)
        expect_numbers(*within ? strcat(strcpy((char[64]){""}, within), "/step") : "step", 21, itself, NULL);
}

static void expect_series(const char *group, bool of_contacts, bool spatial, const char *what, const char *units)
{
    expect("%s", group);
    expect("%s@NX_class: NXdata", group);
    expect("%s@axes: time .%s", group, spatial ? " ." : "");
    expect("%s@signal: value", group);
    expect_axis(group, of_contacts ? "contact" : "bead", of_contacts ? list(17, contact_of) : list(18, bead_of));
    expect_axis(group, "time", list(21, time_of));
    if (spatial)
        expect_axis(group, "spatial", " x y z");
    expect("%s/value: %d values", group, 21 * (of_contacts ? 17 : 18) * (spatial ? 3 : 1));
    expect("%s/value@DIMENSION_LIST: references", group);
    expect("%s/value@long_name: %s", group, what);
    expect("%s/value@units: %s", group, units);
}

static void expect_head(void)
{
    static const char *const lines[] = {"/",
                                        "/@NX_class: NXroot",
                                        "/@default: particles",
                                        "particles",
                                        "particles@NX_class: NXentry",
                                        "particles@default: chain",
                                        "particles/chain",
                                        "particles/chain@NX_class: NXcollection",
                                        "particles/chain@default: bead_force",
                                        "particles/chain/box",
                                        "particles/chain/box@boundary: none none none",
                                        "particles/chain/box@dimension: 3",
                                        "contacts",
                                        "h5md",
                                        "h5md@version: 1 1",
                                        "h5md/author",
                                        "h5md/author@name: A. U. Thor",
                                        "h5md/creator",
                                        "h5md/creator@name: beadreel",
                                        ("h5md/creator@version: " BEADREEL_VERSION),
                                        "parameters",
                                        "parameters/vmd_structure",
                                        "parameters/vmd_structure/indexOfSpecies: 0 3",
                                        "parameters/vmd_structure/name: large-steel aluminium",
                                        "parameters/vmd_structure/type: large-steel aluminium",
                                        "parameters/vmd_structure/radius: 0.00476 0.00476",
                                        "parameters/vmd_structure/radius@units: m"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        expect("%s", lines[i]);
}

static void expect_summary(const char *scene)
{
    static const char *const lines[] = {"",
                                        "@accuracy: 1e-06",
                                        "@complete: 1",
                                        "@end: 2e-05",
                                        "@every: 1e-06",
                                        "@fields: force contact-force velocity displacement",
                                        "@file: test.yaml",
                                        "@first_bead: 0",
                                        "@last_bead: -1",
                                        "@method: rk4",
                                        "@profile: 1",
                                        ("@program: beadreel " BEADREEL_VERSION),
                                        "@start: 0",
                                        "@step: 1e-07",
                                        "@title: Two",
                                        "/chains",
                                        "/chains/beads: 11 7",
                                        "/chains/contacts: 10 7",
                                        "/chains/first_bead: 0 0",
                                        "/chains/first_contact_row: 0 10",
                                        "/chains/first_row: 0 11",
                                        "/chains/name: a, b c",
                                        "/chains/spins:  ",
                                        "/materials",
                                        "/outcome",
                                        "/outcome/method: rkn8 rkn8",
                                        "/outcome/steps: 1000 1001",
                                        "/outcome/evaluations: 123456 123457"};
    static const struct {
        const char *name, *values, *units;
    } outcome[] = {{"end", "0.1 0.2", "s"},
                   {"front_arrival", "0.07 0.14", "s"},
                   {"step", "1e-07 2e-07", "s"},
                   {"energy_start", "0.3 0.6", "J"},
                   {"energy_end", "0.29 0.58", "J"},
                   {"momentum_start", "1.3 2.6", "kg m s-1"},
                   {"momentum_end", "1.2 2.4", "kg m s-1"},
                   {"energy_error", "1e-12 2e-12", "1"},
                   {"embedded_error", "0 0", "1"},
                   {"event_error", "0 0", "1"},
                   {"worst_contact", "0 0", "1"},
                   {"worst_bead", "0 0", "1"},
                   {"worst_force", "0 0", "N"},
                   {"worst_uncertainty", "0 0", "N"}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        expect("parameters/beadreel%s", lines[i]);
    for (size_t i = 0; i < sizeof outcome / sizeof *outcome; i++) {
        expect("parameters/beadreel/outcome/%s: %s", outcome[i].name, outcome[i].values);
        expect("parameters/beadreel/outcome/%s@units: %s", outcome[i].name, outcome[i].units);
    }
    expect("parameters/beadreel/scene: %s", scene);
}

static const struct bead_scene *given;
static size_t member; /* offset */

NUMBERS(member_of, *(const double *)((const char *)&given->materials[i] + member))

static void expect_materials(const struct bead_scene *scene)
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
    char names[512] = "";
    given = scene;
    for (size_t i = 0; i < scene->material_count; i++)
        strcat(strcat(names, " "), scene->materials[i].name);
    expect("parameters/beadreel/materials/name:%s", names);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        member = members[i].offset;
        expect("parameters/beadreel/materials/%s:%s", members[i].name, list(scene->material_count, member_of));
        expect("parameters/beadreel/materials/%s@units: %s", members[i].name, members[i].units);
    }
}

static void expect_constants(void)
{
    expect_numbers("contacts/chain", 17, chain_of_contact, NULL);
    expect_numbers("contacts/static_force", 17, static_force_of, "N");
    expect_numbers("contacts/stiffness", 17, stiffness_of, "N m^(-3/2)");
    expect_axis("contacts", "contact", list(17, contact_of));
    expect_axis("particles/chain", "bead", list(18, bead_of));
    expect_axis("particles/chain", "spatial", " x y z");
    expect_axis("", "time", list(21, time_of));
    expect_numbers("particles/chain/chain", 18, chain_of_bead, NULL);
    expect_numbers("particles/chain/id", 18, itself, NULL);
    expect_numbers("particles/chain/species", 18, species_of, NULL);
    expect_numbers("particles/chain/mass", 18, mass_of, "kg");
    expect_numbers("particles/chain/radius", 18, radius_of, "m");
    expect_numbers("particles/chain/rest_position", 18, place_of, "m");
}

static void take_lines(const char *path)
{
    size_t size;
    FILE *to = open_memstream(&rest, &size);
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    fputc('\n', to);
    put_object(file, "/", NULL, to);
    H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, put_object, to);
    H5Fclose(file);
    fclose(to);
}

static void all_of_a_trajectory(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, "title: Two\nauthor: A. U. Thor\nsimulate: {method: rk4, step: 0.1 us}\n" TWO_CHAINS,
           "trajectory: run.h5, every: 1 us, fields: [displacement, velocity, force, contact-force]", 20e-6);
    deliver(&s, 21);
    finish(&s);
    take_lines(s.path);
    expect_head();
    expect_summary(s.scene->text);
    expect_materials(s.scene);
    expect_constants();
    expect_series("particles/chain/displacement", false, false, "displacement from the rest position", "m");
    expect_series("particles/chain/position", false, true, "position of the centre", "m");
    expect_series("particles/chain/velocity", false, true, "velocity", "m s-1");
    expect_series("particles/chain/bead_force", false, false, "mean of the forces in the two contacts of the bead", "N");
    expect_series("particles/chain/force", false, true, "net force: mass times acceleration", "N");
    expect_series("contacts/contact_force", true, false, "force in the contact of a bead with its right neighbour", "N");
    assert_string_equal(rest, "\n");
    free(rest);
    tear_down(&s, 1);
}

/* The check run differs by (1 + c) (1 + f) nm (or m/s, N) in one number of field f of chain c; five times as much is written. */
static void uncertainties_of_fields(void **state)
{
    (void)state;
    static const char *const names[] = {[BEAD_FIELD_DISPLACEMENT] = "displacement",
                                        [BEAD_FIELD_VELOCITY] = "velocity",
                                        [BEAD_FIELD_FORCE] = "bead_force",
                                        [BEAD_FIELD_CONTACT_FORCE] = "contact_force"},
                             *const units[] = {[BEAD_FIELD_DISPLACEMENT] = "m",
                                               [BEAD_FIELD_VELOCITY] = "m s-1",
                                               [BEAD_FIELD_FORCE] = "N",
                                               [BEAD_FIELD_CONTACT_FORCE] = "N"};
    static double check[BEAD_FIELD_COUNT][16];
    struct bead_message msg = {""};
    struct stand s;
    set_up(&s, TWO_CHAINS,
           "trajectory: run.h5, every: 1 us, uncertainty: true, fields: [displacement, velocity, force, contact-force]", 4e-6);
    assert_true(s.needs.checked);
    for (; s.next < 5; s.next++) {
        for (size_t c = 0; c < 2; c++) {
            struct bead_sample other = {.chain = c},
                               sample = {.chain = c, .index = s.next, .time = 1e-6 * (double)s.next, .check = &other};
            sample.active = bead_chain_beads(s.chains[c]);
            for (size_t f = 0; f < sizeof names / sizeof *names; f++) {
                for (size_t j = 0; names[f] && j < sample.active; j++)
                    s.values[c][f][j] = check[f][j] = made_up(c, f, s.next, j);
                sample.field[f] = s.values[c][f];
                other.field[f] = check[f];
                check[f][c + 4] += s.next == 1 + f % 3 ? 1e-9 * (double)((1 + c) * (1 + f)) : 0;
            }
            assert_int_equal(s.type->sample(s.sink, &sample, &msg), BEAD_OK);
        }
    }
    finish(&s);
    take_lines(s.path);
    expect("parameters/beadreel/uncertainty");
    for (size_t f = 0; f < sizeof names / sizeof *names; f++) {
        if (!names[f])
            continue;
        expect("parameters/beadreel/uncertainty/%s: %.7g %.7g", names[f], 5e-9 * (double)(1 + f), 10e-9 * (double)(1 + f));
        expect("parameters/beadreel/uncertainty/%s@units: %s", names[f], units[f]);
    }
    assert_null(strstr(rest, "/uncertainty/"));
    free(rest);
    tear_down(&s, 1);
}

static struct bead_sweep_configuration of[4]; /* those of the sweep; the last: the clean one */

NUMBERS(magnetism_of, of[i].magnetism)
NUMBERS(spin_of, of[i / 3].spins[i % 3] == '1')

/* A result of the configuration i, or of the clean one, as the library has it. */
static double result_of(const struct bead_sweep_peak *peak, size_t what)
{
    return (const double[]){peak->force, peak->time, peak->uncertainty, peak->time_uncertainty, peak->bead, peak->open}[what];
}

static void expect_peaks(const char *prefix, const struct bead_sweep_configuration *configurations, size_t count)
{
    static const struct {
        const char *name, *units;
    } columns[] = {{"peak_force", "N"}, {"peak_time", "s"}, {"peak_uncertainty", "N"}, {"peak_time_uncertainty", "s"},
                   {"peak_bead", NULL}, {"peak_open", NULL}};
    for (size_t what = 0; what < 6; what++) {
        char values[256] = "", *at = values;
        for (size_t i = 0; i < count; i++)
            at += sprintf(at, " %.7g", result_of(configurations[i].peaks, what));
        expect("sweeps/0/%s%s:%s", prefix, columns[what].name, values);
        expect("sweeps/0/%s%s@DIMENSION_LIST: references", prefix, columns[what].name);
        if (columns[what].units)
            expect("sweeps/0/%s%s@units: %s", prefix, columns[what].name, columns[what].units);
    }
}

static const double *profile;
NUMBERS(profile_of, profile[i])

/* Those of several chains are too many to be written out. */
static void expect_profiles(const char *prefix, const struct bead_sweep *sweep, size_t count)
{
    const struct sweep_panel *panel = &sweep->panels[0];
    const size_t beads = panel->shown.beads;
    static const char *const names[] = {"bead_force",       "bead_energy",       "last_force",       "last_energy",
                                        "finer_bead_force", "finer_bead_energy", "finer_last_force", "finer_last_energy"};
    for (size_t i = 0; i < 8; i++) {
        profile = panel->profiles + i * beads;
        if (count > 1)
            expect("sweeps/0/%s%s: %zu values", prefix, names[i], count * beads);
        else
            expect("sweeps/0/%s%s:%s", prefix, names[i], list(beads, profile_of));
        expect("sweeps/0/%s%s@DIMENSION_LIST: references", prefix, names[i]);
        expect("sweeps/0/%s%s@units: %s", prefix, names[i], i % 2 ? "J" : "N");
    }
}

static void all_of_a_sweep(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    char directory[64], path[128],
        text[] = "title: Three\nsweep: {cells: 3, configurations: 2, magnetism: [0.33333333333, 1], seed: 5, "
                 "measure: {decay: true}}\noutputs: [{sweep: s.h5}]\n";
    struct bead_scene *scene = parse(text);
    struct bead_sweep *sweep = compute(scene, NULL);
    make_directory(directory, sizeof directory);
    snprintf(path, sizeof path, "%s/s.h5", directory);
    assert_int_equal(bead_sweep_write(sweep, path, &msg), BEAD_OK);
    const size_t beads = bead_sweep_panel(sweep, 0)->beads;
    for (size_t i = 0; i < 4; i++)
        assert_true(bead_sweep_configuration(sweep, 0, i < 3 ? i : BEAD_SWEEP_CLEAN, &of[i]));
    assert_int_equal(bead_sweep_panel(sweep, 0)->configurations, 3);
    take_lines(path);
    static const char *const lines[] = {"/",
                                        "/@format: beadreel-sweep",
                                        "/@format_version: 2",
                                        "/@creator: beadreel",
                                        "/@part: 1",
                                        ("/@version: " BEADREEL_VERSION),
                                        "/@parts: 1",
                                        "/@title: Three",
                                        "sweeps",
                                        "sweeps/0",
                                        "sweeps/0@name: ",
                                        "sweeps/0@seed: 5"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        expect("%s", lines[i]);
    expect("/@fingerprint: %.7g", (double)(int64_t)scene->fingerprint);
    expect("scene: %s", text);
    expect_axis("sweeps/0", "bead", list(beads, itself));
    expect_axis("sweeps/0", "configuration", list(3, itself));
    expect_axis("sweeps/0", "place", " peak");
    expect_numbers("sweeps/0/spins", 9, spin_of, NULL);
    expect_numbers("sweeps/0/magnetism", 3, magnetism_of, "1");
    expect_peaks("", of, 3);
    expect_peaks("reference_", of + 3, 1);
    expect_profiles("", sweep, 3);
    expect_profiles("reference_", sweep, 1);
    assert_string_equal(rest, "\n");
    free(rest);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
    assert_int_equal(count_files(directory, true), 1);
    rmdir(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_of_a_trajectory), cmocka_unit_test(uncertainties_of_fields),
                                       cmocka_unit_test(all_of_a_sweep)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
