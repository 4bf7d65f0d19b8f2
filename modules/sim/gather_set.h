/* SPDX-License-Identifier: MIT
 *
 * The loop over places that a virtual light shines on, once for each instruction set.
 */
#ifndef CUBEMAP_SIM_GATHER_SET_H
#define CUBEMAP_SIM_GATHER_SET_H

#include <stddef.h>
#include <stdint.h>

/* Arrays of places have room for a multiple of so many; what is behind the last is any finite numbers. */
#define GATHER_ROOM 16

/* What shines by Lambert's law. */
typedef struct gather_light
{
    float position[3];
    float normal[3];
    float strength; /* flux that it scatters, by pi */
    float most;     /* of cosines by squared distance: where the light would fill a hemisphere */
} gather_light;

/* Waves, in turns: a wave has begun[j] behind it, and per_metre[j] to come. */
typedef struct gather_waves
{
    size_t count;
    const float *per_metre;
    const float *begun;
} gather_waves;

/* Irradiance, to which is added; wave j at j stride. */
typedef struct gather_sum
{
    float *total;
    float *real;
    float *imaginary;
    size_t stride;
} gather_sum;

/* Planes of curved surfaces are met a little behind: by so much of the distance, in a small cell. */
#define PLANE_REACH 0.01f

/* What a light sees in the cells of a map around it, each (face edge + row) edge + column: planes that face it, of a normal
 * and a number, which are 0 0 0 and 1 where there is nothing. */
typedef struct gather_shadow
{
    int edge;
    const float (*plane)[4];
} gather_shadow;

typedef struct gather_set
{
    const char *name; /* first: as in options.h */
    /* height: above the planes that hide what is below them; NULL: nothing is hidden */
    void (*gather)(const gather_light *light, const gather_waves *waves, size_t n,
                   const float *const position[3], const float *const normal[3],
                   const float *height, const gather_sum *sum);
    /* From the light to n places. */
    void (*look)(const gather_light *light, size_t n, const float *const position[3],
                 float *const way[3]);
    /* Heights of n places that a mapping has at face, u and v, or nowhere; n is a multiple of GATHER_ROOM. */
    void (*see)(const gather_shadow *shadow, size_t n, const float *const position[3],
                const uint8_t *face, const float *u, const float *v, float *height);
} gather_set;

extern const gather_set cm_gather_scalar;
#ifdef CM_HAVE_SSE2
extern const gather_set cm_gather_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const gather_set cm_gather_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const gather_set cm_gather_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const gather_set cm_gather_neon;
#endif

/* The set of that name, as mappings tell theirs; the scalar one if this build has none of it. */
const gather_set *gather_set_find(const char *name);

#endif
