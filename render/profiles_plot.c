/* Sink for `plot:` outputs with `show: profiles`: a field along the chain at several times, a panel for each chain. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "beadreel/look.h"
#include "render/graph.h"
#include "render/markup.h"
#include "render/sinks.h"
#include "render/units.h"

struct profile {
    double *before, *after; /* the samples on both sides of the moment */
    double before_time, after_time;
    bool complete;
};

struct bead_sink {
    struct bead_output output;
    struct bead_stage stage;
    struct bead_grid grid;
    struct profile *profiles; /* [chains][moments] */
    double **places;          /* [chains][values] along the chain */
    char *path;
    char why[96];
    uint64_t bytes;
};

static size_t values_of(const struct bead_sink *s, size_t chain)
{
    const struct bead_chain *c = s->stage.chains[chain];
    return bead_chain_field(c, s->output.field)->of_contacts ? bead_chain_contacts(c) : bead_chain_beads(c);
}

static void destroy(struct bead_sink *s)
{
    if (!s)
        return;
    for (size_t i = 0; s->profiles && i < s->stage.chain_count * s->output.moment_count; i++) {
        free(s->profiles[i].before);
        free(s->profiles[i].after);
    }
    for (size_t c = 0; s->places && c < s->stage.chain_count; c++)
        free(s->places[c]);
    free(s->profiles);
    free(s->places);
    free(s->path);
    free(s);
}

static enum bead_error reserve(struct bead_sink *s, struct bead_message *msg)
{
    size_t chains = s->stage.chain_count, moments = s->output.moment_count;
    s->profiles = calloc(chains * moments, sizeof *s->profiles);
    s->places = calloc(chains, sizeof *s->places);
    bool got = s->profiles && s->places;
    for (size_t c = 0; got && c < chains; c++) {
        const struct bead_along along =
            bead_chain_along(s->stage.chains[c], bead_chain_field(s->stage.chains[c], s->output.field)->of_contacts);
        size_t count = values_of(s, c);
        got = (s->places[c] = calloc(count, sizeof(double))) != NULL;
        for (size_t i = 0; got && i < count; i++)
            s->places[c][i] = along.first + (double)i * along.spacing;
        for (size_t m = 0; got && m < moments; m++) {
            struct profile *p = &s->profiles[c * moments + m];
            p->before = calloc(count, sizeof(double));
            p->after = calloc(count, sizeof(double));
            got = p->before && p->after;
        }
    }
    return got ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot of profiles");
}

/* Do all moments lie on this grid? */
static bool hits(const struct bead_output *output, double start, double every)
{
    for (size_t m = 0; m < output->moment_count; m++) {
        double place = (output->moments[m] - start) / every;
        if (fabs(place - round(place)) > 1e-7)
            return false;
    }
    return true;
}

/* Samples at the moments themselves, where they have a common spacing; else so close that nothing happens in between. */
static struct bead_grid choose_grid(const struct bead_output *output, const struct bead_stage *stage)
{
    enum { MOST_PARTS = 1000 };
    const struct bead_grid *native = &stage->native;
    size_t last = output->moment_count - 1;
    double from = output->moments[0], to = output->moments[last], gap = last > 0 ? output->moments[1] - from : 1;
    if (native->every > 0) {
        double first = fmax(0, floor((from - native->start) / native->every + 1e-6));
        double end = ceil((to - native->start) / native->every - 1e-6);
        return (struct bead_grid){native->start + first * native->every, native->every,
                                  fmin(native->end, native->start + end * native->every)};
    }
    for (size_t m = 1; m < last; m++)
        gap = fmin(gap, output->moments[m + 1] - output->moments[m]);
    for (int parts = 1; parts <= MOST_PARTS && gap / parts > 0; parts++) {
        if (hits(output, from, gap / parts))
            return (struct bead_grid){from, gap / parts, to};
    }
    double every = stage->resolution / 8;
    return (struct bead_grid){from, every, fmin(stage->end, from + ceil((to - from) / every) * every)};
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
    enum bead_error err = BEAD_OK;
    if (output->moments[output->moment_count - 1] > stage->end * (1 + 1e-9)) /* of a run that ends when the front arrives */
        err = bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: at: goes to %g, but the run ends at %g", stage->scene->file,
                        output->place.line, output->place.column, output->moments[output->moment_count - 1], stage->end);
    if (!err)
        err = reserve(s, msg);
    if (!err)
        err = bead_file_join(stage->directory, output->path, &s->path, msg);
    s->grid = choose_grid(output, stage);
    snprintf(s->why, sizeof s->why, "%s at %zu time%s", bead_field_info(output->field)->name, output->moment_count,
             output->moment_count == 1 ? "" : "s");
    if (err)
        destroy(s);
    else
        *made = s;
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = BEAD_FIELD_BIT(sink->output.field),
                                 .beads = {0, SIZE_MAX},
                                 .grid = sink->grid,
                                 .until = sink->grid.end,
                                 .why = sink->why};
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *values = sample->field[s->output.field];
    if (!values)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s", bead_field_info(s->output.field)->title);
    size_t count = values_of(s, sample->chain);
    double slack = 1e-6 * s->grid.every;
    for (size_t m = 0; m < s->output.moment_count; m++) {
        struct profile *p = &s->profiles[sample->chain * s->output.moment_count + m];
        bool early = sample->time <= s->output.moments[m] + slack;
        if (!early && p->complete)
            continue;
        double *to = early ? p->before : p->after;
        for (size_t i = 0; i < count; i++)
            to[i] = i < sample->active ? values[i] : 0;
        *(early ? &p->before_time : &p->after_time) = sample->time;
        p->complete = !early || fabs(sample->time - s->output.moments[m]) <= slack;
    }
    return BEAD_OK;
}

/* Between the two samples. */
static void settle(const struct bead_sink *s, struct profile *p, size_t count, double moment)
{
    double weight = p->after_time > p->before_time ? (moment - p->before_time) / (p->after_time - p->before_time) : 0;
    for (size_t i = 0; weight > 1e-6 && i < count; i++)
        p->before[i] += fmin(weight, 1) * (p->after[i] - p->before[i]);
    (void)s;
}

static void fill_panel(struct bead_sink *s, size_t c, char (*label)[64], struct bead_series *series, struct bead_panel *panel)
{
    const struct bead_chain *chain = s->stage.chains[c];
    const struct bead_field_info *field = bead_chain_field(chain, s->output.field);
    const struct bead_along along = bead_chain_along(chain, field->of_contacts);
    size_t count = values_of(s, c);
    for (size_t m = 0; m < s->output.moment_count; m++) {
        struct profile *p = &s->profiles[c * s->output.moment_count + m];
        settle(s, p, count, s->output.moments[m]);
        series[m] = (struct bead_series){.x = s->places[c],
                                         .y = p->before,
                                         .count = count,
                                         .mark = BEAD_MARK_LINE,
                                         .colour = m,
                                         .label = c == 0 ? label[m] : NULL};
    }
    *panel = (struct bead_panel){.title = *bead_chain_name(chain) ? bead_chain_name(chain) : NULL,
                                 .x = {along.title, along.unit, s->places[c][0], s->places[c][count - 1], BEAD_SCALE_LINEAR, false},
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
