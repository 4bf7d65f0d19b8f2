/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "written_files.h"

#include <dirent.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/cubemap-scene-XXXXXX";

static void remove_folder(void)
{
    remove_all(folder);
}

const char *test_folder(void)
{
    static int made;
    if (!made)
    {
        made = 1;
        if (mkdtemp(folder) == NULL)
        {
            abort();
        }
        atexit(remove_folder);
    }
    return folder;
}

const char *in_folder(const char *name)
{
    static char names[64][300];
    static unsigned turn;
    char *to = names[turn++ % 64];
    snprintf(to, sizeof names[0], "%s/%s", test_folder(), name);
    return to;
}

const char *write_file(const char *name, const void *bytes, size_t count)
{
    const char *path = in_folder(name);
    char part[300];
    for (size_t i = strlen(folder) + 1; path[i] != '\0'; i++)
    {
        if (path[i] == '/')
        {
            memcpy(part, path, i);
            part[i] = '\0';
            mkdir(part, 0777);
        }
    }
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, count, file) != count || fclose(file) != 0)
    {
        abort();
    }
    return path;
}

const char *write_text(const char *name, const char *text)
{
    return write_file(name, text, strlen(text));
}

char *read_file(const char *path, size_t *count)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
    {
        return NULL;
    }
    fseek(file, 0, SEEK_END);
    *count = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*count + 1);
    if (bytes == NULL || fread(bytes, 1, *count, file) != *count)
    {
        abort();
    }
    bytes[*count] = '\0';
    fclose(file);
    return bytes;
}

int count_entries(const char *path)
{
    DIR *open = opendir(path);
    int count = -3;
    while (open != NULL && readdir(open) != NULL)
    {
        count++;
    }
    if (open != NULL)
    {
        closedir(open);
    }
    return count + (open != NULL);
}

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    return remove(path);
}

void remove_all(const char *path)
{
    nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}
