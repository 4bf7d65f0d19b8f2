/* SPDX-License-Identifier: MIT
 *
 * Values of borders between the pixels of planes: by six points each way where there are so many, by fewer beside creases
 * and in small planes, and the plane's own last pixels where nothing is.
 */
#include "border_values.h"
#include "level_rim.h"

#include <stdint.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* Points of the polynomial of values each way. */
#define POINTS 6

static int32_t floor_of(double x)
{
    const int32_t towards_zero = (int32_t)x;
    return towards_zero - ((double)towards_zero > x);
}

static void weigh_few(double t, int32_t count, float *weight)
{
    for (int32_t i = 0; i < count; i++)
    {
        double product = 1.0;
        for (int32_t k = 0; k < count; k++)
        {
            product *= k == i ? 1.0 : (t - k) / ((double)i - k);
        }
        weight[i] = (float)product;
    }
}

/* The points one way around a position: the nearest ones that the plane has. */
typedef struct points
{
    int32_t first;
    int32_t count;
    float weight[POINTS];
} points;

/* At most so many. */
static points points_around(double position, uint32_t extent, int32_t count)
{
    points at;
    const int32_t limit = (int32_t)extent;
    const double centre = position - 0.5;
    at.count = limit < count ? limit : count;
    const int32_t first = floor_of(centre) - (at.count - 1) / 2;
    const int32_t most = limit - at.count;
    at.first = first < 0 ? 0 : first > most ? most : first;
    weigh_few(centre - at.first, at.count, at.weight);
    return at;
}

static void take_point(const cm_six_points *many, size_t i, points *at)
{
    at->first = many->first[i];
    at->count = POINTS;
    for (int k = 0; k < POINTS; k++)
    {
        at->weight[k] = many->weight[k][i];
    }
}

/* Six pixels of six rows, rows first: so many floats of each. */
static inline void mix_six(const float *from, ptrdiff_t row, const points *y, size_t floats,
                           float *restrict mixed)
{
    for (size_t i = 0; i < floats; i++)
    {
        mixed[i] = y->weight[0] * from[i];
    }
    for (int j = 1; j < POINTS; j++)
    {
        const float *line = from + j * row;
        for (size_t i = 0; i < floats; i++)
        {
            mixed[i] += y->weight[j] * line[i];
        }
    }
}

/* Channels one beside the other: all at once. */
static inline void sum_pixels(const float *from, ptrdiff_t row, size_t channels, const points *x,
                              const points *y, float *to)
{
    float mixed[POINTS * (CM_CHANNELS_MAX + 1)];
    mix_six(from, row, y, POINTS * channels, mixed);
    for (size_t c = 0; c < channels; c++)
    {
        float sum = 0.0f;
        for (size_t i = 0; i < POINTS; i++)
        {
            sum += x->weight[i] * mixed[i * channels + c];
        }
        to[c] = sum;
    }
}

/* Eight are taken, as vectors have it: CM_WINDOW_SLACK is behind rows. */
static inline float sum_channel(const float *from, ptrdiff_t row, const points *x, const points *y)
{
    float mixed[8];
    mix_six(from, row, y, 8, mixed);
    float sum = 0.0f;
    for (size_t i = 0; i < POINTS; i++)
    {
        sum += x->weight[i] * mixed[i];
    }
    return sum;
}

