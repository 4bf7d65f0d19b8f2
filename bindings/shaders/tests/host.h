/* SPDX-License-Identifier: MIT
 *
 * The texts for CUDA and Metal as C++ of the host: the words of those languages that the kernels use.
 */
#ifndef SHADERS_HOST_H
#define SHADERS_HOST_H

#include <cmath>

#ifndef __CUDACC__
#ifndef __host__
#define __host__
#define __device__
#define __forceinline__ inline
#endif
struct float3
{
    float x, y, z;
    float3() = default;
    float3(float first, float second, float third) : x(first), y(second), z(third)
    {
    }
};
static inline float3 make_float3(float x, float y, float z)
{
    return float3(x, y, z);
}
#endif

typedef void (*host_function)(const float *in, float *out);

#endif
