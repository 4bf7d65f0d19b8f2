/* SPDX-License-Identifier: MIT
 *
 * Dimitrijevic et al. 2020: table I, Tissot's indicatrix of the adjusted spherical cube (tangent) on an
 * ellipsoid of equatorial radius 1, by way of a sphere with three latitudes; and s2geometry's table.
 *
 * Means are over the centres of pixels of a face, extremes over a grid with its edges; "all" is of four side
 * faces and two tops.
 */
#include "papers.h"

#include <math.h>
#include <stdlib.h>

typedef struct surface
{
    const char *name;
    const char *ellipsoid;
    cm_latitude latitude;
} surface;

static cm_grid *make_grid(const surface *of)
{
    cm_grid_options options = {.size = sizeof options,
                               .mapping = "tangent",
                               .ellipsoid = cm_ellipsoid_find(of->ellipsoid),
                               .latitude = &of->latitude};
    cm_grid *grid = NULL;
    cm_status status = cm_grid_create(&options, &grid);
    if (status != CM_OK)
    {
        fprintf(stderr, "%s: %s: %s\n", program_name(), of->name, cm_status_text(status));
        exit(EXIT_FAILURE);
    }
    return grid;
}

typedef struct face_figures
{
    double most_angle;
    double mean_angle;
    double least_area;
    double most_area;
    double mean_area;
} face_figures;

static face_figures survey_face(const cm_grid *grid, uint8_t face, size_t pixels)
{
    face_figures f = {0.0, 0.0, (double)INFINITY, 0.0, 0.0};
    size_t vertices = 2 * (pixels / 2) + 1; /* the centre is one */
    for (size_t i = 0; i < pixels * pixels; i++)
    {
        const double uv[2] = {(2.0 * (double)(i % pixels) + 1.0) / (double)pixels - 1.0,
                              (2.0 * (double)(i / pixels) + 1.0) / (double)pixels - 1.0};
        cm_distortion at;
        cm_grid_inverse_distortion(grid, face, uv, &at);
        f.mean_angle += at.deformation;
        f.mean_area += at.scale;
    }
    for (size_t i = 0; i < vertices * vertices; i++)
    {
        const double uv[2] = {2.0 * (double)(i % vertices) / (double)(vertices - 1) - 1.0,
                              2.0 * (double)(i / vertices) / (double)(vertices - 1) - 1.0};
        cm_distortion at;
        cm_grid_inverse_distortion(grid, face, uv, &at);
        f.most_angle = fmax(f.most_angle, at.deformation);
        f.least_area = fmin(f.least_area, at.scale);
        f.most_area = fmax(f.most_area, at.scale);
    }
    f.mean_angle /= (double)(pixels * pixels);
    f.mean_area /= (double)(pixels * pixels);
    return f;
}

static void add_face(table *t, const surface *of, const char *face, const face_figures *f,
                     const char *const printed[6])
{
    static const char *const columns[6] = {"angle max.", "angle mean", "area min.",
                                           "area max.",  "area ratio", "area mean"};
    const double values[6] = {f->most_angle / DEGREE, f->mean_angle / DEGREE,       f->least_area,
                              f->most_area,           f->most_area / f->least_area, f->mean_area};
    char row[40];
    snprintf(row, sizeof row, "%s, %s", of->name, face);
    for (int k = 0; k < 6; k++)
    {
        add_figure(t, row, columns[k], printed[k], values[k], NULL);
    }
}

