/* SPDX-License-Identifier: MIT
 *
 * What photographs of the whole sphere, or of a part of it, say of themselves: the fields of Google's Photo Sphere XMP
 * ("GPano"), from and to text, and from and to a surface. A part of cubemap-image.
 *
 *   example     cm_panorama_read(xmp, length, &panorama), cm_panorama_surface(&panorama, width, height, text,
 *               sizeof text, &rotation), cm_surface_create(text, &options, &surface)
 *   source      Google, Photo Sphere XMP Metadata; the namespace is http://ns.google.com/photos/1.0/panorama/
 *   threads     nothing is kept: any number of threads may call
 */
#ifndef CUBEMAP_PANORAMA_H
#define CUBEMAP_PANORAMA_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An equirectangular picture: a rectangle of a whole one, in pixels of it. */
typedef struct cm_panorama
{
    size_t size;             /* sizeof(cm_panorama) */
    uint32_t full_width;     /* FullPanoWidthPixels; 0: the picture is the whole */
    uint32_t full_height;    /* FullPanoHeightPixels; 0: the picture is the whole */
    uint32_t cropped_left;   /* CroppedAreaLeftPixels */
    uint32_t cropped_top;    /* CroppedAreaTopPixels */
    uint32_t cropped_width;  /* CroppedAreaImageWidthPixels */
    uint32_t cropped_height; /* CroppedAreaImageHeightPixels */
    double heading; /* PoseHeadingDegrees, clockwise from north, [0, 360); NaN: not known */
    double pitch;   /* PosePitchDegrees, [-90, 90], upwards */
    double roll;    /* PoseRollDegrees, (-180, 180]: the horizon turns anticlockwise */
} cm_panorama;

/* Is it one: the rectangle inside the whole, which is not larger than a picture can be, angles in their ranges?
 * CM_OK, CM_ERROR_ARGUMENT (NULL, size) or CM_ERROR_RANGE. */
CM_API cm_status cm_panorama_check(const cm_panorama *panorama);

/* From a text of length bytes that has the fields somewhere, as attributes or as elements of RDF, with any prefix of the
 * namespace; the rest of the text is not looked at. panorama->size must be set.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_UNSUPPORTED if there is no such field, or the projection is not equirectangular;
 * CM_ERROR_SYNTAX (a field is not a number); CM_ERROR_RANGE. */
CM_API cm_status cm_panorama_read(const char *text, size_t length, cm_panorama *panorama);

/* As a packet of XMP, ended by a zero byte. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (cm_panorama_check, or
 * full_width or full_height 0); CM_ERROR_SPACE if it has more than size bytes: 2048 are enough for any. */
CM_API cm_status cm_panorama_write(const cm_panorama *panorama, char *text, size_t size);

/* The specification of the surface that a picture of width x height pixels is, which may have been scaled since it was
 * cropped; and how it stands, north ahead and longitude clockwise: rotation may be NULL.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (cm_panorama_check, or width or height 0); CM_ERROR_SPACE. */
CM_API cm_status cm_panorama_surface(const cm_panorama *panorama, uint32_t width, uint32_t height,
                                     char *specification, size_t size, cm_rotation *rotation);

/* The fields of a surface of kind equirect. panorama->size must be set. CM_OK; CM_ERROR_ARGUMENT;
 * CM_ERROR_UNSUPPORTED (another kind); CM_ERROR_RANGE if its edges are farther than 1/1000 pixel from those of pixels of
 * a whole picture, which the fields cannot say. A part cannot go on at the whole picture's other edge: one across
 * longitude 180 is in the middle of a whole that its heading turns. */
CM_API cm_status cm_panorama_of_surface(const cm_surface *surface, cm_panorama *panorama);

#ifdef __cplusplus
}
#endif

#endif
