/* SPDX-License-Identifier: MIT
 *
 * judge FOLDER POINTS STEP: runs FOLDER's programs on this program's devices at the hard points, every STEP-th
 * direction of them, and at so many random ones. A line for each device and program, apart by tabs:
 *
 *     DEVICE PROGRAM POINTS FACES ELSEWHERE BESIDE ABSOLUTE RELATIVE VECTOR WILD EQUAL
 *
 * eps is 2^-24. FACES are points with another face. ELSEWHERE are points whose face or coordinates are others, by
 * more than 16 eps, but of the same direction, to 16 eps, as a point of an edge that counts to the one side or to the
 * other has them. BESIDE are single results that differ by more than 16 eps, or 64 where they are made of derivatives, but
 * are, as nearly, between those of points at most 4 eps away: on a crease, whose sides have derivatives of their own, and where a
 * derivative is infinite. Neither counts in ABSOLUTE, RELATIVE and VECTOR, the greatest differences in eps. WILD are results
 * that are not finite where they should be; EQUAL is how many points have all results equal, but for the sign of zero.
 *
 * Not compared: what C has not finite; lookup steps of directions that are not of size 2^-40 to 2^40, and all
 * of those directions on devices that may take subnormal numbers for 0; nor on these, where there are no faces, those with
 * a component below 2^-100, which at the antipode of an azimuthal projection decides to which side.
 */
#include "judge.h"

#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EPS 0x1p-24f
#define FAR_IN_EPS 16.0            /* of coordinates */
#define DERIVATIVE_FAR_IN_EPS 64.0 /* of what is made of derivatives */
#define SAME_IN_EPS 16.0

typedef struct program
{
    int number;
    char name[64];
    char classes[RESULT_FLOATS + 1];
} program;

typedef struct verdict
{
    size_t points;
    size_t faces;
    size_t elsewhere;
    size_t beside;
    size_t wild;
    size_t equal;
    double absolute;
    double relative;
    double vector;
    size_t
        worst; /* where what CUBEMAP_EXPLAIN names is greatest: absolute, relative, vector or wild */
} verdict;

static float largest(const float *xyz)
{
    return fmaxf(fabsf(xyz[0]), fmaxf(fabsf(xyz[1]), fabsf(xyz[2])));
}

/* Has a direction a component that is tiny, and may become 0? At the antipode of an azimuthal projection such ones alone
 * decide to which side. */
static int has_tiny(const float *xyz)
{
    int found = 0;
    for (int k = 0; k < 3; k++)
    {
        found = found || (xyz[k] != 0.0f && fabsf(xyz[k]) < 0x1p-100f);
    }
    return found;
}

/* The hard directions and points, then random ones; zeros are positive, as not every language keeps their sign. */
static float *make_points(size_t hard, size_t step, size_t *count)
{
    size_t directions = (HARD_DIRECTIONS + step - 1) / step;
    size_t needed = directions + HARD_POINTS + hard;
    *count = (needed + POINTS_STEP - 1) / POINTS_STEP * POINTS_STEP;
    float *points = calloc(*count * POINT_FLOATS, sizeof *points);
    uint64_t state = 19;
    for (size_t i = 0; points != NULL && i < *count; i++)
    {
        float *at = points + POINT_FLOATS * i;
        hard_direction_f32(i * step, at);
        hard_point_f32(i, at + 5);
        if (i >= directions || largest(at) == 0.0f)
        {
            double direction[3];
            next_direction(&state, direction);
            for (int k = 0; k < 3; k++)
            {
                at[k] = (float)direction[k];
            }
        }
        if (i >= HARD_POINTS)
        {
            at[5] = (float)next_real(&state);
            at[6] = (float)next_real(&state);
        }
        at[4] = (float)(next_bits(&state) % 6);
        for (int k = 0; k < POINT_FLOATS; k++)
        {
            at[k] += 0.0f;
        }
    }
    return points;
}

