/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: their meaning, their numbers, ready scenes and assets. */
#include "scenes.h"

#include "beadreel/law.h"
#include "sim/scene/scene_internal.h"

/* ---- meaning and defaults ---- */

static void everything_has_a_default_but_a_chain_and_an_output(void **state)
{
    (void)state;
    struct bead_scene *scene = parse(BEADS OUTPUTS);
    assert_string_equal(scene->file, "test");
    assert_string_equal(scene->text, BEADS OUTPUTS);
    assert_string_equal(scene->title, "");
    assert_int_equal(scene->chain_count, 1);
    const struct bead_chain_spec *chain = &scene->chains[0];
    assert_string_equal(chain->name, "");
    assert_string_equal(chain->label, "");
    assert_string_equal(scene->materials[chain->striker_material].name, "large-steel");
    assert_true(chain->striker_velocity == 0.443);
    assert_int_equal(chain->wall, BEAD_WALL_NONE);
    assert_string_equal(chain->law.row->name, "hertz");
    assert_true(chain->precompression == 0 && chain->tilt == 0 && chain->damping_coefficient == 0 &&
                chain->damping_exponent == 1.8);
    assert_int_equal(chain->segment_count, 1);
    assert_int_equal(chain->segments[0].count, 1);
    assert_int_equal(chain->segments[0].cell_beads, 1);
    assert_int_equal(chain->segments[0].spins, BEAD_SPINS_UP);
    assert_false(chain->segments[0].spins_given);
    assert_null(chain->segments[0].sensor);
    assert_true(isnan(scene->simulate.until) && scene->simulate.accuracy == 1e-6 && scene->simulate.step == 0);
    assert_string_equal(scene->simulate.method, "auto");
    bead_scene_free(scene);
}

/* A name of small letters and digits becomes words, where signs between letters part them; what people wrote stays. */
static void identifiers_become_words(void **state)
{
    (void)state;
    static const char *const names[][2] = {{"clean-wave", "clean wave"},
                                           {"a_b-12", "a b 12"},
                                           {"x--y", "x--y"},
                                           {"-x", "-x"},
                                           {"x_", "x_"},
                                           {"P3-10", "P3-10"},
                                           {"two words-1", "two words-1"},
                                           {"größe-1", "größe 1"},
                                           {"a:b-c", "a:b-c"},
                                           {"n=2-3", "n=2-3"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "chains:\n  - {name: \"%s\", beads: [{bead: large-steel}]}\n  - {name: z, beads: [{bead: large-steel}]}\n" OUTPUTS,
                 names[i][0]);
        struct bead_scene *scene = parse(text);
        assert_string_equal(scene->chains[0].title, names[i][1]);
        bead_scene_free(scene);
    }
}

/* One column wide, except for chains side by side and for panels. */
static void papers_are_as_wide_as_they_need(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("chains: [{name: a, beads: [{bead: brass}]}, {name: b, beads: [{bead: brass}]}]\n"
                                     "outputs:\n"
                                     "  - {image: a.png, style: paper}\n"
                                     "  - {plot: b.png, style: paper, show: peaks}\n"
                                     "  - {plot: c.png, style: paper, show: setup}\n"
                                     "  - {image: d.png, style: paper, panels: [[{chain: a}, {chain: b}]]}\n");
    static const double width[] = {0.178, 0.086, 0.178, 0.178};
    for (size_t i = 0; i < 4; i++)
        assert_true(scene->outputs[i].paper.size_is_length && scene->outputs[i].paper.size[0] == width[i]);
    bead_scene_free(scene);
}

