/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Readers of values of outputs' keys that are more than a number, a word or a choice. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/text.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

bool bead_output_ends_like(const char *endings, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    for (const char *known = endings; dot && dot > base && known; known = strchr(known + 1, '.')) {
        if (strcspn(known, ", ") == strlen(dot) && strncasecmp(known, dot, strlen(dot)) == 0)
            return true;
    }
    return false;
}

/* "; did you mean `movie: a.mp4`?": the first kind of output with this ending of files; "": none. */
static const char *suggest_kind(const struct bead_reader *reader, const char *path, char *text, size_t size)
{
    const struct bead_options *table;
    *text = '\0';
    for (size_t i = 0; reader->tables && (table = reader->tables->table(i)); i++) {
        const bool kind = table->family && strcmp(table->family->section, "outputs") == 0 && table->rows[0].shape;
        if (kind && bead_output_ends_like(strchr(table->rows[0].shape, '.'), path)) {
            snprintf(text, size, "; did you mean `%s: %s`?", table->rows[0].key, path);
            break;
        }
    }
    return text;
}

BEAD_OPTION_READER(bead_output_read_path)
{
    struct bead_output *output = settings;
    BEAD_TRY(bead_read_text(reader, at, &output->path));
    size_t length = strlen(output->path);
    if (length == 0)
        return bead_wrong(reader, at, "is empty; must be the name of a file");
    if (output->path[length - 1] == '/')
        return bead_wrong(reader, at, "ends in `/`; must be the name of a file, not of a directory");
    const char *endings = strchr(option->shape, '.');
    char shown[64], near[128];
    if (bead_output_ends_like(endings, output->path))
        return BEAD_OK;
    bead_text_show(output->path, shown, sizeof shown);
    return bead_wrong(reader, at, "`%s` lacks the extension of files of this kind; must be a name with %s%s", shown, endings,
                      suggest_kind(reader, shown, near, sizeof near));
}

/* Index of the element's name among `names`, at most once in a list: bits of those before are in *seen. */
static enum bead_error read_name(const struct bead_reader *reader, const struct bead_at *list, size_t index,
                                 const char *const *names, unsigned *seen, unsigned *found)
{
    struct bead_at element = bead_at_item(list, index);
    BEAD_TRY(bead_read_choice(reader, &element, names, found));
    if (*seen >> *found & 1)
        return bead_wrong(reader, &element, "`%s` is in the list twice", names[*found]);
    *seen |= 1u << *found;
    return BEAD_OK;
}

static enum bead_error need_list(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option)
{
    const bool list = at->node->kind == BEAD_NODE_LIST && at->node->count > 0;
    return list ? BEAD_OK : bead_must_be(reader, at, option->shape);
}

BEAD_OPTION_READER(bead_output_read_fields)
{
    const char *names[BEAD_FIELD_COUNT + 1] = {NULL};
    struct bead_output *output = settings;
    unsigned found = 0;
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
        names[f] = bead_field_info((enum bead_field)f)->name;
    if (at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, "all") == 0) {
        output->trajectory.fields = bead_scene_fields(reader->scene);
        return BEAD_OK;
    }
    BEAD_TRY(need_list(reader, at, option));
    for (size_t i = 0; i < at->node->count; i++)
        BEAD_TRY(read_name(reader, at, i, names, &output->trajectory.fields, &found));
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_views)
{
    const char *names[BEAD_CHOICES + 1] = {NULL};
    struct bead_output *output = settings;
    unsigned seen = 0, found = 0;
    output->views.own = reader->scene->own.views;
    for (unsigned i = 0; i < BEAD_CHOICES && (i < BEAD_VIEW_KINDS || (output->views.own && output->views.own[i - BEAD_VIEW_KINDS]));
         i++)
        names[i] = bead_views_info(&(struct bead_views_asked){.kinds = {i}, .own = output->views.own}, 0)->name;
    BEAD_TRY(need_list(reader, at, option));
    for (size_t i = 0; i < at->node->count; i++) {
        BEAD_TRY(read_name(reader, at, i, names, &seen, &found));
        output->views.kinds[output->views.count++] = found;
        if (bead_views_info(&output->views, output->views.count - 1)->traits & BEAD_SHOWS_SENSORS && !reader->unsound &&
            !bead_scene_has_sensors(reader->scene, SIZE_MAX))
            return bead_wrong(reader, at, "shows sensors, but no bead of the chain has a `sensor`");
    }
    return BEAD_OK;
}

