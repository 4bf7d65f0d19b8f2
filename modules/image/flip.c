/* SPDX-License-Identifier: MIT
 *
 * FLIP: P. Andersson et al., "FLIP: a difference evaluator for alternating images", Proceedings of the ACM on Computer
 * Graphics and Interactive Techniques 3, 2020; and HDR-FLIP: P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moller,
 * "Visualizing errors in rendered high dynamic range images", Eurographics Short Papers 2021.
 */
#include "compare_tile.h"
#include "flip_color.h"
#include "flip_exposure.h"
#include "flip_filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double feature_exponent = 0.5; /* q_f */

/* What is the same for all tiles. */
typedef struct flip
{
    cm_flip_filters filters;
    double greatest; /* difference of colours */
    int is_linear;
    int is_high; /* dynamic range: are exposures to be taken? */
    cm_flip_exposures exposures;
    double srgb[256]; /* the linear light of whole numbers of 8 bits */
} flip;

/* Of one picture's tile. */
typedef struct tile_look
{
    double *hunt[3]; /* CM_TILE_PIXELS each, as below */
    double *edge;    /* how much of an edge there is */
    double *point;   /* or of a point */
} tile_look;

enum
{
    LOOK = 5,   /* planes of a tile_look */
    BLURRED = 7 /* planes that are filtered along rows */
};

/* Room for one tile. */
typedef struct tile_room
{
    size_t around;     /* pixels of a plane around the tile */
    double *linear[2]; /* three planes around the tile, of both pictures */
    double *opponent;  /* three planes around the tile */
    double *middle;    /* BLURRED planes, as wide as the tile and as high as what is around */
    double *filtered;  /* a row for each of the sums below */
    tile_look look[2];
} tile_room;

static size_t edge_around(const flip *how)
{
    return CM_TILE + 2 * how->filters.radius;
}

static size_t room_size(const flip *how)
{
    const size_t edge = edge_around(how);
    return 9 * edge * edge + BLURRED * edge * CM_TILE + 2 * LOOK * CM_TILE_PIXELS + 8 * CM_TILE;
}

static tile_room share_room(const flip *how, double *work)
{
    const size_t edge = edge_around(how);
    tile_room room = {.around = edge * edge};
    room.linear[0] = work;
    room.linear[1] = work + 3 * room.around;
    room.opponent = work + 6 * room.around;
    room.middle = work + 9 * room.around;
    double *left = room.middle + BLURRED * edge * CM_TILE;
    for (int p = 0; p < 2; p++)
    {
        for (int i = 0; i < 3; i++, left += CM_TILE_PIXELS)
        {
            room.look[p].hunt[i] = left;
        }
        room.look[p].edge = left;
        room.look[p].point = left + CM_TILE_PIXELS;
        left += 2 * (size_t)CM_TILE_PIXELS;
    }
    room.filtered = left;
    return room;
}

/* ---- from pixels to YCxCz ---- */

/* Linear light of red, green and blue around a tile, from 0 on; up to 1 if the dynamic range is not high. */
static void load_linear(const flip *how, const cm_image *image, const cm_compare_tile *tile,
                        const tile_room *room, double *linear)
{
    const size_t count =
        (tile->width + 2 * how->filters.radius) * (tile->height + 2 * how->filters.radius);
    const uint32_t channels = image->channels < 3 ? 1 : 3;
    for (uint32_t c = 0; c < channels; c++)
    {
        double *const to = linear + c * room->around;
        cm_compare_load(image, tile, how->filters.radius, c, 1, to);
        for (size_t i = 0; i < count; i++)
        {
            if (how->is_high || how->is_linear)
            {
                to[i] = to[i] < 0.0 ? 0.0 : to[i] > 1.0 && !how->is_high ? 1.0 : to[i];
            }
            else if (image->type == CM_PIXEL_U8)
            {
                to[i] = how->srgb[(int)(to[i] * 255.0 + 0.5)];
            }
            else
            {
                to[i] = cm_flip_linear_from_srgb(to[i]);
            }
        }
    }
    for (uint32_t c = channels; c < 3; c++)
    {
        memcpy(linear + c * room->around, linear, count * sizeof *linear);
    }
}

