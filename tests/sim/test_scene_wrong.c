/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wrong scenes, settings, and arbitrary input: one message with its place, and no crash. */
#include "scenes.h"

/* ---- wrong scenes ---- */

/* First line of a file behind `# expect: `. */
static void read_expected(const char *path, char *expected, size_t size)
{
    static const char mark[] = "# expect: ";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(expected, (int)size, file));
    fclose(file);
    assert_int_equal(strncmp(expected, mark, strlen(mark)), 0);
    memmove(expected, expected + strlen(mark), strlen(expected + strlen(mark)) + 1);
    expected[strcspn(expected, "\n")] = 0;
}

static void every_malformed_file_gets_its_message(void **state)
{
    (void)state;
    struct dirent **entries;
    int count = scandir("tests/bad", &entries, NULL, alphasort), tried = 0;
    assert_true(count > 0);
    for (int i = 0; i < count; i++) {
        char path[512], expected[1024];
        struct bead_message msg = {""};
        struct bead_scene *scene = NULL;
        const char *dot = strrchr(entries[i]->d_name, '.');
        snprintf(path, sizeof path, "tests/bad/%s", entries[i]->d_name);
        if (dot && strcmp(dot, ".yaml") == 0) {
            read_expected(path, expected, sizeof expected);
            assert_int_equal(bead_scene_load(path, NULL, &scene, &msg), BEAD_ERROR_SCENE);
            if (!strstr(msg.text, expected) || strncmp(msg.text, path, strlen(path)) != 0)
                fail_msg("%s: '%s' is not in '%s'", path, expected, msg.text);
            /* What follows from it is not told as well; one file has two faults. */
            if (strchr(msg.text, '\n') && !strstr(path, "/start-of-unknown-beads."))
                fail_msg("%s: one thing is wrong, but there is more in '%s'", path, msg.text);
            tried++;
        }
        free(entries[i]);
    }
    free(entries);
    assert_true(tried >= 30);
}

