/* SPDX-License-Identifier: MIT
 *
 * Updates by straight cameras: every voxel of small maps against the rule of the pixel that it falls on, applied to it alone,
 * without cubes that are classified, without misses that wait. And what is promised of any update.
 */
#include "dense_map.h"

#include "modules/octree/color_word.h"
#include "modules/octree/interleave.h"
#include "modules/octree/node_tree.h"
#include "modules/octree/ray_ends.h"
#include "modules/octree/view_table.h"

/* ---- the rule, voxel by voxel ---- */

typedef struct voxel_rules
{
    const cm_octree *octree;
    const cm_view *view;
    cm_view_desk desk;
    double origin[3]; /* of the first voxel of the tree, in the camera's axes */
    double step[3][3];
} voxel_rules;

static void begin_rules(voxel_rules *rules, const cm_octree *octree, const cm_view *view,
                        size_t *valid)
{
    memset(rules, 0, sizeof *rules);
    rules->octree = octree;
    rules->view = view;
    ck_assert_int_eq(cm_view_desk_clean(&rules->desk, octree, view, NULL, valid), CM_OK);
    ck_assert_int_eq(cm_view_desk_fill(&rules->desk, octree, view, NULL), CM_OK);
    double corner[3];
    for (int axis = 0; axis < 3; axis++)
    {
        corner[axis] = octree->options.centre[axis] -
                       ldexp(octree->options.edge, octree->tree_level - 1) +
                       0.5 * octree->options.edge;
        for (int i = 0; i < 3; i++)
        {
            rules->step[axis][i] = octree->options.edge * view->pose.rotation.row[i][axis];
        }
    }
    cm_pose_apply(&view->pose, corner, rules->origin);
}

static float half_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The centre of a voxel of 2^detail edges, from the first voxel of its block, as floats. */
static void centre_of(const voxel_rules *rules, const int64_t place[3], int detail, float at[3])
{
    double first[3];
    const double more = 0.5 * ((1 << detail) - 1);
    for (int i = 0; i < 3; i++)
    {
        first[i] = rules->origin[i] + (double)(place[0] & ~7) * rules->step[0][i] +
                   (double)(place[1] & ~7) * rules->step[1][i] +
                   (double)(place[2] & ~7) * rules->step[2][i];
        const float offset = (float)(((double)(place[0] & 7) + more) * rules->step[0][i] +
                                     ((double)(place[1] & 7) + more) * rules->step[1][i] +
                                     ((double)(place[2] & 7) + more) * rules->step[2][i]);
        at[i] = (float)first[i] + offset;
    }
}

/* What the view says of a voxel: 1 a hit, -1 a miss, 0 nothing. */
static int word_of(const voxel_rules *rules, const float at[3], int detail, size_t *pixel)
{
    const cm_view_table *table = &rules->desk.table;
    if (!(at[2] > table->near))
    {
        return 0;
    }
    const float by = 1.0f / at[2];
    const float u = at[0] * by * table->focal[0] + table->centre[0];
    const float v = at[1] * by * table->focal[1] + table->centre[1];
    const float last_column = (float)(table->width - 1), last_row = (float)(table->height - 1);
    if (!(u + table->beside[0][0] * by >= -0.5f && v + table->beside[1][0] * by >= -0.5f &&
          u - table->beside[0][1] * by < last_column + 0.5f &&
          v - table->beside[1][1] * by < last_row + 0.5f))
    {
        return 0;
    }
    const int is_seen = u >= -0.5f && u < last_column + 0.5f && v >= -0.5f && v < last_row + 0.5f;
    const size_t column = (size_t)rintf(fminf(fmaxf(u, 0.0f), last_column));
    const size_t row = (size_t)rintf(fminf(fmaxf(v, 0.0f), last_row));
    *pixel = row * table->width + column;
    const size_t index = row * table->stride + column;
    const cm_pixel_rule *rule = &table->rule[index];
    const float reach = half_of(rule->reach_front << 16),
                front = half_of(rule->reach_front & 0x7fff0000u);
    const float more = fmaxf(reach, 0.0f) * ((float)(1 << detail) - 1.0f);
    const float away = at[2] - rule->depth;
    const int has_gap = (rule->reach_front & CM_RULE_HAS_GAP) != 0;
    const int is_in_gap =
        has_gap && at[2] > table->gap[index].from + more && at[2] < table->gap[index].to - more;
    return is_seen && fabsf(away) <= reach * (float)(1 << detail) ? 1
           : away + (front + more) < 0.0f || is_in_gap            ? -1
                                                                  : 0;
}

