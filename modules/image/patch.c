/* SPDX-License-Identifier: MIT */
#include "patch.h"

#include <math.h>
#include <stdlib.h>

/* A patch has so many blocks each way, and six nodes. */
#define EDGE 4
#define PIXELS (EDGE * CM_BLOCK_EDGE)
#define NODES CM_WIDE_NODES
#define STEPS (NODES - 1)

/* A polynomial through six nodes is off by the sixth derivative, over 42.6 at most (de Boor, A practical guide to splines, 1978,
 * chapter II), and its weights add up to 3.11 at most. As much again, or thrice, for what differences do not see of it. */
#define ERROR_SIX (2.0 / 42.6)
#define ERROR_ALONE (4.0 / 42.6)
#define LEBESGUE_SIX 3.11

/* Strips that are kept, each for its columns, from a row of blocks to the next. */
#define STRIPS_MOST 64

#define PATCHES 8

static const cm_lattice_shape shape = {
    .edge = PIXELS, .steps = STEPS, .beyond = 1, .blocks = PATCHES};

typedef enum patch_state
{
    UNSEEN,
    GOOD,
    BAD
} patch_state;

typedef struct patch
{
    patch_state state;
    uint8_t plane;
    int32_t column; /* the origin */
    int32_t row;
    float x[NODES * NODES];
    float y[NODES * NODES];
    uint32_t placed; /* the row of blocks that columns are of, EDGE for none */
    cm_wide_columns columns[2];
} patch;

/* Patches side by side. */
typedef struct strip
{
    cm_lattice lattice;
    patch patches[PATCHES];
} strip;

struct cm_patches
{
    const cm_plan *plan;
    const cm_place_set *set;
    cm_wide_weights weights[EDGE]; /* of a patch's first block, the second ... */
    uint32_t count;
    strip *strips;
};

void cm_weigh_nodes(int nodes, double first, double per_pixel, float (*weights)[CM_BLOCK_EDGE],
                    float (*slopes)[CM_BLOCK_EDGE])
{
    for (int i = 0; i < CM_BLOCK_EDGE; i++)
    {
        const double at = first + (i + 0.5) * per_pixel;
        for (int k = 0; k < nodes; k++)
        {
            double weight = 1.0;
            double slope = 0.0;
            for (int other = 0; other < nodes; other++)
            {
                if (other != k)
                {
                    slope = (slope * (at - other) + weight) / (k - other);
                    weight *= (at - other) / (k - other);
                }
            }
            weights[k][i] = (float)weight;
            if (slopes != NULL)
            {
                slopes[k][i] = (float)(slope * per_pixel);
            }
        }
    }
}

cm_patches *cm_patches_create(const cm_plan *plan, const cm_place_set *set)
{
    const uint32_t columns = PIXELS * PATCHES;
    const uint32_t wanted = (plan->to->width + columns - 1) / columns;
    cm_patches *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return NULL;
    }
    made->plan = plan;
    made->set = set;
    made->count = wanted < STRIPS_MOST ? wanted : STRIPS_MOST;
    made->strips = calloc(made->count, sizeof *made->strips);
    for (int k = 0; k < EDGE; k++)
    {
        cm_weigh_nodes(NODES, (double)STEPS * k / EDGE, (double)STEPS / PIXELS, made->weights[k],
                       NULL);
    }
    for (uint32_t i = 0; made->strips != NULL && i < made->count; i++)
    {
        made->strips[i].lattice.shape = &shape;
    }
    if (made->strips == NULL)
    {
        cm_patches_destroy(made);
        return NULL;
    }
    return made;
}

void cm_patches_destroy(cm_patches *patches)
{
    if (patches != NULL)
    {
        free(patches->strips);
        free(patches);
    }
}

/* The nodes from the origin as floats. Returns the extent. */
static float take_nodes(const double *at, size_t stride, int32_t origin, float *nodes)
{
    float low = INFINITY;
    float high = -INFINITY;
    for (size_t r = 0; r < NODES; r++)
    {
        for (size_t k = 0; k < NODES; k++)
        {
            const float node = (float)(at[r * stride + k] - (origin + 0.5));
            low = node < low ? node : low;
            high = node > high ? node : high;
            nodes[r * NODES + k] = node;
        }
    }
    return high - low;
}

static patch_state make_patch(const cm_patches *patches, const strip *from, uint32_t number,
                              patch *made)
{
    cm_lattice_copy copy;
    const cm_plan *plan = patches->plan;
    const cm_lattice_view view =
        cm_lattice_see(&from->lattice, patches->set, plan->from->period, number, &copy);
    double across, along;
    int alone;
    if (!cm_lattice_bend_six(&view, from->lattice.is_uniform, &across, &along, &alone))
    {
        return BAD;
    }
    const double factor = alone ? ERROR_ALONE : ERROR_SIX;
    const double error = factor * (across + LEBESGUE_SIX * along);
    if (!(error <= plan->options.tolerance))
    {
        return BAD;
    }
    const size_t first = view.stride + 1;
    const size_t middle = first + NODES / 2 * first;
    made->placed = EDGE;
    made->plane = view.plane[first];
    made->column = (int32_t)view.x[middle];
    made->row = (int32_t)view.y[middle];
    const float width = take_nodes(view.x + first, view.stride, made->column, made->x);
    const float height = take_nodes(view.y + first, view.stride, made->row, made->y);
    const double rounded = (double)(width > height ? width : height) / 4194304.0;
    return error + rounded <= plan->options.tolerance ? GOOD : BAD;
}

static patch *patch_at(cm_patches *patches, unsigned plane, uint32_t column, uint32_t row)
{
    const uint32_t chunk = column / PATCHES;
    const uint32_t number = column % PATCHES;
    strip *at = &patches->strips[chunk % patches->count];
    if (!at->lattice.is_there || at->lattice.to_plane != plane || at->lattice.block_row != row ||
        at->lattice.chunk != chunk)
    {
        cm_lattice_fill(&at->lattice, patches->plan, patches->set, plane, row, chunk);
        for (uint32_t i = 0; i < PATCHES; i++)
        {
            at->patches[i].state = UNSEEN;
        }
    }
    patch *found = &at->patches[number];
    if (found->state == UNSEEN)
    {
        found->state = make_patch(patches, at, number, found);
    }
    return found;
}

int cm_patches_block(cm_patches *patches, unsigned plane, uint32_t block_column, uint32_t block_row,
                     cm_patch_places *places, float *x, float *y)
{
    patch *found = patch_at(patches, plane, block_column / EDGE, block_row / EDGE);
    if (found->state != GOOD)
    {
        return 0;
    }
    const cm_place_set *set = patches->set;
    const uint32_t row = block_row % EDGE;
    if (found->placed != row)
    {
        const cm_wide_weights *along = (const cm_wide_weights *)&patches->weights[row];
        set->place_columns(found->x, along, &found->columns[0]);
        set->place_columns(found->y, along, &found->columns[1]);
        found->placed = row;
    }
    const cm_wide_columns *columns = (const cm_wide_columns *)found->columns;
    const cm_wide_weights *across = (const cm_wide_weights *)&patches->weights[block_column % EDGE];
    places->plane = found->plane;
    places->column = found->column;
    places->row = found->row;
    set->place_rows(&columns[0], across, x, &places->low[0], &places->high[0]);
    set->place_rows(&columns[1], across, y, &places->low[1], &places->high[1]);
    return 1;
}
