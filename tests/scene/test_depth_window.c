/* SPDX-License-Identifier: MIT
 *
 * Depth images: smoothing and bounds against the same done plainly; threads and sizes.
 */
#define _POSIX_C_SOURCE 200809L

#include "rough_image.h"

/* ---- smoothing ---- */

static double smooth_plainly(const float *image, int column, int row, double pixels, double metres)
{
    const double at = (double)image[row * WIDTH + column];
    double sum = 0.0;
    double weight = 0.0;
    for (int j = row - 3; j <= row + 3; j++)
    {
        for (int i = column - 3; i <= column + 3; i++)
        {
            if (i < 0 || j < 0 || i >= WIDTH || j >= HEIGHT || !is_measured(image[j * WIDTH + i]))
            {
                continue;
            }
            const double d = (double)image[j * WIDTH + i] - at;
            const double p = (double)((i - column) * (i - column) + (j - row) * (j - row));
            const double w = exp(-p / (2.0 * pixels * pixels) - d * d / (2.0 * metres * metres));
            sum += w * d;
            weight += w;
        }
    }
    return at + sum / weight;
}

START_TEST(smoothing_is_the_bilateral_filter)
{
    float *image = rough_image(PIXELS, WIDTH);
    float *got = floats(PIXELS);
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_rays *rays = rays_of(&plain, cm_instructions_at(s));
        ck_assert_int_eq(cm_depth_smooth(rays, image, 1.5, 0.02, 1, got), CM_OK);
        for (size_t i = 0; i < PIXELS; i += i < 5 * WIDTH ? 1 : 41)
        {
            if (!is_measured(image[i]))
            {
                REQUIRE(isnan(got[i]), "%zu", i);
                continue;
            }
            const double wanted =
                smooth_plainly(image, (int)(i % WIDTH), (int)(i / WIDTH), 1.5, 0.02);
            REQUIRE(fabs((double)got[i] - wanted) <= 4e-6 + 2e-7 * wanted, "%s %zu: %.8g not %.8g",
                    cm_instructions_at(s), i, (double)got[i], wanted);
        }
        cm_rays_destroy(rays);
    }
    cm_rays *rays = rays_of(&plain, NULL);
    ck_assert_int_eq(cm_depth_smooth(rays, image, 0.0, 0.02, 1, got), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_smooth(rays, image, 1.0, (double)NAN, 1, got), CM_ERROR_RANGE);
    cm_rays_destroy(rays);
    free(image);
    free(got);
}
END_TEST

/* ---- bounds ---- */

static cm_depth_bounds bounds_plainly(const float *image, uint32_t column, uint32_t row,
                                      uint32_t last_column, uint32_t last_row)
{
    cm_depth_bounds b = {.least = INFINITY};
    for (uint32_t j = row; j <= last_row && j < HEIGHT; j++)
    {
        for (uint32_t i = column; i <= last_column && i < WIDTH; i++)
        {
            const float v = image[j * WIDTH + i];
            b.least = is_measured(v) && v < b.least ? v : b.least;
            b.most = is_measured(v) && v > b.most ? v : b.most;
            b.has_unmeasured |= !is_measured(v);
        }
    }
    return b;
}

START_TEST(pyramids_bound_all_cells)
{
    float *image = rough_image(PIXELS, WIDTH);
    for (size_t i = 0; i < 128; i++) /* a whole cell without measurements */
    {
        memset(image + (128 + i) * WIDTH + 128, 0, 128 * sizeof *image);
    }
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_depth_pyramid *pyramid = NULL;
        ck_assert_int_eq(cm_depth_pyramid_create(WIDTH, HEIGHT, cm_instructions_at(s), &pyramid),
                         CM_OK);
        ck_assert_int_eq(cm_depth_pyramid_fill(pyramid, image, 1), CM_OK);
        ck_assert_uint_eq(cm_depth_pyramid_last(pyramid), 7);
        for (uint32_t level = 1; level <= 7; level++)
        {
            cm_depth_level cells = {.size = sizeof cells};
            ck_assert_int_eq(cm_depth_pyramid_level(pyramid, level, &cells), CM_OK);
            for (uint32_t i = 0; i < cells.width * cells.height; i++)
            {
                const uint32_t column = i % cells.width << level;
                const uint32_t row = i / cells.width << level;
                const cm_depth_bounds b = bounds_plainly(
                    image, column, row, column + (1u << level) - 1, row + (1u << level) - 1);
                REQUIRE(cells.least[i] == (b.has_unmeasured ? -b.least : b.least) &&
                            cells.most[i] == b.most,
                        "level %u cell %u: %g %g", level, i, (double)cells.least[i],
                        (double)cells.most[i]);
            }
        }
        cm_depth_pyramid_destroy(pyramid);
    }
    free(image);
}
END_TEST

