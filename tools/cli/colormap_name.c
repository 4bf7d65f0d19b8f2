/* SPDX-License-Identifier: MIT */
#include "colormap_name.h"

#include <cubemap/colormap.h>

#include <string.h>

const char *colormap_name_at(size_t index)
{
    return index < cm_colormap_count() ? cm_colormap_at(index)->identifier : NULL;
}

cm_nearest nearest_colormap(const char *specification)
{
    cm_nearest nearest = cm_nearest_to(specification, strcspn(specification, ":"));
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const cm_colormap_info *const map = cm_colormap_at(i);
        cm_nearest_try(&nearest, map->identifier, strlen(map->identifier));
        for (const char *word = map->aliases; *word != '\0'; word += strspn(word, " "))
        {
            cm_nearest_try(&nearest, word, strcspn(word, " "));
            word += strcspn(word, " ");
        }
    }
    if (nearest.distance == 0)
    {
        nearest.best = NULL; /* it is not the name that is wrong */
    }
    return nearest;
}
