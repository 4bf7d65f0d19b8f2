/* SPDX-License-Identifier: MIT
 *
 * Advice (cubemap/advise.h): which mappings keep limits, in which order, and what the others miss. Times are made up.
 */
#include "tests/suite.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define DEGREE (3.14159265358979324 / 180.0)

enum
{
    ROWS_MAX = 24
};

typedef struct table
{
    cm_advice_costs costs;
    cm_advice_cost row[ROWS_MAX];
} table;

static void add(table *t, const char *specification, cm_precision precision, double ns)
{
    t->costs.size = sizeof t->costs;
    t->row[t->costs.count++] = (cm_advice_cost){.specification = specification,
                                                .precision = precision,
                                                .ns = {ns, ns},
                                                .single_ns = {10.0 * ns, 10.0 * ns}};
    t->costs.cost = t->row;
}

static cm_advice_request request_of(int limit, double value)
{
    cm_advice_request request = {.size = sizeof request};
    if (limit >= 0)
    {
        request.limited = 1u << limit;
        request.limit[limit] = value;
    }
    return request;
}

static cm_advice *advise(const cm_advice_request *request, const table *t)
{
    cm_advice *advice = NULL;
    const cm_status status = cm_advise(request, &t->costs, &advice);
    REQUIRE(status == CM_OK, "%s", cm_status_text(status));
    ck_assert_uint_eq(cm_advice_count(advice), t->costs.count);
    ck_assert_ptr_null(cm_advice_at(advice, t->costs.count));
    return advice;
}

static const char *name_at(const cm_advice *advice, size_t index)
{
    return cm_advice_at(advice, index)->specification;
}

static const char *reason_at(const cm_advice *advice, size_t index)
{
    static char text[CM_ADVICE_TEXT];
    cm_advice_reason(advice, index, text, sizeof text);
    return text;
}

/* ---- Edges ---- */

/* The cheapest equal-area mapping is torn: it may not be the advice where nobody said that tears do not matter. */
START_TEST(torn_ones_are_last)
{
    table t = {0};
    cm_advice_request request = request_of(-1, 0.0);
    add(&t, "arvo", CM_PRECISION_DOUBLE, 1.0);
    add(&t, "qsc", CM_PRECISION_DOUBLE, 3.0);
    add(&t, "slice", CM_PRECISION_DOUBLE, 2.0);
    add(&t, "gnomonic", CM_PRECISION_DOUBLE, 0.5);
    request.equal_area = 1;
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 3);
    ck_assert_str_eq(name_at(advice, 0), "slice");
    ck_assert_str_eq(name_at(advice, 1), "qsc");
    ck_assert_str_eq(name_at(advice, 2), "arvo");
    ck_assert_str_eq(reason_at(advice, 2), "");
    ck_assert_str_eq(name_at(advice, 3), "gnomonic");
    ck_assert_str_eq(reason_at(advice, 3), "not equal-area, area error 1.721");
    cm_advice_destroy(advice);
    request.edge = CM_SMOOTH_C0;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 2);
    ck_assert_str_eq(name_at(advice, 3), "arvo");
    ck_assert_str_eq(reason_at(advice, 3), "torn across edges");
    ck_assert_int_eq(cm_advice_at(advice, 3)->is_near, 1);
    cm_advice_destroy(advice);
    request.edge = CM_SMOOTH_C1;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_str_eq(name_at(advice, 0), "slice");
    ck_assert_str_eq(name_at(advice, 1), "arvo");
    ck_assert_str_eq(name_at(advice, 2), "qsc");
    ck_assert_str_eq(reason_at(advice, 2), "not so smooth across edges");
    cm_advice_destroy(advice);
}
END_TEST

/* What is asked to be smooth may not be torn either. */
START_TEST(smooth_is_not_torn)
{
    table t = {0};
    cm_advice_request request = request_of(-1, 0.0);
    add(&t, "arvo", CM_PRECISION_DOUBLE, 1.0);
    add(&t, "coupled", CM_PRECISION_DOUBLE, 2.0);
    add(&t, "qsc", CM_PRECISION_DOUBLE, 3.0);
    request.smooth = CM_SMOOTH_C1;
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_str_eq(name_at(advice, 0), "coupled");
    ck_assert_str_eq(reason_at(advice, 1), "torn across edges");
    ck_assert_str_eq(reason_at(advice, 2), "not so smooth on a face");
    ck_assert_uint_eq(cm_advice_at(advice, 1)->missed, 1u << CM_LIMIT_EDGE);
    ck_assert_uint_eq(cm_advice_at(advice, 2)->missed, 1u << CM_LIMIT_SMOOTH);
    cm_advice_destroy(advice);
}
END_TEST

