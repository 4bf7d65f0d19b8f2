/* SPDX-License-Identifier: MIT
 *
 * What the numbers of a sensor may be: beyond these there is no such light, lens or chip, and a frame would say nothing.
 * Programs that read sensors refuse the same.
 */
#ifndef CUBEMAP_SIM_SENSOR_LIMITS_H
#define CUBEMAP_SIM_SENSOR_LIMITS_H

#include <cubemap/sim.h>

#define SENSOR_HARMONIC_MOST 1e3 /* of either sign; a cosine's is 1 */

typedef enum sensor_number_kind
{
    SENSOR_NEEDED,
    SENSOR_PART,   /* needed, and a part of 1 */
    SENSOR_OR_NONE /* or 0: nothing of that kind */
} sensor_number_kind;

typedef struct sensor_limit
{
    const char *name; /* of the field */
    size_t at;        /* where that is */
    sensor_number_kind kind;
    int is_signal; /* distances cannot be had without it */
    double least, most;
} sensor_limit;

static const sensor_limit sensor_limits[] = {
    {"pitch", offsetof(cm_tof_sensor, pitch), SENSOR_NEEDED, 0, 1e-9, 1.0},
    {"f_number", offsetof(cm_tof_sensor, f_number), SENSOR_NEEDED, 0, 1e-3, 1e6},
    {"wavelength", offsetof(cm_tof_sensor, wavelength), SENSOR_NEEDED, 0, 1e-9, 1e-2},
    {"efficiency", offsetof(cm_tof_sensor, efficiency), SENSOR_PART, 0, 1e-12, 1.0},
    {"exposure", offsetof(cm_tof_sensor, exposure), SENSOR_NEEDED, 0, 1e-15, 1e9},
    {"readout", offsetof(cm_tof_sensor, readout), SENSOR_OR_NONE, 0, 0.0, 1e9},
    {"pause", offsetof(cm_tof_sensor, pause), SENSOR_OR_NONE, 0, 0.0, 1e9},
    /* waves of 300 km, of which charges in single precision still tell millimetres, to 0.3 mm */
    {"frequency", offsetof(cm_tof_sensor, frequency), SENSOR_NEEDED, 1, 1e3, 1e12},
    {"second_frequency", offsetof(cm_tof_sensor, second_frequency), SENSOR_OR_NONE, 1, 1e3, 1e12},
    {"duty", offsetof(cm_tof_sensor, duty), SENSOR_PART, 0, 1e-12, 1.0},
    {"contrast", offsetof(cm_tof_sensor, contrast), SENSOR_PART, 1, 1e-12, 1.0},
    {"full_well", offsetof(cm_tof_sensor, full_well), SENSOR_OR_NONE, 1, 1.0, 1e30},
    {"dark", offsetof(cm_tof_sensor, dark), SENSOR_OR_NONE, 0, 0.0, 1e15},
    {"read_noise", offsetof(cm_tof_sensor, read_noise), SENSOR_OR_NONE, 0, 0.0, 1e30},
    {"fixed_pattern", offsetof(cm_tof_sensor, fixed_pattern), SENSOR_OR_NONE, 0, 0.0, 1e3}};

enum
{
    SENSOR_LIMITS = sizeof sensor_limits / sizeof *sensor_limits
};

/* Is a number one that the field may have? NaN is none. */
static inline int sensor_limit_allows(const sensor_limit *limit, double value)
{
    return (limit->kind == SENSOR_OR_NONE && value == 0.0) ||
           (value >= limit->least && value <= limit->most);
}

#endif
