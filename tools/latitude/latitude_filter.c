/* SPDX-License-Identifier: MIT */
#include "latitude_filter.h"

#include <math.h>
#include <stdlib.h>

#include "tools/cli/degrees.h"
#include "tools/cli/line_filter.h"

static const double pole = 1.5707963267948966;
static const double degree = 0.017453292519943295;

struct filter
{
    const struct latitude_options *options;
    const cm_latitude_conversion *conversion;
    double flattening;
    struct line_filter lines;
    double latitude[BATCH_LINES];
};

/* Beside a pole degrees say more than radians, and an ellipsoid far from a sphere shows it. */
static void by_directions(const cm_latitude_conversion *conversion, size_t n, double *latitude)
{
    double x[BATCH_LINES] = {0.0};
    double y[BATCH_LINES] = {0.0};
    double z[BATCH_LINES] = {0.0};
    for (size_t i = 0; i < n; i++)
    {
        degrees_sine_cosine(latitude[i], &z[i], &x[i]);
    }
    cm_latitude_convert_direction_array(conversion, n, x, y, z, x, y, z);
    for (size_t i = 0; i < n; i++)
    {
        latitude[i] = degrees_atan2(z[i], x[i]);
    }
}

/* The difference is small, and it alone has the errors of the ways to radians and back. */
static void by_differences(const cm_latitude_conversion *conversion, size_t n, double *latitude)
{
    double before[BATCH_LINES] = {0.0};
    double after[BATCH_LINES];
    for (size_t i = 0; i < n; i++)
    {
        before[i] = fabs(latitude[i]) == 90.0 ? copysign(pole, latitude[i]) : latitude[i] * degree;
    }
    cm_latitude_convert_array(conversion, n, before, after);
    for (size_t i = 0; i < n; i++)
    {
        latitude[i] += (after[i] - before[i]) / degree;
    }
}

void latitude_degrees(const cm_latitude_conversion *conversion, double flattening, size_t n,
                      double *latitude)
{
    if (fabs(flattening) <= CM_LATITUDE_SERIES_FLATTENING)
    {
        by_differences(conversion, n, latitude);
    }
    else
    {
        by_directions(conversion, n, latitude);
    }
}

static void clear_latitude(void *user, size_t index)
{
    ((struct filter *)user)->latitude[index] = 0.0;
}

static bool take_latitude(void *user, size_t index, const double value[LINE_NUMBERS_MAX])
{
    struct filter *const filter = user;
    const bool radians = filter->options->radians;
    if (!(fabs(value[0]) <= (radians ? pole + 1e-9 : 90.0)))
    {
        line_complain(&filter->lines, index, "the latitude, %.17g, is not in %s", value[0],
                      radians ? "[-pi/2, pi/2]" : "[-90, 90]");
        return false;
    }
    filter->latitude[index] = value[0];
    return true;
}

static void compute(void *user, size_t count)
{
    struct filter *const filter = user;
    if (filter->options->radians)
    {
        cm_latitude_convert_array(filter->conversion, count, filter->latitude, filter->latitude);
    }
    else
    {
        latitude_degrees(filter->conversion, filter->flattening, count, filter->latitude);
    }
}

/* By contract each latitude that passed our check has one; if the library breaks it, nobody is misled. */
static bool check_latitude(void *user, size_t index)
{
    struct filter *const filter = user;
    if (isnan(filter->latitude[index]))
    {
        line_complain(&filter->lines, index, "the conversion gives no result here");
        return false;
    }
    return true;
}

static void put_latitude(void *user, size_t index)
{
    struct filter *const filter = user;
    line_put_number(&filter->lines, filter->latitude[index], true);
}

static const struct line_work work = {.clear = clear_latitude,
                                      .take = take_latitude,
                                      .compute = compute,
                                      .check = check_latitude,
                                      .put = put_latitude};

bool filter_latitudes(const struct latitude_options *options, const cm_ellipsoid *ellipsoid,
                      const cm_latitude_conversion *conversion, const cm_streams *streams,
                      const char *name, cm_failure *failure)
{
    struct filter *const filter = calloc(1, sizeof *filter);
    if (filter == NULL)
    {
        return fail(failure, EXIT_FAILURE, "no memory");
    }
    filter->options = options;
    filter->conversion = conversion;
    filter->flattening = ellipsoid->f;
    filter->lines.work = &work;
    filter->lines.user = filter;
    filter->lines.name = name;
    filter->lines.in = streams->in;
    filter->lines.out = streams->out;
    filter->lines.err = streams->err;
    filter->lines.failure = failure;
    filter->lines.digits = options->digits;
    filter->lines.count = 1;
    filter->lines.wanted = options->radians ? "a LATITUDE in radians" : "a LATITUDE in degrees";
    filter->lines.bad = "nan";
    const bool all_good = line_filter_run(&filter->lines);
    free(filter);
    return all_good;
}
