/* SPDX-License-Identifier: MIT
 *
 * Whole pictures through modules/image: million pixels of the target a second, and decibels against the analytic scene
 * that the source is made from. Each job makes its source afresh, and its geometry, and writes into a buffer in use.
 * Rounds go through all jobs of an instruction set in turn, and the least time of each counts.
 *
 *   resample [--rounds N] [--threads] [SET [JOB]]    both are compared by their beginnings
 *
 * cpu is of the thread's own clock, wall of everybody's. source, sampling and geometry are milliseconds of that clock:
 * what makes the source ready, what is done block by block, and of that the places alone. Coefficients of splines that are
 * large are made with the blocks: "spline kept" has them before the clock starts, which is sampling alone. --threads: two threads beside
 * two processes, by the wall, which says something on two cores that nobody else uses.
 */
#define _POSIX_C_SOURCE 200809L

#include "bench/harness/harness.h"
#include "truth/scene_errors.h"

#include <cubemap/image.h>
#include <cubemap/options.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "modules/image/geometry.h"

enum
{
    WIDTH = 4096, /* of the equirectangular picture */
    FACE = WIDTH / 4,
    SMALL = FACE / 4,
    PICTURES = 6,
    CHANNELS = 3,
    ROUNDS = 7
};

/* From what to what. */
typedef enum job_way
{
    TO_CUBE,
    FROM_CUBE,
    TO_SMALL_CUBE,
    SMALL_FROM_CUBE,
    WAYS
} job_way;

static const struct
{
    const char *name;
    const char *from;
    const char *to;
    uint32_t from_width;
    uint32_t to_width;
} ways[WAYS] = {
    {"to cube", "equirect", "cube:coupled", WIDTH, FACE},
    {"from cube", "cube:coupled", "equirect", FACE, WIDTH},
    {"to small cube", "equirect", "cube:coupled", WIDTH, SMALL},
    {"small from cube", "cube:coupled", "equirect", FACE, FACE},
};

typedef struct resample_job
{
    const char *name;
    cm_filter filter;
    cm_pixel_type type;
    job_way way;
    int is_kept; /* is the source made once, before the clock starts? */
} resample_job;

static const resample_job jobs[] = {
    {"nearest u8", CM_FILTER_NEAREST, CM_PIXEL_U8, TO_CUBE, 0},
    {"bilinear u8", CM_FILTER_BILINEAR, CM_PIXEL_U8, TO_CUBE, 0},
    {"bilinear u8", CM_FILTER_BILINEAR, CM_PIXEL_U8, FROM_CUBE, 0},
    {"bilinear u16", CM_FILTER_BILINEAR, CM_PIXEL_U16, TO_CUBE, 0},
    {"bilinear float", CM_FILTER_BILINEAR, CM_PIXEL_FLOAT, TO_CUBE, 0},
    {"catmull-rom u8", CM_FILTER_CATMULL_ROM, CM_PIXEL_U8, TO_CUBE, 0},
    {"lanczos3 u8", CM_FILTER_LANCZOS3, CM_PIXEL_U8, TO_CUBE, 0},
    {"lanczos3 u8", CM_FILTER_LANCZOS3, CM_PIXEL_U8, FROM_CUBE, 0},
    {"lanczos3 u16", CM_FILTER_LANCZOS3, CM_PIXEL_U16, TO_CUBE, 0},
    {"lanczos3 float", CM_FILTER_LANCZOS3, CM_PIXEL_FLOAT, TO_CUBE, 0},
    {"lanczos3 float", CM_FILTER_LANCZOS3, CM_PIXEL_FLOAT, FROM_CUBE, 0},
    {"spline float", CM_FILTER_BSPLINE5, CM_PIXEL_FLOAT, TO_CUBE, 0},
    {"spline float", CM_FILTER_BSPLINE5, CM_PIXEL_FLOAT, FROM_CUBE, 0},
    {"spline kept", CM_FILTER_BSPLINE5, CM_PIXEL_FLOAT, TO_CUBE, 1},
    {"spline kept", CM_FILTER_BSPLINE5, CM_PIXEL_FLOAT, FROM_CUBE, 1},
    {"ewa u8", CM_FILTER_EWA, CM_PIXEL_U8, TO_SMALL_CUBE, 0},
    {"ewa u8", CM_FILTER_EWA, CM_PIXEL_U8, SMALL_FROM_CUBE, 0},
    {"ewa float", CM_FILTER_EWA, CM_PIXEL_FLOAT, TO_SMALL_CUBE, 0},
};

