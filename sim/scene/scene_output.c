/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `outputs`: the list, and what must fit together in it. */
#include "sim/scene/scene_output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/suggest.h"
#include "sim/equation/equation.h"

/* What a kind has no key for. */
const struct bead_output bead_output_automatic = {.shown = {.beads = {0, SIZE_MAX}, .time = {NAN, NAN}},
                                                  .views = {.axes = true},
                                                  .colours = {.range = {NAN, NAN}},
                                                  .panel = {.chain = SIZE_MAX},
                                                  .image = {.at = NAN},
                                                  .movie = {.poster_at = NAN},
                                                  .plot = {.range = {NAN, NAN}}};

static bool is_given(const struct bead_at *at, const char *key)
{
    return bead_at_key(at, key).node != at->node;
}

/* Which kind: the one key of the map that is the name of one. */
static enum bead_error find_kind(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    size_t found = 0;
    char shown[64];
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_wrong(reader, at, "is %s; must be a map such as {image: force.png}",
                          bead_node_show(at->node, shown, sizeof shown));
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        struct bead_at where = bead_at_key(at, bead_output_key(kind));
        if (where.node == at->node)
            continue;
        if (found++ > 0)
            return bead_wrong(reader, &where, "is a second kind beside `%s`; give each file an entry of its own",
                              bead_output_key(output->kind));
        output->kind = kind;
    }
    if (found > 0)
        return BEAD_OK;
    /* No key is the name of a kind: is one nearly so? */
    char all[160] = "", near[96];
    for (size_t i = 0; i + 1 < at->node->count; i += 2) {
        struct bead_at key = {at, at->node->items[i]->text, 0, at->node->items[i]};
        struct bead_suggest search;
        bead_suggest_begin(&search, key.key);
        for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
            bead_suggest_try(&search, bead_output_key(kind));
        if (search.best)
            return bead_wrong(reader, &key, "unknown key%s", bead_suggest_text(&search, near, sizeof near));
    }
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s",
                 kind == 0                      ? ""
                 : kind + 1 < BEAD_OUTPUT_KINDS ? ", "
                                                : " or ",
                 bead_output_key(kind));
    }
    return bead_wrong(reader, at, "has no kind; must have one of the keys %s, with a file's name", all);
}

/* ---- what one output's keys must fit together in ---- */

BEAD_OUTPUT_CHECK(bead_output_check_times)
{
    struct bead_at where = bead_at_key(at, "time");
    double until = reader->scene->simulate.until;
    const char *unit = bead_scene_plain(reader->scene) ? "" : " s";
    if (output->shown.time[0] >= output->shown.time[1])
        return bead_wrong(reader, &where, "is [%g, %g]%s; the first must be before the second", output->shown.time[0],
                          output->shown.time[1], unit);
    if (output->shown.time[0] >= until)
        return bead_wrong(reader, &where, "begins at %g%s; must begin before the run ends at %g%s", output->shown.time[0], unit,
                          until, unit);
    if (output->shown.time[1] > until * (1 + 1e-9))
        return bead_wrong(reader, &where, "goes to %g%s; must not go beyond the end of the run at %g%s", output->shown.time[1],
                          unit, until, unit);
    where = bead_at_key(at, "at");
    if (output->image.at > until)
        return bead_wrong(reader, &where, "is %g%s; must not be later than the end of the run at %g%s", output->image.at, unit,
                          until, unit);
    return BEAD_OK;
}

/* Keys of views that show a moment, in pictures without one. */
BEAD_OUTPUT_CHECK(bead_output_check_moment)
{
    const struct bead_views_asked *views = &output->views;
    bool beads = bead_views_any(views->kinds, views->count, BEAD_SHOWS_BEADS);
    bool moment = !bead_views_all(views->kinds, views->count, BEAD_SHOWS_ALL_TIMES);
    if (output->still.panel_count > 0)
        return BEAD_OK;
    struct bead_at where = bead_at_key(at, "at");
    if (!moment && !isnan(output->image.at))
        return bead_wrong(reader, &where,
                          "is a moment, but the picture shows all times: add beads or profile to `views`, or give `time` instead");
    where = bead_at_key(at, "magnify");
    return beads || output->views.magnify == 0
               ? BEAD_OK
               : bead_wrong(reader, &where, "is given, but no beads are drawn: add beads to `views`");
}

