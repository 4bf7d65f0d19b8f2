/* SPDX-License-Identifier: MIT
 *
 * The life of a mapping.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "frame_turn.h"
#include "parts.h"
#include "set_choice.h"
#include "specification.h"
#include "angle.h"

#include <stdlib.h>
#include <string.h>

/* Derives a mapping's constants from its parameters: in double and by plain C for every set, so that all compute
 * with the same. */
static cm_constants_f64 derive(size_t index, cm_constants_f64 parameters)
{
    cm_constants_f64 (*make)(cm_constants_f64) = CM_BATCH_PLAIN.f64[index].prepare;
    return make == NULL ? parameters : make(parameters);
}

/* A parameter by its name, or what it is if there is none. */
static double parameter_called(const cm_mapping *mapping, const char *name, double otherwise)
{
    for (size_t i = 0; i < mapping->info->parameter_count; i++)
    {
        if (strcmp(mapping->info->parameter[i].name, name) == 0)
        {
            return mapping->parameter[i];
        }
    }
    return otherwise;
}

/* What the kernel of the azimuthal projection takes: the field of view and beta. */
static cm_constants_f64 azimuthal_parameters(const cm_mapping *mapping)
{
    double fov = mapping->info->kind == CM_KIND_AZIMUTHAL ? parameter_called(mapping, "fov", 180.0)
                 : mapping->is_folded                     ? 180.0
                                                          : 360.0;
    fov = parameter_called(mapping, "full", 0.0) != 0.0 ? 360.0 : fov;
    return cm_make_parameters_f64(fov, parameter_called(mapping, "beta", 0.0));
}

/* The axes about the centre: those that the north pole has are turned there along the centre's meridian. */
static void turn_axes(cm_mapping *mapping)
{
    double sine_lon, cosine_lon, sine_lat, cosine_lat;
    double lon = parameter_called(mapping, "lon", 0.0);
    double lat = parameter_called(mapping, "lat", 90.0);
    cm_sine_cosine_degrees(lon, &sine_lon, &cosine_lon);
    cm_sine_cosine_degrees(lat, &sine_lat, &cosine_lat);
    const double axes[9] = {sine_lat * cosine_lon,
                            sine_lat * sine_lon,
                            -cosine_lat, /* south */
                            -sine_lon,
                            cosine_lon,
                            0.0, /* east */
                            cosine_lat * cosine_lon,
                            cosine_lat * sine_lon,
                            sine_lat}; /* outwards */
    mapping->is_turned = lon != 0.0 || lat != 90.0;
    for (int k = 0; k < 9; k++)
    {
        mapping->axes_f64[k] = axes[k];
        mapping->axes_f32[k] = (float)axes[k];
    }
}

/* Constants are derived in double for both precisions, and rounded once. */
static void prepare_constants(cm_mapping *mapping)
{
    const double *parameter = mapping->parameter;
    cm_constants_f64 k = cm_make_parameters_f64(parameter[0], parameter[1]);
    k.k2 = parameter[2];
    k.k3 = parameter[3];
    k.k4 = parameter[4];
    k.k5 = parameter[5];
    if (cm_mapping_has_parts(mapping) && mapping->info->kind != CM_KIND_DISC_SQUARE)
    {
        k = derive(mapping->azimuthal, azimuthal_parameters(mapping));
        turn_axes(mapping);
    }
    else
    {
        k = derive(mapping->index, k);
    }
    mapping->constants_f64 = k;
    mapping->constants_f32 = (cm_constants_f32){.k0 = (float)k.k0,
                                                .k1 = (float)k.k1,
                                                .k2 = (float)k.k2,
                                                .k3 = (float)k.k3,
                                                .k4 = (float)k.k4,
                                                .k5 = (float)k.k5,
                                                .k6 = (float)k.k6,
                                                .variant = (float)k.variant};
}

