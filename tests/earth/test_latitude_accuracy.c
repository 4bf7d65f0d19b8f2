/* SPDX-License-Identifier: MIT
 *
 * Every conversion between latitudes against quadruple precision: the bounds that <cubemap/latitude.h> states,
 * with each instruction set, at poles, equator, beside them and at random points. Errors are in units of
 * 2^-53: of an angle in radians, of a direction relative to its component along the axis and to the distance from
 * it. Usage: latitude_accuracy [RANDOM_POINTS] [FLATTENING]; writes the worst of each kind.
 */
#include "truth/quad_latitude.h"

#include "truth/sphere.h"

#include <math.h>
#include <string.h>

/* What the header states. */
#define BOUND_ANGLE 2.0
#define BOUND_DIRECTION 4.5
#define BOUND_FAR_ANGLE 3.0
#define BOUND_FAR_DIRECTION 6.0
#define BOUND_EXACT_ANGLE 8.0
#define BOUND_EXACT_DIRECTION 12.0
#define BOUND_AREA 4.0

#define CONVERSIONS_MAX 8

typedef enum kind
{
    SERIES,
    FAR,
    EXACT,
    KINDS
} kind;

static const char *const kind_names[KINDS] = {"series and near ratios", "far ratios",
                                              "closed forms"};
static const double bound_angle[KINDS] = {BOUND_ANGLE, BOUND_FAR_ANGLE, BOUND_EXACT_ANGLE};
static const double bound_direction[KINDS] = {BOUND_DIRECTION, BOUND_FAR_DIRECTION,
                                              BOUND_EXACT_DIRECTION};

/* All that convert one latitude to another on one ellipsoid. */
typedef struct subject
{
    double f;
    cm_latitude from, to;
    int count;
    kind kinds[CONVERSIONS_MAX];
    const char *names[CONVERSIONS_MAX];
    cm_latitude_conversion *conversions[CONVERSIONS_MAX];
    cm_latitude_conversion *geographic; /* where the truth's search starts */
    cm_latitude_conversion *exact;      /* what conditions are estimated with */
} subject;

static double worst_angle[KINDS];
static double worst_direction[KINDS];
static long judged;
static int failures;

static void judge(const subject *s, int i, const char *what, double error, double bound,
                  double *worst, double at)
{
    judged++;
    *worst = error > *worst ? error : *worst;
    if (!(error <= bound) && failures++ < 20)
    {
        printf("not ok: f %.9g, %s to %s, %s, %s: %.2f eps at tan %.17g\n", s->f,
               cm_latitude_name(s->from), cm_latitude_name(s->to), s->names[i], what, error, at);
    }
}

static latitude_quad tangent_of(const double d[3])
{
    latitude_quad x = d[0];
    latitude_quad y = d[1];
    return d[2] / sqrtq(x * x + y * y);
}

/* Geographic latitudes of the last pair's points, in their order: those of the next pair are the same where only what they
 * are converted to is another, and to find them takes as long as all else. */
enum
{
    FOUND_MAX = 2048
};

static struct found
{
    double f;
    cm_latitude from;
    latitude_quad tangent;
    latitude_quad geographic;
} found[FOUND_MAX];
static size_t found_next;

static latitude_quad truth_of(const subject *s, latitude_quad tangent, const double direction[3])
{
    if (s->from == s->to || s->f == 0.0)
    {
        return tangent;
    }
    struct found *known = &found[found_next++ % FOUND_MAX];
    if (known->f != s->f || known->from != s->from || known->tangent != tangent)
    {
        double start[3];
        cm_latitude_convert_direction(s->geographic, direction, start);
        *known = (struct found){
            s->f, s->from, tangent,
            quad_to_geographic((latitude_quad)s->f, s->from, tangent, tangent_of(start))};
    }
    return quad_from_geographic((latitude_quad)s->f, s->to, known->geographic);
}

/* d log tan(to) by d log tan(from), to some digits, where that is above 1. */
static double condition_of(const subject *s, const double d[3])
{
    const double step = 1e-5;
    const double beside[3] = {d[0], d[1], d[2] * (1.0 + step)};
    double here[3];
    double there[3];
    cm_latitude_convert_direction(s->exact, d, here);
    cm_latitude_convert_direction(s->exact, beside, there);
    double ratio = (double)(tangent_of(there) / tangent_of(here));
    return ratio > 1.0 && isfinite(ratio) ? fmax(1.0, (ratio - 1.0) / step) : 1.0;
}

