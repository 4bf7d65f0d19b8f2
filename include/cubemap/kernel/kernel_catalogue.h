/* SPDX-License-Identifier: MIT
 *
 * The catalogue: one line a mapping. Each room holds the mapping's kernel and, under CM_DESCRIPTORS,
 * its descriptor; this list makes the kernels, the descriptors and the tables of the library.
 *
 * A descriptor is CM_WARP(NAME, fields...), NAME being that of its kernel's functions, CM_WARP_VARIANTS if
 * the kernel has two variants (types.h), CM_WARP_ASYMMETRIC if v(p, q) is not u(q, p) to the bit, nor q(u, v)
 * p(v, u), CM_WARP_UNDERFLOW if its powers underflow beside a face's centre and corners (lone_points.inc), or CM_SPHERE if it is no warp of the cube's faces but maps
 * directions to them, or to a square, itself. What maps only part of the way is a CM_AZIMUTHAL (sphere to
 * disc), a CM_SQUARE (disc to square) or a CM_LAYOUT, which joins the two; who does not tell those
 * three apart defines CM_CHART for all of them.
 */
#if defined(CM_DESCRIPTORS) && !defined(CM_WARP_VARIANTS)
#define CM_WARP_VARIANTS(...) CM_WARP(__VA_ARGS__)
#define CM_WARP_VARIANTS_HERE
#endif
#if defined(CM_DESCRIPTORS) && !defined(CM_WARP_ASYMMETRIC)
#define CM_WARP_ASYMMETRIC(...) CM_WARP(__VA_ARGS__)
#define CM_WARP_ASYMMETRIC_HERE
#endif
#if defined(CM_DESCRIPTORS) && !defined(CM_WARP_UNDERFLOW)
#define CM_WARP_UNDERFLOW(...) CM_WARP(__VA_ARGS__)
#define CM_WARP_UNDERFLOW_HERE
#endif
#if defined(CM_DESCRIPTORS) && defined(CM_CHART)
#define CM_AZIMUTHAL(...) CM_CHART(__VA_ARGS__)
#define CM_SQUARE(...) CM_CHART(__VA_ARGS__)
#define CM_LAYOUT(...) CM_CHART(__VA_ARGS__)
#endif
#if defined(CM_DESCRIPTORS) && !defined(CM_PARAMETER_FOV)
/* Parameters of several mappings */
/* clang-format off */
#define CM_PARAMETER_FOV(usual, highest)                                                           \
    {.name = "fov", .meaning = "field of view in degrees", .standard = (usual), .low = 1e-6,       \
     .high = (highest)}
#define CM_PARAMETER_FULL                                                                          \
    {.name = "full", .meaning = "1 for the whole sphere, fov=360", .high = 1.0, .whole = 1}
#define CM_PARAMETER_BETA(of_what)                                                                 \
    {.name = "beta", .meaning = of_what, .standard = 0.4, .high = 1.0}
#define CM_PARAMETERS_CENTRE                                                                       \
    {.name = "lon", .meaning = "longitude of the centre in degrees", .low = -360.0,                \
     .high = 360.0},                                                                               \
    {.name = "lat", .meaning = "latitude of the centre in degrees", .standard = 90.0,              \
     .low = -90.0, .high = 90.0}
#define CM_PARAMETER_FORWARD                                                                       \
    {.name = "forward",                                                                            \
     .meaning = "which polynomial is exact: 0 from the map to the sphere, "                         \
                "1 from the sphere to the map",                                                    \
     .high = 1.0, .whole = 1}
/* clang-format on */
#endif
#include "gnomonic.h"
#include "tangent.h"
#include "outerra.h"
#include "cobe.h"
#include "qsc.h"
#include "seamless.h"
#include "slice.h"
#include "zucker_cobe.h"
#include "zucker_quintic.h"
#include "nowell.h"
#include "continuous.h"
#include "unicube.h"
#include "arvo.h"
#include "everitt.h"
#include "algebraic.h"
#include "coupled.h"
#include "coupled_cubic.h"
#include "coupled_lean.h"
#include "difference.h"
#include "corner.h"
#include "tanh.h"
#include "logistic.h"
#include "smoothstep.h"
#include "s2.h"
#include "conformal.h"
#include "healpix_faces.h"

#include "square_radial.h"
#include "square_shirley.h"
#include "square_squircle.h"
#include "square_elliptical.h"
#include "square_conformal.h"
#include "azimuthal_lambert.h"
#include "azimuthal_stereographic.h"
#include "azimuthal_breusing.h"
#include "azimuthal_mixture.h"
#include "azimuthal_equidistant.h"
#include "azimuthal_orthographic.h"
#include "azimuthal_gnomonic.h"
#include "layout.h"
#include "octahedral.h"
#include "octahedral_clarberg.h"
#include "rhealpix.h"
#if defined(CM_DESCRIPTORS) && defined(CM_CHART)
#undef CM_AZIMUTHAL
#undef CM_SQUARE
#undef CM_LAYOUT
#endif
#ifdef CM_WARP_UNDERFLOW_HERE
#undef CM_WARP_UNDERFLOW
#undef CM_WARP_UNDERFLOW_HERE
#endif
#ifdef CM_WARP_ASYMMETRIC_HERE
#undef CM_WARP_ASYMMETRIC
#undef CM_WARP_ASYMMETRIC_HERE
#endif
#ifdef CM_WARP_VARIANTS_HERE
#undef CM_WARP_VARIANTS
#undef CM_WARP_VARIANTS_HERE
#endif
