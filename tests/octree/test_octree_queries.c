/* SPDX-License-Identifier: MIT
 *
 * What is asked of a map, against all of its voxels one by one.
 */
#include "dense_map.h"

static cm_camera *camera;

/* A map of views from some places, with colors, and one with coarser voxels. */
static cm_octree *drawn_map(int levels, double footprint, int compacts)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .levels = levels,
                                       .edge = ldexp(3.2, -levels),
                                       .color = 1,
                                       .footprint = footprint};
    cm_octree *octree = make_map(&options);
    dice from = {7};
    for (int i = 0; i < 5; i++)
    {
        add_drawn_view(octree, camera, i, &from);
    }
    if (compacts)
    {
        ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
    }
    return octree;
}

static double centre_of(const cm_octree_options *options, int axis, int64_t place, int level)
{
    const int64_t half = (int64_t)1 << (options->levels - 1);
    return options->centre[axis] +
           options->edge * ((double)(place - half) + 0.5 * ldexp(1.0, level));
}

/* ---- levels ---- */

/* Free voxels count as unknown where any is occupied, which stays so. */
static int average(const dense_map *map, const int64_t first[3], int64_t size)
{
    int64_t above = 0, below = 0;
    const int64_t voxels = size * size * size;
    for (int64_t z = first[2]; z < first[2] + size; z++)
    {
        for (int64_t y = first[1]; y < first[1] + size; y++)
        {
            for (int64_t x = first[0]; x < first[0] + size; x++)
            {
                const int alpha = map->alpha[dense_at(map, x, y, z)];
                above += alpha > 127 ? alpha - 127 : 0;
                below += alpha < 127 ? 127 - alpha : 0;
            }
        }
    }
    const int64_t mean = ((above > 0 ? above : below) + voxels / 2) / voxels;
    return (int)(above > 0 ? (mean > 0 ? 127 + mean : 128) : 127 - mean);
}

static void check_levels(cm_octree *octree, int first_level)
{
    const cm_octree_options *options = cm_octree_describe(octree);
    dense_map map = dense_make(options->levels);
    dense_read(octree, &map);
    for (int level = first_level; level <= options->levels; level++)
    {
        const int64_t size = (int64_t)1 << level, count = map.n / size;
        size_t occupied = 0, extracted = 0;
        for (int64_t i = 0; i < count * count * count; i++)
        {
            const int64_t first[3] = {i % count * size, i / count % count * size,
                                      i / count / count * size};
            double point[3];
            for (int axis = 0; axis < 3; axis++)
            {
                point[axis] = centre_of(options, axis, first[axis], level) + 0.3 * options->edge;
            }
            cm_voxel voxel;
            const int state = cm_octree_at(octree, point, level, &voxel),
                      wanted = average(&map, first, size);
            ck_assert_msg(voxel.alpha == wanted, "levels %d, level %d: %d, not %d", options->levels,
                          level, voxel.alpha, wanted);
            ck_assert(state == voxel.state && voxel.level == level &&
                      voxel.edge == ldexp(options->edge, level));
            for (int axis = 0; axis < 3; axis++)
            {
                const double is = axis == 0 ? voxel.x : axis == 1 ? voxel.y : voxel.z;
                ck_assert(fabs(is - centre_of(options, axis, first[axis], level)) < 1e-9);
            }
            occupied += state == CM_VOXEL_OCCUPIED;
        }
        ck_assert_int_eq(cm_octree_extract(octree, level, 0, NULL, &extracted),
                         occupied > 0 ? CM_ERROR_SPACE : CM_OK);
        ck_assert_msg(extracted == occupied, "levels %d, level %d: %zu extracted, not %zu",
                      options->levels, level, extracted, occupied);
        cm_voxel *list = malloc((occupied + 1) * sizeof *list);
        ck_assert_int_eq(cm_octree_extract(octree, level, occupied, list, &extracted), CM_OK);
        for (size_t i = 0; i < occupied; i++)
        {
            const double point[3] = {list[i].x, list[i].y, list[i].z};
            cm_voxel voxel;
            ck_assert(cm_octree_at(octree, point, level, &voxel) == CM_VOXEL_OCCUPIED);
            ck_assert(voxel.x == list[i].x && voxel.alpha == list[i].alpha &&
                      voxel.color[1] == list[i].color[1]);
            ck_assert(i == 0 || list[i].x != list[i - 1].x || list[i].y != list[i - 1].y ||
                      list[i].z != list[i - 1].z);
        }
        free(list);
    }
    cm_octree_count number = {.size = sizeof number};
    ck_assert_int_eq(cm_octree_count_voxels(octree, &number), CM_OK);
    uint64_t known[2] = {0, 0};
    for (size_t i = 0; i < (size_t)(map.n * map.n * map.n); i++)
    {
        known[0] += map.alpha[i] < 127;
        known[1] += map.alpha[i] > 127;
    }
    ck_assert_msg(number.free == known[0] && number.occupied == known[1],
                  "levels %d: %d %d, not %d %d", options->levels, (int)number.free,
                  (int)number.occupied, (int)known[0], (int)known[1]);
    dense_clear(&map);
}

