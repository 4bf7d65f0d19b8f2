/* SPDX-License-Identifier: MIT
 *
 * The catalogue against itself, and specifications good and bad.
 */
#include "tests/suite.h"

static const cm_mapping_info *at(size_t i)
{
    return cm_catalogue_at(i);
}

START_TEST(descriptors_are_complete)
{
    ck_assert_uint_ge(cm_catalogue_count(), 16);
    ck_assert_ptr_null(at(cm_catalogue_count()));
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        ck_assert_uint_gt(strlen(at(i)->identifier), 0);
        ck_assert_uint_gt(strlen(at(i)->name), 0);
        ck_assert_uint_gt(strlen(at(i)->source), 0);
        ck_assert_ptr_nonnull(at(i)->aliases);
        ck_assert_uint_le(at(i)->parameter_count, CM_PARAMETERS_MAX);
        ck_assert_int_ge((int)at(i)->smooth_face, (int)CM_SMOOTH_C0);
        ck_assert(at(i)->kind != CM_KIND_CUBE || at(i)->smooth_corner >= CM_SMOOTH_C0);
        for (size_t k = 0; k < at(i)->parameter_count; k++)
        {
            const cm_parameter_info *p = &at(i)->parameter[k];
            ck_assert_uint_gt(strlen(p->name), 0);
            ck_assert_uint_gt(strlen(p->meaning), 0);
            ck_assert(p->low < p->high);
            ck_assert(p->standard <= p->high && p->standard >= p->low);
            ck_assert(!(p->low_excluded && p->standard == p->low));
        }
    }
}
END_TEST

START_TEST(smoothness_has_names)
{
    ck_assert_str_eq(cm_smoothness_name(CM_SMOOTH_TORN), "torn");
    ck_assert_str_eq(cm_smoothness_name(CM_SMOOTH_C0), "C0");
    ck_assert_str_eq(cm_smoothness_name(CM_SMOOTH_C1), "C1");
    ck_assert_str_eq(cm_smoothness_name(CM_SMOOTH_C2), "C2");
    ck_assert_str_eq(cm_smoothness_name(CM_SMOOTH_ANALYTIC), "analytic");
    ck_assert_ptr_null(cm_smoothness_name((cm_smoothness)(CM_SMOOTH_ANALYTIC + 1)));
}
END_TEST

/* Where a rounding of u and v is far more on the sphere somewhere no round trip is promised: catalogue.h. */
static int is_flat(const cm_mapping_info *info)
{
    return strcmp(info->identifier, "border") == 0 ||
           strcmp(info->identifier, "azimuthal:orthographic") == 0;
}

/* What the project promises of every mapping; truth/certificate holds the mappings to their bounds. */
START_TEST(bounds_keep_the_promise)
{
    const double earth_nanometres = EARTH_RADIUS * 1e9 * 0x1p-53;
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_bounds *bounds = &at(i)->bounds;
        /* where a quarter or more of a turn is one unit of u, roundings are more */
        double most = at(i)->family == CM_FAMILY_UNIVARIATE ? 2.0
                      : at(i)->kind == CM_KIND_CUBE         ? 5.0
                                                            : 5.7;
        int is_stated = bounds->round_trip > 0.0;
        ck_assert_msg(is_stated != is_flat(at(i)) && bounds->round_trip * earth_nanometres <= most,
                      "%s: %g nm", at(i)->identifier, bounds->round_trip * earth_nanometres);
        ck_assert(bounds->round_trip * 0x1p-24 <= 1e-6);
        ck_assert(bounds->plane_round_trip > 0.0);
        ck_assert(bounds->forward > 0.0 && bounds->forward <= 8.0);
        ck_assert(bounds->inverse > 0.0 && bounds->inverse <= 8.0);
        ck_assert((bounds->relative > 0.0 || at(i)->kind == CM_KIND_LAYOUT) &&
                  bounds->relative <= 16.0);
    }
}
END_TEST

/* Where an alias fixes parameters or parts, which are not its name: "asc:c=1", "peirce:stereographic,..."; the
 * colon of "azimuthal:lambert" fixes nothing. */
static void cut_name(char *name)
{
    char *colon = strrchr(name, ':');
    if (colon != NULL && strpbrk(colon, "=,") != NULL)
    {
        *colon = '\0';
    }
}

