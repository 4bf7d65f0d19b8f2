/* SPDX-License-Identifier: MIT
 *
 * Pictures of differences: maps of numbers, and their colours.
 */
#include "compare_pixels.h"

#include <cubemap/threads.h>

#include <math.h>

enum
{
    RUN = 256,        /* pixels that are read at a time */
    THREAD_STEP = 64, /* cm_run_threads cuts at multiples of that */
    LEAST_ROWS = 16   /* that are worth a thread */
};

typedef struct difference_job
{
    const cm_compare_pair *pair;
    const cm_image *map;
} difference_job;

static void find_differences(const cm_compare_pair *pair, uint64_t row, uint32_t column,
                             size_t count, double to[RUN])
{
    for (size_t i = 0; i < count; i++)
    {
        to[i] = 0.0;
    }
    for (uint32_t c = 0; c < pair->picture.channels; c++)
    {
        double one[RUN];
        double other[RUN];
        cm_compare_read(&pair->reference, row, column, count, c, one);
        cm_compare_read(&pair->picture, row, column, count, c, other);
        for (size_t i = 0; i < count; i++)
        {
            const double error = fabs(other[i] - one[i]);
            const double found = isfinite(error) ? error : (double)NAN;
            to[i] = isnan(found) || found > to[i] ? found : to[i]; /* a NaN stays */
        }
    }
}

static void map_rows(size_t begin, size_t end, void *user)
{
    const difference_job *const job = user;
    for (size_t row = begin / THREAD_STEP; row < end / THREAD_STEP; row++)
    {
        for (uint64_t column = 0; column < job->map->width; column += RUN)
        {
            const uint64_t left = job->map->width - column;
            const size_t count = left < RUN ? (size_t)left : RUN;
            double found[RUN];
            find_differences(job->pair, row, (uint32_t)column, count, found);
            cm_compare_write(job->map, row, (uint32_t)column, count, 0, found);
        }
    }
}

cm_status cm_difference_map(const cm_image *reference, const cm_image *picture, unsigned threads,
                            const cm_image *map)
{
    cm_compare_pair pair;
    cm_image to;
    cm_status status = cm_compare_pair_of(reference, picture, NULL, &pair);
    if (status == CM_OK)
    {
        status = cm_compare_map(map, &pair.picture, &to);
    }
    if (status == CM_OK)
    {
        difference_job job = {&pair, &to};
        cm_run_threads(threads, (size_t)to.height * THREAD_STEP, LEAST_ROWS * THREAD_STEP, map_rows,
                       &job);
    }
    return status;
}

cm_status cm_draw_map(const cm_image *map, double low, double high, cm_map_color color, void *user,
                      const cm_image *to, uint64_t *beyond)
{
    cm_image from, drawn;
    if (cm_compare_image(map, &from) != CM_OK || cm_compare_map(map, &from, &from) != CM_OK ||
        cm_compare_image(to, &drawn) != CM_OK || color == NULL || !(low < high) ||
        !isfinite(high - low))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (drawn.width != from.width || drawn.height != from.height ||
        (drawn.channels != 3 && drawn.channels != 4))
    {
        return CM_ERROR_RANGE;
    }
    uint64_t outside = 0;
    for (uint32_t row = 0; row < from.height; row++)
    {
        for (uint32_t column = 0; column < from.width; column++)
        {
            double value, rgba[4] = {0.0, 0.0, 0.0, 1.0};
            cm_compare_read(&from, row, column, 1, 0, &value);
            const double t = (value - low) / (high - low);
            outside += t < 0.0 || t > 1.0;
            color(t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t, rgba, user);
            for (uint32_t c = 0; c < drawn.channels; c++)
            {
                cm_compare_write(&drawn, row, column, 1, c, &rgba[c]);
            }
        }
    }
    if (beyond != NULL)
    {
        *beyond = outside;
    }
    return CM_OK;
}
