/* SPDX-License-Identifier: MIT */
#include "scene_errors.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* What one row needs, in one piece of memory. */
typedef struct row_work
{
    double *x;
    double *y;
    double *z;
    double *values;
    unsigned *regions;
} row_work;

static int row_work_create(row_work *work, size_t width)
{
    work->x = malloc((3 + SCENE_CHANNELS) * width * sizeof *work->x);
    work->regions = malloc(width * sizeof *work->regions);
    if (work->x == NULL || work->regions == NULL)
    {
        free(work->x);
        free(work->regions);
        return 0;
    }
    work->y = work->x + width;
    work->z = work->y + width;
    work->values = work->z + width;
    return 1;
}

static void row_work_destroy(row_work *work)
{
    free(work->x);
    free(work->regions);
}

static size_t channel_bytes(scene_type type)
{
    return type == SCENE_U8 ? 1 : type == SCENE_U16 ? 2 : sizeof(float);
}

static unsigned char *row_of(const scene_surface *surface, const scene_pictures *pictures,
                             size_t plane, size_t row)
{
    const size_t dense = surface->width * SCENE_CHANNELS * channel_bytes(pictures->type);
    const size_t stride = pictures->row_bytes == 0 ? dense : pictures->row_bytes;
    return (unsigned char *)pictures->plane[plane] + row * stride;
}

static double read_value(scene_type type, const void *row, size_t index)
{
    switch (type)
    {
    case SCENE_U8:
        return ((const uint8_t *)row)[index] / 255.0;
    case SCENE_U16:
        return ((const uint16_t *)row)[index] / 65535.0;
    default:
        return (double)((const float *)row)[index];
    }
}

static void write_value(scene_type type, void *row, size_t index, double value)
{
    switch (type)
    {
    case SCENE_U8:
        ((uint8_t *)row)[index] = (uint8_t)lrint(255.0 * value);
        break;
    case SCENE_U16:
        ((uint16_t *)row)[index] = (uint16_t)lrint(65535.0 * value);
        break;
    default:
        ((float *)row)[index] = (float)value;
        break;
    }
}

int scene_fill(const analytic_scene *scene, const scene_surface *surface,
               const scene_pictures *pictures)
{
    row_work work;
    if (!row_work_create(&work, surface->width))
    {
        return 0;
    }
    for (size_t line = 0; line < surface->planes * surface->height; line++)
    {
        const size_t plane = line / surface->height;
        const size_t row = line % surface->height;
        void *to = row_of(surface, pictures, plane, row);
        surface->directions(surface->user, plane, row, work.x, work.y, work.z);
        scene_values(scene, surface->width, work.x, work.y, work.z, work.values);
        for (size_t i = 0; i < surface->width * SCENE_CHANNELS; i++)
        {
            const double value = isnan(work.values[i]) ? 0.0 : work.values[i];
            write_value(pictures->type, to, i, value);
        }
    }
    row_work_destroy(&work);
    return 1;
}

/* ---- errors ---- */

static void add_error(scene_error *to, double error, const size_t at[4])
{
    if (isnan(error))
    {
        to->missing++;
        return;
    }
    to->count++;
    to->square_sum += error * error;
    if (fabs(error) > to->worst)
    {
        to->worst = fabs(error);
        to->plane = at[0];
        to->row = at[1];
        to->column = at[2];
        to->channel = at[3];
    }
}

/* One row's errors to a list of their own, so that sums of millions keep their digits. */
static void add_row(scene_errors *errors, const scene_surface *surface, const row_work *work,
                    const scene_pictures *pictures, size_t plane, size_t row)
{
    const void *from = row_of(surface, pictures, plane, row);
    for (size_t i = 0; i < surface->width; i++)
    {
        if (isnan(work->x[i]))
        {
            continue;
        }
        const unsigned inner = work->regions[i] == 0 ? 1u << SCENE_INTERIOR : work->regions[i];
        for (size_t c = 0; c < SCENE_CHANNELS; c++)
        {
            const size_t index = SCENE_CHANNELS * i + c;
            const size_t at[4] = {plane, row, i, c};
            const double error = read_value(pictures->type, from, index) - work->values[index];
            for (int region = 0; region < SCENE_REGIONS; region++)
            {
                if (region == SCENE_ALL || (inner & 1u << region) != 0)
                {
                    add_error(&errors->region[region], error, at);
                }
            }
        }
    }
}

static void add_errors(scene_error *to, const scene_error *more)
{
    to->count += more->count;
    to->missing += more->missing;
    to->square_sum += more->square_sum;
    if (more->worst > to->worst)
    {
        to->worst = more->worst;
        to->plane = more->plane;
        to->row = more->row;
        to->column = more->column;
        to->channel = more->channel;
    }
}

