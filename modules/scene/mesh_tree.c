/* SPDX-License-Identifier: MIT
 *
 * The tree is split where the area of boxes times their triangles is least, over bins (Wald, "On fast construction of
 * SAH-based bounding volume hierarchies", 2007). Triangles are met as in Woop, Benthin and Wald, "Watertight ray/triangle
 * intersection", JCGT 2:1 (2013), in double: an edge gives the same number, of opposite sign, to both its triangles, so that
 * no ray passes between them. Where it is 0 both are met, and no more digits are asked for. The boxes' distances are
 * widened as in Ize, "Robust BVH ray traversal", JCGT 2:2 (2013).
 */
#include "modules/memory/checked_size.h"
#include "mesh_tree.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum
{
    BINS = 12,
    LEAF = 4,        /* triangles that are not split */
    LEVELS_SAH = 40, /* below this list halves: 31 levels more at most */
    STACK = 80
};

typedef struct box
{
    double least[3], greatest[3];
} box;

typedef struct builder
{
    const cm_mesh_options *mesh;
    mesh_tree *tree;
    uint32_t used; /* nodes */
} builder;

static const box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* What a list of triangles has around itself, and their boxes' middles have. */
typedef struct extent
{
    box around, middles;
} extent;

static const extent no_extent = {
    {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}},
    {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};

/* Of numbers; the C library's ask for NaN, too, and are calls. */
static inline double lesser(double a, double b)
{
    return b < a ? b : a;
}

static inline double greater(double a, double b)
{
    return b > a ? b : a;
}

static inline void widen(box *around, const double least[3], const double greatest[3])
{
    for (int i = 0; i < 3; i++)
    {
        around->least[i] = lesser(around->least[i], least[i]);
        around->greatest[i] = greater(around->greatest[i], greatest[i]);
    }
}

static void widen_extent(extent *to, const extent *by)
{
    widen(&to->around, by->around.least, by->around.greatest);
    widen(&to->middles, by->middles.least, by->middles.greatest);
}

static const double *corner(const cm_mesh_options *mesh, uint32_t triangle, int which)
{
    return mesh->position + 3 * (size_t)mesh->index[3 * (size_t)triangle + (size_t)which];
}

static box box_of(const cm_mesh_options *mesh, uint32_t triangle)
{
    box around = nothing;
    for (int i = 0; i < 3; i++)
    {
        const double *at = corner(mesh, triangle, i);
        widen(&around, at, at);
    }
    return around;
}

/* Half the surface; 0 of nothing. */
static double area(const box *of)
{
    const double x = of->greatest[0] - of->least[0];
    const double y = of->greatest[1] - of->least[1];
    const double z = of->greatest[2] - of->least[2];
    return x >= 0.0 ? x * y + y * z + z * x : 0.0;
}

static double middle(const box *of, int axis)
{
    return 0.5 * of->least[axis] + 0.5 * of->greatest[axis];
}

static void add_box(extent *to, const box *one)
{
    const double at[3] = {middle(one, 0), middle(one, 1), middle(one, 2)};
    widen(&to->around, one->least, one->greatest);
    widen(&to->middles, at, at);
}

/* The middle of a triangle's box along one axis. */
static double middle_of(const cm_mesh_options *mesh, uint32_t triangle, int axis)
{
    const double a = corner(mesh, triangle, 0)[axis], b = corner(mesh, triangle, 1)[axis];
    const double c = corner(mesh, triangle, 2)[axis];
    return 0.5 * lesser(lesser(a, b), c) + 0.5 * greater(greater(a, b), c);
}

static extent extent_of(const cm_mesh_options *mesh, const uint32_t *list, uint32_t count)
{
    extent all = no_extent;
    for (uint32_t i = 0; i < count; i++)
    {
        const box one = box_of(mesh, list[i]);
        add_box(&all, &one);
    }
    return all;
}

/* Of the middle of a triangle's box. */
static int bin_of(const box *middles, int axis, double at)
{
    const double width = middles->greatest[axis] - middles->least[axis];
    const int bin = (int)(BINS * ((at - middles->least[axis]) / width));
    return bin < BINS ? bin : BINS - 1;
}