static void outputs_have_the_defaults_of_their_kind(void **state)
{
    (void)state;
    struct bead_scene *scene = parse(BEADS "outputs:\n"
                                           "  - {trajectory: run.h5}\n"
                                           "  - {image: a.png}\n"
                                           "  - {image: a.PDF}\n"
                                           "  - {movie: a.mp4}\n"
                                           "  - {table: a.csv}\n"
                                           "  - {image: a.svg, size: [640, 480]}\n");
    const struct bead_output *o = scene->outputs;
    assert_int_equal(scene->output_count, 6);
    assert_int_equal(o[0].kind, BEAD_OUTPUT_TRAJECTORY);
    assert_int_equal(o[0].trajectory.fields, BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) |
                                                 BEAD_FIELD_BIT(BEAD_FIELD_FORCE));
    assert_true(o[0].shown.every == 0 && isnan(o[0].shown.time[0]) && isnan(o[0].shown.time[1]));
    assert_true(o[0].shown.beads.first == 0 && o[0].shown.beads.last == SIZE_MAX);
    assert_true(o[1].paper.size[0] == 1920 && o[1].paper.size[1] == 1080 && !o[1].paper.size_is_length);
    assert_string_equal(o[1].colours.colormap, "auto");
    assert_int_equal(o[1].colours.scale, BEAD_SCALE_SQRT);
    assert_int_equal(o[1].shown.field, BEAD_FIELD_FORCE);
    assert_true(o[1].views.axes && isnan(o[1].colours.range[0]) && isnan(o[1].colours.range[1]) && isnan(o[1].image.at) &&
                o[1].views.magnify == 0);
    assert_int_equal(o[1].views.count, 1);
    assert_int_equal(o[1].views.kinds[0], BEAD_VIEW_SPACETIME);
    assert_true(o[2].paper.size[0] == 0.178 && o[2].paper.size[1] == 0.12 && o[2].paper.size_is_length && o[2].paper.dpi == 600);
    assert_string_equal(o[3].colours.colormap, "auto");
    assert_int_equal(o[3].colours.scale, BEAD_SCALE_SQRT);
    assert_true(o[3].movie.fps == 60 && isnan(o[3].movie.duration) && o[3].paper.size[0] == 1920);
    assert_int_equal(o[3].movie.quality, BEAD_QUALITY_STANDARD);
    assert_int_equal(o[3].views.count, 3);
    assert_int_equal(o[3].views.kinds[2], BEAD_VIEW_SPACETIME);
    assert_int_equal(o[4].curves.show, BEAD_SHOW_PEAKS);
    assert_true(o[5].paper.size[0] == 640 && !o[5].paper.size_is_length);
    bead_scene_free(scene);
}

static void outputs_mean_what_they_say(void **state)
{
    (void)state;
    struct bead_scene *scene = parse(
        "simulate: {until: 2 ms}\n"
        "chain: {beads: [{bead: large-steel, count: 50}, {bead: small-steel, sensor: first}]}\n"
        "outputs:\n"
        "  - {trajectory: run.h5, every: 1 us, fields: all, beads: 7, time: [auto, 1 ms]}\n"
        "  - {image: a.png, field: velocity, time: [0, 1.5 ms], beads: [20, 40], size: [86 mm, 6 cm], dpi: 300,\n"
        "     colormap: grey, scale: log, range: [1 mm/s, 2], axes: no, views: [beads, sensors], at: 0.7 ms, magnify: 60}\n"
        "  - {movie: b/a.webm, fps: 25, duration: 2.5, quality: lossless, theme: light, field: contact-force, range: [-1, auto]}\n"
        "  - {plot: sensors.pdf, show: sensors}\n"
        "  - {table: beads.csv, show: bead-peaks}\n"
        "  - {table: sensors.csv, show: sensors, every: 1 \xc2\xb5s}\n");
    const struct bead_output *o = scene->outputs;
    assert_int_equal(o[0].trajectory.fields, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN) - 1);
    assert_true(o[0].shown.every == 1e-6 && o[0].shown.beads.first == 7 && o[0].shown.beads.last == 7 &&
                isnan(o[0].shown.time[0]) && o[0].shown.time[1] == 1e-3);
    assert_int_equal(o[1].shown.field, BEAD_FIELD_VELOCITY);
    assert_true(o[1].shown.time[0] == 0 && o[1].shown.time[1] == 1.5e-3 && o[1].shown.beads.first == 20 &&
                o[1].shown.beads.last == 40);
    assert_true(o[1].paper.size[0] == 0.086 && o[1].paper.size[1] == 0.06 && o[1].paper.size_is_length && o[1].paper.dpi == 300);
    assert_true(o[1].colours.range[0] == 1e-3 && o[1].colours.range[1] == 2 && !o[1].views.axes && o[1].image.at == 0.7e-3 &&
                o[1].views.magnify == 60);
    assert_int_equal(o[1].colours.scale, BEAD_SCALE_LOG);
    assert_int_equal(o[1].views.count, 2);
    assert_int_equal(o[1].views.kinds[1], BEAD_VIEW_SENSORS);
    assert_string_equal(o[2].path, "b/a.webm");
    assert_true(o[2].movie.fps == 25 && o[2].movie.duration == 2.5 && o[2].colours.range[0] == -1 && isnan(o[2].colours.range[1]));
    assert_int_equal(o[2].movie.quality, BEAD_QUALITY_LOSSLESS);
    assert_int_equal(o[2].paper.theme, BEAD_THEME_LIGHT);
    assert_int_equal(o[4].curves.show, BEAD_SHOW_BEAD_PEAKS);
    assert_true(o[5].shown.every == 1e-6);
    assert_int_equal(o[5].node->place.line, 10);
    assert_int_equal(o[5].node->place.column, 5);
    bead_scene_free(scene);
}

