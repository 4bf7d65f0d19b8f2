/* SPDX-License-Identifier: MIT
 *
 * What the sphere has beyond the edges of planes of floats. Directions beyond an edge are a polynomial through points
 * inside of it, as in surface_beyond.c, which rows of the border share; values are interpolated inside the neighbour.
 */
#include "padded.h"
#include "level_rim.h"

#include <cubemap/threads.h>

#include <math.h>
#include <string.h>

/* Pixels along an edge that are done together. */
#define BLOCK 64

/* Points of the polynomial of directions, and those of values each way. */
#define NODES 8
#define POINTS 6

/* A task is a block of one side of a plane, or one corner. */
typedef enum side
{
    ABOVE,
    BELOW,
    LEFT,
    RIGHT,
    CORNERS
} side;

/* A row of the border may have the pixels of one of the plane, so many columns further. */
typedef struct row_copy
{
    int is_there;
    int32_t further;
    int32_t same;
} row_copy;

typedef struct border_job
{
    const cm_padded *padded;
    const cm_surface *surface;
    size_t blocks[4];    /* of each side */
    size_t per_plane;    /* tasks */
    double scale[2];     /* the surface's pixels of one, of columns and rows */
    double node_step[2]; /* pixels from a node to the next */
    double weight[2][CM_BORDER_MOST][NODES];
    row_copy *copy; /* of the rows above and below: which others they are */
} border_job;

/* ---- values ---- */

static int32_t floor_of(double x)
{
    const int32_t towards_zero = (int32_t)x;
    return towards_zero - ((double)towards_zero > x);
}

static void weigh_few(double t, int32_t count, float *weight)
{
    for (int32_t i = 0; i < count; i++)
    {
        double product = 1.0;
        for (int32_t k = 0; k < count; k++)
        {
            product *= k == i ? 1.0 : (t - k) / ((double)i - k);
        }
        weight[i] = (float)product;
    }
}

/* The points one way around a position: the nearest ones that the plane has. */
typedef struct points
{
    int32_t first;
    int32_t count;
    float weight[POINTS];
} points;

/* At most so many. */
static points points_around(double position, uint32_t extent, int32_t count)
{
    points at;
    const int32_t limit = (int32_t)extent;
    const double centre = position - 0.5;
    at.count = limit < count ? limit : count;
    const int32_t first = floor_of(centre) - (at.count - 1) / 2;
    const int32_t most = limit - at.count;
    at.first = first < 0 ? 0 : first > most ? most : first;
    weigh_few(centre - at.first, at.count, at.weight);
    return at;
}

/* The same of many positions, by six points. */
typedef struct many_points
{
    int32_t first[BLOCK];
    int32_t exact[BLOCK]; /* is the position a pixel's centre? */
    float weight[POINTS][BLOCK];
} many_points;

static void find_points(const double *restrict position, size_t n, double scale, uint32_t extent,
                        many_points *restrict at)
{
    const int32_t most = (int32_t)extent - POINTS;
    float place[BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        const double centre = position[i] / scale - 0.5;
        const int32_t nearest = (int32_t)(centre + 1.0 + 0.5) - 1;
        const double off = centre - nearest;
        const int exact = off < 1e-9 && off > -1e-9;
        const int32_t whole = (int32_t)(centre + 1.0) - 1;
        const int32_t wanted = (exact ? nearest : whole) - 2;
        const int32_t first = wanted < 0 ? 0 : wanted > most ? most : wanted;
        at->first[i] = first;
        at->exact[i] = exact;
        place[i] = exact ? (float)(nearest - first) : (float)(centre - first);
    }
    for (size_t i = 0; i < n; i++)
    {
        /* Lagrange's weights of points 0 to 5 */
        const float t = place[i];
        const float a = t * (t - 1.0f), b = (t - 2.0f) * (t - 3.0f), c = (t - 4.0f) * (t - 5.0f);
        const float bc = b * c, ac = a * c, ab = a * b;
        at->weight[0][i] = (t - 1.0f) * bc * (-1.0f / 120.0f);
        at->weight[1][i] = t * bc * (1.0f / 24.0f);
        at->weight[2][i] = (t - 3.0f) * ac * (-1.0f / 12.0f);
        at->weight[3][i] = (t - 2.0f) * ac * (1.0f / 12.0f);
        at->weight[4][i] = (t - 5.0f) * ab * (-1.0f / 24.0f);
        at->weight[5][i] = (t - 4.0f) * ab * (1.0f / 120.0f);
    }
}

