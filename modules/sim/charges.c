/* SPDX-License-Identifier: MIT */
#include "charges.h"
#include "shot_noise.h"
#include "vector.h"

#include <cubemap/random.h>

#include <float.h>
#include <math.h>
#include <stdatomic.h>

/* Of the pixels' own offsets, which are the same in all views. */
#define OFFSET_VIEW UINT32_MAX

enum
{
    RUN = 64, /* pixels */
    RANDOM_BLOCK = 256,
    NEAR = 512,         /* pixels */
    NUMBERS_A_PHASE = 4 /* shot noise of both circuits, their reading */
};

typedef struct phase_work
{
    const tof_set *set;
    const tof_sensor *sensor;
    tof_cells cells;      /* of all of the picture */
    tof_charge_rule rule; /* of all pixels, but for their own offsets */
    size_t first_wave;    /* of the sensor's */
    const float *offset;  /* NULL: none */
    double tau;           /* of the phase image */
    float *charge_a, *charge_b;
    atomic_int *is_beyond; /* is there a charge that no float holds? */
} phase_work;

static tof_cells cells_at(const phase_work *doing, size_t cell)
{
    const tof_cells *all = &doing->cells;
    const tof_cells at = {all->total + cell, all->ambient + cell, all->real + cell,
                          all->imaginary + cell, all->stride};
    return at;
}

/* Of A and B: half of all light, and what the correlation moves from one to the other (2015, eqs. 13 and 14); the
 * surroundings' light shines all the time. */
static void put_waves(const tof_sensor *sensor, size_t first_wave, double tau,
                      tof_charge_rule *rule)
{
    const double moved = 0.5 * sensor->electrons * sensor->given.duty * sensor->given.contrast;
    for (size_t j = 0; j < rule->waves; j++)
    {
        const size_t wave = first_wave + j;
        const double shift = (double)sensor->wave_harmonic[wave] * tau;
        rule->cosine[j] = moved * (sensor->wave_amplitude[wave] * cos(shift));
        rule->sine[j] = moved * (sensor->wave_amplitude[wave] * sin(shift));
    }
}

/* No fewer than none, as the loops have it. */
static float electrons_of(double charge)
{
    return (float)(0.0 > charge ? 0.0 : charge);
}

static void find_beyond(const phase_work *doing, const float *charge, size_t n)
{
    int any = 0;
    for (size_t i = 0; i < n; i++)
    {
        any |= !(charge[i] <= FLT_MAX);
    }
    if (any)
    {
        atomic_store(doing->is_beyond, 1);
    }
}

/* Pixels of a row, whose cells are given: their own, or three between which circuits are (2015, section IV-G). */
static void put_run(const phase_work *doing, size_t first, size_t run, const double *half,
                    const double *moved)
{
    const double dark = doing->sensor->given.dark * doing->sensor->given.exposure;
    for (size_t i = 0; i < run; i++)
    {
        double a = half[i] + moved[i], b = half[i] - moved[i];
        if (doing->sensor->given.single_readout)
        {
            const size_t k = 2 * i;
            a = half[k] + moved[k] + half[k + 1] + moved[k + 1] + dark;
            b = half[k + 1] - moved[k + 1] + half[k + 2] - moved[k + 2] + dark;
        }
        doing->charge_a[first + i] = electrons_of(a);
        doing->charge_b[first + i] = electrons_of(b);
    }
}

/* Runs of pixels that have one shift: pieces of rows, or one pixel with an offset of its own. */
static void put_pixels(size_t begin, size_t end, void *user)
{
    const phase_work *doing = user;
    const tof_sensor *sensor = doing->sensor;
    const int is_single = sensor->given.single_readout;
    double half[2 * RUN + 1], moved[2 * RUN + 1];
    size_t run = 1;
    for (size_t first = begin; first < end; first += run)
    {
        const size_t row = first / sensor->width, column = first % sensor->width;
        tof_charge_rule rule = doing->rule;
        if (doing->offset == NULL)
        {
            const size_t left =
                end - first < sensor->width - column ? end - first : sensor->width - column;
            run = left < RUN ? left : RUN;
        }
        else
        {
            put_waves(sensor, doing->first_wave, doing->tau + (double)doing->offset[first], &rule);
        }
        const tof_cells cells =
            cells_at(doing, is_single ? row * sensor->cells.columns + 2 * column : first);
        doing->set->split(&rule, is_single ? 2 * run + 1 : run, &cells, half, moved);
        put_run(doing, first, run, half, moved);
    }
    find_beyond(doing, doing->charge_a + begin, end - begin);
    find_beyond(doing, doing->charge_b + begin, end - begin);
}

