/* SPDX-License-Identifier: MIT
 *
 * What the kinds of BRDFs share: cosines from the normal, of both directions, and between them say all of isotropic ones.
 */
#ifndef CUBEMAP_SIM_BRDF_OBJECT_H
#define CUBEMAP_SIM_BRDF_OBJECT_H

#include <cubemap/brdf.h>

#include "vector.h"

/* Two directions on the normal's side, where cosines of both are above 0. */
typedef struct brdf_angles
{
    double in, out; /* cosines from the normal */
    double between; /* cosine from one to the other */
} brdf_angles;

typedef struct brdf_kind
{
    double (*value)(const cm_brdf *brdf, const brdf_angles *at);
    double (*density)(const cm_brdf *brdf, const brdf_angles *at);
    /* A direction where the normal is z and out is above x: it may be below the surface. */
    void (*draw)(const cm_brdf *brdf, double cosine_out, const double u[3], double in[3]);
    double (*albedo)(const cm_brdf *brdf, double theta);
} brdf_kind;

/* Albedos are tabulated for so many angles from 0 to a right one. */
#define BRDF_ALBEDOS 65

typedef struct brdf_table brdf_table;

struct cm_brdf
{
    const brdf_kind *kind; /* NULL: Lambert's */
    cm_cook_torrance facets;
    double specular_part; /* of directions that are drawn from facets */
    double albedo[BRDF_ALBEDOS];
    brdf_table *table;
};

/* Is it 1 / pi everywhere? */
int brdf_is_lambert(const cm_brdf *brdf);

/* A direction of a density of cosine / pi, where the normal is z; and its cosine. */
double brdf_draw_cosine(const double u[2], double in[3]);

/* One that has nothing yet; NULL: no memory. */
cm_brdf *brdf_make(const brdf_kind *kind);
void brdf_table_destroy(brdf_table *table);

#endif
