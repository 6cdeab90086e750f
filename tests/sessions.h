/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole runs in tests; a failure fails the test. */
#ifndef BEADREEL_TESTS_SESSIONS_H
#define BEADREEL_TESTS_SESSIONS_H

#include "beadreel/session.h"

void write_text(const char *path, const char *text);
/* The job run, with every sink there is where it names none; to be closed. */
struct bead_session *play_session(struct bead_job job);
/* The same, closed. */
struct bead_counts play_counts(struct bead_job job);

#endif
