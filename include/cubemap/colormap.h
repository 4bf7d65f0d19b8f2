/* SPDX-License-Identifier: MIT
 *
 * Perceptually uniform colour maps: from a number t in [0, 1] to a colour, so that equal steps of t are equal steps for
 * the eye, as far as CIELUV knows it, or, for uniform maps, CAM16-UCS. A library of its own, cubemap-colormap, which
 * needs no other; the text of a cm_status comes from cm_status_text of libcubemap.
 *
 *   lch, luv    CIELUV of CIE 15:2004; L in [0, 100], chroma C >= 0, hue H in degrees in [0, 360), u = C cos H,
 *               v = C sin H. The white is that of sRGB, x = 0.3127, y = 0.3290 (D65)
 *   ucs         J', a', b' of CAM16-UCS (C. Li et al., Color Research and Application 42, 2017) with that white,
 *               L_A = 64 / pi / 5 cd/m^2, Y_b = 20, average surround. J' is 100 for white
 *   lab         CIELAB of CIE 15:2004 with the same white
 *   linear      sRGB before its transfer function, each channel in [0, 1] where the colour is inside the gamut
 *   srgb        after the transfer function of IEC 61966-2-1, joined where its branches meet; negative ones mirrored
 *   inside      a colour is inside sRGB if each linear channel is in [0, 1], or outside by 1e-9 at most
 *   clipping    never silent: what writes colours that are cut to [0, 1] says how many it has cut
 *   bad input   a NaN or an infinity gives NaN. Nothing traps
 *   threads     a map is constant after its creation: any number of threads may use one. Only creation allocates
 *
 * docs/guide/colormaps.md has the sources, tells what differs from them, and shows all maps.
 */
#ifndef CUBEMAP_COLORMAP_H
#define CUBEMAP_COLORMAP_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the catalogue: a constant table that describes every model ---- */

typedef enum cm_colormap_family
{
    CM_COLORMAP_SEQUENTIAL = 0,  /* ordered values from low to high */
    CM_COLORMAP_DIVERGING = 1,   /* values to both sides of a neutral middle */
    CM_COLORMAP_QUALITATIVE = 2, /* classes without an order */
    CM_COLORMAP_CYCLIC = 3       /* directions and phases: t = 1 is t = 0 */
} cm_colormap_family;

/* The space in which a map has constant speed: its own space. */
typedef enum cm_colormap_space
{
    CM_COLORMAP_CIELUV = 0,
    CM_COLORMAP_CAM16_UCS = 1
} cm_colormap_space;

#define CM_COLORMAP_PARAMETERS_MAX 5

/* The largest number of hues that a list of stops may have. */
#define CM_COLORMAP_STOPS_MAX 16

typedef struct cm_colormap_parameter_info
{
    const char *name;    /* "saturation-range" */
    const char *meaning; /* one line for people, with the paper's symbol */
    const char *unit;    /* "degrees"; "" for a ratio */
    double standard;     /* the value when none is given; NaN for a list of stops */
    double low;          /* smallest value */
    double high;         /* largest value */
    int low_excluded;    /* is low itself outside the range? */
    const char
        *stops; /* NULL for a number. Else the parameter is a list of stops HUE@PLACE/HUE@PLACE,
                            and this is its standard; low and high are the range of the hues */
} cm_colormap_parameter_info;

/* Read through pointers that the library gives out; it may grow at its end. */
typedef struct cm_colormap_info
{
    const char *identifier;    /* "sequential-single" */
    const char *aliases;       /* other names, apart by blanks; "" for none */
    const char *name;          /* one line for people */
    const char *source;        /* author, year, section */
    cm_colormap_family family; /* what it is for */
    size_t parameter_count;    /* 0 to CM_COLORMAP_PARAMETERS_MAX */
    cm_colormap_parameter_info parameter[CM_COLORMAP_PARAMETERS_MAX]; /* by index */
    cm_colormap_space space;                                          /* in which steps are equal */
} cm_colormap_info;

