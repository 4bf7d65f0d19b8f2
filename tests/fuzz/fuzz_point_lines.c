/* SPDX-License-Identifier: MIT
 *
 * The filter of cubemap-project. Input: two characters for the options, then the lines, which may
 * come after so many others that they are where a buffer and a batch of the filter end.
 */
#define _GNU_SOURCE

#include "tools/project/point_filter.h"

#include <cubemap/cubemap.h>

#include "fuzz_talk.h"

static size_t count_lines(const char *text, size_t size)
{
    size_t count = size > 0 && text[size - 1] != '\n' ? 1 : 0;
    for (size_t i = 0; i < size; i++)
    {
        count += text[i] == '\n';
    }
    return count;
}

/* A line grows by its results; one that has become too long is not read again. */
static int has_long_line(const char *text, size_t size)
{
    size_t length = 0;
    for (size_t i = 0; i < size; i++)
    {
        length = text[i] == '\n' ? 0 : length + 1;
        if (length > 3800)
        {
            return 1;
        }
    }
    return 0;
}

/* Runs the filter; the number of lines that it complains of. */
static size_t filter(const struct filter_options *options, const cm_mapping *mapping,
                     const char *text, size_t size, talk *with)
{
    cm_failure failure = {.status = 0};
    const cm_streams streams = open_streams(with, text, size);
    bool all_good = filter_points(options, mapping, &streams, "lines", &failure);
    close_streams(&streams);
    EXPECT(failure.status == 0, "%s", failure.text);
    size_t bad = count_lines(with->messages, with->messages_size);
    EXPECT(strlen(with->messages) == with->messages_size, "a zero byte in a message");
    EXPECT(all_good == (bad == 0), "%zu complaints, but the result is %d", bad, all_good);
    EXPECT(count_lines(with->output, with->output_size) == count_lines(text, size),
           "not a line for each line");
    EXPECT(are_messages(with->messages, "lines:"), "%s", with->messages);
    return bad;
}

/* Can rounding take what the filter writes off the map? Beyond the rim of a disc, or of a field of view. */
static bool has_rim(const cm_mapping *mapping, bool inverse)
{
    cm_kind kind = cm_mapping_describe(mapping)->kind;
    return kind == CM_KIND_AZIMUTHAL || (kind == CM_KIND_DISC_SQUARE && inverse);
}

/* What the filter writes it reads, but for the lines that it has complained of. */
static void check_back(const struct filter_options *options, const cm_mapping *mapping,
                       const talk *first, size_t bad)
{
    struct filter_options back = *options;
    talk second;
    back.inverse = !options->inverse;
    size_t still_bad = filter(&back, mapping, first->output, first->output_size, &second);
    bool good = has_rim(mapping, options->inverse) ? bad <= still_bad : bad == still_bad;
    EXPECT(good, "%zu bad lines, and back %zu:\n%s%s%s", bad, still_bad, first->output,
           second.messages, second.output);
    drop_talk(&second);
}

/* What may stand before the input's lines: some 800 bytes less than the filter's buffer of 64 KiB and
 * 50 lines less than its batch of 1024, or one comment less, so that a line that is too long begins
 * in one buffer and ends in another. */
enum
{
    COMMENTS = 17,
    COMMENT_BYTES = 3750,
    BLANK_LINES = 957
};

/* The text for the filter, to be freed; *length is set. */
static char *make_text(const supply *lines, size_t comments, size_t blank_lines, size_t *length)
{
    size_t before = comments * (COMMENT_BYTES + 1) + blank_lines;
    char *text = malloc(before + lines->left + 1);
    EXPECT(text != NULL, "no memory");
    memset(text, '\n', before);
    for (size_t i = 0; i < comments; i++)
    {
        memset(text + i * (COMMENT_BYTES + 1), '#', COMMENT_BYTES);
    }
    memcpy(text + before, lines->at, lines->left);
    *length = before + lines->left;
    return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    uint8_t bits = take_byte(&from);
    uint8_t which = take_byte(&from);
    const struct filter_options options = {.digits = 1 + which % 17,
                                           .inverse = bits & 1,
                                           .single = (bits & 2) != 0,
                                           .xyz = (bits & 4) != 0};
    cm_mapping *mapping = NULL;
    talk first;
    size_t length;
    size_t late = (bits & 8) != 0;
    char *text = make_text(&from, late * (COMMENTS - which / 128), late * BLANK_LINES, &length);
    const char *name = cm_catalogue_at(which % cm_catalogue_count())->identifier;
    EXPECT(cm_mapping_create(name, NULL, &mapping) == CM_OK, "%s", name);
    size_t bad = filter(&options, mapping, text, length, &first);
    if (!has_long_line(text, length))
    {
        check_back(&options, mapping, &first, bad);
    }
    drop_talk(&first);
    cm_mapping_destroy(mapping);
    free(text);
    return 0;
}
