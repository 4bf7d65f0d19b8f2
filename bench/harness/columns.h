/* SPDX-License-Identifier: MIT
 *
 * Points on the sphere, what forward makes of them, and what inverse makes of that; and this library's
 * functions run over them.
 */
#ifndef BENCH_HARNESS_COLUMNS_H
#define BENCH_HARNESS_COLUMNS_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/cubemap.h>

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    FORWARD,
    INVERSE,
    DIRECTIONS
};

/* Forward reads from and writes plane, face and pixel; inverse reads those and writes back. Who runs over it
 * uses the arrays that it needs. */
typedef struct batch
{
    size_t count;
    double *from[3]; /* x, y, z; or longitude and latitude */
    double *plane[2];
    double *back[3];
    float *from_f32[3];
    float *plane_f32[2];
    float *back_f32[3];
    uint8_t *face;
    int64_t *pixel;
    int *status[DIRECTIONS]; /* of peers that give one: not 0 where they refuse a point */
    void *memory;            /* of all arrays */
    size_t first[7];         /* sorted by face: points first[k] up to first[k + 1] are on face k */
} batch;

/* With room for so many points, and none of them. How arrays lie to each other, by their addresses modulo a page, makes
 * a tenth of a time: the one has them apart in one way, the other in another way each time, by next_bits of state. */
void batch_allocate(batch *b, size_t room);
void batch_scatter(batch *b, size_t room, uint64_t *state);
void batch_put(batch *b, size_t at, const double point[3]);
void batch_free(batch *b);

/* The array functions, and the others point by point; narrow: those of float. */
void run_arrays(const cm_mapping *mapping, int narrow, batch *b, int direction);
void run_points(const cm_mapping *mapping, int narrow, batch *b, int direction);

#ifdef __cplusplus
}
#endif

#endif
