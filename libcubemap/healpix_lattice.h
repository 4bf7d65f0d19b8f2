/* SPDX-License-Identifier: MIT
 *
 * The pixels of HEALPix, in the words of the dialect and of lanes/words.h, with a number of any kind in a lane
 * each: where a point is among the pixels' borders, rings, the two numberings, and all of those back. Read
 * once in a file, after the words of lanes/ in double; a room for vectors (batch_precision.h) and for single
 * pixels (healpix_neighbours.c).
 *
 * Borders run along two families of lines, ascending and descending towards greater longitudes. Numbers up to
 * 2^52 that are whole stand in the lanes of a CM_REAL, where they are exact; numbers of pixels, up to 12 2^58,
 * in words. Nothing depends on a conversion that C leaves undefined, whatever the lanes hold.
 */

#include "healpix_words.h"

/* A resolution's numbers, in every lane. */
typedef struct pixels_grid
{
    CM_REAL n;         /* nside */
    CM_REAL over_n;    /* 1 / nside: exact for powers of two */
    lanes_words last;  /* the last pixel */
    lanes_words cap;   /* how many pixels the north cap has: 2 nside (nside - 1) */
    lanes_words below; /* nside - 1 */
    unsigned shift;    /* nside is two to this if it is a power */
    int is_power;
} pixels_grid;

CM_FN pixels_grid pixels_grid_of(int64_t nside, unsigned shift, int is_power)
{
    pixels_grid g;
    uint64_t n = (uint64_t)nside;
    g.n = lanes_all((double)nside);
    g.over_n = lanes_all(1.0 / (double)nside);
    g.last = lanes_words_all(12 * n * n - 1);
    g.cap = lanes_words_all(2 * n * (n - 1));
    g.below = lanes_words_all(n - 1);
    g.shift = shift;
    g.is_power = is_power;
    return g;
}

/* Is it no pixel? */
CM_FN CM_BOOL pixels_is_none(pixels_grid g, lanes_words pixel)
{
    return pixels_is_negative(pixel | (g.last - pixel));
}

/* ---- A pixel, four ways ---- */

/* Between which borders it is. In a cap lines are counted from the border of the quarter of longitude, from 0
 * to nside - 1; on the belt from any multiple of nside, which quarter says: the line 0 crosses the equator at
 * half a quarter before it. */
typedef struct pixels_lattice
{
    CM_BOOL polar; /* in a cap */
    CM_BOOL south;
    CM_REAL quarter;    /* 0 to 3 */
    CM_REAL ascending;  /* whole numbers */
    CM_REAL descending; /* whole numbers */
} pixels_lattice;

/* Its ring, and its place there, from longitude 0 on. */
typedef struct pixels_row
{
    CM_BOOL polar;
    CM_BOOL south;   /* of the cap */
    CM_REAL ring;    /* 1 to 4 nside - 1 */
    CM_REAL quarter; /* pixels in a quarter of the ring */
    CM_REAL index;   /* 0 to 4 quarter - 1 */
} pixels_row;

/* The base pixel, 0 to 11, and the column and row in it, towards north-east and north-west. */
typedef struct pixels_square
{
    lanes_words base;
    lanes_words x;
    lanes_words y;
} pixels_square;

/* Where its centre is, or another point of it: quarter and ring may be of any points between rings; the longitude
 * is in eighths of a turn over quarter. */
typedef struct pixels_centre
{
    CM_BOOL polar;
    CM_BOOL south;
    CM_REAL ring;
    CM_REAL quarter;
    CM_REAL eighths; /* 0 to 8 quarter */
} pixels_centre;

/* From the coordinates of a point: the sector of longitude about an axis (kernel/healpix.h), half the place in
 * it, h in [-1/2, 1/2]; sigma, in a cap; (3 / 4) sin lat, on the belt. What rounding does at a corner is
 * undone: lines that cross nowhere in a base pixel are brought to the nearest that do. A point on a border
 * belongs where chealpix 3.30 counts it. */
