/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Overlays of films, as numbers: clock, captions, notes with their boxes and tips, races, progress. */
#include <math.h>

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/draw/words.h"
#include "render/movie/composer_private.h"
#include "strokes.h"
#include "tests/scenes.h"
#include "tests/texts.h"

enum { WIDTH = 640, HEIGHT = 360, CHAINS = 12, ROOM = 64 };
static const double span = 1.2e-3;

struct film {
    struct bead_scene *scene;
    struct bead_chain *chains[CHAINS];
    struct bead_composer *composer;
    struct texts texts;
    struct bead_text_watch watch;
    double before; /* the last time drawn */
};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static const struct bead_film_clock slow = {.slowed = 4000};

static void open_film(struct film *f, const char *chains, const char *output)
{
    struct bead_message msg = {""};
    char text[3000];
    snprintf(text, sizeof text, "title: A film\nsimulate: {until: 1.2 ms}\n%s\noutputs: [{movie: m.mp4, size: [%d, %d], %s}]\n",
             chains, WIDTH, HEIGHT, output);
    *f = (struct film){.scene = parse(text), .watch = {texts_note, &f->texts}};
    for (size_t i = 0; i < f->scene->chain_count; i++)
        require(bead_chain_create(f->scene, i, &f->chains[i], &msg), &msg);
    const struct bead_composer_setup setup = {.output = &f->scene->outputs[0],
                                              .chains = (const struct bead_chain *const *)f->chains,
                                              .chain_count = f->scene->chain_count,
                                              .title = f->scene->title,
                                              .width = WIDTH,
                                              .height = HEIGHT,
                                              .time = {0, span},
                                              .step = 2e-6,
                                              .range = {.high = 45},
                                              .scene = f->scene,
                                              .canvas = "plain",
                                              .film = &slow,
                                              .tolerance_factor = 1,
                                              .watch = &f->watch};
    require(bead_composer_create(&setup, &f->composer, &msg), &msg);
    require(bead_composer_open(f->composer, &msg), &msg);
}

static void close_film(struct film *f)
{
    bead_composer_close(f->composer);
    bead_composer_destroy(f->composer);
    for (size_t i = 0; i < f->scene->chain_count; i++)
        bead_chain_destroy(f->chains[i]);
    bead_scene_free(f->scene);
}

/* A step of compression at contact `at` of a chain, as it goes. */
static void feed(struct film *f, size_t chain, double at, double time)
{
    struct bead_message msg = {""};
    double u[ROOM], force[ROOM], none[ROOM] = {0};
    struct bead_sample sample = {.chain = chain, .time = time, .active = bead_chain_beads(f->chains[chain])};
    for (int i = 0; i < ROOM; i++)
        u[i] = 1e-5 / (1 + exp(i - at));
    for (int i = 0; i < ROOM; i++)
        force[i] = i + 1 < ROOM ? 1.6e7 * (u[i] - u[i + 1]) : 0;
    for (size_t k = 0; k < BEAD_FIELD_COUNT; k++)
        sample.field[k] = none;
    sample.field[BEAD_FIELD_DISPLACEMENT] = u;
    sample.field[BEAD_FIELD_CONTACT_FORCE] = sample.field[BEAD_FIELD_FORCE] = force;
    require(bead_composer_feed(f->composer, &sample, &msg), &msg);
}

static void draw(struct film *f, double time)
{
    struct bead_message msg = {""};
    struct bead_changes changes = {0};
    f->texts.count = 0;
    strokes_begin();
    require(bead_composer_draw(f->composer, time, &changes, &msg), &msg);
    strokes.on = false;
}

static const struct text *find(const struct texts *texts, const char *words)
{
    for (size_t i = 0; i < texts->count; i++) {
        if (strstr(texts->text[i].markup, words))
            return &texts->text[i];
    }
    return NULL;
}

/* A text in the middle of the height of its place. */
static bool in_the_middle(const struct text *text, double top, double height)
{
    return fabs(text->y + text->height / 2 - top - height / 2) < 0.12 * text->height;
}

/* The smallest fill around a text is a box with round corners, in whose middle it is: as wide as needed and `air` px on each side.
 */
static void assert_boxed(const struct text *text, double air, double high)
{
    const struct stroke *box = NULL;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *s = &strokes.list[i];
        const bool around = s->filled && s->low[0] < text->x && s->high[0] > text->x + text->width && s->low[1] < text->y + 3 &&
                            s->high[1] > text->y + text->height - 3;
        box = around && (!box || s->high[0] - s->low[0] < box->high[0] - box->low[0]) ? s : box;
    }
    assert_non_null(box);
    assert_true(box->count == 8 && fabs(box->high[1] - box->low[1] - high) < 1); /* four sides, four arcs */
    assert_true(fabs(text->x - box->low[0] - air) < 1.5 && fabs(box->high[0] - text->x - text->width - air) < 1.5);
    assert_true(fabs(box->low[1] + box->high[1] - 2 * text->y - text->height) < 0.24 * text->height);
}

