/* SPDX-License-Identifier: MIT
 *
 * Memory that is asked for before it is needed.
 */
#ifndef MODULES_IMAGE_FETCH_H
#define MODULES_IMAGE_FETCH_H

#ifdef __GNUC__
#define CM_FETCH(place) __builtin_prefetch(place)
#else
#define CM_FETCH(place) (void)(place)
#endif

#endif
