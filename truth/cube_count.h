/* SPDX-License-Identifier: MIT
 *
 * The mappings to six faces, which are the first of the catalogue.
 */
#ifndef TRUTH_CUBE_COUNT_H
#define TRUTH_CUBE_COUNT_H

#include <cubemap/catalogue.h>

static inline size_t cube_count(void)
{
    size_t count = 0;
    while (count < cm_catalogue_count() && cm_catalogue_at(count)->kind == CM_KIND_CUBE)
    {
        count++;
    }
    return count;
}

#endif
