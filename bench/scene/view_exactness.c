/* SPDX-License-Identifier: MIT
 *
 * How exact depth images are, and what is drawn: the worst of a picture of 640 x 480 in the machine's best instruction set,
 * beside the same in double, a line each, tab-separated: what, the error, and its unit.
 *
 *   view-exactness
 */
#include "bench/harness/harness.h"

#include <cubemap/depth.h>
#include <cubemap/raster.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT
};

static double column[PIXELS], row[PIXELS], ray[3][PIXELS], place[3][PIXELS], again[2][PIXELS];
static float image[PIXELS], smooth[PIXELS], vertex[3][PIXELS], normal[3][PIXELS];

static double fraction(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) * 0x1p-24;
}

static void raise(double *worst, double error)
{
    *worst = error > *worst ? error : *worst;
}

static void report(const char *what, double error, const char *unit)
{
    printf("%s\t%.1e\t%s\n", what, error, unit);
}

static void must(cm_status status)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "view-exactness: %s\n", cm_status_text(status));
        exit(EXIT_FAILURE);
    }
}

/* An inclined plane: the third of its normal's coordinates looks away from the camera. */
static const double plane[3] = {0.36, -0.48, 0.8};

static double plane_at(size_t i)
{
    return 1.6 / (plane[0] * ray[0][i] + plane[1] * ray[1][i] + plane[2] * ray[2][i]);
}

static void maps_of_plane(const cm_rays *rays)
{
    const cm_depth_maps maps = {.size = sizeof maps,
                                .vertex = {vertex[0], vertex[1], vertex[2]},
                                .normal = {normal[0], normal[1], normal[2]}};
    double off = 0.0;
    double turn = 0.0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double depth = plane_at(i);
        image[i] = depth > 0.0 && depth < 5.0 ? (float)depth : NAN;
    }
    must(cm_depth_make_maps(rays, image, 1, &maps));
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double depth = (double)image[i];
        double cosine = 0.0;
        double length = 0.0;
        for (int k = 0; k < 3; k++)
        {
            cosine -= (double)normal[k][i] * plane[k];
            length += fabs(depth * ray[k][i]);
        }
        for (int k = 0; k < 3; k++)
        {
            raise(&off, fabs((double)vertex[k][i] - depth * ray[k][i]) / length);
        }
        raise(&turn, 1.0 - cosine);
    }
    report("vertices", off, "of their size");
    report("normals of a plane", turn, "of the cosine");
}

static double smooth_plainly(size_t at, double pixels, double metres)
{
    const int column_at = (int)(at % WIDTH);
    const int row_at = (int)(at / WIDTH);
    double sum = 0.0;
    double weight = 0.0;
    for (int j = row_at - 3; j <= row_at + 3; j++)
    {
        for (int i = column_at - 3; i <= column_at + 3; i++)
        {
            if (i >= 0 && j >= 0 && i < WIDTH && j < HEIGHT)
            {
                const double d = (double)image[j * WIDTH + i] - (double)image[at];
                const double away =
                    (double)((i - column_at) * (i - column_at) + (j - row_at) * (j - row_at));
                const double w =
                    exp(-away / (2.0 * pixels * pixels) - d * d / (2.0 * metres * metres));
                sum += w * d;
                weight += w;
            }
        }
    }
    return (double)image[at] + sum / weight;
}

static void filter(const cm_rays *rays)
{
    double off = 0.0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        image[i] = (float)((i % WIDTH > WIDTH / 2 ? 2.7 : 2.0) + 0.02 * fraction());
    }
    must(cm_depth_smooth(rays, image, 1.5, 0.02, 1, smooth));
    for (size_t i = 0; i < PIXELS; i++)
    {
        raise(&off, fabs((double)smooth[i] - smooth_plainly(i, 1.5, 0.02)));
    }
    report("bilateral filter, at 2 to 2.7 m", off, "m");
}

static void pyramid_of_image(void)
{
    cm_depth_pyramid *pyramid = NULL;
    size_t wrong = 0;
    must(cm_depth_pyramid_create(WIDTH, HEIGHT, NULL, &pyramid));
    must(cm_depth_pyramid_fill(pyramid, image, 1));
    for (uint32_t level = 1; level <= cm_depth_pyramid_last(pyramid); level++)
    {
        cm_depth_level cells = {.size = sizeof cells};
        must(cm_depth_pyramid_level(pyramid, level, &cells));
        for (size_t cell = 0; cell < (size_t)cells.width * cells.height; cell++)
        {
            float least = INFINITY;
            float most = 0.0f;
            const size_t first_row = cell / cells.width << level;
            const size_t first_column = cell % cells.width << level;
            for (size_t j = first_row; j < first_row + (1u << level) && j < HEIGHT; j++)
            {
                for (size_t i = first_column; i < first_column + (1u << level) && i < WIDTH; i++)
                {
                    least = fminf(least, image[j * WIDTH + i]);
                    most = fmaxf(most, image[j * WIDTH + i]);
                }
            }
            wrong += cells.least[cell] != least || cells.most[cell] != most;
        }
    }
    cm_depth_pyramid_destroy(pyramid);
    report("min/max pyramid, cells that are not exact", (double)wrong, "");
}

