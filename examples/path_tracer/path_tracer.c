/* SPDX-License-Identifier: MIT
 *
 * A sky that lights spheres, by importance sampling on an equal-area cube map.
 *
 *     cc -O2 path_tracer.c -lm && ./a.out picture.ppm
 *
 * The sky is six pictures by the mapping seamless, of whose pixels each has the same solid angle. So a pixel is chosen
 * with the probability of its brightness alone: no sines, no areas, and a point that is uniform in a pixel is uniform on
 * the sphere. A shadow ray goes there. The same picture with directions that are uniform on the sphere is made beside it,
 * and what is printed is by how much its variance is greater.
 */
#include <cubemap/kernels.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    WIDTH = 360,
    HEIGHT = 240,
    SAMPLES = 32, /* paths a pixel */
    BOUNCES = 4,  /* of a path */
    FACE = 128,   /* pixels along a face of the sky */
    TEXELS = 6 * FACE * FACE
};

static const float pi = 3.14159265f;

/* ---- Vectors ---- */

typedef cm_xyz_f32 vector;

static vector make(float x, float y, float z)
{
    return (vector){x, y, z};
}

static vector plus(vector a, float by, vector b)
{
    return make(a.x + by * b.x, a.y + by * b.y, a.z + by * b.z);
}

static vector times(vector a, vector b)
{
    return make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static float dot(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector unit(vector a)
{
    return plus(make(0.0f, 0.0f, 0.0f), 1.0f / sqrtf(dot(a, a)), a);
}

static float brightness(vector color)
{
    return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
}

/* ---- Random numbers: O'Neill's PCG, in [0, 1) ---- */

static float any(uint64_t *state)
{
    uint64_t old = *state;
    *state = old * 6364136223846793005u + 1442695040888963407u;
    uint32_t mixed = (uint32_t)(((old >> 18) ^ old) >> 27);
    uint32_t turn = (uint32_t)(old >> 59);
    mixed = mixed >> turn | mixed << (-turn & 31);
    return (float)(mixed >> 8) * 0x1p-24f;
}

/* ---- The sky ---- */

typedef struct sky
{
    vector color[TEXELS];       /* radiance, face by face and row by row from v = -1 */
    float up_to[TEXELS + 1];    /* the part of all brightness that the pixels before have */
    cm_constants_f32 constants; /* of the mapping */
} sky;

/* The direction of a place on a face, in pixels. */
static vector sky_direction(const sky *of, int face, float column, float row)
{
    cm_pq_f32 pq = cm_seamless_inverse_f32(2.0f * column / FACE - 1.0f, 2.0f * row / FACE - 1.0f,
                                           of->constants);
    return cm_cube_unproject_f32((float)face, pq.p, pq.q);
}

static int sky_texel(const sky *of, vector direction)
{
    cm_face_point_f32 at = cm_cube_project_f32(direction.x, direction.y, direction.z);
    cm_uv_f32 uv = cm_seamless_forward_f32(at.a, at.b, of->constants);
    int column = (int)fminf((uv.u + 1.0f) * (FACE / 2), FACE - 1);
    int row = (int)fminf((uv.v + 1.0f) * (FACE / 2), FACE - 1);
    return ((int)at.face * FACE + row) * FACE + column;
}

/* A clear sky above a grey ground: a sun of 3 degrees, and a haze around it. */
static vector painted(vector direction)
{
    vector sun = unit(make(0.75f, -0.35f, 0.5f));
    float near = dot(direction, sun);
    if (near > cosf(1.5f * pi / 180.0f))
    {
        return make(4000.0f, 3500.0f, 2800.0f);
    }
    float up = fmaxf(direction.z, 0.0f);
    vector color = direction.z < 0.0f
                       ? make(0.16f, 0.15f, 0.14f)
                       : make(0.62f - 0.48f * up, 0.74f - 0.40f * up, 0.95f - 0.20f * up);
    return plus(color, 1.5f * powf(fmaxf(near, 0.0f), 60.0f), make(1.0f, 0.8f, 0.5f));
}

static void make_sky(sky *to)
{
    to->constants = cm_seamless_prepare_f32(cm_make_parameters_f32(0.0f, 0.0f));
    double sum = 0.0;
    for (int i = 0; i < TEXELS; i++)
    {
        to->color[i] = painted(sky_direction(to, i / (FACE * FACE), (float)(i % FACE) + 0.5f,
                                             (float)(i / FACE % FACE) + 0.5f));
        sum += (double)brightness(to->color[i]);
    }
    double before = 0.0;
    for (int i = 0; i < TEXELS; i++)
    {
        to->up_to[i] = (float)(before / sum);
        before += (double)brightness(to->color[i]);
    }
    to->up_to[TEXELS] = 1.0f;
}

/* A direction to the sky, and the probability of it for a steradian. */
typedef struct sky_sample
{
    vector direction;
    float density;
} sky_sample;

static sky_sample by_brightness(const sky *of, uint64_t *state)
{
    float wanted = any(state);
    int low = 0;
    int high = TEXELS;
    while (high - low > 1)
    {
        int middle = (low + high) / 2;
        *(of->up_to[middle] <= wanted ? &low : &high) = middle;
    }
    float column = (float)(low % FACE) + any(state);
    float row = (float)(low / FACE % FACE) + any(state);
    float part = of->up_to[low + 1] - of->up_to[low];
    return (sky_sample){sky_direction(of, low / (FACE * FACE), column, row),
                        part * TEXELS / (4.0f * pi)};
}

static sky_sample uniform(const sky *of, uint64_t *state)
{
    (void)of;
    float z = 2.0f * any(state) - 1.0f;
    float lon = 2.0f * pi * any(state);
    float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    return (sky_sample){make(side * cosf(lon), side * sinf(lon), z), 1.0f / (4.0f * pi)};
}

/* ---- The scene: spheres on a plane, z upwards ---- */

typedef struct sphere
{
    vector middle;
    float radius;
    vector color;
    int is_mirror;
} sphere;

static const sphere spheres[] = {
    {{0.0f, 0.0f, 1.0f}, 1.0f, {0.92f, 0.92f, 0.92f}, 1},
    {{-2.1f, 0.6f, 0.8f}, 0.8f, {0.75f, 0.22f, 0.15f}, 0},
    {{1.9f, 0.7f, 0.7f}, 0.7f, {0.16f, 0.38f, 0.70f}, 0},
    {{-0.8f, -1.7f, 0.45f}, 0.45f, {0.80f, 0.65f, 0.20f}, 0},
    {{1.1f, -1.6f, 0.4f}, 0.4f, {0.25f, 0.60f, 0.30f}, 0},
};

typedef struct hit
{
    float distance; /* infinite for none */
    vector point;
    vector normal;
    vector color;
    int is_mirror;
} hit;

static hit first_hit(vector from, vector along)
{
    hit best = {.distance = INFINITY};
    for (size_t i = 0; i < sizeof spheres / sizeof *spheres; i++)
    {
        vector apart = plus(from, -1.0f, spheres[i].middle);
        float half = dot(apart, along);
        float root = half * half - dot(apart, apart) + spheres[i].radius * spheres[i].radius;
        float distance = root < 0.0f ? INFINITY : -half - sqrtf(root);
        if (distance > 1e-3f && distance < best.distance)
        {
            best.distance = distance;
            best.point = plus(from, distance, along);
            best.normal = unit(plus(best.point, -1.0f, spheres[i].middle));
            best.color = spheres[i].color;
            best.is_mirror = spheres[i].is_mirror;
        }
    }
    float distance = along.z < 0.0f ? -from.z / along.z : INFINITY;
    if (distance > 1e-3f && distance < best.distance && distance < 60.0f)
    {
        best = (hit){distance, plus(from, distance, along), make(0.0f, 0.0f, 1.0f),
                     make(0.5f, 0.5f, 0.5f), 0};
        int is_dark = ((int)floorf(best.point.x) + (int)floorf(best.point.y)) & 1;
        best.color = is_dark ? make(0.30f, 0.30f, 0.32f) : make(0.6f, 0.6f, 0.58f);
    }
    return best;
}

/* A direction about a normal with the density cos / pi. */
static vector about(vector normal, uint64_t *state)
{
    float z = 2.0f * any(state) - 1.0f;
    float lon = 2.0f * pi * any(state);
    float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    return unit(plus(normal, 0.9999f, make(side * cosf(lon), side * sinf(lon), z)));
}

typedef sky_sample (*strategy)(const sky *of, uint64_t *state);

/* The sun as the eye has it, no brighter than a picture shows. */
static vector seen(vector color)
{
    return make(fminf(color.x, 10.0f), fminf(color.y, 10.0f), fminf(color.z, 10.0f));
}

/* What a path brings back. The sky itself is seen by the eye, in mirrors too; all else gets its light by shadow rays alone,
 * so that light by way of mirrors, caustics, is left out. */
static vector trace(const sky *light, strategy choose, vector from, vector along, uint64_t *state)
{
    vector sum = make(0.0f, 0.0f, 0.0f);
    vector left = make(1.0f, 1.0f, 1.0f);
    int sees_sky = 1;
    for (int bounce = 0; bounce < BOUNCES; bounce++)
    {
        hit at = first_hit(from, along);
        if (isinf(at.distance))
        {
            return sees_sky
                       ? plus(sum, 1.0f, times(left, seen(light->color[sky_texel(light, along)])))
                       : sum;
        }
        from = plus(at.point, 1e-3f, at.normal);
        left = times(left, at.color);
        sees_sky &= at.is_mirror;
        if (at.is_mirror)
        {
            along = plus(along, -2.0f * dot(along, at.normal), at.normal);
            continue;
        }
        sky_sample to = choose(light, state);
        float cosine = dot(to.direction, at.normal);
        if (cosine > 0.0f && isinf(first_hit(from, to.direction).distance))
        {
            vector there = light->color[sky_texel(light, to.direction)];
            sum = plus(sum, cosine / (pi * to.density), times(left, there));
        }
        along = about(at.normal, state);
    }
    return sum;
}

/* ---- The picture ---- */

typedef struct figures
{
    double mean;     /* of the brightness of all pixels */
    double variance; /* of one path, the mean over all pixels */
} figures;

static figures render(const sky *light, strategy choose, vector *picture)
{
    vector eye = make(0.4f, -6.5f, 2.1f);
    figures sum = {0.0, 0.0};
    for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
        uint64_t state = 0x9E3779B97F4A7C15u * (uint64_t)(i + 1);
        vector total = make(0.0f, 0.0f, 0.0f);
        double first = 0.0;
        double second = 0.0;
        for (int k = 0; k < SAMPLES; k++)
        {
            float across = ((float)(i % WIDTH) + any(&state) - WIDTH / 2) / HEIGHT;
            float up = (HEIGHT / 2 - (float)(i / WIDTH) - any(&state)) / HEIGHT;
            vector along = unit(make(across * 1.1f - 0.03f, 1.3f, up * 1.1f - 0.26f));
            vector color = trace(light, choose, eye, along, &state);
            double value = (double)fminf(brightness(color), 1e6f);
            total = plus(total, 1.0f, color);
            first += value;
            second += value * value;
        }
        picture[i] = plus(make(0.0f, 0.0f, 0.0f), 1.0f / SAMPLES, total);
        sum.mean += first / SAMPLES;
        sum.variance += (second - first * first / SAMPLES) / (SAMPLES - 1);
    }
    return (figures){sum.mean / (WIDTH * HEIGHT), sum.variance / (WIDTH * HEIGHT)};
}

static unsigned char stored(float light)
{
    float mapped = 1.0f - expf(-0.55f * light);
    return (unsigned char)(255.0f * powf(mapped, 1.0f / 2.2f) + 0.5f);
}

static int write_picture(const char *name, const vector *picture)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL)
    {
        return 0;
    }
    fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
        unsigned char bytes[3] = {stored(picture[i].x), stored(picture[i].y), stored(picture[i].z)};
        fwrite(bytes, 1, sizeof bytes, file);
    }
    int is_good = !ferror(file);
    return fclose(file) == 0 && is_good;
}

int main(int argc, char **argv)
{
    if (argc != 2)
    {
        fprintf(stderr, "usage: %s PICTURE.ppm\n", argv[0]);
        return 2;
    }
    sky *light = malloc(sizeof *light);
    vector *picture = malloc(sizeof *picture * WIDTH * HEIGHT);
    int is_good = light != NULL && picture != NULL;
    if (is_good)
    {
        make_sky(light);
        figures even = render(light, uniform, picture);
        figures chosen = render(light, by_brightness, picture);
        printf("directions     mean brightness   variance of a path\n");
        printf("uniform        %15.4f   %18.4f\n", even.mean, even.variance);
        printf("by brightness  %15.4f   %18.4f\n", chosen.mean, chosen.variance);
        printf("%.1f times less\n", even.variance / chosen.variance);
        is_good = write_picture(argv[1], picture);
    }
    if (!is_good)
    {
        fprintf(stderr, "%s: no memory, or cannot be written\n", argv[1]);
    }
    free(picture);
    free(light);
    return is_good ? 0 : 1;
}
