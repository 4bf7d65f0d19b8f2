/* SPDX-License-Identifier: MIT
 *
 * Trajectories of any stamps and poses: what is refused is told and changes nothing; of the others pairs, errors, motion and
 * sensors are what the header says.
 */
#include <cubemap/trajectory.h>

#include <math.h>

#include "fuzz.h"

enum
{
    MOST = 24,
    SAMPLES = 64
};

typedef struct taken
{
    size_t count;
    double stamp[MOST];
    cm_pose pose[MOST];
} taken;

static double take_number(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind < 4 ? take_double(from) : kind < 128 ? kind % 8 : take_fraction(from);
}

static void take_poses(supply *from, taken *all)
{
    all->count = take_byte(from) % (MOST + 1);
    double time = take_number(from);
    for (size_t i = 0; i < all->count; i++)
    {
        const uint8_t kind = take_byte(from);
        time += kind < 250 ? 0.01 * kind + 1e-6 : take_number(from);
        double twist[6];
        for (int k = 0; k < 6; k++)
        {
            twist[k] = take_number(from);
        }
        cm_pose_exp(twist, &all->pose[i]);
        all->stamp[i] = time;
    }
}

static cm_trajectory *make(const taken *all)
{
    cm_trajectory *made = NULL;
    size_t wrong = 999;
    const cm_status status = cm_trajectory_create(all->count, all->stamp, all->pose, &made, &wrong);
    EXPECT((status == CM_OK) == (made != NULL), "%d", (int)status);
    EXPECT((wrong < all->count) == (status == CM_ERROR_DATA || status == CM_ERROR_CAMERA),
           "%d, %zu", (int)status, wrong);
    EXPECT(cm_trajectory_count(made) == (status == CM_OK ? all->count : 0), "count");
    return made;
}

static void check_lookup(const cm_trajectory *made, const taken *all, double time)
{
    size_t index = 999;
    cm_pose pose;
    double stamp = 0.0;
    if (cm_trajectory_nearest(made, time, 0.5, &index) == CM_OK)
    {
        EXPECT(cm_trajectory_at(made, index, &stamp, &pose) == CM_OK, "index %zu", index);
        for (size_t i = 0; i < all->count; i++)
        {
            EXPECT(fabs(all->stamp[i] - time) >= fabs(stamp - time), "%zu is nearer", i);
        }
    }
    else
    {
        EXPECT(index == 999, "touched");
    }
    EXPECT(cm_trajectory_at(made, all->count, NULL, NULL) == CM_ERROR_ARGUMENT, "one too many");
    const int is_inside = time >= all->stamp[0] && time <= all->stamp[all->count - 1];
    EXPECT((cm_trajectory_interpolate(made, time, &pose) == CM_OK) == is_inside, "%g", time);
}

/* From a number to the next. */
static double spacing(double number)
{
    return nextafter(fabs(number), (double)INFINITY) - fabs(number);
}

/* As decimals: what they and apart are rounded by is allowed beside it, and no more than half of it. */
static int is_within(double first, double second, double apart)
{
    const double off = fabs(first - second);
    return off <= apart || (off <= 1.5 * apart &&
                            off - apart <= spacing(first) + spacing(second) + 5.0 * spacing(apart));
}

static void check_pairs(const cm_trajectory *a, const cm_trajectory *b, double apart)
{
    size_t index_a[MOST];
    size_t index_b[MOST];
    size_t count = 999;
    const cm_status status = cm_trajectory_associate(a, b, apart, MOST, index_a, index_b, &count);
    EXPECT((status == CM_OK) == (apart >= 0.0), "%d", (int)status);
    uint32_t seen = 0;
    for (size_t i = 0; status == CM_OK && i < count; i++)
    {
        double first;
        double second;
        EXPECT(cm_trajectory_at(a, index_a[i], &first, NULL) == CM_OK, "index");
        EXPECT(cm_trajectory_at(b, index_b[i], &second, NULL) == CM_OK, "index");
        EXPECT(is_within(first, second, apart) && (i == 0 || index_a[i] > index_a[i - 1]),
               "pair %zu", i);
        EXPECT((seen >> index_b[i] & 1) == 0, "%zu twice", index_b[i]);
        seen |= (uint32_t)1 << index_b[i];
    }
}