/* ---- Distortion ---- */

/* Exact mappings keep limits of 0 and 1, though they are computed to 1e-14. */
START_TEST(rounding_is_no_distortion)
{
    static const struct
    {
        int limit;
        double value;
        const char *exact;
    } rows[] = {{CM_LIMIT_AREA, 0.0, "qsc"},
                {CM_LIMIT_AREA_RMSE, 0.0, "qsc"},
                {CM_LIMIT_ISOTROPY, 1.0, "conformal"},
                {CM_LIMIT_ISOTROPY_MEAN, 1.0, "conformal"},
                {CM_LIMIT_DEFORMATION, 0.0, "conformal"}};
    for (size_t i = 0; i < COUNT(rows); i++)
    {
        table t = {0};
        add(&t, rows[i].exact, CM_PRECISION_DOUBLE, 3.0);
        add(&t, "coupled-cubic", CM_PRECISION_DOUBLE, 1.0);
        const cm_advice_request request = request_of(rows[i].limit, rows[i].value);
        cm_advice *advice = advise(&request, &t);
        REQUIRE(cm_advice_qualified(advice) == 1 && strcmp(name_at(advice, 0), rows[i].exact) == 0,
                "%s, then %s", cm_limit_name((cm_limit)rows[i].limit), reason_at(advice, 0));
        cm_advice_destroy(advice);
    }
}
END_TEST

/* Each value is that of the statistics, and limits are kept up to and including them. */
START_TEST(means_and_maxima)
{
    table t = {0};
    add(&t, "tangent", CM_PRECISION_DOUBLE, 3.0);
    cm_advice_request request = request_of(-1, 0.0);
    cm_advice *advice = advise(&request, &t);
    const cm_advice_candidate *c = cm_advice_at(advice, 0);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    static const cm_quantity quantities[] = {CM_QUANTITY_AREA, CM_QUANTITY_ISOTROPY,
                                             CM_QUANTITY_DEFORMATION};
    cm_statistics s[3];
    for (int i = 0; i < 3; i++)
    {
        s[i].size = sizeof s[i];
        ck_assert(cm_distortion_statistics(mapping, quantities[i], NULL, &s[i]) == CM_OK);
    }
    const double expected[] = {s[0].maximum_error, s[0].rmse,    s[1].maximum, s[1].mean,
                               s[1].rmse,          s[2].maximum, s[2].mean,    s[2].rmse};
    for (int k = 0; k < 8; k++)
    {
        REQUIRE(fabs(c->value[k] - expected[k]) <= 2e-6 * expected[k], "%s: %.17g, not %.17g",
                cm_limit_name((cm_limit)k), c->value[k], expected[k]);
        request = request_of(k, c->value[k]);
        cm_advice *other = advise(&request, &t);
        ck_assert_uint_eq(cm_advice_qualified(other), 1);
        cm_advice_destroy(other);
        request = request_of(k, c->value[k] * 0.99);
        other = advise(&request, &t);
        ck_assert_uint_eq(cm_advice_qualified(other), 0);
        ck_assert_uint_eq(cm_advice_at(other, 0)->missed, 1u << k);
        ck_assert_int_eq(cm_advice_at(other, 0)->is_near, 1);
        REQUIRE(strstr(reason_at(other, 0), cm_limit_name((cm_limit)k)) == reason_at(other, 0),
                "%s", reason_at(other, 0));
        cm_advice_destroy(other);
    }
    cm_mapping_destroy(mapping);
    cm_advice_destroy(advice);
}
END_TEST

