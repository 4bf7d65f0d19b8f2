/* SPDX-License-Identifier: MIT
 *
 * The tables, by index and by name, and the texts of the library.
 */
#include <cubemap/cubemap.h>

#include <strings.h>

#include "fuzz.h"

/* The length of a word without the parameters or parts that it stands for: "azimuthal:harmonic-mean" is all name,
 * "asc:c=1" and "peirce:stereographic,conformal" are it up to the colon. */
static size_t name_length(const char *word)
{
    size_t whole = strcspn(word, " ");
    size_t more = strcspn(word, "=,");
    size_t length = strcspn(word, ":");
    while (more < whole && length + 1 + strcspn(word + length + 1, ":") < more)
    {
        length += 1 + strcspn(word + length + 1, ":");
    }
    return more < whole ? length : whole;
}

static int has_word(const char *words, const char *name)
{
    size_t length = strlen(name);
    for (words += strspn(words, " "); *words != '\0'; words += strspn(words, " "))
    {
        if (name_length(words) == length && strncasecmp(words, name, length) == 0)
        {
            return 1;
        }
        words += strcspn(words, " ");
    }
    return 0;
}

static void check_name(const char *name)
{
    const cm_mapping_info *expected = NULL;
    const cm_frame *frame = NULL;
    for (size_t i = cm_catalogue_count(); i-- > 0;)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        int named = has_word(info->identifier, name) || has_word(info->aliases, name);
        expected = named ? info : expected;
    }
    for (size_t i = cm_frame_count(); i-- > 0;)
    {
        frame = has_word(cm_frame_at(i)->identifier, name) ? cm_frame_at(i) : frame;
    }
    EXPECT(cm_catalogue_find(name) == expected, "mapping '%s'", name);
    EXPECT(cm_frame_find(name) == frame, "frame '%s'", name);
    EXPECT(expected == NULL || cm_smoothness_name(expected->smooth_face) != NULL,
           "smoothness of '%s'", name);
    if (strchr(name, ':') == NULL)
    {
        EXPECT((cm_specification_check(name, NULL, 0) == CM_OK) == (expected != NULL), "'%s'",
               name);
    }
}

static void check_index(size_t index)
{
    EXPECT((cm_catalogue_at(index) != NULL) == (index < cm_catalogue_count()), "%zu", index);
    EXPECT((cm_frame_at(index) != NULL) == (index < cm_frame_count()), "%zu", index);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    char *name = take_text(&from);
    supply again = {data, size};
    int status;
    check_name(name);
    free(name);
    take_bytes(&again, &status, sizeof status);
    EXPECT(strlen(cm_status_text((cm_status)status)) > 0, "%d", status);
    check_index((size_t)status);
    check_index((unsigned)status % 64);
    EXPECT(strcmp(cm_version(), CM_VERSION_STRING) == 0, "%s", cm_version());
    EXPECT(cm_catalogue_find(NULL) == NULL && cm_frame_find(NULL) == NULL, "a name of NULL");
    return 0;
}
