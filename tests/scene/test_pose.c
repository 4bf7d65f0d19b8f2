/* SPDX-License-Identifier: MIT
 *
 * Poses: products, inverses, screws, adjoints, covariances and quaternions. Twists in quadruple precision:
 * test_twist_truth.c.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/pose.h>

#include <float.h>

#include "tests/suite.h"

/* Some pose, the same for the same number. */
static cm_pose some_pose(int number)
{
    const double k = (double)number;
    const double twist[6] = {sin(k),       3.0 * cos(2.0 * k), sin(5.0 * k), 1.7 * sin(3.0 * k),
                             cos(7.0 * k), 1.3 * sin(k + 1.0)};
    cm_pose pose;
    cm_pose_exp(twist, &pose);
    return pose;
}

static double apart(const cm_pose *a, const cm_pose *b)
{
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst, fabs(a->rotation.row[i / 3][i % 3] - b->rotation.row[i / 3][i % 3]));
        worst = fmax(worst, fabs(a->position[i / 3] - b->position[i / 3]));
    }
    return worst;
}

static const cm_pose origin = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

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

/* A product applied is one after the other; results may lie on what they are made of. */
START_TEST(products_and_inverses)
{
    for (int i = 0; i < 50; i++)
    {
        const cm_pose a = some_pose(i);
        const cm_pose b = some_pose(i + 100);
        cm_pose made;
        const double point[3] = {0.3, -0.8, 2.0};
        double once[3];
        double twice[3];
        cm_pose_compose(&a, &b, &made);
        cm_pose_apply_back(&made, point, once);
        cm_pose_apply_back(&b, point, twice);
        cm_pose_apply_back(&a, twice, twice);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(fabs(once[k] - twice[k]) <= 1e-14, "%d: %g", i, once[k] - twice[k]);
        }
        cm_pose back;
        cm_pose_between(&a, &made, &back);
        REQUIRE(apart(&back, &b) <= 1e-14, "%d: between", i);
        cm_pose_invert(&made, &back);
        cm_pose_compose(&back, &made, &back);
        REQUIRE(apart(&back, &origin) <= 1e-14, "%d: inverse", i);
        back = a;
        cm_pose_compose(&back, &b, &back);
        REQUIRE(apart(&back, &made) == 0.0, "%d: in place", i);
    }
}
END_TEST

/* A millionth of a metre apart, a million metres away. */
START_TEST(far_poses_keep_their_difference)
{
    cm_pose a = some_pose(1);
    a.position[0] = 0x1p20;
    cm_pose b = a;
    b.position[0] += 0x1p-20;
    cm_pose motion;
    cm_pose_between(&a, &b, &motion);
    for (int i = 0; i < 3; i++)
    {
        const double expected = a.rotation.row[i][0] * 0x1p-20;
        ck_assert(motion.position[i] == expected);
    }
}
END_TEST

/* The twist of a part of a screw is that part of the twist. */
START_TEST(screws)
{
    for (int i = 0; i < 50; i++)
    {
        const cm_pose a = some_pose(i);
        const cm_pose b = some_pose(3 * i + 1);
        cm_pose made;
        cm_pose_interpolate(&a, &b, 0.0, &made);
        ck_assert(apart(&made, &a) == 0.0);
        cm_pose_interpolate(&a, &b, 1.0, &made);
        ck_assert(apart(&made, &b) == 0.0);
        double whole[6];
        double part[6];
        cm_pose motion;
        cm_pose_between(&a, &b, &motion);
        cm_pose_log(&motion, whole);
        for (int t = 1; t < 8; t++)
        {
            cm_pose_interpolate(&a, &b, 0.125 * t, &made);
            cm_pose_between(&a, &made, &motion);
            cm_pose_log(&motion, part);
            for (int k = 0; k < 6; k++)
            {
                REQUIRE(fabs(part[k] - 0.125 * t * whole[k]) <= 4e-15 * 4.0, "%d, %d, %d: %g", i, t,
                        k, part[k] - 0.125 * t * whole[k]);
            }
        }
        cm_pose_interpolate(&a, &b, 2.0, &made);
        cm_pose_between(&b, &made, &made);
        cm_pose_between(&a, &b, &motion);
        REQUIRE(apart(&made, &motion) <= 3e-14, "%d: beyond", i);
    }
}
END_TEST