/* Angles are said in degrees, and everything that is missed is said. */
START_TEST(reasons)
{
    table t = {0};
    add(&t, "gnomonic", CM_PRECISION_FLOAT, 3.0);
    cm_advice_request request = request_of(CM_LIMIT_DEFORMATION, 30.0 * DEGREE);
    request.limited |= 1u << CM_LIMIT_COST | 1u << CM_LIMIT_ERROR | 1u << CM_LIMIT_AREA;
    request.limit[CM_LIMIT_COST] = 2.0;
    request.limit[CM_LIMIT_ERROR] = 0.5;
    request.limit[CM_LIMIT_AREA] = (double)INFINITY;
    request.edge = CM_SMOOTH_C1;
    request.precisions = 1u << CM_PRECISION_DOUBLE;
    cm_advice *advice = advise(&request, &t);
    ck_assert_str_eq(reason_at(advice, 0),
                     "deformation 31.08 degrees, 1.08 more than 30; ns 3, 1 more than 2; "
                     "error 0.5316 m, 0.0316 more than 0.5; not so smooth across edges; "
                     "precision float, which is not asked for");
    char little[12];
    cm_advice_reason(advice, 0, little, sizeof little);
    ck_assert_str_eq(little, "deformation");
    cm_advice_reason(advice, 1, little, sizeof little);
    ck_assert_str_eq(little, "");
    cm_advice_reason(advice, 0, NULL, 0);
    cm_advice_destroy(advice);
}
END_TEST

/* ---- Precision and errors ---- */

/* Two metres are kept by float and by the fast tier: they are proposed, and are cheaper. */
START_TEST(float_is_proposed)
{
    table t = {0};
    add(&t, "algebraic", CM_PRECISION_DOUBLE, 3.0);
    add(&t, "algebraic", CM_PRECISION_FLOAT, 1.0);
    add(&t, "algebraic", CM_PRECISION_FAST, 2.0);
    add(&t, "gnomonic", CM_PRECISION_FAST, 9.0); /* which is exact */
    cm_advice_request request = request_of(CM_LIMIT_ERROR, 2.0);
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 4);
    static const double errors[] = {2.7 * 0x1p-24, 3.7 * 0x1p-24, 2.7 * 0x1p-53, 1.4 * 0x1p-53};
    static const cm_precision precisions[] = {CM_PRECISION_FLOAT, CM_PRECISION_FAST,
                                              CM_PRECISION_DOUBLE, CM_PRECISION_FAST};
    for (size_t i = 0; i < 4; i++)
    {
        const cm_advice_candidate *c = cm_advice_at(advice, i);
        ck_assert_int_eq((int)c->precision, (int)precisions[i]);
        ck_assert(fabs(c->value[CM_LIMIT_ERROR] / (errors[i] * EARTH_RADIUS) - 1.0) < 1e-6);
    }
    cm_advice_destroy(advice);
    /* who says nothing of errors wants double */
    request = request_of(-1, 0.0);
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_int_eq((int)cm_advice_at(advice, 0)->precision, CM_PRECISION_DOUBLE);
    cm_advice_destroy(advice);
}
END_TEST

/* Float cannot keep a micrometre: that double does is said, and it is the nearest. */
START_TEST(double_would_do)
{
    table t = {0};
    add(&t, "algebraic", CM_PRECISION_FLOAT, 1.0);
    add(&t, "algebraic", CM_PRECISION_DOUBLE, 3.0);
    cm_advice_request request = request_of(CM_LIMIT_ERROR, 1e-6);
    request.precisions = 1u << CM_PRECISION_FLOAT;
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 0);
    const cm_advice_candidate *c = cm_advice_at(advice, 0);
    ck_assert_int_eq((int)c->precision, CM_PRECISION_DOUBLE);
    ck_assert_int_eq(c->is_near, 1);
    ck_assert_str_eq(reason_at(advice, 0), "precision double, which is not asked for");
    ck_assert_int_eq(cm_advice_at(advice, 1)->is_near, 0);
    ck_assert_str_eq(reason_at(advice, 1), "error 1.025 m, 1.03 more than 1e-06");
    cm_advice_destroy(advice);
    /* where float is enough, double is dearer and no news; where double is asked for, cheaper float is */
    request.limit[CM_LIMIT_ERROR] = 2.0;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_int_eq(cm_advice_at(advice, 1)->is_near, 0);
    cm_advice_destroy(advice);
    request.precisions = 1u << CM_PRECISION_DOUBLE;
    advice = advise(&request, &t);
    ck_assert_int_eq((int)cm_advice_at(advice, 0)->precision, CM_PRECISION_DOUBLE);
    ck_assert_int_eq(cm_advice_at(advice, 1)->is_near, 1);
    cm_advice_destroy(advice);
}
END_TEST

