/* SPDX-License-Identifier: MIT
 *
 * Edges, corners, rims, poles and the dateline of every kind of surface, of every mapping: resampling there is as good as
 * inside, or as the same filter over true values of the scene in the pixels that the chart goes on with.
 *
 *   region-quality                             every mapping and kind by one filter in bytes, some in floats
 *   region-quality --all                       by three filters, in both
 *   region-quality --print [SPECIFICATION...]  the table of decibels, of these surfaces or of all
 */
#include <cubemap/catalogue.h>

#include "modules/image/filter_weights.h"
#include "modules/image/surface_object.h"

#include "tests/suite.h"
#include "truth/analytic_scene.h"

#define PI 3.14159265358979323846
#define NEAR 3.0 /* pixels */

enum
{
    FACE = 48,       /* pixels of a face's edge */
    WIDE = 4 * FACE, /* and around the sphere */
    ROW_MOST = 2 * WIDE,
    SPLINE_TAPS =
        20, /* of the cardinal spline that is cut off there: 0.43^10 is 2e-4, of differences alone */
    TAPS_MOST = SPLINE_TAPS,
    CASES_MOST = 128,
    TEXT = 160
};

typedef enum region
{
    INSIDE,
    EDGE,
    CORNER,
    RIM, /* beside places of the plane that show nothing */
    POLE,
    DATELINE,
    REGIONS
} region;

static const char *const region_names[] = {"inside", "edge", "corner", "rim", "pole", "dateline"};

static analytic_scene the_scene;

/* ---- pictures ---- */

static cm_surface *make(const char *specification)
{
    cm_surface *surface = NULL;
    REQUIRE(cm_surface_create(specification, NULL, &surface) == CM_OK, "%s", specification);
    return surface;
}

static void allocate(const cm_surface *surface, cm_pixel_type type, cm_image pictures[6])
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        pictures[i] = (cm_image){.size = sizeof *pictures,
                                 .type = type,
                                 .width = cm_surface_width(surface),
                                 .height = cm_surface_height(surface),
                                 .channels = SCENE_CHANNELS};
        pictures[i].data = calloc((size_t)pictures[i].width * pictures[i].height,
                                  SCENE_CHANNELS * cm_pixel_size(type));
        ck_assert_ptr_nonnull(pictures[i].data);
    }
}

static void release(const cm_surface *surface, cm_image pictures[6])
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        free(pictures[i].data);
    }
}

static void *pixel_of(const cm_surface *surface, const cm_image pictures[6], uint32_t plane,
                      uint32_t column, uint32_t row)
{
    uint32_t at[3];
    cm_surface_pixel(surface, plane, column, row, &at[0], &at[1], &at[2]);
    const cm_image *picture = &pictures[at[0]];
    return (unsigned char *)picture->data +
           ((size_t)at[2] * picture->width + at[1]) * SCENE_CHANNELS * cm_pixel_size(picture->type);
}

/* The directions of one row of a plane. */
static void row_directions(const cm_surface *surface, uint32_t plane, uint32_t row, double *x,
                           double *y, double *z)
{
    static uint8_t planes[ROW_MOST];
    static double columns[ROW_MOST], rows[ROW_MOST];
    const uint32_t width = cm_surface_plane_width(surface);
    ck_assert_uint_le(width, ROW_MOST);
    for (uint32_t i = 0; i < width; i++)
    {
        planes[i] = (uint8_t)plane;
        columns[i] = i + 0.5;
        rows[i] = row + 0.5;
    }
    cm_surface_directions(surface, width, planes, columns, rows, x, y, z);
}

static void paint(const cm_surface *surface, const cm_image pictures[6])
{
    static double at[3][ROW_MOST], values[SCENE_CHANNELS * ROW_MOST];
    for (uint32_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            const uint32_t width = cm_surface_plane_width(surface);
            row_directions(surface, plane, row, at[0], at[1], at[2]);
            scene_values(&the_scene, width, at[0], at[1], at[2], values);
            for (uint32_t i = 0; i < width; i++)
            {
                void *pixel = pixel_of(surface, pictures, plane, i, row);
                for (uint32_t c = 0; c < SCENE_CHANNELS && !isnan(at[0][i]); c++)
                {
                    const double value = values[SCENE_CHANNELS * i + c];
                    if (pictures->type == CM_PIXEL_FLOAT)
                    {
                        ((float *)pixel)[c] = (float)value;
                    }
                    else
                    {
                        ((uint8_t *)pixel)[c] = (uint8_t)lrint(255.0 * value);
                    }
                }
            }
        }
    }
}

