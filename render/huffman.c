#include "render/huffman.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 32 }; /* what fewer than 2^22 symbols can reach: the counts of depths grow as Fibonacci's numbers */

struct leaf {
    uint32_t often;
    uint16_t symbol;
};

static int compare(const void *a, const void *b)
{
    const struct leaf *x = a, *y = b;
    if (x->often != y->often)
        return x->often < y->often ? -1 : 1;
    return (int)x->symbol - (int)y->symbol;
}

/* How many leaves lie at each depth. The two rarest nodes are joined until one is left; a new one is never rarer than those made
 * before, so that they need no sorting. */
static void find_depths(const struct leaf *leaves, size_t count, size_t at_depth[DEEPEST + 1])
{
    uint64_t often[BEAD_HUFFMAN_MOST];
    size_t parent[2 * BEAD_HUFFMAN_MOST] = {0}, leaf = 0, node = 0, made = 0;
    unsigned depth[2 * BEAD_HUFFMAN_MOST];
    for (; made + 1 < count; made++) {
        often[made] = 0;
        for (int k = 0; k < 2; k++) {
            bool is_leaf = leaf < count && (node == made || leaves[leaf].often <= often[node]);
            often[made] += is_leaf ? leaves[leaf].often : often[node];
            parent[is_leaf ? leaf++ : count + node++] = count + made;
        }
    }
    depth[2 * count - 2] = 0;
    for (size_t i = 2 * count - 2; i-- > 0;) {
        depth[i] = depth[parent[i]] + 1;
        if (i < count)
            at_depth[depth[i] < DEEPEST ? depth[i] : DEEPEST]++;
    }
}

/* Leaves that lie too deep come up to `longest`; until there is room for all, one goes a level down, and takes one of these. */
static void limit_depths(size_t at_depth[DEEPEST + 1], unsigned longest)
{
    size_t taken = 0, room = (size_t)1 << longest;
    for (unsigned d = longest + 1; d <= DEEPEST; d++) {
        at_depth[longest] += at_depth[d];
        at_depth[d] = 0;
    }
    for (unsigned d = 1; d <= longest; d++)
        taken += at_depth[d] << (longest - d);
    for (; taken > room; taken--) {
        unsigned d = longest - 1;
        while (at_depth[d] == 0)
            d--;
        at_depth[longest]--;
        at_depth[d]--;
        at_depth[d + 1] += 2;
    }
}

static uint16_t reversed(unsigned bits, unsigned length)
{
    unsigned result = 0;
    for (unsigned i = 0; i < length; i++)
        result |= (bits >> i & 1) << (length - 1 - i);
    return (uint16_t)result;
}

void bead_huffman_make(size_t count, const uint32_t *often, unsigned longest, struct bead_code *codes)
{
    struct leaf leaves[BEAD_HUFFMAN_MOST] = {{0, 0}};
    size_t used = 0, at_depth[DEEPEST + 1] = {0}, next = 0;
    unsigned code = 0;
    memset(codes, 0, count * sizeof *codes);
    for (size_t i = 0; i < count; i++)
        if (often[i] > 0)
            leaves[used++] = (struct leaf){often[i], (uint16_t)i};
    for (size_t i = 0; used < 2 && i < count; i++)
        if (often[i] == 0)
            leaves[used++] = (struct leaf){0, (uint16_t)i};
    qsort(leaves, used, sizeof *leaves, compare);
    find_depths(leaves, used, at_depth);
    limit_depths(at_depth, longest);
    for (unsigned d = longest; d > 0; d--)
        for (size_t k = 0; k < at_depth[d]; k++)
            codes[leaves[next++].symbol].length = (uint8_t)d;
    for (unsigned d = 1; d <= longest; d++, code <<= 1)
        for (size_t i = 0; i < count; i++)
            if (codes[i].length == d)
                codes[i].bits = reversed(code++, d);
}
