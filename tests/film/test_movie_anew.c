/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways to the same film. Films are drawn by what changes: each frame is the same as one drawn without those before it, and as
 * the frame before with what is told to have changed: nothing trails, in layouts with each kind of view, word and mark. */
#include <unistd.h>

#include "film_laws.h"
#include "sessions.h"
#include "tests/pictures.h"

#define STRUCK "striker: {bead: large-steel, velocity: 0.4 m/s}, "
static const char one[] = "chain: {" STRUCK "beads: [{bead: large-steel, count: 39}, {bead: ptfe, sensor: s}], wall: brass}",
                  two[] =
                      "chains:\n  - {name: A, label: even, " STRUCK "beads: [{bead: large-steel, count: 50}]}\n"
                      "  - {name: B, " STRUCK "beads: [{cell: [large-steel, aluminium], count: 25, spins: random}], wall: rigid}\n";
static const struct {
    const char *chains, *output;
} films[] = {
    {two, "race: true, captions: [{at: 0.2 ms, until: 0.6 ms, text: first}, {at: 0.7 ms, text: second}], "
          "notes: [{at: 0.3 ms, until: 0.8 ms, bead: 5, text: here}]"},
    {two, "layout: columns, views: [beads, profile, spacetime], theme: light"},
    {one, "layout: stacked, views: [beads, profile, spacetime], field: velocity"},
    {one, "views: [stage, profile, spacetime], follow: front"},
    {one, "views: [sensors, spacetime], orientation: time-right, trust: true"},
    {two, "layout: overlay, views: [profile, beads]"},
    {two, "layout: grid, theme: light, field: velocity, profile: cell"},
    {two, "layout: beside, type: large"},
    {two, "layout: images, views: [beads, spacetime]"},
    {two, "inset: cell, light: beads, theme: light"},
    {one, "views: [stage, sensors], theme: light"},
};

static void films_do_not_depend_on_frames_before(void **)
{
    for (size_t i = 0; i < sizeof films / sizeof *films; i++)
        assert_nothing_trails(films[i].chains, films[i].output);
}

/* ---- equal chains ---- */

/* The share of pixels of two plots that differ. */
static double differing(const struct bead_frame *frame, struct bead_rect a, struct bead_rect b)
{
    int differ = 0;
    assert_true(a.width == b.width && a.height == b.height);
    for (int y = 0; y < a.height; y++) {
        const uint8_t *p = frame->pixels + (size_t)(a.y + y) * frame->stride + 4 * (size_t)a.x;
        const uint8_t *q = frame->pixels + (size_t)(b.y + y) * frame->stride + 4 * (size_t)b.x;
        for (int x = 0; x < a.width; x++)
            differ += memcmp(p + 4 * x, q + 4 * x, 3) != 0;
    }
    return (double)differ / (a.width * a.height);
}

/* What is drawn of one chain is drawn of the next. */
static void equal_chains_look_equal(void **)
{
#define EQUAL "beads: [{bead: large-steel, count: 24}], wall: brass}\n"
    static const char equal[] = "chains:\n  - {name: A, " STRUCK EQUAL "  - {name: B, " STRUCK EQUAL;
    static const char *const outputs[] = {
        "layout: columns, views: [beads, profile, spacetime]", "layout: stacked, views: [beads, spacetime], theme: light",
        "layout: grid, field: velocity", "layout: beside", "layout: images, views: [beads, spacetime], orientation: time-down"};
    static struct film f;
    ahead = 0;
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        open_film(&f, equal, outputs[i], 1);
        for (int k = 0; k < 5; k++)
            draw(&f, feed(&f, k), &(struct bead_changes){0});
        const struct bead_movie_layout *l = &f.composer->layout;
        int compared = 0;
        for (size_t v = 0; v < f.composer->wants.view_count; v++) {
            const struct bead_rect a = l->chains[0].plot[v], b = l->chains[1].plot[v];
            const double apart = a.width > 0 && b.width > 0 ? differing(bead_composer_frame(f.composer), a, b) : 0;
            assert_true((a.width > 0) == (b.width > 0) || v == l->overlay);
            if (apart > 0)
                fail_msg("%s: %g of view %zu differ", outputs[i], apart, v);
            compared += a.width > 0;
        }
        assert_true(compared > 0);
        close_film(&f);
    }
    ahead = 0.4;
}

