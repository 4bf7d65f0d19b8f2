/* SPDX-License-Identifier: MIT */
#include "ewa_pole.h"
#include "pole.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Rows from a pole, of the level, within which pixels are beside it, and no more than half a radian where there are so
 * few. */
#define CAP_ROWS 8.0
#define CAP_LEAST 2.0

/* The largest pixel on a level that is not the last, in its pixels: three eighths are the largest step. */
#define PIXEL_MOST (8.0 / 3.0 * CM_EWA_MINOR)

/* Columns that are done at once. */
#define COLUMNS 256

/* The radius of a footprint, in rows, from which on rings of a row each are near enough for what is around a pole. */
#define FINE_MOST 8.0

/* What goes around a pole is laid on a level so much finer: along parallels columns keep detail there that rows of the
 * level have lost, and what is left of it would not vanish. */
#define FINER 2
#define FINER_PIXELS 29.0f /* for one, at most: 8/3 and then 2 each way */
#define FINER_REACH 1.6f   /* and what is so many radii away */

/* Rows of a footprint whose rings are half a row apart, at most. */
#define LINES 64

/* What rows below and above a ring between rows has of them. */
#define TAPS 6
#define TAPS_ABOVE 2

/* Rings are j + 1/2 wide, but for the first two: with these the sum is exact for 1 and r^2 (-B_2(1/2) / 2 = 1/24 and
 * -B_4(1/2) / 4 = -7/960 are what it has too much). */
static const double ring_weight[2] = {0.5 - 1.0 / 24.0 - 17.0 / 1920.0, 1.5 + 17.0 / 1920.0};

/* ---- places ---- */

/* Pixels of a group, on the plane around their pole: in rows of the source. */
typedef struct pole_group
{
    unsigned count;
    uint8_t which[CM_EWA_MOST]; /* of the group */
    uint8_t is_lower[CM_EWA_MOST];
    float sharp[CM_EWA_MOST]; /* by columns and rows */
    float x[CM_EWA_MOST];
    float y[CM_EWA_MOST];
    float by_column[2][CM_EWA_MOST];
    float by_row[2][CM_EWA_MOST];
    cm_ewa_axes axes;
} pole_group;

void cm_ewa_caps(const cm_surface *surface, cm_ewa *ewa)
{
    ewa->surface = surface;
    for (unsigned k = 0; k < ewa->pyramid.count; k++)
    {
        const double rows = fmax(CAP_LEAST, fmin(CAP_ROWS, ewa->width[k] / (4.0 * PI)));
        /* a radius of this many columns is all that there is beyond an edge */
        const double wide = PIXEL_MOST * (double)ewa->kernel.radius * ewa->width[k] /
                            (2.0 * PI * CM_PYRAMID_BESIDE);
        ewa->cap[k] = (float)(rows * ewa->height[0] / ewa->height[k]);
        ewa->wide[k] = (float)(fmax(rows, wide) * ewa->height[0] / ewa->height[k]);
    }
}

/* Its place and derivatives on the plane around the pole. */
static void add_pixel(const cm_ewa *ewa, const cm_group *group, unsigned i, int is_lower,
                      pole_group *poles)
{
    const double column = group->column + 0.5 + (double)group->x[i];
    const double row = group->row + 0.5 + (double)group->y[i];
    const cm_pole_place at = cm_pole_place_of(ewa->surface, is_lower, column, row);
    const double by_column[2] = {(double)group->by_column[0][i], (double)group->by_column[1][i]};
    const double by_row[2] = {(double)group->by_row[0][i], (double)group->by_row[1][i]};
    const unsigned n = poles->count++;
    double slope[2];
    poles->which[n] = (uint8_t)i;
    poles->is_lower[n] = (uint8_t)is_lower;
    poles->x[n] = (float)at.x;
    poles->y[n] = (float)at.y;
    cm_pole_slope(&at, by_column, slope);
    poles->by_column[0][n] = (float)slope[0];
    poles->by_column[1][n] = (float)slope[1];
    cm_pole_slope(&at, by_row, slope);
    poles->by_row[0][n] = (float)slope[0];
    poles->by_row[1][n] = (float)slope[1];
}

