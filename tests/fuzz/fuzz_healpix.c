/* SPDX-License-Identifier: MIT
 *
 * HEALPix pixels: any nside, any points and numbers; there and back, arrays equal to single points, neighbours
 * that are each other's, maps of other resolutions.
 */
#include "fuzz.h"

#include <cubemap/cubemap.h>

#include "truth/hard_points.h"

#include <math.h>

enum
{
    COUNT = 19, /* two vectors of the widest set and some more */
    MAP_SIDE = 8
};

static cm_healpix *take_healpix(supply *from)
{
    uint8_t kind = take_byte(from);
    int64_t nside = 0;
    char message[16];
    take_bytes(from, &nside, sizeof nside);
    nside = kind < 100   ? (int64_t)1 << (uint64_t)nside % 30
            : kind < 200 ? nside % 600000000
                         : nside;
    cm_healpix_order order = (cm_healpix_order)(take_byte(from) % 3);
    const cm_options options = {.size = sizeof options,
                                .instructions =
                                    cm_instructions_at(take_byte(from) % cm_instructions_count())};
    cm_healpix *healpix = NULL;
    cm_status status = cm_healpix_create(nside, order, &options, &healpix);
    EXPECT(status == cm_healpix_check(nside, order, message, sizeof message), "%d", (int)status);
    EXPECT((status == CM_OK) == (healpix != NULL), "%d", (int)status);
    EXPECT(status == CM_OK || is_one_line(message), "%s", message);
    if (healpix != NULL)
    {
        EXPECT(cm_healpix_nside(healpix) == nside && cm_healpix_order_of(healpix) == order &&
                   cm_healpix_pixel_count(healpix) == 12 * nside * nside &&
                   cm_healpix_ring_count(healpix) == 4 * nside - 1 &&
                   strcmp(cm_healpix_instructions(healpix), options.instructions) == 0,
               "%lld", (long long)nside);
    }
    return healpix;
}

static void take_direction_of_any_kind(supply *from, double d[3])
{
    uint8_t kind = take_byte(from) % 3;
    if (kind == 0)
    {
        hard_direction(take_word(from), d);
        return;
    }
    for (int k = 0; k < 3; k++)
    {
        d[k] = kind == 1 ? take_double(from) : take_fraction(from);
    }
}

static int is_pixel(const cm_healpix *healpix, int64_t pixel)
{
    return pixel >= 0 && pixel < cm_healpix_pixel_count(healpix);
}

/* Points of all kinds to pixels: those of the arrays are those of single points, and are pixels or none. */
static void check_points(const cm_healpix *healpix, supply *from)
{
    double column[3][COUNT];
    int64_t made[3][COUNT];
    for (size_t i = 0; i < COUNT; i++)
    {
        double d[3];
        take_direction_of_any_kind(from, d);
        for (int k = 0; k < 3; k++)
        {
            column[k][i] = d[k];
        }
    }
    cm_healpix_pixel_from_direction_array(healpix, COUNT, column[0], column[1], column[2], made[0]);
    cm_healpix_pixel_from_angles_array(healpix, COUNT, column[0], column[1], made[1]);
    cm_healpix_pixel_from_lonlat_array(healpix, COUNT, column[0], column[1], made[2]);
    for (size_t i = 0; i < COUNT; i++)
    {
        const double d[3] = {column[0][i], column[1][i], column[2][i]};
        int64_t one[3] = {-1, -1, -1};
        cm_status status[3] = {cm_healpix_pixel_from_direction(healpix, d, &one[0]),
                               cm_healpix_pixel_from_angles(healpix, d[0], d[1], &one[1]),
                               cm_healpix_pixel_from_lonlat(healpix, d[0], d[1], &one[2])};
        for (int k = 0; k < 3; k++)
        {
            EXPECT(made[k][i] == one[k] && (status[k] == CM_OK) == is_pixel(healpix, one[k]) &&
                       (status[k] == CM_OK || one[k] == CM_HEALPIX_NO_PIXEL),
                   "function %d at %a %a %a: %lld, alone %lld", k, d[0], d[1], d[2],
                   (long long)made[k][i], (long long)one[k]);
        }
    }
}

