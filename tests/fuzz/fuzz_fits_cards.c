/* SPDX-License-Identifier: MIT
 *
 * Cards of FITS headers. The input is cards of 80 characters, the last one filled with blanks.
 */
#include "modules/image/io/fits_cards.h"
#include "tests/memory_stream.h"

#include "fuzz.h"

/* A text that a card has room for is the same when it was written. */
static void check_text(const cm_fits_pair *pair)
{
    char block[CM_FITS_BLOCK];
    memory_stream memory = {(unsigned char *)block, 0, sizeof block, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_fits_head head = {.stream = &stream, .good = true};
    cm_fits_pair again;
    size_t room = strlen(pair->value);
    for (const char *c = pair->value; *c != '\0'; c++)
    {
        room += *c == '\'';
    }
    cm_fits_card_text(&head, pair->key, pair->value);
    EXPECT(head.good == (room <= CM_FITS_TEXT - 1), "%s", pair->value);
    if (head.good)
    {
        EXPECT(cm_fits_end(&head) && memory.size == sizeof block, "%zu bytes", memory.size);
        EXPECT(cm_fits_split(block, &again), "%.80s", block);
        EXPECT(strcmp(again.value, pair->value) == 0 && strcmp(again.key, pair->key) == 0, "%.80s",
               block);
    }
}

static void check_card(const char card[CM_FITS_CARD])
{
    cm_fits_pair pair;
    int64_t whole = 0;
    double real = 0.0;
    if (!cm_fits_split(card, &pair))
    {
        return;
    }
    EXPECT(memchr(pair.key, '\0', sizeof pair.key) != NULL &&
               memchr(pair.value, '\0', sizeof pair.value) != NULL,
           "no end");
    EXPECT(is_one_line(pair.key) && is_one_line(pair.value), "%s", pair.value);
    if (cm_fits_whole(&pair, &whole))
    {
        char key[CM_FITS_KEY];
        char block[CM_FITS_CARD];
        memory_stream memory = {(unsigned char *)block, 0, sizeof block, 0};
        const cm_image_stream stream = stream_of(&memory);
        cm_fits_head head = {.stream = &stream, .good = true};
        cm_fits_pair again;
        int64_t same = 0;
        memcpy(key, pair.key, sizeof key);
        cm_fits_card_number(&head, key, whole);
        EXPECT(head.good && cm_fits_split(block, &again) && cm_fits_whole(&again, &same) &&
                   same == whole,
               "%.80s", block);
        EXPECT(cm_fits_real(&pair, &real), "%s", pair.value);
    }
    (void)cm_fits_real(&pair, &real);
    check_text(&pair);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    for (size_t at = 0; at < size; at += CM_FITS_CARD)
    {
        char card[CM_FITS_CARD];
        const size_t left = size - at < CM_FITS_CARD ? size - at : CM_FITS_CARD;
        memset(card, ' ', sizeof card);
        memcpy(card, data + at, left);
        check_card(card);
    }
    return 0;
}
