/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The library's player, and chains made from arrays: the same numbers as scenes, and calls that make no sense. */
#include "support.h"

#include "beadreel/law.h"
#include "beadreel/play.h"

static const struct bead_properties steel = {.radius = 4.76e-3, .mass = 3.63e-3, .modulus = 193e9, .poisson = 0.30};
static const struct bead_properties aluminium = {.radius = 4.76e-3, .mass = 1.26e-3, .modulus = 72.4e9, .poisson = 0.33};
static const struct bead_properties brass = {.modulus = 90.2e9, .poisson = 0.34};

static struct bead_chain *make(const struct bead_chain_settings *settings)
{
    struct bead_message msg = {""};
    struct bead_chain *chain;
    if (bead_chain_make(settings, &chain, &msg))
        fail_msg("%s", msg.text);
    return chain;
}

static struct bead_chain *make_steel(size_t count)
{
    return make(&(struct bead_chain_settings){
        .size = sizeof(struct bead_chain_settings), .beads = &steel, .count = 1, .repeat = count, .velocity = 0.4});
}

static struct bead_player *start(struct bead_player_settings settings)
{
    struct bead_message msg = {""};
    struct bead_player *player;
    settings.size = sizeof settings;
    if (bead_player_create(&settings, &player, &msg))
        fail_msg("%s", msg.text);
    return player;
}

static const struct bead_outcome *finish(struct bead_player *player)
{
    struct bead_message msg = {""};
    const struct bead_outcome *outcome = NULL;
    if (bead_player_until(player, INFINITY, &msg) || bead_player_finish(player, &outcome, &msg))
        fail_msg("%s", msg.text);
    return outcome;
}

static void assert_same_chain(const struct bead_chain *a, const struct bead_chain *b)
{
    const double *(*const of_beads[])(const struct bead_chain *) = {bead_chain_mass, bead_chain_radius, bead_chain_position},
                                                              *(*const of_contacts[])(const struct bead_chain *) = {
                                                                  bead_chain_stiffness, bead_chain_static_force,
                                                                  bead_chain_static_compression};
    const size_t beads = bead_chain_beads(a), contacts = bead_chain_contacts(a);
    assert_true(bead_chain_beads(b) == beads && bead_chain_contacts(b) == contacts);
    for (int i = 0; i < 3; i++) {
        assert_memory_equal(of_beads[i](a), of_beads[i](b), beads * sizeof(double));
        assert_memory_equal(of_contacts[i](a), of_contacts[i](b), contacts * sizeof(double));
    }
    assert_true(bead_chain_energy(a) == bead_chain_energy(b));
    assert_string_equal(bead_chain_spins(a), bead_chain_spins(b));
}

static void assert_same_run(const struct bead_chain *a, const struct bead_chain *b)
{
    const struct bead_chain *const chains[] = {a, b};
    struct bead_player *player[2];
    const struct bead_outcome *of[2];
    for (int i = 0; i < 2; i++) {
        player[i] = start((struct bead_player_settings){.chain = chains[i], .contact_peaks = true});
        of[i] = finish(player[i]);
        assert_null(of[i]->contact_uncertainty);
    }
    for (size_t k = 0; k < bead_chain_contacts(a); k++) {
        assert_true(of[0]->contact_peaks[k].value == of[1]->contact_peaks[k].value);
        assert_true(of[0]->contact_peaks[k].time == of[1]->contact_peaks[k].time);
    }
    assert_true(of[0]->end == of[1]->end && of[0]->steps == of[1]->steps && of[0]->energy_end == of[1]->energy_end);
    for (int i = 0; i < 2; i++)
        bead_player_destroy(player[i]);
}

