/* SPDX-License-Identifier: MIT
 *
 * What healpy is asked of one pixel, one point or one disc, as arrays of NumPy: ufuncs and ctypes take longer to begin than
 * this takes.
 */
#include "core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define NO_IMPORT_ARRAY
#define PY_ARRAY_UNIQUE_SYMBOL cubemap_array_api
#include <numpy/arrayobject.h>

#define STEPS_MAX ((Py_ssize_t)1 << 20) /* of cm_healpix_boundary */
#define PI 3.14159265358979323846

/* 1 if so many arguments are there and the first is a handle. */
static int are_given(PyObject *const *args, Py_ssize_t count, Py_ssize_t wanted)
{
    if (count != wanted || !PyObject_TypeCheck(args[0], &core_handle_type))
    {
        PyErr_Format(PyExc_TypeError, "%zd arguments, the first a Handle", wanted);
        return 0;
    }
    return 1;
}

static const cm_healpix *healpix_of(PyObject *handle)
{
    return ((struct core_handle *)handle)->address;
}

static PyObject *array_of(enum NPY_TYPES type, npy_intp rows, npy_intp columns)
{
    const npy_intp sizes[2] = {rows, columns};
    return PyArray_SimpleNew(columns ? 2 : 1, sizes, (int)type);
}

static void *data_of(PyObject *array)
{
    return PyArray_DATA((PyArrayObject *)array);
}

/* ---- pixels ---- */

static PyObject *neighbours(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    if (!are_given(args, count, 2))
    {
        return NULL;
    }
    const long long pixel = PyLong_AsLongLong(args[1]);
    PyObject *array = pixel == -1 && PyErr_Occurred() ? NULL : array_of(NPY_INT64, 8, 0);
    if (array)
    {
        int64_t *neighbour = data_of(array);
        for (int k = 0; k < 8; k++)
        {
            neighbour[k] = CM_HEALPIX_NO_PIXEL; /* which they are if the pixel is none */
        }
        (void)cm_healpix_neighbours(healpix_of(args[0]), pixel, neighbour);
    }
    return array;
}

/* Three planes of n numbers as n rows of three. */
static PyObject *rows_of(PyObject *planes, npy_intp n)
{
    PyObject *rows = array_of(NPY_DOUBLE, n, 3);
    if (rows)
    {
        const double *from = data_of(planes);
        double *to = data_of(rows);
        for (npy_intp i = 0; i < n; i++)
        {
            for (npy_intp k = 0; k < 3; k++)
            {
                to[3 * i + k] = from[n * k + i];
            }
        }
    }
    Py_DECREF(planes);
    return rows;
}

/* boundary(handle, pixel, steps, rows): 3 planes, or rows of 3. */
static PyObject *boundary(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    if (!are_given(args, count, 4))
    {
        return NULL;
    }
    const long long pixel = PyLong_AsLongLong(args[1]);
    const Py_ssize_t steps = PyErr_Occurred() ? -1 : PyNumber_AsSsize_t(args[2], PyExc_ValueError);
    const int rows = PyErr_Occurred() ? -1 : PyObject_IsTrue(args[3]);
    if (rows < 0)
    {
        return NULL;
    }
    if (steps < 1 || steps > STEPS_MAX)
    {
        return PyErr_Format(PyExc_ValueError, "steps: 1 to 2^20, not %zd", steps);
    }
    PyObject *planes = array_of(NPY_DOUBLE, 3, 4 * steps);
    if (!planes)
    {
        return NULL;
    }
    double *x = data_of(planes);
    if (core_check(cm_healpix_boundary(healpix_of(args[0]), pixel, (size_t)steps, x, x + 4 * steps,
                                       x + 8 * steps)) < 0)
    {
        Py_DECREF(planes);
        return NULL;
    }
    return rows ? rows_of(planes, 4 * steps) : planes;
}

/* vector(theta, phi): the unit vector of a colatitude and a longitude. */
static PyObject *vector(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    if (count != 2)
    {
        PyErr_SetString(PyExc_TypeError, "two arguments");
        return NULL;
    }
    const double theta = PyFloat_AsDouble(args[0]);
    const double phi = PyErr_Occurred() ? 0.0 : PyFloat_AsDouble(args[1]);
    PyObject *array = PyErr_Occurred() ? NULL : array_of(NPY_DOUBLE, 3, 0);
    if (array)
    {
        double *to = data_of(array);
        const double rho = sin(theta);
        to[0] = rho * cos(phi);
        to[1] = rho * sin(phi);
        to[2] = cos(theta);
    }
    return array;
}

