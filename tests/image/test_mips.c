/* SPDX-License-Identifier: MIT
 *
 * Levels of half the size, and borders.
 */
#include <cubemap/mips.h>

#include "tests/image/round_scene.h"

/* The greatest difference to the scene on a level, of pixels at an edge if is_edge. */
static double off_scene(const char *kind, const cm_image *pictures, double waves, int is_edge)
{
    char name[80];
    snprintf(name, sizeof name, "%s;size=%u%s", kind, (unsigned)pictures->width, "");
    if (pictures->width != pictures->height)
    {
        snprintf(name, sizeof name, "%s;size=%u;height=%u", kind, (unsigned)pictures->width,
                 (unsigned)pictures->height);
    }
    cm_surface *surface = make_surface(name);
    cm_image truth[PICTURES_MOST];
    double worst = 0.0;
    make_pictures(surface, CM_PIXEL_FLOAT, pictures->channels, truth);
    paint(surface, waves, truth);
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        for (size_t row = 0; row < truth->height; row++)
        {
            for (size_t column = 0; column < truth->width; column++)
            {
                const int at_edge = row == 0 || column == 0 || row + 1 == truth->height ||
                                    column + 1 == truth->width;
                if (at_edge || !is_edge)
                {
                    worst = fmax(worst, fabs(number_at(pictures, i, column, row, 0) -
                                             number_at(truth, i, column, row, 0)));
                }
            }
        }
    }
    free_pictures(surface, truth);
    cm_surface_destroy(surface);
    return worst;
}

START_TEST(levels_are_the_scene_in_small)
{
    static const struct
    {
        const char *kind, *name;
    } cases[] = {{"cube:coupled", "cube:coupled;size=128"},
                 {"cube:gnomonic", "cube:gnomonic;size=101"},
                 {"equirect", "equirect;size=256"},
                 {"equirect", "equirect;size=203;height=101"}};
    for (size_t s = 0; s < sizeof cases / sizeof *cases; s++)
    {
        cm_surface *surface = make_surface(cases[s].name);
        cm_image source[PICTURES_MOST];
        cm_mips *mips = NULL;
        make_pictures(surface, CM_PIXEL_FLOAT, 1, source);
        paint(surface, 4.0, source);
        ck_assert_int_eq(cm_mips_create(surface, source, NULL, 2, &mips), CM_OK);
        uint32_t width = source->width, height = source->height;
        for (uint32_t k = 0; k < cm_mips_count(mips); k++)
        {
            const cm_image *level = cm_mips_pictures(mips, k);
            ck_assert_ptr_nonnull(level);
            ck_assert_uint_eq(level->width, width);
            ck_assert_uint_eq(level->height, height);
            const double off = off_scene(cases[s].kind, level, 4.0, 0);
            const double edge = off_scene(cases[s].kind, level, 4.0, 1);
            if (k <= 2)
            {
                ck_assert_msg(off < 0.004 && edge < 0.004, "%s, level %u: %g, %g at edges",
                              cases[s].name, (unsigned)k, off, edge);
            }
            ck_assert_int_eq(k + 1 == cm_mips_count(mips), width == 1 && height == 1);
            width = (width + 1) / 2;
            height = (height + 1) / 2;
        }
        ck_assert_ptr_null(cm_mips_pictures(mips, cm_mips_count(mips)));
        cm_mips_destroy(mips);
        free_pictures(surface, source);
        cm_surface_destroy(surface);
    }
}
END_TEST

