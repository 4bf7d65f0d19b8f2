/* SPDX-License-Identifier: MIT
 *
 * The judges: whether a result of the tested path may stand beside that of the reference.
 */
#include "paths.h"

#include "truth/sphere.h"

int has_warp(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->family != CM_FAMILY_HYBRID;
}

/* NaN, signs (of zeros too), and distances in eps: absolute, and of a number's own size where that is
 * not too small for it. */
static const char *judge_numbers(const comparison *c, int first, int count, double absolute,
                                 double relative, double *error)
{
    for (int k = first; k < first + count; k++)
    {
        double expected = c->expected[k].real;
        double got = c->got[k].real;
        if (isnan(expected) || isnan(got))
        {
            if (isnan(expected) && isnan(got))
            {
                continue;
            }
            return "NaN, but not both";
        }
        if (isfinite(relative) && signbit(expected) != signbit(got))
        {
            return "another sign";
        }
        double apart = fabs(expected - got) / c->in->eps;
        *error = fmax(*error, apart);
        if (!(apart <= absolute))
        {
            return "too far apart";
        }
        if (fabs(expected) >= c->in->least && !(apart <= relative * fabs(expected)))
        {
            return "too far apart for their size";
        }
    }
    return NULL;
}

/* The angle between what face, u, v of both stand for. */
static double angle_apart(const comparison *c)
{
    const number *const both[2] = {c->expected, c->got};
    double direction[2][3];
    for (int i = 0; i < 2; i++)
    {
        const double uv[2] = {both[i][1].real, both[i][2].real};
        cm_inverse(c->subject->reference, (uint8_t)both[i][0].word, uv, direction[i]);
    }
    return angle_between(direction[0], direction[1]);
}

/* Where the border of the only face meets itself rounding decides which of its two places a point has. */
static int is_on_fold(const comparison *c)
{
    if (strcmp(cm_mapping_describe(c->subject->reference)->identifier, "rhealpix") == 0)
    {
        /* its squares end at multiples of 1/4, and on the sphere go on elsewhere */
        double u = 4.0 * c->expected[1].real;
        double v = 4.0 * c->expected[2].real;
        return fmin(fabs(u - round(u)), fabs(v - round(v))) <= 64.0 * c->in->eps;
    }
    double largest = fmax(fabs(c->expected[1].real), fabs(c->expected[2].real));
    return cm_mapping_describe(c->subject->reference)->kind == CM_KIND_LAYOUT &&
           largest >= 1.0 - 16.0 * c->in->eps;
}

/* Is one of them on the rim of a field of view, and the other one beyond it by as much as is none? */
static int is_beside_rim(const comparison *c)
{
    const number *point = c->expected[0].word == CM_NO_FACE ? c->got : c->expected;
    return cm_mapping_describe(c->subject->reference)->kind == CM_KIND_AZIMUTHAL &&
           c->expected[0].word != c->got[0].word &&
           fabs(hypot(point[1].real, point[2].real) - 1.0) <= 8.0 * c->in->eps;
}

/* Faces are equal, of ties too. Only those of a hybrid are a matter of rounding; on the other side of
 * an edge a result is as near on the sphere. */
const char *judge_map(const comparison *c, double *error)
{
    if (c->expected[0].word == c->got[0].word)
    {
        double apart = *error;
        const char *wrong =
            judge_numbers(c, 1, 2, forward_bound(c->subject), relative_bound(c->subject), &apart);
        if (wrong == NULL || !is_on_fold(c))
        {
            *error = apart;
            return wrong;
        }
    }
    if (is_beside_rim(c))
    {
        return NULL;
    }
    if (has_warp(c->subject->reference))
    {
        return "another face";
    }
    double angle = angle_apart(c);
    *error = fmax(*error, angle / c->in->eps);
    return angle <= angle_bound(c->subject, c->in) ? NULL : "another face, and not beside an edge";
}

const char *judge_direction(const comparison *c, double *error)
{
    return judge_numbers(c, 0, 3, inverse_bound(c->subject), relative_bound(c->subject), error);
}

const char *judge_warped(const comparison *c, double *error)
{
    return judge_numbers(c, 0, 2, forward_bound(c->subject), relative_bound(c->subject), error);
}

const char *judge_unwarped(const comparison *c, double *error)
{
    return judge_numbers(c, 0, 2, inverse_bound(c->subject), relative_bound(c->subject), error);
}

/* How far a matrix is from another, in eps of the other's largest entry; infinite if one of them has NaN
 * and not the other. */
