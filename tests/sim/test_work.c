/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run costs, and what it gets for it: evaluations of forces, errors of peaks beside far more exact runs, and what the run
 * says of its errors, for chains of all kinds, all methods, equations and two accuracies. No number may be worse than it was
 * measured, in tests/reference/work.csv, which `WORK=tests/reference/work.csv build/tests/test_work` writes anew after a change
 * that is meant to cost more, to be less exact, or to add a run. */
#include "support.h"

#include "beadreel/play.h"
#include "sim/chain/system.h"
#include "sim/integrate/methods.h"
#include "tests/kinds.h"

enum { SEEDS = 2, ACCURACIES = 2, MOST = 2000, PHASE = 600 /* of the fastest vibration, in a run */ };
static const double accuracies[ACCURACIES] = {1e-5, 1e-8};

/* As measured; of the errors of a run's peaks the one that nine of ten do not exceed. */
struct work {
    double steps, evaluations, error, embedded, event, energy;
};
enum { COLUMNS = sizeof(struct work) / sizeof(double) };

static FILE *written;
static struct table reference;
static size_t row;

struct result {
    size_t count;
    double value[MOST];
    struct work work;
};

/* Peaks of contacts and beads, or where a chain has none, the last values of what it shows. */
static struct result play(const struct built *built, double until, double accuracy, const char *method, double step)
{
    struct bead_message msg = {""};
    struct bead_player_settings settings;
    struct bead_player *player = NULL;
    const struct bead_outcome *o = NULL;
    struct result r = {.count = 0};
    const struct bead_system *const system = built->chain->spec->system;
    const enum bead_field field = system->fields ? system->fields[0] : BEAD_FIELD_DISPLACEMENT;
    const bool peaks = !system->equation;
    BEAD_DEFAULT(&settings);
    settings.chain = built->chain;
    settings.until = until;
    settings.accuracy = accuracy;
    settings.method = method;
    settings.step = step;
    settings.contact_peaks = settings.bead_peaks = peaks;
    struct bead_sample last = {0};
    if (bead_player_create(&settings, &player, &msg) || bead_player_until(player, INFINITY, &msg) ||
        bead_player_sample(player, BEAD_FIELD_BIT(field), &last, &msg))
        fail_msg("%s", msg.text);
    for (size_t j = 0; !peaks && j < built->chain->beads; j++)
        r.value[r.count++] = last.field[field][j];
    if (bead_player_finish(player, &o, &msg))
        fail_msg("%s", msg.text);
    for (size_t k = 0; peaks && k < built->chain->contacts + built->chain->beads && r.count < MOST; k++) {
        const struct bead_peak *p = k < built->chain->contacts ? &o->contact_peaks[k] : &o->bead_peaks[k - built->chain->contacts];
        r.value[r.count++] = p->open ? NAN : p->value;
    }
    r.work = (struct work){(double)o->steps, (double)o->evaluations, 0, o->embedded_error, o->event_error, o->energy_error};
    bead_player_destroy(player);
    return r;
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double error_of(const struct result *r, const struct result *exact)
{
    static double error[MOST];
    double most = 0;
    size_t count = 0;
    for (size_t i = 0; i < exact->count; i++)
        most = fmax(most, fabs(exact->value[i]));
    for (size_t i = 0; i < exact->count; i++) {
        if (fabs(exact->value[i]) > 1e-3 * most && r->value[i] > -INFINITY)
            error[count++] = fabs(r->value[i] / exact->value[i] - 1);
    }
    qsort(error, count, sizeof *error, rising);
    return count > 0 ? error[(count - 1) * 9 / 10] : NAN;
}

/* Costs may be a hundredth more, for powers of other C libraries; errors a quarter, and up to `small` in any case. What a run says
 * of its errors may not be less, either. */
static void check(const char *name, const struct work *w, double small)
{
    static const char *const what[COLUMNS] = {"steps", "evaluations", "error", "embedded error", "error of events", "energy error"};
    double now[COLUMNS];
    memcpy(now, w, sizeof now);
    if (written) {
        fprintf(written, "%.0f,%.0f,%.3g,%.3g,%.3g,%.3g\n", now[0], now[1], now[2], now[3], now[4], now[5]);
        return;
    }
    if (row >= reference.rows)
        fail_msg("nothing was measured for %s", name);
    for (size_t c = 0; c < COLUMNS; c++) {
        const double measured = reference.value[row * COLUMNS + c];
        const double most = c < 2 ? 1.01 * measured + 1 : fmax(1.25 * measured, small),
                     least = c > 2 && measured > small ? measured / 1.25 : 0;
        if (!(now[c] <= most && now[c] >= least) && !(isnan(now[c]) && isnan(measured)))
            fail_msg("%s: %s is %g, not %g to %g", name, what[c], now[c], least, most);
    }
    row++;
}

/* A run with each accuracy, by the method that the library chooses or by another one. */
static void try_accuracies(const char *name, const struct built *built, double until, const char *method,
                           const struct result *exact)
{
    for (size_t a = 0; a < ACCURACIES; a++) {
        char whole[200];
        struct result r = play(built, until, accuracies[a], method, 0);
        r.work.error = error_of(&r, exact);
        snprintf(whole, sizeof whole, "%s, accuracy %g", name, accuracies[a]);
        check(whole, &r.work, 0.02 * accuracies[a]);
    }
}

static void chains_of_all_kinds(void **)
{
    char text[DRAWN_TEXT], name[100];
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        for (uint64_t seed = 0; seed < (kind == KIND_LONG ? 0 : SEEDS); seed++) {
            const bool damped = kind_draw(seed, (enum kind)kind, text);
            struct built built = build(text, "accuracy: 1e-6");
            const double omega = bead_chain_omega(built.chain, bead_chain_energy(built.chain)), until = PHASE / omega;
            const struct result exact = damped ? play(&built, until, 1e-11, NULL, 0) : play(&built, until, 0, "rkn8", 0.1 / omega);
            snprintf(name, sizeof name, "kind %s, seed %d", kind_names[kind], (int)seed);
            try_accuracies(name, &built, until, NULL, &exact);
            release(&built);
        }
    }
}

