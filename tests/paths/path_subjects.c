/* SPDX-License-Identifier: MIT
 *
 * The subjects: every mapping of the catalogue and some with other parameters, each in three frames, those of cubes also
 * at the ends of their parameters' ranges, in the last frame, which --quick has, too, and how far their paths may be apart.
 */
#include "paths.h"

#include "truth/parameter_ends.h"
#include "truth/sphere.h"

/* Within the ranges of parameters: where a formula changes, and known values. */
static const char *const others[] = {
    "tangent:c=0.25",
    "tangent:c=1.1823",
    "algebraic:c=0.25",
    "tanh:c=0.1",
    "logistic:c=0.5",
    "smoothstep:c=0.25",
    "smoothstep:c=0.95",
    "azimuthal:lambert:full=1",
    "azimuthal:equidistant:full=1",
    "azimuthal:breusing:fov=220",
    "azimuthal:stereographic:fov=220",
    "azimuthal:orthographic:fov=60",
    "azimuthal:mixture:beta=0",
    "azimuthal:mixture:beta=1",
    "azimuthal:lambert:lon=30,lat=-40",
    "border:equidistant,squircle",
    "border:breusing,radial",
    "border:mixture,elliptical",
    "border:lambert,conformal,lon=20,lat=30",
    "quincuncial:lambert,shirley",
    "quincuncial:mixture,squircle",
    "quincuncial:breusing,elliptical",
    "quincuncial:orthographic,radial,lon=-70,lat=10",
};

/* Every turn and mirroring of a face, and a face of geo at the number of another. */
static const cm_frame turned = {
    sizeof(cm_frame),
    "turned",
    "for tests",
    -1,
    {
        {"-z", -CM_AXIS_Z, -CM_AXIS_X, -CM_AXIS_Y},
        {"-y", -CM_AXIS_Y, CM_AXIS_Z, CM_AXIS_X},
        {"+x", CM_AXIS_X, -CM_AXIS_Z, CM_AXIS_Y},
        {"-x", -CM_AXIS_X, CM_AXIS_Y, -CM_AXIS_Z},
        {"+z", CM_AXIS_Z, CM_AXIS_Y, CM_AXIS_X},
        {"+y", CM_AXIS_Y, -CM_AXIS_X, -CM_AXIS_Z},
    },
};

enum
{
    OTHERS = sizeof others / sizeof others[0],
    FRAMES = 3
};

static const cm_frame *frame_at(size_t index)
{
    return index == 0 ? cm_frame_find("geo") : index == 1 ? cm_frame_find("gl") : &turned;
}

static const parameter_ends *ends(void)
{
    static parameter_ends list;
    if (list.count == 0)
    {
        list = list_parameter_ends();
    }
    return &list;
}

size_t subject_count(void)
{
    return (cm_catalogue_count() + OTHERS) * FRAMES + ends()->count;
}

static const char *specification_at(size_t index)
{
    size_t count = cm_catalogue_count();
    size_t which = index / FRAMES;
    return which < count            ? cm_catalogue_at(which)->identifier
           : which < count + OTHERS ? others[which - count]
                                    : ends()->specification[index - (count + OTHERS) * FRAMES];
}

/* NULL where the instruction set is missing. */
static cm_mapping *make(const char *specification, const cm_frame *frame, cm_tier tier,
                        const char *set)
{
    cm_options options = {.size = sizeof options, .instructions = set, .tier = tier};
    cm_mapping *made = NULL;
    cm_status status = cm_mapping_create_with(specification, frame, &options, &made);
    if (status != CM_OK && status != CM_ERROR_INSTRUCTIONS)
    {
        fprintf(stderr, "check-paths: %s: %s\n", specification, cm_status_text(status));
        exit(2);
    }
    return made;
}

/* The largest stretch of a small difference, by the warp or by its inverse, over a grid that comes
 * close to the edges; 1 for a mapping that is no warp. As in truth/certificate, in double. */