/* ---- words in their lines ---- */

/* The clock says the time; a caption is there from its first moment until its last; the line below has gone so far as the film. */
static void words_are_in_their_lines(void **)
{
    static struct film f;
    open_film(&f, "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 8}]}",
              "captions: [{at: 0.2 ms, until: 0.6 ms, text: first words}, {at: 0.8 ms, text: other words}]");
    const struct bead_movie_layout *l = &f.composer->layout;
    const struct bead_look *look = &f.composer->look;
    const int high = (int)fmax(2, 2 * look->line);
    for (int k = 0; k <= 12; k++) {
        const double time = 1e-4 * k;
        char clock[32];
        feed(&f, 0, 0.8 * k, time);
        draw(&f, time);
        snprintf(clock, sizeof clock, "%.3f", 0.1 * k);
        const struct text *said = find(&f.texts, clock);
        assert_true(said && fabs(said->x - l->time.x) < 3 && in_the_middle(said, l->time.y, l->time.height));
        assert_true((find(&f.texts, "first words") != NULL) == (k == 2) && (find(&f.texts, "other words") != NULL) == (k == 8));
        const struct text *badge = find(&f.texts, "slowed"); /* said once: the speed is even */
        assert_true((badge != NULL) == (k == 0));
        if (badge)
            assert_true(badge->x > l->badge.x && badge->x + badge->width < l->badge.x + l->badge.width &&
                        in_the_middle(badge, l->badge.y, l->badge.height) && l->badge.x >= l->time.x + l->time.width);
        if (badge)
            assert_boxed(badge, 0.45 * look->label, fmin(l->badge.height, 1.4 * look->label));
        const struct text *caption = find(&f.texts, "words");
        if (caption)
            assert_true(caption->y >= l->caption.y - 1 && caption->y + caption->height <= l->caption.y + l->caption.height + 1 &&
                        fabs(caption->x + caption->width / 2 - (l->caption.x + l->caption.width / 2.0)) < 2);
        const struct bead_frame *frame = bead_composer_frame(f.composer);
        for (int y = HEIGHT - high - 1; y < HEIGHT; y++) {
            int passed = 0;
            for (int x = 0; x < WIDTH; x++) {
                const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
                passed += fabs(p[0] - 255 * look->accent.b) < 2 && fabs(p[2] - 255 * look->accent.r) < 2;
            }
            assert_int_equal(passed, y < HEIGHT - high ? 0 : (int)lround(WIDTH * k / 12.0));
        }
    }
    close_film(&f);
}

/* The clock of a film has as many decimals as tell its frames apart, four at most, and no more; a unit in which its end is from 1
 * to 1000; and the time. */
static void clocks_tell_frames_apart(void **)
{
    struct bead_look look;
    bead_look_film(&look, WIDTH, HEIGHT, true, false);
    for (int e = -9; e < 3; e++) {
        for (int s = 0; s < 24; s++) {
            const double end = 3.7 * pow(10, e), step = end / pow(10, 0.25 * s);
            const struct bead_clock clock = bead_clock_make(end, step, "s");
            const double least = pow(10, -clock.decimals), shown = step / clock.unit;
            assert_true(clock.decimals >= 0 && clock.decimals <= 4);
            assert_true(clock.decimals == 4 || shown > least * (1 - 1e-6));
            assert_true(clock.decimals == 0 || shown < 10 * least * (1 - 1e-6));
            assert_true(end / clock.unit >= 1 && (end / clock.unit < 1000 || e > 0));
            char text[400], number[48];
            bead_clock_text(&clock, 0.5 * end, &look, text, sizeof text);
            snprintf(number, sizeof number, " %.*f\u2009%s<", clock.decimals, 0.5 * end / clock.unit, clock.sign);
            assert_non_null(strstr(text, number));
            bead_clock_text(&clock, -1e-20, &look, text, sizeof text);
            assert_null(strchr(strstr(text, "=</span>"), '-'));
        }
    }
    assert_string_equal(bead_clock_make(2e-3, 1e-5, "s").sign, "ms");
    assert_true(bead_clock_make(200, 0.5, "").unit == 1 && bead_clock_make(200, 0, "").decimals == 0);
}

/* ---- notes ---- */

/* A note is a box around its words, below the beads, at the lower edge of the stage; from its upper edge a tip points at its bead,
 * whose foot is half as wide as the box is high. */
