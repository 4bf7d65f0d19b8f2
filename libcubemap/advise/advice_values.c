/* SPDX-License-Identifier: MIT
 *
 * What candidates are measured by: distortion, what an ellipsoid adds to it, and bounds on errors.
 */
#include <math.h>

#include "advice_object.h"

/* ---- Distortion ---- */

cm_status cm_advice_measure(const cm_mapping *mapping, double value[CM_LIMIT_NUMBERS])
{
    static const struct
    {
        cm_quantity quantity;
        cm_limit greatest;
        cm_limit mean;
        cm_limit rmse;
    } quantities[] = {
        /* the mean of D_A says nothing; its place is taken by what comes after */
        {CM_QUANTITY_AREA, CM_LIMIT_AREA, CM_LIMIT_AREA_RMSE, CM_LIMIT_AREA_RMSE},
        {CM_QUANTITY_ISOTROPY, CM_LIMIT_ISOTROPY, CM_LIMIT_ISOTROPY_MEAN, CM_LIMIT_ISOTROPY_RMSE},
        {CM_QUANTITY_DEFORMATION, CM_LIMIT_DEFORMATION, CM_LIMIT_DEFORMATION_MEAN,
         CM_LIMIT_DEFORMATION_RMSE}};
    static const cm_statistics_options options = {
        .size = sizeof options, .measure = CM_OVER_FACE, .tolerance = 1e-6};
    cm_status status = CM_OK;
    for (size_t i = 0; i < sizeof quantities / sizeof quantities[0] && status == CM_OK; i++)
    {
        cm_statistics s = {.size = sizeof s};
        int is_area = quantities[i].quantity == CM_QUANTITY_AREA;
        status = cm_distortion_statistics(mapping, quantities[i].quantity, &options, &s);
        value[quantities[i].greatest] = is_area ? s.maximum_error : s.maximum;
        value[quantities[i].mean] = s.mean + s.mean_error;
        value[quantities[i].rmse] = s.rmse + s.rmse_error;
    }
    return status;
}

/* ---- Errors ---- */

double cm_advice_round_trip(const cm_mapping *mapping, cm_precision precision)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    double bound = info->bounds.round_trip;
    if (!cm_mapping_has_bounds(mapping) || bound == 0.0)
    {
        return (double)NAN;
    }
    if (precision == CM_PRECISION_FAST && info->fast != 0)
    {
        return (bound + 1.0) * 0x1p-24; /* one for the rounding of the arguments: options.h */
    }
    return bound * (precision == CM_PRECISION_FLOAT ? 0x1p-24 : 0x1p-53);
}

/* ---- The ellipsoid ---- */

/* The scale along parallels from the ellipsoid to the sphere of the same area: its extremes are at the equator and the
 * poles, between which it is monotonic. */
static void find_scales(const cm_ellipsoid *ellipsoid, const cm_latitude_conversion *conversion,
                        double *least, double *greatest)
{
    static const double normals[2][3] = {{1.0, 0.0, 0.0}, {1e-9, 0.0, 1.0}};
    double radius = cm_ellipsoid_authalic_radius(ellipsoid);
    double flat = 1.0 - ellipsoid->f;
    *least = (double)INFINITY;
    *greatest = 0.0;
    for (int i = 0; i < 2; i++)
    {
        double to[3];
        cm_latitude_convert_direction(conversion, normals[i], to);
        /* the radius of curvature across the meridian, a / sqrt(1 - e^2 sin^2) */
        double across = ellipsoid->a / (i == 0 ? 1.0 : flat);
        double scale = radius * to[0] / (across * normals[i][0]);
        *least = fmin(*least, scale);
        *greatest = fmax(*greatest, scale);
    }
}

/* What the latitude's arithmetic adds to a round trip: grid.h, and latitude.h beyond the flattenings of series. */
static double rounding_of(const cm_ellipsoid *ellipsoid)
{
    return (fabs(ellipsoid->f) <= CM_LATITUDE_SERIES_FLATTENING ? 10.0 : 34.0) * 0x1p-53;
}

/* The part of the limit of an error that each of two conversions may cut off. */
#define SERIES_PART 0.125

static cm_status find_conversion(const cm_ellipsoid *ellipsoid, double metres,
                                 cm_advice_globe *globe)
{
    cm_latitude_conversion *there = NULL;
    cm_latitude_conversion *back = NULL;
    cm_latitude_options options = {.size = sizeof options};
    options.tolerance = isfinite(metres) ? SERIES_PART * metres / ellipsoid->a : 0.0;
    cm_status status = cm_latitude_conversion_create(ellipsoid, CM_LATITUDE_GEOGRAPHIC,
                                                     globe->latitude, &options, &there);
    if (status == CM_OK)
    {
        status = cm_latitude_conversion_create(ellipsoid, globe->latitude, CM_LATITUDE_GEOGRAPHIC,
                                               &options, &back);
    }
    if (status == CM_OK)
    {
        double least;
        double greatest;
        double radius = cm_ellipsoid_authalic_radius(ellipsoid);
        find_scales(ellipsoid, there, &least, &greatest);
        int is_conformal = globe->latitude == CM_LATITUDE_CONFORMAL;
        /* the authalic latitude's scale along meridians is one over that along parallels */
        double most = fmax(greatest, 1.0 / least);
        globe->isotropy = is_conformal ? 1.0 : most * most;
        globe->area = is_conformal ? fmax(greatest * greatest - 1.0, 1.0 - least * least) : 0.0;
        globe->radius = radius * (is_conformal ? 1.0 / least : most);
        globe->error = rounding_of(ellipsoid) + cm_latitude_conversion_error(there) +
                       cm_latitude_conversion_error(back);
    }
    cm_latitude_conversion_destroy(there);
    cm_latitude_conversion_destroy(back);
    return status;
}

cm_status cm_advice_globe_make(const cm_ellipsoid *ellipsoid, unsigned properties, double metres,
                               cm_advice_globe *globe)
{
    *globe = (cm_advice_globe){
        .latitude = CM_LATITUDE_GEOGRAPHIC, .isotropy = 1.0, .radius = CM_ADVICE_EARTH};
    if (ellipsoid == NULL)
    {
        return CM_OK;
    }
    globe->latitude = properties & CM_CONFORMAL ? CM_LATITUDE_CONFORMAL : CM_LATITUDE_AUTHALIC;
    return find_conversion(ellipsoid, metres, globe);
}

/* Upper bounds: D_A and D_I are products of both at most; of deformations the sum is. */
void cm_advice_put_on_globe(const cm_advice_globe *globe, double value[CM_LIMIT_NUMBERS])
{
    double more = globe->isotropy - 1.0;
    double angle = 2.0 * asin(more / (globe->isotropy + 1.0));
    for (int k = CM_LIMIT_AREA; k <= CM_LIMIT_AREA_RMSE; k++)
    {
        value[k] = value[k] * (1.0 + globe->area) + globe->area;
    }
    value[CM_LIMIT_ISOTROPY] *= globe->isotropy;
    value[CM_LIMIT_ISOTROPY_MEAN] *= globe->isotropy;
    value[CM_LIMIT_ISOTROPY_RMSE] = value[CM_LIMIT_ISOTROPY_RMSE] * globe->isotropy + more;
    for (int k = CM_LIMIT_DEFORMATION; k <= CM_LIMIT_DEFORMATION_RMSE; k++)
    {
        value[k] += angle;
    }
}
