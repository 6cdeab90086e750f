/* The equation `kdv`: what its settings mean, what is watched on the way and measured at the end. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/equation/equation.h"
#include "sim/equation/kdv_measures.h"
#include "sim/equation/kdv_solver.h"
#include "sim/equation/kdv_start.h"

struct bead_motion {
    struct bead_kdv kdv;
    struct bead_kdv_watch watch;
};

/* The unknown is shown as the field that the scene wants, with its name, and as u where nothing else is said. */
static const struct bead_field_info *field(const struct bead_equation_spec *spec, enum bead_field field)
{
    static const struct bead_field_info infos[] = {
#define BEAD_KDV_FIELD(id, name, unit, title, place) {name, "", BEAD_FIELD_##id == BEAD_FIELD_DISPLACEMENT ? "u" : title, 0},
        BEAD_FIELDS(BEAD_KDV_FIELD)
#undef BEAD_KDV_FIELD
    };
    (void)spec;
    return &infos[field];
}

static const char *check(const struct bead_equation_spec *spec, const char **key)
{
    *key = "variable";
    if (spec->variable == BEAD_FIELD_CONTACT_FORCE)
        return "must be a field of points, not of contacts";
    *key = "points";
    if (spec->start == BEAD_START_COSINE && spec->points && 3 * spec->mode + 1 > spec->points)
        return "must be more than three by wave of the start";
    *key = "dispersion";
    if (spec->dispersion == 0 && spec->nonlinearity != 0)
        return "must not be 0 beside a nonlinearity: the wave would break";
    if (spec->start != BEAD_START_SOLITONS)
        return NULL;
    if (!(spec->dispersion > 0))
        return "must be above 0 for solitons of these speeds";
    *key = "nonlinearity";
    if (spec->nonlinearity == 0)
        return "must not be 0 for solitons";
    *key = "start";
    for (size_t i = 0; i < spec->soliton_count; i++) {
        if (!(spec->solitons[i].at >= spec->low && spec->solitons[i].at < spec->low + spec->length))
            return "has a soliton outside the domain: must be low <= at < low + length";
    }
    return NULL;
}

/* " + 6 u" before a derivative; nothing where the coefficient is 0. */
static void add_term(char *text, size_t size, double coefficient, const char *factor)
{
    size_t used = strlen(text);
    const char *sign = coefficient < 0 ? "\u2212" : "+";
    if (coefficient != 0 && fabs(coefficient) == 1)
        snprintf(text + used, size - used, " %s %s", sign, factor);
    else if (coefficient != 0)
        snprintf(text + used, size - used, " %s %.4g %s", sign, fabs(coefficient), factor);
}

static void describe(const struct bead_equation_spec *spec, char *text, size_t size)
{
    snprintf(text, size, "u\u209c");
    add_term(text, size, spec->drift, "u\u2093");
    add_term(text, size, spec->nonlinearity, "u u\u2093");
    add_term(text, size, spec->dispersion, "u\u2093\u2093\u2093");
    snprintf(text + strlen(text), size - strlen(text), " = 0");
}

static void places(const struct bead_equation_spec *spec, size_t points, double *first, double *spacing)
{
    *first = spec->low;
    *spacing = spec->length / (double)points;
}

static void destroy(struct bead_motion *m)
{
    if (!m)
        return;
    bead_kdv_destroy(&m->kdv);
    free(m);
}

static enum bead_error create(const struct bead_motion_settings *settings, struct bead_motion **motion, struct bead_message *msg)
{
    struct bead_motion *m = calloc(1, sizeof *m);
    *motion = NULL;
    if (!m)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an equation");
    enum bead_error err = bead_kdv_create(settings, &m->kdv, msg);
    if (err) {
        free(m);
        return err;
    }
    bead_kdv_watch_begin(&m->watch, &m->kdv);
    *motion = m;
    return BEAD_OK;
}