/* The first bin of the second part where splitting costs least. */
static int best_bin(const extent bins[BINS], const uint32_t count[BINS])
{
    double after[BINS];
    box around = nothing;
    uint32_t sum = 0;
    for (int i = BINS - 1; i > 0; i--)
    {
        widen(&around, bins[i].around.least, bins[i].around.greatest);
        sum += count[i];
        after[i] = area(&around) * sum;
    }
    around = nothing;
    sum = 0;
    int best = 1;
    double least = INFINITY;
    for (int i = 1; i < BINS; i++)
    {
        widen(&around, bins[i - 1].around.least, bins[i - 1].around.greatest);
        sum += count[i - 1];
        const double cost = area(&around) * sum + after[i];
        if (cost < least)
        {
            least = cost;
            best = i;
        }
    }
    return best;
}

static int longest_axis(const box *of)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
    {
        axis = of->greatest[i] - of->least[i] > of->greatest[axis] - of->least[axis] ? i : axis;
    }
    return axis;
}

/* Orders a part of the list: how many belong to the first half, and what both have around them; 0: it cannot be split so. */
static uint32_t split(const builder *with, uint32_t *list, uint32_t count, const box *middles,
                      extent half[2])
{
    const int axis = longest_axis(middles);
    if (!(middles->greatest[axis] > middles->least[axis]))
    {
        return 0;
    }
    extent bins[BINS];
    uint32_t counts[BINS] = {0};
    for (int i = 0; i < BINS; i++)
    {
        bins[i] = no_extent;
    }
    for (uint32_t i = 0; i < count; i++)
    {
        const box around = box_of(with->mesh, list[i]);
        const int bin = bin_of(middles, axis, middle(&around, axis));
        add_box(&bins[bin], &around);
        counts[bin]++;
    }
    const int first = best_bin(bins, counts);
    half[0] = half[1] = no_extent;
    for (int i = 0; i < BINS; i++)
    {
        widen_extent(&half[i >= first], &bins[i]);
    }
    uint32_t begin = 0;
    for (uint32_t i = 0; i < count; i++)
    {
        if (bin_of(middles, axis, middle_of(with->mesh, list[i], axis)) < first)
        {
            const uint32_t other = list[begin];
            list[begin++] = list[i];
            list[i] = other;
        }
    }
    return begin < count ? begin : 0;
}

static void build(builder *with, uint32_t node, uint32_t first, uint32_t count, int level,
                  const extent *of)
{
    uint32_t *list = with->tree->triangle + first;
    mesh_node *made = &with->tree->node[node];
    for (int i = 0; i < 3; i++)
    {
        made->least[i] = of->around.least[i];
        made->greatest[i] = of->around.greatest[i];
    }
    made->first = first;
    made->count = count;
    if (count > LEAF)
    {
        extent half[2];
        uint32_t begin = level < LEVELS_SAH ? split(with, list, count, &of->middles, half) : 0;
        if (begin == 0)
        {
            begin = count / 2;
            half[0] = extent_of(with->mesh, list, begin);
            half[1] = extent_of(with->mesh, list + begin, count - begin);
        }
        made->first = with->used;
        made->count = 0;
        with->used += 2;
        build(with, made->first, first, begin, level + 1, &half[0]);
        build(with, made->first + 1, first + begin, count - begin, level + 1, &half[1]);
    }
}

cm_status mesh_tree_make(const cm_mesh_options *mesh, mesh_tree *tree)
{
    const size_t count = mesh->triangle_count;
    mesh_tree made = {NULL, NULL};
    if (count > 0)
    {
        made.node = cm_array_of(count, 2 * sizeof *made.node);
        made.triangle = cm_array_of(count, sizeof *made.triangle);
        if (made.node == NULL || made.triangle == NULL)
        {
            free(made.node);
            free(made.triangle);
            return CM_ERROR_MEMORY;
        }
        for (size_t i = 0; i < count; i++)
        {
            made.triangle[i] = (uint32_t)i;
        }
        builder with = {mesh, &made, 1};
        const extent all = extent_of(mesh, made.triangle, (uint32_t)count);
        build(&with, 0, 0, (uint32_t)count, 0, &all);
    }
    *tree = made;
    return CM_OK;
}

