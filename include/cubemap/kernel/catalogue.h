/* SPDX-License-Identifier: MIT
 *
 * The catalogue: one line a mapping. Each room holds the mapping's kernel and, under CM_DESCRIPTORS,
 * its descriptor; this list makes the kernels, the descriptors and the tables of the library.
 *
 * A descriptor is CM_WARP(identifier, fields...), CM_WARP_VARIANTS if its kernel has two variants
 * (types.h), or CM_SPHERE if it is no warp of the cube's faces.
 */
#if defined(CM_DESCRIPTORS) && !defined(CM_WARP_VARIANTS)
#define CM_WARP_VARIANTS(...) CM_WARP(__VA_ARGS__)
#define CM_WARP_VARIANTS_HERE
#endif
#include "gnomonic.h"
#include "tangent.h"
#include "outerra.h"
#include "cobe.h"
#include "qsc.h"
#include "nowell.h"
#include "continuous.h"
#include "unicube.h"
#include "everitt.h"
#include "algebraic.h"
#include "coupled.h"
#include "coupled_cubic.h"
#include "difference.h"
#include "corner.h"
#include "tanh.h"
#include "logistic.h"
#include "smoothstep.h"
#include "s2.h"
#include "healpix.h"
#ifdef CM_WARP_VARIANTS_HERE
#undef CM_WARP_VARIANTS
#undef CM_WARP_VARIANTS_HERE
#endif
