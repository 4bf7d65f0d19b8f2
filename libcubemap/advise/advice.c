/* SPDX-License-Identifier: MIT
 *
 * Which mappings keep the limits, in order.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "advice_object.h"

/* ---- What is asked ---- */

static int is_smoothness(cm_smoothness smoothness)
{
    return smoothness >= CM_SMOOTH_TORN && smoothness <= CM_SMOOTH_ANALYTIC;
}

static int are_limits(const cm_advice_request *request)
{
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        double least = k == CM_LIMIT_ISOTROPY || k == CM_LIMIT_ISOTROPY_MEAN ? 1.0 : 0.0;
        if ((request->limited >> k & 1u) != 0 && !(request->limit[k] >= least))
        {
            return 0;
        }
    }
    return 1;
}

static int is_request(const cm_advice_request *request)
{
    return request != NULL && request->size == sizeof *request &&
           request->limited < 1u << CM_LIMIT_NUMBERS && is_smoothness(request->smooth) &&
           is_smoothness(request->edge) && request->precisions < 1u << CM_PRECISION_COUNT &&
           request->directions <= (CM_ADVICE_FORWARD | CM_ADVICE_INVERSE) && are_limits(request);
}

static int are_times(const double forward_inverse[2])
{
    return !(forward_inverse[0] < 0.0) && !(forward_inverse[1] < 0.0);
}

static int are_costs(const cm_advice_costs *costs)
{
    if (costs == NULL || costs->size != sizeof *costs ||
        (costs->cost == NULL && costs->count > 0) || !are_times(costs->latitude_ns) ||
        !are_times(costs->latitude_single_ns))
    {
        return 0;
    }
    for (size_t i = 0; i < costs->count; i++)
    {
        const cm_advice_cost *row = &costs->cost[i];
        if (row->specification == NULL || cm_precision_name(row->precision) == NULL ||
            !are_times(row->ns) || !are_times(row->single_ns))
        {
            return 0;
        }
    }
    return 1;
}

/* ---- What a candidate is ---- */

static double cost_of(const cm_advice_request *request, const cm_advice_costs *costs, size_t index)
{
    const cm_advice_cost *row = &costs->cost[index];
    const double *ns = request->single ? row->single_ns : row->ns;
    const double *latitude = request->single ? costs->latitude_single_ns : costs->latitude_ns;
    double slower = 0.0;
    for (int direction = 0; direction < 2; direction++)
    {
        if (request->directions == 0 || (request->directions >> direction & 1u) != 0)
        {
            double both = ns[direction] + (request->ellipsoid != NULL ? latitude[direction] : 0.0);
            slower = isnan(both) ? (double)INFINITY : fmax(slower, both);
        }
    }
    return slower;
}

/* From an earlier row of the same mapping, or computed. */
static cm_status find_distortion(const cm_advice *advice, const cm_mapping *mapping,
                                 const cm_advice_globe *globe, cm_advice_candidate *candidate)
{
    for (size_t i = 0; i < candidate->index; i++)
    {
        if (strcmp(advice->candidate[i].specification, candidate->specification) == 0)
        {
            memcpy(candidate->value, advice->candidate[i].value, sizeof candidate->value);
            return CM_OK;
        }
    }
    cm_status status = cm_advice_measure(mapping, candidate->value);
    if (status == CM_OK)
    {
        cm_advice_put_on_globe(globe, candidate->value);
    }
    return status;
}

static int misses_precision(const cm_advice_request *request, cm_precision precision)
{
    const unsigned all = (1u << CM_PRECISION_COUNT) - 1u;
    unsigned usual =
        cm_advice_is_limited(request, CM_LIMIT_ERROR) ? all : 1u << CM_PRECISION_DOUBLE;
    unsigned allowed = request->precisions == 0 ? usual : request->precisions;
    return (allowed >> precision & 1u) == 0 ||
           (request->ellipsoid != NULL && precision == CM_PRECISION_FLOAT);
}