START_TEST(levels_are_averages)
{
    for (int levels = 1; levels <= 7; levels += (int)step_of(3))
    {
        cm_octree *octree = drawn_map(levels, 0.0, levels % 2);
        check_levels(octree, 0);
        cm_octree_destroy(octree);
        octree = drawn_map(levels, 2.0, levels % 2);
        check_levels(octree, 1);
        cm_octree_destroy(octree);
    }
}
END_TEST

START_TEST(beyond_the_map_is_nothing)
{
    cm_octree *octree = drawn_map(5, 0.0, 0);
    const double places[][3] = {{1.7, 0, 0},      {-1.601, 0, 0}, {NAN, 0, 0},
                                {0, INFINITY, 0}, {0, 1.6, 0},    {1e300, 0, 0}};
    cm_voxel voxel;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        memset(&voxel, 1, sizeof voxel);
        ck_assert(cm_octree_at(octree, places[i], 0, &voxel) == CM_VOXEL_UNKNOWN &&
                  voxel.edge == 0.0);
        ck_assert(cm_octree_at(octree, places[i], 3, NULL) == CM_VOXEL_UNKNOWN);
    }
    const double middle[3] = {0};
    size_t count = 77;
    ck_assert(cm_octree_at(octree, middle, 6, &voxel) == CM_VOXEL_UNKNOWN && voxel.edge == 0.0);
    ck_assert(cm_octree_at(octree, middle, -1, &voxel) == CM_VOXEL_UNKNOWN && voxel.edge == 0.0);
    ck_assert_int_eq(cm_octree_extract(octree, 6, 0, NULL, &count), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_octree_extract(octree, -1, 0, NULL, &count), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_octree_extract(octree, 0, 1, NULL, &count), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(count, 77);
    cm_octree_destroy(octree);
}
END_TEST

/* ---- rays ---- */

/* What part of the ray is in a voxel; 0 if none is. Infinite and NaN of axes that it stands still on are as none. */
static int crosses(const double low[3], double edge, const double origin[3],
                   const double direction[3], double narrow, double part[2])
{
    part[0] = 0.0;
    part[1] = INFINITY;
    for (int axis = 0; axis < 3; axis++)
    {
        const double a = low[axis] - origin[axis], b = a + edge;
        if (direction[axis] == 0.0)
        {
            part[1] = a >= -narrow || b <= narrow ? -1.0 : part[1];
            continue;
        }
        part[0] = fmax(part[0], fmin(a / direction[axis], b / direction[axis]));
        part[1] = fmin(part[1], fmax(a / direction[axis], b / direction[axis]));
    }
    return part[0] <= part[1];
}

typedef struct ray_walk
{
    double last;
    double known; /* length of what was given */
    double first_occupied;
    size_t count;
} ray_walk;

static int walk_voxel(void *user, const cm_voxel *voxel)
{
    ray_walk *walk = user;
    ck_assert(voxel->distance >= walk->last && voxel->alpha != 127);
    walk->last = voxel->distance;
    walk->count++;
    if (voxel->state == CM_VOXEL_OCCUPIED)
    {
        walk->first_occupied = fmin(walk->first_occupied, voxel->distance);
    }
    return walk->count > 100000;
}