enum
{
    JOBS = sizeof jobs / sizeof *jobs
};

/* The pictures of one way and one type. */
typedef struct both_pictures
{
    cm_image from[PICTURES];
    cm_image to[PICTURES];
} both_pictures;

/* What has been found of one job; seconds. */
typedef struct outcome
{
    double cpu;
    double wall;
    double source;
    double sampling;
    double geometry;
    double decibels;
    double exact; /* which part of the blocks has been placed pixel by pixel */
} outcome;

typedef struct all_jobs
{
    analytic_scene scene;
    both_pictures of[WAYS]
                    [CM_PIXEL_FLOAT + 1]; /* by cm_pixel_type; there once they are asked for */
    float *truth[WAYS][PICTURES];         /* what the targets should be */
} all_jobs;

static void check(cm_status status)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "%s: %s\n", program_name(), cm_status_text(status));
        exit(EXIT_FAILURE);
    }
}

/* The seconds that this thread has had of a processor. */
static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- pictures ---- */

static cm_surface *surface_of(const char *specification, uint32_t width, const char *instructions)
{
    cm_surface *surface;
    const cm_surface_options options = {
        .size = sizeof options, .width = width, .instructions = instructions};
    check(cm_surface_create(specification, &options, &surface));
    return surface;
}

static size_t bytes_of(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 ? 1 : type == CM_PIXEL_FLOAT ? sizeof(float) : 2;
}

/* Lines of memory, at which large pictures are stored fastest. */
static void *allocate_lines(size_t bytes)
{
    const size_t line = 64;
    void *memory = aligned_alloc(line, (bytes + line - 1) / line * line);
    if (memory == NULL)
    {
        check(CM_ERROR_MEMORY);
    }
    memset(memory, 0, bytes);
    return memory;
}

static void make_images(const cm_surface *surface, cm_pixel_type type, cm_image *images)
{
    const uint32_t width = cm_surface_width(surface);
    const uint32_t height = cm_surface_height(surface);
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        images[i] =
            (cm_image){.size = sizeof *images,
                       .data = allocate_lines((size_t)width * height * CHANNELS * bytes_of(type)),
                       .type = type,
                       .width = width,
                       .height = height,
                       .channels = CHANNELS};
    }
}

static void fill_scene(const all_jobs *all, const cm_surface *surface, scene_type type,
                       void *const *planes)
{
    const scene_size size = {cm_surface_width(surface), cm_surface_height(surface)};
    const scene_cube cube = {cm_surface_mapping(surface), cm_surface_width(surface)};
    const scene_widths widths = scene_widths_of_pixels(1.0, 1e-3);
    const scene_surface lies =
        cube.mapping == NULL ? scene_equirect(&size, widths) : scene_faces(&cube, widths);
    const scene_pictures into = {.type = type, .plane = planes};
    if (!scene_fill(&all->scene, &lies, &into))
    {
        check(CM_ERROR_MEMORY);
    }
}

static void make_truth(all_jobs *all, job_way w)
{
    cm_surface *to = surface_of(ways[w].to, ways[w].to_width, NULL);
    const size_t pixels = (size_t)cm_surface_width(to) * cm_surface_height(to);
    void *planes[PICTURES] = {0};
    for (size_t i = 0; i < cm_surface_picture_count(to); i++)
    {
        planes[i] = all->truth[w][i] = allocate(pixels, CHANNELS * sizeof(float));
    }
    fill_scene(all, to, SCENE_FLOAT, planes);
    cm_surface_destroy(to);
}

