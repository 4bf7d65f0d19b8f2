/* SPDX-License-Identifier: MIT
 *
 * Pictures whose columns are meridians and whose rows are parallels, whole or a part bounded by two of each.
 * Snyder, Map projections: a working manual (1987), equations 12-1 to 12-2 (equidistant), 10-1 to 10-2 (equal-area),
 * 7-1 to 7-2 (Mercator).
 */
#include "surface_kinds.h"

#include <cubemap/direction.h>
#include <cubemap/number.h>

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846
#define BLOCK 256

/* What number keeps: how the height in a picture comes from the latitude, and the bounds. */
enum
{
    SCALE,      /* one of the three below */
    WEST,       /* radians */
    LON_EXTENT, /* radians */
    TOP,        /* heights */
    BOTTOM,
    SOUTH_POLE, /* is it the lower edge? */
    NORTH_POLE
};

enum
{
    EQUIDISTANT,
    EQUAL_AREA,
    CONFORMAL
};

static double height_of(int scale, double lat)
{
    switch (scale)
    {
    case EQUAL_AREA:
        return sin(lat);
    case CONFORMAL:
        return asinh(tan(lat));
    default:
        return lat;
    }
}

static double latitude_of(int scale, double height)
{
    switch (scale)
    {
    case EQUAL_AREA:
        return asin(fmax(-1.0, fmin(1.0, height)));
    case CONFORMAL:
        return atan(sinh(height));
    default:
        return height;
    }
}

/* Beyond a pole the picture goes on half a turn further, upside down. */
static void fold(const cm_surface *surface, double *height, double *lon)
{
    const double top = surface->number[TOP];
    const double bottom = surface->number[BOTTOM];
    if (*height > top && surface->number[NORTH_POLE] != 0.0)
    {
        *height = fmax(2.0 * top - *height, bottom);
        *lon += *lon > 0.0 ? -PI : PI;
    }
    else if (*height < bottom && surface->number[SOUTH_POLE] != 0.0)
    {
        *height = fmin(2.0 * bottom - *height, top);
        *lon += *lon > 0.0 ? -PI : PI;
    }
}

static void lons_of(const cm_surface *surface, size_t n, const double *column, double *lon)
{
    const double west = surface->number[WEST];
    const double per_column = surface->number[LON_EXTENT] / surface->width;
    for (size_t i = 0; i < n; i++)
    {
        lon[i] = west + column[i] * per_column;
    }
}

/* Returns whether any is beyond the poles, or what else ends the picture. */
static int heights_of(const cm_surface *surface, size_t n, const double *row, double *height)
{
    const double top = surface->number[TOP];
    const double bottom = surface->number[BOTTOM];
    const double per_row = (top - bottom) / surface->height;
    const double middle = 0.5 * surface->height;
    const double level = 0.5 * (top + bottom);
    uint64_t beyond = 0; /* as wide as doubles are */
    for (size_t i = 0; i < n; i++)
    {
        height[i] = level + (middle - row[i]) * per_row;
    }
    for (size_t i = 0; i < n; i++)
    {
        beyond |= (uint64_t)(height[i] > top) | (uint64_t)(height[i] < bottom);
    }
    return beyond != 0;
}

static void latitudes_of(const cm_surface *surface, size_t n, double *height)
{
    const int scale = (int)surface->number[SCALE];
    for (size_t i = 0; scale != EQUIDISTANT && i < n; i++)
    {
        height[i] = latitude_of(scale, height[i]);
    }
}

/* Longitudes and latitudes of n positions, with those beyond the poles folded back. */
static void lonlats_of(const cm_surface *surface, size_t n, const double *column, const double *row,
                       double *lon, double *lat)
{
    lons_of(surface, n, column, lon);
    const int are_beyond = heights_of(surface, n, row, lat);
    for (size_t i = 0; are_beyond && i < n; i++)
    {
        fold(surface, &lat[i], &lon[i]);
    }
    latitudes_of(surface, n, lat);
}

/* How many columns a grid has whose places are here row by row; 0 if they are no grid. */
static size_t grid_columns(size_t n, const double *column, const double *row)
{
    size_t across = 1;
    uint64_t others = 0;
    while (across < n && row[across] == row[0])
    {
        across++;
    }
    if (across < 4 || across == n || n % across != 0)
    {
        return 0;
    }
    for (size_t i = across; i < n; i++)
    {
        others |= (uint64_t)(column[i] != column[i - across]);
    }
    for (size_t line = across; line < n; line += across)
    {
        for (size_t i = 0; i < across; i++)
        {
            others |= (uint64_t)(row[line + i] != row[line]);
        }
    }
    return others == 0 ? across : 0;
}

/* A direction is one of the equator, made shorter by one of the first meridian: those of a grid's columns and rows are
 * enough, and the numbers are the same. 0 if the places are no such grid. */
