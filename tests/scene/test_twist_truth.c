/* SPDX-License-Identifier: MIT
 *
 * Twists against quadruple precision, at the hard points: no turn, hardly one, half a turn and beside it. The truth is the
 * exponential of the 4 x 4 matrix by its series, with halving and squaring, which knows neither sines nor quaternions.
 */
#include <cubemap/pose.h>

#include <float.h>
#include <quadmath.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

__extension__ typedef __float128 wide;

typedef struct matrix
{
    wide at[4][4];
} matrix;

static matrix product(const matrix *a, const matrix *b)
{
    matrix made;
    for (int i = 0; i < 16; i++)
    {
        made.at[i / 4][i % 4] = 0;
        for (int k = 0; k < 4; k++)
        {
            made.at[i / 4][i % 4] += a->at[i / 4][k] * b->at[k][i % 4];
        }
    }
    return made;
}

static matrix identity(void)
{
    const matrix one = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    return one;
}

/* Ten squarings, of the longest angle here, lose ten bits of 113. */
static matrix exponential(const double twist[6])
{
    const wide v[3] = {twist[0], twist[1], twist[2]};
    const wide w[3] = {twist[3], twist[4], twist[5]};
    matrix x = {{{0, -w[2], w[1], v[0]}, {w[2], 0, -w[0], v[1]}, {-w[1], w[0], 0, v[2]}, {0}}};
    wide size = 0;
    for (int i = 0; i < 3; i++)
    {
        size += fabsq(w[i]);
    }
    int halvings = 0;
    for (; size > 1; size /= 2)
    {
        halvings++;
    }
    for (int i = 0; i < 12; i++)
    {
        x.at[i / 4][i % 4] = ldexpq(x.at[i / 4][i % 4], -halvings);
    }
    matrix sum = identity();
    for (int k = 30; k >= 1; k--)
    {
        sum = product(&x, &sum);
        for (int i = 0; i < 16; i++)
        {
            sum.at[i / 4][i % 4] = sum.at[i / 4][i % 4] / k + (i / 4 == i % 4 ? 1 : 0);
        }
    }
    for (int i = 0; i < halvings; i++)
    {
        sum = product(&sum, &sum);
    }
    return sum;
}

static const double angles[] = {
    0.0,      5e-324,       1e-310,        1e-300,    1e-160,          1e-20,      1e-8,
    1e-4,     0.25,         0.5 - 0x1p-54, 0.5,       1.0 - 0x1p-53,   1.0,        1.0 + 0x1p-52,
    PI / 2.0, 2.0,          3.0,           PI - 1e-3, PI - 1e-8,       PI - 1e-15, PI - 0x1p-51,
    PI,       PI + 0x1p-51, PI + 1e-8,     4.0,       2.0 * PI - 1e-8, 2.0 * PI,   10.0,
    1000.0};
static const double axes[][3] = {{1, 0, 0},      {0, 1, 0},  {0, 0, -1},       {1, 1, 0},
                                 {0, -1, 1},     {1, 1, 1},  {-1, 1, -1},      {1, 1e-8, 0},
                                 {0, 1e-160, 1}, {3, -2, 5}, {1e-8, -1, 1e-8}, {-0.1, 0.7, 0.6}};
static const double moves[][3] = {{0, 0, 0},   {1, 0, 0},      {0, 1, 0},           {0, 0, 1},
                                  {-3, 2, -5}, {1e6, 2, 1e-6}, {1e-300, 0, 1e-300}, {1, 1, 1}};

static double length_of(const double v[3])
{
    return hypot(v[0], hypot(v[1], v[2]));
}

static void make_twist(size_t angle, size_t axis, size_t move, double twist[6])
{
    const double length = length_of(axes[axis]);
    for (int i = 0; i < 3; i++)
    {
        twist[i] = moves[move][i];
        twist[3 + i] = angles[angle] * (axes[axis][i] / length);
    }
}

/* worst errors in eps: of the rotation, and of the position in lengths of the translation */
static double worst_rotation, worst_position;

static void check_exp(const double twist[6])
{
    cm_pose pose;
    cm_pose_exp(twist, &pose);
    const matrix truth = exponential(twist);
    /* the angle's own rounding turns by as much */
    const double slack = 1.0 + length_of(twist + 3);
    const double length = length_of(twist) + DBL_MIN;
    for (int i = 0; i < 9; i++)
    {
        const wide error = fabsq(truth.at[i % 3][i / 3] - pose.rotation.row[i / 3][i % 3]);
        worst_rotation = fmax(worst_rotation, (double)error / DBL_EPSILON / slack);
    }
    for (int i = 0; i < 3; i++)
    {
        const wide error = fabsq(truth.at[i][3] - pose.position[i]);
        worst_position = fmax(worst_position, (double)(error / length) / DBL_EPSILON / slack);
    }
    ck_assert_int_eq(cm_pose_check(&pose), CM_OK);
}

