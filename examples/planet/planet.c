/* SPDX-License-Identifier: MIT
 *
 * planet FACES SHADER LON LAT SIZE: draws a planet by OpenGL ES 3.0 without a window, and writes it as PPM to the standard
 * output. FACES is the name of six pictures, PPM with %d for 0 to 5; SHADER is a whole fragment shader.
 */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>

static void load_face(const char *pattern, int face)
{
    char path[1000];
    snprintf(path, sizeof path, pattern, face);
    FILE *file = fopen(path, "rb");
    int width, height;
    if (file == NULL || fscanf(file, "P6 %d %d 255%*c", &width, &height) != 2)
        exit(1);
    unsigned char *pixels = malloc((size_t)width * (size_t)height * 3);
    if (fread(pixels, 3, (size_t)(width * height), file) != (size_t)(width * height))
        exit(1);
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face, 0, GL_RGB8, width, height, 0,
                 GL_RGB, GL_UNSIGNED_BYTE, pixels);
    free(pixels);
    fclose(file);
}

static void attach(GLuint program, GLenum kind, const char *text)
{
    GLuint shader = glCreateShader(kind);
    char log[2000] = "";
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    fputs(log, stderr);
    glAttachShader(program, shader);
}

int main(int argc, char **argv)
{
    static char text[200000];
    FILE *shader = argc == 6 ? fopen(argv[2], "r") : NULL;
    if (shader == NULL || fread(text, 1, sizeof text - 1, shader) == 0)
        return fputs("usage: planet FACES SHADER LON LAT SIZE\n", stderr), 2;
    GLsizei size = atoi(argv[5]);

    EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    EGLint words[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE},
           count;
    EGLConfig config;
    eglInitialize(display, NULL, NULL);
    eglBindAPI(EGL_OPENGL_ES_API);
    eglChooseConfig(display, words, &config, 1, &count);
    EGLContext context =
        eglCreateContext(display, config, NULL, (EGLint[]){EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE});
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return fputs("planet: no OpenGL ES 3.0\n", stderr), 1;

    GLuint names[3]; /* the ground, the picture, what draws into it */
    glGenTextures(2, names);
    glGenFramebuffers(1, names + 2);
    glBindTexture(GL_TEXTURE_2D, names[1]);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, size, size);
    glBindFramebuffer(GL_FRAMEBUFFER, names[2]);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[1], 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindTexture(GL_TEXTURE_CUBE_MAP, names[0]);
    for (int face = 0; face < 6; face++)
        load_face(argv[1], face);
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);

    GLuint program = glCreateProgram();
    attach(program, GL_VERTEX_SHADER,
           "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, "
           "gl_VertexID == 2 ? 3 : -1, 0, 1); }");
    attach(program, GL_FRAGMENT_SHADER, text);
    glLinkProgram(program);
    glUseProgram(program);
    glUniform2f(glGetUniformLocation(program, "centre"), (float)atof(argv[3]) / 57.29578f,
                (float)atof(argv[4]) / 57.29578f);
    glUniform1f(glGetUniformLocation(program, "size"), (float)size);
    glViewport(0, 0, size, size);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    unsigned char *pixels = malloc((size_t)size * (size_t)size * 4);
    glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    printf("P6\n%d %d\n255\n", size, size);
    for (int y = size - 1; y >= 0; y--)
        for (int x = 0; x < size; x++)
            fwrite(pixels + 4 * (y * size + x), 1, 3, stdout);
    return glGetError() == GL_NO_ERROR ? 0 : 1;
}
