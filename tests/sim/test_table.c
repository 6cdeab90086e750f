/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables: exactly the promised columns, numbers that round-trip, in any locale. */
#include "trajectory_support.h"

#include <fcntl.h>
#include <locale.h>

#include "sim/measure/profile_times.h"
#include "tests/missing.h"

static char *read_all(const char *path)
{
    static char text[65536];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

/* End the sink with peaks of contact (or bead) j = j/3 N at j us; the last is still open, the one before was never loaded, the
 * fourth was exceeded later, the sixth is not predictable. */
static void finish_with_peaks(struct stand *s)
{
    struct bead_message msg = {""};
    struct bead_outcome outcomes[4];
    struct bead_peak peaks[4][32];
    double uncertainty[32], of_time[32];
    for (size_t c = 0; c < s->scene->chain_count; c++) {
        size_t count = s->needs.contact_peaks ? bead_chain_contacts(s->chains[c]) : bead_chain_beads(s->chains[c]);
        for (size_t j = 0; j < count; j++)
            uncertainty[j] = (double)j / 1000, of_time[j] = (double)j * 1e-12;
        for (size_t j = 0; j < count; j++)
            peaks[c][j] = (struct bead_peak){.value = (double)(j + c) / 3,
                                             .time = j + 2 == count ? NAN : (double)j * 1e-6,
                                             .open = j + 1 == count,
                                             .exceeded = j == 3,
                                             .unpredictable = j == 5};
        outcomes[c] = made_outcome(c);
        outcomes[c].contact_uncertainty = s->needs.uncertainty ? uncertainty : NULL;
        outcomes[c].contact_time_uncertainty = s->needs.uncertainty ? of_time : NULL;
        outcomes[c].contact_peaks = s->needs.contact_peaks ? peaks[c] : NULL;
        outcomes[c].bead_peaks = s->needs.bead_peaks ? peaks[c] : NULL;
    }
    if (s->type->end(s->sink, outcomes, &msg))
        fail_msg("%s", msg.text);
}

static void peaks_of_one_chain(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, ONE_CHAIN, "table: t.csv, show: peaks", 1e-3);
    assert_true(s.needs.contact_peaks && !s.needs.bead_peaks && s.needs.uncertainty && s.needs.until == 0);
    assert_true(s.needs.grid.every == 0 && s.needs.fields == 0);
    finish_with_peaks(&s);
    char *text = read_all(s.path), *rest = NULL;
    assert_string_equal(strtok_r(text, "\n", &rest), "contact,peak_force_N,time_s,state,uncertainty_N,time_s_uncertainty");
    for (size_t j = 0; j < 13; j++) {
        char *line = strtok_r(NULL, "\n", &rest), *at = NULL;
        assert_int_equal(strtoul(line, &at, 10), j);
        assert_true(strtod(at + 1, &at) == (double)j / 3);
        double time = strtod(at + 1, &at);
        assert_true(j == 11 ? isnan(time) : time == (double)j * 1e-6);
        const char *word = j == 12 ? ",open," : j == 5 ? ",unpredictable," : j == 3 ? ",exceeded," : ",,";
        assert_true(strncmp(at, word, strlen(word)) == 0);
        assert_true(strtod(at + strlen(word), &at) == (double)j / 1000);
        assert_true(strtod(at + 1, &at) == (double)j / 1e12 && *at == '\0');
    }
    assert_null(strtok_r(NULL, "\n", &rest));
    tear_down(&s, 1);
}

static void peaks_of_two_chains_and_some_beads(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "table: t.csv, show: bead-peaks, uncertainty: false", 1e-3);
    assert_true(s.needs.bead_peaks && !s.needs.contact_peaks && !s.needs.uncertainty);
    finish_with_peaks(&s);
    char *text = read_all(s.path);
    assert_true(strncmp(text, "chain,bead,peak_force_N,time_s,state\n\"a, b\",0,0,0,\n", 50) == 0);
    assert_non_null(strstr(text, "\nc,6,2.3333333333333335,6e-06,open\n"));
    uint64_t bytes, items;
    s.type->result(s.sink, &bytes, &items);
    assert_int_equal(items, 11 + 7);
    assert_int_equal(bytes, strlen(text));
    tear_down(&s, 1);
}

