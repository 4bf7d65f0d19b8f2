/* SPDX-License-Identifier: MIT
 *
 * Advice: which mappings keep given limits, the cheapest first, and what the others miss; and how much is needed: how
 * large a face, which precision, how many terms of a latitude's series. No more than needed.
 *
 * The library knows what mappings are (statistics.h, catalogue.h). What they cost is the machine's: the caller brings a
 * table of times, each row of which, a mapping in a precision, becomes a candidate. `cubemap-bench advise` measures them.
 *
 *   limits      are kept up to and including them. What is exactly 0 or 1 comes out with rounding: a candidate may be
 *               above a limit on distortion by CM_ADVICE_ROUNDING, and by no more
 *   distortion  maxima are over the whole sphere, means and RMSE over the face; what their quadrature is in doubt about
 *               counts against the mapping
 *   errors      of a round trip on Earth, metres: what the catalogue promises. With float numbers that is besides the
 *               rounding of the caller's own points
 *   ellipsoid   points are geographic: their latitude becomes the conformal one for conformal mappings, the authalic one
 *               for all others, as in grid.h; values of distortion and error are upper bounds then. Grids are in double
 *               or by the fast tier: with an ellipsoid float misses CM_LIMIT_PRECISION
 *   threads     an advice is constant after its creation: any number of threads may use one
 */
#ifndef CUBEMAP_ADVISE_H
#define CUBEMAP_ADVISE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/catalogue.h>
#include <cubemap/ellipsoid.h>
#include <cubemap/export.h>
#include <cubemap/latitude.h>
#include <cubemap/mapping.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a mapping is computed: by the functions for double or for float, or by those for double with CM_TIER_FAST
 * (options.h). */
typedef enum cm_precision
{
    CM_PRECISION_DOUBLE = 0, /* the functions for double */
    CM_PRECISION_FLOAT = 1,  /* those for float */
    CM_PRECISION_FAST = 2    /* double, by the tier fast */
} cm_precision;

/* How many precisions there are. */
#define CM_PRECISION_COUNT 3

/* "double", "float", "fast"; NULL for what is none. */
CM_API const char *cm_precision_name(cm_precision precision);

/* What can be limited: numbers first. */
typedef enum cm_limit
{
    CM_LIMIT_AREA = 0,             /* greatest |D_A - 1| */
    CM_LIMIT_AREA_RMSE = 1,        /* root mean square of D_A - 1 */
    CM_LIMIT_ISOTROPY = 2,         /* greatest D_I = a / b */
    CM_LIMIT_ISOTROPY_MEAN = 3,    /* mean D_I */
    CM_LIMIT_ISOTROPY_RMSE = 4,    /* root mean square of D_I - 1 */
    CM_LIMIT_DEFORMATION = 5,      /* greatest angular deformation, radians */
    CM_LIMIT_DEFORMATION_MEAN = 6, /* its mean */
    CM_LIMIT_DEFORMATION_RMSE = 7, /* its root mean square */
    CM_LIMIT_COST = 8,             /* ns a point, of the slower direction asked for */
    CM_LIMIT_ERROR = 9, /* bound of a round trip, metres; a candidate's is NaN without a promise */
    CM_LIMIT_EQUAL_AREA = 10, /* here and below no numbers */
    CM_LIMIT_SMOOTH = 11,     /* inside faces */
    CM_LIMIT_EDGE = 12,       /* across edges */
    CM_LIMIT_PRECISION = 13   /* which precisions may be */
} cm_limit;

/* The limits that are numbers. */
#define CM_LIMIT_NUMBERS 10

/* All limits. */
#define CM_LIMIT_COUNT 14

/* "area error", "isotropy", ...; NULL for what is none. */
CM_API const char *cm_limit_name(cm_limit limit);

/* What rounding may add to a distortion. It is more than it was ever found to: 1e-14 at most. */
#define CM_ADVICE_ROUNDING 1e-12

/* A candidate is near if it misses one limit, and that by this part of it at most. */
#define CM_ADVICE_NEAR 0.25