/* The same of whole numbers: eight are behind rows, too. What compilers make of loops takes three times as long. */
static inline float sum_whole(const int16_t *from, ptrdiff_t row, const points *x, const points *y)
{
    float mixed[8];
#ifdef __SSE2__
    __m128 low = _mm_setzero_ps(), high = _mm_setzero_ps();
    for (int j = 0; j < POINTS; j++)
    {
        const __m128i words = _mm_loadu_si128((const __m128i *)(const void *)(from + j * row));
        const __m128i first = _mm_srai_epi32(_mm_unpacklo_epi16(words, words), 16);
        const __m128i last = _mm_srai_epi32(_mm_unpackhi_epi16(words, words), 16);
        const __m128 weight = _mm_set1_ps(y->weight[j]);
        low = _mm_add_ps(low, _mm_mul_ps(weight, _mm_cvtepi32_ps(first)));
        high = _mm_add_ps(high, _mm_mul_ps(weight, _mm_cvtepi32_ps(last)));
    }
    _mm_storeu_ps(mixed, low);
    _mm_storeu_ps(mixed + 4, high);
#else
    float numbers[POINTS * 8];
    for (int j = 0; j < POINTS; j++)
    {
        for (size_t i = 0; i < 8; i++)
        {
            numbers[8 * j + (int)i] = (float)from[j * row + (ptrdiff_t)i];
        }
    }
    mix_six(numbers, 8, y, 8, mixed);
#endif
    float sum = 0.0f;
    for (size_t i = 0; i < POINTS; i++)
    {
        sum += x->weight[i] * mixed[i];
    }
    return sum;
}

static void sum_six(const cm_padded *padded, const float *from, const points *x, const points *y,
                    float *to)
{
    if (padded->channel == 1 && padded->channels == 3)
    {
        sum_pixels(from, padded->row, 3, x, y, to);
    }
    else if (padded->channel == 1)
    {
        sum_pixels(from, padded->row, padded->channels, x, y, to);
    }
    else
    {
        for (uint32_t c = 0; c < padded->channels; c++)
        {
            to[c * padded->channel] = sum_channel(from + c * padded->channel, padded->row, x, y);
        }
    }
}

static float sum_few(const float *from, ptrdiff_t pixel, ptrdiff_t row, const points *x,
                     const points *y)
{
    float sum = 0.0f;
    for (int32_t j = 0; j < y->count; j++, from += row)
    {
        float across = 0.0f;
        for (int32_t i = 0; i < x->count; i++)
        {
            across += x->weight[i] * from[i * pixel];
        }
        sum += y->weight[j] * across;
    }
    return sum;
}

/* Up to 6 x 6 whole numbers as floats, whose rows are 8 apart. */
static void take_whole(const int16_t *from, ptrdiff_t row, int32_t width, int32_t height,
                       float *tile)
{
    for (int32_t j = 0; j < height; j++)
    {
        for (int32_t i = 0; i < width; i++)
        {
            tile[j * 8 + i] = from[j * row + i];
        }
    }
}

static int16_t to_whole(float value)
{
    const float clamped = value > 32767.0f ? 32767.0f : value < -32767.0f ? -32767.0f : value;
    return (int16_t)(int32_t)(clamped + (clamped < 0.0f ? -0.5f : 0.5f));
}

/* A pixel of a padded's planes. */
typedef struct spot
{
    const cm_padded *of;
    unsigned plane;
    ptrdiff_t at; /* numbers from the plane's first */
} spot;

static spot spot_of(const cm_padded *padded, unsigned plane, int32_t column, int32_t row)
{
    return (spot){padded, plane, row * padded->row + column * padded->pixel};
}

static void interpolate_few(const cm_padded *padded, unsigned plane, double column, double row,
                            int32_t count, spot to)
{
    const points x = points_around(column, padded->width, count);
    const points y = points_around(row, padded->height, count);
    const spot from = spot_of(padded, plane, x.first, y.first);
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        if (padded->whole[plane] != NULL)
        {
            float tile[POINTS * 8];
            take_whole(padded->whole[plane] + from.at + channel, padded->row, x.count, y.count,
                       tile);
            padded->whole[to.plane][to.at + channel] = to_whole(sum_few(tile, 1, 8, &x, &y));
        }
        else
        {
            to.of->first[to.plane][to.at + channel] = sum_few(
                padded->first[plane] + from.at + channel, padded->pixel, padded->row, &x, &y);
        }
    }
}

static void copy_pixel(const cm_padded *padded, spot from, spot to)
{
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        if (padded->whole[from.plane] != NULL)
        {
            padded->whole[to.plane][to.at + channel] = padded->whole[from.plane][from.at + channel];
        }
        else
        {
            to.of->first[to.plane][to.at + channel] = padded->first[from.plane][from.at + channel];
        }
    }
}

