/* SPDX-License-Identifier: MIT
 *
 * The kernels of one backend as a table, for test_shader_backend.cpp to compare. shader_kernels.cpp makes
 * that of the shaders' text.
 */
#ifndef TESTS_SHADER_KERNELS_H
#define TESTS_SHADER_KERNELS_H

struct kernel_result
{
    float value[3];
};

/* What a mapping does not have is null. */
struct kernel_row
{
    const char *name;
    kernel_result (*forward)(float p, float q, const float *parameters);
    kernel_result (*inverse)(float u, float v, const float *parameters);
    kernel_result (*project)(float x, float y, float z);
    kernel_result (*unproject)(float face, float a, float b);
};

/* The catalogue, and cube behind it; ends with a row without a name. */
extern const kernel_row shader_table[];

/* The constants of a mapping's first four parameters. */
template <typename constants> constants with_parameters(constants k, const float *parameters)
{
    k.k0 = parameters[0];
    k.k1 = parameters[1];
    k.k2 = parameters[2];
    k.k3 = parameters[3];
    return k;
}

/* A row for each descriptor, of kernels called KERNEL(name). */
#define KERNEL_TABLE_SPHERE(id)                                                                    \
    {#id, nullptr, nullptr,                                                                        \
     [](float x, float y, float z) -> kernel_result                                                \
     {                                                                                             \
         auto k = KERNEL(cm_##id##_prepare)(KERNEL(cm_make_parameters)(1.0f, 3.0f));               \
         auto r = KERNEL(cm_##id##_project)(x, y, z, k);                                           \
         return {{r.face, r.a, r.b}};                                                              \
     },                                                                                            \
     [](float face, float a, float b) -> kernel_result                                             \
     {                                                                                             \
         auto k = KERNEL(cm_##id##_prepare)(KERNEL(cm_make_parameters)(1.0f, 3.0f));               \
         auto r = KERNEL(cm_##id##_unproject)(face, a, b, k);                                      \
         return {{r.x, r.y, r.z}};                                                                 \
     }},
#define KERNEL_TABLE_WARP(id)                                                                      \
    {#id,                                                                                          \
     [](float p, float q, const float *parameters) -> kernel_result                                \
     {                                                                                             \
         auto k = KERNEL(cm_##id##_prepare)(                                                       \
             with_parameters(KERNEL(cm_make_parameters)(0.0f, 0.0f), parameters));                 \
         auto r = KERNEL(cm_##id##_forward)(p, q, k);                                              \
         return {{r.u, r.v, 0.0f}};                                                                \
     },                                                                                            \
     [](float u, float v, const float *parameters) -> kernel_result                                \
     {                                                                                             \
         auto k = KERNEL(cm_##id##_prepare)(                                                       \
             with_parameters(KERNEL(cm_make_parameters)(0.0f, 0.0f), parameters));                 \
         auto r = KERNEL(cm_##id##_inverse)(u, v, k);                                              \
         return {{r.p, r.q, 0.0f}};                                                                \
     },                                                                                            \
     nullptr, nullptr},
/* Parts of maps: a projection of the hemisphere, of which unproject takes a point of the disc; a mapping between
 * disc and square; a layout, by itself nothing. */
#define KERNEL_TABLE_AZIMUTHAL(id)                                                                 \
    {#id, nullptr, nullptr,                                                                        \
     [](float x, float y, float z) -> kernel_result                                                \
     {                                                                                             \
         auto k = KERNEL(cm_azimuthal_##id##_prepare)(KERNEL(cm_make_parameters)(178.0f, 0.4f));   \
         auto r = KERNEL(cm_azimuthal_##id##_project)(x, y, z < 0.0f ? -z : z, k);                 \
         return {{r.u, r.v, r.rim}};                                                               \
     },                                                                                            \
     [](float u, float v, float) -> kernel_result                                                  \
     {                                                                                             \
         auto k = KERNEL(cm_azimuthal_##id##_prepare)(KERNEL(cm_make_parameters)(178.0f, 0.4f));   \
         auto r = KERNEL(cm_azimuthal_##id##_unproject)(KERNEL(cm_make_disc_point)(u, v), k);      \
         return {{r.x, r.y, r.z}};                                                                 \
     }},
#define KERNEL_TABLE_SQUARE(id)                                                                    \
    {#id,                                                                                          \
     [](float u, float v, const float *) -> kernel_result                                          \
     {                                                                                             \
         auto r = KERNEL(cm_square_##id##_forward)(KERNEL(cm_make_disc_point)(u, v));              \
         auto p = KERNEL(cm_quincuncial_place)(r.u, r.v, 1.0f);                                    \
         return {{p.u, p.v, r.u}};                                                                 \
     },                                                                                            \
     [](float x, float y, const float *) -> kernel_result                                          \
     {                                                                                             \
         auto p = KERNEL(cm_quincuncial_unplace)(x, y);                                            \
         auto r = KERNEL(cm_square_##id##_inverse)(p.a, p.b);                                      \
         return {{r.u, r.v, r.rim}};                                                               \
     },                                                                                            \
     nullptr, nullptr},
/* the faces of the cube, which take no constants */
#define KERNEL_TABLE_CUBE                                                                          \
    {"cube", nullptr, nullptr,                                                                        \
     [](float x, float y, float z) -> kernel_result                                                \
     {                                                                                             \
         auto r = KERNEL(cm_cube_project)(x, y, z);                                              \
         return {{r.face, r.a, r.b}};                                                              \
     },                                                                                            \
     [](float face, float a, float b) -> kernel_result                                             \
     {                                                                                             \
         auto r = KERNEL(cm_cube_unproject)(face, a, b);                                         \
         return {{r.x, r.y, r.z}};                                                                 \
     }},
#define KERNEL_TABLE_LAYOUT(id) {#id, nullptr, nullptr, nullptr, nullptr},

#endif
