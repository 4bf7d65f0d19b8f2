/* SPDX-License-Identifier: MIT
 *
 * Surfaces against the filter v360 of FFmpeg: pictures of a scene that it has converted have the scene where the surface
 * says, and it finds the scene in pictures that were painted by the surface.
 *
 *   v360 [FFMPEG]     77, skipped, if there is none
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/image.h>

#include "tests/suite.h"
#include "truth/analytic_scene.h"

#include <unistd.h>

enum
{
    ROW_MOST = 1024,
    TEXT = 512
};

/* Decibels: its Lanczos has weights of 14 bits. */
#define LEAST 50.0

typedef struct v360_case
{
    const char *surface;
    const char *preset; /* whose rotation is taken; NULL: as turn says */
    double turn;        /* degrees around the vertical axis */
    const char *name;   /* of v360, with its keys */
    double
        margin; /* pixels of the surface beside its planes' edges, where v360 finds what is not its own */
} v360_case;

/* Faces in the order of OpenGL are v360's right, left, up, down, front, back. Its first fisheye looks back. Of eac it
 * reads its pad, which no surface paints. */
static const v360_case cases[] = {
    {"equirect;size=512", NULL, 0.0, "e", 0.0},
    {"equirect;west=-90;east=90;size=256", NULL, 0.0, "hequirect", 4.0},
    {"cube:gnomonic;frame=gl;layout=3x2;size=128", "opengl", 0.0, "c3x2", 0.0},
    {"cube:gnomonic;frame=gl;layout=strip;size=128", "opengl", 0.0, "c6x1", 0.0},
    {"cube:gnomonic;frame=gl;layout=column;size=128", "opengl", 0.0, "c1x6", 0.0},
    {"cube:tangent;frame=geo;layout=eac:pad=2;size=128", "youtube", 0.0, "eac", 4.0},
    {"dual-fisheye;size=512", NULL, 180.0, "dfisheye", 4.0},
    {"fisheye:equidistant:fov=170;size=256", NULL, 0.0, "fisheye:h_fov=170:v_fov=170", 4.0},
    {"fisheye:stereographic:fov=200;size=256", NULL, 0.0, "sg:h_fov=200:v_fov=200", 4.0},
    {"fisheye:lambert:fov=240;size=256", NULL, 0.0, "equisolid:h_fov=240:v_fov=240", 4.0},
    {"fisheye:orthographic:fov=160;size=256", NULL, 0.0, "og:h_fov=160:v_fov=160", 4.0},
    {"view:fov=90;size=256;height=256", NULL, 0.0, "flat:h_fov=90:v_fov=90", 4.0},
    {"mercator;size=512", NULL, 0.0, "mercator", 4.0},
    {"equal-area;size=512", NULL, 0.0, "cylindricalea", 4.0},
};
#define CASES (sizeof cases / sizeof *cases)

static analytic_scene the_scene;
static const char *ffmpeg = "ffmpeg";
static char folder[] = "/tmp/test-v360-XXXXXX";

static cm_surface *make(const char *specification, const char *preset, double turn)
{
    cm_rotation rotation;
    cm_surface_options options = {.size = sizeof options};
    cm_surface *surface = NULL;
    cm_rotation_from_angles(turn, 0.0, 0.0, &rotation);
    options.rotation = preset != NULL ? &cm_surface_preset_find(preset)->rotation : &rotation;
    REQUIRE(cm_surface_create(specification, &options, &surface) == CM_OK, "%s", specification);
    return surface;
}

/* The scene in all pixels of a plane's row; NaN where there is none. */
static void row_values(const cm_surface *surface, uint32_t plane, uint32_t row,
                       double d[3][ROW_MOST], double values[ROW_MOST * SCENE_CHANNELS])
{
    static uint8_t planes[ROW_MOST];
    static double columns[ROW_MOST], rows[ROW_MOST];
    const uint32_t width = cm_surface_plane_width(surface);
    for (uint32_t i = 0; i < width; i++)
    {
        planes[i] = (uint8_t)plane;
        columns[i] = i + 0.5;
        rows[i] = row + 0.5;
    }
    cm_surface_directions(surface, width, planes, columns, rows, d[0], d[1], d[2]);
    scene_values(&the_scene, width, d[0], d[1], d[2], values);
    for (uint32_t i = 0; i < width; i++)
    {
        for (uint32_t c = 0; c < SCENE_CHANNELS && isnan(d[0][i]); c++)
        {
            values[i * SCENE_CHANNELS + c] = (double)NAN;
        }
    }
}

/* NaN for values in directions that another surface does not show, or only near the edges of its planes. */
static void drop_edges(const cm_surface *other, double margin, size_t n, double d[3][ROW_MOST],
                       double *values)
{
    static uint8_t plane[ROW_MOST];
    static double at[2][ROW_MOST], near[3][ROW_MOST];
    cm_surface_positions(other, n, d[0], d[1], d[2], plane, at[0], at[1]);
    for (int k = 0; k < 4; k++)
    {
        const double right = k < 2 ? margin * (2 * k - 1) : 0.0;
        const double down = k < 2 ? 0.0 : margin * (2 * k - 5);
        double to[2][ROW_MOST];
        for (size_t i = 0; i < n; i++)
        {
            to[0][i] = at[0][i] + right;
            to[1][i] = at[1][i] + down;
        }
        cm_surface_directions(other, n, plane, to[0], to[1], near[0], near[1], near[2]);
        for (size_t i = 0; i < SCENE_CHANNELS * n; i++)
        {
            values[i] = isnan(near[0][i / SCENE_CHANNELS]) ? (double)NAN : values[i];
        }
    }
}

