/* SPDX-License-Identifier: MIT
 *
 * Smaller pictures of a surface, each of half the size, and pictures with what the sphere has around them: for textures
 * that are filtered across the seams of a cube map or of an equirectangular picture.
 *
 *   levels      level 0 is what is given; each next one has half the size both ways, rounded up, to 1 x 1 of a plane
 *   seams       each level is filtered along the sphere: what is beyond a plane's edge comes from its neighbour
 *   example     cm_surface_create("cube:gnomonic;size=512", ...), cm_mips_create, cm_mips_pictures(mips, 1)
 */
#ifndef CUBEMAP_MIPS_H
#define CUBEMAP_MIPS_H

#include <cubemap/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Levels of pictures, from cm_mips_create to cm_mips_destroy. */
typedef struct cm_mips cm_mips;

/* All levels of a surface's pictures. options say what values are, as of a plan: transfer, gamma, alpha, alpha_multiplied,
 * not_finite, dither and instructions; the rest of them is not looked at. NULL: values are mixed as they are stored.
 * Pictures of all levels have the type of those that are given, dense pixels and rows; where a picture has several planes
 * they stand as in level 0, and what is in no plane is 0. threads as in threads.h; the bits do not depend on it. On
 * success *mips is to be given to cm_mips_destroy; the pictures that were given must live as long.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (pictures of another size than the surface's, or not alike; an option),
 * CM_ERROR_MEMORY, CM_ERROR_INSTRUCTIONS. */
CM_API cm_status cm_mips_create(const cm_surface *surface, const cm_image *pictures,
                                const cm_plan_options *options, unsigned threads, cm_mips **mips);

/* NULL is allowed. */
CM_API void cm_mips_destroy(cm_mips *mips);

/* The number of levels, 1 at least. */
CM_API uint32_t cm_mips_count(const cm_mips *mips);

/* The pictures of a level, as many as the surface has; NULL if there is no such level. They live as long as mips. */
CM_API const cm_image *cm_mips_pictures(const cm_mips *mips, uint32_t level);

/* No border is wider. */
#define CM_BORDER_MOST 128

/* Pictures of the planes of a surface, as they are without a layout, with `border` pixels of what the sphere has around
 * them. to points to cm_surface_plane_count pictures, plane width + 2 border wide, plane height + 2 border high, of as
 * many channels as the surface's pictures and of any type. What the surface does not show around a plane is its nearest
 * pixel. Pixels of a plane that are beside its map, as the corners of a disc, have what the sphere has there if they are near
 * it, and else 0. options as in cm_mips_create.
 * Errors: those of cm_mips_create; CM_ERROR_RANGE also for a border of more than CM_BORDER_MOST, or of more than half
 * the extent of a plane whose kind does not go on beyond its edges by itself, if that is more than 6. */
CM_API cm_status cm_border(const cm_surface *surface, const cm_image *pictures, uint32_t border,
                           const cm_plan_options *options, unsigned threads, cm_image *to);

#ifdef __cplusplus
}
#endif

#endif
