/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A kind of still: a plot or a schematic drawing with a page of its own. */
#include "render/draw/page.h"
#include "render/figure/still.h"
#include "render/plot/plot_data.h"
#include "render/schematic/schematic.h"

struct bead_still {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_plot_data *plot; /* NULL: a drawing */
};

static bool plot_wanted(const struct bead_output *output)
{
    return output->views.count == 0;
}

/* Drawings look at beads, to try them for room. */
static bool is_drawing(const struct bead_output *output)
{
    return bead_schematic_is(output->curves.show);
}

static void plot_destroy(struct bead_still *s)
{
    bead_plot_data_destroy(s->plot);
}

static enum bead_error plot_create(const struct bead_output *output, const struct bead_run_context *context, struct bead_still *s,
                                   struct bead_message *msg)
{
    struct bead_page page;
    s->output = output;
    s->context = *context;
    BEAD_TRY(bead_page_find(output, &page, msg));
    return is_drawing(output) ? bead_schematic_check(output, context, msg)
                              : bead_plot_data_create(output, context, SIZE_MAX, &s->plot, msg);
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
    return s->plot ? bead_plot_data_write(s->plot, outcomes, path, bytes, msg)
                   : bead_schematic_write(s->output, &s->context, path, bytes, msg);
}

const struct bead_still_kind bead_plot_still = {
    .size = sizeof(struct bead_still),
    .wanted = plot_wanted,
    .create = plot_create,
    .looks_at_beads = is_drawing,
    .needs = plot_needs,
    .feed = plot_feed,
    .write = plot_write,
    .destroy = plot_destroy,
};
