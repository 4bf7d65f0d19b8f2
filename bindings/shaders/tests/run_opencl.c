/* SPDX-License-Identifier: MIT
 *
 * The texts for OpenCL on the first device of the first platform, by compiler options.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include "judge.h"

#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>

static const struct
{
    const char *name;
    const char *options;
    const char *head;
} variants[] = {
    {"OpenCL, correctly rounded division, no contraction", "-cl-fp32-correctly-rounded-divide-sqrt",
     "#pragma OPENCL FP_CONTRACT OFF\n"},
    {"OpenCL, no options", "", ""},
    {"OpenCL, -cl-mad-enable", "-cl-mad-enable", ""},
    {"OpenCL, -cl-fast-relaxed-math", "-cl-fast-relaxed-math", ""},
};
enum
{
    VARIANTS = sizeof variants / sizeof variants[0]
};

static cl_device_id cl_device;
static cl_context context;
static cl_command_queue queue;
static cl_mem buffers[2];
static size_t point_count;

/* The first alone, if CUBEMAP_OPENCL_VARIANTS says how many. */
const char *device_name(int device)
{
    const char *wanted = getenv("CUBEMAP_OPENCL_VARIANTS");
    int count = wanted != NULL && atoi(wanted) < VARIANTS ? atoi(wanted) : VARIANTS;
    return device < count ? variants[device].name : NULL;
}

int device_has_all_floats(int device)
{
    return device == 0;
}

int device_open(int device, size_t count, const float *points)
{
    cl_platform_id platform;
    cl_int status = clGetPlatformIDs(1, &platform, NULL);
    if (status == CL_SUCCESS)
    {
        status = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &cl_device, NULL);
    }
    if (status != CL_SUCCESS)
    {
        fprintf(stderr, "no device of OpenCL\n");
        return 0;
    }
    context = clCreateContext(NULL, 1, &cl_device, NULL, NULL, &status);
    queue = clCreateCommandQueue(context, cl_device, 0, &status);
    buffers[0] = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                count * POINT_FLOATS * sizeof(float), (void *)points, &status);
    buffers[1] = clCreateBuffer(context, CL_MEM_WRITE_ONLY, count * RESULT_FLOATS * sizeof(float),
                                NULL, &status);
    if (device == 0)
    {
        char name[256] = "";
        clGetDeviceInfo(cl_device, CL_DEVICE_NAME, sizeof name, name, NULL);
        fprintf(stderr, "OpenCL: %s\n", name);
    }
    point_count = count;
    return status == CL_SUCCESS;
}

int device_run(int device, const char *folder, int program, float *results)
{
    char *text = read_text(folder, program, ".cl", NULL);
    const char *texts[] = {variants[device].head, text};
    cl_int status;
    cl_program built = clCreateProgramWithSource(context, 2, texts, NULL, &status);
    if (clBuildProgram(built, 1, &cl_device, variants[device].options, NULL, NULL) != CL_SUCCESS)
    {
        static char log[10000];
        clGetProgramBuildInfo(built, cl_device, CL_PROGRAM_BUILD_LOG, sizeof log, log, NULL);
        fprintf(stderr, "%s\n", log);
        return 0;
    }
    cl_kernel kernel = clCreateKernel(built, "run", &status);
    clSetKernelArg(kernel, 0, sizeof buffers[0], &buffers[0]);
    clSetKernelArg(kernel, 1, sizeof buffers[1], &buffers[1]);
    size_t local = 64;
    status = clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &point_count, &local, 0, NULL, NULL);
    if (status == CL_SUCCESS)
    {
        status = clEnqueueReadBuffer(queue, buffers[1], CL_TRUE, 0,
                                     point_count * RESULT_FLOATS * sizeof(float), results, 0, NULL,
                                     NULL);
    }
    clReleaseKernel(kernel);
    clReleaseProgram(built);
    free(text);
    return status == CL_SUCCESS;
}

void device_close(int device)
{
    (void)device;
    clReleaseMemObject(buffers[0]);
    clReleaseMemObject(buffers[1]);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
}