static int directions_of_grid(const cm_surface *surface, size_t n, const double *column,
                              const double *row, double *x, double *y, double *z)
{
    double lon[BLOCK], lat[BLOCK], first[BLOCK], second[BLOCK], third[BLOCK], rows[BLOCK];
    const size_t across = grid_columns(n, column, row);
    const size_t down = across == 0 ? 0 : n / across;
    if (across == 0 || across + down > BLOCK)
    {
        return 0;
    }
    memset(lat, 0, across * sizeof *lat);
    memset(lon + across, 0, down * sizeof *lon);
    for (size_t r = 0; r < down; r++)
    {
        rows[r] = row[r * across];
    }
    lons_of(surface, across, column, lon);
    if (heights_of(surface, down, rows, lat + across))
    {
        return 0;
    }
    latitudes_of(surface, down, lat + across);
    cm_direction_from_lonlat_array(across + down, lon, lat, first, second, third);
    for (size_t r = 0; r < down; r++, x += across, y += across, z += across)
    {
        for (size_t k = 0; k < across; k++)
        {
            x[k] = first[across + r] * first[k];
            y[k] = first[across + r] * second[k];
            z[k] = third[across + r];
        }
    }
    return 1;
}

static void directions(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z)
{
    (void)plane;
    if (directions_of_grid(surface, n, column, row, x, y, z))
    {
        return;
    }
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double lon[BLOCK];
        double lat[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        lonlats_of(surface, count, column + done, row + done, lon, lat);
        cm_direction_from_lonlat_array(count, lon, lat, x + done, y + done, z + done);
    }
}

/* floor of what is between -2^31 and 2^31; 0 for NaN. Compilers make vectors of it where the machine has no floor. */
static inline double floor_of(double x)
{
    const double whole = (double)(int32_t)(x == x ? x : 0.0);
    return whole > x ? whole - 1.0 : whole;
}

/* Where longitudes are, which whole pictures have once and parts at most once. */
static void columns_of(const cm_surface *surface, size_t n, const double *lon, double *column)
{
    const double west = surface->number[WEST];
    const double most = surface->number[LON_EXTENT];
    const double width = surface->width;
    for (size_t i = 0; i < n; i++)
    {
        double east = lon[i] - west;
        east -= 2.0 * PI * floor_of(east * (0.5 / PI));
        east = east < 0.0 ? east + 2.0 * PI : east;
        /* what rounding has put a little west of the western bound */
        const double few = 2.0 * PI - east;
        const int is_west = (east > most) & (few < 1e-12);
        east = is_west ? 0.0 : east;
        column[i] = width * (east / most);
    }
}

/* 1 and no more to do if all positions are good. */
static int are_inside(double width, double height, size_t n, const double *column,
                      const double *row)
{
    double inside[2] = {0.0, 0.0}; /* numbers, of which every machine has vectors */
    for (size_t i = 0; i + 2 <= n; i += 2)
    {
        for (size_t k = 0; k < 2; k++)
        {
            inside[k] += column[i + k] <= width ? 1.0 : 0.0;
            inside[k] += row[i + k] >= 0.0 ? 1.0 : 0.0;
            inside[k] += row[i + k] <= height ? 1.0 : 0.0;
        }
    }
    const size_t last = n - n % 2;
    const int is_last_inside =
        last == n || (column[last] <= width && row[last] >= 0.0 && row[last] <= height);
    return is_last_inside && inside[0] + inside[1] == 3.0 * (double)last;
}

/* Positions may be outside: those by rounding come to the edge, others are none. */
static void keep_inside(const cm_surface *surface, size_t n, uint8_t *plane, double *column,
                        double *row)
{
    const double slack = 1e-9;
    const double width = surface->width;
    const double height = surface->height;
    memset(plane, 0, n);
    if (are_inside(width, height, n, column, row))
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        const int inside =
            column[i] <= width + slack && row[i] >= -slack && row[i] <= height + slack;
        plane[i] = inside ? 0 : CM_NO_FACE;
        column[i] = inside ? fmin(column[i], width) : (double)NAN;
        row[i] = inside ? fmin(fmax(row[i], 0.0), height) : (double)NAN;
    }
}

static void positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row)
{
    const double *number = surface->number;
    const int scale = (int)number[SCALE];
    const double rows = surface->height / (number[TOP] - number[BOTTOM]);
    const double middle = 0.5 * surface->height;
    const double level = 0.5 * (number[TOP] + number[BOTTOM]);
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double lon[BLOCK];
        double lat[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        cm_lonlat_from_direction_array(count, x + done, y + done, z + done, lon, lat);
        for (size_t i = 0; scale != EQUIDISTANT && i < count; i++)
        {
            lat[i] = height_of(scale, lat[i]);
        }
        columns_of(surface, count, lon, column + done);
        for (size_t i = 0; i < count; i++)
        {
            row[done + i] = middle - (lat[i] - level) * rows;
        }
        keep_inside(surface, count, plane + done, column + done, row + done);
    }
}

static const cm_surface_methods methods = {
    .directions = directions, .positions = positions, .can_go_beyond = 1};

