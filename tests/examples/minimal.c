/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run a scene, print the largest contact force. Build: cc minimal.c $(pkg-config --cflags --libs beadsim) */
#include <beadreel/session.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), NULL};
    struct bead_message msg;
    struct bead_session *session;
    struct bead_job job;

    BEAD_DEFAULT(&job);
    job.input = argc > 1 ? argv[1] : "clean-vs-delocalised"; /* a file, or a ready scene */
    job.output = argc > 2 ? argv[2] : ".";
    job.sinks = sinks;
    enum bead_error err = bead_session_open(&job, &session, &msg);
    if (!err)
        err = bead_session_run(session, &msg);
    if (err) {
        fprintf(stderr, "%s\n", msg.text);
        return bead_error_status(err);
    }
    size_t chains;
    const struct bead_outcome *outcome = bead_session_outcomes(session, &chains);
    for (size_t c = 0; c < chains; c++)
        if (outcome[c].contact_peaks) /* where a table of peaks is among the outputs */
            printf("chain %zu: first contact's peak force %.6f N at %.3f us\n", c, outcome[c].contact_peaks[0].value,
                   1e6 * outcome[c].contact_peaks[0].time);
    bead_session_close(session);
    return 0;
}
