/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps: spins, forces, statistics, files and journals. */
#include "support.h"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include "beadreel/sweep.h"
#include "beadreel/trajectory.h"
#include "scratch.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_internal.h"
#include "sweeps.h"

/* Every magnetism that the cells allow, exactly, with majority up; all configurations of one differ in order only. */
static void magnetism_is_exact(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse("sweep: {cells: 9, configurations: 5, seed: 4}" OUTPUT);
    struct bead_sweep *sweep = NULL;
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_panel(sweep, 0)->configurations, 4 * 5 + 1);
    for (size_t i = 0; i < 21; i++) {
        struct bead_sweep_configuration found;
        bead_sweep_configuration(sweep, 0, i, &found);
        size_t up = 0;
        for (size_t k = 0; k < 9; k++)
            up += found.spins[k] == '1';
        assert_int_equal(up, i < 20 ? 5 + i / 5 : 9);
        assert_near(found.magnetism, (2 * (double)up - 9) / 9, 1e-15);
    }
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* More configurations, or other magnetisms beside it, leave a configuration as it is. */
static void configurations_do_not_depend_on_others(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *few = parse("sweep: {cells: 40, configurations: 3, seed: 4, magnetism: 0.5}" OUTPUT);
    struct bead_scene *more = parse("sweep: {cells: 40, configurations: 7, seed: 4, magnetism: [0, 0.5, 0.8]}" OUTPUT);
    struct bead_sweep *a = NULL, *b = NULL;
    assert_int_equal(bead_sweep_create(few, &a, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_create(more, &b, &msg), BEAD_OK);
    struct bead_sweep_configuration one, other, next;
    for (size_t i = 0; i < 3; i++) {
        bead_sweep_configuration(a, 0, i, &one);
        bead_sweep_configuration(b, 0, 7 + i, &other);
        bead_sweep_configuration(b, 0, 8 + i, &next);
        assert_memory_equal(one.spins, other.spins, 40);
        assert_memory_not_equal(one.spins, next.spins, 40);
    }
    bead_sweep_close(a);
    bead_sweep_close(b);
    bead_scene_free(few);
    bead_scene_free(more);
}

/* A number of threads changes nothing, nor does a chain that is run for itself. */
static void threads_change_nothing(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("sweep: {cells: 12, configurations: 3, seed: 8, measure: {decay: true}}" OUTPUT);
    struct bead_sweep *sweep[2] = {compute(scene, &(struct bead_sweep_settings){.threads = 1}),
                                   compute(scene, &(struct bead_sweep_settings){.threads = 5, .instructions = "portable"})};
    for (size_t i = 0; i < bead_sweep_panel(sweep[0], 0)->configurations; i++) {
        struct bead_sweep_configuration a, b;
        assert_true(bead_sweep_configuration(sweep[0], 0, i, &a) && bead_sweep_configuration(sweep[1], 0, i, &b));
        assert_memory_equal(a.peaks, b.peaks, sizeof *a.peaks);
        assert_memory_equal(a.bead_force, b.bead_force, bead_sweep_panel(sweep[0], 0)->beads * sizeof(double));
        assert_memory_equal(a.bead_energy, b.bead_energy, bead_sweep_panel(sweep[0], 0)->beads * sizeof(double));
        /* The peak is the largest of the profile there; nothing has more energy than the striker had. */
        double largest = fmax(a.bead_force[27], fmax(a.bead_force[28], a.bead_force[29]));
        assert_true(a.peaks->force == largest);
        assert_memory_equal(a.last_force, b.last_force, bead_sweep_panel(sweep[0], 0)->beads * sizeof(double));
        assert_memory_equal(a.last_energy, b.last_energy, bead_sweep_panel(sweep[0], 0)->beads * sizeof(double));
        const double striker = 0.5 * 3.63e-3 * 0.443 * 0.443;
        double left = 0;
        for (size_t j = 0; j < bead_sweep_panel(sweep[0], 0)->beads; j++) {
            assert_true(a.bead_energy[j] > 0 && a.bead_energy[j] <= striker * (1 + 1e-6));
            left += a.last_energy[j];
        }
        assert_near(left, striker, 1e-5 * striker);
    }
    bead_sweep_close(sweep[0]);
    bead_sweep_close(sweep[1]);
    bead_scene_free(scene);
}

/* ---- files ---- */

static const char small[] = "sweep: {cells: 6, configurations: 3, seed: 2, magnetism: [0, 0.667]}" OUTPUT;

static void read_file(const char *path, char **bytes, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    *bytes = malloc(1 << 20);
    assert_non_null(*bytes);
    *size = fread(*bytes, 1, 1 << 20, file);
    fclose(file);
}

static void assert_same_files(const char *one, const char *other)
{
    char *a, *b;
    size_t n, m;
    read_file(one, &a, &n);
    read_file(other, &b, &m);
    assert_int_equal(n, m);
    assert_memory_equal(a, b, n);
    free(a);
    free(b);
}

static void in_directory(const char *name, char path[512])
{
    snprintf(path, 512, "%s/%s", directory, name);
}

/* Cut at any byte, the journal is gone on with, and the file is the same. */
static void a_torn_journal_is_gone_on_with(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(small);
    char journal[512], whole[512], again[512], *bytes;
    size_t size;
    in_directory("whole.h5", whole);
    in_directory("again.h5", again);
    in_directory("journal", journal);
    struct bead_sweep *sweep = compute(scene, &(struct bead_sweep_settings){.threads = 2, .journal = journal});
    assert_int_equal(bead_sweep_write(sweep, whole, &msg), BEAD_OK);
    bead_sweep_close(sweep);
    read_file(journal, &bytes, &size);
    for (size_t cut = 0; cut <= size; cut += cut < 80 ? 13 : 29) {
        uint64_t computed = 0;
        FILE *file = fopen(journal, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, cut, file), cut);
        fclose(file);
        assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
        const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 1, .journal = journal};
        if (bead_sweep_run(sweep, &settings, &computed, &msg))
            fail_msg("cut at %zu: %s", cut, msg.text);
        assert_true(cut == size ? computed == 0 : computed > 0);
        assert_int_equal(bead_sweep_write(sweep, again, &msg), BEAD_OK);
        assert_same_files(whole, again);
        bead_sweep_close(sweep);
    }
    free(bytes);
    bead_scene_free(scene);
}

