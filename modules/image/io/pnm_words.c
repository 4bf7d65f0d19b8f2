/* SPDX-License-Identifier: MIT */
#include "pnm_words.h"

#include "file_words.h"

#include <cubemap/number.h>

#include <float.h>
#include <stdio.h>

/* No word or line of a header is longer. */
#define LINE_MOST 1024

/* Nor are blanks and comments before a word, which need no room. */
#define COMMENTS_MOST (1u << 20)

cm_status cm_pnm_check(const cm_pnm_picture *picture, char *message)
{
    static const char *const wanted[] = {"one channel of 8 or 16 bits",
                                         "three channels of 8 or 16 bits", "8 or 16 bits",
                                         "one or three channels of floats", "a type of samples"};
    if (picture == NULL || picture->size != sizeof *picture ||
        (unsigned)picture->kind > CM_PNM_RAW || picture->width < 1 || picture->height < 1 ||
        picture->width > CM_PNM_SIZE_MOST || picture->height > CM_PNM_SIZE_MOST ||
        picture->channels < 1 || picture->channels > CM_CHANNELS_MAX)
    {
        cm_file_fail(message, "cannot have such a size: 1 to %d pixels each, 1 to %d channels",
                     CM_PNM_SIZE_MOST, CM_CHANNELS_MAX);
        return CM_ERROR_ARGUMENT;
    }
    const uint32_t channels = picture->channels;
    const bool whole = picture->type == CM_PIXEL_U8 || picture->type == CM_PIXEL_U16;
    const bool good[] = {whole && channels == 1, whole && channels == 3,
                         whole && (!picture->alpha || channels == 2 || channels == 4),
                         picture->type == CM_PIXEL_FLOAT && (channels == 1 || channels == 3),
                         cm_file_sample_size(picture->type) != 0};
    if (!good[picture->kind])
    {
        cm_file_fail(message, "cannot have these channels or samples: it has %s",
                     wanted[picture->kind]);
        return CM_ERROR_ARGUMENT;
    }
    return CM_OK;
}

/* ---- reading ---- */

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static cm_status ends(char *message)
{
    return cm_file_fail(message, "ends too early, in a header");
}

static cm_status wrong_header(char *message, const char *what)
{
    return cm_file_fail(message, "has a damaged header: %s", what);
}

/* The next word, behind blanks and comments, and the one blank behind it. */
static cm_status take_word(const cm_image_stream *stream, bool comments, char *word, size_t room,
                           char *message)
{
    size_t count = 0;
    bool comment = false;
    for (unsigned read = 0; read < COMMENTS_MOST; read++)
    {
        char c;
        if (!cm_file_take(stream, &c, 1))
        {
            return ends(message);
        }
        if (comment)
        {
            comment = c != '\n' && c != '\r';
        }
        else if (c == '#' && comments && count == 0)
        {
            comment = true;
        }
        else if (is_blank(c))
        {
            if (count > 0)
            {
                word[count] = '\0';
                return CM_OK;
            }
        }
        else if (count + 1 < room)
        {
            word[count++] = c;
        }
        else
        {
            return wrong_header(message, "a word is too long");
        }
    }
    return wrong_header(message, "a comment is too long");
}

/* A whole number from 1 to most. */
static bool number_of(const char *word, uint32_t most, uint32_t *number)
{
    uint32_t value = 0;
    const char *at = word;
    for (; *at >= '0' && *at <= '9'; at++)
    {
        value = value * 10 + (uint32_t)(*at - '0');
        if (value > most)
        {
            return false;
        }
    }
    if (at == word || *at != '\0' || value < 1)
    {
        return false;
    }
    *number = value;
    return true;
}

static cm_status take_number(const cm_image_stream *stream, const char *name, uint32_t most,
                             uint32_t *number, char *message)
{
    char word[16];
    const cm_status status = take_word(stream, true, word, sizeof word, message);
    if (status == CM_OK && !number_of(word, most, number))
    {
        return cm_file_fail(message, "has a damaged header: %s is '%s' and not 1 to %lu", name,
                            word, (unsigned long)most);
    }
    return status;
}

static cm_status take_sizes(const cm_image_stream *stream, cm_pnm_picture *picture, char *message)
{
    const cm_status status =
        take_number(stream, "the width", CM_PNM_SIZE_MOST, &picture->width, message);
    return status == CM_OK
               ? take_number(stream, "the height", CM_PNM_SIZE_MOST, &picture->height, message)
               : status;
}

