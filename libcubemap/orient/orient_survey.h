/* SPDX-License-Identifier: MIT
 *
 * The measure at all nodes of a grid, and all its valleys followed downhill (orient_survey.c).
 */
#ifndef LIBCUBEMAP_ORIENT_SURVEY_H
#define LIBCUBEMAP_ORIENT_SURVEY_H

#include "orient_task.h"

/* The measure over few points by tables of the field (of edges: of the mask), quickly. */
typedef struct cm_orient_sketch
{
    const cm_batch_set *set;
    cm_orient_points points;
    cm_orient_table table;
    cm_orient_table more; /* over faces; else no pieces */
    int back;
} cm_orient_sketch;

int cm_sketch_make(const cm_orient_task *task, cm_orient_sketch *sketch); /* 0 without memory */
void cm_sketch_free(cm_orient_sketch *sketch);                            /* and after a 0, too */
double cm_sketch_value(const void *of, const cm_quaternion *at);

typedef struct cm_valley
{
    cm_quaternion turn;
    double sketched; /* the least by the sketch */
    double value;    /* and by the whole mask, of those that were followed by it */
} cm_valley;

/* Valleys whose ends are nearer than this are not told apart when the best other one is sought. */
#define CM_OTHER_VALLEY (5.0 * 0.017453292519943295769)

typedef struct cm_orient_survey
{
    const cm_symmetries *symmetries;
    size_t nodes;
    size_t minima;
    double spacing; /* radians */
    cm_valley *valley;
    size_t valley_count;
    size_t followed; /* by the whole mask, the first ones, by value */
    double error;
    double drop;
    double margin; /* as in cm_orient_result */
} cm_orient_survey;

typedef struct cm_orient_survey_progress
{
    int (*call)(double done, void *user); /* may be NULL */
    void *user;
    double part; /* of the whole that the survey is */
} cm_orient_survey_progress;

static inline int cm_orient_survey_stopped(const cm_orient_survey_progress *progress, double done)
{
    return progress->call != NULL && progress->call(done * progress->part, progress->user) != 0;
}

/* CM_OK, CM_ERROR_MEMORY, CM_ERROR_STOPPED; to be freed after any. */
cm_status cm_orient_survey_run(const cm_orient_task *task, const cm_orient_points *mask,
                               double resolution, size_t boxes_max,
                               const cm_orient_survey_progress *progress, cm_orient_survey *result);
void cm_orient_survey_free(cm_orient_survey *result);

#endif
