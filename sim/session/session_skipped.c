/* Which outputs a session cannot make. */
#include "sim/session/session_data.h"

/* The sweep's own file, which every program makes. */
static bool is_results(const struct bead_session *session, const struct bead_made *made)
{
    return session->sweep && made->output->kind == BEAD_OUTPUT_SWEEP;
}

const char *bead_session_skipped(const struct bead_session *session, size_t index)
{
    for (size_t i = 0; i < session->made_count; i++) {
        const struct bead_made *made = &session->made[i];
        if (made->asked && !made->type && !made->sweep_type && !is_results(session, made) && index-- == 0)
            return made->output->path;
    }
    return NULL;
}
