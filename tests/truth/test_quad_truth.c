/* SPDX-License-Identifier: MIT
 *
 * The kernels in quadruple precision (quad.h), which the certificate takes for the truth, against the
 * vectors, which come from the printed formulas: to 1e-23 in each coordinate, relative to it or to 1 in
 * turn. So the formulas of the kernels are those of the papers, and not only to the precision of a
 * double.
 *
 *     quad_truth FILE...
 */
#include "truth/quad.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BOUND (quad)1e-23

enum
{
    FIELDS = 6
};

typedef struct line
{
    char kind;
    quad in[3];
    quad truth[3];
    int face; /* of D and R */
    int outputs;
} line;

/* The numbers of F and I: 2 in, 2 out; of D: 3 in, face, 2 out; of R: face, 2 in, 3 out. */
static int parse(const char *text, line *parsed)
{
    quad field[FIELDS];
    int count = 0;
    const char *at = text + 1;
    for (char *end; count < FIELDS; at = end)
    {
        field[count] = strtoflt128(at, &end);
        if (end == at)
        {
            break;
        }
        /* inputs are doubles, written with as few digits as identify them */
        int is_input = (text[0] == 'D' && count < 3) || (text[0] == 'R' && count < 3) ||
                       ((text[0] == 'F' || text[0] == 'I') && count < 2);
        field[count] = is_input ? (quad)strtod(at, NULL) : field[count];
        count++;
    }
    parsed->kind = text[0];
    int first = text[0] == 'D' ? 4 : text[0] == 'R' ? 3 : 2;
    int in = text[0] == 'R' ? 1 : 0;
    for (int k = 0; k < 3; k++)
    {
        parsed->in[k] = field[in + k < FIELDS ? in + k : 0];
        parsed->truth[k] = field[first + k < FIELDS ? first + k : 0];
    }
    parsed->face = (int)field[text[0] == 'D' ? 3 : 0];
    parsed->outputs = text[0] == 'R' ? 3 : 2;
    return strchr("FIDR", text[0]) != NULL && count == first + parsed->outputs;
}

/* In the frame of the file: what quad.h does in geo, turned by the library's own tables through the
 * face's axes. */
static void along_axes(const cm_frame *frame, int face, const quad xyz[3], quad local[3])
{
    const cm_frame_face *table = &frame->face[face];
    const int axes[3] = {table->outward, table->u, table->v};
    for (int k = 0; k < 3; k++)
    {
        quad component = xyz[abs(axes[k]) - 1];
        local[k] = axes[k] > 0 ? component : -component;
    }
}

static void from_axes(const cm_frame *frame, int face, const quad local[3], quad xyz[3])
{
    const cm_frame_face *table = &frame->face[face];
    const int axes[3] = {table->outward, table->u, table->v};
    for (int k = 0; k < 3; k++)
    {
        xyz[abs(axes[k]) - 1] = axes[k] > 0 ? local[k] : -local[k];
    }
}

/* A face's own axes are those of +x, +y, +z: the first face of geo. */
static int compute(const quad_mapping *mapping, const cm_frame *frame, const line *at, quad got[3])
{
    quad local[3];
    switch (at->kind)
    {
    case 'F':
        quad_warp(mapping, at->in, got);
        return 1;
    case 'I':
        quad_unwarp(mapping, at->in, got);
        return 1;
    case 'D':
        along_axes(frame, at->face, at->in, local);
        /* on another face by the rule of ties */
        return quad_forward(mapping, local, got) == 0;
    default:
        quad_inverse(mapping, 0, at->in, local);
        from_axes(frame, at->face, local, got);
        return 1;
    }
}

/* The face's axes do not serve for a mapping whose faces differ: that is in geo. */
static int compute_whole(const quad_mapping *mapping, const line *at, quad got[3])
{
    if (at->kind == 'D')
    {
        return quad_forward(mapping, at->in, got) == at->face;
    }
    quad_inverse(mapping, at->face, at->in, got);
    return 1;
}

typedef struct file_state
{
    cm_mapping *mapping;
    quad_mapping truth;
    const cm_frame *frame;
    int lines;
    int bad;
    quad worst;
} file_state;

