/* SPDX-License-Identifier: MIT
 *
 * What a point of an ellipsoid costs: from geographic longitude and latitude to face, u and v, and back.
 */
#include "advise_work.h"

#include "truth/sphere.h"

#include <math.h>
#include <stdlib.h>

double latitude_error(const advice_work *work)
{
    const cm_advice_request *request = &work->request;
    int is_limited = (request->limited >> CM_LIMIT_ERROR & 1u) != 0;
    /* what cm_advise counts with: an eighth for each of two */
    return is_limited && isfinite(request->limit[CM_LIMIT_ERROR])
               ? request->limit[CM_LIMIT_ERROR] / 8.0
               : 0.0;
}

static cm_grid *make_grid(const advice_work *work, const way *w)
{
    const subject *s = &work->all.subjects[w->subject];
    const cm_options options = {.size = sizeof options,
                                .tier =
                                    w->precision == PRECISION_FAST ? CM_TIER_FAST : CM_TIER_EXACT};
    const cm_grid_options grid_options = {.size = sizeof grid_options,
                                          .mapping = s->specification,
                                          .ellipsoid = &work->ellipsoid,
                                          .tolerance = latitude_error(work) / work->ellipsoid.a,
                                          .options = &options};
    cm_grid *grid = NULL;
    cm_status status = cm_grid_create(&grid_options, &grid);
    if (status != CM_OK)
    {
        fprintf(harness_err(), "%s: %s: %s\n", program_name(), s->specification,
                cm_status_text(status));
        harness_end();
    }
    return grid;
}

static void fill(batch *b, size_t count)
{
    uint64_t state = 7;
    batch_allocate(b, count);
    b->count = count;
    for (size_t i = 0; i < count; i++)
    {
        double d[3];
        double lonlat[2];
        next_direction(&state, d);
        cm_lonlat_from_direction(d, lonlat);
        batch_put(b, i, (const double[]){lonlat[0], lonlat[1], 0.0});
    }
}

static void run_alone(const cm_grid *grid, batch *b, int direction)
{
    for (size_t i = 0; i < b->count; i++)
    {
        double pair[2] = {b->plane[0][i], b->plane[1][i]};
        if (direction == FORWARD)
        {
            b->face[i] = cm_grid_forward_lonlat(grid, b->from[0][i], b->from[1][i], pair);
            b->plane[0][i] = pair[0];
            b->plane[1][i] = pair[1];
        }
        else
        {
            cm_grid_inverse_lonlat(grid, b->face[i], pair, pair);
            b->back[0][i] = pair[0];
            b->back[1][i] = pair[1];
        }
    }
}

static void run_grid(const cm_grid *grid, int form, batch *b, int direction)
{
    if (form == FORM_SINGLE)
    {
        run_alone(grid, b, direction);
    }
    else if (direction == FORWARD)
    {
        cm_grid_forward_lonlat_array(grid, b->count, b->from[0], b->from[1], b->face, b->plane[0],
                                     b->plane[1]);
    }
    else
    {
        cm_grid_inverse_lonlat_array(grid, b->count, b->face, b->plane[0], b->plane[1], b->back[0],
                                     b->back[1]);
    }
}

/* Each way runs once before, so that its points are in the cache. */
static void time_way(way *w, const cm_grid *grid, batch *b, size_t repetition, size_t repetitions)
{
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        if (repetition == 0)
        {
            w->samples[direction] = allocate(repetitions, sizeof(double));
        }
        run_grid(grid, w->form, b, direction);
        double start = seconds();
        run_grid(grid, w->form, b, direction);
        w->samples[direction][repetition] = (seconds() - start) * 1e9 / (double)b->count;
        if (repetition + 1 == repetitions)
        {
            w->time[direction] = summary(w->samples[direction], repetitions);
        }
    }
}

void measure_grid_times(advice_work *work, stage part)
{
    suite *all = &work->all;
    batch b;
    cm_grid **grids = allocate(all->way_count + 1, sizeof(cm_grid *));
    fill(&b, all->set.points);
    for (size_t i = 0; i < all->way_count; i++)
    {
        grids[i] =
            all->ways[i].precision == PRECISION_FLOAT ? NULL : make_grid(work, &all->ways[i]);
    }
    for (size_t r = 0; r < all->set.repetitions; r++)
    {
        for (size_t i = 0; i < all->way_count; i++)
        {
            if (grids[i] != NULL)
            {
                time_way(&all->ways[i], grids[i], &b, r, all->set.repetitions);
            }
        }
        stage_progress(part, r + 1, all->set.repetitions, "times");
    }
    for (size_t i = 0; i < all->way_count; i++)
    {
        cm_grid_destroy(grids[i]);
    }
    free(grids);
    batch_free(&b);
}
