/* SPDX-License-Identifier: MIT
 *
 * Motion in field-sequential pictures: what schemes ask for, pictures moved by flows that are known, and sequences whose motion
 * is taken out again.
 */
#include <cubemap/compensate.h>

#include "tests/suite.h"

enum
{
    WIDTH = 37,
    HEIGHT = 29,
    PIXELS = WIDTH * HEIGHT,
    CHANNELS_MOST = 6,
    MARGIN = 9
};

/* ---- pictures of which the cubic loses nothing ---- */

/* Up to the second degree: Keys's cubic is exact there. */
static double surface_at(double x, double y)
{
    return 3.0 + 0.5 * x - 0.25 * y + 0.03 * x * x - 0.02 * x * y + 0.01 * y * y;
}

static void draw_surface(double dx, double dy, double gain, float *picture)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        picture[i] = (float)(gain * surface_at((double)(i % WIDTH) - dx, (double)(i / WIDTH) - dy));
    }
}

static void fill_flow(double dx, double dy, float *flow)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        flow[2 * i] = (float)dx;
        flow[2 * i + 1] = (float)dy;
    }
}

static int is_inner(size_t i, size_t margin)
{
    const size_t column = i % WIDTH, row = i / WIDTH;
    return column >= margin && column < WIDTH - margin && row >= margin && row < HEIGHT - margin;
}

static void expect_surface(const float *picture, double dx, double dy, double gain,
                           const char *what)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double right = gain * surface_at((double)(i % WIDTH) - dx, (double)(i / WIDTH) - dy);
        ck_assert_msg(!is_inner(i, MARGIN) ||
                          fabs((double)picture[i] - right) < 2e-5 * fabs(gain) * 60,
                      "%s: %g at %zu, not %g", what, (double)picture[i], i, right);
    }
}

/* ---- moving ---- */

START_TEST(whole_steps_keep_the_bits)
{
    static float picture[PIXELS], flow[2 * PIXELS], moved[PIXELS], coverage[PIXELS];
    for (size_t i = 0; i < PIXELS; i++)
    {
        picture[i] = (float)((i * 7919) % 1009) * 0.37f;
    }
    fill_flow(6.0, -4.0, flow);
    ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, 0.5, moved, coverage), CM_OK);
    for (size_t row = 0; row < HEIGHT; row++)
    {
        for (size_t column = 0; column < WIDTH; column++)
        {
            const size_t i = row * WIDTH + column;
            const int is_there = column >= 3 && row + 2 < HEIGHT;
            ck_assert(coverage[i] == (is_there ? 1.0f : 0.0f));
            ck_assert(!is_there || moved[i] == picture[(row + 2) * WIDTH + column - 3]);
        }
    }
}
END_TEST

START_TEST(parts_of_steps_are_exact)
{
    static float picture[PIXELS], flow[2 * PIXELS], moved[PIXELS];
    draw_surface(0.0, 0.0, 1.0, picture);
    fill_flow(4.3, -2.7, flow);
    const double parts[] = {0.0, 0.25, 0.5, 1.0, -0.75};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
    {
        ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, parts[k], moved, NULL), CM_OK);
        expect_surface(moved, 4.3 * parts[k], -2.7 * parts[k], 1.0, "part");
    }
}
END_TEST

/* A turn by 0.1 about the middle: the flow itself is carried along. */
START_TEST(turns_are_followed)
{
    static float picture[PIXELS], flow[2 * PIXELS], moved[PIXELS], coverage[PIXELS];
    const double c = cos(0.1), s = sin(0.1), x0 = 18.0, y0 = 14.0;
    draw_surface(0.0, 0.0, 1.0, picture);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = (double)(i % WIDTH) - x0, y = (double)(i / WIDTH) - y0;
        flow[2 * i] = (float)(c * x - s * y - x);
        flow[2 * i + 1] = (float)(s * x + c * y - y);
    }
    ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, 1.0, moved, coverage), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = (double)(i % WIDTH) - x0, y = (double)(i / WIDTH) - y0;
        const double right = surface_at(c * x + s * y + x0, -s * x + c * y + y0);
        /* flows of pixels around one differ by 0.1 a pixel, of which the mean makes a third at most */
        ck_assert_msg(!is_inner(i, 5) || fabs((double)moved[i] - right) < 0.08, "%g at %zu, not %g",
                      (double)moved[i], i, right);
        ck_assert(!is_inner(i, 5) || coverage[i] > 0.7f);
    }
}
END_TEST

