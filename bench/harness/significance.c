/* SPDX-License-Identifier: MIT */
#include "significance.h"

#include "harness.h"

#include <math.h>
#include <stdlib.h>

/* ---- The median ---- */

static double log_choose(size_t of, size_t chosen)
{
    return lgamma((double)of + 1.0) - lgamma((double)chosen + 1.0) -
           lgamma((double)(of - chosen) + 1.0);
}

/* How many samples lie beyond each end of the interval, if there is one: the median of what is sampled has fewer than k
 * of n samples on one side with the probability of fewer than k heads of n coins. */
static int samples_beyond(size_t count, double confidence, size_t *beyond)
{
    double tail = 0.0;
    size_t k = 0;
    for (; 2 * k < count; k++)
    {
        tail += exp(log_choose(count, k) - (double)count * log(2.0));
        if (1.0 - 2.0 * tail < confidence)
        {
            break;
        }
    }
    *beyond = k == 0 ? 0 : k - 1;
    return k > 0;
}

median_interval median_within(const double *samples, size_t count, double confidence)
{
    double *sorted = sorted_copy(samples, count);
    median_interval found = {sorted_median(sorted, count), (double)-INFINITY, (double)INFINITY};
    size_t beyond;
    if (samples_beyond(count, confidence, &beyond))
    {
        found.low = sorted[beyond];
        found.high = sorted[count - 1 - beyond];
    }
    free(sorted);
    return found;
}

/* ---- Two lists ---- */

typedef struct ranked
{
    double value;
    size_t rank; /* twice the mean rank of those that are equal, so that it is whole */
    int is_one;
} ranked;

typedef struct ranking
{
    size_t one;
    size_t other;
    ranked *list;
    double one_sum; /* of twice the ranks */
    double ties;    /* the sum of t^3 - t over those that are equal, t of them */
} ranking;

static int compare_values(const void *a, const void *b)
{
    const double x = ((const ranked *)a)->value;
    const double y = ((const ranked *)b)->value;
    return (x > y) - (x < y);
}

static void rank_samples(ranking *all)
{
    const size_t count = all->one + all->other;
    qsort(all->list, count, sizeof *all->list, compare_values);
    for (size_t first = 0, next; first < count; first = next)
    {
        for (next = first + 1; next < count && all->list[next].value == all->list[first].value;)
        {
            next++;
        }
        const double equal = (double)(next - first);
        all->ties += equal * equal * equal - equal;
        for (size_t i = first; i < next; i++)
        {
            all->list[i].rank = first + 1 + next;
            all->one_sum += all->list[i].is_one ? (double)all->list[i].rank : 0.0;
        }
    }
}

/* Counts, for every sum, the ways to choose as many ranks as the one list has. All terms are positive, so that
 * rounding is all that is lost. */
static double exact_probability(const ranking *all)
{
    const size_t count = all->one + all->other;
    const size_t unit = all->ties > 0.0 ? 1 : 2; /* without ties all ranks are whole */
    const size_t sums = count * (count + 1) / unit + 1;
    double *ways = allocate((all->one + 1) * sums, sizeof *ways);
    ways[0] = 1.0;
    for (size_t i = 0; i < count; i++)
    {
        const size_t rank = all->list[i].rank / unit;
        for (size_t k = i + 1 < all->one ? i + 1 : all->one; k > 0; k--)
        {
            double *to = &ways[k * sums + rank];
            const double *from = &ways[(k - 1) * sums];
            for (size_t s = 0; s + rank < sums; s++)
            {
                to[s] += from[s];
            }
        }
    }
    const double *chosen = &ways[all->one * sums];
    const size_t sum = (size_t)all->one_sum / unit;
    double up_to = 0.0;
    double from_there = 0.0;
    double total = 0.0;
    for (size_t s = 0; s < sums; s++)
    {
        up_to += s <= sum ? chosen[s] : 0.0;
        from_there += s >= sum ? chosen[s] : 0.0;
        total += chosen[s];
    }
    free(ways);
    return fmin(1.0, 2.0 * fmin(up_to, from_there) / total);
}

static double normal_probability(const ranking *all)
{
    const double one = (double)all->one;
    const double other = (double)all->other;
    const double count = one + other;
    const double u = (all->one_sum - one * (one + 1.0)) / 2.0;
    const double variance =
        one * other / 12.0 * (count + 1.0 - all->ties / (count * (count - 1.0)));
    const double away = fmax(0.0, fabs(u - one * other / 2.0) - 0.5);
    return variance > 0.0 ? erfc(away / sqrt(2.0 * variance)) : 1.0;
}

double rank_sum_probability(const double *one, size_t one_count, const double *other,
                            size_t other_count)
{
    ranking all = {.one = one_count, .other = other_count};
    all.list = allocate(one_count + other_count, sizeof *all.list);
    for (size_t i = 0; i < one_count + other_count; i++)
    {
        all.list[i].is_one = i < one_count;
        all.list[i].value = i < one_count ? one[i] : other[i - one_count];
    }
    rank_samples(&all);
    const double probability = one_count <= EXACT_SAMPLES && other_count <= EXACT_SAMPLES
                                   ? exact_probability(&all)
                                   : normal_probability(&all);
    free(all.list);
    return probability;
}

double least_rank_sum_probability(size_t one_count, size_t other_count)
{
    return fmin(1.0, 2.0 * exp(-log_choose(one_count + other_count, one_count)));
}