static both_pictures *pictures_for(all_jobs *all, const resample_job *job)
{
    both_pictures *made = &all->of[job->way][job->type];
    if (made->from[0].data == NULL)
    {
        cm_surface *from = surface_of(ways[job->way].from, ways[job->way].from_width, NULL);
        cm_surface *to = surface_of(ways[job->way].to, ways[job->way].to_width, NULL);
        void *planes[PICTURES] = {0};
        make_images(from, job->type, made->from);
        make_images(to, job->type, made->to);
        for (size_t i = 0; i < PICTURES; i++)
        {
            planes[i] = made->from[i].data;
        }
        fill_scene(all, from,
                   job->type == CM_PIXEL_U8    ? SCENE_U8
                   : job->type == CM_PIXEL_U16 ? SCENE_U16
                                               : SCENE_FLOAT,
                   planes);
        cm_surface_destroy(from);
        cm_surface_destroy(to);
    }
    return made;
}

static double value_at(const cm_image *image, size_t i)
{
    const unsigned char *data = image->data;
    uint16_t word;
    float number;
    switch (image->type)
    {
    case CM_PIXEL_U8:
        return data[i] / 255.0;
    case CM_PIXEL_U16:
        memcpy(&word, data + i * sizeof word, sizeof word);
        return word / 65535.0;
    default:
        memcpy(&number, data + i * sizeof number, sizeof number);
        return (double)number;
    }
}

static double decibels_of(all_jobs *all, const resample_job *job)
{
    const both_pictures *made = pictures_for(all, job);
    if (all->truth[job->way][0] == NULL)
    {
        make_truth(all, job->way);
    }
    double squares = 0.0;
    double count = 0.0;
    for (size_t p = 0; p < PICTURES && made->to[p].data != NULL; p++)
    {
        const size_t values = (size_t)made->to[p].width * made->to[p].height * CHANNELS;
        for (size_t i = 0; i < values; i++)
        {
            const double error = value_at(&made->to[p], i) - (double)all->truth[job->way][p][i];
            squares += error * error;
        }
        count += (double)values;
    }
    return -10.0 * log10(squares / count);
}

/* ---- one job ---- */

typedef struct job_desk
{
    cm_surface *from;
    cm_surface *to;
    cm_plan *plan;
    cm_source *kept; /* NULL: each round makes its own */
} job_desk;

/* What some rows ask for is there from then on. */
static void keep_source(job_desk *desk, both_pictures *of)
{
    const cm_rows some = {.row_count = 1};
    check(cm_source_create(desk->plan, of->from, of->to->type, 1, &desk->kept));
    check(cm_resample_source(desk->plan, desk->kept, of->to, some, 1));
}

static job_desk prepare(all_jobs *all, const resample_job *job, const char *set)
{
    job_desk made = {
        .from = surface_of(ways[job->way].from, ways[job->way].from_width, set),
        .to = surface_of(ways[job->way].to, ways[job->way].to_width, set),
    };
    /* footprints at the poles are long, and are not shortened by much */
    const cm_plan_options options = {
        .size = sizeof options, .filter = job->filter, .instructions = set};
    check(cm_plan_create(made.from, made.to, &options, &made.plan));
    if (job->is_kept)
    {
        keep_source(&made, pictures_for(all, job));
    }
    return made;
}

static void leave(job_desk *desk)
{
    cm_source_destroy(desk->kept);
    cm_plan_destroy(desk->plan);
    cm_surface_destroy(desk->to);
    cm_surface_destroy(desk->from);
}

static double pixels_of(const job_desk *desk)
{
    return (double)cm_surface_picture_count(desk->to) * cm_surface_width(desk->to) *
           cm_surface_height(desk->to);
}

static void keep_least(double *least, double value)
{
    *least = *least == 0.0 || value < *least ? value : *least;
}

static void resample_once(const job_desk *desk, both_pictures *of, unsigned threads, outcome *found)
{
    cm_source *source = desk->kept;
    const double wall = seconds();
    const double begin = thread_seconds();
    if (desk->kept == NULL)
    {
        check(cm_source_create(desk->plan, of->from, of->to->type, threads, &source));
    }
    const double made = thread_seconds();
    check(cm_resample_source(desk->plan, source, of->to, (cm_rows){0}, threads));
    const double done = thread_seconds();
    if (desk->kept == NULL)
    {
        cm_source_destroy(source);
    }
    keep_least(&found->cpu, thread_seconds() - begin);
    keep_least(&found->wall, seconds() - wall);
    keep_least(&found->source, made - begin);
    keep_least(&found->sampling, done - made);
}