START_TEST(exp_is_the_series)
{
    worst_rotation = 0.0;
    worst_position = 0.0;
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
    {
        for (size_t k = 0; k < sizeof axes / sizeof *axes; k++)
        {
            for (size_t m = 0; m < sizeof moves / sizeof *moves; m++)
            {
                double twist[6];
                make_twist(i, k, m, twist);
                check_exp(twist);
                REQUIRE(worst_rotation <= 3.0 && worst_position <= 3.0,
                        "angle %.17g, axis %zu, move %zu: %g eps, %g eps", angles[i], k, m,
                        worst_rotation, worst_position);
            }
        }
    }
    printf("exp: rotation %.2f eps, position %.2f eps\n", worst_rotation, worst_position);
}
END_TEST

/* The angle and what turns by less than half a turn less: both in the relative sense while they are small. */
static void check_log(size_t angle, size_t axis, size_t move)
{
    double twist[6];
    double back[6];
    cm_pose pose;
    make_twist(angle, axis, move, twist);
    const matrix truth = exponential(twist);
    for (int i = 0; i < 9; i++)
    {
        pose.rotation.row[i / 3][i % 3] = (double)truth.at[i % 3][i / 3];
        pose.position[i / 3] = (double)truth.at[i / 3][3];
    }
    cm_pose_log(&pose, back);
    const double turn = length_of(twist + 3);
    const double length = length_of(twist) + DBL_MIN;
    /* by half a turn both senses of the axis are right */
    double sense = 0.0;
    for (int i = 3; i < 6; i++)
    {
        sense += twist[i] * back[i];
    }
    REQUIRE(sense >= 0.0 || turn > PI - 1e-14, "angle %.17g: the wrong sense", angles[angle]);
    for (int i = 0; i < 3 && sense >= 0.0; i++)
    {
        const double in_turn = fabs(back[3 + i] - twist[3 + i]) / (turn + DBL_MIN) / DBL_EPSILON;
        const double in_move = fabs(back[i] - twist[i]) / length / DBL_EPSILON;
        worst_rotation = fmax(worst_rotation, in_turn);
        worst_position = fmax(worst_position, in_move);
        REQUIRE(in_turn <= 8.0 && in_move <= 8.0, "angle %.17g, axis %zu, move %zu: %g eps, %g eps",
                angles[angle], axis, move, in_turn, in_move);
    }
    ck_assert(length_of(back + 3) <= PI * (1.0 + DBL_EPSILON));
    cm_pose again;
    cm_pose_exp(back, &again);
    for (int i = 0; i < 9; i++)
    {
        ck_assert(fabs(again.rotation.row[i / 3][i % 3] - pose.rotation.row[i / 3][i % 3]) <=
                  12.0 * DBL_EPSILON);
        ck_assert(fabs(again.position[i / 3] - pose.position[i / 3]) <=
                  16.0 * DBL_EPSILON * length);
    }
}

START_TEST(log_undoes_it)
{
    worst_rotation = 0.0;
    worst_position = 0.0;
    for (size_t i = 0; i < sizeof angles / sizeof *angles && angles[i] <= PI; i++)
    {
        for (size_t k = 0; k < sizeof axes / sizeof *axes; k++)
        {
            for (size_t m = 0; m < sizeof moves / sizeof *moves; m++)
            {
                check_log(i, k, m);
            }
        }
    }
    printf("log: rotation %.2f eps, position %.2f eps\n", worst_rotation, worst_position);
}
END_TEST

/* Beyond half a turn the shorter way is told. */
START_TEST(log_goes_the_shorter_way)
{
    const double twist[6] = {0.0, 0.0, 0.0, 0.0, 0.0, PI + 0.25};
    double back[6];
    cm_pose pose;
    cm_pose_exp(twist, &pose);
    cm_pose_log(&pose, back);
    REQUIRE(fabs(back[5] - (0.25 - PI)) <= 4.0 * DBL_EPSILON, "%.17g", back[5]);
    REQUIRE(fabs(cm_pose_angle(&pose) - (PI - 0.25)) <= 4.0 * DBL_EPSILON, "angle");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {exp_is_the_series, log_undoes_it, log_goes_the_shorter_way, NULL};
    return run_suite("twist truth", tests);
}