/* Directions, as bits. */
#define CM_ADVICE_FORWARD 1u
#define CM_ADVICE_INVERSE 2u

/* To be filled with zeros but for size, which is sizeof(cm_advice_request), and for what is wanted. */
typedef struct cm_advice_request
{
    size_t size;                    /* sizeof(cm_advice_request) */
    unsigned limited;               /* bit k (1u << k): limit[k] holds */
    double limit[CM_LIMIT_NUMBERS]; /* at least 0, those of D_I and its mean 1; infinite for none */
    int equal_area;                 /* only exactly equal-area mappings */
    cm_smoothness
        smooth;         /* at least so smooth inside faces; from C0 on no edge may be torn either */
    cm_smoothness edge; /* at least so smooth across edges. If nothing is said of edges, torn ones
                             qualify, behind all others */
    unsigned
        precisions; /* bits 1u << cm_precision; 0: double, and with a limit of the error each that keeps it */
    unsigned directions;           /* CM_ADVICE_FORWARD, CM_ADVICE_INVERSE; 0: both */
    int single;                    /* costs are those of calls for one point each, not of arrays */
    const cm_ellipsoid *ellipsoid; /* NULL: directions, or longitudes and latitudes of a sphere */
} cm_advice_request;

/* One way to compute a mapping: a point's time in nanoseconds, forward and inverse, in arrays and alone; NaN where it
 * is not known. */
typedef struct cm_advice_cost
{
    const char *specification; /* of a mapping to six faces */
    cm_precision precision;    /* how it is computed */
    double ns[2];              /* in arrays: forward, inverse */
    double single_ns[2];       /* alone: forward, inverse */
} cm_advice_cost;

/* size must be sizeof(cm_advice_costs). */
typedef struct cm_advice_costs
{
    size_t size;                /* sizeof(cm_advice_costs) */
    size_t count;               /* of rows */
    const cm_advice_cost *cost; /* the rows */
    double
        latitude_ns[2]; /* with an ellipsoid added to each: from geographic longitude and latitude
                                to directions of the sphere that is mapped, and back */
    double latitude_single_ns[2]; /* the same of single points */
} cm_advice_costs;

/* Read through pointers that the library gives out; it may grow at its end. */
typedef struct cm_advice_candidate
{
    const char *specification;   /* that of the row */
    const cm_mapping_info *info; /* with the smoothness inside faces and across edges */
    cm_precision precision;      /* that of the row */
    cm_latitude latitude;        /* that the mapping is given; geographic without an ellipsoid */
    double
        value[CM_LIMIT_NUMBERS]; /* of each limit that is a number, whether it is limited or not */
    unsigned missed;             /* bit k: limit k is not kept. 0: the candidate qualifies */
    double
        excess; /* the greatest part by which it is above a limit, of the limit; infinite above 0 */
    int is_near; /* it misses one limit by little (CM_ADVICE_NEAR; exactly equal areas by 1 % at most;
                      smoothness by a step; precision at all if it is cheaper than the first that qualifies, or
                      none does), and is cheaper than that, smoother or less distorted in something */
    size_t index; /* of its row in the table of costs */
} cm_advice_candidate;

/* A ranked list of candidates, from cm_advise to cm_advice_destroy. */
typedef struct cm_advice cm_advice;

/* Makes *advice, to be destroyed; nothing of the arguments is kept. First those that qualify, by cost; torn ones behind
 * the others if nothing is said of edges. Then those that do not, the nearest first: by how many limits they miss,
 * by excess, by cost. An unknown cost is the greatest, and above every limit.
 * Errors, *advice being untouched: CM_ERROR_ARGUMENT if a pointer is NULL, a size or an enumerator is none, a bit
 * is not described above, a limit is NaN or below what is possible, a time is negative; those of cm_mapping_create;
 * CM_ERROR_UNSUPPORTED for a mapping that has not six faces; CM_ERROR_ELLIPSOID; CM_ERROR_MEMORY. */
CM_API cm_status cm_advise(const cm_advice_request *request, const cm_advice_costs *costs,
                           cm_advice **advice);

/* NULL is allowed. */
CM_API void cm_advice_destroy(cm_advice *advice);

