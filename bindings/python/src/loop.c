/* SPDX-License-Identifier: MIT
 *
 * From the strides of NumPy to the dense arrays of the library: what is dense goes straight to it, all else through small
 * buffers that stay in the cache.
 */
#include "core.h"

#include <fenv.h>
#include <string.h>

#define BUFFER_BYTES 32768
#define POINTS_MOST 1024

const unsigned char core_type_size[CORE_TYPES] = {
    [CORE_DOUBLE] = sizeof(double),
    [CORE_FLOAT] = sizeof(float),
    [CORE_UINT8] = 1,
    [CORE_INT] = sizeof(int),
    [CORE_UINT32] = sizeof(uint32_t),
    [CORE_INT64] = 8,
    [CORE_UINT64] = 8,
};

enum core_type core_seen_type(const struct core_loop *loop, int operand)
{
    const enum core_type type = loop->variant->operand[operand].type;
    if (operand >= loop->function->inputs)
    {
        return type;
    }
    if (type == CORE_UINT8 && loop->integers == CORE_AS_UNSIGNED)
    {
        return CORE_UINT64;
    }
    if (type == CORE_INT || type == CORE_UINT32 ||
        ((type == CORE_UINT8 || type == CORE_UINT64) && loop->integers != CORE_AS_THEY_ARE))
    {
        return CORE_INT64;
    }
    return type == CORE_FLOAT && loop->rounds ? CORE_DOUBLE : type;
}

/* Where the numbers of an operand are. */
struct place
{
    char *first;
    intptr_t step; /* from point to point, bytes */
    int extents;   /* of a point: 0, 1 or 2 */
    int extent[2];
    intptr_t inner[2]; /* from number to number along each */
    size_t seen;       /* bytes of a number there */
    size_t size;       /* bytes of a number for the library */
    int direct;        /* can the library work on it? */
    char *buffer;      /* else */
};

const char *core_read_extents(const char *text, int *extents, int extent[2])
{
    *extents = 0;
    while (*text != '(')
    {
        text++;
    }
    for (text++; *text != ')'; text++)
    {
        if (*text == ',')
        {
            continue;
        }
        int count = 0;
        while (*text >= '0' && *text <= '9')
        {
            count = 10 * count + (*text++ - '0');
        }
        extent[(*extents)++] = count;
        text--;
    }
    return text;
}

/* A number of 64 bits where the library has fewer: a real one is rounded; a whole one that does not fit becomes one that it
 * refuses. An unsigned one of the upper half is seen as one below zero, which does not fit either. */
static void narrow(enum core_type type, const char *from, char *to)
{
    if (type == CORE_FLOAT)
    {
        double real;
        memcpy(&real, from, sizeof real);
        *(float *)(void *)to = (float)real;
        return;
    }
    int64_t value;
    memcpy(&value, from, sizeof value);
    if (type == CORE_UINT8)
    {
        *(uint8_t *)to = value < 0 || value > 255 ? 255 : (uint8_t)value;
    }
    else if (type == CORE_UINT32)
    {
        *(uint32_t *)(void *)to = value < 0 || value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
    }
    else
    {
        *(int *)(void *)to = value < INT32_MIN || value > INT32_MAX ? INT32_MIN : (int)value;
    }
}

/* Copy n numbers of a size between strides. */
static void copy(size_t n, size_t size, const char *from, intptr_t from_step, char *to,
                 intptr_t to_step)
{
    if (size == 8)
    {
        for (size_t i = 0; i < n; i++, from += from_step, to += to_step)
        {
            memcpy(to, from, 8);
        }
    }
    else if (size == 4)
    {
        for (size_t i = 0; i < n; i++, from += from_step, to += to_step)
        {
            memcpy(to, from, 4);
        }
    }
    else
    {
        for (size_t i = 0; i < n; i++, from += from_step, to += to_step)
        {
            *to = *from;
        }
    }
}

/* Between n points of an operand and its buffer, where points are `plane` apart if it is planar. */
static void transfer(const struct place *place, const struct core_operand *operand, size_t begin,
                     size_t n, size_t plane, int to_buffer)
{
    const int columns = place->extents > 1 ? place->extent[1] : 1;
    for (int item = 0; item < operand->items; item++)
    {
        const int row = item / columns, column = item % columns;
        const intptr_t inside = place->extents > 1
                                    ? row * place->inner[0] + column * place->inner[1]
                                    : (place->extents == 1 ? item * place->inner[0] : 0);
        char *outside = place->first + (intptr_t)begin * place->step + inside;
        char *buffer = place->buffer + (size_t)item * place->size * (operand->planar ? plane : 1);
        const intptr_t buffer_step =
            (intptr_t)(place->size * (operand->planar ? 1u : operand->items));
        if (!to_buffer)
        {
            copy(n, place->size, buffer, buffer_step, outside, place->step);
        }
        else if (place->seen == place->size)
        {
            copy(n, place->size, outside, place->step, buffer, buffer_step);
        }
        else
        {
            for (size_t i = 0; i < n; i++, outside += place->step, buffer += buffer_step)
            {
                narrow(operand->type, outside, buffer);
            }
        }
    }
}