static void find_missed(const cm_advice_request *request, cm_advice_candidate *c)
{
    c->missed = 0;
    c->excess = 0.0;
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        double slack = k < CM_LIMIT_COST ? CM_ADVICE_ROUNDING : 0.0;
        if (cm_advice_is_limited(request, k) && !(c->value[k] <= request->limit[k] + slack))
        {
            double over = (c->value[k] - request->limit[k]) / request->limit[k];
            c->missed |= 1u << k;
            c->excess = fmax(c->excess, isnan(over) ? (double)INFINITY : over);
        }
    }
    int is_equal_area = (c->info->properties & CM_EQUAL_AREA) != 0;
    c->missed |= (unsigned)(request->equal_area && !is_equal_area) << CM_LIMIT_EQUAL_AREA;
    c->missed |= (unsigned)(c->info->smooth_face < request->smooth) << CM_LIMIT_SMOOTH;
    c->missed |= (unsigned)(c->info->smooth_edge < cm_advice_edge(request)) << CM_LIMIT_EDGE;
    c->missed |= (unsigned)misses_precision(request, c->precision) << CM_LIMIT_PRECISION;
}

static cm_status make_values(cm_advice *advice, const cm_advice_request *request,
                             const cm_advice_costs *costs, const cm_mapping *mapping,
                             cm_advice_candidate *c)
{
    cm_advice_globe globe;
    int has_limit = cm_advice_is_limited(request, CM_LIMIT_ERROR);
    c->info = cm_mapping_describe(mapping);
    cm_status status =
        cm_advice_globe_make(request->ellipsoid, c->info->properties,
                             has_limit ? request->limit[CM_LIMIT_ERROR] : (double)INFINITY, &globe);
    if (status == CM_OK)
    {
        status = find_distortion(advice, mapping, &globe, c);
    }
    if (status == CM_OK)
    {
        double angle = cm_advice_round_trip(mapping, c->precision);
        c->latitude = globe.latitude;
        c->value[CM_LIMIT_COST] = cost_of(request, costs, c->index);
        c->value[CM_LIMIT_ERROR] = (angle + globe.error) * globe.radius;
    }
    return status;
}

static cm_status make_candidate(cm_advice *advice, const cm_advice_request *request,
                                const cm_advice_costs *costs, size_t index)
{
    cm_mapping *mapping = NULL;
    cm_advice_candidate *c = &advice->candidate[index];
    c->index = index;
    c->precision = costs->cost[index].precision;
    cm_status status = cm_mapping_create(c->specification, NULL, &mapping);
    if (status == CM_OK && cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        status = CM_ERROR_UNSUPPORTED;
    }
    if (status == CM_OK)
    {
        status = make_values(advice, request, costs, mapping, c);
    }
    if (status == CM_OK)
    {
        find_missed(request, c);
    }
    cm_mapping_destroy(mapping);
    return status;
}

/* ---- Their order ---- */

static int count_of(unsigned bits)
{
    int count = 0;
    for (; bits != 0; bits &= bits - 1)
    {
        count++;
    }
    return count;
}

static int order(double x, double y)
{
    return (x > y) - (x < y);
}

/* Excesses that are alike but for rounding are the same, so that the cost decides. */
static double rough(double excess)
{
    return floor(excess * 1e6 + 0.5);
}

static int compare(const void *one, const void *other)
{
    const cm_advice_candidate *a = one;
    const cm_advice_candidate *b = other;
    int by_missed = count_of(a->missed) - count_of(b->missed);
    int by_tear =
        (a->info->smooth_edge == CM_SMOOTH_TORN) - (b->info->smooth_edge == CM_SMOOTH_TORN);
    int by_excess = order(rough(a->excess), rough(b->excess));
    int by_cost = order(a->value[CM_LIMIT_COST], b->value[CM_LIMIT_COST]);
    return by_missed != 0                   ? by_missed
           : a->missed == 0 && by_tear != 0 ? by_tear
           : by_excess != 0                 ? by_excess
           : by_cost != 0                   ? by_cost
                                            : order((double)a->index, (double)b->index);
}

/* Is the one cheaper than the other, or better in smoothness or distortion? */
static int is_better(const cm_advice_candidate *one, const cm_advice_candidate *other)
{
    int better = one->info->smooth_face > other->info->smooth_face ||
                 one->info->smooth_edge > other->info->smooth_edge;
    for (int k = 0; k <= CM_LIMIT_COST; k++)
    {
        better |= one->value[k] < other->value[k] - CM_ADVICE_ROUNDING;
    }
    return better;
}