static void resample(const cm_surface *from, const cm_surface *to, cm_image source[6],
                     cm_image target[6], cm_filter filter)
{
    const cm_plan_options options = {.size = sizeof options,
                                     .filter = filter,
                                     .tolerance = source->type == CM_PIXEL_FLOAT ? -1.0 : 0.0};
    cm_plan *plan = NULL;
    ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
    ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
    cm_plan_destroy(plan);
}

/* ---- regions ---- */

static int is_beside_gap(const cm_surface *surface, uint8_t plane, double x, double y)
{
    if (!surface->has_gaps)
    {
        return 0;
    }
    double column[16], row[16];
    uint8_t covered[16];
    for (int k = 0; k < 16; k++)
    {
        column[k] = fmin(fmax(x + NEAR * cos(PI / 8.0 * k), 0.0), surface->width);
        row[k] = fmin(fmax(y + NEAR * sin(PI / 8.0 * k), 0.0), surface->height);
    }
    cm_surface_covers(surface, plane, 16, column, row, covered);
    for (int k = 0; k < 16; k++)
    {
        if (!covered[k])
        {
            return 1;
        }
    }
    return 0;
}

static region region_of(const cm_surface *surface, const double d[3], uint8_t plane, double x,
                        double y)
{
    const double pixel = 2.0 * PI / WIDE;
    const int left = fmin(x, surface->width - x) < NEAR;
    const int top = fmin(y, surface->height - y) < NEAR;
    if (left && top && surface->period == 0.0)
    {
        return CORNER;
    }
    if (hypot(d[0], d[1]) < NEAR * pixel)
    {
        return POLE;
    }
    if (is_beside_gap(surface, plane, x, y))
    {
        return RIM;
    }
    if (surface->period == 0.0 && (left || top))
    {
        return EDGE;
    }
    return d[0] < 0.0 && fabs(d[1]) < NEAR * pixel ? DATELINE : INSIDE;
}

/* ---- what the filter itself does ---- */

/* The cardinal spline's weights at t, of pixels -(SPLINE_TAPS/2 - 1) to SPLINE_TAPS/2: the basis' weights, spread by the
 * inverse of its values at whole numbers, which are 1, 26, 66, 26 and 1 of 120. */
static void spline_weights(double t, double weight[TAPS_MOST])
{
    static double inverse[4 * SPLINE_TAPS + 1];
    double basis[CM_FILTER_TAPS_MAX];
    if (inverse[2 * SPLINE_TAPS] == 0.0)
    {
        enum
        {
            SAMPLES = 4096
        };
        for (int k = -2 * SPLINE_TAPS; k <= 2 * SPLINE_TAPS; k++)
        {
            double sum = 0.0;
            for (int i = 0; i < SAMPLES; i++)
            {
                const double w = 2.0 * PI * i / SAMPLES;
                sum += cos(k * w) * 120.0 / (66.0 + 52.0 * cos(w) + 2.0 * cos(2.0 * w));
            }
            inverse[k + 2 * SPLINE_TAPS] = sum / SAMPLES;
        }
    }
    cm_filter_weights(CM_FILTER_BSPLINE5, t, basis);
    for (int i = 0; i < SPLINE_TAPS; i++)
    {
        weight[i] = 0.0;
        for (int k = 0; k < 6; k++)
        {
            const int at = i - (SPLINE_TAPS / 2 - 1) - (k - 2);
            weight[i] += basis[k] * inverse[at + 2 * SPLINE_TAPS];
        }
    }
}

static int taps_of(cm_filter filter, double t, double weight[TAPS_MOST])
{
    if (filter == CM_FILTER_BSPLINE5)
    {
        spline_weights(t, weight);
        return SPLINE_TAPS;
    }
    if (filter == CM_FILTER_BILINEAR)
    {
        weight[0] = 1.0 - t;
        weight[1] = t;
        return 2;
    }
    cm_filter_weights(filter, t, weight);
    return (int)cm_filter_taps(filter);
}

/* The filter's value from the scene itself in the directions that the pixels around have, beyond edges as the chart goes
 * on. */