/* Values of another shape than the key's, lists that are empty or too long, names that are taken. */
static void wrong_shapes_get_their_message(void **state)
{
    (void)state;
#define SWEEP(keys)  "sweep: {cells: 4, configurations: 1, " keys "}\noutputs: [{sweep: a.h5}]\n"
#define OUTPUT(keys) BEADS "outputs: [{" keys "}]\n"
#define KDV(rest)    "chain: {equation: kdv, length: 32, start: " rest "\n"
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {BEADS "outputs: {image: a.png}\n", "outputs: is a map; must be a list such as"},
        {BEADS "outputs: []\n", "outputs: "},
        {"chains: {a: b}\n" OUTPUTS, "chains: is a map; must be "},
        {"chains: []\n" OUTPUTS, "chains: has 0 chains; must have from 1 to "},
        {"chains:\n  - {name: a, beads: [{bead: ptfe, count: 60000000}]}\n  - {name: b, beads: [{bead: ptfe, count: "
         "60000000}]}\n" OUTPUTS,
         "makes more than 100000000 beads in all"},
        {"chain: {beads: ptfe}\n" OUTPUTS, "chain.beads: is `ptfe`; must be "},
        {"chain: {beads: [{bead: ptfe, sensor: ''}]}\n" OUTPUTS, "sensor: "},
        {"chain: {beads: [{cell: [ptfe, brass], spins: 012}]}\n" OUTPUTS, "spins: "},
        {"materials: {none: {mass: 1 g, radius: 1 mm, modulus: 1 GPa, poisson: 0.3}}\n" BEADS OUTPUTS,
         "cannot be the name of a material"},
        {"materials: {m: {mass: 1e-35 g, radius: 1 mm, modulus: 1 GPa, poisson: 0.3}}\n" BEADS OUTPUTS, "materials.m.mass: "},
        {"materials: {m: {density: 1e-5 kg/m3, radius: 1e-6 mm, modulus: 1 GPa, poisson: 0.3}}\n" BEADS OUTPUTS,
         "materials.m.density: gives a mass"},
        {"materials: {m: {density: 1000 kg/m3, radius: 1 mm, modulus: 1 GPa, poisson: 0.3, colour: \"#12345g\"}}\n" BEADS OUTPUTS,
         "colour: "},
        {KDV("{solitons: 3}}") "simulate: {until: 1}\n" OUTPUTS, "solitons: is `3`; must be "},
        {KDV("{solitons: []}}") "simulate: {until: 1}\n" OUTPUTS, "solitons: has 0 solitons; must have from 1 to "},
        {KDV("{}}") "simulate: {until: 1}\n" OUTPUTS, "start: is none of those known here; must be a map with one of the keys"},
        {KDV("7}") "simulate: {until: 1}\n" OUTPUTS, "start: is `7`; must be a map with one of the keys"},
        {KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1, method: verlet}\n" OUTPUTS,
         "`verlet` does not solve the equation kdv"},
        {OUTPUT("image: a.png, size: large"), "size: is `large`; must be "},
        {OUTPUT("image: a.png, size: [30000, 30000]"), "size: is "},
        {OUTPUT("image: a.png, range: 3"), "range: is `3`; must be "},
        {OUTPUT("image: a.png, range: [1 N, 2 N, 3 N]"), "range: "},
        {OUTPUT("image: a.png, time: 3"), "time: is `3`; must be [a, b]"},
        {OUTPUT("image: a.png, beads: [1, 2, 3]"), "beads: is a list; must be "},
        {OUTPUT("image: a.png, panels: [3]"), "panels.0: "},
        {OUTPUT("image: a.png, panels: [[3]]"), "is `3`; must be a map such as {field: force}"},
        {OUTPUT("image: a.png, panels: [[]]"), "panels.0: "},
        {OUTPUT("table: a.csv, field: force, show: profiles, at: 3 us"), "at: is `3 us`; must be a list of 1 to "},
        {OUTPUT("table: a.csv, field: force, show: profiles, at: []"), "at: "},
        {BEADS "simulate: {until: 1 ms}\n"
               "outputs: [{movie: a.mp4, captions: []}]\n",
         "captions: "},
        {KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1}\noutputs: [{movie: a.mp4, views: [beads]}]\n",
         "views: the equation has no beads to show"},
        {"chain: {equation: fput, points: 31, start: {mode: 1}}\nsimulate: {until: 10}\noutputs: [{plot: a.svg, show: setup}]\n",
         "draws beads, but there are none"},
        {SWEEP("magnetism: []"), "magnetism: is an empty list"},
        {SWEEP("spins: 1101"), "spins: is `1101`; must be a list such as"},
        {SWEEP("spins: []"), "spins: is an empty list; must be a list such as"},
        {SWEEP("spins: [\"1121\"]"), "spins.0: is `1121`; must be digits 0 and 1"},
        {SWEEP("measure: {beads: 3}"), "beads: is `3`; must be "},
        {SWEEP("measure: {beads: [4, 2]}"), "is [4, 2]; the first must not be greater than the last"},
        {SWEEP("measure: {sensor: []}"), "has 0 names; must have from 1 to "},
        {SWEEP("measure: {sensor: [a, a]}"), "`a` is in the list twice"},
        {SWEEP("measure: {sensor: a, beads: [1, 2]}"), "is given beside `sensor`; give one of them"},
        {SWEEP("measure: {peak: none}"), "leaves nothing to measure"},
        {"sweeps: {name: a}\noutputs: [{sweep: a.h5}]\n", "sweeps: is a map; must be "},
        {"sweeps: []\noutputs: [{sweep: a.h5}]\n", "has 0 sweeps; must have from 1 to "},
        {"sweep: {cells: 4, configurations: 1, measure: {peak: none, decay: true}}\noutputs: [{table: a.csv, show: magnetism}]\n",
         "peaks are not measured (measure: {peak: none}); must be decay"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuse(cases[i].text, cases[i].expected);
    char *text = malloc(70000);
    assert_non_null(text);
    snprintf(text, 70000, "title: \"%066000d\"\n%s", 1, BEADS OUTPUTS);
    refuse(text, "title: is too long: at most ");
    free(text);
}

