/* SPDX-License-Identifier: MIT
 *
 * Environments: small faces of any type on any mapping, any degree, roughness and way of filtering. A constant stays one,
 * solid angles add up, harmonics turn and turn back, threads do not change a bit, and what is refused changes nothing.
 */
#include <cubemap/cubemap.h>
#include <cubemap/environment.h>
#include <cubemap/number.h>

#include <float.h>
#include <math.h>

#include "fuzz_subject.h"

enum
{
    EDGE_MOST = 9,
    DEGREE_MOST = 7,
    COEFFICIENTS_MOST = (DEGREE_MOST + 1) * (DEGREE_MOST + 1) * CM_ENVIRONMENT_CHANNELS_MAX,
    POINTS = 5,
    SAMPLES_MOST = 40
};

#define FOUR_PI (4.0 * 3.14159265358979323846)

typedef struct faces
{
    cm_image image[6];
    size_t bytes; /* of each */
} faces;

/* Memory ends with the last pixel. */
static faces make_faces(supply *from, uint32_t channels)
{
    faces made;
    const cm_pixel_type type = (cm_pixel_type)(take_byte(from) % 4);
    const uint32_t edge = 1 + take_byte(from) % EDGE_MOST;
    made.bytes = (size_t)edge * edge * channels * cm_pixel_size(type);
    for (int i = 0; i < 6; i++)
    {
        made.image[i] = (cm_image){.size = sizeof(cm_image),
                                   .data = malloc(made.bytes),
                                   .type = type,
                                   .width = edge,
                                   .height = edge,
                                   .channels = channels};
        EXPECT(made.image[i].data != NULL, "no memory");
        memset(made.image[i].data, 0, made.bytes);
    }
    return made;
}

static void free_faces(faces *made)
{
    for (int i = 0; i < 6; i++)
    {
        free(made->image[i].data);
    }
}

static int is_constant(const faces *of)
{
    const size_t pixel = of->image[0].channels * cm_pixel_size(of->image[0].type);
    for (int i = 0; i < 6; i++)
    {
        for (size_t at = 0; at < of->bytes; at += pixel)
        {
            if (memcmp((unsigned char *)of->image[i].data + at, of->image[0].data, pixel) != 0)
            {
                return 0;
            }
        }
    }
    return 1;
}

/* Pixels: the input's bytes, or one of them everywhere. */
static void fill_faces(faces *made, supply *from)
{
    const int is_flat = take_byte(from) % 2;
    const uint8_t value = take_byte(from) % 0x78; /* finite as a float and as a half */
    for (int i = 0; i < 6; i++)
    {
        if (is_flat)
        {
            memset(made->image[i].data, value, made->bytes);
        }
        else
        {
            take_bytes(from, made->image[i].data, made->bytes);
        }
    }
}

/* The first channel of a pixel as a number. */
static double value_at(const cm_image *image, size_t pixel)
{
    const size_t at = pixel * image->channels;
    switch (image->type)
    {
    case CM_PIXEL_U8:
        return ((const uint8_t *)image->data)[at] / 255.0;
    case CM_PIXEL_U16:
        return ((const uint16_t *)image->data)[at] / 65535.0;
    case CM_PIXEL_HALF:
        return NAN; /* its bits are not read here */
    default:
        return (double)((const float *)image->data)[at];
    }
}

/* ---- harmonics ---- */

static void take_coefficients(supply *from, size_t count, double *coefficients)
{
    for (size_t i = 0; i < count; i++)
    {
        coefficients[i] = take_fraction(from);
    }
}

static void check_sums(uint32_t degree, uint32_t channels, const double *coefficients, supply *from)
{
    double x[POINTS], y[POINTS], z[POINTS], value[POINTS * CM_ENVIRONMENT_CHANNELS_MAX];
    double basis[POINTS * COEFFICIENTS_MOST];
    for (int i = 0; i < POINTS; i++)
    {
        const int is_raw = take_byte(from) % 4 == 0;
        x[i] = is_raw ? take_double(from) : take_fraction(from);
        y[i] = is_raw ? take_double(from) : take_fraction(from);
        z[i] = is_raw ? take_double(from) : take_fraction(from);
    }
    const size_t count = cm_harmonics_count(degree);
    EXPECT(cm_harmonics_basis(degree, POINTS, x, y, z, basis) == CM_OK, "basis");
    EXPECT(cm_harmonics_evaluate(degree, channels, coefficients, POINTS, x, y, z, value) == CM_OK,
           "sum");
    for (size_t i = 0; i < POINTS; i++)
    {
        double sum = 0.0;
        for (size_t k = 0; k < count; k++)
        {
            sum += basis[i * count + k] * coefficients[k * channels];
        }
        EXPECT((isnan(sum) && isnan(value[i * channels])) ||
                   fabs(sum - value[i * channels]) < 1e-12,
               "%a %a %a: %g, not %g", x[i], y[i], z[i], value[i * channels], sum);
    }
}