/* Masses at all points of all chains, that the view of the beads can show. */
static bool has_beads(const struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->chain_count; i++) {
        const char *name = scene->chains[i].equation.name;
        if (name && !bead_equation_find(name)->system.beads)
            return false;
    }
    return true;
}

/* Defaults are those of beads: where the output does not say otherwise, equations have their own. */
static void fit_equations(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    const struct bead_scene *scene = reader->scene;
    unsigned known = bead_scene_fields(scene);
    enum bead_field shown = bead_system_shown(&scene->chains[0].equation);
    if (!bead_scene_plain(scene))
        return;
    while (known && !(known & BEAD_FIELD_BIT(shown))) /* that all chains have */
        shown = (enum bead_field)((shown + 1) % BEAD_FIELD_COUNT);
    if (!is_given(at, "fields"))
        output->trajectory.fields = known;
    if (!is_given(at, "field"))
        output->shown.field = shown;
    if (!is_given(at, "scale"))
        output->colours.scale = BEAD_SCALE_LINEAR;
    if (is_given(at, "views") || has_beads(scene))
        return;
    size_t kept = 0;
    for (size_t i = 0; i < output->views.count; i++) {
        if (!bead_views_any(&output->views.kinds[i], 1, BEAD_SHOWS_BEADS))
            output->views.kinds[kept++] = output->views.kinds[i];
    }
    output->views.count = kept;
}

static bool has_modes(const struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->chain_count; i++) {
        const char *name = scene->chains[i].equation.name;
        if (!name || !bead_equation_find(name)->system.modes)
            return false;
    }
    return true;
}

enum bead_error bead_output_need_modes(const struct bead_reader *reader, const struct bead_at *where)
{
    return has_modes(reader->scene)
               ? BEAD_OK
               : bead_wrong(reader, where, "modes are those of equations, such as fput; %s",
                            reader->scene->chain_count > 1 ? "not all chains here have some" : "this chain has none");
}

static enum bead_error check_orientation(const struct bead_reader *reader, const struct bead_at *at,
                                         const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "orientation");
    if (output->views.orientation != BEAD_MATRIX || !output->views.axes)
        return BEAD_OK;
    return bead_wrong(reader, &where,
                      "is matrix, which is how pictures without axes lie: needs `axes: false`; must be time-right or time-down");
}

/* Views of what the chains do not have. */
BEAD_OUTPUT_CHECK(bead_output_check_views)
{
    struct bead_at where = bead_at_key(at, "views");
    const struct bead_views_asked *views = &output->views;
    bool modes = bead_views_any(views->kinds, views->count, BEAD_SHOWS_MODES);
    if (bead_views_any(views->kinds, views->count, BEAD_SHOWS_BEADS) && !has_beads(reader->scene))
        return bead_wrong(reader, &where, "the equation has no beads to show; must be profile or spacetime");
    enum bead_error err = modes ? bead_output_need_modes(reader, &where) : BEAD_OK;
    return err ? err : check_orientation(reader, at, output);
}

BEAD_OUTPUT_CHECK(bead_output_check_still_views)
{
    struct bead_at where = bead_at_key(at, "views");
    if (bead_views_any(output->views.kinds, output->views.count, BEAD_SHOWS_MODES))
        return bead_wrong(reader, &where, "modes are a view of movies; {plot: FILE, show: modes} has their energies over time");
    return bead_output_check_views(reader, at, output);
}

static bool has_cells(const struct bead_scene *scene)
{
    for (size_t c = 0; c < scene->chain_count; c++) {
        for (size_t s = 0; s < scene->chains[c].segment_count; s++) {
            if (scene->chains[c].segments[s].cell_beads > 1)
                return true;
        }
    }
    return false;
}

