/* SPDX-License-Identifier: MIT
 *
 * From derivatives to footprints, and which level of the pyramid they are laid on.
 */
#include "ewa.h"
#include "ewa_pole.h"
#include "ewa_window.h"
#include "survey.h"

#include <math.h>
#include <string.h>

/* research/image/ewa-kernel has where the terms come from. */
static const cm_ewa_kernel kernel = {.term = {-0.21568027f, 0.77840737f, -1.34269608f, 1.00000000f},
                                     .radius = 1.85f};

/* Pixels beyond the edges of the pictures themselves: what is seldom more than 2 pixels wide reaches 4 of them. */
#define PICTURE_BORDER 8

/* ---- which levels ---- */

/* Blocks of the target that are looked at. */
#define BLOCKS_SEEN 24

/* The squares of how many pixels minor axes have, summed over what has been seen, by cm_pyramid_steps. */
typedef struct step_costs
{
    const cm_filter_set *set;
    double of[2];
    float largest; /* of them */
    cm_ewa_axes axes;
} step_costs;

/* How many pixels are one of the level for that minor axis, which is `first` of them or a power of 2 more; squares. */
static float level_square(float minor, float first)
{
    const float least = (float)(CM_EWA_MINOR * CM_EWA_MINOR);
    float square = first * first;
    if (!(minor >= least * square))
    {
        return 1.0f;
    }
    while (minor >= 4.0f * least * square && square < 1e18f)
    {
        square *= 4.0f;
    }
    return square;
}

static cm_status add_costs(void *user, const cm_group *group)
{
    step_costs *costs = user;
    const float none = 0.0f;
    costs->set->ewa_axes(group->count, group->by_column[0], group->by_column[1], group->by_row[0],
                         group->by_row[1], &none, 1, &costs->axes);
    for (unsigned i = 0; i < group->count; i++)
    {
        const float minor = costs->axes.minor[i];
        costs->largest = fmaxf(costs->largest, minor);
        costs->of[CM_PYRAMID_HALVES] += (double)(minor / level_square(minor, 2.0f));
        costs->of[CM_PYRAMID_EIGHTHS] += (double)(minor / level_square(minor, 8.0f / 3.0f));
    }
    return CM_OK;
}

/* What leaves fewer pixels to be summed; and the square of the largest minor axis that has been seen. */
static cm_status choose_steps(const cm_plan *plan, const cm_filter_set *set,
                              cm_pyramid_steps *steps, float *largest)
{
    step_costs costs = {.set = set};
    const cm_status status = cm_survey(plan, BLOCKS_SEEN, add_costs, &costs);
    *steps = costs.of[CM_PYRAMID_HALVES] < costs.of[CM_PYRAMID_EIGHTHS] ? CM_PYRAMID_HALVES
                                                                        : CM_PYRAMID_EIGHTHS;
    *largest = costs.largest;
    return status;
}

/* ---- life ---- */

/* Of a level, the square of the minor axis that it needs, in source pixels. */
static float least_of(const cm_surface *surface, uint32_t width, uint32_t height)
{
    const double across = (double)surface->width / width;
    const double down = (double)surface->height / height;
    const double least = CM_EWA_MINOR * fmax(across, down);
    return (float)(least * least);
}

/* Levels that footprints want which have been looked at: what others want is made when they ask. */
static unsigned levels_wanted(const cm_plan *plan, cm_pyramid_steps steps, float largest)
{
    const cm_surface *surface = plan->from;
    cm_level_size sizes[CM_LEVELS_MAX];
    const unsigned count = cm_pyramid_sizes(steps, surface->width, surface->height, sizes);
    unsigned wanted = 1;
    if (plan->options.memory != NULL)
    {
        /* nobody else may ask for the caller's memory */
        return count;
    }
    while (wanted < count &&
           largest >= least_of(surface, sizes[wanted].width, sizes[wanted].height))
    {
        wanted++;
    }
    return wanted;
}

