/* SPDX-License-Identifier: MIT
 *
 * Memory that cannot be had. Linked with --wrap against the static library, so that the test decides what
 * malloc, calloc and realloc give: each function that allocates is called without any memory, then with enough
 * for one block, for two, and so on until it ends well; those that want many, with the first and the last numbers
 * of blocks, and with all blocks but those of one size, for each. Every time it says CM_ERROR_MEMORY,
 * touches nothing that it was to give out, and gives all blocks back.
 *
 * usage: test-memory [NAME]
 *   NAME  what is not to be called, by its name among the calls at the end
 */
#include <cubemap/cubemap.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

static long left = -1; /* blocks that may still be had; below 0: any number */
static long had;       /* all that were had */
static long live;      /* those that were not given back */
static size_t refused; /* no blocks of this size, unless it is 0 */
static long tolerated; /* but so many */

/* The sizes that were asked for, and how often. */
enum
{
    SIZES_MAX = 256
};

static size_t seen[SIZES_MAX];
static long asked[SIZES_MAX];
static size_t seen_count;

static void note(size_t size)
{
    size_t i = 0;
    while (i < seen_count && seen[i] != size)
    {
        i++;
    }
    if (i < SIZES_MAX)
    {
        seen[i] = size;
        asked[i]++;
        seen_count += i == seen_count;
    }
}

static int may_have(size_t size)
{
    note(size);
    if (left == 0 || (size == refused && size > 0 && tolerated-- <= 0))
    {
        return 0;
    }
    left -= left > 0;
    had++;
    return 1;
}

void *__wrap_malloc(size_t size)
{
    void *block = may_have(size) ? __real_malloc(size) : NULL;
    live += block != NULL;
    return block;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *block = may_have(count * size) ? __real_calloc(count, size) : NULL;
    live += block != NULL;
    return block;
}

void *__wrap_realloc(void *block, size_t size)
{
    void *grown = may_have(size) ? __real_realloc(block, size) : NULL;
    live += grown != NULL && block == NULL;
    return grown;
}

void __wrap_free(void *block)
{
    live -= block != NULL;
    __real_free(block);
}

/* ---- What is called ---- */

static cm_mapping *mapping;
static cm_grid *grid;
static cm_cell_grid *cells;
static cm_region *region;

/* What a function gave out, as bytes, before and after. */
typedef union given
{
    void *made;
    double number[4];
    cm_orient_result oriented;
    cm_advice_terms terms;
    struct
    {
        size_t count;
        cm_cell cell[4096];
    } cover;
} given;

static const cm_ellipsoid *earth(void)
{
    return cm_ellipsoid_find("WGS84");
}

static cm_status make_mapping(given *to)
{
    cm_mapping *made = to->made;
    const cm_status status = cm_mapping_create("coupled", NULL, &made);
    to->made = made;
    return status;
}

static void drop_mapping(given *to)
{
    cm_mapping_destroy(to->made);
}

static cm_status find_percentiles(given *to)
{
    const double percent = 50.0;
    return cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 1, &percent, &to->number[0],
                                     &to->number[1]);
}

static cm_status make_conversion(given *to)
{
    cm_latitude_conversion *made = to->made;
    const cm_status status = cm_latitude_conversion_create(earth(), CM_LATITUDE_GEOGRAPHIC,
                                                           CM_LATITUDE_AUTHALIC, NULL, &made);
    to->made = made;
    return status;
}

static void drop_conversion(given *to)
{
    cm_latitude_conversion_destroy(to->made);
}

static cm_status make_grid(given *to)
{
    const cm_latitude latitude = CM_LATITUDE_AUTHALIC;
    const cm_ellipsoid *ellipsoid = earth();
    const cm_grid_options options = {
        .size = sizeof options, .ellipsoid = ellipsoid, .latitude = &latitude};
    cm_grid *made = to->made;
    const cm_status status = cm_grid_create(&options, &made);
    to->made = made;
    return status;
}

static void drop_grid(given *to)
{
    cm_grid_destroy(to->made);
}

static cm_status make_cells(given *to)
{
    cm_cell_grid *made = to->made;
    const cm_status status = cm_cell_grid_create(grid, CM_CURVE_HILBERT, &made);
    to->made = made;
    return status;
}

