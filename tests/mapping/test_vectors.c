/* SPDX-License-Identifier: MIT
 *
 * Every mapping against values of high precision: the files FOLDER/X.txt and
 * FOLDER/independent/X.txt, whose README.md describes them. With eps = 2^-53 in double and 2^-24 in
 * float, each coordinate must be
 *   within 8 eps of the truth, and
 *   within 16 eps times the truth of it, where the truth is not below 1e-300 (float: 1e-36).
 * The same holds for the parameters that are not the standard ones. Decimal parameters of the truth
 * are exact and those of the library rounded: the bounds include that.
 */
#include "tests/suite.h"
#include "tests/text_files.h"

#define ABSOLUTE_BOUND 8.0L
#define RELATIVE_BOUND 16.0L
#define LEAST_LINES 400        /* of FOLDER/MAPPING.txt, the standard parameters */
#define LEAST_SPHERE_LINES 80  /* of the kinds D and R among them, each */
#define LEAST_FLOAT_LINES 120  /* whose inputs are floats */
#define LEAST_LINES_OF_FILE 50 /* of any file */

enum
{
    IN_DOUBLE,
    IN_FLOAT,
    PRECISIONS
};

static const struct
{
    const char *name;
    long double eps;
    long double normal; /* from here on an error is measured relative to the truth as well */
} precisions[PRECISIONS] = {{"double", 0x1p-53L, 1e-300L}, {"float", 0x1p-24L, 1e-36L}};

static const char kinds[] = "FIDR";
#define KINDS (sizeof kinds - 1)

static const char *folder;

/* ---- Reading ---- */

typedef struct source
{
    FILE *stream;
    const char *name;
    int number; /* of the line that was read last */
    char specification[64];
    char frame[16];
} source;

typedef struct line
{
    char kind;
    int tie;
    int exact_float; /* are all inputs floats? */
    int face;        /* of D an output, of R an input */
    size_t inputs;   /* besides the face */
    size_t outputs;
    double in[3];
    long double truth[3];
} line;

/* A blank and then a finite number, which at is left behind. */
static int take_number(const char **at, double *value, long double *precise)
{
    char *end;
    if (**at != ' ')
    {
        return 0;
    }
    *value = strtod(*at, &end);
    *precise = strtold(*at, NULL);
    int good = end != *at && isfinite(*value);
    *at = end;
    return good;
}

static int take_face(const char **at, int *face)
{
    *face = (*at)[0] == ' ' ? (*at)[1] - '0' : -1;
    if (*face < 0 || *face > 5)
    {
        return 0;
    }
    *at += 2;
    return 1;
}

/* Is a double a float that has not lost relative accuracy by being subnormal? */
static int is_float(double value)
{
    double size = fabs(value);
    return size == 0.0 || (size > 1e-37 && size < 3e38 && (double)(float)value == value);
}

static int take_inputs(const char **at, line *to)
{
    int good = 1;
    to->exact_float = 1;
    for (size_t i = 0; i < to->inputs && good; i++)
    {
        long double unused;
        good = take_number(at, &to->in[i], &unused);
        to->exact_float &= good && is_float(to->in[i]);
    }
    return good;
}

static int take_outputs(const char **at, line *to)
{
    int good = 1;
    for (size_t i = 0; i < to->outputs && good; i++)
    {
        double unused;
        good = take_number(at, &unused, &to->truth[i]);
    }
    return good;
}

/* F p q u v, I u v p q, D x y z face u v, R face u v x y z; and at the end there may be "tie". */
static int parse_line(const char *text, line *to)
{
    const char *at = text + 1;
    to->kind = text[0];
    to->inputs = to->kind == 'D' ? 3 : 2;
    to->outputs = to->kind == 'R' ? 3 : 2;
    int good = to->kind != '\0' && strchr(kinds, to->kind) != NULL;
    good = good && (to->kind != 'R' || take_face(&at, &to->face)) && take_inputs(&at, to);
    good = good && (to->kind != 'D' || take_face(&at, &to->face)) && take_outputs(&at, to);
    to->tie = good && strncmp(at, " tie", 4) == 0;
    return good && strcmp(at + (to->tie ? 4 : 0), "\n") == 0;
}