/* `each`: in chains of different lengths `last` is the last one of each. */
static enum bead_error read_place(const struct bead_reader *reader, const struct bead_at *at, bool contact, bool each,
                                  size_t *index)
{
    const struct bead_scene *scene = reader->scene;
    const bool any = scene->sweep_count == 1 && scene->sweeps[0].over.key_count > 0; /* chains may be of any length */
    size_t last[2] = {SIZE_MAX, 0}; /* of the chains that have the fewest and the most */
    for (size_t c = 0; c < scene->chain_count && !reader->unsound; c++) {
        const size_t of_chain = bead_scene_last_bead(scene, c) - (contact && scene->chains[c].wall == BEAD_WALL_NONE);
        last[0] = of_chain < last[0] ? of_chain : last[0];
        last[1] = of_chain > last[1] ? of_chain : last[1];
    }
    const struct bead_option row = {
        .type = BEAD_OPTION_COUNT, .low = 0, .high = BEAD_SCENE_BEADS, .word = "last", .word_value = (double)last[1]};
    BEAD_TRY(bead_read_count(reader, at, &row, index));
    const bool word = at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, "last") == 0;
    if (word && (any || (each && last[0] < last[1])))
        *index = BEAD_LAST;
    if (any || *index == BEAD_LAST)
        return BEAD_OK;
    if (last[0] < last[1] && word)
        return bead_wrong(reader, at, "is last, which is %zu in one chain and %zu in another; must be a number here", last[0],
                          last[1]);
    if (*index > last[1] && !reader->unsound)
        return bead_wrong(reader, at, "is %zu, but the last %s is %zu", *index, contact ? "contact" : "bead", last[1]);
    return BEAD_OK;
}

enum bead_error bead_output_read_place(const struct bead_reader *reader, const struct bead_at *at, bool contact, size_t *index)
{
    return read_place(reader, at, contact, false, index);
}

static int ascending(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

/* "10..20": its ends, as the places of scalars of their own. */
struct run {
    struct bead_node nodes[2];
    struct bead_at ends[2];
    bool is;
};

static enum bead_error split_run(const struct bead_reader *reader, const struct bead_at *at, struct run *run)
{
    const char *text = at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "", *dots = strstr(text, "..");
    run->is = dots;
    for (size_t i = 0; dots && i < 2; i++) {
        const char *from = i == 0 ? text : dots + 2;
        run->nodes[i] = *at->node;
        run->nodes[i].text = bead_yaml_text(reader->yaml, from, i == 0 ? (size_t)(dots - text) : strlen(from));
        run->ends[i] = (struct bead_at){at->up, at->key, at->index, &run->nodes[i]};
        if (!run->nodes[i].text)
            return bead_no_memory(reader);
    }
    return BEAD_OK;
}

static bool is_auto(const struct bead_at *at)
{
    return at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, "auto") == 0;
}

/* The first and the last of an entry, which may be one place. */
static enum bead_error read_places(const struct bead_reader *reader, const struct bead_at *at, bool contact, size_t ends[2])
{
    enum { MOST = 100000 };
    struct run run;
    BEAD_TRY(split_run(reader, at, &run));
    if (!run.is) {
        BEAD_TRY(read_place(reader, at, contact, true, &ends[0]));
        ends[1] = ends[0];
        return BEAD_OK;
    }
    if (is_auto(&run.ends[0]))
        run.nodes[0].text = "0";
    if (is_auto(&run.ends[1]))
        run.nodes[1].text = "last";
    for (size_t i = 0; i < 2; i++)
        BEAD_TRY(read_place(reader, &run.ends[i], contact, false, &ends[i]));
    if (ends[1] == BEAD_LAST || ends[0] > ends[1] || ends[1] - ends[0] >= MOST)
        return bead_wrong(reader, at, "must rise from one number to another, and have at most %d places", MOST);
    return BEAD_OK;
}

