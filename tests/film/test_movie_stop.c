/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request to stop takes effect while a film draws many frames of one sample: title cards and pauses may be arbitrarily long. */
#include "support.h"

#include "scratch.h"
#include "sessions.h"

#include <signal.h>

#include "beadreel/render.h"

static volatile sig_atomic_t stop;

/* Acts as a table before the film, and asks to stop when it gets its first sample, or when it is finished before the film. */
struct bead_sink {
    double end;
};
static bool at_end;

static enum bead_error asker_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **sink, struct bead_message *msg)
{
    (void)output, (void)msg;
    *sink = malloc(sizeof **sink);
    assert_non_null(*sink);
    (*sink)->end = context->end;
    return BEAD_OK;
}

static void asker_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE),
                                 .beads = {0, SIZE_MAX},
                                 .grid = {.every = sink->end, .end = sink->end},
                                 .until = sink->end};
}

static enum bead_error asker_begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error asker_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)sink, (void)sample, (void)msg;
    stop = at_end ? 0 : SIGTERM;
    return BEAD_OK;
}

static enum bead_error asker_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    (void)sink, (void)outcomes, (void)msg;
    stop = SIGTERM;
    return BEAD_OK;
}

static void asker_destroy(struct bead_sink *sink)
{
    free(sink);
}

static const struct bead_sink_type asker = {.name = "asker",
                                            .help = "asks to stop",
                                            .kind = BEAD_OUTPUT_TABLE,
                                            .create = asker_create,
                                            .needs = asker_needs,
                                            .begin = asker_begin,
                                            .sample = asker_sample,
                                            .end = asker_end,
                                            .destroy = asker_destroy};

/* Frames in the rest of the film. */
static size_t frames_when_stopped(const char *captions, bool late, int threads)
{
    static const struct bead_sink_type *const askers[] = {&asker, NULL};
    const struct bead_sink_type *const *const sinks[] = {askers, bead_render_sinks(), NULL};
    char scene[512], text[1024];
    struct bead_session *session;
    struct bead_message msg = {""};
    const struct bead_result *results;
    snprintf(text, sizeof text,
             "chain: {beads: [{cell: [large-steel, aluminium], count: 10}], wall: brass}\nsimulate: {until: 0.5 ms}\n"
             "outputs: [{table: asker.csv}, {movie: film.mkv, size: [160, 120], fps: 10, duration: 2 s, views: [beads], %s}]\n",
             captions);
    write_scene(text, scene);
    at_end = late;
    stop = 0;
    struct bead_job job = {.size = sizeof job,
                           .input = scene,
                           .output = directory,
                           .sinks = sinks,
                           .threads = threads,
                           .canvas = "plain",
                           .stop = &stop};
    if (bead_session_open(&job, &session, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bead_session_run(session, &msg), BEAD_ERROR_STOPPED);
    size_t count = bead_session_results(session, &results), frames = 0;
    for (size_t i = 0; i < count; i++) /* without any frame nothing is left */
        frames = strstr(results[i].path, "film.mkv.part") ? results[i].items : frames;
    bead_session_close(session);
    return frames;
}

/* Of 300 frames before the motion, none is drawn after the wish; with threads none is under way at the first sample either. */
static void a_title_card_can_be_stopped(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 3; threads++)
        assert_int_equal(frames_when_stopped("card: {for: 30 s}", false, threads), 0);
}

/* The run is over, and the film has 300 frames of its last sample to draw. With threads, the 20 before them may also be waiting. */
static void a_pause_at_the_end_can_be_stopped(void **state)
{
    (void)state;
    const char *captions = "captions: [{at: 0.49 ms, text: The end, pause: 30 s}]";
    assert_int_equal(frames_when_stopped(captions, true, 1), 20);
    for (int threads = 2; threads <= 3; threads++)
        assert_true(frames_when_stopped(captions, true, threads) <= 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_title_card_can_be_stopped),
        cmocka_unit_test(a_pause_at_the_end_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
