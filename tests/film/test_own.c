/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program's own views and sinks: their drawings appear, and incomplete ones are refused. */
#include "support.h"

#include "beadreel/session.h"
#include "beadreel/view.h"
#include "scratch.h"

struct bead_view {
    struct bead_rect plot;
};

static size_t drawn, fed;

static unsigned fields(const struct bead_view_setup *setup)
{
    (void)setup;
    return BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
}

static enum bead_error create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    (void)setup, (void)msg;
    *view = calloc(1, sizeof **view);
    return *view ? BEAD_OK : BEAD_ERROR_MEMORY;
}

static enum bead_error place(struct bead_view *view, struct bead_rect plot, struct bead_canvas *canvas, struct bead_message *msg)
{
    (void)msg;
    assert_null(canvas);
    view->plot = plot;
    return BEAD_OK;
}

static enum bead_error decorate(struct bead_view *view, cairo_t *cr, struct bead_message *msg)
{
    (void)view, (void)cr, (void)msg;
    return BEAD_OK;
}

static enum bead_error feed(struct bead_view *view, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)view, (void)msg;
    assert_non_null(sample->field[BEAD_FIELD_VELOCITY]);
    fed++;
    return BEAD_OK;
}

/* All of it green. */
static enum bead_error draw(struct bead_view *view, double time, struct bead_frame *frame, const struct bead_frame *background,
                            struct bead_changes *changes, struct bead_message *msg)
{
    const struct bead_rect r = view->plot;
    (void)time, (void)background, (void)msg;
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++)
            memcpy(frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x, (const uint8_t[]){0, 255, 0, 255}, 4);
    }
    bead_changes_add(changes, r);
    drawn++;
    return BEAD_OK;
}

static enum bead_error vector(struct bead_view *view, double time, cairo_t *cr, struct bead_message *msg)
{
    (void)time, (void)msg;
    cairo_set_source_rgb(cr, 0, 1, 0);
    cairo_rectangle(cr, view->plot.x, view->plot.y, view->plot.width, view->plot.height);
    cairo_fill(cr);
    return BEAD_OK;
}

static void destroy(struct bead_view *view)
{
    free(view);
}

static const struct bead_view_info info = {
    .name = "green", .help = "nothing but green", .still_share = 1, .shape = 2, .movie_share = 1, .movie_most = 1};
static const struct bead_view_type green = {.info = &info,
                                            .fields = fields,
                                            .create = create,
                                            .place = place,
                                            .decorate = decorate,
                                            .feed = feed,
                                            .draw = draw,
                                            .vector = vector,
                                            .destroy = destroy};

static enum bead_error make(const char *outputs, const struct bead_own *own, struct bead_message *msg)
{
    const struct bead_sink_type *const *const sinks[] = {bead_render_sinks(), NULL};
    char scene[512], text[400];
    struct bead_session *session;
    struct bead_job job;
    snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, count: 5}]}\nsimulate: {until: 100 us}\noutputs: [{%s}]\n",
             outputs);
    write_scene(text, scene);
    BEAD_DEFAULT(&job);
    job.input = scene;
    job.output = directory;
    job.sinks = sinks;
    job.own = own;
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    return err;
}

static size_t count_green(const char *name)
{
    char path[400];
    size_t found = 0;
    snprintf(path, sizeof path, "%s/%s", directory, name);
    cairo_surface_t *picture = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(picture), CAIRO_STATUS_SUCCESS);
    const uint8_t *at = cairo_image_surface_get_data(picture);
    for (int i = 0; i < 240 * cairo_image_surface_get_stride(picture); i += 4)
        found += at[i] == 0 && at[i + 1] == 255 && at[i + 2] == 0;
    cairo_surface_destroy(picture);
    return found;
}

