/* SPDX-License-Identifier: MIT
 *
 * The survey of all rotations: the measure at every node of a grid of them, every local minimum of the grid
 * followed downhill, and the valleys that could be the best followed by the whole mask. What it computes at a node
 * or from a node on depends on nothing else, so that threads may share them.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_mask.h"
#include "orient_field.h"
#include "orient_edges.h"
#include "orient_value.h"
#include "orient_survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE 0.017453292519943295769

enum
{
    SIDE = 256,         /* of the sketch's tables: pieces of 0.35 degrees */
    CLUSTERS = 48,      /* along a face: of 1.9 degrees */
    BLOCK = 2048,       /* of nodes or minima, between two calls of progress */
    FINEST = 3,         /* level of boxes: 5.6 degrees, 2.8, 1.4, 0.7 */
    NODES_PER_BOX = 4,  /* as many as may be for each of boxes_max */
    FIRST_FOLLOWED = 3, /* valleys, before it is said how far the sketch is off */
    FOLLOWED_MAX = 24,
    ABOUT = 12, /* steps of a fifth of a pixel */
    BOTTOMS = 8
};

#define DISTINCT (2.0 * DEGREE)    /* ends nearer than this are one */
#define LEAST_STEP (0.05 * DEGREE) /* of a way down */

/* ---- The measure, quickly ---- */

void cm_sketch_free(cm_orient_sketch *sketch)
{
    cm_points_free(&sketch->points);
    cm_table_free(&sketch->table);
    cm_table_free(&sketch->more);
}

int cm_sketch_make(const cm_orient_task *task, cm_orient_sketch *sketch)
{
    const int edges = task->measure == CM_ORIENT_EDGES;
    double unused;
    *sketch = (cm_orient_sketch){.set = task->mapping->set, .back = edges};
    const int made = (edges ? cm_edge_points(task->mapping, 0.4 * DEGREE, &sketch->points, &unused)
                            : cm_mask_points(task, CLUSTERS, &sketch->points)) &&
                     cm_table_make(&sketch->table, SIDE);
    if (!made)
    {
        return 0;
    }
    if (edges)
    {
        cm_plain_table(task, &sketch->table);
        return 1;
    }
    /* no reach beyond the piece's middle: the linear piece itself */
    const double reach = -2.0 * sketch->table.half_diagonal;
    return cm_field_table(task, reach, 0.0, 0.0, &sketch->table, &unused) &&
           (task->over != CM_OVER_FACE ||
            (cm_table_make(&sketch->more, SIDE) &&
             cm_field_table(task, reach, 0.0, -1.0, &sketch->more, &unused)));
}

double cm_sketch_value(const void *of, const cm_quaternion *at)
{
    const cm_orient_sketch *sketch = of;
    const double sum =
        cm_orient_sum(sketch->set, &sketch->points, &sketch->table, sketch->back, at);
    if (sketch->more.piece == NULL)
    {
        return sum;
    }
    /* the weights times the scale, which the table for a best of -1 has more than the other */
    const double more =
        cm_orient_sum(sketch->set, &sketch->points, &sketch->more, sketch->back, at);
    return sum / (more - sum);
}

/* ---- Grid ---- */

typedef struct survey
{
    const cm_orient_task *task;
    const cm_orient_sketch *sketch;
    const cm_orient_survey_progress *progress;
    cm_boxes nodes;
    double spacing; /* of the farthest neighbours along an axis, radians */
    float *value;   /* of each node */
    char *is_least;
    cm_valley *end; /* of the way down from each local minimum */
    size_t begin;   /* of the block that threads work at */
} survey;

static void value_nodes(size_t begin, size_t end, void *user)
{
    survey *s = user;
    for (size_t i = s->begin + begin; i < s->begin + end; i++)
    {
        cm_box_shape shape;
        cm_box_find_shape(&s->nodes.box[i], &shape);
        s->value[i] = (float)cm_sketch_value(s->sketch, &shape.centre);
    }
}