/* ---- discs ---- */

#define TOGETHER 64  /* pixels whose centres are asked for at once */
#define ROUNDED 1e-9 /* more than angles of rings are off, in radians */

/* Pixels around a unit vector, in the order RING. */
struct disc
{
    const cm_healpix *healpix;
    double centre[3];
    double theta;
    double sine; /* of theta */
    double phi;
    double radius;
    double reach;    /* centres of pixels that may be meant are no farther */
    double chord;    /* squared: of centres that are inside */
    double overlap;  /* squared: of points of boundaries that are inside */
    int64_t own;     /* the centre's own pixel, if those that overlap are meant; else no pixel */
    size_t steps;    /* of boundaries; 0: centres alone are meant */
    double *outline; /* room for a boundary */
    int64_t *pixel;  /* those that were found */
    size_t count;
    size_t room;
};

static double squared_chord(const struct disc *disc, double x, double y, double z)
{
    const double dx = x - disc->centre[0];
    const double dy = y - disc->centre[1];
    const double dz = z - disc->centre[2];
    return dx * dx + dy * dy + dz * dz;
}

static int overlaps(const struct disc *disc, int64_t pixel)
{
    if (disc->steps == 0 || pixel == disc->own)
    {
        return disc->steps != 0;
    }
    const size_t n = 4 * disc->steps;
    double *x = disc->outline;
    (void)cm_healpix_boundary(disc->healpix, pixel, disc->steps, x, x + n, x + 2 * n);
    for (size_t i = 0; i < n; i++)
    {
        if (squared_chord(disc, x[i], x[n + i], x[2 * n + i]) <= disc->overlap)
        {
            return 1;
        }
    }
    return 0;
}

/* Room for so many more; 0 without memory. */
static int make_room(struct disc *disc, size_t more)
{
    if (disc->count + more > disc->room)
    {
        const size_t room = 2 * disc->room + more;
        int64_t *grown = realloc(disc->pixel, room * sizeof *grown);
        if (!grown)
        {
            return 0;
        }
        disc->pixel = grown;
        disc->room = room;
    }
    return 1;
}

/* Of TOGETHER pixels or fewer that follow each other those that are meant; there is room for them. */
static void keep_few(struct disc *disc, int64_t first, int64_t n)
{
    int64_t pixel[TOGETHER];
    double x[TOGETHER], y[TOGETHER], z[TOGETHER];
    for (int64_t i = 0; i < n; i++)
    {
        pixel[i] = first + i;
    }
    cm_healpix_direction_from_pixel_array(disc->healpix, (size_t)n, pixel, x, y, z);
    for (int64_t i = 0; i < n; i++)
    {
        if (squared_chord(disc, x[i], y[i], z[i]) <= disc->chord || overlaps(disc, pixel[i]))
        {
            disc->pixel[disc->count++] = pixel[i];
        }
    }
}

/* Of pixels that follow each other all, or those that are meant; 0 without memory. */
static int keep_part(struct disc *disc, int64_t first, int64_t n, int all)
{
    if (!make_room(disc, all ? (size_t)n : TOGETHER))
    {
        return 0;
    }
    for (int64_t i = 0; all && i < n; i++)
    {
        disc->pixel[disc->count++] = first + i;
    }
    for (int64_t done = 0; !all && done < n; done += TOGETHER)
    {
        if (!make_room(disc, TOGETHER))
        {
            return 0;
        }
        keep_few(disc, first + done, n - done < TOGETHER ? n - done : TOGETHER);
    }
    return 1;
}

/* Half of the longitudes where a ring is no farther than an angle: haversines, so that small discs are accurate. Below 0 there
 * are none; PI where there are all, or near a pole. */
static double half_width(const struct disc *disc, double theta, double angle)
{
    const double most = sin(angle / 2);
    const double apart = sin((theta - disc->theta) / 2);
    const double share = (most * most - apart * apart) / (sin(theta) * disc->sine);
    if (angle >= PI || !isfinite(share) || share >= 1.0) /* at a pole it is no number */
    {
        return PI;
    }
    return share >= 0.0 ? 2 * asin(sqrt(share)) : -1.0;
}

/* A part of a ring: from begin on, before end; sure: all of it is inside. */
struct part
{
    int64_t begin;
    int64_t end;
    int sure;
};