static void the_contract_s_example_is_read(void **state)
{
    (void)state;
    struct bead_scene *scene =
        parse("title: Clean and delocalised waves\n"
              "materials:\n"
              "  tungsten-carbide: {density: 14900 kg/m3, modulus: 668 GPa, poisson: 0.24, radius: 4.76 mm}\n"
              "chain:\n"
              "  striker: {bead: tungsten-carbide, velocity: 0.443 m/s}\n"
              "  beads:\n"
              "    - {cell: [large-steel, aluminium]}\n"
              "    - {cell: [large-steel, aluminium], count: 18, spins: random, magnetism: 0.2, seed: 18446744073709551615}\n"
              "    - {bead: small-steel, sensor: first}\n"
              "    - {cell: [large-steel, aluminium], count: 4, spins: 0101}\n"
              "    - {bead: small-steel, sensor: second}\n"
              "    - {cell: [large-steel, aluminium, ptfe], spins: down}\n"
              "  wall: brass\n"
              "  law: {power: 1.5, coefficient: 6.9e9}\n"
              "  precompression: 10 N\n"
              "  tilt: 3.5 deg\n"
              "  damping: {coefficient: 0.1, exponent: 1.5}\n"
              "simulate: {until: 1.5 ms, accuracy: 1e-8, method: rk4, step: 0.1 us}\n" OUTPUTS);
    const struct bead_chain_spec *chain = &scene->chains[0];
    assert_string_equal(scene->title, "Clean and delocalised waves");
    assert_string_equal(scene->materials[chain->striker_material].name, "tungsten-carbide");
    assert_int_equal(chain->segment_count, 6);
    assert_int_equal(chain->segments[1].spins, BEAD_SPINS_RANDOM);
    assert_int_equal(chain->segments[1].count, 18);
    assert_true(chain->segments[1].magnetism == 0.2 && chain->segments[1].seed == UINT64_MAX && chain->segments[1].spins_given);
    assert_string_equal(chain->segments[2].sensor, "first");
    assert_int_equal(chain->segments[3].spins, BEAD_SPINS_DIGITS);
    assert_string_equal(chain->segments[3].digits, "0101");
    assert_int_equal(chain->segments[5].cell_beads, 3);
    assert_int_equal(chain->segments[5].spins, BEAD_SPINS_DOWN);
    assert_string_equal(scene->materials[chain->segments[5].cell[2]].name, "ptfe");
    assert_int_equal(chain->wall, BEAD_WALL_MATERIAL);
    assert_string_equal(scene->materials[chain->wall_material].name, "brass");
    assert_string_equal(chain->law.row->name, "power");
    assert_true(chain->law.power == 1.5 && chain->law.coefficient == 6.9e9);
    assert_true(chain->precompression == 10 && fabs(chain->tilt - 0.061086523819801536) < 1e-17);
    assert_true(chain->damping_coefficient == 0.1 && chain->damping_exponent == 1.5);
    assert_true(scene->simulate.until == 1.5e-3 && scene->simulate.accuracy == 1e-8 && scene->simulate.step == 0.1e-6);
    bead_scene_free(scene);
}