/* Is no neighbour of the node less? They are the nodes of the boxes about its own, or across a border of what is not
 * spare of those that are alike. Of equal nodes the first is less, so that from every node a way down from neighbour to
 * neighbour ends at one that is least. */
static int is_least(const survey *s, size_t node)
{
    cm_box_shape shape;
    cm_box_find_shape(&s->nodes.box[node], &shape);
    for (int k = 0; k < 27; k++)
    {
        const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        const cm_quaternion there = cm_box_neighbour(&s->nodes.box[node], step);
        const size_t other = cm_boxes_find(&s->nodes, &there, &s->task->symmetries);
        if (other == s->nodes.count || other == node ||
            !(s->value[other] < s->value[node] ||
              (s->value[other] == s->value[node] && other < node)))
        {
            continue;
        }
        cm_box_shape near;
        cm_box_find_shape(&s->nodes.box[other], &near);
        /* across a border the box may be of one that is farther than a neighbour */
        if (cm_rotations_apart(&near.centre, &shape.centre, &s->task->symmetries) <=
            1.8 * s->spacing)
        {
            return 0;
        }
    }
    return 1;
}

static void mark_least(size_t begin, size_t end, void *user)
{
    survey *s = user;
    for (size_t i = s->begin + begin; i < s->begin + end; i++)
    {
        s->is_least[i] = (char)is_least(s, i);
    }
}

static void follow_ends(size_t begin, size_t end, void *user)
{
    survey *s = user;
    for (size_t i = s->begin + begin; i < s->begin + end; i++)
    {
        s->end[i].sketched =
            cm_descend(cm_sketch_value, s->sketch, 0.5 * s->spacing, LEAST_STEP, &s->end[i].turn);
    }
}

/* A job for all of count, with part of the progress from one number to another. */
static cm_status run_blocks(survey *s, cm_job job, size_t count, double from, double to)
{
    for (s->begin = 0; s->begin < count; s->begin += BLOCK)
    {
        const size_t left = count - s->begin;
        const size_t block = left < BLOCK ? left : BLOCK;
        cm_run_threads(s->task->threads, block, 64, job, s);
        const double part = (double)(s->begin + block) / (double)count;
        if (cm_orient_survey_stopped(s->progress, from + (to - from) * part))
        {
            return CM_ERROR_STOPPED;
        }
    }
    return CM_OK;
}

static int make_nodes(survey *s, size_t boxes_max)
{
    const size_t most = boxes_max > SIZE_MAX / NODES_PER_BOX ? SIZE_MAX : boxes_max * NODES_PER_BOX;
    int made = cm_boxes_make(&s->nodes, &s->task->symmetries);
    for (int level = 1; level <= FINEST && made; level++)
    {
        if (s->nodes.count > most / 8)
        {
            break;
        }
        made = cm_boxes_split(&s->nodes, &s->task->symmetries);
    }
    if (!made)
    {
        return 0;
    }
    cm_boxes_sort(&s->nodes);
    /* tangents of equal angles: boxes are largest in the middle of an axis */
    s->spacing = 3.14159265358979324 / (double)(CM_BOXES_ROOT << s->nodes.box[0].level);
    s->value = malloc(s->nodes.count * sizeof *s->value);
    s->is_least = malloc(s->nodes.count);
    return s->value != NULL && s->is_least != NULL;
}

/* Local minima of the grid, of which there is one at least, as ends that are not followed yet. */
static size_t gather_least(survey *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->nodes.count; i++)
    {
        count += s->is_least[i] != 0;
    }
    s->end = calloc(count, sizeof *s->end);
    size_t next = 0;
    for (size_t i = 0; i < s->nodes.count && s->end != NULL; i++)
    {
        if (s->is_least[i] != 0)
        {
            cm_box_shape shape;
            cm_box_find_shape(&s->nodes.box[i], &shape);
            s->end[next++].turn = shape.centre;
        }
    }
    return count;
}

