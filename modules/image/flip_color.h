/* SPDX-License-Identifier: MIT
 *
 * The colours of FLIP: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: a
 * difference evaluator for alternating images", Proceedings of the ACM on Computer Graphics and Interactive Techniques
 * 3, 2020, sections 4.1 and 5; matrices and white point as in the authors' program.
 */
#ifndef IMAGE_FLIP_COLOR_H
#define IMAGE_FLIP_COLOR_H

/* Linear light of sRGB, 0 to 1; below 0 as 0, above 1 as 1, NaN as it is. */
double cm_flip_linear_from_srgb(double value);

/* The tone mapping curve that stands for ACES (K. Narkowicz, 2016) without its exposure of 0.6, of values of 0 or
 * more. */
double cm_flip_tone(double value);

/* Where that curve has a value between 0 and 1. */
double cm_flip_tone_inverse(double value);

/* Linear red, green and blue to the opponent space YCxCz. */
void cm_flip_opponent_from_linear(const double linear[3], double opponent[3]);

/* YCxCz, brought into the cube of linear colours from 0 to 1, to CIELAB whose a and b are multiplied by L / 100 (the
 * Hunt effect). */
void cm_flip_hunt_from_opponent(const double opponent[3], double hunt[3]);

/* From 0 to 1: how far two such colours are apart, HyAB to the power of 0.7, redistributed. greatest is
 * cm_flip_greatest_difference. */
double cm_flip_color_difference(const double one[3], const double other[3], double greatest);

/* HyAB to the power of 0.7 between green and blue, the farthest colours. */
double cm_flip_greatest_difference(void);

#endif
