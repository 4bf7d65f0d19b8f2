/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "library_loader.h"

#include "image_io.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

/* For one line: control characters of names do not end it. */
static void clean(char *message)
{
    for (char *letter = message; *letter != '\0'; letter++)
    {
        const unsigned char byte = (unsigned char)*letter;
        *letter = byte < 0x20 || byte == 0x7f ? '?' : *letter;
    }
}

static const void *open_library(const cm_library_place *place, const char *path, char *message)
{
    const char *const what = place->what;
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL)
    {
        const char *reason = dlerror();
        /* which begins with the name that is said anyway */
        const size_t length = strlen(path);
        if (reason != NULL && strncmp(reason, path, length) == 0 &&
            strncmp(reason + length, ": ", 2) == 0)
        {
            reason += length + 2;
        }
        snprintf(message, CM_IMAGE_MESSAGE, "the %s, '%s', cannot be opened: %s", what, path,
                 reason == NULL ? "no reason is given" : reason);
        clean(message);
        return NULL;
    }
    const void *(*entry)(uint32_t) = NULL;
    void *const symbol = dlsym(library, place->entry);
    memcpy(&entry, &symbol,
           sizeof entry); /* POSIX has objects and functions in pointers of one size */
    const void *const table = symbol == NULL ? NULL : entry(place->least.version);
    cm_library_head head = {0, 0};
    if (table != NULL)
    {
        memcpy(&head, table, sizeof head);
    }
    if (head.version != place->least.version || head.size < place->least.size)
    {
        snprintf(message, CM_IMAGE_MESSAGE, "the %s, '%s', is %s%s", what, path,
                 symbol == NULL ? "none: it has no " : "of another version",
                 symbol == NULL ? place->entry : "");
        clean(message);
        dlclose(library);
        return NULL;
    }
    return table;
}

/* The folder of the running program, with a slash at its end; "" where the system does not tell. */
static void find_folder(char folder[PATH_MAX])
{
    const ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    folder[length > 0 ? length : 0] = '\0';
    char *const slash = strrchr(folder, '/');
    folder[slash == NULL ? 0 : slash - folder + 1] = '\0';
}

const void *cm_library_open(const cm_library_place *place, char *message)
{
    const char *const named = getenv(place->variable);
    if (named != NULL && *named != '\0')
    {
        return open_library(place, named, message);
    }
    char folder[PATH_MAX];
    find_folder(folder);
    const char *const places[] = {place->from_bin, place->from_tools};
    for (size_t i = 0; folder[0] != '\0' && i < sizeof places / sizeof *places; i++)
    {
        char path[PATH_MAX];
        const int length = snprintf(path, sizeof path, "%s%s", folder, places[i]);
        if (length > 0 && (size_t)length < sizeof path && access(path, F_OK) == 0)
        {
            return open_library(place, path, message);
        }
    }
    if (access(place->installed, F_OK) == 0)
    {
        return open_library(place, place->installed, message);
    }
    snprintf(message, CM_IMAGE_MESSAGE,
             "there is no %s, neither '%s' nor from the program's folder '%s'; %s may name it",
             place->what, place->installed, place->from_bin, place->variable);
    clean(message);
    return NULL;
}
