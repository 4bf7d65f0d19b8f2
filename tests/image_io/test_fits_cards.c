/* SPDX-License-Identifier: MIT
 *
 * Headers of FITS: cards as section 4.2 of the standard (version 4.0) has them, written and read.
 */
#include "modules/image/io/fits_cards.h"

#include "tests/memory_stream.h"
#include "tests/suite.h"

enum
{
    ROOM = 2 * CM_FITS_BLOCK
};

typedef struct page
{
    unsigned char bytes[ROOM];
    memory_stream memory;
    cm_image_stream stream;
    cm_fits_head head;
} page;

/* room: how many bytes the stream takes. */
static void begin(page *to, size_t room)
{
    memset(to, 0, sizeof *to);
    to->memory = (memory_stream){.bytes = to->bytes, .room = room};
    to->stream = stream_of(&to->memory);
    to->head = (cm_fits_head){&to->stream, 0, true};
}

static void check_card(const page *of, size_t number, const char *text)
{
    char wanted[CM_FITS_CARD + 1];
    snprintf(wanted, sizeof wanted, "%-80s", text);
    REQUIRE(memcmp(of->bytes + number * CM_FITS_CARD, wanted, CM_FITS_CARD) == 0,
            "card %zu is \"%.80s\", not \"%s\"", number,
            (const char *)of->bytes + number * CM_FITS_CARD, wanted);
}

/* Values end in column 30, texts begin in column 11 and are 8 characters wide at least, a quote is two. */
START_TEST(cards_are_as_the_standard_has_them)
{
    page to;
    begin(&to, ROOM);
    cm_fits_card(&to.head, "SIMPLE", "T");
    cm_fits_card_number(&to.head, "BITPIX", -32);
    cm_fits_card_number(&to.head, "BIG", INT64_MIN);
    cm_fits_card_text(&to.head, "ORDERING", "RING");
    cm_fits_card_text(&to.head, "OBJECT", "O'Neill's");
    cm_fits_card_text(&to.head, "EMPTY", "");
    cm_fits_card(&to.head, "TOOLONGAKEY", "1");
    ck_assert(cm_fits_end(&to.head));
    check_card(&to, 0, "SIMPLE  =                    T");
    check_card(&to, 1, "BITPIX  =                  -32");
    check_card(&to, 2, "BIG     = -9223372036854775808");
    check_card(&to, 3, "ORDERING= 'RING    '");
    check_card(&to, 4, "OBJECT  = 'O''Neill''s'");
    check_card(&to, 5, "EMPTY   = '        '");
    check_card(&to, 6, "TOOLONGA=                    1");
    check_card(&to, 7, "END");
    check_card(&to, CM_FITS_BLOCK / CM_FITS_CARD - 1, "");
    ck_assert_uint_eq(to.memory.size, CM_FITS_BLOCK);
}
END_TEST

/* A head that ends with its block has no further one, one with a card more has. */
START_TEST(heads_end_with_a_block)
{
    const unsigned cards[2] = {CM_FITS_BLOCK / CM_FITS_CARD - 1, CM_FITS_BLOCK / CM_FITS_CARD};
    for (unsigned k = 0; k < 2; k++)
    {
        page to;
        begin(&to, ROOM);
        for (unsigned i = 0; i < cards[k]; i++)
        {
            cm_fits_card_number(&to.head, "KEY", i);
        }
        ck_assert(cm_fits_end(&to.head));
        ck_assert_uint_eq(to.memory.size, (k + 1) * CM_FITS_BLOCK);
    }
}
END_TEST

START_TEST(data_are_filled_to_a_block)
{
    const uint64_t sizes[] = {
        0, 1, CM_FITS_BLOCK - 1, CM_FITS_BLOCK, CM_FITS_BLOCK + 1, (uint64_t)1 << 40};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    {
        page to;
        begin(&to, ROOM);
        ck_assert(cm_fits_fill(&to.stream, sizes[i]));
        ck_assert_uint_eq((sizes[i] + to.memory.size) % CM_FITS_BLOCK, 0);
        ck_assert_uint_lt(to.memory.size, CM_FITS_BLOCK);
    }
    page full;
    begin(&full, 10);
    ck_assert(!cm_fits_fill(&full.stream, 1));
}
END_TEST

/* A stream that is full, and a text that does not fit, are not forgotten. */
START_TEST(failures_stay)
{
    page to;
    begin(&to, CM_FITS_CARD);
    cm_fits_card(&to.head, "SIMPLE", "T");
    ck_assert(to.head.good);
    cm_fits_card(&to.head, "NAXIS", "0");
    ck_assert(!to.head.good && !cm_fits_end(&to.head));

    /* 68 characters fit between the quotes */
    char text[CM_FITS_CARD + 1];
    memset(text, 'x', sizeof text);
    text[68] = '\0';
    begin(&to, ROOM);
    cm_fits_card_text(&to.head, "LONG", text);
    ck_assert(cm_fits_end(&to.head));
    text[68] = 'x';
    text[69] = '\0';
    begin(&to, ROOM);
    cm_fits_card_text(&to.head, "LONGER", text);
    ck_assert(!cm_fits_end(&to.head));
    /* however long it is */
    char longest[1000];
    memset(longest, '\'', sizeof longest);
    longest[sizeof longest - 1] = '\0';
    begin(&to, ROOM);
    cm_fits_card_text(&to.head, "LONGEST", longest);
    ck_assert(!to.head.good);
}
END_TEST