/* Reads the next vector. 1; 0 at the end; -1 if the file has none of the lines
 * "# specification X" and "# frame X" before its first vector, or a line that is none. */
static int read_line(source *from, line *to)
{
    char text[512];
    while (fgets(text, sizeof text, from->stream) != NULL)
    {
        from->number++;
        if (text[0] != '#')
        {
            int headed = from->specification[0] != '\0' && from->frame[0] != '\0';
            return headed && parse_line(text, to) ? 1 : -1;
        }
        if (sscanf(text, "# specification %63s", from->specification) != 1)
        {
            sscanf(text, "# frame %15s", from->frame);
        }
    }
    return from->number > 0 ? 0 : -1;
}

static void open_source(source *from, const char *path)
{
    *from = (source){.name = path};
    from->stream = fopen(path, "r");
    ck_assert_msg(from->stream != NULL, "cannot open %s", path);
}

/* The next vector of a file that must be right. */
static int next_line(source *from, line *to)
{
    int state = read_line(from, to);
    ck_assert_msg(state >= 0, "%s:%d: not a vector, or no specification or frame before it",
                  from->name, from->number);
    return state;
}

/* ---- Comparing ---- */

typedef struct worst
{
    long double error; /* eps */
    const char *file;
    int number;
} worst;

typedef struct tally
{
    worst absolute[KINDS][PRECISIONS];
    worst relative[KINDS][PRECISIONS];
    int lines;
    int floats;
} tally;

/* One line of a file and what its comparison needs. */
typedef struct comparison
{
    const cm_mapping *mapping;
    const source *from;
    const line *at;
    int precision;
    tally *into;
} comparison;

static int failures; /* of the test that runs */

static void complain(const comparison *c, const char *what)
{
    failures++;
    printf("%s:%d: in %s %s\n", c->from->name, c->from->number, precisions[c->precision].name,
           what);
}

static void note(worst *record, long double error, const source *from)
{
    if (error > record->error || record->file == NULL)
    {
        *record = (worst){error, from->name, from->number};
    }
}

static void compare(const comparison *c, const double *got)
{
    size_t kind = (size_t)(strchr(kinds, c->at->kind) - kinds);
    long double eps = precisions[c->precision].eps;
    for (size_t i = 0; i < c->at->outputs; i++)
    {
        long double truth = c->at->truth[i];
        long double absolute = fabsl((long double)got[i] - truth) / eps;
        int normal = fabsl(truth) >= precisions[c->precision].normal;
        long double relative = normal ? absolute / fabsl(truth) : 0.0L;
        note(&c->into->absolute[kind][c->precision], absolute, c->from);
        note(&c->into->relative[kind][c->precision], relative, c->from);
        /* so written, NaN fails */
        if (!(absolute <= ABSOLUTE_BOUND) || !(relative <= RELATIVE_BOUND))
        {
            char what[200];
            snprintf(what, sizeof what,
                     "coordinate %zu is %.17g, truth %.21Lg: %.3Lg eps, relative %.3Lg eps", i,
                     got[i], truth, absolute, relative);
            complain(c, what);
        }
    }
}

static void check_warp(const comparison *c)
{
    int forward = c->at->kind == 'F';
    double got[2];
    cm_status status;
    if (c->precision == IN_DOUBLE)
    {
        status = (forward ? cm_warp : cm_unwarp)(c->mapping, c->at->in, got);
    }
    else
    {
        float in32[2] = {(float)c->at->in[0], (float)c->at->in[1]};
        float got32[2];
        status = (forward ? cm_warp_f32 : cm_unwarp_f32)(c->mapping, in32, got32);
        got[0] = (double)got32[0];
        got[1] = (double)got32[1];
    }
    ck_assert_int_eq(status, CM_OK);
    compare(c, got);
}