/* Do two places that the program gives denote one direction? Its slots 4 to 6 are the way back. */
static int is_same_direction(const program *p, const float *a, const float *b)
{
    double direction[2][3];
    for (int k = 0; k < 2; k++)
    {
        const float *place = k == 0 ? a : b;
        int has_face = p->classes[0] == 'F';
        float in[POINT_FLOATS] = {1.0f,
                                  0.0f,
                                  0.0f,
                                  0.0f,
                                  has_face ? place[0] : 0.0f,
                                  has_face ? place[1] : place[0],
                                  has_face ? place[2] : place[1]};
        float out[RESULT_FLOATS];
        reference_programs[p->number](in, out);
        for (int j = 0; j < 3; j++)
        {
            direction[k][j] = (double)out[4 + j];
        }
    }
    return angle_between(direction[0], direction[1]) <= SAME_IN_EPS * (double)EPS;
}

static double difference(float a, float b, double unit)
{
    return fabs((double)a - (double)b) / (unit * (double)EPS);
}

/* Is it between the results that the reference has at the points around this one? */
static int is_beside(const program *p, const float *in, int slot, float got, double tolerance)
{
    float size = largest(in) * 4.0f * EPS;
    float low = INFINITY;
    float high = -INFINITY;
    for (int i = 0; i < 243; i++)
    {
        float moved[POINT_FLOATS] = {0};
        float out[RESULT_FLOATS];
        for (int k = 0, digits = i; k < 5; k++, digits /= 3)
        {
            float step = (float)(digits % 3 - 1);
            moved[k < 3 ? k : k + 2] =
                k < 3 ? in[k] + step * size
                      : fmaxf(-1.0f, fminf(1.0f, in[k + 2] + step * 4.0f * EPS));
        }
        moved[4] = in[4];
        reference_programs[p->number](moved, out);
        low = fminf(low, out[slot]);
        high = fmaxf(high, out[slot]);
    }
    return (double)low - tolerance <= (double)got && (double)got <= (double)high + tolerance;
}

/* The greater of the two is kept, and which point it was if that is to be explained. */
static void note(double *greatest, double d, const char *kind, size_t index, verdict *v)
{
    const char *wanted = getenv("CUBEMAP_EXPLAIN");
    if (d > *greatest)
    {
        *greatest = d;
        v->worst = wanted != NULL && strcmp(wanted, kind) == 0 ? index : v->worst;
    }
}

/* How a result is compared: a v stands for itself and the two behind it. */
static char class_of(const program *p, int slot)
{
    for (int k = slot; k >= 0 && k >= slot - 2; k--)
    {
        if (p->classes[k] == 'v')
        {
            return 'v';
        }
    }
    return p->classes[slot];
}

/* What a difference is measured in, beside eps. */
static double unit_of(const program *p, int slot, const float *want, double size)
{
    switch (class_of(p, slot))
    {
    case 'r':
        return fmax(fabs((double)want[slot]), 0x1p-12);
    case 'q':
        return fabs((double)want[slot]) * fmax(1.0, fabs((double)want[slot]));
    case 'v':
    {
        int first = slot;
        while (p->classes[first] != 'v')
        {
            first--;
        }
        /* not relative to what is left where the step goes along the direction */
        return fmax((double)largest(want + first), 0.5 * sqrt((double)want[3]) / size);
    }
    default:
        return fmax(1.0, fabs((double)want[slot])); /* outside a field of view coordinates grow */
    }
}

static void judge_point(const program *p, int all_floats, size_t index, const float *in,
                        const float *want, const float *got, verdict *v)
{
    float size = largest(in);
    int is_measured = size >= 0x1p-40f && size <= 0x1p40f;
    if (!all_floats && (!is_measured || (p->classes[0] != 'F' && has_tiny(in))))
    {
        return;
    }
    v->points++;
    int is_equal = 1;
    int has_moved = 0;
    for (int k = 0; k < 3; k++)
    {
        has_moved = has_moved || difference(want[k], got[k], unit_of(p, k, want, 1.0)) > FAR_IN_EPS;
    }
    int is_elsewhere = has_moved && p->classes[2] == 'a' && strcmp(p->name, "latitude") != 0 &&
                       is_same_direction(p, want, got);
    v->elsewhere += (size_t)is_elsewhere;
    for (int k = 0; k < RESULT_FLOATS; k++)
    {
        char class = class_of(p, k);
        /* what C calls outside, by a NaN, a shader may not */
        if (class == '-' || (class == 'v' && !is_measured) || want[k] == got[k] ||
            !isfinite(want[k]))
        {
            continue;
        }
        is_equal = 0;
        if (is_elsewhere && (k < 4 || k >= 8))
        {
            continue;
        }
        double unit = unit_of(p, k, want, (double)size);
        double d = difference(want[k], got[k], unit);
        double far = class == 'a' ? FAR_IN_EPS : DERIVATIVE_FAR_IN_EPS;
        if (class == 'F')
        {
            v->faces++;
        }
        else if (!isfinite(got[k]))
        {
            double none = 0.0;
            v->wild++;
            note(&none, 1.0, "wild", index, v);
        }
        else if (d > far && is_beside(p, in, k, got[k], far * unit * (double)EPS))
        {
            v->beside++;
        }
        else if (class == 'a')
        {
            note(&v->absolute, d, "absolute", index, v);
        }
        else
        {
            note(class == 'v' ? &v->vector : &v->relative, d, class == 'v' ? "vector" : "relative",
                 index, v);
        }
    }
    v->equal += (size_t)is_equal;
}