static void check_ray(const cm_octree *octree, const dense_map *map, const double origin[3],
                      const double towards[3], double far)
{
    const cm_octree_options *options = cm_octree_describe(octree);
    const double length =
        sqrt(towards[0] * towards[0] + towards[1] * towards[1] + towards[2] * towards[2]);
    const double direction[3] = {towards[0] / length, towards[1] / length, towards[2] / length};
    double surely = INFINITY, perhaps = INFINITY;
    for (size_t i = 0; i < (size_t)(map->n * map->n * map->n); i++)
    {
        if (map->alpha[i] <= 127)
        {
            continue;
        }
        const int64_t n = map->n,
                      place[3] = {(int64_t)i % n, (int64_t)i / n % n, (int64_t)i / n / n};
        double low[3], wide[3], part[2];
        for (int axis = 0; axis < 3; axis++)
        {
            low[axis] = centre_of(options, axis, place[axis], 0) - 0.5 * options->edge;
            wide[axis] = low[axis] - 1e-9;
        }
        if (crosses(low, options->edge, origin, direction, 1e-9, part) && part[1] - part[0] > 1e-8)
        {
            surely = fmin(surely, part[0]);
        }
        if (crosses(wide, options->edge + 2e-9, origin, direction, 0.0, part))
        {
            perhaps = fmin(perhaps, part[0]);
        }
    }
    cm_voxel voxel;
    const int met = cm_octree_ray(octree, origin, towards, far, &voxel);
    const double end = far > 0.0 ? far : INFINITY;
    ray_walk walk = {.first_occupied = INFINITY};
    ck_assert_int_eq(cm_octree_walk_ray(octree, origin, towards, far, walk_voxel, &walk), CM_OK);
    /* a ray along a border may meet either voxel beside it, each way its own */
    ck_assert(!isfinite(walk.first_occupied) ||
              (walk.first_occupied >= perhaps - 1e-7 && walk.first_occupied <= end));
    ck_assert(!(surely < end - 1e-7) || walk.first_occupied <= surely + 1e-7);
    if (surely < end - 1e-7)
    {
        ck_assert_msg(
            met && voxel.distance <= surely + 1e-7,
            "a voxel at %g is passed by %d %g from %.17g %.17g %.17g towards %.17g %.17g %.17g",
            surely, met, met ? voxel.distance : 0.0, origin[0], origin[1], origin[2], towards[0],
            towards[1], towards[2]);
    }
    if (met)
    {
        ck_assert_msg(voxel.distance >= perhaps - 1e-7 && voxel.distance <= end, "%g, before %g",
                      voxel.distance, perhaps);
    }
}

START_TEST(rays_meet_the_first)
{
    for (int levels = 2; levels <= 6; levels += 2)
    {
        for (int footprint = 0; footprint < 2; footprint++)
        {
            cm_octree *octree = drawn_map(levels, 2.0 * footprint, footprint);
            const double edge = cm_octree_describe(octree)->edge;
            dense_map map = dense_make(levels);
            dense_read(octree, &map);
            dice from = {11};
            for (int i = 0; i < (levels == 6 ? 150 : 300); i++)
            {
                const double size = i % 3 == 0 ? 1.5 : i % 3 == 1 ? 5.0 : 1e4;
                double origin[3], towards[3], at[3];
                for (int axis = 0; axis < 3; axis++)
                {
                    origin[axis] = dice_between(&from, -size, size);
                    at[axis] = dice_between(&from, -1.0, 1.0);
                    /* along borders of voxels, and through corners */
                    origin[axis] = i % 5 == 0 ? edge * floor(origin[axis] / edge) : origin[axis];
                    at[axis] = i % 10 == 0 ? edge * floor(at[axis] / edge) : at[axis];
                }
                for (int axis = 0; axis < 3; axis++)
                {
                    towards[axis] = (at[axis] - origin[axis]) * (i % 2 ? 1.0 : 17.0);
                    if (i % 4 == 0 && axis != i / 4 % 3)
                    {
                        towards[axis] = 0.0;
                        origin[axis] = at[axis];
                    }
                }
                towards[0] += (double)(towards[0] == 0.0 && towards[1] == 0.0 && towards[2] == 0.0);
                check_ray(octree, &map, origin, towards, i % 7 == 0 ? 0.7 : 0.0);
            }
            dense_clear(&map);
            cm_octree_destroy(octree);
        }
    }
}
END_TEST

