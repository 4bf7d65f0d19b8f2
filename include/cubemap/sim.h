/* SPDX-License-Identifier: MIT
 *
 * Time-of-flight cameras, simulated to the electron. Of the library cubemap-sim.
 *
 *   units      SI: metres, seconds, watts, hertz, radians; charges in electrons
 *   distance   along the ray (range), from the phase; depth is along the optical axis
 *   axes       lights are in the camera's axes and move with it; a primitive's motion takes it to its place in the world
 *   pixels     sums of what comes through all of a pixel, with its mask; the lens is a thin one
 *   threads    pictures have the same bits for any number of them
 *   sources    Lambers, Hoberg and Kolb 2015 (chip layout); Bulczak, Lambers and Kolb 2018 (multipath). Electrons are
 *              efficiency times energy times wavelength / (h c): both papers print it upside down
 */
#ifndef CUBEMAP_SIM_H
#define CUBEMAP_SIM_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/brdf.h>
#include <cubemap/budget.h>
#include <cubemap/camera.h>
#include <cubemap/export.h>
#include <cubemap/mapping.h>
#include <cubemap/pool.h>
#include <cubemap/pose.h>
#include <cubemap/status.h>
#include <cubemap/trajectory.h>
#include <cubemap/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Metres a second. */
#define CM_SPEED_OF_LIGHT 299792458.0

/* A world made ready for rays, from cm_tof_scene_create to cm_tof_scene_destroy. */
typedef struct cm_tof_scene cm_tof_scene;

/* Triangles of a mesh, at most: Embree counts their vertices in 32 bits. */
#define CM_TOF_TRIANGLES_MOST 1431655765u

/* Of all primitives of a world, which is not needed after; its meshes, motions and BRDFs are, as long as this lives.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_DATA (a world with nothing in it); CM_ERROR_RANGE (a mesh with coordinates of
 * 1e18 or more, or of more than CM_TOF_TRIANGLES_MOST triangles); CM_ERROR_MEMORY. */
CM_API cm_status cm_tof_scene_create(const cm_scene *scene, cm_tof_scene **made);
CM_API void cm_tof_scene_destroy(cm_tof_scene *scene);

/* How many primitives there are. */
CM_API size_t cm_tof_scene_count(const cm_tof_scene *scene);

/* What measures. To be filled with zeros but for size and what is wanted; what is 0 means nothing of that kind, where
 * nothing else is said. */
typedef struct cm_tof_sensor
{
    size_t size;             /* sizeof(cm_tof_sensor) */
    const cm_camera *camera; /* its picture is the sensor's */
    double pitch;            /* metres, of a pixel, 1e-9 to 1 */
    double f_number;         /* focal length by aperture, 1e-3 to 1e6 */
    double wavelength;       /* metres, 1e-9 to 0.01 */
    double efficiency;       /* electrons a photon, 1e-12 to 1 */
    double exposure;         /* seconds of a phase image, 1e-15 to 1e9 */
    double readout;          /* seconds after each phase image, to 1e9 */
    double pause;            /* seconds after the last of a frame, to 1e9 */
    double frequency;        /* of the modulation, 1e3 to 1e12: waves of 300 km to 0.3 mm */
    double duty;             /* part of the time in which the light shines, 1e-12 to 1 */
    double contrast;         /* of the demodulation, 1e-12 to 1 */
    double full_well;        /* electrons that a readout circuit holds, 1 to 1e30; 0: any number */
    double dark;             /* electrons a second in each readout circuit, to 1e15 */
    double read_noise;       /* electrons, standard deviation of a circuit's reading; to 1e30 */
    int phases;              /* 3 to 64, evenly apart */
    int single_readout;      /* 1: circuits between pixels, each of two (2015, section IV-G) */
    uint32_t mask_columns;   /* sub-pixels of the mask; 0: none */
    uint32_t mask_rows;      /* the same from top to bottom */
    const float *mask; /* the active part of each sub-pixel, 0..1, by rows; NULL: the whole pixel */
    size_t harmonics;  /* of the correlation, to 32, to 16 with a second frequency; 0: a cosine */
    const double *
        harmonic; /* amplitude of cos(j x) for j from 1; 1 is the cosine itself, 1000 the most. Triangle: 1, 0, 1/9.
                     Where contrast times their sum is beyond 1, a circuit that would be below 0 is cut at 0 */
    double
        second_frequency; /* a second series of phase images, as frequency; 0: none. Distances are told to where both
                             repeat together, or to 1000 wraps of the first. The ratio is taken to 1e-9; where that
                             needs more wraps, but both have the decimals of a smaller ratio, that is taken: 1 to 3 of
                             33.33e6 and 100e6; but never 1 to 1 */
    double
        fixed_pattern; /* standard deviation of the pixels' own phase offsets, radians, to 1000; by seed and pixel */
    size_t shot_terms; /* to 32, of a measured polynomial for CM_TOF_FREEMAN_TUKEY; 0: Poisson's */
    const double *
        shot_variance; /* variance of y = sqrt(N) + sqrt(N + 1): factors of the powers of y from 0 */
    double shot_least; /* y from which on it was measured, 1 or more; below, the variance stays */
    double shot_most;  /* the same to which it was, above shot_least and finite */
} cm_tof_sensor;

