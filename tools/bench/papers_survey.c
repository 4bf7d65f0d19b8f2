/* SPDX-License-Identifier: MIT
 *
 * Lambers 2020: table 1, over the centres of 512 x 512 pixels of a face; and its parameters.
 */
#include "papers.h"

#include <cubemap/kernels.h>

#include <math.h>
#include <stdlib.h>

/* ---- Table 1 ---- */

typedef struct pixel_figures
{
    double mean;
    double maximum_error;
    double rmse;
} pixel_figures;

static const char *const columns[6] = {"D_A mean", "D_A max. error", "D_A RMSE",
                                       "D_I mean", "D_I max. error", "D_I RMSE"};

static pixel_figures figures_of(const cm_mapping *mapping, cm_quantity quantity, size_t pixels)
{
    const cm_statistics_options options = {
        .size = sizeof options, .faces = 1, .pixels = (unsigned)pixels};
    cm_statistics s = {.size = sizeof s};
    (void)cm_distortion_statistics(mapping, quantity, &options, &s);
    return (pixel_figures){s.mean, s.maximum_error, s.rmse};
}

/* The derivative of the direction along one coordinate of the face 0, by a central difference. */
static void difference(const cm_mapping *mapping, const double uv[2], int along, double step,
                       double slope[3])
{
    double there[3];
    double here[3];
    double a[2] = {uv[0], uv[1]};
    double b[2] = {uv[0], uv[1]};
    a[along] += step;
    b[along] -= step;
    cm_inverse(mapping, 0, a, there);
    cm_inverse(mapping, 0, b, here);
    for (int k = 0; k < 3; k++)
    {
        slope[k] = (there[k] - here[k]) / (2.0 * step);
    }
}

/* Isotropy from central differences, as the paper must have had it: on a crease they mix both sides. */
static pixel_figures isotropy_by_differences(const cm_mapping *mapping, size_t pixels)
{
    pixel_figures f = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < pixels * pixels; i++)
    {
        const double uv[2] = {(2.0 * (double)(i % pixels) + 1.0) / (double)pixels - 1.0,
                              (2.0 * (double)(i / pixels) + 1.0) / (double)pixels - 1.0};
        double by_u[3];
        double by_v[3];
        difference(mapping, uv, 0, 1e-6, by_u);
        difference(mapping, uv, 1, 1e-6, by_v);
        const cm_tangents_f64 tangents = {.x_a = by_u[0],
                                          .y_a = by_u[1],
                                          .z_a = by_u[2],
                                          .x_b = by_v[0],
                                          .y_b = by_v[1],
                                          .z_b = by_v[2]};
        double error = cm_indicatrix_of_tangents_f64(tangents).isotropy - 1.0;
        f.mean += 1.0 + error;
        f.rmse += error * error;
        f.maximum_error = fmax(f.maximum_error, error);
    }
    f.mean /= (double)(pixels * pixels);
    f.rmse = sqrt(f.rmse / (double)(pixels * pixels));
    return f;
}

static const char on_diagonals[] = "the derivatives jump across QSC's diagonals, on which 1024 of "
                                   "the pixel centres lie. These figures\n"
                                   "  are of one side; central differences mix both, and give what "
                                   "the paper has (the rows below).";
static const char misprint[] = "the paper's mean and max. error repeat those of the tangent "
                               "adjustment, and no map with its mean\n"
                               "  has so small an RMSE, which is at least the mean less 1.";

static void add_survey_row(table *t, const char *row, const char *specification,
                           const char *const printed[6], const char *area_note,
                           const char *isotropy_note, size_t pixels)
{
    cm_mapping *mapping = paper_mapping(specification);
    pixel_figures area = figures_of(mapping, CM_QUANTITY_AREA, pixels);
    pixel_figures isotropy = figures_of(mapping, CM_QUANTITY_ISOTROPY, pixels);
    const double values[6] = {area.mean,     area.maximum_error,     area.rmse,
                              isotropy.mean, isotropy.maximum_error, isotropy.rmse};
    for (int k = 0; k < 6; k++)
    {
        add_figure(t, row, columns[k], printed[k], values[k], k < 3 ? area_note : isotropy_note);
    }
    cm_mapping_destroy(mapping);
}

