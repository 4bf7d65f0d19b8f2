/* SPDX-License-Identifier: MIT
 *
 * Levels of an environment prefiltered by GGX: the error against the mean over all pixels, and the time, by method and
 * number of samples; and how blur changes the error. Methods are settings that were published, run by this library:
 *     unfiltered  importance sampling of GGX normals (Karis 2013)
 *     hammersley  the same, filtered from a pyramid, one level blurred (Krivanek and Colbert 2008; GPU Gems 3,
 * chapter 20)
 *     spiral      this library's own
 *
 * The scene is a sky with a sun of about 2 degrees that outshines it 2000 times, a horizon, and stripes. The error is
 * the root mean square over all channels of a target of 16 x 16 pixels a face, over their mean. From roughness 0.3 on
 * the truth is the sum over all pixels, each as 2 x 2; below, 65536 samples that are not filtered.
 *
 * Usage: environments [SIZE]            a table of errors and times; SIZE: of the source's faces, 128
 *        environments --blur [SIZE]     errors by blur, at 64 samples
 *        environments --cells [SIZE]    errors and times of cells
 *        environments --levels [SIZE]   errors and times of the sum over all pixels of a coarser level
 *        environments --others [SIZE]   times of all else
 */
#include "bench/harness/harness.h"

#include <cubemap/environment.h>
#include <cubemap/frame.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHANNELS 3
#define TARGET 16
#define TARGET_COUNT ((size_t)6 * TARGET * TARGET * CHANNELS)

static const double all_roughness[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1.0};
static const cm_prefilter_method methods[] = {CM_PREFILTER_SPIRAL, CM_PREFILTER_HAMMERSLEY,
                                              CM_PREFILTER_UNFILTERED};
static const char *const method_names[] = {"spiral", "hammersley", "unfiltered"};

typedef struct faces
{
    cm_image image[6];
    float *value;
} faces;

static void fail(const char *what, cm_status status)
{
    fprintf(stderr, "%s: %s: %s\n", program_name(), what, cm_status_text(status));
    exit(1);
}

static void check(const char *what, cm_status status)
{
    if (status != CM_OK)
    {
        fail(what, status);
    }
}

static faces make_faces(uint32_t size)
{
    faces f;
    const size_t count = (size_t)size * size * CHANNELS;
    f.value = allocate(6 * count, sizeof *f.value);
    for (size_t i = 0; i < 6; i++)
    {
        f.image[i] = (cm_image){
            sizeof(cm_image), f.value + i * count, CM_PIXEL_FLOAT, size, size, CHANNELS, 0, 0};
    }
    return f;
}

static double scene(const double d[3], int channel)
{
    static const double ground[3] = {0.25, 0.2, 0.15};
    static const double blue[3] = {0.4, 0.7, 1.2};
    const double sun = 0.6 * d[0] + 0.48 * d[1] + 0.64 * d[2];
    const double above = 1.0 / (1.0 + exp(-40.0 * d[2]));
    const double stripes = 1.0 + 0.8 * sin(24.0 * atan2(d[1], d[0]));
    return above * (blue[channel] + 0.6 * (1.0 - d[2])) +
           (1.0 - above) * ground[channel] * stripes + 2000.0 * exp(3000.0 * (sun - 1.0));
}

static cm_environment *make_environment(const cm_mapping *mapping, uint32_t size, double *took)
{
    faces f = make_faces(size);
    for (size_t i = 0; i < (size_t)6 * size * size; i++)
    {
        const double down = cm_mapping_frame(mapping)->first_row_v;
        const double uv[2] = {(2.0 * (double)(i % size) + 1.0) / size - 1.0,
                              down * (1.0 - (2.0 * (double)(i / size % size) + 1.0) / size)};
        double direction[3];
        cm_inverse(mapping, (uint8_t)(i / size / size), uv, direction);
        for (int c = 0; c < CHANNELS; c++)
        {
            f.value[i * CHANNELS + (size_t)c] = (float)scene(direction, c);
        }
    }
    cm_environment *environment = NULL;
    const double begin = processor_seconds();
    check("the environment", cm_environment_create(mapping, f.image, 1, &environment));
    *took = processor_seconds() - begin;
    free(f.value);
    return environment;
}