static void find_opponent(const flip *how, const cm_compare_tile *tile, const tile_room *room,
                          const double *linear, double factor)
{
    const size_t count =
        (tile->width + 2 * how->filters.radius) * (tile->height + 2 * how->filters.radius);
    for (size_t i = 0; i < count; i++)
    {
        double color[3], opponent[3];
        for (size_t c = 0; c < 3; c++)
        {
            const double value = linear[c * room->around + i];
            color[c] = how->is_high ? cm_flip_tone(value * factor) : value;
        }
        cm_flip_opponent_from_linear(color, opponent);
        for (size_t c = 0; c < 3; c++)
        {
            room->opponent[c * room->around + i] = opponent[c];
        }
    }
}

/* ---- filters ---- */

/* A filter along the rows of a plane around the tile. */
static void filter_rows(const flip *how, const cm_compare_tile *tile, const double *from,
                        const double *k, size_t radius, double sign, double *to)
{
    const size_t reach = how->filters.radius;
    const size_t stride = tile->width + 2 * reach;
    for (size_t y = 0; y < tile->height + 2 * reach; y++)
    {
        cm_compare_filter(tile->width, from + y * stride + reach, 1, radius, k, sign,
                          to + y * tile->width);
    }
}

static void filter_all_rows(const flip *how, const cm_compare_tile *tile, const tile_room *room,
                            double *plane[BLURRED])
{
    const cm_flip_filters *const f = &how->filters;
    const double *const red_green = room->opponent + room->around;
    const double *const blue_yellow = room->opponent + 2 * room->around;
    for (size_t i = 0; i < BLURRED; i++)
    {
        plane[i] = room->middle + i * edge_around(how) * CM_TILE;
    }
    filter_rows(how, tile, room->opponent, f->luminance, f->radius, 1.0, plane[0]);
    filter_rows(how, tile, red_green, f->red_green, f->radius, 1.0, plane[1]);
    filter_rows(how, tile, blue_yellow, f->blue_yellow[0], f->radius, 1.0, plane[2]);
    filter_rows(how, tile, blue_yellow, f->blue_yellow[1], f->radius, 1.0, plane[3]);
    filter_rows(how, tile, room->opponent, f->blur, f->feature_radius, 1.0, plane[4]);
    filter_rows(how, tile, room->opponent, f->edge, f->feature_radius, -1.0, plane[5]);
    filter_rows(how, tile, room->opponent, f->point, f->feature_radius, 1.0, plane[6]);
}

/* What a row of a tile looks like. Features are of Y from 0 to 1, (Y + 16) / 116, whose offset they do not see. */
static void look_at_row(const flip *how, const cm_compare_tile *tile, const tile_room *room,
                        double *const plane[BLURRED], size_t y, const tile_look *look)
{
    const cm_flip_filters *const f = &how->filters;
    const size_t width = tile->width;
    const ptrdiff_t step = (ptrdiff_t)width;
    const size_t from = (y + f->radius) * width;
    double *sum[8];
    for (size_t i = 0; i < 8; i++)
    {
        sum[i] = room->filtered + i * CM_TILE;
    }
    cm_compare_filter(width, plane[0] + from, step, f->radius, f->luminance, 1.0, sum[0]);
    cm_compare_filter(width, plane[1] + from, step, f->radius, f->red_green, 1.0, sum[1]);
    cm_compare_filter(width, plane[2] + from, step, f->radius, f->blue_yellow[0], 1.0, sum[2]);
    cm_compare_filter(width, plane[3] + from, step, f->radius, f->blue_yellow[1], 1.0, sum[3]);
    cm_compare_filter(width, plane[5] + from, step, f->feature_radius, f->blur, 1.0, sum[4]);
    cm_compare_filter(width, plane[4] + from, step, f->feature_radius, f->edge, -1.0, sum[5]);
    cm_compare_filter(width, plane[6] + from, step, f->feature_radius, f->blur, 1.0, sum[6]);
    cm_compare_filter(width, plane[4] + from, step, f->feature_radius, f->point, 1.0, sum[7]);
    for (size_t x = 0; x < width; x++)
    {
        const size_t at = y * width + x;
        const double opponent[3] = {sum[0][x], sum[1][x], sum[2][x] + sum[3][x]};
        double hunt[3];
        cm_flip_hunt_from_opponent(opponent, hunt);
        for (size_t c = 0; c < 3; c++)
        {
            look->hunt[c][at] = hunt[c];
        }
        look->edge[at] = sqrt(sum[4][x] * sum[4][x] + sum[5][x] * sum[5][x]) / 116.0;
        look->point[at] = sqrt(sum[6][x] * sum[6][x] + sum[7][x] * sum[7][x]) / 116.0;
    }
}

