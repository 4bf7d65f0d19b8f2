/* SPDX-License-Identifier: MIT
 *
 * Circles in pictures: what a fisheye lens sees, by an azimuthal projection about the direction in which the camera
 * looks; and two of them side by side, front and back, of cameras and of renderers (Heidrich, Seidel 1998, View-independent
 * environment maps: paraboloid maps are the stereographic projection of a hemisphere).
 */
#include "surface_kinds.h"

#include <cubemap/number.h>
#include <cubemap/options.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define BLOCK 256

/* What number keeps, of each plane. */
enum
{
    CENTRE_COLUMN,
    CENTRE_ROW,
    RADIUS
};

/* The plane 1 looks back: half a turn about the z axis. */
static double sign_of(unsigned plane)
{
    return plane == 0 ? 1.0 : -1.0;
}

static void directions(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z)
{
    const double *number = surface->number;
    const uint8_t face[BLOCK] = {0};
    const double sign = sign_of(plane);
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            u[i] = (column[done + i] - number[CENTRE_COLUMN]) / number[RADIUS];
            v[i] = (number[CENTRE_ROW] - row[done + i]) / number[RADIUS];
        }
        cm_inverse_array(surface->mapping, count, face, u, v, x + done, y + done, z + done);
        for (size_t i = 0; i < count && plane != 0; i++)
        {
            x[done + i] *= sign;
            y[done + i] *= sign;
        }
    }
}

/* A place of the circle to one of the plane: is it there? */
static int place(const cm_surface *surface, uint8_t face, double u, double v, double *column,
                 double *row)
{
    const double slack = 1e-9;
    const double right = surface->number[CENTRE_COLUMN] + u * surface->number[RADIUS];
    const double down = surface->number[CENTRE_ROW] - v * surface->number[RADIUS];
    const int inside = face != CM_NO_FACE && right >= -slack && right <= surface->width + slack &&
                       down >= -slack && down <= surface->height + slack;
    *column = inside ? fmin(fmax(right, 0.0), surface->width) : (double)NAN;
    *row = inside ? fmin(fmax(down, 0.0), surface->height) : (double)NAN;
    return inside;
}

/* Where two circles have a direction the one wins whose centre is nearer. */
static void positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row)
{
    for (size_t done = 0; done < n; done += BLOCK)
    {
        uint8_t face[BLOCK];
        double to[3][BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            const double sign = surface->planes == 1 || !(x[done + i] < 0.0) ? 1.0 : -1.0;
            to[0][i] = sign * x[done + i];
            to[1][i] = sign * y[done + i];
            to[2][i] = z[done + i];
            plane[done + i] = sign < 0.0;
        }
        cm_forward_array(surface->mapping, count, to[0], to[1], to[2], face, u, v);
        for (size_t i = 0; i < count; i++)
        {
            int found = place(surface, face[i], u[i], v[i], &column[done + i], &row[done + i]);
            if (!found && surface->planes == 2)
            {
                const double other[3] = {-to[0][i], -to[1][i], to[2][i]};
                double uv[2];
                face[i] = cm_forward(surface->mapping, other, uv);
                plane[done + i] ^= 1u;
                found = place(surface, face[i], uv[0], uv[1], &column[done + i], &row[done + i]);
            }
            plane[done + i] = found ? plane[done + i] : CM_NO_FACE;
        }
    }
}

static void covers(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                   const double *row, uint8_t *covered)
{
    const double *number = surface->number;
    const double most = number[RADIUS] * number[RADIUS];
    (void)plane;
    for (size_t i = 0; i < n; i++)
    {
        const double right = column[i] - number[CENTRE_COLUMN];
        const double down = row[i] - number[CENTRE_ROW];
        covered[i] = right * right + down * down <= most;
    }
}

static const cm_surface_methods methods = {
    .directions = directions, .positions = positions, .covers = covers};

/* ---- the projection ---- */

/* Has it a parameter of that name? */
static int names(cm_word parameters, const char *name)
{
    while (parameters.text != NULL)
    {
        cm_word value;
        const cm_word one = cm_word_split(parameters, ',', &parameters);
        if (cm_word_is(cm_word_split(one, '=', &value), name))
        {
            return 1;
        }
    }
    return 0;
}

/* A field of view that is not said is half the sphere, where the projection has so much. */
static int can_be_half(const cm_mapping_info *info)
{
    for (size_t i = 0; info != NULL && i < info->parameter_count; i++)
    {
        if (strcmp(info->parameter[i].name, "fov") == 0)
        {
            return info->parameter[i].high >= 180.0;
        }
    }
    return 0;
}