static void ideal_value(const cm_surface *surface, cm_filter filter, uint8_t plane, double x,
                        double y, double value[SCENE_CHANNELS])
{
    double across[TAPS_MOST], along[TAPS_MOST];
    double column[TAPS_MOST], row[TAPS_MOST], d[3][TAPS_MOST];
    double values[TAPS_MOST * SCENE_CHANNELS];
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const int taps = taps_of(filter, x - 0.5 - left, across);
    taps_of(filter, y - 0.5 - top, along);
    memset(value, 0, SCENE_CHANNELS * sizeof *value);
    for (int j = 0; j < taps; j++)
    {
        for (int i = 0; i < taps; i++)
        {
            column[i] = left + i - (taps / 2 - 1) + 0.5;
            row[i] = top + j - (taps / 2 - 1) + 0.5;
        }
        cm_surface_directions_beyond(surface, plane, (size_t)taps, column, row, d[0], d[1], d[2]);
        for (int i = 0; i < taps; i++)
        {
            const double length = sqrt(d[0][i] * d[0][i] + d[1][i] * d[1][i] + d[2][i] * d[2][i]);
            for (int axis = 0; axis < 3; axis++)
            {
                d[axis][i] /= length;
            }
        }
        scene_values(&the_scene, (size_t)taps, d[0], d[1], d[2], values);
        for (int i = 0; i < taps; i++)
        {
            for (int c = 0; c < SCENE_CHANNELS; c++)
            {
                value[c] += across[i] * along[j] * values[i * SCENE_CHANNELS + c];
            }
        }
    }
}

/* ---- measures ---- */

typedef struct quality
{
    double sum[REGIONS];
    double ideal[REGIONS];
    double worst[REGIONS];
    size_t count[REGIONS];
    size_t ideal_count[REGIONS];
} quality;

static double decibels(double sum, size_t count)
{
    return -10.0 * log10(sum / (double)count);
}

static double number_of(const cm_image *picture, const void *pixel, int channel)
{
    return picture->type == CM_PIXEL_FLOAT ? (double)((const float *)pixel)[channel]
                                           : ((const uint8_t *)pixel)[channel] / 255.0;
}

/* One row of the target; only every so manieth inner pixel is filtered ideally. */
static void measure_row(const cm_surface *from, const cm_surface *to, const cm_image target[6],
                        cm_filter filter, uint32_t plane, uint32_t row, quality *measured)
{
    static double d[3][ROW_MOST], x[ROW_MOST], y[ROW_MOST], values[SCENE_CHANNELS * ROW_MOST];
    static uint8_t found[ROW_MOST];
    const uint32_t width = cm_surface_plane_width(to);
    row_directions(to, plane, row, d[0], d[1], d[2]);
    cm_surface_positions(from, width, d[0], d[1], d[2], found, x, y);
    scene_values(&the_scene, width, d[0], d[1], d[2], values);
    for (uint32_t i = 0; i < width; i++)
    {
        if (found[i] == CM_NO_FACE)
        {
            continue;
        }
        const double direction[3] = {d[0][i], d[1][i], d[2][i]};
        const region where = region_of(from, direction, found[i], x[i], y[i]);
        const void *pixel = pixel_of(to, target, plane, i, row);
        double ideal[SCENE_CHANNELS];
        const int is_filtered = (where != INSIDE || (i + row) % 16 == 0) &&
                                (filter != CM_FILTER_BSPLINE5 || (i + row) % 5 == 0);
        if (is_filtered)
        {
            ideal_value(from, filter, found[i], x[i], y[i], ideal);
        }
        for (int c = 0; c < SCENE_CHANNELS; c++)
        {
            const double truth = values[SCENE_CHANNELS * i + (uint32_t)c];
            const double error = number_of(target, pixel, c) - truth;
            ck_assert(!isnan(error));
            measured->sum[where] += error * error;
            measured->worst[where] = fmax(measured->worst[where], fabs(error));
            measured->count[where]++;
            if (is_filtered && !isnan(ideal[c]))
            {
                measured->ideal[where] += (ideal[c] - truth) * (ideal[c] - truth);
                measured->ideal_count[where]++;
            }
        }
    }
}

static void measure(const char *from_name, const char *to_name, cm_pixel_type type,
                    cm_filter filter, quality *measured)
{
    cm_surface *from = make(from_name), *to = make(to_name);
    cm_image source[6], target[6];
    memset(measured, 0, sizeof *measured);
    allocate(from, type, source);
    allocate(to, type, target);
    paint(from, source);
    resample(from, to, source, target, filter);
    for (uint32_t plane = 0; plane < cm_surface_plane_count(to); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(to); row++)
        {
            measure_row(from, to, target, filter, plane, row, measured);
        }
    }
    release(from, source);
    release(to, target);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}

