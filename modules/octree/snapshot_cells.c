/* SPDX-License-Identifier: MIT */
#include "snapshot_cells.h"

#include <string.h>

#include "voxel_region.h"

/* Of occupied voxels without colors. */
#define GREY 178

void cm_seen_color(uint32_t color, uint8_t rgb[3])
{
    cm_color_to(color, rgb);
    if (color == 0)
    {
        memset(rgb, GREY, 3);
    }
}

/* Bits of the bytes of a word that are not 0. */
static uint64_t bytes_of(uint64_t word)
{
    word |= word >> 4;
    word |= word >> 2;
    word |= word >> 1;
    return (word & 0x0101010101010101u) * 0x0102040810204080u >> 56;
}

size_t cm_seen_node_count(cm_seen_node *node)
{
    unsigned before = 0;
    node->pairs = 0;
    node->quarters = 0;
    for (unsigned w = 0; w < 8; w++)
    {
        const uint64_t word = node->mask[w];
        node->before[w] = (uint16_t)before;
        before += cm_bit_count(word);
        node->quarters = (uint8_t)(node->quarters | (word != 0) << w);
        node->pairs |= bytes_of(word) << 8 * w;
    }
    node->quarter_count = (uint8_t)cm_bit_count(node->quarters);
    return 1u + node->quarter_count + cm_bit_count(node->pairs);
}

/* At least 1 of what is not 0. */
static uint8_t shown(unsigned sum, unsigned whole)
{
    const unsigned rounded = (sum + whole / 2) / whole;
    return (uint8_t)(rounded == 0 && sum != 0 ? 1 : rounded);
}

/* A cell of eight, in the order of keys; what is empty is all 0. Along an axis four columns of two lie beside one another.
 * Colors weigh as much as they are seen. */
static cm_seen_cell joined(const cm_seen_cell from[8])
{
    cm_seen_cell cell = {0};
    unsigned weights = 0, parts = 0, colors[3] = {0};
    for (unsigned axis = 0; axis < 3; axis++)
    {
        unsigned sum = 0;
        for (unsigned i = 0; i < 8; i++)
        {
            const unsigned behind = i | 1u << axis;
            sum += i == behind ? 0
                               : 255u * 255u - (255u - from[i].opacity[axis]) *
                                                   (255u - from[behind].opacity[axis]);
        }
        cell.opacity[axis] = shown(sum, 4 * 255);
    }
    for (unsigned i = 0; i < 8; i++)
    {
        const unsigned weight =
            (unsigned)from[i].opacity[0] + from[i].opacity[1] + from[i].opacity[2];
        weights += weight;
        parts += from[i].part;
        for (unsigned c = 0; c < 3; c++)
        {
            colors[c] += weight * from[i].color[c];
        }
    }
    cell.part = shown(parts, 8);
    for (unsigned c = 0; c < 3; c++)
    {
        cell.color[c] = (uint8_t)((colors[c] + weights / 2) / weights);
    }
    return cell;
}

/* The mean of colors, of those that there are. */
static void mean_of(const uint32_t *color, unsigned n, uint8_t rgb[3])
{
    uint32_t red = 0, green = 0, blue = 0, count = 0;
    for (unsigned i = 0; i < n; i++)
    {
        red += color[i] >> 21;
        green += color[i] >> 10 & 2047;
        blue += color[i] & 1023;
        count += color[i] != 0;
    }
    /* 2^17 / count, rounded up: products are exact quotients of what is below 2^14 */
    static const uint32_t part[9] = {0, 131072, 65536, 43691, 32768, 26215, 21846, 18725, 16384};
    const uint32_t half = count / 2, by = part[count];
    cm_seen_color(count == 0 ? 0
                             : ((red + half) * by >> 17) << 21 | ((green + half) * by >> 17) << 10 |
                                   (blue + half) * by >> 17,
                  rgb);
}

void cm_seen_tables(cm_snapshot *snapshot)
{
    static const uint8_t part_of_four[5] = {0, 64, 128, 191, 255};
    for (unsigned occupied = 0; occupied < 256; occupied++)
    {
        cm_seen_cell *cell = &snapshot->of_voxels[occupied];
        const unsigned n = cm_bit_count(occupied);
        *cell = (cm_seen_cell){.part = shown(255 * n, 8)};
        cell->opacity[0] = part_of_four[cm_bit_count((occupied | occupied >> 1) & 0x55)];
        cell->opacity[1] = part_of_four[cm_bit_count((occupied | occupied >> 2) & 0x33)];
        cell->opacity[2] = part_of_four[cm_bit_count((occupied | occupied >> 4) & 0x0f)];
        snapshot->count_of[occupied] = (uint8_t)n;
    }
}

/* Cells of a node from those of its 2^3 children, which are there. */
static void join_upwards(const cm_snapshot *snapshot, const cm_seen_node *node)
{
    cm_seen_cell *own = snapshot->cell + node->cell;
    cm_seen_cell *quarter = own + 1;
    const cm_seen_cell *pair = quarter + node->quarter_count;
    cm_seen_cell quarters[8] = {{{0}, 0, {0}, 0}};
    for (unsigned w = 0; w < 8; w++)
    {
        cm_seen_cell pairs[8] = {{{0}, 0, {0}, 0}};
        const unsigned which = (unsigned)(node->pairs >> 8 * w & 255);
        for (unsigned b = 0; b < 8; b++)
        {
            if (which >> b & 1)
            {
                pairs[b] = *pair++;
            }
        }
        if (which != 0)
        {
            quarters[w] = joined(pairs);
            *quarter++ = quarters[w];
        }
    }
    *own = joined(quarters);
}

void cm_seen_block_fill(const cm_snapshot *snapshot, const cm_seen_node *node)
{
    cm_seen_cell *pair = snapshot->cell + node->cell + 1 + node->quarter_count;
    const uint32_t *color = snapshot->color + node->child;
    for (unsigned b = 0; b < 64; b++)
    {
        const unsigned occupied = (unsigned)(node->mask[b / 8] >> 8 * (b % 8) & 255);
        if (occupied != 0)
        {
            const unsigned count = snapshot->count_of[occupied];
            *pair = snapshot->of_voxels[occupied];
            mean_of(color, count, pair->color);
            pair++;
            color += count;
        }
    }
    join_upwards(snapshot, node);
}

void cm_seen_node_fill(const cm_snapshot *snapshot, int stage, const cm_seen_node *node)
{
    cm_seen_cell *pair = snapshot->cell + node->cell + 1 + node->quarter_count;
    const uint32_t *child = snapshot->children + node->child;
    for (unsigned b = 0; b < 64; b++)
    {
        cm_seen_cell from[8] = {{{0}, 0, {0}, 0}};
        const unsigned there = (unsigned)(node->mask[b / 8] >> 8 * (b % 8) & 255);
        for (unsigned i = 0; i < 8; i++)
        {
            if (there >> i & 1)
            {
                from[i] = snapshot->cell[snapshot->node[stage - 1][child[8 * b + i]].cell];
            }
        }
        if (there != 0)
        {
            *pair++ = joined(from);
        }
    }
    join_upwards(snapshot, node);
}
