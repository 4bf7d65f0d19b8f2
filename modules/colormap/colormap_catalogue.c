/* SPDX-License-Identifier: MIT
 *
 * The table of models. The standard values are inside sRGB, which a test checks.
 */
#include "colormap_catalogue.h"

#include <math.h>
#include <string.h>

#define HUE(what, standard_value)                                                                  \
    {                                                                                              \
        "hue", what " (H_base)", "degrees", standard_value, 0.0, 360.0, 0, NULL                    \
    }
#define LIGHTNESS_RANGE(standard_value)                                                            \
    {                                                                                              \
        "lightness-range", "lightness goes from 100 (1 - R_L) to 100 R_L (R_L)", "",               \
            standard_value, 0.5, 1.0, 1, NULL                                                      \
    }
#define SATURATION_RANGE(standard_value)                                                           \
    {                                                                                              \
        "saturation-range", "pale ends have saturation 1 - R_S, the most vivid place S R_S (R_S)", \
            "", standard_value, 0.5, 1.0, 1, NULL                                                  \
    }
#define SATURATION(standard_value)                                                                 \
    {                                                                                              \
        "saturation", "how colourful: chroma divided by lightness (S)", "", standard_value, 0.0,   \
            5.0, 0, NULL                                                                           \
    }
#define LIGHTNESS(standard_value)                                                                  \
    {                                                                                              \
        "lightness", "the lightness of all colours (L_base)", "", standard_value, 0.0, 100.0, 0,   \
            NULL                                                                                   \
    }
#define DIVERGENCE(what, standard_value)                                                           \
    {                                                                                              \
        "divergence", what " (D_H)", "degrees", standard_value, 0.0, 360.0, 0, NULL                \
    }
#define SECOND_HUE(standard_value)                                                                 \
    DIVERGENCE("from that hue to that of the second half", standard_value)
#define HUES(standard_value) DIVERGENCE("the range of hues", standard_value)
#define SECTION(number) "Lambers 2020, section " number

#define UNIFORM(word, what, text)                                                                  \
    {                                                                                              \
        .identifier = word, .aliases = "", .name = text,                                           \
        .source = "this project, CAM16-UCS of Li et al. 2017", .family = what,                     \
        .parameter_count = 0, .space = CM_COLORMAP_CAM16_UCS                                       \
    }

