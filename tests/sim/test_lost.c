/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fronts that never arrive: found as soon as energy and momentum exclude their arrival, reported with the line, and without effect
 * on other chains. */
#include "support.h"

#include "scratch.h"

#include "beadreel/session.h"

#define GOOD    "beads: [{cell: [large-steel, aluminium], count: 8}]"
#define BARRED  "beads: [{bead: large-steel, count: 5}, {bead: large-steel, mass: 100 kg}, {bead: large-steel, count: 5}]"
#define DROWNED "beads: [{bead: large-steel, count: 40}], damping: {coefficient: 3000, exponent: 1}"
/* Momentum spreads over so many beads that no force anywhere comes near 1e-4 of the first one any more. */
#define SPREAD "beads: [{bead: large-steel, count: 90}], damping: {coefficient: 3000, exponent: 1}"
#define TABLE  "outputs: [{table: p.csv, uncertainty: false}]\n"

/* Plays a scene; the message of its failure, or its only warning. */
static enum bead_error play(const char *text, struct bead_message *msg)
{
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    char path[512];
    struct bead_session *session = NULL;
    write_scene(text, path);
    struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .sinks = lists};
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    for (size_t i = 0; !err && bead_session_warning(session, i); i++) {
        if (!strstr(bead_session_warning(session, i), "model of elastic"))
            snprintf(msg->text, sizeof msg->text, "%s", bead_session_warning(session, i));
    }
    bead_session_close(session);
    return err;
}

/* The peaks of a chain in the table: those of the rows that begin with `prefix`. */
static size_t read_peaks(const char *prefix, double peaks[64])
{
    char path[768], line[256];
    size_t count = 0;
    snprintf(path, sizeof path, "%s/p.csv", directory);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (int i = 0; fgets(line, sizeof line, file); i++) {
        if (i > 0 && strncmp(line, prefix, strlen(prefix)) == 0 && count < 64)
            sscanf(line + strlen(prefix), "%*[^,],%lf", &peaks[count++]);
    }
    fclose(file);
    return count;
}

/* Of a hundred kilograms a pulse comes back, and most of an end. The time is that of a few pulses, not of hundreds. */
static void a_front_that_is_lost_is_told(void **state)
{
    (void)state;
    static const char *const chains[] = {BARRED, DROWNED, SPREAD};
    for (size_t i = 0; i < 3; i++) {
        struct bead_message msg = {""};
        char text[512];
        double after = NAN;
        snprintf(text, sizeof text, "title: lost\nchain: {%s}\n" TABLE, chains[i]);
        assert_int_equal(play(text, &msg), BEAD_ERROR_NUMBERS);
        const char *told = strstr(msg.text, ":2:8: chain: after ");
        assert_non_null(told);
        assert_non_null(strstr(told, "the front has not reached the end: give simulate.until, such as `until: "));
        assert_int_equal(strstr(told, "less damping") != NULL, i > 0);
        assert_int_equal(sscanf(told, ":2:8: chain: after %lf", &after), 1);
        assert_true(after < (i == 2 ? 0.005 : 0.05));
    }
}

static void other_chains_have_their_results(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    double alone[64], beside[64], lost[64];
    assert_int_equal(play("chains: [{name: good, " GOOD "}]\n" TABLE, &msg), BEAD_OK);
    const size_t count = read_peaks("", alone);
    assert_int_equal(
        play("chains: [{name: good, " GOOD "}, {name: barred, " BARRED "}, {name: drowned, " DROWNED "}]\n" TABLE, &msg), BEAD_OK);
    assert_non_null(strstr(msg.text, "chain barred: after"));
    assert_int_equal(read_peaks("good,", beside), count);
    for (size_t k = 0; k < count; k++)
        assert_true(alone[k] == beside[k]);
    assert_int_equal(read_peaks("barred,", lost), 11);
    assert_true(lost[0] > lost[4] && lost[4] > 1);
}

static void other_chains_of_a_sweep_have_theirs(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    double peaks[64];
    assert_int_equal(play("sweep: {over: {chain.damping.coefficient: [10, 3000, 100]}, measure: {beads: [1, 3]}}\n"
                          "chain: {"
                          "beads: [{bead: large-steel, count: 40}], damping: {coefficient: 10, exponent: 1}"
                          "}\n"
                          "outputs: [{table: p.csv, show: configurations}]\n",
                          &msg),
                     BEAD_OK);
    assert_non_null(strstr(msg.text, "1 of 4 chains have no results"));
    assert_int_equal(read_peaks("0,", peaks), 1);
    assert_int_equal(read_peaks("1,", peaks), 0);
    assert_int_equal(read_peaks("2,", peaks), 1);
}

/* So that no step is short enough; the line is that of the value, or of the sweep. */
static void other_chains_outlive_numbers_that_diverge(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "sweep: {over: {chain.damping.coefficient: [10, 1e9, 100]}, measure: {beads: [1, 3]}}\n"
        "chain: {beads: [{bead: large-steel, count: 40}], damping: {coefficient: 10}}\n",
        "sweep: {over: {chain.striker.velocity: [1, 1e4, 2]}, measure: {beads: [1, 3]}}\n"
        "chain: {striker: {bead: large-steel, velocity: 1}, law: {fpu-alpha: 1e3 1/m, stiffness: 1e6}, beads: [{bead: large-steel, "
        "count: 8}]}\n"};
    static const char *const told[] = {":1:48: chain: at 0 s velocities decay so fast", ":1:8: chain: by "};
    for (size_t i = 0; i < 2; i++) {
        struct bead_message msg = {""};
        char text[512];
        double peaks[64];
        snprintf(text, sizeof text, "%soutputs: [{table: p.csv, show: configurations}]\n", wrong[i]);
        assert_int_equal(play(text, &msg), BEAD_OK);
        if (!strstr(msg.text, told[i]))
            fail_msg("%s", msg.text);
        assert_non_null(strstr(msg.text, "1 of 4 chains have no results"));
        assert_int_equal(read_peaks("0,", peaks), 1);
        assert_int_equal(read_peaks("1,", peaks), 0);
        assert_int_equal(read_peaks("2,", peaks), 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_front_that_is_lost_is_told),
        cmocka_unit_test(other_chains_have_their_results),
        cmocka_unit_test(other_chains_of_a_sweep_have_theirs),
        cmocka_unit_test(other_chains_outlive_numbers_that_diverge),
    };
    return cmocka_run_group_tests_name("lost", tests, make_directory, remove_directory);
}
