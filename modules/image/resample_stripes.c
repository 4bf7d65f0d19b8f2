/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "resample_stripes.h"
#include "past_caches.h"
#include "spline_stripes.h"

#include <cubemap/threads.h>

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What stripes may take, if there are rows enough in it. A plane that is one stripe has no walk down, and may take more. */
#define STRIPE_BYTES ((size_t)8 << 20)
#define PLANE_BYTES ((size_t)16 << 20)

/* Blocks that are worth the making of a thread. */
#define BLOCKS_LEAST 8

/* Pixels of a block that lie on one plane of the source. */
typedef struct block_part
{
    uint32_t block; /* of all planes of the target, by rows */
    int32_t first;  /* row of the source that they touch */
    uint8_t plane;  /* of the source */
} block_part;

/* What one thread has found. */
typedef struct part_list
{
    struct part_list *next;
    size_t count;
    size_t room;
    block_part *parts;
    int32_t most; /* rows that one touches */
} part_list;

/* What a thread works with. It begins where a line of memory does, as that of resample.c. */
typedef struct stripe_desk
{
    cm_group groups[2][CM_GROUPS_MAX]; /* of a block, and of the next one */
    void *memory;                      /* in which it lies */
    cm_geometry *geometry;
    cm_scratch scratch;
    unsigned char *pixels;
    unsigned count[2];
} stripe_desk;

typedef struct stripe_job
{
    cm_source
        source; /* that of the target, whose level is the window; it begins where a line of memory does */
    void *memory; /* in which the job lies */
    cm_target target;
    uint32_t columns; /* of blocks, of a plane of the target */
    uint32_t rows;
    _Atomic(part_list *) lists;
    _Atomic(stripe_desk *) desks[CM_THREADS_MAX]; /* that nobody has */
    const cm_spline_stripes *stripes;
    uint32_t *order; /* blocks by plane and stripe of the source */
    size_t *begin;   /* of each stripe's, and the end of the last one's */
    size_t at;       /* the stripe under way, of all planes */
    unsigned plane;
    unsigned stripe;
    atomic_int failed;
} stripe_job;

/* ---- desks ---- */

static void destroy_desk(stripe_desk *desk)
{
    if (desk != NULL)
    {
        cm_geometry_destroy(desk->geometry);
        free(desk->scratch.bytes);
        free(desk->memory);
    }
}

/* NULL if there is no memory. */
static stripe_desk *make_desk(const stripe_job *job)
{
    const size_t pixels = CM_BLOCK_PIXELS * job->source.level.pixel_size + CM_WINDOW_SLACK;
    void *memory;
    stripe_desk *desk = cm_zeros_in_lines(sizeof *desk + CM_LINE + pixels, &memory);
    if (desk == NULL)
    {
        return NULL;
    }
    desk->memory = memory;
    desk->pixels = cm_next_line(desk + 1);
    desk->geometry = cm_geometry_create(job->target.plan, 0);
    if (desk->geometry == NULL)
    {
        free(memory);
        return NULL;
    }
    return desk;
}

/* One that nobody has, or a new one; NULL if there is no memory. */
static stripe_desk *take_desk(stripe_job *job)
{
    for (size_t i = 0; i < CM_THREADS_MAX; i++)
    {
        stripe_desk *found = atomic_exchange(&job->desks[i], NULL);
        if (found != NULL)
        {
            return found;
        }
    }
    stripe_desk *made = make_desk(job);
    if (made == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
    }
    return made;
}

static void give_desk(stripe_job *job, stripe_desk *desk)
{
    for (size_t i = 0; i < CM_THREADS_MAX; i++)
    {
        stripe_desk *none = NULL;
        if (atomic_compare_exchange_strong(&job->desks[i], &none, desk))
        {
            return;
        }
    }
    destroy_desk(desk);
}

/* ---- blocks ---- */

