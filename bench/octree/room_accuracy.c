/* SPDX-License-Identifier: MIT
 *
 * How right a map of the analytic room is that depth views are integrated into, and what a view costs: views of 640 x 480
 * on a walk in the room, judged by truth/room_views.h. Options are NAME VALUE, all with a default:
 *
 *   room-accuracy [--edge 0.01] [--noise 0] [--views 60] [--passes 2] [--threads 1] [--color 1] [--far 0] [--levels 12]
 *                 [--centre 0] [--footprint 0] [--rule 0] [--points 0] [--endpoints 0]
 *                 [--judge 1] [--distortion 0] [--around 0]
 *
 * --centre moves the root's centre along all axes by so many edges, so that walls do not lie on borders of voxels; --points 1
 * integrates points instead of views; --endpoints 1 leaves free space unknown; --distortion is the first of the lens's, and
 * --around N a cube of six pictures of N x N pixels in place of the lens. Times are of the processor for one thread, else of
 * the clock, and of the passes after the first; noise is drawn anew for each view of each pass.
 */
#include "bench/harness/harness.h"
#include "truth/room_views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/mapping.h>
#include <cubemap/octree.h>

typedef struct settings
{
    double edge;
    double noise;
    double views;
    double passes;
    double threads;
    double color;
    double far;
    double levels;
    double centre;
    double footprint;
    double rule;
    double points;
    double endpoints;
    double judge;
    double distortion;
    double around;
} settings;

static settings read_settings(int count, char **word)
{
    settings s = {
        .edge = 0.01, .views = 60, .passes = 2, .threads = 1, .color = 1, .levels = 12, .judge = 1};
    const struct
    {
        const char *name;
        double *value;
    } known[] = {{"--edge", &s.edge},
                 {"--noise", &s.noise},
                 {"--views", &s.views},
                 {"--passes", &s.passes},
                 {"--threads", &s.threads},
                 {"--color", &s.color},
                 {"--far", &s.far},
                 {"--levels", &s.levels},
                 {"--centre", &s.centre},
                 {"--rule", &s.rule},
                 {"--footprint", &s.footprint},
                 {"--points", &s.points},
                 {"--endpoints", &s.endpoints},
                 {"--judge", &s.judge},
                 {"--distortion", &s.distortion},
                 {"--around", &s.around}};
    for (int i = 1; i < count; i += 2)
    {
        size_t k = 0;
        while (k < sizeof known / sizeof *known && strcmp(known[k].name, word[i]) != 0)
        {
            k++;
        }
        if (k == sizeof known / sizeof *known || i + 1 == count ||
            isnan(*known[k].value = number_of(word[i + 1])))
        {
            fprintf(stderr, "room-accuracy: %s: no such option, or no number\n", word[i]);
            exit(2);
        }
    }
    return s;
}

static void ask(cm_status status, const char *what)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "room-accuracy: %s: %s\n", what, cm_status_text(status));
        exit(1);
    }
}

static int state_at(const void *map, const double point[3])
{
    return cm_octree_at(map, point, 0, NULL);
}

/* The points that a picture measured, to be freed. */
static float *points_of(const room_picture *picture, const cm_camera *camera, const cm_pose *pose)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    float *points = allocate(3 * picture->pixels, sizeof *points);
    for (size_t i = 0; i < picture->pixels; i++)
    {
        double column = (double)(i % options->width) + options->pixel_centre;
        double row = (double)(i / options->width) + options->pixel_centre;
        double ray[3], point[3];
        const double depth = (double)picture->measured[i];
        cm_camera_ray_array(camera, 1, &column, &row, ray, ray + 1, ray + 2);
        for (int k = 0; k < 3; k++)
        {
            ray[k] = depth > 0.0 ? ray[k] * depth : (double)NAN;
        }
        cm_pose_apply_back(pose, ray, point);
        for (int k = 0; k < 3; k++)
        {
            points[3 * i + (size_t)k] = (float)point[k];
        }
    }
    return points;
}

static double integrate(cm_octree *map, const settings *s, const room_picture *picture,
                        const cm_camera *camera, const cm_pose *pose, cm_pool *pool)
{
    float *points = s->points > 0.0 ? points_of(picture, camera, pose) : NULL;
    const cm_view view = room_picture_view(picture, camera, pose, s->color > 0.0);
    double (*const clock_of)(void) = pool == NULL ? processor_seconds : seconds;
    const double begin = clock_of();
    const cm_status status =
        points != NULL ? cm_octree_update_points(map, pose->position, picture->pixels, points,
                                                 s->color > 0.0 ? picture->color : NULL)
                       : cm_octree_update(map, &view, pool);
    const double took = clock_of() - begin;
    ask(status, "update");
    free(points);
    return took;
}

static void report_times(const char *name, const double *took, size_t n)
{
    double *sorted = sorted_copy(took, n);
    printf("%-24s median %8.3f ms, least %8.3f, most %8.3f\n", name, 1e3 * sorted_median(sorted, n),
           1e3 * sorted[0], 1e3 * sorted[n - 1]);
    free(sorted);
}

static void report_share(const char *name, uint64_t part, uint64_t whole, const char *target)
{
    printf("%-36s %8.3f %%  (%llu of %llu)  target %s\n", name,
           whole > 0 ? 100.0 * (double)part / (double)whole : 0.0, (unsigned long long)part,
           (unsigned long long)whole, target);
}

