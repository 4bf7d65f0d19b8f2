/* SPDX-License-Identifier: MIT
 *
 * Whole numbers of 64 bits beside vectors of double, a word to a lane, for cells and pixels. Read after the
 * words of an instruction set or of scalar.h, with CM_LANES_BITS 64; + - & | ^ << >> are C's own.
 */
#ifdef LANES_INTEGER
typedef uint64_t lanes_words __attribute__((vector_size(LANES_BYTES)));
typedef uint64_t lanes_words_unaligned
    __attribute__((vector_size(LANES_BYTES), aligned(8), may_alias));
#define lanes_words_all(w) ((lanes_words){0} + (uint64_t)(w))
#define lanes_words_load(p) ((lanes_words) * (const lanes_words_unaligned *)(p))
#define lanes_words_store(p, w) (*(lanes_words_unaligned *)(p) = (lanes_words_unaligned)(w))
#define lanes_words_of_bits(x) ((lanes_words)(x))
#define lanes_bits_of_words(w) ((CM_REAL)(w))
#define lanes_words_select(condition, a, b)                                                        \
    ((lanes_words)CM_SELECT(condition, (CM_REAL)(a), (CM_REAL)(b)))
#else
typedef uint64_t lanes_words;
#define lanes_words_all(w) ((uint64_t)(w))
#define lanes_words_load(p) (*(p))
#define lanes_words_store(p, w) (*(p) = (w))

static inline uint64_t lanes_words_of_bits(double x)
{
    uint64_t w;
    memcpy(&w, &x, sizeof w);
    return w;
}

static inline double lanes_bits_of_words(uint64_t w)
{
    double x;
    memcpy(&x, &w, sizeof x);
    return x;
}

#define lanes_words_select(condition, a, b) ((condition) ? (a) : (b))
#endif

#define LANES_WORDS_MAGIC 4503599627370496.0 /* 2^52: the last bits of 2^52 + i are i */

/* The word of a whole number in [0, 2^52), and back. */
CM_FN lanes_words lanes_words_of(CM_REAL x)
{
    CM_REAL magic = lanes_all(LANES_WORDS_MAGIC);
    return lanes_words_of_bits(x + magic) & lanes_words_all(0xfffffffffffffu);
}

CM_FN CM_REAL lanes_of_words(lanes_words w)
{
    CM_REAL magic = lanes_all(LANES_WORDS_MAGIC);
    return lanes_bits_of_words(w | lanes_words_of_bits(magic)) - magic;
}

/* The greatest whole number not above x, for x in [0, 2^51). */
CM_FN CM_REAL lanes_floor(CM_REAL x)
{
    CM_REAL magic = lanes_all(LANES_WORDS_MAGIC);
    CM_REAL nearest = (x + magic) - magic;
    return nearest - CM_SELECT(cm_less(x, nearest), CM_LIT(1.0), CM_LIT(0.0));
}
