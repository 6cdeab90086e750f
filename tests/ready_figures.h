/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The graphs of the ready scenes, for tests of their layouts. */
#ifndef BEADREEL_TESTS_READY_FIGURES_H
#define BEADREEL_TESTS_READY_FIGURES_H

#include "beadreel/session.h"
#include "render/plot/graph_private.h"
#include "sessions.h"

/* The plots of the ready scenes, with fewer points and configurations where there are many: what the curves are called and how they
 * are told apart does not depend on these. */
static const struct ready_figure {
    const char *scene, *only[3], *settings[6];
    size_t least_pairs; /* of curves that are told apart */
} ready_figures[] = {
    {"sensors", {"sensors.png"}, {NULL}, 4},
    {"panels", {"panels.pdf"}, {NULL}, 1},
    {"fput", {"modes.png", "profiles.png"}, {NULL}, 12},
    {"fput-kdv", {"profiles.png"}, {"chains.1.points=256"}, 12},
    {"kdv", {"profiles.png"}, {"chain.points=200"}, 10},
    {"shock", {"profiles.png"}, {NULL}, 10},
    {"zabusky-kruskal", {"profiles.png", "modes.png"}, {"chain.points=160"}, 9},
    {"thesis/fig1", {"fig1.png"}, {NULL}, 10},
    {"thesis/fig5", {"fig5.png"}, {NULL}, 3},
    {"thesis/fig6", {"fig6.png"}, {NULL}, 4},
    {"thesis/fig8", {"fig8.png"}, {NULL}, 10},
    {"thesis/defect", {"defect.png"}, {NULL}, 15},
    {"sweep", {"force.png"}, {"sweep.cells=8"}, 2},
    {"thesis/fig7",
     {"fig7.png"},
     {"sweeps.0.cells=8", "sweeps.1.cells=8", "sweeps.2.cells=8", "sweeps.3.cells=50", "sweeps.3.configurations=6"},
     4},
    {"thesis/decay", {"decay.png"}, {"sweep.cells=64", "sweep.configurations=4"}, 30},
};
enum { READY_FIGURES = sizeof ready_figures / sizeof *ready_figures };

static inline void play_figure(const struct ready_figure *figure, const char *directory)
{
    struct bead_job job = {.input = figure->scene, .output = directory, .only = figure->only, .settings = figure->settings};
    while (figure->only[job.only_count])
        job.only_count++;
    while (figure->settings[job.setting_count])
        job.setting_count++;
    play_counts(job);
}

/* The layout of every graph passes through the wrapper of the test (see the Makefile), which calls the real function. */
enum bead_error __real_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg);
enum bead_error __wrap_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg);

#endif