CM_FN pixels_lattice pixels_lattice_of(pixels_grid g, CM_BOOL polar, CM_BOOL south, CM_REAL sector,
                                       CM_REAL h, CM_REAL sigma, CM_REAL belt)
{
    CM_REAL one = CM_LIT(1.0);
    CM_BOOL before = cm_less(h, CM_LIT(0.0));
    CM_REAL along = CM_SELECT(before, one + h, h);
    CM_REAL back = CM_SELECT(before, -h, one - h);
    CM_REAL middle = CM_LIT(0.5) + h;
    CM_REAL last = g.n - one;
    CM_REAL up = pixels_floor(g.n * CM_SELECT(polar, along * sigma, middle - belt));
    CM_REAL down = pixels_floor(g.n * CM_SELECT(polar, back * sigma, middle + belt));
    up = cm_min(up, CM_SELECT(polar, last, down + g.n));
    down = cm_min(down, CM_SELECT(polar, last - up, up + g.n));
    CM_REAL quarter = sector - CM_SELECT(cm_both(polar, before), one, CM_LIT(0.0));

    pixels_lattice at;
    at.polar = polar;
    at.south = south;
    at.quarter = quarter + CM_SELECT(cm_less(quarter, CM_LIT(0.0)), CM_LIT(4.0), CM_LIT(0.0));
    at.ascending = up;
    at.descending = down;
    return at;
}

/* On the belt, a ring that is a after the first one has the lines ascending - a / 2, rounded downwards, at its
 * first pixel, and all others from there. */
CM_FN pixels_row pixels_row_of_lattice(pixels_grid g, pixels_lattice at)
{
    CM_REAL zero = CM_LIT(0.0);
    CM_REAL four = CM_LIT(4.0);
    CM_REAL sum = at.ascending + at.descending + CM_LIT(1.0);
    CM_REAL after = g.n + (at.ascending - at.descending);
    pixels_row row;
    row.polar = at.polar;
    row.south = at.south;
    row.quarter = CM_SELECT(at.polar, sum, g.n);
    row.ring = CM_SELECT(at.polar, CM_SELECT(at.south, four * g.n - sum, sum), g.n + after);
    CM_REAL first = CM_SELECT(at.polar, zero, pixels_floor(CM_LIT(0.5) * after));
    CM_REAL index = cm_mad(at.quarter, row.quarter, at.ascending - first);
    CM_REAL count = four * row.quarter;
    row.index = index + CM_SELECT(cm_less(index, zero), count, zero) -
                CM_SELECT(cm_less(index, count), zero, count);
    return row;
}

CM_FN pixels_lattice pixels_lattice_of_row(pixels_grid g, pixels_row row)
{
    CM_REAL zero = CM_LIT(0.0);
    CM_REAL one = CM_LIT(1.0);
    CM_REAL twice = row.quarter + row.quarter;
    pixels_lattice at;
    at.quarter = CM_SELECT(cm_less(row.index, row.quarter), zero, one) +
                 CM_SELECT(cm_less(row.index, twice), zero, one) +
                 CM_SELECT(cm_less(row.index, twice + row.quarter), zero, one);
    CM_REAL cap = cm_mad(-at.quarter, row.quarter, row.index);
    CM_REAL after = row.ring - g.n;
    CM_REAL belt = cap + pixels_floor(CM_LIT(0.5) * after);
    at.polar = row.polar;
    at.south = row.south;
    at.ascending = CM_SELECT(row.polar, cap, belt);
    at.descending = CM_SELECT(row.polar, (row.quarter - one) - cap, (belt - after) + g.n);
    return at;
}

