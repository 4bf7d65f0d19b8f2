/* SPDX-License-Identifier: MIT
 *
 * Resampling: quality, parts and threads, types and meanings of channels, bad input.
 */
#include "aligned_memory.h"
#include "drawn_scene.h"

static const cm_filter filters[] = {CM_FILTER_NEAREST,  CM_FILTER_BILINEAR, CM_FILTER_CATMULL_ROM,
                                    CM_FILTER_MITCHELL, CM_FILTER_LANCZOS3, CM_FILTER_SPLINE36};
#define FILTER_COUNT (sizeof filters / sizeof *filters)

static cm_plan_options options_of(cm_filter filter)
{
    return (cm_plan_options){.size = sizeof(cm_plan_options), .filter = filter};
}

/* Decibels that the scene allows, of pixels 1/163 of a radian wide. */
START_TEST(quality)
{
    static const double least[FILTER_COUNT] = {38.0, 65.0, 90.0, 60.0, 65.0, 90.0};
    static const char *const pairs[][2] = {
        {"equirect;size=1024", "cube:coupled;size=200"},
        {"cube:coupled;size=256", "equirect;size=700"},
        {"cube:tangent;size=256", "cube:gnomonic;size=190;frame=gl"}};
    for (size_t pair = 0; pair < sizeof pairs / sizeof *pairs; pair++)
    {
        pictures from = make_pictures(pairs[pair][0], NULL, CM_PIXEL_FLOAT, 3, 0);
        draw_scene(&from);
        /* each pair with some filters and each filter with some pair, where all would be slow */
        for (size_t i = is_quick() ? pair % 2 : 0; i < FILTER_COUNT; i += step_of(2))
        {
            pictures to = make_pictures(pairs[pair][1], NULL, CM_PIXEL_FLOAT, 3, 77);
            const cm_plan_options options = options_of(filters[i]);
            resample(&from, &to, &options, 1);
            const double decibels = -20.0 * log10(deviation(&from, &to));
            ck_assert_msg(decibels >= least[i], "%s to %s by %s: %g dB", pairs[pair][0],
                          pairs[pair][1], cm_filter_name(filters[i]), decibels);
            free_pictures(&to);
        }
        free_pictures(&from);
    }
}
END_TEST

