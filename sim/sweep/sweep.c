/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Creates a sweep from its scene: panels, configurations and their chains. The other files of this room run, store and read it. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/spins.h"
#include "sim/scene/scene_internal.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

static enum bead_error out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a sweep");
}

static const struct bead_chain_spec *pattern_of(const struct bead_sweep *sweep, const struct sweep_panel *panel)
{
    return &sweep->scene->chains[panel->shown.spec->chain];
}

static size_t count_beads(const struct bead_chain_spec *chain)
{
    size_t beads = 1;
    for (size_t s = 0; s < chain->segment_count; s++)
        beads += chain->segments[s].cell_beads * chain->segments[s].count;
    return beads;
}

size_t bead_sweep_words(const struct sweep_panel *panel)
{
    return PEAK_WORDS * panel->shown.places + (panel->profiles ? PROFILES * panel->shown.beads : 0);
}

struct sweep_panel *bead_sweep_panel_of(const struct bead_sweep *sweep, size_t job, size_t *row)
{
    size_t p = sweep->panel_count - 1;
    while (sweep->panels[p].first_job > job)
        p--;
    *row = job - sweep->panels[p].first_job;
    return &sweep->panels[p];
}

bool bead_sweep_mine(const struct bead_sweep *sweep, size_t job)
{
    return job % sweep->parts == sweep->part - 1;
}

static enum bead_error make_panel(struct bead_sweep *sweep, size_t index, struct bead_message *msg)
{
    const struct bead_sweep_spec *spec = &sweep->scene->sweeps[index];
    struct sweep_panel *panel = &sweep->panels[index];
    size_t sensors = spec->measures.sensor_count;
    panel->shown = (struct bead_sweep_panel){.name = spec->name,
                                             .spec = spec,
                                             .places = !spec->measures.peak ? 0
                                                       : sensors            ? sensors
                                                                            : 1,
                                             .beads = count_beads(&sweep->scene->chains[spec->chain])};
    for (size_t g = 0; g < spec->group_count; g++)
        panel->shown.configurations += spec->groups[g].configurations;
    panel->first_job = sweep->jobs;
    size_t jobs = panel->shown.configurations + 1;
    sweep->jobs += jobs;
    BEAD_TRY(bead_new(&panel->spins, jobs * (spec->cells + 1), msg, "a sweep"));
    BEAD_TRY(bead_new(&panel->peaks, jobs * (panel->shown.places + 1), msg, "a sweep"));
    return spec->measures.decay ? bead_new(&panel->profiles, jobs * panel->shown.beads * PROFILES, msg, "a sweep") : BEAD_OK;
}

static enum bead_error make_plain(struct bead_sweep *sweep, struct bead_message *msg);
static enum bead_error check_chain(void *context, const struct bead_chain *chain, size_t index, struct bead_message *msg);