/* What is just allowed, and what is just refused, and each of several reasons for which a scene is. */
static void limits_are_exact(void **state)
{
    (void)state;
#define MOVIE(keys)           BEADS "simulate: {until: 1 ms}\noutputs: [{movie: a.mp4, " keys "}]\n"
#define IMAGE(keys)           BEADS "outputs: [{image: a.png, " keys "}]\n"
#define VARY(disorder)        "chain: {beads: [{bead: brass, count: 3, disorder: {" disorder ", seed: 1}}]}\n" OUTPUTS
#define OVER(text)            "chain: {beads: [{bead: brass, count: 50}]}\nsweep: {over: {" text "}}\noutputs: [{table: a.csv}]\n"
#define OVER_TO(text, output) "chain: {beads: [{bead: brass, count: 50}]}\nsweep: {over: {" text "}}\noutputs: [{" output "}]\n"
#define START(start)          "chain: {start: [" start "], beads: [{bead: brass, count: 5}]}\nsimulate: {until: 1 ms}\n" OUTPUTS
#define DRIVE(points) \
    "chain: {drive: {force: " points ", amplitude: 1 N}, beads: [{bead: brass, count: 5}]}\nsimulate: {until: 1 ms}\n" OUTPUTS
#define PAIR       "chains: [{name: a, beads: [{bead: brass}]}, {name: b, beads: [{bead: brass}]}]\nsimulate: {until: 1 ms}\n"
#define WAVE(keys) KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1}\noutputs: [{movie: a.mp4, " keys "}]\n"
#define STRUCK     "chain: {striker: {velocity: 1 m/s}, beads: [{bead: large-steel, count: 9}]}\n"
#define PLANE(of)  of "\noutputs: [{plot: a.png, show: plane}]\n"
#define LONG       "0.9000000000000000000000000000000000000000000000000000000000000"
    static const struct {
        const char *good, *bad, *expected;
    } cases[] = {
        {PLANE("sweeps: [{name: a, cells: 4, magnetism: all}, {name: b, cells: 6, magnetism: all}]"),
         PLANE("sweeps: [{name: a, cells: 4, magnetism: all}, {name: b, cells: 4, magnetism: all}]"),
         "it needs `sweeps` with different"},
        {NULL, PLANE("sweeps: [{name: a, cells: 4, magnetism: 0}, {name: b, cells: 6, magnetism: 0}]"),
         "it needs `sweeps` with different"},
        {PLANE(STRUCK "sweep: {over: {chain.striker.velocity: [1 m/s, 2 m/s], chain.striker.mass: [1 g, 2 g]}}"),
         PLANE(STRUCK "sweep: {over: {chain.striker.velocity: [1 m/s, 2 m/s], chain.striker.mass: [1 g, 2 g]}, combine: pairs}"),
         "`over` must be a grid of two keys"},
        {MOVIE("inset: cell"), MOVIE("views: [profile], inset: cell"), "inset: is cell, but"},
        {NULL, MOVIE("axes: false, inset: cell"), "inset: is cell, but"},
        {WAVE("inset: none"), WAVE("inset: cell"), "inset: is cell, but"},
        {MOVIE("notes: [{at: 0.1 ms, text: a, bead: 1}]"), MOVIE("views: [profile], notes: [{at: 0.1 ms, text: a, bead: 1}]"),
         "notes: are given, but"},
        {NULL, MOVIE("axes: false, notes: [{at: 0.1 ms, text: a, bead: 1}]"), "notes: are given, but"},
        {MOVIE("notes: [{at: 0.9999 ms, text: a, bead: 1}]"), MOVIE("notes: [{at: 1 ms, text: a, bead: 1}]"),
         "must be before the end of what is shown"},
        {PAIR "outputs: [{movie: a.mp4, race: true}]\n", MOVIE("race: true"), "race: is true, but a race needs"},
        {NULL, PAIR "outputs: [{movie: a.mp4, views: [profile], race: true}]\n", "race: is true, but a race needs"},
        {MOVIE("time: [0.1 ms, 1 ms], stops: [0.1 ms, 0.9999 ms]"), MOVIE("stops: [1 ms]"), "stops: has 0.001; must be times"},
        {NULL, MOVIE("time: [0.1 ms, 1 ms], stops: [0.09 ms]"), "stops: has 9e-05; must be times"},
        {MOVIE("poster: p.png, poster-at: 1 ms"), MOVIE("poster: p.png, poster-at: 1.001 ms"), "poster-at: is 0.001001 s; must be"},
        {MOVIE("time: [0.1 ms, 1 ms], poster: p.png, poster-at: 0.1 ms"),
         MOVIE("time: [0.1 ms, 1 ms], poster: p.png, poster-at: 0.09 ms"), "poster-at: is 9e-05 s; must be"},
        {NULL, MOVIE("poster-at: 0.1 ms"), "poster-at: is given, but no `poster`"},
        {MOVIE("views: [spacetime, profile], layout: beside"), MOVIE("views: [spacetime], layout: beside"), "layout: is beside"},
        {NULL, MOVIE("views: [stage, profile], layout: beside"), "layout: is beside"},
        {IMAGE("size: [32768, 15258]"), IMAGE("size: [32768, 15259]"), "size: is 32768 x 15259 pixels; must be"},
        {IMAGE("size: [1, 1]"), IMAGE("size: [32769, 1]"), "size.0: `32769`"},
        {IMAGE("theory: true"), IMAGE("axes: false, theory: true"), "theory: is set, but `axes: false`"},
        {IMAGE("trust: true"), IMAGE("axes: false, trust: true"), "trust: is set, but `axes: false`"},
        {VARY("radius: normal 30 %"), VARY("radius: normal 30.1 %"), "radius: is `normal 30.1 %`; must be"},
        {VARY("radius: uniform 2..4 mm"), VARY("radius: uniform 4..2 mm"), "radius: is `uniform 4..2 mm`; must be"},
        {VARY("radius: uniform 0.9..0.9"), VARY("radius: uniform 0.9 mm..1"), "radius: is "},
        {VARY("radius: uniform 1e-3..1"), VARY("radius: uniform 0..1"), "radius: is `uniform 0..1`; must be"},
        {VARY("gap: uniform 0 mm..1 mm"), VARY("gap: uniform -1 mm..1 mm"), "gap: is `uniform -1 mm..1 mm`; must be"},
        {VARY("radius: uniform " LONG "..1"), VARY("radius: uniform " LONG "0..1"), "radius: is "},
        {OVER("chain.beads.0.count: 1..100000"), OVER("chain.beads.0.count: 1..100001"), "chain.beads.0.count: "},
        {SWEEP("measure: {beads: [1, 30]}"), SWEEP("measure: {beads: [1, 31]}"), "reaches to bead 39; the chain ends with bead 38"},
        {"chain: {equation: fput, points: 31, start: {mode: 1}}\nsimulate: {until: 60}\noutputs: [{table: a.csv, show: "
         "measures}]\n",
         "chain: {equation: fput, points: 31, start: {mode: 1}}\nsimulate: {until: -1}\noutputs: [{table: a.csv, show: "
         "measures}]\n",
         "until: `-1` is out of range"},
        {"simulate: {accuracy: statistical}\nsweep: {cells: 4}\noutputs: [{sweep: a.h5}]\n",
         "simulate: {accuracy: statistical, step: 1 us}\nsweep: {cells: 4}\noutputs: [{sweep: a.h5}]\n", "is for sweeps without"},
        {"simulate: {verify: true}\n" BEADS OUTPUTS, "simulate: {verify: true, step: 1 us}\n" BEADS OUTPUTS, "verify: chooses the"},
        {"sweep: {cells: 197, configurations: 1000000, magnetism: [0]}\noutputs: [{sweep: a.h5}]\n", /* 200 numbers of each */
         "sweep: {cells: 198, configurations: 1000000, magnetism: [0]}\noutputs: [{sweep: a.h5}]\n",
         "has 1000000 configurations of 3 results and 198 spins, which is too much"},
        {"chain: {beads: [{cell: [\"2 ptfe\", \"199998 ptfe\"]}]}\n" OUTPUTS,
         "chain: {beads: [{cell: [\"2 ptfe\", \"199999 ptfe\"]}]}\n" OUTPUTS, "makes 200001 beads of a cell; at most 200000"},
        {MOVIE("views: [stage, profile], layout: stage"), MOVIE("views: [profile], layout: stage"), "layout: is stage, but"},
        {MOVIE("views: [stage, profile], layout: overlay"), MOVIE("views: [stage, profile], follow: front, layout: overlay"),
         "layout: is overlay, but with `follow: front`"},
        {NULL, MOVIE("views: [stage], layout: overlay"), "layout: is overlay, but `views` has no profile"},
        {NULL, MOVIE("notes: [{at: 0.1 ms, text: a, bead: 2}]"), "bead: is 2, but the last bead is 1"},
        {MOVIE("notes: [{at: 0.1 ms, text: a, contact: 0}]"), MOVIE("notes: [{at: 0.1 ms, text: a, contact: 1}]"),
         "contact: is 1, but the last contact is 0"},
        {NULL, MOVIE("slides: s.html, poster: p.png"), "slides: are given beside `poster`"},
        {"sweep: {cells: 4}\noutputs: [{report: r.html}]\n", OVER_TO("chain.beads.0.count: 2..3", "report: r.html"),
         "report: shows points by magnetism"},
        {NULL, "sweep: {cells: 4, measure: {peak: none, decay: true}}\noutputs: [{report: r.html}]\n", "report: shows peaks, and"},
        {OVER_TO("chain.beads.0.count: 2..3", "plot: a.pdf, scale: log"),
         "sweep: {cells: 4}\noutputs: [{plot: a.pdf, scale: log}]\n", "scale: is given, but the sweep is over spins"},
        {NULL, OVER_TO("chain.beads.0.count: 2..3", "plot: a.pdf, show: decay"), "show: decay is fitted for each magnetism"},
        {NULL, "sweep: {cells: 4}\noutputs: [{plot: a.pdf, show: spreading}]\n", "show: spreading is averaged over the seeds"},
        {NULL, OVER_TO("chain.beads.0.count: 2..3", "plot: a.pdf, show: spreading"),
         "show: is spreading, of chains that run as long"},
        {NULL, "sweep: {cells: 4}\noutputs: [{table: a.csv, uncertainty: false}]\n", "uncertainty: is false, but a sweep"},
        {NULL, "sweep: {cells: 4}\noutputs: [{table: a.csv, show: decay}]\n", "show: decay is not measured"},
        {OUTPUT("trajectory: a.h5, xdmf: true"), OUTPUT("trajectory: 'a:b.h5', xdmf: true"),
         "xdmf: cannot name a file with a colon"},
        {NULL, OUTPUT("trajectory: a.h5, fields: [force], xdmf: true"), "xdmf: tells where beads are: add displacement"},
        {NULL, KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1}\noutputs: [{trajectory: a.h5, xdmf: true}]\n",
         "xdmf: tells where beads are, but there are none"},
        {OUTPUT("table: a.csv, show: sensors, beads: [0..1]"), OUTPUT("table: a.csv, show: sensors, beads: [1..0]"),
         "must rise from one number to another"},
        {NULL, KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1}\noutputs: [{table: a.csv, show: sensors, contacts: [1]}]\n",
         "contacts: are between beads, which equations do not have"},
        {START("{bead: [2, 3], velocity: 1}"), START("{bead: [3, 2], velocity: 1}"), "is [3, 2]; the first must not be greater"},
        {START("{bead: 0, velocity: 1}"),
         "chain: {striker: {velocity: 1}, start: [{bead: 0, velocity: 1}], beads: [{bead: brass}]}\n"
         "simulate: {until: 1 ms}\n" OUTPUTS,
         "gives the velocity of bead 0, the striker"},
        {NULL, KDV("{cosine: 1, amplitude: 1}}") "simulate: {until: 1, verify: true}\noutputs: [{table: a.csv, show: measures}]\n",
         "verify: is about the peaks of contacts"},
        {NULL,
         "chain: {beads: [{bead: brass, count: 9}]}\nsweep: {over: {chain.beads.0.count: 2..3}, measure: {decay: true}}\n"
         "outputs: [{table: a.csv}]\n",
         "decay: is one of spins, by magnetism"},
        {NULL,
         "chain: {beads: [{bead: brass, count: 9}]}\nsweeps: [{name: a, over: {chain.beads.0.count: 2..3}}, {name: b, over: "
         "{chain.beads.0.count: 2..3}}]\noutputs: [{table: "
         "a.csv}]\n",
         "belongs to `sweep`, of which a scene has one"},
        {NULL, OVER(""), "must be a map of one to eight keys"},
        {NULL, OVER("chain.beads.0.count: []"), "chain.beads.0.count: is an empty list; must be "},
        {DRIVE("'0 0, 1e-4 1'"), DRIVE("'0 0, 1e-4'"), "point 2 is not `time value`"},
        {NULL, DRIVE("'0 0'"), "must be"},
        {NULL, DRIVE("'0 0, 0 1'"), "point 2, at 0 s, is not later than the one before"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (cases[i].good) {
            struct bead_scene *scene = parse(cases[i].good);
            assert_null(scene->doubts);
            bead_scene_free(scene);
        }
        refuse(cases[i].bad, cases[i].expected);
    }
}

