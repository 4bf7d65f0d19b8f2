/* SPDX-License-Identifier: MIT
 *
 * Words and numbers beside each other, for healpix_lattice.h, which reads it: rounding, products, bits of two
 * words in turn.
 */
#define PIXELS_MAGIC 6755399441055744.0 /* 2^52 + 2^51: for numbers of both signs */

/* What an instruction set has one instruction for. */
#define PIXELS_SPREAD_FOURS                                                                        \
    _mm_setr_epi8(0x00, 0x01, 0x04, 0x05, 0x10, 0x11, 0x14, 0x15, 0x40, 0x41, 0x44, 0x45, 0x50,    \
                  0x51, 0x54, 0x55)
#if defined(LANES_INTEGER) && defined(__AVX512DQ__) && LANES_BYTES == 64
#define PIXELS_FLOOR(x) _mm512_roundscale_pd(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)
#define PIXELS_WORD_OF(x) _mm512_cvttpd_epu64(x)
#define PIXELS_OF_WORD(w) _mm512_cvtepu64_pd(w)
#define PIXELS_LOOK_UP(w)                                                                          \
    (lanes_words) _mm512_shuffle_epi8(_mm512_broadcast_i32x4(PIXELS_SPREAD_FOURS), (__m512i)(w))
#define PIXELS_UNPACK_BYTES(half, a, b)                                                            \
    (lanes_words) _mm512_unpack##half##_epi8((__m512i)(a), (__m512i)(b))
#define PIXELS_UNPACK_WORDS(half, a, b)                                                            \
    (lanes_words) _mm512_unpack##half##_epi64((__m512i)(a), (__m512i)(b))
#elif defined(LANES_INTEGER) && defined(__AVX__) && LANES_BYTES == 32
#define PIXELS_FLOOR(x) _mm256_floor_pd(x)
#define PIXELS_LOOK_UP(w)                                                                          \
    (lanes_words)                                                                                  \
        _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(PIXELS_SPREAD_FOURS), (__m256i)(w))
#define PIXELS_UNPACK_BYTES(half, a, b)                                                            \
    (lanes_words) _mm256_unpack##half##_epi8((__m256i)(a), (__m256i)(b))
#define PIXELS_UNPACK_WORDS(half, a, b)                                                            \
    (lanes_words) _mm256_unpack##half##_epi64((__m256i)(a), (__m256i)(b))
#elif defined(LANES_INTEGER) && defined(__ARM_NEON)
#define PIXELS_FLOOR(x) vrndmq_f64(x)
#endif

/* The greatest whole number not above x, and the nearest one, for |x| < 2^51; x otherwise makes some number. */
CM_FN CM_REAL pixels_floor(CM_REAL x)
{
#ifdef PIXELS_FLOOR
    return PIXELS_FLOOR(x);
#else
    CM_REAL magic = CM_LIT(PIXELS_MAGIC);
    CM_REAL nearest = (x + magic) - magic;
    return nearest - CM_SELECT(cm_less(x, nearest), CM_LIT(1.0), CM_LIT(0.0));
#endif
}

CM_FN CM_REAL pixels_nearest(CM_REAL x)
{
    CM_REAL magic = CM_LIT(PIXELS_MAGIC);
    return (x + magic) - magic;
}

/* The word of a number in [0, 2^51), rounded downwards; of a whole number in [0, 2^52); and back. */
CM_FN lanes_words pixels_word_below(CM_REAL x)
{
#ifdef PIXELS_WORD_OF
    return (lanes_words)PIXELS_WORD_OF(x);
#else
    return lanes_words_of(pixels_floor(x));
#endif
}

CM_FN lanes_words pixels_word_of(CM_REAL x)
{
#ifdef PIXELS_WORD_OF
    return (lanes_words)PIXELS_WORD_OF(x);
#else
    return lanes_words_of(x);
#endif
}

CM_FN CM_REAL pixels_of_word(lanes_words w)
{
#ifdef PIXELS_OF_WORD
    return PIXELS_OF_WORD((__m512i)w);
#else
    return lanes_of_words(w);
#endif
}

