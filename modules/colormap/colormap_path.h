/* SPDX-License-Identifier: MIT
 *
 * A map: its parameters and its path through CIELUV, or CAM16-UCS, in pieces.
 */
#ifndef COLORMAP_PATH_H
#define COLORMAP_PATH_H

#include "cam16.h"
#include "colormap_catalogue.h"
#include "uniform_path.h"

/* A point of the path. Its chroma is strength * vivid + ends * base, where strength is the product of
 * saturation and saturation range, and ends is the saturation of the ends. */
typedef struct cm_colormap_anchor
{
    double lightness;
    double hue; /* degrees, not reduced: what is between two anchors is linear */
    double vivid;
    double base;
} cm_colormap_anchor;

/* Between two anchors lightness, chroma and hue are linear. The path of a uniform map has no anchors, but
 * polynomials. */
typedef struct cm_colormap_piece
{
    cm_colormap_anchor from;
    cm_colormap_anchor to;
    double chroma_from;
    double chroma_to;
    double t_from;
    double t_to;
    double length;
    cm_uniform_piece uniform;
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
    int is_uniform;                             /* in CAM16-UCS */
    cm_cam16_conditions seen;
    int mirrored; /* is t the mirror image of 1 - t but for the hue? */
};

/* The object of these parameters, with its path. */
cm_status cm_colormap_make(const cm_colormap_parameters *parameters, cm_colormap **map);

/* Everything but map->parameters from those. */
void cm_colormap_build(cm_colormap *map);

/* The colour at x in [0, 1] of a piece, where x is the part of the way that its lightness, chroma and hue have
 * gone. */
void cm_colormap_lch_in_piece(const cm_colormap_piece *piece, double x, double lch[3]);

/* The colour of a uniform map there, not cut. */
void cm_colormap_linear_in_piece(const cm_colormap *map, const cm_colormap_piece *piece, double x,
                                 double linear[3]);

/* Where the path is at t in [0, 1], of a map in CIELUV. */
void cm_colormap_luv_at(const cm_colormap *map, double t, double luv[3]);

/* Exactly from and to at 0 and 1, and between them where both are the same. */
static inline double cm_colormap_mix(double from, double to, double x)
{
    return x < 0.5 ? from + x * (to - from) : to - (1.0 - x) * (to - from);
}

#endif
