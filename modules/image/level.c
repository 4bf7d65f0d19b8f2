/* SPDX-License-Identifier: MIT */
#include "level_rim.h"
#include "fetch.h"
#include "large_memory.h"

#include <cubemap/threads.h>

#include <stdlib.h>
#include <string.h>

/* ---- windows ---- */

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* Bytes of a plane's skirt: rows above and below as wide as the plane with both ends, columns as high as it. */
static size_t skirt_size(const cm_level *level)
{
    const size_t reach = (size_t)level->reach;
    return level->pixel_size * 2 * reach * (level->width + 2 * reach + level->height);
}

/* The pixel of a plane's skirt; (column, row) is beyond an edge. */
static unsigned char *skirt_pixel(const cm_level *level, unsigned plane, int32_t column,
                                  int32_t row)
{
    const size_t reach = (size_t)level->reach;
    const size_t wide = level->width + 2 * reach;
    const size_t right = (size_t)(column + level->reach);
    size_t index;
    if (row < 0)
    {
        index = (size_t)(row + level->reach) * wide + right;
    }
    else if (row >= (int32_t)level->height)
    {
        index = (reach + (size_t)row - level->height) * wide + right;
    }
    else
    {
        const size_t before = 2 * reach * wide + (column < 0 ? 0 : reach * level->height);
        index = before + (size_t)row * reach + (column < 0 ? right : (size_t)column - level->width);
    }
    return level->plane[plane].skirt + index * level->pixel_size;
}

void cm_level_load(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t count, unsigned char *to)
{
    const cm_level_plane *from = &level->plane[plane];
    const unsigned char *pixel =
        from->pixels + row * from->row_stride + column * from->pixel_stride;
    if (!level->is_plain)
    {
        cm_values_load(level->values, pixel, from->pixel_stride, (size_t)count,
                       (float *)(void *)to);
    }
    else if (from->pixel_stride == (ptrdiff_t)level->pixel_size)
    {
        memcpy(to, pixel, (size_t)count * level->pixel_size);
    }
    else
    {
        for (int32_t i = 0; i < count; i++)
        {
            memcpy(to + (size_t)i * level->pixel_size, pixel + i * from->pixel_stride,
                   level->pixel_size);
        }
    }
}

void cm_level_row(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t width,
                  unsigned char *to)
{
    const int32_t right = (int32_t)level->width;
    if (row < 0 || row >= (int32_t)level->height)
    {
        memcpy(to, skirt_pixel(level, plane, column, row), (size_t)width * level->pixel_size);
        return;
    }
    const int32_t end = column + width;
    int32_t at = column;
    while (at < end)
    {
        const int inside = at >= 0 && at < right;
        const int32_t count = (at < 0 ? least(end, 0) : inside ? least(end, right) : end) - at;
        unsigned char *here = to + (size_t)(at - column) * level->pixel_size;
        if (inside)
        {
            cm_level_load(level, plane, at, row, count, here);
            if (level->gaps != NULL)
            {
                cm_gaps_put(level, plane, at, row, count, here);
            }
        }
        else
        {
            memcpy(here, skirt_pixel(level, plane, at, row), (size_t)count * level->pixel_size);
        }
        at += count;
    }
}

int cm_level_there(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t width, int32_t height)
{
    const cm_level_plane *from = &level->plane[plane];
    const int32_t reach = from->skirt == NULL ? level->reach : 0;
    if (!level->is_plain || from->pixel_stride != (ptrdiff_t)level->pixel_size || column < -reach ||
        row < -reach || column + width > (int32_t)level->width + reach ||
        row + height > (int32_t)level->height + reach)
    {
        return 0;
    }
    if (level->gaps != NULL && cm_gaps_touch(level, plane, column, row, width, height))
    {
        return 0;
    }
    const int32_t lowest = from->row_stride < 0 ? row : row + height - 1;
    const unsigned char *last =
        from->pixels + lowest * from->row_stride + (column + width) * from->pixel_stride;
    return from->end - last >= CM_WINDOW_SLACK;
}

void cm_level_own(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                  cm_window *window)
{
    const cm_level_plane *from = &level->plane[plane];
    window->data = from->pixels + row * from->row_stride + column * from->pixel_stride;
    window->row_stride = from->row_stride;
    window->channels = level->channels;
}

cm_status cm_scratch_room(cm_scratch *scratch, size_t size)
{
    if (size > scratch->size)
    {
        unsigned char *bytes = malloc(size);
        if (bytes == NULL)
        {
            return CM_ERROR_MEMORY;
        }
        free(scratch->bytes);
        scratch->bytes = bytes;
        scratch->size = size;
        memset(bytes, 0, size);
    }
    return CM_OK;
}

cm_status cm_level_window(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                          int32_t width, int32_t height, cm_scratch *scratch, cm_window *window)
{
    window->channels = level->channels;
    if (cm_level_there(level, plane, column, row, width, height))
    {
        cm_level_own(level, plane, column, row, window);
        return CM_OK;
    }
    const size_t stride = ((size_t)width * level->pixel_size + CM_WINDOW_SLACK + 63) / 64 * 64;
    const cm_status status = cm_scratch_room(scratch, stride * (size_t)height);
    for (int32_t i = 0; status == CM_OK && i < height; i++)
    {
        cm_level_row(level, plane, column, row + i, width, scratch->bytes + (size_t)i * stride);
    }
    window->data = scratch->bytes;
    window->row_stride = (ptrdiff_t)stride;
    return status;
}

/* ---- what is beyond the edges ---- */

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

