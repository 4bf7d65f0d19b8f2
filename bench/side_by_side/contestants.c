/* SPDX-License-Identifier: MIT
 *
 * The list of contestants.
 */
#include "side_by_side.h"

#include <stdlib.h>
#include <string.h>

int roster_wants(const roster *all, const char *group)
{
    for (size_t i = 0; i < all->group_count; i++)
    {
        if (strcmp(all->groups[i], group) == 0)
        {
            return 1;
        }
    }
    return 0;
}

void roster_add(roster *all, const contestant *entrant)
{
    all->list = grow(all->list, all->count, sizeof *all->list);
    all->list[all->count++] = *entrant;
}

void roster_sort(roster *all)
{
    contestant *sorted = allocate(all->count, sizeof *sorted);
    size_t count = 0;
    for (size_t g = 0; g < all->group_count; g++)
    {
        for (size_t i = 0; i < all->count; i++)
        {
            if (strcmp(all->list[i].group, all->groups[g]) == 0)
            {
                sorted[count++] = all->list[i];
            }
        }
    }
    free(all->list);
    all->list = sorted;
}

void roster_close(roster *all)
{
    for (size_t i = 0; i < all->count; i++)
    {
        contestant *c = &all->list[i];
        if (c->close != NULL)
        {
            c->close(c);
        }
        free(c->samples[FORWARD]);
        free(c->samples[INVERSE]);
    }
    free(all->list);
}

void contestant_label(const contestant *c, char *text, size_t size)
{
    if (!c->own)
    {
        snprintf(text, size, "%s %s", c->library, c->name);
        return;
    }
    snprintf(text, size, "%s, %s%s%s%s%s%s%s", c->narrow ? "float" : "double", c->path,
             strcmp(c->tier, "exact") == 0 ? "" : ", ",
             strcmp(c->tier, "exact") == 0 ? "" : c->tier, c->name[0] == '\0' ? "" : ", ", c->name,
             strcmp(c->group, c->specification) == 0 ? "" : ", ",
             strcmp(c->group, c->specification) == 0 ? "" : c->specification);
}

const char *contestant_takes(const contestant *c)
{
    return c->unit == 0.0   ? "vectors"
           : c->unit == 1.0 ? "lon, lat in radians"
                            : "lon, lat in degrees";
}