/* Places and buffers of all operands. Returns how many points the buffers have room for; 0 if none needs one. */
static size_t find_places(const struct core_loop *loop, char *const *args, const intptr_t *steps,
                          char *buffers, struct place *places)
{
    const struct core_function *function = loop->function;
    const int count = function->inputs + function->outputs;
    const intptr_t *inner = steps + count;
    const char *signature = function->signature;
    int shared = 0;
    size_t bytes = 0;
    for (int k = 0; k < count; k++)
    {
        const struct core_operand *operand = &loop->variant->operand[k];
        struct place *place = &places[k];
        place->first = args[k];
        place->step = steps[k];
        place->extents = 0;
        place->size = core_type_size[operand->type];
        place->seen = core_type_size[core_seen_type(loop, k)];
        intptr_t dense = (intptr_t)place->size;
        place->direct = place->seen == place->size && !operand->planar;
        if (signature)
        {
            signature = core_read_extents(signature, &place->extents, place->extent);
            for (int axis = 0; axis < place->extents; axis++)
            {
                place->inner[axis] = *inner++;
            }
            for (int axis = place->extents - 1; axis >= 0; axis--)
            {
                place->direct &= place->inner[axis] == dense;
                dense *= place->extent[axis];
            }
        }
        place->direct &= place->step == dense;
        for (int input = 0; k >= function->inputs && input < function->inputs; input++)
        {
            shared |= args[input] == args[k];
        }
    }
    for (int k = 0; k < count; k++)
    {
        places[k].direct &= function->in_place || !shared;
        bytes += places[k].direct ? 0 : places[k].size * loop->variant->operand[k].items;
    }
    if (bytes == 0)
    {
        return 0;
    }
    /* a multiple of 8, so that every buffer is aligned */
    size_t room = (BUFFER_BYTES / bytes) & ~(size_t)7;
    room = room > POINTS_MOST ? POINTS_MOST : room;
    for (int k = 0; k < count; k++)
    {
        places[k].buffer = buffers;
        buffers += places[k].direct ? 0 : room * places[k].size * loop->variant->operand[k].items;
    }
    return room;
}

static void run(const struct core_loop *loop, size_t n, char *const *args, const intptr_t *steps)
{
    const struct core_function *function = loop->function;
    const int count = function->inputs + function->outputs;
    struct place places[CORE_OPERANDS_MAX];
    void *pointers[CORE_OPERANDS_MAX];
    union
    {
        double aligned;
        char bytes[BUFFER_BYTES];
    } buffers;
    const size_t room = find_places(loop, args, steps, buffers.bytes, places);
    const size_t chunk = room ? room : n;
    for (size_t begin = 0; begin < n; begin += chunk)
    {
        const size_t part = n - begin < chunk ? n - begin : chunk;
        for (int k = 0; k < count; k++)
        {
            pointers[k] = places[k].direct ? places[k].first + (intptr_t)begin * places[k].step
                                           : places[k].buffer;
            if (k < function->inputs && !places[k].direct)
            {
                transfer(&places[k], &loop->variant->operand[k], begin, part, chunk, 1);
            }
        }
        loop->variant->call(&loop->context, part, pointers, chunk);
        for (int k = function->inputs; k < count; k++)
        {
            if (!places[k].direct)
            {
                transfer(&places[k], &loop->variant->operand[k], begin, part, chunk, 0);
            }
        }
    }
}

struct job
{
    const struct core_loop *loop;
    char *const *args;
    const intptr_t *steps;
};

static void run_job(size_t begin, size_t end, void *user)
{
    const struct job *job = user;
    const int count = job->loop->function->inputs + job->loop->function->outputs;
    char *args[CORE_OPERANDS_MAX];
    for (int k = 0; k < count; k++)
    {
        args[k] = job->args[k] + (intptr_t)begin * job->steps[k];
    }
    run(job->loop, end - begin, args, job->steps);
}

void core_run(char **args, const intptr_t *dims, const intptr_t *steps, void *data)
{
    struct job job = {data, args, steps};
    const size_t n = (size_t)dims[0];
    /* bad input gives NaN and says nothing more: NumPy would warn of flags that formulas leave */
    fenv_t before;
    feholdexcept(&before);
    if (job.loop->context.threads == 1)
    {
        run_job(0, n, &job);
    }
    else
    {
        cm_run_threads(job.loop->context.threads, n, CM_POINTS_PER_THREAD, run_job, &job);
    }
    fesetenv(&before);
}