/* Could a pixel of the group be beside a pole? */
static int may_be_beside(const cm_ewa *ewa, const cm_group *group, int32_t coarsest)
{
    const float far = ewa->wide[coarsest];
    float low = group->low[1], high = group->high[1];
    if (!group->is_bounded)
    {
        low = high = group->y[0];
        for (unsigned i = 1; i < group->count; i++)
        {
            low = group->y[i] < low ? group->y[i] : low;
            high = group->y[i] > high ? group->y[i] : high;
        }
    }
    return (float)group->row + low < far ||
           (float)((int32_t)ewa->height[0] - group->row) - 0.5f - high < far;
}

/* Is the ellipse of a pixel too wide for its level, of more pixels than are allowed, or beyond the border beside it? */
static int is_wide(const cm_ewa *ewa, const cm_group *group, const cm_ewa_axes *axes, unsigned i)
{
    const int32_t level = axes->level[i];
    const float across = (float)ewa->width[level] / (float)ewa->width[0];
    const float down = (float)ewa->height[level] / (float)ewa->height[0];
    const float radius = ewa->kernel.radius;
    const float area = (float)PI * radius * radius * across * down *
                       sqrtf(axes->major[i] * fmaxf(axes->minor[i], 1.0f / (across * down)));
    const float reach = radius * sqrtf(axes->xx[i]) * across;
    const float column = ((float)group->column + 0.5f + group->x[i]) * across;
    const float beside =
        (float)((level > 0 ? ewa->pyramid.level[level].beside : CM_PYRAMID_BESIDE) - CM_EWA_SHARP -
                1);
    return area > ewa->pixels_most || column - reach < -beside ||
           column + reach > (float)ewa->width[level] + beside;
}

/* What is beside a pole, or goes around it. */
static void find_pixels(const cm_ewa *ewa, const cm_group *group, const cm_ewa_axes *axes,
                        pole_group *poles)
{
    const float half = 0.5f * (float)ewa->width[0];
    poles->count = 0;
    for (unsigned i = 0; i < group->count; i++)
    {
        const double row = group->row + 0.5 + (double)group->y[i];
        const int is_lower = cm_pole_is_lower(ewa->surface, row);
        const float distance = (float)(is_lower ? ewa->height[0] - row : row);
        const int32_t level = axes->level[i];
        if (distance <= ewa->cap[level] || axes->xx[i] > half * half ||
            (distance <= ewa->wide[level] && is_wide(ewa, group, axes, i)))
        {
            /* 0: columns have no derivative there */
            poles->sharp[poles->count] =
                axes->major[i] > 0.0f ? cm_ewa_sharpness(axes->major[i]) : 0.0f;
            add_pixel(ewa, group, i, is_lower, poles);
        }
    }
}

/* ---- footprints ---- */

/* One of them on a level, from the pole, in rows. */
typedef struct pole_footprint
{
    const cm_ewa *ewa;
    unsigned level;
    unsigned plane;
    int is_lower;
    float a; /* of the ellipse, as cm_ewa_shapes has it */
    float b;
    float c;
    float x;
    float y;
    int32_t column; /* the first one; of those from 0 to the level's width every step-th is taken */
    int32_t columns;
    int32_t step;
    int32_t fine; /* rings to a row */
    int32_t ring; /* the first one */
    int32_t rings;
    int32_t line; /* the first row from the pole that is read; those beyond it are negative */
    int32_t lines;
} pole_footprint;

static int32_t greatest_divisor(int32_t of, double most)
{
    int32_t divisor = most < 1.0 ? 1 : most > of ? of : (int32_t)most;
    while (of % divisor != 0)
    {
        divisor--;
    }
    return divisor;
}

