/* SPDX-License-Identifier: MIT
 *
 * What both kinds of texture files share: the formats' numbers, the sizes of levels.
 */
#ifndef CUBEMAP_MODULES_IMAGE_TEXTURE_FORMAT_H
#define CUBEMAP_MODULES_IMAGE_TEXTURE_FORMAT_H

#include "file_words.h"
#include "texture_file.h"

/* Numbers of formats: of DXGI (DXGI_FORMAT), and of Vulkan (VkFormat in the specification). */
typedef struct cm_texture_numbers
{
    cm_pixel_type type;
    uint32_t dxgi;
    uint32_t vulkan;
    uint32_t texel_size; /* bytes */
} cm_texture_numbers;

#define CM_TEXTURE_FORMATS 5
extern const cm_texture_numbers cm_texture_formats[CM_TEXTURE_FORMATS];

static inline uint32_t cm_texture_extent(uint32_t extent, uint32_t level)
{
    return extent >> level > 0 ? extent >> level : 1;
}

/* Bytes of one face of a level. */
static inline uint64_t cm_texture_face_size(const cm_texture *texture, uint32_t level)
{
    return (uint64_t)cm_texture_extent(texture->width, level) *
           cm_texture_extent(texture->height, level) *
           cm_texture_formats[texture->format].texel_size;
}

/* Are the sizes and counts such as a file may have? */
cm_status cm_texture_check(const cm_texture *texture, char *message);

cm_status cm_dds_write_head(const cm_image_stream *stream, const cm_texture *texture,
                            char *message);
cm_status cm_dds_open(const cm_image_stream *stream, cm_texture *texture, char *message);

/* Where levels begin in the file, too: into offsets. */
cm_status cm_ktx_write_head(const cm_image_stream *stream, const cm_texture *texture,
                            uint64_t offsets[CM_TEXTURE_LEVELS_MOST], uint64_t *end, char *message);
cm_status cm_ktx_open(const cm_image_stream *stream, cm_texture *texture, char *message);

#endif
