/* SPDX-License-Identifier: MIT
 *
 * A store's file, damaged by the input: triples of a place and a byte are written into a good one, or the input is the file.
 * It is refused in one line, or what is got from it is as it was put; and it can be written.
 */
#define _GNU_SOURCE

#include "modules/scene/io/store_file.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fuzz.h"

enum
{
    BLOBS = 12,
    ROOM = 1 << 18
};

static char path[100];
static unsigned char good[ROOM];
static size_t good_size;

static void fill(unsigned char *data, unsigned number, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        data[i] = (unsigned char)(number * 37 + i * i);
    }
}

static void make_good(void)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    char message[CM_IMAGE_MESSAGE] = "";
    cm_store *store = NULL;
    unlink(path);
    EXPECT(cm_store_file_open(path, &options, &store, message) == CM_OK, "%s", message);
    static unsigned char data[BLOBS * 600];
    for (unsigned i = 0; i < BLOBS; i++)
    {
        fill(data, i, i * 600);
        const unsigned char letter = (unsigned char)('a' + i);
        const cm_store_key key = {&letter, 1};
        const cm_blob blob = {sizeof blob, 1, 1, data, i * 600};
        EXPECT(cm_store_put(store, &key, &blob) == CM_OK, "%s", cm_store_message(store));
    }
    EXPECT(cm_store_commit(store) == CM_OK, "%s", cm_store_message(store));
    cm_store_destroy(store);
    FILE *file = fopen(path, "rb");
    EXPECT(file != NULL, "no file");
    good_size = fread(good, 1, sizeof good, file);
    fclose(file);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    const char *folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    snprintf(path, sizeof path, "%s/cubemap-fuzz-store-%ld", folder, (long)getpid());
    make_good();
    return 0;
}

static void write_input(supply *from)
{
    static unsigned char bytes[ROOM];
    size_t size = good_size;
    memcpy(bytes, good, good_size);
    if (take_byte(from) == 'F')
    {
        size = from->left < ROOM ? from->left : ROOM;
        take_bytes(from, bytes, size);
    }
    while (from->left >= 4)
    {
        const uint32_t word = take_word(from);
        bytes[(word >> 8) % good_size] = (unsigned char)word;
    }
    FILE *file = fopen(path, "wb");
    EXPECT(file != NULL && fwrite(bytes, 1, size, file) == size, "cannot write");
    fclose(file);
}

static void check_store(cm_store *store)
{
    static unsigned char data[BLOBS * 600];
    for (unsigned i = 0; i < BLOBS; i++)
    {
        const unsigned char letter = (unsigned char)('a' + i);
        const cm_store_key key = {&letter, 1};
        cm_blob blob = {.size = sizeof blob};
        const cm_status status = cm_store_get(store, &key, 1, 1, &blob);
        EXPECT(status == CM_OK || is_one_line(cm_store_message(store)), "%d", (int)status);
        fill(data, i, i * 600);
        EXPECT(blob.data == NULL ||
                   (blob.count == i * 600 && memcmp(blob.data, data, blob.count) == 0),
               "blob %u is another one", i);
        cm_blob_clear(&blob);
    }
    const cm_store_key key = {"z", 1};
    const cm_blob blob = {sizeof blob, 1, 1, data, 5000};
    if (cm_store_put(store, &key, &blob) != CM_OK || cm_store_commit(store) != CM_OK)
    {
        EXPECT(cm_store_message(store)[0] != '\0', "no message");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    write_input(&from);
    char message[CM_IMAGE_MESSAGE] = "";
    cm_store *store = NULL;
    const cm_status status = cm_store_file_open(path, NULL, &store, message);
    if (status != CM_OK)
    {
        EXPECT(store == NULL && strncmp(message, path, strlen(path)) == 0 && is_one_line(message),
               "%d: %s", (int)status, message);
        return 0;
    }
    check_store(store);
    cm_store_destroy(store);
    return 0;
}
