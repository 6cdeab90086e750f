/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of pages, as numbers: axes with the range that is asked for, numbers with the digits that they need, bars level with their
 * images, power laws with the exponents that legends say, images at their time. */
#include "drawn.h"
#include "page_laws.h"

static struct drawn drawn;

#define STRIKER "striker: {bead: large-steel, velocity: 1 m/s}, "

static size_t count_texts(const struct drawn *d, const char *text)
{
    size_t count = 0;
    for (size_t i = 0; i < d->texts; i++)
        count += strstr(d->text[i].text, text) != NULL;
    return count;
}

/* Equal axes of panels above each other have numbers and titles below the lowest only. */
static void equal_axes_are_labelled_once(void **)
{
    drawn_run("chain: {" STRIKER "beads: [{bead: large-steel, count: 40}]}\n"
              "simulate: {until: 0.4 ms}\n"
              "outputs: [{image: a.pdf, panels: [[{field: force}], [{field: velocity}]], style: paper, size: [120 mm, 90 mm]}]\n",
              &drawn);
    assert_int_equal(count_texts(&drawn, "time ("), 1);
    assert_int_equal(count_texts(&drawn, "300"), 1);
    assert_int_equal(count_texts(&drawn, "bead"), 3); /* along both, and in the title of a bar */
}

/* Times of profiles have the decimals that any of them needs, as many for all, but no more than five digits. */
static void times_have_the_digits_they_need(void **)
{
    static const struct {
        const char *at, *said[2];
    } times[] = {{"10 us, 20 us", {"10\u00a0\u00b5s", "20\u00a0\u00b5s"}},
                 {"10.25 us, 20 us", {"10.25\u00a0\u00b5s", "20.00\u00a0\u00b5s"}},
                 {"10.123456 us, 20 us", {"10.123\u00a0\u00b5s", "20.000\u00a0\u00b5s"}}};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        char text[500];
        snprintf(text, sizeof text,
                 "chain: {" STRIKER "beads: [{bead: large-steel, count: 5}]}\nsimulate: {until: 30 us}\n"
                 "outputs: [{plot: a.pdf, show: profiles, at: [%s]}]\n",
                 times[i].at);
        drawn_run(text, &drawn);
        for (int k = 0; k < 2; k++)
            assert_int_equal(count_texts(&drawn, times[i].said[k]), 1);
    }
}

/* So have magnetisms, all as many, and none where they are whole. */
static void magnetisms_have_the_digits_they_need(void **)
{
    static const struct {
        const char *magnetism;
        size_t decimals;
    } plots[] = {{"0, 1", 0}, {"0, 0.5", 1}, {"0, 0.75", 2}};
    for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) {
        char text[300];
        size_t said = 0;
        snprintf(text, sizeof text,
                 "sweep: {cells: 8, magnetism: [%s], configurations: 2, measure: {decay: true}}\n"
                 "outputs: [{plot: a.pdf, show: decay}]\n",
                 plots[i].magnetism);
        drawn_run(text, &drawn);
        for (size_t j = 0; j < drawn.texts; j++) {
            static const char equals[] = "M\u00a0=\u00a0";
            const char *number = drawn.text[j].text + strlen(equals);
            if (strncmp(drawn.text[j].text, equals, strlen(equals)) != 0)
                continue;
            const size_t whole = strspn(number, "0123456789"), point = number[whole] == '.';
            if (point + strspn(number + whole + point, "0123456789") != (plots[i].decimals ? 1 + plots[i].decimals : 0))
                fail_msg("'%s' among %s", drawn.text[j].text, plots[i].magnetism);
            said++;
        }
        assert_true(said > 1);
    }
}

/* Stacks of energy have the parts that are there: no gravity without a slope, no springs without any. */
static void stacks_have_what_there_is(void **)
{
    static const struct {
        const char *more;
        size_t gravity;
    } chains[] = {{"", 0}, {", tilt: 30 deg", 1}};
    for (size_t i = 0; i < 2; i++) {
        char text[500];
        snprintf(text, sizeof text,
                 "chain: {" STRIKER "beads: [{bead: large-steel, count: 5}], wall: rigid%s}\n"
                 "simulate: {until: 0.1 ms}\noutputs: [{plot: a.pdf, show: energy}]\n",
                 chains[i].more);
        drawn_run(text, &drawn);
        assert_int_equal(count_texts(&drawn, "kinetic"), 1);
        assert_int_equal(count_texts(&drawn, "gravity"), chains[i].gravity);
        assert_int_equal(count_texts(&drawn, "spring"), 0);
    }
}

