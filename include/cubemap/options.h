/* SPDX-License-Identifier: MIT
 *
 * How a mapping is to be computed: with which instruction set. Nothing here changes what is computed,
 * only how fast; every set keeps the bounds of cm_mapping_info.bounds.
 */
#ifndef CUBEMAP_OPTIONS_H
#define CUBEMAP_OPTIONS_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>

#ifdef __cplusplus
extern "C" {
#endif

/* To be filled with zeros but for size, which is sizeof(cm_options), and for what is wanted. */
typedef struct cm_options
{
    size_t size;
    const char *instructions; /* one of cm_instructions_at; NULL for what the environment variable
                                 CUBEMAP_INSTRUCTIONS says, and without it for the best of them */
} cm_options;

/* As cm_mapping_create, with options; NULL for none.
 * Errors: those of cm_mapping_create; CM_ERROR_ARGUMENT if size is not right; CM_ERROR_INSTRUCTIONS if
 * this machine or this build does not have the instruction set that options or environment name. */
CM_API cm_status cm_mapping_create_with(const char *specification, const cm_frame *frame,
                                        const cm_options *options, cm_mapping **mapping);

/* The instruction sets that this build has and this machine can run, the simplest first, the default
 * last: "scalar" (one point at a time, plain C), then "sse2", "avx2" (with FMA) and "avx512" (F, DQ, BW,
 * VL) on x86-64, "neon" on AArch64. NULL if index is not below the count. The same input gives the same
 * bits with one set, whatever the machine; sets differ within the bounds. */
CM_API size_t cm_instructions_count(void);
CM_API const char *cm_instructions_at(size_t index);

/* The instruction set that a mapping uses. */
CM_API const char *cm_mapping_instructions(const cm_mapping *mapping);

#ifdef __cplusplus
}
#endif

#endif