static void take_point(const many_points *many, size_t i, points *at)
{
    at->first = many->first[i];
    at->count = POINTS;
    for (int k = 0; k < POINTS; k++)
    {
        at->weight[k] = many->weight[k][i];
    }
}

/* Six pixels of six rows, rows first: so many floats of each. */
static inline void mix_six(const float *from, ptrdiff_t row, const points *y, size_t floats,
                           float *restrict mixed)
{
    for (size_t i = 0; i < floats; i++)
    {
        mixed[i] = y->weight[0] * from[i];
    }
    for (int j = 1; j < POINTS; j++)
    {
        const float *line = from + j * row;
        for (size_t i = 0; i < floats; i++)
        {
            mixed[i] += y->weight[j] * line[i];
        }
    }
}

/* Channels one beside the other: all at once. */
static inline void sum_pixels(const float *from, ptrdiff_t row, size_t channels, const points *x,
                              const points *y, float *to)
{
    float mixed[POINTS * (CM_CHANNELS_MAX + 1)];
    mix_six(from, row, y, POINTS * channels, mixed);
    for (size_t c = 0; c < channels; c++)
    {
        float sum = 0.0f;
        for (size_t i = 0; i < POINTS; i++)
        {
            sum += x->weight[i] * mixed[i * channels + c];
        }
        to[c] = sum;
    }
}

/* Eight are taken, as vectors have it: CM_WINDOW_SLACK is behind rows. */
static inline float sum_channel(const float *from, ptrdiff_t row, const points *x, const points *y)
{
    float mixed[8];
    mix_six(from, row, y, 8, mixed);
    float sum = 0.0f;
    for (size_t i = 0; i < POINTS; i++)
    {
        sum += x->weight[i] * mixed[i];
    }
    return sum;
}

static void sum_six(const cm_padded *padded, const float *from, const points *x, const points *y,
                    float *to)
{
    if (padded->channel == 1 && padded->channels == 3)
    {
        sum_pixels(from, padded->row, 3, x, y, to);
    }
    else if (padded->channel == 1)
    {
        sum_pixels(from, padded->row, padded->channels, x, y, to);
    }
    else
    {
        for (uint32_t c = 0; c < padded->channels; c++)
        {
            to[c * padded->channel] = sum_channel(from + c * padded->channel, padded->row, x, y);
        }
    }
}

static float sum_few(const float *from, ptrdiff_t pixel, ptrdiff_t row, const points *x,
                     const points *y)
{
    float sum = 0.0f;
    for (int32_t j = 0; j < y->count; j++, from += row)
    {
        float across = 0.0f;
        for (int32_t i = 0; i < x->count; i++)
        {
            across += x->weight[i] * from[i * pixel];
        }
        sum += y->weight[j] * across;
    }
    return sum;
}

/* Up to 6 x 6 whole numbers as floats, whose rows are 8 apart. */
static void take_whole(const int16_t *from, ptrdiff_t row, int32_t width, int32_t height,
                       float *tile)
{
    for (int32_t j = 0; j < height; j++)
    {
        for (int32_t i = 0; i < width; i++)
        {
            tile[j * 8 + i] = from[j * row + i];
        }
    }
}

static int16_t to_whole(float value)
{
    const float clamped = value > 32767.0f ? 32767.0f : value < -32767.0f ? -32767.0f : value;
    return (int16_t)(int32_t)(clamped + (clamped < 0.0f ? -0.5f : 0.5f));
}

/* A pixel of a padded's planes. */
typedef struct spot
{
    unsigned plane;
    ptrdiff_t at; /* numbers from the plane's first */
} spot;

static spot spot_of(const cm_padded *padded, unsigned plane, int32_t column, int32_t row)
{
    return (spot){plane, row * padded->row + column * padded->pixel};
}

static void interpolate_few(const cm_padded *padded, unsigned plane, double column, double row,
                            int32_t count, spot to)
{
    const points x = points_around(column, padded->width, count);
    const points y = points_around(row, padded->height, count);
    const spot from = spot_of(padded, plane, x.first, y.first);
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        if (padded->whole[plane] != NULL)
        {
            float tile[POINTS * 8];
            take_whole(padded->whole[plane] + from.at + channel, padded->row, x.count, y.count,
                       tile);
            padded->whole[to.plane][to.at + channel] = to_whole(sum_few(tile, 1, 8, &x, &y));
        }
        else
        {
            padded->first[to.plane][to.at + channel] = sum_few(
                padded->first[plane] + from.at + channel, padded->pixel, padded->row, &x, &y);
        }
    }
}

