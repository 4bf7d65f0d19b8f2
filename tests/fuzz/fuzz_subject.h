/* SPDX-License-Identifier: MIT
 *
 * A mapping that the input chooses, with the instruction set that computes it, and how accurate it has
 * to be.
 */
#ifndef TESTS_FUZZ_SUBJECT_H
#define TESTS_FUZZ_SUBJECT_H

#include <cubemap/cubemap.h>
#include <cubemap/options.h>

#include "truth/hard_points.h"
#include "truth/sphere.h"
#include "fuzz.h"

typedef struct subject
{
    cm_mapping *mapping;
    int standard;     /* are all parameters the standard ones? */
    double bound;     /* of a round trip in double, radians */
    double bound_f32; /* in float */
    char specification[128];
} subject;

/* A value inside a parameter's range: its ends and what lies beside them are likely. */
static inline double take_parameter(supply *from, const cm_parameter_info *parameter)
{
    double width = parameter->high - parameter->low;
    double value = parameter->low + width * (0.5 + 0.5 * take_fraction(from));
    switch (take_byte(from) % 4)
    {
    case 0:
        value = parameter->low + width * 1e-300;
        break;
    case 1:
        value = parameter->high;
        break;
    case 2:
        value = parameter->high - 0x1p-50 * (double)take_byte(from);
        break;
    default:
        break;
    }
    value = parameter->whole ? floor(value) : value;
    return parameter->low_excluded && value <= parameter->low ? parameter->standard : value;
}

/* The slope of the mapping at the edge of a face, by which a round trip divides the rounding of u;
 * as in tests/mapping/test_mappings.c. */
static inline double slope_at_edge(const cm_mapping *mapping)
{
    const double edge[2] = {1.0 - 1e-6, 0.0};
    double pq[2];
    EXPECT(cm_unwarp(mapping, edge, pq) == CM_OK, "a mapping with parameters warps");
    return fmin(1.0, 1e-6 / (1.0 - pq[0]));
}

/* The published bounds are those of the standard parameters. */
static inline void set_bounds(subject *made)
{
    const cm_mapping_info *info = cm_mapping_describe(made->mapping);
    made->bound = info->bounds.round_trip * 0x1p-53;
    made->bound_f32 = info->bounds.round_trip * 0x1p-24;
    if (info->kind != CM_KIND_CUBE && (!made->standard || info->bounds.round_trip == 0.0))
    {
        /* beside the antipode, or the rim of a view from afar, half of the digits are left; far off it 500 nm */
        made->bound = 64.0 * sqrt(0x1p-53);
        made->bound_f32 = 64.0 * sqrt(0x1p-24);
    }
    else if (strcmp(made->specification, "cobe:legacy=1") == 0) /* the published inverse is none */
    {
        made->bound = made->bound_f32 = 1400.0 / EARTH_RADIUS;
    }
    else if (!made->standard && info->kind == CM_KIND_CUBE)
    {
        double slope = slope_at_edge(made->mapping);
        /* without a slope (smoothstep:c=1) only half of the digits are left */
        made->bound = (slope < 0.01 ? sqrt(0x1p-53) : fmax(5e-9, 1e-9 / slope) / EARTH_RADIUS);
        made->bound_f32 = slope < 0.01 ? 4.0 * sqrt(0x1p-24) : fmax(1e-6, 3.0 * 0x1p-24 / slope);
    }
}

/* Whether a parameter is left out: one of full and fov, beta, which is of few parts, and fields of view so narrow
 * or so wide that a round trip cannot be told from none. */
static inline int is_left_out(const cm_mapping_info *info, const cm_parameter_info *parameter,
                              uint8_t choice)
{
    if (info->kind == CM_KIND_CUBE)
    {
        return 0;
    }
    return strcmp(parameter->name, "beta") == 0 || strcmp(parameter->name, "fov") == 0
               ? 1
               : strcmp(parameter->name, "full") == 0 && choice % 2 == 0;
}

/* frame NULL lets the input choose one of the library's. To be given to drop_subject. */
static inline subject take_subject(supply *from, const cm_frame *frame)
{
    const cm_mapping_info *info = cm_catalogue_at(take_byte(from) % cm_catalogue_count());
    uint8_t choice = take_byte(from);
    cm_options options = {.size = sizeof options};
    options.instructions = cm_instructions_at(take_byte(from) % cm_instructions_count());
    const cm_frame *known = cm_frame_at(choice % cm_frame_count());
    subject made = {.standard = choice < 128 || info->parameter_count == 0};
    int length = snprintf(made.specification, sizeof made.specification, "%s", info->identifier);
    /* a layout's parts come first */
    int given = info->parts != NULL && !made.standard;
    if (given)
    {
        length += snprintf(made.specification + length, sizeof made.specification - (size_t)length,
                           ":%s", info->parts);
    }
    for (size_t i = 0; i < info->parameter_count && !made.standard; i++)
    {
        double value = take_parameter(from, &info->parameter[i]);
        if (!is_left_out(info, &info->parameter[i], choice))
        {
            length +=
                snprintf(made.specification + length, sizeof made.specification - (size_t)length,
                         "%c%s=%.17g", given++ ? ',' : ':', info->parameter[i].name, value);
        }
    }
    cm_status status = cm_mapping_create_with(made.specification, frame != NULL ? frame : known,
                                              &options, &made.mapping);
    EXPECT(status == CM_OK, "%s: %s", made.specification, cm_status_text(status));
    set_bounds(&made);
    return made;
}

static inline void drop_subject(const subject *made)
{
    cm_mapping_destroy(made->mapping);
}

/* Has it no point for some directions? */
static inline int is_partial(const subject *made)
{
    cm_kind kind = cm_mapping_describe(made->mapping)->kind;
    return kind == CM_KIND_AZIMUTHAL || kind == CM_KIND_DISC_SQUARE;
}

/* Is there nothing at some points of its square? */
static inline int has_gaps(const subject *made)
{
    return is_partial(made) ||
           strcmp(cm_mapping_describe(made->mapping)->identifier, "rhealpix") == 0;
}

static inline int is_one_face(const subject *made)
{
    return cm_mapping_describe(made->mapping)->kind != CM_KIND_CUBE;
}

static inline int is_hybrid(const subject *made)
{
    return cm_mapping_describe(made->mapping)->family == CM_FAMILY_HYBRID;
}

#endif
