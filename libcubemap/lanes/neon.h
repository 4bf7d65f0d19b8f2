/* SPDX-License-Identifier: MIT
 *
 * Vectors of 16 bytes: every AArch64. A condition is all ones or all zeros in each lane.
 */
#define LANES_BYTES 16
#define CM_FUSED 1
#if CM_LANES_BITS == 64
#define LANES 2
#define CM_REAL float64x2_t
#define CM_BOOL uint64x2_t
#define lanes_all(x) vdupq_n_f64(x)
#define CM_SELECT(condition, a, b) vbslq_f64(condition, a, b)
#define cm_both(a, b) vandq_u64(a, b)
#define cm_less(a, b) vcltq_f64(a, b)
#define cm_at_least(a, b) vcgeq_f64(a, b)
#define cm_equal(a, b) vceqq_f64(a, b)
#define cm_sqrt(x) vsqrtq_f64(x)
#define cm_mad(a, b, c) vfmaq_f64(c, a, b)
#define cm_abs(x) vabsq_f64(x)
#define cm_copysign(m, s) vbslq_f64(vdupq_n_u64(0x8000000000000000u), s, m)
#define lanes_mask_of_signs(x) vcltzq_s64((int64x2_t)(x))
#else
#define LANES 4
#define CM_REAL float32x4_t
#define CM_BOOL uint32x4_t
#define lanes_all(x) vdupq_n_f32(x)
#define CM_SELECT(condition, a, b) vbslq_f32(condition, a, b)
#define cm_both(a, b) vandq_u32(a, b)
#define cm_less(a, b) vcltq_f32(a, b)
#define cm_at_least(a, b) vcgeq_f32(a, b)
#define cm_equal(a, b) vceqq_f32(a, b)
#define cm_sqrt(x) vsqrtq_f32(x)
#define cm_mad(a, b, c) vfmaq_f32(c, a, b)
#define cm_abs(x) vabsq_f32(x)
#define cm_copysign(m, s) vbslq_f32(vdupq_n_u32(0x80000000u), s, m)
#define lanes_mask_of_signs(x) vcltzq_s32((int32x4_t)(x))
#endif
/* not vminq, which treats NaN in another way than all other sets */
#define cm_min(a, b) CM_SELECT(cm_less(a, b), a, b)
#define cm_max(a, b) CM_SELECT(cm_less(b, a), a, b)

#include "vector.h"

#if CM_LANES_BITS == 64
#define lanes_load_faces(bytes) ((float64x2_t){(double)(bytes)[0], (double)(bytes)[1]})

static inline void lanes_put_faces_f64(uint8_t *bytes, float64x2_t faces)
{
    bytes[0] = (uint8_t)(int)vgetq_lane_f64(faces, 0);
    bytes[1] = (uint8_t)(int)vgetq_lane_f64(faces, 1);
}

#define lanes_store_faces(bytes, faces) lanes_put_faces_f64(bytes, faces)
#else
static inline float32x4_t lanes_faces_f32(const uint8_t *bytes)
{
    uint32_t four;
    memcpy(&four, bytes, 4);
    uint16x8_t words = vmovl_u8(vreinterpret_u8_u32(vdup_n_u32(four)));
    return vcvtq_f32_u32(vmovl_u16(vget_low_u16(words)));
}

static inline void lanes_put_faces_f32(uint8_t *bytes, float32x4_t faces)
{
    uint16x4_t words = vmovn_u32(vcvtq_u32_f32(faces));
    uint32_t four = vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(words, words))), 0);
    memcpy(bytes, &four, 4);
}

#define lanes_load_faces(bytes) lanes_faces_f32(bytes)
#define lanes_store_faces(bytes, faces) lanes_put_faces_f32(bytes, faces)

static inline float32x4_t lanes_narrowed(const double *p)
{
    return vcvt_high_f32_f64(vcvt_f32_f64(vld1q_f64(p)), vld1q_f64(p + 2));
}

static inline void lanes_put_widened(double *p, float32x4_t x)
{
    vst1q_f64(p, vcvt_f64_f32(vget_low_f32(x)));
    vst1q_f64(p + 2, vcvt_high_f64_f32(x));
}

#define lanes_load_narrowed(p) lanes_narrowed(p)
#define lanes_store_widened(p, x) lanes_put_widened(p, x)
#endif