static void laws_and_walls(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("chains:\n"
                                     "  - {name: a, wall: rigid, law: thesis-appendix, beads: &b [{bead: ptfe, count: 3}]}\n"
                                     "  - {name: b, label: two, wall: none, law: {fpu-alpha: 0.25}, beads: *b}\n"
                                     "  - {name: c, law: {fpu-alpha: -2, stiffness: 3 N/mm}, beads: *b}\n" OUTPUTS);
    assert_int_equal(scene->chain_count, 3);
    assert_int_equal(scene->chains[0].wall, BEAD_WALL_RIGID);
    assert_string_equal(scene->chains[0].law.row->name, "thesis-appendix");
    assert_string_equal(scene->chains[1].law.row->name, "fpu-alpha");
    assert_true(scene->chains[1].law.alpha == 0.25 && scene->chains[1].law.stiffness == 1);
    assert_true(scene->chains[2].law.alpha == -2 && scene->chains[2].law.stiffness == 3000);
    assert_string_equal(scene->chains[1].label, "two");
    assert_int_equal(scene->chains[2].segments[0].count, 3);
    bead_scene_free(scene);
}

static void materials_of_the_thesis(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double mass, modulus, poisson, radius;
    } table[] = {{"large-steel", 3.63e-3, 193e9, 0.30, 4.76e-3},
                 {"small-steel", 0.45e-3, 193e9, 0.30, 2.38e-3},
                 {"ptfe", 0.123e-3, 1.46e9, 0.46, 2.38e-3},
                 {"aluminium", 1.26e-3, 72.4e9, 0.33, 4.76e-3}};
    struct bead_scene *scene = NULL;
    struct bead_message msg;
    assert_int_equal(bead_scene_materials(&scene, &msg), BEAD_OK);
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const struct bead_material *m = material_of(scene, table[i].name);
        assert_true(m->mass == table[i].mass && m->modulus == table[i].modulus && m->poisson == table[i].poisson &&
                    m->radius == table[i].radius);
    }
    const struct bead_material *brass = material_of(scene, "brass");
    assert_true(brass->modulus == 90.2e9 && brass->poisson == 0.34 && brass->mass > 0);
    bead_scene_free(scene);
}

static void materials_are_added_and_changed(void **state)
{
    (void)state;
    struct bead_scene *scene =
        parse("materials:\n"
              "  large-steel: {mass: 3.60187 g, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3, colour: \"#ff8000\"}\n"
              "  wall: {modulus: 1e9, poisson: -0.5}\n"
              "  x: {density: 1000, radius: 1, modulus: 1, poisson: 0.5}\n"
              "chain: {wall: wall, beads: [{bead: x}]}\n" OUTPUTS);
    const struct bead_material *steel = material_of(scene, "large-steel"), *wall = material_of(scene, "wall");
    assert_true(steel->mass == 3.60187e-3 && steel->colour[0] == 1 && steel->colour[1] == 128.0 / 255 && steel->colour[2] == 0);
    assert_true(isnan(wall->mass) && isnan(wall->radius) && wall->poisson == -0.5);
    assert_true(fabs(material_of(scene, "x")->mass / 4188.790204786391 - 1) < 1e-15);
    bead_scene_free(scene);
}

/* ---- numbers ---- */

