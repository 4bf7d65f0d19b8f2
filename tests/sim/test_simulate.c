/* SPDX-License-Identifier: MIT
 *
 * Time-of-flight cameras by direct light: against formulas worked out by hand, beside themselves, and what is refused.
 */
#include "tof_stage.h"

#include <stdlib.h>

/* Lambers, Hoberg and Kolb 2015, eqs. 4 to 15, with electrons as photons times efficiency. */
START_TEST(the_middle_of_a_wall_is_as_worked_out_by_hand)
{
    stage at = make_stage(&wall, 1);
    const double planck = 6.62607015e-34, light_speed = 299792458.0, range = 1.7;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const double radiant_intensity = 0.7 / (4.0 * PI);
    const double radiance = 0.6 * radiant_intensity / (range * range) / PI;
    const double irradiance = PI / 4.0 / (1.2 * 1.2) * radiance;
    const double energy = irradiance * 12e-6 * 12e-6 * 5e-3 * 0.5;
    const double electrons = 0.4 * energy * 850e-9 / (planck * light_speed);
    const double shift = 4.0 * PI * range * 20e6 / light_speed;
    const size_t middle = 24 * WIDTH + 32;
    for (int k = 0; k < PHASES; k++)
    {
        const double moved = electrons * 0.8 * cos(0.5 * PI * k + shift);
        const size_t i = (size_t)k * PIXELS + middle;
        ck_assert_double_eq_tol((double)charge_a[i], 0.5 * (electrons + moved), 1e-6 * electrons);
        ck_assert_double_eq_tol((double)charge_b[i], 0.5 * (electrons - moved), 1e-6 * electrons);
        ck_assert_double_eq_tol((double)phase[i], moved, 1e-6 * electrons);
    }
    ck_assert_double_eq_tol((double)distance[middle], range, 1e-6);
    ck_assert_double_eq_tol((double)amplitude[middle], 0.8 * electrons, 1e-6 * electrons);
    ck_assert_double_eq_tol((double)intensity[middle], electrons, 1e-6 * electrons);
    free_stage(&at);
}
END_TEST

/* Beside the axis: cos^4 of the lens, the surface's cosine, and the longer way. */
START_TEST(all_of_a_wall_follows_the_cosines)
{
    stage at = make_stage(&wall, 1);
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const double middle = (double)intensity[24 * WIDTH + 32];
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double y = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double cosine = 1.0 / sqrt(1.0 + x * x + y * y);
        ck_assert_double_eq_tol((double)intensity[i], middle * pow(cosine, 7.0), 1e-6 * middle);
        ck_assert_double_eq_tol((double)distance[i], 1.7 / cosine, 2e-6);
    }
    free_stage(&at);
}
END_TEST

/* Frequencies whose ratio is near that of small numbers are not these: distances are told to where both repeat, or to 1000
 * wraps. Where both would repeat later, and are rounded to decimals of such a ratio, they have it. */
START_TEST(two_frequencies_are_what_they_are)
{
    static const struct
    {
        double frequency, second, distance, told;
    } pairs[] = {{50e6, 50.02e6, 4.0, 4.0},
                 {50e6, 50.02e6, 2900.0, 2900.0},
                 {50.02e6, 50e6, 4.0, 4.0},
                 {1e9, 1.001e9, 4.0, 4.0},
                 {1e9, 1.001e9, 149.0, 149.0},
                 {1.001e9, 1e9, 149.0, 149.0},
                 {50e6, 25.01e6, 100.0, 100.0},
                 {50e6, 100.03e6, 100.0, 100.0},
                 {100.03e6, 50e6, 100.0, 100.0},
                 {20e6, 20.0001e6, 100.0, 100.0},
                 {31.4159e6, 27.1828e6, 900, 900},
                 {80.32e6, 60.24e6, 7.0, 7.0},
                 {20e6, 30e6, 14.5, 14.5},
                 {20e6, 40e6, 7.0, 7.0},
                 {20e6, 20e6, 7.0, 7.0},
                 {100e6, 99e6, 149.0, 149.0},
                 /* a third, and two thirds */
                 {100e6, 33.333e6, 4.4, 4.4},
                 {33.333e6, 100e6, 4.4, 4.4},
                 {66.67e6, 33.33e6, 4.4, 4.4},
                 {100e6, 33.333e6, 6.0, 6.0 - 4.49687},
                 {66.67e6, 33.33e6, 6.0, 6.0 - 4.49687}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        cm_primitive far = wall;
        far.first[2] = pairs[i].distance;
        stage at = make_stage(&far, 1);
        at.sensor.frequency = pairs[i].frequency;
        at.sensor.second_frequency = pairs[i].second;
        at.sensor.harmonics = 0;
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        const double told = (double)distance[24 * WIDTH + 32];
        const double bound =
            pairs[i].told == pairs[i].distance ? 1e-5 + 1e-7 * pairs[i].told : 1e-3;
        REQUIRE(fabs(told - pairs[i].told) <= bound, "%g and %g: %g of %g", pairs[i].frequency,
                pairs[i].second, told, pairs[i].told);
        free_stage(&at);
    }
}
END_TEST

