/* SPDX-License-Identifier: MIT
 *
 * Colour maps. Input: a specification, a line end, and then bytes for places, colours and numbers of
 * samples. Messages fit; what is a map has its parameters in their ranges, even steps, ends inside what is
 * promised, samples equal to single colours, and a fit that is inside sRGB.
 */
#include <cubemap/colormap.h>

#include <math.h>

#include "fuzz.h"

enum
{
    MESSAGE_MAX = 400
};

/* A buffer of every size gets the beginning of the same line; none is written if all is well. */
static void check_message(const char *specification, cm_status status)
{
    static const size_t sizes[] = {0, 1, 2, 3, 20, 80, MESSAGE_MAX - 1};
    char whole[MESSAGE_MAX] = "untouched";
    EXPECT(cm_colormap_check(specification, whole, sizeof whole) == status, "status");
    EXPECT(status == CM_OK ? strcmp(whole, "untouched") == 0 : is_one_line(whole), "'%s'", whole);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
    {
        size_t size = sizes[i];
        char *message = malloc(size + (size == 0));
        EXPECT(message != NULL, "no memory");
        memset(message, 1, size + (size == 0));
        EXPECT(cm_colormap_check(specification, message, size) == status, "status");
        if (status == CM_OK || size == 0)
        {
            EXPECT(message[0] == 1, "a message was written");
        }
        else
        {
            EXPECT(memchr(message, '\0', size) != NULL, "no end");
            EXPECT(strncmp(message, whole, size - 1) == 0, "'%s' of '%s'", message, whole);
        }
        free(message);
    }
}

static void check_catalogue(const char *name, size_t index)
{
    const cm_colormap_info *info = cm_colormap_find(name);
    EXPECT((cm_colormap_at(index) != NULL) == (index < cm_colormap_count()), "%zu", index);
    if (strchr(name, ':') == NULL)
    {
        EXPECT((cm_colormap_check(name, NULL, 0) == CM_OK) == (info != NULL), "'%s'", name);
    }
    EXPECT(info == NULL || cm_colormap_find(info->identifier) == info, "'%s'", name);
}

static void check_parameters(const cm_colormap *map)
{
    const cm_colormap_info *info = cm_colormap_describe(map);
    const size_t count = cm_colormap_stop_count(map);
    double stop[2];
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_colormap_parameter_info *parameter = &info->parameter[i];
        double value = cm_colormap_parameter(map, i);
        EXPECT(parameter->stops != NULL ? isnan(value) && count > 0
                                        : value >= parameter->low && value <= parameter->high &&
                                              !(parameter->low_excluded && value == parameter->low),
               "%s=%.17g", parameter->name, value);
    }
    EXPECT(isnan(cm_colormap_parameter(map, info->parameter_count)), "one parameter too many");
    EXPECT(count <= CM_COLORMAP_STOPS_MAX, "%zu stops", count);
    double before = -1.0;
    for (size_t i = 0; i < count; i++)
    {
        cm_colormap_stop(map, i, stop);
        EXPECT(stop[0] > before && stop[0] <= 1.0 && stop[1] >= 0.0 && stop[1] <= 360.0,
               "%.17g@%.17g", stop[1], stop[0]);
        before = stop[0];
    }
    cm_colormap_stop(map, count, stop);
    EXPECT(isnan(stop[0]) && isnan(stop[1]), "one stop too many");
}

static int is_same(const cm_colormap_color *a, const cm_colormap_color *b)
{
    return memcmp(a->luv, b->luv, sizeof a->luv) == 0 &&
           memcmp(a->srgb, b->srgb, sizeof a->srgb) == 0 && a->inside == b->inside;
}

/* The map, written into a buffer that fits, and read again. */
static void check_written(const cm_colormap *map)
{
    size_t length = cm_colormap_specification(map, NULL, 0);
    char *text = malloc(length + 1);
    cm_colormap *again = NULL;
    EXPECT(length < 1024 && text != NULL, "%zu bytes", length);
    EXPECT(cm_colormap_specification(map, text, length + 1) == length, "length");
    EXPECT(strlen(text) == length, "'%s'", text);
    EXPECT(cm_colormap_create(text, &again) == CM_OK, "'%s'", text);
    for (int i = 0; i <= 8; i++)
    {
        cm_colormap_color one, other;
        cm_colormap_color_at(map, i / 8.0, &one);
        cm_colormap_color_at(again, i / 8.0, &other);
        EXPECT(is_same(&one, &other), "'%s' is another map", text);
    }
    cm_colormap_destroy(again);
    free(text);
}

