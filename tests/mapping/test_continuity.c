/* SPDX-License-Identifier: MIT
 *
 * Continuity: two directions a hair apart across the edge of two faces give (face, u, v) that map
 * back a hair apart, edges are where both faces say, ties go where the header says; and the smoothness
 * that the catalogue claims, inside a face and across its edges, is what differences of the kernels
 * in quadruple precision find, no less and no more.
 *
 * The last part needs gcc's libquadmath, which tests/meson.build says by HAVE_QUADMATH.
 */
#include "tests/suite.h"

#include "truth/parameter_ends.h"
#ifdef HAVE_QUADMATH
#include "truth/quad.h"
#endif

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* ---- Mappings, and what they promise ---- */

/* besides the standard parameters and the ends of their ranges */
static const char *const variants[] = {"zucker",
                                       "tangent:c=0.5",
                                       "tangent:c=1.19705",
                                       "tanh:c=0.5",
                                       "tanh:c=1.5",
                                       "logistic:c=1",
                                       "everitt:c=1",
                                       "everitt:c=1.2",
                                       "algebraic:c=1",
                                       "smoothstep:c=0.5",
                                       "difference:mild",
                                       "coupled-cubic:low",
                                       "difference:isotropic"};

enum
{
    SUBJECTS_MOST = 128
};

typedef struct subject
{
    char specification[64];
    double round_trip;       /* eps; infinite if half of the digits are lost */
    double forward;          /* u and v: eps */
    double inverse;          /* components of a direction: eps */
    double plane_round_trip; /* u and v: eps */
    double stretch;          /* by how much of itself a round trip changes a small distance */
} subject;

static subject subjects[SUBJECTS_MOST];
static size_t subject_count;

/* The descriptor's bounds are those of the standard parameters. For others, as in test_mappings.c, 5 nm on
 * Earth, or 1 nm over the slope at the edge, by which a round trip magnifies rounding; 1 nm is 1.42
 * eps. */
static void bound_variant(subject *s)
{
    static const double beside_edge[2] = {1.0 - 1e-6, 0.0};
    double pq[2];
    cm_mapping *mapping = make_mapping(s->specification, NULL);
    ck_assert_int_eq(cm_unwarp(mapping, beside_edge, pq), CM_OK);
    double slope = 1e-6 / (1.0 - pq[0]);
    s->forward = 8.0;
    s->plane_round_trip = 16.0;
    s->inverse = 8.0 / fmin(1.0, slope);
    s->round_trip = fmax(5.0 * 1.42, 1.42 / slope);
    if (slope < 0.01) /* smoothstep:c=1 */
    {
        s->inverse = s->round_trip = (double)INFINITY;
    }
    cm_mapping_destroy(mapping);
}

static void add_subject(const char *specification, const cm_mapping_info *standard)
{
    subject *s = &subjects[subject_count++];
    ck_assert_uint_le(subject_count, SUBJECTS_MOST);
    snprintf(s->specification, sizeof s->specification, "%s", specification);
    if (standard != NULL)
    {
        s->forward = standard->bounds.forward;
        s->inverse = standard->bounds.inverse;
        s->plane_round_trip = standard->bounds.plane_round_trip;
        s->round_trip = standard->bounds.round_trip;
    }
    else
    {
        bound_variant(s);
    }
    /* the published inverse of COBE is not one, but nearly parallel to it */
    int legacy = strcmp(specification, "cobe:legacy=1") == 0;
    s->stretch = legacy ? 0.01 : 0.0;
    s->plane_round_trip = legacy ? (double)INFINITY : s->plane_round_trip;
}

static void list_subjects(void)
{
    subject_count = 0;
    for (size_t i = 0; i < cube_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        add_subject(info->identifier, info);
    }
    const parameter_ends ends = list_parameter_ends();
    for (size_t i = 0; i < ends.count; i++)
    {
        add_subject(ends.specification[i], NULL);
    }
    for (size_t i = 0; i < COUNT(variants); i++)
    {
        add_subject(variants[i], NULL);
    }
}

static void for_every_subject(void (*check)(const cm_mapping *, const subject *))
{
    list_subjects();
    for (size_t i = 0; i < subject_count; i++)
    {
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_mapping *mapping = make_mapping(subjects[i].specification, cm_frame_at(f));
            check(mapping, &subjects[i]);
            cm_mapping_destroy(mapping);
        }
    }
}

static int is_hybrid(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID;
}

static int is_torn(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->smooth_edge == CM_SMOOTH_TORN;
}

/* ---- Both precisions, spoken to in double ---- */

typedef struct precision
{
    const char *name;
    double eps;
    int is_float;
} precision;

static const precision precisions[] = {{"double", 0x1p-53, 0}, {"float", 0x1p-24, 1}};

static double rounded(const precision *p, double value)
{
    return p->is_float ? (double)(float)value : value;
}

/* the next number towards zero */
static double shortened(const precision *p, double value)
{
    return p->is_float ? (double)nextafterf((float)value, 0.0f) : nextafter(value, 0.0);
}