static void near_misses_are_suggested(void **state)
{
    (void)state;
    refuse("chain: {sriker: {}, beads: [{bead: ptfe}]}\n" OUTPUTS, "chain.sriker: unknown key; did you mean `striker`?");
    refuse("chain: {beads: [{baed: ptfe}]}\n" OUTPUTS, "test:1:18: chain.beads.0.baed: unknown key; did you mean `bead`?");
    refuse(BEADS "output: [{table: a.csv}]\n", "output: unknown key; did you mean `outputs`?");
    refuse("chain: {beads: [{bead: aluminum}]}\n" OUTPUTS, "did you mean `aluminium`?");
    refuse("chain: {beads: [{cell: [ptfe, aluminum]}]}\n" OUTPUTS,
           "cell.1: there is no material `aluminum`; did you mean `aluminium`?");
    refuse("chain: {beads: [{cell: [2000000 ptfe]}]}\n" OUTPUTS, "cell.0: there is no material `2000000 ptfe`");
    refuse(BEADS "outputs: [{movie: a.mp4, views: [bead]}]\n", "did you mean `beads`?");
    refuse("simulate: {methd: rk4}\n" BEADS OUTPUTS, "did you mean `method`?");
}

static void files_that_cannot_be_read(void **state)
{
    (void)state;
    struct bead_scene *scene = NULL;
    struct bead_message msg = {""};
    assert_int_equal(bead_scene_load("tests/none.yaml", NULL, &scene, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "tests/none.yaml"));
    assert_int_equal(bead_scene_load("tests", NULL, &scene, &msg), BEAD_ERROR_IO);
    assert_int_equal(bead_scene_load("/dev/zero", NULL, &scene, &msg), BEAD_ERROR_SCENE);
    assert_null(scene);
}

