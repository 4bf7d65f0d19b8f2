/* SPDX-License-Identifier: MIT
 *
 * Surfaces: how planes are put together in pictures; HEALPix's numbers; what programs take.
 */
#include "tests/image/round_scene.h"

/* ---- layouts ---- */

/* The direction of every pixel of a picture, NaN where there is none. */
static double *directions_of_picture(const cm_surface *surface)
{
    const size_t width = cm_surface_width(surface);
    const size_t height = cm_surface_height(surface);
    double *all = malloc(3 * width * height * sizeof *all);
    ck_assert_ptr_nonnull(all);
    for (size_t i = 0; i < 3 * width * height; i++)
    {
        all[i] = (double)NAN;
    }
    for (uint32_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            for (uint32_t column = 0; column < cm_surface_plane_width(surface); column++)
            {
                uint32_t at[3];
                const uint8_t face = (uint8_t)plane;
                const double x = column + 0.5, y = row + 0.5;
                cm_surface_pixel(surface, plane, column, row, &at[0], &at[1], &at[2]);
                double *d = all + 3 * (at[2] * width + at[1]);
                cm_surface_directions(surface, 1, &face, &x, &y, &d[0], &d[1], &d[2]);
            }
        }
    }
    return all;
}

/* How many edges of faces join in the picture what joins on the sphere. */
static int count_joints(const cm_surface *surface)
{
    const size_t width = cm_surface_width(surface);
    const size_t height = cm_surface_height(surface);
    const size_t edge = cm_surface_plane_width(surface);
    double *all = directions_of_picture(surface);
    size_t joined = 0;
    for (size_t row = 0; row < height; row++)
    {
        for (size_t column = 0; column < width; column++)
        {
            const double *at = all + 3 * (row * width + column);
            const double *right = at + 3;
            const double *below = at + 3 * width;
            joined += (column + 1) % edge == 0 && column + 1 < width &&
                      angle_between(at, right) < 3.0 / (double)edge;
            joined += (row + 1) % edge == 0 && row + 1 < height &&
                      angle_between(at, below) < 3.0 / (double)edge;
        }
    }
    free(all);
    ck_assert_uint_eq(joined % edge, 0);
    return (int)(joined / edge);
}

START_TEST(test_faces_join)
{
    static const struct
    {
        const char *layout;
        int joints;
    } layouts[] = {{"cross", 5},
                   {"cross:north=0,south=2", 5},
                   {"cross:north=3,south=3", 5},
                   {"vcross", 5},
                   {"eac", 4}};
    for (size_t f = 0; f < cm_frame_count(); f++)
    {
        for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++)
        {
            char text[100];
            snprintf(text, sizeof text, "cube;frame=%s;layout=%s;size=16",
                     cm_frame_at(f)->identifier, layouts[i].layout);
            cm_surface *surface = make_surface(text);
            REQUIRE(count_joints(surface) == layouts[i].joints, "%s: %d", text,
                    count_joints(surface));
            cm_surface_destroy(surface);
        }
    }
}
END_TEST

/* Where the axes are in pictures of other programs: by cells of a face, and what is to the right and below. */
typedef struct cell_case
{
    const char *specification;
    struct
    {
        int column;
        int row;
        double middle[3];
        double right[3];
        double down[3];
    } cell[6];
} cell_case;

