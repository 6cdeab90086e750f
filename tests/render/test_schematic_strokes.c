/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strokes of schematic drawings as numbers: each part is where geometry puts it. */
#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "strokes.h"
#include "tests/schematics.h"

#define COLOURED                                                                                    \
    "materials: {red: {mass: 1 g, radius: 4 mm, modulus: 1 GPa, poisson: 0, colour: \"#ff0000\"}, " \
    "blue: {mass: 1 g, radius: 2 mm, modulus: 1 GPa, poisson: 0, colour: \"#0000ff\"}, "            \
    "huge: {mass: 1 g, radius: 40 mm, modulus: 1 GPa, poisson: 0}}\n"

/* ---- what all drawings are made of ---- */

struct sheet {
    struct bead_look look;
    struct bead_sketch sketch;
    cairo_surface_t *surface;
};

static void open_sheet(struct sheet *s)
{
    *s = (struct sheet){.surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 800, 600)};
    bead_look_screen(&s->look, 1000, 800, false);
    s->look.label = 20;
    s->look.line = 2;
    s->sketch = (struct bead_sketch){.cr = cairo_create(s->surface), .look = &s->look};
    strokes_begin();
}

static void close_sheet(struct sheet *s)
{
    bead_sketch_free(&s->sketch);
    cairo_destroy(s->sketch.cr);
    cairo_surface_destroy(s->surface);
}

static void assert_point(const struct stroke *s, size_t at, double x, double y)
{
    assert_true(at < s->count);
    assert_at(s->at[at].x, x);
    assert_at(s->at[at].y, y);
}

/* A head's tip, and its base of 0.3 em, 0.42 em behind. */
static void assert_head(const struct stroke *s, double x, double y, double along_x, double along_y)
{
    const double em = 20;
    assert_true(s->filled && s->count == 3);
    assert_point(s, 0, x, y);
    assert_point(s, 1, x - 0.42 * em * along_x + 0.15 * em * along_y, y - 0.42 * em * along_y - 0.15 * em * along_x);
    assert_point(s, 2, x - 0.42 * em * along_x - 0.15 * em * along_y, y - 0.42 * em * along_y + 0.15 * em * along_x);
}

static void arrows_have_heads_at_their_ends(void **)
{
    struct sheet s;
    open_sheet(&s);
    for (int both = 0; both < 2; both++) {
        const double back = 0.8 * 0.42 * 20; /* the shaft ends within the head */
        strokes_begin();
        bead_sketch_arrow(&s.sketch, 100, 200, 300, 350, both);
        assert_int_equal(strokes.count, 2 + both);
        assert_point(&strokes.list[0], 0, 100 + both * 0.8 * back, 200 + both * 0.6 * back);
        assert_point(&strokes.list[0], 1, 300 - 0.8 * back, 350 - 0.6 * back);
        assert_head(&strokes.list[1], 300, 350, 0.8, 0.6);
        if (both)
            assert_head(&strokes.list[2], 100, 200, -0.8, -0.6);
    }
    strokes_begin();
    bead_sketch_arrow(&s.sketch, 100, 200, 100, 206, false); /* shorter than its head */
    assert_point(&strokes.list[0], 1, 100, 203);
    assert_head(&strokes.list[1], 100, 206, 0, 1);
    strokes_begin();
    bead_sketch_arrow(&s.sketch, 100, 200, 100, 200, true);
    assert_int_equal(strokes.count, 0);
    close_sheet(&s);
}

/* Symmetric, from its ends to its point. */
static void braces_are_symmetric(void **)
{
    struct sheet s;
    open_sheet(&s);
    cairo_set_source_rgb(s.sketch.cr, 1, 1, 1);
    for (int narrow = 0; narrow < 2; narrow++) {
        const double x0 = 100, x1 = narrow ? 140 : 400, depth = 15, bend = narrow ? 10 : 15;
        const double ends[9][2] = {
            {x0, 50},          {x0 + bend, 57.5}, {(x0 + x1) / 2 - bend, 57.5}, {(x0 + x1) / 2, 65}, {(x0 + x1) / 2 + bend, 57.5},
            {x1 - bend, 57.5}, {x1, 50}};
        strokes_begin();
        bead_sketch_brace(&s.sketch, x0, x1, 50 + 200 * narrow, depth);
        assert_int_equal(strokes.list[0].count, narrow ? 5 : 7);
        for (size_t i = 0, k = 0; i < 7; i++) {
            if (narrow && (i == 2 || i == 5)) /* lines of no length */
                continue;
            assert_point(&strokes.list[0], k++, ends[i][0], ends[i][1] + 200 * narrow);
        }
    }
    /* So are its bends, to a level of grey: about the middle of the wide one. */
    cairo_surface_flush(s.surface);
    const unsigned char *data = cairo_image_surface_get_data(s.surface);
    size_t inked = 0;
    for (int y = 48; y < 68; y++) {
        const unsigned char *row = data + y * cairo_image_surface_get_stride(s.surface);
        for (int x = 90; x < 250; x++) {
            inked += row[4 * x] != row[4];
            assert_true(abs(row[4 * x] - row[4 * (499 - x)]) <= 2);
        }
    }
    assert_true(inked > 200);
    close_sheet(&s);
}

