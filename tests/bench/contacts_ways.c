/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors left by each way to correct contacts that open or close; contacts.sh adds the cost.
 *
 *   contacts_ways ends WAY STEP TOLERANCE       largest error of a contact's peak: 500 beads in random dimers
 *   contacts_ways between WAY STEP TOLERANCE    largest error of a velocity within steps, over the striker's: a steel chain */
#define GIVE_UP(...) (fprintf(stderr, __VA_ARGS__), fputc('\n', stderr), exit(1))
#include "tests/problems.h"

#include "sim/integrate/dense.h"
#include "sim/integrate/events_private.h"
#include "sim/run/peaks.h"

static const struct way {
    const char *name, *method;
    bool kinks, between;
} ways[] = {{"plain", "rkn8-plain", false, true},
            {"patches", "rkn8", false, true},
            {"kinks-and-patches", "rkn8", true, true},
            {"interpolation", "rkn8", true, false}};
/* Of references. */
static const struct way exact = {"exact", "rkn8", false, true};
static const double exact_step = 0.5e-6, exact_tolerance = 1e-14;

static const struct way *way_of(const char *name)
{
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        if (strcmp(ways[i].name, name) == 0)
            return &ways[i];
    }
    GIVE_UP("there is no way `%s`", name);
    return NULL;
}

static struct bead_stepper *start(const struct built *built, const struct way *way, double tolerance)
{
    struct bead_message msg = {""};
    struct bead_stepper *s;
    if (bead_stepper_create(built->chain, bead_method_row(way->method), bead_kernels_find(NULL), false, &s, &msg))
        GIVE_UP("%s", msg.text);
    s->event_tolerance = tolerance;
    if (s->events)
        s->events->kinks_known &= way->kinks;
    return s;
}

/* The peaks until the front is at the end, [contacts]. */
static void find_peaks(const struct built *built, const struct way *way, double step, double tolerance, double *peak)
{
    struct bead_message msg = {""};
    struct bead_peaks *peaks;
    struct bead_stepper *s = start(built, way, tolerance);
    if (bead_peaks_create(s, false, (struct bead_span){0, SIZE_MAX}, &peaks, &msg))
        GIVE_UP("%s", msg.text);
    while (s->t1 < 10e-3) {
        bead_stepper_advance_by(s, step, s->t1 + step);
        bead_peaks_step(peaks, s, INFINITY, INFINITY);
    }
    for (size_t k = 0; k < built->chain->contacts; k++)
        peak[k] = bead_peaks_found(peaks)[k].value;
    bead_peaks_destroy(peaks);
    bead_stepper_destroy(s);
}

/* Of all contacts but those near the end, which the wave may only just have reached. */
static double error_at_ends(const struct way *way, double step, double tolerance, bool alone)
{
    struct built built = build(LONG_CHAIN, "");
    const size_t contacts = built.chain->contacts, last = contacts - 100;
    double *found = calloc(2 * contacts, sizeof *found), most = 0;
    find_peaks(&built, way, step, tolerance, found);
    if (!alone)
        find_peaks(&built, &exact, exact_step, exact_tolerance, found + contacts);
    for (size_t k = 0; !alone && k < last; k++)
        most = fmax(most, fabs(found[k] / found[contacts + k] - 1));
    free(found);
    release(&built);
    return most;
}

/* At so many places in each step. */
static double error_between(const struct way *way, double step, double tolerance, bool alone)
{
    enum { STEPS = 100, PLACES = 4 };
    struct bead_message msg = {""};
    struct built built = build(P1_CHAIN, "");
    struct bead_stepper *s = start(&built, way, tolerance), *fine = start(&built, &exact, exact_tolerance);
    struct bead_dense dense;
    const double speed = s->chain->spec->striker_velocity;
    double *u = calloc(s->beads + 16, sizeof *u), *v = calloc(s->beads + 16, sizeof *v), most = 0;
    if (!u || !v || bead_dense_create(s, &dense, &msg))
        GIVE_UP("out of memory");
    if (!way->between) {
        bead_between_destroy(dense.between);
        dense.between = NULL;
    }
    for (int n = 0; n < STEPS; n++) {
        bead_stepper_advance_by(s, step, s->t1 + step);
        for (int i = 1; i <= PLACES; i++) {
            const double time = s->t0 + step * i / PLACES;
            bead_dense_state(&dense, s, time, u, v);
            for (int part = 0; !alone && part < 4; part++)
                bead_stepper_advance_by(fine, step / (4 * PLACES), fine->t1 + step / (4 * PLACES));
            for (size_t j = 0; !alone && j < s->active; j++)
                most = fmax(most, fabs(v[j] - fine->end.v[j]));
        }
    }
    bead_dense_destroy(&dense);
    bead_stepper_destroy(s);
    bead_stepper_destroy(fine);
    free(u);
    free(v);
    release(&built);
    return most / speed;
}

/* With a fifth argument nothing is compared: for counting instructions. */
int main(int argc, char **argv)
{
    if (argc < 5)
        GIVE_UP("contacts_ways ends|between WAY STEP TOLERANCE [alone]");
    const struct way *way = way_of(argv[2]);
    printf("%.1e\n", (strcmp(argv[1], "ends") == 0 ? error_at_ends : error_between)(way, atof(argv[3]), atof(argv[4]), argc > 5));
    return 0;
}
