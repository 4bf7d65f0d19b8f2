/* SPDX-License-Identifier: MIT
 *
 * Small time-of-flight cameras in small worlds, driven by the input: what is promised of every frame holds, threads change
 * no bit, and arguments that are none are refused. BRDFs, too: never below 0, and the same in both directions.
 */
#include <cubemap/sim.h>

#include <math.h>
#include <string.h>

#include "fuzz.h"

enum
{
    WIDTH = 11,
    HEIGHT = 7,
    PIXELS = WIDTH * HEIGHT,
    IMAGES = 2 * 6,
    SOLIDS_MOST = 5
};

static double amount(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind == 255 ? take_double(from) : (kind % 4 == 0 ? 1.0 : 4.0) * take_fraction(from);
}

/* From 0 to 1. */
static double part(supply *from)
{
    return fabs(take_fraction(from));
}

static void take_direction(supply *from, double to[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
    {
        to[i] = take_fraction(from);
        square += to[i] * to[i];
    }
    const double length = sqrt(square);
    for (int i = 0; i < 3; i++)
    {
        to[i] = length > 0.0 ? to[i] / length : (double)(i == 2);
    }
}

/* Corners of a tetrahedron, one of them where the input says. */
static cm_mesh *take_mesh(supply *from)
{
    double corner[12] = {-1, -1, 2, 1, -1, 2, 0, 1, 2};
    const uint32_t index[12] = {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    for (int i = 0; i < 3; i++)
    {
        corner[9 + i] = 3.0 * take_fraction(from);
    }
    const cm_mesh_options options = {.size = sizeof options,
                                     .vertex_count = 4,
                                     .position = corner,
                                     .triangle_count = 4,
                                     .index = index,
                                     .material = {{1, 1, 1}, part(from)}};
    cm_mesh *mesh = NULL;
    EXPECT(cm_mesh_create(&options, &mesh) == CM_OK, "no mesh");
    return mesh;
}

static cm_trajectory *take_motion(supply *from)
{
    const double stamp[2] = {0.0, 0.01};
    cm_pose pose[2];
    cm_trajectory *motion = NULL;
    for (int k = 0; k < 2; k++)
    {
        double twist[6];
        for (int i = 0; i < 6; i++)
        {
            twist[i] = 0.3 * take_fraction(from);
        }
        cm_pose_exp(twist, &pose[k]);
    }
    EXPECT(cm_trajectory_create(2, stamp, pose, &motion, NULL) == CM_OK, "no motion");
    return motion;
}

static cm_brdf *take_brdf(supply *from)
{
    cm_brdf *brdf = NULL;
    if (take_byte(from) % 2 == 0)
    {
        const double diffuse = part(from);
        const cm_cook_torrance options = {.size = sizeof options,
                                          .diffuse = diffuse,
                                          .specular = part(from),
                                          .roughness = amount(from),
                                          .eta = amount(from),
                                          .absorption = amount(from)};
        return cm_brdf_create_cook_torrance(&options, &brdf) == CM_OK ? brdf : NULL;
    }
    if (take_byte(from) % 4 == 0)
    {
        EXPECT(cm_brdf_create_lambert(&brdf) == CM_OK, "no BRDF");
        return brdf;
    }
    cm_brdf_sample sample[3];
    for (int i = 0; i < 3; i++)
    {
        cm_brdf_goniometer(amount(from), amount(from), amount(from), &sample[i]);
        sample[i].value = amount(from);
    }
    return cm_brdf_create_measured(1 + take_byte(from) % 3, sample, &brdf) == CM_OK ? brdf : NULL;
}

static void check_brdf(const cm_brdf *brdf, supply *from)
{
    const double normal[3] = {0, 0, 1};
    double in[3], out[3], next[3], density = 0.0, u[3];
    take_direction(from, in);
    take_direction(from, out);
    for (int i = 0; i < 3; i++)
    {
        u[i] = fmin(part(from), 0.999);
    }
    EXPECT(cm_brdf_value(brdf, normal, in, out) >= 0.0, "below 0");
    EXPECT(cm_brdf_density(brdf, normal, in, out) >= 0.0, "below 0");
    const double albedo = cm_brdf_albedo(brdf, 1.5 * part(from));
    EXPECT(albedo >= 0.0, "albedo %g", albedo);
    const double weight = cm_brdf_sample_direction(brdf, normal, out, u, next, &density);
    EXPECT(weight >= 0.0, "weight %g", weight);
}

static void add_solid(cm_scene *world, supply *from, const cm_mesh *mesh,
                      const cm_trajectory *motion, const cm_brdf *brdf)
{
    const uint8_t kind = take_byte(from);
    cm_primitive p = {.size = sizeof p, .kind = (cm_primitive_kind)(kind % 5), .radius = 0.5};
    const cm_pose still = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    p.pose = still;
    p.mesh = mesh;
    p.motion = kind & 64 ? motion : NULL;
    p.brdf = kind & 128 ? brdf : NULL;
    for (int i = 0; i < 3; i++)
    {
        p.first[i] = amount(from);
        p.second[i] = kind % 5 == CM_PRIMITIVE_BOX ? p.first[i] + part(from) : amount(from);
    }
    p.material.reflectance = part(from);
    (void)cm_scene_add(world, &p, NULL); /* what is none is refused */
}

static cm_camera *take_camera(supply *from)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 3.0 + take_byte(from) % 8,
                                       .fy = 5.0,
                                       .cx = 5.0,
                                       .cy = 3.0,
                                       .distortion = {take_byte(from) % 2 == 0 ? 0.0 : -0.1}};
    cm_camera *camera = NULL;
    EXPECT(cm_camera_create(&options, &camera) == CM_OK, "no camera");
    return camera;
}

