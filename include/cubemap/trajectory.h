/* SPDX-License-Identifier: MIT
 *
 * Trajectories: poses in time, how far one is from another, and what an inertial sensor on one measures. Of the library
 * cubemap-scene.
 *
 *   stamps    seconds, each greater than the one before. Stamps are at most or at least so far apart if their decimals are:
 *             what rounding to double may add to the distance, or take from it, does not count
 *   poses     as pose.h has them; motion between two of them is along a screw, or along a spline (cm_motion)
 *   errors    of an estimate against the truth: ATE, the error of positions after the best rigid motion, and RPE, the error
 *             of motions over an interval
 *   threads   trajectories and motions are constant after their creation
 */
#ifndef CUBEMAP_TRAJECTORY_H
#define CUBEMAP_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/pose.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Poses in time, from cm_trajectory_create to cm_trajectory_destroy. */
typedef struct cm_trajectory cm_trajectory;

/* Of n stamps and poses, one or more, which are copied.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, n 0); CM_ERROR_MEMORY; CM_ERROR_DATA (a stamp that is not finite, or not greater than
 * the one before); CM_ERROR_CAMERA (a pose that cm_pose_check refuses): with these two *wrong is the first index where it
 * is so, if wrong is not NULL. */
CM_API cm_status cm_trajectory_create(size_t n, const double *stamp, const cm_pose *pose,
                                      cm_trajectory **trajectory, size_t *wrong);
CM_API void cm_trajectory_destroy(cm_trajectory *trajectory);

/* How many there are, and the one at an index: either output may be NULL.
 * CM_OK; CM_ERROR_ARGUMENT (trajectory NULL, index not below the count). */
CM_API size_t cm_trajectory_count(const cm_trajectory *trajectory);
CM_API cm_status cm_trajectory_at(const cm_trajectory *trajectory, size_t index, double *stamp,
                                  cm_pose *pose);

/* The index of the stamp nearest to time, of two the earlier one, if it is at most apart seconds away.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_RANGE (none is that near; time or apart is NaN). */
CM_API cm_status cm_trajectory_nearest(const cm_trajectory *trajectory, double time, double apart,
                                       size_t *index);

/* The pose at a time between the first stamp and the last, along the screw between its neighbours; at a stamp the pose
 * there itself. CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_RANGE (another time). */
CM_API cm_status cm_trajectory_interpolate(const cm_trajectory *trajectory, double time,
                                           cm_pose *pose);

/* Pairs of stamps: the closest two first, then the closest two of those left, as long as they are at most apart seconds
 * from each other; of pairs as close the one with the earlier stamp of a, then of b. They are written in a's order, index_a
 * and index_b having room for so many; *count is how many there are, also when there is no room for them: so both may be
 * NULL if room is 0.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_RANGE (apart below 0, or NaN); CM_ERROR_MEMORY; CM_ERROR_SPACE, which sets
 * *count. */
CM_API cm_status cm_trajectory_associate(const cm_trajectory *a, const cm_trajectory *b,
                                         double apart, size_t room, size_t *index_a,
                                         size_t *index_b, size_t *count);

/* ---- Errors ---- */

/* The rigid motion, without scale, that takes n points to others with the least sum of squares, as a pose that
 * cm_pose_apply_back applies (Horn 1987). points are of three numbers. *rank is that of the points' cross covariance:
 * 3; 2, of points in a plane; 1, on a line; 0, in one place. *is_determined is 0 where the motion is not the only one as
 * good: so with ranks 1 and 0, and with mirror images; it is one of them then. Each of the outputs may be NULL.
 * CM_OK; CM_ERROR_ARGUMENT (from or to NULL, n 0); CM_ERROR_RANGE (a number that is not finite, or beyond 1e100). */
CM_API cm_status cm_pose_align(size_t n, const double *from, const double *to, cm_pose *motion,
                               int *rank, int *is_determined);

/* To be filled with zeros but for size and what is wanted. */
typedef struct cm_evaluation_options
{
    size_t size;     /* sizeof(cm_evaluation_options) */
    double apart;    /* seconds, the most between stamps of a pair; 0: 0.02 */
    double interval; /* seconds, the least between the pairs of RPE; 0: 1 */
} cm_evaluation_options;