START_TEST(strange_rays_end)
{
    cm_octree *octree = drawn_map(6, 0.0, 0);
    const double strange[] = {0.0,   -0.0,  1e-300,   1e-12, 1.0, 1e12,
                              1e300, -1e20, INFINITY, NAN,   -1.0};
    const size_t n = sizeof strange / sizeof *strange;
    for (size_t i = 0; i < n * n * n; i++)
    {
        const double origin[3] = {strange[i % n], 0.05, strange[i / n % n]};
        const double towards[3] = {strange[i / n % n], strange[i / n / n], strange[i % n]};
        cm_voxel voxel;
        const int met = cm_octree_ray(octree, origin, towards, 0.0, &voxel);
        ray_walk walk = {.first_occupied = INFINITY};
        ck_assert_int_eq(cm_octree_walk_ray(octree, origin, towards, 0.0, walk_voxel, &walk),
                         CM_OK);
        ck_assert_msg(!met || voxel.distance >= 0.0, "%g", voxel.distance);
    }
    cm_octree_destroy(octree);
}
END_TEST

/* Only the direction counts: a ray of any length meets the same. */
START_TEST(long_and_short_rays_are_alike)
{
    cm_octree *octree = drawn_map(6, 0.0, 0);
    const double lengths[] = {0x1p-1020, 0x1p-600, 0x1p-3, 0x1p400, 0x1p1020};
    dice from = {23};
    int met = 0;
    for (int i = 0; i < 200; i++)
    {
        double origin[3], towards[3];
        for (int axis = 0; axis < 3; axis++)
        {
            origin[axis] = dice_between(&from, -2.0, 2.0);
            towards[axis] = i % 3 == axis ? 0.0 : dice_between(&from, -1.0, 1.0) - origin[axis];
        }
        cm_voxel voxel = {0};
        const int usual = cm_octree_ray(octree, origin, towards, 0.0, &voxel);
        met += usual;
        for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        {
            const double other[3] = {towards[0] * lengths[k], towards[1] * lengths[k],
                                     towards[2] * lengths[k]};
            cm_voxel again = {0};
            ck_assert_msg(cm_octree_ray(octree, origin, other, 0.0, &again) == usual &&
                              again.distance == voxel.distance,
                          "ray %d of length %g: %g, not %g", i, lengths[k], again.distance,
                          voxel.distance);
        }
    }
    ck_assert_int_gt(met, 20);
    cm_octree_destroy(octree);
}
END_TEST

/* ---- the nearest, and boxes ---- */

START_TEST(the_nearest_is_the_nearest)
{
    for (int levels = 1; levels <= 6; levels++)
    {
        cm_octree *octree = drawn_map(levels, levels == 5 ? 2.0 : 0.0, levels % 2);
        const cm_octree_options *options = cm_octree_describe(octree);
        dense_map map = dense_make(levels);
        dense_read(octree, &map);
        dice from = {3};
        for (int i = 0; i < 60; i += (int)step_of(4))
        {
            double point[3], best = INFINITY, radius = i % 3 == 0 ? 0.2 : i % 3 == 1 ? 1.0 : 1e4;
            for (int axis = 0; axis < 3; axis++)
            {
                point[axis] = dice_between(&from, -3.0, 3.0);
                point[axis] =
                    i % 5 == 0 ? options->edge * floor(point[axis] / options->edge) : point[axis];
            }
            for (size_t k = 0; k < (size_t)(map.n * map.n * map.n); k++)
            {
                const int64_t n = map.n,
                              place[3] = {(int64_t)k % n, (int64_t)k / n % n, (int64_t)k / n / n};
                double square = 0.0;
                for (int axis = 0; axis < 3; axis++)
                {
                    const double away = centre_of(options, axis, place[axis], 0) - point[axis];
                    square += away * away;
                }
                best = map.alpha[k] > 127 ? fmin(best, square) : best;
            }
            cm_voxel voxel;
            const int found = cm_octree_nearest(octree, point, radius, &voxel);
            ck_assert(fabs(sqrt(best) - radius) < 1e-9 || found == (sqrt(best) <= radius));
            if (found)
            {
                const double there[3] = {voxel.x, voxel.y, voxel.z};
                const double x = voxel.x - point[0], y = voxel.y - point[1], z = voxel.z - point[2];
                ck_assert(fabs(voxel.distance - sqrt(best)) < 1e-9);
                ck_assert(fabs(sqrt(x * x + y * y + z * z) - voxel.distance) < 1e-9 &&
                          voxel.level == 0);
                ck_assert_int_eq(cm_octree_at(octree, there, 0, NULL), CM_VOXEL_OCCUPIED);
                /* what is as far as the radius is within it */
                ck_assert_int_eq(cm_octree_nearest(octree, point, voxel.distance, NULL), 1);
                ck_assert_int_eq(
                    cm_octree_nearest(octree, point, nextafter(voxel.distance, 0.0), NULL), 0);
            }
        }
        dense_clear(&map);
        cm_octree_destroy(octree);
    }
}
END_TEST

