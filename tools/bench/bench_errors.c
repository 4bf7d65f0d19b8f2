/* SPDX-License-Identifier: MIT
 *
 * Errors against the truth in quadruple precision: forward's is the angle between the direction and that of
 * which the face, u and v that came out are the map; inverse's that between the direction that came out and
 * the true one. Without gcc's libquadmath there is no truth, and nothing is measured.
 */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef HAVE_QUADMATH
#include "truth/hard_points.h"
#include "truth/quad.h"
#include "truth/sphere.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

typedef struct sums
{
    double worst;
    double square;
    size_t count;
} sums;

static void count_error(sums *s, double metres)
{
    s->worst = isnan(metres) ? (double)INFINITY : fmax(s->worst, metres);
    s->square += metres * metres;
    s->count++;
}

/* The angle between directions of any length, in metres on Earth. */
static double metres_between(const quad a[3], const quad b[3])
{
    quad size_a = fmaxq(fmaxq(fabsq(a[0]), fabsq(a[1])), fabsq(a[2]));
    quad size_b = fmaxq(fmaxq(fabsq(b[0]), fabsq(b[1])), fabsq(b[2]));
    quad square = 0.0Q;
    quad dot = 0.0Q;
    for (int i = 0; i < 3; i++)
    {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        quad cross = (a[j] / size_a) * (b[k] / size_b) - (a[k] / size_a) * (b[j] / size_b);
        square += cross * cross;
        dot += (a[i] / size_a) * (b[i] / size_b);
    }
    return EARTH_RADIUS * (double)atan2q(sqrtq(square), dot);
}

static double forward_error(const way *w, const quad_mapping *truth, const double direction[3])
{
    double uv[2];
    quad given[3];
    quad found[3];
    uint8_t face;
    if (w->precision == PRECISION_FLOAT)
    {
        const float narrow[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
        float uv_f32[2];
        face = cm_forward_f32(w->mapping, narrow, uv_f32);
        uv[0] = (double)uv_f32[0];
        uv[1] = (double)uv_f32[1];
    }
    else
    {
        face = cm_forward(w->mapping, direction, uv);
    }
    if (face > 5)
    {
        return (double)NAN;
    }
    const quad at[2] = {(quad)uv[0], (quad)uv[1]};
    for (int k = 0; k < 3; k++)
    {
        given[k] = (quad)direction[k];
    }
    quad_inverse(truth, face, at, found);
    return metres_between(given, found);
}

/* uv as the precision has it */
static double inverse_error(const way *w, const quad_mapping *truth, uint8_t face,
                            const double uv[2])
{
    quad found[3];
    quad right[3];
    if (w->precision == PRECISION_FLOAT)
    {
        const float narrow[2] = {(float)uv[0], (float)uv[1]};
        float direction[3];
        cm_inverse_f32(w->mapping, face, narrow, direction);
        for (int k = 0; k < 3; k++)
        {
            found[k] = (quad)direction[k];
        }
    }
    else
    {
        double direction[3];
        cm_inverse(w->mapping, face, uv, direction);
        for (int k = 0; k < 3; k++)
        {
            found[k] = (quad)direction[k];
        }
    }
    const quad at[2] = {(quad)uv[0], (quad)uv[1]};
    quad_inverse(truth, face, at, right);
    return metres_between(found, right);
}

/* Numbers as the way takes them; the fast tier has no directions that are none in float. */
static int take_direction(const way *w, uint64_t index, int hard, uint64_t *state, double d[3])
{
    float narrow[3];
    if (!hard)
    {
        next_direction(state, d);
    }
    else if (w->precision == PRECISION_DOUBLE)
    {
        hard_direction(index, d);
    }
    else
    {
        hard_direction_f32(index, narrow);
        for (int k = 0; k < 3; k++)
        {
            d[k] = (double)narrow[k];
        }
    }
    for (int k = 0; k < 3 && w->precision == PRECISION_FLOAT; k++)
    {
        d[k] = (double)(float)d[k];
    }
    double size = fmax(fmax(fabs(d[0]), fabs(d[1])), fabs(d[2]));
    return w->precision == PRECISION_FAST ? size >= 1e-30 && size <= 1e38 : size > 0.0;
}

static void take_point(const way *w, uint64_t index, int hard, uint64_t *state, double uv[2])
{
    float narrow[2];
    for (int k = 0; k < 2; k++)
    {
        uv[k] = next_real(state);
    }
    if (hard && w->precision == PRECISION_DOUBLE)
    {
        hard_point(index, uv);
    }
    else if (hard)
    {
        hard_point_f32(index, narrow);
        uv[0] = (double)narrow[0];
        uv[1] = (double)narrow[1];
    }
    for (int k = 0; k < 2; k++)
    {
        /* those one ulp beyond the edge are taken as the edge */
        uv[k] = fmin(1.0, fmax(-1.0, uv[k]));
        uv[k] = w->precision == PRECISION_FLOAT ? (double)(float)uv[k] : uv[k];
    }
}

/* count of each kind; hard ones evenly spread over all that there are */
static sums sum_errors(const way *w, const quad_mapping *truth, int direction, int hard,
                       size_t count)
{
    sums s = {0.0, 0.0, 0};
    uint64_t state = 23;
    uint64_t total = direction == FORWARD ? HARD_DIRECTIONS : HARD_POINTS;
    for (size_t i = 0; i < count; i++)
    {
        double numbers[3];
        uint64_t index = (uint64_t)i * total / count;
        if (direction == FORWARD && take_direction(w, index, hard, &state, numbers))
        {
            count_error(&s, forward_error(w, truth, numbers));
        }
        else if (direction == INVERSE)
        {
            take_point(w, index, hard, &state, numbers);
            count_error(&s, inverse_error(w, truth, (uint8_t)(i % 6), numbers));
        }
    }
    return s;
}

static void measure_way(const suite *all, way *w)
{
    quad_mapping truth = quad_from(w->mapping);
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        if (w->offered[direction])
        {
            sums random = sum_errors(w, &truth, direction, 0, all->set.random);
            sums hard = sum_errors(w, &truth, direction, 1, all->set.hard);
            w->error[direction] = (errors){random.worst, sqrt(random.square / (double)random.count),
                                           hard.worst, sqrt(hard.square / (double)hard.count)};
        }
    }
}

