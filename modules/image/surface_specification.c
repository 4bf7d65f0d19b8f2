/* SPDX-License-Identifier: MIT */
#include "surface_specification.h"

#include <cubemap/number.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

cm_status cm_complain(cm_complaint to, cm_status status, const char *format, ...)
{
    if (to.text != NULL && to.size > 0)
    {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(to.text, to.size, format, arguments);
        va_end(arguments);
        for (char *c = to.text; *c != '\0'; c++)
        {
            *c = (unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c;
        }
    }
    return status;
}

cm_word cm_word_split(cm_word whole, char stop, cm_word *rest)
{
    const char *found = whole.length == 0 ? NULL : memchr(whole.text, stop, whole.length);
    rest->text = found == NULL ? NULL : found + 1;
    rest->length = found == NULL ? 0 : whole.length - (size_t)(found + 1 - whole.text);
    return (cm_word){whole.text, found == NULL ? whole.length : (size_t)(found - whole.text)};
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c + ('a' - 'A')) : c;
}

int cm_word_is(cm_word word, const char *text)
{
    size_t i = 0;
    while (i < word.length && text[i] != '\0' && lower(word.text[i]) == lower(text[i]))
    {
        i++;
    }
    return word.text != NULL && i == word.length && text[i] == '\0';
}

int cm_word_copy(cm_word word, char *text, size_t size)
{
    if (word.length >= size)
    {
        return 0;
    }
    memcpy(text, word.text, word.length);
    text[word.length] = '\0';
    return 1;
}

static cm_status read_keys(cm_word rest, cm_surface_words *words, cm_complaint to)
{
    while (rest.text != NULL)
    {
        cm_word value;
        const cm_word pair = cm_word_split(rest, ';', &rest);
        const cm_word key = cm_word_split(pair, '=', &value);
        if (key.length == 0 || value.length == 0)
        {
            return cm_complain(to, CM_ERROR_SYNTAX,
                               "'%.*s' is not KEY=VALUE, as in layout=cross;size=1024",
                               CM_SHOWN(pair));
        }
        for (size_t i = 0; i < words->key_count; i++)
        {
            if (key.length == words->key[i].length &&
                memcmp(key.text, words->key[i].text, key.length) == 0)
            {
                return cm_complain(to, CM_ERROR_SYNTAX, "key '%.*s' stands twice", CM_SHOWN(key));
            }
        }
        if (words->key_count == CM_KEYS_MAX)
        {
            return cm_complain(to, CM_ERROR_SYNTAX, "there are more than %d keys", CM_KEYS_MAX);
        }
        words->key[words->key_count] = key;
        words->value[words->key_count++] = value;
    }
    return CM_OK;
}

cm_status cm_surface_words_read(const char *text, cm_surface_words *words, cm_complaint to)
{
    cm_word keys;
    const cm_word whole = {text, strlen(text)};
    const cm_word first = cm_word_split(whole, ';', &keys);
    memset(words, 0, sizeof *words);
    words->kind = cm_word_split(first, ':', &words->parameters);
    if (words->kind.length == 0 ||
        (words->parameters.text != NULL && words->parameters.length == 0))
    {
        return cm_complain(
            to, CM_ERROR_SYNTAX,
            "'%.*s' is not KIND[:PARAMETERS][;KEY=VALUE...], as in cube:coupled;layout=cross",
            CM_SHOWN(whole));
    }
    return read_keys(keys, words, to);
}

cm_word cm_surface_key(cm_surface_words *words, const char *key)
{
    for (size_t i = 0; i < words->key_count; i++)
    {
        if (cm_word_is(words->key[i], key))
        {
            words->used |= 1u << i;
            return words->value[i];
        }
    }
    return (cm_word){NULL, 0};
}

cm_status cm_surface_key_number(cm_surface_words *words, const char *key, double low, double high,
                                double *value, cm_complaint to)
{
    const cm_word text = cm_surface_key(words, key);
    double read = *value;
    if (text.text == NULL)
    {
        return CM_OK;
    }
    if (!cm_number_parse(text.text, text.length, &read))
    {
        return cm_complain(to, CM_ERROR_SYNTAX, "%s=%.*s: that is not a number", key,
                           CM_SHOWN(text));
    }
    if (!(read >= low && read <= high))
    {
        char least[CM_NUMBER_SIZE];
        char most[CM_NUMBER_SIZE];
        cm_number_write_shortest(low, least);
        cm_number_write_shortest(high, most);
        return cm_complain(to, CM_ERROR_RANGE, "%s=%.*s: it must be from %s to %s", key,
                           CM_SHOWN(text), least, most);
    }
    *value = read;
    return CM_OK;
}