/* Equal steps of slanted lines, clipped to the rectangle and all over it; three dots; dashes. */
static void rectangles_are_hatched_all_over(void **)
{
    struct sheet s;
    static const double colour[] = {0.25, 0.5, 0.75};
    const double step = 0.42 * 20;
    open_sheet(&s);
    for (int filled = 0; filled < 2; filled++) {
        strokes_begin();
        bead_sketch_hatch(&s.sketch, (struct bead_box){50, 60, 70, 200}, filled ? colour : NULL);
        const struct stroke *line = &strokes.list[filled];
        const size_t lines = (size_t)ceil((200 + 70) / step);
        assert_int_equal(strokes.count, (size_t)filled + lines);
        if (filled)
            assert_bounds(&strokes.list[0], 50, 60, 120, 260);
        assert_true(!filled || stroke_has(&strokes.list[0], true, (struct bead_rgb){0.25, 0.5, 0.75}));
        for (size_t i = 0; i < lines; i++) {
            assert_true(stroke_has(&line[i], false, s.look.ink) && fabs(line[i].width - 1.4) < 1e-9);
            assert_true(line[i].clip_low[0] == 50 && line[i].clip_high[0] == 120 && line[i].clip_low[1] == 60);
            assert_point(&line[i], 0, 50 - 200 + step * (double)i, 260);
            assert_point(&line[i], 1, 50 + step * (double)i, 60);
        }
    }
    strokes_begin();
    bead_sketch_dots(&s.sketch, 300, 100, 80);
    assert_int_equal(strokes.count, 3);
    for (int i = 0; i < 3; i++) {
        assert_at(strokes.list[i].low[0], 300 + 0.27 * (i - 1) * 80 - 0.085 * 20);
        assert_at(strokes.list[i].high[0], 300 + 0.27 * (i - 1) * 80 + 0.085 * 20);
        assert_at(strokes.list[i].at[0].y, 100);
        assert_true(stroke_has(&strokes.list[i], true, s.look.ink));
    }
    strokes_begin();
    bead_sketch_ball(&s.sketch, 200, 150, 40, colour);
    assert_at(strokes.list[0].low[0], 160);
    assert_at(strokes.list[0].high[0], 240);
    assert_at(strokes.list[0].at[0].y, 150);
    cairo_surface_flush(s.surface);
    const unsigned char *data = cairo_image_surface_get_data(s.surface);
    int light[3]; /* in the light, at the middle, on the shadow's side: green is half */
    for (int i = 0; i < 3; i++)
        light[i] = data[cairo_image_surface_get_stride(s.surface) * (150 + (int[]){-14, 0, 24}[i]) +
                        4 * (200 + (int[]){-12, 0, 24}[i]) + 1];
    assert_true(light[0] > 1.25 * 128 && light[1] < light[0] && light[1] > 0.95 * 128 && light[2] < 0.85 * 128 &&
                light[2] > 0.6 * 128);
    for (int dashed = 1; dashed >= 0; dashed--) {
        strokes_begin();
        bead_sketch_dashed(&s.sketch, dashed);
        bead_sketch_line(&s.sketch, 1, 2, 30, 40);
        assert_true(strokes.list[0].dashes == dashed && (!dashed || strokes.list[0].dash[0] == 0.3 * 20));
    }
    close_sheet(&s);
}

/* Each as near to its anchor as the others let it: those that touch share the way, on the mean 0, and all are within the ends. */
static void labels_are_near_their_anchors(void **)
{
    static const struct {
        size_t count;
        double anchor[4], width[4], middle[4]; /* expected */
    } rows[] = {{1, {50}, {20}, {50}},
                {2, {50, 100}, {20, 40}, {50, 100}},
                {2, {100, 100}, {40, 20}, {80, 120}},  /* 10 px apart: 20 + 10 + 10 between middles */
                {2, {100, 130}, {20, 20}, {100, 130}}, /* just touching */
                {2, {100, 128}, {20, 20}, {99, 129}},
                {3, {100, 120, 150}, {20, 20, 20}, {93.0 + 1.0 / 3, 123.0 + 1.0 / 3, 153.0 + 1.0 / 3}},
                {3, {5, 60, 500}, {30, 20, 30}, {15, 60, 385}}, /* ends at 0 and 400 */
                {4, {100, 110, 300, 305}, {20, 20, 20, 20}, {90, 120, 287.5, 317.5}}};
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        struct bead_label labels[4] = {0};
        for (size_t i = 0; i < rows[r].count; i++)
            labels[i] = (struct bead_label){rows[r].anchor[i], rows[r].width[i], 0};
        assert_true(bead_labels_spread(labels, rows[r].count, 10, 0, 400));
        for (size_t i = 0; i < rows[r].count; i++)
            assert_at(labels[i].x + labels[i].width / 2, rows[r].middle[i]);
    }
    struct bead_label tight[] = {{300, 50, 0}, {300, 60, 0}, {300, 70, 0}};
    assert_true(bead_labels_spread(tight, 3, 10, 100, 300)); /* 50 + 60 + 70 and two gaps: all the room */
    assert_true(fabs(tight[0].x - 100) < 1e-9 && fabs(tight[1].x - 160) < 1e-9 && fabs(tight[2].x - 230) < 1e-9);
    assert_false(bead_labels_spread(tight, 3, 10, 100, 299));
    assert_true(bead_labels_spread(tight, 0, 10, 100, 100));
    static struct bead_label many[BEAD_LABELS + 1];
    assert_true(bead_labels_spread(many, BEAD_LABELS, 1, 0, 1000));
    assert_false(bead_labels_spread(many, BEAD_LABELS + 1, 1, 0, 1000));
}

/* Texts that touch are apart, those that overlap in both ways crowd; so does what leaves the page. */
static void crowds_are_noticed(void **)
{
    static const struct {
        struct bead_box box;
        bool crowded;
    } others[] = {{{150, 100, 30, 20}, false}, {{149, 100, 30, 20}, true}, {{70, 100, 30, 20}, false}, {{71, 100, 30, 20}, true},
                  {{110, 120, 9, 20}, false},  {{110, 119, 9, 20}, true},  {{110, 80, 9, 20}, false},  {{110, 81, 9, 20}, true},
                  {{0, 0, 200, 50}, false},    {{-1, 0, 10, 10}, true},    {{0, -1, 10, 10}, true},    {{191, 0, 10, 10}, true},
                  {{0, 191, 10, 10}, true},    {{190, 190, 10, 10}, false}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        struct bead_box boxes[] = {{100, 100, 50, 20}, others[i].box};
        const struct bead_sketch sketch = {.boxes = boxes, .count = 2};
        if (bead_sketch_crowded(&sketch, 200, 200) != others[i].crowded)
            fail_msg("case %zu", i);
    }
    struct sheet s;
    open_sheet(&s);
    struct bead_text_style style = bead_sketch_style(&s.sketch, 20);
    const double width = bead_sketch_width(&style, "words");
    for (int across = 0; across < 3; across++) {
        style.across = (enum bead_align[]){BEAD_ALIGN_START, BEAD_ALIGN_MIDDLE, BEAD_ALIGN_END}[across];
        bead_sketch_text(&s.sketch, &style, 300, 200, "words");
        const struct bead_box *kept = &s.sketch.boxes[across];
        assert_at(kept->x, 300 - 0.5 * across * width);
        assert_at(kept->y, 200 - 0.55 * 20);
        assert_at(kept->width, width);
        assert_at(kept->height, 2 * 0.55 * 20);
    }
    bead_sketch_text(&s.sketch, &style, 300, 200, "");
    assert_int_equal(s.sketch.count, 3);
    close_sheet(&s);
}

