/* SPDX-License-Identifier: MIT
 *
 * Rays and the closed surfaces that formulas give; vectors of three.
 */
#ifndef CUBEMAP_SCENE_PRIMITIVE_H
#define CUBEMAP_SCENE_PRIMITIVE_H

#include <cubemap/world.h>

/* Greater coordinates are refused: their products would overflow. */
#define COORDINATE_END 1e100

/* The direction's greatest component is in [0.5, 1). */
typedef struct ray
{
    double origin[3];
    double direction[3];
} ray;

/* A primitive as rays need it. */
typedef struct solid
{
    cm_primitive given;
    double axis[3]; /* of a cylinder, of length 1 */
    double length;  /* and how long it is */
} solid;

/* Where a ray meets a surface. */
typedef struct meeting
{
    double distance;
    int face; /* which part of the surface, as normal_of knows it */
    uint32_t triangle;
    double weight[3]; /* of the triangle's vertices, which sum to 1 */
} meeting;

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void subtract(const double a[3], const double b[3], double difference[3])
{
    for (int i = 0; i < 3; i++)
    {
        difference[i] = a[i] - b[i];
    }
}

static inline void cross(const double a[3], const double b[3], double product[3])
{
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
    product[0] = x;
    product[1] = y;
}

/* Of length 1, and how long it was; 0 if it has no direction. */
double make_unit(double vector[3]);

/* The nearest surface above distance 0, of all kinds but meshes: 1 if there is one. */
int meet_solid(const solid *surface, const ray *along, meeting *found);

/* The normal there, on either side, of any length, which may be 0 by rounding. */
void normal_of(const solid *surface, const double point[3], int face, double normal[3]);

#endif
