/* SPDX-License-Identifier: MIT
 *
 * The surroundings, made ready: what they show in a direction, and directions drawn towards where they are brighter than in
 * the mean. What is even others see as well (Karlik and others 2019, "MIS compensation").
 */
#ifndef CUBEMAP_SIM_SKY_H
#define CUBEMAP_SIM_SKY_H

#include <cubemap/sim.h>

typedef struct tof_sky tof_sky;

/* The environment, and its picture, must outlive it. CM_OK; CM_ERROR_MEMORY. */
cm_status sky_create(const cm_tof_environment *environment, cm_pool *pool, tof_sky **made);
void sky_destroy(tof_sky *sky);

/* 1 if all that was made ready is that of this environment, too, which it then stands for; else 0. The picture is compared, so
 * that it may be changed between frames. */
int sky_turn_to(const cm_tof_environment *environment, tof_sky *sky);

/* What is everywhere. */
double sky_constant(const tof_sky *sky);

/* The part of the picture's light that is more than its mean; 0: none is, and no direction can be drawn. */
double sky_contrast(const tof_sky *sky);

/* A direction of length 1 by three numbers in [0, 1), of a density near what is more than the mean. Returns 0 where there is
 * none. */
int sky_draw(const tof_sky *sky, const double u[3], double direction[3]);

/* What the picture shows in a direction, and the density of drawing it, per steradian. */
double sky_look(const tof_sky *sky, const double direction[3], double *density);

/* The picture and what is everywhere. */
double sky_radiance(const cm_tof_environment *environment, const double direction[3]);

#endif