static int same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void check_one_pixel(const cm_healpix *healpix, int64_t pixel, const double array[7])
{
    double one[7] = {(double)NAN, (double)NAN, (double)NAN, (double)NAN,
                     (double)NAN, (double)NAN, (double)NAN};
    int64_t back = -1;
    cm_status expected = is_pixel(healpix, pixel) ? CM_OK : CM_ERROR_PIXEL;
    EXPECT(cm_healpix_direction_from_pixel(healpix, pixel, &one[0]) == expected &&
               cm_healpix_angles_from_pixel(healpix, pixel, &one[3], &one[4]) == expected &&
               cm_healpix_lonlat_from_pixel(healpix, pixel, &one[5]) == expected,
           "%lld", (long long)pixel);
    for (int k = 0; k < 7; k++)
    {
        EXPECT(same(array[k], one[k]), "number %d of %lld: %a, alone %a", k, (long long)pixel,
               array[k], one[k]);
    }
    if (expected == CM_OK)
    {
        EXPECT(cm_healpix_pixel_from_direction(healpix, &one[0], &back) == CM_OK && back == pixel,
               "%lld comes back as %lld", (long long)pixel, (long long)back);
        EXPECT(cm_healpix_pixel_from_angles(healpix, one[3], one[4], &back) == CM_OK &&
                   back == pixel,
               "%lld comes back from angles as %lld", (long long)pixel, (long long)back);
    }
}

static void check_around(const cm_healpix *healpix, int64_t pixel, supply *from)
{
    int64_t neighbour[8];
    int64_t ring;
    int64_t index;
    double x[16];
    double y[16];
    double z[16];
    cm_status expected = is_pixel(healpix, pixel) ? CM_OK : CM_ERROR_PIXEL;
    size_t steps = take_byte(from) % 6;
    EXPECT(cm_healpix_boundary(healpix, pixel, steps % 5, x, y, z) ==
               (steps % 5 == 0 ? CM_ERROR_ARGUMENT : expected),
           "%zu", steps);
    EXPECT(cm_healpix_neighbours(healpix, pixel, neighbour) == expected, "%lld", (long long)pixel);
    EXPECT(cm_healpix_ring_from_pixel(healpix, pixel, &ring, &index) == expected, "%lld",
           (long long)pixel);
    for (int i = 0; i < 8 && expected == CM_OK; i++)
    {
        int64_t back[8];
        int is_mutual = neighbour[i] == CM_HEALPIX_NO_PIXEL;
        (void)(is_mutual || cm_healpix_neighbours(healpix, neighbour[i], back) == CM_OK);
        for (int k = 0; k < 8 && !is_mutual; k++)
        {
            is_mutual = back[k] == pixel;
        }
        EXPECT(is_mutual, "%lld has the neighbour %lld", (long long)pixel, (long long)neighbour[i]);
    }
    if (expected == CM_OK)
    {
        cm_healpix_ring info = {.size = sizeof info};
        EXPECT(cm_healpix_ring_info(healpix, ring, &info) == CM_OK && index >= 0 &&
                   index < info.count,
               "%lld on ring %lld", (long long)pixel, (long long)ring);
        EXPECT(cm_healpix_order_of(healpix) == CM_HEALPIX_NESTED || info.first + index == pixel,
               "%lld on ring %lld", (long long)pixel, (long long)ring);
    }
}

