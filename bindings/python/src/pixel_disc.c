/* SPDX-License-Identifier: MIT
 *
 * The pixels of a disc, in RING. A ring's longitudes inside follow from chords, without an angle of the ring: so a ring costs one
 * arc sine. Where rounding may be wrong, the centres of the pixels are looked at.
 *
 * Pixels that overlap the disc are found on lines of latitude, so many to a pixel, on which a pixel's longitudes are known. From
 * any point of a pixel the next line towards the pixel's middle is no farther than LINE, and the way there is in the pixel: so
 * a disc that is larger by that much meets a line in each of them.
 */
#include "pixel_disc.h"

#include <math.h>
#include <stdlib.h>

#define TOGETHER 64   /* pixels whose centres are asked for at once */
#define ROUNDED 1e-9  /* more than angles of rings are off, in radians */
#define SQUARED 1e-14 /* more than squares of chords are off */
#define PI 3.14159265358979323846
#define LINE                                                                                       \
    0.9 /* radians between lines of latitude, by nside: 2 / sqrt(5) at most, where belt and cap meet */

double disc_square_of_chord(double angle)
{
    if (angle >= PI)
    {
        return INFINITY;
    }
    const double half = sin(angle / 2);
    return 4 * half * half;
}

double disc_squared_chord(const struct disc *disc, const double point[3])
{
    const double dx = point[0] - disc->centre[0];
    const double dy = point[1] - disc->centre[1];
    const double dz = point[2] - disc->centre[2];
    return dx * dx + dy * dy + dz * dz;
}

/* ---- Runs ---- */

void disc_write(const struct disc_runs *runs, int64_t *pixel)
{
    for (size_t k = 0; k < runs->run_count; k++)
    {
        const int64_t first = runs->run[k].first;
        const int64_t count = runs->run[k].count;
        for (int64_t i = 0; i < count; i++)
        {
            pixel[i] = first + i;
        }
        pixel += count;
    }
}

int disc_add(struct disc_runs *runs, int64_t first, int64_t count)
{
    struct disc_run *last = runs->run_count ? &runs->run[runs->run_count - 1] : NULL;
    runs->pixel_count += (size_t)count;
    if (last && last->first + last->count == first)
    {
        last->count += count;
        return 1;
    }
    if (runs->run_count == runs->run_room)
    {
        const size_t room = 2 * runs->run_room + 64;
        struct disc_run *grown = realloc(runs->run, room * sizeof *grown);
        if (!grown)
        {
            return 0;
        }
        runs->run = grown;
        runs->run_room = room;
    }
    runs->run[runs->run_count].first = first;
    runs->run[runs->run_count].count = count;
    runs->run_count++;
    return 1;
}

/* Of TOGETHER pixels or fewer that follow each other those whose centre is inside; 0 without memory. */
static int add_few(const struct disc *disc, struct disc_runs *runs, double chord, int64_t first,
                   int64_t n)
{
    int64_t pixel[TOGETHER];
    double x[TOGETHER], y[TOGETHER], z[TOGETHER];
    for (int64_t i = 0; i < n; i++)
    {
        pixel[i] = first + i;
    }
    cm_healpix_direction_from_pixel_array(disc->healpix, (size_t)n, pixel, x, y, z);
    int is_good = 1;
    for (int64_t i = 0; i < n && is_good; i++)
    {
        const double point[3] = {x[i], y[i], z[i]};
        is_good = disc_squared_chord(disc, point) > chord || disc_add(runs, pixel[i], 1);
    }
    return is_good;
}

static int add_those_inside(const struct disc *disc, struct disc_runs *runs, double chord,
                            int64_t first, int64_t n)
{
    int is_good = 1;
    for (int64_t done = 0; done < n && is_good; done += TOGETHER)
    {
        is_good =
            add_few(disc, runs, chord, first + done, n - done < TOGETHER ? n - done : TOGETHER);
    }
    return is_good;
}

/* ---- Longitudes of a ring, or a line ---- */

/* Where a disc's border is: as it is asked for, and as lines of latitude see it. */
struct border
{
    double rho; /* the centre's distance from the axis */
    double theta;
    double phi;
    double angle;
    double chord; /* squared */
};

static struct border border_of(const struct disc *disc, double angle)
{
    struct border border;
    border.rho = hypot(disc->centre[0], disc->centre[1]);
    border.theta = atan2(border.rho, disc->centre[2]);
    border.phi = atan2(disc->centre[1], disc->centre[0]);
    border.angle = fmin(angle, PI);
    border.chord = disc_square_of_chord(angle);
    return border;
}

