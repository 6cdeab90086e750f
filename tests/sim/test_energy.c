/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy budget: it closes, and each part is right; so are the energies of the beads. */
#include "measures.h"
#include "sim/measure/energy_parts.h"

enum { KINETIC, CONTACTS, WALL, GRAVITY, SPRINGS, DISSIPATED, WORK, TOTAL, PARTS };

struct budget {
    size_t rows;
    double start, off, last[PARTS], most[PARTS]; /* J; off: largest distance of the total from the start's */
};

static struct budget read_budget(const char *scene, const char *more)
{
    struct bead_message msg = {""};
    char text[1024], path[512], line[512];
    snprintf(text, sizeof text,
             "%s%soutputs: [{table: e.csv, show: energy, every: 1.3 us, uncertainty: false}, {table: p.csv, show: energy, "
             "parts: place, beads: [3, 8], every: 1.3 us, uncertainty: false}]\n",
             scene, more);
    write_scene(text, path);
    if (!play(path, directory, &msg))
        fail_msg("%s", msg.text);
    snprintf(path, sizeof path, "%s/e.csv", directory);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "time_s,kinetic_J,contacts_J,wall_J,gravity_J,springs_J,dissipated_J,work_J,total_J\n");
    struct budget b = {0};
    while (fgets(line, sizeof line, file)) {
        char *at = strchr(line, ',');
        double lost = b.last[DISSIPATED];
        for (int i = 0; i < PARTS; i++) {
            b.last[i] = strtod(at + 1, &at);
            b.most[i] = fmax(b.most[i], fabs(b.last[i]));
        }
        assert_true(b.last[DISSIPATED] >= lost);
        b.start = b.rows++ == 0 ? b.last[TOTAL] : b.start;
        b.off = fmax(b.off, fabs(b.last[TOTAL] - b.start));
    }
    fclose(file);
    return b;
}

enum { FRONT, BEHIND, REFLECTED, PLACES_LOST, PLACES_WORK, PLACES_TOTAL, PAST, PAST_NEXT, PLACES };

/* Row `number` of the parts by place. */
static bool read_places(size_t number, double places[PLACES])
{
    char path[512], line[512] = "";
    snprintf(path, sizeof path, "%s/p.csv", directory);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    bool there = true;
    for (size_t i = 0; i <= number + 1 && there; i++) {
        there = fgets(line, sizeof line, file);
        assert_true(i > 0 ||
                    strcmp(line, "time_s,front_J,behind_J,reflected_J,dissipated_J,work_J,total_J,past_bead_3_J,past_bead_8_J\n") ==
                        0);
    }
    fclose(file);
    char *at = strchr(line, ',');
    for (int i = 0; i < PLACES && there; i++)
        places[i] = strtod(at + 1, &at);
    return there;
}

#define BEADS "beads: [{cell: [large-steel, aluminium], count: 6, spins: \"110101\"}]"

/* To 1e-10 of the striker's energy, in contacts that open, close, slide down and are damped. */
static void budgets_close(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *more;
        bool wall, gravity, damping;
    } cases[] = {{"chain: {" BEADS "}\n", "", false, false, false},
                 {"chain: {" BEADS ", wall: brass}\n", "simulate: {until: 0.5 ms}\n", true, false, false},
                 {"chain: {" BEADS ", wall: brass, precompression: 5 N}\n", "simulate: {until: 0.5 ms}\n", true, false, false},
                 {"chain: {" BEADS ", wall: rigid, tilt: 40 deg}\n", "simulate: {until: 0.5 ms}\n", true, true, false},
                 {"chain: {" BEADS ", wall: rigid, tilt: 40 deg, damping: {coefficient: 20, exponent: 1.8}}\n",
                  "simulate: {until: 0.4 ms}\n", true, true, true},
                 {"chain: {" BEADS ", wall: absorbing}\n", "simulate: {until: 0.5 ms}\n", false, false, true},
                 {"chain: {" BEADS ", wall: absorbing, precompression: 5 N}\n", "simulate: {until: 0.5 ms}\n", false, false, true},
                 {"chain: {" BEADS ", wall: brass, damping: {coefficient: 20, exponent: 1.8}}\n", "simulate: {until: 0.5 ms}\n",
                  true, false, true},
                 {"chain: {" BEADS ", wall: brass, law: {power: 2.2, coefficient: 1e12}}\n", "simulate: {until: 1 ms}\n", true,
                  false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct budget b = read_budget(cases[i].scene, cases[i].more);
        assert_true(b.rows > 50);
        assert_near(b.start / (0.5 * 3.63e-3 * 0.443 * 0.443), 1, 1e-14);
        assert_below(b.off, 1e-10 * b.start);
        assert_true(b.most[CONTACTS] > 0.3 * b.start);
        assert_true(cases[i].wall ? b.most[WALL] > 0.1 * b.start : b.most[WALL] == 0);
        assert_true(cases[i].gravity ? b.most[GRAVITY] > 1e-4 * b.start : b.most[GRAVITY] == 0);
        assert_true(cases[i].damping ? b.last[DISSIPATED] > 0.3 * b.start : b.most[DISSIPATED] == 0);
        double places[PLACES];
        for (size_t row = 0; row < b.rows; row += 7) {
            assert_true(read_places(row, places));
            assert_below(fabs(places[PLACES_TOTAL] - b.start), 1e-10 * b.start);
            assert_near(places[FRONT] + places[BEHIND] + places[REFLECTED] + places[PLACES_LOST], places[PLACES_TOTAL],
                        1e-14 * b.start);
            assert_true(places[PAST_NEXT] <= places[PAST] || cases[i].gravity);
        }
        assert_false(read_places(b.rows, places));
        /* The wall, or the end of the first pulse's way, has sent most of it back. */
        assert_true(places[FRONT] < 1e-3 * b.start || !cases[i].wall);
    }
}

