/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one output that the command line names, by -o FILE, --frame, --sheet or --configuration: finds that output of the scene or
 * makes a new one, and applies the options to it. */
#include <ctype.h>
#include <stdlib.h>
#include <strings.h>
#include <sys/stat.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/kinds/scene_facts.h"
#include "sim/scene/scene_internal.h"
#include "sim/session/session_data.h"
#include "sim/trajectory/trajectory_data.h"

/* Changes of a scene that precede the job's options and settings; begins as zeros. */
struct changes {
    struct bead_override all[6];
    size_t count;
    char place[24];               /* shown by a new output */
    struct bead_node file;        /* of a new output */
    const struct bead_output *of; /* the scene's output that is kept; NULL: a new one, or a film's frame */
};

static const char *extension(const char *path)
{
    const char *dot = strrchr(bead_session_base_name(path), '.');
    return dot ? dot + 1 : "";
}

/* Does the name end like a file's, with two to eight letters and digits, not all digits? Numbers and `.d` belong to directories. */
static bool ends_like_file(const char *name)
{
    const char *ending = extension(name);
    size_t length = 0, digits = 0;
    for (; isalnum((unsigned char)ending[length]); length++)
        digits += isdigit((unsigned char)ending[length]) != 0;
    return strrchr(name, '.') != name && !ending[length] && length >= 2 && length <= 8 && digits < length;
}

bool bead_session_names_file(const char *output, const struct bead_own *own)
{
    struct stat found;
    if (!output || (stat(output, &found) == 0 && S_ISDIR(found.st_mode)))
        return false;
    return bead_output_own_of(own, output) != NULL || ends_like_file(bead_session_base_name(output));
}

/* ---- which it is ---- */

/* Has the kind, or one of its panels, all the keys that the job's options set? */
static bool takes_looks(const struct bead_job *job, const struct bead_output *output, bool sweep)
{
    const struct bead_output_type *type = bead_output_type(output->kind);
    bool all = true;
    for (size_t i = 0; i < job->look_count && all; i++) {
        char key[32];
        snprintf(key, sizeof key, "%.*s", (int)strcspn(job->looks[i] + 2, "="), job->looks[i] + 2);
        all = bead_options_find(sweep ? type->sweep_options : type->options, key) ||
              (output->still.panel_count > 0 && bead_options_find(&bead_image_panel_options, key));
    }
    return all;
}

/* Can the file be made from the output's, which ends differently? Yes if their kinds have the same endings: a film from a film,
 * pixels from any still, but a page for print only from another one. */
static bool converts(const struct bead_output *output, const char *file, enum bead_source_kind source)
{
    const enum bead_output_kind kind = bead_output_kind_of(file, source);
    return kind < BEAD_OUTPUT_KINDS && strcmp(bead_output_endings(kind), bead_output_endings(output->kind)) == 0 &&
           (kind == BEAD_OUTPUT_MOVIE || bead_output_ends_like(BEAD_PIXEL_ENDINGS, file) ||
            !bead_output_ends_like(BEAD_PIXEL_ENDINGS, output->path));
}

/* How well an output of the scene fits the file: 4 by its name, 0 not at all. Among outputs with the keys asked for, the same
 * ending precedes the same kind, and the first of each wins; if keys are asked for, the kind that the ending alone means: images
 * rather than plots. */
static int rank(const struct bead_output *output, const struct bead_job *job, enum bead_source_kind source, bool sweep)
{
    if (!bead_output_made_of(output->kind, source))
        return 0;
    if (strcmp(bead_session_base_name(output->path), bead_session_base_name(job->output)) == 0)
        return 4;
    const bool same = strcasecmp(extension(output->path), extension(job->output)) == 0;
    const struct bead_show_type *show = bead_output_show(output);
    const bool stored = source == BEAD_OF_TRAJECTORY || source == BEAD_OF_TRAJECTORIES || source == BEAD_OF_DIFFERENCE;
    if (!bead_output_ending_means(output->kind, source) || !takes_looks(job, output, sweep) || (stored && show && show->of_run))
        return 0;
    if (!same)
        return converts(output, job->output, source);
    return 2 + (job->look_count > 0 && output->kind == bead_output_kind_of(job->output, source));
}

/* The scene's output that the file name means; NULL: none. */
static const struct bead_output *find(const struct bead_scene *scene, const struct bead_job *job, enum bead_source_kind source)
{
    const struct bead_output *best = NULL;
    int most = 0;
    for (size_t i = 0; i < scene->output_count; i++) {
        const int found = rank(&scene->outputs[i], job, source, scene->sweep_count > 0);
        best = found > most ? &scene->outputs[i] : best;
        most = found > most ? found : most;
    }
    return best;
}

