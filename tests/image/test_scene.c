/* SPDX-License-Identifier: MIT
 *
 * Analytic scenes judge pictures; here they are judged: their band, their range, where their surfaces' pixels are, and
 * that measures find an error that was put there.
 */
#include "tests/suite.h"

#include "truth/scene_errors.h"

#define PI 3.14159265358979323846

enum
{
    FACE = 64 /* pixels of the faces here */
};

static const double axis_anywhere[3] = {0.36, -0.48, 0.8};

static void one_value(const analytic_scene *scene, const double d[3], double value[SCENE_CHANNELS])
{
    scene_values(scene, 1, &d[0], &d[1], &d[2], value);
}

static void unit_direction(uint64_t *state, double d[3])
{
    next_direction(state, d);
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int c = 0; c < 3; c++)
    {
        d[c] /= length;
    }
}

/* ---- scenes ---- */

/* The values are those of the C library's cosines, for any number of directions. */
START_TEST(test_waves_are_cosines)
{
    enum
    {
        COUNT = 700
    };
    const analytic_scene scene = scene_waves(0.015, 7);
    static double at[3][COUNT];
    static double values[SCENE_CHANNELS * COUNT];
    uint64_t state = 3;
    for (int i = 0; i < COUNT; i++)
    {
        double d[3];
        unit_direction(&state, d);
        for (int c = 0; c < 3; c++)
        {
            at[c][i] = d[c];
        }
    }
    scene_values(&scene, COUNT, at[0], at[1], at[2], values);
    for (int i = 0; i < COUNT; i++)
    {
        for (int c = 0; c < SCENE_CHANNELS; c++)
        {
            double sum = SCENE_MEAN;
            for (int w = 0; w < SCENE_WAVES; w++)
            {
                const scene_wave *wave = &scene.wave[w];
                const double phase =
                    2.0 * PI *
                    (wave->k[0] * at[0][i] + wave->k[1] * at[1][i] + wave->k[2] * at[2][i]);
                sum += wave->cosine[c] * cos(phase) - wave->sine[c] * sin(phase);
            }
            ck_assert_msg(fabs(values[SCENE_CHANNELS * i + c] - sum) < 2e-13, "%d %d: %.17g %.17g",
                          i, c, values[SCENE_CHANNELS * i + c], sum);
        }
    }
}
END_TEST

START_TEST(test_range)
{
    uint64_t state = 5;
    const analytic_scene scenes[] = {scene_waves(0.015, 1), scene_waves(0.2, 2),
                                     scene_zone_plate(axis_anywhere, 3.0, 7.0)};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++)
    {
        double lowest = 1.0;
        double highest = 0.0;
        for (int i = 0; i < 20000; i++)
        {
            double d[3];
            double value[SCENE_CHANNELS];
            unit_direction(&state, d);
            one_value(&scenes[s], d, value);
            for (int c = 0; c < SCENE_CHANNELS; c++)
            {
                lowest = fmin(lowest, value[c]);
                highest = fmax(highest, value[c]);
            }
        }
        /* within, and no plain of one grey */
        ck_assert_msg(lowest >= SCENE_LOWEST && highest <= SCENE_HIGHEST, "%zu: %g to %g", s,
                      lowest, highest);
        ck_assert_msg(highest - lowest > 0.4, "%zu: %g to %g", s, lowest, highest);
    }
}
END_TEST

/* Samples along a great circle, from a direction towards one at a right angle to it. */
static void circle_values(const analytic_scene *scene, uint64_t *state, size_t n, double *values)
{
    double a[3];
    double b[3];
    double product = 0.0;
    unit_direction(state, a);
    unit_direction(state, b);
    for (int c = 0; c < 3; c++)
    {
        product += a[c] * b[c];
    }
    const double length = sqrt(1.0 - product * product);
    for (size_t i = 0; i < n; i++)
    {
        const double t = 2.0 * PI * (double)i / (double)n;
        double d[3];
        double value[SCENE_CHANNELS];
        for (int c = 0; c < 3; c++)
        {
            d[c] = cos(t) * a[c] + sin(t) * (b[c] - product * a[c]) / length;
        }
        one_value(scene, d, value);
        values[i] = value[0];
    }
}

