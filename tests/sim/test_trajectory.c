/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trajectories: written data are read again, whatever ended the run. */
#include "trajectory_support.h"

#include <hdf5_hl.h>

#include "sim/base/file.h"
#include "sim/measure/sink_grid.h"
#include "sim/trajectory/trajectory_data.h"
#include "sim/trajectory/trajectory_sink.h"

#define ALL_FIELDS "fields: [displacement, velocity, force, contact-force, compression, energy]"

/* Every stored value of every sample, bit by bit. */
static void check_samples(const char *path, size_t chains, size_t samples, struct bead_span span, unsigned fields)
{
    struct bead_trajectory *t = open_file(path);
    struct bead_message msg = {""};
    size_t count;
    const struct bead_chain *const *chain = bead_trajectory_chains(t, &count);
    assert_int_equal(count, chains);
    assert_int_equal(bead_grid_count(bead_trajectory_grid(t)), samples);
    assert_int_equal(bead_trajectory_fields(t) & fields, fields); /* and what follows from them */
    for (size_t i = 0; i < samples; i++)
        for (size_t c = 0; c < chains; c++) {
            struct bead_sample sample;
            if (bead_trajectory_read(t, i, c, fields, &sample, &msg))
                fail_msg("%s", msg.text);
            assert_true(sample.time == bead_grid_time(bead_trajectory_grid(t), i) && sample.chain == c && sample.index == i);
            assert_int_equal(sample.active, bead_chain_beads(chain[c]));
            for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
                size_t length = bead_field_info(f)->of_contacts ? bead_chain_contacts(chain[c]) : bead_chain_beads(chain[c]);
                assert_true((sample.field[f] != NULL) == ((fields & BEAD_FIELD_BIT(f)) != 0));
                for (size_t j = 0; sample.field[f] && j < length; j++) {
                    double wanted = j < span.first || j > span.last ? 0 : made_up(c, f, i, j);
                    if (sample.field[f][j] != wanted)
                        fail_msg("sample %zu, chain %zu, %s %zu: %.17g, not %.17g", i, c, bead_field_info(f)->name, j,
                                 sample.field[f][j], wanted);
                }
            }
        }
    struct bead_sample sample;
    assert_int_equal(bead_trajectory_read(t, samples, 0, fields, &sample, &msg), BEAD_ERROR_USAGE);
    bead_trajectory_close(t);
}

static const unsigned all_fields = (1u << BEAD_FIELD_STRAIN) - 1; /* of beads */
static const unsigned usual_fields =
    BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT);

static void what_is_written_is_read(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, ONE_CHAIN, "trajectory: run.h5, every: 1 us, " ALL_FIELDS, 0.6e-3);
    assert_int_equal(bead_grid_count(&s.needs.grid), 601);
    deliver(&s, 601);
    assert_int_equal(access(s.path, F_OK), -1);
    finish(&s);
    check_samples(s.path, 1, 601, (struct bead_span){0, SIZE_MAX}, all_fields);
    struct bead_trajectory *t = open_file(s.path);
    struct bead_message msg = {""};
    struct bead_outcome found, wanted = made_outcome(0);
    assert_true(bead_trajectory_is(s.path) && bead_trajectory_complete(t) && t->end == 0.6e-3);
    assert_int_equal(bead_trajectory_outcome(t, 0, &found, &msg), BEAD_OK);
    assert_string_equal(found.method, wanted.method);
    found.method = wanted.method;
    wanted.absorbed = NAN; /* not in the file */
    assert_memory_equal(&found, &wanted, sizeof found);
    assert_int_equal(bead_trajectory_outcome(t, 1, &found, &msg), BEAD_ERROR_USAGE);
    assert_string_equal(bead_trajectory_scene(t)->text, s.scene->text);
    bead_trajectory_close(t);
    uint64_t bytes, items;
    s.type->result(s.sink, &bytes, &items);
    assert_int_equal(items, 601);
    assert_int_equal(bytes, bead_file_bytes(s.path));
    tear_down(&s, 1);
}

