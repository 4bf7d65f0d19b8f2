/* SPDX-License-Identifier: MIT
 *
 * Distortion (cubemap/distortion.h) against values of high precision, in distortion.txt, with the bounds
 * that the header promises; on creases, at bad input and where a map is singular; and what must hold
 * between the quantities.
 */
#include "tests/suite.h"

#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const char *vectors;

enum
{
    MAJOR,
    MINOR,
    ORIENTATION,
    SCALE,
    DEFORMATION,
    TEXEL_ASPECT,
    TEXEL_AREA,
    QUANTITIES
};

typedef struct vector
{
    char specification[64];
    unsigned face;
    double uv[2];
    double truth[QUANTITIES];
} vector;

static int read_vector(const char *line, vector *v)
{
    return sscanf(line, "%63s %u %lf %lf %lf %lf %lf %lf %lf %lf %lf", v->specification, &v->face,
                  &v->uv[0], &v->uv[1], &v->truth[MAJOR], &v->truth[MINOR], &v->truth[ORIENTATION],
                  &v->truth[SCALE], &v->truth[DEFORMATION], &v->truth[TEXEL_ASPECT],
                  &v->truth[TEXEL_AREA]) == 11;
}

static void take(const cm_distortion *d, double got[QUANTITIES])
{
    got[MAJOR] = d->major;
    got[MINOR] = d->minor;
    got[ORIENTATION] = d->orientation;
    got[SCALE] = d->scale;
    got[DEFORMATION] = d->deformation;
    got[TEXEL_ASPECT] = d->texel_aspect;
    got[TEXEL_AREA] = d->texel_area;
}

/* An axis has two ends. */
static double axes_apart(double a, double b)
{
    double apart = fabs(a - b);
    return fmin(apart, fabs(apart - 3.14159265358979324));
}

/* The error in units of the header's bound, 1e-14 in double and 5e-6 in float. */
static double error_of(const vector *v, int k, double got, double least)
{
    double isotropy = v->truth[MAJOR] / v->truth[MINOR];
    double other = strchr(v->specification, '=') == NULL ? 1.0 : isotropy * isotropy;
    if (isnan(got))
    {
        return (double)INFINITY;
    }
    switch (k)
    {
    case ORIENTATION:
        return isotropy - 1.0 < 10.0 * least
                   ? 0.0
                   : axes_apart(got, v->truth[k]) * (isotropy - 1.0) / (least * other);
    case DEFORMATION:
        return fabs(got - v->truth[k]) / (least * other);
    default:
        return fabs(got / v->truth[k] - 1.0) / (least * other);
    }
}

typedef struct worst
{
    double error[QUANTITIES];
    long count;
} worst;

static void compare(const vector *v, const double got[QUANTITIES], double least, const char *how,
                    worst *w)
{
    for (int k = 0; k < QUANTITIES; k++)
    {
        double error = error_of(v, k, got[k], least);
        w->error[k] = fmax(w->error[k], error);
        REQUIRE(error <= 1.0,
                "%s of %s at %u %.17g %.17g: quantity %d is %.17g, not %.17g: %g of the bound", how,
                v->specification, v->face, v->uv[0], v->uv[1], k, got[k], v->truth[k], error);
    }
    w->count++;
}

static void report(const char *how, const worst *w, double least)
{
    static const char *const names[QUANTITIES] = {
        "major", "minor", "orientation", "scale", "deformation", "texel aspect", "texel area"};
    printf("%s: %ld points, worst errors in units of %g:", how, w->count, least);
    for (int k = 0; k < QUANTITIES; k++)
    {
        printf(" %s %.3f", names[k], w->error[k]);
    }
    printf("\n");
}

/* A point that is not next to an edge is on its face, forward as well. */
static int is_inside(const vector *v)
{
    return fmax(fabs(v->uv[0]), fabs(v->uv[1])) < 1.0;
}

/* Is it on a crease, where a rounded direction may be of the other side? */
static int is_creased(const vector *v)
{
    int diagonal = fabs(v->uv[0]) == fabs(v->uv[1]);
    int axis = v->uv[0] == 0.0 || v->uv[1] == 0.0;
    return (diagonal && strcmp(v->specification, "qsc") == 0) ||
           ((diagonal || axis) && strcmp(v->specification, "slice") == 0);
}

static void forward_quantities(const cm_mapping *mapping, const vector *v, double got[QUANTITIES])
{
    double direction[3];
    cm_distortion d;
    cm_inverse(mapping, (uint8_t)v->face, v->uv, direction);
    cm_forward_distortion(mapping, direction, &d);
    take(&d, got);
}

