/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "descriptor.h"

#include <errno.h>

#ifdef _WIN32

#include <fcntl.h>
#include <io.h>
#include <windows.h>

int descriptor_of(FILE *stream)
{
    const int descriptor = _fileno(stream);
    if (descriptor >= 0)
    {
        (void)_setmode(descriptor, _O_BINARY);
    }
    return descriptor;
}

ptrdiff_t descriptor_read(int descriptor, char *to, size_t room)
{
    return _read(descriptor, to, (unsigned)room);
}

ptrdiff_t descriptor_write(int descriptor, const char *from, size_t length)
{
    return _write(descriptor, from, (unsigned)length);
}

bool descriptor_has_input(int descriptor)
{
    const HANDLE handle = (HANDLE)_get_osfhandle(descriptor);
    const DWORD kind = GetFileType(handle);
    DWORD present = 0;
    if (kind == FILE_TYPE_PIPE)
    {
        /* that of a pipe whose writer is gone fails, and reading does not wait */
        return !PeekNamedPipe(handle, NULL, 0, NULL, &present, NULL) || present > 0;
    }
    return kind == FILE_TYPE_DISK;
}

void descriptors_keep_closed(void)
{
    /* the three numbers are not given to files here */
}

#else

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

int descriptor_of(FILE *stream)
{
    return fileno(stream);
}

/* Waits where the descriptor itself does not. False if it was no waiting that was missing. */
static bool wait_for(int descriptor, short event)
{
    if (errno == EAGAIN)
    {
        struct pollfd ready = {descriptor, event, 0};
        (void)poll(&ready, 1, -1);
        return true;
    }
    return errno == EINTR;
}

ptrdiff_t descriptor_read(int descriptor, char *to, size_t room)
{
    ptrdiff_t count;
    do
    {
        count = read(descriptor, to, room);
    } while (count < 0 && wait_for(descriptor, POLLIN));
    return count;
}

ptrdiff_t descriptor_write(int descriptor, const char *from, size_t length)
{
    ptrdiff_t count;
    do
    {
        count = write(descriptor, from, length);
    } while (count < 0 && wait_for(descriptor, POLLOUT));
    return count;
}

bool descriptor_has_input(int descriptor)
{
    struct pollfd ready = {descriptor, POLLIN, 0};
    return poll(&ready, 1, 0) > 0;
}

void descriptors_keep_closed(void)
{
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; standard++)
    {
        if (fcntl(standard, F_GETFD) < 0)
        {
            /* the lowest number that is free, which is this one; open the wrong way, so that using it fails */
            (void)open("/dev/null", standard == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

#endif