/* pose exp(x) = exp(adjoint x) pose, for twists of any size. */
START_TEST(adjoints)
{
    for (int i = 0; i < 50; i++)
    {
        const cm_pose pose = some_pose(i);
        double adjoint[36];
        double twist[6];
        double moved[6] = {0.0};
        for (int k = 0; k < 6; k++)
        {
            twist[k] = sin(11.0 * i + k);
        }
        cm_pose_adjoint(&pose, adjoint);
        for (int k = 0; k < 36; k++)
        {
            moved[k / 6] += adjoint[k] * twist[k % 6];
        }
        cm_pose left;
        cm_pose right;
        cm_pose_exp(twist, &left);
        cm_pose_compose(&pose, &left, &left);
        cm_pose_exp(moved, &right);
        cm_pose_compose(&right, &pose, &right);
        REQUIRE(apart(&left, &right) <= 2e-14, "%d: %g", i, apart(&left, &right));
    }
}
END_TEST

/* The covariance of one twist is its square: that of the moved twist is the moved one's. And back. */
START_TEST(covariances)
{
    for (int i = 0; i < 20; i++)
    {
        const cm_pose pose = some_pose(i);
        cm_pose inverse;
        double adjoint[36];
        double twist[6];
        double moved[6] = {0.0};
        double square[36];
        double made[36];
        double back[36];
        cm_pose_adjoint(&pose, adjoint);
        cm_pose_invert(&pose, &inverse);
        for (int k = 0; k < 6; k++)
        {
            twist[k] = cos(3.0 * i + k);
        }
        for (int k = 0; k < 36; k++)
        {
            moved[k / 6] += adjoint[k] * twist[k % 6];
            square[k] = twist[k / 6] * twist[k % 6];
        }
        cm_pose_transport(&pose, square, made);
        cm_pose_transport(&inverse, made, back);
        for (int k = 0; k < 36; k++)
        {
            ck_assert(made[k] == made[k % 6 * 6 + k / 6]);
            REQUIRE(fabs(made[k] - moved[k / 6] * moved[k % 6]) <= 1e-13, "%d: %d", i, k);
            REQUIRE(fabs(back[k] - square[k]) <= 1e-12, "%d: %d back: %g", i, k,
                    back[k] - square[k]);
        }
        cm_pose_transport(&pose, square, square);
        ck_assert(memcmp(square, made, sizeof made) == 0);
    }
}
END_TEST

/* TUM's line: x y z w from camera to world. */
START_TEST(quaternions)
{
    static const double position[3] = {1.0, 2.0, 3.0};
    static const double quarter[4] = {0.0, 0.0, 0.70710678118654752440, 0.70710678118654752440};
    const double x[3] = {1.0, 0.0, 0.0};
    double world[3];
    double back[4];
    cm_pose pose;
    ck_assert_int_eq(cm_pose_from_quaternion(position, quarter, &pose), CM_OK);
    cm_pose_apply_back(&pose, x, world);
    REQUIRE(fabs(world[0] - 1.0) <= 4e-16 && fabs(world[1] - 3.0) <= 1e-15 && world[2] == 3.0,
            "%.17g %.17g %.17g", world[0], world[1], world[2]);
    for (int i = 0; i < 256; i++) /* all signs, zeros and sizes */
    {
        static const double values[4] = {0.0, 1.0, -1.0, 1e-9};
        double q[4];
        double square = 0.0;
        for (int k = 0; k < 4; k++)
        {
            q[k] = values[(i >> (2 * k)) & 3];
            square += q[k] * q[k];
        }
        if (square < 0.5)
        {
            continue;
        }
        double sense = 0.0;
        for (int k = 0; k < 4; k++)
        {
            q[k] /= sqrt(square);
        }
        ck_assert_int_eq(cm_pose_from_quaternion(position, q, &pose), CM_OK);
        ck_assert_int_eq(cm_pose_check(&pose), CM_OK);
        cm_pose_quaternion(&pose, back);
        for (int k = 0; k < 4; k++)
        {
            sense += back[k] * q[k];
        }
        for (int k = 0; k < 4; k++)
        {
            REQUIRE(fabs(back[k] - copysign(1.0, sense) * q[k]) <= 4e-16, "%d: %.17g", i, back[k]);
        }
        ck_assert(back[3] >= 0.0);
    }
}
END_TEST

