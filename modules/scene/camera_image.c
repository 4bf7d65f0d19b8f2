/* SPDX-License-Identifier: MIT
 *
 * Rays inside are mapped with their side kept, so the border's image goes around each of their images (the degree of a
 * map), and around nothing else. Where the field has no end, its border is that of what is looked at; where a fold ends in
 * a direction, it goes along that direction.
 */
#include "camera_image.h"

#include <stdlib.h>
#include <string.h>

/* Corners of a chain, and halvings between two sides. */
#define CORNERS_MOST 1024
#define HALVINGS_MOST 34

/* A line may be off by so much of a pixel, and of how far it is from the picture. */
#define PIXEL_ROOM 0.02
#define FAR_ROOM 0.02

/* The disc around the axis beyond which logarithms of distances are drawn, in sizes of the picture, and how many discs are as
 * far as any. Before a pole the border's image is 1e16 away, one way or the other by roundings, and would need a corner for each
 * of its turns there. */
#define DISC_SIZES 8.0
#define DISCS_MOST 1e6

/* No part of a line is longer. */
#define LEAP 0.9

/* The curve between three of its places is off its line by less than so many times what the middle one is. */
#define SAG_ROOM 4.0

/* A place of the border, and what the lens makes of it, drawn nearer. */
typedef struct place
{
    double side, radius; /* the direction's number, see camera_field.h */
    double x, y;
} place;

typedef struct chain
{
    const cm_lens *lens;
    const cm_camera_field *field;
    const double *box; /* least x and y, most x and y */
    double size;       /* the most of those, without signs */
    double disc;       /* as of the image */
    double room;       /* of a line in the picture */
    int halvings;
    cm_image_corner corner[CORNERS_MOST];
    size_t corners;
} chain;

/* What is beyond the disc nearer, in the same direction: that goes around no other points. */
static void draw_nearer(double disc, double *x, double *y)
{
    const double length = hypot(*x, *y);
    const double discs = fmin(length / disc, DISCS_MOST);
    const double scale = length > disc ? disc * (1.0 + log(discs)) / length : 1.0;
    *x *= scale;
    *y *= scale;
}

/* How far away that was. */
static double undrawn(double disc, double length)
{
    const double discs = length > disc ? exp(length / disc - 1.0) : 1.0;
    return discs > 0.999 * DISCS_MOST ? (double)INFINITY : length > disc ? disc * discs : length;
}

static place place_on(const chain *c, double side, double radius)
{
    double cosine;
    double sine;
    cm_camera_field_direction(side, &cosine, &sine);
    cm_lens_point at = cm_lens_at(c->lens, radius * cosine, radius * sine);
    draw_nearer(c->disc, &at.x, &at.y);
    return (place){side, radius, at.x, at.y};
}

static place place_at(const chain *c, double side)
{
    double cosine;
    double sine;
    cm_camera_field_direction(side, &cosine, &sine);
    const double border = cm_camera_field_border(c->field, cosine, sine);
    return place_on(c, side, fmin(border, CM_FIELD_FURTHEST));
}

/* From a line to a point. */
static double distance(double x, double y, const double from[2], const double to[2])
{
    const double way[2] = {to[0] - from[0], to[1] - from[1]};
    const double off[2] = {x - from[0], y - from[1]};
    const double length = way[0] * way[0] + way[1] * way[1];
    double share = length > 0.0 ? (way[0] * off[0] + way[1] * off[1]) / length : 0.0;
    share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    return hypot(off[0] - share * way[0], off[1] - share * way[1]);
}

static double beyond_box(const chain *c, const place *at)
{
    const double x = fmax(fmax(c->box[0] - at->x, at->x - c->box[2]), 0.0);
    const double y = fmax(fmax(c->box[1] - at->y, at->y - c->box[3]), 0.0);
    return hypot(x, y);
}