#define STRUCK  "chain: {beads: [{cell: [large-steel, aluminium], count: 6, spins: random}], wall: brass"
#define PRESSED STRUCK ", precompression: 5 N"
static void all_methods(void **)
{
    static const char *const chains[] = {STRUCK "}\n", PRESSED "}\n", STRUCK ", damping: {coefficient: 3, exponent: 1.5}}\n",
                                         PRESSED ", drive: {force: sine, amplitude: 2 N, frequency: 9 kHz}}\n"};
    const struct bead_method_info *method;
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        struct built built = build(chains[i], "until: 0.3 ms");
        const double until = 3e-4;
        const bool any = !strstr(chains[i], "damping") && !strstr(chains[i], "drive"); /* else only these */
        const struct result exact = play(&built, until, 1e-11, NULL, 0);
        for (size_t m = 0; (method = bead_method_info(m)); m++) {
            char name[200];
            snprintf(name, sizeof name, "%s of %.*s", method->name, (int)strcspn(chains[i], "\n"), chains[i]);
            if (method->order > 2 && (any || strcmp(method->name, "rk4") == 0 || strcmp(method->name, "rk8") == 0))
                try_accuracies(name, &built, until, method->name, &exact);
        }
        release(&built);
    }
}

/* As build() of tests/problems.h; its table is of peaks, which equations do not have. */
static struct built build_equation(const char *text, double until)
{
    struct built built;
    struct bead_message msg = {""};
    char all[400];
    snprintf(all, sizeof all, "%ssimulate: {until: %g}\noutputs: [{table: measures.csv, show: measures}]\n", text, until);
    if (bead_scene_parse("test", all, strlen(all), NULL, &built.scene, &msg) ||
        bead_chain_create(built.scene, 0, &built.chain, &msg))
        fail_msg("%s", msg.text);
    return built;
}

static void all_equations(void **)
{
    static const char *const chains[] = {
        "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n",
        "chain: {equation: fput, points: 12, piecewise: {stiffness: 2, beyond: 0.1}, start: {mode: 2, amplitude: 1}}\n",
        "chain: {equation: kdv, low: -12, length: 34, points: 160, start: {solitons: [{speed: 9, at: -8}, {speed: 4, at: 0}]}}\n",
        "chain: {equation: shock, points: 60, epsilon: 0.2, length: 6.28, start: {simple-wave: 1, amplitude: 0.5}}\n"};
    static const double until[] = {40, 20, 0.1, 2};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        struct built built = build_equation(chains[i], until[i]);
        const struct result exact = play(&built, until[i], 1e-11, NULL, 0);
        try_accuracies(chains[i], &built, until[i], NULL, &exact);
        release(&built);
    }
}

int main(void)
{
    written = getenv("WORK") ? fopen(getenv("WORK"), "w") : NULL;
    if (written)
        fprintf(written,
                "# What runs of tests/sim/test_work.c cost, and what they got for it, in its order; it says how this is written.\n"
                "steps,evaluations,error,embedded_error,event_error,energy_error\n");
    else
        reference = read_table("work.csv", COLUMNS);
    const struct CMUnitTest tests[] = {cmocka_unit_test(chains_of_all_kinds), cmocka_unit_test(all_methods),
                                       cmocka_unit_test(all_equations)};
    const int failed = cmocka_run_group_tests_name("work", tests, NULL, NULL);
    if (written)
        fclose(written);
    free(reference.value);
    return failed;
}
