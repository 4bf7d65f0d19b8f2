/* SPDX-License-Identifier: MIT
 *
 * The life of a surface, and what all kinds have in common.
 */
#include "surface_kinds.h"

#include <cubemap/options.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Directions that are turned at once. */
#define BLOCK 256

typedef struct surface_entry
{
    cm_surface_kind kind;
    cm_surface_make make;
} surface_entry;

#define CYLINDER_KEYS "size height west east south north"
#define CIRCLE_KEYS "size height aspect x y radius"

static const surface_entry entries[] = {
    {{"equirect", "longitude to the right, latitude upwards, both in equal steps", "",
      CYLINDER_KEYS},
     cm_surface_make_cylinder},
    {{"equal-area", "cylindrical equal-area: longitude and the sine of the latitude", "",
      CYLINDER_KEYS},
     cm_surface_make_cylinder},
    {{"mercator", "Mercator: conformal, without the poles", "", CYLINDER_KEYS},
     cm_surface_make_cylinder},
    {{"cube", "six faces by a mapping of the cube", "MAPPING, coupled without it",
      "size frame layout"},
     cm_surface_make_cube},
    {{"view", "what a camera without distortion sees",
      "fov=, vfov= or focal= (35 mm), lon=, lat=, roll=, shift-x=, shift-y=", "size height aspect"},
     cm_surface_make_view},
    {{"fisheye", "a circle in a picture, by an azimuthal projection",
      "PROJECTION[:fov=...], equidistant without it", CIRCLE_KEYS},
     cm_surface_make_fisheye},
    {{"dual-fisheye", "two circles side by side, front and back",
      "PROJECTION[:fov=...], equidistant without it", CIRCLE_KEYS},
     cm_surface_make_fisheye},
    {{"dual-paraboloid", "two hemispheres side by side, front and back, as renderers have them", "",
      CIRCLE_KEYS},
     cm_surface_make_paraboloids},
    {{"healpix", "the twelve base pixels of HEALPix side by side", "NSIDE", "size"},
     cm_surface_make_healpix},
};

/* Every mapping of one face is a kind of its own, too. */
static const surface_entry chart = {
    {"chart", "one square by a mapping of one face", "as mappings have them", "size"},
    cm_surface_make_chart};

size_t cm_surface_kind_count(void)
{
    return sizeof entries / sizeof *entries;
}

const cm_surface_kind *cm_surface_kind_at(size_t index)
{
    return index < cm_surface_kind_count() ? &entries[index].kind : NULL;
}

static const surface_entry *entry_of(cm_word word)
{
    for (size_t i = 0; i < cm_surface_kind_count(); i++)
    {
        if (cm_word_is(word, entries[i].kind.identifier))
        {
            return &entries[i];
        }
    }
    return &chart;
}

/* ---- what makers share ---- */

cm_status cm_surface_say(cm_surface *surface, const char *format, ...)
{
    const size_t length = strlen(surface->specification);
    va_list arguments;
    va_start(arguments, format);
    const int more =
        vsnprintf(surface->specification + length, CM_SURFACE_TEXT - length, format, arguments);
    va_end(arguments);
    return more >= 0 && (size_t)more < CM_SURFACE_TEXT - length ? CM_OK : CM_ERROR_SYNTAX;
}

/* ---- life ---- */

static int turns(const cm_rotation *rotation)
{
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            if (rotation->row[i][j] != (i == j ? 1.0 : 0.0))
            {
                return 1;
            }
        }
    }
    return 0;
}

static cm_status take_rotation(cm_surface *surface, const cm_surface_wish *wish)
{
    if (wish->options->rotation == NULL)
    {
        return CM_OK;
    }
    const cm_status status = cm_rotation_check(wish->options->rotation);
    if (status != CM_OK)
    {
        return cm_complain(wish->complaint, status, "the rotation is not orthonormal");
    }
    surface->rotation = *wish->options->rotation;
    surface->is_turned = turns(wish->options->rotation);
    return CM_OK;
}

static cm_status complain_of_rest(const cm_surface_wish *wish, const surface_entry *entry)
{
    for (size_t i = 0; i < wish->words->key_count; i++)
    {
        if (!(wish->words->used >> i & 1u))
        {
            return cm_complain(wish->complaint, CM_ERROR_PARAMETER,
                               "%s has no key '%.*s'; it has: %s", entry->kind.identifier,
                               CM_SHOWN(wish->words->key[i]), entry->kind.keys);
        }
    }
    return CM_OK;
}

