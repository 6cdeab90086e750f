#include "render/encode/movie_blocks.h"

#include <stdlib.h>
#include <string.h>

enum bead_error bead_blocks_create(int width, int height, struct bead_blocks *blocks, struct bead_message *msg)
{
    blocks->across = (width + BEAD_BLOCK - 1) / BEAD_BLOCK;
    blocks->down = (height + BEAD_BLOCK - 1) / BEAD_BLOCK;
    blocks->same = calloc((size_t)blocks->across * (size_t)blocks->down, 1);
    return blocks->same ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the blocks of a picture");
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

void bead_blocks_change(struct bead_blocks *blocks, const struct bead_changes *changes)
{
    for (size_t i = 0; i < changes->count; i++) {
        const struct bead_rect *r = &changes->rect[i];
        int left = r->x / BEAD_BLOCK, right = least(blocks->across, (r->x + r->width + BEAD_BLOCK - 1) / BEAD_BLOCK);
        int bottom = least(blocks->down, (r->y + r->height + BEAD_BLOCK - 1) / BEAD_BLOCK);
        for (int y = r->y / BEAD_BLOCK; y < bottom && left < right; y++)
            memset(blocks->same + (size_t)y * (size_t)blocks->across + left, 0, (size_t)(right - left));
    }
}

void bead_blocks_encoded(struct bead_blocks *blocks)
{
    memset(blocks->same, 1, (size_t)blocks->across * (size_t)blocks->down);
}

void bead_blocks_free(struct bead_blocks *blocks)
{
    free(blocks->same);
    blocks->same = NULL;
}
