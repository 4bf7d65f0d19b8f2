/* SPDX-License-Identifier: MIT */
#include "read_meshes.h"

#include "tests/suite.h"

#include <math.h>
#include <string.h>

cm_mesh *read_good(const char *name)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_mesh *mesh = NULL;
    const cm_status status = cm_mesh_file_read(name, NULL, &mesh, message);
    REQUIRE(status == CM_OK && mesh != NULL, "%s: %d %s", name, (int)status, message);
    return mesh;
}

/* One line that begins with the file's name and has these words. */
void refused_with(const char *name, const cm_mesh_limits *limits, cm_status wanted,
                  const char *words)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_mesh *mesh = NULL;
    const cm_status status = cm_mesh_file_read(name, limits, &mesh, message);
    REQUIRE(status == wanted && mesh == NULL, "%s: %d %s", name, (int)status, message);
    REQUIRE(strncmp(message, name, strlen(name)) == 0 && strstr(message, words) != NULL &&
                strchr(message, '\n') == NULL,
            "%s: %s", name, message);
}

void refused(const char *name, cm_status wanted, const char *words)
{
    refused_with(name, NULL, wanted, words);
}

void check_vertex(const cm_mesh *mesh, size_t vertex, double x, double y, double z)
{
    const double *at = cm_mesh_describe(mesh)->position + 3 * vertex;
    REQUIRE(fabs(at[0] - x) < 1e-12 && fabs(at[1] - y) < 1e-12 && fabs(at[2] - z) < 1e-12,
            "vertex %zu is %g %g %g", vertex, at[0], at[1], at[2]);
}

void check_color(const cm_mesh *mesh, size_t vertex, double r, double g, double b)
{
    const float *at = cm_mesh_describe(mesh)->color + 3 * vertex;
    REQUIRE(fabs((double)at[0] - r) < 1e-6 && fabs((double)at[1] - g) < 1e-6 &&
                fabs((double)at[2] - b) < 1e-6,
            "vertex %zu is %g %g %g", vertex, (double)at[0], (double)at[1], (double)at[2]);
}
