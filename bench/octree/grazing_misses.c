/* SPDX-License-Identifier: MIT
 *
 * Which voxels of the analytic room are seen at grazing angles alone and are not occupied, and what the pixel that their centre falls
 * on sees in the view that met them best:
 *
 *   grazing-misses [--edge 0.02] [--views 60] [--centre 0.37]
 *
 * prints how many they are, how many of them were hit by a view that met them, so that others missed them, and for each of
 * these how many there are: the centre is beside the picture; what is seen there is nearer, so that the centre is
 * hidden; it is farther, so that the centre lies before a background; or neither, within an edge. A voxel is seen if the ray of any
 * pixel meets a surface in it, be it in a corner.
 */
#include "bench/harness/harness.h"
#include "mapped_room.h"
#include "truth/room_views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/octree.h>

/* As in truth/room_views.h. */
#define GRAZING 0.2

typedef enum miss_cause
{
    NOT_MET = 0,
    BESIDE_PICTURE,
    HIDDEN,
    BEFORE_BACKGROUND,
    WITHIN_AN_EDGE,
    CAUSES
} miss_cause;

/* What was seen of a voxel. */
typedef struct seen_voxel
{
    float cosine; /* the best */
    float behind; /* edges from what is seen where its centre falls on */
    uint8_t cause;
    uint8_t before;  /* alpha, before the view */
    uint8_t was_hit; /* by one of the views that met it */
} seen_voxel;

typedef struct work
{
    double edge;
    double centre[3];
    size_t views;
    cm_scene *scene;
    cm_camera *camera;
    cm_octree *map;
    room_picture picture;
    int64_t first[3];
    size_t count[3];
    seen_voxel *seen;
} work;

static void begin(work *w, double aside)
{
    static const double least[3] = {-3.0, -2.5, 0.0}, greatest[3] = {3.0, 2.5, 3.0};
    cm_octree_options options = {.size = sizeof options, .edge = w->edge, .levels = 12};
    size_t voxels = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        w->centre[axis] = options.centre[axis] = aside * w->edge;
        w->first[axis] = (int64_t)floor((least[axis] - w->centre[axis]) / w->edge);
        w->count[axis] = (size_t)ceil((greatest[axis] - least[axis]) / w->edge) + 2;
        voxels *= w->count[axis];
    }
    need(cm_scene_create_named("room", &w->scene), "room");
    w->camera = room_camera();
    need(cm_octree_create(&options, &w->map), "map");
    need(room_picture_make(w->camera, &w->picture) ? CM_OK : CM_ERROR_MEMORY, "pictures");
    w->seen = allocate(voxels, sizeof *w->seen);
    memset(w->seen, 0, voxels * sizeof *w->seen);
}

static void voxel_centre(const work *w, size_t index, double at[3])
{
    const size_t place[3] = {index % w->count[0], index / w->count[0] % w->count[1],
                             index / w->count[0] / w->count[1]};
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] =
            ((double)(w->first[axis] + (int64_t)place[axis]) + 0.5) * w->edge + w->centre[axis];
    }
}

/* The voxel that a pixel's ray ends in; 0: none that is judged. */
static int voxel_met(const work *w, size_t pixel, size_t *index)
{
    size_t place[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = (w->picture.point[axis][pixel] - w->centre[axis]) / w->edge;
        const double from = floor(at) - (double)w->first[axis];
        if (!(from >= 0.0 && from < (double)w->count[axis]))
        {
            return 0;
        }
        place[axis] = (size_t)from;
    }
    *index = place[0] + w->count[0] * (place[1] + w->count[1] * place[2]);
    return 1;
}

/* What the pixel sees that a voxel's centre falls on; *behind: how many edges the centre is behind it. */
static miss_cause cause_at(const work *w, const cm_pose *pose, size_t index, float *behind)
{
    double centre[3], at[3];
    voxel_centre(w, index, centre);
    cm_pose_apply(pose, centre, at);
    double column, row;
    cm_camera_project_array(w->camera, 1, &at[0], &at[1], &at[2], &column, &row);
    column = floor(column + 0.5);
    row = floor(row + 0.5);
    if (!(column >= 0.0 && column < ROOM_WIDTH && row >= 0.0 && row < ROOM_HEIGHT))
    {
        return BESIDE_PICTURE;
    }
    const size_t pixel = (size_t)row * ROOM_WIDTH + (size_t)column;
    *behind = (float)((at[2] - w->picture.depth[pixel]) / w->edge);
    return *behind > 1.0f ? HIDDEN : *behind < -1.0f ? BEFORE_BACKGROUND : WITHIN_AN_EDGE;
}

