/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the length of the next step from the stiffest contacts: see step_control.h. */
#include "sim/run/step_control.h"

#include "sim/base/wide.h"
#include "sim/chain/drive.h"
#include "sim/chain/law_beginning.h"

/* Steps between estimates of omega, each of which looks this far ahead. */
enum { EVERY = 4 };
/* An estimate half-way to the next one counts only if it allows less than this part of the step: a light bead struck since may have
 * made a contact stiff. */
enum { BETWEEN = EVERY / 2 };
static const double surprise = 0.7;
/* Steps that would grow by more than this factor must look further ahead. */
static const double much = 1.1;
/* Longest step in units of the first, while contacts are soft. A drive makes forces rise at its own pace, however soft contacts
 * are. */
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

/* Bound of omega^2 from the Gershgorin circles of contacts 0..n-1: see bead_chain_omega. */
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

/* The same bound from stiffnesses k, with vectors. */
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

/* The same bound for Hertz's law; uses stepper->w[0], which Nystrom methods do not use. */
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

/* Longest step that the stiffnesses expected from velocities v allow, if steps until the next check have length h. */
static double allowed(const struct bead_step_control *control, const struct bead_stepper *s, const double *v, double h)
{
    const size_t n = bead_stepper_contacts(s);
    const double ahead = EVERY * h;
    double worst = s->chain->law->hertz ? hertz_circles(s, n, v, ahead) : circles(s, n, v, ahead, false);
    double omega = fmax(fmax(sqrt(worst + s->chain->spring_rate), control->static_omega), drive_omega(s));
    return omega * control->longest > control->theta ? control->theta / omega : control->longest;
}

/* The same bound if beads turn back: accelerations close contacts that are open or opening, and make them stiff before the next
 * check. Takes half the change of compressions under constant accelerations. */
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

/* Decay rate of the last bead's velocity at an absorbing end. */
static double end_rate(const struct bead_stepper *s)
{
    const struct bead_dashpot *end = &s->chain->end;
    const size_t last = s->beads - 1;
    if (!(end->coefficient > 0) || s->active < s->beads)
        return 0;
    const double v = fabs(s->end.v[last]);
    return end->coefficient * end->exponent * (end->exponent != 1 ? pow(v, end->exponent - 1) : 1) * s->chain->inverse_mass[last];
}

/* Bound of the decay rates at the end of the step: gamma a |D|^(a-1) of each closed contact replaces a stiffness. */
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

/* A branch point as a step sees it. */
struct nearby {
    const struct bead_branch *branch;
    double away; /* s: time since or until then */
    double part; /* N: of the force, one step away from it */
    bool coming;
    double rate; /* kg/s: the slope of a steep one here */
};

/* The error of a quadrature of x^power, where x is the distance from a point `at` in the interval 0..1. Before that point the
 * function is 0 or, if `turned`, has the opposite sign. */
static double quadrature_error(const struct bead_quadrature *q, double power, double at, bool turned)
{
    double sum = -(pow(1 - at, power + 1) - (turned ? pow(at, power + 1) : 0)) / (power + 1);
    for (size_t i = 0; i < q->nodes; i++) {
        const double x = q->node[i] - at;
        sum += q->weight[i] * (x < 0 && !turned ? 0 : copysign(pow(fabs(x), power), x));
    }
    return fabs(sum);
}

/* The n-th derivative of x^power at 1, over n factorial. */
static double binomial(double power, int n)
{
    double product = 1;
    for (int i = 0; i < n; i++)
        product *= (power - i) / (i + 1);
    return fabs(product);
}

/* A branch point x^power, `turned` for a rate. An infinite slope makes the stages of a step wrong, not only their sum: then the
 * whole force counts. */
static struct bead_branch branch(const struct bead_quadrature *q, double power, bool turned)
{
    enum { PLACES = 16 };
    const bool smooth = !(power > 0) || fmod(power, turned ? 2 : 1) == (turned ? 1 : 0);
    struct bead_branch b = {.power = power, .steep = turned && power < 1};
    for (int i = 0; i < PLACES && !smooth; i++)
        b.within = fmax(b.within, b.steep ? 1 : quadrature_error(q, power, i / (double)PLACES, turned));
    b.beside = binomial(power, q->order) * quadrature_error(q, q->order, 0, false);
    return b;
}

/* Next to a steep branch point a step takes 1/PARTS of the time since or until then, and no more than the slope allows. A choice:
 * of eleven damped chains, one with the exponent .7 is off by .9 of the requested 1e-6 with 1, none by more than .05 with 2, 3, 6
 * or 30; with 30 they take 1.4 times as long. */
enum { PARTS = 3 };

/* The longest step, not above h, in which the quadrature error of a branch point changes a velocity by no more than `tolerance`:
 * over the point itself, or away from it, where the error is that of a derivative, by Peano's theorem. A step towards it goes
 * half-way. */
static double grazing(const struct nearby *p, double theta, int order, double inverse_mass, double tolerance, double h)
{
    const double kick = p->part * h * inverse_mass, power = p->branch->power;
    if (!(kick * p->branch->within > tolerance))
        return h;
    const double over = h * pow(tolerance / (kick * p->branch->within), 1 / (1 + power));
    if (!(p->away > over))
        return fmin(h, over);
    if (p->branch->steep)
        return fmin(h, fmax(over, fmin(p->away / PARTS, theta / (p->rate * inverse_mass))));
    const double away = p->coming ? 0.5 * p->away : p->away,
                 beside = h * pow(tolerance / (kick * p->branch->beside * pow(away / h, power - order)), 1.0 / (1 + order));
    return fmin(h, fmax(over, p->coming ? fmin(beside, away) : beside));
}