static void drop_cells(given *to)
{
    cm_cell_grid_destroy(to->made);
}

static cm_status make_cap(given *to)
{
    cm_region *made = to->made;
    const cm_status status = cm_region_cap_lonlat(0.1, 0.7, 0.3, &made);
    to->made = made;
    return status;
}

static cm_status make_polygon(given *to)
{
    static const double lonlat[] = {0.0, 0.0, 0.5, 0.0, 0.5, 0.5, 0.0, 0.5};
    static const size_t length = 4;
    cm_region *made = to->made;
    const cm_status status = cm_region_polygon(1, &length, lonlat, &made);
    to->made = made;
    return status;
}

static void drop_region(given *to)
{
    cm_region_destroy(to->made);
}

static cm_status cover(given *to, cm_cover_kind kind, size_t most, int level)
{
    const cm_cover_options options = {.size = sizeof options,
                                      .kind = kind,
                                      .level_min = 0,
                                      .level_max = level,
                                      .cells_most = most};
    return cm_cover(cells, region, &options, sizeof to->cover.cell / sizeof *to->cover.cell,
                    to->cover.cell, &to->cover.count);
}

static cm_status cover_all(given *to)
{
    return cover(to, CM_COVER_OUTER, 0, 8);
}

static cm_status cover_by_some(given *to)
{
    return cover(to, CM_COVER_OUTER, 500, 9);
}

static cm_status cover_inside(given *to)
{
    return cover(to, CM_COVER_INNER, 500, 9);
}

static cm_status make_healpix(given *to)
{
    cm_healpix *made = to->made;
    const cm_status status = cm_healpix_create(16, CM_HEALPIX_NESTED, NULL, &made);
    to->made = made;
    return status;
}

static void drop_healpix(given *to)
{
    cm_healpix_destroy(to->made);
}

static cm_status make_advice(given *to)
{
    static const cm_advice_cost rows[] = {{"gnomonic", CM_PRECISION_DOUBLE, {1.0, 1.0}, {1.0, 1.0}},
                                          {"gnomonic", CM_PRECISION_FAST, {1.0, 1.0}, {1.0, 1.0}}};
    const cm_advice_costs costs = {.size = sizeof costs, .count = 2, .cost = rows};
    const cm_advice_request request = {.size = sizeof request, .ellipsoid = earth()};
    cm_advice *made = to->made;
    const cm_status status = cm_advise(&request, &costs, &made);
    to->made = made;
    return status;
}

static void drop_advice(given *to)
{
    cm_advice_destroy(to->made);
}

static cm_status find_terms(given *to)
{
    cm_advice_terms made = {.size = sizeof made};
    const cm_status status =
        cm_advise_terms(earth(), CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 1.0, &made);
    if (status == CM_OK)
    {
        to->terms = made;
    }
    return status;
}

/* So many pixels count that their sums need more room than those of their clusters. */
static float values[180][360];
static const cm_mask mask = {sizeof mask, 360, 180, &values[0][0]};

static void fill_mask(void)
{
    for (int row = 50; row < 70; row++)
    {
        for (int column = 150; column < 190; column++)
        {
            values[row][column] = (float)(1 + column % 3);
        }
    }
}

/* As soon as the second level of boxes has begun, which are the last two fifths. */
static int stop(double done, void *user)
{
    (void)user;
    return done > 0.69;
}

static cm_status orient_for(given *to, const cm_mask *on, const char *of, cm_orient_measure measure,
                            cm_measure over, size_t boxes_max)
{
    cm_mapping *subject = NULL;
    const long kept = left;
    left = -1;
    const cm_status made = cm_mapping_create(of, NULL, &subject);
    left = kept;
    had = 0;
    const cm_orient_options options = {.size = sizeof options,
                                       .measure = measure,
                                       .over = over,
                                       .resolution = 10.0,
                                       .threads = 1,
                                       .boxes_max = boxes_max,
                                       .progress = boxes_max > 1 ? stop : NULL};
    to->oriented.size = sizeof to->oriented;
    const cm_status status = made == CM_OK ? cm_orient(subject, on, &options, &to->oriented) : made;
    cm_mapping_destroy(subject);
    return status;
}

