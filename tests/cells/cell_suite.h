/* SPDX-License-Identifier: MIT
 *
 * What the suites about cell grids share: grids, and points.
 */
#ifndef TESTS_CELL_SUITE_H
#define TESTS_CELL_SUITE_H

#include "tests/suite.h"

/* A grid and its cells. */
typedef struct subject
{
    cm_grid *grid;
    cm_cell_grid *cells;
    const cm_frame *frame;
} subject;

static inline subject make_subject(const cm_grid_options *options, cm_curve curve)
{
    subject made;
    ck_assert_msg(cm_grid_create(options, &made.grid) == CM_OK, "%s", options->mapping);
    ck_assert_int_eq(cm_cell_grid_create(made.grid, curve, &made.cells), CM_OK);
    made.frame = cm_mapping_frame(cm_grid_mapping(made.grid));
    return made;
}

static inline void drop_subject(subject *made)
{
    cm_cell_grid_destroy(made->cells);
    cm_grid_destroy(made->grid);
}

/* Every mapping to six faces once, with frames, ellipsoids, rotations and curves in turn. */
static inline subject make_turn(size_t mapping)
{
    static const char *const ellipsoids[] = {"WGS84", "6371000", "6378137,50", "Mars"};
    cm_ellipsoid ellipsoid;
    cm_rotation rotation;
    ck_assert_int_eq(cm_ellipsoid_parse(ellipsoids[mapping % 4], &ellipsoid, NULL, 0), CM_OK);
    ck_assert_int_eq(cm_rotation_from_angles(17.0, -10.0, 32.0, &rotation), CM_OK);
    const cm_grid_options options = {.size = sizeof options,
                                     .mapping = cm_catalogue_at(mapping)->identifier,
                                     .frame = cm_frame_at(mapping / 2 % cm_frame_count()),
                                     .ellipsoid = &ellipsoid,
                                     .rotation = mapping % 3 == 0 ? &rotation : NULL};
    return make_subject(&options, mapping % 2 == 0 ? CM_CURVE_HILBERT : CM_CURVE_MORTON);
}

static inline cm_cell random_cell(uint64_t *state, int level)
{
    return cm_cell_at_index(level, next_bits(state) % (6ull << (2 * level)));
}

static inline const char *mapping_of(const subject *made)
{
    return cm_mapping_describe(cm_grid_mapping(made->grid))->identifier;
}

#endif
