/* The comment and the chapters of a movie's file. The sink makes them once the times are known. */
#include "render/movie/movie_notes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/movie/captions.h"

enum { CHAPTER_ROOM = 256 };

static char *make_comment(const struct bead_scene *scene)
{
    const char *text = scene->text ? scene->text : "";
    size_t size = strlen(text) + 64;
    char *comment = malloc(size);
    if (comment)
        snprintf(comment, size, "beadreel %s, scene:\n%s", bead_version(), text);
    return comment;
}

/* Chapters begin with the captions. */
static void fill_chapters(const struct bead_movie_asked *movie, const char *title, const struct bead_movie_times *times,
                          struct bead_movie_notes *notes)
{
    for (size_t i = 0; i < movie->caption_count; i++) {
        double start = bead_movie_film_time(times, movie->captions[i].at, movie->fps);
        char *text = notes->text + i * CHAPTER_ROOM;
        if (i == 0 && start > 0)
            notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){0, title[0] ? title : "Beginning"};
        bead_caption_plain(movie->captions[i].text, text, CHAPTER_ROOM);
        notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){start, text};
    }
}

enum bead_error bead_movie_notes_make(const struct bead_output *output, const struct bead_scene *scene,
                                      const struct bead_movie_times *times, struct bead_movie_notes *notes,
                                      struct bead_message *msg)
{
    size_t captions = output->movie.caption_count;
    *notes = (struct bead_movie_notes){.comment = make_comment(scene)};
    if (captions > 0) {
        notes->chapters = calloc(captions + 1, sizeof *notes->chapters);
        notes->text = calloc(captions, CHAPTER_ROOM);
    }
    if (!notes->comment || (captions > 0 && (!notes->chapters || !notes->text)))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the notes of a movie");
    fill_chapters(&output->movie, scene->title, times, notes);
    return BEAD_OK;
}

void bead_movie_notes_free(struct bead_movie_notes *notes)
{
    free(notes->comment);
    free(notes->chapters);
    free(notes->text);
    *notes = (struct bead_movie_notes){.comment = NULL};
}