/* ---- cases ---- */

typedef struct quality_case
{
    char from[TEXT];
    char to[TEXT];
} quality_case;

static const char *const others[] = {"equirect",
                                     "equal-area",
                                     "mercator",
                                     "equirect;west=0;east=100;south=-50;north=50",
                                     "view:fov=90",
                                     "dual-fisheye",
                                     "dual-fisheye:fov=190",
                                     "dual-paraboloid",
                                     "fisheye:equidistant:fov=170",
                                     "fisheye:equidistant:fov=360",
                                     "fisheye:lambert:fov=360",
                                     "healpix:48"};

/* Of every mapping of the catalogue that makes a surface, and of all other kinds. */
static size_t find_cases(quality_case cases[CASES_MOST])
{
    size_t count = 0;
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        if (info->kind == CM_KIND_DISC_SQUARE)
        {
            continue;
        }
        const int is_cube = info->kind == CM_KIND_CUBE;
        snprintf(cases[count].from, TEXT, "%s%s;size=%d", is_cube ? "cube:" : "", info->identifier,
                 is_cube ? FACE : 2 * FACE);
        snprintf(cases[count].to, TEXT, "%s=%d", is_cube ? "equirect;size" : "cube;size",
                 is_cube ? WIDE : FACE);
        cm_surface *surface = NULL;
        const int is_there = cm_surface_create(cases[count].from, NULL, &surface) == CM_OK;
        cm_surface_destroy(surface);
        count += (size_t)is_there;
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++, count++)
    {
        const int is_wide = strncmp(others[i], "e", 1) == 0 || strncmp(others[i], "dual", 4) == 0;
        const int is_sized = strncmp(others[i], "healpix", 7) == 0;
        if (is_sized)
        {
            snprintf(cases[count].from, TEXT, "%s", others[i]);
        }
        else
        {
            snprintf(cases[count].from, TEXT, "%s;size=%d", others[i],
                     strstr(others[i], "west") != NULL ? WIDE / 2
                     : is_wide                         ? WIDE
                                                       : 2 * FACE);
        }
        snprintf(cases[count].to, TEXT, "cube;size=%d", FACE);
    }
    ck_assert_uint_lt(count, CASES_MOST);
    return count;
}

/* ---- tests ---- */

static int has_all;

/* At these rims the map is so steep that no row of pixels has a value of what is between its last one and the rim. */
static int is_steep(const char *from)
{
    return strncmp(from, "azimuthal:orthographic", 22) == 0 ||
           strncmp(from, "azimuthal:lambert", 17) == 0 ||
           strncmp(from, "fisheye:lambert:fov=360", 23) == 0;
}

/* Maps of a part of the sphere end without a neighbor, and are continued by parabolas, which magnify rounding a little. */
static int is_part(const char *from)
{
    return strncmp(from, "view", 4) == 0 || strstr(from, "west") != NULL ||
           strncmp(from, "azimuthal", 9) == 0 || strncmp(from, "fisheye", 7) == 0;
}

/* What a region must reach: what is inside less a decibel, or what the filter makes of true values, with the same
 * rounding. Coefficients of splines are of all pixels around, and so not as good as true ones beside a crease. */
static double least_decibels(const quality_case *one, cm_pixel_type type, cm_filter filter,
                             const quality *measured, int where)
{
    const double inside = decibels(measured->sum[INSIDE], measured->count[INSIDE]);
    const int is_end = where == RIM || where == EDGE || where == CORNER;
    const int has_parabola = is_part(one->from) && is_end;
    const double less = type == CM_PIXEL_U8 ? (has_parabola ? 1.5 : 1.0)
                        : has_parabola      ? 8.0
                        : where == RIM      ? 8.0
                                            : 1.0;
    const double loss = filter == CM_FILTER_BSPLINE5 && type == CM_PIXEL_FLOAT ? 8.0 : 1.0;
    /* a region of few pixels has by chance more of rounding: two standard deviations of a sum of squares */
    const double chance =
        type == CM_PIXEL_U8 ? 8.7 * sqrt(2.0 / (double)measured->count[where]) : 0.0;
    double least = fmin(inside, has_parabola ? 73.0 : 92.0) - less - chance;
    if (measured->ideal_count[where] > 0)
    {
        const double rounding = type == CM_PIXEL_U8 ? pow(0.1, 0.1 * inside) : 0.0;
        const double ideal =
            measured->ideal[where] / (double)measured->ideal_count[where] + rounding;
        least = fmin(least, -10.0 * log10(ideal) - fmax(loss, less) - chance);
    }
    return least;
}

