/* SPDX-License-Identifier: MIT
 *
 * The edges of faces, and their length over the mask. An edge of a cube is an arc of a great circle, which crosses
 * meridians in the order of their longitudes and parallels in that of their latitudes, up to its highest or lowest
 * point and back from there. So where it goes from one pixel to the next is solved for, crossing by crossing, and
 * nothing is sampled.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "orient_edges.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979324
#define ALONG_BORDER 1e-12 /* radians: nearer than this an arc keeps to a meridian or the equator */
#define NUDGE 1e-6         /* of a pixel */
#define LONGEST_CHORD 0.0035 /* radians, of an edge that is no great circle: 0.2 degrees */

static double angle_between(const double a[3], const double b[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
    {
        square += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return 2.0 * asin(fmin(1.0, 0.5 * sqrt(square)));
}

/* A point of a face's side: 0 left, 1 right, 2 below, 3 above. */
static void side_point(const cm_mapping *mapping, int side, double along, double direction[3])
{
    const double across = side % 2 == 0 ? -1.0 : 1.0;
    const double uv[2] = {side % 4 < 2 ? across : along, side % 4 < 2 ? along : across};
    cm_inverse(mapping, (uint8_t)(side / 4), uv, direction);
}

/* The side before this one that is the same curve, itself if there is none: of a cube each edge is two faces'. */
static int twin_of(const cm_mapping *mapping, int side)
{
    double end[2][3], other[2][3];
    for (int i = 0; i < 2; i++)
    {
        side_point(mapping, side, i == 0 ? -0.37 : 0.37, end[i]);
    }
    for (int twin = 0; twin < side; twin++)
    {
        for (int i = 0; i < 2; i++)
        {
            side_point(mapping, twin, i == 0 ? -0.37 : 0.37, other[i]);
        }
        const double along = angle_between(end[0], other[0]) + angle_between(end[1], other[1]);
        const double back = angle_between(end[0], other[1]) + angle_between(end[1], other[0]);
        if (fmin(along, back) < 1e-6)
        {
            return twin;
        }
    }
    return side;
}

/* ---- As points ---- */

/* Pieces of one side, behind those that there are; its length. */
static double add_side(const cm_mapping *mapping, int side, size_t pieces, cm_orient_points *points)
{
    const double step = 2.0 / (double)pieces;
    double length = 0.0;
    for (size_t i = 0; i < pieces; i++)
    {
        const double along = (double)i * step - 1.0;
        double begin[3], middle[3], end[3];
        side_point(mapping, side, along, begin);
        side_point(mapping, side, along + 0.5 * step, middle);
        side_point(mapping, side, fmin(along + step, 1.0), end);
        const double first = angle_between(begin, middle);
        const double second = angle_between(middle, end);
        const double half = fmax(first, second);
        const size_t k = points->count++;
        points->x[k] = (float)middle[0];
        points->y[k] = (float)middle[1];
        points->z[k] = (float)middle[2];
        points->weight[k] = (float)(first + second);
        points->reach = half > points->reach ? half : points->reach;
        length += first + second;
    }
    return length;
}

int cm_edge_points(const cm_mapping *mapping, double length, cm_orient_points *points,
                   double *whole)
{
    const size_t pieces = (size_t)ceil(2.0 / length); /* the longest are some 1.6 / pieces */
    size_t begin[24];
    double total = 0.0;
    if (!cm_points_make(points, 24 * pieces))
    {
        return 0;
    }
    points->count = 0;
    for (int side = 0; side < 24; side++)
    {
        const int twin = twin_of(mapping, side);
        begin[side] = points->count;
        if (twin == side)
        {
            total += add_side(mapping, side, pieces, points);
            continue;
        }
        for (size_t i = begin[twin]; i < begin[twin] + pieces; i++)
        {
            total += (double)points->weight[i];
            points->weight[i] *= 2.0f;
        }
    }
    for (size_t i = 0; i < points->count; i++)
    {
        points->weight[i] = (float)((double)points->weight[i] / total);
    }
    *whole = 0.5 * total; /* each edge is the side of two faces */
    return 1;
}

/* ---- As arcs ---- */

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
    {
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* The arc between two directions that are less than half a turn apart. */
static cm_edge_arc arc_between(const double from[3], const double to[3], double weight)
{
    cm_edge_arc arc = {.weight = weight};
    double normal[3], along[3];
    double size[2] = {0.0, 0.0};
    cross(from, to, normal);
    cross(normal, from, along);
    for (int i = 0; i < 3; i++)
    {
        size[0] += from[i] * from[i];
        size[1] += along[i] * along[i];
    }
    for (int i = 0; i < 3; i++)
    {
        arc.from[i] = from[i] / sqrt(size[0]);
        arc.along[i] = along[i] / sqrt(size[1]);
    }
    arc.length = angle_between(from, to);
    return arc;
}

static int is_great_circle(const cm_mapping *mapping, int side)
{
    double from[3], to[3], normal[3];
    side_point(mapping, side, -1.0, from);
    side_point(mapping, side, 1.0, to);
    cross(from, to, normal);
    for (int i = 1; i < 16; i++)
    {
        double p[3];
        side_point(mapping, side, i / 8.0 - 1.0, p);
        if (!(fabs(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]) < 1e-9))
        {
            return 0;
        }
    }
    return 1;
}

static size_t chords_of(const cm_mapping *mapping, int side)
{
    return is_great_circle(mapping, side) ? 1 : 2 * (size_t)ceil(1.0 / LONGEST_CHORD);
}

/* Each side of a face has half of its length, since all edges are the sides of two. */
static int make_arcs(cm_orient_task *task)
{
    size_t chords[24];
    size_t count = 0;
    for (int side = 0; side < 24; side++)
    {
        chords[side] = twin_of(task->mapping, side) == side ? chords_of(task->mapping, side) : 0;
        count += chords[side];
    }
    task->arc = malloc(count * sizeof *task->arc);
    size_t begin[24];
    for (int side = 0; side < 24 && task->arc != NULL; side++)
    {
        begin[side] = task->arc_count;
        for (size_t i = 0; i < chords[side]; i++)
        {
            const double step = 2.0 / (double)chords[side];
            double from[3], to[3];
            side_point(task->mapping, side, (double)i * step - 1.0, from);
            side_point(task->mapping, side, fmin((double)(i + 1) * step - 1.0, 1.0), to);
            task->arc[task->arc_count++] = arc_between(from, to, 0.5);
        }
        const int twin = twin_of(task->mapping, side);
        for (size_t i = begin[twin]; twin != side && i < begin[twin] + chords[twin]; i++)
        {
            task->arc[i].weight += 0.5;
        }
    }
    for (size_t i = 0; i < task->arc_count; i++)
    {
        task->edges_length += task->arc[i].weight * task->arc[i].length;
    }
    return task->arc != NULL;
}

/* ---- Pixels ---- */

/* Cosine and sine of the longitude of each column's western border, by turns, and the sine of the latitude of each
 * row's northern one. */
static int make_borders(cm_orient_task *task)
{
    const size_t width = task->mask->width;
    const size_t height = task->mask->height;
    task->column = malloc((2 * width + height) * sizeof *task->column);
    if (task->column == NULL)
    {
        return 0;
    }
    task->row = task->column + 2 * width;
    for (size_t i = 0; i < width; i++)
    {
        const double lon = PI * (2.0 * (double)i / (double)width - 1.0);
        task->column[2 * i] = cos(lon);
        task->column[2 * i + 1] = sin(lon);
    }
    for (size_t i = 0; i < height; i++)
    {
        task->row[i] = sin(PI * (0.5 - (double)i / (double)height));
    }
    return 1;
}

int cm_edges_make(cm_orient_task *task)
{
    return make_arcs(task) && make_borders(task);
}

void cm_edges_free(cm_orient_task *task)
{
    free(task->arc);
    free(task->column);
}

/* ---- The way of an arc through the pixels ---- */

/* The arc's points are from cos t + along sin t, t from 0 to its length, which is less than pi. */
typedef struct walk
{
    const cm_orient_task *task;
    double from[3];
    double along[3];
    double length;
    int eastward; /* 1, -1, or 0 along a meridian */
    int upward;   /* 1, -1: northward or southward as far as the turn, or 0 along the equator */
    double reach; /* sine of the highest latitude of the great circle */
    double turn;  /* t where the latitude is highest or lowest next */
    long column;
    long row;
    long beyond_pole;   /* the column there, of a meridian */
    double next_column; /* t of the next crossings; infinite if there is none */
    double next_row;
    int row_step; /* at the next one */
} walk;

static long column_of(const walk *w, double x, double y, double nudge)
{
    const long width = (long)w->task->mask->width;
    const long column = (long)floor((atan2(y, x) / (2.0 * PI) + 0.5) * (double)width + nudge);
    return column < 0 ? column + width : column >= width ? column - width : column;
}

/* Of the border of columns ahead: how far the start is from its plane, and how fast the arc comes nearer. */
static void find_next_column(walk *w)
{
    const long width = (long)w->task->mask->width;
    const long border = w->eastward < 0 ? w->column : w->column + 1 < width ? w->column + 1 : 0;
    const double *m = &w->task->column[2 * border];
    const double off = w->eastward * (w->from[0] * m[1] - w->from[1] * m[0]);
    const double nearer = w->eastward * (w->along[1] * m[0] - w->along[0] * m[1]);
    /* the border of a single column has it on both sides */
    w->next_column = width > 1 ? atan2(fmax(off, 0.0), nearer) : (double)INFINITY;
}

/* Of the border of rows ahead, before the turn or behind it. */
static void find_next_row(walk *w, double now)
{
    w->next_row = (double)INFINITY;
    for (int behind = now >= w->turn; behind < 2 && isinf(w->next_row); behind++)
    {
        const int northward = behind ? -w->upward : w->upward;
        const long border = northward > 0 ? w->row : w->row + 1;
        const int is_one = border > 0 && border < (long)w->task->mask->height;
        const double cosine = is_one ? w->upward * w->task->row[border] / w->reach : 1.0;
        if (fabs(cosine) < 1.0)
        {
            w->next_row = behind ? w->turn + acos(cosine) : w->turn - acos(cosine);
            w->row_step = -northward;
        }
    }
}

static walk begin_walk(const cm_orient_task *task, const cm_edge_arc *arc,
                       const cm_rotation *rotation)
{
    walk w = {.task = task, .length = arc->length};
    cm_rotate_back(rotation, arc->from, w.from);
    cm_rotate_back(rotation, arc->along, w.along);
    const double normal = w.from[0] * w.along[1] - w.from[1] * w.along[0];
    const double up = w.along[2];
    w.eastward = fabs(normal) < ALONG_BORDER ? 0 : normal > 0.0 ? 1 : -1;
    w.upward = up > 0.0 || (up == 0.0 && w.from[2] >= 0.0) ? 1 : -1;
    w.reach = hypot(up, w.from[2]);
    w.turn = atan2(w.upward * up, w.upward * w.from[2]);
    return w;
}

/* In the first pixel. The nudge, parts of a pixel southward or eastward, is for arcs along a border: to which side of it
 * pixels are taken from. */
static void place_walk(walk *w, double nudge)
{
    const double height = (double)w->task->mask->height;
    const double lat = atan2(w->from[2], hypot(w->from[0], w->from[1]));
    w->row = (long)fmin(fmax(floor((0.5 - lat / PI) * height + nudge), 0.0), height - 1.0);
    if (w->reach < ALONG_BORDER)
    {
        w->next_row = (double)INFINITY;
    }
    else
    {
        find_next_row(w, 0.0);
    }
    if (w->eastward != 0)
    {
        w->column = column_of(w, w->from[0], w->from[1], nudge);
        find_next_column(w);
        return;
    }
    /* horizontal, towards the side of the pole where the arc comes from */
    const double x = w->upward * (w->from[0] * w->along[2] - w->from[2] * w->along[0]);
    const double y = w->upward * (w->from[1] * w->along[2] - w->from[2] * w->along[1]);
    w->column = column_of(w, x, y, nudge);
    w->beyond_pole = column_of(w, -x, -y, nudge);
    w->next_column = w->turn;
}

static void cross_column(walk *w)
{
    const long width = (long)w->task->mask->width;
    if (w->eastward == 0)
    {
        w->column = w->beyond_pole;
        w->next_column = (double)INFINITY;
        return;
    }
    const long column = w->column + w->eastward;
    w->column = column < 0 ? width - 1 : column < width ? column : 0;
    find_next_column(w);
}

/* The length over the mask, times its values. */
static double walk_on(walk *w, double nudge)
{
    const cm_mask *mask = w->task->mask;
    double sum = 0.0;
    double now = 0.0;
    place_walk(w, nudge);
    while (now < w->length)
    {
        const double next = fmin(fmin(w->next_column, w->next_row), w->length);
        /* of what is crossed at once the order is rounded */
        const double there = fmax(next, now);
        const size_t pixel = (size_t)w->row * mask->width + (size_t)w->column;
        sum += (there - now) * (double)mask->value[pixel];
        now = there;
        if (now < w->length && w->next_column <= w->next_row)
        {
            cross_column(w);
        }
        else if (now < w->length)
        {
            w->row += w->row_step;
            find_next_row(w, now);
        }
    }
    return sum;
}

double cm_edges_over_mask(const cm_orient_task *task, const cm_rotation *rotation)
{
    double sum = 0.0;
    for (size_t i = 0; i < task->arc_count; i++)
    {
        walk w = begin_walk(task, &task->arc[i], rotation);
        const int along = w.eastward == 0 || w.reach < ALONG_BORDER;
        const double over =
            along ? 0.5 * (walk_on(&w, NUDGE) + walk_on(&w, -NUDGE)) : walk_on(&w, 0.0);
        sum += task->arc[i].weight * over;
    }
    return sum;
}