/* A square before a wall with a pattern. */
static float wall_at(size_t column, size_t row)
{
    return (float)(1.0 + 0.01 * (double)(column * 3 + row * 5));
}
static void draw_square(size_t left, float *picture)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        const size_t column = i % WIDTH, row = i / WIDTH;
        const int is_square = column >= left && column < left + 8 && row >= 10 && row < 18;
        picture[i] = is_square ? 9.0f + (float)(column - left) : wall_at(column, row);
    }
}
static void fill_square_flow(size_t left, double dx, float *flow)
{
    memset(flow, 0, 2 * PIXELS * sizeof *flow);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const size_t column = i % WIDTH, row = i / WIDTH;
        const int is_square = column >= left && column < left + 8 && row >= 10 && row < 18;
        flow[2 * i] = is_square ? (float)dx : 0.0f;
    }
}

START_TEST(the_faster_lies_in_front)
{
    static float picture[PIXELS], flow[2 * PIXELS], moved[PIXELS], coverage[PIXELS], right[PIXELS];
    draw_square(10, picture);
    draw_square(15, right);
    fill_square_flow(10, 5.0, flow);
    ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, 1.0, moved, coverage), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const size_t column = i % WIDTH, row = i / WIDTH;
        const int was_hidden = column >= 10 && column < 15 && row >= 10 && row < 18;
        ck_assert(coverage[i] == (was_hidden ? 0.0f : 1.0f));
        ck_assert_msg(was_hidden || moved[i] == right[i], "%zu %zu", column, row);
        /* what was behind it is made of the wall beside it */
        ck_assert_msg(!was_hidden || moved[i] == wall_at(column - 5, row), "%zu %zu", column, row);
    }
}
END_TEST

START_TEST(unknown_flows_move_nothing)
{
    static float picture[PIXELS], flow[2 * PIXELS], moved[PIXELS], coverage[PIXELS];
    const float bad[] = {NAN, INFINITY, -INFINITY};
    draw_surface(0.0, 0.0, 1.0, picture);
    picture[3 * WIDTH + 7] = NAN;
    for (size_t k = 0; k < 3; k++)
    {
        fill_flow((double)bad[k], 0.0, flow);
        ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, 1.0, moved, coverage), CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            ck_assert(coverage[i] == 0.0f);
            ck_assert(moved[i] == picture[i] || (isnan(moved[i]) && i == 3 * WIDTH + 7));
        }
    }
    fill_flow(3e38, -3e38, flow); /* far away, which is known */
    ck_assert_int_eq(cm_flow_warp(WIDTH, HEIGHT, picture, flow, 1000.0, moved, coverage), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert(coverage[i] == 0.0f && isfinite(moved[i]));
    }
}
END_TEST

/* ---- schemes ---- */

typedef struct asked
{
    cm_compensation scheme;
    uint32_t channels;
    size_t count;
    cm_flow_pair pair[8];
} asked;