/* The same chain from text and from arrays: the same numbers, to the bit. */
static void chain_from_arrays_is_that_of_a_scene(void **)
{
    const struct bead_properties cell[] = {steel, aluminium};
    const struct {
        const char *scene;
        struct bead_chain_settings made;
    } chains[] = {
        {"beads: [{cell: [large-steel, aluminium], count: 10}], wall: brass, precompression: 3 N",
         {.count = 2, .repeat = 10, .velocity = 0.443, .wall = BEAD_WALL_MATERIAL, .wall_material = brass, .precompression = 3}},
        {"striker: {bead: aluminium, velocity: 0.3 m/s}, beads: [{cell: [large-steel, aluminium], count: 5}], wall: rigid",
         {.count = 2, .repeat = 5, .velocity = 0.3, .striker = aluminium, .wall = BEAD_WALL_RIGID}},
        {"striker: {bead: large-steel, velocity: 0.3 m/s}, beads: [{bead: large-steel, count: 8}], wall: brass, tilt: 0.5 rad, "
         "damping: {coefficient: 2, exponent: 1.8}",
         {.count = 1,
          .repeat = 8,
          .velocity = 0.3,
          .wall = BEAD_WALL_MATERIAL,
          .wall_material = brass,
          .tilt = 0.5,
          .damping_coefficient = 2}},
        {"striker: {bead: large-steel, velocity: 0.3 m/s}, beads: [{bead: large-steel, count: 8}], damping: {coefficient: 2, "
         "exponent: 1.25}",
         {.count = 1, .repeat = 8, .velocity = 0.3, .damping_coefficient = 2, .damping_exponent = 1.25}},
        {"striker: {bead: large-steel, velocity: 0.3 m/s}, beads: [{cell: [large-steel, aluminium]}], law: {power: 2.25, "
         "coefficient: 1e+12}",
         {.count = 2, .velocity = 0.3, .law = {.row = bead_law_find("power"), .power = 2.25, .coefficient = 1e12}}},
    };
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char text[400];
        struct bead_chain_settings settings = chains[i].made;
        settings.size = sizeof settings;
        settings.beads = cell;
        snprintf(text, sizeof text, "chain: {%s}\n", chains[i].scene);
        struct built built = build(text, "");
        struct bead_chain *made = make(&settings);
        assert_same_chain(made, built.chain);
        assert_same_run(made, built.chain);
        bead_chain_destroy(made);
        release(&built);
    }
}

/* Exactly the peaks that are lower than those of a run over the same time, which search all of it, are said to be exceeded. */
static void tell_later_forces(const char *chain)
{
    struct built built = build(chain, "");
    struct bead_player *passage =
        start((struct bead_player_settings){.chain = built.chain, .contact_peaks = true, .bead_peaks = true});
    const struct bead_outcome *first = finish(passage);
    struct bead_player *whole =
        start((struct bead_player_settings){.chain = built.chain, .until = first->end, .contact_peaks = true, .bead_peaks = true});
    const struct bead_outcome *all = finish(whole);
    const struct bead_peak *const found[][2] = {{first->contact_peaks, all->contact_peaks}, {first->bead_peaks, all->bead_peaks}};
    size_t exceeded = 0;
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < bead_chain_contacts(built.chain); i++) {
            assert_int_equal(found[kind][0][i].exceeded, found[kind][1][i].value > found[kind][0][i].value * (1 + 1e-6));
            assert_false(found[kind][1][i].exceeded);
            exceeded += found[kind][0][i].exceeded;
        }
    }
    assert_true(exceeded > 0);
    bead_player_destroy(passage);
    bead_player_destroy(whole);
    release(&built);
}

static void later_forces_are_told(void **)
{
    tell_later_forces("chain: {striker: {velocity: 1 m/s}, wall: rigid, "
                      "beads: [{cell: [aluminium, ptfe], count: 12, spins: random, seed: 1}]}\n");
}

/* Contact 8 is higher than its first peak as the run ends, within its last step. */
static void later_forces_of_last_steps_are_told(void **)
{
    tell_later_forces("materials: {m: {density: 3308.9, modulus: 5.7834 GPa, poisson: 0.446, radius: 7.0009 mm}}\n"
                      "chain: {striker: {bead: m, velocity: 5.2246 m/s}, wall: rigid,\n"
                      "  law: {fpu-alpha: 8.42, stiffness: 5.14e+08}, beads: [{bead: m, count: 10}]}\n");
}

/* Contact 13 is higher later by 2.4e-4, within a step, and lower at both ends of it. */
static void later_forces_within_steps_are_told(void **)
{
    tell_later_forces("materials:\n"
                      "  big: {density: 1109.7, modulus: 18.168 GPa, poisson: 0.181, radius: 19.043 mm}\n"
                      "  small: {density: 6475.9, modulus: 2.4393 GPa, poisson: 0.211, radius: 2.6901 mm}\n"
                      "chain: {striker: {bead: small, velocity: 0.59014 m/s}, wall: brass, tilt: 17.9 deg, beads: [\n"
                      "  {bead: big, count: 2}, {bead: small, count: 10}, {bead: big, count: 3}, {cell: [small, big], count: 2},\n"
                      "  {bead: small, count: 2}, {bead: big, count: 4}, {bead: small, count: 2}, {bead: big, count: 2},\n"
                      "  {bead: small, count: 3}, {bead: big, count: 2}, {bead: small}, {bead: big, count: 2}]}\n");
}

