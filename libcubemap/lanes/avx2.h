/* SPDX-License-Identifier: MIT
 *
 * Vectors of 32 bytes: x86-64 with AVX2 and FMA. A condition is all ones or all zeros in each lane;
 * only the sign bit of lanes_bit counts, as CM_SELECT wants it.
 */
#define LANES_BYTES 32
#if CM_LANES_BITS == 64
#define LANES 4
#define CM_REAL __m256d
#define lanes_all(x) _mm256_set1_pd(x)
#define lanes_some(p, n)                                                                           \
    _mm256_maskload_pd(                                                                            \
        p, _mm256_cmpgt_epi64(_mm256_set1_epi64x((long long)(n)), _mm256_setr_epi64x(0, 1, 2, 3)))
#define CM_SELECT(condition, a, b) _mm256_blendv_pd(b, a, _mm256_castsi256_pd(condition))
#define cm_min(a, b) _mm256_min_pd(a, b)
#define cm_max(a, b) _mm256_max_pd(a, b)
#define cm_sqrt(x) _mm256_sqrt_pd(x)
#define cm_mad(a, b, c) _mm256_fmadd_pd(a, b, c)
#define cm_abs(x) _mm256_andnot_pd(_mm256_set1_pd(-0.0), x)
#define cm_copysign(m, s)                                                                          \
    _mm256_or_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), m), _mm256_and_pd(_mm256_set1_pd(-0.0), s))
#else
#define LANES 8
#define CM_REAL __m256
#define lanes_all(x) _mm256_set1_ps(x)
#define lanes_some(p, n)                                                                           \
    _mm256_maskload_ps(p, _mm256_cmpgt_epi32(_mm256_set1_epi32((int)(n)),                          \
                                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)))
#define CM_SELECT(condition, a, b) _mm256_blendv_ps(b, a, _mm256_castsi256_ps(condition))
#define cm_min(a, b) _mm256_min_ps(a, b)
#define cm_max(a, b) _mm256_max_ps(a, b)
#define cm_sqrt(x) _mm256_sqrt_ps(x)
#define cm_mad(a, b, c) _mm256_fmadd_ps(a, b, c)
#define cm_abs(x) _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x)
#define cm_copysign(m, s)                                                                          \
    _mm256_or_ps(_mm256_andnot_ps(_mm256_set1_ps(-0.0f), m),                                       \
                 _mm256_and_ps(_mm256_set1_ps(-0.0f), s))
#endif
#define CM_FUSED 1
#define CM_BOOL __m256i
#define cm_both(a, b) _mm256_and_si256(a, b)
#define cm_less(a, b) ((__m256i)((a) < (b)))
#define cm_at_least(a, b) ((__m256i)((a) >= (b)))
#define cm_equal(a, b) ((__m256i)((a) == (b)))
#define lanes_mask_of_signs(x) ((__m256i)(x))

#include "vector.h"

#if CM_LANES_BITS == 64
static inline __m256d lanes_faces_f64(const uint8_t *bytes)
{
    int four;
    memcpy(&four, bytes, 4);
    return _mm256_cvtepi32_pd(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four)));
}

static inline void lanes_put_faces_f64(uint8_t *bytes, __m256d faces)
{
    __m128i words = _mm256_cvttpd_epi32(faces);
    words = _mm_packs_epi32(words, words);
    int four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
    memcpy(bytes, &four, 4);
}

#define lanes_load_faces(bytes) lanes_faces_f64(bytes)
#define lanes_store_faces(bytes, faces) lanes_put_faces_f64(bytes, faces)
#else
static inline __m256 lanes_faces_f32(const uint8_t *bytes)
{
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)bytes)));
}

static inline void lanes_put_faces_f32(uint8_t *bytes, __m256 faces)
{
    __m256i wide = _mm256_cvttps_epi32(faces);
    __m128i words =
        _mm_packs_epi32(_mm256_castsi256_si128(wide), _mm256_extracti128_si256(wide, 1));
    _mm_storel_epi64((__m128i *)bytes, _mm_packus_epi16(words, words));
}

#define lanes_load_faces(bytes) lanes_faces_f32(bytes)
#define lanes_store_faces(bytes, faces) lanes_put_faces_f32(bytes, faces)

static inline __m256 lanes_narrowed(const double *p)
{
    return _mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(p + 4)),
                           _mm256_cvtpd_ps(_mm256_loadu_pd(p)));
}

static inline void lanes_put_widened(double *p, __m256 x)
{
    _mm256_storeu_pd(p, _mm256_cvtps_pd(_mm256_castps256_ps128(x)));
    _mm256_storeu_pd(p + 4, _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1)));
}

#define lanes_load_narrowed(p) lanes_narrowed(p)
#define lanes_store_widened(p, x) lanes_put_widened(p, x)
#endif
