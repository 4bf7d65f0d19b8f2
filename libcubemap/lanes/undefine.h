/* SPDX-License-Identifier: MIT
 *
 * Takes the words of lanes/ back, so that they can be defined for the other precision; those of the
 * dialect too.
 */
#include <cubemap/kernel/undefine.h>

#undef LANES
#undef LANES_BYTES
#undef LANES_SCALAR
#undef LANES_INTEGER
#undef LANES_INDEX
#undef LANES_MAGIC
#undef LANES_WORD
#undef LANES_SIGN
#undef LANES_COMPARE
#undef lanes_or_nan
#undef lanes_all
#undef lanes_load
#undef lanes_some
#undef lanes_load_narrowed
#undef lanes_store_widened
#undef lanes_store
#undef lanes_load_faces
#undef lanes_store_faces
#undef lanes_index
#undef lanes_bit
#undef lanes_flip
#undef lanes_digit
#undef lanes_mask_of_signs
#undef CM_LANES_BITS
#undef CM_SCALAR_NAME
#undef CM_BACKEND
