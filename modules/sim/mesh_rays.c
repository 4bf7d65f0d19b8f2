/* SPDX-License-Identifier: MIT */
#include "mesh_rays.h"
#include "mesh_widen.h"
#include "vector.h"

#include <cubemap/sim.h>

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
    double centre[3];
    double radius; /* around all of it; below 0: no triangles */
    RTCDevice device;
    RTCScene tree;               /* of the mesh in the unit sphere */
    _Atomic(mesh_edges *) edges; /* NULL: not asked for so far */
};

enum
{
    PACKET = 16
};

/* By which triangles are wider in the search, in radii of the mesh: many roundings of single precision. */
#define MARGIN 4e-6

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

/* The mesh's place where it is a unit sphere's, which single precision holds best. */
static void put_in_sphere(const mesh_rays *mesh, const double at[3], double to[3])
{
    for (int k = 0; k < 3; k++)
    {
        to[k] = mesh->radius > 0.0 ? (at[k] - mesh->centre[k]) / mesh->radius : 0.0;
    }
}

/* Three vertices a triangle as floats, and indices: both are Embree's own copies. */
static int fill(const mesh_rays *made, const cm_mesh_options *from, RTCGeometry geometry)
{
    const size_t n = 3 * from->triangle_count;
    float *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            3 * sizeof *vertex, n);
    uint32_t *index = vertex == NULL ? NULL
                                     : rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                               RTC_FORMAT_UINT3, 3 * sizeof *index,
                                                               from->triangle_count);
    if (index == NULL)
    {
        return 0;
    }
    for (size_t i = 0; i < n; i += 3)
    {
        double corner[3][3], wide[3][3];
        for (size_t j = 0; j < 3; j++)
        {
            put_in_sphere(made, from->position + 3 * (size_t)from->index[i + j], corner[j]);
            index[i + j] = (uint32_t)(i + j);
        }
        mesh_widen((const double(*)[3])corner, MARGIN, wide);
        for (size_t j = 0; j < 9; j++)
        {
            vertex[3 * i + j] = (float)wide[j / 3][j % 3];
        }
    }
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

cm_status mesh_rays_check(const cm_mesh_options *from)
{
    const size_t count = from->triangle_count;
    return count == 0 || (count <= CM_TOF_TRIANGLES_MOST && is_within_reach(from)) ? CM_OK
                                                                                   : CM_ERROR_RANGE;
}

/* One thread builds: a library that makes threads of its own surprises who forks. */
static cm_status make_tree(mesh_rays *made)
{
    const cm_mesh_options *from = cm_mesh_describe(made->mesh);
    if (from->triangle_count == 0)
    {
        return CM_OK;
    }
    mesh_rays_bound(made, made->centre, &made->radius);
    made->device = rtcNewDevice("threads=1");
    RTCGeometry geometry =
        made->device == NULL ? NULL : rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    made->tree = made->device == NULL ? NULL : rtcNewScene(made->device);
    if (geometry == NULL || made->tree == NULL || !fill(made, from, geometry))
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
    cm_status status = mesh_rays_check(cm_mesh_describe(mesh));
    if (status != CM_OK)
    {
        return status;
    }
    mesh_rays *rays = calloc(1, sizeof *rays);
    if (rays == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    rays->mesh = mesh;
    status = make_exact(rays);
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

/* Square of the distance from the centre within which a ray that meets the unit sphere has come in: 2, and roundings. */
#define NEAR_SQUARE 2.01

/* A ray in the unit sphere, from where it may come in. Returns 0 if it meets nothing. */
static int begin_ray(const mesh_rays *mesh, const double origin[3], const double direction[3],
                     double distance, double begin[3], double *far)
{
    double to[3], from[3];
    int is_good = !isnan(distance);
    for (int k = 0; k < 3; k++)
    {
        to[k] = mesh->centre[k] - origin[k];
        is_good &= fabs(origin[k]) < FARTHEST && fabs(direction[k]) < FARTHEST;
    }
    const double ahead = fmax(0.0, dot(to, direction) - mesh->radius);
    for (int k = 0; k < 3; k++)
    {
        from[k] = origin[k] + ahead * direction[k];
    }
    put_in_sphere(mesh, from, begin);
    *far = (distance - ahead) / mesh->radius * (1.0 + 1e-6) + MARGIN;
    return is_good && *far > 0.0 && dot(begin, begin) < NEAR_SQUARE;
}

/* Rays that meet nothing are not traced. */
static void trace(const mesh_rays *mesh, size_t count, double (*const origin)[3],
                  double (*const direction)[3], const double *distance, struct RTCRayHit16 *packet)
{
    static const double ahead[3] = {0, 0, 1};
    _Alignas(64) int valid[PACKET];
    for (size_t i = 0; i < PACKET; i++)
    {
        double from[3] = {0, 0, 0}, far = 0.0;
        const int is_good =
            i < count && begin_ray(mesh, origin[i], direction[i], distance[i], from, &far);
        const double *along = is_good ? direction[i] : ahead;
        valid[i] = is_good ? -1 : 0;
        packet->ray.org_x[i] = is_good ? (float)from[0] : 0.0f;
        packet->ray.org_y[i] = is_good ? (float)from[1] : 0.0f;
        packet->ray.org_z[i] = is_good ? (float)from[2] : 0.0f;
        packet->ray.dir_x[i] = (float)along[0];
        packet->ray.dir_y[i] = (float)along[1];
        packet->ray.dir_z[i] = (float)along[2];
        packet->ray.tnear[i] = 0.0f;
        packet->ray.tfar[i] = is_good ? (float)fmin(far, (double)FLT_MAX) : 0.0f;
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

/* The nearest triangle of a ray, by what Embree says of the wider ones; 0 if it meets none. */
static int find_hit(const mesh_rays *mesh, const struct RTCRayHit16 *packet, size_t i,
                    const double origin[3], const double direction[3], uint32_t *found,
                    triangle_hit *hit)
{
    if (packet->hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
    {
        return 0;
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
        const size_t count = n - first < PACKET ? n - first : PACKET;
        trace(mesh, count, origin + first, direction + first, distance + first, &packet);
        for (size_t i = 0; i < count; i++)
        {
            const size_t k = first + i;
            uint32_t found;
            triangle_hit hit;
            if (find_hit(mesh, &packet, i, origin[k], direction[k], &found, &hit) &&
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