START_TEST(schemes_ask_for_flows)
{
    static const asked right[] = {
        {CM_CCM_B, 3, 4, {{-1, 1, 0, 1}, {0, 1, -1, 1}, {-1, 2, 0, 2}, {0, 2, -1, 2}}},
        {CM_CCM_U, 4, 3, {{0, 1, -1, 1}, {0, 2, -1, 2}, {-1, 3, 0, 3}}},
        {CM_CCM_U, 3, 2, {{0, 1, -1, 1}, {-1, 2, 0, 2}}},
        {CM_CCM_2, 4, 2, {{0, 1, -1, 1}, {0, 3, -1, 3}}},
        {CM_CCM_1, 4, 1, {{0, 1, -1, 1}}},
        {CM_NCM, 4, 3, {{0, 1, 0, 0}, {0, 2, 0, 1}, {0, 3, 0, 2}}},
        {CM_NCM_NEAREST, 4, 3, {{0, 1, 0, 0}, {0, 2, 0, 1}, {-1, 3, 0, 0}}},
        {CM_NCM_NEAREST, 5, 4, {{0, 1, 0, 0}, {0, 2, 0, 1}, {-1, 3, -1, 4}, {-1, 4, 0, 0}}},
    };
    for (size_t k = 0; k < sizeof right / sizeof *right; k++)
    {
        cm_flow_pair pair[8];
        size_t count = 0;
        ck_assert_int_eq(cm_compensation_flows(right[k].scheme, right[k].channels, 8, pair, &count),
                         CM_OK);
        ck_assert_uint_eq(count, right[k].count);
        for (size_t i = 0; i < count; i++)
        {
            const cm_flow_pair *a = &pair[i], *b = &right[k].pair[i];
            ck_assert_msg(a->from_frame == b->from_frame && a->from_channel == b->from_channel &&
                              a->to_frame == b->to_frame && a->to_channel == b->to_channel,
                          "%s of %u: flow %zu", cm_compensation_name(right[k].scheme),
                          right[k].channels, i);
        }
    }
}
END_TEST

/* Frames before and now of something that moves, and the true flows. */
typedef struct sequence
{
    float before[CHANNELS_MOST * PIXELS];
    float now[CHANNELS_MOST * PIXELS];
    float flow[2 * CHANNELS_MOST * 2 * PIXELS];
    float corrected[CHANNELS_MOST * PIXELS];
} sequence;

static sequence s;

static double gain_of(uint32_t channel)
{
    return 1.0 + 0.5 * channel - 0.3 * channel * channel;
}

static cm_compensation_input input_of(uint32_t channels, int has_before)
{
    const cm_compensation_input input = {.size = sizeof input,
                                         .width = WIDTH,
                                         .height = HEIGHT,
                                         .channels = channels,
                                         .now = s.now,
                                         .before = has_before ? s.before : NULL,
                                         .flow = s.flow};
    return input;
}

/* So many steps after the reference. */
static int time_of(int frame, uint32_t channel, uint32_t channels)
{
    return frame * (int)channels + (int)channel;
}

static void draw_sequence(uint32_t channels, double dx, double dy)
{
    for (uint32_t w = 0; w < channels; w++)
    {
        const double now = time_of(0, w, channels), before = time_of(-1, w, channels);
        draw_surface(dx * now, dy * now, gain_of(w), s.now + w * PIXELS);
        draw_surface(dx * before, dy * before, gain_of(w), s.before + w * PIXELS);
    }
}

static void draw_flows(cm_compensation scheme, uint32_t channels, double dx, double dy)
{
    cm_flow_pair pair[2 * CHANNELS_MOST];
    size_t count = 0;
    ck_assert_int_eq(cm_compensation_flows(scheme, channels, 2 * CHANNELS_MOST, pair, &count),
                     CM_OK);
    for (size_t i = 0; i < count; i++)
    {
        const int steps = time_of(pair[i].to_frame, pair[i].to_channel, channels) -
                          time_of(pair[i].from_frame, pair[i].from_channel, channels);
        fill_flow(dx * steps, dy * steps, s.flow + 2 * i * PIXELS);
    }
}

START_TEST(schemes_take_motion_out)
{
    for (uint32_t channels = 2; channels <= CHANNELS_MOST; channels++)
    {
        for (int scheme = channels < 4 ? CM_CCM_1 : CM_CCM_B; scheme <= CM_NCM_NEAREST; scheme++)
        {
            const double dx = 0.83, dy = -0.59;
            draw_sequence(channels, dx, dy);
            draw_flows((cm_compensation)scheme, channels, dx, dy);
            const cm_compensation_input input = input_of(channels, scheme != CM_NCM);
            ck_assert_int_eq(cm_compensate(&input, (cm_compensation)scheme, NULL, s.corrected),
                             CM_OK);
            ck_assert_mem_eq(s.corrected, s.now, PIXELS * sizeof *s.now);
            for (uint32_t w = 1; w < channels; w++)
            {
                expect_surface(s.corrected + w * PIXELS, 0.0, 0.0, gain_of(w),
                               cm_compensation_name((cm_compensation)scheme));
            }
        }
    }
}
END_TEST

