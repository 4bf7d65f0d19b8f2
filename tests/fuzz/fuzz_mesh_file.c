/* SPDX-License-Identifier: MIT
 *
 * Files of meshes through the child that reads them. Input: a byte, of which kind, and the file. Whatever it has, what comes
 * back is a mesh or one line.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/scene/io/mesh_file.h"

#include <unistd.h>

#include "fuzz.h"

/* The folder is gone when the harness ends. */
static char folder[] = "/tmp/fuzz-mesh-file-XXXXXX";
static const char *const endings[] = {"gltf", "glb", "obj"};

static void name_file(char name[100], size_t kind)
{
    snprintf(name, 100, "%s/it.%s", folder, endings[kind]);
}

static void remove_folder(void)
{
    for (size_t i = 0; i < 3; i++)
    {
        char name[100];
        name_file(name, i);
        (void)unlink(name);
    }
    (void)rmdir(folder);
}

/* A child's memory is the parent's, page by page: what AddressSanitizer keeps of blocks that are freed, 256 MiB in the end,
 * makes each child take twice as long. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "quarantine_size_mb=4";
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static int begun = 0;
    if (!begun)
    {
        EXPECT(mkdtemp(folder) != NULL, "no folder");
        EXPECT(atexit(remove_folder) == 0, "no end");
        begun = 1;
    }
    char name[100], message[CM_IMAGE_MESSAGE] = "";
    name_file(name, size > 0 ? data[0] % 3 : 0);
    FILE *file = fopen(name, "wb");
    EXPECT(file != NULL, "no file");
    EXPECT(size < 2 || fwrite(data + 1, 1, size - 1, file) == size - 1, "no room");
    EXPECT(fclose(file) == 0, "no room");
    const cm_mesh_limits limits = {sizeof limits, (uint64_t)1 << 28, 2};
    cm_mesh *mesh = NULL;
    const cm_status status = cm_mesh_file_read(name, &limits, &mesh, message);
    EXPECT((status == CM_OK) == (mesh != NULL), "status %d", (int)status);
    EXPECT(status == CM_OK || status == CM_ERROR_DATA, "status %d: %s", (int)status, message);
    EXPECT(status == CM_OK || (strncmp(message, name, strlen(name)) == 0 && is_one_line(message)),
           "%s", message);
    cm_mesh_destroy(mesh);
    EXPECT(cm_mesh_file_read(NULL, NULL, &mesh, message) == CM_ERROR_ARGUMENT, "NULL");
    return 0;
}
