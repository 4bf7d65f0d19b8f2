/* SPDX-License-Identifier: MIT
 *
 * How sure a median of samples is, and whether two lists of samples differ, whatever their distribution.
 */
#ifndef BENCH_HARNESS_SIGNIFICANCE_H
#define BENCH_HARNESS_SIGNIFICANCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct median_interval
{
    double median;
    double low;
    double high;
} median_interval;

/* The median of one sample or more, and the narrowest two order statistics, as many from the one end as from the other,
 * that have the median of what is sampled between them with that confidence, which is in (0, 1), or more (Conover,
 * Practical Nonparametric Statistics, 3.2). With fewer samples than that takes the ends are infinite. */
median_interval median_within(const double *samples, size_t count, double confidence);

/* The two-sided probability of Mann and Whitney's U test: of ranks that lie as far apart as these or farther, if both
 * lists, of one finite sample or more each, are of one distribution. Up to EXACT_SAMPLES in each it is counted over all
 * ways to choose the one list from both, with ties or without; above, it is that of the normal distribution with the
 * corrections for ties and continuity (Hollander, Wolfe, Chicken, Nonparametric Statistical Methods, 4.1). */
enum
{
    EXACT_SAMPLES = 30
};
double rank_sum_probability(const double *one, size_t one_count, const double *other,
                            size_t other_count);

/* The least that it can be of so many samples: where the lists do not overlap. */
double least_rank_sum_probability(size_t one_count, size_t other_count);

#ifdef __cplusplus
}
#endif

#endif
