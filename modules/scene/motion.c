/* SPDX-License-Identifier: MIT
 *
 * A trajectory as a curve with continuous acceleration: cubic splines through the positions and through the components of
 * the quaternions, of neighbours the sign that is nearer. The curve of quaternions is normalised; turning the world or the
 * camera's axes turns all of it, since that is linear in the components.
 */
#include <cubemap/trajectory.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "motion_span.h"
#include "trajectory_data.h"

enum
{
    COMPONENTS = 7 /* a position, and a quaternion x y z w */
};

typedef struct knot
{
    double value[COMPONENTS];
    double second[COMPONENTS]; /* derivatives */
} knot;

struct cm_motion
{
    size_t count;
    double *stamp;
    knot *knot;
};

/* ---- The spline ---- */

static void take_values(const cm_trajectory *from, knot *knots)
{
    for (size_t i = 0; i < from->count; i++)
    {
        double *value = knots[i].value;
        memcpy(value, from->pose[i].position, 3 * sizeof *value);
        cm_pose_quaternion(&from->pose[i], value + 3);
        double along = 0.0;
        for (int c = 3; i > 0 && c < COMPONENTS; c++)
        {
            along += value[c] * knots[i - 1].value[c];
        }
        for (int c = 3; along < 0.0 && c < COMPONENTS; c++)
        {
            value[c] = -value[c];
        }
    }
}

/* Row i of the equations that make the first derivatives continuous at knot i, 0 < i < n - 1: factors of the second
 * derivatives before, at and after it. Where an end is no knot, which is that the third derivative has no step beside it,
 * the end's second derivative is put in by its neighbours'. */
static void make_row(const double *stamp, size_t n, size_t i, double row[3])
{
    const double h = stamp[i] - stamp[i - 1];
    const double g = stamp[i + 1] - stamp[i];
    row[0] = h / 6.0;
    row[1] = (h + g) / 3.0;
    row[2] = g / 6.0;
    if (n >= 4 && i == 1)
    {
        row[1] += row[0] * (1.0 + h / g);
        row[2] -= row[0] * (h / g);
        row[0] = 0.0;
    }
    if (n >= 4 && i == n - 2)
    {
        row[1] += row[2] * (1.0 + g / h);
        row[0] -= row[2] * (g / h);
        row[2] = 0.0;
    }
}

static void set_ends(const double *stamp, size_t n, knot *knots)
{
    const double first = (stamp[1] - stamp[0]) / (stamp[2] - stamp[1]);
    const double last = (stamp[n - 1] - stamp[n - 2]) / (stamp[n - 2] - stamp[n - 3]);
    for (int c = 0; c < COMPONENTS; c++)
    {
        knots[0].second[c] = knots[1].second[c] - first * (knots[2].second[c] - knots[1].second[c]);
        knots[n - 1].second[c] =
            knots[n - 2].second[c] + last * (knots[n - 2].second[c] - knots[n - 3].second[c]);
    }
}

/* Gauss's elimination of three diagonals, all components at once; upper has room for n. The rows' middles are greater than
 * their sides together, so that nothing needs pivots. */
static void solve(const double *stamp, size_t n, knot *knots, double *upper)
{
    upper[0] = 0.0;
    for (size_t i = 1; i + 1 < n; i++)
    {
        double row[3];
        make_row(stamp, n, i, row);
        const double pivot = row[1] - row[0] * upper[i - 1];
        upper[i] = row[2] / pivot;
        for (int c = 0; c < COMPONENTS; c++)
        {
            const double step =
                (knots[i + 1].value[c] - knots[i].value[c]) / (stamp[i + 1] - stamp[i]) -
                (knots[i].value[c] - knots[i - 1].value[c]) / (stamp[i] - stamp[i - 1]);
            knots[i].second[c] = (step - row[0] * knots[i - 1].second[c]) / pivot;
        }
    }
    for (size_t i = n - 1; i-- > 1;)
    {
        for (int c = 0; c < COMPONENTS; c++)
        {
            knots[i].second[c] -= upper[i] * knots[i + 1].second[c];
        }
    }
    if (n >= 4)
    {
        set_ends(stamp, n, knots);
    }
}

