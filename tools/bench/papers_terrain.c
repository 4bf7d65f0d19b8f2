/* SPDX-License-Identifier: MIT
 *
 * Dimitrijevic, Lambers, Rancic 2016: table 5.1, texel aspect and area on a grid that includes the edges of
 * a face, with texels of 1e-6 by central differences (eqs. 3.4 to 3.7), of which area has no sine of the
 * angle between the sides.
 */
#include "papers.h"

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = 256
};

#define TEXEL 1e-6

typedef struct extremes
{
    double least;
    double most;
    double square; /* of the difference from 1 */
} extremes;

/* Ends of the middle lines of texels. */
typedef struct sides
{
    size_t count;
    uint8_t face[BLOCK];
    double point[2][BLOCK];
    double coordinate[4][2][BLOCK]; /* left, right, below, above */
    double direction[4][3][BLOCK];
} sides;

/* A texel that would reach over an edge is moved to it. */
static double inside(double x)
{
    return fmin(fmax(x, TEXEL / 2.0 - 1.0), 1.0 - TEXEL / 2.0);
}

static void add_point(sides *s, uint8_t face, double u, double v)
{
    size_t i = s->count++;
    s->face[i] = face;
    s->point[0][i] = u;
    s->point[1][i] = v;
    for (int k = 0; k < 4; k++)
    {
        double at[2] = {inside(u), inside(v)};
        at[k / 2] += k % 2 == 0 ? -TEXEL / 2.0 : TEXEL / 2.0;
        s->coordinate[k][0][i] = at[0];
        s->coordinate[k][1][i] = at[1];
    }
}

static double side_of(const sides *s, size_t i, int k)
{
    double square = 0.0;
    for (int m = 0; m < 3; m++)
    {
        double apart = s->direction[k + 1][m][i] - s->direction[k][m][i];
        square += apart * apart;
    }
    return 2.0 * asin(sqrt(square) / 2.0);
}

/* Widths and heights. */
static void measure_sides(const cm_mapping *mapping, sides *s, double *width, double *height)
{
    for (int k = 0; k < 4; k++)
    {
        cm_inverse_array(mapping, s->count, s->face, s->coordinate[k][0], s->coordinate[k][1],
                         s->direction[k][0], s->direction[k][1], s->direction[k][2]);
    }
    for (size_t i = 0; i < s->count; i++)
    {
        width[i] = side_of(s, i, 0);
        height[i] = side_of(s, i, 2);
    }
}

static void take(extremes *e, double value)
{
    e->least = fmin(e->least, value);
    e->most = fmax(e->most, value);
    e->square += (value - 1.0) * (value - 1.0);
}

/* Widths over heights and areas over a unit. */
typedef struct texels
{
    size_t count;
    double aspect[BLOCK];
    double area[BLOCK];
} texels;

static void texels_by_differences(const cm_mapping *mapping, sides *s, texels *to)
{
    double width[BLOCK];
    double height[BLOCK];
    measure_sides(mapping, s, width, height);
    for (size_t i = 0; i < s->count; i++)
    {
        to->aspect[i] = width[i] / height[i];
        to->area[i] = width[i] * height[i];
    }
}

/* By the derivatives of the side that the point counts to. */
static void texels_of_one_side(const cm_mapping *mapping, const sides *s, texels *to)
{
    const cm_distortion_arrays arrays = {.texel_aspect = to->aspect, .texel_area = to->area};
    cm_inverse_distortion_array(mapping, s->count, s->face, s->point[0], s->point[1], &arrays);
}

static void measure_texels(const cm_mapping *mapping, int one_sided, sides *s, texels *to)
{
    if (one_sided)
    {
        texels_of_one_side(mapping, s, to);
    }
    else
    {
        texels_by_differences(mapping, s, to);
    }
}

