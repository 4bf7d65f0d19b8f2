/* SPDX-License-Identifier: MIT
 *
 * Points with an origin: each voxel against each ray by the slabs that it is between.
 */
#include "dense_map.h"

enum
{
    POINTS = 40
};

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

/* How much of a segment from a to b is in the voxel made larger by so much; below 0: it is beside it. */
static double part_within(const double a[3], const double b[3], const double low[3], double edge,
                          double more)
{
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double step = b[axis] - a[axis], l = low[axis] - more - a[axis],
                     h = low[axis] + edge + more - a[axis];
        if (step == 0.0)
        {
            last = l > 0.0 || h < 0.0 ? -1.0 : last;
            continue;
        }
        first = greater(first, smaller(l / step, h / step));
        last = smaller(last, greater(l / step, h / step));
    }
    return last - first;
}

typedef struct points_case
{
    cm_octree_options options;
    int points;
    double origin[3];
    float xyz[POINTS][3];
    uint8_t rgb[POINTS][3];
} points_case;

/* A cube of 3.2 around a centre; levels above 6 have several regions. */
static void draw_case(points_case *drawn, int levels, int points, dice *from)
{
    *drawn = (points_case){.points = points,
                           .options = {.size = sizeof drawn->options,
                                       .levels = levels,
                                       .edge = ldexp(3.2, -levels),
                                       .color = 1}};
    drawn->options.far = throw_dice(from) < 0.5 ? 0.0 : 1.3;
    drawn->options.near = throw_dice(from) < 0.5 ? 0.0 : 0.4;
    const double away = throw_dice(from) < 0.5 ? 1.0 : 4.0;
    for (int axis = 0; axis < 3; axis++)
    {
        drawn->options.centre[axis] = dice_between(from, -1.0, 1.0);
        drawn->origin[axis] = drawn->options.centre[axis] + dice_between(from, -away, away);
    }
    for (int i = 0; i < POINTS; i++)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            drawn->xyz[i][axis] =
                (float)(drawn->options.centre[axis] + dice_between(from, -2.0, 2.0));
            drawn->rgb[i][axis] = (uint8_t)(256.0 * throw_dice(from));
        }
        /* along an axis of the map, and from within a voxel */
        if (i % 7 == 0)
        {
            drawn->xyz[i][i % 3] = (float)drawn->origin[i % 3];
        }
    }
    drawn->xyz[3][1] = NAN;
    memcpy(drawn->xyz[5], drawn->xyz[4], sizeof drawn->xyz[4]);
}

/* What of a point is the same for every voxel. */
typedef struct ray
{
    double end[3];
    double low[3],
        high[3]; /* of the box around it, and a little more than any voxel is made larger by */
    int counts, is_far;
} ray;

static ray ray_of(const points_case *drawn, int i)
{
    ray to = {.counts = 0};
    double square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        to.end[axis] = (double)drawn->xyz[i][axis];
        square += (to.end[axis] - drawn->origin[axis]) * (to.end[axis] - drawn->origin[axis]);
    }
    const double range = sqrt(square), far = drawn->options.far;
    to.counts = range >= drawn->options.near;
    to.is_far = far > 0.0 && range > far;
    for (int axis = 0; axis < 3; axis++)
    {
        const double from = drawn->origin[axis];
        to.end[axis] = to.is_far ? from + (to.end[axis] - from) * far / range : to.end[axis];
        to.low[axis] = smaller(from, to.end[axis]) - 1e-6;
        to.high[axis] = greater(from, to.end[axis]) + 1e-6;
    }
    return to;
}

static int is_beside(const ray *to, const double low[3], double edge)
{
    return low[0] > to->high[0] || low[0] + edge < to->low[0] || low[1] > to->high[1] ||
           low[1] + edge < to->low[1] || low[2] > to->high[2] || low[2] + edge < to->low[2];
}

/* What is to be: bits 1 may and 2 must be missed; 4 may, 8 must be hit. */
static int expected(const points_case *drawn, const ray *to, const double low[3], int *first)
{
    const double edge = drawn->options.edge, *const origin = drawn->origin;
    int bits = 0;
    *first = -1;
    for (int i = 0; i < drawn->points; i++)
    {
        if (!to[i].counts || is_beside(&to[i], low, edge))
        {
            continue;
        }
        const double *const end = to[i].end;
        const int may_be_hit = part_within(end, end, low, edge, 1e-7) >= 0.0;
        const int is_hit = part_within(end, end, low, edge, -1e-7) >= 0.0;
        bits |= !to[i].is_far ? 4 * may_be_hit | 8 * is_hit : 0;
        *first = *first < 0 && is_hit && !to[i].is_far ? i : *first;
        bits |= !is_hit && part_within(origin, end, low, edge, 1e-7) >= 0.0 ? 1 : 0;
        bits |= !may_be_hit && part_within(origin, end, low, edge, -1e-7) > 0.0 ? 2 : 0;
    }
    return bits;
}

