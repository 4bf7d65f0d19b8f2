/* SPDX-License-Identifier: MIT */
#include "mesh_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    COUNT_END = INT32_MAX
};

static int finite_all(const float *values, size_t count)
{
    for (size_t i = 0; values != NULL && i < count; i++)
    {
        if (!isfinite(values[i]))
        {
            return 0;
        }
    }
    return 1;
}

static int is_material(const cm_material *material)
{
    const double *color = material->color;
    int good = material->reflectance >= 0.0 && material->reflectance <= 1.0;
    for (int i = 0; i < 3; i++)
    {
        good = good && color[i] >= 0.0 && color[i] <= 1.0;
    }
    return good;
}

static int good_numbers(const cm_mesh_options *options)
{
    const size_t n = options->vertex_count;
    int good = finite_all(options->normal, 3 * n) && finite_all(options->uv, 2 * n) &&
               is_material(&options->material);
    for (size_t i = 0; good && i < 3 * n; i++)
    {
        const float color = options->color == NULL ? 0.0f : options->color[i];
        good = fabs(options->position[i]) < COORDINATE_END && color >= 0.0f && color <= 1.0f;
    }
    for (size_t i = 0; good && options->normal != NULL && i < n; i++)
    {
        const float *normal = options->normal + 3 * i;
        good = normal[0] != 0.0f || normal[1] != 0.0f || normal[2] != 0.0f;
    }
    return good;
}

static cm_status check(const cm_mesh_options *options)
{
    if (options->size != sizeof *options || options->vertex_count >= COUNT_END ||
        options->triangle_count >= COUNT_END ||
        (options->position == NULL && options->vertex_count > 0) ||
        (options->index == NULL && options->triangle_count > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < 3 * options->triangle_count; i++)
    {
        if (options->index[i] >= options->vertex_count)
        {
            return CM_ERROR_ARGUMENT;
        }
    }
    return good_numbers(options) ? CM_OK : CM_ERROR_RANGE;
}

/* A copy of an array, which may be absent; *missing is set if there is no memory. */
static void *copied(const void *from, size_t bytes, int *missing)
{
    void *copy = from == NULL || bytes == 0 ? NULL : malloc(bytes);
    if (copy != NULL)
    {
        memcpy(copy, from, bytes);
    }
    *missing |= copy == NULL && from != NULL && bytes > 0;
    return copy;
}

cm_status cm_mesh_create(const cm_mesh_options *options, cm_mesh **mesh)
{
    if (options == NULL || mesh == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = check(options);
    if (status != CM_OK)
    {
        return status;
    }
    cm_mesh *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const size_t n = options->vertex_count;
    int missing = 0;
    made->made_of = *options;
    made->made_of.position = copied(options->position, 3 * n * sizeof *options->position, &missing);
    made->made_of.normal = copied(options->normal, 3 * n * sizeof *options->normal, &missing);
    made->made_of.uv = copied(options->uv, 2 * n * sizeof *options->uv, &missing);
    made->made_of.color = copied(options->color, 3 * n * sizeof *options->color, &missing);
    made->made_of.index =
        copied(options->index, 3 * options->triangle_count * sizeof *options->index, &missing);
    if (missing || mesh_tree_make(&made->made_of, &made->tree) != CM_OK)
    {
        cm_mesh_destroy(made);
        return CM_ERROR_MEMORY;
    }
    *mesh = made;
    return CM_OK;
}

void cm_mesh_destroy(cm_mesh *mesh)
{
    if (mesh != NULL)
    {
        /* they are this mesh's own copies */
        free((void *)(uintptr_t)mesh->made_of.position);
        free((void *)(uintptr_t)mesh->made_of.normal);
        free((void *)(uintptr_t)mesh->made_of.uv);
        free((void *)(uintptr_t)mesh->made_of.color);
        free((void *)(uintptr_t)mesh->made_of.index);
        free(mesh->tree.node);
        free(mesh->tree.triangle);
        free(mesh);
    }
}

const cm_mesh_options *cm_mesh_describe(const cm_mesh *mesh)
{
    return &mesh->made_of;
}

void cm_mesh_bounds(const cm_mesh *mesh, double least[3], double greatest[3])
{
    for (int i = 0; i < 3; i++)
    {
        least[i] = mesh->tree.node == NULL ? NAN : mesh->tree.node->least[i];
        greatest[i] = mesh->tree.node == NULL ? NAN : mesh->tree.node->greatest[i];
    }
}