static uint8_t forward(const precision *p, const cm_mapping *mapping, const double direction[3],
                       double uv[2])
{
    if (!p->is_float)
    {
        return cm_forward(mapping, direction, uv);
    }
    float from[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
    float to[2];
    uint8_t face = cm_forward_f32(mapping, from, to);
    uv[0] = (double)to[0];
    uv[1] = (double)to[1];
    return face;
}

static void inverse(const precision *p, const cm_mapping *mapping, int face, const double uv[2],
                    double direction[3])
{
    if (!p->is_float)
    {
        cm_inverse(mapping, (uint8_t)face, uv, direction);
        return;
    }
    float from[2] = {(float)uv[0], (float)uv[1]};
    float to[3];
    cm_inverse_f32(mapping, (uint8_t)face, from, to);
    for (int k = 0; k < 3; k++)
    {
        direction[k] = (double)to[k];
    }
}

/* ---- Faces, edges, corners ---- */

static double along(const double point[3], int axis)
{
    return axis > 0 ? point[axis - 1] : -point[-axis - 1];
}

static void put_along(double point[3], int axis, double value)
{
    point[abs(axis) - 1] = axis > 0 ? value : -value;
}

static const cm_frame_face *axes_of(const cm_mapping *mapping, int face)
{
    return &cm_mapping_frame(mapping)->face[face];
}

static int face_with_outward(const cm_frame *frame, int axis)
{
    int face = 0;
    while (frame->face[face].outward != axis)
    {
        face++;
    }
    return face;
}

/* Between a face and the neighbour whose outward axis is the one that is crossed. */
typedef struct edge
{
    int face;
    int other;
    int outward; /* of the face */
    int crossed; /* outward of the other */
    int beside;  /* along the edge */
} edge;

#define EDGES 24

static edge edge_of(const cm_frame *frame, int which)
{
    const cm_frame_face *face = &frame->face[which / 4];
    int sign = which & 1 ? 1 : -1;
    int crossed = sign * (which & 2 ? face->v : face->u);
    return (edge){.face = which / 4,
                  .other = face_with_outward(frame, crossed),
                  .outward = face->outward,
                  .crossed = crossed,
                  .beside = which & 2 ? face->u : face->v};
}

/* A point of the cube's surface, on which u and v of each face are what the point has along the face's
 * axes: that of an edge is the same for both faces. */
static void point_of_edge(const edge *e, double t, double point[3])
{
    put_along(point, e->outward, 1.0);
    put_along(point, e->crossed, 1.0);
    put_along(point, e->beside, t);
}

static void uv_of_point(const cm_mapping *mapping, int face, const double point[3], double uv[2])
{
    uv[0] = along(point, axes_of(mapping, face)->u);
    uv[1] = along(point, axes_of(mapping, face)->v);
}

static void point_of_uv(const cm_mapping *mapping, int face, const double uv[2], double point[3])
{
    put_along(point, axes_of(mapping, face)->outward, 1.0);
    put_along(point, axes_of(mapping, face)->u, uv[0]);
    put_along(point, axes_of(mapping, face)->v, uv[1]);
}

/* The point of a face in the plane of the edge's first face, into which the other one is unfolded:
 * across the edge, and along it. */
static void unfold(const cm_mapping *mapping, const edge *e, int face, const double uv[2],
                   double plane[2])
{
    double point[3];
    point_of_uv(mapping, face, uv, point);
    plane[0] = face == e->face ? along(point, e->crossed) : 2.0 - along(point, e->outward);
    plane[1] = along(point, e->beside);
}

/* Some direction of an edge for t in [-1, 1], not exactly where t is. The edges of healpix are the
 * meridians |x| = |y| up to |z| = 2/3, and that parallel, where z is 2 / sqrt 5 of the distance to the
 * axis. */
static void direction_of_edge(const cm_mapping *mapping, const edge *e, double t,
                              double direction[3])
{
    const double steep = 0.8944271909999159;
    const double quarter = 0.7853981633974483;
    point_of_edge(e, t, direction);
    if (!is_hybrid(mapping))
    {
        return;
    }
    if (abs(e->beside) == CM_AXIS_Z)
    {
        direction[2] *= steep * 1.4142135623730951;
        return;
    }
    int polar_first = abs(e->outward) == CM_AXIS_Z;
    put_along(direction, polar_first ? e->outward : e->crossed, steep);
    put_along(direction, polar_first ? e->crossed : e->outward, cos(quarter * t));
    put_along(direction, e->beside, sin(quarter * t));
}

/* Places along an edge: the ends and beside them, the middle and beside it, random. Most are floats. */
static double place(size_t which)
{
    static const double places[] = {
        0.0,  0x1p-149,      0x1p-100,      0x1p-24,       0.25,          0.5,           1.0 / 3.0,
        0.75, 1.0 - 0x1p-13, 1.0 - 0x1p-20, 1.0 - 0x1p-24, 1.0 - 0x1p-40, 1.0 - 0x1p-53, 1.0};
    if (which < 2 * COUNT(places))
    {
        return which % 2 ? -places[which / 2] : places[which / 2];
    }
    uint64_t state = 77 + which;
    next_bits(&state);
    return (double)(float)next_real(&state);
}

#define PLACES 50

/* ---- The same point of an edge, from both of its faces ---- */

typedef struct meeting
{
    double gap[2]; /* in each precision: the largest difference of a component, eps */
    int tears;
} meeting;

static void meet(const cm_mapping *mapping, const edge *e, double t, meeting *found)
{
    double point[3];
    double uv[2][2];
    point_of_edge(e, t, point);
    uv_of_point(mapping, e->face, point, uv[0]);
    uv_of_point(mapping, e->other, point, uv[1]);
    for (size_t i = 0; i < COUNT(precisions); i++)
    {
        double here[3];
        double there[3];
        inverse(&precisions[i], mapping, e->face, uv[0], here);
        inverse(&precisions[i], mapping, e->other, uv[1], there);
        for (int k = 0; k < 3; k++)
        {
            double gap = fabs(here[k] - there[k]) / precisions[i].eps;
            found->gap[i] = isnan(gap) ? (double)INFINITY : fmax(found->gap[i], gap);
        }
        found->tears += angle_between(here, there) > 1e-3;
    }
}

/* The edges of the cube meet to the bit if u and v are alike, as nothing else differs between the two
 * faces; else within the error of both. */
static void check_meetings(const cm_mapping *mapping, const subject *s)
{
    meeting found = {{0.0, 0.0}, 0};
    int alike = !is_hybrid(mapping) && strcmp(s->specification, "continuous") != 0;
    for (size_t n = 0; n < EDGES * PLACES; n++)
    {
        edge e = edge_of(cm_mapping_frame(mapping), (int)(n / PLACES));
        meet(mapping, &e, place(n % PLACES), &found);
    }
    ck_assert_msg((found.tears > 0) == is_torn(mapping), "%s %s: %d tears", s->specification,
                  cm_mapping_frame(mapping)->identifier, found.tears);
    for (size_t i = 0; i < COUNT(precisions) && !is_torn(mapping); i++)
    {
        ck_assert_msg(found.gap[i] <= (alike ? 0.0 : 2.0 * s->inverse), "%s %s: %g eps in %s",
                      s->specification, cm_mapping_frame(mapping)->identifier, found.gap[i],
                      precisions[i].name);
    }
}

START_TEST(faces_meet_at_their_edges)
{
    for_every_subject(check_meetings);
}
END_TEST

/* Is the signed axis, or its opposite, that of u on the face? */
static int is_along_u(const cm_frame *frame, int face, int axis)
{
    return abs(frame->face[face].u) == abs(axis);
}

/* arvo: the edges along which u goes on one side and v on the other; those along one axis, which is the one
 * that its room names, or in s2 six of them */
START_TEST(tears_of_arvo)
{
    static const struct
    {
        const char *frame;
        int axis;
        int tears;
    } known[] = {{"geo", CM_AXIS_X, 4}, {"fits", CM_AXIS_X, 4}, {"gl", CM_AXIS_Z, 4}, {"s2", 0, 6}};
    for (size_t i = 0; i < COUNT(known); i++)
    {
        const cm_frame *frame = cm_frame_find(known[i].frame);
        cm_mapping *mapping = make_mapping("arvo", frame);
        int sides = 0;
        for (size_t n = 0; n < EDGES; n++)
        {
            edge e = edge_of(frame, (int)n);
            meeting found = {{0.0, 0.0}, 0};
            meet(mapping, &e, 0.5, &found);
            int torn = is_along_u(frame, e.face, e.beside) != is_along_u(frame, e.other, e.beside);
            ck_assert_msg((found.tears > 0) == torn &&
                              (!torn || known[i].axis == 0 || abs(e.beside) == known[i].axis),
                          "%s: edge of face %d with face %d", frame->identifier, e.face, e.other);
            sides += torn;
        }
        ck_assert_int_eq(sides * 12, known[i].tears * (int)EDGES);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

static void corner_point(int corner, double point[3])
{
    for (int k = 0; k < 3; k++)
    {
        point[k] = corner >> k & 1 ? -1.0 : 1.0;
    }
}

/* Three faces meet in a corner. */
static void check_corners(const cm_mapping *mapping, const subject *s)
{
    for (int n = 0; n < 8 * 2 && !is_torn(mapping); n++)
    {
        const precision *p = &precisions[n / 8];
        double point[3];
        double first[3];
        double direction[3];
        double uv[2];
        corner_point(n % 8, point);
        for (int axis = 1; axis <= 3; axis++)
        {
            int outward = point[axis - 1] > 0.0 ? axis : -axis;
            int face = face_with_outward(cm_mapping_frame(mapping), outward);
            uv_of_point(mapping, face, point, uv);
            inverse(p, mapping, face, uv, axis == 1 ? first : direction);
            for (int k = 0; k < 3 && axis > 1; k++)
            {
                double gap = fabs(direction[k] - first[k]) / p->eps;
                ck_assert_msg(gap <= (is_hybrid(mapping) ? 2.0 * s->inverse : 0.0),
                              "%s %s corner %d: %g eps in %s", s->specification,
                              cm_mapping_frame(mapping)->identifier, n % 8, gap, p->name);
            }
        }
    }
}

START_TEST(faces_meet_at_their_corners)
{
    for_every_subject(check_corners);
}
END_TEST

/* ---- Hairs ---- */

/* 0 is one ulp; a precision whose eps is above a hair leaves it out */
static const double hairs[] = {0.0, 1e-15, 1e-12, 1e-8, 1e-6, 1e-4};

/* A direction on one side of an edge or corner, and what became of it. */
typedef struct strand
{
    double in[3];
    double uv[2];
    double out[3];
    int face;
} strand;

/* middle, with one component made smaller by a hair */
static void lay(const precision *p, const cm_mapping *mapping, const double middle[3], int axis,
                double hair, strand *made)
{
    for (int k = 0; k < 3; k++)
    {
        made->in[k] = rounded(p, middle[k]);
    }
    double *component = &made->in[abs(axis) - 1];
    *component = hair > 0.0 ? rounded(p, *component * (1.0 - hair)) : shortened(p, *component);
    made->face = forward(p, mapping, made->in, made->uv);
    inverse(p, mapping, made->face, made->uv, made->out);
}

/* As far apart before the round trip as after it, but for its errors. */
static void check_apart(const cm_mapping *mapping, const subject *s, const precision *p,
                        const strand *a, const strand *b)
{
    double bound = isfinite(s->round_trip) ? s->round_trip * p->eps : sqrt(p->eps);
    double before = angle_between(a->in, b->in);
    double after = angle_between(a->out, b->out);
    REQUIRE(fabs(after - before) <= s->stretch * before + 2.0 * bound,
            "%s %s %s: %.17g %.17g %.17g on face %d and %.17g %.17g %.17g on face %d: %g rad "
            "become %g, by %g eps",
            s->specification, cm_mapping_frame(mapping)->identifier, p->name, a->in[0], a->in[1],
            a->in[2], a->face, b->in[0], b->in[1], b->in[2], b->face, before, after,
            (after - before) / p->eps);
}

/* Gnomonic coordinates change by up to 3 a radian, at a corner, and at an edge no warp makes that more
 * than twice as much; but a conformal one, by the fourth root of the distance from a corner. */
#define STEEPEST 6.0

static double steepness(const cm_mapping *mapping, double t)
{
    int conformal = (cm_mapping_describe(mapping)->properties & CM_CONFORMAL) != 0;
    return conformal ? pow(1.0 - fabs(t), -0.25) : 1.0;
}

/* The two faces are those of the edge, and u and v a hair apart in the unfolded plane. */
static void check_faces(const cm_mapping *mapping, const subject *s, const precision *p,
                        const edge *e, double t, const strand *a, const strand *b)
{
    double plane[2][2];
    REQUIRE(a->face == e->face && b->face == e->other,
            "%s %s %s: %.17g %.17g %.17g and %.17g %.17g %.17g: faces %d %d, not %d %d",
            s->specification, cm_mapping_frame(mapping)->identifier, p->name, a->in[0], a->in[1],
            a->in[2], b->in[0], b->in[1], b->in[2], a->face, b->face, e->face, e->other);
    unfold(mapping, e, a->face, a->uv, plane[0]);
    unfold(mapping, e, b->face, b->uv, plane[1]);
    double most = steepness(mapping, t) *
                  (STEEPEST * angle_between(a->in, b->in) + 2.0 * s->forward * p->eps);
    for (int k = 0; k < 2; k++)
    {
        REQUIRE(
            fabs(plane[0][k] - plane[1][k]) <= most,
            "%s %s %s: %.17g %.17g %.17g and beyond the edge: %d %.17g %.17g and %d %.17g %.17g",
            s->specification, cm_mapping_frame(mapping)->identifier, p->name, a->in[0], a->in[1],
            a->in[2], a->face, a->uv[0], a->uv[1], b->face, b->uv[0], b->uv[1]);
    }
}

static void check_edge_hair(const cm_mapping *mapping, const subject *s, const precision *p,
                            const edge *e, double t, double hair)
{
    double middle[3];
    strand a;
    strand b;
    direction_of_edge(mapping, e, t, middle);
    lay(p, mapping, middle, e->crossed, hair, &a);
    lay(p, mapping, middle, e->outward, hair, &b);
    check_apart(mapping, s, p, &a, &b);
    /* near a corner there is a third face, and near its parallel healpix may take either */
    if (fabs(t) < 1.0 - 4.0 * hair - 16.0 * p->eps && (!is_hybrid(mapping) || hair > 16.0 * p->eps))
    {
        check_faces(mapping, s, p, e, t, &a, &b);
    }
}

static void check_edge_hairs(const cm_mapping *mapping, const subject *s)
{
    for (size_t n = 0; n < EDGES * PLACES * COUNT(hairs) && !is_torn(mapping); n++)
    {
        double hair = hairs[n % COUNT(hairs)];
        edge e = edge_of(cm_mapping_frame(mapping), (int)(n / COUNT(hairs) / PLACES));
        for (size_t i = 0; i < COUNT(precisions); i++)
        {
            if (hair == 0.0 || hair > precisions[i].eps)
            {
                check_edge_hair(mapping, s, &precisions[i], &e, place(n / COUNT(hairs) % PLACES),
                                hair);
            }
        }
    }
}

START_TEST(a_hair_apart_across_edges)
{
    for_every_subject(check_edge_hairs);
}
END_TEST

/* A hair before each of the three faces of a corner, and before two at once: all pairs. */
static void check_corner_hair(const cm_mapping *mapping, const subject *s, const precision *p,
                              int corner, double hair)
{
    double middle[3];
    strand strands[6];
    corner_point(corner, middle);
    middle[2] *= is_hybrid(mapping) ? 0.8944271909999159 * 1.4142135623730951 : 1.0;
    for (int k = 0; k < 3; k++)
    {
        lay(p, mapping, middle, k + 1, hair, &strands[k]);
        lay(p, mapping, strands[k].in, (k + 1) % 3 + 1, hair, &strands[k + 3]);
    }
    for (int a = 0; a < 6; a++)
    {
        for (int b = 0; b < a; b++)
        {
            check_apart(mapping, s, p, &strands[a], &strands[b]);
        }
    }
    REQUIRE(strands[3].face < 6 && strands[4].face < 6 && strands[5].face < 6, "%s: no face",
            s->specification);
    int seen = 1 << strands[3].face | 1 << strands[4].face | 1 << strands[5].face;
    int faces = (seen & 1) + (seen >> 1 & 1) + (seen >> 2 & 1) + (seen >> 3 & 1) + (seen >> 4 & 1) +
                (seen >> 5 & 1);
    REQUIRE(faces == 3 || (is_hybrid(mapping) && hair <= 16.0 * p->eps),
            "%s %s %s: %d faces around corner %d", s->specification,
            cm_mapping_frame(mapping)->identifier, p->name, faces, corner);
}

static void check_corner_hairs(const cm_mapping *mapping, const subject *s)
{
    for (size_t n = 0; n < 8 * COUNT(hairs) && !is_torn(mapping); n++)
    {
        for (size_t i = 0; i < COUNT(precisions); i++)
        {
            if (hairs[n / 8] == 0.0 || hairs[n / 8] > precisions[i].eps)
            {
                check_corner_hair(mapping, s, &precisions[i], (int)(n % 8), hairs[n / 8]);
            }
        }
    }
}

START_TEST(a_hair_apart_around_corners)
{
    for_every_subject(check_corner_hairs);
}
END_TEST

/* ---- Ties ---- */

/* The first of x, y, z with the largest magnitude; on the belt of healpix, of x, y. */
static int winning_axis(const cm_mapping *mapping, const double direction[3])
{
    int axis = 1;
    for (int k = 2; k <= (is_hybrid(mapping) ? 2 : 3); k++)
    {
        axis = fabs(direction[k - 1]) > fabs(direction[axis - 1]) ? k : axis;
    }
    return direction[axis - 1] < 0.0 ? -axis : axis;
}

/* The face is the one that wins, and where another axis is equally long its coordinate is the edge. */
static void check_tie(const cm_mapping *mapping, const subject *s, const precision *p,
                      const double direction[3])
{
    double uv[2];
    double point[3];
    int face = forward(p, mapping, direction, uv);
    int axis = winning_axis(mapping, direction);
    REQUIRE(axes_of(mapping, face)->outward == axis, "%s %s %s: %.17g %.17g %.17g: face %d",
            s->specification, cm_mapping_frame(mapping)->identifier, p->name, direction[0],
            direction[1], direction[2], face);
    point_of_uv(mapping, face, uv, point);
    for (int k = 0; k < (is_hybrid(mapping) ? 2 : 3); k++)
    {
        int equal = fabs(direction[k]) == fabs(direction[abs(axis) - 1]);
        REQUIRE(!equal || point[k] == copysign(1.0, direction[k]),
                "%s %s %s: %.17g %.17g %.17g: face %d, %.17g %.17g", s->specification,
                cm_mapping_frame(mapping)->identifier, p->name, direction[0], direction[1],
                direction[2], face, uv[0], uv[1]);
    }
}

static void check_ties(const cm_mapping *mapping, const subject *s)
{
    static const double scales[] = {1.0, 3.0, 0x1p100, 0x1p-100};
    for (size_t n = 0; n < EDGES * PLACES * COUNT(scales); n++)
    {
        double direction[3];
        double scale = scales[n % COUNT(scales)];
        edge e = edge_of(cm_mapping_frame(mapping), (int)(n / COUNT(scales) / PLACES));
        point_of_edge(&e, (double)(float)place(n / COUNT(scales) % PLACES), direction);
        for (int k = 0; k < 3; k++)
        {
            direction[k] *= scale;
        }
        if (is_hybrid(mapping) && abs(e.beside) != CM_AXIS_Z)
        {
            continue; /* not an edge of healpix, and maybe of a cap */
        }
        /* equal components stay equal, be the product exact or not */
        check_tie(mapping, s, &precisions[0], direction);
        check_tie(mapping, s, &precisions[1], direction);
    }
}

START_TEST(ties_go_to_the_first_axis)
{
    for_every_subject(check_ties);
}
END_TEST

/* What inverse makes of an edge of a face is an edge for forward, and the place along it is the same:
 * the two components are exactly equal. */
static void check_edge_returns(const cm_mapping *mapping, const subject *s, const precision *p,
                               const edge *e, double t)
{
    double point[3];
    double uv[2];
    double direction[3];
    double back[3];
    point_of_edge(e, rounded(p, t), point);
    uv_of_point(mapping, e->face, point, uv);
    inverse(p, mapping, e->face, uv, direction);
    REQUIRE(along(direction, e->outward) == along(direction, e->crossed),
            "%s %s %s: %d %.17g %.17g: %.17g %.17g %.17g is beside the edge", s->specification,
            cm_mapping_frame(mapping)->identifier, p->name, e->face, uv[0], uv[1], direction[0],
            direction[1], direction[2]);
    check_tie(mapping, s, p, direction);
    int face = forward(p, mapping, direction, uv);
    point_of_uv(mapping, face, uv, back);
    /* beyond a tear the place along the edge is another one */
    REQUIRE(
        (is_torn(mapping) && face != e->face) ||
            fabs(along(back, e->beside) - along(point, e->beside)) <= s->plane_round_trip * p->eps,
        "%s %s %s: at %.17g along an edge of face %d, back at %.17g of face %d", s->specification,
        cm_mapping_frame(mapping)->identifier, p->name, t, e->face, along(back, e->beside), face);
}

/* The edges of healpix are irrational, and come back within 2 eps: those of a cap on the belt, and
 * meridians on either side. */
static void check_boundary_returns(const cm_mapping *mapping, const precision *p, const edge *e,
                                   double t)
{
    double point[3];
    double uv[2];
    double direction[3];
    point_of_edge(e, rounded(p, t), point);
    uv_of_point(mapping, e->face, point, uv);
    inverse(p, mapping, e->face, uv, direction);
    int face = forward(p, mapping, direction, uv);
    point_of_uv(mapping, face, uv, point);
    double off = fmax(1.0 - along(point, e->outward), 1.0 - along(point, e->crossed)) / p->eps;
    REQUIRE(abs(axes_of(mapping, face)->outward) != CM_AXIS_Z && off <= 2.0,
            "healpix %s %s: at %.17g along an edge of face %d, back on face %d at %.17g %.17g, "
            "%g eps",
            cm_mapping_frame(mapping)->identifier, p->name, t, e->face, face, uv[0], uv[1], off);
}

static void check_edges_return(const cm_mapping *mapping, const subject *s)
{
    for (size_t n = 0; n < EDGES * PLACES; n++)
    {
        edge e = edge_of(cm_mapping_frame(mapping), (int)(n / PLACES));
        for (size_t i = 0; i < COUNT(precisions); i++)
        {
            if (is_hybrid(mapping))
            {
                check_boundary_returns(mapping, &precisions[i], &e, place(n % PLACES));
            }
            else
            {
                check_edge_returns(mapping, s, &precisions[i], &e, place(n % PLACES));
            }
        }
    }
}

START_TEST(edges_return_to_edges)
{
    for_every_subject(check_edges_return);
}
END_TEST

/* 3 |z| = 2 |d| in whole numbers, exactly: the belt, at its edge */
START_TEST(exact_ties_of_healpix)
{
    static const double quadruples[][3] = {{1.0, 2.0, 2.0},
                                           {2.0, 11.0, 10.0},
                                           {5.0, 10.0, 10.0},
                                           {2.0, 29.0, 26.0},
                                           {19.0, 22.0, 26.0}};
    for (size_t n = 0; n < COUNT(quadruples) * 16 * 3; n++)
    {
        const double *d = quadruples[n / 48];
        cm_mapping *mapping = make_mapping("healpix", cm_frame_at(n % 3));
        int turn = (int)(n / 3 % 16);
        double direction[3] = {turn & 1 ? -d[0] : d[0], turn & 2 ? -d[1] : d[1],
                               turn & 4 ? -d[2] : d[2]};
        if (turn & 8)
        {
            double kept = direction[0];
            direction[0] = direction[1];
            direction[1] = kept;
        }
        for (size_t i = 0; i < COUNT(precisions); i++)
        {
            double uv[2];
            double point[3];
            int face = forward(&precisions[i], mapping, direction, uv);
            point_of_uv(mapping, face, uv, point);
            ck_assert_int_eq(axes_of(mapping, face)->outward, winning_axis(mapping, direction));
            ck_assert_msg(fabs(point[2] - copysign(1.0, direction[2])) <= 2.0 * precisions[i].eps,
                          "%g %g %g: %d %.17g %.17g", direction[0], direction[1], direction[2],
                          face, uv[0], uv[1]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Near an edge of the top or the bottom. lon and lat are on it only where their direction, as rounded,
 * has two components equally long; then the rule is that of directions. */
static int check_lonlat_tie(const cm_mapping *mapping, double lon, double lat)
{
    double direction[3];
    double uv[2];
    double point[3];
    cm_direction_from_lonlat(lon, lat, direction);
    int face = cm_forward_lonlat(mapping, lon, lat, uv);
    int axis = winning_axis(mapping, direction);
    ck_assert_int_eq(axes_of(mapping, face)->outward, axis);
    point_of_uv(mapping, face, uv, point);
    int tie = abs(axis) != CM_AXIS_Z && fabs(direction[2]) == fabs(direction[abs(axis) - 1]);
    ck_assert(!tie || point[2] == copysign(1.0, lat));
    return tie;
}

START_TEST(ties_of_lonlat)
{
    int ties = 0;
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    for (int n = 0; n < 4000; n++)
    {
        double lon = (n % 400 - 199.5) / 200.0 * 3.14159;
        double lat = atan(fmax(fabs(cos(lon)), fabs(sin(lon))));
        for (int step = n / 800; step > 0; step--)
        {
            lat = nextafter(lat, n & 1 ? 0.0 : 2.0);
        }
        ties += check_lonlat_tie(mapping, lon, n / 400 % 2 ? -lat : lat);
    }
    ck_assert_int_gt(ties, 400);
    cm_mapping_destroy(mapping);
}
END_TEST

#ifdef HAVE_QUADMATH

/* ---- Smoothness: one-sided derivatives in quadruple precision ---- */

/* A path crosses a line or an edge at s = 0. The derivatives there, from either side, are those of the
 * polynomial through NODES points of that side, at STEP, 2 STEP, ...; the point s = 0 itself, which may
 * be anyone's, is not used. Derivative d is off by about
 *   - truncation, NODES! d! e STEP^(NODES - d) / R^NODES, e being the d-th elementary symmetric
 *     polynomial of 1, 1/2, ..., 1/NODES, and R the distance to the next singularity, complex ones
 *     included: 0.125 for the inverse of everitt:c=0.5, more elsewhere. For d = 0 to 4 that is 4e-27,
 *     2e-22, 8e-18, 3e-13, 7e-9;
 *   - rounding, 2^-112 times the sum of the weights' magnitudes over STEP^d: 2e-31, 9e-27, 3e-22,
 *     9e-18, 2e-13.
 * A jump up to quiet is none. One of CREASE or more is one: those of the catalogue are of the order of
 * 1. What is between fails the test. */
enum
{
    NODES = 10,
    ORDERS = 5
};
#define STEP 0x1p-14
static const double quiet[ORDERS] = {1e-24, 1e-19, 1e-15, 1e-11, 1e-7};
#define CREASE 1e-3

static quad weights[ORDERS][NODES];

/* The polynomial that is 1 at one node and 0 at the others, multiplied out. */
static void expand_lagrange(int node, quad coefficient[NODES])
{
    int degree = 0;
    coefficient[0] = 1;
    for (int k = 0; k < NODES; k++)
    {
        if (k != node)
        {
            quad divisor = (quad)(node - k);
            coefficient[degree + 1] = coefficient[degree] / divisor;
            for (int d = degree; d > 0; d--)
            {
                coefficient[d] = (coefficient[d - 1] - (quad)(k + 1) * coefficient[d]) / divisor;
            }
            coefficient[0] = -(quad)(k + 1) * coefficient[0] / divisor;
            degree++;
        }
    }
}

static void prepare_weights(void)
{
    for (int i = 0; i < NODES; i++)
    {
        quad coefficient[NODES];
        quad factorial = 1;
        expand_lagrange(i, coefficient);
        for (int d = 0; d < ORDERS; d++)
        {
            weights[d][i] = factorial * coefficient[d];
            factorial *= (quad)(d + 1);
        }
    }
}

typedef enum path_kind
{
    PATH_FORWARD, /* p, q on a face, to u, v */
    PATH_INVERSE, /* u, v on a face, to a direction */
    PATH_ACROSS   /* directions over an edge, to the unfolded plane */
} path_kind;

/* A straight line from + s step. In directions that is a great circle. */
typedef struct path
{
    const cm_mapping *mapping; /* in geo */
    quad_mapping truth;
    path_kind kind;
    int face;
    edge across;
    quad from[3];
    quad step[3];
} path;

static quad quad_along(const quad point[3], int axis)
{
    return axis > 0 ? point[axis - 1] : -point[-axis - 1];
}

static void quad_put_along(quad point[3], int axis, quad value)
{
    point[abs(axis) - 1] = axis > 0 ? value : -value;
}

/* the cube's point of coordinates on a face */
static void quad_point(const path *p, int face, const quad uv[2], quad point[3])
{
    const cm_frame_face *axes = axes_of(p->mapping, face);
    quad_put_along(point, axes->outward, 1);
    quad_put_along(point, axes->u, uv[0]);
    quad_put_along(point, axes->v, uv[1]);
}

/* Where the path is at s; the third value may not be used. */
static void follow(const path *p, quad s, quad value[3])
{
    quad place_of[3] = {p->from[0] + s * p->step[0], p->from[1] + s * p->step[1],
                        p->from[2] + s * p->step[2]};
    quad point[3];
    quad uv[2];
    value[2] = 0;
    if (p->kind == PATH_INVERSE)
    {
        quad_inverse(&p->truth, p->face, place_of, value);
        return;
    }
    if (p->kind == PATH_FORWARD)
    {
        quad_point(p, p->face, place_of, point);
        int face = quad_forward(&p->truth, point, value);
        REQUIRE(face == p->face, "a path leaves face %d", p->face);
        return;
    }
    int face = quad_forward(&p->truth, place_of, uv);
    REQUIRE(face == (s < 0 ? p->across.face : p->across.other),
            "a path from face %d to %d is on %d", p->across.face, p->across.other, face);
    quad_point(p, face, uv, point);
    value[0] =
        s < 0 ? quad_along(point, p->across.crossed) : 2 - quad_along(point, p->across.outward);
    value[1] = quad_along(point, p->across.beside);
}

/* The derivatives from the side to which the step goes; they must be 0 at first. */
static void differentiate_path(const path *p, quad step, quad derivative[ORDERS][3])
{
    for (int i = 0; i < NODES; i++)
    {
        quad value[3];
        quad scale = 1;
        follow(p, (quad)(i + 1) * step, value);
        for (int d = 0; d < ORDERS; d++)
        {
            for (int k = 0; k < 3; k++)
            {
                derivative[d][k] += weights[d][i] * value[k] * scale;
            }
            scale /= step;
        }
    }
}

/* The largest jumps of each derivative. */
static void measure_jumps(const path *p, double jump[ORDERS])
{
    quad derivative[2][ORDERS][3] = {{{0}}};
    differentiate_path(p, (quad)-STEP, derivative[0]);
    differentiate_path(p, (quad)STEP, derivative[1]);
    for (int d = 0; d < ORDERS; d++)
    {
        for (int k = 0; k < 3; k++)
        {
            double difference = (double)fabsq(derivative[1][d][k] - derivative[0][d][k]);
            REQUIRE(isfinite(difference), "a path meets what is no number");
            jump[d] = fmax(jump[d], difference);
        }
    }
}

/* What the jumps say. A crease of the fourth derivative only is C2 too, as there is no other word for it. */
static cm_smoothness smoothness_of(const double jump[ORDERS], const char *specification,
                                   const char *where)
{
    static const cm_smoothness found[ORDERS] = {CM_SMOOTH_TORN, CM_SMOOTH_C0, CM_SMOOTH_C1,
                                                CM_SMOOTH_C2, CM_SMOOTH_C2};
    for (int d = 0; d < ORDERS; d++)
    {
        REQUIRE(jump[d] <= quiet[d] || jump[d] >= CREASE,
                "%s %s: derivative %d jumps by %g, neither nothing nor a crease", specification,
                where, d, jump[d]);
        if (jump[d] >= CREASE)
        {
            return found[d];
        }
    }
    return CM_SMOOTH_ANALYTIC;
}

static void print_jumps(const char *specification, const char *where, const double jump[ORDERS])
{
    printf("%-32s %-18s %8.2g %8.2g %8.2g %8.2g %8.2g\n", specification, where, jump[0], jump[1],
           jump[2], jump[3], jump[4]);
}

/* ---- Inside a face ---- */

/* Lines through the centre of a face where formulas change; then anywhere else. */
enum
{
    AXES,
    DIAGONALS,
    HALVES, /* |q / p| = 1/2 or 2 */
    ELSEWHERE,
    LINES
};
static const char *const line_names[LINES] = {"axes", "diagonals", "halves", "elsewhere"};

#define PATHS 24

/* A point of a line, which keeps clear of the other lines, of the centre, where they meet, and of the
 * boundary of healpix's caps. */
static void point_of_line(int line, int n, uint64_t *state, double point[2])
{
    static const double slopes[] = {0.0, 1.0, 0.5};
    double t = 0.54 + 0.24 * next_real(state);
    double slope = line != ELSEWHERE ? slopes[line]
                   : n & 8           ? 0.25 + 0.15 * next_real(state)
                                     : 0.75 + 0.15 * next_real(state);
    point[n & 1] = n & 2 ? -t : t;
    point[1 - (n & 1)] = n & 4 ? -t * slope : t * slope;
}

/* A direction that is not along the line from the centre to the point. */
static void step_from(const double point[2], uint64_t *state, double step[2])
{
    double across;
    do
    {
        step[0] = next_real(state);
        step[1] = next_real(state);
        across = point[0] * step[1] - point[1] * step[0];
    } while (fabs(across) < 0.2);
}

static void measure_face(path *p, double jump[LINES][ORDERS])
{
    uint64_t state = 41;
    for (int n = 0; n < LINES * PATHS; n++)
    {
        double point[2];
        double step[2];
        int line = n / PATHS;
        point_of_line(line, n, &state, point);
        step_from(point, &state, step);
        for (int k = 0; k < 2; k++)
        {
            p->from[k] = (quad)point[k];
            p->step[k] = (quad)step[k];
        }
        measure_jumps(p, jump[line]);
    }
}

static cm_smoothness claim_for_face(const char *specification, const cm_mapping_info *info)
{
    /* no quadratic is left of it, it is gnomonic */
    return strcmp(specification, "everitt:c=1") == 0 ? CM_SMOOTH_ANALYTIC : info->smooth_face;
}

/* A crease of the first derivative is on the diagonals of a face, and of slice on its axes as well, one
 * of the second on its axes, and of seamless one of the third on the diagonals; docs/guide/mappings.md says so of
 * those that have them. */
static void check_where(const char *specification, double jump[LINES][ORDERS])
{
    int sliced = strcmp(specification, "slice") == 0;
    int seamless = strcmp(specification, "seamless") == 0;
    for (int line = 0; line < LINES; line++)
    {
        cm_smoothness found = smoothness_of(jump[line], specification, line_names[line]);
        REQUIRE(found == CM_SMOOTH_ANALYTIC || (found == CM_SMOOTH_C0 && line == DIAGONALS) ||
                    (found == CM_SMOOTH_C0 && line == AXES && sliced) ||
                    (found == CM_SMOOTH_C1 && line == AXES) ||
                    (found == CM_SMOOTH_C2 && line == DIAGONALS && seamless),
                "%s: smoothness %d on the %s", specification, (int)found, line_names[line]);
    }
}

static void check_smooth_face(const char *specification)
{
    static const char *const names[] = {"forward", "inverse"};
    cm_mapping *mapping = make_mapping(specification, NULL);
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    cm_smoothness claim = claim_for_face(specification, info);
    for (int kind = PATH_FORWARD; kind <= PATH_INVERSE; kind++)
    {
        double jump[LINES][ORDERS] = {{0.0}};
        double worst[ORDERS] = {0.0};
        for (int face = 0; face < 6; face += 4) /* one of the belt, one of the caps */
        {
            path p = {.mapping = mapping,
                      .truth = quad_from(mapping),
                      .kind = (path_kind)kind,
                      .face = face};
            measure_face(&p, jump);
        }
        for (int n = 0; n < LINES * ORDERS; n++)
        {
            worst[n % ORDERS] = fmax(worst[n % ORDERS], jump[n / ORDERS][n % ORDERS]);
        }
        print_jumps(specification, names[kind], worst);
        cm_smoothness found = smoothness_of(worst, specification, names[kind]);
        REQUIRE(found == claim, "%s on a face, %s: smoothness %d, claimed is %d", specification,
                names[kind], (int)found, (int)claim);
        check_where(specification, jump);
    }
    cm_mapping_destroy(mapping);
}

START_TEST(smoothness_on_a_face)
{
    prepare_weights();
    list_subjects();
    puts("jumps of derivatives 0 to 4");
    for (size_t i = 0; i < subject_count; i++)
    {
        check_smooth_face(subjects[i].specification);
    }
}
END_TEST

/* ---- At the corners and at the centre of a face ---- */

/* There lines meet, and what is not smooth may depend on where one comes from. Along the ray from the point to
 * (x, y) the derivative d of a smooth map is a form of degree d in x and y, so of rays to x + y = 1 it is a polynomial
 * of degree d in x: its differences of order d + 1 vanish. That of derivative 0 is by how much the rays do
 * not end together, from values so near that a power of the distance with exponent 3/4 is little there. */
enum
{
    RAYS = 8
};
#define NEAR 0x1p-60
#define TOGETHER 1e-13
#define RAY_STEP (STEP / 8) /* a singularity of everitt:c=1.8 is near the corner */

typedef struct fan
{
    double from[2];
    double inwards[2]; /* signs */
    double first;      /* x of the rays */
    double between;
} fan;

static void differentiate_ray(path *p, const fan *f, int ray, quad derivative[ORDERS][3])
{
    quad x = (quad)f->first + ray * (quad)f->between;
    memset(derivative, 0, ORDERS * sizeof derivative[0]);
    for (int k = 0; k < 2; k++)
    {
        p->from[k] = (quad)f->from[k];
        p->step[k] = (quad)f->inwards[k] * (k == 0 ? x : 1 - x);
    }
    differentiate_path(p, (quad)RAY_STEP, derivative);
    follow(p, (quad)NEAR, derivative[0]);
}

static void measure_fan(path *p, const fan *f, double jump[ORDERS])
{
    quad derivative[RAYS][ORDERS][3];
    for (int ray = 0; ray < RAYS; ray++)
    {
        differentiate_ray(p, f, ray, derivative[ray]);
    }
    for (int n = 0; n < ORDERS * 3; n++)
    {
        quad difference[RAYS];
        int d = n / 3;
        for (int ray = 0; ray < RAYS; ray++)
        {
            difference[ray] = derivative[ray][d][n % 3];
        }
        for (int order = 0; order <= d; order++)
        {
            for (int ray = 0; ray + 1 < RAYS - order; ray++)
            {
                difference[ray] = difference[ray + 1] - difference[ray];
            }
        }
        for (int ray = 0; ray + 1 < RAYS - d; ray++)
        {
            REQUIRE(isfinite((double)difference[ray]), "a ray meets what is no number");
            jump[d] = fmax(jump[d], (double)fabsq(difference[ray]));
        }
    }
}

/* How many derivatives are continuous. */
static int order_of(cm_smoothness smoothness)
{
    static const int orders[] = {-1, 0, 1, 2, ORDERS - 1};
    return orders[smoothness];
}

static void check_point(const char *specification, const char *where, const double jump[ORDERS],
                        cm_smoothness claim)
{
    print_jumps(specification, where, jump);
    for (int d = 0; d <= order_of(claim); d++)
    {
        /* differences of up to five orders make 32 of one rounding */
        REQUIRE(jump[d] <= (d == 0 ? TOGETHER : 32.0 * quiet[d]),
                "%s at the %s: claimed is %s, but derivative %d jumps by %g", specification, where,
                cm_smoothness_name(claim), d, jump[d]);
    }
}

static void check_smooth_points(const char *specification)
{
    cm_mapping *mapping = make_mapping(specification, NULL);
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    cm_smoothness claim = info->smooth_corner;
    double corner[ORDERS] = {0.0};
    double centre[ORDERS] = {0.0};
    for (int n = 0; n < 2 * 4 * 2; n++) /* a face of the belt and one of the caps */
    {
        path p = {.mapping = mapping,
                  .truth = quad_from(mapping),
                  .kind = n & 1 ? PATH_FORWARD : PATH_INVERSE,
                  .face = n & 2 ? 4 : 0};
        double signs[2] = {n & 4 ? -1.0 : 1.0, n & 8 ? -1.0 : 1.0};
        /* none along an edge, an axis or a diagonal */
        const fan at_corner = {{signs[0], signs[1]}, {-signs[0], -signs[1]}, 0.0625, 0.125};
        const fan at_centre = {{0.0, 0.0}, {signs[0], signs[1]}, -0.9, 0.4};
        if (p.kind == PATH_INVERSE || !is_hybrid(mapping)) /* whose corners are not the cube's */
        {
            measure_fan(&p, &at_corner, corner);
        }
        measure_fan(&p, &at_centre, centre);
    }
    check_point(specification, "corner", corner, claim);
    check_point(specification, "centre", centre, claim_for_face(specification, info));
    int next = order_of(claim) + 1;
    /* with l1 = 0.4 difference is nearly algebraic */
    REQUIRE(next == ORDERS || corner[next] >= CREASE / 2.0,
            "%s is smoother at its corners than %s: derivative %d jumps by %g", specification,
            cm_smoothness_name(claim), next, next == ORDERS ? 0.0 : corner[next]);
    cm_mapping_destroy(mapping);
}

START_TEST(smoothness_at_points)
{
    prepare_weights();
    list_subjects();
    for (size_t i = 0; i < subject_count; i++)
    {
        /* the edges of this one are flat, so that its inverse is a square root there */
        if (strcmp(subjects[i].specification, "smoothstep:c=1") != 0)
        {
            check_smooth_points(subjects[i].specification);
        }
    }
}
END_TEST

/* ---- Across the edges ---- */

/* As direction_of_edge, and exactly on it. */
static void quad_direction_of_edge(const cm_mapping *mapping, const edge *e, double t,
                                   quad direction[3])
{
    quad_put_along(direction, e->outward, 1);
    quad_put_along(direction, e->crossed, 1);
    quad_put_along(direction, e->beside, (quad)t);
    if (is_hybrid(mapping) && abs(e->beside) != CM_AXIS_Z)
    {
        int polar_first = abs(e->outward) == CM_AXIS_Z;
        quad angle = atanq((quad)1) * (quad)t;
        quad_put_along(direction, polar_first ? e->outward : e->crossed, 2 / sqrtq((quad)5));
        quad_put_along(direction, polar_first ? e->crossed : e->outward, cosq(angle));
        quad_put_along(direction, e->beside, sinq(angle));
    }
}

static void measure_edge(path *p, double jump[ORDERS])
{
    uint64_t state = 19;
    /* where the map is not smooth at the corners these are to stay as far away as singularities must */
    int cornered = strcmp(cm_mapping_describe(p->mapping)->identifier, "difference") == 0;
    double most = cornered ? 0.6 : 0.9;
    for (int n = 0; n < 15; n++)
    {
        double t = n < 3 ? 0.0 : most * next_real(&state);
        quad_direction_of_edge(p->mapping, &p->across, t, p->from);
        /* towards the other face: outward gets less, across more; and somewhat along the edge */
        quad_put_along(p->step, p->across.outward, (quad)(0.25 * (next_real(&state) - 1.0)));
        quad_put_along(p->step, p->across.crossed, (quad)(0.75 + 0.25 * next_real(&state)));
        quad_put_along(p->step, p->across.beside, (quad)(0.3 * next_real(&state)));
        measure_jumps(p, jump);
    }
}

static void check_smooth_edges(const char *specification)
{
    cm_mapping *mapping = make_mapping(specification, NULL);
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    double jump[2][ORDERS] = {{0.0}}; /* the second of the belt of healpix */
    for (int n = 0; n < EDGES; n++)
    {
        path p = {.mapping = mapping,
                  .truth = quad_from(mapping),
                  .kind = PATH_ACROSS,
                  .across = edge_of(cm_mapping_frame(mapping), n)};
        measure_edge(&p, jump[is_hybrid(mapping) && abs(p.across.beside) == CM_AXIS_Z]);
    }
    print_jumps(specification, "edges", jump[0]);
    cm_smoothness found = smoothness_of(jump[0], specification, "edges");
    REQUIRE(found == info->smooth_edge, "%s across edges: smoothness %d, claimed is %d",
            specification, (int)found, (int)info->smooth_edge);
    if (is_hybrid(mapping))
    {
        /* Lambert's cylinder, cut into four faces */
        print_jumps(specification, "edges of the belt", jump[1]);
        REQUIRE(smoothness_of(jump[1], specification, "edges of the belt") == CM_SMOOTH_ANALYTIC,
                "healpix has a crease on a meridian");
    }
    cm_mapping_destroy(mapping);
}

START_TEST(smoothness_across_edges)
{
    prepare_weights();
    list_subjects();
    for (size_t i = 0; i < subject_count; i++)
    {
        check_smooth_edges(subjects[i].specification);
    }
}
END_TEST

/* ---- Kinks: the angle by which the image of a great circle bends that crosses a line at a right angle */

static double bend(const path *p)
{
    quad derivative[2][ORDERS][3] = {{{0}}};
    double before[3];
    double after[3];
    differentiate_path(p, (quad)-STEP / 64, derivative[0]);
    differentiate_path(p, (quad)STEP / 64, derivative[1]);
    for (int k = 0; k < 3; k++)
    {
        before[k] = (double)derivative[0][1][k];
        after[k] = (double)derivative[1][1][k];
    }
    return angle_between(before, after) * 57.29577951308232;
}

enum
{
    KINK_AXIS,
    KINK_DIAGONAL,
    KINK_EDGE,
    KINKS
};

/* At p = q = t or q = 0 of the first face of geo, or between it and the next at z = t. */
static double kink_at(const cm_mapping *mapping, int line, double t)
{
    path p = {.mapping = mapping,
              .truth = quad_from(mapping),
              .kind = line == KINK_EDGE ? PATH_ACROSS : PATH_FORWARD,
              .across = edge_of(cm_mapping_frame(mapping), 1)};
    if (line == KINK_EDGE)
    {
        quad_direction_of_edge(mapping, &p.across, t, p.from);
        quad_put_along(p.step, p.across.outward, -1);
        quad_put_along(p.step, p.across.crossed, 1);
        return bend(&p);
    }
    p.from[0] = (quad)t;
    p.from[1] = line == KINK_AXIS ? 0 : (quad)t;
    p.step[0] = line == KINK_AXIS ? 0 : 1;
    p.step[1] = line == KINK_AXIS ? 1 : -1;
    return bend(&p);
}

START_TEST(kinks_of_equal_area_mappings)
{
    /* degrees, the least upper bounds over a line */
    static const struct
    {
        const char *specification;
        double most[KINKS];
    } known[] = {{"slice", {3.985, 2.630, 0.0}}, {"qsc", {0.0, 47.105, 12.966}}};
    prepare_weights();
    for (size_t i = 0; i < COUNT(known); i++)
    {
        cm_mapping *mapping = make_mapping(known[i].specification, NULL);
        for (int line = 0; line < KINKS; line++)
        {
            double most = 0.0;
            for (int n = 1; n < 1000; n++)
            {
                most = fmax(most, kink_at(mapping, line, n / 1000.0));
            }
            printf("%s: kinks of up to %.4f degrees\n", known[i].specification, most);
            REQUIRE(fabs(most - known[i].most[line]) <= (known[i].most[line] > 0.0 ? 0.01 : 1e-6),
                    "%s, line %d: kinks of up to %g degrees", known[i].specification, line, most);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

#else

START_TEST(smoothness_on_a_face)
{
    puts("smoothness: skipped, no libquadmath");
}
END_TEST

START_TEST(smoothness_across_edges)
{
}
END_TEST

START_TEST(kinks_of_equal_area_mappings)
{
}
END_TEST

START_TEST(smoothness_at_points)
{
}
END_TEST

#endif

int main(void)
{
    const TTest *tests[] = {faces_meet_at_their_edges,
                            tears_of_arvo,
                            faces_meet_at_their_corners,
                            a_hair_apart_across_edges,
                            a_hair_apart_around_corners,
                            ties_go_to_the_first_axis,
                            edges_return_to_edges,
                            exact_ties_of_healpix,
                            ties_of_lonlat,
                            smoothness_on_a_face,
                            smoothness_at_points,
                            smoothness_across_edges,
                            kinks_of_equal_area_mappings,
                            NULL};
    return run_suite("continuity", tests);
}
