/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a movie's file says beside its pictures: what made it, its chapters and subtitles. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_NOTES_H
#define BEADREEL_RENDER_MOVIE_MOVIE_NOTES_H

#include "beadreel/movie.h"
#include "render/movie/movie_times.h"

struct bead_movie_notes {
    char *comment;                       /* version and scene */
    struct bead_movie_chapter *chapters; /* one for each caption, and what is before the first; NULL: no captions */
    size_t chapter_count;
    struct bead_movie_subtitle *subtitles; /* one for each caption that is shown */
    size_t subtitle_count;
    char *text; /* of both */
};

/* Errors: MEMORY; what is there then is freed with bead_movie_notes_free. */
BEAD_CHECK enum bead_error bead_movie_notes_make(const struct bead_output *output, const struct bead_scene *scene,
                                                 const struct bead_movie_times *times, struct bead_movie_notes *notes,
                                                 struct bead_message *msg);
void bead_movie_notes_free(struct bead_movie_notes *notes);

#endif
