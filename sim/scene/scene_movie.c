/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of movies that explain what is to be seen: captions, title card, poster, camera. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/scene/scene_output.h"

enum { MOST_CAPTIONS = 200, MOST_SPEEDS = 100, MOST_BEADS = 200000000 /* more than there may be */ };
static const double card_time = 3; /* s, of `card: true` */

/* "1/4000" or a number. */
static BEAD_OUTPUT_READER(read_factor)
{
    struct bead_speed *speed = settings;
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    char shown[64], *end;
    double over = strtod(text, &end), under = 1;
    bool good = end > text;
    if (good && *end == '/') {
        const char *rest = end + 1;
        under = strtod(rest, &end);
        good = end > rest;
    }
    speed->factor = over / under;
    if (!good || *end || !(speed->factor >= 1e-12 && speed->factor <= 1e12))
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    return BEAD_OK;
}

#define CAPTION(member) offsetof(struct bead_caption, member)
static const struct bead_option caption_rows[] = {
    {.key = "at",
     .offset = CAPTION(at),
     .unit = "s",
     .of_motion = true,
     .required = true,
     .low = 0,
     .high = 1e6,
     .help = "time of the motion at which the caption appears",
     .example = "0.2 ms"},
    {.key = "text",
     .type = BEAD_OPTION_TEXT,
     .offset = CAPTION(text),
     .required = true,
     .help = "the text; *x* is set in italics, _0 or _{max} as subscript, ^2 or ^{3/2} as superscript; a backslash takes the next "
             "character as it is",
     .example = "The front leaves the striker"},
    {.key = "until",
     .offset = CAPTION(until),
     .unit = "s",
     .of_motion = true,
     .initial = "auto",
     .low = 0,
     .high = 1e6,
     .word = "auto",
     .word_value = NAN,
     .help = "time of the motion at which the caption disappears; auto: when the next one appears, and the last one after time "
             "enough to read it",
     .example = "0.6 ms"},
    {.key = "for",
     .offset = CAPTION(lasting),
     .unit = "s",
     .initial = "auto",
     .low = 0.1,
     .high = 36000,
     .word = "auto",
     .word_value = NAN,
     .help = "how long the caption stays, in seconds of the movie; instead of `until`",
     .example = "4 s"},
    {.key = "pause",
     .offset = CAPTION(pause),
     .unit = "s",
     .initial = "0 s",
     .low = 0,
     .high = 600,
     .help = "how long the motion stands when the caption appears, in seconds of the movie, which becomes longer by them",
     .example = "2 s"},
};
const struct bead_options bead_caption_options = {"outputs.captions", "a list in order of time; a caption ends the previous one",
                                                  BEAD_OPTIONS(caption_rows), NULL, NULL};

#define SPEED(member) offsetof(struct bead_speed, member)
static const struct bead_option speed_rows[] = {
    {.key = "at",
     .offset = SPEED(at),
     .unit = "s",
     .of_motion = true,
     .required = true,
     .low = 0,
     .high = 1e6,
     .help = "time of the motion",
     .example = "1 ms"},
    {.key = "factor",
     .type = BEAD_OPTION_CUSTOM,
     .offset = SPEED(factor),
     .required = true,
     .shape = "a number above 0 such as 1/4000",
     .help = "time of the motion that passes in as much time of the movie; between two points it changes evenly on a logarithmic "
             "scale, before the first and after the last it stays",
     .example = "1/4000",
     .like = "number",
     .read = read_factor},
};
const struct bead_options bead_speed_options = {"outputs.speed", "a list in order of time: how fast the motion is shown",
                                                BEAD_OPTIONS(speed_rows), NULL, NULL};

#define CARD(member) offsetof(struct bead_card, member)
static const struct bead_option card_rows[] = {
    {.key = "for",
     .offset = CARD(lasting),
     .unit = "s",
     .initial = "3 s",
     .low = 0.1,
     .high = 60,
     .help = "how long the card stays, in seconds of the movie",
     .example = "5 s"},
    {.key = "text",
     .type = BEAD_OPTION_TEXT,
     .offset = CARD(text),
     .initial = "",
     .help = "a line below the title",
     .example = "A steel bead strikes a row of beads at rest"},
};
const struct bead_options bead_card_options = {"outputs.card", "a title card with title, chains and scale of time",
                                               BEAD_OPTIONS(card_rows), NULL, NULL};

/* Behind times of the motion in messages. */
static const char *unit_of(const struct bead_reader *reader)
{
    return bead_scene_plain(reader->scene) ? "" : " s";
}

static enum bead_error read_caption(struct bead_reader *reader, const struct bead_at *at, struct bead_caption *caption)
{
    enum bead_error err = bead_options_read(reader, at, &bead_caption_options, caption);
    struct bead_at where = bead_at_key(at, "text");
    if (!err && !caption->text[0])
        return bead_wrong(reader, &where, "is empty; a caption needs a text");
    where = bead_at_key(at, "until");
    if (!err && !isnan(caption->until) && !isnan(caption->lasting))
        return bead_wrong(reader, &where, "is given beside `for`; give one of them");
    if (!err && caption->until <= caption->at)
        return bead_wrong(reader, &where, "is %g%s; must be later than `at`, %g%s", caption->until, unit_of(reader), caption->at,
                          unit_of(reader));
    return err;
}