int scene_measure(const analytic_scene *scene, const scene_surface *surface,
                  const scene_pictures *pictures, scene_errors *errors)
{
    row_work work;
    scene_errors sum = {0};
    if (!row_work_create(&work, surface->width))
    {
        return 0;
    }
    for (size_t line = 0; line < surface->planes * surface->height; line++)
    {
        const size_t plane = line / surface->height;
        const size_t row = line % surface->height;
        scene_errors of_row = {0};
        surface->directions(surface->user, plane, row, work.x, work.y, work.z);
        scene_values(scene, surface->width, work.x, work.y, work.z, work.values);
        scene_regions_of_row(surface, plane, row, work.x, work.y, work.z, work.regions);
        add_row(&of_row, surface, &work, pictures, plane, row);
        for (int region = 0; region < SCENE_REGIONS; region++)
        {
            add_errors(&sum.region[region], &of_row.region[region]);
        }
    }
    row_work_destroy(&work);
    *errors = sum;
    return 1;
}

double scene_decibels(const scene_error *error)
{
    return error->count == 0 ? NAN : -10.0 * log10(error->square_sum / (double)error->count);
}

/* ---- the zone plate ---- */

/* Cycles and angles of one row. */
typedef struct plate_row
{
    double *cycles;
    double *angle;
} plate_row;

static void plate_row_of(const analytic_scene *scene, const scene_surface *surface, size_t plane,
                         size_t row, row_work *work, plate_row *to)
{
    surface->directions(surface->user, plane, row, work->x, work->y, work->z);
    for (size_t i = 0; i < surface->width; i++)
    {
        const double d[3] = {work->x[i], work->y[i], work->z[i]};
        to->cycles[i] = scene_cycles(scene, d, &to->angle[i]);
    }
}

/* The change a pixel of one of the two, along a row's or a column's neighbours; at an end there is one only. */
static double change(double before, double after, int both)
{
    return both ? 0.5 * (after - before) : after - before;
}

typedef struct plate_sums
{
    size_t count;
    double square;
    double product;
    double reference;
} plate_sums;

/* The pixels of the row in the middle of three, that above and that below; at a plane's edge one of them is the row
 * itself. */
static void add_plate_row(const scene_surface *surface, const plate_row rows[3], const int both,
                          const double frequencies[2], const scene_pictures *pictures,
                          const void *from, plate_sums *sums)
{
    const double pi = 3.14159265358979323846;
    for (size_t i = 0; i < surface->width; i++)
    {
        const size_t left = i == 0 ? 0 : i - 1;
        const size_t right = i + 1 == surface->width ? i : i + 1;
        const double *cycles = rows[1].cycles;
        const double *angle = rows[1].angle;
        const double frequency = hypot(change(cycles[left], cycles[right], right - left == 2),
                                       change(rows[0].cycles[i], rows[2].cycles[i], both));
        const double pixel = hypot(change(angle[left], angle[right], right - left == 2),
                                   change(rows[0].angle[i], rows[2].angle[i], both));
        const int is_apart = fmin(angle[i], pi - angle[i]) > 4.0 * pixel;
        if (!(frequency >= frequencies[0] && frequency <= frequencies[1] && is_apart))
        {
            continue;
        }
        const double value = read_value(pictures->type, from, SCENE_CHANNELS * i) - SCENE_MEAN;
        const double reference = SCENE_AMPLITUDE * cos(2.0 * pi * (cycles[i] - rint(cycles[i])));
        sums->count++;
        sums->square += value * value;
        sums->product += value * reference;
        sums->reference += reference * reference;
    }
}

static void add_plate_plane(const analytic_scene *scene, const scene_surface *surface,
                            const scene_pictures *pictures, size_t plane,
                            const double frequencies[2], row_work *work, plate_row ring[3],
                            plate_sums *sums)
{
    plate_row_of(scene, surface, plane, 0, work, &ring[0]);
    for (size_t row = 0; row < surface->height; row++)
    {
        const int is_last = row + 1 == surface->height;
        if (!is_last)
        {
            plate_row_of(scene, surface, plane, row + 1, work, &ring[(row + 1) % 3]);
        }
        const plate_row rows[3] = {ring[(row == 0 ? row : row - 1) % 3], ring[row % 3],
                                   ring[(is_last ? row : row + 1) % 3]};
        add_plate_row(surface, rows, row > 0 && !is_last, frequencies, pictures,
                      row_of(surface, pictures, plane, row), sums);
    }
}

int scene_measure_plate(const analytic_scene *scene, const scene_surface *surface,
                        const scene_pictures *pictures, double low, double high,
                        scene_response *response)
{
    row_work work;
    plate_row ring[3];
    plate_sums sums = {0};
    const double frequencies[2] = {low, high};
    double *memory = malloc(6 * surface->width * sizeof *memory);
    if (memory == NULL || !row_work_create(&work, surface->width))
    {
        free(memory);
        return 0;
    }
    for (size_t i = 0; i < 3; i++)
    {
        ring[i].cycles = memory + 2 * i * surface->width;
        ring[i].angle = ring[i].cycles + surface->width;
    }
    for (size_t plane = 0; plane < surface->planes; plane++)
    {
        add_plate_plane(scene, surface, pictures, plane, frequencies, &work, ring, &sums);
    }
    response->count = sums.count;
    response->deviation = sqrt(sums.square / (double)sums.count) / SCENE_AMPLITUDE;
    response->gain = sums.product / sums.reference;
    row_work_destroy(&work);
    free(memory);
    return 1;
}
