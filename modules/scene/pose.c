/* SPDX-License-Identifier: MIT */
#include <cubemap/pose.h>

void cm_pose_apply(const cm_pose *pose, const double world[3], double camera[3])
{
    const double from[3] = {world[0] - pose->position[0], world[1] - pose->position[1],
                            world[2] - pose->position[2]};
    cm_rotate(&pose->rotation, from, camera);
}

void cm_pose_apply_back(const cm_pose *pose, const double camera[3], double world[3])
{
    cm_rotate_back(&pose->rotation, camera, world);
    for (int i = 0; i < 3; i++)
    {
        world[i] += pose->position[i];
    }
}
