/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that are not, or no longer, trajectories: one clear line, no crash, nothing trusted. */
#include "trajectory_support.h"

#include <sys/stat.h>

#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <sys/resource.h>

#include "sim/base/file.h"
#include "sim/trajectory/trajectory_data.h"

/* A good file of two chains and 300 samples, and one of its name to spoil. */
struct bad {
    struct stand s;
    char copy[160];
};

static int set_up_bad(void **state)
{
    struct bad *b = calloc(1, sizeof *b);
    assert_non_null(b);
    set_up(&b->s, TWO_CHAINS, "trajectory: run.h5, every: 1 us", 0.299e-3);
    deliver(&b->s, 300);
    finish(&b->s);
    snprintf(b->copy, sizeof b->copy, "%s/copy.h5", b->s.directory);
    copy_file(b->s.path, b->copy, -1);
    *state = b;
    return 0;
}

static int tear_down_bad(void **state)
{
    struct bad *b = *state;
    unlink(b->copy);
    tear_down(&b->s, 1);
    free(b);
    return 0;
}

/* Opening fails, in one line that begins with the path; returns the code. */
static enum bead_error refused(const char *path, const char *words)
{
    struct bead_message msg = {""};
    struct bead_trajectory *t = NULL;
    enum bead_error error = bead_trajectory_open(path, NULL, &t, &msg);
    if (!error)
        fail_msg("%s was opened, not refused with '%s'", path, words);
    assert_null(t);
    if (strncmp(msg.text, path, strlen(path)) != 0 || strchr(msg.text, '\n') || !strstr(msg.text, words))
        fail_msg("%s", msg.text);
    return error;
}

static void cut_off_anywhere(void **state)
{
    struct bad *b = *state;
    long size = (long)bead_file_bytes(b->s.path);
    struct bead_message msg = {""};
    for (long i = 0; i < 120; i++) {
        long length = i < 40 ? i * 13 : i < 80 ? size * (i - 40) / 40 : size - 1 - (i - 80) * (i - 80) * 3;
        copy_file(b->s.path, b->copy, length);
        struct bead_trajectory *t = NULL; /* (no length of these is that without the seal, which could be read) */
        enum bead_error error = bead_trajectory_open(b->copy, NULL, &t, &msg);
        if (error != BEAD_ERROR_FORMAT || t)
            fail_msg("%ld bytes of %ld: error %d", length, size, (int)error);
        assert_true(strncmp(msg.text, b->copy, strlen(b->copy)) == 0 && !strchr(msg.text, '\n'));
    }
}

/* Bytes changed here and there: whatever is opened can be read or refused, without a crash. */
static void bytes_changed(void **state)
{
    struct bad *b = *state;
    struct bead_message msg = {""};
    uint64_t size = bead_file_bytes(b->s.path), x = 1;
    for (int round = 0; round < 60; round++) {
        copy_file(b->s.path, b->copy, -1);
        FILE *file = fopen(b->copy, "r+b");
        assert_non_null(file);
        for (int k = 0; k < 4; k++) {
            x = x * 6364136223846793005u + 1442695040888963407u;
            fseek(file, (long)((x >> 20) % (size / (round % 3 ? 1 : 8))), SEEK_SET);
            putc((int)(x >> 56), file);
        }
        fclose(file);
        struct bead_trajectory *t = NULL;
        if (bead_trajectory_open(b->copy, NULL, &t, &msg))
            continue;
        size_t samples = bead_grid_count(bead_trajectory_grid(t));
        struct bead_sample sample;
        for (size_t i = 0; i < samples; i++)
            if (bead_trajectory_read(t, i, i % 2, bead_trajectory_fields(t), &sample, &msg))
                break;
        bead_trajectory_close(t);
    }
}

