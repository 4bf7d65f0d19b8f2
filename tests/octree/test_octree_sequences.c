/* SPDX-License-Identifier: MIT
 *
 * Whatever is done to a map, in any order: a twin that is paged, compacted, saved and loaded in between and updated by threads is equal
 * to it, and what is asked of it is what an array of all its voxels says.
 */
#include "dense_map.h"

#include <cubemap/mapping.h>

enum
{
    LEVELS = 6,
    N = 1 << LEVELS
};

typedef struct twins
{
    dice from;
    cm_octree_options options;
    cm_octree *plain;
    cm_octree *other;
    cm_store *pages;
    cm_pool *pool;
    cm_camera *camera[3]; /* straight, a lens, all around */
    dense_map now;        /* of plain */
    dense_map then;       /* at a step */
    uint64_t step;
} twins;

static int below(dice *from, int n)
{
    const int drawn = (int)(throw_dice(from) * n);
    return drawn < n ? drawn : n - 1;
}

static cm_octree_options drawn_options(dice *from)
{
    cm_octree_options options = {
        .size = sizeof options, .levels = LEVELS, .edge = 0.05, .color = below(from, 4) > 0};
    options.centre[below(from, 3)] = dice_between(from, -0.3, 0.3);
    options.far = below(from, 2) ? 2.0 : 0.0;
    options.near = below(from, 3) == 0 ? 0.4 : 0.0;
    options.no_return_is_free = options.far > 0.0 && below(from, 2);
    options.endpoints_only = !options.no_return_is_free && below(from, 5) == 0;
    options.footprint = below(from, 3) == 0 ? (double)(2 << below(from, 3)) : 0.0;
    options.noise = below(from, 3) == 0 ? 0.01 : 0.0;
    if (below(from, 2))
    {
        options.rule = CM_OCTREE_LOG_ODDS;
        options.hit = 0.85;
        options.miss = -0.4;
        options.low = -2.0;
        options.high = 3.5;
    }
    return options;
}

static twins begin(uint64_t seed)
{
    twins at = {.from = {seed}, .now = dense_make(LEVELS), .then = dense_make(LEVELS)};
    at.options = drawn_options(&at.from);
    at.plain = make_map(&at.options);
    ck_assert_int_eq(cm_store_create_in_memory(&at.pages), CM_OK);
    cm_octree_options paged = at.options;
    paged.memory = 20000;
    paged.pages = at.pages;
    at.other = make_map(&paged);
    at.pool = make_pool(3);
    for (int kind = 0; kind < 3; kind++)
    {
        at.camera[kind] = camera_of(kind);
    }
    dense_read(at.plain, &at.now);
    dense_read(at.plain, &at.then);
    return at;
}

static void end(twins *at)
{
    for (int kind = 0; kind < 3; kind++)
    {
        cm_camera_destroy(at->camera[kind]);
    }
    cm_pool_destroy(at->pool);
    cm_octree_destroy(at->plain);
    cm_octree_destroy(at->other);
    cm_store_destroy(at->pages);
    dense_clear(&at->now);
    dense_clear(&at->then);
}

/* ---- what is done ---- */

static cm_pose drawn_pose(dice *from)
{
    double place[3], at[3];
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = dice_between(from, -1.8, 1.8);
        at[axis] = dice_between(from, -0.5, 0.5);
    }
    return look_at(place, at, 6.28 * throw_dice(from));
}

static void add_view(twins *at, cm_octree *one, cm_octree *two)
{
    const cm_pose pose = drawn_pose(&at->from);
    drawn_view drawn;
    draw_view(&drawn, at->camera[below(&at->from, 3)], &pose, 1.2, below(&at->from, 4) > 0,
              &at->from);
    for (int times = below(&at->from, 6) == 0 ? 66 : 1; times > 0; times--)
    {
        ck_assert_int_eq(cm_octree_update(one, &drawn.view, NULL), CM_OK);
        ck_assert_int_eq(two == NULL ? CM_OK : cm_octree_update(two, &drawn.view, at->pool), CM_OK);
    }
    clear_view(&drawn);
}

