/* SPDX-License-Identifier: MIT
 *
 * What a program of C or C++ does with the interface of one file; the implementation is in another source.
 */
#include <cubemap_single.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    cm_mapping *mapping;
    if (cm_mapping_create("coupled", NULL, &mapping) != CM_OK)
    {
        return 1;
    }
    double direction[3] = {2.0, 1.0, 0.5};
    double uv[2];
    int face = cm_forward(mapping, direction, uv);
    cm_mapping_destroy(mapping);

    cm_constants_f64 k = cm_coupled_prepare_f64(cm_make_parameters_f64(0.0, 0.0));
    cm_uv_f64 inlined = cm_coupled_forward_f64(0.5, 0.25, k); /* face 0: p = y / x, q = z / x */
    printf("face %d, u %.6f, v %.6f\n", face, uv[0], uv[1]);
    return fabs(inlined.u - uv[0]) + fabs(inlined.v - uv[1]) < 1e-15 ? 0 : 1;
}