static int compare_sketched(const void *a, const void *b)
{
    const cm_valley *first = a;
    const cm_valley *second = b;
    if (first->sketched != second->sketched)
    {
        return first->sketched < second->sketched ? -1 : 1;
    }
    return memcmp(&first->turn, &second->turn, sizeof first->turn);
}

/* Sorts ends, and leaves one of each valley. */
static size_t merge_ends(cm_valley *end, size_t count, const cm_symmetries *symmetries)
{
    size_t kept = 0;
    qsort(end, count, sizeof *end, compare_sketched);
    for (size_t i = 0; i < count; i++)
    {
        int known = 0;
        for (size_t k = 0; k < kept && !known; k++)
        {
            known = cm_rotations_apart(&end[i].turn, &end[k].turn, symmetries) < DISTINCT;
        }
        if (!known)
        {
            end[kept++] = end[i];
        }
    }
    return kept;
}

static cm_status survey_grid(survey *s, size_t boxes_max, cm_orient_survey *result)
{
    if (!make_nodes(s, boxes_max))
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = run_blocks(s, value_nodes, s->nodes.count, 0.0, 0.5);
    if (status == CM_OK)
    {
        status = run_blocks(s, mark_least, s->nodes.count, 0.5, 0.55);
    }
    if (status == CM_OK)
    {
        result->minima = gather_least(s);
        status = s->end == NULL ? CM_ERROR_MEMORY
                                : run_blocks(s, follow_ends, result->minima, 0.55, 0.7);
    }
    if (status == CM_OK)
    {
        result->nodes = s->nodes.count;
        result->spacing = s->spacing;
        result->valley_count = merge_ends(s->end, result->minima, &s->task->symmetries);
        result->valley = s->end;
        s->end = NULL;
    }
    return status;
}

/* ---- The whole mask ---- */

typedef struct whole
{
    const cm_orient_task *task;
    const cm_orient_points *mask;
} whole;

static double whole_value(const void *of, const cm_quaternion *at)
{
    const whole *w = of;
    cm_rotation rotation;
    cm_matrix_from_quaternion(at, &rotation);
    return cm_task_value(w->task, w->mask, &rotation);
}

/* How far the sketch is off, and what following valleys by the whole mask has gained, so far. */
typedef struct doubt
{
    double low; /* of the whole mask's value less the sketch's */
    double high;
    double drop;
} doubt;

/* Could one of the valleys from index on be better than the worse of the two best that are known? The sketch is taken to
 * be off by up to twice the range that it has been so far, and a descent to gain up to twice what any did. */
static int could_matter(const cm_orient_survey *r, size_t index, const doubt *d)
{
    double other = (double)INFINITY;
    size_t first = 0;
    for (size_t i = 1; i < index; i++)
    {
        first = r->valley[i].value < r->valley[first].value ? i : first;
    }
    for (size_t i = 0; i < index; i++)
    {
        const int is_other = cm_rotations_apart(&r->valley[i].turn, &r->valley[first].turn,
                                                r->symmetries) >= CM_OTHER_VALLEY;
        other = is_other && r->valley[i].value < other ? r->valley[i].value : other;
    }
    return !(r->valley[index].sketched + d->low - (d->high - d->low) - 2.0 * d->drop > other);
}

/* 0 without memory. */
static int follow_one(const whole *w, double resolution, cm_valley *v, doubt *d)
{
    const double start = whole_value(w, &v->turn);
    const double least = fmin(LEAST_STEP, 0.5 * resolution);
    v->value = cm_descend(whole_value, w, 0.2 * DEGREE, least, &v->turn);
    d->low = fmin(d->low, start - v->sketched);
    d->high = fmax(d->high, start - v->sketched);
    d->drop = fmax(d->drop, start - v->value);
    return !isnan(v->value);
}