/* What shines, beside the camera. */
typedef struct cm_tof_light
{
    size_t size;            /* sizeof(cm_tof_light) */
    double position[3];     /* metres, in the camera's axes; what is beyond 1e100 is there */
    double direction[3];    /* of its axis, of any length; 0 0 0: along the optical axis */
    double power;           /* watts, all of the cone, while it shines */
    double aperture;        /* radians, full angle of the cone, from 1e-6; 2 pi shines everywhere */
    size_t n;               /* values of the table; 0: even; all 0: it is dark */
    const float *intensity; /* relative, evenly apart from the axis to the rim, linear between */
} cm_tof_light;

/* Light from all around, not modulated: a picture of six faces or one in a mapping, radiance in W/(m^2 sr) of what the
 * camera's filter lets pass. What is made ready of it a scene keeps for the next frame, by a copy of the picture; another
 * picture, or this one changed, is made ready anew. */
typedef struct cm_tof_environment
{
    size_t size;               /* sizeof(cm_tof_environment) */
    const cm_mapping *mapping; /* in the world's axes */
    uint32_t edge;             /* pixels of a face's side */
    const float *radiance;     /* faces x edge x edge, 0 or more; NULL: constant everywhere */
    double constant;           /* added to it */
} cm_tof_environment;

/* Where shot noise comes from: Poisson's distribution itself; or, as Bulczak, Lambers and Kolb 2018, section 3.4, have it,
 * normal numbers in Freeman and Tukey's space, whose variance is a polynomial of the charge there. Of many electrons N the
 * latter's mean is N + 1/4, and their variance N + 1/2. */
#define CM_TOF_POISSON 0
#define CM_TOF_FREEMAN_TUKEY 1

/* How it is simulated. To be filled with zeros but for size and what is wanted. */
typedef struct cm_tof_options
{
    size_t size;             /* sizeof(cm_tof_options) */
    int bounces;             /* 0: direct light; 1: and once scattered; more: as many, by paths */
    uint32_t lights;         /* virtual lights of one bounce; 0: 338 */
    int visibility;          /* 1: virtual lights cast shadows */
    uint32_t paths;          /* paths a pixel; 0: 64 */
    int traces;              /* 1: paths for one bounce, too */
    uint32_t sample_columns; /* of a pixel; 0: 1 */
    uint32_t sample_rows;    /* of a pixel, from top to bottom; 0: 1 */
    uint32_t sample_times;   /* of an exposure; 0: as many as what moves needs, 16 at most */
    int full;                /* 1: all samples in all pixels; 0: only where a pixel sees edges */
    int noise;     /* 1: shot noise, and the sensor's dark, read and fixed pattern noise */
    uint64_t seed; /* of all random numbers */
    uint32_t view; /* number of the frame, for the noise */
    const cm_mapping *mapping; /* of the map in which virtual lights are found, and of their
                                  shadows; NULL: the equal-area cube healpix, and algebraic */
    uint32_t map_edge;         /* its cells along a face's side; 0: 64 */
    const cm_tof_environment *environment; /* NULL: none */
    int shot;                              /* of the noise: CM_TOF_POISSON, CM_TOF_FREEMAN_TUKEY */
} cm_tof_options;

/* Of a pixel of a result. */
#define CM_TOF_SATURATED 1u  /* a circuit was full, or has more than a float: it is cut there */
#define CM_TOF_NOTHING 2u    /* no modulated light came */
#define CM_TOF_FLYING 4u     /* surfaces apart from each other share the pixel */
#define CM_TOF_MOTION 8u     /* phase images saw different surfaces */
#define CM_TOF_MULTIPATH 16u /* scattered light moves the first series by more than 1 mm */

/* What was done for a frame. */
typedef struct cm_tof_report
{
    size_t size;          /* sizeof(cm_tof_report) */
    uint64_t rays;        /* from the camera */
    uint64_t oversampled; /* pixels with all their samples, over all times */
    uint32_t times;       /* steps of an exposure; 1 where nothing moves */
    uint32_t lights;      /* virtual ones */
    uint64_t saturated;   /* pixels that are flagged so */
} cm_tof_report;

/* What came out; arrays that are NULL are left out. All are by rows of the camera's picture. */
typedef struct cm_tof_result
{
    size_t size; /* sizeof(cm_tof_result) */
    float *
        phase; /* series x phases x pixels: N_A - N_B, electrons; two series with a second frequency */
    float *charge_a;  /* the same shape: N_A */
    float *charge_b;  /* N_B */
    float *distance;  /* metres, of the first series or, of two, unwrapped; NaN: nothing came */
    float *amplitude; /* electrons: 2 / phases |sum of phase e^(-i tau)| */
    float *intensity; /* electrons: the mean of N_A + N_B over phases */
    uint8_t *flags;   /* CM_TOF_ words or'ed */
    cm_tof_report *report; /* what was done; NULL: not wanted */
} cm_tof_result;