/* Against the truth, over the mean; *took is the least of some times. */
static double error_of(const cm_environment *environment, const cm_mapping *target,
                       double roughness, const cm_prefilter_options *options, const faces *truth,
                       int repetitions, double *took)
{
    faces to = make_faces(TARGET);
    *took = (double)INFINITY;
    for (int r = 0; r < repetitions; r++)
    {
        const double begin = processor_seconds();
        check("a level",
              cm_environment_prefilter(environment, roughness, options, target, to.image));
        *took = fmin(*took, processor_seconds() - begin);
    }
    double squares = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < TARGET_COUNT; i++)
    {
        const double d = (double)to.value[i] - (double)truth->value[i];
        squares += d * d;
        sum += (double)truth->value[i];
    }
    free(to.value);
    return sqrt(squares / (double)TARGET_COUNT) / (sum / (double)TARGET_COUNT);
}

static faces make_truth(const cm_environment *environment, const cm_mapping *target,
                        double roughness)
{
    faces truth = make_faces(TARGET);
    cm_prefilter_options options = {.size = sizeof options, .samples = 65536, .subdivision = 2};
    options.method = roughness < 0.3 ? CM_PREFILTER_UNFILTERED : CM_PREFILTER_ALL;
    check("the truth",
          cm_environment_prefilter(environment, roughness, &options, target, truth.image));
    return truth;
}

