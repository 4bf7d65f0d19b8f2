/* SPDX-License-Identifier: MIT */
#include "camera_net.h"

#include <math.h>

/* A place is beside a triangle if it is outside by less than this of its height: the border's image is curved. */
#define BESIDE 0.25

/* So much of a box around three knots is added on each side for what is beside them: two weights may be -BESIDE. */
#define ROOM (2.0f * (float)BESIDE)

enum
{
    OF_SIDE = CM_NET_RINGS - 1, /* meshes, of two triangles each */
    OF_GROUP = OF_SIDE / CM_NET_GROUPS
};

/* A knot: the field's direction, and which one from the axis. */
typedef struct knot
{
    size_t side, ring;
} knot;

/* Up to the furthest border of a direction and its neighbours, since between them borders may leap. */
static void find_directions(const cm_camera_field *field, cm_camera_net *net)
{
    const cm_field_end *end = field->end;
    for (size_t side = 0; side <= CM_FIELD_SIDES; side++)
    {
        const double before = end[side > 0 ? side - 1 : CM_FIELD_SIDES - 1].border;
        const double after = end[side < CM_FIELD_SIDES ? side + 1 : 1].border;
        const double most = fmax(end[side].border, fmax(before, after));
        net->border[side] = fmin(most, CM_FIELD_FURTHEST);
        cm_camera_field_direction((double)side, &net->cosine[side], &net->sine[side]);
    }
}

/* Closer to each other next to the axis, and up to infinity where there is no border. */
static void ray_of(const cm_camera_net *net, knot at, double ray[2])
{
    const double border = net->border[at.side];
    const double share = (double)at.ring / (CM_NET_RINGS - 1);
    const double radius = border * share / (1.0 + border * (1.0 - share));
    ray[0] = radius * net->cosine[at.side];
    ray[1] = radius * net->sine[at.side];
}

/* Around knots of a side and the next, from a ring to another, and what is beside their triangles. */
static void find_box(const cm_camera_net *net, size_t side, size_t first, size_t last, float box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = side; i <= side + 1; i++)
    {
        for (size_t ring = first; ring <= last; ring++)
        {
            const float x = net->x[i][ring];
            const float y = net->y[i][ring];
            box[0] = x < box[0] ? x : box[0];
            box[1] = y < box[1] ? y : box[1];
            box[2] = x > box[2] ? x : box[2];
            box[3] = y > box[3] ? y : box[3];
        }
    }
    const float room[2] = {ROOM * (box[2] - box[0]), ROOM * (box[3] - box[1])};
    for (int i = 0; i < 4; i++)
    {
        box[i] += i < 2 ? -room[i] : room[i - 2];
    }
}

static int is_in_box(const float box[4], const float place[2])
{
    return place[0] >= box[0] && place[0] <= box[2] && place[1] >= box[1] && place[1] <= box[3];
}

void cm_camera_net_make(const cm_lens *lens, const cm_camera_set *set, const cm_camera_field *field,
                        cm_camera_net *net)
{
    const size_t knots = (CM_FIELD_SIDES + 1) * CM_NET_RINGS;
    cm_camera_block block;
    if (net->is_made) /* and threads may read it */
    {
        return;
    }
    find_directions(field, net);
    for (size_t done = 0; done < knots; done += CM_CAMERA_BLOCK)
    {
        for (size_t i = 0; i < CM_CAMERA_BLOCK; i++)
        {
            const size_t number = done + i < knots ? done + i : 0;
            double ray[2];
            ray_of(net, (knot){number / CM_NET_RINGS, number % CM_NET_RINGS}, ray);
            block.x[i] = ray[0];
            block.y[i] = ray[1];
            block.z[i] = 1.0;
        }
        set->project(lens, (double)INFINITY, &block);
        for (size_t i = 0; i < CM_CAMERA_BLOCK && done + i < knots; i++)
        {
            const size_t number = done + i;
            net->x[number / CM_NET_RINGS][number % CM_NET_RINGS] = (float)block.aim_x[i];
            net->y[number / CM_NET_RINGS][number % CM_NET_RINGS] = (float)block.aim_y[i];
        }
    }
    for (size_t side = 0; side < CM_FIELD_SIDES; side++)
    {
        for (size_t i = 0; i < CM_NET_GROUPS; i++)
        {
            find_box(net, side, i * OF_GROUP, (i + 1) * OF_GROUP, net->box[side][i]);
        }
    }
    net->is_made = 1;
}

/* The place as a mean of three knots' images: their weights, none much below 0. 0 if it is none. */
static int weigh(const cm_camera_net *net, const knot corner[3], const double place[2],
                 double weight[3])
{
    double off[3][2];
    double all = 0.0;
    for (int i = 0; i < 3; i++)
    {
        off[i][0] = (double)net->x[corner[i].side][corner[i].ring] - place[0];
        off[i][1] = (double)net->y[corner[i].side][corner[i].ring] - place[1];
    }
    for (int i = 0; i < 3; i++)
    {
        const double *one = off[(i + 1) % 3];
        const double *other = off[(i + 2) % 3];
        weight[i] = one[0] * other[1] - one[1] * other[0];
        all += weight[i];
    }
    double least = 1.0;
    for (int i = 0; i < 3; i++)
    {
        weight[i] /= all;
        least = weight[i] > least ? least : weight[i]; /* NaN: no */
    }
    return least >= -BESIDE;
}

/* Is it in the box of both triangles of a mesh? */
static int is_in_mesh(const cm_camera_net *net, knot first, const float place[2])
{
    float box[4];
    find_box(net, first.side, first.ring, first.ring + 1, box);
    return is_in_box(box, place);
}

/* A ray as the mean of three knots. */
static void mean_of(const cm_camera_net *net, const knot corner[3], const double weight[3],
                    double ray[2])
{
    ray[0] = ray[1] = 0.0;
    for (int i = 0; i < 3; i++)
    {
        double at[2];
        ray_of(net, corner[i], at);
        ray[0] += weight[i] * at[0];
        ray[1] += weight[i] * at[1];
    }
}

int cm_camera_net_find(const cm_camera_net *net, const double place[2], size_t *next, double ray[2])
{
    const float near[2] = {(float)place[0], (float)place[1]};
    size_t i = *next;
    while (i < (size_t)CM_FIELD_SIDES * OF_SIDE * 2)
    {
        const knot first = {i / 2 / OF_SIDE, i / 2 % OF_SIDE};
        const size_t turn = i % 2;
        if (i % (OF_GROUP * 2) == 0 &&
            !is_in_box(net->box[first.side][first.ring / OF_GROUP], near))
        {
            i += (size_t)OF_GROUP * 2;
            continue;
        }
        if (turn == 0 && !is_in_mesh(net, first, near))
        {
            i += 2;
            continue;
        }
        i++;
        const knot corner[3] = {
            first, {first.side + 1, first.ring + 1}, {first.side + turn, first.ring + 1 - turn}};
        double weight[3];
        if (weigh(net, corner, place, weight))
        {
            mean_of(net, corner, weight, ray);
            *next = i;
            return 1;
        }
    }
    *next = i;
    return 0;
}