/* Only these have rows; beads before the first of them may be left behind by the run, none after it. */
static void listed_peaks(void **state)
{
    (void)state;
    static const struct {
        const char *output;
        size_t rows[14], first; /* the rows end with SIZE_MAX */
    } cases[] = {{"contacts: [7, 3]", {3, 7, SIZE_MAX}, 3},
                 {"contacts: 12", {12, SIZE_MAX}, 12},
                 {"contacts: [0, 5]", {0, 5, SIZE_MAX}, 0},
                 {"beads: [9, 4, 6]", {4, 6, 9, SIZE_MAX}, 4},
                 {"uncertainty: false", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, SIZE_MAX}, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct stand s;
        char output[200];
        snprintf(output, sizeof output, "table: t.csv, show: %s, %s", *cases[i].output == 'b' ? "bead-peaks" : "peaks",
                 cases[i].output);
        set_up(&s, ONE_CHAIN, output, 1e-3);
        assert_int_equal(s.needs.beads.first, cases[i].first);
        assert_true(s.needs.beads.last == SIZE_MAX);
        finish_with_peaks(&s);
        char *rest = NULL;
        strtok_r(read_all(s.path), "\n", &rest);
        for (const size_t *row = cases[i].rows; *row != SIZE_MAX; row++)
            assert_int_equal(strtoul(strtok_r(NULL, "\n", &rest), NULL, 10), *row);
        assert_null(strtok_r(NULL, "\n", &rest));
        tear_down(&s, 1);
    }
}

static void sensors(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, TWO_CHAINS, "table: t.csv, show: sensors, every: 1 us", 0.02e-3);
    assert_int_equal(s.needs.fields, BEAD_FIELD_BIT(BEAD_FIELD_FORCE));
    assert_true(s.needs.beads.first == 1 && s.needs.beads.last == 10); /* beads between the sensors, no more */
    deliver(&s, 20);
    struct bead_message msg = {""};
    assert_int_equal(deliver_one(&s, 0, &msg), BEAD_OK); /* half a row is not written */
    finish(&s);
    char *text = read_all(s.path), *rest = NULL;
    assert_string_equal(strtok_r(text, "\n", &rest), "time_s,\"a, b/end\",c/one,\"a, b/end_uncertainty\",c/one_uncertainty");
    for (size_t i = 0; i < 20; i++) {
        char *line = strtok_r(NULL, "\n", &rest), *at = NULL;
        assert_true(strtod(line, &at) == bead_grid_time(&s.needs.grid, i));
        assert_true(strtod(at + 1, &at) == made_up(0, BEAD_FIELD_FORCE, i, 10));
        assert_true(strtod(at + 1, &at) == made_up(1, BEAD_FIELD_FORCE, i, 1));
        assert_string_equal(at, ",nan,nan"); /* these samples have no check run */
    }
    assert_null(strtok_r(NULL, "\n", &rest));
    tear_down(&s, 1);
}

static void one_chain_has_plain_sensor_names(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, ONE_CHAIN, "table: t.csv, show: sensors, every: 1 us, uncertainty: false", 0.02e-3);
    assert_string_equal(s.needs.why, "21 samples of 1 sensor, every 1 us");
    deliver(&s, 21);
    finish(&s);
    assert_true(strncmp(read_all(s.path), "time_s,first\n0,", 15) == 0);
    tear_down(&s, 1);
}

static void failures_leave_no_file(void **state)
{
    (void)state;
    struct stand s;
    set_up(&s, ONE_CHAIN, "table: t.csv, show: peaks", 1e-3);
    assert_int_equal(access(s.part, F_OK), 0);
    tear_down(&s, 0);
    struct bead_message msg = {""};
    assert_int_equal(try_set_up(&s, ONE_CHAIN, "table: t.csv, show: peaks", 1e-3, &msg), BEAD_OK);
    s.type->destroy(s.sink);
    s.context.directory = "/nonexistent";
    assert_int_equal(s.type->create(&s.scene->outputs[0], &s.context, &s.sink, &msg), BEAD_OK);
    assert_int_equal(s.type->begin(s.sink, (struct bead_range){0, 0}, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "/nonexistent/t.csv"));
    tear_down(&s, 0);
}

/* Text written to `part`, which is open, goes to `device` instead. */
static void write_to(const char *device, const char *part)
{
    char link[64], name[1024];
    int other = open(device, O_WRONLY), moved = 0;
    assert_true(other >= 0);
    for (int file = 3; file < 256; file++) {
        snprintf(link, sizeof link, "/proc/self/fd/%d", file);
        ssize_t length = readlink(link, name, sizeof name - 1);
        if (length <= 0)
            continue;
        name[length] = '\0';
        if (strcmp(name, part) == 0)
            moved += dup2(other, file) == file;
    }
    close(other);
    assert_int_equal(moved, 1);
}

/* A full disk is noticed, at the latest when the file is closed. */
static void a_full_disk_is_an_error(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg = {""};
    if (access("/dev/full", W_OK) != 0)
        skip_without("/dev/full");
    assert_int_equal(try_set_up(&s, ONE_CHAIN, "table: t.csv, show: sensors, every: 1 us", 0.02e-3, &msg), BEAD_OK);
    begin(&s);
    write_to("/dev/full", s.part);
    deliver(&s, 5);
    assert_int_equal(s.type->end(s.sink, NULL, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "No space left"));
    tear_down(&s, 0);
}

