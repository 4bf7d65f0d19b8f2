/* SPDX-License-Identifier: MIT */
#include "fits_cards.h"

#include "file_words.h"

#include <cubemap/number.h>

#include <inttypes.h>
#include <stdio.h>

/* ---- writing ---- */

static void put_card(cm_fits_head *head, const char *text)
{
    char card[CM_FITS_CARD];
    const size_t length = strlen(text);
    memset(card, ' ', sizeof card);
    memcpy(card, text, length < sizeof card ? length : sizeof card);
    head->good = head->good && cm_file_put(head->stream, card, sizeof card);
    head->cards++;
}

void cm_fits_card(cm_fits_head *head, const char *key, const char *value)
{
    char text[CM_FITS_CARD + 1];
    snprintf(text, sizeof text, "%-8.8s= %20s", key, value);
    put_card(head, text);
}

void cm_fits_card_number(cm_fits_head *head, const char *key, int64_t number)
{
    char value[24];
    snprintf(value, sizeof value, "%" PRId64, number);
    cm_fits_card(head, key, value);
}

/* A quote inside is two; texts have eight characters at least (section 4.2.1.1). */
void cm_fits_card_text(cm_fits_head *head, const char *key, const char *text)
{
    char quoted[2 * CM_FITS_TEXT];
    size_t length = 0;
    for (const char *c = text; *c != '\0' && length + 2 < sizeof quoted; c++)
    {
        quoted[length++] = *c;
        if (*c == '\'')
        {
            quoted[length++] = '\'';
        }
    }
    quoted[length] = '\0';
    char card[2 * CM_FITS_TEXT + 16];
    snprintf(card, sizeof card, "%-8.8s= '%-8s'", key, quoted);
    head->good = head->good && strlen(card) <= CM_FITS_CARD;
    put_card(head, card);
}

bool cm_fits_end(cm_fits_head *head)
{
    put_card(head, "END");
    while (head->good && head->cards % (CM_FITS_BLOCK / CM_FITS_CARD) != 0)
    {
        put_card(head, "");
    }
    return head->good;
}

bool cm_fits_fill(const cm_image_stream *stream, uint64_t size)
{
    return cm_file_pad(stream, (CM_FITS_BLOCK - (size_t)(size % CM_FITS_BLOCK)) % CM_FITS_BLOCK);
}

/* ---- reading ---- */

static void cut_blanks(char *text)
{
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == ' ')
    {
        text[--length] = '\0';
    }
}

/* A text, from behind its first quote. One that is not closed may have no zero byte. */
static bool split_text(const char *at, const char *end, char *value)
{
    size_t length = 0;
    for (; at < end; at++)
    {
        if (*at == '\'')
        {
            if (at + 1 >= end || at[1] != '\'')
            {
                value[length] = '\0';
                return true;
            }
            at++;
        }
        value[length++] = *at;
    }
    return false;
}

bool cm_fits_split(const char *card, cm_fits_pair *pair)
{
    for (unsigned i = 0; i < CM_FITS_CARD; i++)
    {
        if ((unsigned char)card[i] < 0x20 || (unsigned char)card[i] > 0x7e)
        {
            return false;
        }
    }
    memset(pair, 0, sizeof *pair);
    memcpy(pair->key, card, 8);
    cut_blanks(pair->key);
    if (card[8] != '=' || card[9] != ' ')
    {
        return true;
    }
    const char *const end = card + CM_FITS_CARD;
    const char *at = card + 10;
    while (at < end && *at == ' ')
    {
        at++;
    }
    if (at < end && *at == '\'')
    {
        if (!split_text(at + 1, end, pair->value))
        {
            return false;
        }
    }
    else
    {
        for (size_t length = 0; at < end && *at != '/' && length + 1 < CM_FITS_TEXT; at++)
        {
            pair->value[length++] = *at;
        }
    }
    cut_blanks(pair->value);
    return true;
}

bool cm_fits_real(const cm_fits_pair *pair, double *number)
{
    char text[CM_FITS_TEXT];
    memcpy(text, pair->value, sizeof text);
    for (char *c = text; *c != '\0'; c++)
    {
        *c = *c == 'D' || *c == 'd' ? 'e' : *c; /* section 4.2.4 */
    }
    return cm_number_parse(text, strlen(text), number) != 0;
}

bool cm_fits_whole(const cm_fits_pair *pair, int64_t *number)
{
    const char *at = pair->value;
    const bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    if (*at == '\0')
    {
        return false;
    }
    int64_t value = 0;
    for (; *at != '\0'; at++)
    {
        if (*at < '0' || *at > '9' || value > (INT64_MAX - 9) / 10)
        {
            return false;
        }
        value = value * 10 + (*at - '0');
    }
    *number = negative ? -value : value;
    return true;
}