static void judge_angle(const subject *s, double angle)
{
    const double direction[3] = {cos(angle), 0.0, sin(angle)};
    latitude_quad truth = 0.0Q;
    for (int i = 0; i < s->count; i++)
    {
        double got = cm_latitude_convert(s->conversions[i], angle);
        if (i == 0)
        {
            truth = atanq(truth_of(s, tanq((latitude_quad)angle), direction));
        }
        double error = (double)fabsq((latitude_quad)got - truth) * 0x1p53;
        judge(s, i, "angle", error, bound_angle[s->kinds[i]], &worst_angle[s->kinds[i]],
              tan(angle));
        /* beside the equator also relative to the latitude */
        if (angle < 1e-3)
        {
            double relative = (double)(fabsq((latitude_quad)got - truth) / truth) * 0x1p53;
            judge(s, i, "small angle", relative, bound_direction[s->kinds[i]],
                  &worst_direction[s->kinds[i]], tan(angle));
        }
    }
}

/* Errors count over the condition, which is 1 but for closed forms of strange ellipsoids. */
static void judge_direction(const subject *s, double across, double along)
{
    const double direction[3] = {0.6 * across, 0.8 * across, along};
    latitude_quad truth = truth_of(s, tangent_of(direction), direction);
    double condition = condition_of(s, direction);
    for (int i = 0; i < s->count; i++)
    {
        double got[3];
        cm_latitude_convert_direction(s->conversions[i], direction, got);
        latitude_quad from_axis =
            sqrtq((latitude_quad)got[0] * got[0] + (latitude_quad)got[1] * got[1]);
        if (truth > 1e290Q || truth < 1e-290Q)
        {
            continue; /* a component is subnormal or 0 */
        }
        latitude_quad length = sqrtq(1.0Q + truth * truth);
        double up = (double)fabsq(got[2] * length / truth - 1.0Q) * 0x1p53;
        double beside = (double)fabsq(from_axis * length - 1.0Q) * 0x1p53;
        judge(s, i, "direction", fmax(up, beside) / condition, bound_direction[s->kinds[i]],
              &worst_direction[s->kinds[i]], along / across);
    }
}

static unsigned long long state = 88172645463325252ull;

static double random_number(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

static void judge_subject(const subject *s, int points)
{
    static const double hard[] = {
        1e-300, 1e-15, 1e-8, 1e-3, 0.1,    0.5,       0.78539816339744817, 0.78539816339744839,
        1.0,    1.3,   1.5,  1.57, 1.5707, 1.5707963, 1.5707963267948961};
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++)
    {
        judge_angle(s, hard[i]);
        judge_direction(s, cos(hard[i]), sin(hard[i]));
        judge_direction(s, sin(hard[i]), cos(hard[i]));
    }
    for (int i = 0; i < points; i++)
    {
        double angle = 1.5707963267948961 * random_number();
        double ratio = pow(10.0, -6.0 * random_number());
        judge_angle(s, angle);
        judge_direction(s, cos(angle), sin(angle));
        judge_direction(s, ratio, 1.0);
        judge_direction(s, 1.0, ratio);
    }
}

static cm_latitude_conversion *make(double f, cm_latitude from, cm_latitude to,
                                    const char *instructions, int exact)
{
    cm_ellipsoid e = {.size = sizeof e, .a = 1.0, .f = f};
    cm_latitude_options o = {.size = sizeof o, .exact = exact, .instructions = instructions};
    cm_latitude_conversion *made;
    if (cm_latitude_conversion_create(&e, from, to, &o, &made) != CM_OK)
    {
        abort();
    }
    return made;
}

static void add(subject *s, kind is, const char *instructions, int exact)
{
    s->conversions[s->count] = make(s->f, s->from, s->to, instructions, exact);
    s->kinds[s->count] = is;
    s->names[s->count++] = exact ? "exactly" : instructions;
}

static int has_ratio(cm_latitude latitude)
{
    return latitude != CM_LATITUDE_AUTHALIC && latitude != CM_LATITUDE_CONFORMAL &&
           latitude != CM_LATITUDE_RECTIFYING;
}

