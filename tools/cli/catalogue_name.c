/* SPDX-License-Identifier: MIT */
#include "catalogue_name.h"

#include <cubemap/cubemap.h>

#include <string.h>

const char *mapping_name_at(size_t index)
{
    return index < cm_catalogue_count() ? cm_catalogue_at(index)->identifier : NULL;
}

const char *frame_name_at(size_t index)
{
    return index < cm_frame_count() ? cm_frame_at(index)->identifier : NULL;
}

const char *ellipsoid_name_at(size_t index)
{
    return index < cm_ellipsoid_count() ? cm_ellipsoid_at(index)->identifier : NULL;
}

const char *latitude_name_at(size_t index)
{
    return index < CM_LATITUDE_COUNT ? cm_latitude_name((cm_latitude)index) : NULL;
}

const char *orientation_name_at(size_t index)
{
    return index < cm_orientation_count() ? cm_orientation_at(index)->identifier : NULL;
}

cm_nearest nearest_name(const char *text, const char *(*name_at)(size_t index))
{
    cm_nearest nearest = cm_nearest_to(text, strlen(text));
    const char *name;
    for (size_t i = 0; (name = name_at(i)) != NULL; i++)
    {
        cm_nearest_try(&nearest, name, strlen(name));
    }
    return nearest;
}

/* Names that mean a mapping with some values are "asc:c=1": what is behind the colon is not typed. */
static size_t typed_length(const char *word)
{
    const size_t length = strcspn(word, " ");
    const size_t colon = strcspn(word, ": ");
    return strcspn(word, "=, ") < length ? colon : length;
}

static void try_mapping(cm_nearest *nearest, const cm_mapping_info *mapping)
{
    cm_nearest_try(nearest, mapping->identifier, strlen(mapping->identifier));
    for (const char *word = mapping->aliases; *word != '\0';)
    {
        cm_nearest_try(nearest, word, typed_length(word));
        word += strcspn(word, " ");
        word += strspn(word, " ");
    }
}

/* Names have a colon in them, or what follows it is no part of them. */
cm_nearest nearest_mapping(const char *specification)
{
    const size_t one = strcspn(specification, ":");
    const size_t two =
        specification[one] == ':' ? one + 1 + strcspn(specification + one + 1, ":,") : one;
    cm_nearest shorter = cm_nearest_to(specification, one);
    cm_nearest longer = cm_nearest_to(specification, two);
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        try_mapping(&shorter, cm_catalogue_at(i));
        try_mapping(&longer, cm_catalogue_at(i));
    }
    cm_nearest best = longer.best != NULL ? longer : shorter;
    if (best.distance == 0)
    {
        best.best = NULL; /* it is not the name that is wrong */
    }
    return best;
}
