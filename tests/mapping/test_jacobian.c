/* SPDX-License-Identifier: MIT
 *
 * The derivatives of the kernels, in double and in float, against differences of the kernels in
 * quadruple precision (quad.h), at hard points and at random ones; and what must hold between them:
 * matrices of the two directions are each other's inverses, gradients are orthogonal to the direction,
 * equal-area mappings have determinants that say so, and nothing is NaN.
 *
 * The truth is one-sided: a difference is taken towards the inside of the piece of the map on which the
 * point counts, or on that piece continued beyond its border. The worst errors are printed, in eps:
 * that of a matrix relative to its largest entry, and that of each entry relative to itself: where it
 * is at least 1/100 of the largest, or of a warp away from the edge 1e-9 of it, which is as far as the
 * truth goes.
 */
#include "tests/suite.h"

#include "truth/hard_points.h"
#include "truth/parameter_ends.h"
#include "truth/quad.h"

#include <cubemap/kernels.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* the suffix Q of literals, and conversions of quad */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

enum
{
    ENTRIES_MOST = 6
};

/* eps: with the standard parameters, and with others or of an entry */
#define BOUND_STANDARD 20.0
#define BOUND 64.0

typedef struct precision
{
    const char *name;
    int narrow;
    double eps;
} precision;

static const precision precisions[] = {{"double", 0, 0x1p-53}, {"float", 1, 0x1p-24}};

/* ---- Matrices, as rows of entries ---- */

typedef struct worst
{
    double matrix; /* eps */
    double entry;
    long count;
} worst;

/* The largest entry may be no smaller than this: only smoothstep with c = 1 has none at a corner. */
#define LEAST 1e-9

static void measure(worst *w, int entries, const double *got, const quad *truth, double least,
                    const precision *in)
{
    quad largest = (quad)LEAST;
    for (int i = 0; i < entries; i++)
    {
        largest = fmaxq(largest, fabsq(truth[i]));
    }
    for (int i = 0; i < entries; i++)
    {
        quad error = fabsq((quad)got[i] - truth[i]) / (quad)in->eps;
        error = isnan(got[i]) ? (quad)INFINITY : error;
        w->matrix = fmax(w->matrix, (double)(error / largest));
        if (fabsq(truth[i]) >= (quad)least * largest)
        {
            w->entry = fmax(w->entry, (double)(error / fabsq(truth[i])));
        }
    }
    w->count++;
}

static void report(const char *what, const precision *in, const worst *w)
{
    printf("%-28s %-6s %6ld matrices, worst %8.2f eps of the largest entry, %8.2f of an entry\n",
           what, in->name, w->count, w->matrix, w->entry);
}

/* ---- Differences ---- */

typedef void (*quad_function)(const void *context, const quad *at, quad *value);

enum
{
    LEVELS = 11,
    OUTPUTS_MOST = 3
};

/* The weights of the differences with step, step / 2, ..., from the coarsest on, by which Richardson's extrapolation of so
 * many has a slope: the polynomial through them in the step, at 0 (Lagrange). */
static void find_weights(int levels, quad *weight)
{
    for (int i = 0; i < levels; i++)
    {
        weight[i] = 1.0Q;
        for (int k = 0; k < levels; k++)
        {
            /* the nodes are 2^-i */
            weight[i] *= k == i ? 1.0Q : 1.0Q / (1.0Q - ldexpq(1.0Q, k - i));
        }
    }
}

/* Those of all levels, and of all but the first, for which there is none. */
typedef struct extrapolation
{
    quad weight[LEVELS];
    quad finer[LEVELS];
} extrapolation;

static const extrapolation *extrapolate(void)
{
    static extrapolation made;
    if (made.weight[0] == 0.0Q)
    {
        find_weights(LEVELS - 1, made.finer + 1);
        find_weights(LEVELS, made.weight);
    }
    return &made;
}

/* The derivative along one variable from one side, by Richardson's extrapolation of differences with
 * step, step / 2, ... step / 2^10. */
static void differentiate(quad_function function, const void *context, int variables, int outputs,
                          const quad *at, int variable, quad step, quad *slope)
{
    const extrapolation *by = extrapolate();
    quad here[OUTPUTS_MOST];
    quad there[OUTPUTS_MOST];
    quad finer[OUTPUTS_MOST] = {0.0Q};
    quad moved[3];
    memset(slope, 0, (size_t)outputs * sizeof *slope);
    memcpy(moved, at, (size_t)variables * sizeof *moved);
    function(context, at, here);
    for (int level = 0; level < LEVELS; level++)
    {
        moved[variable] = at[variable] + step;
        function(context, moved, there);
        const quad share = 1.0Q / (moved[variable] - at[variable]);
        for (int k = 0; k < outputs; k++)
        {
            const quad difference = (there[k] - here[k]) * share;
            slope[k] += by->weight[level] * difference;
            finer[k] += by->finer[level] * difference;
        }
        step *= 0.5Q;
    }
    for (int k = 0; k < outputs; k++)
    {
        quad doubt = fabsq(slope[k] - finer[k]);
        REQUIRE(doubt <= 1e-20Q * fmaxq(1.0Q, fabsq(slope[k])), "a difference is uncertain by %g",
                (double)doubt);
    }
}

