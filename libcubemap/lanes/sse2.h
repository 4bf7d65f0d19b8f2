/* SPDX-License-Identifier: MIT
 *
 * Vectors of 16 bytes: every x86-64. A condition is all ones or all zeros in each lane.
 */
#define LANES_BYTES 16
#if CM_LANES_BITS == 64
#define LANES 2
#define CM_REAL __m128d
#define lanes_all(x) _mm_set1_pd(x)
#define LANES_COMPARE(a, b, how) _mm_castpd_si128(_mm_cmp##how##_pd(a, b))
#define CM_SELECT(condition, a, b)                                                                 \
    _mm_or_pd(_mm_and_pd(_mm_castsi128_pd(condition), a),                                          \
              _mm_andnot_pd(_mm_castsi128_pd(condition), b))
#define cm_min(a, b) _mm_min_pd(a, b)
#define cm_max(a, b) _mm_max_pd(a, b)
#define cm_sqrt(x) _mm_sqrt_pd(x)
#define cm_mad(a, b, c) ((a) * (b) + (c))
#define cm_abs(x) _mm_andnot_pd(_mm_set1_pd(-0.0), x)
#define cm_copysign(m, s)                                                                          \
    _mm_or_pd(_mm_andnot_pd(_mm_set1_pd(-0.0), m), _mm_and_pd(_mm_set1_pd(-0.0), s))
/* there is no arithmetic shift of 64 bits */
#define lanes_mask_of_signs(x)                                                                     \
    _mm_srai_epi32(_mm_shuffle_epi32((__m128i)(x), _MM_SHUFFLE(3, 3, 1, 1)), 31)
#else
#define LANES 4
#define CM_REAL __m128
#define lanes_all(x) _mm_set1_ps(x)
#define LANES_COMPARE(a, b, how) _mm_castps_si128(_mm_cmp##how##_ps(a, b))
#define CM_SELECT(condition, a, b)                                                                 \
    _mm_or_ps(_mm_and_ps(_mm_castsi128_ps(condition), a),                                          \
              _mm_andnot_ps(_mm_castsi128_ps(condition), b))
#define cm_min(a, b) _mm_min_ps(a, b)
#define cm_max(a, b) _mm_max_ps(a, b)
#define cm_sqrt(x) _mm_sqrt_ps(x)
#define cm_mad(a, b, c) ((a) * (b) + (c))
#define cm_abs(x) _mm_andnot_ps(_mm_set1_ps(-0.0f), x)
#define cm_copysign(m, s)                                                                          \
    _mm_or_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), m), _mm_and_ps(_mm_set1_ps(-0.0f), s))
#define lanes_mask_of_signs(x) _mm_srai_epi32((__m128i)(x), 31)
#endif
#define CM_BOOL __m128i
#define cm_both(a, b) _mm_and_si128(a, b)
#define cm_less(a, b) LANES_COMPARE(a, b, lt)
#define cm_at_least(a, b) LANES_COMPARE(a, b, ge)
#define cm_equal(a, b) LANES_COMPARE(a, b, eq)

#include "vector.h"

#if CM_LANES_BITS == 64
#define lanes_load_faces(bytes) _mm_set_pd((double)(bytes)[1], (double)(bytes)[0])

static inline void lanes_put_faces_f64(uint8_t *bytes, __m128d faces)
{
    int low = _mm_cvttsd_si32(faces);
    int high = _mm_cvttsd_si32(_mm_unpackhi_pd(faces, faces));
    bytes[0] = (uint8_t)low;
    bytes[1] = (uint8_t)high;
}

#define lanes_store_faces(bytes, faces) lanes_put_faces_f64(bytes, faces)
#else
static inline __m128 lanes_faces_f32(const uint8_t *bytes)
{
    int four;
    memcpy(&four, bytes, 4);
    __m128i zero = _mm_setzero_si128();
    __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero);
    return _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero));
}

static inline void lanes_put_faces_f32(uint8_t *bytes, __m128 faces)
{
    __m128i words = _mm_cvttps_epi32(faces);
    words = _mm_packs_epi32(words, words);
    int four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
    memcpy(bytes, &four, 4);
}

#define lanes_load_faces(bytes) lanes_faces_f32(bytes)
#define lanes_store_faces(bytes, faces) lanes_put_faces_f32(bytes, faces)

static inline __m128 lanes_narrowed(const double *p)
{
    return _mm_movelh_ps(_mm_cvtpd_ps(_mm_loadu_pd(p)), _mm_cvtpd_ps(_mm_loadu_pd(p + 2)));
}

static inline void lanes_put_widened(double *p, __m128 x)
{
    _mm_storeu_pd(p, _mm_cvtps_pd(x));
    _mm_storeu_pd(p + 2, _mm_cvtps_pd(_mm_movehl_ps(x, x)));
}

#define lanes_load_narrowed(p) lanes_narrowed(p)
#define lanes_store_widened(p, x) lanes_put_widened(p, x)
#endif
