/* SPDX-License-Identifier: MIT */
#include "cone.h"

#include <math.h>
#include <string.h>

#include "interleave.h"
#include "snapshot_cells.h"

/* What is more opaque than all but half a step of 255 hides the rest. */
#define OPAQUE (1.0f - 0.5f / 255.0f)

void cm_cone_start(const cm_snapshot *snapshot, cm_cone_path *path)
{
    memset(path->place, 0, sizeof path->place);
    path->stage = snapshot->top;
    path->node[snapshot->top] = snapshot->node[snapshot->top];
}

/* The number of a node's 2^3 or 4^3 children in order, among those that are not empty. */
static inline const cm_seen_cell *pair_of(const cm_snapshot *snapshot, const cm_seen_node *node,
                                          unsigned pair)
{
    return snapshot->cell + node->cell + 1 + node->quarter_count +
           cm_bit_count(node->pairs & cm_bits_below(pair));
}

static inline const cm_seen_cell *quarter_of(const cm_snapshot *snapshot, const cm_seen_node *node,
                                             unsigned quarter)
{
    return snapshot->cell + node->cell + 1 + cm_bit_count(node->quarters & cm_bits_below(quarter));
}

static inline cm_cone_cell look(const cm_snapshot *snapshot, cm_cone_path *path,
                                const uint32_t place[3], int level)
{
    const uint32_t moved =
        (place[0] ^ path->place[0]) | (place[1] ^ path->place[1]) | (place[2] ^ path->place[2]);
    int stage = path->stage;
    while (stage < snapshot->top && moved >> (3 * stage + 3) != 0)
    {
        stage++;
    }
    memcpy(path->place, place, sizeof path->place);
    for (;; stage--)
    {
        const cm_seen_node *node = path->node[stage];
        const int finest = 3 * stage;
        const unsigned child =
            cm_interleave_3(place[0] >> finest, place[1] >> finest, place[2] >> finest);
        const uint64_t word = node->mask[child / 64];
        path->stage = stage;
        if (word == 0)
        {
            return (cm_cone_cell){.level = finest + 2};
        }
        if (level >= finest + 2)
        {
            return (cm_cone_cell){.cell = quarter_of(snapshot, node, child / 64),
                                  .level = finest + 2};
        }
        if ((word >> (child & 56) & 255) == 0)
        {
            return (cm_cone_cell){.level = finest + 1};
        }
        if (level == finest + 1)
        {
            return (cm_cone_cell){.cell = pair_of(snapshot, node, child / 8), .level = finest + 1};
        }
        if ((word >> (child & 63) & 1) == 0)
        {
            return (cm_cone_cell){.level = finest};
        }
        if (stage == 0)
        {
            const size_t before =
                node->before[child / 64] + cm_bit_count(word & cm_bits_below(child & 63));
            return (cm_cone_cell){.color = snapshot->color + node->child + before};
        }
        const cm_seen_node *below =
            &snapshot->node[stage - 1][snapshot->children[node->child + child]];
        if (level == finest)
        {
            return (cm_cone_cell){.cell = snapshot->cell + below->cell, .level = finest};
        }
        path->node[stage - 1] = below;
    }
}

cm_cone_cell cm_cone_look(const cm_snapshot *snapshot, cm_cone_path *path, const uint32_t place[3],
                          int level)
{
    return look(snapshot, path, place, level);
}

/* Where a cone is. */
typedef struct walk
{
    double inverse[3];
    double at;         /* how far */
    uint32_t place[3]; /* of the voxel there */
    uint32_t size;     /* of the snapshot */
    uint32_t is_up[3]; /* 1: that coordinate grows */
} walk;

static inline uint32_t place_at(double coordinate, uint32_t least, uint32_t most)
{
    return coordinate <= least ? least : coordinate >= most ? most : (uint32_t)coordinate;
}

/* To where it enters the snapshot, at begin at least; 0: it does not up to end. */
static int enter(const cm_snapshot *snapshot, const cm_cone *cone, walk *w)
{
    double begin = cone->begin;
    double end = cone->end;
    w->size = (uint32_t)1 << (3 * snapshot->top + 3);
    for (int axis = 0; axis < 3; axis++)
    {
        const double d = cone->direction[axis];
        w->is_up[axis] = d >= 0.0; /* of 0, too: the side that is far away, as inverse has it */
        w->inverse[axis] = 1.0 / (fabs(d) > 1e-300 ? d : d < 0.0 ? -1e-300 : 1e-300);
        const double low = -cone->origin[axis] * w->inverse[axis];
        const double high = (w->size - cone->origin[axis]) * w->inverse[axis];
        const double first = low < high ? low : high, last = low < high ? high : low;
        begin = first > begin ? first : begin;
        end = last < end ? last : end;
    }
    w->at = begin;
    for (int axis = 0; axis < 3; axis++)
    {
        w->place[axis] =
            place_at(cone->origin[axis] + begin * cone->direction[axis], 0, w->size - 1);
    }
    return begin < end;
}