/* Lines of pieces from the bottom up, filled from the left, each in its middle; the area loses their height. */
static void pieces_fill_their_lines(void **)
{
    static const double colour[] = {1, 0, 0};
    struct sheet s;
    open_sheet(&s);
    struct bead_piece pieces[5] = {{"one", NULL}, {"two", NULL}, {"three", colour}, {"four", NULL}, {"five", NULL}};
    const double em = 20, apart = 1.6 * em, room = (2 * 0.42 + 0.4) * em; /* of a ball */
    struct bead_text_style style = bead_sketch_style(&s.sketch, em);
    double width[5];
    for (int i = 0; i < 5; i++)
        width[i] = bead_sketch_width(&style, pieces[i].markup) + (pieces[i].colour ? room : 0);
    const double first = width[0] + width[1] + width[2] + 2 * apart, second = width[3] + width[4] + apart;
    assert_true(second < first);
    for (int centred = 0; centred < 2; centred++) {
        struct bead_box area = {30, 40, first + 0.01, 300};
        s.sketch.count = 0;
        strokes_begin();
        assert_true(bead_sketch_pieces(&s.sketch, &area, pieces, 5, centred));
        assert_int_equal(s.sketch.count, 5);
        const double lines = 2 * 1.45 * em, below = 0.4 * em;
        assert_true(area.x == 30 && area.y == 40 && fabs(area.height - (300 - lines - below)) < 1e-9);
        double x = 30;
        for (int i = 0; i < 5; i++) {
            if (i == 3)
                x = 30 + (centred ? 0.5 * (first - second) : 0);
            assert_at(s.sketch.boxes[i].x, x + (pieces[i].colour ? room : 0));
            assert_at(s.sketch.boxes[i].y + 0.55 * em, 340 - lines + 1.45 * em * (i < 3 ? 0.5 : 1.5));
            if (pieces[i].colour) {
                assert_at(strokes.list[0].low[0], x);
                assert_at(strokes.list[0].high[0], x + 2 * 0.42 * em);
                assert_at(strokes.list[0].at[0].y, 340 - lines + 1.45 * em * 0.5);
            }
            x += width[i] + apart;
        }
        area = (struct bead_box){30, 40, first - 0.01, 300}; /* three lines */
        assert_true(bead_sketch_pieces(&s.sketch, &area, pieces, 5, centred) && area.height < 300 - lines - below - 1);
        area = (struct bead_box){30, 40, first + 0.01, lines - 0.01};
        assert_false(bead_sketch_pieces(&s.sketch, &area, pieces, 5, centred));
        area = (struct bead_box){30, 40, width[2] - 0.01, 300};
        assert_false(bead_sketch_pieces(&s.sketch, &area, pieces, 5, centred));
        area = (struct bead_box){30, 40, 100, 300};
        assert_true(bead_sketch_pieces(&s.sketch, &area, pieces, 0, centred) && area.height == 300);
    }
    close_sheet(&s);
}

/* ---- contacts ---- */

static struct bead_look look_of(const struct staged *s)
{
    struct bead_message msg = {""};
    struct bead_page page;
    struct bead_look look;
    assert_int_equal(bead_page_find(&s->scene->outputs[0], &page, &msg), BEAD_OK);
    bead_page_look(&page, &s->scene->outputs[0].paper, &look);
    return look;
}

/* The middle of the ink of the n-th text with these words; a symbol alone, not in formulas. */
static void middle_of(const struct seen *seen, const char *text, size_t n, double at[2])
{
    for (size_t i = 0; i < seen->count; i++) {
        if (!strstr(seen->box[i].text, text) || (*text == '<' && strcmp(seen->box[i].text, text) != 0) || n-- > 0)
            continue;
        at[0] = seen->box[i].x + seen->box[i].width / 2;
        at[1] = seen->box[i].y + seen->box[i].height / 2;
        return;
    }
    fail_msg("nothing says '%s'", text);
}

/* Whole lines of two points in this colour, in the order drawn. */
static size_t lines_of(struct bead_rgb ink, const struct stroke *lines[], size_t most)
{
    size_t count = 0;
    for (size_t i = 0; i < strokes.count && count < most; i++) {
        if (strokes.list[i].count == 2 && strokes.list[i].dashes == 0 && stroke_has(&strokes.list[i], false, ink))
            lines[count++] = &strokes.list[i];
    }
    return count;
}

/* Each triangle of centre, foot and end of the chord: R - delta, q and R; its right angle towards the chord's side of its own bead;
 * the dimensions of delta from the chord to the original outlines. */
