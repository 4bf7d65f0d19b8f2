/* SPDX-License-Identifier: MIT
 *
 * Ways to compensate motion, in the words of Steiner and others 2019, table 1: a scheme, what is done to the channels before
 * flows are looked for, and by what those are found.
 */
#ifndef CUBEMAP_TOOLS_TOF_FIELD_METHOD_H
#define CUBEMAP_TOOLS_TOF_FIELD_METHOD_H

#include <cubemap/compensate.h>

#include "modules/sim/io/vision.h"

#include "field_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* All of the flow methods with a 1, and of true flows. */
size_t field_methods(const int is_asked[CM_FLOW_METHODS], const field_method **methods);

/* As the paper writes them: "NCM-TG N dis". */
void name_method(const field_method *method, char *text, size_t size);

/* How flows are found: "dis" and so on, "true"; "" where there are none. */
const char *name_flow(const field_method *method);

/* Frames of FIELD_CHANNELS pictures, of which `now` begins at a time, into one at that time. The message is one line, written
 * on failure. Not in several threads at a time. */
cm_status run_method(const cm_vision *vision, const field_method *method, const field_scene *scene,
                     double begin, const float *before, const float *now, float *corrected,
                     char *message);

#ifdef __cplusplus
}
#endif

#endif
