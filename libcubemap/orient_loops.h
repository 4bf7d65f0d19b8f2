/* SPDX-License-Identifier: MIT
 *
 * The sums of orient_bound.c for one instruction set, which vectorises plain C; read by batch_set.h. Four points in a
 * row have sums of their own, so that every set, which leaves sums in their order, has the same bits.
 */
#include "orient.h"

enum
{
    ORIENT_BLOCK = 256,
    ORIENT_SUMS = 4
};

/* The points of a block turned, times their weights, behind these; and the numbers of their pieces, which floats hold
 * exactly (cm_table_make). */
static void orient_turn(const cm_orient_points *points, size_t begin, size_t count,
                        const float m[9], unsigned side, float (*turned)[4], int *index)
{
    const float half = 0.5f * (float)side;
    const float bend = (float)CM_TABLE_BEND;
    const float last = (float)side - 1.0f;
    const float *px = points->x + begin;
    const float *py = points->y + begin;
    const float *pz = points->z + begin;
    const float *w = points->weight + begin;
    for (size_t i = 0; i < count; i++)
    {
        const float a = m[0] * px[i] + m[1] * py[i] + m[2] * pz[i];
        const float b = m[3] * px[i] + m[4] * py[i] + m[5] * pz[i];
        const float c = m[6] * px[i] + m[7] * py[i] + m[8] * pz[i];
        turned[i][0] = w[i];
        turned[i][1] = w[i] * a;
        turned[i][2] = w[i] * b;
        turned[i][3] = w[i] * c;
        const float aa = fabsf(a);
        const float ab = fabsf(b);
        const float ac = fabsf(c);
        const float most_bc = ab >= ac ? ab : ac;
        const float most = aa >= most_bc ? aa : most_bc;
        /* the face's axis, then the two others in order */
        const float major = aa >= most_bc ? a : ab >= ac ? b : c;
        const float second = aa >= most_bc ? b : ab >= ac ? c : a;
        const float third = aa >= most_bc ? c : ab >= ac ? a : b;
        const float face = (aa >= most_bc ? 0.0f
                            : ab >= ac    ? 2.0f
                                          : 4.0f) +
                           (major < 0.0f ? 1.0f : 0.0f);
        const float p = second / most;
        const float q = third / most;
        const float u = p * (1.0f + bend - bend * fabsf(p));
        const float v = q * (1.0f + bend - bend * fabsf(q));
        const float row = (float)(int)((u + 1.0f) * half);
        const float column = (float)(int)((v + 1.0f) * half);
        index[i] = (int)((face * (float)side + (row < last ? row : last)) * (float)side +
                         (column < last ? column : last));
    }
}

/* Adds (1, V) . (base, G) of a point to its four sums, and V x G to three more. */
static inline void orient_add(float value[4], float torque[4], const float v[4],
                              const cm_orient_piece *piece)
{
    const float g[4] = {piece->base, piece->x, piece->y, piece->z};
    for (int k = 0; k < 4; k++)
    {
        value[k] += v[k] * g[k];
    }
    if (torque != NULL)
    {
        const float product[4] = {0.0f, v[2] * g[3] - v[3] * g[2], v[3] * g[1] - v[1] * g[3],
                                  v[1] * g[2] - v[2] * g[1]};
        for (int k = 0; k < 4; k++)
        {
            torque[k] += product[k];
        }
    }
}

static inline void orient_add_all(const cm_orient_points *points, const cm_orient_table *table,
                                  const float m[9], int has_torque, double *value, double torque[3])
{
    float turned[ORIENT_BLOCK][4];
    int index[ORIENT_BLOCK];
    for (size_t begin = 0; begin < points->count; begin += ORIENT_BLOCK)
    {
        const size_t left = points->count - begin;
        const size_t count = left < ORIENT_BLOCK ? left : ORIENT_BLOCK;
        float values[ORIENT_SUMS][4] = {{0.0f}};
        float torques[ORIENT_SUMS][4] = {{0.0f}};
        orient_turn(points, begin, count, m, table->side, turned, index);
        size_t i = 0;
        for (; i + ORIENT_SUMS <= count; i += ORIENT_SUMS)
        {
            for (size_t k = 0; k < ORIENT_SUMS; k++)
            {
                orient_add(values[k], has_torque ? torques[k] : NULL, turned[i + k],
                           &table->piece[index[i + k]]);
            }
        }
        for (size_t k = 0; i < count; i++, k++)
        {
            orient_add(values[k], has_torque ? torques[k] : NULL, turned[i],
                       &table->piece[index[i]]);
        }
        for (size_t k = 0; k < ORIENT_SUMS; k++)
        {
            for (size_t n = 0; n < 4; n++)
            {
                *value += (double)values[k][n];
            }
            for (size_t n = 0; n < 3 && has_torque; n++)
            {
                torque[n] += (double)torques[k][n + 1];
            }
        }
    }
}

static double orient_sum(const cm_orient_points *points, const cm_orient_table *table,
                         const float m[9], double *torque)
{
    double sum = 0.0;
    if (torque == NULL)
    {
        orient_add_all(points, table, m, 0, &sum, NULL);
        return sum;
    }
    torque[0] = torque[1] = torque[2] = 0.0;
    orient_add_all(points, table, m, 1, &sum, torque);
    return sum;
}