/* A cube has 6 faces of area 4 for the sphere's 4 pi, a square one, rhealpix six of a quarter's side, and a disc
 * pi for the 4 pi sin^2(t0 / 2) that it shows. */
static double area_scale_of(const cm_mapping *mapping)
{
    const cm_mapping_info *info = mapping->info;
    double half_sine = mapping->constants_f64.k0;
    switch (info->kind)
    {
    case CM_KIND_AZIMUTHAL:
        return 24.0 / 3.14159265358979323846 * half_sine * half_sine;
    case CM_KIND_LAYOUT:
        return strcmp(info->identifier, "rhealpix") == 0 ? 16.0 : 6.0;
    default:
        return 1.0;
    }
}

/* Whose powers underflow in float, beside corners, diagonals and axes, and whose inverse divides zero by zero where that is
 * not chosen, keep the flags. */
static void hold_flags(cm_mapping *mapping)
{
#ifdef __clang__
    /* clang divides on both sides of a choice, by zero on the one that is not taken: at corners, those of slice say */
    mapping->lone_f64 = cm_lone_held_f64;
    mapping->lone_f32 = cm_lone_held_f32;
#endif
    if (strcmp(mapping->info->identifier, "seamless") == 0)
    {
        mapping->lone_f32 = cm_lone_held_f32;
    }
    if (strcmp(mapping->info->identifier, "rhealpix") == 0)
    {
        mapping->lone_f64.inverse = cm_lone_held_f64.inverse;
        mapping->lone_f32.inverse = cm_lone_held_f32.inverse;
    }
}

/* What computes one point alone: the loops, unless there is a shorter way. */
static void choose_lone(cm_mapping *mapping, size_t variant)
{
    const cm_batch_set *set = mapping->set;
    mapping->otherwise_f64 = mapping->lone_f64 = cm_lone_by_loops_f64;
    mapping->otherwise_f32 = mapping->lone_f32 = cm_lone_by_loops_f32;
    if (set->lone_f64 != NULL && set->lone_f64[mapping->index].variant[variant].forward != NULL)
    {
        mapping->lone_f64 = set->lone_f64[mapping->index].variant[variant];
        mapping->lone_f32 = set->lone_f32[mapping->index].variant[variant];
        hold_flags(mapping);
    }
    const unsigned fast = mapping->tier == CM_TIER_FAST ? (unsigned)mapping->info->fast : 0;
    if (fast & CM_FAST_FORWARD)
    {
        mapping->lone_f64.forward = cm_lone_by_loops_f64.forward;
    }
    if (fast & CM_FAST_INVERSE)
    {
        mapping->lone_f64.inverse = cm_lone_by_loops_f64.inverse;
    }
    mapping->last_face = mapping->info->kind == CM_KIND_CUBE ? 5 : 0;
}

#ifdef CM_SMALL
/* Loops that the set leaves out are plain C's, which have the same bits there: no set of such a build fuses. */
static void fill_loops(cm_mapping *mapping, size_t variant)
{
    const cm_batch_f64 *plain = &CM_BATCH_PLAIN.f64[mapping->index].variant[variant];
    mapping->batch_f64.forward_jacobian = plain->forward_jacobian;
    mapping->batch_f64.inverse_jacobian = plain->inverse_jacobian;
    mapping->batch_f64.warp = plain->warp;
    mapping->batch_f64.unwarp = plain->unwarp;
    mapping->batch_f64.warp_jacobian = plain->warp_jacobian;
}
#endif

