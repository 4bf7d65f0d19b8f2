/* SPDX-License-Identifier: MIT
 *
 * What a call that can fail returns. Output arguments are untouched on failure.
 */
#ifndef CUBEMAP_STATUS_H
#define CUBEMAP_STATUS_H

#include <cubemap/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What went wrong, or that nothing did. */
typedef enum cm_status
{
    CM_OK = 0,              /* all is well */
    CM_ERROR_ARGUMENT = 1,  /* a pointer that must not be NULL is NULL, an index is out of range */
    CM_ERROR_SYNTAX = 2,    /* a specification is not NAME[:PARAMETER=VALUE[,...]], NAME:PRESET */
    CM_ERROR_MAPPING = 3,   /* no mapping of that name */
    CM_ERROR_PARAMETER = 4, /* no such parameter, or given twice, or beside a preset */
    CM_ERROR_RANGE = 5,     /* a parameter's value is outside its range */
    CM_ERROR_FRAME = 6,     /* a table that is not a frame */
    CM_ERROR_UNSUPPORTED = 7, /* the mapping has no such operation */
    CM_ERROR_MEMORY = 8,      /* no memory */
    CM_ERROR_INSTRUCTIONS =
        9,                   /* an instruction set that this machine or this build does not have */
    CM_ERROR_ELLIPSOID = 10, /* no ellipsoid of that name, or axes that are none */
    CM_ERROR_LATITUDE = 11,  /* no latitude of that name */
    CM_ERROR_ORIENTATION = 12, /* no orientation of that name, or angles that are none */
    CM_ERROR_CELL = 13,    /* a number or a text that is no cell, a level or a place that is none */
    CM_ERROR_PIXEL = 14,   /* an nside or a pixel that HEALPix does not have, or no point */
    CM_ERROR_SPACE = 15,   /* more results than there is room for */
    CM_ERROR_STOPPED = 16, /* the caller's callback ended the work */
    CM_ERROR_CAMERA = 17,  /* a camera, a pose or a view that is none */
    CM_ERROR_RANK = 18,    /* too little is given to determine the answer */
    CM_ERROR_FILE = 19,    /* the system did not open, read or write a file */
    CM_ERROR_DATA = 20,    /* a file or a blob that is damaged, or of another kind */
    CM_ERROR_VERSION = 21  /* a file or a blob of a newer version than this library knows */
} cm_status;

/* One sentence without a full stop for each status, in English; never NULL, whatever the argument. */
CM_API const char *cm_status_text(cm_status status);

#ifdef __cplusplus
}
#endif

#endif
