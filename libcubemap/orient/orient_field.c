/* SPDX-License-Identifier: MIT
 *
 * Distortion as a field on the sphere, and the linear pieces that it is never below.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_field.h"

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = 512
};

void cm_field_values(const cm_orient_task *task, size_t n, const double *x, const double *y,
                     const double *z, double *field, double *scale)
{
    cm_distortion_arrays to = {.scale = task->over == CM_OVER_FACE ? scale : NULL};
    switch (task->measure)
    {
    case CM_ORIENT_ISOTROPY:
        to.isotropy = field;
        break;
    case CM_ORIENT_AREA:
        to.area = field;
        break;
    case CM_ORIENT_SCALE:
        to.scale = field;
        break;
    default:
        to.deformation = field;
        break;
    }
    cm_forward_distortion_array(task->mapping, n, x, y, z, &to);
    for (size_t i = 0; i < n; i++)
    {
        if (task->measure == CM_ORIENT_AREA)
        {
            field[i] = fabs(log(field[i]));
        }
        if (task->over != CM_OVER_FACE)
        {
            scale[i] = 1.0;
        }
        else if (task->measure == CM_ORIENT_SCALE)
        {
            scale[i] = field[i];
        }
    }
}

/* ---- Samples ---- */

/* A face's grid of samples with a margin, and for each of its pieces the linear one. */
typedef struct sheet
{
    const cm_orient_task *task;
    double best;
    double reach; /* of the caps in which samples are looked at, as a chord */
    double turn;
    unsigned face;
    unsigned side;
    unsigned margin;
    unsigned wide; /* side + 2 margin */
    float *x;      /* samples, wide * wide of each */
    float *y;
    float *z;
    float *value;
    float *scale;
    cm_orient_piece *piece;
} sheet;

static void sample_row(sheet *s, size_t row)
{
    for (unsigned done = 0; done < s->wide; done += BLOCK)
    {
        const unsigned count = s->wide - done < BLOCK ? s->wide - done : BLOCK;
        double x[BLOCK], y[BLOCK], z[BLOCK], field[BLOCK], scale[BLOCK];
        for (unsigned i = 0; i < count; i++)
        {
            const double first = ((double)row - (double)s->margin + 0.5) * 2.0 / s->side - 1.0;
            const double second =
                ((double)(done + i) - (double)s->margin + 0.5) * 2.0 / s->side - 1.0;
            double d[3];
            cm_table_direction(s->face, first, second, d);
            x[i] = d[0];
            y[i] = d[1];
            z[i] = d[2];
        }
        cm_field_values(s->task, count, x, y, z, field, scale);
        for (unsigned i = 0; i < count; i++)
        {
            const size_t to = row * s->wide + done + i;
            s->x[to] = (float)x[i];
            s->y[to] = (float)y[i];
            s->z[to] = (float)z[i];
            s->value[to] = (float)(scale[i] * (field[i] - s->best));
            s->scale[to] = (float)scale[i];
        }
    }
}

static void sample_rows(size_t begin, size_t end, void *user)
{
    for (size_t row = begin; row < end; row++)
    {
        sample_row(user, row);
    }
}

/* ---- Pieces ---- */

/* The gradient as a tangent vector from the differences to two neighbours; 0 where there is none. */
static void find_gradient(const sheet *s, size_t at, size_t along, size_t across, float g[3])
{
    const float a[3] = {s->x[along] - s->x[at], s->y[along] - s->y[at], s->z[along] - s->z[at]};
    const float b[3] = {s->x[across] - s->x[at], s->y[across] - s->y[at], s->z[across] - s->z[at]};
    const float c[3] = {s->x[at], s->y[at], s->z[at]};
    const float da = s->value[along] - s->value[at];
    const float db = s->value[across] - s->value[at];
    /* g . a = da, g . b = db, g . c = 0, by Cramer's rule */
    const float bc[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                         b[0] * c[1] - b[1] * c[0]};
    const float ca[3] = {c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2],
                         c[0] * a[1] - c[1] * a[0]};
    const float volume = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2];
    for (int i = 0; i < 3; i++)
    {
        g[i] = (da * bc[i] + db * ca[i]) / volume;
        g[i] = isfinite(g[i]) ? g[i] : 0.0f;
    }
}

