/* SPDX-License-Identifier: MIT
 *
 * The flags of floating-point exceptions are after a call as they were before it, and nothing traps: functions of
 * longitudes and latitudes, of grids, cells and pixels, with good points and bad ones, of every number up to three vectors and
 * a bit, in every instruction set. (tests/paths asks the same of the functions of mappings alone.) Functions of one point
 * alone may raise inexact.
 */
#ifdef __linux__
#define _GNU_SOURCE /* for feenableexcept */
#endif
#include "tests/suite.h"

#include <fenv.h>

enum
{
    POINTS = 3 * 16 + 2
};

/* ---- Points: angles, directions, places on faces, cells and pixels ---- */

typedef struct points
{
    double lon[POINTS], lat[POINTS];
    double x[POINTS], y[POINTS], z[POINTS];
    uint8_t face[POINTS];
    double u[POINTS], v[POINTS];
    cm_cell cell[POINTS];
    int64_t pixel[POINTS];
} points;

static const double special[] = {0.0, -0.0, 1.0, -1.0, 0.5, 1e-300, 5e-324, 1.5707963267948966};
static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e308, 3.0};

static double number_from(uint64_t *state, int with_bad)
{
    uint64_t bits = next_bits(state) >> 32;
    if (bits % 3 == 0)
    {
        return special[bits / 3 % (sizeof special / sizeof special[0])];
    }
    return with_bad && bits % 3 == 1 ? bad[bits / 3 % (sizeof bad / sizeof bad[0])]
                                     : next_real(state);
}

static points points_from(uint64_t *state, int with_bad)
{
    points p;
    for (int i = 0; i < POINTS; i++)
    {
        uint64_t bits = next_bits(state) >> 32;
        p.lon[i] = 2.0 * number_from(state, with_bad);
        p.lat[i] = number_from(state, with_bad);
        p.x[i] = number_from(state, with_bad);
        p.y[i] = number_from(state, with_bad);
        p.z[i] = number_from(state, with_bad);
        if (!with_bad && p.x[i] == 0.0 && p.y[i] == 0.0 && p.z[i] == 0.0)
        {
            p.z[i] = -1.0;
        }
        p.u[i] = number_from(state, with_bad);
        p.v[i] = number_from(state, with_bad);
        p.face[i] = (uint8_t)(bits % (with_bad ? 8 : 6));
        p.cell[i] = with_bad && bits % 5 == 0 ? bits : cm_cell_at_index(9, bits % (6u << 18));
        p.pixel[i] = with_bad && bits % 5 == 0 ? -1 : (int64_t)(bits % (12 * 64 * 64));
    }
    return p;
}

/* ---- What is called ---- */

typedef struct objects
{
    cm_mapping *mapping;
    cm_latitude_conversion *series, *exact;
    cm_grid *grid;
    cm_cell_grid *cells;
    cm_grid *s2_grid;
    cm_cell_grid *s2_cells;
    cm_healpix *healpix;
} objects;

typedef struct results
{
    double a[POINTS], b[POINTS], c[POINTS];
    uint8_t face[POINTS];
    cm_cell cell[POINTS];
    int64_t pixel[POINTS];
} results;

