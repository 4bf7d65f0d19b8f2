/* SPDX-License-Identifier: MIT */
#include "in_double.h"

#define FORWARD cm_forward
#define INVERSE cm_inverse
#define FORWARD_ARRAY cm_forward_array
#define INVERSE_ARRAY cm_inverse_array
#define FORWARD_STRIDED cm_forward_strided
#define INVERSE_STRIDED cm_inverse_strided
#define FORWARD_ARRAY_THREADS cm_forward_array_threads
#define INVERSE_ARRAY_THREADS cm_inverse_array_threads
#define FORWARD_STRIDED_THREADS cm_forward_strided_threads
#define INVERSE_STRIDED_THREADS cm_inverse_strided_threads
#define FORWARD_JACOBIAN cm_forward_jacobian
#define INVERSE_JACOBIAN cm_inverse_jacobian
#define FORWARD_JACOBIAN_ARRAY cm_forward_jacobian_array
#define INVERSE_JACOBIAN_ARRAY cm_inverse_jacobian_array
#define FORWARD_JACOBIAN_ARRAY_THREADS cm_forward_jacobian_array_threads
#define INVERSE_JACOBIAN_ARRAY_THREADS cm_inverse_jacobian_array_threads
#include "arrays.h"