/* The amplitude of the harmonic of so many periods around a circle. */
static double harmonic(const double *values, size_t n, size_t periods)
{
    double cosine = 0.0;
    double sine = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        const double phase = 2.0 * PI * (double)(i * periods % n) / (double)n;
        cosine += values[i] * cos(phase);
        sine += values[i] * sin(phase);
    }
    return 2.0 * hypot(cosine, sine) / (double)n;
}

/* Around great circles there is nothing beyond the band, whose end is reached; and second differences are no steeper
 * than it allows: along a great circle a wave's second derivative is within |k|^2 + |k| of its amplitude. */
START_TEST(test_band)
{
    enum
    {
        COUNT = 512,
        PERIODS = 64
    };
    static double values[COUNT];
    uint64_t state = 11;
    double within = 0.0;
    const double k = PERIODS;
    const double step = 2.0 * PI / COUNT;
    const analytic_scene scene = scene_waves(2.0 * PI / PERIODS, 4);
    for (int circle = 0; circle < 40; circle++)
    {
        circle_values(&scene, &state, COUNT, values);
        for (size_t periods = PERIODS + 60; periods < COUNT / 2; periods += step_of(16))
        {
            const double beyond = harmonic(values, COUNT, periods);
            ck_assert_msg(beyond < 1e-13, "%zu periods: %g", periods, beyond);
        }
        for (size_t periods = PERIODS * 3 / 4; periods <= PERIODS; periods++)
        {
            within = fmax(within, harmonic(values, COUNT, periods));
        }
        for (size_t i = 0; i < COUNT; i++)
        {
            const double second =
                values[i] - 2.0 * values[(i + 1) % COUNT] + values[(i + 2) % COUNT];
            ck_assert_double_le(fabs(second), SCENE_AMPLITUDE * (k * k + k) * step * step);
        }
    }
    ck_assert_double_gt(within, 0.25 * SCENE_AMPLITUDE / SCENE_WAVES);
}
END_TEST

/* The same seed makes the same scene, another one another; 0 is a seed. */
START_TEST(test_seeds)
{
    const double d[3] = {0.6, 0.0, 0.8};
    double value[4][SCENE_CHANNELS];
    const unsigned seeds[4] = {1, 1, 2, 0};
    for (int i = 0; i < 4; i++)
    {
        const analytic_scene scene = scene_waves(0.1, seeds[i]);
        one_value(&scene, d, value[i]);
    }
    ck_assert_double_eq(value[0][0], value[1][0]);
    ck_assert_double_eq(value[0][0], value[3][0]);
    ck_assert_double_ne(value[0][0], value[2][0]);
    ck_assert_double_ne(value[0][0], value[0][1]);
}
END_TEST

/* A plate's rings are circles around its axis and grow denser as is said. */
START_TEST(test_zone_plate)
{
    const double f = 5.0;
    const double g = 3.0;
    const double twice[3] = {0.72, -0.96, 1.6};
    const analytic_scene plate = scene_zone_plate(twice, f, g);
    uint64_t state = 17;
    for (int i = 0; i < 1000; i++)
    {
        double d[3];
        double angle;
        double value[SCENE_CHANNELS];
        unit_direction(&state, d);
        const double t = angle_between(d, axis_anywhere);
        const double cycles = scene_cycles(&plate, d, &angle);
        one_value(&plate, d, value);
        ck_assert_double_le(fabs(angle - t), 1e-14);
        ck_assert_double_le(fabs(cycles - (f * t + 0.5 * g * t * t)), 1e-12);
        for (int c = 0; c < SCENE_CHANNELS; c++)
        {
            const double expected = SCENE_MEAN + SCENE_AMPLITUDE * cos(2.0 * PI * cycles);
            ck_assert_double_le(fabs(value[c] - expected), 1e-12);
        }
    }
}
END_TEST