/* A disc ends in its picture: a spline and its coefficients see what the sphere has beside it. */
START_TEST(splines_beside_a_map)
{
    pictures from =
        make_pictures("azimuthal:equidistant:fov=360;size=400", NULL, CM_PIXEL_FLOAT, 3, 255);
    pictures to = make_pictures("equirect;size=160", NULL, CM_PIXEL_FLOAT, 3, 0);
    const cm_plan_options options = options_of(CM_FILTER_BSPLINE5);
    draw_scene(&from);
    resample(&from, &to, &options, 1);
    const double decibels = -20.0 * log10(deviation(&from, &to));
    ck_assert_msg(decibels >= 90.0, "%g dB", decibels);
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

static void check_same(const pictures *one, const pictures *other, const char *what)
{
    for (size_t i = 0; i < cm_surface_picture_count(one->surface); i++)
    {
        ck_assert_msg(memcmp(one->image[i].data, other->image[i].data, one->bytes) == 0,
                      "%s: picture %zu differs", what, i);
    }
}

/* Each part alone, of rows and columns that are no multiples of anything. */
START_TEST(parts_and_threads)
{
    static const cm_pixel_type types[] = {CM_PIXEL_U8, CM_PIXEL_FLOAT};
    for (size_t k = 0; k < 2; k++)
    {
        pictures from = make_pictures("equirect;size=512", NULL, types[k], 3, 0);
        pictures whole = make_pictures("cube:qsc;size=117", NULL, types[k], 3, 1);
        pictures parts = make_pictures("cube:qsc;size=117", NULL, types[k], 3, 2);
        pictures threads = make_pictures("cube:qsc;size=117", NULL, types[k], 3, 3);
        const cm_plan_options options = options_of(CM_FILTER_CATMULL_ROM);
        cm_plan *plan;
        cm_source *source;
        draw_scene(&from);
        resample(&from, &whole, &options, 1);
        resample(&from, &threads, &options, 5);
        ck_assert_int_eq(cm_plan_create(from.surface, parts.surface, &options, &plan), CM_OK);
        ck_assert_int_eq(cm_source_create(plan, from.image, types[k], 1, &source), CM_OK);
        for (uint32_t plane = 0; plane < 6; plane++)
        {
            for (uint32_t row = 0; row < 117; row += 13)
            {
                for (uint32_t column = 0; column < 117; column += 39)
                {
                    const cm_rows rows = {plane, row, 13, column, 39};
                    ck_assert_int_eq(cm_resample_source(plan, source, parts.image, rows, 1), CM_OK);
                }
            }
        }
        check_same(&whole, &parts, "parts");
        check_same(&whole, &threads, "threads");
        cm_source_destroy(source);
        cm_plan_destroy(plan);
        free_pictures(&from);
        free_pictures(&whole);
        free_pictures(&parts);
        free_pictures(&threads);
    }
}
END_TEST

/* Large targets go to memory by whole lines, wherever they begin: the bits are those of parts of few rows, which do not. */
#define LARGE 896 /* a side: rows of any pixels are whole lines */

static void large_target(cm_pixel_type type, uint32_t channels, size_t offset, unsigned threads)
{
    const size_t bytes = LARGE * LARGE * channels * cm_pixel_size(type);
    pictures from = make_pictures("equirect;size=128", NULL, type, channels, 0);
    pictures parts = make_pictures("cube:coupled;size=896", NULL, type, channels, 2);
    const cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    cm_plan *plan;
    cm_source *source;
    cm_image whole[6];
    draw_scene(&from);
    ck_assert_int_eq(cm_plan_create(from.surface, parts.surface, &options, &plan), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, from.image, type, 1, &source), CM_OK);
    unsigned char *memory = allocate_aligned(6 * bytes + 64);
    memset(memory, 7, 6 * bytes + 64);
    for (uint32_t plane = 0; plane < 6; plane++)
    {
        whole[plane] = parts.image[plane];
        whole[plane].data = memory + offset + plane * bytes;
        for (uint32_t row = 0; row < LARGE; row += 14)
        {
            ck_assert_int_eq(cm_resample_source(plan, source, parts.image,
                                                (cm_rows){plane, row, 14, 0, LARGE}, 1),
                             CM_OK);
        }
    }
    ck_assert_int_eq(cm_resample_source(plan, source, whole, (cm_rows){0}, threads), CM_OK);
    for (size_t plane = 0; plane < 6; plane++)
    {
        ck_assert_msg(memcmp(whole[plane].data, parts.image[plane].data, bytes) == 0,
                      "%u channels of type %d, %zu bytes after a line: picture %zu differs",
                      (unsigned)channels, (int)type, offset, plane);
    }
    for (size_t i = 0; i < 64; i++)
    {
        ck_assert_int_eq(memory[i < offset ? i : 6 * bytes + i], 7);
    }
    free_aligned(memory);
    cm_source_destroy(source);
    cm_plan_destroy(plan);
    free_pictures(&from);
    free_pictures(&parts);
}

START_TEST(large_targets)
{
    large_target(CM_PIXEL_U8, 3, 0, 1);
    large_target(CM_PIXEL_U8, 3, 16, 3);
    large_target(CM_PIXEL_U8, 3, 48, 1);
    large_target(CM_PIXEL_U8, 3, 1, 1);
    large_target(CM_PIXEL_U8, 1, 32, 1);
    large_target(CM_PIXEL_U8, 2, 16, 1);
    large_target(CM_PIXEL_U8, 2, 32, 1);
    large_target(CM_PIXEL_U8, 4, 0, 2);
    large_target(CM_PIXEL_U8, 4, 16, 1);
    large_target(CM_PIXEL_FLOAT, 3, 0, 1);
    large_target(CM_PIXEL_FLOAT, 1, 4, 1);
}
END_TEST

