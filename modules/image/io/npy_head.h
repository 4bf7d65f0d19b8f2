/* SPDX-License-Identifier: MIT
 *
 * What files of NumPy's arrays begin with: NPY 1.0 (numpy.lib.format).
 */
#ifndef CUBEMAP_MODULES_IMAGE_NPY_HEAD_H
#define CUBEMAP_MODULES_IMAGE_NPY_HEAD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Room for it. */
#define CM_NPY_HEAD 320

/* Of numbers whose type NumPy names so, such as "<f4", and up to 8 axes, the last one innermost. Bytes into head; returns how
 * many, a multiple of 64. */
size_t cm_npy_head(const char *type, size_t rank, const uint64_t *shape, char *head);

#ifdef __cplusplus
}
#endif

#endif