static size_t check_voxels(const points_case *drawn, const dense_map *map)
{
    size_t hits = 0, misses = 0;
    ray to[POINTS];
    for (int i = 0; i < drawn->points; i++)
    {
        to[i] = ray_of(drawn, i);
    }
    for (size_t i = 0; i < (size_t)1 << 3 * drawn->options.levels; i++)
    {
        const int64_t n = map->n,
                      place[3] = {(int64_t)i % n, (int64_t)i / n % n, (int64_t)i / n / n};
        double low[3];
        for (int axis = 0; axis < 3; axis++)
        {
            low[axis] =
                drawn->options.centre[axis] + (double)(place[axis] - n / 2) * drawn->options.edge;
        }
        int first;
        const int bits = expected(drawn, to, low, &first), is = map->alpha[i];
        ck_assert(is == 125 || is == 127 || is == 129);
        ck_assert_msg(is != 129 || (bits & 4), "a hit without a point");
        ck_assert_msg(is != 125 || ((bits & 1) && !(bits & 8)),
                      "a miss without a ray, or in spite of a hit");
        ck_assert_msg(is == 129 || !(bits & 8), "no hit where a point is");
        ck_assert_msg(is != 127 || !(bits & 2), "no miss where a ray goes");
        hits += is == 129;
        misses += is == 125;
        if (bits & 8)
        {
            const uint8_t *rgb = drawn->rgb[first];
            ck_assert_uint_eq(map->color[i],
                              1u << 24 | (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2]);
        }
    }
    return misses + hits;
}

static size_t check_case(uint64_t seed, int levels, int points)
{
    dice from = {seed};
    points_case drawn;
    draw_case(&drawn, levels, points, &from);
    cm_octree *octree = make_map(&drawn.options);
    dense_map map = dense_make(levels);
    ck_assert_int_eq(
        cm_octree_update_points(octree, drawn.origin, (size_t)points, drawn.xyz[0], drawn.rgb[0]),
        CM_OK);
    dense_read(octree, &map);
    const size_t known = check_voxels(&drawn, &map);
    ck_assert_uint_le(cm_octree_step(octree), 1);
    dense_clear(&map);
    cm_octree_destroy(octree);
    return known;
}

START_TEST(points_are_as_their_rays)
{
    size_t known = 0;
    for (uint64_t seed = 0; seed < 12; seed += is_quick() ? 4 : 1)
    {
        known += check_case(seed, 5, POINTS);
    }
    ck_assert(known > 1000);
}
END_TEST

/* Rays that leave the region that they begin in. */
START_TEST(rays_go_through_regions)
{
    size_t known = 0;
    for (uint64_t seed = 0; seed < 4; seed++)
    {
        known += check_case(seed, 7, 10);
    }
    ck_assert(known > 1000);
}
END_TEST

/* Free space that is free already takes no memory, and colors of a former life do not come back. */
START_TEST(repeated_points_take_no_more)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 6, .edge = 0.1, .color = 1};
    const double origin[3] = {-1.05, -0.05, 0.05};
    const float point[3] = {1.05f, 0.05f, 0.05f}, behind[3] = {2.55f, 0.05f, 0.05f};
    const uint8_t red[3] = {250, 3, 4};
    cm_octree *octree = make_map(&options);
    cm_octree_count before = {.size = sizeof before}, after = before;
    cm_voxel voxel;
    const double at[3] = {1.05, 0.05, 0.05};
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, point, red), CM_OK);
    ck_assert(cm_octree_at(octree, at, 0, &voxel) == CM_VOXEL_OCCUPIED && voxel.has_color &&
              voxel.color[0] == 250);
    for (int i = 0; i < 2; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, behind, NULL), CM_OK);
    }
    for (int i = 0; i < 2; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, point, NULL), CM_OK);
    }
    ck_assert(cm_octree_at(octree, at, 0, &voxel) == CM_VOXEL_OCCUPIED && !voxel.has_color);
    for (int i = 0; i < 100; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, behind, NULL), CM_OK);
    }
    cm_octree_compact(octree);
    cm_octree_count_voxels(octree, &before);
    for (int i = 0; i < 3; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, behind, NULL), CM_OK);
    }
    cm_octree_compact(octree);
    cm_octree_count_voxels(octree, &after);
    ck_assert_uint_le(after.bytes, before.bytes);
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(strange_points_are_left_out)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 4, .edge = 0.1};
    const double origin[3] = {0.01, 0.02, 0.03}, nowhere[3] = {0.0, NAN, 0.0},
                 away[3] = {1e90, 1e90, -1e90};
    const float xyz[][3] = {{NAN, 0, 0},
                            {INFINITY, 0, 0},
                            {0.01f, 0.02f, 0.03f},
                            {3e38f, -3e38f, 3e38f},
                            {0, -INFINITY, 0}};
    cm_octree *octree = make_map(&options);
    ck_assert_int_eq(cm_octree_update_points(octree, nowhere, 1, xyz[0], NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octree_update_points(NULL, origin, 1, xyz[0], NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 0, NULL, NULL), CM_OK);
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, xyz[0], NULL), CM_OK);
    ck_assert_int_eq((int)cm_octree_step(octree), 0);
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 5, xyz[0], NULL), CM_OK);
    ck_assert_int_eq(cm_octree_update_points(octree, away, 5, xyz[0], NULL), CM_OK);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(octree, &count), CM_OK);
    ck_assert_msg(count.free > 4 && count.free < 128, "%d free", (int)count.free);
    cm_octree_destroy(octree);
}
END_TEST

