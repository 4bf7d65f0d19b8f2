/* SPDX-License-Identifier: MIT
 *
 * CM_API marks the functions that the library exports, and nothing else is. On Windows a program that links
 * the static library defines CM_STATIC before it includes any header of this library (pkg-config and CMake do where
 * there is only that one). CM_BUILD is for the library's own files.
 */
#ifndef CUBEMAP_EXPORT_H
#define CUBEMAP_EXPORT_H

#if defined(_WIN32) || defined(__CYGWIN__)
#define CM_WINDOWS
#endif

#if defined(__GNUC__) && !defined(CM_WINDOWS)
/* Marks what the library exports. */
#define CM_API __attribute__((visibility("default")))
#elif defined(CM_STATIC) || !defined(CM_WINDOWS)
#define CM_API
#elif defined(CM_BUILD)
#define CM_API __declspec(dllexport)
#else
#define CM_API __declspec(dllimport)
#endif

#undef CM_WINDOWS

#endif