static void judge_map(const cm_octree *map, const room_truth *truth)
{
    room_errors errors = {0};
    size_t count = 0;
    ask(cm_octree_extract(map, 0, 0, NULL, &count) == CM_ERROR_SPACE || count == 0 ? CM_OK
                                                                                   : CM_ERROR_DATA,
        "extract");
    cm_voxel *voxel = allocate(count + 1, sizeof *voxel);
    ask(cm_octree_extract(map, 0, count, voxel, &count), "extract");
    for (size_t i = 0; i < count; i++)
    {
        room_truth_judge_occupied(truth, (const double[3]){voxel[i].x, voxel[i].y, voxel[i].z},
                                  &errors);
    }
    free(voxel);
    room_truth_judge(truth, map, state_at, &errors);
    report_share("occupied, over 1.5 edges off", errors.off, errors.occupied, "<= 0.1");
    report_share("visible, occupied", errors.visible_occupied, errors.visible, ">= 99");
    report_share("visible at grazing angles, occupied", errors.grazing_occupied, errors.grazing,
                 ">= 99");
    report_share("visible, free", errors.visible_free, errors.visible, "");
    report_share("crossed but free", errors.crossed_free, errors.crossed, "<= 0.15");
}

static void report_map(const cm_octree *map, const char *when)
{
    cm_octree_count count = {.size = sizeof count};
    ask(cm_octree_count_voxels(map, &count), "count");
    printf("%s: occupied %llu, free %llu, nodes %llu, %.2f MB\n", when,
           (unsigned long long)count.occupied, (unsigned long long)count.free,
           (unsigned long long)count.nodes, 1e-6 * (double)count.bytes);
}

/* A room, a map of it, and the truth. */
typedef struct bench
{
    settings s;
    cm_scene *scene;
    cm_camera *camera;
    cm_octree *map;
    cm_pool *pool;
    room_picture picture;
    room_truth truth;
} bench;

static cm_octree_options map_options(const settings *s)
{
    cm_octree_options options = {.size = sizeof options,
                                 .edge = s->edge,
                                 .levels = (int)s->levels,
                                 .rule = (int)s->rule,
                                 .hit = 0.85,
                                 .miss = -0.4,
                                 .low = -2.0,
                                 .high = 3.5,
                                 .far = s->far,
                                 .noise = s->noise,
                                 .footprint = s->footprint,
                                 .color = s->color > 0.0,
                                 .endpoints_only = s->endpoints > 0.0};
    for (int i = 0; i < 3; i++)
    {
        options.centre[i] = s->centre * s->edge;
    }
    return options;
}

static cm_camera *make_camera(const settings *s)
{
    cm_camera_options options = {.size = sizeof options,
                                 .width = 640,
                                 .height = 480,
                                 .fx = 525.0,
                                 .fy = 525.0,
                                 .cx = 319.5,
                                 .cy = 239.5,
                                 .distortion = {s->distortion}};
    cm_mapping *cube = NULL;
    if (s->around > 0.0)
    {
        ask(cm_mapping_create("gnomonic", NULL, &cube), "mapping");
        options = (cm_camera_options){.size = sizeof options,
                                      .width = (uint32_t)s->around,
                                      .height = 6 * (uint32_t)s->around,
                                      .pixel_centre = 0.5,
                                      .mapping = cube};
    }
    cm_camera *camera = NULL;
    ask(cm_camera_create(&options, &camera), "camera");
    cm_mapping_destroy(cube);
    return camera;
}

static void begin(bench *at, const settings *s)
{
    const cm_octree_options options = map_options(s);
    const double least[3] = {-3.0, -2.5, 0.0};
    const double greatest[3] = {3.0, 2.5, 3.0};
    memset(at, 0, sizeof *at);
    at->s = *s;
    ask(cm_scene_create_named("room", &at->scene), "room");
    at->camera = make_camera(s);
    ask(cm_octree_create(&options, &at->map), "map");
    if (s->threads > 1.0)
    {
        ask(cm_pool_create((unsigned)s->threads, &at->pool), "threads");
    }
    if (!room_picture_make(at->camera, &at->picture) ||
        !room_truth_make(at->scene, s->edge, options.centre, least, greatest, &at->truth))
    {
        ask(CM_ERROR_MEMORY, "pictures");
    }
}

static void end(bench *at)
{
    room_truth_free(&at->truth);
    room_picture_free(&at->picture);
    cm_pool_destroy(at->pool);
    cm_octree_destroy(at->map);
    cm_camera_destroy(at->camera);
    cm_scene_destroy(at->scene);
}

static void report(const bench *at, const char *when)
{
    report_map(at->map, when);
    if (at->s.judge > 0.0)
    {
        judge_map(at->map, &at->truth);
    }
}

/* All views of all passes, and what each took. */
static void integrate_all(bench *at, double *took)
{
    const size_t views = (size_t)at->s.views, all = views * (size_t)at->s.passes;
    for (size_t i = 0; i < all; i++)
    {
        const cm_pose pose = room_pose(i % views, views);
        room_picture_take(at->scene, at->camera, &pose, at->s.noise, (uint32_t)i, &at->picture);
        took[i] = integrate(at->map, &at->s, &at->picture, at->camera, &pose, at->pool);
        if (i < views)
        {
            room_truth_see(&at->truth, &at->picture);
        }
        if (i + 1 == views)
        {
            report(at, "after the first pass");
        }
    }
}

int main(int argument_count, char **argument)
{
    name_program("room-accuracy");
    const settings s = read_settings(argument_count, argument);
    const size_t views = (size_t)s.views, passes = (size_t)s.passes;
    bench at;
    begin(&at, &s);
    double *took = allocate(views * passes + 1, sizeof *took);
    integrate_all(&at, took);
    report_times("first pass", took, views);
    if (passes > 1)
    {
        report_times("later passes", took + views, views * (passes - 1));
        report(&at, "after the last pass");
    }
    ask(cm_octree_compact(at.map), "compact");
    report_map(at.map, "compacted");
    free(took);
    end(&at);
    return 0;
}