static void notes_are_boxes_with_tips(void **)
{
    for (int arrow = 0; arrow < 2; arrow++) {
        static struct film f;
        char output[200];
        snprintf(output, sizeof output, "magnify: 1, notes: [{at: 0.1 ms, until: 0.5 ms, bead: 5, text: here it is%s}]",
                 arrow ? "" : ", arrow: false");
        open_film(&f, "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 9}]}", output);
        const struct bead_look *look = &f.composer->look;
        const double type = 0.85 * look->label, high = round(1.4 * type);
        for (int k = 0; k < 7; k++) {
            feed(&f, 0, 0, 1e-4 * k);
            draw(&f, 1e-4 * k);
            const struct text *said = find(&f.texts, "here it is");
            assert_true((said != NULL) == (k >= 1 && k < 5));
            assert_int_equal(bead_composer_notes(f.composer)->count, said != NULL);
            if (!said)
                continue;
            const struct bead_note_box *box = &bead_composer_notes(f.composer)->box[0];
            struct bead_spot spot;
            assert_true(f.composer->wants.views[0]->find(f.composer->views[0], BEAD_NOTE_BEAD, 5, &spot));
            assert_at(box->height, high);
            assert_at(box->y + high, spot.stage.y + spot.stage.height - 1);
            assert_at(box->x + box->width / 2, spot.x);
            assert_at(box->tip_x, spot.x);
            assert_true(box->tip_y < box->y && box->tip_y <= spot.y + 0.55 * spot.r + 1e-6);
            assert_true(box->tip_y >
                        fmin(spot.y + 0.5 * spot.r, box->y - 0.3 * high)); /* in the bead's lower half, or near the note */
            assert_true(fabs(said->x - box->x - 0.5 * type) < 3 && fabs(box->width - said->width - type) < 2);
            assert_true(in_the_middle(said, box->y, high));
            size_t shapes = 0;
            for (size_t i = 0; i + 1 < strokes.count; i++) {
                const struct stroke *fill = &strokes.list[i], *edge = &strokes.list[i + 1];
                if (!stroke_has(fill, true, look->background) || !stroke_has(edge, false, look->accent))
                    continue;
                assert_bounds(fill, box->x, arrow ? box->tip_y : box->y, box->x + box->width, box->y + high);
                assert_bounds(edge, box->x, arrow ? box->tip_y : box->y, box->x + box->width, box->y + high);
                assert_true(edge->width == look->line && edge->closed);
                int foot = 0;
                for (size_t p = 0; p < fill->count; p++)
                    foot += fabs(fill->at[p].y - box->y) < 0.02 && fabs(fabs(fill->at[p].x - spot.x) - 0.25 * high) < 0.02;
                assert_int_equal(foot, arrow ? 2 : 0);
                assert_int_equal(fill->count, 8 + (arrow ? 3 : 0)); /* four round corners */
                shapes++;
            }
            assert_int_equal(shapes, 1);
        }
        close_film(&f);
    }
}

/* The chain with the leading wave is named, with the number of beads. */
static void races_say_who_leads(void **)
{
    static const struct {
        double at[2]; /* contacts */
        const char *words;
    } moments[] = {{{4, 4}, NULL}, {{7, 5}, "2 beads ahead"}, {{8, 7}, "1 bead ahead"}, {{9, 12}, "3 beads ahead"}};
    static struct film f;
    open_film(&f,
              "chains:\n  - {name: A, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 24}]}\n"
              "  - {name: B, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 24}]}\n",
              "race: true");
    double time = 0;
    for (size_t m = 0; m < 4; m++) {
        for (int k = 0; k <= 20; k++, time += 2e-6) {
            for (size_t c = 0; c < 2; c++) {
                const double before = m ? moments[m - 1].at[c] : 0;
                feed(&f, c, before + (moments[m].at[c] - before) * k / 20, time);
            }
            draw(&f, time);
        }
        const struct text *said = find(&f.texts, "ahead");
        if (moments[m].words && (!said || !strstr(said->markup, moments[m].words)))
            fail_msg("moment %zu: %s, not %s", m, said ? said->markup : "nothing", moments[m].words);
        assert_true(moments[m].words || !said);
        const size_t leads = moments[m].at[1] > moments[m].at[0];
        const struct bead_rect *plot = f.composer->layout.chains[leads].plot;
        assert_true(!said || (said->y > plot->y && said->y < plot->y + plot->height));
    }
    close_film(&f);
}

