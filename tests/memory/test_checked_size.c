/* SPDX-License-Identifier: MIT
 *
 * Sums and products of sizes beside those of wider numbers, where they fit and where they would wrap.
 */
#include "modules/memory/checked_size.h"

#include "tests/suite.h"

static const size_t sizes[] = {
    0,
    1,
    2,
    3,
    7,
    8,
    (size_t)1 << (4 * sizeof(size_t)),
    ((size_t)1 << (4 * sizeof(size_t))) - 1,
    ((size_t)1 << (4 * sizeof(size_t))) + 1,
    SIZE_MAX / 8,
    SIZE_MAX / 8 + 1,
    SIZE_MAX / 3,
    SIZE_MAX / 3 + 1,
    SIZE_MAX / 2,
    SIZE_MAX / 2 + 1,
    SIZE_MAX - 1,
    SIZE_MAX,
};
#define COUNT (sizeof sizes / sizeof *sizes)

START_TEST(sums_stay)
{
    for (size_t i = 0; i < COUNT * COUNT; i++)
    {
        const size_t a = sizes[i / COUNT], b = sizes[i % COUNT], sum = a + b;
        const size_t right = sum < a ? SIZE_MAX : sum;
        REQUIRE(cm_size_sum(a, b) == right, "%zu + %zu: %zu", a, b, cm_size_sum(a, b));
    }
}
END_TEST

/* The halves of a number are multiplied apart, as on paper. */
static size_t upper_half_of_product(size_t a, size_t b)
{
    const unsigned bits = 4 * sizeof(size_t);
    const size_t low = ((size_t)1 << bits) - 1;
    const size_t inner = (a & low) * (b & low), left = (a >> bits) * (b & low);
    const size_t right = (a & low) * (b >> bits), outer = (a >> bits) * (b >> bits);
    const size_t carried = (inner >> bits) + (left & low) + (right & low);
    return outer + (left >> bits) + (right >> bits) + (carried >> bits);
}

START_TEST(products_stay)
{
    for (size_t i = 0; i < COUNT * COUNT; i++)
    {
        const size_t a = sizes[i / COUNT], b = sizes[i % COUNT];
        const size_t right = upper_half_of_product(a, b) != 0 ? SIZE_MAX : a * b;
        REQUIRE(cm_size_product(a, b) == right, "%zu * %zu: %zu", a, b, cm_size_product(a, b));
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {sums_stay, products_stay, NULL};
    return run_suite("checked size", tests);
}