static void copy_pixel(const cm_padded *padded, spot from, spot to)
{
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        if (padded->whole[from.plane] != NULL)
        {
            padded->whole[to.plane][to.at + channel] = padded->whole[from.plane][from.at + channel];
        }
        else
        {
            padded->first[to.plane][to.at + channel] = padded->first[from.plane][from.at + channel];
        }
    }
}

/* Pixels from a column on, which are those of a row of the plane so many columns further, whose columns come again. */
static void copy_columns(const cm_padded *padded, unsigned plane, int32_t column, int32_t count,
                         int32_t row, int32_t further, int32_t same)
{
    const int32_t width = (int32_t)padded->width;
    const int is_by_pixel = padded->channel == 1;
    const uint32_t lines = is_by_pixel ? 1 : padded->channels;
    while (count > 0)
    {
        const int32_t at = ((column + further) % width + width) % width;
        const int32_t n = count < width - at ? count : width - at;
        const spot from = spot_of(padded, plane, at, same),
                   to = spot_of(padded, plane, column, row);
        const size_t numbers = (size_t)n * (size_t)padded->pixel;
        for (uint32_t c = 0; c < lines; c++)
        {
            const ptrdiff_t line = (ptrdiff_t)c * padded->channel;
            if (padded->is_whole)
            {
                memcpy(padded->whole[plane] + to.at + line, padded->whole[plane] + from.at + line,
                       numbers * sizeof(int16_t));
            }
            else
            {
                memcpy(padded->first[plane] + to.at + line, padded->first[plane] + from.at + line,
                       numbers * sizeof(float));
            }
        }
        column += n;
        count -= n;
    }
}

static void sum_six_whole(const cm_padded *padded, spot from, const points *x, const points *y,
                          spot to)
{
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        float tile[POINTS * 8] = {0.0f};
        take_whole(padded->whole[from.plane] + from.at + channel, padded->row, POINTS, POINTS,
                   tile);
        padded->whole[to.plane][to.at + channel] = to_whole(sum_channel(tile, 8, x, y));
    }
}

static void interpolate_six(const cm_padded *padded, unsigned plane, const many_points *columns,
                            const many_points *rows, size_t i, spot to)
{
    points x, y;
    take_point(columns, i, &x);
    take_point(rows, i, &y);
    spot from = spot_of(padded, plane, x.first, y.first);
    if (columns->exact[i] && rows->exact[i])
    {
        int32_t right = 0, down = 0;
        for (int k = 1; k < POINTS; k++)
        {
            right = x.weight[k] > 0.5f ? k : right;
            down = y.weight[k] > 0.5f ? k : down;
        }
        from.at += down * padded->row + right * padded->pixel;
        copy_pixel(padded, from, to);
    }
    else if (padded->whole[plane] != NULL)
    {
        sum_six_whole(padded, from, &x, &y, to);
    }
    else
    {
        sum_six(padded, padded->first[plane] + from.at, &x, &y, padded->first[to.plane] + to.at);
    }
}

/* Where nothing is, from the plane's last pixels. */
static void continue_plane(const cm_padded *padded, int32_t column, int32_t row, spot to)
{
    int32_t last[2], inwards[2];
    const cm_rim_nodes x =
        cm_rim_nodes_along(column, padded->width, padded->goes_on, &last[0], &inwards[0]);
    const cm_rim_nodes y =
        cm_rim_nodes_along(row, padded->height, padded->goes_on, &last[1], &inwards[1]);
    const spot from = spot_of(padded, to.plane, last[0], last[1]);
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        float sum = 0.0f;
        for (int32_t j = 0; j < y.count; j++)
        {
            const ptrdiff_t line = from.at + channel + inwards[1] * y.from_last[j] * padded->row;
            for (int32_t i = 0; i < x.count; i++)
            {
                const ptrdiff_t at = line + inwards[0] * x.from_last[i] * padded->pixel;
                sum += y.weight[j] * x.weight[i] *
                       (padded->is_whole ? (float)padded->whole[to.plane][at]
                                         : padded->first[to.plane][at]);
            }
        }
        if (padded->is_whole)
        {
            padded->whole[to.plane][to.at + channel] = to_whole(sum);
        }
        else
        {
            padded->first[to.plane][to.at + channel] = sum;
        }
    }
}

