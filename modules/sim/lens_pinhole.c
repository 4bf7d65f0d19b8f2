/* SPDX-License-Identifier: MIT
 *
 * Lambers, Sommerhoff and Kolb 2018, section 3.3, with the enlarged frustum that they leave out: a picture without
 * distortion that shows all that the lens shows.
 */
#include <cubemap/lens.h>

#include "lens_extent.h"

#include <math.h>

/* One direction: pixels so that the least and the greatest ray lie within, the axis on a centre, one more at each end. */
static double make_side(double focal, double pixel_centre, double least, double greatest,
                        double *centre)
{
    const double one = focal * least, other = focal * greatest;
    const double first = floor(fmin(one, other)) - 1.0;
    *centre = pixel_centre - first;
    return ceil(fmax(one, other)) + 1.0 - first + 1.0;
}

cm_status cm_lens_pinhole(const cm_camera *camera, double scale, cm_camera_options *pinhole)
{
    cm_lens_extent extent;
    cm_status status = cm_lens_check(camera);
    if (status != CM_OK)
    {
        return status;
    }
    if (pinhole == NULL || pinhole->size != sizeof *pinhole)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(scale >= 0.0) || isinf(scale))
    {
        return CM_ERROR_RANGE;
    }
    status = cm_lens_find_extent(camera, &extent);
    if (status != CM_OK)
    {
        return status;
    }
    const cm_camera_options *from = cm_camera_describe(camera);
    const double times = scale > 0.0 ? scale : isinf(extent.step) ? 1.0 : 1.0 / extent.step;
    cm_camera_options made = {.size = sizeof made, .pixel_centre = from->pixel_centre};
    made.fx = times * from->fx;
    made.fy = times * from->fy;
    const double width =
        make_side(made.fx, made.pixel_centre, extent.least[0], extent.greatest[0], &made.cx);
    const double height =
        make_side(made.fy, made.pixel_centre, extent.least[1], extent.greatest[1], &made.cy);
    if (!(width * height < 0x1p31) || !(fmax(fabs(made.cx), fabs(made.cy)) < 0x1p31))
    {
        return CM_ERROR_RANGE;
    }
    made.width = (uint32_t)width;
    made.height = (uint32_t)height;
    *pinhole = made;
    return CM_OK;
}