cm_status cm_ewa_make(const cm_plan *plan, const cm_image *pictures, const cm_values *values,
                      const cm_sample_set *set, const cm_filter_table *table, int is_whole,
                      unsigned threads, cm_ewa *ewa)
{
    const cm_surface *surface = plan->from;
    cm_pyramid_steps steps;
    float largest;
    memset(ewa, 0, sizeof *ewa);
    ewa->set = cm_filter_set_find(set->name);
    ewa->table = table;
    ewa->pixels_most = (float)fmin(plan->options.pixels_most, 1e9);
    ewa->kernel = kernel;
    cm_status status = choose_steps(plan, ewa->set, &steps, &largest);
    if (status != CM_OK)
    {
        return status;
    }
    status = cm_pyramid_make(surface, pictures, values, set, steps, PICTURE_BORDER, is_whole,
                             levels_wanted(plan, steps, largest), plan->options.memory, threads,
                             &ewa->pyramid);
    for (unsigned k = 0; k < ewa->pyramid.count; k++)
    {
        ewa->width[k] = k == 0 ? surface->width : ewa->pyramid.level[k].width;
        ewa->height[k] = k == 0 ? surface->height : ewa->pyramid.level[k].height;
        ewa->least[k] = least_of(surface, ewa->width[k], ewa->height[k]);
    }
    cm_ewa_caps(surface, ewa);
    return status;
}

void cm_ewa_free(cm_ewa *ewa)
{
    cm_pyramid_free(&ewa->pyramid);
}

/* ---- footprints ---- */

static int32_t floor_of(double x)
{
    const int32_t towards_zero = (int32_t)x;
    return towards_zero - ((double)towards_zero > x);
}

/* A group at work. */
typedef struct ewa_desk
{
    cm_ewa_axes axes;
    cm_ewa_shapes shapes;
    const cm_group *group;
    cm_scratch *scratch;
    float *to;
    unsigned first;     /* the finest level that a pixel of the group wants */
    cm_ewa_frame frame; /* of the level that is being done */
    int32_t column;     /* the pixel of the level that the frame's places are from */
    int32_t row;
} ewa_desk;

/* Pixels beyond the edges of a level. */
static void border_of(const cm_ewa *ewa, unsigned k, int32_t *beside, int32_t *beyond)
{
    const cm_level *pictures = &ewa->pyramid.pictures;
    if (k > 0)
    {
        *beside = ewa->pyramid.level[k].beside;
        *beyond = ewa->pyramid.level[k].beyond;
        return;
    }
    *beside = ewa->pyramid.reader.period != 0 ? CM_PYRAMID_BESIDE : pictures->reach;
    *beyond = pictures->reach;
}

static void frame_level(const cm_ewa *ewa, ewa_desk *desk, unsigned k)
{
    const double across = (double)ewa->width[k] / ewa->width[0];
    const double down = (double)ewa->height[k] / ewa->height[0];
    const double x = (desk->group->column + 0.5) * across;
    const double y = (desk->group->row + 0.5) * down;
    int32_t beside, beyond;
    border_of(ewa, k, &beside, &beyond);
    desk->column = floor_of(x);
    desk->row = floor_of(y);
    desk->frame = (cm_ewa_frame){.across = (float)across,
                                 .down = (float)down,
                                 .x = (float)(x - 0.5 - desk->column),
                                 .y = (float)(y - 0.5 - desk->row),
                                 .left = -beside - desk->column,
                                 .right = (int32_t)ewa->width[k] + beside - 1 - desk->column,
                                 .top = -beyond - desk->row,
                                 .bottom = (int32_t)ewa->height[k] + beyond - 1 - desk->row};
}

/* Pixels of a group on one level that is there, from the pixel that the frame's places are from. */
static void sum_pixels(const cm_ewa *ewa, const ewa_desk *desk, unsigned k,
                       const cm_ewa_pixels *pixels, size_t n, const uint8_t *which)
{
    if (desk->first > 0 && k < ewa->pyramid.count - 1)
    {
        /* nothing is sharp, and all is there */
        ewa->set->ewa_sums(n, which, &desk->shapes, pixels, &ewa->kernel, desk->to);
        return;
    }
    uint8_t whole[CM_EWA_MOST] = {0};
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
    {
        whole[count] = which[i];
        count += desk->shapes.whole[which[i]] && desk->axes.major[which[i]] > 1.0f;
    }
    ewa->set->ewa_sums(count, whole, &desk->shapes, pixels, &ewa->kernel, desk->to);
    for (size_t i = 0; i < n; i++)
    {
        const unsigned at = which[i];
        const float sharp = cm_ewa_sharpness(desk->axes.major[at]);
        float *to = desk->to + at * pixels->channels;
        if (!desk->shapes.whole[at] && sharp < 1.0f)
        {
            ewa->set->ewa_sum_cut(at, &desk->shapes, pixels, &desk->frame, &ewa->kernel, to);
        }
        if (sharp > 0.0f)
        {
            ewa->set->ewa_sharp(at, &desk->shapes, pixels, ewa->table, sharp, to);
        }
    }
}