static void contacts_have_their_triangles(void **)
{
    static const struct {
        const char *chain;
        double radius[2]; /* m; 0: no triangle */
        double wall;      /* the chord is a wall's face */
    } cases[] = {{"{beads: [{bead: red}, {bead: blue}]}", {4e-3, 2e-3}, false},
                 {"{beads: [{bead: blue}, {bead: red}]}", {2e-3, 4e-3}, false},
                 {"{beads: [{bead: red, count: 3}]}", {4e-3, 0}, false},
                 {"{beads: [{bead: blue, count: 3}, {bead: huge}]}", {2e-3, 0}, false},
                 {"{beads: [{bead: huge}, {bead: blue, count: 3}]}", {0, 2e-3}, false},
                 {"{beads: [{bead: red}], wall: blue}", {4e-3, 0}, true},
                 {"{beads: [{bead: red}], wall: rigid}", {4e-3, 0}, true}};
    static const size_t contacts[] = {1, 1, 1, 3, 1, 1, 1};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int deep = 0; deep < 2; deep++) {
            const double part = deep ? 0.45 : 0.1;
            char text[1500];
            struct seen seen = {.count = 0};
            snprintf(text, sizeof text,
                     COLOURED
                     "chain: %s\noutputs: [{plot: a.png, show: contact, contact: %zu, compression: %g, size: [1600, 1000]}]\n",
                     cases[i].chain, contacts[i], part);
            struct staged *s = set_stage(text);
            const struct bead_look look = look_of(s);
            const double em = look.label, small = i == 2 || i >= 5 ? 4e-3 : 2e-3, q = small * sqrt(1 - (1 - part) * (1 - part));
            strokes_begin();
            assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
            const struct stroke *lines[12];
            size_t count = lines_of(look.accent, lines, 12), at = 0;
            const struct stroke *chord = lines[count - 1];
            const double foot = chord->at[0].x, level = (chord->low[1] + chord->high[1]) / 2,
                         scale = (chord->high[1] - chord->low[1]) / (2 * q);
            assert_true(chord->at[1].x == foot && fabs(chord->width - 2 * look.line) < 1e-9);
            double centre[2] = {0, 0};
            for (int side = 0; side < 2; side++) {
                const double radius = cases[i].radius[side], sign = side ? 1 : -1, leg = sqrt(radius * radius - q * q);
                if (radius == 0)
                    continue;
                centre[side] = foot + sign * scale * leg;
                assert_point(lines[at], 0, centre[side], level);
                assert_point(lines[at], 1, foot, level);
                assert_point(lines[at + 1], 0, centre[side], level);
                assert_point(lines[at + 1], 1, foot, level - scale * q);
                assert_point(lines[at + 2], 0, foot, level - 0.4 * em);
                assert_point(lines[at + 2], 1, foot + sign * 0.4 * em, level - 0.4 * em);
                assert_point(lines[at + 3], 1, foot + sign * 0.4 * em, level);
                assert_true(fabs(lines[at]->width - 1.4 * look.line) < 1e-9);
                at += 4;
                /* R is 0.95 em from the middle of its line, perpendicular to it, on the upper side. */
                double said[2], name[2];
                char symbol[160];
                bead_symbol_words("R", i < 2 || i == 3 || i == 4 ? side + 1 : 0, symbol, sizeof symbol);
                middle_of(&seen, symbol, 0, said);
                const double length = scale * radius, up_x = sign * scale * q / length, up_y = -scale * leg / length;
                const double off_x = said[0] - (centre[side] + foot) / 2, off_y = said[1] - (level + level - scale * q) / 2;
                assert_true(fabs(off_x - 0.95 * em * up_x) < 0.25 * em && fabs(off_y - 0.95 * em * up_y) < 0.3 * em);
                middle_of(&seen, radius == 4e-3 ? "red" : "blue", 0, name);
                if (i < 2 || i >= 5)
                    assert_true(fabs(name[0] - centre[side]) < 0.5 * em && name[1] < level - scale * radius);
            }
            assert_int_equal(at, count - 1);
            /* Outlines: the remaining parts in ink, the original ones dashed and faint, both from one end of the chord to the
             * other; a wall's face. */
            size_t outlines[2] = {0, 0}, faces = 0;
            for (size_t j = 0; j < strokes.count; j++) {
                const struct stroke *out = &strokes.list[j];
                if (out->filled || fabs(out->width - 1.6 * look.line) > 1e-9)
                    continue;
                const struct stroke_point *from = &out->at[0], *to = &out->at[out->count - 1];
                assert_true(stroke_has(out, false, out->dashes ? look.faint : look.ink));
                assert_at(from->x, foot);
                assert_at(to->x, foot);
                if (cases[i].wall && out->count == 2 && !out->dashes) {
                    faces++;
                    assert_bounds(out, foot, level - scale * 4e-3, foot, level + scale * 4e-3);
                    continue;
                }
                outlines[out->dashes]++;
                assert_at(fabs(from->y - level), scale * q);
                assert_at(from->y + to->y, 2 * level);
            }
            assert_true(outlines[0] == (cases[i].wall ? 1 : 2) && outlines[1] == outlines[0] && faces == cases[i].wall);
            /* The verticals of the dimensions. */
            count = lines_of(look.faint, lines, 12);
            const double small_right = cases[i].radius[1] > 0 ? cases[i].radius[1]
                                       : i == 3               ? 40e-3
                                                              : 4e-3,
                         small_left = cases[i].radius[0] > 0 ? cases[i].radius[0] : 40e-3;
            const double left = scale * (small_right - sqrt(small_right * small_right - q * q)),
                         right = scale * (small_left - sqrt(small_left * small_left - q * q));
            const double ends[] = {foot - (cases[i].wall ? 0 : left), foot, foot + right};
            size_t k = 0;
            for (size_t end = 0; end < 3; end++) {
                if (end == 0 && cases[i].wall)
                    continue;
                assert_true(k < count && lines[k]->at[0].x == lines[k]->at[1].x);
                assert_at(lines[k]->at[0].x, ends[end]);
                assert_at(lines[k]->at[0].y, end == 1 ? level + scale * q + 0.3 * em : level);
                assert_at(lines[k]->at[1].y, lines[0]->at[1].y);
                k++;
            }
            assert_int_equal(k, count);
            /* Between them if two heads fit, else from outside. */
            size_t heads = 0;
            const bool inside = (cases[i].wall || left > 1.3 * em) && right > 1.3 * em;
            for (size_t j = 0; j < strokes.count; j++) {
                const struct stroke *head = &strokes.list[j];
                if (!head->filled || head->count != 3 || fabs(head->at[0].y - (lines[0]->at[1].y - 0.35 * em)) > 0.02)
                    continue;
                const double tip = head->at[0].x, base = head->at[1].x;
                heads++;
                assert_true(fabs(tip - ends[0]) < 0.02 || fabs(tip - ends[2]) < 0.02 || (inside && fabs(tip - ends[1]) < 0.02));
                if (fabs(tip - ends[0]) < 0.02 && ends[0] != ends[1])
                    assert_true(inside ? base > tip : base < tip);
                if (fabs(tip - ends[2]) < 0.02)
                    assert_true(inside ? base < tip : base > tip);
            }
            assert_int_equal(heads, inside ? (cases[i].wall ? 2 : 4) : 2);
            if (cases[i].wall) { /* one dimension, named in its middle */
                double said[2];
                char symbol[160];
                bead_symbol_words("δ", 0, symbol, sizeof symbol);
                middle_of(&seen, symbol, 0, said);
                assert_true(fabs(said[0] - (ends[1] + ends[2]) / 2) < 1 && said[1] > lines[0]->at[1].y);
            }
            clear_stage(s);
        }
    }
}

