/* SPDX-License-Identifier: MIT
 *
 * Budgets of any numbers and texts: limits are kept, what is refused changes nothing, and JSON has as many bytes as it says.
 */
#include <cubemap/budget.h>

#include <math.h>

#include "fuzz.h"

enum
{
    MOST = 12
};

static double take_amount(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind < 32 ? take_double(from) : kind < 128 ? kind % 8 : fabs(take_fraction(from));
}

static char *take_name(supply *from)
{
    supply part = {from->at, from->left < 6 ? from->left : 6};
    from->at += part.left;
    from->left -= part.left;
    return take_text(&part);
}

/* Sums may be rounded one way or another. */
static int is_within(double value, double limit)
{
    return value <= limit * (1.0 + 1e-12);
}

static void check_limits(cm_budget *budget, double limit)
{
    double required = 0.0;
    for (size_t i = 0; i < budget->count; i++)
    {
        required += budget->entry[i].is_required ? budget->entry[i].cost : 0.0;
    }
    const cm_status sum = cm_budget_sum(budget);
    cm_status status = cm_budget_limit_error(budget, limit);
    EXPECT((status == CM_OK) == (sum == CM_OK && limit >= 0.0), "%d, %d", (int)status, (int)sum);
    EXPECT(status != CM_OK || is_within(budget->error, limit), "%g of %g", budget->error, limit);
    status = cm_budget_limit_cost(budget, limit);
    EXPECT((status == CM_OK) == (sum == CM_OK && required <= limit), "%d, %g", (int)status, limit);
    EXPECT(status != CM_OK || is_within(budget->cost, limit), "%g of %g", budget->cost, limit);
    for (size_t i = 0; status == CM_OK && i < budget->count; i++)
    {
        const cm_budget_entry *one = &budget->entry[i];
        EXPECT(one->reason != NULL && (one->is_kept || !one->is_required), "entry %zu", i);
    }
}

static void check_json(const cm_budget *budget)
{
    size_t length = 0;
    cm_status status = cm_budget_json(budget, NULL, 0, &length);
    if (status != CM_ERROR_SPACE)
    {
        EXPECT(status == CM_ERROR_RANGE || status == CM_ERROR_ARGUMENT, "%d", (int)status);
        return;
    }
    char *text = malloc(length + 1);
    EXPECT(text != NULL, "no memory");
    EXPECT(cm_budget_json(budget, text, length, &length) == CM_ERROR_SPACE, "no room for the end");
    EXPECT(cm_budget_json(budget, text, length + 1, &length) == CM_OK, "room");
    EXPECT(strlen(text) == length, "%zu of %zu", strlen(text), length);
    for (size_t i = 0; i < length; i++)
    {
        EXPECT((unsigned char)text[i] >= 0x20 || text[i] == '\n', "a control character");
    }
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_budget_entry entries[MOST] = {{0}};
    char *names[MOST + 1];
    cm_budget budget = {.size = sizeof budget, .unit = "m", .entry = entries};
    const uint8_t kind = take_byte(&from);
    budget.size -= kind == 255;
    budget.count = take_byte(&from) % (MOST + 1);
    const double limit = take_amount(&from);
    for (size_t i = 0; i < budget.count; i++)
    {
        const uint8_t flags = take_byte(&from);
        names[i] = take_name(&from);
        entries[i] = (cm_budget_entry){.size = sizeof entries[i] - (flags == 255),
                                       .name = flags % 16 == 1 ? NULL : names[i],
                                       .contribution = take_amount(&from),
                                       .unit = flags % 32 == 2 ? names[i] : NULL,
                                       .cost = take_amount(&from),
                                       .is_required = flags % 8 == 3,
                                       .is_kept = flags % 2};
    }
    names[budget.count] = take_text(&from);
    budget.subject = names[budget.count];
    check_json(&budget);
    check_limits(&budget, limit);
    check_json(&budget);
    for (size_t i = 0; i <= budget.count; i++)
    {
        free(names[i]);
    }
    return 0;
}
