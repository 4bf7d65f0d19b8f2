/* SPDX-License-Identifier: MIT */
#include "mesh_rays.h"
#include "vector.h"

#include <cubemap/world.h>

#include <float.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#if defined(CM_EMBREE) && CM_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

struct mesh_rays
{
    const cm_mesh *mesh;
    cm_scene *exact; /* the mesh alone, as the library cubemap-scene meets it */
    RTCDevice device;
    RTCScene tree;
    _Atomic(mesh_edges *) edges; /* NULL: not asked for so far */
};

enum
{
    PACKET = 16
};

/* Radians by which rays are turned that met nothing, by the greatest coordinate of their origin; and the most. */
#define ASIDE 4e-6
#define MOST_ASIDE 1e-2

static cm_status make_exact(mesh_rays *made)
{
    cm_status status = cm_scene_create(&made->exact);
    if (status == CM_OK)
    {
        const cm_primitive primitive = {.size = sizeof primitive,
                                        .kind = CM_PRIMITIVE_MESH,
                                        .mesh = made->mesh,
                                        .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
                                        .material = {{1, 1, 1}, 1}};
        status = cm_scene_add(made->exact, &primitive, NULL);
    }
    return status;
}

/* Vertices as floats, and indices: both are Embree's own copies. */
static int fill(const cm_mesh_options *from, RTCGeometry geometry)
{
    float *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            3 * sizeof *vertex, from->vertex_count);
    uint32_t *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof *index, from->triangle_count);
    if (vertex == NULL || index == NULL)
    {
        return 0;
    }
    for (size_t i = 0; i < 3 * from->vertex_count; i++)
    {
        vertex[i] = (float)from->position[i];
    }
    memcpy(index, from->index, 3 * from->triangle_count * sizeof *index);
    return 1;
}

/* Embree takes no coordinates beyond this, and none that are not numbers: it may end the program. */
#define FARTHEST 1e18

static int is_within_reach(const cm_mesh_options *from)
{
    int is_near = 1;
    for (size_t i = 0; i < 3 * from->vertex_count; i++)
    {
        is_near &= fabs(from->position[i]) < FARTHEST;
    }
    return is_near;
}