static void mass_follows_from_density(void **)
{
    const struct bead_properties bead = {.radius = 1e-2, .density = 7800, .modulus = 1e9, .poisson = 0.3};
    struct bead_chain *chain =
        make(&(struct bead_chain_settings){.size = sizeof(struct bead_chain_settings), .beads = &bead, .count = 1, .velocity = 1});
    assert_int_equal(bead_chain_beads(chain), 2);
    assert_near(bead_chain_mass(chain)[0], 7800 * 4.18879020478639e-6, 1e-15);
    assert_near(bead_chain_mass(chain)[1], 7800 * 4.18879020478639e-6, 1e-15);
    bead_chain_destroy(chain);
}

static void wrong_chains_say_what_is_wrong(void **)
{
    const struct bead_properties heavy = {.radius = 1e-3, .density = 1, .mass = 1, .modulus = 1, .poisson = 0.3};
    const struct bead_properties soft[] = {steel, {.radius = 1e-3, .density = 1, .modulus = -1, .poisson = 0.3}};
    const struct bead_properties flat = {.radius = 1e-3, .density = 1, .modulus = 1, .poisson = 0.6};
    const struct bead_properties point = {.density = 1, .modulus = 1, .poisson = 0.3};
    const struct bead_properties hollow = {.radius = 1e-3, .density = 1, .modulus = 1, .poisson = -1};
    static const struct bead_law unfinished = {.name = "unfinished"};
    const struct {
        struct bead_chain_settings settings;
        const char *says;
    } cases[] = {
        {{.count = 1}, "`beads`"},
        {{.beads = &steel}, "count: 0"},
        {{.beads = &steel, .count = 1, .repeat = 200000000}, "1e8 beads"},
        {{.beads = &steel, .count = 1, .velocity = NAN}, "velocity: nan"},
        {{.beads = &steel, .count = 1, .precompression = -1}, "precompression: -1"},
        {{.beads = &steel, .count = 1, .tilt = 0.1}, "tilt: 0.1; must be 0 where no wall"},
        {{.beads = &steel, .count = 1, .wall = BEAD_WALL_RIGID, .tilt = 1.5707963267949}, "tilt: 1.5708; must be from 0 to"},
        {{.beads = &steel, .count = 1, .wall = BEAD_WALL_MATERIAL + 1}, "wall: 3"},
        {{.beads = &steel, .count = 1, .damping_coefficient = -1}, "damping_coefficient: -1"},
        {{.beads = &steel, .count = 1, .damping_exponent = 10}, "damping_exponent"},
        {{.beads = &hollow, .count = 1}, "beads[0].poisson: -1"},
        {{.beads = &heavy, .count = 1}, "beads[0].mass"},
        {{.beads = soft, .count = 2}, "beads[1].modulus: -1"},
        {{.beads = &flat, .count = 1}, "beads[0].poisson: 0.6"},
        {{.beads = &point, .count = 1, .name = "mine"}, "mine: beads[0].radius: 0"},
        {{.beads = &steel, .count = 1, .striker = point}, "striker[0].radius"},
        {{.beads = &steel, .count = 1, .wall = BEAD_WALL_MATERIAL}, "wall_material[0].modulus"},
        {{.beads = &steel, .count = 1, .law = {.row = &unfinished}}, "unfinished"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_message msg = {""};
        struct bead_chain *chain = NULL;
        struct bead_chain_settings settings = cases[i].settings;
        settings.size = sizeof settings;
        assert_int_equal(bead_chain_make(&settings, &chain, &msg), BEAD_ERROR_USAGE);
        assert_null(chain);
        if (!strstr(msg.text, cases[i].says))
            fail_msg("%s: not in: %s", cases[i].says, msg.text);
        settings.size = 7;
        assert_int_equal(bead_chain_make(&settings, &chain, NULL), BEAD_ERROR_USAGE);
    }
}

/* What is at the end of a range is allowed. A chain that stands on a wall bears its weight, bead by bead, before the striker comes.
 */
static void ends_of_ranges_are_allowed(void **)
{
    struct bead_properties rubber = steel;
    rubber.poisson = 0.5;
    struct bead_chain_settings settings = {.size = sizeof settings,
                                           .beads = &rubber,
                                           .count = 1,
                                           .repeat = 4,
                                           .wall = BEAD_WALL_MATERIAL,
                                           .wall_material = rubber,
                                           .tilt = 1.5707963267948968,
                                           .damping_exponent = nextafter(10, 0)};
    struct bead_chain *chain = make(&settings);
    assert_int_equal(bead_chain_contacts(chain), 5);
    for (size_t k = 0; k < 5; k++)
        assert_near(bead_chain_static_force(chain)[k], (double)k * steel.mass * 9.80665, 1e-14);
    bead_chain_destroy(chain);
    settings.repeat = 0;
    settings.damping_exponent = settings.tilt = 0;
    chain = make(&settings);
    assert_int_equal(bead_chain_beads(chain), 2);
    assert_true(bead_chain_energy(chain) == 0 && bead_chain_static_force(chain)[1] == 0);
    bead_chain_destroy(chain);
}

struct taken {
    size_t count;
    double last, largest;
    enum bead_error answer;
};

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *msg)
{
    struct taken *taken = context;
    assert_int_equal(sample->index, taken->count);
    assert_near(sample->time, 1e-6 * (double)taken->count, 1e-15);
    assert_null(sample->field[BEAD_FIELD_VELOCITY]);
    taken->largest = fmax(taken->largest, sample->field[BEAD_FIELD_FORCE][5]);
    taken->last = sample->time;
    taken->count++;
    return taken->count == 50 && taken->answer ? bead_fail(msg, taken->answer, "fifty are enough") : BEAD_OK;
}