static void check_color(const cm_colormap *map, double t)
{
    cm_colormap_color color;
    cm_colormap_color_at(map, t, &color);
    if (!(t >= -1e-9 && t <= 1.0 + 1e-9))
    {
        EXPECT(isnan(color.lch[0]) && isnan(color.luv[1]) && isnan(color.linear[2]) &&
                   isnan(color.srgb[0]) && !color.inside,
               "%.17g is a place", t);
        return;
    }
    EXPECT(color.lch[0] >= 0.0 && color.lch[0] <= 100.0 && color.lch[1] >= 0.0 &&
               color.lch[1] <= 501.0 && color.lch[2] >= 0.0 && color.lch[2] < 360.0,
           "LCH %.17g %.17g %.17g", color.lch[0], color.lch[1], color.lch[2]);
    EXPECT(isfinite(color.srgb[0]) && isfinite(color.srgb[1]) && isfinite(color.srgb[2]),
           "sRGB at %.17g", t);
}

/* Two places are no further apart in the map's space than along the path. */
static void check_distance(const cm_colormap *map, double from, double to)
{
    const double length = cm_colormap_length(map);
    cm_colormap_color a, b;
    cm_colormap_color_at(map, from, &a);
    cm_colormap_color_at(map, to, &b);
    double one[3], other[3];
    memcpy(one, a.luv, sizeof one);
    memcpy(other, b.luv, sizeof other);
    if (cm_colormap_describe(map)->space == CM_COLORMAP_CAM16_UCS)
    {
        cm_colormap_ucs_from_linear(a.linear, one);
        cm_colormap_ucs_from_linear(b.linear, other);
    }
    double distance = sqrt(pow(one[0] - other[0], 2.0) + pow(one[1] - other[1], 2.0) +
                           pow(one[2] - other[2], 2.0));
    EXPECT(distance <= length * fabs(to - from) * (1.0 + 1e-9) + 1e-9,
           "from %.17g to %.17g: %.17g of %.17g", from, to, distance, length);
}

static void check_corners(const cm_colormap *map)
{
    double before = 0.0;
    for (size_t i = 0; i < cm_colormap_corner_count(map); i++)
    {
        double corner = cm_colormap_corner(map, i);
        EXPECT(corner >= before && corner <= 1.0, "%.17g after %.17g", corner, before);
        before = corner;
    }
    EXPECT(isnan(cm_colormap_corner(map, cm_colormap_corner_count(map))), "one corner too many");
}

/* Places grow from one end to the other; the middle of a diverging map is one. */
static void check_places(const cm_colormap *map, const double *places, size_t n)
{
    const cm_colormap_family family = cm_colormap_describe(map)->family;
    for (size_t i = 0; i < n; i++)
    {
        EXPECT(i == 0 ? places[0] == 0.0 : places[i] > places[i - 1], "%zu of %zu at %.17g", i, n,
               places[i]);
    }
    EXPECT(n < 2 || family == CM_COLORMAP_QUALITATIVE || family == CM_COLORMAP_CYCLIC ||
               places[n - 1] == 1.0,
           "the last of %zu", n);
    EXPECT(n < 2 || n % 2 == 0 || family != CM_COLORMAP_DIVERGING || places[n / 2] == 0.5,
           "the middle of %zu", n);
}

static void check_samples(const cm_colormap *map, size_t n)
{
    double *srgb = malloc(3 * n * sizeof *srgb + (n == 0));
    uint8_t *bytes = malloc(3 * n + (n == 0));
    double *places = malloc(n * sizeof *places + (n == 0));
    cm_colormap_clipping found, of_bytes;
    size_t outside = 0;
    EXPECT(srgb != NULL && bytes != NULL && places != NULL, "no memory");
    cm_colormap_samples(map, n, srgb, &found);
    cm_colormap_samples_u8(map, n, bytes, &of_bytes);
    for (size_t i = 0; i < n; i++)
    {
        cm_colormap_color color;
        places[i] = cm_colormap_position(map, n, i);
        cm_colormap_color_at(map, places[i], &color);
        outside += !color.inside;
        for (size_t k = 0; k < 3; k++)
        {
            EXPECT(srgb[3 * i + k] == fmin(fmax(color.srgb[k], 0.0), 1.0), "%zu of %zu", i, n);
            EXPECT(fabs(bytes[3 * i + k] - 255.0 * srgb[3 * i + k]) < 0.5001, "%zu of %zu", i, n);
        }
    }
    EXPECT(found.count == outside && of_bytes.count == outside, "%zu clipped", found.count);
    EXPECT(isnan(cm_colormap_position(map, n, n)), "one sample too many");
    check_places(map, places, n);
    free(places);
    free(srgb);
    free(bytes);
}

static void check_gamut(const cm_colormap *map)
{
    cm_colormap *fitted = NULL;
    double saturation = cm_colormap_largest_saturation(map);
    EXPECT(isnan(saturation) || saturation >= 0.0, "%.17g", saturation);
    EXPECT(cm_colormap_fit(map, &fitted) == CM_OK, "no fit");
    EXPECT(cm_colormap_inside(fitted), "the fit is outside");
    cm_colormap_destroy(fitted);
}

