/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include <math.h>
#include <stdlib.h>

#include "bands.h"
#include "depth_set.h"

/* Cells each way of the last level. */
#define CELLS_MOST 8
#define LEVELS_MOST 32

/* Rows that the last levels of a band have; bands are shared out by so many pixels. */
#define GROUP_LEVEL 6
#define GROUP (1u << GROUP_LEVEL)

typedef struct pyramid_level
{
    size_t width;
    size_t height;
    float *least;
    float *most;
} pyramid_level;

struct cm_depth_pyramid
{
    const cm_depth_set *set;
    cm_pool *pool; /* whose threads do the work; NULL: threads are made for it */
    size_t width;
    size_t height;
    uint32_t last;
    float *memory;
    pyramid_level level[LEVELS_MOST]; /* 0 has no arrays: it is the image */
};

/* ---- life ---- */

static size_t half_of(size_t n)
{
    return n / 2 + n % 2;
}

/* The floats that all levels need. */
static size_t lay_out(cm_depth_pyramid *p, float *memory)
{
    size_t floats = 0;
    p->level[0] = (pyramid_level){.width = p->width, .height = p->height};
    p->last = 0;
    do
    {
        const pyramid_level *below = &p->level[p->last];
        pyramid_level *next = &p->level[++p->last];
        *next = (pyramid_level){.width = half_of(below->width), .height = half_of(below->height)};
        const size_t cells = next->width * next->height;
        if (memory != NULL)
        {
            next->least = memory + floats;
            next->most = memory + floats + cells;
        }
        floats += 2 * cells;
    } while (p->level[p->last].width > CELLS_MOST || p->level[p->last].height > CELLS_MOST);
    return floats;
}

