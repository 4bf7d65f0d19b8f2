/* SPDX-License-Identifier: MIT
 *
 * What the files of the statistics share: the pieces that faces are cut into, and values at their points.
 *
 * A piece is one of the eight triangles between a middle line of a face, a diagonal and an edge. Its points
 * are (r, t) in [0, 1]^2: r = 0 is the centre, r = 1 the edge, t = 0 the middle line, t = 1 the diagonal;
 * in the first piece u = r, v = r t, so that du dv = r dr dt. The centre has a value for every t, which is
 * what maps with creases there need.
 */
#ifndef LIBCUBEMAP_MEASURE_PIECES_H
#define LIBCUBEMAP_MEASURE_PIECES_H

#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#define CM_PIECES 48

/* points that are evaluated at once */
#define CM_PIECE_POINTS 128

typedef struct cm_quadrature
{
    const cm_mapping *mapping;
    cm_quantity quantity;
    cm_measure measure;
    unsigned faces;
    double ideal;
    double unit[6]; /* what the quantity is divided by on each face */
} cm_quadrature;

typedef struct cm_piece_points
{
    size_t count; /* CM_PIECE_POINTS at most */
    uint8_t face[CM_PIECE_POINTS];
    double u[CM_PIECE_POINTS];
    double v[CM_PIECE_POINTS];
    double value[CM_PIECE_POINTS];
    double weight[CM_PIECE_POINTS]; /* of the measure, per du dv */
} cm_piece_points;

/* CM_OK, CM_ERROR_ARGUMENT, or CM_ERROR_UNSUPPORTED. options may be NULL. */
cm_status cm_quadrature_make(const cm_mapping *mapping, cm_quantity quantity,
                             const cm_statistics_options *options, cm_quadrature *quadrature);

static inline int cm_quadrature_has(const cm_quadrature *quadrature, int piece)
{
    return (quadrature->faces >> (piece / 8) & 1u) != 0;
}

/* Appends the point of a piece at (r, t). */
static inline void cm_piece_point(cm_piece_points *points, int piece, double r, double t)
{
    size_t i = points->count++;
    double along = piece & 1 ? -r : r;
    double across = piece & 2 ? -(r * t) : r * t;
    points->face[i] = (uint8_t)(piece / 8);
    points->u[i] = piece & 4 ? across : along;
    points->v[i] = piece & 4 ? along : across;
}

/* Fills in value and weight. */
void cm_quadrature_evaluate(const cm_quadrature *quadrature, cm_piece_points *points);

/* Mean, RMSE and their errors into statistics, and how many points that took. */
void cm_quadrature_integrate(const cm_quadrature *quadrature, double tolerance,
                             cm_statistics *statistics);

/* Extremes and where they are. */
void cm_quadrature_search(const cm_quadrature *quadrature, cm_statistics *statistics);

/* Counts one more value. */
void cm_quadrature_extreme(cm_statistics *statistics, double value, uint8_t face, double u,
                           double v);

#endif
