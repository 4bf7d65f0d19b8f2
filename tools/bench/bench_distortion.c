/* SPDX-License-Identifier: MIT
 *
 * Distortion of every mapping, by the library's statistics.
 */
#include "bench.h"

#include <math.h>
#include <stdlib.h>

static void distort_faces(const cm_mapping *mapping, unsigned faces, double tolerance,
                          int with_percentiles, distortion *d)
{
    for (int k = 0; k < QUANTITIES * MEASURES; k++)
    {
        cm_quantity quantity = (cm_quantity)(k / MEASURES);
        int measure = k % MEASURES;
        const cm_statistics_options options = {.size = sizeof options,
                                               .measure = (cm_measure)measure,
                                               .faces = faces,
                                               .tolerance = tolerance};
        cm_statistics *s = &d->of[quantity][measure];
        for (int i = 0; i < PERCENTILES; i++)
        {
            d->percentile[quantity][measure][i] = (double)NAN;
        }
        s->size = sizeof *s;
        cm_status status = cm_distortion_statistics(mapping, quantity, &options, s);
        if (status == CM_OK && with_percentiles)
        {
            double doubt[PERCENTILES];
            status =
                cm_distortion_percentiles(mapping, quantity, &options, PERCENTILES, percentiles,
                                          d->percentile[quantity][measure], doubt);
            for (int i = 0; i < PERCENTILES; i++)
            {
                d->doubt[quantity][measure] = fmax(d->doubt[quantity][measure], doubt[i]);
            }
        }
        if (status != CM_OK)
        {
            fprintf(harness_err(), "%s: distortion: %s\n", program_name(), cm_status_text(status));
            harness_end();
        }
    }
}

void distort(const cm_mapping *mapping, double tolerance, int with_percentiles, distortion *d)
{
    distort_faces(mapping, 0, tolerance, with_percentiles, d);
}

/* Those that are enough: a frame turns faces that are alike into each other. */
static unsigned faces_of(const cm_mapping *mapping, int one_face)
{
    return one_face && cm_mapping_describe(mapping)->family != CM_FAMILY_HYBRID ? 1u : 0u;
}

void measure_distortion(suite *all, stage part)
{
    for (size_t i = 0; i < all->subject_count; i++)
    {
        subject *const s = &all->subjects[i];
        distort_faces(s->mapping, faces_of(s->mapping, all->set.one_face), all->set.tolerance,
                      all->set.percentiles, &s->distortion);
        stage_progress(part, i + 1, all->subject_count, "distortion");
    }
}
