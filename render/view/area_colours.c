/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours of an area's columns, as indices into a palette, written straight into an image. Used by the space-time view and bare
 * images. */
#include "render/view/area.h"

#include <stdlib.h>

enum { BLOCK = 16 };
/* BLOCK pixels of a row, at any address. Not memcpy: when GCC (at least 12 to 14) vectorises a loop of them, it makes aligned
 * stores of 16 bytes. */
typedef uint8_t pixels_anywhere __attribute__((vector_size(BLOCK), aligned(1), may_alias));

/* A few columns side by side, so that each row of the image is written BLOCK bytes at a time, not byte by byte. */
struct block {
    size_t places, levels;
    const unsigned *level;
    double *values;   /* [levels], of a column */
    uint8_t *columns; /* [BLOCK][levels] */
    uint8_t *rows;    /* [levels][BLOCK] */
};

static void colours_put_rows(const struct block *b, int count, uint8_t *origin, ptrdiff_t step)
{
    for (size_t l = 0; l < b->levels; l++)
        for (size_t c = 0; c < BLOCK; c++)
            b->rows[BLOCK * l + c] = b->columns[c * b->levels + l];
    for (size_t p = 0; p < b->places; p++) {
        const uint8_t *row = b->rows + BLOCK * (b->level ? b->level[p] : p);
        uint8_t *to = origin + (ptrdiff_t)p * step;
        if (count == BLOCK)
            *(pixels_anywhere *)to = *(const pixels_anywhere *)row;
        else
            memcpy(to, row, (size_t)count);
    }
}

/* Columns that are rows of the image. */
static void colours_put_columns(const struct block *b, int count, uint8_t *origin, ptrdiff_t step)
{
    for (int c = 0; c < count; c++) {
        const uint8_t *column = b->columns + (size_t)c * b->levels;
        uint8_t *row = origin + c * step;
        for (size_t p = 0; p < b->places; p++)
            row[p] = column[b->level ? b->level[p] : p];
    }
}

/* Colours of at most `most` columns; returns the number of those before the first that no sample has touched. */
static int take_columns(const struct block *b, const struct bead_area *area, const struct bead_colour_table *table, int from,
                        int most)
{
    int count = 0;
    while (count < most && bead_area_column_levels(area, from + count, b->values)) {
        bead_colour_table_find(table, b->levels, b->values, b->columns + (size_t)count * b->levels);
        count++;
    }
    return count;
}

enum bead_error bead_area_colour(const struct bead_area *area, const struct bead_colour_table *table, int from, int to,
                                 const struct bead_area_image *image, int *done, struct bead_message *msg)
{
    struct block b = {.places = bead_area_places(area), .levels = bead_area_levels(area), .level = bead_area_level(area)};
    b.values = malloc(b.levels * sizeof *b.values);
    b.columns = calloc(b.levels, BLOCK);
    b.rows = malloc(b.levels * BLOCK);
    enum bead_error err =
        b.values && b.columns && b.rows ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image");
    bool touched = true;
    for (*done = from; !err && touched && *done < to;) {
        int most = to - *done < BLOCK ? to - *done : BLOCK, count = take_columns(&b, area, table, *done, most);
        uint8_t *origin = image->origin + *done * image->column_step;
        if (image->place_step == 1)
            colours_put_columns(&b, count, origin, image->column_step);
        else
            colours_put_rows(&b, count, origin, image->place_step);
        touched = count == most;
        *done += count;
    }
    free(b.values);
    free(b.columns);
    free(b.rows);
    return err;
}
