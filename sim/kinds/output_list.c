/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `outputs`: the list, with the kind and the files of each entry. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/sink.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"

enum { MOST_OUTPUTS = 1000 };

/* ---- outputs of the program's own ---- */

static enum bead_error check_sink(const struct bead_sink_type *s, struct bead_message *msg)
{
    if (!s->name || !*s->name || !s->endings || !strchr(s->endings, '.') || s->kind != BEAD_OUTPUT_OWN)
        return bead_fail(msg, BEAD_ERROR_USAGE, "sink `%s`: needs a name, endings such as \".txt\", and the kind BEAD_OUTPUT_OWN",
                         s->name ? s->name : "");
    if (!s->create || !s->needs || !s->begin || !s->sample || !s->end || !s->destroy)
        return bead_fail(msg, BEAD_ERROR_USAGE, "sink `%s`: one of create, needs, begin, sample, end and destroy is missing",
                         s->name);
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        if (strcmp(s->name, bead_output_key(kind)) == 0)
            return bead_fail(msg, BEAD_ERROR_USAGE, "sink `%s`: the library has outputs of this name", s->name);
    }
    return BEAD_OK;
}

enum bead_error bead_output_check_own(const struct bead_own *own, struct bead_message *msg)
{
    for (const struct bead_sink_type *const *sink = own->sinks; sink && *sink; sink++)
        BEAD_TRY(check_sink(*sink, msg));
    return BEAD_OK;
}

/* The own sink that the entry names by a key; NULL: none. */
static const struct bead_sink_type *find_own(const struct bead_reader *reader, const struct bead_at *at)
{
    const struct bead_sink_type *const *sink = reader->scene->own.sinks;
    while (sink && *sink && !bead_node_get(at->node, (*sink)->name, NULL))
        sink++;
    return sink ? *sink : NULL;
}

static enum bead_error read_own(struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    struct bead_option row = bead_own_output.options->rows[0];
    row.key = output->own->name;
    row.shape = output->own->endings;
    const struct bead_options own = {row.key, output->own->help, &row, 1, bead_own_output.options->shared, &bead_output_family};
    struct bead_output_type type = bead_own_output;
    type.options = &own;
    return bead_output_read_settings(reader, at, &type, output);
}

/* ---- an entry ---- */

/* Finds the kind: the one key of the map that names one. */
static enum bead_error find_kind(const struct bead_reader *reader, const struct bead_at *at, struct bead_output *output)
{
    size_t found = 0;
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_must_be(reader, at, "a map such as {image: force.png}");
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        if (!bead_given(at, bead_output_key(kind)))
            continue;
        if (found++ > 0)
            return BEAD_WRONG_KEY(reader, at, bead_output_key(kind), "is a second kind beside `%s`; give each file its own entry",
                                  bead_output_key(output->kind));
        output->kind = kind;
    }
    if (found > 0)
        return BEAD_OK;
    output->own = find_own(reader, at);
    output->kind = BEAD_OUTPUT_OWN;
    if (output->own)
        return BEAD_OK;
    /* No key is the name of a kind: is one similar? */
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
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
        bead_list_add(all, sizeof all, kind + 1 < BEAD_OUTPUT_KINDS ? ", " : " or ", bead_output_key(kind));
    return bead_wrong(reader, at, "has no kind; must have one of the keys %s, with a file's name", all);
}

/* Does output `index`, of a kind known already, go with the scene's sweeps, or with none? */
static enum bead_error check_sweep(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_output *outputs = scene->outputs;
    const struct bead_output_type *type = bead_output_type(outputs[index].kind);
    const char *key = bead_output_kind_name(&outputs[index]);
    if (!type->options && scene->sweep_count == 0)
        return BEAD_WRONG_KEY(reader, at, key, "needs a sweep: the scene has neither `sweep` nor `sweeps`");
    if (scene->sweep_count > 0 && !type->sweep_options)
        return BEAD_WRONG_KEY(
            reader, at, key,
            "shows a single run, and a sweep has many; must be sweep, sheet, image, plot, table or report (--configuration "
            "N shows one run of a "
            "sweep's file)");
    for (size_t i = 0; i < index && type->stores_sweep; i++) {
        if (outputs[i].kind == outputs[index].kind)
            return BEAD_WRONG_KEY(reader, at, key, "is a second file of the same results; one is enough");
    }
    return BEAD_OK;
}

