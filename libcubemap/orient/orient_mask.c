/* SPDX-License-Identifier: MIT
 *
 * The mask: its pixels as points, in as many clusters as a level needs; and for edges a table of what it is, and of what
 * it is at the least within some reach.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_mask.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979324

/* ---- Pixels ---- */

static double latitude_of(size_t row, size_t height)
{
    return PI * (0.5 - ((double)row + 0.5) / (double)height);
}

/* The columns' directions, cosine and sine by turns, to be freed. */
static double *make_columns(size_t width)
{
    double *columns = calloc(width, 2 * sizeof *columns);
    for (size_t i = 0; i < width && columns != NULL; i++)
    {
        const double lon = 2.0 * PI * (((double)i + 0.5) / (double)width - 0.5);
        columns[2 * i] = cos(lon);
        columns[2 * i + 1] = sin(lon);
    }
    return columns;
}

typedef struct cluster
{
    double weight;
    double sum[3];
    double reach;
} cluster;

/* Calls it for every pixel that counts, with its direction and its weight: solid angle times value. */
static int for_pixels(const cm_mask *mask, void (*call)(void *, const double[3], double),
                      void *user)
{
    double *columns = make_columns(mask->width);
    for (size_t row = 0; row < mask->height && columns != NULL; row++)
    {
        const double lat = latitude_of(row, mask->height);
        const double sine = sin(lat);
        const double cosine = cos(lat);
        /* all pixels are of one width; the sine of half their height is common, too */
        for (size_t i = 0; i < mask->width; i++)
        {
            const double value = (double)mask->value[row * mask->width + i];
            if (value > 0.0)
            {
                const double d[3] = {cosine * columns[2 * i], cosine * columns[2 * i + 1], sine};
                call(user, d, cosine * value);
            }
        }
    }
    free(columns);
    return columns != NULL;
}

typedef struct gathering
{
    cm_orient_points *points;
    cluster *clusters;
    unsigned side;
    size_t count;
    double weight;
} gathering;

static void count_pixel(void *user, const double d[3], double weight)
{
    gathering *all = user;
    (void)d;
    all->count++;
    all->weight += weight;
}

static void add_point(gathering *all, const double d[3], double weight)
{
    const size_t i = all->count++;
    all->points->x[i] = (float)d[0];
    all->points->y[i] = (float)d[1];
    all->points->z[i] = (float)d[2];
    all->points->weight[i] = (float)(weight / all->weight);
}

static void add_pixel(void *user, const double d[3], double weight)
{
    add_point(user, d, weight);
}

static void add_to_cluster(void *user, const double d[3], double weight)
{
    gathering *all = user;
    cluster *to = &all->clusters[cm_table_locate(d, all->side)];
    to->weight += weight;
    for (int i = 0; i < 3; i++)
    {
        to->sum[i] += weight * d[i];
    }
    all->weight += weight;
}

static void widen_cluster(void *user, const double d[3], double weight)
{
    const gathering *all = user;
    cluster *of = &all->clusters[cm_table_locate(d, all->side)];
    double length = 0.0;
    double square = 0.0;
    (void)weight;
    for (int i = 0; i < 3; i++)
    {
        length += of->sum[i] * of->sum[i];
    }
    for (int i = 0; i < 3; i++)
    {
        const double difference = d[i] - of->sum[i] / sqrt(length);
        square += difference * difference;
    }
    of->reach = square > of->reach ? square : of->reach;
}

static int make_clusters(gathering *all, const cm_mask *mask)
{
    const size_t cells = (size_t)6 * all->side * all->side;
    all->clusters = calloc(cells, sizeof *all->clusters);
    if (all->clusters == NULL || !for_pixels(mask, add_to_cluster, all) ||
        !for_pixels(mask, widen_cluster, all))
    {
        return 0;
    }
    size_t filled = 0;
    for (size_t i = 0; i < cells; i++)
    {
        filled += all->clusters[i].weight > 0.0;
    }
    if (!cm_points_make(all->points, filled))
    {
        return 0;
    }
    for (size_t i = 0; i < cells; i++)
    {
        const cluster *from = &all->clusters[i];
        if (from->weight > 0.0)
        {
            const double d[3] = {from->sum[0] / from->weight, from->sum[1] / from->weight,
                                 from->sum[2] / from->weight};
            const double reach = 2.0 * asin(0.5 * sqrt(from->reach));
            add_point(all, d, from->weight);
            all->points->reach = reach > all->points->reach ? reach : all->points->reach;
        }
    }
    return 1;
}

int cm_mask_points(const cm_orient_task *task, unsigned per_face, cm_orient_points *points)
{
    gathering all = {.points = points, .side = per_face};
    *points = (cm_orient_points){.count = 0};
    if (per_face > 0)
    {
        const int made = make_clusters(&all, task->mask);
        free(all.clusters);
        return made;
    }
    if (!for_pixels(task->mask, count_pixel, &all) || !cm_points_make(points, all.count))
    {
        return 0;
    }
    all.count = 0;
    return for_pixels(task->mask, add_pixel, &all);
}

