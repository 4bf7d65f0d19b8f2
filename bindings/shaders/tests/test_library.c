/* SPDX-License-Identifier: MIT
 *
 * test_library FOLDER: do the functions of the texts mean what the library means? The float kernels as
 * tests/programs has written them for C, against cm_forward, cm_inverse and cm_forward_jacobian of the mapping of the same specification; lookups in
 * cube maps against cm_forward in the frame gl, and their steps against differences. What rounding does is the judge's.
 */
#include "judge.h"

#include "truth/sphere.h"

#include <cubemap/cubemap.h>

#include <stdio.h>
#include <string.h>

enum
{
    COUNT = 20000
};

typedef struct findings
{
    const char *name;
    double place;  /* the angle between directions, in eps */
    double scale;  /* relative, in eps */
    double looked; /* u and v of the lookup in gl, in eps */
    double step;   /* relative */
    size_t other_faces;
    size_t steps;
} findings;

static void run(int program, const double direction[3], const double place[3], float *out)
{
    const float in[POINT_FLOATS] = {
        (float)direction[0], (float)direction[1], (float)direction[2], 0.0f,
        (float)place[0],     (float)place[1],     (float)place[2]};
    reference_programs[program](in, out);
}

static double in_eps(double difference)
{
    return fabs(difference) * 0x1p24;
}

static double scale_of(const cm_mapping *mapping, const double direction[3])
{
    double j[6];
    cm_forward_jacobian(mapping, direction, j);
    double x = j[1] * j[5] - j[2] * j[4];
    double y = j[2] * j[3] - j[0] * j[5];
    double z = j[0] * j[4] - j[1] * j[3];
    return sqrt(x * x + y * y + z * z);
}

/* The library's face, u, v of the direction, and the direction of what the text says. */
static void compare_place(const cm_mapping *mapping, const double direction[3], const float *out,
                          findings *f)
{
    double uv[2];
    uint8_t face = cm_forward(mapping, direction, uv);
    double said[2] = {(double)out[1], (double)out[2]};
    double back[3];
    cm_inverse(mapping, (uint8_t)out[0], said, back);
    f->other_faces += face != (uint8_t)out[0];
    f->place = fmax(f->place, angle_between(direction, back) * 0x1p24);
    double scale = scale_of(mapping, direction);
    f->scale = fmax(f->scale, in_eps(((double)out[3] - scale) / scale));
}

/* The way back of a place that the library gives. */
static void compare_back(const cm_mapping *mapping, int program, const double direction[3],
                         findings *f)
{
    double place[3];
    float out[RESULT_FLOATS];
    place[0] = (double)cm_forward(mapping, direction, place + 1);
    run(program, direction, place, out);
    const double back[3] = {(double)out[4], (double)out[5], (double)out[6]};
    f->place = fmax(f->place, angle_between(direction, back) * 0x1p24);
}

/* What a cube map's hardware makes of the lookup's direction is what the library says in the frame gl. */
static void compare_lookup(const cm_mapping *gl, const cm_mapping *hardware,
                           const double direction[3], const float *out, findings *f)
{
    const double looked[3] = {(double)out[8], (double)out[9], (double)out[10]};
    double uv[2];
    double st[2];
    f->other_faces += cm_forward(gl, direction, uv) != cm_forward(hardware, looked, st);
    f->looked = fmax(f->looked, fmax(in_eps(uv[0] - st[0]), in_eps(uv[1] - st[1])));
}

/* The program's step is along u, v, 0.5 of its place. */
static void compare_step(int program, const double direction[3], const float *out, findings *f)
{
    const double place[3] = {0.0, 0.4, -0.7};
    const double by[3] = {0.4, -0.7, 0.5};
    const double h = 0x1p-8;
    double ends[2][3];
    float moved[2][RESULT_FLOATS];
    for (int side = 0; side < 2; side++)
    {
        for (int k = 0; k < 3; k++)
        {
            ends[side][k] = direction[k] + (side == 0 ? -h : h) * by[k];
        }
        run(program, ends[side], place, moved[side]);
    }
    int is_corner = fabsf(out[1]) > 0.8f && fabsf(out[2]) > 0.8f; /* where conformal bends most */
    if (moved[0][0] != out[0] || moved[1][0] != out[0] || is_corner)
    {
        return;
    }
    f->steps++;
    for (int k = 0; k < 3; k++)
    {
        double slope = ((double)moved[1][8 + k] - (double)moved[0][8 + k]) / (2.0 * h);
        f->step = fmax(f->step, fabs(slope - (double)out[12 + k]));
    }
}

static int check(int program, const char *specification, const char *classes)
{
    cm_mapping *mapping = NULL;
    cm_mapping *gl = NULL;
    cm_mapping *hardware = NULL;
    if (cm_mapping_create(specification, NULL, &mapping) != CM_OK ||
        cm_mapping_create(specification, cm_frame_find("gl"), &gl) != CM_OK ||
        cm_mapping_create("gnomonic", cm_frame_find("gl"), &hardware) != CM_OK)
    {
        printf("%s: no such mapping\n", specification);
        return 0;
    }
    /* creases have two slopes */
    int has_slopes = cm_mapping_describe(mapping)->smooth_face >= CM_SMOOTH_C2;
    int has_lookup = classes[8] == 'a';
    findings f = {.name = specification};
    uint64_t state = 7;
    for (int i = 0; i < COUNT; i++)
    {
        double direction[3];
        double place[3] = {0.0, 0.4, -0.7};
        float out[RESULT_FLOATS];
        next_direction(&state, direction);
        double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                             direction[2] * direction[2]);
        for (int k = 0; k < 3; k++)
        {
            direction[k] = (double)(float)(direction[k] / length);
        }
        run(program, direction, place, out);
        compare_place(mapping, direction, out, &f);
        compare_back(mapping, program, direction, &f);
        if (has_lookup)
        {
            compare_lookup(gl, hardware, direction, out, &f);
        }
        if (has_lookup && has_slopes)
        {
            compare_step(program, direction, out, &f);
        }
    }
    cm_mapping_destroy(hardware);
    cm_mapping_destroy(gl);
    cm_mapping_destroy(mapping);
    /* 1e-6 rad is what float promises; a step of 2^-8 leaves third derivatives */
    int is_good = f.other_faces == 0 && f.place < 16.8 && f.scale < 400.0 && f.looked < 16.0 &&
                  f.step < 5e-3 && (!has_lookup || !has_slopes || f.steps > COUNT / 2);
    if (!is_good)
    {
        printf("%s: %zu other faces, %.1f eps of direction, %.1f of areal scale, %.1f of lookup, "
               "step %.2g in %zu\n",
               f.name, f.other_faces, f.place, f.scale, f.looked, f.step, f.steps);
    }
    return is_good;
}

int main(int argc, char **argv)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/list", argc == 2 ? argv[1] : "");
    FILE *file = fopen(path, "r");
    if (file == NULL)
    {
        fprintf(stderr, "usage: test_library FOLDER, FOLDER made by tests/programs\n");
        return 2;
    }
    int number;
    int good = 0;
    int bad = 0;
    char name[64];
    char classes[RESULT_FLOATS + 1];
    while (fscanf(file, "%d %63s %16s", &number, name, classes) == 3)
    {
        if (strncmp(classes, "Faar", 4) == 0 &&
            strstr(name, "legacy") == NULL) /* no inverse of its forward */
        {
            *(check(number, name, classes) ? &good : &bad) += 1;
        }
    }
    fclose(file);
    printf("%d passed, %d failed\n", good, bad);
    return bad == 0 && good > 20 ? 0 : 1;
}