/* ---- settings ---- */

static void settings_change_the_scene(void **state)
{
    (void)state;
    static const char text[] = "chain:\n  beads: [{bead: large-steel, count: 10}]\n"
                               "outputs:\n  - {image: pictures/a.b.png, size: [1, 1]}\n  - {table: peaks.csv}\n";
    const char *const settings[] = {"simulate.step=0.1 us",
                                    "chain.striker.velocity=1 m/s",
                                    "outputs.0.size=[640, 360]",
                                    "outputs.pictures/a.b.png.scale=sqrt",
                                    "outputs.peaks.csv.show=bead-peaks",
                                    "chain.beads.0.count=20",
                                    "materials.x={mass: 1 g, radius: 1 mm, modulus: 1 GPa, poisson: 0.3}",
                                    "materials.x.colour=#0000ff",
                                    "chain.beads.+={bead: x, sensor: s}",
                                    "chain.wall=rigid",
                                    "title=\"#1: a, b\"",
                                    "chain.beads.s.sensor=t"};
    size_t count = sizeof settings / sizeof *settings;
    struct bead_scene *scene = parse_with(text, settings, count);
    assert_true(scene->simulate.step == 1e-7 && scene->chains[0].striker_velocity == 1);
    assert_true(scene->outputs[0].paper.size[0] == 640 && scene->outputs[0].paper.size[1] == 360);
    assert_int_equal(scene->outputs[0].colours.scale, BEAD_SCALE_SQRT);
    assert_int_equal(scene->outputs[1].curves.show, BEAD_SHOW_BEAD_PEAKS);
    assert_int_equal(scene->chains[0].segments[0].count, 20);
    assert_string_equal(scene->chains[0].segments[1].sensor, "t");
    assert_int_equal(scene->chains[0].wall, BEAD_WALL_RIGID);
    assert_string_equal(scene->title, "#1: a, b");
    assert_true(material_of(scene, "x")->colour[2] == 1);
    /* Its text is the whole scene as run. */
    struct bead_scene *again = parse(scene->text);
    assert_true(again->simulate.step == 1e-7 && again->chains[0].striker_velocity == 1 && again->outputs[0].paper.size[0] == 640);
    assert_int_equal(again->chains[0].segment_count, 2);
    assert_string_equal(again->title, "#1: a, b");
    /* And a fixed point: nothing changes when it is written once more. */
    struct bead_scene *third = parse_with(again->text, (const char *const[]){"simulate.step=0.1 us"}, 1);
    assert_string_equal(third->text, scene->text);
    bead_scene_free(third);
    bead_scene_free(again);
    bead_scene_free(scene);
}