/* Every second ring of the belt has a centre at longitude 0, all others have it half a pixel further. */
CM_FN pixels_centre pixels_centre_of_row(pixels_grid g, pixels_row row)
{
    CM_REAL half = CM_LIT(0.5) * (row.ring - g.n);
    CM_REAL rest = CM_SELECT(row.polar, CM_LIT(0.0), half - pixels_floor(half));
    pixels_centre c;
    c.polar = row.polar;
    c.south = row.south;
    c.ring = row.ring;
    c.quarter = row.quarter;
    c.eighths = cm_mad(CM_LIT(2.0), row.index - rest, CM_LIT(1.0));
    return c;
}

CM_FN pixels_row pixels_row_of_centre(pixels_centre c)
{
    pixels_row row;
    row.polar = c.polar;
    row.south = c.south;
    row.ring = c.ring;
    row.quarter = c.quarter;
    row.index = pixels_floor(CM_LIT(0.5) * c.eighths);
    return row;
}

/* ---- RING ---- */

CM_FN lanes_words pixels_ring_of_row(pixels_grid g, pixels_row row)
{
    /* the pixels of the rings before: 2 i (i - 1) in the north, on the belt 4 nside each after those of the
     * cap, in the south all but 2 i (i + 1) */
    CM_REAL one = CM_LIT(1.0);
    CM_REAL a = CM_SELECT(row.polar, row.quarter + row.quarter, CM_LIT(4.0) * g.n);
    CM_REAL b = CM_SELECT(row.polar, row.quarter + CM_SELECT(row.south, one, -one), row.ring - g.n);
    lanes_words product = pixels_product(pixels_word_of(a), pixels_word_of(b));
    lanes_words north = product + lanes_words_select(row.polar, lanes_words_all(0), g.cap);
    lanes_words before = lanes_words_select(cm_both(row.polar, row.south),
                                            g.last + lanes_words_all(1) - product, north);
    return before + pixels_word_of(row.index);
}

/* pixel must be one. */
CM_FN pixels_row pixels_row_of_ring(pixels_grid g, lanes_words pixel)
{
    /* the southern half is the northern one, numbered backwards */
    CM_REAL one = CM_LIT(1.0);
    CM_REAL zero = CM_LIT(0.0);
    CM_REAL four_n = CM_LIT(4.0) * g.n;
    lanes_words mirrored = g.last - pixel;
    CM_BOOL south = pixels_is_negative(mirrored - pixel);
    lanes_words number = lanes_words_select(south, mirrored, pixel);
    CM_BOOL polar = pixels_is_negative(number - g.cap);
    lanes_words left = number - lanes_words_select(polar, lanes_words_all(0), g.cap);

    /* The ring, from 1 in a cap and from 0 on the belt: a little too small, by 2^-50, so that it is right or one
     * too small; what is left then says which. In a cap it is 1/2 + sqrt((2 u + 1) / 4). */
    CM_REAL u = pixels_near_word(left);
    CM_REAL less = CM_LIT(0.999999999999999111822);
    CM_REAL root =
        cm_sqrt(cm_mad(CM_LIT(0.499999999999999111822), u, CM_LIT(0.249999999999999555911)));
    CM_REAL near = CM_SELECT(polar, CM_LIT(0.499999999999999555911) + root,
                             u * (CM_LIT(0.25) * (less * g.over_n)));
    lanes_words whole = pixels_word_below(near);
    lanes_words none = lanes_words_all(0);
    lanes_words a = lanes_words_select(polar, whole + whole, pixels_word_of(four_n));
    lanes_words b = whole - lanes_words_select(polar, lanes_words_all(1), none);
    CM_REAL k = pixels_of_word(whole);
    CM_REAL index = pixels_of_word(left - pixels_product(a, b));
    CM_REAL count = CM_SELECT(polar, CM_LIT(4.0) * k, four_n);
    CM_BOOL here = cm_less(index, count);
    index = index - CM_SELECT(here, zero, count);
    k = k + CM_SELECT(here, zero, one);

    pixels_row row;
    row.polar = polar;
    row.south = south;
    row.quarter = CM_SELECT(polar, k, g.n);
    CM_REAL ring = k + CM_SELECT(polar, zero, g.n);
    row.ring = CM_SELECT(south, four_n - ring, ring);
    row.index = CM_SELECT(south, cm_mad(CM_LIT(4.0), row.quarter, -one) - index, index);
    return row;
}