static void check_turns(uint32_t degree, uint32_t channels, const double *coefficients,
                        supply *from)
{
    double turned[COEFFICIENTS_MOST];
    cm_rotation rotation, back;
    cm_rotation_from_angles(180.0 * take_fraction(from), 90.0 * take_fraction(from),
                            180.0 * take_fraction(from), &rotation);
    for (int i = 0; i < 3; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            back.row[i][k] = rotation.row[k][i];
        }
    }
    const size_t count = cm_harmonics_count(degree) * channels;
    EXPECT(cm_harmonics_rotate(degree, channels, &rotation, coefficients, turned) == CM_OK, "turn");
    EXPECT(cm_harmonics_rotate(degree, channels, &back, turned, turned) == CM_OK, "back");
    for (size_t i = 0; i < count; i++)
    {
        EXPECT(fabs(turned[i] - coefficients[i]) < 1e-12, "%g, not %g", turned[i], coefficients[i]);
    }
}

static void check_json(uint32_t degree, uint32_t channels, const double *coefficients)
{
    size_t length = 0, again = 0;
    EXPECT(cm_harmonics_json(degree, channels, coefficients, NULL, 0, &length) == CM_ERROR_SPACE,
           "length");
    char *text = malloc(length + 1);
    EXPECT(text != NULL, "no memory");
    EXPECT(cm_harmonics_json(degree, channels, coefficients, text, length, &again) ==
                   CM_ERROR_SPACE &&
               again == length,
           "too little");
    EXPECT(cm_harmonics_json(degree, channels, coefficients, text, length + 1, &again) == CM_OK &&
               strlen(text) == length,
           "just enough");
    const char *at = strstr(text, "\"coefficients\": [");
    EXPECT(at != NULL, "%s", text);
    at = strchr(at, '[') + 1;
    for (size_t i = 0; i < cm_harmonics_count(degree) * channels; i++)
    {
        double value;
        at += strspn(at, " \n[],");
        const size_t digits = strcspn(at, ",]");
        EXPECT(cm_number_parse(at, digits, &value) && value == coefficients[i], "%.*s", (int)digits,
               at);
        at += digits;
    }
    free(text);
}

static void check_factors(uint32_t degree, uint32_t channels, double *coefficients, supply *from)
{
    double factor[DEGREE_MOST + 1];
    const double roughness =
        take_byte(from) % 8 == 0 ? take_double(from) : 0.5 + 0.5 * take_fraction(from);
    const double width = take_byte(from) % 8 == 0 ? take_double(from) : take_byte(from) / 16.0;
    EXPECT(cm_harmonics_cosine_lobe(degree, factor) == CM_OK, "cosine");
    EXPECT(fabs(factor[0] - 0.25 * FOUR_PI) < 1e-12, "%g", factor[0]);
    const cm_status lobe = cm_harmonics_ggx_lobe(degree, roughness, factor);
    EXPECT((lobe == CM_OK) == (roughness >= 0.0 && roughness <= 1.0), "%g", roughness);
    EXPECT(lobe != CM_OK || fabs(factor[0] - 1.0) < 1e-9, "%g", factor[0]);
    const cm_harmonics_window window = (cm_harmonics_window)(take_byte(from) % 3);
    const cm_status damped = cm_harmonics_window_factors(window, width, degree, factor);
    EXPECT((damped == CM_OK) == (width > 0.0 && isfinite(width)), "%g", width);
    if (damped == CM_OK)
    {
        EXPECT(cm_harmonics_scale(degree, channels, factor, coefficients) == CM_OK, "scale");
    }
}

