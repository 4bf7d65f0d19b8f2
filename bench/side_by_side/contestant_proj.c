/* SPDX-License-Identifier: MIT
 *
 * PROJ (OSGeo): proj_trans_generic on arrays, in place. A cube is six projections, one a face; the
 * points are sorted by face beforehand, which is not timed, nor is finding the face.
 */
#include "side_by_side.h"

#include "truth/peers/peers.h"

#include <stdlib.h>
#include <string.h>

#include <proj.h>

typedef struct planes
{
    int count; /* 6, or 1 for what needs no faces */
    PJ *projection[6];
} planes;

static void transform(const contestant *c, const batch *b, PJ_DIRECTION direction,
                      double *const xy[])
{
    const planes *opened = c->handle;
    for (int k = 0; k < opened->count; k++)
    {
        size_t from = opened->count == 1 ? 0 : b->first[k];
        size_t count = opened->count == 1 ? b->count : b->first[k + 1] - from;
        proj_trans_generic(opened->projection[k], direction, xy[0] + from, sizeof(double), count,
                           xy[1] + from, sizeof(double), count, NULL, 0, 0, NULL, 0, 0);
    }
}

static void forward(const contestant *c, batch *b)
{
    transform(c, b, PJ_FWD, b->plane);
}

static void inverse(const contestant *c, batch *b)
{
    transform(c, b, PJ_INV, b->back);
}

static void close_planes(contestant *c)
{
    planes *opened = c->handle;
    for (int k = 0; k < opened->count; k++)
    {
        proj_destroy(opened->projection[k]);
    }
    free(opened);
}

static int open_planes(planes *opened, const char *name, int count)
{
    opened->count = count;
    for (int k = 0; k < count; k++)
    {
        char text[96];
        snprintf(text, sizeof text, "+proj=%s +lon_0=%g +lat_0=%g +R=6371007.2", name,
                 peer_geo_centre[k][0], peer_geo_centre[k][1]);
        opened->projection[k] = proj_create(PJ_DEFAULT_CTX, text);
        if (opened->projection[k] == NULL)
        {
            fprintf(stderr, "side-by-side: PROJ does not know %s\n", text);
            return 0;
        }
    }
    return 1;
}

static const struct
{
    const char *group;
    const char *name;
    int planes;
} projections[] = {
    {"gnomonic", "gnom", 6}, {"qsc", "qsc", 6}, {"s2", "s2", 6}, {"healpix", "healpix", 1}};

int add_proj(roster *all)
{
    for (size_t i = 0; i < sizeof projections / sizeof projections[0]; i++)
    {
        int cube = projections[i].planes == 6;
        planes *opened;
        if (!roster_wants(all, projections[i].group))
        {
            continue;
        }
        opened = allocate(1, sizeof *opened);
        if (!open_planes(opened, projections[i].name, projections[i].planes))
        {
            return 0;
        }
        contestant entrant = {.library = "PROJ",
                              .version = proj_info().version,
                              .group = projections[i].group,
                              .specification = projections[i].name,
                              .name = projections[i].name,
                              .path = "",
                              .tier = "",
                              .note = cube ? "one projection a face; told the face, and the points "
                                             "sorted by it beforehand"
                                           : "",
                              .by_face = cube,
                              .in_place = 1,
                              .unit = 1.0,
                              .forward = forward,
                              .inverse = inverse,
                              .close = close_planes,
                              .handle = opened};
        roster_add(all, &entrant);
    }
    return 1;
}
