/* SPDX-License-Identifier: MIT
 *
 * The pixels of a disc on the sphere, as runs of numbers that follow each other.
 */
#ifndef CUBEMAP_PYTHON_DISC_H
#define CUBEMAP_PYTHON_DISC_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/healpix.h>

struct disc_run
{
    int64_t first;
    int64_t count;
};

/* Runs in the order of their numbers. To be filled with zeros. */
struct disc_runs
{
    struct disc_run *run;
    size_t run_count;
    size_t run_room;
    size_t pixel_count; /* of all runs */
};

/* Which pixels are meant: those whose centre is in the disc, or those that overlap it, and a few more. */
struct disc
{
    const cm_healpix *healpix; /* in RING */
    double centre[3];          /* a unit vector */
    double radius;
    int64_t
        lines; /* so many to a pixel are looked at, and what is wider is found; 0: centres are meant */
};

/* The runs in RING; 0 without memory. */
int disc_find(const struct disc *disc, struct disc_runs *runs);

/* The runs in NESTED of what is in RING; 0 without memory. */
int disc_find_nested(const struct disc *disc, const struct disc_runs *ring, struct disc_runs *runs);

/* The numbers of all of them, pixel_count. */
void disc_write(const struct disc_runs *runs, int64_t *pixel);

/* Pixels behind those that are there; 0 without memory. */
int disc_add(struct disc_runs *runs, int64_t first, int64_t count);

/* The square of an angle's chord. Everything is within half a turn, whatever rounding says of the antipode. */
double disc_square_of_chord(double angle);

/* From the disc's centre. */
double disc_squared_chord(const struct disc *disc, const double point[3]);

#endif
