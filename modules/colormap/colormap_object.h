/* SPDX-License-Identifier: MIT
 *
 * What the files of the library share and its users do not see.
 */
#ifndef COLORMAP_INTERNAL_H
#define COLORMAP_INTERNAL_H

#include <cubemap/colormap.h>

#define CM_COLORMAP_PI 3.14159265358979323846264338327950288

/* Chroma that is beyond the gamut by no more than this is rounding; it moves a linear channel by much less
 * than the 1e-9 that count as inside there. */
#define CM_COLORMAP_CHROMA_ROUNDING 1e-9

/* The models in the order of the catalogue. */
typedef enum cm_colormap_model
{
    CM_COLORMAP_SINGLE,
    CM_COLORMAP_RAINBOW,
    CM_COLORMAP_CUSTOM,
    CM_COLORMAP_SATURATION,
    CM_COLORMAP_DIVERGING_LIGHTNESS,
    CM_COLORMAP_DIVERGING_SATURATION,
    CM_COLORMAP_HUES
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

/* A point of the path. Its chroma is strength * vivid + ends * base, where strength is the product of
 * saturation and saturation range, and ends is the saturation of the ends. */
typedef struct cm_colormap_anchor
{
    double lightness;
    double hue; /* degrees, not reduced: what is between two anchors is linear */
    double vivid;
    double base;
} cm_colormap_anchor;

/* Between two anchors lightness, chroma and hue are linear. */
typedef struct cm_colormap_piece
{
    cm_colormap_anchor from;
    cm_colormap_anchor to;
    double chroma_from;
    double chroma_to;
    double t_from;
    double t_to;
    double length;
} cm_colormap_piece;

/* The two ends, the middle, and the stops, give one piece less. */
#define CM_COLORMAP_PIECES_MAX (CM_COLORMAP_STOPS_MAX + 2)

struct cm_colormap
{
    cm_colormap_parameters parameters;
    double strength;
    double ends;
    double length;
    size_t piece_count;
    cm_colormap_piece piece[CM_COLORMAP_PIECES_MAX];
    size_t corner_count;
    double corner[CM_COLORMAP_PIECES_MAX];
    double corner_sine[CM_COLORMAP_PIECES_MAX]; /* of half the angle inside the corner */
    int mirrored; /* is t the mirror image of 1 - t but for the hue? */
};

/* specification.c: parse and check; on CM_OK *parameters is set, on failure message (if any) says why. */
cm_status cm_colormap_parse(const char *specification, cm_colormap_parameters *parameters,
                            char *message, size_t message_size);

/* catalogue.c: the value of the parameter of that name, absent if the model has none. */
double cm_colormap_value(const cm_colormap_parameters *parameters, const char *name, double absent);
void cm_colormap_set_value(cm_colormap_parameters *parameters, const char *name, double value);
const cm_colormap_info *cm_colormap_find_word(const char *name, size_t length);
int cm_colormap_same_word(const char *a, size_t a_length, const char *b, size_t b_length);

/* path.c: everything but map->parameters from those; and the colour at x in [0, 1] of a piece, where x is the
 * part of the way that its lightness, chroma and hue have gone. */
void cm_colormap_build(cm_colormap *map);
void cm_colormap_lch_in_piece(const cm_colormap_piece *piece, double x, double lch[3]);

/* The same for t in [0, 1] of the whole path. */
void cm_colormap_luv_at(const cm_colormap *map, double t, double luv[3]);

/* Exactly from and to at 0 and 1, and between them where both are the same. */
static inline double cm_colormap_mix(double from, double to, double x)
{
    return x < 0.5 ? from + x * (to - from) : to - (1.0 - x) * (to - from);
}

/* plan.c: where n samples are. Each run of samples goes on in equal steps from its first one, which is the
 * first behind a corner. */
typedef struct cm_colormap_run
{
    size_t first;
    double t;
} cm_colormap_run;

typedef struct cm_colormap_plan
{
    size_t n;
    int is_even; /* 0: there is no corner, or no room for this; then there is no more in the plan */
    int mirrored;
    double step; /* of t */
    size_t run_count;
    cm_colormap_run run[CM_COLORMAP_PIECES_MAX + 1];
} cm_colormap_plan;

void cm_colormap_make_plan(const cm_colormap *map, size_t n, cm_colormap_plan *plan);
double cm_colormap_place(const cm_colormap *map, const cm_colormap_plan *plan, size_t index);

/* colormap.c: a map of these parameters. */
cm_status cm_colormap_make(const cm_colormap_parameters *parameters, cm_colormap **map);

#endif