void compute_grid(table *t, resolution r)
{
    static const surface surfaces[] = {
        {"sphere", "sphere", CM_LATITUDE_GEOGRAPHIC},
        {"geodetic", "WGS84", CM_LATITUDE_GEOGRAPHIC},
        {"geocentric", "WGS84", CM_LATITUDE_GEOCENTRIC},
        {"authalic, approx.", "WGS84", CM_LATITUDE_AUTHALIC_APPROXIMATION}};
    static const char *const printed[4][3][6] = {
        {{"31.085", "11.569", "1.621", "2.293", "1.414", "1.925"},
         {"31.085", "11.569", "1.621", "2.293", "1.414", "1.925"},
         {"31.085", "11.569", "1.621", "2.293", "1.414", "1.925"}},
        {{"30.962", "11.570", "1.632", "2.308", "1.414", "1.934"},
         {"31.332", "11.588", "1.610", "2.293", "1.424", "1.921"},
         {"31.332", "11.576", "1.610", "2.308", "1.433", "1.929"}},
        {{"31.085", "11.569", "1.621", "2.300", "1.419", "1.927"},
         {"31.084", "11.569", "1.632", "2.300", "1.410", "1.934"},
         {"31.085", "11.569", "1.621", "2.300", "1.419", "1.929"}},
        {{"31.044", "11.567", "1.625", "2.298", "1.414", "1.929"},
         {"31.167", "11.575", "1.625", "2.298", "1.414", "1.929"},
         {"31.167", "11.570", "1.625", "2.298", "1.414", "1.929"}}};
    for (int i = 0; i < 4; i++)
    {
        cm_grid *grid = make_grid(&surfaces[i]);
        face_figures side = survey_face(grid, 0, r.pixels);
        face_figures top = survey_face(grid, 4, r.pixels);
        face_figures all = {fmax(side.most_angle, top.most_angle),
                            (4.0 * side.mean_angle + 2.0 * top.mean_angle) / 6.0,
                            fmin(side.least_area, top.least_area),
                            fmax(side.most_area, top.most_area),
                            (4.0 * side.mean_area + 2.0 * top.mean_area) / 6.0};
        add_face(t, &surfaces[i], "side", &side, printed[i][0]);
        add_face(t, &surfaces[i], "top", &top, printed[i][1]);
        add_face(t, &surfaces[i], "all", &all, printed[i][2]);
        cm_grid_destroy(grid);
    }
}

/* ---- s2geometry ---- */

typedef struct ratios
{
    double least[3]; /* area, edge, diagonal */
    double most[3];
} ratios;

static void take(ratios *of, int which, double value)
{
    of->least[which] = fmin(of->least[which], value);
    of->most[which] = fmax(of->most[which], value);
}

/* Of cells so small that they are parallelograms, at a grid of points with the edges. */
static ratios survey_cells(const cm_mapping *mapping, size_t grid)
{
    ratios of = {{(double)INFINITY, (double)INFINITY, (double)INFINITY}, {0.0, 0.0, 0.0}};
    for (size_t i = 0; i < grid * grid; i++)
    {
        const double uv[2] = {2.0 * (double)(i % grid) / (double)(grid - 1) - 1.0,
                              2.0 * (double)(i / grid) / (double)(grid - 1) - 1.0};
        double j[6];
        cm_distortion d;
        cm_inverse_jacobian(mapping, 0, uv, j);
        cm_inverse_distortion(mapping, 0, uv, &d);
        take(&of, 0, 1.0 / d.scale);
        take(&of, 1, hypot(j[0], hypot(j[2], j[4])));
        take(&of, 1, hypot(j[1], hypot(j[3], j[5])));
        take(&of, 2, hypot(j[0] + j[1], hypot(j[2] + j[3], j[4] + j[5])));
        take(&of, 2, hypot(j[0] - j[1], hypot(j[2] - j[3], j[4] - j[5])));
    }
    return of;
}

void compute_s2(table *t, resolution r)
{
    static const char finite[] = "S2's figures are of cells of a finite level, not one for all: "
                                 "diagonals of tangent are 1.7039 at\n"
                                 "  level 6 and 1.7179 at level 7, edges of quadratic 1.8013 at "
                                 "level 8. Computed are the limits of\n"
                                 "  small cells, which S2's own s2metrics.cc has: 3 sqrt(3) = "
                                 "5.196, 1.5 sqrt(2) = 2.121, 3, ...";
    static const struct
    {
        const char *row;
        const char *specification;
        const char *printed[3];
        const char *note[3];
    } rows[] = {
        {"linear", "gnomonic", {"5.200", "2.117", "2.959"}, {finite, finite, finite}},
        {"tangent", "tangent", {"1.414", "1.414", "1.704"}, {NULL, NULL, finite}},
        {"quadratic", "s2", {"2.082", "1.802", "1.932"}, {finite, finite, finite}},
    };
    static const char *const columns[3] = {"area ratio", "edge ratio", "diagonal ratio"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
    {
        cm_mapping *mapping = paper_mapping(rows[i].specification);
        ratios of = survey_cells(mapping, r.pixels + 1);
        for (int k = 0; k < 3; k++)
        {
            add_figure(t, rows[i].row, columns[k], rows[i].printed[k], of.most[k] / of.least[k],
                       rows[i].note[k]);
        }
        cm_mapping_destroy(mapping);
    }
}
