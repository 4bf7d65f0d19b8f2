/* SPDX-License-Identifier: MIT
 *
 * Sequences: the views of a depth camera in time, from a folder or a stream, and into them.
 *
 *   layout      TUM          camera.json, depth.txt, rgb.txt, groundtruth.txt; lists of "time file", seconds
 *               Open3D       trajectory.log, whose entry N is of the files image_NNNNN.jpg (or .png) and depth_NNNNN.png;
 *                            time is N / 30 s
 *               7-Scenes     frame-NNNNNN.color.png, .depth.png with 65535 for nothing measured, .pose.txt; time is N / 30 s
 *               stream       the bytes that view_stream.h tells of, from standard input and to standard output
 *   camera      DIR/camera.json of the folder, or the one that the options name, which goes first; without both an error.
 *               It is of the depth images; colours must be of its size, too
 *   depth       16-bit PNG, or float EXR and NPY in depth_scale units a metre; 0 and NaN: nothing was measured. Images of
 *               omnidirectional cameras hold range
 *   left out    listed files that are absent, and depth images without a pose near enough, are left out and counted; if
 *               no view is left, that is an error
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE:LINE: what is wrong" or "FILE: what is wrong". Written on
 *               failure only
 *   threads     one sequence is used by one thread at a time
 */
#ifndef CUBEMAP_MODULES_SCENE_SEQUENCE_H
#define CUBEMAP_MODULES_SCENE_SEQUENCE_H

#include <cubemap/view.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the files of a sequence lie. */
typedef enum cm_sequence_layout
{
    CM_SEQUENCE_ANY = 0,          /* as the folder has it: found by its files */
    CM_SEQUENCE_TUM = 1,          /* "tum" */
    CM_SEQUENCE_OPEN3D = 2,       /* "open3d" */
    CM_SEQUENCE_SEVEN_SCENES = 3, /* "7scenes" */
    CM_SEQUENCE_STREAM = 4        /* "stream" */
} cm_sequence_layout;

/* "tum", ...; NULL for what is none. And back: CM_ERROR_ARGUMENT for a name that is none. */
const char *cm_sequence_layout_name(cm_sequence_layout layout);
cm_status cm_sequence_layout_find(const char *name, cm_sequence_layout *layout);

/* To be filled with zeros but for size and what is wanted. */
typedef struct cm_sequence_options
{
    size_t size;               /* sizeof(cm_sequence_options) */
    cm_sequence_layout layout; /* CM_SEQUENCE_ANY: found out */
    const char *camera;        /* a CAMERA.json that goes before the folder's; NULL */
    double pose_within;        /* seconds from a depth image to its pose at most; 0: 0.02 */
    double color_within;       /* seconds from a depth image to its colours at most; 0: 0.02 */
    int colors_will_do; /* 1: a folder without depth images is one, too, whose views are its colours and have no depth */
} cm_sequence_options;

/* What was found, and what was left out. */
typedef struct cm_sequence_report
{
    size_t size;               /* sizeof(cm_sequence_report) */
    cm_sequence_layout layout; /* the one that was read */
    size_t count;              /* views; of a stream, those read so far */
    size_t listed;             /* depth images that are named */
    size_t absent;             /* of these, those whose file is not there */
    size_t without_pose;       /* of these, those that have no pose near enough */
    size_t without_color;      /* of the views, those without colours */
    size_t color_absent;       /* colour images that are named and whose file is not there */
    size_t poses;              /* poses that are given */
    double first, last;        /* the times of the first and the last view, seconds */
    double depth_scale;        /* stored units of depth a metre */
    const cm_camera *camera;   /* lives as long as the sequence */
} cm_sequence_report;

/* A view without its pictures. Names are as listed, within the folder; NULL: none. They live as long as the sequence. */
typedef struct cm_sequence_entry
{
    double time; /* of the depth image, seconds */
    cm_pose pose;
    const char *depth; /* there, unless colors_will_do */
    const char *color;
} cm_sequence_entry;

typedef struct cm_sequence cm_sequence;