static enum bead_error add_places(const struct bead_reader *reader, const struct bead_at *at, bool contact,
                                  struct bead_listed *listed)
{
    size_t ends[2];
    BEAD_TRY(read_places(reader, at, contact, ends));
    size_t *all = realloc(listed->all, (listed->count + ends[1] - ends[0] + 1) * sizeof *all);
    if (!all)
        return bead_no_memory(reader);
    listed->all = all;
    for (size_t place = ends[0];; place++) {
        all[listed->count++] = place;
        if (place == ends[1])
            return BEAD_OK;
    }
}

BEAD_OPTION_READER(bead_output_read_listed)
{
    struct bead_listed *listed = (void *)((char *)settings + option->offset);
    const bool contact = strcmp(option->key, "contacts") == 0, scalar = at->node->kind == BEAD_NODE_SCALAR;
    const size_t entries = scalar ? 1 : at->node->count;
    if (at->node->kind == BEAD_NODE_MAP || entries == 0)
        return bead_must_be(reader, at, option->shape);
    for (size_t i = 0; i < entries; i++) {
        const struct bead_at element = scalar ? *at : bead_at_item(at, i);
        BEAD_TRY(add_places(reader, &element, contact, listed));
    }
    const size_t count = listed->count;
    size_t *all = listed->all;
    qsort(all, count, sizeof *all, ascending);
    listed->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || all[i] != all[i - 1])
            all[listed->count++] = all[i];
    }
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_beads)
{
    struct bead_output *output = settings;
    struct run run;
    BEAD_TRY(split_run(reader, at, &run));
    const bool scalar = at->node->kind == BEAD_NODE_SCALAR && !run.is,
               pair = run.is || (at->node->kind == BEAD_NODE_LIST && at->node->count == 2);
    if (scalar && strcmp(at->node->text, "all") == 0) {
        output->shown.beads = (struct bead_span){0, SIZE_MAX};
        return BEAD_OK;
    }
    if ((!scalar && !pair) ||
        (scalar && at->node->text[0] && !strchr("+-.0123456789", at->node->text[0]) && strcmp(at->node->text, "last") != 0))
        return bead_must_be(reader, at, option->shape);
    if (scalar) {
        BEAD_TRY(bead_output_read_place(reader, at, false, &output->shown.beads.first));
        output->shown.beads.last = output->shown.beads.first;
        return BEAD_OK;
    }
    const struct bead_at first = run.is ? run.ends[0] : bead_at_item(at, 0), last = run.is ? run.ends[1] : bead_at_item(at, 1);
    output->shown.beads = (struct bead_span){0, SIZE_MAX};
    BEAD_TRY(is_auto(&first) ? BEAD_OK : bead_output_read_place(reader, &first, false, &output->shown.beads.first));
    BEAD_TRY(is_auto(&last) ? BEAD_OK : bead_output_read_place(reader, &last, false, &output->shown.beads.last));
    if (output->shown.beads.first > output->shown.beads.last)
        return bead_wrong(reader, at, "is [%zu, %zu]; the first must not be greater than the last", output->shown.beads.first,
                          output->shown.beads.last);
    return BEAD_OK;
}

/* One of the two sizes: a plain number is in pixels, a length in metres. */
static enum bead_error read_extent(const struct bead_reader *reader, const struct bead_at *at, double *value, bool *length)
{
    static const struct bead_option pixels = {.type = BEAD_OPTION_COUNT,
                                              .low = 1,
                                              .high = 32768,
                                              .shape = "a whole number of pixels from 1 to 32768, or a length from 1 mm to 5 m"},
                                    metres = {.unit = "m",
                                              .low = 1e-3,
                                              .high = 5,
                                              .shape = "a length from 1 mm to 5 m, or a whole number of pixels from 1 to 32768"};
    bool scalar = at->node->kind == BEAD_NODE_SCALAR;
    double plain = 0;
    char why[120];
    *length = scalar && bead_units_read(reader->units, at->node->text, NULL, &plain, why, sizeof why) != BEAD_OK &&
              bead_units_read(reader->units, at->node->text, "m", &plain, why, sizeof why) == BEAD_OK;
    return bead_read_number(reader, at, *length ? &metres : &pixels, value);
}

