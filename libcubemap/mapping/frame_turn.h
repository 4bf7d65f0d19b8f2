/* SPDX-License-Identifier: MIT
 *
 * How a frame differs from geo, for the loops.
 */
#ifndef LIBCUBEMAP_MAPPING_FRAME_TURN_H
#define LIBCUBEMAP_MAPPING_FRAME_TURN_H

#include "libcubemap/batch/turn.h"

/* frame must have passed cm_frame_check. */
void cm_turn_from_frame(const cm_frame *frame, cm_turn *turn);

#endif