/* The striker and both beads with sensors have rings, whole ones. */
static void sensors_have_rings(void **)
{
    drawn_run("chain: {" STRIKER
              "beads: [{bead: large-steel, count: 4}, {bead: large-steel, sensor: s}, {bead: ptfe, sensor: t}]}\n"
              "simulate: {until: 0.1 ms}\n"
              "outputs: [{image: a.pdf, views: [beads], style: paper, size: [120 mm, 60 mm]}]\n",
              &drawn);
    size_t rings = 0;
    for (size_t j = 0; j < drawn.marks; j++) {
        const struct mark *m = &drawn.mark[j];
        const bool closed = hypot(m->last[0] - m->first[0], m->last[1] - m->first[1]) < 0.02;
        rings += !m->filled && closed;
    }
    assert_int_equal(rings, 3);
}

/* The values at the lower and the upper end of the first frame of a page, from the first and the last number along its left side.
 */
static void ends_of_axis(const struct drawn *d, size_t page, int scale, double ends[2])
{
    const struct stroke *frame = NULL;
    double at[2] = {NAN, NAN}, value[2] = {NAN, NAN};
    for (size_t j = 0; j < strokes.count && !frame; j++)
        frame = is_on_page(j, page) && is_frame(&strokes.list[j]) ? &strokes.list[j] : NULL;
    assert_non_null(frame);
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        const double middle = (a->low[1] + a->high[1]) / 2;
        if (a->page != page || isnan(number_of(a->text)) || a->high[0] > frame->low[0] || middle > frame->high[1] + 3)
            continue;
        const int k = !isnan(at[0]);
        at[k] = middle;
        value[k] = scaled(number_of(a->text), scale);
    }
    assert_false(isnan(value[1]));
    for (int k = 0; k < 2; k++)
        ends[k] = value[0] + (value[1] - value[0]) * ((k ? frame->low : frame->high)[1] - at[0]) / (at[1] - at[0]);
}

#define SHORT    "chain: {" STRIKER "beads: [{bead: large-steel, count: 6}, {bead: ptfe, sensor: s}]}\nsimulate: {until: 0.1 ms}\n"
#define PRESSED  "chain: {precompression: 100 N, beads: [{cell: [large-steel, aluminium], count: 6}], wall: brass}\n"
#define TWO_WAYS "sweep: {cells: 4, magnetism: [0, 0.5], configurations: 2}\n"
#define DECAY    "sweep: {cells: 4, magnetism: [0, 0.5], configurations: 2, measure: {decay: true}}\n"
#define TWO_KEYS                                                                                                             \
    "chain: {" STRIKER "beads: [{bead: small-steel, count: 3}, {bead: small-steel, sensor: s}]}\nsimulate: {until: 60 us}\n" \
    "sweep: {over: {chain.striker.velocity: [0.1 m/s, 1 m/s]}}\n"