/* ---- surfaces ---- */

static const scene_widths no_widths = {0.0, 0.0, 0.0, 0.0};

START_TEST(test_equirect)
{
    const scene_size size = {8, 4};
    const scene_surface surface = scene_equirect(&size, no_widths);
    double at[3][8];
    for (size_t row = 0; row < 4; row++)
    {
        surface.directions(surface.user, 0, row, at[0], at[1], at[2]);
        for (size_t i = 0; i < 8; i++)
        {
            const double lon = -157.5 + 45.0 * (double)i;
            const double lat = 67.5 - 45.0 * (double)row;
            ck_assert_double_le(fabs(atan2(at[1][i], at[0][i]) * 180.0 / PI - lon), 1e-12);
            ck_assert_double_le(fabs(asin(at[2][i]) * 180.0 / PI - lat), 1e-12);
        }
    }
}
END_TEST

/* The pixels of faces are where their mapping has them, their rows as the frame has them. */
START_TEST(test_faces)
{
    const char *const names[] = {"gnomonic", "coupled", "qsc"};
    for (size_t f = 0; f < cm_frame_count(); f++)
    {
        for (size_t m = 0; m < sizeof names / sizeof *names; m++)
        {
            cm_mapping *mapping = make_mapping(names[m], cm_frame_at(f));
            const scene_cube cube = {mapping, 5};
            const scene_surface surface = scene_faces(&cube, no_widths);
            double at[3][5];
            for (size_t line = 0; line < 30; line++)
            {
                surface.directions(surface.user, line / 5, line % 5, at[0], at[1], at[2]);
                for (size_t i = 0; i < 5; i++)
                {
                    const double d[3] = {at[0][i], at[1][i], at[2][i]};
                    double uv[2];
                    ck_assert_uint_eq(cm_forward(mapping, d, uv), line / 5);
                    const double v = cm_frame_at(f)->first_row_v * (0.8 - 0.4 * (double)(line % 5));
                    ck_assert_double_le(fabs(uv[0] - (-0.8 + 0.4 * (double)i)), 1e-14);
                    ck_assert_double_le(fabs(uv[1] - v), 1e-14);
                }
            }
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* The angle from a direction to the nearest of the cube's edges, by points of them; 1e-3 apart at most. */
static double angle_to_edges(const double d[3])
{
    double least = PI;
    for (int edge = 0; edge < 12; edge++)
    {
        for (int i = 0; i <= 1500; i++)
        {
            const double along = -1.0 + 2.0 * i / 1500.0;
            const int axis = edge / 4;
            double point[3];
            point[axis] = along;
            point[(axis + 1) % 3] = edge % 2 == 0 ? 1.0 : -1.0;
            point[(axis + 2) % 3] = edge / 2 % 2 == 0 ? 1.0 : -1.0;
            least = fmin(least, angle_between(d, point));
        }
    }
    return least;
}

static void check_region(unsigned regions, scene_region region, double angle, double width)
{
    /* points of edges are up to 1e-3 apart: what is so near the boundary is not asked */
    if (fabs(angle - width) > 1e-4)
    {
        ck_assert_msg(((regions >> region & 1u) != 0) == (angle < width), "%s at %g, %g wide",
                      scene_region_name(region), angle, width);
    }
}

START_TEST(test_regions)
{
    const scene_widths widths = {0.1, 0.2, 0.3, 0.25};
    uint64_t state = 23;
    int counts[SCENE_REGIONS] = {0};
    for (size_t i = 0; i < 400; i += step_of(8))
    {
        double d[3];
        unit_direction(&state, d);
        const unsigned regions = scene_regions_of_direction(&widths, d);
        const double corner[3] = {copysign(1.0, d[0]), copysign(1.0, d[1]), copysign(1.0, d[2])};
        const double pole[3] = {0.0, 0.0, copysign(1.0, d[2])};
        const double meridian[3] = {-fabs(d[0]), 0.0, d[2]};
        check_region(regions, SCENE_SEAM, angle_to_edges(d), widths.seam);
        check_region(regions, SCENE_CORNER, angle_between(d, corner), widths.corner);
        check_region(regions, SCENE_POLE, angle_between(d, pole), widths.pole);
        check_region(regions, SCENE_DATELINE, d[0] < 0.0 ? angle_between(d, meridian) : PI,
                     widths.dateline);
        for (int region = 0; region < SCENE_REGIONS; region++)
        {
            counts[region] += (regions >> region & 1u) != 0;
        }
    }
    ck_assert_int_eq(counts[SCENE_ALL] + counts[SCENE_INTERIOR], 0);
    for (int region = SCENE_SEAM; region < SCENE_REGIONS && !is_quick(); region++)
    {
        ck_assert_msg(counts[region] > 4, "%s", scene_region_name((scene_region)region));
    }
}
END_TEST

/* ---- measures ---- */

/* Six faces in a strip, of any type. */
typedef struct strip
{
    cm_mapping *mapping;
    scene_cube cube;
    scene_surface surface;
    float memory[6 * FACE * FACE * SCENE_CHANNELS];
    void *plane[6];
    scene_pictures pictures;
} strip;

static strip the_strip;

static strip *make_strip(const analytic_scene *scene, scene_type type)
{
    strip *s = &the_strip;
    const size_t bytes = type == SCENE_U8 ? 1 : type == SCENE_U16 ? 2 : 4;
    s->mapping = make_mapping("gnomonic", cm_frame_find("geo"));
    s->cube.mapping = s->mapping;
    s->cube.size = FACE;
    s->surface = scene_faces(&s->cube, scene_widths_of_pixels(3.0, 2.0 / FACE));
    for (size_t p = 0; p < 6; p++)
    {
        s->plane[p] = (unsigned char *)s->memory + p * FACE * SCENE_CHANNELS * bytes;
    }
    s->pictures.type = type;
    s->pictures.row_bytes = 6 * FACE * SCENE_CHANNELS * bytes;
    s->pictures.plane = s->plane;
    ck_assert_int_eq(scene_fill(scene, &s->surface, &s->pictures), 1);
    return s;
}

static float *value_of(strip *s, size_t plane, size_t row, size_t column, size_t channel)
{
    return &s->memory[((row * 6 + plane) * FACE + column) * SCENE_CHANNELS + channel];
}

static void measure_strip(const analytic_scene *scene, strip *s, scene_errors *errors)
{
    ck_assert_int_eq(scene_measure(scene, &s->surface, &s->pictures, errors), 1);
    cm_mapping_destroy(s->mapping);
}

/* Rounding is all the error there is: a variance of 1/12 of a unit squared. */
START_TEST(test_rounding)
{
    const analytic_scene scene = scene_waves(0.3, 9);
    const double expected[] = {20.0 * log10(255.0) + 10.0 * log10(12.0),
                               20.0 * log10(65535.0) + 10.0 * log10(12.0)};
    for (int type = SCENE_U8; type <= SCENE_U16; type++)
    {
        scene_errors errors;
        measure_strip(&scene, make_strip(&scene, (scene_type)type), &errors);
        const double found = scene_decibels(&errors.region[SCENE_ALL]);
        ck_assert_msg(fabs(found - expected[type]) < 0.1, "%g dB", found);
        ck_assert_double_le(errors.region[SCENE_ALL].worst,
                            0.5 / (type == SCENE_U8 ? 255.0 : 65535.0) + 1e-12);
    }
}
END_TEST

/* An error that was put into one value is found, as large as it is, where it is, in its regions and in no other. */
START_TEST(test_error_found)
{
    static const struct
    {
        size_t plane;
        size_t row;
        size_t column;
        unsigned regions;
    } places[] = {
        {0, 32, 32, 0},
        {1, 30, 63, 1u << SCENE_SEAM},
        {3, 0, 0, 1u << SCENE_SEAM | 1u << SCENE_CORNER},
        {4, 32, 32, 1u << SCENE_POLE},
        {4, 31, 32, 1u << SCENE_POLE | 1u << SCENE_DATELINE},
        {2, 20, 31, 1u << SCENE_DATELINE},
        {2, 0, 32, 1u << SCENE_SEAM | 1u << SCENE_DATELINE},
    };
    const analytic_scene scene = scene_waves(0.3, 9);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        strip *s = make_strip(&scene, SCENE_FLOAT);
        scene_errors errors;
        const size_t plane = places[i].plane;
        *value_of(s, plane, places[i].row, places[i].column, 1) -= 0.25f;
        measure_strip(&scene, s, &errors);
        for (int region = 0; region < SCENE_REGIONS; region++)
        {
            const scene_error *e = &errors.region[region];
            const int is_in = region == SCENE_ALL ||
                              (region == SCENE_INTERIOR ? places[i].regions == 0
                                                        : (places[i].regions >> region & 1u) != 0);
            ck_assert_uint_gt(e->count, 0);
            ck_assert_uint_eq(e->missing, 0);
            if (!is_in)
            {
                ck_assert_msg(scene_decibels(e) > 140.0, "%zu %s", i,
                              scene_region_name((scene_region)region));
                continue;
            }
            ck_assert_double_le(fabs(e->worst - 0.25), 1e-6);
            ck_assert(e->plane == plane && e->row == places[i].row &&
                      e->column == places[i].column && e->channel == 1);
            const double expected = 10.0 * log10((double)e->count / 0.0625);
            ck_assert_msg(fabs(scene_decibels(e) - expected) < 1e-4, "%g %g", scene_decibels(e),
                          expected);
        }
        ck_assert_uint_eq(errors.region[SCENE_ALL].count, 6 * FACE * FACE * SCENE_CHANNELS);
    }
}
END_TEST

/* What is NaN is missing, and said so; nothing compared is no decibel. */
START_TEST(test_missing)
{
    const analytic_scene scene = scene_waves(0.3, 9);
    strip *s = make_strip(&scene, SCENE_FLOAT);
    scene_errors errors;
    const scene_error nothing = {0};
    *value_of(s, 5, 3, 4, 2) = NAN;
    measure_strip(&scene, s, &errors);
    ck_assert_uint_eq(errors.region[SCENE_ALL].missing, 1);
    ck_assert_uint_eq(errors.region[SCENE_ALL].count, 6 * FACE * FACE * SCENE_CHANNELS - 1);
    ck_assert_double_gt(scene_decibels(&errors.region[SCENE_ALL]), 140.0);
    ck_assert(isnan(scene_decibels(&nothing)));
}
END_TEST

/* A surface of one's own: the left half of a picture, the right half shows nothing, and every second row is a seam. */
static void half_directions(const void *user, size_t plane, size_t row, double *x, double *y,
                            double *z)
{
    const scene_surface whole = scene_equirect(user, no_widths);
    whole.directions(user, plane, row, x, y, z);
    for (size_t i = whole.width / 2; i < whole.width; i++)
    {
        x[i] = y[i] = z[i] = NAN;
    }
}

static void striped_regions(const void *user, size_t plane, size_t row, unsigned *regions)
{
    const scene_size *size = user;
    (void)plane;
    for (size_t i = 0; i < size->width; i++)
    {
        regions[i] = row % 2 == 0 ? 0u : 1u << SCENE_SEAM;
    }
}

START_TEST(test_own_surface)
{
    const scene_size size = {16, 8};
    const scene_surface surface = {1, 16, 8, &size, half_directions, striped_regions, no_widths};
    const analytic_scene scene = scene_waves(0.5, 9);
    static uint16_t memory[8][16][SCENE_CHANNELS];
    void *plane[1] = {memory};
    const scene_pictures pictures = {SCENE_U16, 0, plane};
    scene_errors errors;
    ck_assert_int_eq(scene_fill(&scene, &surface, &pictures), 1);
    ck_assert_uint_eq(memory[2][8][0], 0);
    ck_assert_uint_gt(memory[2][7][0], 0);
    memory[1][2][0] ^= 0x8000;
    ck_assert_int_eq(scene_measure(&scene, &surface, &pictures, &errors), 1);
    ck_assert_uint_eq(errors.region[SCENE_ALL].count, 8 * 8 * SCENE_CHANNELS);
    ck_assert_uint_eq(errors.region[SCENE_INTERIOR].count, 4 * 8 * SCENE_CHANNELS);
    ck_assert_uint_eq(errors.region[SCENE_SEAM].count, 4 * 8 * SCENE_CHANNELS);
    ck_assert_double_gt(errors.region[SCENE_SEAM].worst, 0.4);
    ck_assert_double_lt(errors.region[SCENE_INTERIOR].worst, 1e-5);
}
END_TEST

/* ---- the zone plate ---- */

/* What is left of a plate, when its picture is made weaker by a factor. */
static scene_response weakened(const analytic_scene *plate, strip *s, float factor, double low,
                               double high)
{
    scene_response response;
    for (size_t i = 0; i < sizeof s->memory / sizeof *s->memory; i++)
    {
        s->memory[i] = (float)SCENE_MEAN + factor * (s->memory[i] - (float)SCENE_MEAN);
    }
    ck_assert_int_eq(scene_measure_plate(plate, &s->surface, &s->pictures, low, high, &response),
                     1);
    return response;
}

START_TEST(test_plate_response)
{
    /* a quarter of a cycle a pixel in the middle of faces, less elsewhere */
    const analytic_scene plate = scene_zone_plate(axis_anywhere, 0.25 * FACE / 2.0, 0.0);
    const float factors[] = {1.0f, 0.5f, 0.0f, -0.125f};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++)
    {
        strip *s = make_strip(&plate, SCENE_FLOAT);
        const scene_response r = weakened(&plate, s, factors[i], 0.1, 0.25);
        ck_assert_uint_gt(r.count, 6 * FACE * FACE / 2);
        ck_assert_msg(fabs(r.gain - (double)factors[i]) < 1e-6, "%g", r.gain);
        ck_assert_msg(fabs(r.deviation - fabs((double)factors[i]) * sqrt(0.5)) < 0.01, "%g",
                      r.deviation);
        cm_mapping_destroy(s->mapping);
    }
}
END_TEST

/* Which pixels count: rings around the pole, whose frequency is that of rows. */
START_TEST(test_plate_frequency)
{
    enum
    {
        ROWS = 90
    };
    const double pole[3] = {0.0, 0.0, 1.0};
    const double row = PI / ROWS;
    const scene_size size = {2 * ROWS, ROWS};
    const scene_surface surface = scene_equirect(&size, no_widths);
    static float memory[ROWS * 2 * ROWS * SCENE_CHANNELS];
    void *plane[1] = {memory};
    const scene_pictures pictures = {SCENE_FLOAT, 0, plane};
    /* from 0 at the north pole to 8 cycles a row at the south pole */
    const analytic_scene plate = scene_zone_plate(pole, 0.0, 8.0 / (row * PI));
    scene_response r;
    ck_assert_int_eq(scene_fill(&plate, &surface, &pictures), 1);
    ck_assert_int_eq(scene_measure_plate(&plate, &surface, &pictures, 2.0, 4.0, &r), 1);
    /* a quarter of the rows, from a quarter of the way */
    ck_assert_msg(fabs((double)r.count / (2 * ROWS) - ROWS / 4.0) <= 1.0, "%zu", r.count);
    ck_assert_double_le(fabs(r.gain - 1.0), 1e-6);
    ck_assert_int_eq(scene_measure_plate(&plate, &surface, &pictures, 9.0, 10.0, &r), 1);
    ck_assert_uint_eq(r.count, 0);
    ck_assert(isnan(r.gain) && isnan(r.deviation));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_waves_are_cosines, test_range,           test_band,    test_seeds,
        test_zone_plate,        test_equirect,        test_faces,   test_regions,
        test_rounding,          test_error_found,     test_missing, test_own_surface,
        test_plate_response,    test_plate_frequency, NULL};
    return run_suite("scene", tests);
}
