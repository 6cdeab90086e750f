/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All keys of scenes, or those of one section, from the tables that read them. */

#include "sim/base/suggest.h"
#include "sim/kinds/output_kinds.h"
#include "sim/kinds/waves.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

/* In the order of the man page: tables, with those of laws, outputs, equations and their starts. */
static const struct {
    const struct bead_options *options;
    const struct bead_options *(*member)(size_t index);
} all[] = {
    {&bead_scene_options, NULL},      {&bead_chain_options, NULL},    {&bead_striker_options, NULL},
    {&bead_starting_options, NULL},   {&bead_segment_options, NULL},  {&bead_taper_options, NULL},
    {&bead_disorder_options, NULL},   {&bead_wall_options, NULL},     {NULL, bead_law_options},
    {&bead_damping_options, NULL},    {&bead_cradle_options, NULL},   {&bead_drive_options, NULL},
    {&bead_drive_file_options, NULL}, {&bead_material_options, NULL}, {&bead_tolerance_options, NULL},
    {&bead_simulate_options, NULL},   {NULL, bead_output_options},    {&bead_panel_options, NULL},
    {&bead_measured_options, NULL},   {&bead_caption_options, NULL},  {&bead_note_options, NULL},
    {&bead_speed_options, NULL},      {&bead_card_options, NULL},     {NULL, bead_equation_options},
    {&bead_piecewise_options, NULL},  {NULL, bead_start_options},     {&bead_soliton_options, NULL},
    {&bead_sweep_options, NULL},      {&bead_over_options, NULL},     {&bead_sweep_measure_options, NULL},
};

static const struct bead_options *find_table(size_t index)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const struct bead_options *options = all[i].member ? all[i].member(0) : all[i].options;
        for (size_t k = 1; options; options = all[i].member ? all[i].member(k++) : NULL) {
            if (index-- == 0)
                return options;
        }
    }
    return NULL;
}

const struct bead_options *bead_scene_section(size_t index)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = find_table(i)); i++) {
        if (options->name && index-- == 0)
            return options;
    }
    return NULL;
}

static bool find_home(const char *key, char *text, size_t size)
{
    static const struct {
        const char *path;
        const struct bead_options *options;
    } homes[] = {{"chain.", &bead_chain_options},
                 {"chain.striker.", &bead_striker_options},
                 {"simulate.", &bead_simulate_options},
                 {"sweep.", &bead_sweep_options}};
    const char *home = NULL;
    for (size_t i = 0; i < sizeof homes / sizeof *homes && !home; i++)
        home = bead_options_find(homes[i].options, key) ? homes[i].path : NULL;
    const struct bead_options *kind;
    for (size_t i = 0; !home && (kind = bead_output_options(i)); i++)
        home = bead_options_find(kind, key) ? "outputs.N." : NULL;
    if (home)
        snprintf(text, size, "%s%s", home, key);
    return home != NULL;
}

const struct bead_option_tables bead_scene_tables = {find_table, find_home};

void bead_scene_help(FILE *out)
{
    const struct bead_options *options;
    fputs("A scene is a YAML file. A number is in SI units or carries its unit, such as 0.443 m/s, 1.5 ms or 193 GPa.\n", out);
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        fputc('\n', out);
        bead_options_help(options, out);
    }
}

enum { PARTS = 100 }; /* of all headings, at most */

/* The part of a heading after the one at `part`: "chain.law (power)" has chain, law and power. NULL: that was the last. */
static const char *next_part(const char *part)
{
    part += strcspn(part, ".(");
    return *part ? part + 1 : NULL;
}

/* Is `name` one part of the heading, or several in a row? */
static bool has_part(const char *heading, const char *name)
{
    size_t length = strlen(name);
    for (const char *part = heading; part; part = next_part(part)) {
        if (strncmp(part, name, length) == 0 && (!part[length] || strchr(". )", part[length])))
            return length > 0;
    }
    return false;
}

enum bead_error bead_scene_help_of(const char *section, FILE *out, struct bead_message *msg)
{
    const struct bead_options *options;
    char heading[80], parts[PARTS][24], near[96];
    struct bead_suggest search;
    size_t found = 0, count = 0;
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        if (!has_part(bead_options_heading(options, heading, sizeof heading), section))
            continue;
        if (found++ > 0)
            fputc('\n', out);
        bead_options_help(options, out);
    }
    if (found > 0)
        return BEAD_OK;
    bead_suggest_begin(&search, section);
    for (size_t i = 0; (options = bead_scene_section(i)); i++) {
        for (const char *p = bead_options_heading(options, heading, sizeof heading); p && count < PARTS; p = next_part(p)) {
            snprintf(parts[count], sizeof parts[count], "%.*s", (int)strcspn(p, ". )"), p);
            bead_suggest_try(&search, parts[count++]);
        }
    }
    return bead_fail(msg, BEAD_ERROR_USAGE, "--list keys: no part of a scene is called `%s`%s", section,
                     search.best ? bead_suggest_text(&search, near, sizeof near) : "; see --list keys");
}

void bead_scene_help_man(FILE *out)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = bead_scene_section(i)); i++)
        bead_options_man(options, out);
}