static void settings_under_an_alias_change_one_place(void **state)
{
    (void)state;
    struct bead_scene *scene =
        parse_with("chains:\n  - {name: a, beads: &b [{bead: ptfe, count: 3}]}\n  - {name: b.c, beads: *b}\n" OUTPUTS,
                   (const char *const[]){"chains.b.c.beads.0.count=5"}, 1);
    assert_int_equal(scene->chains[0].segments[0].count, 3);
    assert_int_equal(scene->chains[1].segments[0].count, 5);
    bead_scene_free(scene);
}

/* Outputs of every kind are called by their file. */
static void settings_name_files_of_every_kind(void **state)
{
    (void)state;
    static const char runs[] =
        BEADS "outputs: [{trajectory: a.h5}, {image: a.png}, {movie: a.mp4}, {plot: a.pdf, show: peaks}, {table: a.csv}]\n";
    static const char *const of_runs[] = {"outputs.a.h5.every=1 us", "outputs.a.png.scale=log", "outputs.a.mp4.fps=25",
                                          "outputs.a.pdf.scale=log", "outputs.a.csv.show=bead-peaks"};
    static const char sweep[] = "sweep: {cells: 4, configurations: 3}\n"
                                "outputs: [{sweep: a.h5}, {sheet: sheet.png}, {plot: a.pdf}, {table: a.csv}]\n";
    static const char *const of_sweeps[] = {"outputs.sheet.png.configurations=3", "outputs.a.h5.sweep=b.h5",
                                            "outputs.a.pdf.show=mean", "outputs.a.csv.show=configurations"};
    struct bead_scene *scene = parse_with(runs, of_runs, sizeof of_runs / sizeof *of_runs);
    assert_true(scene->outputs[0].shown.every == 1e-6 && scene->outputs[2].movie.fps == 25);
    bead_scene_free(scene);
    scene = parse_with(sweep, of_sweeps, sizeof of_sweeps / sizeof *of_sweeps);
    assert_string_equal(scene->outputs[0].path, "b.h5");
    assert_int_equal(scene->outputs[1].sheet.configurations, 3);
    assert_int_equal(scene->outputs[2].sweep_curves.show, BEAD_SWEEP_MEAN);
    bead_scene_free(scene);
}

