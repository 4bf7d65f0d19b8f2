/* SPDX-License-Identifier: MIT
 *
 * Nair et al. 2013, section 5.1: slopes, and edges. The chapter leaves a metric of edges open.
 */
#include <cubemap/depth_error.h>

#include "modules/memory/checked_size.h"
#include "depth_error_pair.h"
#include "vector.h"

#include <stdint.h>
#include <stdlib.h>

/* ---- slope ---- */

static int has_planes(const float *const plane[3])
{
    return plane != NULL && plane[0] != NULL && plane[1] != NULL && plane[2] != NULL;
}

cm_status cm_depth_error_slope(size_t n, const float *const normal[3], const float *const truth[3],
                               float *angle)
{
    if (n > 0 && (!has_planes(normal) || !has_planes(truth) || angle == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < n; i++)
    {
        const double a[3] = {(double)normal[0][i], (double)normal[1][i], (double)normal[2][i]};
        const double b[3] = {(double)truth[0][i], (double)truth[1][i], (double)truth[2][i]};
        angle[i] = (float)angle_between(a, b);
    }
    return CM_OK;
}

/* ---- edges ---- */

static int is_jump(float one, float other, double gap)
{
    const double nearer = fmin((double)one, (double)other);
    return cm_error_counts(one, other) && fabs(cm_error_of(one, other)) > gap * nearer;
}

static int is_edge(const float *image, uint32_t width, uint32_t height, uint32_t i, uint32_t j,
                   double gap)
{
    const size_t at = (size_t)j * width + i;
    return (i + 1 < width && is_jump(image[at], image[at + 1], gap)) ||
           (j + 1 < height && is_jump(image[at], image[at + width], gap));
}

/* How many edges are above and left of each corner of pixels: a table of (width + 1) x (height + 1). */
static void count_edges(const float *image, uint32_t width, uint32_t height, double gap,
                        uint32_t *table)
{
    const size_t stride = (size_t)width + 1;
    for (size_t i = 0; i < stride; i++)
    {
        table[i] = 0;
    }
    for (uint32_t j = 0; j < height; j++)
    {
        uint32_t in_row = 0;
        const uint32_t *above = table + (size_t)j * stride;
        uint32_t *below = table + ((size_t)j + 1) * stride;
        below[0] = 0;
        for (uint32_t i = 0; i < width; i++)
        {
            in_row += (uint32_t)is_edge(image, width, height, i, j, gap);
            below[i + 1] = above[i + 1] + in_row;
        }
    }
}

static uint32_t count_box(const uint32_t *table, size_t stride, const uint32_t box[4])
{
    return table[box[3] * stride + box[2]] - table[box[1] * stride + box[2]] -
           table[box[3] * stride + box[0]] + table[box[1] * stride + box[0]];
}

/* How many edges of one table have some of the other within reach. */
static size_t count_matches(const uint32_t *one, const uint32_t *other, uint32_t width,
                            uint32_t height, uint32_t reach)
{
    const size_t stride = (size_t)width + 1;
    size_t matches = 0;
    for (uint32_t j = 0; j < height; j++)
    {
        for (uint32_t i = 0; i < width; i++)
        {
            const uint32_t itself[4] = {i, j, i + 1, j + 1};
            const uint32_t around[4] = {i > reach ? i - reach : 0, j > reach ? j - reach : 0,
                                        width - i > reach + 1 ? i + reach + 1 : width,
                                        height - j > reach + 1 ? j + reach + 1 : height};
            matches += (size_t)(count_box(one, stride, itself) > 0 &&
                                count_box(other, stride, around) > 0);
        }
    }
    return matches;
}

cm_status cm_depth_error_edges(uint32_t width, uint32_t height, const float *depth,
                               const float *truth, double gap, uint32_t reach,
                               cm_depth_edges *edges)
{
    if (depth == NULL || truth == NULL || edges == NULL || edges->size != sizeof *edges)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (width == 0 || height == 0 || (double)width * height >= 0x1p31 || !(gap > 0.0) ||
        isinf(gap) || reach >= 65536)
    {
        return CM_ERROR_RANGE;
    }
    const size_t cells = ((size_t)width + 1) * ((size_t)height + 1);
    uint32_t *measured = cm_array_of(cells, 2 * sizeof *measured);
    if (measured == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    uint32_t *true_ones = measured + cells;
    cm_depth_edges made = {.size = sizeof made};
    count_edges(depth, width, height, gap, measured);
    count_edges(truth, width, height, gap, true_ones);
    made.measured = measured[cells - 1];
    made.true_ones = true_ones[cells - 1];
    made.right = count_matches(measured, true_ones, width, height, reach);
    made.found = count_matches(true_ones, measured, width, height, reach);
    made.precision = made.measured > 0 ? (double)made.right / (double)made.measured : (double)NAN;
    made.recall = made.true_ones > 0 ? (double)made.found / (double)made.true_ones : (double)NAN;
    free(measured);
    *edges = made;
    return CM_OK;
}