static int add_corner(chain *c, const place *at, double sag)
{
    if (c->corners == CORNERS_MOST || !(fabs(at->x) + fabs(at->y) + sag < 1e200))
    {
        return 0;
    }
    c->corner[c->corners++] = (cm_image_corner){at->x, at->y, sag};
    return 1;
}

/* Corners from one place, and not the other, of the border or of a direction. 0 if they are too many. */
static int add_between(chain *c, const place *from, const place *to, int is_direction, int halvings)
{
    const place middle = is_direction ? place_on(c, from->side, sqrt(from->radius * to->radius))
                                      : place_at(c, 0.5 * (from->side + to->side));
    const double off =
        distance(middle.x, middle.y, (double[]){from->x, from->y}, (double[]){to->x, to->y});
    const double far = fmin(beyond_box(c, &middle), fmin(beyond_box(c, from), beyond_box(c, to)));
    const double length = hypot(to->x - from->x, to->y - from->y);
    const double longer = fmax(hypot(middle.x - from->x, middle.y - from->y),
                               hypot(middle.x - to->x, middle.y - to->y));
    /* where the border leaps, the middle is at one end */
    const int is_even = longer <= LEAP * length || length <= c->room;
    if (is_even && off <= c->room + FAR_ROOM * far)
    {
        return add_corner(c, from, SAG_ROOM * off);
    }
    if (halvings > 0)
    {
        return add_between(c, from, &middle, is_direction, halvings - 1) &&
               add_between(c, &middle, to, is_direction, halvings - 1);
    }
    if (is_direction)
    {
        return add_corner(c, from, SAG_ROOM * off);
    }
    const place end = place_on(c, from->side, to->radius);
    return add_between(c, from, &end, 1, c->halvings) &&
           add_corner(c, &end, hypot(end.x - to->x, end.y - to->y));
}

/* What has no end must be far from the picture where it is no longer looked at. */
static int is_far(const chain *c, const place *at)
{
    return at->radius < CM_FIELD_FURTHEST || beyond_box(c, at) > 4.0 * c->size;
}

static int add_all(chain *c, int halvings)
{
    const cm_camera_field *field = c->field;
    c->halvings = halvings;
    c->corners = 0;
    place from = place_on(c, 0.0, fmin(field->end[0].border, CM_FIELD_FURTHEST));
    for (size_t i = 1; i <= CM_FIELD_SIDES; i++)
    {
        const place to = place_on(c, (double)i, fmin(field->end[i].border, CM_FIELD_FURTHEST));
        if (!is_far(c, &from) || !add_between(c, &from, &to, 0, c->halvings))
        {
            return 0;
        }
        from = to;
    }
    return 1;
}

/* Where the border leaps beside a pole, a line's end may be anywhere, by roundings: then no place would be known. With other
 * halvings it is elsewhere, and with fewer there are fewer corners. */
static int add_usefully(chain *c)
{
    static const int halvings[] = {HALVINGS_MOST, HALVINGS_MOST + 10, HALVINGS_MOST - 10};
    int is_added = 0;
    for (size_t i = 0; i < sizeof halvings / sizeof *halvings; i++)
    {
        is_added = add_all(c, halvings[i]);
        double most = 0.0; /* of the part of the picture that is in the room around one line */
        for (size_t k = 0; k < c->corners; k++)
        {
            const cm_image_corner *at = &c->corner[k];
            const cm_image_corner *next = &c->corner[k + 1 < c->corners ? k + 1 : 0];
            most = fmax(most, at->sag - distance(0.0, 0.0, (const double[]){at->x, at->y},
                                                 (const double[]){next->x, next->y}));
        }
        if (is_added && most < c->size)
        {
            return 1;
        }
    }
    return is_added;
}