enum bead_error bead_sweep_allocate(const struct bead_scene *scene, struct bead_sweep **sweep, struct bead_message *msg)
{
    *sweep = NULL;
    if (scene->sweep_count == 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: the scene has no sweep", scene->file);
    struct bead_sweep *s;
    BEAD_TRY(bead_new(&s, 1, msg, "a sweep"));
    s->scene = scene;
    s->part = s->parts = 1;
    enum bead_error err = bead_new(&s->panels, scene->sweep_count, msg, "a sweep");
    s->panel_count = err ? 0 : scene->sweep_count;
    if (!err && !(s->version = strdup(BEADREEL_VERSION)))
        err = out_of_memory(msg);
    for (size_t i = 0; i < s->panel_count && !err; i++)
        err = make_panel(s, i, msg);
    if (!err)
        err = bead_new(&s->known, s->jobs, msg, "a sweep");
    if (!err)
        err = make_plain(s, msg);
    if (err)
        bead_sweep_close(s);
    else
        *sweep = s;
    return err;
}

/* Draws each random segment with its own magnetism, from a separate stream. */
static void draw_segments(const struct bead_chain_spec *pattern, uint64_t seed, size_t index, char *digits)
{
    uint64_t number = 0;
    for (size_t s = 0; s < pattern->segment_count; s++) {
        const struct bead_segment *segment = &pattern->segments[s];
        if (segment->spins != BEAD_SPINS_RANDOM)
            continue;
        bead_spins_draw(digits, segment->count, segment->magnetism, seed, number++ << 40 | index);
        digits += segment->count;
    }
}

static void draw_panel(const struct bead_sweep *sweep, const struct sweep_panel *panel)
{
    const struct bead_sweep_spec *spec = panel->shown.spec;
    char *digits = panel->spins;
    memset(digits, '1', spec->cells);
    for (size_t g = 0; g < spec->group_count; g++) {
        for (size_t c = 0; c < spec->groups[g].configurations; c++) {
            digits += spec->cells;
            if (bead_sweep_is_over(panel))
                continue;
            if (spec->spins)
                memcpy(digits, spec->spins[g], spec->cells);
            else if (spec->own_magnetism)
                draw_segments(pattern_of(sweep, panel), spec->seed, c, digits);
            else
                bead_spins_shuffle(digits, spec->cells, spec->groups[g].up, spec->seed, (uint64_t)spec->groups[g].up << 32 | c);
        }
    }
}

enum bead_error bead_sweep_create(const struct bead_scene *scene, struct bead_sweep **sweep, struct bead_message *msg)
{
    enum bead_error err = bead_sweep_allocate(scene, sweep, msg);
    for (size_t p = 0; !err && p < (*sweep)->panel_count; p++)
        draw_panel(*sweep, &(*sweep)->panels[p]);
    if (!err && (*sweep)->plain)
        err = bead_sweep_try(*sweep, check_chain, (*sweep)->panels, msg);
    if (err) {
        bead_sweep_close(*sweep);
        *sweep = NULL;
    }
    return err;
}

void bead_sweep_close(struct bead_sweep *sweep)
{
    if (!sweep)
        return;
    for (size_t p = 0; p < sweep->panel_count; p++) {
        free(sweep->panels[p].spins);
        free(sweep->panels[p].peaks);
        free(sweep->panels[p].profiles);
    }
    free(sweep->panels);
    free(sweep->known);
    free(sweep->version);
    if (sweep->plain)
        pthread_mutex_destroy(&sweep->making);
    bead_scene_free(sweep->plain);
    bead_scene_free(sweep->own_scene);
    free(sweep);
}

const struct bead_scene *bead_sweep_scene(const struct bead_sweep *sweep)
{
    return sweep->scene;
}

size_t bead_sweep_panels(const struct bead_sweep *sweep)
{
    return sweep->panel_count;
}

const struct bead_sweep_panel *bead_sweep_panel(const struct bead_sweep *sweep, size_t panel)
{
    return &sweep->panels[panel].shown;
}

const char *bead_sweep_place(const struct bead_sweep *sweep, size_t panel, size_t place)
{
    const struct bead_sweep_measures *measures = &sweep->panels[panel].shown.spec->measures;
    return measures->sensor_count ? measures->sensors[place] : "peak";
}

size_t bead_sweep_count(const struct bead_sweep *sweep, size_t *known)
{
    *known = 0;
    for (size_t job = 0; job < sweep->jobs; job++)
        *known += sweep->known[job];
    return sweep->jobs;
}

void bead_sweep_part(const struct bead_sweep *sweep, size_t *part, size_t *parts)
{
    *part = sweep->part;
    *parts = sweep->parts;
}

const char *bead_sweep_version(const struct bead_sweep *sweep)
{
    return sweep->version;
}

/* The magnetism of the cells whose spins the scene gives, as in bead_chain_magnetism. */
static double magnetism_of(const struct bead_chain_spec *pattern, const char *digits)
{
    double up = 0, all = 0;
    for (size_t s = 0; s < pattern->segment_count; s++) {
        const struct bead_segment *segment = &pattern->segments[s];
        if (!segment->spins_given || segment->cell_beads < 2)
            continue;
        const char *own = segment->digits;
        if (segment->spins == BEAD_SPINS_RANDOM) {
            own = digits;
            digits += segment->count;
        }
        for (size_t i = 0; i < segment->count; i++)
            up += own ? own[i] == '1' : segment->spins == BEAD_SPINS_UP;
        all += (double)segment->count;
    }
    return all > 0 ? fabs(2 * up - all) / all : 1;
}

bool bead_sweep_configuration(const struct bead_sweep *sweep, size_t panel, size_t index, struct bead_sweep_configuration *found)
{
    const struct sweep_panel *p = &sweep->panels[panel];
    *found = (struct bead_sweep_configuration){.magnetism = NAN};
    if (index != BEAD_SWEEP_CLEAN && index >= p->shown.configurations)
        return false;
    size_t row = index + 1; /* 0: the clean chain */
    bool known = sweep->known[p->first_job + row];
    found->spins = p->spins + row * p->shown.spec->cells;
    if (!bead_sweep_is_over(p))
        found->magnetism = magnetism_of(pattern_of(sweep, p), found->spins);
    if (!known)
        return false;
    found->peaks = p->shown.places ? p->peaks + row * p->shown.places : NULL;
    if (p->profiles) {
        const double *profiles = p->profiles + PROFILES * row * p->shown.beads;
        found->bead_force = profiles + PROFILE_FORCE * p->shown.beads;
        found->bead_energy = profiles + PROFILE_ENERGY * p->shown.beads;
        found->last_force = profiles + PROFILE_LAST_FORCE * p->shown.beads;
        found->last_energy = profiles + PROFILE_LAST_ENERGY * p->shown.beads;
    }
    return true;
}

/* ---- chains ---- */

struct bead_sweep_chain {
    struct bead_scene scene; /* the sweep's scene, with this chain only */
    struct bead_chain_spec spec;
    struct bead_segment *segments;
    struct bead_scene *own; /* over keys: the chain's own scene instead */
    struct bead_chain *chain;
};

size_t bead_sweep_value(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key)
{
    const struct bead_over *over = &sweep->panels[panel].shown.spec->over;
    if (over->combine == BEAD_COMBINE_PAIRS)
        return index;
    for (size_t k = over->key_count - 1; k > key; k--)
        index /= over->keys[k].count;
    return index % over->keys[key].count;
}

/* The node of a key's value, in the file or in an override. */
static const struct bead_node *node_of_value(const struct bead_sweep *sweep, size_t panel, const char *path, size_t value)
{
    const struct bead_node *over = bead_node_get(bead_sweep_node(bead_yaml_root(sweep->scene->tree), panel), "over", NULL),
                           *values = over ? bead_node_get(over, path, NULL) : NULL;
    return values && values->kind == BEAD_NODE_LIST ? values->items[value] : values;
}

/* The overrides that turn the plain scene into a configuration's. */
static void lay_values(const struct bead_sweep *sweep, size_t panel, size_t index, struct bead_override *all)
{
    const struct bead_over *over = &sweep->panels[panel].shown.spec->over;
    for (size_t k = 0; k < over->key_count; k++) {
        const struct bead_over_key *key = &over->keys[k];
        const size_t value = bead_sweep_value(sweep, panel, index, k);
        const struct bead_node *node = node_of_value(sweep, panel, key->path, value);
        all[k] = (struct bead_override){.origin = bead_yaml_name(sweep->scene->tree, node),
                                        .path = key->path,
                                        .place = node ? node->place : (struct bead_place){1, 1},
                                        .value = key->text[value]};
    }
}

static enum bead_error make_scene(const struct bead_sweep *sweep, size_t panel, size_t index, struct bead_scene **scene,
                                  struct bead_message *msg)
{
    const size_t keys = sweep->panels[panel].shown.spec->over.key_count;
    BEAD_FREED struct bead_override *all = NULL;
    BEAD_TRY(bead_new(&all, keys, msg, "a chain of a sweep"));
    if (index != BEAD_SWEEP_CLEAN)
        lay_values(sweep, panel, index, all);
    pthread_mutex_lock((pthread_mutex_t *)&sweep->making);
    enum bead_error err = bead_scene_change(
        sweep->plain, &(struct bead_overrides){.all = all, .count = index == BEAD_SWEEP_CLEAN ? 0 : keys}, scene, msg);
    pthread_mutex_unlock((pthread_mutex_t *)&sweep->making);
    return err;
}

static size_t bead_of(const struct bead_sweep_spec *spec, const struct bead_chain *chain, size_t measured)
{
    const size_t beads = bead_chain_beads(chain);
    return measured == BEAD_LAST ? beads - 1 : measured == BEAD_MIDDLE ? beads / 2 : spec->last + measured;
}

struct bead_span bead_sweep_place_span(const struct sweep_panel *panel, const struct bead_chain *chain, size_t place)
{
    const struct bead_sweep_measures *measures = &panel->shown.spec->measures;
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    for (size_t i = 0; measures->sensor_count && i < count; i++) {
        if (strcmp(sensors[i].name, measures->sensors[place]) == 0)
            return (struct bead_span){sensors[i].bead, sensors[i].bead};
    }
    return (struct bead_span){bead_of(panel->shown.spec, chain, measures->beads[0]),
                              bead_of(panel->shown.spec, chain, measures->beads[1])};
}

enum bead_error bead_sweep_check_places(const struct sweep_panel *panel, const struct bead_chain *chain, size_t index,
                                        struct bead_message *msg)
{
    const size_t last = bead_chain_beads(chain) - 1;
    for (size_t i = 0; i < panel->shown.places; i++) {
        const struct bead_span span = bead_sweep_place_span(panel, chain, i);
        const size_t most = span.first > span.last ? span.first : span.last;
        if (most > last)
            return bead_fail(msg, BEAD_ERROR_SCENE, "sweep: chain %zu has no bead %zu, which is measured: its last is %zu", index,
                             most, last);
    }
    return BEAD_OK;
}

static enum bead_error check_chain(void *context, const struct bead_chain *chain, size_t index, struct bead_message *msg)
{
    return bead_sweep_check_places(context, chain, index, msg);
}

enum bead_error bead_sweep_try(const struct bead_sweep *sweep, bead_sweep_visit *visit, void *context, struct bead_message *msg)
{
    enum { TRIED = 32 };
    const size_t count = sweep->panels[0].shown.configurations;
    for (size_t i = 0; i < count; i = i == TRIED && count > 2 * TRIED ? count - TRIED : i + 1) {
        struct bead_scene *scene = NULL;
        struct bead_chain *chain = NULL;
        BEAD_TRY(make_scene(sweep, 0, i, &scene, msg));
        enum bead_error err = bead_chain_outline(scene, &scene->chains[0], &chain, msg);
        if (!err)
            err = visit(context, chain, i, msg);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
        BEAD_TRY(err);
    }
    return BEAD_OK;
}

/* The scene without the sweep, with an output that needs nothing. */
static enum bead_error make_plain(struct bead_sweep *sweep, struct bead_message *msg)
{
    struct bead_node *node = NULL;
    if (sweep->scene->sweep_count != 1 || sweep->scene->sweeps[0].over.key_count == 0)
        return BEAD_OK;
    BEAD_TRY(bead_sweep_single_node(sweep->scene->tree, 0, NULL, &node, msg));
    const struct bead_override all[] = {{.origin = "over", .path = "", .place = {1, 1}, .node = node},
                                        {.origin = "over", .path = "outputs", .place = {1, 1}, .value = "[{table: none.csv}]"}};
    BEAD_TRY(bead_scene_change(sweep->scene, &(struct bead_overrides){.all = all, .count = 2}, &sweep->plain, msg));
    return pthread_mutex_init(&sweep->making, NULL) == 0 ? BEAD_OK : out_of_memory(msg);
}

static enum bead_error create_over(const struct bead_sweep *sweep, size_t panel, size_t index, struct bead_sweep_chain **chain,
                                   struct bead_message *msg)
{
    struct bead_sweep_chain *c = NULL;
    BEAD_TRY(bead_new(&c, 1, msg, "a chain of a sweep"));
    enum bead_error err = make_scene(sweep, panel, index, &c->own, msg);
    if (!err)
        err = bead_chain_create(c->own, 0, &c->chain, msg);
    if (err)
        bead_sweep_chain_destroy(c);
    *chain = err ? NULL : c;
    return err;
}

/* Copies the segments of a pattern, with digits for the random ones. */
static void lay_digits(const struct bead_chain_spec *pattern, char *digits, struct bead_segment *segments)
{
    memcpy(segments, pattern->segments, pattern->segment_count * sizeof *segments);
    for (size_t s = 0; s < pattern->segment_count; s++) {
        if (segments[s].spins != BEAD_SPINS_RANDOM)
            continue;
        segments[s].spins = BEAD_SPINS_DIGITS;
        segments[s].digits = digits;
        digits += segments[s].count;
    }
}

enum bead_error bead_sweep_chain_create(const struct bead_sweep *sweep, size_t panel, size_t index, struct bead_sweep_chain **chain,
                                        struct bead_message *msg)
{
    const struct sweep_panel *p = &sweep->panels[panel];
    const struct bead_chain_spec *pattern = pattern_of(sweep, p);
    if (bead_sweep_is_over(p))
        return create_over(sweep, panel, index, chain, msg);
    struct bead_sweep_chain *c = NULL;
    BEAD_TRY(bead_new(&c, 1, msg, "a sweep"));
    enum bead_error err = bead_new(&c->segments, pattern->segment_count, msg, "a sweep");
    if (!err) {
        lay_digits(pattern, p->spins + (index + 1) * p->shown.spec->cells, c->segments);
        c->scene = *sweep->scene;
        c->spec = *pattern;
        c->spec.segments = c->segments;
        c->scene.chains = &c->spec;
        c->scene.chain_count = 1;
        c->scene.sweeps = NULL;
        c->scene.sweep_count = 0;
        err = bead_chain_create(&c->scene, 0, &c->chain, msg);
    }
    if (err)
        bead_sweep_chain_destroy(c);
    *chain = err ? NULL : c;
    return err;
}

const struct bead_chain *bead_sweep_chain_of(const struct bead_sweep_chain *chain)
{
    return chain->chain;
}

void bead_sweep_chain_destroy(struct bead_sweep_chain *chain)
{
    if (!chain)
        return;
    bead_chain_destroy(chain->chain);
    bead_scene_free(chain->own);
    free(chain->segments);
    free(chain);
}

enum bead_error bead_sweep_single(const struct bead_sweep *sweep, size_t panel, size_t index, const struct bead_node **scene,
                                  struct bead_message *msg)
{
    const struct sweep_panel *p = &sweep->panels[panel];
    const size_t cells = p->shown.spec->cells;
    struct bead_node *made = NULL;
    if (bead_sweep_is_over(p)) {
        struct bead_scene *own = NULL;
        BEAD_TRY(make_scene(sweep, panel, index, &own, msg));
        *scene = bead_yaml_copy(sweep->scene->tree, bead_yaml_root(own->tree), (struct bead_place){1, 1}, NULL);
        bead_scene_free(own);
        return *scene ? BEAD_OK : out_of_memory(msg);
    }
    BEAD_FREED char *digits = strndup(p->spins + (index + 1) * cells, cells);
    if (!digits)
        return out_of_memory(msg);
    BEAD_TRY(bead_sweep_single_node(sweep->scene->tree, panel, digits, &made, msg));
    *scene = made;
    return BEAD_OK;
}
