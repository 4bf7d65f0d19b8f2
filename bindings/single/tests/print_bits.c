/* SPDX-License-Identifier: MIT
 *
 * Prints a hash of the bits that functions of every room give, one line a room and instruction set: compiled with the
 * library in one file, by WITH_SINGLE_FILE, and with the library itself, it prints the same.
 */
#ifdef WITH_SINGLE_FILE
#define CUBEMAP_IMPLEMENTATION
#include <cubemap_single.h>
#else
#include <cubemap/cubemap.h>
#endif

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
    POINTS = 1000
};

static uint64_t hash;

static void add(const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
    {
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    }
}

/* All NaN are one here: which of them comes, machines are free to choose. */
static void add_reals(const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        add(isnan(numbers[i]) ? "NaN" : (const void *)&numbers[i], isnan(numbers[i]) ? 3 : 8);
    }
}

/* The hash so far, which begins anew. */
static void say(const char *what, const char *of, const char *instructions)
{
    printf("%-8s %-12s %-8s %016" PRIx64 "\n", instructions, what, of, hash);
    hash = 14695981039346656037u;
}

/* By sums and products alone, which are the same with every C library. */
static void spread(double x[POINTS], double y[POINTS], double z[POINTS])
{
    for (int i = 0; i < POINTS; i++)
    {
        x[i] = 1e-3 * ((7 * i) % POINTS) - 0.4995;
        y[i] = 1e-3 * ((39 * i + 5) % POINTS) - 0.4995;
        z[i] = 1e-3 * ((271 * i + 3) % POINTS) - 0.4995;
    }
}

static void print_mapping(const cm_mapping_info *info, const cm_options *options)
{
    static double x[POINTS], y[POINTS], z[POINTS], u[POINTS], v[POINTS];
    static float xf[POINTS], yf[POINTS], zf[POINTS], uf[POINTS], vf[POINTS];
    static uint8_t face[POINTS];
    cm_mapping *mapping;
    if (cm_mapping_create_with(info->identifier, NULL, options, &mapping) != CM_OK)
    {
        return; /* what needs parts or parameters */
    }
    spread(x, y, z);
    for (int i = 0; i < POINTS; i++)
    {
        xf[i] = (float)x[i];
        yf[i] = (float)y[i];
        zf[i] = (float)z[i];
    }
    cm_forward_array(mapping, POINTS, x, y, z, face, u, v);
    cm_inverse_array(mapping, POINTS, face, u, v, x, y, z);
    cm_forward_array_f32(mapping, POINTS, xf, yf, zf, face, uf, vf);
    double jacobian[6], direction[3] = {0.3, -0.9, 0.2};
    cm_forward_jacobian(mapping, direction, jacobian);
    for (int i = 0; i < POINTS; i++)
    {
        z[i] = (double)uf[i];
    }
    add_reals(u, POINTS);
    add_reals(x, POINTS);
    add_reals(z, POINTS);
    add(face, sizeof face);
    add_reals(jacobian, 6);
    say("mapping", info->identifier, options->instructions);
    cm_mapping_destroy(mapping);
}

static int print_earth(const cm_options *options)
{
    cm_grid_options of = {.size = sizeof of, .mapping = "s2", .options = options};
    cm_cell_grid *cells;
    cm_grid *grid;
    cm_healpix *healpix;
    if (cm_grid_create(&of, &grid) != CM_OK ||
        cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) != CM_OK ||
        cm_healpix_create(1024, CM_HEALPIX_RING, options, &healpix) != CM_OK)
    {
        return 0;
    }
    static double x[POINTS], y[POINTS], z[POINTS];
    static cm_cell cell[POINTS];
    static int64_t pixel[POINTS];
    spread(x, y, z);
    cm_cell_forward_array(cells, 20, POINTS, x, y, z, cell);
    add(cell, sizeof cell);
    double area = cm_cell_area(cells, cell[7]);
    add(&area, sizeof area);
    say("cells", "s2", options->instructions);
    cm_healpix_pixel_from_direction_array(healpix, POINTS, x, y, z, pixel);
    add(pixel, sizeof pixel);
    for (int i = 0; i < POINTS; i++)
    {
        const double direction[3] = {x[i], y[i], z[i]};
        cm_healpix_pixel_from_direction(healpix, direction, &pixel[i]);
    }
    add(pixel, sizeof pixel);
    say("healpix", "1024", options->instructions);
    cm_statistics statistics = {.size = sizeof statistics};
    int good = cm_distortion_statistics(cm_grid_mapping(grid), CM_QUANTITY_AREA, NULL,
                                        &statistics) == CM_OK;
    add(&statistics.rmse, sizeof statistics.rmse);
    say("statistics", "s2", options->instructions);
    cm_healpix_destroy(healpix);
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
    return good;
}

int main(int argc, char **argv)
{
    hash = 14695981039346656037u;
    for (int i = 1; i < argc; i++)
    {
        cm_options options = {.size = sizeof options, .instructions = argv[i]};
        if (cm_instructions_check(argv[i], NULL, 0) != CM_OK || !print_earth(&options))
        {
            fprintf(stderr, "%s: not here\n", argv[i]);
            return 1;
        }
        for (size_t k = 0; k < cm_catalogue_count(); k++)
        {
            print_mapping(cm_catalogue_at(k), &options);
        }
    }
    return 0;
}