static void fill_run(skirt_run *run)
{
    double columns[BLOCK] = {0}, rows[BLOCK] = {0}, x[BLOCK], y[BLOCK], z[BLOCK];
    uint8_t found[BLOCK];
    const unsigned count = run->count;
    for (unsigned i = 0; run->level->gaps != NULL && i < count; i++)
    {
        cm_gaps_values(run->level, run->level->gaps, run->surface, run->plane, 1, &run->column[i],
                       run->row[i],
                       skirt_pixel(run->level, run->plane, run->column[i], run->row[i]));
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
    cm_surface_find(run->surface, count, x, y, z, found, x, y);
    for (unsigned i = 0; i < count; i++)
    {
        fetch_pixel(run->level, found[i], x[i], y[i]);
    }
    for (unsigned i = 0; i < count; i++)
    {
        unsigned char *to = skirt_pixel(run->level, run->plane, run->column[i], run->row[i]);
        if (found[i] == CM_NO_FACE)
        {
            cm_level_continue_edge(run->level, run->plane, run->column[i], run->row[i], to);
        }
        else
        {
            interpolate(run->level, run->surface->creased, found[i], x[i], y[i], to);
        }
    }
    run->count = 0;
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

typedef struct skirt_job
{
    const cm_level *level;
    const cm_surface *surface;
    const cm_memory *memory;
} skirt_job;

static size_t lines_of(const cm_level *level)
{
    return level->height + level->width + 2 * (size_t)level->reach;
}

/* Lines of skirts, plane by plane: those of the plane's rows, then those of columns, which have the corners, too. */
static void fill_lines(size_t begin, size_t end, void *user)
{
    const skirt_job *job = user;
    const cm_level *level = job->level;
    const size_t per_plane = lines_of(level);
    skirt_run run = {.level = level, .surface = job->surface};
    for (size_t at = begin; at < end; at++)
    {
        const unsigned plane = (unsigned)(at / per_plane);
        const size_t line = at % per_plane;
        if (plane != run.plane && run.count > 0)
        {
            fill_run(&run);
        }
        run.plane = plane;
        const int is_column = line >= level->height;
        add_line(&run, is_column,
                 is_column ? (int32_t)(line - level->height) - level->reach : (int32_t)line);
        cm_large_touched(job->memory, 2 * CM_TOUCHED_AROUND);
    }
    if (run.count > 0)
    {
        fill_run(&run);
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
        const int32_t n = least(count, width - from);
        cm_level_load(level, 0, from, from_row, n, skirt_pixel(level, 0, column, row));
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

/* ---- life ---- */

static void lay_plane(cm_level *level, const cm_surface *surface, const cm_image *pictures,
                      unsigned plane)
{
    const cm_placement *place = &surface->placement[plane];
    const cm_image *picture = &pictures[place->picture];
    const ptrdiff_t pixel = picture->pixel_stride != 0
                                ? picture->pixel_stride
                                : (ptrdiff_t)(picture->channels * cm_pixel_size(picture->type));
    const ptrdiff_t row = picture->row_stride != 0 ? picture->row_stride : pixel * picture->width;
    uint32_t column, first_row;
    cm_level_plane *to = &level->plane[plane];
    cm_placement_pixel(surface, plane, 0, 0, &column, &first_row);
    to->pixels = (const unsigned char *)picture->data + first_row * row + column * pixel;
    const int exchanged = (place->turn & CM_TURN_EXCHANGED) != 0;
    const ptrdiff_t right = place->turn & CM_TURN_COLUMNS ? -pixel : pixel;
    const ptrdiff_t down = place->turn & CM_TURN_ROWS ? -row : row;
    to->pixel_stride = exchanged ? down : right;
    to->row_stride = exchanged ? right : down;
    const ptrdiff_t lowest = row < 0 ? 0 : row * (ptrdiff_t)(picture->height - 1);
    to->end = (const unsigned char *)picture->data + lowest + pixel * picture->width;
}

cm_status cm_level_of_pictures(const cm_surface *surface, const cm_image *pictures,
                               const cm_values *values, const cm_sample_set *set, int is_bytes,
                               int32_t reach, const cm_memory *memory, unsigned threads,
                               cm_level *level)
{
    memset(level, 0, sizeof *level);
    level->values = values;
    level->set = set;
    level->planes = surface->planes;
    level->width = surface->width;
    level->height = surface->height;
    level->channels = values->working;
    level->is_bytes = is_bytes;
    level->pixel_size = values->working * (is_bytes ? 1 : sizeof(float));
    level->is_stored = 1;
    level->is_plain = is_bytes || cm_values_are_plain(values);
    level->reach = reach;
    for (unsigned plane = 0; plane < level->planes; plane++)
    {
        lay_plane(level, surface, pictures, plane);
        level->plane[plane].skirt = malloc(skirt_size(level) + CM_WINDOW_SLACK);
        if (level->plane[plane].skirt == NULL)
        {
            cm_level_free(level);
            return CM_ERROR_MEMORY;
        }
    }
    const cm_status status =
        surface->has_gaps ? cm_gaps_create(level, surface, threads, &level->gaps) : CM_OK;
    if (status != CM_OK)
    {
        cm_level_free(level);
        return status;
    }
    skirt_job job = {level, surface, memory};
    if (reach > 0 && !fill_copies(level, surface, memory))
    {
        cm_run_threads(threads, level->planes * lines_of(level), 256, fill_lines, &job);
    }
    return CM_OK;
}

void cm_level_free(cm_level *level)
{
    cm_gaps_free(level->gaps);
    level->gaps = NULL;
    for (unsigned plane = 0; plane < level->planes; plane++)
    {
        free(level->plane[plane].skirt);
        level->plane[plane].skirt = NULL;
    }
}