enum bead_error bead_output_check_size(const struct bead_reader *reader, const struct bead_at *at, const struct bead_paper *paper)
{
    double scale = paper->size_is_length ? paper->dpi / 0.0254 : 1, width = paper->size[0] * scale, height = paper->size[1] * scale;
    if (!(fmin(width, height) >= 1) || fmax(width, height) > 32768 || width * height > 5e8)
        return bead_wrong(reader, at, "is %.0f x %.0f pixels; must be from 1 to 32768 each way and at most 5e8 in all", width,
                          height);
    return BEAD_OK;
}

static enum bead_error read_extents(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                    struct bead_paper *paper)
{
    bool length[2] = {false, false};
    if (at->node->kind != BEAD_NODE_LIST || at->node->count != 2)
        return bead_must_be(reader, at, option->shape);
    for (size_t i = 0; i < 2; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(read_extent(reader, &element, &paper->size[i], &length[i]));
    }
    if (length[0] != length[1])
        return bead_wrong(reader, at, "mixes pixels and a length; must be %s", option->shape);
    paper->size_is_length = length[0];
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_size)
{
    struct bead_output *output = settings;
    if (at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, "auto") == 0)
        return BEAD_OK; /* settled when the style and the panels are known */
    BEAD_TRY(read_extents(reader, at, option, &output->paper));
    return bead_output_check_size(reader, at, &output->paper);
}

BEAD_OPTION_READER(bead_output_read_frame_size)
{
    struct bead_output *output = settings;
    BEAD_TRY(read_extents(reader, at, option, &output->paper));
    if (output->paper.size_is_length)
        return bead_wrong(reader, at, "is a length; the size of a movie must be in pixels, such as [1920, 1080]");
    return bead_output_check_size(reader, at, &output->paper);
}

/* [low, high] in `unit`; "": plain numbers. */
static enum bead_error read_range(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  const char *unit, enum bead_scale scale, double range[2])
{
    const struct bead_option number = {.unit = *unit ? unit : NULL, .word = option->word, .word_value = option->word_value};
    const char *space = *unit ? " " : "";
    BEAD_TRY(bead_read_pair(reader, at, &number, option->shape, range));
    if (range[0] >= range[1])
        return bead_wrong(reader, at, "is [%g, %g]%s%s; the first must be below the second", range[0], range[1], space, unit);
    for (int i = 0; i < 2 && scale == BEAD_SCALE_LOG; i++) {
        if (range[i] <= 0)
            return bead_wrong(reader, at, "%s at %g%s%s; must be above 0 with `scale: log`", i ? "ends" : "begins", range[i], space,
                              unit);
    }
    return BEAD_OK;
}

static const char *unit_of(const struct bead_reader *reader, enum bead_field field)
{
    return *bead_scene_system(reader->scene)->time_unit ? bead_field_info(field)->unit : "";
}

/* Longer than other texts: 1024 colours. The program that draws knows the names. */
BEAD_OPTION_READER(bead_output_read_colormap)
{
    char **map = (char **)(void *)((char *)settings + option->offset);
    const char *text = NULL;
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    free(*map);
    *map = strdup(text);
    return *map ? BEAD_OK : bead_no_memory(reader);
}

BEAD_OPTION_READER(bead_output_read_colour_range)
{
    struct bead_output *output = settings;
    struct bead_colours_asked *colours = &output->colours;
    return read_range(reader, at, option, unit_of(reader, output->shown.field), colours->scale, colours->range);
}

BEAD_OPTION_READER(bead_output_read_plot_range)
{
    struct bead_output *output = settings;
    struct bead_plot_asked *plot = &output->plot;
    const char *unit = plot->normalise == BEAD_NORMALISE_NONE ? unit_of(reader, output->shown.field) : "";
    return read_range(reader, at, option, unit, plot->scale, plot->range);
}

BEAD_OPTION_READER(bead_output_read_sweep_range)
{
    struct bead_output *output = settings;
    const bool colours = output->sweep_curves.show == BEAD_SWEEP_PLANE; /* of values on axes with this scale */
    return read_range(reader, at, option, "", colours ? BEAD_SCALE_LINEAR : output->plot.scale, output->plot.range);
}
