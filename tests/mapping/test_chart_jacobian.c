/* SPDX-License-Identifier: MIT
 *
 * Derivatives of the maps with one face against differences of the kernels in quadruple precision.
 *
 * At random points of the map, some of which are nearer and nearer to its border, where derivatives grow. Points
 * so near to a fold that differences reach across it are left out.
 */
#include "tests/suite.h"

#include "truth/quad.h"

/* the pragma of quad.h, for the suffix of its literals */
#pragma GCC diagnostic ignored "-Wpedantic"

enum
{
    POINTS = 3000
};

typedef struct subject
{
    const char *specification;
    double bound; /* of an element over the largest, in eps */
} subject;

/* What docs/measured/accuracy.md promises; steep is where docs/guide/conventions.md says that rounding of the point itself is more. */
#define STEEP 1e5
static const subject subjects[] = {
    {"azimuthal:lambert", 20.0},
    {"azimuthal:stereographic", 20.0},
    {"azimuthal:breusing", 20.0},
    {"azimuthal:mixture", 20.0},
    {"azimuthal:equidistant", 20.0},
    {"azimuthal:orthographic", 20.0},
    {"azimuthal:gnomonic", 20.0},
    {"azimuthal:lambert:full=1", 64.0},
    {"azimuthal:mixture:beta=0.7,full=1,lon=20,lat=-30", STEEP},
    {"azimuthal:equidistant:fov=220,lon=100,lat=60", 64.0},
    {"border", 20.0},
    {"border:lambert,radial", 64.0},
    {"border:equidistant,elliptical", STEEP},
    {"border:breusing,squircle", STEEP},
    {"border:mixture,conformal", STEEP},
    {"quincuncial", 40.0},
    {"quincuncial:lambert,shirley", 64.0},
    {"quincuncial:equidistant,radial", 64.0},
    {"quincuncial:breusing,squircle", STEEP},
    {"quincuncial:mixture,elliptical", STEEP},
    {"octahedral", 20.0},
    {"octahedral:clarberg", 20.0},
    {"rhealpix", 20.0},
};

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) * 0x1p-53;
}

/* The map's point of number i: some are nearer and nearer to the border of a square, or to a disc's rim. */
static void next_point(int is_disc, int i, uint64_t *state, double uv[2])
{
    double inset = i % 3 == 0 ? pow(10.0, -1.0 - i / 3 % 5) * uniform(state) : uniform(state);
    double along = 2.0 * uniform(state) - 1.0;
    double turn = 3.14159265358979324 * along;
    double across = 1.0 - inset;
    int swap = uniform(state) < 0.5;
    across = uniform(state) < 0.5 ? -across : across;
    uv[0] = is_disc ? across * cos(turn) : swap ? along : across;
    uv[1] = is_disc ? across * sin(turn) : swap ? across : along;
}

typedef void (*function_of)(const quad_mapping *truth, const quad *in, quad *out);

static void forward_of(const quad_mapping *truth, const quad *in, quad *out)
{
    (void)quad_forward(truth, in, out);
}

static void inverse_of(const quad_mapping *truth, const quad *in, quad *out)
{
    quad_inverse(truth, 0, in, out);
}

/* The Jacobian by rows, from quotients with `step` to both sides of each input; 0 if the two do not agree. */
static int differences(const quad_mapping *truth, function_of function, int inputs, int outputs,
                       const quad *at, quad step, quad *jacobian)
{
    quad here[3] = {0};
    function(truth, at, here);
    quad largest = 0.0Q;
    quad jump = 0.0Q;
    for (int k = 0; k < inputs; k++)
    {
        quad in[3] = {at[0], at[1], inputs == 3 ? at[2] : 0.0Q};
        quad above[3] = {0};
        quad below[3] = {0};
        in[k] = at[k] + step;
        function(truth, in, above);
        in[k] = at[k] - step;
        function(truth, in, below);
        for (int m = 0; m < outputs; m++)
        {
            quad centred = (above[m] - below[m]) / (2.0Q * step);
            quad bend = (above[m] - 2.0Q * here[m] + below[m]) / step;
            jacobian[m * inputs + k] = centred;
            largest = fmaxq(largest, fabsq(centred));
            jump = fmaxq(jump, fabsq(bend));
        }
    }
    /* a fold jumps by much of the derivative; a curve by the step over the distance to what is singular */
    return largest > 0.0Q && jump < 1e-6Q * largest;
}