/* What cm_sequence_count returns for a stream, whose end is not known before it is read. */
#define CM_SEQUENCE_UNKNOWN ((size_t)-1)

/* Open a folder, or standard input if folder is "-", whose views can be had once, in their order, from 0. The lists are read
 * and checked; of pictures only whether they are there. options may be NULL.
 * CM_ERROR_ARGUMENT, _MEMORY, _FILE, _CAMERA (a camera or a pose that is none), _DATA, _VERSION. */
cm_status cm_sequence_open(const char *folder, const cm_sequence_options *options,
                           cm_sequence **sequence, char *message);
/* NULL is allowed. */
void cm_sequence_close(cm_sequence *sequence);

/* The number of views; CM_SEQUENCE_UNKNOWN of a stream. */
size_t cm_sequence_count(const cm_sequence *sequence);
/* Lives as long as the sequence; of a stream it grows with the views. */
const cm_sequence_report *cm_sequence_describe(const cm_sequence *sequence);

/* View k without decoding it: CM_ERROR_RANGE if there is none, CM_ERROR_UNSUPPORTED for a stream. */
cm_status cm_sequence_entry_at(const cm_sequence *sequence, size_t k, cm_sequence_entry *entry,
                               char *message);

/* View k, decoded. It belongs to the sequence and lives until its next view is asked for, or until cm_sequence_close.
 * CM_ERROR_RANGE if there is none, which is how a stream ends; CM_ERROR_DATA for what is wrong with a picture; CM_ERROR_FILE;
 * CM_ERROR_MEMORY. */
cm_status cm_sequence_view(cm_sequence *sequence, size_t k, const cm_view **view, char *message);

typedef struct cm_sequence_writer cm_sequence_writer;

/* Begin a folder, or standard output if folder is "-" and the layout CM_SEQUENCE_STREAM. The folder must be absent or empty:
 * its files are written into another beside it, which takes its name when all is there (cm_sequence_finish); others that
 * programs which were killed have left beside it are removed. Cameras with a mapping, and pixel centres that are not at
 * integers, are written in camera.json, which is written in every layout.
 * CM_ERROR_ARGUMENT, _MEMORY, _FILE. */
cm_status cm_sequence_create(const char *folder, cm_sequence_layout layout, const cm_camera *camera,
                             double depth_scale, cm_sequence_writer **writer, char *message);

/* What whole units did not keep, of all views so far. Nothing of a stream, which keeps all. */
typedef struct cm_sequence_loss
{
    size_t size; /* sizeof(cm_sequence_loss) */
    size_t
        rounded; /* measured depths that are off by more than a thousandth of a unit, and than floats are */
    double most;   /* by so many metres at most */
    size_t beyond; /* measured depths that are stored as nothing measured */
} cm_sequence_loss;

/* Lives as long as the writer. */
const cm_sequence_loss *cm_sequence_writer_loss(const cm_sequence_writer *writer);

/* Where the files are until cm_sequence_finish: a program may put others there, into folders of its own. NULL of a stream. */
const char *cm_sequence_writer_folder(const cm_sequence_writer *writer);

/* Add a view, in the order of time. Depth is stored as 16-bit PNG of whole units, rounded to the nearest; what is not
 * finite, not above 0 or beyond 65535 units (65534 in 7-Scenes) is stored as nothing measured, and counted in *beyond if it
 * was measured (NULL: not counted). Range becomes depth, and depth range, as the camera wants it. Colours of the view are
 * written if there are any; amplitudes in streams alone. 7-Scenes has millimetres, whatever depth_scale was asked. */
cm_status cm_sequence_write(cm_sequence_writer *writer, const cm_view *view, size_t *beyond,
                            char *message);

/* Complete it: after this the folder is there with its name, on the disk. Without it there is none. */
cm_status cm_sequence_finish(cm_sequence_writer *writer, char *message);
/* With or without cm_sequence_finish; NULL is allowed. */
void cm_sequence_drop(cm_sequence_writer *writer);

#ifdef __cplusplus
}
#endif

#endif
