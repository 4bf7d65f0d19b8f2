/* SPDX-License-Identifier: MIT
 *
 * Measured isotropic BRDFs: Bulczak, Lambers and Kolb 2018, section 4.
 */
#include "modules/memory/checked_size.h"
#include "brdf_object.h"
#include "brdf_neighbours.h"

#include <math.h>
#include <stdlib.h>

/* Directions that are drawn from the table; the rest are as Lambert's. */
#define TABLE_PART 0.9

/* Of that many measurements on, the table is as fine as gonioreflectometers' steps of 2 degrees. */
#define MANY_SAMPLES 20000

struct brdf_table
{
    int steps; /* of polar angles, 0 to a right one; twice as many of azimuths, 0 to two right ones */
    double step;  /* radians */
    float *value; /* (steps + 1)^2 (2 steps + 1): in, out, azimuth */
    /* Of each angle out, for whom draws: sums of value times the integral of cosine over the cells before, in and
     * azimuth, by 1 at the end; and the whole, of azimuths of one sign. */
    double *sum;
    double *whole;
};

void brdf_table_destroy(brdf_table *table)
{
    if (table != NULL)
    {
        free(table->value);
        free(table->sum);
        free(table->whole);
        free(table);
    }
}

static size_t place_of(const brdf_table *t, int in, int out, int azimuth)
{
    const size_t side = (size_t)t->steps + 1;
    return ((size_t)in * side + (size_t)out) * (2 * (size_t)t->steps + 1) + (size_t)azimuth;
}

/* ---- Looking up ---- */

typedef struct between
{
    int below;
    double part;
} between;

static between place_between(double angle, double step, int steps)
{
    const double place = angle / step;
    between at = {place < steps - 1 ? (int)place : steps - 1, 0.0};
    at.part = fmin(1.0, place - at.below);
    return at;
}

static double table_value(const brdf_table *t, double in, double out, double azimuth)
{
    const between i = place_between(in, t->step, t->steps);
    const between o = place_between(out, t->step, t->steps);
    const between a = place_between(azimuth, t->step, 2 * t->steps);
    double sum = 0.0;
    for (int corner = 0; corner < 8; corner++)
    {
        const int di = corner & 1;
        const int d_o = corner >> 1 & 1;
        const int da = corner >> 2;
        sum += (di ? i.part : 1.0 - i.part) * (d_o ? o.part : 1.0 - o.part) *
               (da ? a.part : 1.0 - a.part) *
               (double)t->value[place_of(t, i.below + di, o.below + d_o, a.below + da)];
    }
    return sum;
}

/* Azimuth from one direction to the other. */
static double azimuth_of(const brdf_angles *at)
{
    const double sines = sqrt((1.0 - at->in * at->in) * (1.0 - at->out * at->out));
    const double cosine = sines > 0.0 ? (at->between - at->in * at->out) / sines : 1.0;
    return acos(fmin(1.0, fmax(-1.0, cosine)));
}

static double value(const cm_brdf *brdf, const brdf_angles *at)
{
    return table_value(brdf->table, acos(at->in), acos(at->out), azimuth_of(at));
}

/* ---- Drawing ---- */

/* The row of the nearest angle out: any density is right that is the one that was drawn from. */
static int row_of(const brdf_table *t, double cosine_out)
{
    return (int)(acos(cosine_out) / t->step + 0.5);
}

static size_t cells_of(const brdf_table *t)
{
    return 2 * (size_t)t->steps * (size_t)t->steps;
}

/* The integral of cosine over a cell: half of what the squared sine grows by, times the azimuth's step. */
static double cosines_of(const brdf_table *t, int in)
{
    const double low = sin(in * t->step);
    const double high = sin((in + 1) * t->step);
    return 0.5 * (high * high - low * low) * t->step;
}

static double density(const cm_brdf *brdf, const brdf_angles *at)
{
    const brdf_table *t = brdf->table;
    const int row = row_of(t, at->out);
    if (t->whole[row] == 0.0)
    {
        return at->in / PI;
    }
    const int in = place_between(acos(at->in), t->step, t->steps).below;
    const int azimuth = place_between(azimuth_of(at), t->step, 2 * t->steps).below;
    const double *sum = t->sum + (size_t)row * (cells_of(t) + 1);
    const size_t cell = 2 * (size_t)in * (size_t)t->steps + (size_t)azimuth;
    const double of_table = 0.5 * (sum[cell + 1] - sum[cell]) / cosines_of(t, in);
    return at->in * (TABLE_PART * of_table + (1.0 - TABLE_PART) / PI);
}

static void draw(const cm_brdf *brdf, double cosine_out, const double u[3], double in[3])
{
    const brdf_table *t = brdf->table;
    const int row = row_of(t, cosine_out);
    if (u[2] >= TABLE_PART || t->whole[row] == 0.0)
    {
        brdf_draw_cosine(u, in);
        return;
    }
    const double *sum = t->sum + (size_t)row * (cells_of(t) + 1);
    size_t low = 0;
    size_t high = cells_of(t);
    while (high - low > 1)
    {
        const size_t middle = (low + high) / 2;
        if (sum[middle] <= u[0])
        {
            low = middle;
        }
        else
        {
            high = middle;
        }
    }
    /* What is left of both numbers finds the place in the cell, and the side. */
    const double rest = (u[0] - sum[low]) / (sum[low + 1] - sum[low]);
    const int which = (int)(low / (2 * (size_t)t->steps));
    const double sine_low = sin(which * t->step);
    const double sine_high = sin((which + 1) * t->step);
    const double square =
        sine_low * sine_low + rest * (sine_high * sine_high - sine_low * sine_low);
    const double side = u[1] < 0.5 ? 1.0 : -1.0;
    const double part = u[1] < 0.5 ? 2.0 * u[1] : 2.0 * u[1] - 1.0;
    const double azimuth = side * ((double)(low % (2 * (size_t)t->steps)) + part) * t->step;
    in[0] = sqrt(square) * cos(azimuth);
    in[1] = sqrt(square) * sin(azimuth);
    in[2] = sqrt(fmax(0.0, 1.0 - square));
}

