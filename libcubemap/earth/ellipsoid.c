/* SPDX-License-Identifier: MIT
 *
 * The table of ellipsoids, and others from a text.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/catalogue_words.h"
#include "libcubemap/mapping/message.h"

#include <string.h>

/* clang-format off */
/* By the inverse flattening, by the polar radius, and spheres: as the source has it. */
#define BY_INVERSE(id, named, from, equatorial, inverse)                                           \
    {.size = sizeof(cm_ellipsoid), .identifier = (id), .name = (named), .source = (from),          \
     .a = (equatorial), .f = 1.0 / (inverse)}
#define BY_POLAR(id, named, from, equatorial, polar)                                               \
    {.size = sizeof(cm_ellipsoid), .identifier = (id), .name = (named), .source = (from),          \
     .a = (equatorial), .f = ((equatorial) - (polar)) / (equatorial)}
#define SPHERE(id, named, from, radius)                                                            \
    {.size = sizeof(cm_ellipsoid), .identifier = (id), .name = (named), .source = (from),          \
     .a = (radius), .f = 0.0}
/* clang-format on */

#define EPSG "EPSG Geodetic Parameter Dataset"
#define IAU                                                                                        \
    "Archinal et al., Report of the IAU Working Group on Cartographic Coordinates and Rotational " \
    "Elements: 2015, Celest. Mech. Dyn. Astr. 130:22, 2018"

static const cm_ellipsoid table[] = {
    /* the Earth, today */
    BY_INVERSE("WGS84", "World Geodetic System 1984", "NIMA TR8350.2, third edition, 2000",
               6378137.0, 298.257223563),
    BY_INVERSE("GRS80", "Geodetic Reference System 1980",
               "Moritz, Geodetic Reference System 1980, Bull. Geod. 54, 1980", 6378137.0,
               298.257222101),
    BY_INVERSE("WGS72", "World Geodetic System 1972",
               "DMA, The Department of Defense World Geodetic System 1972, 1974", 6378135.0,
               298.26),
    BY_INVERSE("WGS66", "World Geodetic System 1966 (NWL 9D)", EPSG, 6378145.0, 298.25),
    BY_INVERSE("GRS67", "Geodetic Reference System 1967",
               "IAG, Geodetic Reference System 1967, Publication speciale 3, 1971", 6378160.0,
               298.247167427),
    BY_INVERSE("IAU76", "IAU 1976", "IAU 1976 System of Astronomical Constants", 6378140.0,
               298.257),
    BY_INVERSE("PZ90", "Parametry Zemli 1990 (GLONASS)", EPSG, 6378136.0, 298.257839303),
    BY_INVERSE("GSK2011", "GSK-2011", EPSG, 6378136.5, 298.2564151),
    BY_INVERSE("CGCS2000", "China Geodetic Coordinate System 2000", EPSG, 6378137.0, 298.257222101),
    BY_INVERSE("IERS2010", "IERS Conventions 2010, zero tide", "IERS Technical Note 36, 2010",
               6378136.6, 298.25642),
    /* the Earth, formerly */
    BY_INVERSE("Airy", "Airy 1830", EPSG, 6377563.396, 299.3249646),
    BY_INVERSE("modified-Airy", "Airy 1849, modified (Ireland)", EPSG, 6377340.189, 299.3249646),

    BY_INVERSE("ANS", "Australian National Spheroid", EPSG, 6378160.0, 298.25),
    BY_INVERSE("Bessel", "Bessel 1841", EPSG, 6377397.155, 299.1528128),
    BY_INVERSE("Bessel-Namibia", "Bessel 1841 (Namibia)", EPSG, 6377483.865, 299.1528128),
    BY_POLAR("Clarke1866", "Clarke 1866", EPSG, 6378206.4, 6356583.8),
    BY_INVERSE("Clarke1880", "Clarke 1880 (RGS)", EPSG, 6378249.145, 293.465),
    BY_POLAR("Clarke1880-IGN", "Clarke 1880 (IGN)", EPSG, 6378249.2, 6356515.0),
    BY_INVERSE("Everest", "Everest 1830 (1937 adjustment, India)", EPSG, 6377276.345, 300.8017),
    BY_INVERSE("modified-Fischer1960", "Fischer 1960, modified (South Asia)",
               "NIMA TR8350.2, third edition, 2000, appendix A", 6378155.0, 298.3),
    BY_INVERSE("Helmert", "Helmert 1906", EPSG, 6378200.0, 298.3),
    BY_INVERSE("Hough", "Hough 1960", EPSG, 6378270.0, 297.0),
    BY_INVERSE("International", "International 1924 (Hayford 1909)", EPSG, 6378388.0, 297.0),
    BY_INVERSE("Krassovsky", "Krassovsky 1940", EPSG, 6378245.0, 298.3),
    BY_INVERSE("Plessis", "Plessis 1817", EPSG, 6376523.0, 308.64),
    /* spheres for the Earth */
    SPHERE("sphere", "sphere of the Earth's surface, GRS 80", "Moritz 1980: R2", 6371007.181),
    SPHERE("mean-sphere", "sphere of the Earth's mean radius, GRS 80", "Moritz 1980: R1",
           6371008.7714),
    /* other bodies */
    SPHERE("Sun", "Sun", IAU, 695700000.0),
    BY_POLAR("Mercury", "Mercury", IAU, 2440530.0, 2438260.0),
    SPHERE("Venus", "Venus", IAU, 6051800.0),
    SPHERE("Moon", "Moon", IAU, 1737400.0),
    BY_POLAR("Mars", "Mars", IAU, 3396190.0, 3376200.0),
    BY_POLAR("Ceres", "Ceres, with the mean of its equatorial axes",
             "JPL Small-Body Database: diameters 964.4, 964.2 and 891.8 km", 482150.0, 445900.0),
    BY_POLAR("Jupiter", "Jupiter, at 1 bar", IAU, 71492000.0, 66854000.0),
    SPHERE("Io", "Io, mean radius", IAU, 1821490.0),
    SPHERE("Europa", "Europa, mean radius", IAU, 1560800.0),
    SPHERE("Ganymede", "Ganymede", IAU, 2631200.0),
    SPHERE("Callisto", "Callisto", IAU, 2410300.0),
    BY_POLAR("Saturn", "Saturn, at 1 bar", IAU, 60268000.0, 54364000.0),
    SPHERE("Enceladus", "Enceladus, mean radius", IAU, 252100.0),
    SPHERE("Titan", "Titan, mean radius", IAU, 2575000.0),
    BY_POLAR("Uranus", "Uranus, at 1 bar", IAU, 25559000.0, 24973000.0),
    BY_POLAR("Neptune", "Neptune, at 1 bar", IAU, 24764000.0, 24341000.0),
    SPHERE("Triton", "Triton, mean radius", IAU, 1352600.0),
    SPHERE("Pluto", "Pluto", IAU, 1188300.0),
    SPHERE("Charon", "Charon", IAU, 606000.0),
};