static double velocity(const char *value)
{
    char text[256];
    snprintf(text, sizeof text, "chain: {striker: {velocity: %s}, beads: [{bead: large-steel}]}\n" OUTPUTS, value);
    struct bead_scene *scene = parse(text);
    double read = scene->chains[0].striker_velocity;
    bead_scene_free(scene);
    return read;
}

static double precompression(const char *value)
{
    char text[256];
    snprintf(text, sizeof text, "chain: {precompression: %s, beads: [{bead: large-steel}]}\n" OUTPUTS, value);
    struct bead_scene *scene = parse(text);
    double read = scene->chains[0].precompression;
    bead_scene_free(scene);
    return read;
}

static void numbers_with_and_without_units(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"0.443", 0.443},        {"+.5", 0.5},           {"5.", 5},
                 {"1e-3", 1e-3},          {"1E+2", 100},          {"0.443 m/s", 0.443},
                 {"0.443m/s", 0.443},     {"443 mm/s", 0.443},    {"44.3 cm/s", 0.443},
                 {"\"443 mm/s\"", 0.443}, {"44.3e1 mm/s", 0.443}, {"0.000443 km/s", 0.443},
                 {"443 mm s-1", 0.443},   {"4.43 dm/s", 0.443},   {"443 millimetre/second", 0.443}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (velocity(cases[i].text) != cases[i].value)
            fail_msg("%s is %.17g", cases[i].text, velocity(cases[i].text));
    }
    assert_true(fabs(velocity("36 km/h") - 10) < 1e-14);
    assert_true(fabs(velocity("1 knot") - 1852.0 / 3600) < 1e-15);
    assert_true(fabs(precompression("1 kgf") - 9.80665) < 1e-14);
    assert_true(precompression("10 kg m s-2") == 10);
    assert_true(precompression("3 \xc2\xb5N") == 3e-6);
}

static void numbers_do_not_depend_on_the_locale(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "ru_RU.UTF-8"};
    const char *set = NULL;
    for (size_t i = 0; i < sizeof names / sizeof *names && !set; i++)
        set = setlocale(LC_ALL, names[i]);
    assert_true(velocity("0.443 m/s") == 0.443);
    setlocale(LC_ALL, "C");
}

static void wrong_numbers_name_what_is_allowed(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "nan", "inf",    ".nan", "1e999", "-1",     "1e5",     "0x10",   "1,5",        "1 2",
        "m/s", "--1",    "1e",   "1 N",   "1 m/s2", "1 m/s x", "1 degC", "1 m/s@2",    "1 lg(re 1 m/s)",
        "[1]", "{a: 1}", "\"\"", "1 s-1", "",       "~",       "true",   "1 \xc2\xb5", "1 m/ s/"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[256];
        snprintf(text, sizeof text, "chain:\n  striker:\n    velocity: %s\n  beads: [{bead: large-steel}]\n" OUTPUTS, wrong[i]);
        refuse(text, ": chain.striker.velocity: ");
        refuse(text, "test:3:1");
        refuse(text, "; must be from 0 to 10000 m/s");
    }
    refuse("chain: {tilt: 3.5, wall: brass, beads: [{bead: ptfe}]}\n" OUTPUTS, "from 0 to 90 deg");
}

static void flags(void **state)
{
    (void)state;
    static const struct {
        const char *word;
        bool value;
    } words[] = {{"true", true}, {"false", false}, {"yes", true}, {"no", false}, {"True", true}, {"NO", false}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char text[256];
        snprintf(text, sizeof text, BEADS "outputs: [{image: a.png, axes: %s}]\n", words[i].word);
        struct bead_scene *scene = parse(text);
        assert_int_equal(scene->outputs[0].views.axes, words[i].value);
        bead_scene_free(scene);
    }
}

/* ---- ready scenes and assets ---- */

