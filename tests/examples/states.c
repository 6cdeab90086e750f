/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run a scene and print the hash of all its states: displacements and velocities of all chains after every step.
 *
 *   states SCENE DIRECTORY [KEY=VALUE]...
 *
 * Build: cc states.c $(pkg-config --cflags --libs beadsim) */
#include <beadreel/session.h>
#include <beadreel/sweep.h>
#include <inttypes.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), NULL};
    struct bead_message msg;
    struct bead_session *session;
    struct bead_job job;

    if (argc < 3) {
        fprintf(stderr, "Usage: states SCENE DIRECTORY [KEY=VALUE]...\n");
        return 2;
    }
    BEAD_DEFAULT(&job);
    job.input = argv[1];
    job.output = argv[2];
    job.settings = (const char *const *)argv + 3;
    job.setting_count = (size_t)argc - 3;
    job.sinks = sinks;
    job.hash = true;
    enum bead_error err = bead_session_open(&job, &session, &msg);
    if (!err)
        err = bead_session_run(session, &msg);
    if (err) {
        fprintf(stderr, "%s\n", msg.text);
        return bead_error_status(err);
    }
    const struct bead_counts *counts = bead_session_counts(session);
    printf("%016" PRIx64 " after %" PRIu64 " steps\n", counts->state_hash, counts->steps);
    bead_session_close(session);
    return 0;
}
