/* SPDX-License-Identifier: MIT */
#include "tof_world.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The rays of a mesh that several primitives may share. */
static cm_status find_rays(cm_tof_scene *made, const cm_mesh *mesh, const mesh_rays **found)
{
    for (size_t i = 0; i < made->mesh_count; i++)
    {
        if (mesh_rays_mesh(made->meshes[i]) == mesh)
        {
            *found = made->meshes[i];
            return CM_OK;
        }
    }
    const cm_status status = mesh_rays_create(mesh, &made->meshes[made->mesh_count]);
    if (status == CM_OK)
    {
        *found = made->meshes[made->mesh_count++];
    }
    return status;
}

static cm_status copy_primitives(const cm_scene *scene, cm_tof_scene *made)
{
    made->count = cm_scene_count(scene);
    made->primitive = calloc(made->count, sizeof *made->primitive);
    made->rays = calloc(made->count, sizeof *made->rays);
    made->meshes = calloc(made->count, sizeof *made->meshes);
    if (made->primitive == NULL || made->rays == NULL || made->meshes == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < made->count; i++)
    {
        made->primitive[i] = *cm_scene_at(scene, (uint32_t)i);
        if (made->primitive[i].kind == CM_PRIMITIVE_MESH)
        {
            status = find_rays(made, made->primitive[i].mesh, &made->rays[i]);
        }
    }
    return status;
}

cm_status cm_tof_scene_create(const cm_scene *scene, cm_tof_scene **made)
{
    if (scene == NULL || made == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_scene_count(scene) == 0)
    {
        return CM_ERROR_DATA;
    }
    cm_tof_scene *ready = calloc(1, sizeof *ready);
    if (ready == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = tof_set_choose(&ready->set);
    if (status == CM_OK)
    {
        status = copy_primitives(scene, ready);
    }
    if (status != CM_OK)
    {
        cm_tof_scene_destroy(ready);
        return status;
    }
    *made = ready;
    return CM_OK;
}

void cm_tof_scene_destroy(cm_tof_scene *scene)
{
    if (scene != NULL)
    {
        for (size_t i = 0; i < scene->mesh_count; i++)
        {
            mesh_rays_destroy(scene->meshes[i]);
        }
        free(atomic_load(&scene->spare));
        sky_destroy(atomic_load(&scene->sky));
        free(scene->meshes);
        free(scene->rays);
        free(scene->primitive);
        free(scene);
    }
}

/* Before what is asked for. */
typedef union memory_head
{
    size_t size;
    max_align_t room[4];
} memory_head;

void *tof_scene_take(cm_tof_scene *scene, size_t size)
{
    memory_head *head = atomic_exchange(&scene->spare, NULL);
    if (head == NULL || head->size < size)
    {
        free(head);
        head = size > SIZE_MAX - sizeof *head ? NULL : malloc(sizeof *head + size);
        if (head == NULL)
        {
            return NULL;
        }
        head->size = size;
    }
    return head + 1;
}

void tof_scene_return(cm_tof_scene *scene, void *memory)
{
    if (memory != NULL)
    {
        free(atomic_exchange(&scene->spare, (memory_head *)memory - 1));
    }
}

cm_status tof_scene_take_sky(cm_tof_scene *scene, const cm_tof_environment *environment,
                             cm_pool *pool, tof_sky **taken)
{
    tof_sky *kept = atomic_exchange(&scene->sky, NULL);
    if (kept != NULL && sky_turn_to(environment, kept))
    {
        *taken = kept;
        return CM_OK;
    }
    sky_destroy(kept);
    return sky_create(environment, pool, taken);
}

void tof_scene_return_sky(cm_tof_scene *scene, tof_sky *sky)
{
    if (sky != NULL)
    {
        sky_destroy(atomic_exchange(&scene->sky, sky));
    }
}

size_t cm_tof_scene_count(const cm_tof_scene *scene)
{
    return scene->count;
}
