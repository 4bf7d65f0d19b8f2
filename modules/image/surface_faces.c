/* SPDX-License-Identifier: MIT
 *
 * Square planes by a mapping: the six faces of a cube, or the one of an azimuthal projection or a layout.
 */
#include "surface_kinds.h"
#include "surface_layout.h"

#include <cubemap/options.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define BLOCK 256

/* +1 or -1: the value of v in a plane's first row. */
static double first_v(const cm_surface *surface)
{
    return surface->planes == 6 ? surface->frame.first_row_v : 1.0;
}

static void directions(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z)
{
    const double half = 0.5 * surface->width;
    const double sign = first_v(surface);
    for (size_t done = 0; done < n; done += BLOCK)
    {
        uint8_t face[BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        memset(face, (int)plane, count);
        for (size_t i = 0; i < count; i++)
        {
            u[i] = (column[done + i] - half) / half;
            v[i] = sign * ((half - row[done + i]) / half);
        }
        cm_inverse_array(surface->mapping, count, face, u, v, x + done, y + done, z + done);
    }
}

static void positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row)
{
    const double half = 0.5 * surface->width;
    const double down = -half * first_v(surface);
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        cm_forward_array(surface->mapping, count, x + done, y + done, z + done, plane + done, u, v);
        for (size_t i = 0; i < count; i++)
        {
            column[done + i] = half + half * u[i];
            row[done + i] = half + down * v[i];
        }
    }
}

static const cm_surface_methods methods = {.directions = directions, .positions = positions};

/* Where the sphere goes on beyond a side of a square that is all of it. Each side is folded onto itself at its middle, so
 * that the map goes on half a turn about that; or the whole border is one point, and it goes on at the opposite side. */
static void fold_side(double middle, double *across, double *along)
{
    if (*across > 1.0 || *across < -1.0)
    {
        const double side = *across > 0.0 ? 2.0 : -2.0;
        *across = middle != 0.0 ? *across - side : side - *across;
        *along = -*along;
    }
}

static void directions_around(const cm_surface *surface, unsigned plane, size_t n,
                              const double *column, const double *row, double *x, double *y,
                              double *z)
{
    const double half = 0.5 * surface->width;
    const double is_point = surface->number[0];
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double right[BLOCK];
        double down[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            double u = (column[done + i] - half) / half;
            double v = (row[done + i] - half) / half;
            const int inside = fabs(u) <= 1.0 && fabs(v) <= 1.0;
            fold_side(is_point, &u, &v);
            fold_side(is_point, &v, &u);
            right[i] = inside ? column[done + i] : half + half * u;
            down[i] = inside ? row[done + i] : half + half * v;
        }
        directions(surface, plane, count, right, down, x + done, y + done, z + done);
    }
}

static const cm_surface_methods square_methods = {
    .directions = directions_around, .positions = positions, .can_go_beyond = 1};

/* Is the border of a square one point of the sphere? */
static int border_is_point(const cm_mapping *mapping)
{
    const double side[2] = {1.0, 0.375};
    const double other[2] = {0.375, 1.0};
    double a[3];
    double b[3];
    cm_inverse(mapping, 0, side, a);
    cm_inverse(mapping, 0, other, b);
    return fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]) < 1e-6;
}

/* An azimuthal projection's disc. */
static void covers_disc(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                        const double *row, uint8_t *covered)
{
    const double half = 0.5 * surface->width;
    (void)plane;
    for (size_t i = 0; i < n; i++)
    {
        const double right = column[i] - half;
        const double down = row[i] - half;
        covered[i] = right * right + down * down <= half * half;
    }
}

static const cm_surface_methods disc_methods = {
    .directions = directions, .positions = positions, .covers = covers_disc};

static cm_status make_mapping(cm_surface *surface, const cm_surface_wish *wish, const char *text)
{
    const cm_options options = {.size = sizeof options,
                                .instructions = wish->options->instructions};
    cm_status status = cm_specification_check(text, wish->complaint.text, wish->complaint.size);
    status = status == CM_OK
                 ? cm_mapping_create_with(text, &surface->frame, &options, &surface->mapping)
                 : status;
    surface->methods = &methods;
    return status;
}

