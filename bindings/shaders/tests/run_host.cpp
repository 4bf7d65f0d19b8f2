/* SPDX-License-Identifier: MIT
 *
 * The texts for CUDA or Metal as C++ of the host (host.h); which, says the file that is linked with it.
 */
#include "host.h"

extern "C" {
#include "judge.h"
}

#include <cstdio>

extern const host_function host_programs[];

namespace
{
const float *all_points;
size_t point_count;
} // namespace

const char *device_name(int device)
{
    return device == 0 ? HOST_NAME : nullptr;
}

int device_has_all_floats(int)
{
    return 1;
}

int device_open(int, size_t count, const float *points)
{
    all_points = points;
    point_count = count;
    return 1;
}

int device_run(int, const char *, int program, float *results)
{
    for (size_t i = 0; i < point_count; i++)
    {
        host_programs[program](all_points + POINT_FLOATS * i, results + RESULT_FLOATS * i);
    }
    return 1;
}

void device_close(int)
{
}
