/* SPDX-License-Identifier: MIT
 *
 * Vectors of 64 bytes: x86-64 with AVX-512 F, DQ, BW and VL. A condition is a mask, one bit a lane.
 */
#define LANES_BYTES 64
#define CM_FUSED 1
#if CM_LANES_BITS == 64
#define LANES 8
#define CM_REAL __m512d
#define CM_BOOL __mmask8
#define lanes_all(x) _mm512_set1_pd(x)
#define lanes_some(p, n) _mm512_maskz_loadu_pd((__mmask8)((1u << (n)) - 1u), p)
#define LANES_COMPARE(a, b, how) _mm512_cmp_pd_mask(a, b, how)
#define CM_SELECT(condition, a, b) _mm512_mask_blend_pd(condition, b, a)
#define cm_min(a, b) _mm512_min_pd(a, b)
#define cm_max(a, b) _mm512_max_pd(a, b)
#define cm_mad(a, b, c) _mm512_fmadd_pd(a, b, c)
#define cm_sqrt(x) _mm512_sqrt_pd(x)
#define cm_abs(x) _mm512_abs_pd(x)
/* 0xd8: the bits of s where the constant has ones, of m elsewhere */
#define cm_copysign(m, s)                                                                          \
    _mm512_castsi512_pd(_mm512_ternarylogic_epi64(_mm512_castpd_si512(m), _mm512_castpd_si512(s),  \
                                                  _mm512_castpd_si512(_mm512_set1_pd(-0.0)),       \
                                                  0xd8))
#define lanes_mask_of_signs(x) _mm512_movepi64_mask((__m512i)(x))
#else
#define LANES 16
#define CM_REAL __m512
#define CM_BOOL __mmask16
#define lanes_all(x) _mm512_set1_ps(x)
#define lanes_some(p, n) _mm512_maskz_loadu_ps((__mmask16)((1u << (n)) - 1u), p)
#define LANES_COMPARE(a, b, how) _mm512_cmp_ps_mask(a, b, how)
#define CM_SELECT(condition, a, b) _mm512_mask_blend_ps(condition, b, a)
#define cm_min(a, b) _mm512_min_ps(a, b)
#define cm_max(a, b) _mm512_max_ps(a, b)
#define cm_mad(a, b, c) _mm512_fmadd_ps(a, b, c)
#define cm_sqrt(x) _mm512_sqrt_ps(x)
#define cm_abs(x) _mm512_abs_ps(x)
#define cm_copysign(m, s)                                                                          \
    _mm512_castsi512_ps(_mm512_ternarylogic_epi32(_mm512_castps_si512(m), _mm512_castps_si512(s),  \
                                                  _mm512_castps_si512(_mm512_set1_ps(-0.0f)),      \
                                                  0xd8))
#define lanes_mask_of_signs(x) _mm512_movepi32_mask((__m512i)(x))
#endif
#define cm_both(a, b) ((CM_BOOL)((a) & (b)))
#define lanes_or_nan(good, x) CM_SELECT(good, x, lanes_all((LANES_SCALAR)NAN))
#define cm_less(a, b) LANES_COMPARE(a, b, _CMP_LT_OQ)
#define cm_at_least(a, b) LANES_COMPARE(a, b, _CMP_GE_OQ)
#define cm_equal(a, b) LANES_COMPARE(a, b, _CMP_EQ_OQ)

#include "vector.h"

/* A root and a division of a vector take 34 cycles of the one divider in double, 22 in float: as long
 * for a point as with vectors of 32 bytes, while the multiply-adds of two units take half. So what is
 * made of both is made of multiply-adds here.
 *
 * 1 / sqrt(x) to half the digits and then zeros, so that its square is exact; x from 2^-60 to 2^60 in float, from
 * 2^-900 to 2^900 in double. The processor's approximation is good to 14 bits; in double one Newton step doubles
 * them. */
#if CM_LANES_BITS == 64
static inline __m512d lanes_rough_inverse_root_f64(__m512d x)
{
    __m512d y = _mm512_rsqrt14_pd(x);
    __m512d e = _mm512_fnmadd_pd(x, y * y, CM_LIT(1.0));
    y = cm_mad(y * CM_LIT(0.5), e, y);
    return _mm512_castsi512_pd(
        _mm512_and_si512(_mm512_castpd_si512(y), _mm512_set1_epi64(-0x8000000)));
}

#define CM_ROUGH_INVERSE_ROOT(x) lanes_rough_inverse_root_f64(x)
#define CM_ROUGH_INVERSE(x) _mm512_rcp14_pd(x) /* where it pays beside roots and divisions */
#else
static inline __m512 lanes_rough_inverse_root_f32(__m512 x)
{
    return _mm512_castsi512_ps(
        _mm512_and_si512(_mm512_castps_si512(_mm512_rsqrt14_ps(x)), _mm512_set1_epi32(-0x1000)));
}

#define CM_ROUGH_INVERSE_ROOT(x) lanes_rough_inverse_root_f32(x)
#define CM_ROUGH_INVERSE(x) _mm512_rcp14_ps(x)
#endif

#if CM_LANES_BITS == 64
#define lanes_load_faces(bytes)                                                                    \
    _mm512_cvtepi32_pd(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(bytes))))
#define lanes_store_faces(bytes, faces)                                                            \
    _mm_storel_epi64((__m128i *)(bytes), _mm256_cvtepi32_epi8(_mm512_cvttpd_epi32(faces)))
#else
#define lanes_load_faces(bytes)                                                                    \
    _mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(bytes))))
#define lanes_store_faces(bytes, faces)                                                            \
    _mm_storeu_si128((__m128i *)(bytes), _mm512_cvtepi32_epi8(_mm512_cvttps_epi32(faces)))

static inline __m512 lanes_narrowed(const double *p)
{
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(_mm512_loadu_pd(p))),
                              _mm512_cvtpd_ps(_mm512_loadu_pd(p + 8)), 1);
}

static inline void lanes_put_widened(double *p, __m512 x)
{
    _mm512_storeu_pd(p, _mm512_cvtps_pd(_mm512_castps512_ps256(x)));
    _mm512_storeu_pd(p + 8, _mm512_cvtps_pd(_mm512_extractf32x8_ps(x, 1)));
}

#define lanes_load_narrowed(p) lanes_narrowed(p)
#define lanes_store_widened(p, x) lanes_put_widened(p, x)
#endif