START_TEST(boxes_are_bounded)
{
    float *image = rough_image(PIXELS, WIDTH);
    cm_depth_pyramid *pyramid = NULL;
    uint32_t state = 3;
    ck_assert_int_eq(cm_depth_pyramid_create(WIDTH, HEIGHT, NULL, &pyramid), CM_OK);
    ck_assert_int_eq(cm_depth_pyramid_fill(pyramid, image, 2), CM_OK);
    for (int k = 0; k < 2000; k++)
    {
        const uint32_t column = next_random(&state) % WIDTH;
        const uint32_t row = next_random(&state) % HEIGHT;
        const uint32_t last_column = column + next_random(&state) % (WIDTH - column);
        const uint32_t last_row = row + next_random(&state) % (HEIGHT - row);
        const cm_depth_bounds wanted = bounds_plainly(image, column, row, last_column, last_row);
        cm_depth_bounds got;
        ck_assert_int_eq(cm_depth_pyramid_bounds(pyramid, column, row, last_column, last_row, &got),
                         CM_OK);
        REQUIRE(got.least <= wanted.least && got.most >= wanted.most &&
                    got.has_unmeasured >= wanted.has_unmeasured,
                "%d", k);
    }
    cm_depth_bounds none = {.most = 3.0f};
    ck_assert_int_eq(cm_depth_pyramid_bounds(pyramid, 1, 0, 0, 0, &none), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_pyramid_bounds(pyramid, 0, 0, WIDTH, 0, &none), CM_ERROR_RANGE);
    REQUIRE(none.most == 3.0f, "written");
    cm_depth_pyramid_destroy(pyramid);
    cm_depth_pyramid *refused = NULL;
    ck_assert_int_eq(cm_depth_pyramid_create(65536, 32768, NULL, &refused), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_pyramid_create(1, 1, "abacus", &refused), CM_ERROR_INSTRUCTIONS);
    free(image);
}
END_TEST

/* ---- threads, sizes ---- */

/* Everything there is of an image, one behind the other. */
static float *all_of(const cm_camera_options *options, const float *image, cm_pool *pool,
                     unsigned threads, size_t *count)
{
    const size_t pixels = (size_t)options->width * options->height;
    *count = 10 * pixels;
    float *all = floats(*count);
    cm_rays *rays = rays_of(options, NULL);
    ck_assert_int_eq(cm_rays_use_pool(rays, pool), CM_OK);
    ck_assert_uint_eq(cm_rays_pixel_count(rays), pixels);
    ck_assert_uint_eq(cm_rays_halved_pixel_count(rays),
                      (size_t)(options->width / 2) * (options->height / 2));
    cm_depth_maps maps = {.size = sizeof maps, .is_range = 1, .radius = all + 6 * pixels};
    for (size_t k = 0; k < 3; k++)
    {
        maps.vertex[k] = all + k * pixels;
        maps.normal[k] = all + (3 + k) * pixels;
    }
    ck_assert_int_eq(cm_depth_make_maps(rays, image, threads, &maps), CM_OK);
    ck_assert_int_eq(cm_depth_smooth(rays, image, 1.0, 0.1, threads, all + 7 * pixels), CM_OK);
    const cm_status status = cm_depth_halve(rays, image, 0.1, threads, all + 8 * pixels);
    ck_assert_int_eq(status, options->width > 1 && options->height > 1 ? CM_OK : CM_ERROR_RANGE);
    cm_depth_pyramid *pyramid = NULL;
    cm_depth_level level = {.size = sizeof level};
    ck_assert_int_eq(cm_depth_pyramid_create(options->width, options->height, NULL, &pyramid),
                     CM_OK);
    ck_assert_int_eq(cm_depth_pyramid_use_pool(pyramid, pool), CM_OK);
    ck_assert_uint_eq(cm_depth_pyramid_pixel_count(pyramid), pixels);
    ck_assert_int_eq(cm_depth_pyramid_fill(pyramid, image, threads), CM_OK);
    ck_assert_int_eq(cm_depth_pyramid_level(pyramid, cm_depth_pyramid_last(pyramid), &level),
                     CM_OK);
    memcpy(all + 9 * pixels, level.most, (size_t)level.width * level.height * sizeof *level.most);
    cm_depth_pyramid_destroy(pyramid);
    cm_rays_destroy(rays);
    return all;
}

START_TEST(threads_do_not_matter)
{
    float *image = rough_image(PIXELS, WIDTH);
    size_t count;
    float *one = all_of(&plain, image, NULL, 1, &count);
    cm_pool *pool = NULL;
    ck_assert_int_eq(cm_pool_create(3, &pool), CM_OK);
    const unsigned threads[] = {2, 7, 0, 7};
    for (int i = 0; i < 4; i++)
    {
        float *many = all_of(&plain, image, i < 2 ? NULL : pool, threads[i], &count);
        REQUIRE(memcmp(one, many, count * sizeof *one) == 0, "%u threads, %d", threads[i], i);
        free(many);
    }
    ck_assert_int_eq(cm_rays_use_pool(NULL, pool), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_pyramid_use_pool(NULL, pool), CM_ERROR_ARGUMENT);
    cm_pool_destroy(pool);
    free(one);
    free(image);
}
END_TEST

START_TEST(small_images_work)
{
    for (uint32_t width = 1; width <= 40; width++)
    {
        for (uint32_t height = 1; height <= 5; height += 2)
        {
            cm_camera_options options = plain;
            options.width = width;
            options.height = height;
            float *image = rough_image((size_t)width * height, width);
            size_t count;
            float *all = all_of(&options, image, NULL, 1, &count);
            free(all);
            free(image);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {smoothing_is_the_bilateral_filter,
                                  pyramids_bound_all_cells,
                                  boxes_are_bounded,
                                  threads_do_not_matter,
                                  small_images_work,
                                  NULL};
    return run_suite("depth windows", tests);
}