/* Samples of one chain, whose velocities grow along it and with time; bead 12 is at rest. */
static void feed(struct bead_profile_times *moments, double until, double every)
{
    struct bead_message msg = {""};
    for (int i = 0; i * every <= until * (1 + 1e-9); i++) {
        double v[13];
        const struct bead_sample sample = {.index = (size_t)i, .time = i * every, .active = 12, .field[BEAD_FIELD_VELOCITY] = v};
        for (int j = 0; j < 13; j++)
            v[j] = j + 1e6 * sample.time * (j + 1);
        assert_int_equal(bead_profile_times_feed(moments, &sample, &msg), BEAD_OK);
    }
}

static double moment_of(const struct stand *s, size_t k)
{
    return s->scene->outputs[0].curves.profile_times[k];
}

/* Profiles are at their moments: those of stored samples on straight lines between two; a run takes samples at the moments, unless
 * the trajectory that it writes has them; also where other outputs take samples at other times. */
static void profiles_are_at_their_moments(void **state)
{
    (void)state;
    static const struct {
        const char *at;
        double native, start, every, end; /* us; native < 0: of the trajectory that the run writes */
        size_t count;
        double moment[4];
        bool samples;
    } cases[] = {{"[0 us, 2.5 us, 7.3 us, 20 us]", 2, 0, 2, 20, 4, {0, 2.5, 7.3, 20}, false},
                 {"[3 us, 5 us]", 2, 2, 2, 6, 2, {3, 5}, false},
                 {"[4 us, 10 us]", 2, 4, 2, 10, 2, {4, 10}, true},
                 {"[4 us, 10 us]", -2, 4, 2, 10, 2, {4, 10}, true},
                 {"[4 us, 8.1 us]", -2, 4, 4.1, 8.1, 2, {4, 8.1}, true},
                 {"[2 us, 4 us, 5 us]", 0, 2, 1, 5, 3, {2, 4, 5}, true},
                 {"[1 us, 2.5 us, 3.6 us]", 0, 1, 1.1, 3.6, 3, {1, 2.5, 3.6}, true},
                 {"[6 us]", 0, 6, 4, 6, 1, {6}, true}};
    for (size_t n = 0; n < 2 * sizeof cases / sizeof *cases; n++) {
        const size_t i = n / 2;
        const double others = n % 2 ? 0.8 : INFINITY; /* us */
        struct bead_message msg = {""};
        struct stand s;
        char output[100];
        snprintf(output, sizeof output, "table: t.csv, show: profiles, field: velocity, at: %s", cases[i].at);
        assert_int_equal(try_set_up(&s, ONE_CHAIN, output, 20e-6, &msg), BEAD_OK);
        struct bead_profile_times *moments;
        s.context.native = (struct bead_grid){.every = 1e-6 * fabs(cases[i].native), .end = 20e-6};
        s.context.replayed = cases[i].native > 0;
        s.context.resolution = 4e-6;
        assert_int_equal(bead_profile_times_create(&s.scene->outputs[0], &s.context, &moments, &msg), BEAD_OK);
        const struct bead_grid grid = bead_profile_times_needs(moments).grid;
        assert_near(grid.start, 1e-6 * cases[i].start, 1e-18);
        assert_near(grid.every, 1e-6 * cases[i].every, 1e-18);
        assert_near(grid.end, 1e-6 * cases[i].end, 1e-18);
        assert_int_equal(bead_profile_times_are_samples(moments), cases[i].samples);
        for (size_t k = 0; grid.times && k < cases[i].count; k++)
            assert_true(bead_grid_count(&grid) == cases[i].count && bead_grid_time(&grid, k) == moment_of(&s, k));
        assert_int_equal(bead_profile_times_values(moments, 0), 13);
        feed(moments, 20e-6, 1e-6 * fmin(others, fmin(cases[i].every, 1 + (cases[i].native > 0))));
        for (size_t k = 0; k < cases[i].count; k++) {
            for (int j = 0; j < 13; j++)
                assert_near(bead_profile_times_profile(moments, 0, k)[j], j < 12 ? j + cases[i].moment[k] * (j + 1) : 0,
                            n % 2 ? 1e-10 : 1e-12);
        }
        bead_profile_times_destroy(moments);
        tear_down(&s, 0);
    }
}

int main(void)
{
    /* A comma for the decimal point, where the machine has such a locale. */
    setlocale(LC_ALL, "de_DE.UTF-8");
    setlocale(LC_CTYPE, "C");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peaks_of_one_chain),
        cmocka_unit_test(peaks_of_two_chains_and_some_beads),
        cmocka_unit_test(listed_peaks),
        cmocka_unit_test(sensors),
        cmocka_unit_test(one_chain_has_plain_sensor_names),
        cmocka_unit_test(profiles_are_at_their_moments),
        cmocka_unit_test(failures_leave_no_file),
        cmocka_unit_test(a_full_disk_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
