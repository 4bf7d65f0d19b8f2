/* SPDX-License-Identifier: MIT
 *
 * Rows of pictures, shared out over threads in bands.
 */
#ifndef MODULES_SCENE_BANDS_H
#define MODULES_SCENE_BANDS_H

#include <cubemap/pool.h>

/* Does the rows first to last - 1, which are band number `band`. */
typedef void (*cm_band)(size_t first, size_t last, size_t band, void *user);

/* So many bands are made: as many as threads (0: as the pool has, or the machine), and never more than there are groups of
 * rows. */
size_t cm_band_count(const cm_pool *pool, unsigned threads, size_t rows, size_t group);

/* Call it for bands that make up all rows, each of whole groups of rows but for the last one: by the pool's threads, or if
 * pool is NULL by threads that are made for it. */
void cm_run_bands(cm_pool *pool, size_t bands, size_t rows, size_t group, cm_band band, void *user);

#endif