static void check_line(file_state *state, const line *at, const char *name, int number)
{
    quad got[3] = {0};
    int whole = cm_mapping_describe(state->mapping)->family == CM_FAMILY_HYBRID;
    if (whole && strcmp(state->frame->identifier, "geo") != 0)
    {
        return;
    }
    if (!(whole ? compute_whole(&state->truth, at, got)
                : compute(&state->truth, state->frame, at, got)))
    {
        return;
    }
    state->lines++;
    for (int k = 0; k < at->outputs; k++)
    {
        quad size =
            fabsq(at->truth[k]) > (quad)1e-300 && at->kind != 'R' ? fabsq(at->truth[k]) : (quad)1.0;
        quad error = fabsq(got[k] - at->truth[k]) / size;
        state->worst = fmaxq(state->worst, error);
        if (!(error <= BOUND))
        {
            printf("%s:%d: coordinate %d is off by %.3g\n", name, number, k, (double)error);
            state->bad++;
        }
    }
}

/* The decimal number that a double is short for. */
static quad decimal_of(double value)
{
    char text[32];
    for (int digits = 15; digits <= 17; digits++)
    {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
        {
            break;
        }
    }
    return strtoflt128(text, NULL);
}

/* A parameter as the decimal number that it is written as: in the specification in all its digits, which may
 * be more than a double has, in a preset or the descriptor the shortest that stands for its double. */
static quad written_as(const file_state *state, const char *specification, size_t index)
{
    const cm_mapping_info *info = cm_mapping_describe(state->mapping);
    char assignment[32];
    snprintf(assignment, sizeof assignment, "%s=", info->parameter[index].name);
    const char *found = strstr(specification, assignment);
    return found != NULL ? strtoflt128(found + strlen(assignment), NULL)
                         : decimal_of(cm_mapping_parameter(state->mapping, index));
}

static void prepare(file_state *state, const char *specification)
{
    const cm_mapping_info *info = cm_mapping_describe(state->mapping);
    quad parameter[CM_PARAMETERS_MAX] = {(quad)0.0};
    state->truth = quad_from(state->mapping);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        parameter[i] = written_as(state, specification, i);
    }
    if (info->parameter_count > 0)
    {
        cm_constants_f128 k = cm_make_parameters_f128(parameter[0], parameter[1]);
        k.k2 = parameter[2];
        k.k3 = parameter[3];
        k.k4 = parameter[4];
        k.k5 = parameter[5];
        state->truth.constants = state->truth.kernels->prepare(k);
    }
}

static int check_file(const char *name)
{
    char text[512];
    char specification[64] = "";
    char frame[16] = "";
    file_state state = {0};
    FILE *file = fopen(name, "r");
    if (file == NULL)
    {
        printf("cannot open %s\n", name);
        return 1;
    }
    for (int number = 1; fgets(text, sizeof text, file) != NULL; number++)
    {
        line parsed;
        if (sscanf(text, "# specification %63s", specification) == 1 ||
            sscanf(text, "# frame %15s", frame) == 1 || text[0] == '#' || text[0] == '\n')
        {
            continue;
        }
        if (state.mapping == NULL)
        {
            state.frame = cm_frame_find(frame);
            if (cm_mapping_create(specification, state.frame, &state.mapping) != CM_OK)
            {
                break;
            }
            prepare(&state, specification);
        }
        if (!parse(text, &parsed))
        {
            printf("%s:%d: no vector\n", name, number);
            state.bad++;
            continue;
        }
        check_line(&state, &parsed, name, number);
    }
    fclose(file);
    cm_mapping_destroy(state.mapping);
    printf("%-20s %4d lines, worst %.2g\n", specification, state.lines, (double)state.worst);
    return state.bad > 0 || state.lines < (strcmp(frame, "gl") == 0 ? 0 : 100);
}

int main(int argc, char **argv)
{
    int bad = argc < 2;
    for (int i = 1; i < argc; i++)
    {
        bad |= check_file(argv[i]);
    }
    return bad;
}
