/* SPDX-License-Identifier: MIT
 *
 * planet SHADER LON LAT SIZE: draws a planet by OpenGL ES 3.1 without a window, and writes it as PPM. SHADER is a whole
 * fragment shader; the faces come from the standard input, six square pictures, PPM, too.
 */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    static char text[200000], log[2000], pixels[4096 * 4096 * 4];
    const char *fragments = text;
    const char *corners = "#version 300 es\nvoid main() { gl_Position = vec4("
                          "ivec2(gl_VertexID & 1, gl_VertexID >> 1) * 4 - 1, 0, 1); }";
    int size = argc == 5 ? atoi(argv[4]) : 0;
    FILE *file = size > 0 && size <= 4096 ? fopen(argv[1], "r") : NULL;
    if (file == NULL || fread(text, 1, sizeof text - 1, file) == 0)
        return fputs("usage: planet SHADER LON LAT SIZE <FACES\n", stderr), 2;

    EGLDisplay egl = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
    EGLint kind[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_ALPHA_SIZE, 8, EGL_NONE}, count;
    EGLint sides[] = {EGL_WIDTH, size, EGL_HEIGHT, size, EGL_NONE};
    EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    EGLConfig config;
    eglInitialize(egl, NULL, NULL);
    eglBindAPI(EGL_OPENGL_ES_API);
    eglChooseConfig(egl, kind, &config, 1, &count);
    EGLSurface surface = eglCreatePbufferSurface(egl, config, sides);
    if (!eglMakeCurrent(egl, surface, surface, eglCreateContext(egl, config, NULL, version)))
        return fputs("planet: no OpenGL ES 3.1\n", stderr), 1;

    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (GLenum to = GL_TEXTURE_CUBE_MAP_POSITIVE_X; to <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z; to++)
    {
        size_t n;
        if (scanf("P6 ") != 0 || scanf("#%*[^\n]") != 0 || scanf("%zu %*u 255%*c", &n) != 1 ||
            n > 4096 || fread(pixels, 3 * n, n, stdin) != n)
            return fputs("planet: the standard input is not six pictures\n", stderr), 1;
        glTexImage2D(to, 0, GL_RGB8, (int)n, (int)n, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    }
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);

    GLuint pipeline, program = glCreateShaderProgramv(GL_FRAGMENT_SHADER, 1, &fragments);
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    fputs(log, stderr);
    glProgramUniform3f(program, glGetUniformLocation(program, "view"), (float)atof(argv[2]),
                       (float)atof(argv[3]), (float)size);
    glGenProgramPipelines(1, &pipeline);
    glBindProgramPipeline(pipeline);
    glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, program);
    program = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &corners);
    glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, program);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    printf("P6\n%d %d\n255\n", size, size);
    for (int y = size - 1; y >= 0; y--)
        for (int x = 0; x < size; x++)
            fwrite(pixels + 4 * (y * size + x), 1, 3, stdout);
    return glGetError() != GL_NO_ERROR;
}
