/* SPDX-License-Identifier: MIT
 *
 * How a mapping is to be computed: with which instruction set, and how accurately.
 */
#ifndef CUBEMAP_OPTIONS_H
#define CUBEMAP_OPTIONS_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How accurate forward and inverse are in double, single points too; the functions for float, the warp
 * alone and derivatives are the same in both tiers.
 *   exact   double throughout
 *   fast    arrays of double, computed in float. Beside an edge the face may be the other one. A direction
 *           should be of a length from 1e-30 to 1e38: shorter ones lose digits, and what is zero or infinite in
 *           float is no direction; u and v are on the face up to 6e-8 beyond its edge
 * A tier says what is accurate enough: where fast is not much faster, cm_mapping_info.fast lacks that direction,
 * and exact is taken, as with the set scalar. docs/measured/accuracy.md has the bounds of both. */
typedef enum cm_tier
{
    CM_TIER_EXACT = 0, /* the default */
    CM_TIER_FAST = 1   /* arrays of double in float */
} cm_tier;

/* To be filled with zeros but for size, which is sizeof(cm_options), and for what is wanted. */
typedef struct cm_options
{
    size_t size;              /* sizeof(cm_options) */
    const char *instructions; /* one of cm_instructions_at; NULL for what the environment variable
                                 CUBEMAP_INSTRUCTIONS says, and without it for the best of them */
    cm_tier tier;             /* how accurate */
} cm_options;

/* As cm_mapping_create, with options; NULL for none.
 * Errors: those of cm_mapping_create; CM_ERROR_ARGUMENT if size or tier is none; CM_ERROR_INSTRUCTIONS if
 * this machine or this build does not have the instruction set that options or environment name. */
CM_API cm_status cm_mapping_create_with(const char *specification, const cm_frame *frame,
                                        const cm_options *options, cm_mapping **mapping);

/* The instruction sets that this build has and this machine can run, the simplest first, the default
 * last: "scalar" (one point at a time, plain C), then "sse2", "avx2" (with FMA) and "avx512" (F, DQ, BW,
 * VL) on x86-64, "neon" on AArch64. NULL if index is not below the count. All keep the bounds; their
 * results differ within them. With one set the same input gives the same bits on every machine; only
 * avx512 starts roots and quotients from approximations that makers of processors may round in other
 * ways. */
CM_API size_t cm_instructions_count(void);
CM_API const char *cm_instructions_at(size_t index);

/* Does this machine have the instruction set of that name, NULL for what the environment says? CM_OK or
 * CM_ERROR_INSTRUCTIONS; then, if message is not NULL, at most message_size bytes of one line that says
 * what is wrong and what would be right are written to it, always ended by a zero byte if
 * message_size > 0. */
CM_API cm_status cm_instructions_check(const char *name, char *message, size_t message_size);

/* The tier that a mapping uses, fast if it does in one direction at least, and the instruction set. */
CM_API cm_tier cm_mapping_tier(const cm_mapping *mapping);
CM_API const char *cm_mapping_instructions(const cm_mapping *mapping);

#ifdef __cplusplus
}
#endif

#endif