static void check_errors(const cm_trajectory *a, const cm_trajectory *b, supply *from)
{
    cm_evaluation made = {.size = sizeof made, .pairs = 999};
    cm_evaluation_options options = {.size = sizeof options};
    options.size -= take_byte(from) == 255;
    options.apart = take_number(from);
    options.interval = take_number(from);
    const cm_status status = cm_trajectory_evaluate(a, b, &options, &made);
    EXPECT(status == CM_OK || made.pairs == 999, "touched");
    EXPECT(status != CM_OK || (made.pairs > 0 && made.motions < made.pairs), "%zu", made.pairs);
    EXPECT(status != CM_OK || (made.ate_rmse >= 0.0 && made.rank >= 0 && made.rank <= 3), "%g",
           made.ate_rmse);
}

static void check_motion(const cm_trajectory *of, supply *from, double time)
{
    cm_motion *motion = NULL;
    EXPECT(cm_motion_create(of, &motion) == CM_OK, "no motion");
    cm_motion_state state = {.size = sizeof state};
    if (cm_motion_at(motion, time, &state) == CM_OK)
    {
        EXPECT(cm_pose_check(&state.pose) == CM_OK, "no pose");
    }
    cm_inertial_options options = {.size = sizeof options};
    options.rate = take_number(from);
    options.latency = take_number(from);
    options.gravity[2] = take_number(from);
    options.accelerometer.density = take_number(from);
    options.gyroscope.walk = take_number(from);
    options.gyroscope.bias[1] = take_number(from);
    double stamp[SAMPLES];
    double acceleration[3 * SAMPLES];
    double rate[3 * SAMPLES];
    size_t count = 999;
    const cm_status status =
        cm_motion_inertial(motion, &options, SAMPLES, stamp, acceleration, rate, &count);
    EXPECT(status != CM_OK || (count >= 1 && count <= SAMPLES), "%zu", count);
    EXPECT(status != CM_ERROR_SPACE || count > SAMPLES, "%zu", count);
    EXPECT(status == CM_OK || status == CM_ERROR_SPACE || count == 999, "touched");
    cm_motion_destroy(motion);
}

static void check_alignment(const taken *a, const taken *b)
{
    double from[3 * MOST];
    double to[3 * MOST];
    const size_t count = a->count < b->count ? a->count : b->count;
    cm_pose motion;
    int rank = 9;
    int is_determined = 9;
    for (size_t i = 0; i < 3 * count; i++)
    {
        from[i] = a->pose[i / 3].position[i % 3];
        to[i] = b->pose[i / 3].position[i % 3];
    }
    if (cm_pose_align(count, from, to, &motion, &rank, &is_determined) == CM_OK)
    {
        EXPECT(rank >= 0 && rank <= 3 && is_determined <= (rank >= 2), "%d, %d", rank,
               is_determined);
        EXPECT(cm_pose_check(&motion) == CM_OK, "no motion");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static taken first;
    static taken second;
    supply from = {data, size};
    take_poses(&from, &first);
    take_poses(&from, &second);
    cm_trajectory *a = make(&first);
    cm_trajectory *b = make(&second);
    const double time = take_number(&from);
    if (a != NULL)
    {
        check_lookup(a, &first, time);
        check_motion(a, &from, time);
    }
    if (a != NULL && b != NULL)
    {
        check_pairs(a, b, take_number(&from));
        check_errors(a, b, &from);
    }
    check_alignment(&first, &second);
    cm_trajectory_destroy(a);
    cm_trajectory_destroy(b);
    return 0;
}
