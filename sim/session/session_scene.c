/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads the scene of a session, as the command line changes it: whole, with one output, as a sheet, or one chain of its sweep. */
#include <errno.h>
#include <stdlib.h>

#include "sim/base/suggest.h"
#include "sim/scene/scene_internal.h"
#include "sim/session/session_data.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/trajectory/trajectory_data.h"

/* Always with the user's own settings, and with the command line's unless they are to change only a part of the scene. */
static enum bead_error load(const struct bead_session *s, bool with_settings, struct bead_scene **scene, struct bead_message *msg)
{
    const struct bead_overrides overrides = {.settings = s->job.settings,
                                             .setting_count = with_settings ? s->job.setting_count : 0,
                                             .config = s->job.config,
                                             .own = s->job.own,
                                             .name = s->job.name};
    char path[4096];
    BEAD_TRY(bead_scene_find(s->job.input, path, sizeof path, msg));
    return bead_scene_load(path, &overrides, scene, msg);
}

static enum bead_error load_all(struct bead_session *s, struct bead_message *msg)
{
    const char *look = s->job.look_count > 0 ? s->job.looks[0] : NULL;
    if (look)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%.*s: of which output? name it with -o FILE, or use --set outputs.N.%s",
                         (int)strcspn(look, "="), look, look + 2);
    return load(s, true, &s->scene, msg);
}

/* The one output that the job's file names, or a frame, or a sheet. */
static enum bead_error load_single(struct bead_session *s, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_scene_left) struct bead_scene *plain = NULL;
    BEAD_TRY(load(s, false, &plain, msg));
    return s->job.sheet ? bead_session_choose_sheet(s, plain, &s->scene, msg)
                        : bead_session_choose(s, plain, plain->sweep_count > 0 ? BEAD_OF_SWEEP : BEAD_OF_RUN, NULL, &s->scene, msg);
}

/* ---- sheets ---- */

/* The sweep for a scene of one chain, with more configurations than fit on a sheet. */
static const struct bead_override sweep_of_chain = {
    .origin = "--sheet", .path = "sweep", .place = {1, 1}, .value = "{magnetism: all, configurations: 64}"};

static enum bead_error check_sweep(const struct bead_scene *scene, const char *option, struct bead_message *msg)
{
    if (scene->sweep_count > 0 || (scene->chain_count == 1 && scene->chains[0].system->has_contacts))
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "%s: %s has neither a sweep nor one chain of beads", option, scene->file);
}

enum bead_error bead_session_choose_sheet(struct bead_session *s, const struct bead_scene *scene, struct bead_scene **changed,
                                          struct bead_message *msg)
{
    const struct bead_override *first = scene->sweep_count > 0 ? NULL : &sweep_of_chain;
    BEAD_TRY(check_sweep(scene, "--sheet", msg));
    return bead_session_choose(s, scene, BEAD_OF_CONFIGURATIONS, first, changed, msg);
}

/* ---- one chain of several ---- */

static bool has_several_chains(const struct bead_scene *scene)
{
    return scene->sweep_count == 0 && scene->chain_count > 1;
}