BEAD_OUTPUT_READER(bead_output_read_captions)
{
    struct bead_output *output = settings;
    char shown[64];
    size_t count = at->node->count;
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    if (count == 0 || count > MOST_CAPTIONS)
        return bead_wrong(reader, at, "has %zu entries; must have from 1 to %d", count, MOST_CAPTIONS);
    output->movie.captions = calloc(count, sizeof *output->movie.captions);
    if (!output->movie.captions)
        return bead_no_memory(reader);
    output->movie.caption_count = count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < count; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        if (element.node->kind != BEAD_NODE_MAP)
            return bead_wrong(reader, &element, "is %s; must be a map such as {at: 0.2 ms, text: The front has left the striker}",
                              bead_node_show(element.node, shown, sizeof shown));
        err = read_caption(reader, &element, &output->movie.captions[i]);
        struct bead_at where = bead_at_key(&element, "at");
        output->movie.captions[i].place = where.node->place;
        if (!err && i > 0 && output->movie.captions[i].at <= output->movie.captions[i - 1].at)
            err = bead_wrong(reader, &where, "is %g%s; must be later than that of the previous caption, %g%s",
                             output->movie.captions[i].at, unit_of(reader), output->movie.captions[i - 1].at, unit_of(reader));
    }
    return err;
}

BEAD_OUTPUT_READER(bead_output_read_speeds)
{
    struct bead_output *output = settings;
    char shown[64];
    size_t count = at->node->count;
    struct bead_at other = bead_at_key(at->up, "duration");
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    if (count == 0 || count > MOST_SPEEDS)
        return bead_wrong(reader, at, "has %zu entries; must have from 1 to %d", count, MOST_SPEEDS);
    if (other.node != at->up->node)
        return bead_wrong(reader, at, "is given beside `duration`; give one of them");
    output->movie.speeds = calloc(count, sizeof *output->movie.speeds);
    if (!output->movie.speeds)
        return bead_no_memory(reader);
    output->movie.speed_count = count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < count; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]}, where = bead_at_key(&element, "at");
        struct bead_speed *speed = &output->movie.speeds[i];
        err = bead_options_read(reader, &element, &bead_speed_options, speed);
        if (!err && i > 0 && speed->at <= speed[-1].at)
            err = bead_wrong(reader, &where, "is %g%s; must be later than that of the previous point, %g%s", speed->at,
                             unit_of(reader), speed[-1].at, unit_of(reader));
    }
    return err;
}

static enum bead_error read_end(struct bead_reader *reader, const struct bead_at *at, double *end)
{
    static const struct bead_option time = {.unit = "s", .of_motion = true, .low = 0, .high = 1e6};
    struct bead_at other = bead_at_key(at->up, "time");
    if (other.node != at->up->node)
        return bead_wrong(reader, at, "is given beside `time`; give one of them");
    return bead_read_number(reader, at, &time, end);
}

BEAD_OUTPUT_READER(bead_output_read_from)
{
    (void)option;
    return read_end(reader, at, &((struct bead_output *)settings)->shown.time[0]);
}

BEAD_OUTPUT_READER(bead_output_read_until)
{
    (void)option;
    return read_end(reader, at, &((struct bead_output *)settings)->shown.time[1]);
}

