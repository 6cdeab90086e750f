/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the length of the next step from the stiffest contacts: see step_control.h. */
#include "sim/run/step_control.h"

#include "sim/chain/drive.h"

/* Steps between estimates of omega, each of which looks this far ahead. */
enum { EVERY = 4 };
/* An estimate half way to the next one counts only if it allows less than this part of the step: a light bead that has been struck
 * since may have made a contact stiff. */
enum { BETWEEN = EVERY / 2 };
static const double surprise = 0.7;
/* Steps that would grow by more than this factor must look further ahead. */
static const double much = 1.1;
/* Longest step in units of the first, while contacts are soft. A drive makes forces rise at its own pace, however soft they are. */
static const double growth = 4, driven_growth = 1;

static double stiffness(const struct bead_stepper *s, size_t k, double d)
{
    double a = s->table.stiffness[k];
    double here = s->chain->law->stiffness(a, s->table.law, d);
    return s->chain->law->one_sided ? here : fmax(here, s->chain->law->stiffness(a, s->table.law, -d));
}

/* Expected stiffness of contact k: at its present compression, or at the one that its rate leads to within `ahead` seconds. */
static double expected(const struct bead_stepper *s, size_t k, const double *v, double ahead)
{
    const double rate = v[k] - v[k + 1], d = bead_stepper_compression(s, &s->end, k);
    return stiffness(s, k, d + (rate > 0 ? ahead * rate : 0));
}

/* Bound of omega^2 from the Gershgorin circles of contacts 0..n-1; see bead_chain_omega. */
static double circles(const struct bead_stepper *s, size_t n, const double *v, double ahead, bool at_rest)
{
    const double *w = s->chain->inverse_mass, *d0 = s->table.static_compression;
    const size_t contacts = s->chain->contacts;
    double worst = 0, before = 0, here = at_rest ? stiffness(s, 0, d0[0]) : expected(s, 0, v, ahead);
    for (size_t k = 0; k < n; k++) {
        double after = 0, right = k + 1 < s->beads ? w[k + 1] : 0;
        if (k + 1 < contacts)
            after = at_rest ? stiffness(s, k + 1, d0[k + 1]) : expected(s, k + 1, v, ahead);
        double row = here * (w[k] + right) + before * w[k] + after * right;
        worst = row > worst ? row : worst;
        before = here;
        here = after;
    }
    return worst;
}

/* This bound from stiffnesses k, with vectors. */
static double circles_of(const struct bead_stepper *s, size_t n, const double *k)
{
    const double *w = s->chain->inverse_mass;
    const size_t inner = n < s->beads ? n : s->beads - 1;
    const double worst = s->kernels->circles(inner - s->first, k + s->first, w + s->first);
    if (inner == n)
        return worst;
    /* the wall's contact */
    return fmax(worst, k[inner] * w[inner] + k[inner - 1] * w[inner]);
}

/* This bound for Hertz's law; uses stepper->w[0], which Nystrom methods leave alone. */
static double hertz_circles(const struct bead_stepper *s, size_t n, const double *v, double ahead)
{
    const size_t contacts = s->chain->contacts, known = n < contacts ? n + 1 : contacts, o = s->first;
    struct bead_contact_table table = s->table;
    double *k = s->w[0];
    table.stiffness += o;
    table.static_compression += o;
    s->kernels->hertz_stiffness(known - o, &table, s->end.u + o, v + o, ahead, k + o);
    k[known] = 0;
    if (o > 0)
        k[o - 1] = 0;
    return circles_of(s, n, k);
}

static double drive_omega(const struct bead_stepper *s)
{
    return s->driven == SIZE_MAX ? 0 : bead_drive_omega(s->chain, s->t1);
}

struct bead_step_control bead_step_control_start(const struct bead_stepper *s, double theta, double omega)
{
    const double first = theta / omega, longest = (s->driven == SIZE_MAX ? growth : driven_growth) * first;
    return (struct bead_step_control){theta, sqrt(circles(s, s->chain->contacts, s->end.v, 0, true)), longest,
                                      theta / fmax(omega, drive_omega(s))};
}

/* Longest step that the stiffnesses expected from velocities v allow, if steps until the next check have length h. */
static double allowed(const struct bead_step_control *control, const struct bead_stepper *s, const double *v, double h)
{
    const size_t n = bead_stepper_contacts(s);
    const double ahead = EVERY * h;
    double worst = s->chain->law->hertz ? hertz_circles(s, n, v, ahead) : circles(s, n, v, ahead, false);
    double omega = fmax(fmax(sqrt(worst + s->chain->spring_rate), control->static_omega), drive_omega(s));
    return omega * control->longest > control->theta ? control->theta / omega : control->longest;
}

/* This bound if beads turn back: accelerations close contacts that are open or opening, and make them stiff before the next check.
 * Takes half the change of the compressions that constant accelerations would cause. */
static double allowed_with_turns(const struct bead_step_control *control, const struct bead_stepper *s, double h)
{
    const double part = 0.5, ahead = EVERY * h;
    double *v = s->w[1];
    for (size_t j = s->first; j <= s->active && j <= s->beads; j++)
        v[j] = s->end.v[j] + part * (0.5 * ahead) * s->end.a[j];
    return allowed(control, s, v, h);
}

