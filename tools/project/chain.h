/* SPDX-License-Identifier: MIT
 *
 * What stands between longitude and latitude and the plane, made from the words of a command line: ellipsoid,
 * latitude, rotation, mapping, and cells or pixels.
 */
#ifndef CUBEMAP_TOOLS_CHAIN_H
#define CUBEMAP_TOOLS_CHAIN_H

#include <stdbool.h>

#include "point_filter.h"
#include "tools/cli/failure.h"

/* The options' arguments, NULL for those that are not given. */
struct chain_words
{
    const char *mapping;
    const char *frame;
    const char *ellipsoid;
    const char *latitude;
    const char *rotation;
    const char *cell;
    const char *healpix;
    const char *form; /* the option for the form of directions, if one is given: its name */
};

struct chain
{
    cm_mapping *mapping;
    cm_grid *grid;       /* NULL if none is needed */
    cm_cell_grid *cells; /* NULL if there are none */
    cm_healpix *pixels;
    int level; /* of cells */
};

/* False after a failure, if the words are wrong or do not fit together. In either case the chain, which is zeros at
 * first, is to be destroyed. */
bool chain_create(const struct chain_words *words, bool single, struct chain *chain,
                  cm_failure *failure);

void chain_destroy(struct chain *chain);

#endif
