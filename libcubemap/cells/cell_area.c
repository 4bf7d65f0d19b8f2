/* SPDX-License-Identifier: MIT
 *
 * The areas of cells on the ellipsoid: in closed form where the mapping and the latitude keep areas, else by
 * quadrature of the grid's area element.
 */
#include "cell_shape.h"

enum
{
    NODES = 8,
    NODES_FEWER = 5,
    DEPTH_MOST = 9,
    LEVEL_SMOOTH = 2 /* no cell of this level has both the middle and a corner of its face */
};

/* What 8 and 5 nodes may be apart: where 5 are as good as that, 8 are better than rounding. */
#define APART 5e-13

/* Gauss and Legendre's rules on [0, 1]. */
typedef struct rule
{
    int count;
    double node[NODES];
    double weight[NODES];
} rule;

static const rule fine = {
    NODES,
    {0.0198550717512318842, 0.101666761293186630, 0.237233795041835507, 0.408282678752175098,
     0.591717321247824902, 0.762766204958164493, 0.898333238706813370, 0.980144928248768116},
    {0.0506142681451881296, 0.111190517226687235, 0.156853322938943644, 0.181341891689180991,
     0.181341891689180991, 0.156853322938943644, 0.111190517226687235, 0.0506142681451881296}};

static const rule coarse = {
    NODES_FEWER,
    {0.0469100770306680036, 0.230765344947158454, 0.5, 0.769234655052841546, 0.953089922969331996},
    {0.118463442528094544, 0.239314335249683234, 0.284444444444444444, 0.239314335249683234,
     0.118463442528094544}};

/* A square, or half of one: then the triangle between the apex, the corner along u and the one across, or
 * the other half. */
typedef struct piece
{
    uint8_t face;
    double u; /* the corner, the apex of a triangle */
    double v;
    double along; /* the sides, with their signs */
    double across;
    int half; /* 0: the square; 1: the triangle along u, 2: that along v */
} piece;

/* In a triangle lines through the apex are divided alike, so that it may be a point where the map has no
 * derivatives. */
static double integral_of(const cm_cell_grid *cells, const piece *p, const rule *r)
{
    uint8_t face[NODES * NODES];
    double u[NODES * NODES], v[NODES * NODES], element[NODES * NODES];
    int count = r->count * r->count;
    double sum = 0.0;
    int i = 0;
    do
    {
        double s = r->node[i / r->count];
        double t = r->node[i % r->count];
        face[i] = p->face;
        u[i] = p->u + p->along * (p->half == 2 ? s * t : s);
        v[i] = p->v + p->across * (p->half == 1 ? s * t : p->half == 2 ? s : t);
    } while (++i < count);
    cm_grid_area_element_array(cells->grid, (size_t)count, face, u, v, element);
    for (i = 0; i < count; i++)
    {
        double weight = r->weight[i / r->count] * r->weight[i % r->count];
        sum += weight * element[i] * (p->half != 0 ? r->node[i / r->count] : 1.0);
    }
    return sum * fabs(p->along * p->across);
}

/* The four quarters of a square; of a triangle a triangle at the apex, and a square and a triangle
 * behind it. */
static int divide(const piece *p, piece part[4])
{
    double along = 0.5 * p->along;
    double across = 0.5 * p->across;
    piece near = {p->face, p->u, p->v, along, across, p->half};
    piece beside_u = {p->face, p->u + along, p->v, along, across, 0};
    piece beside_v = {p->face, p->u, p->v + across, along, across, 0};
    piece far = {p->face, p->u + along, p->v + across, along, across, p->half};
    part[0] = near;
    part[1] = far;
    part[2] = p->half == 2 ? beside_v : beside_u;
    part[3] = beside_v;
    return p->half == 0 ? 4 : 3;
}

/* What the rounding of the nodes makes the area element uncertain by, relatively, where a map is singular at an edge
 * or a corner of the face, as conformal is: that of u and v over the distance from there. Dividing does not help
 * against it. */
static double rounding_of(const piece *p)
{
    double u = fmin(fabs(p->u), fabs(p->u + p->along));
    double v = fmin(fabs(p->v), fabs(p->v + p->across));
    return 0x1p-49 / (1.0 - fmax(u, v));
}

static double integrate(const cm_cell_grid *cells, const piece *p, int depth)
{
    double sum = integral_of(cells, p, &fine);
    double apart = fmax(APART, rounding_of(p));
    if (!(fabs(sum - integral_of(cells, p, &coarse)) > apart * sum) || depth == DEPTH_MOST)
    {
        return sum;
    }
    piece part[4];
    int count = divide(p, part);
    sum = 0.0;
    for (int k = 0; k < count; k++)
    {
        sum += integrate(cells, &part[k], depth + 1);
    }
    return sum;
}

/* Maps have creases along the axes of a face, which are edges of cells, and along its diagonals; and points where
 * they are not smooth in any direction at its middle and its corners. */
static double area_of_place(const cm_cell_grid *cells, const cm_cell_place *place)
{
    double size = ldexp(1.0, 1 - place->level);
    double low[2] = {place->i * size - 1.0, place->j * size - 1.0};
    if (place->level < LEVEL_SMOOTH)
    {
        double sum = 0.0;
        for (uint32_t k = 0; k < 4; k++)
        {
            cm_cell_place quarter = {place->face, (uint8_t)(place->level + 1),
                                     2 * place->i + (k & 1), 2 * place->j + (k >> 1)};
            sum += area_of_place(cells, &quarter);
        }
        return sum;
    }
    double middle[2] = {low[0] + 0.5 * size, low[1] + 0.5 * size};
    if (fabs(middle[0]) != fabs(middle[1]))
    {
        piece square = {place->face, low[0], low[1], size, size, 0};
        return integrate(cells, &square, 0);
    }
    /* the apex is what is nearer, the middle of the face or its corner */
    int outwards = fabs(middle[0]) > 0.5;
    piece half = {.face = place->face};
    int is_low_u = (middle[0] > 0.0) != outwards;
    int is_low_v = (middle[1] > 0.0) != outwards;
    half.u = is_low_u ? low[0] : low[0] + size;
    half.v = is_low_v ? low[1] : low[1] + size;
    half.along = is_low_u ? size : -size;
    half.across = is_low_v ? size : -size;
    double sum = 0.0;
    for (half.half = 1; half.half <= 2; half.half++)
    {
        sum += integrate(cells, &half, 0);
    }
    return sum;
}

double cm_cell_area(const cm_cell_grid *cells, cm_cell cell)
{
    cm_cell_place place;
    if (cm_cell_to_place(cells->curve, cell, &place) != CM_OK)
    {
        return (double)NAN;
    }
    const cm_grid *grid = cells->grid;
    const cm_ellipsoid *ellipsoid = cm_grid_ellipsoid(grid);
    if ((cm_mapping_describe(cm_grid_mapping(grid))->properties & CM_EQUAL_AREA) != 0 &&
        (cm_grid_latitude(grid) == CM_LATITUDE_AUTHALIC || ellipsoid->f == 0.0))
    {
        return ldexp(cm_ellipsoid_area(ellipsoid) / 6.0, -2 * place.level);
    }
    return area_of_place(cells, &place);
}