static bool split(const char *text, cm_fits_pair *pair)
{
    char card[CM_FITS_CARD + 1];
    snprintf(card, sizeof card, "%-80s", text);
    return cm_fits_split(card, pair);
}

START_TEST(cards_are_split)
{
    static const struct
    {
        const char *card, *key, *value;
    } good[] = {
        {"SIMPLE  =                    T / conforms", "SIMPLE", "T"},
        {"NAXIS   = 2/no blank", "NAXIS", "2"},
        {"ORDERING= 'RING    '           / pixels", "ORDERING", "RING"},
        {"OBJECT  = 'O''Neill''s'", "OBJECT", "O'Neill's"},
        {"SLASH   = 'a/b'", "SLASH", "a/b"},
        {"LEADING = '  two'", "LEADING", "  two"},
        {"EMPTY   = ''", "EMPTY", ""},
        {"NOTHING = ", "NOTHING", ""},
        {"COMMENT = is not a value", "COMMENT", "is not a value"},
        {"HISTORY   made by hand", "HISTORY", ""},
        {"NOBLANK =1", "NOBLANK", ""},
        {"END", "END", ""},
        {"", "", ""},
        {"LONG    = 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'", "LONG",
         "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"},
        {"WIDE    = xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx", "WIDE",
         "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
    {
        cm_fits_pair pair;
        REQUIRE(split(good[i].card, &pair), "%s", good[i].card);
        ck_assert_str_eq(pair.key, good[i].key);
        ck_assert_str_eq(pair.value, good[i].value);
    }
    const char *const bad[] = {
        "OPEN    = 'no end",
        "OPEN    = 'a quote''",
        "FULL    = 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx",
        "TAB     = \t1",
        "HIGH    = \xe9",
        "DELETE  = \x7f"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        cm_fits_pair pair;
        REQUIRE(!split(bad[i], &pair), "%s", bad[i]);
    }
}
END_TEST

START_TEST(what_is_written_is_read)
{
    page to;
    begin(&to, ROOM);
    cm_fits_card_text(&to.head, "TEXT", "it's");
    cm_fits_card_number(&to.head, "NUMBER", -INT64_C(9000000000000000000));
    cm_fits_card(&to.head, "REAL", "1.5E-3");
    cm_fits_pair pair;
    int64_t whole = 0;
    double real = 0.0;
    ck_assert(cm_fits_split((const char *)to.bytes, &pair));
    ck_assert_str_eq(pair.value, "it's");
    ck_assert(cm_fits_split((const char *)to.bytes + CM_FITS_CARD, &pair));
    ck_assert(cm_fits_whole(&pair, &whole) && whole == -INT64_C(9000000000000000000));
    ck_assert(cm_fits_split((const char *)to.bytes + 2 * CM_FITS_CARD, &pair));
    ck_assert(cm_fits_real(&pair, &real) && real == 1.5e-3);
}
END_TEST

START_TEST(numbers)
{
    static const struct
    {
        const char *value;
        int is_whole;
        int64_t whole;
        int is_real;
        double real;
    } cases[] = {
        {"0", 1, 0, 1, 0.0},
        {"+12", 1, 12, 1, 12.0},
        {"-12", 1, -12, 1, -12.0},
        {"007", 1, 7, 1, 7.0},
        {"1.5D+2", 0, 0, 1, 150.0},
        {"1.5d2", 0, 0, 1, 150.0},
        {"99999999999999999999", 0, 0, 1, 1e20},
        {"-", 0, 0, 0, 0.0},
        {"", 0, 0, 0, 0.0},
        {"T", 0, 0, 0, 0.0},
        {"1 2", 0, 0, 0, 0.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_fits_pair pair = {"KEY", ""};
        int64_t whole = 77;
        double real = 77.0;
        memcpy(pair.value, cases[i].value, strlen(cases[i].value) + 1);
        REQUIRE(cm_fits_whole(&pair, &whole) == cases[i].is_whole, "\"%s\"", cases[i].value);
        REQUIRE(whole == (cases[i].is_whole ? cases[i].whole : 77), "\"%s\"", cases[i].value);
        REQUIRE(cm_fits_real(&pair, &real) == cases[i].is_real, "\"%s\"", cases[i].value);
        REQUIRE(!cases[i].is_real || real == cases[i].real, "\"%s\": %g", cases[i].value, real);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {cards_are_as_the_standard_has_them,
                                  heads_end_with_a_block,
                                  data_are_filled_to_a_block,
                                  failures_stay,
                                  cards_are_split,
                                  what_is_written_is_read,
                                  numbers,
                                  NULL};
    return run_suite("fits cards", tests);
}