/* Colours of the supply through all conversions. */
static void check_conversions(supply *from)
{
    double luv[3], lch[3], linear[3], srgb[3], again[3];
    for (int i = 0; i < 3; i++)
    {
        srgb[i] = 0.5 * take_fraction(from) + 0.5;
        luv[i] = take_double(from);
    }
    cm_colormap_linear_from_luv(luv, linear); /* whatever they are */
    cm_colormap_lch_from_luv(luv, lch);
    cm_colormap_luv_from_lch(lch, luv);
    cm_colormap_luv_from_linear(luv, luv);
    cm_colormap_linear_from_srgb(srgb, linear);
    cm_colormap_luv_from_linear(linear, luv);
    cm_colormap_lch_from_luv(luv, lch);
    double most = cm_colormap_largest_chroma(fmin(lch[0], 100.0), lch[2]);
    EXPECT(lch[1] <= most + 1e-8, "chroma %.17g above %.17g", lch[1], most);
    cm_colormap_luv_from_lch(lch, luv);
    cm_colormap_linear_from_luv(luv, linear);
    cm_colormap_srgb_from_linear(linear, again);
    for (int i = 0; i < 3; i++)
    {
        EXPECT(fabs(again[i] - srgb[i]) < 1e-11, "%.17g is %.17g", srgb[i], again[i]);
    }
    most = cm_colormap_largest_chroma(take_double(from), take_double(from));
    EXPECT(isnan(most) || (most >= 0.0 && most < 200.0), "%.17g", most);
}

/* The line up to the first line end, to be freed. */
static char *take_line(supply *from)
{
    const uint8_t *end = from->left > 0 ? memchr(from->at, '\n', from->left) : NULL;
    supply line = {from->at, end == NULL ? from->left : (size_t)(end - from->at)};
    size_t used = line.left + (end != NULL);
    from->at += used;
    from->left -= used;
    return take_text(&line);
}

/* Appearances and differences of numbers of the supply, and of colours of sRGB. */
static void check_appearance(supply *from)
{
    double srgb[2][3], linear[3], ucs[3], again[3], lab[2][3], any[3];
    cm_colormap_viewing viewing;
    cm_colormap_appearance seen;
    for (int i = 0; i < 3; i++)
    {
        srgb[0][i] = 0.5 * take_fraction(from) + 0.5;
        srgb[1][i] = 0.5 * take_fraction(from) + 0.5;
        any[i] = take_double(from);
        viewing.white[i] = take_double(from);
    }
    viewing.luminance = take_double(from);
    viewing.background = take_double(from);
    cm_colormap_cam16(any, &viewing, &seen); /* whatever they are */
    EXPECT(isnan(seen.hue) || (seen.hue >= 0.0 && seen.hue < 360.0), "hue %.17g", seen.hue);
    cm_colormap_linear_from_ucs(any, linear);
    EXPECT(isnan(linear[0]) == isnan(linear[2]), "%.17g %.17g", linear[0], linear[2]);
    EXPECT(!(cm_colormap_ciede2000(any, viewing.white) < 0.0), "negative");
    for (int i = 0; i < 2; i++)
    {
        cm_colormap_linear_from_srgb(srgb[i], linear);
        cm_colormap_lab_from_linear(linear, lab[i]);
        cm_colormap_ucs_from_linear(linear, ucs);
        cm_colormap_linear_from_ucs(ucs, again);
        EXPECT(fabs(again[0] - linear[0]) < 1e-12 && fabs(again[1] - linear[1]) < 1e-12 &&
                   fabs(again[2] - linear[2]) < 1e-12,
               "%.17g is %.17g", linear[0], again[0]);
    }
    double difference = cm_colormap_ciede2000(lab[0], lab[1]);
    EXPECT(difference >= 0.0 && difference < 200.0, "%.17g", difference);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    char *text = take_line(&from);
    cm_colormap *map = NULL;
    cm_status status = cm_colormap_create(text, &map);
    EXPECT((status == CM_OK) == (map != NULL), "status %d", status);
    check_message(text, status);
    check_catalogue(text, take_byte(&from) % 16);
    if (status == CM_OK)
    {
        check_parameters(map);
        check_written(map);
        check_corners(map);
        size_t n = take_byte(&from) + (size_t)take_byte(&from) % 50;
        check_samples(map, n % 8);
        /* with many stops each place may take milliseconds */
        check_samples(map, cm_colormap_stop_count(map) > 6 ? n % 40 : n);
        check_color(map, take_double(&from));
        check_color(map, 0.5 + 0.5 * take_fraction(&from));
        check_distance(map, 0.5 + 0.5 * take_fraction(&from), 0.5 + 0.5 * take_fraction(&from));
        check_gamut(map);
    }
    check_conversions(&from);
    check_appearance(&from);
    cm_colormap_destroy(map);
    free(text);
    EXPECT(cm_colormap_create(NULL, &map) == CM_ERROR_ARGUMENT, "no specification");
    return 0;
}