/* The columns of a circle that reaches so far about a place so far from the pole. */
static void put_columns(double distance, double reach, pole_footprint *at)
{
    const int32_t width = (int32_t)at->ewa->width[at->level];
    const double rows = 2.0 * fmin(reach, distance + reach);
    const double arc = distance > reach ? asin(reach / distance) : PI;
    const double column = atan2((double)at->y, (double)at->x) * (0.5 / PI) * width;
    const double half = arc * (0.5 / PI) * width;
    const double pixels = fmin(2.0 * half, width) * rows * at->fine;
    const double dense = width / (4.0 * PI * (distance + reach));
    at->step = greatest_divisor(width, fmin(pixels / (double)at->ewa->pixels_most, dense));
    at->columns = width / at->step;
    at->column = 0;
    if (2.0 * half < width - 2.0 * at->step)
    {
        const double first = floor((column - half) / at->step);
        at->column = (int32_t)first * at->step;
        at->columns = (int32_t)(ceil((column + half) / at->step) - first) + 1;
    }
}

static void put_rings(double distance, double reach, pole_footprint *at)
{
    const int32_t height = (int32_t)at->ewa->height[at->level];
    at->fine =
        distance < reach + 1.0 && reach < FINE_MOST && distance + reach < LINES - 2 * TAPS ? 2 : 1;
    const double first = floor((distance - reach) * at->fine);
    const double last = ceil((distance + reach) * at->fine);
    at->ring = first > 0.0 ? (int32_t)first : 0;
    at->rings = (last < height * at->fine ? (int32_t)last : height * at->fine) - at->ring;
    at->line = at->ring / at->fine - (at->fine == 2 ? TAPS_ABOVE + 1 : 0);
    at->lines = at->fine == 1 ? at->rings : (at->ring + at->rings) / 2 + TAPS / 2 + 1 - at->line;
}

static pole_footprint footprint_of(const cm_ewa *ewa, const pole_group *poles, unsigned plane,
                                   const cm_ewa_shapes *shapes, unsigned i)
{
    pole_footprint at = {.ewa = ewa,
                         .level = (unsigned)poles->axes.level[i],
                         .plane = plane,
                         .is_lower = poles->is_lower[i],
                         .a = shapes->a[i],
                         .b = shapes->b[i],
                         .c = shapes->c[i],
                         .x = shapes->x[i],
                         .y = shapes->y[i]};
    const double a = (double)at.a, b = (double)at.b, c = (double)at.c;
    const double reach = 1.0 / sqrt(fmax(0.5 * (a + c - hypot(a - c, b)), 1e-12));
    const double distance = hypot((double)at.x, (double)at.y);
    put_rings(distance, reach, &at);
    put_columns(distance, reach, &at);
    return at;
}

/* ---- sums ---- */

/* Some columns of a footprint. */
typedef struct pole_columns
{
    int32_t first; /* of the level */
    int32_t count;
    float cosine[COLUMNS];
    float sine[COLUMNS];
    float weight[COLUMNS];         /* of a ring */
    float of_line[LINES][COLUMNS]; /* of rows, where rings are between them */
    float pixel[COLUMNS];
} pole_columns;

/* Memory for the pixels of some columns of a row, as they are stored, and channel by channel. */
typedef struct pole_desk
{
    float *run;
    float *line;
    double *sum; /* of channels */
    double weights;
    pole_columns columns;
} pole_desk;

/* Numbers of a channel of a row: vectors may have more than was asked for. */
#define LINE_ROOM (COLUMNS + 16)

/* Columns are found by turning the first one on. */
static void place_columns(const pole_footprint *at, int32_t first, int32_t count,
                          pole_columns *columns)
{
    const double step = 2.0 * PI / at->ewa->width[at->level];
    const double turn[2] = {cos(step * at->step), sin(step * at->step)};
    double c = cos(step * (first + 0.5)), s = sin(step * (first + 0.5));
    columns->first = first;
    columns->count = count;
    for (int32_t i = 0; i < count; i++)
    {
        columns->cosine[i] = (float)c;
        columns->sine[i] = (float)s;
        const double next = c * turn[0] - s * turn[1];
        s = c * turn[1] + s * turn[0];
        c = next;
    }
}

