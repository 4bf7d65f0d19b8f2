/* SPDX-License-Identifier: MIT
 *
 * That the results of an instruction set are the same to the bit on every machine and from every
 * compiler: a hash of many of them for each mapping, set, precision and tier, compared with the ones of
 * tests/bits.txt. Not for avx512, which starts from an approximation of the processor's own.
 *
 * Usage: bits FILE         compares; ends with 1 if a line differs or is missing, or names what is no mapping any
 *                          more; of a mapping that the file does not name at all, which is new, it only says so
 *        bits --strict FILE  the same, but new ones fail too: before a release
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

/* The words of a line are the set, the name, and more. The next line, or NULL at the end. */
static const char *name_in(const char *line, char *name)
{
    if (sscanf(line, "%*s %63s", name) != 1)
    {
        return NULL;
    }
    const char *end = strchr(line, '\n');
    return end == NULL ? line + strlen(line) : end + 1;
}

static int is_named(const char *text, const char *wanted)
{
    char name[64];
    for (const char *line = text; (line = name_in(line, name)) != NULL;)
    {
        if (strcmp(name, wanted) == 0)
        {
            return 1;
        }
    }
    return 0;
}

/* How many lines are of what the catalogue has no more. */
static int count_gone(const char *text)
{
    char name[64];
    int gone = 0;
    for (const char *line = text; (line = name_in(line, name)) != NULL;)
    {
        if (cm_catalogue_find(name) == NULL)
        {
            printf("in the file, but no mapping: %s\n", name);
            gone++;
        }
    }
    return gone;
}

/* How many mappings the file does not know. */
static int count_new(const char *text)
{
    int count = 0;
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const char *name = cm_catalogue_at(i)->identifier;
        if (!is_named(text, name))
        {
            printf("new: %s is not yet in the file\n", name);
            count++;
        }
    }
    return count;
}

static int is_big_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 0;
}

typedef struct tally
{
    int compared;
    int different;
} tally;

/* One result: printed if there is no text, else looked for in it. 0 if it cannot be made. */
static int take(const char *text, const char *set, const char *name, int which, tally *t)
{
    char line[128];
    if (!line_of(line, sizeof line, set, name, which))
    {
        return 0;
    }
    if (line[0] != '\0')
    {
        int good = text == NULL || is_in(text, line);
        t->different += !good;
        t->compared++;
        if (text == NULL || !good)
        {
            printf("%s%s\n", text == NULL ? "" : "not in the file: ", line);
        }
    }
    return 1;
}

/* All results of the sets of this machine; new mappings are in no text. 0 if one cannot be made. */
static int take_all(const char *text, tally *t)
{
    fill();
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const char *set = cm_instructions_at(s);
        for (size_t i = 0; i < 3 * cm_catalogue_count() && strcmp(set, "avx512") != 0; i++)
        {
            const char *name = cm_catalogue_at(i / 3)->identifier;
            if ((text == NULL || is_named(text, name)) && !take(text, set, name, (int)(i % 3), t))
            {
                return 0;
            }
        }
    }
    return 1;
}

static int compare_with(const char *name, int strict)
{
    static char text[1 << 20];
    tally t = {0, 0};
    FILE *file = fopen(name, "r");
    if (file == NULL || fread(text, 1, sizeof text - 1, file) == 0)
    {
        perror(name);
        return 2;
    }
    fclose(file);
    if (!take_all(text, &t))
    {
        return 2;
    }
    int fresh = count_new(text);
    int gone = count_gone(text);
    printf("%d results of many points compared, %d different, %d lines of no mapping, %d new "
           "mappings\n",
           t.compared, t.different, gone, fresh);
    return t.compared == 0 || t.different > 0 || gone > 0 || (strict && fresh > 0);
}

int main(int argc, char **argv)
{
    int strict = argc == 3 && strcmp(argv[1], "--strict") == 0;
    if (is_big_endian())
    {
        printf("the hashes are of numbers with the lowest byte first\n");
        return 77;
    }
    if (argc != 2 + strict)
    {
        fprintf(stderr, "usage: bits [--strict] FILE | bits --print\n");
        return 2;
    }
    if (strcmp(argv[1], "--print") == 0)
    {
        tally t = {0, 0};
        return take_all(NULL, &t) ? 0 : 2;
    }
    return compare_with(argv[1 + strict], strict);
}