/* A strip has the levels of its faces, in any number of threads. */
START_TEST(layouts_and_threads_change_nothing)
{
    cm_surface *faces = make_surface("cube:qsc;size=45");
    cm_surface *strip = make_surface("cube:qsc;size=45;layout=strip");
    cm_image source[PICTURES_MOST], one[PICTURES_MOST];
    cm_mips *mips[2] = {NULL, NULL};
    make_pictures(faces, CM_PIXEL_U8, 3, source);
    make_pictures(strip, CM_PIXEL_U8, 3, one);
    paint_noise(faces, source);
    for (size_t i = 0; i < 6; i++)
    {
        for (size_t row = 0; row < 45; row++)
        {
            memcpy((uint8_t *)one->data + (row * 270 + i * 45) * 3,
                   (const uint8_t *)source[i].data + row * 45 * 3, (size_t)45 * 3);
        }
    }
    ck_assert_int_eq(cm_mips_create(faces, source, NULL, 1, &mips[0]), CM_OK);
    ck_assert_int_eq(cm_mips_create(strip, one, NULL, 3, &mips[1]), CM_OK);
    ck_assert_uint_eq(cm_mips_count(mips[0]), cm_mips_count(mips[1]));
    for (uint32_t k = 1; k < cm_mips_count(mips[0]); k++)
    {
        const cm_image *face = cm_mips_pictures(mips[0], k), *all = cm_mips_pictures(mips[1], k);
        const size_t edge = face->width;
        ck_assert_uint_eq(all->width, 6 * face->width);
        ck_assert_uint_eq(all->height, face->height);
        for (size_t i = 0; i < 6 * edge; i++)
        {
            ck_assert_mem_eq((const uint8_t *)all->data + (i / 6 * 6 * edge + i % 6 * edge) * 3,
                             (const uint8_t *)face[i % 6].data + i / 6 * edge * 3, edge * 3);
        }
    }
    cm_mips_destroy(mips[0]);
    cm_mips_destroy(mips[1]);
    free_pictures(faces, source);
    free_pictures(strip, one);
    cm_surface_destroy(faces);
    cm_surface_destroy(strip);
}
END_TEST

START_TEST(small_pictures_and_constants)
{
    static const char *const small[] = {"equirect;size=1;height=1", "equirect;size=2;height=2",
                                        "cube:coupled;size=1",      "cube:gnomonic;size=2",
                                        "cube:healpix;size=13",     "equirect;size=3;height=200"};
    for (size_t s = 0; s < sizeof small / sizeof *small; s++)
    {
        cm_surface *surface = make_surface(small[s]);
        cm_image source[PICTURES_MOST];
        cm_mips *mips = NULL;
        make_pictures(surface, CM_PIXEL_U8, 2, source);
        for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
        {
            memset(source[i].data, 77, picture_bytes(&source[i]));
        }
        const cm_plan_options options = {.size = sizeof options, .transfer = CM_TRANSFER_SRGB};
        ck_assert_int_eq(cm_mips_create(surface, source, &options, 1, &mips), CM_OK);
        for (uint32_t k = 0; k < cm_mips_count(mips); k++)
        {
            for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
            {
                const cm_image *level = &cm_mips_pictures(mips, k)[i];
                for (size_t n = 0; n < picture_bytes(level); n++)
                {
                    ck_assert_uint_eq(((const uint8_t *)level->data)[n], 77);
                }
            }
        }
        cm_mips_destroy(mips);
        free_pictures(surface, source);
        cm_surface_destroy(surface);
    }
}
END_TEST

static void border_pictures(const cm_surface *surface, uint32_t border, cm_pixel_type type,
                            cm_image *to)
{
    for (size_t i = 0; i < cm_surface_plane_count(surface); i++)
    {
        to[i] = (cm_image){.size = sizeof(cm_image),
                           .type = type,
                           .width = cm_surface_plane_width(surface) + 2 * border,
                           .height = cm_surface_plane_height(surface) + 2 * border,
                           .channels = 1};
        to[i].data = calloc((size_t)to[i].width * to[i].height, cm_pixel_size(type));
        ck_assert_ptr_nonnull(to[i].data);
    }
}

