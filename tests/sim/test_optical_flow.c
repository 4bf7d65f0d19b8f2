/* SPDX-License-Identifier: MIT
 *
 * Flows by OpenCV: a pattern that moves evenly is followed by every method, and what is no picture is refused. Without OpenCV
 * all say so.
 */
#include "modules/sim/io/optical_flow.h"

#include "tests/suite.h"

enum
{
    WIDTH = 96,
    HEIGHT = 72,
    PIXELS = WIDTH * HEIGHT
};

static float from[PIXELS], to[PIXELS], flow[2 * PIXELS];
static char message[CM_FLOW_MESSAGE];

static void draw_pattern(double dx, double dy, float *picture)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = (double)(i % WIDTH) - dx, y = (double)(i / WIDTH) - dy;
        picture[i] = (float)(2.0 + sin(0.31 * x + 0.11 * y) + cos(0.23 * y - 0.17 * x) +
                             0.5 * sin(0.7 * x) * cos(0.6 * y));
    }
}

/* The mean distance from the true flow where the picture's borders are far. */
static double error_of_flow(double dx, double dy)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const size_t column = i % WIDTH, row = i / WIDTH;
        if (column >= 16 && column < WIDTH - 16 && row >= 16 && row < HEIGHT - 16)
        {
            sum += hypot((double)flow[2 * i] - dx, (double)flow[2 * i + 1] - dy);
            count++;
        }
    }
    return sum / (double)count;
}

START_TEST(patterns_are_followed)
{
    draw_pattern(0.0, 0.0, from);
    draw_pattern(2.5, -1.25, to);
    for (int method = 0; method < CM_FLOW_METHODS && cm_flow_is_there(); method++)
    {
        const cm_status status =
            cm_flow_find((cm_flow_method)method, WIDTH, HEIGHT, from, to, flow, message);
        ck_assert_msg(status == CM_OK, "%s: %s", cm_flow_method_name((cm_flow_method)method),
                      message);
        const double error = error_of_flow(2.5, -1.25);
        ck_assert_msg(error < 0.25, "%s: %g pixels", cm_flow_method_name((cm_flow_method)method),
                      error);
    }
}
END_TEST

/* Flat, and with holes; the smallest sides. */
START_TEST(pictures_of_nothing_have_a_flow)
{
    draw_pattern(0.0, 0.0, from);
    draw_pattern(1.0, 0.0, to);
    for (size_t i = 0; i < PIXELS; i += 7)
    {
        from[i] = i % 2 ? NAN : INFINITY;
    }
    static float flat[PIXELS];
    for (int method = 0; method < CM_FLOW_METHODS && cm_flow_is_there(); method++)
    {
        const cm_flow_method m = (cm_flow_method)method;
        ck_assert_msg(cm_flow_find(m, WIDTH, HEIGHT, from, to, flow, message) == CM_OK, "%s: %s",
                      cm_flow_method_name(m), message);
        const uint32_t least = m == CM_FLOW_RLOF ? CM_FLOW_SIDE_LEAST_RLOF : CM_FLOW_SIDE_LEAST;
        ck_assert_msg(cm_flow_find(m, least, least, to, from, flow, message) == CM_OK, "%s: %s",
                      cm_flow_method_name(m), message);
        flow[2 * PIXELS - 1] = 1.0f;
        ck_assert_int_eq(cm_flow_find(m, WIDTH, HEIGHT, flat, flat, flow, message), CM_OK);
        for (size_t i = 0; i < 2 * PIXELS; i++)
        {
            ck_assert(flow[i] == 0.0f);
        }
        ck_assert_int_eq(cm_flow_find(m, least - 1, HEIGHT, from, to, flow, message),
                         CM_ERROR_RANGE);
    }
}
END_TEST

START_TEST(bad_input_is_refused)
{
    flow[0] = 17.0f;
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, HEIGHT, NULL, to, flow, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, HEIGHT, from, NULL, flow, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, HEIGHT, from, to, NULL, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, HEIGHT, from, to, flow, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_find((cm_flow_method)5, WIDTH, HEIGHT, from, to, flow, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, 0, HEIGHT, from, to, flow, message), CM_ERROR_RANGE);
    ck_assert_str_eq(message, "optical flow: sides must have 16 to 16384 pixels");
    ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, 16385, from, to, flow, message),
                     CM_ERROR_RANGE);
    ck_assert(flow[0] == 17.0f);
    ck_assert_ptr_null(cm_flow_method_name((cm_flow_method)-1));
    ck_assert_str_eq(cm_flow_method_name(CM_FLOW_RLOF), "rlof");
    if (!cm_flow_is_there())
    {
        ck_assert_int_eq(cm_flow_find(CM_FLOW_DIS, WIDTH, HEIGHT, from, to, flow, message),
                         CM_ERROR_UNSUPPORTED);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {patterns_are_followed, pictures_of_nothing_have_a_flow,
                                  bad_input_is_refused, NULL};
    return run_suite("optical flow", tests);
}
