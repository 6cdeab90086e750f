/* Which outputs a session cannot make. */
#include "sim/session_data.h"

const char *bead_session_skipped(const struct bead_session *session, size_t index)
{
    for (size_t i = 0; i < session->made_count; i++) {
        const struct bead_made *made = &session->made[i];
        if (made->asked && !made->type && index-- == 0)
            return made->output->path;
    }
    return NULL;
}
