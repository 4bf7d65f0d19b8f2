/* SPDX-License-Identifier: MIT */
#include "field_method.h"

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

size_t field_methods(const int is_asked[CM_FLOW_METHODS], const field_method **methods)
{
    static field_method made[METHODS_MOST];
    size_t count = 0;
    made[count++] = (field_method){.kind = KIND_UNCOMPENSATED};
    made[count++] = (field_method){.kind = KIND_PIXELWISE};
    for (int scheme = CM_CCM_B; scheme <= CM_NCM_NEAREST; scheme++)
    {
        made[count++] = (field_method){.kind = KIND_TRUTH, .scheme = (cm_compensation)scheme};
    }
    for (int flow = 0; flow < CM_FLOW_METHODS; flow++)
    {
        for (int scheme = CM_CCM_B; scheme <= CM_NCM_NEAREST && is_asked[flow]; scheme++)
        {
            const int changes = scheme < CM_NCM ? 1 : CHANGES;
            for (int change = 0; change < changes; change++)
            {
                made[count++] = (field_method){KIND_FLOW, (cm_compensation)scheme,
                                               (field_change)change, (cm_flow_method)flow};
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

/* ---- before flows ---- */

/* How many of the 8 neighbours are less: Zabih and Woodfill's rank. */
static cm_status take_census(const float *picture, float *to)
{
    static uint8_t census[FIELD_PIXELS];
    const cm_status status = cm_channel_census(FIELD_WIDTH, FIELD_HEIGHT, picture, census);
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        unsigned count = 0;
        for (unsigned bits = census[i]; bits != 0; bits &= bits - 1)
        {
            count++;
        }
        to[i] = (float)count;
    }
    return status;
}

static cm_status change_picture(field_change change, const float *picture, float *to)
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
        status = take_census(picture, to);
        break;
    }
    return status;
}

/* ---- flows ---- */

/* The pictures of a frame as flows are found of them, each changed once. */
typedef struct changed_pictures
{
    const float *picture[2]; /* now, before */
    int is_changed[2][FIELD_CHANNELS];
    cm_status status; /* of the changes */
} changed_pictures;

static const float *changed_picture(changed_pictures *c, field_change change, int frame,
                                    uint32_t channel)
{
    static float changed[2][FIELD_CHANNELS][FIELD_PIXELS];
    float *to = changed[-frame][channel];
    if (!c->is_changed[-frame][channel])
    {
        const cm_status status =
            change_picture(change, c->picture[-frame] + channel * FIELD_PIXELS, to);
        c->status = c->status == CM_OK ? status : c->status;
        c->is_changed[-frame][channel] = 1;
    }
    return to;
}

static double time_of(int frame, uint32_t channel)
{
    return (double)frame * FIELD_CHANNELS + channel;
}

static cm_status find_flow(const cm_vision *vision, const field_method *method,
                           const cm_flow_pair *p, changed_pictures *pictures, float *to,
                           char *message)
{
    const float *const from_picture =
        changed_picture(pictures, method->change, p->from_frame, p->from_channel);
    const float *const to_picture =
        changed_picture(pictures, method->change, p->to_frame, p->to_channel);
    return pictures->status != CM_OK ? pictures->status
                                     : vision->find_flow(method->flow, FIELD_WIDTH, FIELD_HEIGHT,
                                                         from_picture, to_picture, to, message);
}

static cm_status find_flows(const cm_vision *vision, const field_method *method,
                            const field_scene *scene, double begin, changed_pictures *pictures,
                            float *flow, char *message)
{
    cm_flow_pair pair[FLOWS_MOST];
    size_t count = 0;
    cm_status status =
        cm_compensation_flows(method->scheme, FIELD_CHANNELS, FLOWS_MOST, pair, &count);
    for (size_t i = 0; i < count && status == CM_OK; i++)
    {
        const cm_flow_pair *p = &pair[i];
        float *to = flow + 2 * i * FIELD_PIXELS;
        status = method->kind == KIND_TRUTH
                     ? draw_flow(scene, begin + time_of(p->from_frame, p->from_channel),
                                 begin + time_of(p->to_frame, p->to_channel), to)
                     : find_flow(vision, method, p, pictures, to, message);
    }
    return status;
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

cm_status run_method(const cm_vision *vision, const field_method *method, const field_scene *scene,
                     double begin, const float *before, const float *now, float *corrected,
                     char *message)
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
    cm_status status = CM_OK;
    switch (method->kind)
    {
    case KIND_UNCOMPENSATED:
        memcpy(corrected, now, FIELD_CHANNELS * FIELD_PIXELS * sizeof *now);
        break;
    case KIND_PIXELWISE:
        status = cm_compensate_pixelwise(&input, pixelwise_threshold(now), corrected, NULL);
        break;
    case KIND_TRUTH:
    case KIND_FLOW:
        status = find_flows(vision, method, scene, begin, &pictures, flow, message);
        status = status == CM_OK ? cm_compensate(&input, method->scheme, NULL, corrected) : status;
        break;
    }
    return status;
}