/* Curves in one plot are named beside samples of their lines, as long as 1.6 letters, in their colours and dashes. */
static void names_have_samples_of_lines(void **)
{
    static struct film f;
    open_film(&f,
              "chains:\n  - {name: A, beads: [{bead: large-steel, count: 24}]}\n"
              "  - {name: B, beads: [{bead: large-steel, count: 24}]}\n",
              "views: [profile]");
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    assert_true(bead_text_watch(surface, &f.watch));
    cairo_t *cr = cairo_create(surface);
    for (size_t c = 0; c < 2; c++) {
        const struct bead_look *look = &f.composer->look;
        f.texts.count = 0;
        strokes_begin();
        bead_composer_draw_names(f.composer, c, cr);
        strokes.on = false;
        const struct text *said = find(&f.texts, c ? "B" : "A");
        const struct stroke *line = &strokes.list[0];
        const struct bead_dashes *dashes = bead_look_dashes(c);
        assert_true(said && strokes.count == 1 && stroke_has(line, false, bead_look_curve(look, c)));
        assert_true(line->dashes == dashes->count &&
                    (line->dashes == 0 || fabs(line->dash[1] - line->width * dashes->lengths[1]) < 1e-9));
        assert_at(line->width, fmax(1.6, 1.8 * look->line));
        assert_true(line->high[0] > line->low[0] && line->high[0] < said->x && said->x - line->high[0] < look->label);
        assert_true(fabs(line->low[1] - said->y - said->height / 2) < 2 && line->low[1] == line->high[1]);
    }
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    close_film(&f);
    /* A name is as large as its room, but no larger than its type, and no smaller than the layout allows. */
    open_film(&f, "chain: {name: A chain with a name, beads: [{bead: large-steel, count: 24}]}", "views: [spacetime]");
    const struct bead_look *own = &f.composer->look;
    const double least = bead_name_least(own, f.chains[0]), smallest = bead_name_size(own, f.chains[0], 0);
    assert_true(bead_name_size(own, f.chains[0], 1e4) == 1 && smallest > 0.3 && smallest < 0.95);
    assert_true(fabs(bead_name_size(own, f.chains[0], least) - smallest) < 0.03);
    assert_true(fabs(bead_name_size(own, f.chains[0], 0.97 * least / smallest) - 0.97) < 0.03);
    close_film(&f);
    /* On stages curves are in one plot where there are several chains, and curves. */
    for (int chains = 1; chains <= 2; chains++) {
        for (int curves = 0; curves < 2; curves++) {
            open_film(&f,
                      chains == 1 ? "chain: {name: A, beads: [{bead: large-steel, count: 24}]}"
                                  : "chains:\n  - {name: A, beads: [{bead: large-steel, count: 24}]}\n"
                                    "  - {name: B, beads: [{bead: large-steel, count: 24}]}\n",
                      curves ? "views: [stage, profile]" : "views: [stage]");
            assert_int_equal(bead_composer_shares_curves(f.composer), chains == 2 && curves);
            close_film(&f);
        }
    }
}

/* What layouts keep for a heading is what it takes when it is drawn: name, M and label with gaps between them. */
static void headings_are_as_wide_as_measured(void **)
{
    static struct film f;
    open_film(&f,
              "chain: {name: A chain with a name, label: of beads, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{cell: "
              "[large-steel, aluminium], spins: \"1011\"}]}",
              "views: [profile]");
    const struct bead_look *look = &f.composer->look;
    const struct bead_rect rect = {20, 10, 2000, (int)(3 * look->title)};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 2100, 100);
    assert_true(bead_text_watch(surface, &f.watch));
    cairo_t *cr = cairo_create(surface);
    for (int small = 0; small < 2; small++) {
        const struct bead_heading heading = {f.chains[0], look->ink, false, false, small ? 0.6 : 1};
        f.texts.count = 0;
        bead_heading_draw(cr, look, &heading, 1, rect);
        const struct text *name = &f.texts.text[0], *m = &f.texts.text[1], *label = &f.texts.text[2];
        assert_true(f.texts.count == 3 && strstr(label->markup, "of beads"));
        const double gap = label->x - m->x - m->width, to_label = label->x - rect.x;
        assert_true(bead_heading_name(look, &heading, rect) == 1); /* there is room for larger type */
        assert_true(gap > 0.8 * look->gap && fabs(m->x - name->x - name->width - gap) < 3);
        if (small) {
            assert_true(fabs(to_label - bead_heading_least(look, f.chains[0], true)) < 2);
            assert_true(fabs(m->x - rect.x - bead_heading_least(look, f.chains[0], false)) < 2);
            const struct bead_text_style style = bead_words_style(look, 1.1 * look->title, look->ink, BEAD_ALIGN_BASELINE);
            char markup[256];
            bead_text_magnetism(bead_chain_magnetism(f.chains[0]), markup, sizeof markup);
            assert_at(bead_heading_least(look, f.chains[0], true) - bead_heading_least(look, f.chains[0], false),
                      bead_words_width(cr, &style, markup) + 1.2 * look->gap);
        } else {
            assert_true(fabs(label->width - bead_label_width(look, f.chains[0])) < 2);
            assert_true(fabs(to_label + label->width + 1 - bead_heading_width(look, f.chains[0])) < 2.5);
        }
    }
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    close_film(&f);
}

