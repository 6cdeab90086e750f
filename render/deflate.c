#include "render/deflate.h"

#include <stdlib.h>
#include <string.h>

#include "render/huffman.h"

enum {
    LONGEST = 258,
    SHORTEST = 3,
    FARTHEST = 32768,
    BLOCK = 1 << 15, /* tokens that share their codes */
    LITERALS = 286,
    DISTANCES = 30,
    HASH = 12, /* bits */
    END = 256,
};

/* A literal, or 1 << 31 | (distance - 1) << 16 | length. */
typedef uint32_t token;
static const token match = (token)1 << 31;

/* A symbol of deflate and the bits that follow it. */
struct symbol {
    uint16_t symbol, extra;
    uint8_t extra_bits;
};

struct bead_deflate {
    size_t row, pixel;
    uint8_t *window;          /* the last FARTHEST bytes, where there are as many, and rows to come */
    size_t at, end;           /* of the next row, of the window */
    uint32_t position;        /* of the next row in all that has come, modulo 2^32 */
    uint32_t seen[1 << HASH]; /* where bytes of this hash have stood last */
    struct symbol length[LONGEST + 1];
    uint32_t sums[2]; /* Adler-32 */
    token tokens[BLOCK];
    size_t count;
    uint32_t literal_often[LITERALS], distance_often[DISTANCES];
    struct bead_code literal[LITERALS], distance_code[DISTANCES];
    uint64_t held; /* bits not yet in a byte */
    unsigned held_bits;
    uint8_t *out;
    size_t used, room;
    bool failed;
};

/* Distances less 1: 0..3, then two symbols for each power of two. */
static struct symbol distance_of(token t)
{
    unsigned value = t >> 16 & 0x7fff, power = value ? 31 - (unsigned)__builtin_clz(value) : 0;
    if (value < 4)
        return (struct symbol){(uint16_t)value, 0, 0};
    return (struct symbol){(uint16_t)(2 * power + (value >> (power - 1) & 1)), (uint16_t)(value & ((1u << (power - 1)) - 1)),
                           (uint8_t)(power - 1)};
}

/* Lengths less 3: 0..7, then four symbols for each power of two; the longest has its own. */
static struct symbol length_of(unsigned length)
{
    unsigned value = length - SHORTEST, power = value ? 31 - (unsigned)__builtin_clz(value) : 0;
    if (length == LONGEST)
        return (struct symbol){LITERALS - 1, 0, 0};
    if (value < 8)
        return (struct symbol){(uint16_t)(END + 1 + value), 0, 0};
    return (struct symbol){(uint16_t)(END + 1 + 4 * (power - 1) + (value >> (power - 2) & 3)),
                           (uint16_t)(value & ((1u << (power - 2)) - 1)), (uint8_t)(power - 2)};
}

/* ---- bits ---- */

static void reserve(struct bead_deflate *d, size_t more)
{
    if (d->failed || d->room - d->used >= more)
        return;
    size_t room = 2 * d->room + more;
    uint8_t *out = realloc(d->out, room);
    d->failed = !out;
    if (!out)
        return;
    d->out = out;
    d->room = room;
}

/* At most 32; room for them was reserved. */
static void put(struct bead_deflate *d, uint64_t bits, unsigned count)
{
    d->held |= bits << d->held_bits;
    d->held_bits += count;
    while (d->held_bits >= 8) {
        d->out[d->used++] = (uint8_t)d->held;
        d->held >>= 8;
        d->held_bits -= 8;
    }
}

static void put_code(struct bead_deflate *d, struct bead_code code)
{
    put(d, code.bits, code.length);
}

/* ---- blocks ---- */

/* Lengths of codes, the same again and zeros run together: symbols 0..18 with what follows them. */
static size_t pack_lengths(const uint8_t *lengths, size_t count, struct symbol *packed)
{
    size_t used = 0;
    for (size_t i = 0; i < count;) {
        size_t same = 1;
        while (i + same < count && lengths[i + same] == lengths[i])
            same++;
        size_t left = same;
        if (lengths[i] > 0) {
            packed[used++] = (struct symbol){lengths[i], 0, 0};
            left--;
        }
        while (left >= SHORTEST) {
            size_t most = lengths[i] > 0 ? 6 : 138, some = left < most ? left : most;
            packed[used++] = lengths[i] > 0 ? (struct symbol){16, (uint16_t)(some - 3), 2}
                             : some < 11    ? (struct symbol){17, (uint16_t)(some - 3), 3}
                                            : (struct symbol){18, (uint16_t)(some - 11), 7};
            left -= some;
        }
        for (; left > 0; left--)
            packed[used++] = (struct symbol){lengths[i], 0, 0};
        i += same;
    }
    return used;
}