static objects objects_of(const char *set)
{
    objects o;
    const cm_options options = {.size = sizeof options, .instructions = set};
    const cm_latitude_options how = {.size = sizeof how, .instructions = set};
    const cm_latitude_options closed = {.size = sizeof closed, .exact = 1, .instructions = set};
    cm_rotation rotation;
    ck_assert_int_eq(cm_rotation_from_angles(10.0, 20.0, 30.0, &rotation), CM_OK);
    const cm_grid_options of_grid = {
        .size = sizeof of_grid, .mapping = "slice", .options = &options, .rotation = &rotation};
    const cm_ellipsoid *earth = cm_ellipsoid_find("WGS84");
    const cm_ellipsoid flat = {.size = sizeof flat, .identifier = "", .a = 1.0, .f = 0.1};
    ck_assert_int_eq(cm_mapping_create_with("healpix", NULL, &options, &o.mapping), CM_OK);
    ck_assert_int_eq(cm_latitude_conversion_create(earth, CM_LATITUDE_GEOGRAPHIC,
                                                   CM_LATITUDE_AUTHALIC, &how, &o.series),
                     CM_OK);
    ck_assert_int_eq(cm_latitude_conversion_create(&flat, CM_LATITUDE_AUTHALIC,
                                                   CM_LATITUDE_CONFORMAL, &closed, &o.exact),
                     CM_OK);
    ck_assert_int_eq(cm_grid_create(&of_grid, &o.grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create(o.grid, CM_CURVE_HILBERT, &o.cells), CM_OK);
    const cm_ellipsoid ball = {.size = sizeof ball, .identifier = "", .a = 1.0};
    const cm_grid_options of_s2 = {.size = sizeof of_s2,
                                   .mapping = "s2",
                                   .frame = cm_frame_find("s2"),
                                   .ellipsoid = &ball,
                                   .options = &options};
    ck_assert_int_eq(cm_grid_create(&of_s2, &o.s2_grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create_s2(o.s2_grid, &o.s2_cells), CM_OK);
    ck_assert_int_eq(cm_healpix_create(64, CM_HEALPIX_NESTED, &options, &o.healpix), CM_OK);
    return o;
}

static void destroy(objects *o)
{
    cm_healpix_destroy(o->healpix);
    cm_cell_grid_destroy(o->s2_cells);
    cm_grid_destroy(o->s2_grid);
    cm_cell_grid_destroy(o->cells);
    cm_grid_destroy(o->grid);
    cm_latitude_conversion_destroy(o->exact);
    cm_latitude_conversion_destroy(o->series);
    cm_mapping_destroy(o->mapping);
}

typedef void (*call)(const objects *o, size_t n, const points *p, results *r);

/* name: what is called; the rest: its arguments after the object */
#define CALL(name, object, ...)                                                                    \
    static void call_##name(const objects *o, size_t n, const points *p, results *r)               \
    {                                                                                              \
        (void)p, (void)r;                                                                          \
        (void)cm_##name(o->object, n, __VA_ARGS__);                                                \
    }
CALL(forward_lonlat_array, mapping, p->lon, p->lat, r->face, r->a, r->b)
CALL(inverse_lonlat_array, mapping, p->face, p->u, p->v, r->a, r->b)
CALL(latitude_convert_array, series, p->lat, r->a)
CALL(latitude_convert_direction_array, series, p->x, p->y, p->z, r->a, r->b, r->c)
CALL(grid_forward_lonlat_array, grid, p->lon, p->lat, r->face, r->a, r->b)
CALL(grid_inverse_lonlat_array, grid, p->face, p->u, p->v, r->a, r->b)
CALL(grid_forward_array, grid, p->x, p->y, p->z, r->face, r->a, r->b)
CALL(grid_inverse_array, grid, p->face, p->u, p->v, r->a, r->b, r->c)
CALL(grid_to_sphere_array, grid, p->x, p->y, p->z, r->a, r->b, r->c)
CALL(grid_from_sphere_array, grid, p->x, p->y, p->z, r->a, r->b, r->c)
CALL(grid_area_element_array, grid, p->face, p->u, p->v, r->a)
CALL(cell_centre_array, cells, p->cell, r->a, r->b, r->c)
CALL(cell_centre_lonlat_array, cells, p->cell, r->a, r->b)
CALL(healpix_pixel_from_direction_array, healpix, p->x, p->y, p->z, r->pixel)
CALL(healpix_pixel_from_angles_array, healpix, p->lat, p->lon, r->pixel)
CALL(healpix_pixel_from_lonlat_array, healpix, p->lon, p->lat, r->pixel)
CALL(healpix_direction_from_pixel_array, healpix, p->pixel, r->a, r->b, r->c)
CALL(healpix_angles_from_pixel_array, healpix, p->pixel, r->a, r->b)
CALL(healpix_lonlat_from_pixel_array, healpix, p->pixel, r->a, r->b)
CALL(healpix_nested_from_ring_array, healpix, p->pixel, r->pixel)
CALL(healpix_ring_from_nested_array, healpix, p->pixel, r->pixel)

static void call_exact(const objects *o, size_t n, const points *p, results *r)
{
    cm_latitude_convert_array(o->exact, n, p->lat, r->a);
    cm_latitude_convert_direction_array(o->exact, n, p->x, p->y, p->z, r->a, r->b, r->c);
}

static void call_cells(const objects *o, size_t n, const points *p, results *r)
{
    cm_cell_forward_array(o->cells, 12, n, p->x, p->y, p->z, r->cell);
    cm_cell_forward_lonlat_array(o->cells, 12, n, p->lon, p->lat, r->cell);
    cm_cell_forward_array(o->s2_cells, 12, n, p->x, p->y, p->z, r->cell);
    cm_cell_forward_lonlat_array(o->s2_cells, 12, n, p->lon, p->lat, r->cell);
    cm_cell_centre_array(o->s2_cells, n, p->cell, r->a, r->b, r->c);
    cm_cell_centre_lonlat_array(o->s2_cells, n, p->cell, r->a, r->b);
}

/* Of single points the last one. */
static void call_points(const objects *o, size_t n, const points *p, results *r)
{
    const size_t i = n == 0 ? 0 : n - 1;
    const double direction[3] = {p->x[i], p->y[i], p->z[i]};
    const double uv[2] = {p->u[i], p->v[i]};
    cm_distortion distortion;
    (void)cm_forward_lonlat(o->mapping, p->lon[i], p->lat[i], r->a);
    cm_inverse_lonlat(o->mapping, p->face[i], uv, r->a);
    cm_direction_from_lonlat(p->lon[i], p->lat[i], r->a);
    cm_lonlat_from_direction(direction, r->a);
    r->a[0] = cm_latitude_convert(o->series, p->lat[i]);
    cm_latitude_convert_direction(o->series, direction, r->a);
    (void)cm_grid_forward_lonlat(o->grid, p->lon[i], p->lat[i], r->a);
    cm_grid_inverse_lonlat(o->grid, p->face[i], uv, r->a);
    (void)cm_grid_forward(o->grid, direction, r->a);
    cm_grid_inverse(o->grid, p->face[i], uv, r->a);
    cm_grid_to_sphere(o->grid, direction, r->a);
    cm_grid_from_sphere(o->grid, direction, r->a);
    r->a[0] = cm_grid_area_element(o->grid, p->face[i], uv);
    cm_grid_forward_distortion(o->grid, direction, &distortion);
    cm_grid_inverse_distortion(o->grid, p->face[i], uv, &distortion);
    r->cell[0] = cm_cell_forward(o->cells, 20, direction);
    r->cell[1] = cm_cell_forward_lonlat(o->cells, 20, p->lon[i], p->lat[i]);
    cm_cell_centre(o->cells, p->cell[i], r->a);
    cm_cell_centre_lonlat(o->cells, p->cell[i], r->a);
    r->cell[0] = cm_cell_forward(o->s2_cells, 20, direction);
    r->cell[1] = cm_cell_forward_lonlat(o->s2_cells, 20, p->lon[i], p->lat[i]);
    cm_cell_centre(o->s2_cells, p->cell[i], r->a);
    cm_cell_centre_lonlat(o->s2_cells, p->cell[i], r->a);
    (void)cm_healpix_pixel_from_direction(o->healpix, direction, r->pixel);
    (void)cm_healpix_pixel_from_angles(o->healpix, p->lat[i], p->lon[i], r->pixel);
    (void)cm_healpix_pixel_from_lonlat(o->healpix, p->lon[i], p->lat[i], r->pixel);
    (void)cm_healpix_direction_from_pixel(o->healpix, p->pixel[i], r->a);
    (void)cm_healpix_angles_from_pixel(o->healpix, p->pixel[i], r->a, r->b);
    (void)cm_healpix_lonlat_from_pixel(o->healpix, p->pixel[i], r->a);
    (void)cm_healpix_nested_from_ring(o->healpix, p->pixel[i], r->pixel);
    (void)cm_healpix_ring_from_nested(o->healpix, p->pixel[i], r->pixel);
}

/* The flags that calls of single points may raise. */
static int raised_by(call function)
{
    return function == call_points ? FE_INEXACT : 0;
}

#define NAMED(name)                                                                                \
    {                                                                                              \
#name, call_##name                                                                         \
    }
static const struct
{
    const char *name;
    call function;
} calls[] = {NAMED(forward_lonlat_array),
             NAMED(inverse_lonlat_array),
             NAMED(latitude_convert_array),
             NAMED(latitude_convert_direction_array),
             NAMED(grid_forward_lonlat_array),
             NAMED(grid_inverse_lonlat_array),
             NAMED(grid_forward_array),
             NAMED(grid_inverse_array),
             NAMED(grid_to_sphere_array),
             NAMED(grid_from_sphere_array),
             NAMED(grid_area_element_array),
             NAMED(cell_centre_array),
             NAMED(cell_centre_lonlat_array),
             NAMED(healpix_pixel_from_direction_array),
             NAMED(healpix_pixel_from_angles_array),
             NAMED(healpix_pixel_from_lonlat_array),
             NAMED(healpix_direction_from_pixel_array),
             NAMED(healpix_angles_from_pixel_array),
             NAMED(healpix_lonlat_from_pixel_array),
             NAMED(healpix_nested_from_ring_array),
             NAMED(healpix_ring_from_nested_array),
             NAMED(exact),
             NAMED(cells),
             NAMED(points)};

/* ---- The tests ---- */

#ifdef _WIN32
/* The C library computes sines by the x87, whose flags are not kept. */
#define ASKED (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
#else
#define ASKED FE_ALL_EXCEPT
#endif

/* with_bad: whether there are bad points among them. */
static void call_all(const char *set, int with_bad, int raised)
{
    objects o = objects_of(set);
    uint64_t state = 12345;
    for (size_t n = 0; n < POINTS; n++)
    {
        const points p = points_from(&state, with_bad);
        for (size_t k = 0; k < sizeof calls / sizeof calls[0]; k++)
        {
            static results r;
            feclearexcept(FE_ALL_EXCEPT);
            feraiseexcept(raised);
            calls[k].function(&o, n, &p, &r);
            const int asked = ASKED & ~raised_by(calls[k].function);
            REQUIRE(fetestexcept(asked) == (raised & asked),
                    "%s, %s, %zu points%s: flags %#x, not %#x", set, calls[k].name, n,
                    with_bad ? ", bad ones" : "", (unsigned)fetestexcept(asked),
                    (unsigned)(raised & asked));
        }
    }
    destroy(&o);
}

static void call_sets(int raised)
{
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        call_all(cm_instructions_at(i), 0, raised);
        call_all(cm_instructions_at(i), 1, raised);
    }
}

START_TEST(no_flag_is_raised)
{
    call_sets(0);
}
END_TEST

START_TEST(no_flag_is_cleared)
{
    call_sets(ASKED);
}
END_TEST

START_TEST(no_flag_is_added_to_inexact)
{
    call_sets(FE_INEXACT & ASKED);
}
END_TEST

#if defined(__GLIBC__) && defined(__SSE2__)
/* Programs that let exceptions trap are not interrupted; and they trap again afterwards. */
START_TEST(nothing_traps)
{
    const int all = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT;
    objects o = objects_of(NULL);
    uint64_t state = 54321;
    const points p = points_from(&state, 1);
    static results r;
    for (size_t k = 0; k < sizeof calls / sizeof calls[0]; k++)
    {
        const int trapped = all & ~raised_by(calls[k].function);
        feclearexcept(FE_ALL_EXCEPT);
        ck_assert_int_ge(feenableexcept(trapped), 0);
        calls[k].function(&o, POINTS, &p, &r);
        ck_assert_int_eq(fegetexcept(), trapped);
        fedisableexcept(all);
        ck_assert_int_eq(fetestexcept(trapped), 0);
    }
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        cm_mapping *mapping;
        ck_assert_int_eq(cm_mapping_create(cm_catalogue_at(i)->identifier, NULL, &mapping), CM_OK);
        feclearexcept(FE_ALL_EXCEPT);
        ck_assert_int_ge(feenableexcept(all), 0);
        cm_forward_array(mapping, POINTS, p.x, p.y, p.z, r.face, r.a, r.b);
        cm_inverse_array(mapping, POINTS, p.face, p.u, p.v, r.a, r.b, r.c);
        fedisableexcept(all);
        feenableexcept(all & ~FE_INEXACT);
        for (int k = 0; k < POINTS; k++)
        {
            const double direction[3] = {p.x[k], p.y[k], p.z[k]};
            const double uv[2] = {p.u[k], p.v[k]};
            (void)cm_forward(mapping, direction, r.a);
            cm_inverse(mapping, p.face[k], uv, r.a);
        }
        fedisableexcept(all);
        cm_mapping_destroy(mapping);
    }
    destroy(&o);
}
END_TEST
#endif

int main(void)
{
    const TTest *const tests[] = {
        no_flag_is_raised,
        no_flag_is_cleared,
        no_flag_is_added_to_inexact,
#if defined(__GLIBC__) && defined(__SSE2__)
        nothing_traps,
#endif
        NULL
    };
    return run_suite("exception flags", tests);
}