/* Bodies, outlines and dimensions: all that is not about one of the beads, from left to right. */
static bool has_mirror_image(const struct stroke *s, double width)
{
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *o = &strokes.list[j];
        if (o->filled == s->filled && o->dashes == s->dashes && o->width == s->width && o->surface == s->surface &&
            memcmp(o->rgb, s->rgb, sizeof s->rgb) == 0 && fabs(o->low[0] - width + s->high[0]) < 0.02 &&
            fabs(o->high[0] - width + s->low[0]) < 0.02 && fabs(o->low[1] - s->low[1]) < 0.02 &&
            fabs(o->high[1] - s->high[1]) < 0.02)
            return true;
    }
    return false;
}

/* The contact of two equal beads is its own mirror image, but for the triangle, which only one of them has, and the square of its
 * right angle. */
static void equal_beads_touch_evenly(void **)
{
    for (int deep = 0; deep < 2; deep++) {
        char text[1000];
        struct seen seen = {.count = 0};
        snprintf(text, sizeof text,
                 COLOURED "chain: {beads: [{bead: red, count: 3}]}\n"
                          "outputs: [{plot: a.png, show: contact, compression: %g, size: [1600, 1000]}]\n",
                 deep ? 0.45 : 0.1);
        struct staged *s = set_stage(text);
        const struct bead_look look = look_of(s);
        size_t mirrored = 0;
        strokes_begin();
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        for (size_t j = 0; j < strokes.count; j++) {
            const struct stroke *line = &strokes.list[j];
            if (stroke_has(line, line->filled, look.accent))
                continue;
            if (!has_mirror_image(line, 1600))
                fail_msg("%zu: from %g to %g, %g to %g there is no other", j, line->low[0], line->high[0], line->low[1],
                         line->high[1]);
            mirrored++;
        }
        assert_true(mirrored >= 2 + 2 + 4 + 3 + 2);
        clear_stage(s);
    }
}

/* The words below a contact have the numbers of Hertz's law: A = 4/3 E* sqrt(R*), with 1/E* and 1/R* the sums of both sides. */
static void formulas_have_the_contacts_numbers(void **)
{
    static const struct {
        const char *chain, *words[7]; /* in the syntax of labels */
        double modulus, radius;       /* E*, R* */
    } cases[] = {{"{beads: [{bead: red}, {bead: blue}]}",
                  {"*r̃*^2 + (*R_i* − *δ_i*)^2 = *R_i*^2", "*r̃*^2 ≈ 2*R*_1*δ*_1 ≈ 2*R*_2*δ*_2", "*R*_1 = 4.00\u00a0mm",
                   "*R*_2 = 2.00\u00a0mm", "*δ*_2 = 0.1 *R*_2", "*r̃* = 0.436 *R*_2", "(*δ*_1 + *δ*_2)"},
                  0.5e9,
                  4e-3 / 3},
                 {"{beads: [{bead: blue}, {bead: red}]}",
                  {"*r̃*^2 + (*R_i* − *δ_i*)^2 = *R_i*^2", "*r̃*^2 ≈ 2*R*_1*δ*_1 ≈ 2*R*_2*δ*_2", "*R*_1 = 2.00\u00a0mm",
                   "*R*_2 = 4.00\u00a0mm", "*δ*_1 = 0.1 *R*_1", "*r̃* = 0.436 *R*_1", "(*δ*_1 + *δ*_2)"},
                  0.5e9,
                  4e-3 / 3},
                 {"{beads: [{bead: red, count: 3}]}",
                  {"*r̃*^2 + (*R* − *δ*)^2 = *R*^2", "*r̃*^2 = 2*Rδ* − *δ*^2", "*R* = 4.00\u00a0mm", "*δ* = 0.1 *R*",
                   "*r̃* = 0.436 *R*", NULL, "(2*δ*)"},
                  0.5e9,
                  2e-3},
                 {"{beads: [{bead: red}], wall: blue}",
                  {"*R* = 4.00\u00a0mm", "*δ* = 0.1 *R*", "*r̃* = 0.436 *R*", NULL, NULL, NULL, "*δ*"},
                  0.5e9,
                  4e-3},
                 {"{beads: [{bead: red}], wall: rigid}",
                  {"*R* = 4.00\u00a0mm", "*δ* = 0.1 *R*", "*r̃* = 0.436 *R*", NULL, NULL, NULL, "*δ*"},
                  1e9,
                  4e-3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1500], markup[600];
        struct seen seen = {.count = 0};
        snprintf(text, sizeof text,
                 COLOURED "chain: %s\noutputs: [{plot: a.png, show: contact, contact: 1, compression: 0.1, size: [1600, 1000]}]\n",
                 cases[i].chain);
        struct staged *s = set_stage(text);
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        const double stiffness = 4.0 / 3 * cases[i].modulus * sqrt(cases[i].radius);
        for (size_t k = 0; k < 7; k++) {
            if (!cases[i].words[k])
                continue;
            if (k < 6)
                snprintf(text, sizeof text, "%s", cases[i].words[k]);
            else
                snprintf(text, sizeof text, "*F* = *A* %s^{3/2}, *A* = %.3f × 10^{7} N/m^{3/2}", cases[i].words[k],
                         stiffness / 1e7);
            bead_markup(text, markup, sizeof markup);
            bool found = false;
            for (size_t n = 0; n < seen.count; n++)
                found = found || strncmp(seen.box[n].text, markup, 299) == 0;
            if (!found)
                fail_msg("case %zu: nothing says %s", i, text);
        }
        clear_stage(s);
    }
}

/* ---- cells ---- */

struct ball {
    double x, y, r;
};

/* Discs of more than `least` px. */
static size_t balls_of(struct ball balls[], size_t most, double least)
{
    size_t count = 0;
    for (size_t i = 0; i < strokes.count && count < most; i++) {
        const struct stroke *s = &strokes.list[i];
        const double r = (s->high[0] - s->low[0]) / 2;
        if (!s->filled || s->count < 4 || r < least || fabs(s->at[0].x - s->high[0]) > 0.02 || s->at[0].y != s->at[s->count - 1].y)
            continue;
        balls[count++] = (struct ball){(s->low[0] + s->high[0]) / 2, s->at[0].y, r};
    }
    return count;
}

