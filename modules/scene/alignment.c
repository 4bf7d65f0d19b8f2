/* SPDX-License-Identifier: MIT
 *
 * The best rigid motion between points: the rotation is the unit quaternion that belongs to the greatest eigenvalue of a
 * symmetric matrix (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions").
 */
#include <cubemap/trajectory.h>

#include <float.h>
#include <math.h>
#include <string.h>

/* Positions beyond have no squares, or none whose sums have. */
#define FARTHEST 1e100

typedef struct moments
{
    double from[3]; /* means */
    double to[3];
    double cross[3][3]; /* sum of (from - its mean) (to - its mean)^T */
    double most;        /* of the coordinates */
} moments;

static int gather(size_t n, const double *from, const double *to, moments *m)
{
    memset(m, 0, sizeof *m);
    for (size_t i = 0; i < 3 * n; i++)
    {
        if (!(fabs(from[i]) <= FARTHEST && fabs(to[i]) <= FARTHEST))
        {
            return 0;
        }
        m->most = fmax(m->most, fmax(fabs(from[i]), fabs(to[i])));
        m->from[i % 3] += (from[i] - m->from[i % 3]) / (double)(i / 3 + 1);
        m->to[i % 3] += (to[i] - m->to[i % 3]) / (double)(i / 3 + 1);
    }
    for (size_t i = 0; i < 3 * n; i++)
    {
        const double *partner = to + i / 3 * 3;
        for (int k = 0; k < 3; k++)
        {
            m->cross[i % 3][k] += (from[i] - m->from[i % 3]) * (partner[k] - m->to[k]);
        }
    }
    return 1;
}

/* Horn's matrix, for quaternions w x y z. */
static void make_matrix(const moments *m, double n[4][4])
{
    const double(*s)[3] = m->cross;
    n[0][0] = s[0][0] + s[1][1] + s[2][2];
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        n[0][i + 1] = s[j][k] - s[k][j];
        n[i + 1][0] = n[0][i + 1];
        n[i + 1][i + 1] = s[i][i] - s[j][j] - s[k][k];
        n[i + 1][j + 1] = s[i][j] + s[j][i];
        n[j + 1][i + 1] = n[i + 1][j + 1];
    }
}

/* Turn rows and columns p and q so that n[p][q] is 0 (Jacobi 1846; Golub and Van Loan 2013, 8.5.2). */
static void turn_pair(double n[4][4], double vectors[4][4], int p, int q)
{
    if (n[p][q] == 0.0)
    {
        return;
    }
    const double ratio = (n[q][q] - n[p][p]) / (2.0 * n[p][q]);
    const double t = copysign(1.0, ratio) / (fabs(ratio) + hypot(1.0, ratio));
    const double c = 1.0 / sqrt(1.0 + t * t);
    const double s = t * c;
    for (int k = 0; k < 4; k++)
    {
        const double a = n[k][p];
        const double b = n[k][q];
        n[k][p] = c * a - s * b;
        n[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 4; k++)
    {
        const double a = n[p][k];
        const double b = n[q][k];
        n[p][k] = c * a - s * b;
        n[q][k] = s * a + c * b;
        const double x = vectors[k][p];
        const double y = vectors[k][q];
        vectors[k][p] = c * x - s * y;
        vectors[k][q] = s * x + c * y;
    }
    n[p][q] = 0.0;
    n[q][p] = 0.0;
}

/* Eigenvalues, the greatest first, and the eigenvectors in the columns. */
static void decompose(double n[4][4], double value[4], double vectors[4][4])
{
    memset(vectors, 0, 16 * sizeof(double));
    for (int i = 0; i < 4; i++)
    {
        vectors[i][i] = 1.0;
    }
    for (int sweep = 0; sweep < 20; sweep++) /* it converges quadratically: five are enough */
    {
        for (int p = 0; p < 3; p++)
        {
            for (int q = p + 1; q < 4; q++)
            {
                turn_pair(n, vectors, p, q);
            }
        }
    }
    for (int i = 0; i < 4; i++)
    {
        value[i] = n[i][i];
    }
    for (int i = 0; i < 3; i++)
    {
        for (int k = i + 1; k < 4; k++)
        {
            if (value[k] > value[i])
            {
                const double swapped = value[i];
                value[i] = value[k];
                value[k] = swapped;
                for (int r = 0; r < 4; r++)
                {
                    const double component = vectors[r][i];
                    vectors[r][i] = vectors[r][k];
                    vectors[r][k] = component;
                }
            }
        }
    }
}

/* The eigenvalues are s0 + s1 + s2, s0 - s1 - s2, -s0 + s1 - s2 and -s0 - s1 + s2, with the singular values s of the cross
 * covariance, the last with the sign of its determinant; s1 + s2 = 0 is a second quaternion that is as good. */
static void judge(const double value[4], double noise, int *rank, int *is_determined)
{
    const double s0 = 0.5 * (value[0] + value[1]);
    const double s1 = 0.5 * (value[0] + value[2]);
    const double s2 = 0.5 * (value[0] + value[3]);
    const double least = 1e-12 * s0 + noise;
    if (rank != NULL)
    {
        *rank = (s0 > noise) + (s1 > least) + (fabs(s2) > least);
    }
    if (is_determined != NULL)
    {
        *is_determined = s0 > noise && s1 + s2 > least;
    }
}

static void make_motion(const moments *m, double vectors[4][4], cm_pose *motion)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    const double quaternion[4] = {vectors[1][0], vectors[2][0], vectors[3][0], vectors[0][0]};
    double turned[3];
    cm_pose_from_quaternion(origin, quaternion, motion);
    cm_pose_apply_back(motion, m->from, turned);
    for (int i = 0; i < 3; i++)
    {
        motion->position[i] = m->to[i] - turned[i];
    }
}

cm_status cm_pose_align(size_t n, const double *from, const double *to, cm_pose *motion, int *rank,
                        int *is_determined)
{
    if (n == 0 || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    moments m;
    double matrix[4][4];
    double value[4];
    double vectors[4][4];
    if (!gather(n, from, to, &m))
    {
        return CM_ERROR_RANGE;
    }
    make_matrix(&m, matrix);
    decompose(matrix, value, vectors);
    /* what rounding of coordinates makes of points in one place */
    const double rounding = 16.0 * DBL_EPSILON * m.most;
    judge(value, (double)n * rounding * rounding, rank, is_determined);
    if (motion != NULL)
    {
        make_motion(&m, vectors, motion);
    }
    return CM_OK;
}
