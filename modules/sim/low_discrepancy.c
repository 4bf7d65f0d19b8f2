/* SPDX-License-Identifier: MIT */
#include "low_discrepancy.h"

static uint32_t reversed(uint32_t x)
{
    x = (x & 0x55555555) << 1 | (x >> 1 & 0x55555555);
    x = (x & 0x33333333) << 2 | (x >> 2 & 0x33333333);
    x = (x & 0x0f0f0f0f) << 4 | (x >> 4 & 0x0f0f0f0f);
    x = (x & 0x00ff00ff) << 8 | (x >> 8 & 0x00ff00ff);
    return x << 16 | x >> 16;
}

/* Each bit of a number is turned by the seed and those above it; bits are the other way round, before and after (Laine and
 * Karras 2011). */
static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    x += seed;
    x ^= x * 0x6c50b47c;
    x ^= x * 0xb82f1e52;
    x ^= x * 0xc7afe638;
    x ^= x * 0x8d22f6e6;
    return x;
}

/* Pascal's triangle by 2 times the bits of the number, which are the other way round: Sobol's second dimension from its
 * first. The triangle is made of itself at half the size, so that five steps do it (Ahmed 2024). */
static uint32_t by_pascal(uint32_t x)
{
    x ^= x << 16;
    x ^= (x & 0x00ff00ff) << 8;
    x ^= (x & 0x0f0f0f0f) << 4;
    x ^= (x & 0x33333333) << 2;
    return x ^ (x & 0x55555555) << 1;
}

void low_discrepancy_point(const uint32_t words[4], uint32_t index, double u[3])
{
    const uint32_t backwards = reversed(index);
    const uint32_t at = scrambled(backwards, words[0]);    /* an order, still backwards */
    const uint32_t other = scrambled(backwards, words[3]); /* one for itself */
    /* The first dimension is the place in the order, backwards. */
    u[0] = reversed(scrambled(reversed(at), words[1])) * 0x1p-32;
    u[1] = reversed(scrambled(reversed(by_pascal(at)), words[2])) * 0x1p-32;
    u[2] = reversed(scrambled(reversed(other), words[0] ^ 0x9e3779b9)) * 0x1p-32;
}