/* In other chunks, or in none: the same numbers. Packed: refused, as a few bytes could unpack to any size. */
static void storage(void **state)
{
    (void)state;
    static const struct {
        const char *way, *refused;
    } ways[] = {{"-l /particles/chain/bead_force/value:CHUNK=7x5", NULL},
                {"-l /particles/chain/bead_force/value:CONTI", NULL},
                {"-f GZIP=1", "/particles/chain/mass is compressed, filtered"},
                {"-f /particles/chain/energy/value:SHUF", "/particles/chain/energy/value is compressed, filtered"}};
    struct stand s;
    struct bead_message msg;
    set_up(&s, ONE_CHAIN, "trajectory: run.h5, every: 1 us, " ALL_FIELDS, 0.6e-3);
    deliver(&s, 601);
    finish(&s);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        char command[3000], copy[1024];
        struct bead_trajectory *t = NULL;
        snprintf(copy, sizeof copy, "%s.copy", s.path);
        snprintf(command, sizeof command, "h5repack %s '%s' '%s'", ways[i].way, s.path, copy);
        assert_int_equal(system(command), 0);
        if (ways[i].refused) {
            assert_int_equal(bead_trajectory_open(copy, NULL, &t, &msg), BEAD_ERROR_FORMAT);
            assert_non_null(strstr(msg.text, ways[i].refused));
        } else {
            check_samples(copy, 1, 601, (struct bead_span){0, SIZE_MAX}, all_fields);
        }
        unlink(copy);
    }
    tear_down(&s, 1);
}

static void put_byte(FILE *file, size_t at, int byte)
{
    assert_int_equal(fseek(file, (long)at, SEEK_SET), 0);
    fputc(byte, file);
    assert_int_equal(fflush(file), 0);
}

/* Every bit of a finished file counts, also those of places that HDF5 does not look at, and of the digests themselves. */
static void a_flipped_bit_is_told(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg;
    set_up(&s, ONE_CHAIN, "trajectory: run.h5, every: 1 us", 0.6e-3);
    deliver(&s, 601);
    finish(&s);
    const size_t size = bead_file_bytes(s.path);
    uint64_t draw = 1;
    struct bead_trajectory *t = NULL;
    FILE *file = fopen(s.path, "r+b");
    assert_non_null(file);
    for (size_t i = 0; i < 300; i++) {
        draw = draw * 6364136223846793005u + 1442695040888963407u;
        const size_t last = size - 1 - i; /* the seal is the last 200 bytes or so */
        const size_t at = i < 200 ? last : (size_t)((draw >> 16) % size), bit = draw >> 61;
        assert_int_equal(fseek(file, (long)at, SEEK_SET), 0);
        const int byte = fgetc(file);
        put_byte(file, at, byte ^ 1 << bit);
        if (bead_trajectory_open(s.path, NULL, &t, &msg) == BEAD_OK)
            fail_msg("bit %zu of byte %zu of %zu: not noticed", bit, at, size);
        put_byte(file, at, byte);
    }
    fclose(file);
    /* All are back. */
    assert_int_equal(bead_trajectory_open(s.path, NULL, &t, &msg), BEAD_OK);
    bead_trajectory_close(t);
    tear_down(&s, 1);
}

static void chains_and_spans(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 2 us, time: [0.1 ms, 0.3 ms], beads: [4, 8], " ALL_FIELDS, 0.6e-3);
    deliver(&s, 101);
    finish(&s);
    check_samples(s.path, 2, 101, (struct bead_span){4, 8}, all_fields);
    struct bead_trajectory *t = open_file(s.path);
    assert_int_equal(bead_trajectory_beads(t).first, 4);
    assert_int_equal(bead_trajectory_beads(t).last, 8);
    assert_near(bead_trajectory_grid(t)->start, 0.1e-3, 1e-18);
    assert_near(bead_trajectory_grid(t)->end, 0.3e-3, 1e-15);
    bead_trajectory_close(t);
    tear_down(&s, 1);
}