/* ---- windows ---- */

/* Are footprints on that level laid on floats in windows? Else the level itself is floats. */
static int has_windows(const cm_ewa *ewa, unsigned k)
{
    return k == 0 || ewa->pyramid.is_whole;
}

/* A window may have so many pixels; where one pixel's ellipse alone needs more, it is looked for on the next level. */
#define WINDOW_MOST ((int64_t)1 << 18)
#define WINDOW_SHARED 64

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Of all pixels of the group, or of some. */
static cm_ewa_box extent_of_all(const cm_ewa_shapes *shapes, size_t n)
{
    cm_ewa_box box = {INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < n; i++)
    {
        box.left = smaller(box.left, shapes->left[i]);
        box.right = larger(box.right, shapes->right[i]);
        box.top = smaller(box.top, shapes->top[i]);
        box.bottom = larger(box.bottom, shapes->bottom[i]);
    }
    return box;
}

static cm_ewa_box extent_of(const cm_ewa_shapes *shapes, size_t n, const uint8_t *which)
{
    cm_ewa_box box = {INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < n; i++)
    {
        const unsigned at = which[i];
        box.left = smaller(box.left, shapes->left[at]);
        box.right = larger(box.right, shapes->right[at]);
        box.top = smaller(box.top, shapes->top[at]);
        box.bottom = larger(box.bottom, shapes->bottom[at]);
    }
    return box;
}

/* With what sharpness needs, which is only where some pixel is not smaller than one of the source. */
static cm_ewa_box box_of(const ewa_desk *desk, size_t n, const uint8_t *which)
{
    const cm_ewa_frame *frame = &desk->frame;
    const int32_t more = desk->first > 0 ? 0 : CM_EWA_SHARP;
    cm_ewa_box box = n == desk->group->count ? extent_of_all(&desk->shapes, n)
                                             : extent_of(&desk->shapes, n, which);
    box.left = larger(box.left - more, frame->left);
    box.right = smaller(box.right + more, frame->right);
    box.top = larger(box.top - more, frame->top);
    box.bottom = smaller(box.bottom + more, frame->bottom);
    return box;
}

static int64_t box_pixels(const cm_ewa_box *box)
{
    return ((int64_t)box->right - box->left + 1) * ((int64_t)box->bottom - box->top + 1);
}

/* Pixels of a group by one window, or by more where it would be large. */
static cm_status sum_windows(const cm_ewa *ewa, const ewa_desk *desk, unsigned k, size_t n,
                             const uint8_t *which)
{
    const cm_ewa_box box = box_of(desk, n, which);
    if (n > 1 && box_pixels(&box) > (int64_t)(n * WINDOW_SHARED))
    {
        const cm_status status = sum_windows(ewa, desk, k, n / 2, which);
        return status == CM_OK ? sum_windows(ewa, desk, k, n - n / 2, which + n / 2) : status;
    }
    cm_ewa_pixels pixels;
    const cm_ewa_level at = {ewa, k, desk->group->plane, desk->column, desk->row};
    const cm_status status = cm_ewa_window(&at, &box, desk->scratch, &pixels);
    if (status == CM_OK)
    {
        sum_pixels(ewa, desk, k, &pixels, n, which);
    }
    return status;
}

/* ---- groups ---- */

/* Is the footprint to be laid on this level, of those that are not on a coarser one anyhow? */
static int suits(const cm_ewa *ewa, const ewa_desk *desk, unsigned i, unsigned k)
{
    const uint8_t which = (uint8_t)i;
    if (k == ewa->pyramid.count - 1)
    {
        return 1;
    }
    if (!desk->shapes.whole[i])
    {
        return 0;
    }
    const cm_ewa_box box = box_of(desk, 1, &which);
    return !has_windows(ewa, k) || box_pixels(&box) <= WINDOW_MOST;
}