/* Twenty-five pixels are no whole number of vectors: the last one is as the first, on the other side. */
START_TEST(pixels_beyond_whole_vectors_are_as_the_others)
{
    stage at = make_stage(&wall, 1);
    const cm_camera_options shape = {
        .size = sizeof shape, .width = 5, .height = 5, .fx = 4, .fy = 4, .cx = 2, .cy = 2};
    cm_camera_destroy(at.camera);
    ck_assert_int_eq(cm_camera_create(&shape, &at.camera), CM_OK);
    at.sensor.camera = at.camera;
    at.sensor.second_frequency = 15e6;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    for (size_t i = 0; i < 12; i++)
    {
        for (size_t image = 0; image < 2 * PHASES; image++)
        {
            const double here = (double)phase[25 * image + i];
            const double there = (double)phase[25 * image + 24 - i];
            ck_assert_double_eq_tol(here, there, 1e-5 * (double)intensity[i]);
        }
        ck_assert_double_eq_tol((double)distance[i], (double)distance[24 - i], 1e-5);
    }
    free_stage(&at);
}
END_TEST

/* All kinds, seen from outside and inside: as the library cubemap-scene casts rays. */
START_TEST(ranges_are_those_of_the_world)
{
    cm_scene *world = NULL;
    static const char *const names[] = {"room", "corridor", "spheres"};
    for (size_t w = 0; w < 3; w++)
    {
        stage at = make_stage(&wall, 1);
        cm_tof_scene_destroy(at.scene);
        ck_assert_int_eq(cm_scene_create_named(names[w], &world), CM_OK);
        ck_assert_int_eq(cm_tof_scene_create(world, &at.scene), CM_OK);
        at.sensor.frequency = 1e6; /* of 150 m */
        for (int view = 0; view < 4; view++)
        {
            const double stamp = 0.0, place[3] = {0.1, -0.2, 1.2};
            const double turn[4][4] = {{0.5, -0.5, 0.5, -0.5},
                                       {-0.5, 0.5, 0.5, -0.5},
                                       {0.70710678118654752, 0, 0, -0.70710678118654752},
                                       {0.1, 0.7, -0.7, 0.1}};
            cm_pose pose;
            cm_trajectory *trajectory = NULL;
            ck_assert_int_eq(cm_pose_from_quaternion(place, turn[view], &pose), CM_OK);
            ck_assert_int_eq(cm_trajectory_create(1, &stamp, &pose, &trajectory, NULL), CM_OK);
            cm_tof_result result = whole_result();
            ck_assert_int_eq(cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, trajectory, 0.0,
                                             NULL, NULL, &result),
                             CM_OK);
            for (size_t i = 0; i < PIXELS; i++)
            {
                double ray[3] = {((double)(i % WIDTH) - 32.0) / 50.0,
                                 ((double)(i / WIDTH) - 24.0) / 50.0, 1.0};
                const double length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + 1.0);
                double truth;
                const cm_hit_arrays hit = {.size = sizeof hit, .distance = &truth};
                cm_rotate_back(&pose.rotation, ray, ray);
                cm_scene_cast_array(world, 1, &place[0], &place[1], &place[2], &ray[0], &ray[1],
                                    &ray[2], &hit);
                if (truth * length < 140.0)
                {
                    ck_assert_double_eq_tol((double)distance[i], truth * length, 2e-5);
                    ck_assert_uint_eq(flags[i] & CM_TOF_NOTHING, 0);
                }
                else if (!(truth < INFINITY))
                {
                    ck_assert(isnan(distance[i]));
                    ck_assert_uint_eq(flags[i] & CM_TOF_NOTHING, CM_TOF_NOTHING);
                }
            }
            cm_trajectory_destroy(trajectory);
        }
        cm_scene_destroy(world);
        free_stage(&at);
    }
}
END_TEST