static void add_points(twins *at)
{
    float xyz[3 * 40];
    uint8_t rgb[3 * 40];
    const cm_pose pose = drawn_pose(&at->from);
    for (int i = 0; i < 3 * 40; i++)
    {
        xyz[i] = (float)dice_between(&at->from, -2.0, 2.0);
        rgb[i] = (uint8_t)below(&at->from, 256);
    }
    xyz[7] = below(&at->from, 2) ? NAN : INFINITY;
    const uint8_t *colors = below(&at->from, 3) ? rgb : NULL;
    ck_assert_int_eq(cm_octree_update_points(at->plain, pose.position, 40, xyz, colors), CM_OK);
    ck_assert_int_eq(cm_octree_update_points(at->other, pose.position, 40, xyz, colors), CM_OK);
}

/* Another map comes in; without a pose counts add. */
static void add_map(twins *at)
{
    cm_octree *more = make_map(&at->options);
    add_view(at, more, NULL);
    add_view(at, more, NULL);
    const cm_pose pose = drawn_pose(&at->from);
    const int has_pose = below(&at->from, 2);
    ck_assert_int_eq(cm_octree_merge(at->plain, more, has_pose ? &pose : NULL), CM_OK);
    ck_assert_int_eq(cm_octree_merge(at->other, more, has_pose ? &pose : NULL), CM_OK);
    cm_octree_destroy(more);
}

static void put_away(twins *at)
{
    const cm_octree_options how = {.size = sizeof how, .memory = 20000, .pages = at->pages};
    ck_assert_int_eq(cm_octree_save(at->other, at->pages, "seven", 5), CM_OK);
    cm_octree_destroy(at->other);
    at->other = NULL;
    ck_assert_int_eq(cm_octree_load(at->pages, &how, &at->other), CM_OK);
    size_t count = 0;
    const void *data = cm_octree_user_data(at->other, &count);
    ck_assert(count == 5 && memcmp(data, "seven", 5) == 0);
}

static void do_something(twins *at)
{
    const int what = below(&at->from, 10);
    if (what < 5)
    {
        add_view(at, at->plain, at->other);
    }
    else if (what < 6)
    {
        add_points(at);
    }
    else if (what < 7)
    {
        add_map(at);
    }
    else if (what < 8)
    {
        put_away(at);
    }
    else
    {
        ck_assert_int_eq(cm_octree_compact(what < 9 ? at->plain : at->other), CM_OK);
    }
}

/* ---- what is asked ---- */

static double corner(const twins *at, int axis)
{
    return at->options.centre[axis] - at->options.edge * N / 2;
}

static double centre_of(const twins *at, int axis, int64_t place)
{
    return corner(at, axis) + ((double)place + 0.5) * at->options.edge;
}

/* Cells of a voxel that was told: marks them, and compares their alpha. */
typedef struct told
{
    const twins *at;
    uint8_t *is_told;
} told;

static int tell(void *user, const cm_voxel *voxel)
{
    const told *to = user;
    const double middle[3] = {voxel->x, voxel->y, voxel->z};
    const int64_t edges = (int64_t)1 << voxel->level;
    int64_t first[3];
    for (int axis = 0; axis < 3; axis++)
    {
        first[axis] = (int64_t)lround((middle[axis] - 0.5 * voxel->edge - corner(to->at, axis)) /
                                      to->at->options.edge);
    }
    for (int64_t i = 0; i < edges * edges * edges; i++)
    {
        const size_t cell = dense_at(&to->at->now, first[0] + i % edges,
                                     first[1] + i / edges % edges, first[2] + i / edges / edges);
        ck_assert_int_eq(to->at->now.alpha[cell], voxel->alpha);
        ck_assert_int_eq(to->is_told[cell], 0);
        to->is_told[cell] = 1;
    }
    return 0;
}

