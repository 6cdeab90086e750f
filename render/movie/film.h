/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the sinks of films and of single frames: the film as known before the run, the times of its frames, its notes, sound
 * and poster. */
#pragma once

#include "beadreel/movie.h"
#include "beadreel/sink.h"
#include "beadreel/view.h"
#include "render/movie/composer.h"
#include "render/movie/film_clock.h"
#include "render/view/tale.h"

/* The times of frames: the title card's first, then those of the motion, at equal steps from its first time to its last. */
struct bead_movie_times {
    double time[2], step; /* s: first and last frame of the motion; from frame to frame, the least if the speed changes */
    struct bead_film_clock film;
    size_t card, frames;   /* frames of the card; all frames */
    size_t group;          /* consecutive frames with one picture: drafts have fewer pictures than frames */
    struct bead_grid grid; /* of the samples */
    bool held;             /* frames show the largest forces since the one before */
};

/* Borrows the output and all that the context points to. */
struct bead_film {
    const struct bead_output *output;
    struct bead_run_context context;
    int width, height;
    struct bead_movie_times times;
    unsigned fields, comparison;  /* BEAD_FIELD_BITs, of samples and of those of the comparison run */
    size_t last_bead;             /* the last bead needed of the longest chain */
    struct bead_preview *preview; /* own; NULL: nothing has been scouted */
};

/* Errors: SCENE. */
BEAD_CHECK enum bead_error bead_film_prepare(const struct bead_output *output, const struct bead_run_context *context,
                                             struct bead_film *film, struct bead_message *msg);
void bead_film_free(struct bead_film *film);
/* The needs of all frames. */
void bead_film_needs(const struct bead_film *film, const char *why, struct bead_needs *needs);
/* Does it need a scouting run, for its range of colours or for images that show their future? */
bool bead_film_scouts(const struct bead_film *film);
/* Takes a sample of the scouting run. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_film_scout(struct bead_film *film, const struct bead_sample *sample, struct bead_message *msg);
/* `range`: as scouted; `interest`: will bead_composer_interest be called? Errors: those of bead_composer_create. */
BEAD_CHECK enum bead_error bead_film_compose(const struct bead_film *film, struct bead_range range, bool interest,
                                             struct bead_composer **composer, struct bead_message *msg);

/* ---- what a scouting run saw: movie_preview.c ---- */

/* The magnitude that only a short and narrow event exceeds; INFINITY: unknown. */
double bead_preview_typical(const struct bead_preview *preview);
/* The largest distance of a force from that at rest, and that which nine tenths of the beads or contacts do not exceed; 0: no
 * chain is pressed, or forces are not shown. */
void bead_preview_away(const struct bead_preview *preview, double *largest, double *usual);
/* Feeds all samples of a chain, of the field shown, into a view. */
BEAD_CHECK enum bead_error bead_preview_feed(const struct bead_preview *preview, size_t chain, const struct bead_view_type *type,
                                             struct bead_view *view, struct bead_message *msg);
/* Are the samples kept? */
bool bead_preview_whole(const struct bead_preview *preview);

/* ---- times: movie_times.c ---- */

/* Fills in film->times. Errors: SCENE (nothing to show, or too much). */
BEAD_CHECK enum bead_error bead_movie_times_choose(struct bead_film *film, struct bead_message *msg);
/* Does the number of frames follow from the beads? */
bool bead_film_looks_at_beads(const struct bead_output *output, const struct bead_run_context *context);
/* s of the motion at frame `index`, or between frames; groups do not matter. */
double bead_movie_time(const struct bead_movie_times *times, double index);
/* s of the film, from its first frame, when a time of the motion is first shown; `fps`: frames a second. */
double bead_movie_film_time(const struct bead_movie_times *times, double motion, double fps);
/* s of the film at the beginning of the first frame that shows a time of the motion. */
double bead_movie_stop_time(const struct bead_movie_times *times, double motion, double fps);
/* Does the frame have its own picture? The card, the first frame of each group, and the last frame do. */
bool bead_movie_draws(const struct bead_movie_times *times, size_t index);
/* The number of such frames. */
size_t bead_movie_pictures(const struct bead_movie_times *times);
/* "120 frames (60 of them in the file: gif has at most 50 a second)". */
void bead_movie_count_words(const struct bead_film *film, char *text, size_t size);