START_TEST(names_are_unique_and_found)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        char names[256];
        snprintf(names, sizeof names, "%s %s", at(i)->identifier, at(i)->aliases);
        for (char *name = strtok(names, " "); name != NULL; name = strtok(NULL, " "))
        {
            char upper[64];
            cut_name(name);
            ck_assert_msg(cm_catalogue_find(name) == at(i), "%s", name);
            size_t length = strlen(name);
            for (size_t c = 0; c <= length; c++)
            {
                upper[c] = (char)(name[c] >= 'a' && name[c] <= 'z' ? name[c] - 32 : name[c]);
            }
            ck_assert_msg(cm_catalogue_find(upper) == at(i), "%s", upper);
            ck_assert_int_eq(cm_specification_check(name, NULL, 0), CM_OK);
        }
    }
    ck_assert_ptr_nonnull(cm_catalogue_find(CM_MAPPING_RECOMMENDED));
    ck_assert_ptr_null(cm_catalogue_find("tangen"));
    ck_assert_ptr_null(cm_catalogue_find(""));
    ck_assert_ptr_null(cm_catalogue_find(NULL));
    ck_assert_ptr_null(cm_catalogue_find("asc:c=1"));
}
END_TEST

START_TEST(the_mappings_of_the_plan_are_there)
{
    static const char *const names[] = {
        "gnomonic",   "tsc",           "standard",     "tangent",
        "asc",        "eac",           "outerra",      "osc",
        "cobe",       "csc",           "qsc",          "nowell",
        "ksc",        "unicube",       "everitt",      "s2",
        "algebraic",  "coupled",       "difference",   "logistic",
        "smoothstep", "continuous",    "tanh",         "healpix",
        "slice",      "arvo",          "zucker-cobe",  "zucker-quintic",
        "corner",     "coupled-cubic", "coupled-lean", "seamless"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    {
        ck_assert_msg(cm_catalogue_find(names[i]) != NULL, "%s", names[i]);
    }
}
END_TEST

/* Aliases for what others have published with other formulas; tests/vectors has those formulas' values. */
START_TEST(aliases_of_other_formulas)
{
    cm_mapping *mapping = NULL;
    ck_assert_ptr_eq(cm_catalogue_find("snyder"), cm_catalogue_find("qsc"));
    ck_assert_ptr_eq(cm_catalogue_find("rosca-plonka"), cm_catalogue_find("qsc"));
    ck_assert_ptr_eq(cm_catalogue_find("slice-and-dice"), cm_catalogue_find("slice"));
    ck_assert_int_eq(cm_mapping_create("equi-edge", NULL, &mapping), CM_OK);
    ck_assert_ptr_eq(cm_mapping_describe(mapping), cm_catalogue_find("tangent"));
    ck_assert(cm_mapping_parameter(mapping, 0) == sqrt(0.5));
    cm_mapping_destroy(mapping);
}
END_TEST

static void expect(const char *specification, cm_status status, const char *part)
{
    char message[256] = "untouched";
    cm_status got = cm_specification_check(specification, message, sizeof message);
    ck_assert_msg(got == status, "%s: status %d, not %d", specification, got, status);
    if (status == CM_OK)
    {
        ck_assert_str_eq(message, "untouched");
    }
    else
    {
        cm_mapping *mapping = NULL;
        ck_assert_msg(strstr(message, part) != NULL, "%s: %s", specification, message);
        ck_assert_ptr_null(strchr(message, '\n'));
        ck_assert_int_eq(cm_mapping_create(specification, NULL, &mapping), status);
        ck_assert_ptr_null(mapping);
    }
}

START_TEST(specifications)
{
    expect("tangent:c=1.1823", CM_OK, "");
    expect("Tangent:C=1.5e0", CM_OK, "");
    expect("tangent:c=4", CM_OK, "");
    expect("tangent:c=4.0000001", CM_ERROR_RANGE, "(0, 4]");
    expect("tangent:c=0", CM_ERROR_RANGE, "(0, 4]");
    expect("tangent:c=-1", CM_ERROR_RANGE, "tangent");
    expect("algebraic:c=0", CM_OK, "");
    expect("cobe:legacy=1", CM_OK, "");
    expect("cobe:legacy=0.5", CM_ERROR_RANGE, "whole");
    expect("tangent:", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
    expect("tangent:c", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
    expect("tangent:c=", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1x", CM_ERROR_SYNTAX, "number");
    expect("tangent:c= 1", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=0x1p0", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=nan", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=inf", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e999", CM_ERROR_RANGE, "(0, 4]");
    expect("tangent:c=1,5", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
    expect("tangent:c=1,", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
    expect("tangent:d=1", CM_ERROR_PARAMETER, "it has c");
    expect("tangent:c=1,c=2", CM_ERROR_PARAMETER, "twice");
    expect("qsc:c=1", CM_ERROR_PARAMETER, "none");
    expect("asc:c=1", CM_ERROR_PARAMETER, "tangent:c=1");
    expect("tangens", CM_ERROR_MAPPING, "tangens");
    expect("", CM_ERROR_SYNTAX, "coupled");
    expect(":c=1", CM_ERROR_SYNTAX, "coupled");
    expect("a\nb", CM_ERROR_MAPPING, "a?b");
    expect("a\177b", CM_ERROR_MAPPING, "a?b");
    expect("tangent:c=1.2.3", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=-", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e-", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e+x", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e/", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=e5", CM_ERROR_SYNTAX, "number");
    expect("tangent:c=1e12345678901234567890", CM_ERROR_RANGE, "(0, 4]");
    expect("tangent:c=1000000000000000000000000000000000000000000000000", CM_ERROR_RANGE,
           "1000000");
    ck_assert_int_eq(cm_specification_check(NULL, NULL, 0), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(layouts_name_two_parts)
{
    expect("border", CM_OK, "");
    expect("border:lon=10", CM_OK, "");
    expect("border:lambert:shirley", CM_OK, "");
    expect("quincuncial:mixture,shirley,beta=0", CM_OK, "");
    expect("border:lambert", CM_ERROR_SYNTAX, "needs two: border:AZIMUTHAL,SQUARE");
    expect("border:lambert,shirley,radial", CM_ERROR_SYNTAX, "one part too many");
    expect("border:", CM_ERROR_MAPPING, "there is no azimuthal:;");
    expect("border:lamberd,shirley", CM_ERROR_MAPPING, "there is no azimuthal:lamberd;");
    expect("border:lambert,shirly", CM_ERROR_MAPPING, "as in border:lambert,shirley");
    expect("border:lambert,a-word-that-is-longer-than-anything-that-could-be-the-name-of-a-part",
           CM_ERROR_MAPPING, "there is no square:a-word");
    expect("border:stereographic,shirley", CM_ERROR_PARAMETER, "no map of the whole sphere");
    expect("quincuncial:gnomonic,shirley", CM_ERROR_PARAMETER, "no map of a hemisphere");
    expect("border:lambert,shirley,beta=1", CM_ERROR_PARAMETER, "no parameter 'beta'");
    expect("border:mixture,shirley,beta=0", CM_ERROR_RANGE, "(0, 1]");
    expect("border:lambert,shirley,lon=1,lon=2", CM_ERROR_PARAMETER, "twice");
    expect("border:lambert,shirley,fov=90", CM_ERROR_PARAMETER, "it has lon, lat, beta");
    expect("peirce:lon=10", CM_ERROR_PARAMETER, "quincuncial:stereographic,conformal");
}
END_TEST

START_TEST(azimuthal_projections_show_one_field)
{
    expect("azimuthal:lambert:full=1", CM_OK, "");
    expect("azimuthal:lambert:fov=360", CM_OK, "");
    expect("azimuthal:lambert:fov=90,full=1", CM_ERROR_PARAMETER, "either fov or full");
    expect("azimuthal:lambert:fov=360.1", CM_ERROR_RANGE, "360]");
    expect("azimuthal:stereographic:fov=360", CM_ERROR_RANGE, "359]");
    expect("azimuthal:mixture:beta=0", CM_OK, "");
    expect("azimuthal:mixture:beta=0,full=1", CM_ERROR_RANGE, "(0, 1]");
    expect("azimuthal:mixture:beta=0,fov=360", CM_ERROR_RANGE, "(0, 1]");
    expect("azimuthal:lambird", CM_ERROR_MAPPING, "comes one of lambert, stereographic, ");
    expect("azimuthal", CM_ERROR_MAPPING, "comes one of lambert");
    expect("Square:round", CM_ERROR_MAPPING, "comes one of radial, shirley, ");
    expect("square:shirley:c=1", CM_ERROR_PARAMETER, "takes none");
}
END_TEST

/* In upper case, and with another end. */
static void expect_loud(const char *specification, const char *end, cm_status status,
                        const char *part)
{
    char text[128];
    size_t length = (size_t)snprintf(text, sizeof text, "%s%s", specification, end);
    for (size_t i = 0; i < length; i++)
    {
        text[i] = (char)(text[i] >= 'a' && text[i] <= 'z' ? text[i] - 32 : text[i]);
    }
    expect(text, status, part);
}

static void check_preset(const cm_mapping_info *info, const char *preset)
{
    char text[96];
    char spelled[200];
    const char *values = preset + strcspn(preset, ":") + 1;
    snprintf(text, sizeof text, "%s:%.*s", info->identifier, (int)strcspn(preset, ":"), preset);
    snprintf(spelled, sizeof spelled, "%s:%.*s", info->identifier, (int)strcspn(values, " "),
             values);
    expect(text, CM_OK, "");
    expect(spelled, CM_OK, "");
    expect_loud(text, "", CM_OK, "");
    expect_loud(text, ",", CM_ERROR_PARAMETER, "stands alone");
    expect_loud(text, ",x=1", CM_ERROR_PARAMETER, "stands alone");
    expect_loud(text, "x", CM_ERROR_SYNTAX, "preset");
    cm_mapping *named = make_mapping(text, NULL);
    cm_mapping *written = make_mapping(spelled, NULL);
    for (size_t k = 0; k < info->parameter_count; k++)
    {
        ck_assert_msg(cm_mapping_parameter(named, k) == cm_mapping_parameter(written, k), "%s: %s",
                      text, info->parameter[k].name);
    }
    const double direction[3] = {0.7, -0.31, 0.2};
    double uv[2][2];
    ck_assert_int_eq(cm_forward(named, direction, uv[0]), cm_forward(written, direction, uv[1]));
    ck_assert_mem_eq(uv[0], uv[1], sizeof uv[0]);
    cm_mapping_destroy(named);
    cm_mapping_destroy(written);
}

START_TEST(presets)
{
    size_t count = 0;
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const char *preset = at(i)->presets == NULL ? "" : at(i)->presets;
        for (; *preset != '\0'; count++)
        {
            check_preset(at(i), preset);
            preset += strcspn(preset, " ");
            preset += strspn(preset, " ");
        }
    }
    ck_assert_uint_ge(count, 3);
    expect("difference:", CM_ERROR_SYNTAX,
           "preset of difference, which are mild, balanced, isotropic");
    expect("difference:wild", CM_ERROR_SYNTAX, "'wild' is neither a preset of difference");
    expect("difference:mild,l1=0.2", CM_ERROR_PARAMETER,
           "preset 'mild' of difference stands alone");
    expect("difference:l1=0.2,mild", CM_ERROR_PARAMETER,
           "preset 'mild' of difference stands alone");
    expect("difference:mild,isotropic", CM_ERROR_PARAMETER, "stands alone");
    expect("difference:mild=1", CM_ERROR_PARAMETER, "it has kappa, l1, l2");
    expect("difference:L2=0.3,KAPPA=0.5", CM_OK, "");
    expect("difference:kappa=0.2", CM_ERROR_RANGE, "[0.3, 1]");
    expect("coupled-cubic:LOW", CM_OK, "");
    expect("coupled-cubic:low=1", CM_OK, "");
    expect("coupled-cubic:low,low=1", CM_ERROR_PARAMETER, "stands alone");
    expect("coupled_cubic", CM_ERROR_MAPPING, "coupled_cubic");
    expect("tangent:mild", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
    expect("qsc:mild", CM_ERROR_SYNTAX, "PARAMETER=VALUE");
}
END_TEST

/* what a preset leaves out, and what nobody gives, is the standard value */
START_TEST(standard_values)
{
    cm_mapping *mapping = make_mapping("difference:l2=0.5", NULL);
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    ck_assert(cm_mapping_parameter(mapping, 0) == info->parameter[0].standard);
    ck_assert(cm_mapping_parameter(mapping, 1) == info->parameter[1].standard);
    ck_assert(cm_mapping_parameter(mapping, 2) == 0.5);
    cm_mapping_destroy(mapping);
    cm_mapping *preset = make_mapping("difference:balanced", NULL);
    for (size_t k = 0; k < info->parameter_count; k++)
    {
        ck_assert(cm_mapping_parameter(preset, k) == info->parameter[k].standard);
    }
    cm_mapping_destroy(preset);
}
END_TEST

/* NAME:PARAMETER=VALUE; beta is of the mixture alone. */
static void write_value(char *text, size_t size, const cm_mapping_info *info,
                        const cm_parameter_info *p, double value)
{
    int needs_part = info->parts != NULL && strcmp(p->name, "beta") == 0;
    snprintf(text, size, "%s:%s%s=%.17g", info->identifier, needs_part ? "mixture,shirley," : "",
             p->name, value);
}

/* The value of an end of a range that another parameter excludes. */
static int is_excluded(const cm_mapping_info *info, const cm_parameter_info *p)
{
    return p->low_excluded ||
           (strcmp(info->identifier, "border") == 0 && strcmp(p->name, "beta") == 0);
}

/* every parameter at both ends of its range, and one step beyond */
START_TEST(ranges_are_what_they_say)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        for (size_t k = 0; k < at(i)->parameter_count; k++)
        {
            const cm_parameter_info *p = &at(i)->parameter[k];
            char text[128];
            double beyond = nextafter(p->high, INFINITY);
            double below = nextafter(p->low, -INFINITY);
            write_value(text, sizeof text, at(i), p, p->high);
            expect(text, CM_OK, "");
            write_value(text, sizeof text, at(i), p, beyond);
            expect(text, CM_ERROR_RANGE, p->name);
            write_value(text, sizeof text, at(i), p, p->low);
            expect(text, is_excluded(at(i), p) ? CM_ERROR_RANGE : CM_OK, p->name);
            write_value(text, sizeof text, at(i), p, below);
            expect(text, CM_ERROR_RANGE, p->name);
        }
    }
}
END_TEST

/* names and values that are longer than a message shows of them */
START_TEST(long_words_are_cut)
{
    static const char long_word[] =
        "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz";
    char text[200];
    char message[256];
    static const char *const before[] = {"", "tangent:", "tangent:c="};
    for (size_t i = 0; i < sizeof before / sizeof before[0]; i++)
    {
        snprintf(text, sizeof text, "%s%s", before[i], long_word);
        ck_assert_int_ne(cm_specification_check(text, message, sizeof message), CM_OK);
        ck_assert_ptr_null(strstr(message, long_word));
        ck_assert_ptr_nonnull(strstr(message, "abcdefghijklmnopqrstuvwxyzabcdefghijklmn"));
    }
}
END_TEST

START_TEST(messages_fit_their_buffer)
{
    for (size_t size = 0; size < 40; size++)
    {
        char message[48];
        memset(message, 'x', sizeof message);
        cm_specification_check("no such mapping", message, size);
        ck_assert(size == 0 || memchr(message, '\0', size) != NULL);
        for (size_t i = size; i < sizeof message; i++)
        {
            ck_assert_int_eq(message[i], 'x');
        }
    }
}
END_TEST

START_TEST(parameters_are_kept)
{
    cm_mapping *mapping = make_mapping("tangent:c=1.1823", NULL);
    ck_assert(cm_mapping_parameter(mapping, 0) == 1.1823);
    ck_assert(isnan(cm_mapping_parameter(mapping, 1)));
    ck_assert_ptr_eq(cm_mapping_describe(mapping), cm_catalogue_find("tangent"));
    ck_assert_str_eq(cm_mapping_frame(mapping)->identifier, "geo");
    cm_mapping_destroy(mapping);
    mapping = make_mapping("zucker", cm_frame_find("gl"));
    ck_assert(cm_mapping_parameter(mapping, 0) == 1.1823);
    ck_assert_str_eq(cm_mapping_frame(mapping)->identifier, "gl");
    cm_mapping_destroy(mapping);
    cm_mapping_destroy(NULL);
}
END_TEST

static double parsed(const char *number)
{
    char text[80];
    snprintf(text, sizeof text, "algebraic:c=%s", number);
    cm_mapping *mapping = make_mapping(text, NULL);
    double value = cm_mapping_parameter(mapping, 0);
    cm_mapping_destroy(mapping);
    return value;
}

/* as strtod reads them in the C locale */
START_TEST(numbers_are_exact)
{
    static const char *const odd[] = {"1",
                                      "1.",
                                      ".5",
                                      "0.87",
                                      "+1.25",
                                      "0",
                                      "1e-3",
                                      "1E0",
                                      "0.0",
                                      "00001.5",
                                      "1e-30",
                                      "15e-1",
                                      "0.000000125",
                                      "12.5e-1",
                                      "-0",
                                      "2.000",
                                      "0.1e+1",
                                      "1e-999",
                                      "0e999999",
                                      "1e-400",
                                      "1.2345678901234567890123456789",
                                      "0.12345678901234567891"};
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++)
    {
        ck_assert_msg(parsed(odd[i]) == strtod(odd[i], NULL), "%s", odd[i]);
    }
    uint64_t state = 21;
    for (int i = 0; i < 20000; i++)
    {
        char number[40];
        double value = 1.0 + next_real(&state);
        snprintf(number, sizeof number, "%.15g", value);
        ck_assert_msg(parsed(number) == strtod(number, NULL), "%s", number);
        snprintf(number, sizeof number, "%.17g", value);
        ck_assert_msg(parsed(number) == value, "%s", number);
    }
}
END_TEST

START_TEST(statuses_have_texts)
{
    for (int i = -1; i < 20; i++)
    {
        ck_assert_uint_gt(strlen(cm_status_text((cm_status)i)), 0);
        for (int k = CM_OK; k < i && i <= (int)CM_ERROR_STOPPED; k++)
        {
            ck_assert_str_ne(cm_status_text((cm_status)i), cm_status_text((cm_status)k));
        }
    }
    cm_mapping *mapping = NULL;
    ck_assert_int_eq(cm_mapping_create(NULL, NULL, &mapping), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mapping_create("qsc", NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_str_eq(cm_version(), CM_VERSION_STRING);
}
END_TEST

/* Bounds are those of standard parameters, presets and standard parts, however these are written. */
START_TEST(bounds_belong_to_parameters)
{
    static const struct
    {
        const char *specification;
        int has;
    } rows[] = {{"tangent", 1},
                {"tangent:c=1", 1},
                {"equi-edge", 0},
                {"tangent:c=1.0000001", 0},
                {"cobe:legacy=1", 0},
                {"coupled-cubic:low", 1},
                {"coupled-cubic:low=1", 1},
                {"difference:mild", 1},
                {"difference:balanced", 1},
                {"difference:isotropic", 1},
                {"difference:kappa=0.6", 0},
                {"qsc", 1},
                {"border", 1},
                {"border:lambert,shirley", 1},
                {"border:lambert,conformal", 0},
                {"quincuncial:mixture,squircle", 0},
                {"azimuthal:lambert:fov=90", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
    {
        cm_mapping *mapping = make_mapping(rows[i].specification, NULL);
        ck_assert_msg(cm_mapping_has_bounds(mapping) == rows[i].has, "%s", rows[i].specification);
        cm_mapping_destroy(mapping);
    }
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        cm_mapping *mapping = make_mapping(at(i)->identifier, NULL);
        ck_assert_msg(cm_mapping_has_bounds(mapping), "%s", at(i)->identifier);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {descriptors_are_complete,
                            smoothness_has_names,
                            bounds_keep_the_promise,
                            names_are_unique_and_found,
                            layouts_name_two_parts,
                            bounds_belong_to_parameters,
                            azimuthal_projections_show_one_field,
                            the_mappings_of_the_plan_are_there,
                            aliases_of_other_formulas,
                            specifications,
                            presets,
                            standard_values,
                            ranges_are_what_they_say,
                            long_words_are_cut,
                            messages_fit_their_buffer,
                            parameters_are_kept,
                            numbers_are_exact,
                            statuses_have_texts,
                            NULL};
    return run_suite("catalogue", tests);
}
