/* SPDX-License-Identifier: MIT */
#include "cube_sum.h"

#include "color_word.h"
#include "walk.h"

void cm_cube_add(cm_cube_sum *sum, uint8_t alpha, int level)
{
    const int is_large = level >= CM_LARGE_LEVEL;
    const uint64_t voxels = (uint64_t)1 << 3 * (is_large ? level - CM_LARGE_LEVEL : level);
    if (alpha > CM_UNKNOWN)
    {
        *(is_large ? &sum->large_above : &sum->above) += (alpha - CM_UNKNOWN) * voxels;
    }
    else
    {
        *(is_large ? &sum->large_below : &sum->below) += (CM_UNKNOWN - alpha) * voxels;
    }
}

static void add_color(cm_cube_sum *sum, uint8_t alpha, uint32_t color, uint64_t voxels)
{
    if (alpha > CM_UNKNOWN && color != 0)
    {
        uint8_t rgb[3];
        cm_color_to(color, rgb);
        const uint64_t weight = (alpha - CM_UNKNOWN) * voxels;
        for (int i = 0; i < 3; i++)
        {
            sum->color[i] += rgb[i] * weight;
        }
        sum->colored += weight;
    }
}

void cm_cube_add_cells(cm_cube_sum *sum, const uint8_t alpha[512], const uint32_t color[512],
                       unsigned detail, unsigned first, unsigned count)
{
    /* each cell once, and a part of one if less is asked for */
    const unsigned shift = 3 * detail;
    const unsigned begin = first >> shift;
    const unsigned end = count >> shift > 0 ? (first + count) >> shift : begin + 1;
    const uint64_t voxels = (uint64_t)count / (end - begin);
    uint32_t all = 0, above = 0;
    for (unsigned cell = begin; cell < end; cell++)
    {
        all += alpha[cell];
        above += alpha[cell] > CM_UNKNOWN ? alpha[cell] - (uint32_t)CM_UNKNOWN : 0u;
    }
    sum->above += above * voxels;
    sum->below += ((uint64_t)CM_UNKNOWN * (end - begin) + above - all) * voxels;
    for (unsigned cell = begin; above > 0 && cell < end; cell++)
    {
        add_color(sum, alpha[cell], color[cell], voxels);
    }
}

/* Sums over the voxels of a cube, to the nearest, halves up. Above the large level a half is whole large cubes. */
static uint64_t mean_of(uint64_t sum, uint64_t large, int level)
{
    const int large_bits = 3 * CM_LARGE_LEVEL, bits = 3 * level;
    const uint64_t half = (uint64_t)1 << bits >> 1;
    return level <= CM_LARGE_LEVEL
               ? (sum + (large << large_bits) + half) >> bits
               : ((sum >> large_bits) + large + (half >> large_bits)) >> (bits - large_bits);
}

/* Free voxels do not outvote what is occupied: a wall is thin beside the room in front of it. */
static uint8_t average(const cm_cube_sum *sum, int level)
{
    if (cm_cube_is_occupied(sum))
    {
        const uint64_t mean = mean_of(sum->above, sum->large_above, level);
        return (uint8_t)(CM_UNKNOWN + (mean > 0 ? mean : 1));
    }
    return (uint8_t)(CM_UNKNOWN - mean_of(sum->below, sum->large_below, level));
}

cm_voxel cm_cube_voxel(const cm_octree *octree, const cm_cube_sum *sum, const uint32_t place[3],
                       int level)
{
    cm_voxel voxel = cm_voxel_at(octree, place, level, average(sum, level), 0);
    if (voxel.state == CM_VOXEL_OCCUPIED && sum->colored > 0)
    {
        voxel.has_color = 1;
        for (int i = 0; i < 3; i++)
        {
            voxel.color[i] = (uint8_t)((sum->color[i] + sum->colored / 2) / sum->colored);
        }
    }
    return voxel;
}