static int clamped(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* A word of color for a voxel's history: kept beside the map's 8 bits. */
typedef struct told_map
{
    dense_map map; /* color: as words of cm_color_mix */
    size_t hits;
    size_t misses;
} told_map;

static void apply_word(told_map *oracle, const voxel_rules *rules, size_t at, int word,
                       size_t pixel)
{
    const cm_count_rule *rule = &rules->octree->rule;
    const int old = oracle->map.alpha[at];
    const int now = clamped(old + (word > 0 ? rule->hit : -rule->miss), rule->low, rule->high);
    oracle->hits += word > 0;
    oracle->misses += word < 0;
    oracle->map.alpha[at] = (uint8_t)now;
    uint32_t *color = &oracle->map.color[at];
    if (now <= 127)
    {
        *color = 0;
    }
    else if (word > 0 && rules->octree->options.color && rules->view->color.data != NULL)
    {
        const uint8_t *rgb =
            (const uint8_t *)rules->view->color.data + rules->view->color.channels * pixel;
        *color = cm_color_mix(*color, cm_color_word(rgb),
                              (unsigned)(now - 127 + rule->hit - 1) / rule->hit);
    }
}

/* What a view says of every voxel: the same each time that it comes. */
typedef struct told_words
{
    voxel_rules rules;
    size_t voxels;
    int8_t *word;
    uint32_t *pixel;
} told_words;

/* The point that a pixel sees is in the voxel, but for the rounding of floats. */
static void check_end(const voxel_rules *rules, const uint32_t place[3], uint32_t column,
                      uint32_t row)
{
    const cm_view_table *table = &rules->desk.table;
    const double depth = (double)table->rule[row * table->stride + column].depth;
    const double in_camera[3] = {
        ((double)column - (double)table->centre[0]) / (double)table->focal[0] * depth,
        ((double)row - (double)table->centre[1]) / (double)table->focal[1] * depth, depth};
    const cm_octree_options *options = &rules->octree->options;
    double point[3];
    cm_pose_apply_back(&rules->view->pose, in_camera, point);
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = (point[axis] - options->centre[axis]) / options->edge +
                          ldexp(1.0, rules->octree->tree_level - 1) - place[axis];
        const double little = 1e-3 + 1e-6 * depth / options->edge;
        ck_assert_msg(at >= -little && at <= 1.0 + little, "a ray ends %g edges along axis %d", at,
                      axis);
    }
}

/* What rays end in is hit by their pixels unless it is by its own. */
static void add_ends(told_words *words, const dense_map *map, const cm_octree *octree)
{
    voxel_rules *rules = &words->rules;
    cm_ray_ends ends;
    ck_assert_int_eq(cm_ray_ends_find(&rules->desk, octree, rules->view, NULL, &ends), CM_OK);
    for (const cm_ray_end *end = ends.first; end != ends.end; end++)
    {
        uint32_t place[3];
        cm_divide(end->key, place);
        const uint32_t column = (uint32_t)(end->pixel % rules->desk.stride);
        const uint32_t row = (uint32_t)(end->pixel / rules->desk.stride);
        check_end(rules, place, column, row);
        const size_t i =
            dense_at(map, (int64_t)place[0] - octree->first[0],
                     (int64_t)place[1] - octree->first[1], (int64_t)place[2] - octree->first[2]);
        if (words->word[i] != 1)
        {
            words->word[i] = 1;
            words->pixel[i] = row * rules->desk.width + column;
        }
    }
}

static told_words words_of(const dense_map *map, const cm_octree *octree, const cm_view *view)
{
    told_words words = {.voxels = (size_t)(map->n * map->n * map->n)};
    words.word = calloc(words.voxels, sizeof *words.word);
    words.pixel = calloc(words.voxels, sizeof *words.pixel);
    ck_assert(words.word != NULL && words.pixel != NULL);
    size_t valid = 0;
    begin_rules(&words.rules, octree, view, &valid);
    if (valid == 0 && !octree->options.no_return_is_free)
    {
        return words;
    }
    const uint32_t *first = octree->first;
    for (int64_t z = 0; z < map->n; z++)
    {
        for (int64_t y = 0; y < map->n; y++)
        {
            for (int64_t x = 0; x < map->n; x++)
            {
                const int64_t place[3] = {x + first[0], y + first[1], z + first[2]};
                const size_t i = dense_at(map, x, y, z);
                float at[3];
                size_t pixel = 0;
                centre_of(&words.rules, place, 0, at);
                words.word[i] = (int8_t)word_of(&words.rules, at, 0, &pixel);
                words.pixel[i] = (uint32_t)pixel;
            }
        }
    }
    add_ends(&words, map, octree);
    return words;
}