static struct bead_player_settings taking(const struct bead_chain *chain, struct taken *taken)
{
    return (struct bead_player_settings){.chain = chain,
                                         .until = 2e-4,
                                         .bead_peaks = true,
                                         .take = take,
                                         .context = taken,
                                         .fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE),
                                         .every = 1e-6};
}

/* In one go, step by step, and from time to time: the same samples and the same peaks. */
static void ways_to_play_are_one(void **)
{
    struct bead_chain *chain = make_steel(15);
    struct taken taken[3] = {{0}, {0}, {0}};
    double peak[3];
    for (size_t way = 0; way < 3; way++) {
        struct bead_message msg = {""};
        struct bead_player *player = start(taking(chain, &taken[way]));
        double last = 0;
        while (way == 1 && !bead_player_is_over(player)) {
            assert_int_equal(bead_player_step(player, &msg), BEAD_OK);
            assert_true(bead_player_time(player) > last);
            last = bead_player_time(player);
            assert_true(taken[way].last > last - 1e-6);
        }
        for (int i = 0; way == 2 && i < 7; i++)
            assert_int_equal(bead_player_until(player, 3.1e-5 * i, &msg), BEAD_OK);
        peak[way] = finish(player)->bead_peaks[5].value;
        assert_int_equal(taken[way].count, 201);
        assert_true(taken[way].largest == taken[0].largest && peak[way] == peak[0]);
        assert_true(taken[way].largest < peak[way] && taken[way].largest > 0.99 * peak[way]);
        bead_player_destroy(player);
    }
    bead_chain_destroy(chain);
}

static void state_between_steps(void **)
{
    struct bead_message msg = {""};
    struct bead_sample sample;
    struct bead_chain *chain = make_steel(15);
    struct bead_player *player = start((struct bead_player_settings){.chain = chain});
    assert_int_equal(bead_player_sample(player, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), &sample, &msg), BEAD_OK);
    assert_near(sample.field[BEAD_FIELD_VELOCITY][0], 0.4, 0);
    assert_int_equal(bead_player_until(player, 5e-5, &msg), BEAD_OK);
    assert_int_equal(bead_player_sample(player, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), &sample, &msg), BEAD_OK);
    assert_near(sample.time, bead_player_time(player), 0);
    double momentum = 0;
    for (size_t j = 0; j < 16; j++)
        momentum += 3.63e-3 * (j < sample.active ? sample.field[BEAD_FIELD_VELOCITY][j] : 0);
    assert_near(momentum / (3.63e-3 * 0.4), 1, 1e-12);
    assert_int_equal(bead_player_sample(player, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN), &sample, &msg), BEAD_ERROR_USAGE);
    bead_player_destroy(player);
    bead_chain_destroy(chain);
}

