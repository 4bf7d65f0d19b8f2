/* SPDX-License-Identifier: MIT
 *
 * What the pixels of lenses and of whole surroundings say.
 */
#include "update_round.h"

typedef struct rule_work
{
    const cm_update *update;
    cm_round_desk *round;
    size_t apart; /* pixels between which slopes are taken */
} rule_work;

/* How far along a pixel's ray the surface may cross a voxel, for a hit and for what is no miss. */
typedef struct round_reach
{
    double hit;
    double front;
} round_reach;

/* From a pixel to one beside it: what 1 / value rises, and the ray's way. */
typedef struct round_slope
{
    double rise;
    double way[3];
} round_slope;

static round_slope slope_to(const cm_round_desk *round, size_t pixel, size_t other)
{
    round_slope slope = {.rise = (double)round->inverse[other] - (double)round->inverse[pixel]};
    for (int axis = 0; axis < 3; axis++)
    {
        slope.way[axis] = (double)round->ray[axis][other] - (double)round->ray[axis][pixel];
    }
    return slope;
}

/* Of the pixels `beside` this one along a row or a column, where they are, that to which 1 / value changes less, as in
 * octree_set.inc: it is of the same surface. Where neither has measured something: no rise. */
static round_slope slope_of(const cm_round_desk *round, size_t pixel, size_t beside, int has_before,
                            int has_after)
{
    round_slope chosen = {.rise = NAN, .way = {NAN, NAN, NAN}};
    for (int side = 0; side < 2; side++)
    {
        if (side == 0 ? has_before : has_after)
        {
            const round_slope slope =
                slope_to(round, pixel, side == 0 ? pixel - beside : pixel + beside);
            const int is_better = isnan(chosen.rise) || fabs(slope.rise) < fabs(chosen.rise);
            chosen = is_better && !isnan(slope.way[0]) ? slope : chosen;
        }
    }
    chosen.rise = isnan(chosen.rise) ? 0.0 : chosen.rise;
    return chosen;
}

static void cross(const double a[3], const double b[3], double to[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        to[axis] = a[next] * b[last] - a[last] * b[next];
    }
}

/* The plane n X = 1 that a pixel shows, in the camera's axes: at its ray n is 1 / value, and along both ways it rises. 0: none. */
static int plane_of(const double ray[3], double inverse, const round_slope *across,
                    const round_slope *down, double n[3])
{
    double of_ray[3], of_across[3], of_down[3];
    cross(across->way, down->way, of_ray);
    cross(down->way, ray, of_across);
    cross(ray, across->way, of_down);
    const double volume = ray[0] * of_ray[0] + ray[1] * of_ray[1] + ray[2] * of_ray[2];
    for (int axis = 0; axis < 3; axis++)
    {
        n[axis] =
            (inverse * of_ray[axis] + across->rise * of_across[axis] + down->rise * of_down[axis]) /
            volume;
    }
    return fabs(volume) > 0.0;
}

/* As in octree_set.inc. |n X - 1| is at most half an edge times the sum where the plane crosses a cube. */
static round_reach reach_of(const rule_work *work, size_t row, size_t column, double value)
{
    const cm_round_desk *round = work->round;
    const cm_update *update = work->update;
    const size_t width = round->tree.width, pixel = row * width + column, apart = work->apart;
    const size_t in_face = row % round->tree.face_rows;
    const double edge = update->octree->options.edge;
    const round_slope across =
        slope_of(round, pixel, apart, column >= apart, column + apart < width);
    const round_slope down = slope_of(round, pixel, apart * width, in_face >= apart,
                                      in_face + apart < round->tree.face_rows);
    const double ray[3] = {(double)round->ray[0][pixel], (double)round->ray[1][pixel],
                           (double)round->ray[2][pixel]};
    double n[3];
    if (!plane_of(ray, 1.0 / value, &across, &down, n))
    {
        return (round_reach){(0.5 * sqrt(3.0) + CM_HIT_MORE) * edge,
                             (0.5 * sqrt(3.0) + CM_FRONT_MORE) * edge};
    }
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        sum += fabs(n[0] * update->step[axis][0] + n[1] * update->step[axis][1] +
                    n[2] * update->step[axis][2]);
    }
    const double beside =
        0.5 * value * value * (fabs(across.rise) + fabs(down.rise)) / (double)apart;
    const double crossed = 0.5 * sum * value, most = CM_REACH_MOST * edge;
    return (round_reach){fmin(crossed + CM_HIT_ASIDE * beside + CM_HIT_MORE * edge, most),
                         fmin(crossed + CM_FRONT_ASIDE * beside + CM_FRONT_MORE * edge, most)};
}

static void invert_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    const cm_view_desk *desk = &work->update->desk->view;
    const size_t width = work->round->tree.width;
    work->update->set->invert((end - first) * width, desk->packed + first * width,
                              work->round->inverse + first * width);
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
        round->reach[pixel] = -1.0f;
        round->front[pixel] = v > far ? far : INFINITY;
        if (v <= far)
        {
            const double d = (double)v;
            const round_reach reach = reach_of(work, pixel / width, pixel % width, d);
            round->reach[pixel] = (float)(reach.hit + options->noise * d);
            round->front[pixel] = (float)(d - reach.front - 2.0 * options->noise * d);
        }
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
          *of_column = round->bound[0] + (size_t)row * width;
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
        status = round->rays != NULL
                     ? CM_OK
                     : cm_rays_create(view->camera, work->update->set->name, &round->rays);
        status = status != CM_OK ? status : cm_depth_from_range(round->rays, value, 1, value);
    }
    return status;
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
    const cm_octree_options *options = &update->octree->options;
    rule_work work = {.update = update,
                      .round = round,
                      .apart = options->noise > 0.0 ? CM_APART_WITH_NOISE : CM_APART};
    const size_t width = round->tree.width, height = round->tree.height;
    cm_status status = take_values(&work);
    if (status != CM_OK)
    {
        return status;
    }
    round->around = cm_view_desk_around(
        &update->desk->view,
        options->edge / cm_round_mean_pixel(cm_camera_describe(update->view->camera)));
    cm_pool_run(pool, height, 4, invert_rows, &work);
    cm_pool_run(pool, height, 4, reach_rows, &work);
    cm_pool_run(pool, height, 4, least_rows, &work);
    const float far = options->far > 0.0 ? (float)options->far : INFINITY;
    const float free_far = options->no_return_is_free ? (float)options->far : NAN;
    for (size_t row = 0; row < height; row++)
    {
        const size_t at = row * width;
        update->set->rules(width, update->desk->view.packed + at, round->reach + at,
                           round->five + at, far, free_far, round->rule + at, round->bound[0] + at,
                           round->bound[1] + at);
        cm_view_desk_silence(&update->desk->view, row, round->rule + at, round->bound[0] + at,
                             round->bound[1] + at);
    }
    cm_pixel_tree_fill(&round->tree, round->bound[0], round->bound[1]);
    return CM_OK;
}
