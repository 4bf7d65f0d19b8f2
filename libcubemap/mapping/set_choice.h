/* SPDX-License-Identifier: MIT
 *
 * Which instruction set computes.
 */
#ifndef LIBCUBEMAP_MAPPING_SET_CHOICE_H
#define LIBCUBEMAP_MAPPING_SET_CHOICE_H

#include "libcubemap/batch/batch_set.h"

/* The set of that name (NULL: what the environment says, else the best) if this machine can run it,
 * else NULL. */
const cm_batch_set *cm_batch_set_find(const char *name);

#endif