/* How far an estimate is from the truth. size is to be set before the call. */
typedef struct cm_evaluation
{
    size_t size;                      /* sizeof(cm_evaluation) */
    size_t pairs;                     /* stamps that were associated */
    size_t motions;                   /* pairs of these that RPE is made of */
    double ate_rmse;                  /* of positions, in their unit */
    double rpe_translation_rmse;      /* in the same; NaN if there are no motions */
    double rpe_rotation_rmse_degrees; /* NaN if there are no motions */
    cm_pose alignment;                /* takes the estimate's positions to the truth's */
    int rank;                         /* of the alignment, as cm_pose_align */
    int is_determined;                /* 0: the alignment is rank-deficient */
} cm_evaluation;

/* Associate, and measure ATE and RPE: for each pair i the first pair j at least an interval later by the truth's stamps,
 * E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with Q the truth, P the estimate, camera to world; the root mean squares of its
 * translation's length and of its angle. options may be NULL.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE (options below 0 or not finite, positions beyond 1e100);
 * CM_ERROR_RANK (no pair); CM_ERROR_MEMORY. */
CM_API cm_status cm_trajectory_evaluate(const cm_trajectory *truth, const cm_trajectory *estimate,
                                        const cm_evaluation_options *options,
                                        cm_evaluation *evaluation);

/* ---- Motion ---- */

/* A trajectory as a curve with continuous acceleration, from cm_motion_create to cm_motion_destroy: through all poses,
 * cubic splines of the position and of the quaternion's components, which are normalised after. The ends are not knots
 * (de Boor 1978, chapter IV); with three poses or fewer the second derivative is 0 there. */
typedef struct cm_motion cm_motion;

/* CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_MEMORY. */
CM_API cm_status cm_motion_create(const cm_trajectory *trajectory, cm_motion **motion);
CM_API void cm_motion_destroy(cm_motion *motion);

/* Where something is and how it moves. size is to be set before the call. */
typedef struct cm_motion_state
{
    size_t size;            /* sizeof(cm_motion_state) */
    cm_pose pose;           /* at that time */
    double velocity[3];     /* in the world's axes, per second */
    double acceleration[3]; /* in the world's axes, per second squared */
    double rate[3];         /* angular velocity in the camera's axes, radians per second */
} cm_motion_state;

/* At a time between the first stamp and the last.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE (another time); CM_ERROR_CAMERA (the curve has no rotation there:
 * between poses that are turned by nearly 180 degrees). */
CM_API cm_status cm_motion_at(const cm_motion *motion, double time, cm_motion_state *state);

/* Noise of a sensor of three axes, in its unit: metres per second squared or radians per second. */
typedef struct cm_inertial_noise
{
    double density; /* of white noise: unit per root of Hz */
    double walk;    /* of the bias: unit per second and root of Hz */
    double bias[3]; /* at the beginning */
} cm_inertial_noise;

/* To be filled with zeros but for size, rate and what is wanted. */
typedef struct cm_inertial_options
{
    size_t size;                     /* sizeof(cm_inertial_options) */
    double rate;                     /* samples a second, greater than 0 */
    double latency;                  /* seconds by which stamps are later than what they are of */
    double gravity[3];               /* in the world's axes: 0, 0, -9.81 where z is up */
    cm_inertial_noise accelerometer; /* metres per second squared */
    cm_inertial_noise gyroscope;     /* radians per second */
    uint64_t seed;                   /* of random.h */
} cm_inertial_options;

/* What an accelerometer and a gyroscope at the camera's centre and in its axes measure: rotation (acceleration - gravity)
 * and the angular velocity, each with bias and noise, from the first stamp on up to the last. Sample k is of the time first
 * stamp + k / rate. Acceleration and angular velocity are three numbers a sample; *count is how many samples there are, also
 * when there is no room for them: so the three may be NULL if room is 0.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE (rate not greater than 0, noise below 0, what is not finite, more
 * than 2^31 samples); CM_ERROR_CAMERA as cm_motion_at; CM_ERROR_SPACE, which sets *count. */
CM_API cm_status cm_motion_inertial(const cm_motion *motion, const cm_inertial_options *options,
                                    size_t room, double *stamp, double *acceleration, double *rate,
                                    size_t *count);

#ifdef __cplusplus
}
#endif

#endif
