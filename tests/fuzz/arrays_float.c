/* SPDX-License-Identifier: MIT */
#include "in_float.h"

#define FORWARD cm_forward_f32
#define INVERSE cm_inverse_f32
#define FORWARD_ARRAY cm_forward_array_f32
#define INVERSE_ARRAY cm_inverse_array_f32
#define FORWARD_STRIDED cm_forward_strided_f32
#define INVERSE_STRIDED cm_inverse_strided_f32
#include "arrays.h"
