/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films of any chains, views, layout, look and shape, drawn by seed. Frames do not depend on those before; all words are on them
 * and apart, numbers along axes where they belong, and all is twice as large in a frame of twice the size. A film that has no room
 * for its words is refused. */
#include "film_laws.h"

enum { FILMS = 40, FIRST_SEED = 7 };
static uint64_t random_state;

static size_t any(size_t count)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(random_state >> 33) % count;
}

#define ANY(list)    (list)[any(sizeof(list) / sizeof *(list))]
#define STRUCK       "striker: {bead: large-steel, velocity: 0.4 m/s}, "
#define ANY_OF(list) any(2) ? "" : ANY(list)

static void any_chains(char *text, size_t size)
{
    static const char *const
        names[] = {"A", "a longer name", "C", "D"},
        *const beads[] = {"{bead: large-steel, count: 39}, {bead: ptfe, sensor: s}", "{bead: large-steel, count: 50}",
                          "{cell: [large-steel, aluminium], count: 25, spins: random}, {bead: brass, sensor: end}",
                          "{bead: small-steel, count: 12}, {bead: large-steel, sensor: middle}, {bead: small-steel, count: 5}",
                          "{bead: glass, count: 20, taper: 2 %}, {bead: brass, sensor: last one}"},
        *const ends[] = {"", ", wall: brass", ", wall: rigid", ", wall: aluminium, tilt: 4 deg"},
        *const labels[] = {"label: even, ", "label: half of the dimers reversed, "};
    const size_t count = 1 + any(CHAINS);
    int used = snprintf(text, size, "chains:\n");
    for (size_t c = 0; c < count; c++)
        used += snprintf(text + used, size - (size_t)used, "  - {name: \"%s\", %s" STRUCK "beads: [%s]%s}\n", names[c],
                         ANY_OF(labels), ANY(beads), ANY(ends));
}

static void any_output(char *text, size_t size)
{
    static const char *const views[] = {"views: [stage, profile, spacetime]",
                                        "views: [stage, profile]",
                                        "views: [beads, spacetime]",
                                        "views: [beads, profile, spacetime]",
                                        "views: [profile]",
                                        "views: [spacetime]",
                                        "views: [beads]",
                                        "views: [stage]",
                                        "views: [profile, spacetime]",
                                        "views: [stage, spacetime]"},
                             *const layouts[] = {", layout: stacked", ", layout: columns", ", layout: grid"},
                             *const fields[] = {", field: velocity", ", field: displacement", ", field: contact-force",
                                                ", field: energy"},
                             *const looks[] = {", theme: light", ", type: large", ", light: beads", ", theme: light, light: none"},
                             *const more[] = {
                                 ", orientation: time-right",
                                 ", orientation: time-down",
                                 ", scale: linear",
                                 ", profile: cell",
                                 ", colormap: batlow",
                                 ", beads: [3, 12]",
                                 ", captions: [{at: 0.2 ms, until: 0.6 ms, text: \"*F*_{m} first\"}, {at: 0.7 ms, text: second}]"};
    snprintf(text, size, "%s%s%s%s%s", ANY(views), ANY_OF(layouts), ANY_OF(fields), ANY_OF(looks), ANY_OF(more));
}

static bool same_words(const struct texts *a, const struct texts *b, double slack, char why[300])
{
    snprintf(why, 300, "%zu words are also %zu", a->count, b->count);
    bool same = a->count == b->count;
    for (size_t t = 0; same && t < a->count; t++) {
        const struct text *one = &a->text[t], *other = &b->text[t];
        same = strcmp(one->markup, other->markup) == 0 && is_twice(one->x, other->x, slack) && is_twice(one->y, other->y, slack);
        snprintf(why, 300, "'%.60s' at %g, %g is also '%.60s' at %g, %g", one->markup, one->x, one->y, other->markup, other->x,
                 other->y);
    }
    return same;
}

/* Beside its beads a panel has room for a striker that flies back: 1.6 of their mean distance, at least 0.9 of the type's size and
 * at most 2.6. The mean is that of the whole panel, room included. */
static void beads_have_room_to_fly(const struct bead_composer *c, const char *output)
{
    const double em = c->look.tick, pitch = c->layout.chains[0].plot[0].width / (double)c->wants.beads, around = 1.4;
    const double least = fmin(2.6 * em, fmax(0.9 * em, 1.6 * pitch)), most = fmin(2.6 * em, fmax(0.9 * em, 1.6 * around * pitch));
    if (c->layout.beyond[0] > 0 && !(c->layout.beyond[0] > least - 1 && c->layout.beyond[0] < most + 1))
        fail_msg("%s: %d px beside beads that are %g px apart", output, c->layout.beyond[0], pitch);
}

/* On stages, whose beads have sizes in steps, only words are looked at. */
static bool is_the_same_at_twice_the_size(const char *chains, const char *output, char why[300])
{
    enum { SLACK = 10 };
    static struct film f[2];
    static struct lines lines[2];
    for (int k = 0; k < 2; k++) {
        strokes_begin();
        open_film(&f[k], chains, output, 2 << k);
        draw(&f[k], feed(&f[k], 3), &(struct bead_changes){0});
        take_lines(&lines[k]);
        beads_have_room_to_fly(f[k].composer, output);
        words_are_apart(&f[k].texts, (2 << k) * film_size[0], (2 << k) * film_size[1], output);
        if (!strstr(output, "beads") && !strstr(output, "stage")) /* whose numbers are where they are */
            (void)numbers_are_in_place(&f[k].texts, output);
    }
    const bool same =
        strstr(output, "stage") || (same_lines(lines, SLACK, why) && same_words(&f[0].texts, &f[1].texts, SLACK, why));
    for (int k = 0; k < 2; k++)
        close_film(&f[k]);
    return same;
}

/* Returns whether there was room for it. */
static bool any_film(size_t seed)
{
    static const int sizes[][2] = {{480, 270}, {640, 360}, {400, 400}, {360, 640}, {720, 300}};
    static struct film f;
    struct bead_message msg = {""};
    char chains[2000], output[400], why[300];
    random_state = seed;
    (void)any(2);
    any_chains(chains, sizeof chains);
    const size_t size = any(sizeof sizes / sizeof *sizes);
    any_output(output, sizeof output);
    film_size[0] = sizes[size][0], film_size[1] = sizes[size][1];
    const bool placed = try_film(&f, chains, output, 1, &msg);
    close_film(&f);
    if (placed) {
        assert_nothing_trails(chains, output);
        bool same = false;
        for (int i = 0; i < 3 && !same;
             i++, film_size[0] += 8, film_size[1] += 8) /* rounding decides in one size, but not in all */
            same = is_the_same_at_twice_the_size(chains, output, why);
        if (!same)
            fail_msg("%s: %s", output, why);
    } else if (!strstr(msg.text, "room") && !strstr(msg.text, "too small")) {
        fail_msg("%s: %s", output, msg.text);
    }
    return placed;
}

static void any_film_keeps_the_laws(void **)
{
    size_t placed = 0;
    for (size_t seed = FIRST_SEED; seed < FIRST_SEED + FILMS; seed++)
        placed += any_film(seed);
    assert_true(placed > FILMS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_film_keeps_the_laws)};
    return cmocka_run_group_tests_name("any frames", tests, NULL, NULL);
}