size_t cm_ellipsoid_count(void)
{
    return sizeof table / sizeof *table;
}

const cm_ellipsoid *cm_ellipsoid_at(size_t index)
{
    return index < cm_ellipsoid_count() ? &table[index] : NULL;
}

const cm_ellipsoid *cm_ellipsoid_find(const char *identifier)
{
    for (size_t i = 0; identifier != NULL && i < cm_ellipsoid_count(); i++)
    {
        const char *known = table[i].identifier;
        if (cm_word_equal(identifier, strlen(identifier), known, strlen(known)))
        {
            return &table[i];
        }
    }
    return NULL;
}

static int is_radius(double a)
{
    return isfinite(a) && a > 0.0;
}

static int is_flattening(double f)
{
    return f >= -99.0 && f <= 0.99;
}

cm_status cm_ellipsoid_check(const cm_ellipsoid *ellipsoid)
{
    if (ellipsoid == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    return ellipsoid->size == sizeof *ellipsoid && is_radius(ellipsoid->a) &&
                   is_flattening(ellipsoid->f)
               ? CM_OK
               : CM_ERROR_ELLIPSOID;
}

/* ---- From a text ---- */

/* What is wrong with a text that has no comma and is no number. */
static cm_status refuse_name(const char *text, char *message, size_t size)
{
    return cm_fail(
        CM_ERROR_ELLIPSOID, message, size,
        "'%.40s' is no ellipsoid: it is a name, as WGS84 or Moon, a radius in metres, or "
        "A,1/F, as 6378137,298.257223563",
        text);
}

/* The flattening from what stands after the comma: 1/F, or F's inverse alone; 0 for the inverse of a sphere's,
 * which is infinite. */
static cm_status parse_flattening(const char *text, double *f, char *message, size_t size)
{
    const char *number = strncmp(text, "1/", 2) == 0 ? text + 2 : text;
    double inverse;
    if (!cm_number_parse(number, strlen(number), &inverse))
    {
        return cm_fail(CM_ERROR_ELLIPSOID, message, size,
                       "'%.40s' is no inverse flattening: it is 298.257223563 or 1/298.257223563, "
                       "or 0 for a sphere",
                       text);
    }
    /* an inverse that is written 1/0 is no flattening, and one that is infinite is not written */
    int is_sphere = inverse == 0.0 && number == text;
    double flattening = is_sphere ? 0.0 : 1.0 / inverse;
    if (!isfinite(inverse) || !is_flattening(flattening))
    {
        return cm_fail(CM_ERROR_ELLIPSOID, message, size,
                       "the inverse flattening %.40s is out of range: 1/%.40s must be in "
                       "[-99, 0.99]; 0 is a sphere",
                       text, number);
    }
    *f = flattening;
    return CM_OK;
}

cm_status cm_ellipsoid_parse(const char *text, cm_ellipsoid *ellipsoid, char *message,
                             size_t message_size)
{
    if (text == NULL || ellipsoid == NULL)
    {
        return cm_fail(CM_ERROR_ARGUMENT, message, message_size, "the ellipsoid is NULL");
    }
    const cm_ellipsoid *known = cm_ellipsoid_find(text);
    if (known != NULL)
    {
        *ellipsoid = *known;
        return CM_OK;
    }
    cm_ellipsoid made = {.size = sizeof made,
                         .identifier = "",
                         .name = "of given axes",
                         .source = "given as radius and inverse flattening"};
    size_t length = strcspn(text, ",");
    if (!cm_number_parse(text, length, &made.a))
    {
        return refuse_name(text, message, message_size);
    }
    if (!is_radius(made.a))
    {
        return cm_fail(CM_ERROR_ELLIPSOID, message, message_size,
                       "the radius %.*s is not above 0 and finite",
                       (int)(length < 40 ? length : 40), text);
    }
    if (text[length] == ',')
    {
        cm_status status = parse_flattening(text + length + 1, &made.f, message, message_size);
        if (status != CM_OK)
        {
            return status;
        }
    }
    *ellipsoid = made;
    return CM_OK;
}

/* ---- The surface ---- */

/* A number and what its double lacks of it. */
typedef struct pair
{
    double whole;
    double rest;
} pair;

static pair sum_of(double a, double b)
{
    double whole = a + b;
    double from_b = whole - a;
    return (pair){whole, (a - (whole - from_b)) + (b - from_b)};
}

static pair product_of(pair a, pair b)
{
    double whole = a.whole * b.whole;
    return (pair){whole, fma(a.whole, b.whole, -whole) + (a.whole * b.rest + a.rest * b.whole)};
}

static pair quotient_of(pair a, pair b)
{
    double whole = a.whole / b.whole;
    return (pair){whole, (fma(-whole, b.whole, a.whole) + (a.rest - whole * b.rest)) / b.whole};
}

/* The surface over 2 pi a^2: 1 + (1 - f)^2 artanh(e) / e, for prolate ellipsoids with artan. In pairs, so that the
 * errors are those of log or atan and of what is made of the result. */
static pair surface_of(double f)
{
    pair flat = sum_of(1.0, -f);
    pair e2 = product_of((pair){f, 0.0}, sum_of(2.0, -f));
    pair square = product_of(flat, flat);
    double size = fabs(e2.whole);
    if (size < 1e-20)
    {
        return (pair){2.0, 0.0};
    }
    pair e = {.whole = sqrt(size)};
    double size_rest = e2.whole < 0.0 ? -e2.rest : e2.rest;
    e.rest = (fma(-e.whole, e.whole, size) + size_rest) / (2.0 * e.whole);
    pair angle;
    if (e2.whole < 0.0)
    {
        angle = (pair){atan(e.whole), e.rest / (1.0 + size)};
    }
    else
    {
        /* artanh e = log((1 + e) / (1 - f)) */
        pair above = sum_of(1.0, e.whole);
        above.rest += e.rest;
        pair quotient = quotient_of(above, flat);
        angle = (pair){log(quotient.whole), quotient.rest / quotient.whole};
    }
    pair part = product_of(square, quotient_of(angle, e));
    pair all = sum_of(1.0, part.whole);
    all.rest += part.rest;
    return all;
}

double cm_ellipsoid_authalic_radius(const cm_ellipsoid *ellipsoid)
{
    if (cm_ellipsoid_check(ellipsoid) != CM_OK)
    {
        return (double)NAN;
    }
    pair surface = surface_of(ellipsoid->f);
    return ellipsoid->a * sqrt(0.5 * (surface.whole + surface.rest));
}

double cm_ellipsoid_area(const cm_ellipsoid *ellipsoid)
{
    const pair pi_2 = {6.283185307179586, 2.4492935982947064e-16};
    if (cm_ellipsoid_check(ellipsoid) != CM_OK)
    {
        return (double)NAN;
    }
    /* the exponent apart, so that only the result can be out of range */
    int exponent;
    pair a = {.whole = frexp(ellipsoid->a, &exponent)};
    pair area = product_of(product_of(a, a), product_of(pi_2, surface_of(ellipsoid->f)));
    return ldexp(area.whole + area.rest, 2 * exponent);
}
