/* SPDX-License-Identifier: MIT
 *
 * That the results of an instruction set are the same to the bit on every machine and from every
 * compiler: a hash of many of them for each mapping, set, precision and tier, compared with the ones of
 * tests/bits.txt. Not for avx512, which starts from an approximation of the processor's own.
 *
 * Usage: bits FILE         compares; ends with 1 if a line differs or is missing
 *        bits --print      prints the lines of such a file, for the sets that this machine can run
 * A change of formulas changes the hashes; the file is then made anew, on x86-64 and AArch64:
 *        for the sets of one machine, bits --print | sort; lines of other sets stay.
 */
#include "truth/sphere.h"

#include <cubemap/cubemap.h>

#include <stdio.h>
#include <string.h>

enum
{
    COUNT = 20000
};

static double d[3][COUNT], uv[2][COUNT], back[3][COUNT], jacobian[6][COUNT];
static float d_f32[3][COUNT], uv_f32[2][COUNT], back_f32[3][COUNT], jacobian_f32[6][COUNT];
static uint8_t face[COUNT];

/* Directions of no particular length, by integers only, so that they are the same everywhere. */
static void fill(void)
{
    uint64_t state = 2026;
    for (int i = 0; i < COUNT; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            d_f32[k][i] = (float)((int)(next_bits(&state) >> 41) - (1 << 22)) * 0x1p-22f;
            d[k][i] = (double)((int64_t)(next_bits(&state) >> 12) - (1LL << 51)) * 0x1p-51;
        }
    }
}

/* FNV-1a, 64 bits. */
static uint64_t hash(uint64_t state, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
    {
        state = (state ^ bytes[i]) * 1099511628211u;
    }
    return state;
}

/* Processors give NaN different signs. */
static void settle(double *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        values[i] = isnan(values[i]) ? (double)NAN : values[i];
    }
}

static void settle_float(float *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        values[i] = isnan(values[i]) ? (float)NAN : values[i];
    }
}

static uint64_t hash_double(const cm_mapping *mapping)
{
    double *const to[6] = {jacobian[0], jacobian[1], jacobian[2],
                           jacobian[3], jacobian[4], jacobian[5]};
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        double *const of_warp[4] = {jacobian[0], jacobian[1], jacobian[2], jacobian[3]};
        (void)cm_warp_array(mapping, COUNT, d[0], d[1], uv[0], uv[1]);
        (void)cm_unwarp_array(mapping, COUNT, d[0], d[1], back[0], back[1]);
        settle(uv[0], 2 * (size_t)COUNT);
        settle(back[0], 2 * (size_t)COUNT);
        (void)cm_warp_jacobian_array(mapping, COUNT, d[0], d[1], of_warp);
        settle(jacobian[0], 4 * (size_t)COUNT);
        return hash(hash(hash(14695981039346656037u, uv, sizeof uv), back, 2 * sizeof back[0]),
                    jacobian, 4 * sizeof jacobian[0]);
    }
    cm_forward_array(mapping, COUNT, d[0], d[1], d[2], face, uv[0], uv[1]);
    cm_inverse_array(mapping, COUNT, face, uv[0], uv[1], back[0], back[1], back[2]);
    uint64_t state = hash(14695981039346656037u, face, sizeof face);
    settle(uv[0], 2 * (size_t)COUNT);
    settle(back[0], 3 * (size_t)COUNT);
    state = hash(hash(state, uv, sizeof uv), back, sizeof back);
    cm_forward_jacobian_array(mapping, COUNT, d[0], d[1], d[2], to);
    settle(jacobian[0], 6 * (size_t)COUNT);
    state = hash(state, jacobian, sizeof jacobian);
    cm_inverse_jacobian_array(mapping, COUNT, face, uv[0], uv[1], to);
    settle(jacobian[0], 6 * (size_t)COUNT);
    return hash(state, jacobian, sizeof jacobian);
}