/* Presets have the bounds of their mapping; other parameters have no promise, which is said. */
START_TEST(presets_have_bounds)
{
    table t = {0};
    add(&t, "difference:mild", CM_PRECISION_DOUBLE, 1.0);
    add(&t, "difference:kappa=0.5397097196288356,l1=0.1719858275482514,l2=0.2296337469790219",
        CM_PRECISION_DOUBLE, 2.0);
    add(&t, "tangent:c=1.5", CM_PRECISION_DOUBLE, 3.0);
    const cm_advice_request request = request_of(CM_LIMIT_ERROR, 1e-8);
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 2);
    ck_assert_str_eq(name_at(advice, 0), "difference:mild");
    ck_assert_str_eq(reason_at(advice, 2), "no promise of its error with these parameters");
    ck_assert(isnan(cm_advice_at(advice, 2)->value[CM_LIMIT_ERROR]));
    ck_assert(isinf(cm_advice_at(advice, 2)->excess));
    ck_assert_int_eq(cm_advice_at(advice, 2)->is_near, 0);
    cm_advice_destroy(advice);
}
END_TEST

/* ---- Order ---- */

/* One that misses a limit by little is told though it is dearer, if it is better in something; else not. */
START_TEST(near_misses)
{
    table t = {0};
    cm_advice_request request = request_of(CM_LIMIT_ISOTROPY, 1.5);
    add(&t, "slice", CM_PRECISION_DOUBLE, 5.0);
    add(&t, "difference:mild", CM_PRECISION_DOUBLE, 6.0); /* 1.543; smoother inside */
    add(&t, "gnomonic", CM_PRECISION_DOUBLE, 7.0);        /* 1.732; smoother inside */
    add(&t, "healpix", CM_PRECISION_DOUBLE, 4.0);         /* 2.433 */
    add(&t, "coupled-cubic", CM_PRECISION_DOUBLE, 8.0);
    cm_advice *advice = advise(&request, &t);
    static const char *const order[] = {"slice", "difference:mild", "gnomonic", "coupled-cubic",
                                        "healpix"};
    static const int near[] = {0, 1, 1, 1, 0};
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    for (size_t i = 0; i < COUNT(order); i++)
    {
        ck_assert_str_eq(name_at(advice, i), order[i]);
        ck_assert_int_eq(cm_advice_at(advice, i)->is_near, near[i]);
    }
    ck_assert(fabs(cm_advice_at(advice, 1)->excess - (1.5434 / 1.5 - 1.0)) < 1e-4);
    cm_advice_destroy(advice);
    /* exactly equal areas are missed by little at 1e-5, not at 1.7 */
    request = request_of(-1, 0.0);
    request.equal_area = 1;
    advice = advise(&request, &t);
    for (size_t i = cm_advice_qualified(advice); i < cm_advice_count(advice); i++)
    {
        int is_nearly_equal = strcmp(name_at(advice, i), "coupled-cubic") == 0;
        ck_assert_int_eq(cm_advice_at(advice, i)->is_near, is_nearly_equal);
    }
    cm_advice_destroy(advice);
    /* smoothness by a step: what is dearer and not better is no news */
    request = request_of(CM_LIMIT_COST, 4.9);
    table alike = {0};
    add(&alike, "gnomonic", CM_PRECISION_DOUBLE, 4.0);
    add(&alike, "gnomonic", CM_PRECISION_DOUBLE, 5.0);
    advice = advise(&request, &alike);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_int_eq(cm_advice_at(advice, 1)->is_near, 0);
    ck_assert_uint_eq(cm_advice_at(advice, 1)->index, 1);
    cm_advice_destroy(advice);
}
END_TEST

START_TEST(steps_of_smoothness)
{
    table t = {0};
    cm_advice_request request = request_of(-1, 0.0);
    add(&t, "s2", CM_PRECISION_DOUBLE, 1.0);    /* C1 */
    add(&t, "slice", CM_PRECISION_DOUBLE, 2.0); /* C0 */
    request.smooth = CM_SMOOTH_C1;
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_int_eq(cm_advice_at(advice, 1)->is_near, 1);
    cm_advice_destroy(advice);
    request.smooth = CM_SMOOTH_ANALYTIC;
    request.edge = CM_SMOOTH_C1;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 0);
    ck_assert_str_eq(name_at(advice, 0), "slice");
    ck_assert_int_eq(cm_advice_at(advice, 0)->is_near, 0); /* more than a step */
    cm_advice_destroy(advice);
}
END_TEST