/* Half of the longitudes inside: below 0 there are none; PI where there are all, or near a pole. */
static double half_width(const struct disc *disc, const struct border *border, double rho, double z)
{
    const double dz = z - disc->centre[2];
    const double apart = rho - border->rho;
    /* the squared sine of half of it; at a pole no number */
    const double share = (border->chord - apart * apart - dz * dz) / (4 * rho * border->rho);
    if (!isfinite(share) || share >= 1.0)
    {
        return PI;
    }
    return share >= 0.0 ? 2 * asin(sqrt(share)) : -1.0;
}

/* Is the farthest point inside? */
static int is_inside(const struct disc *disc, const struct border *border, double rho, double z)
{
    const double dz = z - disc->centre[2];
    const double apart = rho + border->rho;
    return apart * apart + dz * dz < border->chord - SQUARED;
}

/* Whole numbers beside one that is far below their limits. */
static int64_t whole_below(double x)
{
    const int64_t whole = (int64_t)x;
    return whole - ((double)whole > x);
}

static int64_t whole_above(double x)
{
    return -whole_below(-x);
}

static int64_t clipped(int64_t value, int64_t least, int64_t most)
{
    return value < least ? least : value > most ? most : value;
}

/* ---- Parts of rings ---- */

/* Numbers of a ring from low on, before end, at most a whole turn; from sure on, before sure_end, those that need no look. */
struct part
{
    int64_t low;
    int64_t sure;
    int64_t sure_end;
    int64_t end;
};

/* Numbers from low on, before end, of which some need no look. */
static int add_numbers(const struct disc *disc, struct disc_runs *runs, double chord, int64_t low,
                       int64_t end, int is_sure)
{
    return end <= low || (is_sure ? disc_add(runs, low, end - low)
                                  : add_those_inside(disc, runs, chord, low, end - low));
}

/* Of a part what is from least on, before most, as numbers that are so much more. */
static int add_between(const struct disc *disc, struct disc_runs *runs, double chord,
                       const struct part *part, int64_t least, int64_t most, int64_t more)
{
    const int64_t low = clipped(part->low, least, most) + more;
    const int64_t sure = clipped(part->sure, least, most) + more;
    const int64_t sure_end = clipped(part->sure_end, least, most) + more;
    const int64_t end = clipped(part->end, least, most) + more;
    return add_numbers(disc, runs, chord, low, sure, 0) &&
           add_numbers(disc, runs, chord, sure, sure_end, 1) &&
           add_numbers(disc, runs, chord, sure_end, end, 0);
}

/* Those behind the ring's end are its first ones. */
static int add_part(const struct disc *disc, struct disc_runs *runs, double chord,
                    const struct part *part, const cm_healpix_ring *ring)
{
    const int64_t count = ring->count;
    int64_t begin = 0; /* of the turn that the part begins in */
    while (part->low < begin)
    {
        begin -= count;
    }
    while (part->low >= begin + count)
    {
        begin += count;
    }
    const int64_t end = begin + count;
    return (part->end <= end ||
            add_between(disc, runs, chord, part, end, end + count, ring->first - end)) &&
           add_between(disc, runs, chord, part, begin, end, ring->first - begin);
}

/* By how much of a pixel the end of a ring's part may be off. What is left of a chord's square is off by 1e-15 at most, and below a
 * width of 3 the half width by ten times that over radii and width: by less than 1e-8, or by anything. */
static double tolerance(double radii, double half, double pixels)
{
    const int is_good = radii * half > 1e-6 && half < 3.0 && pixels < 1e5;
    return is_good ? 1e-7 * pixels : 1.0;
}

/* The pixels of a ring whose centre is inside. */
static int add_ring(const struct disc *disc, struct disc_runs *runs, const struct border *border,
                    const cm_healpix_ring *ring, double half)
{
    const double count = (double)ring->count;
    const double pixels = count * (0.5 / PI); /* in a radian */
    const double middle = border->phi * pixels - (ring->is_shifted ? 0.5 : 0.0);
    const double off = tolerance(ring->rho * border->rho, half, pixels);
    const double wide = (half > 0.0 ? half : 0.0) * pixels + off;
    const double narrow = half * pixels - off;
    struct part part;
    part.low = whole_above(middle - wide);
    part.end = whole_below(middle + wide) + 1;
    part.end = part.end - part.low > ring->count ? part.low + ring->count : part.end;
    part.sure = part.low;
    part.sure_end = part.low;
    if (half > 0.0 && half < PI)
    {
        part.sure = clipped(whole_above(middle - narrow), part.low, part.end);
        part.sure_end = clipped(whole_below(middle + narrow) + 1, part.sure, part.end);
    }
    else if (is_inside(disc, border, ring->rho, ring->z))
    {
        part.sure_end = part.end;
    }
    return add_part(disc, runs, border->chord, &part, ring);
}

/* ---- Rings of a disc ---- */

