/* `outputs`: the list, and what must fit together in it. */
#include "sim/scene/scene_output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/suggest.h"
#include "sim/equation/equation.h"

static const char *const kinds[] = {"trajectory", "image", "movie", "plot", "table", "sweep", "sheet"};

static bool is_vector(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".pdf") == 0 || strcasecmp(dot, ".svg") == 0);
}

/* Plots and tables of sweeps have keys of their own. */
static unsigned form_of(const struct bead_scene *scene, enum bead_output_kind kind)
{
    if (scene->sweep_count > 0 && kind == BEAD_OUTPUT_PLOT)
        return BEAD_OUTPUT_SWEEP_PLOT;
    return scene->sweep_count > 0 && kind == BEAD_OUTPUT_TABLE ? BEAD_OUTPUT_SWEEP_TABLE : (unsigned)kind;
}

/* Which kind: the one key of the map that is the name of one. */
static enum bead_error find_kind(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output,
                                 unsigned *form)
{
    size_t found = 0;
    char shown[64];
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_wrong(reader, at, "is %s; must be a map such as {image: force.png}",
                          bead_node_show(at->node, shown, sizeof shown));
    for (size_t i = 0; i < BEAD_OUTPUT_KINDS; i++) {
        struct bead_at where = bead_at_key(at, kinds[i]);
        if (where.node == at->node)
            continue;
        if (found++ > 0)
            return bead_wrong(reader, &where, "is a second kind beside `%s`; give every file an entry of its own",
                              kinds[output->kind]);
        output->kind = (enum bead_output_kind)i;
        bool vector = where.node->kind == BEAD_NODE_SCALAR && is_vector(where.node->text) &&
                      (output->kind == BEAD_OUTPUT_IMAGE || output->kind == BEAD_OUTPUT_PLOT || output->kind == BEAD_OUTPUT_SHEET);
        *form = 1u << (form_of(reader->scene, output->kind) + (vector ? BEAD_OUTPUT_VECTOR : 0));
    }
    return BEAD_OK;
}

/* No key is the name of a kind: is one nearly so? */
static enum bead_error no_kind(const struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_suggest search;
    char near[96];
    for (size_t i = 0; i + 1 < at->node->count; i += 2) {
        struct bead_at key = {at, at->node->items[i]->text, 0, at->node->items[i]};
        bead_suggest_begin(&search, key.key);
        for (size_t k = 0; k < BEAD_OUTPUT_KINDS; k++)
            bead_suggest_try(&search, kinds[k]);
        if (search.best)
            return bead_wrong(reader, &key, "unknown key%s", bead_suggest_text(&search, near, sizeof near));
    }
    return bead_wrong(
        reader, at,
        "has no kind; must have one of the keys trajectory, image, movie, plot, table, sweep or sheet, with a file's name");
}

static enum bead_error check_times(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "time");
    double until = reader->scene->simulate.until;
    const char *unit = bead_scene_plain(reader->scene) ? "" : " s";
    if (output->time[0] >= output->time[1])
        return bead_wrong(reader, &where, "is [%g, %g]%s; the first must be before the second", output->time[0], output->time[1],
                          unit);
    if (output->time[0] >= until)
        return bead_wrong(reader, &where, "begins at %g%s; must begin before the run ends at %g%s", output->time[0], unit, until,
                          unit);
    where = bead_at_key(at, "at");
    if (output->at > until)
        return bead_wrong(reader, &where, "is %g%s; must not be later than the end of the run at %g%s", output->at, unit, until,
                          unit);
    return BEAD_OK;
}

static bool is_given(const struct bead_at *at, const char *key)
{
    return bead_at_key(at, key).node != at->node;
}

/* Keys of views that show a moment, in pictures without one. */
static enum bead_error check_moment(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    bool beads = bead_views_any(output->views, output->view_count, BEAD_SHOWS_BEADS);
    bool moment = !bead_views_all(output->views, output->view_count, BEAD_SHOWS_ALL_TIMES);
    if (output->kind != BEAD_OUTPUT_IMAGE || output->panel_count > 0)
        return BEAD_OK;
    struct bead_at where = bead_at_key(at, "at");
    if (!moment && !isnan(output->at))
        return bead_wrong(reader, &where,
                          "is a moment, but the picture shows all times: add beads or profile to `views`, or give `time` instead");
    where = bead_at_key(at, "magnify");
    return beads || output->magnify == 0 ? BEAD_OK
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
        output->fields = known;
    if (!is_given(at, "field"))
        output->field = shown;
    if (!is_given(at, "scale"))
        output->scale = BEAD_SCALE_LINEAR;
    if (is_given(at, "views") || has_beads(scene))
        return;
    size_t kept = 0;
    for (size_t i = 0; i < output->view_count; i++) {
        if (!bead_views_any(&output->views[i], 1, BEAD_SHOWS_BEADS))
            output->views[kept++] = output->views[i];
    }
    output->view_count = kept;
}