/* Parts in the order of their numbers, those that go over the ring's end as two. */
static int add_part(struct part *parts, int count, int64_t ring, struct part part)
{
    if (part.end <= part.begin)
    {
        return count;
    }
    const int64_t turn = (part.begin % ring + ring) % ring - part.begin;
    part.begin += turn;
    part.end += turn;
    if (part.end > ring)
    {
        count = add_part(parts, count, ring, (struct part){0, part.end - ring, part.sure});
        part.end = ring;
    }
    int at = count;
    for (; at > 0 && parts[at - 1].begin > part.begin; at--)
    {
        parts[at] = parts[at - 1];
    }
    parts[at] = part;
    return count + 1;
}

static int64_t clipped(int64_t value, int64_t least, int64_t most)
{
    return value < least ? least : value > most ? most : value;
}

/* By how much of a pixel the end of a ring's part may be off, and so may be what chords say: nothing to speak of where pixels are
 * large, the disc's border crosses the ring, and the poles are not near. */
static double tolerance(const struct disc *disc, double half, double step)
{
    const int is_good = step > 1e-5 && half > 4 * step && half < 3.0 && disc->sine > 1e-5;
    return is_good ? 0.01 : 1.0;
}

/* Those of a ring that may be within the reach. Which are surely within the radius are inside without a look. */
static int keep_ring(struct disc *disc, const cm_healpix_ring *ring, double theta)
{
    const double step = 2 * PI / (double)ring->count;
    const double middle = (disc->phi - (ring->is_shifted ? step / 2 : 0.0)) / step;
    const double half = half_width(disc, theta, disc->reach);
    const double inner = disc->steps ? half_width(disc, theta, disc->radius) : half;
    const double wide = fmax(half, 0.0) / step + (disc->steps ? 1.0 : tolerance(disc, half, step));
    const int64_t low = (int64_t)ceil(middle - wide);
    const int64_t high = (int64_t)floor(middle + wide) + 1;
    const int64_t end = high - low > ring->count ? low + ring->count : high;
    int64_t sure = low;
    int64_t sure_end = low;
    if (inner > 0.0 && inner < PI)
    {
        const double narrow = inner / step - tolerance(disc, inner, step);
        sure = clipped((int64_t)ceil(middle - narrow), low, end);
        sure_end = clipped((int64_t)floor(middle + narrow) + 1, sure, end);
    }
    else if (fmin(theta + disc->theta, 2 * PI - theta - disc->theta) < disc->radius - ROUNDED)
    {
        sure_end = end; /* the ring's farthest point is inside */
    }
    struct part parts[6];
    int count = add_part(parts, 0, ring->count, (struct part){low, sure, 0});
    count = add_part(parts, count, ring->count, (struct part){sure, sure_end, 1});
    count = add_part(parts, count, ring->count, (struct part){sure_end, end, 0});
    for (int i = 0; i < count; i++)
    {
        if (!keep_part(disc, ring->first + parts[i].begin, parts[i].end - parts[i].begin,
                       parts[i].sure))
        {
            return 0;
        }
    }
    return 1;
}

static double ring_theta(const cm_healpix *healpix, int64_t number, cm_healpix_ring *ring)
{
    ring->size = sizeof *ring;
    (void)cm_healpix_ring_info(healpix, number, ring);
    return atan2(ring->rho, ring->z);
}

/* The first ring whose colatitude is no less. */
static int64_t first_ring(const cm_healpix *healpix, double theta)
{
    cm_healpix_ring ring;
    int64_t low = 1;
    int64_t beyond = cm_healpix_ring_count(healpix) + 1;
    while (low < beyond)
    {
        const int64_t middle = low + (beyond - low) / 2;
        if (ring_theta(healpix, middle, &ring) < theta)
        {
            low = middle + 1;
        }
        else
        {
            beyond = middle;
        }
    }
    return low;
}

/* 0 without memory. */
static int fill_disc(struct disc *disc)
{
    const int64_t count = cm_healpix_ring_count(disc->healpix);
    for (int64_t number = first_ring(disc->healpix, disc->theta - disc->reach - ROUNDED);
         number <= count; number++)
    {
        cm_healpix_ring ring;
        const double theta = ring_theta(disc->healpix, number, &ring);
        if (theta > disc->theta + disc->reach + ROUNDED)
        {
            break;
        }
        if (!keep_ring(disc, &ring, theta))
        {
            return 0;
        }
    }
    return 1;
}

