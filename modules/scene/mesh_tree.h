/* SPDX-License-Identifier: MIT
 *
 * A tree of boxes around triangles, and the nearest triangle along a ray.
 */
#ifndef CUBEMAP_SCENE_MESH_TREE_H
#define CUBEMAP_SCENE_MESH_TREE_H

#include "primitive.h"

/* A leaf has triangles first ... first + count - 1 of the tree's list; with count 0, children first and first + 1. */
typedef struct mesh_node
{
    double least[3], greatest[3];
    uint32_t first, count;
} mesh_node;

typedef struct mesh_tree
{
    mesh_node *node;    /* the root is the first; NULL without triangles */
    uint32_t *triangle; /* the list */
} mesh_tree;

struct cm_mesh
{
    cm_mesh_options made_of;
    mesh_tree tree;
};

/* CM_OK, CM_ERROR_MEMORY. The tree is to be freed member by member. */
cm_status mesh_tree_make(const cm_mesh_options *mesh, mesh_tree *tree);

/* The nearest triangle above distance 0 and below found's, in the mesh's axes: 1 if there is one. */
int meet_mesh(const cm_mesh *mesh, const ray *along, meeting *found);

#endif
