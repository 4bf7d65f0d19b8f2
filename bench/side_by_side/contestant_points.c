/* SPDX-License-Identifier: MIT
 *
 * Points in the form that a contestant takes. They are those of the tests against other libraries
 * (truth/peers/peer_points.c) and, for this library, those of truth/hard_points.h as well.
 */
#include "side_by_side.h"

#include "truth/hard_points.h"
#include "truth/peers/peers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cm_mapping *cube(void)
{
    static cm_mapping *mapping;
    if (mapping == NULL && cm_mapping_create("gnomonic", NULL, &mapping) != CM_OK)
    {
        exit(1);
    }
    return mapping;
}

static peer_subject subject_of(double unit)
{
    peer_subject subject;
    memset(&subject, 0, sizeof subject);
    subject.unit = unit;
    return subject;
}

/* ---------------------------------------------------------------------------------------- batches */

/* The points in the order of the faces of the frame geo that they are on. */
static void load_by_face(batch *b, const contestant *c, const double *points, size_t count)
{
    peer_subject subject = subject_of(c->unit);
    uint8_t *face = allocate(count, 1);
    size_t next[6] = {0};
    for (size_t i = 0; i < count; i++)
    {
        double direction[3];
        double uv[2];
        peer_direction(&subject, points + 3 * i, direction);
        face[i] = cm_forward(cube(), direction, uv);
        next[face[i]]++;
    }
    b->first[0] = 0;
    for (int k = 0; k < 6; k++)
    {
        b->first[k + 1] = b->first[k] + next[k];
        next[k] = b->first[k];
    }
    for (size_t i = 0; i < count; i++)
    {
        b->face[next[face[i]]] = face[i];
        batch_put(b, next[face[i]]++, points + 3 * i);
    }
    free(face);
}

void batch_load(batch *b, const contestant *c, const double *points, size_t count)
{
    b->count = count;
    memset(b->status[FORWARD], 0, count * sizeof(int));
    memset(b->status[INVERSE], 0, count * sizeof(int));
    if (c->by_face)
    {
        load_by_face(b, c, points, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
    {
        batch_put(b, i, points + 3 * i);
    }
}

/* ----------------------------------------------------------------------------------------- points */

/* Vectors of length 1, but for rounding. */
double *random_points(const contestant *c, size_t count)
{
    peer_subject subject = subject_of(c->unit);
    double *points = peer_random_sphere(&subject, count);
    for (size_t i = 0; i < count && c->unit == 0.0; i++)
    {
        double *d = points + 3 * i;
        double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++)
        {
            d[k] /= length;
        }
    }
    return points;
}

/* Every step-th of some points, as directions if as_directions is not NULL. */
static double *append(double *to, const double *points, size_t count, size_t step,
                      const peer_subject *as_directions)
{
    for (size_t i = 0; i < count; i += step)
    {
        if (as_directions != NULL)
        {
            peer_direction(as_directions, points + 3 * i, to);
        }
        else
        {
            memcpy(to, points + 3 * i, 3 * sizeof to[0]);
        }
        to += 3;
    }
    return to;
}

/* Is it a direction, of a length that the contestant takes? The fast tier of options.h computes in
 * float. */
static int is_taken(const contestant *c, const double d[3])
{
    double length = hypot(d[0], hypot(d[1], d[2]));
    return strcmp(c->tier, "fast") == 0 ? length >= 1e-30 && length <= 1e38 : length > 0.0;
}

/* Those of hard_points.h, of all sizes, of which there are ten times as many. */
static double *append_of_any_size(double *to, const contestant *c, size_t step)
{
    for (uint64_t i = 0; i < HARD_DIRECTIONS; i += 10 * step + 1)
    {
        float single[3];
        hard_direction(i, to);
        if (c->narrow)
        {
            hard_direction_f32(i, single);
            for (int k = 0; k < 3; k++)
            {
                to[k] = (double)single[k];
            }
        }
        to += is_taken(c, to) ? 3 : 0;
    }
    return to;
}

/* Who takes vectors gets the hard ones and those that the hard longitudes and latitudes are. */
double *hard_points(const contestant *c, size_t step, size_t *count)
{
    size_t counts[2];
    peer_subject vectors = subject_of(0.0);
    peer_subject angles = subject_of(c->unit == 0.0 ? 1.0 : c->unit);
    double *of_vectors = peer_hard_sphere(&vectors, &counts[0]);
    double *of_angles = peer_hard_sphere(&angles, &counts[1]);
    size_t room = (counts[0] + counts[1] + HARD_DIRECTIONS / 10) / step + 4;
    double *points = allocate(room, 3 * sizeof points[0]);
    double *end = points;
    if (c->unit == 0.0)
    {
        end = append(end, of_vectors, counts[0], step, NULL);
    }
    end = append(end, of_angles, counts[1], step, c->unit == 0.0 ? &angles : NULL);
    if (c->own && c->unit == 0.0)
    {
        end = append_of_any_size(end, c, step);
    }
    *count = (size_t)(end - points) / 3;
    free(of_vectors);
    free(of_angles);
    return points;
}