static cm_status read_frame(cm_surface *surface, const cm_surface_wish *wish)
{
    const cm_word word = cm_surface_key(wish->words, "frame");
    char name[16] = "geo";
    if (word.text != NULL && !cm_word_copy(word, name, sizeof name))
    {
        name[0] = '\0';
    }
    const cm_frame *frame = cm_frame_find(name);
    if (frame == NULL)
    {
        return cm_complain(wish->complaint, CM_ERROR_FRAME,
                           "frame=%.*s: there are geo, gl, fits and s2", CM_SHOWN(word));
    }
    surface->frame = *frame;
    return CM_OK;
}

cm_status cm_surface_make_cube(cm_surface *surface, const cm_surface_wish *wish)
{
    char text[CM_SURFACE_TEXT / 2] = CM_MAPPING_RECOMMENDED;
    const cm_word mapping = wish->words->parameters;
    if (mapping.text != NULL && !cm_word_copy(mapping, text, sizeof text))
    {
        return cm_complain(wish->complaint, CM_ERROR_SYNTAX, "the mapping's name is too long");
    }
    cm_status status = read_frame(surface, wish);
    status = status == CM_OK ? make_mapping(surface, wish, text) : status;
    if (status == CM_OK && cm_mapping_describe(surface->mapping)->kind != CM_KIND_CUBE)
    {
        status =
            cm_complain(wish->complaint, CM_ERROR_MAPPING, "%s has one face; say %s", text, text);
    }
    if (status != CM_OK)
    {
        return status;
    }
    surface->planes = 6;
    surface->creased = cm_mapping_describe(surface->mapping)->smooth_face < CM_SMOOTH_C2;
    status = cm_surface_say(surface, "cube:%s;frame=%s", text, surface->frame.identifier);
    status = status == CM_OK ? cm_surface_lay_out(surface, wish) : status;
    return status == CM_OK && surface->width > 0
               ? cm_surface_say(surface, ";size=%u", (unsigned)surface->width)
               : status;
}

cm_status cm_surface_make_chart(cm_surface *surface, const cm_surface_wish *wish)
{
    const cm_word kind = wish->words->kind;
    const cm_word parameters = wish->words->parameters;
    const size_t length = kind.length + (parameters.text == NULL ? 0 : 1 + parameters.length);
    char text[CM_SURFACE_TEXT / 2];
    if (!cm_word_copy((cm_word){kind.text, length}, text, sizeof text))
    {
        return cm_complain(wish->complaint, CM_ERROR_SYNTAX, "the mapping's name is too long");
    }
    surface->frame = *cm_frame_find("geo");
    cm_status status = make_mapping(surface, wish, text);
    if (status != CM_OK)
    {
        return status;
    }
    const cm_kind found = cm_mapping_describe(surface->mapping)->kind;
    if (found != CM_KIND_AZIMUTHAL && found != CM_KIND_LAYOUT)
    {
        return cm_complain(wish->complaint, CM_ERROR_MAPPING,
                           found == CM_KIND_CUBE
                               ? "%s is a mapping of the cube; say cube:%s"
                               : "%s joins disc and square, not the sphere; a layout "
                                 "has it as a part, as in quincuncial:lambert,%s",
                           text, text);
    }
    surface->has_gaps = found == CM_KIND_AZIMUTHAL ||
                        strcmp(cm_mapping_describe(surface->mapping)->identifier, "rhealpix") == 0;
    surface->methods = found == CM_KIND_AZIMUTHAL ? &disc_methods
                       : surface->has_gaps        ? &methods
                                                  : &square_methods;
    surface->number[0] = border_is_point(surface->mapping);
    surface->creased = cm_mapping_describe(surface->mapping)->smooth_face < CM_SMOOTH_C2;
    status = cm_surface_grid_size(surface, wish, &(cm_plane_grid){1, 1, 0, 0, 0.0});
    status = status == CM_OK ? cm_surface_say(surface, "%s", text) : status;
    return status == CM_OK && surface->width > 0
               ? cm_surface_say(surface, ";size=%u", (unsigned)surface->width)
               : status;
}
