/* SPDX-License-Identifier: MIT
 *
 * The life of a map, what it was made from, and its samples.
 */
#include "colormap_specification.h"
#include "colormap_path.h"
#include "plan.h"

#include <math.h>
#include <stdlib.h>

cm_status cm_colormap_create(const char *specification, cm_colormap **map)
{
    if (specification == NULL || map == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_colormap_parameters parameters;
    const cm_status status = cm_colormap_parse(specification, &parameters, NULL, 0);
    return status == CM_OK ? cm_colormap_make(&parameters, map) : status;
}

void cm_colormap_destroy(cm_colormap *map)
{
    free(map);
}

const cm_colormap_info *cm_colormap_describe(const cm_colormap *map)
{
    return cm_colormap_at(map->parameters.index);
}

double cm_colormap_parameter(const cm_colormap *map, size_t index)
{
    return index < cm_colormap_describe(map)->parameter_count ? map->parameters.value[index]
                                                              : (double)NAN;
}

size_t cm_colormap_stop_count(const cm_colormap *map)
{
    return map->parameters.stop_count;
}

void cm_colormap_stop(const cm_colormap *map, size_t index, double place_hue[2])
{
    const int is_stop = index < map->parameters.stop_count;
    place_hue[0] = is_stop ? map->parameters.place[index] : (double)NAN;
    place_hue[1] = is_stop ? map->parameters.hue[index] : (double)NAN;
}

double cm_colormap_length(const cm_colormap *map)
{
    return map->length;
}

size_t cm_colormap_corner_count(const cm_colormap *map)
{
    return map->corner_count;
}

double cm_colormap_corner(const cm_colormap *map, size_t index)
{
    return index < map->corner_count ? map->corner[index] : (double)NAN;
}

size_t cm_colormap_specification(const cm_colormap *map, char *text, size_t size)
{
    return cm_colormap_write(&map->parameters, text, size);
}

/* ---- samples ---- */

double cm_colormap_position(const cm_colormap *map, size_t n, size_t index)
{
    if (index >= n)
    {
        return (double)NAN;
    }
    cm_colormap_plan plan;
    cm_colormap_make_plan(map, n, &plan);
    return cm_colormap_place(map, &plan, index);
}

/* How far outside [0, 1] the worst channel is. */
static double excess_of(const double linear[3])
{
    double excess = 0.0;
    for (int i = 0; i < 3; i++)
    {
        excess = fmax(excess, fmax(-linear[i], linear[i] - 1.0));
    }
    return excess;
}

/* The sample, cut to [0, 1]. */
static void take_sample(const cm_colormap *map, const cm_colormap_plan *plan, size_t index,
                        double srgb[3], cm_colormap_clipping *clipping)
{
    cm_colormap_color color;
    const double t = cm_colormap_place(map, plan, index);
    cm_colormap_color_at(map, t, &color);
    for (int i = 0; i < 3; i++)
    {
        srgb[i] = fmin(fmax(color.srgb[i], 0.0), 1.0);
    }
    if (!color.inside)
    {
        if (clipping->count++ == 0)
        {
            clipping->first = index;
            clipping->first_t = t;
        }
        clipping->excess = fmax(clipping->excess, excess_of(color.linear));
    }
}

static const cm_colormap_clipping no_clipping = {0, 0, (double)NAN, 0.0};

void cm_colormap_samples(const cm_colormap *map, size_t n, double *srgb,
                         cm_colormap_clipping *clipping)
{
    cm_colormap_clipping found = no_clipping;
    cm_colormap_plan plan;
    cm_colormap_make_plan(map, n, &plan);
    for (size_t i = 0; i < n; i++)
    {
        take_sample(map, &plan, i, srgb + 3 * i, &found);
    }
    if (clipping != NULL)
    {
        *clipping = found;
    }
}

void cm_colormap_samples_u8(const cm_colormap *map, size_t n, uint8_t *srgb,
                            cm_colormap_clipping *clipping)
{
    cm_colormap_clipping found = no_clipping;
    cm_colormap_plan plan;
    cm_colormap_make_plan(map, n, &plan);
    for (size_t i = 0; i < n; i++)
    {
        double sample[3];
        take_sample(map, &plan, i, sample, &found);
        for (size_t k = 0; k < 3; k++)
        {
            srgb[3 * i + k] = (uint8_t)(sample[k] * 255.0 + 0.5);
        }
    }
    if (clipping != NULL)
    {
        *clipping = found;
    }
}
