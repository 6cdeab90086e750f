/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work against error of SUNDIALS: CVODE's Adams methods and ARKODE's explicit Runge-Kutta 8. */
#ifdef BENCH_SUNDIALS
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "tests/bench/precision_watch.h"

static int rates(sunrealtype t, N_Vector y, N_Vector rate, void *context)
{
    (void)t;
    equations_rates(context, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
    return 0;
}

struct vectors {
    SUNContext context;
    N_Vector y, scale;
};

static struct vectors make_vectors(const struct equations *equations, double tolerance)
{
    struct vectors x = {NULL, NULL, NULL};
    sunindextype n = (sunindextype)equations_size(equations);
    if (SUNContext_Create(NULL, &x.context) || !(x.y = N_VNew_Serial(n, x.context)) || !(x.scale = N_VNew_Serial(n, x.context)))
        GIVE_UP("out of memory");
    equations_start(equations, N_VGetArrayPointer(x.y));
    equations_scales(equations, N_VGetArrayPointer(x.scale));
    N_VScale(tolerance, x.scale, x.scale);
    return x;
}

static void free_vectors(struct vectors *x)
{
    N_VDestroy(x->y);
    N_VDestroy(x->scale);
    SUNContext_Free(&x->context);
}

/* What the two solvers have in common: stop times and steps, one at a time. */
struct solver {
    void *memory;
    int (*stop)(void *memory, sunrealtype time);
    int (*step)(void *memory, sunrealtype to, N_Vector y, sunrealtype *t, int task);
    int one_step;
};

static bool march(const struct solver *solver, const struct equations *equations, const struct problem *problem, N_Vector y,
                  struct watch *watch)
{
    const double ends[] = {problem->early, problem->end};
    double t = 0;
    bool ok = true;
    for (size_t i = 0; ok && i < 2; i++) {
        ok = solver->stop(solver->memory, ends[i]) == 0;
        while (ok && t < ends[i]) {
            ok = solver->step(solver->memory, ends[i], y, &t, solver->one_step) >= 0;
            const double *at = N_VGetArrayPointer(y);
            if (ok && watch)
                watch_step(watch, t, at, at + equations->beads + 1);
        }
    }
    return ok;
}

static bool adams(struct equations *equations, const struct problem *problem, double tolerance, struct watch *watch)
{
    struct vectors x = make_vectors(equations, tolerance);
    void *memory = CVodeCreate(CV_ADAMS, x.context);
    SUNNonlinearSolver fixed_point = SUNNonlinSol_FixedPoint(x.y, 0, x.context);
    bool ok = memory && fixed_point && !CVodeInit(memory, rates, 0, x.y) && !CVodeSVtolerances(memory, 0, x.scale) &&
              !CVodeSetNonlinearSolver(memory, fixed_point) && !CVodeSetUserData(memory, equations) &&
              !CVodeSetMaxNumSteps(memory, -1) && !CVodeSetErrFile(memory, NULL);
    struct solver solver = {memory, CVodeSetStopTime, CVode, CV_ONE_STEP};
    ok = ok && march(&solver, equations, problem, x.y, watch);
    CVodeFree(&memory);
    SUNNonlinSolFree(fixed_point);
    free_vectors(&x);
    return ok;
}

static int set_up(void *memory)
{
    return ERKStepSetTableNum(memory, ARKODE_FEHLBERG_13_7_8) || ERKStepSetMaxNumSteps(memory, -1) ||
           ERKStepSetErrFile(memory, NULL);
}

static bool explicit_runge_kutta(struct equations *equations, const struct problem *problem, double tolerance, struct watch *watch)
{
    struct vectors x = make_vectors(equations, tolerance);
    void *memory = ERKStepCreate(rates, 0, x.y, x.context);
    bool ok = memory && !ERKStepSVtolerances(memory, 0, x.scale) && !ERKStepSetUserData(memory, equations) && !set_up(memory);
    struct solver solver = {memory, ERKStepSetStopTime, ERKStepEvolve, ARK_ONE_STEP};
    ok = ok && march(&solver, equations, problem, x.y, watch);
    ERKStepFree(&memory);
    free_vectors(&x);
    return ok;
}

int main(void)
{
    peer_sweep("CVODE Adams", adams);
    peer_sweep("ARKODE ERK8", explicit_runge_kutta);
    return 0;
}
#else
#include <stdio.h>

int main(void)
{
    fprintf(stderr, "bench: SUNDIALS is not installed and left out: libsundials-dev would add it\n");
    return 0;
}
#endif
