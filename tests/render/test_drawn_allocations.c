/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failing allocations of what is drawn: each one fails once, in images, plots, films, sheets and reports of small scenes. What is
 * made is then the same as ever, or refused for lack of memory, with a message, and leaves no memory and no file. */
#include "tests/support.h"

#include "tests/scratch.h"

#include "beadreel/render.h"
#include "tests/allocations.h"

#define STRIKER "striker: {bead: large-steel, velocity: 0.4 m/s}, "
#define SMALL   "size: [160, 120]"
#define SHORT   "duration: 0.4 s, fps: 5, " SMALL

static const char two[] = "chains:\n"
                          "  - {name: a, " STRIKER "beads: [{bead: small-steel, count: 2}, {bead: ptfe, sensor: s}]}\n"
                          "  - {name: b, " STRIKER "beads: [{bead: small-steel, count: 3}, {bead: ptfe, sensor: t}]}\n"
                          "simulate: {until: 30 us}\n";
static const char equal[] = "chain: {" STRIKER "beads: [{bead: large-steel, count: 14}]}\nsimulate: {until: 30 us}\n";
static const char pressed[] =
    "chain: {" STRIKER
    "wall: brass, precompression: 2 N, beads: [{cell: [large-steel, aluminium], count: 4}, {bead: ptfe, sensor: s}]}\n"
    "simulate: {until: 30 us}\n";
static const char solitons[] = "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
                               "simulate: {until: 2}\n";
static const char spins[] = "sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\n";
static const char mean[] = "sweep: {cells: 2, magnetism: 0, configurations: 2}\n";
static const char keys[] = "chain: {" STRIKER "beads: [{bead: small-steel, count: 3}, {bead: small-steel, sensor: s}]}\n"
                           "sweep: {over: {chain.striker.velocity: [0.1 m/s, 1 m/s], chain.striker.mass: [2 g, 4 g]}}\n"
                           "simulate: {until: 60 us}\n";

static const struct drawn {
    const char *scene, *output;
} drawn[] = {
    {two, "movie: a.mp4, views: [beads, profile, spacetime], poster: p.png, captions: [{at: 0, text: one}], card: {for: 0.2 s, "
          "text: All}, " SHORT},
    {two, "movie: a.mp4, views: [stage, sensors], sound: contact 1, captions: [{at: 10 us, pause: 0.2 s, text: stop}], " SHORT},
    {two, "movie: a.gif, " SHORT},
    {solitons, "movie: a.mp4, views: [profile, modes], " SHORT},
    {equal, "image: a.png, theory: true, size: [300, 300]"},
    {two, "image: a.svg, axes: false, " SMALL},
    {two, "image: a.png, panels: [[{field: force}], [{show: sensors}]], size: [320, 220]"},
    {mean, "image: a.png, axes: false, " SMALL},
    {pressed, "plot: a.svg, show: setup"},
    {pressed, "plot: a.svg, show: contact"},
    {pressed, "plot: a.svg, show: cell"},
    {two, "plot: a.svg, show: sensors"},
    {two, "plot: a.svg, show: peaks"},
    {two, "plot: a.svg, show: energy"},
    {two, "plot: a.svg, show: profiles, at: [10 us, 20 us]"},
    {pressed, "plot: a.svg, show: spreading"},
    {pressed, "plot: a.svg, show: bands"},
    {pressed, "plot: a.svg, show: eigenmodes"},
    {pressed, "plot: a.svg, show: spectrum, beads: [0, 3]"},
    {pressed, "plot: a.svg, show: dispersion, every: 1 us, size: [300, 200]"},
    {pressed, "plot: a.svg, show: spectrogram, beads: 3, size: [300, 200]"},
    {pressed, "plot: a.svg, show: transfer, beads: [1, 3]"},
    {solitons, "plot: a.svg, show: modes"},
    {spins, "plot: a.svg"},
    {keys, "plot: a.svg"},
    {keys, "plot: a.svg, show: plane, size: [300, 200]"},
    {spins, "sheet: a.png"},
    {two, "report: a.html"},
    {spins, "report: a.html"},
};

static void each_of_all(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%soutputs:\n  - {%s}\n", drawn[i].scene, drawn[i].output);
        assert_true(fail_each_of_scene(text, bead_render_sinks()) > 100);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_of_all)};
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
