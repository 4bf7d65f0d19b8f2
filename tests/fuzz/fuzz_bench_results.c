/* SPDX-License-Identifier: MIT
 *
 * Files of results that cubemap-bench compare reads: whatever is in them, they are refused with one line, or compared with
 * themselves without a difference.
 */
#define _GNU_SOURCE

#include "fuzz_talk.h"

#include "tools/bench/compare_results.h"

static void check_comparison(const results *r)
{
    talk with = {0};
    FILE *const out = open_memstream(&with.output, &with.output_size);
    EXPECT(out != NULL, "no memory");
    const verdict v = print_comparison(out, r, r, 0.05, 0.0);
    EXPECT(fclose(out) == 0, "no memory");
    EXPECT(v.compared == r->count, "%zu of %zu", v.compared, r->count);
    EXPECT(v.slower == 0 && v.faster == 0 && v.past_gate == 0, "slower than itself: %s",
           with.output);
    EXPECT(are_messages(with.output, ""), "control characters: %s", with.output);
    drop_talk(&with);
}

static void check_refusal(const cm_failure *failure)
{
    talk with = {0};
    FILE *const err = open_memstream(&with.messages, &with.messages_size);
    EXPECT(err != NULL, "no memory");
    EXPECT(failure->status == 1, "status %d", failure->status);
    say(err, "%s", failure->text);
    EXPECT(fclose(err) == 0, "no memory");
    EXPECT(is_one_message(with.messages, "results"), "%s", with.messages);
    drop_talk(&with);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static cm_failure failure;
    results r;
    FILE *const in =
        size > 0 ? fmemopen((void *)(uintptr_t)data, size, "r") : fopen("/dev/null", "r");
    EXPECT(in != NULL, "no memory");
    failure.status = 0;
    if (read_results(in, "results", &r, &failure))
    {
        EXPECT(failure.status == 0, "%s", failure.text);
        check_comparison(&r);
    }
    else
    {
        check_refusal(&failure);
    }
    free_results(&r);
    fclose(in);
    return 0;
}