static void inverse(const comparison *c, int face, const double uv[2], double direction[3])
{
    if (c->precision == IN_DOUBLE)
    {
        cm_inverse(c->mapping, (uint8_t)face, uv, direction);
        return;
    }
    float uv32[2] = {(float)uv[0], (float)uv[1]};
    float direction32[3];
    cm_inverse_f32(c->mapping, (uint8_t)face, uv32, direction32);
    for (int i = 0; i < 3; i++)
    {
        direction[i] = (double)direction32[i];
    }
}

/* Another face than that of the truth: does it stand for the same direction? */
static void check_other_face(const comparison *c, int face, const double uv[2])
{
    double direction[3];
    const double *in = c->at->in;
    long double largest = fmaxl(fmaxl(fabsl(in[0]), fabsl(in[1])), fabsl(in[2]));
    long double unit[3] = {in[0] / largest, in[1] / largest, in[2] / largest};
    long double length = sqrtl(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
    inverse(c, face, uv, direction);
    for (int i = 0; i < 3; i++)
    {
        long double error = fabsl((long double)direction[i] - unit[i] / length);
        if (!(error <= ABSOLUTE_BOUND * precisions[c->precision].eps))
        {
            complain(c, "a face that stands for another direction");
            return;
        }
    }
}

/* Which face has an edge is a rule of cm_forward, so a tie is no excuse. But the boundary of
 * healpix's caps, |sin lat| = 2/3, is not where a double can be: there the face may be either. */
static void check_forward(const comparison *c)
{
    double got[2];
    int face;
    if (c->precision == IN_DOUBLE)
    {
        face = cm_forward(c->mapping, c->at->in, got);
    }
    else
    {
        float in32[3] = {(float)c->at->in[0], (float)c->at->in[1], (float)c->at->in[2]};
        float got32[2];
        face = cm_forward_f32(c->mapping, in32, got32);
        got[0] = (double)got32[0];
        got[1] = (double)got32[1];
    }
    int hybrid = cm_mapping_describe(c->mapping)->family == CM_FAMILY_HYBRID;
    if (face == c->at->face)
    {
        compare(c, got);
    }
    else if (hybrid && (c->at->tie || c->precision == IN_FLOAT))
    {
        check_other_face(c, face, got);
    }
    else
    {
        complain(c, "another face");
    }
}

static void check_line(const comparison *c)
{
    double direction[3];
    switch (c->at->kind)
    {
    case 'F':
    case 'I':
        check_warp(c);
        break;
    case 'D':
        check_forward(c);
        break;
    default:
        inverse(c, c->at->face, c->at->in, direction);
        compare(c, direction);
    }
}

/* ---- The tests ---- */

static void print_tally(const tally *of)
{
    for (size_t kind = 0; kind < KINDS; kind++)
    {
        for (int p = 0; p < PRECISIONS; p++)
        {
            const worst *absolute = &of->absolute[kind][p];
            const worst *relative = &of->relative[kind][p];
            if (absolute->file != NULL)
            {
                printf("  %c %-6s absolute %.2Lf eps at %s:%d, relative %.2Lf eps at %s:%d\n",
                       kinds[kind], precisions[p].name, absolute->error, absolute->file,
                       absolute->number, relative->error, relative->file, relative->number);
            }
        }
    }
}

static void check_file(const char *path, tally *into)
{
    source from;
    line at;
    cm_mapping *mapping = NULL;
    open_source(&from, path);
    while (next_line(&from, &at))
    {
        if (mapping == NULL)
        {
            const cm_frame *frame = cm_frame_find(from.frame);
            ck_assert_msg(frame != NULL, "%s: no such frame: %s", path, from.frame);
            mapping = make_mapping(from.specification, frame);
        }
        into->lines++;
        into->floats += at.exact_float;
        comparison c = {mapping, &from, &at, IN_DOUBLE, into};
        check_line(&c);
        c.precision = IN_FLOAT;
        if (at.exact_float)
        {
            check_line(&c);
        }
    }
    fclose(from.stream);
    cm_mapping_destroy(mapping);
    ck_assert_msg(into->lines >= LEAST_LINES_OF_FILE, "%s: only %d lines", path, into->lines);
    printf("%s (%s, %s): %d lines, %d of floats\n", path, from.specification, from.frame,
           into->lines, into->floats);
    print_tally(into);
}

/* The worst of two tallies. */
static void add_tally(tally *sum, const tally *part)
{
    for (size_t kind = 0; kind < KINDS; kind++)
    {
        for (int p = 0; p < PRECISIONS; p++)
        {
            const worst *absolute = &part->absolute[kind][p];
            const worst *relative = &part->relative[kind][p];
            if (absolute->file != NULL && absolute->error >= sum->absolute[kind][p].error)
            {
                sum->absolute[kind][p] = *absolute;
            }
            if (relative->file != NULL && relative->error >= sum->relative[kind][p].error)
            {
                sum->relative[kind][p] = *relative;
            }
        }
    }
    sum->lines += part->lines;
    sum->floats += part->floats;
}

/* The files of both folders, in the order of their names; faces.txt is of another kind. */
static void find_files(text_files *found)
{
    char independent[1024];
    snprintf(independent, sizeof independent, "%s/independent", folder);
    text_files_add(found, folder);
    ck_assert_msg(found->count > 0, "no vectors in %s", folder);
    const size_t own = found->count;
    text_files_add(found, independent);
    ck_assert_msg(found->count > own, "no vectors in %s", independent);
}

START_TEST(every_file_of_vectors)
{
    text_files found = {0};
    tally all = {.lines = 0};
    failures = 0;
    find_files(&found);
    for (size_t i = 0; i < found.count; i++)
    {
        if (strstr(found.path[i], "/independent/faces.txt") == NULL)
        {
            tally file = {.lines = 0};
            check_file(found.path[i], &file);
            add_tally(&all, &file);
        }
    }
    printf("All: %d lines, %d of floats; the worst of them\n", all.lines, all.floats);
    print_tally(&all);
    free(found.path);
    ck_assert_msg(failures == 0, "%d coordinates or faces are wrong", failures);
}
END_TEST

/* FOLDER/MAPPING.txt is of the standard parameters and has enough of everything. */
static void check_amount(const cm_mapping_info *mapping, unsigned *frames)
{
    char path[4096];
    source from;
    line at;
    int lines = 0;
    int floats = 0;
    int of_kind[KINDS] = {0};
    snprintf(path, sizeof path, "%s/%s.txt", folder, mapping->identifier);
    open_source(&from, path);
    while (next_line(&from, &at))
    {
        lines++;
        floats += at.exact_float;
        of_kind[strchr(kinds, at.kind) - kinds]++;
    }
    fclose(from.stream);
    ck_assert_str_eq(from.specification, mapping->identifier);
    ck_assert_msg(lines >= LEAST_LINES, "%s: only %d lines", path, lines);
    ck_assert_msg(floats >= LEAST_FLOAT_LINES, "%s: only %d lines of floats", path, floats);
    ck_assert_msg(of_kind[2] >= LEAST_SPHERE_LINES && of_kind[3] >= LEAST_SPHERE_LINES,
                  "%s: only %d lines D, %d lines R", path, of_kind[2], of_kind[3]);
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        *frames |= strcmp(cm_frame_at(i)->identifier, from.frame) == 0 ? 1u << i : 0u;
    }
}

