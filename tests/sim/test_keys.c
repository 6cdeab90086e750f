/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds for every key of scenes: numbers just within their limits are read, those just beyond are refused with the limits in
 * words; and each key that stands at the top by mistake is shown its place. */
#include "scenes.h"

#include "sim/base/units.h"
#include "sim/options/options.h"

#define RUN         "simulate: {until: 1 ms}\n" OUTPUTS
#define CHAIN       "beads: [{bead: brass, count: 9}]"
#define OUT(o)      "chain: {" CHAIN "}\nsimulate: {until: 1 ms}\noutputs: [{" o "}]\n"
#define FPUT(start) "chain: {equation: fput, points: 9, start: {" start "}}\nsimulate: {until: 1}\n" OUTPUTS
#define SHOCK(start) \
    "chain: {equation: shock, points: 60, epsilon: 0.1, length: 6, start: {" start "}}\nsimulate: {until: 1}\n" OUTPUTS
#define KDV  "chain: {equation: kdv, length: 34, start: {solitons: [{speed: 16, at: 1}]}}\nsimulate: {until: 1}\n" OUTPUTS
#define OVER "chain: {" CHAIN "}\nsweep: {over: {chain.striker.velocity: {from: 1 m/s, to: 2 m/s, count: 3}}}\n"
/* Where the keys of a section are, in a scene that has it. */
static const struct {
    const char *heading, *path, *scene;
} sections[] = {
    {"chain", "chain", "chain: {" CHAIN "}\n" RUN},
    {"chain.striker", "chain.striker", "chain: {striker: {bead: brass}, " CHAIN "}\n" RUN},
    {"chain.starts", "chain.start.0", "chain: {start: [{bead: 2}], " CHAIN "}\n" RUN},
    {"chain.beads", "chain.beads.0", "chain: {" CHAIN "}\n" RUN},
    {"chain.wall", "chain.wall", "chain: {wall: {absorbing: 1}, " CHAIN "}\n" RUN},
    {"chain.law (power)", "chain.law", "chain: {law: {power: 2, coefficient: 1e9}, " CHAIN "}\n" RUN},
    {"chain.law (fpu-alpha)", "chain.law", "chain: {law: {fpu-alpha: 1}, " CHAIN "}\n" RUN},
    {"chain.damping", "chain.damping", "chain: {damping: {coefficient: 1}, " CHAIN "}\n" RUN},
    {"chain.cradle", "chain.cradle", "chain: {cradle: {length: 1}, " CHAIN "}\n" RUN},
    {"chain.drive", "chain.drive", "chain: {drive: {force: chirp, amplitude: 1 N, frequency: 1 kHz, to: 2 kHz}, " CHAIN "}\n" RUN},
    {"materials.NAME", "materials.m",
     "materials: {m: {modulus: 1 GPa, poisson: 0.3, radius: 1 mm, mass: 1 g}}\nchain: {beads: [{bead: m}]}\n" RUN},
    {"materials.NAME.tolerance", "materials.m.tolerance",
     "materials: {m: {modulus: 1 GPa, poisson: 0.3, radius: 1 mm, mass: 1 g, tolerance: {radius: 1 %}}}\nchain: {beads: [{bead: "
     "m}]}\n" RUN},
    {"simulate", "simulate", "chain: {" CHAIN "}\n" RUN},
    {"outputs (trajectory)", "outputs.0", OUT("trajectory: a.h5")},
    {"outputs (image)", "outputs.0", OUT("image: a.png")},
    {"outputs (movie)", "outputs.0", OUT("movie: a.mp4")},
    {"outputs (plot)", "outputs.0", OUT("plot: a.png, show: modes")},
    {"outputs (table)", "outputs.0", OUT("table: a.csv, show: modes")},
    {"outputs (report)", "outputs.0", OUT("report: a.html")},
    {"chain.beads.taper", "chain.beads.0.taper", "chain: {beads: [{bead: brass, count: 9, taper: {to: 1 mm}}]}\n" RUN},
    {"chain.beads.disorder", "chain.beads.0.disorder",
     "chain: {beads: [{bead: brass, count: 9, disorder: {mass: normal 1 %}}]}\n" RUN},
    {"outputs (sweep)", "outputs.0", OVER "outputs: [{sweep: a.h5}]\n"},
    {"outputs (sheet)", "outputs.0", "sweep: {cells: 4}\noutputs: [{sheet: a.png}]\n"},
    {"outputs (image of a sweep)", "outputs.0", OVER "outputs: [{image: a.png}]\n"},
    {"outputs (plot of a sweep)", "outputs.0", OVER "outputs: [{plot: a.png}]\n"},
    {"outputs (table of a sweep)", "outputs.0", OVER "outputs: [{table: a.csv}]\n"},
    {"outputs (report of a sweep)", "outputs.0", "sweep: {cells: 4}\noutputs: [{report: a.html}]\n"},
    {"outputs.captions", "outputs.0.captions.0", OUT("movie: a.mp4, captions: [{at: 0.1 ms, text: a}]")},
    {"outputs.notes", "outputs.0.notes.0", OUT("movie: a.mp4, notes: [{at: 0.1 ms, text: a, bead: 1}]")},
    {"outputs.speed", "outputs.0.speed.0", OUT("movie: a.mp4, speed: [{at: 0 ms, factor: 1/4000}]")},
    {"outputs.card", "outputs.0.card", OUT("movie: a.mp4, card: {title: a}")},
    {"chain (fput)", "chain", FPUT("mode: 1")},
    {"chain (kdv)", "chain", KDV},
    {"chain (shock)", "chain", SHOCK("simple-wave: 1")},
    {"chain.piecewise", "chain.piecewise",
     "chain: {equation: fput, points: 9, piecewise: {stiffness: 2, beyond: 1}, start: {mode: 1}}\nsimulate: {until: 1}\n" OUTPUTS},
    {"chain.start (mode)", "chain.start", FPUT("mode: 1")},
    {"chain.start (pulse)", "chain.start", FPUT("pulse: 1")},
    {"chain.start (cosine)", "chain.start", SHOCK("cosine: 1")},
    {"chain.start (simple-wave)", "chain.start", SHOCK("simple-wave: 1")},
    {"chain.start.solitons", "chain.start.solitons.0", KDV},
    {"sweep", "sweep", "sweep: {cells: 4}\noutputs: [{sweep: a.h5}]\n"},
};

