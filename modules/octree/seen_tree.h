/* SPDX-License-Identifier: MIT
 *
 * What is occupied in a map at a moment, for tracing: a tree whose nodes have 8^3 children, down to blocks of 8^3 voxels, with
 * averages of each level. It is read only.
 *
 *   place     of voxels: counted from the tree's lower corner, which is a multiple of the size of the top's children
 *   stage     of nodes: blocks are of stage 0; those of stage s have 8^(s + 1) voxels each way
 *   index     of children: in the order of keys, as cells of blocks are, so that a byte of the mask is a cube of 2^3 children
 *             and a word one of 4^3
 *   opacity   how much of a cell is hidden by what is occupied in it, seen along each axis. A voxel is occupied or it is not: its
 *             confidence makes nothing transparent. What a wall of one voxel hides does not grow less with the level
 */
#ifndef MODULES_OCTREE_SEEN_TREE_H
#define MODULES_OCTREE_SEEN_TREE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/octree.h>

#define CM_SNAPSHOT_STAGES 7

/* A cell above level 0 that is not empty. 255 is 1. */
typedef struct cm_seen_cell
{
    uint8_t opacity[3]; /* along x, y, z */
    uint8_t part;       /* of its volume; 1 at least */
    uint8_t color[3];
    uint8_t unused;
} cm_seen_cell;

/* Its cells lie together: the node's own, then those of 4^3 children that are not empty, in the order of words of the mask,
 * then those of 2^3 children. */
typedef struct cm_seen_node
{
    uint64_t mask[8];   /* of children that are not empty */
    uint64_t pairs;     /* of 2^3 children */
    uint16_t before[8]; /* children in the words before */
    uint32_t child; /* of stage 0: the first color; else the first of 512 children in `children` */
    uint32_t cell;  /* the first */
    uint8_t quarters; /* of 4^3 children */
    uint8_t quarter_count;
    uint8_t is_copy;  /* what is below it and its cells are those of the stage's full node */
    int32_t place[3]; /* of its lower corner, in its own size */
} cm_seen_node;

typedef struct cm_snapshot
{
    cm_seen_node *node[CM_SNAPSHOT_STAGES]; /* of each stage, in the order of keys */
    size_t node_count[CM_SNAPSHOT_STAGES];
    /* Nodes that are full are alike below: of each stage one stands, behind the last of `node`, and the rest are copies of it. */
    cm_seen_node full[CM_SNAPSHOT_STAGES];
    int full_top;       /* the last stage with a full node; -1: there is none */
    int top;            /* the stage with one node; -1: nothing is occupied */
    int64_t middle;     /* of the map, in voxels from the corner of its tree */
    int64_t corner[3];  /* of the tree, in voxels from the root's centre */
    uint32_t *children; /* tables of 512 nodes of the stage below */
    size_t table_count;
    cm_seen_cell *cell;
    size_t cell_count;
    uint32_t *color; /* of voxels, as color_word.c has them; 0: none */
    size_t color_count;
    cm_seen_cell of_voxels[256]; /* cells of 2^3 voxels, without color, by which are occupied */
    uint8_t count_of[256];       /* how many those are */
    float thickness[256]; /* of opacities: the logarithm to the base 1/2 of what is let through */
} cm_snapshot;

/* How many bits are 1. */
static inline unsigned cm_bit_count(uint64_t bits)
{
    bits -= bits >> 1 & 0x5555555555555555u;
    bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (unsigned)(bits * 0x0101010101010101u >> 56);
}

/* The number of the lowest bit that is 1; there is one. */
static inline unsigned cm_lowest_bit(uint64_t bits)
{
#if defined(__GNUC__)
    return (unsigned)__builtin_ctzll(bits);
#else
    return cm_bit_count((bits & (~bits + 1)) - 1);
#endif
}

/* 2 to the power of a level. */
static inline double cm_size_of_level(int level)
{
    return (double)((uint64_t)1 << level);
}

/* Bits below number n of 0 to 63. */
static inline uint64_t cm_bits_below(unsigned n)
{
    return ((uint64_t)1 << n) - 1;
}

#endif
