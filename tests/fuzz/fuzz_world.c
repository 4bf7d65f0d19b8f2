/* SPDX-License-Identifier: MIT
 *
 * Worlds of primitives and meshes that the input makes, and rays in them: what is none is refused and nothing is written;
 * whatever is met is met at a distance above 0, with a normal of length 1 towards the ray.
 */
#include <cubemap/world.h>

#include <math.h>

#include "in_double.inc"
#include "fuzz_values.inc"

enum
{
    VERTICES = 12,
    PRIMITIVES = 8,
    RAYS = 8
};

/* Raw bits, or a few steps of a quarter, so that things touch. */
static double take_number(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind % 8 == 0
               ? take_double(from)
               : (double)(kind % 32) * 0.25 - 4.0 + (kind > 200 ? take_fraction(from) : 0.0);
}

static cm_material take_material(supply *from)
{
    cm_material made = {{0.5, 1.0, 0.0}, 0.5};
    const uint8_t kind = take_byte(from);
    if (kind % 4 == 0)
    {
        made.color[kind / 4 % 3] = take_number(from);
    }
    return made;
}

static cm_mesh *take_mesh(supply *from)
{
    double position[3 * VERTICES];
    float extra[3 * VERTICES];
    uint32_t index[3 * 255];
    cm_mesh_options options = {.size = take_byte(from) == 1 ? 3 : sizeof options};
    const uint8_t which = take_byte(from);
    options.vertex_count = take_byte(from) % (VERTICES + 1);
    options.triangle_count = take_byte(from);
    for (size_t i = 0; i < 3 * options.vertex_count; i++)
    {
        position[i] = take_number(from);
        extra[i] = which % 2 == 0 ? (float)take_number(from) : 0.5f;
    }
    for (size_t i = 0; i < 3 * options.triangle_count; i++)
    {
        const uint8_t vertex = take_byte(from);
        index[i] =
            vertex < 250 && options.vertex_count > 0 ? vertex % options.vertex_count : vertex;
    }
    options.position = which % 16 == 1 ? NULL : position;
    options.normal = which & 16 ? extra : NULL;
    options.uv = which & 32 ? extra : NULL;
    options.color = which & 64 ? extra : NULL;
    options.index = which % 16 == 3 ? NULL : index;
    options.material = take_material(from);
    cm_mesh *mesh = NULL;
    const cm_status status = cm_mesh_create(&options, &mesh);
    EXPECT((status == CM_OK) == (mesh != NULL), "status %d", (int)status);
    if (mesh != NULL)
    {
        double least[3], greatest[3];
        cm_mesh_bounds(mesh, least, greatest);
        EXPECT(options.triangle_count == 0 ? isnan(least[0]) != 0 : least[0] <= greatest[0],
               "bounds");
        EXPECT(cm_mesh_describe(mesh)->triangle_count == options.triangle_count, "another");
    }
    return mesh;
}

static void add(cm_scene *scene, const cm_mesh *mesh, supply *from)
{
    cm_primitive one = {.size = sizeof one};
    one.kind = (cm_primitive_kind)(take_byte(from) % 6);
    for (int i = 0; i < 3; i++)
    {
        one.first[i] = take_number(from);
        one.second[i] = take_number(from);
        one.pose.position[i] = take_number(from);
    }
    one.radius = take_number(from);
    one.mesh = mesh;
    one.material = take_material(from);
    if (cm_rotation_from_angles(take_number(from) * 10.0, take_number(from), take_number(from),
                                &one.pose.rotation) != CM_OK)
    {
        one.pose.rotation.row[0][0] = take_double(from);
    }
    uint32_t id = 12345;
    const size_t before = cm_scene_count(scene);
    const cm_status status = cm_scene_add(scene, &one, take_byte(from) == 0 ? NULL : &id);
    EXPECT(cm_scene_count(scene) == before + (status == CM_OK), "%d", (int)status);
    EXPECT(id == 12345 || id == before, "id %u", id);
    EXPECT((cm_scene_at(scene, (uint32_t)before) != NULL) == (status == CM_OK), "%d", (int)status);
}

static void check_hit(const cm_scene *scene, double distance, uint32_t id, const double normal[3],
                      const double direction[3])
{
    EXPECT(isnan(distance) || distance >= 0.0, "%g", distance); /* of the longest directions 0 */
    EXPECT((id == CM_SCENE_NOTHING) == (normal[0] != normal[0]), "%u", id);
    if (id != CM_SCENE_NOTHING)
    {
        const double length =
            sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        const double most = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
        const double side = normal[0] * (direction[0] / most) + normal[1] * (direction[1] / most) +
                            normal[2] * (direction[2] / most);
        EXPECT(fabs(length - 1.0) < 1e-12, "%.17g", length);
        EXPECT(side <= 1e-12, "%g", side);
        EXPECT(id < cm_scene_count(scene), "%u", id);
    }
}

static void check_rays(const cm_scene *scene, supply *from)
{
    double ray[6][RAYS], distance[RAYS], normal[3][RAYS], color[3][RAYS], reflectance[RAYS];
    uint32_t id[RAYS], triangle[RAYS];
    const size_t n = take_byte(from) % (RAYS + 1);
    for (size_t i = 0; i < n; i++)
    {
        for (int k = 0; k < 6; k++)
        {
            ray[k][i] = take_number(from);
        }
    }
    const uint8_t wanted = take_byte(from);
    const cm_hit_arrays all = {sizeof all,
                               distance,
                               id,
                               triangle,
                               {normal[0], normal[1], normal[2]},
                               {color[0], color[1], color[2]},
                               reflectance};
    cm_hit_arrays few = {.size = sizeof few};
    few.distance = wanted & 1 ? distance : NULL;
    few.normal[wanted % 3] = normal[0];
    cm_scene_cast_array(scene, n, ray[0], ray[1], ray[2], ray[3], ray[4], ray[5], &few);
    cm_scene_cast_array(scene, n, ray[0], ray[1], ray[2], ray[3], ray[4], ray[5], &all);
    for (size_t i = 0; i < n; i++)
    {
        const double along[3] = {ray[3][i], ray[4][i], ray[5][i]};
        const double side[3] = {normal[0][i], normal[1][i], normal[2][i]};
        check_hit(scene, distance[i], id[i], side, along);
        EXPECT(color[0][i] >= 0.0 && color[0][i] <= 1.0 && reflectance[i] <= 1.0, "%g",
               color[0][i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_mesh *mesh = take_mesh(&from);
    cm_scene *scene = NULL;
    const char *name = cm_scene_name_at(take_byte(&from) % 5);
    EXPECT((cm_scene_create_named(name, &scene) == CM_OK) == (name != NULL), "%s", name);
    EXPECT(scene != NULL || cm_scene_create(&scene) == CM_OK, "no memory");
    const int count = take_byte(&from) % PRIMITIVES;
    for (int i = 0; i < count; i++)
    {
        add(scene, mesh, &from);
    }
    check_rays(scene, &from);
    cm_scene_destroy(scene);
    cm_mesh_destroy(mesh);
    EXPECT(cm_scene_create(NULL) == CM_ERROR_ARGUMENT &&
               cm_mesh_create(NULL, &mesh) == CM_ERROR_ARGUMENT &&
               cm_scene_add(NULL, NULL, NULL) == CM_ERROR_ARGUMENT,
           "NULL");
    return 0;
}
