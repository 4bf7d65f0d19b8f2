/* SPDX-License-Identifier: MIT
 *
 * The loops of an instruction set by its name.
 */
#ifndef MODULES_OCTREE_NAMED_SET_H
#define MODULES_OCTREE_NAMED_SET_H

#include <stddef.h>
#include <string.h>

/* Of sets that begin with their name the one of that name, else the first: a build need not have all. */
static inline const void *cm_named_set(const char *name, const void *const *sets, size_t count)
{
    const void *found = sets[0];
    for (size_t i = 1; i < count; i++)
    {
        found = strcmp(name, *(const char *const *)sets[i]) == 0 ? sets[i] : found;
    }
    return found;
}

#endif
