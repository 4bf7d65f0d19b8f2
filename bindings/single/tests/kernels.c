/* SPDX-License-Identifier: MIT
 *
 * A kernel of the file that has nothing else, in C and C++.
 */
#include <cubemap_kernels_single.h>

int main(void)
{
    cm_constants_f64 k = cm_coupled_prepare_f64(cm_make_parameters_f64(0.0, 0.0));
    cm_uv_f64 there = cm_coupled_forward_f64(0.5, 0.25, k);
    cm_pq_f64 back = cm_coupled_inverse_f64(there.u, there.v, k);
    return fabs(back.p - 0.5) + fabs(back.q - 0.25) < 1e-15 ? 0 : 1;
}