/* The kernel at the places of a ring. */
static void weigh_ring(const pole_footprint *at, int32_t ring, pole_columns *columns)
{
    const float radius = ((float)ring + 0.5f) / (float)at->fine;
    const float area = (float)(ring < 2 ? ring_weight[ring] : ring + 0.5);
    const float *term = at->ewa->kernel.term;
    const float a = at->a, b = at->b, c = at->c, x = at->x, y = at->y;
    for (int32_t i = 0; i < columns->count; i++)
    {
        const float right = radius * columns->cosine[i] - x;
        const float up = radius * columns->sine[i] - y;
        const float rest = 1.0f - ((a * right + b * up) * right + c * up * up);
        const float u = rest > 0.0f ? rest : 0.0f;
        const float high = (term[3] * u + term[2]) * u + term[1];
        columns->weight[i] = area * (u * u) * (high * u + term[0]);
    }
}

static double sum_of(const float *value, int32_t n)
{
    float lane[8] = {0};
    int32_t i = 0;
    for (; i + 8 <= n; i += 8)
    {
        for (int32_t k = 0; k < 8; k++)
        {
            lane[k] += value[i + k];
        }
    }
    for (; i < n; i++)
    {
        lane[i % 8] += value[i];
    }
    return (double)(((lane[0] + lane[4]) + (lane[1] + lane[5])) +
                    ((lane[2] + lane[6]) + (lane[3] + lane[7])));
}

/* Columns of a row from the pole, channel by channel, LINE_ROOM numbers apart: n pixels that lie inside of the level. */
static void read_line(const pole_footprint *at, int32_t line, int32_t column, int32_t n,
                      pole_desk *desk)
{
    const cm_pyramid *pyramid = &at->ewa->pyramid;
    const size_t channels = pyramid->pictures.channels;
    const int32_t height = (int32_t)at->ewa->height[at->level];
    const int32_t row = at->is_lower ? height - 1 - line : line;
    if (at->level == 0)
    {
        cm_level_read(&pyramid->reader, at->plane, column, row, n, desk->run);
        at->ewa->set->part_channels(desk->run, channels, (size_t)n, desk->line, LINE_ROOM);
        return;
    }
    const cm_padded *level = &pyramid->level[at->level];
    for (size_t k = 0; k < channels; k++)
    {
        const ptrdiff_t first = row * level->row + column + (ptrdiff_t)k * level->channel;
        float *to = desk->line + k * LINE_ROOM;
        if (level->is_whole)
        {
            at->ewa->set->from_whole((size_t)(n + 15) / 16 * 16, level->whole[at->plane] + first,
                                     CM_PADDED_ONE, to);
        }
        else
        {
            memcpy(to, level->first[at->plane] + first, (size_t)n * sizeof *to);
        }
    }
}

/* Columns of a row by their weights. */
static void add_line(const pole_footprint *at, int32_t line, const float *weight, pole_desk *desk)
{
    pole_columns *columns = &desk->columns;
    const size_t channels = at->ewa->pyramid.pictures.channels;
    const int32_t n = columns->count;
    read_line(at, line, columns->first, (n - 1) * at->step + 1, desk);
    for (size_t k = 0; k < channels; k++)
    {
        const float *from = desk->line + k * LINE_ROOM;
        for (int32_t i = 0; i < n; i++)
        {
            /* what weighs nothing may be NaN */
            columns->pixel[i] = weight[i] != 0.0f ? weight[i] * from[i * at->step] : 0.0f;
        }
        desk->sum[k] += sum_of(columns->pixel, n);
    }
    desk->weights += sum_of(weight, n);
}

/* What a ring between rows weighs is shared out among the rows that it is interpolated from. */
static void share_ring(const pole_footprint *at, int32_t ring, pole_columns *columns)
{
    const float *tap =
        at->ewa->table->real[ring % 2 != 0 ? CM_FILTER_PHASES / 4 : CM_FILTER_PHASES / 4 * 3];
    const int32_t first = (ring + 1) / 2 - 1 - TAPS_ABOVE - at->line;
    for (int32_t t = 0; t < TAPS; t++)
    {
        float *to = columns->of_line[first + t];
        for (int32_t i = 0; i < columns->count; i++)
        {
            to[i] += tap[t] * columns->weight[i];
        }
    }
}

