/* SPDX-License-Identifier: MIT */
#include "drawn_scene.h"

pictures make_pictures(const char *specification, const cm_rotation *rotation, cm_pixel_type type,
                       uint32_t channels, int filling)
{
    char message[200] = "";
    const cm_surface_options options = {.size = sizeof options, .rotation = rotation};
    pictures made = {0};
    cm_surface_check(specification, &options, message, sizeof message);
    ck_assert_msg(cm_surface_create(specification, &options, &made.surface) == CM_OK, "%s: %s",
                  specification, message);
    const uint32_t width = cm_surface_width(made.surface);
    const uint32_t height = cm_surface_height(made.surface);
    made.bytes = (size_t)width * height * channels * cm_pixel_size(type);
    for (size_t i = 0; i < cm_surface_picture_count(made.surface); i++)
    {
        made.image[i] = (cm_image){.size = sizeof(cm_image),
                                   .data = malloc(made.bytes),
                                   .type = type,
                                   .width = width,
                                   .height = height,
                                   .channels = channels};
        memset(made.image[i].data, filling, made.bytes);
    }
    return made;
}

void free_pictures(pictures *made)
{
    for (size_t i = 0; i < 6; i++)
    {
        free(made->image[i].data);
    }
    cm_surface_destroy(made->surface);
}

float scene_value(const double direction[3], uint32_t channel)
{
    static const double waves[6][3] = {{40, 3, 7},    {-5, 37, 11},  {9, -6, 41},
                                       {30, 20, -14}, {-22, 18, 25}, {12, -33, -9}};
    double sum = 0.0;
    for (unsigned i = 0; i < 6; i++)
    {
        sum += cos(waves[i][0] * direction[0] + waves[i][1] * direction[1] +
                   waves[i][2] * direction[2] + i + channel);
    }
    return (float)(0.5 + 0.4 * sum / 6.0);
}

static unsigned char *place_of(const cm_image *image, uint32_t column, uint32_t row,
                               uint32_t channel)
{
    return (unsigned char *)image->data +
           (((size_t)row * image->width + column) * image->channels + channel) *
               cm_pixel_size(image->type);
}

static void put_value(const cm_image *image, uint32_t column, uint32_t row, uint32_t channel,
                      float value)
{
    unsigned char *to = place_of(image, column, row, channel);
    if (image->type == CM_PIXEL_U8)
    {
        *to = (unsigned char)lrintf(value * 255.0f);
    }
    else if (image->type == CM_PIXEL_U16)
    {
        const uint16_t word = (uint16_t)lrintf(value * 65535.0f);
        memcpy(to, &word, sizeof word);
    }
    else
    {
        memcpy(to, &value, sizeof value);
    }
}

double channel_at(const cm_image *image, uint32_t column, uint32_t row, uint32_t channel)
{
    const unsigned char *from = place_of(image, column, row, channel);
    uint16_t word;
    float value;
    switch (image->type)
    {
    case CM_PIXEL_U8:
        return *from / 255.0;
    case CM_PIXEL_U16:
        memcpy(&word, from, sizeof word);
        return word / 65535.0;
    default:
        memcpy(&value, from, sizeof value);
        return (double)value;
    }
}

/* Planes stand in pictures one beside the other, or have pictures of their own: what the test's surfaces are. */
static void locate(const pictures *on, size_t plane, uint32_t column, uint32_t row, size_t *picture,
                   uint32_t *picture_column)
{
    const uint32_t width = cm_surface_plane_width(on->surface);
    const size_t across = cm_surface_width(on->surface) / width;
    *picture = plane / across;
    *picture_column = (uint32_t)(plane % across) * width + column;
    (void)row;
}

static int direction_of(const pictures *on, size_t plane, uint32_t column, uint32_t row,
                        double direction[3])
{
    const uint8_t number = (uint8_t)plane;
    const double x = column + 0.5;
    const double y = row + 0.5;
    cm_surface_directions(on->surface, 1, &number, &x, &y, &direction[0], &direction[1],
                          &direction[2]);
    return !isnan(direction[0]);
}

void draw_scene(pictures *on)
{
    for (size_t plane = 0; plane < cm_surface_plane_count(on->surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(on->surface); row++)
        {
            for (uint32_t column = 0; column < cm_surface_plane_width(on->surface); column++)
            {
                double direction[3];
                size_t picture;
                uint32_t at;
                locate(on, plane, column, row, &picture, &at);
                for (uint32_t c = 0;
                     direction_of(on, plane, column, row, direction) && c < on->image->channels;
                     c++)
                {
                    put_value(&on->image[picture], at, row, c, scene_value(direction, c));
                }
            }
        }
    }
}

double deviation(const pictures *from, const pictures *on)
{
    double sum = 0.0;
    double count = 0.0;
    for (size_t plane = 0; plane < cm_surface_plane_count(on->surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(on->surface); row++)
        {
            for (uint32_t column = 0; column < cm_surface_plane_width(on->surface); column++)
            {
                double direction[3], x, y;
                uint8_t found;
                size_t picture;
                uint32_t at;
                if (!direction_of(on, plane, column, row, direction))
                {
                    continue;
                }
                cm_surface_positions(from->surface, 1, &direction[0], &direction[1], &direction[2],
                                     &found, &x, &y);
                locate(on, plane, column, row, &picture, &at);
                for (uint32_t c = 0; found != CM_NO_FACE && c < on->image->channels; c++)
                {
                    const double wrong = channel_at(&on->image[picture], at, row, c) -
                                         (double)scene_value(direction, c);
                    sum += wrong * wrong;
                    count += 1.0;
                }
            }
        }
    }
    return sqrt(sum / count);
}

void resample(const pictures *from, pictures *to, const cm_plan_options *options, unsigned threads)
{
    cm_plan *plan;
    cm_source *source;
    ck_assert_int_eq(cm_plan_create(from->surface, to->surface, options, &plan), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, from->image, to->image->type, threads, &source), CM_OK);
    ck_assert_int_eq(cm_resample_source(plan, source, to->image, (cm_rows){0}, threads), CM_OK);
    cm_source_destroy(source);
    cm_plan_destroy(plan);
}
