/* SPDX-License-Identifier: MIT
 *
 * What a sensor's file may say: the ranges of the library's own numbers, so that no other stands beside them.
 */
#ifndef CUBEMAP_SIM_IO_SENSOR_RANGES_H
#define CUBEMAP_SIM_IO_SENSOR_RANGES_H

#include "modules/sim/sensor_limits.h"

#endif
