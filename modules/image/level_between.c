/* SPDX-License-Identifier: MIT */
#include "lagrange_weights.h"
#include "level_between.h"

#include <string.h>

/* Points of a polynomial each way, which stay inside the neighbour: the nearest ones, not always around the place. */
#define POINTS CM_LEVEL_POINTS

/* Mostly there are six: then the compiler knows. */
static void weigh(double place, unsigned count, double *weight)
{
    if (count == POINTS)
    {
        cm_lagrange_weights(place, POINTS, weight);
        return;
    }
    cm_lagrange_weights(place, (int)count, weight);
}

/* The first of count pixels around a position, and the weights. */
static int32_t points_around(double position, uint32_t extent, unsigned count, double *weight)
{
    double centre = position - 0.5;
    const double nearest = (double)(int32_t)(centre + 0.5);
    /* what is a pixel's centre, but for rounding, is that pixel */
    centre = centre - nearest < 1e-9 && nearest - centre < 1e-9 ? nearest : centre;
    const int32_t most = (int32_t)(extent - count);
    int32_t first = (int32_t)(centre + 1.0) - (int32_t)(count + 1) / 2;
    first = first < 0 ? 0 : first > most ? most : first;
    weigh(centre - first, count, weight);
    return first;
}

void cm_level_put(const cm_level *level, const float *sum, unsigned char *to)
{
    if (!level->is_bytes)
    {
        memcpy(to, sum, level->pixel_size);
        return;
    }
    for (uint32_t c = 0; c < level->channels; c++)
    {
        const float rounded = sum[c] + 0.5f;
        to[c] = rounded < 0.0f ? 0 : rounded > 255.0f ? 255 : (unsigned char)rounded;
    }
}

/* Rows are read sixteen values at a time. */
#define SIXTEEN 16u

/* Channels of a pixel are summed four at a time: compilers make vectors of that. */
#define FOUR 4u
#define ROW_BYTES ((POINTS * (CM_CHANNELS_MAX + 1) + SIXTEEN) * sizeof(float))

/* Rows that weigh something, up to POINTS. */
typedef struct weighed_rows
{
    unsigned count;
    float weight[POINTS];
    const unsigned char *row[POINTS];
} weighed_rows;

/* A rectangle of pixels inside a plane. */
typedef struct pixel_box
{
    unsigned plane;
    int32_t left;
    int32_t top;
    unsigned columns;
    unsigned rows;
} pixel_box;

/* Are pixels bytes, one beside the other, that mean what is stored? */
static int are_bytes(const cm_level *level, unsigned plane)
{
    return !level->is_bytes && level->values->type == CM_PIXEL_U8 &&
           cm_values_are_stored(level->values) &&
           level->plane[plane].pixel_stride == (ptrdiff_t)level->channels;
}

/* Are the rows of a box dense where they are, with so many bytes behind each? */
static int are_dense(const cm_level *level, const pixel_box *box, ptrdiff_t size, ptrdiff_t behind)
{
    const cm_level_plane *from = &level->plane[box->plane];
    const int32_t farthest = from->row_stride < 0 ? box->top : box->top + (int32_t)box->rows - 1;
    const unsigned char *there =
        from->pixels + farthest * from->row_stride + box->left * from->pixel_stride;
    return from->pixel_stride == size &&
           from->end - there >= (ptrdiff_t)box->columns * size + behind;
}

/* Do all nodes weigh something? Else one does: of Lagrange's weights of a place on a node all others are 0. */
static int are_between(const double *weight, unsigned count)
{
    return count < 2 || (weight[0] != 0.0 && weight[1] != 0.0);
}

/* One of a box, as bytes that are mixed as floats, or as it is mixed. */
static void load_row(const cm_level *level, const pixel_box *box, int is_scaled, unsigned row,
                     unsigned char *to)
{
    const cm_level_plane *from = &level->plane[box->plane];
    const int32_t line = box->top + (int32_t)row;
    if (is_scaled)
    {
        memcpy(to, from->pixels + line * from->row_stride + box->left * from->pixel_stride,
               box->columns * (size_t)from->pixel_stride);
        return;
    }
    cm_level_load(level, box->plane, box->left, line, (int32_t)box->columns, to);
}

/* Dense pixels of rows with room for sixteen values after them: where they are, or each in its part of buffer. */
static void find_rows(const cm_level *level, const pixel_box *box, int is_scaled,
                      const double *along, unsigned char (*buffer)[ROW_BYTES], weighed_rows *found)
{
    const cm_level_plane *from = &level->plane[box->plane];
    const ptrdiff_t size = is_scaled ? from->pixel_stride : (ptrdiff_t)level->pixel_size;
    const ptrdiff_t behind = (ptrdiff_t)(is_scaled ? SIXTEEN : SIXTEEN * sizeof(float));
    const int are_there = (is_scaled || level->is_plain) && are_dense(level, box, size, behind);
    const unsigned char *there =
        from->pixels + box->top * from->row_stride + box->left * from->pixel_stride;
    found->count = 0;
    for (unsigned j = 0; j < box->rows; j++, there += from->row_stride)
    {
        found->weight[found->count] = (float)along[j];
        found->row[found->count] = there;
        if (along[j] == 0.0)
        {
            continue;
        }
        if (!are_there)
        {
            found->row[found->count] = buffer[j];
            load_row(level, box, is_scaled, j, buffer[j]);
        }
        found->count++;
    }
}

