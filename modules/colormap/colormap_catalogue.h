/* SPDX-License-Identifier: MIT
 *
 * The models, and the values of the parameters of one of them.
 */
#ifndef COLORMAP_CATALOGUE_H
#define COLORMAP_CATALOGUE_H

#include <cubemap/colormap.h>

/* The models in the order of the catalogue. */
typedef enum cm_colormap_model
{
    CM_COLORMAP_SINGLE,
    CM_COLORMAP_RAINBOW,
    CM_COLORMAP_CUSTOM,
    CM_COLORMAP_SATURATION,
    CM_COLORMAP_DIVERGING_LIGHTNESS,
    CM_COLORMAP_DIVERGING_SATURATION,
    CM_COLORMAP_HUES,
    CM_COLORMAP_UNIFORM_PURPLE_YELLOW, /* the first of those in CAM16-UCS */
    CM_COLORMAP_UNIFORM_RED_YELLOW,
    CM_COLORMAP_UNIFORM_BLUE,
    CM_COLORMAP_UNIFORM_GREEN,
    CM_COLORMAP_UNIFORM_BLUE_RED,
    CM_COLORMAP_UNIFORM_PURPLE_GREEN,
    CM_COLORMAP_UNIFORM_CYCLIC
} cm_colormap_model;

/* What a specification says. */
typedef struct cm_colormap_parameters
{
    size_t index; /* in the catalogue */
    double value[CM_COLORMAP_PARAMETERS_MAX];
    size_t stop_count;
    double place[CM_COLORMAP_STOPS_MAX];
    double hue[CM_COLORMAP_STOPS_MAX];
} cm_colormap_parameters;

/* The value of the parameter of that name, absent if the model has none. */
double cm_colormap_value(const cm_colormap_parameters *parameters, const char *name, double absent);
void cm_colormap_set_value(cm_colormap_parameters *parameters, const char *name, double value);

/* As cm_colormap_find, of a name that is a part of a text. */
const cm_colormap_info *cm_colormap_find_word(const char *name, size_t length);
int cm_colormap_same_word(const char *a, size_t a_length, const char *b, size_t b_length);

#endif
