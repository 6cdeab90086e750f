/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structures that begin with their size: a caller compiled with an older and smaller one gets defaults for missing members, and an
 * impossible size is refused. */
#include "support.h"

#include "scratch.h"

#include <stddef.h>

#include "beadreel/movie.h"
#include "beadreel/session.h"
#include "beadreel/sweep.h"
#include "render/draw/picture.h"
#include "sessions.h"
#include "sweeps.h"

/* As an older header defines it; the memory after it is the caller's own. */
struct old_job {
    size_t size;
    const char *input;
    const char *const *settings;
    size_t setting_count;
    const char *output;
    const char *const *only;
    size_t only_count;
    int threads;
    const char *instructions;
    const char *canvas;
    bool hash, full_window;
    const struct bead_sink_type *const *const *sinks;
    char behind[sizeof(struct bead_job)];
};
_Static_assert(offsetof(struct old_job, sinks) == offsetof(struct bead_job, sinks), "members keep their places");

static enum bead_error open_with(size_t size, struct bead_message *msg)
{
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    char path[512];
    write_scene("chain: {beads: [{cell: [large-steel], count: 5}]}\nsimulate: {until: 1 us}\noutputs: [{table: peaks.csv, show: "
                "peaks}]\n",
                path);
    struct old_job job = {.size = size, .input = path, .output = directory, .sinks = lists};
    memset(job.behind, 0x55, sizeof job.behind);
    struct bead_session *session = NULL;
    enum bead_error err = bead_session_open((const struct bead_job *)(const void *)&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    return err;
}

static void an_older_job_runs(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    if (open_with(offsetof(struct old_job, behind), &msg))
        fail_msg("%s", msg.text);
}

static void wrong_sizes_are_refused(void **state)
{
    (void)state;
    const size_t wrong[] = {0,
                            8,
                            offsetof(struct old_job, sinks),
                            offsetof(struct old_job, behind) + 1,
                            sizeof(struct bead_job) + 8,
                            SIZE_MAX - 7,
                            0x5555555555555555};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct bead_message msg = {""};
        assert_int_equal(open_with(wrong[i], &msg), BEAD_ERROR_USAGE);
        assert_non_null(strstr(msg.text, "bead_job"));
        assert_non_null(strstr(msg.text, "BEAD_DEFAULT"));
    }
}

static void default_fills_all(void **state)
{
    (void)state;
    struct bead_job job;
    memset(&job, 0x55, sizeof job);
    BEAD_DEFAULT(&job);
    struct bead_job expected = {.size = sizeof job};
    assert_true(job.size == expected.size && !job.input && !job.sinks && !job.progress && !job.parts && !job.allow_outside);
}

static void older_settings_of_a_sweep(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("sweep: {cells: 12, configurations: 2, seed: 8}\noutputs: [{sweep: s.h5}]\n");
    struct bead_sweep *sweep = NULL;
    struct bead_message msg = {""};
    uint64_t computed = 0;
    struct bead_sweep_settings settings;
    memset(&settings, 0x55, sizeof settings);
    settings.threads = 1;
    settings.instructions = NULL;
    settings.size = offsetof(struct bead_sweep_settings, journal);
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    if (bead_sweep_run(sweep, &settings, &computed, &msg))
        fail_msg("%s", msg.text);
    assert_true(computed >= 2);
    settings.size = sizeof settings + 8;
    assert_int_equal(bead_sweep_run(sweep, &settings, NULL, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "bead_sweep_settings"));
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

static void older_settings_of_a_movie(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_movie_settings settings;
    memset(&settings, 0x55, sizeof settings);
    settings.width = settings.height = 64;
    settings.fps = 25;
    settings.quality = BEAD_QUALITY_STANDARD;
    settings.size = offsetof(struct bead_movie_settings, title);
    char path[512];
    struct bead_movie *movie = NULL;
    snprintf(path, sizeof path, "%s/a.gif", directory);
    if (bead_movie_check(path, &settings, &msg) || bead_movie_open(path, &settings, &movie, &msg))
        fail_msg("%s", msg.text);
    bead_movie_abort(movie);
    settings.size = 8;
    assert_int_equal(bead_movie_check(path, &settings, &msg), BEAD_ERROR_USAGE);
    assert_int_equal(bead_movie_open(path, &settings, &movie, &msg), BEAD_ERROR_USAGE);
    assert_null(movie);
    assert_non_null(strstr(msg.text, "bead_movie_settings"));
}

static void older_notes_of_a_picture(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_picture_notes notes;
    struct bead_frame frame;
    memset(&notes, 0x55, sizeof notes);
    notes.dpi = 300;
    notes.size = offsetof(struct bead_picture_notes, title);
    char path[512];
    snprintf(path, sizeof path, "%s/a.png", directory);
    assert_int_equal(bead_frame_create(8, 8, &frame, &msg), BEAD_OK);
    if (bead_png_write(path, &frame, &notes, NULL, &msg))
        fail_msg("%s", msg.text);
    notes.size = 1;
    assert_int_equal(bead_png_write(path, &frame, &notes, NULL, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "bead_picture_notes"));
    bead_frame_free(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_older_job_runs),         cmocka_unit_test(wrong_sizes_are_refused),
        cmocka_unit_test(default_fills_all),         cmocka_unit_test(older_settings_of_a_sweep),
        cmocka_unit_test(older_settings_of_a_movie), cmocka_unit_test(older_notes_of_a_picture),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