/* All candidates, as many as rows; those that qualify are the first so many. at is NULL behind the last. What it gives
 * lives as long as the advice. */
CM_API size_t cm_advice_count(const cm_advice *advice);
CM_API size_t cm_advice_qualified(const cm_advice *advice);
CM_API const cm_advice_candidate *cm_advice_at(const cm_advice *advice, size_t index);

/* Room for every reason. */
#define CM_ADVICE_TEXT 1024

/* What the candidate of an index misses, each limit with by how much, "area error 0.21, 0.01 more than 0.2; torn across
 * edges"; "" if it qualifies or is none. Angles are in degrees. At most size bytes, ended by a zero byte if size > 0. */
CM_API void cm_advice_reason(const cm_advice *advice, size_t index, char *text, size_t size);

/* How large a face is to be. size must be sizeof(cm_advice_size) before the call. */
typedef struct cm_advice_size
{
    size_t size;      /* sizeof(cm_advice_size) */
    uint64_t pixels;  /* along an edge: the fewest with which no pixel is coarser than asked */
    double coarsest;  /* with these: the greatest length of a pixel on the sphere, radians */
    uint64_t power;   /* the least power of two that is enough */
    uint64_t cheaper; /* half of that, 0 for none; then */
    double cheaper_coarsest; /* its coarsest pixel, radians */
    double cheaper_share;    /* and the part of the sphere on which it is coarser than asked */
    uint64_t mean_pixels;    /* the fewest with which a pixel has that angle squared on average */
} cm_advice_size;

/* For an angle a pixel, radians, above 1e-15 and up to pi; an equirectangular source of width W has 2 pi / W. A pixel
 * is a square of 2 / pixels of u and v, and as coarse as the greatest length on the sphere that so long a line in any
 * direction can stand for: its length over the least minor axis of Tissot's indicatrix (distortion.h), which is found
 * by search from a grid of 65 x 65 points on each face.
 * Errors, *size being untouched: CM_ERROR_ARGUMENT (NULL, size, angle); CM_ERROR_UNSUPPORTED for what has not six faces,
 * or stands still somewhere (smoothstep:c=1), so that no size is enough. */
CM_API cm_status cm_advise_size(const cm_mapping *mapping, double angle, cm_advice_size *size);

/* Which precision is enough. size must be sizeof(cm_advice_precision) before the call. */
typedef struct cm_advice_precision
{
    size_t size;            /* sizeof(cm_advice_precision) */
    cm_precision precision; /* float if that is enough, else double */
    double error;           /* its bound of a round trip on Earth, metres */
    double cheaper_error;   /* that of float where double is needed; else 0 */
} cm_advice_precision;

/* For an error on Earth in metres, above 0; infinite for any.
 * Errors, *precision being untouched: CM_ERROR_ARGUMENT; CM_ERROR_RANGE if double is not enough;
 * CM_ERROR_UNSUPPORTED if there is no promise for the mapping (cm_mapping_has_bounds; none of its round trip). */
CM_API cm_status cm_advise_precision(const cm_mapping *mapping, double metres,
                                     cm_advice_precision *precision);

/* How many terms a latitude takes. size must be sizeof(cm_advice_terms) before the call. */
typedef struct cm_advice_terms
{
    size_t size;       /* sizeof(cm_advice_terms) */
    double tolerance;  /* radians: what cm_latitude_options and cm_grid_options are to be given */
    int terms;         /* 0 where there is no series: closed forms, and ratios of tangents */
    double error;      /* what is cut off, metres, a bound; 0 for closed forms */
    int cheaper_terms; /* one less; 0 for none */
    double cheaper_error; /* what is cut off then, metres */
} cm_advice_terms;

/* From one latitude to another for an error along the meridian in metres, not below 0, which is full double.
 * Errors, *terms being untouched: those of cm_latitude_conversion_create. */
CM_API cm_status cm_advise_terms(const cm_ellipsoid *ellipsoid, cm_latitude from, cm_latitude to,
                                 double metres, cm_advice_terms *terms);

#ifdef __cplusplus
}
#endif

#endif