static void explain(size_t index, const float *in, const float *want, const float *got)
{
    fprintf(stderr, "    point %zu:", index);
    for (int k = 0; k < POINT_FLOATS; k++)
    {
        fprintf(stderr, " %.9g", (double)in[k]);
    }
    for (int k = 0; k < RESULT_FLOATS; k++)
    {
        fprintf(stderr, "%s%.9g %.9g", k % 4 == 0 ? "\n        " : "   ", (double)want[k],
                (double)got[k]);
    }
    fprintf(stderr, "\n");
}

static int judge_program(const program *p, int device, const char *folder, size_t count,
                         const float *points, float *results)
{
    memset(results, 0x7f, count * RESULT_FLOATS * sizeof *results);
    if (!device_run(device, folder, p->number, results))
    {
        printf("%s\t%s\tdoes not run\n", device_name(device), p->name);
        return 0;
    }
    verdict v = {0};
    for (size_t i = 0; i < count; i++)
    {
        float want[RESULT_FLOATS];
        reference_programs[p->number](points + POINT_FLOATS * i, want);
        judge_point(p, device_has_all_floats(device), i, points + POINT_FLOATS * i, want,
                    results + RESULT_FLOATS * i, &v);
    }
    printf("%s\t%s\t%zu\t%zu\t%zu\t%zu\t%.2f\t%.2f\t%.2f\t%zu\t%zu\n", device_name(device), p->name,
           v.points, v.faces, v.elsewhere, v.beside, v.absolute, v.relative, v.vector, v.wild,
           v.equal);
    fflush(stdout);
    if (getenv("CUBEMAP_EXPLAIN") != NULL)
    {
        float want[RESULT_FLOATS];
        reference_programs[p->number](points + POINT_FLOATS * v.worst, want);
        explain(v.worst, points + POINT_FLOATS * v.worst, want, results + RESULT_FLOATS * v.worst);
    }
    return 1;
}

static int read_programs(const char *folder, program *programs, int room)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/list", folder);
    FILE *file = fopen(path, "r");
    int count = 0;
    while (file != NULL && count < room &&
           fscanf(file, "%d %63s %16s", &programs[count].number, programs[count].name,
                  programs[count].classes) == 3)
    {
        count++;
    }
    if (file != NULL)
    {
        fclose(file);
    }
    return count;
}

int main(int argc, char **argv)
{
    static program programs[256];
    int program_count = argc == 4 ? read_programs(argv[1], programs, 256) : 0;
    size_t count = 0;
    float *points = program_count == 0 ? NULL
                                       : make_points(strtoull(argv[2], NULL, 10),
                                                     strtoull(argv[3], NULL, 10), &count);
    float *results = malloc((count + 1) * RESULT_FLOATS * sizeof *results);
    if (points == NULL || results == NULL)
    {
        fprintf(stderr, "usage: judge FOLDER POINTS STEP, FOLDER made by tests/programs\n");
        return 2;
    }
    int is_good = 1;
    for (int device = 0; device_name(device) != NULL; device++)
    {
        if (!device_open(device, count, points))
        {
            is_good = 0;
            continue;
        }
        for (int k = 0; k < program_count; k++)
        {
            is_good =
                judge_program(&programs[k], device, argv[1], count, points, results) && is_good;
        }
        device_close(device);
    }
    free(results);
    free(points);
    return is_good ? 0 : 1;
}
