/* SPDX-License-Identifier: MIT
 *
 * Files of results, and the words of JSON.
 */
#define _XOPEN_SOURCE 700

#include "harness.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Temporary files that are not yet what they shall be, for a signal that ends the program. */
static char pending[2][OUTPUT_NAME_MAX];

static void remove_pending(void)
{
    for (size_t i = 0; i < sizeof pending / sizeof pending[0]; i++)
    {
        if (pending[i][0] != '\0')
        {
            (void)unlink(pending[i]);
        }
    }
}

static void end_by_signal(int number)
{
    remove_pending();
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
static struct sigaction before[sizeof numbers / sizeof numbers[0]]; /* what they did */
static int watching;

/* However the program ends. */
static void watch_end(void)
{
    static int at_exit;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && !watching; i++)
    {
        const struct sigaction action = {.sa_handler = end_by_signal};
        if (sigaction(numbers[i], NULL, &before[i]) == 0 && before[i].sa_handler != SIG_IGN)
        {
            (void)sigaction(numbers[i], &action, NULL);
        }
    }
    watching = 1;
    if (!at_exit)
    {
        at_exit = atexit(remove_pending) == 0;
    }
}

/* Signals do again what they did. */
static void stop_watching(void)
{
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && watching; i++)
    {
        (void)sigaction(numbers[i], &before[i], NULL);
    }
    watching = 0;
}

static int fail(const char *name, const char *why)
{
    fprintf(harness_err(), "%s: cannot write %s: %s\n", program_name(), name, why);
    return 0;
}

static void set_pending(const char *part)
{
    for (size_t i = 0; i < sizeof pending / sizeof pending[0]; i++)
    {
        if (pending[i][0] == '\0')
        {
            memcpy(pending[i], part, strlen(part) + 1);
            return;
        }
    }
}

static void forget_pending(const char *part)
{
    int any = 0;
    for (size_t i = 0; i < sizeof pending / sizeof pending[0]; i++)
    {
        if (strcmp(pending[i], part) == 0)
        {
            pending[i][0] = '\0';
        }
        any = any || pending[i][0] != '\0';
    }
    if (!any)
    {
        stop_watching();
    }
}

/* A device, a pipe: written as it is. */
static int open_directly(output *o)
{
    o->part[0] = '\0';
    o->file = fopen(o->name, "w");
    return o->file != NULL || fail(o->name, strerror(errno));
}

/* With the rights that a new file has. */
static int open_descriptor(output *o, int descriptor)
{
    const mode_t mask = umask(0);
    (void)umask(mask);
    (void)fchmod(descriptor, 0666 & ~mask);
    o->file = fdopen(descriptor, "w");
    if (o->file == NULL)
    {
        const int error = errno;
        (void)close(descriptor);
        (void)remove(o->part);
        forget_pending(o->part);
        return fail(o->name, strerror(error));
    }
    return 1;
}

/* A temporary file beside the target, which a link may name. */
static int open_part(output *o)
{
    if (realpath(o->name, o->target) == NULL &&
        snprintf(o->target, sizeof o->target, "%s", o->name) >= (int)sizeof o->target)
    {
        return fail(o->name, strerror(ENAMETOOLONG));
    }
    if (snprintf(o->part, sizeof o->part, "%s.XXXXXX", o->target) >= (int)sizeof o->part)
    {
        return fail(o->name, strerror(ENAMETOOLONG));
    }
    /* no signal comes between the file and its being known */
    sigset_t waiting, earlier;
    (void)sigemptyset(&waiting);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    {
        (void)sigaddset(&waiting, numbers[i]);
    }
    (void)sigprocmask(SIG_BLOCK, &waiting, &earlier);
    const int descriptor = mkstemp(o->part);
    const int error = errno;
    if (descriptor >= 0)
    {
        set_pending(o->part);
        watch_end();
    }
    (void)sigprocmask(SIG_SETMASK, &earlier, NULL);
    if (descriptor < 0)
    {
        return fail(o->name, strerror(error));
    }
    return open_descriptor(o, descriptor);
}

