/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options: one const table for each settings structure. Parser, help text, man page and error messages come from it. This room
 * knows tables and documents, but none of the structures. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "beadreel/error.h"
#include "sim/base/units.h"
#include "sim/yaml/yaml.h"

/* The type of a value in its structure. */
enum bead_option_type {
    BEAD_OPTION_NUMBER, /* double */
    BEAD_OPTION_PAIR,   /* double[2], written [a, b] */
    BEAD_OPTION_COUNT,  /* size_t */
    BEAD_OPTION_SEED,   /* uint64_t */
    BEAD_OPTION_FLAG,   /* bool */
    BEAD_OPTION_TEXT,   /* char *, owned by the structure */
    BEAD_OPTION_CHOICE, /* an enum, in the order of `choices` */
    BEAD_OPTION_MAP,    /* a structure with a table of its own, `map` */
    BEAD_OPTION_CUSTOM  /* whatever `read` makes of it */
};

/* A place in the document on the way down: for the key path and the line and column of messages. */
struct bead_at {
    const struct bead_at *up;
    const char *key; /* NULL: an element of a list */
    size_t index;
    const struct bead_node *node;
};

struct bead_options;
struct bead_scene;

/* All tables of a document, for messages about a key in the wrong place. */
struct bead_option_tables {
    const struct bead_options *(*table)(size_t index);      /* NULL after the last */
    bool (*home)(const char *key, char *text, size_t size); /* where a key belongs that is not one of the top: "chain.wall" */
};

/* State shared by all parts of the parser. */
struct bead_reader {
    const struct bead_option_tables *tables; /* NULL: messages know of no other table */
    struct bead_yaml *yaml;
    struct bead_yaml *scratch; /* where default values are parsed */
    struct bead_units *units;
    struct bead_scene *scene;      /* being filled, by the tables' own readers */
    struct bead_chain_spec *shown; /* what outputs are checked against; NULL: the scene's chains */
    size_t shown_count;
    struct bead_message *msg;
    struct bead_faults *faults; /* NULL: the first is the only one */
    struct bead_faults *doubts; /* numbers without a unit that can hardly be meant; NULL: they are not collected */
    bool unsound;               /* the chains are wrong: nothing can be checked against them */
    bool without_units;         /* the system has none: see bead_option.of_motion */
};

/* The errors of a scene: one line each, as many as fit. */
struct bead_faults {
    size_t count;
    struct bead_message lines;
};
/* Call it after reading an element: keeps the error of the whole, and returns whether to read the next. */
bool bead_reads_on(const struct bead_reader *reader, enum bead_error err, enum bead_error *kept);

enum { BEAD_OPEN_LOW = 1, BEAD_OPEN_HIGH = 2 }; /* the limit itself is not allowed */

/* A reader of a custom value into the structure `settings`. It need not use all that it is given. */
#define BEAD_UNUSED __attribute__((unused))
#define BEAD_OPTION_READER(name)                                                                       \
    enum bead_error name(BEAD_UNUSED struct bead_reader *reader, BEAD_UNUSED const struct bead_at *at, \
                         BEAD_UNUSED const struct bead_option *option, BEAD_UNUSED void *settings)

/* A row gives its key, type and place in this order, and other members by name. */
struct bead_option {
    const char *key;
    enum bead_option_type type;
    size_t offset;       /* of the value in its structure */
    const char *unit;    /* SI, of plain numbers; NULL: numbers without unit */
    const char *initial; /* default, as in a scene; NULL: none */
    const char *example; /* a value for the man page; flags and choices need none */
    bool required;
    double low, high; /* allowed; both 0: anything finite */
    unsigned open;
    /* A number without a unit outside of these (high 0: no limit) is doubted: one of the units is likely to be meant. */
    double usual[2];
    const char *const *likely; /* NULL-terminated, the likeliest first; NULL: never doubted */
    const char *word;          /* allowed instead of a number, and means ... */
    double word_value;
    const char *const *choices; /* NULL-terminated */
    const unsigned *values;     /* what the choices mean; NULL: their index */
    const char *shape;          /* the form of a custom value, or other words for the range of a number */
    const char *help;
    /* The form of a custom value, for the schema: "number", "flag", "text", "any" (also NULL), the heading of a table, or a word
     * that means itself; [lists of], [2 of], {maps of}, and a|b. */
    const char *like;
    bool of_motion;              /* a time of the motion: without a unit if the system has none */
    BEAD_OPTION_READER((*read)); /* of custom values; NULL: those that need the key look it up */
    const struct bead_options *map;
};

/* In rows: a time of the motion. A pulse passes some ten thousand beads in a second. */
#define BEAD_TIME_OF_MOTION .unit = "s", .of_motion = true, .low = 0, .high = 1e6, .usual = {0, 1}, .likely = BEAD_LIKELY("ms")
#define BEAD_LIKELY(...)  \
    (const char *const[]) \
    {                     \
        __VA_ARGS__, NULL \
    }

/* Rows that several tables share; a list of such ends with {NULL, 0}. */
struct bead_option_rows {
    const struct bead_option *rows;
    size_t count;
};

