/* SPDX-License-Identifier: MIT */
#include "field_method.h"

#include "bench/harness/harness.h"

#include <stdio.h>
#include <string.h>

enum
{
    CHANGES = CHANGE_CENSUS + 1,
    METHODS_MOST = 8 + CM_FLOW_METHODS * (4 + 2 * CHANGES),
    FLOWS_MOST = 2 * FIELD_CHANNELS
};

const char *field_change_name(field_change change)
{
    static const char *const names[] = {"I", "I N", "I L", "I H", "I C", "TG", "TG N", "TC"};
    return names[change];
}

/* flow: words with commas between them, or NULL for all. */
static int is_asked(const char *flow, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = flow; at != NULL && *at != '\0';)
    {
        const size_t word = strcspn(at, ",");
        if (word == length && strncmp(at, name, length) == 0)
        {
            return 1;
        }
        at += word + (at[word] == ',');
    }
    return flow == NULL;
}

size_t field_methods(const char *flow, const field_method **methods)
{
    static field_method made[METHODS_MOST];
    size_t count = 0;
    made[count++] = (field_method){.kind = KIND_UNCOMPENSATED};
    made[count++] = (field_method){.kind = KIND_PIXELWISE};
    for (int scheme = CM_CCM_B; scheme <= CM_NCM_NEAREST && is_asked(flow, "true"); scheme++)
    {
        made[count++] = (field_method){.kind = KIND_TRUTH, .scheme = (cm_compensation)scheme};
    }
    for (int f = 0; f < CM_FLOW_METHODS; f++)
    {
        const cm_flow_method by = (cm_flow_method)f;
        if (!is_asked(flow, cm_flow_method_name(by)))
        {
            continue;
        }
        for (int scheme = CM_CCM_B; scheme <= CM_NCM_NEAREST; scheme++)
        {
            const int changes = scheme < CM_NCM ? 1 : CHANGES;
            for (int change = 0; change < changes; change++)
            {
                made[count++] =
                    (field_method){KIND_FLOW, (cm_compensation)scheme, (field_change)change, by};
            }
        }
    }
    *methods = made;
    return count;
}

const char *name_flow(const field_method *method)
{
    return method->kind == KIND_TRUTH  ? "true"
           : method->kind == KIND_FLOW ? cm_flow_method_name(method->flow)
                                       : "";
}

void name_method(const field_method *method, char *text, size_t size)
{
    if (method->kind >= KIND_TRUTH)
    {
        snprintf(text, size, "%s-%s %s", cm_compensation_name(method->scheme),
                 field_change_name(method->change), name_flow(method));
        return;
    }
    snprintf(text, size, "%s", method->kind == KIND_PIXELWISE ? "PAC" : "uncompensated");
}

static void expect(cm_status status, const char *what)
{
    if (status != CM_OK)
    {
        fprintf(harness_err(), "%s: %s: %s\n", program_name(), what, cm_status_text(status));
        harness_end();
    }
}

/* ---- before flows ---- */

/* How many of the 8 neighbours are less: Zabih and Woodfill's rank. */
static void take_census(const float *picture, float *to)
{
    static uint8_t census[FIELD_PIXELS];
    expect(cm_channel_census(FIELD_WIDTH, FIELD_HEIGHT, picture, census), "census");
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        unsigned count = 0;
        for (unsigned bits = census[i]; bits != 0; bits &= bits - 1)
        {
            count++;
        }
        to[i] = (float)count;
    }
}

