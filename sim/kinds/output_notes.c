/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of movies: notes tied to things, and stops. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/memory.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

enum { MOST_NOTES = 100, MOST_STOPS = 200 };

/* "front", "wall", "last" or a number. */
static BEAD_OPTION_READER(read_bead)
{
    struct bead_note *note = settings;
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    if (strcmp(text, "front") == 0 || strcmp(text, "wall") == 0) {
        note->of = strcmp(text, "wall") == 0 ? BEAD_NOTE_WALL : BEAD_NOTE_FRONT;
        return BEAD_OK;
    }
    note->of = BEAD_NOTE_BEAD;
    return bead_output_read_place(reader, at, false, &note->number);
}

static BEAD_OPTION_READER(read_contact)
{
    struct bead_note *note = settings;
    BEAD_TRY(bead_not_beside(reader, at, "bead"));
    note->of = BEAD_NOTE_CONTACT;
    return bead_output_read_place(reader, at, true, &note->number);
}

static BEAD_OPTION_READER(read_chain)
{
    return bead_output_find_chain(reader, at, option->shape, &((struct bead_note *)settings)->chain);
}

static const struct bead_option note_rows[] = {
    {"bead", BEAD_OPTION_CUSTOM, .initial = "front", .shape = "front, wall, last or the number of a bead",
     .like = "front|wall|last|number", .read = read_bead,
     .help = "what the note points at: a bead, the wave's front, also on its way back, or the wall. What is not on the stage is "
             "pointed at in the row of all beads below it",
     .example = "40"},
    {"contact", BEAD_OPTION_CUSTOM, .shape = "the number of a contact, or last", .like = "number|last", .read = read_contact,
     .help = "instead of `bead`: a contact; 0 is that of the striker", .example = "12"},
    {"chain", BEAD_OPTION_CUSTOM, .shape = "all, or the name of a chain", .like = "text", .read = read_chain,
     .help = "in which chain; default: the first", .example = "Clean"},
    {"arrow", BEAD_OPTION_FLAG, offsetof(struct bead_note, arrow), .initial = "true",
     .help = "a pointer from the text to what it is about"},
};
static const struct bead_option_rows shared[] = {{bead_caption_rows, 4}, {NULL, 0}};
const struct bead_options bead_note_options = {"outputs.notes", "a list of texts, each tied to a thing on the stage",
                                               BEAD_OPTIONS(note_rows), shared, NULL};

BEAD_OPTION_READER(bead_output_read_notes)
{
    struct bead_output *output = settings;
    BEAD_TRY(bead_need_list(reader, at, option->shape, MOST_NOTES, "entries"));
    BEAD_TRY(bead_new(&output->movie.notes, at->node->count, reader->msg, "an output"));
    output->movie.note_count = at->node->count;
    for (size_t i = 0; i < output->movie.note_count; i++) {
        struct bead_at element = bead_at_item(at, i);
        if (element.node->kind != BEAD_NODE_MAP)
            return bead_must_be(reader, &element, "a map such as {at: 0.4 ms, bead: front, text: The front}");
        BEAD_TRY(bead_options_read(reader, &element, &bead_note_options, &output->movie.notes[i]));
        BEAD_TRY(bead_output_check_said(reader, &element, &output->movie.notes[i].said));
    }
    return BEAD_OK;
}

static const struct bead_option stop_time = {BEAD_TIME_OF_MOTION};

BEAD_OPTION_READER(bead_output_read_stops)
{
    struct bead_movie_asked *movie = &((struct bead_output *)settings)->movie;
    BEAD_TRY(bead_need_list(reader, at, option->shape, MOST_STOPS, "entries"));
    BEAD_TRY(bead_new(&movie->stops, at->node->count, reader->msg, "an output"));
    double *stops = movie->stops;
    movie->stop_count = at->node->count;
    for (size_t i = 0; i < movie->stop_count; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(bead_read_number(reader, &element, &stop_time, &stops[i]));
        if (i > 0 && stops[i] <= stops[i - 1])
            return bead_wrong(reader, &element, "is %g; must be later than the stop before, %g", stops[i], stops[i - 1]);
    }
    return BEAD_OK;
}