/* A byte that has changed spoils its record and those behind it, no more. */
static void a_spoilt_journal_is_not_believed(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(small),
                      *other = parse("sweep: {cells: 6, configurations: 3, seed: 3, magnetism: [0, 0.667]}" OUTPUT);
    char journal[512];
    in_directory("spoilt", journal);
    const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 1, .journal = journal};
    bead_sweep_close(compute(scene, &settings));
    int file = open(journal, O_RDWR);
    assert_true(file >= 0);
    off_t size = lseek(file, 0, SEEK_END);
    unsigned char byte = 0;
    assert_int_equal(pread(file, &byte, 1, size - 20), 1);
    byte ^= 4;
    assert_int_equal(pwrite(file, &byte, 1, size - 20), 1);
    close(file);
    struct bead_sweep *sweep = NULL;
    uint64_t computed = 0;
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_run(sweep, &settings, &computed, &msg), BEAD_OK);
    assert_int_equal(computed, 1);
    bead_sweep_close(sweep);
    /* Of another scene, or no journal at all: refused, and left alone. */
    assert_int_equal(bead_sweep_create(other, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_run(sweep, &settings, NULL, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "another scene"));
    bead_sweep_close(sweep);
    FILE *text = fopen(journal, "w");
    fputs("A letter to my landlord, which is long enough to be mistaken for the head of a journal.\n", text);
    fclose(text);
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_run(sweep, &settings, NULL, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "not a journal"));
    bead_sweep_close(sweep);
    bead_scene_free(scene);
    bead_scene_free(other);
}

