/* SPDX-License-Identifier: MIT
 *
 * The search for an orientation: the survey finds the best, then branch and bound over boxes of rotations, level by
 * level, says what all others can be. All boxes of a level are bounded before any is left out, so that the result
 * does not depend on how threads share them.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/catalogue_words.h"
#include "orient_mask.h"
#include "orient_field.h"
#include "orient_edges.h"
#include "orient_value.h"
#include "orient_survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE 0.017453292519943295769
#define SURVEY_PART 0.6 /* of the progress */

enum
{
    LEVELS = 5,   /* boxes of 5.6 degrees to 0.35, as wide as rotations go */
    BLOCK = 2048, /* of boxes, between two calls of progress */
    ALL_PIXELS = 4194304,
    FINE_CLUSTERS = 1024
};

static const char *const names[] = {"deformation", "isotropy", "area", "scale", "edges"};

#define MEASURES (sizeof names / sizeof names[0])

const char *cm_orient_measure_name(size_t index)
{
    return index < MEASURES ? names[index] : NULL;
}

int cm_orient_measure_find(const char *name)
{
    for (size_t i = 0; i < MEASURES && name != NULL; i++)
    {
        if (cm_word_equal(name, strlen(name), names[i], strlen(names[i])))
        {
            return (int)i;
        }
    }
    return -1;
}

/* ---- The task ---- */

static int is_mask(const cm_mask *mask, double *largest)
{
    if (mask == NULL || mask->size != sizeof *mask || mask->value == NULL || mask->width < 1 ||
        mask->width > CM_MASK_MAX || mask->height < 1 || mask->height > CM_MASK_MAX)
    {
        return 0;
    }
    *largest = 0.0;
    for (size_t i = 0; i < mask->width * mask->height; i++)
    {
        const double value = (double)mask->value[i];
        if (!(value >= 0.0) || isinf(value))
        {
            return 0;
        }
        *largest = value > *largest ? value : *largest;
    }
    return *largest > 0.0;
}

static int are_good(const cm_orient_options *o)
{
    return o != NULL && o->size == sizeof *o && (size_t)o->measure < MEASURES &&
           (o->over == CM_OVER_SPHERE || o->over == CM_OVER_FACE) &&
           (o->resolution == 0.0 || (o->resolution >= 0.01 && o->resolution <= 10.0));
}

static cm_status make_task(const cm_mapping *mapping, const cm_mask *mask,
                           const cm_orient_options *options, cm_orient_task *task)
{
    *task = (cm_orient_task){.mapping = mapping, .mask = mask};
    if (mapping == NULL || !are_good(options) || !is_mask(mask, &task->largest))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    task->measure = options->measure;
    task->over = options->measure == CM_ORIENT_EDGES ? CM_OVER_SPHERE : options->over;
    task->threads = options->threads;
    return task->measure != CM_ORIENT_EDGES || cm_edges_make(task) ? CM_OK : CM_ERROR_MEMORY;
}

/* From a mean of normalised values to what is documented. */
static double unit_of(const cm_orient_task *task)
{
    return task->measure == CM_ORIENT_EDGES ? task->edges_length * task->largest : 1.0;
}

/* Points for the measure itself; none are needed for edges. 0 without memory. */
static int make_whole_mask(const cm_orient_task *task, cm_orient_points *points)
{
    size_t count = 0;
    *points = (cm_orient_points){.count = 0};
    for (size_t i = 0; i < task->mask->width * task->mask->height; i++)
    {
        count += task->mask->value[i] > 0.0f;
    }
    return task->measure == CM_ORIENT_EDGES ||
           cm_mask_points(task, count > ALL_PIXELS ? FINE_CLUSTERS : 0, points);
}

cm_status cm_orient_value(const cm_mapping *mapping, const cm_mask *mask,
                          const cm_orient_options *options, const cm_rotation *rotation,
                          double *value)
{
    cm_orient_task task;
    cm_orient_points points;
    cm_status status =
        rotation == NULL || value == NULL ? CM_ERROR_ARGUMENT : cm_rotation_check(rotation);
    if (status != CM_OK)
    {
        return status;
    }
    status = make_task(mapping, mask, options, &task);
    if (status == CM_OK)
    {
        const int made = make_whole_mask(&task, &points);
        const double found = made ? cm_task_value(&task, &points, rotation) : (double)NAN;
        status = isnan(found) ? CM_ERROR_MEMORY : CM_OK;
        *value = status == CM_OK ? found * unit_of(&task) : *value;
        cm_points_free(&points);
    }
    cm_edges_free(&task);
    return status;
}

