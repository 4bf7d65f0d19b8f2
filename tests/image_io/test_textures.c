/* SPDX-License-Identifier: MIT
 *
 * DDS and KTX 2.0: round trips, the bytes of small files as the specifications have them, files cut anywhere.
 */
#include "modules/image/io/texture_file.h"

#include "tests/memory_stream.h"
#include "tests/suite.h"

enum
{
    EDGE = 4,
    LEVELS = 3,
    FACES = 6,
    ROOM = 1 << 16,
    PIXEL_MOST = 16
};

static char message[CM_IMAGE_MESSAGE];
static unsigned char file[ROOM];
_Alignas(8) static unsigned char pixels[LEVELS][FACES][EDGE * EDGE * PIXEL_MOST];
static cm_image images[LEVELS][FACES];

static uint32_t word_at(size_t at)
{
    return (uint32_t)file[at] | (uint32_t)file[at + 1] << 8 | (uint32_t)file[at + 2] << 16 |
           (uint32_t)file[at + 3] << 24;
}

static cm_texture make_texture(cm_texture_container container, cm_texture_format format,
                               uint32_t faces, uint32_t channels)
{
    const cm_texture texture = {.size = sizeof texture,
                                .container = container,
                                .format = format,
                                .width = EDGE,
                                .height = EDGE,
                                .faces = faces,
                                .levels = LEVELS,
                                .writer = "cubemap"};
    for (uint32_t l = 0; l < LEVELS; l++)
    {
        for (uint32_t f = 0; f < FACES; f++)
        {
            for (size_t i = 0; i < sizeof pixels[l][f]; i++)
            {
                pixels[l][f][i] = (unsigned char)(i * 7 + f * 31 + l * 101);
            }
            images[l][f] = (cm_image){.size = sizeof(cm_image),
                                      .data = pixels[l][f],
                                      .type = cm_texture_type(format),
                                      .width = EDGE >> l,
                                      .height = EDGE >> l,
                                      .channels = channels};
        }
    }
    return texture;
}

static size_t write_file(const cm_texture *texture, size_t room)
{
    const cm_image *const levels[LEVELS] = {images[0], images[1], images[2]};
    memory_stream memory = {file, 0, room, 0};
    const cm_image_stream stream = stream_of(&memory);
    const cm_status status = cm_texture_write(&stream, texture, levels, message);
    REQUIRE(status == (memory.size < room || room == ROOM ? CM_OK : CM_ERROR_UNSUPPORTED), "%d %s",
            (int)status, message);
    return memory.size;
}

static void expect_same(const cm_texture *texture, size_t size)
{
    unsigned char got[sizeof pixels[0][0]];
    cm_texture read = {.size = 0};
    memory_stream memory = {file, size, size, 0};
    const cm_image_stream stream = stream_of(&memory);
    REQUIRE(cm_texture_open(&stream, &read, message) == CM_OK, "%s", message);
    REQUIRE(read.width == EDGE && read.height == EDGE && read.levels == LEVELS &&
                read.faces == texture->faces && read.format == texture->format &&
                read.container == texture->container && strcmp(read.orientation, "rd") == 0 &&
                read.alpha_multiplied == texture->alpha_multiplied &&
                strcmp(read.surface, texture->surface) == 0 &&
                strcmp(read.rotation, texture->rotation) == 0,
            "other: %u x %u", read.width, read.height);
    for (uint32_t l = 0; l < LEVELS; l++)
    {
        for (uint32_t f = 0; f < texture->faces; f++)
        {
            const size_t edge = EDGE >> l;
            const size_t texel = 4 * cm_pixel_size(cm_texture_type(texture->format));
            REQUIRE(cm_texture_read(&stream, &read, l, f, got, 0, message) == CM_OK, "%s", message);
            REQUIRE(memcmp(got, pixels[l][f], edge * edge * texel) == 0, "level %u face %u", l, f);
        }
    }
    REQUIRE(cm_texture_read(&stream, &read, LEVELS, 0, got, 0, message) == CM_ERROR_ARGUMENT,
            "a level too many");
}