/* The places of all blocks, as resampling asks for them. */
static void place_once(const job_desk *desk, int derivatives, outcome *found)
{
    cm_group *groups = allocate(CM_GROUPS_MAX, sizeof *groups);
    cm_geometry *geometry = cm_geometry_create(desk->plan, derivatives);
    if (geometry == NULL)
    {
        check(CM_ERROR_MEMORY);
    }
    const uint32_t columns = cm_surface_plane_width(desk->to) / CM_BLOCK_EDGE;
    const uint32_t rows = cm_surface_plane_height(desk->to) / CM_BLOCK_EDGE;
    const double begin = thread_seconds();
    for (unsigned plane = 0; plane < cm_surface_plane_count(desk->to); plane++)
    {
        for (uint32_t i = 0; i < rows * columns; i++)
        {
            cm_geometry_block(geometry, plane, i % columns, i / columns, groups);
        }
    }
    keep_least(&found->geometry, thread_seconds() - begin);
    const cm_geometry_count count = cm_geometry_counted(geometry);
    found->exact = (double)count.exact / (double)(count.exact + count.interpolated);
    cm_geometry_destroy(geometry);
    free(groups);
}

static void print_found(const char *set, const resample_job *job, const outcome *found,
                        double pixels)
{
    printf("%-8s %-14s %-15s %7.1f %7.1f %9.2f %9.2f %9.2f %7.1f %7.2f\n", set, job->name,
           ways[job->way].name, 1e-6 * pixels / found->cpu, 1e-6 * pixels / found->wall,
           1e3 * found->source, 1e3 * found->sampling, 1e3 * found->geometry, 100.0 * found->exact,
           found->decibels);
    fflush(stdout);
}

static void time_set(all_jobs *all, const char *set, const char *wanted, int rounds)
{
    outcome found[JOBS] = {0};
    job_desk desks[JOBS] = {0};
    for (int round = 0; round < rounds; round++)
    {
        for (size_t i = 0; i < JOBS; i++)
        {
            const resample_job *job = &jobs[i];
            if (strncmp(job->name, wanted, strlen(wanted)) != 0)
            {
                continue;
            }
            if (round == 0)
            {
                desks[i] = prepare(all, job, set);
            }
            progress("%s, round %d: %s", set, round + 1, job->name);
            resample_once(&desks[i], pictures_for(all, job), 1, &found[i]);
            place_once(&desks[i], job->filter == CM_FILTER_EWA, &found[i]);
            if (round == 0)
            {
                found[i].decibels = decibels_of(all, job);
            }
        }
    }
    progress(NULL);
    for (size_t i = 0; i < JOBS; i++)
    {
        if (desks[i].plan != NULL)
        {
            print_found(set, &jobs[i], &found[i], pixels_of(&desks[i]));
            leave(&desks[i]);
        }
    }
}

/* ---- what memory does ---- */

/* Copies more than caches hold, for what the jobs' figures are to be seen beside. */
static void time_memory(int rounds)
{
    const size_t bytes = (size_t)64 << 20;
    unsigned char *from = allocate(bytes, 1);
    unsigned char *to = allocate(bytes, 1);
    double least = 0.0;
    memset(from, 1, bytes);
    memset(to, 2, bytes);
    for (int round = 0; round < rounds; round++)
    {
        const double begin = thread_seconds();
        memcpy(to, from, bytes);
        keep_least(&least, thread_seconds() - begin);
    }
    printf("memcpy of %zu MiB: %.1f GB/s, of the thread's clock\n", bytes >> 20,
           1e-9 * (double)bytes / least);
    free(from);
    free(to);
}

/* ---- two threads beside two processes ---- */

