/* SPDX-License-Identifier: MIT
 *
 * A system that refuses memory once. In refused_allocation.c the libraries' own calls, where they are linked with --wrap; in
 * replaced_allocation.c those of all libraries that the program has.
 */
#ifndef TESTS_SCENE_REFUSED_ALLOCATION_H
#define TESTS_SCENE_REFUSED_ALLOCATION_H

/* Allocations of this thread until one fails; below 0: none does. */
extern _Thread_local int blocks_until_refusal;

/* Blocks that were not given back, of all threads. */
int blocks_alive(void);

/* From now on nothing is refused to what this process forks. Of replaced_allocation.c alone. */
void spare_children(void);

#endif