static void add_columns(const pole_footprint *at, int32_t first, int32_t count, pole_desk *desk)
{
    pole_columns *columns = &desk->columns;
    place_columns(at, first, count, columns);
    for (int32_t k = 0; at->fine > 1 && k < at->lines; k++)
    {
        memset(columns->of_line[k], 0, (size_t)count * sizeof(float));
    }
    for (int32_t k = 0; k < at->rings; k++)
    {
        weigh_ring(at, at->ring + k, columns);
        if (at->fine > 1)
        {
            share_ring(at, at->ring + k, columns);
        }
        else
        {
            add_line(at, at->ring + k, columns->weight, desk);
        }
    }
    for (int32_t k = 0; at->fine > 1 && k < at->lines; k++)
    {
        add_line(at, at->line + k, columns->of_line[k], desk);
    }
}

/* The weighted mean of a footprint, its columns by runs that do not go across where columns begin again. */
static void sum_footprint(const pole_footprint *at, pole_desk *desk, float *to)
{
    const int32_t width = (int32_t)at->ewa->width[at->level];
    const size_t channels = at->ewa->pyramid.pictures.channels;
    const int32_t most = (COLUMNS - 1) / at->step + 1;
    memset(desk->sum, 0, channels * sizeof *desk->sum);
    desk->weights = 0.0;
    for (int32_t done = 0; done < at->columns;)
    {
        const int32_t along = at->column + done * at->step;
        const int32_t first = along < 0 ? along + width : along >= width ? along - width : along;
        const int32_t room = (width - first) / at->step;
        const int32_t left = at->columns - done < room ? at->columns - done : room;
        const int32_t count = left < most ? left : most;
        add_columns(at, first, count, desk);
        done += count;
    }
    for (size_t k = 0; k < channels; k++)
    {
        to[k] = (float)(desk->sum[k] / desk->weights);
    }
}

/* ---- groups ---- */

/* Over what has been summed goes the value of spline36, where the ellipse is hardly more than a pixel. */
static void sharpen(const cm_ewa *ewa, const cm_group *group, unsigned i, float share,
                    pole_desk *desk, float *to)
{
    cm_ewa_shapes centre;
    const size_t channels = ewa->pyramid.pictures.channels;
    const int32_t left = (int32_t)floorf(group->x[i]) - TAPS_ABOVE;
    const int32_t top = (int32_t)floorf(group->y[i]) - TAPS_ABOVE;
    const size_t line = 16;
    centre.x[0] = group->x[i];
    centre.y[0] = group->y[i];
    for (int32_t k = 0; k < TAPS; k++)
    {
        cm_level_read(&ewa->pyramid.reader, group->plane, group->column + left,
                      group->row + top + k, TAPS, desk->run);
        ewa->set->part_channels(desk->run, channels, TAPS, desk->line + (size_t)k * line * channels,
                                (ptrdiff_t)line);
    }
    const cm_ewa_pixels pixels = {.first = desk->line - top * (ptrdiff_t)(line * channels) - left,
                                  .row = (ptrdiff_t)(line * channels),
                                  .channel = (ptrdiff_t)line,
                                  .channels = channels};
    ewa->set->ewa_sharp(0, &centre, &pixels, ewa->table, share, to);
}

/* How much of a value is the sharp one: towards the end of the cap no more than ellipses of columns have. */
static float share_of(const cm_ewa *ewa, const pole_group *poles, unsigned i)
{
    const float beyond = poles->sharp[i];
    const float sharp = cm_ewa_sharpness(poles->axes.major[i]);
    const float distance = hypotf(poles->x[i], poles->y[i]);
    const float inner = 2.0f - 2.0f * distance / ewa->cap[0];
    const float within = inner < 1.0f ? sharp * (inner > 0.0f ? inner : 0.0f) : sharp;
    return within > beyond ? within : beyond;
}

