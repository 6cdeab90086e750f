/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The comment, chapters and subtitles of a movie's file. */
#include "render/movie/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/movie/movie_words.h"
#include "render/origin/origin.h"

/* The times of the film, s, from which and until which a caption is seen; equal if it is not seen. */
static void find_span(const struct bead_film *film, size_t caption, double span[2])
{
    const struct bead_movie_asked *movie = &film->output->movie;
    const struct bead_movie_times *times = &film->times;
    double until = bead_caption_end(movie, &times->film, caption), length = (double)times->frames / movie->fps;
    span[0] = bead_movie_film_time(times, movie->captions[caption].at, movie->fps);
    span[1] = until < times->time[1] ? bead_movie_film_time(times, until, movie->fps) : length;
}

/* Chapters begin with the film: one is added for what is before the first. */
static void add_beginning(const struct bead_film *film, struct bead_movie_notes *notes, double first)
{
    const char *title = film->context.scene->title;
    if (notes->chapter_count == 0 && first > 0)
        notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){0, title[0] ? title : "Beginning"};
}

/* Puts the stops among the chapters, but for those that begin with a caption, within a frame, which has the better name. */
static void add_stops(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    for (size_t i = 0; i < movie->stop_count; i++) {
        const double start = bead_movie_stop_time(&film->times, movie->stops[i], movie->fps);
        add_beginning(film, notes, start);
        size_t at = notes->chapter_count;
        while (at > 0 && notes->chapters[at - 1].start > start)
            at--;
        if (at > 0 && start - notes->chapters[at - 1].start < 1 / movie->fps)
            continue;
        memmove(&notes->chapters[at + 1], &notes->chapters[at], (notes->chapter_count - at) * sizeof *notes->chapters);
        snprintf(notes->stop_names[i], sizeof notes->stop_names[i], "Stop %zu", i + 1);
        notes->chapters[at] = (struct bead_movie_chapter){start, notes->stop_names[i]};
        notes->chapter_count++;
    }
}

/* Chapters begin with the captions and at the stops. false: out of memory. */
static bool fill(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    char *text = notes->text;
    for (size_t i = 0; i < movie->caption_count; i++) {
        double span[2];
        find_span(film, i, span);
        if (!(span[1] > span[0]))
            continue;
        add_beginning(film, notes, span[0]);
        size_t size = strlen(movie->captions[i].text) + 1;
        if (!bead_markup_plain(movie->captions[i].text, text, size))
            return false;
        notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){span[0], text};
        notes->subtitles[notes->subtitle_count++] = (struct bead_movie_subtitle){span[0], span[1], text};
        text += size;
    }
    add_stops(film, notes);
    return true;
}

/* One subtitle after another about each chain; their words come at the end of the film. */
static bool reserve_words(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    const size_t count = film->context.chain_count;
    if (movie->subtitles != BEAD_SUBTITLES_WORDS || movie->caption_count > 0)
        return true;
    free(notes->subtitles);
    notes->subtitles = calloc(count, sizeof *notes->subtitles);
    notes->words = calloc(count, sizeof *notes->words);
    if (!notes->subtitles || !notes->words)
        return false;
    const double from = bead_movie_film_time(&film->times, film->times.time[0], movie->fps),
                 each = ((double)film->times.frames / movie->fps - from) / (double)count;
    for (size_t i = 0; i < count; i++)
        notes->subtitles[i] = (struct bead_movie_subtitle){from + (double)i * each, from + (double)(i + 1) * each, notes->words[i]};
    notes->subtitle_count = count;
    return true;
}

void bead_movie_notes_tell(const struct bead_tale *tale, struct bead_movie_notes *notes)
{
    for (size_t i = 0; notes->words && i < notes->subtitle_count; i++) {
        bead_tale_of_chain(tale, i, notes->words[i], sizeof *notes->words);
        if (!*notes->words[i])
            snprintf(notes->words[i], sizeof *notes->words, "There is no wave.");
    }
}

static bool reserve(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    size_t captions = movie->caption_count, bytes = 0;
    for (size_t i = 0; i < captions; i++)
        bytes += strlen(movie->captions[i].text) + 1;
    if (captions + movie->stop_count == 0)
        return reserve_words(film, notes);
    notes->chapters = calloc(captions + movie->stop_count + 1, sizeof *notes->chapters);
    notes->subtitles = calloc(captions + 1, sizeof *notes->subtitles);
    notes->text = malloc(bytes + 1);
    notes->stop_names = calloc(movie->stop_count + 1, sizeof *notes->stop_names);
    return notes->chapters && notes->subtitles && notes->text && notes->stop_names && reserve_words(film, notes);
}

enum bead_error bead_movie_notes_make(const struct bead_film *film, struct bead_movie_notes *notes, struct bead_message *msg)
{
    *notes = (struct bead_movie_notes){.comment = NULL};
    BEAD_TRY(bead_origin_text(NULL, film->context.scene->text, &notes->comment, msg));
    if (!reserve(film, notes) || !fill(film, notes))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the notes of a movie");
    return BEAD_OK;
}

void bead_movie_notes_free(struct bead_movie_notes *notes)
{
    free(notes->comment);
    free(notes->chapters);
    free(notes->subtitles);
    free(notes->text);
    free(notes->stop_names);
    free(notes->words);
}
