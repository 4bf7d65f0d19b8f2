/* SPDX-License-Identifier: MIT */
#include "failing_disk.h"

#include <sqlite3.h>
#include <stddef.h>
#include <stdlib.h>

static unsigned long count, fails_at;
static int all_after;
static sqlite3_vfs *true_disk;

typedef struct disk_file
{
    sqlite3_file base;
    sqlite3_file *file; /* the true one */
} disk_file;

static int fails(void)
{
    count++;
    return fails_at > 0 && (all_after ? count >= fails_at : count == fails_at);
}

static sqlite3_file *true_file(sqlite3_file *file)
{
    return ((disk_file *)file)->file;
}

static int close_file(sqlite3_file *file)
{
    const int result = true_file(file)->pMethods->xClose(true_file(file));
    free(true_file(file));
    return result;
}

static int read_bytes(sqlite3_file *file, void *to, int bytes, sqlite3_int64 at)
{
    return fails() ? SQLITE_IOERR_READ
                   : true_file(file)->pMethods->xRead(true_file(file), to, bytes, at);
}

/* What fails has written the first half. */
static int write_bytes(sqlite3_file *file, const void *from, int bytes, sqlite3_int64 at)
{
    const int is_half = fails();
    const int result =
        true_file(file)->pMethods->xWrite(true_file(file), from, is_half ? bytes / 2 : bytes, at);
    return is_half ? SQLITE_FULL : result;
}

static int truncate_file(sqlite3_file *file, sqlite3_int64 size)
{
    return fails() ? SQLITE_IOERR_TRUNCATE
                   : true_file(file)->pMethods->xTruncate(true_file(file), size);
}

static int sync_file(sqlite3_file *file, int flags)
{
    return fails() ? SQLITE_IOERR_FSYNC : true_file(file)->pMethods->xSync(true_file(file), flags);
}

static int ask_size(sqlite3_file *file, sqlite3_int64 *size)
{
    return fails() ? SQLITE_IOERR_FSTAT
                   : true_file(file)->pMethods->xFileSize(true_file(file), size);
}

static int lock_file(sqlite3_file *file, int level)
{
    return true_file(file)->pMethods->xLock(true_file(file), level);
}

static int unlock_file(sqlite3_file *file, int level)
{
    return true_file(file)->pMethods->xUnlock(true_file(file), level);
}

static int ask_lock(sqlite3_file *file, int *is_reserved)
{
    return true_file(file)->pMethods->xCheckReservedLock(true_file(file), is_reserved);
}

static int control_file(sqlite3_file *file, int what, void *with)
{
    return true_file(file)->pMethods->xFileControl(true_file(file), what, with);
}

static int ask_sector(sqlite3_file *file)
{
    return true_file(file)->pMethods->xSectorSize(true_file(file));
}

static int ask_device(sqlite3_file *file)
{
    return true_file(file)->pMethods->xDeviceCharacteristics(true_file(file));
}

static const sqlite3_io_methods methods = {
    .iVersion = 1,
    .xClose = close_file,
    .xRead = read_bytes,
    .xWrite = write_bytes,
    .xTruncate = truncate_file,
    .xSync = sync_file,
    .xFileSize = ask_size,
    .xLock = lock_file,
    .xUnlock = unlock_file,
    .xCheckReservedLock = ask_lock,
    .xFileControl = control_file,
    .xSectorSize = ask_sector,
    .xDeviceCharacteristics = ask_device,
};

static int open_file(sqlite3_vfs *disk, const char *name, sqlite3_file *file, int flags, int *got)
{
    (void)disk;
    disk_file *const made = (disk_file *)file;
    made->base.pMethods = NULL;
    made->file = fails() ? NULL : calloc(1, (size_t)true_disk->szOsFile);
    if (made->file == NULL)
    {
        return SQLITE_CANTOPEN;
    }
    const int result = true_disk->xOpen(true_disk, name, made->file, flags, got);
    if (result != SQLITE_OK)
    {
        free(made->file);
        return result;
    }
    made->base.pMethods = &methods;
    return SQLITE_OK;
}

static int delete_file(sqlite3_vfs *disk, const char *name, int sync)
{
    (void)disk;
    return fails() ? SQLITE_IOERR_DELETE : true_disk->xDelete(true_disk, name, sync);
}

static int ask_access(sqlite3_vfs *disk, const char *name, int flags, int *result)
{
    (void)disk;
    return fails() ? SQLITE_IOERR_ACCESS : true_disk->xAccess(true_disk, name, flags, result);
}

void use_failing_disk(void)
{
    static sqlite3_vfs disk;
    if (true_disk != NULL)
    {
        return;
    }
    sqlite3_initialize();
    true_disk = sqlite3_vfs_find(NULL);
    disk = *true_disk;
    disk.zName = "failing";
    disk.szOsFile = (int)sizeof(disk_file);
    disk.xOpen = open_file;
    disk.xDelete = delete_file;
    disk.xAccess = ask_access;
    sqlite3_vfs_register(&disk, 1);
}

void let_disk_fail(unsigned long at, int lasts)
{
    count = 0;
    fails_at = at;
    all_after = lasts;
}

unsigned long disk_calls(void)
{
    return count;
}