static enum bead_error read_with(const char *scene, const char *setting, struct bead_message *msg)
{
    struct bead_scene *read = NULL;
    const enum bead_error err = bead_scene_parse("test", scene, strlen(scene),
                                                 &(struct bead_overrides){.settings = &setting, .setting_count = 1}, &read, msg);
    bead_scene_free(read);
    return err;
}

/* Is `value` refused, or read? Other reasons for which the scene is refused do not matter. */
static void limit(size_t section, const struct bead_option *row, double value, bool refused)
{
    struct bead_message msg = {""};
    char setting[200], words[300], expected[600];
    snprintf(setting, sizeof setting, "%s.%s=%.17g", sections[section].path, row->key, value);
    const enum bead_error err = read_with(sections[section].scene, setting, &msg);
    snprintf(expected, sizeof expected, "%s.%s: `%.17g` is out of range; must be %s", sections[section].path, row->key, value,
             bead_option_allowed(row, words, sizeof words));
    if (refused != (strstr(msg.text, expected) != NULL) || (refused && err != BEAD_ERROR_SCENE))
        fail_msg("%s: %s'%s', not '%s'", setting, refused ? "" : "not ", msg.text, expected);
}

static void limits_of(size_t section, const struct bead_option *row)
{
    const bool count = row->type == BEAD_OPTION_COUNT;
    const double low = count && row->low == 0 && row->high == 0 ? 0 : row->low, high = row->high;
    const double below = count ? 1 : 1e-9 * fmax(fabs(low), 1e-9), above = count ? 1 : 1e-9 * fmax(fabs(high), 1e-9);
    const bool open_low = row->open & BEAD_OPEN_LOW, open_high = row->open & BEAD_OPEN_HIGH;
    limit(section, row, open_low ? low : low - below, true);
    limit(section, row, open_low ? low + below : low, false);
    limit(section, row, open_high ? high : high + above, true);
    limit(section, row, open_high ? high - above : high, false);
}

