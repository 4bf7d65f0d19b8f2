/* SPDX-License-Identifier: MIT
 *
 * The loops over rays, once for each instruction set. Arrays have room for whole vectors: n is rounded up to a multiple of
 * TOF_ROOM, and what is there may be any numbers.
 */
#ifndef CUBEMAP_SIM_TOF_SET_H
#define CUBEMAP_SIM_TOF_SET_H

#include "tof_object.h"

#define TOF_ROOM 8
#define TOF_BLOCK 256
#define TOF_WAVES 32 /* at most, of all series */
#define TOF_PHASES 64

/* Rays of a block and what they met so far. */
typedef struct tof_block
{
    int has_apex; /* 1: all begin there, and origins are not looked at */
    double apex[3];
    double origin[3][TOF_BLOCK];
    double direction[3][TOF_BLOCK];
    double distance[TOF_BLOCK];
    double normal[3][TOF_BLOCK]; /* of length 1, towards the origin */
    double number[TOF_BLOCK];    /* of the solid: ids as doubles; -1 for nothing */
} tof_block;

/* Places that a lamp shines on. */
typedef struct tof_lit
{
    const double *position[3];
    const double *normal[3];
    const double *range;    /* of the camera */
    const double *strength; /* BRDF in each, times what is left of the light; 1/sr */
    double *total;          /* to which is added */
    double *real;           /* waves x stride */
    double *imaginary;
    size_t stride;
    int is_first; /* 1: there is nothing so far, whatever is in memory */
} tof_lit;

/* What becomes of light in the circuits of a phase image: A and B have half of all, and what is moved between them. */
typedef struct tof_charge_rule
{
    double half;    /* electrons a unit of total light */
    double ambient; /* of the surroundings' */
    double dark;
    size_t waves;
    double cosine[TOF_WAVES]; /* of the waves' shifts, with all factors */
    double sine[TOF_WAVES];
} tof_charge_rule;

/* Phase images of the same light: rules that differ in their waves' shifts alone. */
#define TOF_IMAGES 8
typedef struct tof_charge_images
{
    int count;
    const tof_charge_rule *rule[TOF_IMAGES];
    float *charge_a[TOF_IMAGES];
    float *charge_b[TOF_IMAGES];
} tof_charge_images;

/* Light of cells that lie side by side. */
typedef struct tof_cells
{
    const double *total;
    const double *ambient;
    const double *real; /* waves x stride */
    const double *imaginary;
    size_t stride;
} tof_cells;

/* Pixels of one block of phase images, to phasors. */
typedef struct tof_phasors
{
    double turns[TOF_BLOCK];    /* 0..1; NaN where no modulated light came */
    float amplitude[TOF_BLOCK]; /* electrons */
    float intensity[TOF_BLOCK];
} tof_phasors;

/* Three rows of what the middles of cells see, the middle one second; from the first cell that is asked about. */
typedef struct tof_rows
{
    const uint32_t *id[3];
    const uint64_t *shadows[3];
    const float *normal[3][3]; /* row, axis */
    const double *range[3];
} tof_rows;

/* How far neighbours may be apart that one quadratic goes through. */
typedef struct tof_smoothness
{
    float normal;
    double range; /* second differences */
} tof_smoothness;

/* Sums over a cell's samples of weight times powers of their place. */
typedef struct tof_moments
{
    double one, x, y, xx, xy, yy;
} tof_moments;

typedef struct tof_set
{
    const char *name; /* first: as in options.h */
    /* What of the block a solid is nearer to than all before. */
    void (*meet)(const tof_solid *solid, size_t n, tof_block *block);
    /* Light of a lamp of even intensity, once scattered to the camera. */
    void (*light)(const tof_lamp *lamp, const tof_waves *waves, size_t n, const tof_lit *lit);
    /* Rays of the camera's axes, of any length, to directions of length 1 in the world; cos^4 from its z. Rows of axes are the
     * camera's. What is NaN or infinite becomes the optical axis; returns 1 if any is. */
    int (*aim)(size_t n, const double (*axes)[3], const double *x, const double *y, const double *z,
               double (*direction)[TOF_BLOCK], double *lens);
    /* Where rays of one origin end, and how far that is: at 1 where nothing is. */
    void (*reach)(size_t n, const tof_block *block, double (*position)[TOF_BLOCK], double *leg);
    /* The least cosine of directions to an axis, and 1. */
    double (*least_cosine)(size_t n, const tof_block *block, const double axis[3]);
    /* Adds weight times what the lens lets pass of values. No room is needed. */
    void (*add)(size_t n, const double *weight, const double *lens, const double *value,
                double *sum);
    /* Charges of n cells that are pixels, in all of some images from the pixel first on. No room is needed: what is written are n
     * floats each. Returns 0 only if floats hold all. */
    int (*charge)(const tof_charge_images *images, size_t n, const tof_cells *cells, size_t first);
    /* The same before it comes into circuits: half of all, and what is moved; n numbers each. */
    void (*split)(const tof_charge_rule *rule, size_t n, const tof_cells *cells, double *half,
                  double *moved);
    /* n pixels, TOF_BLOCK at the most, of phase images that are stride apart. Returns 0 only if modulated light
     * came to all. */
    int (*phasors)(int phases, const double *cosine, const double *sine, size_t n, size_t stride,
                   const float *charge_a, const float *charge_b, tof_phasors *to);
    /* 1 for each of n cells that sees one smooth surface, or nothing, with its eight neighbours. Rows can be read from one cell
     * before to one behind. */
    void (*smooth)(size_t n, const tof_rows *rows, const tof_smoothness *than, uint8_t *is_smooth);
    /* Adds part times the mean of the quadratic through nine values where is_smooth says so: moments of even and odd cells,
     * the first one even or odd. */
    void (*add_means)(size_t n, const double *const row[3], const tof_moments moments[2],
                      int first_is_odd, double part, const uint8_t *is_smooth, double *sum);
} tof_set;

extern const tof_set cm_tof_scalar;
#ifdef CM_HAVE_SSE2
extern const tof_set cm_tof_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const tof_set cm_tof_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const tof_set cm_tof_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const tof_set cm_tof_neon;
#endif

/* The set that libcubemap takes, too; the scalar one if this build has none of that name. Fails as cm_mapping_create does. */
cm_status tof_set_choose(const tof_set **set);

#endif
