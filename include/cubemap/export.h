/* SPDX-License-Identifier: MIT
 *
 * CM_API marks the functions that the library exports.
 */
#ifndef CUBEMAP_EXPORT_H
#define CUBEMAP_EXPORT_H

#if defined(__GNUC__)
#define CM_API __attribute__((visibility("default")))
#else
#define CM_API
#endif

#endif
