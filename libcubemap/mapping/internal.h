/* SPDX-License-Identifier: MIT
 *
 * What the files of the library share and its users do not see.
 */
#ifndef LIBCUBEMAP_INTERNAL_H
#define LIBCUBEMAP_INTERNAL_H

#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>
#include <cubemap/options.h>

/* How a frame differs from geo. A point (a, b) of a face of geo is on the face of that number in the
 * frame, at u = sign_u * (swap ? b : a), v = sign_v * (swap ? a : b). */
typedef struct cm_turn
{
    int identity; /* nothing changes at all */
    /* As tables that a vector of faces looks up: bit 63 - i for face i, and octal digit i. The first
     * four by face of geo, the others by face of the frame. */
    uint64_t swap_bits;
    uint64_t minus_u_bits;
    uint64_t minus_v_bits;
    uint64_t face_digits; /* of the frame */
    uint64_t swap_back_bits;
    uint64_t minus_u_back_bits;
    uint64_t minus_v_back_bits;
    uint64_t geo_face_digits;
} cm_turn;

/* The loops of one mapping in one precision (mapping_loops.inc), over whole vectors: n is a multiple of the set's
 * lanes. The arguments are those of the public functions; warp and unwarp work in place, and are NULL if
 * the mapping has none. */
typedef struct cm_batch_f64
{
    void (*forward)(const cm_mapping *mapping, size_t n, const double *x, const double *y,
                    const double *z, uint8_t *face, double *u, double *v);
    void (*inverse)(const cm_mapping *mapping, size_t n, const uint8_t *face, const double *u,
                    const double *v, double *x, double *y, double *z);
    void (*forward_jacobian)(const cm_mapping *mapping, size_t n, const double *x, const double *y,
                             const double *z, double *const jacobian[6]);
    void (*inverse_jacobian)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                             const double *u, const double *v, double *const jacobian[6]);
    void (*warp)(const cm_mapping *mapping, size_t n, double *p, double *q);
    void (*unwarp)(const cm_mapping *mapping, size_t n, double *u, double *v);
    void (*warp_jacobian)(const cm_mapping *mapping, size_t n, const double *p, const double *q,
                          double *const jacobian[4]);
} cm_batch_f64;

typedef struct cm_batch_f32
{
    void (*forward)(const cm_mapping *mapping, size_t n, const float *x, const float *y,
                    const float *z, uint8_t *face, float *u, float *v);
    void (*inverse)(const cm_mapping *mapping, size_t n, const uint8_t *face, const float *u,
                    const float *v, float *x, float *y, float *z);
    void (*forward_jacobian)(const cm_mapping *mapping, size_t n, const float *x, const float *y,
                             const float *z, float *const jacobian[6]);
    void (*inverse_jacobian)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                             const float *u, const float *v, float *const jacobian[6]);
    void (*warp)(const cm_mapping *mapping, size_t n, float *p, float *q);
    void (*unwarp)(const cm_mapping *mapping, size_t n, float *u, float *v);
    void (*warp_jacobian)(const cm_mapping *mapping, size_t n, const float *p, const float *q,
                          float *const jacobian[4]);
} cm_batch_f32;

/* By variant; a mapping that has only one leaves the other empty. */
typedef struct cm_batch_variants_f64
{
    cm_batch_f64 variant[2];
} cm_batch_variants_f64;

typedef struct cm_batch_variants_f32
{
    cm_batch_f32 variant[2];
} cm_batch_variants_f32;

#define CM_DISC_COLUMNS 5

/* The loops of parts (part_loops.inc), over whole vectors. A point of a disc is CM_DISC_COLUMNS numbers: those of
 * cm_disc_point, and 1, or -1 for the hemisphere of the antipode. Bad points are NaN. */
typedef struct cm_azimuthal_loops_f64
{
    void (*forward)(const cm_mapping *mapping, size_t n, const double *x, const double *y,
                    const double *z, double *const disc[CM_DISC_COLUMNS]);
    void (*inverse)(const cm_mapping *mapping, size_t n, double *const disc[CM_DISC_COLUMNS],
                    double *x, double *y, double *z);
    void (*gradients)(const cm_mapping *mapping, size_t n, const double *x, const double *y,
                      const double *z, double *const to[6]);
    void (*tangents)(const cm_mapping *mapping, size_t n, double *const disc[CM_DISC_COLUMNS],
                     double *const to[6]);
} cm_azimuthal_loops_f64;

