/* SPDX-License-Identifier: MIT
 *
 * Trajectories, motion, budgets and pools where the system has no memory: each allocation fails once, which is told, and
 * outputs stay as they were.
 */
#include <cubemap/budget.h>
#include <cubemap/pool.h>

#include "curved_trajectory.h"
#include "tests/refused_allocation.h"

typedef struct outputs
{
    cm_trajectory *trajectory;
    cm_motion *motion;
    cm_pool *pool;
    size_t count;
    cm_evaluation evaluation;
    cm_budget budget;
} outputs;

static cm_trajectory *some;

static cm_status create(outputs *out)
{
    return cm_trajectory_create(COUNT, stamps, poses, &out->trajectory, NULL);
}

static cm_status associate(outputs *out)
{
    size_t index[2][COUNT];
    return cm_trajectory_associate(some, some, 0.01, COUNT, index[0], index[1], &out->count);
}

static cm_status evaluate(outputs *out)
{
    return cm_trajectory_evaluate(some, some, NULL, &out->evaluation);
}

static cm_status move(outputs *out)
{
    return cm_motion_create(some, &out->motion);
}

static cm_status choose(outputs *out)
{
    return cm_budget_limit_cost(&out->budget, 1.0);
}

static cm_status make_pool(outputs *out)
{
    return cm_pool_create(1, &out->pool);
}

/* Returns how many allocations there are to fail. */
static int fail_each(cm_status (*call)(outputs *out))
{
    const outputs clean = {.evaluation = {.size = sizeof(cm_evaluation)},
                           .budget = {.size = sizeof(cm_budget), .cost = 77.0}};
    for (int i = 0;; i++)
    {
        outputs out;
        memcpy(&out, &clean, sizeof out);
        const int before = blocks_alive();
        blocks_until_refusal = i;
        const cm_status status = call(&out);
        const int met = blocks_until_refusal < 0;
        blocks_until_refusal = -1;
        if (!met)
        {
            ck_assert_int_eq(status, CM_OK);
            cm_trajectory_destroy(out.trajectory);
            cm_motion_destroy(out.motion);
            cm_pool_destroy(out.pool);
            return i;
        }
        ck_assert_int_eq(status, CM_ERROR_MEMORY);
        ck_assert_int_eq(blocks_alive(), before);
        ck_assert(memcmp(&out, &clean, sizeof out) == 0);
    }
}

START_TEST(each_allocation_fails_once)
{
    static const struct
    {
        cm_status (*call)(outputs *out);
        int least; /* allocations */
    } calls[] = {{create, 3}, {associate, 3}, {evaluate, 7},
                 {move, 4},   {choose, 1},    {make_pool, 1}};
    fill(0.0, 0.05);
    some = make(COUNT, stamps, poses);
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
    {
        const int met = fail_each(calls[i].call);
        REQUIRE(met >= calls[i].least, "call %zu: %d allocations", i, met);
    }
    cm_trajectory_destroy(some);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {each_allocation_fails_once, NULL};
    return run_suite("refused memory", tests);
}