/* As many points as do not lie on both sides of a diagonal, where creases are; two if there are none. */
static int32_t points_beside_crease(const cm_padded *padded, const many_points *columns,
                                    const many_points *rows, size_t i)
{
    /* four are the inner ones of six, and are two if these are across */
    return cm_level_is_across(padded->width, columns->first[i] + 1, rows->first[i] + 1, 4) ? 2 : 4;
}

/* Pixels of the border from their directions: (column, row) is the first, and each is one step on. */
static void put_run(const border_job *job, unsigned plane, int32_t column, int32_t row,
                    int32_t right, int32_t down, size_t n, double *x, double *y, double *z)
{
    const cm_padded *padded = job->padded;
    const int are_many = padded->width >= POINTS && padded->height >= POINTS;
    uint8_t found[BLOCK];
    many_points columns, rows;
    cm_surface_find(job->surface, n, x, y, z, found, x, y);
    if (are_many)
    {
        for (size_t i = 0; i < n; i++)
        {
            x[i] = found[i] != CM_NO_FACE ? x[i] : 0.0;
            y[i] = found[i] != CM_NO_FACE ? y[i] : 0.0;
        }
        find_points(x, n, job->scale[0], padded->width, &columns);
        find_points(y, n, job->scale[1], padded->height, &rows);
    }
    for (size_t i = 0; i < n; i++, column += right, row += down)
    {
        const spot to = spot_of(padded, plane, column, row);
        if (found[i] == CM_NO_FACE)
        {
            continue_plane(padded, column, row, to);
        }
        else if (are_many &&
                 !(job->surface->creased &&
                   cm_level_is_across(padded->width, columns.first[i], rows.first[i], POINTS)))
        {
            interpolate_six(padded, found[i], &columns, &rows, i, to);
        }
        else
        {
            interpolate_few(padded, found[i], x[i] / job->scale[0], y[i] / job->scale[1],
                            are_many ? points_beside_crease(padded, &columns, &rows, i) : POINTS,
                            to);
        }
    }
}

/* ---- directions ---- */

/* A run of a row whose pixels are those of another. */
static int copy_run(const border_job *job, unsigned plane, int32_t column, int32_t row,
                    int32_t right, size_t n)
{
    const cm_padded *padded = job->padded;
    const row_copy *copy =
        &job->copy[row < 0 ? row + padded->beyond : row - (int32_t)padded->height + padded->beyond];
    if (!copy->is_there)
    {
        return 0;
    }
    const int32_t first = right < 0 ? column - (int32_t)(n - 1) : column;
    copy_columns(padded, plane, first, (int32_t)n, row, copy->further, copy->same);
    return 1;
}

/* A run whose directions the surface itself can tell, or surface_beyond.c one by one. */
static void ask_run(const border_job *job, unsigned plane, int32_t column, int32_t row,
                    int32_t right, int32_t down, size_t n)
{
    double columns[BLOCK], rows[BLOCK], x[BLOCK], y[BLOCK], z[BLOCK];
    if (down == 0 && copy_run(job, plane, column, row, right, n))
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        columns[i] = (column + (int32_t)i * right + 0.5) * job->scale[0];
        rows[i] = (row + (int32_t)i * down + 0.5) * job->scale[1];
    }
    cm_surface_directions_spaced(job->surface, plane, job->scale, n, columns, rows, x, y, z);
    put_run(job, plane, column, row, right, down, n, x, y, z);
}

/* The sum of nodes, which lie `stride` apart. */
static double weighted(const double *weight, const double *value, size_t stride)
{
    double sum = 0.0;
    for (size_t i = 0; i < NODES; i++)
    {
        sum += weight[i] * value[i * stride];
    }
    return sum;
}

/* Where node k of a side's polynomials lies: from the edge inwards. */
static double node_place(const border_job *job, int is_low, int way, int k)
{
    const double extent = way == 0 ? job->padded->width : job->padded->height;
    const double inwards = k * job->node_step[way];
    return is_low ? inwards : extent - inwards;
}

/* Directions of NODES rows of n nodes each: those of `along` are every pixel's centres from `begin` on. */
static void side_nodes(const border_job *job, unsigned plane, side where, int32_t begin, size_t n,
                       double direction[3][NODES * BLOCK])
{
    double columns[NODES * BLOCK], rows[NODES * BLOCK];
    const int is_row = where == ABOVE || where == BELOW;
    for (size_t i = 0; i < NODES * n; i++)
    {
        const double along = begin + (double)(i % n) + 0.5;
        const double across =
            node_place(job, where == ABOVE || where == LEFT, is_row, (int)(i / n));
        columns[i] = (is_row ? along : across) * job->scale[0];
        rows[i] = (is_row ? across : along) * job->scale[1];
    }
    cm_surface_own_directions(job->surface, plane, NODES * n, columns, rows, direction[0],
                              direction[1], direction[2]);
}

