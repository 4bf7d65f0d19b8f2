/* SPDX-License-Identifier: MIT
 *
 * The catalogue of mappings, and what else has a name, for people and for programs.
 */
#ifndef CUBEMAP_TOOLS_LISTING_H
#define CUBEMAP_TOOLS_LISTING_H

#include <stdio.h>

/* A table to read. Errors are left in the stream's error indicator. */
void listing_write_table(FILE *stream);

/* The parts of that table that other programs have, too. */
void listing_write_ellipsoids(FILE *stream);
void listing_write_latitudes(FILE *stream);

/* One JSON object: "version", "recommended", "mappings", "frames", "ellipsoids", "latitudes" and
 * "orientations". */
void listing_write_json(FILE *stream);

#endif