/* ------------------------------------------------------------------------------- rays */

/* A ray that shears onto its greatest axis, which is the third. */
typedef struct sheared
{
    const ray *along;
    double inverse[3];
    int axis[3];
    double shear[3];
} sheared;

static sheared shear_ray(const ray *along)
{
    sheared with = {along, {0.0}, {0}, {0.0}};
    int most = 0;
    for (int i = 0; i < 3; i++)
    {
        const double inverse = 1.0 / along->direction[i];
        with.inverse[i] = isfinite(inverse) ? inverse : copysign(DBL_MAX, along->direction[i]);
        most = fabs(along->direction[i]) > fabs(along->direction[most]) ? i : most;
    }
    for (int i = 0; i < 3; i++)
    {
        with.axis[i] = (most + 1 + i) % 3;
        with.shear[i] = along->direction[with.axis[i]] / along->direction[most];
    }
    with.shear[2] = 1.0 / along->direction[most];
    return with;
}

/* The vertex as the ray sees it. */
static void shear_point(const sheared *with, const double point[3], double seen[3])
{
    double from[3];
    subtract(point, with->along->origin, from);
    const double deep = from[with->axis[2]];
    seen[0] = from[with->axis[0]] - with->shear[0] * deep;
    seen[1] = from[with->axis[1]] - with->shear[1] * deep;
    seen[2] = with->shear[2] * deep;
}

static int meet_triangle(const sheared *with, const cm_mesh_options *mesh, uint32_t triangle,
                         meeting *found)
{
    double at[3][3];
    for (int i = 0; i < 3; i++)
    {
        shear_point(with, corner(mesh, triangle, i), at[i]);
    }
    const double u = at[2][0] * at[1][1] - at[2][1] * at[1][0];
    const double v = at[0][0] * at[2][1] - at[0][1] * at[2][0];
    const double w = at[1][0] * at[0][1] - at[1][1] * at[0][0];
    const double sum = u + v + w;
    if (((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) || sum == 0.0)
    {
        return 0;
    }
    const double weight[3] = {u / sum, v / sum, w / sum};
    const double distance = weight[0] * at[0][2] + weight[1] * at[1][2] + weight[2] * at[2][2];
    if (!(distance > 0.0 && distance < found->distance))
    {
        return 0;
    }
    *found = (meeting){distance, 0, triangle, {weight[0], weight[1], weight[2]}};
    return 1;
}

/* The distance where the ray comes into the box, infinite if it does not before that end. */
static double enter_of(const mesh_node *node, const sheared *with, double end)
{
    double enter = 0.0, leave = end;
    for (int i = 0; i < 3; i++)
    {
        const double origin = with->along->origin[i];
        const double one = (node->least[i] - origin) * with->inverse[i];
        const double other = (node->greatest[i] - origin) * with->inverse[i];
        enter = greater(enter, lesser(one, other));
        leave = lesser(leave, greater(one, other) * (1.0 + 8.0 * DBL_EPSILON));
    }
    return enter <= leave ? enter : INFINITY;
}

int meet_mesh(const cm_mesh *mesh, const ray *along, meeting *found)
{
    const mesh_tree *tree = &mesh->tree;
    const sheared with = shear_ray(along);
    uint32_t waiting[STACK];
    int height = 0, any = 0;
    if (tree->node != NULL && enter_of(tree->node, &with, found->distance) < INFINITY)
    {
        waiting[height++] = 0;
    }
    while (height > 0)
    {
        const mesh_node *node = &tree->node[waiting[--height]];
        for (uint32_t i = 0; i < node->count; i++)
        {
            any |= meet_triangle(&with, &mesh->made_of, tree->triangle[node->first + i], found);
        }
        if (node->count == 0)
        {
            const double one = enter_of(&tree->node[node->first], &with, found->distance);
            const double other = enter_of(&tree->node[node->first + 1], &with, found->distance);
            const uint32_t far = one <= other ? node->first + 1 : node->first;
            if (greater(one, other) < INFINITY)
            {
                waiting[height++] = far;
            }
            if (lesser(one, other) < INFINITY)
            {
                waiting[height++] = far == node->first ? far + 1 : node->first;
            }
        }
    }
    return any;
}