static void put_codes(struct bead_deflate *d)
{
    static const uint8_t order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint8_t lengths[LITERALS + DISTANCES];
    struct symbol packed[LITERALS + DISTANCES];
    uint32_t often[19] = {0};
    struct bead_code codes[19];
    size_t shown = 19;
    for (size_t i = 0; i < LITERALS; i++)
        lengths[i] = d->literal[i].length;
    for (size_t i = 0; i < DISTANCES; i++)
        lengths[LITERALS + i] = d->distance_code[i].length;
    size_t count = pack_lengths(lengths, LITERALS + DISTANCES, packed);
    for (size_t i = 0; i < count; i++)
        often[packed[i].symbol]++;
    bead_huffman_make(19, often, 7, codes);
    while (codes[order[shown - 1]].length == 0)
        shown--;
    put(d, LITERALS - 257, 5);
    put(d, DISTANCES - 1, 5);
    put(d, shown - 4, 4);
    for (size_t i = 0; i < shown; i++)
        put(d, codes[order[i]].length, 3);
    for (size_t i = 0; i < count; i++) {
        put_code(d, codes[packed[i].symbol]);
        put(d, packed[i].extra, packed[i].extra_bits);
    }
}

static void put_token(struct bead_deflate *d, token t)
{
    if (!(t & match)) {
        put_code(d, d->literal[t]);
        return;
    }
    const struct symbol *length = &d->length[t & 0xffff], distance = distance_of(t);
    put_code(d, d->literal[length->symbol]);
    put(d, length->extra, length->extra_bits);
    put_code(d, d->distance_code[distance.symbol]);
    put(d, distance.extra, distance.extra_bits);
}

static void put_block(struct bead_deflate *d, bool last)
{
    d->literal_often[END]++;
    bead_huffman_make(LITERALS, d->literal_often, 15, d->literal);
    bead_huffman_make(DISTANCES, d->distance_often, 15, d->distance_code);
    reserve(d, 1024 + 6 * d->count);
    if (d->failed)
        return;
    put(d, last, 1);
    put(d, 2, 2);
    put_codes(d);
    for (size_t i = 0; i < d->count; i++)
        put_token(d, d->tokens[i]);
    put_code(d, d->literal[END]);
    d->count = 0;
    memset(d->literal_often, 0, sizeof d->literal_often);
    memset(d->distance_often, 0, sizeof d->distance_often);
}

/* ---- rows ---- */

static void add(struct bead_deflate *d, token t)
{
    if (d->count == BLOCK)
        put_block(d, false);
    if (d->failed)
        return;
    d->tokens[d->count++] = t;
    d->literal_often[t & match ? d->length[t & 0xffff].symbol : t]++;
    if (t & match)
        d->distance_often[distance_of(t).symbol]++;
}

static void add_match(struct bead_deflate *d, size_t distance, size_t length)
{
    while (length > 0) {
        size_t some = length < LONGEST ? length : LONGEST;
        if (length - some > 0 && length - some < SHORTEST)
            some -= SHORTEST;
        add(d, match | (token)(distance - 1) << 16 | (token)some);
        length -= some;
    }
}

/* How many bytes are the same. */
static size_t same(const uint8_t *a, const uint8_t *b, size_t most)
{
    size_t count = 0;
    for (; count + 8 <= most; count += 8) {
        uint64_t x, y;
        memcpy(&x, a + count, 8);
        memcpy(&y, b + count, 8);
        if (x != y)
            return count + (size_t)__builtin_ctzll(x ^ y) / 8;
    }
    while (count < most && a[count] == b[count])
        count++;
    return count;
}

