/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plays the chains of a sweep, each by itself, on all threads, and reports progress. */
#include <stdatomic.h>
#include <unistd.h>

#include "sim/base/settings.h"
#include "sim/base/thread_pool.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

struct work {
    const struct sweep_generator *generator;
    const struct bead_kernels *kernels;
    atomic_size_t done;
};

enum bead_error bead_sweep_settings_take(struct bead_sweep_settings *own, const struct bead_sweep_settings *given,
                                         struct bead_message *msg)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    enum bead_error err = bead_settings_take(own, sizeof *own, BEAD_SETTINGS_UP_TO(struct bead_sweep_settings, threads), given,
                                             "bead_sweep_settings", msg);
    if (!err && !bead_kernels_find(own->instructions))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "--instructions %s: this machine has no such kernels", own->instructions);
    if (!err && own->threads <= 0)
        own->threads = cores > 1 ? (int)cores : 1;
    return err;
}

static void tell(const struct sweep_generator *g, size_t done)
{
    if (!g->settings->progress)
        return;
    const double items = (double)(g->done_before + done);
    const struct bead_progress progress = {
        .what = g->what, .done = items / (double)(g->done_before + g->count), .time = NAN, .items = items, .item = "chains"};
    g->settings->progress(g->settings->progress_context, &progress);
}

static enum bead_error play_one(void *context, size_t index, bool calling, struct bead_message *msg)
{
    struct work *work = context;
    const struct sweep_generator *g = work->generator;
    struct bead_sweep_chain *made = NULL;
    size_t panel = g->panel, configuration = g->first + index;
    if (calling)
        tell(g, atomic_load(&work->done));
    if (g->find)
        g->find(g->context, index, &panel, &configuration);
    BEAD_TRY(bead_sweep_chain_create(g->sweep, panel, configuration, &made, msg));
    const struct bead_chain *chain = bead_sweep_chain_of(made);
    const struct bead_simulate *simulate = &bead_chain_scene(chain)->simulate;
    struct bead_play play = {.chains = &chain,
                             .chain_count = 1,
                             .simulate = simulate,
                             .kernels = work->kernels,
                             .end = isnan(simulate->until) ? INFINITY : simulate->until,
                             .needed = INFINITY,
                             .passage = isnan(simulate->until) ? BEAD_PASSAGE_OF_FRONT : BEAD_PASSAGE_NONE,
                             .threads = 1,
                             .stop = g->settings->stop};
    enum bead_error err = g->play(g->context, index, &play, msg);
    bead_sweep_chain_destroy(made);
    if (!err)
        atomic_fetch_add(&work->done, 1);
    return err;
}

enum bead_error bead_sweep_play(struct sweep_generator *generator, struct bead_message *msg)
{
    struct work work = {.generator = generator, .kernels = bead_kernels_find(generator->settings->instructions)};
    tell(generator, 0);
    enum bead_error err = bead_thread_pool_run(generator->count, generator->settings->threads, play_one, &work, msg);
    generator->played = atomic_load(&work.done);
    return err;
}