/* A frame that begins at a time, seen by a camera that the trajectory moves (NULL: it stands at the origin along the world's
 * axes); before its first and after its last stamp the pose stays. A pool of NULL: the calling thread.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size, no lights, a table without values); CM_ERROR_RANGE (numbers outside their range,
 * NaN in tables); CM_ERROR_MEMORY. */
CM_API cm_status cm_tof_simulate(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                                 const cm_tof_light *light, size_t lights,
                                 const cm_trajectory *trajectory, double time,
                                 const cm_tof_options *options, cm_pool *pool,
                                 cm_tof_result *result);

/* Effects that cm_tof_plan measures, in this order. */
#define CM_TOF_EFFECTS 9

/* What a frame needs for an error of distance of at most limit metres: each effect of these is simulated with and without,
 * and the root mean square over the pixels of what it changes is its contribution: oversampling, multipath (one bounce),
 * visibility of virtual lights, further bounces (up to 4), noise, distortion (of the lens), motion within an exposure, bounces
 * beyond those given, sampling of scattered light. Scattered light is measured in a smaller picture.
 * The last is the standard deviation by the paths' random numbers, or the error of virtual lights beside paths with twice
 * what that is uncertain by; its cost is that of the bounces. Half of the limit, and what else is left of it, is for that,
 * and paths (to 4096) or lights (to 5408, else paths) are as many as that needs. What remains counts in budget->error;
 * reason says where it is beyond the limit.
 * most: what is given, NULL: 3 x 3 samples. Its lights, and its paths, are not exceeded where they are not 0; traces 1: paths
 * alone. Its bounces: 0 for as many as are needed, up to 4; 1 or more: not more than these; below 0: direct light alone.
 * What more would do is told and counts in budget->error, its reason is "dropped: limit given"; a limit that is exceeded by
 * that alone is one for the rest. What is not dropped is in *chosen, with lights and paths; what paths have anyway,
 * shadows and the first bounce, is kept with them.
 * budget->entry has room for CM_TOF_EFFECTS; subject, unit (m), cost_unit (ms of the processor) and all else of the budget are
 * set. Choices depend on counted work, not on the clock: they are the same in each run, for any number of threads. A lens
 * without distortion is the caller's to make, if "distortion" is dropped. Shot noise is of most's kind, and that of its
 * environment's light, too; of two frequencies noise is that of their mean, and of wraps that it takes for others.
 * CM_OK and errors as cm_tof_simulate; CM_ERROR_RANGE (limit). */
CM_API cm_status cm_tof_plan(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                             const cm_tof_light *light, size_t lights,
                             const cm_trajectory *trajectory, double time, double limit,
                             const cm_tof_options *most, cm_pool *pool, cm_tof_options *chosen,
                             cm_budget *budget);

/* Seconds from one frame's beginning to the next: phases and series with their readouts, and the pause. */
CM_API double cm_tof_frame_time(const cm_tof_sensor *sensor);

/* Distance, amplitude and intensity of n pixels' charges, as cm_tof_result has them: what a camera's driver does.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE. */
CM_API cm_status cm_tof_reconstruct(const cm_tof_sensor *sensor, size_t n, const float *charge_a,
                                    const float *charge_b, float *distance, float *amplitude,
                                    float *intensity, uint8_t *flags);

/* The standard deviation of the distance by shot noise, metres: signal and ambient electrons a phase image. */
CM_API double cm_tof_noise_of_distance(const cm_tof_sensor *sensor, double signal, double ambient);

/* What is truly there at a time; arrays that are NULL are left out. By rows; NaN and CM_SCENE_NOTHING for nothing. */
typedef struct cm_tof_truth
{
    size_t size;           /* sizeof(cm_tof_truth) */
    double *position[3];   /* in the world */
    float *normal[3];      /* in the world, towards the camera */
    uint32_t *object;      /* id of the primitive */
    uint32_t *shape;       /* its kind */
    uint32_t *triangle;    /* of its mesh; 0 of other kinds */
    float *depth;          /* along the optical axis; range of cameras with a mapping */
    float *range;          /* along the ray */
    float *flow_next[3];   /* pixels, pixels, metres of range: to the time next */
    float *flow_before[3]; /* to the time before */
} cm_tof_truth;

/* CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE (times that are not finite); CM_ERROR_MEMORY. */
CM_API cm_status cm_tof_find_truth(const cm_tof_scene *scene, const cm_camera *camera,
                                   const cm_trajectory *trajectory, double time, double next,
                                   double before, cm_pool *pool, cm_tof_truth *truth);

#ifdef __cplusplus
}
#endif

#endif