static void clear_words(told_words *words)
{
    cm_view_desk_clear(&words->rules.desk);
    free(words->word);
    free(words->pixel);
}

static void update_oracle(told_map *oracle, const told_words *words)
{
    for (size_t i = 0; i < words->voxels; i++)
    {
        if (words->word[i] != 0)
        {
            apply_word(oracle, &words->rules, i, words->word[i], words->pixel[i]);
        }
    }
}

static const char *oracle_differs(const told_map *oracle, const cm_octree *octree)
{
    dense_map shown = dense_make(octree->options.levels), read = dense_make(octree->options.levels);
    const size_t voxels = (size_t)(shown.n * shown.n * shown.n);
    memcpy(shown.alpha, oracle->map.alpha, voxels);
    for (size_t i = 0; i < voxels; i++)
    {
        uint8_t rgb[3];
        cm_color_to(oracle->map.color[i], rgb);
        shown.color[i] = oracle->map.color[i] == 0
                             ? 0
                             : 1u << 24 | (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
    }
    dense_read(octree, &read);
    const char *text = dense_differs(&read, &shown);
    dense_clear(&shown);
    dense_clear(&read);
    return text;
}

/* ---- cases ---- */

static cm_octree_options drawn_options(int levels, dice *from)
{
    cm_octree_options options = {
        .size = sizeof options, .levels = levels, .edge = ldexp(3.2, -levels)};
    options.edge *= dice_between(from, 0.8, 1.3);
    for (int axis = 0; axis < 3; axis++)
    {
        options.centre[axis] = throw_dice(from) < 0.3 ? 0.0 : dice_between(from, -20.0, 20.0);
    }
    if (throw_dice(from) < 0.4)
    {
        options.rule = CM_OCTREE_LOG_ODDS;
        options.hit = dice_between(from, 0.2, 1.5);
        options.miss = dice_between(from, -0.9, -0.02);
        options.low = dice_between(from, -3.0, -0.5);
        options.high = dice_between(from, 0.5, 4.0);
    }
    options.near = throw_dice(from) < 0.5 ? 0.0 : dice_between(from, 0.05, 0.8);
    options.far = throw_dice(from) < 0.5 ? 0.0 : dice_between(from, 1.2, 3.0);
    options.no_return_is_free = options.far > 0.0 && throw_dice(from) < 0.5;
    options.noise = throw_dice(from) < 0.6 ? 0.0 : dice_between(from, 0.002, 0.05);
    options.color = throw_dice(from) < 0.7;
    return options;
}

static cm_pose drawn_pose(const cm_octree_options *options, dice *from)
{
    const double size = ldexp(options->edge, options->levels);
    double place[3], at[3];
    const double away = throw_dice(from) < 0.6 ? 0.4 : 1.2;
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = options->centre[axis] + size * dice_between(from, -away, away);
        at[axis] = options->centre[axis] + size * dice_between(from, -0.4, 0.4);
    }
    return look_at(place, at, dice_between(from, 0.0, 6.28));
}

static void spoil(drawn_view *drawn, dice *from)
{
    const size_t pixels = (size_t)drawn->view.depth.width * drawn->view.depth.height;
    const double what = throw_dice(from);
    for (size_t i = 0; what < 0.1 && i < pixels; i++)
    {
        drawn->depth[i] = NAN;
    }
    const float strange[] = {1.7e7f, INFINITY, -1.0f, 1e-30f, 3e38f, 0.0f};
    for (int i = 0; what > 0.6 && i < 6; i++)
    {
        drawn->depth[(size_t)((double)pixels * throw_dice(from))] = strange[i];
    }
}

/* The axes of a camera whose picture lies so many widths beside its principal point, turned so that the picture is where the pose
 * looks. */