/* Around a gnomonic face the plane goes on: there the scene is known. */
START_TEST(borders_have_true_neighbours)
{
    cm_surface *surface = make_surface("cube:gnomonic;size=64");
    cm_image source[PICTURES_MOST], to[PICTURES_MOST];
    make_pictures(surface, CM_PIXEL_FLOAT, 1, source);
    paint(surface, 4.0, source);
    border_pictures(surface, 9, CM_PIXEL_FLOAT, to);
    ck_assert_int_eq(cm_border(surface, source, 9, NULL, 2, to), CM_OK);
    for (size_t plane = 0; plane < 6; plane++)
    {
        for (size_t k = 0; k < 82 * 82; k++)
        {
            const uint8_t index = (uint8_t)plane;
            const double column = (double)(k % 82) - 9.0 + 0.5, row = (double)(k / 82) - 9.0 + 0.5;
            /* the face's plane: its centre, and its directions from there */
            const uint8_t all[3] = {index, index, index};
            const double columns[3] = {32.0, 64.0, 32.0}, rows[3] = {32.0, 32.0, 64.0};
            double x[3], y[3], z[3], d[3];
            cm_surface_directions(surface, 3, all, columns, rows, x, y, z);
            const double root = sqrt(2.0), u = (column - 32.0) / 32.0, v = (row - 32.0) / 32.0;
            d[0] = x[0] + u * (root * x[1] - x[0]) + v * (root * x[2] - x[0]);
            d[1] = y[0] + u * (root * y[1] - y[0]) + v * (root * y[2] - y[0]);
            d[2] = z[0] + u * (root * z[1] - z[0]) + v * (root * z[2] - z[0]);
            const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            d[0] /= length;
            d[1] /= length;
            d[2] /= length;
            const double value = number_at(to, plane, k % 82, k / 82, 0);
            ck_assert_msg(fabs(value - scene_at(d, 4.0, 0)) < 2e-5, "plane %zu, %g, %g: %g off",
                          plane, column, row, value - scene_at(d, 4.0, 0));
        }
    }
    free_pictures(surface, source);
    free_pictures(surface, to);
    cm_surface_destroy(surface);
}
END_TEST

START_TEST(borders_of_panoramas_go_around)
{
    cm_surface *surface = make_surface("equirect;size=20");
    cm_image source, to;
    make_pictures(surface, CM_PIXEL_U8, 1, &source);
    paint_noise(surface, &source);
    border_pictures(surface, 3, CM_PIXEL_U8, &to);
    ck_assert_int_eq(cm_border(surface, &source, 3, NULL, 1, &to), CM_OK);
    for (int row = -3; row < 13; row++)
    {
        for (int column = -3; column < 23; column++)
        {
            const int over = row < 0 || row > 9;
            const int inside = row < 0 ? -1 - row : row > 9 ? 19 - row : row;
            const int around = (column + 20 + (over ? 10 : 0)) % 20;
            ck_assert_uint_eq(((uint8_t *)to.data)[(row + 3) * 26 + column + 3],
                              ((uint8_t *)source.data)[inside * 20 + around]);
        }
    }
    free_pictures(surface, &source);
    free_pictures(surface, &to);
    cm_surface_destroy(surface);
}
END_TEST

START_TEST(errors_are_said)
{
    cm_surface *surface = make_surface("cube:coupled;size=16");
    cm_image source[PICTURES_MOST], to[PICTURES_MOST];
    cm_mips *mips = NULL;
    make_pictures(surface, CM_PIXEL_U8, 1, source);
    border_pictures(surface, 9, CM_PIXEL_U8, to);
    ck_assert_int_eq(cm_mips_create(NULL, source, NULL, 1, &mips), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mips_create(surface, NULL, NULL, 1, &mips), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_border(surface, source, 9, NULL, 1, NULL), CM_ERROR_ARGUMENT);
    /* more than half the face, and pictures for another border */
    ck_assert_int_eq(cm_border(surface, source, 9, NULL, 1, to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_border(surface, source, 8, NULL, 1, to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_border(surface, source, 1000000000, NULL, 1, to), CM_ERROR_RANGE);
    const cm_plan_options options = {.size = sizeof options, .alpha = 2};
    ck_assert_int_eq(cm_mips_create(surface, source, &options, 1, &mips), CM_ERROR_RANGE);
    source[3].width--;
    ck_assert_int_eq(cm_mips_create(surface, source, NULL, 1, &mips), CM_ERROR_RANGE);
    ck_assert_ptr_null(mips);
    cm_mips_destroy(NULL);
    free_pictures(surface, source);
    free_pictures(surface, to);
    cm_surface_destroy(surface);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {levels_are_the_scene_in_small,
                                  layouts_and_threads_change_nothing,
                                  small_pictures_and_constants,
                                  borders_have_true_neighbours,
                                  borders_of_panoramas_go_around,
                                  errors_are_said,
                                  NULL};
    return run_suite("mips", tests);
}