void compute_survey(table *t, resolution r)
{
    static const struct
    {
        const char *row;
        const char *specification;
        const char *printed[6];
        const char *isotropy_note;
    } rows[] = {
        {"standard", "gnomonic", {"1.153", "1.710", "0.464", "1.281", "0.730", "0.324"}, NULL},
        {"QSC", "qsc", {"1.000", "0.000", "0.000", "1.329", "0.548", "0.346"}, on_diagonals},
        {"tangent", "tangent", {"?", "?", "?", "1.234", "0.729", "0.280"}, NULL},
        {"Nowell", "nowell", {"1.001", "0.205", "0.034", "1.234", "0.729", "0.200"}, misprint},
        {"continuous", "continuous", {"1.030", "0.592", "0.183", "1.179", "0.728", "0.224"}, NULL},
        {"unicube", "unicube", {"1.001", "0.171", "0.038", "1.288", "0.728", "0.348"}, NULL},
        {"Everitt, c = 1.4511", "everitt", {"?", "?", "?", "?", "?", "?"}, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
    {
        add_survey_row(t, rows[i].row, rows[i].specification, rows[i].printed, NULL,
                       rows[i].isotropy_note, r.pixels);
    }
    cm_mapping *qsc = paper_mapping("qsc");
    pixel_figures f = isotropy_by_differences(qsc, r.pixels);
    add_figure(t, "QSC, differences", columns[3], "1.329", f.mean, NULL);
    add_figure(t, "QSC, differences", columns[4], "0.548", f.maximum_error, NULL);
    add_figure(t, "QSC, differences", columns[5], "0.346", f.rmse, NULL);
    cm_mapping_destroy(qsc);
}

/* ---- Parameters ---- */

/* What is to be least, of a mapping with a parameter. */
typedef double (*objective)(const cm_mapping *mapping, size_t pixels);

static double maximum_area_error(const cm_mapping *mapping, size_t pixels)
{
    return figures_of(mapping, CM_QUANTITY_AREA, pixels).maximum_error;
}

static double maximum_isotropy(const cm_mapping *mapping, size_t pixels)
{
    return figures_of(mapping, CM_QUANTITY_ISOTROPY, pixels).maximum_error;
}

static double area_rmse(const cm_mapping *mapping, size_t pixels)
{
    return figures_of(mapping, CM_QUANTITY_AREA, pixels).rmse;
}

/* Of the area element of the inverse map, 1 / D_A. */
static double inverse_area_rmse(const cm_mapping *mapping, size_t pixels)
{
    double sum = 0.0;
    for (size_t i = 0; i < pixels * pixels; i++)
    {
        const double uv[2] = {(2.0 * (double)(i % pixels) + 1.0) / (double)pixels - 1.0,
                              (2.0 * (double)(i / pixels) + 1.0) / (double)pixels - 1.0};
        cm_distortion d;
        cm_inverse_distortion(mapping, 0, uv, &d);
        sum += (1.0 / d.area - 1.0) * (1.0 / d.area - 1.0);
    }
    return sqrt(sum / (double)(pixels * pixels));
}

static double value_at(const char *name, double c, objective f, size_t pixels)
{
    char specification[64];
    snprintf(specification, sizeof specification, "%s:c=%.12f", name, c);
    cm_mapping *mapping = paper_mapping(specification);
    double value = f(mapping, pixels);
    cm_mapping_destroy(mapping);
    return value;
}

/* By golden sections; the objectives here have one minimum in the interval. */
static double optimum(const char *name, double low, double high, objective f, size_t pixels)
{
    const double golden = 0.61803398874989485;
    double a = high - golden * (high - low);
    double b = low + golden * (high - low);
    double at_a = value_at(name, a, f, pixels);
    double at_b = value_at(name, b, f, pixels);
    while (high - low > 1e-6)
    {
        if (at_a < at_b)
        {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = value_at(name, a, f, pixels);
        }
        else
        {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = value_at(name, b, f, pixels);
        }
    }
    return (low + high) / 2.0;
}

static const char inverse_element[] =
    "the figure is of the area element of the inverse map, 1 / D_A (the rows below); that of D_A\n"
    "  itself, which the paper tabulates, is least at another c.";

static const char flat[] =
    "the least is so flat that the RMSE at the paper's c is the same to four digits.";

static void add_sigmoids(table *t, size_t pixels)
{
    static const struct
    {
        const char *name;
        double low, high;
    } families[] = {{"algebraic", 0.5, 1.5},   {"tanh", 0.5, 1.5},    {"logistic", 1.0, 3.0},
                    {"smoothstep", 0.3, 0.95}, {"tangent", 0.8, 1.8}, {"everitt", 1.2, 1.7}};
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++)
    {
        char row[40];
        double c = optimum(families[i].name, families[i].low, families[i].high, maximum_area_error,
                           pixels);
        snprintf(row, sizeof row, "%s, least max.", families[i].name);
        add_figure(t, row, "c", i == 0 ? "0.87" : "", c, NULL);
        add_figure(t, row, "D_A max. error", "",
                   value_at(families[i].name, c, maximum_area_error, pixels), NULL);
        add_figure(t, row, "D_I max. error", "",
                   value_at(families[i].name, c, maximum_isotropy, pixels), NULL);
    }
}

void compute_optima(table *t, resolution r)
{
    size_t pixels = r.pixels;
    add_figure(t, "tangent, least RMSE", "c", "1.1823",
               optimum("tangent", 0.8, 1.8, area_rmse, pixels), inverse_element);
    add_figure(t, "tangent, of 1 / D_A", "c", "1.1823",
               optimum("tangent", 0.8, 1.8, inverse_area_rmse, pixels), NULL);
    add_figure(t, "Everitt, least RMSE", "c", "1.4511",
               optimum("everitt", 1.2, 1.7, area_rmse, pixels), inverse_element);
    add_figure(t, "Everitt, of 1 / D_A", "c", "1.4511",
               optimum("everitt", 1.2, 1.7, inverse_area_rmse, pixels), flat);
    add_sigmoids(t, pixels);
}
