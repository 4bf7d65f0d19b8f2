/* SPDX-License-Identifier: MIT
 *
 * Measures of how far pictures are from each other: any small pictures, weights and options. What is refused leaves
 * figures alone; what is not is in its range, and the same in two threads.
 */
#include <cubemap/compare.h>
#include <cubemap/cubemap.h>

#include <math.h>

#include "fuzz.h"

enum
{
    EDGE_MAX = 70, /* beyond a tile */
    CHANNELS_MAX = 4,
    VALUES_MAX = EDGE_MAX * EDGE_MAX * CHANNELS_MAX
};

typedef struct pictures
{
    float one[VALUES_MAX];
    float other[VALUES_MAX];
    float weights[EDGE_MAX * EDGE_MAX];
    float map[EDGE_MAX * EDGE_MAX];
    float again[EDGE_MAX * EDGE_MAX];
    uint8_t colors[EDGE_MAX * EDGE_MAX * 4];
    cm_image reference;
    cm_image picture;
    cm_image of_weights;
    cm_compare_options options;
} pictures;

static float take_value(supply *from)
{
    static const float values[] = {
        0.0f,       1.0f,   0.5f,     -1.0f, 1e-40f, 3e38f, (float)INFINITY,
        (float)NAN, -3e38f, 65504.0f, 1e-3f, 2.0f};
    const uint8_t kind = take_byte(from);
    return kind < 128 ? (float)kind / 127.0f : values[kind % (sizeof values / sizeof *values)];
}

static cm_image take_image(supply *from, float *data, uint32_t width, uint32_t height,
                           uint32_t channels)
{
    cm_image image = {.size = sizeof image,
                      .data = data,
                      .type = (cm_pixel_type)(take_byte(from) % 4),
                      .width = width,
                      .height = height,
                      .channels = channels};
    image.size -= take_byte(from) == 255;
    image.type = take_byte(from) == 255 ? (cm_pixel_type)9 : image.type;
    return image;
}

static void take_pictures(supply *from, pictures *p)
{
    const uint32_t width = 1 + take_byte(from) % EDGE_MAX;
    const uint32_t height = 1 + take_byte(from) % (1 + take_byte(from) % EDGE_MAX);
    const uint32_t channels = 1 + take_byte(from) % CHANNELS_MAX;
    p->reference = take_image(from, p->one, width, height, channels);
    p->picture = take_image(from, p->other, width, height, channels);
    p->of_weights = take_image(from, p->weights, take_byte(from) % 2 == 0 ? width : 1, height, 1);
    p->of_weights.type = CM_PIXEL_FLOAT;
    p->picture.width -= p->picture.width > 1 && take_byte(from) == 255;
    p->options = (cm_compare_options){.size = sizeof p->options};
    p->options.weights = take_byte(from) % 2 == 0 ? &p->of_weights : NULL;
    p->options.border = take_byte(from) % 8 == 0 ? take_byte(from) : 0;
    p->options.not_finite = (cm_compare_not_finite)(take_byte(from) % 5 % 4);
    p->options.peak = take_byte(from) % 4 == 0 ? (double)take_value(from) : 0.0;
    p->options.pixels_per_degree = take_byte(from) % 2 * (double)(take_byte(from) + 1) / 8.0;
    p->options.linear = take_byte(from) % 2;
    p->options.exposure_count = take_byte(from) % 8;
    p->options.exposure_stop = take_byte(from) % 8 - 1.0;
    p->options.threads = 1;
    for (size_t i = 0; i < VALUES_MAX; i++) /* repeats once the input is at its end */
    {
        p->one[i] = from->left > 0 || i < 16 ? take_value(from) : p->one[i - 16];
        p->other[i] = from->left > 0 || i < 16 ? take_value(from) : p->other[i - 13 + i % 2];
    }
    for (size_t i = 0; i < EDGE_MAX * EDGE_MAX; i++)
    {
        p->weights[i] = from->left > 0 ? take_value(from) : (float)(i % 3);
    }
}

static void check_errors(pictures *p)
{
    cm_error_figures found = {.size = sizeof found, .mse = -7.0}, more = found, part = found;
    cm_errors *errors = NULL;
    const cm_status status = cm_compare_errors(&p->reference, &p->picture, &p->options, &found);
    EXPECT(status == CM_OK || found.mse == -7.0, "status %d", (int)status);
    if (status != CM_OK)
    {
        return;
    }
    EXPECT(!(found.mse < 0.0) && !(found.largest * (1.0 + 1e-12) < found.rmse) &&
               found.largest_row < p->picture.height && found.largest_column < p->picture.width &&
               found.largest_channel < p->picture.channels && found.peak > 0.0,
           "%g %g", found.rmse, found.largest);
    p->options.threads = 2;
    EXPECT(cm_compare_errors(&p->reference, &p->picture, &p->options, &more) == CM_OK &&
               memcmp(&found, &more, sizeof found) == 0,
           "threads");
    cm_compare_options plain = p->options;
    plain.weights = NULL;
    plain.border = 0;
    plain.not_finite = CM_COMPARE_ALIKE;
    EXPECT(cm_errors_create(p->picture.channels, &plain, &errors) == CM_OK, "options");
    EXPECT(cm_errors_add(errors, &p->reference, &p->picture, p->options.weights) == CM_OK, "rows");
    EXPECT(cm_errors_get(errors, CM_ALL_CHANNELS, &more) == CM_OK, "all");
    EXPECT(cm_errors_get(errors, p->picture.channels - 1, &part) == CM_OK, "the last one");
    EXPECT(isnan(part.mse) || part.largest <= more.largest, "%g %g", part.largest, more.largest);
    EXPECT(isnan(more.psnr) || more.psnr == cm_psnr(more.mse, more.peak), "%g", more.psnr);
    cm_errors_destroy(errors);
    const cm_status values =
        cm_compare_values(p->picture.width, p->picture.channels, p->one, p->other, &plain, &more);
    EXPECT(values == CM_OK && more.pixels == p->picture.width, "status %d", (int)values);
}