static cm_status make(cm_surface *surface, const char *specification, cm_surface_wish *wish)
{
    cm_surface_words words;
    const cm_surface_options none = {.size = sizeof none};
    wish->words = &words;
    wish->options = wish->options == NULL ? &none : wish->options;
    if (specification == NULL || wish->options->size != sizeof none)
    {
        return cm_complain(wish->complaint, CM_ERROR_ARGUMENT,
                           "no specification, or options without a size");
    }
    if (cm_instructions_check(wish->options->instructions, wish->complaint.text,
                              wish->complaint.size) != CM_OK)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_status status = cm_surface_words_read(specification, &words, wish->complaint);
    if (status != CM_OK)
    {
        return status;
    }
    const surface_entry *entry = entry_of(words.kind);
    surface->rotation = (cm_rotation){{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    surface->planes = surface->pictures = 1;
    status = entry->make(surface, wish);
    status = status == CM_OK ? complain_of_rest(wish, entry) : status;
    return status == CM_OK ? take_rotation(surface, wish) : status;
}

cm_status cm_surface_create(const char *specification, const cm_surface_options *options,
                            cm_surface **surface)
{
    if (surface == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_surface *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_surface_wish wish = {.options = options, .sizes_matter = 1};
    const cm_status status = make(made, specification, &wish);
    if (status != CM_OK)
    {
        cm_surface_destroy(made);
        return status;
    }
    *surface = made;
    return CM_OK;
}

void cm_surface_destroy(cm_surface *surface)
{
    if (surface != NULL)
    {
        cm_mapping_destroy(surface->mapping);
        free(surface);
    }
}

cm_status cm_surface_check(const char *specification, const cm_surface_options *options,
                           char *message, size_t message_size)
{
    cm_surface made = {0};
    const int has_size = options != NULL && (options->width != 0 || options->height != 0);
    cm_surface_wish wish = {
        .options = options, .sizes_matter = has_size, .complaint = {message, message_size}};
    const cm_status status = make(&made, specification, &wish);
    cm_mapping_destroy(made.mapping);
    return status;
}

cm_status cm_surface_copy(const cm_surface *surface, cm_surface **copy)
{
    const cm_surface_options options = {
        .size = sizeof options,
        .rotation = &surface->rotation,
        .instructions =
            surface->mapping == NULL ? NULL : cm_mapping_instructions(surface->mapping)};
    return cm_surface_create(surface->specification, &options, copy);
}

/* ---- what it is ---- */

const char *cm_surface_specification(const cm_surface *surface)
{
    return surface->specification;
}

size_t cm_surface_picture_count(const cm_surface *surface)
{
    return surface->pictures;
}

uint32_t cm_surface_width(const cm_surface *surface)
{
    return surface->picture_width;
}

uint32_t cm_surface_height(const cm_surface *surface)
{
    return surface->picture_height;
}

size_t cm_surface_plane_count(const cm_surface *surface)
{
    return surface->planes;
}

uint32_t cm_surface_plane_width(const cm_surface *surface)
{
    return surface->width;
}

uint32_t cm_surface_plane_height(const cm_surface *surface)
{
    return surface->height;
}

const cm_mapping *cm_surface_mapping(const cm_surface *surface)
{
    return surface->mapping;
}

void cm_placement_pixel(const cm_surface *surface, unsigned plane, uint32_t column, uint32_t row,
                        uint32_t *picture_column, uint32_t *picture_row)
{
    const cm_placement *place = &surface->placement[plane];
    const int exchanged = (place->turn & CM_TURN_EXCHANGED) != 0;
    const uint32_t width = exchanged ? surface->height : surface->width;
    const uint32_t height = exchanged ? surface->width : surface->height;
    const uint32_t right = exchanged ? row : column;
    const uint32_t down = exchanged ? column : row;
    *picture_column = place->column + (place->turn & CM_TURN_COLUMNS ? width - 1 - right : right);
    *picture_row = place->row + (place->turn & CM_TURN_ROWS ? height - 1 - down : down);
}

cm_status cm_surface_pixel(const cm_surface *surface, uint32_t plane, uint32_t column, uint32_t row,
                           uint32_t *picture, uint32_t *picture_column, uint32_t *picture_row)
{
    if (plane >= surface->planes || column >= surface->width || row >= surface->height)
    {
        return CM_ERROR_RANGE;
    }
    *picture = surface->placement[plane].picture;
    cm_placement_pixel(surface, plane, column, row, picture_column, picture_row);
    return CM_OK;
}

/* ---- directions of the Earth ---- */

/* Directions by a matrix, in loops that compilers make vectors of: the sums of cm_rotate. Results may overwrite
 * arguments. */
static void turn(const cm_rotation *by, size_t n, const double *x, const double *y, const double *z,
                 double *to_x, double *to_y, double *to_z)
{
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double turned[3][BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (int k = 0; k < 3; k++)
        {
            const double *row = by->row[k];
            for (size_t i = 0; i < count; i++)
            {
                turned[k][i] = row[0] * x[done + i] + row[1] * y[done + i] + row[2] * z[done + i];
            }
        }
        memcpy(to_x + done, turned[0], count * sizeof *to_x);
        memcpy(to_y + done, turned[1], count * sizeof *to_y);
        memcpy(to_z + done, turned[2], count * sizeof *to_z);
    }
}

static void turn_back(const cm_rotation *rotation, size_t n, double *x, double *y, double *z)
{
    cm_rotation back;
    for (int k = 0; k < 3; k++)
    {
        for (int i = 0; i < 3; i++)
        {
            back.row[k][i] = rotation->row[i][k];
        }
    }
    turn(&back, n, x, y, z, x, y, z);
}

void cm_surface_find(const cm_surface *surface, size_t n, const double *x, const double *y,
                     const double *z, uint8_t *plane, double *column, double *row)
{
    double turned[3][BLOCK];
    for (size_t done = 0; surface->is_turned && done < n; done += BLOCK)
    {
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        turn(&surface->rotation, count, x + done, y + done, z + done, turned[0], turned[1],
             turned[2]);
        surface->methods->positions(surface, count, turned[0], turned[1], turned[2], plane + done,
                                    column + done, row + done);
    }
    if (!surface->is_turned)
    {
        surface->methods->positions(surface, n, x, y, z, plane, column, row);
    }
}

void cm_surface_positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                          const double *z, uint8_t *plane, double *column, double *row)
{
    cm_surface_find(surface, n, x, y, z, plane, column, row);
}

static int is_on_plane(const cm_surface *surface, uint8_t plane, double column, double row)
{
    const double slack = 1e-9;
    return plane < surface->planes && column >= -slack && column <= surface->width + slack &&
           row >= -slack && row <= surface->height + slack;
}

/* A run of positions on one plane. */
static void directions_of_run(const cm_surface *surface, uint8_t plane, size_t n,
                              const double *column, const double *row, double *x, double *y,
                              double *z)
{
    double right[BLOCK];
    double down[BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        right[i] = fmin(fmax(column[i], 0.0), surface->width);
        down[i] = fmin(fmax(row[i], 0.0), surface->height);
    }
    surface->methods->directions(surface, plane, n, right, down, x, y, z);
    if (surface->is_turned)
    {
        turn_back(&surface->rotation, n, x, y, z);
    }
}

void cm_surface_directions(const cm_surface *surface, size_t n, const uint8_t *plane,
                           const double *column, const double *row, double *x, double *y, double *z)
{
    size_t done = 0;
    while (done < n)
    {
        const int good = is_on_plane(surface, plane[done], column[done], row[done]);
        size_t count = 1;
        while (good && done + count < n && count < BLOCK && plane[done + count] == plane[done] &&
               is_on_plane(surface, plane[done], column[done + count], row[done + count]))
        {
            count++;
        }
        if (good)
        {
            directions_of_run(surface, plane[done], count, column + done, row + done, x + done,
                              y + done, z + done);
        }
        else
        {
            x[done] = y[done] = z[done] = (double)NAN;
        }
        done += count;
    }
}

/* Beyond the edges only where the kind goes on by itself, else see surface_beyond.c. */
void cm_surface_own_directions(const cm_surface *surface, unsigned plane, size_t n,
                               const double *column, const double *row, double *x, double *y,
                               double *z)
{
    surface->methods->directions(surface, plane, n, column, row, x, y, z);
    if (surface->is_turned)
    {
        turn_back(&surface->rotation, n, x, y, z);
    }
}