/* Of one face, areas relative to that of the texel at its centre. */
static void survey_face(const cm_mapping *mapping, uint8_t face, int one_sided, size_t grid,
                        extremes *aspect, extremes *area)
{
    static sides s;
    static texels found;
    *aspect = *area = (extremes){(double)INFINITY, 0.0, 0.0};
    s.count = 0;
    add_point(&s, face, 0.0, 0.0);
    measure_texels(mapping, one_sided, &s, &found);
    double unit = found.area[0];
    for (size_t i = 0; i < grid * grid;)
    {
        for (s.count = 0; s.count < BLOCK && i < grid * grid; i++)
        {
            add_point(&s, face, 2.0 * (double)(i % grid) / (double)(grid - 1) - 1.0,
                      2.0 * (double)(i / grid) / (double)(grid - 1) - 1.0);
        }
        measure_texels(mapping, one_sided, &s, &found);
        for (size_t k = 0; k < s.count; k++)
        {
            take(aspect, found.aspect[k]);
            take(area, found.area[k] / unit);
        }
    }
}

static void add_extremes(table *t, const char *row, const char *what, const extremes *e,
                         size_t grid, const char *const printed[4])
{
    static const char *const columns[4] = {"min.", "max.", "ratio", "RMSD"};
    const double values[4] = {e->least, e->most, e->most / e->least,
                              sqrt(e->square / (double)(grid * grid))};
    for (int k = 0; k < 4; k++)
    {
        char column[40];
        snprintf(column, sizeof column, "%s %s", what, columns[k]);
        add_figure(t, row, column, printed[k], values[k], NULL);
    }
}

/* QSC's figures come out only with texels that reach over its diagonals, those of HEALPix's polar face only
 * with texels that do not: there the paper must have chosen the triangle at the texel's centre. */
static const struct
{
    const char *row;
    const char *specification;
    uint8_t face;
    int one_sided;
    const char *aspect[4];
    const char *area[4];
} rows[] = {
    {"TSC",
     "gnomonic",
     0,
     0,
     {"0.707", "1.414", "2.000", "0.155"},
     {"0.222", "1.000", "4.500", "0.506"}},
    {"ASC",
     "tangent",
     0,
     0,
     {"0.707", "1.414", "2.000", "0.146"},
     {"0.707", "1.000", "1.414", "0.153"}},
    {"OSC",
     "outerra",
     0,
     0,
     {"0.994", "1.006", "1.013", "0.001"},
     {"0.324", "1.000", "3.088", "0.280"}},
    {"CSC, published inverse",
     "cobe:legacy=1",
     0,
     0,
     {"0.650", "1.538", "2.365", "0.218"},
     {"0.940", "1.325", "1.410", "0.019"}},
    {"QSC",
     "qsc",
     0,
     0,
     {"0.650", "1.539", "2.369", "0.271"},
     {"0.894", "0.931", "1.042", "0.099"}},
    {"KSC",
     "nowell",
     0,
     0,
     {"0.577", "1.732", "3.000", "0.227"},
     {"1.000", "1.155", "1.155", "0.063"}},
    {"HEALPix, equator",
     "healpix",
     0,
     0,
     {"0.654", "1.178", "1.800", "0.156"},
     {"1.000", "1.000", "1.000", "0.000"}},
    {"HEALPix, pole",
     "healpix",
     4,
     1,
     {"0.548", "1.826", "3.334", "0.437"},
     {"1.000", "1.272", "1.272", "0.108"}},
};

void compute_terrain(table *t, resolution r)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
    {
        extremes aspect;
        extremes area;
        cm_mapping *mapping = paper_mapping(rows[i].specification);
        survey_face(mapping, rows[i].face, rows[i].one_sided, r.grid, &aspect, &area);
        add_extremes(t, rows[i].row, "aspect", &aspect, r.grid, rows[i].aspect);
        add_extremes(t, rows[i].row, "area", &area, r.grid, rows[i].area);
        cm_mapping_destroy(mapping);
    }
}