static void foreign_files(void **state)
{
    struct bad *b = *state;
    assert_false(bead_trajectory_is("/nonexistent/file.h5"));
    assert_int_equal(refused("/nonexistent/file.h5", "No such file"), BEAD_ERROR_IO);
    assert_int_equal(refused(b->s.directory, ""), BEAD_ERROR_FORMAT);
    FILE *file = fopen(b->copy, "wb");
    assert_non_null(file);
    fputs("chain: {beads: [{bead: steel}]}\n", file);
    fclose(file);
    assert_false(bead_trajectory_is(b->copy));
    assert_int_equal(refused(b->copy, "not an HDF5 file"), BEAD_ERROR_FORMAT);
    hid_t empty = H5Fcreate(b->copy, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(empty);
    assert_true(bead_trajectory_is(b->copy));
    assert_int_equal(refused(b->copy, "not a trajectory of this program"), BEAD_ERROR_FORMAT);
}

/* HDF5 files may begin with a block of somebody else's; what is no file at all is not waited for. */
static void signatures(void **state)
{
    struct bad *b = *state;
    for (hsize_t block = 512; block <= 1 << 14; block *= 2) {
        hid_t creation = H5Pcreate(H5P_FILE_CREATE);
        assert_true(H5Pset_userblock(creation, block) >= 0);
        assert_true(H5Fclose(H5Fcreate(b->copy, H5F_ACC_TRUNC, creation, H5P_DEFAULT)) >= 0);
        H5Pclose(creation);
        assert_true(bead_trajectory_is(b->copy));
        assert_int_equal(refused(b->copy, "not a trajectory of this program"), BEAD_ERROR_FORMAT);
    }
    static const char cut[] = "\211HDF\r\n\032";
    FILE *file = fopen(b->copy, "wb");
    assert_non_null(file);
    fputs(cut, file);
    fclose(file);
    assert_false(bead_trajectory_is(b->copy));
    assert_false(bead_trajectory_is(b->s.directory));
    unlink(b->copy);
    assert_int_equal(mkfifo(b->copy, 0600), 0);
    assert_false(bead_trajectory_is(b->copy));
}

/* ---- one thing changed in a good file ---- */

static void drop(hid_t file, const char *name)
{
    assert_true(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
}

static void put_dataset(hid_t file, const char *name, hid_t type, int rank, const hsize_t *size, const void *values)
{
    hid_t space = H5Screate_simple(rank, size, NULL),
          dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(dataset >= 0);
    if (values)
        assert_true(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Dclose(dataset);
    H5Sclose(space);
}

static void put_attribute(hid_t file, const char *name, hid_t type, const void *value)
{
    hid_t group = H5Gopen2(file, "/parameters/beadreel", H5P_DEFAULT), space = H5Screate(H5S_SCALAR);
    if (H5Aexists(group, name) > 0)
        H5Adelete(group, name);
    hid_t attribute = H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, type, value) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Gclose(group);
}

static void poke(hid_t file, const char *name, hsize_t row, hsize_t column, int rank, double value)
{
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    hsize_t at[3] = {row, column, 0}, one[3] = {1, 1, 1};
    hid_t memory = H5Screate_simple(rank, one, NULL);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, at, NULL, one, NULL);
    assert_true(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, &value) >= 0);
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(dataset);
}

