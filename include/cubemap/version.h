/* SPDX-License-Identifier: MIT
 *
 * The version of the library. Semantic versioning: before 1.0 a minor version may change the
 * interface.
 */
#ifndef CUBEMAP_VERSION_H
#define CUBEMAP_VERSION_H

#include <cubemap/export.h>

/* The version of the headers, as numbers and as a text. */
#define CM_VERSION_MAJOR 0
#define CM_VERSION_MINOR 1
#define CM_VERSION_PATCH 0
#define CM_VERSION_STRING "0.1.0"

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library that is linked, as "MAJOR.MINOR.PATCH"; compare with
 * CM_VERSION_STRING, the version of the headers that were included. Never NULL. */
CM_API const char *cm_version(void);

#ifdef __cplusplus
}
#endif

#endif