enum bead_error bead_session_choose_chain(struct bead_session *s, const struct bead_scene *scene, enum bead_source_kind source,
                                          size_t *index, struct bead_scene **changed, struct bead_message *msg)
{
    const char *asked = s->job.configuration;
    char names[256] = "";
    if (!has_several_chains(scene))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: %s has only one chain", asked, s->job.input);
    for (*index = 0; *index < scene->chain_count && strcmp(scene->chains[*index].name, asked) != 0; ++*index)
        bead_list_add(names, sizeof names, ", ", scene->chains[*index].name);
    if (*index == scene->chain_count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: no chain has this name; there are %s", asked, names);
    struct bead_node *entry = bead_node_get(bead_yaml_root(scene->tree), "chains", NULL)->items[*index],
                     one = {.kind = BEAD_NODE_LIST, .place = entry->place, .items = &entry, .count = 1};
    const struct bead_override chain = {.origin = "--configuration", .path = "chains", .node = &one};
    return bead_session_choose(s, scene, source, &chain, changed, msg);
}

/* ---- one configuration ---- */

/* "17" or "NAME:17". */
static enum bead_error find_configuration(const struct bead_sweep *sweep, const char *asked, size_t *panel, size_t *index,
                                          struct bead_message *msg)
{
    const char *colon = strrchr(asked, ':'), *digits = colon ? colon + 1 : asked;
    size_t panels = bead_sweep_panels(sweep);
    char *end = NULL;
    errno = 0;
    unsigned long long number = strtoull(digits, &end, 10);
    *panel = 0;
    for (size_t p = 0; colon && p < panels; p++) {
        const char *name = bead_sweep_panel(sweep, p)->name;
        if (strlen(name) == (size_t)(colon - asked) && strncmp(name, asked, strlen(name)) == 0)
            *panel = p + 1;
    }
    if (colon && *panel == 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: no sweep has this name; there is %s%s", asked,
                         bead_sweep_panel(sweep, 0)->name, panels > 1 ? ", and others" : "");
    if (!colon && panels > 1)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: there are %zu sweeps; say which, as in %s:%s", asked, panels,
                         bead_sweep_panel(sweep, 0)->name, asked);
    *panel -= *panel > 0;
    size_t count = bead_sweep_panel(sweep, *panel)->configurations;
    if (*digits < '0' || *digits > '9' || *end || errno || number >= count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: must be a number from 0 to %zu", asked, count - 1);
    *index = (size_t)number;
    return BEAD_OK;
}

/* A scene of one random chain gets the sweep that its sheet shows; one of several chains gets none. */
static enum bead_error load_sweep(const struct bead_session *s, struct bead_scene **scene, struct bead_message *msg)
{
    struct bead_override first[] = {
        sweep_of_chain, {.origin = "--configuration", .path = "outputs", .place = {1, 1}, .value = "[{sheet: sheet.png}]"}};
    first[0].origin = first[1].origin;
    struct bead_scene *plain = NULL;
    enum bead_error err = load(s, false, &plain, msg);
    const bool several = !err && has_several_chains(plain);
    if (!err && !several)
        err = check_sweep(plain, "--configuration", msg);
    if (err || several || plain->sweep_count > 0) {
        *scene = plain;
        return err;
    }
    err = bead_scene_change(plain, &(struct bead_overrides){.all = first, .count = 2, .config = s->job.config}, scene, msg);
    bead_scene_free(plain);
    return err;
}

/* The sweep of a file, or of a scene, which must then outlive it; NULL: the scene has several chains instead. */
static enum bead_error open_configurations(const struct bead_session *s, struct bead_scene **scene, struct bead_sweep **sweep,
                                           struct bead_message *msg)
{
    bool of_sweep;
    BEAD_TRY(bead_sweep_is(s->job.input, &of_sweep, msg));
    if (of_sweep)
        return bead_sweep_open(s->job.input, &(struct bead_overrides){.own = s->job.own}, sweep, msg);
    BEAD_TRY(load_sweep(s, scene, msg));
    return has_several_chains(*scene) ? BEAD_OK : bead_sweep_create(*scene, sweep, msg);
}

/* The file of a part has only some configurations. */
static enum bead_error check_stored(const struct bead_session *s, const struct bead_sweep *sweep, size_t panel, size_t index,
                                    struct bead_message *msg)
{
    struct bead_sweep_configuration found;
    size_t part, parts;
    if (bead_sweep_configuration(sweep, panel, index, &found))
        return BEAD_OK;
    bead_sweep_part(sweep, &part, &parts);
    return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: is not in %s, which is part %zu of %zu", s->job.configuration,
                     s->job.input, part, parts);
}

/* The scene of one configuration, with one output. */
static enum bead_error make_configuration(struct bead_session *s, const struct bead_sweep *sweep, size_t panel, size_t index,
                                          struct bead_message *msg)
{
    struct bead_override chain = {.origin = "--configuration", .path = "", .place = {1, 1}};
    BEAD_TRY(bead_sweep_single(sweep, panel, index, &chain.node, msg));
    return bead_session_choose(s, bead_sweep_scene(sweep), BEAD_OF_CONFIGURATION, &chain, &s->scene, msg);
}

static enum bead_error load_configuration(struct bead_session *s, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_scene_left) struct bead_scene *scene = NULL;
    BEAD_LEFT_TO(bead_sweep_left) struct bead_sweep *sweep = NULL;
    size_t panel = 0, index = 0;
    BEAD_TRY(open_configurations(s, &scene, &sweep, msg));
    if (!sweep)
        return bead_session_choose_chain(s, scene, BEAD_OF_RUN, &index, &s->scene, msg);
    BEAD_TRY(find_configuration(sweep, s->job.configuration, &panel, &index, msg));
    if (!scene)
        BEAD_TRY(check_stored(s, sweep, panel, index, msg));
    return make_configuration(s, sweep, panel, index, msg);
}

enum bead_error bead_session_load(struct bead_session *s, struct bead_message *msg)
{
    if (s->job.configuration)
        return load_configuration(s, msg);
    return s->job.sheet || s->job.frame || bead_session_names_file(s->job.output, s->job.own) ? load_single(s, msg)
                                                                                              : load_all(s, msg);
}
