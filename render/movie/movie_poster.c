/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the frame that becomes the poster while frames pass, and writes it. The sink offers it every frame drawn. */
#include "render/movie/movie_poster.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/picture.h"

/* A frame replaces the one kept only if it is better by this factor, to save copying. */
static const double better = 1.002;

struct bead_poster {
    const char *path, *title;
    double at, slack; /* s; at NaN: the frame that shows most */
    double interest;  /* of the frame kept */
    struct bead_frame frame;
    bool taken;
};

enum bead_error bead_poster_create(const struct bead_output *output, const struct bead_scene *scene, const char *path, double step,
                                   struct bead_poster **poster, struct bead_message *msg)
{
    struct bead_poster *p = *poster = calloc(1, sizeof *p);
    if (!p)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a poster");
    p->at = output->movie.poster_at;
    p->slack = 0.5 * step;
    p->path = path;
    p->title = scene->title;
    return BEAD_OK;
}

void bead_poster_destroy(struct bead_poster *p)
{
    if (!p)
        return;
    bead_frame_free(&p->frame);
    free(p);
}

enum bead_error bead_poster_offer(struct bead_poster *p, const struct bead_composer *composer, double time,
                                  struct bead_message *msg)
{
    const struct bead_frame *frame = bead_composer_frame(composer);
    double interest = isnan(p->at) ? bead_composer_interest(composer, time) : 0;
    bool wanted = isnan(p->at) ? !p->taken || interest > better * p->interest : !p->taken && time >= p->at - p->slack;
    if (!wanted)
        return BEAD_OK;
    enum bead_error err = p->frame.pixels ? BEAD_OK : bead_frame_create(frame->width, frame->height, &p->frame, msg);
    if (err)
        return err;
    p->frame.alpha = frame->alpha;
    bead_frame_copy(&p->frame, frame, (struct bead_rect){0, 0, frame->width, frame->height});
    p->interest = interest;
    p->taken = true;
    return BEAD_OK;
}

static enum bead_error set_cover(const struct bead_poster *p, uint64_t bytes, struct bead_movie *movie, struct bead_message *msg)
{
    uint8_t *png = malloc((size_t)bytes + 1);
    FILE *file = fopen(p->path, "rb");
    enum bead_error err = BEAD_OK;
    if (!png)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", p->path);
    else if (!file || fread(png, 1, (size_t)bytes, file) != bytes)
        err = bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read back", p->path);
    if (file)
        fclose(file);
    if (!err)
        err = bead_movie_cover(movie, png, (size_t)bytes, msg);
    free(png);
    return err;
}

enum bead_error bead_poster_write(const struct bead_poster *p, struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg)
{
    const struct bead_picture_notes notes = {.size = sizeof notes, .title = p->title && p->title[0] ? p->title : NULL};
    *bytes = 0;
    if (!p->taken)
        return BEAD_OK;
    enum bead_error err = bead_png_write(p->path, &p->frame, &notes, bytes, msg);
    return err ? err : set_cover(p, *bytes, movie, msg);
}
