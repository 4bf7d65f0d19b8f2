/* SPDX-License-Identifier: MIT */
#include "mesh_widen.h"
#include "vector.h"

#include <math.h>
#include <string.h>

/* Corners go outwards by this part of the longest side at the most; of needles they would go far. */
#define MOST_PART 0.25

/* Where the sides' parallels in the distance of the margin meet: from the corner by m / sin(half its angle). */
static int widen_corners(const double corner[3][3], const double length[3], double longest,
                         double margin, double wide[3][3])
{
    for (int i = 0; i < 3; i++)
    {
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        double to_next[3], to_last[3], across[3], square = 0.0;
        for (int k = 0; k < 3; k++)
        {
            to_next[k] = (corner[next][k] - corner[i][k]) / length[i];
            to_last[k] = (corner[last][k] - corner[i][k]) / length[last];
        }
        cross(to_next, to_last, across);
        const double sine = sqrt(dot(across, across));
        for (int k = 0; k < 3; k++)
        {
            const double outwards = margin / sine * (to_next[k] + to_last[k]);
            wide[i][k] = corner[i][k] - outwards;
            square += outwards * outwards;
        }
        if (!(square <= MOST_PART * MOST_PART * longest * longest))
        {
            return 0;
        }
    }
    return 1;
}

/* Half of a rectangle of twice the sides holds a rectangle around the triangle, its longest side along one side. */
static void widen_needle(const double corner[3][3], int first, double longest, double margin,
                         double wide[3][3])
{
    const double *const from = corner[first];
    double along[3], up[3];
    for (int k = 0; k < 3; k++)
    {
        along[k] = (corner[(first + 1) % 3][k] - from[k]) / longest;
        up[k] = corner[(first + 2) % 3][k] - from[k];
    }
    const double foot = dot(up, along);
    for (int k = 0; k < 3; k++)
    {
        up[k] -= foot * along[k];
    }
    const double height = sqrt(dot(up, up));
    for (int i = 0; i < 3; i++)
    {
        const double x = i == 1 ? 2.0 * longest + 3.0 * margin : -margin;
        const double y = i == 2 ? 2.0 * height + 3.0 * margin : -margin;
        for (int k = 0; k < 3; k++)
        {
            wide[i][k] = height > 0.0 ? from[k] + x * along[k] + y / height * up[k] : from[k];
        }
    }
}

void mesh_widen(const double corner[3][3], double margin, double wide[3][3])
{
    double length[3]; /* of the side from each corner to the next */
    int first = 0;
    for (int i = 0; i < 3; i++)
    {
        double side[3];
        for (int k = 0; k < 3; k++)
        {
            side[k] = corner[(i + 1) % 3][k] - corner[i][k];
        }
        length[i] = sqrt(dot(side, side));
        first = length[i] > length[first] ? i : first;
    }
    if (!(length[0] > 0.0 && length[1] > 0.0 && length[2] > 0.0))
    {
        for (int i = 0; i < 3; i++)
        {
            memcpy(wide[i], corner[0], sizeof wide[i]);
        }
    }
    else if (!widen_corners(corner, length, length[first], margin, wide))
    {
        widen_needle(corner, first, length[first], margin, wide);
    }
}