START_TEST(every_mapping_has_vectors)
{
    unsigned frames = 0;
    for (size_t i = 0; i < cube_count(); i++)
    {
        check_amount(cm_catalogue_at(i), &frames);
    }
    ck_assert_msg(frames == (1u << cm_frame_count()) - 1u, "a frame without vectors");
}
END_TEST

#define HEAD "# specification s2\n# frame gl\n"

START_TEST(what_is_no_vector_is_refused)
{
    static const struct
    {
        int good;
        const char *text;
    } cases[] = {
        {1, HEAD "F 0.5 1.0 0.5 1\nI 0 0 0 0\nD 1 0.5 1 0 0.5 1 tie\nR 5 0 0 0 0 -1\n"},
        {1, HEAD},
        {0, ""},
        {0, "# frame gl\nF 0 0 0 0\n"},
        {0, "# specification s2\nF 0 0 0 0\n"},
        {0, "F 0 0 0 0\n" HEAD},
        {0, HEAD "F 0 0 0\n"},         /* a number is missing */
        {0, HEAD "F 0 0 0 0 0\n"},     /* one too many */
        {0, HEAD "F 0 0 0 0 tied\n"},  /* something else after it */
        {0, HEAD "F 0 0 0 0"},         /* cut off */
        {0, HEAD "F 0 0 0 nan\n"},     /* not a finite number */
        {0, HEAD "F 0 0 0 zero\n"},    /* not a number */
        {0, HEAD "R 6 0 0 0 0 1\n"},   /* not a face */
        {0, HEAD "D 1 0 0 0.5 0 0\n"}, /* not a whole one */
        {0, HEAD "X 0 0 0 0\n"},       /* an unknown kind */
        {0, HEAD "F 0 0 0 0\n\n"},     /* an empty line */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        source from = {.stream = tmpfile(), .name = "case"};
        line at;
        int state;
        ck_assert_ptr_nonnull(from.stream);
        fputs(cases[i].text, from.stream);
        rewind(from.stream);
        while ((state = read_line(&from, &at)) > 0)
        {
        }
        fclose(from.stream);
        ck_assert_msg((state == 0) == cases[i].good, "read_line gives %d for:\n%s", state,
                      cases[i].text);
    }
}
END_TEST

