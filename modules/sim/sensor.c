/* SPDX-License-Identifier: MIT */
#include "sensor.h"
#include "sensor_limits.h"
#include "shot_noise.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PLANCK 6.62607015e-34 /* J s, exact since 2019 */

/* Of those that distances need, or of the others. */
static int has_numbers(const cm_tof_sensor *given, int is_signal)
{
    for (size_t i = 0; i < SENSOR_LIMITS; i++)
    {
        double value;
        memcpy(&value, (const char *)given + sensor_limits[i].at, sizeof value);
        if (sensor_limits[i].is_signal == is_signal &&
            !sensor_limit_allows(&sensor_limits[i], value))
        {
            return 0;
        }
    }
    return 1;
}

cm_status sensor_check_signal(const cm_tof_sensor *given)
{
    if (given == NULL || given->size != sizeof *given ||
        (given->harmonics > 0 && given->harmonic == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!has_numbers(given, 1) || given->phases < 3 || given->phases > 64 ||
        given->harmonics > SENSOR_WAVES / (given->second_frequency > 0.0 ? 2 : 1))
    {
        return CM_ERROR_RANGE;
    }
    for (size_t i = 0; i < given->harmonics; i++)
    {
        if (!(fabs(given->harmonic[i]) <= SENSOR_HARMONIC_MOST))
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

static cm_status check_mask(const cm_tof_sensor *given)
{
    if (given->mask == NULL)
    {
        return CM_OK;
    }
    if (given->mask_columns == 0 || given->mask_rows == 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    const size_t count = (size_t)given->mask_columns * given->mask_rows;
    if (given->mask_columns > SENSOR_SAMPLES || given->mask_rows > SENSOR_SAMPLES)
    {
        return CM_ERROR_RANGE;
    }
    for (size_t i = 0; i < count; i++)
    {
        if (!(given->mask[i] >= 0.0f && given->mask[i] <= 1.0f))
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

/* The mean of the mask over a part of the pixel, times the part's area. Places are 0..1. */
static double active_part(const cm_tof_sensor *given, double left, double right, double top,
                          double bottom)
{
    if (given->mask == NULL)
    {
        return (right - left) * (bottom - top);
    }
    const double columns = (double)given->mask_columns, rows = (double)given->mask_rows;
    double sum = 0.0;
    for (uint32_t r = 0; r < given->mask_rows; r++)
    {
        const double high = fmin(bottom, ((double)r + 1.0) / rows) - fmax(top, (double)r / rows);
        for (uint32_t c = 0; high > 0.0 && c < given->mask_columns; c++)
        {
            const double wide =
                fmin(right, ((double)c + 1.0) / columns) - fmax(left, (double)c / columns);
            sum += wide > 0.0
                       ? wide * high * (double)given->mask[(size_t)r * given->mask_columns + c]
                       : 0.0;
        }
    }
    return sum;
}

static void put_sample(tof_sensor *sensor, uint32_t row, uint32_t column)
{
    const double columns = (double)sensor->sample_columns, rows = (double)sensor->sample_rows;
    sensor_sample *at = &sensor->sample[(size_t)row * sensor->sample_columns + column];
    at->x = ((double)column + 0.5) / columns - 0.5;
    at->y = ((double)row + 0.5) / rows - 0.5;
    for (int odd = 0; odd < 2; odd++)
    {
        const double width = sensor->cells.width;
        const double left = width < 1.0 ? width * odd : 0.0;
        at->weight[odd] = active_part(&sensor->given, left + width * (double)column / columns,
                                      left + width * ((double)column + 1.0) / columns,
                                      (double)row / rows, ((double)row + 1.0) / rows);
        tof_moments *moments = &sensor->moments[odd];
        moments->one += at->weight[odd];
        moments->x += at->weight[odd] * at->x;
        moments->y += at->weight[odd] * at->y;
        moments->xx += at->weight[odd] * at->x * at->x;
        moments->xy += at->weight[odd] * at->x * at->y;
        moments->yy += at->weight[odd] * at->y * at->y;
    }
}

/* What is not active needs no rays; one is kept where nothing is. */
static void drop_dark_samples(tof_sensor *sensor)
{
    size_t kept = 0;
    for (size_t i = 0; i < sensor->samples; i++)
    {
        const sensor_sample at = sensor->sample[i];
        if (at.weight[0] > 0.0 || at.weight[1] > 0.0)
        {
            sensor->sample[kept++] = at;
        }
    }
    sensor->samples = kept > 0 ? kept : 1;
}

static cm_status put_samples(const cm_tof_options *options, tof_sensor *sensor)
{
    const uint32_t columns = options->sample_columns == 0 ? 1 : options->sample_columns;
    sensor->sample_rows = options->sample_rows == 0 ? 1 : options->sample_rows;
    sensor->sample_columns = sensor->given.single_readout ? (columns + 1) / 2 : columns;
    if (columns > 64 || sensor->sample_rows > 64)
    {
        return CM_ERROR_RANGE;
    }
    sensor->samples = (size_t)sensor->sample_columns * sensor->sample_rows;
    sensor->sample = calloc(sensor->samples, sizeof *sensor->sample);
    if (sensor->sample == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (uint32_t row = 0; row < sensor->sample_rows; row++)
    {
        for (uint32_t column = 0; column < sensor->sample_columns; column++)
        {
            put_sample(sensor, row, column);
        }
    }
    drop_dark_samples(sensor);
    return CM_OK;
}

static void put_cells(tof_sensor *sensor)
{
    const cm_camera_options *camera = cm_camera_describe(sensor->given.camera);
    sensor->width = camera->width;
    sensor->height = camera->height;
    sensor->has_axis = camera->mapping == NULL;
    sensor->cells.rows = camera->height;
    sensor->cells.columns = sensor->given.single_readout ? 2 * camera->width + 1 : camera->width;
    sensor->cells.width = sensor->given.single_readout ? 0.5 : 1.0;
    sensor->cells.first = camera->pixel_centre - 0.5;
    sensor->cells.top = camera->pixel_centre - 0.5;
}

/* Of each series those harmonics that have an amplitude. */
static void put_waves(tof_sensor *sensor)
{
    static const double cosine[1] = {1.0};
    const cm_tof_sensor *given = &sensor->given;
    const double *amplitude = given->harmonics == 0 ? cosine : given->harmonic;
    const size_t harmonics = given->harmonics == 0 ? 1 : given->harmonics;
    sensor->series = given->second_frequency > 0.0 ? 2 : 1;
    for (int series = 0; series < sensor->series; series++)
    {
        const double frequency = series == 0 ? given->frequency : given->second_frequency;
        for (size_t k = 0; k < harmonics; k++)
        {
            const size_t j = sensor->waves.count;
            if (k > 0 && amplitude[k] == 0.0)
            {
                continue;
            }
            sensor->waves.number[j] = 2.0 * PI * frequency * (double)(k + 1) / CM_SPEED_OF_LIGHT;
            sensor->wave_series[j] = series;
            sensor->wave_harmonic[j] = (int)k + 1;
            sensor->wave_amplitude[j] = amplitude[k];
            sensor->waves.count++;
        }
    }
}

cm_status sensor_prepare(const cm_tof_sensor *given, const cm_tof_options *options,
                         tof_sensor *sensor)
{
    cm_status status = sensor_check_signal(given);
    if (status == CM_OK && given->camera == NULL)
    {
        status = CM_ERROR_ARGUMENT;
    }
    if (status == CM_OK && !has_numbers(given, 0))
    {
        status = CM_ERROR_RANGE;
    }
    status = status == CM_OK ? check_mask(given) : status;
    status = status == CM_OK ? shot_noise_check(given) : status;
    if (status != CM_OK)
    {
        return status;
    }
    memset(sensor, 0, sizeof *sensor);
    sensor->given = *given;
    put_cells(sensor);
    put_waves(sensor);
    /* Lambers, Hoberg and Kolb 2015, eqs. 9 to 11; eq. 12 turned over: photons are energy times wavelength / (h c). */
    const double aperture = PI / 4.0 / (given->f_number * given->f_number);
    sensor->electrons = aperture * given->pitch * given->pitch * given->exposure *
                        given->efficiency * given->wavelength / (PLANCK * CM_SPEED_OF_LIGHT);
    return put_samples(options, sensor);
}

void sensor_release(tof_sensor *sensor)
{
    free(sensor->sample);
    sensor->sample = NULL;
}

double sensor_unambiguous(const cm_tof_sensor *given, int series)
{
    return CM_SPEED_OF_LIGHT / (2.0 * (series == 0 ? given->frequency : given->second_frequency));
}

double cm_tof_frame_time(const cm_tof_sensor *sensor)
{
    const double series = sensor->second_frequency > 0.0 ? 2.0 : 1.0;
    return series * (double)sensor->phases * (sensor->exposure + sensor->readout) + sensor->pause;
}