static void no_profile(hid_t file)
{
    drop(file, "/parameters/beadreel");
}
static void group_for_dataset(hid_t file)
{
    drop(file, "/time");
    H5Gclose(H5Gcreate2(file, "/time", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}
static void rank_two_velocity(hid_t file)
{
    drop(file, "/particles/chain/velocity/value");
    put_dataset(file, "/particles/chain/velocity/value", H5T_NATIVE_DOUBLE, 2, (hsize_t[]){300, 18}, NULL);
}
static void too_few_beads(hid_t file)
{
    drop(file, "/particles/chain/bead_force/value");
    put_dataset(file, "/particles/chain/bead_force/value", H5T_NATIVE_DOUBLE, 2, (hsize_t[]){300, 17}, NULL);
}
static void integer_times(hid_t file)
{
    drop(file, "/time");
    put_dataset(file, "/time", H5T_NATIVE_INT, 1, (hsize_t[]){300}, NULL);
}
static void times_go_back(hid_t file)
{
    poke(file, "/time", 200, 0, 1, 1e-6);
}
static void time_is_nan(hid_t file)
{
    poke(file, "/time", 299, 0, 1, NAN);
}
/* Chunks never written cost nothing: a small file may claim anything. Those of vectors are allocated early; one that does not is
 * put in their place. */
static void endless(hid_t file)
{
    static const char *const names[] = {"/time", "/particles/chain/displacement/value", "/particles/chain/bead_force/value"};
    const hsize_t size[3] = {(hsize_t)1 << 40, 18, 3}, chunk[3] = {256, 18, 1};
    for (size_t i = 0; i < 3; i++) {
        hid_t dataset = H5Dopen2(file, names[i], H5P_DEFAULT);
        assert_true(H5Dset_extent(dataset, size) >= 0);
        H5Dclose(dataset);
    }
    hid_t space = H5Screate_simple(3, size, NULL), layout = H5Pcreate(H5P_DATASET_CREATE);
    assert_true(H5Pset_chunk(layout, 3, chunk) >= 0 && H5Ldelete(file, "/particles/chain/velocity/value", H5P_DEFAULT) >= 0);
    hid_t dataset = H5Dcreate2(file, "/particles/chain/velocity/value", H5T_IEEE_F64LE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    assert_true(dataset >= 0);
    H5Dclose(dataset);
    H5Pclose(layout);
    H5Sclose(space);
}
static void other_masses(hid_t file)
{
    poke(file, "/particles/chain/mass", 3, 0, 1, 0.5);
}
static void mass_too_short(hid_t file)
{
    drop(file, "/particles/chain/mass");
    put_dataset(file, "/particles/chain/mass", H5T_NATIVE_DOUBLE, 1, (hsize_t[]){2}, NULL);
}
static void newer_profile(hid_t file)
{
    put_attribute(file, "profile", H5T_STD_I64LE, &(int64_t){99});
}
static void odd_complete(hid_t file)
{
    put_attribute(file, "complete", H5T_STD_I64LE, &(int64_t){7});
}
static void no_spacing(hid_t file)
{
    put_attribute(file, "every", H5T_NATIVE_DOUBLE, &(double){0});
}
static void infinite_end(hid_t file)
{
    put_attribute(file, "end", H5T_NATIVE_DOUBLE, &(double){INFINITY});
}
static void text_spacing(hid_t file)
{
    put_attribute(file, "every", H5T_C_S1, "x");
}
static void unknown_field(hid_t file)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 8);
    put_attribute(file, "fields", type, "bananas");
    H5Tclose(type);
}
static void no_bead(hid_t file)
{
    put_attribute(file, "first_bead", H5T_STD_I64LE, &(int64_t){1000});
}
static void missing_field(hid_t file)
{
    drop(file, "/particles/chain/velocity");
}
static void scene_is_a_number(hid_t file)
{
    drop(file, "/parameters/beadreel/scene");
    put_dataset(file, "/parameters/beadreel/scene", H5T_STD_I64LE, 1, (hsize_t[]){1}, &(int64_t){3});
}
static void scene_is_two_texts(hid_t file)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 4);
    drop(file, "/parameters/beadreel/scene");
    put_dataset(file, "/parameters/beadreel/scene", type, 1, (hsize_t[]){2}, "one\0two");
    H5Tclose(type);
}
static void scene_elsewhere(hid_t file)
{
    drop(file, "/parameters/beadreel/scene");
    H5Lcreate_external("run.h5", "/parameters/beadreel/scene", file, "/parameters/beadreel/scene", H5P_DEFAULT, H5P_DEFAULT);
}
/* Times in a layout of another kind, which is closed. */
static void store_times(hid_t file, hid_t layout)
{
    hid_t space = H5Screate_simple(1, (hsize_t[]){300}, NULL);
    drop(file, "/time");
    hid_t dataset = H5Dcreate2(file, "/time", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    assert_true(dataset >= 0);
    H5Dclose(dataset);
    H5Sclose(space);
    H5Pclose(layout);
}
static void raw_data_elsewhere(hid_t file)
{
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(layout, "/etc/passwd", 0, 2400);
    store_times(file, layout);
}
static void virtual_data(hid_t file)
{
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, (hsize_t[]){300}, NULL);
    H5Pset_virtual(layout, space, "run.h5", "/time", space);
    H5Sclose(space);
    store_times(file, layout);
}
static void data_in_the_header(hid_t file)
{
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_layout(layout, H5D_COMPACT);
    store_times(file, layout);
}
static void filtered_data(hid_t file)
{
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(layout, 1, (hsize_t[]){300});
    H5Pset_shuffle(layout);
    store_times(file, layout);
}
static void outcome_of_one(hid_t file)
{
    drop(file, "/parameters/beadreel/outcome/end");
    put_dataset(file, "/parameters/beadreel/outcome/end", H5T_NATIVE_DOUBLE, 1, (hsize_t[]){1}, &(double){1});
}