/* PROJECTION:PARAMETERS as a mapping has it after "azimuthal:", with the field of view if it is not said. */
static cm_status complete(const cm_surface_wish *wish, int is_single, char *text, size_t size)
{
    cm_word rest;
    char name[64] = "equidistant";
    char identifier[80];
    cm_word word = cm_word_split(wish->words->parameters, ':', &rest);
    if (word.length > 0 && memchr(word.text, '=', word.length) != NULL)
    {
        rest = wish->words->parameters;
        word.length = 0;
    }
    if (word.length >= sizeof name || rest.length >= size / 2)
    {
        return cm_complain(wish->complaint, CM_ERROR_SYNTAX, "the projection's name is too long");
    }
    if (word.length > 0)
    {
        cm_word_copy(word, name, sizeof name);
    }
    if (!is_single && (names(rest, "lon") || names(rest, "lat")))
    {
        return cm_complain(
            wish->complaint, CM_ERROR_PARAMETER,
            "two circles look along x and against it: no lon and lat, but a rotation");
    }
    snprintf(identifier, sizeof identifier, "azimuthal:%s", name);
    const int is_open =
        can_be_half(cm_catalogue_find(identifier)) && !names(rest, "fov") && !names(rest, "full");
    const int has_rest = rest.length > 0;
    const int length =
        snprintf(text, size, "%s%s%.*s%s", name, has_rest ? ":" : "", (int)rest.length,
                 has_rest ? rest.text : "", is_open ? (has_rest ? ",fov=180" : ":fov=180") : "");
    return length > 0 && (size_t)length < size ? CM_OK : CM_ERROR_SYNTAX;
}

/* The camera looks along x unless the projection says another way. */
static cm_status make_mapping(cm_surface *surface, const cm_surface_wish *wish,
                              const char *projection)
{
    char text[CM_SURFACE_TEXT / 2 + 32];
    cm_word parameters;
    const cm_options options = {.size = sizeof options,
                                .instructions = wish->options->instructions};
    cm_word_split((cm_word){projection, strlen(projection)}, ':', &parameters);
    snprintf(text, sizeof text, "azimuthal:%s%s%s", projection,
             parameters.text == NULL    ? ":lon=0"
             : names(parameters, "lon") ? ""
                                        : ",lon=0",
             names(parameters, "lat") ? "" : ",lat=0");
    const cm_status status =
        cm_specification_check(text, wish->complaint.text, wish->complaint.size);
    return status == CM_OK ? cm_mapping_create_with(text, NULL, &options, &surface->mapping)
                           : status;
}

/* ---- the circle ---- */

static cm_status read_circle(cm_surface *surface, const cm_surface_wish *wish)
{
    static const char *const keys[3] = {"x", "y", "radius"};
    const double width = surface->width;
    const double height = surface->height;
    const double standard[3] = {0.5 * width, 0.5 * height, 0.5 * fmin(width, height)};
    cm_status status = CM_OK;
    for (int i = 0; i < 3 && status == CM_OK; i++)
    {
        char number[CM_NUMBER_SIZE];
        surface->number[i] = standard[i];
        status = cm_surface_key_number(wish->words, keys[i], i < 2 ? -1e9 : 1e-3, 1e9,
                                       &surface->number[i], wish->complaint);
        if (status == CM_OK && surface->number[i] != standard[i])
        {
            cm_number_write_shortest(surface->number[i], number);
            status = cm_surface_say(surface, ";%s=%s", keys[i], number);
        }
    }
    return status;
}

static cm_status make(cm_surface *surface, const cm_surface_wish *wish, uint32_t circles,
                      const char *projection)
{
    cm_status status = make_mapping(surface, wish, projection);
    status = status == CM_OK ? cm_surface_free_size(surface, wish, circles) : status;
    if (status != CM_OK)
    {
        return status;
    }
    if (surface->picture_width % circles != 0)
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE,
                           "two circles side by side need an even width, not %u",
                           (unsigned)surface->picture_width);
    }
    surface->methods = &methods;
    surface->has_gaps = 1;
    surface->planes = circles;
    surface->width = surface->picture_width / circles;
    surface->placement[1].column = surface->width;
    status = read_circle(surface, wish);
    return status == CM_OK ? cm_surface_say_size(surface) : status;
}

cm_status cm_surface_make_fisheye(cm_surface *surface, const cm_surface_wish *wish)
{
    const int is_single = cm_word_is(wish->words->kind, "fisheye");
    char projection[CM_SURFACE_TEXT / 2];
    cm_status status = complete(wish, is_single, projection, sizeof projection);
    status = status == CM_OK ? cm_surface_say(surface, "%s:%s",
                                              is_single ? "fisheye" : "dual-fisheye", projection)
                             : status;
    return status == CM_OK ? make(surface, wish, is_single ? 1 : 2, projection) : status;
}

cm_status cm_surface_make_paraboloids(cm_surface *surface, const cm_surface_wish *wish)
{
    if (wish->words->parameters.text != NULL)
    {
        return cm_complain(wish->complaint, CM_ERROR_PARAMETER,
                           "dual-paraboloid has no parameters");
    }
    const cm_status status = cm_surface_say(surface, "dual-paraboloid");
    return status == CM_OK ? make(surface, wish, 2, "stereographic:fov=180") : status;
}
