/* Sink for `plot:` outputs with `show: profiles`: a field along the chain at several times, a panel for each chain. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "beadreel/look.h"
#include "beadreel/moments.h"
#include "render/graph.h"
#include "render/markup.h"
#include "render/sinks.h"
#include "render/units.h"

struct bead_sink {
    struct bead_output output;
    struct bead_stage stage;
    struct bead_moments *moments;
    char *path;
    uint64_t bytes;
};

static void destroy(struct bead_sink *s)
{
    if (!s)
        return;
    bead_moments_destroy(s->moments);
    free(s->path);
    free(s);
}

static enum bead_error create(const struct bead_output *output, const struct bead_stage *stage, struct bead_sink **made,
                              struct bead_message *msg)
{
    *made = NULL;
    struct bead_sink *s = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    s->output = *output;
    s->stage = *stage;
    enum bead_error err = bead_moments_create(&s->output, stage, &s->moments, msg);
    if (!err)
        err = bead_file_join(stage->directory, output->path, &s->path, msg);
    if (err)
        destroy(s);
    else
        *made = s;
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = bead_moments_needs(sink->moments);
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_moments_feed(s->moments, sample, msg);
}

static void fill_panel(struct bead_sink *s, size_t c, char (*label)[64], struct bead_series *series, struct bead_panel *panel)
{
    const struct bead_chain *chain = s->stage.chains[c];
    const struct bead_field_info *field = bead_chain_field(chain, s->output.field);
    const struct bead_along along = bead_chain_along(chain, field->of_contacts);
    const double *places = bead_moments_places(s->moments, c);
    size_t count = bead_moments_values(s->moments, c);
    for (size_t m = 0; m < s->output.moment_count; m++)
        series[m] = (struct bead_series){.x = places,
                                         .y = bead_moments_profile(s->moments, c, m),
                                         .count = count,
                                         .mark = BEAD_MARK_LINE,
                                         .colour = m,
                                         .label = c == 0 ? label[m] : NULL};
    *panel = (struct bead_panel){.title = *bead_chain_name(chain) ? bead_chain_name(chain) : NULL,
                                 .x = {along.title, along.unit, places[0], places[count - 1], BEAD_SCALE_LINEAR, false},
                                 .y = {field->title, field->unit, s->output.range[0], s->output.range[1], BEAD_SCALE_LINEAR, true},
                                 .series = series,
                                 .series_count = s->output.moment_count};
}

/* No more digits than it needs, five at most. */
static void time_words(double time, const char *unit, char *text, size_t size)
{
    double shown = time / bead_power_of_ten(bead_prefix_exponent(time, unit));
    int digits = 1;
    while (digits < 5 && shown != 0) {
        double part = bead_power_of_ten(digits - 1 - (int)floor(log10(fabs(shown))));
        if (fabs(round(shown * part) / part - shown) < 1e-7 * fabs(shown))
            break;
        digits++;
    }
    int whole = shown >= 1 ? (int)floor(log10(shown)) + 1 : 1; /* 500, not 5e2 */
    bead_quantity(time, unit, digits > whole ? digits : whole, text, size);
}

static enum bead_error end(struct bead_sink *s, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    (void)outcomes;
    size_t chains = s->stage.chain_count, moments = s->output.moment_count;
    struct bead_series *series = calloc(chains * moments, sizeof *series);
    struct bead_panel *panels = calloc(chains, sizeof *panels);
    char(*label)[64] = calloc(moments, sizeof *label), time[48];
    enum bead_error err =
        series && panels && label ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot of profiles");
    for (size_t m = 0; !err && m < moments; m++) {
        time_words(s->output.moments[m], bead_chain_time_unit(s->stage.chains[0]), time, sizeof time);
        snprintf(label[m], sizeof *label, "*t* = %s", time);
    }
    for (size_t c = 0; !err && c < chains; c++)
        fill_panel(s, c, label, series + c * moments, &panels[c]);
    char title[2048] = "";
    if (s->output.style != BEAD_STYLE_PAPER) /* on paper the text says what it is */
        bead_markup_quote(s->stage.scene->title, title, sizeof title);
    struct bead_graph graph = {.title = *title ? title : NULL,
                               .caption = s->output.caption && *s->output.caption ? s->output.caption : NULL,
                               .panels = panels,
                               .panel_count = chains,
                               .letters = chains > 1,
                               .share_y = true};
    if (!err)
        err = bead_graph_write(&graph, &s->output, s->stage.scene, s->path, &s->bytes, msg);
    free(series);
    free(panels);
    free(label);
    return err;
}

static void result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

static const char *const extensions[] = {"png", "pdf", "svg", NULL};

const struct bead_sink_type bead_profiles_plot_sink = {
    .name = "plot of profiles",
    .help = "a field along the chain at several times: png, pdf, svg",
    .kind = BEAD_OUTPUT_PLOT,
    .shows = 1 << BEAD_SHOW_PROFILES,
    .extensions = extensions,
    .create = create,
    .needs = needs,
    .begin = begin,
    .sample = sample,
    .end = end,
    .destroy = destroy,
    .result = result,
};
