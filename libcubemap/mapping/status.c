/* SPDX-License-Identifier: MIT */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "message.h"

#include <stdarg.h>
#include <stdio.h>

const char *cm_status_text(cm_status status)
{
    switch (status)
    {
    case CM_OK:
        return "success";
    case CM_ERROR_ARGUMENT:
        return "an argument is NULL or out of range, or the size of a struct is not set";
    case CM_ERROR_SYNTAX:
        return "a mapping is written NAME[:PARAMETER=VALUE[,PARAMETER=VALUE...]]";
    case CM_ERROR_MAPPING:
        return "no mapping has this name";
    case CM_ERROR_PARAMETER:
        return "the mapping has no such parameter, or it is given twice";
    case CM_ERROR_RANGE:
        return "a parameter is outside its range";
    case CM_ERROR_FRAME:
        return "the table is not a frame of six faces";
    case CM_ERROR_UNSUPPORTED:
        return "the mapping has no such operation";
    case CM_ERROR_MEMORY:
        return "out of memory";
    case CM_ERROR_INSTRUCTIONS:
        return "this machine or this build does not have that instruction set";
    case CM_ERROR_ELLIPSOID:
        return "no ellipsoid has this name, or these axes";
    case CM_ERROR_LATITUDE:
        return "no latitude has this name";
    case CM_ERROR_ORIENTATION:
        return "no orientation has this name, or these angles";
    case CM_ERROR_CELL:
        return "no cell has this number, text, level or place";
    case CM_ERROR_PIXEL:
        return "HEALPix has no such resolution or pixel";
    case CM_ERROR_SPACE:
        return "there are more results than there is room for";
    case CM_ERROR_STOPPED:
        return "stopped by the caller's callback";
    case CM_ERROR_CAMERA:
        return "no camera, pose or view is like this";
    case CM_ERROR_RANK:
        return "too little is given to determine the answer";
    case CM_ERROR_FILE:
        return "the file cannot be opened, read or written";
    case CM_ERROR_DATA:
        return "the data are damaged, or of another kind";
    case CM_ERROR_VERSION:
        return "the data are of a newer version";
    }
    return "unknown status";
}

const char *cm_version(void)
{
    return CM_VERSION_STRING;
}

cm_status cm_fail(cm_status status, char *message, size_t size, const char *format, ...)
{
    if (message != NULL && size > 0)
    {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message, size, format, arguments);
        va_end(arguments);
        for (char *c = message; *c != '\0'; c++)
        {
            if ((unsigned char)*c < 0x20 || *c == 0x7f)
            {
                *c = '?';
            }
        }
    }
    return status;
}