static const cm_colormap_info catalogue[] = {
    [CM_COLORMAP_SINGLE] = {.identifier = "sequential-single",
                            .aliases = "sequential single",
                            .name = "from dark to light in one hue",
                            .source = SECTION("3.1.1, single hue"),
                            .family = CM_COLORMAP_SEQUENTIAL,
                            .parameter_count = 4,
                            .parameter = {HUE("the hue", 255.0), LIGHTNESS_RANGE(0.95),
                                          SATURATION_RANGE(0.95), SATURATION(1.6)}},
    [CM_COLORMAP_RAINBOW] = {.identifier = "sequential-rainbow",
                             .aliases = "rainbow",
                             .name = "from dark to light through the circle of hues",
                             .source = SECTION("3.1.1, rainbow hues"),
                             .family = CM_COLORMAP_SEQUENTIAL,
                             .parameter_count = 5,
                             .parameter = {HUE("the hue at the dark end", 240.0),
                                           LIGHTNESS_RANGE(0.95),
                                           SATURATION_RANGE(0.95),
                                           SATURATION(1.8),
                                           {"rotations", "turns through the circle of hues (r)", "",
                                            0.7, -10.0, 10.0, 0, NULL}}},
    [CM_COLORMAP_CUSTOM] = {.identifier = "sequential-custom",
                            .aliases = "custom",
                            .name = "from dark to light through hues of one's own",
                            .source = SECTION("3.1.1, custom hues"),
                            .family = CM_COLORMAP_SEQUENTIAL,
                            .parameter_count = 4,
                            .parameter = {{"hues", "HUE@PLACE/HUE@PLACE/... or HUE/HUE/... (H_t)",
                                           "degrees", (double)NAN, 0.0, 360.0, 0,
                                           "290@0/12@0.5/75@1"},
                                          LIGHTNESS_RANGE(0.95),
                                          SATURATION_RANGE(0.95),
                                          SATURATION(2.0)}},
    [CM_COLORMAP_SATURATION] = {.identifier = "sequential-saturation",
                                .aliases = "saturation",
                                .name = "from grey to colourful, all of one lightness",
                                .source = SECTION("3.1.2"),
                                .family = CM_COLORMAP_SEQUENTIAL,
                                .parameter_count = 4,
                                .parameter = {HUE("the hue", 12.0), LIGHTNESS(55.0),
                                              SATURATION_RANGE(0.95), SATURATION(2.6)}},
    [CM_COLORMAP_DIVERGING_LIGHTNESS] = {.identifier = "diverging-lightness",
                                         .aliases = "diverging",
                                         .name = "two hues, dark at the ends, light in the middle",
                                         .source = SECTION("3.2, varying lightness"),
                                         .family = CM_COLORMAP_DIVERGING,
                                         .parameter_count = 5,
                                         .parameter = {HUE("the hue of the first half", 255.0),
                                                       SECOND_HUE(117.0), LIGHTNESS_RANGE(0.9),
                                                       SATURATION_RANGE(0.7), SATURATION(2.4)}},
    [CM_COLORMAP_DIVERGING_SATURATION] = {.identifier = "diverging-saturation",
                                          .aliases = "",
                                          .name = "two hues, grey in the middle, one lightness",
                                          .source = SECTION("3.2, varying saturation"),
                                          .family = CM_COLORMAP_DIVERGING,
                                          .parameter_count = 4,
                                          .parameter = {HUE("the hue of the first half", 255.0),
                                                        SECOND_HUE(117.0), LIGHTNESS(55.0),
                                                        SATURATION(1.9)}},
    [CM_COLORMAP_HUES] = {.identifier = "qualitative",
                          .aliases = "",
                          .name = "hues of one lightness and one saturation",
                          .source = SECTION("3.3"),
                          .family = CM_COLORMAP_QUALITATIVE,
                          .parameter_count = 4,
                          .parameter = {HUE("the first hue", 0.0), HUES(360.0), LIGHTNESS(70.0),
                                        SATURATION(0.75)}},
    [CM_COLORMAP_UNIFORM_PURPLE_YELLOW] = UNIFORM("uniform-purple-yellow", CM_COLORMAP_SEQUENTIAL,
                                                  "dark purple through blue and green to yellow"),
    [CM_COLORMAP_UNIFORM_RED_YELLOW] = UNIFORM("uniform-red-yellow", CM_COLORMAP_SEQUENTIAL,
                                               "nearly black through red and orange to yellow"),
    [CM_COLORMAP_UNIFORM_BLUE] =
        UNIFORM("uniform-blue", CM_COLORMAP_SEQUENTIAL, "dark blue to nearly white"),
    [CM_COLORMAP_UNIFORM_GREEN] =
        UNIFORM("uniform-green", CM_COLORMAP_SEQUENTIAL, "dark green to pale yellow"),
    [CM_COLORMAP_UNIFORM_BLUE_RED] = UNIFORM("uniform-blue-red", CM_COLORMAP_DIVERGING,
                                             "dark blue through light grey to dark red"),
    [CM_COLORMAP_UNIFORM_PURPLE_GREEN] = UNIFORM("uniform-purple-green", CM_COLORMAP_DIVERGING,
                                                 "dark purple through light grey to dark green"),
    [CM_COLORMAP_UNIFORM_CYCLIC] =
        UNIFORM("uniform-cyclic", CM_COLORMAP_CYCLIC,
                "pale green through blue to dark purple, and through red back"),
};

size_t cm_colormap_count(void)
{
    return sizeof catalogue / sizeof catalogue[0];
}

const cm_colormap_info *cm_colormap_at(size_t index)
{
    return index < cm_colormap_count() ? &catalogue[index] : NULL;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

int cm_colormap_same_word(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t i = 0;
    while (i < a_length && i < b_length && lower(a[i]) == lower(b[i]))
    {
        i++;
    }
    return a_length == b_length && i == a_length;
}

const cm_colormap_info *cm_colormap_find_word(const char *name, size_t length)
{
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const char *identifier = catalogue[i].identifier;
        if (cm_colormap_same_word(identifier, strlen(identifier), name, length))
        {
            return &catalogue[i];
        }
        const char *alias = catalogue[i].aliases;
        while (*alias != '\0')
        {
            const size_t word = strcspn(alias, " ");
            if (cm_colormap_same_word(alias, word, name, length))
            {
                return &catalogue[i];
            }
            alias += word + strspn(alias + word, " ");
        }
    }
    return NULL;
}

const cm_colormap_info *cm_colormap_find(const char *name)
{
    return name == NULL ? NULL : cm_colormap_find_word(name, strlen(name));
}

/* The index of the model's parameter of that name, or its number of parameters. */
static size_t parameter_index(const cm_colormap_parameters *parameters, const char *name)
{
    const cm_colormap_info *info = &catalogue[parameters->index];
    size_t i = 0;
    while (i < info->parameter_count && strcmp(info->parameter[i].name, name) != 0)
    {
        i++;
    }
    return i;
}

double cm_colormap_value(const cm_colormap_parameters *parameters, const char *name, double absent)
{
    const size_t i = parameter_index(parameters, name);
    return i < catalogue[parameters->index].parameter_count ? parameters->value[i] : absent;
}

void cm_colormap_set_value(cm_colormap_parameters *parameters, const char *name, double value)
{
    const size_t i = parameter_index(parameters, name);
    if (i < catalogue[parameters->index].parameter_count)
    {
        parameters->value[i] = value;
    }
}
