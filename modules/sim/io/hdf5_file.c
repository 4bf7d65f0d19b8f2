/* SPDX-License-Identifier: MIT */
#include "hdf5_file.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include <hdf5.h>

#define GROWTH ((size_t)1 << 20)

/* The library may have been built without threads: one call at a time. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static cm_status fail(cm_status status, const char *what, char *message)
{
    if (message != NULL)
    {
        snprintf(message, CM_IMAGE_MESSAGE, "%s", what);
    }
    return status;
}

/* Properties by which a file is the same whenever it is made; groups come with names. CM_ERROR_ARGUMENT: no such name, or it is
 * there; what else fails, in memory, fails for lack of it. */
static cm_status put_dataset(hid_t file, const cm_array *array)
{
    const hid_t in_memory[] = {H5T_NATIVE_UINT8, H5T_NATIVE_UINT32, H5T_NATIVE_FLOAT,
                               H5T_NATIVE_DOUBLE};
    const hid_t in_file[] = {H5T_STD_U8LE, H5T_STD_U32LE, H5T_IEEE_F32LE, H5T_IEEE_F64LE};
    hsize_t shape[CM_ARRAY_RANK];
    for (size_t i = 0; i < array->rank; i++)
    {
        shape[i] = array->shape[i];
    }
    const hid_t space = H5Screate_simple((int)array->rank, shape, NULL);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE), create = H5Pcreate(H5P_DATASET_CREATE);
    const int is_ready = space >= 0 && link >= 0 && create >= 0 &&
                         H5Pset_create_intermediate_group(link, 1) >= 0 &&
                         H5Pset_obj_track_times(create, 0) >= 0;
    const hid_t set = is_ready ? H5Dcreate2(file, array->name, in_file[array->type], space, link,
                                            create, H5P_DEFAULT)
                               : H5I_INVALID_HID;
    const int is_done = set >= 0 && H5Dwrite(set, in_memory[array->type], H5S_ALL, H5S_ALL,
                                             H5P_DEFAULT, array->data) >= 0;
    (void)(set >= 0 && H5Dclose(set));
    (void)(create >= 0 && H5Pclose(create));
    (void)(link >= 0 && H5Pclose(link));
    (void)(space >= 0 && H5Sclose(space));
    return is_done ? CM_OK : is_ready && set < 0 ? CM_ERROR_ARGUMENT : CM_ERROR_MEMORY;
}

/* A file that is in memory only. */
static hid_t make_file(void)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    hid_t file = H5I_INVALID_HID;
    if (access >= 0 && H5Pset_fapl_core(access, GROWTH, 0) >= 0)
    {
        file = H5Fcreate("cubemap", H5F_ACC_TRUNC, H5P_DEFAULT, access);
    }
    (void)(access >= 0 && H5Pclose(access));
    return file;
}

static cm_status send_file(hid_t file, const cm_image_stream *stream, char *message)
{
    const ssize_t size =
        H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(file, NULL, 0);
    if (size <= 0)
    {
        return fail(CM_ERROR_FILE, "HDF5 has made no file", message);
    }
    void *const bytes = malloc((size_t)size);
    if (bytes == NULL)
    {
        return fail(CM_ERROR_MEMORY, "more memory is needed than there is", message);
    }
    cm_status status = CM_OK;
    if (H5Fget_file_image(file, bytes, (size_t)size) != size)
    {
        status = fail(CM_ERROR_FILE, "HDF5 has made no file", message);
    }
    else if (stream->write(stream->context, bytes, (size_t)size) != (size_t)size)
    {
        status = fail(CM_ERROR_FILE, "not all bytes of a file of HDF5 could be written", message);
    }
    free(bytes);
    return status;
}

static cm_status write_arrays(const cm_image_stream *stream, const cm_array *array, size_t count,
                              char *message)
{
    const hid_t file = make_file();
    if (file < 0)
    {
        return fail(CM_ERROR_MEMORY, "HDF5 cannot begin a file in memory", message);
    }
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < count; i++)
    {
        status = put_dataset(file, &array[i]);
        if (status != CM_OK)
        {
            char text[200];
            snprintf(text, sizeof text, "HDF5 does not take the array %.100s", array[i].name);
            (void)fail(status, text, message);
        }
    }
    status = status == CM_OK ? send_file(file, stream, message) : status;
    (void)H5Fclose(file);
    return status;
}

static cm_status write_file(const cm_image_stream *stream, const cm_array *array, size_t count,
                            char *message)
{
    int is_good = stream != NULL && array != NULL && count > 0;
    for (size_t i = 0; is_good && i < count; i++)
    {
        is_good = array[i].name != NULL && cm_array_bytes(&array[i]) > 0;
    }
    if (!is_good)
    {
        return fail(CM_ERROR_ARGUMENT, cm_status_text(CM_ERROR_ARGUMENT), message);
    }
    pthread_mutex_lock(&lock);
    H5E_auto2_t told = NULL;
    void *user = NULL;
    (void)H5Eget_auto2(H5E_DEFAULT, &told, &user);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* or it writes to standard error */
    const cm_status status = write_arrays(stream, array, count, message);
    (void)H5Eset_auto2(H5E_DEFAULT, told, user);
    pthread_mutex_unlock(&lock);
    return status;
}

__attribute__((visibility("default"))) const cm_hdf5 *cm_hdf5_entry(uint32_t version)
{
    static const cm_hdf5 table = {CM_HDF5_VERSION, sizeof(cm_hdf5), write_file};
    return version == CM_HDF5_VERSION ? &table : NULL;
}
