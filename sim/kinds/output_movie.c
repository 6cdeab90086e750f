/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `movie`: its table of keys, readers and checks. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/text.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

static const char *const qualities[] = {"draft", "standard", "high", "lossless", NULL};
static const char *const codecs[] = {"auto", "av1", NULL};
static const char *const layouts[] = {"auto", "stacked", "columns", "grid", "overlay", "beside", "images", "stage", NULL};
static const char *const profiles[] = {"bead", "cell", NULL};
static const char *const types[] = {"normal", "large", NULL};
static const char *const subtitles[] = {"captions", "words", NULL};
static const char *const insets[] = {"none", "cell", NULL};
static const char *const follows[] = {"all", "front", NULL};

static const struct bead_option motion = {BEAD_TIME_OF_MOTION};

static BEAD_OPTION_READER(read_end)
{
    BEAD_TRY(bead_not_beside(reader, at, "time"));
    return bead_read_number(reader, at, &motion, (double *)(void *)((char *)settings + option->offset));
}

/* A word, followed by a number or a name if it needs one. */
static BEAD_OPTION_READER(read_sound)
{
    struct bead_sound_asked *sound = &((struct bead_output *)settings)->movie.sound;
    static const char contact[] = "contact ", sensor[] = "sensor ";
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "";
    if (strcmp(text, "off") == 0 || strcmp(text, "wall") == 0) {
        sound->of = strcmp(text, "wall") == 0 ? BEAD_SOUND_WALL : BEAD_SOUND_OFF;
        return BEAD_OK;
    }
    if (strncmp(text, contact, strlen(contact)) == 0 && text[strlen(contact)]) {
        struct bead_node number = *at->node;
        const struct bead_at place = {at->up, at->key, at->index, &number};
        number.text += strlen(contact);
        sound->of = BEAD_SOUND_CONTACT;
        return bead_output_read_place(reader, &place, true, &sound->contact);
    }
    if (strncmp(text, sensor, strlen(sensor)) == 0 && text[strlen(sensor)]) {
        sound->of = BEAD_SOUND_SENSOR;
        sound->sensor = strdup(text + strlen(sensor));
        return sound->sensor ? BEAD_OK : bead_no_memory(reader);
    }
    return bead_must_be(reader, at, option->shape);
}

/* The name of a file with the ending in the option's shape, or "" for none. */
static BEAD_OPTION_READER(read_beside)
{
    char **name = (char **)(void *)((char *)settings + option->offset), shown[64];
    BEAD_TRY(bead_read_text(reader, at, name));
    if (strcmp(*name, "none") == 0) {
        (*name)[0] = '\0';
        return BEAD_OK;
    }
    const char *ending = strrchr(option->shape, '.');
    if (!bead_output_ends_like(ending, *name))
        return bead_wrong(reader, at, "is `%s`; must be none or the name of a %s file", bead_text_show(*name, shown, sizeof shown),
                          ending);
    return BEAD_OK;
}