int output_open(output *o, const char *name)
{
    struct stat there;
    o->name = name;
    o->file = NULL;
    o->part[0] = '\0';
    if (name == NULL || strcmp(name, "-") == 0)
    {
        o->file = name == NULL ? NULL : harness_out();
        return 1;
    }
    if (stat(name, &there) == 0 && S_ISDIR(there.st_mode))
    {
        return fail(name, strerror(EISDIR));
    }
    return stat(name, &there) == 0 && !S_ISREG(there.st_mode) ? open_directly(o) : open_part(o);
}

int output_close(output *o)
{
    if (o->file == NULL || o->file == harness_out())
    {
        return 1;
    }
    int bad = ferror(o->file);
    bad |= fclose(o->file);
    o->file = NULL;
    if (o->part[0] == '\0')
    {
        return !bad || fail(o->name, strerror(errno));
    }
    if (bad || rename(o->part, o->target) != 0)
    {
        int reason = errno;
        (void)remove(o->part);
        forget_pending(o->part);
        return fail(o->name, strerror(reason));
    }
    forget_pending(o->part);
    return 1;
}

void output_drop(output *o)
{
    if (o->file != NULL && o->file != harness_out())
    {
        fclose(o->file);
        o->file = NULL;
        if (o->part[0] != '\0')
        {
            (void)remove(o->part);
            forget_pending(o->part);
        }
    }
}

void outputs_abandon(void)
{
    remove_pending();
    memset(pending, 0, sizeof pending);
    stop_watching();
}

int outputs_differ(const char *a, const char *b)
{
    struct stat at_a;
    struct stat at_b;
    if (a == NULL || b == NULL)
    {
        return 1;
    }
    return strcmp(a, b) != 0 &&
           (stat(a, &at_a) != 0 || stat(b, &at_b) != 0 || !S_ISREG(at_a.st_mode) ||
            at_a.st_dev != at_b.st_dev || at_a.st_ino != at_b.st_ino);
}

int close_standard_output(void)
{
    if (fflush(harness_out()) != 0 || ferror(harness_out()))
    {
        fprintf(harness_err(), "%s: cannot write to standard output: %s\n", program_name(),
                strerror(errno));
        return 1;
    }
    return 0;
}

void json_text(FILE *out, const char *key, const char *text)
{
    fprintf(out, "\"%s\": \"", key);
    for (; *text != '\0'; text++)
    {
        if ((unsigned char)*text < 0x20)
        {
            fprintf(out, "\\u%04x", (unsigned)*text);
            continue;
        }
        if (*text == '"' || *text == '\\')
        {
            fputc('\\', out);
        }
        fputc(*text, out);
    }
    fprintf(out, "\", ");
}

void json_number(FILE *out, const char *key, double value)
{
    if (isfinite(value))
    {
        fprintf(out, "\"%s\": %.6g, ", key, value);
    }
    else
    {
        fprintf(out, "\"%s\": null, ", key);
    }
}

void json_numbers(FILE *out, const char *key, const double *values, size_t count)
{
    fprintf(out, "\"%s\": [", key);
    for (size_t i = 0; i < count; i++)
    {
        fprintf(out, "%s%.9g", i == 0 ? "" : ", ", values[i]);
    }
    fprintf(out, "], ");
}

void json_run(FILE *out, const char *date)
{
    json_text(out, "date", date);
    json_text(out, "commit", system_commit());
    json_number(out, "clock_tick_ns", clock_tick() * 1e9);
}

void json_machine(FILE *out)
{
    json_text(out, "cpu", system_cpu());
    json_text(out, "system", system_name());
    json_text(out, "compiler", system_compiler());
    json_text(out, "flags", system_flags());
}
