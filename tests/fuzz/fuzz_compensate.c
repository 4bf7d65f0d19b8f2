/* SPDX-License-Identifier: MIT
 *
 * Motion compensation of any pictures by any flows: what is refused is untouched, finite pictures stay finite, the first channel
 * stays as it is, coverage and equalized values are parts, and two threads have the bits of one.
 */
#include "fuzz.h"

#include <cubemap/compensate.h>

#include <math.h>

enum
{
    SIDE_MOST = 12,
    PIXELS_MOST = SIDE_MOST * SIDE_MOST,
    CHANNELS_MOST = 5
};

typedef struct picture_size
{
    uint32_t width;
    uint32_t height;
} picture_size;

/* A number of any kind, of which many are small. */
static float take_value(supply *from, double scale)
{
    const uint8_t kind = take_byte(from);
    float value;
    if (kind < 220)
    {
        return (float)(scale * ((double)kind / 110.0 - 1.0));
    }
    take_bytes(from, &value, sizeof value);
    return kind < 230 ? NAN : kind < 235 ? INFINITY : value;
}

static int are_finite(const float *value, size_t n)
{
    int finite = 1;
    for (size_t i = 0; i < n; i++)
    {
        finite &= isfinite(value[i]) && fabsf(value[i]) < 1e30f;
    }
    return finite;
}

static void check_flow_list(cm_compensation scheme, uint32_t channels)
{
    cm_flow_pair pair[2 * CHANNELS_MOST];
    size_t count = 0;
    const cm_status status =
        cm_compensation_flows(scheme, channels, 2 * CHANNELS_MOST, pair, &count);
    EXPECT((cm_compensation_name(scheme) == NULL) == (status == CM_ERROR_ARGUMENT), "%d",
           (int)scheme);
    EXPECT(status == CM_OK || count == 0, "%d", (int)status);
    for (size_t i = 0; i < count; i++)
    {
        EXPECT(pair[i].from_channel < channels && pair[i].to_channel < channels, "%zu", i);
        EXPECT(pair[i].from_frame <= 0 && pair[i].to_frame <= 0, "%zu", i);
    }
}

static void check_compensation(supply *from, picture_size size)
{
    static float now[CHANNELS_MOST * PIXELS_MOST], before[CHANNELS_MOST * PIXELS_MOST];
    static float flow[4 * CHANNELS_MOST * PIXELS_MOST];
    static float corrected[2][CHANNELS_MOST * PIXELS_MOST];
    static cm_pool *pool;
    const size_t pixels = (size_t)size.width * size.height;
    const cm_compensation scheme = (cm_compensation)(take_byte(from) % 7);
    const cm_compensation_input input = {.size = sizeof input,
                                         .width = size.width,
                                         .height = size.height,
                                         .channels = take_byte(from) % (CHANNELS_MOST + 1),
                                         .now = now,
                                         .before = before,
                                         .flow = flow};
    const size_t values = input.channels * pixels;
    for (size_t i = 0; i < values; i++)
    {
        now[i] = take_value(from, 100.0);
        before[i] = take_value(from, 100.0);
    }
    for (size_t i = 0; i < 4 * values; i++)
    {
        flow[i] = take_value(from, 4.0);
    }
    check_flow_list(scheme, input.channels);
    corrected[0][0] = 17.0f;
    const cm_status status = cm_compensate(&input, scheme, NULL, corrected[0]);
    EXPECT(status == CM_OK || corrected[0][0] == 17.0f, "%d", (int)status);
    if (status == CM_OK)
    {
        EXPECT(memcmp(corrected[0], now, pixels * sizeof *now) == 0, "the first channel");
        EXPECT(!are_finite(now, values) || !are_finite(before, values) ||
                   are_finite(corrected[0], values),
               "%s", cm_compensation_name(scheme));
        EXPECT(pool != NULL || cm_pool_create(2, &pool) == CM_OK, "pool");
        EXPECT(cm_compensate(&input, scheme, pool, corrected[1]) == CM_OK, "threads");
        EXPECT(memcmp(corrected[0], corrected[1], values * sizeof *now) == 0, "threads");
    }
    size_t changed = 0;
    const double threshold = take_double(from);
    const cm_status pixelwise = cm_compensate_pixelwise(&input, threshold, corrected[1], &changed);
    EXPECT((pixelwise == CM_OK) == (input.channels >= 2 && threshold >= 0.0 && pixels > 0), "%d",
           (int)pixelwise);
    EXPECT(changed <= pixels, "%zu", changed);
}

static void check_warp(supply *from, picture_size size, const float *picture)
{
    static float flow[2 * PIXELS_MOST], moved[PIXELS_MOST], coverage[PIXELS_MOST];
    const size_t pixels = (size_t)size.width * size.height;
    for (size_t i = 0; i < 2 * pixels; i++)
    {
        flow[i] = take_value(from, 6.0);
    }
    const double part = take_byte(from) % 2 ? take_fraction(from) : take_double(from);
    const cm_status status =
        cm_flow_warp(size.width, size.height, picture, flow, part, moved, coverage);
    EXPECT((status == CM_OK) == (pixels > 0 && fabs(part) <= 1000.0), "%d", (int)status);
    for (size_t i = 0; i < pixels && status == CM_OK; i++)
    {
        EXPECT(coverage[i] >= 0.0f && coverage[i] <= 1.0f, "%g", (double)coverage[i]);
    }
}

static void check_changes(supply *from, picture_size size, const float *picture)
{
    static float to[PIXELS_MOST];
    static uint8_t census[PIXELS_MOST];
    const uint32_t w = size.width, h = size.height;
    const size_t pixels = (size_t)w * h;
    const uint32_t count = take_word(from) % 70;
    const double limit = take_double(from);
    const cm_status right = pixels > 0 ? CM_OK : CM_ERROR_RANGE;
    EXPECT(cm_channel_gradient(w, h, picture, to) == right, "gradient");
    EXPECT(cm_channel_census(w, h, picture, census) == right, "census");
    const cm_status normal = cm_channel_normalize(w, h, picture, limit, to);
    EXPECT(normal == CM_ERROR_RANGE || (limit > 0.0 && normal == right), "%g", limit);
    const cm_status local = cm_channel_normalize_locally(w, h, picture, count, to);
    EXPECT(local == (count > 0 ? right : CM_ERROR_RANGE), "%u", count);
    for (int tiles = 0; tiles < 2; tiles++)
    {
        const cm_status status =
            tiles ? cm_channel_equalize_locally(w, h, picture, count % 8, limit, to)
                  : cm_channel_equalize(w, h, picture, count, to);
        for (size_t i = 0; i < pixels && status == CM_OK; i++)
        {
            EXPECT(isfinite(picture[i]) ? to[i] >= 0.0f && to[i] <= 1.001f : isnan(to[i]), "%g",
                   (double)to[i]);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    static float picture[PIXELS_MOST];
    const picture_size s = {take_byte(&from) % (SIDE_MOST + 1), take_byte(&from) % (SIDE_MOST + 1)};
    for (size_t i = 0; i < (size_t)s.width * s.height; i++)
    {
        picture[i] = take_value(&from, 50.0);
    }
    check_warp(&from, s, picture);
    check_changes(&from, s, picture);
    check_compensation(&from, s);
    return 0;
}
