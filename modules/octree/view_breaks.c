/* SPDX-License-Identifier: MIT
 *
 * Where what is seen breaks off, at silhouettes and creases: pixels there also heed the surfaces that pixels nearby see, since
 * voxels may reach over to them.
 */
#include "view_table.h"

/* How many pixels around one may heed it. */
static size_t radius_of(const cm_view_desk *desk, float front)
{
    const float radius = desk->heed / front + 0.5f;
    return radius >= 0.0f && radius < CM_BREAK_RADIUS ? (size_t)radius : CM_BREAK_RADIUS;
}

void cm_breaks_tell(const cm_view_desk *desk, const cm_octree_set *set, const cm_view_band *band,
                    size_t row, size_t first_row, size_t end_row)
{
    cm_break_teller teller = {
        .row = row, .width = desk->width, .heed = desk->heed, .hides = desk->hides};
    const size_t from = cm_view_row(desk, row), runs = desk->stride / CM_BREAK_RUN;
    const uint16_t *is_break = band->is_break + from / CM_BREAK_RUN;
    for (size_t run = 0; run < runs; run++)
    {
        for (uint32_t bits = is_break[run]; bits != 0; bits &= bits - 1)
        {
            const size_t column = CM_BREAK_RUN * run + (size_t)__builtin_ctz(bits);
            const size_t radius = radius_of(desk, band->front[from + column]);
            const size_t above = row > radius ? row - radius : 0;
            teller.column = column;
            teller.radius = (float)radius;
            teller.first_row = above > first_row ? above : first_row;
            teller.end_row = row + radius < end_row ? row + radius + 1 : end_row;
            teller.front = band->front[from + column];
            teller.back = band->back[from + column];
            set->tell(&teller, &band->heard);
        }
    }
}
