/* SPDX-License-Identifier: MIT
 *
 * The measure itself, over points or along edges, and following it downhill.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_mask.h"
#include "orient_field.h"
#include "orient_edges.h"
#include "orient_value.h"

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = CM_BLOCK,
    WAYS = 26, /* that a descent tries */
    STEPS_MAX = 10000,
    PASSES_MAX = 4 /* of a descent */
};

typedef struct sums
{
    double value;
    double weight;
} sums;

typedef struct survey
{
    const cm_orient_task *task;
    const cm_orient_points *points;
    const cm_rotation *rotation;
    sums *block; /* one for each BLOCK points, so that the sum does not depend on threads */
} survey;

static void sum_field(const survey *s, size_t begin, size_t count, sums *to)
{
    double x[BLOCK], y[BLOCK], z[BLOCK], field[BLOCK], scale[BLOCK];
    x[0] = y[0] = z[0] = 0.0; /* there is one at least, which gcc does not know */
    for (size_t i = 0; i < count; i++)
    {
        const size_t k = begin + i;
        double d[3] = {(double)s->points->x[k], (double)s->points->y[k], (double)s->points->z[k]};
        cm_rotate(s->rotation, d, d);
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
    }
    cm_field_values(s->task, count, x, y, z, field, scale);
    for (size_t i = 0; i < count; i++)
    {
        /* the corners of some maps have no value */
        if (isfinite(field[i]) && isfinite(scale[i]))
        {
            const double weight = (double)s->points->weight[begin + i] * scale[i];
            to->value += weight * field[i];
            to->weight += weight;
        }
    }
}

static void sum_blocks(size_t begin, size_t end, void *user)
{
    const survey *s = user;
    for (size_t block = begin; block < end; block++)
    {
        const size_t first = block * BLOCK;
        const size_t left = s->points->count - first;
        const size_t count = left < BLOCK ? left : BLOCK;
        sums sum = {0.0, 0.0};
        sum_field(s, first, count, &sum);
        s->block[block] = sum;
    }
}

double cm_task_value(const cm_orient_task *task, const cm_orient_points *points,
                     const cm_rotation *rotation)
{
    if (task->measure == CM_ORIENT_EDGES)
    {
        return cm_edges_over_mask(task, rotation) / (task->largest * task->edges_length);
    }
    const size_t blocks = (points->count + BLOCK - 1) / BLOCK;
    survey s = {task, points, rotation, malloc(blocks * sizeof(sums))};
    sums whole = {0.0, 0.0};
    if (s.block == NULL)
    {
        return (double)NAN;
    }
    cm_run_threads(task->threads, blocks, 64, sum_blocks, &s);
    for (size_t i = 0; i < blocks; i++)
    {
        whole.value += s.block[i].value;
        whole.weight += s.block[i].weight;
    }
    free(s.block);
    return whole.weight > 0.0 ? whole.value / whole.weight : (double)INFINITY;
}

/* turned on by an angle about an axis, in terms of the cube */
static cm_quaternion turned(const cm_quaternion *from, const double axis[3], double angle)
{
    const double sine = sin(0.5 * angle);
    const cm_quaternion turn = {{cos(0.5 * angle), sine * axis[0], sine * axis[1], sine * axis[2]}};
    cm_quaternion to = cm_quaternion_product(&turn, from);
    double square = 0.0;
    for (int i = 0; i < 4; i++)
    {
        square += to.q[i] * to.q[i];
    }
    for (int i = 0; i < 4; i++)
    {
        to.q[i] /= sqrt(square);
    }
    return to;
}

/* Axes and diagonals between two or three of them, both ways, turned about an axis by so many radians: what is
 * rough or has a crease is not followed by the same few ways only. */
