/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-colormap are called in its source.
 */
#ifndef CUBEMAP_TOOLS_COLORMAP_TABLE_H
#define CUBEMAP_TOOLS_COLORMAP_TABLE_H

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    COLORMAP_OUTPUT = 1,
    COLORMAP_FORMAT,
    COLORMAP_SAMPLES,
    COLORMAP_REVERSE,
    COLORMAP_FIT,
    COLORMAP_STRICT,
    COLORMAP_NAME,
    COLORMAP_SIZE,
    COLORMAP_TEST_PATTERN,
    COLORMAP_LIST
};

/* In the order of the formats; NULL behind the last. */
extern const char *const cm_colormap_formats[];

#ifdef __cplusplus
}
#endif

#endif