/* ---- Base pixels and NESTED ---- */

/* How many base pixels a number of lines is, and the lines that are left. */
CM_FN lanes_words pixels_take_bases(pixels_grid g, CM_REAL lines, lanes_words *left)
{
    if (g.is_power)
    {
        lanes_words words = pixels_word_of(lines);
        *left = words & g.below;
        return words >> g.shift;
    }
    CM_REAL bases = pixels_floor(lines / g.n);
    *left = pixels_word_of(cm_mad(-bases, g.n, lines));
    return pixels_word_of(bases);
}

CM_FN pixels_square pixels_square_of_lattice(pixels_grid g, pixels_lattice at)
{
    /* in a cap, too, columns are those between descending and rows those between ascending lines, but that
     * rows are counted backwards */
    CM_REAL last = g.n - CM_LIT(1.0);
    CM_REAL down = CM_SELECT(at.polar, CM_SELECT(at.south, at.ascending, last - at.descending),
                             at.descending + g.n);
    CM_REAL up = CM_SELECT(at.polar, CM_SELECT(at.south, last - at.descending, at.ascending),
                           at.ascending + g.n);
    pixels_square square;
    lanes_words y;
    lanes_words base_x = pixels_take_bases(g, down, &square.x);
    lanes_words base_y = pixels_take_bases(g, up, &y);
    /* on the belt: as many of both, or one more of one kind */
    lanes_words more = base_x - base_y;
    lanes_words column = pixels_word_of(at.quarter);
    lanes_words belt =
        ((column + base_y - (more >> 63) + lanes_words_all(3)) & lanes_words_all(3)) +
        lanes_words_all(4) - (more << 2);
    lanes_words cap = column + lanes_words_select(at.south, lanes_words_all(8), lanes_words_all(0));
    square.base = lanes_words_select(at.polar, cap, belt);
    square.y = g.below - y;
    return square;
}

CM_FN lanes_words pixels_nested_of_square(pixels_grid g, pixels_square square)
{
    return square.base << (2 * g.shift) | pixels_interleave(square.x, square.y);
}

/* pixel must be one. */
CM_FN pixels_square pixels_square_of_nested(pixels_grid g, lanes_words pixel)
{
    pixels_square square;
    square.base = pixel >> (2 * g.shift);
    square.x = pixels_gather(pixel) & g.below;
    square.y = pixels_gather(pixel >> 1) & g.below;
    return square;
}

/* A point of a base pixel: x and y, whole or not, from the south corner, in [0, nside]. In a cap quarter is how
 * far it is from the pole, then, on the same scale. */
CM_FN pixels_centre pixels_centre_of_place(pixels_grid g, lanes_words base, CM_REAL x, CM_REAL y)
{
    lanes_words row = base >> 2;
    lanes_words column =
        ((base & lanes_words_all(3)) << 1) + ((row & lanes_words_all(1)) ^ lanes_words_all(1));
    CM_REAL four_n = CM_LIT(4.0) * g.n;
    CM_REAL ring = cm_mad(pixels_of_word(row) + CM_LIT(2.0), g.n, -(x + y));
    CM_REAL mirrored = four_n - ring;
    pixels_centre c;
    c.ring = ring;
    c.south = cm_less(mirrored, ring);
    CM_REAL from_pole = cm_min(ring, mirrored);
    c.polar = cm_less(from_pole, g.n);
    c.quarter = CM_SELECT(c.polar, from_pole, g.n);
    CM_REAL eighths = cm_mad(pixels_of_word(column), c.quarter, x - y);
    c.eighths =
        eighths + CM_SELECT(cm_less(eighths, CM_LIT(0.0)), CM_LIT(8.0) * c.quarter, CM_LIT(0.0));
    return c;
}

