/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plays one run: the one loop that advances runs. */
#include <math.h>

#include "sim/base/stop.h"
#include "sim/chain/chain_data.h"
#include "sim/run/play.h"

/* A passage that is not over after this many passages of a wave never ends. */
static const double usual_patience = 200;

enum bead_error bead_play_look_for_stop(const volatile sig_atomic_t *stop, double time, struct bead_message *msg)
{
    return bead_stop_is_asked(stop) ? bead_fail(msg, BEAD_ERROR_STOPPED, "stopped at %.4g s", time) : BEAD_OK;
}

enum bead_error bead_play_lost(const struct bead_runner *runner, struct bead_message *msg)
{
    const struct bead_chain *chain = runner->chain;
    char place[200];
    const double over = runner->kind->over(runner->run), time = isnan(over) ? runner->kind->time(runner->run) : over;
    return bead_fail(msg, BEAD_ERROR_NUMBERS,
                     "%schain%s%s: after %.3g s the front has not reached the end: give simulate.until, such as "
                     "`until: %.2g s`%s",
                     bead_chain_place(chain, "chain", place, sizeof place), *bead_chain_name(chain) ? " " : "",
                     bead_chain_name(chain), time, fmin(time, 10 * bead_chain_passage(chain, bead_chain_energy(chain))),
                     bead_chain_is_damped(chain) ? ", or less damping" : "");
}

enum bead_error bead_play_run(const struct bead_runner *runner, const struct bead_way *way, struct bead_message *msg)
{
    const struct bead_run_kind *kind = runner->kind;
    const struct bead_chain *chain = runner->chain;
    const bool passage = way->patience > 0;
    const double one =
        passage ? bead_chain_passage(chain, bead_chain_energy(chain)) : 0; /* 0: unknown, as for springs that collapse */
    const double give_up = one > 0 ? way->patience * one : INFINITY;
    for (double time; (time = kind->time(runner->run)) < way->until && !(passage && !isnan(kind->over(runner->run)));) {
        BEAD_TRY(bead_play_look_for_stop(way->stop, time, msg));
        if (passage && (time > give_up || kind->is_lost(runner->run))) {
            kind->give_up(runner->run);
            return bead_play_lost(runner, msg);
        }
        BEAD_TRY(kind->step(runner->run, msg));
        if (way->stepped)
            BEAD_TRY(way->stepped(way->context, runner, msg));
    }
    return BEAD_OK;
}

struct bead_way bead_play_way(const struct bead_play *p, double time)
{
    const double patience = p->patience > 0 ? p->patience : usual_patience;
    return (struct bead_way){.until = fmin(time, p->end), .patience = isfinite(p->end) ? 0 : patience, .stop = p->stop};
}