/* Axes have the range that is asked for; otherwise the first ones here begin at 0 and reach beyond what is shown. */
static void ranges_are_those_asked_for(void **)
{
    static const struct {
        const char *scene, *plot, *unit;
        double low, high;
        int scale;
        bool any; /* where it ends otherwise */
    } plots[] = {
        {"sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\n", "plot: %zu.pdf", "", 0.3, 0.8, 0, false},
        {SHORT, "plot: %zu.pdf, show: sensors, beads: [2]", " N", 20, 80, 0, false},
        {SHORT, "plot: %zu.pdf, show: peaks", " N", 20, 80, 0, false},
        {SHORT, "plot: %zu.pdf, show: peaks, scale: log", " N", 0.3, 600, 1, true},
        {SHORT, "plot: %zu.pdf, show: energy", "e-3", 3, 9, 0, true},
        {SHORT, "plot: %zu.pdf, show: profiles, at: [50 us]", " N", 20, 80, 0, true},
        {SHORT, "plot: %zu.pdf, show: spreading", "", 0.4, 6, 1, true},
        {SHORT, "plot: %zu.pdf, show: spectrum, beads: [1]", " N", 1, 8, 0, true},
        {PRESSED, "plot: %zu.pdf, show: bands", "e3", 5, 30, 0, true},
        {PRESSED, "plot: %zu.pdf, show: eigenmodes", "", 2, 8, 0, true},
        {DECAY, "plot: %zu.pdf, show: decay", "", 0.2, 1.5, 1, true},
        {TWO_WAYS, "plot: %zu.pdf, show: mean", "", 0.2, 1.5, 0, true},
        {TWO_KEYS, "plot: %zu.pdf", "", 20, 80, 0, true},
    };
    for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) {
        enum { ASKED = 4 };
        char text[2000];
        int used = snprintf(text, sizeof text, "%soutputs:\n", plots[i].scene);
        for (size_t k = plots[i].any; k < ASKED; k++) {
            char low[20] = "auto", high[20] = "auto";
            if (k & 1)
                snprintf(low, sizeof low, "%g%s", plots[i].low, plots[i].unit);
            if (k & 2)
                snprintf(high, sizeof high, "%g%s", plots[i].high, plots[i].unit);
            used += snprintf(text + used, sizeof text - (size_t)used, "  - {");
            used += snprintf(text + used, sizeof text - (size_t)used, plots[i].plot, k);
            used += snprintf(text + used, sizeof text - (size_t)used, ", range: [%s, %s]}\n", low, high);
        }
        drawn_run(text, &drawn);
        for (size_t k = plots[i].any; k < ASKED; k++) {
            const double wanted[2] = {scaled(plots[i].low, plots[i].scale), scaled(plots[i].high, plots[i].scale)};
            double ends[2];
            ends_of_axis(&drawn, k - plots[i].any, plots[i].scale, ends);
            const double near = 0.005 * (ends[1] - ends[0]);
            for (int end = 0; end < 2; end++) {
                const bool asked = k & (1u << end);
                if (!(asked          ? fabs(ends[end] - wanted[end]) < near
                      : plots[i].any ? true
                      : end          ? ends[1] > 1.2 * wanted[1]
                                     : fabs(ends[0]) < near))
                    fail_msg("%s, range %zu: from %g to %g", plots[i].plot, k, ends[0], ends[1]);
            }
        }
    }
}

/* Bars are level with their images, with the points at their ends, where values are beyond them. */
static void bars_are_level_with_images(void **)
{
    static const struct {
        const char *image;
        size_t points; /* of the outline */
    } images[] = {{"field: force", 4}, {"field: force, range: [auto, 20]", 5}, {"field: velocity, range: [-0.05, 0.05]", 6}};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        char text[500];
        size_t bars = 0;
        snprintf(text, sizeof text,
                 "chain: {" STRIKER "beads: [{bead: large-steel, count: 14}], wall: brass}\nsimulate: {until: 0.3 ms}\n"
                 "outputs: [{image: a.pdf, %s, style: paper, size: [140 mm, 90 mm], dpi: 381}]\n",
                 images[i].image);
        drawn_run(text, &drawn);
        const struct stroke *frame = NULL;
        for (size_t j = 0; j < strokes.count && !frame; j++)
            frame = is_on_page(j, 0) && is_frame(&strokes.list[j]) ? &strokes.list[j] : NULL;
        assert_non_null(frame);
        for (size_t j = 0; j < strokes.count; j++) {
            const struct stroke *s = &strokes.list[j];
            if (!is_on_page(j, 0) || s->filled || s->low[0] < frame->high[0] || s->high[0] - s->low[0] < 3 || s->count < 4 ||
                s->begun > 1)
                continue;
            if (fabs(s->low[1] - frame->low[1]) > 1 || fabs(s->high[1] - frame->high[1]) > 1 || s->count < images[i].points)
                fail_msg("%s: a bar of %zu points from %g to %g beside an image from %g to %g", images[i].image, s->count,
                         s->low[1], s->high[1], frame->low[1], frame->high[1]);
            bars++;
        }
        assert_int_equal(bars, 1);
    }
}

/* Of two magnetisms, in a plot of few of them. */
static void each_configuration_has_a_point(void **)
{
    size_t points[2] = {0, 0};
    for (size_t k = 0; k < 2; k++) {
        char text[200];
        snprintf(text, sizeof text, "sweep: {cells: 4, magnetism: [0, 0.5], configurations: %zu}\noutputs: [{plot: a.pdf}]\n",
                 6 + k);
        drawn_run(text, &drawn);
        for (size_t j = 0; j < drawn.marks; j++) {
            const struct mark *m = &drawn.mark[j];
            points[k] += m->filled && m->high[0] > m->low[0] && m->high[0] - m->low[0] < 6;
        }
    }
    assert_true(points[0] >= 2 * 6);
    assert_int_equal(points[1] - points[0], 2);
}