/* Groups of beads in contact over braces as wide as they are, the words in the middle; both ways round, the second the mirror image
 * of the first; as much room at the left as at the right, above as below. */
static void cells_are_in_the_middle(void **)
{
    struct seen seen = {.count = 0};
    struct staged *s = set_stage(COLOURED "chain: {beads: [{cell: [red, red, blue, blue, blue], count: 4, spins: random}]}\n"
                                          "outputs: [{plot: a.png, show: cell, size: [1600, 1000]}]\n");
    const struct bead_look look = look_of(s);
    const double em = look.label;
    struct ball b[12];
    strokes_begin();
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_int_equal(balls_of(b, 12, 4), 10);
    const double big = b[0].r, scale = big / 4e-3;
    double title[2], way[2], low = INFINITY;
    for (size_t i = 0; i < 10; i++) {
        const bool down = i >= 5, blue = down ? i < 8 : i > 1;
        assert_at(b[i].r, scale * (blue ? 2e-3 : 4e-3));
        assert_at(b[i].y, b[down ? 5 : 0].y);
        if (i % 5 > 0)
            assert_at(b[i].x - b[i - 1].x, b[i].r + b[i - 1].r);
    }
    const double left = b[0].x - b[0].r, right = b[4].x + b[4].r, middle = (left + right) / 2;
    for (size_t i = 0; i < 5; i++)
        assert_at(b[9 - i].x, 2 * middle - b[i].x);
    assert_at(middle, (1600 + 3.6 * em) / 2); /* "up" and "down" have a column */
    middle_of(&seen, "dimer cell", 0, title);
    assert_true(fabs(title[0] - middle) < 0.2 * em);
    size_t braces = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *brace = &strokes.list[i];
        if (brace->filled || brace->count < 5)
            continue;
        const bool down = braces >= 2;
        const size_t group = braces++ % 2, first = down ? (group ? 8 : 5) : (group ? 2 : 0),
                     last = down ? (group ? 9 : 7) : (group ? 4 : 1);
        double number[2], name[2];
        assert_bounds(brace, b[first].x - b[first].r + 0.1 * em, b[first].y + big + 0.3 * em, b[last].x + b[last].r - 0.1 * em,
                      b[first].y + big + (0.3 + 0.75) * em);
        middle_of(&seen, (down ? 1 - group : group) ? "= 3" : "= 2", down, number);
        middle_of(&seen, (down ? 1 - group : group) ? "blue" : "red", (size_t)down + 1, name); /* the first one is the title's */
        assert_true(fabs(number[0] - (brace->low[0] + brace->high[0]) / 2) < 0.3 * em);
        assert_true(fabs(number[1] - brace->high[1] - 1.05 * em) < 0.3 * em && fabs(name[1] - number[1] - 1.35 * em) < 0.3 * em);
        low = name[1];
    }
    assert_int_equal(braces, 4);
    for (int down = 0; down < 2; down++) {
        middle_of(&seen, down ? "down" : "up", 0, way);
        assert_true(way[0] < left - 0.9 * em && way[0] > left - 4 * em && fabs(way[1] - b[5 * down].y) < 0.3 * em);
    }
    assert_true(fabs((title[1] - 0.6 * em) - (1000 - (low + 0.7 * em))) < 0.4 * em);
    assert_at(b[5].y - b[0].y, 2 * big + (0.3 + 0.75 + 1.05 + 0.7 + 1.35 + 1.2) * em);
    clear_stage(s);
}

/* The three dots of beads left out: at equal steps of 0.27 of their gap, about its middle, between the balls beside it. */
static void assert_dots_fill_gap(const struct ball *before, const struct ball *after, double em)
{
    const double left = before->x + before->r, right = after->x - after->r;
    size_t found = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *dot = &strokes.list[i];
        if (!dot->filled || dot->high[0] - dot->low[0] > 0.18 * em || dot->low[0] < left || dot->high[0] > right ||
            fabs(dot->at[0].y - (before->y + after->y) / 2) > 1)
            continue;
        assert_at(dot->high[0] - dot->low[0], 0.17 * em);
        assert_at((dot->low[0] + dot->high[0]) / 2, (left + right) / 2 + 0.27 * ((double)found - 1) * (right - left));
        found++;
    }
    assert_int_equal(found, 3);
}

/* The largest bead of a cell, wherever it is, has room above its brace; long groups have a gap. */
static void long_cells_have_gaps(void **)
{
    struct seen seen = {.count = 0};
    struct staged *s =
        set_stage(COLOURED "chain: {beads: [{cell: [red, blue, blue, blue, blue, blue, blue, blue, blue, blue, blue, "
                           "blue, blue, blue, blue, blue, blue, blue, blue, blue], count: 4}]}\n"
                           "outputs: [{plot: a.png, show: cell, size: [1600, 1000]}]\n");
    const double em = look_of(s).label;
    struct ball b[40];
    strokes_begin();
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    const size_t count = balls_of(b, 40, 0.2 * em);
    size_t gap = 0, braces = 0;
    assert_true(count > 3);
    assert_at(b[0].r, 2 * b[1].r);
    for (size_t i = 1; i < count; i++)
        gap = b[i].x - b[i - 1].x > b[i].r + b[i - 1].r + 1 ? i : gap;
    assert_true(gap > 1);
    assert_dots_fill_gap(&b[gap - 1], &b[gap], em);
    for (size_t i = 0; i < strokes.count; i++) {
        if (strokes.list[i].filled || strokes.list[i].count < 5)
            continue;
        assert_at(strokes.list[i].low[1], b[0].y + b[0].r + 0.3 * em);
        braces++;
    }
    assert_int_equal(braces, 2);
    clear_stage(s);
}

/* ---- the experiment ---- */

static double slope_of(const struct stroke *s, size_t from, size_t to)
{
    return (s->at[to].y - s->at[from].y) / (s->at[to].x - s->at[from].x);
}

/* Beads touch each other, on a guide with the chain's tilt; the striker rests on the ramp and arrives on the beads' axis; the wall
 * is at the last bead; rings mark sensors; everything is in the middle. */