CM_FN pixels_centre pixels_centre_of_square(pixels_grid g, pixels_square square)
{
    CM_REAL half = CM_LIT(0.5);
    return pixels_centre_of_place(g, square.base, pixels_of_word(square.x) + half,
                                  pixels_of_word(square.y) + half);
}

/* ---- Centres on the sphere ---- */

/* The sine of the latitude, on the belt. */
CM_FN CM_REAL pixels_sine_on_belt(pixels_grid g, pixels_centre c)
{
    CM_REAL over = CM_LIT(0.666666666666666666667) * g.over_n;
    return (CM_LIT(2.0) * g.n - c.ring) * over;
}

/* The same as sigma of the mapping, in a cap: a whole number over nside, so that nothing is divided. */
CM_FN CM_REAL pixels_sigma(pixels_grid g, pixels_centre c)
{
    return c.quarter * g.over_n;
}

/* How high a centre is, and how far from the axis. */
typedef struct pixels_height
{
    CM_REAL z;
    CM_REAL rho;
} pixels_height;

CM_FN pixels_height pixels_height_of_centre(pixels_grid g, pixels_centre c)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL third = CM_LIT(0.333333333333333333333);
    CM_REAL belt = pixels_sine_on_belt(g, c);
    CM_REAL sigma = pixels_sigma(g, c);
    CM_REAL square = sigma * sigma;
    CM_REAL cap = one - third * square;
    CM_REAL root =
        CM_NAME(cm_root)(CM_SELECT(c.polar, CM_LIT(6.0) - square, (one - belt) * (one + belt)));
    pixels_height h;
    h.z = CM_SELECT(c.polar, CM_SELECT(c.south, -cap, cap), belt);
    h.rho = CM_SELECT(c.polar, third * sigma, one) * root;
    return h;
}

CM_FN CM_NAME(cm_xyz) pixels_direction_of_centre(pixels_grid g, pixels_centre c)
{
    /* the pole itself has no longitude */
    CM_REAL quarter = CM_SELECT(cm_less(CM_LIT(0.0), c.quarter), c.quarter, CM_LIT(1.0));
    CM_REAL half = CM_LIT(0.5);
    CM_REAL sector = pixels_nearest(half * pixels_quotient(c.eighths, quarter));
    CM_REAL half_sector = half * sector;
    CM_NAME(cm_healpix_spot) at; /* sectors 0 to 4 are about +x +y -x -y +x */
    at.x_wins = cm_equal(half_sector, pixels_floor(half_sector));
    at.polar = c.polar;
    at.south = c.south;
    at.sign =
        CM_SELECT(cm_less(cm_abs(sector - CM_LIT(2.5)), CM_LIT(1.0)), CM_LIT(-1.0), CM_LIT(1.0));
    at.f = pixels_quotient(cm_mad(CM_LIT(-2.0) * sector, quarter, c.eighths), quarter);
    pixels_height h = pixels_height_of_centre(g, c);
    at.sigma = pixels_sigma(g, c);
    return CM_NAME(cm_healpix_around)(at, h.rho, h.z);
}

typedef struct pixels_angles
{
    CM_REAL theta;
    CM_REAL latitude;
    CM_REAL phi; /* in [0, 2 pi) */
    CM_REAL lon; /* in [-pi, pi) */
} pixels_angles;

#define PIXELS_PI 3.14159265358979311600 /* the double, and what it lacks */
#define PIXELS_PI_REST 1.22464679914735317723e-16

/* The arc of a sine, for |x| <= 2 / 3: to where the belt goes, and caps by half angles. As the functions of
 * kernel/elementary.h, and by scripts/elementary/minimax.sollya, too. Worst error: 0.78 ulp. */
