/* SPDX-License-Identifier: MIT
 *
 * Where a lens folds in the directions between two whose folds are known.
 */
#ifndef MODULES_SCENE_CAMERA_FOLD_BETWEEN_H
#define MODULES_SCENE_CAMERA_FOLD_BETWEEN_H

#include "camera_fold.h"

/* What is certain of all directions between two that are near to each other. */
typedef struct cm_fold_between
{
    double sure; /* up to this length signs are good */
    double
        line; /* and up to this they are where the field is, if is_divided; beyond it nothing is of the field */
    int is_divided;
} cm_fold_between;

/* Of two directions and their first lengths. */
cm_fold_between cm_fold_look_between(const cm_fold *fold, const cm_fold_ray *one,
                                     const cm_fold_ray *next, double one_first, double next_first);

#endif
