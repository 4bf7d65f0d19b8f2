/* SPDX-License-Identifier: MIT
 *
 * Budgets as JSON.
 */
#include <cubemap/budget.h>
#include <cubemap/number.h>

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Where the text ends: what has no room is counted all the same. */
typedef struct json_end
{
    char *text; /* NULL if size is 0 */
    size_t size;
    size_t length;
} json_end;

static void add_bytes(json_end *end, const char *bytes, size_t length)
{
    if (end->length < end->size && length < end->size - end->length)
    {
        memcpy(end->text + end->length, bytes, length);
        end->text[end->length + length] = '\0';
    }
    end->length += length;
}

static void add(json_end *end, const char *text)
{
    add_bytes(end, text, strlen(text));
}

/* The bytes of the character of UTF-8 that begins there, or 0: none that is too long, a surrogate or beyond U+10FFFF
 * (Unicode 15, table 3-7). Behind the end of the text is a zero byte, which continues nothing. */
static size_t character_length(const unsigned char *at)
{
    if (at[0] < 0x80)
    {
        return 1;
    }
    const size_t length = at[0] >= 0xc2 && at[0] < 0xe0   ? 2
                          : at[0] >= 0xe0 && at[0] < 0xf0 ? 3
                          : at[0] >= 0xf0 && at[0] < 0xf5 ? 4
                                                          : 0;
    const unsigned char low = at[0] == 0xe0 ? 0xa0 : at[0] == 0xf0 ? 0x90 : 0x80;
    const unsigned char high = at[0] == 0xed ? 0x9f : at[0] == 0xf4 ? 0x8f : 0xbf;
    if (length == 0 || at[1] < low || at[1] > high)
    {
        return 0;
    }
    for (size_t i = 2; i < length; i++)
    {
        if (at[i] < 0x80 || at[i] > 0xbf)
        {
            return 0;
        }
    }
    return length;
}

static void add_character(json_end *end, const unsigned char *at, size_t length)
{
    static const char digits[] = "0123456789abcdef";
    if (length == 0)
    {
        add(end, "\\ufffd");
    }
    else if (at[0] == '"' || at[0] == '\\')
    {
        const char escaped[2] = {'\\', (char)at[0]};
        add_bytes(end, escaped, sizeof escaped);
    }
    else if (at[0] < 0x20 || at[0] == 0x7f)
    {
        const char escaped[6] = {'\\', 'u', '0', '0', digits[at[0] / 16], digits[at[0] % 16]};
        add_bytes(end, escaped, sizeof escaped);
    }
    else
    {
        add_bytes(end, (const char *)at, length);
    }
}

/* before: a comma, blanks and the key */
static void add_text(json_end *end, const char *before, const char *text)
{
    add(end, before);
    if (text == NULL)
    {
        add(end, "null");
        return;
    }
    add(end, "\"");
    for (const unsigned char *at = (const unsigned char *)text; *at != '\0';)
    {
        const size_t length = character_length(at);
        add_character(end, at, length);
        at += length == 0 ? 1 : length;
    }
    add(end, "\"");
}

static void add_number(json_end *end, const char *before, double value)
{
    char digits[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, digits);
    add(end, before);
    add(end, digits);
}

static void add_entry(json_end *end, const cm_budget *budget, const cm_budget_entry *entry)
{
    add_text(end, "{\"name\": ", entry->name);
    add_number(end, ", \"contribution\": ", entry->contribution);
    add_text(end, ", \"unit\": ", entry->unit != NULL ? entry->unit : budget->unit);
    add_number(end, ", \"cost\": ", entry->cost);
    add(end, entry->is_required ? ", \"required\": true" : ", \"required\": false");
    add(end, entry->is_kept ? ", \"kept\": true" : ", \"kept\": false");
    add_text(end, ", \"reason\": ", entry->reason);
    add(end, "}");
}

static void add_all(json_end *end, const cm_budget *budget)
{
    add_text(end, "{\"subject\": ", budget->subject);
    add_text(end, ", \"unit\": ", budget->unit);
    add_text(end, ", \"cost_unit\": ", budget->cost_unit);
    add_number(end, ", \"error\": ", budget->error);
    add_number(end, ", \"cost\": ", budget->cost);
    add(end, ", \"entries\": [");
    for (size_t i = 0; i < budget->count; i++)
    {
        add(end, i == 0 ? "\n  " : ",\n  ");
        add_entry(end, budget, &budget->entry[i]);
    }
    add(end, "]}\n");
}

static cm_status check(const cm_budget *budget)
{
    if (budget == NULL || budget->size != sizeof *budget ||
        (budget->entry == NULL && budget->count > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = isfinite(budget->error) && isfinite(budget->cost) ? CM_OK : CM_ERROR_RANGE;
    for (size_t i = 0; i < budget->count; i++)
    {
        const cm_budget_entry *entry = &budget->entry[i];
        if (entry->size != sizeof *entry)
        {
            return CM_ERROR_ARGUMENT;
        }
        if (!isfinite(entry->contribution) || !isfinite(entry->cost))
        {
            status = CM_ERROR_RANGE;
        }
    }
    return status;
}

cm_status cm_budget_json(const cm_budget *budget, char *text, size_t size, size_t *length)
{
    if (length == NULL || (text == NULL && size > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = check(budget);
    if (status != CM_OK)
    {
        return status;
    }
    /* outputs stay as they are on failure, so that the length comes first */
    json_end measure = {NULL, 0, 0};
    add_all(&measure, budget);
    *length = measure.length;
    if (measure.length >= size)
    {
        return CM_ERROR_SPACE;
    }
    json_end end = {text, size, 0};
    add_all(&end, budget);
    return CM_OK;
}
