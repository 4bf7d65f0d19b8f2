/* SPDX-License-Identifier: MIT */
#include "nearest.h"

#include <stdio.h>
#include <string.h>

enum
{
    LETTERS_MAX = 64 /* of a word; a longer one is like none */
};

static char lower(char letter)
{
    return letter >= 'A' && letter <= 'Z' ? (char)(letter - 'A' + 'a') : letter;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The edit distance with swaps of neighbours, row by row (optimal string alignment). */
static size_t distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LETTERS_MAX + 1];
    size_t *before = rows[0];
    size_t *last = rows[1];
    size_t *next = rows[2];
    for (size_t j = 0; j <= b_length; j++)
    {
        last[j] = j;
        before[j] = 0;
    }
    for (size_t i = 1; i <= a_length; i++)
    {
        next[0] = i;
        for (size_t j = 1; j <= b_length; j++)
        {
            const char x = lower(a[i - 1]);
            const char y = lower(b[j - 1]);
            next[j] = least(last[j - 1] + (size_t)(x != y), least(last[j], next[j - 1]) + 1);
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && y == lower(a[i - 2]))
            {
                next[j] = least(next[j], before[j - 2] + 1);
            }
        }
        size_t *const free_row = before;
        before = last;
        last = next;
        next = free_row;
    }
    return last[b_length];
}

cm_nearest cm_nearest_to(const char *text, size_t length)
{
    /* a third of the letters may be wrong; of a short word one, but not its only one */
    const size_t allowed = length < 2 ? 0 : length / 3 > 1 ? length / 3 : 1;
    const cm_nearest nearest = {text, length, NULL, 0, allowed + 1};
    return nearest;
}

void cm_nearest_try(cm_nearest *nearest, const char *word, size_t length)
{
    if (length == 0 || length > LETTERS_MAX || nearest->length > LETTERS_MAX)
    {
        return;
    }
    size_t found = distance(nearest->text, nearest->length, word, length);
    const size_t shown = least(length, nearest->length);
    if (nearest->length >= 3 && shown == nearest->length &&
        distance(nearest->text, shown, word, shown) == 0)
    {
        found = least(found, 1);
    }
    if (found < nearest->distance)
    {
        nearest->best = word;
        nearest->best_length = length;
        nearest->distance = found;
    }
}

const char *cm_nearest_of(const char *text, const char *const *words)
{
    cm_nearest nearest = cm_nearest_to(text, strlen(text));
    for (; *words != NULL; words++)
    {
        cm_nearest_try(&nearest, *words, strlen(*words));
    }
    return nearest.best;
}

void cm_nearest_append(const cm_nearest *nearest, char *message, size_t size)
{
    const size_t used = strlen(message);
    if (nearest->best != NULL && used < size)
    {
        snprintf(message + used, size - used, "; did you mean %.*s?", (int)nearest->best_length,
                 nearest->best);
    }
}