cm_status cm_motion_create(const cm_trajectory *trajectory, cm_motion **motion)
{
    if (trajectory == NULL || motion == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const size_t n = trajectory->count;
    cm_motion *made = calloc(1, sizeof *made);
    double *stamps = calloc(n, sizeof *stamps);
    double *upper = calloc(n, sizeof *upper);
    knot *knots = calloc(n, sizeof *knots);
    if (made == NULL || stamps == NULL || upper == NULL || knots == NULL)
    {
        free(made);
        free(stamps);
        free(upper);
        free(knots);
        return CM_ERROR_MEMORY;
    }
    memcpy(stamps, trajectory->stamp, n * sizeof *stamps);
    take_values(trajectory, knots);
    if (n > 2)
    {
        solve(stamps, n, knots, upper);
    }
    free(upper);
    *made = (cm_motion){n, stamps, knots};
    *motion = made;
    return CM_OK;
}

void cm_motion_destroy(cm_motion *motion)
{
    if (motion != NULL)
    {
        free(motion->stamp);
        free(motion->knot);
        free(motion);
    }
}

/* ---- A point of it ---- */

typedef struct curve_point
{
    double value[COMPONENTS];
    double first[COMPONENTS];
    double second[COMPONENTS];
} curve_point;

static void find_point(const cm_motion *motion, double time, curve_point *at)
{
    const size_t i = cm_stamp_before(motion->stamp, motion->count, time);
    const knot *from = &motion->knot[i];
    memset(at, 0, sizeof *at);
    if (motion->count == 1)
    {
        memcpy(at->value, from->value, sizeof at->value);
        return;
    }
    /* the end belongs to the last piece */
    from -= i + 1 == motion->count;
    const double *stamp = motion->stamp + (from - motion->knot);
    const double h = stamp[1] - stamp[0];
    const double a = (stamp[1] - time) / h;
    const double b = (time - stamp[0]) / h;
    for (int c = 0; c < COMPONENTS; c++)
    {
        const double y = from[0].value[c];
        const double z = from[1].value[c];
        const double m = from[0].second[c];
        const double n = from[1].second[c];
        at->value[c] = a * y + b * z + ((a * a * a - a) * m + (b * b * b - b) * n) * (h * h / 6.0);
        at->first[c] =
            (z - y) / h + ((1.0 - 3.0 * a * a) * m + (3.0 * b * b - 1.0) * n) * (h / 6.0);
        at->second[c] = a * m + b * n;
    }
}

/* The angular velocity in the camera's axes is twice the vector of q^-1 dq/dt; what normalising changes is along q. */
static void find_rate(const double q[4], const double dq[4], double square, double rate[3])
{
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        rate[i] = 2.0 * (q[3] * dq[i] - dq[3] * q[i] - (q[j] * dq[k] - q[k] * dq[j])) / square;
    }
}

static int is_finite_state(const cm_motion_state *state)
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
    {
        sum += fabs(state->velocity[i]) + fabs(state->acceleration[i]) + fabs(state->rate[i]);
    }
    return sum < (double)INFINITY;
}

cm_status cm_motion_at(const cm_motion *motion, double time, cm_motion_state *state)
{
    if (motion == NULL || state == NULL || state->size != sizeof *state)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(time >= motion->stamp[0] && time <= motion->stamp[motion->count - 1]))
    {
        return CM_ERROR_RANGE;
    }
    curve_point at;
    find_point(motion, time, &at);
    double square = 0.0;
    for (int c = 3; c < COMPONENTS; c++)
    {
        square += at.value[c] * at.value[c];
    }
    if (!(square >= 1e-6 && square < (double)INFINITY))
    {
        return CM_ERROR_CAMERA;
    }
    cm_motion_state made = {.size = sizeof made};
    double quaternion[4];
    for (int c = 0; c < 4; c++)
    {
        quaternion[c] = at.value[3 + c] / sqrt(square);
    }
    const cm_status status = cm_pose_from_quaternion(at.value, quaternion, &made.pose);
    memcpy(made.velocity, at.first, sizeof made.velocity);
    memcpy(made.acceleration, at.second, sizeof made.acceleration);
    find_rate(at.value + 3, at.first + 3, square, made.rate);
    if (status != CM_OK || !is_finite_state(&made))
    {
        return CM_ERROR_CAMERA;
    }
    *state = made;
    return CM_OK;
}

void cm_motion_span(const cm_motion *motion, double *first, double *last)
{
    *first = motion->stamp[0];
    *last = motion->stamp[motion->count - 1];
}