/* The number of models, and the model at an index below it (else NULL). The tables are constant and
 * live as long as the program. */
CM_API size_t cm_colormap_count(void);
CM_API const cm_colormap_info *cm_colormap_at(size_t index);

/* The model that an identifier or alias names (upper and lower case are the same), or NULL. */
CM_API const cm_colormap_info *cm_colormap_find(const char *name);

/* ---- the life of a map ---- */

typedef struct cm_colormap cm_colormap;

/* Make a map from a specification, NAME[:PARAMETER=VALUE[,PARAMETER=VALUE...]], for example
 * "sequential-single:hue=140" or "custom:hues=0@0.25/60@0.75"; NAME is an identifier or an alias of the
 * catalogue, upper and lower case are the same, values are decimal numbers of at most 100 characters, with
 * a point in every locale.
 * A list of stops is HUE@PLACE/HUE@PLACE/..., at most CM_COLORMAP_STOPS_MAX of them, hues in degrees,
 * places in [0, 1] and growing: a place is the lightness on the way from the dark end to the light one.
 * HUE/HUE/... spreads the hues evenly. Between two stops the hue goes the shorter way round the circle;
 * where both are equally long, it grows. Before the first stop and after the last it stays.
 * On success *map is to be given to cm_colormap_destroy.
 * Errors: CM_ERROR_ARGUMENT if an argument is NULL, CM_ERROR_SYNTAX, CM_ERROR_MAPPING (no map of that
 * name), CM_ERROR_PARAMETER, CM_ERROR_RANGE, CM_ERROR_MEMORY. */
CM_API cm_status cm_colormap_create(const char *specification, cm_colormap **map);

/* NULL is allowed. */
CM_API void cm_colormap_destroy(cm_colormap *map);

/* Is this a specification that cm_colormap_create takes? The same status as that would return. If it is
 * not CM_OK, and message is not NULL, at most message_size bytes of one line without a line end that says
 * what is wrong and what would be right are written to message, always ended by a zero byte if
 * message_size > 0. */
CM_API cm_status cm_colormap_check(const char *specification, char *message, size_t message_size);

/* What the map was made from. map must not be NULL here and below. parameter is NaN if index is not
 * below the descriptor's parameter_count, and for a list of stops. */
CM_API const cm_colormap_info *cm_colormap_describe(const cm_colormap *map);
CM_API double cm_colormap_parameter(const cm_colormap *map, size_t index);

/* The number of stops, 0 without such a list, and place and hue of one; NaN, NaN if index is not below
 * the number. */
CM_API size_t cm_colormap_stop_count(const cm_colormap *map);
CM_API void cm_colormap_stop(const cm_colormap *map, size_t index, double place_hue[2]);

/* The specification with all parameters, which makes a map of the same bits again. At most size bytes
 * are written to text, which may be NULL if size is 0, always ended by a zero byte if size > 0. Returns the
 * length of the whole text without that byte; 1024 bytes are enough. */
CM_API size_t cm_colormap_specification(const cm_colormap *map, char *text, size_t size);

/* ---- colours ---- */

typedef struct cm_colormap_color
{
    double lch[3];    /* lightness, chroma, hue in degrees */
    double luv[3];    /* CIELUV */
    double linear[3]; /* outside [0, 1] where the colour is outside the gamut */
    double srgb[3];   /* the same */
    int inside;       /* is the colour inside sRGB? */
} cm_colormap_color;

/* The colour at t in [0, 1]; t outside by at most 1e-9 is taken as the end, further outside, or no
 * number, all numbers of the colour are NaN and inside is 0. t = 0 and t = 1 are exactly the ends of the path;
 * the middle of a diverging map, t = 0.5, is exactly neutral (of a uniform one within 1e-9), and both its halves are of
 * the same length whatever the hues. Of a colour without chroma the hue is that of the path there. */
