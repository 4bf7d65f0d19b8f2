/* SPDX-License-Identifier: MIT
 *
 * How far an estimated trajectory is from the true one: ATE and RPE (Sturm et al. 2012, section IV).
 */
#include <cubemap/trajectory.h>

#include <math.h>
#include <stdlib.h>

#include "trajectory_data.h"

#define DEGREES 57.295779513082320877

/* The poses of the pairs, in the order of time. */
typedef struct paired
{
    size_t count;
    size_t *truth; /* indices */
    size_t *estimate;
    double *from; /* the estimate's positions and the truth's */
    double *to;
} paired;

static void drop(paired *pairs)
{
    free(pairs->truth);
    free(pairs->estimate);
    free(pairs->from);
    free(pairs->to);
}

static cm_status associate(const cm_trajectory *truth, const cm_trajectory *estimate, double apart,
                           paired *pairs)
{
    const size_t most = truth->count < estimate->count ? truth->count : estimate->count;
    *pairs = (paired){.truth = calloc(most, sizeof(size_t)),
                      .estimate = calloc(most, sizeof(size_t)),
                      .from = calloc(most, 3 * sizeof(double)),
                      .to = calloc(most, 3 * sizeof(double))};
    if (pairs->truth == NULL || pairs->estimate == NULL || pairs->from == NULL || pairs->to == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const cm_status status = cm_trajectory_associate(truth, estimate, apart, most, pairs->truth,
                                                     pairs->estimate, &pairs->count);
    for (size_t i = 0; status == CM_OK && i < 3 * pairs->count; i++)
    {
        pairs->from[i] = estimate->pose[pairs->estimate[i / 3]].position[i % 3];
        pairs->to[i] = truth->pose[pairs->truth[i / 3]].position[i % 3];
    }
    return status != CM_OK ? status : pairs->count == 0 ? CM_ERROR_RANK : CM_OK;
}

static double position_error(const paired *pairs, const cm_pose *alignment)
{
    double sum = 0.0;
    for (size_t i = 0; i < pairs->count; i++)
    {
        double moved[3];
        cm_pose_apply_back(alignment, &pairs->from[3 * i], moved);
        for (size_t k = 0; k < 3; k++)
        {
            const double error = moved[k] - pairs->to[3 * i + k];
            sum += error * error;
        }
    }
    return sqrt(sum / (double)pairs->count);
}

/* Of each pair and the first at least an interval later, which is found by going on from the one before's. */
static void motion_errors(const cm_trajectory *truth, const cm_trajectory *estimate,
                          const paired *pairs, double interval, cm_evaluation *made)
{
    double lengths = 0.0;
    double angles = 0.0;
    size_t j = 0;
    for (size_t i = 0; i < pairs->count; i++)
    {
        const double begin = truth->stamp[pairs->truth[i]];
        while (j < pairs->count && !cm_stamps_reach(begin, truth->stamp[pairs->truth[j]], interval))
        {
            j++;
        }
        if (j == pairs->count)
        {
            break;
        }
        cm_pose right;
        cm_pose guess;
        cm_pose error;
        cm_pose_between(&truth->pose[pairs->truth[i]], &truth->pose[pairs->truth[j]], &right);
        cm_pose_between(&estimate->pose[pairs->estimate[i]], &estimate->pose[pairs->estimate[j]],
                        &guess);
        cm_pose_between(&right, &guess, &error);
        const double angle = DEGREES * cm_pose_angle(&error);
        for (int k = 0; k < 3; k++)
        {
            lengths += error.position[k] * error.position[k];
        }
        angles += angle * angle;
        made->motions++;
    }
    made->rpe_translation_rmse = sqrt(lengths / (double)made->motions);
    made->rpe_rotation_rmse_degrees = sqrt(angles / (double)made->motions);
}

static cm_status read_options(const cm_evaluation_options *options, double *apart, double *interval)
{
    *apart = 0.02;
    *interval = 1.0;
    if (options == NULL)
    {
        return CM_OK;
    }
    if (options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double infinity = (double)INFINITY;
    if (!(options->apart >= 0.0 && options->apart < infinity && options->interval >= 0.0 &&
          options->interval < infinity))
    {
        return CM_ERROR_RANGE;
    }
    *apart = options->apart > 0.0 ? options->apart : *apart;
    *interval = options->interval > 0.0 ? options->interval : *interval;
    return CM_OK;
}

cm_status cm_trajectory_evaluate(const cm_trajectory *truth, const cm_trajectory *estimate,
                                 const cm_evaluation_options *options, cm_evaluation *evaluation)
{
    if (truth == NULL || estimate == NULL || evaluation == NULL ||
        evaluation->size != sizeof *evaluation)
    {
        return CM_ERROR_ARGUMENT;
    }
    double apart;
    double interval;
    paired pairs = {.count = 0};
    cm_evaluation made = {.size = sizeof made};
    cm_status status = read_options(options, &apart, &interval);
    if (status == CM_OK)
    {
        status = associate(truth, estimate, apart, &pairs);
    }
    if (status == CM_OK)
    {
        status = cm_pose_align(pairs.count, pairs.from, pairs.to, &made.alignment, &made.rank,
                               &made.is_determined);
    }
    if (status == CM_OK)
    {
        made.pairs = pairs.count;
        made.ate_rmse = position_error(&pairs, &made.alignment);
        motion_errors(truth, estimate, &pairs, interval, &made);
        *evaluation = made;
    }
    drop(&pairs);
    return status;
}
