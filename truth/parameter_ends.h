/* SPDX-License-Identifier: MIT
 *
 * The ends of the ranges of parameters, from the catalogue: what a mapping to six faces can be at most, so that a new
 * one is tested there without being named in a test.
 */
#ifndef TRUTH_PARAMETER_ENDS_H
#define TRUTH_PARAMETER_ENDS_H

#include "truth/cube_count.h"

#include <stdio.h>

enum
{
    PARAMETER_ENDS_MOST = 128,
    PARAMETER_END_SIZE = 64
};

typedef struct parameter_ends
{
    size_t count;
    char specification[PARAMETER_ENDS_MOST][PARAMETER_END_SIZE];
} parameter_ends;

static inline void add_parameter_end(parameter_ends *to, const cm_mapping_info *info,
                                     const cm_parameter_info *parameter, double value)
{
    if (value != parameter->standard && to->count < PARAMETER_ENDS_MOST)
    {
        snprintf(to->specification[to->count++], PARAMETER_END_SIZE, "%s:%s=%.17g",
                 info->identifier, parameter->name, value);
    }
}

/* One parameter each, the others with their standard values. Of an end that is itself outside there is what is 1e-200
 * within; what is a standard value is left out. */
static inline parameter_ends list_parameter_ends(void)
{
    parameter_ends list = {0};
    for (size_t i = 0; i < cube_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        for (size_t k = 0; k < info->parameter_count; k++)
        {
            const cm_parameter_info *p = &info->parameter[k];
            add_parameter_end(&list, info, p, p->low_excluded ? p->low + 1e-200 : p->low);
            add_parameter_end(&list, info, p, p->high);
        }
    }
    return list;
}

#endif
