/* SPDX-License-Identifier: MIT
 *
 * Distortion of every mapping, by the library's statistics.
 */
#include "bench.h"

#include <stdlib.h>

void distort(const cm_mapping *mapping, double tolerance, int with_percentiles, distortion *d)
{
    for (int k = 0; k < QUANTITIES * MEASURES; k++)
    {
        cm_quantity quantity = (cm_quantity)(k / MEASURES);
        int measure = k % MEASURES;
        const cm_statistics_options options = {
            .size = sizeof options, .measure = (cm_measure)measure, .tolerance = tolerance};
        cm_statistics *s = &d->of[quantity][measure];
        s->size = sizeof *s;
        cm_status status = cm_distortion_statistics(mapping, quantity, &options, s);
        if (status == CM_OK && with_percentiles)
        {
            status = cm_distortion_percentiles(mapping, quantity, &options, PERCENTILES,
                                               percentiles, d->percentile[quantity][measure], NULL);
        }
        if (status != CM_OK)
        {
            fprintf(harness_err(), "%s: distortion: %s\n", program_name, cm_status_text(status));
            harness_end();
        }
    }
}

void measure_distortion(suite *all, stage part)
{
    for (size_t i = 0; i < all->subject_count; i++)
    {
        distort(all->subjects[i].mapping, all->set.tolerance, 1, &all->subjects[i].distortion);
        stage_progress(part, i + 1, all->subject_count, "distortion");
    }
}
