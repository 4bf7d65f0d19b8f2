/* SPDX-License-Identifier: MIT
 *
 * The paths of the uniform maps through CAM16-UCS.
 *
 * The tables are points J', a', b' of uniform cubic B-splines, found by research/colormap/uniform-paths, whose --check
 * reads them here: of the paths through colours of one's choice those whose steps, equal in CAM16-UCS, are nearly
 * so by CIEDE2000. Those of a diverging map are two splines of equal length, from either end to the grey in the
 * middle.
 */
#include "uniform_path.h"

#include <math.h>

/* clang-format off */
static const double purple_yellow[][3] = {
    {16.0, 14.46, -10.01},
    {26.97, 8.95, -25.29},
    {39.66, -3.38, -27.13},
    {53.19, -15.85, -18.14},
    {66.72, -22.42, -3.04},
    {78.6, -22.61, 13.29},
    {88.48, -18.23, 25.67},
    {97.0, -11.74, 30.28},
};

static const double red_yellow[][3] = {
    {12.0, 0.87, -10.68},
    {21.54, 15.89, -4.52},
    {32.36, 25.9, 5.85},
    {46.19, 29.55, 15.64},
    {61.21, 24.48, 22.51},
    {74.3, 12.48, 27.7},
    {85.64, -0.58, 30.74},
    {96.0, -11.08, 30.6},
};

static const double blue[][3] = {
    {10.0, 5.81, -14.73},
    {22.69, 2.31, -24.08},
    {35.62, -0.75, -27.92},
    {48.61, -3.31, -26.07},
    {61.22, -6.55, -20.87},
    {73.49, -9.43, -15.16},
    {84.91, -8.97, -8.35},
    {96.0, -3.52, -1.0},
};

static const double green[][3] = {
    {15.0, -11.16, -2.35},
    {26.5, -16.08, 1.11},
    {38.07, -21.21, 5.19},
    {50.56, -24.41, 8.36},
    {63.39, -24.49, 11.58},
    {75.14, -21.02, 16.47},
    {85.69, -14.27, 20.5},
    {96.0, -5.98, 20.15},
};

static const double blue_red[][3] = {
    {28.0, 7.22, -24.52},
    {40.34, 1.25, -29.88},
    {54.1, -4.62, -27.71},
    {67.38, -10.44, -19.95},
    {80.23, -10.41, -9.51},
    {94.99999999999999, -1.8213727383165217, -1.0318922878613992},
    {28.0, 26.40153759165613, 2.79},
    {39.51, 30.38, 9.62},
    {51.04, 26.82, 13.12},
    {63.73, 18.17, 12.38},
    {78.38, 8.13, 7.5},
    {94.99999999999999, -1.8213727383165217, -1.0318922878613992},
};

static const double purple_green[][3] = {
    {28.0, 20.45, -9.8},
    {39.68, 21.03, -18.86},
    {52.29, 18.24, -20.16},
    {65.59, 13.06, -15.86},
    {79.48, 5.94, -8.63},
    {94.99999999999999, -1.8213727383165217, -1.0318922878613992},
    {28.0, -16.361599310599853, 4.15},
    {40.77, -23.26, 10.55},
    {53.64, -23.16, 14.07},
    {66.09, -16.6, 13.47},
    {79.24, -7.92, 7.93},
    {94.99999999999999, -1.8213727383165217, -1.0318922878613992},
};

static const double cyclic[][3] = {
    {86.14, -13.83, 8.89},
    {80.87, -18.87, -6.91},
    {67.62, -14.75, -21.91},
    {51.93, -5.03, -28.32},
    {39.03, 5.64, -23.68},
    {33.25, 15.92, -10.76},
    {36.7, 24.9, 2.85},
    {48.85, 26.48, 12.7},
    {64.32, 15.8, 18.47},
    {78.78, -0.77, 17.82},
};
/* clang-format on */

/* ---- from points to polynomials ---- */

typedef enum course
{
    OPEN,   /* from the first point to the last, with no curvature there */
    HALVES, /* two open ones, of which the second goes from its last point to its first */
    CLOSED
} course;

typedef struct table
{
    const double (*point)[3];
    size_t count;
    course goes;
} table;

#define TABLE(points, goes)                                                                        \
    {                                                                                              \
        points, sizeof points / sizeof points[0], goes                                             \
    }

static const table tables[] = {
    [CM_COLORMAP_UNIFORM_PURPLE_YELLOW] = TABLE(purple_yellow, OPEN),
    [CM_COLORMAP_UNIFORM_RED_YELLOW] = TABLE(red_yellow, OPEN),
    [CM_COLORMAP_UNIFORM_BLUE] = TABLE(blue, OPEN),
    [CM_COLORMAP_UNIFORM_GREEN] = TABLE(green, OPEN),
    [CM_COLORMAP_UNIFORM_BLUE_RED] = TABLE(blue_red, HALVES),
    [CM_COLORMAP_UNIFORM_PURPLE_GREEN] = TABLE(purple_green, HALVES),
    [CM_COLORMAP_UNIFORM_CYCLIC] = TABLE(cyclic, CLOSED),
};