void cm_border_copy(const cm_padded *padded, unsigned plane, int32_t column, int32_t count,
                    int32_t row, int32_t further, int32_t same)
{
    const int32_t width = (int32_t)padded->width;
    const int is_by_pixel = padded->channel == 1;
    const uint32_t lines = is_by_pixel ? 1 : padded->channels;
    while (count > 0)
    {
        const int32_t at = ((column + further) % width + width) % width;
        const int32_t n = count < width - at ? count : width - at;
        const spot from = spot_of(padded, plane, at, same),
                   to = spot_of(padded, plane, column, row);
        const size_t numbers = (size_t)n * (size_t)padded->pixel;
        for (uint32_t c = 0; c < lines; c++)
        {
            const ptrdiff_t line = (ptrdiff_t)c * padded->channel;
            if (padded->is_whole)
            {
                memcpy(padded->whole[plane] + to.at + line, padded->whole[plane] + from.at + line,
                       numbers * sizeof(int16_t));
            }
            else
            {
                memcpy(padded->first[plane] + to.at + line, padded->first[plane] + from.at + line,
                       numbers * sizeof(float));
            }
        }
        column += n;
        count -= n;
    }
}

static void sum_six_whole(const cm_padded *padded, spot from, const points *x, const points *y,
                          spot to)
{
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        const float sum =
            sum_whole(padded->whole[from.plane] + from.at + channel, padded->row, x, y);
        padded->whole[to.plane][to.at + channel] = to_whole(sum);
    }
}

static void interpolate_six(const cm_padded *padded, unsigned plane, const cm_six_points *columns,
                            const cm_six_points *rows, size_t i, spot to)
{
    points x, y;
    take_point(columns, i, &x);
    take_point(rows, i, &y);
    spot from = spot_of(padded, plane, x.first, y.first);
    if (columns->exact[i] && rows->exact[i])
    {
        int32_t right = 0, down = 0;
        for (int k = 1; k < POINTS; k++)
        {
            right = x.weight[k] > 0.5f ? k : right;
            down = y.weight[k] > 0.5f ? k : down;
        }
        from.at += down * padded->row + right * padded->pixel;
        copy_pixel(padded, from, to);
    }
    else if (padded->whole[plane] != NULL)
    {
        sum_six_whole(padded, from, &x, &y, to);
    }
    else
    {
        sum_six(padded, padded->first[plane] + from.at, &x, &y, to.of->first[to.plane] + to.at);
    }
}

/* Where nothing is, from the plane's last pixels. */
static void continue_plane(const cm_padded *padded, int32_t column, int32_t row, spot to)
{
    int32_t last[2], inwards[2];
    const cm_rim_nodes x =
        cm_rim_nodes_along(column, padded->width, padded->goes_on, &last[0], &inwards[0]);
    const cm_rim_nodes y =
        cm_rim_nodes_along(row, padded->height, padded->goes_on, &last[1], &inwards[1]);
    const spot from = spot_of(padded, to.plane, last[0], last[1]);
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const ptrdiff_t channel = c * padded->channel;
        float sum = 0.0f;
        for (int32_t j = 0; j < y.count; j++)
        {
            const ptrdiff_t line = from.at + channel + inwards[1] * y.from_last[j] * padded->row;
            for (int32_t i = 0; i < x.count; i++)
            {
                const ptrdiff_t at = line + inwards[0] * x.from_last[i] * padded->pixel;
                sum += y.weight[j] * x.weight[i] *
                       (padded->is_whole ? (float)padded->whole[to.plane][at]
                                         : padded->first[to.plane][at]);
            }
        }
        if (padded->is_whole)
        {
            padded->whole[to.plane][to.at + channel] = to_whole(sum);
        }
        else
        {
            padded->first[to.plane][to.at + channel] = sum;
        }
    }
}

/* As many points as do not lie on both sides of a diagonal, where creases are; two if there are none. */
static int32_t points_beside_crease(const cm_padded *padded, const cm_six_points *columns,
                                    const cm_six_points *rows, size_t i)
{
    /* four are the inner ones of six, and are two if these are across */
    return cm_level_is_across(padded->width, columns->first[i] + 1, rows->first[i] + 1, 4) ? 2 : 4;
}