typedef struct box_walk
{
    const double *least, *greatest;
    const cm_octree *octree;
    uint64_t voxels;
    int64_t sum;
} box_walk;

static int add_voxel(void *user, const cm_voxel *voxel)
{
    box_walk *walk = user;
    walk->voxels += (uint64_t)1 << 3 * voxel->level;
    walk->sum += (int64_t)voxel->alpha << 3 * voxel->level;
    return 0;
}

START_TEST(boxes_have_what_is_centred_in_them)
{
    for (int levels = 1; levels <= 6; levels++)
    {
        cm_octree *octree = drawn_map(levels, 0.0, levels % 2);
        const cm_octree_options *options = cm_octree_describe(octree);
        dense_map map = dense_make(levels);
        dense_read(octree, &map);
        dice from = {3};
        for (int i = 0; i < 30; i += (int)step_of(4))
        {
            double least[3], greatest[3];
            for (int axis = 0; axis < 3; axis++)
            {
                least[axis] = dice_between(&from, -2.0, 1.0);
                greatest[axis] = least[axis] + dice_between(&from, -0.1, 2.0);
                /* on centres, which are in it, and on borders */
                least[axis] =
                    i % 3 == 0
                        ? centre_of(options, axis, (int64_t)(throw_dice(&from) * (double)map.n), 0)
                        : least[axis];
                greatest[axis] = i % 6 == 0 ? least[axis] : greatest[axis];
            }
            box_walk walk = {.voxels = 0}, wanted = {.voxels = 0};
            for (size_t k = 0; k < (size_t)(map.n * map.n * map.n); k++)
            {
                const int64_t n = map.n,
                              place[3] = {(int64_t)k % n, (int64_t)k / n % n, (int64_t)k / n / n};
                int is_in = map.alpha[k] != 127;
                for (int axis = 0; axis < 3; axis++)
                {
                    const double centre = centre_of(options, axis, place[axis], 0);
                    is_in &= centre >= least[axis] && centre <= greatest[axis];
                }
                wanted.voxels += (uint64_t)is_in;
                wanted.sum += is_in ? map.alpha[k] : 0;
            }
            ck_assert_int_eq(cm_octree_walk_box(octree, least, greatest, add_voxel, &walk), CM_OK);
            ck_assert_msg(walk.voxels == wanted.voxels && walk.sum == wanted.sum,
                          "levels %d, box %d: %d voxels, not %d", levels, i, (int)walk.voxels,
                          (int)wanted.voxels);
        }
        dense_clear(&map);
        cm_octree_destroy(octree);
    }
}
END_TEST

static int keep_larger(void *user, const cm_voxel *voxel)
{
    cm_voxel *kept = user;
    *kept = voxel->level > 0 && voxel->level < 3 ? *voxel : *kept;
    return kept->level > 0;
}

static int is_voxel(void *user, const cm_voxel *voxel)
{
    const cm_voxel *wanted = user;
    return voxel->x == wanted->x && voxel->y == wanted->y && voxel->z == wanted->z &&
           voxel->level == wanted->level;
}

