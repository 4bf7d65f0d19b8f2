/* SPDX-License-Identifier: MIT
 *
 * The texts in GLSL 4.50 and GLSL ES 3.00, by EGL without a surface: as compute shaders of OpenGL 4.5, and as fragment
 * shaders of OpenGL ES 3.0 into four targets of floats.
 */
#define GL_GLEXT_PROTOTYPES
#include "judge.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    TARGETS = 4,
    WIDTH = POINTS_STEP /* of the targets of fragment shaders */
};

static EGLDisplay display;
static EGLContext context;
static size_t point_count;
static GLuint buffers[2];
static GLuint textures[1 + TARGETS];
static GLuint framebuffer;

static const char *const names[] = {"OpenGL 4.5, GLSL 4.50", "OpenGL ES 3.0, GLSL ES 3.00"};

const char *device_name(int device)
{
    return device < 2 ? names[device] : NULL;
}

int device_has_all_floats(int device)
{
    (void)device;
    return 0;
}

static int make_context(int is_es)
{
    display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    const EGLint config_words[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                   is_es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
    const EGLint es_words[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLint core_words[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL) ||
        !eglBindAPI(is_es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) ||
        !eglChooseConfig(display, config_words, &config, 1, &count) || count < 1)
    {
        return 0;
    }
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, is_es ? es_words : core_words);
    return context != EGL_NO_CONTEXT &&
           eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

static void make_buffers(const float *points)
{
    glGenBuffers(2, buffers);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)(point_count * POINT_FLOATS * sizeof(float)),
                 points, GL_STATIC_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
    glBufferData(GL_SHADER_STORAGE_BUFFER,
                 (GLsizeiptr)(point_count * RESULT_FLOATS * sizeof(float)), NULL, GL_STREAM_READ);
}

static int make_targets(const float *points)
{
    GLsizei height = (GLsizei)(point_count / WIDTH);
    GLenum attachments[TARGETS];
    glGenTextures(1 + TARGETS, textures);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    for (GLuint k = 0; k <= TARGETS; k++)
    {
        glBindTexture(GL_TEXTURE_2D, textures[k]);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, k == 0 ? 2 * WIDTH : WIDTH, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        if (k > 0)
        {
            attachments[k - 1] = GL_COLOR_ATTACHMENT0 + k - 1;
            glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[k - 1], GL_TEXTURE_2D, textures[k],
                                   0);
        }
    }
    glDrawBuffers(TARGETS, attachments);
    glBindTexture(GL_TEXTURE_2D, textures[0]);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2 * WIDTH, height, GL_RGBA, GL_FLOAT, points);
    glViewport(0, 0, WIDTH, height);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

int device_open(int device, size_t count, const float *points)
{
    if (!make_context(device == 1))
    {
        fprintf(stderr, "no context of EGL for %s\n", names[device]);
        return 0;
    }
    fprintf(stderr, "%s: %s, %s\n", names[device], (const char *)glGetString(GL_RENDERER),
            (const char *)glGetString(GL_VERSION));
    point_count = count;
    if (device == 0)
    {
        make_buffers(points);
        return 1;
    }
    return make_targets(points);
}

static int attach(GLuint program, GLenum kind, const char *text)
{
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    GLint is_good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
    if (!is_good)
    {
        char log[4000] = "";
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        fprintf(stderr, "%s\n", log);
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);
    return is_good;
}

static int compute(const char *text, float *results)
{
    GLuint program = glCreateProgram();
    GLint is_good = attach(program, GL_COMPUTE_SHADER, text);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &is_good);
    if (is_good)
    {
        glUseProgram(program);
        glDispatchCompute((GLuint)(point_count / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                           (GLsizeiptr)(point_count * RESULT_FLOATS * sizeof(float)), results);
    }
    glDeleteProgram(program);
    return is_good && glGetError() == GL_NO_ERROR;
}

static int draw(const char *text, float *results)
{
    static const char *const corners =
        "#version 300 es\n"
        "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
        "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";
    GLuint program = glCreateProgram();
    GLint is_good =
        attach(program, GL_VERTEX_SHADER, corners) && attach(program, GL_FRAGMENT_SHADER, text);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &is_good);
    float *plane = malloc(point_count * 4 * sizeof *plane);
    if (is_good && plane != NULL)
    {
        glUseProgram(program);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        for (GLenum k = 0; k < TARGETS; k++)
        {
            glReadBuffer(GL_COLOR_ATTACHMENT0 + k);
            glReadPixels(0, 0, WIDTH, (GLsizei)(point_count / WIDTH), GL_RGBA, GL_FLOAT, plane);
            for (size_t i = 0; i < point_count * 4; i++)
            {
                results[i / 4 * RESULT_FLOATS + 4 * k + i % 4] = plane[i];
            }
        }
    }
    free(plane);
    glDeleteProgram(program);
    return is_good && glGetError() == GL_NO_ERROR;
}

int device_run(int device, const char *folder, int program, float *results)
{
    char *text = read_text(folder, program, device == 0 ? ".comp" : ".frag", NULL);
    int is_good = device == 0 ? compute(text, results) : draw(text, results);
    free(text);
    return is_good;
}

void device_close(int device)
{
    (void)device;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    eglTerminate(display);
}