static double albedo(const cm_brdf *brdf, double theta)
{
    const brdf_table *t = brdf->table;
    const between at = place_between(theta, t->step, t->steps);
    return 2.0 * ((1.0 - at.part) * t->whole[at.below] + at.part * t->whole[at.below + 1]);
}

static const brdf_kind measured = {value, density, draw, albedo};

/* ---- Making ---- */

static void sum_row(brdf_table *t, int row)
{
    double *sum = t->sum + (size_t)row * (cells_of(t) + 1);
    double whole = 0.0;
    size_t cell = 0;
    sum[0] = 0.0;
    for (int in = 0; in < t->steps; in++)
    {
        const double cosines = cosines_of(t, in);
        for (int azimuth = 0; azimuth < 2 * t->steps; azimuth++)
        {
            whole += cosines *
                     table_value(t, (in + 0.5) * t->step, row * t->step, (azimuth + 0.5) * t->step);
            sum[++cell] = whole;
        }
    }
    t->whole[row] = whole;
    for (size_t i = 0; i <= cell && whole > 0.0; i++)
    {
        sum[i] /= whole;
    }
}

static brdf_table *make_table(int steps)
{
    brdf_table *t = calloc(1, sizeof *t);
    if (t == NULL)
    {
        return NULL;
    }
    const size_t side = (size_t)steps + 1;
    t->steps = steps;
    t->step = 0.5 * PI / steps;
    t->value = cm_array_of(side * side * (2 * (size_t)steps + 1), sizeof *t->value);
    t->sum = cm_array_of(side * (cells_of(t) + 1), sizeof *t->sum);
    t->whole = cm_array_of(side, sizeof *t->whole);
    if (t->value == NULL || t->sum == NULL || t->whole == NULL)
    {
        brdf_table_destroy(t);
        return NULL;
    }
    return t;
}

/* Both ways of light are one (Helmholtz): half of the table is computed. */
static void fill_table(brdf_table *t, const brdf_neighbours *neighbours)
{
    for (int in = 0; in <= t->steps; in++)
    {
        for (int out = 0; out <= in; out++)
        {
            for (int azimuth = 0; azimuth <= 2 * t->steps; azimuth++)
            {
                const float mean = (float)brdf_neighbours_mean(neighbours, in * t->step,
                                                               out * t->step, azimuth * t->step);
                t->value[place_of(t, in, out, azimuth)] = mean;
                t->value[place_of(t, out, in, azimuth)] = mean;
            }
        }
    }
    for (int row = 0; row <= t->steps; row++)
    {
        sum_row(t, row);
    }
}

static int is_right(const cm_brdf_sample *s)
{
    const double most = 0.5 * PI + 1e-9;
    return s->theta_in >= 0.0 && s->theta_in <= most && s->theta_out >= 0.0 &&
           s->theta_out <= most && isfinite(s->azimuth) && s->value >= 0.0 && s->value <= 1e30;
}

cm_status cm_brdf_create_measured(size_t n, const cm_brdf_sample *sample, cm_brdf **brdf)
{
    if (brdf == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    *brdf = NULL;
    if (n == 0 || sample == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < n; i++)
    {
        if (!is_right(sample + i))
        {
            return CM_ERROR_RANGE;
        }
    }
    cm_brdf *made = brdf_make(&measured);
    brdf_neighbours *neighbours = brdf_neighbours_create(n, sample);
    brdf_table *table = make_table(n < MANY_SAMPLES ? 18 : 36);
    cm_status status = CM_ERROR_MEMORY;
    if (made != NULL && neighbours != NULL && table != NULL)
    {
        made->table = table;
        table = NULL;
        fill_table(made->table, neighbours);
        status = CM_OK;
    }
    brdf_table_destroy(table);
    brdf_neighbours_destroy(neighbours);
    if (status != CM_OK)
    {
        cm_brdf_destroy(made);
        return status;
    }
    *brdf = made;
    return CM_OK;
}

void cm_brdf_goniometer(double alpha, double beta, double gamma, cm_brdf_sample *sample)
{
    const double normal[3] = {sin(alpha) * cos(gamma), -sin(gamma), cos(alpha) * cos(gamma)};
    const double detector[3] = {sin(beta), 0.0, cos(beta)};
    const double in = normal[2];
    const double out = normal[0] * detector[0] + normal[2] * detector[2];
    sample->theta_in = acos(fmin(1.0, fmax(-1.0, in)));
    sample->theta_out = acos(fmin(1.0, fmax(-1.0, out)));
    /* Both projected onto the sample's plane: their sine there is the triple product. */
    const double cosine = detector[2] - in * out;
    const double sine = normal[0] * detector[1] - normal[1] * detector[0];
    sample->azimuth = cosine == 0.0 && sine == 0.0 ? 0.0 : fabs(atan2(sine, cosine));
}