/* ---- Levels ---- */

/* Clusters and pieces half as large as boxes: finer ones cost more than the boxes that they leave out. With the
 * finest boxes, which are few, it is the points that cost. */
/* What is below the best value in a level's terms: fields are less best where that is over the sphere. */
typedef struct cm_orient_level
{
    cm_orient_points points;
    cm_orient_table table;
    int back;
    double least_scale; /* by which a bound below 0 is divided to be one of the value */
} cm_orient_level;

/* Points and table for boxes of a radius, relative to the best value (normalised as cm_task_value). 0 if there
 * is no memory. */
static int level_make(const cm_orient_task *task, double radius, double best,
                      cm_orient_level *level)
{
    const int edges = task->measure == CM_ORIENT_EDGES;
    const unsigned clusters = (unsigned)((radius > 0.015 ? 1.6 : 0.9) / radius);
    const unsigned side = ((unsigned)fmin(5.5 / radius, 512.0) + 31) / 32 * 32;
    double length;
    *level = (cm_orient_level){.back = edges, .least_scale = 1.0};
    const int made = edges ? cm_edge_points(task->mapping, radius, &level->points, &length)
                           : cm_mask_points(task, clusters, &level->points);
    if (!made || !cm_table_make(&level->table, side))
    {
        return 0;
    }
    /* directions in float are 1e-7 off */
    const double reach = radius + level->points.reach + level->table.half_diagonal + 1e-6;
    if (!edges)
    {
        return cm_field_table(task, reach, radius, best, &level->table, &level->least_scale);
    }
    return cm_mask_table(task, reach, best, &level->table);
}

static void level_free(cm_orient_level *level)
{
    cm_points_free(&level->points);
    cm_table_free(&level->table);
}

/* ---- The search ---- */

typedef struct search
{
    const cm_orient_task *task;
    const cm_orient_options *options;
    const cm_orient_points *mask; /* all of it; none of edges */
    cm_orient_survey survey;
    cm_boxes boxes;
    float *bound;  /* less the best */
    size_t looked; /* at so many in all */
    cm_quaternion best_turn;
    double best;
    const cm_orient_level *level;
    size_t begin; /* of the block of boxes that threads work at */
} search;

static void bound_boxes(size_t begin, size_t end, void *user)
{
    search *s = user;
    for (size_t i = s->begin + begin; i < s->begin + end; i++)
    {
        cm_box_shape shape;
        cm_box_find_shape(&s->boxes.box[i], &shape);
        s->bound[i] = (float)cm_orient_bound(s->task->mapping->set, &s->level->points,
                                             &s->level->table, s->level->back, &shape);
    }
}

static int is_stopped(const search *s, double done)
{
    return s->options->progress != NULL && s->options->progress(done, s->options->user) != 0;
}

static double largest_radius(const search *s)
{
    double largest = 0.0;
    for (size_t i = 0; i < s->boxes.count; i++)
    {
        cm_box_shape shape;
        cm_box_find_shape(&s->boxes.box[i], &shape);
        largest = shape.radius > largest ? shape.radius : largest;
    }
    return largest;
}

/* Bounds all boxes of a level and leaves out those that are no better than the best; what the others may be
 * better by is *gap. CM_OK, CM_ERROR_MEMORY, CM_ERROR_STOPPED. */
static cm_status bound_level(search *s, int index, double *gap)
{
    const size_t count = s->boxes.count;
    cm_orient_level level = {.points = {.count = 0}};
    free(s->bound);
    s->bound = malloc(count * sizeof *s->bound);
    cm_status status = s->bound != NULL && level_make(s->task, largest_radius(s), s->best, &level)
                           ? CM_OK
                           : CM_ERROR_MEMORY;
    s->level = &level;
    for (s->begin = 0; s->begin < count && status == CM_OK; s->begin += BLOCK)
    {
        const size_t block = count - s->begin < BLOCK ? count - s->begin : BLOCK;
        cm_run_threads(s->task->threads, block, 64, bound_boxes, s);
        const double part = (index + (double)(s->begin + block) / (double)count) / LEVELS;
        status = is_stopped(s, SURVEY_PART + (1.0 - SURVEY_PART) * part) ? CM_ERROR_STOPPED : CM_OK;
    }
    s->looked += count;
    size_t kept = 0;
    *gap = 0.0;
    for (size_t i = 0; i < count && status == CM_OK; i++)
    {
        if (s->bound[i] < 0.0f)
        {
            *gap = fmax(*gap, -(double)s->bound[i] / level.least_scale);
            s->boxes.box[kept++] = s->boxes.box[i];
        }
    }
    s->boxes.count = status == CM_OK ? kept : count;
    level_free(&level);
    return status;
}