double bead_step_control_next(struct bead_step_control *control, const struct bead_stepper *s)
{
    if (s->steps == 0 || s->steps % BETWEEN != 0)
        return control->h;
    double h = allowed(control, s, s->end.v, control->h);
    if (s->steps % EVERY != 0)
        return control->h = h < surprise * control->h ? h : control->h;
    if (h > much * control->h)
        h = fmax(control->h, fmin(allowed(control, s, s->end.v, h), allowed_with_turns(control, s, h)));
    control->h = h;
    return h;
}

/* Damping makes velocities decay within 1/rate. Runge-Kutta 4 has this accuracy with steps of theta/rate, at most cap/rate. */
static const double damped_theta = 0.06, damped_accuracy = 1e-6, damped_cap = 0.5;

/* Decay rate of the last bead's velocity by an absorbing end. */
static double end_rate(const struct bead_stepper *s)
{
    const struct bead_dashpot *end = &s->chain->end;
    const size_t last = s->beads - 1;
    if (!(end->coefficient > 0) || s->active < s->beads)
        return 0;
    const double v = fabs(s->end.v[last]);
    return end->coefficient * end->exponent * (end->exponent != 1 ? pow(v, end->exponent - 1) : 1) * s->chain->inverse_mass[last];
}

/* Bound of the decay rates at the end of the step: gamma a |D|^(a-1) of each closed contact takes the place of a stiffness. */
static double damping_rate(const struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    const double a = s->table.damping_exponent;
    if (!(s->table.damping > 0))
        return end_rate(s);
    double *k = s->w[0];
    for (size_t i = 0; i < n; i++) {
        const double change = fabs(s->end.v[i] - s->end.v[i + 1]);
        const bool idle = change == 0 || (s->closed && !s->closed[i]);
        k[i] = idle ? 0 : s->table.damping * a * (a != 1 ? pow(change, a - 1) : 1);
        if (s->table.damping_compression > 0) /* at a compression that the step may lead to */
            k[i] *= pow(fmax(bead_stepper_compression(s, &s->end, i), 0) + change * s->h, s->table.damping_compression);
    }
    k[n] = 0;
    return fmax(circles_of(s, n, k), end_rate(s));
}

/* A step near a turn takes one part in so many of the time from it. */
enum { PARTS = 3 };

/* With an exponent a below 1, the force gamma |D|^a has an infinite slope where a contact turns, D = 0. Steps become shorter
 * towards the turn and longer behind it, by the same part of the time from it, so that each sees a smooth force; the one over the
 * turn is so short that what it does to the velocities, gamma |D' h|^a h / m, is below the tolerance. */
static double steep(const struct bead_stepper *s, double tolerance, double h)
{
    const size_t n = bead_stepper_contacts(s);
    const double a = s->table.damping_exponent, *w = s->chain->inverse_mass;
    for (size_t k = 0; k < n; k++) {
        const double change = fabs(s->end.v[k] - s->end.v[k + 1]), turning = fabs(s->end.a[k] - s->end.a[k + 1]);
        if ((s->closed && !s->closed[k]) || turning == 0 || PARTS * turning * h <= change)
            continue;
        const double weight = s->table.damping * pow(turning, a) * (w[k] + (k + 1 < s->beads ? w[k + 1] : 0));
        h = fmin(h, fmax(change / (PARTS * turning), pow(tolerance / weight, 1 / (1 + a))));
    }
    return h;
}

/* A force gamma |D|^a d^c with c below 1 has an infinite slope where the contact closes or opens, d = 0. As above, each step takes
 * a part of the time since or until then; the one that begins with it may change velocities by the tolerance. */
static double grazing(const struct bead_stepper *s, double tolerance, double h)
{
    const size_t n = bead_stepper_contacts(s);
    const double c = s->table.damping_compression, *w = s->chain->inverse_mass;
    for (size_t k = 0; k < n; k++) {
        const double change = fabs(s->end.v[k] - s->end.v[k + 1]), d = fmax(bead_stepper_compression(s, &s->end, k), 0);
        if ((s->closed && !s->closed[k]) || PARTS * change * h <= d)
            continue;
        const double force = bead_damping_force(&s->table, change, change),
                     weight = force * (w[k] + (k + 1 < s->beads ? w[k + 1] : 0));
        h = fmin(h, fmax(d / (PARTS * change), pow(tolerance / weight, 1 / (1 + c))));
    }
    return h;
}

double bead_step_control_damped(const struct bead_stepper *s, double accuracy, double h)
{
    if (s->table.damping_compression > 0 && s->table.damping_compression < 1)
        h = grazing(s, accuracy * bead_chain_speed(s->chain), h);
    if (s->table.damping_exponent < 1)
        return steep(s, accuracy * bead_chain_speed(s->chain), h);
    const double part = accuracy / damped_accuracy, power = part > 1 ? 0.25 : 0.4;
    const double theta = fmin(damped_theta * pow(part, power), damped_cap), rate = damping_rate(s);
    return rate * h > theta ? theta / rate : h;
}

/* Reduces the drift of a method of order 8 by a factor of 25. */
static const double shortening = 0.7;

void bead_step_control_shorten(struct bead_step_control *control)
{
    control->theta *= shortening;
    control->longest *= shortening;
}