static cm_tof_sensor take_sensor(supply *from, const cm_camera *camera, const float *mask,
                                 const double *harmonic)
{
    const uint8_t kind = take_byte(from);
    const cm_tof_sensor sensor = {.size = sizeof sensor,
                                  .camera = camera,
                                  .pitch = 1e-5,
                                  .f_number = 1.0,
                                  .wavelength = 850e-9,
                                  .efficiency = kind == 255 ? amount(from) : 0.5,
                                  .exposure = kind == 254 ? amount(from) : 1e-3,
                                  .readout = 1e-4,
                                  .frequency = kind == 253 ? amount(from) : 2e7,
                                  .duty = 0.5,
                                  .contrast = kind == 252 ? amount(from) : 0.8,
                                  .full_well = kind % 3 == 0 ? 100.0 : 0.0,
                                  .dark = kind % 5 == 0 ? 1000.0 : 0.0,
                                  .read_noise = kind % 7 == 0 ? 5.0 : 0.0,
                                  .phases = 3 + kind % 4,
                                  .single_readout = kind >> 3 & 1,
                                  .mask_columns = 2,
                                  .mask_rows = 1,
                                  .mask = kind >> 4 & 1 ? mask : NULL,
                                  .harmonics = kind >> 5 & 1 ? 3 : 0,
                                  .harmonic = harmonic,
                                  .second_frequency = kind >> 6 & 1 ? 1.5e7 : 0.0,
                                  .shot_terms = kind % 11 == 0 ? 3 : 0,
                                  .shot_variance = harmonic,
                                  .shot_least = 1.0,
                                  .shot_most = 8.0};
    return sensor;
}

