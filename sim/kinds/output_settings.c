/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the settings of an output or a panel by the table of its kind, completes and checks them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

enum { MOST_ON_STAGE = 4 /* chains, by default */ };

/* Values of settings for which a kind has no key. */
const struct bead_output bead_output_automatic = {.shown = {.beads = {0, SIZE_MAX}, .time = {NAN, NAN}},
                                                  .views = {.axes = true},
                                                  .colours = {.range = {NAN, NAN}},
                                                  .panel = {.chain = SIZE_MAX},
                                                  .image = {.at = NAN},
                                                  .movie = {.poster_at = NAN},
                                                  .curves = {.segment = NAN, .frequencies = {NAN, NAN}},
                                                  .plot = {.range = {NAN, NAN}}};

/* The defaults in the tables are for contacts; systems without contacts have their own. */
static void fit_without_contacts(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    const struct bead_scene *scene = reader->scene;
    unsigned known = bead_scene_fields(scene);
    if (bead_scene_system(scene)->has_contacts)
        return;
    enum bead_field shown = bead_system_shown(&scene->chains[0]);
    while (known && !(known & BEAD_FIELD_BIT(shown))) /* that all chains have */
        shown = (enum bead_field)((shown + 1) % BEAD_FIELD_COUNT);
    if (!bead_given(at, "fields"))
        output->trajectory.fields = known;
    if (!bead_given(at, "field"))
        output->shown.field = shown;
    if (!bead_given(at, "scale"))
        output->colours.scale = BEAD_SCALE_LINEAR;
    if (bead_given(at, "views") || bead_scene_has_beads(scene))
        return;
    size_t kept = 0;
    for (size_t i = 0; i < output->views.count; i++) {
        if (!(bead_views_info(&output->views, i)->traits & BEAD_SHOWS_BEADS))
            output->views.kinds[kept++] = output->views.kinds[i];
    }
    output->views.count = kept;
}

static void fit_motion(const struct bead_at *at, struct bead_output *output)
{
    if (bead_show_type(output->curves.show)->of_motion && !bead_given(at, "field") && !output->curves.contacts.all)
        output->shown.field = BEAD_FIELD_VELOCITY;
}

/* The stage is the default of films of few chains; films of images have a row of beads instead. */
static void fit_stage(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    const bool wanted = output->movie.layout == BEAD_LAYOUT_STAGE ||
                        (output->movie.layout == BEAD_LAYOUT_AUTO && reader->scene->chain_count <= MOST_ON_STAGE);
    for (size_t i = 0; i < output->views.count && !bead_given(at, "views"); i++) {
        if (output->views.kinds[i] == BEAD_VIEW_STAGE && !(wanted && bead_scene_system(reader->scene)->has_contacts))
            output->views.kinds[i] = BEAD_VIEW_BEADS;
    }
}

/* Each chain has its own panel, except in plots of peaks and if all share one; for the curves of a sweep, each place does. */
static bool side_by_side(const struct bead_reader *reader, const struct bead_output *output)
{
    const bool one = output->kind == BEAD_OUTPUT_PLOT && (output->curves.show == BEAD_SHOW_PEAKS || output->curves.overlay);
    if (reader->scene->sweep_count > 0 && bead_sweep_lines(output->sweep_curves.show) != BEAD_SHOW_COUNT)
        return output->curves.beads.count + output->curves.contacts.count > 1;
    return reader->scene->chain_count > 1 && !one;
}

/* An output without `size` has the size of its style, its panels or its kind of file. */
static enum bead_error settle_size(const struct bead_reader *reader, const struct bead_at *at, bool draws,
                                   struct bead_output *output)
{
    static const double one_column[] = {86e-3, 64e-3}, page_wide[] = {178e-3, 90e-3}, several_panels[] = {178e-3, 120e-3},
                        screen[] = {1920, 1080};
    struct bead_paper *paper = &output->paper;
    const char *dot = output->path ? strrchr(output->path, '.') : NULL;
    bool vector = dot && (strcasecmp(dot, ".pdf") == 0 || strcasecmp(dot, ".svg") == 0);
    const double *size = screen;
    if (!draws || !output->path || paper->size[0] > 0)
        return BEAD_OK;
    if (paper->style == BEAD_STYLE_AUTO && vector)
        size = several_panels;
    else if (paper->style == BEAD_STYLE_PAPER)
        size = output->still.panel_count > 0 ? several_panels : side_by_side(reader, output) ? page_wide : one_column;
    paper->size_is_length = size != screen;
    const struct bead_at where = bead_at_key(at, "size");
    memcpy(paper->size, size, sizeof paper->size);
    return bead_output_check_size(reader, &where, paper);
}

enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at, const struct bead_output_type *type,
                                          struct bead_output *output)
{
    const bool sweep = reader->scene->sweep_count > 0;
    BEAD_TRY(bead_options_read(reader, at, sweep ? type->sweep_options : type->options, output));
    if (reader->unsound)
        return BEAD_OK;
    BEAD_TRY(settle_size(reader, at, type->draws, output));
    if (sweep && bead_sweep_lines(output->sweep_curves.show) != BEAD_SHOW_COUNT)
        output->curves.show = bead_sweep_lines(output->sweep_curves.show);
    fit_stage(reader, at, output);
    fit_without_contacts(reader, at, output);
    fit_motion(at, output);
    if (sweep)
        return type->check_sweep ? type->check_sweep(reader, at, output) : BEAD_OK;
    for (size_t i = 0; i < BEAD_OUTPUT_CHECKS && type->checks[i]; i++)
        BEAD_TRY(type->checks[i](reader, at, output));
    return BEAD_OK;
}

void bead_output_free(struct bead_output *output)
{
    for (size_t i = 0; i < output->still.panel_count; i++)
        bead_output_free(&output->still.panels[i]);
    free(output->still.panels);
    free(output->still.caption);
    free(output->panel.title);
    free(output->path);
    free(output->colours.colormap);
    free(output->paper.font);
    free(output->sweep_curves.threshold);
    free(output->sweep_curves.against);
    free(output->sweep_curves.measure);
    free(output->sheet.magnetism);
    free(output->trajectory.xdmf);
    for (size_t i = 0; i < output->curves.measured_count; i++)
        free(output->curves.measured[i].points);
    free(output->curves.measured);
    free(output->curves.beads.all);
    free(output->curves.contacts.all);
    bead_output_free_movie(output);
}
