/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work against error of this program's own methods, over steps; and of `auto` over the requested accuracy. All rows of a problem
 * are timed in turn, several times: a processor that changes its clock meanwhile does so for all of them.
 *   precision_ours [problem...]
 *   precision_ours --reference problem     writes the references of a problem that has no others */
#include "tests/bench/precision.h"

#include "sim/run/run.h"

struct task {
    struct built built;
    const struct references *references;
    double end;
    bool failed;
    double peaks, evaluations, *velocity; /* out: error, work, and where not NULL the velocities at the end */
};

static bool make_run(struct task *task, struct bead_run **run)
{
    struct bead_message msg = {""};
    struct bead_run_settings settings = {.chain = task->built.chain,
                                         .simulate = &task->built.scene->simulate,
                                         .kernels = bead_kernels_find(NULL),
                                         .end = task->end,
                                         .contact_peaks = true};
    enum bead_error err = bead_run_create(&settings, run, &msg);
    while (!err && bead_run_time(*run) < task->end)
        err = bead_run_step(*run, &msg);
    return !err;
}

static void solve(void *context)
{
    struct task *task = context;
    struct bead_run *run = NULL;
    struct bead_outcome outcome;
    task->failed = !make_run(task, &run);
    if (!task->failed) {
        bead_run_finish(run, task->end, &outcome);
        task->evaluations = (double)outcome.evaluations / (double)task->built.chain->beads;
        task->peaks = peak_error(outcome.contact_peaks, &task->references->peaks);
    }
    bead_run_destroy(run);
}

/* A separate run that ends at the early time, so that this is the end of a step. */
static double early_velocities(const struct problem *problem, const struct task *task)
{
    struct task early = *task;
    struct bead_run *run = NULL;
    struct bead_sample sample = {0};
    struct bead_message msg = {""};
    early.end = problem->early;
    double error = NAN;
    if (make_run(&early, &run) &&
        !bead_run_sample(run, early.end, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), (struct bead_span){0, SIZE_MAX - 1}, &sample, &msg))
        error = velocity_error(&task->references->states, early.end, sample.field[BEAD_FIELD_VELOCITY],
                               task->built.chain->spec->striker_velocity);
    bead_run_destroy(run);
    return error;
}

/* A row, and what it is the row of. */
struct measurement {
    struct row row;
    char simulate[128], setting[32];
};

/* Those of a problem. */
struct measurements {
    const struct problem *problem;
    const struct references *references;
    size_t count;
    struct measurement row[256];
};

/* Seconds for the time of a row, each time; runs that take longer than this are timed once. */
static double share_of_time(void)
{
    return quick() ? 0.01 : 0.03;
}

/* The row asked for, NULL if its run fails, which is normal for a long step; it comes after the others. */
static struct measurement *measure(struct measurements *all, const char *solver, const char *setting, const char *simulate)
{
    const struct problem *problem = all->problem;
    if (all->count == sizeof all->row / sizeof *all->row)
        GIVE_UP("more rows than there is room for");
    struct measurement *m = &all->row[all->count];
    struct task task = {build(problem->chain, simulate), all->references, problem->end, false, NAN, 0, NULL};
    const double start = cpu_seconds();
    solve(&task);
    const double first = cpu_seconds() - start;
    if (!task.failed) {
        snprintf(m->setting, sizeof m->setting, "%s", setting);
        snprintf(m->simulate, sizeof m->simulate, "%s", simulate);
        m->row = (struct row){problem->name, solver, m->setting, 0, task.peaks, 0, task.evaluations};
        m->row.cpu = first > share_of_time() ? first : best_time_within(share_of_time(), solve, &task);
        m->row.velocity = early_velocities(problem, &task);
        all->count++;
    }
    release(&task.built);
    return task.failed ? NULL : m;
}

/* Steps are halved until only rounding is left, or time is up. */
static void sweep_steps(struct measurements *all, const char *method)
{
    const double longest = 8e-6, shortest = quick() ? 0.5e-6 : 0.01e-6, floor_of_rounding = 1e-12;
    double before = INFINITY;
    for (double step = longest; step > shortest; step /= 2) {
        char simulate[128], setting[32];
        snprintf(simulate, sizeof simulate, "until: %.17g, method: %s, step: %.17g", all->problem->end, method, step);
        snprintf(setting, sizeof setting, "%g us", step * 1e6);
        const struct measurement *m = measure(all, method, setting, simulate);
        if (!m)
            continue;
        if (m->row.cpu > limit() || (m->row.peaks < floor_of_rounding && m->row.peaks > before / 2))
            return;
        before = m->row.peaks;
    }
}