static void uncertainty_below_zero(hid_t file)
{
    static const double values[] = {1e-9, -1e-9};
    H5Gclose(H5Gcreate2(file, "/parameters/beadreel/uncertainty", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    put_dataset(file, "/parameters/beadreel/uncertainty/velocity", H5T_NATIVE_DOUBLE, 1, (hsize_t[]){2}, values);
}

static void uncertainty_of_one(hid_t file)
{
    H5Gclose(H5Gcreate2(file, "/parameters/beadreel/uncertainty", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    put_dataset(file, "/parameters/beadreel/uncertainty/velocity", H5T_NATIVE_DOUBLE, 1, (hsize_t[]){1}, &(double){1e-9});
}

static void one_thing_wrong(void **state)
{
    static const struct {
        void (*spoil)(hid_t file);
        const char *words;
    } cases[] = {
        {no_profile, "no /parameters/beadreel"},
        {group_for_dataset, "/time is not a dataset"},
        {rank_two_velocity, "velocity/value has a wrong type or shape"},
        {too_few_beads, "bead_force/value has a wrong type or shape"},
        {integer_times, "/time is of a type that this program does not write"},
        {times_go_back, "time of sample 200"},
        {time_is_nan, "time of sample 299"},
        {endless, "more than the file can hold"},
        {other_masses, "mass of bead 3"},
        {mass_too_short, "mass must have 18 values"},
        {newer_profile, "profile is 99"},
        {odd_complete, "complete is 7"},
        {no_spacing, "times are not valid"},
        {infinite_end, "times are not valid"},
        {text_spacing, "every is missing or of a wrong kind"},
        {unknown_field, "unknown field"},
        {no_bead, "no bead"},
        {missing_field, "no /particles/chain/velocity/value"},
        {scene_is_a_number, "scene must be a text"},
        {scene_is_two_texts, "scene must be a text"},
        {scene_elsewhere, "no /parameters/beadreel/scene"},
        {raw_data_elsewhere, "another file"},
        {virtual_data, "another file"},
        {data_in_the_header, "compressed, filtered or stored in a way"},
        {filtered_data, "compressed, filtered or stored in a way"},
        {outcome_of_one, "outcome/end must have 2 values"},
        {uncertainty_below_zero, "an uncertainty that is negative"},
        {uncertainty_of_one, "uncertainty/velocity must have 2 values"},
    };
    struct bad *b = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        copy_file(b->s.path, b->copy, -1);
        hid_t file = H5Fopen(b->copy, H5F_ACC_RDWR, H5P_DEFAULT);
        cases[i].spoil(file);
        H5Fclose(file);
        assert_int_equal(refused(b->copy, cases[i].words), BEAD_ERROR_FORMAT);
    }
}

static void numbers_are_checked_when_read(void **state)
{
    struct bad *b = *state;
    hid_t file = H5Fopen(b->copy, H5F_ACC_RDWR, H5P_DEFAULT);
    poke(file, "/particles/chain/bead_force/value", 270, 3, 2, INFINITY);
    H5Fclose(file);
    struct bead_trajectory *t = open_file(b->copy);
    struct bead_message msg = {""};
    struct bead_sample sample;
    unsigned force = BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
    assert_int_equal(bead_trajectory_read(t, 10, 0, force, &sample, &msg), BEAD_OK);
    assert_int_equal(bead_trajectory_read(t, 299, 1, force, &sample, &msg), BEAD_ERROR_FORMAT);
    assert_non_null(strstr(msg.text, "sample 270"));
    assert_int_equal(bead_trajectory_read(t, 10, 0, force, &sample, &msg), BEAD_OK); /* read again, as it was */
    assert_true(sample.field[BEAD_FIELD_FORCE][3] == made_up(0, BEAD_FIELD_FORCE, 10, 3));
    assert_int_equal(bead_trajectory_read(t, 299, 1, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), &sample, &msg), BEAD_OK);
    assert_int_equal(bead_trajectory_read(t, 0, 0, BEAD_FIELD_BIT(BEAD_FIELD_ENERGY), &sample, &msg), BEAD_ERROR_USAGE);
    bead_trajectory_close(t);
}

/* The shortest text is read as any other, and then refused for what it says. */
static void a_scene_of_one_letter_is_read(void **state)
{
    struct bad *b = *state;
    hid_t file = H5Fopen(b->copy, H5F_ACC_RDWR, H5P_DEFAULT), letter = H5Tcopy(H5T_C_S1);
    drop(file, "/parameters/beadreel/scene");
    put_dataset(file, "/parameters/beadreel/scene", letter, 1, (hsize_t[]){1}, "7");
    H5Tclose(letter);
    H5Fclose(file);
    assert_int_equal(refused(b->copy, "1:1: is `7`"), BEAD_ERROR_SCENE);
}

/* The last process that was started. */
static pid_t started;

pid_t fork(void)
{
    static pid_t (*next)(void);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "fork");
    const pid_t process = next();
    started = process > 0 ? process : started;
    return process;
}

/* If the process that reads the file ends, because HDF5 crashes or somebody ends it, that is reported, and reading stops. */
static void a_reader_that_ends_is_told(void **state)
{
    struct bad *b = *state;
    static const struct {
        int signal;
        const char *words;
    } ends[] = {{SIGSEGV, "HDF5 crashes on it (Segmentation fault)"}, {SIGKILL, "the process that reads it has ended"}};
    for (size_t i = 0; i < 2; i++) {
        struct bead_message msg = {""};
        struct bead_sample sample;
        const unsigned force = BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
        started = 0;
        struct bead_trajectory *t = open_file(b->s.path);
        if (started > 0) { /* HDF5 files are read in a separate process */
            assert_int_equal(kill(started, ends[i].signal), 0);
            assert_int_equal(bead_trajectory_read(t, 5, 0, force, &sample, &msg), BEAD_ERROR_FORMAT);
            assert_non_null(strstr(msg.text, ends[i].words));
            assert_int_equal(bead_trajectory_read(t, 5, 0, force, &sample, &msg), BEAD_ERROR_FORMAT);
            assert_non_null(strstr(msg.text, "cannot be read"));
            assert_null(strstr(msg.text, "process"));
        }
        bead_trajectory_close(t);
    }
}

/* A run killed between two of HDF5's writes leaves series of different lengths. */
static void the_shortest_series_counts(void **state)
{
    struct bad *b = *state;
    hid_t file = H5Fopen(b->copy, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t dataset = H5Dopen2(file, "/particles/chain/velocity/value", H5P_DEFAULT);
    H5Dset_extent(dataset, (hsize_t[]){123, 18, 3});
    H5Dclose(dataset);
    H5Fclose(file);
    struct bead_trajectory *t = open_file(b->copy);
    assert_int_equal(bead_grid_count(bead_trajectory_grid(t)), 123);
    bead_trajectory_close(t);
}

static void settings_reach_the_scene(void **state)
{
    struct bad *b = *state;
    struct bead_message msg = {""};
    struct bead_trajectory *t = NULL;
    static const char *const good[] = {"title=Another"}, *const wrong[] = {"titel=Another"};
    if (bead_trajectory_open(b->s.path, &(struct bead_overrides){.settings = good, .setting_count = 1}, &t, &msg))
        fail_msg("%s", msg.text);
    assert_string_equal(bead_trajectory_scene(t)->title, "Another");
    bead_trajectory_close(t);
    assert_int_equal(bead_trajectory_open(b->s.path, &(struct bead_overrides){.settings = wrong, .setting_count = 1}, &t, &msg),
                     BEAD_ERROR_SCENE);
    assert_null(t);
}

static void places_that_cannot_be_written(void **state)
{
    struct bad *b = *state;
    struct bead_message msg = {""};
    static const char *const wrong[] = {"/nonexistent/directory", "/dev/null", "/proc"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct bead_run_context context = b->s.context;
        struct bead_sink *sink;
        context.directory = wrong[i];
        assert_int_equal(b->s.type->create(&b->s.scene->outputs[0], &context, &sink, &msg), BEAD_OK);
        assert_int_equal(b->s.type->begin(sink, (struct bead_range){0, 0}, &msg), BEAD_ERROR_IO);
        assert_non_null(strstr(msg.text, wrong[i]));
        b->s.type->destroy(sink);
    }
}

/* The disk fills up while samples are written: an error, and no file. */
static void a_full_disk_is_an_error(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg = {""};
    enum bead_error error = BEAD_OK;
    struct rlimit before, tight;
    set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us", 2e-3);
    getrlimit(RLIMIT_FSIZE, &before);
    tight = before;
    tight.rlim_cur = 200000;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);
    for (; !error && s.next < 2001; s.next++)
        for (size_t c = 0; !error && c < 2; c++)
            error = deliver_one(&s, c, &msg);
    assert_int_equal(error, BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "run.h5.part: "));
    assert_non_null(strstr(msg.text, strerror(EFBIG)));
    tear_down(&s, 0);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
}

