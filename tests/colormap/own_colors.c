/* SPDX-License-Identifier: MIT
 *
 * Colours as the papers print them: CAM16 with 0.1 added to each response, hues as angles.
 */
#include "own_colors.h"

#include <math.h>
#include <string.h>

/* XYZ of the primaries of IEC 61966-2-1 and of its white, with Y = 1 for white. */
static const double primary[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
static const double white[2] = {0.3127, 0.3290};

static double determinant(double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static void xyz_of(const double chromaticity[2], double xyz[3])
{
    xyz[0] = chromaticity[0] / chromaticity[1];
    xyz[1] = 1.0;
    xyz[2] = (1.0 - chromaticity[0] - chromaticity[1]) / chromaticity[1];
}

/* The columns are the primaries, so bright that their sum is white: by Cramer's rule. */
void derive_matrix(double matrix[3][3])
{
    double columns[3][3], sum[3], bright[3];
    xyz_of(white, sum);
    for (int i = 0; i < 3; i++)
    {
        double xyz[3];
        xyz_of(primary[i], xyz);
        for (int k = 0; k < 3; k++)
        {
            columns[k][i] = xyz[k];
        }
    }
    for (int i = 0; i < 3; i++)
    {
        double replaced[3][3];
        memcpy(replaced, columns, sizeof replaced);
        for (int k = 0; k < 3; k++)
        {
            replaced[k][i] = sum[k];
        }
        bright[i] = determinant(replaced) / determinant(columns);
    }
    for (int k = 0; k < 3; k++)
    {
        for (int i = 0; i < 3; i++)
        {
            matrix[k][i] = columns[k][i] * bright[i];
        }
    }
}

static void own_xyz(const double srgb[3], double xyz[3])
{
    double matrix[3][3];
    derive_matrix(matrix);
    xyz[0] = xyz[1] = xyz[2] = 0.0;
    for (int i = 0; i < 3; i++)
    {
        /* where the branches of the transfer function meet */
        double linear =
            srgb[i] <= 0.0404482362771082 ? srgb[i] / 12.92 : pow((srgb[i] + 0.055) / 1.055, 2.4);
        for (int k = 0; k < 3; k++)
        {
            xyz[k] += matrix[k][i] * linear;
        }
    }
}

/* CIE 15:2004, 8.2.2. */
void own_luv(const double srgb[3], double luv[3])
{
    double xyz[3], of_white[3];
    own_xyz(srgb, xyz);
    xyz_of(white, of_white);
    double sum = xyz[0] + 15.0 * xyz[1] + 3.0 * xyz[2];
    double white_sum = of_white[0] + 15.0 * of_white[1] + 3.0 * of_white[2];
    double y = xyz[1];
    luv[0] = y > 216.0 / 24389.0 ? 116.0 * cbrt(y) - 16.0 : y * 24389.0 / 27.0;
    luv[1] = y > 0.0 ? 13.0 * luv[0] * (4.0 * xyz[0] / sum - 4.0 * of_white[0] / white_sum) : 0.0;
    luv[2] = y > 0.0 ? 13.0 * luv[0] * (9.0 * y / sum - 9.0 / white_sum) : 0.0;
}

/* ---------------------------------------------------------------- CIELAB and CIEDE2000 */

static double root_of(double part)
{
    return part > 216.0 / 24389.0 ? cbrt(part) : 841.0 / 108.0 * part + 4.0 / 29.0;
}

void own_lab(const double srgb[3], double lab[3])
{
    double xyz[3], of_white[3];
    own_xyz(srgb, xyz);
    xyz_of(white, of_white);
    double y = root_of(xyz[1]);
    lab[0] = 116.0 * y - 16.0;
    lab[1] = 500.0 * (root_of(xyz[0] / of_white[0]) - y);
    lab[2] = 200.0 * (y - root_of(xyz[2] / of_white[2]));
}

static double angle_of(double a, double b)
{
    double angle = a == 0.0 && b == 0.0 ? 0.0 : atan2(b, a) * 180.0 / PI;
    return angle < 0.0 ? angle + 360.0 : angle;
}

static double cosine(double degrees)
{
    return cos(degrees * PI / 180.0);
}

/* Sharma et al. 2005, equations 2 to 22, by their numbers. */
double own_ciede2000(const double one[3], const double other[3])
{
    double mean = (hypot(one[1], one[2]) + hypot(other[1], other[2])) / 2.0;
    double g = 0.5 * (1.0 - sqrt(pow(mean, 7.0) / (pow(mean, 7.0) + pow(25.0, 7.0))));
    double a1 = (1.0 + g) * one[1], a2 = (1.0 + g) * other[1];
    double c1 = hypot(a1, one[2]), c2 = hypot(a2, other[2]);
    double h1 = angle_of(a1, one[2]), h2 = angle_of(a2, other[2]);
    double dh = c1 * c2 == 0.0           ? 0.0
                : fabs(h2 - h1) <= 180.0 ? h2 - h1
                : h2 > h1                ? h2 - h1 - 360.0
                                         : h2 - h1 + 360.0;
    double step = 2.0 * sqrt(c1 * c2) * sin(dh * PI / 360.0);
    double l = (one[0] + other[0]) / 2.0, c = (c1 + c2) / 2.0;
    double h = c1 * c2 == 0.0           ? h1 + h2
               : fabs(h1 - h2) <= 180.0 ? (h1 + h2) / 2.0
               : h1 + h2 < 360.0        ? (h1 + h2 + 360.0) / 2.0
                                        : (h1 + h2 - 360.0) / 2.0;
    double t = 1.0 - 0.17 * cosine(h - 30.0) + 0.24 * cosine(2.0 * h) +
               0.32 * cosine(3.0 * h + 6.0) - 0.20 * cosine(4.0 * h - 63.0);
    double turn = 30.0 * exp(-pow((h - 275.0) / 25.0, 2.0));
    double r =
        -sin(2.0 * turn * PI / 180.0) * 2.0 * sqrt(pow(c, 7.0) / (pow(c, 7.0) + pow(25.0, 7.0)));
    double by_l =
        (other[0] - one[0]) / (1.0 + 0.015 * pow(l - 50.0, 2.0) / sqrt(20.0 + pow(l - 50.0, 2.0)));
    double by_c = (c2 - c1) / (1.0 + 0.045 * c);
    double by_h = step / (1.0 + 0.015 * c * t);
    return sqrt(by_l * by_l + by_c * by_c + by_h * by_h + r * by_c * by_h);
}

/* ---------------------------------------------------------------- CAM16-UCS */

/* Post-adaptation responses of XYZ with Y = 100, with the paper's 0.1. */
static void own_responses(const double xyz[3], double degree, double level, double response[3])
{
    static const double matrix[3][3] = {{0.401288, 0.650173, -0.051461},
                                        {-0.250268, 1.204414, 0.045854},
                                        {-0.002079, 0.048952, 0.953127}};
    double of_white[3];
    xyz_of(white, of_white);
    for (int i = 0; i < 3; i++)
    {
        double cone = 0.0, cone_of_white = 0.0;
        for (int k = 0; k < 3; k++)
        {
            cone += matrix[i][k] * xyz[k];
            cone_of_white += matrix[i][k] * 100.0 * of_white[k];
        }
        double adapted = (degree * 100.0 / cone_of_white + 1.0 - degree) * cone;
        double power = pow(level * fabs(adapted) / 100.0, 0.42);
        response[i] = (adapted < 0.0 ? -400.0 : 400.0) * power / (power + 27.13) + 0.1;
    }
}

/* Li et al. 2017, appendix A and B, in the viewing conditions of sRGB. */
void own_ucs(const double srgb[3], double ucs[3])
{
    double adapting = 64.0 / PI / 5.0, n = 0.2;
    double degree = 1.0 - exp((-adapting - 42.0) / 92.0) / 3.6;
    double k = 1.0 / (5.0 * adapting + 1.0);
    double level = 0.2 * pow(k, 4.0) * 5.0 * adapting +
                   0.1 * pow(1.0 - pow(k, 4.0), 2.0) * pow(5.0 * adapting, 1.0 / 3.0);
    double induction = 0.725 * pow(1.0 / n, 0.2);
    double xyz[3], of_white[3], r[3], w[3];
    xyz_of(white, of_white);
    own_xyz(srgb, xyz);
    for (int i = 0; i < 3; i++)
    {
        xyz[i] *= 100.0;
        of_white[i] *= 100.0;
    }
    own_responses(xyz, degree, level, r);
    own_responses(of_white, degree, level, w);
    double a = r[0] - 12.0 * r[1] / 11.0 + r[2] / 11.0, b = (r[0] + r[1] - 2.0 * r[2]) / 9.0;
    double h = atan2(b, a);
    double achromatic = (2.0 * r[0] + r[1] + r[2] / 20.0 - 0.305) * induction;
    double of_all = (2.0 * w[0] + w[1] + w[2] / 20.0 - 0.305) * induction;
    double lightness = 100.0 * pow(fmax(achromatic, 0.0) / of_all, 0.69 * (1.48 + sqrt(n)));
    double t = 50000.0 / 13.0 * induction * (cos(h + 2.0) + 3.8) / 4.0 * sqrt(a * a + b * b) /
               (r[0] + r[1] + 21.0 / 20.0 * r[2]);
    double chroma = pow(t, 0.9) * sqrt(lightness / 100.0) * pow(1.64 - pow(0.29, n), 0.73);
    double colorful = log(1.0 + 0.0228 * chroma * pow(level, 0.25)) / 0.0228;
    ucs[0] = 1.7 * lightness / (1.0 + 0.007 * lightness);
    ucs[1] = colorful * cos(h);
    ucs[2] = colorful * sin(h);
}

/* ---------------------------------------------------------------- distances */

double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}