static void wrong_settings_name_their_place(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *expected;
    } cases[] = {{"simulate.stepp=1 us", "--set:2:10: simulate.stepp: unknown key; did you mean `step`?"},
                 {"simulate.step=1 N", "--set:2:15: simulate.step: `1 N` is not in a unit of s"},
                 {"chain.beads.0.count=0", "--set:2:21: chain.beads.0.count: `0` is out of range"},
                 {"outputs.7.size=[1, 0]", "--set:2:9: outputs.7.size: the list has no element 7"},
                 {"outputs.a.png.size=1", "--set:2:9: outputs.a.png.size: no element of the list has this name"},
                 {"chain.wall.x=1", "--set:2:12: chain.wall.x: the key before it holds a single value"},
                 {"chain.=1", "--set:2:7: "},
                 {"=1", "--set:2:1: "},
                 {"chain", "--set:2:1: `chain` is not of the form key.path=value"},
                 {"chain.wall=", "--set:2:12: chain.wall: is nothing"},
                 {"chain.wall=[", "--set:2:"},
                 {"chain.wall=*a", "--set:2:12: this alias has no anchor before it"},
                 {"outputs=[{table: b.xls}]", "--set:2:18: outputs.0.table: `b.xls`"},
                 {"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v.w.x.y.z.a.b.c.d.e.f.g.h.i=1", "nested too deeply"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuse_with("chain: {wall: brass, beads: [{bead: ptfe}]}\n" OUTPUTS, (const char *const[]){"title=x", cases[i].setting}, 2,
                    cases[i].expected);
}

/* ---- several things ---- */

static void all_that_is_wrong_is_told_at_once(void **state)
{
    (void)state;
    static const char text[] =
        "materials: {x: {modulus: 1 GPs, poisson: 0.3, radius: 1 mm, mass: 1 g}}\n"
        "chain:\n"
        "  beads: [{bead: x}, {bead: brss, count: 0}]\n"
        "  walll: brass\n"
        "simulate: {until: 3 kg}\n"
        "outputs: [{image: a.png, views: [bedas], beads: [0, 9]}, {movie: m.xyz}, {table: c.csv, show: x}]\n",
                      *const expected[] = {
                          "test:1:26: materials.x.modulus: `1 GPs`", "test:3:29: chain.beads.1.bead: there is no material `brss`",
                          "test:3:42: chain.beads.1.count: `0`",     "test:4:3: chain.walll: unknown key; did you mean `wall`?",
                          "test:5:19: simulate.until: `3 kg`",       "test:6:34: outputs.0.views.0: is `bedas`",
                          "test:6:66: outputs.1.movie: `m.xyz`",     "test:6:95: outputs.2.show: is `x`"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        refuse(text, expected[i]);
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    assert_int_equal(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), BEAD_ERROR_SCENE);
    size_t breaks = 0;
    for (const char *c = msg.text; *c; c++)
        breaks += *c == '\n';
    assert_int_equal(breaks + 1, sizeof expected / sizeof *expected); /* and nothing that only follows from these */
}

static void no_more_than_ten_things(void **state)
{
    (void)state;
    char text[2000] = "chain: {beads: [";
    for (int i = 0; i < 30; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "{bead: none%d}, ", i);
    snprintf(text + strlen(text), sizeof text - strlen(text), "]}\n" OUTPUTS);
    refuse(text, "none9");
}

/* ---- anything at all ---- */

/* Read whatever it is: a scene, or why not. */
static void survive(const char *text, size_t length)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_scene_parse("test", text, length, NULL, &scene, &msg);
    assert_true(err ? !scene && msg.text[0] && is_list_of_faults(msg.text) : scene != NULL);
    bead_scene_free(scene);
}

