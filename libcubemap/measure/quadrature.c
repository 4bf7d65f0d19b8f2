/* SPDX-License-Identifier: MIT
 *
 * Means of a quantity by adaptive quadrature: each cell of (r, t) by Gauss and Legendre's rule, and again
 * by its four quarters; where the two are apart, the quarters are cells.
 *
 * The corner of a face is another matter: there the area of a conformal mapping grows as the power -2/3 of the
 * distance, and what `difference` has depends on where one comes from. A cell at the corner that halving does not
 * settle is cut in two triangles with Duffy's coordinates, 1 - r = h x^3 and 1 - t = h x^3 y, or t and r swapped
 * (Duffy, Quadrature over a pyramid or cube of integrands with a singularity at a vertex, 1982). Of either kind
 * the integrands are analytic in x and y.
 */
#include "pieces.h"

#include <string.h>

enum
{
    NODES = 10,
    MOMENTS =
        3, /* the integrals of 1, of the value, of the square of its difference from the ideal */
    DEPTH_MOST = 8,
    DEPTH_OF_CORNER = 2 /* a cell there that is not settled is cut otherwise */
};

/* The difference of a cell from its quarters times this is taken as the quarters' error: beside a kink or a
 * singularity they converge so slowly that the rest is more than the last difference. */
#define CAUTION 8.0

/* On [0, 1]; computed with 40 digits. */
static const double node[NODES] = {0.013046735741414139961, 0.067468316655507744634,
                                   0.16029521585048779688,  0.28330230293537640460,
                                   0.42556283050918439456,  0.57443716949081560544,
                                   0.71669769706462359540,  0.83970478414951220312,
                                   0.93253168334449225537,  0.98695326425858586004};
static const double node_weight[NODES] = {0.033335672154344068797, 0.074725674575290296573,
                                          0.10954318125799102200,  0.13463335965499817755,
                                          0.14776211235737643509,  0.14776211235737643509,
                                          0.13463335965499817755,  0.10954318125799102200,
                                          0.074725674575290296573, 0.033335672154344068797};

typedef enum cell_kind
{
    CELL_PLAIN,    /* of r and t */
    CELL_CORNER_R, /* of x and y, with 1 - t = (1 - r) y */
    CELL_CORNER_T  /* of x and y, with 1 - r = (1 - t) y */
} cell_kind;

typedef struct cell
{
    int piece;
    cell_kind kind;
    double corner; /* h, unless it is plain */
    double r;      /* or x */
    double t;      /* or y */
    double size;
} cell;

typedef struct integral
{
    const cm_quadrature *quadrature;
    double tolerance[MOMENTS]; /* of the integral over all pieces */
    double sum[MOMENTS];
    double apart[MOMENTS];
    size_t evaluations;
} integral;

/* Appends the point of a cell's node, and returns du dv over what the cell's coordinates are. */
static double add_node(cm_piece_points *points, const cell *c, int i)
{
    double r = c->r + c->size * node[i / NODES];
    double t = c->t + c->size * node[i % NODES];
    double stretch = 1.0;
    if (c->kind != CELL_PLAIN)
    {
        double x = r;
        double distance = c->corner * x * x * x;
        double other = 1.0 - distance * t;
        r = c->kind == CELL_CORNER_R ? 1.0 - distance : other;
        t = c->kind == CELL_CORNER_R ? other : 1.0 - distance;
        stretch = 3.0 * c->corner * x * x * distance;
    }
    cm_piece_point(points, c->piece, r, t);
    return r * stretch;
}

static void integrate_cell(integral *in, const cell *c, double moment[MOMENTS])
{
    cm_piece_points points;
    double area[NODES * NODES];
    points.count = 0;
    for (int i = 0; i < NODES * NODES; i++)
    {
        area[i] = add_node(&points, c, i);
    }
    cm_quadrature_evaluate(in->quadrature, &points);
    in->evaluations += points.count;
    memset(moment, 0, MOMENTS * sizeof moment[0]);
    for (int i = 0; i < NODES * NODES; i++)
    {
        double weight =
            points.weight[i] * area[i] * node_weight[i / NODES] * node_weight[i % NODES];
        double difference = points.value[i] - in->quadrature->ideal;
        if (isfinite(weight) && isfinite(difference))
        {
            moment[0] += weight;
            moment[1] += weight * points.value[i];
            moment[2] += weight * difference * difference;
        }
    }
    for (int k = 0; k < MOMENTS; k++)
    {
        moment[k] *= c->size * c->size;
    }
}

