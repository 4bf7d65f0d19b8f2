/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "auto.h"
#include "filter_set.h"
#include "level_object.h"
#include "survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Blocks of the target that are looked at for geometry, and groups of them whose values are compared. */
#define BLOCKS_MOST 48
#define COMPARED_MOST 24

/* Pixels around a group from where on splines of its window are as those of the plane. */
#define MARGIN 16

/* Windows are not larger than this many pixels; groups that need more are not compared. */
#define WINDOW_MOST 16384

#define MINIFIED 1.2f

/* What has been seen of the geometry. */
typedef struct survey
{
    size_t pixels;
    size_t long_ones; /* whose major axis is above MINIFIED */
    int is_small;     /* is a minor axis above it? */
    int is_exact;     /* are all positions pixels' centres? */
} survey;

/* What has been seen of values. */
typedef struct comparison
{
    double square[3]; /* of differences of bilinear, catmull-rom, spline36 */
    double value;     /* the square of values */
    double least;
    double most;
    size_t count;
} comparison;

static const cm_filter candidates[3] = {CM_FILTER_BILINEAR, CM_FILTER_CATMULL_ROM,
                                        CM_FILTER_SPLINE36};

typedef struct auto_desk
{
    const cm_plan *plan;
    const cm_sample_set *samplers;
    cm_level level; /* of the pictures, without borders */
    const cm_filter_set *set;
    cm_scratch scratch;
    survey seen;
    comparison values;
    unsigned compared;        /* groups */
    cm_filter_table table[4]; /* of no use to bilinear; of catmull-rom, spline36, bspline5 */
    float *window;
    float *coefficients;
    float *desk;
    float *pixels[2];
} auto_desk;

/* ---- geometry ---- */

static void look_at_group(const cm_group *group, double tolerance, survey *seen)
{
    const double most = fmax(2.0 * tolerance, 1e-3);
    for (unsigned i = 0; i < group->count; i++)
    {
        const float a = group->by_column[0][i], b = group->by_row[0][i];
        const float c = group->by_column[1][i], d = group->by_row[1][i];
        const float half = 0.5f * (a * a + b * b + c * c + d * d);
        const float area = a * d - b * c;
        const float spread = sqrtf(fmaxf(half * half - area * area, 0.0f));
        const float major = half + spread;
        if (!(major < 1e18f))
        {
            continue;
        }
        const float minor = major > 0.0f ? area / major * area : 0.0f;
        seen->pixels++;
        seen->long_ones += major > MINIFIED * MINIFIED;
        seen->is_small |= minor > MINIFIED * MINIFIED;
        seen->is_exact &= fabs((double)group->x[i] - round((double)group->x[i])) < most &&
                          fabs((double)group->y[i] - round((double)group->y[i])) < most;
    }
}

/* ---- values ---- */

/* The part of a plane that a group needs, with a margin, as far as the plane has it. 0 if it cannot be compared. */
static int window_of(const auto_desk *desk, const cm_group *group, int32_t at[2], int32_t size[2])
{
    const int32_t extent[2] = {(int32_t)desk->level.width, (int32_t)desk->level.height};
    const int32_t origin[2] = {group->column, group->row};
    for (int axis = 0; axis < 2; axis++)
    {
        const float *place = axis == 0 ? group->x : group->y;
        float low = place[0], high = place[0];
        for (unsigned i = 1; i < group->count; i++)
        {
            low = fminf(low, place[i]);
            high = fmaxf(high, place[i]);
        }
        const int32_t first = origin[axis] + (int32_t)floorf(low);
        const int32_t last = origin[axis] + (int32_t)floorf(high) + 1;
        if (first - 2 < 0 || last + 2 >= extent[axis])
        {
            return 0;
        }
        at[axis] = first > MARGIN ? first - MARGIN : 0;
        size[axis] = (last + MARGIN < extent[axis] ? last + MARGIN + 1 : extent[axis]) - at[axis];
    }
    return (int64_t)size[0] * size[1] <= WINDOW_MOST;
}

