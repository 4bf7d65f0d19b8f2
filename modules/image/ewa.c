/* SPDX-License-Identifier: MIT
 *
 * From derivatives to footprints, and which level of the pyramid they are laid on.
 */
#include "ewa.h"

#include <math.h>
#include <string.h>

/* ---- the kernel ---- */

/* The first two zeros of jinc. */
#define JINC_ONE 1.2196698912665045
#define JINC_TWO 2.2331305943815286

#define PI 3.14159265358979323846

/* 2 J1(pi x) / (pi x), by its series (Abramowitz, Stegun 9.1.10). */
static double jinc(double x)
{
    const double quarter = -0.25 * PI * PI * x * x;
    double sum = 1.0;
    double term = 1.0;
    for (int k = 1; k < 40; k++)
    {
        term *= quarter / ((double)k * (k + 1));
        sum += term;
    }
    return sum;
}

/* The kernel over u^2, where u is 1 less the square of the place, 0 at the kernel's edge: it has a double zero there. */
static double smooth_part(double u)
{
    const double x = sqrt(1.0 - u) * JINC_TWO;
    return jinc(x) * jinc(x * JINC_ONE / JINC_TWO) / (u * u);
}

/* The polynomial through that at Chebyshev's points, by divided differences. */
static void make_kernel(cm_ewa_kernel *kernel)
{
    enum
    {
        N = CM_EWA_TERMS
    };
    double at[N], difference[N], term[N] = {0};
    for (int i = 0; i < N; i++)
    {
        at[i] = 0.5 + 0.5 * cos(PI * (i + 0.5) / N);
        difference[i] = smooth_part(at[i]);
    }
    for (int order = 1; order < N; order++)
    {
        for (int i = N - 1; i >= order; i--)
        {
            difference[i] = (difference[i] - difference[i - 1]) / (at[i] - at[i - order]);
        }
    }
    for (int i = N - 1; i >= 0; i--)
    {
        for (int k = N - 1; k > 0; k--)
        {
            term[k] = term[k - 1] - at[i] * term[k];
        }
        term[0] = difference[i] - at[i] * term[0];
    }
    for (int i = 0; i < N; i++)
    {
        kernel->term[i] = (float)term[i];
    }
    kernel->radius = (float)JINC_TWO;
}

/* ---- life ---- */

cm_status cm_ewa_make(const cm_surface *surface, const cm_image *pictures, const cm_values *values,
                      const cm_sample_set *set, const cm_filter_table *table, double pixels_most,
                      const cm_memory *memory, unsigned threads, cm_ewa *ewa)
{
    memset(ewa, 0, sizeof *ewa);
    ewa->set = cm_filter_set_find(set->name);
    ewa->table = table;
    ewa->pixels_most = (float)fmin(pixels_most, 1e9);
    make_kernel(&ewa->kernel);
    const unsigned count = cm_level_count(surface->width, surface->height);
    const cm_status status =
        cm_pyramid_make(surface, pictures, values, set, count, memory, threads, &ewa->pyramid);
    for (unsigned k = 0; status == CM_OK && k < count; k++)
    {
        ewa->across[k] = (float)ewa->pyramid.level[k].width / (float)surface->width;
        ewa->down[k] = (float)ewa->pyramid.level[k].height / (float)surface->height;
    }
    return status;
}

void cm_ewa_free(cm_ewa *ewa)
{
    cm_pyramid_free(&ewa->pyramid);
}

/* ---- footprints ---- */

static int32_t floor_of(double x)
{
    const int32_t towards_zero = (int32_t)x;
    return towards_zero - ((double)towards_zero > x);
}

/* A group at work. */
typedef struct ewa_desk
{
    const cm_group *group;
    cm_ewa_axes axes;
    cm_ewa_shapes shapes;
} ewa_desk;