/* The segment between the second and the third of four points. */
static void set_piece(const double *const point[4], cm_uniform_piece *piece)
{
    static const double basis[4][4] = {
        {1.0, 4.0, 1.0, 0.0}, {-3.0, 0.0, 3.0, 0.0}, {3.0, -6.0, 3.0, 0.0}, {-1.0, 3.0, -3.0, 1.0}};
    for (int power = 0; power < 4; power++)
    {
        for (int i = 0; i < 3; i++)
        {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
            {
                sum += basis[power][k] * point[k][i];
            }
            piece->of_power[power][i] = sum / 6.0;
        }
    }
}

/* The point beyond an end, so that the spline begins in the end itself. */
static void reflect(const double end[3], const double next[3], double beyond[3])
{
    for (int i = 0; i < 3; i++)
    {
        beyond[i] = 2.0 * end[i] - next[i];
    }
}

/* From the first point to the last, or backward. */
static size_t set_open(const double (*point)[3], size_t count, int backward,
                       cm_uniform_piece *piece)
{
    double before[3], behind[3];
    reflect(point[0], point[1], before);
    reflect(point[count - 1], point[count - 2], behind);
    for (size_t i = 0; i + 1 < count; i++)
    {
        const size_t from = backward ? count - 1 - i : i;
        const size_t to = backward ? from - 1 : from + 1;
        const double *const first = backward ? behind : before;
        const double *const last = backward ? before : behind;
        const double *const four[4] = {i == 0 ? first : point[backward ? from + 1 : from - 1],
                                       point[from], point[to],
                                       i + 2 == count ? last : point[backward ? to - 1 : to + 1]};
        set_piece(four, &piece[i]);
    }
    return count - 1;
}

static size_t set_closed(const double (*point)[3], size_t count, cm_uniform_piece *piece)
{
    for (size_t i = 0; i < count; i++)
    {
        const double *const four[4] = {point[(i + count - 1) % count], point[i],
                                       point[(i + 1) % count], point[(i + 2) % count]};
        set_piece(four, &piece[i]);
    }
    return count;
}

size_t cm_uniform_pieces(cm_colormap_model model, cm_uniform_piece piece[CM_UNIFORM_PIECES_MAX])
{
    const table *path = &tables[model];
    const size_t half = path->count / 2;
    switch (path->goes)
    {
    case CLOSED:
        return set_closed(path->point, path->count, piece);
    case HALVES:
    {
        const size_t done = set_open(path->point, half, 0, piece);
        return done + set_open(path->point + half, half, 1, piece + done);
    }
    default:
        return set_open(path->point, path->count, 0, piece);
    }
}

/* ---- along a piece ---- */

void cm_uniform_point(const cm_uniform_piece *piece, double x, double ucs[3])
{
    const double(*c)[3] = piece->of_power;
    for (int i = 0; i < 3; i++)
    {
        ucs[i] = c[0][i] + x * (c[1][i] + x * (c[2][i] + x * c[3][i]));
    }
}

void cm_uniform_velocity(const cm_uniform_piece *piece, double x, double velocity[3])
{
    const double(*c)[3] = piece->of_power;
    for (int i = 0; i < 3; i++)
    {
        velocity[i] = c[1][i] + x * (2.0 * c[2][i] + x * 3.0 * c[3][i]);
    }
}

static double speed(const cm_uniform_piece *piece, double x)
{
    double v[3];
    cm_uniform_velocity(piece, x, v);
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* By Gauss and Legendre with ten nodes, which is within 2e-12 of the length of each piece here. */
double cm_uniform_length(const cm_uniform_piece *piece, double x)
{
    static const double node[5] = {0.14887433898163121088, 0.4333953941292471908,
                                   0.67940956829902440623, 0.86506336668898451073,
                                   0.97390652851717172008};
    static const double weight[5] = {0.29552422471475287017, 0.26926671930999635509,
                                     0.219086362515982044, 0.14945134915058059315,
                                     0.066671344308688137594};
    double sum = 0.0;
    for (int i = 0; i < 5; i++)
    {
        sum += weight[i] *
               (speed(piece, 0.5 * x * (1.0 - node[i])) + speed(piece, 0.5 * x * (1.0 + node[i])));
    }
    return 0.5 * x * sum;
}

/* Newton's steps, until rounding stops them from becoming shorter: speeds within a piece are of one size. */
double cm_uniform_place(const cm_uniform_piece *piece, double part)
{
    const double wanted = part * cm_uniform_length(piece, 1.0);
    double x = part;
    double before = (double)INFINITY;
    double step = 0.5;
    while (part > 0.0 && part < 1.0 && fabs(step) < before)
    {
        before = fabs(step);
        step = (cm_uniform_length(piece, x) - wanted) / speed(piece, x);
        x = fmin(fmax(x - step, 0.0), 1.0);
    }
    return x;
}
