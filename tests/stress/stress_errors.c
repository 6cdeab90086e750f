/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncertainties of peaks against their errors: chains of all kinds, each run for three accuracies, and compared with a run with
 * much smaller steps, which a second one checks. Run it by hand, as it takes long: stress_errors [times] [FIRST [LAST]], seeds;
 * those of one kind are 15 apart. With `times`, it judges the times of peaks, not their heights. Every fourth chain of a kind runs
 * five times as long as its first pulse. A miss is a peak whose error exceeds both the requested accuracy and the uncertainty in
 * its row; an uncertainty is too large if it exceeds ten times the larger of the error and the requested accuracy. Rows called
 * unpredictable are counted separately. `tangent N FIRST LAST` judges the errors that a forward tangent finds (tangent.h), with the
 * local error of every N-th step. */
#include "tests/stress/stress.h"

#include <signal.h>
#include <sys/time.h>

#include "sim/run/play.h"
#include "tests/kinds.h"
#include "tests/stress/tangent.h"

static const double asked[] = {1e-4, 1e-6, 1e-8};
enum { ASKED = sizeof asked / sizeof *asked, CHAINS = 8 * KIND_COUNT };
/* Seconds of processor time for a run; a chain that takes longer is left out. */
enum { PATIENCE = 15 };

static volatile sig_atomic_t late;

static void ring(int)
{
    late = 1;
}

static void wait_at_most(long seconds)
{
    const struct itimerval timer = {.it_value = {.tv_sec = seconds}};
    setitimer(ITIMER_VIRTUAL, &timer, NULL);
}

/* Contacts first, then beads; NULL: it did not end in time. */
struct said {
    struct bead_peak *peak;
    double *uncertainty, end; /* of forces, or of times */
    size_t contacts, count;
};

/* What is judged. */
struct way {
    bool times;
    size_t tangent; /* steps between two of which the local error is found; 0: no tangent */
};

/* Uncertainties as the tangent has them, by the rules of uncertainty.c: a peak not known to a tenth is lost, and so are later ones
 * not known as well as asked. */
static void say_tangent(const struct bead_chain *chain, const struct bead_simulate *simulate, size_t every, struct said *said)
{
    static const double safety = 5, lost = 0.1;
    const bool passage = !isfinite(simulate->until);
    const struct bead_run_settings settings = {.chain = chain,
                                               .simulate = simulate,
                                               .kernels = bead_kernels_find(NULL),
                                               .end = passage ? INFINITY : simulate->until,
                                               .passage = passage ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE};
    double from = INFINITY;
    tangent_errors(&settings, said->peak, every, said->uncertainty);
    for (size_t i = 0; i < said->count; i++) {
        said->uncertainty[i] = safety * fabs(said->uncertainty[i]);
        if (!(said->uncertainty[i] <= lost * said->peak[i].value) && is_peak(&said->peak[i]) && said->peak[i].time > 0)
            from = fmin(from, said->peak[i].time);
    }
    for (size_t i = 0; i < said->count; i++) {
        const struct bead_peak *peak = &said->peak[i];
        said->peak[i].unpredictable = !(peak->time < from) && !(said->uncertainty[i] <= simulate->accuracy * peak->value);
    }
}