/* From group to group, the default plot of a file leads to a field that is stored, whichever it is. */
static void default_plots_are_stored(void **state)
{
    (void)state;
    static const char *const fields[] = {"force", "velocity", "displacement", "energy", "contact-force", "compression"};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        struct stand s;
        char text[100], path[200] = "/", child[64];
        snprintf(text, sizeof text, "trajectory: run.h5, every: 10 us, fields: [%s]", fields[f]);
        set_up(&s, ONE_CHAIN, text, 0.1e-3);
        deliver(&s, 11);
        finish(&s);
        hid_t file = H5Fopen(s.path, H5F_ACC_RDONLY, H5P_DEFAULT);
        while (H5Aexists_by_name(file, path, "default", H5P_DEFAULT) > 0) {
            assert_true(H5LTget_attribute_string(file, path, "default", child) >= 0);
            snprintf(path + strlen(path), sizeof path - strlen(path), "%s%s", path[1] ? "/" : "", child);
            if (H5Lexists(file, path, H5P_DEFAULT) <= 0)
                fail_msg("%s: its default plot is %s, which is not there", fields[f], path);
        }
        assert_non_null(strrchr(path + 1, '/'));
        strcat(path, "/value");
        assert_true(H5Lexists(file, path, H5P_DEFAULT) > 0);
        H5Fclose(file);
        tear_down(&s, 1);
    }
}

/* Only requested fields are computed and stored. */
static void nothing_more_than_asked(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, ONE_CHAIN, "trajectory: run.h5, every: 10 us, fields: [velocity]", 0.6e-3);
    assert_int_equal(s.needs.fields, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY));
    assert_false(s.needs.contact_peaks || s.needs.bead_peaks || s.needs.range);
    assert_true(s.needs.until == 0.6e-3);
    assert_string_equal(s.needs.why, "61 samples of 1 field, 13 beads, every 10 us");
    deliver(&s, 61);
    finish(&s);
    hid_t file = H5Fopen(s.path, H5F_ACC_RDONLY, H5P_DEFAULT);
    static const char *const absent[] = {"displacement", "position", "force", "bead_force", "energy"};
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++) {
        char name[64];
        snprintf(name, sizeof name, "/particles/chain/%s", absent[i]);
        assert_int_equal(H5Lexists(file, name, H5P_DEFAULT), 0);
    }
    assert_int_equal(H5Lexists(file, "/contacts", H5P_DEFAULT), 0);
    /* y and z are there for readers, one chunk of each: not all of them know that missing chunks are 0. */
    hid_t velocity = H5Dopen2(file, "/particles/chain/velocity/value", H5P_DEFAULT);
    assert_int_equal(H5Dget_storage_size(velocity), 3 * 256 * 13 * sizeof(double));
    H5Dclose(velocity);
    H5Fclose(file);
    tear_down(&s, 1);
}

static void killed_runs_open_at_the_last_flush(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us", 0.6e-3);
    char copy[160];
    snprintf(copy, sizeof copy, "%s/copy.h5", s.directory);
    copy_file(s.part, copy, -1);
    check_samples(copy, 2, 0, (struct bead_span){0, SIZE_MAX}, usual_fields);
    s.sink->flushed -= 10; /* the second is over */
    deliver(&s, 300);
    copy_file(s.part, copy, -1);
    check_samples(copy, 2, 1, (struct bead_span){0, SIZE_MAX}, usual_fields);
    s.sink->flushed -= 10; /* the second is over */
    deliver(&s, 1);
    copy_file(s.part, copy, -1);
    check_samples(copy, 2, 301, (struct bead_span){0, SIZE_MAX}, usual_fields);
    struct bead_trajectory *t = open_file(copy);
    struct bead_message msg = {""};
    struct bead_outcome outcome;
    assert_false(bead_trajectory_complete(t));
    assert_true(t->end == 0.6e-3);
    assert_int_equal(bead_trajectory_outcome(t, 1, &outcome, &msg), BEAD_OK);
    assert_true(isnan(outcome.end) && outcome.method && outcome.steps == 0);
    bead_trajectory_close(t);
    unlink(copy);
    tear_down(&s, 0); /* not ended: the unfinished file goes */
}