static void judge_pair(double f, cm_latitude from, cm_latitude to, int points)
{
    subject s = {.f = f, .from = from, .to = to};
    int is_ratio = has_ratio(from) && has_ratio(to);
    int is_mild = fabs(f) <= CM_LATITUDE_SERIES_FLATTENING;
    for (size_t k = 0; k < cm_instructions_count() && (is_ratio || is_mild); k++)
    {
        add(&s, is_mild ? SERIES : FAR, cm_instructions_at(k), 0);
    }
    if (!is_ratio)
    {
        add(&s, EXACT, NULL, 1);
    }
    found_next = 0;
    s.geographic = make(f, from, CM_LATITUDE_GEOGRAPHIC, NULL, 1);
    s.exact = make(f, from, to, NULL, 1);
    judge_subject(&s, points);
    cm_latitude_conversion_destroy(s.geographic);
    cm_latitude_conversion_destroy(s.exact);
    for (int i = 0; i < s.count; i++)
    {
        cm_latitude_conversion_destroy(s.conversions[i]);
    }
}

/* The surface by the closed form for oblate and for prolate ellipsoids. */
static void judge_area(double a, double f)
{
    cm_ellipsoid e = {.size = sizeof e, .a = a, .f = f};
    latitude_quad b = 1.0Q - (latitude_quad)f;
    latitude_quad e2 = f * (2.0Q - f);
    latitude_quad root = sqrtq(fabsq(e2));
    latitude_quad part = e2 > 0.0Q ? atanhq(root) / root : e2 < 0.0Q ? atanq(root) / root : 1.0Q;
    latitude_quad truth = 2.0Q * M_PIq * e.a * e.a * (1.0Q + b * b * part);
    double error = (double)fabsq(cm_ellipsoid_area(&e) / truth - 1.0Q) * 0x1p53;
    double radius = cm_ellipsoid_authalic_radius(&e);
    double radius_error = (double)fabsq(radius / sqrtq(truth / (4.0Q * M_PIq)) - 1.0Q) * 0x1p53;
    if (!(error <= BOUND_AREA && radius_error <= BOUND_AREA))
    {
        printf("not ok: a %g, f %g: area %.2f eps, radius %.2f eps\n", a, f, error, radius_error);
        failures++;
    }
}

/* Flattenings of all sizes, of both signs, and radii that round otherwise. */
static void judge_areas(int count)
{
    uint64_t own = 3;
    for (int i = 0; i < count; i++)
    {
        double f = exp2(15.0 * (next_real(&own) - 1.0));
        double a = exp2(300.0 * next_real(&own));
        judge_area(a, f * 0.99);
        judge_area(a, f * -99.0);
    }
}

int main(int argc, char **argv)
{
    const double flattenings[] = {1.0 / 298.257223563,
                                  0.02,
                                  -0.02,
                                  1.0 / 51.0,
                                  0.1,
                                  -0.1,
                                  0.9,
                                  -9.0,
                                  0.0,
                                  1e-9,
                                  cm_ellipsoid_find("Mars")->f,
                                  cm_ellipsoid_find("Jupiter")->f,
                                  cm_ellipsoid_find("Saturn")->f,
                                  0.99,
                                  -99.0};
    int points = argc > 1 ? atoi(argv[1]) : 1;
    gauss_prepare();
    judge_areas(20000);
    for (size_t k = 0; k < sizeof flattenings / sizeof *flattenings; k++)
    {
        if (argc > 2 && atof(argv[2]) != flattenings[k])
        {
            continue;
        }
        judge_area(6378137.0, flattenings[k]);
        for (int from = 0; from < CM_LATITUDE_COUNT; from++)
        {
            const unsigned long long same = state;
            for (int to = 0; to < CM_LATITUDE_COUNT; to++)
            {
                state = same; /* the same points */
                judge_pair(flattenings[k], (cm_latitude)from, (cm_latitude)to, points);
            }
        }
    }
    for (int k = 0; k < KINDS; k++)
    {
        printf("%s: worst angle %.2f eps, direction %.2f eps\n", kind_names[k], worst_angle[k],
               worst_direction[k]);
    }
    printf("%ld errors judged, %d too large\n", judged, failures);
    return failures > 0 || judged == 0;
}
