/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sessions.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "beadreel/render.h"
#include "beadreel/sweep.h"

void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

struct bead_session *play_session(struct bead_job job)
{
    static const struct bead_sink_type *const *sinks[3];
    struct bead_session *session = NULL;
    struct bead_message msg = {""};
    sinks[0] = bead_data_sinks();
    sinks[1] = bead_render_sinks();
    job.sinks = job.sinks ? job.sinks : sinks;
    job.size = sizeof job;
    job.hash = true;
    if (bead_session_open(&job, &session, &msg) || bead_session_run(session, &msg))
        fail_msg("%s", msg.text);
    return session;
}

struct bead_counts play_counts(struct bead_job job)
{
    struct bead_session *session = play_session(job);
    struct bead_counts counts = *bead_session_counts(session);
    bead_session_close(session);
    return counts;
}