/* The section of these keys; those without numbers need none. */
static size_t section_of(const char *heading)
{
    size_t s = 0;
    while (s < sizeof sections / sizeof *sections && strcmp(sections[s].heading, heading) != 0)
        s++;
    return s;
}

static void numbers_have_limits(void **)
{
    const struct bead_options *options;
    char heading[100];
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        const size_t s = section_of(bead_options_heading(options, heading, sizeof heading));
        const struct bead_option *row;
        for (size_t k = 0; (row = bead_options_row(options, k)); k++) {
            if ((row->type != BEAD_OPTION_NUMBER && row->type != BEAD_OPTION_COUNT) || !bead_option_is_bounded(row))
                continue;
            if (s < sizeof sections / sizeof *sections)
                limits_of(s, row);
            else if (!strstr("chain.drive.file outputs.measured sweep.over", heading)) /* which need files, and keys of keys */
                fail_msg("%s.%s: here is no scene with it", heading, row->key);
        }
    }
}

static const struct bead_options *section_named(const char *name)
{
    const struct bead_options *options = NULL;
    char heading[100];
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        if (strcmp(bead_options_heading(options, heading, sizeof heading), name) == 0)
            break;
    }
    return options;
}

/* A key that stands at the top by mistake belongs to the first of these that has it, or else to an output. */
static void home_is_told(const char *key)
{
    static const char *const homes[] = {"chain", "chain.striker", "simulate", "sweep"};
    const char *home = NULL;
    char setting[100], expected[200];
    struct bead_message msg = {""};
    for (size_t h = 0; !home && h < sizeof homes / sizeof *homes; h++)
        home = bead_options_find(section_named(homes[h]), key) ? homes[h] : NULL;
    snprintf(setting, sizeof setting, "%s=1", key);
    snprintf(expected, sizeof expected, "%s: unknown key; did you mean `%s.%s`?", key, home ? home : "outputs.N", key);
    if (read_with(BEADS OUTPUTS, setting, &msg) != BEAD_ERROR_SCENE || !strstr(msg.text, expected))
        fail_msg("'%s', not '%s'", msg.text, expected);
}

/* Can keys of this section be missed at the top? */
static bool is_told(const struct bead_options *options)
{
    static const char *const told[] = {"chain", "chain.striker", "simulate", "sweep"};
    char heading[100];
    bead_options_heading(options, heading, sizeof heading);
    bool is = strncmp(heading, "outputs (", 9) == 0;
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        is = is || strcmp(told[i], heading) == 0;
    return is;
}

/* ... and has an earlier section, or the top itself, the same key? */
static bool is_tried(size_t section, const char *key)
{
    const struct bead_options *options;
    bool is = strcmp(key, "measured") == 0; /* whose file is looked for first */
    for (size_t i = 0; i < section && (options = bead_scene_section(i)); i++)
        is = is || ((i == 0 || is_told(options)) && bead_options_find(options, key));
    return is;
}

static void keys_have_a_home(void **)
{
    const struct bead_options *options;
    assert_ptr_equal(bead_scene_section(0), section_named("scene"));
    for (size_t i = 1; (options = bead_scene_section(i)); i++) {
        const struct bead_option *row;
        for (size_t k = 0; is_told(options) && (row = bead_options_row(options, k)); k++) {
            if (!is_tried(i, row->key))
                home_is_told(row->key);
        }
    }
}

/* Is the value refused at its place, and what would be allowed said? Of pairs, that they are two; of values of other shapes, which
 * may be read, only the place, or that of the map around it. */