/* ---- the room that layouts keep ---- */

static void assert_room(double kept, double taken, const char *what, const char *output)
{
    if (!(kept > taken - 0.5 && kept < taken + 2.5)) /* sides of letters, and rounding up */
        fail_msg("%s: %s takes %g px of %g", output, what, taken, kept);
}

/* How far texts beside a plot reach out of it to the left, level with it or below; right; below, down to the lowest; px. */
static void find_reach(const struct texts *texts, struct bead_rect p, double em, double lowest, double reach[4])
{
    memset(reach, 0, 4 * sizeof *reach);
    for (size_t i = 0; i < texts->count; i++) {
        const struct text *t = &texts->text[i];
        const double right = t->x + t->width, bottom = t->y + t->height, middle = t->y + t->height / 2;
        const bool level = middle > p.y - 0.2 * em && middle < p.y + p.height + 0.2 * em && right <= p.x && p.x - t->x < 4 * em,
                   under = t->y >= p.y + p.height && bottom < lowest && right > p.x - 4 * em && t->x < p.x + p.width;
        reach[0] = level ? fmax(reach[0], p.x - t->x) : reach[0];
        reach[1] = under ? fmax(reach[1], p.x - t->x) : reach[1];
        reach[2] = under ? fmax(reach[2], right - p.x - p.width) : reach[2];
        reach[3] = under ? fmax(reach[3], bottom - p.y - p.height) : reach[3];
    }
}

static double width_of(const struct texts *texts, const char *words)
{
    const struct text *text = find(texts, words);
    assert_non_null(text);
    return text->width;
}

/* Layouts keep no less room than words and numbers take, and hardly more: beside and below plots, beside the bar, for the clock at
 * its last moment, badge and titles. */
static void rooms_are_as_large_as_words(void **)
{
    static const char *const outputs[] = {"views: [beads, profile, spacetime], layout: stacked",
                                          "views: [beads, profile, spacetime], layout: columns, orientation: time-right",
                                          "views: [stage, profile, spacetime]", "views: [profile, sensors], layout: stacked"};
    for (size_t o = 0; o < 4; o++) {
        static struct film f;
        double left = 0;
        open_film(&f,
                  "chain: {name: A, label: of beads, striker: {bead: large-steel, velocity: 0.4 m/s}, wall: brass, beads: [{bead: "
                  "large-steel, count: 99}, {bead: large-steel, sensor: S}]}",
                  outputs[o]);
        const struct bead_movie_wants *w = &f.composer->wants;
        const struct bead_movie_layout *l = &f.composer->layout;
        for (size_t v = 0; v < w->view_count; v++) {
            double reach[4];
            struct bead_rect p = l->chains[0].plot[v];
            const bool along = bead_movie_across(w, v) == BEAD_ACROSS_CHAIN, image = bead_view_has(w->views[v], BEAD_SHOWS_IMAGE);
            if (bead_view_has(w->views[v], BEAD_SHOWS_BEADS) || bead_view_has(w->views[v], BEAD_ACTS))
                continue;
            p.x -= along ? l->beyond[0] : 0;
            p.width += along ? l->beyond[0] + l->beyond[1] : 0;
            const double next = v + 1 < w->view_count && l->chains[0].plot[v + 1].y > p.y ? l->chains[0].plot[v + 1].y
                                                                                          : HEIGHT + 2 * w->look->label;
            find_reach(&f.texts, p, w->look->tick, next - 1.3 * w->look->label, reach);
            left = fmax(left, fmax(reach[0], along ? reach[1] : 0));
            if (image)
                assert_room(w->image_left, reach[0], "an image's axis", outputs[o]);
            if (!l->chains[0].labels[v])
                continue;
            assert_room(along                 ? w->below_beads
                        : image && l->against ? w->below_numbers
                                              : w->below_time,
                        reach[3], "the axis below", outputs[o]);
            /* The last bead is half a bead from the end, which is less where a plot is as narrow as a fifth of the frame. */
            const double nearer = 0.5 * (l->chains[0].plot[v].width - 0.2 * WIDTH) / (double)w->beads;
            assert_room(along ? w->along_end : w->time_end, reach[2] + (along ? l->beyond[1] + nearer : 0), "the last number",
                        outputs[o]);
        }
        assert_room(w->left, left, "the axis at the left", outputs[o]);
        double beside = 0;
        for (size_t i = 0; i < f.texts.count && l->bar.width > 0; i++) {
            const struct text *t = &f.texts.text[i];
            const int bar = l->bar.x + l->bar.width;
            beside = t->x > bar && t->y > l->bar.y - t->height && t->y < l->bar.y + l->bar.height
                         ? fmax(beside, t->x + t->width - bar)
                         : beside;
        }
        if (l->bar.width > 0 && o != 2) { /* lower, it has fewer numbers */
            assert_room(w->bar, beside, "the bar", outputs[o]);
            assert_room(w->bar_title, width_of(&f.texts, "force (N)"), "the bar's title", outputs[o]);
        }
        assert_room(w->title_width, width_of(&f.texts, "A film"), "the title", outputs[o]);
        if (l->against) {
            assert_room(w->against, width_of(&f.texts, "against"), "the title of both axes", outputs[o]);
            assert_true(w->along < w->against);
        }
        draw(&f, span);
        assert_room(w->time_width, width_of(&f.texts, "1.200") + 0.5 * w->look->gap, "the clock", outputs[o]);
        const struct text *badge = find(&f.texts, "slowed");
        if (badge)
            assert_room(w->badge_width, badge->width + 0.9 * w->look->label, "the badge", outputs[o]);
        close_film(&f);
    }
}

