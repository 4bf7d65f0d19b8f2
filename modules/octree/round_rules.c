/* SPDX-License-Identifier: MIT
 *
 * What the pixels of lenses and of whole surroundings say.
 */
#include "update_round.h"

typedef struct rule_work
{
    const cm_update *update;
    cm_round_desk *round;
} rule_work;

/* How far along a pixel's ray the surface may cross a voxel, for a hit and for what is no miss. */
typedef struct round_reach
{
    double hit;
    double front;
} round_reach;

/* As in octree_set.inc, from the normal. */
static round_reach reach_of(const cm_update *update, const cm_round_desk *round, size_t pixel,
                            double value)
{
    const double edge = update->octree->options.edge;
    double point[3], normal[3], along = 0.0, square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        point[axis] = (double)round->vertex[axis][pixel];
        normal[axis] = (double)round->normal[axis][pixel];
        along += normal[axis] * point[axis];
        square += point[axis] * point[axis];
    }
    if (!(fabs(along) > 0.0))
    {
        return (round_reach){(0.5 * sqrt(3.0) + CM_HIT_MORE) * edge,
                             (0.5 * sqrt(3.0) + CM_FRONT_MORE) * edge};
    }
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        sum += fabs(normal[0] * update->step[axis][0] + normal[1] * update->step[axis][1] +
                    normal[2] * update->step[axis][2]);
    }
    const double range = sqrt(square);
    const double cosine = fmin(fabs(along) / range, 1.0);
    const double tangent = sqrt(1.0 - cosine * cosine) / cosine;
    const double side = round->side[pixel];
    const double beside = isfinite(side) ? 0.5 * side * tangent * value : 0.0;
    const double crossed = 0.5 * sum * value / fabs(along), most = CM_REACH_MOST * edge;
    return (round_reach){fmin(crossed + CM_HIT_ASIDE * beside + CM_HIT_MORE * edge, most),
                         fmin(crossed + CM_FRONT_ASIDE * beside + CM_FRONT_MORE * edge, most)};
}

static void reach_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    cm_round_desk *round = work->round;
    const cm_octree_options *options = &work->update->octree->options;
    const float *value = work->update->desk->view.packed;
    const float far = options->far > 0.0 ? (float)options->far : INFINITY;
    const size_t width = round->tree.width;
    for (size_t pixel = first * width; pixel < end * width; pixel++)
    {
        const float v = value[pixel];
        float reach_here = -1.0f;
        round->front[pixel] = v > far ? far : INFINITY;
        if (v <= far)
        {
            const double d = (double)v;
            const round_reach reach = reach_of(work->update, round, pixel, d);
            reach_here = (float)(reach.hit + options->noise * d);
            round->front[pixel] = (float)(d - reach.front - 2.0 * options->noise * d);
        }
        round->vertex[2][pixel] = reach_here; /* the pixel's maps have served */
    }
}

/* The least fronts around the pixels of a row, within its face: as in view_table.c. Of columns, then of those beside each other. */
static void least_row(const cm_round_desk *round, uint32_t row)
{
    const uint32_t width = round->tree.width, rows = round->tree.face_rows;
    const uint32_t face = row / rows * rows, beside = 2 * (uint32_t)round->around;
    const uint32_t first_row = row >= face + beside ? row - beside : face;
    const uint32_t end_row = row + beside < face + rows ? row + beside + 1 : face + rows;
    float *least = round->five + (size_t)row * width,
          *of_column = round->vertex[0] + (size_t)row * width;
    for (uint32_t c = 0; c < width; c++)
    {
        least[c] = of_column[c] = INFINITY;
    }
    for (uint32_t r = first_row; r < end_row; r++)
    {
        const float *front = round->front + (size_t)r * width;
        for (uint32_t c = 0; c < width; c++)
        {
            of_column[c] = front[c] < of_column[c] ? front[c] : of_column[c];
        }
    }
    for (uint32_t c = 0; c < width; c++)
    {
        const uint32_t end = c + beside < width ? c + beside + 1 : width;
        for (uint32_t k = c >= beside ? c - beside : 0; k < end; k++)
        {
            least[c] = of_column[k] < least[c] ? of_column[k] : least[c];
        }
    }
}

static void least_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    for (size_t row = first; row < end; row++)
    {
        least_row(work->round, (uint32_t)row);
    }
}

/* Range of omnidirectional cameras, depth of lenses. */
static cm_status take_values(rule_work *work)
{
    const cm_view *view = work->update->view;
    float *value = work->update->desk->view.packed;
    cm_round_desk *round = work->round;
    cm_status status = CM_OK;
    if (!round->is_range && view->depth_is_range)
    {
        status = cm_depth_from_range(round->rays, value, 1, value);
    }
    const cm_depth_maps maps = {.size = sizeof maps,
                                .is_range = round->is_range,
                                .vertex = {round->vertex[0], round->vertex[1], round->vertex[2]},
                                .normal = {round->normal[0], round->normal[1], round->normal[2]}};
    return status == CM_OK ? cm_depth_make_maps(round->rays, value, 1, &maps) : status;
}

double cm_round_mean_pixel(const cm_camera_options *camera)
{
    if (camera->mapping == NULL)
    {
        return 2.0 / (fabs(camera->fx) + fabs(camera->fy));
    }
    return sqrt(4.0 * 3.14159265358979 / ((double)camera->width * camera->height));
}

cm_status cm_round_rules_make(const cm_update *update, cm_round_desk *round, cm_pool *pool)
{
    rule_work work = {.update = update, .round = round};
    const cm_octree_options *options = &update->octree->options;
    const size_t width = round->tree.width, height = round->tree.height;
    cm_status status = take_values(&work);
    if (status != CM_OK)
    {
        return status;
    }
    round->around = cm_view_desk_around(
        &update->desk->view,
        options->edge / cm_round_mean_pixel(cm_camera_describe(update->view->camera)));
    cm_pool_run(pool, height, 4, reach_rows, &work);
    cm_pool_run(pool, height, 4, least_rows, &work);
    const float far = options->far > 0.0 ? (float)options->far : INFINITY;
    const float free_far = options->no_return_is_free ? (float)options->far : NAN;
    /* the maps have served: their memory takes the bounds */
    for (size_t row = 0; row < height; row++)
    {
        const size_t at = row * width;
        update->set->rules(width, update->desk->view.packed + at, round->vertex[2] + at,
                           round->five + at, far, free_far, round->rule + at, round->vertex[0] + at,
                           round->vertex[1] + at);
        cm_view_desk_silence(&update->desk->view, row, round->rule + at, round->vertex[0] + at,
                             round->vertex[1] + at);
    }
    cm_pixel_tree_fill(&round->tree, round->vertex[0], round->vertex[1]);
    return CM_OK;
}
