/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the frame that becomes the poster, copies it as it passes, and writes it. */
#include "render/movie/film.h"

#include <math.h>

#include "render/encode/picture_file.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

/* A frame replaces the kept one only if it is better by this factor, to save copying. */
static const double better = 1.002;

struct bead_poster bead_poster_choose(double at, double step)
{
    return (struct bead_poster){.at = at, .slack = 0.5 * step};
}

bool bead_poster_reached(const struct bead_poster *p, double time)
{
    return time >= p->at - p->slack;
}

bool bead_poster_prefers(struct bead_poster *p, const struct bead_composer *composer, double time)
{
    const double interest = isnan(p->at) ? bead_composer_interest(composer, time) : 0;
    if (p->taken ? !isnan(p->at) || !(interest > better * p->interest) : !isnan(p->at) && !bead_poster_reached(p, time))
        return false;
    p->interest = interest;
    p->taken = true;
    return true;
}

enum bead_error bead_poster_offer(struct bead_poster *p, const struct bead_composer *composer, double time,
                                  struct bead_message *msg)
{
    const struct bead_frame *frame = bead_composer_frame(composer);
    if (!bead_poster_prefers(p, composer, time))
        return BEAD_OK;
    BEAD_TRY(p->frame.pixels ? BEAD_OK : bead_frame_create(frame->width, frame->height, &p->frame, msg));
    p->frame.alpha = frame->alpha;
    bead_frame_copy(&p->frame, frame, (struct bead_rect){0, 0, frame->width, frame->height});
    return BEAD_OK;
}

static enum bead_error set_cover(const char *path, uint64_t bytes, struct bead_movie *movie, struct bead_message *msg)
{
    BEAD_FREED char *png = NULL;
    size_t length;
    BEAD_TRY(bead_file_read(path, bytes, &png, &length, msg));
    return bead_movie_cover(movie, (const uint8_t *)png, length, msg);
}

enum bead_error bead_poster_file(const char *path, const struct bead_frame *frame, const char *title, const char *source,
                                 uint64_t *bytes, struct bead_message *msg)
{
    const struct bead_picture_notes notes = {
        .size = sizeof notes, .title = title, .software = "beadreel " BEADREEL_VERSION, .source = source};
    return bead_picture_write(path, frame, &notes, bytes, msg);
}

enum bead_error bead_poster_write(const struct bead_poster *p, const char *path, const struct bead_scene *scene,
                                  struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg)
{
    *bytes = 0;
    if (!p->taken)
        return BEAD_OK;
    BEAD_TRY(bead_poster_file(path, &p->frame, scene->title, scene->text, bytes, msg));
    return set_cover(path, *bytes, movie, msg);
}
