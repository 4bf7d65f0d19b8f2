/* SPDX-License-Identifier: MIT
 *
 * Meshes that Embree does not take say so, and not that there is no memory. So many triangles are nowhere in memory here:
 * their number is all that may be looked at.
 */
#include "modules/sim/mesh_rays.h"

#include "tests/suite.h"

#include <cubemap/sim.h>

START_TEST(triangles_beyond_a_count_are_out_of_range)
{
    cm_mesh_options shape = {.size = sizeof shape, .triangle_count = CM_TOF_TRIANGLES_MOST};
    ck_assert(3 * (uint64_t)CM_TOF_TRIANGLES_MOST == UINT32_MAX);
    ck_assert_int_eq(mesh_rays_check(&shape), CM_OK);
    shape.triangle_count++;
    ck_assert_int_eq(mesh_rays_check(&shape), CM_ERROR_RANGE);
    shape.triangle_count = INT32_MAX; /* the most of a mesh */
    ck_assert_int_eq(mesh_rays_check(&shape), CM_ERROR_RANGE);
}
END_TEST

START_TEST(vertices_beyond_reach_are_out_of_range)
{
    static const double bad[] = {1e18, -1e18, 1e300, INFINITY, NAN};
    double corner[9] = {-1, 0, 1, 0, 1, 1, 1, 0, 1};
    cm_mesh_options shape = {
        .size = sizeof shape, .vertex_count = 3, .position = corner, .triangle_count = 1};
    for (size_t i = 0; i < 9; i++)
    {
        const double kept = corner[i];
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        {
            corner[i] = bad[k];
            ck_assert_int_eq(mesh_rays_check(&shape), CM_ERROR_RANGE);
        }
        corner[i] = kept;
    }
    ck_assert_int_eq(mesh_rays_check(&shape), CM_OK);
    corner[4] = 1e300; /* of no triangle */
    shape.triangle_count = 0;
    ck_assert_int_eq(mesh_rays_check(&shape), CM_OK);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {triangles_beyond_a_count_are_out_of_range,
                                  vertices_beyond_reach_are_out_of_range, NULL};
    return run_suite("mesh limits", tests);
}