/* Costs: the slower direction asked for, of arrays or of single points; what is unknown is dearest. */
START_TEST(times)
{
    table t = {0};
    add(&t, "gnomonic", CM_PRECISION_DOUBLE, 0.0);
    add(&t, "tangent", CM_PRECISION_DOUBLE, 2.0);
    add(&t, "algebraic", CM_PRECISION_DOUBLE, 0.0);
    t.row[0].ns[0] = 1.0;
    t.row[0].ns[1] = 5.0;
    t.row[0].single_ns[0] = 30.0;
    t.row[2].ns[0] = (double)NAN;
    cm_advice_request request = request_of(-1, 0.0);
    static const struct
    {
        unsigned directions;
        int single;
        const char *first;
        double ns;
    } rows[] = {{0, 0, "tangent", 2.0},
                {CM_ADVICE_FORWARD, 0, "gnomonic", 1.0},
                {CM_ADVICE_INVERSE, 0, "algebraic", 0.0},
                {CM_ADVICE_FORWARD | CM_ADVICE_INVERSE, 1, "algebraic", 0.0},
                {CM_ADVICE_INVERSE, 1, "gnomonic", 0.0}};
    for (size_t i = 0; i < COUNT(rows); i++)
    {
        request.directions = rows[i].directions;
        request.single = rows[i].single;
        cm_advice *advice = advise(&request, &t);
        ck_assert_str_eq(name_at(advice, 0), rows[i].first);
        ck_assert(cm_advice_at(advice, 0)->value[CM_LIMIT_COST] == rows[i].ns);
        cm_advice_destroy(advice);
    }
    request = request_of(CM_LIMIT_COST, 3.0);
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_str_eq(name_at(advice, 2), "algebraic");
    ck_assert_str_eq(reason_at(advice, 2), "its time is not known");
    cm_advice_destroy(advice);
}
END_TEST

/* ---- Ellipsoids ---- */

/* Random places of a grid on the ellipsoid, against the bounds of the candidate. */
static void check_on_grid(const cm_advice_candidate *c, const cm_ellipsoid *ellipsoid)
{
    const cm_grid_options options = {
        .size = sizeof options, .mapping = c->specification, .ellipsoid = ellipsoid};
    cm_grid *grid = NULL;
    ck_assert(cm_grid_create(&options, &grid) == CM_OK);
    ck_assert_int_eq((int)cm_grid_latitude(grid), (int)c->latitude);
    uint64_t state = 5;
    double area = cm_ellipsoid_area(ellipsoid) / (ellipsoid->a * ellipsoid->a * 24.0);
    double worst = 1.0;
    for (int i = 0; i < 20000; i += (int)step_of(10))
    {
        double normal[3];
        double back[3];
        double uv[2];
        cm_distortion d;
        next_direction(&state, normal);
        cm_grid_forward_distortion(grid, normal, &d);
        worst = fmax(worst, d.isotropy);
        REQUIRE(d.isotropy <= c->value[CM_LIMIT_ISOTROPY] + CM_ADVICE_ROUNDING &&
                    d.deformation <= c->value[CM_LIMIT_DEFORMATION] + CM_ADVICE_ROUNDING &&
                    fabs(d.scale * area - 1.0) <= c->value[CM_LIMIT_AREA] + CM_ADVICE_ROUNDING,
                "%s on %s: D_I %.17g, area %.17g", c->specification, ellipsoid->identifier,
                d.isotropy, d.scale * area);
        uint8_t face = cm_grid_forward(grid, normal, uv);
        cm_grid_inverse(grid, face, uv, back);
        double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        double apart = hypot(hypot(back[0] - normal[0] / length, back[1] - normal[1] / length),
                             back[2] - normal[2] / length);
        REQUIRE(apart * ellipsoid->a <= c->value[CM_LIMIT_ERROR], "%s on %s: %g m, not %g m",
                c->specification, ellipsoid->identifier, apart * ellipsoid->a,
                c->value[CM_LIMIT_ERROR]);
    }
    /* the bounds are not wide: what the latitude adds is of the size of the flattening */
    REQUIRE(c->value[CM_LIMIT_ISOTROPY] <= worst * 1.02 + 4.0 * fabs(ellipsoid->f),
            "%s on %s: %g, not %g", c->specification, ellipsoid->identifier, worst,
            c->value[CM_LIMIT_ISOTROPY]);
    cm_grid_destroy(grid);
}

