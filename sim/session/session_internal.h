/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the command line asks of sessions, and programs need not. */
#pragma once

#include "beadreel/session.h"

bool bead_session_planned(const struct bead_session *session, size_t index, struct bead_planned *planned);
/* Name of the `index`-th output that none of the job's sinks can make (pictures in beadsim); NULL behind the last. */
const char *bead_session_skipped(const struct bead_session *session, size_t index);
/* Unit of the session's times: "s", or "" (bead_chain_time_unit). */
const char *bead_session_time_unit(const struct bead_session *session);