/* The centre of a voxel of several edges is on a border of finest ones. */
START_TEST(boxes_have_larger_voxels_that_are_centred_in_them)
{
    cm_octree *octree = drawn_map(6, 3.0, 0);
    const double edge = cm_octree_describe(octree)->edge;
    cm_voxel larger = {.level = 0};
    ck_assert_int_eq(cm_octree_walk_changes(octree, 0, keep_larger, &larger), CM_ERROR_STOPPED);
    const double centre[3] = {larger.x, larger.y, larger.z};
    for (int i = 0; i < 4; i++)
    {
        double least[3], greatest[3];
        for (int axis = 0; axis < 3; axis++)
        {
            least[axis] = centre[axis] - (i & 1 ? 0.4 * edge : 0.0);
            greatest[axis] = centre[axis] + (i & 2 ? 0.4 * edge : 0.0);
        }
        ck_assert_int_eq(cm_octree_walk_box(octree, least, greatest, is_voxel, &larger),
                         CM_ERROR_STOPPED);
        box_walk walk = {.voxels = 0};
        cm_octree_walk_box(octree, least, greatest, add_voxel, &walk);
        ck_assert_int_eq((int64_t)walk.voxels, (int64_t)1 << 3 * larger.level);
        greatest[2] = least[2] = centre[2] + 0.01 * edge; /* of none */
        ck_assert_int_eq(cm_octree_walk_box(octree, least, greatest, is_voxel, &larger), CM_OK);
    }
    cm_octree_destroy(octree);
}
END_TEST

/* There is no time to count the voxels of a large cube one by one. */
START_TEST(large_cubes_are_counted_at_once)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 16, .edge = 0.01};
    cm_octree *octree = even_map(&options, 1);
    for (int level = 0; level <= options.levels; level++)
    {
        cm_voxel voxel[3];
        size_t count = 0;
        const size_t room = level + 1 >= options.levels ? 0 : 3;
        ck_assert_int_eq(cm_octree_extract(octree, level, room, voxel, &count), CM_ERROR_SPACE);
        ck_assert_uint_eq(count, (size_t)1 << 3 * (options.levels - level));
        const double edge = ldexp(options.edge, level), corner = -ldexp(options.edge, 15);
        for (size_t i = 0; i < room; i++)
        {
            ck_assert_double_eq_tol(voxel[i].x, corner + edge * (0.5 + (double)(i & 1)), 1e-9);
            ck_assert_double_eq_tol(voxel[i].y, corner + edge * (0.5 + (double)(i >> 1)), 1e-9);
            ck_assert_int_eq(voxel[i].state, CM_VOXEL_OCCUPIED);
        }
    }
    cm_octree_destroy(octree);
}
END_TEST

/* All voxels of the largest root are 2^60, and alphas of all of them more than 64 bits hold. */
START_TEST(the_largest_cubes_are_averages)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 20, .edge = 0x1p-10};
    for (int is_occupied = 0; is_occupied < 2; is_occupied++)
    {
        cm_octree *octree = even_map(&options, is_occupied);
        for (int level = 0; level <= options.levels; level++)
        {
            cm_voxel voxel;
            cm_octree_at(octree, (const double[3]){0.1, 0.1, 0.1}, level, &voxel);
            ck_assert_msg(voxel.alpha == 255 * is_occupied, "level %d: %d", level, voxel.alpha);
        }
        /* an eighth of it, and one voxel more */
        cm_octree_options aside = options;
        aside.centre[0] = aside.centre[1] = aside.centre[2] = -ldexp(options.edge, 19);
        cm_octree *part = make_map(&aside);
        ck_assert_int_eq(cm_octree_merge(part, octree, NULL), CM_OK);
        cm_voxel root;
        cm_octree_at(part, aside.centre, 20, &root);
        ck_assert_int_eq(root.alpha, is_occupied ? 127 + 16 : 127 - 16);
        const float point[3] = {-600.0f, -600.0f, -600.0f};
        const double origin[3] = {-600.0, -600.0, -601.0};
        ck_assert_int_eq(cm_octree_update_points(part, origin, 1, point, NULL), CM_OK);
        cm_octree_at(part, aside.centre, 20, &root);
        ck_assert_int_eq(root.alpha, is_occupied ? 127 + 16 : 128);
        cm_octree_destroy(part);
        cm_octree_destroy(octree);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {levels_are_averages,
                                  beyond_the_map_is_nothing,
                                  rays_meet_the_first,
                                  strange_rays_end,
                                  long_and_short_rays_are_alike,
                                  the_nearest_is_the_nearest,
                                  boxes_have_what_is_centred_in_them,
                                  boxes_have_larger_voxels_that_are_centred_in_them,
                                  large_cubes_are_counted_at_once,
                                  the_largest_cubes_are_averages,
                                  NULL};
    camera = straight_camera(60, 44, 0.5);
    const int result = run_suite("octree queries", tests);
    cm_camera_destroy(camera);
    return result;
}