static void check_harmonics(const cm_mapping *mapping, supply *from)
{
    double coefficients[COEFFICIENTS_MOST];
    const uint32_t degree = take_byte(from) % (DEGREE_MOST + 1);
    const uint32_t channels = 1 + take_byte(from) % CM_ENVIRONMENT_CHANNELS_MAX;
    take_coefficients(from, cm_harmonics_count(degree) * channels, coefficients);
    check_sums(degree, channels, coefficients, from);
    check_turns(degree, channels, coefficients, from);
    check_json(degree, channels, coefficients);
    check_factors(degree, channels, coefficients, from);
    faces to = make_faces(from, channels);
    const cm_status status =
        cm_harmonics_faces(degree, channels, coefficients, mapping, 1, to.image);
    EXPECT((status == CM_OK) == (cm_mapping_describe(mapping)->kind == CM_KIND_CUBE), "status %d",
           (int)status);
    free_faces(&to);
}

/* ---- environments ---- */

static void check_same(const cm_status one, const faces *to, const cm_status other,
                       const faces *more)
{
    EXPECT(one == other, "status %d and %d", (int)one, (int)other);
    for (int i = 0; i < 6; i++)
    {
        EXPECT(memcmp(to->image[i].data, more->image[i].data, to->bytes) == 0, "face %d", i);
    }
}

static cm_prefilter_options take_options(supply *from)
{
    const cm_prefilter_options made = {
        .size = sizeof made,
        .method = (cm_prefilter_method)(take_byte(from) % 6),
        .coarseness = take_byte(from) % 4 == 0 ? take_double(from) : take_byte(from) / 64.0,
        .samples = 1 + take_byte(from) % SAMPLES_MOST,
        .blur = take_byte(from) % 4 == 0 ? take_double(from) : take_fraction(from),
        .level = take_byte(from) % 6,
        .subdivision = take_byte(from) % 4,
        .threads = 1};
    return made;
}

/* How far the mean of a constant may be from it: a step of the type, or a float's rounding. */
static double step(const cm_image *image)
{
    return image->type == CM_PIXEL_U8    ? 1.01 / 255.0
           : image->type == CM_PIXEL_U16 ? 1.01 / 65535.0
                                         : 0.0;
}

static void check_flat(const faces *from, const faces *to, const char *specification)
{
    const double value = value_at(from->image, 0);
    const double most = to->image->type == CM_PIXEL_FLOAT ? INFINITY : 1.0;
    const double wanted = isnan(value) ? value : fmax(fmin(value, most), 0.0);
    for (size_t i = 0; !isnan(wanted) && i < (size_t)to->image->width * to->image->width; i++)
    {
        const double found = value_at(&to->image[5], i);
        EXPECT(isnan(found) || fabs(found - wanted) <= step(to->image) + 2e-5 * wanted + 1e-30,
               "%s: %g, not %g", specification, found, wanted);
    }
}

static void check_levels(const cm_environment *environment, const faces *given, const subject *on,
                         supply *from)
{
    const uint32_t channels = cm_environment_channels(environment);
    faces to = make_faces(from, channels), more = to;
    for (int i = 0; i < 6; i++)
    {
        more.image[i].data = malloc(to.bytes);
        EXPECT(more.image[i].data != NULL, "no memory");
        memset(more.image[i].data, 0, to.bytes);
    }
    cm_prefilter_options options = take_options(from);
    const double roughness =
        take_byte(from) % 8 == 0 ? take_double(from) : 0.5 + 0.5 * take_fraction(from);
    const cm_status status =
        cm_environment_prefilter(environment, roughness, &options, on->mapping, to.image);
    options.threads = 2;
    check_same(status, &to,
               cm_environment_prefilter(environment, roughness, &options, on->mapping, more.image),
               &more);
    if (status == CM_OK && is_constant(given))
    {
        check_flat(given, &to, on->specification);
    }
    check_same(cm_environment_irradiance(environment, on->mapping, 1, to.image), &to,
               cm_environment_irradiance(environment, on->mapping, 2, more.image), &more);
    free_faces(&to);
    free_faces(&more);
}

