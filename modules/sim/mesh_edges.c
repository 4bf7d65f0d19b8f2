/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "mesh_edges.h"
#include "vector.h"

#include <stdlib.h>
#include <string.h>

enum
{
    FEW = 16, /* sides that are sorted by insertion */
    TRIANGLES_AT_ONCE = 16384
};

#define NO_VERTEX UINT32_MAX

/* A side of a triangle, from its lesser vertex to another one. */
typedef struct side
{
    uint32_t to;
    uint32_t triangle; /* or'ed with MESH_TURNED if the triangle goes the other way */
} side;

/* Sides by their lesser vertex: those of vertex v are from first[v] to first[v + 1]. */
typedef struct sides
{
    uint32_t *same; /* of each vertex the first one at its place */
    size_t *first;
    side *side;
} sides;

/* ---- vertices at one place ---- */

static size_t hash_of(const double place[3])
{
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++)
    {
        const double value = place[k] + 0.0; /* one zero */
        uint64_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return (size_t)hash;
}

static int is_same_place(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static cm_status merge_vertices(const cm_mesh_options *mesh, uint32_t *same)
{
    size_t room = 16;
    while (room < 2 * mesh->vertex_count)
    {
        room *= 2;
    }
    uint32_t *const table = cm_array_of(room, sizeof *table);
    if (table == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    memset(table, 0xff, room * sizeof *table);
    for (size_t i = 0; i < mesh->vertex_count; i++)
    {
        const double *place = mesh->position + 3 * i;
        size_t at = hash_of(place) & (room - 1);
        while (table[at] != NO_VERTEX &&
               !is_same_place(place, mesh->position + 3 * (size_t)table[at]))
        {
            at = (at + 1) & (room - 1);
        }
        table[at] = table[at] == NO_VERTEX ? (uint32_t)i : table[at];
        same[i] = table[at];
    }
    free(table);
    return CM_OK;
}

/* ---- sides by vertices ---- */

/* The three sides of a triangle; returns 0 of one that has only one or two places. */
static int sides_of(const cm_mesh_options *mesh, const uint32_t *same, size_t triangle,
                    uint32_t from[3], side to[3])
{
    uint32_t corner[3];
    for (int k = 0; k < 3; k++)
    {
        corner[k] = same[mesh->index[3 * triangle + (size_t)k]];
    }
    for (int k = 0; k < 3; k++)
    {
        const uint32_t a = corner[k], b = corner[(k + 1) % 3];
        from[k] = a < b ? a : b;
        to[k].to = a < b ? b : a;
        to[k].triangle = (uint32_t)triangle | (a < b ? 0 : MESH_TURNED);
    }
    return corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0];
}

static void put_sides(const cm_mesh_options *mesh, sides *to)
{
    uint32_t from[3];
    side each[3];
    for (size_t t = 0; t < mesh->triangle_count; t++)
    {
        for (int k = 0; sides_of(mesh, to->same, t, from, each) && k < 3; k++)
        {
            to->first[from[k] + 1]++;
        }
    }
    for (size_t v = 0; v < mesh->vertex_count; v++)
    {
        to->first[v + 1] += to->first[v];
    }
    const size_t count = to->first[mesh->vertex_count];
    for (size_t t = mesh->triangle_count; t-- > 0;)
    {
        for (int k = 0; sides_of(mesh, to->same, t, from, each) && k < 3; k++)
        {
            to->side[--to->first[from[k] + 1]] = each[k];
        }
    }
    /* each first is now one vertex late */
    memmove(to->first, to->first + 1, mesh->vertex_count * sizeof *to->first);
    to->first[mesh->vertex_count] = count;
}

static int compare_sides(const void *a, const void *b)
{
    const side *one = a, *other = b;
    return one->to != other->to
               ? (one->to < other->to ? -1 : 1)
               : (one->triangle > other->triangle) - (one->triangle < other->triangle);
}

static void sort_sides(size_t n, side *of)
{
    if (n > FEW)
    {
        qsort(of, n, sizeof *of, compare_sides);
        return;
    }
    for (size_t i = 1; i < n; i++)
    {
        const side kept = of[i];
        size_t k = i;
        for (; k > 0 && compare_sides(&of[k - 1], &kept) > 0; k--)
        {
            of[k] = of[k - 1];
        }
        of[k] = kept;
    }
}

/* ---- edges ---- */

/* Edges from one vertex, whose sides are sorted, to edge unless that is NULL; how many there are. */
static size_t put_edges(uint32_t vertex, size_t n, const side *of, mesh_edge *edge)
{
    size_t count = 0;
    for (size_t i = 0, end = 0; i < n; i = end)
    {
        while (end < n && of[end].to == of[i].to)
        {
            end++;
        }
        if (edge != NULL)
        {
            mesh_edge *const to = edge + count;
            to->vertex[0] = vertex;
            to->vertex[1] = of[i].to;
            to->triangle[0] = of[i].triangle & ~MESH_TURNED;
            to->triangle[1] = MESH_NO_TRIANGLE;
            if (end - i == 2)
            {
                const uint32_t other = of[i + 1].triangle;
                const int against = ((of[i].triangle ^ other) & MESH_TURNED) == 0;
                to->triangle[1] = (other & ~MESH_TURNED) | (against ? MESH_TURNED : 0);
            }
        }
        count++;
    }
    return count;
}

static cm_status collect(const cm_mesh_options *mesh, const sides *of, mesh_edges *made)
{
    for (size_t v = 0; v < mesh->vertex_count; v++)
    {
        const size_t n = of->first[v + 1] - of->first[v];
        sort_sides(n, of->side + of->first[v]);
        made->count += put_edges((uint32_t)v, n, of->side + of->first[v], NULL);
    }
    made->edge = cm_array_of(made->count + 1, sizeof *made->edge);
    if (made->edge == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    mesh_edge *next = made->edge;
    for (size_t v = 0; v < mesh->vertex_count; v++)
    {
        next +=
            put_edges((uint32_t)v, of->first[v + 1] - of->first[v], of->side + of->first[v], next);
    }
    return CM_OK;
}

cm_status mesh_edges_create(const cm_mesh *mesh, mesh_edges **made)
{
    const cm_mesh_options *options = cm_mesh_describe(mesh);
    const size_t vertices = options->vertex_count;
    mesh_edges *edges = calloc(1, sizeof *edges);
    sides all = {cm_array_of(vertices + 1, sizeof *all.same),
                 calloc(vertices + 1, sizeof *all.first),
                 cm_array_of(options->triangle_count + 1, 3 * sizeof *all.side)};
    cm_status status = edges == NULL || all.same == NULL || all.first == NULL || all.side == NULL
                           ? CM_ERROR_MEMORY
                           : merge_vertices(options, all.same);
    if (status == CM_OK)
    {
        put_sides(options, &all);
        status = collect(options, &all, edges);
    }
    free(all.same);
    free(all.first);
    free(all.side);
    if (status != CM_OK)
    {
        mesh_edges_destroy(edges);
        return status;
    }
    *made = edges;
    return CM_OK;
}

void mesh_edges_destroy(mesh_edges *edges)
{
    if (edges != NULL)
    {
        free(edges->edge);
        free(edges);
    }
}

/* ---- which side is seen ---- */

typedef struct facing_work
{
    const cm_mesh_options *mesh;
    const double *eye;
    int8_t *facing;
} facing_work;

static void face_triangles(size_t begin, size_t end, void *user)
{
    const facing_work *doing = user;
    for (size_t t = begin; t < end; t++)
    {
        const uint32_t *index = doing->mesh->index + 3 * t;
        const double *corner = doing->mesh->position + 3 * (size_t)index[0];
        double one[3], other[3], eye[3], normal[3];
        for (size_t k = 0; k < 3; k++)
        {
            one[k] = doing->mesh->position[3 * (size_t)index[1] + k] - corner[k];
            other[k] = doing->mesh->position[3 * (size_t)index[2] + k] - corner[k];
            eye[k] = doing->eye[k] - corner[k];
        }
        cross(one, other, normal);
        const double volume = dot(normal, eye);
        doing->facing[t] = (int8_t)((volume > 0.0) - (volume < 0.0));
    }
}

void mesh_edges_face(const cm_mesh *mesh, const double eye[3], cm_pool *pool, int8_t *facing)
{
    facing_work doing = {cm_mesh_describe(mesh), eye, facing};
    cm_pool_run(pool, doing.mesh->triangle_count, TRIANGLES_AT_ONCE, face_triangles, &doing);
}
