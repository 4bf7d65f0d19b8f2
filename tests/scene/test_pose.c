/* SPDX-License-Identifier: MIT
 *
 * Poses.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/pose.h>

#include "tests/suite.h"

START_TEST(poses_go_there_and_back)
{
    cm_pose pose = {.position = {1.0, -2.0, 0.5}};
    ck_assert_int_eq(cm_rotation_from_angles(20.0, 30.0, 40.0, &pose.rotation), CM_OK);
    const double world[3] = {3.0, 4.0, 5.0};
    double point[3];
    cm_pose_apply(&pose, world, point);
    cm_pose_apply_back(&pose, point, point);
    for (int i = 0; i < 3; i++)
    {
        REQUIRE(fabs(point[i] - world[i]) <= 1e-14, "axis %d: %.17g", i, point[i]);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {poses_go_there_and_back, NULL};
    return run_suite("pose", tests);
}