/* An equal striker's pulse carries .99366 of the energy (an independent program); striker and beads behind it move back, and after
 * the rigid wall, all do. */
static void a_clean_pulse_is_the_front(void **state)
{
    (void)state;
    double before[PLACES], after[PLACES];
    struct budget b =
        read_budget("materials: {unit: {mass: 3.63 g, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3}}\n"
                    "chain: {striker: {bead: unit, velocity: 0.443 m/s}, beads: [{bead: unit, count: 40}], wall: rigid}\n",
                    "simulate: {until: 1.1 ms}\n");
    assert_true(read_places(400, before) && read_places(b.rows - 1, after)); /* at .52 ms, and 1.1 ms */
    assert_near(before[FRONT] / b.start, 0.99366, 6e-6);
    assert_near(before[PAST] / b.start, 0.99366, 1e-4); /* and a little of the rest behind */
    assert_near(before[REFLECTED] / b.start, 1 - 0.99366, 6e-6);
    assert_near(before[BEHIND], 0, 6e-6 * b.start);
    assert_true(after[FRONT] == 0);
    assert_near(after[REFLECTED] / b.start, 1, 6e-6);
}

/* An accuracy that is given is kept: the budget closes as well as the run does. */
static void accuracy_given_is_kept(void **state)
{
    (void)state;
    struct budget b = read_budget("chain: {" BEADS ", wall: brass}\n", "simulate: {until: 0.5 ms, accuracy: 1e-4}\n");
    assert_true(b.off > 1e-9 * b.start && b.off < 1e-4 * b.start);
}

/* The energies of the beads add up, at the wall as well: all of its contact's is the last bead's. */
static void energies_of_beads_add_up(void **state)
{
    (void)state;
    const double end = 0.3e-3;
    struct built built = build("chain: {" BEADS ", wall: brass}\n", "until: 0.3 ms, accuracy: 1e-10");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end});
    double start = 0;
    while (bead_run_time(run) < end) {
        struct bead_sample sample = sample_at(run, bead_run_time(run));
        double sum = 0;
        for (size_t j = 0; j < built.chain->beads; j++)
            sum += sample.field[BEAD_FIELD_ENERGY][j];
        start = start > 0 ? start : sum;
        assert_near(sum / start, 1, 1e-10);
        run_until(run, nextafter(bead_run_time(run), INFINITY));
    }
    bead_run_destroy(run);
    release(&built);
}

/* A pulse of three contacts that loses up to half its force from one sample to the next remains the front, whatever precedes it
 * with a force below a tenth of what it was, and whatever follows. All beads before its rear, of energy 1 each, are those in front.
 */
static void the_front_is_the_pulse_that_it_was(void **)
{
    enum { BEADS_OF_CHAIN = 101, FIRST = 10, LAST_PLACE = 80 };
    double energy[BEADS_OF_CHAIN], velocity[BEADS_OF_CHAIN], peak = 1;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 100}]}\n", "until: 1 us");
    const struct bead_output output = {.curves.parts = BEAD_PARTS_BY_PLACE};
    struct bead_energy_front front = {0};
    for (int j = 0; j < BEADS_OF_CHAIN; j++)
        energy[j] = velocity[j] = 1;
    for (size_t at = FIRST; at <= LAST_PLACE; at += 3) {
        double force[BEADS_OF_CHAIN] = {0}, parts[PARTS];
        const double before = peak;
        peak *= at % 2 ? 0.55 : 0.9;
        force[at - 1] = force[at + 1] = 0.6 * peak;
        force[at] = peak;
        force[at + 8] = at > FIRST ? 0.09 * before : 0;
        force[at - 7] = force[at - 5] = 0.8 * peak;
        const struct bead_budget budget = {.energy = energy, .force = force, .velocity = velocity};
        bead_energy_parts_find(&output, built.chain, &(struct bead_sample){.budget = &budget}, &front, parts);
        assert_true(parts[FRONT] == (double)(BEADS_OF_CHAIN - (at - 1)) && parts[REFLECTED] == 0);
        assert_true(parts[BEHIND] == (double)(at - 1));
    }
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(budgets_close), cmocka_unit_test(the_front_is_the_pulse_that_it_was),
                                       cmocka_unit_test(a_clean_pulse_is_the_front), cmocka_unit_test(accuracy_given_is_kept),
                                       cmocka_unit_test(energies_of_beads_add_up)};
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
