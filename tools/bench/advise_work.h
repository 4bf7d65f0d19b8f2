/* SPDX-License-Identifier: MIT
 *
 * What the files of cubemap-bench advise share: what is asked, what was measured for it, and the answer.
 */
#ifndef TOOLS_BENCH_ADVISE_WORK_H
#define TOOLS_BENCH_ADVISE_WORK_H

#include "bench.h"

typedef struct advice_work
{
    suite all;
    cm_advice_request request;
    cm_ellipsoid ellipsoid;
    int precision; /* asked for, -1 if nothing is said */
    double angle;  /* of a pixel, radians; 0 if no size is asked for */
    const char *json;
    cm_advice *advice;
    uint64_t *
        pixels; /* of the face for each candidate that qualifies, 0 if none is enough; NULL without angle */
} advice_work;

/* Times of grids on the ellipsoid, from and to longitude and latitude, in place of those of the mappings. Float,
 * which has no grids, keeps none. */
void measure_grid_times(advice_work *work, stage part);

/* The error that each conversion of latitudes may have, metres; 0 for full double. */
double latitude_error(const advice_work *work);

void print_advice(const advice_work *work);
void write_advice(FILE *out, const advice_work *work);

/* The way of a candidate. */
const way *way_of(const advice_work *work, const cm_advice_candidate *candidate);

#endif