/* Tables of which one reads a map: the kinds of outputs, the equations. A key of another table is not called unknown. */
struct bead_option_family {
    const char *section; /* "outputs": their headings are "outputs (movie)" */
    const char *of;      /* "outputs of kind" */
};

struct bead_options {
    const char *name; /* "chain", as a heading; of a family: "movie", or NULL: has no heading of its own */
    const char *help;
    const struct bead_option *rows; /* keys differ; they are read in this order */
    size_t count;
    const struct bead_option_rows *shared; /* read after these, NULL: none */
    const struct bead_option_family *family;
};
#define BEAD_OPTIONS(rows) rows, sizeof(rows) / sizeof *(rows)

/* The rows by number, shared ones last; NULL after the last. */
const struct bead_option *bead_options_row(const struct bead_options *options, size_t index);
/* The row of a key; NULL: there is none. */
const struct bead_option *bead_options_find(const struct bead_options *options, const char *key);

/* Read the map at `at` into `settings`, defaults included. Members without a row keep their value. Errors: SCENE, MEMORY; what was
 * filled in before stays and is freed with its structure. */
BEAD_CHECK enum bead_error bead_options_read(struct bead_reader *reader, const struct bead_at *at,
                                             const struct bead_options *options, void *settings);

/* "outputs (movie)" into `text`; returns text. */
const char *bead_options_heading(const struct bead_options *options, char *text, size_t size);
/* Describe the rows: as text, or as a part of a man page. */
void bead_options_help(const struct bead_options *options, FILE *out);
void bead_options_man(const struct bead_options *options, FILE *out);

/* Does a number have limits? A count always does, even if they are equal. */
bool bead_option_is_bounded(const struct bead_option *option);
/* "must be ..." of a row: "from 0 to 10000 m/s or auto" into `text`; returns text. */
const char *bead_option_allowed(const struct bead_option *option, char *text, size_t size);

/* Fail with `file:line:column: key.path: ...`. */
enum bead_error bead_wrong(const struct bead_reader *reader, const struct bead_at *at, const char *format, ...) BEAD_PRINTF(3, 4);
/* Warn that a number without a unit is hardly meant in `unit`, but in `likely`. */
void bead_doubt(const struct bead_reader *reader, const struct bead_at *at, const char *unit, const char *likely);
/* Fail at the place of a key in the map at `at`. */
#define BEAD_WRONG_KEY(reader, at, key, ...) bead_wrong(reader, (const struct bead_at[]){bead_at_key(at, key)}, __VA_ARGS__)
/* Two keys of which a map may have one: fails if the map around `at` also has `other`. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_not_beside(const struct bead_reader *reader, const struct bead_at *at, const char *other);
/* Keys that do not belong in this map, ending with NULL, and the reason. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_without(const struct bead_reader *reader, const struct bead_at *at, const char *const *keys,
                                        const char *why);
/* Fail with the value: "is 5; must be WANTED". */
enum bead_error bead_must_be(const struct bead_reader *reader, const struct bead_at *at, const char *wanted);
/* A list of 1 to `most` values, which are called `what` ("entries"). Errors: SCENE. */
BEAD_CHECK enum bead_error bead_need_list(const struct bead_reader *reader, const struct bead_at *at, const char *wanted,
                                          size_t most, const char *what);
enum bead_error bead_no_memory(const struct bead_reader *reader);
/* Does the map at `at` have the key? */
bool bead_given(const struct bead_at *at, const char *key);
/* The place of `key` in the map at `at`: of its value, or of the map if it has none. */
struct bead_at bead_at_key(const struct bead_at *at, const char *key);
/* The place of a list's item; a value that is not a list is its only one. */
struct bead_at bead_at_item(const struct bead_at *at, size_t index);

/* Readers of single values, for custom options. */
BEAD_CHECK enum bead_error bead_read_scalar(const struct bead_reader *reader, const struct bead_at *at, const char *wanted,
                                            const char **text);
BEAD_CHECK enum bead_error bead_read_number(const struct bead_reader *reader, const struct bead_at *at,
                                            const struct bead_option *option, double *value);
/* As above, for a row of counts. */
BEAD_CHECK enum bead_error bead_read_count(const struct bead_reader *reader, const struct bead_at *at,
                                           const struct bead_option *option, size_t *value);
/* A list of two numbers, or the option's word for both; `wanted` says so in messages. */
BEAD_CHECK enum bead_error bead_read_pair(const struct bead_reader *reader, const struct bead_at *at,
                                          const struct bead_option *option, const char *wanted, double value[2]);
enum { BEAD_CHOICES = 30 }; /* the most, where a list of them is made */
BEAD_CHECK enum bead_error bead_read_choice(const struct bead_reader *reader, const struct bead_at *at, const char *const *choices,
                                            unsigned *value);
BEAD_CHECK enum bead_error bead_read_flag(const struct bead_reader *reader, const struct bead_at *at, bool *value);
/* One line of text, for example a key, without control characters or characters reserved by Unicode, that does not turn the text
 * after it. */
BEAD_CHECK enum bead_error bead_check_text(const struct bead_reader *reader, const struct bead_at *at, const char *text);
BEAD_CHECK enum bead_error bead_read_text(const struct bead_reader *reader, const struct bead_at *at, char **text);