/* A float at a border of voxels, or the next one on either side; some are beyond the map. */
static float at_border(double edge, dice *from)
{
    const float border = (float)(edge * floor(dice_between(from, -18.0, 19.0)));
    const double side = throw_dice(from);
    return side < 0.3   ? nextafterf(border, -INFINITY)
           : side < 0.6 ? nextafterf(border, INFINITY)
                        : border;
}

/* The voxel of a point, by its definition; 0: none. */
static int voxel_of(const cm_octree_options *options, const double origin[3], const float point[3],
                    int64_t voxel[3])
{
    double square = 0.0;
    int is_there = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const double away = (double)point[axis] - origin[axis];
        square += away * away;
        voxel[axis] = (int64_t)floor((double)point[axis] / options->edge + 16.0);
        is_there &= voxel[axis] >= 0 && voxel[axis] < 32;
    }
    const double range = sqrt(square);
    return is_there && range > 0.0 && range >= options->near && range <= options->far;
}

static void check_borders(const char *instructions, double edge, size_t points, dice *from)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .levels = 5,
                                       .edge = edge,
                                       .near = 5.0 * edge,
                                       .far = 13.0 * edge,
                                       .instructions = instructions,
                                       .endpoints_only = 1};
    const double origin[3] = {edge, -edge, 0.0};
    float(*xyz)[3] = calloc(points, sizeof *xyz);
    cm_octree *octree = make_map(&options);
    dense_map map = dense_make(5), wanted = dense_make(5);
    memset(wanted.alpha, 127, 32 * 32 * 32);
    for (size_t i = 0; i < points; i++)
    {
        int64_t voxel[3];
        const int alone = (int)(3.0 * throw_dice(from));
        for (int axis = 0; axis < 3; axis++)
        {
            /* many are on an axis from the origin, as far as near and far are */
            xyz[i][axis] =
                i % 2 == 0 || axis == alone ? at_border(edge, from) : (float)origin[axis];
        }
        if (voxel_of(&options, origin, xyz[i], voxel))
        {
            wanted.alpha[dense_at(&wanted, voxel[0], voxel[1], voxel[2])] = 129;
        }
    }
    ck_assert_int_eq(cm_octree_update_points(octree, origin, points, xyz[0], NULL), CM_OK);
    dense_read(octree, &map);
    ck_assert_str_eq(dense_differs(&map, &wanted), "");
    dense_clear(&map);
    dense_clear(&wanted);
    cm_octree_destroy(octree);
    free(xyz);
}

/* Points on borders of voxels and beside them, as far as near and far are and beside, by each instruction set. */
START_TEST(points_at_borders_are_of_one_voxel)
{
    static const char *const set[] = {"scalar", "sse2", "avx2", "avx512", "neon"};
    const cm_octree_options one = {.size = sizeof one, .levels = 5, .edge = 1.0};
    size_t sets = 0;
    for (size_t s = 0; s < sizeof set / sizeof *set; s++)
    {
        cm_octree_options options = one;
        cm_octree *octree = NULL;
        options.instructions = set[s];
        if (cm_octree_create(&options, &octree) != CM_OK)
        {
            continue;
        }
        cm_octree_destroy(octree);
        dice from = {7};
        for (size_t points = 1; points < 900; points += 1 + points / 2)
        {
            check_borders(set[s], 0.25, points, &from);
            check_borders(set[s], 0.1, points, &from);
        }
        sets++;
    }
    ck_assert_uint_ge(sets, 1);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {points_are_as_their_rays,           rays_go_through_regions,
                                  repeated_points_take_no_more,       strange_points_are_left_out,
                                  points_at_borders_are_of_one_voxel, NULL};
    return run_suite("octree points", tests);
}
