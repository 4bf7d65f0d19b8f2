/* SPDX-License-Identifier: MIT
 *
 * Regions on the sphere of normals, and how caps lie to them.
 */
#include "region.h"

#include "cell_shape.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define SAME 1e-13 /* corners that are so near each other are one */

typedef enum shape
{
    SHAPE_CAP,
    SHAPE_BOX,
    SHAPE_POLYGON
} shape;

/* An edge of a polygon, from a to b. */
typedef struct edge
{
    double a[3];
    double b[3];
    double left[3]; /* the normal of its plane, of length 1 */
    size_t before;  /* the edge that ends in a */
} edge;

struct cm_region
{
    shape shape;
    double normal[3]; /* of a cap */
    double radius;
    double middle; /* of a box in longitude, and half its width; pi is all */
    double half_width;
    double south;
    double north;
    size_t edge_count;
    edge edges[];
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double to[3])
{
    double x = a[1] * b[2] - a[2] * b[1];
    double y = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
    to[0] = x;
    to[1] = y;
}

/* To length 1; 0 if it has none. */
static int normalise(const double from[3], double to[3])
{
    double size = fmax(fabs(from[0]), fmax(fabs(from[1]), fabs(from[2])));
    if (!(size > 0.0) || !isfinite(from[0]) || !isfinite(from[1]) || !isfinite(from[2]))
    {
        return 0;
    }
    int exponent;
    frexp(size, &exponent);
    double v[3] = {ldexp(from[0], -exponent), ldexp(from[1], -exponent), ldexp(from[2], -exponent)};
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
    {
        to[k] = v[k] / length;
    }
    return 1;
}

/* ---- Caps ---- */

static cm_lie cap_lie(const cm_region *region, const double normal[3], double radius,
                      int *has_middle)
{
    double angle = cm_angle(region->normal, normal);
    *has_middle = angle <= region->radius + CM_CELL_SLACK;
    if (angle > region->radius + radius)
    {
        return CM_LIE_OUT;
    }
    return angle + radius <= region->radius || region->radius >= PI ? CM_LIE_IN : CM_LIE_PART;
}

/* ---- Boxes ---- */

/* By the cap's own box. Where it has a pole in it, that has all longitudes. */
static cm_lie box_lie(const cm_region *region, const double normal[3], double radius,
                      int *has_middle)
{
    double flat = hypot(normal[0], normal[1]);
    double lat = atan2(normal[2], flat);
    double away = fabs(remainder(atan2(normal[1], normal[0]) - region->middle, 2.0 * PI));
    int is_zone = region->half_width >= PI;
    int has_pole = fabs(lat) + radius >= 0.5 * PI;
    double reach = has_pole ? PI : asin(fmin(1.0, sin(radius) / flat));
    double south = has_pole && lat < 0.0 ? -0.5 * PI : lat - radius;
    double north = has_pole && lat > 0.0 ? 0.5 * PI : lat + radius;
    *has_middle = lat >= region->south - CM_CELL_SLACK && lat <= region->north + CM_CELL_SLACK &&
                  (is_zone || (away - region->half_width) * flat <= CM_CELL_SLACK);
    if (south > region->north || north < region->south ||
        (!is_zone && away > region->half_width + reach))
    {
        return CM_LIE_OUT;
    }
    return south >= region->south && north <= region->north &&
                   (is_zone || (!has_pole && away + reach <= region->half_width))
               ? CM_LIE_IN
               : CM_LIE_PART;
}

/* ---- Polygons ---- */

/* How far a point is from the border, and is it to the left? What is nearest says so: an edge, or a corner by
 * the sum of its two edges' normals. */
