/* SPDX-License-Identifier: MIT
 *
 * Motion compensation of field-sequential pictures, on scenes whose truth is known: how far from it each method leaves the
 * channels, and what that costs. After Steiner and others 2019, table 2 and figure 6; errors are theirs (section 6.3):
 *
 *   IE    root mean square of the distance of the vectors of channels, here as a part of the uncompensated picture's
 *   SE    root mean square of the angle between them, the same
 *   SSIM  mean over channels
 *   rank  among all methods, mean over scenes and the three
 *   ms    of the processor, a frame: changing pictures, flows and compensation
 *
 *   field-sequence [--flow dis,farneback,tvl1,lk,rlof,true] [--scene N] [--frames N] [--clean] [--json FILE]
 *
 * --flow and --scene: these alone, if not all; --frames: so many are compensated of each scene, 1 if not given; --clean: no noise.
 */
#include "field_method.h"

#include "bench/harness/harness.h"

#include <cubemap/compare.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    SCENES_MOST = 8,
    METHODS_MOST = 128,
    FRAMES_MOST = 100
};

typedef struct field_score
{
    double error;      /* IE */
    double angle;      /* SE */
    double similarity; /* SSIM */
    double ms;
} field_score;

typedef struct field_run
{
    const char *flow;
    const char *json;
    long scene; /* -1: all */
    long frames;
    int is_clean;
    size_t methods;
    const field_method *method;
    field_score score[SCENES_MOST][METHODS_MOST];
    double rank[METHODS_MOST][2]; /* of phases, of wavebands */
} field_run;

typedef struct field_frames
{
    float before[FIELD_CHANNELS * FIELD_PIXELS];
    float now[FIELD_CHANNELS * FIELD_PIXELS];
    float truth[FIELD_CHANNELS * FIELD_PIXELS];
    float corrected[FIELD_CHANNELS * FIELD_PIXELS];
} field_frames;

static field_run run = {.scene = -1, .frames = 1};
static field_frames frames;

/* ---- one frame ---- */

/* Frame i begins at step i FIELD_CHANNELS. */
static void draw_frames(const field_scene *scene, int frame)
{
    for (uint32_t w = 0; w < FIELD_CHANNELS; w++)
    {
        const double begin = frame * (double)FIELD_CHANNELS;
        float *before = frames.before + w * FIELD_PIXELS, *now = frames.now + w * FIELD_PIXELS;
        draw_channel(scene, w, begin - FIELD_CHANNELS + w, before);
        draw_channel(scene, w, begin + w, now);
        draw_channel(scene, w, begin, frames.truth + w * FIELD_PIXELS);
        if (!run.is_clean)
        {
            add_noise(scene, (uint32_t)(frame * FIELD_CHANNELS) + w, now);
            add_noise(scene, (uint32_t)((frame - 1) * FIELD_CHANNELS) + w, before);
        }
    }
}

static double similarity(void)
{
    double sum = 0.0;
    for (size_t w = 0; w < FIELD_CHANNELS; w++)
    {
        float *truth = frames.truth + w * FIELD_PIXELS;
        double most = 0.0;
        for (size_t i = 0; i < FIELD_PIXELS; i++)
        {
            most = (double)truth[i] > most ? (double)truth[i] : most;
        }
        const cm_image right = {.size = sizeof right,
                                .data = truth,
                                .type = CM_PIXEL_FLOAT,
                                .width = FIELD_WIDTH,
                                .height = FIELD_HEIGHT,
                                .channels = 1};
        cm_image found = right;
        found.data = frames.corrected + w * FIELD_PIXELS;
        const cm_compare_options options = {.size = sizeof options, .peak = most, .threads = 1};
        cm_map_figures figures = {.size = sizeof figures};
        if (cm_ssim(&right, &found, &options, &figures, NULL, NULL) != CM_OK)
        {
            figures.mean = NAN;
        }
        sum += figures.mean / FIELD_CHANNELS;
    }
    return sum;
}