/* The mean of the gradients to the inner neighbours on both sides, so that edges are not looked across. */
static void mean_gradient(const sheet *s, unsigned row, unsigned column, size_t at, float g[3])
{
    const size_t up = row + 1 < s->side ? at + s->wide : at - s->wide;
    const size_t down = row > 0 ? at - s->wide : at + s->wide;
    const size_t right = column + 1 < s->side ? at + 1 : at - 1;
    const size_t left = column > 0 ? at - 1 : at + 1;
    float first[3], second[3];
    find_gradient(s, at, up, right, first);
    find_gradient(s, at, down, left, second);
    for (int i = 0; i < 3; i++)
    {
        g[i] = 0.5f * (first[i] + second[i]);
    }
}

/* How far the samples within reach are below value + g . (q - c) at most. */
static float find_excess(const sheet *s, size_t at, float value, const float g[3])
{
    const float c[3] = {s->x[at], s->y[at], s->z[at]};
    const float square = (float)(s->reach * s->reach);
    const unsigned margin = s->margin;
    float excess = 0.0f;
    for (unsigned row = 0; row <= 2 * margin; row++)
    {
        const size_t begin = at + (size_t)row * s->wide - (size_t)margin * s->wide - margin;
        for (size_t i = begin; i <= begin + 2 * margin; i++)
        {
            const float x = s->x[i] - c[0];
            const float y = s->y[i] - c[1];
            const float z = s->z[i] - c[2];
            const float over = value + (g[0] * x + g[1] * y + g[2] * z) - s->value[i];
            const int counts = x * x + y * y + z * z <= square && over > excess;
            excess = counts ? over : excess;
        }
    }
    return excess;
}

static void make_piece(const sheet *s, unsigned row, unsigned column)
{
    const size_t at = (size_t)(row + s->margin) * s->wide + column + s->margin;
    float value = s->value[at];
    float g[3];
    mean_gradient(s, row, column, at, g);
    if (!isfinite(value))
    {
        value = g[0] = g[1] = g[2] = 0.0f;
    }
    const float excess = find_excess(s, at, value, g);
    const double length = sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
    const double at_centre = (double)(g[0] * s->x[at] + g[1] * s->y[at] + g[2] * s->z[at]);
    /* the excess grows between samples by less than a fiftieth; floats round to 6e-8 */
    const double base = (double)value - at_centre - 1.02 * (double)excess -
                        0.5 * s->turn * s->turn * length -
                        1e-6 * (fabs((double)value) + length * s->reach);
    s->piece[row * s->side + column] = (cm_orient_piece){(float)base, g[0], g[1], g[2]};
}

static void make_pieces(size_t begin, size_t end, void *user)
{
    const sheet *s = user;
    for (size_t row = begin; row < end; row++)
    {
        for (unsigned column = 0; column < s->side; column++)
        {
            make_piece(s, (unsigned)row, column);
        }
    }
}

/* A turn that keeps the field and puts a face before this one on this one, if there is any: then the pieces
 * are those of that face, turned. */
static int find_model(const cm_symmetries *symmetries, unsigned face, cm_rotation *turn)
{
    for (unsigned i = 1; i < symmetries->count; i++)
    {
        cm_matrix_from_quaternion(&symmetries->turn[i], turn);
        for (unsigned model = 0; model < face; model++)
        {
            const double sign = (model % 2 == 0) == (face % 2 == 0) ? 1.0 : -1.0;
            if (turn->row[face / 2][model / 2] * sign > 0.5)
            {
                return 1;
            }
        }
    }
    return 0;
}

static void copy_face(cm_orient_table *table, unsigned face, const cm_rotation *turn)
{
    const unsigned side = table->side;
    for (unsigned i = face * side * side; i < (face + 1) * side * side; i++)
    {
        double d[3];
        cm_table_middle(side, i, d);
        cm_rotate_back(turn, d, d);
        const cm_orient_piece model = table->piece[cm_table_locate(d, side)];
        double g[3] = {(double)model.x, (double)model.y, (double)model.z};
        cm_rotate(turn, g, g);
        table->piece[i] = (cm_orient_piece){model.base, (float)g[0], (float)g[1], (float)g[2]};
    }
}