static cm_status measure(pictures *p, int which, cm_map_figures *figures, float *map)
{
    double means[CHANNELS_MAX];
    const cm_image to = {sizeof to, map, CM_PIXEL_FLOAT, p->picture.width, p->picture.height, 1,
                         0,         0};
    return which == 0   ? cm_ssim(&p->reference, &p->picture, &p->options, figures, &to, means)
           : which == 1 ? cm_flip(&p->reference, &p->picture, &p->options, figures, &to)
                        : cm_flip_hdr(&p->reference, &p->picture, &p->options, figures, &to);
}

static void check_map(pictures *p, int which)
{
    cm_map_figures found = {.size = sizeof found, .mean = -7.0}, more = found;
    const size_t size = (size_t)p->picture.width * p->picture.height * sizeof *p->map;
    p->options.threads = 1;
    const cm_status status = measure(p, which, &found, p->map);
    EXPECT(status == CM_OK || found.mean == -7.0, "status %d", (int)status);
    if (status != CM_OK)
    {
        return;
    }
    const double low = which == 0 ? -1.0 : 0.0;
    EXPECT((found.pixels == 0 && isnan(found.mean)) ||
               (found.lowest >= low - 1e-9 && found.highest <= 1.0 + 1e-9 &&
                found.mean >= found.lowest - 1e-9 && found.mean <= found.highest + 1e-9),
           "measure %d: %g, %g to %g", which, found.mean, found.lowest, found.highest);
    p->options.threads = 2;
    EXPECT(measure(p, which, &more, p->again) == CM_OK &&
               memcmp(&found, &more, sizeof found) == 0 && memcmp(p->map, p->again, size) == 0,
           "threads");
}

static void grey(double t, double color[3], void *user)
{
    EXPECT(isnan(t) || (t >= 0.0 && t <= 1.0), "%g", t);
    EXPECT(user == NULL, "another user");
    color[0] = color[1] = color[2] = t;
}

static void check_pictures(pictures *p, supply *from)
{
    const cm_image map = {
        sizeof map, p->map, CM_PIXEL_FLOAT, p->picture.width, p->picture.height, 1, 0, 0};
    const cm_image to = {sizeof to,         p->colors, CM_PIXEL_U8, p->picture.width,
                         p->picture.height, 4,         0,           0};
    const double low = (double)take_value(from), high = (double)take_value(from);
    if (cm_difference_map(&p->reference, &p->picture, 1, &map) == CM_OK)
    {
        uint64_t beyond = 0;
        const cm_status status = cm_draw_map(&map, low, high, grey, NULL, &to, &beyond);
        EXPECT(status == CM_OK || !(low < high) || !isfinite(high - low), "status %d", (int)status);
        EXPECT(beyond <= (uint64_t)map.width * map.height, "%g", (double)beyond);
    }
}

static void check_places(supply *from)
{
    enum
    {
        POINTS = 8
    };
    double x[POINTS], y[POINTS], z[POINTS];
    float weights[POINTS * POINTS];
    uint64_t n = 0, first = 0;
    take_bytes(from, &n, sizeof n);
    take_bytes(from, &first, sizeof first);
    n = take_byte(from) % 2 == 0 ? n % CM_SPHERE_POINTS : n;
    first = n > 0 && take_byte(from) % 4 != 0 ? first % n : first;
    const size_t count = take_byte(from) % POINTS;
    if (cm_sphere_points(n, first, count, x, y, z) == CM_OK)
    {
        for (size_t i = 0; i < count; i++)
        {
            const double length = sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
            EXPECT(fabs(length - 1.0) < 1e-15, "%g", length - 1.0);
        }
    }
    cm_mapping *mapping = NULL;
    const size_t index = take_byte(from) % cm_catalogue_count();
    EXPECT(cm_mapping_create(cm_catalogue_at(index)->identifier, NULL, &mapping) == CM_OK, "%zu",
           index);
    const uint32_t edge = take_byte(from) % (POINTS + 1);
    const cm_status status = cm_face_weights(mapping, take_byte(from) % 8, edge, 1, weights);
    for (size_t i = 0; status == CM_OK && i < (size_t)edge * edge; i++)
    {
        EXPECT(weights[i] >= 0.0f && isfinite(weights[i]), "%g", (double)weights[i]);
    }
    cm_mapping_destroy(mapping);
    const uint32_t height = take_byte(from) % (POINTS * POINTS + 1);
    if (cm_equirect_weights(take_word(from), height, weights) == CM_OK)
    {
        EXPECT(weights[0] > 0.0f && weights[0] == weights[height - 1], "%u", height);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static pictures p;
    supply from = {data, size};
    check_places(&from);
    take_pictures(&from, &p);
    check_errors(&p);
    for (int which = 0; which < 3; which++)
    {
        check_map(&p, which);
    }
    check_pictures(&p, &from);
    return 0;
}