/* Schematic drawings are of beads, and need no run. */
BEAD_OUTPUT_CHECK(bead_output_check_drawing)
{
    static const char *const of_runs[] = {"every", "time", "scale", "trust", "normalise", "range", "modes", "field", "at"},
                             *const of_contacts[] = {"contact", "compression"};
    const struct bead_scene *scene = reader->scene;
    const bool drawing = bead_output_show(output)->drawing;
    struct bead_at where;
    for (size_t i = 0; i < 2 && output->curves.show != BEAD_SHOW_CONTACT; i++) {
        where = bead_at_key(at, of_contacts[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `show: contact`");
    }
    for (size_t i = 0; i < sizeof of_runs / sizeof *of_runs && drawing; i++) {
        where = bead_at_key(at, of_runs[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `show: sensors` or `show: peaks`; nothing is computed for a drawing");
    }
    where = bead_at_key(at, "show");
    for (size_t c = 0; c < scene->chain_count && drawing; c++) {
        if (scene->chains[c].equation.name)
            return bead_wrong(reader, &where, "draws beads, but there are none in `%s`", scene->chains[c].equation.name);
    }
    if (output->curves.show == BEAD_SHOW_CELL && !has_cells(scene))
        return bead_wrong(reader, &where, "draws cells, but no chain has a `cell` of two or more beads");
    if (output->curves.show != BEAD_SHOW_CONTACT || output->plot.contact == BEAD_CONTACT_AUTO)
        return BEAD_OK;
    size_t last = bead_scene_count_beads(&scene->chains[0]) - (scene->chains[0].wall == BEAD_WALL_NONE);
    where = bead_at_key(at, "contact");
    return output->plot.contact <= last
               ? BEAD_OK
               : bead_wrong(reader, &where, "is %zu, but the last contact is %zu", output->plot.contact, last);
}

/* Only fields that every chain has. */
static enum bead_error check_fields(const struct bead_reader *reader, const struct bead_at *where, unsigned asked)
{
    unsigned known = bead_scene_fields(reader->scene);
    char all[120] = "";
    if (!(asked & ~known))
        return BEAD_OK;
    const char *missing = NULL;
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        const char *name = bead_field_info((enum bead_field)f)->name;
        size_t used = strlen(all);
        if (known & BEAD_FIELD_BIT(f))
            snprintf(all + used, sizeof all - used, "%s%s", used ? ", " : "", name);
        else if (asked & BEAD_FIELD_BIT(f) && !missing)
            missing = name;
    }
    return bead_wrong(reader, where, "there is no %s in %s; there is %s", missing,
                      reader->scene->chain_count > 1 ? "every chain" : "this chain", all);
}

BEAD_OUTPUT_CHECK(bead_output_check_field)
{
    struct bead_at where = bead_at_key(at, "field");
    return check_fields(reader, &where, BEAD_FIELD_BIT(output->shown.field));
}

BEAD_OUTPUT_CHECK(bead_output_check_field_list)
{
    struct bead_at where = bead_at_key(at, "fields");
    return check_fields(reader, &where, output->trajectory.fields);
}

BEAD_OUTPUT_CHECK(bead_output_check_xdmf)
{
    struct bead_at where = bead_at_key(at, "xdmf");
    if (!output->trajectory.xdmf)
        return BEAD_OK;
    if (!has_beads(reader->scene))
        return bead_wrong(reader, &where, "tells where beads are, but there are none in this scene");
    if (!(output->trajectory.fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT)))
        return bead_wrong(reader, &where, "tells where beads are: add displacement to `fields`");
    return BEAD_OK;
}

/* `trust` shows in views of all times, and needs room for its words. */
BEAD_OUTPUT_CHECK(bead_output_check_trust)
{
    struct bead_at where = bead_at_key(at, "trust");
    const struct bead_show_type *show = bead_output_show(output);
    bool shows = show || bead_views_any(output->views.kinds, output->views.count, BEAD_SHOWS_ALL_TIMES);
    if (!output->shown.trust)
        return BEAD_OK;
    if (show && output->curves.show != BEAD_SHOW_SENSORS)
        return bead_wrong(reader, &where,
                          "is set, but peaks of the first passage have no axis of time; it belongs to `show: sensors`");
    if (!show && !output->views.axes)
        return bead_wrong(reader, &where, "is set, but `axes: false` leaves pixels bare and no room for its line of text");
    return shows ? BEAD_OK : bead_wrong(reader, &where, "is set, but no view shows all times: add spacetime or sensors to `views`");
}

/* Skips every `./` and `/` that adds nothing to a path. */
static const char *skip(const char *path)
{
    while (path[0] == '.' && path[1] == '/')
        path += 2 + strspn(path + 2, "/");
    return path;
}

/* The same file, whatever `./` and `//` are in between. */
static bool same_path(const char *a, const char *b)
{
    while (*a && *b) {
        a = skip(a);
        b = skip(b);
        size_t length = strcspn(a, "/");
        if (length != strcspn(b, "/") || memcmp(a, b, length) != 0 || !a[length] != !b[length])
            return false;
        a += length + strspn(a + length, "/");
        b += length + strspn(b + length, "/");
    }
    return *a == *b;
}

/* Is `path` written by one of the first `count` outputs, as its own file or beside it? */
static bool is_taken(const struct bead_output *outputs, size_t count, const char *path)
{
    bool taken = false;
    const char *key;
    for (size_t i = 0; i < count; i++)
        taken = taken || (outputs[i].path && same_path(outputs[i].path, path)) ||
                (*path && same_path(bead_output_second(&outputs[i], &key), path));
    return taken;
}

/* Every file is written once. */
static enum bead_error check_paths(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_output *outputs = reader->scene->outputs, *output = &outputs[index];
    const char *key, *second = bead_output_second(output, &key);
    struct bead_at where = bead_at_key(at, bead_output_key(output->kind));
    if (is_taken(outputs, index, output->path))
        return bead_wrong(reader, &where, "`%s` is the file of another output, too; names must differ", output->path);
    where = bead_at_key(at, key);
    if (*second && (is_taken(outputs, index, second) || same_path(output->path, second)))
        return bead_wrong(reader, &where, "`%s` is the file of another output, too; names must differ", second);
    return BEAD_OK;
}

/* ---- reading ---- */

/* Chains have panels of their own, but for plots of peaks. */
static bool side_by_side(const struct bead_reader *reader, const struct bead_output *output)
{
    const bool peaks = output->kind == BEAD_OUTPUT_PLOT && output->curves.show == BEAD_SHOW_PEAKS;
    return reader->scene->chain_count > 1 && !peaks;
}

/* The size of the style, of panels, or of the kind of file, where the output asks for none. */
static enum bead_error settle_size(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    static const double one_column[] = {86e-3, 64e-3}, page_wide[] = {178e-3, 90e-3}, several_panels[] = {178e-3, 120e-3},
                        screen[] = {1920, 1080};
    struct bead_paper *paper = &output->paper;
    const char *dot = output->path ? strrchr(output->path, '.') : NULL;
    bool vector = dot && (strcasecmp(dot, ".pdf") == 0 || strcasecmp(dot, ".svg") == 0);
    const double *size = screen;
    if (!bead_output_type(output->kind)->draws || !output->path || paper->size[0] > 0)
        return BEAD_OK;
    if (paper->style == BEAD_STYLE_AUTO && vector)
        size = several_panels;
    else if (paper->style == BEAD_STYLE_PAPER)
        size = output->still.panel_count > 0 ? several_panels : side_by_side(reader, output) ? page_wide : one_column;
    paper->size_is_length = size != screen;
    memcpy(paper->size, size, sizeof paper->size);
    struct bead_at where = bead_at_key(at, "size");
    return bead_output_check_size(reader, &where, paper);
}

enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options,
                                          struct bead_output *output)
{
    const struct bead_output_type *type = bead_output_type(output->kind);
    enum bead_error err = bead_options_read(reader, at, options, output);
    if (reader->unsound)
        return err;
    if (!err)
        err = settle_size(reader, at, output);
    if (err)
        return err;
    fit_equations(reader, at, output);
    if (reader->scene->sweep_count > 0)
        return type->check_sweep ? type->check_sweep(reader, at, output) : BEAD_OK;
    for (size_t i = 0; !err && i < BEAD_OUTPUT_CHECKS && type->checks[i]; i++)
        err = type->checks[i](reader, at, output);
    return err;
}

static enum bead_error read_output(struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    struct bead_output *output = &reader->scene->outputs[index];
    *output = bead_output_automatic;
    output->place = at->node->place;
    enum bead_error err = find_kind(reader, at, output);
    if (!err)
        err = bead_output_check_sweep(reader, at, index);
    if (err)
        return err;
    const struct bead_output_type *type = bead_output_type(output->kind);
    err = bead_output_read_settings(reader, at, reader->scene->sweep_count > 0 ? type->sweep_options : type->options, output);
    return err ? err : check_paths(reader, at, index);
}

/* ---- the list ---- */

/* Place in the entry's map of its list of files; 0: it names one. */
static size_t find_list(const struct bead_node *entry)
{
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        struct bead_node *key = NULL, *value = bead_node_get(entry, bead_output_key(kind), &key);
        for (size_t i = 0; value && value->kind == BEAD_NODE_LIST && i + 1 < entry->count; i += 2) {
            if (entry->items[i] == key)
                return i + 1;
        }
    }
    return 0;
}

