/* SPDX-License-Identifier: MIT
 *
 * The catalogue: a constant table that describes every mapping. Tools, tests and documentation
 * iterate over it.
 */
#ifndef CUBEMAP_CATALOGUE_H
#define CUBEMAP_CATALOGUE_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a mapping maps. */
typedef enum cm_kind
{
    CM_KIND_CUBE = 0,        /* the sphere to six faces */
    CM_KIND_DISC_SQUARE = 1, /* the disc to the square: cm_warp and cm_unwarp alone (mapping.h) */
    CM_KIND_AZIMUTHAL = 2,   /* the sphere, or a part of it, to the disc, which is face 0 */
    CM_KIND_LAYOUT = 3       /* the sphere to one square, which is face 0 */
} cm_kind;

/* How a mapping comes about. */
typedef enum cm_family
{
    CM_FAMILY_UNIVARIATE = 0, /* gnomonic, then u = f(p), v = f(q) */
    CM_FAMILY_BIVARIATE = 1,  /* gnomonic, then (u, v) = W(p, q) */
    CM_FAMILY_HYBRID = 2      /* its faces are not the cube's, or it has only one */
} cm_family;

/* Properties, as bits. */
#define CM_EQUAL_AREA 1u
#define CM_CONFORMAL 2u

/* Directions, as bits. */
#define CM_FAST_FORWARD 1u
#define CM_FAST_INVERSE 2u

/* How smooth a map is, on a face, across the edge of two faces, or at a face's corner. */
typedef enum cm_smoothness
{
    CM_SMOOTH_TORN = 0, /* neighbours may part */
    CM_SMOOTH_C0 = 1,   /* continuous, with creases */
    CM_SMOOTH_C1 = 2,   /* first derivatives are continuous, not all second ones */
    CM_SMOOTH_C2 = 3, /* first and second derivatives are continuous, not all of the higher ones */
    CM_SMOOTH_ANALYTIC = 4 /* all derivatives */
} cm_smoothness;

/* No mapping has more parameters. */
#define CM_PARAMETERS_MAX 6

/* A parameter of a mapping. */
typedef struct cm_parameter_info
{
    const char *name;    /* "c" */
    const char *meaning; /* one line for people */
    double standard;     /* the value when none is given */
    double low;          /* smallest value */
    double high;         /* largest value */
    int low_excluded;    /* is low itself outside the range? */
    int whole;           /* must the value be a whole number? */
} cm_parameter_info;

/* Upper bounds on a mapping's errors with its standard parameters and with its presets, everywhere on the sphere: in eps,
 * which is 2^-53 in double and 2^-24 in float. truth/certificate measures the errors and says what
 * exactly they are, docs/measured/certificate.md has the figures and those of other parameters.
 * 0 where none is stated, which is: round_trip where the map is flat somewhere, so that a rounding of u and v
 * is far more on the sphere (orthographic at its rim, border:lambert,... at its antipode);
 * relative of layouts, whose coordinates are sums of others' or whose z passes 0 inside the map. Of what is
 * between disc and square the round trips are disc -> square -> disc and from the square, both measured on
 * the disc, where 1 eps is of the radius; of one square a plane round trip is the angle where that is less.
 * Bounds of a layout that has parts are those of its standard ones. */
typedef struct cm_bounds
{
    double round_trip;       /* direction -> face, u, v -> direction: the angle in rad / eps */
    double plane_round_trip; /* u, v -> direction -> u, v: each coordinate */
    double forward;          /* u and v: absolute error */
    double inverse;          /* p and q, and x, y and z: absolute error */
    double relative;         /* of each of these down to 1e-300 (in float 1e-36): relative error */
} cm_bounds;

/* Read through pointers that the library gives out; it may grow at its end. */
typedef struct cm_mapping_info
{
    const char *identifier;    /* "tangent" */
    const char *aliases;       /* other names, apart by blanks; one that fixes parameters is
                                    written "asc:c=1" and takes none of its own; "" for none */
    const char *name;          /* one line for people */
    const char *source;        /* author, year, equation */
    cm_family family;          /* how it comes about */
    unsigned properties;       /* CM_EQUAL_AREA, CM_CONFORMAL */
    cm_smoothness smooth_face; /* inside a face, its corners left out */
    cm_smoothness smooth_edge; /* across the edge of two faces */
    size_t parameter_count;    /* 0 to CM_PARAMETERS_MAX */
    cm_parameter_info parameter[CM_PARAMETERS_MAX]; /* in the order of the kernels */
    cm_bounds bounds;                               /* of its errors */
    unsigned fast; /* CM_FAST_FORWARD, CM_FAST_INVERSE: where there is CM_TIER_FAST (options.h) */
    const char *presets; /* names for values of the parameters, apart by blanks, written
                            "mild:kappa=0.54,l1=0.17 ...", to be given as NAME:PRESET; a parameter that
                            one does not name has its standard value; NULL for none */
    cm_kind kind;        /* what it maps */
    const char
        *parts; /* of a layout that joins an azimuthal projection and a mapping between disc and
                          square, those it has when none are given, "lambert,shirley"; else NULL */
    cm_smoothness
        smooth_corner; /* of a cube's face at its corners, as one comes there on the face; of one
                                    face it says nothing */
} cm_mapping_info;

/* "torn", "C0", "C1", "C2", "analytic"; NULL for what is no cm_smoothness. */
CM_API const char *cm_smoothness_name(cm_smoothness smoothness);

/* The identifier of the mapping that we recommend where nothing speaks for another: nearly
 * equal-area, smooth on a face, algebraic both ways. */
#define CM_MAPPING_RECOMMENDED "coupled"

/* The number of mappings, and the mapping at an index below it (else NULL). The order is fixed
 * within a version. The tables are constant and live as long as the program. */
CM_API size_t cm_catalogue_count(void);
CM_API const cm_mapping_info *cm_catalogue_at(size_t index);

/* The mapping that an identifier or alias names (upper and lower case are the same), or NULL. */
CM_API const cm_mapping_info *cm_catalogue_find(const char *name);

/* Is this a specification that cm_mapping_create takes? The same status as that would return. If it
 * is not CM_OK, and message is not NULL, at most message_size bytes of one line without a line end
 * that says what is wrong and what would be right are written to message, always ended by a zero
 * byte if message_size > 0. */
CM_API cm_status cm_specification_check(const char *specification, char *message,
                                        size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