static double condition_of(const cm_mapping *mapping)
{
    enum
    {
        GRID = 64
    };
    const double step = 1e-6;
    double worst = 1.0;
    for (int i = 0; has_warp(mapping) && i < 2 * GRID * GRID; i++)
    {
        cm_status (*const way)(const cm_mapping *, const double *, double *) =
            i % 2 == 0 ? cm_unwarp : cm_warp;
        double at[2] = {(i / 2 % GRID + 0.5) / GRID, ((double)(i / 2 / GRID) + 0.5) / GRID};
        double column[2][2];
        at[0] = at[0] > 0.98 ? 1.0 - 2.0 * step : at[0];
        at[1] = at[1] > 0.98 ? 1.0 - 2.0 * step : at[1];
        for (int k = 0; k < 2; k++)
        {
            double low[2] = {at[0], at[1]};
            double high[2] = {at[0], at[1]};
            low[k] -= step;
            high[k] += step;
            (void)way(mapping, low, low);
            (void)way(mapping, high, high);
            column[k][0] = fabs(high[0] - low[0]) / (2.0 * step);
            column[k][1] = fabs(high[1] - low[1]) / (2.0 * step);
        }
        worst = fmax(worst, fmax(column[0][0] + column[1][0], column[0][1] + column[1][1]));
    }
    return worst;
}

static double widening_of(const char *specification)
{
    cm_mapping *mapping = make(specification, NULL, CM_TIER_EXACT, "scalar");
    cm_mapping *standard =
        make(cm_mapping_describe(mapping)->identifier, NULL, CM_TIER_EXACT, "scalar");
    double widening = fmax(1.0, condition_of(mapping) / condition_of(standard));
    cm_mapping_destroy(standard);
    cm_mapping_destroy(mapping);
    return widening;
}

int make_subject(subject *made, size_t index, cm_tier tier, const char *set)
{
    size_t count = cm_catalogue_count();
    int is_end = index >= (count + OTHERS) * FRAMES;
    *made = (subject){.tier = tier, .standard = index < count * FRAMES, .widening = 1.0};
    made->specification = specification_at(index);
    made->frame = frame_at(is_end ? FRAMES - 1 : index % FRAMES);
    made->reference = make(made->specification, made->frame, tier, "scalar");
    made->tested = make(made->specification, made->frame, tier, set);
    if (!made->standard)
    {
        made->widening = widening_of(made->specification);
    }
    return made->tested != NULL;
}

void drop_subject(const subject *made)
{
    cm_mapping_destroy(made->reference);
    cm_mapping_destroy(made->tested);
}

static const cm_bounds *bounds_of(const subject *s)
{
    return &cm_mapping_describe(s->reference)->bounds;
}

/* 8 and 16 are what docs/measured/accuracy.md promises whatever the parameters. */
double forward_bound(const subject *s)
{
    return 2.0 * fmin(bounds_of(s)->forward * s->widening, 8.0);
}

double inverse_bound(const subject *s)
{
    return 2.0 * fmin(bounds_of(s)->inverse * s->widening, 8.0);
}

/* 0 is none that is stated. A turned direction has the rounding of its other components in each, and what is
 * 0 about the centre is not in a wider or narrower field of view. */
double relative_bound(const subject *s)
{
    int is_other = !s->standard && cm_mapping_describe(s->reference)->kind != CM_KIND_CUBE;
    if (bounds_of(s)->relative == 0.0 || is_other)
    {
        return (double)INFINITY;
    }
    return 2.0 * fmin(bounds_of(s)->relative * s->widening, 16.0);
}

double jacobian_bound(const subject *s)
{
    return 2.0 * (s->standard ? 20.0 : 64.0);
}

int is_steep(const subject *s)
{
    return cm_mapping_describe(s->reference)->kind != CM_KIND_CUBE || s->widening > 50.0;
}

double angle_bound(const subject *s, const precision *in)
{
    if (cm_mapping_describe(s->reference)->kind == CM_KIND_LAYOUT)
    {
        return 32.0 * sqrt(in->eps); /* at the antipode of a flat law */
    }
    return 2.0 * bounds_of(s)->round_trip * s->widening * in->eps;
}

int is_exact_in_fast(const subject *s, const precision *in, const path *p)
{
    return s->tier == CM_TIER_FAST && !in->narrow &&
           (p->applies == NULL || p->applies(s->reference)) &&
           (cm_mapping_describe(s->reference)->fast & p->fast) == 0;
}

int is_path_of(const subject *s, const precision *in, const path *p, precision *judged)
{
    int applies = p->applies == NULL || p->applies(s->reference);
    *judged = *in;
    if (s->tier == CM_TIER_EXACT)
    {
        return applies;
    }
    judged->name = "double, fast";
    judged->eps = paths_float.in.eps;
    judged->least = paths_float.in.least;
    return applies && !in->narrow && (cm_mapping_describe(s->reference)->fast & p->fast) != 0;
}