/* faces.txt: x y z -> gl: face p q -> geo: face p q [tie] */
START_TEST(gnomonic_faces_in_two_frames)
{
    char path[4096];
    char text[512];
    const char *frames[2] = {"gl", "geo"};
    cm_mapping *mapping[2];
    line row = {.kind = 'D', .inputs = 3, .outputs = 2};
    source from;
    tally all = {.lines = 0};
    failures = 0;
    snprintf(path, sizeof path, "%s/independent/faces.txt", folder);
    open_source(&from, path);
    for (int f = 0; f < 2; f++)
    {
        mapping[f] = make_mapping("gnomonic", cm_frame_find(frames[f]));
    }
    while (fgets(text, sizeof text, from.stream) != NULL)
    {
        from.number++;
        char *end = text;
        for (int i = 0; i < 3 && text[0] != '#'; i++)
        {
            row.in[i] = strtod(end, &end);
        }
        for (int f = 0; f < 2 && text[0] != '#'; f++)
        {
            row.face = (int)strtol(end, &end, 10);
            row.truth[0] = strtold(end, &end);
            row.truth[1] = strtold(end, &end);
            check_forward(&(comparison){mapping[f], &from, &row, IN_DOUBLE, &all});
            all.lines++;
        }
    }
    fclose(from.stream);
    cm_mapping_destroy(mapping[0]);
    cm_mapping_destroy(mapping[1]);
    ck_assert_int_ge(all.lines, 2 * LEAST_LINES_OF_FILE);
    ck_assert_int_eq(failures, 0);
}
END_TEST

int main(int argc, char **argv)
{
    if (argc != 2)
    {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    folder = argv[1];
    const TTest *tests[] = {every_file_of_vectors, every_mapping_has_vectors,
                            what_is_no_vector_is_refused, gnomonic_faces_in_two_frames, NULL};
    return run_suite("vectors", tests);
}
