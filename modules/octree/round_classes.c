/* SPDX-License-Identifier: MIT
 *
 * What a view's pixels say in the cells of the sides around a camera, and what cubes of voxels are by that.
 */
#include "round_faces.h"

#include <math.h>
#include <string.h>

/* ---- what pixels say ---- */

typedef struct fill_work
{
    const cm_round_face *face;
    const float *least;
    const float *most;
} fill_work;

static void fill_rows(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    const cm_round_face *face = work->face;
    const cm_view_desk *desk = &face->desk;
    const size_t width = desk->table.level[1].width;
    for (size_t row = first; row < end; row++)
    {
        for (size_t column = 0; column < width; column++)
        {
            const size_t cell = row * width + column;
            float least = face->is_border[cell] ? -INFINITY : INFINITY, most = -INFINITY;
            for (uint32_t i = face->start[cell]; i < face->start[cell + 1]; i++)
            {
                const cm_pixel_run run = face->run[i];
                for (uint32_t pixel = run.first; pixel < run.first + run.count; pixel++)
                {
                    least = work->least[pixel] < least ? work->least[pixel] : least;
                    most = work->most[pixel] > most ? work->most[pixel] : most;
                }
            }
            desk->least[1][row * desk->stride + column] = least;
            desk->most[1][row * desk->stride + column] = most;
        }
    }
}

void cm_round_faces_fill(cm_round_faces *faces, const cm_octree_set *set, const float *least,
                         const float *most, cm_pool *pool)
{
    faces->greatest = -INFINITY;
    for (int which = 0; which < CM_ROUND_FACES; which++)
    {
        cm_round_face *face = &faces->face[which];
        if (face->is_used)
        {
            fill_work work = {face, least, most};
            cm_pool_run(pool, face->desk.table.level[1].height, 16, fill_rows, &work);
            cm_view_desk_windows(&face->desk, set, pool);
            const float greatest = face->desk.greatest;
            faces->greatest = greatest > faces->greatest ? greatest : faces->greatest;
        }
    }
}

/* ---- cubes ---- */

/* So many cubes are told apart by their sides at a time. */
#define CUBES_TOGETHER 128

/* Cubes of one side, in its axes; and what was measured from where to where. */
typedef struct side_cubes
{
    size_t count;
    uint8_t from[CUBES_TOGETHER];
    float x[CUBES_TOGETHER];
    float y[CUBES_TOGETHER];
    float z[CUBES_TOGETHER];
    float near[CUBES_TOGETHER];
    float far[CUBES_TOGETHER];
} side_cubes;

/* The side that a cube is wholly on, or CM_ROUND_FACES. */
static int side_of(const float at[3], const float half[3])
{
    const float size[3] = {fabsf(at[0]), fabsf(at[1]), fabsf(at[2])};
    const int first = size[0] >= size[1] ? 0 : 1, ahead = size[first] >= size[2] ? first : 2;
    const int u = (ahead + 1) % 3, v = (ahead + 2) % 3;
    const float beside = (float)CM_ROUND_SIDE * (size[ahead] - half[ahead]);
    const int is_on = beside > 0.0f && size[u] + half[u] <= beside && size[v] + half[v] <= beside;
    return is_on ? 2 * ahead + (at[ahead] < 0.0f) : CM_ROUND_FACES;
}

/* From where to where a cube is, as it is measured; a little more for rounding. */
static void measure_cube(const cm_round_cubes *cubes, const float at[3], float *near, float *far)
{
    if (!cubes->is_range)
    {
        *near = at[2] - cubes->half[2];
        *far = at[2] + cubes->half[2];
        return;
    }
    float least = 0.0f, most = 0.0f;
    for (int axis = 0; axis < 3; axis++)
    {
        const float size = fabsf(at[axis]), half = cubes->half[axis];
        const float low = size > half ? size - half : 0.0f, high = size + half;
        least += low * low;
        most += high * high;
    }
    *near = sqrtf(least) * (1.0f - 1e-6f);
    *far = sqrtf(most) * (1.0f + 1e-6f);
}