/* The winding number of the chain, if no line is nearer than its sag and room. */
static cm_camera_reach look_around(const cm_camera_image *image, double x, double y)
{
    int winding = 0;
    for (size_t i = 0; i < image->corners; i++)
    {
        const cm_image_corner *corner = &image->corner[i];
        const cm_image_corner *next = &image->corner[i + 1 < image->corners ? i + 1 : 0];
        const double low = y - corner->sag;
        const double high = y + corner->sag;
        if ((corner->y > high && next->y > high) || (corner->y < low && next->y < low))
        {
            continue;
        }
        const double way[2] = {next->x - corner->x, next->y - corner->y};
        const double off[2] = {x - corner->x, y - corner->y};
        const double length = way[0] * way[0] + way[1] * way[1];
        const double along = way[0] * off[0] + way[1] * off[1];
        const double side = way[0] * off[1] - way[1] * off[0];
        const double share = length > 0.0 ? along / length : 0.0;
        const double held = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
        const double gap[2] = {off[0] - held * way[0], off[1] - held * way[1]};
        if (gap[0] * gap[0] + gap[1] * gap[1] <= corner->sag * corner->sag)
        {
            return CM_IMAGE_UNKNOWN;
        }
        winding += corner->y <= y && next->y > y && side > 0.0 ? 1 : 0;
        winding -= corner->y > y && next->y <= y && side < 0.0 ? 1 : 0;
    }
    return winding != 0 ? CM_IMAGE_REACHED : CM_IMAGE_MISSED;
}

static double middle_of_cell(const cm_camera_image *image, int axis, size_t cell)
{
    return image->first[axis] + ((double)cell + 0.5) / image->per_unit[axis];
}

/* The cells from one place to another, clipped. */
static void cells_between(const cm_camera_image *image, int axis, double from, double to,
                          size_t *begin, size_t *end)
{
    const double low = (from - image->first[axis]) * image->per_unit[axis];
    const double high = (to - image->first[axis]) * image->per_unit[axis];
    *begin = low > 0.0 ? (size_t)fmin(low, CM_IMAGE_CELLS) : 0;
    *end = high >= 0.0 ? (size_t)fmin(high + 1.0, CM_IMAGE_CELLS) : 0;
}

/* Cells that a line comes near. */
static void mark_line(cm_camera_image *image, const cm_image_corner *from,
                      const cm_image_corner *to)
{
    const double room = from->sag + 0.5 * hypot(1.0 / image->per_unit[0], 1.0 / image->per_unit[1]);
    size_t begin[2];
    size_t end[2];
    cells_between(image, 0, fmin(from->x, to->x) - room, fmax(from->x, to->x) + room, &begin[0],
                  &end[0]);
    cells_between(image, 1, fmin(from->y, to->y) - room, fmax(from->y, to->y) + room, &begin[1],
                  &end[1]);
    for (size_t row = begin[1]; row < end[1]; row++)
    {
        for (size_t column = begin[0]; column < end[0]; column++)
        {
            const double off =
                distance(middle_of_cell(image, 0, column), middle_of_cell(image, 1, row),
                         (const double[]){from->x, from->y}, (const double[]){to->x, to->y});
            if (off <= room)
            {
                image->reach[row][column] = CM_IMAGE_UNKNOWN;
            }
        }
    }
}

/* Neighbours between which no line is are alike. */
static void fill_cells(cm_camera_image *image)
{
    for (size_t i = 0; i < image->corners; i++)
    {
        mark_line(image, &image->corner[i], &image->corner[i + 1 < image->corners ? i + 1 : 0]);
    }
    for (size_t row = 0; row < CM_IMAGE_CELLS; row++)
    {
        cm_camera_reach last = CM_IMAGE_UNKNOWN;
        for (size_t column = 0; column < CM_IMAGE_CELLS; column++)
        {
            unsigned char *cell = &image->reach[row][column];
            if (*cell == CM_IMAGE_UNKNOWN)
            {
                last = CM_IMAGE_UNKNOWN;
                continue;
            }
            last = last != CM_IMAGE_UNKNOWN ? last
                                            : look_around(image, middle_of_cell(image, 0, column),
                                                          middle_of_cell(image, 1, row));
            *cell = (unsigned char)last;
        }
    }
}

