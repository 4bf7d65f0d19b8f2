/* SPDX-License-Identifier: MIT */
#include "camera_field.h"
#include "camera_fold_between.h"

#include <stddef.h>

double cm_camera_field_border(const cm_camera_field *field, double cosine, double sine)
{
    cm_fold_ray ray;
    cm_fold_turn(&field->fold, cosine, sine, &ray);
    return cm_fold_first(&field->fold, &ray);
}

/* Directions are numbered along the square whose corners are on the axes: that needs no angles. */
void cm_camera_field_direction(double side, double *cosine, double *sine)
{
    const double along = side < CM_FIELD_SIDES ? side * (4.0 / CM_FIELD_SIDES) : 0.0;
    const double a = fabs(along - 2.0) - 1.0;
    const double b = along < 2.0 ? 1.0 - fabs(along - 1.0) : fabs(along - 3.0) - 1.0;
    const double length = sqrt(a * a + b * b);
    *cosine = a / length;
    *sine = b / length;
}

static double side_of(double a, double b)
{
    const double part = b / (fabs(a) + fabs(b));
    const double along = a < 0.0 ? 2.0 - part : part < 0.0 ? 4.0 + part : part;
    const double side = along * (CM_FIELD_SIDES / 4.0);
    return side >= 0.0 ? side : 0.0; /* NaN: the axis */
}

/* Borders of directions, n from the first on and one more, so far from each other; and what is between them. */
static void find_ends(const cm_fold *fold, double first, double distance, size_t n,
                      cm_field_end *end)
{
    cm_fold_ray ray[2];
    for (size_t i = 0; i <= n; i++)
    {
        cm_fold_ray *this = &ray[i % 2];
        double cosine;
        double sine;
        cm_camera_field_direction(first + distance * (double)i, &cosine, &sine);
        cm_fold_turn(fold, cosine, sine, this);
        end[i] = (cm_field_end){cm_fold_first(fold, this), 0.0, 0.0, 0, -1};
        if (i > 0)
        {
            const cm_fold_between between =
                cm_fold_look_between(fold, &ray[1 - i % 2], this, end[i - 1].border, end[i].border);
            end[i - 1].sure = between.sure;
            end[i - 1].line = between.line;
            end[i - 1].is_plain = between.is_divided;
        }
    }
}

static void find_borders(cm_camera_field *field)
{
    double within = (double)INFINITY;
    int splits = 0;
    find_ends(&field->fold, 0.0, 1.0, CM_FIELD_SIDES, field->end);
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        cm_field_end *end = &field->end[i];
        within = fmin(within, end->is_plain ? end->line : end->sure);
        if (!end->is_plain && end->sure < CM_FIELD_FAR && splits < CM_FIELD_SPLITS)
        {
            end->split = splits++;
            find_ends(&field->fold, (double)i, 1.0 / CM_FIELD_PARTS, CM_FIELD_PARTS,
                      field->part[end->split]);
        }
    }
    field->within = within * within;
}

void cm_camera_field_find(const cm_lens *lens, cm_camera_field *field)
{
    field->furthest = (double)INFINITY;
    if (lens->is_plain)
    {
        for (size_t i = 0; i <= CM_FIELD_SIDES; i++)
        {
            field->end[i] =
                (cm_field_end){(double)INFINITY, (double)INFINITY, (double)INFINITY, 1, -1};
        }
        field->within = (double)INFINITY;
        return;
    }
    cm_fold_prepare(lens, CM_FIELD_FURTHEST, &field->fold);
    find_borders(field);
}

int cm_camera_field_joins(const cm_camera_field *field, double a, double b)
{
    const double square = LENS_MAD(a, a, b * b);
    if (square < field->within)
    {
        return 1;
    }
    const double radius = sqrt(square);
    const double side = side_of(a, b);
    const size_t i = side < CM_FIELD_SIDES ? (size_t)side : CM_FIELD_SIDES - 1;
    const cm_field_end *end = &field->end[i];
    if (end->split >= 0)
    {
        const double part = (side - (double)i) * CM_FIELD_PARTS;
        end = &field->part[end->split][part < CM_FIELD_PARTS ? (size_t)part : CM_FIELD_PARTS - 1];
    }
    if (end->is_plain)
    {
        return radius < end->line;
    }
    return radius < end->sure || cm_fold_is_clear(&field->fold, a / radius, b / radius, radius);
}
