/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-compare are called in its source.
 */
#ifndef CUBEMAP_TOOLS_COMPARE_TABLE_H
#define CUBEMAP_TOOLS_COMPARE_TABLE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    COMPARE_MAX_MEAN = 1,
    COMPARE_MAX_RMSE,
    COMPARE_MAX,
    COMPARE_QUIET,
    COMPARE_MEASURE,
    COMPARE_PEAK,
    COMPARE_PIXELS_PER_DEGREE,
    COMPARE_BY_AREA,
    COMPARE_SURFACE,
    COMPARE_REFERENCE_SURFACE,
    COMPARE_BORDER,
    COMPARE_SKIP_NOT_FINITE,
    COMPARE_JSON,
    COMPARE_DIFFERENCE,
    COMPARE_DIFFERENCE_OF,
    COMPARE_RANGE,
    COMPARE_COLORS,
    COMPARE_THREADS
};

/* The measures, in the order in which they are printed. */
enum
{
    MEASURE_MEAN,
    MEASURE_RMSE,
    MEASURE_MAX,
    MEASURE_BIAS,
    MEASURE_MSE,
    MEASURE_PSNR,
    MEASURE_WS_PSNR,
    MEASURE_S_PSNR,
    MEASURE_SSIM,
    MEASURE_FLIP,
    MEASURE_HDR_FLIP,
    MEASURE_COUNT
};

/* "mean", "rmse", ...; NULL behind the last. */
const char *cm_compare_measure_name(size_t index);

/* What a picture of the difference can show. */
enum
{
    DIFFERENCE_ERROR,
    DIFFERENCE_SSIM,
    DIFFERENCE_FLIP,
    DIFFERENCE_HDR_FLIP
};

#ifdef __cplusplus
}
#endif

#endif