/* The square up to which there are images. */
static double furthest_of(const cm_camera_image *image, const cm_camera_field *field)
{
    double most = 0.0;
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        if (field->end[i].border == (double)INFINITY)
        {
            return 1e200;
        }
    }
    for (size_t i = 0; i < image->corners; i++)
    {
        const cm_image_corner *corner = &image->corner[i];
        most = fmax(most, undrawn(image->disc, hypot(corner->x, corner->y) + corner->sag));
    }
    return fmin(most * most, 1e200);
}

static int has_border(const cm_camera_field *field)
{
    int has = 0;
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        has |= field->end[i].border < (double)INFINITY;
    }
    return has;
}

int cm_camera_image_find(const cm_lens *lens, cm_camera_field *field, const double box[4],
                         cm_camera_image *image)
{
    static const double nowhere[4] = {-1.0, -1.0, 1.0, 1.0};
    field->furthest = lens->is_plain ? (double)INFINITY : 1e200;
    if (!has_border(field))
    {
        return 1;
    }
    chain *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return 0;
    }
    made->lens = lens;
    made->field = field;
    made->box = box == NULL ? nowhere : box;
    made->room = PIXEL_ROOM / fmax(fabs(lens->fx), fabs(lens->fy));
    made->size = fmax(fmax(fabs(made->box[0]), fabs(made->box[2])),
                      fmax(fabs(made->box[1]), fabs(made->box[3])));
    made->disc = image->disc = DISC_SIZES * made->size;
    const int is_known = add_usefully(made);
    const size_t bytes = made->corners * sizeof *image->corner;
    image->corner = is_known ? malloc(bytes) : NULL;
    if (image->corner != NULL)
    {
        memcpy(image->corner, made->corner, bytes);
        image->corners = made->corners;
        field->furthest = furthest_of(image, field);
    }
    free(made);
    if (is_known && image->corner == NULL)
    {
        return 0;
    }
    if (is_known && box != NULL)
    {
        for (int axis = 0; axis < 2; axis++)
        {
            image->first[axis] = box[axis];
            image->per_unit[axis] = CM_IMAGE_CELLS / (box[2 + axis] - box[axis]);
        }
        fill_cells(image);
    }
    return 1;
}

/* What the cell of a place says. */
static inline cm_camera_reach reach_of_cell(const cm_camera_image *image, double x, double y)
{
    const double column = (x - image->first[0]) * image->per_unit[0];
    const double row = (y - image->first[1]) * image->per_unit[1];
    const int is_there =
        column > 0.0 && column < CM_IMAGE_CELLS && row > 0.0 && row < CM_IMAGE_CELLS;
    return is_there ? (cm_camera_reach)image->reach[(size_t)row][(size_t)column] : CM_IMAGE_UNKNOWN;
}

void cm_camera_image_drop(const cm_camera_image *image, cm_camera_block *block)
{
    if (image->corner == NULL)
    {
        return;
    }
    for (size_t i = 0; i < CM_CAMERA_BLOCK; i++)
    {
        if (reach_of_cell(image, block->aim_x[i], block->aim_y[i]) == CM_IMAGE_MISSED)
        {
            block->aim_x[i] = 0.0;
            block->aim_y[i] = 0.0;
            block->mark[i] = 0.0;
        }
    }
}

cm_camera_reach cm_camera_image_reaches(const cm_camera_image *image, double x, double y)
{
    if (image->corner == NULL)
    {
        return CM_IMAGE_UNKNOWN;
    }
    const cm_camera_reach reach = reach_of_cell(image, x, y);
    if (reach != CM_IMAGE_UNKNOWN)
    {
        return reach;
    }
    if (!(fabs(x) + fabs(y) < 0.5 * DISCS_MOST * image->disc))
    {
        return CM_IMAGE_UNKNOWN;
    }
    draw_nearer(image->disc, &x, &y);
    return look_around(image, x, y);
}
