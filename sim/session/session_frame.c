/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One frame of a film: of which movie of the scene, and the name of its file. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/file.h"
#include "sim/base/units.h"
#include "sim/session/session_data.h"

static enum bead_error find_movie(struct bead_session *s, const struct bead_scene *scene, struct bead_message *msg)
{
    for (s->single_index = 0; s->single_index < scene->output_count; s->single_index++) {
        const struct bead_output *output = &scene->outputs[s->single_index];
        const struct bead_sink_type *type = bead_session_find_type(&s->job, output);
        bool named = s->job.only_count == 0;
        for (size_t i = 0; i < s->job.only_count; i++)
            named = named || bead_session_is_named(output, s->job.only[i]);
        if (named && type && type->one_frame)
            return BEAD_OK;
    }
    if (s->job.only_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--frame: --only %s names no movie of %s", s->job.only[0], s->job.input);
    return bead_fail(msg, BEAD_ERROR_USAGE, "--frame: %s has no movie", s->job.input);
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

static enum bead_error find_path(struct bead_session *s, const struct bead_output *movie, struct bead_message *msg)
{
    const char *output = s->job.output, *dot = output ? strrchr(bead_session_base_name(output), '.') : NULL;
    if (bead_session_names_file(output)) {
        s->single = output;
        return dot && strcmp(dot, ".png") == 0
                   ? BEAD_OK
                   : bead_fail(msg, BEAD_ERROR_USAGE, "--frame: makes a PNG file, and -o names %s", output);
    }
    char *name = own_name(movie, s->job.frame);
    enum bead_error err = name ? bead_file_join(output ? output : ".", name, &s->frame_path, msg) : bead_session_out_of_memory(msg);
    free(name);
    s->single = s->frame_path;
    return err;
}

/* Outputs are numbered as in the scene. */
static enum bead_error check_setting(const struct bead_session *s, const char *setting, struct bead_message *msg)
{
    char own[40];
    const int length = snprintf(own, sizeof own, "outputs.%zu.", s->single_index);
    if (strncmp(setting, "outputs", 7) != 0 || strncmp(setting, own, (size_t)length) == 0)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "--set %s: has no effect: the frame is one of outputs.%zu", setting, s->single_index);
}

enum bead_error bead_session_frame_settings(struct bead_session *s, const struct bead_scene *scene, struct bead_settings *settings,
                                            struct bead_message *msg)
{
    enum bead_error err = find_movie(s, scene, msg);
    if (!err)
        err = find_path(s, &scene->outputs[s->single_index], msg);
    for (size_t i = 0; !err && i < s->job.setting_count; i++)
        err = check_setting(s, s->job.settings[i], msg);
    return err ? err : bead_session_settings_make(&s->job, s->single_index, NULL, NULL, settings, msg);
}

/* "50%", "50 %": a part of the film. */
static bool read_part(const char *text, double *part)
{
    char *end = NULL;
    *part = strtod(text, &end) / 100;
    return end != text && strcmp(end + strspn(end, " "), "%") == 0;
}

enum bead_error bead_session_read_frame(const struct bead_session *s, struct bead_frame_asked *frame, struct bead_message *msg)
{
    const char *text = s->job.frame, *unit = bead_chain_time_unit(s->chains[0]);
    *frame = (struct bead_frame_asked){text, NAN, NAN};
    if (strcmp(text, "peak") == 0 || read_part(text, &frame->part))
        return BEAD_OK;
    frame->part = NAN;
    struct bead_units *units = bead_units_create();
    char why[160] = "";
    if (!units)
        return bead_session_out_of_memory(msg);
    enum bead_error err = bead_units_read(units, text, *unit ? unit : NULL, &frame->time, why, sizeof why);
    bead_units_free(units);
    return err ? bead_fail(msg, BEAD_ERROR_USAGE,
                           "--frame: %s; give a time such as 2.1ms, a part of the film such as 50%%, or peak", why)
               : BEAD_OK;
}