static void uncertainty_is_that_asked_for(void **)
{
    struct bead_chain *chain = make_steel(15);
    struct bead_player *player = start((struct bead_player_settings){.chain = chain, .contact_peaks = true, .uncertainty = true});
    const struct bead_outcome *outcome = finish(player);
    assert_non_null(outcome->contact_uncertainty);
    for (size_t k = 0; k < 15; k++) {
        assert_true(outcome->contact_uncertainty[k] > 0);
        assert_below(outcome->contact_uncertainty[k] / outcome->contact_peaks[k].value, 1e-5);
    }
    bead_player_destroy(player);
    bead_chain_destroy(chain);
}

/* A finished player can do nothing more, and a failed one keeps failing. */
static void calls_out_of_order_fail(void **)
{
    struct bead_message msg = {""};
    const struct bead_outcome *outcome;
    struct bead_sample sample;
    struct bead_chain *chain = make_steel(15);
    struct taken taken = {.answer = BEAD_ERROR_IO};
    struct bead_player *player = start(taking(chain, &taken));
    assert_int_equal(bead_player_until(player, NAN, &msg), BEAD_ERROR_USAGE);
    assert_int_equal(bead_player_until(player, 1, &msg), BEAD_ERROR_IO);
    assert_string_equal(msg.text, "fifty are enough");
    assert_int_equal(taken.count, 50);
    assert_int_equal(bead_player_until(player, 1, &msg), BEAD_ERROR_IO);
    assert_int_equal(bead_player_step(player, NULL), BEAD_ERROR_IO);
    assert_int_equal(bead_player_sample(player, 1, &sample, NULL), BEAD_ERROR_IO);
    assert_int_equal(bead_player_finish(player, &outcome, &msg), BEAD_ERROR_IO);
    assert_string_equal(msg.text, "fifty are enough");
    assert_null(outcome);
    assert_int_equal(taken.count, 50);
    bead_player_destroy(player);

    player = start((struct bead_player_settings){.chain = chain, .until = 1e-5});
    assert_int_equal(bead_player_until(player, 1, &msg), BEAD_OK);
    assert_true(bead_player_is_over(player));
    assert_int_equal(bead_player_step(player, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "the run is over at 1e-05 s"));
    assert_int_equal(bead_player_finish(player, &outcome, &msg), BEAD_OK);
    assert_null(outcome->contact_peaks);
    struct bead_message again = {""};
    const struct bead_outcome *other;
    assert_int_equal(bead_player_finish(player, &other, &again), BEAD_ERROR_USAGE);
    assert_int_equal(bead_player_until(player, 1, NULL), BEAD_ERROR_USAGE);
    assert_int_equal(bead_player_step(player, NULL), BEAD_ERROR_USAGE);
    assert_int_equal(bead_player_sample(player, 1, &sample, NULL), BEAD_ERROR_USAGE);
    assert_non_null(strstr(again.text, "has been finished"));
    assert_true(outcome->end == 1e-5);
    bead_player_destroy(player);
    bead_player_destroy(NULL);
    bead_chain_destroy(chain);
}

static void stopped_players_go_on(void **)
{
    struct bead_message msg = {""};
    const struct bead_outcome *outcome;
    struct bead_chain *chain = make_steel(15);
    volatile sig_atomic_t stop = 0;
    struct taken taken = {0};
    struct bead_player_settings settings = taking(chain, &taken);
    settings.stop = &stop;
    settings.uncertainty = true;
    struct bead_player *player = start(settings);
    assert_int_equal(bead_player_until(player, 1e-4, &msg), BEAD_OK);
    stop = 15;
    assert_int_equal(bead_player_until(player, 2e-4, &msg), BEAD_ERROR_STOPPED);
    assert_int_equal(bead_player_finish(player, &outcome, &msg), BEAD_ERROR_STOPPED); /* no comparison run */
    stop = 0;
    assert_int_equal(bead_player_until(player, 2e-4, &msg), BEAD_OK);
    assert_int_equal(taken.count, 201);
    assert_int_equal(bead_player_finish(player, &outcome, &msg), BEAD_OK);
    assert_non_null(outcome->bead_uncertainty);
    bead_player_destroy(player);
    bead_chain_destroy(chain);
}