/* Out of the cube of a level that the place is in: through one of its sides to a voxel beside it, so that there is an end.
 * 0: out of the snapshot. */
static inline int leave(const cm_cone *cone, walk *w, int level)
{
    const uint32_t within = ((uint32_t)1 << level) - 1;
    double side[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const uint32_t low = w->place[axis] & ~within;
        side[axis] = ((double)(low + (w->is_up[axis] ? within + 1 : 0)) - cone->origin[axis]) *
                     w->inverse[axis];
    }
    const int through = side[0] < side[1] ? (side[0] < side[2] ? 0 : 2) : side[1] < side[2] ? 1 : 2;
    w->at = side[through] > w->at ? side[through] : w->at;
    for (int axis = 0; axis < 3; axis++)
    {
        const uint32_t low = w->place[axis] & ~within;
        w->place[axis] =
            axis == through
                ? (w->is_up[axis] ? low + within + 1 : low - 1)
                : place_at(cone->origin[axis] + w->at * cone->direction[axis], low, low + within);
    }
    return w->place[through] < w->size;
}

static inline void pass_half(cm_cone_view *view, double at, int level, const uint32_t place[3])
{
    view->half = at;
    view->level = level;
    for (int axis = 0; axis < 3; axis++)
    {
        view->place[axis] = (int32_t)place[axis];
    }
}

static inline void add(cm_cone_view *view, float more, const uint8_t color[3])
{
    const float of_color = more / 255.0f;
    view->opacity += more;
    view->color[0] += of_color * color[0];
    view->color[1] += of_color * color[1];
    view->color[2] += of_color * color[2];
}

/* 2 to the power of -x, of x from 0 on, to some 2e-5; what is less than 2^-24 is 0. */
static inline float power_of_half(float x)
{
    if (!(x < 24.0f))
    {
        return 0.0f;
    }
    const unsigned down = (unsigned)x;
    const float y = (float)down - x;
    const float power =
        1.0f + y * (0.6931389f + y * (0.2399597f + y * (0.0541432f + y * 0.0073298f)));
    return power / (float)((uint32_t)1 << down);
}

/* What a cell of a level lets through on a part of the way through it, in all three directions: so much of it as the part of its
 * edge that is covered along each has. */
static float hidden(const cm_snapshot *snapshot, const cm_seen_cell *cell,
                    const double direction[3], double part)
{
    float thickness = 0.0f;
    for (int axis = 0; axis < 3; axis++)
    {
        const float covered = (float)(fabs(direction[axis]) * part);
        thickness += covered > 0.0f ? covered * snapshot->thickness[cell->opacity[axis]] : 0.0f;
    }
    return 1.0f - power_of_half(thickness);
}

/* A cell above level 0, between two distances. */
static void cross(const cm_snapshot *snapshot, const cm_cone *cone, const cm_cone_cell *met,
                  double from, double to, const uint32_t place[3], cm_cone_view *view)
{
    const float opacity =
        hidden(snapshot, met->cell, cone->direction, (to - from) / cm_size_of_level(met->level));
    const float before = view->opacity;
    add(view, (1.0f - before) * opacity, met->cell->color);
    if (before < 0.5f && view->opacity >= 0.5f)
    {
        const double part = (0.5 - before) / (view->opacity - before);
        pass_half(view, from + part * (to - from), met->level, place);
    }
}

cm_cone_view cm_cone_trace(const cm_snapshot *snapshot, cm_cone_path *path, const cm_cone *cone)
{
    cm_cone_view view = {.half = INFINITY};
    walk w;
    if (snapshot->top < 0 || !enter(snapshot, cone, &w))
    {
        return view;
    }
    int level = cone->coarsest;
    double wider = 2.0 * cm_size_of_level(level) / cone->width;
    for (int is_inside = 1; is_inside && w.at < cone->end;)
    {
        for (; w.at >= wider && level < 3 * CM_SNAPSHOT_STAGES; wider *= 2.0)
        {
            level++;
        }
        const cm_cone_cell met = look(snapshot, path, w.place, level);
        if (met.color != NULL)
        {
            if (view.opacity < 0.5f)
            {
                pass_half(&view, w.at, 0, w.place);
            }
            uint8_t rgb[3];
            cm_seen_color(*met.color, rgb);
            add(&view, 1.0f - view.opacity, rgb);
            break;
        }
        const double from = w.at;
        uint32_t place[3];
        memcpy(place, w.place, sizeof place);
        is_inside = leave(cone, &w, met.level);
        if (met.cell != NULL)
        {
            cross(snapshot, cone, &met, from, w.at < cone->end ? w.at : cone->end, place, &view);
            if (view.opacity >= OPAQUE)
            {
                break;
            }
        }
    }
    return view;
}