static void beads_lie_on_their_guide(void **)
{
    for (int variant = 0; variant < 4; variant++) {
        const bool wall = variant & 1, small = variant & 2;
        struct seen seen = {.count = 0};
        char text[1500];
        snprintf(text, sizeof text,
                 COLOURED
                 "chain: {striker: {bead: %s}, start: [{bead: 0, velocity: %s m/s}], tilt: 3 deg, beads: [{bead: red, count: 4}, "
                 "{bead: blue, sensor: one}, {bead: red, count: 3}], wall: %s}\nsimulate: {until: 1 ms}\n"
                 "outputs: [{plot: a.png, show: setup, size: [1600, 900]}]\n",
                 small ? "blue" : "red", small ? "-0.4" : "0.4", wall ? "rigid" : "red");
        struct staged *s = set_stage(text);
        const struct bead_look look = look_of(s);
        const double em = look.label, tilt = tan(3 * M_PI / 180), climb = 0.42;
        struct ball b[20];
        strokes_begin();
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        const size_t legend = balls_of(b, 20, 0.3 * em) - 9;
        assert_int_equal(legend, 2);
        const struct ball *striker = &b[legend], *bead = striker + 1;
        const struct stroke *guide = NULL, *ring = NULL;
        for (size_t i = 0; i < strokes.count; i++) {
            guide = !guide && strokes.list[i].filled && strokes.list[i].count == (small ? 10 : 8) ? &strokes.list[i] : guide;
            if (!strokes.list[i].filled && strokes.list[i].count > 3 && stroke_has(&strokes.list[i], false, look.accent))
                ring = &strokes.list[i];
        }
        assert_non_null(guide);
        assert_non_null(ring);
        const double big = bead[0].r, first = bead[0].x - bead[0].r, top = guide->at[small ? 3 : 2].y;
        assert_at(striker->r, small ? big / 2 : big);
        for (size_t i = 0; i < 8; i++) {
            assert_at(bead[i].r, i == 4 ? big / 2 : big);
            assert_at(bead[i].y, top + tilt * (bead[i].x - first) - big);
            if (i > 0)
                assert_at(bead[i].x - bead[i - 1].x, bead[i].r + bead[i - 1].r);
        }
        assert_at(ring->high[0] - bead[4].x, 0.55 * bead[4].r);
        assert_at(bead[4].x - ring->low[0], 0.55 * bead[4].r);
        assert_at(ring->at[0].y, bead[4].y);
        /* The guide: the ramp, a step, the level of the first bead, down to the wall's far side, and back 0.28 em below. */
        const double end = bead[7].x + big + 1.3 * em, thick = 0.28 * em;
        assert_at(slope_of(guide, 0, 1), climb);
        const double foot = first - 0.2 * em, foot_y = top - (small ? big / 2 : 0), fall = top + tilt * (end - first),
                     left = guide->low[0];
        const double corners[][2] = {{left, foot_y - climb * (foot - left)},
                                     {foot, foot_y},
                                     {foot, top},
                                     {first, top},
                                     {end, fall},
                                     {end, fall + thick},
                                     {first, top + thick},
                                     {foot - thick, top + thick},
                                     {foot - thick, foot_y + thick},
                                     {left, foot_y - climb * (foot - left) + thick}};
        size_t corner = 0;
        for (size_t i = 0; i < 10; i++) {
            if (small || (i != 2 && i != 8)) /* no step */
                assert_point(guide, corner++, corners[i][0], corners[i][1]);
        }
        assert_int_equal(guide->count, corner);
        /* The striker touches the ramp, as far from it as its radius. */
        const double above = foot_y + climb * (striker->x - foot) - striker->y;
        assert_at(above / hypot(1, climb), striker->r);
        assert_true(striker->x + striker->r < first && striker->x - striker->r > left);
        /* The block below the small bead reaches into the guide, from within the bead. */
        size_t blocks = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *block = &strokes.list[i];
            if (!block->filled || block->count < 4 || fabs(block->high[0] - block->low[0] - 1.1 * bead[4].r) > 0.05 ||
                block->low[1] < bead[4].y)
                continue;
            blocks++;
            const double y = top + tilt * (bead[4].x - first);
            assert_bounds(block, bead[4].x - 0.55 * bead[4].r, y - big + 0.8 * bead[4].r, bead[4].x + 0.55 * bead[4].r,
                          y + 0.5 * thick);
        }
        assert_int_equal(blocks, 1);
        /* The wall's face. */
        const struct stroke *lines[40];
        const size_t count = lines_of(look.ink, lines, 40);
        const double face = bead[7].x + big, floor_y = top + tilt * (face - first);
        bool faced = false;
        for (size_t i = 0; i < count; i++) {
            if (fabs(lines[i]->at[0].x - face) < 0.02 && fabs(lines[i]->at[1].x - face) < 0.02) {
                faced = true;
                assert_at(lines[i]->low[1], floor_y - big - 1.25 * big);
                assert_at(lines[i]->high[1], top + tilt * (end - first));
            }
        }
        assert_true(faced);
        /* The arrow is parallel to the ramp, down it, or up if the striker leaves; its label above it, the sensor's over its bead.
         */
        bool pointed = false;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *line = &strokes.list[i];
            if (line->count != 2 || !stroke_has(line, false, look.accent))
                continue;
            pointed = true;
            assert_true(fabs(slope_of(line, 0, 1) - climb) < 0.01);
            assert_true((line->at[1].x > line->at[0].x) == !small);
            const double off =
                (line->at[0].x - striker->x) * climb / hypot(1, climb) - (line->at[0].y - striker->y) / hypot(1, climb);
            assert_true(off > striker->r && off < striker->r + em);
        }
        assert_true(pointed);
        double said[2];
        middle_of(&seen, "sensor one", 0, said);
        assert_true(fabs(said[0] - bead[4].x) < 0.5 * em && said[1] < bead[4].y - bead[4].r - em);
        size_t leaders = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *leader = &strokes.list[i];
            if (!stroke_has(leader, false, look.faint) || fabs(leader->at[0].x - bead[4].x) > 0.02 || leader->at[0].y > bead[4].y)
                continue;
            leaders++;
            assert_at(leader->at[0].y, bead[4].y - bead[4].r - 0.15 * em);
            assert_true(leader->low[1] > said[1] && leader->low[1] < said[1] + em);
        }
        assert_int_equal(leaders, 1);
        /* Braces below: 0.25 em under the guide, over all beads of their part. */
        size_t braces = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *brace = &strokes.list[i];
            if (!stroke_has(brace, false, look.ink) || brace->count < 5)
                continue;
            const size_t from = braces ? 5 : 0, to = braces ? 7 : 3;
            const double low = bead[from].x - big, high = bead[to].x + big, y = top + tilt * (high - first) + thick + 0.25 * em;
            assert_bounds(brace, low + 0.1 * em, y, high - 0.1 * em, y + 0.7 * em);
            middle_of(&seen, braces ? "3 beads" : "4 beads", 0, said);
            assert_true(fabs(said[0] - (low + high) / 2) < 0.5 * em && said[1] > brace->high[1]);
            braces++;
        }
        assert_int_equal(braces, 2);
        clear_stage(s);
    }
}

