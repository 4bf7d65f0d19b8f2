/* SPDX-License-Identifier: MIT
 *
 * The parser of specifications: the input is one. Two functions read it and must agree; messages
 * fit; the parameters are the numbers that strtod reads, and come back when they are written.
 */
#include <cubemap/cubemap.h>

#include <math.h>
#include <strings.h>

#include "fuzz.h"

enum
{
    MESSAGE_MAX = 400
};

/* A buffer of every size gets the beginning of the same line; none is written if all is well. */
static void check_message(const char *specification, cm_status status)
{
    static const size_t sizes[] = {0, 1, 2, 3, 20, 80, MESSAGE_MAX - 1};
    char whole[MESSAGE_MAX] = "untouched";
    EXPECT(cm_specification_check(specification, whole, sizeof whole) == status, "status");
    EXPECT(status == CM_OK ? strcmp(whole, "untouched") == 0 : is_one_line(whole), "'%s'", whole);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
    {
        size_t size = sizes[i];
        char *message = malloc(size + (size == 0));
        EXPECT(message != NULL, "no memory");
        memset(message, 1, size + (size == 0));
        EXPECT(cm_specification_check(specification, message, size) == status, "status");
        if (status == CM_OK || size == 0)
        {
            EXPECT(message[0] == 1, "a message was written");
        }
        else
        {
            EXPECT(memchr(message, '\0', size) != NULL, "no end");
            EXPECT(strncmp(message, whole, size - 1) == 0, "'%s' of '%s'", message, whole);
        }
        free(message);
    }
}

/* A number of the specification is the parameter, to the ulp that the library may lose. */
static void check_parameter(const cm_mapping *mapping, size_t index, const char *number)
{
    double value = cm_mapping_parameter(mapping, index);
    double truth = strtod(number, NULL);
    EXPECT(value >= nextafter(truth, -INFINITY) && value <= nextafter(truth, INFINITY),
           "%s is %.17g", number, value);
}

static size_t parameter_called(const cm_mapping_info *info, const char *name, size_t length)
{
    size_t index = 0;
    while (index < info->parameter_count &&
           (strlen(info->parameter[index].name) != length ||
            strncasecmp(info->parameter[index].name, name, length) != 0))
    {
        index++;
    }
    EXPECT(index < info->parameter_count, "no parameter '%.*s'", (int)length, name);
    return index;
}

/* Every PARAMETER=VALUE of the text, beside which only names stand in it; and that no value is outside its range. */
static void check_parameters(const cm_mapping *mapping, const char *text)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    for (const char *at = text; *at != '\0'; at += strcspn(at, ":,"), at += *at != '\0')
    {
        size_t length = strcspn(at, "=:,");
        if (at[length] == '=')
        {
            check_parameter(mapping, parameter_called(info, at, length), at + length + 1);
        }
    }
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_parameter_info *parameter = &info->parameter[i];
        double value = cm_mapping_parameter(mapping, i);
        EXPECT(value >= parameter->low && value <= parameter->high &&
                   !(parameter->low_excluded && value == parameter->low) &&
                   !(parameter->whole && value != floor(value)),
               "%s=%.17g", parameter->name, value);
    }
    EXPECT(isnan(cm_mapping_parameter(mapping, info->parameter_count)), "one parameter too many");
}

/* Of fov and full only one may be given. */
static int is_left_out(const cm_mapping *mapping, const char *name)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    int full = 0;
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        full |=
            strcmp(info->parameter[i].name, "full") == 0 && cm_mapping_parameter(mapping, i) != 0.0;
    }
    return strcmp(name, full ? "fov" : "full") == 0;
}

/* The mapping, written and read again; the parts of a layout cannot be asked for. */
static void check_written(const cm_mapping *mapping)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    char text[256];
    cm_mapping *again = NULL;
    int length = snprintf(text, sizeof text, "%s", info->identifier);
    int given = 0;
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const char *name = info->parameter[i].name;
        if (!is_left_out(mapping, name))
        {
            length += snprintf(text + length, sizeof text - (size_t)length, "%c%s=%.17g",
                               given++ ? ',' : ':', name, cm_mapping_parameter(mapping, i));
        }
    }
    EXPECT(cm_mapping_create(text, cm_mapping_frame(mapping), &again) == CM_OK, "%s", text);
    EXPECT(cm_mapping_describe(again) == info, "%s", text);
    check_parameters(again, text);
    cm_mapping_destroy(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    char *text = take_text(&from);
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create(text, NULL, &mapping);
    EXPECT((status == CM_OK) == (mapping != NULL), "status %d", status);
    EXPECT(cm_specification_check(text, NULL, 0) == status, "status %d", status);
    check_message(text, status);
    if (status == CM_OK)
    {
        check_parameters(mapping, text);
        if (cm_mapping_describe(mapping)->parts == NULL)
        {
            check_written(mapping);
        }
        EXPECT(cm_frame_check(cm_mapping_frame(mapping)) == CM_OK, "its frame is none");
    }
    cm_mapping_destroy(mapping);
    free(text);
    EXPECT(cm_mapping_create(NULL, NULL, &mapping) == CM_ERROR_ARGUMENT, "no specification");
    EXPECT(cm_mapping_create("gnomonic", NULL, NULL) == CM_ERROR_ARGUMENT, "no result");
    return 0;
}