static size_t numbers_of(const cm_surface *surface)
{
    return (size_t)cm_surface_width(surface) * cm_surface_height(surface) * SCENE_CHANNELS;
}

typedef void visit(uint16_t *number, double value, double sum[2]);

/* All numbers of a picture with what they should be; if other is not NULL, only what that shows. */
static void for_numbers(const cm_surface *surface, const cm_surface *other, double margin,
                        uint16_t *picture, visit *call, double sum[2])
{
    static double values[ROW_MOST * SCENE_CHANNELS], d[3][ROW_MOST];
    for (uint32_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            row_values(surface, plane, row, d, values);
            if (other != NULL)
            {
                drop_edges(other, margin, cm_surface_plane_width(surface), d, values);
            }
            for (uint32_t i = 0; i < cm_surface_plane_width(surface); i++)
            {
                uint32_t at[3];
                cm_surface_pixel(surface, plane, i, row, &at[0], &at[1], &at[2]);
                uint16_t *pixel =
                    picture + ((size_t)at[2] * cm_surface_width(surface) + at[1]) * SCENE_CHANNELS;
                for (uint32_t c = 0; c < SCENE_CHANNELS && !isnan(values[i * SCENE_CHANNELS + c]);
                     c++)
                {
                    call(&pixel[c], values[i * SCENE_CHANNELS + c], sum);
                }
            }
        }
    }
}

static void put(uint16_t *number, double value, double sum[2])
{
    (void)sum;
    *number = (uint16_t)lrint(65535.0 * value);
}

static void compare(uint16_t *number, double value, double sum[2])
{
    const double error = *number / 65535.0 - value;
    sum[0] += error * error;
    sum[1] += 1.0;
}

static double decibels(const cm_surface *surface, const cm_surface *other, double margin,
                       uint16_t *picture)
{
    double sum[2] = {0.0, 0.0};
    for_numbers(surface, other, margin, picture, compare, sum);
    ck_assert_double_gt(sum[1], 10000.0);
    return -10.0 * log10(sum[0] / sum[1]);
}

/* The picture as v360 converts it, to the size of another. */
static void convert(const cm_surface *from, uint16_t *source, const char *input,
                    const cm_surface *to, const char *output, uint16_t *target)
{
    char path[2][TEXT], command[4 * TEXT];
    snprintf(path[0], TEXT, "%s/in", folder);
    snprintf(path[1], TEXT, "%s/out", folder);
    FILE *file = fopen(path[0], "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(source, 2, numbers_of(from), file), numbers_of(from));
    ck_assert_int_eq(fclose(file), 0);
    snprintf(command, sizeof command,
             "'%s' -nostdin -loglevel error -y -f rawvideo -pix_fmt rgb48le -s %ux%u -i '%s' -vf "
             "'format=gbrp16le,v360=input=%s:output=%s:interp=lanczos:w=%u:h=%u' -f rawvideo "
             "-pix_fmt rgb48le '%s'",
             ffmpeg, cm_surface_width(from), cm_surface_height(from), path[0], input, output,
             cm_surface_width(to), cm_surface_height(to), path[1]);
    REQUIRE(system(command) == 0, "%s", command);
    file = fopen(path[1], "rb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fread(target, 2, numbers_of(to), file), numbers_of(to));
    ck_assert_int_eq(fclose(file), 0);
    unlink(path[0]);
    unlink(path[1]);
}

/* The keys of an input have other names. */
static void input_name(const char *output, char input[TEXT])
{
    size_t length = 0;
    for (const char *c = output; *c != '\0'; c++)
    {
        if (c > output && c[-1] == ':')
        {
            input[length++] = 'i';
        }
        input[length++] = *c;
    }
    input[length] = '\0';
}

static void check_case(const v360_case *one)
{
    cm_surface *globe = make("equirect;size=512", NULL, 0.0);
    cm_surface *surface = make(one->surface, one->preset, one->turn);
    uint16_t *whole = calloc(numbers_of(globe), 2), *part = calloc(numbers_of(surface), 2);
    char input[TEXT];
    ck_assert(whole != NULL && part != NULL);
    for_numbers(globe, NULL, 0.0, whole, put, NULL);
    convert(globe, whole, "e", surface, one->name, part);
    const double written = decibels(surface, NULL, 0.0, part);
    memset(part, 0, numbers_of(surface) * 2);
    for_numbers(surface, NULL, 0.0, part, put, NULL);
    input_name(one->name, input);
    convert(surface, part, input, globe, "e", whole);
    const double read = decibels(globe, one->margin > 0.0 ? surface : NULL, one->margin, whole);
    printf("%-52s %-30s %6.1f %6.1f\n", one->surface, one->name, written, read);
    REQUIRE(written > LEAST && read > LEAST, "%s, %s: %.1f dB written, %.1f read", one->surface,
            one->name, written, read);
    free(whole);
    free(part);
    cm_surface_destroy(globe);
    cm_surface_destroy(surface);
}

START_TEST(test_pictures_are_those_of_v360)
{
    ck_assert_ptr_nonnull(mkdtemp(folder));
    for (size_t i = 0; i < CASES; i++)
    {
        check_case(&cases[i]);
    }
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

int main(int argc, char **argv)
{
    const TTest *const tests[] = {test_pictures_are_those_of_v360, NULL};
    char command[TEXT];
    the_scene = scene_waves(0.4, 5);
    ffmpeg = argc > 1 ? argv[1] : ffmpeg;
    snprintf(command, sizeof command, "'%s' -version >/dev/null 2>&1", ffmpeg);
    if (system(command) != 0)
    {
        printf("there is no %s\n", ffmpeg);
        return 77;
    }
    return run_suite("v360", tests);
}