typedef struct cm_square_loops_f64
{
    void (*forward)(size_t n, double *const disc[CM_DISC_COLUMNS], double *a, double *b);
    void (*inverse)(size_t n, const double *a, const double *b,
                    double *const disc[CM_DISC_COLUMNS]);
    void (*jacobian)(size_t n, double *const disc[CM_DISC_COLUMNS], const double *a,
                     const double *b, double *const to[4]);
} cm_square_loops_f64;

/* The first two by index in the catalogue. */
typedef struct cm_chart_loops_f64
{
    const cm_azimuthal_loops_f64 *azimuthal;
    const cm_square_loops_f64 *square;
    void (*disc_in)(size_t n, const double *u, const double *v,
                    double *const disc[CM_DISC_COLUMNS]);
    void (*square_in)(const cm_mapping *mapping, size_t n, const double *u, const double *v,
                      double *a, double *b, double *side);
    void (*square_out)(const cm_mapping *mapping, size_t n, const double *side, double *a,
                       double *b);
    void (*face_in)(size_t n, const uint8_t *face, const double *u, const double *v, double *to_u,
                    double *to_v);
    void (*face_out)(size_t n, const double *u, const double *v, uint8_t *face, double *to_u,
                     double *to_v);
    void (*gradients_out)(const cm_mapping *mapping, size_t n, const double *side, const double *a,
                          const double *b, double *const by_disc[4], double *const to[6]);
    void (*tangents_out)(const cm_mapping *mapping, size_t n, const double *side, const double *a,
                         const double *b, double *const by_disc[4], double *const to[6]);
    void (*keep)(size_t n, const double *where, double *const to[6]);
} cm_chart_loops_f64;

typedef struct cm_azimuthal_loops_f32
{
    void (*forward)(const cm_mapping *mapping, size_t n, const float *x, const float *y,
                    const float *z, float *const disc[CM_DISC_COLUMNS]);
    void (*inverse)(const cm_mapping *mapping, size_t n, float *const disc[CM_DISC_COLUMNS],
                    float *x, float *y, float *z);
    void (*gradients)(const cm_mapping *mapping, size_t n, const float *x, const float *y,
                      const float *z, float *const to[6]);
    void (*tangents)(const cm_mapping *mapping, size_t n, float *const disc[CM_DISC_COLUMNS],
                     float *const to[6]);
} cm_azimuthal_loops_f32;

typedef struct cm_square_loops_f32
{
    void (*forward)(size_t n, float *const disc[CM_DISC_COLUMNS], float *a, float *b);
    void (*inverse)(size_t n, const float *a, const float *b, float *const disc[CM_DISC_COLUMNS]);
    void (*jacobian)(size_t n, float *const disc[CM_DISC_COLUMNS], const float *a, const float *b,
                     float *const to[4]);
} cm_square_loops_f32;

typedef struct cm_chart_loops_f32
{
    const cm_azimuthal_loops_f32 *azimuthal;
    const cm_square_loops_f32 *square;
    void (*disc_in)(size_t n, const float *u, const float *v, float *const disc[CM_DISC_COLUMNS]);
    void (*square_in)(const cm_mapping *mapping, size_t n, const float *u, const float *v, float *a,
                      float *b, float *side);
    void (*square_out)(const cm_mapping *mapping, size_t n, const float *side, float *a, float *b);
    void (*face_in)(size_t n, const uint8_t *face, const float *u, const float *v, float *to_u,
                    float *to_v);
    void (*face_out)(size_t n, const float *u, const float *v, uint8_t *face, float *to_u,
                     float *to_v);
    void (*gradients_out)(const cm_mapping *mapping, size_t n, const float *side, const float *a,
                          const float *b, float *const by_disc[4], float *const to[6]);
    void (*tangents_out)(const cm_mapping *mapping, size_t n, const float *side, const float *a,
                         const float *b, float *const by_disc[4], float *const to[6]);
    void (*keep)(size_t n, const float *where, float *const to[6]);
} cm_chart_loops_f32;

/* What runs them in a row (parts.inc), by kind. */
extern const cm_batch_f64 cm_chart_batches_f64[];
extern const cm_batch_f32 cm_chart_batches_f32[];

/* Longitudes and latitudes (lonlat_loops.inc), in double. */
typedef struct cm_lonlat_loops
{
    void (*directions)(size_t n, const double *lon, const double *lat, double *x, double *y,
                       double *z);
    void (*lonlats)(size_t n, const double *x, const double *y, const double *z, double *lon,
                    double *lat);
} cm_lonlat_loops;

/* Longitudes up to here are reduced by vectors, those beyond by the C library. */
#define CM_LONLAT_WHOLE 1.0e6
/* How the loops of latitude_loops.inc convert: by series of so many terms at most, or by a ratio of tangents that is
 * near 1 or is not. */
