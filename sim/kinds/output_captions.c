/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of movies that are tables: captions, speed, title card. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/memory.h"
#include "sim/kinds/outputs.h"

enum { MOST_CAPTIONS = 200, MOST_SPEEDS = 100 };
static const double card_time = 3; /* s, of `card: true` */

/* "1/4000" or a number. */
static BEAD_OPTION_READER(read_factor)
{
    struct bead_speed *speed = settings;
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    char *end;
    double over = strtod(text, &end), under = 1;
    bool good = end > text;
    if (good && *end == '/') {
        const char *rest = end + 1;
        under = strtod(rest, &end);
        good = end > rest;
    }
    speed->factor = over / under;
    if (!good || *end || !(speed->factor >= 1e-12 && speed->factor <= 1e12))
        return bead_must_be(reader, at, option->shape);
    return BEAD_OK;
}

#define CAPTION(member) offsetof(struct bead_caption, member)
const struct bead_option bead_caption_rows[5] = {
    {"at", BEAD_OPTION_NUMBER, CAPTION(at), BEAD_TIME_OF_MOTION, .required = true,
     .help = "time of the motion at which the caption appears", .example = "0.2 ms"},
    {"text", BEAD_OPTION_TEXT, CAPTION(text), .required = true,
     .help = "the text; *x* is set in italics, _0 or _{max} as subscript, ^2 or ^{3/2} as superscript; between two dollar signs, a "
             "little TeX: letters in italics, \\\\delta, \\\\frac{a}{b}, \\\\sqrt{x}, \\\\ddot{u}, \\\\text{words}, \\\\cdot and "
             "the like; "
             "<b>bold</b>, and so with i, u, s, sub and sup; a backslash takes the next character as it is",
     .example = "The front leaves the striker"},
    {"until", BEAD_OPTION_NUMBER, CAPTION(until), BEAD_TIME_OF_MOTION, .initial = "auto", .word = "auto", .word_value = NAN,
     .help = "time of the motion at which the caption disappears; auto: when the next one appears, and the last one after time "
             "enough to read it",
     .example = "0.6 ms"},
    {"for", BEAD_OPTION_NUMBER, CAPTION(lasting), .unit = "s", .initial = "auto", .low = 0.1, .high = 36000, .word = "auto",
     .word_value = NAN, .help = "how long the caption stays, in seconds of the movie; instead of `until`", .example = "4 s"},
    {"pause", BEAD_OPTION_NUMBER, CAPTION(pause), .unit = "s", .initial = "0 s", .low = 0, .high = 600,
     .help = "how long the motion pauses when the caption appears, in seconds of the movie, which becomes longer by this",
     .example = "2 s"},
};
const struct bead_options bead_caption_options = {"outputs.captions", "a list in order of time; a caption ends the previous one",
                                                  BEAD_OPTIONS(bead_caption_rows), NULL, NULL};

#define SPEED(member) offsetof(struct bead_speed, member)
static const struct bead_option speed_rows[] = {
    {"at", BEAD_OPTION_NUMBER, SPEED(at), BEAD_TIME_OF_MOTION, .required = true, .help = "time of the motion", .example = "1 ms"},
    {"factor", BEAD_OPTION_CUSTOM, SPEED(factor), .required = true, .shape = "a number above 0 such as 1/4000", .like = "number",
     .read = read_factor,
     .help = "time of the motion that passes in as much time of the movie; between two points it changes evenly on a logarithmic "
             "scale, before the first and after the last it stays",
     .example = "1/4000"},
};
const struct bead_options bead_speed_options = {"outputs.speed", "a list in order of time: how fast the motion is shown",
                                                BEAD_OPTIONS(speed_rows), NULL, NULL};

#define CARD(member) offsetof(struct bead_card, member)
static const struct bead_option card_rows[] = {
    {"for", BEAD_OPTION_NUMBER, CARD(lasting), .unit = "s", .initial = "3 s", .low = 0.1, .high = 60,
     .help = "how long the card stays, in seconds of the movie", .example = "5 s"},
    {"text", BEAD_OPTION_TEXT, CARD(text), .initial = "", .help = "a line below the title",
     .example = "A steel bead strikes a row of beads at rest"},
};
const struct bead_options bead_card_options = {"outputs.card", "a title card with title, chains and scale of time",
                                               BEAD_OPTIONS(card_rows), NULL, NULL};