static void change_picture(field_change change, const float *picture, float *to)
{
    const uint32_t w = FIELD_WIDTH, h = FIELD_HEIGHT;
    cm_status status = CM_OK;
    switch (change)
    {
    case CHANGE_NONE:
        memcpy(to, picture, FIELD_PIXELS * sizeof *to);
        break;
    case CHANGE_GLOBAL:
        status = cm_channel_normalize(w, h, picture, 1.0, to);
        break;
    case CHANGE_LOCAL:
        status = cm_channel_normalize_locally(w, h, picture, 15, to);
        break;
    case CHANGE_EQUALIZED:
        status = cm_channel_equalize(w, h, picture, 256, to);
        break;
    case CHANGE_TILES:
        status = cm_channel_equalize_locally(w, h, picture, 8, 3.0, to);
        break;
    case CHANGE_GRADIENT:
    case CHANGE_GRADIENT_N:
        status = cm_channel_gradient(w, h, picture, to);
        if (change == CHANGE_GRADIENT_N && status == CM_OK)
        {
            status = cm_channel_normalize(w, h, to, 1.0, to);
        }
        break;
    case CHANGE_CENSUS:
        take_census(picture, to);
        break;
    }
    expect(status, field_change_name(change));
}

/* ---- flows ---- */

/* The pictures of a frame as flows are found of them, each changed once. */
typedef struct changed_pictures
{
    const float *picture[2]; /* now, before */
    int is_changed[2][FIELD_CHANNELS];
} changed_pictures;

static const float *changed_picture(changed_pictures *c, field_change change, int frame,
                                    uint32_t channel)
{
    static float changed[2][FIELD_CHANNELS][FIELD_PIXELS];
    float *to = changed[-frame][channel];
    if (!c->is_changed[-frame][channel])
    {
        change_picture(change, c->picture[-frame] + channel * FIELD_PIXELS, to);
        c->is_changed[-frame][channel] = 1;
    }
    return to;
}

static double time_of(int frame, uint32_t channel)
{
    return (double)frame * FIELD_CHANNELS + channel;
}

static void find_flows(const field_method *method, const field_scene *scene, double begin,
                       changed_pictures *pictures, float *flow)
{
    cm_flow_pair pair[FLOWS_MOST];
    size_t count = 0;
    expect(cm_compensation_flows(method->scheme, FIELD_CHANNELS, FLOWS_MOST, pair, &count),
           "flows");
    for (size_t i = 0; i < count; i++)
    {
        const cm_flow_pair *p = &pair[i];
        float *to = flow + 2 * i * FIELD_PIXELS;
        if (method->kind == KIND_TRUTH)
        {
            draw_flow(scene, begin + time_of(p->from_frame, p->from_channel),
                      begin + time_of(p->to_frame, p->to_channel), to);
            continue;
        }
        char message[CM_FLOW_MESSAGE] = "";
        expect(
            cm_flow_find(method->flow, FIELD_WIDTH, FIELD_HEIGHT,
                         changed_picture(pictures, method->change, p->from_frame, p->from_channel),
                         changed_picture(pictures, method->change, p->to_frame, p->to_channel), to,
                         message),
            message);
    }
}

/* A tenth of the first channel's range: more than noise, less than what comes from another surface. */
static double pixelwise_threshold(const float *now)
{
    float least = now[0], most = now[0];
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        least = now[i] < least ? now[i] : least;
        most = now[i] > most ? now[i] : most;
    }
    return 0.1 * (double)(most - least);
}

void run_method(const field_method *method, const field_scene *scene, double begin,
                const float *before, const float *now, float *corrected)
{
    static float flow[2 * FLOWS_MOST * FIELD_PIXELS];
    const cm_compensation_input input = {.size = sizeof input,
                                         .width = FIELD_WIDTH,
                                         .height = FIELD_HEIGHT,
                                         .channels = FIELD_CHANNELS,
                                         .now = now,
                                         .before = before,
                                         .flow = flow};
    changed_pictures pictures = {.picture = {now, before}};
    switch (method->kind)
    {
    case KIND_UNCOMPENSATED:
        memcpy(corrected, now, FIELD_CHANNELS * FIELD_PIXELS * sizeof *now);
        break;
    case KIND_PIXELWISE:
        expect(cm_compensate_pixelwise(&input, pixelwise_threshold(now), corrected, NULL), "PAC");
        break;
    case KIND_TRUTH:
    case KIND_FLOW:
        find_flows(method, scene, begin, &pictures, flow);
        expect(cm_compensate(&input, method->scheme, NULL, corrected), "compensation");
        break;
    }
}
