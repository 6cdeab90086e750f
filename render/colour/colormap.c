/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colour maps: their list, their files, and the colour of a value. */
#include "beadreel/render.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/colour/colour_table.h"
#include "sim/base/assets.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"

static const struct bead_colormap_info maps[] = {
    {"viridis", "dark violet, green, yellow; even lightness"},
    {"cividis", "blue, grey, yellow; looks the same to the colour-blind"},
    {"inferno", "black, red, yellow, white"},
    {"magma", "black, violet, pink, cream"},
    {"batlow", "dark blue, green, orange, pink; even lightness"},
    {"grey", "black to white in equal steps of lightness; for white paper grey_r"},
    {"ember", "white, yellow, red, violet, black; for light pages, white where nothing is"},
    {"dawn", "blue, white, orange red, for velocity and displacement; greys tell the signs apart"},
    {"dusk", "blue, black, orange, for the same in dark pictures"},
    {"vik", "blue, white, red; in greys both signs look alike"},
    {NULL, NULL},
};

const struct bead_colormap_info *bead_colormap_list(void)
{
    return maps;
}

static enum bead_error unknown(const char *name, struct bead_message *msg)
{
    char names[256] = "";
    for (const struct bead_colormap_info *map = maps; map->name; map++)
        bead_list_add(names, sizeof names, ", ", map->name);
    return bead_fail(
        msg, BEAD_ERROR_SCENE,
        "there is no colour map `%.40s`; allowed are %s, each of them reversed (viridis_r), or a file of colours such as "
        "mine.txt",
        name, names);
}

static enum bead_error parse(const char *file, const char *text, struct bead_colormap *map, struct bead_message *msg)
{
    size_t rows = 0;
    for (const char *line = text; line && *line; line = strchr(line, '\n'), line += line != NULL) {
        int rgb[3];
        if (*line == '#' || *line == '\n')
            continue;
        if (rows == 256 || sscanf(line, "%d %d %d", &rgb[0], &rgb[1], &rgb[2]) != 3)
            return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: row %zu: must be three numbers, in 256 rows in all", file, rows + 1);
        for (int c = 0; c < 3; c++) {
            if (rgb[c] < 0 || rgb[c] > 255)
                return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: row %zu: %d is not within 0 to 255", file, rows + 1, rgb[c]);
            map->rgb[rows][c] = (uint8_t)rgb[c];
        }
        rows++;
    }
    if (rows != 256)
        return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: has %zu colours, not 256", file, rows);
    return BEAD_OK;
}

/* The colour at `place`, 0 to 255, on a scale of `count` equally spaced colours, "#rrggbb " each. */
static void between(const char *colours, size_t count, int place, uint8_t rgb[3])
{
    const double at = (double)place * (double)(count - 1) / 255;
    const size_t first = at >= (double)(count - 1) ? count - 2 : (size_t)at;
    const unsigned long ends[2] = {strtoul(colours + 8 * first + 1, NULL, 16), strtoul(colours + 8 * first + 9, NULL, 16)};
    for (int c = 0; c < 3; c++) {
        const double low = (double)(ends[0] >> (16 - 8 * c) & 255), high = (double)(ends[1] >> (16 - 8 * c) & 255);
        rgb[c] = (uint8_t)lround(low + (at - (double)first) * (high - low));
    }
}

/* Makes a map from the user's own colours: "#000000 #ff8000 #ffffff". */
static enum bead_error own(const char *colours, size_t length, struct bead_colormap *map, struct bead_message *msg)
{
    const size_t count = (length + 1) / 8;
    bool good = count >= 2 && length == 8 * count - 1;
    for (size_t i = 0; i < count && good; i++)
        good = colours[8 * i] == '#' && strspn(colours + 8 * i + 1, "0123456789abcdefABCDEF") == 6 &&
               (colours[8 * i + 7] == ' ' || i + 1 == count);
    if (!good)
        return bead_fail(msg, BEAD_ERROR_SCENE, "own colours must be two or more such as #ff8000, separated by a space");
    snprintf(map->name, sizeof map->name, "own");
    for (int i = 0; i < 256; i++)
        between(colours, count, i, map->rgb[i]);
    return BEAD_OK;
}

static void reverse(struct bead_colormap *map)
{
    const struct bead_colormap forwards = *map;
    for (int i = 0; i < 256; i++)
        memcpy(map->rgb[i], forwards.rgb[255 - i], sizeof map->rgb[i]);
}

static enum bead_error load(const char *name, size_t end, struct bead_colormap *map, struct bead_message *msg)
{
    const struct bead_colormap_info *info = maps;
    while (info->name && (strlen(info->name) != end || strncmp(info->name, name, end) != 0))
        info++;
    if (!info->name)
        return unknown(name, msg);
    char file[64];
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    snprintf(file, sizeof file, "colormaps/%s.txt", info->name);
    BEAD_TRY(bead_asset_read(file, &text, &length, msg));
    snprintf(map->name, sizeof map->name, "%s", name);
    return parse(file, text, map, msg);
}

enum bead_error bead_colormap_load(const char *name, struct bead_colormap *map, struct bead_message *msg)
{
    const size_t length = strlen(name), end = length > 2 && strcmp(name + length - 2, "_r") == 0 ? length - 2 : length;
    BEAD_TRY(*name == '#' ? own(name, end, map, msg) : load(name, end, map, msg));
    if (end < length)
        reverse(map);
    return BEAD_OK;
}

static double signed_root(double x)
{
    return x < 0 ? -sqrt(-x) : sqrt(x);
}

double bead_scale_place(enum bead_scale scale, double low, double high, double value)
{
    if (scale == BEAD_SCALE_LOG)
        return value > 0 ? (log(value) - log(low)) / (log(high) - log(low)) : -INFINITY;
    if (scale == BEAD_SCALE_SQRT)
        return (signed_root(value) - signed_root(low)) / (signed_root(high) - signed_root(low));
    return (value - low) / (high - low);
}

double bead_colours_place(const struct bead_colours *colours, double value)
{
    return bead_scale_place(colours->scale, colours->low, colours->high, value);
}

uint8_t bead_colours_index(const struct bead_colours *colours, double value)
{
    double place = bead_colours_place(colours, value) * 256;
    return place >= 255 ? 255 : place > 0 ? (uint8_t)place : 0; /* NaN: 0 */
}