/* A word, a time or a map. */
BEAD_OUTPUT_READER(bead_output_read_card)
{
    struct bead_output *output = settings;
    struct bead_card *card = &output->movie.card;
    char shown[64];
    const char *word = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    if (at->node->kind == BEAD_NODE_MAP)
        return bead_options_read(reader, at, &bead_card_options, card);
    if (at->node->kind != BEAD_NODE_SCALAR)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
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

/* A word, and for some of them what it is of. */
BEAD_OUTPUT_READER(bead_output_read_sound)
{
    struct bead_sound_asked *sound = &((struct bead_output *)settings)->movie.sound;
    static const char contact[] = "contact ", sensor[] = "sensor ";
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    char shown[64], *end = NULL;
    if (strcmp(text, "off") == 0 || strcmp(text, "wall") == 0) {
        sound->of = strcmp(text, "wall") == 0 ? BEAD_SOUND_WALL : BEAD_SOUND_OFF;
        return BEAD_OK;
    }
    if (strncmp(text, contact, strlen(contact)) == 0 && isdigit((unsigned char)text[strlen(contact)])) {
        unsigned long long number = strtoull(text + strlen(contact), &end, 10);
        sound->of = BEAD_SOUND_CONTACT;
        sound->contact = number < MOST_BEADS ? (size_t)number : MOST_BEADS;
        if (!*end)
            return BEAD_OK;
    }
    if (strncmp(text, sensor, strlen(sensor)) == 0 && text[strlen(sensor)]) {
        sound->of = BEAD_SOUND_SENSOR;
        sound->sensor = strdup(text + strlen(sensor));
        return sound->sensor ? BEAD_OK : bead_no_memory(reader);
    }
    return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
}

BEAD_OUTPUT_READER(bead_output_read_poster)
{
    struct bead_output *output = settings;
    char shown[64];
    (void)option;
    enum bead_error err = bead_read_text(reader, at, &output->movie.poster);
    if (err)
        return err;
    if (strcmp(output->movie.poster, "none") == 0) {
        output->movie.poster[0] = '\0';
        return BEAD_OK;
    }
    const char *slash = strrchr(output->movie.poster, '/'), *base = slash ? slash + 1 : output->movie.poster,
               *dot = strrchr(base, '.');
    if (!dot || dot == base || strcasecmp(dot, ".png") != 0)
        return bead_wrong(reader, at, "is `%s`; must be none or the name of a .png file",
                          bead_text_show(output->movie.poster, shown, sizeof shown));
    return BEAD_OK;
}

static BEAD_OUTPUT_CHECK(check_captions)
{
    struct bead_at list = bead_at_key(at, "captions");
    double end = fmin(reader->scene->simulate.until, output->shown.time[1]); /* either may be NaN: not known yet */
    if (output->movie.caption_count > 0 && !output->views.axes)
        return bead_wrong(reader, &list, "are given, but `axes: false` leaves no room for them");
    for (size_t i = 0; i < output->movie.caption_count; i++) {
        struct bead_at element = {&list, NULL, i, list.node->items[i]}, where = bead_at_key(&element, "at");
        if (output->movie.captions[i].at >= end)
            return bead_wrong(reader, &where, "is %g%s; must be before the end of what is shown, at %g%s",
                              output->movie.captions[i].at, unit_of(reader), end, unit_of(reader));
    }
    return BEAD_OK;
}

/* Profiles on one axis show all beads of chains that have such an axis. */
static BEAD_OUTPUT_CHECK(check_layout)
{
    struct bead_at where = bead_at_key(at, "layout");
    bool profile = bead_views_any(output->views.kinds, output->views.count, BEAD_OVERLAYS);
    bool image = bead_views_any(output->views.kinds, output->views.count, BEAD_SHOWS_IMAGE);
    if (output->movie.layout == BEAD_LAYOUT_OVERLAY && !profile)
        return bead_wrong(reader, &where, "is overlay, but `views` has no profile");
    if (output->movie.layout == BEAD_LAYOUT_OVERLAY && output->movie.follow == BEAD_FOLLOW_FRONT)
        return bead_wrong(reader, &where, "is overlay, but with `follow: front` each profile has a window of its own");
    if (output->movie.layout == BEAD_LAYOUT_BESIDE && (!image || output->views.count < 2))
        return bead_wrong(reader, &where, "is beside, but `views` has not spacetime and another view");
    return BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_movie)
{
    struct bead_at where = bead_at_key(at, "follow");
    bool moves = bead_views_any(output->views.kinds, output->views.count, BEAD_FOLLOWS_FRONT);
    if (bead_scene_plain(reader->scene) && output->movie.follow == BEAD_FOLLOW_FRONT)
        return bead_wrong(reader, &where, "is set, but there is no front to follow: only beads at rest have one");
    where = bead_at_key(at, "window");
    if (output->movie.follow != BEAD_FOLLOW_FRONT && where.node != at->node)
        return bead_wrong(reader, &where, "belongs to `follow: front`");
    where = bead_at_key(at, "follow");
    if (output->movie.follow == BEAD_FOLLOW_FRONT && !moves)
        return bead_wrong(reader, &where, "is front, but no view moves with it: add beads or profile to `views`");
    where = bead_at_key(at, "sound");
    if (bead_scene_plain(reader->scene) && output->movie.sound.of != BEAD_SOUND_OFF)
        return bead_wrong(reader, &where, "is set, but only contacts of beads have forces to hear");
    where = bead_at_key(at, "poster-at");
    if (!isnan(output->movie.poster_at) && !output->movie.poster[0])
        return bead_wrong(reader, &where, "is given, but no `poster`");
    if (output->movie.poster_at > fmin(reader->scene->simulate.until, output->shown.time[1]) ||
        output->movie.poster_at < output->shown.time[0])
        return bead_wrong(reader, &where, "is %g%s; must be a time that the movie shows", output->movie.poster_at, unit_of(reader));
    enum bead_error err = check_layout(reader, at, output);
    if (err)
        return err;
    return check_captions(reader, at, output);
}

void bead_output_free_movie(struct bead_output *output)
{
    for (size_t i = 0; i < output->movie.caption_count; i++)
        free(output->movie.captions[i].text);
    free(output->movie.captions);
    free(output->movie.speeds);
    free(output->movie.card.text);
    free(output->movie.sound.sensor);
    free(output->movie.poster);
}
