/* SPDX-License-Identifier: MIT
 *
 * The table of options: what it parses, and what it prints.
 */
#define _POSIX_C_SOURCE 200809L

#include "tests/suite.h"

#include "tools/cli/nearest.h"
#include "tools/cli/option_table.h"

static const char *const words[] = {"tangent", "tanh", "qsc", "equal-area", "geo", NULL};

START_TEST(nearest_words)
{
    static const char *const pairs[][2] = {
        {"tangnt", "tangent"}, {"TANGENT", "tangent"}, {"atngent", "tangent"},
        {"tang", "tangent"},   {"tahn", "tanh"},       {"qcs", "qsc"},
        {"goe", "geo"},        {"ge", "geo"},          {"equal_area", "equal-area"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        ck_assert_str_eq(cm_nearest_of(pairs[i][0], words), pairs[i][1]);
    }
    static const char *const strange[] = {"", "x", "xyz", "healpix", "t", "sphere", "-"};
    for (size_t i = 0; i < sizeof strange / sizeof *strange; i++)
    {
        ck_assert_ptr_null(cm_nearest_of(strange[i], words));
    }
    char many[1000];
    memset(many, 'a', sizeof many);
    many[sizeof many - 1] = '\0';
    ck_assert_ptr_null(cm_nearest_of(many, words));
}
END_TEST

START_TEST(nearest_message)
{
    char message[32] = "no mapping 'tangnt'";
    cm_nearest nearest = cm_nearest_to("tangnt:c=1", 6);
    cm_nearest_append(&nearest, message, sizeof message);
    ck_assert_str_eq(message, "no mapping 'tangnt'");
    cm_nearest_try(&nearest, "tangent sphere", 7);
    cm_nearest_append(&nearest, message, sizeof message);
    ck_assert_str_eq(message, "no mapping 'tangnt'; did you me"); /* cut, and ended */
}
END_TEST

static const char *face_at(size_t index)
{
    static const char *const faces[] = {"front", "right", "back", "left"};
    return index < 4 ? faces[index] : NULL;
}

static const char *const forms[] = {"json", NULL};

static const cm_option drawing[] = {
    {.id = 1,
     .letter = 'm',
     .name = "mapping",
     .kind = CM_OPTION_TEXT,
     .argument = "NAME[:PRESET]",
     .help = "the mapping, see --list",
     .more = "A PRESET is a name; `it's` good\\.",
     .standard = "`coupled`",
     .choices = words},
    {.id = 2,
     .name = "face",
     .kind = CM_OPTION_CHOICE,
     .argument = "FACE",
     .help = "what is drawn",
     .choice_at = face_at},
    {.id = 3,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "pixels",
     .low = 1,
     .high = 17},
    {.id = 4,
     .letter = 'I',
     .name = "inverse",
     .help = "the other way round, of which there is so much to say that a line is not enough"},
};

static const cm_option others[] = {
    {.id = 5,
     .name = "list",
     .kind = CM_OPTION_CHOICE,
     .argument = "json",
     .help = "print the mappings",
     .choices = forms,
     .flags = CM_OPTION_OPTIONAL},
    {.id = 6,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write [there]: at once"},
    {.id = 7,
     .name = "tolerance",
     .kind = CM_OPTION_NUMBER,
     .argument = "T",
     .help = "the error",
     .low = 0,
     .high = (double)INFINITY,
     .flags = CM_OPTION_ABOVE},
    {.id = 8, .name = "secret", .help = "nobody knows", .flags = CM_OPTION_HIDDEN},
};

static const cm_option_group groups[] = {{NULL, drawing, 4}, {"Others", others, 4}};

static const cm_command *const commands[2];

static const cm_command command = {
    .name = "cubemap-x",
    .usage = "[OPTION]... [FILE]\n--list[=json]",
    .summary =
        "Do what is to be done, and do it well; this is a paragraph that is longer than a line "
        "of a terminal.\n\nAnother:\n  as it is",
    .groups = groups,
    .group_count = 2,
    .notes = "Examples:\n  cubemap-x -m tangent",
    .operand = CM_OPTION_FILE,
    .commands = commands};

static const cm_command advice = {.name = "cubemap-x advise",
                                  .usage = "[OPTION]...",
                                  .summary = "Advise.",
                                  .groups = groups,
                                  .group_count = 1};

static const cm_command *const commands[2] = {&advice, NULL};

enum
{
    WORDS_MAX = 16
};

/* A command line from words apart by blanks, and what is read of it, as a text: "mapping=qsc inverse | operand". */
static const char *read_all(const char *line)
{
    static char result[1024];
    static char text[256];
    char *argv[WORDS_MAX] = {(char[]){"cubemap-x"}};
    int argc = 1;
    int id;
    snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word != NULL; word = strtok(NULL, " "))
    {
        argv[argc++] = word;
    }
    const cm_streams streams = {stdin, stdout, stderr};
    static cm_option_reader reader;
    reader = cm_options_begin(&command, argc, argv, &streams);
    result[0] = '\0';
    while ((id = cm_options_next(&reader)) > 0)
    {
        ck_assert_int_eq(reader.option->id, id);
        size_t used = strlen(result);
        snprintf(result + used, sizeof result - used, "%s%s%s ", reader.option->name,
                 reader.text != NULL ? "=" : "", reader.text != NULL ? reader.text : "");
    }
    if (id == CM_OPTIONS_WRONG)
    {
        return reader.message;
    }
    ck_assert_int_eq(id, CM_OPTIONS_END);
    ck_assert_int_eq(cm_options_next(&reader), CM_OPTIONS_END); /* and stays there */
    for (int i = 0; i < reader.operand_count; i++)
    {
        size_t used = strlen(result);
        snprintf(result + used, sizeof result - used, "| %s", reader.operands[i]);
    }
    return result;
}

START_TEST(parsing)
{
    static const char *const pairs[][2] = {
        {"", ""},
        {"--mapping qsc", "mapping=qsc "},
        {"--mapping=qsc --inverse", "mapping=qsc inverse "},
        {"--mapping=", "mapping= "},
        {"-m qsc -I", "mapping=qsc inverse "},
        {"-mqsc -I", "mapping=qsc inverse "},
        {"-Imqsc", "inverse mapping=qsc "},
        {"-IIm qsc -I", "inverse inverse mapping=qsc inverse "},
        {"--map qsc --inv", "mapping=qsc inverse "},
        {"a -I b --size 3 c", "inverse size=3 | a| b| c"},
        {"a -I - b", "inverse | a| -| b"},
        {"a -- -I --size", "| a| -I| --size"},
        {"-m -- -I", "mapping=-- inverse "},
        {"--output --list --list=json --list json", "output=--list list=json list | json"},
        {"--size 1e1 --tolerance 1e-9 --tolerance inf", "size=1e1 tolerance=1e-9 tolerance=inf "},
        {"--secret", "secret "},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        ck_assert_str_eq(read_all(pairs[i][0]), pairs[i][1]);
    }
}
END_TEST

START_TEST(wrong_usage)
{
    static const char *const pairs[][2] = {
        {"--maping qsc", "there is no option --maping; did you mean --mapping?"},
        {"--nothing", "there is no option --nothing; see cubemap-x --help"},
        {"--secre", "there is no option --secre; see cubemap-x --help"},
        {"--=3", "there is no option --; see cubemap-x --help"},
        {"-Ix", "there is no option -x; see cubemap-x --help"},
        {"-I-m", "there is no option --; see cubemap-x --help"},
        {"a --mapping", "--mapping needs an argument; see cubemap-x --help"},
        {"-m", "--mapping needs an argument; see cubemap-x --help"},
        {"--inverse=1", "--inverse takes no argument; see cubemap-x --help"},
        {"--size 0", "--size is '0', not a whole number from 1 to 17"},
        {"--size 18", "--size is '18', not a whole number from 1 to 17"},
        {"--size 2.5", "--size is '2.5', not a whole number from 1 to 17"},
        {"--size 3x", "--size is '3x', not a whole number from 1 to 17"},
        {"--size=", "--size is '', not a whole number from 1 to 17"},
        {"--tolerance 0", "--tolerance is '0', not a number above 0"},
        {"--tolerance nan", "--tolerance is 'nan', not a number above 0"},
        {"--face fornt",
         "--face is 'fornt', not one of front, right, back, left; did you mean front?"},
        {"--face x", "--face is 'x', not one of front, right, back, left"},
        {"--list=jsno", "--list is 'jsno', not json; did you mean json?"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        ck_assert_str_eq(read_all(pairs[i][0]), pairs[i][1]);
    }
    char long_name[200] = "--";
    memset(long_name + 2, 'a', sizeof long_name - 3);
    long_name[sizeof long_name - 1] = '\0';
    ck_assert_msg(strncmp(read_all(long_name), "there is no option --aaa", 24) == 0, "a long name");
}
END_TEST

/* The same letters for two options are none's. */
START_TEST(ambiguity)
{
    static const cm_option several[] = {
        {.id = 1, .name = "input", .help = "a"},
        {.id = 2, .name = "inverse", .help = "b"},
        {.id = 3, .name = "in", .help = "c"},
    };
    static const cm_option_group group[] = {{NULL, several, 3}};
    const cm_command few = {
        .name = "x", .usage = "", .summary = "", .groups = group, .group_count = 1};
    const cm_streams streams = {stdin, stdout, stderr};
    char *whole[] = {(char[]){"x"}, (char[]){"--in"}, (char[]){"--i"}, NULL};
    cm_option_reader reader = cm_options_begin(&few, 3, whole, &streams);
    ck_assert_int_eq(cm_options_next(&reader), 3);
    ck_assert_int_eq(cm_options_next(&reader), CM_OPTIONS_WRONG);
    ck_assert_str_eq(reader.message, "--i is short for several options: --input, --inverse, --in");
}
END_TEST

/* What one of the options that every command has prints. To be freed. */
static char *print_common(const cm_command *of, const char *option, const char *argument)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    const cm_streams streams = {stdin, out, stderr};
    char *argv[] = {(char[]){"cubemap-x"}, strdup(option), strdup(argument), NULL};
    cm_option_reader reader = cm_options_begin(of, *argument == '\0' ? 2 : 3, argv, &streams);
    ck_assert_int_eq(cm_options_next(&reader), CM_OPTIONS_PRINTED);
    fclose(out);
    free(argv[1]);
    free(argv[2]);
    return text;
}

START_TEST(help_text)
{
    char *text = print_common(&command, "--help", "");
    ck_assert_str_eq(
        text, "Usage: cubemap-x [OPTION]... [FILE]\n"
              "       cubemap-x --list[=json]\n"
              "\n"
              "Do what is to be done, and do it well; this is a paragraph that is longer than a\n"
              "line of a terminal.\n"
              "\n"
              "Another:\n"
              "  as it is\n"
              "\n"
              "  -m, --mapping NAME[:PRESET]\n"
              "                     the mapping, see --list; default: coupled\n"
              "      --face FACE    what is drawn: front, right, back or left\n"
              "      --size N       pixels, 1 to 17\n"
              "  -I, --inverse      the other way round, of which there is so much to say that\n"
              "                     a line is not enough\n"
              "  -h, --help         print this help\n"
              "      --version      print the version\n"
              "\n"
              "Others:\n"
              "      --list[=json]  print the mappings: json\n"
              "  -o, --output FILE  write [there]: at once\n"
              "      --tolerance T  the error\n"
              "\n"
              "Examples:\n"
              "  cubemap-x -m tangent\n");
    free(text);
    text = print_common(&advice, "--version", "");
    ck_assert_str_eq(text, "cubemap-x (libcubemap) " CM_VERSION_STRING "\n");
    free(text);
}
END_TEST

START_TEST(manual_text)
{
    char *text = print_common(&command, "--man", "");
    ck_assert_msg(strstr(text,
                         ".TP\n\\fB\\-m\\fR, \\fB\\-\\-mapping\\fR \\fINAME\\fR[:\\fIPRESET\\fR]\n"
                         "The mapping, see \\fB\\-\\-list\\fR.\n"
                         "A \\fIPRESET\\fR is a name; \\fBit's\\fR good\\e.\n"
                         "Default: \\fBcoupled\\fR.\n") != NULL,
                  "%s", text);
    ck_assert_msg(strstr(text, ".SS Others\n.TP\n\\fB\\-\\-list\\fR[=\\fBjson\\fR]\n") != NULL,
                  "%s", text);
    ck_assert_ptr_null(strstr(text, "secret"));
    free(text);
}
END_TEST

START_TEST(completion_text)
{
    static const char *const shells[] = {"bash", "zsh", "fish"};
    for (size_t i = 0; i < 3; i++)
    {
        char *text = print_common(&command, "--completion", shells[i]);
        ck_assert_ptr_nonnull(strstr(text, "advise"));
        ck_assert_ptr_nonnull(strstr(text, "front right back left"));
        ck_assert_ptr_nonnull(strstr(text, "tangent tanh qsc equal-area geo"));
        ck_assert_ptr_null(strstr(text, "secret"));
        free(text);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {nearest_words, nearest_message, parsing,
                                  wrong_usage,   ambiguity,       help_text,
                                  manual_text,   completion_text, NULL};
    return run_suite("option table", tests);
}
