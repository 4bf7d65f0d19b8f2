/* SPDX-License-Identifier: MIT
 *
 * Boxes of rotations. A cube of four-dimensional space around quaternions, of which opposite ones are the same
 * rotation: four of its eight sides, each with tangents as coordinates, cover all rotations. A box of such
 * coordinates is a convex body of the sphere of quaternions, so what is farthest in it from anywhere is a
 * corner, and on which side of a great sphere all of it lies, its corners say.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_boxes.h"

#include <math.h>
#include <stdlib.h>

cm_quaternion cm_quaternion_product(const cm_quaternion *a, const cm_quaternion *b)
{
    const double *p = a->q;
    const double *q = b->q;
    return (cm_quaternion){{p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
                            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
                            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]}};
}

static cm_quaternion conjugate(const cm_quaternion *a)
{
    return (cm_quaternion){{a->q[0], -a->q[1], -a->q[2], -a->q[3]}};
}

void cm_matrix_from_quaternion(const cm_quaternion *from, cm_rotation *to)
{
    const double *q = from->q;
    const double n = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = n * q[1];
    const double y = n * q[2];
    const double z = n * q[3];
    *to = (cm_rotation){{{1.0 - (y * q[2] + z * q[3]), x * q[2] - z * q[0], x * q[3] + y * q[0]},
                         {x * q[2] + z * q[0], 1.0 - (x * q[1] + z * q[3]), y * q[3] - x * q[0]},
                         {x * q[3] - y * q[0], y * q[3] + x * q[0], 1.0 - (x * q[1] + y * q[2])}}};
}

/* From the largest of its components, so that nothing cancels (Shepperd 1978). */
void cm_quaternion_from_matrix(const cm_rotation *from, cm_quaternion *to)
{
    const double(*m)[3] = from->row;
    const double square[4] = {1.0 + m[0][0] + m[1][1] + m[2][2], 1.0 + m[0][0] - m[1][1] - m[2][2],
                              1.0 - m[0][0] + m[1][1] - m[2][2], 1.0 - m[0][0] - m[1][1] + m[2][2]};
    int largest = 0;
    for (int i = 1; i < 4; i++)
    {
        largest = square[i] > square[largest] ? i : largest;
    }
    const double a[4][4] = {{square[0], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
                            {m[2][1] - m[1][2], square[1], m[0][1] + m[1][0], m[0][2] + m[2][0]},
                            {m[0][2] - m[2][0], m[0][1] + m[1][0], square[2], m[1][2] + m[2][1]},
                            {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], square[3]}};
    double length = 0.0;
    for (int i = 0; i < 4; i++)
    {
        length += a[largest][i] * a[largest][i];
    }
    for (int i = 0; i < 4; i++)
    {
        to->q[i] = a[largest][i] / sqrt(length);
    }
}