static double distance_to_border(const cm_region *region, const double p[3], int *is_left)
{
    double nearest = INFINITY;
    *is_left = 0;
    for (size_t i = 0; i < region->edge_count; i++)
    {
        const edge *e = &region->edges[i];
        double height = dot(e->left, p);
        double from_a[3], to_b[3];
        double side = height;
        double distance;
        cross(e->left, e->a, from_a);
        cross(e->b, e->left, to_b);
        if (dot(from_a, p) >= 0.0 && dot(to_b, p) >= 0.0)
        {
            distance = atan2(fabs(height), sqrt(fmax(0.0, (1.0 - height) * (1.0 + height))));
        }
        else
        {
            /* b is the next one's a */
            distance = cm_angle(p, e->a);
            side += dot(region->edges[e->before].left, p);
        }
        if (distance < nearest)
        {
            nearest = distance;
            *is_left = side >= 0.0;
        }
    }
    return nearest;
}

static cm_lie polygon_lie(const cm_region *region, const double normal[3], double radius,
                          int *has_middle)
{
    int is_left;
    double distance = distance_to_border(region, normal, &is_left);
    *has_middle = is_left || distance <= CM_CELL_SLACK;
    return distance <= radius ? CM_LIE_PART : is_left ? CM_LIE_IN : CM_LIE_OUT;
}

cm_lie cm_region_lie(const cm_region *region, const double normal[3], double radius,
                     int *has_middle)
{
    switch (region->shape)
    {
    case SHAPE_CAP:
        return cap_lie(region, normal, radius, has_middle);
    case SHAPE_BOX:
        return box_lie(region, normal, radius, has_middle);
    default:
        return polygon_lie(region, normal, radius, has_middle);
    }
}

int cm_region_contains(const cm_region *region, const double normal[3])
{
    double unit[3];
    int has_middle = 0;
    if (normalise(normal, unit))
    {
        cm_region_lie(region, unit, 0.0, &has_middle);
    }
    return has_middle;
}

/* ---- Making them ---- */