static cm_status orient(given *to, const char *of, cm_orient_measure measure, cm_measure over,
                        size_t boxes_max)
{
    return orient_for(to, &mask, of, measure, over, boxes_max);
}

/* No rotation has no edge over this mask, so that all about the best ones is looked at. */
static cm_status orient_by_edges(given *to)
{
    static const float everywhere[8] = {1.0f, 2.0f, 1.0f, 3.0f, 1.0f, 2.0f, 1.0f, 1.0f};
    const cm_mask whole = {sizeof whole, 4, 2, everywhere};
    return orient_for(to, &whole, "coupled", CM_ORIENT_EDGES, CM_OVER_SPHERE, 1);
}

static cm_status orient_by_deformation(given *to)
{
    return orient(to, "coupled", CM_ORIENT_DEFORMATION, CM_OVER_SPHERE, 1);
}

static cm_status orient_by_levels(given *to)
{
    return orient(to, "coupled", CM_ORIENT_DEFORMATION, CM_OVER_SPHERE, 11000);
}

static cm_status orient_over_faces(given *to)
{
    return orient(to, "coupled", CM_ORIENT_DEFORMATION, CM_OVER_FACE, 1);
}

static cm_status orient_without_need(given *to)
{
    return orient(to, "conformal", CM_ORIENT_DEFORMATION, CM_OVER_SPHERE, 1);
}

static cm_status value_orientation(given *to, cm_orient_measure measure)
{
    const cm_orient_options options = {
        .size = sizeof options, .measure = measure, .over = CM_OVER_SPHERE, .threads = 1};
    const cm_rotation none = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    return cm_orient_value(mapping, &mask, &options, &none, &to->number[0]);
}

static cm_status value_deformation(given *to)
{
    return value_orientation(to, CM_ORIENT_DEFORMATION);
}

static cm_status value_edges(given *to)
{
    return value_orientation(to, CM_ORIENT_EDGES);
}

/* ---- Whether it says so ---- */

static int wrong;

static void complain(const char *name, long blocks, const char *what, cm_status status)
{
    printf("%s with memory for %ld blocks: %s (status %d)\n", name, blocks, what, (int)status);
    wrong = 1;
}

static cm_status call(const char *name, cm_status (*function)(given *), void (*drop)(given *),
                      long blocks)
{
    static given before, after;
    memset(&before, 0, sizeof before);
    before.oriented.size = drop == NULL ? sizeof before.oriented : 0;
    after = before;
    const long alive = live;
    had = 0;
    left = blocks;
    const cm_status status = function(&after);
    left = -1;
    if (status == CM_OK && drop != NULL)
    {
        drop(&after);
    }
    else if (status != CM_OK && memcmp(&before, &after, sizeof before) != 0)
    {
        complain(name, blocks, "something was touched", status);
    }
    if (live != alive)
    {
        complain(name, blocks, "blocks were not given back", status);
    }
    return status;
}

/* What is called. Of what wants more than a few blocks some are refused, and so many of the last. */
typedef struct subject
{
    const char *name;
    cm_status (*function)(given *);
    void (*drop)(given *);
    long last;
    int is_again;        /* is what others wanted refused once more, after the first? */
    cm_status otherwise; /* what it ends with if all is there */
} subject;

static void starve_of_blocks(const subject *of, long from, long to)
{
    for (long blocks = from; blocks < to; blocks++)
    {
        const cm_status status = call(of->name, of->function, of->drop, blocks);
        if (status != CM_ERROR_MEMORY)
        {
            complain(of->name, blocks, "no complaint", status);
        }
    }
}

/* Without the blocks of one size, after so many of them. */
static void starve_of_size(const subject *of, size_t size, long but)
{
    refused = size;
    tolerated = but;
    const cm_status status = call(of->name, of->function, of->drop, -1);
    refused = 0;
    if (status != CM_ERROR_MEMORY)
    {
        printf("blocks of %zu bytes, but %ld: ", size, but);
        complain(of->name, -1, "no complaint", status);
    }
}

enum
{
    FEW = 20, /* blocks */
    SMALL = 1000,
    MANY = 9 /* of small blocks, those of the first measurements */
};

