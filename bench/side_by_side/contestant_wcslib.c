/* SPDX-License-Identifier: MIT
 *
 * WCSLIB (Calabretta): prjs2x and prjx2s on whole arrays, longitudes and latitudes in pairs,
 * without the optional checks of bounds (prjprm::bounds), which cost it time.
 */
#include "side_by_side.h"

#include <math.h>
#include <stdlib.h>

#include <prj.h>
#include <wcs.h>

static void forward(const contestant *c, batch *b)
{
    struct prjprm *projection = c->handle;
    projection->prjs2x(projection, (int)b->count, 0, 1, 1, b->from[0], b->from[1], b->plane[0],
                       b->plane[1], b->status[FORWARD]);
}

static void inverse(const contestant *c, batch *b)
{
    struct prjprm *projection = c->handle;
    projection->prjx2s(projection, (int)b->count, 0, 1, 1, b->plane[0], b->plane[1], b->back[0],
                       b->back[1], b->status[INVERSE]);
}

static void close_projection(contestant *c)
{
    prjfree(c->handle);
    free(c->handle);
}

static const char *version(void)
{
    static char text[32];
    int parts[3] = {0, 0, 0};
    wcslib_version(parts);
    snprintf(text, sizeof text, "%d.%d", parts[0], parts[1]);
    return text;
}

static const struct
{
    const char *group;
    const char *code;
    int (*set)(struct prjprm *);
    const char *note;
} projections[] = {
    {"gnomonic", "TSC", tscset, ""},
    {"cobe", "CSC", cscset, "polynomials in single precision; the published inverse"},
    {"qsc", "QSC", qscset, ""},
    {"healpix", "HPX", hpxset, ""},
};

int add_wcslib(roster *all)
{
    for (size_t i = 0; i < sizeof projections / sizeof projections[0]; i++)
    {
        if (!roster_wants(all, projections[i].group))
        {
            continue;
        }
        struct prjprm *projection = allocate(1, sizeof *projection);
        prjini(projection);
        projection->bounds = 0;
        if (projections[i].set(projection) != 0)
        {
            fprintf(stderr, "side-by-side: WCSLIB does not set up %s\n", projections[i].code);
            return 0;
        }
        contestant entrant = {.library = "WCSLIB",
                              .version = version(),
                              .group = projections[i].group,
                              .specification = projections[i].code,
                              .name = projections[i].code,
                              .path = "",
                              .tier = "",
                              .note = projections[i].note,
                              .unit = acos(-1.0) / 180.0,
                              .forward = forward,
                              .inverse = inverse,
                              .close = close_projection,
                              .handle = projection};
        roster_add(all, &entrant);
    }
    return 1;
}