static void stopped_runs_keep_whole_samples(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg = {""};
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us", 0.6e-3);
    deliver(&s, 257);
    assert_int_equal(deliver_one(&s, 0, &msg), BEAD_OK); /* chain 1 never comes */
    finish(&s);
    check_samples(s.path, 2, 257, (struct bead_span){0, SIZE_MAX}, usual_fields);
    struct bead_trajectory *t = open_file(s.path);
    assert_false(bead_trajectory_complete(t));
    bead_trajectory_close(t);
    tear_down(&s, 1);
}

/* The times of flushes must not show in the stored data. */
static void contents_do_not_depend_on_flushes(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us, " ALL_FIELDS, 0.6e-3);
    for (size_t i = 0; i < 601; i++) {
        if (i % 7 == 3 || i % 100 < 4)
            s.sink->flushed -= 10;
        deliver(&s, 1);
    }
    finish(&s);
    check_samples(s.path, 2, 601, (struct bead_span){0, SIZE_MAX}, all_fields);
    tear_down(&s, 1);
}

static void read_x(hid_t file, const char *name, size_t component, size_t row, size_t beads, double *values)
{
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    hsize_t start[3] = {row, 0, component}, count[3] = {1, beads, 1}, size[3];
    assert_int_equal(H5Sget_simple_extent_dims(space, size, NULL), 3);
    assert_int_equal(size[1], beads);
    assert_int_equal(size[2], 3);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL);
    hid_t memory = H5Screate_simple(1, count + 1, NULL);
    assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values) >= 0);
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(dataset);
}

static void check_axis(hid_t file, const char *value, unsigned axis, const char *scale)
{
    hid_t dataset = H5Dopen2(file, value, H5P_DEFAULT), dimension = H5Dopen2(file, scale, H5P_DEFAULT);
    assert_true(dataset >= 0 && dimension >= 0);
    assert_int_equal(H5DSis_attached(dataset, dimension, axis), 1);
    H5Dclose(dimension);
    H5Dclose(dataset);
}

static void the_layout_is_h5md(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us, " ALL_FIELDS, 0.02e-3);
    deliver(&s, 21);
    finish(&s);
    hid_t file = H5Fopen(s.path, H5F_ACC_RDONLY, H5P_DEFAULT);
    int version[2] = {0, 0}, dimension = 0;
    hid_t attribute = H5Aopen_by_name(file, "/h5md", "version", H5P_DEFAULT, H5P_DEFAULT);
    H5Aread(attribute, H5T_NATIVE_INT, version);
    H5Aclose(attribute);
    attribute = H5Aopen_by_name(file, "/particles/chain/box", "dimension", H5P_DEFAULT, H5P_DEFAULT);
    H5Aread(attribute, H5T_NATIVE_INT, &dimension);
    H5Aclose(attribute);
    assert_true(version[0] == 1 && version[1] == 1 && dimension == 3);
    check_axis(file, "/particles/chain/position/value", 0, "/particles/chain/position/time");
    check_axis(file, "/particles/chain/force/value", 1, "/particles/chain/bead");
    check_axis(file, "/particles/chain/velocity/value", 2, "/particles/chain/velocity/spatial");
    check_axis(file, "/contacts/contact_force/value", 1, "/contacts/contact_force/contact");
    double x[18], y[18], z[18];
    read_x(file, "/particles/chain/position/value", 0, 17, 18, x);
    read_x(file, "/particles/chain/position/value", 1, 17, 18, y);
    read_x(file, "/particles/chain/position/value", 2, 17, 18, z);
    for (size_t i = 0; i < 18; i++) {
        size_t c = i < 11 ? 0 : 1, j = c ? i - 11 : i;
        assert_true(x[i] == bead_chain_position(s.chains[c])[j] + made_up(c, BEAD_FIELD_DISPLACEMENT, 17, j) && z[i] == 0);
        assert_true(c ? y[i] < -2 * bead_chain_radius(s.chains[0])[0] : y[i] == 0);
    }
    H5Fclose(file);
    tear_down(&s, 1);
}