static void inverse_quantities_f32(const cm_mapping *mapping, const vector *v,
                                   double got[QUANTITIES])
{
    const float uv[2] = {(float)v->uv[0], (float)v->uv[1]};
    cm_distortion_f32 s;
    cm_inverse_distortion_f32(mapping, (uint8_t)v->face, uv, &s);
    const cm_distortion d = {.major = (double)s.major,
                             .minor = (double)s.minor,
                             .orientation = (double)s.orientation,
                             .scale = (double)s.scale,
                             .deformation = (double)s.deformation,
                             .texel_aspect = (double)s.texel_aspect,
                             .texel_area = (double)s.texel_area};
    take(&d, got);
}

START_TEST(test_vectors)
{
    char line[512];
    long lines = 0;
    worst inverse = {{0}, 0};
    worst forward = {{0}, 0};
    worst narrow = {{0}, 0};
    FILE *in = fopen(vectors, "r");
    ck_assert_msg(in != NULL, "cannot read %s", vectors);
    while (fgets(line, sizeof line, in) != NULL)
    {
        vector v;
        double got[QUANTITIES];
        cm_distortion d;
        if (line[0] == '#')
        {
            continue;
        }
        REQUIRE(read_vector(line, &v), "%s: no vector: %s", vectors, line);
        cm_mapping *mapping = make_mapping(v.specification, cm_frame_find("geo"));
        cm_inverse_distortion(mapping, (uint8_t)v.face, v.uv, &d);
        take(&d, got);
        compare(&v, got, 1e-14, "inverse", &inverse);
        if (is_inside(&v) && !is_creased(&v))
        {
            forward_quantities(mapping, &v, got);
            compare(&v, got, 1e-14, "forward", &forward);
        }
        /* the rounding of u and v to float is part of these errors */
        if (!is_creased(&v))
        {
            inverse_quantities_f32(mapping, &v, got);
            compare(&v, got, 5e-6, "float", &narrow);
        }
        cm_mapping_destroy(mapping);
        lines++;
    }
    fclose(in);
    report("inverse", &inverse, 1e-14);
    report("forward", &forward, 1e-14);
    report("inverse in float", &narrow, 5e-6);
    ck_assert_int_ge(lines, 500);
}
END_TEST

