/* SPDX-License-Identifier: MIT
 *
 * Until light that is scattered is here: it is refused.
 */
#include "tof_object.h"

cm_status tof_virtual_lights_create(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                                    const cm_tof_options *options, const tof_waves *waves,
                                    cm_pool *pool, tof_virtual_lights **made)
{
    (void)instant, (void)lamp, (void)lamps, (void)options, (void)waves, (void)pool, (void)made;
    return CM_ERROR_UNSUPPORTED;
}

void tof_virtual_lights_destroy(tof_virtual_lights *lights)
{
    (void)lights;
}

uint32_t tof_virtual_lights_count(const tof_virtual_lights *lights)
{
    (void)lights;
    return 0;
}

cm_status tof_virtual_lights_add(const tof_virtual_lights *lights, const tof_points *points,
                                 tof_radiance *radiance)
{
    (void)lights, (void)points, (void)radiance;
    return CM_ERROR_UNSUPPORTED;
}

cm_status tof_paths_add(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                        const cm_tof_options *options, const tof_waves *waves,
                        const tof_points *points, tof_radiance *radiance)
{
    (void)instant, (void)lamp, (void)lamps, (void)options, (void)waves, (void)points,
        (void)radiance;
    return CM_ERROR_UNSUPPORTED;
}

cm_status tof_environment_add(const tof_instant *instant, const cm_tof_environment *environment,
                              const cm_tof_options *options, const tof_points *points,
                              tof_radiance *radiance)
{
    (void)instant, (void)environment, (void)options, (void)points, (void)radiance;
    return CM_ERROR_UNSUPPORTED;
}

double tof_environment_radiance(const cm_tof_environment *environment, const double direction[3])
{
    (void)direction;
    return environment->constant;
}

double cm_brdf_value(const cm_brdf *brdf, const double normal[3], const double in[3],
                     const double out[3])
{
    (void)brdf, (void)normal, (void)in, (void)out;
    return 0.0;
}
