/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: `--set` strings, one a line, applied to a scene with a bit of everything. If accepted, the scene's text, as stored
 * in files, parses again. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/scene.h"
#include "tests/fuzz/fuzz.h"

enum { SETTINGS = 16 };

static const char base[] = "materials: {light: {mass: 3.63e-9 kg, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3}}\n"
                           "chain:\n"
                           "  striker: {bead: large-steel, velocity: 0.443 m/s}\n"
                           "  damping: {coefficient: 1, exponent: 1}\n"
                           "  beads:\n"
                           "    - {cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}\n"
                           "    - {bead: small-steel, sensor: first}\n"
                           "  wall: brass\n"
                           "simulate: {until: 100 us, method: rk4, step: 0.1 us}\n"
                           "outputs:\n"
                           "  - {trajectory: run.h5, every: 5 us, fields: all}\n"
                           "  - {image: force.png, size: [320, 200], field: force}\n"
                           "  - {plot: sensors.pdf, show: sensors}\n"
                           "  - {movie: m.mp4, duration: 0.2 s, size: [160, 120], fps: 10, captions: [{at: 0, text: a}]}\n"
                           "  - {table: peaks.csv, show: peaks}\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *settings[SETTINGS];
    size_t count = 0;
    char *text = strndup((const char *)data, size), *rest = text;
    for (char *line; count < SETTINGS && (line = strsep(&rest, "\n"));)
        settings[count++] = line;
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL, *again = NULL;
    enum bead_error err = bead_scene_parse("fuzz", base, sizeof base - 1,
                                           &(struct bead_overrides){.settings = settings, .setting_count = count}, &scene, &msg);
    fuzz_result(err, &msg, scene != NULL);
    if (!err) {
        err = bead_scene_parse("again", scene->text, strlen(scene->text), NULL, &again, &msg);
        fuzz_must(!err, "the text as run parses to a scene, too");
    }
    bead_scene_free(again);
    bead_scene_free(scene);
    free(text);
    fuzz_leaks();
    return 0;
}
