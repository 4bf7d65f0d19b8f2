// SPDX-License-Identifier: MIT
//
// <cubemap/kernels.h> in code for the device, in both precisions; for compiling alone.
#include <cubemap/kernels.h>

__global__ void both(const double *pq, double *uv, float *uv_f32)
{
    cm_constants_f64 k = cm_coupled_prepare_f64(cm_make_parameters_f64(0.0, 0.0));
    cm_uv_f64 a = cm_coupled_forward_f64(pq[0], pq[1], k);
    cm_constants_f32 l = cm_tanh_prepare_f32(cm_make_parameters_f32(0.97218f, 0.0f));
    cm_uv_f32 b = cm_tanh_forward_f32((float)pq[0], (float)pq[1], l);
    uv[0] = a.u;
    uv[1] = a.v;
    uv_f32[0] = b.u;
    uv_f32[1] = b.v;
}
