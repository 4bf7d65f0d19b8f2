/* SPDX-License-Identifier: MIT
 *
 * Budgets: what a model leaves out, and why. Every effect or refinement that it might have says what it contributes, in which
 * unit, and what it costs; a limit of error or of cost chooses. Of the library cubemap-scene.
 *
 *   contribution the error that is made without the effect, 0 or more; the whole error is the sum over what is dropped,
 *                which is what it is at worst
 *   cost         0 or more, in one unit for all; the whole cost is the sum over what is kept
 *   texts        of the caller; they must stay as long as the struct is used. UTF-8; what is none is replaced in JSON
 */
#ifndef CUBEMAP_BUDGET_H
#define CUBEMAP_BUDGET_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An effect or a refinement. To be filled with zeros but for size and what is known. */
typedef struct cm_budget_entry
{
    size_t size;         /* sizeof(cm_budget_entry) */
    const char *name;    /* "distortion" */
    double contribution; /* the error without it */
    const char *unit;    /* of the contribution; NULL: the budget's */
    double cost;         /* what it takes */
    int is_required;     /* 1: kept, whatever the limits say */
    int is_kept;         /* 1: kept; 0: dropped */
    const char *reason;  /* why; NULL for none */
} cm_budget_entry;

/* All of them. To be filled with zeros but for size and what is known. */
typedef struct cm_budget
{
    size_t size;            /* sizeof(cm_budget) */
    const char *subject;    /* of what: "depth camera" */
    const char *unit;       /* of contributions: "m" */
    const char *cost_unit;  /* "ms" */
    double error;           /* the sum over what is dropped */
    double cost;            /* the sum over what is kept */
    size_t count;           /* of entries */
    cm_budget_entry *entry; /* NULL if there is none */
} cm_budget;

/* Keep what is needed for an error of at most that: what pays least, contribution for cost, is dropped first, and then all that
 * the limit has room for; what costs nothing and contributes is kept.
 * is_kept, reason, error and cost are written; the reasons live as long as the program.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, a size); CM_ERROR_RANGE (limit, contribution or cost below 0 or NaN, or a sum that is
 * infinite); CM_ERROR_UNSUPPORTED (an entry has another unit than the budget); CM_ERROR_MEMORY. */
CM_API cm_status cm_budget_limit_error(cm_budget *budget, double limit);

/* Keep what a cost of at most that pays for: the required entries, then those whose contribution is the most for their cost,
 * as far as they fit. Errors as there, and CM_ERROR_SPACE (the required ones alone cost more). */
CM_API cm_status cm_budget_limit_cost(cm_budget *budget, double limit);

/* error and cost from is_kept as it is. Errors as there. */
CM_API cm_status cm_budget_sum(cm_budget *budget);

/* The budget as JSON text, ended by a zero byte: one object with "subject", "unit", "cost_unit", the numbers "error" and
 * "cost", and "entries", a list of objects with "name", "contribution", "unit", "cost", "required" and "kept", true or false, and
 * "reason". Texts that are NULL are null. *length is what the text has without its zero byte, also when there is no room for
 * it: so text may be NULL if size is 0.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (a number that is not finite); CM_ERROR_SPACE, which sets *length. */
CM_API cm_status cm_budget_json(const cm_budget *budget, char *text, size_t size, size_t *length);

#ifdef __cplusplus
}
#endif

#endif