/* Is a ring south of a colatitude? */
static int is_south(const cm_healpix_ring *ring, double cosine, double sine)
{
    return ring->rho * cosine - ring->z * sine > 0.0;
}

/* The first ring that is south of a colatitude. */
static int64_t first_ring(const cm_healpix *healpix, double theta)
{
    const double cosine = cos(theta);
    const double sine = sin(theta);
    cm_healpix_ring ring = {.size = sizeof ring};
    int64_t low = 1;
    int64_t beyond = theta > 0.0 ? cm_healpix_ring_count(healpix) + 1 : low;
    beyond = theta < PI ? beyond : low;
    low = theta < PI ? low : cm_healpix_ring_count(healpix) + 1;
    while (low < beyond)
    {
        const int64_t middle = low + (beyond - low) / 2;
        (void)cm_healpix_ring_info(healpix, middle, &ring);
        if (is_south(&ring, cosine, sine))
        {
            beyond = middle;
        }
        else
        {
            low = middle + 1;
        }
    }
    return low;
}

/* The rings from one on, before another. A few at a time in three loops, so that the processor need not wait for one ring's
 * quotient and root before it begins the next one's. */
static int add_rings(const struct disc *disc, struct disc_runs *runs, const struct border *border,
                     int64_t first, int64_t beyond)
{
    cm_healpix_ring ring[TOGETHER];
    double half[TOGETHER];
    int is_good = 1;
    for (int64_t done = first; done < beyond && is_good; done += TOGETHER)
    {
        const int n = (int)(beyond - done < TOGETHER ? beyond - done : TOGETHER);
        for (int k = 0; k < n; k++)
        {
            ring[k].size = sizeof *ring;
            (void)cm_healpix_ring_info(disc->healpix, done + k, &ring[k]);
        }
        for (int k = 0; k < n; k++)
        {
            half[k] = half_width(disc, border, ring[k].rho, ring[k].z);
        }
        for (int k = 0; k < n && is_good; k++)
        {
            is_good = add_ring(disc, runs, border, &ring[k], half[k]);
        }
    }
    return is_good;
}

static int find_centres(const struct disc *disc, struct disc_runs *runs)
{
    if (disc->radius >= PI)
    {
        return disc_add(runs, 0, cm_healpix_pixel_count(disc->healpix));
    }
    const struct border border = border_of(disc, disc->radius);
    return add_rings(disc, runs, &border,
                     first_ring(disc->healpix, border.theta - border.angle - ROUNDED),
                     first_ring(disc->healpix, border.theta + border.angle + ROUNDED));
}

/* ---- Pixels that overlap ---- */

/* What a line of latitude sees: longitudes in quarters of a turn; nothing, if high is below low. */
struct line
{
    double low;
    double high;
    int is_whole;
};

/* Of a ring the least and the greatest number that the disc meets, turns not taken off; none, if the greatest is less. */
struct reach
{
    int64_t least;
    int64_t most;
    int is_whole;
};

/* The line `number` of those that are the rings of a finer grid; those of the poles are beside them. */
static struct line line_at(const struct disc *disc, const struct border *border,
                           const cm_healpix *fine, int64_t number)
{
    const int64_t count = cm_healpix_ring_count(fine);
    cm_healpix_ring ring = {.size = sizeof ring};
    struct line line = {1.0, 0.0, 0};
    if (number < 1 || number > count)
    {
        const double pole[3] = {0.0, 0.0, number < 1 ? 1.0 : -1.0};
        line.is_whole = disc_squared_chord(disc, pole) <= border->chord;
        return line;
    }
    (void)cm_healpix_ring_info(fine, number, &ring);
    const double dz = ring.z - disc->centre[2];
    const double apart = ring.rho - border->rho;
    if (apart * apart + dz * dz <= border->chord) /* the nearest point is inside */
    {
        const double half = half_width(disc, border, ring.rho, ring.z);
        line.low = (border->phi - half) * (2 / PI);
        line.high = (border->phi + half) * (2 / PI);
        line.is_whole = half >= PI;
    }
    return line;
}

/* Pixels of a ring of a cap, on a line that is `away` rings farther from the pole: of a quarter's pixels the k-th is from
 * max(k, k + away) / (ring + away) on, up to min(k + 1, k + 1 + away) / (ring + away). */
static void look_in_cap(struct reach *seen, int64_t ring, const struct line *line, double away)
{
    const double low = floor(line->low);
    const double high = floor(line->high);
    const double scale = (double)ring + away;
    const int64_t least = whole_above((line->low - low) * scale - 1.0 - fmin(away, 0.0));
    const int64_t most = whole_below((line->high - high) * scale - fmax(away, 0.0));
    seen->least = (int64_t)low * ring + clipped(least, 0, ring);
    seen->most = (int64_t)high * ring + clipped(most, -1, ring - 1);
}

