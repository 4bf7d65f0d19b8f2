/* SPDX-License-Identifier: MIT
 *
 * Poses of any twist and any quaternion: what is refused leaves the output alone, what is not are rotations, and what goes
 * there comes back.
 */
#include <cubemap/pose.h>

#include <math.h>

#include "fuzz.h"

static double take_number(supply *from)
{
    static const double numbers[] = {0.0, 1e-300, -1e-8, 3.14159265358979323846, 0.5, 1e-160, -1.0};
    const uint8_t kind = take_byte(from);
    return kind < 64    ? take_double(from)
           : kind < 160 ? 4.0 * take_fraction(from)
                        : numbers[kind % (sizeof numbers / sizeof *numbers)];
}

static int are_below(const double *value, int count, double most)
{
    for (int i = 0; i < count; i++)
    {
        if (!(fabs(value[i]) <= most))
        {
            return 0;
        }
    }
    return 1;
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

static cm_pose check_twist(const double twist[6])
{
    cm_pose pose;
    cm_pose again;
    double back[6];
    cm_pose_exp(twist, &pose);
    cm_pose_log(&pose, back);
    cm_pose_exp(back, &again);
    const double angle = cm_pose_angle(&pose);
    if (are_below(twist, 6, 1e6))
    {
        const double size = 1.0 + fabs(twist[0]) + fabs(twist[1]) + fabs(twist[2]);
        EXPECT(cm_pose_check(&pose) == CM_OK, "%g %g %g", twist[3], twist[4], twist[5]);
        EXPECT(angle >= 0.0 && angle <= 3.1415926535897936, "%.17g", angle);
        EXPECT(apart(&pose, &again) <= 1e-14 * size, "%g", apart(&pose, &again));
    }
    return pose;
}

static void check_quaternion(supply *from)
{
    double place[3];
    double q[4];
    double back[4];
    cm_pose pose = {.position = {7.0, 7.0, 7.0}};
    const int makes_unit = take_byte(from) % 2;
    for (int i = 0; i < 7; i++)
    {
        *(i < 3 ? &place[i] : &q[i - 3]) = take_number(from);
    }
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; makes_unit && i < 4; i++)
    {
        q[i] /= length;
    }
    if (cm_pose_from_quaternion(place, q, &pose) != CM_OK)
    {
        EXPECT(pose.position[0] == 7.0 && pose.position[2] == 7.0, "touched");
        return;
    }
    EXPECT(cm_pose_check(&pose) == CM_OK, "no pose");
    cm_pose_quaternion(&pose, back);
    double along = 0.0;
    for (int i = 0; i < 4; i++)
    {
        along += back[i] * q[i];
    }
    EXPECT(back[3] >= 0.0 && fabs(fabs(along) - 1.0) <= 1.1e-3, "%g", along);
}

static void check_pair(const cm_pose *a, const cm_pose *b, double t)
{
    cm_pose product;
    cm_pose back;
    cm_pose between;
    double adjoint[36];
    double moved[36];
    cm_pose_compose(a, b, &product);
    cm_pose_between(a, &product, &between);
    cm_pose_invert(a, &back);
    cm_pose_compose(&back, &product, &back);
    cm_pose_interpolate(a, b, t, &product);
    cm_pose_adjoint(a, adjoint);
    cm_pose_transport(b, adjoint, moved);
    if (cm_pose_check(a) != CM_OK || cm_pose_check(b) != CM_OK || !are_below(a->position, 3, 1e6) ||
        !are_below(b->position, 3, 1e6))
    {
        return;
    }
    EXPECT(apart(&between, b) <= 1e-8 && apart(&back, b) <= 1e-8, "%g, %g", apart(&between, b),
           apart(&back, b));
    EXPECT(!(fabs(t) <= 10.0) || cm_pose_check(&product) == CM_OK, "%g", t);
    double point[3];
    cm_pose_apply(a, b->position, point);
    cm_pose_apply_back(a, point, point);
    for (int i = 0; i < 3; i++)
    {
        EXPECT(fabs(point[i] - b->position[i]) <= 1e-8, "%g", point[i] - b->position[i]);
    }
    for (int i = 0; i < 36; i++)
    {
        EXPECT(moved[i] == moved[i % 6 * 6 + i / 6], "not symmetric");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    double twists[2][6];
    for (int i = 0; i < 12; i++)
    {
        twists[i / 6][i % 6] = take_number(&from);
    }
    const cm_pose a = check_twist(twists[0]);
    const cm_pose b = check_twist(twists[1]);
    check_pair(&a, &b, take_number(&from));
    check_quaternion(&from);
    cm_pose any;
    for (int i = 0; i < 9; i++)
    {
        any.rotation.row[i / 3][i % 3] = take_number(&from);
        any.position[i / 3] = take_number(&from);
    }
    double twist[6];
    const cm_status status = cm_pose_check(&any);
    EXPECT(status == CM_OK || status == CM_ERROR_CAMERA, "%d", (int)status);
    cm_pose_log(&any, twist);
    check_pair(&any, &a, 0.5);
    return 0;
}