/* Do all pixels of the group suit this level, and want it? It is nearly always so, and found without a look at each. */
static int all_suit(const cm_ewa *ewa, const ewa_desk *desk, unsigned k)
{
    int32_t others = 0, whole = 1;
    for (unsigned i = 0; i < desk->group->count; i++)
    {
        others |= desk->axes.level[i] ^ (int32_t)k;
        whole &= desk->shapes.whole[i];
    }
    if (others != 0 || !whole)
    {
        return 0;
    }
    const cm_ewa_box box = box_of(desk, desk->group->count, NULL);
    return !has_windows(ewa, k) || box_pixels(&box) <= WINDOW_MOST;
}

/* Pixels of the group that are done on level k; others that wanted to be go to the next one. */
static size_t take_level(const cm_ewa *ewa, ewa_desk *desk, unsigned k, uint8_t *which)
{
    size_t n = 0;
    frame_level(ewa, desk, k);
    ewa->set->ewa_shapes(desk->group->count, desk->group->x, desk->group->y, &desk->axes,
                         &ewa->kernel, ewa->pixels_most, &desk->frame, &desk->shapes);
    if (all_suit(ewa, desk, k))
    {
        for (; n < desk->group->count; n++)
        {
            which[n] = (uint8_t)n;
        }
        return n;
    }
    for (unsigned i = 0; i < desk->group->count; i++)
    {
        if (desk->axes.level[i] != (int32_t)k)
        {
            continue;
        }
        if (suits(ewa, desk, i, k))
        {
            which[n++] = (uint8_t)i;
        }
        else
        {
            desk->axes.level[i]++;
        }
    }
    return n;
}

static cm_status do_level(const cm_ewa *ewa, const ewa_desk *desk, unsigned k, size_t n,
                          const uint8_t *which)
{
    const cm_status status = n > 0 ? cm_pyramid_need(&ewa->pyramid, k) : CM_OK;
    if (n == 0 || status != CM_OK)
    {
        return status;
    }
    if (has_windows(ewa, k))
    {
        return sum_windows(ewa, desk, k, n, which);
    }
    const cm_padded *level = &ewa->pyramid.level[k];
    const cm_ewa_pixels pixels = {level->first[desk->group->plane] + desk->row * level->row +
                                      desk->column,
                                  level->row, level->channel, level->channels};
    sum_pixels(ewa, desk, k, &pixels, n, which);
    return CM_OK;
}

cm_status cm_ewa_group(const cm_ewa *ewa, const cm_group *group, cm_scratch *scratch, float *to)
{
    _Alignas(64) ewa_desk desk; /* what vectors are stored to begins where a line of memory does */
    uint8_t which[CM_EWA_MOST] = {0};
    unsigned beside_poles;
    desk.group = group;
    desk.scratch = scratch;
    desk.to = to;
    ewa->set->ewa_axes(group->count, group->by_column[0], group->by_column[1], group->by_row[0],
                       group->by_row[1], ewa->least, ewa->pyramid.count, &desk.axes);
    int32_t coarsest = 0, first = INT32_MAX;
    for (unsigned i = 0; i < group->count; i++)
    {
        coarsest = larger(coarsest, desk.axes.level[i]);
        first = smaller(first, desk.axes.level[i]);
    }
    cm_status status = cm_ewa_poles(ewa, group, coarsest, scratch, &desk.axes, &beside_poles, to);
    size_t rest = group->count - beside_poles;
    first = beside_poles > 0 ? INT32_MAX : first;
    for (unsigned i = 0; beside_poles > 0 && i < group->count; i++)
    {
        const int32_t level = desk.axes.level[i];
        first = level < first && level != CM_EWA_DONE ? level : first;
    }
    desk.first = (unsigned)first;
    for (unsigned k = desk.first; rest > 0 && status == CM_OK; k++)
    {
        const size_t n = take_level(ewa, &desk, k, which);
        status = do_level(ewa, &desk, k, n, which);
        rest -= n;
    }
    return status;
}