/* Those of a ring of the belt are as wide on either side of their centres. */
static void look_in_belt(struct reach *seen, const cm_healpix_ring *ring, const struct line *line,
                         double off)
{
    const double quarter = (double)ring->count / 4;
    const double shift = ring->is_shifted ? 0.5 : 0.0;
    const double half = 0.5 * (1.0 - fabs(off));
    seen->least = whole_above(line->low * quarter - shift - half);
    seen->most = whole_below(line->high * quarter - shift + half);
}

/* Adds what a line sees of a ring; off: by how many rings it is south of the ring. */
static void look(struct reach *reach, const cm_healpix_ring *ring, int64_t nside,
                 const struct line *line, double off)
{
    const int is_south = ring->ring > 2 * nside;
    const int64_t from_pole = is_south ? 4 * nside - ring->ring : ring->ring;
    const double away = is_south ? -off : off;
    struct reach seen = {0, -1, 0};
    reach->is_whole |= line->is_whole;
    if (line->high < line->low)
    {
        return;
    }
    if (from_pole <= nside && (double)from_pole + away <= (double)nside)
    {
        look_in_cap(&seen, from_pole, line, away);
    }
    else
    {
        look_in_belt(&seen, ring, line, off);
    }
    if (seen.least <= seen.most)
    {
        reach->least = seen.least < reach->least ? seen.least : reach->least;
        reach->most = seen.most > reach->most ? seen.most : reach->most;
    }
}

/* The pixels of a ring that lines see: 2 lines + 1 of them, the middle one is the ring's own. */
static int add_ring_seen(const struct disc *disc, struct disc_runs *runs, int64_t number,
                         const struct line *line, int64_t lines)
{
    const int64_t nside = cm_healpix_nside(disc->healpix);
    cm_healpix_ring ring = {.size = sizeof ring};
    struct reach reach = {INT64_MAX, INT64_MIN, 0};
    (void)cm_healpix_ring_info(disc->healpix, number, &ring);
    for (int64_t k = 0; k <= 2 * lines; k++)
    {
        look(&reach, &ring, nside, &line[k], (double)(k - lines) / (double)lines);
    }
    if (reach.is_whole || (reach.least <= reach.most && reach.most - reach.least >= ring.count))
    {
        return disc_add(runs, ring.first, ring.count);
    }
    const struct part part = {reach.least, reach.least, reach.most + 1, reach.most + 1};
    return reach.least > reach.most || add_part(disc, runs, 0.0, &part, &ring);
}

/* The rings that the lines from `first` to `last` lie in. */
static int add_rings_seen(const struct disc *disc, struct disc_runs *runs, const cm_healpix *fine,
                          int64_t lines, struct line *line)
{
    const double angle = disc->radius + LINE / (double)cm_healpix_nside(fine);
    const struct border border = border_of(disc, angle);
    const int64_t count = cm_healpix_ring_count(disc->healpix);
    const int64_t first = first_ring(fine, border.theta - angle - ROUNDED);
    const int64_t last = first_ring(fine, border.theta + angle + ROUNDED);
    const int64_t ring = clipped(first / lines, 1, count);
    int is_good = 1;
    int64_t known = 0; /* lines that the ring before had */
    for (int64_t number = ring; number <= count && (number - 1) * lines <= last && is_good;
         number++)
    {
        for (int64_t k = known; k <= 2 * lines; k++)
        {
            line[k] = line_at(disc, &border, fine, (number - 1) * lines + k);
        }
        is_good = add_ring_seen(disc, runs, number, line, lines);
        known = lines + 1;
        for (int64_t k = 0; k < known; k++)
        {
            line[k] = line[k + lines];
        }
    }
    return is_good;
}

static int find_overlapping(const struct disc *disc, struct disc_runs *runs)
{
    const int64_t nside = cm_healpix_nside(disc->healpix);
    const int64_t most = CM_HEALPIX_NSIDE_MAX / nside;
    const int64_t lines = disc->lines < most ? disc->lines : most;
    if (disc->radius + LINE / (double)(nside * lines) >= PI)
    {
        return disc_add(runs, 0, cm_healpix_pixel_count(disc->healpix));
    }
    cm_healpix *fine = NULL;
    struct line *line = malloc((2 * (size_t)lines + 1) * sizeof *line);
    const int is_good = line &&
                        cm_healpix_create(nside * lines, CM_HEALPIX_RING, NULL, &fine) == CM_OK &&
                        add_rings_seen(disc, runs, fine, lines, line);
    cm_healpix_destroy(fine);
    free(line);
    return is_good;
}

int disc_find(const struct disc *disc, struct disc_runs *runs)
{
    return disc->lines > 0 ? find_overlapping(disc, runs) : find_centres(disc, runs);
}