static void add_errors(field_score *score)
{
    double squares = 0.0, angles = 0.0;
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        double off = 0.0, product = 0.0, a = 0.0, b = 0.0;
        for (size_t w = 0; w < FIELD_CHANNELS; w++)
        {
            const double right = (double)frames.truth[w * FIELD_PIXELS + i];
            const double found = (double)frames.corrected[w * FIELD_PIXELS + i];
            off += (found - right) * (found - right);
            product += found * right;
            a += right * right;
            b += found * found;
        }
        const double cosine = a > 0.0 && b > 0.0 ? product / sqrt(a * b) : 1.0;
        const double angle = acos(cosine < 1.0 ? cosine : 1.0);
        squares += off;
        angles += angle * angle;
    }
    score->error += sqrt(squares / FIELD_PIXELS) / (double)run.frames;
    score->angle += sqrt(angles / FIELD_PIXELS) / (double)run.frames;
    score->similarity += similarity() / (double)run.frames;
}

static void measure_scene(size_t index)
{
    const field_scene *scene = field_scene_at(index);
    for (int frame = 0; frame < run.frames; frame++)
    {
        draw_frames(scene, frame);
        for (size_t m = 0; m < run.methods; m++)
        {
            char name[64];
            name_method(&run.method[m], name, sizeof name);
            progress("%s, frame %d: %s", scene->name, frame, name);
            const double begin = processor_seconds();
            run_method(&run.method[m], scene, frame * (double)FIELD_CHANNELS, frames.before,
                       frames.now, frames.corrected);
            field_score *score = &run.score[index][m];
            score->ms += 1e3 * (processor_seconds() - begin) / (double)run.frames;
            add_errors(score);
        }
    }
    progress(NULL);
}

/* ---- all scenes ---- */

static int is_measured(size_t scene)
{
    return run.scene < 0 || (size_t)run.scene == scene;
}

/* The smaller the better; of similarity its negative. */
static double measure_of(size_t scene, size_t method, int which)
{
    const field_score *score = &run.score[scene][method];
    return which == 0 ? score->error : which == 1 ? score->angle : -score->similarity;
}

/* 1 and how many are better. */
static double rank_of(size_t scene, size_t method, int which)
{
    double rank = 1.0;
    for (size_t m = 0; m < run.methods; m++)
    {
        rank += measure_of(scene, m, which) < measure_of(scene, method, which);
    }
    return rank;
}

/* The mean over scenes of phases (0) or wavebands (1) of something of each; NaN if there are none. */
static double mean_over(int bands, size_t method,
                        double (*of)(size_t scene, size_t method, int which), int which)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < field_scene_count(); i++)
    {
        if (is_measured(i) && field_scene_at(i)->is_tof != bands)
        {
            sum += of(i, method, which);
            count++;
        }
    }
    return count > 0 ? sum / (double)count : (double)NAN;
}

/* Of the uncompensated picture's. */
static double part_of(size_t scene, size_t method, int which)
{
    return measure_of(scene, method, which) / measure_of(scene, 0, which);
}

static double similarity_of(size_t scene, size_t method, int which)
{
    (void)which;
    return run.score[scene][method].similarity;
}

static double time_of(size_t method)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < field_scene_count(); i++)
    {
        sum += is_measured(i) ? run.score[i][method].ms : 0.0;
        count += (size_t)is_measured(i);
    }
    return sum / (double)count;
}

static void print_table(void)
{
    printf("%-28s %8s | %7s %7s %7s %6s | %7s %7s %7s %6s\n", "", "ms", "tof IE", "SE", "SSIM",
           "rank", "bands IE", "SE", "SSIM", "rank");
    for (size_t m = 0; m < run.methods; m++)
    {
        char name[64];
        name_method(&run.method[m], name, sizeof name);
        printf("%-28s %8.2f", name, time_of(m));
        for (int bands = 0; bands < 2; bands++)
        {
            double rank = 0.0;
            for (int which = 0; which < 3; which++)
            {
                rank += mean_over(bands, m, rank_of, which) / 3.0;
            }
            run.rank[m][bands] = rank;
            printf(" | %7.3f %7.3f %7.4f %6.1f", mean_over(bands, m, part_of, 0),
                   mean_over(bands, m, part_of, 1), mean_over(bands, m, similarity_of, 0), rank);
        }
        printf("\n");
    }
}

