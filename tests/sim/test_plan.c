/* SPDX-License-Identifier: MIT
 *
 * Plans: what is dropped and kept depends on what effects do to distances, not on how long frames chance to take.
 */
#include "tof_stage.h"

static const cm_primitive ball = {.size = sizeof ball,
                                  .kind = CM_PRIMITIVE_SPHERE,
                                  .first = {0.1, 0.1, 1.2},
                                  .radius = 0.3,
                                  .material = {{1, 1, 1}, 0.8}};

/* Frames of so few pixels that those with an effect are often made faster than those without. */
static stage make_small_stage(void)
{
    const cm_primitive both[2] = {wall, ball};
    const cm_camera_options shape = {
        .size = sizeof shape, .width = 6, .height = 4, .fx = 5, .fy = 5, .cx = 2.5, .cy = 1.5};
    stage at = make_stage(both, 2);
    cm_camera_destroy(at.camera);
    ck_assert_int_eq(cm_camera_create(&shape, &at.camera), CM_OK);
    at.sensor.camera = at.camera;
    return at;
}

static void plan(const stage *at, double limit, cm_tof_options *chosen, cm_budget *budget)
{
    const cm_tof_options most = {
        .size = sizeof most, .sample_columns = 3, .sample_rows = 3, .lights = 5};
    chosen->size = sizeof *chosen;
    budget->size = sizeof *budget;
    ck_assert_int_eq(cm_tof_plan(at->scene, &at->sensor, &at->light, 1, NULL, 0.0, limit, &most,
                                 NULL, chosen, budget),
                     CM_OK);
}

START_TEST(clocks_decide_nothing)
{
    stage at = make_small_stage();
    for (int run = 0; run < 30; run++)
    {
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.entry = entry};
        cm_tof_options chosen = {0};
        plan(&at, 1e6, &chosen, &budget);
        for (size_t i = 0; i < CM_TOF_EFFECTS; i++)
        {
            REQUIRE(!entry[i].is_kept, "run %d: %s is kept: %s", run, entry[i].name,
                    entry[i].reason);
        }
        ck_assert(chosen.bounces == 0 && chosen.sample_columns == 1 && !chosen.noise);
        plan(&at, 0.0, &chosen, &budget);
        ck_assert(chosen.bounces >= 1 && chosen.sample_columns == 3 && chosen.noise);
        ck_assert_double_eq(budget.error, 0.0);
    }
    free_stage(&at);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {clocks_decide_nothing, NULL};
    return run_suite("plan", tests);
}