static cm_status run_levels(search *s, size_t most, double *gap)
{
    cm_status status = cm_boxes_make(&s->boxes, &s->task->symmetries) ? CM_OK : CM_ERROR_MEMORY;
    for (int level = 0; level < LEVELS && status == CM_OK; level++)
    {
        if (level > 0 && (s->boxes.count == 0 || s->boxes.count > most / 8))
        {
            break;
        }
        if (level > 0 && !cm_boxes_split(&s->boxes, &s->task->symmetries))
        {
            return CM_ERROR_MEMORY;
        }
        status = bound_level(s, level, gap);
    }
    return status;
}

/* ---- The result ---- */

/* Of the rotations that are as good, the least turned. */
static cm_quaternion least_turned(const search *s, const cm_quaternion *turn)
{
    const cm_symmetries *all = &s->task->symmetries;
    cm_quaternion best = *turn;
    for (unsigned i = 1; i < all->count; i++)
    {
        const cm_quaternion other = cm_quaternion_product(&all->turn[i], turn);
        best = fabs(other.q[0]) > fabs(best.q[0]) + 1e-12 ? other : best;
    }
    return best;
}

static double farthest_box(const search *s)
{
    double farthest = 0.0;
    for (size_t i = 0; i < s->boxes.count; i++)
    {
        cm_box_shape shape;
        cm_box_find_shape(&s->boxes.box[i], &shape);
        const double far =
            cm_rotations_apart(&shape.centre, &s->best_turn, &s->task->symmetries) + shape.radius;
        farthest = far > farthest ? far : farthest;
    }
    return fmin(180.0, farthest / DEGREE);
}

/* Of a rotation or one that is as good; 0 without memory. */
static int fill_rival(const search *s, const cm_quaternion *turn, cm_orient_rival *to)
{
    const cm_quaternion least = least_turned(s, turn);
    cm_matrix_from_quaternion(&least, &to->rotation);
    /* rounded as cm_orient_value does it there */
    to->value = cm_task_value(s->task, s->mask, &to->rotation) * unit_of(s->task);
    return !isnan(to->value);
}

/* The rivals beside the first, and the best that is elsewhere. 0 without memory. */
static int fill_rivals(const search *s, cm_orient_result *r)
{
    const cm_symmetries *symmetries = &s->task->symmetries;
    const cm_valley *taken[CM_ORIENT_RIVALS_MAX];
    r->rival[0] = (cm_orient_rival){r->rotation, r->after};
    r->other = r->rival[0];
    r->rival_count = 1;
    for (size_t i = 0; i < s->survey.followed; i++)
    {
        const cm_valley *v = &s->survey.valley[i];
        const double apart = cm_rotations_apart(&v->turn, &s->best_turn, symmetries);
        int known = apart < 2.0 * DEGREE;
        for (size_t k = 1; k < r->rival_count && !known; k++)
        {
            known = cm_rotations_apart(&v->turn, &taken[k]->turn, symmetries) < 2.0 * DEGREE;
        }
        if (!known && r->rival_count < CM_ORIENT_RIVALS_MAX)
        {
            taken[r->rival_count] = v;
            if (!fill_rival(s, &v->turn, &r->rival[r->rival_count++]))
            {
                return 0;
            }
        }
        if (apart >= CM_OTHER_VALLEY && r->other_apart == 0.0)
        {
            r->other_apart = apart / DEGREE;
            if (!fill_rival(s, &v->turn, &r->other))
            {
                return 0;
            }
        }
    }
    return 1;
}

