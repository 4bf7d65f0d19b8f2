/* SPDX-License-Identifier: MIT
 *
 * timing FOLDER NAME...: Gpoints/s of the compute shaders FOLDER/NAME.comp by OpenGL, and of FOLDER/NAME.cl by OpenCL,
 * each where it is there. Each reads a vector of four floats for a point and writes one; NAME "copy" does nothing else,
 * and so gives the bandwidth that the others are limited by. The best of five rounds.
 */
#define _POSIX_C_SOURCE 199309L
#define GL_GLEXT_PROTOTYPES
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum
{
    POINTS = 1 << 21, /* OpenGL allows 65535 groups of 64 */
    ROUNDS = 5,
    BYTES = 32 /* of a point, read and written */
};
static const double round_seconds = 0.1;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static char *text_of(const char *folder, const char *name, const char *suffix)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s%s", folder, name, suffix);
    FILE *file = fopen(path, "r");
    char *text = calloc(1, 1 << 18);
    if (file == NULL || text == NULL || fread(text, 1, (1 << 18) - 1, file) == 0)
    {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(1);
    }
    fclose(file);
    return text;
}

/* A way to run programs: open says what it runs on, build takes one, run starts it once and waits for it. */
typedef struct engine
{
    const char *name;
    const char *suffix;
    int (*open)(const float *points, char *device, size_t room);
    int (*build)(const char *text);
    void (*run)(void);
} engine;

static GLuint gl_program;

static int gl_open(const float *points, char *device, size_t room)
{
    EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    const EGLint words[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
        !eglChooseConfig(display, words, &config, 1, &count) || count == 0 ||
        !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                        eglCreateContext(display, config, EGL_NO_CONTEXT, version)))
    {
        return 0;
    }
    GLuint buffers[2];
    glGenBuffers(2, buffers);
    for (GLuint k = 0; k < 2; k++)
    {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, k, buffers[k]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, POINTS * (BYTES / 2), points, GL_STATIC_DRAW);
    }
    snprintf(device, room, "%s", (const char *)glGetString(GL_RENDERER));
    return 1;
}

static int gl_build(const char *text)
{
    GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    GLint is_good = 0;
    gl_program = glCreateProgram();
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(gl_program, shader);
    glLinkProgram(gl_program);
    glGetProgramiv(gl_program, GL_LINK_STATUS, &is_good);
    glUseProgram(gl_program);
    if (is_good)
    {
        glDispatchCompute(POINTS / 64, 1, 1);
    }
    return is_good && glGetError() == GL_NO_ERROR;
}

static void gl_run(void)
{
    glDispatchCompute(POINTS / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glFinish();
}

static cl_device_id cl_device;
static cl_context context;
static cl_command_queue queue;
static cl_kernel kernel;
static cl_mem memories[2];

static int cl_open(const float *points, char *device, size_t room)
{
    cl_platform_id platform;
    if (clGetPlatformIDs(1, &platform, NULL) != CL_SUCCESS ||
        clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &cl_device, NULL) != CL_SUCCESS)
    {
        return 0;
    }
    context = clCreateContext(NULL, 1, &cl_device, NULL, NULL, NULL);
    queue = clCreateCommandQueue(context, cl_device, 0, NULL);
    for (int k = 0; k < 2; k++)
    {
        memories[k] = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                                     POINTS * (BYTES / 2), (void *)points, NULL);
    }
    clGetDeviceInfo(cl_device, CL_DEVICE_NAME, room, device, NULL);
    return memories[1] != NULL;
}

static int cl_build(const char *text)
{
    cl_program program = clCreateProgramWithSource(context, 1, &text, NULL, NULL);
    if (clBuildProgram(program, 1, &cl_device, "", NULL, NULL) != CL_SUCCESS)
    {
        return 0;
    }
    kernel = clCreateKernel(program, "run", NULL);
    clSetKernelArg(kernel, 0, sizeof memories[0], &memories[0]);
    clSetKernelArg(kernel, 1, sizeof memories[1], &memories[1]);
    return 1;
}

static void cl_run(void)
{
    size_t count = POINTS;
    size_t local = 64;
    clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &count, &local, 0, NULL, NULL);
    clFinish(queue);
}

static double seconds_of(const engine *e)
{
    double best = INFINITY;
    e->run();
    for (int turn = 0; turn < ROUNDS; turn++)
    {
        int runs = 0;
        double begun = now();
        double taken = 0.0;
        while (taken < round_seconds)
        {
            e->run();
            runs++;
            taken = now() - begun;
        }
        best = fmin(best, taken / runs);
    }
    return best;
}

static void time_all(const engine *e, const float *points, int count, char **arguments)
{
    char device[256] = "";
    if (!e->open(points, device, sizeof device))
    {
        printf("%s: not here\n", e->name);
        return;
    }
    printf("%s on %s, %d points\n%-28s %10s %12s\n", e->name, device, POINTS, "", "Gpoints/s",
           "of the copy");
    double copy = 0.0;
    for (int k = 1; k < count; k++)
    {
        char *text = text_of(arguments[0], arguments[k], e->suffix);
        if (!e->build(text))
        {
            printf("%-28s does not run\n", arguments[k]);
            free(text);
            continue;
        }
        double rate = POINTS / seconds_of(e) * 1e-9;
        copy = k == 1 ? rate : copy;
        printf("%-28s %10.3f %10.0f %%", arguments[k], rate, 100.0 * rate / copy);
        printf(k == 1 ? "   %.1f GB/s\n" : "\n", rate * BYTES);
        fflush(stdout);
        free(text);
    }
}

int main(int argc, char **argv)
{
    static const engine engines[] = {{"OpenGL", ".comp", gl_open, gl_build, gl_run},
                                     {"OpenCL", ".cl", cl_open, cl_build, cl_run}};
    float *points = malloc((size_t)POINTS * (BYTES / 2));
    if (argc < 3 || strcmp(argv[2], "copy") != 0 || points == NULL)
    {
        fprintf(stderr, "usage: timing FOLDER copy NAME...\n");
        return 2;
    }
    /* directions, and places too: a face, u, v */
    srand(1);
    for (size_t i = 0; i < 4 * (size_t)POINTS; i++)
    {
        points[i] =
            i % 4 == 0 ? (float)(rand() % 6) : (float)rand() / (float)RAND_MAX * 2.0f - 1.0f;
    }
    for (size_t k = 0; k < sizeof engines / sizeof engines[0]; k++)
    {
        time_all(&engines[k], points, argc - 1, argv + 1);
    }
    free(points);
    return 0;
}
