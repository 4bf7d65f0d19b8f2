/* SPDX-License-Identifier: MIT
 *
 * Memory of the rows of views that are made one after the other.
 */
#include "modules/memory/checked_size.h"
#include "view_table.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "huge_pages.h"

void cm_view_bands_clear(cm_view_desk *desk)
{
    for (size_t i = 0; i < desk->bands; i++)
    {
        free(desk->band[i].memory);
        free(desk->band[i].is_break);
        free(desk->band[i].heard.is_taken);
    }
    free(desk->band);
    desk->band = NULL;
    desk->bands = 0;
}

/* Floats between the planes of a band: what lies at the same place of several is worked on together, and would share few lines of
 * the cache if planes were a multiple of its ways apart. */
#define PLANES_APART (9 * CM_OCTREE_SLACK)

/* The first whole line of the cache in some memory: vectors of rows that begin in one do not reach over two. */
static float *line_of(float *memory)
{
    const size_t beside = (uintptr_t)memory / sizeof *memory % CM_OCTREE_SLACK;
    return beside == 0 ? memory : memory + (CM_OCTREE_SLACK - beside);
}

/* What is beside rows is never written again: nothing measured, no bounds. */
static int take_band(const cm_view_desk *desk, cm_view_band *band)
{
    const size_t ring = CM_BAND_ROWS * desk->stride;
    float **const rings[] = {&band->inverse,        &band->reach,           &band->front,
                             &band->back,           &band->heard.own_front, &band->heard.near_front,
                             &band->heard.near_back};
    const size_t count = sizeof rings / sizeof *rings, runs = desk->stride / CM_BREAK_RUN;
    const size_t plane = ring + PLANES_APART;
    const size_t floats = count * plane + desk->stride + CM_OCTREE_SLACK;
    band->memory = cm_huge_allocate(cm_size_product(floats, sizeof *band->memory));
    band->is_break = calloc(CM_BAND_ROWS * runs, sizeof *band->is_break);
    band->heard.is_taken = calloc(CM_BAND_ROWS, runs);
    if (band->memory == NULL || band->is_break == NULL || band->heard.is_taken == NULL)
    {
        return 0;
    }
    for (size_t i = 0; i < floats; i++)
    {
        band->memory[i] = NAN;
    }
    float *next = line_of(band->memory) + CM_OCTREE_SLACK;
    for (size_t i = 0; i < count; i++, next += plane)
    {
        *rings[i] = next;
    }
    band->heard.stride = desk->stride;
    band->heard.front = band->front;
    band->beyond = next;
    return 1;
}

int cm_view_bands_take(cm_view_desk *desk, size_t bands)
{
    if (bands > desk->bands)
    {
        cm_view_band *more = cm_array_resized(desk->band, bands, sizeof *more);
        if (more == NULL)
        {
            return 0;
        }
        desk->band = more;
    }
    while (desk->bands < bands)
    {
        cm_view_band *band = &desk->band[desk->bands++];
        memset(band, 0, sizeof *band);
        if (!take_band(desk, band))
        {
            cm_view_bands_clear(desk);
            return 0;
        }
    }
    return 1;
}
