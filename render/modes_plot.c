/* Sink for `plot:` outputs with `show: modes`: the energies of the first few modes against time, a panel for each chain. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "render/graph.h"
#include "render/markup.h"
#include "render/sinks.h"

/* Times of a curve where the scene does not say how often; more cannot be seen. */
static const double most_times = 4000;

struct bead_sink {
    struct bead_output output;
    struct bead_stage stage;
    struct bead_grid grid;
    size_t modes, count, taken; /* count: times; taken: of the chain that comes last */
    double *time;               /* [count] */
    double *energy;             /* [chains][modes][count] */
    char *path;
    char why[96];
    uint64_t bytes;
};

static void destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    free(sink->time);
    free(sink->energy);
    free(sink->path);
    free(sink);
}

/* As often as asked, or as can be seen; of samples at given times, those. */
static struct bead_grid choose_grid(const struct bead_output *output, const struct bead_stage *stage)
{
    const struct bead_grid *native = &stage->native;
    double from = isnan(output->time[0]) ? 0 : output->time[0];
    double to = isnan(output->time[1]) ? stage->end : fmin(output->time[1], stage->end);
    if (native->every > 0) {
        double first = fmax(0, ceil((from - native->start) / native->every - 1e-6));
        double stride = output->every > 0 ? fmax(1, round(output->every / native->every)) : 1;
        return (struct bead_grid){native->start + first * native->every, stride * native->every, fmin(to, native->end)};
    }
    double every = output->every > 0 ? output->every : fmax(stage->resolution, (to - from) / most_times);
    return (struct bead_grid){from, every, to};
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
    s->modes = output->modes;
    s->grid = choose_grid(output, stage);
    s->count = bead_grid_count(&s->grid);
    enum bead_error err = bead_file_join(stage->directory, output->path, &s->path, msg);
    if (!err && (s->count < 2 || s->count > (size_t)1 << 22))
        err = bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: every: %g gives %zu times; a plot shows from 2 to 4194304",
                        stage->scene->file, output->place.line, output->place.column, s->grid.every, s->count);
    if (!err) {
        s->time = calloc(s->count, sizeof *s->time);
        s->energy = calloc(s->count * s->modes * stage->chain_count, sizeof *s->energy);
        err = s->time && s->energy ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %zu times of modes", s->count);
    }
    snprintf(s->why, sizeof s->why, "energies of %zu modes at %zu times", s->modes, s->count);
    if (err)
        destroy(s);
    else
        *made = s;
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.beads = {0, SIZE_MAX}, .grid = sink->grid, .until = sink->grid.end, .why = sink->why};
    for (size_t c = 0; c < sink->stage.chain_count; c++)
        needs->fields |= bead_chain_mode_fields(sink->stage.chains[c]);
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    double energy[BEAD_MODES];
    if (sample->index >= s->count)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: there are more samples than expected", s->path);
    bead_chain_mode_energies(s->stage.chains[sample->chain], sample->field, s->modes, energy);
    for (size_t k = 0; k < s->modes; k++)
        s->energy[(sample->chain * s->modes + k) * s->count + sample->index] = energy[k];
    s->time[sample->index] = sample->time;
    s->taken = sample->index + 1;
    return BEAD_OK;
}

/* A logarithmic axis goes six powers of ten down from the highest. */
static double lowest(const struct bead_sink *s)
{
    double most = 0;
    for (size_t i = 0; i < s->count * s->modes * s->stage.chain_count; i++)
        most = fmax(most, s->energy[i]);
    return s->output.scale == BEAD_SCALE_LOG && most > 0 ? 1e-6 * most : NAN;
}

static enum bead_error end(struct bead_sink *s, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    (void)outcomes;
    size_t chains = s->stage.chain_count;
    double low = isnan(s->output.range[0]) ? lowest(s) : s->output.range[0];
    struct bead_series *series = calloc(chains * s->modes, sizeof *series);
    struct bead_panel *panels = calloc(chains, sizeof *panels);
    char(*label)[32] = calloc(s->modes, sizeof *label);
    enum bead_error err =
        series && panels && label ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot of modes");
    for (size_t k = 0; !err && k < s->modes; k++)
        snprintf(label[k], sizeof *label, "mode %zu", k + 1);
    for (size_t c = 0; !err && c < chains; c++) {
        const struct bead_chain *chain = s->stage.chains[c];
        for (size_t k = 0; k < s->modes; k++)
            series[c * s->modes + k] = (struct bead_series){.x = s->time,
                                                            .y = s->energy + (c * s->modes + k) * s->count,
                                                            .count = s->taken,
                                                            .mark = BEAD_MARK_LINE,
                                                            .colour = k,
                                                            .label = c == 0 ? label[k] : NULL};
        panels[c] =
            (struct bead_panel){.title = *bead_chain_name(chain) ? bead_chain_name(chain) : NULL,
                                .x = {"time", bead_chain_time_unit(chain), s->grid.start, s->grid.end, BEAD_SCALE_LINEAR, false},
                                .y = {bead_chain_mode_title(chain), "", low, s->output.range[1], s->output.scale, true},
                                .series = series + c * s->modes,
                                .series_count = s->modes};
    }
    char title[2048] = "";
    if (s->output.style != BEAD_STYLE_PAPER) /* on paper the text says what it is */
        bead_markup_quote(s->stage.scene->title, title, sizeof title);
    struct bead_graph graph = {.title = *title ? title : NULL,
                               .caption = s->output.caption && *s->output.caption ? s->output.caption : NULL,
                               .panels = panels,
                               .panel_count = chains,
                               .letters = chains > 1,
                               .share_x = true,
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

const struct bead_sink_type bead_modes_plot_sink = {
    .name = "plot of modes",
    .help = "energies of modes against time: png, pdf, svg",
    .kind = BEAD_OUTPUT_PLOT,
    .shows = 1 << BEAD_SHOW_MODES,
    .extensions = extensions,
    .create = create,
    .needs = needs,
    .begin = begin,
    .sample = sample,
    .end = end,
    .destroy = destroy,
    .result = result,
};
