/* SPDX-License-Identifier: MIT
 *
 * Twists: exp and log of rigid motions, screws, adjoints. With w the rotation vector, t its length and W the cross product
 * by it, exp(v, w) has the translation V v, V = 1 + (1 - cos t) / t^2 W + (t - sin t) / t^3 W^2, and
 * V^-1 = 1 - W / 2 + (1 - (t / 2) cot(t / 2)) / t^2 W^2 (Murray, Li and Sastry 1994, section 2.3; Eade 2013).
 */
#include <cubemap/pose.h>

#include <math.h>
#include <string.h>

/* Of any length that has a double, the shortest ones too. */
static double length_of(const double a[3])
{
    const double most = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    if (!(most > 0.0 && most < (double)INFINITY))
    {
        return a[0] + a[1] + a[2] == 0.0 ? 0.0 : (double)NAN;
    }
    /* subnormal numbers have no reciprocal */
    const double scale = most < 0x1p-500 ? 0x1p600 : most > 0x1p500 ? 0x1p-600 : 1.0;
    const double x = a[0] * scale;
    const double y = a[1] * scale;
    const double z = a[2] * scale;
    return sqrt(x * x + y * y + z * z) / scale;
}

static void cross(const double a[3], const double b[3], double to[3])
{
    const double made[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
    memcpy(to, made, sizeof made);
}

/* (t - sin t) / t: below 1 by the series, whose terms have alternating signs. */
static double sine_rest(double t)
{
    if (t >= 1.0)
    {
        return 1.0 - sin(t) / t;
    }
    const double square = t * t;
    double sum = 0.0;
    for (int k = 19; k >= 3; k -= 2) /* t^20 / 21! is less than the sum's last digit */
    {
        sum = (1.0 - sum) * square / (double)(k * (k - 1));
    }
    return sum;
}

/* 1 - (t / 2) cot(t / 2), the cotangent given: below 1/2 by the series of the Bernoulli numbers. */
static double cotangent_rest(double t, double half_cotangent)
{
    static const double term[] = {1.0 / 12.0,          1.0 / 720.0,
                                  1.0 / 30240.0,       1.0 / 1209600.0,
                                  1.0 / 47900160.0,    691.0 / 1307674368000.0,
                                  1.0 / 74724249600.0, 3617.0 / 10670622842880000.0};
    if (t >= 0.5)
    {
        return 1.0 - t * half_cotangent;
    }
    const double square = t * t;
    double sum = 0.0;
    for (size_t k = sizeof term / sizeof term[0]; k-- > 0;)
    {
        sum = (sum + term[k]) * square;
    }
    return sum;
}

void cm_pose_exp(const double twist[6], cm_pose *pose)
{
    const double *v = twist;
    const double *w = twist + 3;
    const double t = length_of(w);
    const double half_sine = sin(0.5 * t);
    double axis[3] = {0.0, 0.0, 0.0};
    double turned[3];
    double twice[3];
    double place[3];
    double quaternion[4] = {0.0, 0.0, 0.0, cos(0.5 * t)};
    for (int i = 0; i < 3; i++)
    {
        axis[i] = t > 0.0 ? w[i] / t : t;
        quaternion[i] = axis[i] * half_sine;
    }
    /* W / t and (W / t)^2 applied to v, so that no square of t can vanish or overflow */
    cross(axis, v, turned);
    cross(axis, turned, twice);
    const double first = t > 0.0 ? 2.0 * half_sine * (half_sine / t) : 0.0;
    const double second = t > 0.0 ? sine_rest(t) : 0.0;
    for (int i = 0; i < 3; i++)
    {
        place[i] = v[i] + first * turned[i] + second * twice[i];
    }
    if (cm_pose_from_quaternion(place, quaternion, pose) != CM_OK)
    {
        for (int i = 0; i < 9; i++)
        {
            pose->rotation.row[i / 3][i % 3] = (double)NAN;
            pose->position[i / 3] = (double)NAN;
        }
    }
}

/* The length of the quaternion's x, y, z, and the angle. */
static double angle_of(const double quaternion[4], double *half_sine)
{
    *half_sine = length_of(quaternion);
    return 2.0 * atan2(*half_sine, quaternion[3]);
}

double cm_pose_angle(const cm_pose *pose)
{
    double quaternion[4];
    double half_sine;
    cm_pose_quaternion(pose, quaternion);
    return angle_of(quaternion, &half_sine);
}

void cm_pose_log(const cm_pose *pose, double twist[6])
{
    double quaternion[4];
    double half_sine;
    double axis[3];
    double turned[3];
    double twice[3];
    const double place[3] = {pose->position[0], pose->position[1], pose->position[2]};
    cm_pose_quaternion(pose, quaternion);
    const double t = angle_of(quaternion, &half_sine);
    const double cotangent = half_sine > 0.0 ? quaternion[3] / half_sine : 0.0;
    const double rest = t > 0.0 ? cotangent_rest(t, 0.5 * cotangent) : t;
    for (int i = 0; i < 3; i++)
    {
        axis[i] = half_sine > 0.0 ? quaternion[i] / half_sine : t;
    }
    cross(axis, place, turned);
    cross(axis, turned, twice);
    for (int i = 0; i < 3; i++)
    {
        twist[i] = place[i] - 0.5 * t * turned[i] + rest * twice[i];
        twist[3 + i] = axis[i] * t;
    }
}

void cm_pose_interpolate(const cm_pose *from, const cm_pose *to, double t, cm_pose *pose)
{
    cm_pose motion;
    double twist[6];
    if (t == 0.0 || t == 1.0)
    {
        *pose = t == 0.0 ? *from : *to;
        return;
    }
    cm_pose_between(from, to, &motion);
    cm_pose_log(&motion, twist);
    for (int i = 0; i < 6; i++)
    {
        twist[i] *= t;
    }
    cm_pose_exp(twist, &motion);
    cm_pose_compose(from, &motion, pose);
}

void cm_pose_adjoint(const cm_pose *pose, double adjoint[36])
{
    memset(adjoint, 0, 36 * sizeof *adjoint);
    for (int k = 0; k < 3; k++)
    {
        /* the camera's axis k in the world is a column of the rotation, and its moment about the origin */
        double moment[3];
        cross(pose->position, pose->rotation.row[k], moment);
        for (int i = 0; i < 3; i++)
        {
            adjoint[6 * i + k] = pose->rotation.row[k][i];
            adjoint[6 * (i + 3) + k + 3] = pose->rotation.row[k][i];
            adjoint[6 * i + k + 3] = moment[i];
        }
    }
}

void cm_pose_transport(const cm_pose *pose, const double covariance[36], double transported[36])
{
    double adjoint[36];
    double half[36];
    double made[36];
    cm_pose_adjoint(pose, adjoint);
    for (int i = 0; i < 36; i++)
    {
        half[i] = 0.0;
        for (int k = 0; k < 6; k++)
        {
            half[i] += adjoint[i / 6 * 6 + k] * covariance[6 * k + i % 6];
        }
    }
    for (int i = 0; i < 36; i++)
    {
        made[i] = 0.0;
        for (int k = 0; k < 6; k++)
        {
            made[i] += half[i / 6 * 6 + k] * adjoint[i % 6 * 6 + k];
        }
    }
    for (int i = 0; i < 36;
         i++) /* what rounding has made of a symmetric matrix is made symmetric */
    {
        transported[i] = 0.5 * (made[i] + made[i % 6 * 6 + i / 6]);
    }
}