/* What equations do not have. */
static enum bead_error check_equations(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "show");
    bool shows = output->kind == BEAD_OUTPUT_TABLE || output->kind == BEAD_OUTPUT_PLOT;
    if (bead_scene_plain(reader->scene) && shows && (output->show == BEAD_SHOW_PEAKS || output->show == BEAD_SHOW_BEAD_PEAKS))
        return bead_wrong(reader, &where, "peaks are those of contacts between beads, which equations do not have");
    if (bead_scene_plain(reader->scene) && output->kind == BEAD_OUTPUT_TABLE && output->show == BEAD_SHOW_CHAIN)
        return bead_wrong(reader, &where, "lists beads and contacts, which equations do not have");
    where = bead_at_key(at, "follow");
    if (bead_scene_plain(reader->scene) && output->kind == BEAD_OUTPUT_MOVIE && output->follow == BEAD_FOLLOW_FRONT)
        return bead_wrong(reader, &where, "is set, but there is no front of a wave in a chain at rest that could be followed");
    where = bead_at_key(at, "views");
    if (bead_views_any(output->views, output->view_count, BEAD_SHOWS_BEADS) && !has_beads(reader->scene))
        return bead_wrong(reader, &where, "beads are not there to be seen: the equation has none; must be profile or spacetime");
    return BEAD_OK;
}