CM_API void cm_colormap_color_at(const cm_colormap *map, double t, cm_colormap_color *color);

/* The place of sample index of n. Neighbours are equally far apart in the map's space, corners between them or not: t
 * grows by the same step everywhere but across a corner (cm_colormap_corner), where it grows by more, so much
 * that the straight line from colour to colour is as long as the others. The first sample is at 0, the last at
 * 1; t grows strictly; the middle of an odd number of samples of a diverging map is at 0.5.
 * That holds, to 0.1 % of the step across a corner, where n is so large that i / (n - 1) would have 4 steps
 * between two corners and 2 between a corner and an end. Otherwise it may be that places are i / (n - 1), and
 * steps across corners short, as they are above n = 2^32. Besides:
 *   - where hues change, steps of the same length along a curve are lines of different lengths. They are
 *     within 0.6 % of their mean where the hue goes round by no more than 10 degrees from sample to sample,
 *     within 2 % where by no more than 20
 *   - a corner at which the path turns round by more than 150 degrees is a fold, whose tip would be cut off
 *     by up to 1 / sin of that angle steps. If that is more than a sixteenth of the way to the next corner or
 *     end, the fold is passed over as if the path went straight on, and the one step across it is short
 *   - where hues go far to and fro from stop to stop, such places are not always found: of random lists of up
 *     to 7 stops one in 10^4 is left as it is, of 12 to 16 stops about one in 30
 * The standard maps are within 2 % from n = 20 on, within 0.5 % from n = 28 on, and within 0.1 % from n = 64 on.
 * A qualitative map has no corner, and its samples are at i / (n - 1), or, where its hues go round so far that
 * the last would be closer to the first than to its neighbour, at i / n of the circle, so that the full circle
 * does not repeat its first colour. Those of a cyclic map are at i / n. 0 if n is 1; NaN if index is not below n.
 * Each call plans all places anew; cm_colormap_samples plans them once. */
CM_API double cm_colormap_position(const cm_colormap *map, size_t n, size_t index);

/* What has been cut to [0, 1]. */
typedef struct cm_colormap_clipping
{
    size_t count;   /* of samples that are outside sRGB */
    size_t first;   /* index of the first of them; 0 if there is none */
    double first_t; /* its place; NaN if there is none */
    double excess;  /* how far the worst linear channel is outside [0, 1]; 0 if there is none */
} cm_colormap_clipping;

/* n colours at those places, red, green, blue, red, green, ...: 3 n numbers of nonlinear sRGB in [0, 1],
 * or 3 n bytes, rounded to nearest. Colours outside sRGB are cut to [0, 1] channel by channel and counted
 * in *clipping, which may be NULL for who has asked cm_colormap_inside. srgb may be NULL if n is 0. */
CM_API void cm_colormap_samples(const cm_colormap *map, size_t n, double *srgb,
                                cm_colormap_clipping *clipping);
CM_API void cm_colormap_samples_u8(const cm_colormap *map, size_t n, uint8_t *srgb,
                                   cm_colormap_clipping *clipping);

/* The length of the path in the map's space: |dLUV / dt|, or |ducs / dt|, everywhere. */
CM_API double cm_colormap_length(const cm_colormap *map);

/* The places inside (0, 1), growing, where the path changes its direction: equal steps of t across one are
 * shortcuts, which samples make up for. NaN if index is not below the number. The middle of a map by
 * lightness, where the chroma is largest, stops of a list of hues, and the middle of a diverging map are
 * such places. */
CM_API size_t cm_colormap_corner_count(const cm_colormap *map);
CM_API double cm_colormap_corner(const cm_colormap *map, size_t index);

/* ---- the gamut ---- */

/* Is every colour of the map, not only of some samples, inside sRGB? The limit of the gamut is
 * cm_colormap_largest_chroma, that of a uniform map the walls of linear sRGB; its distance is looked at in 1024
 * places of each piece of the path, and searched for its minimum between those. */