/* Where n positions lie. */
typedef struct places
{
    size_t n;
    uint8_t found[CM_BORDER_RUN];
    int are_many; /* points, which planes of few pixels do not have */
    cm_six_points columns;
    cm_six_points rows;
    const double *x;
    const double *y;
} places;

static void find_places(const cm_border_values *values, size_t n, double *x, double *y, double *z,
                        places *at)
{
    const cm_padded *padded = values->padded;
    at->n = n;
    at->are_many = padded->width >= POINTS && padded->height >= POINTS;
    at->x = x;
    at->y = y;
    cm_surface_find(values->surface, n, x, y, z, at->found, x, y);
    if (!at->are_many)
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        x[i] = at->found[i] != CM_NO_FACE ? x[i] : 0.0;
        y[i] = at->found[i] != CM_NO_FACE ? y[i] : 0.0;
    }
    values->set->border_points(n, x, values->scale[0], padded->width, &at->columns);
    values->set->border_points(n, y, values->scale[1], padded->height, &at->rows);
}

/* A pixel from others of a plane of `padded`. */
static void put_pixel(const cm_border_values *values, const cm_padded *padded, const places *at,
                      size_t i, spot to)
{
    if (at->are_many &&
        !(values->surface->creased &&
          cm_level_is_across(padded->width, at->columns.first[i], at->rows.first[i], POINTS)))
    {
        interpolate_six(padded, at->found[i], &at->columns, &at->rows, i, to);
    }
    else
    {
        interpolate_few(
            padded, at->found[i], at->x[i] / values->scale[0], at->y[i] / values->scale[1],
            at->are_many ? points_beside_crease(padded, &at->columns, &at->rows, i) : POINTS, to);
    }
}

/* ---- from pictures ---- */

/* Numbers that are read of a plane at once: of 6 x 6 pixels at least. */
#define TILE_MOST 4096

typedef struct tile
{
    int32_t left;
    int32_t right; /* before it */
    int32_t top;
    int32_t bottom;
} tile;

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* All that the places from `begin` on are made of that lie on one plane and near one another; returns the first that
 * does not. */
