/* SPDX-License-Identifier: MIT
 *
 * Headers of FITS ("Definition of the Flexible Image Transport System", version 4.0, sections 3 and 4): cards of 80
 * characters in blocks of 2880 bytes.
 */
#ifndef CUBEMAP_MODULES_IMAGE_FITS_CARDS_H
#define CUBEMAP_MODULES_IMAGE_FITS_CARDS_H

#include "image_io.h"

enum
{
    CM_FITS_CARD = 80,
    CM_FITS_BLOCK = 2880,
    CM_FITS_KEY = 9,  /* of a keyword with its zero byte */
    CM_FITS_TEXT = 69 /* of a value with its zero byte */
};

/* A header that is written. */
typedef struct cm_fits_head
{
    const cm_image_stream *stream;
    uint64_t cards; /* how many there are */
    bool good;      /* did the stream take them all? */
} cm_fits_head;

/* One card: a value as it stands in a file, right-aligned to column 30; a whole number; a text, which is put in quotes
 * and must fit. */
void cm_fits_card(cm_fits_head *head, const char *key, const char *value);
void cm_fits_card_number(cm_fits_head *head, const char *key, int64_t number);
void cm_fits_card_text(cm_fits_head *head, const char *key, const char *text);

/* END and blanks to the block's end; were all cards taken? */
bool cm_fits_end(cm_fits_head *head);

/* Zero bytes from where data of size bytes end to the block's end. */
bool cm_fits_fill(const cm_image_stream *stream, uint64_t size);

/* A card that was read: its keyword, and its value without quotes, blanks at its end or comment. */
typedef struct cm_fits_pair
{
    char key[CM_FITS_KEY];
    char value[CM_FITS_TEXT];
} cm_fits_pair;

/* Split a card of 80 characters; a card without "= " has an empty value. False if it has characters that FITS forbids or a
 * quote is not closed. */
bool cm_fits_split(const char *card, cm_fits_pair *pair);

/* Is the value a whole number, or a number? */
bool cm_fits_whole(const cm_fits_pair *pair, int64_t *number);
bool cm_fits_real(const cm_fits_pair *pair, double *number);

#endif
