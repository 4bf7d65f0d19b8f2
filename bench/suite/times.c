/* SPDX-License-Identifier: MIT
 *
 * Times: every repetition runs every way once in each direction, so that what else the machine does falls
 * on all alike; each is run once before, so that its points are in the cache.
 */
#include "suite.h"

#include "../../tests/sphere.h"

#include <stdlib.h>

/* Directions of length 1, faces and coordinates, and directions again, in double and in float. */
typedef struct batch
{
    size_t count;
    double *from[3];
    double *plane[2];
    double *back[3];
    float *from_f32[3];
    float *plane_f32[2];
    float *back_f32[3];
    uint8_t *face;
} batch;

static void batch_make(batch *b, size_t count)
{
    uint64_t state = 7;
    b->count = count;
    for (int k = 0; k < 3; k++)
    {
        b->from[k] = allocate(count, sizeof(double));
        b->back[k] = allocate(count, sizeof(double));
        b->from_f32[k] = allocate(count, sizeof(float));
        b->back_f32[k] = allocate(count, sizeof(float));
    }
    for (int k = 0; k < 2; k++)
    {
        b->plane[k] = allocate(count, sizeof(double));
        b->plane_f32[k] = allocate(count, sizeof(float));
    }
    b->face = allocate(count, 1);
    for (size_t i = 0; i < count; i++)
    {
        double d[3];
        next_direction(&state, d);
        double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++)
        {
            b->from[k][i] = d[k] / size;
            b->from_f32[k][i] = (float)(d[k] / size);
        }
    }
}

static void batch_drop(batch *b)
{
    for (int k = 0; k < 3; k++)
    {
        free(b->from[k]);
        free(b->back[k]);
        free(b->from_f32[k]);
        free(b->back_f32[k]);
    }
    for (int k = 0; k < 2; k++)
    {
        free(b->plane[k]);
        free(b->plane_f32[k]);
    }
    free(b->face);
}

static void run_arrays(const way *w, batch *b, size_t n, int direction)
{
    if (w->precision == PRECISION_FLOAT && direction == FORWARD)
    {
        cm_forward_array_f32(w->mapping, n, b->from_f32[0], b->from_f32[1], b->from_f32[2], b->face,
                             b->plane_f32[0], b->plane_f32[1]);
    }
    else if (w->precision == PRECISION_FLOAT)
    {
        cm_inverse_array_f32(w->mapping, n, b->face, b->plane_f32[0], b->plane_f32[1],
                             b->back_f32[0], b->back_f32[1], b->back_f32[2]);
    }
    else if (direction == FORWARD)
    {
        cm_forward_array(w->mapping, n, b->from[0], b->from[1], b->from[2], b->face, b->plane[0],
                         b->plane[1]);
    }
    else
    {
        cm_inverse_array(w->mapping, n, b->face, b->plane[0], b->plane[1], b->back[0], b->back[1],
                         b->back[2]);
    }
}

static void forward_points(const way *w, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const double direction[3] = {b->from[0][i], b->from[1][i], b->from[2][i]};
        double uv[2];
        b->face[i] = cm_forward(w->mapping, direction, uv);
        b->plane[0][i] = uv[0];
        b->plane[1][i] = uv[1];
    }
}

static void inverse_points(const way *w, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const double uv[2] = {b->plane[0][i], b->plane[1][i]};
        double direction[3];
        cm_inverse(w->mapping, b->face[i], uv, direction);
        b->back[0][i] = direction[0];
        b->back[1][i] = direction[1];
        b->back[2][i] = direction[2];
    }
}

static void forward_points_f32(const way *w, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const float direction[3] = {b->from_f32[0][i], b->from_f32[1][i], b->from_f32[2][i]};
        float uv[2];
        b->face[i] = cm_forward_f32(w->mapping, direction, uv);
        b->plane_f32[0][i] = uv[0];
        b->plane_f32[1][i] = uv[1];
    }
}

