/* SPDX-License-Identifier: MIT
 *
 * What healpy is asked of one pixel or one disc, as arrays of NumPy: ufuncs and ctypes take longer to begin than
 * this takes.
 */
#include "core.h"
#include "pixel_disc.h"

#include <math.h>
#include <stdlib.h>

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define NO_IMPORT_ARRAY
#define PY_ARRAY_UNIQUE_SYMBOL cubemap_array_api
#include <numpy/arrayobject.h>

#define STEPS_MAX ((Py_ssize_t)1 << 20) /* of cm_healpix_boundary */

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

/* How many points a side of a boundary has; 0 with an exception. */
static Py_ssize_t read_steps(PyObject *object)
{
    const Py_ssize_t steps = PyNumber_AsSsize_t(object, PyExc_ValueError);
    if (!PyErr_Occurred() && (steps < 1 || steps > STEPS_MAX))
    {
        PyErr_Format(PyExc_ValueError, "steps: 1 to 2^20, not %zd", steps);
    }
    return PyErr_Occurred() ? 0 : steps;
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
    const Py_ssize_t steps = PyErr_Occurred() ? 0 : read_steps(args[2]);
    const int rows = steps ? PyObject_IsTrue(args[3]) : -1;
    PyObject *planes = rows < 0 ? NULL : array_of(NPY_DOUBLE, 3, 4 * steps);
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

/* Three planes for each pixel. */
static PyObject *boundaries_of(const cm_healpix *healpix, PyArrayObject *pixels, size_t steps)
{
    const npy_intp n = PyArray_SIZE(pixels);
    const npy_intp side = 4 * (npy_intp)steps;
    const npy_intp sizes[3] = {n, 3, side};
    const int64_t *pixel = PyArray_DATA(pixels);
    cm_status status = CM_OK;
    PyObject *array = PyArray_SimpleNew(3, sizes, NPY_DOUBLE);
    if (array)
    {
        double *x = data_of(array);
        PyThreadState *const state = PyEval_SaveThread();
        for (npy_intp i = 0; i < n && status == CM_OK; i++, x += 3 * side)
        {
            status = cm_healpix_boundary(healpix, pixel[i], steps, x, x + side, x + 2 * side);
        }
        PyEval_RestoreThread(state);
    }
    if (core_check(status) < 0)
    {
        Py_CLEAR(array);
    }
    return array;
}

/* boundaries(handle, pixels, steps): of an array. */
static PyObject *boundaries(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    const Py_ssize_t steps = are_given(args, count, 3) ? read_steps(args[2]) : 0;
    PyObject *pixels =
        steps ? PyArray_FROMANY(args[1], NPY_INT64, 0, 0, NPY_ARRAY_CARRAY_RO) : NULL;
    PyObject *array =
        pixels ? boundaries_of(healpix_of(args[0]), (PyArrayObject *)pixels, (size_t)steps) : NULL;
    Py_XDECREF(pixels);
    return array;
}

/* ---- discs ---- */

/* Three numbers as a unit vector; 0 with an exception. */
static int read_vector(PyObject *object, double unit[3])
{
    PyObject *array = core_doubles(object);
    if (!array)
    {
        return 0;
    }
    PyArrayObject *values = (PyArrayObject *)array;
    double length = NAN;
    if (PyArray_NDIM(values) == 1 && PyArray_DIM(values, 0) == 3)
    {
        const double *from = PyArray_DATA(values);
        const double most = fmax(fabs(from[0]), fmax(fabs(from[1]), fabs(from[2])));
        const int exponent = most > 0.0 && isfinite(most) ? ilogb(most) : 0;
        for (int k = 0; k < 3; k++)
        {
            unit[k] = scalbn(from[k], -exponent); /* whose square is in range, by no rounding */
        }
        length = sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
        for (int k = 0; k < 3; k++)
        {
            unit[k] /= length;
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

/* The disc of the arguments of disc(); 0 with an exception. */
static int read_disc(PyObject *const *args, struct disc *disc)
{
    disc->healpix = healpix_of(args[0]);
    if (!read_vector(args[1], disc->centre))
    {
        return 0;
    }
    disc->radius = PyFloat_AsDouble(args[2]);
    disc->lines = PyErr_Occurred() ? 0 : PyNumber_AsSsize_t(args[3], PyExc_ValueError);
    if (!PyErr_Occurred() && (!(disc->radius >= 0.0) || disc->lines < 0 || disc->lines > STEPS_MAX))
    {
        PyErr_SetString(PyExc_ValueError, "a disc has a vector and a radius of 0 or more");
    }
    return !PyErr_Occurred();
}

/* The numbers of runs as an array, which are given back; NULL with an exception. */
static PyObject *array_of_runs(struct disc_runs *runs)
{
    PyObject *array = array_of(NPY_INT64, (npy_intp)runs->pixel_count, 0);
    if (array)
    {
        int64_t *pixel = data_of(array);
        PyThreadState *const state = PyEval_SaveThread();
        disc_write(runs, pixel);
        PyEval_RestoreThread(state);
    }
    return array;
}

/* disc(handle, vector, radius, lines, nested): pixels, sorted, of an object in the order RING, or of that in NESTED, whose
 * centre is within the radius; with lines of latitude, so many to a pixel, those that overlap the disc. */
static PyObject *disc(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    struct disc disc = {0};
    struct disc_runs ring = {0};
    struct disc_runs nested = {0};
    PyObject *array = NULL;
    const int is_nested =
        are_given(args, count, 5) && read_disc(args, &disc) ? PyObject_IsTrue(args[4]) : -1;
    if (is_nested >= 0)
    {
        PyThreadState *const state = PyEval_SaveThread();
        const int is_good =
            disc_find(&disc, &ring) && (!is_nested || disc_find_nested(&disc, &ring, &nested));
        PyEval_RestoreThread(state);
        array = is_good ? array_of_runs(is_nested ? &nested : &ring) : PyErr_NoMemory();
    }
    free(ring.run);
    free(nested.run);
    return array;
}

#define FAST(function) ((PyCFunction)(void (*)(void))(function))

PyMethodDef core_methods[] = {
    {"pixel_neighbours", FAST(neighbours), METH_FASTCALL,
     "pixel_neighbours(handle, pixel): of one pixel, -1 where there is none."},
    {"pixel_boundary", FAST(boundary), METH_FASTCALL,
     "pixel_boundary(handle, pixel, steps, rows): (3, 4 steps), or (4 steps, 3)."},
    {"pixel_boundaries", FAST(boundaries), METH_FASTCALL,
     "pixel_boundaries(handle, pixels, steps): (n, 3, 4 steps) of an array of them."},
    {"pixel_disc", FAST(disc), METH_FASTCALL,
     "pixel_disc(handle, vector, radius, lines, nested): the pixels of a disc, or that overlap "
     "it."},
    {"angles_to_vector", FAST(core_angles_to_vector), METH_FASTCALL,
     "angles_to_vector(theta, phi): a unit vector."},
    {"angles_to_vectors", FAST(core_angles_to_vectors), METH_FASTCALL,
     "angles_to_vectors(theta, phi): unit vectors of arrays of n, (n, 3)."},
    {"lonlat_to_vector", FAST(core_lonlat_to_vector), METH_FASTCALL,
     "lonlat_to_vector(lon, lat): the same of degrees; NaN where there is none."},
    {"vectors_to_angles", FAST(core_vectors_to_angles), METH_FASTCALL,
     "vectors_to_angles(vectors, lonlat): theta and phi, or degrees, of (n, 3), or of one."},
    {NULL, NULL, 0, NULL},
};