/* Without axes a plot is as wide as the page. */
static void bare_plots_fill_the_page(void **)
{
    drawn_run("chain: {" STRIKER "beads: [{bead: large-steel, count: 4}]}\nsimulate: {until: 0.1 ms}\n"
              "outputs: [{image: a.pdf, views: [profile], axes: false, style: paper, size: [127 mm, 50.8 mm], dpi: 72}]\n",
              &drawn);
    size_t curves = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        if (s->count < 5)
            continue;
        assert_true(fabs(s->clip_low[0]) < 0.1 && fabs(s->clip_high[0] - 360) < 0.1);
        assert_true(fabs(s->clip_low[1]) < 0.1 && fabs(s->clip_high[1] - 144) < 0.1);
        curves++;
    }
    assert_true(curves > 0);
}

/* A scale from the first and the last number of the lowest row, or the first two of the first column beside what a page shows. */
struct scale {
    double at[2], value[2];
    size_t count;
};

static double on_scale(const struct scale *s, double at)
{
    return s->value[0] + (s->value[1] - s->value[0]) * (at - s->at[0]) / (s->at[1] - s->at[0]);
}

static void find_scales(const struct drawn *d, size_t page, struct scale scale[2])
{
    double lowest = 0;
    for (size_t i = 0; i < d->texts; i++)
        lowest = d->text[i].page == page && !isnan(number_of(d->text[i].text)) ? fmax(lowest, d->text[i].centre[1]) : lowest;
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        if (a->page != page || isnan(number_of(a->text)))
            continue;
        const int along = a->centre[1] < lowest - 1;
        struct scale *s = &scale[along];
        const int k = s->count++ > 0;
        if (along && s->count > 2)
            continue;
        s->at[k] = along ? (a->low[1] + a->high[1]) / 2 : a->centre[0];
        s->value[k] = number_of(a->text);
    }
    assert_true(scale[0].count > 1 && scale[1].count > 1);
}

/* The exponents of straight lines between logarithmic axes are those that the legend says: of both fits, and of both theories,
 * which begin where the fit of the second moment does. */
static void power_laws_have_their_exponents(void **)
{
    enum { LAWS = 4 };
    static const double near = 0.008;
    struct scale scale[2] = {{.count = 0}, {.count = 0}};
    double wanted[LAWS] = {2, 1}, begin[2] = {0, 0};
    size_t said = 2, found[LAWS] = {0}, lines = 0;
    drawn_run("chain: {" STRIKER "beads: [{cell: [large-steel, aluminium], count: 20, spins: random}]}\nsimulate: {until: 0.6 ms}\n"
              "outputs: [{plot: a.pdf, show: spreading, theory: true, range: [1, 900], style: paper, size: [150 mm, 120 mm], dpi: "
              "381}]\n",
              &drawn);
    find_scales(&drawn, 0, scale);
    for (size_t i = 0; i < drawn.texts; i++) {
        const char *text = drawn.text[i].text;
        if (strncmp(text, "exponent ", 9) == 0 && said < LAWS)
            wanted[said++] = strtod(text + 9, NULL);
        assert_true(!strstr(text, "theory") || strstr(text, "ballistic, exponent 2") || strstr(text, "diffusion, exponent 1"));
    }
    assert_int_equal(said, LAWS);
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        const double x[2] = {s->at[0].x, s->at[s->count - 1].x}, y[2] = {s->at[0].y, s->at[s->count - 1].y};
        if (s->filled || s->count != 2 || s->dashes == 0 || fabs(x[1] - x[0]) < 20 || fabs(y[1] - y[0]) < 1)
            continue;
        double at[2][2];
        for (int k = 0; k < 2; k++) {
            at[0][k] = log10(scale[0].value[0]) +
                       log10(scale[0].value[1] / scale[0].value[0]) * (x[k] - scale[0].at[0]) / (scale[0].at[1] - scale[0].at[0]);
            at[1][k] = log10(scale[1].value[0]) +
                       log10(scale[1].value[1] / scale[1].value[0]) * (y[k] - scale[1].at[0]) / (scale[1].at[1] - scale[1].at[0]);
        }
        const double exponent = (at[1][1] - at[1][0]) / (at[0][1] - at[0][0]);
        size_t law = 0;
        while (law < LAWS && fabs(exponent - wanted[law]) > near)
            law++;
        if (law == LAWS)
            fail_msg("a line has the exponent %g", exponent);
        found[law]++;
        lines++;
        if (law < 2 || fabs(exponent - wanted[2]) <= near) {
            assert_true(begin[0] == 0 || (fabs(x[0] - begin[0]) < 0.1 && fabs(y[0] - begin[1]) < 0.1));
            begin[0] = x[0], begin[1] = y[0];
        }
    }
    for (size_t law = 0; law < LAWS; law++)
        assert_true(found[law] > 0);
    assert_true(lines >= LAWS);
}