/* ---- Erosion ---- */

enum
{
    ERODED_WIDTH = 1440,
    LOGS = 17,
    PLACES = 4 /* along a piece of a table, at which it looks */
};

/* The least values of blocks of pixels: what erosion does not need in detail. */
typedef struct blocks
{
    size_t width;
    size_t height;
    size_t pixels; /* along a block's side, but the last ones */
    float *least;
    double column; /* from one to the next, radians */
    double row;
} blocks;

static int make_blocks(const cm_mask *mask, blocks *made)
{
    const size_t k = (mask->width + ERODED_WIDTH - 1) / ERODED_WIDTH;
    *made = (blocks){.width = (mask->width + k - 1) / k,
                     .height = (mask->height + k - 1) / k,
                     .pixels = k,
                     .column = 2.0 * PI * (double)k / (double)mask->width,
                     .row = PI * (double)k / (double)mask->height};
    made->least = malloc(made->width * made->height * sizeof *made->least);
    for (size_t i = 0; i < made->width * made->height && made->least != NULL; i++)
    {
        made->least[i] = (float)INFINITY;
    }
    for (size_t i = 0; i < mask->width * mask->height && made->least != NULL; i++)
    {
        float *to = &made->least[i / mask->width / k * made->width + i % mask->width / k];
        *to = mask->value[i] < *to ? mask->value[i] : *to;
    }
    return made->least != NULL;
}

/* least[k][i]: of the columns i to i + 2^k - 1, around the Earth. */
static void make_windows(const float *row, size_t width, float *least)
{
    memcpy(least, row, width * sizeof *least);
    for (size_t k = 1; (size_t)1 << k <= width; k++)
    {
        const float *half = least + (k - 1) * width;
        for (size_t i = 0; i < width; i++)
        {
            const float other = half[(i + ((size_t)1 << (k - 1))) % width];
            least[k * width + i] = half[i] < other ? half[i] : other;
        }
    }
}

static float window_least(const float *least, size_t width, size_t begin, size_t length)
{
    size_t k = 0;
    while ((size_t)2 << k <= length)
    {
        k++;
    }
    const float a = least[k * width + begin % width];
    const float b = least[k * width + (begin + length - ((size_t)1 << k)) % width];
    return a < b ? a : b;
}

/* Where a piece's centre is, and what is least about it. */
typedef struct place
{
    float lon; /* 0 to 2 pi, from the first column's left edge */
    float lat;
    float least;
} place;

/* All blocks of a row whose middle is within reach of the place. The last column of blocks may be narrower, and
 * all of it is counted with its left neighbour's width, which is only wider. */
static void take_row(const blocks *from, const float *windows, double row_lat, double reach,
                     place *to)
{
    const double lat = (double)to->lat;
    const double product = cos(lat) * cos(row_lat);
    const double cosine = (cos(reach) - sin(lat) * sin(row_lat)) / fmax(product, 1e-30);
    const double half = cosine <= -1.0 ? 4.0 : cosine >= 1.0 ? 0.0 : acos(cosine);
    const double first = floor(((double)to->lon - half) / from->column - 0.5);
    const double last = ceil(((double)to->lon + half) / from->column - 0.5);
    const double length = last - first + 1.0;
    float least;
    if (length >= (double)from->width)
    {
        least = window_least(windows, from->width, 0, from->width);
    }
    else
    {
        least = window_least(windows, from->width, (size_t)(first + (double)(2 * from->width)),
                             (size_t)length);
    }
    to->least = least < to->least ? least : to->least;
}

/* The places' row of blocks by counting: order[start[row]] to order[start[row + 1] - 1] are those in it. */
static void sort_places(const blocks *from, const place *places, size_t count, size_t *start,
                        unsigned *order)
{
    for (int pass = 0; pass < 2; pass++)
    {
        for (size_t i = count; i-- > 0;)
        {
            size_t row = (size_t)((0.5 * PI - (double)places[i].lat) / from->row);
            row = row < from->height ? row : from->height - 1;
            if (pass == 0)
            {
                start[row]++;
            }
            else
            {
                order[--start[row]] = (unsigned)i;
            }
        }
        for (size_t row = 1; row <= from->height && pass == 0; row++)
        {
            start[row] += start[row - 1];
        }
    }
}

static void erode(const blocks *from, double reach, place *places, const size_t *start,
                  const unsigned *order, float *windows)
{
    const size_t rows = (size_t)ceil(reach / from->row) + 1;
    for (size_t source = 0; source < from->height; source++)
    {
        const double lat = 0.5 * PI - ((double)source + 0.5) * from->row;
        const size_t first = source > rows ? source - rows : 0;
        const size_t last = source + rows < from->height ? source + rows : from->height - 1;
        make_windows(from->least + source * from->width, from->width, windows);
        for (size_t i = start[first]; i < start[last + 1]; i++)
        {
            take_row(from, windows, fmax(lat, -0.5 * PI), reach, &places[order[i]]);
        }
    }
}

