/* SPDX-License-Identifier: MIT */
#include "exact_side.h"

#include <math.h>

/* Terms of six products of three numbers, four each. */
#define TERMS_MOST 24

/* A sum without rounding: terms that do not overlap, the smallest first (Shewchuk 1997, grow-expansion). */
typedef struct exact_sum
{
    double term[TERMS_MOST];
    int count;
} exact_sum;

static void add_term(exact_sum *sum, double b)
{
    double carry = b;
    int count = 0;
    for (int i = 0; i < sum->count; i++)
    {
        const double a = sum->term[i];
        const double total = carry + a;
        const double part = total - carry;
        const double rest = (carry - (total - part)) + (a - part);
        carry = total;
        if (rest != 0.0)
        {
            sum->term[count++] = rest;
        }
    }
    if (carry != 0.0)
    {
        sum->term[count++] = carry;
    }
    sum->count = count;
}

/* a b c: each product of two numbers is two. */
static void add_product(exact_sum *sum, double a, double b, double c)
{
    const double high = a * b;
    const double low = fma(a, b, -high);
    const double part[2] = {high * c, low * c};
    add_term(sum, fma(low, c, -part[1]));
    add_term(sum, part[1]);
    add_term(sum, fma(high, c, -part[0]));
    add_term(sum, part[0]);
}

/* The same in twice the digits of a double (Dekker 1971): its error is below 2^-98 of the sum of sizes, so that it tells all
 * but what is 0, or as good as that. */
#define ROUNDING 0x1p-98

static double rough_sum(const double ray[3], const double p[3], const double q[3], double *slack)
{
    double sum = 0.0;
    double rest = 0.0;
    double sizes = 0.0;
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double one = p[j] * q[k];
        const double other = p[k] * q[j];
        const double minor = one - other;
        const double part = minor - one;
        const double lost = (one - (minor - part)) - (other + part);
        const double low = lost + (fma(p[j], q[k], -one) - fma(p[k], q[j], -other));
        const double term = ray[i] * minor;
        const double total = sum + term;
        const double share = total - sum;
        rest += (sum - (total - share)) + (term - share) + fma(ray[i], minor, -term) + ray[i] * low;
        sum = total;
        sizes += fabs(ray[i]) * (fabs(one) + fabs(other));
    }
    *slack = ROUNDING * sizes;
    return sum + rest;
}

static int sign_of(const double ray[3], const double p[3], const double q[3])
{
    exact_sum sum = {.count = 0};
    double slack;
    const double rough = rough_sum(ray, p, q, &slack);
    if (fabs(rough) > slack)
    {
        return rough > 0.0 ? 1 : -1;
    }
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        if (ray[i] != 0.0)
        {
            add_product(&sum, p[j], q[k], ray[i]);
            add_product(&sum, -p[k], q[j], ray[i]);
        }
    }
    if (sum.count == 0)
    {
        return 0;
    }
    return sum.term[sum.count - 1] > 0.0 ? 1 : -1;
}

int cm_exact_side(const double ray[3], const double p[3], const double q[3])
{
    int sign = sign_of(ray, p, q);
    for (int i = 0; i < 3 && sign == 0; i++)
    {
        const double axis[3] = {i == 0, i == 1, i == 2};
        sign = sign_of(axis, p, q);
    }
    return sign;
}