/* The bead, contact or wall must exist; in one of the chains, if the note is for all. */
static enum bead_error check_thing(const struct bead_reader *reader, const struct bead_at *at, const struct bead_note *note)
{
    const struct bead_scene *scene = reader->scene;
    const bool of_contact = note->of == BEAD_NOTE_CONTACT;
    size_t most = 0;
    for (size_t c = 0; c < scene->chain_count && !reader->unsound; c++) {
        const struct bead_chain_spec *chain = &scene->chains[c];
        if (note->chain != SIZE_MAX && note->chain != c)
            continue;
        if (note->of == BEAD_NOTE_WALL && chain->wall == BEAD_WALL_NONE)
            return BEAD_WRONG_KEY(reader, at, "bead", "is wall, but `%s` has none", chain->name);
        const size_t last = bead_scene_last_bead(scene, c) - (of_contact && chain->wall == BEAD_WALL_NONE);
        most = last > most ? last : most;
    }
    if (!reader->unsound && (of_contact || note->of == BEAD_NOTE_BEAD) && note->number > most)
        return BEAD_WRONG_KEY(reader, at, of_contact ? "contact" : "bead", "is %zu, but the last %s is %zu", note->number,
                              of_contact ? "contact" : "bead", most);
    return BEAD_OK;
}

static bool plays_in_browsers(const char *path)
{
    const char *dot = path ? strrchr(path, '.') : NULL;
    return !dot || strcasecmp(dot, ".mp4") == 0 || strcasecmp(dot, ".webm") == 0;
}

BEAD_OUTPUT_CHECK(bead_output_check_notes)
{
    const struct bead_movie_asked *movie = &output->movie;
    const bool stage = bead_views_any(&output->views, BEAD_ACTS);
    struct bead_at list = bead_at_key(at, "notes");
    double end = fmin(reader->scene->simulate.until, output->shown.time[1]); /* either may be NaN: not known yet */
    if (movie->note_count > 0 && (!stage || !output->views.axes))
        return bead_wrong(reader, &list, "are given, but notes need the view stage, and `axes`");
    if (movie->note_count > 0 && !bead_scene_system(reader->scene)->has_contacts)
        return bead_wrong(reader, &list, "are given, but there are no beads to point at");
    if (movie->race && (!stage || reader->scene->chain_count != 2 || !bead_scene_system(reader->scene)->has_striker))
        return BEAD_WRONG_KEY(reader, at, "race", "is true, but a race needs two chains of beads on a stage");
    if (movie->inset == BEAD_INSET_CELL && (!stage || !output->views.axes || !bead_scene_system(reader->scene)->has_contacts))
        return BEAD_WRONG_KEY(reader, at, "inset", "is cell, but a drawing of cells needs the view stage, and `axes`");
    if (movie->slides[0] && movie->poster[0])
        return BEAD_WRONG_KEY(reader, at, "slides", "are given beside `poster`; make two movies of it");
    if (movie->slides[0] && !plays_in_browsers(output->path))
        return BEAD_WRONG_KEY(reader, at, "slides", "play in a browser: the movie must be a .mp4 or a .webm");
    for (size_t i = 0; i < movie->note_count; i++) {
        struct bead_at element = bead_at_item(&list, i);
        if (movie->notes[i].said.at >= end)
            return BEAD_WRONG_KEY(reader, &element, "at", "is %g s; must be before the end of what is shown, at %g s",
                                  movie->notes[i].said.at, end);
        BEAD_TRY(check_thing(reader, &element, &movie->notes[i]));
    }
    for (size_t i = 0; i < movie->stop_count; i++) {
        list = bead_at_key(at, "stops");
        if (movie->stops[i] >= end || movie->stops[i] < output->shown.time[0])
            return bead_wrong(reader, &list, "has %g; must be times that the movie shows", movie->stops[i]);
    }
    return BEAD_OK;
}