static int alpha_of(const work *w, size_t index)
{
    double at[3];
    cm_voxel voxel = {.alpha = 127};
    voxel_centre(w, index, at);
    cm_octree_at(w->map, at, 0, &voxel);
    return voxel.alpha;
}

static void remember_alphas(work *w)
{
    for (size_t pixel = 0; pixel < w->picture.pixels; pixel++)
    {
        size_t index;
        if (isfinite(w->picture.depth[pixel]) && voxel_met(w, pixel, &index))
        {
            w->seen[index].before = (uint8_t)alpha_of(w, index);
        }
    }
}

static void see(work *w, size_t view)
{
    const cm_pose pose = room_pose(view, w->views);
    room_picture_take(w->scene, w->camera, &pose, 0.0, (uint32_t)view, &w->picture);
    const cm_view of_map = room_picture_view(&w->picture, w->camera, &pose, 0);
    remember_alphas(w);
    need(cm_octree_update(w->map, &of_map, NULL), "update");
    for (size_t pixel = 0; pixel < w->picture.pixels; pixel++)
    {
        const float cosine = (float)w->picture.cosine[pixel];
        size_t index;
        if (isfinite(w->picture.depth[pixel]) && voxel_met(w, pixel, &index) &&
            (w->seen[index].cause == NOT_MET || cosine > w->seen[index].cosine))
        {
            seen_voxel *seen = &w->seen[index];
            seen->cosine = cosine;
            seen->cause = (uint8_t)cause_at(w, &pose, index, &seen->behind);
        }
        if (isfinite(w->picture.depth[pixel]) && voxel_met(w, pixel, &index) &&
            alpha_of(w, index) > w->seen[index].before)
        {
            w->seen[index].was_hit = 1;
        }
    }
}

static void report(const work *w)
{
    static const char *const names[CAUSES] = {
        "", "the centre is beside the picture", "the centre is hidden",
        "the centre is before a background", "the centre is within an edge of what is seen"};
    const size_t voxels = w->count[0] * w->count[1] * w->count[2];
    size_t grazing = 0, missed = 0, erased = 0, by_cause[CAUSES] = {0};
    double *behind = allocate(voxels, sizeof *behind);
    for (size_t i = 0; i < voxels; i++)
    {
        if (w->seen[i].cause == NOT_MET || (double)w->seen[i].cosine >= GRAZING)
        {
            continue;
        }
        double centre[3];
        voxel_centre(w, i, centre);
        const int is_missed = cm_octree_at(w->map, centre, 0, NULL) != CM_VOXEL_OCCUPIED;
        grazing++;
        missed += (size_t)is_missed;
        erased += (size_t)(is_missed && w->seen[i].was_hit);
        behind[by_cause[HIDDEN]] = (double)w->seen[i].behind;
        by_cause[w->seen[i].cause] += (size_t)is_missed;
    }
    printf("%-46s %zu\n%-46s %zu\n", "seen at grazing angles alone", grazing, "not occupied",
           missed);
    printf("%-46s %zu\n", "    of these hit, and missed as often or more", erased);
    for (int cause = BESIDE_PICTURE; cause < CAUSES; cause++)
    {
        printf("    %-42s %zu\n", names[cause], by_cause[cause]);
    }
    double *const sorted = sorted_copy(behind, by_cause[HIDDEN]);
    for (int quarter = 0; by_cause[HIDDEN] > 0 && quarter < 5; quarter++)
    {
        printf("%s%.2f%s", quarter == 0 ? "hidden centres are behind what is seen by: " : ", ",
               sorted[(by_cause[HIDDEN] - 1) * (size_t)quarter / 4],
               quarter == 4 ? " edges (least, quarters, most)\n" : "");
    }
    free(sorted);
    free(behind);
}

static void end(work *w)
{
    free(w->seen);
    room_picture_free(&w->picture);
    cm_octree_destroy(w->map);
    cm_camera_destroy(w->camera);
    cm_scene_destroy(w->scene);
}

int main(int count, char **word)
{
    name_program("grazing-misses");
    double edge = 0.02, views = 60.0, centre = 0.37;
    for (int i = 1; i < count; i += 2)
    {
        double *const to = strcmp(word[i], "--edge") == 0     ? &edge
                           : strcmp(word[i], "--views") == 0  ? &views
                           : strcmp(word[i], "--centre") == 0 ? &centre
                                                              : NULL;
        if (to == NULL || i + 1 == count || isnan(*to = number_of(word[i + 1])))
        {
            fprintf(stderr, "grazing-misses: %s: no such option, or no number\n", word[i]);
            return 2;
        }
    }
    work w = {.edge = edge, .views = (size_t)views};
    begin(&w, centre);
    for (size_t view = 0; view < w.views; view++)
    {
        see(&w, view);
    }
    report(&w);
    end(&w);
    return 0;
}