static bool is_drawing(const struct bead_output *output)
{
    return output->kind == BEAD_OUTPUT_PLOT &&
           (output->show == BEAD_SHOW_SETUP || output->show == BEAD_SHOW_CONTACT || output->show == BEAD_SHOW_CELL);
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
static enum bead_error check_drawing(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    static const char *const of_runs[] = {"every", "time", "scale", "trust", "normalise", "range", "modes", "field", "at"},
                             *const of_contacts[] = {"contact", "compression"};
    const struct bead_scene *scene = reader->scene;
    struct bead_at where;
    for (size_t i = 0; i < 2 && output->kind == BEAD_OUTPUT_PLOT && output->show != BEAD_SHOW_CONTACT; i++) {
        where = bead_at_key(at, of_contacts[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `show: contact`");
    }
    for (size_t i = 0; i < sizeof of_runs / sizeof *of_runs && is_drawing(output); i++) {
        where = bead_at_key(at, of_runs[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `show: sensors` or `show: peaks`; nothing is computed for a drawing");
    }
    where = bead_at_key(at, "show");
    for (size_t c = 0; c < scene->chain_count && is_drawing(output); c++) {
        if (scene->chains[c].equation.name)
            return bead_wrong(reader, &where, "draws beads, but there are none in `%s`", scene->chains[c].equation.name);
    }
    if (is_drawing(output) && output->show == BEAD_SHOW_CELL && !has_cells(scene))
        return bead_wrong(reader, &where, "draws cells, but no chain has a `cell` of two or more beads");
    if (!is_drawing(output) || output->show != BEAD_SHOW_CONTACT || output->contact == BEAD_CONTACT_AUTO)
        return BEAD_OK;
    size_t last = bead_scene_count_beads(&scene->chains[0]) - (scene->chains[0].wall == BEAD_WALL_NONE);
    where = bead_at_key(at, "contact");
    return output->contact <= last ? BEAD_OK
                                   : bead_wrong(reader, &where, "is %zu, but the last contact is %zu", output->contact, last);
}

/* Only fields that every chain has. */
static enum bead_error check_fields(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    unsigned known = bead_scene_fields(reader->scene), asked = 0;
    char all[120] = "";
    struct bead_at where = bead_at_key(at, output->kind == BEAD_OUTPUT_TRAJECTORY ? "fields" : "field");
    bool profiles = output->kind == BEAD_OUTPUT_TABLE && output->show == BEAD_SHOW_PROFILES;
    if (output->kind == BEAD_OUTPUT_IMAGE || output->kind == BEAD_OUTPUT_MOVIE || output->kind == BEAD_OUTPUT_SHEET || profiles)
        asked = BEAD_FIELD_BIT(output->field);
    else if (output->kind == BEAD_OUTPUT_TRAJECTORY)
        asked = output->fields;
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
    return bead_wrong(reader, &where, "there is no %s in %s; there is %s", missing,
                      reader->scene->chain_count > 1 ? "every chain" : "this chain", all);
}

/* Sizes that belong to a style, where the output asks for none. */
static void style_size(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    static const double one_column[] = {86e-3, 64e-3}, page_wide[] = {178e-3, 90e-3}, several_panels[] = {178e-3, 120e-3},
                        screen[] = {1920, 1080};
    const double *paper = output->panel_count > 0 ? several_panels : reader->scene->chain_count > 1 ? page_wide : one_column;
    if (output->style == BEAD_STYLE_AUTO || bead_at_key(at, "size").node != at->node)
        return;
    output->size_is_length = output->style == BEAD_STYLE_PAPER;
    for (size_t i = 0; i < 2; i++)
        output->size[i] = output->size_is_length ? paper[i] : screen[i];
}

/* Trust shows in views of all times, and needs room for its words. */
static enum bead_error check_trust(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "trust");
    bool shows = output->kind == BEAD_OUTPUT_PLOT || bead_views_any(output->views, output->view_count, BEAD_SHOWS_ALL_TIMES);
    if (!output->trust)
        return BEAD_OK;
    if (output->kind == BEAD_OUTPUT_PLOT && output->show != BEAD_SHOW_SENSORS)
        return bead_wrong(reader, &where,
                          "is set, but peaks of the first passage do not tell times apart; it belongs to "
                          "`show: sensors`");
    if (output->kind != BEAD_OUTPUT_PLOT && !output->axes)
        return bead_wrong(reader, &where, "is set, but `axes: false` leaves pixels bare and no room for its line of text");
    return shows ? BEAD_OK : bead_wrong(reader, &where, "is set, but no view shows all times: add spacetime or sensors to `views`");
}

/* Past any `./` and `/` that name nothing. */
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

/* Is `path` written by one of the first `count` outputs, or as the poster of one? */
static bool is_taken(const struct bead_output *outputs, size_t count, const char *path)
{
    bool taken = false;
    for (size_t i = 0; i < count; i++)
        taken = taken || same_path(outputs[i].path, path) || (outputs[i].poster && *path && same_path(outputs[i].poster, path));
    return taken;
}

/* Every file is written once. */
static enum bead_error check_paths(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_output *outputs = reader->scene->outputs, *output = &outputs[index];
    const char *poster = output->poster ? output->poster : "";
    struct bead_at where = bead_at_key(at, kinds[output->kind]);
    if (is_taken(outputs, index, output->path))
        return bead_wrong(reader, &where, "`%s` is the file of another output, too; names must differ", output->path);
    where = bead_at_key(at, "poster");
    if (*poster && (is_taken(outputs, index, poster) || same_path(output->path, poster)))
        return bead_wrong(reader, &where, "`%s` is the file of another output, too; names must differ", poster);
    return BEAD_OK;
}

static enum bead_error check_show(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    return is_drawing(output) || output->panel_count > 0 ? BEAD_OK : bead_output_check_show(reader, at, output);
}

enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at, unsigned form,
                                          struct bead_output *output)
{
    static enum bead_error (*const checks[])(const struct bead_reader *, const struct bead_at *, const struct bead_output *) = {
        check_equations, check_times, check_moment, check_drawing, check_show, check_trust, bead_output_check_panels};
    enum bead_error err = bead_options_read(reader, at, &bead_output_options, form, output);
    if (err)
        return err;
    style_size(reader, at, output);
    fit_equations(reader, at, output);
    err = check_fields(reader, at, output);
    if (!err && reader->scene->sweep_count > 0)
        return bead_output_check_sweep_shown(reader, at, output);
    for (size_t i = 0; !err && i < sizeof checks / sizeof checks[0]; i++)
        err = checks[i](reader, at, output);
    return err;
}

static enum bead_error read_output(struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    struct bead_output *outputs = reader->scene->outputs, *output = &outputs[index];
    unsigned form = 0;
    output->place = at->node->place;
    enum bead_error err = find_kind(reader, at, output, &form);
    if (!err && !form)
        return no_kind(reader, at);
    if (!err)
        err = bead_output_check_sweep(reader, at, index);
    if (!err)
        err = bead_output_read_settings(reader, at, form, output);
    if (!err && output->kind == BEAD_OUTPUT_MOVIE)
        err = bead_output_check_movie(reader, at, output);
    return err ? err : check_paths(reader, at, index);
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
    for (size_t i = 0; i < at->node->count && !err; i++) {
        size_t files = bead_output_files(at->node->items[i]);
        for (size_t k = 0; k < files && !err; k++) {
            struct bead_at element = {at, NULL, i, bead_output_of_file(reader, at->node->items[i], k)};
            err = element.node ? read_output(reader, &element, read++) : bead_no_memory(reader);
        }
    }
    return err;
}
