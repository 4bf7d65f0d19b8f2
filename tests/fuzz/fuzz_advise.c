/* SPDX-License-Identifier: MIT
 *
 * Advice: any limits and any table of costs. What is refused gives nothing; what is not is in order, and what each
 * candidate misses is said in one line. Sizes, precisions and terms are enough, and less would not be.
 */
#include <cubemap/cubemap.h>

#include <math.h>
#include <string.h>

#include "fuzz.h"

enum
{
    ROWS_MAX = 2
};

static double take_number(supply *from)
{
    static const double numbers[] = {0.0,   1.0, 0.5,  2.0,  1e-12, -1.0, (double)INFINITY,
                                     1e-9,  1.8, 30.0, 1e-3, 0.2,   5.0,  (double)NAN,
                                     1e300, 0.3};
    return numbers[take_byte(from) % (sizeof numbers / sizeof numbers[0])];
}

static const char *take_name(supply *from)
{
    /* those whose statistics are quick */
    static const char *const names[] = {"gnomonic", "arvo",    "tangent:c=1.5",     "qsc",
                                        "peirce",   "nothing", "coupled-cubic:low", "algebraic"};
    return names[take_byte(from) % (sizeof names / sizeof names[0])];
}

static cm_advice_request take_request(supply *from)
{
    cm_advice_request request = {.size = sizeof request};
    request.size -= take_byte(from) == 255;
    request.limited = take_word(from) % (1u << CM_LIMIT_NUMBERS);
    request.limited |= take_byte(from) == 255 ? 1u << 30 : 0u;
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        request.limit[k] = take_number(from);
    }
    request.equal_area = take_byte(from) % 2;
    request.smooth = (cm_smoothness)(take_byte(from) % (CM_SMOOTH_ANALYTIC + 2));
    request.edge = (cm_smoothness)(take_byte(from) % (CM_SMOOTH_ANALYTIC + 2));
    request.precisions = take_byte(from) % 9;
    request.directions = take_byte(from) % 5;
    request.single = take_byte(from) % 2;
    size_t ellipsoid = take_byte(from);
    request.ellipsoid = ellipsoid % 2 ? cm_ellipsoid_at(ellipsoid / 2) : NULL;
    return request;
}

static size_t take_rows(supply *from, cm_advice_cost *row)
{
    size_t count = take_byte(from) % (ROWS_MAX + 1);
    for (size_t i = 0; i < count; i++)
    {
        row[i] = (cm_advice_cost){.specification = take_name(from),
                                  .precision = (cm_precision)(take_byte(from) % 16 % 4)};
        for (int k = 0; k < 2; k++)
        {
            row[i].ns[k] = fabs(take_number(from));
            row[i].single_ns[k] = take_number(from);
        }
    }
    return count;
}

static void check_candidate(const cm_advice_request *request, const cm_advice *advice, size_t index)
{
    char text[CM_ADVICE_TEXT];
    const cm_advice_candidate *c = cm_advice_at(advice, index);
    cm_advice_reason(advice, index, text, sizeof text);
    EXPECT((c->missed == 0) == (index < cm_advice_qualified(advice)) &&
               (c->missed == 0) == (text[0] == '\0') && is_one_line(text),
           "%zu misses %x: %s", index, c->missed, text);
    EXPECT(!c->is_near || c->missed != 0, "near and good");
    for (int k = 0; k < CM_LIMIT_COUNT; k++)
    {
        EXPECT(cm_limit_name((cm_limit)k) != NULL, "limit %d", k);
        EXPECT(k >= CM_LIMIT_NUMBERS || (c->missed >> k & 1u) == 0 ||
                   !(c->value[k] <= request->limit[k]),
               "%g is above %g", c->value[k], request->limit[k]);
    }
    if (index > 0 && c->missed == 0 && c->info->smooth_edge > CM_SMOOTH_TORN)
    {
        const cm_advice_candidate *before = cm_advice_at(advice, index - 1);
        EXPECT(before->info->smooth_edge > CM_SMOOTH_TORN &&
                   before->value[CM_LIMIT_COST] <= c->value[CM_LIMIT_COST],
               "%zu is out of order", index);
    }
    EXPECT(cm_precision_name(c->precision) != NULL, "no precision");
}

static void check_advice(supply *from)
{
    cm_advice_cost row[ROWS_MAX];
    const cm_advice_request request = take_request(from);
    cm_advice_costs costs = {.size = sizeof costs, .cost = row};
    costs.count = take_rows(from, row);
    costs.latitude_ns[take_byte(from) % 2] = take_number(from);
    cm_advice *advice = NULL;
    cm_status status = cm_advise(&request, &costs, &advice);
    EXPECT((status == CM_OK) == (advice != NULL), "status %d", (int)status);
    if (status == CM_OK)
    {
        EXPECT(cm_advice_count(advice) == costs.count, "%zu rows", costs.count);
        for (size_t i = 0; i < costs.count; i++)
        {
            check_candidate(&request, advice, i);
        }
        EXPECT(cm_advice_at(advice, costs.count) == NULL, "one too many");
    }
    cm_advice_destroy(advice);
}

static void check_sizes(supply *from)
{
    double angle = ldexp(1.0 + take_fraction(from), take_byte(from) % 40 - 36);
    double metres = take_number(from);
    cm_mapping *mapping = NULL;
    if (cm_mapping_create(take_name(from), NULL, &mapping) != CM_OK)
    {
        return;
    }
    cm_advice_size size = {.size = sizeof size};
    cm_status status = cm_advise_size(mapping, angle, &size);
    EXPECT(status == CM_OK ? size.coarsest <= angle * (1.0 + 1e-9) && size.power >= size.pixels &&
                                 size.cheaper < size.pixels && size.cheaper_share >= 0.0 &&
                                 size.cheaper_share <= 1.0
                           : size.pixels == 0,
           "%g: %g", angle, size.coarsest);
    cm_advice_precision precision = {.size = sizeof precision};
    status = cm_advise_precision(mapping, metres, &precision);
    EXPECT(status != CM_OK || (precision.error <= metres && cm_mapping_has_bounds(mapping)),
           "%g m, not %g m", precision.error, metres);
    cm_mapping_destroy(mapping);
}

static void check_terms(supply *from)
{
    const cm_ellipsoid *ellipsoid = cm_ellipsoid_at(take_byte(from));
    double metres = take_number(from);
    cm_advice_terms terms = {.size = sizeof terms};
    cm_status status = cm_advise_terms(ellipsoid, (cm_latitude)(take_byte(from) % 8),
                                       (cm_latitude)(take_byte(from) % 8), metres, &terms);
    EXPECT(status != CM_OK || metres == 0.0 || terms.error <= metres, "%g m", terms.error);
    EXPECT(status != CM_OK || terms.cheaper_terms < terms.terms || terms.terms == 0, "%d of %d",
           terms.cheaper_terms, terms.terms);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* statistics and searches take seconds with sanitizers: one at a time */
    static void (*const checks[])(supply *) = {check_terms, check_sizes, check_advice};
    supply from = {data, size};
    checks[take_byte(&from) % 3](&from);
    return 0;
}