static void print_errors(const cm_environment *environment, const cm_mapping *target)
{
    printf("| roughness | samples | spiral, %% | hammersley, %% | unfiltered, %% | spiral, ms | "
           "hammersley, ms "
           "| unfiltered, ms |\n|---|---|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof all_roughness / sizeof *all_roughness; k++)
    {
        faces truth = make_truth(environment, target, all_roughness[k]);
        for (uint32_t samples = 8; samples <= 2048; samples *= 4)
        {
            double error[3];
            double took[3];
            for (int method = 0; method < 3; method++)
            {
                const cm_prefilter_options options = {.size = sizeof options,
                                                      .method = methods[method],
                                                      .samples = samples,
                                                      .threads = 1};
                error[method] = error_of(environment, target, all_roughness[k], &options, &truth, 3,
                                         &took[method]);
            }
            printf("| %g | %u | %.3f | %.3f | %.3f | %.2f | %.2f | %.2f |\n", all_roughness[k],
                   samples, 100.0 * error[0], 100.0 * error[1], 100.0 * error[2], 1e3 * took[0],
                   1e3 * took[1], 1e3 * took[2]);
            fflush(stdout);
        }
        free(truth.value);
    }
}

static void print_cells(const cm_environment *environment, const cm_mapping *target)
{
    static const double coarseness[] = {0.6, 0.4, 0.3, 0.2, 0.15, 0.1};
    printf("| roughness | coarseness | error, %% | ms |\n|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof all_roughness / sizeof *all_roughness; k++)
    {
        faces truth = make_truth(environment, target, all_roughness[k]);
        for (size_t i = 0; i < sizeof coarseness / sizeof *coarseness; i++)
        {
            double took;
            const cm_prefilter_options options = {.size = sizeof options,
                                                  .method = CM_PREFILTER_CELLS,
                                                  .coarseness = coarseness[i],
                                                  .threads = 1};
            const double error =
                error_of(environment, target, all_roughness[k], &options, &truth, 3, &took);
            printf("| %g | %g | %.3f | %.2f |\n", all_roughness[k], coarseness[i], 100.0 * error,
                   1e3 * took);
            fflush(stdout);
        }
        free(truth.value);
    }
}

static void print_blurs(const cm_environment *environment, const cm_mapping *target)
{
    printf("| roughness | method |");
    for (int k = -4; k <= 4; k++)
    {
        printf(" %+.2f |", 0.25 * k);
    }
    printf("\n");
    for (size_t k = 0; k < sizeof all_roughness / sizeof *all_roughness; k++)
    {
        faces truth = make_truth(environment, target, all_roughness[k]);
        for (int method = 0; method < 2; method++)
        {
            printf("| %g | %s |", all_roughness[k], method_names[method]);
            for (int b = -4; b <= 4; b++)
            {
                double took;
                const cm_prefilter_options options = {.size = sizeof options,
                                                      .method = methods[method],
                                                      .samples = 64,
                                                      .blur = 0.25 * b,
                                                      .threads = 1};
                printf(" %.3f |", 100.0 * error_of(environment, target, all_roughness[k], &options,
                                                   &truth, 1, &took));
            }
            printf("\n");
        }
        free(truth.value);
    }
}

static void print_levels(const cm_environment *environment, const cm_mapping *target)
{
    printf("| roughness | pixels along an edge | error, %% | ms |\n|---|---|---|---|\n");
    for (size_t k = 2; k < sizeof all_roughness / sizeof *all_roughness; k++)
    {
        faces truth = make_truth(environment, target, all_roughness[k]);
        for (uint32_t level = 0; level < cm_environment_level_count(environment); level++)
        {
            const uint32_t size = cm_environment_size(environment) >> level;
            if (size <= 64 && size >= 8)
            {
                double took;
                const cm_prefilter_options options = {.size = sizeof options,
                                                      .method = CM_PREFILTER_ALL,
                                                      .level = level,
                                                      .threads = 1};
                const double error =
                    error_of(environment, target, all_roughness[k], &options, &truth, 3, &took);
                printf("| %g | %u | %.3f | %.2f |\n", all_roughness[k], size, 100.0 * error,
                       1e3 * took);
            }
        }
        free(truth.value);
    }
}

static void print_others(const cm_environment *environment, const cm_mapping *target,
                         double creation)
{
    static const uint32_t degrees[] = {2, 4, 8, 32};
    const double texels = 6.0 * pow(cm_environment_size(environment), 2.0);
    double *coefficients = allocate(cm_harmonics_count(32) * CHANNELS, sizeof *coefficients);
    printf("| what | ms | ns a pixel |\n|---|---|---|\n");
    printf("| cm_environment_create | %.2f | %.1f |\n", 1e3 * creation, 1e9 * creation / texels);
    for (size_t k = 0; k < 4; k++)
    {
        const double begin = processor_seconds();
        check("the projection", cm_environment_project(environment, degrees[k], 1, coefficients));
        const double took = processor_seconds() - begin;
        printf("| cm_environment_project, degree %u | %.2f | %.1f |\n", degrees[k], 1e3 * took,
               1e9 * took / texels);
    }
    faces to = make_faces(TARGET);
    double begin = processor_seconds();
    check("irradiance", cm_environment_irradiance(environment, target, 1, to.image));
    double took = processor_seconds() - begin;
    printf("| cm_environment_irradiance, %d x %d a face | %.2f | %.1f |\n", TARGET, TARGET,
           1e3 * took, 1e9 * took / texels);
    enum
    {
        TABLE = 64
    };
    float *table = allocate((size_t)TABLE * TABLE * 2, sizeof *table);
    const cm_image image = {sizeof image, table, CM_PIXEL_FLOAT, TABLE, TABLE, 2, 0, 0};
    begin = processor_seconds();
    check("the table", cm_brdf_table(CM_BRDF_CORRELATED, 1, &image));
    took = processor_seconds() - begin;
    printf("| cm_brdf_table, %d x %d | %.2f | %.1f |\n", TABLE, TABLE, 1e3 * took,
           1e9 * took / (TABLE * TABLE));
    free(table);
    free(to.value);
    free(coefficients);
}

int main(int argc, char **argv)
{
    name_program("environments");
    const int has_word = argc > 1 && argv[1][0] == '-';
    const char *word = has_word ? argv[1] : "";
    const char *number = argc > 1 + has_word ? argv[1 + has_word] : "128";
    const long size = strtol(number, NULL, 10);
    if (argc > 2 + has_word || size < 1 || size > 2048 ||
        (has_word && strcmp(word, "--blur") != 0 && strcmp(word, "--cells") != 0 &&
         strcmp(word, "--levels") != 0 && strcmp(word, "--others") != 0))
    {
        fprintf(stderr,
                "usage: environments [--blur | --cells | --levels | --others] [SIZE, 1 to 2048]\n");
        return 2;
    }
    cm_mapping *mapping = NULL;
    cm_mapping *target = NULL;
    double creation = 0.0;
    check("the source's mapping", cm_mapping_create("coupled", cm_frame_find("gl"), &mapping));
    check("the target's mapping", cm_mapping_create("gnomonic", cm_frame_find("gl"), &target));
    cm_environment *environment = make_environment(mapping, (uint32_t)size, &creation);
    if (strcmp(word, "--blur") == 0)
    {
        print_blurs(environment, target);
    }
    else if (strcmp(word, "--cells") == 0)
    {
        print_cells(environment, target);
    }
    else if (strcmp(word, "--levels") == 0)
    {
        print_levels(environment, target);
    }
    else if (strcmp(word, "--others") == 0)
    {
        print_others(environment, target, creation);
    }
    else
    {
        print_errors(environment, target);
    }
    cm_environment_destroy(environment);
    cm_mapping_destroy(target);
    cm_mapping_destroy(mapping);
    return 0;
}