static cm_status fill_result(const search *s, double before, double gap, cm_orient_result *result)
{
    const double unit = unit_of(s->task);
    cm_orient_result r = {.size = sizeof r,
                          .before = before * unit,
                          .gap = gap * unit,
                          .symmetries = s->task->symmetries.count,
                          .boxes = s->looked,
                          .nodes = s->survey.nodes,
                          .spacing = s->survey.spacing / DEGREE,
                          .minima = s->survey.minima,
                          .valleys = s->survey.valley_count,
                          .followed = s->survey.followed,
                          .margin = s->survey.margin * unit,
                          .error = s->survey.error * unit,
                          .drop = s->survey.drop * unit};
    cm_orient_rival best;
    if (!fill_rival(s, &s->best_turn, &best))
    {
        return CM_ERROR_MEMORY;
    }
    r.rotation = best.rotation;
    r.after = best.value;
    cm_rotation_angles(&r.rotation, &r.lon, &r.lat, &r.roll);
    r.radius = farthest_box(s);
    if (!fill_rivals(s, &r))
    {
        return CM_ERROR_MEMORY;
    }
    *result = r;
    return CM_OK;
}

/* Is the measure the same everywhere, so that no orientation is better? */
static int is_flat(const cm_orient_task *task, const cm_orient_points *mask, int *flat)
{
    cm_quaternion turn = {{1.0, 0.0, 0.0, 0.0}};
    const cm_quaternion step = {{0.8, 0.2, 0.4, 0.4}};
    double low = (double)INFINITY;
    double high = -(double)INFINITY;
    for (int i = 0; i < 8; i++)
    {
        cm_rotation rotation;
        cm_matrix_from_quaternion(&turn, &rotation);
        const double value = cm_task_value(task, mask, &rotation);
        if (isnan(value))
        {
            return 0;
        }
        low = fmin(low, value);
        high = fmax(high, value);
        turn = cm_quaternion_product(&step, &turn);
    }
    *flat = isfinite(high) && high - low <= 1e-9 * (1.0 + fabs(high));
    return 1;
}

static void find_symmetries(cm_orient_task *task)
{
    cm_symmetries all;
    cm_all_symmetries(&all);
    for (unsigned i = 0; i < all.count; i++)
    {
        if (i == 0 || cm_field_is_kept(task, &all.turn[i]))
        {
            task->symmetries.turn[task->symmetries.count++] = all.turn[i];
        }
    }
}

/* The survey, and what the bounds leave of all else. */
static cm_status survey_and_bound(search *s, double *gap)
{
    /* points of edges are few */
    const size_t usual = s->task->measure == CM_ORIENT_EDGES ? 600000 : 100000;
    const size_t most = s->options->boxes_max == 0 ? usual : s->options->boxes_max;
    const double resolution = s->options->resolution == 0.0 ? 0.1 : s->options->resolution;
    const cm_orient_survey_progress progress = {s->options->progress, s->options->user,
                                                SURVEY_PART};
    cm_status status =
        cm_orient_survey_run(s->task, s->mask, resolution * DEGREE, most, &progress, &s->survey);
    if (status == CM_OK)
    {
        const cm_valley *first = &s->survey.valley[0];
        if (first->value < s->best)
        {
            s->best = first->value;
            s->best_turn = first->turn;
        }
        status = run_levels(s, most, gap);
    }
    return status == CM_OK && is_stopped(s, 1.0) ? CM_ERROR_STOPPED : status;
}

static cm_status search_all(cm_orient_task *task, const cm_orient_options *options,
                            const cm_orient_points *mask, cm_orient_result *result)
{
    search s = {.task = task, .options = options, .mask = mask};
    cm_rotation none;
    double gap = 0.0;
    int flat;
    find_symmetries(task);
    s.best_turn = task->symmetries.turn[0];
    cm_matrix_from_quaternion(&s.best_turn, &none);
    s.best = cm_task_value(task, mask, &none);
    if (isnan(s.best) || !is_flat(task, mask, &flat))
    {
        return CM_ERROR_MEMORY;
    }
    const double before = s.best;
    cm_status status = flat ? CM_OK : survey_and_bound(&s, &gap);
    if (status == CM_OK)
    {
        status = fill_result(&s, before, gap, result);
        result->radius = status == CM_OK && flat ? 180.0 : result->radius;
    }
    cm_orient_survey_free(&s.survey);
    free(s.boxes.box);
    free(s.bound);
    return status;
}

cm_status cm_orient(const cm_mapping *mapping, const cm_mask *mask,
                    const cm_orient_options *options, cm_orient_result *result)
{
    cm_orient_task task;
    cm_orient_points whole;
    if (result == NULL || result->size != sizeof *result)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = make_task(mapping, mask, options, &task);
    if (status == CM_OK)
    {
        status = make_whole_mask(&task, &whole) ? search_all(&task, options, &whole, result)
                                                : CM_ERROR_MEMORY;
        cm_points_free(&whole);
    }
    cm_edges_free(&task);
    return status;
}
