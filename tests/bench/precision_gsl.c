/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work against error of the GNU Scientific Library's Runge-Kutta Prince-Dormand (8, 9) with its step control. */
#ifdef BENCH_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "tests/bench/precision_watch.h"

static int rates(double t, const double y[], double rate[], void *context)
{
    (void)t;
    equations_rates(context, y, rate);
    return GSL_SUCCESS;
}

static bool solve(struct equations *equations, const struct problem *problem, double tolerance, struct watch *watch)
{
    size_t n = equations_size(equations);
    double *y = calloc(2 * n, sizeof *y), *scale = y + n;
    gsl_odeiv2_system system = {rates, NULL, n, equations};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, n);
    gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(n);
    if (!y || !step || !evolve)
        GIVE_UP("out of memory");
    equations_scales(equations, scale);
    gsl_odeiv2_control *control = gsl_odeiv2_control_scaled_new(tolerance, 0, 1, 0, scale, n);
    const double ends[] = {problem->early, problem->end};
    double t = 0, h = 1e-7;
    bool ok = control != NULL;
    equations_start(equations, y);
    for (size_t i = 0; i < 2; i++) {
        while (ok && t < ends[i]) {
            ok = gsl_odeiv2_evolve_apply(evolve, control, step, &system, &t, ends[i], &h, y) == GSL_SUCCESS;
            if (ok && watch)
                watch_step(watch, t, y, y + equations->beads + 1);
        }
    }
    gsl_odeiv2_control_free(control);
    gsl_odeiv2_evolve_free(evolve);
    gsl_odeiv2_step_free(step);
    free(y);
    return ok;
}

int main(void)
{
    gsl_set_error_handler_off();
    peer_sweep("GSL rk8pd", solve);
    return 0;
}
#else
#include <stdio.h>

int main(void)
{
    fprintf(stderr, "bench: GSL is not installed and left out: libgsl-dev would add it\n");
    return 0;
}
#endif
