/* SPDX-License-Identifier: MIT
 *
 * What is kept within a budget: the effects that pay most for what they cost.
 */
#include <cubemap/budget.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An entry that may be kept or dropped, by what it pays. */
typedef struct offer
{
    double pay; /* contribution for cost; infinite if it costs nothing */
    double contribution;
    double cost;
    size_t index;
} offer;

static int is_amount(double value)
{
    return value >= 0.0 && value < (double)INFINITY;
}

static int is_of_unit(const cm_budget *budget, const char *unit)
{
    return unit == NULL || (budget->unit != NULL && strcmp(unit, budget->unit) == 0);
}

static cm_status check(const cm_budget *budget)
{
    double error = 0.0;
    double cost = 0.0;
    if (budget == NULL || budget->size != sizeof *budget ||
        (budget->entry == NULL && budget->count > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < budget->count; i++)
    {
        const cm_budget_entry *entry = &budget->entry[i];
        if (entry->size != sizeof *entry)
        {
            return CM_ERROR_ARGUMENT;
        }
        if (!is_amount(entry->contribution) || !is_amount(entry->cost))
        {
            return CM_ERROR_RANGE;
        }
        if (!is_of_unit(budget, entry->unit))
        {
            return CM_ERROR_UNSUPPORTED;
        }
        error += entry->contribution;
        cost += entry->cost;
    }
    return is_amount(error) && is_amount(cost) ? CM_OK : CM_ERROR_RANGE;
}

static void add_up(cm_budget *budget)
{
    budget->error = 0.0;
    budget->cost = 0.0;
    for (size_t i = 0; i < budget->count; i++)
    {
        const cm_budget_entry *entry = &budget->entry[i];
        budget->error += entry->is_kept ? 0.0 : entry->contribution;
        budget->cost += entry->is_kept ? entry->cost : 0.0;
    }
}

cm_status cm_budget_sum(cm_budget *budget)
{
    const cm_status status = check(budget);
    if (status == CM_OK)
    {
        add_up(budget);
    }
    return status;
}

/* ---- Choosing ---- */

/* The one that pays more first; of those that pay the same the one that contributes more, then the first. */
static int compare_offers(const void *left, const void *right)
{
    const offer *a = left;
    const offer *b = right;
    if (a->pay != b->pay)
    {
        return a->pay > b->pay ? -1 : 1;
    }
    if (a->contribution != b->contribution)
    {
        return a->contribution > b->contribution ? -1 : 1;
    }
    return a->index < b->index ? -1 : a->index > b->index;
}

static void decide(cm_budget *budget, size_t index, int is_kept, const char *reason)
{
    budget->entry[index].is_kept = is_kept;
    budget->entry[index].reason = reason;
}

/* All entries but those that are required, which are kept, and those that contribute nothing, which are dropped. Returns
 * their number; offers has room for all. */
static size_t collect(cm_budget *budget, offer *offers)
{
    size_t count = 0;
    for (size_t i = 0; i < budget->count; i++)
    {
        const cm_budget_entry *entry = &budget->entry[i];
        if (entry->is_required)
        {
            decide(budget, i, 1, "required");
        }
        else if (entry->contribution == 0.0)
        {
            decide(budget, i, 0, "contributes nothing");
        }
        else
        {
            const double pay =
                entry->cost > 0.0 ? entry->contribution / entry->cost : (double)INFINITY;
            offers[count++] = (offer){pay, entry->contribution, entry->cost, i};
        }
    }
    qsort(offers, count, sizeof *offers, compare_offers);
    return count;
}

static cm_status begin(cm_budget *budget, double limit, offer **offers)
{
    const cm_status status = check(budget);
    if (status != CM_OK)
    {
        return status;
    }
    if (!(limit >= 0.0))
    {
        return CM_ERROR_RANGE;
    }
    *offers = calloc(budget->count + 1, sizeof **offers);
    return *offers == NULL ? CM_ERROR_MEMORY : CM_OK;
}

cm_status cm_budget_limit_error(cm_budget *budget, double limit)
{
    offer *offers = NULL;
    const cm_status status = begin(budget, limit, &offers);
    if (status != CM_OK)
    {
        return status;
    }
    const size_t count = collect(budget, offers);
    /* from the one that pays least on, and past those that are too much: so none that is kept can be dropped after all */
    double error = 0.0;
    for (size_t i = count; i-- > 0;)
    {
        const offer *one = &offers[i];
        if (one->cost == 0.0)
        {
            decide(budget, one->index, 1, "costs nothing");
        }
        else if (error + one->contribution <= limit)
        {
            error += one->contribution;
            decide(budget, one->index, 0, "the error is within the limit without it");
        }
        else
        {
            decide(budget, one->index, 1, "the error would be beyond the limit without it");
        }
    }
    free(offers);
    add_up(budget);
    return CM_OK;
}

static double required_cost(const cm_budget *budget)
{
    double cost = 0.0;
    for (size_t i = 0; i < budget->count; i++)
    {
        cost += budget->entry[i].is_required ? budget->entry[i].cost : 0.0;
    }
    return cost;
}

cm_status cm_budget_limit_cost(cm_budget *budget, double limit)
{
    offer *offers = NULL;
    const cm_status status = begin(budget, limit, &offers);
    if (status != CM_OK)
    {
        return status;
    }
    double cost = required_cost(budget);
    if (cost > limit)
    {
        free(offers);
        return CM_ERROR_SPACE;
    }
    const size_t count = collect(budget, offers);
    for (size_t i = 0; i < count; i++)
    {
        const offer *one = &offers[i];
        const int fits = cost + one->cost <= limit;
        cost += fits ? one->cost : 0.0;
        decide(budget, one->index, fits,
               one->cost == 0.0 ? "costs nothing"
               : fits           ? "pays most for its cost"
                                : "the cost would be beyond the limit with it");
    }
    free(offers);
    add_up(budget);
    return CM_OK;
}