/* Two runs into the same file: the second is refused, the first continues. */
static void one_run_at_a_time(void **state)
{
    struct bad *b = *state;
    struct bead_message msg = {""};
    struct bead_sink *first, *second;
    assert_int_equal(b->s.type->create(&b->s.scene->outputs[0], &b->s.context, &first, &msg), BEAD_OK);
    assert_int_equal(b->s.type->create(&b->s.scene->outputs[0], &b->s.context, &second, &msg), BEAD_OK);
    assert_int_equal(b->s.type->begin(first, (struct bead_range){0, 0}, &msg), BEAD_OK);
    assert_int_equal(b->s.type->begin(second, (struct bead_range){0, 0}, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "another run"));
    b->s.type->destroy(second);
    struct bead_trajectory *t = open_file(b->s.part);
    bead_trajectory_close(t);
    b->s.type->destroy(first);
}

/* An earlier file stays if a run fails. */
static void a_failed_run_keeps_the_file_before(void **state)
{
    struct bad *b = *state;
    struct bead_message msg = {""};
    struct bead_sink *sink;
    uint64_t size = bead_file_bytes(b->s.path);
    assert_int_equal(b->s.type->create(&b->s.scene->outputs[0], &b->s.context, &sink, &msg), BEAD_OK);
    assert_int_equal(b->s.type->begin(sink, (struct bead_range){0, 0}, &msg), BEAD_OK);
    assert_int_equal(access(b->s.part, F_OK), 0);
    b->s.type->destroy(sink);
    assert_int_equal(access(b->s.part, F_OK), -1);
    assert_int_equal(bead_file_bytes(b->s.path), size);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define BAD(f) cmocka_unit_test_setup_teardown(f, set_up_bad, tear_down_bad)
        BAD(cut_off_anywhere),
        BAD(bytes_changed),
        BAD(foreign_files),
        BAD(signatures),
        BAD(one_thing_wrong),
        BAD(numbers_are_checked_when_read),
        BAD(a_scene_of_one_letter_is_read),
        BAD(a_reader_that_ends_is_told),
        BAD(the_shortest_series_counts),
        BAD(settings_reach_the_scene),
        BAD(places_that_cannot_be_written),
        BAD(one_run_at_a_time),
        BAD(a_failed_run_keeps_the_file_before),
        cmocka_unit_test(a_full_disk_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
