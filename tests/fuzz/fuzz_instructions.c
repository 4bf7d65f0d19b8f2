/* SPDX-License-Identifier: MIT
 *
 * How an instruction set and a tier are chosen: the input is the set's name, as an option and in the
 * environment, and read as numbers, a tier and the mapping.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/cubemap.h>
#include <cubemap/options.h>

#include <math.h>
#include <strings.h>

#include "fuzz.h"

/* NULL if there is no such set. */
static const char *set_called(const char *name)
{
    const char *found = NULL;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        found = strcasecmp(cm_instructions_at(i), name) == 0 ? cm_instructions_at(i) : found;
    }
    return found;
}

/* expected NULL: there is no such set */
static void check_made(const cm_options *options, const char *expected)
{
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create_with("coupled", NULL, options, &mapping);
    EXPECT(status == (expected != NULL ? CM_OK : CM_ERROR_INSTRUCTIONS), "status %d", status);
    EXPECT((mapping != NULL) == (expected != NULL), "status %d", status);
    EXPECT(mapping == NULL || strcmp(cm_mapping_instructions(mapping), expected) == 0, "%s, not %s",
           cm_mapping_instructions(mapping), expected);
    cm_mapping_destroy(mapping);
}

/* What is said of a name, in no more than the room that there is. */
static void check_message(const char *name, int there, size_t room)
{
    char *message = malloc(room + (room == 0));
    EXPECT(message != NULL, "no memory");
    memset(message, 'x', room);
    cm_status status = cm_instructions_check(name, message, room);
    EXPECT(status == (there ? CM_OK : CM_ERROR_INSTRUCTIONS), "status %d", status);
    EXPECT(cm_instructions_check(name, NULL, room) == status, "without a message");
    EXPECT(there || room == 0 || memchr(message, '\0', room) != NULL, "no end in %zu", room);
    EXPECT(there || room < 200 || strstr(message, "can be scalar") != NULL, "%s", message);
    EXPECT(there || room == 0 || strchr(message, '\n') == NULL, "several lines");
    free(message);
}

/* A mapping that is nowhere quicker in the fast tier, as without vectors, has the exact one. */
static void check_tier(supply from)
{
    const cm_mapping_info *info = cm_catalogue_at(take_byte(&from) % cm_catalogue_count());
    int tier = (int)(int8_t)take_byte(&from);
    int known = tier == CM_TIER_EXACT || tier == CM_TIER_FAST;
    const cm_options options = {.size = sizeof options, .tier = (cm_tier)tier};
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create_with(info->identifier, NULL, &options, &mapping);
    EXPECT(status == (known ? CM_OK : CM_ERROR_ARGUMENT), "tier %d: status %d", tier, status);
    if (known)
    {
        int offered = info->fast != 0 && cm_instructions_count() > 1;
        cm_tier expected = offered ? (cm_tier)tier : CM_TIER_EXACT;
        EXPECT(cm_mapping_tier(mapping) == expected, "%s: tier %d", info->identifier, tier);
    }
    cm_mapping_destroy(mapping);
}

static void check_size(size_t size)
{
    const cm_options options = {.size = size};
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create_with("coupled", NULL, &options, &mapping);
    EXPECT(status == (size == sizeof options ? CM_OK : CM_ERROR_ARGUMENT), "size %zu: status %d",
           size, status);
    cm_mapping_destroy(mapping);
}

/* What makes no mapping takes the best set where the environment names none that there is. */
static void check_lonlat(void)
{
    const double x = 0.0, y = 2.0, z = 0.0;
    double lon, lat;
    cm_lonlat_from_direction_array(1, &x, &y, &z, &lon, &lat);
    EXPECT(fabs(lon - 1.5707963267948966) < 1e-15 && lat == 0.0, "%a %a", lon, lat);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    char *name = take_text(&from);
    const char *best = cm_instructions_at(cm_instructions_count() - 1);
    const cm_options none = {.size = sizeof none};
    cm_options options = {.size = sizeof options, .instructions = name};
    EXPECT(cm_instructions_at(size + cm_instructions_count()) == NULL, "one set too many");
    unsetenv("CUBEMAP_INSTRUCTIONS");
    check_size(size);
    check_tier((supply){data, size});
    check_made(NULL, best);
    check_made(&none, best);
    check_made(&options, *name == '\0' ? best : set_called(name));
    check_message(name, *name == '\0' || set_called(name) != NULL, size % 300);
    EXPECT(setenv("CUBEMAP_INSTRUCTIONS", name, 1) == 0, "no memory");
    check_made(&none, *name == '\0' ? best : set_called(name));
    check_message(NULL, *name == '\0' || set_called(name) != NULL, size % 300);
    check_lonlat();
    options.instructions = "scalar";
    check_made(&options, "scalar");
    free(name);
    return 0;
}