static void check_box(const twins *at, const cm_octree *octree, dice *from, uint8_t *is_told)
{
    double least[3], greatest[3];
    for (int axis = 0; axis < 3; axis++)
    {
        least[axis] = dice_between(from, -2.0, 1.0);
        greatest[axis] = least[axis] + dice_between(from, 0.0, 2.0);
    }
    told to = {at, is_told};
    memset(is_told, 0, (size_t)N * N * N);
    ck_assert_int_eq(cm_octree_walk_box(octree, least, greatest, tell, &to), CM_OK);
    for (int64_t i = 0; i < (int64_t)N * N * N; i++)
    {
        const int64_t place[3] = {i % N, i / N % N, i / N / N};
        const double centre[3] = {centre_of(at, 0, place[0]), centre_of(at, 1, place[1]),
                                  centre_of(at, 2, place[2])};
        /* of a footprint's larger voxels it is their centre that counts */
        int is_inside = at->options.footprint == 0.0;
        for (int axis = 0; axis < 3; axis++)
        {
            is_inside &= centre[axis] >= least[axis] && centre[axis] <= greatest[axis];
        }
        ck_assert_msg(!is_inside || at->now.alpha[i] == 127 || is_told[i],
                      "footprint %g: a box leaves out %d, %d, %d", at->options.footprint,
                      (int)place[0], (int)place[1], (int)place[2]);
    }
}

/* What changed since the step must be told. */
static void check_changes(const twins *at, uint8_t *is_told)
{
    told to = {at, is_told};
    memset(is_told, 0, (size_t)N * N * N);
    ck_assert_int_eq(cm_octree_walk_changes(at->other, at->step, tell, &to), CM_OK);
    for (size_t i = 0; i < (size_t)N * N * N; i++)
    {
        ck_assert_int_eq(
            at->now.alpha[i] != at->then.alpha[i] && at->now.alpha[i] != 127 && !is_told[i], 0);
    }
}

/* Where a ray enters a voxel; infinite where it does not, and where it does no more than touch it. */
static double entry(const twins *at, int64_t voxel, const double origin[3],
                    const double direction[3])
{
    const int64_t place[3] = {voxel % N, voxel / N % N, voxel / N / N};
    double first = 0.0, last = INFINITY;
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = corner(at, axis) + (double)place[axis] * at->options.edge;
        const double a = (low - origin[axis]) / direction[axis];
        const double b = (low + at->options.edge - origin[axis]) / direction[axis];
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    return first < last - 1e-6 ? first : INFINITY;
}

static void check_ray(const twins *at, dice *from)
{
    double origin[3], direction[3], square = 0.0, nearest = INFINITY, closest = INFINITY;
    for (int axis = 0; axis < 3; axis++)
    {
        origin[axis] = dice_between(from, -2.0, 2.0);
        direction[axis] = dice_between(from, -1.0, 1.0);
        square += direction[axis] * direction[axis];
    }
    for (int axis = 0; axis < 3; axis++)
    {
        direction[axis] /= sqrt(square);
    }
    for (int64_t i = 0; i < (int64_t)N * N * N; i++)
    {
        if (at->now.alpha[i] > 127)
        {
            const double x = corner(at, 0) + ((double)(i % N) + 0.5) * at->options.edge - origin[0],
                         y = corner(at, 1) + ((double)(i / N % N) + 0.5) * at->options.edge -
                             origin[1],
                         z = corner(at, 2) + ((double)(i / N / N) + 0.5) * at->options.edge -
                             origin[2];
            nearest = fmin(nearest, entry(at, i, origin, direction));
            closest = fmin(closest, sqrt(x * x + y * y + z * z));
        }
    }
    cm_voxel voxel;
    const int is_met = cm_octree_ray(at->other, origin, direction, 0.0, &voxel);
    ck_assert_msg(isinf(nearest) || (is_met && voxel.distance <= nearest + 1e-9),
                  "a ray enters at %g, not at %g", nearest, voxel.distance);
    ck_assert(!is_met || isinf(nearest) || voxel.distance >= nearest - 1e-5 || voxel.alpha > 127);
    ck_assert_int_eq(cm_octree_nearest(at->other, origin, 0.7, &voxel), closest <= 0.7);
    ck_assert(closest > 0.7 || fabs(voxel.distance - closest) < 1e-9);
}

static void check_counts(const twins *at)
{
    size_t occupied = 0, free_space = 0, listed = 0;
    for (size_t i = 0; i < (size_t)N * N * N; i++)
    {
        occupied += at->now.alpha[i] > 127;
        free_space += at->now.alpha[i] < 127;
    }
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(at->other, &count), CM_OK);
    ck_assert(count.occupied == occupied && count.free == free_space);
    ck_assert_int_eq(cm_octree_extract(at->other, 0, 0, NULL, &listed),
                     occupied > 0 ? CM_ERROR_SPACE : CM_OK);
    ck_assert(at->options.footprint > 0.0 ? listed <= occupied : listed == occupied);
}