/* A first bead that does not move lies beside the others on a guide without a ramp, small ones on a block; a line leads to it. */
static void beads_that_strike_nothing_are_level(void **)
{
    for (int small = 0; small < 2; small++) {
        struct seen seen = {.count = 0};
        char text[600];
        snprintf(text, sizeof text,
                 COLOURED "chain: {striker: {bead: %s}, drive: {bead: 0, displacement: chirp, amplitude: 0.1 um, frequency: 1 kHz, "
                          "to: 20 kHz}, beads: [{bead: red, count: 4}]}\nsimulate: {until: 1 ms}\n"
                          "outputs: [{plot: a.png, show: setup, size: [1600, 900]}]\n",
                 small ? "blue" : "red");
        struct staged *s = set_stage(text);
        const struct bead_look look = look_of(s);
        struct ball b[20];
        strokes_begin();
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        const size_t legend = balls_of(b, 20, 0.3 * look.label) - 5;
        const struct ball *first = &b[legend], *bead = first + 1;
        const double floor_y = bead[0].y + bead[0].r;
        assert_at(first->r, small ? bead[0].r / 2 : bead[0].r);
        assert_at(first->y, bead[0].y);
        assert_at(bead[0].x - first->x, bead[0].r + first->r);
        size_t guides = 0, blocks = 0, leaders = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *stroke = &strokes.list[i];
            assert_false(stroke->count == 2 && stroke_has(stroke, false, look.accent)); /* no arrow */
            if (stroke->filled && fabs(stroke->low[0] - (first->x - first->r)) < 0.02 && stroke->low[1] > bead[0].y) {
                assert_bounds(stroke, first->x - first->r, floor_y, bead[3].x + bead[3].r, floor_y + 0.28 * look.label);
                guides++;
            }
            blocks += stroke->filled && fabs(stroke->low[0] - (first->x - 0.55 * first->r)) < 0.05 &&
                      fabs(stroke->high[0] - (first->x + 0.55 * first->r)) < 0.05 && stroke->low[1] < floor_y;
            leaders += stroke_has(stroke, false, look.faint) && fabs(stroke->at[0].x - first->x) < 0.02 &&
                       fabs(stroke->at[0].y - (first->y - first->r - 0.15 * look.label)) < 0.02;
        }
        assert_int_equal(guides, 1);
        assert_int_equal(blocks, small);
        assert_int_equal(leaders, 1);
        assert_true(wrote(&seen, "driven from 1.00\u00a0kHz to 20.0\u00a0kHz"));
        clear_stage(s);
    }
}

/* Labels that have no room above their beads stand aside, and their lines end where they begin, nearest to their beads. */
static void lines_lead_to_their_labels(void **)
{
    struct seen seen = {.count = 0};
    struct staged *s =
        set_stage(COLOURED "chain: {beads: [{bead: red, count: 60}, {bead: red, sensor: the first of two}, {bead: red}, "
                           "{bead: red, sensor: the last of two}, {bead: red}], wall: red}\n"
                           "outputs: [{plot: a.png, show: setup, size: [1600, 900]}]\n");
    const struct bead_look look = look_of(s);
    const double em = look.label;
    struct ball b[60];
    strokes_begin();
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    const size_t count = balls_of(b, 60, 0.3 * em);
    size_t gap = 0, aside = 0;
    for (size_t i = 2; i < count; i++)
        gap = b[i].y == b[i - 1].y && b[i].x - b[i - 1].x > b[i].r + b[i - 1].r + 1 ? i : gap;
    assert_dots_fill_gap(&b[gap - 1], &b[gap], em);
    for (size_t i = 0; i < 2; i++) {
        const struct ball *bead = &b[count - (i ? 2 : 4)];
        double said[2];
        middle_of(&seen, i ? "the last of two" : "the first of two", 0, said);
        for (size_t k = 0; k < strokes.count; k++) {
            const struct stroke *line = &strokes.list[k];
            if (line->count != 3 || !stroke_has(line, false, look.faint) || fabs(line->at[0].x - bead->x) > 0.02)
                continue;
            const struct stroke_point *end = &line->at[2];
            size_t at = 0;
            while (strstr(seen.box[at].text, i ? "the last of two" : "the first of two") == NULL)
                at++;
            const double low = seen.box[at].x + 0.4 * em, high = seen.box[at].x + seen.box[at].width - 0.4 * em;
            assert_true(fabs(end->x - fmin(fmax(bead->x, low), high)) < 0.15 * em && end->y > said[1]);
            aside += fabs(end->x - bead->x) > 0.5 * em;
        }
    }
    assert_true(aside > 0);
    clear_stage(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrows_have_heads_at_their_ends),
        cmocka_unit_test(braces_are_symmetric),
        cmocka_unit_test(rectangles_are_hatched_all_over),
        cmocka_unit_test(labels_are_near_their_anchors),
        cmocka_unit_test(crowds_are_noticed),
        cmocka_unit_test(pieces_fill_their_lines),
        cmocka_unit_test(contacts_have_their_triangles),
        cmocka_unit_test(equal_beads_touch_evenly),
        cmocka_unit_test(formulas_have_the_contacts_numbers),
        cmocka_unit_test(cells_are_in_the_middle),
        cmocka_unit_test(long_cells_have_gaps),
        cmocka_unit_test(beads_lie_on_their_guide),
        cmocka_unit_test(beads_that_strike_nothing_are_level),
        cmocka_unit_test(lines_lead_to_their_labels),
    };
    return cmocka_run_group_tests_name("strokes of schematic drawings", tests, NULL, NULL);
}