static void filter_window(const auto_desk *desk, size_t width, size_t height)
{
    const size_t channels = desk->level.channels;
    const size_t floats = width * channels;
    for (size_t row = 0; row < height; row += CM_BUNDLE_ROWS)
    {
        const size_t rows = height - row < CM_BUNDLE_ROWS ? height - row : CM_BUNDLE_ROWS;
        desk->set->spline_rows(desk->coefficients + row * floats, rows, (ptrdiff_t)floats, floats,
                               channels, desk->desk);
    }
    for (size_t first = 0; first < floats; first += CM_BUNDLE_COLUMNS)
    {
        const size_t count =
            floats - first < CM_BUNDLE_COLUMNS ? floats - first : CM_BUNDLE_COLUMNS;
        desk->set->spline_columns(desk->coefficients + first, count, height, (ptrdiff_t)floats);
    }
}

/* The reference, and each candidate against it. */
static void compare_values(const auto_desk *desk, const cm_group *group, const int32_t at[2],
                           size_t width, comparison *seen)
{
    const cm_sample_set *set = desk->samplers;
    const uint32_t channels = desk->level.channels;
    const size_t whole = (group->count + 15u) / 16 * 16;
    const size_t numbers = (size_t)group->count * channels;
    float x[CM_BLOCK_PIXELS], y[CM_BLOCK_PIXELS];
    for (size_t i = 0; i < whole; i++)
    {
        const size_t k = i < group->count ? i : group->count - 1u;
        x[i] = group->x[k] + (float)(group->column - at[0]);
        y[i] = group->y[k] + (float)(group->row - at[1]);
    }
    cm_window window = {desk->coefficients, (ptrdiff_t)(width * channels * sizeof(float)),
                        channels};
    set->taps6_float(&window, whole, x, y, &desk->table[3], desk->pixels[0]);
    window.data = desk->window;
    for (size_t k = 0; k < numbers; k++)
    {
        const double value = (double)desk->pixels[0][k];
        seen->value += value * value;
        seen->least = fmin(seen->least, value);
        seen->most = fmax(seen->most, value);
    }
    for (int f = 0; f < 3; f++)
    {
        cm_sampler *sampler = f == 0   ? set->bilinear_float
                              : f == 1 ? set->taps4_float
                                       : set->taps6_float;
        sampler(&window, whole, x, y, &desk->table[f], desk->pixels[1]);
        for (size_t k = 0; k < numbers; k++)
        {
            const double off = (double)desk->pixels[1][k] - (double)desk->pixels[0][k];
            seen->square[f] += off * off;
        }
    }
    seen->count += numbers;
}

static cm_status compare_group(auto_desk *desk, const cm_group *group, comparison *seen,
                               unsigned *compared)
{
    int32_t at[2], size[2];
    cm_window window;
    if (*compared >= COMPARED_MOST || group->count < 16 || !window_of(desk, group, at, size))
    {
        return CM_OK;
    }
    const cm_status status = cm_level_window(&desk->level, group->plane, at[0], at[1], size[0],
                                             size[1], &desk->scratch, &window);
    const size_t width = (size_t)size[0];
    const size_t line = width * desk->level.pixel_size;
    for (int32_t row = 0; status == CM_OK && row < size[1]; row++)
    {
        const unsigned char *from = (const unsigned char *)window.data + row * window.row_stride;
        memcpy((unsigned char *)desk->window + (size_t)row * line, from, line);
    }
    if (status == CM_OK)
    {
        memcpy(desk->coefficients, desk->window, line * (size_t)size[1]);
        filter_window(desk, width, (size_t)size[1]);
        compare_values(desk, group, at, width, seen);
        (*compared)++;
    }
    return status;
}