static enum bead_error no_kind(const char *file, enum bead_source_kind source, struct bead_message *msg)
{
    char names[160] = "", name[16], *rest;
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        const char *ending = bead_output_made_of(kind, source) ? bead_output_endings(kind) : NULL;
        for (; ending; ending = strchr(ending + 1, '.')) { /* ".png, .pdf or .svg": each once */
            snprintf(name, sizeof name, "%.*s", (int)strcspn(ending, ", "), ending);
            rest = strstr(names, name);
            if (!rest || strchr(", ", rest[strlen(name)]) == NULL)
                bead_list_add(names, sizeof names, ", ", name);
        }
    }
    struct stat status;
    if (stat(file, &status) == 0 && S_ISDIR(status.st_mode))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--output: `%s` is a directory; name the file to make in it, with one of %s", file,
                         names);
    const bool of_one = source == BEAD_OF_SWEEP && bead_output_kind_of(file, BEAD_OF_CONFIGURATION) != BEAD_OUTPUT_KINDS;
    return bead_fail(msg, BEAD_ERROR_USAGE, "--output: `%s` must end like one of %s%s; `%s/` would be a directory", file, names,
                     of_one ? "; --configuration N makes it of chain N of the sweep" : "", file);
}

static void add(struct changes *changes, struct bead_override change)
{
    change.origin = "--output";
    change.place = (struct bead_place){1, 1};
    changes->all[changes->count++] = change;
}

/* Do forces follow from the stored displacements? The scene's chains have not been made yet. */
static bool forces_follow(const struct bead_scene *scene)
{
    bool follow = true;
    for (size_t c = 0; c < scene->chain_count; c++)
        follow = follow && !(scene->chains[c].damping_coefficient > 0);
    return follow;
}

/* The field that a new output shows of stored runs that do not all have the usual one: the first that they have; NULL: the usual
 * one. */
static const char *held_field(const struct bead_session *s, const struct bead_output_type *type)
{
    const struct bead_trajectory *t;
    unsigned held = BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1;
    for (size_t i = 0; s->trajectory && (t = bead_session_file(s, i)); i++) {
        const bool follow = bead_trajectory_fields(t) & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) && forces_follow(t->scene);
        held &= bead_trajectory_fields(t) | (follow ? BEAD_FIELD_BIT(BEAD_FIELD_FORCE) : 0);
        held = bead_scene_system(t->scene)->has_contacts ? held : 0;
    }
    enum bead_field first = 0;
    if (!held || held & BEAD_FIELD_BIT(BEAD_FIELD_FORCE) || !bead_options_find(type->options, "field"))
        return NULL;
    while (!(held & BEAD_FIELD_BIT(first)))
        first++;
    return bead_field_info(first)->name;
}

/* Does an option or a setting choose the places that a plot shows, or their quantity? */
static bool says_places(const struct bead_job *job)
{
    static const char *const keys[] = {"beads", "contacts", "show", "outputs", "0", NULL}; /* the last two: a whole output */
    bool says = false;
    for (size_t i = 0; i < job->look_count + job->setting_count; i++) {
        char key[64];
        const char *text = i < job->look_count ? job->looks[i] + 2 : job->settings[i - job->look_count];
        snprintf(key, sizeof key, "%.*s", (int)strcspn(text, "="), text);
        const char *dot = strrchr(key, '.');
        says = says || bead_is_one_of(dot ? dot + 1 : key, keys);
    }
    return says;
}

/* For stored runs without sensors: the bead in the middle of the shortest chain, among those that all files hold. */
static size_t middle(const struct bead_session *s)
{
    const struct bead_trajectory *t;
    size_t first = 0, last = SIZE_MAX;
    for (size_t i = 0; (t = bead_session_file(s, i)); i++) {
        first = t->span.first > first ? t->span.first : first;
        last = t->span.last < last ? t->span.last : last;
        for (size_t c = 0; c < t->scene->chain_count; c++) {
            const size_t end = bead_scene_last_bead(t->scene, c);
            last = end < last ? end : last;
        }
    }
    return last > first ? first + (last - first) / 2 : first;
}