/* Where a block is on the target. */
typedef struct block_place
{
    unsigned plane;
    uint32_t column;
    uint32_t row;
} block_place;

static block_place place_of(const stripe_job *job, size_t block)
{
    const size_t per_plane = (size_t)job->columns * job->rows;
    const size_t at = block % per_plane;
    return (block_place){(unsigned)(block / per_plane), (uint32_t)(at % job->columns),
                         (uint32_t)(at / job->columns)};
}

static int add_part(part_list *list, uint32_t block, uint8_t plane, int32_t first, int32_t end)
{
    if (list->count == list->room)
    {
        const size_t room = list->room == 0 ? 1024 : 2 * list->room;
        block_part *parts = cm_array_resized(list->parts, room, sizeof *parts);
        if (parts == NULL)
        {
            return 0;
        }
        list->parts = parts;
        list->room = room;
    }
    list->parts[list->count++] = (block_part){block, first, plane};
    list->most = end - first > list->most ? end - first : list->most;
    return 1;
}

/* What the source does not show of a block is cleared; all else is noted. */
static int survey_block(stripe_job *job, stripe_desk *desk, part_list *list, size_t block)
{
    cm_group *groups = desk->groups[0];
    const block_place at = place_of(job, block);
    const unsigned count = cm_geometry_block(desk->geometry, at.plane, at.column, at.row, groups);
    unsigned pixels = 0;
    for (unsigned i = 0; i < count; i++)
    {
        int32_t first, end;
        cm_source_rows(&job->source, &groups[i], &first, &end);
        pixels += groups[i].count;
        if (!add_part(list, (uint32_t)block, groups[i].plane, first, end))
        {
            return 0;
        }
    }
    if (pixels < CM_BLOCK_PIXELS)
    {
        cm_target_clear(&job->target, at.plane, at.column, at.row, groups, count);
    }
    return 1;
}

static void survey_blocks(size_t begin, size_t end, void *user)
{
    stripe_job *job = user;
    stripe_desk *desk = take_desk(job);
    part_list *list = calloc(1, sizeof *list);
    int is_good = desk != NULL && list != NULL;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK && is_good; at++)
    {
        is_good = survey_block(job, desk, list, at);
    }
    if (!is_good)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
    }
    if (desk != NULL)
    {
        give_desk(job, desk);
    }
    if (list != NULL)
    {
        list->next = atomic_load(&job->lists);
        while (!atomic_compare_exchange_weak(&job->lists, &list->next, list))
        {
        }
    }
}

static size_t key_of(const stripe_job *job, uint8_t plane, int32_t first)
{
    return plane * (size_t)cm_spline_stripes_count(job->stripes) +
           cm_spline_stripes_of(job->stripes, first);
}

/* The key of a part; 0 if one before it is of the same block and key: they are done together. */
static int is_first_of_key(const stripe_job *job, const part_list *list, size_t i, size_t *key)
{
    const block_part *parts = list->parts;
    *key = key_of(job, parts[i].plane, parts[i].first);
    for (size_t before = i; before > 0 && parts[before - 1].block == parts[i].block; before--)
    {
        if (key_of(job, parts[before - 1].plane, parts[before - 1].first) == *key)
        {
            return 0;
        }
    }
    return 1;
}

