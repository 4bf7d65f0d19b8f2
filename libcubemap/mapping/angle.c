/* SPDX-License-Identifier: MIT */
#include "angle.h"

#include <math.h>

void cm_sine_cosine_degrees(double degrees, double *sine, double *cosine)
{
    int quarters = 0;
    double angle = remquo(degrees, 90.0, &quarters) * (3.14159265358979323846 / 180.0);
    double s = sin(angle);
    double c = cos(angle);
    int odd = ((unsigned)quarters & 1u) != 0;
    int half_turn = ((unsigned)quarters & 2u) != 0;
    double turned_sine = odd ? c : s;
    double turned_cosine = odd ? -s : c;
    /* adding zero turns -0 into 0 */
    *sine = (half_turn ? -turned_sine : turned_sine) + 0.0;
    *cosine = (half_turn ? -turned_cosine : turned_cosine) + 0.0;
}