static void wrong_settings_say_what_is_wrong(void **)
{
    struct bead_chain *chain = make_steel(5);
    static const char text[] = "chain: {equation: fput, points: 31, start: {pulse: 0.1, width: 5, at: 15}}\n"
                               "simulate: {until: 10}\noutputs: [{trajectory: a.h5}]\n";
    struct built string;
    assert_int_equal(bead_scene_parse("string", text, sizeof text - 1, NULL, &string.scene, NULL), BEAD_OK);
    assert_int_equal(bead_chain_create(string.scene, 0, &string.chain, NULL), BEAD_OK);
    const struct {
        struct bead_player_settings settings;
        enum bead_error error;
        const char *says;
    } cases[] = {
        {{.until = 1}, BEAD_ERROR_USAGE, "no chain"},
        {{.chain = chain, .until = -1}, BEAD_ERROR_USAGE, "until -1"},
        {{.chain = chain, .accuracy = 1}, BEAD_ERROR_USAGE, "accuracy 1"},
        {{.chain = chain, .method = "euler"}, BEAD_ERROR_SCENE, "euler"},
        {{.chain = chain, .step = 1}, BEAD_ERROR_SCENE, "too long"},
        {{.chain = chain, .every = 1}, BEAD_ERROR_USAGE, "give all of them or none"},
        {{.chain = chain, .every = 1, .take = take}, BEAD_ERROR_USAGE, "give all of them or none"},
        {{.chain = chain, .every = 1, .take = take, .fields = 1u << BEAD_FIELD_STRAIN}, BEAD_ERROR_USAGE, "fields 0x40"},
        {{.chain = chain, .instructions = "mmx"}, BEAD_ERROR_USAGE, "mmx"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_message msg = {""};
        struct bead_player *player;
        struct bead_player_settings settings = cases[i].settings;
        settings.size = sizeof settings;
        assert_int_equal(bead_player_create(&settings, &player, &msg), cases[i].error);
        assert_null(player);
        if (!strstr(msg.text, cases[i].says))
            fail_msg("%s: not in: %s", cases[i].says, msg.text);
    }
    struct bead_player_settings settings = {.size = sizeof settings, .chain = string.chain}; /* equations have ends in scenes */
    struct bead_player *player;
    assert_int_equal(bead_player_create(&settings, &player, NULL), BEAD_OK);
    assert_near(finish(player)->end, 10, 0);
    bead_player_destroy(player);
    release(&string);
    bead_chain_destroy(chain);
}

/* A run is over at its end, or at that of the passage, and whenever it has been finished, not before. */
static void runs_are_over_at_their_end(void **)
{
    struct bead_message msg = {""};
    const struct bead_outcome *outcome;
    struct bead_chain *chain = make_steel(15);
    struct bead_player *early = start((struct bead_player_settings){.chain = chain, .until = 1e-3, .contact_peaks = true});
    assert_int_equal(bead_player_until(early, 1e-5, &msg), BEAD_OK);
    assert_false(bead_player_is_over(early));
    assert_int_equal(bead_player_finish(early, &outcome, &msg), BEAD_OK);
    assert_true(bead_player_is_over(early) && bead_player_time(early) < 1e-3);
    bead_player_destroy(early);
    struct bead_player *passage = start((struct bead_player_settings){.chain = chain, .contact_peaks = true});
    while (!bead_player_is_over(passage))
        assert_int_equal(bead_player_step(passage, &msg), BEAD_OK);
    const double over = bead_player_time(passage);
    assert_int_equal(bead_player_step(passage, &msg), BEAD_ERROR_USAGE);
    assert_int_equal(bead_player_finish(passage, &outcome, &msg), BEAD_OK);
    assert_true(outcome->front_arrival < over && over < 2 * outcome->front_arrival);
    bead_player_destroy(passage);
    bead_chain_destroy(chain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chain_from_arrays_is_that_of_a_scene),
        cmocka_unit_test(later_forces_are_told),
        cmocka_unit_test(later_forces_within_steps_are_told),
        cmocka_unit_test(later_forces_of_last_steps_are_told),
        cmocka_unit_test(runs_are_over_at_their_end),
        cmocka_unit_test(mass_follows_from_density),
        cmocka_unit_test(wrong_chains_say_what_is_wrong),
        cmocka_unit_test(ends_of_ranges_are_allowed),
        cmocka_unit_test(ways_to_play_are_one),
        cmocka_unit_test(state_between_steps),
        cmocka_unit_test(uncertainty_is_that_asked_for),
        cmocka_unit_test(calls_out_of_order_fail),
        cmocka_unit_test(stopped_players_go_on),
        cmocka_unit_test(wrong_settings_say_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