static cm_tof_options take_options(supply *from)
{
    const uint8_t kind = take_byte(from);
    const cm_tof_options options = {.size = sizeof options,
                                    .bounces = kind % 4,
                                    .lights = 1 + take_byte(from) % 20,
                                    .visibility = kind >> 2 & 1,
                                    .paths = 1 + kind % 3,
                                    .sample_columns = kind >> 3 & 3,
                                    .sample_rows = kind >> 4 & 3,
                                    .sample_times = kind == 255 ? 0 : 1 + kind % 2,
                                    .full = kind >> 6 & 1,
                                    .noise = kind >> 7,
                                    .seed = kind,
                                    .map_edge = 4,
                                    .shot = kind % 5 == 3};
    return options;
}

typedef struct picture
{
    float phase[IMAGES * PIXELS], charge_a[IMAGES * PIXELS], charge_b[IMAGES * PIXELS];
    float distance[PIXELS], amplitude[PIXELS], intensity[PIXELS];
    uint8_t flags[PIXELS];
} picture;

static cm_status take_picture(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                              const cm_tof_light *light, const cm_trajectory *motion,
                              const cm_tof_options *options, cm_pool *pool, picture *to)
{
    memset(to, 0, sizeof *to);
    cm_tof_report report = {.size = sizeof report};
    cm_tof_result result = {.size = sizeof result,
                            .phase = to->phase,
                            .charge_a = to->charge_a,
                            .charge_b = to->charge_b,
                            .distance = to->distance,
                            .amplitude = to->amplitude,
                            .intensity = to->intensity,
                            .flags = to->flags,
                            .report = &report};
    return cm_tof_simulate(scene, sensor, light, 1, motion, 0.0, options, pool, &result);
}

static void check_picture(const cm_tof_sensor *sensor, const cm_tof_options *options,
                          const picture *seen)
{
    const double most = 3e8 / 2.0 / fmin(sensor->frequency, 1e6) + 1.0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double distance = (double)seen->distance[i];
        EXPECT(isnan(distance) || (distance >= -1.0 && distance <= most * 100), "%g m", distance);
        EXPECT(isnan(distance) == ((seen->flags[i] & CM_TOF_NOTHING) != 0), "flags %d",
               seen->flags[i]);
        EXPECT(options->noise || (double)seen->intensity[i] >= 0.0, "%g electrons",
               (double)seen->intensity[i]);
    }
}

static void check_truth(const cm_tof_scene *scene, const cm_camera *camera,
                        const cm_trajectory *motion)
{
    float range[PIXELS], depth[PIXELS];
    uint32_t object[PIXELS];
    cm_tof_truth truth = {.size = sizeof truth, .range = range, .depth = depth, .object = object};
    const cm_status status = cm_tof_find_truth(scene, camera, motion, 0.0, 0.01, 0.0, NULL, &truth);
    EXPECT(status == CM_OK, "%d", (int)status);
    for (size_t i = 0; i < PIXELS; i++)
    {
        EXPECT((object[i] == CM_SCENE_NOTHING) == isnan(range[i]), "object %u, %g m", object[i],
               (double)range[i]);
        EXPECT(isnan(range[i]) || range[i] >= depth[i] * 0.999f, "%g m less than depth",
               (double)range[i]);
    }
}

/* Of few paths and lights: a limit that is nearly 0 has thousands of them otherwise. */
static void check_plan(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                       const cm_tof_light *light, supply *from)
{
    cm_budget_entry entry[CM_TOF_EFFECTS];
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    cm_tof_options chosen;
    const double limit = amount(from);
    const cm_tof_options most = {.size = sizeof most,
                                 .bounces = take_byte(from) % 6 - 1,
                                 .lights = 9,
                                 .paths = 4,
                                 .traces = take_byte(from) % 2};
    const cm_status status = cm_tof_plan(scene, sensor, light, 1, NULL, 0.0, limit,
                                         limit == 0.0 ? NULL : &most, NULL, &chosen, &budget);
    EXPECT(status != CM_OK || budget.count == CM_TOF_EFFECTS, "%zu effects", budget.count);
    EXPECT(status != CM_OK || limit == 0.0 || most.bounces == 0 || chosen.bounces <= most.bounces ||
               (most.bounces < 0 && chosen.bounces == 0),
           "%d bounces of %d", chosen.bounces, most.bounces);
    EXPECT(status != CM_OK || budget.error >= entry[CM_TOF_EFFECTS - 1].contribution, "%g m",
           budget.error);
}