/* The loops for the mapping's variant. */
static void choose_loops(cm_mapping *mapping)
{
    size_t variant = mapping->constants_f64.variant != 0.0;
    const cm_batch_set *set = mapping->set;
    mapping->batch_f64 = set->f64[mapping->index].variant[variant];
    if (set->f32 != NULL)
    {
        mapping->batch_f32 = set->f32[mapping->index].variant[variant];
    }
#ifdef CM_SMALL
    fill_loops(mapping, variant);
#endif
    mapping->lanes_f64 = set->lanes_f64;
    mapping->lanes_f32 = set->lanes_f32;
    if (cm_mapping_has_parts(mapping))
    {
        mapping->batch_f64 = cm_chart_batches_f64[mapping->info->kind];
        mapping->batch_f32 = cm_chart_batches_f32[mapping->info->kind];
    }
    if (mapping->tier == CM_TIER_FAST)
    {
        const cm_batch_f64 *fast = &set->fast[mapping->index].variant[variant];
        /* more lanes are a multiple of fewer, so that the exact loops take them too */
        mapping->lanes_f64 = set->lanes_f32;
        if (mapping->info->fast & CM_FAST_FORWARD)
        {
            mapping->batch_f64.forward = fast->forward;
        }
        if (mapping->info->fast & CM_FAST_INVERSE)
        {
            mapping->batch_f64.inverse = fast->inverse;
        }
    }
    choose_lone(mapping, variant);
}

cm_status cm_mapping_create(const char *specification, const cm_frame *frame, cm_mapping **mapping)
{
    return cm_mapping_create_with(specification, frame, NULL, mapping);
}

cm_status cm_mapping_create_with(const char *specification, const cm_frame *frame,
                                 const cm_options *options, cm_mapping **mapping)
{
    if (specification == NULL || mapping == NULL ||
        (options != NULL && (options->size != sizeof(cm_options) ||
                             (options->tier != CM_TIER_EXACT && options->tier != CM_TIER_FAST))))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_frame *table = frame == NULL ? cm_frame_find("geo") : frame;
    cm_mapping made = {0};
    cm_specification read;
    cm_status status = cm_specification_parse(specification, &read, NULL, 0);
    if (status != CM_OK)
    {
        return status;
    }
    made.index = read.index;
    made.azimuthal = read.azimuthal;
    made.square = read.square;
    memcpy(made.parameter, read.parameter, sizeof made.parameter);
    status = cm_frame_check(table);
    if (status != CM_OK)
    {
        return status;
    }
    made.frame = *table;
    made.info = cm_catalogue_at(made.index);
    made.is_folded = cm_is_folded(made.info);
    /* one face has nothing to be numbered or turned */
    cm_turn_from_frame(made.info->kind == CM_KIND_CUBE ? table : cm_frame_find("geo"), &made.turn);
    made.set = cm_batch_set_find(options == NULL ? NULL : options->instructions);
    if (made.set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    int is_offered = made.info->fast != 0 && made.set->fast != NULL;
    made.tier = options == NULL || !is_offered ? CM_TIER_EXACT : options->tier;
    prepare_constants(&made);
    made.area_scale = area_scale_of(&made);
    choose_loops(&made);
    return cm_mapping_copy(&made, mapping);
}

/* A mapping points to constant tables alone, and to the texts of its frame, which are the caller's. */
cm_status cm_mapping_copy(const cm_mapping *mapping, cm_mapping **copy)
{
    if (mapping == NULL || copy == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_mapping *kept = malloc(sizeof *kept);
    if (kept == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *kept = *mapping;
    *copy = kept;
    return CM_OK;
}

void cm_mapping_destroy(cm_mapping *mapping)
{
    free(mapping);
}

const cm_mapping_info *cm_mapping_describe(const cm_mapping *mapping)
{
    return mapping->info;
}

cm_tier cm_mapping_tier(const cm_mapping *mapping)
{
    return mapping->tier;
}

const char *cm_mapping_instructions(const cm_mapping *mapping)
{
    return mapping->set->name;
}

const cm_frame *cm_mapping_frame(const cm_mapping *mapping)
{
    return &mapping->frame;
}

double cm_mapping_parameter(const cm_mapping *mapping, size_t index)
{
    return index < mapping->info->parameter_count ? mapping->parameter[index] : (double)NAN;
}
