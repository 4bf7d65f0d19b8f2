/* SPDX-License-Identifier: MIT
 *
 * Errors as people read them.
 */
#ifndef TRUTH_LENGTH_TEXT_H
#define TRUTH_LENGTH_TEXT_H

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* A length in the unit that people read, "0.12 m"; INFINITY is "refused". The text is valid until the fourth
 * call after. */
static inline const char *length_text(double metres)
{
    static char texts[4][32];
    static int next = 0;
    static const struct
    {
        double below;
        double factor;
        const char *format;
    } units[] = {{1e-6, 1e9, "%.1f nm"},     {1e-3, 1e6, "%.3g um"}, {1e-2, 1e3, "%.2g mm"},
                 {1.0, 1e2, "%.1f cm"},      {1e3, 1.0, "%.2f m"},   {1e5, 1e-3, "%.2f km"},
                 {HUGE_VAL, 1e-3, "%.0f km"}};
    char *text = texts[next++ & 3];
    snprintf(text, sizeof texts[0], "refused");
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
    {
        if (metres < units[i].below)
        {
            snprintf(text, sizeof texts[0], units[i].format, metres * units[i].factor);
            break;
        }
    }
    return text;
}

#endif