static struct said say(const char *text, double accuracy, double until, bool uncertainty, const struct way *way)
{
    struct bead_message msg = {""};
    struct built built = build(text, "accuracy: 1e-6");
    struct bead_player_settings settings;
    struct bead_player *player = NULL;
    const struct bead_outcome *o = NULL;
    struct said said = {.contacts = bead_chain_contacts(built.chain)};
    BEAD_DEFAULT(&settings);
    settings.chain = built.chain;
    settings.accuracy = accuracy;
    settings.until = until;
    settings.contact_peaks = settings.bead_peaks = true;
    settings.uncertainty = uncertainty && way->tangent == 0;
    settings.stop = &late;
    said.count = said.contacts + bead_chain_beads(built.chain);
    late = 0;
    wait_at_most(PATIENCE);
    if (!bead_player_create(&settings, &player, &msg) && !bead_player_until(player, INFINITY, &msg) &&
        !bead_player_finish(player, &o, &msg)) {
        said.end = o->end;
        said.peak = calloc(said.count, sizeof *said.peak);
        said.uncertainty = calloc(said.count, sizeof *said.uncertainty);
        if (!said.peak || !said.uncertainty)
            GIVE_UP("out of memory");
        memcpy(said.peak, o->contact_peaks, said.contacts * sizeof *said.peak);
        memcpy(said.peak + said.contacts, o->bead_peaks, (said.count - said.contacts) * sizeof *said.peak);
        const double *contact = way->times ? o->contact_time_uncertainty : o->contact_uncertainty,
                     *bead = way->times ? o->bead_time_uncertainty : o->bead_uncertainty;
        for (size_t i = 0; settings.uncertainty && i < said.count; i++)
            said.uncertainty[i] = i < said.contacts ? contact[i] : bead[i - said.contacts];
    }
    wait_at_most(0);
    bead_player_destroy(player);
    struct bead_simulate simulate = bead_chain_scene(built.chain)->simulate;
    simulate.accuracy = accuracy;
    simulate.until = until > 0 ? until : simulate.until;
    if (said.peak && uncertainty && way->tangent > 0)
        say_tangent(built.chain, &simulate, way->tangent, &said);
    release(&built);
    return said;
}

static void forget(struct said *said)
{
    free(said->peak);
    free(said->uncertainty);
}

/* What came of a kind at an accuracy. */
struct count {
    size_t rows, misses, too_much, lost, strong, room;
    double worst;     /* error over uncertainty */
    double *strongly; /* uncertainty over error, for errors above the requested accuracy */
};

static void add_strong(struct count *c, double effectivity)
{
    if (c->strong == c->room) {
        c->room = 2 * c->room + 64;
        c->strongly = realloc(c->strongly, c->room * sizeof *c->strongly);
        if (!c->strongly)
            GIVE_UP("out of memory");
    }
    c->strongly[c->strong++] = effectivity;
}

static void tell_miss(const struct said *got, size_t i, double error, double said)
{
    const bool contact = i < got->contacts;
    printf("    missed: %s %zu, %.6g N at %.6g s, is off by %.3g times what was asked, and says %.3g\n",
           contact ? "contact" : "bead", contact ? i : i - got->contacts, got->peak[i].value, got->peak[i].time, error, said);
}

/* Of its force, or its time as a part of that. */
static double off(const struct bead_peak *peak, const struct bead_peak *exact, bool times)
{
    return times ? fabs(peak->time - exact->time) / peak->time : difference(peak, exact);
}