/* A square goes 4 pixels a frame: at its sides each way sees what the other does not. */
START_TEST(hidden_content_comes_from_where_it_is_seen)
{
    static float right[PIXELS];
    const uint32_t channels = 4, w = 2;
    for (uint32_t k = 0; k < channels; k++)
    {
        draw_square(8, s.before + k * PIXELS);
        draw_square(12, s.now + k * PIXELS);
        fill_square_flow(8, 4.0, s.flow + 4 * k * PIXELS);
        fill_square_flow(12, -4.0, s.flow + (4 * k + 2) * PIXELS);
    }
    const cm_compensation_input input = input_of(channels, 1);
    ck_assert_int_eq(cm_compensate(&input, CM_CCM_B, NULL, s.corrected), CM_OK);
    draw_square(10, right);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert_msg(fabsf(s.corrected[w * PIXELS + i] - right[i]) < 1e-5f, "%zu %zu: %g, not %g",
                      i % WIDTH, i / WIDTH, (double)s.corrected[w * PIXELS + i], (double)right[i]);
    }
}
END_TEST

static uint32_t dice(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

START_TEST(threads_give_the_same_bits)
{
    static float first[CHANNELS_MOST * PIXELS];
    uint32_t state = 5;
    for (size_t i = 0; i < CHANNELS_MOST * PIXELS; i++)
    {
        s.now[i] = dice(&state) % 100 == 0 ? NAN : (float)(dice(&state) % 1000);
        s.before[i] = (float)(dice(&state) % 1000);
    }
    for (size_t i = 0; i < sizeof s.flow / sizeof *s.flow; i++)
    {
        s.flow[i] = dice(&state) % 50 == 0 ? NAN : (float)(dice(&state) % 4000) * 2e-3f - 4.0f;
    }
    const unsigned threads[] = {2, 7};
    for (int scheme = CM_CCM_B; scheme <= CM_NCM_NEAREST; scheme++)
    {
        const cm_compensation_input input = input_of(CHANNELS_MOST, 1);
        ck_assert_int_eq(cm_compensate(&input, (cm_compensation)scheme, NULL, first), CM_OK);
        for (size_t k = 0; k < 2; k++)
        {
            cm_pool *pool = NULL;
            ck_assert_int_eq(cm_pool_create(threads[k], &pool), CM_OK);
            memset(s.corrected, 0, sizeof s.corrected);
            ck_assert_int_eq(cm_compensate(&input, (cm_compensation)scheme, pool, s.corrected),
                             CM_OK);
            ck_assert_mem_eq(s.corrected, first, sizeof first);
            cm_pool_destroy(pool);
        }
    }
}
END_TEST

/* ---- pixel by pixel ---- */

START_TEST(pixels_go_back_to_before)
{
    enum
    {
        N = 5
    };
    /* still; something comes at channel 2; the first has changed already; NaN comes; within the threshold */
    static const float before[4][N] = {
        {1, 1, 1, 1, 1}, {2, 2, 2, 2, 2}, {3, 3, 3, 3, 3}, {4, 4, 4, 4, 4}};
    static const float now[4][N] = {
        {1, 1, 5, 1, 1.5f}, {2, 2, 2, NAN, 1.5f}, {3, 9, 3, 3, 3.5f}, {4, 4.1f, 9, 4, 4}};
    static const float right[4][N] = {
        {1, 1, 5, 1, 1.5f}, {2, 2, 2, 2, 1.5f}, {3, 3, 3, 3, 3.5f}, {4, 4, 9, 4, 4}};
    float corrected[4][N];
    size_t changed = 0;
    const cm_compensation_input input = {.size = sizeof input,
                                         .width = N,
                                         .height = 1,
                                         .channels = 4,
                                         .now = now[0],
                                         .before = before[0]};
    ck_assert_int_eq(cm_compensate_pixelwise(&input, 0.5, corrected[0], &changed), CM_OK);
    ck_assert_uint_eq(changed, 2);
    ck_assert_mem_eq(corrected, right, sizeof right);
    ck_assert_int_eq(cm_compensate_pixelwise(&input, -1.0, corrected[0], NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_compensate_pixelwise(&input, (double)NAN, corrected[0], NULL),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_compensate_pixelwise(NULL, 0.5, corrected[0], NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_compensate_pixelwise(&input, 0.5, NULL, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---- what cannot be ---- */

static void expect_refused(const cm_compensation_input *input, int scheme, cm_status status)
{
    s.corrected[0] = 17.0f;
    ck_assert_int_eq(cm_compensate(input, (cm_compensation)scheme, NULL, s.corrected), status);
    ck_assert(s.corrected[0] == 17.0f);
}

START_TEST(bad_input_is_refused)
{
    const cm_compensation_input good = input_of(4, 1);
    cm_compensation_input input = good;
    expect_refused(NULL, CM_CCM_B, CM_ERROR_ARGUMENT);
    expect_refused(&good, 6, CM_ERROR_ARGUMENT);
    expect_refused(&good, -1, CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_compensate(&good, CM_CCM_B, NULL, NULL), CM_ERROR_ARGUMENT);
    input.size = 0;
    expect_refused(&input, CM_CCM_B, CM_ERROR_ARGUMENT);
    input = good, input.now = NULL;
    expect_refused(&input, CM_CCM_B, CM_ERROR_ARGUMENT);
    input = good, input.flow = NULL;
    expect_refused(&input, CM_CCM_B, CM_ERROR_ARGUMENT);
    input = good, input.before = NULL;
    expect_refused(&input, CM_NCM_NEAREST, CM_ERROR_ARGUMENT);
    input = good, input.width = 0;
    expect_refused(&input, CM_CCM_B, CM_ERROR_RANGE);
    input = good, input.height = UINT32_MAX;
    expect_refused(&input, CM_CCM_B, CM_ERROR_RANGE);
    input = good, input.channels = 1;
    expect_refused(&input, CM_CCM_B, CM_ERROR_RANGE);
    input = good, input.channels = 65;
    expect_refused(&input, CM_CCM_B, CM_ERROR_RANGE);
    input = good, input.channels = 3;
    expect_refused(&input, CM_CCM_2, CM_ERROR_RANGE);
}
END_TEST

START_TEST(bad_flows_are_refused)
{
    float one = 0.0f, two[2] = {0};
    cm_flow_pair pair[1];
    size_t count = 9;
    ck_assert_int_eq(cm_compensation_flows(CM_NCM, 1, 1, pair, &count), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_compensation_flows(CM_NCM, 4, 1, NULL, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_compensation_flows((cm_compensation)9, 4, 1, pair, &count),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_compensation_flows(CM_NCM, 4, 1, pair, NULL), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(count, 9);
    ck_assert_int_eq(cm_compensation_flows(CM_NCM, 4, 1, pair, &count), CM_ERROR_SPACE);
    ck_assert_uint_eq(count, 3);
    ck_assert_int_eq(cm_compensation_flows(CM_CCM_1, 4, 0, NULL, &count), CM_OK);
    ck_assert_uint_eq(count, 1);
    ck_assert_ptr_null(cm_compensation_name((cm_compensation)6));
    ck_assert_str_eq(cm_compensation_name(CM_CCM_B), "CCM-B");
    ck_assert_int_eq(cm_flow_warp(0, 1, &one, two, 1.0, &one, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_flow_warp(1u << 16, 1u << 15, &one, two, 1.0, &one, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_flow_warp(1, 1, &one, two, (double)NAN, &one, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_flow_warp(1, 1, &one, two, 1001.0, &one, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_flow_warp(1, 1, NULL, two, 1.0, &one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_warp(1, 1, &one, NULL, 1.0, &one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_warp(1, 1, &one, two, 1.0, NULL, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {whole_steps_keep_the_bits,
                                  parts_of_steps_are_exact,
                                  turns_are_followed,
                                  the_faster_lies_in_front,
                                  unknown_flows_move_nothing,
                                  schemes_ask_for_flows,
                                  schemes_take_motion_out,
                                  hidden_content_comes_from_where_it_is_seen,
                                  threads_give_the_same_bits,
                                  pixels_go_back_to_before,
                                  bad_input_is_refused,
                                  bad_flows_are_refused,
                                  NULL};
    return run_suite("compensate", tests);
}
