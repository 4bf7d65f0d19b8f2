/* SPDX-License-Identifier: MIT
 *
 * Pictures through pipes: PGM, PPM, PAM, PFM and bare samples, one after another. What is wrong with them is said in one
 * line; what is read is the same after it was written. The input is a byte that says whether samples are bare, and of which
 * type and size; then the stream.
 */
#include "modules/image/io/file_words.h"
#include "modules/image/io/pnm_file.h"
#include "tests/memory_stream.h"

#include "fuzz.h"

enum
{
    BYTES_MOST = 1 << 20, /* of a picture that is read */
    PICTURES_MOST = 8
};

static void check_message(cm_status status, const char *message)
{
    EXPECT(status == CM_ERROR_UNSUPPORTED && message[0] != '\0' && is_one_line(message),
           "status %d: %s", (int)status, message);
}

static void check_picture(const cm_pnm_picture *picture)
{
    EXPECT(picture->width >= 1 && picture->width <= CM_PNM_SIZE_MOST && picture->height >= 1 &&
               picture->height <= CM_PNM_SIZE_MOST && picture->channels >= 1 &&
               picture->channels <= CM_CHANNELS_MAX && cm_file_sample_size(picture->type) > 0,
           "%u x %u, %u channels of type %d", picture->width, picture->height, picture->channels,
           (int)picture->type);
    EXPECT(picture->maximum <= 65535 && (picture->maximum <= 255 || picture->type == CM_PIXEL_U16),
           "at most %u", picture->maximum);
}

/* All but a PAM whose channels no kind has. */
static void check_again(const cm_pnm_picture *picture, const void *pixels, size_t size)
{
    static unsigned char room[BYTES_MOST + 4096];
    memory_stream memory = {room, 0, sizeof room, 0};
    const cm_image_stream stream = stream_of(&memory);
    char message[CM_IMAGE_MESSAGE] = "";
    const ptrdiff_t row = (ptrdiff_t)(size / picture->height);
    const cm_image image = {.size = sizeof image,
                            .data = (void *)(uintptr_t)pixels,
                            .type = picture->type,
                            .width = picture->width,
                            .height = picture->height,
                            .channels = picture->channels};
    EXPECT(cm_pnm_write(&stream, picture, &image, message) == CM_OK, "%s", message);
    memory.at = 0;
    cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
    cm_pnm_picture again = *picture;
    bool more = false;
    unsigned char *const same = malloc(size);
    EXPECT(same != NULL, "no memory");
    EXPECT(cm_pnm_next(&reader, &again, &more, message) == CM_OK && more, "%s", message);
    EXPECT(again.kind == picture->kind && again.type == picture->type &&
               again.width == picture->width && again.height == picture->height &&
               again.channels == picture->channels && again.alpha == picture->alpha,
           "another picture");
    unsigned char *const first = again.bottom_up ? same + size - (size_t)row : same;
    EXPECT(cm_pnm_read(&reader, again.height, first, again.bottom_up ? -row : row, message) ==
               CM_OK,
           "%s", message);
    EXPECT(memcmp(same, pixels, size) == 0, "other samples");
    EXPECT(cm_pnm_next(&reader, &again, &more, message) == CM_OK && !more, "%s", message);
    free(same);
}

/* One picture; 0 if the stream is to be left. */
static int read_picture(cm_pnm_reader *reader, const cm_pnm_picture *bare, size_t left)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_pnm_picture picture = *bare;
    bool more = false;
    const cm_status status = cm_pnm_next(reader, &picture, &more, message);
    if (status != CM_OK || !more)
    {
        if (status != CM_OK)
        {
            check_message(status, message);
        }
        return 0;
    }
    check_picture(&picture);
    const size_t row = (size_t)picture.width * picture.channels * cm_file_sample_size(picture.type);
    if (row > BYTES_MOST || row * picture.height > BYTES_MOST)
    {
        return 0;
    }
    unsigned char *const pixels = malloc(row * picture.height);
    EXPECT(pixels != NULL, "no memory");
    EXPECT(cm_pnm_read(reader, picture.height + 1, pixels, 0, message) == CM_ERROR_ARGUMENT,
           "one more row");
    const cm_status read = cm_pnm_read(reader, picture.height, pixels, 0, message);
    if (read != CM_OK)
    {
        check_message(read, message);
    }
    else
    {
        EXPECT(row * picture.height <= left, "more than there is");
        check_again(&picture, pixels, row * picture.height);
    }
    free(pixels);
    return read == CM_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    memory_stream memory = {malloc(size), size - 1, size - 1, 0};
    EXPECT(memory.bytes != NULL, "no memory");
    memcpy(memory.bytes, data + 1, size - 1);
    const cm_image_stream stream = stream_of(&memory);
    cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
    cm_pnm_picture bare = {.size = sizeof bare};
    if (data[0] & 1)
    {
        bare.kind = CM_PNM_RAW;
        bare.width = 1 + (data[0] >> 1 & 3);
        bare.height = 1 + (data[0] >> 3 & 1);
        bare.channels = 1 + (data[0] >> 4 & 1);
        bare.type = (cm_pixel_type)(data[0] >> 5 & 3);
        bare.little_endian = data[0] >> 7;
    }
    for (int i = 0; i < PICTURES_MOST && read_picture(&reader, &bare, size); i++)
    {
    }
    free(memory.bytes);
    return 0;
}