static void inverse_points_f32(const way *w, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const float uv[2] = {b->plane_f32[0][i], b->plane_f32[1][i]};
        float direction[3];
        cm_inverse_f32(w->mapping, b->face[i], uv, direction);
        b->back_f32[0][i] = direction[0];
        b->back_f32[1][i] = direction[1];
        b->back_f32[2][i] = direction[2];
    }
}

static void run(const way *w, batch *b, int direction)
{
    static void (*const one_by_one[DIRECTIONS][2])(const way *, batch *) = {
        {forward_points, forward_points_f32}, {inverse_points, inverse_points_f32}};
    if (w->form == FORM_ARRAY)
    {
        run_arrays(w, b, b->count, direction);
        return;
    }
    one_by_one[direction][w->precision == PRECISION_FLOAT](w, b);
}

/* ns a point */
static double time_once(const way *w, batch *b, int direction)
{
    double start = seconds();
    run(w, b, direction);
    return (seconds() - start) * 1e9 / (double)b->count;
}

void measure_times(suite *all, stage part)
{
    batch b;
    batch_make(&b, all->set.points);
    for (size_t r = 0; r < all->set.repetitions; r++)
    {
        for (size_t i = 0; i < all->way_count; i++)
        {
            way *w = &all->ways[i];
            for (int direction = 0; direction < DIRECTIONS; direction++)
            {
                if (r == 0)
                {
                    w->samples[direction] = allocate(all->set.repetitions, sizeof(double));
                }
                run(w, &b, direction);
                w->samples[direction][r] = time_once(w, &b, direction);
            }
        }
        stage_progress(part, r + 1, all->set.repetitions, "times");
    }
    for (size_t i = 0; i < all->way_count; i++)
    {
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            all->ways[i].time[direction] =
                summary(all->ways[i].samples[direction], all->set.repetitions);
        }
    }
    batch_drop(&b);
}

/* ---- Cost against the length of the array ---- */

enum
{
    AT_ONCE = 4096 /* points that are timed together where arrays are shorter */
};

/* 1, 2, 4, ... 64, then 100, 300, 1000, ... */
static size_t next_length(size_t n)
{
    if (n < 64)
    {
        return 2 * n;
    }
    size_t decade = 100;
    while (10 * decade <= n)
    {
        decade *= 10;
    }
    return n < 100 ? 100 : n < 3 * decade ? 3 * decade : 10 * decade;
}

/* The best of some runs over arrays of n. */
static double time_length(const way *w, batch *b, size_t n, int direction)
{
    size_t calls = n < AT_ONCE ? AT_ONCE / n : 1;
    size_t repetitions = n > 1000000 ? 3 : 20;
    double best = (double)INFINITY;
    for (size_t r = 0; r < repetitions; r++)
    {
        double start = seconds();
        for (size_t i = 0; i < calls; i++)
        {
            run_arrays(w, b, n, direction);
        }
        best = fmin(best, (seconds() - start) * 1e9 / (double)(calls * n));
    }
    return best;
}

static void add_lengths(suite *all, const way *w, batch *b)
{
    subject *s = &all->subjects[w->subject];
    for (size_t n = 1; n <= b->count; n = next_length(n))
    {
        length_row *more = realloc(s->lengths, (s->length_count + 1) * sizeof *more);
        if (more == NULL)
        {
            perror(program_name);
            exit(1);
        }
        s->lengths = more;
        length_row *l = &s->lengths[s->length_count++];
        *l = (length_row){.points = n, .precision = w->precision};
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            l->ns[direction] = time_length(w, b, n, direction);
        }
    }
}

void measure_lengths(suite *all, stage part)
{
    batch b;
    if (all->set.largest == 0)
    {
        return;
    }
    batch_make(&b, all->set.largest);
    for (size_t i = 0; i < all->way_count; i++)
    {
        const way *w = &all->ways[i];
        if (w->form == FORM_ARRAY && w->precision != PRECISION_FAST)
        {
            add_lengths(all, w, &b);
        }
        stage_progress(part, i + 1, all->way_count, "cost against length");
    }
    batch_drop(&b);
}