static size_t gather(const places *at, size_t begin, int32_t channels, tile *box)
{
    size_t i = begin;
    *box = (tile){INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (; i < at->n && at->found[i] == at->found[begin]; i++)
    {
        const tile more = {lesser(box->left, at->columns.first[i]),
                           greater(box->right, at->columns.first[i] + POINTS),
                           lesser(box->top, at->rows.first[i]),
                           greater(box->bottom, at->rows.first[i] + POINTS)};
        const int64_t pixels =
            ((int64_t)more.right - more.left) * ((int64_t)more.bottom - more.top);
        if (i > begin && pixels > TILE_MOST / channels)
        {
            break;
        }
        *box = more;
    }
    return i;
}

/* The part of a border that stands alone in which a pixel lies. */
static const cm_padded *side_of(const cm_border_values *values, int32_t column, int32_t row)
{
    const int32_t height = (int32_t)values->padded->height;
    const int side = row < 0 ? 0 : row >= height ? 1 : column < 0 ? 2 : 3;
    return &values->side[side];
}

/* Planes of six pixels and more that go on everywhere. */
static void put_from_pictures(const cm_border_values *values, unsigned plane, int32_t column,
                              int32_t row, int32_t right, int32_t down, const places *at)
{
    const cm_padded *to = side_of(values, column, row);
    cm_padded some = *values->padded;
    float pixels[TILE_MOST];
    for (size_t begin = 0; begin < at->n;)
    {
        tile box;
        const size_t end = gather(at, begin, (int32_t)some.channels, &box);
        some.row = (box.right - box.left) * some.pixel;
        for (int32_t line = box.top; line < box.bottom; line++)
        {
            cm_level_read(values->reader, at->found[begin], box.left, line, box.right - box.left,
                          pixels + (line - box.top) * some.row);
        }
        /* where the plane's own first pixel would be, which is outside of these */
        const intptr_t before = (intptr_t)box.top * some.row + (intptr_t)box.left * some.pixel;
        some.first[at->found[begin]] =
            (float *)((intptr_t)pixels - before * (intptr_t)sizeof *pixels);
        for (; begin < end; begin++)
        {
            put_pixel(
                values, &some, at, begin,
                spot_of(to, plane, column + (int32_t)begin * right, row + (int32_t)begin * down));
        }
    }
}

/* ---- many at once ---- */

/* The sums of n places, by pixels or channel by channel. */
static void sum_many(const cm_border_values *values, const places *at, const void *const *from,
                     float *sum)
{
    const cm_padded *padded = values->padded;
    const cm_filter_set *set = values->set;
    const ptrdiff_t size = padded->is_whole ? sizeof(int16_t) : sizeof(float);
    if (padded->channel == 1)
    {
        set->six_floats(padded->channels, at->n, from, padded->row * size, 1.0f, &at->columns,
                        &at->rows, sum);
        return;
    }
    (padded->is_whole ? set->six_words : set->six_lines)(padded->channels, at->n, from,
                                                         padded->row * size, padded->channel * size,
                                                         &at->columns, &at->rows, sum);
}

static void put_sum(const cm_padded *padded, const float *sum, size_t i, spot to)
{
    const int are_pixels = padded->channel == 1;
    for (uint32_t c = 0; c < padded->channels; c++)
    {
        const float value = sum[are_pixels ? i * CM_SIX_CHANNELS + c : c * CM_SIX_MOST + i];
        const ptrdiff_t number = to.at + c * padded->channel;
        if (padded->is_whole)
        {
            padded->whole[to.plane][number] = to_whole(value);
        }
        else
        {
            padded->first[to.plane][number] = value;
        }
    }
}

/* Places of planes with six pixels each way and without creases, from these planes. */
static void put_many(const cm_border_values *values, unsigned plane, int32_t column, int32_t row,
                     int32_t right, int32_t down, const places *at)
{
    const cm_padded *padded = values->padded;
    const void *from[CM_BORDER_RUN];
    float sum[CM_SIX_CHANNELS * CM_SIX_MOST];
    for (size_t i = 0; i < at->n; i++)
    {
        const unsigned of = at->found[i] != CM_NO_FACE ? at->found[i] : 0;
        const ptrdiff_t first =
            at->rows.first[i] * padded->row + at->columns.first[i] * padded->pixel;
        from[i] = padded->is_whole ? (const void *)(padded->whole[of] + first)
                                   : (const void *)(padded->first[of] + first);
    }
    sum_many(values, at, from, sum);
    for (size_t i = 0; i < at->n; i++, column += right, row += down)
    {
        const spot to = spot_of(padded, plane, column, row);
        if (at->found[i] == CM_NO_FACE)
        {
            continue_plane(padded, column, row, to);
        }
        else if (at->columns.exact[i] && at->rows.exact[i])
        {
            interpolate_six(padded, at->found[i], &at->columns, &at->rows, i, to);
        }
        else
        {
            put_sum(padded, sum, i, to);
        }
    }
}

void cm_border_put(const cm_border_values *values, unsigned plane, int32_t column, int32_t row,
                   int32_t right, int32_t down, size_t n, double *x, double *y, double *z)
{
    const cm_padded *padded = values->padded;
    places at;
    find_places(values, n, x, y, z, &at);
    if (values->reader != NULL)
    {
        put_from_pictures(values, plane, column, row, right, down, &at);
        return;
    }
    if (at.are_many && !values->surface->creased && padded->channels <= CM_SIX_CHANNELS)
    {
        put_many(values, plane, column, row, right, down, &at);
        return;
    }
    for (size_t i = 0; i < n; i++, column += right, row += down)
    {
        const spot to = spot_of(padded, plane, column, row);
        if (at.found[i] == CM_NO_FACE)
        {
            continue_plane(padded, column, row, to);
        }
        else
        {
            put_pixel(values, padded, &at, i, to);
        }
    }
}
