/* SPDX-License-Identifier: MIT
 *
 * A sensor made ready: where the samples of its pixels are, what each weighs, and how many electrons light makes.
 */
#ifndef CUBEMAP_SIM_SENSOR_H
#define CUBEMAP_SIM_SENSOR_H

#include "tof_set.h"

#define SENSOR_WAVES TOF_WAVES
#define SENSOR_SAMPLES 4096

/* Light is summed in cells: pixels, or half pixels where circuits are between pixels: those of pixel i are 2 i, 2 i + 1 and
 * 2 i + 2 (Lambers, Hoberg and Kolb 2015, eqs. 16 and 17). */
typedef struct sensor_cells
{
    uint32_t columns;
    uint32_t rows;
    double width; /* in pixels */
    double first; /* column of the first cell's left border */
    double top;   /* row of the upper border */
} sensor_cells;

/* A sample of a cell. */
typedef struct sensor_sample
{
    double x, y;      /* from the cell's centre, in cells */
    double weight[2]; /* active part of the pixel, of even and odd cells */
} sensor_sample;

typedef struct tof_sensor
{
    cm_tof_sensor given;
    uint32_t width, height; /* of the picture */
    int has_axis;           /* a perspective camera */
    sensor_cells cells;
    uint32_t sample_columns, sample_rows; /* of a cell */
    size_t samples;
    sensor_sample *sample;
    tof_moments moments[2];
    double
        electrons; /* of one circuit pair, by unmodulated radiance of 1 W/(m^2 sr) on the axis through a whole pixel */
    int series;
    tof_waves waves; /* of all series */
    int wave_series[SENSOR_WAVES];
    int wave_harmonic[SENSOR_WAVES]; /* 1: the modulation itself */
    double wave_amplitude[SENSOR_WAVES];
} tof_sensor;

/* CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_CAMERA; CM_ERROR_MEMORY. */
cm_status sensor_prepare(const cm_tof_sensor *given, const cm_tof_options *options,
                         tof_sensor *sensor);
void sensor_release(tof_sensor *sensor);

/* Is it one that cm_tof_reconstruct can work with? camera, mask and lens are not looked at. */
cm_status sensor_check_signal(const cm_tof_sensor *given);

/* Distance within which phases repeat, of a series. */
double sensor_unambiguous(const cm_tof_sensor *given, int series);

#endif
