/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said of progress, by a clock that the test sets: rates and times left of work whose pace is known. */
#include <time.h>

#include "sim/cli/command_line.h"
#include "support.h"

static double now;

int __wrap_clock_gettime(clockid_t, struct timespec *at);
int __wrap_clock_gettime(clockid_t, struct timespec *at)
{
    *at = (struct timespec){(time_t)now, lround(1e9 * (now - floor(now)))};
    return 0;
}

static bool on_terminal;

int __wrap_isatty(int);
int __wrap_isatty(int)
{
    return on_terminal;
}

/* A bar only on a terminal that can move its cursor; what is asked for is what is done. */
static void modes(void **)
{
    static const struct {
        bool terminal;
        const char *type;
        enum command_progress asked, is;
    } cases[] = {{true, "xterm", COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_AUTO},
                 {true, NULL, COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_AUTO},
                 {true, "dumb", COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_PLAIN},
                 {false, "xterm", COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_PLAIN},
                 {false, NULL, COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_PLAIN},
                 {false, "dumb", COMMAND_PROGRESS_JSON, COMMAND_PROGRESS_JSON},
                 {true, "dumb", COMMAND_PROGRESS_NONE, COMMAND_PROGRESS_NONE}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct command_meter meter;
        on_terminal = cases[i].terminal;
        if (cases[i].type)
            setenv("TERM", cases[i].type, 1);
        else
            unsetenv("TERM");
        command_meter_init(&meter, cases[i].asked);
        assert_int_equal(meter.mode, cases[i].is);
    }
}

/* What the meter writes to stderr at a time; to be freed. */
static char *told(struct command_meter *meter, double time, struct bead_progress progress)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const terminal = stderr;
    now = 1000 + time;
    fflush(stderr);
    stderr = open_memstream(&text, &size);
    command_meter_tell(meter, &progress);
    fclose(stderr);
    stderr = terminal;
    return text;
}

static struct command_meter begin(enum command_progress mode)
{
    struct command_meter meter;
    now = 1000;
    command_meter_init(&meter, COMMAND_PROGRESS_JSON);
    meter.mode = mode;
    return meter;
}

struct moment {
    double time;
    const char *what;
    double done, items, reached;
    const char *said;
};

static void says(enum command_progress mode, const char *item, const struct moment *moments, size_t count)
{
    struct command_meter meter = begin(mode);
    for (size_t i = 0; i < count; i++) {
        const struct moment *m = &moments[i];
        char *text = told(&meter, m->time, (struct bead_progress){m->what, m->done, m->reached, m->items, item});
        if (strcmp(text, m->said) != 0)
            fail_msg("moment %zu: '%s', not '%s'", i, text, m->said);
        free(text);
    }
}
#define SAYS(mode, item, ...) \
    says(mode, item, (const struct moment[]){__VA_ARGS__}, sizeof((const struct moment[]){__VA_ARGS__}) / sizeof(struct moment))

/* A line every three seconds, of a stage that takes as long. */
static void lines(void **)
{
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {0, "simulating", 0, 0, NAN, ""}, {2.9, "simulating", 0.029, 0, NAN, ""},
         {4, "simulating", 0.04, 0, NAN, "simulating: 4 %, 96 s left\n"}, {6.9, "simulating", 0.069, 0, NAN, ""},
         {8, "simulating", 0.08, 0, NAN, "simulating: 8 %, 92 s left\n"},
         /* Another stage began with its first report. */
         {40, "drawing", 0, 0, NAN, ""}, {44, "drawing", 0.01, 0, NAN, "drawing: 1 %, 6:36 left\n"},
         {50, "drawing", 1, 0, NAN, "drawing: 100 %\n"}, {54, "drawing", 7, 0, NAN, "drawing: 100 %\n"},
         {58, "drawing", -1, 0, NAN, "drawing: 0 %\n"});
    /* A rate needs half a second, half a percent and some progress; the rest is never nothing. */
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {4, "a", 0.005, 0, NAN, ""}, {8, "a", 0.005, 0, NAN, "a: 0 %\n"},
         {12, "a", 0.0075, 0, NAN, "a: 1 %, 26:28 left\n"});
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {0, "a", 0, 0, NAN, ""}, {8, "a", 0.999, 0, NAN, "a: 100 %, 1 s left\n"});
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {0, "a", 0, 0, NAN, ""}, {99, "a", 0.5, 0, NAN, "a: 50 %, 99 s left\n"});
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {0, "a", 0, 0, NAN, ""}, {100, "a", 0.5, 0, NAN, "a: 50 %, 1:40 left\n"});
    SAYS(COMMAND_PROGRESS_PLAIN, NULL, {0, "a", 0, 0, NAN, ""}, {4000, "a", 0.01, 0, NAN, "a: 1 %, ? left\n"});
    SAYS(COMMAND_PROGRESS_NONE, NULL, {0, "a", 0, 0, NAN, ""}, {8, "a", 0.5, 0, NAN, ""});
}