/* A surface onto itself brings every pixel back. */
START_TEST(identity)
{
    static const char *const surfaces[] = {"equirect;size=64", "cube:coupled;size=40;layout=strip",
                                           "cube:qsc;size=33", "equal-area;size=50;height=31"};
    for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++)
    {
        pictures from = make_pictures(surfaces[i], NULL, CM_PIXEL_U8, 2, 0);
        pictures to = make_pictures(surfaces[i], NULL, CM_PIXEL_U8, 2, 255);
        draw_scene(&from);
        const cm_plan_options options = options_of(CM_FILTER_SPLINE36);
        resample(&from, &to, &options, 1);
        check_same(&from, &to, surfaces[i]);
        free_pictures(&from);
        free_pictures(&to);
    }
}
END_TEST

START_TEST(types_of_pixels)
{
    static const cm_pixel_type types[] = {CM_PIXEL_U8, CM_PIXEL_U16, CM_PIXEL_FLOAT};
    static const double least[3] = {56.0, 85.0, 85.0};
    for (size_t i = 0; i < 3; i++)
    {
        pictures from = make_pictures("cube:coupled;size=256", NULL, types[i], 4, 0);
        draw_scene(&from);
        for (size_t k = 0; k < 3; k++)
        {
            pictures to = make_pictures("equirect;size=300", NULL, types[k], 4, 0);
            const cm_plan_options options = options_of(CM_FILTER_SPLINE36);
            resample(&from, &to, &options, 1);
            const double decibels = -20.0 * log10(deviation(&from, &to));
            ck_assert_msg(decibels >= fmin(least[i], least[k]), "type %zu to type %zu: %g dB", i, k,
                          decibels);
            free_pictures(&to);
        }
        free_pictures(&from);
    }
}
END_TEST

