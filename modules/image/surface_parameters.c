/* SPDX-License-Identifier: MIT
 *
 * Parameters of a kind: NAME=NUMBER[,NAME=NUMBER...].
 */
#include "surface_kinds.h"

#include <cubemap/number.h>

cm_status cm_surface_parameters(const cm_surface_wish *wish, const cm_surface_parameter *parameter,
                                size_t count, double *value)
{
    cm_word rest = wish->words->parameters;
    unsigned given = 0;
    while (rest.text != NULL)
    {
        cm_word text;
        size_t i = 0;
        double number;
        const cm_word one = cm_word_split(rest, ',', &rest);
        const cm_word name = cm_word_split(one, '=', &text);
        while (i < count && !cm_word_is(name, parameter[i].name))
        {
            i++;
        }
        if (i == count || (given >> i & 1u))
        {
            return cm_complain(wish->complaint, CM_ERROR_PARAMETER, "'%.*s': %s", CM_SHOWN(one),
                               i == count ? "there is no such parameter"
                                          : "that parameter stands twice");
        }
        if (text.text == NULL || !cm_number_parse(text.text, text.length, &number))
        {
            return cm_complain(wish->complaint, CM_ERROR_SYNTAX, "'%.*s' is not NAME=NUMBER",
                               CM_SHOWN(one));
        }
        if (!(number >= parameter[i].low && number <= parameter[i].high))
        {
            char least[CM_NUMBER_SIZE];
            char most[CM_NUMBER_SIZE];
            cm_number_write_shortest(parameter[i].low, least);
            cm_number_write_shortest(parameter[i].high, most);
            return cm_complain(wish->complaint, CM_ERROR_RANGE, "%.*s: it must be from %s to %s",
                               CM_SHOWN(one), least, most);
        }
        value[i] = number;
        given |= 1u << i;
    }
    return CM_OK;
}