/* A light with a table: its power is what it was, and the table's shape is followed. */
START_TEST(tables_of_intensity_keep_the_power)
{
    stage at = make_stage(&wall, 1);
    const float even[3] = {2.0f, 2.0f, 2.0f};
    float cosine[91];
    static const double apertures[] = {1e-6, 1e-4, 1.4};
    double without = 0.0;
    at.light.intensity = even;
    for (size_t i = 0; i < sizeof apertures / sizeof *apertures; i++)
    {
        at.light.aperture = apertures[i];
        at.light.n = 0;
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        without = (double)intensity[24 * WIDTH + 32];
        at.light.n = 3;
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        ck_assert_double_gt(without, 0.0);
        ck_assert_double_eq_tol((double)intensity[24 * WIDTH + 32], without, 1e-6 * without);
    }
    /* I = I0 cos(theta) over half of the sphere has I0 = power / pi */
    for (int i = 0; i < 91; i++)
    {
        cosine[i] = (float)cos(PI / 180.0 * i);
    }
    at.light.aperture = PI;
    at.light.n = 91;
    at.light.intensity = cosine;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const double expected = without / (0.7 / (2.0 * PI * (1.0 - cos(0.7)))) * (0.7 / PI);
    ck_assert_double_eq_tol((double)intensity[24 * WIDTH + 32], expected, 1e-4 * expected);
    free_stage(&at);
}
END_TEST

/* Rims of cones are edges: samples where they are needed see what all samples see, of spots between pixels' middles, too. */
START_TEST(rims_of_cones_are_sampled)
{
    static const double apertures[] = {0.6, 0.008};
    static float full[PIXELS], bright[PIXELS];
    for (size_t n = 0; n < sizeof apertures / sizeof *apertures; n++)
    {
        stage at = make_stage(&wall, 1);
        cm_tof_options options = {
            .size = sizeof options, .sample_columns = 9, .sample_rows = 9, .full = 1};
        float most = 0.0f;
        at.light.position[0] = 0.3;
        at.light.direction[0] = -0.166;
        at.light.direction[1] = 0.01;
        at.light.direction[2] = 1.0;
        at.light.aperture = apertures[n];
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        memcpy(full, distance, sizeof full);
        memcpy(bright, amplitude, sizeof bright);
        options.full = 0;
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            most = fmaxf(most, bright[i]);
        }
        ck_assert_float_gt(most, 0.0f);
        for (size_t i = 0; i < PIXELS; i++)
        {
            REQUIRE(isnan(distance[i]) == isnan(full[i]) &&
                        !(fabsf(distance[i] - full[i]) > 1e-4f) &&
                        fabsf(amplitude[i] - bright[i]) < 1e-4f * most,
                    "cone of %g, pixel %zu: %g and %g, not %g and %g", apertures[n], i,
                    (double)distance[i], (double)amplitude[i], (double)full[i], (double)bright[i]);
        }
        free_stage(&at);
    }
}
END_TEST

/* Beside the camera a light throws shadows. */
START_TEST(a_light_beside_the_camera_throws_a_shadow)
{
    const cm_primitive both[2] = {wall,
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_SPHERE,
                                   .first = {0, 0, 1.0},
                                   .radius = 0.1,
                                   .material = {{1, 1, 1}, 1.0}}};
    stage at = make_stage(both, 2);
    at.light.position[0] = -0.5;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    /* the shadow's middle on the wall is at x = 0.35, column 32 + 50 * 0.35 / 1.7 */
    ck_assert_float_eq(intensity[24 * WIDTH + 42], 0.0f);
    ck_assert_float_gt(intensity[24 * WIDTH + 58], 0.0f);
    ck_assert_float_gt(intensity[24 * WIDTH + 20], 0.0f);
    free_stage(&at);
}
END_TEST