static cm_status follow_whole(const whole *w, double resolution,
                              const cm_orient_survey_progress *progress, cm_orient_survey *r)
{
    doubt d = {(double)INFINITY, -(double)INFINITY, 0.0};
    for (size_t i = 0; i < r->valley_count && i < FOLLOWED_MAX; i++)
    {
        if (i >= FIRST_FOLLOWED && !could_matter(r, i, &d))
        {
            break;
        }
        if (!follow_one(w, resolution, &r->valley[i], &d))
        {
            return CM_ERROR_MEMORY;
        }
        r->followed = i + 1;
        if (cm_orient_survey_stopped(progress, 0.7 + 0.3 * (double)(i + 1) / (FOLLOWED_MAX + 1)))
        {
            return CM_ERROR_STOPPED;
        }
    }
    const size_t last = r->followed < r->valley_count ? r->followed : r->valley_count - 1;
    r->margin = r->valley[last].sketched - r->valley[0].sketched;
    r->error = d.high - d.low;
    r->drop = d.drop;
    return CM_OK;
}

static int compare_values(const void *a, const void *b)
{
    const cm_valley *first = a;
    const cm_valley *second = b;
    return first->value < second->value ? -1 : first->value > second->value;
}

/* To a tenth of the resolution at least. */
static cm_status follow_best(const whole *w, double resolution, cm_valley *v)
{
    v->value = cm_descend(whole_value, w, 0.5 * resolution, 0.05 * resolution, &v->turn);
    return isnan(v->value) ? CM_ERROR_MEMORY : CM_OK;
}

/* A valley of edges has many small bottoms, as wide as a pixel, whose sides are creases: there all about is looked at,
 * and followed to a thousandth of the resolution. */
static cm_status follow_edges(const whole *w, double resolution,
                              const cm_orient_survey_progress *progress, cm_orient_survey *r)
{
    const cm_mask *mask = w->task->mask;
    const double pixel = fmin(360.0 / (double)mask->width, 180.0 / (double)mask->height);
    const cm_orient_grid grid = {.step = fmin(fmax(0.2 * pixel, 0.02), 0.2) * DEGREE,
                                 .steps = ABOUT,
                                 .bottoms = BOTTOMS,
                                 .least = 0.001 * resolution};
    for (size_t i = 0; i < r->followed && i < FIRST_FOLLOWED; i++)
    {
        cm_valley *v = &r->valley[i];
        /* nothing is less than no edge over the mask */
        v->value = v->value > 0.0 ? cm_look_about(whole_value, w, w->task->threads, &grid, &v->turn)
                                  : v->value;
        if (isnan(v->value))
        {
            return CM_ERROR_MEMORY;
        }
        const double part = (double)(FOLLOWED_MAX * FIRST_FOLLOWED + i + 1) / FIRST_FOLLOWED;
        if (cm_orient_survey_stopped(progress, 0.7 + 0.3 * part / (FOLLOWED_MAX + 1)))
        {
            return CM_ERROR_STOPPED;
        }
    }
    qsort(r->valley, r->followed, sizeof *r->valley, compare_values);
    return CM_OK;
}

cm_status cm_orient_survey_run(const cm_orient_task *task, const cm_orient_points *mask,
                               double resolution, size_t boxes_max,
                               const cm_orient_survey_progress *progress, cm_orient_survey *result)
{
    cm_orient_sketch sketch;
    survey s = {.task = task, .sketch = &sketch, .progress = progress};
    const whole w = {task, mask};
    *result = (cm_orient_survey){.symmetries = &task->symmetries};
    cm_status status =
        cm_sketch_make(task, &sketch) ? survey_grid(&s, boxes_max, result) : CM_ERROR_MEMORY;
    if (status == CM_OK)
    {
        status = follow_whole(&w, resolution, progress, result);
    }
    if (status == CM_OK)
    {
        qsort(result->valley, result->followed, sizeof *result->valley, compare_values);
        status = task->measure == CM_ORIENT_EDGES ? follow_edges(&w, resolution, progress, result)
                                                  : follow_best(&w, resolution, &result->valley[0]);
    }
    cm_sketch_free(&sketch);
    free(s.nodes.box);
    free(s.value);
    free(s.is_least);
    free(s.end);
    return status;
}

void cm_orient_survey_free(cm_orient_survey *result)
{
    free(result->valley);
    result->valley = NULL;
}
