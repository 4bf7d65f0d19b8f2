/* SPDX-License-Identifier: MIT
 *
 * Measurements in bins of both polar angles, searched in rings around. A surface that is isotropic looks the same when it is
 * turned, and so the nearer of two distances counts: that with one, and that with the other pair of directions above each
 * other. Each measurement holds for light that goes the other way, too.
 */
#include "modules/memory/checked_size.h"
#include "brdf_neighbours.h"
#include "brdf_object.h"

#include <math.h>
#include <stdlib.h>

enum
{
    BINS = 36 /* of a right angle */
};
#define BIN (0.5 * PI / BINS)

/* A neighbourhood reaches so many times as far as the nearest measurement. */
#define REACH 2.0

/* Nearer ones are at the place itself, radians. */
#define SAME 1e-6

typedef struct known
{
    double in, out; /* angles */
    double cosine_in, sine_in, cosine_out, sine_out;
    double cosine, sine; /* of the azimuth, from 0 to half a turn */
    double value;
} known;

struct brdf_neighbours
{
    size_t first[BINS * BINS + 1];
    known *all;
};

static known known_of(double in, double out, double azimuth, double value)
{
    const double cosine = cos(azimuth);
    const known k = {in,   out, cos(in), sin(in), cos(out), sin(out), cosine, fabs(sin(azimuth)),
                     value};
    return k;
}

static int bin_of(double angle)
{
    const int bin = (int)(angle / BIN);
    return bin < BINS ? bin : BINS - 1;
}

brdf_neighbours *brdf_neighbours_create(size_t n, const cm_brdf_sample *sample)
{
    brdf_neighbours *made = n > SIZE_MAX / 4 / sizeof *made->all ? NULL : calloc(1, sizeof *made);
    if (made == NULL)
    {
        return NULL;
    }
    made->all = cm_array_of(n, 2 * sizeof *made->all);
    if (made->all == NULL)
    {
        free(made);
        return NULL;
    }
    for (size_t i = 0; i < n; i++)
    {
        const int in = bin_of(sample[i].theta_in);
        const int out = bin_of(sample[i].theta_out);
        made->first[in * BINS + out + 1]++;
        made->first[out * BINS + in + 1]++;
    }
    for (size_t b = 0; b < BINS * BINS; b++)
    {
        made->first[b + 1] += made->first[b];
    }
    for (size_t i = n; i-- > 0;)
    {
        const cm_brdf_sample *s = sample + i;
        const int in = bin_of(s->theta_in);
        const int out = bin_of(s->theta_out);
        /* Filled from behind, so that beginnings are moved down to where they were. */
        made->all[--made->first[in * BINS + out + 1]] =
            known_of(s->theta_in, s->theta_out, s->azimuth, s->value);
        made->all[--made->first[out * BINS + in + 1]] =
            known_of(s->theta_out, s->theta_in, s->azimuth, s->value);
    }
    /* Now place b + 1 has the beginning of bin b. */
    for (size_t b = 0; b < BINS * BINS; b++)
    {
        made->first[b] = made->first[b + 1];
    }
    made->first[BINS * BINS] = 2 * n;
    return made;
}

void brdf_neighbours_destroy(brdf_neighbours *neighbours)
{
    if (neighbours != NULL)
    {
        free(neighbours->all);
        free(neighbours);
    }
}

static double arc_of(double cosine)
{
    return acos(fmin(1.0, fmax(-1.0, cosine)));
}

/* Eq. 17's sum of angles, of whichever pair is laid above each other; more than limit where it is. */
static double distance_of(const known *a, const known *b, double limit)
{
    const double apart_in = fabs(a->in - b->in);
    const double apart_out = fabs(a->out - b->out);
    if (apart_in + apart_out > limit)
    {
        return INFINITY;
    }
    const double turned = a->cosine * b->cosine + a->sine * b->sine;
    const double in = a->cosine_in * b->cosine_in + a->sine_in * b->sine_in * turned;
    const double out = a->cosine_out * b->cosine_out + a->sine_out * b->sine_out * turned;
    return fmin(apart_in + arc_of(out), apart_out + arc_of(in));
}

/* Sums of a neighbourhood, or what is nearest. */
typedef struct search
{
    const brdf_neighbours *among;
    known at;
    double nearest;
    double limit; /* of distances that count */
    double sum, weight;
    double same;
    size_t same_count;
} search;

static void look_for_nearest(search *s, const known *k)
{
    const double distance = distance_of(&s->at, k, s->nearest);
    s->nearest = distance < s->nearest ? distance : s->nearest;
}

static void add_to_mean(search *s, const known *k)
{
    const double distance = distance_of(&s->at, k, s->limit);
    if (distance < SAME)
    {
        s->same += k->value;
        s->same_count++;
    }
    else if (distance <= s->limit)
    {
        const double square = distance * distance;
        const double weight = 1.0 / (square * square * distance); /* u = 5 */
        s->sum += weight * k->value;
        s->weight += weight;
    }
}

static void visit_bin(search *s, int in, int out, void (*look)(search *, const known *))
{
    if (in < 0 || in >= BINS || out < 0 || out >= BINS)
    {
        return;
    }
    const size_t bin = (size_t)(in * BINS + out);
    for (size_t i = s->among->first[bin]; i < s->among->first[bin + 1]; i++)
    {
        look(s, s->among->all + i);
    }
}

/* All bins of which one angle is so many bins away, and the other no more. */
static void visit_ring(search *s, int ring, void (*look)(search *, const known *))
{
    const int in = bin_of(s->at.in);
    const int out = bin_of(s->at.out);
    for (int k = -ring; k <= ring; k++)
    {
        visit_bin(s, in - ring, out + k, look);
        if (ring > 0)
        {
            visit_bin(s, in + ring, out + k, look);
        }
    }
    for (int k = -ring + 1; k < ring; k++)
    {
        visit_bin(s, in + k, out - ring, look);
        visit_bin(s, in + k, out + ring, look);
    }
}

double brdf_neighbours_mean(const brdf_neighbours *neighbours, double theta_in, double theta_out,
                            double azimuth)
{
    search s = {.among = neighbours,
                .at = known_of(theta_in, theta_out, azimuth, 0.0),
                .nearest = INFINITY};
    for (int ring = 0; ring < BINS && (ring - 1) * BIN <= s.nearest; ring++)
    {
        visit_ring(&s, ring, look_for_nearest);
    }
    s.limit = REACH * s.nearest + SAME;
    for (int ring = 0; ring < BINS && (ring - 1) * BIN <= s.limit; ring++)
    {
        visit_ring(&s, ring, add_to_mean);
    }
    return s.same_count > 0 ? s.same / (double)s.same_count : s.sum / s.weight;
}
