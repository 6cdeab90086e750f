/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sinks for `image:` and `plot:` outputs: each is a still of the first kind that accepts it. */
#include "render/figure/still.h"

#include <stdlib.h>

#include "render/encode/page.h"
#include "render/plot/plot_data.h"
#include "render/schematic/schematic.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

/* A kind of still: a plot or a schematic drawing with a whole page. */

struct bead_still {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_plot_data *plot; /* NULL: a drawing */
};

static bool plot_wanted(const struct bead_output *output)
{
    return output->views.count == 0;
}

/* Drawings read the beads, to see whether they fit, and theories, whether they are alike. */
static bool plot_looks_at_beads(const struct bead_output *output)
{
    return bead_schematic_is(output->curves.show) || output->shown.theory;
}

static void plot_destroy(struct bead_still *s)
{
    bead_plot_data_destroy(s->plot);
}

static enum bead_error plot_create(const struct bead_output *output, const struct bead_run_context *context, struct bead_still *s,
                                   struct bead_message *msg)
{
    s->output = output;
    s->context = *context;
    if (bead_schematic_is(output->curves.show))
        return bead_schematic_check(output, context, msg);
    BEAD_TRY(bead_plot_data_create(output, context, SIZE_MAX, &s->plot, msg));
    return bead_plot_data_check(s->plot, msg);
}

static void plot_needs(const struct bead_still *s, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.why = "a drawing of the scene; nothing is computed for it"};
    if (s->plot)
        bead_plot_data_needs(s->plot, needs);
}

static enum bead_error plot_feed(struct bead_still *s, const struct bead_sample *sample, struct bead_message *msg)
{
    return s->plot ? bead_plot_data_feed(s->plot, sample, msg) : BEAD_OK;
}

static enum bead_error plot_write(struct bead_still *s, const struct bead_outcome *outcomes, const char *path, uint64_t *bytes,
                                  struct bead_message *msg)
{
    if (!s->plot)
        return bead_schematic_write(s->output, &s->context, path, bytes, msg);
    BEAD_TRY(bead_plot_data_finish(s->plot, outcomes, msg));
    return bead_plot_data_write(s->plot, path, bytes, msg);
}

static const struct bead_still_kind plot_still = {
    .size = sizeof(struct bead_still),
    .wanted = plot_wanted,
    .create = plot_create,
    .looks_at_beads = plot_looks_at_beads,
    .needs = plot_needs,
    .feed = plot_feed,
    .write = plot_write,
    .destroy = plot_destroy,
};

static const struct bead_still_kind *const kinds[] = {&bead_panels, &plot_still, &bead_bare_image, &bead_panels};

struct bead_sink {
    const struct bead_still_kind *kind;
    struct bead_still *still;
    char *path;
    uint64_t bytes;
    char makers[96];
};

static void still_destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    if (sink->still)
        sink->kind->destroy(sink->still);
    free(sink->still);
    free(sink->path);
    free(sink);
}

/* The last kind accepts the outputs that no other does. */
static const struct bead_still_kind *still_kind_of(const struct bead_output *output)
{
    size_t k = 0;
    while (k + 1 < sizeof kinds / sizeof *kinds && !kinds[k]->wanted(output))
        k++;
    return kinds[k];
}

static bool still_looks_at_beads(const struct bead_output *output, const struct bead_run_context *)
{
    const struct bead_still_kind *kind = still_kind_of(output);
    return kind->looks_at_beads && kind->looks_at_beads(output);
}

static enum bead_error still_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(sink, 1, msg, "a picture"));
    struct bead_sink *s = *sink;
    s->kind = still_kind_of(output);
    BEAD_TRY(bead_allocate(&s->still, 1, s->kind->size, msg, "a picture"));
    BEAD_TRY(s->kind->create(output, context, s->still, msg));
    return bead_file_join(context->directory, output->path, &s->path, msg);
}

static void still_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    sink->kind->needs(sink->still, needs);
}

static enum bead_error still_begin(struct bead_sink *, struct bead_range, struct bead_message *)
{
    return BEAD_OK;
}

static enum bead_error still_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    return sink->kind->feed(sink->still, sample, msg);
}

static enum bead_error still_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    enum bead_error err = sink->kind->write(sink->still, outcomes, sink->path, &sink->bytes, msg);
    const char *painter = sink->kind->painter ? sink->kind->painter(sink->still) : "";
    snprintf(sink->makers, sizeof sink->makers, "%s%s", *painter ? "painted by " : "", painter);
    return err;
}

static const char *still_makers(const struct bead_sink *sink)
{
    return sink->makers;
}

static void still_result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

#define STILL(title, words, of)                                                                                             \
    {                                                                                                                       \
        .name = title, .help = words, .kind = of, .create = still_create, .needs = still_needs, .begin = still_begin,       \
        .sample = still_sample, .end = still_end, .destroy = still_destroy, .result = still_result, .makers = still_makers, \
        .looks_at_beads = still_looks_at_beads                                                                              \
    }

const struct bead_sink_type bead_image_sink =
    STILL("image", "space-time image or a still of other views: png, pdf, svg", BEAD_OUTPUT_IMAGE);
const struct bead_sink_type bead_plot_sink =
    STILL("plot", "sensors, peaks, modes, profiles, or schematic drawings: png, pdf, svg", BEAD_OUTPUT_PLOT);
