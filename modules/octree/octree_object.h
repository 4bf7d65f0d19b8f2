/* SPDX-License-Identifier: MIT
 *
 * A map: a tree of nodes above regions of 64^3 voxels, which have 512 blocks of 8^3.
 *
 *   place      of voxels, blocks and regions: counted from the tree's lower corner, so that none is negative
 *   misses     k of them are max(alpha - k step, low) exactly, so what is wholly in front of all that a view sees only counts
 *              them. They are brought down before a hit, since hits and misses do not commute at the ends of the range
 */
#ifndef MODULES_OCTREE_OCTREE_OBJECT_H
#define MODULES_OCTREE_OCTREE_OBJECT_H

#include <stdatomic.h>
#include <stdint.h>

#include <cubemap/octree.h>

#include "octree_set.h"

#define CM_UNKNOWN 127

/* A region has 2^6 voxels each way, a block 2^3. */
#define CM_REGION_LEVEL 6
#define CM_BLOCK_LEVEL 3
#define CM_REGION_BLOCKS 512

/* As many misses make everything what it is at the lowest. */
#define CM_MISSES_MOST 255

typedef enum cm_node_kind
{
    CM_NODE_LEAF = 0,   /* all voxels have this alpha */
    CM_NODE_INNER = 1,  /* eight children; misses that wait for being brought down to them */
    CM_NODE_REGION = 2, /* a region in memory; misses that wait */
    CM_NODE_PAGED = 3   /* a region in pages; misses that wait */
} cm_node_kind;

/* Links are of the first of eight children, which lie together, or of a region. */
typedef struct cm_node
{
    uint32_t link;
    uint32_t changed; /* the step, of a leaf, else that of the last miss that waits */
    uint8_t kind;
    uint8_t value; /* alpha of a leaf, else misses */
} cm_node;

/* How the cells of a block are stored. */
typedef enum cm_block_form
{
    CM_BLOCK_EVEN = 0,  /* they have one alpha and no memory */
    CM_BLOCK_PLAIN = 8, /* a byte a cell, a color a cell if there are any */
    CM_BLOCK_BITS_1 =
        1, /* a palette, then so many bits a cell; colors of occupied cells, in their order */
    CM_BLOCK_BITS_2 = 2,
    CM_BLOCK_BITS_4 = 4,
    CM_BLOCK_BYTES = 7 /* a byte a cell; colors of occupied cells, in their order */
} cm_block_form;

/* Its blocks are in the order of keys. */
typedef struct cm_region
{
    uint32_t place[3]; /* of its lower corner, in voxels */
    uint64_t used;     /* the clock when it was last needed */
    uint32_t node;     /* whose region it is */
    uint8_t is_dirty;  /* 1: it is not as it was last saved */
    uint8_t is_held;   /* 1: a walk is in it, whose caller may ask for others: it stays in memory */
    uint8_t has_page;  /* 1: the map's pages have it, as it is or as it was */
    uint64_t bytes;    /* of its blocks and colors, without this struct */
    uint32_t *
        *color; /* of blocks, NULL where there is none; the table is NULL if no block has any */
    uint8_t *alpha[CM_REGION_BLOCKS]; /* NULL: even */
    uint8_t value[CM_REGION_BLOCKS];  /* alpha of an even block, else misses that wait */
    uint8_t detail[CM_REGION_BLOCKS]; /* cells are of 2^detail voxels each way */
    uint8_t form[CM_REGION_BLOCKS];   /* a cm_block_form */
    uint8_t one_color[CM_REGION_BLOCKS /
                      8]; /* bits: all occupied cells of a packed block have the only color */
    uint32_t changed[CM_REGION_BLOCKS]; /* the step */
    uint64_t solid[CM_REGION_BLOCKS /
                   64]; /* bits: a block may have an occupied cell; without one it has none */
} cm_region;

static inline void cm_region_mark(cm_region *region, unsigned block, int is_solid)
{
    const uint64_t bit = (uint64_t)1 << block % 64;
    region->solid[block / 64] =
        is_solid ? region->solid[block / 64] | bit : region->solid[block / 64] & ~bit;
}

/* May the block have an occupied voxel? */
static inline int cm_block_is_solid(const cm_region *region, unsigned block)
{
    return (int)(region->solid[block / 64] >> block % 64 & 1u);
}

static inline int cm_has_one_color(const cm_region *region, unsigned block)
{
    return region->one_color[block / 8] >> block % 8 & 1;
}

/* What hits and misses do. */
typedef struct cm_count_rule
{
    uint8_t hit;
    uint8_t miss;
    uint8_t low;
    uint8_t high;
} cm_count_rule;

struct cm_octree
{
    cm_octree_options options;
    cm_count_rule rule;
    const cm_octree_set *set;
    int tree_level; /* of the root node: levels, but CM_REGION_LEVEL at least */
    uint32_t first
        [3]; /* of the voxels of the map itself, which a small one does not fill its region with */
    uint32_t beyond[3]; /* and the first behind them */
    uint32_t step;
    uint64_t clock; /* counts what needs regions */

    cm_node *node; /* the root is the first */
    size_t node_count;
    size_t node_room;
    uint32_t free_eight; /* the first of a list of eights, linked by their first node; 0: none */

    cm_region **region;
    size_t region_count; /* entries that were ever used */
    size_t region_room;
    uint32_t *free_region; /* indices to be used again */
    size_t free_region_count;
    size_t free_region_room;
    uint64_t bytes; /* of regions in memory with their blocks */

    _Atomic(struct cm_ray_index *) ray_index; /* ray_index.h; NULL: none */
    _Atomic(uint64_t) rays_asked;             /* since the map changed, while there is none */

    void *user_data;
    size_t user_data_count;
    char *instructions;
    void *desk; /* memory of updates, kept between them: update_desk.h */
    void (*desk_destroy)(void *desk);
};

/* What misses take from alpha. */
static inline uint8_t cm_taken_by(const cm_count_rule *rule, unsigned misses)
{
    return (uint8_t)(misses * rule->miss < 255 ? misses * rule->miss : 255);
}

/* alpha with so much taken, down to the lowest and no further; bytes and no branches, for many at a time. */
static inline uint8_t cm_lowered(uint8_t alpha, uint8_t taken, uint8_t low)
{
    const uint8_t less = (uint8_t)(alpha > taken ? alpha - taken : 0);
    const uint8_t bottom = alpha < low ? alpha : low;
    return less > bottom ? less : bottom;
}

/* alpha after so many misses. */
static inline uint8_t cm_after_misses(const cm_count_rule *rule, unsigned alpha, unsigned misses)
{
    return cm_lowered((uint8_t)alpha, cm_taken_by(rule, misses), (uint8_t)rule->low);
}

/* Misses that wait, and more. */
static inline uint8_t cm_more_misses(unsigned misses, unsigned more)
{
    return (uint8_t)(misses + more < CM_MISSES_MOST ? misses + more : CM_MISSES_MOST);
}

/* How many hits an occupied alpha holds: the weight of its color. */
static inline unsigned cm_hits_of(const cm_count_rule *rule, unsigned alpha)
{
    return alpha <= CM_UNKNOWN ? 0 : (alpha - CM_UNKNOWN + rule->hit - 1u) / rule->hit;
}

#endif