static void add_cube(const cm_round_cubes *cubes, size_t cube, size_t from, int side,
                     side_cubes *to)
{
    const float at[3] = {cubes->at[0][cube], cubes->at[1][cube], cubes->at[2][cube]};
    const int ahead = side / 2;
    const size_t i = to->count++;
    to->from[i] = (uint8_t)from;
    to->x[i] = at[(ahead + 1) % 3];
    to->y[i] = at[(ahead + 2) % 3];
    to->z[i] = side % 2 ? -at[ahead] : at[ahead];
    measure_cube(cubes, at, &to->near[i], &to->far[i]);
}

static void classify_side(const cm_round_face *face, const cm_octree_set *set,
                          const cm_round_cubes *cubes, int side, side_cubes *of, uint8_t *class_of,
                          cm_cube_bounds *bounds)
{
    const int ahead = side / 2;
    const float half[3] = {cubes->half[(ahead + 1) % 3], cubes->half[(ahead + 2) % 3],
                           cubes->half[ahead]};
    uint8_t classes[CUBES_TOGETHER];
    cm_cube_bounds known[CUBES_TOGETHER];
    for (size_t i = of->count; i % 16 != 0; i++)
    {
        of->x[i] = of->y[i] = of->z[i] = of->near[i] = of->far[i] = 0.0f;
    }
    set->classify_between(&face->desk.table, of->count, of->x, of->y, of->z, half, of->near,
                          of->far, cubes->nearest, classes, bounds == NULL ? NULL : known);
    for (size_t i = 0; i < of->count; i++)
    {
        class_of[of->from[i]] = classes[i];
        if (bounds != NULL && classes[i] != CM_CUBE_OUTSIDE)
        {
            bounds[of->from[i]] = known[i];
        }
    }
}

static void classify_some(const cm_round_faces *faces, const cm_octree_set *set,
                          const cm_round_cubes *cubes, size_t first, size_t count,
                          uint8_t *class_of, cm_cube_bounds *bounds)
{
    uint8_t side_of_cube[CUBES_TOGETHER];
    unsigned sides = 0;
    for (size_t i = 0; i < count; i++)
    {
        const float at[3] = {cubes->at[0][first + i], cubes->at[1][first + i],
                             cubes->at[2][first + i]};
        const int side = side_of(at, cubes->half);
        side_of_cube[i] = (uint8_t)side;
        sides |= 1u << side;
        class_of[i] = side == CM_ROUND_FACES ? CM_CUBE_UNKNOWN : CM_CUBE_OUTSIDE;
        if (bounds != NULL)
        {
            bounds[i] = (cm_cube_bounds){-INFINITY, INFINITY};
        }
    }
    for (int side = 0; side < CM_ROUND_FACES; side++)
    {
        if ((sides >> side & 1u) == 0 || !faces->face[side].is_used)
        {
            continue;
        }
        side_cubes of;
        of.count = 0;
        for (size_t i = 0; i < count; i++)
        {
            if (side_of_cube[i] == side)
            {
                add_cube(cubes, first + i, i, side, &of);
            }
        }
        classify_side(&faces->face[side], set, cubes, side, &of, class_of, bounds);
    }
}

void cm_round_faces_classify(const cm_round_faces *faces, const cm_octree_set *set,
                             const cm_round_cubes *cubes, uint8_t *class_of, cm_cube_bounds *bounds)
{
    for (size_t first = 0; first < cubes->count; first += CUBES_TOGETHER)
    {
        const size_t rest = cubes->count - first;
        classify_some(faces, set, cubes, first, rest < CUBES_TOGETHER ? rest : CUBES_TOGETHER,
                      class_of + first, bounds == NULL ? NULL : bounds + first);
    }
}
