/* SPDX-License-Identifier: MIT
 *
 * Speed and accuracy of every mapping in one run: nanoseconds a point of the array functions (the best
 * of interleaved repetitions over arrays that stay in cache) and the worst round trip of random and of
 * hard directions, direction to face, u, v and back. truth/certificate measures accuracy in full.
 *
 * Usage: points [FRAME [ROUND_TRIPS]]
 */
#define _POSIX_C_SOURCE 200809L

#include "truth/cube_count.h"
#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <cubemap/cubemap.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum
{
    COUNT = 8192,
    REPETITIONS = 30
};

static double x[COUNT], y[COUNT], z[COUNT], u[COUNT], v[COUNT];
static float x_f32[COUNT], y_f32[COUNT], z_f32[COUNT], u_f32[COUNT], v_f32[COUNT];
static uint8_t face[COUNT];

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void fill(uint64_t *state)
{
    for (int i = 0; i < COUNT; i++)
    {
        double direction[3];
        next_direction(state, direction);
        x_f32[i] = (float)(x[i] = direction[0]);
        y_f32[i] = (float)(y[i] = direction[1]);
        z_f32[i] = (float)(z[i] = direction[2]);
    }
}

/* best[0..3]: forward and inverse in double, then in float, ns a point */
static void time_arrays(const cm_mapping *mapping, double best[4])
{
    static double back[3][COUNT];
    static float back_f32[3][COUNT];
    for (int r = 0; r < REPETITIONS; r++)
    {
        double at[5];
        at[0] = seconds();
        cm_forward_array(mapping, COUNT, x, y, z, face, u, v);
        at[1] = seconds();
        cm_inverse_array(mapping, COUNT, face, u, v, back[0], back[1], back[2]);
        at[2] = seconds();
        cm_forward_array_f32(mapping, COUNT, x_f32, y_f32, z_f32, face, u_f32, v_f32);
        at[3] = seconds();
        cm_inverse_array_f32(mapping, COUNT, face, u_f32, v_f32, back_f32[0], back_f32[1],
                             back_f32[2]);
        at[4] = seconds();
        for (int k = 0; k < 4; k++)
        {
            best[k] = fmin(best[k], (at[k + 1] - at[k]) * 1e9 / COUNT);
        }
    }
}

static double worst_round_trip(const cm_mapping *mapping, long count)
{
    uint64_t state = 77;
    double worst = 0.0;
    for (long i = 0; i < count; i++)
    {
        double direction[3];
        double uv[2];
        double back[3];
        if (i % 2 == 0)
        {
            next_direction(&state, direction);
        }
        else
        {
            hard_direction(next_bits(&state), direction);
        }
        uint8_t on = cm_forward(mapping, direction, uv);
        cm_inverse(mapping, on, uv, back);
        worst = on < 6 ? fmax(worst, earth_metres(direction, back)) : worst;
    }
    return worst;
}

int main(int argc, char **argv)
{
    const cm_frame *frame = cm_frame_find(argc > 1 ? argv[1] : "geo");
    long count = argc > 2 ? atol(argv[2]) : 100000;
    if (argc > 3 || frame == NULL || count <= 0)
    {
        fprintf(stderr, "usage: points [FRAME [ROUND_TRIPS]]\n");
        return 2;
    }
    uint64_t state = 1;
    fill(&state);
    printf("frame %s, %d points an array, %ld round trips\n", frame->identifier, COUNT, count);
    printf("%-12s %8s %8s %8s %8s %12s\n", "ns a point:", "forward", "inverse", "float", "float",
           "round trip");
    for (size_t i = 0; i < cube_count(); i++)
    {
        cm_mapping *mapping = NULL;
        const char *name = cm_catalogue_at(i)->identifier;
        if (cm_mapping_create(name, frame, &mapping) != CM_OK)
        {
            return 1;
        }
        double best[4] = {1e9, 1e9, 1e9, 1e9};
        time_arrays(mapping, best);
        printf("%-12s %8.2f %8.2f %8.2f %8.2f %9.3f nm\n", name, best[0], best[1], best[2], best[3],
               worst_round_trip(mapping, count) * 1e9);
        cm_mapping_destroy(mapping);
    }
    return 0;
}
