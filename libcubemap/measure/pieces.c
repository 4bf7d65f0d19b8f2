/* SPDX-License-Identifier: MIT */
#include "pieces.h"
#include "libcubemap/mapping/catalogue_words.h"

#include <string.h>

typedef struct quantity_info
{
    const char *name;
    double ideal;
    size_t offset; /* in cm_distortion_arrays */
} quantity_info;

static const quantity_info quantities[] = {
    {"area", 1.0, offsetof(cm_distortion_arrays, area)},
    {"isotropy", 1.0, offsetof(cm_distortion_arrays, isotropy)},
    {"deformation", 0.0, offsetof(cm_distortion_arrays, deformation)},
    {"scale", 1.9098593171027440, offsetof(cm_distortion_arrays, scale)},
    {"texel-aspect", 1.0, offsetof(cm_distortion_arrays, texel_aspect)},
    {"texel-area", 1.0, offsetof(cm_distortion_arrays, texel_area)},
};

#define QUANTITIES (sizeof quantities / sizeof quantities[0])

const char *cm_quantity_name(size_t index)
{
    return index < QUANTITIES ? quantities[index].name : NULL;
}

int cm_quantity_find(const char *name)
{
    for (size_t i = 0; i < QUANTITIES && name != NULL; i++)
    {
        if (cm_word_equal(name, strlen(name), quantities[i].name, strlen(quantities[i].name)))
        {
            return (int)i;
        }
    }
    return -1;
}

/* The area of a texel at the centre of each face is the unit of the others. */
static void find_units(cm_quadrature *quadrature)
{
    for (uint8_t face = 0; face < 6; face++)
    {
        static const double centre[2] = {0.0, 0.0};
        cm_distortion d;
        cm_inverse_distortion(quadrature->mapping, face, centre, &d);
        quadrature->unit[face] =
            quadrature->quantity == CM_QUANTITY_TEXEL_AREA ? d.texel_area : 1.0;
    }
}

static int are_good(const cm_statistics_options *o)
{
    return o->size == sizeof *o && (o->measure == CM_OVER_FACE || o->measure == CM_OVER_SPHERE) &&
           o->faces <= 63 && o->pixels <= 16384 && (o->pixels == 0 || o->measure == CM_OVER_FACE) &&
           (o->tolerance == 0.0 || (o->tolerance >= 1e-13 && o->tolerance <= 1e-2));
}

cm_status cm_quadrature_make(const cm_mapping *mapping, cm_quantity quantity,
                             const cm_statistics_options *options, cm_quadrature *quadrature)
{
    static const cm_statistics_options none = {.size = sizeof none};
    const cm_statistics_options *o = options == NULL ? &none : options;
    if (mapping == NULL || (size_t)quantity >= QUANTITIES || !are_good(o))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    quadrature->mapping = mapping;
    quadrature->quantity = quantity;
    quadrature->measure = o->measure;
    quadrature->faces = o->faces == 0 ? 63 : o->faces;
    quadrature->ideal = quantities[quantity].ideal;
    find_units(quadrature);
    return CM_OK;
}

void cm_quadrature_evaluate(const cm_quadrature *quadrature, cm_piece_points *points)
{
    cm_distortion_arrays to = {0};
    double *value = points->value;
    memcpy((char *)&to + quantities[quadrature->quantity].offset, &value, sizeof value);
    /* an area on the sphere is one of the map over the scale */
    to.scale = quadrature->quantity == CM_QUANTITY_SCALE ? to.scale : points->weight;
    cm_inverse_distortion_array(quadrature->mapping, points->count, points->face, points->u,
                                points->v, &to);
    for (size_t i = 0; i < points->count; i++)
    {
        double scale = to.scale[i];
        points->weight[i] = quadrature->measure == CM_OVER_SPHERE ? 1.0 / scale : 1.0;
        points->value[i] /= quadrature->unit[points->face[i]];
    }
}