/* Errors at the middles of so many by so many cells of the first face, in double. */
static void measure_map(const suite *all, const way *w, subject *s)
{
    size_t pixels = all->set.map_pixels;
    quad_mapping truth = quad_from(w->mapping);
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        s->error_map[direction] = allocate(pixels * pixels, sizeof(double));
    }
    for (size_t i = 0; i < pixels * pixels; i++)
    {
        const double uv[2] = {(2.0 * (double)(i % pixels) + 1.0) / (double)pixels - 1.0,
                              1.0 - (2.0 * (double)(i / pixels) + 1.0) / (double)pixels};
        double direction[3];
        cm_inverse(w->mapping, 0, uv, direction);
        s->error_map[FORWARD][i] = forward_error(w, &truth, direction);
        s->error_map[INVERSE][i] = inverse_error(w, &truth, 0, uv);
    }
}

/* Forms have the same bits: what one has is the other's. */
static const way *measured_before(const suite *all, size_t index)
{
    const way *w = &all->ways[index];
    for (size_t i = 0; i < index; i++)
    {
        if (all->ways[i].subject == w->subject && all->ways[i].precision == w->precision)
        {
            return &all->ways[i];
        }
    }
    return NULL;
}

void measure_errors(suite *all, stage part)
{
    for (size_t i = 0; i < all->way_count; i++)
    {
        way *w = &all->ways[i];
        subject *s = &all->subjects[w->subject];
        const way *before = measured_before(all, i);
        if (before != NULL)
        {
            memcpy(w->error, before->error, sizeof w->error);
        }
        else
        {
            measure_way(all, w);
        }
        if (all->set.map_pixels > 0 && w->precision == PRECISION_DOUBLE &&
            s->error_map[FORWARD] == NULL)
        {
            measure_map(all, w, s);
        }
        stage_progress(part, i + 1, all->way_count, "errors");
    }
}

#pragma GCC diagnostic pop

#else

void measure_errors(suite *all, stage part)
{
    (void)all;
    stage_progress(part, 1, 1, "errors");
}

#endif
