/* SPDX-License-Identifier: MIT
 *
 * Memory that is met in no order that processors know, in pages as large as the system has: finding small ones takes time.
 */
#ifndef MODULES_OCTREE_HUGE_PAGES_H
#define MODULES_OCTREE_HUGE_PAGES_H

#include <stddef.h>

/* Bytes of any value, for free(); NULL if there are none. */
void *cm_huge_allocate(size_t bytes);

#endif