START_TEST(shot_noise_has_the_spread_that_the_formula_gives)
{
    stage at = make_stage(&wall, 1);
    const size_t middle = 24 * WIDTH + 32;
    at.light.power = 0.02;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const double electrons = (double)intensity[middle];
    const double expected = cm_tof_noise_of_distance(&at.sensor, electrons, 0.0);
    double sum = 0.0, squares = 0.0;
    const int views = 400;
    for (int view = 0; view < views; view++)
    {
        const cm_tof_options options = {
            .size = sizeof options, .noise = 1, .seed = 3, .view = (uint32_t)view};
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        const double error = (double)distance[middle] - 1.7;
        sum += error;
        squares += error * error;
    }
    const double spread = sqrt(squares / views);
    ck_assert_double_eq_tol(spread, expected, 0.1 * expected); /* 400 of them: 3.5 % */
    ck_assert_double_lt(fabs(sum / views), 0.2 * expected);
    /* by hand: c / (4 pi f) sqrt(N) / (sqrt(2) D N) */
    ck_assert_double_eq_tol(
        expected, 299792458.0 / (4.0 * PI * 20e6) / (sqrt(2.0) * 0.8 * sqrt(electrons)), 1e-12);
    free_stage(&at);
}
END_TEST

START_TEST(threads_change_no_bit)
{
    static float kept[2][4 * PIXELS];
    const cm_primitive both[2] = {wall,
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_CYLINDER,
                                   .first = {-0.3, 0.1, 1.2},
                                   .second = {0.4, 0.2, 1.4},
                                   .radius = 0.1,
                                   .material = {{1, 1, 1}, 0.4}}};
    stage at = make_stage(both, 2);
    for (int full = 0; full < 2; full++)
    {
        const cm_tof_options options = {.size = sizeof options,
                                        .sample_columns = 3,
                                        .sample_rows = 3,
                                        .full = full,
                                        .noise = 1};
        const unsigned threads[] = {1, 2, 7};
        for (int t = 0; t < 3; t++)
        {
            cm_pool *pool = NULL;
            ck_assert_int_eq(cm_pool_create(threads[t], &pool), CM_OK);
            cm_tof_result result = {.size = sizeof result, .phase = kept[t > 0]};
            ck_assert_int_eq(cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0,
                                             &options, pool, &result),
                             CM_OK);
            ck_assert_mem_eq(kept[0], kept[t > 0], sizeof kept[0]);
            cm_pool_destroy(pool);
        }
    }
    free_stage(&at);
}
END_TEST

START_TEST(samples_where_needed_are_as_good_as_all)
{
    static float full[PIXELS];
    const cm_primitive many[4] = {wall,
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_CYLINDER,
                                   .first = {-0.6, 0.1, 1.2},
                                   .second = {0.4, 0.2, 1.4},
                                   .radius = 0.004, /* thinner than a pixel */
                                   .material = {{1, 1, 1}, 0.4}},
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_BOX,
                                   .first = {0.1, -0.5, 1.1},
                                   .second = {0.5, -0.2, 1.3},
                                   .material = {{1, 1, 1}, 0.7}},
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_SPHERE,
                                   .first = {-0.4, -0.3, 1.1},
                                   .radius = 0.15,
                                   .material = {{1, 1, 1}, 0.9}}};
    stage at = make_stage(many, 4);
    cm_tof_options options = {
        .size = sizeof options, .sample_columns = 3, .sample_rows = 3, .full = 1};
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    memcpy(full, distance, sizeof full);
    options.full = 0;
    cm_tof_report report = {.size = sizeof report};
    cm_tof_result result = {.size = sizeof result, .distance = distance, .report = &report};
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, &options, NULL, &result),
        CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert_double_eq_tol((double)distance[i], (double)full[i], 1e-4);
    }
    ck_assert_uint_lt(report.oversampled, PIXELS / 2);
    free_stage(&at);
}
END_TEST

