/* SPDX-License-Identifier: MIT
 *
 * Takes the words of the dialect back, so that they can be defined for another backend, and so that
 * they do not stay with whoever included <cubemap/kernels.h>.
 */
#undef CM_REAL
#undef CM_REAL_BITS
#undef CM_BOOL
#undef CM_LIT
#undef CM_NAME
#undef CM_FN
#undef CM_STRUCT
#undef CM_STRUCT_END
#undef CM_SELECT
#undef cm_sqrt
#undef cm_abs
#undef cm_copysign
#undef cm_min
#undef cm_max
#undef cm_mad
#undef CM_FUSED
#undef cm_less
#undef CM_ROUGH_INVERSE
#undef CM_ROUGH_INVERSE_ROOT
#undef cm_at_least
#undef cm_equal
#undef cm_both
#undef CM_VARIANT
#undef CM_UNUSED
#undef CM_UNIVARIATE
#undef CM_UNIVARIATE_JACOBIAN
#undef CM_HEALPIX_POLAR
#undef CM_HEALPIX_SMALL
#undef CM_HEALPIX_LARGE
#undef CM_AZIMUTHAL_SMALL
#undef CM_AZIMUTHAL_LARGE
#undef CM_AZIMUTHAL_UP
#undef CM_AZIMUTHAL_DOWN
#undef CM_LAW_KERNELS
#undef CM_LATITUDE_TERMS_MAX
#undef CM_LATITUDE_DOWN
#undef CM_LATITUDE_POLE
#undef CM_LATITUDE_POLE_REST
#undef CM_CONFORMAL_2_K
#undef CM_CONFORMAL_2_K_1
#undef CM_CONFORMAL_2R_K_1
#undef CM_CONFORMAL_HALF_K
#undef CM_CONFORMAL_HALF_K_1
#undef CM_CONFORMAL_K_2R_1
#undef CM_CONFORMAL_K2_8
#undef CM_CONFORMAL_K_2R
#undef CM_CONFORMAL_STEP
#undef CM_CONFORMAL_SQRT3
#undef CM_CONFORMAL_INVERSE_SQRT3
#undef CM_CONFORMAL_SHIFT
#undef CM_CONFORMAL_POLE