/* A driver of its own: charges of any size, and sensors that are none. */
static void check_driver(const cm_tof_sensor *sensor, supply *from)
{
    static float charge_a[IMAGES * 3], charge_b[IMAGES * 3];
    float distance[3], amplitude[3], intensity[3];
    uint8_t flags[3] = {0};
    for (size_t i = 0; i < IMAGES * 3; i++)
    {
        charge_a[i] = (float)amount(from);
        charge_b[i] = (float)amount(from);
    }
    const cm_status status =
        cm_tof_reconstruct(sensor, 3, charge_a, charge_b, distance, amplitude, intensity, flags);
    EXPECT(status != CM_OK || !(amplitude[0] < 0.0f), "%g electrons", (double)amplitude[0]);
    EXPECT(status == CM_OK || flags[0] == 0, "flags %d", flags[0]);
    const double spread = cm_tof_noise_of_distance(sensor, 100.0, 5.0);
    EXPECT(isnan(spread) || spread >= 0.0 || sensor->frequency < 0.0 || sensor->contrast < 0.0,
           "%g m", spread);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static picture first, second;
    supply from = {data, size};
    const float mask[2] = {1.0f, 0.25f};
    const double harmonic[3] = {1.0, 0.2 * take_fraction(&from), 0.1};
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_mesh *mesh = take_mesh(&from);
    cm_trajectory *motion = take_motion(&from);
    cm_brdf *brdf = take_brdf(&from);
    cm_camera *camera = take_camera(&from);
    check_brdf(brdf, &from);
    EXPECT(cm_scene_create(&world) == CM_OK, "no world");
    for (int i = take_byte(&from) % SOLIDS_MOST; i >= 0; i--)
    {
        add_solid(world, &from, mesh, motion, brdf);
    }
    const cm_status made = cm_tof_scene_create(world, &scene);
    EXPECT((made == CM_OK) == (cm_scene_count(world) > 0), "%d", (int)made);
    if (made == CM_OK)
    {
        const cm_tof_sensor sensor = take_sensor(&from, camera, mask, harmonic);
        const cm_tof_options options = take_options(&from);
        const cm_tof_light light = {.size = sizeof light,
                                    .position = {0.1 * take_fraction(&from), 0, 0},
                                    .power = part(&from),
                                    .aperture = 1.0 + 5.0 * part(&from)};
        const cm_trajectory *moves = take_byte(&from) % 4 == 0 ? motion : NULL;
        const cm_status status =
            take_picture(scene, &sensor, &light, moves, &options, NULL, &first);
        if (status == CM_OK)
        {
            cm_pool *pool = NULL;
            EXPECT(cm_pool_create(2, &pool) == CM_OK, "no pool");
            check_picture(&sensor, &options, &first);
            (void)take_picture(scene, &sensor, &light, moves, &options, pool, &second);
            EXPECT(memcmp(&first, &second, sizeof first) == 0, "threads change bits");
            cm_pool_destroy(pool);
        }
        EXPECT(cm_tof_scene_count(scene) == cm_scene_count(world), "count");
        EXPECT(isnan(cm_tof_frame_time(&sensor)) || cm_tof_frame_time(&sensor) != 0.0, "time");
        check_truth(scene, camera, moves);
        check_driver(&sensor, &from);
        if (take_byte(&from) % 16 == 0)
        {
            check_plan(scene, &sensor, &light, &from);
        }
    }
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_camera_destroy(camera);
    cm_brdf_destroy(brdf);
    cm_trajectory_destroy(motion);
    cm_mesh_destroy(mesh);
    return 0;
}