/* matrix[output][variable], or with by_variable matrix[variable][output] */
static void differentiate_all(quad_function function, const void *context, int variables,
                              int outputs, int by_variable, const quad *at, const quad *steps,
                              quad *matrix)
{
    quad slope[OUTPUTS_MOST];
    for (int i = 0; i < variables; i++)
    {
        differentiate(function, context, variables, outputs, at, i, steps[i], slope);
        for (int k = 0; k < outputs; k++)
        {
            matrix[by_variable ? i * outputs + k : k * variables + i] = slope[k];
        }
    }
}

/* ---- The kernels under test ---- */

typedef struct warp_kernels
{
    cm_constants_f64 (*prepare)(cm_constants_f64 parameters);
    cm_uv_f64 (*forward_f64)(double p, double q, cm_constants_f64 k);
    cm_pq_f64 (*inverse_f64)(double u, double v, cm_constants_f64 k);
    cm_jacobian_f64 (*jacobian_f64)(double p, double q, double u, double v, cm_constants_f64 k);
    cm_uv_f32 (*forward_f32)(float p, float q, cm_constants_f32 k);
    cm_jacobian_f32 (*jacobian_f32)(float p, float q, float u, float v, cm_constants_f32 k);
} warp_kernels;

/* By index in the catalogue. */
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...) {0},
#define CM_CHART(id, ...) {0},
#define CM_WARP(id, ...)                                                                           \
    {cm_##id##_prepare_f64,  cm_##id##_forward_f64, cm_##id##_inverse_f64,                         \
     cm_##id##_jacobian_f64, cm_##id##_forward_f32, cm_##id##_jacobian_f32},
static const warp_kernels kernel_table[] = {
#include <cubemap/kernel/kernel_catalogue.h>
};
#undef CM_CHART
#undef CM_SPHERE
#undef CM_WARP
#undef CM_DESCRIPTORS

typedef struct subject
{
    const char *specification;
    const warp_kernels *kernels;
    cm_constants_f64 constants;
    cm_constants_f32 narrow; /* those of double, rounded, as in the library */
    quad_mapping truth;
    int creased;  /* on the diagonals; seamless only in its third derivatives */
    int cornered; /* not smooth at the corners */
    int sliced;   /* creased on the axes as well */
    int infinite; /* there */
    int signs;    /* an entry changes its sign inside the face, and is a difference there */
    int legacy;
    int standard;
} subject;

/* Beside the catalogue, its presets and the ends of the ranges of parameters: what a formula treats apart, and ends of
 * several parameters at once. */
static const char *const parameters[] = {"tangent:c=0.5",
                                         "tangent:c=1.1823",
                                         "everitt:c=1",
                                         "algebraic:c=1",
                                         "difference:kappa=0.3,l1=0.125,l2=0.8",
                                         "difference:kappa=1,l1=0.125,l2=0.8",
                                         "difference:kappa=0.3,l1=0.4,l2=0.2",
                                         "corner:c1=-0.5,c2=2,l1=1,l2=1",
                                         "corner:c1=-0.85,c2=8,l1=0.5,l2=3",
                                         "corner:c1=-0.5,c2=8,l1=3,l2=0.5",
                                         "corner:c1=-0.85,c2=2,l1=3,l2=3",
                                         "tanh:c=0.5",
                                         "tanh:c=1.5",
                                         "logistic:c=1",
                                         "smoothstep:c=0.5"};

static subject make_subject(const char *specification)
{
    cm_mapping *mapping = make_mapping(specification, NULL);
    subject s = {.specification = specification};
    const char *identifier = cm_mapping_describe(mapping)->identifier;
    for (size_t i = 0; i < COUNT(kernel_table); i++)
    {
        if (cm_catalogue_at(i) == cm_mapping_describe(mapping))
        {
            s.kernels = &kernel_table[i];
        }
    }
    ck_assert_ptr_nonnull(s.kernels);
    double parameter[CM_PARAMETERS_MAX] = {0.0};
    for (size_t i = 0; i < cm_mapping_describe(mapping)->parameter_count; i++)
    {
        parameter[i] = cm_mapping_parameter(mapping, i);
    }
    s.constants = cm_make_parameters_f64(parameter[0], parameter[1]);
    s.constants.k2 = parameter[2];
    s.constants.k3 = parameter[3];
    s.constants = s.kernels->prepare(s.constants);
    cm_constants_f64 k = s.constants;
    s.narrow = (cm_constants_f32){(float)k.k0, (float)k.k1, (float)k.k2, (float)k.k3,
                                  (float)k.k4, (float)k.k5, (float)k.k6, (float)k.variant};
    s.truth = quad_from(mapping);
    s.sliced = strcmp(identifier, "slice") == 0;
    s.creased = s.sliced || strcmp(identifier, "qsc") == 0 || strcmp(identifier, "seamless") == 0;
    s.infinite = strcmp(identifier, "conformal") == 0;
    s.cornered = s.infinite || s.sliced || strcmp(identifier, "difference") == 0;
    s.signs = s.creased || strstr(identifier, "cobe") != NULL ||
              strcmp(specification, "coupled-cubic:low") == 0;
    s.legacy = strcmp(specification, "cobe:legacy=1") == 0;
    s.standard = strchr(specification, ':') == NULL;
    cm_mapping_destroy(mapping);
    return s;
}

/* The mapping of that index with its standard parameters and with its presets; the number of them. */
static size_t check_catalogued(const cm_mapping_info *info, void (*check)(const subject *s))
{
    size_t checked = 1;
    subject standard = make_subject(info->identifier);
    check(&standard);
    for (const char *preset = info->presets; preset != NULL && *preset != '\0'; checked++)
    {
        char specification[128];
        snprintf(specification, sizeof specification, "%s:%.*s", info->identifier,
                 (int)strcspn(preset, ":"), preset);
        subject s = make_subject(specification);
        check(&s);
        preset += strcspn(preset, " ");
        preset += strspn(preset, " ");
    }
    return checked;
}

/* Those that go by way of the cube; the others have tests of their own. */
static void for_every_subject(void (*check)(const subject *s))
{
    size_t checked = 0;
    for (size_t i = 0; i < COUNT(kernel_table); i++)
    {
        checked +=
            kernel_table[i].prepare != NULL ? check_catalogued(cm_catalogue_at(i), check) : 0;
    }
    const parameter_ends ends = list_parameter_ends();
    for (size_t i = 0; i < COUNT(parameters) + ends.count; i++)
    {
        subject s = make_subject(i < COUNT(parameters) ? parameters[i]
                                                       : ends.specification[i - COUNT(parameters)]);
        check(&s);
    }
    ck_assert_uint_ge(checked, 25);
}

static void take_jacobian(cm_jacobian_f64 j, double got[4])
{
    got[0] = j.u_p;
    got[1] = j.u_q;
    got[2] = j.v_p;
    got[3] = j.v_q;
}

static cm_jacobian_f64 jacobian_at(const subject *s, const double pq[2])
{
    cm_uv_f64 uv = s->kernels->forward_f64(pq[0], pq[1], s->constants);
    return s->kernels->jacobian_f64(pq[0], pq[1], uv.u, uv.v, s->constants);
}

/* In float pq must be floats. */
static void warp_jacobian(const subject *s, const precision *in, const double pq[2], double got[4])
{
    if (!in->narrow)
    {
        take_jacobian(jacobian_at(s, pq), got);
        return;
    }
    float p = (float)pq[0];
    float q = (float)pq[1];
    cm_uv_f32 uv = s->kernels->forward_f32(p, q, s->narrow);
    cm_jacobian_f32 j = s->kernels->jacobian_f32(p, q, uv.u, uv.v, s->narrow);
    take_jacobian((cm_jacobian_f64){(double)j.u_p, (double)j.u_q, (double)j.v_p, (double)j.v_q},
                  got);
}

#define TAKE_TANGENTS(t, got)                                                                      \
    do                                                                                             \
    {                                                                                              \
        (got)[0] = (double)(t).x_a;                                                                \
        (got)[1] = (double)(t).y_a;                                                                \
        (got)[2] = (double)(t).z_a;                                                                \
        (got)[3] = (double)(t).x_b;                                                                \
        (got)[4] = (double)(t).y_b;                                                                \
        (got)[5] = (double)(t).z_b;                                                                \
    } while (0)

#define TAKE_GRADIENTS(g, got)                                                                     \
    do                                                                                             \
    {                                                                                              \
        (got)[0] = (double)(g).a_x;                                                                \
        (got)[1] = (double)(g).a_y;                                                                \
        (got)[2] = (double)(g).a_z;                                                                \
        (got)[3] = (double)(g).b_x;                                                                \
        (got)[4] = (double)(g).b_y;                                                                \
        (got)[5] = (double)(g).b_z;                                                                \
    } while (0)

/* healpix has no parameters */
static const cm_constants_f32 none_f32;
static const cm_constants_f64 none_f64;

/* of cube, or of healpix */
static void tangents_of(int healpix, const precision *in, int face, const double ab[2],
                        double got[6])
{
    if (in->narrow)
    {
        const float a = (float)ab[0];
        const float b = (float)ab[1];
        cm_tangents_f32 t = healpix ? cm_healpix_tangents_f32((float)face, a, b, none_f32)
                                    : cm_cube_tangents_f32((float)face, a, b);
        TAKE_TANGENTS(t, got);
        return;
    }
    cm_tangents_f64 t = healpix ? cm_healpix_tangents_f64((double)face, ab[0], ab[1], none_f64)
                                : cm_cube_tangents_f64((double)face, ab[0], ab[1]);
    TAKE_TANGENTS(t, got);
}

static int gradients_of(int healpix, const precision *in, const double d[3], double got[6])
{
    if (in->narrow)
    {
        float x = (float)d[0];
        float y = (float)d[1];
        float z = (float)d[2];
        cm_gradients_f32 g =
            healpix ? cm_healpix_gradients_f32(x, y, z, none_f32) : cm_cube_gradients_f32(x, y, z);
        TAKE_GRADIENTS(g, got);
        return (int)(healpix ? cm_healpix_project_f32(x, y, z, none_f32)
                             : cm_cube_project_f32(x, y, z))
            .face;
    }
    cm_gradients_f64 g = healpix ? cm_healpix_gradients_f64(d[0], d[1], d[2], none_f64)
                                 : cm_cube_gradients_f64(d[0], d[1], d[2]);
    TAKE_GRADIENTS(g, got);
    return (int)(healpix ? cm_healpix_project_f64(d[0], d[1], d[2], none_f64)
                         : cm_cube_project_f64(d[0], d[1], d[2]))
        .face;
}

/* ---- Points ---- */

/* hard ones, then random ones, each with a part of them near the axes */
static void next_point(const precision *in, long i, uint64_t *state, double ab[2])
{
    if (i % 2 == 0)
    {
        float narrow[2];
        hard_point(next_bits(state), ab);
        hard_point_f32(next_bits(state), narrow);
        for (int k = 0; k < 2; k++)
        {
            ab[k] = fmax(-1.0, fmin(1.0, in->narrow ? (double)narrow[k] : ab[k]));
        }
        return;
    }
    for (int k = 0; k < 2; k++)
    {
        double value = next_real(state);
        value = next_bits(state) % 8 == 0 ? value * value * value * 1e-3 : value;
        ab[k] = in->narrow ? (double)(float)value : value;
    }
}

static void next_vector(const precision *in, long i, uint64_t *state, double d[3])
{
    do
    {
        if (i % 2 == 0)
        {
            float narrow[3];
            hard_direction(next_bits(state), d);
            hard_direction_f32(next_bits(state), narrow);
            for (int k = 0; k < 3; k++)
            {
                d[k] = in->narrow ? (double)narrow[k] : d[k];
            }
        }
        else
        {
            next_direction(state, d);
            for (int k = 0; k < 3; k++)
            {
                d[k] = in->narrow ? (double)(float)d[k] : d[k];
            }
        }
    } while (d[0] == 0.0 && d[1] == 0.0 && d[2] == 0.0);
}

/* ---- Warps ---- */

static void warp_value(const void *context, const quad *at, quad *value)
{
    quad_warp(context, at, value);
}

static void unwarp_value(const void *context, const quad *at, quad *value)
{
    quad_unwarp(context, at, value);
}

/* Steps that stay on one side of a crease, and on the side of the face's middle lines on which the point
 * is: where the two quadratic ones are not analytic; from a corner where the map is not smooth they lead
 * away. The centre of those with creases stands for its side along p. */
static void warp_steps(const subject *s, quad at[2], quad steps[2])
{
    quad sign_a = copysignq(1.0Q, at[0]);
    quad sign_b = copysignq(1.0Q, at[1]);
    if (!s->creased)
    {
        quad from_corner = 1.0Q - fminq(fabsq(at[0]), fabsq(at[1]));
        quad size = s->cornered ? -0.02Q * from_corner : 0.02Q;
        steps[0] = size * sign_a;
        steps[1] = size * sign_b;
        return;
    }
    if (at[0] == 0.0Q && at[1] == 0.0Q)
    {
        at[0] = 1e-1000Q * sign_a;
    }
    int wide = fabsq(at[0]) >= fabsq(at[1]);
    quad major = fmaxq(fabsq(at[0]), fabsq(at[1]));
    quad minor = fminq(fabsq(at[0]), fabsq(at[1]));
    quad size = 0.02Q * (s->sliced ? fminq(major, 2.0Q - (major + minor)) : major);
    /* away from the diagonal, and of slice, from the axis if that is nearer */
    quad inwards = s->sliced && 2.0Q * minor < major ? size : -size;
    steps[0] = (wide ? size : inwards) * sign_a;
    steps[1] = (wide ? inwards : size) * sign_b;
}

/* By differences; at a corner where the map is not smooth these are too rough, and the kernel itself in
 * quadruple precision, which they have confirmed elsewhere, is the truth. */
static void warp_truth(const subject *s, const double pq[2], quad truth[4])
{
    quad at[2] = {(quad)pq[0], (quad)pq[1]};
    quad steps[2];
    if (s->cornered && fmin(fabs(pq[0]), fabs(pq[1])) > 1.0 - 1e-6)
    {
        quad uv[2];
        quad_warp(&s->truth, at, uv);
        cm_jacobian_f128 j =
            s->truth.kernels->jacobian(at[0], at[1], uv[0], uv[1], s->truth.constants);
        truth[0] = j.u_p;
        truth[1] = j.u_q;
        truth[2] = j.v_p;
        truth[3] = j.v_q;
        return;
    }
    warp_steps(s, at, steps);
    differentiate_all(warp_value, &s->truth, 2, 2, 0, at, steps, truth);
}

static void check_warp(const subject *s)
{
    const long points = is_long() ? 1000 : is_quick() ? 100 : 200;
    for (size_t n = 0; n < COUNT(precisions); n++)
    {
        const precision *in = &precisions[n];
        worst w = {0};
        uint64_t state = 17;
        for (long i = 0; i < points; i++)
        {
            double pq[2];
            double got[4];
            quad truth[4];
            next_point(in, i, &state, pq);
            if (s->infinite && fabs(pq[0]) == 1.0 && fabs(pq[1]) == 1.0)
            {
                continue;
            }
            warp_truth(s, pq, truth);
            warp_jacobian(s, in, pq, got);
            /* beside an edge the rounding of u and v is large beside their distance from it */
            int inside = fmax(fabs(pq[0]), fabs(pq[1])) <= 0.9;
            measure(&w, 4, got, truth, inside ? 1e-9 : 0.01, in);
        }
        report(s->specification, in, &w);
        REQUIRE(w.matrix <= (s->standard ? BOUND_STANDARD : BOUND), "%s in %s: %g eps",
                s->specification, in->name, w.matrix);
        REQUIRE(s->signs || w.entry <= BOUND, "an entry of %s in %s: %g eps", s->specification,
                in->name, w.entry);
    }
}

START_TEST(test_warps)
{
    for_every_subject(check_warp);
}
END_TEST

/* The Jacobian of the inverse kernel in quadruple precision, at random points beside no border, times
 * that of the forward one. */
static void check_inverse(const subject *s)
{
    uint64_t state = 29;
    double most = 0.0;
    const int points = is_long() ? 300 : 100;
    for (int i = 0; i < points; i++)
    {
        quad inverse[4];
        quad steps[2];
        double forward[4];
        quad uv[2] = {0.9Q * (quad)next_real(&state), 0.9Q * (quad)next_real(&state)};
        double pq[2];
        double rounded[2] = {(double)uv[0], (double)uv[1]};
        uv[0] = (quad)rounded[0];
        uv[1] = (quad)rounded[1];
        cm_pq_f64 r = s->kernels->inverse_f64(rounded[0], rounded[1], s->constants);
        pq[0] = r.p;
        pq[1] = r.q;
        warp_steps(s, uv, steps);
        differentiate_all(unwarp_value, &s->truth, 2, 2, 0, uv, steps, inverse);
        take_jacobian(s->kernels->jacobian_f64(pq[0], pq[1], rounded[0], rounded[1], s->constants),
                      forward);
        for (int k = 0; k < 4; k++)
        {
            quad sum = (quad)forward[k & 2] * inverse[k & 1] +
                       (quad)forward[(k & 2) + 1] * inverse[(k & 1) + 2];
            most = fmax(most, fabs((double)(sum - (k % 3 == 0 ? 1.0Q : 0.0Q))));
        }
    }
    /* the published inverse of COBE is not one */
    printf("%-28s inverse times forward - 1: %.2g\n", s->specification, most);
    REQUIRE(s->legacy ? most > 1e-4 && most < 0.02 : most < 1e-14, "%s: %g", s->specification,
            most);
}

START_TEST(test_inverses)
{
    for_every_subject(check_inverse);
}
END_TEST

static int all_finite(int count, const double *values)
{
    int all = 1;
    for (int i = 0; i < count; i++)
    {
        all &= isfinite(values[i]) != 0;
    }
    return all;
}

/* At every hard point: finite, and even or odd in p and in q. */
static void check_hard_points(const subject *s)
{
    for (size_t n = 0; n < COUNT(precisions); n++)
    {
        for (uint64_t i = 0; i < HARD_POINTS; i++)
        {
            double pq[2];
            double got[4];
            double mirrored[4];
            float narrow[2];
            hard_point(i, pq);
            hard_point_f32(i, narrow);
            for (int k = 0; k < 2; k++)
            {
                pq[k] = fmax(-1.0, fmin(1.0, n == 1 ? (double)narrow[k] : pq[k]));
            }
            double turned[2] = {-pq[0], pq[1]};
            warp_jacobian(s, &precisions[n], pq, got);
            warp_jacobian(s, &precisions[n], turned, mirrored);
            REQUIRE(all_finite(4, got), "%s at %a %a", s->specification, pq[0], pq[1]);
            REQUIRE(got[0] > 0.0 || strcmp(s->specification, "smoothstep:c=1") == 0,
                    "%s at %a %a: u falls with p", s->specification, pq[0], pq[1]);
            REQUIRE(got[0] == mirrored[0] && got[1] == -mirrored[1] && got[2] == -mirrored[2] &&
                        got[3] == mirrored[3],
                    "%s at %a %a: the mirrored point differs", s->specification, pq[0], pq[1]);
        }
    }
}

START_TEST(test_hard_points)
{
    for_every_subject(check_hard_points);
}
END_TEST

/* ---- The cube's faces ---- */

static void unproject_value(const void *context, const quad *at, quad *value)
{
    const int *face = context;
    cm_xyz_f128 r = cm_cube_unproject_f128((quad)*face, at[0], at[1]);
    value[0] = r.x;
    value[1] = r.y;
    value[2] = r.z;
}

static void project_value(const void *context, const quad *at, quad *value)
{
    (void)context;
    cm_face_point_f128 r = cm_cube_project_f128(at[0], at[1], at[2]);
    value[0] = r.a;
    value[1] = r.b;
}

static void make_unit(const double d[3], quad unit[3])
{
    quad square = 0.0Q;
    for (int k = 0; k < 3; k++)
    {
        square += (quad)d[k] * (quad)d[k];
    }
    const quad length = sqrtq(square);
    for (int k = 0; k < 3; k++)
    {
        unit[k] = (quad)d[k] / length;
    }
}

/* the largest component grows, the others shrink: the face stays */
static void project_steps(const quad unit[3], int face, quad steps[3])
{
    int major = face >= 4 ? 2 : face % 2;
    for (int k = 0; k < 3; k++)
    {
        quad outwards = copysignq(0.02Q, unit[k]);
        steps[k] = k == major ? outwards : -outwards;
    }
}

/* gradients are orthogonal to the direction: the sine of the angle, in eps */
static double slant(const double gradients[6], const quad unit[3], const precision *in)
{
    double most = 0.0;
    for (int i = 0; i < 6; i += 3)
    {
        quad dot = 0.0Q;
        quad square = 0.0Q;
        for (int k = 0; k < 3; k++)
        {
            dot += (quad)gradients[i + k] * unit[k];
            square += (quad)gradients[i + k] * (quad)gradients[i + k];
        }
        most = fmax(most, (double)(fabsq(dot) / sqrtq(square)) / in->eps);
    }
    return most;
}

START_TEST(test_cube)
{
    for (size_t n = 0; n < COUNT(precisions); n++)
    {
        const precision *in = &precisions[n];
        worst tangents = {0};
        worst gradients = {0};
        double slanted = 0.0;
        uint64_t state = 5;
        for (long i = 0; i < 3000; i++)
        {
            double pq[2];
            double d[3];
            double got[6];
            quad truth[6];
            quad unit[3];
            quad steps[3] = {0.02Q, 0.02Q, 0.0Q};
            int face = (int)(i / 2 % 6);
            next_point(in, i, &state, pq);
            quad at[2] = {(quad)pq[0], (quad)pq[1]};
            differentiate_all(unproject_value, &face, 2, 3, 1, at, steps, truth);
            tangents_of(0, in, face, pq, got);
            measure(&tangents, 6, got, truth, 0.01, in);

            next_vector(in, i, &state, d);
            face = gradients_of(0, in, d, got);
            make_unit(d, unit);
            project_steps(unit, face, steps);
            differentiate_all(project_value, NULL, 3, 2, 0, unit, steps, truth);
            measure(&gradients, 6, got, truth, 0.01, in);
            slanted = fmax(slanted, slant(got, unit, in));
        }
        report("cube, tangents", in, &tangents);
        report("cube, gradients", in, &gradients);
        printf("%-28s %-6s gradients are orthogonal to %.2f eps\n", "", in->name, slanted);
        REQUIRE(tangents.matrix <= BOUND_STANDARD && tangents.entry <= BOUND_STANDARD &&
                    gradients.matrix <= BOUND_STANDARD && gradients.entry <= BOUND_STANDARD &&
                    slanted <= BOUND_STANDARD,
                "in %s", in->name);
    }
}
END_TEST

/* ---- HEALPix ---- */

/* One piece of the map, by formulas that hold beyond its borders too. */
typedef struct region
{
    int polar;
    int south;
    int x_wins;
    quad sign;
} region;

static void region_value(const void *context, const quad *at, quad *value)
{
    const region *in = context;
    quad major = in->sign * at[in->x_wins ? 0 : 1];
    quad minor = in->sign * (in->x_wins ? at[1] : -at[0]);
    quad f = 4.0Q / M_PIq * atanq(minor / major);
    quad rho = hypotq(at[0], at[1]);
    quad length = hypotq(rho, at[2]);
    if (!in->polar)
    {
        value[0] = f;
        value[1] = 1.5Q * at[2] / length;
        return;
    }
    quad sigma = in->sign * rho * sqrtq(3.0Q / (length * (length + fabsq(at[2]))));
    quad north = in->x_wins ? -sigma : sigma * f;
    value[0] = in->x_wins ? sigma * f : sigma;
    value[1] = in->south ? -north : north;
}

/* The direction of (u, v), but for a constant that is taken off z: near a pole its differences would be
 * lost beside it. */
static void region_direction(const void *context, const quad *at, quad *value)
{
    const region *in = context;
    quad v = in->south ? -at[1] : at[1];
    quad sigma = in->x_wins ? -in->sign * v : in->sign * at[0];
    quad f = in->sign * (in->x_wins ? at[0] : v) / sigma;
    quad z = -sigma * sigma / 3.0Q;
    quad rho = sigma * sqrtq(2.0Q / 3.0Q - sigma * sigma / 9.0Q);
    if (!in->polar)
    {
        f = at[0];
        z = 2.0Q / 3.0Q * at[1];
        rho = sqrtq(1.0Q - z * z);
    }
    quad major = in->sign * rho * cosq(M_PI_4q * f);
    quad minor = in->sign * rho * sinq(M_PI_4q * f);
    value[0] = in->x_wins ? major : -minor;
    value[1] = in->x_wins ? minor : major;
    value[2] = in->south ? -z : z;
}

static void healpix_tangent_truth(int face, const double uv[2], quad truth[6])
{
    region piece = {face >= 4, face == 5, face % 2 == 0, face < 2 ? 1.0Q : -1.0Q};
    quad at[2] = {(quad)uv[0], (quad)uv[1]};
    quad value[3];
    if (piece.polar)
    {
        piece.x_wins = fabs(uv[1]) >= fabs(uv[0]);
        quad north = piece.south ? -at[1] : at[1];
        piece.sign = copysignq(1.0Q, piece.x_wins ? -north : at[0]);
        /* the pole stands for the middle of its sector */
        at[1] = uv[0] == 0.0 && uv[1] == 0.0 ? copysignq(1e-1000Q, at[1]) : at[1];
    }
    quad size = piece.polar ? 0.02Q * fmaxq(fabsq(at[0]), fabsq(at[1])) : 0.02Q;
    quad steps[2] = {size, size};
    region_direction(&piece, at, value);
    cm_xyz_f128 d = cm_healpix_unproject_f128((quad)face, at[0], at[1], (cm_constants_f128){0});
    REQUIRE(fabsq(value[0] - d.x) + fabsq(value[1] - d.y) < 1e-30Q, "%d %g %g is elsewhere", face,
            uv[0], uv[1]);
    differentiate_all(region_direction, &piece, 2, 3, 1, at, steps, truth);
}

static void healpix_gradient_truth(int face, const double d[3], quad unit[3], quad truth[6])
{
    region piece = {face >= 4, face == 5, fabs(d[0]) >= fabs(d[1]), 1.0Q};
    quad expected[2];
    quad value[2];
    make_unit(d, unit);
    piece.sign = copysignq(1.0Q, unit[piece.x_wins ? 0 : 1]);
    if (unit[0] == 0.0Q && unit[1] == 0.0Q)
    {
        unit[0] = copysignq(1e-1000Q, (quad)d[0]);
    }
    quad size = 0.02Q * fabsq(unit[piece.x_wins ? 0 : 1]);
    quad steps[3] = {size, size, 0.02Q};
    region_value(&piece, unit, value);
    cm_face_point_f128 point =
        cm_healpix_project_f128(unit[0], unit[1], unit[2], (cm_constants_f128){0});
    expected[0] = point.a;
    expected[1] = point.b;
    for (int k = 0; k < 2 && (int)point.face == face; k++)
    {
        REQUIRE(fabsq(value[k] - expected[k]) < 1e-30Q, "%g %g %g is elsewhere", d[0], d[1], d[2]);
    }
    differentiate_all(region_value, &piece, 3, 2, 0, unit, steps, truth);
}

static double cross_length(const double m[6])
{
    double x = m[1] * m[5] - m[2] * m[4];
    double y = m[2] * m[3] - m[0] * m[5];
    double z = m[0] * m[4] - m[1] * m[3];
    return sqrt(x * x + y * y + z * z);
}

#define SIXTH_OF_PI 0.52359877559829887 /* of the sphere's area over that of six faces */

START_TEST(test_healpix)
{
    for (size_t n = 0; n < COUNT(precisions); n++)
    {
        const precision *in = &precisions[n];
        worst tangents = {0};
        worst gradients = {0};
        double slanted = 0.0;
        double area = 0.0;
        uint64_t state = 7;
        const long points = is_long() ? 6000 : 2000;
        for (long i = 0; i < points; i++)
        {
            double uv[2];
            double d[3];
            double got[6];
            quad truth[6];
            quad unit[3];
            int face = (int)(i / 2 % 6);
            next_point(in, i, &state, uv);
            healpix_tangent_truth(face, uv, truth);
            tangents_of(1, in, face, uv, got);
            measure(&tangents, 6, got, truth, 0.01, in);
            area = fmax(area, fabs(cross_length(got) / SIXTH_OF_PI - 1.0) / in->eps);

            next_vector(in, i, &state, d);
            face = gradients_of(1, in, d, got);
            healpix_gradient_truth(face, d, unit, truth);
            measure(&gradients, 6, got, truth, 0.01, in);
            area = fmax(area, fabs(cross_length(got) * SIXTH_OF_PI - 1.0) / in->eps);
            slanted = fmax(slanted, slant(got, unit, in));
        }
        report("healpix, tangents", in, &tangents);
        report("healpix, gradients", in, &gradients);
        printf("%-28s %-6s gradients are orthogonal to %.2f eps, areas equal to %.2f eps\n", "",
               in->name, slanted, area);
        REQUIRE(tangents.matrix <= BOUND_STANDARD && gradients.matrix <= BOUND_STANDARD &&
                    slanted <= BOUND_STANDARD && area <= BOUND_STANDARD,
                "in %s", in->name);
    }
}
END_TEST

/* The same for every hard direction, against no truth: finite, equal-area. */
START_TEST(test_healpix_everywhere)
{
    for (uint64_t i = 0; i < HARD_DIRECTIONS; i++)
    {
        double d[3];
        double got[6];
        hard_direction(i, d);
        if (d[0] != 0.0 || d[1] != 0.0 || d[2] != 0.0)
        {
            gradients_of(1, &precisions[0], d, got);
            REQUIRE(fabs(cross_length(got) * SIXTH_OF_PI - 1.0) < 1e-14, "%a %a %a", d[0], d[1],
                    d[2]);
            gradients_of(0, &precisions[0], d, got);
            REQUIRE(all_finite(6, got), "%a %a %a", d[0], d[1], d[2]);
        }
    }
    for (uint64_t i = 0; i < HARD_POINTS; i++)
    {
        double uv[2];
        double got[6];
        hard_point(i, uv);
        for (int face = 0; face < 6; face++)
        {
            tangents_of(1, &precisions[0], face, uv, got);
            REQUIRE(fabs(cross_length(got) / SIXTH_OF_PI - 1.0) < 1e-14, "%d %a %a", face, uv[0],
                    uv[1]);
        }
    }
}
END_TEST

/* ---- Both together ---- */

/* Derivatives of the direction by (u, v) and of (u, v) by the direction: their product is 1, and the
 * first times the Jacobian is what cm_cube_tangents gives. */
static void check_combination(const subject *s)
{
    uint64_t state = 31;
    double identity = 0.0;
    double tangent = 0.0;
    double slanted = 0.0;
    double area = 0.0;
    for (long i = 0; i < 20000; i++)
    {
        double pq[2];
        double by_uv[6];
        double by_pq[6];
        double gradients[6];
        quad unit[3];
        int face = (int)(i / 2 % 6);
        next_point(&precisions[0], i, &state, pq);
        cm_jacobian_f64 j = jacobian_at(s, pq);
        cm_tangents_f64 t = cm_cube_tangents_f64((double)face, pq[0], pq[1]);
        cm_xyz_f64 d = cm_cube_unproject_f64((double)face, pq[0], pq[1]);
        double determinant = cm_jacobian_determinant_f64(j);
        if (determinant < LEAST)
        {
            REQUIRE(strcmp(s->specification, "smoothstep:c=1") == 0, "%s is singular",
                    s->specification);
            continue;
        }
        cm_tangents_f64 through = cm_jacobian_tangents_f64(j, t);
        TAKE_TANGENTS(t, by_pq);
        TAKE_TANGENTS(through, by_uv);
        double largest = 0.0;
        for (int k = 0; k < 6; k++)
        {
            largest = fmax(largest, fabs(by_uv[k]));
        }
        for (int k = 0; k < 3; k++)
        {
            double along_p = by_uv[k] * j.u_p + by_uv[k + 3] * j.v_p;
            double along_q = by_uv[k] * j.u_q + by_uv[k + 3] * j.v_q;
            tangent = fmax(tangent, fabs(along_p - by_pq[k]));
            tangent = fmax(tangent, fabs(along_q - by_pq[k + 3]));
        }
        double length3 = pow(1.0 + pq[0] * pq[0] + pq[1] * pq[1], 1.5);
        area = fmax(area, fabs(determinant * length3 * SIXTH_OF_PI - 1.0));
        REQUIRE(all_finite(6, by_uv), "%s at %a %a", s->specification, pq[0], pq[1]);

        /* the point as a direction may count to another face */
        cm_face_point_f64 back = cm_cube_project_f64(d.x, d.y, d.z);
        if ((int)back.face != face || fmax(fabs(pq[0]), fabs(pq[1])) > 1.0 - 1e-6)
        {
            continue;
        }
        cm_gradients_f64 g = cm_jacobian_gradients_f64(j, cm_cube_gradients_f64(d.x, d.y, d.z));
        TAKE_GRADIENTS(g, gradients);
        for (int k = 0; k < 4; k++)
        {
            double sum = 0.0;
            double size = 0.0;
            for (int m = 0; m < 3; m++)
            {
                double term = gradients[(k >> 1) * 3 + m] * by_uv[(k & 1) * 3 + m];
                sum += term;
                size += fabs(term);
            }
            identity = fmax(identity, fabs(sum - (k % 3 == 0 ? 1.0 : 0.0)) / fmax(1.0, size));
        }
        /* in quadruple precision, of a hard one and a random one in eight */
        if (i % (long)long_step_of(8, 8) < 2)
        {
            const double direction[3] = {d.x, d.y, d.z};
            make_unit(direction, unit);
            slanted = fmax(slanted, slant(gradients, unit, &precisions[0]));
        }
    }
    printf("%-28s tangents %.2g, identity %.2g, orthogonal to %.2f eps, areal factor %.4g\n",
           s->specification, tangent, identity, slanted, area);
    double bound = s->standard ? 1e-14 : 1e-12;
    REQUIRE(tangent < bound && identity < bound && slanted < 20.0, "%s", s->specification);
    REQUIRE(!s->creased || area < 1e-14, "areas of %s differ by %g", s->specification, area);
}

START_TEST(test_combinations)
{
    for_every_subject(check_combination);
}
END_TEST

#pragma GCC diagnostic pop

int main(void)
{
    const TTest *const tests[] = {test_warps,        test_inverses, test_hard_points,
                                  test_cube,         test_healpix,  test_healpix_everywhere,
                                  test_combinations, NULL};
    return run_suite("jacobian", tests);
}
