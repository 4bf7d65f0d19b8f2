/* SPDX-License-Identifier: MIT
 *
 * Ways to compensate motion, in the words of Steiner and others 2019, table 1: a scheme, what is done to the channels before
 * flows are looked for, and by what those are found.
 */
#ifndef BENCH_SIM_FIELD_METHOD_H
#define BENCH_SIM_FIELD_METHOD_H

#include <cubemap/compensate.h>

#include "modules/sim/io/optical_flow.h"

#include "field_scene.h"

/* What is done to channels, of which the first letter is the paper's transformation and the last its correction. */
typedef enum field_change
{
    CHANGE_NONE,       /* I */
    CHANGE_GLOBAL,     /* I N */
    CHANGE_LOCAL,      /* I L */
    CHANGE_EQUALIZED,  /* I H */
    CHANGE_TILES,      /* I C */
    CHANGE_GRADIENT,   /* TG */
    CHANGE_GRADIENT_N, /* TG N */
    CHANGE_CENSUS      /* TC: how many neighbours are less, for flows need numbers */
} field_change;

typedef enum field_kind
{
    KIND_UNCOMPENSATED,
    KIND_PIXELWISE,
    KIND_TRUTH, /* by the true flows: what is left is the scheme's own */
    KIND_FLOW
} field_kind;

typedef struct field_method
{
    field_kind kind;
    cm_compensation scheme;
    field_change change;
    cm_flow_method flow;
} field_method;

const char *field_change_name(field_change change);

/* All of them; only those of some flow methods, and of "true", with commas between them, if flow is not NULL. */
size_t field_methods(const char *flow, const field_method **methods);

/* As the paper writes them: "NCM-TG N dis". */
void name_method(const field_method *method, char *text, size_t size);

/* How flows are found: "dis" and so on, "true"; "" where there are none. */
const char *name_flow(const field_method *method);

/* Frames of FIELD_CHANNELS pictures, of which `now` begins at a time, into one at that time. The program ends if that fails. */
void run_method(const field_method *method, const field_scene *scene, double begin,
                const float *before, const float *now, float *corrected);

#endif
