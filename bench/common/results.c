/* SPDX-License-Identifier: MIT
 *
 * Files of results, and the words of JSON.
 */
#include "bench.h"

#include <errno.h>
#include <math.h>
#include <string.h>

int output_open(output *o, const char *name)
{
    o->name = name;
    o->file = NULL;
    if (name == NULL || strcmp(name, "-") == 0)
    {
        o->file = name == NULL ? NULL : stdout;
        return 1;
    }
    if (snprintf(o->part, sizeof o->part, "%s.part", name) >= (int)sizeof o->part ||
        (o->file = fopen(o->part, "w")) == NULL)
    {
        fprintf(stderr, "%s: cannot write %s: %s\n", program_name, name, strerror(errno));
        return 0;
    }
    return 1;
}

int output_close(output *o)
{
    if (o->file == NULL || o->file == stdout)
    {
        return 1;
    }
    int bad = ferror(o->file);
    bad |= fclose(o->file);
    o->file = NULL;
    if (bad || rename(o->part, o->name) != 0)
    {
        fprintf(stderr, "%s: cannot write %s: %s\n", program_name, o->name, strerror(errno));
        remove(o->part);
        return 0;
    }
    return 1;
}

void output_drop(output *o)
{
    if (o->file != NULL && o->file != stdout)
    {
        fclose(o->file);
        remove(o->part);
        o->file = NULL;
    }
}

void json_text(FILE *out, const char *key, const char *text)
{
    fprintf(out, "\"%s\": \"", key);
    for (; *text != '\0'; text++)
    {
        if ((unsigned char)*text < 0x20)
        {
            fprintf(out, "\\u%04x", (unsigned)*text);
            continue;
        }
        if (*text == '"' || *text == '\\')
        {
            fputc('\\', out);
        }
        fputc(*text, out);
    }
    fprintf(out, "\", ");
}

void json_number(FILE *out, const char *key, double value)
{
    if (isfinite(value))
    {
        fprintf(out, "\"%s\": %.6g, ", key, value);
    }
    else
    {
        fprintf(out, "\"%s\": null, ", key);
    }
}