static void check_case(const quality_case *one, cm_pixel_type type, cm_filter filter)
{
    quality measured;
    measure(one->from, one->to, type, filter, &measured);
    ck_assert_uint_gt(measured.count[INSIDE], 1000);
    for (int where = EDGE; where < REGIONS; where++)
    {
        /* the rim of a steep map is wrong, and a spline's coefficients around it, too */
        if (measured.count[where] == 0 ||
            (is_steep(one->from) && (where == RIM || filter == CM_FILTER_BSPLINE5)))
        {
            continue;
        }
        const double found = decibels(measured.sum[where], measured.count[where]);
        const double least = least_decibels(one, type, filter, &measured, where);
        REQUIRE(found > least, "%s, %s, %s: %.2f dB, not %.2f; inside %.2f", one->from,
                cm_filter_name(filter), region_names[where], found, least,
                decibels(measured.sum[INSIDE], measured.count[INSIDE]));
    }
}

START_TEST(test_regions)
{
    static quality_case cases[CASES_MOST];
    const size_t count = find_cases(cases);
    for (size_t i = 0; i < count; i += step_of(5))
    {
        check_case(&cases[i], CM_PIXEL_U8, CM_FILTER_LANCZOS3);
        if (has_all || i % 4 == 0 || strstr(cases[i].from, "qsc") != NULL)
        {
            check_case(&cases[i], CM_PIXEL_FLOAT, CM_FILTER_LANCZOS3);
        }
        for (int type = 0; type < 2 && has_all; type++)
        {
            const cm_pixel_type pixels = type == 0 ? CM_PIXEL_FLOAT : CM_PIXEL_U8;
            check_case(&cases[i], pixels, CM_FILTER_BILINEAR);
            check_case(&cases[i], pixels, CM_FILTER_BSPLINE5);
        }
    }
}
END_TEST

/* ---- table ---- */

static void print_case(const quality_case *one)
{
    static const cm_filter filters[] = {CM_FILTER_BILINEAR, CM_FILTER_LANCZOS3, CM_FILTER_BSPLINE5};
    static const cm_pixel_type types[] = {CM_PIXEL_FLOAT, CM_PIXEL_U8};
    for (size_t f = 0; f < sizeof filters / sizeof *filters; f++)
    {
        for (size_t t = 0; t < sizeof types / sizeof *types; t++)
        {
            quality measured;
            measure(one->from, one->to, types[t], filters[f], &measured);
            printf("%-44s %-9s %-5s", one->from, cm_filter_name(filters[f]),
                   t == 0 ? "float" : "u8");
            int is_low = 0;
            const double inside = decibels(measured.sum[INSIDE], measured.count[INSIDE]);
            for (int where = 0; where < REGIONS; where++)
            {
                if (measured.count[where] == 0)
                {
                    continue;
                }
                const double found = decibels(measured.sum[where], measured.count[where]);
                printf("  %s %.1f", region_names[where], found);
                printf(" (%.1f)", decibels(measured.ideal[where], measured.ideal_count[where]));
                is_low |= found < inside - 1.0;
            }
            printf("%s\n", is_low ? "  LOW" : "");
            fflush(stdout);
        }
    }
}

static void print_table(int count, char **names)
{
    static quality_case cases[CASES_MOST];
    const size_t n = find_cases(cases);
    for (size_t i = 0; i < n; i++)
    {
        int is_wanted = count == 0;
        for (int k = 0; k < count; k++)
        {
            is_wanted |= strstr(cases[i].from, names[k]) != NULL;
        }
        if (is_wanted)
        {
            print_case(&cases[i]);
        }
    }
}

int main(int argc, char **argv)
{
    const TTest *const tests[] = {test_regions, NULL};
    the_scene = scene_waves(16.0 * PI / (2.0 * FACE), 3);
    if (argc > 1 && strcmp(argv[1], "--print") == 0)
    {
        print_table(argc - 2, argv + 2);
        return 0;
    }
    has_all = argc > 1 && strcmp(argv[1], "--all") == 0;
    return run_suite("region quality", tests);
}
