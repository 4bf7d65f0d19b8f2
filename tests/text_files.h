/* SPDX-License-Identifier: MIT
 *
 * The texts of a folder, by what POSIX and Windows both have.
 */
#ifndef TESTS_TEXT_FILES_H
#define TESTS_TEXT_FILES_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct text_files
{
    size_t count;
    char (*path)[1024];
} text_files;

static inline int text_files_compare(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* Adds FOLDER/X.txt for all X, in the order of their names; path is to be freed. No folder is none. */
static inline void text_files_add(text_files *files, const char *folder)
{
    DIR *open = opendir(folder);
    const size_t before = files->count;
    for (struct dirent *entry; open != NULL && (entry = readdir(open)) != NULL;)
    {
        const char *dot = strrchr(entry->d_name, '.');
        if (dot != NULL && strcmp(dot, ".txt") == 0)
        {
            files->path = realloc(files->path, (files->count + 1) * sizeof *files->path);
            if (files->path == NULL ||
                snprintf(files->path[files->count], sizeof *files->path, "%s/%s", folder,
                         entry->d_name) >= (int)sizeof *files->path)
            {
                abort();
            }
            files->count++;
        }
    }
    if (open != NULL)
    {
        closedir(open);
    }
    if (files->count > before)
    {
        qsort(files->path + before, files->count - before, sizeof *files->path, text_files_compare);
    }
}

#endif
