/* SPDX-License-Identifier: MIT
 *
 * Compensation where the system has no memory: each allocation fails once, which is told; nothing leaks, and what is written is
 * untouched.
 */
#include <cubemap/compensate.h>

#include "tests/refused_allocation.h"
#include "tests/suite.h"

enum
{
    SIDE = 8,
    PIXELS = SIDE * SIDE,
    CHANNELS = 4
};

static float now[CHANNELS * PIXELS], before[CHANNELS * PIXELS], flow[4 * CHANNELS * PIXELS];
static float to[CHANNELS * PIXELS];

typedef cm_status (*trial)(void);

static cm_status compensate(void)
{
    const cm_compensation_input input = {.size = sizeof input,
                                         .width = SIDE,
                                         .height = SIDE,
                                         .channels = CHANNELS,
                                         .now = now,
                                         .before = before,
                                         .flow = flow};
    return cm_compensate(&input, CM_CCM_B, NULL, to);
}
static cm_status warp(void)
{
    return cm_flow_warp(SIDE, SIDE, now, flow, 1.0, to, NULL);
}
static cm_status normalize_locally(void)
{
    return cm_channel_normalize_locally(SIDE, SIDE, now, 2, to);
}
static cm_status equalize(void)
{
    return cm_channel_equalize(SIDE, SIDE, now, 16, to);
}
static cm_status equalize_locally(void)
{
    return cm_channel_equalize_locally(SIDE, SIDE, now, 2, 3.0, to);
}

static void refuse_each(const char *name, trial call)
{
    int refused = 0;
    for (int blocks = 0;; blocks++)
    {
        const int alive = blocks_alive();
        to[0] = 17.0f;
        blocks_until_refusal = blocks;
        const cm_status status = call();
        const int is_left = blocks_until_refusal >= 0;
        blocks_until_refusal = -1;
        ck_assert_msg(blocks_alive() == alive, "%s, block %d: leaks", name, blocks);
        if (is_left)
        {
            ck_assert_msg(status == CM_OK, "%s: %d", name, (int)status);
            break;
        }
        ck_assert_msg(status == CM_ERROR_MEMORY && to[0] == 17.0f, "%s, block %d: %d", name, blocks,
                      (int)status);
        refused++;
    }
    ck_assert_msg(refused > 0, "%s", name);
}

START_TEST(refused_memory_is_told)
{
    refuse_each("compensate", compensate);
    refuse_each("warp", warp);
    refuse_each("normalize locally", normalize_locally);
    refuse_each("equalize", equalize);
    refuse_each("equalize locally", equalize_locally);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {refused_memory_is_told, NULL};
    return run_suite("compensate refused", tests);
}