/* Dark charge comes with a cell where that is a pixel. */
static void put_rule(phase_work *doing, int series)
{
    const tof_sensor *sensor = doing->sensor;
    tof_charge_rule *rule = &doing->rule;
    rule->half = 0.5 * sensor->electrons * sensor->given.duty;
    rule->ambient = 0.5 * sensor->electrons;
    rule->dark = sensor->given.single_readout ? 0.0 : sensor->given.dark * sensor->given.exposure;
    while (sensor->wave_series[doing->first_wave] != series)
    {
        doing->first_wave++;
    }
    while (doing->first_wave + rule->waves < sensor->waves.count &&
           sensor->wave_series[doing->first_wave + rule->waves] == series)
    {
        rule->waves++;
    }
    put_waves(sensor, doing->first_wave, doing->tau, rule);
}

/* Phase images of the same light. */
typedef struct phases_work
{
    int count;
    phase_work image[TOF_IMAGES];
} phases_work;

/* Cells are pixels, and all have one shift. */
static void put_plain_images(size_t begin, size_t end, void *user)
{
    const phases_work *doing = user;
    const tof_cells cells = cells_at(&doing->image[0], begin);
    tof_charge_images images = {.count = doing->count};
    for (int k = 0; k < doing->count; k++)
    {
        images.rule[k] = &doing->image[k].rule;
        images.charge_a[k] = doing->image[k].charge_a;
        images.charge_b[k] = doing->image[k].charge_b;
    }
    if (doing->image[0].set->charge(&images, end - begin, &cells, begin))
    {
        atomic_store(doing->image[0].is_beyond, 1);
    }
}

/* Image after image of a few pixels, whose light stays near the processor meanwhile. */
static void put_images(size_t begin, size_t end, void *user)
{
    phases_work *doing = user;
    for (size_t first = begin; first < end; first += NEAR)
    {
        const size_t last = end - first < NEAR ? end : first + NEAR;
        for (int k = 0; k < doing->count; k++)
        {
            put_pixels(first, last, &doing->image[k]);
        }
    }
}

int charges_of_phases(const tof_set *set, const tof_sensor *sensor, const tof_picture *picture,
                      size_t picture_wave, int series, int phase, int count, const float *offset,
                      cm_pool *pool, float *charge_a, float *charge_b)
{
    const tof_sums *sum = &picture->sum;
    const size_t wave = picture_wave * picture->cells; /* the first of this series */
    const size_t pixels = (size_t)sensor->width * sensor->height;
    atomic_int is_beyond = 0;
    const int is_plain = offset == NULL && !sensor->given.single_readout;
    phases_work doing = {.count = 0};
    for (int first = 0; first < count; first += doing.count)
    {
        doing.count = count - first < TOF_IMAGES ? count - first : TOF_IMAGES;
        for (int k = 0; k < doing.count; k++)
        {
            const size_t image = (size_t)(first + k);
            const phase_work one = {.set = set,
                                    .sensor = sensor,
                                    .cells = {sum->total, sum->ambient, sum->real + wave,
                                              sum->imaginary + wave, picture->cells},
                                    .offset = offset,
                                    .tau = 2.0 * PI * (double)(phase + first + k) /
                                           (double)sensor->given.phases,
                                    .charge_a = charge_a + image * pixels,
                                    .charge_b = charge_b + image * pixels,
                                    .is_beyond = &is_beyond};
            doing.image[k] = one;
            put_rule(&doing.image[k], series);
        }
        cm_pool_run(pool, pixels, 4096, is_plain ? put_plain_images : put_images, &doing);
    }
    return atomic_load(&is_beyond);
}

/* ---- noise ---- */