CM_FN CM_REAL pixels_arc_sine(CM_REAL x)
{
    CM_REAL z = x * x;
    CM_REAL t = z - CM_LIT(0.439453125);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(1.4505516320337558e-1), CM_LIT(2.1210329197664826e-1));
    CM_REAL b = cm_mad(t, CM_LIT(1.6185861308439914e-1), CM_LIT(1.4092400090723436e-1));
    CM_REAL c = cm_mad(t, CM_LIT(2.7579682295123431e-1), CM_LIT(2.0477916318052050e-1));
    CM_REAL d = cm_mad(t, CM_LIT(5.6341244788523592e-1), CM_LIT(3.8797457353008385e-1));
    CM_REAL e = cm_mad(t, CM_LIT(1.2592553393049462), CM_LIT(8.3720392428807844e-1));
    CM_REAL f = cm_mad(t, CM_LIT(2.6654325409503539), CM_LIT(1.8774131213216707));
    CM_REAL g = cm_mad(t, CM_LIT(3.5583433710332657), CM_LIT(3.3874474887470725));
    CM_REAL h = cm_mad(t, CM_LIT(1.4299662946181129), CM_LIT(2.7992705559642834));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, cm_mad(t2, CM_LIT(3.5012952143259818e-1), h), g);
    CM_REAL r = cm_mad(t4, cm_mad(t4, cm_mad(t4, g, e), c), a);
    return cm_mad(x, z * r, x);
}

/* From the pole, in a cap, twice the arc whose sine is sin(theta / 2) = sigma / sqrt 6; or from the equator. */
CM_FN pixels_angles pixels_angles_of_centre(pixels_grid g, pixels_centre c)
{
    CM_REAL over_root = CM_LIT(0.408248290463863016366); /* 1 / sqrt 6 */
    CM_REAL half = pixels_arc_sine(
        CM_SELECT(c.polar, over_root * pixels_sigma(g, c), pixels_sine_on_belt(g, c)));
    CM_REAL arc = CM_SELECT(c.polar, half + half, half);
    CM_REAL half_pi = CM_LIT(0.5 * PIXELS_PI);
    CM_REAL half_pi_rest = CM_LIT(0.5 * PIXELS_PI_REST);
    CM_REAL from_pole = (half_pi - arc) + half_pi_rest;
    pixels_angles a;
    a.theta = CM_SELECT(c.polar,
                        CM_SELECT(c.south, (CM_LIT(PIXELS_PI) - arc) + CM_LIT(PIXELS_PI_REST), arc),
                        from_pole);
    a.latitude = CM_SELECT(c.polar, CM_SELECT(c.south, -from_pole, from_pole), arc);
    CM_REAL turns = pixels_quotient(c.eighths, c.quarter);
    CM_REAL eighth = CM_LIT(0.25 * PIXELS_PI);
    a.phi = turns * eighth;
    a.lon = (turns - CM_SELECT(cm_at_least(turns, CM_LIT(4.0)), CM_LIT(8.0), CM_LIT(0.0))) * eighth;
    return a;
}

/* ---- Points ---- */

/* z is that of the direction. */
CM_FN pixels_lattice pixels_lattice_of_reach(pixels_grid g, CM_BOOL polar,
                                             CM_NAME(cm_healpix_reach) reach, CM_REAL z)
{
    CM_REAL half = CM_LIT(0.5);
    return pixels_lattice_of(g, polar, cm_less(z, CM_LIT(0.0)), reach.sector, half * reach.f,
                             reach.sigma, half * cm_copysign(reach.belt, z));
}

