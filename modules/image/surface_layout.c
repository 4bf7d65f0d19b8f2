/* SPDX-License-Identifier: MIT */
#include "surface_layout.h"

#include <cubemap/mips.h>
#include <cubemap/number.h>

#include <string.h>

/* What is unfolded: a picture of a face, by the signed axes that point out of it, to the right and down. */
typedef struct side
{
    int outward;
    int right;
    int down;
} side;

typedef struct face_layout
{
    const char *identifier;
    uint32_t pictures;
    uint32_t columns;
    uint32_t rows;
    /* places the faces of a surface that knows its sizes; the parameters of a layout without any are all 0 */
    void (*place)(cm_surface *surface, const struct face_layout *layout, const uint32_t *parameter);
    const char *parameter[2]; /* names */
    uint32_t standard[2];
    uint32_t most[2];
} face_layout;

/* ---- unfolding ---- */

static side side_of(const cm_frame *frame, unsigned face)
{
    const cm_frame_face *at = &frame->face[face];
    return (side){at->outward, at->u, frame->first_row_v > 0 ? -at->v : at->v};
}

static unsigned face_towards(const cm_frame *frame, int axis)
{
    unsigned face = 0;
    while (frame->face[face].outward != axis)
    {
        face++;
    }
    return face;
}

/* What one sees beside a side when the cube is unfolded. */
static side right_of(side at)
{
    return (side){at.right, -at.outward, at.down};
}

static side left_of(side at)
{
    return (side){-at.right, at.outward, at.down};
}

static side below(side at)
{
    return (side){at.down, at.right, -at.outward};
}

static side above(side at)
{
    return (side){-at.down, at.right, at.outward};
}

static side upside_down(side at)
{
    return (side){at.outward, -at.right, -at.down};
}

/* Turned a quarter: what was to the right is below, or above. */
static side turned_clockwise(side at)
{
    return (side){at.outward, -at.down, at.right};
}

static side turned_anticlockwise(side at)
{
    return (side){at.outward, at.down, -at.right};
}

static int is_straight(const cm_frame *frame, side at)
{
    const side own = side_of(frame, face_towards(frame, at.outward));
    return own.right == at.right && own.down == at.down;
}

/* The middle of a cross: the first face around which no other one has to be turned, or else the first of all. */
static side middle_of(const cm_frame *frame)
{
    for (unsigned face = 0; face < 6; face++)
    {
        const side at = side_of(frame, face);
        if (is_straight(frame, left_of(at)) && is_straight(frame, right_of(at)) &&
            is_straight(frame, right_of(right_of(at))) && is_straight(frame, above(at)) &&
            is_straight(frame, below(at)))
        {
            return at;
        }
    }
    return side_of(frame, 0);
}

/* A side in a cell of the picture, turned as it is seen there; first is the cell's upper left pixel. */
static void put(cm_surface *surface, side seen, uint32_t first_column, uint32_t first_row)
{
    const unsigned face = face_towards(&surface->frame, seen.outward);
    const side own = side_of(&surface->frame, face);
    cm_placement *place = &surface->placement[face];
    place->picture = 0;
    place->column = first_column;
    place->row = first_row;
    const int exchanged = seen.right != own.right && seen.right != -own.right;
    const int right = exchanged ? own.down : own.right;
    const int down = exchanged ? own.right : own.down;
    place->turn = (exchanged ? CM_TURN_EXCHANGED : 0) |
                  (seen.right != right ? CM_TURN_COLUMNS : 0) |
                  (seen.down != down ? CM_TURN_ROWS : 0);
}

static void put_in_cell(cm_surface *surface, side seen, uint32_t column, uint32_t row)
{
    put(surface, seen, column * surface->width, row * surface->height);
}

/* ---- layouts ---- */

/* Faces as they are, in their order, each with its border. */
static void place_plain(cm_surface *surface, const face_layout *layout, const uint32_t *parameter)
{
    const uint32_t border = parameter[0];
    for (uint32_t face = 0; face < 6; face++)
    {
        cm_placement *place = &surface->placement[face];
        const uint32_t at = layout->pictures == 6 ? 0 : face;
        place->picture = layout->pictures == 6 ? face : 0;
        place->column = at % layout->columns * (surface->width + 2 * border) + border;
        place->row = at / layout->columns * (surface->height + 2 * border) + border;
    }
}

/* Four faces in the middle row, the poles above and below columns of it. */
static void place_cross(cm_surface *surface, const face_layout *layout, const uint32_t *parameter)
{
    (void)layout;
    side at = left_of(middle_of(&surface->frame));
    for (uint32_t column = 0; column < 4; column++)
    {
        put_in_cell(surface, at, column, 1);
        if (parameter[0] == column)
        {
            put_in_cell(surface, above(at), column, 0);
        }
        if (parameter[1] == column)
        {
            put_in_cell(surface, below(at), column, 2);
        }
        at = right_of(at);
    }
}

/* The far face is below the lower pole, so that it is upside down. */
static void place_vertical_cross(cm_surface *surface, const face_layout *layout,
                                 const uint32_t *parameter)
{
    (void)layout;
    (void)parameter;
    const side middle = middle_of(&surface->frame);
    put_in_cell(surface, above(middle), 1, 0);
    put_in_cell(surface, left_of(middle), 0, 1);
    put_in_cell(surface, middle, 1, 1);
    put_in_cell(surface, right_of(middle), 2, 1);
    put_in_cell(surface, below(middle), 1, 2);
    put_in_cell(surface, upside_down(right_of(right_of(middle))), 1, 3);
}