static void ready_scenes_are_listed_and_right(void **state)
{
    (void)state;
    struct bead_ready_scene *scenes = NULL;
    struct bead_message msg = {""};
    size_t count = 0;
    bool demo = false;
    assert_int_equal(bead_scene_ready(&scenes, &count, &msg), BEAD_OK);
    for (size_t i = 0; i < count; i++) {
        struct bead_scene *scene = load_ready(scenes[i].name);
        assert_string_equal(scene->title, scenes[i].title);
        assert_true(*scene->title);
        demo = demo || strcmp(scenes[i].name, "clean-vs-delocalised") == 0;
        bead_scene_free(scene);
    }
    assert_true(demo && count >= 3);
    bead_scene_ready_free(scenes, count);
}

static void the_demo_is_a_clean_beside_a_delocalised_wave(void **state)
{
    (void)state;
    struct bead_scene *scene = load_ready("clean-vs-delocalised");
    assert_int_equal(scene->chain_count, 2);
    assert_string_equal(scene->chains[0].name, "Clean");
    assert_string_equal(scene->chains[1].name, "Delocalised");
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(bead_scene_count_beads(&scene->chains[i]), 128);
        assert_int_equal(scene->chains[i].wall, BEAD_WALL_MATERIAL);
    }
    assert_int_equal(scene->chains[1].segments[0].spins, BEAD_SPINS_RANDOM);
    unsigned kinds = 0;
    for (size_t i = 0; i < scene->output_count; i++)
        kinds |= 1u << scene->outputs[i].kind;
    assert_int_equal(kinds, 1 << BEAD_OUTPUT_TRAJECTORY | 1 << BEAD_OUTPUT_IMAGE | 1 << BEAD_OUTPUT_MOVIE | 1 << BEAD_OUTPUT_TABLE);
    bead_scene_free(scene);
}

static void the_four_chains_of_fig_5_have_their_magnetism(void **state)
{
    (void)state;
    static const double magnetism[] = {1, 0.9, 0.5, 0};
    struct bead_scene *scene = load_ready("sensors");
    assert_int_equal(scene->chain_count, 4);
    for (size_t i = 0; i < 4; i++) {
        struct bead_chain *chain = NULL;
        struct bead_message msg = {""};
        size_t count = 0;
        if (bead_chain_create(scene, i, &chain, &msg))
            fail_msg("%s", msg.text);
        const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
        assert_true(fabs(bead_chain_magnetism(chain) - magnetism[i]) < 1e-15);
        assert_int_equal(bead_chain_beads(chain), 69);
        assert_int_equal(count, 2);
        assert_int_equal(sensors[0].bead, 39);
        assert_int_equal(sensors[1].bead, 48);
        bead_chain_destroy(chain);
    }
    bead_scene_free(scene);
}

