/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes instead of pictures: a line of 16 hexadecimal digits for each frame, to compare runs without a codec. */
#include <inttypes.h>
#include <stdio.h>

#include "render/encode/movie_private.h"
#include "sim/base/file.h"

static enum bead_error hash_open(struct bead_movie *movie, struct bead_message *msg)
{
    return bead_file_create(movie->part, &movie->lines, msg);
}

/* Always of the whole frame, so that a change missing in `changes` is noticed. */
static enum bead_error hash_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *,
                                struct bead_message *msg)
{
    if (fprintf(movie->lines, "%016" PRIx64 "\n", bead_frame_hash(frame)) < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed", movie->part);
    movie->encoded++;
    return BEAD_OK;
}

static enum bead_error hash_finish(struct bead_movie *movie, bool, struct bead_message *msg)
{
    FILE *file = movie->lines;
    movie->lines = NULL;
    return bead_file_close(file, movie->part, msg);
}

static void hash_destroy(struct bead_movie *movie)
{
    if (movie->lines)
        fclose(movie->lines);
}

const struct bead_movie_way bead_movie_hashes = {
    .open = hash_open, .add = hash_add, .finish = hash_finish, .destroy = hash_destroy};