/* Of a sweep that is resumed, only what is done now counts: 20 chains in 8 s. */
static void resumed_work(void **)
{
    SAYS(COMMAND_PROGRESS_PLAIN, "chains", {0, "a", 0.5, 100, NAN, ""},
         {8, "a", 0.6, 120, NAN, "a: 60 %, 2.5 chains/s, 32 s left\n"});
    SAYS(COMMAND_PROGRESS_PLAIN, "chains", {0, "a", 0, 0, NAN, ""}, {8, "a", 0.2, 0, NAN, "a: 20 %, 32 s left\n"});
    SAYS(COMMAND_PROGRESS_JSON, "chains",
         {0.25, "a", 0.5, 100, NAN, "{\"what\": \"a\", \"done\": 0.5, \"elapsed_s\": 0.25, \"chains\": 100}\n"},
         {0.3, "a", 0.51, 102, NAN, ""},
         {4, "a", 0.6, 120, 2e-6,
          "{\"what\": \"a\", \"done\": 0.6, \"elapsed_s\": 4, \"left_s\": 16, \"chains\": 120, \"time_s\": 2e-06}\n"});
}

/* The rate is that of the last three to six seconds, and a bar is as long as what is done. */
static void bars(void **)
{
    struct command_meter meter = begin(COMMAND_PROGRESS_AUTO);
    for (int i = 0; i <= 700; i++) {
        const double time = 0.125 * i, done = time < 20 ? 0.01 * time : 0.2 + 0.005 * (time - 20);
        char *text = told(&meter, time, (struct bead_progress){"a", done, NAN, 0, NULL}), percent[8], *at = strstr(text, "a, ");
        assert_int_equal(strncmp(text, "\r\033[K[", 5), 0);
        for (int k = 0; k < 24; k++)
            assert_int_equal(text[5 + k], k < (int)(24 * done + 0.5) ? '#' : '.');
        snprintf(percent, sizeof percent, "%3.0f %%", 100 * done);
        assert_int_equal(strncmp(text + 31, percent, 5), 0);
        const double left = at ? strtod(at + 3, NULL) : NAN, even = (1 - done) / (time < 20 ? 0.01 : 0.005);
        if (left < 99 && even < 99 && (time < 20 || time > 26.5))
            assert_true(fabs(left - fmax(even, 1)) < 0.51);
        free(text);
    }
    assert_true(meter.drawn);
    command_meter_clear(&meter);
    assert_false(meter.drawn);
}

static void quantities(void **)
{
    static const struct {
        double value;
        const char *unit, *text;
    } cases[] = {{0, "s", "0 s"},
                 {1.05e-3, "s", "1.05 ms"},
                 {999.94, "N", "999.9 N"},
                 {999.95, "N", "1 kN"},
                 {0.99995, "m", "1 m"},
                 {0.99994, "m", "999.9 mm"},
                 {-3e-9, "m", "-3 nm"},
                 {1e-18, "m", "0.001 fm"},
                 {2.5e15, "Hz", "2500 THz"},
                 {1234567, "", "1.23457e+06"},
                 {INFINITY, "s", "inf s"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[40];
        assert_string_equal(command_quantity(cases[i].value, cases[i].unit, text, sizeof text), cases[i].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(modes), cmocka_unit_test(lines), cmocka_unit_test(resumed_work),
                                       cmocka_unit_test(bars), cmocka_unit_test(quantities)};
    return cmocka_run_group_tests_name("progress", tests, NULL, NULL);
}
