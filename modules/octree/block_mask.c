/* SPDX-License-Identifier: MIT */
#include "block_mask.h"

#include <string.h>

/* Eight bytes, the first lowest. */
static uint64_t eight_of(const uint8_t *a)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    uint64_t eight;
    memcpy(&eight, a, sizeof eight);
    return eight;
#else
    return a[0] | (uint64_t)a[1] << 8 | (uint64_t)a[2] << 16 | (uint64_t)a[3] << 24 |
           (uint64_t)a[4] << 32 | (uint64_t)a[5] << 40 | (uint64_t)a[6] << 48 |
           (uint64_t)a[7] << 56;
#endif
}

/* Which of 64 alphas are occupied after misses that take `less`, below 128: those of 128 + less and more. */
static uint64_t occupied_of(const uint8_t alpha[64], unsigned less)
{
    const uint64_t ones = 0x0101010101010101u, tops = 128 * ones;
    uint64_t bits = 0, any = 0;
    for (unsigned i = 0; i < 64; i += 8)
    {
        any |= eight_of(alpha + i);
    }
    for (unsigned i = 0; (any & tops) != 0 && i < 64; i += 8)
    {
        const uint64_t eight = eight_of(alpha + i);
        const uint64_t top = eight & ((eight & ~tops) + (128 - less) * ones) & tops;
        bits |= ((top >> 7) * 0x0102040810204080u >> 56) << i;
    }
    return bits;
}

/* Alphas of all voxels of level 0, with nothing that waits. */
static void read_voxels(const cm_region *region, unsigned block, const cm_count_rule *rule,
                        unsigned more, uint8_t alpha[512])
{
    uint8_t cell[512];
    const unsigned detail = cm_block_read(region, block, rule, more, cell, NULL);
    for (unsigned i = 0; i < 512; i++)
    {
        alpha[i] = cell[i >> 3 * detail];
    }
}

int cm_block_mask(const cm_region *region, unsigned block, const cm_count_rule *rule, unsigned more,
                  uint64_t mask[8])
{
    const int is_plain = region->form[block] == CM_BLOCK_PLAIN && region->detail[block] == 0;
    const unsigned less =
        is_plain ? cm_more_misses(region->value[block], more) * (unsigned)rule->miss : 0;
    uint8_t voxels[512];
    const uint8_t *alpha = is_plain ? region->alpha[block] : voxels;
    memset(mask, 0, 8 * sizeof *mask);
    if (!cm_block_is_solid(region, block) || less >= 128)
    {
        return 0;
    }
    if (!is_plain)
    {
        read_voxels(region, block, rule, more, voxels);
    }
    uint64_t any = 0;
    for (unsigned w = 0; w < 8; w++)
    {
        mask[w] = occupied_of(alpha + (size_t)64 * w, less);
        any |= mask[w];
    }
    return any != 0;
}