/* A block of a side, by polynomials that its pixels of one column, or row, share. */
static void extrapolate_block(const border_job *job, unsigned plane, side where, int32_t begin,
                              size_t n)
{
    const cm_padded *padded = job->padded;
    const int is_row = where == ABOVE || where == BELOW;
    const int32_t depth = is_row ? padded->beyond : padded->beside;
    double node[3][NODES * BLOCK];
    side_nodes(job, plane, where, begin, n, node);
    for (int32_t k = 0; k < depth; k++)
    {
        double x[3][BLOCK];
        const double *weight = job->weight[is_row][k];
        for (size_t i = 0; i < n; i++)
        {
            for (int axis = 0; axis < 3; axis++)
            {
                x[axis][i] = weighted(weight, node[axis] + i, n);
            }
        }
        const int32_t across = where == ABOVE || where == LEFT ? -1 - k
                               : is_row                        ? (int32_t)padded->height + k
                                                               : (int32_t)padded->width + k;
        put_run(job, plane, is_row ? begin : across, is_row ? across : begin, is_row, !is_row, n,
                x[0], x[1], x[2]);
    }
}

/* A corner, by polynomials both ways. */
static void extrapolate_corner(const border_job *job, unsigned plane, int is_left, int is_upper)
{
    const cm_padded *padded = job->padded;
    double columns[NODES * NODES], rows[NODES * NODES], node[3][NODES * NODES];
    for (int i = 0; i < NODES * NODES; i++)
    {
        columns[i] = node_place(job, is_left, 0, i % NODES) * job->scale[0];
        rows[i] = node_place(job, is_upper, 1, i / NODES) * job->scale[1];
    }
    cm_surface_own_directions(job->surface, plane, (size_t)NODES * NODES, columns, rows, node[0],
                              node[1], node[2]);
    for (int32_t k = 0; k < padded->beyond; k++)
    {
        double line[3][NODES];
        for (int i = 0; i < 3 * NODES; i++)
        {
            line[i / NODES][i % NODES] =
                weighted(job->weight[1][k], node[i / NODES] + i % NODES, NODES);
        }
        const int32_t row = is_upper ? -1 - k : (int32_t)padded->height + k;
        for (int32_t begin = 0; begin < padded->beside; begin += BLOCK)
        {
            double x[3][BLOCK];
            const int32_t left = padded->beside - begin;
            const size_t n = (size_t)(left < BLOCK ? left : BLOCK);
            for (size_t i = 0; i < n; i++)
            {
                const double *weight = job->weight[0][begin + (int32_t)i];
                for (int axis = 0; axis < 3; axis++)
                {
                    x[axis][i] = weighted(weight, line[axis], 1);
                }
            }
            put_run(job, plane, is_left ? -1 - begin : (int32_t)padded->width + begin, row,
                    is_left ? -1 : 1, 0, n, x[0], x[1], x[2]);
        }
    }
}

/* ---- tasks ---- */

/* Columns that come again after a period are copies. */
static void repeat_columns(const cm_padded *padded, unsigned plane, int32_t row, int is_left)
{
    copy_columns(padded, plane, is_left ? -padded->beside : (int32_t)padded->width, padded->beside,
                 row, 0, row);
}

/* Can the block's polynomials do without crossing a crease, which are on diagonals? */
static int is_smooth(const border_job *job, int way, int32_t begin, size_t n)
{
    const cm_padded *padded = job->padded;
    const int32_t extent = (int32_t)(way == 1 ? padded->width : padded->height);
    const double room = fmin(begin + 0.5, extent - (begin + (double)n) + 0.5);
    return !job->surface->creased || room >= (NODES - 1) * job->node_step[way];
}