/* FFmpeg 5.1 writes eac by v360=e:eac as this, and the cross of the frame gl is that of Debevec's light probes. */
static const cell_case cells[] = {
    {"cube:tangent;layout=eac;size=8",
     {{0, 0, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
      {1, 0, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
      {2, 0, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
      {0, 1, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
      {1, 1, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      {2, 1, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}}}},
    {"cube;frame=gl;layout=vcross;size=8",
     {{1, 0, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      {0, 1, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      {1, 1, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
      {2, 1, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {1, 2, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
      {1, 3, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}},
    {"cube;layout=cross:north=2,south=0;size=8",
     {{2, 0, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
      {0, 1, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
      {1, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
      {2, 1, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
      {3, 1, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {0, 2, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}},
};

START_TEST(test_cells)
{
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++)
    {
        cm_surface *surface = make_surface(cells[i].specification);
        const int width = (int)cm_surface_width(surface);
        double *all = directions_of_picture(surface);
        for (int k = 0; k < 6; k++)
        {
            const int column = cells[i].cell[k].column * 8;
            const int row = cells[i].cell[k].row * 8;
            double sum[3] = {0}, right[3], down[3];
            for (int axis = 0; axis < 3; axis++)
            {
                const double *at = all + axis + 3 * (row * width + column);
                sum[axis] = at[0] + at[3 * 7] + at[3 * 7 * width] + at[3 * 7 * (width + 1)];
                right[axis] = at[3 * 7] - at[0];
                down[axis] = at[3 * 7 * width] - at[0];
            }
            for (int axis = 0; axis < 3; axis++)
            {
                REQUIRE(fabs(sum[axis] / 2.0 - cells[i].cell[k].middle[axis]) < 0.4 &&
                            fabs(right[axis] - cells[i].cell[k].right[axis]) < 0.4 &&
                            fabs(down[axis] - cells[i].cell[k].down[axis]) < 0.4,
                        "%s, cell %d, axis %d: %g, %g, %g", cells[i].specification, k, axis,
                        sum[axis] / 2.0, right[axis], down[axis]);
            }
        }
        free(all);
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(test_pad)
{
    cm_surface *plain = make_surface("cube:tangent;layout=eac;size=8");
    cm_surface *padded = make_surface("cube:tangent;layout=eac:pad=3;size=8");
    ck_assert_uint_eq(cm_surface_width(padded), cm_surface_width(plain) + 6);
    ck_assert_uint_eq(cm_surface_height(padded), cm_surface_height(plain) + 12);
    for (uint32_t face = 0; face < 6; face++)
    {
        uint32_t at[2][3];
        cm_surface_pixel(plain, face, 1, 2, &at[0][0], &at[0][1], &at[0][2]);
        cm_surface_pixel(padded, face, 1, 2, &at[1][0], &at[1][1], &at[1][2]);
        ck_assert_uint_eq(at[1][1], at[0][1] + 3);
        ck_assert_uint_eq(at[1][2], at[0][2] + (at[0][2] < 8 ? 3 : 9));
    }
    cm_surface_destroy(plain);
    cm_surface_destroy(padded);
}
END_TEST

/* ---- HEALPix ---- */

START_TEST(test_healpix_numbers)
{
    static const int64_t nsides[] = {1, 2, 3, 8, 20};
    for (size_t i = 0; i < sizeof nsides / sizeof *nsides; i++)
    {
        const int64_t nside = nsides[i];
        const size_t count = (size_t)(12 * nside * nside);
        int32_t *list = malloc(count * sizeof *list);
        int32_t *picture = malloc(count * sizeof *picture);
        int32_t *back = malloc(count * sizeof *back);
        ck_assert(list != NULL && picture != NULL && back != NULL);
        for (int order = 0; order < 2; order++)
        {
            cm_healpix *healpix = NULL;
            const cm_status status =
                cm_healpix_create(nside, (cm_healpix_order)order, NULL, &healpix);
            for (size_t k = 0; k < count; k++)
            {
                list[k] = (int32_t)k;
            }
            ck_assert_int_eq(
                cm_healpix_arrange(nside, (cm_healpix_order)order, 0, sizeof *list, list, picture),
                status);
            if (status != CM_OK)
            {
                continue;
            }
            ck_assert_int_eq(
                cm_healpix_arrange(nside, (cm_healpix_order)order, 1, sizeof *list, picture, back),
                CM_OK);
            ck_assert_mem_eq(list, back, count * sizeof *list);
            /* base pixels are quarters of quarters of the list, from their southern corner */
            if (order == CM_HEALPIX_NESTED)
            {
                for (int32_t base = 0; base < 12; base++)
                {
                    const size_t south = (size_t)((nside - 1) * 12 * nside + base * nside);
                    ck_assert_int_eq(picture[south], (int32_t)(base * nside * nside));
                    const size_t north = (size_t)(base * nside + nside - 1);
                    ck_assert_int_eq(picture[north], (int32_t)((base + 1) * nside * nside - 1));
                }
            }
            cm_healpix_destroy(healpix);
        }
        free(list);
        free(picture);
        free(back);
    }
    int32_t one = 0;
    ck_assert_int_eq(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, 0, &one, &one), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, 4, NULL, &one), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_arrange(0, CM_HEALPIX_RING, 0, 4, &one, &one), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_arrange(1 << 28, CM_HEALPIX_RING, 0, 4, &one, &one),
                     CM_ERROR_RANGE);
}
END_TEST

/* ---- presets ---- */

/* What a program has to its right, above and ahead on its cube: the face, and the middle of its picture. */
START_TEST(test_presets)
{
    static const struct
    {
        const char *identifier;
        double ahead[3];
        double right[3];
        double up[3];
    } axes[] = {
        {"opengl", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {"Vulkan", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
        {"directx", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {"unity", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
        {"unreal", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {"threejs", {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {"youtube", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    ck_assert_uint_eq(cm_surface_preset_count(), sizeof axes / sizeof *axes);
    ck_assert_ptr_null(cm_surface_preset_at(cm_surface_preset_count()));
    ck_assert_ptr_null(cm_surface_preset_find("nothing"));
    ck_assert_ptr_null(cm_surface_preset_find("unit"));
    ck_assert_ptr_null(cm_surface_preset_find("unityy"));
    ck_assert_ptr_null(cm_surface_preset_find(NULL));
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++)
    {
        const cm_surface_preset *preset = cm_surface_preset_find(axes[i].identifier);
        ck_assert_ptr_eq(preset, cm_surface_preset_at(i));
        ck_assert(strlen(preset->name) > 0 && strlen(preset->source) > 0);
        ck_assert_int_eq(cm_rotation_check(&preset->rotation), CM_OK);
        const double *ends[3] = {axes[i].ahead, axes[i].right, axes[i].up};
        for (int k = 0; k < 3; k++)
        {
            const double earth[3] = {k == 0, k == 1, k == 2};
            double own[3];
            cm_rotate(&preset->rotation, earth, own);
            ck_assert_double_eq(angle_between(own, ends[k]), 0.0);
        }
        const cm_surface_options options = {
            .size = sizeof options, .height = 0, .width = 48, .rotation = &preset->rotation};
        cm_surface *surface = NULL;
        ck_assert_int_eq(cm_surface_create(preset->specification, &options, &surface), CM_OK);
        cm_surface_destroy(surface);
    }
}
END_TEST

/* Unreal's pictures, as its manual has them: +x turned 90 degrees anticlockwise, -x clockwise, +y by 180, -y not, against
 * pictures that are upright. */
START_TEST(test_unreal_faces_are_turned)
{
    const cm_surface_preset *preset = cm_surface_preset_find("unreal");
    const cm_surface_options options = {
        .size = sizeof options, .width = 8, .rotation = &preset->rotation};
    cm_surface *surface = NULL;
    ck_assert_int_eq(cm_surface_create(preset->specification, &options, &surface), CM_OK);
    /* where in the picture "up" is: its left side after a turn anticlockwise */
    static const double up_of_face[4][2] = {{0.0, 4.0}, {8.0, 4.0}, {4.0, 8.0}, {4.0, 0.0}};
    for (uint8_t face = 0; face < 4; face++)
    {
        double d[3];
        cm_surface_directions(surface, 1, &face, &up_of_face[face][0], &up_of_face[face][1], &d[0],
                              &d[1], &d[2]);
        ck_assert_double_eq_tol(d[2], sqrt(0.5), 1e-15);
    }
    cm_surface_destroy(surface);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_faces_join,
                                  test_cells,
                                  test_pad,
                                  test_healpix_numbers,
                                  test_presets,
                                  test_unreal_faces_are_turned,
                                  NULL};
    return run_suite("surface layouts", tests);
}
