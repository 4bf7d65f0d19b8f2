/* SPDX-License-Identifier: MIT
 *
 * This library's kernels (<cubemap/kernels.h>) in loops of the program's own, one point after the other, as a program has
 * them that calls no library: the yardstick of cm_forward and cm_inverse. meson.build keeps the compiler from making
 * vectors of several points of these loops.
 */
#include "side_by_side.h"

#include <cubemap/kernels.h>

#include <stdlib.h>
#include <string.h>

typedef struct kernel_constants
{
    cm_constants_f64 of_f64;
    cm_constants_f32 of_f32;
} kernel_constants;

#define CM_DESCRIPTORS

#define CM_BACKEND 1
#define KERNEL_FROM from
#define KERNEL_PLANE plane
#define KERNEL_BACK back
#include "contestant_kernels.inc"

#define CM_BACKEND 2
#define KERNEL_FROM from_f32
#define KERNEL_PLANE plane_f32
#define KERNEL_BACK back_f32
#include "contestant_kernels.inc"

typedef struct kernel
{
    void (*run[2][DIRECTIONS])(const contestant *c, batch *b); /* in double, in float */
    cm_constants_f64 (*prepare_f64)(cm_constants_f64 k);
    cm_constants_f32 (*prepare_f32)(cm_constants_f32 k);
} kernel;

#define KERNEL_ENTRY(id)                                                                           \
    {.run = {{forward_##id##_f64, inverse_##id##_f64}, {forward_##id##_f32, inverse_##id##_f32}},  \
     .prepare_f64 = cm_##id##_prepare_f64,                                                         \
     .prepare_f32 = cm_##id##_prepare_f32},
#define CM_CHART(...) {.prepare_f64 = NULL},
#define CM_SPHERE(id, ...) KERNEL_ENTRY(id)
#define CM_WARP(id, ...) KERNEL_ENTRY(id)
static const kernel kernels[] = {
#include <cubemap/kernel/kernel_catalogue.h>
};

static kernel_constants prepare(const kernel *with, const cm_mapping_info *info)
{
    double of[4] = {0.0};
    for (size_t i = 0; i < info->parameter_count && i < sizeof of / sizeof *of; i++)
    {
        of[i] = info->parameter[i].standard;
    }
    kernel_constants k = {cm_make_parameters_f64(of[0], of[1]),
                          cm_make_parameters_f32((float)of[0], (float)of[1])};
    k.of_f64.k2 = of[2];
    k.of_f64.k3 = of[3];
    k.of_f32.k2 = (float)of[2];
    k.of_f32.k3 = (float)of[3];
    k.of_f64 = with->prepare_f64(k.of_f64);
    k.of_f32 = with->prepare_f32(k.of_f32);
    return k;
}

static void close_kernel(contestant *c)
{
    free(c->handle);
}

static void add(roster *all, const kernel *with, const cm_mapping_info *info, int narrow)
{
    kernel_constants *constants = allocate(1, sizeof *constants);
    *constants = prepare(with, info);
    const contestant entrant = {.library = "libcubemap",
                                .version = cm_version(),
                                .group = info->identifier,
                                .specification = info->identifier,
                                .name = "inlined kernel",
                                .path = "header",
                                .tier = "exact",
                                .note = "",
                                .own = 1,
                                .narrow = narrow,
                                .forward = with->run[narrow][FORWARD],
                                .inverse = with->run[narrow][INVERSE],
                                .close = close_kernel,
                                .handle = constants};
    roster_add(all, &entrant);
}

int add_kernels(roster *all)
{
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        if (kernels[i].prepare_f64 != NULL && roster_wants(all, info->identifier))
        {
            add(all, &kernels[i], info, 0);
            add(all, &kernels[i], info, 1);
        }
    }
    return 1;
}
