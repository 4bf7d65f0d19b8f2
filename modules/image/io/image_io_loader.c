/* SPDX-License-Identifier: MIT
 *
 * Finds and opens the library of image files. IMAGE_IO_INSTALLED is where it is installed, IMAGE_IO_FROM_BIN the same
 * from the folder of programs, IMAGE_IO_FROM_TOOLS where it is built from the folder where programs are.
 */
#define _POSIX_C_SOURCE 200809L

#include "image_io_entry.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

/* A library that was opened is one of the process: it stays, as does why it could not be. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static const cm_image_io *opened;

/* For one line: control characters of names do not end it. */
static void say(char *message, const char *format, const char *first, const char *second)
{
    snprintf(message, CM_IMAGE_MESSAGE, format, first, second);
    for (char *letter = message; *letter != '\0'; letter++)
    {
        const unsigned char byte = (unsigned char)*letter;
        *letter = byte < 0x20 || byte == 0x7f ? '?' : *letter;
    }
}

static const cm_image_io *open_library(const char *path, char *message)
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
        say(message, "the library for image files, '%s', cannot be opened: %s", path,
            reason == NULL ? "no reason is given" : reason);
        return NULL;
    }
    const cm_image_io *(*entry)(uint32_t) = NULL;
    void *const symbol = dlsym(library, CM_IMAGE_IO_ENTRY);
    memcpy(&entry, &symbol,
           sizeof entry); /* POSIX has objects and functions in pointers of one size */
    const cm_image_io *table = symbol == NULL ? NULL : entry(CM_IMAGE_IO_VERSION);
    if (table == NULL || table->version != CM_IMAGE_IO_VERSION || table->size < sizeof *table)
    {
        say(message, "the library for image files, '%s', is %s", path,
            symbol == NULL ? "none: it has no " CM_IMAGE_IO_ENTRY : "of another version");
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

static const cm_image_io *find_library(char *message)
{
    const char *const named = getenv("CUBEMAP_IMAGE_IO");
    if (named != NULL && *named != '\0')
    {
        return open_library(named, message);
    }
    char folder[PATH_MAX];
    find_folder(folder);
    const char *const places[] = {IMAGE_IO_FROM_BIN, IMAGE_IO_FROM_TOOLS};
    for (size_t i = 0; folder[0] != '\0' && i < sizeof places / sizeof *places; i++)
    {
        char path[PATH_MAX];
        const int length = snprintf(path, sizeof path, "%s%s", folder, places[i]);
        if (length > 0 && (size_t)length < sizeof path && access(path, F_OK) == 0)
        {
            return open_library(path, message);
        }
    }
    if (access(IMAGE_IO_INSTALLED, F_OK) == 0)
    {
        return open_library(IMAGE_IO_INSTALLED, message);
    }
    say(message,
        "there is no library for image files, neither '%s' nor from the program's folder '%s'; "
        "CUBEMAP_IMAGE_IO may name it",
        IMAGE_IO_INSTALLED, IMAGE_IO_FROM_BIN);
    return NULL;
}

const cm_image_io *cm_image_io_get(char *message)
{
    pthread_mutex_lock(&lock);
    if (opened == NULL)
    {
        opened = find_library(message);
    }
    const cm_image_io *const table = opened;
    pthread_mutex_unlock(&lock);
    return table;
}
