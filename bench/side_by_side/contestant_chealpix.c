/* SPDX-License-Identifier: MIT
 *
 * chealpix (Gorski, Reinecke et al.): pixel numbers, not coordinates, from vectors and back to the
 * centres of pixels; so its error is the size of a pixel, 12 mm at the largest nside it has and 800
 * m at the largest of its functions without 64. Both nest functions say that (0.745, -7.5e-16,
 * -2/3), a corner of two base pixels on the meridian 0, is in base pixel 12, which does not exist:
 * hence their hard errors.
 */
#include "side_by_side.h"

#include <chealpix.h>

static const int64_t nside_64 = (int64_t)1 << 29;
static const long nside_32 = 8192;

#define FOR_EACH_POINT(call)                                                                       \
    for (size_t i = 0; i < b->count; i++)                                                          \
    {                                                                                              \
        const double v[3] = {b->from[0][i], b->from[1][i], b->from[2][i]};                         \
        call;                                                                                      \
    }                                                                                              \
    (void)c

#define FOR_EACH_PIXEL(call)                                                                       \
    for (size_t i = 0; i < b->count; i++)                                                          \
    {                                                                                              \
        double v[3];                                                                               \
        call;                                                                                      \
        b->back[0][i] = v[0];                                                                      \
        b->back[1][i] = v[1];                                                                      \
        b->back[2][i] = v[2];                                                                      \
    }                                                                                              \
    (void)c

static void forward_nest64(const contestant *c, batch *b)
{
    FOR_EACH_POINT(vec2pix_nest64(nside_64, v, &b->pixel[i]));
}

static void inverse_nest64(const contestant *c, batch *b)
{
    FOR_EACH_PIXEL(pix2vec_nest64(nside_64, b->pixel[i], v));
}

static void forward_ring64(const contestant *c, batch *b)
{
    FOR_EACH_POINT(vec2pix_ring64(nside_64, v, &b->pixel[i]));
}

static void inverse_ring64(const contestant *c, batch *b)
{
    FOR_EACH_PIXEL(pix2vec_ring64(nside_64, b->pixel[i], v));
}

static void forward_nest(const contestant *c, batch *b)
{
    FOR_EACH_POINT(long pixel; vec2pix_nest(nside_32, v, &pixel); b->pixel[i] = pixel);
}

static void inverse_nest(const contestant *c, batch *b)
{
    FOR_EACH_PIXEL(pix2vec_nest(nside_32, (long)b->pixel[i], v));
}

static const struct
{
    const char *name;
    const char *note;
    void (*forward)(const contestant *, batch *);
    void (*inverse)(const contestant *, batch *);
} functions[] = {
    {"nest64", "pixels of 12 mm, not coordinates; at one corner a pixel that does not exist",
     forward_nest64, inverse_nest64},
    {"ring64", "pixels of 12 mm, not coordinates", forward_ring64, inverse_ring64},
    {"nest", "pixels of 800 m, not coordinates; at one corner a pixel that does not exist",
     forward_nest, inverse_nest},
};

int add_chealpix(roster *all)
{
    for (size_t i = 0; roster_wants(all, "healpix") && i < sizeof functions / sizeof functions[0];
         i++)
    {
        contestant entrant = {.library = "chealpix",
                              .version = PEER_VERSION,
                              .group = "healpix",
                              .specification = "HEALPix",
                              .name = functions[i].name,
                              .path = "",
                              .tier = "",
                              .note = functions[i].note,
                              .pixels = 1,
                              .forward = functions[i].forward,
                              .inverse = functions[i].inverse};
        roster_add(all, &entrant);
    }
    return 1;
}
