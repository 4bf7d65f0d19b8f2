/* SPDX-License-Identifier: MIT
 *
 * Between angles and vectors, as healpy has them: vectors along the last axis, angles as arrays of their own. Ufuncs on parts
 * of vectors take longer to begin than one point takes.
 */
#include "core.h"

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define NO_IMPORT_ARRAY
#define PY_ARRAY_UNIQUE_SYMBOL cubemap_array_api
#include <numpy/arrayobject.h>

#define BLOCK 512 /* points whose parts stay in the cache */
#define TURN 6.283185307179586
#define QUARTER 1.5707963267948966
#define DEGREE (QUARTER / 90.0)
#define DEGREES (90.0 / QUARTER) /* as NumPy rounds both */

static PyObject *numbers_of(npy_intp n)
{
    return PyArray_SimpleNew(1, &n, NPY_DOUBLE);
}

static double *data_of(PyObject *array)
{
    return PyArray_DATA((PyArrayObject *)array);
}

PyObject *core_doubles(PyObject *object)
{
    if (PyArray_CheckExact(object) && PyArray_TYPE((PyArrayObject *)object) == NPY_DOUBLE &&
        PyArray_ISCARRAY_RO((PyArrayObject *)object))
    {
        return Py_NewRef(object);
    }
    PyObject *found = PyArray_FROM_O(object);
    if (found &&
        (PyArray_ISSTRING((PyArrayObject *)found) || PyArray_ISCOMPLEX((PyArrayObject *)found)))
    {
        PyErr_SetString(PyExc_TypeError, "vectors are of real numbers");
        Py_CLEAR(found);
    }
    PyObject *doubles =
        found ? PyArray_FROMANY(found, NPY_DOUBLE, 0, 0, NPY_ARRAY_CARRAY_RO | NPY_ARRAY_FORCECAST)
              : NULL;
    Py_XDECREF(found);
    return doubles;
}

/* Two arguments that are real numbers; 0 with an exception. */
static int read_pair(PyObject *const *args, Py_ssize_t count, double pair[2])
{
    if (count != 2)
    {
        PyErr_SetString(PyExc_TypeError, "two arguments");
        return 0;
    }
    pair[0] = PyFloat_AsDouble(args[0]);
    pair[1] = PyErr_Occurred() ? 0.0 : PyFloat_AsDouble(args[1]);
    return !PyErr_Occurred();
}

/* Sines and cosines of n <= BLOCK angles: as directions on the equator, whose latitude is 0. */
static void find_turns(npy_intp n, const double *angle, double *cosine, double *sine)
{
    static const double equator[BLOCK] = {0.0};
    double height[BLOCK];
    cm_direction_from_lonlat_array((size_t)n, angle, equator, cosine, sine, height);
}

/* Of n colatitudes and longitudes vectors, three numbers each. */
static void find_vectors(npy_intp n, const double *theta, const double *phi, double *vectors)
{
    double height[BLOCK], rho[BLOCK], along[BLOCK], beside[BLOCK];
    for (npy_intp done = 0; done < n; done += BLOCK)
    {
        const npy_intp here = n - done < BLOCK ? n - done : BLOCK;
        find_turns(here, theta + done, height, rho);
        find_turns(here, phi + done, along, beside);
        for (npy_intp i = 0; i < here; i++, vectors += 3)
        {
            vectors[0] = rho[i] * along[i];
            vectors[1] = rho[i] * beside[i];
            vectors[2] = height[i];
        }
    }
}

PyObject *core_angles_to_vector(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    double angles[2];
    PyObject *array = read_pair(args, count, angles) ? numbers_of(3) : NULL;
    if (array)
    {
        double cosine[2], sine[2], *to = data_of(array);
        find_turns(2, angles, cosine, sine);
        to[0] = sine[0] * cosine[1];
        to[1] = sine[0] * sine[1];
        to[2] = cosine[0];
    }
    return array;
}

