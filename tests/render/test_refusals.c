/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures, films and reports that cannot be made say why, with the numbers of the scene and of its run. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/render.h"
#include "beadreel/sweep.h"
#include "sessions.h"
#include "tests/pictures.h"

/* Ten beads and a striker, ten contacts: for 0.1 ms, or until the wave has passed; beside fewer; of dimers; with a sensor. */
#define BEADS "striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: "
#define SHORT "simulate: {until: 0.1 ms}\n"
static const char one[] = "chain: {" BEADS "10}]}\n" SHORT, whole[] = "chain: {" BEADS "10}]}\n",
                  two[] = "chains: [{name: a, " BEADS "10}]}, {name: b, " BEADS "5}]}]\n" SHORT,
                  cells[] = "chain: {striker: {velocity: 1 m/s}, beads: [{cell: [large-steel, ptfe], count: 9}]}\n" SHORT,
                  spins[] = "sweep: {cells: 4, magnetism: [0, 0.5], configurations: 2}\n",
                  mean[] = "sweep: {cells: 2, magnetism: 0, configurations: 2}\n",
                  sensor[] = "chain: {" BEADS "9}, {bead: ptfe, sensor: s}]}\n" SHORT;

static const struct {
    const char *scene, *output, *says;
} refused[] = {
    {whole, "image: a.png, time: [1 ms, auto]", "time: from 0.001 to 0.001 there is nothing to show; the run ends at 0.001"},
    {two, "image: a.png, beads: [8, 10]", "beads: begin at 8, but the chain has 6 beads"},
    {two, "image: a.png, beads: [8, 9], field: contact-force", "beads: begin at 8, but the chain has 5 contacts"},
    {two, "image: a.png, beads: [6, 10]", "beads: begin at 6, but the chain has 6 beads"},
    {two, "image: a.png, beads: [5, 9], field: contact-force", "beads: begin at 5, but the chain has 5 contacts"},
    {two, "image: a.png, axes: false, size: [40, 1]", "size: fewer rows (or columns) of pixels than chains"},
    {two, "image: a.png, axes: false, beads: [8, 10]", "beads: begin at 8, but the chain has 6 beads"},
    {whole, "image: a.png, axes: false, time: [1 ms, auto]",
     "time: from 0.001 to 0.001 there is nothing to show; the run ends at 0.001"},
    {two, "image: a.png, size: [60, 50]",
     "size: 60 x 50 pixels leave no room for 2 plots and their labels; use a larger picture, fewer views or `axes: false`"},
    {two, "image: a.png, size: [90, 60], panels: [[{field: force}]]",
     "size: 90 x 60 pixels leave no room for 1 panel and their labels"},
    {one, "image: a.png, size: [60, 50]", "size: 60 x 50 pixels leave no room for 1 plot and their labels; use a larger picture"},
    {one, "plot: a.png, show: peaks, size: [60, 20]", "size: 60 x 20 pixels leave no room for 1 plot and their labels"},
    {one, "image: a.png, size: [32000, 14000]", "size: is 32000 x 14000 pixels; at most 32767 a side and 300 million in all"},
    {one, "image: a.jpg, background: none",
     "background: `none` needs a file that can be transparent: .png, .tif, .webp, or vectors"},
    {one, "plot: a.png, show: setup, size: [40, 30]", "size: 40 x 30 pixels leave no room for the drawing and its labels"},
    {spins, "sheet: a.png, size: [40, 30], configurations: 2, magnetism: [0, 0.5]",
     "size: 40 x 30 pixels have no room for 2 rows of 2 pictures"},
    {spins, "sheet: a.png, size: [40, 30], configurations: 1, magnetism: [0, 0.5]",
     "size: 40 x 30 pixels have no room for 2 rows of 1 picture"},
    {mean, "sheet: a.png, size: [40, 30], configurations: 2, magnetism: [0]",
     "size: 40 x 30 pixels have no room for 1 row of 2 pictures"},
    {two, "image: a.png, size: [90, 60], panels: [[{field: force}, {field: velocity}]]",
     "size: 90 x 60 pixels leave no room for 2 panels and their labels"},
    {whole, "movie: a.mp4, captions: [{at: 0.05 ms, text: a}, {at: 2 ms, text: late}]",
     "captions.1.at: is 0.002 s; must be before the end of what is shown, at "},
    {whole, "movie: a.mp4, poster: a.png, poster-at: 2 ms", "poster-at: is 0.002 s; the movie ends at "},
    {one, "movie: a.mp4, duration: 0.01 s, fps: 10",
     "duration: a movie has 2 to 10 million frames (duration, or what `speed` and pauses make of it, times fps)"},
    {one, "movie: a.mp4, inset: cell", "inset: is cell, but no chain has a cell of two beads"},
    {cells, "movie: a.mp4, inset: cell, size: [240, 240]",
     "inset: 240 x 240 pixels have no room for a drawing of the cell beside a curve"},
    {one, "movie: a.mp4, sound: wall", "sound: no chain has a wall"},
    {two, "report: a.html, beads: [8, 10]", "beads: some chains have fewer beads"},
    {two, "report: a.html, beads: [6, 7]", "beads: some chains have fewer beads"},
    {one, "report: a.html, every: 1 ms", "every: a report needs two samples or more"},
    {sensor, "plot: a.png, show: spectrum, frequencies: [2 kHz, 1 kHz]",
     "frequencies: is [2000, 1000] Hz; the first must be before the second"},
    {sensor, "plot: a.png, show: sensors, scale: log, range: [0, 1 N]", "must be above 0 with `scale: log`"},
    {one, "image: a.png, scale: log, range: [-1, 2 N]", "range: begins at -1 N; must be above 0 with `scale: log`"},
    {one, "plot: a.png, show: peaks, scale: log, range: [auto, 0]", "must be above 0 with `scale: log`"},
    {sensor, "plot: a.png, show: profiles, theory: true, at: [0.05 ms], field: velocity",
     "theory: there is one for `field: contact-force` of equal Hertzian beads, without precompression, tilt, gaps or springs"},
};

static void what_cannot_be_drawn_says_why(void **)
{
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), bead_render_sinks(), NULL};
    char path[512], out[512];
    in_directory("scene.yaml", path, sizeof path);
    in_directory("", out, sizeof out);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        char text[1000];
        struct bead_message msg = {""};
        struct bead_session *session = NULL;
        snprintf(text, sizeof text, "%soutputs: [{%s}]\n", refused[i].scene, refused[i].output);
        write_text(path, text);
        struct bead_job job = {.size = sizeof job, .input = path, .output = out, .threads = 1, .sinks = sinks};
        enum bead_error err = bead_session_open(&job, &session, &msg);
        if (!err)
            err = bead_session_run(session, &msg);
        bead_session_close(session);
        if (err != BEAD_ERROR_SCENE || !strstr(msg.text, refused[i].says))
            fail_msg("%s: '%s', not '%s'", refused[i].output, msg.text, refused[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_cannot_be_drawn_says_why)};
    return cmocka_run_group_tests_name("refusals", tests, make_directory, remove_directory);
}
