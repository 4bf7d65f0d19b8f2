/* SPDX-License-Identifier: MIT
 *
 * Which instruction set is meant.
 */
#ifndef MODULES_SCENE_INSTRUCTION_SET_H
#define MODULES_SCENE_INSTRUCTION_SET_H

#include <stddef.h>

/* Of `count` sets that this library has, structs whose first member is a name of cm_instructions_at: the one that
 * instructions of cm_options mean; NULL if there is none. */
const void *cm_scene_set_find(const char *instructions, const void *const *sets, size_t count);

#endif