/* One thread builds: a library that makes threads of its own surprises who forks. */
static cm_status make_tree(mesh_rays *made)
{
    const cm_mesh_options *from = cm_mesh_describe(made->mesh);
    if (from->triangle_count == 0)
    {
        return CM_OK;
    }
    if (!is_within_reach(from))
    {
        return CM_ERROR_RANGE;
    }
    made->device = rtcNewDevice("threads=1");
    RTCGeometry geometry =
        made->device == NULL ? NULL : rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    made->tree = made->device == NULL ? NULL : rtcNewScene(made->device);
    if (geometry == NULL || made->tree == NULL || !fill(from, geometry))
    {
        if (geometry != NULL)
        {
            rtcReleaseGeometry(geometry);
        }
        return CM_ERROR_MEMORY;
    }
    rtcSetSceneFlags(made->tree, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(geometry);
    (void)rtcAttachGeometry(made->tree, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(made->tree);
    return rtcGetDeviceError(made->device) == RTC_ERROR_NONE ? CM_OK : CM_ERROR_MEMORY;
}

cm_status mesh_rays_create(const cm_mesh *mesh, mesh_rays **made)
{
    mesh_rays *rays = calloc(1, sizeof *rays);
    if (rays == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    rays->mesh = mesh;
    cm_status status = make_exact(rays);
    if (status == CM_OK)
    {
        status = make_tree(rays);
    }
    if (status != CM_OK)
    {
        mesh_rays_destroy(rays);
        return status;
    }
    *made = rays;
    return CM_OK;
}

void mesh_rays_destroy(mesh_rays *mesh)
{
    if (mesh != NULL)
    {
        if (mesh->tree != NULL)
        {
            rtcReleaseScene(mesh->tree);
        }
        if (mesh->device != NULL)
        {
            rtcReleaseDevice(mesh->device);
        }
        cm_scene_destroy(mesh->exact);
        mesh_edges_destroy(atomic_load(&mesh->edges));
        free(mesh);
    }
}

const cm_mesh *mesh_rays_mesh(const mesh_rays *mesh)
{
    return mesh->mesh;
}

cm_status mesh_rays_edges(mesh_rays *mesh, const mesh_edges **found)
{
    mesh_edges *before = atomic_load(&mesh->edges);
    if (before == NULL)
    {
        mesh_edges *made = NULL;
        const cm_status status = mesh_edges_create(mesh->mesh, &made);
        if (status != CM_OK)
        {
            return status;
        }
        if (atomic_compare_exchange_strong(&mesh->edges, &before, made))
        {
            before = made;
        }
        else
        {
            mesh_edges_destroy(made);
        }
    }
    *found = before;
    return CM_OK;
}

void mesh_rays_bound(const mesh_rays *mesh, double centre[3], double *radius)
{
    double least[3], greatest[3];
    cm_mesh_bounds(mesh->mesh, least, greatest);
    double square = 0.0;
    for (int i = 0; i < 3; i++)
    {
        centre[i] = 0.5 * (least[i] + greatest[i]);
        square += (greatest[i] - centre[i]) * (greatest[i] - centre[i]);
    }
    *radius = isnan(square) ? -1.0 : sqrt(square) * (1.0 + 4.0 * DBL_EPSILON);
}

/* ---- one triangle ---- */

typedef struct triangle_hit
{
    double distance;
    double normal[3];
} triangle_hit;

/* Where the ray meets the plane of a triangle; 0 unless that is within the triangle (Moeller and Trumbore 1997). */
static int meet_triangle(const cm_mesh_options *mesh, uint32_t triangle, const double origin[3],
                         const double direction[3], triangle_hit *hit)
{
    const uint32_t *index = mesh->index + 3 * (size_t)triangle;
    const double *corner = mesh->position + 3 * (size_t)index[0];
    double one[3], other[3], from[3], across[3], moved[3];
    for (int i = 0; i < 3; i++)
    {
        one[i] = mesh->position[3 * (size_t)index[1] + (size_t)i] - corner[i];
        other[i] = mesh->position[3 * (size_t)index[2] + (size_t)i] - corner[i];
        from[i] = origin[i] - corner[i];
    }
    cross(direction, other, across);
    cross(from, one, moved);
    const double volume = dot(one, across);
    const double u = dot(from, across) / volume;
    const double v = dot(direction, moved) / volume;
    hit->distance = dot(other, moved) / volume;
    cross(one, other, hit->normal);
    const double length = sqrt(dot(hit->normal, hit->normal));
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || !(length > 0.0))
    {
        return 0;
    }
    for (int i = 0; i < 3; i++)
    {
        hit->normal[i] /= length;
    }
    return 1;
}

/* As the library cubemap-scene finds it, without a crack between triangles. */
static int meet_exactly(const mesh_rays *mesh, const double origin[3], const double direction[3],
                        uint32_t *triangle, triangle_hit *hit)
{
    uint32_t id = CM_SCENE_NOTHING;
    const cm_hit_arrays found = {.size = sizeof found,
                                 .distance = &hit->distance,
                                 .id = &id,
                                 .triangle = triangle,
                                 .normal = {&hit->normal[0], &hit->normal[1], &hit->normal[2]}};
    cm_scene_cast_array(mesh->exact, 1, &origin[0], &origin[1], &origin[2], &direction[0],
                        &direction[1], &direction[2], &found);
    return id != CM_SCENE_NOTHING;
}

/* ---- packets ---- */

static int is_traceable(const double origin[3], const double direction[3], double distance)
{
    int is_good = !isnan(distance);
    for (int k = 0; k < 3; k++)
    {
        is_good &= fabs(origin[k]) < FARTHEST && fabs(direction[k]) < FARTHEST;
    }
    return is_good;
}

/* Rays that are not traceable meet nothing. */
static void trace(const mesh_rays *mesh, size_t count, double (*const origin)[3],
                  double (*const direction)[3], const double *distance, struct RTCRayHit16 *packet)
{
    static const double nowhere[3] = {0, 0, 0}, ahead[3] = {0, 0, 1};
    _Alignas(64) int valid[PACKET];
    for (size_t i = 0; i < PACKET; i++)
    {
        const int is_good = i < count && is_traceable(origin[i], direction[i], distance[i]);
        const double *from = is_good ? origin[i] : nowhere;
        const double *along = is_good ? direction[i] : ahead;
        valid[i] = is_good ? -1 : 0;
        packet->ray.org_x[i] = (float)from[0];
        packet->ray.org_y[i] = (float)from[1];
        packet->ray.org_z[i] = (float)from[2];
        packet->ray.dir_x[i] = (float)along[0];
        packet->ray.dir_y[i] = (float)along[1];
        packet->ray.dir_z[i] = (float)along[2];
        packet->ray.tnear[i] = 0.0f;
        packet->ray.tfar[i] =
            is_good ? (float)fmin(distance[i] * (1.0 + 1e-6), (double)FLT_MAX) : 0.0f;
        packet->ray.time[i] = 0.0f;
        packet->ray.mask[i] = UINT32_MAX;
        packet->ray.id[i] = 0;
        packet->ray.flags[i] = 0;
        packet->hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        packet->hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid, mesh->tree, packet, NULL);
#else
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid, mesh->tree, &context, packet);
#endif
}

/* A direction a few roundings beside: along the axis that it has least of. */
static void turn_aside(const double origin[3], const double direction[3], double turned[3])
{
    double far = 1.0;
    int least = 0;
    for (int k = 0; k < 3; k++)
    {
        turned[k] = direction[k];
        far = fmax(far, fabs(origin[k]));
        least = fabs(direction[k]) < fabs(direction[least]) ? k : least;
    }
    turned[least] += fmin(ASIDE * far, MOST_ASIDE);
}

/* Embree misses what a ray meets at a vertex: which rays that met nothing would meet something a little beside? */
static void ask_again(const mesh_rays *mesh, size_t count, double (*const origin)[3],
                      double (*const direction)[3], const double *distance,
                      const struct RTCRayHit16 *first, uint8_t *is_near)
{
    _Alignas(64) struct RTCRayHit16 packet;
    double from[PACKET][3], along[PACKET][3], far[PACKET];
    size_t ray[PACKET], n = 0;
    memset(is_near, 0, count);
    for (size_t i = 0; i < count; i++)
    {
        if (first->hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
        {
            memcpy(from[n], origin[i], sizeof from[n]);
            turn_aside(origin[i], direction[i], along[n]);
            far[n] = distance[i];
            ray[n++] = i;
        }
    }
    if (n > 0)
    {
        trace(mesh, n, from, along, far, &packet);
    }
    for (size_t i = 0; i < n; i++)
    {
        is_near[ray[i]] = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    }
}

/* The nearest triangle of a ray, by what Embree says of it; 0 if it meets none. */
static int find_hit(const mesh_rays *mesh, const struct RTCRayHit16 *packet, size_t i, int is_near,
                    const double origin[3], const double direction[3], uint32_t *found,
                    triangle_hit *hit)
{
    if (packet->hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
    {
        return is_near && meet_exactly(mesh, origin, direction, found, hit);
    }
    *found = packet->hit.primID[i];
    return (meet_triangle(cm_mesh_describe(mesh->mesh), *found, origin, direction, hit) &&
            hit->distance > 0.0) ||
           meet_exactly(mesh, origin, direction, found, hit);
}

void mesh_rays_cast(const mesh_rays *mesh, size_t n, double (*const origin)[3],
                    double (*const direction)[3], double *distance, uint32_t *triangle,
                    double (*normal)[3], uint8_t *is_met)
{
    memset(is_met, 0, n);
    if (mesh->tree == NULL)
    {
        return;
    }
    for (size_t first = 0; first < n; first += PACKET)
    {
        _Alignas(64) struct RTCRayHit16 packet;
        uint8_t is_near[PACKET];
        const size_t count = n - first < PACKET ? n - first : PACKET;
        trace(mesh, count, origin + first, direction + first, distance + first, &packet);
        ask_again(mesh, count, origin + first, direction + first, distance + first, &packet,
                  is_near);
        for (size_t i = 0; i < count; i++)
        {
            const size_t k = first + i;
            uint32_t found;
            triangle_hit hit;
            if (find_hit(mesh, &packet, i, is_near[i], origin[k], direction[k], &found, &hit) &&
                hit.distance > 0.0 && hit.distance < distance[k])
            {
                is_met[k] = 1;
                distance[k] = hit.distance;
                triangle[k] = found;
                memcpy(normal[k], hit.normal, sizeof hit.normal);
            }
        }
    }
}
