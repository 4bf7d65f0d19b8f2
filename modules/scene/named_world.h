/* SPDX-License-Identifier: MIT
 *
 * The analytic worlds that have a name, as a table.
 */
#ifndef CUBEMAP_SCENE_NAMED_WORLD_H
#define CUBEMAP_SCENE_NAMED_WORLD_H

#include <cubemap/world.h>

typedef struct named_world
{
    const char *name;
    const cm_primitive *primitives;
    size_t count;
} named_world;

/* NULL if there is none. */
const named_world *find_named_world(const char *name);

#endif