static const struct bead_option movie_rows[] = {
    BEAD_FILE_ROW("movie", "FILE.mp4, .mov, .mkv, .webm, .gif, .png, .apng, .webp or .avif", "waves.mp4"),
    {"size", BEAD_OPTION_CUSTOM, .initial = "[1920, 1080]", .shape = "[width, height] in pixels, 1 to 32768", .like = "[2 number]",
     .read = bead_output_read_frame_size, .help = "size of the frame", .example = "[1280, 720]"},
    {"views", BEAD_OPTION_CUSTOM, .initial = "[stage, profile, spacetime]", .shape = BEAD_VIEWS_LISTED "in a list",
     .like = "[text]", .read = bead_output_read_views,
     .help = "the views, from top to bottom; default for more than four chains, for equations and in other layouts than stage: "
             "[beads, profile, spacetime]",
     .example = "[beads, spacetime]"},
    {"layout", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.layout), .initial = "auto", .choices = layouts,
     .help = "arrangement of the chains. stage: large beads of each, below them one profile for all, in their colours, and small "
             "space-time images, whose future is dimmed; images: large space-time images below each other, side by side or both, "
             "whichever shows most in a frame of this shape; stacked: always below each other; columns: side by side; grid: both "
             "(type becomes smaller where needed, and a layout without room for names is refused); overlay: one axis for the "
             "profiles of all chains; beside: the space-time images to the right of the other views; auto: stage where `views` has "
             "it, which is the default of one to four chains, else images, and overlay where `views` is profile alone"},
    {"type", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.type), .initial = "normal", .choices = types,
     .help = "size of the letters. normal: labels have 3 % of the frame's shorter side; large: 4 %, for the last row of a lecture "
             "hall"},
    {"profile", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.profile), .initial = "bead", .choices = profiles,
     .help =
         "what the view `profile` shows. bead: the field of each bead; cell: its largest value over a cell while a wave passes "
         "one, for fields of one sign in chains of cells, where a pulse swings from bead to bead and is even from cell to cell"},
    {"modes", BEAD_OPTION_COUNT, BEAD_OF_OUTPUT(movie.modes), .initial = "5", .low = 1, .high = BEAD_MODES,
     .help = "how many modes the view `modes` shows", .example = "4"},
    {"fps", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(movie.fps), .initial = "60", .low = 1, .high = 240,
     .help = "frames per second; a GIF has at most 50, since its delays are whole hundredths of a second and players want at least "
             "two: of more, it has every second frame, or every third, and so on",
     .example = "30"},
    {"duration", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(movie.duration), .unit = "s", .initial = "auto", .low = 0.01, .high = 36000,
     .word = "auto", .word_value = NAN,
     .help = "how long the movie shows the motion; a title card adds to it. auto: 10 s; with a stage so long that a wave passes "
             "about eight beads a second, at most 30 s",
     .example = "15 s"},
    {"strobe", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(movie.strobe), BEAD_TIME_OF_MOTION, .initial = "none", .word = "none",
     .word_value = 0,
     .help = "show the motion only at multiples of this time, the period of something fast, and blend between them, so that slow "
             "motion is seen and nothing flickers",
     .example = "64"},
    {"speed", BEAD_OPTION_CUSTOM,
     .shape = "a factor such as 1/4000, or a list such as [{at: 0 ms, factor: 1/4000}, {at: 1 ms, factor: 1/500}]",
     .like = "number|text|[outputs.speed]", .read = bead_output_read_speeds,
     .help = "how fast time passes, instead of `duration`: see outputs.speed",
     .example = "[{at: 0 ms, factor: 1/4000}, {at: 1 ms, factor: 1/500}]"},
    {"captions", BEAD_OPTION_CUSTOM, .shape = "a list such as [{at: 0.2 ms, text: The front has left the striker}]",
     .like = "[outputs.captions]", .read = bead_output_read_captions,
     .help = "texts below the picture, in mp4, mov, mkv and webm also chapters and subtitles: see outputs.captions",
     .example = "[{at: 0.2 ms, text: The front has left the striker}]"},
    {"subtitles", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.subtitles), .initial = "captions", .choices = subtitles,
     .help = "in mp4, mov, mkv and webm. captions: their texts; words: if there are none, a sentence for each chain that says from "
             "its numbers what happens, for those who cannot see"},
    {"notes", BEAD_OPTION_CUSTOM, .shape = "a list such as [{at: 0.4 ms, bead: front, text: The front}]", .like = "[outputs.notes]",
     .read = bead_output_read_notes,
     .help =
         "texts on the stage, each of which points to a bead, a contact, the front or the wall, and follows it: see outputs.notes",
     .example = "[{at: 0.4 ms, for: 2 s, bead: front, text: \"Five beads, $F \\\\sim \\\\delta^{3/2}$\"}]"},
    {"race", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(movie.race), .initial = "false",
     .help = "with two chains on a stage: say at the leading front by how many beads it leads, until it arrives"},
    {"inset", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.inset), .initial = "none", .choices = insets,
     .help = "a picture in the picture, beside the curve below a stage. cell: the cells of the chains, as `show: cell` draws them"},
    {"stops", BEAD_OPTION_CUSTOM, .shape = "a list of times such as [0.4 ms, 1.2 ms]", .like = "[number]",
     .read = bead_output_read_stops,
     .help = "times at which a talk halts: chapters of the file, beside those of captions, and where `slides` wait",
     .example = "[0.4 ms, 1.2 ms]"},
    {"slides", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(movie.slides), .initial = "none", .shape = "none or FILE.html", .like = "text",
     .read = read_beside,
     .help = "the film, mp4 or webm, in one page for a browser, which needs no network: it plays from stop to stop when a key is "
             "pressed. Not with `poster`",
     .example = "talk.html"},
    {"card", BEAD_OPTION_CUSTOM, .initial = "false", .shape = "true, false, a time such as 3 s, or a map",
     .like = "flag|number|outputs.card", .read = bead_output_read_card,
     .help = "title card before the motion; true: for 3 s. See outputs.card", .example = "true"},
    {"sound", BEAD_OPTION_CUSTOM, .initial = "off", .shape = "off, wall, contact NUMBER, contact last or sensor NAME",
     .like = "text", .read = read_sound,
     .help = "what is heard, slowed like the picture: the force on the wall, of a contact (0 is that of the striker) or on the "
             "bead with a sensor; silent in title cards and pauses, with its peak just below full level, several chains from left "
             "to right. AAC in mp4 and mov, Opus in webm and mkv. A pulse that takes a tenth of a second is felt rather than "
             "heard: `speed` with factors of 1/100 to 1/10 makes tones of contacts' vibrations",
     .example = "wall"},
    {"follow", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.follow), .initial = "all", .choices = follows,
     .help = "what beads and profile show: all beads, or a window that moves with the front of each chain; spacetime marks the "
             "window. Give long chains long movies: the eye cannot follow more than half a bead per frame"},
    {"window", BEAD_OPTION_COUNT, BEAD_OF_OUTPUT(movie.window), .initial = "40", .low = 4, .high = 1000,
     .help = "most beads that `follow: front` shows", .example = "30"},
    {"poster", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(movie.poster), .initial = "none", .shape = "none or FILE.png", .like = "text",
     .read = read_beside, .help = "one frame as a picture; in mp4 files also the cover", .example = "poster.png"},
    {"poster-at", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(movie.poster_at), BEAD_TIME_OF_MOTION, .initial = "auto", .word = "auto",
     .word_value = NAN,
     .help =
         "time of the motion that the poster shows; auto: when the chains differ most, or with one chain when there is most to see",
     .example = "0.8 ms"},
    {"quality", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.quality), .initial = "standard", .choices = qualities,
     .help = "quality of the encoding; a draft has at most 30 pictures per second, each shown for several frames, and for longer "
             "if it does not change: a variable rate, while all others have a constant one; high and lossless average nine values "
             "in each pixel of a stage, as `--frame` and stills do"},
    {"codec", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(movie.codec), .initial = "auto", .choices = codecs,
     .help =
         "auto: the file's usual one; av1: in mp4, mkv and webm half the size or less, encoded more slowly, with SVT-AV1 (libaom "
         "where FFmpeg has no other)"},
};
/* After `time`, of which they are parts. */
static const struct bead_option span_rows[] = {
    {"from", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(shown.time[0]), .shape = "a time of the motion such as 0.2 ms", .like = "number",
     .read = read_end, .help = "when the movie begins; default: with the run", .example = "0.2 ms"},
    {"until", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(shown.time[1]), .shape = "a time of the motion such as 1.5 ms", .like = "number",
     .read = read_end, .help = "when it ends; default: with the run. `time: [0.2 ms, 1.5 ms]` says both", .example = "1.5 ms"},
};
static const struct bead_option_rows movie_shared[] = {
    {BEAD_OPTIONS(bead_field_row)},    {BEAD_OPTIONS(bead_time_row)},        {BEAD_OPTIONS(span_rows)},
    {BEAD_OPTIONS(bead_beads_row)},    {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
    {BEAD_OPTIONS(bead_magnify_row)},  {BEAD_OPTIONS(bead_trust_row)},       {BEAD_OPTIONS(bead_theory_row)},
    {BEAD_OPTIONS(bead_theme_rows)},   {BEAD_OPTIONS(bead_axes_row)},        {BEAD_OPTIONS(bead_orientation_row)},
    {BEAD_OPTIONS(bead_colormap_row)}, {BEAD_OPTIONS(bead_light_row)},       {NULL, 0}};
static const struct bead_options movie_options = {"movie", "a movie; .png is an animated PNG", BEAD_OPTIONS(movie_rows),
                                                  movie_shared, &bead_output_family};

/* Profiles on one axis show all beads of chains that have such an axis. */
static BEAD_OUTPUT_CHECK(check_layout)
{
    bool profile = bead_views_any(&output->views, BEAD_OVERLAYS);
    if (output->movie.layout == BEAD_LAYOUT_STAGE && !bead_views_any(&output->views, BEAD_ACTS))
        return BEAD_WRONG_KEY(reader, at, "layout", "is stage, but `views` has none");
    bool image = bead_views_any(&output->views, BEAD_SHOWS_IMAGE);
    if (output->movie.layout == BEAD_LAYOUT_OVERLAY && !profile)
        return BEAD_WRONG_KEY(reader, at, "layout", "is overlay, but `views` has no profile");
    if (output->movie.layout == BEAD_LAYOUT_OVERLAY && output->movie.follow == BEAD_FOLLOW_FRONT)
        return BEAD_WRONG_KEY(reader, at, "layout", "is overlay, but with `follow: front` each profile has a window of its own");
    if (output->movie.layout == BEAD_LAYOUT_BESIDE && (!image || output->views.count < 2))
        return BEAD_WRONG_KEY(reader, at, "layout", "is beside, but `views` does not list spacetime and another view");
    return BEAD_OK;
}

static BEAD_OUTPUT_CHECK(check_movie)
{
    bool moves = bead_views_any(&output->views, BEAD_FOLLOWS_FRONT);
    if (!bead_scene_system(reader->scene)->has_striker && output->movie.follow == BEAD_FOLLOW_FRONT)
        return BEAD_WRONG_KEY(reader, at, "follow", "is set, but there is no front to follow: only beads at rest have one");
    if (output->movie.follow != BEAD_FOLLOW_FRONT && bead_given(at, "window"))
        return BEAD_WRONG_KEY(reader, at, "window", "belongs to `follow: front`");
    if (output->movie.follow == BEAD_FOLLOW_FRONT && !moves)
        return BEAD_WRONG_KEY(reader, at, "follow", "is front, but no view moves with it: add beads or profile to `views`");
    if (!bead_scene_system(reader->scene)->has_contacts && output->movie.sound.of != BEAD_SOUND_OFF)
        return BEAD_WRONG_KEY(reader, at, "sound", "is set, but only contacts of beads have forces to hear");
    if (!isnan(output->movie.poster_at) && !output->movie.poster[0])
        return BEAD_WRONG_KEY(reader, at, "poster-at", "is given, but no `poster`");
    if (output->movie.poster_at > fmin(reader->scene->simulate.until, output->shown.time[1]) ||
        output->movie.poster_at < output->shown.time[0])
        return BEAD_WRONG_KEY(reader, at, "poster-at", "is %g%s; must be a time that the movie shows", output->movie.poster_at,
                              bead_scene_seconds(reader->scene));
    return BEAD_OK;
}

const struct bead_output_type bead_movie_output = {
    .options = &movie_options,
    .checks = {bead_output_check_field, bead_output_check_views, bead_output_check_times, bead_output_check_trust,
               bead_output_check_theory, check_movie, check_layout, bead_output_check_captions, bead_output_check_notes},
    .draws = true};
