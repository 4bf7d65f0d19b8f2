/* SPDX-License-Identifier: MIT
 *
 * Coverings: cells that are divided where the border of a region is.
 */
#include "cell_shape.h"
#include "region.h"

#include <stdlib.h>
#include <string.h>

enum
{
    LOOK_AHEAD = 3 /* times that a cell is divided to learn whether it has the border in it */
};

#define LOOKS_INNER ((size_t)1 << 16)
#define FOUND_LEAST ((size_t)1 << 20) /* cells that are found before a search is given up */

/* Cells, as many as are wanted at most. */
typedef struct list
{
    cm_cell *at;
    size_t count;
    size_t room;
} list;

typedef struct search
{
    const cm_cell_grid *cells;
    const cm_region *region;
    const cm_cover_options *options;
    size_t found_most;
    size_t looks; /* cells that may still be looked at */
    cm_status status;
    list found;
    list candidates; /* the largest first */
    size_t divided;  /* how many of them, from the first on */
} search;

static size_t least_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* ---- How a cell lies to the region ---- */

/* What has been seen of a cell, as bits. */
enum
{
    SEEN_IN = 1,
    SEEN_OUT = 2,
    SEEN_BOTH = 3
};

/* By its bounding cap; if that does not tell by its middle, its corners and its parts; what does not tell in the
 * end counts as both. */
static int seen_of(const search *s, cm_cell cell, int ahead)
{
    double normal[5][3];
    int has_point;
    double radius = cm_cell_cap(s->cells, cell, normal);
    cm_lie lie = cm_region_lie(s->region, normal[4], radius, &has_point);
    if (lie != CM_LIE_PART)
    {
        return lie == CM_LIE_IN ? SEEN_IN : SEEN_OUT;
    }
    if (ahead == 0 || (cell & 1) != 0)
    {
        return SEEN_BOTH;
    }
    int seen = has_point ? SEEN_IN : SEEN_OUT;
    for (int k = 0; k < 4 && seen != SEEN_BOTH; k++)
    {
        cm_region_lie(s->region, normal[k], 0.0, &has_point);
        seen |= has_point ? SEEN_IN : SEEN_OUT;
    }
    for (int k = 0; k < 4 && seen != SEEN_BOTH; k++)
    {
        seen |= seen_of(s, cm_cell_child(cell, k), ahead - 1);
    }
    return seen;
}

static cm_lie look(search *s, cm_cell cell)
{
    if (s->looks == 0)
    {
        s->status = CM_ERROR_SPACE;
        return CM_LIE_OUT;
    }
    s->looks--;
    switch (seen_of(s, cell, LOOK_AHEAD))
    {
    case SEEN_IN:
        return CM_LIE_IN;
    case SEEN_OUT:
        return CM_LIE_OUT;
    default:
        return CM_LIE_PART;
    }
}

/* ---- Lists ---- */

static void append(search *s, list *to, cm_cell cell)
{
    if (to->count == to->room)
    {
        size_t room = to->room == 0 ? 64 : 2 * to->room;
        cm_cell *grown =
            room > SIZE_MAX / sizeof *grown ? NULL : realloc(to->at, room * sizeof *grown);
        if (grown == NULL)
        {
            s->status = CM_ERROR_MEMORY;
            return;
        }
        to->at = grown;
        to->room = room;
    }
    to->at[to->count++] = cell;
}

/* To the end of what has been found, in order; four quarters become a cell. */
static void find(search *s, cm_cell cell)
{
    list *found = &s->found;
    if (found->count >= s->found_most)
    {
        s->status = CM_ERROR_SPACE;
        return;
    }
    append(s, found, cell);
    while (found->count >= 4 && cm_cell_are_quarters(found->at + found->count - 4) &&
           cm_cell_level(found->at[found->count - 1]) > s->options->level_min)
    {
        found->count -= 3;
        found->at[found->count - 1] = cm_cell_parent(
            found->at[found->count - 1], cm_cell_level(found->at[found->count - 1]) - 1);
    }
}

/* A cell that is wholly in the region, or what it has of the coarsest level. */
static void find_inside(search *s, cm_cell cell)
{
    int level = s->options->level_min;
    if (cm_cell_level(cell) >= level)
    {
        find(s, cell);
        return;
    }
    cm_cell last = cm_cell_parent(cm_cell_last_leaf(cell), level);
    for (cm_cell at = cm_cell_parent(cm_cell_first_leaf(cell), level); s->status == CM_OK;
         at = cm_cell_advance(at, 1))
    {
        find(s, at);
        if (at == last)
        {
            return;
        }
    }
}

/* ---- Without a budget: along the curve ---- */

static void visit(search *s, cm_cell cell)
{
    if (s->status != CM_OK)
    {
        return;
    }
    switch (look(s, cell))
    {
    case CM_LIE_OUT:
        return;
    case CM_LIE_IN:
        find_inside(s, cell);
        return;
    default:
        break;
    }
    if (cm_cell_level(cell) < s->options->level_max)
    {
        for (int k = 0; k < 4; k++)
        {
            visit(s, cm_cell_child(cell, k));
        }
    }
    else if (s->options->kind == CM_COVER_OUTER)
    {
        find(s, cell);
    }
}

/* ---- With a budget: the largest cells first ---- */