/* Adler-32, in parts short enough that sums of 32 bits hold them. */
static void add_sums(uint32_t *sums, const uint8_t *bytes, size_t count)
{
    enum { PART = 4096, PRIME = 65521 };
    while (count > 0) {
        uint32_t part = count < PART ? (uint32_t)count : PART, plain = 0, weighted = 0;
        for (uint32_t i = 0; i < part; i++) {
            plain += bytes[i];
            weighted += (part - i) * bytes[i];
        }
        sums[1] = (uint32_t)((sums[1] + (uint64_t)part * sums[0] + weighted) % PRIME);
        sums[0] = (sums[0] + plain) % PRIME;
        bytes += part;
        count -= part;
    }
}

/* Where these four bytes have stood last, as a distance; 0: nowhere near. Remembers that they stand here. */
static size_t recall(struct bead_deflate *d, const uint8_t *bytes, uint32_t position)
{
    uint32_t four;
    memcpy(&four, bytes, sizeof four);
    uint32_t *seen = &d->seen[four * 2654435761u >> (32 - HASH)], distance = position - *seen;
    *seen = position;
    return distance <= FARTHEST && distance <= (size_t)(bytes - d->window) ? distance : 0;
}

/* The longest match of what begins at `bytes`, `left` of which are the row's. A distance costs about as much as a byte or two. */
static size_t find(struct bead_deflate *d, const uint8_t *bytes, size_t left, uint32_t position, size_t *distance)
{
    enum { PRICE = 2, ENOUGH = 32 };
    const size_t behind = (size_t)(bytes - d->window);
    size_t best = behind >= d->pixel ? same(bytes, bytes - d->pixel, left) : 0, length;
    *distance = d->pixel;
    if (best >= LONGEST || best == left)
        return best;
    if (d->row <= FARTHEST && behind >= d->row && (length = same(bytes, bytes - d->row, left)) > best + PRICE) {
        best = length;
        *distance = d->row;
    }
    size_t far = left >= 4 && best < ENOUGH ? recall(d, bytes, position) : 0;
    if (far && (length = same(bytes, bytes - far, left)) > best + PRICE) {
        best = length;
        *distance = far;
    }
    return best;
}

uint8_t *bead_deflate_next(struct bead_deflate *d)
{
    if (d->end - d->at < d->row + BEAD_DEFLATE_SPARE) {
        memmove(d->window, d->window + d->at - FARTHEST, FARTHEST);
        d->at = FARTHEST;
    }
    return d->window + d->at;
}

void bead_deflate_row(struct bead_deflate *d)
{
    const uint8_t *row = d->window + d->at;
    add_sums(d->sums, row, d->row);
    for (size_t i = 0; i < d->row;) {
        size_t distance, length = find(d, row + i, d->row - i, d->position + (uint32_t)i, &distance);
        if (length >= SHORTEST)
            add_match(d, distance, length);
        else
            add(d, row[i]);
        i += length >= SHORTEST ? length : 1;
    }
    d->at += d->row;
    d->position += (uint32_t)d->row;
}

void bead_deflate_finish(struct bead_deflate *d)
{
    put_block(d, true);
    reserve(d, 16);
    if (d->failed)
        return;
    put(d, 0, (8 - d->held_bits) % 8);
    for (int k = 3; k >= 0; k--)
        put(d, d->sums[k / 2] >> 8 * (k % 2) & 255, 8);
}

bool bead_deflate_take(struct bead_deflate *d, const uint8_t **bytes, size_t *size)
{
    *bytes = d->out;
    *size = d->used;
    d->used = 0;
    return !d->failed;
}

/* ---- making one ---- */

enum bead_error bead_deflate_create(size_t row, size_t pixel, struct bead_deflate **deflate, struct bead_message *msg)
{
    struct bead_deflate *d = *deflate = calloc(1, sizeof *d);
    if (d) {
        d->row = row;
        d->pixel = pixel;
        d->room = 1 << 16;
        d->end = 2 * FARTHEST + row + BEAD_DEFLATE_SPARE;
        d->out = malloc(d->room);
        d->window = malloc(d->end);
    }
    if (!d || !d->out || !d->window) {
        bead_deflate_destroy(d);
        *deflate = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a PNG encoder");
    }
    for (unsigned i = SHORTEST; i <= LONGEST; i++)
        d->length[i] = length_of(i);
    d->sums[0] = 1;
    put(d, 0x0178, 16); /* a window of 32 kB, quick */
    return BEAD_OK;
}

void bead_deflate_destroy(struct bead_deflate *deflate)
{
    if (!deflate)
        return;
    free(deflate->out);
    free(deflate->window);
    free(deflate);
}
