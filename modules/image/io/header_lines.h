/* SPDX-License-Identifier: MIT
 *
 * Tags of ours in formats whose headers have no tags, but lines that readers pass over: "# cubemap:surface=SPEC" in PGM,
 * PPM and Radiance HDR.
 */
#ifndef CUBEMAP_MODULES_IMAGE_HEADER_LINES_H
#define CUBEMAP_MODULES_IMAGE_HEADER_LINES_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The room for all lines of a picture, the zero byte included. */
#define CM_HEADER_LINES_SIZE 1000

/* A line without "# ", in a text that is not ended: "cubemap:surface" and what stands behind the equals sign. */
typedef struct cm_header_line
{
    const char *key;
    size_t key_size;
    const char *value;
    size_t value_size;
} cm_header_line;

/* The tags whose keys begin with "cubemap:", a line each with its end. What does not fit, or is of several lines, is left
 * out. lines has CM_HEADER_LINES_SIZE bytes; it ends with a zero byte, and is empty if there are no such tags. */
void cm_header_lines_write(const cm_image_description *description, char *lines);

/* The next such line in a header, whose first bytes are text to before end; false if there is none. *text then stands
 * behind it. */
bool cm_header_lines_next(const char **text, const char *end, cm_header_line *line);

#ifdef __cplusplus
}
#endif

#endif
