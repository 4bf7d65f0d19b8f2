/* SPDX-License-Identifier: MIT
 *
 * Words that are the same for every instruction set with vectors, by the vector types of gcc and clang.
 * Read by the files of the instruction sets, which say what CM_REAL, LANES and LANES_BYTES are.
 */
#if CM_LANES_BITS == 64
#define CM_NAME(name) name##_lanes_f64
#define LANES_SCALAR double
#define LANES_INTEGER unsigned long long
#define LANES_MAGIC 4503599627370496.0 /* 2^52: the last bits of 2^52 + i are i */
#define CM_LIT(x) lanes_all(x)
#else
#define CM_NAME(name) name##_lanes_f32
#define LANES_SCALAR float
#define LANES_INTEGER unsigned
#define LANES_MAGIC 8388608.0f /* 2^23 */
#define CM_LIT(x) lanes_all(x##f)
#endif
#define CM_REAL_BITS CM_LANES_BITS

typedef LANES_INTEGER CM_NAME(lanes_integers) __attribute__((vector_size(LANES_BYTES)));
typedef LANES_SCALAR CM_NAME(lanes_unaligned)
    __attribute__((vector_size(LANES_BYTES), aligned(CM_LANES_BITS / 8), may_alias));

static inline __attribute__((always_inline)) CM_REAL CM_NAME(lanes_load_at)(const LANES_SCALAR *p)
{
    return (CM_REAL) * (const CM_NAME(lanes_unaligned) *)p;
}

static inline
    __attribute__((always_inline)) void CM_NAME(lanes_store_at)(LANES_SCALAR *p, CM_REAL x)
{
    *(CM_NAME(lanes_unaligned) *)p = (CM_NAME(lanes_unaligned))x;
}

#define lanes_load(p) CM_NAME(lanes_load_at)(p)
#define lanes_store(p, x) CM_NAME(lanes_store_at)(p, x)
/* The first n, LANES at most, and zeros; nothing else is read. */
#ifndef lanes_some
#if LANES == 2
#define lanes_some(p, n) ((CM_REAL){(n) > 0 ? (p)[0] : 0, (n) > 1 ? (p)[1] : 0})
#else
#define lanes_some(p, n)                                                                           \
    ((CM_REAL){(n) > 0 ? (p)[0] : 0, (n) > 1 ? (p)[1] : 0, (n) > 2 ? (p)[2] : 0,                   \
               (n) > 3 ? (p)[3] : 0})
#endif
#endif
#define CM_VARIANT(k) ((k).variant[0] != 0)

/* Look-up by face: bit 63 - i (in float 31 - i) of a word for face i, and digit i of a word of octal
 * digits. */
#define LANES_INDEX CM_NAME(lanes_integers)
#define LANES_WORD(bits) ((LANES_INTEGER)((bits) >> (64 - CM_LANES_BITS)))
#define LANES_SIGN ((LANES_INTEGER)1 << (CM_LANES_BITS - 1))

static inline __attribute__((always_inline)) LANES_INDEX CM_NAME(lanes_index_of)(CM_REAL face)
{
    CM_REAL magic = lanes_all(LANES_MAGIC);
    return ((LANES_INDEX)(face + magic) - (LANES_INDEX)magic) & 7;
}

static inline __attribute__((always_inline))
LANES_INDEX CM_NAME(lanes_bits_at)(uint64_t bits, LANES_INDEX index)
{
    return ((LANES_INDEX){0} + LANES_WORD(bits)) << index;
}

static inline __attribute__((always_inline))
CM_REAL CM_NAME(lanes_flip_at)(CM_REAL x, uint64_t bits, LANES_INDEX index)
{
    return (CM_REAL)((LANES_INDEX)x ^ (CM_NAME(lanes_bits_at)(bits, index) & LANES_SIGN));
}

static inline __attribute__((always_inline))
CM_REAL CM_NAME(lanes_digit_at)(uint64_t digits, LANES_INDEX index)
{
    CM_REAL magic = lanes_all(LANES_MAGIC);
    LANES_INDEX digit = (((LANES_INDEX){0} + (LANES_INTEGER)digits) >> (index * 3)) & 7;
    return (CM_REAL)(digit | (LANES_INDEX)magic) - magic;
}

#define lanes_index(face) CM_NAME(lanes_index_of)(face)
#define lanes_flip(x, bits, index) CM_NAME(lanes_flip_at)(x, bits, index)
#define lanes_bit(bits, index) lanes_mask_of_signs(CM_NAME(lanes_bits_at)(bits, index))
#define lanes_digit(digits, index) CM_NAME(lanes_digit_at)(digits, index)

#ifndef lanes_or_nan
#define lanes_or_nan(good, x) ((CM_REAL)((LANES_INDEX)(x) | ~(LANES_INDEX)(good)))
#endif