static void check_environment(const subject *on, supply *from)
{
    cm_environment *environment = NULL;
    double one[COEFFICIENTS_MOST], other[COEFFICIENTS_MOST];
    const uint32_t channels = 1 + take_byte(from) % CM_ENVIRONMENT_CHANNELS_MAX;
    faces given = make_faces(from, channels);
    const uint32_t degree = take_byte(from) % (DEGREE_MOST + 1);
    fill_faces(&given, from);
    const cm_status status = cm_environment_create(on->mapping, given.image, 1, &environment);
    EXPECT((status == CM_OK) == !is_one_face(on), "%s: %d", on->specification, (int)status);
    if (status == CM_OK)
    {
        const uint32_t size = cm_environment_size(environment);
        EXPECT(size == given.image->width && cm_environment_channels(environment) == channels, "%u",
               size);
        EXPECT(size <= 1u << (cm_environment_level_count(environment) - 1), "%u", size);
        EXPECT(cm_environment_project(environment, degree, 1, one) == CM_OK &&
                   cm_environment_project(environment, degree, 2, other) == CM_OK &&
                   memcmp(one, other, cm_harmonics_count(degree) * channels * sizeof *one) == 0,
               "threads");
        check_levels(environment, &given, on, from);
    }
    cm_environment_destroy(environment);
    free_faces(&given);
}

static void check_angles(const subject *on, supply *from)
{
    double angle[EDGE_MOST * EDGE_MOST];
    const uint32_t edge = take_byte(from) % (EDGE_MOST + 1);
    const cm_status status = cm_texel_solid_angles(on->mapping, take_byte(from) % 8, edge, angle);
    EXPECT(status != CM_OK || (edge > 0 && !is_one_face(on)), "status %d", (int)status);
    double sum = 0.0;
    for (uint8_t face = 0; status == CM_OK && face < 6; face++)
    {
        EXPECT(cm_texel_solid_angles(on->mapping, face, edge, angle) == CM_OK, "face");
        for (size_t i = 0; i < (size_t)edge * edge; i++)
        {
            EXPECT(angle[i] >= 0.0, "%s: %g", on->specification, angle[i]);
            sum += angle[i];
        }
    }
    EXPECT(status != CM_OK || fabs(sum - FOUR_PI) < 1e-9, "%s, %u: %.12g", on->specification, edge,
           sum);
}

/* ---- reflections ---- */

static void check_brdf(supply *from)
{
    cm_brdf_terms terms = {-7.0, -7.0};
    float table[EDGE_MOST * EDGE_MOST * 3];
    const cm_brdf_shadowing shadowing = (cm_brdf_shadowing)(take_byte(from) % 3);
    const int is_raw = take_byte(from) % 4 == 0;
    const double cosine = is_raw ? take_double(from) : 0.5 + 0.5 * take_fraction(from);
    const double roughness = is_raw ? take_double(from) : 0.5 + 0.5 * take_fraction(from);
    const double f0 = 0.5 + 0.5 * take_fraction(from);
    const cm_status status = cm_brdf_integrate(shadowing, cosine, roughness, &terms);
    EXPECT((status == CM_OK) == (shadowing <= CM_BRDF_SCHLICK && cosine >= 0.0 && cosine <= 1.0 &&
                                 roughness >= 0.0 && roughness <= 1.0),
           "%g %g: %d", cosine, roughness, (int)status);
    EXPECT(status == CM_OK || (terms.scale == -7.0 && terms.bias == -7.0), "touched");
    if (status == CM_OK)
    {
        /* Schlick's terms may reflect a little more than all */
        const double all = terms.scale + terms.bias;
        const double multiple = cm_brdf_multiple(&terms, f0);
        EXPECT(all > 0.0 && all < 1.1 && terms.bias >= -1e-12, "%g %g: %g %g", cosine, roughness,
               terms.scale, terms.bias);
        EXPECT(isfinite(multiple), "%g", multiple);
    }
    EXPECT(isnan(cm_brdf_multiple(NULL, f0)), "NULL");
    const cm_image to = {sizeof to,
                         table,
                         CM_PIXEL_FLOAT,
                         1 + take_byte(from) % 3,
                         1 + take_byte(from) % 3,
                         take_byte(from) % 4 + 1u,
                         0,
                         0};
    const cm_status drawn = cm_brdf_table(shadowing, 1, &to);
    EXPECT((drawn == CM_OK) ==
               (shadowing <= CM_BRDF_SCHLICK && (to.channels == 2 || to.channels == 3)),
           "status %d", (int)drawn);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    const uint8_t part = take_byte(&from) % 4;
    const subject on = take_subject(&from, NULL);
    if (part == 0)
    {
        check_brdf(&from);
    }
    else if (part == 1)
    {
        check_harmonics(on.mapping, &from);
    }
    else
    {
        check_angles(&on, &from);
        check_environment(&on, &from);
    }
    drop_subject(&on);
    return 0;
}