static double matrix_apart(const comparison *c, const number *expected)
{
    double largest = 0.0;
    double apart = 0.0;
    for (int k = 0; k < 6; k++)
    {
        largest = fmax(largest, fabs(expected[k].real));
        apart = fmax(apart, fabs(expected[k].real - c->got[k].real));
        if (isnan(expected[k].real) != isnan(c->got[k].real))
        {
            return (double)INFINITY;
        }
    }
    return apart == 0.0 ? 0.0 : apart / (largest * c->in->eps);
}

/* Digits of base 3, one for each column of the input. */
#define STEPS 27

/* A power of two by which a direction has normal numbers, that can be moved by some eps. */
static double to_normal_length(const comparison *c)
{
    double most =
        fmax(fabs(c->input[0].real), fmax(fabs(c->input[1].real), fabs(c->input[2].real)));
    return strncmp(c->path->inputs, "rrr", 3) == 0 && most > 0.0 ? ldexp(1.0, -ilogb(most)) : 1.0;
}

/* What the reference has at a point that is some eps beside the input. */
static void reference_beside(const comparison *c, int step, number beside[COLUMNS_MAX])
{
    double input[COLUMNS_MAX] = {0.0}, output[COLUMNS_MAX] = {0.0};
    void *in[COLUMNS_MAX], *out[COLUMNS_MAX];
    const path *p = c->path;
    double scale = to_normal_length(c);
    for (size_t k = 0; k < COLUMNS_MAX; k++, step /= 3)
    {
        in[k] = &input[k];
        out[k] = &output[k];
        if (k < strlen(p->inputs))
        {
            number moved = c->input[k];
            moved.real *=
                p->inputs[k] == 'r' ? scale + (step % 3 - 1) * 8.0 * c->in->eps * scale : 1.0;
            put_value(p->inputs[k], c->in, in[k], 0, moved);
        }
    }
    (void)p->forms[0].call(c->subject->reference, 1, in, out, p->forms[0].argument);
    for (size_t k = 0; k < 6; k++)
    {
        beside[k] = get_value('r', c->in, out[k], 0);
    }
}

/* Are there lines within a face, or points, where derivatives jump or have no bound? */
static int has_folds(const subject *s)
{
    return is_steep(s) || !has_warp(s->reference);
}

/* Beside an edge of a hybrid's face rounding decides which face's coordinates have the derivatives, as in
 * judge_map. */
static double least_apart(const comparison *c, double bound,
                          double (*measure)(const comparison *c, const number *expected))
{
    double apart = measure(c, c->expected);
    for (int step = 0; step < STEPS && apart > bound && has_folds(c->subject); step++)
    {
        number beside[COLUMNS_MAX];
        reference_beside(c, step, beside);
        apart = fmin(apart, measure(c, beside));
        /* beside a corner or a pole of one face, or an edge without slope: does the reference itself change as much? */
        comparison moved = *c;
        memcpy(moved.got, beside, sizeof beside);
        int changes = is_steep(c->subject) && measure(&moved, c->expected) >= apart;
        apart = changes ? fmin(apart, bound) : apart;
    }
    return apart;
}

const char *judge_jacobian(const comparison *c, double *error)
{
    double bound = jacobian_bound(c->subject);
    double apart = least_apart(c, bound, matrix_apart);
    *error = fmax(*error, apart);
    return apart <= bound ? NULL : "too far apart";
}

/* Major, minor, orientation, deformation and the texel's two, as far apart as distortion.h allows each of
 * them to be from the truth, in its unit. */
static double distortion_apart(const comparison *c, const number *expected)
{
    double unit = c->in->narrow ? 5e-6 : 1e-14;
    double isotropy = expected[0].real / expected[1].real;
    double apart = 0.0;
    int is_cube = cm_mapping_describe(c->subject->reference)->kind == CM_KIND_CUBE;
    /* one face may be as anisotropic as any, beside a pole that is its border */
    unit *= c->subject->standard && is_cube ? 1.0 : isotropy * isotropy;
    for (int k = 0; k < 6; k++)
    {
        double got = c->got[k].real;
        double difference = fabs(expected[k].real - got);
        if (isnan(expected[k].real) != isnan(got))
        {
            return isotropy < 1e6 || (c->subject->standard && is_cube) ? (double)INFINITY : 0.0;
        }
        difference = k == 2 ? fmin(difference, fabs(difference - 3.14159265358979324)) *
                                  (isotropy - 1.0 < 10.0 * unit ? 0.0 : isotropy - 1.0)
                     : k == 3 ? difference
                              : difference / fabs(expected[k].real);
        apart = isotropy < 1e6 ? fmax(apart, difference / unit) : apart;
    }
    return apart;
}

const char *judge_distortion(const comparison *c, double *error)
{
    double apart = least_apart(c, 2.0, distortion_apart);
    *error = fmax(*error, apart);
    return apart <= 2.0 ? NULL : "too far apart";
}
