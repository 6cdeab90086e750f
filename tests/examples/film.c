/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film with a custom view, a bar as high as the share of kinetic energy, and a custom file beside it, the momentum at each time.
 * Build: cc film.c $(pkg-config --cflags --libs beadreel cairo) */
#include <beadreel/render.h>
#include <beadreel/session.h>
#include <beadreel/view.h>
#include <stdio.h>
#include <stdlib.h>

static double moving(const struct bead_chain *chain, const struct bead_sample *sample, int power)
{
    const double *v = sample->field[BEAD_FIELD_VELOCITY], *mass = bead_chain_mass(chain);
    double sum = 0;
    for (size_t i = 0; i < sample->active; i++) /* behind these all beads are at rest */
        sum += mass[i] * (power == 2 ? 0.5 * v[i] * v[i] : v[i]);
    return sum;
}

/* ---- the view ---- */

struct bead_view {
    const struct bead_chain *chain;
    struct bead_rgb colour;
    struct bead_rect plot;
    double share;
};

static unsigned fields(const struct bead_view_setup *setup)
{
    (void)setup;
    return BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
}

static enum bead_error create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    *view = malloc(sizeof **view);
    if (!*view)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a bar");
    **view = (struct bead_view){.chain = setup->chain, .colour = setup->look->accent};
    return BEAD_OK;
}

static enum bead_error place(struct bead_view *view, struct bead_rect plot, struct bead_canvas *canvas, struct bead_message *msg)
{
    (void)canvas, (void)msg;
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
    (void)msg;
    view->share = moving(view->chain, sample, 2) / bead_chain_energy(view->chain);
    return BEAD_OK;
}

static enum bead_error vector(struct bead_view *view, double time, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_rect r = view->plot;
    (void)time, (void)msg;
    cairo_set_source_rgb(cr, view->colour.r, view->colour.g, view->colour.b);
    cairo_rectangle(cr, r.x, r.y + r.height * (1 - view->share), r.width, r.height * view->share);
    cairo_fill(cr);
    return BEAD_OK;
}

static enum bead_error draw(struct bead_view *view, double time, struct bead_frame *frame, const struct bead_frame *background,
                            struct bead_changes *changes, struct bead_message *msg)
{
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        frame->pixels, frame->alpha ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, frame->width, frame->height, (int)frame->stride);
    cairo_t *cr = cairo_create(surface);
    bead_frame_copy(frame, background, view->plot);
    cairo_surface_mark_dirty(surface);
    enum bead_error err = vector(view, time, cr, msg);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    bead_changes_add(changes, view->plot);
    return err;
}

static void destroy(struct bead_view *view)
{
    free(view);
}

static const struct bead_view_info info = {.name = "moving",
                                           .help = "share of the energy that moves",
                                           .still_share = 0.3,
                                           .shape = 2,
                                           .movie_share = 1,
                                           .movie_most = 0.5};
static const struct bead_view_type bar = {.info = &info,
                                          .fields = fields,
                                          .create = create,
                                          .place = place,
                                          .decorate = decorate,
                                          .feed = feed,
                                          .draw = draw,
                                          .vector = vector,
                                          .destroy = destroy};

/* ---- the file ---- */

struct bead_sink {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_grid times;
    double (*row)[2]; /* momentum, share */
    uint64_t bytes;
};

static enum bead_error create_table(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **sink, struct bead_message *msg)
{
    struct bead_sink *s = *sink = calloc(1, sizeof *s);
    const double every = output->shown.every > 0 ? output->shown.every : context->end / 100;
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %s", output->path);
    s->output = output;
    s->context = *context;
    s->times = (struct bead_grid){.every = every, .end = context->end};
    s->row = calloc(bead_grid_count(&s->times), sizeof *s->row);
    return s->row ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %s", output->path);
}

static void tell_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY),
                                 .beads = {0, SIZE_MAX},
                                 .grid = sink->times,
                                 .until = sink->times.end,
                                 .why = "the momentum"};
}

static enum bead_error begin_table(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error take(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)msg;
    const struct bead_chain *chain = sink->context.chains[sample->chain];
    if (sample->chain > 0) /* the first chain's only */
        return BEAD_OK;
    sink->row[sample->index][0] = moving(chain, sample, 1);
    sink->row[sample->index][1] = moving(chain, sample, 2) / bead_chain_energy(chain);
    return BEAD_OK;
}

static enum bead_error fill(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    const struct bead_sink *sink = context;
    (void)part, (void)msg; /* errors of writing are found when the file is closed */
    for (size_t i = 0; i < bead_grid_count(&sink->times); i++)
        fprintf(file, "%.9g %.9g %.9g\n", bead_grid_time(&sink->times, i), sink->row[i][0], sink->row[i][1]);
    return BEAD_OK;
}

static enum bead_error end_table(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    char *path;
    (void)outcomes;
    enum bead_error err = bead_file_join(sink->context.directory, sink->output->path, &path, msg);
    if (!err)
        err = bead_file_write(path, fill, sink, &sink->bytes, msg);
    free(path);
    return err;
}

static void destroy_table(struct bead_sink *sink)
{
    if (sink)
        free(sink->row);
    free(sink);
}

static void tell_result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = bead_grid_count(&sink->times);
}

static const struct bead_sink_type momentum = {.name = "momentum",
                                               .help = "the momentum at each time",
                                               .kind = BEAD_OUTPUT_OWN,
                                               .endings = ".txt",
                                               .create = create_table,
                                               .needs = tell_needs,
                                               .begin = begin_table,
                                               .sample = take,
                                               .end = end_table,
                                               .destroy = destroy_table,
                                               .result = tell_result};

/* film SCENE [OUTPUT]: the scene may ask for `views: [beads, moving]` and `momentum: FILE.txt` */
int main(int argc, char **argv)
{
    const struct bead_sink_type *const *const sinks[] = {bead_render_sinks(), bead_data_sinks(), NULL};
    const struct bead_view_type *const views[] = {&bar, NULL};
    const struct bead_sink_type *const own_sinks[] = {&momentum, NULL};
    const struct bead_own own = {.views = views, .sinks = own_sinks};
    struct bead_session *session;
    struct bead_message msg;
    struct bead_job job;

    BEAD_DEFAULT(&job);
    job.input = argc > 1 ? argv[1] : "clean-vs-delocalised";
    job.output = argc > 2 ? argv[2] : ".";
    job.sinks = sinks;
    job.own = &own;
    enum bead_error err = bead_session_open(&job, &session, &msg);
    if (!err)
        err = bead_session_run(session, &msg);
    const struct bead_result *result = NULL;
    const size_t count = err ? 0 : bead_session_results(session, &result);
    for (size_t i = 0; i < count; i++)
        printf("%s %s: %llu items\n", result[i].kind, result[i].path, (unsigned long long)result[i].items);
    if (err)
        fprintf(stderr, "%s\n", msg.text);
    bead_session_close(session);
    return bead_error_status(err);
}
