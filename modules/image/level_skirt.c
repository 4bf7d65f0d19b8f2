/* SPDX-License-Identifier: MIT
 *
 * What is beyond the edges of a level's planes: values between the pixels of neighbours, by six points each way where there
 * are so many.
 */
#include "fetch.h"
#include "large_memory.h"
#include "level_rim.h"

#include <cubemap/threads.h>

#include <string.h>

/* Points of a polynomial each way, which stay inside the neighbour: the nearest ones, not always around the place. */
#define POINTS CM_LEVEL_POINTS
#define BLOCK 64

/* Lagrange's weights of nodes 0, 1, ..., up to POINTS; exactly 0 and 1 at nodes. */
static inline void weigh_nodes(double place, unsigned count, double *weight)
{
    static const double inverse[POINTS] = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0};
    double before[POINTS + 1] = {1.0};
    double after = 1.0;
    for (unsigned i = 0; i < count; i++)
    {
        before[i + 1] = before[i] * (place - i);
    }
    for (unsigned i = count; i-- > 0;)
    {
        weight[i] = before[i] * after * inverse[i] * inverse[count - 1 - i];
        after *= i - place;
    }
}

/* Mostly there are six: then the compiler knows. */
static void weigh(double place, unsigned count, double *weight)
{
    if (count == POINTS)
    {
        weigh_nodes(place, POINTS, weight);
        return;
    }
    weigh_nodes(place, count, weight);
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

/* A value from inside a plane. A polynomial does not go across a crease, which are on diagonals, but by two points. */
static void interpolate(const cm_level *level, int is_creased, unsigned plane, double x, double y,
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

/* Pixels of a plane's skirt that are filled at once. */
typedef struct skirt_run
{
    const cm_level *level;
    const cm_surface *surface;
    const cm_filter_set *set;
    unsigned plane;
    unsigned count;
    int32_t column[BLOCK];
    int32_t row[BLOCK];
} skirt_run;

/* Neighbours' pixels go along a column as often as along a row, which processors do not foresee. Above and below they are
 * asked for by other pixels of the run. */
static void fetch_pixel(const cm_level *level, uint8_t plane, double x, double y)
{
    if (plane != CM_NO_FACE)
    {
        const cm_level_plane *from = &level->plane[plane];
        CM_FETCH(from->pixels + (int32_t)y * from->row_stride + (int32_t)x * from->pixel_stride);
    }
}

/* ---- many at once ---- */

/* Where six pixels each way begin, if all that loops read of them is there; else NULL. */
static const void *six_at(const cm_level *level, unsigned plane, int32_t left, int32_t top)
{
    const pixel_box box = {plane, left, top, POINTS, POINTS};
    const cm_level_plane *from = &level->plane[plane];
    const ptrdiff_t number = level->values->type == CM_PIXEL_U8 ? 1 : (ptrdiff_t)sizeof(float);
    return are_dense(level, &box, (ptrdiff_t)level->channels * number, SIXTEEN * number)
               ? from->pixels + top * from->row_stride + left * from->pixel_stride
               : NULL;
}

/* May places be done many at once, of bytes or floats as they are stored? */
static int are_many(const skirt_run *run)
{
    const cm_level *level = run->level;
    const int are_plain = level->values->type == CM_PIXEL_U8
                              ? level->is_plain || cm_values_are_stored(level->values)
                              : level->is_plain;
    return are_plain && !run->surface->creased && level->width >= POINTS &&
           level->height >= POINTS && level->channels <= CM_SIX_CHANNELS;
}

/* The values of places that lie on planes, one after the other, rows as far apart; those that have six pixels there. */
static void sum_many(const skirt_run *run, const uint8_t *found, const cm_six_points *across,
                     const cm_six_points *along, const void **from, float *sum)
{
    const cm_level *level = run->level;
    const ptrdiff_t row = level->plane[run->plane].row_stride;
    const int are_bytes = level->values->type == CM_PIXEL_U8;
    const void *some = NULL;
    for (unsigned i = 0; i < run->count; i++)
    {
        /* of floats what weighs nothing may be NaN */
        const int is_one = found[i] == CM_NO_FACE ||
                           level->plane[found[i]].row_stride != row ||
                           (!are_bytes && (across->exact[i] || along->exact[i]));
        from[i] = is_one ? NULL : six_at(level, found[i], across->first[i], along->first[i]);
        some = from[i] != NULL ? from[i] : some;
    }
    if (some == NULL)
    {
        return;
    }
    const void *all[BLOCK];
    for (unsigned i = 0; i < run->count; i++)
    {
        all[i] = from[i] != NULL ? from[i] : some;
    }
    if (are_bytes)
    {
        run->set->six_bytes(level->channels, run->count, all, row,
                            level->is_bytes ? 1.0f : 1.0f / 255.0f, across, along, sum);
        return;
    }
    run->set->six_floats(level->channels, run->count, all, row, 1.0f, across, along, sum);
}

/* The pixels of a run from their places. */
static void put_places(skirt_run *run, const uint8_t *found, const double *x, const double *y)
{
    const cm_level *level = run->level;
    const int many = are_many(run);
    const int is_cautious = level->values->type == CM_PIXEL_U8;
    const void *from[BLOCK] = {0};
    float sum[CM_SIX_CHANNELS * BLOCK];
    cm_six_points across, along;
    if (many)
    {
        run->set->six_points(run->count, x, level->width, is_cautious, &across);
        run->set->six_points(run->count, y, level->height, is_cautious, &along);
        sum_many(run, found, &across, &along, from, sum);
    }
    for (unsigned i = 0; i < run->count; i++)
    {
        unsigned char *to = cm_level_skirt_pixel(level, run->plane, run->column[i], run->row[i]);
        if (found[i] == CM_NO_FACE)
        {
            cm_level_continue_edge(level, run->plane, run->column[i], run->row[i], to);
        }
        else if (many && from[i] != NULL)
        {
            cm_level_put(level, sum + CM_SIX_CHANNELS * i, to);
        }
        else
        {
            interpolate(level, run->surface->creased, found[i], x[i], y[i], to);
        }
    }
}

/* The pixels of a run from their directions, which become places. */
static void put_run(skirt_run *run, double *x, double *y, double *z)
{
    uint8_t found[BLOCK];
    const unsigned count = run->count;
    cm_surface_find(run->surface, count, x, y, z, found, x, y);
    for (unsigned i = 0; i < count; i++)
    {
        x[i] = found[i] != CM_NO_FACE ? x[i] : 0.0;
        y[i] = found[i] != CM_NO_FACE ? y[i] : 0.0;
        fetch_pixel(run->level, found[i], x[i], y[i]);
    }
    put_places(run, found, x, y);
    run->count = 0;
}

static void fill_run(skirt_run *run)
{
    double columns[BLOCK] = {0}, rows[BLOCK] = {0}, x[BLOCK], y[BLOCK], z[BLOCK];
    const unsigned count = run->count;
    for (unsigned i = 0; run->level->gaps != NULL && i < count; i++)
    {
        cm_gaps_values(run->level, run->level->gaps, run->surface, run->plane, 1, &run->column[i],
                       run->row[i],
                       cm_level_skirt_pixel(run->level, run->plane, run->column[i], run->row[i]));
    }
    if (run->level->gaps != NULL)
    {
        run->count = 0;
        return;
    }
    for (unsigned i = 0; i < count; i++)
    {
        columns[i] = run->column[i] + 0.5;
        rows[i] = run->row[i] + 0.5;
    }
    cm_surface_directions_beyond(run->surface, run->plane, count, columns, rows, x, y, z);
    put_run(run, x, y, z);
}

static void add_pixel(skirt_run *run, int32_t column, int32_t row)
{
    run->column[run->count] = column;
    run->row[run->count++] = row;
    if (run->count == BLOCK)
    {
        fill_run(run);
    }
}

/* Both ends of a line of pixels across a plane, which share what directions come from. */
static void add_line(skirt_run *run, int is_column, int32_t at)
{
    const int32_t reach = run->level->reach;
    const int32_t extent = (int32_t)(is_column ? run->level->height : run->level->width);
    for (int32_t end = 0; end < 2; end++)
    {
        const int32_t first = end == 0 ? -reach : extent;
        for (int32_t i = first; i < first + reach; i++)
        {
            add_pixel(run, is_column ? at : i, is_column ? i : at);
        }
    }
}

/* Pixels beyond one edge, which go along it. 0 if they are no such that share their polynomials. */
static int fill_edge(skirt_run *run, cm_edge edge, int32_t begin, int32_t count)
{
    const cm_level *level = run->level;
    const int is_row = edge == CM_EDGE_UPPER || edge == CM_EDGE_LOWER;
    const int is_low = edge == CM_EDGE_LEFT || edge == CM_EDGE_UPPER;
    const int32_t last = (int32_t)(is_row ? level->height : level->width);
    double x[BLOCK], y[BLOCK], z[BLOCK];
    cm_edge_run nodes;
    if (!cm_surface_edge_nodes(run->surface, run->plane, edge, begin, (size_t)count, &nodes))
    {
        return 0;
    }
    for (int32_t k = 0; k < level->reach; k++)
    {
        const int32_t across = is_low ? -1 - k : last + k;
        for (int32_t i = 0; i < count; i++)
        {
            run->column[i] = is_row ? begin + i : across;
            run->row[i] = is_row ? across : begin + i;
        }
        run->count = (unsigned)count;
        cm_surface_edge_directions(&nodes, k, x, y, z);
        put_run(run, x, y, z);
    }
    return 1;
}

typedef struct skirt_job
{
    const cm_level *level;
    const cm_surface *surface;
    const cm_filter_set *set;
    const cm_memory *memory;
} skirt_job;

/* Elements of cm_run_threads for a block of lines. */
#define TASK 64

/* Blocks of a plane's rows, of its columns, and those beyond its columns, which have the corners. */
static size_t row_blocks(const cm_level *level)
{
    return (level->height + (size_t)BLOCK - 1) / BLOCK;
}

static size_t blocks_of(const cm_level *level)
{
    return row_blocks(level) + (level->width + (size_t)BLOCK - 1) / BLOCK + 2;
}

/* Both ends of lines that cross a plane. */
static void fill_block(skirt_run *run, int is_column, int32_t begin, int32_t count)
{
    const cm_level *level = run->level;
    const int32_t extent = (int32_t)(is_column ? level->width : level->height);
    const int is_inside = begin >= 0 && begin + count <= extent && level->gaps == NULL;
    if (is_inside && fill_edge(run, is_column ? CM_EDGE_UPPER : CM_EDGE_LEFT, begin, count) &&
        fill_edge(run, is_column ? CM_EDGE_LOWER : CM_EDGE_RIGHT, begin, count))
    {
        return;
    }
    for (int32_t i = begin; i < begin + count; i++)
    {
        add_line(run, is_column, i);
    }
    if (run->count > 0)
    {
        fill_run(run);
    }
}

/* Which lines a block has. */
static void fill_lines(skirt_run *run, size_t block)
{
    const cm_level *level = run->level;
    const size_t rows = row_blocks(level), corners = blocks_of(level) - 2;
    const int is_column = block >= rows;
    const int32_t extent = (int32_t)(is_column ? level->width : level->height);
    if (block >= corners)
    {
        fill_block(run, 1, block == corners ? -level->reach : extent, level->reach);
        return;
    }
    const int32_t begin = (int32_t)(is_column ? block - rows : block) * BLOCK;
    fill_block(run, is_column, begin, cm_level_least(extent - begin, BLOCK));
}

static void fill_blocks(size_t begin, size_t end, void *user)
{
    const skirt_job *job = user;
    const size_t per_plane = blocks_of(job->level);
    skirt_run run = {.level = job->level, .surface = job->surface, .set = job->set};
    for (size_t at = begin / TASK; at < end / TASK; at++)
    {
        run.plane = (unsigned)(at / per_plane);
        fill_lines(&run, at % per_plane);
        cm_large_touched(job->memory, 2 * BLOCK * CM_TOUCHED_AROUND);
    }
}

/* ---- what is beyond the edges of maps that go round ---- */

static int32_t at_turn(int32_t column, int32_t width)
{
    return (column % width + width) % width;
}

/* Pixels of a row from a column on, which come again, into the skirt. */
static void fill_from_row(const cm_level *level, int32_t column, int32_t row, int32_t count,
                          int32_t from_column, int32_t from_row)
{
    const int32_t width = (int32_t)level->width;
    while (count > 0)
    {
        const int32_t from = at_turn(from_column, width);
        const int32_t n = cm_level_least(count, width - from);
        cm_level_load(level, 0, from, from_row, n, cm_level_skirt_pixel(level, 0, column, row));
        column += n;
        from_column += n;
        count -= n;
    }
}

/* A skirt of pixels of the plane itself, if all are. */
static int fill_copies(const cm_level *level, const cm_surface *surface, const cm_memory *memory)
{
    const double pixel[2] = {1.0, 1.0};
    const int32_t reach = level->reach;
    const int32_t width = (int32_t)level->width;
    const int32_t height = (int32_t)level->height;
    int32_t further, same;
    if (surface->period != (double)level->width || level->gaps != NULL)
    {
        return 0;
    }
    for (int32_t k = 0; k < 2 * reach; k++)
    {
        const int32_t row = k < reach ? -1 - k : height + k - reach;
        if (!cm_surface_same_row(surface, pixel, row, &further, &same))
        {
            return 0;
        }
        fill_from_row(level, -reach, row, width + 2 * reach, further - reach, same);
    }
    for (int32_t row = 0; row < height; row++)
    {
        fill_from_row(level, -reach, row, reach, -reach, row);
        fill_from_row(level, width, row, reach, 0, row);
        cm_large_touched(memory, 2 * CM_TOUCHED_AROUND);
    }
    return 1;
}

void cm_level_fill_skirt(const cm_level *level, const cm_surface *surface, const cm_memory *memory,
                         unsigned threads)
{
    if (!fill_copies(level, surface, memory))
    {
        skirt_job job = {level, surface, cm_filter_set_find(level->set->name), memory};
        cm_run_threads(threads, level->planes * blocks_of(level) * TASK, 2 * TASK, fill_blocks,
                       &job);
    }
}