static int by_words(const void *a, const void *b)
{
    return strcmp(((const struct text *)a)->markup, ((const struct text *)b)->markup);
}

/* Films of chains that differ say the same in any order. */
static void chains_have_no_order(void **)
{
#define ONE "  - {name: A, label: even, " STRUCK "beads: [{bead: large-steel, count: 50}]}\n"
#define TWO "  - {name: B, " STRUCK "beads: [{cell: [large-steel, aluminium], count: 25, spins: random}], wall: rigid}\n"
    static const char *const chains[] = {"chains:\n" ONE TWO, "chains:\n" TWO ONE};
    static struct film f[2];
    ahead = 0;
    for (size_t i = 1; i < sizeof films / sizeof *films; i++) {
        if (films[i].chains != two || strstr(films[i].output, "inset")) /* an inset has the room of one chain */
            continue;
        for (int k = 0; k < 2; k++) {
            open_film(&f[k], chains[k], films[i].output, 2);
            draw(&f[k], feed(&f[k], 3), &(struct bead_changes){0});
            qsort(f[k].texts.text, f[k].texts.count, sizeof *f[k].texts.text, by_words);
        }
        assert_int_equal(f[0].texts.count, f[1].texts.count);
        for (size_t t = 0; t < f[0].texts.count; t++) {
            if (strcmp(f[0].texts.text[t].markup, f[1].texts.text[t].markup) != 0)
                fail_msg("%s: '%s' is '%s' in another order", films[i].output, f[0].texts.text[t].markup,
                         f[1].texts.text[t].markup);
        }
        for (int k = 0; k < 2; k++)
            close_film(&f[k]);
    }
    ahead = 0.4;
}

/* ---- size ---- */

static bool is_said(const struct texts *texts, const char *words)
{
    for (size_t i = 0; i < texts->count; i++) {
        const char *markup = texts->text[i].markup;
        if (strlen(words) == 1 ? strcmp(markup, words) == 0 : strstr(markup, words) != NULL)
            return true;
    }
    return false;
}

/* The film, its time and speed, and its chains by name. */
static void words_are_there(const struct texts *texts, const char *chains, const char *output)
{
    const char *words[] = {"A film", "ms", "times", "A", "B"};
    for (size_t i = 0; i < (chains == two ? 5 : 3); i++) {
        if (!is_said(texts, words[i]))
            fail_msg("%s: nothing says '%s'", output, words[i]);
    }
}

/* All words and lines are twice as large and as far from the corner in a frame of twice the size. Places are rounded to pixels; on
 * stages beads have sizes in steps, of which places depend. */
static void films_are_the_same_at_twice_the_size(void **)
{
    static struct film f[2];
    static struct lines lines[2];
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        for (int k = 0; k < 2; k++) {
            strokes_begin();
            open_film(&f[k], films[i].chains, films[i].output, 2 << k);
            draw(&f[k], feed(&f[k], 3), &(struct bead_changes){0});
            take_lines(&lines[k]);
        }
        const double slack = strstr(films[i].output, "layout:") || strstr(films[i].output, "sensors") ? 10 : 56;
        char why[300];
        if (lines[0].count == 0 || !same_lines(lines, slack, why))
            fail_msg("%s: %s", films[i].output, why);
        assert_true(f[0].texts.count > 10);
        words_are_there(&f[1].texts, films[i].chains, films[i].output);
        words_are_apart(&f[1].texts, 4 * film_size[0], 4 * film_size[1], films[i].output);
        assert_true(numbers_are_in_place(&f[1].texts, films[i].output) > 2);
        assert_int_equal(f[0].texts.count, f[1].texts.count);
        for (size_t t = 0; t < f[0].texts.count; t++) {
            const struct text *a = &f[0].texts.text[t], *b = &f[1].texts.text[t];
            if (strcmp(a->markup, b->markup) != 0 || !is_twice(a->x, b->x, slack) || !is_twice(a->y, b->y, slack) ||
                !is_twice(a->width, b->width, 1 + 0.03 * b->width) || !is_twice(a->height, b->height, 1))
                fail_msg("%s: '%s' at %g, %g, %g wide, %g high, is also '%s' at %g, %g, %g wide, %g high", films[i].output,
                         a->markup, a->x, a->y, a->width, a->height, b->markup, b->x, b->y, b->width, b->height);
        }
        for (int k = 0; k < 2; k++)
            close_film(&f[k]);
    }
}

