/* SPDX-License-Identifier: MIT
 *
 * Counted random numbers of any place and any mean: within their ranges, and in arrays as alone.
 */
#include <cubemap/random.h>

#include <math.h>

#include "fuzz.h"

enum
{
    MOST = 9
};

static double take_mean(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind % 3 == 0   ? take_double(from)
           : kind % 3 == 1 ? exp2(60.0 * take_fraction(from))
                           : 10.0 + 1e-3 * take_fraction(from);
}

static void check_count(double count, double mean)
{
    if (!(mean >= 0.0 && mean < (double)INFINITY))
    {
        EXPECT(isnan(count), "%g of mean %g", count, mean);
        return;
    }
    EXPECT(count >= 0.0 && count == floor(count), "%g of mean %g", count, mean);
    EXPECT(fabs(count - mean) <= 20.0 * (sqrt(mean) + 1.0) + 1e-15 * mean, "%g of mean %g", count,
           mean);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    uint32_t words[4];
    double uniform[MOST];
    double normal[MOST];
    double mean[MOST];
    double count[MOST];
    const uint64_t seed = take_word(&from) | (uint64_t)take_word(&from) << 32;
    const uint32_t view = take_word(&from);
    const uint32_t first = take_word(&from);
    const uint32_t sample = take_word(&from);
    const size_t n = take_byte(&from) % (MOST + 1);
    cm_random_block(seed, view, first, sample, take_word(&from), words);
    for (size_t i = 0; i < n; i++)
    {
        mean[i] = take_mean(&from);
    }
    cm_random_uniform_array(seed, view, first, sample, n, uniform);
    cm_random_normal_array(seed, view, first, sample, n, normal);
    cm_random_poisson_array(seed, view, first, sample, n, mean, count);
    for (size_t i = 0; i < n; i++)
    {
        const uint32_t pixel = first + (uint32_t)i;
        EXPECT(uniform[i] > 0.0 && uniform[i] < 1.0, "%.17g", uniform[i]);
        EXPECT(fabs(normal[i]) < 8.3, "%.17g", normal[i]);
        EXPECT(uniform[i] == cm_random_uniform(seed, view, pixel, sample), "uniform");
        EXPECT(normal[i] == cm_random_normal(seed, view, pixel, sample), "normal");
        check_count(count[i], mean[i]);
        const double alone = cm_random_poisson(seed, view, pixel, sample, mean[i]);
        EXPECT(memcmp(&alone, &count[i], sizeof alone) == 0 || isnan(alone), "Poisson");
    }
    return 0;
}