size_t bead_output_files(const struct bead_node *entry)
{
    size_t list = find_list(entry);
    return list ? entry->items[list]->count : 1;
}

struct bead_node *bead_output_entry(const struct bead_reader *reader, struct bead_node *entry, size_t file)
{
    size_t list = find_list(entry);
    if (!list)
        return entry;
    struct bead_node *single = bead_yaml_node(reader->yaml, BEAD_NODE_MAP, entry->place);
    if (!single)
        return NULL;
    single->origin = entry->origin;
    for (size_t i = 0; i < entry->count; i++) {
        if (!bead_yaml_append(reader->yaml, single, i == list ? entry->items[i]->items[file] : entry->items[i]))
            return NULL;
    }
    return single;
}

/* How many files all entries name. */
static enum bead_error count_files(const struct bead_reader *reader, const struct bead_at *at, size_t *count)
{
    *count = 0;
    for (size_t i = 0; i < at->node->count; i++) {
        size_t files = bead_output_files(at->node->items[i]);
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        if (files == 0)
            return bead_wrong(reader, &element, "names no file: its list is empty");
        *count += files;
    }
    if (*count == 0 || *count > BEAD_SCENE_OUTPUTS)
        return bead_wrong(reader, at, "has %zu entries; must have from 1 to %d", *count, BEAD_SCENE_OUTPUTS);
    return BEAD_OK;
}

enum bead_error bead_scene_read_outputs(struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_scene *scene = reader->scene;
    size_t count = 0, read = 0;
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be a list such as [{image: force.png}]",
                          bead_node_show(at->node, shown, sizeof shown));
    enum bead_error err = count_files(reader, at, &count);
    if (err)
        return err;
    scene->outputs = calloc(count, sizeof *scene->outputs);
    if (!scene->outputs)
        return bead_no_memory(reader);
    scene->output_count = count;
    enum bead_error kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i < at->node->count; i++) {
        size_t files = bead_output_files(at->node->items[i]);
        err = BEAD_OK;
        for (size_t k = 0; k < files && !err; k++) {
            struct bead_at element = {at, NULL, i, bead_output_entry(reader, at->node->items[i], k)};
            err = element.node ? read_output(reader, &element, read++) : bead_no_memory(reader);
        }
    }
    return kept;
}