/* Skips every `./` and `/` that adds nothing to a path. */
static const char *skip(const char *path)
{
    while (path[0] == '.' && path[1] == '/')
        path += 2 + strspn(path + 2, "/");
    return path;
}

/* Do both paths lead to the same file? They may differ in `./` and `//`. */
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

/* No two outputs may write the same file. */
static enum bead_error check_paths(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_output *outputs = reader->scene->outputs, *output = &outputs[index];
    const char *key, *second = bead_output_second(output, &key);
    if (is_taken(outputs, index, output->path))
        return BEAD_WRONG_KEY(reader, at, bead_output_kind_name(output),
                              "`%s` is the file of another output, too; names must differ", output->path);
    if (*second && (is_taken(outputs, index, second) || same_path(output->path, second)))
        return BEAD_WRONG_KEY(reader, at, key, "`%s` is the file of another output, too; names must differ", second);
    return BEAD_OK;
}

static enum bead_error read_output(struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    struct bead_output *output = &reader->scene->outputs[index];
    *output = bead_output_automatic;
    output->file = reader->scene->file;
    output->node = at->node;
    output->entry = at->index;
    BEAD_TRY(find_kind(reader, at, output));
    BEAD_TRY(check_sweep(reader, at, index));
    BEAD_TRY(output->own ? read_own(reader, at, output)
                         : bead_output_read_settings(reader, at, bead_output_type(output->kind), output));
    return check_paths(reader, at, index);
}

/* ---- the list ---- */

/* The position in the entry's map of its list of files; 0: it names one file. */
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

/* An output that names several files, {plot: [a.pdf, a.png], ...}, is that many outputs; 0: its list is empty. */
static size_t files_of(const struct bead_node *entry)
{
    size_t list = find_list(entry);
    return list ? entry->items[list]->count : 1;
}

/* The entry for one of its files; NULL: no memory. */
static struct bead_node *entry_of(const struct bead_reader *reader, struct bead_node *entry, size_t file)
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

static enum bead_error count_files(const struct bead_reader *reader, const struct bead_at *at, size_t *count)
{
    *count = 0;
    for (size_t i = 0; i < at->node->count; i++) {
        size_t files = files_of(at->node->items[i]);
        struct bead_at element = bead_at_item(at, i);
        if (files == 0)
            return bead_wrong(reader, &element, "names no file: its list is empty");
        *count += files;
    }
    if (*count == 0 || *count > MOST_OUTPUTS)
        return bead_wrong(reader, at, "has %zu entries; must have from 1 to %d", *count, MOST_OUTPUTS);
    return BEAD_OK;
}

enum bead_error bead_scene_read_outputs(struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_scene *scene = reader->scene;
    size_t count = 0, read = 0;
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_must_be(reader, at, "a list such as [{image: force.png}]");
    BEAD_TRY(count_files(reader, at, &count));
    BEAD_TRY(bead_new(&scene->outputs, count, reader->msg, "outputs"));
    scene->output_count = count;
    enum bead_error err = BEAD_OK, kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i < at->node->count; i++) {
        size_t files = files_of(at->node->items[i]);
        err = BEAD_OK;
        for (size_t k = 0; k < files && !err; k++) {
            struct bead_at element = {at, NULL, i, entry_of(reader, at->node->items[i], k)};
            err = element.node ? read_output(reader, &element, read++) : bead_no_memory(reader);
        }
    }
    return kept;
}
