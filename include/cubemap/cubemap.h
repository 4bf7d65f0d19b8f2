/* SPDX-License-Identifier: MIT
 *
 * libcubemap: mappings between the sphere and the six faces of a cube. This header includes all that
 * the library offers; the kernels, for shaders and for inlining, are in <cubemap/kernels.h>.
 */
#ifndef CUBEMAP_CUBEMAP_H
#define CUBEMAP_CUBEMAP_H

#include <cubemap/advise.h>
#include <cubemap/catalogue.h>
#include <cubemap/cell.h>
#include <cubemap/cell_grid.h>
#include <cubemap/covering.h>
#include <cubemap/direction.h>
#include <cubemap/distortion.h>
#include <cubemap/ellipsoid.h>
#include <cubemap/export.h>
#include <cubemap/frame.h>
#include <cubemap/grid.h>
#include <cubemap/latitude.h>
#include <cubemap/healpix.h>
#include <cubemap/mapping.h>
#include <cubemap/number.h>
#include <cubemap/options.h>
#include <cubemap/orient.h>
#include <cubemap/orientation.h>
#include <cubemap/statistics.h>
#include <cubemap/status.h>
#include <cubemap/threads.h>
#include <cubemap/version.h>

#endif
