/* SPDX-License-Identifier: MIT
 *
 * The text that shaders get, as C++: it is that as well, once its literals are floats, for which this
 * file is compiled with -fsingle-precision-constant.
 */
#include "shader_kernels.h"

#include <cmath>

namespace
{
using std::abs;
using std::sqrt;
#define CM_BACKEND 3
#include <cubemap/kernel/backend.h>
#undef CM_BACKEND
#include <cubemap/kernel/undefine.h>
} // namespace

#define KERNEL(name) name
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...) KERNEL_TABLE_SPHERE(id)
#define CM_WARP(id, ...) KERNEL_TABLE_WARP(id)
#define CM_AZIMUTHAL(id, ...) KERNEL_TABLE_AZIMUTHAL(id)
#define CM_SQUARE(id, ...) KERNEL_TABLE_SQUARE(id)
#define CM_LAYOUT(id, ...) KERNEL_TABLE_LAYOUT(id)

const kernel_row shader_table[] = {
#include <cubemap/kernel/kernel_catalogue.h>
    KERNEL_TABLE_CUBE{nullptr, nullptr, nullptr, nullptr, nullptr}};