typedef struct noise_work
{
    const tof_sensor *sensor;
    const cm_tof_options *options;
    uint32_t sample;
    float *charge;
} noise_work;

static void add_shot_noise(const noise_work *doing, size_t first, size_t n, double *value)
{
    const cm_tof_options *options = doing->options;
    if (options->shot == CM_TOF_FREEMAN_TUKEY)
    {
        double normal[RANDOM_BLOCK];
        cm_random_normal_array(options->seed, options->view, (uint32_t)first, doing->sample, n,
                               normal);
        shot_noise_add(&doing->sensor->given, n, normal, value);
    }
    else
    {
        cm_random_poisson_array(options->seed, options->view, (uint32_t)first, doing->sample, n,
                                value, value);
    }
}

static void add_noise(size_t begin, size_t end, void *user)
{
    const noise_work *doing = user;
    double value[RANDOM_BLOCK], reading[RANDOM_BLOCK];
    for (size_t first = begin; first < end; first += RANDOM_BLOCK)
    {
        const size_t n = end - first < RANDOM_BLOCK ? end - first : RANDOM_BLOCK;
        for (size_t i = 0; i < n; i++)
        {
            value[i] = (double)doing->charge[first + i];
        }
        add_shot_noise(doing, first, n, value);
        if (doing->sensor->given.read_noise > 0.0)
        {
            cm_random_normal_array(doing->options->seed, doing->options->view, (uint32_t)first,
                                   doing->sample + 2, n, reading);
            for (size_t i = 0; i < n; i++)
            {
                value[i] += doing->sensor->given.read_noise * reading[i];
            }
        }
        for (size_t i = 0; i < n; i++)
        {
            doing->charge[first + i] = (float)value[i];
        }
    }
}

void charges_add_noise(const tof_sensor *sensor, const cm_tof_options *options, int image,
                       cm_pool *pool, float *charge_a, float *charge_b)
{
    float *const charge[2] = {charge_a, charge_b};
    for (uint32_t circuit = 0; circuit < 2; circuit++)
    {
        noise_work doing = {sensor, options, (uint32_t)image * NUMBERS_A_PHASE + circuit,
                            charge[circuit]};
        cm_pool_run(pool, (size_t)sensor->width * sensor->height, 1024, add_noise, &doing);
    }
}

typedef struct well
{
    float full;
    float *charge;
    uint8_t *flags;
} well;

static void fill_pixels(size_t begin, size_t end, void *user)
{
    const well *doing = user;
    for (size_t i = begin; i < end; i++)
    {
        if (!(doing->charge[i] <= doing->full))
        {
            doing->charge[i] = doing->full;
            doing->flags[i] |= CM_TOF_SATURATED;
        }
    }
}

void charges_fill(const tof_sensor *sensor, cm_pool *pool, float *charge, uint8_t *flags)
{
    const double full_well = sensor->given.full_well;
    const int is_limited = full_well > 0.0 && full_well < (double)FLT_MAX;
    well doing = {is_limited ? (float)full_well : FLT_MAX, charge, flags};
    cm_pool_run(pool, (size_t)sensor->width * sensor->height, 16384, fill_pixels, &doing);
}

typedef struct offset_work
{
    double deviation;
    uint64_t seed;
    float *offset;
} offset_work;

static void put_offsets(size_t begin, size_t end, void *user)
{
    const offset_work *doing = user;
    double normal[RANDOM_BLOCK];
    for (size_t first = begin; first < end; first += RANDOM_BLOCK)
    {
        const size_t n = end - first < RANDOM_BLOCK ? end - first : RANDOM_BLOCK;
        cm_random_normal_array(doing->seed, OFFSET_VIEW, (uint32_t)first, 0, n, normal);
        for (size_t i = 0; i < n; i++)
        {
            doing->offset[first + i] = (float)(doing->deviation * normal[i]);
        }
    }
}

void charges_offsets(const tof_sensor *sensor, const cm_tof_options *options, cm_pool *pool,
                     float *offset)
{
    offset_work doing = {sensor->given.fixed_pattern, options->seed, offset};
    cm_pool_run(pool, (size_t)sensor->width * sensor->height, 1024, put_offsets, &doing);
}