static cm_status keep(const cm_region *made, cm_region **region)
{
    cm_region *kept = malloc(sizeof *kept);
    if (kept == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    memcpy(kept, made, sizeof *kept);
    *region = kept;
    return CM_OK;
}

cm_status cm_region_cap(const double normal[3], double radius, cm_region **region)
{
    cm_region made = {.shape = SHAPE_CAP, .radius = radius};
    if (normal == NULL || region == NULL || !(radius >= 0.0) || !normalise(normal, made.normal))
    {
        return CM_ERROR_ARGUMENT;
    }
    return keep(&made, region);
}

cm_status cm_region_cap_lonlat(double lon, double lat, double radius, cm_region **region)
{
    double normal[3];
    cm_direction_from_lonlat(lon, lat, normal);
    return cm_region_cap(normal, radius, region);
}

double cm_cap_radius(const cm_ellipsoid *ellipsoid, double metres)
{
    if (cm_ellipsoid_check(ellipsoid) != CM_OK || !(metres >= 0.0))
    {
        return (double)NAN;
    }
    double a = ellipsoid->a;
    double b = a * (1.0 - ellipsoid->f);
    double least = b < a ? b / a * b : a / b * a;
    return metres / least;
}

cm_status cm_region_box(double west, double south, double east, double north, cm_region **region)
{
    cm_region made = {.shape = SHAPE_BOX, .south = south, .north = north};
    const double most = 0.5 * PI + 1e-9;
    /* of what is not finite no difference is, either */
    if (region == NULL || !isfinite(east - west) || !(south >= -most) || !(north <= most) ||
        !(south <= north))
    {
        return CM_ERROR_ARGUMENT;
    }
    double width = east - west;
    if (width < 0.0)
    {
        width = fmod(width, 2.0 * PI);
        width += width < 0.0 ? 2.0 * PI : 0.0;
    }
    /* what is rounded away from a box that is given by longitudes of many turns is put on */
    double slack = CM_CELL_SLACK + 4e-16 * (fabs(west) + fabs(east));
    made.half_width = fmin(0.5 * width + slack, PI);
    made.middle = remainder(west + 0.5 * width, 2.0 * PI);
    return keep(&made, region);
}

/* The edge to a corner from the one before, which is another; 0 if they are opposite each other. */
static int make_edge(edge *e)
{
    double apart[3], sum[3];
    for (int k = 0; k < 3; k++)
    {
        apart[k] = e->b[k] - e->a[k];
        sum[k] = e->b[k] + e->a[k];
    }
    cross(apart, sum, e->left);
    /* (b - a) x (b + a) = 2 b x a turned round */
    for (int k = 0; k < 3; k++)
    {
        e->left[k] = -e->left[k];
    }
    normalise(e->left, e->left);
    return dot(sum, sum) > 1e-4;
}

static int is_same(const double a[3], const double b[3])
{
    return !(cm_angle(a, b) > SAME);
}

/* Does the way from a to c turn back in b, onto itself, or is b one of them? */
static int is_spike(const double a[3], const double b[3], const double c[3])
{
    double to_a[3], to_c[3], across[3];
    cross(b, a, to_a);
    cross(b, c, to_c);
    cross(to_a, to_c, across);
    double turn = atan2(sqrt(dot(across, across)), dot(to_a, to_c));
    double least = fmin(cm_angle(b, a), cm_angle(b, c));
    double most = fmax(cm_angle(b, a), cm_angle(b, c));
    /* where corners are opposite each other there is no way */
    return most < PI - 0.01 && fmin(turn, 1.0) * least <= SAME;
}

/* Leaves the tips of spikes out until there is none; what is left of a flat ring is none. Returns the number of
 * corners. */
static size_t drop_spikes(edge *edges, size_t count)
{
    size_t i = 0;
    for (size_t good = 0; good < count && count >= 3; good++)
    {
        i %= count;
        const size_t before = (i + count - 1) % count;
        const size_t after = (i + 1) % count;
        if (!is_spike(edges[before].a, edges[i].a, edges[after].a))
        {
            i++;
            continue;
        }
        count--;
        memmove(&edges[i], &edges[i + 1], (count - i) * sizeof *edges);
        /* the two beside it have new neighbours */
        i = (i + count - 1) % count;
        good = (size_t)-1;
    }
    return count;
}

/* The edges of one ring, behind those that there are; 0 if it is none. */
static int add_ring(cm_region *region, size_t length, const double *lonlat)
{
    size_t first = region->edge_count;
    edge *edges = region->edges + first;
    size_t count = 0;
    for (size_t i = 0; i < length; i++)
    {
        double at[3];
        cm_direction_from_lonlat(lonlat[2 * i], lonlat[2 * i + 1], at);
        if (!normalise(at, at))
        {
            return 0;
        }
        if (count == 0 || !is_same(edges[count - 1].a, at))
        {
            memcpy(edges[count++].a, at, sizeof at);
        }
    }
    while (count > 1 && is_same(edges[count - 1].a, edges[0].a))
    {
        count--;
    }
    count = drop_spikes(edges, count);
    if (count < 3)
    {
        return 0;
    }
    for (size_t i = 0; i < count; i++)
    {
        memcpy(edges[i].b, edges[(i + 1) % count].a, sizeof edges[i].b);
        edges[i].before = first + (i + count - 1) % count;
        if (!make_edge(&edges[i]))
        {
            return 0;
        }
    }
    region->edge_count += count;
    return 1;
}

cm_status cm_region_polygon(size_t ring_count, const size_t *ring_length, const double *lonlat,
                            cm_region **region)
{
    const size_t most = (SIZE_MAX - sizeof(cm_region)) / sizeof(edge);
    size_t corners = 0;
    if (region == NULL || ring_length == NULL || lonlat == NULL || ring_count == 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t k = 0; k < ring_count; k++)
    {
        if (ring_length[k] < 3 || ring_length[k] > most - corners)
        {
            return CM_ERROR_ARGUMENT;
        }
        corners += ring_length[k];
    }
    cm_region *made = calloc(1, sizeof *made + corners * sizeof(edge));
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->shape = SHAPE_POLYGON;
    for (size_t k = 0; k < ring_count; k++)
    {
        if (!add_ring(made, ring_length[k], lonlat))
        {
            free(made);
            return CM_ERROR_ARGUMENT;
        }
        lonlat += 2 * ring_length[k];
    }
    *region = made;
    return CM_OK;
}

void cm_region_destroy(cm_region *region)
{
    free(region);
}