static void find_places(const cm_orient_table *table, place *places)
{
    const unsigned side = table->side;
    for (unsigned i = 0; i < 6 * side * side; i++)
    {
        double d[3];
        cm_table_middle(side, i, d);
        places[i] = (place){(float)(atan2(d[1], d[0]) + PI),
                            (float)atan2(d[2], sqrt(d[0] * d[0] + d[1] * d[1])), (float)INFINITY};
    }
}

int cm_mask_table(const cm_orient_task *task, double reach, double best, cm_orient_table *table)
{
    const size_t count = (size_t)6 * table->side * table->side;
    blocks from;
    if (!make_blocks(task->mask, &from))
    {
        return 0;
    }
    place *places = malloc(count * sizeof *places);
    unsigned *order = malloc(count * sizeof *order);
    size_t *start = calloc(from.height + 1, sizeof *start);
    float *windows = malloc(LOGS * from.width * sizeof *windows);
    const int made = places != NULL && order != NULL && start != NULL && windows != NULL;
    if (made)
    {
        /* from a point to its pixel's middle, and from there to its block's */
        const double pixel = 0.5 * hypot(from.column, from.row) / (double)from.pixels;
        const double block = from.pixels > 1 ? 0.5 * hypot(from.column, from.row) : 0.0;
        find_places(table, places);
        sort_places(&from, places, count, start, order);
        /* of the largest pixels that is all of the sphere */
        erode(&from, fmin(reach + pixel + block, PI), places, start, order, windows);
        for (size_t i = 0; i < count; i++)
        {
            const double least = (double)places[i].least / task->largest;
            table->piece[i] = (cm_orient_piece){(float)(least - best - 1e-7), 0.0f, 0.0f, 0.0f};
        }
    }
    free(from.least);
    free(places);
    free(order);
    free(start);
    free(windows);
    return made;
}

/* Where a direction is in the mask, in pixels from its upper left corner. */
typedef struct spot
{
    double row;
    double column;
} spot;

static spot mask_spot(const cm_mask *mask, const double d[3])
{
    const double lat = atan2(d[2], sqrt(d[0] * d[0] + d[1] * d[1]));
    return (spot){(0.5 - lat / PI) * (double)mask->height,
                  (atan2(d[1], d[0]) / (2.0 * PI) + 0.5) * (double)mask->width};
}

static double mask_value(const cm_mask *mask, spot at)
{
    const double width = (double)mask->width;
    const double height = (double)mask->height;
    return (double)mask->value[(size_t)fmin(at.row, height - 1.0) * mask->width +
                               (size_t)fmin(at.column, width - 1.0)];
}

/* Is all within reach of the direction in its pixel? A cap reaches sin(longitude) = sin(reach) / cos(latitude) to its sides,
 * if the pole is not in it. */
static int is_in_pixel(const cm_mask *mask, const double d[3], spot at, double reach)
{
    const double above = at.row - floor(at.row);
    const double left = at.column - floor(at.column);
    const double up = fmin(above, 1.0 - above) * PI / (double)mask->height;
    const double aside = fmin(left, 1.0 - left) * 2.0 * PI / (double)mask->width;
    const double wide = reach + 1e-6;
    return up > wide && sqrt(d[0] * d[0] + d[1] * d[1]) * sin(fmin(aside, 0.5 * PI)) > sin(wide);
}

/* The mean over a piece. */
static double mean_value(const cm_mask *mask, const cm_orient_table *table, unsigned i)
{
    const unsigned side = table->side;
    const double fine = PLACES * side;
    double sum = 0.0;
    double d[3];
    cm_table_middle(side, i, d);
    const spot middle = mask_spot(mask, d);
    if (is_in_pixel(mask, d, middle, table->half_diagonal))
    {
        return mask_value(mask, middle);
    }
    for (unsigned k = 0; k < PLACES * PLACES; k++)
    {
        const double row = PLACES * (i / side % side) + k / PLACES;
        const double column = PLACES * (i % side) + k % PLACES;
        cm_table_direction(i / side / side, (2.0 * row + 1.0) / fine - 1.0,
                           (2.0 * column + 1.0) / fine - 1.0, d);
        sum += mask_value(mask, mask_spot(mask, d));
    }
    return sum / (PLACES * PLACES);
}

void cm_plain_table(const cm_orient_task *task, cm_orient_table *table)
{
    for (unsigned i = 0; i < 6 * table->side * table->side; i++)
    {
        table->piece[i].base = (float)(mean_value(task->mask, table, i) / task->largest);
        table->piece[i].x = table->piece[i].y = table->piece[i].z = 0.0f;
    }
}