static void write_method(FILE *file, size_t m)
{
    char name[64];
    name_method(&run.method[m], name, sizeof name);
    const int has_flow = run.method[m].kind >= KIND_TRUTH;
    fprintf(file, "%s\n    {", m == 0 ? "" : ",");
    json_text(file, "name", name);
    json_text(file, "scheme", has_flow ? cm_compensation_name(run.method[m].scheme) : name);
    json_text(file, "change", has_flow ? field_change_name(run.method[m].change) : "");
    json_text(file, "flow", name_flow(&run.method[m]));
    json_number(file, "tof_error", mean_over(0, m, part_of, 0));
    json_number(file, "tof_rank", run.rank[m][0]);
    json_number(file, "bands_error", mean_over(1, m, part_of, 0));
    json_number(file, "bands_rank", run.rank[m][1]);
    fprintf(file, "\"ms\": %.6g}", time_of(m));
}

static int write_json(const char *name)
{
    output to;
    if (!output_open(&to, name))
    {
        return 1;
    }
    char date[DATE_SIZE];
    date_now(date);
    fprintf(to.file, "{");
    json_run(to.file, date);
    json_machine(to.file);
    fprintf(to.file,
            "\"width\": %d, \"height\": %d, \"channels\": %d, \"frames\": %ld, \"methods\": [",
            FIELD_WIDTH, FIELD_HEIGHT, FIELD_CHANNELS, run.frames);
    for (size_t m = 0; m < run.methods; m++)
    {
        write_method(to.file, m);
    }
    fprintf(to.file, "]}\n");
    return output_close(&to) ? 0 : 1;
}

/* 0 if it is no number from least to most. */
static int read_count(const char *text, long least, long most, long *count)
{
    char *end = NULL;
    *count = strtol(text, &end, 10);
    return *text != '\0' && *end == '\0' && *count >= least && *count <= most;
}

static int read_arguments(int count, char **argument)
{
    for (int i = 1; i < count; i++)
    {
        const char *value = i + 1 < count ? argument[i + 1] : NULL;
        if (strcmp(argument[i], "--clean") == 0)
        {
            run.is_clean = 1;
            continue;
        }
        int is_right = value != NULL;
        if (is_right && strcmp(argument[i], "--flow") == 0)
        {
            run.flow = value;
        }
        else if (is_right && strcmp(argument[i], "--json") == 0)
        {
            run.json = value;
        }
        else if (is_right && strcmp(argument[i], "--frames") == 0)
        {
            is_right = read_count(value, 1, FRAMES_MOST, &run.frames);
        }
        else if (is_right && strcmp(argument[i], "--scene") == 0)
        {
            is_right = read_count(value, 0, (long)field_scene_count() - 1, &run.scene);
        }
        else
        {
            is_right = 0;
        }
        if (!is_right)
        {
            return 0;
        }
        i++;
    }
    return 1;
}

int main(int count, char **argument)
{
    name_program("field-sequence");
    if (!read_arguments(count, argument))
    {
        fprintf(stderr,
                "field-sequence: usage: field-sequence [--flow METHOD] [--scene 0..%zu] "
                "[--frames 1..%d] [--clean] [--json FILE]\n",
                field_scene_count() - 1, FRAMES_MOST);
        return 2;
    }
    run.methods = field_methods(run.flow, &run.method);
    if (run.flow != NULL && run.methods == 2)
    {
        fprintf(stderr, "field-sequence: there is no flow '%s'\n", run.flow);
        return 2;
    }
    for (size_t i = 0; i < field_scene_count(); i++)
    {
        if (is_measured(i))
        {
            measure_scene(i);
        }
    }
    print_table();
    return run.json == NULL ? close_standard_output() : write_json(run.json);
}