/* A quarter of the time in which the fastest wave of the largest height passes over the narrowest feature. */
static void pace(const struct bead_motion *m, struct bead_pace *pace)
{
    const struct bead_equation_spec *spec = m->kdv.spec;
    double sharp = fmax(bead_kdv_sharpest(spec), 2 * 3.14 / spec->length),
           speed = fabs(spec->nonlinearity) * bead_kdv_highest(spec);
    speed += fabs(spec->drift) + fabs(spec->dispersion) * sharp * sharp;
    *pace = (struct bead_pace){"etdrk4", m->kdv.h, 0.25 / (sharp * speed), !m->kdv.fixed, NULL};
}

static double time_of(const struct bead_motion *m)
{
    return m->kdv.end.t;
}

static enum bead_error step(struct bead_motion *m, struct bead_message *msg)
{
    enum bead_error err = bead_kdv_step(&m->kdv, msg);
    if (!err)
        bead_kdv_watch_step(&m->watch, &m->kdv);
    return err;
}

static enum bead_error sample(struct bead_motion *m, double t, unsigned wanted, double *const value[BEAD_FIELD_COUNT],
                              struct bead_message *msg)
{
    (void)msg;
    enum bead_field shown = m->kdv.spec->variable;
    if (!(wanted & BEAD_FIELD_BIT(shown)))
        return BEAD_OK;
    bead_kdv_values(&m->kdv, t);
    memcpy(value[shown], m->kdv.spectral.grid, m->kdv.spectral.points * sizeof(double));
    return BEAD_OK;
}

static uint64_t evaluations(const struct bead_motion *m)
{
    return m->kdv.evaluations * m->kdv.spectral.points;
}

static const double *state(const struct bead_motion *m, size_t *count)
{
    *count = 2 * (m->kdv.spectral.modes + 1);
    return &m->kdv.end.u[0].re;
}

static double energy(const struct bead_motion *m)
{
    struct bead_kdv_integrals now;
    bead_kdv_integrals(&m->kdv, &now);
    return now.momentum;
}

static size_t measures(const struct bead_motion *m, struct bead_measure *to, size_t room)
{
    return bead_kdv_measures(&m->watch, &m->kdv, to, room);
}

/* What mode k of the Fourier series adds to the mean of u^2; the mean itself is no mode. Cosines by rotation in long double: the
 * same on all processors. */
static double mode_energy(const double *u, size_t points, size_t k)
{
    long double angle = 2 * 3.141592653589793238462643383279503L * (long double)k / (long double)points;
    long double turn_c = cosl(angle), turn_s = sinl(angle), c = 1, s = 0;
    double sum_c = 0, sum_s = 0;
    for (size_t i = 0; i < points; i++) {
        sum_c += u[i] * (double)c;
        sum_s += u[i] * (double)s;
        long double next = c * turn_c - s * turn_s;
        s = s * turn_c + c * turn_s;
        c = next;
    }
    double n = (double)points;
    return (2 * k == points ? 1 : 2) * (sum_c * sum_c + sum_s * sum_s) / (n * n);
}

static void modes(const struct bead_equation_spec *spec, size_t points, const double *const value[BEAD_FIELD_COUNT], size_t count,
                  double *energy)
{
    for (size_t k = 1; k <= count; k++)
        energy[k - 1] = 2 * k <= points ? mode_energy(value[spec->variable], points, k) : 0;
}

const struct bead_equation bead_equation_kdv = {
    .system =
        {
            .name = "kdv",
            .help = "u_t + drift u_x + nonlinearity u u_x + dispersion u_xxx = 0, of Korteweg and de Vries, on a ring (the "
                    "thesis's Eq. 1 "
                    "and 12)",
            .field = field,
            .describe = describe,
            .points = bead_kdv_points,
            .places = places,
            .mode_title = "mean square of the mode",
            .modes = modes,
        },
    .check = check,
    .create = create,
    .destroy = destroy,
    .pace = pace,
    .time = time_of,
    .step = step,
    .sample = sample,
    .evaluations = evaluations,
    .state = state,
    .energy = energy,
    .measures = measures,
};
