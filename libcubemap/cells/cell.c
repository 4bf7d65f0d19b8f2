/* SPDX-License-Identifier: MIT
 *
 * The numbers of cells: what follows from their bits, their places on a face, and their texts.
 */
#include "cell_shape.h"
#include "libcubemap/mapping/catalogue_words.h"
#include "libcubemap/mapping/message.h"

#include <string.h>

#define CURVE_WORD uint64_t
#define CURVE_HALF uint64_t
#define CURVE_NAME(name) curve_##name
#include "libcubemap/batch/curve.inc"

#define DIGITS 60 /* bits that say which quarter */

static const char *const curve_names[] = {"hilbert", "morton"};

const char *cm_curve_name(cm_curve curve)
{
    return cm_curve_is_valid(curve) ? curve_names[curve] : NULL;
}

cm_status cm_curve_find(const char *name, cm_curve *curve)
{
    if (name == NULL || curve == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (int i = 0; i < 2; i++)
    {
        if (cm_word_equal(name, strlen(name), curve_names[i], strlen(curve_names[i])))
        {
            *curve = (cm_curve)i;
            return CM_OK;
        }
    }
    return CM_ERROR_CELL;
}

/* ---- Bits ---- */

/* The last bit that is 1. */
static uint64_t end_of(cm_cell cell)
{
    return cell & -cell;
}

static uint64_t end_at(int level)
{
    return 1ull << (2 * (CM_CELL_LEVEL_MAX - level));
}

static int is_level(int level)
{
    return level >= 0 && level <= CM_CELL_LEVEL_MAX;
}

int cm_cell_is_valid(cm_cell cell)
{
    return (cell >> 61) < 6 && (end_of(cell) & 0x1555555555555555ull) != 0;
}

int cm_cell_level(cm_cell cell)
{
    if (!cm_cell_is_valid(cell))
    {
        return -1;
    }
    /* of a power of four the bits below it are twice as many as levels below the cell's */
    uint64_t size = curve_gather(end_of(cell));
    int level = CM_CELL_LEVEL_MAX;
    for (int step = 16; step > 0; step /= 2)
    {
        if (size >> step != 0)
        {
            size >>= step;
            level -= step;
        }
    }
    return level;
}

uint8_t cm_cell_face(cm_cell cell)
{
    return cm_cell_is_valid(cell) ? (uint8_t)(cell >> 61) : CM_NO_FACE;
}

cm_cell cm_cell_parent(cm_cell cell, int level)
{
    if (!is_level(level) || !cm_cell_is_valid(cell) || end_of(cell) > end_at(level))
    {
        return CM_NO_CELL;
    }
    return (cell & -end_at(level)) | end_at(level);
}

cm_cell cm_cell_child(cm_cell cell, int which)
{
    uint64_t end = end_of(cell);
    if (!cm_cell_is_valid(cell) || end == 1 || which < 0 || which > 3)
    {
        return CM_NO_CELL;
    }
    return cell - end + (2 * (uint64_t)which + 1) * (end >> 2);
}

cm_cell cm_cell_first_leaf(cm_cell cell)
{
    return cm_cell_is_valid(cell) ? cell - (end_of(cell) - 1) : CM_NO_CELL;
}

cm_cell cm_cell_last_leaf(cm_cell cell)
{
    return cm_cell_is_valid(cell) ? cell + (end_of(cell) - 1) : CM_NO_CELL;
}

int cm_cell_contains(cm_cell cell, cm_cell other)
{
    return cm_cell_is_valid(cell) && cm_cell_is_valid(other) && other >= cm_cell_first_leaf(cell) &&
           other <= cm_cell_last_leaf(cell);
}

int cm_cell_intersects(cm_cell cell, cm_cell other)
{
    return cm_cell_contains(cell, other) || cm_cell_contains(other, cell);
}

cm_cell cm_cell_common_parent(cm_cell cell, cm_cell other)
{
    if (!cm_cell_is_valid(cell) || !cm_cell_is_valid(other) || cell >> 61 != other >> 61)
    {
        return CM_NO_CELL;
    }
    /* up to the size of the larger one, and further until nothing above differs */
    uint64_t end = end_of(cell) > end_of(other) ? end_of(cell) : end_of(other);
    while (((cell ^ other) & -(end << 1)) != 0)
    {
        end <<= 2;
    }
    return (cell & -end) | end;
}

uint64_t cm_cell_index(cm_cell cell)
{
    int level = cm_cell_level(cell);
    return level < 0 ? UINT64_MAX : cell >> (DIGITS + 1 - 2 * level);
}

cm_cell cm_cell_at_index(int level, uint64_t index)
{
    if (!is_level(level) || index >= 6ull << (2 * level))
    {
        return CM_NO_CELL;
    }
    return (index << (DIGITS + 1 - 2 * level)) | end_at(level);
}

cm_cell cm_cell_advance(cm_cell cell, int64_t steps)
{
    int level = cm_cell_level(cell);
    if (level < 0)
    {
        return CM_NO_CELL;
    }
    uint64_t count = 6ull << (2 * level);
    uint64_t forward = steps < 0 ? count - (0 - (uint64_t)steps) % count : (uint64_t)steps % count;
    return cm_cell_at_index(level, (cm_cell_index(cell) + forward) % count);
}

/* ---- Places ---- */

cm_cell cm_cell_from_place(cm_curve curve, const cm_cell_place *place)
{
    if (place == NULL || !cm_curve_is_valid(curve) || place->face > 5 ||
        place->level > CM_CELL_LEVEL_MAX || place->i >> place->level != 0 ||
        place->j >> place->level != 0)
    {
        return CM_NO_CELL;
    }
    int up = CM_CELL_LEVEL_MAX - place->level;
    uint64_t i = (uint64_t)place->i << up;
    uint64_t j = (uint64_t)place->j << up;
    uint64_t at = curve_morton(i, j);
    if (curve == CM_CURVE_HILBERT)
    {
        curve_mirror(place->face, &i, &j);
        at = curve_hilbert(curve_hilbert_bits(i, j), i ^ j);
    }
    return (curve_leaf(place->face, at) & -end_at(place->level)) | end_at(place->level);
}

cm_status cm_cell_to_place(cm_curve curve, cm_cell cell, cm_cell_place *place)
{
    if (place == NULL || !cm_curve_is_valid(curve))
    {
        return CM_ERROR_ARGUMENT;
    }
    int level = cm_cell_level(cell);
    if (level < 0)
    {
        return CM_ERROR_CELL;
    }
    uint64_t face, i, j;
    curve_corner(curve == CM_CURVE_HILBERT, cell, &face, &i, &j);
    place->face = (uint8_t)face;
    place->level = (uint8_t)level;
    place->i = (uint32_t)(i >> (CM_CELL_LEVEL_MAX - level));
    place->j = (uint32_t)(j >> (CM_CELL_LEVEL_MAX - level));
    return CM_OK;
}

cm_status cm_cell_square(cm_curve curve, cm_cell cell, uint8_t *face, double low[2], double high[2])
{
    cm_cell_place place;
    if (face == NULL || low == NULL || high == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_cell_to_place(curve, cell, &place);
    if (status != CM_OK)
    {
        return status;
    }
    double size = ldexp(1.0, 1 - place.level);
    *face = place.face;
    low[0] = place.i * size - 1.0;
    low[1] = place.j * size - 1.0;
    high[0] = (place.i + 1.0) * size - 1.0;
    high[1] = (place.j + 1.0) * size - 1.0;
    return CM_OK;
}

/* ---- Text ---- */

cm_status cm_cell_token(cm_cell cell, char *text, size_t size)
{
    char token[CM_CELL_TOKEN_SIZE] = "X";
    if (text == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cell != CM_NO_CELL)
    {
        if (!cm_cell_is_valid(cell))
        {
            return CM_ERROR_CELL;
        }
        size_t length = 0;
        for (uint64_t rest = cell; rest != 0; rest <<= 4)
        {
            token[length++] = "0123456789abcdef"[rest >> 60];
        }
        token[length] = '\0';
    }
    if (size < strlen(token) + 1)
    {
        return CM_ERROR_SPACE;
    }
    memcpy(text, token, strlen(token) + 1);
    return CM_OK;
}

/* -1 for no digit */
static int digit_of(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

cm_status cm_cell_parse(const char *text, cm_cell *cell, char *message, size_t message_size)
{
    if (text == NULL || cell == NULL)
    {
        return cm_fail(CM_ERROR_ARGUMENT, message, message_size, "a cell's text is NULL");
    }
    cm_cell read = CM_NO_CELL;
    size_t length = 0;
    if (strcmp(text, "X") == 0 || strcmp(text, "x") == 0)
    {
        *cell = CM_NO_CELL;
        return CM_OK;
    }
    for (; length < 16 && digit_of(text[length]) >= 0; length++)
    {
        read |= (uint64_t)digit_of(text[length]) << (60 - 4 * length);
    }
    if (length == 0 || text[length] != '\0')
    {
        return cm_fail(CM_ERROR_CELL, message, message_size,
                       "'%.40s' is no cell: a token is 1 to 16 hexadecimal digits, or X", text);
    }
    if (!cm_cell_is_valid(read))
    {
        return cm_fail(
            CM_ERROR_CELL, message, message_size,
            "'%.40s' is the number of no cell: a face from 0 to 5, two bits a level, one "
            "bit and zeros",
            text);
    }
    *cell = read;
    return CM_OK;
}