START_TEST(ellipsoids)
{
    static const char *const names[] = {"WGS84", "Jupiter", "6378137,-50"};
    for (size_t i = 0; i < COUNT(names); i++)
    {
        cm_ellipsoid ellipsoid;
        table t = {0};
        ck_assert(cm_ellipsoid_parse(names[i], &ellipsoid, NULL, 0) == CM_OK);
        add(&t, "tangent", CM_PRECISION_DOUBLE, 1.0);
        add(&t, "qsc", CM_PRECISION_DOUBLE, 2.0);
        add(&t, "conformal", CM_PRECISION_DOUBLE, 3.0);
        t.costs.latitude_ns[0] = 7.0;
        t.costs.latitude_single_ns[1] = 70.0;
        cm_advice_request request = request_of(-1, 0.0);
        request.ellipsoid = &ellipsoid;
        cm_advice *advice = advise(&request, &t);
        static const cm_latitude latitudes[] = {CM_LATITUDE_AUTHALIC, CM_LATITUDE_AUTHALIC,
                                                CM_LATITUDE_CONFORMAL};
        for (size_t k = 0; k < 3; k++)
        {
            const cm_advice_candidate *c = cm_advice_at(advice, k);
            ck_assert_int_eq((int)c->latitude, (int)latitudes[k]);
            ck_assert(c->value[CM_LIMIT_COST] == 8.0 + (double)k);
            check_on_grid(c, &ellipsoid);
        }
        /* equal areas stay so, and shapes */
        ck_assert(cm_advice_at(advice, 1)->value[CM_LIMIT_AREA] < CM_ADVICE_ROUNDING);
        ck_assert(cm_advice_at(advice, 2)->value[CM_LIMIT_ISOTROPY] < 1.0 + CM_ADVICE_ROUNDING);
        cm_advice_destroy(advice);
        request.single = 1;
        t.costs.count = 1;
        advice = advise(&request, &t);
        ck_assert(cm_advice_at(advice, 0)->value[CM_LIMIT_COST] == 80.0);
        cm_advice_destroy(advice);
    }
}
END_TEST

/* A limit of the error is shared with the latitude's series; float has no grids. */
START_TEST(errors_on_ellipsoids)
{
    table t = {0};
    add(&t, "tangent", CM_PRECISION_DOUBLE, 3.0);
    add(&t, "tangent", CM_PRECISION_FAST, 2.0);
    add(&t, "tangent", CM_PRECISION_FLOAT, 1.0);
    cm_advice_request request = request_of(CM_LIMIT_ERROR, 2.0);
    request.ellipsoid = cm_ellipsoid_find("WGS84");
    cm_advice *advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 2);
    ck_assert_int_eq((int)cm_advice_at(advice, 0)->precision, CM_PRECISION_FAST);
    double error = cm_advice_at(advice, 1)->value[CM_LIMIT_ERROR];
    REQUIRE(error > 1e-3 && error < 0.5, "%g m", error);
    ck_assert_str_eq(reason_at(advice, 2), "precision float, which has no grids on ellipsoids");
    ck_assert_int_eq(cm_advice_at(advice, 2)->is_near, 0);
    cm_advice_destroy(advice);
    request.precisions = 1u << CM_PRECISION_DOUBLE;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    ck_assert_str_eq(reason_at(advice, 1), "precision float, which has no grids on ellipsoids");
    ck_assert_str_eq(reason_at(advice, 2), "precision fast, which is not asked for");
    ck_assert_int_eq(cm_advice_at(advice, 2)->is_near, 1);
    cm_advice_destroy(advice);
    request.precisions = 0;
    request.limit[CM_LIMIT_ERROR] = 5e-9;
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 0);
    request.limit[CM_LIMIT_ERROR] = 2e-8;
    cm_advice_destroy(advice);
    advice = advise(&request, &t);
    ck_assert_uint_eq(cm_advice_qualified(advice), 1);
    cm_advice_destroy(advice);
}
END_TEST

/* ---- What is refused ---- */

static void refuse(const cm_advice_request *request, const cm_advice_costs *costs, cm_status status)
{
    cm_advice *advice = NULL;
    const cm_status found = cm_advise(request, costs, &advice);
    REQUIRE(found == status && advice == NULL, "%s, not %s", cm_status_text(found),
            cm_status_text(status));
}