/* What is below the output's rounding, squared. */
static double allowed(cm_pixel_type type, const comparison *seen)
{
    const double range = seen->most - seen->least;
    switch (type)
    {
    case CM_PIXEL_U8:
        return 1.0 / (255.0 * 255.0 * 12.0);
    case CM_PIXEL_U16:
        return 1.0 / (65535.0 * 65535.0 * 12.0);
    case CM_PIXEL_HALF:
        return 0x1p-22 * seen->value / (double)seen->count;
    default:
        return 1e-8 * range * range;
    }
}

/* ---- the sample ---- */

static cm_status look(void *user, const cm_group *group)
{
    auto_desk *desk = user;
    look_at_group(group, desk->plan->options.tolerance, &desk->seen);
    return compare_group(desk, group, &desk->values, &desk->compared);
}

static cm_filter choose(const survey *seen, const comparison *values, cm_pixel_type type)
{
    if (seen->is_small || 2 * seen->long_ones > seen->pixels)
    {
        return CM_FILTER_EWA;
    }
    if (seen->is_exact && seen->pixels > 0)
    {
        return CM_FILTER_NEAREST;
    }
    const double most = values->count > 0 ? allowed(type, values) * (double)values->count : -1.0;
    for (int f = 0; f < 3; f++)
    {
        if (values->square[f] <= most)
        {
            return candidates[f];
        }
    }
    return CM_FILTER_BSPLINE5;
}

static int make_room(auto_desk *desk)
{
    const size_t pixel = desk->level.pixel_size;
    const size_t slack = CM_WINDOW_SLACK;
    const size_t window = cm_size_sum(cm_size_product(WINDOW_MOST, pixel), slack);
    const size_t block = cm_size_sum(cm_size_product(CM_BLOCK_PIXELS, pixel), slack);
    desk->window = calloc(1, window);
    desk->coefficients = calloc(1, window);
    desk->desk = cm_array_of(pixel, CM_BUNDLE_ROWS * WINDOW_MOST);
    desk->pixels[0] = malloc(block);
    desk->pixels[1] = malloc(block);
    return desk->window != NULL && desk->coefficients != NULL && desk->desk != NULL &&
           desk->pixels[0] != NULL && desk->pixels[1] != NULL;
}

static void free_room(auto_desk *desk)
{
    free(desk->window);
    free(desk->coefficients);
    free(desk->desk);
    free(desk->pixels[0]);
    free(desk->pixels[1]);
    free(desk->scratch.bytes);
    cm_level_free(&desk->level);
}

cm_status cm_auto_filter(const cm_plan *plan, const cm_image *from, const cm_values *values,
                         const cm_sample_set *set, cm_pixel_type target_type, cm_filter *filter)
{
    auto_desk *desk = calloc(1, sizeof *desk);
    cm_status status = desk == NULL ? CM_ERROR_MEMORY : CM_OK;
    if (status == CM_OK)
    {
        desk->plan = plan;
        desk->samplers = set;
        desk->set = cm_filter_set_find(set->name);
        status = cm_level_of_pictures(plan->from, from, values, set, 0,
                                      plan->from->has_gaps ? MARGIN : 0, plan->options.memory, 1,
                                      &desk->level);
    }
    if (status == CM_OK)
    {
        desk->seen = (survey){.is_exact = 1};
        desk->values = (comparison){.least = INFINITY, .most = -INFINITY};
        for (int f = 1; f < 3; f++)
        {
            cm_filter_table_fill(candidates[f], &desk->table[f]);
        }
        cm_filter_table_fill(CM_FILTER_BSPLINE5, &desk->table[3]);
        status = make_room(desk) ? cm_survey(plan, BLOCKS_MOST, look, desk) : CM_ERROR_MEMORY;
        if (status == CM_OK)
        {
            *filter = choose(&desk->seen, &desk->values, target_type);
        }
    }
    if (desk != NULL)
    {
        free_room(desk);
        free(desk);
    }
    return status;
}
