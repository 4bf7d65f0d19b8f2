/* SPDX-License-Identifier: MIT
 *
 * Scenes that move before a camera which takes its channels one after the other, as pictures of any moment: of several
 * wavebands, drawn, or of a time-of-flight camera's phases, cast by rays. Something textured goes sideways at a constant
 * speed, or a star turns, before a textured wall.
 */
#ifndef CUBEMAP_TOOLS_TOF_FIELD_SCENE_H
#define CUBEMAP_TOOLS_TOF_FIELD_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    FIELD_WIDTH = 320,
    FIELD_HEIGHT = 240,
    FIELD_PIXELS = FIELD_WIDTH * FIELD_HEIGHT,
    FIELD_CHANNELS = 4
};

typedef struct field_scene
{
    const char *name;
    int is_tof;   /* phase images, else wavebands of 0..255 */
    int turns;    /* a star, else something that goes to the right */
    double speed; /* pixels or degrees from one channel to the next */
} field_scene;

size_t field_scene_count(void);
const field_scene *field_scene_at(size_t index);

/* The picture that a channel has at a time in steps from channel to channel, without noise. Not in several threads at a time. */
cm_status draw_channel(const field_scene *scene, uint32_t channel, double time, float *picture);

/* Where what is seen at one time is at another: columns, rows of each pixel of the first. */
cm_status draw_flow(const field_scene *scene, double from, double to, float *flow);

/* With it: counts of electrons, or normal noise of 1; `shot` counts pictures, so that no two have the same. */
void add_noise(const field_scene *scene, uint32_t shot, float *picture);

#ifdef __cplusplus
}
#endif

#endif
