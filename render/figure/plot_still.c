/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two kinds of still: a plot and a schematic drawing, each with a page of its own. */
#include <stdlib.h>

#include "render/figure/still.h"
#include "render/plot/plot_data.h"
#include "render/schematic/schematic.h"

struct bead_still {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    struct bead_plot_data *plot; /* NULL: a drawing */
};

static bool drawing_wanted(const struct bead_output *output)
{
    return output->views.count == 0 && bead_schematic_is(output->curves.show);
}

static bool plot_wanted(const struct bead_output *output)
{
    return output->views.count == 0;
}

static void plot_destroy(struct bead_still *s)
{
    bead_plot_data_destroy(s->plot);
    free(s);
}

static enum bead_error plot_create(const struct bead_output *output, const struct bead_run_context *context,
                                   struct bead_still **still, struct bead_message *msg)
{
    struct bead_still *s = *still = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    s->output = output;
    s->context = *context;
    enum bead_error err = bead_page_find(output, context->scene->file, &s->page, msg);
    if (!err)
        err = drawing_wanted(output) ? bead_schematic_check(output, context, msg)
                                     : bead_plot_data_create(output, context, SIZE_MAX, &s->plot, msg);
    if (err) {
        plot_destroy(s);
        *still = NULL;
    }
    return err;
}

static void drawing_needs(const struct bead_still *s, struct bead_needs *needs)
{
    (void)s;
    *needs = (struct bead_needs){.why = "a drawing of the scene; nothing is computed for it"};
}

static void plot_needs(const struct bead_still *s, struct bead_needs *needs)
{
    bead_plot_data_needs(s->plot, needs);
}

static enum bead_error drawing_feed(struct bead_still *s, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)s, (void)sample, (void)msg;
    return BEAD_OK;
}

static enum bead_error plot_feed(struct bead_still *s, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_plot_data_feed(s->plot, sample, msg);
}

static enum bead_error drawing_write(struct bead_still *s, const struct bead_outcome *outcomes, const char *path, uint64_t *bytes,
                                     struct bead_message *msg)
{
    (void)outcomes;
    return bead_schematic_write(s->output, &s->context, path, bytes, msg);
}

static enum bead_error plot_write(struct bead_still *s, const struct bead_outcome *outcomes, const char *path, uint64_t *bytes,
                                  struct bead_message *msg)
{
    return bead_plot_data_write(s->plot, outcomes, path, bytes, msg);
}

const struct bead_still_kind bead_drawing_still = {
    .wanted = drawing_wanted,
    .create = plot_create,
    .looks_at_beads = drawing_wanted, /* to try it for room */
    .needs = drawing_needs,
    .feed = drawing_feed,
    .write = drawing_write,
    .destroy = plot_destroy,
};
const struct bead_still_kind bead_plot_still = {
    .wanted = plot_wanted,
    .create = plot_create,
    .needs = plot_needs,
    .feed = plot_feed,
    .write = plot_write,
    .destroy = plot_destroy,
};
