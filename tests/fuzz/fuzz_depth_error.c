/* SPDX-License-Identifier: MIT
 *
 * Measures of depths of any numbers: they are in order, the oracle is the best, and parts are from 0 to 1.
 */
#include "fuzz.h"

#include <cubemap/depth_error.h>

#include <math.h>

enum
{
    N = 24
};

static void take_values(supply *from, float *to)
{
    for (int i = 0; i < N; i++)
    {
        const uint8_t kind = take_byte(from);
        to[i] = kind < 230 ? 0.25f + 0.0625f * kind : kind < 240 ? NAN : 0.0f;
        if (kind >= 250)
        {
            take_bytes(from, &to[i], sizeof to[i]);
        }
    }
}

static void check_global(supply *from, const float *depth, const float *truth)
{
    cm_depth_error error = {.size = sizeof error};
    const double fraction[3] = {0.0, 0.5, 1.0}, limit = fabs(take_double(from));
    double quantile[3], ratio = 0.5;
    float local[N];
    EXPECT(cm_depth_error_local(N, depth, truth, local) == CM_OK, "local");
    if (cm_depth_error_measure(N, depth, truth, &error) == CM_OK)
    {
        EXPECT(error.count > 0 && error.count + error.missing + error.extra <= N, "%zu",
               error.count);
        EXPECT(error.mae <= error.maximum * 1.000001 && error.median_absolute <= error.maximum,
               "%g", error.mae);
        EXPECT(cm_depth_error_quantiles(N, depth, truth, 3, fraction, quantile) == CM_OK,
               "quantiles");
        EXPECT(quantile[0] <= quantile[1] && quantile[1] <= quantile[2] &&
                   quantile[2] == error.maximum,
               "%g %g %g", quantile[0], quantile[1], quantile[2]);
    }
    const cm_status status = cm_depth_error_bad(N, depth, truth, 1, &limit, &ratio);
    EXPECT(status != CM_OK || (ratio >= 0.0 && ratio <= 1.0), "%g", ratio);
}

static void check_curves(supply *from, const float *depth, const float *truth)
{
    float confidence[N];
    double fraction[3] = {0.0, 0.3, 0.9}, error[3], oracle[3], area;
    take_values(from, confidence);
    const cm_sparsification_measure measure = (cm_sparsification_measure)(take_byte(from) % 3);
    fraction[1] = take_byte(from) % 4 == 0 ? take_double(from) : fraction[1];
    if (cm_depth_error_sparsify(N, depth, truth, confidence, measure, 3, fraction, error, oracle,
                                &area) == CM_OK)
    {
        for (int i = 0; i < 3; i++)
        {
            EXPECT(!(oracle[i] > error[i] * (1.0 + 1e-9)), "%g %g", oracle[i], error[i]);
        }
        EXPECT(!(area < -1e-9), "%g", area);
    }
}

static void check_surfaces(supply *from, const float *depth, const float *truth)
{
    float other[N], angle[N];
    take_values(from, other);
    const float *const point[3] = {depth, truth, other}, *const turned[3] = {truth, other, depth};
    cm_depth_plane plane = {.size = sizeof plane};
    cm_depth_edges edges = {.size = sizeof edges};
    EXPECT(cm_depth_error_slope(N, point, turned, angle) == CM_OK, "slope");
    if (cm_depth_error_plane(N, point, &plane) == CM_OK && isfinite(plane.rms))
    {
        EXPECT(plane.rms <= plane.maximum * 1.000001, "%g %g", plane.rms, plane.maximum);
    }
    if (cm_depth_error_edges(6, 4, depth, truth, take_double(from), take_byte(from), &edges) ==
        CM_OK)
    {
        EXPECT(edges.right <= edges.measured && edges.found <= edges.true_ones, "%zu", edges.right);
    }
    EXPECT(cm_depth_error_temporal(4, 6, depth, angle, angle + 6) == CM_OK, "time");
    const double e = cm_depth_error_checkerboard(take_double(from), take_double(from),
                                                 take_double(from), take_double(from));
    EXPECT(!(e < 0.0), "%g", e);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    float depth[N], truth[N];
    take_values(&from, depth);
    take_values(&from, truth);
    check_global(&from, depth, truth);
    check_curves(&from, depth, truth);
    check_surfaces(&from, depth, truth);
    return 0;
}