/* At the end of those that wait: quarters are pushed in the order in which cells are divided, so that those that
 * wait are sorted, by size and then along the curve. What was divided makes room when it is half of all. */
static void push(search *s, cm_cell cell)
{
    list *all = &s->candidates;
    if (all->count == all->room && s->divided > all->count / 2)
    {
        all->count -= s->divided;
        memmove(all->at, all->at + s->divided, all->count * sizeof *all->at);
        s->divided = 0;
    }
    append(s, all, cell);
}

static size_t waiting(const search *s)
{
    return s->candidates.count - s->divided;
}

/* A cell that has something of the region, or all of it. */
static void take(search *s, cm_cell cell, cm_lie lie)
{
    if (lie == CM_LIE_IN && cm_cell_level(cell) >= s->options->level_min)
    {
        append(s, &s->found, cell);
    }
    else if (lie != CM_LIE_OUT)
    {
        push(s, cell);
    }
}

/* Its quarters in its place, if there is room for them. */
static void divide(search *s, cm_cell cell)
{
    const cm_cover_options *o = s->options;
    int level = cm_cell_level(cell);
    int is_outer = o->kind == CM_COVER_OUTER;
    cm_lie lie[4];
    size_t parts = 0;
    if (level >= o->level_max)
    {
        if (is_outer)
        {
            append(s, &s->found, cell);
        }
        return;
    }
    for (int k = 0; k < 4; k++)
    {
        lie[k] = look(s, cm_cell_child(cell, k));
        parts += lie[k] != CM_LIE_OUT;
    }
    if (is_outer && level >= o->level_min && parts > 1 &&
        s->found.count + waiting(s) + parts > o->cells_most)
    {
        append(s, &s->found, cell);
        return;
    }
    for (int k = 0; k < 4; k++)
    {
        take(s, cm_cell_child(cell, k), lie[k]);
    }
}

/* Sorts what has been found, and merges it. */
static void put_in_order(search *s)
{
    list unordered = s->found;
    s->found = (list){NULL, 0, 0};
    s->found_most = SIZE_MAX;
    if (unordered.count > 0)
    {
        qsort(unordered.at, unordered.count, sizeof *unordered.at, cm_cell_compare);
    }
    for (size_t i = 0; i < unordered.count && s->status == CM_OK; i++)
    {
        find(s, unordered.at[i]);
    }
    free(unordered.at);
}

static void cover_within(search *s)
{
    const cm_cover_options *o = s->options;
    int is_inner = o->kind == CM_COVER_INNER;
    for (int face = 0; face < 6; face++)
    {
        cm_cell cell = cm_cell_at_index(0, (uint64_t)face);
        take(s, cell, look(s, cell));
    }
    while (waiting(s) > 0 && s->status == CM_OK && !(is_inner && s->found.count >= o->cells_most))
    {
        divide(s, s->candidates.at[s->divided++]);
        if (s->found.count + waiting(s) > s->found_most)
        {
            s->status = CM_ERROR_SPACE;
        }
    }
    if (is_inner)
    {
        /* what has been found is one, whether or not there is more to be found */
        s->status = s->status == CM_ERROR_SPACE ? CM_OK : s->status;
        s->found.count = least_of(s->found.count, o->cells_most);
    }
    if (s->status == CM_OK)
    {
        put_in_order(s);
    }
}

/* ---- Both ---- */

static int are_options(const cm_cover_options *o)
{
    return o != NULL && o->size == sizeof *o && o->level_min >= 0 && o->level_min <= o->level_max &&
           o->level_max <= CM_CELL_LEVEL_MAX &&
           (o->kind == CM_COVER_OUTER || o->kind == CM_COVER_INNER);
}

cm_status cm_cover(const cm_cell_grid *cells, const cm_region *region,
                   const cm_cover_options *options, size_t capacity, cm_cell *to, size_t *count)
{
    if (cells == NULL || region == NULL || !are_options(options) || count == NULL ||
        (to == NULL && capacity > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    search s = {.cells = cells, .region = region, .options = options, .status = CM_OK};
    s.found_most = capacity > FOUND_LEAST ? capacity : FOUND_LEAST;
    /* as many cells are looked at, at most, before a search is given up */
    s.looks = 8 * least_of(s.found_most, SIZE_MAX / 16);
    if (options->cells_most > 0)
    {
        const size_t most = least_of(options->cells_most, SIZE_MAX / 256);
        /* a cell of the result is the end of thirty that were divided, at most, four looks each */
        s.looks = options->kind == CM_COVER_OUTER ? s.looks + 128 * most : LOOKS_INNER + 64 * most;
        cover_within(&s);
    }
    else
    {
        for (int face = 0; face < 6; face++)
        {
            visit(&s, cm_cell_at_index(0, (uint64_t)face));
        }
    }
    if (s.status == CM_OK && s.found.count > capacity)
    {
        s.status = CM_ERROR_SPACE;
    }
    if (s.status == CM_OK && s.found.count > 0)
    {
        memcpy(to, s.found.at, s.found.count * sizeof *to);
    }
    if (s.status == CM_OK || s.status == CM_ERROR_SPACE)
    {
        /* what an outer one has not divided yet is of it, too */
        *count = s.found.count + (options->kind == CM_COVER_OUTER ? waiting(&s) : 0);
    }
    free(s.found.at);
    free(s.candidates.at);
    return s.status;
}
