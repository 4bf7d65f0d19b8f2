/* SPDX-License-Identifier: MIT
 *
 * The bound of a box of rotations. Be P a point turned to the middle of the box, C the middle of the table's piece
 * that it is in, and f(Q) >= A + G . (Q - C) - e for all Q within reach of C (the table). For
 * directions q about P with the weighted mean V, |V| <= 1, turned on by an angle t about an axis n,
 *   sum w f(q) >= A - G . C - e + G . V',   V' = V + sin t (n x V) + (1 - cos t) n x (n x V),
 * whose last part is at most (1 - cos t) |G| and in the table's base; and G . (n x V) = n . (V x G). So
 * the sums of base + G . V and of V x G are all that is needed, and sin t n . g over the box is no less than
 * twice the least T . g over its corners T = tan(t/2) n, or 0.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_bound.h"

#include <math.h>
#include <stdlib.h>

/* One at least: a mask has a pixel that counts, an edge a piece. */
int cm_points_make(cm_orient_points *points, size_t count)
{
    float *all = malloc(count * 4 * sizeof *all);
    *points = (cm_orient_points){.count = count, .x = all};
    if (all != NULL)
    {
        points->y = all + count;
        points->z = all + 2 * count;
        points->weight = all + 3 * count;
    }
    return all != NULL;
}

void cm_points_free(cm_orient_points *points)
{
    free(points->x);
    *points = (cm_orient_points){.count = 0};
}

int cm_table_make(cm_orient_table *table, unsigned side)
{
    *table = (cm_orient_table){.side = side};
    table->piece = malloc(sizeof *table->piece * 6 * side * side);
    if (table->piece == NULL)
    {
        return 0;
    }
    /* the largest are those in the middle of an edge or of the face: all of them are looked at */
    for (unsigned k = 0; k < side * side; k++)
    {
        double middle[3], corner[3], square = 0.0;
        const double i = k / side;
        const double j = k % side;
        cm_table_direction(0, (2.0 * i + 1.0) / side - 1.0, (2.0 * j + 1.0) / side - 1.0, middle);
        for (int c = 0; c < 4; c++)
        {
            square = 0.0;
            cm_table_direction(0, 2.0 * (i + c % 2) / side - 1.0, 2.0 * (j + c / 2) / side - 1.0,
                               corner);
            for (int n = 0; n < 3; n++)
            {
                square += (middle[n] - corner[n]) * (middle[n] - corner[n]);
            }
            const double angle = 2.0 * asin(0.5 * sqrt(square));
            table->half_diagonal = angle > table->half_diagonal ? angle : table->half_diagonal;
        }
    }
    return 1;
}

void cm_table_free(cm_orient_table *table)
{
    free(table->piece);
    *table = (cm_orient_table){.side = 0};
}

void cm_table_direction(unsigned face, double u, double v, double direction[3])
{
    const double p = cm_table_tangent(u);
    const double q = cm_table_tangent(v);
    const double length = sqrt(1.0 + p * p + q * q);
    const unsigned axis = face / 2;
    direction[axis] = (face % 2 == 0 ? 1.0 : -1.0) / length;
    direction[(axis + 1) % 3] = p / length;
    direction[(axis + 2) % 3] = q / length;
}

void cm_table_middle(unsigned side, unsigned piece, double direction[3])
{
    const double row = piece / side % side;
    const double column = piece % side;
    cm_table_direction(piece / side / side, (2.0 * row + 1.0) / side - 1.0,
                       (2.0 * column + 1.0) / side - 1.0, direction);
}

int cm_table_locate(const double d[3], unsigned side)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
    {
        axis = fabs(d[i]) > fabs(d[axis]) ? i : axis;
    }
    int at[2];
    for (int i = 0; i < 2; i++)
    {
        const double p = d[(axis + 1 + i) % 3] / fabs(d[axis]);
        const double u = p * (1.0 + CM_TABLE_BEND - CM_TABLE_BEND * fabs(p));
        at[i] = (int)((u + 1.0) * 0.5 * side);
        at[i] = at[i] < (int)side ? at[i] : (int)side - 1;
    }
    return ((2 * axis + (d[axis] < 0.0)) * (int)side + at[0]) * (int)side + at[1];
}

static void find_turn(const cm_quaternion *at, int back, float turn[9])
{
    cm_rotation rotation;
    cm_matrix_from_quaternion(at, &rotation);
    for (int i = 0; i < 9; i++)
    {
        turn[i] = (float)(back ? rotation.row[i % 3][i / 3] : rotation.row[i / 3][i % 3]);
    }
}

double cm_orient_sum(const cm_batch_set *set, const cm_orient_points *points,
                     const cm_orient_table *table, int back, const cm_quaternion *at)
{
    float turn[9];
    find_turn(at, back, turn);
    return set->orient_sum(points, table, turn, NULL);
}

double cm_orient_bound(const cm_batch_set *set, const cm_orient_points *points,
                       const cm_orient_table *table, int back, const cm_box_shape *shape)
{
    float turn[9];
    double torque[3];
    double least = 0.0;
    find_turn(&shape->centre, back, turn);
    const double sum = set->orient_sum(points, table, turn, torque);
    for (int c = 0; c < 8; c++)
    {
        const double *t = shape->corner[c];
        const double there = 2.0 * (t[0] * torque[0] + t[1] * torque[1] + t[2] * torque[2]);
        least = there < least ? there : least;
    }
    return sum + least;
}