static void turn_aside(cm_pose *pose, double aside)
{
    const double angle = atan2(aside, 0.9), cosine = cos(angle), sine = sin(angle);
    for (int i = 0; i < 3; i++)
    {
        const double x = pose->rotation.row[0][i], z = pose->rotation.row[2][i];
        pose->rotation.row[0][i] = cosine * x - sine * z;
        pose->rotation.row[2][i] = cosine * z + sine * x;
    }
}

static cm_camera *camera_aside(const cm_camera *camera, double aside)
{
    cm_camera_options options = *cm_camera_describe(camera);
    options.cx += aside * options.width;
    cm_camera *made = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &made), CM_OK);
    return made;
}

/* aside: widths that the principal point is beside the picture. How many voxels are known in the end. */
static size_t check_case(int levels, int views, uint64_t seed, double aside)
{
    dice from = {seed};
    const cm_octree_options options = drawn_options(levels, &from);
    cm_octree *octree = make_map(&options);
    told_map oracle = {.map = dense_make(levels)};
    cm_camera *middle = straight_camera(40 + (uint32_t)(seed % 60), 30 + (uint32_t)(seed % 37),
                                        0.5 * (double)(seed % 2));
    cm_camera *camera = camera_aside(middle, aside);
    const double nearer = 0.9 / sqrt(0.81 + aside * aside);
    size_t known = 0;
    cm_pool *pool = make_pool(seed % 3 == 0 ? 2 : 1);
    cm_pose pose = drawn_pose(&options, &from);
    for (int i = 0; i < views; i++)
    {
        drawn_view drawn;
        pose = throw_dice(&from) < 0.5 ? pose : drawn_pose(&options, &from);
        draw_view(&drawn, camera, &pose, nearer * dice_between(&from, 0.8, 2.5),
                  throw_dice(&from) < 0.8, &from);
        turn_aside(&drawn.view.pose, aside);
        drawn.view.depth_is_range = throw_dice(&from) < 0.3;
        spoil(&drawn, &from);
        const int repeats = throw_dice(&from) < 0.2 ? 70 : 1; /* up to the ends of the range */
        ck_assert_int_eq(cm_octree_update(octree, &drawn.view, pool), CM_OK);
        told_words words = words_of(&oracle.map, octree, &drawn.view); /* the tree stands now */
        update_oracle(&oracle, &words);
        for (int k = 1; k < repeats; k++)
        {
            ck_assert_int_eq(cm_octree_update(octree, &drawn.view, pool), CM_OK);
            update_oracle(&oracle, &words);
        }
        clear_words(&words);
        if (throw_dice(&from) < 0.3)
        {
            ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
        }
        const char *text = oracle_differs(&oracle, octree);
        ck_assert_msg(text[0] == '\0', "levels %d seed %d view %d: %s", levels, (int)seed, i, text);
        clear_view(&drawn);
    }
    for (size_t i = 0; i < (size_t)1 << 3 * levels; i++)
    {
        known += oracle.map.alpha[i] != 127;
    }
    cm_pool_destroy(pool);
    cm_camera_destroy(middle);
    cm_camera_destroy(camera);
    dense_clear(&oracle.map);
    cm_octree_destroy(octree);
    return known;
}

START_TEST(every_counter_is_exact)
{
    const struct
    {
        int levels, views, cases;
    } all[] = {{1, 6, 12}, {2, 6, 12}, {3, 6, 20}, {4, 6, 20},
               {5, 5, 10}, {6, 3, 6},  {7, 2, 3},  {8, 1, 1}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    {
        for (int k = 0; k < all[i].cases; k += is_quick() ? 4 : 1)
        {
            check_case(all[i].levels, all[i].views, 100 * (uint64_t)i + (uint64_t)k, 0.0);
        }
    }
}
END_TEST

/* Pictures cut out of wider ones have their principal point far beside them. */
START_TEST(cut_pictures_are_exact)
{
    const double asides[] = {1.0, -1.5, 4.0, -6.0};
    for (size_t i = 0; i < sizeof asides / sizeof *asides; i++)
    {
        size_t known = 0;
        for (uint64_t k = 0; k < 6; k++)
        {
            known += check_case(5 + (int)(k % 2), 3, 1000 + 10 * (uint64_t)i + k, asides[i]);
        }
        ck_assert_msg(known > 100, "%g aside: %zu known", asides[i], known);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {every_counter_is_exact, cut_pictures_are_exact, NULL};
    return run_suite("octree update", tests);
}