#define WANTED(member)                                     \
    {                                                      \
#member, offsetof(struct bead_movie_wants, member) \
    }
static const struct {
    const char *name;
    size_t at;
} rooms[] = {WANTED(heading_width), WANTED(label_width), WANTED(heading_least), WANTED(bead_height),
             WANTED(time_width),    WANTED(title_width), WANTED(left),          WANTED(image_left),
             WANTED(below_beads),   WANTED(below_time),  WANTED(below_numbers), WANTED(time_end),
             WANTED(along_end),     WANTED(bar),         WANTED(bar_below),     WANTED(bar_title)};

static double wanted(const struct film *f, size_t room)
{
    double value;
    memcpy(&value, (const char *)&f->composer->wants + rooms[room].at, sizeof value);
    return value;
}

/* A film of two chains wants what the one that needs more does, whichever is the first. */
static void films_want_what_their_chains_do(void **)
{
    static const char *const outputs[] = {"views: [beads, profile, spacetime], layout: stacked",
                                          "views: [beads, profile, spacetime], layout: stacked, orientation: time-right",
                                          "views: [stage, profile]"};
    static const char *const chains[] = {
        "{name: A, label: of many beads, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 99}, "
        "{bead: small-steel}]}",
        "{name: A chain with a name, label: few, striker: {bead: small-steel, velocity: 0.4 m/s}, wall: brass, beads: [{bead: "
        "aluminium, count: 9}, {bead: ptfe, sensor: S}]}"};
    static struct film one[2], both;
    for (size_t o = 0; o < 3; o++) {
        char text[1000];
        for (int k = 0; k < 2; k++) {
            snprintf(text, sizeof text, "chains: [%s]", chains[k]);
            open_film(&one[k], text, outputs[o]);
        }
        const struct bead_movie_wants *w[2] = {&one[0].composer->wants, &one[1].composer->wants};
        for (int first = 0; first < 2; first++) {
            snprintf(text, sizeof text, "chains: [%s, %s]", chains[first], chains[!first]);
            open_film(&both, text, outputs[o]);
            for (size_t r = 0; r < sizeof rooms / sizeof *rooms; r++) {
                const double most = fmax(wanted(&one[0], r), wanted(&one[1], r));
                if (wanted(&both, r) != most)
                    fail_msg("%s, %d first: %s is %g, not %g", outputs[o], first, rooms[r].name, wanted(&both, r), most);
            }
            const struct bead_movie_wants *all = &both.composer->wants;
            assert_true(all->beads == w[0]->beads && w[0]->beads > w[1]->beads && all->sensors && !w[0]->sensors && w[1]->sensors);
            assert_true(all->wall && !w[0]->wall && w[1]->wall && all->striker && !all->same_beads && w[0]->same_beads);
            close_film(&both);
        }
        close_film(&one[0]);
        close_film(&one[1]);
    }
}

/* ---- cards ---- */

