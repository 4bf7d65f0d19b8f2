/* SPDX-License-Identifier: MIT
 *
 * Frames that are made to be measured, before one is made to be kept.
 */
#ifndef CUBEMAP_SIM_PLANNED_FRAME_H
#define CUBEMAP_SIM_PLANNED_FRAME_H

#include <cubemap/sim.h>

/* What all of them share. */
typedef struct planning
{
    const cm_tof_scene *scene;
    const cm_tof_light *light;
    size_t lights;
    const cm_trajectory *trajectory;
    double time;
    cm_pool *pool;
    double unambiguous; /* metres, from where on distances repeat */
} planning;

/* One of them. */
typedef struct planned_frame
{
    float *distance;
    size_t pixels;
    double milliseconds; /* of the processor */
    double work;         /* about as many, counted: the same in each run */
} planned_frame;

cm_status planned_frame_take(const planning *with, const cm_tof_sensor *sensor,
                             const cm_tof_options *options, planned_frame *frame);
void planned_frame_drop(planned_frame *frame);

/* How far two distances are apart around the circle of distances, with its sign; what one of them alone sees is its whole,
 * and what neither sees NaN. */
double planned_frame_apart(const planning *with, double one, double other);

/* The camera with pixels so large that there are about that many at the most; *scale is how many stand for one. */
cm_status planned_frame_make_small(const cm_camera *camera, double most, double *scale,
                                   cm_camera **small);

#endif
