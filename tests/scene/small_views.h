/* SPDX-License-Identifier: MIT
 *
 * Views of some pixels, and folders of them.
 */
#ifndef TESTS_SCENE_SMALL_VIEWS_H
#define TESTS_SCENE_SMALL_VIEWS_H

#include <stdint.h>

#include "modules/scene/io/sequence.h"

enum
{
    WIDTH = 8,
    HEIGHT = 6,
    VIEWS = 5
};

extern char message[CM_IMAGE_MESSAGE];
/* Of the view that was made last. */
extern uint16_t depth_units[WIDTH * HEIGHT];
extern float depth_metres[WIDTH * HEIGHT];
extern unsigned char colors[WIDTH * HEIGHT * 3];

/* To be destroyed. */
cm_camera *make_camera(uint32_t width);
/* Depth in units of 1/5000 m, or in metres as floating point. */
cm_view make_view(const cm_camera *camera, unsigned k, int metres);
/* A new folder of VIEWS views in place of one that is there; its name as in_folder has it. */
const char *write_views(const char *name, cm_sequence_layout layout, int metres);

#endif