/* The places of a new output's curves, as `key`; false: sensors, or places given on the command line. */
static bool choose_places(struct bead_session *s, const char *field, char place[24], const char **key)
{
    const struct bead_trajectory *t;
    for (size_t i = 0; (t = bead_session_file(s, i)); i++) {
        if (bead_scene_has_sensors(t->scene, SIZE_MAX))
            return false;
    }
    if (says_places(&s->job))
        return false;
    *key = field && strcmp(field, bead_field_info(BEAD_FIELD_CONTACT_FORCE)->name) == 0 ? "contacts" : "beads";
    snprintf(place, 24, "[%zu]", middle(s));
    snprintf(s->warning[SESSION_CHOSEN], sizeof s->warning[SESSION_CHOSEN],
             "no bead has a sensor: this shows %.*s %zu, in the middle; --set outputs.0.%s='[1, 2]' shows others",
             (int)strlen(*key) - 1, *key, middle(s), *key);
    return true;
}

/* Leave only a new output: the file, of the first kind with its ending. */
static enum bead_error name_output(struct bead_session *s, struct changes *changes, enum bead_source_kind source,
                                   struct bead_message *msg)
{
    const char *file = s->job.output;
    const enum bead_output_kind kind = bead_output_kind_of(file, source);
    const struct bead_sink_type *sink = kind == BEAD_OUTPUT_OWN ? bead_output_own_of(s->job.own, file) : NULL;
    if (kind == BEAD_OUTPUT_KINDS && !sink)
        return no_kind(file, source, msg);
    const char *show = bead_output_type(kind)->shown_of[source], *field = held_field(s, bead_output_type(kind)), *places;
    const bool of_places = kind == BEAD_OUTPUT_PLOT || (show && strcmp(show, "sensors") == 0);
    changes->file =
        (struct bead_node){.kind = BEAD_NODE_SCALAR, .origin = "--output", .place = {1, 1}, .text = bead_session_base_name(file)};
    add(changes, (struct bead_override){.path = "outputs", .value = "[]"});
    add(changes,
        (struct bead_override){.below = "outputs.+", .path = sink ? sink->name : bead_output_key(kind), .node = &changes->file});
    if (show)
        add(changes, (struct bead_override){.below = "outputs.0", .path = "show", .value = show});
    if (field)
        add(changes, (struct bead_override){.below = "outputs.0", .path = "field", .value = field});
    if (s->trajectory && of_places && choose_places(s, field, changes->place, &places))
        add(changes, (struct bead_override){.below = "outputs.0", .path = places, .value = changes->place});
    return BEAD_OK;
}

/* Leave only this output. */
static void keep_output(struct changes *changes, const struct bead_output *output)
{
    changes->of = output;
    add(changes, (struct bead_override){.path = "outputs", .value = "[]"});
    add(changes, (struct bead_override){.below = "outputs", .path = "+", .node = output->node});
}

/* ---- what changes the scene ---- */

struct panel {
    const struct bead_options *options;
    char below[64]; /* "outputs.0.panels.1.0" */
};

static void find_panels(const struct bead_output *output, const char *below, struct panel *panels)
{
    size_t column = 0;
    for (size_t p = 0; p < output->still.panel_count; p++) {
        const struct bead_output *panel = &output->still.panels[p];
        column = p > 0 && panel->panel.row == panel[-1].panel.row ? column + 1 : 0;
        panels[p].options = panel->kind == BEAD_OUTPUT_PLOT ? &bead_plot_panel_options : &bead_image_panel_options;
        snprintf(panels[p].below, sizeof panels[p].below, "%s.panels.%zu.%zu", below, panel->panel.row, column);
    }
}

/* Add an option: to each panel that is an image with this key, else to the output. */
static void add_look(const char *look, const char *below, const struct panel *panels, size_t panel_count, struct bead_override *all,
                     size_t *count)
{
    const struct bead_override laid = {
        .origin = look, .path = look + 2, .below = below, .place = {1, 1}, .value = look + strcspn(look, "=") + 1};
    const size_t before = *count;
    char key[32];
    snprintf(key, sizeof key, "%.*s", (int)strcspn(laid.path, "="), laid.path);
    const struct bead_option *row = bead_options_find(&bead_image_panel_options, key);
    for (size_t p = 0; p < panel_count && row; p++) {
        if (bead_options_find(panels[p].options, key) == row) {
            all[*count] = laid;
            all[(*count)++].below = panels[p].below;
        }
    }
    if (*count == before)
        all[(*count)++] = laid;
}