static void judge(struct count *c, const struct said *got, const struct said references[2], double accuracy, bool times)
{
    for (size_t i = 0; i < got->count; i++) {
        const struct bead_peak *peak = &got->peak[i], *exact = &references[0].peak[i];
        if (!is_peak(peak) || !is_peak(exact) || !(peak->time > 0))
            continue;
        const double error = off(peak, exact, times) / accuracy, known = off(&references[1].peak[i], exact, times) / accuracy;
        const double said = fmax(1, got->uncertainty[i] / (accuracy * (times ? peak->time : peak->value)));
        if (known > 0.3 * fmax(error, 1))
            continue;
        c->rows++;
        c->lost += peak->unpredictable;
        if (peak->unpredictable)
            continue;
        if (error - known > said) {
            c->misses++;
            tell_miss(got, i, error, said);
        }
        c->worst = fmax(c->worst, (error - known) / said);
        c->too_much += said > 10 * fmax(error, 1);
        if (error > 1)
            add_strong(c, said / error);
    }
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Adds what came of a chain to its kind's. */
static void add(struct count *sum, const struct count *c)
{
    sum->rows += c->rows;
    sum->misses += c->misses;
    sum->too_much += c->too_much;
    sum->lost += c->lost;
    sum->worst = fmax(sum->worst, c->worst);
    for (size_t i = 0; i < c->strong; i++)
        add_strong(sum, c->strongly[i]);
}

/* One line for each accuracy, after those of its misses. */
static bool try_seed(uint64_t seed, const struct way *way, struct count counts[ASKED])
{
    char text[DRAWN_TEXT];
    const bool damped = kind_draw(seed, (enum kind)(seed % KIND_COUNT), text);
    struct said first = say(text, 1e-4, 0, false, way);
    const double until = seed / KIND_COUNT % 4 == 3 ? 5 * first.end : 0;
    const double fine[2] = {damped ? 1e-8 : 1e-12, damped ? 4e-8 : 1e-11};
    struct said references[2] = {{.count = 0}, {.count = 0}};
    for (int i = 0; first.peak && i < 2; i++)
        references[i] = say(text, fine[i], until, false, way);
    const bool known = references[0].peak && references[1].peak;
    for (size_t a = 0; known && a < (damped ? ASKED - 1 : ASKED); a++) {
        struct said got = say(text, asked[a], until, true, way);
        struct count c = {.rows = 0};
        if (got.peak)
            judge(&c, &got, references, asked[a], way->times);
        printf("  seed %d, %s, %g: %zu rows: %zu missed (%.2g), %zu too much, %zu unpredictable\n", (int)seed,
               kind_names[seed % KIND_COUNT], asked[a], c.rows, c.misses, c.worst, c.too_much, c.lost);
        fflush(stdout);
        add(&counts[a], &c);
        free(c.strongly);
        forget(&got);
    }
    if (!known) {
        printf("  seed %d, %s: no reference\n", (int)seed, kind_names[seed % KIND_COUNT]);
        fflush(stdout);
    }
    forget(&first);
    forget(&references[0]);
    forget(&references[1]);
    return known;
}

static void print_row(struct stress *stress, const char *kind, double accuracy, const struct count *c)
{
    char name[64], quartiles[64] = "";
    snprintf(name, sizeof name, "%s, %g", kind, accuracy);
    if (c->strong > 0) {
        qsort(c->strongly, c->strong, sizeof *c->strongly, rising);
        snprintf(quartiles, sizeof quartiles, "%.2g %.2g %.2g of %zu", c->strongly[c->strong / 4], c->strongly[c->strong / 2],
                 c->strongly[3 * c->strong / 4], c->strong);
    }
    if (c->rows > 0)
        stress_row(stress, c->misses == 0 && 500 * c->too_much <= c->rows, name, "%6zu: %3zu (%.2g) %4zu %4zu; %s", c->rows,
                   c->misses, c->worst, c->too_much, c->lost, quartiles);
}

/* `scene SEED`: the chain of a seed, with its kind, for tables.py. */
static int print_scene(int seed)
{
    char text[DRAWN_TEXT];
    kind_draw((uint64_t)seed, (enum kind)(seed % KIND_COUNT), text);
    printf("# %s\n%s", kind_names[seed % KIND_COUNT], text);
    return 0;
}

int main(int count, char **word)
{
    if (count > 2 && strcmp(word[1], "scene") == 0)
        return print_scene(atoi(word[2]));
    struct stress stress = stress_start();
    struct way way = {.times = count > 1 && strcmp(word[1], "times") == 0};
    if (count > 2 && strcmp(word[1], "tangent") == 0)
        way.tangent = (size_t)atoi(word[2]);
    const int words = way.times ? 1 : way.tangent > 0 ? 2 : 0;
    count -= words, word += words;
    const int first = count > 1 ? atoi(word[1]) : 0,
              last = count > 2 ? atoi(word[2]) : first + (stress.quick ? KIND_COUNT : CHAINS);
    static struct count counts[KIND_COUNT + 1][ASKED]; /* the last: of all kinds */
    size_t left_out = 0;
    signal(SIGVTALRM, ring);
    for (int seed = first; seed < last; seed++)
        left_out += !try_seed((uint64_t)seed, &way, counts[seed % KIND_COUNT]);
    printf("%d chains, %zu without a reference. Rows, and of them: missed; said too much; unpredictable; what was said over the "
           "error, "
           "of\nerrors above what was asked: quartiles:\n",
           last - first, left_out);
    for (size_t k = 0; k < KIND_COUNT; k++) {
        for (size_t a = 0; a < ASKED; a++) {
            print_row(&stress, kind_names[k], asked[a], &counts[k][a]);
            add(&counts[KIND_COUNT][a], &counts[k][a]);
            free(counts[k][a].strongly);
        }
    }
    for (size_t a = 0; a < ASKED; a++) {
        print_row(&stress, "all", asked[a], &counts[KIND_COUNT][a]);
        free(counts[KIND_COUNT][a].strongly);
    }
    return stress_end(&stress);
}