/* Halves of all kinds come back as they were. */
START_TEST(halves)
{
    pictures from = make_pictures("equirect;size=256", NULL, CM_PIXEL_HALF, 2, 0);
    pictures to = make_pictures("equirect;size=256", NULL, CM_PIXEL_HALF, 2, 0);
    uint16_t *words = from.image->data;
    for (uint32_t i = 0; i < 65536; i++)
    {
        const int is_number = (i & 0x7c00u) != 0x7c00u;
        words[i] = is_number ? (uint16_t)i : 0x7bffu;
    }
    const cm_plan_options options = options_of(CM_FILTER_NEAREST);
    resample(&from, &to, &options, 1);
    const uint16_t *back = to.image->data;
    for (uint32_t i = 0; i < 65536; i++)
    {
        ck_assert_msg(back[i] == words[i], "half %04x becomes %04x", words[i], back[i]);
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* Opaque red beside clear green is half opaque red in the middle. */
START_TEST(alpha)
{
    pictures from = make_pictures("equirect;size=8", NULL, CM_PIXEL_U8, 4, 0);
    pictures to = make_pictures("equirect;size=16", NULL, CM_PIXEL_U8, 4, 0);
    unsigned char *bytes = from.image->data;
    for (size_t i = 0; i < 32; i++)
    {
        const unsigned char red[4] = {255, 0, 0, 255};
        const unsigned char green[4] = {0, 255, 0, 0};
        memcpy(bytes + 4 * i, i % 8 < 4 ? red : green, 4);
    }
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    options.alpha = 4;
    resample(&from, &to, &options, 1);
    const unsigned char *middle = (const unsigned char *)to.image->data + 4 * (4 * 16 + 7);
    const unsigned char wanted[4] = {255, 0, 0, 191};
    ck_assert_mem_eq(middle, wanted, 4);
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* Beyond the end of a part of the sphere opacity repeats its last pixel: continued, it would leave 0 to 1. */
START_TEST(opacity_at_the_end)
{
    pictures from = make_pictures("view:fov=90;size=8", NULL, CM_PIXEL_FLOAT, 2, 0);
    pictures to = make_pictures("view:fov=90;size=32", NULL, CM_PIXEL_FLOAT, 2, 0);
    for (size_t i = 0; i < from.bytes / sizeof(float); i++)
    {
        const size_t column = i / 2 % 8;
        const float opacity = column == 0 ? 0.25f : column == 7 ? 0.75f : column < 4 ? 1.0f : 0.0f;
        ((float *)from.image->data)[i] = i % 2 == 0 ? 0.5f : opacity;
    }
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    options.alpha = 2;
    resample(&from, &to, &options, 1);
    for (size_t i = 0; i < to.bytes / sizeof(float); i += 2)
    {
        const float *pixel = (const float *)to.image->data + i;
        ck_assert_msg(pixel[1] >= 0.0f && pixel[1] <= 1.0f, "%g", (double)pixel[1]);
        ck_assert_msg(fabsf(pixel[0] - 0.5f) < 1e-5f || pixel[1] <= 0.0f, "%g of %g",
                      (double)pixel[0], (double)pixel[1]);
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

static float middle_of(float left, float right, const cm_plan_options *options)
{
    pictures from = make_pictures("equirect;size=8", NULL, CM_PIXEL_FLOAT, 1, 0);
    pictures to =
        make_pictures("equirect;west=-90;east=90;size=1;height=1", NULL, CM_PIXEL_FLOAT, 1, 0);
    for (size_t i = 0; i < 32; i++)
    {
        memcpy((unsigned char *)from.image->data + 4 * i, i % 8 < 4 ? &left : &right, 4);
    }
    resample(&from, &to, options, 1);
    float value;
    memcpy(&value, to.image->data, sizeof value);
    free_pictures(&from);
    free_pictures(&to);
    return value;
}

START_TEST(not_finite)
{
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    ck_assert(isnan(middle_of((float)NAN, 0.5f, &options)));
    ck_assert(!isfinite(middle_of((float)INFINITY, 0.5f, &options)));
    options.not_finite = CM_NOT_FINITE_SKIP;
    ck_assert_double_eq((double)middle_of((float)NAN, 0.5f, &options), 0.5);
    ck_assert_double_eq((double)middle_of((float)-INFINITY, 0.5f, &options), 0.5);
    ck_assert(isnan(middle_of((float)NAN, (float)NAN, &options)));
    options.not_finite = CM_NOT_FINITE_ZERO;
    ck_assert_double_eq((double)middle_of((float)NAN, 0.5f, &options), 0.25);
    ck_assert_double_eq((double)middle_of(-7.0f, 3.0f, &options), -2.0);
}
END_TEST

/* The mean of black and white is half of the light. */
START_TEST(transfer)
{
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    ck_assert_double_eq_tol((double)middle_of(0.0f, 1.0f, &options), 0.5, 1e-6);
    options.transfer = CM_TRANSFER_SRGB;
    ck_assert_double_eq_tol((double)middle_of(0.0f, 1.0f, &options), 0.7353570, 1e-6);
    ck_assert_double_eq_tol((double)middle_of(-1.0f, -1.0f, &options), -1.0, 1e-6);
    ck_assert_double_eq_tol((double)middle_of(0.02f, 0.02f, &options), 0.02, 1e-7);
    options.transfer = CM_TRANSFER_GAMMA;
    options.gamma = 2.0;
    ck_assert_double_eq_tol((double)middle_of(0.0f, 1.0f, &options), 0.70710678, 1e-6);
}
END_TEST

/* Vectors that point outwards on the source do so on the target. */
START_TEST(vectors)
{
    cm_rotation turned;
    cm_rotation_from_angles(30.0, 20.0, 50.0, &turned);
    pictures from = make_pictures("cube:coupled;size=128", &turned, CM_PIXEL_FLOAT, 4, 0);
    pictures to = make_pictures("equirect;size=64", NULL, CM_PIXEL_FLOAT, 4, 0);
    for (size_t face = 0; face < 6; face++)
    {
        for (size_t i = 0; i < 128 * 128; i++)
        {
            const uint8_t number = (uint8_t)face;
            const double x = (double)(i % 128) + 0.5;
            const double y = (double)(i / 128) + 0.5;
            double earth[3], own[3];
            float *pixel = (float *)from.image[face].data + 4 * i;
            cm_surface_directions(from.surface, 1, &number, &x, &y, &earth[0], &earth[1],
                                  &earth[2]);
            cm_rotate(&turned, earth, own);
            pixel[0] = 0.25f;
            for (int k = 0; k < 3; k++)
            {
                pixel[k + 1] = (float)own[k];
            }
        }
    }
    cm_plan_options options = options_of(CM_FILTER_CATMULL_ROM);
    options.vector = 2;
    resample(&from, &to, &options, 1);
    for (uint32_t i = 0; i < 64 * 32; i++)
    {
        const uint8_t number = 0;
        const double x = i % 64 + 0.5;
        const double y = i / 64 + 0.5;
        double earth[3];
        cm_surface_directions(to.surface, 1, &number, &x, &y, &earth[0], &earth[1], &earth[2]);
        ck_assert_double_eq_tol(channel_at(to.image, i % 64, i / 64, 0), 0.25, 1e-6);
        for (uint32_t k = 0; k < 3; k++)
        {
            ck_assert_double_eq_tol(channel_at(to.image, i % 64, i / 64, k + 1), earth[k], 1e-5);
        }
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* The same of whole numbers, which hold vectors as normal maps do. */
START_TEST(vectors_in_whole_numbers)
{
    cm_rotation turned;
    cm_rotation_from_angles(30.0, 20.0, 50.0, &turned);
    pictures from = make_pictures("equirect;size=256", &turned, CM_PIXEL_U16, 4, 0);
    pictures to = make_pictures("equirect;size=64", NULL, CM_PIXEL_U16, 4, 0);
    const uint8_t number = 0;
    for (size_t i = 0; i < 256 * 128; i++)
    {
        const double x = (double)(i % 256) + 0.5, y = (double)(i / 256) + 0.5;
        double earth[3], own[3];
        uint16_t *pixel = (uint16_t *)from.image->data + 4 * i;
        cm_surface_directions(from.surface, 1, &number, &x, &y, &earth[0], &earth[1], &earth[2]);
        cm_rotate(&turned, earth, own);
        pixel[0] = 16384;
        for (int k = 0; k < 3; k++)
        {
            pixel[k + 1] = (uint16_t)lround((0.5 * own[k] + 0.5) * 65535.0);
        }
    }
    cm_plan_options options = options_of(CM_FILTER_CATMULL_ROM);
    options.vector = 2;
    resample(&from, &to, &options, 1);
    for (size_t i = 0; i < 64 * 32; i++)
    {
        const double x = (double)(i % 64) + 0.5, y = (double)(i / 64) + 0.5;
        const uint16_t *pixel = (const uint16_t *)to.image->data + 4 * i;
        double earth[3];
        cm_surface_directions(to.surface, 1, &number, &x, &y, &earth[0], &earth[1], &earth[2]);
        ck_assert_int_eq(pixel[0], 16384);
        for (int k = 0; k < 3; k++)
        {
            ck_assert_double_eq_tol(pixel[k + 1] / 65535.0 * 2.0 - 1.0, earth[k], 1e-4);
        }
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* A grey between two bytes becomes both, in the right parts. */
START_TEST(dither)
{
    pictures from = make_pictures("equirect;size=64", NULL, CM_PIXEL_FLOAT, 1, 0);
    pictures to = make_pictures("equirect;size=256", NULL, CM_PIXEL_U8, 1, 0);
    for (size_t i = 0; i < 64 * 32; i++)
    {
        ((float *)from.image->data)[i] = 100.25f / 255.0f;
    }
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    options.dither = 1;
    resample(&from, &to, &options, 1);
    double sum = 0.0;
    for (size_t i = 0; i < to.bytes; i++)
    {
        const unsigned char value = ((unsigned char *)to.image->data)[i];
        ck_assert(value == 100 || value == 101);
        sum += value;
    }
    ck_assert_double_eq_tol(sum / (double)to.bytes, 100.25, 0.01);
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* Rows that are apart, and pixels with something between them, from the bottom to the top: the same bits, of every
 * instruction set, though pixels are gathered then. */
START_TEST(strides)
{
    pictures from = make_pictures("equirect;size=128", NULL, CM_PIXEL_U8, 3, 0);
    pictures wanted = make_pictures("cube:coupled;size=50", NULL, CM_PIXEL_U8, 3, 0);
    pictures to = make_pictures("cube:coupled;size=50", NULL, CM_PIXEL_U8, 3, 9);
    cm_plan_options options = options_of(CM_FILTER_CATMULL_ROM);
    draw_scene(&from);
    const size_t row = 128 * 5 + 11;
    unsigned char *spread = malloc(row * 64);
    memset(spread, 200, row * 64);
    for (size_t i = 0; i < 128 * 64; i++)
    {
        memcpy(spread + (63 - i / 128) * row + i % 128 * 5,
               (unsigned char *)from.image->data + 3 * i, 3);
    }
    pictures apart = from;
    apart.image->data = spread + 63 * row;
    apart.image->row_stride = -(ptrdiff_t)row;
    apart.image->pixel_stride = 5;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        options.instructions = cm_instructions_at(i);
        resample(&from, &wanted, &options, 1);
        resample(&apart, &to, &options, 1);
        check_same(&wanted, &to, options.instructions);
    }
    free(spread);
    free_pictures(&from);
    free_pictures(&wanted);
    free_pictures(&to);
}
END_TEST

/* What the source does not show is 0. */
START_TEST(beyond_the_source)
{
    pictures from = make_pictures("equirect;west=-30;east=30;south=-20;north=20;size=60", NULL,
                                  CM_PIXEL_U8, 1, 200);
    pictures to = make_pictures("equirect;size=72", NULL, CM_PIXEL_U8, 1, 7);
    const cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    resample(&from, &to, &options, 1);
    for (uint32_t i = 0; i < 72 * 36; i++)
    {
        const double lon = (i % 72 + 0.5) * 5.0 - 180.0;
        const double lat = 90.0 - (i / 72 + 0.5) * 5.0;
        const int inside = fabs(lon) < 30.0 && fabs(lat) < 20.0;
        ck_assert_int_eq(((unsigned char *)to.image->data)[i], inside ? 200 : 0);
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* A plan that was text gives the same bits, and a text that is cut gives none. */
START_TEST(plan_as_text)
{
    cm_rotation turned;
    cm_rotation_from_angles(12.0, -34.0, 56.0, &turned);
    pictures from = make_pictures("equirect;size=64", &turned, CM_PIXEL_U8, 4, 0);
    pictures one = make_pictures("cube:tangent:c=1.1823;size=20;frame=gl", NULL, CM_PIXEL_U8, 4, 1);
    pictures other =
        make_pictures("cube:tangent:c=1.1823;size=20;frame=gl", NULL, CM_PIXEL_U8, 4, 2);
    cm_plan_options options = options_of(CM_FILTER_MITCHELL);
    options.tolerance = 0.01;
    options.transfer = CM_TRANSFER_GAMMA;
    options.gamma = 2.2;
    options.alpha = 4;
    options.dither = 1;
    char text[2000];
    size_t length, needed;
    cm_plan *plan;
    cm_plan *again = NULL;
    draw_scene(&from);
    ck_assert_int_eq(cm_plan_create(from.surface, one.surface, &options, &plan), CM_OK);
    ck_assert_int_eq(cm_plan_write(plan, NULL, 0, &needed), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_plan_write(plan, text, needed, &length), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_plan_write(plan, text, needed + 1, &length), CM_OK);
    ck_assert_uint_eq(length, needed);
    ck_assert_uint_eq(length, strlen(text));
    for (size_t cut = 0; cut < length; cut++)
    {
        cm_plan *none = NULL;
        const cm_status status = cm_plan_read(text, cut, NULL, &none);
        /* at the end of a line what is left may be a plan */
        ck_assert_msg((status == CM_OK) == (none != NULL) &&
                          (status != CM_OK || text[cut - 1] == '\n'),
                      "%zu bytes: %d", cut, (int)status);
        cm_plan_destroy(none);
    }
    ck_assert_int_eq(cm_plan_read(text, length, NULL, &again), CM_OK);
    ck_assert_int_eq(cm_resample(plan, from.image, one.image, (cm_rows){0}), CM_OK);
    ck_assert_int_eq(cm_resample(again, from.image, other.image, (cm_rows){0}), CM_OK);
    check_same(&one, &other, "text");
    ck_assert_int_eq(cm_plan_read("cubemap-plan 2\n", 15, NULL, &again), CM_ERROR_SYNTAX);
    ck_assert_int_eq(cm_plan_read(NULL, 0, NULL, &again), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_plan_write(NULL, text, 9, NULL), CM_ERROR_ARGUMENT);
    cm_plan_destroy(plan);
    cm_plan_destroy(again);
    free_pictures(&from);
    free_pictures(&one);
    free_pictures(&other);
}
END_TEST

START_TEST(bad_arguments)
{
    pictures from = make_pictures("equirect;size=16", NULL, CM_PIXEL_U8, 3, 0);
    pictures to = make_pictures("cube:coupled;size=4", NULL, CM_PIXEL_U8, 3, 0);
    cm_plan *plan = NULL;
    cm_source *source = NULL;
    cm_plan_options options = options_of(CM_FILTER_BILINEAR);
    ck_assert_int_eq(cm_plan_create(NULL, to.surface, &options, &plan), CM_ERROR_ARGUMENT);
    options.size = 3;
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_ERROR_ARGUMENT);
    options = options_of((cm_filter)99);
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_ERROR_RANGE);
    options = options_of(CM_FILTER_BILINEAR);
    options.transfer = CM_TRANSFER_GAMMA;
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_ERROR_RANGE);
    options = options_of(CM_FILTER_BILINEAR);
    options.tolerance = (double)NAN;
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_ERROR_RANGE);
    options = options_of(CM_FILTER_BILINEAR);
    options.instructions = "mmx";
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan),
                     CM_ERROR_INSTRUCTIONS);
    ck_assert_ptr_null(plan);
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, NULL, &plan), CM_OK);
    cm_image wrong = from.image[0];
    wrong.width = 15;
    ck_assert_int_eq(cm_source_create(plan, &wrong, CM_PIXEL_U8, 1, &source), CM_ERROR_RANGE);
    wrong = from.image[0];
    wrong.channels = 0;
    ck_assert_int_eq(cm_source_create(plan, &wrong, CM_PIXEL_U8, 1, &source), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_source_create(plan, from.image, (cm_pixel_type)9, 1, &source),
                     CM_ERROR_ARGUMENT);
    ck_assert_ptr_null(source);
    ck_assert_int_eq(cm_source_create(plan, from.image, CM_PIXEL_U8, 1, &source), CM_OK);
    const cm_rows rows[] = {{6, 0, 1, 0, 1}, {0, 4, 1, 0, 1}, {0, 0, 5, 0, 1},
                            {0, 0, 1, 4, 1}, {0, 0, 1, 1, 4}, {0, 3, UINT32_MAX, 0, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    {
        ck_assert_int_eq(cm_resample_source(plan, source, to.image, rows[i], 1), CM_ERROR_RANGE);
    }
    to.image[3].type = CM_PIXEL_U16;
    ck_assert_int_eq(cm_resample_source(plan, source, to.image, (cm_rows){0}, 1), CM_ERROR_RANGE);
    cm_source_destroy(source);
    cm_source_destroy(NULL);
    cm_plan_destroy(plan);
    cm_plan_destroy(NULL);
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* The smallest pictures, by every filter, both ways. */
START_TEST(smallest)
{
    static const char *const surfaces[] = {"equirect;size=1;height=1", "cube:coupled;size=1",
                                           "cube:qsc;size=2;layout=strip",
                                           "equirect;size=3;height=2"};
    for (size_t i = 0; i < 16 * FILTER_COUNT; i++)
    {
        pictures from = make_pictures(surfaces[i / 4 % 4], NULL, CM_PIXEL_U8, 3, 90);
        pictures to = make_pictures(surfaces[i % 4], NULL, CM_PIXEL_U8, 3, 0);
        const cm_plan_options options = options_of(filters[i / 16]);
        resample(&from, &to, &options, 1);
        for (size_t k = 0; k < to.bytes; k++)
        {
            ck_assert_int_eq(((unsigned char *)to.image->data)[k], 90);
        }
        free_pictures(&from);
        free_pictures(&to);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {quality,
                                  splines_beside_a_map,
                                  parts_and_threads,
                                  large_targets,
                                  identity,
                                  types_of_pixels,
                                  halves,
                                  alpha,
                                  opacity_at_the_end,
                                  not_finite,
                                  transfer,
                                  vectors,
                                  vectors_in_whole_numbers,
                                  dither,
                                  strides,
                                  beyond_the_source,
                                  plan_as_text,
                                  smallest,
                                  bad_arguments,
                                  NULL};
    return run_suite("resample", tests);
}