/* ---- a tile ---- */

static double difference_at(const flip *how, const tile_look look[2], size_t at)
{
    const double one[3] = {look[0].hunt[0][at], look[0].hunt[1][at], look[0].hunt[2][at]};
    const double other[3] = {look[1].hunt[0][at], look[1].hunt[1][at], look[1].hunt[2][at]};
    const double color = cm_flip_color_difference(one, other, how->greatest);
    const double edge = fabs(look[0].edge[at] - look[1].edge[at]);
    const double point = fabs(look[0].point[at] - look[1].point[at]);
    const double feature = pow(sqrt(0.5) * (edge > point ? edge : point), feature_exponent);
    return pow(color, 1.0 - feature);
}

static void measure(const void *user, const cm_compare_pair *pair, const cm_compare_tile *tile,
                    double *work, double *value)
{
    const flip *const how = user;
    const tile_room room = share_room(how, work);
    const uint32_t exposures = how->is_high ? how->exposures.count : 1;
    load_linear(how, &pair->reference, tile, &room, room.linear[0]);
    load_linear(how, &pair->picture, tile, &room, room.linear[1]);
    for (uint32_t e = 0; e < exposures; e++)
    {
        const double factor = how->is_high ? cm_flip_exposure_at(&how->exposures, e) : 1.0;
        for (int p = 0; p < 2; p++)
        {
            double *plane[BLURRED];
            find_opponent(how, tile, &room, room.linear[p], factor);
            filter_all_rows(how, tile, &room, plane);
            for (size_t y = 0; y < tile->height; y++)
            {
                look_at_row(how, tile, &room, plane, y, &room.look[p]);
            }
        }
        for (size_t i = 0; i < (size_t)tile->width * tile->height; i++)
        {
            const double here = difference_at(how, room.look, i);
            value[i] = e == 0 || here > value[i] || isnan(here) ? here : value[i];
        }
    }
}

/* ---- pictures ---- */

static cm_status compare(const cm_compare_pair *pair, const cm_compare_options *options,
                         const cm_image *map, int is_high, cm_map_figures *figures)
{
    flip *const how = calloc(1, sizeof *how);
    if (how == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_flip_make_filters(options->pixels_per_degree, &how->filters);
    how->greatest = cm_flip_greatest_difference();
    how->is_linear = options->linear;
    how->is_high = is_high;
    for (int i = 0; i < 256; i++)
    {
        how->srgb[i] = cm_flip_linear_from_srgb(i / 255.0);
    }
    cm_status status = CM_OK;
    if (is_high)
    {
        status = cm_flip_find_exposures(pair, options, &how->exposures);
    }
    const cm_compare_task task = {.pair = pair,
                                  .options = options,
                                  .map = map,
                                  .values = 1,
                                  .work = room_size(how),
                                  .call = measure,
                                  .measure = how};
    if (status == CM_OK)
    {
        status = cm_compare_tiles(&task, figures, NULL);
    }
    if (status == CM_OK && is_high && figures != NULL)
    {
        figures->exposure_start = how->exposures.start;
        figures->exposure_stop = how->exposures.stop;
        figures->exposure_count = how->exposures.count;
    }
    free(how);
    return status;
}

static cm_status check_and_compare(const cm_image *reference, const cm_image *picture,
                                   const cm_compare_options *options, int is_high,
                                   cm_map_figures *figures, const cm_image *map)
{
    cm_compare_request request;
    const cm_status status =
        cm_compare_request_of(reference, picture, options, figures, map, &request);
    return status != CM_OK
               ? status
               : compare(&request.pair, &request.options, request.map_wanted, is_high, figures);
}

cm_status cm_flip(const cm_image *reference, const cm_image *picture,
                  const cm_compare_options *options, cm_map_figures *figures, const cm_image *map)
{
    return check_and_compare(reference, picture, options, 0, figures, map);
}

cm_status cm_flip_hdr(const cm_image *reference, const cm_image *picture,
                      const cm_compare_options *options, cm_map_figures *figures,
                      const cm_image *map)
{
    return check_and_compare(reference, picture, options, 1, figures, map);
}
