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

static void invert_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    const cm_view_desk *desk = &work->update->desk->view;
    const size_t width = work->round->tree.width;
    work->update->set->invert((end - first) * width, desk->packed + first * width,
                              work->round->inverse + first * width);
}

/* What is the same of all rows. */
static cm_round_row describe_row(const rule_work *work)
{
    const cm_octree_options *options = &work->update->octree->options;
    cm_round_row row = {.apart = work->apart,
                        .by_apart = 1.0 / (double)work->apart,
                        .edge = options->edge,
                        .noise = options->noise,
                        .far = options->far > 0.0 ? (float)options->far : INFINITY,
                        .hit_aside = CM_HIT_ASIDE,
                        .hit_more = CM_HIT_MORE,
                        .front_aside = CM_FRONT_ASIDE,
                        .front_more = CM_FRONT_MORE,
                        .most = CM_REACH_MOST};
    memcpy(row.step, work->update->step, sizeof row.step);
    return row;
}

static void reach_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    cm_round_desk *round = work->round;
    const size_t width = round->tree.width;
    cm_round_row row = describe_row(work);
    for (size_t r = first; r < end; r++)
    {
        const size_t in_face = r % round->tree.face_rows, away = work->apart * width;
        const int is_there[3] = {in_face >= work->apart, 1,
                                 in_face + work->apart < round->tree.face_rows};
        row.value = work->update->desk->view.packed + r * width;
        for (size_t k = 0; k < 3; k++)
        {
            const size_t at = is_there[k] ? r * width + k * away - away : 0;
            row.inverse[k] = is_there[k] ? round->inverse + at : round->none;
            for (int axis = 0; axis < 3; axis++)
            {
                row.ray[axis][k] = is_there[k] ? round->ray[axis] + at : round->none;
            }
        }
        work->update->set->round_reaches(width, &row, round->reach + r * width,
                                         round->front + r * width);
    }
}

/* Columns whose least fronts are found together, and twice as many as are looked at beside them at most: vectors are whole. */
#define COLUMNS_TOGETHER 512
#define COLUMNS_BESIDE (4 * CM_AROUND_MOST)

/* The least fronts around some pixels of a row, within its face: as in view_table.c. Of columns, then of those beside each other. */
static void least_part(const rule_work *work, uint32_t row, uint32_t first, uint32_t end)
{
    const cm_round_desk *round = work->round;
    const uint32_t width = round->tree.width, rows = round->tree.face_rows;
    const uint32_t face = row / rows * rows, beside = 2 * (uint32_t)round->around;
    const uint32_t first_row = row >= face + beside ? row - beside : face;
    const uint32_t end_row = row + beside < face + rows ? row + beside + 1 : face + rows;
    const uint32_t left = first >= beside ? first - beside : 0;
    const uint32_t right = width - end > beside ? end + beside : width;
    float of_column[COLUMNS_TOGETHER + 4 * COLUMNS_BESIDE],
        least[COLUMNS_TOGETHER + COLUMNS_BESIDE];
    for (size_t i = 0; i < COLUMNS_BESIDE; i++)
    {
        of_column[i] = INFINITY;
    }
    float *const from_left = of_column + COLUMNS_BESIDE;
    work->update->set->round_least(right - left, end_row - first_row, width,
                                   round->front + (size_t)first_row * width + left, from_left);
    for (size_t i = 0; i < 2 * COLUMNS_BESIDE; i++)
    {
        from_left[right - left + i] = INFINITY;
    }
    work->update->set->round_least(end - first, 2 * beside + 1, 1,
                                   from_left + (first - left) - beside, least);
    memcpy(round->five + (size_t)row * width + first, least, (end - first) * sizeof *least);
}

static void rule_rows(size_t first, size_t end, void *user)
{
    const rule_work *work = user;
    const cm_octree_options *options = &work->update->octree->options;
    const cm_view_desk *desk = &work->update->desk->view;
    cm_round_desk *round = work->round;
    const float far = options->far > 0.0 ? (float)options->far : INFINITY;
    const float free_far = options->no_return_is_free ? (float)options->far : NAN;
    const uint32_t width = round->tree.width;
    for (size_t row = first; row < end; row++)
    {
        for (uint32_t column = 0; column < width; column += COLUMNS_TOGETHER)
        {
            const uint32_t rest = width - column;
            least_part(work, (uint32_t)row, column,
                       rest < COLUMNS_TOGETHER ? width : column + COLUMNS_TOGETHER);
        }
        const size_t at = row * width;
        work->update->set->rules(width, desk->packed + at, round->reach + at, round->five + at, far,
                                 free_far, round->rule + at, round->bound[0] + at,
                                 round->bound[1] + at);
        cm_view_desk_silence(desk, row, round->rule + at, round->bound[0] + at,
                             round->bound[1] + at);
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
    const size_t height = round->tree.height;
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
    cm_pool_run(pool, height, 4, rule_rows, &work);
    cm_pixel_tree_fill(&round->tree, round->bound[0], round->bound[1]);
    cm_round_faces_fill(&round->faces, update->set, round->bound[0], round->bound[1], pool);
    return CM_OK;
}
