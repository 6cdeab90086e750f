/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names as people read them in pictures: a name that is an identifier becomes words. */

#include "sim/scene/scene_private.h"

static bool letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (unsigned char)c >= 0x80;
}

/* One word in lower case. */
static bool is_identifier(const char *name)
{
    for (const char *c = name; *c; c++) {
        if (!letter(*c) && *c != '-' && *c != '_')
            return false;
    }
    return true;
}

char *bead_words_of(const char *name)
{
    char *words = strdup(name);
    if (!words || !is_identifier(words))
        return words;
    for (char *c = words; *c; c++) {
        if (c > words && !letter(*c) && letter(c[-1]) && letter(c[1]))
            *c = ' ';
    }
    return words;
}

enum bead_error bead_scene_find_words(struct bead_reader *reader)
{
    struct bead_scene *scene = reader->scene;
    for (size_t i = 0; i < scene->chain_count; i++) {
        scene->chains[i].title = bead_words_of(scene->chains[i].name);
        if (!scene->chains[i].title)
            return bead_no_memory(reader);
    }
    for (size_t i = 0; i < scene->sweep_count; i++) {
        scene->sweeps[i].title = bead_words_of(scene->sweeps[i].name);
        if (!scene->sweeps[i].title)
            return bead_no_memory(reader);
    }
    return BEAD_OK;
}