static void do_side(const border_job *job, unsigned plane, side where, size_t block)
{
    const cm_padded *padded = job->padded;
    const int is_row = where == ABOVE || where == BELOW;
    const int32_t extent = (int32_t)(is_row ? padded->width : padded->height);
    const int32_t begin = (int32_t)block * BLOCK;
    const size_t n = (size_t)(extent - begin < BLOCK ? extent - begin : BLOCK);
    const int way = is_row ? 1 : 0;
    const int32_t depth = is_row ? padded->beyond : padded->beside;
    if (!is_row && job->surface->period == (double)job->surface->width)
    {
        for (size_t i = 0; i < n; i++)
        {
            repeat_columns(padded, plane, begin + (int32_t)i, where == LEFT);
        }
    }
    else if (!job->surface->methods->can_go_beyond && job->node_step[way] > 0.0 &&
             is_smooth(job, way, begin, n))
    {
        extrapolate_block(job, plane, where, begin, n);
    }
    else
    {
        for (int32_t k = 0; k < depth; k++)
        {
            const int32_t across = where == ABOVE || where == LEFT ? -1 - k
                                   : is_row                        ? (int32_t)padded->height + k
                                                                   : (int32_t)padded->width + k;
            ask_run(job, plane, is_row ? begin : across, is_row ? across : begin, is_row, !is_row,
                    n);
        }
    }
}

static void do_corner(const border_job *job, unsigned plane, int is_left, int is_upper)
{
    const cm_padded *padded = job->padded;
    if (!job->surface->methods->can_go_beyond && !job->surface->creased &&
        job->node_step[0] > 0.0 && job->node_step[1] > 0.0)
    {
        extrapolate_corner(job, plane, is_left, is_upper);
        return;
    }
    for (int32_t k = 0; k < padded->beyond; k++)
    {
        const int32_t row = is_upper ? -1 - k : (int32_t)padded->height + k;
        for (int32_t begin = 0; begin < padded->beside; begin += BLOCK)
        {
            const int32_t left = padded->beside - begin;
            ask_run(job, plane, is_left ? -1 - begin : (int32_t)padded->width + begin, row,
                    is_left ? -1 : 1, 0, (size_t)(left < BLOCK ? left : BLOCK));
        }
    }
}

static void do_tasks(size_t begin, size_t end, void *user)
{
    const border_job *job = user;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const unsigned plane = (unsigned)(at / job->per_plane);
        size_t task = at % job->per_plane;
        int where = ABOVE;
        while (where < CORNERS && task >= job->blocks[where])
        {
            task -= job->blocks[where++];
        }
        if (where < CORNERS)
        {
            do_side(job, plane, (side)where, task);
        }
        else
        {
            do_corner(job, plane, task % 2 == 0, task < 2);
        }
    }
}

/* Nodes are spread over some of the plane where the border is wide, so that what rounding leaves of them is not
 * magnified more than it must. */
static void prepare_nodes(border_job *job, int way, int32_t depth, uint32_t extent)
{
    const double most = floor(((double)extent - 1.0) / (NODES - 1));
    const double wanted = fmax(floor(depth / 8.0), 1.0);
    const double step = fmin(wanted, most);
    job->node_step[way] = step;
    for (int32_t k = 0; k < depth && step > 0.0; k++)
    {
        for (int i = 0; i < NODES; i++)
        {
            double product = 1.0;
            for (int other = 0; other < NODES; other++)
            {
                product *= other == i ? 1.0 : (-(k + 0.5) / step - other) / ((double)i - other);
            }
            job->weight[way][k][i] = product;
        }
    }
}

void cm_padded_border(const cm_padded *padded, const cm_surface *surface, unsigned threads)
{
    border_job job = {.padded = padded, .surface = surface};
    job.scale[0] = (double)surface->width / padded->width;
    job.scale[1] = (double)surface->height / padded->height;
    job.blocks[ABOVE] = job.blocks[BELOW] =
        padded->beyond > 0 ? (padded->width + (size_t)BLOCK - 1) / BLOCK : 0;
    job.blocks[LEFT] = job.blocks[RIGHT] =
        padded->beside > 0 ? (padded->height + (size_t)BLOCK - 1) / BLOCK : 0;
    job.per_plane = 2 * (job.blocks[ABOVE] + job.blocks[LEFT]) + 4;
    if (!surface->methods->can_go_beyond)
    {
        prepare_nodes(&job, 0, padded->beside, padded->width);
        prepare_nodes(&job, 1, padded->beyond, padded->height);
    }
    row_copy copy[2 * CM_BORDER_MOST];
    job.copy = copy;
    for (int32_t k = 0; k < 2 * padded->beyond; k++)
    {
        const int32_t row =
            k < padded->beyond ? k - padded->beyond : (int32_t)padded->height + k - padded->beyond;
        copy[k].is_there =
            cm_surface_same_row(surface, job.scale, row, &copy[k].further, &copy[k].same);
    }
    cm_run_threads(threads, padded->planes * job.per_plane * CM_TASK, 2 * CM_TASK, do_tasks, &job);
}