int cm_field_table(const cm_orient_task *task, double reach, double turn, double best,
                   cm_orient_table *table, double *least_scale)
{
    /* one more sample all round, for what is between them; a step of a piece is at least half the mean one near a
     * point, and a third of it far beyond an edge */
    const double widened = reach + 2.0 * table->half_diagonal;
    const double shortest = (widened < 0.05 ? 0.5 : 0.35) * 2.0 / table->side;
    sheet s = {.task = task,
               .best = best,
               .reach = widened,
               .turn = turn,
               .side = table->side,
               .margin = (unsigned)ceil(widened / shortest)};
    s.wide = s.side + 2 * s.margin;
    const size_t count = (size_t)s.wide * s.wide;
    s.x = malloc(5 * count * sizeof *s.x);
    *least_scale = task->over == CM_OVER_FACE ? (double)INFINITY : 1.0;
    if (s.x == NULL)
    {
        return 0;
    }
    s.y = s.x + count;
    s.z = s.y + count;
    s.value = s.z + count;
    s.scale = s.value + count;
    for (s.face = 0; s.face < 6; s.face++)
    {
        cm_rotation turn_to_face;
        if (find_model(&task->symmetries, s.face, &turn_to_face))
        {
            copy_face(table, s.face, &turn_to_face);
            continue;
        }
        s.piece = table->piece + (size_t)s.face * s.side * s.side;
        cm_run_threads(task->threads, s.wide, 64, sample_rows, &s);
        cm_run_threads(task->threads, s.side, 64, make_pieces, &s);
        for (size_t i = 0; i < count && task->over == CM_OVER_FACE; i++)
        {
            const double scale = 0.99 * (double)s.scale[i];
            *least_scale = scale < *least_scale ? scale : *least_scale;
        }
    }
    free(s.x);
    return 1;
}

/* ---- Symmetry ---- */

/* At so many directions, spread evenly (Roberts's sequence) and at no border but by chance. */
enum
{
    PROBES = 500
};

static void probe(int i, double d[3])
{
    const double a = (i + 0.5) * 0.7548776662466927;
    const double b = (i + 0.5) * 0.5698402909980532;
    const double z = 2.0 * (a - floor(a)) - 1.0;
    const double lon = 6.283185307179586 * b;
    d[0] = sqrt(1.0 - z * z) * cos(lon);
    d[1] = sqrt(1.0 - z * z) * sin(lon);
    d[2] = z;
}

static int is_distortion_kept(const cm_orient_task *task, const cm_rotation *turn)
{
    int different = 0;
    for (int i = 0; i < PROBES; i++)
    {
        double from[3], to[3], field[2], scale[2];
        probe(i, from);
        cm_rotate(turn, from, to);
        const double x[2] = {from[0], to[0]};
        const double y[2] = {from[1], to[1]};
        const double z[2] = {from[2], to[2]};
        cm_field_values(task, 2, x, y, z, field, scale);
        different += !(fabs(field[0] - field[1]) <= 1e-9 * (1.0 + fabs(field[0])) &&
                       fabs(scale[0] - scale[1]) <= 1e-9 * (1.0 + fabs(scale[0])));
    }
    return different == 0;
}

/* Does the turn put edges on edges? */
static int are_edges_kept(const cm_orient_task *task, const cm_rotation *turn)
{
    for (size_t i = 0; i < 8 * task->arc_count; i++)
    {
        const cm_edge_arc *arc = &task->arc[i / 8];
        const double t = arc->length * ((double)(i % 8) + 0.37) / 8.0;
        double d[3], uv[2];
        for (int k = 0; k < 3; k++)
        {
            d[k] = arc->from[k] * cos(t) + arc->along[k] * sin(t);
        }
        cm_rotate(turn, d, d);
        cm_forward(task->mapping, d, uv);
        if (!(fmax(fabs(uv[0]), fabs(uv[1])) > 1.0 - 1e-5)) /* some are chords */
        {
            return 0;
        }
    }
    return 1;
}

int cm_field_is_kept(const cm_orient_task *task, const cm_quaternion *turn)
{
    cm_rotation rotation;
    cm_matrix_from_quaternion(turn, &rotation);
    return task->measure == CM_ORIENT_EDGES ? are_edges_kept(task, &rotation)
                                            : is_distortion_kept(task, &rotation);
}