/* Two triangles of the inclined plane that cover the picture, and discs of it at all pixels, 3 pixels across. */
static void draw_plane(const cm_camera *camera)
{
    static const double corner[4][2] = {{-0.7, -0.6}, {0.7, -0.6}, {-0.7, 0.6}, {0.7, 0.6}};
    static const uint32_t index[6] = {0, 1, 2, 2, 1, 3};
    static float disc[7][PIXELS];
    double position[4][3];
    double off[2] = {0.0, 0.0};
    cm_raster *raster = NULL;
    for (size_t i = 0; i < 4; i++)
    {
        const double depth = 1.6 / (plane[0] * corner[i][0] + plane[1] * corner[i][1] + plane[2]);
        position[i][0] = depth * corner[i][0];
        position[i][1] = depth * corner[i][1];
        position[i][2] = depth;
    }
    for (size_t i = 0; i < PIXELS; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            disc[k][i] = (float)(plane_at(i) * ray[k][i]);
            disc[3 + k][i] = (float)plane[k];
        }
        disc[6][i] = (float)(1.5 * plane_at(i) / 525.0);
    }
    const cm_triangles triangles = {.size = sizeof triangles,
                                    .vertex_count = 4,
                                    .position = position[0],
                                    .triangle_count = 2,
                                    .index = index};
    const cm_discs discs = {.size = sizeof discs,
                            .count = PIXELS,
                            .centre = {disc[0], disc[1], disc[2]},
                            .normal = {disc[3], disc[4], disc[5]},
                            .radius = disc[6]};
    must(cm_raster_create(camera, 0.0, NULL, &raster));
    for (int kind = 0; kind < 2; kind++)
    {
        cm_raster_clear(raster);
        must(kind == 0 ? cm_raster_triangles(raster, NULL, &triangles, 1)
                       : cm_raster_discs(raster, NULL, &discs, 1));
        must(cm_raster_read(raster, image, NULL));
        for (size_t i = 0; i < PIXELS; i++)
        {
            raise(&off[kind], fabs((double)image[i] - plane_at(i)) / plane_at(i));
        }
    }
    cm_raster_destroy(raster);
    report("drawn depth of triangles", off[0], "of the depth");
    report("drawn depth of discs", off[1], "of the depth");
}

/* Pixels that have rays come back. */
static void lenses(void)
{
    double off = 0.0;
    for (int lens = 0; lens < 20; lens++)
    {
        cm_camera *camera = NULL;
        cm_camera_options options = {.size = sizeof options,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = 525.0,
                                     .fy = 525.0,
                                     .cx = 319.5,
                                     .cy = 239.5};
        for (int k = 0; k < 14; k++)
        {
            const double size = k < 2 || (k > 3 && k < 8) ? 0.3 : 0.02;
            options.distortion[k] = size * (2.0 * fraction() - 1.0);
        }
        must(cm_camera_create(&options, &camera));
        cm_camera_ray_array(camera, PIXELS, column, row, place[0], place[1], place[2]);
        cm_camera_project_array(camera, PIXELS, place[0], place[1], place[2], again[0], again[1]);
        for (size_t i = 0; i < PIXELS; i++)
        {
            raise(&off, fabs(again[0][i] - column[i]));
            raise(&off, fabs(again[1][i] - row[i]));
        }
        cm_camera_destroy(camera);
    }
    report("pixel to ray to pixel, 20 random lenses", off, "pixels");
}

int main(void)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 525.0,
                                       .fy = 525.0,
                                       .cx = 319.5,
                                       .cy = 239.5};
    cm_camera *camera = NULL;
    cm_rays *rays = NULL;
    name_program("view-exactness");
    for (size_t i = 0; i < PIXELS; i++)
    {
        column[i] = (double)(i % WIDTH);
        row[i] = (double)(i / WIDTH);
        ray[0][i] = (column[i] - options.cx) / options.fx;
        ray[1][i] = (row[i] - options.cy) / options.fy;
        ray[2][i] = 1.0;
    }
    must(cm_camera_create(&options, &camera));
    must(cm_rays_create(camera, NULL, &rays));
    maps_of_plane(rays);
    filter(rays);
    pyramid_of_image();
    draw_plane(camera);
    lenses();
    cm_rays_destroy(rays);
    cm_camera_destroy(camera);
    return close_standard_output();
}