/* Makes the changes, then applies the job's options for output number `entry`, then its settings and config. */
static enum bead_error change(const struct bead_session *s, const struct bead_scene *scene, const struct changes *changes,
                              size_t entry, struct bead_scene **changed, struct bead_message *msg)
{
    const struct bead_job *job = &s->job;
    const size_t panel_count = changes->of ? changes->of->still.panel_count : 0;
    size_t count = changes->count;
    BEAD_FREED struct panel *panels = calloc(panel_count + 1, sizeof *panels);
    BEAD_FREED struct bead_override *all = calloc(count + job->look_count * (panel_count + 1) + 1, sizeof *all);
    char below[32];
    if (!all || !panels)
        return bead_session_out_of_memory(msg);
    snprintf(below, sizeof below, "outputs.%zu", entry);
    if (panel_count > 0)
        find_panels(changes->of, below, panels);
    memcpy(all, changes->all, count * sizeof *all);
    for (size_t i = 0; i < job->look_count; i++)
        add_look(job->looks[i], below, panels, panel_count, all, &count);
    struct bead_overrides overrides = {
        .all = all, .count = count, .settings = job->settings, .setting_count = job->setting_count, .config = job->config};
    overrides.shown = bead_session_shown(s, &overrides.shown_count);
    return bead_scene_change(scene, &overrides, changed, msg);
}

/* Chooses the scene's output that the file name means, else a new one. */
static enum bead_error choose_file(struct bead_session *s, const struct bead_scene *scene, enum bead_source_kind source,
                                   struct changes *changes, struct bead_message *msg)
{
    const bool own = source != BEAD_OF_CONFIGURATION && source != BEAD_OF_CONFIGURATIONS;
    s->single = s->job.output;
    if (own && s->job.only_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--only %s: has no effect, since -o names the one file to make: %s", s->job.only[0],
                         s->job.output);
    const struct bead_output *found = own ? find(scene, &s->job, source) : NULL;
    if (!found)
        return name_output(s, changes, source, msg);
    const bool same_name = strcmp(bead_session_base_name(found->path), bead_session_base_name(s->single)) == 0;
    if (s->job.setting_count + s->job.look_count + changes->count > 0 || (source == BEAD_OF_TRAJECTORY && !same_name))
        keep_output(changes, found);
    else
        s->single_index = (size_t)(found - scene->outputs); /* the scene stays as it is, and so do files with its text */
    return BEAD_OK;
}

/* ---- a frame ---- */

static enum bead_error find_movie(struct bead_session *s, const struct bead_scene *scene, struct bead_message *msg)
{
    for (s->single_index = 0; s->single_index < scene->output_count; s->single_index++) {
        const struct bead_output *output = &scene->outputs[s->single_index];
        const struct bead_sink_type *type = bead_session_find_type(&s->job, output, false);
        if (bead_session_is_asked(s, output) && type && type->one_frame)
            return BEAD_OK;
    }
    const char *option = s->job.still ? "still" : "frame";
    if (s->job.only_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: --only %s names no movie of %s", option, s->job.only[0], s->job.input);
    return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: %s has no movie; add one to its outputs, such as {movie: film.mp4}", option,
                     s->job.input);
}

/* "waves-2.1ms.png", "waves-50percent.png", "waves-peak.png". */
static char *own_name(const struct bead_output *movie, const char *frame)
{
    const char *base = bead_session_base_name(movie->path), *dot = strrchr(base, '.');
    char *name = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&name, &size);
    if (!out)
        return NULL;
    fprintf(out, "%.*s-", dot ? (int)(dot - base) : (int)strlen(base), base);
    for (const char *c = frame; *c; c++) {
        if (isalnum((unsigned char)*c) || strchr(".-+", *c))
            fputc(*c, out);
        else if (*c == '%')
            fputs("percent", out);
    }
    fputs(".png", out);
    if (fclose(out) == 0)
        return name;
    free(name);
    return NULL;
}

static enum bead_error find_frame_path(struct bead_session *s, const struct bead_output *movie, struct bead_message *msg)
{
    const char *output = s->job.output;
    if (bead_session_names_file(output, s->job.own)) {
        s->single = output;
        return bead_output_ends_like(BEAD_PIXEL_ENDINGS, output)
                   ? BEAD_OK
                   : bead_fail(msg, BEAD_ERROR_USAGE, "--%s: makes a picture (%s), and -o names %s",
                               s->job.still ? "still" : "frame", BEAD_PIXEL_ENDINGS, output);
    }
    char *name = own_name(movie, s->job.still ? s->job.still : s->job.frame);
    enum bead_error err = name ? bead_file_join(output ? output : ".", name, &s->frame_path, msg) : bead_session_out_of_memory(msg);
    free(name);
    s->single = s->frame_path;
    return err;
}