/* Of a trajectory of these chains. */
static void check_stiffness_unit(const char *chains, const char *wanted)
{
    struct stand s;
    char unit[64] = "";
    set_up(&s, chains, "trajectory: run.h5, every: 1 us, fields: [contact-force]", 2e-6);
    deliver(&s, 3);
    finish(&s);
    hid_t file = H5Fopen(s.path, H5F_ACC_RDONLY, H5P_DEFAULT);
    hid_t attribute = H5Aopen_by_name(file, "/contacts/stiffness", "units", H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0);
    hid_t type = H5Aget_type(attribute);
    assert_true(H5Tget_size(type) < sizeof unit && H5Aread(attribute, type, unit) >= 0);
    H5Tclose(type);
    H5Aclose(attribute);
    H5Fclose(file);
    assert_string_equal(unit, wanted);
    tear_down(&s, 1);
}

static void stiffness_has_the_unit_of_its_law(void **state)
{
    (void)state;
    static const char half[] = "{name: a, beads: [{bead: large-steel, count: 3}]}", chains[] = "chains: [%s%s%s]\n";
    char text[512];
    snprintf(text, sizeof text, chains, half, "", "");
    check_stiffness_unit(text, "N m^(-3/2)");
    snprintf(text, sizeof text, chains, half, ", ",
             "{name: b, law: {fpu-alpha: 1e3, stiffness: 1e6}, beads: [{bead: large-steel}]}");
    check_stiffness_unit(text, "N/m^p, with the power p of each chain");
    check_stiffness_unit("chain: {law: {power: 3, coefficient: 1e9}, beads: [{bead: large-steel, count: 3}]}\n", "N m-3");
    check_stiffness_unit("chain: {law: {power: 1.7, coefficient: 1e9}, beads: [{bead: large-steel, count: 3}]}\n", "N m^(-1.7)");
    check_stiffness_unit("chain: {law: {fpu-alpha: 1e3, stiffness: 1e6}, beads: [{bead: large-steel, count: 3}]}\n", "N m-1");
}

/* H5MD's force is the bead's mass times its acceleration, with precompression, tilt and wall. */
static void net_force_accelerates(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "chain: {beads: [{cell: [large-steel, aluminium], count: 6}], wall: brass}\n",
        "chain: {beads: [{cell: [large-steel, aluminium], count: 6}], wall: brass, precompression: 3 N}\n",
        "chain: {beads: [{cell: [large-steel, aluminium], count: 6}], wall: rigid, tilt: 20 deg}\n",
    };
    for (size_t k = 0; k < sizeof chains / sizeof *chains; k++) {
        struct stand s;
        char text[512];
        snprintf(text, sizeof text, "%ssimulate: {method: rkn8, step: 0.1 us, until: 0.2 ms}\n", chains[k]);
        set_up(&s, text, "trajectory: run.h5, every: 1 us, fields: [force, velocity], beads: all", 0.2e-3);
        struct built built = {s.scene, s.chains[0]};
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.2e-3});
        struct bead_message msg = {""};
        for (; s.next <= 200; s.next++) {
            double time = bead_grid_time(&s.needs.grid, s.next);
            run_until(run, fmin(time, 0.2e-3));
            struct bead_sample sample = sample_at(run, fmin(time, bead_run_time(run)));
            sample.chain = 0;
            sample.index = s.next;
            sample.time = time;
            assert_int_equal(s.type->sample(s.sink, &sample, &msg), BEAD_OK);
        }
        finish(&s);
        hid_t file = H5Fopen(s.path, H5F_ACC_RDONLY, H5P_DEFAULT);
        double before[13], after[13], force[3][13], worst = 0, largest = 0;
        for (size_t i = 20; i + 1 < 200; i += 7) {
            read_x(file, "/particles/chain/velocity/value", 0, i - 1, 13, before);
            read_x(file, "/particles/chain/velocity/value", 0, i + 1, 13, after);
            for (size_t r = 0; r < 3; r++)
                read_x(file, "/particles/chain/force/value", 0, i - 1 + r, 13, force[r]);
            for (size_t j = 0; j < 13; j++) {
                /* Simpson's rule for the impulse */
                double impulse = (force[0][j] + 4 * force[1][j] + force[2][j]) / 6 * 2e-6;
                worst = fmax(worst, fabs(impulse - bead_chain_mass(s.chains[0])[j] * (after[j] - before[j])));
                largest = fmax(largest, fabs(impulse));
            }
        }
        assert_true(largest > 1e-6);
        assert_below(worst / largest, 1e-3);
        H5Fclose(file);
        bead_run_destroy(run);
        tear_down(&s, 1);
    }
}

