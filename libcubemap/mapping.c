/* SPDX-License-Identifier: MIT
 *
 * The life of a mapping, and the thin wrappers in lon/lat.
 */
#include "internal.h"

#include <stdlib.h>

/* What derives a mapping's constants from its parameters, by index in the catalogue; NULL if it has
 * none. */
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...) NULL,
#define CM_WARP(id, ...) cm_##id##_prepare_f64,
static cm_constants_f64 (*const prepare_table[])(cm_constants_f64 parameters) = {
#include <cubemap/kernel/catalogue.h>
};

/* Constants are derived in double for both precisions, and rounded once. */
static void prepare(cm_mapping *mapping)
{
    const double *parameter = mapping->parameter;
    cm_constants_f64 k = cm_make_parameters_f64(parameter[0], parameter[1]);
    k.k2 = parameter[2];
    k.k3 = parameter[3];
    k.k4 = parameter[4];
    k.k5 = parameter[5];
    if (prepare_table[mapping->index] != NULL)
    {
        k = prepare_table[mapping->index](k);
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

/* The loops for the mapping's variant. */
static void choose_loops(cm_mapping *mapping)
{
    size_t variant = mapping->constants_f64.variant != 0.0;
    const cm_batch_set *set = mapping->set;
    mapping->batch_f64 = set->f64[mapping->index].variant[variant];
    mapping->batch_f32 = set->f32[mapping->index].variant[variant];
    mapping->lanes_f64 = set->lanes_f64;
    mapping->lanes_f32 = set->lanes_f32;
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
    cm_status status = cm_specification_parse(specification, &made.index, made.parameter, NULL, 0);
    if (status != CM_OK)
    {
        return status;
    }
    status = cm_frame_check(table);
    if (status != CM_OK)
    {
        return status;
    }
    made.frame = *table;
    made.info = cm_catalogue_at(made.index);
    cm_turn_from_frame(table, &made.turn);
    made.set = cm_batch_set_find(options == NULL ? NULL : options->instructions);
    if (made.set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    int is_offered = made.info->fast != 0 && made.set->fast != NULL;
    made.tier = options == NULL || !is_offered ? CM_TIER_EXACT : options->tier;
    prepare(&made);
    choose_loops(&made);
    cm_mapping *kept = malloc(sizeof *kept);
    if (kept == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *kept = made;
    *mapping = kept;
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

uint8_t cm_forward_lonlat(const cm_mapping *mapping, double lon, double lat, double uv[2])
{
    double direction[3];
    cm_direction_from_lonlat(lon, lat, direction);
    return cm_forward(mapping, direction, uv);
}

void cm_inverse_lonlat(const cm_mapping *mapping, uint8_t face, const double uv[2],
                       double lonlat[2])
{
    double direction[3];
    cm_inverse(mapping, face, uv, direction);
    cm_lonlat_from_direction(direction, lonlat);
}