/* Without each size that no other wanted, then after the first block of it if that is large, after some if it is small; with few blocks;
 * and without one in the midst of the steps downhill, and the last, those of the result. What wants few blocks in all has each
 * one refused in turn, which is all of that. */
static void starve_some(const subject *of, long all, size_t known, const long uses[SIZES_MAX])
{
    if (all <= FEW)
    {
        starve_of_blocks(of, 0, all);
        return;
    }
    for (size_t i = 0; i < SIZES_MAX; i++)
    {
        const long but = seen[i] < SMALL ? MANY : 1;
        if (uses[i] > 0 && i >= known)
        {
            starve_of_size(of, seen[i], 0);
        }
        if (uses[i] > but && (i >= known || of->is_again))
        {
            starve_of_size(of, seen[i], but);
        }
    }
    starve_of_blocks(of, 0, FEW);
    starve_of_blocks(of, all / 2, all / 2 + 1);
    starve_of_blocks(of, all - of->last, all);
}

static void starve(const subject *of)
{
    long uses[SIZES_MAX];
    const size_t known = seen_count; /* those have been refused */
    memset(asked, 0, sizeof asked);
    const cm_status status = call(of->name, of->function, of->drop, -1);
    const long all = had;
    memcpy(uses, asked, sizeof uses);
    if (status != of->otherwise || all == 0)
    {
        complain(of->name, -1, "with all memory it should do, by some", status);
    }
    if (of->last > 0)
    {
        starve_some(of, all, known, uses);
    }
    else
    {
        starve_of_blocks(of, 0, all);
        if (call(of->name, of->function, of->drop, all) != CM_OK)
        {
            complain(of->name, all, "that is enough", CM_OK);
        }
    }
    printf("%s: %ld blocks\n", of->name, all);
}

int main(int argc, char **argv)
{
    given to = {.made = NULL};
    fill_mask();
    if (cm_mapping_create("coupled", NULL, &mapping) != CM_OK || make_grid(&to) != CM_OK)
    {
        return 1;
    }
    grid = to.made;
    if (cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) != CM_OK ||
        cm_region_cap_lonlat(0.1, 0.7, 0.3, &region) != CM_OK)
    {
        return 1;
    }
    static const subject calls[] = {
        {"an orientation", orient_by_deformation, NULL, 8, 0, CM_OK},
        {"an orientation by edges", orient_by_edges, NULL, 1, 0, CM_OK},
        {"an orientation over faces", orient_over_faces, NULL, 1, 0, CM_OK},
        {"an orientation of two levels", orient_by_levels, NULL, 1, 1, CM_ERROR_STOPPED},
        {"a mapping", make_mapping, drop_mapping, 0, 0, CM_OK},
        {"percentiles", find_percentiles, NULL, 0, 0, CM_OK},
        {"a conversion of latitudes", make_conversion, drop_conversion, 0, 0, CM_OK},
        {"a grid", make_grid, drop_grid, 0, 0, CM_OK},
        {"a grid of cells", make_cells, drop_cells, 0, 0, CM_OK},
        {"a cap", make_cap, drop_region, 0, 0, CM_OK},
        {"a polygon", make_polygon, drop_region, 0, 0, CM_OK},
        {"a covering", cover_all, NULL, 0, 0, CM_OK},
        {"a covering of some cells", cover_by_some, NULL, 0, 0, CM_OK},
        {"cells inside", cover_inside, NULL, 0, 0, CM_OK},
        {"HEALPix", make_healpix, drop_healpix, 0, 0, CM_OK},
        {"an advice", make_advice, drop_advice, 0, 0, CM_OK},
        {"terms of a latitude", find_terms, NULL, 0, 0, CM_OK},
        {"deformation in an orientation", value_deformation, NULL, 0, 0, CM_OK},
        {"edges in an orientation", value_edges, NULL, 0, 0, CM_OK},
        {"no orientation", orient_without_need, NULL, 0, 0, CM_OK}};
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++)
    {
        if (argc < 2 || strcmp(argv[1], calls[i].name) != 0)
        {
            starve(&calls[i]);
        }
    }
    cm_region_destroy(region);
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
    cm_mapping_destroy(mapping);
    return wrong;
}
