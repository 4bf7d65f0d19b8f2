/* SPDX-License-Identifier: MIT
 *
 * Orientations that have a name: what cubemap-orient finds for data/land-1440.png. research/earth/orientations finds them
 * again, and checks them.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/catalogue_words.h"

#include <string.h>

#define DEGREES(x) ((x)*0.017453292519943295769)
#define KILOMETRES(x) ((x) / 6371.0072)

/* The measures are those at the angles, which are rounded, of edges to less: a hundredth of a degree is kilometres there.
 * land-edges is 0.02 km better than what the search finds, by random steps along the crease where that ends. */
static const cm_orientation orientations[] = {
    {sizeof(cm_orientation), "land-coupled", "land least deformed by coupled", "coupled",
     "deformation", 17.15, 9.09, 31.98, DEGREES(12.1204297), DEGREES(9.3319979)},
    {sizeof(cm_orientation), "land-coupled-cubic", "land least deformed by coupled-cubic",
     "coupled-cubic", "deformation", 17.16, 9.13, 31.98, DEGREES(12.1414638), DEGREES(9.3633248)},
    {sizeof(cm_orientation), "land-algebraic", "land least deformed by algebraic", "algebraic",
     "deformation", 16.85, 9.45, 31.68, DEGREES(12.6380473), DEGREES(9.7392314)},
    {sizeof(cm_orientation), "land-tangent", "land least deformed by tangent", "tangent",
     "deformation", 16.60, 9.49, 32.37, DEGREES(10.7155085), DEGREES(8.2883359)},
    {sizeof(cm_orientation), "land-difference", "land least deformed by difference:balanced",
     "difference:balanced", "deformation", 16.74, 10.11, 30.90, DEGREES(6.6108836),
     DEGREES(5.2011221)},
    {sizeof(cm_orientation), "land-seamless", "land least deformed by seamless", "seamless",
     "deformation", 21.41, 11.56, 22.13, DEGREES(12.1956955), DEGREES(10.0244800)},
    {sizeof(cm_orientation), "land-slice", "land least deformed by slice", "slice", "deformation",
     22.30, 12.55, 20.70, DEGREES(12.8404470), DEGREES(11.1646705)},
    {sizeof(cm_orientation), "land-qsc", "land least deformed by qsc", "qsc", "deformation", 12.60,
     21.43, 16.81, DEGREES(16.0326711), DEGREES(15.0375119)},
    {sizeof(cm_orientation), "land-edges", "land least cut by the edges of any cube", "coupled",
     "edges", 23.5516, -1.4491, 33.3335, KILOMETRES(26092.1834), KILOMETRES(9531.5719)},
};

size_t cm_orientation_count(void)
{
    return sizeof orientations / sizeof orientations[0];
}

const cm_orientation *cm_orientation_at(size_t index)
{
    return index < cm_orientation_count() ? &orientations[index] : NULL;
}

const cm_orientation *cm_orientation_find(const char *identifier)
{
    for (size_t i = 0; i < cm_orientation_count() && identifier != NULL; i++)
    {
        const char *name = orientations[i].identifier;
        if (cm_word_equal(name, strlen(name), identifier, strlen(identifier)))
        {
            return &orientations[i];
        }
    }
    return NULL;
}