START_TEST(test_round_trips)
{
    for (unsigned container = 0; container < 2; container++)
    {
        for (unsigned format = 0; format < 5; format++)
        {
            for (uint32_t faces = 1; faces <= 6; faces += 5)
            {
                cm_texture texture = make_texture((cm_texture_container)container,
                                                  (cm_texture_format)format, faces, 4);
                texture.alpha_multiplied = faces == 6;
                if (container == CM_TEXTURE_KTX2 && faces == 6)
                {
                    strcpy(texture.surface, "cube:gnomonic;frame=gl");
                    memset(texture.rotation, '1', sizeof texture.rotation - 1);
                }
                expect_same(&texture, write_file(&texture, ROOM));
            }
        }
    }
}
END_TEST

/* "Programming Guide for DDS": DDS_HEADER and DDS_HEADER_DXT10. */
START_TEST(test_dds_bytes)
{
    const cm_texture texture = make_texture(CM_TEXTURE_DDS, CM_TEXTURE_RGBA8_SRGB, 6, 4);
    const size_t size = write_file(&texture, ROOM);
    ck_assert_uint_eq(size, 148 + 6 * (16 + 4 + 1) * 4);
    static const uint32_t wanted[][2] = {{4, 124},        {8, 0x2100f},  {12, EDGE}, {16, EDGE},
                                         {20, EDGE * 4},  {28, LEVELS},  {76, 32},   {80, 4},
                                         {108, 0x401008}, {112, 0xfe00}, {128, 29},  {132, 3},
                                         {136, 4},        {140, 1},      {144, 1}};
    REQUIRE(memcmp(file, "DDS ", 4) == 0 && memcmp(file + 84, "DX10", 4) == 0, "magic");
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++)
    {
        REQUIRE(word_at(wanted[i][0]) == wanted[i][1], "at %u: %x", wanted[i][0],
                word_at(wanted[i][0]));
    }
    /* the second face follows all levels of the first */
    REQUIRE(memcmp(file + 148 + 84, pixels[0][1], 64) == 0, "second face");
}
END_TEST

/* KTX 2.0, sections 3.1 to 3.11, and the basic descriptor block of the Data Format Specification, section 5. */
START_TEST(test_ktx_bytes)
{
    const cm_texture texture = make_texture(CM_TEXTURE_KTX2, CM_TEXTURE_RGBA8_SRGB, 6, 4);
    const size_t size = write_file(&texture, ROOM);
    static const uint32_t wanted[][2] = {
        {12, 43},          {16, 1},        {20, EDGE}, {24, EDGE}, {28, 0},        {32, 0},
        {36, 6},           {40, 3},        {44, 0},    {48, 152},  {52, 92},       {56, 244},
        {60, 48},          {64, 0},        {72, 0},    {80, 412},  {88, 384},      {96, 384},
        {104, 316},        {112, 96},      {128, 292}, {136, 24},  {152, 92},      {156, 0},
        {160, 0x580002},   {164, 0x20101}, {168, 0},   {172, 4},   {180, 0x70000}, {192, 255},
        {228, 0x1f070018}, {244, 18},      {268, 18}};
    REQUIRE(memcmp(file, "\xabKTX 20\xbb\r\n\x1a\n", 12) == 0, "identifier");
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++)
    {
        REQUIRE(word_at(wanted[i][0]) == wanted[i][1], "at %u: 0x%x", wanted[i][0],
                word_at(wanted[i][0]));
    }
    REQUIRE(memcmp(file + 248, "KTXorientation\0rd\0\0\0", 20) == 0, "orientation");
    REQUIRE(memcmp(file + 272, "KTXwriter\0cubemap\0\0\0", 20) == 0, "writer");
    ck_assert_uint_eq(size, 412 + 384);
    REQUIRE(memcmp(file + 292, pixels[2][0], 4) == 0, "the smallest level is first");
}
END_TEST

/* Grey and without alpha: 1 is written. */
START_TEST(test_channels)
{
    for (uint32_t channels = 1; channels <= 3; channels++)
    {
        cm_texture texture = make_texture(CM_TEXTURE_DDS, CM_TEXTURE_RGBA8, 1, channels);
        write_file(&texture, ROOM);
        const unsigned char *const in = pixels[0][0];
        const unsigned char *const out = file + 148 + 4;
        const unsigned char wanted[4] = {in[channels], in[channels == 3 ? 4 : channels],
                                         in[channels == 3 ? 5 : channels],
                                         channels == 2 ? in[3] : 255};
        REQUIRE(memcmp(out, wanted, 4) == 0, "%u channels: %u %u %u %u", channels, out[0], out[1],
                out[2], out[3]);
    }
}
END_TEST