/* a b - product, where that is a b rounded; exact for factors of less than 2^900 */
CM_FN CM_REAL pixels_product_rest(CM_REAL a, CM_REAL b, CM_REAL product)
{
#ifdef CM_FUSED
    return cm_mad(a, b, -product);
#else
    CM_REAL wide_a = CM_LIT(134217729.0) * a; /* 2^27 + 1: Dekker's halves */
    CM_REAL wide_b = CM_LIT(134217729.0) * b;
    CM_REAL high_a = wide_a - (wide_a - a);
    CM_REAL high_b = wide_b - (wide_b - b);
    CM_REAL low_a = a - high_a;
    CM_REAL low_b = b - high_b;
    return low_a * low_b - (((product - high_a * high_b) - low_a * high_b) - high_a * low_b);
#endif
}

/* theta in [0, pi]; with latitudes it is the latitude. |phi| up to 2^50.
 *
 * Quarters of a turn in two doubles. Where they are a multiple of 2^-30, where pixels have borders, to within an
 * ulp and one turn, phi is what a program makes of that longitude, and counts as it; so does theta where it is
 * the nearest double to pi / 2, but at longitude 0, as with chealpix. In a cap sigma is sqrt 6 sin(theta / 2), and
 * where |sin lat| is below 2 / 3 the latitude is below pi / 4, so that one sine serves both. */
CM_FN pixels_lattice pixels_lattice_of_angles(pixels_grid g, int latitudes, CM_REAL theta,
                                              CM_REAL phi)
{
    CM_REAL zero = CM_LIT(0.0);
    CM_REAL half_pi = CM_LIT(0.5 * PIXELS_PI);
    CM_REAL half_pi_rest = CM_LIT(0.5 * PIXELS_PI_REST);
    CM_REAL latitude = theta;
    CM_REAL from_pole;
    CM_BOOL south;
    if (latitudes)
    {
        south = cm_less(latitude, zero);
        from_pole = (half_pi - cm_abs(latitude)) + half_pi_rest;
    }
    else
    {
        latitude = (half_pi - theta) + half_pi_rest;
        south = cm_less(latitude, zero);
        from_pole = CM_SELECT(south, (CM_LIT(PIXELS_PI) - theta) + CM_LIT(PIXELS_PI_REST), theta);
    }
    CM_BOOL polar = cm_less(CM_LIT(0.729727656226966337), cm_abs(latitude)); /* asin(2 / 3) */
    CM_REAL half = CM_LIT(0.5);
    CM_REAL sine = CM_NAME(cm_sin_quarter)(CM_SELECT(polar, half * from_pole, latitude));
    CM_REAL sigma = cm_min(CM_LIT(1.0), CM_LIT(2.44948974278317809820) * sine);
    CM_REAL belt = cm_max(cm_min(CM_LIT(0.75) * sine, half), -half);

    CM_REAL quarters = phi * CM_LIT(0.63661977236758138243);
    CM_REAL rest = cm_mad(phi, CM_LIT(-3.93573533503649721e-17),
                          pixels_product_rest(phi, CM_LIT(0.63661977236758138243), quarters));
    CM_REAL coarse = CM_LIT(6291456.0); /* 2^22 + 2^21 */
    CM_REAL name = (quarters + coarse) - coarse;
    CM_REAL from_name = cm_abs((quarters - name) + rest);
    CM_REAL size = cm_abs(quarters);
    CM_BOOL named =
        cm_both(cm_at_least(CM_LIT(1.75e-16) * size, from_name), cm_at_least(CM_LIT(4.0), size));
    CM_REAL sector = pixels_nearest(quarters);
    CM_REAL h = CM_SELECT(named, name - sector, (quarters - sector) + rest);
    sector = cm_mad(CM_LIT(-4.0), pixels_floor(CM_LIT(0.25) * sector), sector);
    if (!latitudes)
    {
        CM_BOOL equator = cm_equal(theta, half_pi);
        CM_BOOL origin = cm_equal(sector + cm_abs(h), zero);
        belt = CM_SELECT(equator, CM_SELECT(origin, belt, zero), belt);
    }
    return pixels_lattice_of(g, polar, south, sector, h, sigma, belt);
}
