/* SPDX-License-Identifier: MIT */
#include "charges.h"

#include <cubemap/random.h>

#include <math.h>

#define PI 3.14159265358979323846

/* Of the pixels' own offsets, which are the same in all views. */
#define OFFSET_VIEW UINT32_MAX

enum
{
    RANDOM_BLOCK = 256,
    NUMBERS_A_PHASE = 4 /* shot noise of both circuits, their reading */
};

typedef struct phase_work
{
    const tof_sensor *sensor;
    const tof_picture *picture;
    double cosine[SENSOR_WAVES],
        sine[SENSOR_WAVES]; /* of the waves' shift, times half their amplitude */
    size_t first_wave;
    size_t waves;
    const float *offset;
    double tau;
    float *charge_a, *charge_b;
    const tof_set *set;
    tof_charge_rule rule;
} phase_work;

/* What a cell brings to A and B: half of all light, and what the correlation moves from one to the other (2015, eqs. 13
 * and 14); the surroundings' light shines all the time. */
typedef struct cell_charge
{
    double half;
    double moved;
} cell_charge;

static cell_charge charge_of(const phase_work *doing, size_t cell, size_t pixel)
{
    const tof_sensor *sensor = doing->sensor;
    const tof_sums *sum = &doing->picture->sum;
    const double signal = sensor->electrons * sensor->given.duty;
    cell_charge charge = {
        0.5 * (signal * sum->total[cell] + sensor->electrons * sum->ambient[cell]), 0.0};
    double moved = 0.0;
    for (size_t j = 0; j < doing->waves; j++)
    {
        const size_t k = j * doing->picture->cells + cell;
        double cosine = doing->cosine[j], sine = doing->sine[j];
        if (doing->offset != NULL)
        {
            const size_t wave = doing->first_wave + j;
            const double shift =
                (double)sensor->wave_harmonic[wave] * (doing->tau + (double)doing->offset[pixel]);
            cosine = sensor->wave_amplitude[wave] * cos(shift);
            sine = sensor->wave_amplitude[wave] * sin(shift);
        }
        moved += cosine * sum->real[k] - sine * sum->imaginary[k];
    }
    charge.moved = 0.5 * signal * sensor->given.contrast * moved;
    return charge;
}

/* No fewer than none: correlations of more than 1 would take some away. */
static float electrons_of(double charge)
{
    return (float)(charge > 0.0 ? charge : 0.0);
}

/* A cell is a pixel, and all have one shift. */
static void put_plain_pixels(size_t begin, size_t end, void *user)
{
    const phase_work *doing = user;
    const tof_sums *sum = &doing->picture->sum;
    doing->set->charge(&doing->rule, end - begin, sum->total + begin, sum->ambient + begin,
                       sum->real + begin, sum->imaginary + begin, doing->charge_a + begin,
                       doing->charge_b + begin);
}

static void put_pixels(size_t begin, size_t end, void *user)
{
    const phase_work *doing = user;
    const tof_sensor *sensor = doing->sensor;
    const double dark = sensor->given.dark * sensor->given.exposure;
    for (size_t pixel = begin; pixel < end; pixel++)
    {
        if (!sensor->given.single_readout)
        {
            const cell_charge charge = charge_of(doing, pixel, pixel);
            doing->charge_a[pixel] = electrons_of(charge.half + charge.moved + dark);
            doing->charge_b[pixel] = electrons_of(charge.half - charge.moved + dark);
            continue;
        }
        const size_t cell =
            pixel / sensor->width * sensor->cells.columns + 2 * (pixel % sensor->width);
        const cell_charge first = charge_of(doing, cell, pixel);
        const cell_charge middle = charge_of(doing, cell + 1, pixel);
        const cell_charge last = charge_of(doing, cell + 2, pixel);
        doing->charge_a[pixel] =
            electrons_of(first.half + first.moved + middle.half + middle.moved + dark);
        doing->charge_b[pixel] =
            electrons_of(middle.half - middle.moved + last.half - last.moved + dark);
    }
}

static void put_rule(phase_work *doing)
{
    const tof_sensor *sensor = doing->sensor;
    const double signal = sensor->electrons * sensor->given.duty;
    tof_charge_rule *rule = &doing->rule;
    rule->half = 0.5 * signal;
    rule->ambient = 0.5 * sensor->electrons;
    rule->dark = sensor->given.dark * sensor->given.exposure;
    rule->waves = doing->waves;
    rule->stride = doing->picture->cells;
    for (size_t j = 0; j < doing->waves; j++)
    {
        rule->cosine[j] = 0.5 * signal * sensor->given.contrast * doing->cosine[j];
        rule->sine[j] = 0.5 * signal * sensor->given.contrast * doing->sine[j];
    }
}

void charges_of_phase(const tof_set *set, const tof_sensor *sensor, const tof_picture *picture,
                      size_t picture_wave, int series, int phase, const float *offset,
                      cm_pool *pool, float *charge_a, float *charge_b)
{
    phase_work doing = {.set = set,
                        .sensor = sensor,
                        .picture = picture,
                        .offset = offset,
                        .tau = 2.0 * PI * (double)phase / (double)sensor->given.phases,
                        .charge_a = charge_a,
                        .charge_b = charge_b};
    tof_picture shifted = *picture; /* whose first wave is the first of this series */
    shifted.sum.real += picture_wave * picture->cells;
    shifted.sum.imaginary += picture_wave * picture->cells;
    while (sensor->wave_series[doing.first_wave] != series)
    {
        doing.first_wave++;
    }
    while (doing.first_wave + doing.waves < sensor->waves.count &&
           sensor->wave_series[doing.first_wave + doing.waves] == series)
    {
        const size_t wave = doing.first_wave + doing.waves;
        const double shift = (double)sensor->wave_harmonic[wave] * doing.tau;
        doing.cosine[doing.waves] = sensor->wave_amplitude[wave] * cos(shift);
        doing.sine[doing.waves] = sensor->wave_amplitude[wave] * sin(shift);
        doing.waves++;
    }
    doing.picture = &shifted;
    const int is_plain = offset == NULL && !sensor->given.single_readout;
    put_rule(&doing);
    cm_pool_run(pool, (size_t)sensor->width * sensor->height, 4096,
                is_plain ? put_plain_pixels : put_pixels, &doing);
}

/* ---- noise ---- */

typedef struct noise_work
{
    const tof_sensor *sensor;
    const cm_tof_options *options;
    uint32_t sample;
    float *charge;
} noise_work;

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
        cm_random_poisson_array(doing->options->seed, doing->options->view, (uint32_t)first,
                                doing->sample, n, value, value);
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

void charges_fill(const tof_sensor *sensor, float *charge, uint8_t *flags)
{
    const float full = (float)sensor->given.full_well;
    for (size_t i = 0; sensor->given.full_well > 0.0 && i < (size_t)sensor->width * sensor->height;
         i++)
    {
        if (charge[i] > full)
        {
            charge[i] = full;
            flags[i] |= CM_TOF_SATURATED;
        }
    }
}

void charges_offsets(const tof_sensor *sensor, const cm_tof_options *options, float *offset)
{
    for (size_t i = 0; i < (size_t)sensor->width * sensor->height; i++)
    {
        offset[i] = (float)(sensor->given.fixed_pattern *
                            cm_random_normal(options->seed, OFFSET_VIEW, (uint32_t)i, 0));
    }
}
