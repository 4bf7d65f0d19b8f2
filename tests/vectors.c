/* SPDX-License-Identifier: MIT
 *
 * Every mapping against values computed with 50 digits: the files of a folder, whose heads name the
 * mapping and the frame. Lines: F p q -> u v, I u v -> p q, D x y z -> face u v, R face u v -> x y z.
 * The bound is 8 eps absolute in each coordinate, eps = 2^-53 in double, 2^-24 in float.
 */
#include "suite.h"

#include <dirent.h>

#define BOUND 8.0L
#define FIELDS 8

static const long double eps_double = 0x1p-53L;
static const long double eps_float = 0x1p-24L;

typedef struct line
{
    char kind;
    int tie;
    int exact_float; /* are all inputs floats? */
    size_t count;
    double in[FIELDS];         /* the numbers, as inputs */
    long double truth[FIELDS]; /* the numbers, as outputs */
    const char *file;
    int number;
} line;

typedef struct worst
{
    long double forward, inverse, forward_f32, inverse_f32; /* eps */
    int lines;
} worst;

static const char *folder;

static int parse_line(const char *text, line *parsed)
{
    char *end;
    parsed->kind = text[0];
    parsed->count = 0;
    parsed->tie = strstr(text, "tie") != NULL;
    for (const char *at = text + 1; parsed->count < FIELDS; at = end)
    {
        double value = strtod(at, &end);
        if (end == at)
        {
            break;
        }
        parsed->in[parsed->count] = value;
        parsed->truth[parsed->count++] = strtold(at, NULL);
    }
    size_t inputs = text[0] == 'D' || text[0] == 'R' ? 3 : 2;
    parsed->exact_float = 1;
    for (size_t i = 0; i < inputs; i++)
    {
        float rounded = (float)parsed->in[i];
        /* a subnormal float has lost relative accuracy already */
        parsed->exact_float &=
            (double)rounded == parsed->in[i] && (rounded == 0.0f || fabsf(rounded) > 1e-37f);
    }
    return parsed->count >= 4;
}

static void compare(const line *at, size_t first, size_t count, const double *got, long double eps,
                    long double *record)
{
    for (size_t i = 0; i < count; i++)
    {
        long double error = fabsl((long double)got[i] - at->truth[first + i]) / eps;
        ck_assert_msg(error <= BOUND, "%s:%d: coordinate %zu is %.17g, truth %.21Lg: %.3Lg eps",
                      at->file, at->number, i, got[i], at->truth[first + i], error);
        *record = error > *record ? error : *record;
    }
}

static void widen(const float *from, double *to, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        to[i] = (double)from[i];
    }
}

static void narrow(const double *from, float *to, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        to[i] = (float)from[i];
    }
}

static void check_warp(const cm_mapping *mapping, const line *at, worst *record)
{
    double got[2];
    float in32[2];
    float got32[2];
    int forward = at->kind == 'F';
    ck_assert_int_eq((forward ? cm_warp : cm_unwarp)(mapping, at->in, got), CM_OK);
    compare(at, 2, 2, got, eps_double, forward ? &record->forward : &record->inverse);
    if (at->exact_float)
    {
        narrow(at->in, in32, 2);
        ck_assert_int_eq((forward ? cm_warp_f32 : cm_unwarp_f32)(mapping, in32, got32), CM_OK);
        widen(got32, got, 2);
        compare(at, 2, 2, got, eps_float, forward ? &record->forward_f32 : &record->inverse_f32);
    }
}

/* A direction on an edge may be on either face; but the direction that comes back may not differ. */
static void check_forward(const cm_mapping *mapping, const line *at, worst *record)
{
    double got[2];
    uint8_t face = cm_forward(mapping, at->in, got);
    if (!at->tie)
    {
        ck_assert_msg(face == (int)at->in[3], "%s:%d: face %d", at->file, at->number, face);
    }
    if (face == (int)at->in[3])
    {
        compare(at, 4, 2, got, eps_double, &record->forward);
    }
    if (at->exact_float && !at->tie)
    {
        float in32[3];
        float got32[2];
        narrow(at->in, in32, 3);
        ck_assert_int_eq(cm_forward_f32(mapping, in32, got32), (int)at->in[3]);
        widen(got32, got, 2);
        compare(at, 4, 2, got, eps_float, &record->forward_f32);
    }
}

static void check_inverse(const cm_mapping *mapping, const line *at, worst *record)
{
    double got[3];
    uint8_t face = (uint8_t)at->in[0];
    cm_inverse(mapping, face, at->in + 1, got);
    compare(at, 3, 3, got, eps_double, &record->inverse);
    if (at->exact_float)
    {
        float in32[2];
        float got32[3];
        narrow(at->in + 1, in32, 2);
        cm_inverse_f32(mapping, face, in32, got32);
        widen(got32, got, 3);
        compare(at, 3, 3, got, eps_float, &record->inverse_f32);
    }
}