/* Without `spins`, a cell that is the mirror image of the first ones is turned over; the same both ways round it is not. */
static void mirrored_cells_are_down(void **state)
{
    (void)state;
    static const struct {
        const char *beads;
        double magnetism;
    } cases[] = {{"{cell: [large-steel, ptfe], count: 10}", 1},
                 {"{cell: [large-steel, ptfe], count: 9}, {cell: [ptfe, large-steel], count: 1}", 0.8},
                 {"{cell: [ptfe, large-steel], count: 5}, {bead: brass}, {cell: [large-steel, ptfe], count: 5}", 0},
                 {"{cell: [large-steel, large-steel], count: 3}, {cell: [large-steel, large-steel], count: 3}", 1},
                 {"{cell: [large-steel, ptfe], count: 3}, {cell: [ptfe, brass], count: 3}", 1},
                 {"{cell: [large-steel, brass, ptfe], count: 3}, {cell: [ptfe, brass, large-steel], count: 1}", 0.5},
                 {"{cell: [large-steel, ptfe], count: 4, spins: '1110'}, {cell: [ptfe, large-steel], count: 4}", 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text, "chain: {beads: [%s]}\noutputs: [{table: peaks.csv, show: peaks}]\n", cases[i].beads);
        struct bead_scene *scene = parse(text);
        struct bead_chain *chain = NULL;
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        assert_true(fabs(bead_chain_magnetism(chain) - cases[i].magnetism) < 1e-15);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

static void scenes_are_found_by_name_or_path(void **state)
{
    (void)state;
    char path[4096];
    struct bead_message msg = {""};
    assert_int_equal(bead_scene_find("tests/bad/nan.yaml", path, sizeof path, &msg), BEAD_OK);
    assert_string_equal(path, "tests/bad/nan.yaml");
    assert_int_equal(bead_scene_find("imagesc", path, sizeof path, &msg), BEAD_OK);
    assert_non_null(strstr(path, "scenes/thesis/imagesc.yaml"));
    assert_int_equal(bead_scene_find("thesis/imagsc", path, sizeof path, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "did you mean `thesis/imagesc`?"));
    assert_int_equal(bead_scene_find("../materials", path, sizeof path, &msg), BEAD_ERROR_USAGE);
    assert_int_equal(bead_scene_find("", path, sizeof path, &msg), BEAD_ERROR_USAGE);
    assert_int_equal(bead_scene_find("tests", path, sizeof path, &msg), BEAD_ERROR_IO);
}

static void missing_assets_say_where_they_were_sought(void **state)
{
    (void)state;
    char path[4096], *text = NULL;
    size_t length = 0;
    struct bead_message msg = {""};
    assert_int_equal(bead_asset_path("none/of.these", path, sizeof path, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "none/of.these"));
    assert_non_null(strstr(msg.text, "BEADREEL_ASSETS"));
    assert_int_equal(bead_asset_read("materials.yaml", &text, &length, &msg), BEAD_OK);
    assert_int_equal(strlen(text), length);
    free(text);
}

static void help_names_every_key(void **state)
{
    (void)state;
    static void (*const writers[])(FILE *) = {bead_scene_help, bead_scene_help_man};
    static const char *const defaults[] = {"default 0.443 m/s", "Default: 0.443 m/s"};
    static const char *const keys[] = {"striker",    "velocity", "magnetism", "sensor", "precompression", "until", "accuracy",
                                       "trajectory", "colormap", "duration",  "views",  "poisson",        "colour"};
    for (size_t w = 0; w < 2; w++) {
        char *text = NULL;
        size_t length = 0;
        FILE *out = open_memstream(&text, &length);
        assert_non_null(out);
        writers[w](out);
        assert_int_equal(fclose(out), 0);
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
            assert_non_null(strstr(text, keys[i]));
        assert_non_null(strstr(text, defaults[w]));
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_has_a_default_but_a_chain_and_an_output),
        cmocka_unit_test(papers_are_as_wide_as_they_need),
        cmocka_unit_test(outputs_have_the_defaults_of_their_kind),
        cmocka_unit_test(outputs_mean_what_they_say),
        cmocka_unit_test(the_contract_s_example_is_read),
        cmocka_unit_test(laws_and_walls),
        cmocka_unit_test(materials_of_the_thesis),
        cmocka_unit_test(materials_are_added_and_changed),
        cmocka_unit_test(numbers_with_and_without_units),
        cmocka_unit_test(numbers_do_not_depend_on_the_locale),
        cmocka_unit_test(wrong_numbers_name_what_is_allowed),
        cmocka_unit_test(flags),
        cmocka_unit_test(ready_scenes_are_listed_and_right),
        cmocka_unit_test(the_demo_is_a_clean_beside_a_delocalised_wave),
        cmocka_unit_test(the_four_chains_of_fig_5_have_their_magnetism),
        cmocka_unit_test(mirrored_cells_are_down),
        cmocka_unit_test(identifiers_become_words),
        cmocka_unit_test(scenes_are_found_by_name_or_path),
        cmocka_unit_test(missing_assets_say_where_they_were_sought),
        cmocka_unit_test(help_names_every_key),
    };
    return cmocka_run_group_tests_name("scene", tests, NULL, NULL);
}
