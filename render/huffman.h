/* Huffman codes as deflate wants them: of at most `longest` bits, canonical, bits reversed. */
#ifndef BEADREEL_RENDER_HUFFMAN_H
#define BEADREEL_RENDER_HUFFMAN_H

#include <stddef.h>
#include <stdint.h>

enum { BEAD_HUFFMAN_MOST = 286 };

struct bead_code {
    uint16_t bits;
    uint8_t length; /* 0: the symbol does not occur */
};

/* Codes of `count` symbols from how often they occur, `longest` at most 15. At least two symbols get one: decoders want complete
 * codes. */
void bead_huffman_make(size_t count, const uint32_t *often, unsigned longest, struct bead_code *codes);

#endif