static void test_own_views_draw(void **state)
{
    (void)state;
    const struct bead_view_type *const views[] = {&green, NULL};
    const struct bead_own own = {.views = views};
    struct bead_message msg = {""};
    assert_int_equal(make("image: a.png, views: [green], size: [320, 240]", &own, &msg), BEAD_OK);
    assert_true(count_green("a.png") > 320 * 240 / 4);
    drawn = fed = 0;
    assert_int_equal(
        make("movie: a.png, views: [beads, green], time: [0, 30 us], fps: 10, duration: 1 s, size: [320, 240]", &own, &msg),
        BEAD_OK);
    assert_int_equal(drawn, 10);
    assert_true(fed >= 10);
    assert_true(count_green("a.png") > 320 * 240 / 5); /* an animated PNG's first frame */
}

/* ---- a sink that wants the outcome alone ---- */

struct bead_sink {
    int nothing;
};

static double ended, largest; /* the run's end, s; the first contact's peak, N */

static enum bead_error sink_create(const struct bead_output *output, const struct bead_run_context *context,
                                   struct bead_sink **sink, struct bead_message *msg)
{
    (void)output, (void)context, (void)msg;
    *sink = calloc(1, sizeof **sink);
    return *sink ? BEAD_OK : BEAD_ERROR_MEMORY;
}

static void sink_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    (void)sink;
    needs->contact_peaks = true;
}

static enum bead_error sink_begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sink_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)sink, (void)sample, (void)msg;
    return BEAD_OK;
}

static enum bead_error sink_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    (void)sink, (void)msg;
    ended = outcomes[0].end;
    largest = outcomes[0].contact_peaks[0].value;
    return BEAD_OK;
}

static void sink_destroy(struct bead_sink *sink)
{
    free(sink);
}

/* Peaks are those of the run, to its end at 100 us, although the sink names no time until which it needs them. */
static void test_own_sinks_have_the_whole_run(void **state)
{
    (void)state;
    const struct bead_sink_type mine = {.name = "mine",
                                        .help = "keeps the outcome",
                                        .kind = BEAD_OUTPUT_OWN,
                                        .endings = ".txt",
                                        .create = sink_create,
                                        .needs = sink_needs,
                                        .begin = sink_begin,
                                        .sample = sink_sample,
                                        .end = sink_end,
                                        .destroy = sink_destroy};
    const struct bead_sink_type *const sinks[] = {&mine, NULL};
    struct bead_message msg = {""};
    ended = largest = NAN;
    assert_int_equal(make("mine: a.txt", &(struct bead_own){.sinks = sinks}, &msg), BEAD_OK);
    assert_true(ended >= 100e-6 && ended < 101e-6);
    assert_true(largest > 0);
}

static void expect(const struct bead_own *own, enum bead_error error, const char *says)
{
    struct bead_message msg = {""};
    assert_int_equal(make("image: b.png, views: [green], size: [320, 240]", own, &msg), error);
    if (!strstr(msg.text, says))
        fail_msg("%s: not in: %s", says, msg.text);
}

static void test_parts_that_lack_something_are_refused(void **state)
{
    (void)state;
    struct bead_view_type half = green;
    const struct bead_view_type *const views[] = {&half, NULL};
    struct bead_sink_type sink = {.name = "mine", .kind = BEAD_OUTPUT_OWN, .endings = ".txt"};
    const struct bead_sink_type *const sinks[] = {&sink, NULL};
    expect(NULL, BEAD_ERROR_SCENE, "green");
    half.vector = NULL;
    expect(&(struct bead_own){.views = views}, BEAD_ERROR_USAGE, "view `green`: a function is missing");
    expect(&(struct bead_own){.sinks = sinks}, BEAD_ERROR_USAGE, "sink `mine`: one of create, needs");
    sink = **bead_render_sinks();
    expect(&(struct bead_own){.sinks = sinks}, BEAD_ERROR_USAGE, "endings");
    sink.kind = BEAD_OUTPUT_OWN;
    sink.endings = ".txt";
    expect(&(struct bead_own){.sinks = sinks}, BEAD_ERROR_USAGE, "sink `image`: the library has outputs of this name");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_own_views_draw),
        cmocka_unit_test(test_own_sinks_have_the_whole_run),
        cmocka_unit_test(test_parts_that_lack_something_are_refused),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