/* Exactly equal areas are missed by little up to this area error. */
#define NEARLY_EQUAL_AREA 0.01

static int misses_by_little(const cm_advice *advice, const cm_advice_candidate *c)
{
    const cm_advice_request *request = &advice->request;
    const cm_advice_candidate *first = &advice->candidate[0];
    switch (c->missed)
    {
    case 1u << CM_LIMIT_EQUAL_AREA:
        return c->value[CM_LIMIT_AREA] <= NEARLY_EQUAL_AREA;
    case 1u << CM_LIMIT_SMOOTH:
        return (int)c->info->smooth_face + 1 >= (int)request->smooth;
    case 1u << CM_LIMIT_EDGE:
        return (int)c->info->smooth_edge + 1 >= (int)cm_advice_edge(request);
    case 1u << CM_LIMIT_PRECISION:
        return !(advice->has_ellipsoid && c->precision == CM_PRECISION_FLOAT) &&
               (advice->qualified == 0 || c->value[CM_LIMIT_COST] < first->value[CM_LIMIT_COST]);
    default:
        return count_of(c->missed) == 1 && c->excess <= CM_ADVICE_NEAR;
    }
}

static void put_in_order(cm_advice *advice)
{
    qsort(advice->candidate, advice->count, sizeof *advice->candidate, compare);
    for (size_t i = 0; i < advice->count; i++)
    {
        cm_advice_candidate *c = &advice->candidate[i];
        advice->qualified += c->missed == 0;
        c->is_near = misses_by_little(advice, c) &&
                     (advice->qualified == 0 || is_better(c, &advice->candidate[0]));
    }
}

/* ---- The object ---- */

/* Copies of all specifications, one behind the other. 0 if there is no memory. */
static int keep_specifications(cm_advice *advice, const cm_advice_costs *costs)
{
    size_t size = 1;
    for (size_t i = 0; i < costs->count; i++)
    {
        size += strlen(costs->cost[i].specification) + 1;
    }
    char *at = malloc(size);
    advice->specifications = at;
    for (size_t i = 0; at != NULL && i < costs->count; i++)
    {
        size_t length = strlen(costs->cost[i].specification) + 1;
        memcpy(at, costs->cost[i].specification, length);
        advice->candidate[i].specification = at;
        at += length;
    }
    return advice->specifications != NULL;
}

static cm_status fill(cm_advice *advice, const cm_advice_request *request,
                      const cm_advice_costs *costs)
{
    advice->request = *request;
    advice->request.ellipsoid = NULL;
    advice->has_ellipsoid = request->ellipsoid != NULL;
    advice->count = costs->count;
    advice->candidate = calloc(costs->count + 1, sizeof *advice->candidate);
    if (advice->candidate == NULL || !keep_specifications(advice, costs))
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = CM_OK;
    for (size_t i = 0; i < costs->count && status == CM_OK; i++)
    {
        status = make_candidate(advice, request, costs, i);
    }
    if (status == CM_OK)
    {
        put_in_order(advice);
    }
    return status;
}

cm_status cm_advise(const cm_advice_request *request, const cm_advice_costs *costs,
                    cm_advice **advice)
{
    if (!is_request(request) || !are_costs(costs) || advice == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = request->ellipsoid == NULL ? CM_OK : cm_ellipsoid_check(request->ellipsoid);
    if (status != CM_OK)
    {
        return status;
    }
    cm_advice *made = calloc(1, sizeof *made);
    status = made == NULL ? CM_ERROR_MEMORY : fill(made, request, costs);
    if (status == CM_OK)
    {
        *advice = made;
    }
    else
    {
        cm_advice_destroy(made);
    }
    return status;
}

void cm_advice_destroy(cm_advice *advice)
{
    if (advice != NULL)
    {
        free(advice->candidate);
        free(advice->specifications);
        free(advice);
    }
}

size_t cm_advice_count(const cm_advice *advice)
{
    return advice->count;
}

size_t cm_advice_qualified(const cm_advice *advice)
{
    return advice->qualified;
}

const cm_advice_candidate *cm_advice_at(const cm_advice *advice, size_t index)
{
    return index < advice->count ? &advice->candidate[index] : NULL;
}
