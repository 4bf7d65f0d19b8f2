/* SPDX-License-Identifier: MIT
 *
 * The least and the greatest value of a quantity: a grid on every piece, then a compass search from those
 * points of it that are extreme among their neighbours and may lead to the extreme of all: each step goes
 * to the best of eight points around, or halves the distance to them.
 */
#include "pieces.h"

enum
{
    GRID = 33,
    NEIGHBOURS = 8,
    HALVINGS = 34
};

/* A piece's borders are creases of some maps: the points on them are so far inside. */
static const double inset_t = 0x1p-50;
static const double inset_r = 0x1p-40;

void cm_quadrature_extreme(cm_statistics *s, double value, uint8_t face, double u, double v)
{
    if (value < s->minimum)
    {
        s->minimum = value;
        s->minimum_face = face;
        s->minimum_uv[0] = u;
        s->minimum_uv[1] = v;
    }
    if (value > s->maximum)
    {
        s->maximum = value;
        s->maximum_face = face;
        s->maximum_uv[0] = u;
        s->maximum_uv[1] = v;
    }
}

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static void add_point(cm_piece_points *points, int piece, double r, double t)
{
    cm_piece_point(points, piece, clamp(r, inset_r, 1.0), clamp(t, inset_t, 1.0 - inset_t));
}

static void evaluate(const cm_quadrature *quadrature, cm_piece_points *points, cm_statistics *s)
{
    cm_quadrature_evaluate(quadrature, points);
    s->evaluations += points->count;
    for (size_t i = 0; i < points->count; i++)
    {
        cm_quadrature_extreme(s, points->value[i], points->face[i], points->u[i], points->v[i]);
    }
}

/* value[i * GRID + j] is that at r = i / (GRID - 1), t = j / (GRID - 1). */
static void evaluate_grid(const cm_quadrature *quadrature, int piece, double *value,
                          cm_statistics *s)
{
    for (int i = 0; i < GRID; i++)
    {
        cm_piece_points points;
        points.count = 0;
        for (int j = 0; j < GRID; j++)
        {
            add_point(&points, piece, (double)i / (GRID - 1), (double)j / (GRID - 1));
        }
        evaluate(quadrature, &points, s);
        for (int j = 0; j < GRID; j++)
        {
            value[i * GRID + j] = points.value[j];
        }
    }
}

static void search_from(const cm_quadrature *quadrature, int piece, double r, double t,
                        double value, double sign, cm_statistics *s)
{
    double step = 0.5 / (GRID - 1);
    for (int halvings = 0; halvings < HALVINGS;)
    {
        static const int along[NEIGHBOURS] = {1, 1, 0, -1, -1, -1, 0, 1};
        cm_piece_points points;
        int best = -1;
        points.count = 0;
        for (int k = 0; k < NEIGHBOURS; k++)
        {
            add_point(&points, piece, r + step * along[k], t + step * along[(k + 6) % NEIGHBOURS]);
        }
        evaluate(quadrature, &points, s);
        for (int k = 0; k < NEIGHBOURS; k++)
        {
            if (sign * points.value[k] > sign * value)
            {
                value = points.value[k];
                best = k;
            }
        }
        if (best < 0)
        {
            step /= 2.0;
            halvings++;
            continue;
        }
        r = clamp(r + step * along[best], 0.0, 1.0);
        t = clamp(t + step * along[(best + 6) % NEIGHBOURS], 0.0, 1.0);
    }
}

/* Is a point of the grid extreme among its neighbours, and near enough to the extreme so far? What a
 * smooth function can gain within a cell is less than what it loses towards the neighbours; twice that
 * is allowed for. */
static int may_lead(const double *value, int i, int j, double sign, double extreme)
{
    double here = sign * value[i * GRID + j];
    double least = here;
    for (int a = i > 0 ? i - 1 : 0; a <= i + 1 && a < GRID; a++)
    {
        for (int b = j > 0 ? j - 1 : 0; b <= j + 1 && b < GRID; b++)
        {
            double there = sign * value[a * GRID + b];
            if (there > here)
            {
                return 0;
            }
            least = fmin(least, there);
        }
    }
    double flat = 1e-14 * fabs(here); /* a constant has peaks of rounding errors */
    return here + 2.0 * (here - least) >= sign * extreme && here - least > flat;
}

