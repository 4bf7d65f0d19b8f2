/* SPDX-License-Identifier: MIT */
#include "camera_set.h"

#include "instruction_set.h"

/* The simplest first, as cm_instructions_at has them. */
static const void *const sets[] = {
    &cm_camera_scalar,
#ifdef CM_HAVE_SSE2
    &cm_camera_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_camera_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_camera_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_camera_neon,
#endif
};

const cm_camera_set *cm_camera_set_find(void)
{
    const cm_camera_set *set = cm_scene_set_find(NULL, sets, sizeof sets / sizeof *sets);
    /* an environment that asks for what is not there */
    return set != NULL ? set : &cm_camera_scalar;
}