static cm_voxel *voxels_of(const cm_octree *octree, int level, size_t *count)
{
    *count = 0;
    const cm_status status = cm_octree_extract(octree, level, 0, NULL, count);
    ck_assert_int_eq(status, *count > 0 ? CM_ERROR_SPACE : CM_OK);
    cm_voxel *voxel = malloc((*count + 1) * sizeof *voxel);
    ck_assert_ptr_nonnull(voxel);
    ck_assert_int_eq(cm_octree_extract(octree, level, *count, voxel, count), CM_OK);
    return voxel;
}

/* All levels have the same voxels in both, and each of them is what is found where it is. */
static void check_levels(const twins *at, dice *from)
{
    for (int level = 0; level <= LEVELS; level++)
    {
        size_t count[2];
        cm_voxel *of[2] = {voxels_of(at->plain, level, &count[0]),
                           voxels_of(at->other, level, &count[1])};
        ck_assert_uint_eq(count[0], count[1]);
        for (size_t i = 0; i < count[0]; i++)
        {
            const cm_voxel *a = &of[0][i], *b = &of[1][i];
            ck_assert(a->x == b->x && a->y == b->y && a->z == b->z && a->edge == b->edge &&
                      a->alpha == b->alpha && memcmp(a->color, b->color, 3) == 0);
        }
        for (int i = 0; i < 5 && count[0] > 0; i++)
        {
            const cm_voxel *a = &of[0][(size_t)(throw_dice(from) * 0.999 * (double)count[0])];
            const double point[3] = {a->x, a->y, a->z};
            cm_voxel b;
            ck_assert_int_eq(cm_octree_at(at->other, point, level, &b), CM_VOXEL_OCCUPIED);
            ck_assert(b.alpha == a->alpha && memcmp(b.color, a->color, 3) == 0);
        }
        free(of[0]);
        free(of[1]);
    }
}

/* Voxels are told in the same size, too. */
static void check_sizes(const twins *at, dice from)
{
    for (int i = 0; i < 2000; i++)
    {
        const double point[3] = {dice_between(&from, -1.8, 1.8), dice_between(&from, -1.8, 1.8),
                                 dice_between(&from, -1.8, 1.8)};
        cm_voxel a, b;
        cm_octree_at(at->plain, point, 0, &a);
        cm_octree_at(at->other, point, 0, &b);
        ck_assert_msg(memcmp(&a, &b, sizeof a) == 0, "levels %d and %d, alphas %d and %d", a.level,
                      b.level, a.alpha, b.alpha);
    }
}

static void check(twins *at, uint8_t *is_told)
{
    dense_read(at->plain, &at->now);
    const char *text = maps_differ(at->plain, at->other);
    ck_assert_msg(text[0] == '\0', "%s", text);
    ck_assert_uint_eq(cm_octree_step(at->plain), cm_octree_step(at->other));
    check_counts(at);
    check_levels(at, &at->from);
    check_sizes(at, at->from);
    check_changes(at, is_told);
    for (int i = 0; i < 3; i++)
    {
        check_box(at, i == 0 ? at->plain : at->other, &at->from, is_told);
        check_ray(at, &at->from);
    }
    if (below(&at->from, 3) == 0)
    {
        dense_read(at->plain, &at->then);
        at->step = cm_octree_step(at->plain);
    }
}

static void run_sequence(uint64_t seed, int length)
{
    twins at = begin(seed);
    uint8_t *is_told = malloc((size_t)N * N * N);
    ck_assert_ptr_nonnull(is_told);
    for (int i = 0; i < length; i++)
    {
        do_something(&at);
        if (i % 3 == 2)
        {
            check(&at, is_told);
        }
    }
    free(is_told);
    end(&at);
}

START_TEST(twins_stay_equal)
{
    const char *first = getenv("CUBEMAP_FIRST_SEQUENCE");
    const uint64_t seed = first == NULL ? 1 : strtoull(first, NULL, 10);
    for (uint64_t i = 0; i < (is_long() ? 200u : is_quick() ? 3u : 6u); i++)
    {
        run_sequence(seed + i, 24);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {twins_stay_equal, NULL};
    return run_suite("octree sequences", tests);
}