CM_API int cm_colormap_inside(const cm_colormap *map);

/* The largest chroma that sRGB has with this lightness and hue (degrees), in closed form: with both fixed
 * each channel's limit is linear in the chroma. 0 for a lightness of 0 or 100, NaN outside [0, 100]. */
CM_API double cm_colormap_largest_chroma(double lightness, double hue);

/* The largest saturation with which the whole map, its other parameters unchanged, is inside sRGB;
 * infinite if the saturation changes nothing, as there is none in uniform maps; NaN if even 0 is too much,
 * because the ends, whose saturation is 1 - saturation-range, stick out. It may be beyond the parameter's range. */
CM_API double cm_colormap_largest_saturation(const cm_colormap *map);

/* This map made to fit into sRGB: a copy, if it is inside; else with its saturation lowered to
 * cm_colormap_largest_saturation; where the ends stick out too, after its saturation-range has been raised
 * until they do not. map is not changed. On success *fitted is to be given to cm_colormap_destroy.
 * Errors: CM_ERROR_ARGUMENT if an argument is NULL, CM_ERROR_MEMORY. */
CM_API cm_status cm_colormap_fit(const cm_colormap *map, cm_colormap **fitted);

/* ---- conversions of single colours; the result may overwrite the argument ---- */

CM_API void cm_colormap_luv_from_lch(const double lch[3], double luv[3]);
CM_API void cm_colormap_lch_from_luv(const double luv[3], double lch[3]);

/* Black, L = 0, has no chromaticity: any luv with it gives 0, 0, 0, and that gives luv 0, 0, 0. L must not be
 * negative. Colours of which the eye has none, v' <= 0, give NaN; so do channels that sum up to a
 * negative luminance. */
CM_API void cm_colormap_linear_from_luv(const double luv[3], double linear[3]);
CM_API void cm_colormap_luv_from_linear(const double linear[3], double luv[3]);

CM_API void cm_colormap_srgb_from_linear(const double linear[3], double srgb[3]);
CM_API void cm_colormap_linear_from_srgb(const double srgb[3], double linear[3]);

CM_API void cm_colormap_ucs_from_linear(const double linear[3], double ucs[3]);

/* NaN where no light looks so: J' outside [0, 242.8], or chroma that is too large. J' = 0 is black. */
CM_API void cm_colormap_linear_from_ucs(const double ucs[3], double linear[3]);

CM_API void cm_colormap_lab_from_linear(const double linear[3], double lab[3]);

/* ---- how different colours look ---- */

/* The difference of two colours of CIELAB by CIEDE2000 with k_L = k_C = k_H = 1 (G. Sharma et al., Color
 * Research and Application 30, 2005): about 1 is just seen in large fields. The mean of exactly opposite hues,
 * where the formula jumps, is that of the paper. */
CM_API double cm_colormap_ciede2000(const double one[3], const double other[3]);

/* Conditions under which colours are seen, with average surround. */
typedef struct cm_colormap_viewing
{
    double white[3];   /* XYZ, in the scale of the colours: Y = 100 */
    double luminance;  /* of what the eye adapts to, L_A, in cd/m^2 */
    double background; /* its Y, Y_b, in the same scale */
} cm_colormap_viewing;

typedef struct cm_colormap_appearance
{
    double lightness;    /* J */
    double chroma;       /* C */
    double hue;          /* h, degrees in [0, 360) */
    double colorfulness; /* M */
} cm_colormap_appearance;

/* CAM16 of a colour XYZ. viewing may be NULL: those of sRGB, as above. All numbers are NaN for a colour of negative
 * lightness, and for viewing conditions that are not all positive. */
CM_API void cm_colormap_cam16(const double xyz[3], const cm_colormap_viewing *viewing,
                              cm_colormap_appearance *appearance);

#ifdef __cplusplus
}
#endif

#endif