/* The largest difference of two matrices over the largest element. */
static double apart(const double *got, const quad *truth)
{
    quad largest = 0.0Q;
    quad most = 0.0Q;
    for (int k = 0; k < 6; k++)
    {
        largest = fmaxq(largest, fabsq(truth[k]));
        most = isnan(got[k]) ? (quad)INFINITY : fmaxq(most, fabsq((quad)got[k] - truth[k]));
    }
    return (double)(most / largest);
}

static void to_unit(const double d[3], quad unit[3])
{
    quad length = sqrtq((quad)d[0] * d[0] + (quad)d[1] * d[1] + (quad)d[2] * d[2]);
    for (int k = 0; k < 3; k++)
    {
        unit[k] = d[k] / length;
    }
}

/* Both at one point: the worst of each, in eps, is noted. */
static void check_point(const cm_mapping *mapping, const quad_mapping *truth, const double uv[2],
                        double worst[2], int count[2])
{
    const quad step = 1e-14Q;
    quad expected[6];
    double got[6];
    double d[3];
    cm_inverse(mapping, 0, uv, d);
    if (isnan(d[0]))
    {
        return; /* rhealpix has gaps */
    }
    const quad point[3] = {uv[0], uv[1], 0.0Q};
    if (differences(truth, inverse_of, 2, 3, point, step, expected))
    {
        cm_inverse_jacobian(mapping, 0, uv, got);
        worst[1] = fmax(worst[1], apart(got, expected) * 0x1p53);
        count[1]++;
    }
    quad unit[3];
    to_unit(d, unit);
    if (differences(truth, forward_of, 3, 2, unit, step, expected))
    {
        cm_forward_jacobian(mapping, d, got);
        worst[0] = fmax(worst[0], apart(got, expected) * 0x1p53);
        count[0]++;
    }
}

static void check_subject(const subject *s)
{
    cm_mapping *mapping = make_mapping(s->specification, NULL);
    quad_mapping truth = quad_from_text(mapping, s->specification);
    int is_disc = cm_mapping_describe(mapping)->kind == CM_KIND_AZIMUTHAL;
    uint64_t state = 7;
    double worst[2] = {0.0, 0.0};
    int count[2] = {0, 0};
    for (int k = 0; k < POINTS; k++)
    {
        double uv[2];
        next_point(is_disc, k, &state, uv);
        check_point(mapping, &truth, uv, worst, count);
    }
    printf("%-50s forward %8.1f eps of %d, inverse %8.1f eps of %d\n", s->specification, worst[0],
           count[0], worst[1], count[1]);
    cm_mapping_destroy(mapping);
    /* most of the square of rhealpix is gaps */
    int least = strcmp(s->specification, "rhealpix") == 0 ? POINTS / 4 : POINTS - POINTS / 100;
    REQUIRE(count[0] >= least && count[1] >= least, "%s: %d, %d points", s->specification, count[0],
            count[1]);
    REQUIRE(worst[0] <= s->bound && worst[1] <= s->bound, "%s: %g, %g eps", s->specification,
            worst[0], worst[1]);
}

/* One of the catalogue that is not among the subjects is new, and no exception. */
static int is_listed(const char *specification)
{
    for (size_t i = 0; i < sizeof subjects / sizeof subjects[0]; i++)
    {
        if (strcmp(subjects[i].specification, specification) == 0)
        {
            return 1;
        }
    }
    return 0;
}

START_TEST(differences_agree)
{
    for (size_t i = 0; i < sizeof subjects / sizeof subjects[0]; i++)
    {
        check_subject(&subjects[i]);
    }
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        if ((info->kind == CM_KIND_AZIMUTHAL || info->kind == CM_KIND_LAYOUT) &&
            !is_listed(info->identifier))
        {
            const subject fresh = {info->identifier, 20.0};
            check_subject(&fresh);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {differences_agree, NULL};
    return run_suite("chart jacobian", tests);
}
