/* SPDX-License-Identifier: MIT */
#include "header_lines.h"

#include <stdio.h>
#include <string.h>

static const char prefix[] = "cubemap:";

static bool is_one_line(const char *text)
{
    return text[strcspn(text, "\r\n")] == '\0';
}

void cm_header_lines_write(const cm_image_description *description, char *lines)
{
    size_t used = 0;
    for (size_t i = 0; i < description->tag_count; i++)
    {
        const cm_image_tag *const tag = &description->tags[i];
        const size_t length = strlen("# =\n") + strlen(tag->key) + strlen(tag->text);
        if (strncmp(tag->key, prefix, sizeof prefix - 1) == 0 && is_one_line(tag->key) &&
            is_one_line(tag->text) && used + length < CM_HEADER_LINES_SIZE)
        {
            snprintf(lines + used, CM_HEADER_LINES_SIZE - used, "# %s=%s\n", tag->key, tag->text);
            used += length;
        }
    }
    lines[used] = '\0';
}

/* Is this line, from at to before end, one of ours? */
static bool read_line(const char *at, const char *end, cm_header_line *line)
{
    while (at < end && (*at == '#' || *at == ' '))
    {
        at++;
    }
    const size_t size = (size_t)(end - at);
    const char *const equals = memchr(at, '=', size);
    if (equals == NULL || size < sizeof prefix - 1 || memcmp(at, prefix, sizeof prefix - 1) != 0)
    {
        return false;
    }
    *line = (cm_header_line){at, (size_t)(equals - at), equals + 1, (size_t)(end - equals - 1)};
    return true;
}

bool cm_header_lines_next(const char **text, const char *end, cm_header_line *line)
{
    while (*text < end)
    {
        const char *const begin = *text;
        const char *const found = memchr(begin, '\n', (size_t)(end - begin));
        const char *const stop = found != NULL ? found : end;
        *text = found != NULL ? found + 1 : end;
        if (*begin == '#' && read_line(begin, stop, line))
        {
            return true;
        }
    }
    return false;
}