/* ---- notes: movie_notes.c ---- */

/* The words in a movie's file. */
struct bead_movie_notes {
    char *comment;                       /* version and scene */
    struct bead_movie_chapter *chapters; /* one for each caption and stop, and one before the first; NULL: none */
    size_t chapter_count;
    struct bead_movie_subtitle *subtitles; /* one for each caption shown */
    size_t subtitle_count;
    char *text; /* of both */
    char (*stop_names)[32];
    char (*words)[BEAD_TALE_WORDS / 2]; /* subtitles about each chain, empty until the end of the film; NULL: not asked for */
};

/* To be freed even after an error. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_movie_notes_make(const struct bead_film *film, struct bead_movie_notes *notes,
                                                 struct bead_message *msg);
/* Fills the subtitles that say what happens. */
void bead_movie_notes_tell(const struct bead_tale *tale, struct bead_movie_notes *notes);
void bead_movie_notes_free(struct bead_movie_notes *notes);

/* ---- slides: slides.c ---- */

/* Writes a page with the finished film in it. Errors: IO, MEMORY. */
BEAD_CHECK enum bead_error bead_slides_write(const struct bead_film *film, const char *path, const char *movie, const char *tale,
                                             uint64_t *bytes, struct bead_message *msg);

/* ---- sound: film_sound.c ---- */

struct bead_film_sound;

/* NULL if the output asks for none; borrows the film. Errors: SCENE (no chain has the bead or contact; too long), MEMORY. */
BEAD_CHECK enum bead_error bead_film_sound_create(const struct bead_film *film, struct bead_film_sound **sound,
                                                  struct bead_message *msg);
void bead_film_sound_destroy(struct bead_film_sound *sound);
/* Channels of the movie's file: 1, or 2 for several chains, the first at the left, the last at the right. */
int bead_film_sound_channels(const struct bead_film_sound *sound);
/* Adds the needs of the sound to those of each sample. */
void bead_film_sound_needs(const struct bead_film_sound *sound, struct bead_needs *needs);
/* Takes a sample on the grid of the times. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_film_sound_feed(struct bead_film_sound *sound, const struct bead_sample *sample,
                                                struct bead_message *msg);
/* Writes the sound of the whole film into its movie. Errors: MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_film_sound_write(const struct bead_film_sound *sound, struct bead_movie *movie,
                                                 struct bead_message *msg);

/* ---- poster: movie_poster.c ---- */

/* Chooses a frame as frames pass, and keeps a copy. */
struct bead_poster {
    double at, slack;        /* s; at NaN: the frame that shows most */
    double interest;         /* of the best frame so far */
    bool taken;              /* there is a frame */
    struct bead_frame frame; /* the copy, freed by its owner */
};
/* `at`: a time of the motion, s, or NaN; `step`: s of the motion between frames. */
struct bead_poster bead_poster_choose(double at, double step);
/* Is a frame at this time as late as the poster's? */
bool bead_poster_reached(const struct bead_poster *poster, double time);
/* Call it for each frame in turn: is it the requested one, or does it show more than all before? */
bool bead_poster_prefers(struct bead_poster *poster, const struct bead_composer *composer, double time);
/* Called after each draw: copies the frame if it is preferred. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_poster_offer(struct bead_poster *poster, const struct bead_composer *composer, double time,
                                             struct bead_message *msg);
/* Writes a frame as a picture with the title and the text of its scene. Errors: IO, MEMORY. */
BEAD_CHECK enum bead_error bead_poster_file(const char *path, const struct bead_frame *frame, const char *title, const char *source,
                                            uint64_t *bytes, struct bead_message *msg);
/* Writes the file, if there is a frame, and makes it the movie's cover. `bytes`: size of the file; 0: none. Errors: IO, MEMORY,
 * CODEC. */
BEAD_CHECK enum bead_error bead_poster_write(const struct bead_poster *poster, const char *path, const struct bead_scene *scene,
                                             struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg);