/* s = a b, D_A = s pi / 6, D_I = a / b, omega = 2 asin((a - b) / (a + b)) */
START_TEST(test_relations)
{
    uint64_t state = 3;
    for (size_t m = 0; m < cube_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, cm_frame_find("gl"));
        for (int i = 0; i < 500; i++)
        {
            const double uv[2] = {next_real(&state), next_real(&state)};
            cm_distortion d;
            cm_inverse_distortion(mapping, (uint8_t)(i % 6), uv, &d);
            double sine = (d.major - d.minor) / (d.major + d.minor);
            REQUIRE(d.major >= d.minor && d.minor > 0.0 && d.isotropy >= 1.0, "%s", "axes");
            REQUIRE(fabs(d.major * d.minor / d.scale - 1.0) < 1e-15 &&
                        fabs(d.area / (d.scale * 0.523598775598298873) - 1.0) < 1e-15 &&
                        fabs(d.isotropy * d.minor / d.major - 1.0) < 1e-15 &&
                        fabs(sin(d.deformation / 2.0) - sine) < 1e-15 &&
                        d.orientation > -1.5707963267948968 && d.orientation <= 1.5707963267948968,
                    "%s at %g %g", cm_catalogue_at(m)->identifier, uv[0], uv[1]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Values of formulas.md's suprema, at 50 digits; limits where a map is not smooth. */
START_TEST(test_known)
{
    static const struct
    {
        const char *specification;
        double uv[2];
        double area;
        double isotropy;
    } known[] = {
        {"gnomonic", {1.0, 1.0}, 2.7206990463513265, 1.7320508075688773},
        {"tangent", {0.0, 1.0}, 1.2004225180, 1.4142135623730951},
        {"unicube", {1.0, 1.0}, 0.82699334313, 1.7320508075688773},
        {"nowell", {1.0, 1.0}, 1.2091995761561452, 1.7320508075688773},
        {"continuous", {1.0, 1.0}, 1.5960277, 1.7320508075688773},
        {"qsc", {1.0, 1.0}, 1.0, 1.5497444},
        {"qsc", {1e-9, 1e-9}, 1.0, 1.5572796},
        {"slice", {1.0, 1.0}, 1.0, 1.4266730784783803},
        {"slice", {1.0, 1.0 - 1e-9}, 1.0, 1.4266730784783803},
    };
    for (size_t i = 0; i < COUNT(known); i++)
    {
        cm_mapping *mapping = make_mapping(known[i].specification, cm_frame_find("geo"));
        for (uint8_t face = 0; face < 6; face++)
        {
            cm_distortion d;
            cm_inverse_distortion(mapping, face, known[i].uv, &d);
            REQUIRE(fabs(d.area - known[i].area) < 1e-6 &&
                        fabs(d.isotropy - known[i].isotropy) < 1e-6,
                    "%s: D_A %.10g, D_I %.10g", known[i].specification, d.area, d.isotropy);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

static int all_nan(const cm_distortion *d)
{
    return isnan(d->major) && isnan(d->minor) && isnan(d->orientation) && isnan(d->scale) &&
           isnan(d->deformation) && isnan(d->area) && isnan(d->isotropy) &&
           isnan(d->texel_aspect) && isnan(d->texel_area);
}

START_TEST(test_bad_input)
{
    static const double directions[][3] = {
        {0.0, 0.0, 0.0}, {(double)NAN, 1.0, 0.0}, {1.0, (double)INFINITY, 0.0}};
    static const double points[][2] = {{1.1, 0.0}, {0.0, (double)NAN}, {-(double)INFINITY, 0.0}};
    const double centre[2] = {0.0, 0.0};
    for (size_t m = 0; m < cube_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, cm_frame_find("fits"));
        cm_distortion d;
        for (size_t i = 0; i < COUNT(directions); i++)
        {
            cm_forward_distortion(mapping, directions[i], &d);
            REQUIRE(all_nan(&d), "%s", cm_catalogue_at(m)->identifier);
            cm_inverse_distortion(mapping, 2, points[i], &d);
            REQUIRE(all_nan(&d), "%s", cm_catalogue_at(m)->identifier);
        }
        cm_inverse_distortion(mapping, 6, centre, &d);
        REQUIRE(all_nan(&d), "%s", cm_catalogue_at(m)->identifier);
        cm_inverse_distortion(mapping, 5, centre, &d);
        REQUIRE(!all_nan(&d) && d.orientation == d.orientation, "%s",
                cm_catalogue_at(m)->identifier);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Arrays: of any length, only what is wanted, over an input. */
START_TEST(test_arrays)
{
    enum
    {
        ROOM = 700
    };
    static const size_t lengths[] = {0, 1, 7, 255, 256, 257, 513, 699};
    static double x[ROOM], y[ROOM], z[ROOM], area[ROOM], isotropy[ROOM];
    cm_mapping *mapping = make_mapping("coupled", cm_frame_find("geo"));
    for (size_t k = 0; k < COUNT(lengths); k++)
    {
        size_t n = lengths[k];
        uint64_t state = 7;
        for (size_t i = 0; i < ROOM; i++)
        {
            double direction[3];
            next_direction(&state, direction);
            x[i] = direction[0];
            y[i] = direction[1];
            z[i] = direction[2];
            area[i] = isotropy[i] = 77.0;
        }
        const cm_distortion_arrays to = {.area = area, .isotropy = x, .deformation = isotropy};
        cm_forward_distortion_array(mapping, n, x, y, z, &to);
        const cm_distortion_arrays nothing = {0};
        cm_forward_distortion_array(mapping, n, x, y, z, &nothing);
        state = 7;
        for (size_t i = 0; i < ROOM; i++)
        {
            double direction[3];
            cm_distortion d;
            next_direction(&state, direction);
            cm_forward_distortion(mapping, direction, &d);
            REQUIRE(i < n ? area[i] == d.area && x[i] == d.isotropy && isotropy[i] == d.deformation
                          : area[i] == 77.0 && x[i] == direction[0] && isotropy[i] == 77.0,
                    "point %zu of %zu", i, n);
        }
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* smoothstep:c=1 stands still on its edges. */
START_TEST(test_singular)
{
    const double middle[2] = {1.0, 0.25};
    double direction[3];
    cm_distortion d;
    cm_mapping *mapping = make_mapping("smoothstep:c=1", cm_frame_find("geo"));
    cm_inverse_distortion(mapping, 0, middle, &d);
    REQUIRE(all_nan(&d), "inverse: minor %g, isotropy %g", d.minor, d.isotropy);
    cm_inverse(mapping, 0, middle, direction);
    cm_forward_distortion(mapping, direction, &d);
    REQUIRE(d.minor == 0.0 && d.scale == 0.0 && isinf(d.isotropy) && d.major > 2.0 &&
                isnan(d.texel_area),
            "forward: minor %g, isotropy %g", d.minor, d.isotropy);
    cm_mapping_destroy(mapping);
}
END_TEST

int main(int argc, char **argv)
{
    const TTest *const tests[] = {test_vectors, test_relations, test_known, test_bad_input,
                                  test_arrays,  test_singular,  NULL};
    if (argc != 2)
    {
        fprintf(stderr, "Usage: test-distortion distortion.txt\n");
        return 2;
    }
    vectors = argv[1];
    return run_suite("distortion", tests);
}