/* Four to the decade: a step then changes by 7 %. */
static void sweep_accuracies(struct measurements *all)
{
    double before = 0;
    for (int quarters = 4 * 3 - 1; quarters <= 4 * (quick() ? 8 : 12); quarters++) {
        char simulate[128], setting[32];
        snprintf(setting, sizeof setting, "%.2g", pow(10, -0.25 * quarters));
        snprintf(simulate, sizeof simulate, "until: %.17g, method: auto, accuracy: %s", all->problem->end, setting);
        const struct measurement *m = measure(all, "auto", setting, simulate);
        if (m && m->row.evaluations == before)
            all->count--;
        else if (m)
            before = m->row.evaluations;
    }
}

/* The times once more. */
static void measure_again(struct measurements *all)
{
    for (size_t i = 0; i < all->count; i++) {
        struct measurement *m = &all->row[i];
        if (m->row.cpu > share_of_time())
            continue;
        struct task task = {build(all->problem->chain, m->simulate), all->references, all->problem->end, false, NAN, 0, NULL};
        m->row.cpu = fmin(m->row.cpu, best_time_within(share_of_time(), solve, &task));
        release(&task.built);
    }
}

/* ---- references ---- */

static void write_peaks(const struct problem *problem, const struct bead_outcome *outcome, size_t contacts)
{
    char path[128];
    snprintf(path, sizeof path, "tests/reference/%s_peaks.csv", problem->files);
    FILE *file = fopen(path, "w");
    if (!file)
        GIVE_UP("cannot write %s", path);
    fprintf(file,
            "# %s with a step of %g us; contacts still loading at the end are left out\ncontact,peak_contact_force_N,time_s\n",
            problem->method, problem->finest * 1e6);
    for (size_t k = 0; k < contacts; k++) {
        const struct bead_peak *peak = &outcome->contact_peaks[k];
        if (!peak->open && !isnan(peak->time))
            fprintf(file, "%zu,%.15e,%.12e\n", k, peak->value, peak->time);
    }
    if (fclose(file))
        GIVE_UP("cannot write %s", path);
}

static void write_states(const struct problem *problem, struct bead_run *run, size_t beads)
{
    char path[128];
    struct bead_sample sample = {0};
    struct bead_message msg = {""};
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    if (bead_run_sample(run, problem->early, fields, (struct bead_span){0, SIZE_MAX - 1}, &sample, &msg))
        GIVE_UP("%s", msg.text);
    snprintf(path, sizeof path, "tests/reference/%s_states.csv", problem->files);
    FILE *file = fopen(path, "w");
    if (!file)
        GIVE_UP("cannot write %s", path);
    fprintf(file, "# %s with a step of %g us\ntime_s,bead,displacement_m,velocity_mps\n", problem->method, problem->finest * 1e6);
    for (size_t j = 0; j < beads; j++)
        fprintf(file, "%.9e,%zu,%.15e,%.15e\n", problem->early, j, sample.field[BEAD_FIELD_DISPLACEMENT][j],
                sample.field[BEAD_FIELD_VELOCITY][j]);
    if (fclose(file))
        GIVE_UP("cannot write %s", path);
}

static void write_references(const struct problem *problem)
{
    char simulate[128];
    if (!problem->method)
        GIVE_UP("the references of %s are from another program", problem->name);
    snprintf(simulate, sizeof simulate, "method: %s, step: %.17g", problem->method, problem->finest);
    struct task task = {build(problem->chain, simulate), NULL, problem->early, false, NAN, 0, NULL};
    struct bead_run *run = NULL;
    struct bead_outcome outcome;
    if (!make_run(&task, &run))
        GIVE_UP("the run failed");
    write_states(problem, run, task.built.chain->beads);
    bead_run_destroy(run);
    task.end = problem->end;
    if (!make_run(&task, &run))
        GIVE_UP("the run failed");
    bead_run_finish(run, problem->end, &outcome);
    write_peaks(problem, &outcome, task.built.chain->contacts);
    bead_run_destroy(run);
    release(&task.built);
}

static void sweep(const struct problem *problem)
{
    struct references references = read_references(problem);
    struct measurements *all = calloc(1, sizeof *all);
    if (!all)
        GIVE_UP("out of memory");
    all->problem = problem;
    all->references = &references;
    sweep_accuracies(all);
    const struct bead_method_info *info;
    for (size_t i = 0; (info = bead_method_info(i)); i++)
        sweep_steps(all, info->name);
    for (int again = 0; again < (quick() ? 1 : 4); again++)
        measure_again(all);
    for (size_t i = 0; i < all->count; i++)
        print_row(&all->row[i].row);
    free(all);
    free_references(&references);
}

int main(int count, char **word)
{
    if (count == 3 && strcmp(word[1], "--reference") == 0) {
        write_references(find_problem(word[2]));
        return 0;
    }
    for (int i = 1; i < count; i++)
        sweep(find_problem(word[i]));
    for (size_t i = 0; count < 2 && i < PROBLEMS; i++)
        sweep(&problems[i]);
    return 0;
}
