/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Claims of a session on the files it is going to write: of two runs that share a file the second is refused at its start. */
#include "sim/base/file.h"
#include "sim/session/session_data.h"

static enum bead_error claim(struct bead_made *m, struct bead_message *msg)
{
    /* The unfinished file of a sweep's results is a journal, which locks itself. */
    if (bead_session_holds_sweep(m) || !bead_session_makes(m))
        return BEAD_OK;
    uint64_t bytes;
    const char *beside = m->sink && m->type->beside ? m->type->beside(m->sink, &bytes) : NULL;
    const char *const files[2] = {m->path, beside};
    for (int i = 0; i < 2 && files[i]; i++) {
        BEAD_TRY(bead_file_make_parents(files[i], msg));
        BEAD_TRY(bead_file_claim(files[i], &m->claims[i], msg));
    }
    return BEAD_OK;
}

enum bead_error bead_session_check_inside(const struct bead_session *s, const struct bead_output *output, const char *path,
                                          struct bead_message *msg)
{
    if (s->job.allow_outside || !path || bead_file_is_inside(path))
        return BEAD_OK;
    return bead_output_wrong(output, msg, "outputs: `%s` leaves the output directory; a scene may do so only with --allow-outside",
                             path);
}

enum bead_error bead_session_claim(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < s->made_count && !err; i++)
        err = claim(&s->made[i], msg);
    if (err)
        bead_session_release(s);
    return err;
}

void bead_session_release_output(struct bead_made *m)
{
    for (int c = 0; c < 2; c++) {
        bead_file_release(m->claims[c], c == 0 && m->part != NULL);
        m->claims[c] = NULL;
    }
}

void bead_session_release(struct bead_session *s)
{
    for (size_t i = 0; s->made && i < s->made_count; i++)
        bead_session_release_output(&s->made[i]);
}