/* What the curve with most points shows there. */
static double shown_at(const struct drawn *d, size_t page, double x)
{
    struct scale scale[2] = {{.count = 0}, {.count = 0}};
    const struct stroke *curve = NULL;
    find_scales(d, page, scale);
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        curve = is_on_page(j, page) && !s->filled && s->begun == 1 && (!curve || s->count > curve->count) ? s : curve;
    }
    for (size_t i = 1; i < curve->count; i++) {
        const struct stroke_point *a = &curve->at[i - 1], *b = &curve->at[i];
        const double from = on_scale(&scale[0], a->x), to = on_scale(&scale[0], b->x);
        if (from <= x && x <= to)
            return on_scale(&scale[1], a->y + (b->y - a->y) * (x - from) / (to - from));
    }
    return NAN;
}

/* An image shows the profile that a plot of profiles has, at any time between samples, also of stored ones. */
static void images_show_their_time(void **)
{
    enum { TIMES = 4, FIRST = 2, LAST = 9 };
    static const char *const times[TIMES] = {"50 us", "50.2 us", "50.5 us", "50.8 us"};
    char text[3000], run[512], out[512];
    double force[TIMES][LAST + 1];
    int used = snprintf(text, sizeof text,
                        "chain: {" STRIKER "beads: [{bead: large-steel, count: 14}]}\nsimulate: {until: 60 us}\noutputs:\n"
                        "  - {trajectory: run.h5, every: 1 us}\n");
    for (size_t i = 0; i < TIMES; i++)
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "  - {image: %zua.pdf, views: [profile, spacetime], orientation: time-down, field: contact-force, at: %s, "
                         "style: paper, size: [120 mm, 200 mm], dpi: 72}\n"
                         "  - {plot: %zub.pdf, show: profiles, field: contact-force, at: [%s], style: paper}\n",
                         i, times[i], i, times[i]);
    drawn_run(text, &drawn);
    assert_int_equal(drawn.pages, 2 * TIMES);
    for (size_t i = 0; i < TIMES; i++) {
        for (int contact = FIRST; contact <= LAST; contact++) { /* forces up to 200 N */
            force[i][contact] = shown_at(&drawn, 2 * i + 1, contact);
            assert_true(fabs(shown_at(&drawn, 2 * i, contact) - force[i][contact]) < 1);
        }
        assert_true(i == 0 || force[i - 1][FIRST] > force[i][FIRST] + 1);
    }
    in_directory("run.h5", run, sizeof run);
    for (size_t i = 0; i < TIMES; i++) {
        snprintf(text, sizeof text, "%zua.pdf", i);
        in_directory(text, out, sizeof out);
        drawn_play((struct bead_job){.input = run, .output = out, .threads = 1}, &drawn);
        for (int contact = FIRST; contact <= LAST; contact++)
            assert_true(fabs(shown_at(&drawn, 0, contact) - force[i][contact]) < 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_axes_are_labelled_once),
        cmocka_unit_test(stacks_have_what_there_is),
        cmocka_unit_test(times_have_the_digits_they_need),
        cmocka_unit_test(magnetisms_have_the_digits_they_need),
        cmocka_unit_test(sensors_have_rings),
        cmocka_unit_test(ranges_are_those_asked_for),
        cmocka_unit_test(power_laws_have_their_exponents),
        cmocka_unit_test(bars_are_level_with_images),
        cmocka_unit_test(images_show_their_time),
        cmocka_unit_test(each_configuration_has_a_point),
        cmocka_unit_test(bare_plots_fill_the_page),
    };
    return cmocka_run_group_tests_name("parts of pages", tests, make_directory, remove_directory);
}
