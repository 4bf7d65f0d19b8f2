/* SPDX-License-Identifier: MIT
 *
 * This library: every mapping that is asked for, by every path that this machine can run.
 */
#include "side_by_side.h"

#include <string.h>

static void forward_array(const contestant *c, batch *b)
{
    run_arrays(c->handle, c->narrow, b, FORWARD);
}

static void inverse_array(const contestant *c, batch *b)
{
    run_arrays(c->handle, c->narrow, b, INVERSE);
}

static void forward_points(const contestant *c, batch *b)
{
    run_points(c->handle, c->narrow, b, FORWARD);
}

static void inverse_points(const contestant *c, batch *b)
{
    run_points(c->handle, c->narrow, b, INVERSE);
}

/* For those who start from longitude and latitude, as most peers do. */
static void forward_lonlat(const contestant *c, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        double direction[3];
        cm_direction_from_lonlat(b->from[0][i], b->from[1][i], direction);
        for (int k = 0; k < 3; k++)
        {
            b->back[k][i] = direction[k];
        }
    }
    cm_forward_array(c->handle, b->count, b->back[0], b->back[1], b->back[2], b->face, b->plane[0],
                     b->plane[1]);
}

static void inverse_lonlat(const contestant *c, batch *b)
{
    inverse_array(c, b);
    for (size_t i = 0; i < b->count; i++)
    {
        const double direction[3] = {b->back[0][i], b->back[1][i], b->back[2][i]};
        double lonlat[2];
        cm_lonlat_from_direction(direction, lonlat);
        b->back[0][i] = lonlat[0];
        b->back[1][i] = lonlat[1];
    }
}

static void close_mapping(contestant *c)
{
    cm_mapping_destroy(c->handle);
}

static cm_options options_of(const contestant *c)
{
    int fast = strcmp(c->tier, "fast") == 0;
    cm_options options = {.size = sizeof options,
                          .instructions = c->path,
                          .tier = fast ? CM_TIER_FAST : CM_TIER_EXACT};
    return options;
}

/* One contestant; each has a mapping of its own. 0 if there is no such mapping. */
static int add(roster *all, contestant entrant)
{
    cm_mapping *mapping = NULL;
    cm_options options = options_of(&entrant);
    cm_status status = cm_mapping_create_with(entrant.specification, NULL, &options, &mapping);
    if (status != CM_OK)
    {
        fprintf(stderr, "side-by-side: %s, %s: %s\n", entrant.specification, entrant.path,
                cm_status_text(status));
        return 0;
    }
    if (options.tier == CM_TIER_FAST && cm_mapping_tier(mapping) != CM_TIER_FAST)
    {
        cm_mapping_destroy(mapping); /* it would be the exact one again */
        return 1;
    }
    if (options.tier == CM_TIER_FAST)
    {
        unsigned offered = cm_mapping_describe(mapping)->fast;
        entrant.absent = (offered & CM_FAST_FORWARD ? 0u : 1u << FORWARD) |
                         (offered & CM_FAST_INVERSE ? 0u : 1u << INVERSE);
    }
    entrant.library = "libcubemap";
    entrant.version = cm_version();
    entrant.own = 1;
    entrant.note = "";
    entrant.close = close_mapping;
    entrant.handle = mapping;
    roster_add(all, &entrant);
    return 1;
}

static int add_arrays(roster *all, const contestant *plain)
{
    contestant wide = *plain;
    wide.array = 1;
    wide.forward = forward_array;
    wide.inverse = inverse_array;
    contestant narrow = wide;
    narrow.narrow = 1;
    /* float has no tiers */
    return add(all, wide) && (strcmp(plain->tier, "fast") == 0 || add(all, narrow));
}

static int add_one_by_one(roster *all, const contestant *plain)
{
    contestant points = *plain;
    points.name = "point by point";
    points.forward = forward_points;
    points.inverse = inverse_points;
    contestant narrow = points;
    narrow.narrow = 1;
    return add(all, points) && add(all, narrow);
}

static int add_from_lonlat(roster *all, const contestant *plain)
{
    contestant lonlat = *plain;
    lonlat.name = "from lon, lat";
    lonlat.unit = 1.0;
    lonlat.forward = forward_lonlat;
    lonlat.inverse = inverse_lonlat;
    return add(all, lonlat);
}

/* Arrays with every instruction set, exact and fast. */
static int add_ways(roster *all, contestant plain)
{
    static const char *const tiers[] = {"exact", "fast"};
    for (size_t tier = 0; tier < sizeof tiers / sizeof tiers[0]; tier++)
    {
        for (size_t i = 0; i < cm_instructions_count(); i++)
        {
            plain.path = cm_instructions_at(i);
            plain.tier = tiers[tier];
            if (!add_arrays(all, &plain))
            {
                return 0;
            }
        }
    }
    return 1;
}

static int has_peers(const char *group)
{
    static const char *const with_peers[] = {"gnomonic", "qsc", "cobe", "healpix", "s2"};
    for (size_t i = 0; i < sizeof with_peers / sizeof with_peers[0]; i++)
    {
        if (strcmp(group, with_peers[i]) == 0)
        {
            return 1;
        }
    }
    return 0;
}

static int add_mapping(roster *all, const char *group)
{
    contestant best = {.group = group,
                       .specification = group,
                       .name = "",
                       .path = cm_instructions_at(cm_instructions_count() - 1),
                       .tier = "exact"};
    contestant simplest = best;
    contestant published = best;
    simplest.path = cm_instructions_at(0);
    published.specification = "cobe:legacy=1";
    return add_ways(all, best) && add_one_by_one(all, &simplest) &&
           (cm_instructions_count() == 1 || add_one_by_one(all, &best)) &&
           (!has_peers(group) || add_from_lonlat(all, &best)) &&
           /* the inverse that WCSLIB's CSC has */
           (strcmp(group, "cobe") != 0 || add_arrays(all, &published));
}

int add_own(roster *all)
{
    for (size_t i = 0; i < all->group_count; i++)
    {
        if (!add_mapping(all, all->groups[i]))
        {
            return 0;
        }
    }
    return 1;
}