/* Half pixels of the same mask: on an even wall both layouts see as much light. */
START_TEST(single_readout_sees_what_dual_readout_sees_on_a_wall)
{
    static float dual[PIXELS];
    stage at = make_stage(&wall, 1);
    const cm_tof_options options = {.size = sizeof options, .sample_columns = 4, .sample_rows = 1};
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    memcpy(dual, intensity, sizeof dual);
    at.sensor.single_readout = 1;
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        /* B is half a pixel to the right */
        ck_assert_double_eq_tol((double)intensity[i], (double)dual[i], 0.03 * (double)dual[i]);
    }
    ck_assert_double_eq_tol((double)distance[24 * WIDTH + 32], 1.7, 1e-3);
    free_stage(&at);
}
END_TEST

START_TEST(two_frequencies_tell_wraps_apart)
{
    cm_primitive far = wall;
    for (int k = 1; k < 12; k++)
    {
        far.first[2] = 2.3 * k; /* 20 MHz repeats at 7.49 m */
        stage at = make_stage(&far, 1);
        at.sensor.second_frequency = 15e6;
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        ck_assert_double_eq_tol((double)distance[24 * WIDTH + 32], far.first[2], 1e-4);
        free_stage(&at);
    }
}
END_TEST

/* A triangle as correlation: wiggles of the size that its third harmonic gives, 1/9 of a turn's sine. */
START_TEST(harmonics_make_distances_wiggle)
{
    const double triangle[5] = {1.0, 0.0, 1.0 / 9.0, 0.0, 1.0 / 25.0};
    double most = 0.0;
    cm_primitive moved = wall;
    for (int k = 0; k < 16; k++)
    {
        moved.first[2] = 1.0 + 0.1 * k;
        stage at = make_stage(&moved, 1);
        at.sensor.harmonics = 5;
        at.sensor.harmonic = triangle;
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        most = fmax(most, fabs((double)distance[24 * WIDTH + 32] - moved.first[2]));
        free_stage(&at);
    }
    const double turn = 299792458.0 / (4.0 * PI * 20e6); /* metres a radian */
    ck_assert_double_gt(most, 0.05 * turn);
    ck_assert_double_lt(most, 0.16 * turn);
}
END_TEST

START_TEST(full_circuits_are_cut_and_flagged)
{
    stage at = make_stage(&wall, 1);
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    at.sensor.full_well = (double)intensity[24 * WIDTH + 32] * 0.6;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    ck_assert_uint_eq(flags[24 * WIDTH + 32] & CM_TOF_SATURATED, CM_TOF_SATURATED);
    ck_assert_uint_eq(flags[0] & CM_TOF_SATURATED, 0);
    for (size_t i = 0; i < PHASES * PIXELS; i++)
    {
        ck_assert_double_le((double)charge_a[i], at.sensor.full_well * (1.0 + 1e-6));
    }
    free_stage(&at);
}
END_TEST

/* What a plane before the camera sends to a place of the picture, by what the middle sends: the angle from the axis counts by
 * its cosine four times at the lens, once on the wall, and twice in the distance. */
static double falls_off(double column, double row)
{
    const double x = (column - 32.0) / 50.0, y = (row - 24.0) / 50.0;
    return pow(1.0 + x * x + y * y, -3.5);
}

/* A mask moves where a pixel looks, and takes light away: in all pixels what the active part sees, which is one of the
 * pixel's halves or corners. */
START_TEST(masks_take_light_away)
{
    static const struct
    {
        uint32_t columns, rows;
        float part[4];
        double x, y; /* middle of the active part */
    } masks[] = {{2, 1, {1, 0}, -0.25, 0},
                 {2, 1, {0, 1}, 0.25, 0},
                 {1, 2, {1, 0}, 0, -0.25},
                 {2, 2, {0, 0, 1, 0}, -0.25, 0.25},
                 {2, 2, {0, 0.5f, 0, 0}, 0.25, -0.25}};
    stage at = make_stage(&wall, 1);
    const cm_tof_options options = {.size = sizeof options, .sample_columns = 2, .sample_rows = 2};
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    const double whole = (double)intensity[24 * WIDTH + 32];
    for (size_t k = 0; k < sizeof masks / sizeof *masks; k++)
    {
        double active = 0.0;
        for (size_t i = 0; i < (size_t)masks[k].columns * masks[k].rows; i++)
        {
            active += (double)masks[k].part[i] / (double)(masks[k].columns * masks[k].rows);
        }
        at.sensor.mask = masks[k].part;
        at.sensor.mask_columns = masks[k].columns;
        at.sensor.mask_rows = masks[k].rows;
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            const double sees =
                active * whole *
                falls_off((double)(i % WIDTH) + masks[k].x, (double)(i / WIDTH) + masks[k].y);
            REQUIRE(fabs((double)intensity[i] - sees) < 1e-3 * active * whole,
                    "mask %zu, pixel %zu: %g, not %g", k, i, (double)intensity[i], sees);
        }
    }
    free_stage(&at);
}
END_TEST

