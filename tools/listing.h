/* SPDX-License-Identifier: MIT
 *
 * The catalogue of mappings and the frames, for people and for programs.
 */
#ifndef CUBEMAP_TOOLS_LISTING_H
#define CUBEMAP_TOOLS_LISTING_H

#include <stdio.h>

/* A table to read. Errors are left in the stream's error indicator. */
void listing_write_table(FILE *stream);

/* One JSON object: "version", "recommended", "mappings" and "frames". */
void listing_write_json(FILE *stream);

#endif