START_TEST(wrong_requests)
{
    table t = {0};
    add(&t, "gnomonic", CM_PRECISION_DOUBLE, 1.0);
    const cm_advice_request good = request_of(-1, 0.0);
    cm_advice_request wrong[12];
    for (size_t i = 0; i < COUNT(wrong); i++)
    {
        wrong[i] = good;
    }
    wrong[0].size--;
    wrong[1].limited = 1u << CM_LIMIT_NUMBERS;
    wrong[2] = request_of(CM_LIMIT_AREA, -1.0);
    wrong[3] = request_of(CM_LIMIT_ISOTROPY, 0.5);
    wrong[4] = request_of(CM_LIMIT_ISOTROPY_MEAN, 0.5);
    wrong[5] = request_of(CM_LIMIT_ERROR, (double)NAN);
    wrong[6].smooth = (cm_smoothness)(CM_SMOOTH_ANALYTIC + 1);
    wrong[7].edge = (cm_smoothness)(CM_SMOOTH_ANALYTIC + 1);
    wrong[8].precisions = 8u;
    wrong[9].directions = 4u;
    wrong[10].smooth = (cm_smoothness)(-1);
    wrong[11].limited = 1u << 31;
    for (size_t i = 0; i < COUNT(wrong); i++)
    {
        refuse(&wrong[i], &t.costs, CM_ERROR_ARGUMENT);
    }
    refuse(NULL, &t.costs, CM_ERROR_ARGUMENT);
    refuse(&good, NULL, CM_ERROR_ARGUMENT);
    ck_assert(cm_advise(&good, &t.costs, NULL) == CM_ERROR_ARGUMENT);
    cm_ellipsoid none = *cm_ellipsoid_find("WGS84");
    none.f = 2.0;
    cm_advice_request request = good;
    request.ellipsoid = &none;
    refuse(&request, &t.costs, CM_ERROR_ELLIPSOID);
}
END_TEST

START_TEST(wrong_costs)
{
    const cm_advice_request request = request_of(-1, 0.0);
    const table none = {{.size = sizeof none.costs}, {{0}}};
    cm_advice *advice = advise(&request, &none);
    ck_assert_uint_eq(cm_advice_qualified(advice), 0);
    cm_advice_destroy(advice);
    table t = {0};
    add(&t, "gnomonic", CM_PRECISION_DOUBLE, 1.0);
    const table good = t;
    t.costs.cost = t.row;
    t.costs.size--;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.costs = good.costs;
    t.costs.cost = NULL;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.costs.cost = t.row;
    t.costs.latitude_ns[1] = -1.0;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.costs.latitude_ns[1] = 0.0;
    t.costs.latitude_single_ns[0] = -1.0;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.costs.latitude_single_ns[0] = 0.0;
    t.row[0].ns[1] = -1.0;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.row[0] = good.row[0];
    t.row[0].single_ns[0] = -1.0;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.row[0] = good.row[0];
    t.row[0].specification = NULL;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    t.row[0].specification = "no_such";
    refuse(&request, &t.costs, CM_ERROR_MAPPING);
    t.row[0].specification = "peirce";
    refuse(&request, &t.costs, CM_ERROR_UNSUPPORTED);
    t.row[0] = good.row[0];
    t.row[0].precision = (cm_precision)CM_PRECISION_COUNT;
    refuse(&request, &t.costs, CM_ERROR_ARGUMENT);
    cm_advice_destroy(NULL);
    for (int k = 0; k < CM_LIMIT_COUNT; k++)
    {
        ck_assert_ptr_nonnull(cm_limit_name((cm_limit)k));
    }
    ck_assert_ptr_null(cm_limit_name((cm_limit)CM_LIMIT_COUNT));
    ck_assert_ptr_null(cm_precision_name((cm_precision)CM_PRECISION_COUNT));
    ck_assert_str_eq(cm_precision_name(CM_PRECISION_FAST), "fast");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {torn_ones_are_last,
                                  smooth_is_not_torn,
                                  rounding_is_no_distortion,
                                  means_and_maxima,
                                  reasons,
                                  float_is_proposed,
                                  double_would_do,
                                  presets_have_bounds,
                                  near_misses,
                                  steps_of_smoothness,
                                  times,
                                  ellipsoids,
                                  errors_on_ellipsoids,
                                  wrong_requests,
                                  wrong_costs,
                                  NULL};
    return run_suite("advice", tests);
}
