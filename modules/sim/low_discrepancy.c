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

/* Each bit is turned by those above it and the seed (Laine and Karras 2011). */
static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    x = reversed(x);
    x += seed;
    x ^= x * 0x6c50b47c;
    x ^= x * 0xb82f1e52;
    x ^= x * 0xc7afe638;
    x ^= x * 0x8d22f6e6;
    return reversed(x);
}

/* The second dimension, of the polynomial x + 1: directions are rows of Pascal's triangle by 2. */
static uint32_t second(uint32_t index)
{
    uint32_t x = 0;
    for (uint32_t v = 0x80000000; index != 0; index >>= 1, v ^= v >> 1)
    {
        x ^= (index & 1) != 0 ? v : 0;
    }
    return x;
}

/* The third one, of x^2 + x + 1, from 1 and 3. */
static uint32_t third(uint32_t index)
{
    uint32_t x = 0;
    uint32_t v = 0x80000000;
    uint32_t next = 0xc0000000;
    for (; index != 0; index >>= 1)
    {
        x ^= (index & 1) != 0 ? v : 0;
        const uint32_t after = next ^ v ^ v >> 2;
        v = next;
        next = after;
    }
    return x;
}

void low_discrepancy_point(const uint32_t words[4], uint32_t index, double u[3])
{
    const uint32_t at = scrambled(index, words[0]);
    const uint32_t x[3] = {reversed(at), second(at), third(at)};
    for (int k = 0; k < 3; k++)
    {
        u[k] = scrambled(x[k], words[k + 1]) * 0x1p-32;
    }
}