START_TEST(test_truncated)
{
    for (unsigned container = 0; container < 2; container++)
    {
        const cm_texture texture =
            make_texture((cm_texture_container)container, CM_TEXTURE_RGBA8, 6, 4);
        const size_t size = write_file(&texture, ROOM);
        for (size_t cut = 0; cut < size; cut++)
        {
            cm_texture read = {.size = 77};
            memory_stream memory = {file, cut, cut, 0};
            const cm_image_stream stream = stream_of(&memory);
            message[0] = '\0';
            REQUIRE(cm_texture_open(&stream, &read, message) == CM_ERROR_UNSUPPORTED &&
                        read.size == 77 && strlen(message) > 10,
                    "%zu of %zu bytes: %s", cut, size, message);
        }
        for (size_t room = 0; room < size; room += 3)
        {
            write_file(&texture, room);
        }
    }
}
END_TEST

/* Any word of the header is something else: an error, or a texture whose pixels are all there. */
START_TEST(test_crafted)
{
    static const uint32_t values[] = {0, 1, 2, 7, 0x7fffffff, 0x80000000, 0xffffffff};
    unsigned char got[4 * EDGE * EDGE * PIXEL_MOST];
    size_t refused = 0;
    for (unsigned container = 0; container < 2; container++)
    {
        const cm_texture texture =
            make_texture((cm_texture_container)container, CM_TEXTURE_RGBA8, 6, 4);
        const size_t size = write_file(&texture, ROOM);
        for (size_t i = 0; i < 73 * 7; i++)
        {
            unsigned char kept[4];
            unsigned char *const at = file + i / 7 * 4;
            memcpy(kept, at, 4);
            for (unsigned b = 0; b < 4; b++)
            {
                at[b] = (unsigned char)(values[i % 7] >> 8 * b);
            }
            cm_texture read = {.size = 0};
            memory_stream memory = {file, size, size, 0};
            const cm_image_stream stream = stream_of(&memory);
            const cm_status status = cm_texture_open(&stream, &read, message);
            REQUIRE(status == CM_OK || status == CM_ERROR_UNSUPPORTED, "%d", (int)status);
            refused += status != CM_OK;
            if (status == CM_OK && read.width <= 2 * EDGE && read.height <= 2 * EDGE)
            {
                REQUIRE(cm_texture_read(&stream, &read, read.levels - 1, read.faces - 1, got, 0,
                                        message) == CM_OK,
                        "%s", message);
            }
            memcpy(at, kept, 4);
        }
    }
    ck_assert_uint_gt(refused, 200);
}
END_TEST

START_TEST(test_refusals)
{
    cm_texture texture = make_texture(CM_TEXTURE_KTX2, CM_TEXTURE_RGBA8, 6, 4);
    const cm_image *const levels[LEVELS] = {images[0], images[1], images[2]};
    memory_stream memory = {file, 0, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    memset(texture.surface, 'a', sizeof texture.surface);
    REQUIRE(cm_texture_write(&stream, &texture, levels, message) == CM_ERROR_ARGUMENT,
            "a text without end");
    texture.surface[0] = '\0';
    images[1][3].width = 3;
    REQUIRE(cm_texture_write(&stream, &texture, levels, message) == CM_ERROR_RANGE, "a size");
    texture.levels = 4;
    REQUIRE(cm_texture_write(&stream, &texture, levels, message) == CM_ERROR_ARGUMENT, "levels");
    texture.levels = 1;
    texture.faces = 5;
    REQUIRE(cm_texture_write(&stream, &texture, levels, message) == CM_ERROR_ARGUMENT, "faces");
    ck_assert_uint_eq(memory.size, 0);
    ck_assert_uint_eq(cm_texture_levels(512, 512), 10);
    ck_assert_uint_eq(cm_texture_levels(48, 48), 5);
    ck_assert_uint_eq(cm_texture_levels(8, 2), 4);
    ck_assert_uint_eq(cm_texture_levels(1, 1), 1);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_round_trips, test_dds_bytes, test_ktx_bytes, test_channels,
                                  test_truncated,   test_crafted,   test_refusals,  NULL};
    return run_suite("textures", tests);
}
