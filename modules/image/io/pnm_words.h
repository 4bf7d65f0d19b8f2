/* SPDX-License-Identifier: MIT
 *
 * The headers of PGM, PPM, PAM and PFM, read byte by byte, so that nothing behind them is taken.
 */
#ifndef CUBEMAP_MODULES_IMAGE_PNM_WORDS_H
#define CUBEMAP_MODULES_IMAGE_PNM_WORDS_H

#include "pnm_file.h"

/* Is there such a picture of its kind? CM_ERROR_ARGUMENT with a message. */
cm_status cm_pnm_check(const cm_pnm_picture *picture, char *message);

/* The header, of which the first byte was read; *picture is zeros. */
cm_status cm_pnm_read_header(const cm_image_stream *stream, char first, cm_pnm_picture *picture,
                             char *message);

#endif