static void find_ways(int turns, double way[WAYS][3])
{
    const double half = 0.5 * turns;
    const double sine = sin(half) / sqrt(14.0);
    const cm_quaternion turn = {{cos(half), sine, 2.0 * sine, 3.0 * sine}};
    cm_rotation rotation;
    cm_matrix_from_quaternion(&turn, &rotation);
    int next = 0;
    for (int k = 0; k < 27; k++)
    {
        const double d[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (length > 0.0)
        {
            cm_rotate(&rotation, d, way[next]);
            for (int i = 0; i < 3; i++)
            {
                way[next][i] /= length;
            }
            next++;
        }
    }
}

typedef struct descent
{
    cm_orient_function function;
    const void *of;
    cm_quaternion *at;
    double value;
    int steps; /* so far */
} descent;

/* As far as it gets better along one way, by strides that double. How often it did. */
static int go(descent *d, const double way[3], double step)
{
    int gone = 0;
    int more = 1;
    for (double stride = step; more && stride <= 32.0 * step; stride *= 2.0)
    {
        const cm_quaternion next = turned(d->at, way, stride);
        const double there = d->function(d->of, &next);
        more = there < d->value && ++d->steps < STEPS_MAX;
        if (more)
        {
            *d->at = next;
            gone++;
        }
        /* nothing is less than NaN, then */
        d->value = more || isnan(there) ? there : d->value;
    }
    return gone;
}

double cm_descend(cm_orient_function function, const void *of, double step, double least,
                  cm_quaternion *rotation)
{
    descent d = {function, of, rotation, function(of, rotation), 0};
    int turns = 0;
    double before = (double)INFINITY;
    for (int pass = 0; pass < PASSES_MAX && d.value < before; pass++)
    {
        before = d.value;
        for (double now = step; now >= least;)
        {
            double way[WAYS][3];
            int gone = 0;
            find_ways(turns++, way);
            for (int i = 0; i < WAYS; i++)
            {
                gone += go(&d, way[i], now);
            }
            now = gone == 0 ? 0.5 * now : now;
        }
    }
    return d.value;
}

/* ---- All about ---- */

typedef struct surroundings
{
    cm_orient_function function;
    const void *of;
    cm_quaternion middle;
    double step;
    int steps;
    double *value; /* at the nodes of a grid of 2 steps + 1 along each axis */
} surroundings;

static cm_quaternion node_about(const surroundings *s, int node)
{
    const int side = 2 * s->steps + 1;
    const double d[3] = {node % side - s->steps, node / side % side - s->steps,
                         node / side / side - s->steps};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double least = fmax(length, 1.0); /* of the middle there is no axis */
    const double axis[3] = {d[0] / least, d[1] / least, d[2] / least};
    return turned(&s->middle, axis, length * s->step);
}

static void value_about(size_t begin, size_t end, void *user)
{
    const surroundings *s = user;
    for (size_t i = begin; i < end; i++)
    {
        const cm_quaternion at = node_about(s, (int)i);
        s->value[i] = s->function(s->of, &at);
    }
}

/* Of equal nodes the first is less. */
static int is_bottom(const surroundings *s, int node)
{
    const int side = 2 * s->steps + 1;
    const int at[3] = {node % side, node / side % side, node / side / side};
    for (int k = 0; k < 27; k++)
    {
        const int to[3] = {at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1};
        int inside = 1;
        for (int i = 0; i < 3; i++)
        {
            inside = inside && to[i] >= 0 && to[i] < side;
        }
        const int other = (to[2] * side + to[1]) * side + to[0];
        if (inside && (s->value[other] < s->value[node] ||
                       (s->value[other] == s->value[node] && other < node)))
        {
            return 0;
        }
    }
    return 1;
}

/* The bottom that is next in value, -1 if there is none; it is taken out. */
static int take_bottom(const surroundings *s, char *bottom, int count)
{
    int best = -1;
    for (int i = 0; i < count; i++)
    {
        best = bottom[i] && (best < 0 || s->value[i] < s->value[best]) ? i : best;
    }
    if (best >= 0)
    {
        bottom[best] = 0;
    }
    return best;
}

double cm_look_about(cm_orient_function function, const void *of, unsigned threads,
                     const cm_orient_grid *grid, cm_quaternion *rotation)
{
    const int side = 2 * grid->steps + 1;
    const int count = side * side * side;
    double value = function(of, rotation);
    surroundings s = {function,   of,          *rotation,
                      grid->step, grid->steps, malloc((size_t)count * (sizeof *s.value + 1))};
    if (s.value == NULL)
    {
        return (double)NAN;
    }
    char *bottom = (char *)(s.value + count);
    cm_run_threads(threads, (size_t)count, 64, value_about, &s);
    for (int i = 0; i < count; i++)
    {
        bottom[i] = (char)is_bottom(&s, i);
    }
    for (int k = 0; k < grid->bottoms && !isnan(value); k++)
    {
        const int next = take_bottom(&s, bottom, count);
        if (next < 0)
        {
            break;
        }
        cm_quaternion at = node_about(&s, next);
        const double there = cm_descend(function, of, 0.5 * grid->step, grid->least, &at);
        *rotation = there < value ? at : *rotation;
        value = there < value || isnan(there) ? there : value;
    }
    free(s.value);
    return value;
}