PyObject *core_angles_to_vectors(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    PyArrayObject *angles[2] = {NULL, NULL};
    PyObject *vectors = NULL;
    for (int k = 0; k < 2 && count == 2; k++)
    {
        angles[k] = (PyArrayObject *)core_doubles(args[k]);
        if (!angles[k])
        {
            break;
        }
    }
    if (angles[0] && angles[1])
    {
        const npy_intp shape[2] = {PyArray_SIZE(angles[0]), 3};
        if (PyArray_SIZE(angles[1]) != shape[0])
        {
            PyErr_SetString(PyExc_ValueError, "as many longitudes as colatitudes");
        }
        else if ((vectors = PyArray_SimpleNew(2, shape, NPY_DOUBLE)) != NULL)
        {
            double *to = data_of(vectors);
            NPY_BEGIN_THREADS_DEF;
            NPY_BEGIN_THREADS_THRESHOLDED(shape[0]);
            find_vectors(shape[0], PyArray_DATA(angles[0]), PyArray_DATA(angles[1]), to);
            NPY_END_THREADS;
        }
    }
    else if (!PyErr_Occurred())
    {
        PyErr_SetString(PyExc_TypeError, "two arguments");
    }
    Py_XDECREF(angles[0]);
    Py_XDECREF(angles[1]);
    return vectors;
}

PyObject *core_lonlat_to_vector(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    double lonlat[2];
    PyObject *array = read_pair(args, count, lonlat) ? numbers_of(3) : NULL;
    if (array)
    {
        double *to = data_of(array);
        lonlat[0] *= DEGREE;
        lonlat[1] *= DEGREE;
        cm_direction_from_lonlat_array(1, &lonlat[0], &lonlat[1], &to[0], &to[1], &to[2]);
    }
    return array;
}

/* Of n vectors, three numbers each, colatitudes and longitudes, or longitudes and latitudes in degrees. */
static void find_angles(npy_intp n, const double *vectors, int lonlat, double *first,
                        double *second)
{
    double part[3][BLOCK];
    double *lon = lonlat ? first : second;
    double *lat = lonlat ? second : first;
    for (npy_intp done = 0; done < n; done += BLOCK)
    {
        const npy_intp here = n - done < BLOCK ? n - done : BLOCK;
        for (npy_intp i = 0; i < here; i++, vectors += 3)
        {
            part[0][i] = vectors[0];
            part[1][i] = vectors[1];
            part[2][i] = vectors[2];
        }
        cm_lonlat_from_direction_array((size_t)here, part[0], part[1], part[2], lon + done,
                                       lat + done);
        for (npy_intp i = done; i < done + here; i++)
        {
            lon[i] += lon[i] < 0.0 ? TURN : 0.0;
            lon[i] = lonlat ? lon[i] * DEGREES : lon[i];
            lat[i] = lonlat ? lat[i] * DEGREES : QUARTER - lat[i];
        }
    }
}

/* Arrays of the angles of an array of vectors. */
static PyObject *angles_of(PyArrayObject *vectors, int lonlat)
{
    const npy_intp count = PyArray_SIZE(vectors);
    if (count % 3 != 0)
    {
        return PyErr_Format(PyExc_ValueError, "vectors: three numbers each, not %zd together",
                            (Py_ssize_t)count);
    }
    PyObject *pair = PyTuple_New(2);
    for (int k = 0; pair && k < 2; k++)
    {
        PyObject *angles = numbers_of(count / 3);
        if (!angles)
        {
            Py_CLEAR(pair);
            break;
        }
        PyTuple_SET_ITEM(pair, k, angles);
    }
    if (pair)
    {
        const double *from = PyArray_DATA(vectors);
        double *to[2] = {data_of(PyTuple_GET_ITEM(pair, 0)), data_of(PyTuple_GET_ITEM(pair, 1))};
        PyThreadState *const state = count > 3 * BLOCK ? PyEval_SaveThread() : NULL;
        find_angles(count / 3, from, lonlat, to[0], to[1]);
        if (state)
        {
            PyEval_RestoreThread(state);
        }
    }
    return pair;
}

PyObject *core_vectors_to_angles(PyObject *module, PyObject *const *args, Py_ssize_t count)
{
    (void)module;
    if (count != 2)
    {
        PyErr_SetString(PyExc_TypeError, "two arguments");
        return NULL;
    }
    const int lonlat = PyObject_IsTrue(args[1]);
    PyObject *vectors = lonlat < 0 ? NULL : core_doubles(args[0]);
    PyObject *pair = vectors ? angles_of((PyArrayObject *)vectors, lonlat) : NULL;
    Py_XDECREF(vectors);
    return pair;
}