static cm_status read_pfm(const cm_image_stream *stream, cm_pnm_picture *picture, char *message)
{
    char word[64];
    double scale = 0.0;
    cm_status status = take_sizes(stream, picture, message);
    status = status == CM_OK ? take_word(stream, false, word, sizeof word, message) : status;
    if (status != CM_OK)
    {
        return status;
    }
    const bool is_number = cm_number_parse(word, strlen(word), &scale) != 0;
    const double absolute = scale < 0.0 ? -scale : scale;
    if (!is_number || !(absolute >= (double)FLT_MIN && absolute <= (double)FLT_MAX))
    {
        return cm_file_fail(message,
                            "has a damaged header: the scale is '%s' and no number of a float but "
                            "0",
                            word);
    }
    picture->type = CM_PIXEL_FLOAT;
    picture->little_endian = scale < 0.0;
    picture->scale = (float)absolute;
    picture->bottom_up = 1;
    return CM_OK;
}

/* A line without its end. */
static cm_status take_line(const cm_image_stream *stream, char *line, char *message)
{
    for (size_t count = 0; count < LINE_MOST; count++)
    {
        if (!cm_file_take(stream, line + count, 1))
        {
            return ends(message);
        }
        if (line[count] == '\n')
        {
            line[count] = '\0';
            return CM_OK;
        }
    }
    return wrong_header(message, "a line is too long");
}

/* What stands behind a name in a line of PAM, or NULL; blanks at its end are cut. */
static char *value_of(char *line, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(line, name, length) != 0 || !is_blank(line[length]))
    {
        return NULL;
    }
    char *value = line + length;
    while (is_blank(*value))
    {
        value++;
    }
    for (size_t end = strlen(value); end > 0 && is_blank(value[end - 1]); end--)
    {
        value[end - 1] = '\0';
    }
    return value;
}

static cm_status read_pam_line(char *line, cm_pnm_picture *picture, char *message)
{
    static const char *const names[] = {"WIDTH", "HEIGHT", "DEPTH", "MAXVAL"};
    static const uint32_t most[] = {CM_PNM_SIZE_MOST, CM_PNM_SIZE_MOST, CM_CHANNELS_MAX,
                                    UINT16_MAX};
    uint32_t *const numbers[] = {&picture->width, &picture->height, &picture->channels,
                                 &picture->maximum};
    for (unsigned i = 0; i < 4; i++)
    {
        const char *const value = value_of(line, names[i]);
        if (value != NULL)
        {
            return number_of(value, most[i], numbers[i])
                       ? CM_OK
                       : cm_file_fail(message, "has a damaged header: %s is '%s' and not 1 to %lu",
                                      names[i], value, (unsigned long)most[i]);
        }
    }
    const char *const type = value_of(line, "TUPLTYPE");
    if (type != NULL)
    {
        const size_t length = strlen(type);
        picture->alpha = length >= 6 && strcmp(type + length - 6, "_ALPHA") == 0;
        return CM_OK;
    }
    return cm_file_fail(message, "has a damaged header: the line '%.100s' is none of PAM", line);
}

static bool is_only_blanks(const char *line)
{
    while (is_blank(*line))
    {
        line++;
    }
    return *line == '\0';
}

static cm_status read_pam(const cm_image_stream *stream, cm_pnm_picture *picture, char *message)
{
    char line[LINE_MOST];
    for (unsigned count = 0; count < LINE_MOST; count++)
    {
        cm_status status = take_line(stream, line, message);
        if (status != CM_OK)
        {
            return status;
        }
        if (strcmp(line, "ENDHDR") == 0)
        {
            if (picture->width == 0 || picture->height == 0 || picture->channels == 0 ||
                picture->maximum == 0)
            {
                return wrong_header(message, "WIDTH, HEIGHT, DEPTH or MAXVAL is missing");
            }
            picture->alpha &= picture->channels == 2 || picture->channels == 4;
            return CM_OK;
        }
        status =
            line[0] == '#' || is_only_blanks(line) ? CM_OK : read_pam_line(line, picture, message);
        if (status != CM_OK)
        {
            return status;
        }
    }
    return wrong_header(message, "it has too many lines");
}