/* As YouTube stores it, by the filter v360 of FFmpeg: left, front and right, and below it bottom, back and top, which
 * follow one another about the cube without a cut, too. Pads are around each of the two rows. */
static void place_equiangular(cm_surface *surface, const face_layout *layout,
                              const uint32_t *parameter)
{
    (void)layout;
    const uint32_t pad = parameter[0];
    const uint32_t lower = 3 * pad + surface->height;
    const uint32_t edge = surface->width;
    const side middle = middle_of(&surface->frame);
    const side far = right_of(right_of(middle));
    put(surface, left_of(middle), pad, pad);
    put(surface, middle, pad + edge, pad);
    put(surface, right_of(middle), pad + 2 * edge, pad);
    put(surface, turned_anticlockwise(below(middle)), pad, lower);
    put(surface, turned_clockwise(far), pad + edge, lower);
    put(surface, turned_anticlockwise(above(middle)), pad + 2 * edge, lower);
}

/* Pixels around each face. */
#define BORDER                                                                                     \
    {"border", NULL}, {0},                                                                         \
    {                                                                                              \
        CM_BORDER_MOST                                                                             \
    }

static const face_layout layouts[] = {
    {"faces", 6, 1, 1, place_plain, BORDER},
    {"strip", 1, 6, 1, place_plain, BORDER},
    {"column", 1, 1, 6, place_plain, BORDER},
    {"3x2", 1, 3, 2, place_plain, BORDER},
    {"2x3", 1, 2, 3, place_plain, BORDER},
    {"cross", 1, 4, 3, place_cross, {"north", "south"}, {1, 1}, {3, 3}},
    {"vcross", 1, 3, 4, place_vertical_cross, {NULL}, {0}, {0}},
    {"eac", 1, 3, 2, place_equiangular, {"pad", NULL}, {0}, {4096}},
};

/* ---- the key ---- */

/* NAME=NUMBER of a layout's parameters. */
static int read_parameter(const face_layout *found, cm_word word, uint32_t *parameter,
                          unsigned *given)
{
    cm_word value;
    double number;
    const cm_word name = cm_word_split(word, '=', &value);
    for (unsigned i = 0; i < 2 && found->parameter[i] != NULL; i++)
    {
        if (cm_word_is(name, found->parameter[i]))
        {
            const int good = value.text != NULL &&
                             cm_number_parse(value.text, value.length, &number) && number >= 0.0 &&
                             number <= found->most[i] && number == (double)(uint32_t)number &&
                             !(*given >> i & 1u);
            parameter[i] = good ? (uint32_t)number : parameter[i];
            *given |= 1u << i;
            return good;
        }
    }
    return 0;
}

static const face_layout *find_layout(const cm_surface_wish *wish, uint32_t parameter[2])
{
    cm_word rest;
    unsigned given = 0;
    const cm_word word = cm_surface_key(wish->words, "layout");
    const cm_word name = cm_word_split(word, ':', &rest);
    const face_layout *found = word.text == NULL ? layouts : NULL;
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++)
    {
        found = cm_word_is(name, layouts[i].identifier) ? &layouts[i] : found;
    }
    if (found != NULL)
    {
        memcpy(parameter, found->standard, sizeof found->standard);
    }
    while (found != NULL && rest.text != NULL)
    {
        const cm_word one = cm_word_split(rest, ',', &rest);
        found = read_parameter(found, one, parameter, &given) ? found : NULL;
    }
    return found;
}

static cm_status say(cm_surface *surface, const face_layout *layout, const uint32_t *parameter)
{
    cm_status status = cm_surface_say(surface, ";layout=%s", layout->identifier);
    char stop = ':';
    for (unsigned i = 0; i < 2 && layout->parameter[i] != NULL && status == CM_OK; i++)
    {
        if (parameter[i] != layout->standard[i])
        {
            status = cm_surface_say(surface, "%c%s=%u", stop, layout->parameter[i],
                                    (unsigned)parameter[i]);
            stop = ',';
        }
    }
    return status;
}

cm_status cm_surface_lay_out(cm_surface *surface, const cm_surface_wish *wish)
{
    uint32_t parameter[2];
    const face_layout *found = find_layout(wish, parameter);
    if (found == NULL)
    {
        return cm_complain(
            wish->complaint, CM_ERROR_PARAMETER,
            "layout=%.*s: there are faces, strip, column, 3x2, 2x3, cross, "
            "cross:north=0..3,south=0..3, vcross, eac and eac:pad=0..4096; the first "
            "five may have :border=0..128",
            CM_SHOWN(cm_surface_key(wish->words, "layout")));
    }
    const uint32_t pad = found->place == place_equiangular ? parameter[0] : 0;
    const uint32_t border = found->place == place_plain ? parameter[0] : 0;
    const cm_plane_grid grid = {found->columns, found->rows, 2 * (pad + border * found->columns),
                                4 * pad + 2 * border * found->rows, 0.0};
    const cm_status status = cm_surface_grid_size(surface, wish, &grid);
    if (status != CM_OK)
    {
        return status;
    }
    surface->pictures = found->pictures;
    found->place(surface, found, parameter);
    return say(surface, found, parameter);
}