/* ---- films through their buffers ---- */

static struct png_file picture_of(const char *name)
{
    char path[512];
    in_directory(name, path, sizeof path);
    return read_png(path);
}

static bool same_picture(const struct png_file *a, const struct png_file *b)
{
    return a->width == b->width && a->height == b->height && memcmp(a->rgb, b->rgb, 3 * (size_t)a->width * (size_t)a->height) == 0;
}

/* Frames are found by their part of the film, and by their time; other ones differ. Of four, those after 0, 2/3 and all of 0.2 ms.
 */
static void frames_are_found(void **)
{
    static const char *const asked[][2] = {{"0%", "0 s"}, {"50%", "0.13 ms"}, {"100%", "0.2 ms"}};
    enum { FOUND = sizeof asked / sizeof *asked };
    struct png_file found[FOUND][2];
    char scene[512], frame[512], text[1000];
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("frame.png", frame, sizeof frame);
    snprintf(text, sizeof text,
             "%s\nsimulate: {until: 0.2 ms}\noutputs: [{movie: m.gif, size: [320, 241], fps: 10, duration: 0.4 s}]\n", one);
    write_text(scene, text);
    for (int i = 0; i < FOUND; i++) {
        for (int k = 0; k < 2; k++) {
            play_counts((struct bead_job){.input = scene, .output = frame, .frame = asked[i][k], .threads = 1});
            found[i][k] = picture_of("frame.png");
        }
        assert_true(found[i][0].width == 320 && found[i][0].height == 241);
        assert_true(same_picture(&found[i][0], &found[i][1]));
        assert_true(i == 0 || !same_picture(&found[i][0], &found[i - 1][0]));
    }
    for (int i = 0; i < 2 * FOUND; i++)
        free(found[i / 2][i % 2].rgb);
}

/* A film's samples and frames pass through buffers and threads; a single frame is drawn from the samples as they come. */
static void posters_are_frames(void **)
{
    static const struct {
        const char *chains, *output;
    } kinds[] = {{one, "beads: [4, 11], views: [profile, spacetime]"},
                 {one, "beads: [4, 11], views: [beads, spacetime]"},
                 {two, "layout: columns, beads: [0, 11], views: [profile]"}};
    char scene[512], output[512], frame[512];
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    in_directory("frame.png", frame, sizeof frame);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "%s\nsimulate: {until: 0.2 ms}\noutputs: [{movie: m.gif, size: [320, 240], fps: 10, duration: 0.4 s, poster: "
                 "poster.png, "
                 "%s}]\n",
                 kinds[i].chains, kinds[i].output);
        write_text(scene, text);
        play_counts((struct bead_job){.input = scene, .output = output, .threads = 2});
        play_counts((struct bead_job){.input = scene, .output = frame, .frame = "peak", .threads = 1});
        struct png_file a = picture_of("poster.png"), b = picture_of("frame.png");
        if (i == 0) { /* beside the film, wherever that is */
            char film[512], poster[512];
            in_directory("other.gif", film, sizeof film);
            in_directory("poster.png", poster, sizeof poster);
            assert_int_equal(unlink(poster), 0);
            play_counts((struct bead_job){.input = scene, .output = film, .threads = 2});
            assert_int_equal(access(poster, F_OK), 0);
        }
        assert_true(same_picture(&a, &b));
        free(a.rgb);
        free(b.rgb);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_do_not_depend_on_frames_before),
        cmocka_unit_test(films_are_the_same_at_twice_the_size),
        cmocka_unit_test(equal_chains_look_equal),
        cmocka_unit_test(chains_have_no_order),
        cmocka_unit_test(posters_are_frames),
        cmocka_unit_test(frames_are_found),
    };
    return cmocka_run_group_tests_name("films drawn anew", tests, make_directory, remove_directory);
}