/* In front of a wall a box moves: some pixels are wrong, and flagged; where nothing moves all is as before. */
START_TEST(motion_disturbs_what_moves_alone)
{
    const double stamp[2] = {0.0, 1.0};
    cm_pose key[2];
    const double start[3] = {0, 0, 0}, end[3] = {1.0, 0, 0}, turn[4] = {0, 0, 0, 1};
    ck_assert_int_eq(cm_pose_from_quaternion(start, turn, &key[0]), CM_OK);
    ck_assert_int_eq(cm_pose_from_quaternion(end, turn, &key[1]), CM_OK);
    cm_trajectory *motion = NULL;
    ck_assert_int_eq(cm_trajectory_create(2, stamp, key, &motion, NULL), CM_OK);
    const cm_primitive both[2] = {wall,
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_BOX,
                                   .first = {-0.3, -0.2, 0.8},
                                   .second = {0.0, 0.2, 0.9},
                                   .material = {{1, 1, 1}, 0.4},
                                   .motion = motion}};
    stage at = make_stage(both, 2);
    at.sensor.readout = 5e-3;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    size_t flagged = 0, wrong = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double y = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double depth = (double)distance[i] / sqrt(1.0 + x * x + y * y);
        const int is_wrong = fabs(depth - 1.7) > 1e-3 && fabs(depth - 0.8) > 1e-3;
        wrong += (size_t)is_wrong;
        flagged += flags[i] & CM_TOF_MOTION ? 1 : 0;
        if (is_wrong && depth < 5.0)
        {
            ck_assert(i % WIDTH > 10 && i % WIDTH < 40);
        }
    }
    ck_assert_uint_gt(wrong, 10);
    ck_assert_uint_ge(flagged + 30, wrong);
    free_stage(&at);
    cm_trajectory_destroy(motion);
}
END_TEST

/* A mesh of two triangles is the plane that it lies in, its common edge no crack. */
START_TEST(meshes_are_met_in_double_precision)
{
    const double corner[12] = {-9, -9, 1.7, 9, -9, 1.7, 9, 9, 1.7, -9, 9, 1.7};
    const uint32_t index[6] = {0, 1, 2, 0, 2, 3};
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 4,
                                   .position = corner,
                                   .triangle_count = 2,
                                   .index = index,
                                   .material = {{1, 1, 1}, 1.0}};
    cm_mesh *mesh = NULL;
    static float plane[PIXELS];
    stage first = make_stage(&wall, 1);
    ck_assert_int_eq(simulate(&first, NULL), CM_OK);
    memcpy(plane, distance, sizeof plane);
    free_stage(&first);
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    cm_primitive body = wall;
    body.kind = CM_PRIMITIVE_MESH;
    body.mesh = mesh;
    const cm_pose still = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    body.pose = still;
    stage at = make_stage(&body, 1);
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert_double_eq_tol((double)distance[i], (double)plane[i], 1e-6);
    }
    free_stage(&at);
    cm_mesh_destroy(mesh);
}
END_TEST

static cm_status simulate_changed(const stage *at, const cm_tof_options *options)
{
    cm_tof_options sized = *options;
    sized.size = sizeof sized;
    return simulate(at, &sized);
}