/* Does the setting begin with "outputs.NAME."? */
static bool sets(const char *setting, const char *name)
{
    static const char all[] = "outputs.";
    const size_t before = sizeof all - 1, length = strlen(name);
    return strncmp(setting, all, before) == 0 && strncmp(setting + before, name, length) == 0 && setting[before + length] == '.';
}

/* Outputs are numbered as in the scene, or named by their files; one setting may replace them all. */
static enum bead_error check_setting(const char *setting, const struct bead_output *movie, struct bead_message *msg)
{
    char number[24];
    snprintf(number, sizeof number, "%zu", movie->entry);
    if (strncmp(setting, "outputs.", 8) != 0 || sets(setting, number) || sets(setting, movie->path) ||
        sets(setting, bead_session_base_name(movie->path)))
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "--set %s: has no effect: the frame is one of outputs.%s, %s", setting, number,
                     movie->path);
}

/* Finds which movie of the scene the frame belongs to, and the frame's file. The other outputs stay: a frame keeps the sample times
 * of a trajectory. */
static enum bead_error choose_frame(struct bead_session *s, const struct bead_scene *scene, size_t *entry, struct bead_message *msg)
{
    BEAD_TRY(find_movie(s, scene, msg));
    const struct bead_output *movie = &scene->outputs[s->single_index];
    s->amid = !s->trajectory;
    *entry = movie->entry;
    BEAD_TRY(find_frame_path(s, movie, msg));
    for (size_t i = 0; i < s->job.setting_count; i++)
        BEAD_TRY(check_setting(s->job.settings[i], movie, msg));
    return BEAD_OK;
}

/* The frame of a film from a setting `outputs=[...]`, which replaces the scene's outputs. */
static enum bead_error choose_set_frame(struct bead_session *s, const struct bead_scene *scene, size_t *entry,
                                        struct bead_message *msg)
{
    bool replaced = false;
    for (size_t i = 0; i < s->job.setting_count; i++)
        replaced = replaced || strncmp(s->job.settings[i], "outputs=", 8) == 0;
    if (!replaced)
        return choose_frame(s, scene, entry, msg);
    BEAD_LEFT_TO(bead_scene_left) struct bead_scene *set = NULL;
    BEAD_TRY(change(s, scene, &(struct changes){.count = 0}, 0, &set, msg));
    return choose_frame(s, set, entry, msg);
}

/* Describes a file drawn from a trajectory as a scene that names this file and keeps the sample times: it makes the same file
 * again.
 */
static enum bead_error tell(const struct bead_session *s, const struct bead_scene *stored, struct bead_scene **changed,
                            struct bead_message *msg)
{
    const struct bead_output *keeper = bead_session_keeper(stored), *made = (*changed)->outputs;
    if (!s->single || (*changed)->output_count != 1 || !keeper)
        return BEAD_OK;
    const struct bead_node file = {.kind = BEAD_NODE_SCALAR, .place = {1, 1}, .text = bead_session_base_name(s->single)};
    const struct bead_override all[] = {{.origin = "--output",
                                         .path = made->own ? made->own->name : bead_output_key(made->kind),
                                         .below = "outputs.0",
                                         .node = &file},
                                        {.origin = "--output", .path = "outputs.+", .node = keeper->node}};
    struct bead_scene *told = NULL;
    BEAD_TRY(bead_scene_change(*changed, &(struct bead_overrides){.all = all, .count = 2, .config = s->job.config}, &told, msg));
    bead_scene_free(*changed);
    *changed = told;
    return BEAD_OK;
}

enum bead_error bead_session_choose(struct bead_session *s, const struct bead_scene *scene, enum bead_source_kind source,
                                    const struct bead_override *first, struct bead_scene **changed, struct bead_message *msg)
{
    struct changes changes = {.count = first != NULL};
    size_t entry = 0;
    if (first)
        changes.all[0] = *first;
    enum bead_error err = s->job.frame ? choose_set_frame(s, scene, &entry, msg) : choose_file(s, scene, source, &changes, msg);
    if (!err)
        err = change(s, scene, &changes, entry, changed, msg);
    if (!err && source == BEAD_OF_TRAJECTORY)
        err = tell(s, scene, changed, msg);
    if (err) {
        bead_scene_free(*changed);
        *changed = NULL;
    }
    s->job.output = NULL; /* the scene names the file */
    return err;
}