/* Beside a name, up to the next words, there is nothing but the page: beads are below it. */
static void assert_alone(const struct film *f, const struct text *name)
{
    const struct bead_frame *frame = bead_composer_frame(f->composer);
    const int from = (int)(name->x + name->width) + 3, y = (int)(name->y + name->height / 2);
    int to = WIDTH - (int)name->x;
    for (size_t i = 0; i < f->texts.count; i++) {
        const struct text *t = &f->texts.text[i];
        if (t->x > name->x + name->width - 1 && t->y < y && t->y + t->height > y)
            to = t->x < to ? (int)t->x - 1 : to;
    }
    const uint8_t *row = frame->pixels + (size_t)y * frame->stride;
    for (int x = from; x < to; x++) {
        for (int c = 0; c < 3; c++)
            assert_int_equal(row[4 * x + c], frame->pixels[c]);
    }
}

/* A card has title and text, a rule, the chains with their names, and facts, of the longest cell or, of several, the one that comes
 * most often: all from one left edge, below each other, on the page.
 * If there are more chains than fit, it says how many more. */
static void cards_say_what_is_shown(void **)
{
    for (size_t chains = 1; chains <= CHAINS; chains = chains == 1 ? 2 : CHAINS + (chains == CHAINS)) {
        for (int with_text = 0; with_text < 2; with_text++) {
            static struct film f;
            struct bead_message msg = {""};
            struct bead_changes changes = {0};
            char scene[2000];
            size_t used = (size_t)snprintf(scene, sizeof scene, "chains:\n"), named = 0, more = 0;
            for (size_t c = 0; c < chains; c++)
                used += (size_t)snprintf(
                    scene + used, sizeof scene - used, "  - {name: Name %zu%s, beads: [{%s, count: %d}, {bead: ptfe}]}\n", c,
                    c == 1 ? " with letters so numerous that all of them have to be smaller than those of the others" : "",
                    chains == 1 ? "cell: [large-steel, ptfe, ptfe, small-steel, ptfe]" : "bead: large-steel", chains == 1 ? 5 : 24);
            open_film(&f, scene,
                      with_text ? "magnify: 30, card: {text: What it is about, for: 1 s}" : "magnify: 1, card: {for: 1 s}");
            f.texts.count = 0;
            f.composer->facts.keyed = with_text; /* in the film, not on the card */
            strokes_begin();
            require(bead_composer_card(f.composer, &changes, &msg), &msg);
            strokes.on = false;
            const struct bead_look *look = &f.composer->look;
            const double left = round(0.12 * WIDTH), large = 2.1 * look->title;
            const struct text *title = find(&f.texts, "A film"), *text = find(&f.texts, "What it is about"),
                              *pace = find(&f.texts, "0.25\u00a0ms");
            assert_true(title && pace && (text != NULL) == with_text);
            assert_true((find(&f.texts, "Displacements drawn 30 times larger") != NULL) == with_text);
            assert_true((find(&f.texts, "Displacements drawn") != NULL) == with_text);
            const double middle = title->y + title->height / 2,
                         rule = middle + 0.8 * large + (with_text ? 1.76 * look->title : 0) + look->title;
            size_t rules = 0;
            for (size_t i = 0; i < strokes.count; i++) {
                const struct stroke *r = &strokes.list[i];
                if (!stroke_has(r, true, look->accent) || r->count < 4 || fabs(r->low[0] - left) > 0.1)
                    continue;
                assert_true(fabs(r->high[0] - r->low[0] - 3 * large) < 0.05 && fabs(r->low[1] - rule) < 2);
                assert_true(fabs(r->high[1] - r->low[1] - fmax(2, 2 * look->line)) < 0.05);
                rules++;
            }
            assert_int_equal(rules, 1);
            double bottom = 0;
            for (size_t i = 0; i < f.texts.count; i++) {
                const struct text *t = &f.texts.text[i];
                const char *name = strstr(t->markup, "Name "), *rest = strstr(t->markup, "and ");
                if (strstr(t->markup, "<i>M</i>")) /* beside the name */
                    continue;
                named += name != NULL;
                if (name)
                    assert_alone(&f, t);
                more = rest && strstr(t->markup, "more chains") ? (size_t)atoi(rest + 4) : more;
                assert_true(fabs(t->x - left) < 4 && t->y >= bottom && t->x + t->width < WIDTH - left + 2);
                bottom = t->y + t->height;
            }
            assert_true(bottom < HEIGHT && title->y > 0 && named + more == chains && (more > 0) == (chains == CHAINS));
            assert_true(pace->y > rule &&
                        find(&f.texts, chains == 1 ? "large steel : PTFE : PTFE : small steel : \u2026, striker 0.443 m/s"
                                                   : "large steel, striker 0.443 m/s"));
            const struct text *name = find(&f.texts, "Name 0"), *longer = find(&f.texts, "Name 1");
            assert_true(!longer || (longer->height < 0.95 * name->height && longer->width > 0.9 * (WIDTH - 2 * left)));
            close_film(&f);
        }
    }
}