enum bead_error bead_output_check_said(struct bead_reader *reader, const struct bead_at *at, const struct bead_caption *caption)
{
    if (!caption->text[0])
        return BEAD_WRONG_KEY(reader, at, "text", "is empty; a caption needs a text");
    if (!isnan(caption->until) && !isnan(caption->lasting))
        return BEAD_WRONG_KEY(reader, at, "until", "is given beside `for`; give one of them");
    if (caption->until <= caption->at)
        return BEAD_WRONG_KEY(reader, at, "until", "is %g%s; must be later than `at`, %g%s", caption->until,
                              bead_scene_seconds(reader->scene), caption->at, bead_scene_seconds(reader->scene));
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_captions)
{
    struct bead_output *output = settings;
    BEAD_TRY(bead_need_list(reader, at, option->shape, MOST_CAPTIONS, "entries"));
    BEAD_TRY(bead_new(&output->movie.captions, at->node->count, reader->msg, "an output"));
    output->movie.caption_count = at->node->count;
    for (size_t i = 0; i < output->movie.caption_count; i++) {
        struct bead_at element = bead_at_item(at, i);
        if (element.node->kind != BEAD_NODE_MAP)
            return bead_must_be(reader, &element, "a map such as {at: 0.2 ms, text: The front has left the striker}");
        BEAD_TRY(bead_options_read(reader, &element, &bead_caption_options, &output->movie.captions[i]));
        BEAD_TRY(bead_output_check_said(reader, &element, &output->movie.captions[i]));
        if (i > 0 && output->movie.captions[i].at <= output->movie.captions[i - 1].at)
            return BEAD_WRONG_KEY(reader, &element, "at", "is %g%s; must be later than that of the previous caption, %g%s",
                                  output->movie.captions[i].at, bead_scene_seconds(reader->scene), output->movie.captions[i - 1].at,
                                  bead_scene_seconds(reader->scene));
    }
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_speeds)
{
    struct bead_output *output = settings;
    const bool one = at->node->kind == BEAD_NODE_SCALAR; /* a factor, from the beginning to the end */
    struct bead_movie_asked *movie = &output->movie;
    BEAD_TRY(one ? BEAD_OK : bead_need_list(reader, at, option->shape, MOST_SPEEDS, "entries"));
    BEAD_TRY(bead_not_beside(reader, at, "duration"));
    movie->speed_count = one ? 1 : at->node->count;
    BEAD_TRY(bead_new(&movie->speeds, movie->speed_count, reader->msg, "an output"));
    for (size_t i = 0; i < movie->speed_count && !one; i++) {
        struct bead_at element = bead_at_item(at, i);
        struct bead_speed *speed = &movie->speeds[i];
        BEAD_TRY(bead_options_read(reader, &element, &bead_speed_options, speed));
        if (i > 0 && speed->at <= speed[-1].at)
            return BEAD_WRONG_KEY(reader, &element, "at", "is %g%s; must be later than that of the previous point, %g%s", speed->at,
                                  bead_scene_seconds(reader->scene), speed[-1].at, bead_scene_seconds(reader->scene));
    }
    return one ? read_factor(reader, at, option, movie->speeds) : BEAD_OK;
}

/* A word, a time or a map. */
BEAD_OPTION_READER(bead_output_read_card)
{
    struct bead_output *output = settings;
    struct bead_card *card = &output->movie.card;
    const char *word = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    if (at->node->kind == BEAD_NODE_MAP)
        return bead_options_read(reader, at, &bead_card_options, card);
    if (at->node->kind != BEAD_NODE_SCALAR)
        return bead_must_be(reader, at, option->shape);
    card->text = strdup("");
    if (!card->text)
        return bead_no_memory(reader);
    bool yes = strcasecmp(word, "true") == 0 || strcasecmp(word, "yes") == 0;
    if (yes || strcasecmp(word, "false") == 0 || strcasecmp(word, "no") == 0) {
        card->lasting = yes ? card_time : 0;
        return BEAD_OK;
    }
    struct bead_option number = card_rows[0];
    number.shape = "true, false, or a time of the film from 0.1 to 60 s";
    return bead_read_number(reader, at, &number, &card->lasting);
}

BEAD_OUTPUT_CHECK(bead_output_check_captions)
{
    struct bead_at list = bead_at_key(at, "captions");
    double end = fmin(reader->scene->simulate.until, output->shown.time[1]); /* either may be NaN: not known yet */
    if (output->movie.caption_count > 0 && !output->views.axes)
        return bead_wrong(reader, &list, "are given, but `axes: false` leaves no room for them");
    for (size_t i = 0; i < output->movie.caption_count; i++) {
        struct bead_at element = bead_at_item(&list, i);
        if (output->movie.captions[i].at >= end)
            return BEAD_WRONG_KEY(reader, &element, "at", "is %g%s; must be before the end of what is shown, at %g%s",
                                  output->movie.captions[i].at, bead_scene_seconds(reader->scene), end,
                                  bead_scene_seconds(reader->scene));
    }
    return BEAD_OK;
}

void bead_output_free_movie(struct bead_output *output)
{
    for (size_t i = 0; i < output->movie.caption_count; i++)
        free(output->movie.captions[i].text);
    free(output->movie.captions);
    for (size_t i = 0; i < output->movie.note_count; i++)
        free(output->movie.notes[i].said.text);
    free(output->movie.notes);
    free(output->movie.stops);
    free(output->movie.slides);
    free(output->movie.speeds);
    free(output->movie.card.text);
    free(output->movie.sound.sensor);
    free(output->movie.poster);
}
