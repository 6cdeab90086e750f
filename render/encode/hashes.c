/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes instead of pictures: a line of 16 hexadecimal digits a frame, so that runs can be compared without any codec. */
#include <inttypes.h>
#include <stdio.h>

#include "beadreel/file.h"
#include "render/encode/movie_private.h"

static enum bead_error hash_open(struct bead_movie *movie, struct bead_message *msg)
{
    return bead_file_create(movie->part, &movie->lines, msg);
}

/* Always over the whole frame, so that anything `changes` leaves out by mistake is noticed. */
static enum bead_error hash_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                                struct bead_message *msg)
{
    (void)changes;
    if (fprintf(movie->lines, "%016" PRIx64 "\n", bead_frame_hash(frame)) < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed", movie->part);
    movie->encoded++;
    return BEAD_OK;
}

static enum bead_error hash_finish(struct bead_movie *movie, bool complete, struct bead_message *msg)
{
    (void)complete;
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