cm_status cm_pnm_read_header(const cm_image_stream *stream, char first, cm_pnm_picture *picture,
                             char *message)
{
    static const char letters[] = {'5', '6', '7', 'f', 'F'};
    static const cm_pnm_kind kinds[] = {CM_PNM_PGM, CM_PNM_PPM, CM_PNM_PAM, CM_PNM_PFM, CM_PNM_PFM};
    char rest[2];
    if (!cm_file_take(stream, rest, sizeof rest))
    {
        return ends(message);
    }
    const char *const letter = memchr(letters, rest[0], sizeof letters);
    if (first != 'P' || letter == NULL || !(is_blank(rest[1]) || rest[1] == '#'))
    {
        return cm_file_fail(message,
                            "has no picture that begins with P5, P6, P7, Pf or PF, but "
                            "'%c%c'",
                            first, rest[0]);
    }
    picture->kind = kinds[letter - letters];
    picture->channels = *letter == '6' || *letter == 'F' ? 3 : 1;
    picture->scale = 1.0F;
    if (picture->kind == CM_PNM_PFM)
    {
        return read_pfm(stream, picture, message);
    }
    if (picture->kind == CM_PNM_PAM)
    {
        picture->channels = 0;
        if (rest[1] != '\n')
        {
            return wrong_header(message, "P7 is not a line");
        }
    }
    if (rest[1] == '#')
    {
        return wrong_header(message, "a comment touches the first word");
    }
    cm_status status = picture->kind == CM_PNM_PAM ? read_pam(stream, picture, message)
                                                   : take_sizes(stream, picture, message);
    if (status == CM_OK && picture->kind != CM_PNM_PAM)
    {
        status = take_number(stream, "the largest value", UINT16_MAX, &picture->maximum, message);
    }
    picture->type = picture->maximum > UINT8_MAX ? CM_PIXEL_U16 : CM_PIXEL_U8;
    return status;
}

/* ---- writing ---- */

static const char *tuple_type(const cm_pnm_picture *picture)
{
    switch (picture->channels)
    {
    case 1:
        return "TUPLTYPE GRAYSCALE\n";
    case 2:
        return picture->alpha ? "TUPLTYPE GRAYSCALE_ALPHA\n" : "";
    case 3:
        return "TUPLTYPE RGB\n";
    case 4:
        return picture->alpha ? "TUPLTYPE RGB_ALPHA\n" : "";
    default:
        return "";
    }
}

cm_status cm_pnm_write_header(const cm_image_stream *stream, const cm_pnm_picture *picture,
                              char *message)
{
    const cm_status status = cm_pnm_check(picture, message);
    if (status != CM_OK)
    {
        return status;
    }
    if (stream == NULL || stream->write == NULL)
    {
        cm_file_fail(message, "cannot be written: no stream");
        return CM_ERROR_ARGUMENT;
    }
    char text[256];
    const char *const comments =
        picture->comments != NULL && picture->kind <= CM_PNM_PAM ? picture->comments : "";
    const size_t first_line = strlen("P6\n");
    const unsigned long width = picture->width;
    const unsigned long height = picture->height;
    const unsigned maximum = picture->type == CM_PIXEL_U8 ? UINT8_MAX : UINT16_MAX;
    text[0] = '\0';
    switch (picture->kind)
    {
    case CM_PNM_PGM:
    case CM_PNM_PPM:
        snprintf(text, sizeof text, "P%c\n%lu %lu\n%u\n", picture->kind == CM_PNM_PGM ? '5' : '6',
                 width, height, maximum);
        break;
    case CM_PNM_PAM:
        snprintf(text, sizeof text, "P7\nWIDTH %lu\nHEIGHT %lu\nDEPTH %lu\nMAXVAL %u\n%sENDHDR\n",
                 width, height, (unsigned long)picture->channels, maximum, tuple_type(picture));
        break;
    case CM_PNM_PFM:
        snprintf(text, sizeof text, "P%c\n%lu %lu\n%s\n", picture->channels == 3 ? 'F' : 'f', width,
                 height, picture->little_endian ? "-1.0" : "1.0");
        break;
    default:
        break;
    }
    /* behind the first line */
    const size_t before = *comments != '\0' ? first_line : 0;
    return cm_file_put(stream, text, before) && cm_file_put(stream, comments, strlen(comments)) &&
                   cm_file_put(stream, text + before, strlen(text + before))
               ? CM_OK
               : cm_file_fail(message, "cannot be written: no more bytes are taken");
}
