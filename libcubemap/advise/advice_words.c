/* SPDX-License-Identifier: MIT
 *
 * Limits, precisions and reasons in words.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "advice_object.h"

const char *cm_precision_name(cm_precision precision)
{
    static const char *const names[CM_PRECISION_COUNT] = {"double", "float", "fast"};
    return (unsigned)precision < CM_PRECISION_COUNT ? names[precision] : NULL;
}

const char *cm_limit_name(cm_limit limit)
{
    static const char *const names[CM_LIMIT_COUNT] = {"area error",
                                                      "area RMSE",
                                                      "isotropy",
                                                      "mean isotropy",
                                                      "isotropy RMSE",
                                                      "deformation",
                                                      "mean deformation",
                                                      "deformation RMSE",
                                                      "ns",
                                                      "error",
                                                      "equal area",
                                                      "smoothness on a face",
                                                      "smoothness across edges",
                                                      "precision"};
    return (unsigned)limit < CM_LIMIT_COUNT ? names[limit] : NULL;
}

/* Cut where the text is full. */
static void append(char text[CM_ADVICE_TEXT], const char *more)
{
    size_t used = strlen(text);
    snprintf(text + used, CM_ADVICE_TEXT - used, "%s", more);
}

/* A part of the sentence begins. */
static void begin(char text[CM_ADVICE_TEXT])
{
    append(text, text[0] == '\0' ? "" : "; ");
}

static void append_number(char text[CM_ADVICE_TEXT], double value, int digits)
{
    char number[CM_NUMBER_SIZE];
    cm_number_write(value, digits, number);
    append(text, number);
}

/* "isotropy 1.732, 0.232 more than 1.5"; angles in degrees. */
static void tell_number(char text[CM_ADVICE_TEXT], int limit, double value, double most)
{
    int is_angle = limit >= CM_LIMIT_DEFORMATION && limit <= CM_LIMIT_DEFORMATION_RMSE;
    double unit = is_angle ? 3.14159265358979324 / 180.0 : 1.0;
    const char *name = is_angle ? " degrees" : limit == CM_LIMIT_ERROR ? " m" : "";
    append(text, cm_limit_name((cm_limit)limit));
    append(text, " ");
    append_number(text, value / unit, 4);
    append(text, name);
    append(text, ", ");
    append_number(text, (value - most) / unit, 3);
    append(text, " more than ");
    append_number(text, most / unit, 6);
}

static void tell_numbers(const cm_advice *advice, const cm_advice_candidate *c,
                         char text[CM_ADVICE_TEXT])
{
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        if ((c->missed >> k & 1u) == 0)
        {
            continue;
        }
        begin(text);
        if (k == CM_LIMIT_ERROR && isnan(c->value[k]))
        {
            append(text, "no promise of its error with these parameters");
        }
        else if (k == CM_LIMIT_COST && isinf(c->value[k]))
        {
            append(text, "its time is not known");
        }
        else
        {
            tell_number(text, k, c->value[k], advice->request.limit[k]);
        }
    }
}

static void tell_others(const cm_advice *advice, const cm_advice_candidate *c,
                        char text[CM_ADVICE_TEXT])
{
    if ((c->missed >> CM_LIMIT_EQUAL_AREA & 1u) != 0)
    {
        begin(text);
        append(text, "not equal-area, area error ");
        append_number(text, c->value[CM_LIMIT_AREA], 4);
    }
    if ((c->missed >> CM_LIMIT_SMOOTH & 1u) != 0)
    {
        begin(text);
        append(text, "not so smooth on a face");
    }
    if ((c->missed >> CM_LIMIT_EDGE & 1u) != 0)
    {
        begin(text);
        append(text, c->info->smooth_edge == CM_SMOOTH_TORN ? "torn across edges"
                                                            : "not so smooth across edges");
    }
    if ((c->missed >> CM_LIMIT_PRECISION & 1u) != 0)
    {
        begin(text);
        append(text, "precision ");
        append(text, cm_precision_name(c->precision));
        append(text, advice->has_ellipsoid && c->precision == CM_PRECISION_FLOAT
                         ? ", which has no grids on ellipsoids"
                         : ", which is not asked for");
    }
}

void cm_advice_reason(const cm_advice *advice, size_t index, char *text, size_t size)
{
    char reason[CM_ADVICE_TEXT] = "";
    const cm_advice_candidate *c = cm_advice_at(advice, index);
    if (c != NULL)
    {
        tell_numbers(advice, c, reason);
        tell_others(advice, c, reason);
    }
    if (size > 0)
    {
        snprintf(text, size, "%s", reason);
    }
}