/* Films say what moves their chains, if it is the same for all. */
static void movers_are_named(void **)
{
    static const struct {
        const char *first, *second, *words;
    } cases[] = {
        {"", NULL, "large steel, striker 0.443 m/s"},
        {"striker: {velocity: 2.5 mm/s}, ", "striker: {velocity: 2.5 mm/s}, ", "large steel, striker 2.50\u00a0mm/s"},
        {"", "striker: {velocity: 0.5 m/s}, ", "large steel"},
        {"start: [{bead: 3, velocity: 1 m/s}], ", NULL, "large steel"},
        {"drive: {bead: 0, displacement: sine, amplitude: 1 um, frequency: 5 kHz}, ", NULL, "large steel, driven at 5.00\u00a0kHz"},
        {"drive: {bead: 0, force: chirp, amplitude: 1 N, frequency: 500 Hz, to: 20 kHz}, ", NULL,
         "large steel, driven from 500\u00a0Hz to 20.0\u00a0kHz"},
        {"drive: {bead: 0, force: noise, amplitude: 1 N, frequency: 5 kHz}, ", NULL, "large steel, driven by noise"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static struct film f;
        char scene[1000], words[200];
        size_t used = (size_t)snprintf(scene, sizeof scene, "chains:\n");
        for (int c = 0; c < (cases[i].second ? 2 : 1); c++)
            used +=
                (size_t)snprintf(scene + used, sizeof scene - used, "  - {name: %c, %sbeads: [{bead: large-steel, count: 9}]}\n",
                                 'A' + c, c ? cases[i].second : cases[i].first);
        open_film(&f, scene, "magnify: 1");
        f.composer->facts.keyed = false;
        bead_facts_chain(&f.composer->facts, words, sizeof words);
        assert_string_equal(words, cases[i].words);
        close_film(&f);
    }
}

static void assert_as_new(cairo_t *cr, const char *what)
{
    cairo_matrix_t matrix;
    double x, y, right, bottom;
    cairo_get_matrix(cr, &matrix);
    cairo_clip_extents(cr, &x, &y, &right, &bottom);
    if (cairo_get_dash_count(cr) != 0 || matrix.xx != 1 || matrix.xy != 0 || matrix.x0 != 0 || matrix.y0 != 0 || x != 0 || y != 0 ||
        right != WIDTH || bottom != HEIGHT)
        fail_msg("after %s the next line would have %d dashes, or another place", what, cairo_get_dash_count(cr));
}

/* What is drawn first leaves no dashes, transformations or clips to what follows. */
static void parts_leave_nothing_behind(void **state)
{
    (void)state;
    static const char chains[] =
        "chains:\n  - {name: A, striker: {velocity: 1 m/s}, beads: [{cell: [ptfe, glass], count: 9, spins: up}], wall: brass}\n"
        "  - {name: B, striker: {velocity: 1 m/s}, beads: [{bead: large-steel, count: 18}]}\n";
    static const char *const outputs[] = {"views: [stage, profile, spacetime]",
                                          "views: [beads, profile]",
                                          "layout: overlay",
                                          "views: [spacetime], layout: columns",
                                          "inset: cell",
                                          "theme: light, follow: front"};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        struct film f;
        struct bead_message msg = {""};
        open_film(&f, chains, outputs[i]);
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
        cairo_t *cr = cairo_create(surface);
        for (size_t c = 0; c < 2; c++)
            bead_composer_draw_names(f.composer, c, cr);
        assert_as_new(cr, "names");
        bead_composer_draw_key(f.composer, cr);
        assert_as_new(cr, "the key");
        bead_overlay_draw_bar(f.composer, cr);
        assert_as_new(cr, "the bar");
        if (f.composer->layout.inset.width > 0)
            require(bead_inset_draw(f.composer, cr, &msg), &msg);
        assert_as_new(cr, "the inset");
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
        close_film(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(movers_are_named),
        cmocka_unit_test(words_are_in_their_lines),
        cmocka_unit_test(clocks_tell_frames_apart),
        cmocka_unit_test(notes_are_boxes_with_tips),
        cmocka_unit_test(races_say_who_leads),
        cmocka_unit_test(names_have_samples_of_lines),
        cmocka_unit_test(rooms_are_as_large_as_words),
        cmocka_unit_test(films_want_what_their_chains_do),
        cmocka_unit_test(headings_are_as_wide_as_measured),
        cmocka_unit_test(parts_leave_nothing_behind),
        cmocka_unit_test(cards_say_what_is_shown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
