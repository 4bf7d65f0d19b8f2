/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "library_loader.h"

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

static const cm_image_io *open_library(const char *what, const char *path, char *message)
{
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
    const cm_image_io *(*entry)(uint32_t) = NULL;
    void *const symbol = dlsym(library, CM_IMAGE_IO_ENTRY);
    memcpy(&entry, &symbol,
           sizeof entry); /* POSIX has objects and functions in pointers of one size */
    const cm_image_io *table = symbol == NULL ? NULL : entry(CM_IMAGE_IO_VERSION);
    if (table == NULL || table->version != CM_IMAGE_IO_VERSION || table->size < sizeof *table)
    {
        snprintf(message, CM_IMAGE_MESSAGE, "the %s, '%s', is %s", what, path,
                 symbol == NULL ? "none: it has no " CM_IMAGE_IO_ENTRY : "of another version");
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

const cm_image_io *cm_library_open(const cm_library_place *place, char *message)
{
    const char *const named = getenv(place->variable);
    if (named != NULL && *named != '\0')
    {
        return open_library(place->what, named, message);
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
            return open_library(place->what, path, message);
        }
    }
    if (access(place->installed, F_OK) == 0)
    {
        return open_library(place->what, place->installed, message);
    }
    snprintf(message, CM_IMAGE_MESSAGE,
             "there is no %s, neither '%s' nor from the program's folder '%s'; %s may name it",
             place->what, place->installed, place->from_bin, place->variable);
    clean(message);
    return NULL;
}