static void check_numbers(const cm_healpix *healpix, const int64_t pixel[COUNT])
{
    int64_t nested[COUNT];
    int64_t ring[COUNT];
    int64_t nside = cm_healpix_nside(healpix);
    cm_status expected = (nside & (nside - 1)) == 0 ? CM_OK : CM_ERROR_PIXEL;
    EXPECT(cm_healpix_nested_from_ring_array(healpix, COUNT, pixel, nested) == expected, "nested");
    EXPECT(cm_healpix_ring_from_nested_array(healpix, COUNT, pixel, ring) == expected, "ring");
    for (size_t i = 0; i < COUNT && expected == CM_OK; i++)
    {
        int64_t one[2] = {-1, -1};
        int64_t back[2] = {-1, -1};
        int is_one = is_pixel(healpix, pixel[i]);
        EXPECT((cm_healpix_nested_from_ring(healpix, pixel[i], &one[0]) == CM_OK) == is_one &&
                   (cm_healpix_ring_from_nested(healpix, pixel[i], &one[1]) == CM_OK) == is_one &&
                   one[0] == nested[i] && one[1] == ring[i],
               "%lld", (long long)pixel[i]);
        EXPECT(!is_one || (cm_healpix_ring_from_nested(healpix, one[0], &back[0]) == CM_OK &&
                           cm_healpix_nested_from_ring(healpix, one[1], &back[1]) == CM_OK &&
                           back[0] == pixel[i] && back[1] == pixel[i]),
               "%lld", (long long)pixel[i]);
    }
}

static void check_pixels(const cm_healpix *healpix, supply *from)
{
    double column[7][COUNT];
    int64_t pixel[COUNT];
    uint64_t count = (uint64_t)cm_healpix_pixel_count(healpix);
    for (size_t i = 0; i < COUNT; i++)
    {
        uint64_t number;
        uint8_t kind = take_byte(from) % 4;
        take_bytes(from, &number, sizeof number);
        pixel[i] = (int64_t)(kind == 0   ? number
                             : kind == 1 ? count - 1 - number % 200
                             : kind == 2 ? number % 200
                                         : number % count);
    }
    cm_healpix_direction_from_pixel_array(healpix, COUNT, pixel, column[0], column[1], column[2]);
    cm_healpix_angles_from_pixel_array(healpix, COUNT, pixel, column[3], column[4]);
    cm_healpix_lonlat_from_pixel_array(healpix, COUNT, pixel, column[5], column[6]);
    for (size_t i = 0; i < COUNT; i++)
    {
        double array[7];
        for (int k = 0; k < 7; k++)
        {
            array[k] = column[k][i];
        }
        check_one_pixel(healpix, pixel[i], array);
    }
    check_around(healpix, pixel[0], from);
    check_numbers(healpix, pixel);
}

/* A map with any numbers, to any small resolution. */
static void check_map(supply *from)
{
    static double map[12 * MAP_SIDE * MAP_SIDE];
    static double result[12 * MAP_SIDE * MAP_SIDE];
    static float narrow[12 * MAP_SIDE * MAP_SIDE];
    static float narrow_result[12 * MAP_SIDE * MAP_SIDE];
    cm_healpix *side[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++)
    {
        int64_t nside = 1 + take_byte(from) % MAP_SIDE;
        (void)cm_healpix_create(nside, (cm_healpix_order)(take_byte(from) % 2), NULL, &side[k]);
    }
    const cm_healpix_regrade_options options = {.size = sizeof options,
                                                .is_pessimistic = take_byte(from) % 2,
                                                .bad_is_nan = take_byte(from) % 2,
                                                .power = take_fraction(from) * 4.0};
    for (int i = 0; i < 12 * MAP_SIDE * MAP_SIDE; i++)
    {
        map[i] = from->left > 0 ? take_double(from) : 1.0;
        narrow[i] = fabs(map[i]) < 1e38 ? (float)map[i] : 1.0f;
    }
    if (side[0] != NULL && side[1] != NULL)
    {
        cm_status status = cm_healpix_regrade(side[0], map, side[1], result, &options);
        EXPECT(status == CM_OK || status == CM_ERROR_PIXEL, "%d", (int)status);
        EXPECT(cm_healpix_regrade_f32(side[0], narrow, side[1], narrow_result, &options) == status,
               "%d", (int)status);
    }
    cm_healpix_destroy(side[0]);
    cm_healpix_destroy(side[1]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_healpix *healpix = take_healpix(&from);
    if (healpix != NULL)
    {
        check_points(healpix, &from);
        check_pixels(healpix, &from);
        cm_healpix_destroy(healpix);
    }
    check_map(&from);
    return 0;
}
