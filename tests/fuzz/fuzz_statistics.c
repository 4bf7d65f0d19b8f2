/* SPDX-License-Identifier: MIT
 *
 * Statistics of distortion: any options; what is refused leaves the outputs alone, and what is not is in
 * order.
 */
#include <cubemap/cubemap.h>

#include <math.h>

#include "fuzz.h"

enum
{
    PERCENTILES_MAX = 5
};

static double take_number(supply *from)
{
    static const double numbers[] = {
        0.0,         1e-13, 1e-2,  1e-4, 0.5,  100.0, 99.9, 100.1, (double)INFINITY,
        (double)NAN, -1.0,  1e-14, 50.0, 0.011};
    return numbers[take_byte(from) % (sizeof numbers / sizeof numbers[0])];
}

static cm_statistics_options take_options(supply *from)
{
    cm_statistics_options o = {.size = sizeof o};
    o.size -= take_byte(from) == 255;
    o.measure = (cm_measure)(take_byte(from) % 4 % 3);
    o.faces = take_byte(from) % 80;
    o.pixels = take_byte(from) % 8 == 0 ? take_byte(from) : 0;
    o.tolerance = take_byte(from) % 2 == 0 ? take_number(from) : 1e-2;
    return o;
}

static void check_statistics(const cm_mapping *mapping, int quantity,
                             const cm_statistics_options *options)
{
    cm_statistics s = {.size = sizeof s, .mean = 77.0};
    cm_status status = cm_distortion_statistics(mapping, (cm_quantity)quantity, options, &s);
    if (status != CM_OK)
    {
        int other = cm_mapping_describe(mapping)->kind != CM_KIND_CUBE;
        EXPECT((status == CM_ERROR_ARGUMENT || (other && status == CM_ERROR_UNSUPPORTED)) &&
                   s.mean == 77.0,
               "status %d", (int)status);
        return;
    }
    double slack = 1e-9 * fabs(s.maximum) + s.mean_error;
    EXPECT(s.minimum <= s.mean + slack && s.mean <= s.maximum + slack && s.maximum_face < 6 &&
               s.minimum_face < 6 && s.rmse >= 0.0 && s.rmse <= s.maximum_error + slack &&
               s.mean_error >= 0.0 && fabs(s.maximum_uv[0]) <= 1.0 && fabs(s.minimum_uv[1]) <= 1.0,
           "%s: %g, %g to %g, RMSE %g", cm_mapping_describe(mapping)->identifier, s.mean, s.minimum,
           s.maximum, s.rmse);
}

static void check_percentiles(const cm_mapping *mapping, int quantity,
                              const cm_statistics_options *options, supply *from)
{
    double percent[PERCENTILES_MAX];
    double value[PERCENTILES_MAX];
    double doubt[PERCENTILES_MAX];
    size_t count = take_byte(from) % (PERCENTILES_MAX + 1);
    for (size_t i = 0; i < PERCENTILES_MAX; i++)
    {
        percent[i] = take_number(from);
        value[i] = doubt[i] = 77.0;
    }
    int with_doubt = take_byte(from) % 2;
    cm_status status = cm_distortion_percentiles(mapping, (cm_quantity)quantity, options, count,
                                                 percent, value, with_doubt ? doubt : NULL);
    for (size_t i = 0; i < PERCENTILES_MAX; i++)
    {
        int written = status == CM_OK && i < count;
        EXPECT(written == (value[i] != 77.0) && (written && with_doubt) == (doubt[i] != 77.0),
               "%zu of %zu", i, count);
        for (size_t j = 0; j < i && written; j++)
        {
            EXPECT(percent[i] < percent[j] ? value[i] <= value[j] : value[i] >= value[j],
                   "%g %% below %g, %g %% below %g", percent[i], value[i], percent[j], value[j]);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_mapping *mapping = NULL;
    const cm_mapping_info *info = cm_catalogue_at(take_byte(&from) % cm_catalogue_count());
    EXPECT(cm_mapping_create(info->identifier, NULL, &mapping) == CM_OK, "%s", info->identifier);
    int quantity = take_byte(&from) % 8 - 1;
    cm_statistics_options options = take_options(&from);
    EXPECT((cm_quantity_name((size_t)quantity) != NULL) == (quantity >= 0 && quantity < 6), "%d",
           quantity);
    check_statistics(mapping, quantity, &options);
    if (take_byte(&from) % 4 == 0)
    {
        check_percentiles(mapping, quantity, &options, &from);
    }
    char *name = take_text(&from);
    int found = cm_quantity_find(name);
    EXPECT(found >= -1 && found < 6, "%d", found);
    free(name);
    cm_mapping_destroy(mapping);
    return 0;
}
