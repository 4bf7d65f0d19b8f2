/* SPDX-License-Identifier: MIT
 *
 * The shaders' backend against the float backend, at all hard points and at random ones: the same
 * numbers, and so the same face of a tie. Only the sign of a zero may differ, which GLSL does not
 * promise to keep.
 */
#include "truth/hard_points.h"
#include "shader_kernels.h"
#include "truth/sphere.h"

#include <cmath>
#include <cstdio>

#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#define KERNEL(name) name##_f32
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...) KERNEL_TABLE_SPHERE(id)
#define CM_WARP(id, ...) KERNEL_TABLE_WARP(id)
#define CM_AZIMUTHAL(id, ...) KERNEL_TABLE_AZIMUTHAL(id)
#define CM_SQUARE(id, ...) KERNEL_TABLE_SQUARE(id)
#define CM_LAYOUT(id, ...) KERNEL_TABLE_LAYOUT(id)

static const kernel_row float_table[] = {
#include <cubemap/kernel/kernel_catalogue.h>
    KERNEL_TABLE_CUBE{nullptr, nullptr, nullptr, nullptr, nullptr}};

static long compared;
static long different;

static void same(const char *name, const char *direction, const kernel_result &a,
                 const kernel_result &b, const float *in)
{
    compared++;
    bool equal = true;
    for (int k = 0; k < 3; k++)
    {
        equal = equal && a.value[k] == b.value[k];
    }
    if (!equal && different++ < 20)
    {
        std::printf("%s %s of %.9g %.9g %.9g: float %.9g %.9g %.9g, shader %.9g %.9g %.9g\n", name,
                    direction, static_cast<double>(in[0]), static_cast<double>(in[1]),
                    static_cast<double>(in[2]), static_cast<double>(a.value[0]),
                    static_cast<double>(a.value[1]), static_cast<double>(a.value[2]),
                    static_cast<double>(b.value[0]), static_cast<double>(b.value[1]),
                    static_cast<double>(b.value[2]));
    }
}

/* GLSL does not keep the sign of zero, which on the border of an octahedral square is another place for the
 * same point: all zeros are positive here. */
static void compare_direction(const float given[3])
{
    const float in[3] = {given[0] + 0.0f, given[1] + 0.0f, given[2] + 0.0f};
    for (int i = 0; float_table[i].name != nullptr; i++)
    {
        const kernel_row &a = float_table[i];
        const kernel_row &b = shader_table[i];
        if (a.project != nullptr)
        {
            kernel_result point = a.project(in[0], in[1], in[2]);
            same(a.name, "project", point, b.project(in[0], in[1], in[2]), in);
            same(a.name, "unproject", a.unproject(point.value[0], point.value[1], point.value[2]),
                 b.unproject(point.value[0], point.value[1], point.value[2]), point.value);
        }
    }
}

static void compare_point(float a, float b)
{
    for (int i = 0; float_table[i].name != nullptr; i++)
    {
        const kernel_row &row = float_table[i];
        const cm_mapping_info *info = cm_catalogue_at(static_cast<size_t>(i));
        if (row.forward == nullptr || info == nullptr)
        {
            continue;
        }
        /* the standard ones, and the highest of the first for the other variant */
        float parameters[CM_PARAMETERS_MAX];
        for (int k = 0; k < CM_PARAMETERS_MAX; k++)
        {
            parameters[k] = static_cast<float>(info->parameter[k].standard);
        }
        for (int turn = 0; turn < 2; turn++)
        {
            const float in[3] = {a, b, parameters[0]};
            same(row.name, "forward", row.forward(a, b, parameters),
                 shader_table[i].forward(a, b, parameters), in);
            same(row.name, "inverse", row.inverse(a, b, parameters),
                 shader_table[i].inverse(a, b, parameters), in);
            parameters[0] = static_cast<float>(info->parameter[0].high);
        }
    }
}

int main()
{
    uint64_t state = 4;
    for (uint64_t i = 0; i < HARD_DIRECTIONS; i += 7)
    {
        float direction[3];
        hard_direction_f32(i, direction);
        if (direction[0] != 0.0f || direction[1] != 0.0f || direction[2] != 0.0f)
        {
            compare_direction(direction);
        }
    }
    for (uint64_t i = 0; i < HARD_POINTS; i++)
    {
        float point[2];
        hard_point_f32(i, point);
        compare_point(point[0], point[1]);
    }
    for (int i = 0; i < 100000; i++)
    {
        const float direction[3] = {static_cast<float>(next_real(&state)),
                                    static_cast<float>(next_real(&state)),
                                    static_cast<float>(next_real(&state))};
        compare_direction(direction);
        compare_point(direction[0], direction[1]);
    }
    std::printf("%ld results, %ld different\n", compared, different);
    return different == 0 && compared > 1000000 ? 0 : 1;
}
