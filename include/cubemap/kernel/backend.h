/* SPDX-License-Identifier: MIT
 *
 * Everything that one backend needs, in order. For shaders this is the file to include, with
 * CM_BACKEND undefined for GLSL, or one of dialect.h; C and C++ include <cubemap/kernels.h>.
 */
#include "dialect.h"
#include "types.h"
#if CM_BACKEND != CM_BACKEND_QUAD
#include "elementary.h"
#endif
#include "factors.h"
#include "cube.h"
#include "jacobian.h"
#include "tissot.h"
#include "on_sphere.h"
#include "disc.h"
#include "complex.h"
#include "azimuthal.h"
#include "auxiliary_latitude.h"
#include "kernel_catalogue.h"
