/* SPDX-License-Identifier: MIT
 *
 * Meshes from files as a test reads them: good ones, and those that are refused.
 */
#ifndef TESTS_SCENE_READ_MESHES_H
#define TESTS_SCENE_READ_MESHES_H

#include "modules/scene/io/mesh_file.h"

/* Fails the test if it is refused. */
cm_mesh *read_good(const char *name);
/* One line is wanted that begins with the file's name and has these words. */
void refused(const char *name, cm_status wanted, const char *words);
void refused_with(const char *name, const cm_mesh_limits *limits, cm_status wanted,
                  const char *words);
/* A vertex to 1e-12, and its color to 1e-6. */
void check_vertex(const cm_mesh *mesh, size_t vertex, double x, double y, double z);
void check_color(const cm_mesh *mesh, size_t vertex, double r, double g, double b);

#endif
