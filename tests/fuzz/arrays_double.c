/* SPDX-License-Identifier: MIT */
#include "in_double.h"

#define FORWARD cm_forward
#define INVERSE cm_inverse
#define FORWARD_ARRAY cm_forward_array
#define INVERSE_ARRAY cm_inverse_array
#define FORWARD_STRIDED cm_forward_strided
#define INVERSE_STRIDED cm_inverse_strided
#include "arrays.h"
