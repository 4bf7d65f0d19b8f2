/* SPDX-License-Identifier: MIT
 *
 * Is a PNG file whole? libpng reports a file that ends too early on standard error, or, when only the end is missing,
 * not at all.
 */
#ifndef CUBEMAP_MODULES_IMAGE_WHOLE_PNG_H
#define CUBEMAP_MODULES_IMAGE_WHOLE_PNG_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the file has all of its chunks. Files that do not begin like PNG, and files that cannot be read, pass. */
bool cm_png_is_whole(const char *path);

#ifdef __cplusplus
}
#endif

#endif
