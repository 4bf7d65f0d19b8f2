/* SPDX-License-Identifier: MIT
 *
 * The loops over pixels of modules/image alone: million pixels a second of each, by channels and instruction set, the
 * best of several runs on one thread. Positions walk over a picture of 4096 x 2048 as a turned view does, in
 * blocks of 16 x 16, each to the same place.
 *
 *   kernels [SET [KERNEL]]    both are compared by their beginnings
 */
#include "bench/harness/harness.h"

#include <cubemap/options.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "modules/image/sample_set.h"

enum
{
    WIDTH = 4096,
    HEIGHT = 2048,
    MARGIN = 4,
    EDGE = 1024, /* of the target */
    BLOCK = 16,
    CHANNELS_MOST = 5,
    REPETITIONS = 7
};

typedef struct positions
{
    float x[(size_t)EDGE * EDGE];
    float y[(size_t)EDGE * EDGE];
} positions;

/* Block by block, row by row in each. */
static void walk(positions *at)
{
    const double turn = 0.3;
    const double scale = 1.2;
    size_t count = 0;
    for (int block = 0; block < EDGE / BLOCK * (EDGE / BLOCK); block++)
    {
        for (int k = 0; k < BLOCK * BLOCK; k++, count++)
        {
            const double u = block % (EDGE / BLOCK) * BLOCK + k % BLOCK - EDGE / 2.0;
            const double v = block / (EDGE / BLOCK) * BLOCK + k / BLOCK - EDGE / 2.0;
            at->x[count] = (float)(WIDTH / 2.0 + scale * (u * cos(turn) - v * sin(turn)));
            at->y[count] = (float)(HEIGHT / 2.0 + scale * (u * sin(turn) + v * cos(turn)));
        }
    }
}

static double best_rate(cm_sampler *sampler, const cm_window *window, const positions *at,
                        const cm_filter_table *table, char *to)
{
    double best = 0.0;
    for (int repetition = 0; repetition < REPETITIONS; repetition++)
    {
        const double start = seconds();
        for (size_t i = 0; i < (size_t)EDGE * EDGE; i += BLOCK * BLOCK)
        {
            sampler(window, BLOCK * BLOCK, at->x + i, at->y + i, table, to);
        }
        best = fmax(best, 1e-6 * EDGE * EDGE / (seconds() - start));
    }
    return best;
}

/* Floats from 0 to 1: the time of subnormal ones is another. */
static void fill(char *data, size_t bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        const uint32_t random = (uint32_t)i * 2654435761u >> 8;
        const float value = (float)random / 16777216.0f;
        if (bytes == sizeof value)
        {
            memcpy(data + i * bytes, &value, bytes);
        }
        else
        {
            memcpy(data + i * bytes, &random, bytes);
        }
    }
}

static void time_sampler(const char *set, const char *name, cm_sampler *sampler, size_t bytes,
                         const cm_filter_table *table, const positions *at)
{
    printf("%-8s %-16s", set, name);
    for (uint32_t channels = 1; channels <= CHANNELS_MOST; channels++)
    {
        const size_t pixel = channels * bytes;
        const size_t size = (size_t)WIDTH * HEIGHT * pixel;
        char *data = allocate(size + CM_WINDOW_SLACK, 1);
        char *to = allocate(BLOCK * BLOCK, pixel);
        fill(data, bytes, size / bytes);
        const cm_window window = {data, (ptrdiff_t)(WIDTH * pixel), channels};
        printf(" %8.0f", best_rate(sampler, &window, at, table, to));
        fflush(stdout);
        free(data);
        free(to);
    }
    putchar('\n');
}

static void time_set(const cm_sample_set *set, const char *wanted, const positions *at)
{
    static cm_filter_table cubic;
    static cm_filter_table lanczos;
    cm_filter_table_fill(CM_FILTER_CATMULL_ROM, &cubic);
    cm_filter_table_fill(CM_FILTER_LANCZOS3, &lanczos);
    const struct
    {
        const char *name;
        cm_sampler *sampler;
        size_t bytes;
        const cm_filter_table *table;
    } rows[] = {
        {"nearest_u8", set->nearest_u8, 1, NULL},
        {"nearest_u16", set->nearest_u16, 2, NULL},
        {"nearest_float", set->nearest_float, 4, NULL},
        {"bilinear_u8", set->bilinear_u8, 1, NULL},
        {"bilinear_u16", set->bilinear_u16, 2, NULL},
        {"bilinear_float", set->bilinear_float, 4, NULL},
        {"taps4_u8", set->taps4_u8, 1, &cubic},
        {"taps4_float", set->taps4_float, 4, &cubic},
        {"taps6_u8", set->taps6_u8, 1, &lanczos},
        {"taps6_float", set->taps6_float, 4, &lanczos},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    {
        if (strncmp(rows[i].name, wanted, strlen(wanted)) == 0)
        {
            time_sampler(set->name, rows[i].name, rows[i].sampler, rows[i].bytes, rows[i].table,
                         at);
        }
    }
}

static void time_converters(const cm_sample_set *set)
{
    enum
    {
        COUNT = 4096,
        TIMES = 4000
    };
    static float floats[COUNT];
    static uint16_t words[COUNT];
    const struct
    {
        const char *name;
        cm_converter *converter;
        int is_to_float;
    } rows[] = {
        {"u8_to_float", set->u8_to_float, 1},     {"u16_to_float", set->u16_to_float, 1},
        {"half_to_float", set->half_to_float, 1}, {"float_to_u8", set->float_to_u8, 0},
        {"float_to_u16", set->float_to_u16, 0},   {"float_to_half", set->float_to_half, 0},
    };
    for (size_t i = 0; i < COUNT; i++)
    {
        words[i] = (uint16_t)(i * 7);
        floats[i] = (float)i / COUNT;
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    {
        const double start = seconds();
        for (int k = 0; k < TIMES; k++)
        {
            rows[i].is_to_float ? rows[i].converter(COUNT, words, 1.0f, floats)
                                : rows[i].converter(COUNT, floats, 1.0f, words);
        }
        printf("%-8s %-16s %8.0f numbers\n", set->name, rows[i].name,
               1e-6 * COUNT * TIMES / (seconds() - start));
    }
}

int main(int argc, char **argv)
{
    name_program("kernels");
    const char *wanted_set = argc > 1 ? argv[1] : "";
    const char *wanted = argc > 2 ? argv[2] : "";
    positions *at = allocate(1, sizeof *at);
    walk(at);
    printf("%-8s %-16s %8s %8s %8s %8s %8s   million pixels a second, by channels\n", "set",
           "kernel", "1", "2", "3", "4", "5");
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        const cm_sample_set *set = cm_sample_set_find(cm_instructions_at(i));
        if (set != NULL && strncmp(set->name, wanted_set, strlen(wanted_set)) == 0)
        {
            time_set(set, wanted, at);
            if (*wanted == '\0')
            {
                time_converters(set);
            }
        }
    }
    free(at);
    return 0;
}