/* The part of the piece's tolerance that a cell may use. */
static double share_of(const cell *c)
{
    double size = c->kind == CELL_PLAIN ? c->size : c->corner * c->size;
    return size * size;
}

static int is_corner(const cell *c)
{
    return c->kind == CELL_PLAIN && c->r + c->size == 1.0 && c->t + c->size == 1.0;
}

/* whole: the cell's moments by one application of the rule. The cell is replaced by its quarters, or at a corner by
 * two triangles. */
static void integrate(integral *in, const cell *c, const double whole[MOMENTS], int depth);

static void integrate_corner(integral *in, const cell *c)
{
    for (int kind = CELL_CORNER_R; kind <= CELL_CORNER_T; kind++)
    {
        double whole[MOMENTS];
        const cell triangle = {c->piece, (cell_kind)kind, c->size, 0.0, 0.0, 1.0};
        integrate_cell(in, &triangle, whole);
        integrate(in, &triangle, whole, 0);
    }
}

static void integrate(integral *in, const cell *c, const double whole[MOMENTS], int depth)
{
    double part[4][MOMENTS];
    cell quarter[4];
    double apart[MOMENTS];
    int good = 1;
    for (int i = 0; i < 4; i++)
    {
        double half = c->size / 2.0;
        quarter[i] = *c;
        quarter[i].r += (i / 2) * half;
        quarter[i].t += (i % 2) * half;
        quarter[i].size = half;
        integrate_cell(in, &quarter[i], part[i]);
    }
    for (int k = 0; k < MOMENTS; k++)
    {
        apart[k] = fabs(part[0][k] + part[1][k] + part[2][k] + part[3][k] - whole[k]);
        good &= apart[k] <= in->tolerance[k] * share_of(c);
    }
    if (!good && depth == DEPTH_OF_CORNER && is_corner(c))
    {
        integrate_corner(in, c);
        return;
    }
    for (int i = 0; i < 4 && !good && depth < DEPTH_MOST; i++)
    {
        integrate(in, &quarter[i], part[i], depth + 1);
    }
    for (int k = 0; k < MOMENTS && (good || depth == DEPTH_MOST); k++)
    {
        in->sum[k] += part[0][k] + part[1][k] + part[2][k] + part[3][k];
        in->apart[k] += CAUTION * apart[k];
    }
}

static cell whole_of(int piece)
{
    return (cell){piece, CELL_PLAIN, 0.0, 0.0, 0.0, 1.0};
}

void cm_quadrature_integrate(const cm_quadrature *quadrature, double tolerance,
                             cm_statistics *statistics)
{
    integral in = {.quadrature = quadrature};
    double whole[CM_PIECES][MOMENTS];
    double first[MOMENTS] = {0};
    for (int piece = 0; piece < CM_PIECES; piece++)
    {
        cell c = whole_of(piece);
        if (cm_quadrature_has(quadrature, piece))
        {
            integrate_cell(&in, &c, whole[piece]);
            for (int k = 0; k < MOMENTS; k++)
            {
                first[k] += whole[piece][k];
            }
        }
    }
    for (int k = 0; k < MOMENTS; k++)
    {
        /* a mean square as small as rounding makes it need not be accurate */
        double size = fmax(fabs(first[k]), 1e-8 * first[0]);
        in.tolerance[k] = tolerance * size / CM_PIECES;
    }
    for (int piece = 0; piece < CM_PIECES; piece++)
    {
        cell c = whole_of(piece);
        if (cm_quadrature_has(quadrature, piece))
        {
            integrate(&in, &c, whole[piece], 0);
        }
    }
    double square = in.sum[2] / in.sum[0];
    double square_apart = (in.apart[2] + square * in.apart[0]) / in.sum[0];
    statistics->mean = in.sum[1] / in.sum[0];
    statistics->mean_error = (in.apart[1] + fabs(statistics->mean) * in.apart[0]) / in.sum[0];
    statistics->rmse = sqrt(square);
    statistics->rmse_error = sqrt(square + square_apart) - statistics->rmse;
    statistics->evaluations += in.evaluations;
}