static void refuse_value(size_t section, const struct bead_option *row, const char *value)
{
    struct bead_message msg = {""};
    char setting[300], place[200], words[400], allowed[500];
    const bool custom = row->type == BEAD_OPTION_CUSTOM;
    snprintf(setting, sizeof setting, "%s.%s=%s", sections[section].path, row->key, value);
    snprintf(place, sizeof place, custom ? "%s" : "%s.%s: ", sections[section].path, row->key);
    snprintf(allowed, sizeof allowed, "must be %s",
             row->type == BEAD_OPTION_PAIR ? "[a, b]" : bead_option_allowed(row, words, sizeof words));
    const enum bead_error err = read_with(sections[section].scene, setting, &msg);
    if (custom ? err && !strstr(msg.text, place) && !strstr(msg.text, "is missing")
               : err != BEAD_ERROR_SCENE || !strstr(msg.text, place) || !strstr(msg.text, allowed))
        fail_msg("%s: '%s'", setting, msg.text);
}

/* Choices are read, whatever else the scene then lacks; with another letter they are refused. */
static void choose(size_t section, const struct bead_option *row)
{
    for (size_t c = 0; row->choices[c]; c++) {
        struct bead_message msg = {""};
        char setting[300], refused[300];
        snprintf(setting, sizeof setting, "%s.%s=%s", sections[section].path, row->key, row->choices[c]);
        snprintf(refused, sizeof refused, "%s.%s: is `%s`", sections[section].path, row->key, row->choices[c]);
        if (read_with(sections[section].scene, setting, &msg) && strstr(msg.text, refused))
            fail_msg("%s: '%s'", setting, msg.text);
        snprintf(refused, sizeof refused, "q%s", row->choices[c]);
        refuse_value(section, row, refused);
    }
}

static void values_of_other_kinds_are_refused(void **)
{
    static const char *const others[] = {"[]", "{}", "[1, 2, 3]", "{a: 1}", "qxyz"};
    const struct bead_options *options;
    char heading[100];
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        const size_t s = section_of(bead_options_heading(options, heading, sizeof heading));
        const struct bead_option *row;
        for (size_t k = 0; s < sizeof sections / sizeof *sections && (row = bead_options_row(options, k)); k++) {
            for (size_t o = 0; row->type != BEAD_OPTION_MAP && o < (row->type == BEAD_OPTION_TEXT ? 4 : 5); o++)
                refuse_value(s, row, others[o]);
            if (row->type == BEAD_OPTION_CHOICE)
                choose(s, row);
        }
    }
}

/* Where a map belongs, its first key and a value look like a key without its colon; another word does not. */
static void colons_are_missed(void **)
{
    const struct bead_options *options;
    size_t missed = 0;
    char heading[100];
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        const size_t s = section_of(bead_options_heading(options, heading, sizeof heading));
        const struct bead_option *first = bead_options_row(options, 0);
        char setting[300], hint[200];
        struct bead_message msg[2] = {{""}, {""}};
        if (s == sizeof sections / sizeof *sections || !first || strchr(heading, '(')) /* one of several: without keys, which? */
            continue;
        snprintf(setting, sizeof setting, "%s=%s 5", sections[s].path, first->key);
        snprintf(hint, sizeof hint, "is the colon missing after `%s`?", first->key);
        if (!read_with(sections[s].scene, setting, &msg[0]) || !strstr(msg[0].text, "must be a map of keys"))
            continue; /* it may also be a word, or a list */
        snprintf(setting, sizeof setting, "%s=q%s 5", sections[s].path, first->key);
        assert_int_equal(read_with(sections[s].scene, setting, &msg[1]), BEAD_ERROR_SCENE);
        if (!strstr(msg[0].text, hint) || strstr(msg[1].text, "colon") || !strstr(msg[1].text, "must be a map of keys"))
            fail_msg("%s: '%s', and '%s'", setting, msg[0].text, msg[1].text);
        missed++;
    }
    assert_true(missed > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(values_of_other_kinds_are_refused), cmocka_unit_test(numbers_have_limits),
                                       cmocka_unit_test(keys_have_a_home), cmocka_unit_test(colons_are_missed)};
    return cmocka_run_group_tests_name("keys", tests, NULL, NULL);
}