static void grids(void **state)
{
    (void)state;
    assert_true(bead_round_down(2.7e-6) == 2e-6 && bead_round_down(1e-6) == 1e-6 && bead_round_down(9.99e-7) == 5e-7);
    assert_true(bead_round_down(7) == 5 && bead_round_down(20) == 20 && bead_round_down(0.1) == 0.1);
    struct stand s;
    struct bead_message msg = {""};
    assert_int_equal(try_set_up(&s, ONE_CHAIN, "trajectory: run.h5, time: [0, 1 s]", 0.6e-3, &msg), BEAD_OK);
    assert_true(s.needs.grid.every == 2e-6 && s.needs.grid.end == 0.6e-3 && s.needs.grid.start == 0);
    tear_down(&s, 0);
    assert_int_equal(try_set_up(&s, ONE_CHAIN, "trajectory: run.h5, time: [1 ms, 2 ms]", 0.6e-3, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "test.yaml:"));
    tear_down(&s, 0);
    /* Only samples at given times: the nearest multiple of their spacing. */
    struct bead_run_context context = {
        .scene = NULL, .end = 1e-3, .resolution = 1e-6, .native = {.start = 0.1e-3, .every = 4e-6, .end = 0.5e-3, .widens = 0}};
    struct bead_scene scene = {.file = NULL};
    context.scene = &scene;
    struct bead_output output = {.shown = {.time = {NAN, NAN}, .every = 9e-6}};
    struct bead_grid grid;
    assert_int_equal(bead_sink_grid(&output, &context, &grid, &msg), BEAD_OK);
    assert_near(grid.every, 8e-6, 1e-18);
    assert_true(grid.start == 0.1e-3 && grid.end == 0.5e-3);
}

static void wrong_numbers_and_order_stop_it(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg = {""};
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us, fields: [velocity]", 0.6e-3);
    deliver(&s, 255);
    assert_int_equal(deliver_one(&s, 1, &msg), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "out of order"));
    assert_int_equal(deliver_one(&s, 0, &msg), BEAD_OK);
    struct bead_sample sample = {.chain = 1, .index = 255, .time = 255e-6};
    double nothing[16] = {0, NAN};
    sample.field[BEAD_FIELD_VELOCITY] = nothing;
    assert_int_equal(s.type->sample(s.sink, &sample, &msg), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "finite"));
    tear_down(&s, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(storage),
        cmocka_unit_test(a_flipped_bit_is_told),
        cmocka_unit_test(chains_and_spans),
        cmocka_unit_test(nothing_more_than_asked),
        cmocka_unit_test(killed_runs_open_at_the_last_flush),
        cmocka_unit_test(stopped_runs_keep_whole_samples),
        cmocka_unit_test(contents_do_not_depend_on_flushes),
        cmocka_unit_test(default_plots_are_stored),
        cmocka_unit_test(the_layout_is_h5md),
        cmocka_unit_test(stiffness_has_the_unit_of_its_law),
        cmocka_unit_test(net_force_accelerates),
        cmocka_unit_test(grids),
        cmocka_unit_test(wrong_numbers_and_order_stop_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
