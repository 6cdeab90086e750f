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
    const char *path;
    const struct bead_scene *scene;
    struct bead_poster_choice choice;
    struct bead_frame frame;
};

struct bead_poster_choice bead_poster_choose(double at, double step)
{
    return (struct bead_poster_choice){.at = at, .slack = 0.5 * step};
}

bool bead_poster_reached(const struct bead_poster_choice *choice, double time)
{
    return time >= choice->at - choice->slack;
}

bool bead_poster_prefers(struct bead_poster_choice *choice, const struct bead_composer *composer, double time)
{
    const double interest = isnan(choice->at) ? bead_composer_interest(composer, time) : 0;
    if (isnan(choice->at) ? choice->taken && !(interest > better * choice->interest)
                          : choice->taken || !bead_poster_reached(choice, time))
        return false;
    choice->interest = interest;
    choice->taken = true;
    return true;
}

enum bead_error bead_poster_create(const struct bead_output *output, const struct bead_scene *scene, const char *path, double step,
                                   struct bead_poster **poster, struct bead_message *msg)
{
    struct bead_poster *p = *poster = calloc(1, sizeof *p);
    if (!p)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a poster");
    p->choice = bead_poster_choose(output->movie.poster_at, step);
    p->path = path;
    p->scene = scene;
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
    if (!bead_poster_prefers(&p->choice, composer, time))
        return BEAD_OK;
    enum bead_error err = p->frame.pixels ? BEAD_OK : bead_frame_create(frame->width, frame->height, &p->frame, msg);
    if (err)
        return err;
    p->frame.alpha = frame->alpha;
    bead_frame_copy(&p->frame, frame, (struct bead_rect){0, 0, frame->width, frame->height});
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

enum bead_error bead_poster_file(const char *path, const struct bead_frame *frame, const struct bead_scene *scene, uint64_t *bytes,
                                 struct bead_message *msg)
{
    const struct bead_picture_notes notes = {.size = sizeof notes, .title = scene->title && scene->title[0] ? scene->title : NULL};
    return bead_png_write(path, frame, &notes, bytes, msg);
}

enum bead_error bead_poster_write(const struct bead_poster *p, struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg)
{
    *bytes = 0;
    if (!p->choice.taken)
        return BEAD_OK;
    enum bead_error err = bead_poster_file(p->path, &p->frame, p->scene, bytes, msg);
    return err ? err : set_cover(p, *bytes, movie, msg);
}