static void do_pixel(const cm_ewa *ewa, const cm_group *group, const pole_group *poles,
                     cm_ewa_shapes *shapes, unsigned i, pole_desk *desk, float *to)
{
    const float share = share_of(ewa, poles, i);
    if (share < 1.0f)
    {
        const pole_footprint at = footprint_of(ewa, poles, group->plane, shapes, i);
        sum_footprint(&at, desk, to);
    }
    if (share > 0.0f)
    {
        sharpen(ewa, group, poles->which[i], share, desk, to);
    }
}

/* Pixels whose footprints are laid on that level. */
static void do_level(const cm_ewa *ewa, const cm_group *group, const pole_group *poles, unsigned k,
                     cm_ewa_shapes *shapes, pole_desk *desk, float *to)
{
    const float down = (float)((double)ewa->height[k] / ewa->height[0]);
    const cm_ewa_frame frame = {.across = down, .down = down};
    ewa->set->ewa_shapes(poles->count, poles->x, poles->y, &poles->axes, &ewa->kernel,
                         FINER_PIXELS * ewa->pixels_most, &frame, shapes);
    for (unsigned i = 0; i < poles->count; i++)
    {
        if (poles->axes.level[i] == (int32_t)k)
        {
            do_pixel(ewa, group, poles, shapes, i, desk,
                     to + poles->which[i] * ewa->pyramid.pictures.channels);
        }
    }
}

static void prefer_finer(const cm_ewa *ewa, pole_group *poles)
{
    for (unsigned i = 0; i < poles->count; i++)
    {
        const float reach = FINER_REACH * ewa->kernel.radius * sqrtf(poles->axes.major[i]);
        int32_t *level = &poles->axes.level[i];
        if (hypotf(poles->x[i], poles->y[i]) < reach)
        {
            *level = *level > FINER ? *level - FINER : 0;
        }
    }
}

static cm_status make_desk(const cm_ewa *ewa, cm_scratch *scratch, pole_desk **desk)
{
    const size_t channels = ewa->pyramid.pictures.channels;
    const size_t numbers = channels * LINE_ROOM;
    const cm_status status =
        cm_scratch_room(scratch, sizeof **desk + channels * sizeof(double) +
                                     2 * numbers * sizeof(float) + CM_WINDOW_SLACK);
    if (status == CM_OK)
    {
        *desk = (pole_desk *)(void *)scratch->bytes;
        (*desk)->sum = (double *)(void *)(*desk + 1);
        (*desk)->run = (float *)(void *)((*desk)->sum + channels);
        (*desk)->line = (*desk)->run + numbers;
    }
    return status;
}

cm_status cm_ewa_poles(const cm_ewa *ewa, const cm_group *group, int32_t coarsest,
                       cm_scratch *scratch, cm_ewa_axes *axes, unsigned *count, float *to)
{
    pole_group poles;
    pole_desk *desk;
    cm_ewa_shapes shapes;
    *count = 0;
    if (ewa->surface->poles == 0 || !may_be_beside(ewa, group, coarsest))
    {
        return CM_OK;
    }
    find_pixels(ewa, group, axes, &poles);
    if (poles.count == 0)
    {
        return CM_OK;
    }
    const cm_status status = make_desk(ewa, scratch, &desk);
    if (status != CM_OK)
    {
        return status;
    }
    ewa->set->ewa_axes(poles.count, poles.by_column[0], poles.by_column[1], poles.by_row[0],
                       poles.by_row[1], ewa->least, ewa->pyramid.count, &poles.axes);
    prefer_finer(ewa, &poles);
    uint32_t wanted = 0;
    for (unsigned i = 0; i < poles.count; i++)
    {
        wanted |= (uint32_t)1 << poles.axes.level[i];
        axes->level[poles.which[i]] = CM_EWA_DONE;
    }
    cm_status there = CM_OK;
    for (unsigned k = 0; k < ewa->pyramid.count && there == CM_OK; k++)
    {
        if (wanted >> k & 1)
        {
            there = cm_pyramid_need(&ewa->pyramid, k);
            if (there == CM_OK)
            {
                do_level(ewa, group, &poles, k, &shapes, desk, to);
            }
        }
    }
    *count = poles.count;
    return there;
}
