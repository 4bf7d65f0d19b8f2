/* SPDX-License-Identifier: MIT
 *
 * GeographicLib's conversions between the geographic latitude and others, one by one; they take degrees.
 */
#ifndef BENCH_TIME_LATITUDES_H
#define BENCH_TIME_LATITUDES_H

#include <stddef.h>

#include <cubemap/latitude.h>

#ifdef __cplusplus
extern "C" {
#endif

/* "GeographicLib 2.1.2", or NULL where it was not there to build with. */
const char *peer_name(void);

/* n latitudes in degrees on WGS 84; from or to is the geographic one. 0 if the peer has none of that kind. */
int peer_convert(cm_latitude from, cm_latitude to, size_t n, const double *latitude, double *other);

#ifdef __cplusplus
}
#endif

#endif