/* The branch points next to contact k. */
static size_t find_points(const struct bead_step_control *control, const struct bead_stepper *s, size_t k, double h,
                          struct nearby p[BEAD_BRANCHES])
{
    const double change = s->end.v[k] - s->end.v[k + 1], turning = s->end.a[k] - s->end.a[k + 1], rate = fabs(change),
                 d = fmax(bead_stepper_compression(s, &s->end, k), 0), until = rate > 0 ? d / rate : INFINITY;
    const struct bead_branch *b = control->branch;
    size_t count = 0;
    if (b[BEAD_BRANCH_ELASTIC].within > 0 && rate > 0)
        p[count++] = (struct nearby){&b[BEAD_BRANCH_ELASTIC], until,
                                     s->chain->law->force(s->table.stiffness[k], s->table.law, rate * h), change < 0, 0};
    if (b[BEAD_BRANCH_COMPRESSION].within > 0 && rate > 0)
        p[count++] =
            (struct nearby){&b[BEAD_BRANCH_COMPRESSION], until, bead_damping_force(&s->table, rate * h, rate), change < 0, 0};
    if (b[BEAD_BRANCH_RATE].within > 0 && turning != 0)
        p[count++] =
            (struct nearby){&b[BEAD_BRANCH_RATE], rate / fabs(turning), bead_damping_force(&s->table, d, fabs(turning) * h),
                            change * turning < 0, s->table.damping_exponent * bead_damping_force(&s->table, d, rate) / rate};
    return count;
}

struct bead_step_control bead_step_control_start(const struct bead_stepper *s, double theta, double omega)
{
    const double first = theta / omega, longest = (s->driven == SIZE_MAX ? growth : driven_growth) * first;
    struct bead_step_control control = {theta,
                                        sqrt(circles(s, s->chain->contacts, s->end.v, 0, true)),
                                        longest,
                                        theta / fmax(omega, drive_omega(s)),
                                        {{0, 0, 0, false}}};
    const struct bead_quadrature *q = &s->method->quadrature;
    if (!bead_stepper_damped(s))
        return control;
    control.branch[BEAD_BRANCH_ELASTIC] = branch(q, bead_chain_exponent(s->chain), false);
    if (s->table.damping > 0) {
        control.branch[BEAD_BRANCH_COMPRESSION] = branch(q, s->table.damping_compression, false);
        control.branch[BEAD_BRANCH_RATE] = branch(q, s->table.damping_exponent, true);
    }
    return control;
}

double bead_step_control_graded(const struct bead_step_control *control, const struct bead_stepper *s, double h)
{
    const size_t n = bead_stepper_contacts(s);
    const double *w = s->chain->inverse_mass;
    for (size_t k = 0; k < n; k++) {
        struct nearby p[BEAD_BRANCHES];
        const size_t points = !s->closed || s->closed[k] ? find_points(control, s, k, h, p) : 0;
        for (size_t i = 0; i < points; i++)
            h = fmin(h, grazing(&p[i], control->theta, s->method->quadrature.order, w[k] + (k + 1 < s->beads ? w[k + 1] : 0),
                                s->event_tolerance, h));
    }
    return h;
}

/* The error of the trapezoidal rule for exp(-z). If an acceleration decays with the rate lambda and the amplitude A, its effect on
 * a velocity over a step of length z / lambda differs by A times this from the mean of the accelerations at both ends. */
static double trapezoidal_error(double z)
{
    const double left = bead_exp(-z);
    return left - 1 + 0.5 * z * (1 + left);
}

/* The amplitude in the last step of motions that decay with the bound `rate`, in units of the largest velocity between neighbours.
 * Slower ones count for more there than in the error, which has a higher power of z. 1: unknown, because the forces have jumped
 * since. */
static double stiff_amplitude(const struct bead_stepper *s, double rate)
{
    const size_t n = bead_stepper_contacts(s);
    double off = 0, most = 0;
    if (s->steps == 0 || s->last_a != s->end.a)
        return 1;
    for (size_t k = 0; k < n; k++) {
        const double before = s->start.v[k] - s->start.v[k + 1], after = s->end.v[k] - s->end.v[k + 1],
                     turning = s->start.a[k] - s->start.a[k + 1] + (s->end.a[k] - s->end.a[k + 1]);
        off = fmax(off, fabs(after - before - 0.5 * s->h * turning));
        most = fmax(most, fabs(after));
    }
    return most > 0 ? fmin(off / (most * trapezoidal_error(rate * s->h)), 1) : 1;
}

/* The longest step in units of 1/rate. theta is for motions that decay at this rate from their full height. The error of a method
 * of order p is A z^(p+1); once the fastest motions have decayed and the others are slow, z grows, up to the limit of stability. */
static double stiff_theta(const struct bead_step_control *control, const struct bead_stepper *s, double rate)
{
    const double z = control->theta * pow(stiff_amplitude(s, rate), -1.0 / (s->method->quadrature.order + 1));
    return fmin(z, s->method->info.theta_max);
}

double bead_step_control_damped(const struct bead_step_control *control, const struct bead_stepper *s, double h)
{
    /* Below the exponent 1 the rate has no bound where a contact turns; steps are graded there. */
    const double rate = s->table.damping_exponent < 1 ? 0 : damping_rate(s);
    return rate * h > control->theta ? fmin(h, stiff_theta(control, s, rate) / rate) : h;
}

/* Reduces the drift of a method of order 8 by a factor of 25. */
static const double shortening = 0.7;

void bead_step_control_shorten(struct bead_step_control *control)
{
    control->theta *= shortening;
    control->longest *= shortening;
}
