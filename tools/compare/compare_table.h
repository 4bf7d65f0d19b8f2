/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-compare are called in its source.
 */
#ifndef CUBEMAP_TOOLS_COMPARE_TABLE_H
#define CUBEMAP_TOOLS_COMPARE_TABLE_H

enum
{
    COMPARE_MAX_MEAN = 1,
    COMPARE_MAX_RMSE,
    COMPARE_MAX,
    COMPARE_QUIET
};

#endif