/* Runs the job once, in so many processes at a time, each with its own target; the seconds until all are done. */
static double run_processes(const job_desk *desk, both_pictures *of, int processes)
{
    fflush(stdout);
    outcome found = {0};
    int gate[2];
    pid_t child[2];
    if (pipe(gate) != 0)
    {
        check(CM_ERROR_MEMORY);
    }
    for (int i = 0; i < processes; i++)
    {
        child[i] = fork();
        if (child[i] == 0)
        {
            char go;
            /* pages of the target become the child's own before the clock starts */
            resample_once(desk, of, 1, &found);
            close(gate[1]);
            const ssize_t got = read(gate[0], &go, 1);
            resample_once(desk, of, 1, &found);
            _exit(got < 0);
        }
    }
    /* closing the gate lets both run, once both have had time to come to it */
    const struct timespec pause = {.tv_sec = 1};
    nanosleep(&pause, NULL);
    const double start = seconds();
    close(gate[1]);
    close(gate[0]);
    for (int i = 0; i < processes; i++)
    {
        waitpid(child[i], NULL, 0);
    }
    return seconds() - start;
}

static void time_threads(all_jobs *all, const char *set, const char *wanted, int rounds)
{
    printf("%-8s %-14s %-15s %12s %12s %12s\n", "set", "job", "way", "one thread", "two threads",
           "2 processes");
    for (size_t i = 0; i < JOBS; i++)
    {
        if (strncmp(jobs[i].name, wanted, strlen(wanted)) != 0)
        {
            continue;
        }
        job_desk desk = prepare(all, &jobs[i], set);
        both_pictures *of = pictures_for(all, &jobs[i]);
        outcome one = {0};
        outcome two = {0};
        double processes = 0.0;
        for (int round = 0; round < rounds; round++)
        {
            resample_once(&desk, of, 1, &one);
            resample_once(&desk, of, 2, &two);
            keep_least(&processes, run_processes(&desk, of, 2));
        }
        const double pixels = 1e-6 * pixels_of(&desk);
        printf("%-8s %-14s %-15s %12.1f %12.1f %12.1f\n", set, jobs[i].name, ways[jobs[i].way].name,
               pixels / one.wall, pixels / two.wall, 2.0 * pixels / processes);
        leave(&desk);
    }
}

static void free_all(all_jobs *all)
{
    for (int w = 0; w < WAYS; w++)
    {
        for (size_t i = 0; i < PICTURES; i++)
        {
            free(all->truth[w][i]);
            for (int type = 0; type <= CM_PIXEL_FLOAT; type++)
            {
                free(all->of[w][type].from[i].data);
                free(all->of[w][type].to[i].data);
            }
        }
    }
    free(all);
}

int main(int argc, char **argv)
{
    name_program("resample");
    int rounds = ROUNDS;
    int with_threads = 0;
    int at = 1;
    for (; at < argc && strncmp(argv[at], "--", 2) == 0; at++)
    {
        if (strcmp(argv[at], "--rounds") == 0 && at + 1 < argc && atoi(argv[at + 1]) > 0)
        {
            rounds = atoi(argv[++at]);
        }
        else if (strcmp(argv[at], "--threads") == 0)
        {
            with_threads = 1;
        }
        else
        {
            fprintf(stderr, "usage: resample [--rounds N] [--threads] [SET [JOB]]\n");
            return EXIT_FAILURE;
        }
    }
    const char *wanted_set = at < argc ? argv[at] : "";
    const char *wanted = at + 1 < argc ? argv[at + 1] : "";
    all_jobs *all = allocate(1, sizeof *all);
    time_memory(rounds);
    all->scene = scene_waves(10.0 * 2.0 * 3.14159265358979323846 / WIDTH, 1);
    printf("%-8s %-14s %-15s %7s %7s %9s %9s %9s %7s %7s\n", "set", "job", "way", "cpu", "wall",
           "source", "sampling", "geometry", "exact,%", "dB");
    for (size_t i = cm_instructions_count(); i-- > 0;)
    {
        const char *set = cm_instructions_at(i);
        if (strncmp(set, wanted_set, strlen(wanted_set)) == 0 &&
            cm_instructions_check(set, NULL, 0) == CM_OK)
        {
            (with_threads ? time_threads : time_set)(all, set, wanted, rounds);
        }
    }
    free_all(all);
    return close_standard_output();
}