static void check_line(const cm_mapping *mapping, const line *at, worst *record)
{
    record->lines++;
    switch (at->kind)
    {
    case 'F':
    case 'I':
        check_warp(mapping, at, record);
        break;
    case 'D':
        check_forward(mapping, at, record);
        break;
    case 'R':
        check_inverse(mapping, at, record);
        break;
    default:
        ck_abort_msg("%s:%d: unknown kind", at->file, at->number);
    }
}

static void check_file(const char *name)
{
    char path[4096];
    char text[512];
    char specification[64] = "";
    char frame[16] = "";
    worst record = {0.0L, 0.0L, 0.0L, 0.0L, 0};
    cm_mapping *mapping = NULL;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    ck_assert_msg(file != NULL, "cannot open %s", path);
    for (int number = 1; fgets(text, sizeof text, file) != NULL; number++)
    {
        line parsed = {.file = name, .number = number};
        if (sscanf(text, "# specification %63s", specification) == 1 ||
            sscanf(text, "# frame %15s", frame) == 1 || text[0] == '#' || text[0] == '\n')
        {
            continue;
        }
        if (mapping == NULL)
        {
            ck_assert_int_eq(cm_mapping_create(specification, cm_frame_find(frame), &mapping),
                             CM_OK);
        }
        ck_assert_msg(parse_line(text, &parsed), "%s:%d: not a vector", name, number);
        check_line(mapping, &parsed, &record);
    }
    fclose(file);
    cm_mapping_destroy(mapping);
    ck_assert_int_gt(record.lines, 50);
    printf("%-18s %4d lines, worst error in eps: double %.2Lf forward %.2Lf inverse, float %.2Lf "
           "forward %.2Lf inverse\n",
           specification, record.lines, record.forward, record.inverse, record.forward_f32,
           record.inverse_f32);
}

/* which mappings of the catalogue had a file */
static int has_file(const char *identifier)
{
    DIR *directory = opendir(folder);
    ck_assert_ptr_nonnull(directory);
    int found = 0;
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;)
    {
        char path[4096];
        char text[512];
        char specification[64] = "";
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        FILE *file = strstr(entry->d_name, ".txt") != NULL ? fopen(path, "r") : NULL;
        while (file != NULL && fgets(text, sizeof text, file) != NULL && text[0] == '#')
        {
            if (sscanf(text, "# specification %63[^:\n]", specification) == 1)
            {
                found |= strcmp(specification, identifier) == 0;
            }
        }
        if (file != NULL)
        {
            fclose(file);
        }
    }
    closedir(directory);
    return found;
}

START_TEST(every_file_of_vectors)
{
    DIR *directory = opendir(folder);
    ck_assert_msg(directory != NULL, "cannot open %s", folder);
    int files = 0;
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;)
    {
        if (strstr(entry->d_name, ".txt") != NULL && strcmp(entry->d_name, "faces.txt") != 0)
        {
            check_file(entry->d_name);
            files++;
        }
    }
    closedir(directory);
    ck_assert_int_gt(files, 0);
}
END_TEST

START_TEST(every_mapping_has_vectors)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const char *identifier = cm_catalogue_at(i)->identifier;
        ck_assert_msg(has_file(identifier), "no vectors for %s", identifier);
    }
}
END_TEST

/* faces.txt: x y z -> gl: face p q -> geo: face p q [tie] */
START_TEST(gnomonic_faces_in_two_frames)
{
    char path[4096];
    char text[512];
    const char *frames[2] = {"gl", "geo"};
    cm_mapping *mapping[2];
    worst record = {0.0L, 0.0L, 0.0L, 0.0L, 0};
    snprintf(path, sizeof path, "%s/faces.txt", folder);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    for (int f = 0; f < 2; f++)
    {
        ck_assert_int_eq(cm_mapping_create("gnomonic", cm_frame_find(frames[f]), &mapping[f]),
                         CM_OK);
    }
    for (int number = 1; fgets(text, sizeof text, file) != NULL; number++)
    {
        line row = {.file = "faces.txt", .number = number};
        char *end = text;
        if (text[0] == '#' || text[0] == '\n')
        {
            continue;
        }
        double xyz[3];
        for (int i = 0; i < 3; i++)
        {
            xyz[i] = strtod(end, &end);
        }
        for (int f = 0; f < 2; f++)
        {
            int face = (int)strtol(end, &end, 10);
            double got[2];
            ck_assert_int_eq(cm_forward(mapping[f], xyz, got), face);
            row.truth[0] = strtold(end, &end);
            row.truth[1] = strtold(end, &end);
            compare(&row, 0, 2, got, eps_double, &record.forward);
        }
        record.lines++;
    }
    fclose(file);
    cm_mapping_destroy(mapping[0]);
    cm_mapping_destroy(mapping[1]);
    ck_assert_int_gt(record.lines, 50);
}
END_TEST

int main(int argc, char **argv)
{
    if (argc != 2)
    {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    folder = argv[1];
    const TTest *tests[] = {every_file_of_vectors, every_mapping_has_vectors,
                            gnomonic_faces_in_two_frames, NULL};
    return run_suite("vectors", tests);
}
