/* SPDX-License-Identifier: MIT
 *
 * What the harnesses share: the input as a supply of values, and EXPECT, which ends the run, so
 * that libFuzzer keeps the input.
 */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerInitialize(int *argc, char ***argv);

#ifdef __cplusplus
}
#endif

/* The arguments after the condition are those of printf, and say what was met instead. */
#define EXPECT(condition, ...)                                                                     \
    do                                                                                             \
    {                                                                                              \
        if (!(condition))                                                                          \
        {                                                                                          \
            fprintf(stderr, "%s:%d: not true: %s\n  ", __FILE__, __LINE__, #condition);            \
            fprintf(stderr, __VA_ARGS__);                                                          \
            fputc('\n', stderr);                                                                   \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

typedef struct supply
{
    const uint8_t *at;
    size_t left;
} supply;

/* What is missing at the end of the input is zero, so that every input is one. */
static inline void take_bytes(supply *from, void *to, size_t size)
{
    size_t present = size < from->left ? size : from->left;
    memset(to, 0, size);
    if (present > 0)
    {
        memcpy(to, from->at, present);
        from->at += present;
        from->left -= present;
    }
}

static inline uint8_t take_byte(supply *from)
{
    uint8_t value;
    take_bytes(from, &value, sizeof value);
    return value;
}

static inline uint32_t take_word(supply *from)
{
    uint32_t value;
    take_bytes(from, &value, sizeof value);
    return value;
}

static inline double take_double(supply *from)
{
    double value;
    take_bytes(from, &value, sizeof value);
    return value;
}

/* A number in [-1, 1). */
static inline double take_fraction(supply *from)
{
    return (double)take_word(from) * 0x1p-31 - 1.0;
}

/* All that is left, as a text with a zero byte at its end and nothing behind that, to be freed. */
static inline char *take_text(supply *from)
{
    size_t size = from->left;
    char *text = (char *)malloc(size + 1);
    EXPECT(text != NULL, "no memory");
    take_bytes(from, text, size);
    text[size] = '\0';
    return text;
}

/* Is there no control character in this text? */
static inline int is_one_line(const char *text)
{
    for (; *text != '\0'; text++)
    {
        if ((unsigned char)*text < 0x20 || *text == 0x7f)
        {
            return 0;
        }
    }
    return 1;
}

#endif