/* Options, and surroundings. */
START_TEST(bad_options_are_refused)
{
    stage at = make_stage(&wall, 1);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    float picture[6] = {1, 1, 1, 1, 1, 1};
    cm_tof_environment around = {
        .size = sizeof around, .mapping = mapping, .edge = 1, .radiance = picture};
    const cm_tof_options out_of_range[] = {
        {.bounces = -1},
        {.bounces = 1001},
        {.lights = (1u << 20) + 1},
        {.paths = UINT32_MAX},
        {.map_edge = 4097},
        {.sample_times = 1001},
        {.sample_columns = UINT32_MAX, .sample_rows = UINT32_MAX},
        {.sample_columns = 65536, .sample_rows = 65536},
        {.shot = 7}};
    for (size_t i = 0; i < sizeof out_of_range / sizeof *out_of_range; i++)
    {
        REQUIRE(simulate_changed(&at, &out_of_range[i]) == CM_ERROR_RANGE, "options %zu", i);
    }
    const cm_tof_options with = {.environment = &around, .paths = 2};
    ck_assert_int_eq(simulate_changed(&at, &with), CM_OK);
    picture[5] = NAN;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_RANGE);
    picture[5] = -1.0f;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_RANGE);
    picture[5] = INFINITY;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_RANGE);
    memset(picture, 0, sizeof picture); /* black: there is nothing to draw */
    ck_assert_int_eq(simulate_changed(&at, &with), CM_OK);
    around.constant = -1.0;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_RANGE);
    around.constant = 0.0;
    around.edge = 0;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_ARGUMENT);
    around.edge = 1;
    around.mapping = NULL;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_ARGUMENT);
    around.mapping = mapping;
    around.size--;
    ck_assert_int_eq(simulate_changed(&at, &with), CM_ERROR_ARGUMENT);
    cm_mapping_destroy(mapping);
    free_stage(&at);
}
END_TEST

/* As the header says. */
START_TEST(phases_and_harmonics_have_a_most)
{
    static const double cosine[33] = {1.0};
    static const float charges[2 * 64] = {0};
    static const struct
    {
        int phases;
        size_t harmonics;
        double second;
        cm_status status;
    } cases[] = {{64, 0, 0, CM_OK},
                 {65, 0, 0, CM_ERROR_RANGE},
                 {64, 16, 15e6, CM_OK},
                 {3, 32, 0, CM_OK},
                 {3, 33, 0, CM_ERROR_RANGE},
                 {3, 16, 15e6, CM_OK},
                 {3, 17, 15e6, CM_ERROR_RANGE},
                 {2, 0, 0, CM_ERROR_RANGE}};
    stage at = make_stage(&wall, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        float told = 0.0f;
        at.sensor.phases = cases[i].phases;
        at.sensor.harmonics = cases[i].harmonics;
        at.sensor.harmonic = cosine;
        at.sensor.second_frequency = cases[i].second;
        const cm_status status =
            cm_tof_reconstruct(&at.sensor, 1, charges, charges, &told, NULL, NULL, NULL);
        REQUIRE(status == cases[i].status, "%d phases, %zu harmonics, %g Hz: %d", cases[i].phases,
                cases[i].harmonics, cases[i].second, (int)status);
    }
    free_stage(&at);
}
END_TEST

