/* SPDX-License-Identifier: MIT
 *
 * Textures, DDS and KTX 2.0: what a damaged file says is refused in one line, and what is taken is all there. The input is
 * the file.
 */
#include "modules/image/io/file_words.h"
#include "modules/image/io/texture_file.h"
#include "tests/memory_stream.h"

#include "fuzz.h"

enum
{
    BYTES_MOST = 1 << 22 /* of one face of a level, and of a file that is written again */
};

static uint32_t level_extent(uint32_t extent, uint32_t level)
{
    const uint32_t halved = extent >> level;
    return halved > 1 ? halved : 1;
}

static size_t face_bytes(const cm_texture *texture, uint32_t level)
{
    return (size_t)level_extent(texture->width, level) * level_extent(texture->height, level) * 4 *
           cm_file_sample_size(cm_texture_type(texture->format));
}

static void check_texture(const cm_texture *texture, size_t size)
{
    uint32_t levels = 1;
    for (uint32_t extent = texture->width > texture->height ? texture->width : texture->height;
         extent > 1; extent /= 2)
    {
        levels++;
    }
    EXPECT(texture->width >= 1 && texture->width <= CM_TEXTURE_SIZE_MOST && texture->height >= 1 &&
               texture->height <= CM_TEXTURE_SIZE_MOST &&
               (texture->faces == 1 || (texture->faces == 6 && texture->width == texture->height)),
           "%u x %u, %u faces", texture->width, texture->height, texture->faces);
    EXPECT(texture->levels >= 1 && texture->levels <= levels, "%u levels of %u", texture->levels,
           levels);
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        EXPECT(texture->offsets[level] <= size &&
                   face_bytes(texture, level) * texture->faces <= size - texture->offsets[level],
               "level %u at %llu of %zu", level, (unsigned long long)texture->offsets[level], size);
    }
    EXPECT(memchr(texture->orientation, '\0', sizeof texture->orientation) != NULL, "no end");
}

/* All faces of a level, which have their pixels; the pictures are the caller's. */
static void read_level(const cm_image_stream *stream, const cm_texture *texture, uint32_t level,
                       cm_image *faces)
{
    char message[CM_IMAGE_MESSAGE] = "";
    for (uint32_t face = 0; face < texture->faces; face++)
    {
        faces[face] = (cm_image){.size = sizeof *faces,
                                 .data = malloc(face_bytes(texture, level)),
                                 .type = cm_texture_type(texture->format),
                                 .width = level_extent(texture->width, level),
                                 .height = level_extent(texture->height, level),
                                 .channels = 4};
        EXPECT(faces[face].data != NULL, "no memory");
        EXPECT(cm_texture_read(stream, texture, level, face, faces[face].data, 0, message) == CM_OK,
               "%s", message);
    }
}

/* What was read is the same after it was written and read again. */
static void check_again(const cm_image_stream *stream, const cm_texture *texture)
{
    enum
    {
        ROOM = BYTES_MOST * 2 + 65536
    };
    static unsigned char room[ROOM];
    static cm_image faces[CM_TEXTURE_LEVELS_MOST][6];
    const cm_image *levels[CM_TEXTURE_LEVELS_MOST];
    char message[CM_IMAGE_MESSAGE] = "";
    memory_stream memory = {room, 0, sizeof room, 0};
    const cm_image_stream written = stream_of(&memory);
    cm_texture again = {.size = sizeof again};
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        read_level(stream, texture, level, faces[level]);
        levels[level] = faces[level];
    }
    EXPECT(cm_texture_write(&written, texture, levels, message) == CM_OK, "%s", message);
    EXPECT(cm_texture_open(&written, &again, message) == CM_OK, "%s", message);
    EXPECT(again.container == texture->container && again.format == texture->format &&
               again.width == texture->width && again.height == texture->height &&
               again.faces == texture->faces && again.levels == texture->levels,
           "another texture");
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        cm_image same[6];
        read_level(&written, &again, level, same);
        for (uint32_t face = 0; face < texture->faces; face++)
        {
            EXPECT(memcmp(same[face].data, faces[level][face].data, face_bytes(texture, level)) ==
                       0,
                   "level %u, face %u", level, face);
            free(same[face].data);
            free(faces[level][face].data);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char message[CM_IMAGE_MESSAGE] = "";
    memory_stream memory = {malloc(size + 1), size, size, 0};
    EXPECT(memory.bytes != NULL, "no memory");
    memcpy(memory.bytes, data, size);
    const cm_image_stream stream = stream_of(&memory);
    cm_texture texture = {.size = sizeof texture};
    const cm_status status = cm_texture_open(&stream, &texture, message);
    if (status != CM_OK)
    {
        EXPECT(status == CM_ERROR_UNSUPPORTED && message[0] != '\0' && is_one_line(message),
               "status %d: %s", (int)status, message);
    }
    else
    {
        check_texture(&texture, size);
        unsigned char pixel[16];
        EXPECT(cm_texture_read(&stream, &texture, texture.levels, 0, pixel, 0, message) ==
                       CM_ERROR_ARGUMENT &&
                   cm_texture_read(&stream, &texture, 0, texture.faces, pixel, 0, message) ==
                       CM_ERROR_ARGUMENT,
               "one more");
        if (size <= BYTES_MOST)
        {
            check_again(&stream, &texture);
        }
    }
    free(memory.bytes);
    return 0;
}
