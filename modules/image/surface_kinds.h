/* SPDX-License-Identifier: MIT
 *
 * The kinds of surfaces, each made by a function of its own.
 */
#ifndef MODULES_IMAGE_SURFACE_KINDS_H
#define MODULES_IMAGE_SURFACE_KINDS_H

#include "surface_specification.h"

/* What a kind gets to make a surface of. */
typedef struct cm_surface_wish
{
    cm_surface_words *words;
    const cm_surface_options *options; /* all zeros where the caller has none */
    int sizes_matter;                  /* 0: a missing size is no error; the surface is not kept */
    cm_complaint complaint;
} cm_surface_wish;

/* Fills a surface of zeros: methods, planes, pictures, and what the kind keeps; and its specification. What it
 * allocates cm_surface_destroy frees. */
typedef cm_status (*cm_surface_make)(cm_surface *surface, const cm_surface_wish *wish);

cm_status cm_surface_make_cylinder(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_cube(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_chart(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_view(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_fisheye(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_paraboloids(cm_surface *surface, const cm_surface_wish *wish);
cm_status cm_surface_make_healpix(cm_surface *surface, const cm_surface_wish *wish);

/* ---- what makers share ---- */

/* Square planes in rows and columns, and the pixels of a picture that are on none. */
typedef struct cm_plane_grid
{
    uint32_t columns;
    uint32_t rows;
    uint32_t more_columns; /* pixels */
    uint32_t more_rows;
    double edge; /* that the specification has said already, else 0 */
} cm_plane_grid;

/* The sizes of planes and pictures, from the key size, which is the edge of a plane, or the size of the pictures. */
cm_status cm_surface_grid_size(cm_surface *surface, const cm_surface_wish *wish,
                               const cm_plane_grid *grid);

/* The size of one picture of any width and height: the keys size, which is the width, and height, or the size of the
 * picture; what is missing follows from width / height, for which the key aspect stands, too. The planes are the picture. */
cm_status cm_surface_free_size(cm_surface *surface, const cm_surface_wish *wish, double aspect);

/* Says size and height of the picture, if it has some. */
cm_status cm_surface_say_size(cm_surface *surface);

/* A number that a kind has among its parameters. */
typedef struct cm_surface_parameter
{
    const char *name;
    double low;
    double high;
} cm_surface_parameter;

/* NAME=VALUE,... after the kind; values of what is not there stay as they are. CM_OK, CM_ERROR_SYNTAX,
 * CM_ERROR_PARAMETER or CM_ERROR_RANGE. */
cm_status cm_surface_parameters(const cm_surface_wish *wish, const cm_surface_parameter *parameter,
                                size_t count, double *value);

/* Appends to the specification; what does not fit is CM_ERROR_SYNTAX. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
cm_status
cm_surface_say(cm_surface *surface, const char *format, ...);

/* Pictures are not larger than this either way. */
#define CM_PICTURE_MOST 1073741824.0

#endif