/* Permutations of the axes with signs whose determinant is 1; the identity is the first of them. */
void cm_all_symmetries(cm_symmetries *all)
{
    all->count = 0;
    for (int n = 0; n < 6 * 8; n++)
    {
        static const int permutation[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                              {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        cm_rotation turn = {{{0.0}}};
        double determinant = n % 6 < 3 ? 1.0 : -1.0;
        for (int i = 0; i < 3; i++)
        {
            const double sign = (n / 6 >> i & 1) != 0 ? -1.0 : 1.0;
            turn.row[i][permutation[n % 6][i]] = sign;
            determinant *= sign;
        }
        if (determinant > 0.0)
        {
            cm_quaternion_from_matrix(&turn, &all->turn[all->count++]);
        }
    }
}

double cm_rotations_apart(const cm_quaternion *a, const cm_quaternion *b,
                          const cm_symmetries *symmetries)
{
    /* the largest scalar part of turn a b' is the least angle */
    const cm_quaternion back = conjugate(b);
    const cm_quaternion between = cm_quaternion_product(a, &back);
    cm_quaternion nearest = between;
    for (unsigned i = 1; i < symmetries->count; i++)
    {
        const double *t = symmetries->turn[i].q;
        const double scalar =
            t[0] * between.q[0] - t[1] * between.q[1] - t[2] * between.q[2] - t[3] * between.q[3];
        if (fabs(scalar) > fabs(nearest.q[0]))
        {
            nearest = cm_quaternion_product(&symmetries->turn[i], &between);
        }
    }
    const double *q = nearest.q;
    return 2.0 * atan2(sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), fabs(q[0]));
}

/* Of the box's edges: at 0 and 2 its sides, at 1 the middle. */
static double coordinate(const cm_box *box, int i, int at)
{
    const double intervals = (double)(CM_BOXES_ROOT << box->level);
    return tan((((double)box->index[i] + 0.5 * at) / intervals - 0.5) * 1.5707963267948966);
}

/* Not of unit length. */
static cm_quaternion place(const cm_box *box, const int at[3])
{
    cm_quaternion result;
    int next = 0;
    for (int i = 0; i < 4; i++)
    {
        result.q[i] = 1.0;
        if (i != box->axis)
        {
            result.q[i] = coordinate(box, next, at[next]);
            next++;
        }
    }
    return result;
}

/* All eight, between the tangents of its ends. */
static void put_corners(uint8_t axis, const double low[3], const double high[3],
                        cm_quaternion corner[8])
{
    for (unsigned c = 0; c < 8; c++)
    {
        unsigned next = 0;
        for (unsigned i = 0; i < 4; i++)
        {
            corner[c].q[i] = i == axis ? 1.0 : (c >> next & 1) != 0 ? high[next] : low[next];
            next += i != axis;
        }
    }
}

/* Of tangents, which cost most, each is taken once. */
static void find_corners(const cm_box *box, cm_quaternion corner[8])
{
    double low[3];
    double high[3];
    for (int i = 0; i < 3; i++)
    {
        low[i] = coordinate(box, i, 0);
        high[i] = coordinate(box, i, 2);
    }
    put_corners(box->axis, low, high, corner);
}

void cm_box_find_shape(const cm_box *box, cm_box_shape *shape)
{
    static const int middle[3] = {1, 1, 1};
    shape->centre = place(box, middle);
    const cm_quaternion back = conjugate(&shape->centre);
    cm_quaternion corner[8];
    find_corners(box, corner);
    double largest = 0.0;
    for (int c = 0; c < 8; c++)
    {
        const cm_quaternion turn = cm_quaternion_product(&corner[c], &back);
        double square = 0.0;
        for (int i = 0; i < 3; i++)
        {
            shape->corner[c][i] = turn.q[i + 1] / turn.q[0];
            square += shape->corner[c][i] * shape->corner[c][i];
        }
        largest = square > largest ? square : largest;
    }
    shape->radius = 2.0 * atan(sqrt(largest));
    double length = 0.0;
    for (int i = 0; i < 4; i++)
    {
        length += shape->centre.q[i] * shape->centre.q[i];
    }
    for (int i = 0; i < 4; i++)
    {
        shape->centre.q[i] /= sqrt(length);
    }
}

/* Are all corners nearer to that turn, or all to its opposite, than to none? The first, which is so of few, says to which. */
static int is_nearer(const cm_quaternion corner[8], const double t[4])
{
    const double slack = 1e-9;
    double sign = 0.0;
    for (int c = 0; c < 8; c++)
    {
        const double *q = corner[c].q;
        const double scalar = t[0] * q[0] - t[1] * q[1] - t[2] * q[2] - t[3] * q[3];
        sign = c > 0 ? sign : scalar < 0.0 ? -1.0 : 1.0;
        if (!(sign * scalar > fabs(q[0]) + slack))
        {
            return 0;
        }
    }
    return 1;
}

static int are_spare(const cm_quaternion corner[8], const cm_symmetries *symmetries)
{
    unsigned i = 1;
    while (i < symmetries->count && !is_nearer(corner, symmetries->turn[i].q))
    {
        i++;
    }
    return i < symmetries->count;
}

int cm_box_is_spare(const cm_box *box, const cm_symmetries *symmetries)
{
    cm_quaternion corner[8];
    find_corners(box, corner);
    return are_spare(corner, symmetries);
}

int cm_boxes_make(cm_boxes *boxes, const cm_symmetries *symmetries)
{
    const size_t all = (size_t)4 * CM_BOXES_ROOT * CM_BOXES_ROOT * CM_BOXES_ROOT;
    /* the tangents of all boxes' ends */
    double end[CM_BOXES_ROOT + 1];
    for (uint16_t i = 0; i <= CM_BOXES_ROOT; i++)
    {
        const cm_box box = {0, 0, {i, 0, 0}};
        end[i] = coordinate(&box, 0, 0);
    }
    *boxes = (cm_boxes){malloc(all * sizeof *boxes->box), 0};
    for (size_t i = 0; i < all && boxes->box != NULL; i++)
    {
        const cm_box box = {(uint8_t)(i % 4),
                            0,
                            {(uint16_t)(i / 4 % CM_BOXES_ROOT),
                             (uint16_t)(i / 4 / CM_BOXES_ROOT % CM_BOXES_ROOT),
                             (uint16_t)(i / 4 / CM_BOXES_ROOT / CM_BOXES_ROOT)}};
        const uint16_t *at = box.index;
        const double low[3] = {end[at[0]], end[at[1]], end[at[2]]};
        const double high[3] = {end[at[0] + 1], end[at[1] + 1], end[at[2] + 1]};
        cm_quaternion corner[8];
        put_corners(box.axis, low, high, corner);
        if (!are_spare(corner, symmetries))
        {
            boxes->box[boxes->count++] = box;
        }
    }
    return boxes->box != NULL;
}

int cm_boxes_split(cm_boxes *boxes, const cm_symmetries *symmetries)
{
    cm_box *parts = malloc(boxes->count * 8 * sizeof *parts);
    size_t count = 0;
    for (size_t i = 0; i < 8 * boxes->count && parts != NULL; i++)
    {
        cm_box part = boxes->box[i / 8];
        part.level++;
        for (unsigned k = 0; k < 3; k++)
        {
            part.index[k] = (uint16_t)(2u * part.index[k] + (i >> k & 1u));
        }
        if (!cm_box_is_spare(&part, symmetries))
        {
            parts[count++] = part;
        }
    }
    if (parts == NULL)
    {
        return 0;
    }
    free(boxes->box);
    *boxes = (cm_boxes){parts, count};
    return 1;
}

/* ---- Neighbours ---- */

static int compare_boxes(const void *a, const void *b)
{
    const cm_box *first = a;
    const cm_box *second = b;
    int difference = (int)first->axis - (int)second->axis;
    for (int i = 0; i < 3 && difference == 0; i++)
    {
        difference = (int)first->index[i] - (int)second->index[i];
    }
    return difference;
}

void cm_boxes_sort(cm_boxes *boxes)
{
    qsort(boxes->box, boxes->count, sizeof *boxes->box, compare_boxes);
}

static cm_box box_about(const cm_quaternion *turn, uint8_t level)
{
    const double intervals = (double)(CM_BOXES_ROOT << level);
    cm_box box = {.level = level};
    for (uint8_t i = 1; i < 4; i++)
    {
        box.axis = fabs(turn->q[i]) > fabs(turn->q[box.axis]) ? i : box.axis;
    }
    int next = 0;
    for (int i = 0; i < 4; i++)
    {
        if (i != box.axis)
        {
            const double angle = atan(turn->q[i] / turn->q[box.axis]) / 1.5707963267948966;
            box.index[next++] = (uint16_t)fmin((angle + 0.5) * intervals, intervals - 1.0);
        }
    }
    return box;
}

size_t cm_boxes_find(const cm_boxes *boxes, const cm_quaternion *turn,
                     const cm_symmetries *symmetries)
{
    const double *q = turn->q;
    double largest = fabs(q[0]);
    unsigned nearest = 0; /* of the symmetries, to none at all */
    for (unsigned i = 1; i < symmetries->count; i++)
    {
        const double *t = symmetries->turn[i].q;
        const double scalar = fabs(t[0] * q[0] - t[1] * q[1] - t[2] * q[2] - t[3] * q[3]);
        nearest = scalar > largest ? i : nearest;
        largest = scalar > largest ? scalar : largest;
    }
    const cm_quaternion like = cm_quaternion_product(&symmetries->turn[nearest], turn);
    const cm_box box = box_about(&like, boxes->box[0].level);
    const cm_box *found =
        bsearch(&box, boxes->box, boxes->count, sizeof *boxes->box, compare_boxes);
    return found == NULL ? boxes->count : (size_t)(found - boxes->box);
}

cm_quaternion cm_box_neighbour(const cm_box *box, const int step[3])
{
    const int at[3] = {1 + 2 * step[0], 1 + 2 * step[1], 1 + 2 * step[2]};
    return place(box, at);
}