START_TEST(lengths_of_quaternions)
{
    static const double position[3] = {0.0, 0.0, 0.0};
    const struct
    {
        double w;
        cm_status expected;
    } cases[] = {{1.0, CM_OK},
                 {1.00099, CM_OK},
                 {0.99901, CM_OK},
                 {1.00101, CM_ERROR_CAMERA},
                 {0.99899, CM_ERROR_CAMERA},
                 {0.0, CM_ERROR_CAMERA},
                 {(double)NAN, CM_ERROR_CAMERA},
                 {(double)INFINITY, CM_ERROR_CAMERA}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        const double q[4] = {0.0, 0.0, 0.0, cases[i].w};
        cm_pose pose = {.position = {7.0}};
        ck_assert_int_eq(cm_pose_from_quaternion(position, q, &pose), cases[i].expected);
        ck_assert(pose.position[0] == (cases[i].expected == CM_OK ? 0.0 : 7.0));
        ck_assert(cases[i].expected != CM_OK || apart(&pose, &origin) == 0.0);
    }
}
END_TEST

START_TEST(bad_poses)
{
    cm_pose pose = origin;
    const double q[4] = {0.0, 0.0, 0.0, 1.0};
    const double bad[3] = {0.0, (double)NAN, 0.0};
    ck_assert_int_eq(cm_pose_check(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_pose_check(&pose), CM_OK);
    ck_assert_int_eq(cm_pose_from_quaternion(bad, q, &pose), CM_ERROR_CAMERA);
    ck_assert_int_eq(cm_pose_from_quaternion(NULL, q, &pose), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_pose_from_quaternion(bad, NULL, &pose), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_pose_from_quaternion(bad, q, NULL), CM_ERROR_ARGUMENT);
    pose.position[2] = (double)INFINITY;
    ck_assert_int_eq(cm_pose_check(&pose), CM_ERROR_CAMERA);
    pose = origin;
    pose.rotation.row[1][1] = -1.0; /* a mirror */
    ck_assert_int_eq(cm_pose_check(&pose), CM_ERROR_CAMERA);
    for (int i = 0; i < 6; i++) /* NaN and infinities give no pose */
    {
        double twist[6] = {1.0, 2.0, 3.0, 0.1, 0.2, 0.3};
        twist[i] = i % 2 == 0 ? (double)NAN : (double)INFINITY;
        cm_pose_exp(twist, &pose);
        ck_assert_int_eq(cm_pose_check(&pose), CM_ERROR_CAMERA);
        cm_pose_log(&pose, twist);
        ck_assert(isnan(twist[0]) && isnan(twist[5]));
        ck_assert(isnan(cm_pose_angle(&pose)));
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {poses_go_there_and_back,
                                  products_and_inverses,
                                  far_poses_keep_their_difference,
                                  screws,
                                  adjoints,
                                  covariances,
                                  quaternions,
                                  lengths_of_quaternions,
                                  bad_poses,
                                  NULL};
    return run_suite("pose", tests);
}