static void search_piece(const cm_quadrature *quadrature, int piece, cm_statistics *s)
{
    double value[GRID * GRID];
    evaluate_grid(quadrature, piece, value, s);
    for (int i = 0; i < GRID; i++)
    {
        for (int j = 0; j < GRID; j++)
        {
            double r = (double)i / (GRID - 1);
            double t = (double)j / (GRID - 1);
            double here = value[i * GRID + j];
            if (may_lead(value, i, j, 1.0, s->maximum))
            {
                search_from(quadrature, piece, r, t, here, 1.0, s);
            }
            if (may_lead(value, i, j, -1.0, s->minimum))
            {
                search_from(quadrature, piece, r, t, here, -1.0, s);
            }
        }
    }
}

/* A way to a point of a face's border, straight from inside. */
typedef struct approach
{
    uint8_t face;
    double to[2];
    double across[2];
} approach;

/* Where a quantity has no limit it grows as a power of the distance: from one of 2^-nearer to 2^-(nearer + 7) and on as far
 * again the factor is the same then; where there is a limit it is near 1. */
static void extend_to(const cm_quadrature *quadrature, const approach *way, int nearer,
                      int needs_no_end, cm_statistics *s)
{
    cm_piece_points points;
    points.count = 4;
    for (int i = 0; i < 4; i++)
    {
        double distance = i < 3 ? ldexp(1.0, -nearer - 7 * i) : 0.0;
        points.face[i] = way->face;
        points.u[i] = way->to[0] - distance * way->across[0];
        points.v[i] = way->to[1] - distance * way->across[1];
    }
    cm_quadrature_evaluate(quadrature, &points);
    s->evaluations += points.count;
    double first = points.value[1] / points.value[0];
    double second = points.value[2] / points.value[1];
    int has_end = isfinite(points.value[3]) && points.value[3] != 0.0;
    if (fabs(first - 1.0) > 0.5 && fabs(second - first) < 1e-3 * first &&
        !(needs_no_end && has_end))
    {
        cm_quadrature_extreme(s, first > 1.0 ? (double)INFINITY : 0.0, way->face, way->to[0],
                              way->to[1]);
    }
}

/* Faces meet at a corner of the cube in 270 degrees, on the sphere in 360: a mapping that keeps angles there has no limit,
 * whatever rounding makes of the corner itself. Nor has one that stands still on its edges, as smoothstep:c=1; one that
 * nearly does, has, and is told from it by what is there. */
static void extend_to_border(const cm_quadrature *quadrature, cm_statistics *s)
{
    static const double beside = 0.3125; /* no middle, no diagonal: those may be creases */
    for (uint8_t face = 0; face < 6; face++)
    {
        for (int k = 0; k < 4 && cm_quadrature_has(quadrature, 8 * face); k++)
        {
            double one = k & 1 ? 1.0 : -1.0;
            double other = k & 2 ? 1.0 : -1.0;
            approach corner = {face, {one, other}, {one, 1.5 * other}};
            approach edge = k & 2 ? (approach){face, {one, beside}, {one, 0.0}}
                                  : (approach){face, {beside, one}, {0.0, one}};
            extend_to(quadrature, &corner, 20, 0, s);
            extend_to(quadrature, &corner, 24, 1, s);
            extend_to(quadrature, &edge, 24, 1, s);
        }
    }
}

void cm_quadrature_search(const cm_quadrature *quadrature, cm_statistics *statistics)
{
    for (int piece = 0; piece < CM_PIECES; piece++)
    {
        if (cm_quadrature_has(quadrature, piece))
        {
            search_piece(quadrature, piece, statistics);
        }
    }
    extend_to_border(quadrature, statistics);
}