typedef enum cm_latitude_way
{
    CM_LATITUDE_SERIES_3,
    CM_LATITUDE_SERIES_6,
    CM_LATITUDE_SERIES_12,
    CM_LATITUDE_TANGENT_NEAR,
    CM_LATITUDE_TANGENT_FAR,
    CM_LATITUDE_WAYS
} cm_latitude_way;

/* The loops over whole vectors; angles and directions that are none become NaN. By way. */
typedef struct cm_latitude_loops
{
    void (*angles[CM_LATITUDE_WAYS])(const cm_latitude_constants_f64 *constants, size_t n,
                                     const double *from, double *to);
    void (*directions[CM_LATITUDE_WAYS])(const cm_latitude_constants_f64 *constants, size_t n,
                                         const double *x, const double *y, const double *z,
                                         double *to_x, double *to_y, double *to_z);
} cm_latitude_loops;

/* what distortion.h has for a point */
#define CM_DISTORTION_COLUMNS 9

/* The loops of cells (cell_loops.inc), over whole vectors: from faces, u and v to the cells of a level, and from
 * cells, which must be valid, to the middles of theirs. A face above 5 gives CM_NO_CELL. */
typedef struct cm_cell_loops
{
    void (*forward)(cm_curve curve, int level, size_t n, const uint8_t *face, const double *u,
                    const double *v, cm_cell *cell);
    void (*centre)(cm_curve curve, size_t n, const cm_cell *cell, uint8_t *face, double *u,
                   double *v);
} cm_cell_loops;

struct cm_orient_points; /* orient_task.h */
struct cm_orient_table;

/* All loops for one instruction set; tables by index in the catalogue. */
typedef struct cm_batch_set
{
    const char *name;
    size_t lanes_f64; /* powers of two, CM_LANES_MAX at most */
    size_t lanes_f32;
    /* n numbers, no more than the lanes, to a vector, with zeros for what is missing; one number to all
     * lanes. By one store, because the reading of a vector from several would wait for them all, and one
     * call for the other. */
    void (*rest_f64)(double *to, const double *from, size_t n);
    void (*rest_f32)(float *to, const float *from, size_t n);
    /* The nine columns of distortion.h from the six of forward Jacobians, or with of_tangents of inverse
     * ones; n is a multiple of the lanes. */
    void (*indicatrices_f64)(int of_tangents, size_t n, double *const jacobian[6],
                             double *const to[CM_DISTORTION_COLUMNS]);
    void (*indicatrices_f32)(int of_tangents, size_t n, float *const jacobian[6],
                             float *const to[CM_DISTORTION_COLUMNS]);
    const cm_batch_variants_f64 *f64;
    const cm_batch_variants_f32 *f32;
    /* forward and inverse of double arrays in lanes_f32, computed in float; NULL where that gains nothing */
    const cm_batch_variants_f64 *fast;
    const cm_chart_loops_f64 *charts_f64;
    const cm_chart_loops_f32 *charts_f32;
    const cm_lonlat_loops *lonlat;
    const cm_latitude_loops *latitudes;
    const struct cm_healpix_loops *healpix; /* healpix.h */
    const cm_cell_loops *cells;
    /* over points of what the table says, and unless that is NULL the torque (orient_bound.c) */
    double (*orient_sum)(const struct cm_orient_points *points, const struct cm_orient_table *table,
                         const float turn[9], double torque[3]);
} cm_batch_set;

#define CM_LANES_MAX 16

/* Points that are gathered at once from arrays with a stride; a multiple of CM_LANES_MAX. */
#define CM_BLOCK 256

extern const cm_batch_set cm_batch_scalar;
extern const cm_batch_set cm_batch_sse2;
extern const cm_batch_set cm_batch_avx2;
extern const cm_batch_set cm_batch_avx512;
extern const cm_batch_set cm_batch_neon;

struct cm_mapping
{
    const cm_mapping_info *info;
    size_t index; /* in the catalogue */
    double parameter[CM_PARAMETERS_MAX];
    size_t azimuthal; /* in the catalogue: the parts of a map that is made of parts */
    size_t square;
    double area_scale; /* 6 / pi over the area of the map per area of what it shows of the sphere */
    int is_folded;     /* both hemispheres go to the disc */
    int is_turned;     /* the centre is not the north pole in longitude 0 */
    double axes_f64
        [9]; /* then the axes about the centre, by rows: south, east and outwards at a north pole */
    float axes_f32[9];
    cm_frame frame;
    cm_turn turn;
    cm_constants_f64 constants_f64;
    cm_constants_f32 constants_f32;
    cm_tier tier;
    const cm_batch_set *set;
    cm_batch_f64 batch_f64;
    cm_batch_f32 batch_f32;
    size_t lanes_f64; /* what batch_f64 takes whole multiples of */
    size_t lanes_f32;
};

