/* SPDX-License-Identifier: MIT
 *
 * Which instruction set is meant.
 */
#ifndef MODULES_SCENE_SET_NAME_H
#define MODULES_SCENE_SET_NAME_H

#include <stddef.h>

/* Of cm_instructions_at: the set that instructions of cm_options mean, if this library, which has `count` sets called
 * names, has it; NULL if there is none. */
const char *cm_scene_set_name(const char *instructions, const char *const *names, size_t count);

#endif
