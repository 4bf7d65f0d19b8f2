/* SPDX-License-Identifier: MIT
 *
 * What a browser has computed, which browser.mjs writes to the standard input: for WebGL 2 and then for WebGPU the results
 * of every program in their order. The points it finds in FOLDER/points, which is there when "points" is said on stderr.
 */
#include "judge.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const names[] = {"WebGL 2, GLSL ES 3.00", "WebGPU, WGSL by naga"};
static size_t point_count;

const char *device_name(int device)
{
    return device < 2 ? names[device] : NULL;
}

int device_has_all_floats(int device)
{
    (void)device;
    return 0;
}

int device_open(int device, size_t count, const float *points)
{
    const char *path = getenv("CUBEMAP_POINTS");
    point_count = count;
    if (device > 0)
    {
        return 1;
    }
    FILE *file = path == NULL ? NULL : fopen(path, "wb");
    if (file == NULL)
    {
        fprintf(stderr, "browser.mjs is to run this\n");
        return 0;
    }
    int is_good = fwrite(points, POINT_FLOATS * sizeof *points, count, file) == count;
    is_good = fclose(file) == 0 && is_good;
    fprintf(stderr, "points\n");
    return is_good;
}

int device_run(int device, const char *folder, int program, float *results)
{
    (void)device;
    (void)folder;
    (void)program;
    return fread(results, RESULT_FLOATS * sizeof *results, point_count, stdin) == point_count;
}

void device_close(int device)
{
    (void)device;
}