/* The number nearest to any word. */
CM_FN CM_REAL pixels_near_word(lanes_words w)
{
#ifdef PIXELS_OF_WORD
    return PIXELS_OF_WORD((__m512i)w);
#else
    CM_REAL low = lanes_of_words(w & lanes_words_all(0xffffffffu));
    return cm_mad(lanes_of_words(w >> 32), CM_LIT(4294967296.0), low);
#endif
}

/* The product of two numbers below 2^32: what is above in a word does not count. */
CM_FN lanes_words pixels_product(lanes_words a, lanes_words b)
{
#if !defined(LANES_INTEGER)
    return (a & 0xffffffffu) * (b & 0xffffffffu);
#elif LANES_BYTES == 64
    return (lanes_words)_mm512_mul_epu32((__m512i)a, (__m512i)b);
#elif LANES_BYTES == 32
    return (lanes_words)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#elif defined(__SSE2__)
    return (lanes_words)_mm_mul_epu32((__m128i)a, (__m128i)b);
#else
    return (lanes_words)vmull_u32(vmovn_u64((uint64x2_t)a), vmovn_u64((uint64x2_t)b));
#endif
}

/* Is the word, as a number with a sign, below zero? */
CM_FN CM_BOOL pixels_is_negative(lanes_words w)
{
#ifdef LANES_INTEGER
    return lanes_mask_of_signs(lanes_bits_of_words(w));
#else
    return (CM_BOOL)(w >> 63);
#endif
}

/* The bits of a word below 2^32, from the lowest, with a zero after each. */
CM_FN lanes_words pixels_spread(lanes_words w)
{
    w = (w | w << 16) & lanes_words_all(0x0000ffff0000ffffu);
    w = (w | w << 8) & lanes_words_all(0x00ff00ff00ff00ffu);
    w = (w | w << 4) & lanes_words_all(0x0f0f0f0f0f0f0f0fu);
    w = (w | w << 2) & lanes_words_all(0x3333333333333333u);
    return (w | w << 1) & lanes_words_all(0x5555555555555555u);
}

/* The bits of x and y below 2^32 in turn, from the lowest of x. */
CM_FN lanes_words pixels_interleave(lanes_words x, lanes_words y)
{
#ifdef PIXELS_LOOK_UP
    /* the bits of each four spread to a byte, by look-up; then the fours of each byte side by side, which puts
     * those of the x and y of every second lane into the two words of 16 bytes */
    lanes_words fours = lanes_words_all(0x0f0f0f0f0f0f0f0fu);
    lanes_words both = x | y << 32;
    lanes_words low = PIXELS_LOOK_UP(both & fours);
    lanes_words high = PIXELS_LOOK_UP((both >> 4) & fours);
    lanes_words even = PIXELS_UNPACK_BYTES(lo, low, high);
    lanes_words odd = PIXELS_UNPACK_BYTES(hi, low, high);
    return PIXELS_UNPACK_WORDS(lo, even, odd) | PIXELS_UNPACK_WORDS(hi, even, odd) << 1;
#else
    return pixels_spread(x) | pixels_spread(y) << 1;
#endif
}

/* Every second bit of a word, from the lowest. */
CM_FN lanes_words pixels_gather(lanes_words w)
{
    w = w & lanes_words_all(0x5555555555555555u);
    w = (w | w >> 1) & lanes_words_all(0x3333333333333333u);
    w = (w | w >> 2) & lanes_words_all(0x0f0f0f0f0f0f0f0fu);
    w = (w | w >> 4) & lanes_words_all(0x00ff00ff00ff00ffu);
    w = (w | w >> 8) & lanes_words_all(0x0000ffff0000ffffu);
    return (w | w >> 16) & lanes_words_all(0x00000000ffffffffu);
}

/* a / b, rounded as a division does where that is exact; b from 2^-60 to 2^60. With CM_ROUGH_INVERSE(x), 1 / x to
 * 14 bits, it is one step of Newton's and the remainder. */
CM_FN CM_REAL pixels_quotient(CM_REAL a, CM_REAL b)
{
#ifdef CM_ROUGH_INVERSE
    CM_REAL y = CM_ROUGH_INVERSE(b);
    y = cm_mad(y, cm_mad(-b, y, CM_LIT(1.0)), y);
    CM_REAL q = a * y;
    return cm_mad(cm_mad(-q, b, a), y, q);
#else
    return a / b;
#endif
}
