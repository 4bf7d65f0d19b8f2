/* SPDX-License-Identifier: MIT
 *
 * The search for an orientation on small masks with any values: what is no mask is refused and nothing is
 * written; else the result is a rotation, no worse than none, and has the value that it says; and a callback may
 * end it at any time.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

enum
{
    PIXELS_MAX = 12
};

typedef struct patience
{
    int left;
    double last;
} patience;

static int lose_patience(double done, void *user)
{
    patience *p = user;
    EXPECT(done >= p->last && done <= 1.0, "%g after %g", done, p->last);
    p->last = done;
    return p->left-- == 0;
}

static float take_value(supply *from)
{
    static const float values[] = {0.0f,  1.0f,     0.5f, 3e38f,  1e-45f, -0.0f,
                                   -1.0f, INFINITY, NAN,  1e-30f, 7.0f,   0.0f};
    return values[take_byte(from) % 12];
}

static int is_mask(const float *value, size_t count)
{
    float largest = 0.0f;
    for (size_t i = 0; i < count; i++)
    {
        if (!(value[i] >= 0.0f) || isinf(value[i]))
        {
            return 0;
        }
        largest = fmaxf(largest, value[i]);
    }
    return largest > 0.0f;
}

static void check_result(const cm_mapping *mapping, const cm_mask *mask,
                         const cm_orient_options *options, const cm_orient_result *found)
{
    double value = 0.0;
    EXPECT(cm_rotation_check(&found->rotation) == CM_OK, "no rotation");
    EXPECT(found->after <= found->before && found->gap >= 0.0 && found->radius <= 180.0, "%g %g %g",
           found->before, found->after, found->gap);
    EXPECT(found->rival_count <= CM_ORIENT_RIVALS_MAX && found->symmetries >= 1 &&
               found->symmetries <= 24,
           "%u", found->symmetries);
    EXPECT(cm_orient_value(mapping, mask, options, &found->rotation, &value) == CM_OK, "no value");
    EXPECT(fabs(value - found->after) <= 1e-9 * (1.0 + fabs(value)), "%g, not %g", value,
           found->after);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    float value[PIXELS_MAX];
    patience p = {take_byte(&from) % 64 - 1, 0.0};
    const cm_mapping_info *info = cm_catalogue_at(take_byte(&from) % cm_catalogue_count());
    cm_orient_options options = {.size = sizeof options,
                                 .measure = (cm_orient_measure)(take_byte(&from) % 6),
                                 .over = (cm_measure)(take_byte(&from) % 3),
                                 .resolution = take_byte(&from) % 8 - 1,
                                 .threads = 1,
                                 .boxes_max = 1,
                                 .progress = lose_patience,
                                 .user = &p};
    cm_mask mask = {sizeof mask, take_byte(&from) % 5, take_byte(&from) % 4, value};
    for (size_t i = 0; i < PIXELS_MAX; i++)
    {
        value[i] = take_value(&from);
    }
    /* to the end of a search of edges it is many seconds with sanitizers */
    p.left = options.measure == CM_ORIENT_EDGES && p.left < 0 ? 4 : p.left;
    cm_mapping *mapping = NULL;
    EXPECT(cm_mapping_create(info->identifier, NULL, &mapping) == CM_OK, "%s", info->identifier);
    int good = options.measure <= CM_ORIENT_EDGES && options.over <= CM_OVER_SPHERE &&
               options.resolution >= 0.0 && mask.width * mask.height > 0 &&
               is_mask(value, mask.width * mask.height);
    cm_orient_result found = {.size = sizeof found, .after = 7.0};
    cm_status status = cm_orient(mapping, &mask, &options, &found);
    if (status == CM_OK)
    {
        EXPECT(good && info->kind == CM_KIND_CUBE, "taken");
        check_result(mapping, &mask, &options, &found);
    }
    else
    {
        EXPECT(found.after == 7.0 && (status == CM_ERROR_STOPPED    ? good
                                      : status == CM_ERROR_ARGUMENT ? !good
                                                                    : info->kind != CM_KIND_CUBE),
               "status %d", (int)status);
    }
    cm_mapping_destroy(mapping);
    char *name = take_text(&from);
    int measure = cm_orient_measure_find(name);
    EXPECT(measure == -1 || cm_orient_measure_name((size_t)measure) != NULL, "%d", measure);
    free(name);
    return 0;
}