/* Three numbers as a unit vector; 0 with an exception. */
static int read_vector(PyObject *object, double unit[3])
{
    PyObject *array =
        PyArray_FROMANY(object, NPY_DOUBLE, 0, 0, NPY_ARRAY_CARRAY_RO | NPY_ARRAY_FORCECAST);
    if (!array)
    {
        return 0;
    }
    PyArrayObject *values = (PyArrayObject *)array;
    double length = NAN;
    if (PyArray_NDIM(values) == 1 && PyArray_DIM(values, 0) == 3)
    {
        const double *from = PyArray_DATA(values);
        length = sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
        for (int k = 0; k < 3; k++)
        {
            unit[k] = from[k] / length;
        }
    }
    Py_DECREF(array);
    if (!(length > 0.0 && isfinite(length)))
    {
        PyErr_SetString(PyExc_ValueError, "a disc has a vector and a radius of 0 or more");
        return 0;
    }
    return 1;
}

/* Everything is within half a turn, whatever rounding says of the antipode. */
static double square_of_chord(double angle)
{
    if (angle >= PI)
    {
        return INFINITY;
    }
    const double half = sin(angle / 2);
    return 4 * half * half;
}

/* The disc of the arguments of disc(); 0 with an exception. */
static int read_disc(PyObject *const *args, struct disc *disc)
{
    disc->healpix = healpix_of(args[0]);
    if (!read_vector(args[1], disc->centre))
    {
        return 0;
    }
    const double radius = PyFloat_AsDouble(args[2]);
    const double beyond = PyErr_Occurred() ? 0.0 : PyFloat_AsDouble(args[3]);
    const Py_ssize_t steps = PyErr_Occurred() ? 0 : PyNumber_AsSsize_t(args[4], PyExc_ValueError);
    if (PyErr_Occurred())
    {
        return 0;
    }
    if (!(radius >= 0.0) || steps < 0 || steps > STEPS_MAX)
    {
        PyErr_SetString(PyExc_ValueError, "a disc has a vector and a radius of 0 or more");
        return 0;
    }
    const double *centre = disc->centre;
    disc->sine = hypot(centre[0], centre[1]);
    disc->theta = atan2(disc->sine, centre[2]);
    disc->phi = atan2(centre[1], centre[0]);
    disc->radius = radius;
    disc->reach = fmin(radius + beyond, PI);
    disc->chord = square_of_chord(radius);
    disc->steps = (size_t)steps;
    disc->own = CM_HEALPIX_NO_PIXEL;
    if (steps > 0)
    {
        /* no two points of a boundary that follow each other are farther apart than twice this */
        const double side = PI / 4 / (double)(cm_healpix_nside(disc->healpix) * steps);
        disc->overlap = square_of_chord(radius + side);
        cm_healpix_pixel_from_direction_array(disc->healpix, 1, centre, centre + 1, centre + 2,
                                              &disc->own);
        disc->outline = malloc(12 * (size_t)steps * sizeof *disc->outline);
        if (!disc->outline)
        {
            PyErr_NoMemory();
            return 0;
        }
    }
    return 1;
}

/* disc(handle, vector, radius, beyond, steps): pixels of an object in the order RING, sorted, whose centre is within the
 * radius; with steps also those that have a point of their boundary, `steps` points a side, or the vector itself inside, of
 * those whose centre is no farther than `beyond` more. */
static PyObject *disc(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    struct disc disc = {0};
    PyObject *array = NULL;
    if (are_given(args, count, 5) && read_disc(args, &disc))
    {
        PyThreadState *const state = PyEval_SaveThread();
        const int good = fill_disc(&disc);
        PyEval_RestoreThread(state);
        array = good ? array_of(NPY_INT64, (npy_intp)disc.count, 0) : PyErr_NoMemory();
        if (array && disc.count)
        {
            memcpy(data_of(array), disc.pixel, disc.count * sizeof *disc.pixel);
        }
    }
    free(disc.outline);
    free(disc.pixel);
    return array;
}

#define FAST(function) ((PyCFunction)(void (*)(void))(function))

PyMethodDef core_methods[] = {
    {"pixel_neighbours", FAST(neighbours), METH_FASTCALL,
     "pixel_neighbours(handle, pixel): of one pixel, -1 where there is none."},
    {"pixel_boundary", FAST(boundary), METH_FASTCALL,
     "pixel_boundary(handle, pixel, steps, rows): (3, 4 steps), or (4 steps, 3)."},
    {"pixel_disc", FAST(disc), METH_FASTCALL,
     "pixel_disc(handle, vector, radius, beyond, steps): the pixels of a disc, in the order RING."},
    {"angles_to_vector", FAST(vector), METH_FASTCALL,
     "angles_to_vector(theta, phi): a unit vector."},
    {NULL, NULL, 0, NULL},
};
