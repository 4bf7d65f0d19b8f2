/* SPDX-License-Identifier: MIT
 *
 * Work in few large pieces over threads, which cm_run_threads gives out by 64.
 */
#ifndef MODULES_IMAGE_IMAGE_JOBS_H
#define MODULES_IMAGE_IMAGE_JOBS_H

#include <stddef.h>

/* Does one piece. */
typedef void (*cm_piece)(size_t index, void *user);

/* Call piece for 0 to count - 1, each once. No piece may need what another has done. */
void cm_run_pieces(unsigned threads, size_t count, cm_piece piece, void *user);

#endif
