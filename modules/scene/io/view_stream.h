/* SPDX-License-Identifier: MIT
 *
 * Views one after the other through a pipe. All numbers are little-endian; sums are those of check_sum.h.
 *
 *   time     seconds, of each view after that of the one before
 *   head     "CMVIEWS1", bytes of text (u32), 0 (u32), sum of the text (u64), the text of CAMERA.json
 *   view     "VIEW" and 192 (u32), time, rotation by rows (9), position (3), depth_unit (f64 each: bytes 8 to 120),
 *            depth_is_range (u32), 0 (u32), width and height (u32), three pictures, depth, color, amplitude: type as in
 *            cm_pixel_type (u32), channels (u32; 0: none) (bytes 136 to 160), bytes of all pictures (u64), their sum (u64), 0
 *            (u64), sum of these 184 bytes (u64); then the pictures, dense, rows from the top
 *   end      "DONE" and 24 (u32), number of views (u64), sum of these 16 bytes (u64). Without it a stream was cut,
 *            and nothing may follow it: readers wait for the end of the pipe
 *   message  one line of CM_IMAGE_MESSAGE bytes at most, "NAME: view K: what is wrong". Written on failure only
 */
#ifndef CUBEMAP_MODULES_SCENE_VIEW_STREAM_H
#define CUBEMAP_MODULES_SCENE_VIEW_STREAM_H

#include <cubemap/view.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cm_view_reader cm_view_reader;
typedef struct cm_view_writer cm_view_writer;

/* Begin to read; the stream must live as long as the reader, and of its functions only read is called. name is for messages.
 * CM_ERROR_ARGUMENT, _MEMORY, _DATA, _VERSION, _CAMERA. */
cm_status cm_view_reader_create(const char *name, const cm_image_stream *stream,
                                cm_view_reader **reader, char *message);
/* NULL is allowed. */
void cm_view_reader_destroy(cm_view_reader *reader);
/* What the head says; lives as long as the reader. */
const cm_camera *cm_view_reader_camera(const cm_view_reader *reader, double *depth_scale);
/* The next view, which lives until the one after it is asked for. CM_ERROR_RANGE at the end, which is
 * that of the bytes too; CM_ERROR_DATA, _MEMORY. */
cm_status cm_view_reader_next(cm_view_reader *reader, const cm_view **view, char *message);

/* Begin to write; of the stream's functions only write is called. */
cm_status cm_view_writer_create(const char *name, const cm_image_stream *stream,
                                const cm_camera *camera, double depth_scale,
                                cm_view_writer **writer, char *message);
/* Its pictures are of the camera's size; depth must be there. CM_ERROR_ARGUMENT, _CAMERA, _FILE. */
cm_status cm_view_writer_put(cm_view_writer *writer, const cm_view *view, char *message);
/* The end. Without it readers know that the stream was cut. */
cm_status cm_view_writer_finish(cm_view_writer *writer, char *message);
/* NULL is allowed. */
void cm_view_writer_destroy(cm_view_writer *writer);

#ifdef __cplusplus
}
#endif

#endif
