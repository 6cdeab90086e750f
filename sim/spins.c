#include "sim/spins.h"

#include <Random123/philox.h>
#include <math.h>

size_t bead_spins_up(size_t count, double magnetism)
{
    size_t up = (size_t)floor(((double)count * (1 + magnetism)) / 2 + 0.5);
    return up > count ? count : up;
}

/* 64 random bits number `index` of a stream. */
static uint64_t draw(uint64_t seed, uint64_t configuration, uint64_t index)
{
    philox4x32_ctr_t counter = {
        {(uint32_t)index, (uint32_t)(index >> 32), (uint32_t)configuration, (uint32_t)(configuration >> 32)}};
    philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    philox4x32_ctr_t bits = philox4x32(counter, key);
    return (uint64_t)bits.v[0] | (uint64_t)bits.v[1] << 32;
}

void bead_spins_draw(char *digits, size_t count, double magnetism, uint64_t seed, uint64_t configuration)
{
    size_t up = bead_spins_up(count, magnetism);
    for (size_t i = 0; i < count; i++)
        digits[i] = i < up ? '1' : '0';
    for (size_t i = count; i > 1; i--) {
        /* High word of the product: uniform on 0..i-1 to 2^-64 i. */
        size_t other = (size_t)(((unsigned __int128)draw(seed, configuration, i) * i) >> 64);
        char keep = digits[i - 1];
        digits[i - 1] = digits[other];
        digits[other] = keep;
    }
}