cm_status cm_depth_pyramid_create(uint32_t width, uint32_t height, const char *instructions,
                                  cm_depth_pyramid **pyramid)
{
    if (pyramid == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (width == 0 || height == 0 || (uint64_t)width * height >= (uint64_t)1 << 31)
    {
        return CM_ERROR_RANGE;
    }
    const cm_depth_set *set = cm_depth_set_find(instructions);
    if (set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_depth_pyramid *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->set = set;
    made->width = width;
    made->height = height;
    const size_t floats = lay_out(made, NULL);
    made->memory = calloc(floats, sizeof *made->memory);
    if (made->memory == NULL)
    {
        free(made);
        return CM_ERROR_MEMORY;
    }
    lay_out(made, made->memory);
    *pyramid = made;
    return CM_OK;
}

void cm_depth_pyramid_destroy(cm_depth_pyramid *pyramid)
{
    if (pyramid != NULL)
    {
        free(pyramid->memory);
        free(pyramid);
    }
}

/* ---- filling ---- */

typedef struct filling
{
    const cm_depth_pyramid *pyramid;
    const float *image;
} filling;

/* A row of level 1. An odd last column or row is taken twice. */
static void fill_first(const filling *f, size_t row)
{
    const cm_depth_pyramid *p = f->pyramid;
    const pyramid_level *to = &p->level[1];
    const float *above = f->image + 2 * row * p->width;
    const float *below = 2 * row + 1 < p->height ? above + p->width : above;
    float *least = to->least + row * to->width;
    float *most = to->most + row * to->width;
    p->set->bound_pixels(p->width / 2, above, below, least, most);
    if (p->width % 2 != 0)
    {
        const float ends[2][2] = {{above[p->width - 1], above[p->width - 1]},
                                  {below[p->width - 1], below[p->width - 1]}};
        p->set->bound_pixels(1, ends[0], ends[1], least + to->width - 1, most + to->width - 1);
    }
}

static void fill_next(const filling *f, uint32_t level, size_t row)
{
    const cm_depth_pyramid *p = f->pyramid;
    const pyramid_level *from = &p->level[level - 1];
    const pyramid_level *to = &p->level[level];
    const size_t above = 2 * row * from->width;
    const size_t below = 2 * row + 1 < from->height ? above + from->width : above;
    const float *least_of[2] = {from->least + above, from->least + below};
    const float *most_of[2] = {from->most + above, from->most + below};
    float *least = to->least + row * to->width;
    float *most = to->most + row * to->width;
    p->set->bound_cells(from->width / 2, least_of, most_of, least, most);
    if (from->width % 2 != 0)
    {
        const size_t end = from->width - 1;
        const float ends[4][2] = {{least_of[0][end], least_of[0][end]},
                                  {least_of[1][end], least_of[1][end]},
                                  {most_of[0][end], most_of[0][end]},
                                  {most_of[1][end], most_of[1][end]}};
        const float *least_ends[2] = {ends[0], ends[1]};
        const float *most_ends[2] = {ends[2], ends[3]};
        p->set->bound_cells(1, least_ends, most_ends, least + to->width - 1, most + to->width - 1);
    }
}

/* All levels that groups of rows make by themselves. */
static void fill_band(size_t first, size_t last, size_t band, void *user)
{
    const filling *f = user;
    const cm_depth_pyramid *p = f->pyramid;
    (void)band;
    for (size_t group = first; group < last; group += GROUP)
    {
        for (uint32_t level = 1; level <= p->last && level <= GROUP_LEVEL; level++)
        {
            const size_t begin = group >> level;
            const size_t end = (group + GROUP) >> level;
            for (size_t row = begin; row < end && row < p->level[level].height; row++)
            {
                if (level == 1)
                {
                    fill_first(f, row);
                }
                else
                {
                    fill_next(f, level, row);
                }
            }
        }
    }
}

cm_status cm_depth_pyramid_use_pool(cm_depth_pyramid *pyramid, cm_pool *pool)
{
    if (pyramid == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    pyramid->pool = pool;
    return CM_OK;
}

size_t cm_depth_pyramid_pixel_count(const cm_depth_pyramid *pyramid)
{
    return pyramid == NULL ? 0 : pyramid->width * pyramid->height;
}

cm_status cm_depth_pyramid_fill(cm_depth_pyramid *pyramid, const float *image, unsigned threads)
{
    if (pyramid == NULL || image == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    filling f = {pyramid, image};
    cm_run_bands(pyramid->pool, cm_band_count(pyramid->pool, threads, pyramid->height, GROUP),
                 pyramid->height, GROUP, fill_band, &f);
    for (uint32_t level = GROUP_LEVEL + 1; level <= pyramid->last; level++)
    {
        for (size_t row = 0; row < pyramid->level[level].height; row++)
        {
            fill_next(&f, level, row);
        }
    }
    return CM_OK;
}

/* ---- asking ---- */

uint32_t cm_depth_pyramid_last(const cm_depth_pyramid *pyramid)
{
    return pyramid == NULL ? 0 : pyramid->last;
}

cm_status cm_depth_pyramid_level(const cm_depth_pyramid *pyramid, uint32_t level,
                                 cm_depth_level *cells)
{
    if (pyramid == NULL || cells == NULL || cells->size != sizeof *cells || level == 0 ||
        level > pyramid->last)
    {
        return CM_ERROR_ARGUMENT;
    }
    const pyramid_level *found = &pyramid->level[level];
    *cells = (cm_depth_level){.size = sizeof *cells,
                              .width = (uint32_t)found->width,
                              .height = (uint32_t)found->height,
                              .least = found->least,
                              .most = found->most};
    return CM_OK;
}

static void take_cell(float least, float most, cm_depth_bounds *bounds)
{
    bounds->least = fabsf(least) < bounds->least ? fabsf(least) : bounds->least;
    bounds->most = most > bounds->most ? most : bounds->most;
    bounds->has_unmeasured |= least < 0.0f;
}

cm_status cm_depth_pyramid_bounds(const cm_depth_pyramid *pyramid, uint32_t column, uint32_t row,
                                  uint32_t last_column, uint32_t last_row, cm_depth_bounds *bounds)
{
    if (pyramid == NULL || bounds == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (column > last_column || row > last_row || last_column >= pyramid->width ||
        last_row >= pyramid->height)
    {
        return CM_ERROR_RANGE;
    }
    uint32_t level = 1;
    while (level < pyramid->last && ((last_column >> level) - (column >> level) > 2 ||
                                     (last_row >> level) - (row >> level) > 2))
    {
        level++;
    }
    const pyramid_level *cells = &pyramid->level[level];
    cm_depth_bounds found = {.least = INFINITY};
    for (size_t j = row >> level; j <= last_row >> level; j++)
    {
        for (size_t i = column >> level; i <= last_column >> level; i++)
        {
            const size_t at = j * cells->width + i;
            take_cell(cells->least[at], cells->most[at], &found);
        }
    }
    *bounds = found;
    return CM_OK;
}