struct cm_grid
{
    cm_mapping *mapping;
    cm_ellipsoid ellipsoid;
    cm_latitude latitude;
    cm_latitude_conversion *there; /* from geographic; NULL where nothing changes */
    cm_latitude_conversion *back;
    cm_rotation rotation;
    int is_rotated;
};

/* Is it computed by part_loops.inc? */
static inline int cm_mapping_has_parts(const cm_mapping *mapping)
{
    return mapping->info->kind == CM_KIND_DISC_SQUARE || mapping->info->kind == CM_KIND_AZIMUTHAL ||
           mapping->info->parts != NULL;
}

/* The set of that name (NULL: what the environment says, else the best) if this machine can run it,
 * else NULL. */
const cm_batch_set *cm_batch_set_find(const char *name);

/* frame must have passed cm_frame_check. */
void cm_turn_from_frame(const cm_frame *frame, cm_turn *turn);

/* The mapping that a name stands for, NULL if there is none; *fixed is what an alias says after its colon,
 * else "". */
const cm_mapping_info *cm_catalogue_find_word(const char *name, size_t length, const char **fixed);

size_t cm_catalogue_index(const cm_mapping_info *info);

/* The length of the name in an alias of the catalogue, a word of whole characters: "asc:c=1" and
 * "peirce:stereographic,conformal" fix what is behind the last colon, "square:concentric" fixes nothing. */
size_t cm_alias_length(const char *word, size_t whole);

/* Does the layout put one hemisphere on the disc, and the other one on the same disc? */
int cm_is_folded(const cm_mapping_info *info);

/* Of any finite angle in degrees, which is reduced exactly, so that multiples of 90 give 0 and 1; else to
 * 2 eps. */
void cm_sine_cosine_degrees(double degrees, double *sine, double *cosine);

/* n <= CM_BLOCK longitudes and latitudes to directions of length 1 (NaN for what is none), in arrays that have
 * room for whole vectors; and back from such arrays, whose rest is overwritten. Results may overwrite
 * arguments. */
void cm_block_of_lonlats(const cm_batch_set *set, size_t n, const double *lon, const double *lat,
                         double *x, double *y, double *z);
void cm_block_to_lonlats(const cm_batch_set *set, size_t n, double *x, double *y, double *z,
                         double *lon, double *lat);

/* Equality of two ASCII words of given lengths, without upper and lower case. */
int cm_word_equal(const char *a, size_t a_length, const char *b, size_t b_length);

/* One ellipsoid, for the closed forms (latitude_exact.c). */
typedef struct cm_latitude_shape
{
    double axes;                     /* b / a = 1 - f */
    double ratio;                    /* a / b */
    double m;                        /* (a / b)^2 - 1: above 0 for oblate ones */
    double root_m;                   /* sqrt |m| */
    double e;                        /* sqrt |e^2|, e^2 = f (2 - f) */
    double e_rest;                   /* what e lacks */
    double zone;                     /* from the equator to the pole, for the authalic latitude */
    double quadrant;                 /* of the meridian over b, for the rectifying one */
    double least[CM_LATITUDE_COUNT]; /* of tan(latitude) / tan(parametric latitude) */
    double greatest[CM_LATITUDE_COUNT];
} cm_latitude_shape;

/* f is not 0. */
void cm_latitude_shape_make(double f, cm_latitude_shape *shape);

/* tan(to) / tan(from) where tan(from) = sine / cosine, both not below 0 and not both 0; relatively accurate. */
double cm_latitude_ratio(const cm_latitude_shape *shape, cm_latitude from, cm_latitude to,
                         double sine, double cosine);

/* A specification that has been read. */
typedef struct cm_specification
{
    size_t index; /* in the catalogue */
    double parameter[CM_PARAMETERS_MAX];
    size_t azimuthal; /* of a layout's parts, and of an azimuthal projection its own */
    size_t square;    /* the same of the mapping between disc and square */
} cm_specification;

/* Parse and check; on CM_OK *made is set, on failure message (if any) says why. */
cm_status cm_specification_parse(const char *specification, cm_specification *made, char *message,
                                 size_t message_size);

/* Writes a message, unless it is NULL or size is 0: one line of text, whatever the arguments are, cut to
 * size bytes with a zero byte at its end. Returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
cm_status
cm_fail(cm_status status, char *message, size_t size, const char *format, ...);

#endif
