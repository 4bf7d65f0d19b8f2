/* SPDX-License-Identifier: MIT
 *
 * The curves through the leaves of a face: from the column i and the row j, 30 bits each, to the place on the
 * curve, 60 bits, and back. In words of 64 bits, one or a vector of them; whoever reads this has defined
 * CURVE_WORD, CURVE_NAME and CURVE_HALF, of 32 bits or more, which are undefined at the end. No branches and no
 * tables.
 *
 * Hilbert's curve is that of S2: going down from the highest bits, a level has a state, s (are i and j
 * exchanged?) and t (are both turned round?). With (a, b) = (i ^ t, j ^ t), or (j ^ t, i ^ t) if s, the digit is
 * 2 a + (a ^ b); then s changes if b = 0, and t if a = 1 and b = 0.
 *
 * As a ^ b = i ^ j, a step maps (s, t) by a matrix and a vector over the field of two elements that are known
 * from i and j alone:
 *     i = j    (s, t) -> (s + t + 1 + i, t)
 *     i != j   (s, t) -> (t + 1 + j, s + 1 + j)
 * so that all states follow from a prefix of compositions, in five steps for 30 levels. Both matrices are of
 * order two; if s and t change their names from level to level they become those of a group of order three,
 * which is that of the field of four elements, {0, 1, w, w + 1} with w^2 = w + 1: an element is two bits, x1 +
 * x2 w, and a composition of steps y -> m y + c takes two products.
 */
#ifndef LIBCUBEMAP_CURVE_BITS
#define LIBCUBEMAP_CURVE_BITS
#define CURVE_ALL 0x3fffffffu
#define CURVE_FIRST 0x2aaaaaaau /* the first, third... level: bits 29, 27... */
#define CURVE_OTHER 0x15555555u
#endif

/* Bit k to bit 2 k, and back. */
static inline CURVE_WORD CURVE_NAME(spread)(CURVE_WORD w)
{
    w = (w | (w << 16)) & 0x0000ffff0000ffffull;
    w = (w | (w << 8)) & 0x00ff00ff00ff00ffull;
    w = (w | (w << 4)) & 0x0f0f0f0f0f0f0f0full;
    w = (w | (w << 2)) & 0x3333333333333333ull;
    return (w | (w << 1)) & 0x5555555555555555ull;
}

static inline CURVE_WORD CURVE_NAME(gather)(CURVE_WORD w)
{
    w &= 0x5555555555555555ull;
    w = (w | (w >> 1)) & 0x3333333333333333ull;
    w = (w | (w >> 2)) & 0x0f0f0f0f0f0f0f0full;
    w = (w | (w >> 4)) & 0x00ff00ff00ff00ffull;
    w = (w | (w >> 8)) & 0x0000ffff0000ffffull;
    return (w | (w >> 16)) & 0x00000000ffffffffull;
}

/* Each bit becomes the sum of those above it, by two. */
static inline CURVE_WORD CURVE_NAME(sums_above)(CURVE_WORD w)
{
    w ^= w >> 1;
    w ^= w >> 2;
    w ^= w >> 4;
    w ^= w >> 8;
    w ^= w >> 16;
    return w >> 1;
}

static inline CURVE_WORD CURVE_NAME(morton)(CURVE_WORD i, CURVE_WORD j)
{
    return CURVE_NAME(spread)(i) | (CURVE_NAME(spread)(j) << 1);
}

/* The digits' higher bits, a. What is above the highest level has c = 0, so that its m, whatever it is, has no part in
 * anything. */
static inline CURVE_HALF CURVE_NAME(hilbert_bits)(CURVE_HALF i, CURVE_HALF j)
{
    CURVE_HALF d = i ^ j;
    CURVE_HALF not_j = j ^ CURVE_ALL;
    CURVE_HALF m1 = d | CURVE_OTHER;
    CURVE_HALF m2 = d ^ CURVE_ALL;
    CURVE_HALF c1 = not_j & m1;
    CURVE_HALF c2 = not_j & (d | CURVE_FIRST);
    for (int k = 1; k <= 16; k *= 2)
    {
        CURVE_HALF above1 = c1 >> k;
        CURVE_HALF above2 = c2 >> k;
        c1 ^= (m1 & above1) ^ (m2 & above2);
        c2 ^= (m1 & above2) ^ (m2 & (above1 ^ above2));
        above1 = m1 >> k;
        above2 = m2 >> k;
        CURVE_HALF m = (m1 & above1) ^ (m2 & above2);
        m2 = (m1 & above2) ^ (m2 & (above1 ^ above2));
        m1 = m;
    }
    c1 >>= 1;
    c2 >>= 1;
    CURVE_HALF s = (c1 & CURVE_FIRST) | (c2 & CURVE_OTHER);
    CURVE_HALF t = (c2 & CURVE_FIRST) | (c1 & CURVE_OTHER);
    return i ^ t ^ (s & d);
}

/* The place on Hilbert's curve, of a and of i ^ j. */
static inline CURVE_WORD CURVE_NAME(hilbert)(CURVE_WORD a, CURVE_WORD d)
{
    return (CURVE_NAME(spread)(a) << 1) | CURVE_NAME(spread)(d);
}

static inline void CURVE_NAME(from_hilbert)(CURVE_WORD place, CURVE_WORD *i, CURVE_WORD *j)
{
    CURVE_WORD a = CURVE_NAME(gather)(place >> 1);
    CURVE_WORD d = CURVE_NAME(gather)(place);
    CURVE_WORD b = a ^ d;
    CURVE_WORD s = CURVE_NAME(sums_above)(b ^ CURVE_ALL);
    CURVE_WORD turn = CURVE_NAME(sums_above)(a & d) ^ (s & d);
    *i = a ^ turn;
    *j = b ^ turn;
}

/* Hilbert's curve is mirrored on faces of odd numbers. */
static inline void CURVE_NAME(mirror)(CURVE_WORD face, CURVE_WORD *i, CURVE_WORD *j)
{
    CURVE_WORD exchange = (*i ^ *j) & -(face & 1);
    *i ^= exchange;
    *j ^= exchange;
}

/* The number of the leaf in that place of a face's curve. */
static inline CURVE_WORD CURVE_NAME(leaf)(CURVE_WORD face, CURVE_WORD place)
{
    return (face << 61) | (place << 1) | 1;
}

/* Of any cell: face, and i and j of its lower edges in leaves; the number of leaves along an edge. */
static inline CURVE_WORD CURVE_NAME(corner)(int is_hilbert, CURVE_WORD cell, CURVE_WORD *face,
                                            CURVE_WORD *i, CURVE_WORD *j)
{
    CURVE_WORD end = cell & -cell;
    CURVE_WORD size = CURVE_NAME(gather)(end);
    CURVE_WORD place = ((cell ^ end) >> 1) & 0x0fffffffffffffffull;
    *face = cell >> 61;
    if (is_hilbert)
    {
        CURVE_NAME(from_hilbert)(place, i, j);
        CURVE_NAME(mirror)(*face, i, j);
    }
    else
    {
        *i = CURVE_NAME(gather)(place);
        *j = CURVE_NAME(gather)(place >> 1);
    }
    *i &= -size;
    *j &= -size;
    return size;
}

#undef CURVE_WORD
#undef CURVE_HALF
#undef CURVE_NAME