/* A footprint in pixels of its level, from the origin (column, row), a pixel's centre. */
static cm_ewa_footprint place_on(const cm_ewa *ewa, const ewa_desk *desk, unsigned i, unsigned k,
                                 int32_t *column, int32_t *row)
{
    const cm_group *group = desk->group;
    const cm_ewa_shapes *shapes = &desk->shapes;
    const cm_padded *level = &ewa->pyramid.level[k];
    const double x = ((double)group->column + (double)group->x[i] + 0.5) * (double)ewa->across[k];
    const double y = ((double)group->row + (double)group->y[i] + 0.5) * (double)ewa->down[k];
    *column = floor_of(x);
    *row = floor_of(y);
    const cm_ewa_footprint print = {.x = (float)(x - 0.5 - *column),
                                    .y = (float)(y - 0.5 - *row),
                                    .a = shapes->a[i],
                                    .b = shapes->b[i],
                                    .c = shapes->c[i],
                                    .half_width = shapes->half_width[i],
                                    .half_height = shapes->half_height[i],
                                    .left = -level->beside - *column,
                                    .top = -level->beyond - *row,
                                    .right = (int32_t)level->width + level->beside - 1 - *column,
                                    .bottom = (int32_t)level->height + level->beyond - 1 - *row};
    return print;
}

/* Are all pixels of the footprint there? */
static int is_whole(const cm_ewa_footprint *print)
{
    return print->half_width <= (float)(-1 - print->left) &&
           print->half_width <= (float)(print->right - 1) &&
           print->half_height <= (float)(-1 - print->top) &&
           print->half_height <= (float)(print->bottom - 1);
}

/* How much of the value is that of spline36: all of it to where the major axis is one pixel, none from 5/4. */
static float sharpness(float major)
{
    const float rest = major >= 1.5625f ? 0.0f : (1.25f - sqrtf(major)) * 4.0f;
    return rest > 1.0f ? 1.0f : rest;
}

static void choose_scale(const cm_ewa *ewa, ewa_desk *desk, unsigned i, unsigned k)
{
    desk->axes.level[i] = (int32_t)k;
    desk->shapes.across[i] = ewa->across[k];
    desk->shapes.down[i] = ewa->down[k];
}

/* The footprints of a run of pixels that are not whole on their levels, on coarser ones. Shapes are made in runs only, so
 * that each has the same bits. */
static void make_whole(const cm_ewa *ewa, ewa_desk *desk)
{
    const unsigned last = ewa->pyramid.count - 1;
    const unsigned count = desk->group->count;
    for (int again = 1; again;)
    {
        again = 0;
        ewa->set->ewa_shapes(count, &desk->axes, &ewa->kernel, ewa->pixels_most, &desk->shapes);
        for (unsigned i = 0; i < count; i++)
        {
            int32_t column, row;
            const unsigned k = (unsigned)desk->axes.level[i];
            const cm_ewa_footprint print = place_on(ewa, desk, i, k, &column, &row);
            if (k < last && !is_whole(&print))
            {
                choose_scale(ewa, desk, i, k + 1);
                again = 1;
            }
        }
    }
}

static void do_pixel(const cm_ewa *ewa, const ewa_desk *desk, unsigned i, float *to)
{
    const float sharp = sharpness(desk->axes.major[i]);
    const unsigned k = (unsigned)desk->axes.level[i];
    const cm_padded *level = &ewa->pyramid.level[k];
    int32_t column, row;
    const cm_ewa_footprint print = place_on(ewa, desk, i, k, &column, &row);
    const float *first = level->first[desk->group->plane] + row * level->row + column;
    if (sharp < 1.0f)
    {
        (is_whole(&print) ? ewa->set->ewa_sum : ewa->set->ewa_sum_cut)(
            first, level->row, level->channel, level->channels, &print, &ewa->kernel, to);
    }
    if (sharp > 0.0f)
    {
        ewa->set->ewa_sharp(first, level->row, level->channel, level->channels, &print, ewa->table,
                            sharp, to);
    }
}

void cm_ewa_group(const cm_ewa *ewa, const cm_group *group, float *to)
{
    ewa_desk desk;
    const uint32_t channels = ewa->pyramid.level[0].channels;
    desk.group = group;
    ewa->set->ewa_axes(group->count, group->by_column[0], group->by_column[1], group->by_row[0],
                       group->by_row[1], CM_EWA_MINOR, ewa->pyramid.count, &desk.axes);
    for (unsigned i = 0; i < group->count; i++)
    {
        choose_scale(ewa, &desk, i, (unsigned)desk.axes.level[i]);
    }
    make_whole(ewa, &desk);
    for (unsigned i = 0; i < group->count; i++)
    {
        do_pixel(ewa, &desk, i, to + (size_t)i * channels);
    }
}
