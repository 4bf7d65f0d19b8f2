/* SPDX-License-Identifier: MIT
 *
 * The text of a program, for the devices.
 */
#include "judge.h"

#include <stdio.h>
#include <stdlib.h>

char *read_text(const char *folder, int number, const char *suffix, size_t *size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%d%s", folder, number, suffix);
    FILE *file = fopen(path, "rb");
    if (file == NULL)
    {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(1);
    }
    fseek(file, 0, SEEK_END);
    size_t length = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(length + 1);
    if (text == NULL || fread(text, 1, length, file) != length)
    {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(1);
    }
    text[length] = 0;
    fclose(file);
    if (size != NULL)
    {
        *size = length;
    }
    return text;
}
