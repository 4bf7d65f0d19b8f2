/* SPDX-License-Identifier: MIT
 *
 * The table of descriptors, and names.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "catalogue_words.h"

#include <string.h>

#define CM_DESCRIPTORS
#define CM_WARP(id, ...) {__VA_ARGS__},
#define CM_SPHERE(id, ...) {__VA_ARGS__},
#define CM_CHART(id, ...) {__VA_ARGS__},

static const cm_mapping_info catalogue[] = {
#include <cubemap/kernel/kernel_catalogue.h>
};

size_t cm_catalogue_count(void)
{
    return sizeof catalogue / sizeof catalogue[0];
}

const cm_mapping_info *cm_catalogue_at(size_t index)
{
    return index < cm_catalogue_count() ? &catalogue[index] : NULL;
}

const char *cm_smoothness_name(cm_smoothness smoothness)
{
    static const char *const names[] = {"torn", "C0", "C1", "C2", "analytic"};
    return (size_t)smoothness < sizeof names / sizeof names[0] ? names[smoothness] : NULL;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

int cm_word_equal(const char *a, size_t a_length, const char *b, size_t b_length)
{
    if (a_length != b_length)
    {
        return 0;
    }
    for (size_t i = 0; i < a_length; i++)
    {
        if (lower(a[i]) != lower(b[i]))
        {
            return 0;
        }
    }
    return 1;
}

size_t cm_alias_length(const char *word, size_t whole)
{
    size_t colon = whole;
    for (size_t i = 0; i < whole; i++)
    {
        colon = word[i] == ':' ? i : colon;
    }
    int fixes = memchr(word + colon, '=', whole - colon) != NULL ||
                memchr(word + colon, ',', whole - colon) != NULL;
    return fixes ? colon : whole;
}

const cm_mapping_info *cm_catalogue_find_word(const char *name, size_t length, const char **fixed)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const char *identifier = catalogue[i].identifier;
        *fixed = "";
        if (cm_word_equal(identifier, strlen(identifier), name, length))
        {
            return &catalogue[i];
        }
        for (const char *alias = catalogue[i].aliases; *alias != '\0';)
        {
            size_t whole = strcspn(alias, " ");
            size_t word = cm_alias_length(alias, whole);
            if (cm_word_equal(alias, word, name, length))
            {
                *fixed = word < whole ? alias + word + 1 : "";
                return &catalogue[i];
            }
            alias += whole + strspn(alias + whole, " ");
        }
    }
    return NULL;
}

const cm_mapping_info *cm_catalogue_find(const char *name)
{
    const char *fixed;
    return name == NULL ? NULL : cm_catalogue_find_word(name, strlen(name), &fixed);
}

size_t cm_catalogue_index(const cm_mapping_info *info)
{
    return (size_t)(info - catalogue);
}
