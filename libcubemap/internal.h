/* SPDX-License-Identifier: MIT
 *
 * What the files of the library share and its users do not see.
 */
#ifndef LIBCUBEMAP_INTERNAL_H
#define LIBCUBEMAP_INTERNAL_H

#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

/* How a frame differs from geo. A point (a, b) of a face of geo is on the face of that number in the
 * frame, at u = sign_u * (swap ? b : a), v = sign_v * (swap ? a : b). */
typedef struct cm_turn
{
    unsigned char face[6];     /* of the frame, by face of geo */
    unsigned char geo_face[6]; /* of geo, by face of the frame */
    unsigned char swap[6];     /* by face of geo, as are the signs */
    signed char sign_u[6];
    signed char sign_v[6];
    int identity; /* nothing changes at all */
} cm_turn;

struct cm_mapping
{
    const cm_mapping_info *info;
    size_t index; /* in the catalogue */
    double parameter[CM_PARAMETERS_MAX];
    cm_frame frame;
    cm_turn turn;
    cm_constants_f64 constants_f64;
    cm_constants_f32 constants_f32;
};

/* The kernels of one mapping in one precision, over arrays of at most CM_BLOCK points. project and
 * unproject go between directions and a face of geo; warp and unwarp work on the face in place and
 * are NULL if project gives (u, v) already. */
#define CM_BLOCK 256

typedef struct cm_kernels_f64
{
    void (*project)(size_t n, const double *x, const double *y, const double *z, double *face,
                    double *a, double *b);
    void (*unproject)(size_t n, const double *face, const double *a, const double *b, double *x,
                      double *y, double *z);
    void (*warp)(size_t n, double *a, double *b, const cm_constants_f64 *constants);
    void (*unwarp)(size_t n, double *a, double *b, const cm_constants_f64 *constants);
} cm_kernels_f64;

typedef struct cm_kernels_f32
{
    void (*project)(size_t n, const float *x, const float *y, const float *z, float *face, float *a,
                    float *b);
    void (*unproject)(size_t n, const float *face, const float *a, const float *b, float *x,
                      float *y, float *z);
    void (*warp)(size_t n, float *a, float *b, const cm_constants_f32 *constants);
    void (*unwarp)(size_t n, float *a, float *b, const cm_constants_f32 *constants);
} cm_kernels_f32;

/* By index in the catalogue. */
extern const cm_kernels_f64 cm_kernel_table_f64[];
extern const cm_kernels_f32 cm_kernel_table_f32[];

/* frame must have passed cm_frame_check. */
void cm_turn_from_frame(const cm_frame *frame, cm_turn *turn);

/* Equality of two ASCII words of given lengths, without upper and lower case. */
int cm_word_equal(const char *a, size_t a_length, const char *b, size_t b_length);

/* Parse and check; on CM_OK index and parameter[] are set, on failure message (if any) says why. */
cm_status cm_specification_parse(const char *specification, size_t *index,
                                 double parameter[CM_PARAMETERS_MAX], char *message,
                                 size_t message_size);

#endif