/* A part is done when the stripe has come in which it begins. */
static cm_status sort_parts(stripe_job *job)
{
    const size_t keys =
        job->target.plan->from->planes * (size_t)cm_spline_stripes_count(job->stripes);
    size_t count = 0, key;
    job->begin = calloc(keys + 2, sizeof *job->begin);
    for (const part_list *list = atomic_load(&job->lists); list != NULL; list = list->next)
    {
        count += list->count;
    }
    job->order = cm_array_of(count > 0 ? count : 1, sizeof *job->order);
    if (job->begin == NULL || job->order == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    /* where the next one of each stripe goes; when all have gone there it is where those of the next stripe begin */
    size_t *next = job->begin + 1;
    for (const part_list *list = atomic_load(&job->lists); list != NULL; list = list->next)
    {
        for (size_t i = 0; i < list->count; i++)
        {
            if (is_first_of_key(job, list, i, &key))
            {
                next[key + 1]++;
            }
        }
    }
    for (key = 0; key < keys; key++)
    {
        next[key + 1] += next[key];
    }
    for (const part_list *list = atomic_load(&job->lists); list != NULL; list = list->next)
    {
        for (size_t i = 0; i < list->count; i++)
        {
            if (is_first_of_key(job, list, i, &key))
            {
                job->order[next[key]++] = list->parts[i].block;
            }
        }
    }
    return CM_OK;
}

/* ---- pixels ---- */

/* Those groups of a block that are of the stripe. */
static void place_block(const stripe_job *job, stripe_desk *desk, unsigned turn, size_t block)
{
    cm_group *groups = desk->groups[turn];
    const block_place at = place_of(job, block);
    desk->count[turn] = cm_geometry_block(desk->geometry, at.plane, at.column, at.row, groups);
    for (unsigned i = 0; i < desk->count[turn]; i++)
    {
        int32_t first, end;
        cm_source_rows(&job->source, &groups[i], &first, &end);
        if (key_of(job, groups[i].plane, first) != job->at)
        {
            groups[i].count = 0;
            continue;
        }
        cm_source_fetch(&job->source, &groups[i]);
    }
}

static cm_status do_block(const stripe_job *job, stripe_desk *desk, unsigned turn, size_t block)
{
    const block_place at = place_of(job, block);
    cm_row_target row = cm_target_row(&job->target, at.plane, at.row * CM_BLOCK_EDGE, NULL);
    /* blocks side by side come at other times */
    row.bundle = row.bundle == 1 ? 1 : 0;
    const cm_block_target to = cm_target_block(&job->target, &row, at.column * CM_BLOCK_EDGE);
    cm_status status = CM_OK;
    for (unsigned i = 0; i < desk->count[turn] && status == CM_OK; i++)
    {
        cm_group *group = &desk->groups[turn][i];
        if (group->count == 0)
        {
            continue;
        }
        status = cm_source_sample(&job->source, group, &desk->scratch, desk->pixels);
        if (status == CM_OK)
        {
            cm_target_store(&job->target, at.plane, at.column, at.row, group, &to, desk->pixels);
        }
    }
    return status;
}

static void do_blocks(size_t begin, size_t end, void *user)
{
    stripe_job *job = user;
    stripe_desk *desk = take_desk(job);
    if (desk == NULL)
    {
        return;
    }
    const uint32_t *order = job->order + job->begin[job->at];
    const size_t last = end / CM_TASK;
    cm_status status = CM_OK;
    place_block(job, desk, begin / CM_TASK % 2, order[begin / CM_TASK]);
    for (size_t at = begin / CM_TASK; at < last && status == CM_OK; at++)
    {
        if (at + 1 < last)
        {
            place_block(job, desk, (at + 1) % 2, order[at + 1]);
        }
        status = do_block(job, desk, at % 2, order[at]);
    }
    if (status != CM_OK)
    {
        atomic_store(&job->failed, (int)status);
    }
    cm_finish_past_caches();
    give_desk(job, desk);
}

/* All stripes of a plane, as far up as something needs them. */
static cm_status do_plane(stripe_job *job, cm_spline_stripes *stripes, unsigned plane,
                          unsigned threads)
{
    const unsigned count = cm_spline_stripes_count(stripes);
    const size_t first = plane * (size_t)count;
    if (job->begin[first] == job->begin[first + count])
    {
        return CM_OK;
    }
    cm_status status = cm_spline_stripes_begin(stripes, plane, threads);
    for (unsigned stripe = count; stripe-- > 0 && status == CM_OK;)
    {
        if (job->begin[first] == job->begin[first + stripe + 1] ||
            cm_spline_stripes_have_holes(stripes))
        {
            break;
        }
        status = cm_spline_stripes_next(stripes, threads);
        job->at = first + stripe;
        job->source.level = *cm_spline_stripes_level(stripes);
        const size_t blocks = job->begin[job->at + 1] - job->begin[job->at];
        if (status == CM_OK)
        {
            cm_run_threads(threads, blocks * CM_TASK, BLOCKS_LEAST * CM_TASK, do_blocks, job);
            status = (cm_status)atomic_load(&job->failed);
        }
    }
    return status;
}

/* ---- all of it ---- */

static int32_t rows_below(const stripe_job *job)
{
    int32_t most = 0;
    for (const part_list *list = atomic_load(&job->lists); list != NULL; list = list->next)
    {
        most = list->most > most ? list->most : most;
    }
    return most;
}

static size_t stripe_bytes(const stripe_job *job, int32_t below)
{
    const cm_source *source = &job->source;
    const int is_one =
        cm_spline_stripes_are_one(source->plan->from, &source->values, below, PLANE_BYTES);
    return is_one ? PLANE_BYTES : STRIPE_BYTES;
}

/* Is it less than half of what all coefficients take? */
static int is_worth_while(const stripe_job *job, int32_t below)
{
    const cm_source *source = &job->source;
    const cm_surface *surface = source->plan->from;
    return below < (int32_t)surface->height &&
           cm_spline_stripes_bytes(surface, &source->values, below, stripe_bytes(job, below)) <
               cm_spline_bytes(surface, &source->values) / 2;
}

static cm_status do_stripes(stripe_job *job, unsigned threads, int *is_done)
{
    const cm_source *source = &job->source;
    const int32_t below = rows_below(job);
    cm_spline_stripes *stripes = NULL;
    if (!is_worth_while(job, below))
    {
        return CM_OK;
    }
    cm_status status =
        cm_spline_stripes_create(source->plan->from, source->pictures, &source->values, source->set,
                                 below, stripe_bytes(job, below), threads, &stripes);
    job->stripes = stripes;
    status = status == CM_OK ? sort_parts(job) : status;
    for (unsigned plane = 0; plane < source->plan->from->planes && status == CM_OK; plane++)
    {
        status = do_plane(job, stripes, plane, threads);
    }
    *is_done = status == CM_OK && !cm_spline_stripes_have_holes(stripes);
    cm_spline_stripes_destroy(stripes);
    return status;
}

static void free_all(stripe_job *job)
{
    for (size_t i = 0; i < CM_THREADS_MAX; i++)
    {
        destroy_desk(atomic_load(&job->desks[i]));
    }
    for (part_list *list = atomic_load(&job->lists); list != NULL;)
    {
        part_list *next = list->next;
        free(list->parts);
        free(list);
        list = next;
    }
    free(job->order);
    free(job->begin);
    free(job->memory);
}

cm_status cm_resample_stripes(const cm_target *target, unsigned threads, int *is_done)
{
    const cm_surface *to = target->plan->to;
    void *memory;
    stripe_job *job = cm_zeros_in_lines(sizeof *job, &memory);
    *is_done = 0;
    if (job == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    job->memory = memory;
    memcpy(&job->source, target->source, sizeof job->source);
    job->target = *target;
    job->target.source = &job->source;
    job->columns = (to->width + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    job->rows = (to->height + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    const size_t blocks = (size_t)to->planes * job->columns * job->rows;
    cm_status status = CM_OK;
    if (blocks < UINT32_MAX)
    {
        atomic_init(&job->failed, CM_OK);
        cm_run_threads(threads, blocks * CM_TASK, BLOCKS_LEAST * CM_TASK, survey_blocks, job);
        status = (cm_status)atomic_load(&job->failed);
        status = status == CM_OK ? do_stripes(job, threads, is_done) : status;
    }
    free_all(job);
    return status;
}
