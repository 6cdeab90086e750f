/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sessions, for the command line only. */
#pragma once

#include "beadreel/session.h"

/* Output number `index` of those that the session knows; false after the last. Strings are the session's. */
struct bead_planned {
    const char *name, *path, *kind; /* as in bead_result; path NULL: not made */
    bool made;                      /* not left out by --only, and a kind that the program makes */
};
bool bead_session_planned(const struct bead_session *session, size_t index, struct bead_planned *planned);
/* Name of the `index`-th output that no sink of the job can make (pictures in beadsim); NULL after the last. */
const char *bead_session_skipped(const struct bead_session *session, size_t index);
/* Refuses a file that the session reads: it must not be replaced. Errors: USAGE. */
enum bead_error bead_session_spare_inputs(const struct bead_session *session, const char *file, struct bead_message *msg);
/* The scene as run, with all changes; for a trajectory or a sweep's file, the scene stored in it. YAML; the session's. */
const char *bead_session_text(const struct bead_session *session);
/* Unit of the session's times: "s", or "" (bead_chain_time_unit). */
const char *bead_session_time_unit(const struct bead_session *session);
/* False if `simulate: {verify: true}` asked for more than the run reached; a warning says how. */
bool bead_session_verified(const struct bead_session *session);
/* Removes unfinished files. For handlers of signals that end the program at once: call nothing else after it. */
void bead_session_abandon(const struct bead_session *session);
