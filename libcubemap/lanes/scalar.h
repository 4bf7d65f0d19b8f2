/* SPDX-License-Identifier: MIT
 *
 * One point at a time, in plain C: the reference that every other path is compared with, and what
 * there is where no instruction set is known. The dialect's words are those of the backends for double
 * and float; here are only those of the loops.
 */
#define LANES 1
#define LANES_SCALAR CM_REAL
#define LANES_INDEX unsigned
#define lanes_all(x) (x)
#define lanes_load(p) (*(p))
#define lanes_some(p, n) ((n) > 0 ? *(p) : 0)
#define lanes_store(p, x) (*(p) = (x))
#define lanes_load_faces(bytes) ((CM_REAL) * (bytes))
#define lanes_store_faces(bytes, face) (*(bytes) = (uint8_t)(int)(face))
#define lanes_index(face) ((unsigned)(int)(face)&7u)
#define lanes_bit(bits, index) ((int)((bits) >> (63u - (index))) & 1)
#define lanes_flip(x, bits, index) (lanes_bit(bits, index) ? -(x) : (x))
#define lanes_digit(digits, index) ((CM_REAL)(((digits) >> (3u * (index))) & 7u))
#define lanes_or_nan(good, x) ((good) ? (x) : (CM_REAL)NAN)
