/* SPDX-License-Identifier: MIT
 *
 * Pairs of stamps, the closest first. The closest two that are left are always neighbours among all that are left, since
 * whatever is between them is closer to one of them: so a list of all, a heap of its neighbours, and one new pair of
 * neighbours for each that is taken.
 */
#include <cubemap/trajectory.h>

#include <stdlib.h>

#include "trajectory_data.h"

#define NONE ((size_t)-1)

/* A stamp of either, in the order of time. */
typedef struct member
{
    double stamp;
    size_t index; /* in its trajectory */
    int is_b;
    int is_taken;
    size_t before; /* of those left; NONE at the ends */
    size_t after;
} member;

/* Neighbours, one of each trajectory. */
typedef struct neighbours
{
    double apart;
    size_t first;
    size_t second;
} neighbours;

typedef struct match
{
    member *all;
    size_t count;
    neighbours *heap; /* no more than twice as many as there are stamps */
    size_t heap_count;
    double apart;
    size_t *partner; /* of a's stamps: the index in b, or NONE */
} match;

static size_t index_of(const match *m, const neighbours *pair, int is_b)
{
    return m->all[pair->first].is_b == is_b ? m->all[pair->first].index
                                            : m->all[pair->second].index;
}

static int is_sooner(const match *m, const neighbours *x, const neighbours *y)
{
    if (x->apart != y->apart)
    {
        return x->apart < y->apart;
    }
    const size_t of_x = index_of(m, x, 0);
    const size_t of_y = index_of(m, y, 0);
    return of_x != of_y ? of_x < of_y : index_of(m, x, 1) < index_of(m, y, 1);
}

static void push(match *m, neighbours pair)
{
    size_t at = m->heap_count++;
    while (at > 0 && is_sooner(m, &pair, &m->heap[(at - 1) / 2]))
    {
        m->heap[at] = m->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    m->heap[at] = pair;
}

static neighbours pop(match *m)
{
    const neighbours top = m->heap[0];
    const neighbours last = m->heap[--m->heap_count];
    size_t at = 0;
    for (;;)
    {
        size_t child = 2 * at + 1;
        if (child + 1 < m->heap_count && is_sooner(m, &m->heap[child + 1], &m->heap[child]))
        {
            child++;
        }
        if (child >= m->heap_count || !is_sooner(m, &m->heap[child], &last))
        {
            break;
        }
        m->heap[at] = m->heap[child];
        at = child;
    }
    m->heap[at] = last;
    return top;
}

static void offer(match *m, size_t first, size_t second)
{
    if (first == NONE || second == NONE || m->all[first].is_b == m->all[second].is_b)
    {
        return;
    }
    const double begin = m->all[first].stamp;
    const double end = m->all[second].stamp;
    if (cm_stamps_within(begin, end, m->apart))
    {
        push(m, (neighbours){end - begin, first, second});
    }
}

/* Both in one order; of stamps that are equal a's is first. */
static void merge(match *m, const cm_trajectory *a, const cm_trajectory *b)
{
    size_t i = 0;
    size_t j = 0;
    for (size_t k = 0; k < m->count; k++)
    {
        const int is_b = i == a->count || (j < b->count && b->stamp[j] < a->stamp[i]);
        const size_t index = is_b ? j++ : i++;
        m->all[k] = (member){.stamp = is_b ? b->stamp[index] : a->stamp[index],
                             .index = index,
                             .is_b = is_b,
                             .before = k == 0 ? NONE : k - 1,
                             .after = k + 1 == m->count ? NONE : k + 1};
    }
    for (size_t k = 1; k < m->count; k++)
    {
        offer(m, k - 1, k);
    }
}

/* Returns how many pairs there are. */
static size_t take_pairs(match *m)
{
    size_t count = 0;
    while (m->heap_count > 0)
    {
        const neighbours pair = pop(m);
        member *first = &m->all[pair.first];
        member *second = &m->all[pair.second];
        if (first->is_taken || second->is_taken)
        {
            continue;
        }
        first->is_taken = 1;
        second->is_taken = 1;
        m->partner[index_of(m, &pair, 0)] = index_of(m, &pair, 1);
        count++;
        /* pairs that are still in the heap were neighbours then; the two may have others between them no more */
        if (first->before != NONE)
        {
            m->all[first->before].after = second->after;
        }
        if (second->after != NONE)
        {
            m->all[second->after].before = first->before;
        }
        offer(m, first->before, second->after);
    }
    return count;
}

static void write_pairs(const match *m, size_t count_a, size_t *index_a, size_t *index_b)
{
    size_t at = 0;
    for (size_t i = 0; i < count_a; i++)
    {
        if (m->partner[i] != NONE)
        {
            index_a[at] = i;
            index_b[at++] = m->partner[i];
        }
    }
}

cm_status cm_trajectory_associate(const cm_trajectory *a, const cm_trajectory *b, double apart,
                                  size_t room, size_t *index_a, size_t *index_b, size_t *count)
{
    if (a == NULL || b == NULL || count == NULL ||
        (room > 0 && (index_a == NULL || index_b == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(apart >= 0.0))
    {
        return CM_ERROR_RANGE;
    }
    match m = {.count = a->count + b->count, .apart = apart};
    m.all = calloc(m.count, sizeof *m.all);
    m.heap = calloc(m.count, 2 * sizeof *m.heap);
    m.partner = calloc(a->count, sizeof *m.partner);
    cm_status status = CM_ERROR_MEMORY;
    if (m.all != NULL && m.heap != NULL && m.partner != NULL)
    {
        for (size_t i = 0; i < a->count; i++)
        {
            m.partner[i] = NONE;
        }
        merge(&m, a, b);
        *count = take_pairs(&m);
        status = *count <= room ? CM_OK : CM_ERROR_SPACE;
        if (status == CM_OK)
        {
            write_pairs(&m, a->count, index_a, index_b);
        }
    }
    free(m.all);
    free(m.heap);
    free(m.partner);
    return status;
}