static void parts_make_the_whole(void **state)
{
    (void)state;
    enum { PARTS = 9 }; /* more than there are chains: some are empty */
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(small);
    char whole[512], merged[512], part[PARTS][512];
    const char *paths[PARTS + 1];
    in_directory("all.h5", whole);
    in_directory("merged.h5", merged);
    struct bead_sweep *sweep = compute(scene, NULL);
    assert_int_equal(bead_sweep_write(sweep, whole, &msg), BEAD_OK);
    bead_sweep_close(sweep);
    for (size_t k = 0; k < PARTS; k++) {
        snprintf(part[k], sizeof part[k], "%.400s/part%zu.h5", directory, k);
        paths[(5 * k + 3) % PARTS] = part[k];
        sweep = compute(scene, &(struct bead_sweep_settings){.threads = 1, .part = k + 1, .parts = PARTS});
        assert_int_equal(bead_sweep_write(sweep, part[k], &msg), BEAD_OK);
        bead_sweep_close(sweep);
    }
    assert_int_equal(bead_sweep_merge(paths, PARTS, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_write(sweep, merged, &msg), BEAD_OK);
    bead_sweep_close(sweep);
    assert_same_files(whole, merged);
    /* One missing, one twice, one of another sweep. */
    assert_int_equal(bead_sweep_merge(paths, PARTS - 1, &sweep, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "missing"));
    paths[PARTS] = paths[2];
    assert_int_equal(bead_sweep_merge(paths, PARTS + 1, &sweep, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, paths[2]));
    paths[PARTS] = whole;
    assert_int_equal(bead_sweep_merge(paths, PARTS + 1, &sweep, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, whole));
    bead_scene_free(scene);
}

/* A copy whose first value of a dataset is another. */
static void change_value(const char *path, const char *copy, const char *name, double value)
{
    char *bytes, where[64];
    size_t size;
    read_file(path, &bytes, &size);
    FILE *file = fopen(copy, "wb");
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    free(bytes);
    double values[64];
    snprintf(where, sizeof where, "/sweeps/0/%s", name);
    hid_t h5 = H5Fopen(copy, H5F_ACC_RDWR, H5P_DEFAULT), data = H5Dopen2(h5, where, H5P_DEFAULT);
    assert_true(h5 >= 0 && data >= 0 && H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    values[0] = value;
    assert_true(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Dclose(data);
    H5Fclose(h5);
}

static void remove_data(const char *path, const char *name)
{
    char where[64];
    snprintf(where, sizeof where, "/sweeps/0/%s", name);
    hid_t h5 = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(h5 >= 0 && H5Ldelete(h5, where, H5P_DEFAULT) >= 0);
    H5Fclose(h5);
}

/* Bytes changed here and there: refused, or read without harm. */
static void spoil_bytes(const char *copy, char *bytes, size_t size)
{
    bool is;
    struct bead_message msg = {""};
    for (size_t i = 0; i < 60; i++) {
        size_t at = (i * i * 37 + i) % size;
        FILE *file = fopen(copy, "wb");
        bytes[at] = (char)(bytes[at] ^ (1 << i % 8));
        assert_int_equal(fwrite(bytes, 1, size, file), size);
        fclose(file);
        bytes[at] = (char)(bytes[at] ^ (1 << i % 8));
        struct bead_sweep *read = NULL;
        if (!bead_sweep_is(copy, &is, &msg) && is && !bead_sweep_open(copy, NULL, &read, &msg))
            bead_sweep_close(read);
    }
}

/* Cut off anywhere: refused. */
static void cut_short(const char *copy, const char *bytes, size_t size)
{
    struct bead_message msg = {""};
    for (size_t cut = 0; cut < size; cut += size / 10) {
        struct bead_sweep *read = (void *)&msg; /* no sweep: it must be cleared */
        FILE *file = fopen(copy, "wb");
        assert_int_equal(fwrite(bytes, 1, cut, file), cut);
        fclose(file);
        assert_int_not_equal(bead_sweep_open(copy, NULL, &read, &msg), BEAD_OK);
        assert_null(read);
    }
}

static void files_are_not_trusted(void **state)
{
    bool is;
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(small);
    struct bead_sweep *sweep = compute(scene, NULL), *read = NULL;
    char path[512], copy[512], *bytes;
    size_t size;
    in_directory("trusted.h5", path);
    in_directory("copy.h5", copy);
    assert_int_equal(bead_sweep_write(sweep, path, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_is(path, &is, &msg), BEAD_OK);
    assert_true(is);
    read_file(path, &bytes, &size);
    /* The sweep read equals the one written. */
    assert_int_equal(bead_sweep_open(path, NULL, &read, &msg), BEAD_OK);
    for (size_t i = 0; i < 6; i++)
        assert_memory_equal(peak_of(read, i), peak_of(sweep, i), sizeof(struct bead_sweep_peak));
    bead_sweep_close(read);
    struct bead_trajectory *trajectory = NULL;
    assert_int_equal(bead_trajectory_open(path, NULL, &trajectory, &msg), BEAD_ERROR_FORMAT);
    assert_non_null(strstr(msg.text, "is a sweep's file"));
    /* One thing changed in a good file. */
    static const struct {
        const char *name;
        double value;
    } changes[] = {{"peak_force", -1},       {"peak_force", NAN},
                   {"peak_bead", 1000},      {"peak_bead", -1},
                   {"peak_open", 2},         {"spins", 2},
                   {"configuration", 5},     {"reference_peak_force", INFINITY},
                   {"peak_uncertainty", -1}, {"peak_time_uncertainty", -1}};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        change_value(path, copy, changes[i].name, changes[i].value);
        assert_int_equal(bead_sweep_open(copy, NULL, &read, &msg), BEAD_ERROR_FORMAT);
        assert_null(read);
        assert_non_null(strstr(msg.text, changes[i].name));
    }
    /* Files of earlier versions lack the uncertainties of times. */
    change_value(path, copy, "peak_time_uncertainty", 0);
    remove_data(copy, "peak_time_uncertainty");
    remove_data(copy, "reference_peak_time_uncertainty");
    if (bead_sweep_open(copy, NULL, &read, &msg))
        fail_msg("%s", msg.text);
    assert_true(peak_of(read, 0)->time == peak_of(sweep, 0)->time && peak_of(read, 0)->time_uncertainty == 0);
    assert_true(isnan(bead_sweep_time_uncertainty(read, 0, 0)) && bead_sweep_time_uncertainty(sweep, 0, 0) > 0);
    bead_sweep_close(read);
    /* A setting may change outputs, not physics. */
    const char *harmless[] = {"outputs=[{table: x.csv}]"}, *harmful[] = {"sweep.seed=3"};
    assert_int_equal(bead_sweep_open(path, &(struct bead_overrides){.settings = harmless, .setting_count = 1}, &read, &msg),
                     BEAD_OK);
    bead_sweep_close(read);
    assert_int_equal(bead_sweep_open(path, &(struct bead_overrides){.settings = harmful, .setting_count = 1}, &read, &msg),
                     BEAD_ERROR_USAGE);
    spoil_bytes(copy, bytes, size);
    cut_short(copy, bytes, size);
    free(bytes);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* ---- configurations that are looked at ---- */

struct look {
    size_t samples, last; /* fail at this one */
    double time, largest;
};

static enum bead_error look_on(void *context, const struct bead_sample *sample, struct bead_message *msg)
{
    struct look *look = context;
    if (look->samples == look->last)
        return bead_fail(msg, BEAD_ERROR_IO, "enough");
    assert_true(look->samples == 0 ? sample->time == 0 : sample->time > look->time);
    assert_int_equal(sample->index, look->samples++);
    look->time = sample->time;
    for (size_t j = 0; j < sample->active; j++)
        look->largest = fmax(look->largest, sample->field[BEAD_FIELD_VELOCITY][j]);
    return BEAD_OK;
}

/* Waves in a thousand random cells are chaotic along the chain: the error of the force at its end exceeds the requested accuracy,
 * and the sweep says so; in a short chain it is as requested. */
static void long_chains_say_that_they_are_off(void **state)
{
    (void)state;
    /* Force and time of the first two configurations, as `simulate: {accuracy: 1e-10}` gives them: known to 6e-8. */
    static const struct {
        int cells;
        bool is_off;
        struct {
            double force, time;
        } exact[2];
    } cases[] = {
        {1000, true, {{1.9316944263063307, 0.05661750734708734}, {1.3874350118821446, 0.05622024812784497}}},
        {32, false, {{15.638274897059265, 0.0013755862347133337}, {15.68309833758947, 0.001361594028577539}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "chain: {beads: [{cell: [large-steel, aluminium], count: %d, spins: random}, {cell: [large-steel, aluminium], "
                 "count: 15}]}\nsweep: {configurations: 2, magnetism: [0]}\nsimulate: {accuracy: 1e-6}" OUTPUT,
                 cases[i].cells);
        struct bead_scene *scene = parse(text);
        struct bead_sweep *sweep = compute(scene, NULL);
        const double said = bead_sweep_uncertainty(sweep, 0, 0), of_time = bead_sweep_time_uncertainty(sweep, 0, 0);
        for (size_t c = 0; c < 2; c++) {
            const double error = fabs(peak_of(sweep, c)->force / cases[i].exact[c].force - 1);
            assert_true(error < said);
            assert_true(!cases[i].is_off || error > 1e-6);
            const double late = fabs(peak_of(sweep, c)->time / cases[i].exact[c].time - 1);
            assert_true(late < of_time && of_time < 10 * fmax(late, 1e-6));
            /* one in 64 is measured, of long chains all are */
            assert_true((peak_of(sweep, c)->uncertainty > 0) == (c == 0 || cases[i].is_off));
        }
        assert_true(cases[i].is_off ? said > 1e-6 && said < 1e-2 : said <= 1.001e-6);
        bead_sweep_close(sweep);
        bead_scene_free(scene);
    }
}

/* The same forces as the sweep's, the index 1 of the clean chain, less of others; the same bits for any number of threads. */
static void watches_measure_single_runs(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse("sweep: {cells: 20, magnetism: [0, 0.5, 0.9, 1], configurations: 3}" OUTPUT);
    struct bead_sweep *sweep = compute(scene, NULL);
    size_t count = bead_sweep_panel(sweep, 0)->configurations;
    struct bead_sweep_watch found[2][16] = {0};
    assert_in_range(count, 8, 16);
    for (int threads = 1; threads <= 2; threads++) {
        const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = threads};
        for (size_t i = 0; i < count; i++)
            found[threads - 1][i].index = i;
        if (bead_sweep_watch(sweep, found[threads - 1], count, &settings, &msg))
            fail_msg("%s", msg.text);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
    for (size_t i = 0; i < count; i++) {
        const struct bead_sweep_watch *w = &found[0][i];
        assert_true(w->force == peak_of(sweep, i)->force);
        assert_true(w->arrival > peak_of(sweep, i)->time && w->participation > 1 && w->clean_index >= 0);
        assert_true(i + 1 < count ? w->clean_index < 0.8 : w->clean_index > 0.999);
    }
    assert_true(found[0][0].clean_index < 0.4);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

static void watches_give_samples(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse("sweep: {cells: 8, spins: [\"11011101\"]}" OUTPUT);
    const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 1};
    struct bead_sweep *sweep = NULL;
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    struct look look = {.last = SIZE_MAX};
    struct bead_sweep_watch watch = {
        .end = 1e-4, .every = 1e-5, .fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), .take = look_on, .context = &look};
    if (bead_sweep_watch(sweep, &watch, 1, &settings, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(look.samples, 11);
    assert_true(look.largest == 0.443); /* the striker's, at the start */
    assert_true(isnan(watch.arrival) && isnan(watch.clean_index));
    look = (struct look){.last = 5};
    assert_int_equal(bead_sweep_watch(sweep, &watch, 1, &settings, &msg), BEAD_ERROR_IO);
    assert_string_equal(msg.text, "enough");
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* `accuracy: statistical` moves no mean by more than a hundredth of its standard error, and takes a coarser accuracy for it: the
 * same for any number of threads. */
static void means_are_as_exact_as_they_need(void **state)
{
    (void)state;
#define RANDOM_CELLS "sweep: {cells: 24, configurations: 30, seed: 5, magnetism: [0, 0.5]}\n"
    struct bead_message msg = {""};
    struct bead_scene *scene[] = {parse(RANDOM_CELLS "simulate: {accuracy: 1e-8}\n" OUTPUT),
                                  parse(RANDOM_CELLS "simulate: {accuracy: statistical}\n" OUTPUT)};
    struct bead_sweep *exact = compute(scene[0], &(struct bead_sweep_settings){.threads = 1}), *sweep[2];
    int measured = 0;
    assert_true(bead_sweep_accuracy(exact) == 0);
    for (int i = 0; i < 2; i++) {
        struct bead_sweep_statistics a, b;
        sweep[i] = compute(scene[1], &(struct bead_sweep_settings){.threads = 1 + 3 * i});
        assert_true(bead_sweep_accuracy(sweep[i]) > 1e-6);
        assert_int_equal(bead_sweep_statistics(exact, 0, 0, "law", &a, &msg), BEAD_OK);
        assert_int_equal(bead_sweep_statistics(sweep[i], 0, 0, "law", &b, &msg), BEAD_OK);
        for (size_t r = 0; r < a.row_count; r++)
            assert_near(b.rows[r].summary.mean, a.rows[r].summary.mean, 0.01 * a.rows[r].summary.standard_error);
        bead_sweep_statistics_free(&b);
        assert_int_equal(bead_sweep_statistics(exact, 0, 0, NULL, &b, &msg), BEAD_OK); /* the usual threshold */
        assert_int_equal(b.has_threshold, a.has_threshold);
        assert_memory_equal(b.values, a.values, sizeof *a.values);
        bead_sweep_statistics_free(&a);
        bead_sweep_statistics_free(&b);
    }
    for (size_t i = 0; i < bead_sweep_panel(exact, 0)->configurations; i++) {
        struct bead_sweep_configuration a, b;
        assert_true(bead_sweep_configuration(sweep[0], 0, i, &a) && bead_sweep_configuration(sweep[1], 0, i, &b));
        assert_memory_equal(a.peaks, b.peaks, sizeof *a.peaks);
        measured += a.peaks->uncertainty > 0;
        assert_true(a.peaks->uncertainty == 0 || a.peaks->uncertainty >= bead_sweep_accuracy(sweep[0]) * a.peaks->force);
    }
    assert_true(measured > 0);
    bead_sweep_close(exact);
    for (int i = 0; i < 2; i++) {
        bead_sweep_close(sweep[i]);
        bead_scene_free(scene[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(magnetism_is_exact),
        cmocka_unit_test(configurations_do_not_depend_on_others),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_torn_journal_is_gone_on_with),
        cmocka_unit_test(a_spoilt_journal_is_not_believed),
        cmocka_unit_test(parts_make_the_whole),
        cmocka_unit_test(files_are_not_trusted),
        cmocka_unit_test(long_chains_say_that_they_are_off),
        cmocka_unit_test(means_are_as_exact_as_they_need),
        cmocka_unit_test(watches_measure_single_runs),
        cmocka_unit_test(watches_give_samples),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
