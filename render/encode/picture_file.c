/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills of pixels in files; as movies of one frame unless they are PNG. */
#include "render/encode/picture_file.h"

#include "beadreel/movie.h"
#include "render/origin/origin.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"

static struct bead_movie_settings still_of(int width, int height, bool alpha)
{
    return (struct bead_movie_settings){
        .size = sizeof(struct bead_movie_settings), .width = width, .height = height, .fps = 1, .alpha = alpha, .still = true};
}

static bool is_png(const char *path)
{
    return bead_output_ends_like(".png", path);
}

enum bead_error bead_picture_check(const char *path, int width, int height, bool alpha, struct bead_message *msg)
{
    const struct bead_movie_settings settings = still_of(width, height, alpha);
    return is_png(path) ? BEAD_OK : bead_movie_check(path, &settings, msg);
}

enum bead_error bead_picture_write(const char *path, const struct bead_frame *frame, const struct bead_picture_notes *notes,
                                   uint64_t *bytes, struct bead_message *msg)
{
    if (is_png(path))
        return bead_png_write(path, frame, notes, bytes, msg);
    struct bead_movie_settings settings = still_of(frame->width, frame->height, frame->alpha);
    struct bead_movie *movie;
    settings.title = notes->title;
    settings.dpi = notes->dpi;
    BEAD_FREED char *comment = NULL;
    BEAD_TRY(bead_origin_text(notes->description, notes->source, &comment, msg));
    settings.comment = comment;
    BEAD_TRY(bead_movie_open(path, &settings, &movie, msg));
    enum bead_error err = bead_movie_add(movie, frame, NULL, msg);
    if (!err)
        return bead_movie_close(movie, bytes, msg);
    bead_movie_abort(movie);
    return err;
}
