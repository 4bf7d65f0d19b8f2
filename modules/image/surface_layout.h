/* SPDX-License-Identifier: MIT
 *
 * How the six faces of a cube stand in pictures: the key layout.
 */
#ifndef MODULES_IMAGE_SURFACE_LAYOUT_H
#define MODULES_IMAGE_SURFACE_LAYOUT_H

#include "surface_kinds.h"

/* Sets size, pictures and placements of a cube whose frame is known, and says the layout. */
cm_status cm_surface_lay_out(cm_surface *surface, const cm_surface_wish *wish);

#endif
