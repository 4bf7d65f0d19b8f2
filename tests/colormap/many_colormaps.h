/* SPDX-License-Identifier: MIT
 *
 * Maps of specifications, of every model, and of parameters from all over their ranges.
 */
#ifndef TESTS_COLORMAP_MANY_COLORMAPS_H
#define TESTS_COLORMAP_MANY_COLORMAPS_H

#include <cubemap/colormap.h>

#include "tests/colormap/own_colors.h"
#include "tests/suite.h"

static inline cm_colormap *make(const char *specification)
{
    cm_colormap *map = NULL;
    char message[400] = "";
    cm_colormap_check(specification, message, sizeof message);
    REQUIRE(cm_colormap_create(specification, &map) == CM_OK, "%s: %s", specification, message);
    return map;
}

static inline cm_colormap *make_fitted(const char *specification)
{
    cm_colormap *map = make(specification);
    cm_colormap *fitted = NULL;
    REQUIRE(cm_colormap_fit(map, &fitted) == CM_OK, "%s", specification);
    cm_colormap_destroy(map);
    return fitted;
}

static inline cm_colormap_color color_at(const cm_colormap *map, double t)
{
    cm_colormap_color color;
    cm_colormap_color_at(map, t, &color);
    return color;
}

static inline int is_uniform(const cm_colormap *map)
{
    return cm_colormap_describe(map)->space == CM_COLORMAP_CAM16_UCS;
}

/* In the space of the map. */
static inline void own_point(const cm_colormap *map, const double srgb[3], double point[3])
{
    (is_uniform(map) ? own_ucs : own_luv)(srgb, point);
}

static inline double parameter(const cm_colormap *map, const char *name)
{
    const cm_colormap_info *info = cm_colormap_describe(map);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        if (strcmp(info->parameter[i].name, name) == 0)
        {
            return cm_colormap_parameter(map, i);
        }
    }
    return (double)NAN;
}

/* The same numbers in every run. */
static uint64_t state = 1;

static inline double uniform(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

/* A specification with parameters from all over their ranges; now and then at their ends. */
static inline void any_specification(const cm_colormap_info *info, char *text, size_t size)
{
    int length = snprintf(text, size, "%s", info->identifier);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_colormap_parameter_info *p = &info->parameter[i];
        double value = uniform(0.0, 1.0) < 0.1 ? p->high : uniform(p->low, p->high);
        value = p->low_excluded && value <= p->low + 1e-3 ? p->low + 1e-3 : value;
        length += snprintf(text + length, size - (size_t)length, "%c%s=%.17g", i == 0 ? ':' : ',',
                           p->name, value);
        for (int k = (int)uniform(0.0, 7.0); p->stops != NULL && k > 0; k--)
        {
            length += snprintf(text + length, size - (size_t)length, "/%.17g", uniform(0.0, 360.0));
        }
    }
}

/* Call check for every model with standard parameters, and with others, so many of each. */
static inline void for_many_maps(int others, cm_colormap *(*maker)(const char *),
                                 void (*check)(const cm_colormap *, const char *))
{
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const int more = cm_colormap_at(i)->parameter_count > 0 ? others : 0;
        for (int k = 0; k <= more; k++)
        {
            char text[600];
            snprintf(text, sizeof text, "%s", cm_colormap_at(i)->identifier);
            if (k > 0)
            {
                any_specification(cm_colormap_at(i), text, sizeof text);
            }
            cm_colormap *map = maker(text);
            check(map, text);
            cm_colormap_destroy(map);
        }
    }
}

static inline int crosses_corner(const cm_colormap *map, double from, double to)
{
    for (size_t i = 0; i < cm_colormap_corner_count(map); i++)
    {
        if (cm_colormap_corner(map, i) > from && cm_colormap_corner(map, i) < to)
        {
            return 1;
        }
    }
    return 0;
}

static inline double hue_difference(double a, double b)
{
    return fabs(remainder(a - b, 360.0));
}

static inline int all_nan(const double values[3])
{
    return isnan(values[0]) && isnan(values[1]) && isnan(values[2]);
}

/* The map of its own specification has the same bits. */
static inline void check_specification(const cm_colormap *map, const char *text)
{
    char written[1024], cut[1024];
    size_t length = cm_colormap_specification(map, written, sizeof written);
    ck_assert_uint_eq(length, strlen(written));
    ck_assert_uint_eq(cm_colormap_specification(map, NULL, 0), length);
    for (size_t size = 1; size < length + 3; size += 7)
    {
        memset(cut, 'x', sizeof cut);
        ck_assert_uint_eq(cm_colormap_specification(map, cut, size), length);
        ck_assert_uint_eq(strlen(cut), size <= length ? size - 1 : length);
        ck_assert_int_eq(strncmp(cut, written, size - 1), 0);
        ck_assert_int_eq(cut[size], 'x');
    }
    cm_colormap *again = make(written);
    for (int i = 0; i <= 50; i++)
    {
        cm_colormap_color a = color_at(map, i / 50.0);
        cm_colormap_color b = color_at(again, i / 50.0);
        REQUIRE(memcmp(a.lch, b.lch, sizeof a.lch) == 0 &&
                    memcmp(a.srgb, b.srgb, sizeof a.srgb) == 0,
                "%s and %s differ", text, written);
    }
    cm_colormap_destroy(again);
}

#endif