/* The sum of a row's pixels. */
static inline void sum_pixels(const float *of_column, unsigned columns, size_t channels,
                              const double *across, float *sum)
{
    for (size_t c = 0; c < channels; c += FOUR)
    {
        float total[FOUR] = {0.0f};
        for (unsigned i = 0; i < columns; i++)
        {
            const float weight = (float)across[i];
            const float *value = of_column + i * channels + c;
            for (size_t k = 0; k < FOUR; k++)
            {
                total[k] += weight * value[k];
            }
        }
        memcpy(sum + c, total, sizeof total);
    }
}

/* The same, mostly of six that all weigh something. What weighs nothing may be NaN: a place on a node has that one alone. */
static void sum_columns(const float *of_column, unsigned columns, size_t channels,
                        const double *across, float *sum)
{
    static const double one = 1.0;
    unsigned node = 0;
    if (columns == POINTS && are_between(across, columns))
    {
        sum_pixels(of_column, POINTS, channels, across, sum);
        return;
    }
    if (are_between(across, columns))
    {
        sum_pixels(of_column, columns, channels, across, sum);
        return;
    }
    while (across[node] == 0.0)
    {
        node++;
    }
    sum_pixels(of_column + node * channels, 1, channels, &one, sum);
}

/* Sums of pixels by weights, along columns first. */
static void mix(const cm_level *level, const pixel_box *box, const double *across,
                const double *along, unsigned char *to)
{
    unsigned char buffer[POINTS][ROW_BYTES];
    float of_column[POINTS * (CM_CHANNELS_MAX + 1) + SIXTEEN];
    float sum[CM_CHANNELS_MAX + 1 + FOUR];
    const int is_scaled = are_bytes(level, box->plane);
    weighed_rows weighed;
    find_rows(level, box, is_scaled, along, buffer, &weighed);
    (level->is_bytes ? level->set->sum_u8
     : is_scaled     ? level->set->sum_scaled_u8
                     : level->set->sum_float)(weighed.count, weighed.weight, weighed.row,
                                          box->columns * level->channels, of_column);
    sum_columns(of_column, box->columns, level->channels, across, sum);
    cm_level_put(level, sum, to);
}

void cm_level_mix(const cm_level *level, unsigned plane, int32_t left, int32_t top, double x,
                  double y, unsigned points, unsigned char *to)
{
    double across[POINTS];
    double along[POINTS];
    weigh(x - 0.5 - left, points, across);
    weigh(y - 0.5 - top, points, along);
    const pixel_box box = {plane, left, top, points, points};
    mix(level, &box, across, along, to);
}

/* Is a place before the first or behind the last of points? Six would magnify what rounding left of bytes eight times. */
static int is_outside(const cm_level *level, double position, int32_t first, unsigned count)
{
    const double place = position - 0.5 - first;
    return level->values->type == CM_PIXEL_U8 && (place < 0.0 || place > count - 1.0);
}

void cm_level_between(const cm_level *level, int is_creased, unsigned plane, double x, double y,
                      unsigned char *to)
{
    unsigned columns = level->width < POINTS ? level->width : POINTS;
    unsigned rows = level->height < POINTS ? level->height : POINTS;
    double across[POINTS];
    double along[POINTS];
    int32_t left = points_around(x, level->width, columns, across);
    int32_t top = points_around(y, level->height, rows, along);
    while (is_creased && columns == rows && columns > 2 &&
           cm_level_is_across(level->width, left, top, columns))
    {
        columns = rows = columns > 3 ? columns - 2 : 2;
        left = points_around(x, level->width, columns, across);
        top = points_around(y, level->height, rows, along);
    }
    if (columns > 2 && is_outside(level, x, left, columns))
    {
        columns = 2;
        left = points_around(x, level->width, columns, across);
    }
    if (rows > 2 && is_outside(level, y, top, rows))
    {
        rows = 2;
        top = points_around(y, level->height, rows, along);
    }
    const pixel_box box = {plane, left, top, columns, rows};
    mix(level, &box, across, along, to);
}

const void *cm_level_six_at(const cm_level *level, unsigned plane, int32_t left, int32_t top)
{
    const pixel_box box = {plane, left, top, POINTS, POINTS};
    const cm_level_plane *from = &level->plane[plane];
    const ptrdiff_t number = level->values->type == CM_PIXEL_U8 ? 1 : (ptrdiff_t)sizeof(float);
    return are_dense(level, &box, (ptrdiff_t)level->channels * number, SIXTEEN * number)
               ? from->pixels + top * from->row_stride + left * from->pixel_stride
               : NULL;
}