static void cut_scenes_are_survived(void **state)
{
    (void)state;
    struct bead_scene *scene = load_ready("imagesc");
    size_t length = strlen(scene->text);
    for (size_t i = 0; i < length; i += 7) {
        char *cut = strndup(scene->text, i); /* no byte more, so that sanitizers see reads beyond */
        assert_non_null(cut);
        survive(cut, i);
        free(cut);
    }
    bead_scene_free(scene);
}

static void changed_scenes_are_survived(void **state)
{
    (void)state;
    static const char strange[] = "{}[]:,-#&*!|>'\"%@`\n\t \\01e.9\x80\xff";
    struct bead_scene *scene = load_ready("clean-vs-delocalised");
    size_t length = strlen(scene->text);
    uint64_t random = 2009;
    for (int round = 0; round < 300; round++) {
        char *changed = strdup(scene->text);
        assert_non_null(changed);
        for (int i = 0; i < 1 + round % 5; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            changed[(random >> 33) % length] = strange[(random >> 13) % (sizeof strange - 1)];
        }
        survive(changed, length);
        free(changed);
    }
    bead_scene_free(scene);
}

static void noise_is_survived(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int round = 0; round < 200; round++) {
        char noise[300];
        for (size_t i = 0; i < sizeof noise; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            noise[i] = round % 2 ? (char)(random >> 56) : " \n:-[]{}ab1,&*"[(random >> 40) % 14];
        }
        survive(noise, sizeof noise);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_malformed_file_gets_its_message),
        cmocka_unit_test(wrong_shapes_get_their_message),
        cmocka_unit_test(limits_are_exact),
        cmocka_unit_test(near_misses_are_suggested),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(settings_change_the_scene),
        cmocka_unit_test(settings_under_an_alias_change_one_place),
        cmocka_unit_test(settings_name_files_of_every_kind),
        cmocka_unit_test(wrong_settings_name_their_place),
        cmocka_unit_test(all_that_is_wrong_is_told_at_once),
        cmocka_unit_test(no_more_than_ten_things),
        cmocka_unit_test(cut_scenes_are_survived),
        cmocka_unit_test(changed_scenes_are_survived),
        cmocka_unit_test(noise_is_survived),
    };
    return cmocka_run_group_tests_name("scene_wrong", tests, NULL, NULL);
}