START_TEST(bad_input_is_refused)
{
    stage at = make_stage(&wall, 1);
    cm_tof_result result = whole_result();
    const cm_tof_options options = {.size = sizeof options};
    const stage good = at;
    cm_scene *empty = NULL;
    cm_tof_scene *none = NULL;
    const float table[2] = {1.0f, NAN};
    const double not_a_number = NAN;
    ck_assert_int_eq(cm_scene_create(&empty), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(empty, &none), CM_ERROR_DATA);
    ck_assert_int_eq(cm_tof_scene_create(NULL, &none), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_scene_create(empty, NULL), CM_ERROR_ARGUMENT);
    cm_scene_destroy(empty);
#define REFUSES(change, status)                                                                    \
    at = good;                                                                                     \
    change;                                                                                        \
    ck_assert_int_eq(                                                                              \
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, &options, NULL, &result),   \
        status)
    REFUSES(at.scene = NULL, CM_ERROR_ARGUMENT);
    REFUSES(at.sensor.size = 1, CM_ERROR_ARGUMENT);
    REFUSES(at.sensor.camera = NULL, CM_ERROR_ARGUMENT);
    REFUSES(at.sensor.exposure = 0, CM_ERROR_RANGE);
    REFUSES(at.sensor.pitch = NAN, CM_ERROR_RANGE);
    REFUSES(at.sensor.efficiency = 1.5, CM_ERROR_RANGE);
    REFUSES(at.sensor.phases = 2, CM_ERROR_RANGE);
    REFUSES(at.sensor.phases = 65, CM_ERROR_RANGE);
    REFUSES(at.sensor.frequency = -1, CM_ERROR_RANGE);
    REFUSES(at.sensor.contrast = 0, CM_ERROR_RANGE);
    REFUSES(at.sensor.duty = 2, CM_ERROR_RANGE);
    REFUSES(at.light.size = 0, CM_ERROR_ARGUMENT);
    REFUSES(at.light.power = -1, CM_ERROR_RANGE);
    REFUSES(at.light.aperture = 0, CM_ERROR_RANGE);
    REFUSES(at.light.aperture = 9e-7, CM_ERROR_RANGE);
    REFUSES(at.light.aperture = 7, CM_ERROR_RANGE);
    REFUSES((at.light.n = 2, at.light.intensity = table), CM_ERROR_RANGE);
    REFUSES((at.light.n = 2, at.light.intensity = NULL), CM_ERROR_ARGUMENT);
    REFUSES((at.sensor.mask = table, at.sensor.mask_columns = 2, at.sensor.mask_rows = 1),
            CM_ERROR_RANGE);
    REFUSES((at.sensor.harmonics = 1), CM_ERROR_ARGUMENT);
    REFUSES((at.sensor.harmonics = 1, at.sensor.harmonic = &not_a_number), CM_ERROR_RANGE);
    REFUSES((at.sensor.harmonics = SIZE_MAX / 2 + 1, at.sensor.harmonic = &not_a_number,
             at.sensor.second_frequency = 15e6),
            CM_ERROR_RANGE);
    REFUSES(at.sensor.read_noise = 1e31, CM_ERROR_RANGE);
    REFUSES(at.sensor.fixed_pattern = 1001, CM_ERROR_RANGE);
    REFUSES(at.sensor.full_well = NAN, CM_ERROR_RANGE);
    REFUSES(at.sensor.full_well = 0.5, CM_ERROR_RANGE);
    REFUSES(at.sensor.frequency = 1e308, CM_ERROR_RANGE);
    REFUSES(at.sensor.frequency = 999.0, CM_ERROR_RANGE);
    REFUSES(at.sensor.second_frequency = 1e-308, CM_ERROR_RANGE);
    REFUSES(at.sensor.wavelength = 850.0, CM_ERROR_RANGE);
    REFUSES(at.sensor.exposure = 1e300, CM_ERROR_RANGE);
    REFUSES(at.light.position[2] = NAN, CM_ERROR_RANGE);
    at = good;
    ck_assert_int_eq(cm_tof_simulate(at.scene, &at.sensor, NULL, 1, NULL, 0.0, NULL, NULL, &result),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 0, NULL, 0.0, NULL, NULL, &result),
        CM_ERROR_ARGUMENT);
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, NAN, NULL, NULL, &result),
        CM_ERROR_RANGE);
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, NULL, NULL, NULL),
        CM_ERROR_ARGUMENT);
    at = good;
    free_stage(&at);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_middle_of_a_wall_is_as_worked_out_by_hand,
                                  all_of_a_wall_follows_the_cosines,
                                  pixels_beyond_whole_vectors_are_as_the_others,
                                  two_frequencies_are_what_they_are,
                                  ranges_are_those_of_the_world,
                                  tables_of_intensity_keep_the_power,
                                  rims_of_cones_are_sampled,
                                  a_light_beside_the_camera_throws_a_shadow,
                                  shot_noise_has_the_spread_that_the_formula_gives,
                                  threads_change_no_bit,
                                  samples_where_needed_are_as_good_as_all,
                                  single_readout_sees_what_dual_readout_sees_on_a_wall,
                                  two_frequencies_tell_wraps_apart,
                                  harmonics_make_distances_wiggle,
                                  full_circuits_are_cut_and_flagged,
                                  masks_take_light_away,
                                  motion_disturbs_what_moves_alone,
                                  meshes_are_met_in_double_precision,
                                  phases_and_harmonics_have_a_most,
                                  bad_input_is_refused,
                                  bad_options_are_refused,
                                  NULL};
    return run_suite("simulate", tests);
}