static cm_status read_size(cm_surface *surface, const cm_surface_wish *wish)
{
    double size = 0.0;
    const cm_surface_options *options = wish->options;
    double rows = 0.0;
    cm_status status =
        cm_surface_key_number(wish->words, "size", 1.0, CM_PICTURE_MOST, &size, wish->complaint);
    status = status != CM_OK ? status
                             : cm_surface_key_number(wish->words, "height", 1.0, CM_PICTURE_MOST,
                                                     &rows, wish->complaint);
    if (status != CM_OK)
    {
        return status;
    }
    const double extent = surface->number[LON_EXTENT];
    const double heights = surface->number[TOP] - surface->number[BOTTOM];
    double width = options->width != 0 ? options->width : size;
    double height = options->height != 0 ? options->height : rows;
    /* the same scale both ways; what is an area has no such scale, and is twice as wide as high */
    const double ratio =
        surface->number[SCALE] == EQUAL_AREA ? extent / (PI / 2.0 * heights) : extent / heights;
    width = width == 0.0 ? floor(height * ratio + 0.5) : width;
    height = height == 0.0 ? fmax(floor(width / ratio + 0.5), width > 0.0 ? 1.0 : 0.0) : height;
    if (wish->sizes_matter && (width < 1.0 || height < 1.0))
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "the size is missing, as in size=4096");
    }
    if (width > CM_PICTURE_MOST || height > CM_PICTURE_MOST || width != floor(width) ||
        height != floor(height) || (size != 0.0 && size != width) ||
        (rows != 0.0 && rows != height))
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "%.0f x %.0f is no size of a picture",
                           width, height);
    }
    surface->width = surface->picture_width = (uint32_t)width;
    surface->height = surface->picture_height = (uint32_t)height;
    return CM_OK;
}

/* West, east, south and north in degrees, if they are a part of the sphere. */
static cm_status read_bounds(const cm_surface_wish *wish, double most, double bounds[4])
{
    static const char *const keys[4] = {"west", "east", "south", "north"};
    for (int i = 0; i < 4; i++)
    {
        const double limit = i < 2 ? 540.0 : most;
        const cm_status status =
            cm_surface_key_number(wish->words, keys[i], -limit, limit, &bounds[i], wish->complaint);
        if (status != CM_OK)
        {
            return status;
        }
    }
    if (!(bounds[0] < bounds[1] && bounds[1] - bounds[0] <= 360.0 && bounds[2] < bounds[3]))
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE,
                           "east must be up to 360 degrees more than west, north more than south");
    }
    return CM_OK;
}

static cm_status say(cm_surface *surface, const char *identifier, const double bounds[4],
                     const double whole[4])
{
    static const char *const keys[4] = {"west", "east", "south", "north"};
    cm_status status = cm_surface_say(surface, "%s", identifier);
    for (int i = 0; i < 4 && status == CM_OK; i++)
    {
        char number[CM_NUMBER_SIZE];
        cm_number_write_shortest(bounds[i], number);
        status = bounds[i] == whole[i] ? CM_OK : cm_surface_say(surface, ";%s=%s", keys[i], number);
    }
    return status;
}

cm_status cm_surface_make_cylinder(cm_surface *surface, const cm_surface_wish *wish)
{
    static const char *const identifiers[3] = {"equirect", "equal-area", "mercator"};
    int scale = 0;
    while (!cm_word_is(wish->words->kind, identifiers[scale]))
    {
        scale++;
    }
    if (wish->words->parameters.text != NULL)
    {
        return cm_complain(wish->complaint, CM_ERROR_PARAMETER,
                           "%s has no parameters, but keys, as in %s;west=-10;east=10",
                           identifiers[scale], identifiers[scale]);
    }
    /* a square of the whole Earth, as web maps have it */
    const double square = scale == CONFORMAL ? atan(sinh(PI)) * (180.0 / PI) : 90.0;
    const double whole[4] = {-180.0, 180.0, -square, square};
    double bounds[4] = {-180.0, 180.0, -square, square};
    cm_status status = read_bounds(wish, scale == CONFORMAL ? 89.9999 : 90.0, bounds);
    if (status != CM_OK)
    {
        return status;
    }
    double *number = surface->number;
    const int is_whole = bounds[1] - bounds[0] == 360.0;
    number[SCALE] = scale;
    number[WEST] = bounds[0] * (PI / 180.0);
    number[LON_EXTENT] = (bounds[1] - bounds[0]) * (PI / 180.0);
    number[BOTTOM] = height_of(scale, bounds[2] * (PI / 180.0));
    number[TOP] = height_of(scale, bounds[3] * (PI / 180.0));
    number[SOUTH_POLE] = bounds[2] == -90.0 && is_whole;
    number[NORTH_POLE] = bounds[3] == 90.0 && is_whole;
    surface->methods = &methods;
    status = read_size(surface, wish);
    surface->period = is_whole ? surface->width : 0.0;
    if (scale == EQUIDISTANT)
    {
        surface->poles = (number[NORTH_POLE] != 0.0 ? CM_POLE_UPPER : 0) |
                         (number[SOUTH_POLE] != 0.0 ? CM_POLE_LOWER : 0);
    }
    status = status == CM_OK ? say(surface, identifiers[scale], bounds, whole) : status;
    return status == CM_OK && surface->width > 0
               ? cm_surface_say(surface, ";size=%u;height=%u", (unsigned)surface->width,
                                (unsigned)surface->height)
               : status;
}
