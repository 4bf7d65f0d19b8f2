/* SPDX-License-Identifier: MIT
 *
 * The same work in C's functions and in C++'s, NAME_in_c and NAME_in_cpp: test_cost.py compares their instructions.
 */
#include "bindings/cpp/cubemap.hpp"

extern "C" {
int point_in_c(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    return cm_forward(mapping, direction, uv);
}

int point_in_cpp(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    return cubemap::mapping_view(mapping).forward(reinterpret_cast<const double(&)[3]>(*direction),
                                                  reinterpret_cast<double(&)[2]>(*uv));
}

void array_in_c(const cm_mapping *mapping, double (&x)[99], double (&y)[99], double (&z)[99],
                std::uint8_t (&face)[99])
{
    cm_forward_array(mapping, 99, x, y, z, face, x, y);
}

void array_in_cpp(const cm_mapping *mapping, double (&x)[99], double (&y)[99], double (&z)[99],
                  std::uint8_t (&face)[99])
{
    cubemap::mapping_view(mapping).forward(x, y, z, face, x, y);
}

int status_in_c(const cm_mapping *mapping, const double (&pq)[2], double (&uv)[2])
{
    return cm_warp(mapping, pq, uv);
}

int status_in_cpp(const cm_mapping *mapping, const double (&pq)[2], double (&uv)[2])
{
    return cubemap::mapping_view(mapping).try_warp(pq, uv);
}

double object_in_c(const double (&direction)[3])
{
    cm_mapping *mapping = nullptr;
    double uv[2] = {0.0, 0.0};
    if (cm_mapping_create("coupled", nullptr, &mapping) == CM_OK)
    {
        cm_forward(mapping, direction, uv);
        cm_mapping_destroy(mapping);
    }
    return uv[0];
}

double object_in_cpp(const double (&direction)[3])
{
    double uv[2] = {0.0, 0.0};
    if (auto mapping = cubemap::mapping::try_make("coupled"))
    {
        mapping->forward(direction, uv);
    }
    return uv[0];
}
}