static uint64_t hash_float(const cm_mapping *mapping)
{
    float *const to[6] = {jacobian_f32[0], jacobian_f32[1], jacobian_f32[2],
                          jacobian_f32[3], jacobian_f32[4], jacobian_f32[5]};
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        float *const of_warp[4] = {jacobian_f32[0], jacobian_f32[1], jacobian_f32[2],
                                   jacobian_f32[3]};
        (void)cm_warp_array_f32(mapping, COUNT, d_f32[0], d_f32[1], uv_f32[0], uv_f32[1]);
        (void)cm_unwarp_array_f32(mapping, COUNT, d_f32[0], d_f32[1], back_f32[0], back_f32[1]);
        settle_float(uv_f32[0], 2 * (size_t)COUNT);
        settle_float(back_f32[0], 2 * (size_t)COUNT);
        (void)cm_warp_jacobian_array_f32(mapping, COUNT, d_f32[0], d_f32[1], of_warp);
        settle_float(jacobian_f32[0], 4 * (size_t)COUNT);
        return hash(hash(hash(14695981039346656037u, uv_f32, sizeof uv_f32), back_f32,
                         2 * sizeof back_f32[0]),
                    jacobian_f32, 4 * sizeof jacobian_f32[0]);
    }
    cm_forward_array_f32(mapping, COUNT, d_f32[0], d_f32[1], d_f32[2], face, uv_f32[0], uv_f32[1]);
    cm_inverse_array_f32(mapping, COUNT, face, uv_f32[0], uv_f32[1], back_f32[0], back_f32[1],
                         back_f32[2]);
    uint64_t state = hash(14695981039346656037u, face, sizeof face);
    settle_float(uv_f32[0], 2 * (size_t)COUNT);
    settle_float(back_f32[0], 3 * (size_t)COUNT);
    state = hash(hash(state, uv_f32, sizeof uv_f32), back_f32, sizeof back_f32);
    cm_forward_jacobian_array_f32(mapping, COUNT, d_f32[0], d_f32[1], d_f32[2], to);
    settle_float(jacobian_f32[0], 6 * (size_t)COUNT);
    state = hash(state, jacobian_f32, sizeof jacobian_f32);
    cm_inverse_jacobian_array_f32(mapping, COUNT, face, uv_f32[0], uv_f32[1], to);
    settle_float(jacobian_f32[0], 6 * (size_t)COUNT);
    return hash(state, jacobian_f32, sizeof jacobian_f32);
}

/* The line of one mapping, without an end; empty if the set has no such tier of it. 0 if it cannot be
 * made. */
static int line_of(char *line, size_t size, const char *set, const char *name, int which)
{
    static const char *const precisions[] = {"double", "float", "fast"};
    const cm_options options = {.size = sizeof options,
                                .instructions = set,
                                .tier = which == 2 ? CM_TIER_FAST : CM_TIER_EXACT};
    cm_mapping *mapping = NULL;
    if (cm_mapping_create_with(name, cm_frame_find("gl"), &options, &mapping) != CM_OK)
    {
        return 0;
    }
    line[0] = '\0';
    if (cm_mapping_tier(mapping) != options.tier)
    {
        cm_mapping_destroy(mapping);
        return 1;
    }
    uint64_t bits = which == 1 ? hash_float(mapping) : hash_double(mapping);
    cm_mapping_destroy(mapping);
    snprintf(line, size, "%s %s %s %016llx", set, name, precisions[which],
             (unsigned long long)bits);
    return 1;
}

static int is_in(const char *text, const char *line)
{
    size_t length = strlen(line);
    for (const char *at = strstr(text, line); at != NULL; at = strstr(at + 1, line))
    {
        if ((at == text || at[-1] == '\n') && at[length] == '\n')
        {
            return 1;
        }
    }
    return 0;
}

static int is_big_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 0;
}

int main(int argc, char **argv)
{
    static char text[1 << 20];
    if (is_big_endian())
    {
        printf("the hashes are of numbers with the lowest byte first\n");
        return 77;
    }
    int print = argc == 2 && strcmp(argv[1], "--print") == 0;
    if (argc != 2)
    {
        fprintf(stderr, "usage: bits FILE | bits --print\n");
        return 2;
    }
    FILE *file = print ? NULL : fopen(argv[1], "r");
    if (!print && (file == NULL || fread(text, 1, sizeof text - 1, file) == 0))
    {
        perror(argv[1]);
        return 2;
    }
    fill();
    int different = 0;
    int compared = 0;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const char *set = cm_instructions_at(s);
        for (size_t i = 0; i < 3 * cm_catalogue_count() && strcmp(set, "avx512") != 0; i++)
        {
            char line[128];
            if (!line_of(line, sizeof line, set, cm_catalogue_at(i / 3)->identifier, (int)(i % 3)))
            {
                return 2;
            }
            if (line[0] == '\0')
            {
                continue;
            }
            int good = print || is_in(text, line);
            different += !good;
            compared++;
            if (print || !good)
            {
                printf("%s%s\n", print ? "" : "not in the file: ", line);
            }
        }
    }
    if (file != NULL)
    {
        fclose(file);
        printf("%d results of many points compared, %d different\n", compared, different);
    }
    return different != 0;
}
