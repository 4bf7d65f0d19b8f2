/* SPDX-License-Identifier: MIT
 *
 * Numbers that fill the unit square evenly, and one more that does the unit interval: Sobol's first two dimensions, in an order
 * and scrambled as Owen has it, by hashing (Burley 2020, "Practical hash-based Owen scrambling"), and the first one in another
 * order.
 */
#ifndef CUBEMAP_SIM_LOW_DISCREPANCY_H
#define CUBEMAP_SIM_LOW_DISCREPANCY_H

#include <stdint.h>

/* Point index of the sequence that the four random words make, in [0, 1). The first 2^k points are in different cells of any
 * division of the square into 2^k ones, and of the interval. */
void low_discrepancy_point(const uint32_t words[4], uint32_t index, double u[3]);

#endif
