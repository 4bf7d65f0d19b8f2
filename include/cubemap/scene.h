/* SPDX-License-Identifier: MIT
 *
 * All that the library cubemap-scene offers: cameras, poses, views and what modules of depth cameras share.
 */
#ifndef CUBEMAP_SCENE_H
#define CUBEMAP_SCENE_H

#include <cubemap/budget.h>
#include <cubemap/camera.h>
#include <cubemap/mesh.h>
#include <cubemap/pool.h>
#include <cubemap/pose.h>
#include <cubemap/random.h>
#include <cubemap/store.h>
#include <cubemap/trajectory.h>
#include <cubemap/view.h>
#include <cubemap/world.h>

#endif
