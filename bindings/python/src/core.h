/* SPDX-License-Identifier: MIT
 *
 * What the files of the extension module cubemap._core share: the table of functions that work on many points, which
 * generate.py writes from bindings/functions, and the objects that Python sees of it.
 */
#ifndef CUBEMAP_PYTHON_CORE_H
#define CUBEMAP_PYTHON_CORE_H

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <stddef.h>
#include <stdint.h>

#include <cubemap/cubemap.h>

/* No function has more inputs and outputs together. */
#define CORE_OPERANDS_MAX 16

/* No function has more options. */
#define CORE_OPTIONS_MAX 2

/* What a number is for the library. */
enum core_type
{
    CORE_DOUBLE,
    CORE_FLOAT,
    CORE_UINT8,
    CORE_INT,
    CORE_UINT32,
    CORE_INT64,
    CORE_UINT64,
    CORE_TYPES
};

/* What a function has been bound to. */
struct core_context
{
    const void *handle; /* the object, or NULL */
    int64_t option[CORE_OPTIONS_MAX];
    unsigned threads;
};

/* Calls the function of the library for n points. p[k] has the numbers of operand k, those of a point side by side, or,
 * if the operand is planar, n for each number, `plane` apart. */
typedef cm_status (*core_call)(const struct core_context *context, size_t n, void *const *p,
                               size_t plane);

/* An input or an output. */
struct core_operand
{
    unsigned char type;   /* of core_type */
    unsigned char planar; /* does each number have an array of its own? */
    uint16_t items;       /* numbers a point */
};

/* A function in one precision. */
struct core_variant
{
    core_call call;
    struct core_operand operand[CORE_OPERANDS_MAX];
};

/* A function in all precisions. */
struct core_function
{
    const char *name;      /* "cm_forward_array" */
    const char *shown;     /* "forward" */
    const char *signature; /* as NumPy's gufuncs have it; NULL if all operands are single numbers */
    const char *doc;
    int inputs;
    int outputs;
    int options;
    int in_place;      /* may an output be an input? */
    int variant_count; /* 1: double; 2: float first */
    const struct core_variant *variant[2];
};

/* The end of an object of the library. */
struct core_destroyer
{
    const char *name;
    void (*destroy)(void *object);
};

/* The size of a struct, for who declares it anew. */
struct core_size
{
    const char *name;
    size_t size;
};

/* Written by generate.py; each table ends with a NULL name. */
extern const struct core_function core_functions[];
extern const struct core_destroyer core_destroyers[];
extern const struct core_size core_sizes[];

/* What NumPy has for unsigned inputs. */
enum core_integers
{
    CORE_AS_THEY_ARE,
    CORE_AS_SIGNED,   /* 64 bits */
    CORE_AS_UNSIGNED, /* 64 bits, of faces */
    CORE_INTEGERS
};

/* A function for operands of NumPy's types: what a loop of a ufunc is given as data. */
struct core_loop
{
    const struct core_function *function;
    const struct core_variant *variant;
    struct core_context context;
    unsigned char integers; /* what unsigned inputs are for NumPy, of core_integers */
    unsigned char rounds; /* are inputs of float, for which there is no double, double for NumPy? */
};

/* The bytes of a number. */
extern const unsigned char core_type_size[CORE_TYPES];

/* What NumPy has for an operand: 64-bit whole numbers for the small ones that are read, and double for float that rounds. */
enum core_type core_seen_type(const struct core_loop *loop, int operand);

/* How many numbers the next operand's point has along each axis, from the text of a signature, "(),(3)->(4,3)". Returns the
 * text after it. */
const char *core_read_extents(const char *text, int *extents, int extent[2]);

/* A loop of NumPy over n points: args, dims and steps as it gives them, data a core_loop. */
void core_run(char **args, const intptr_t *dims, const intptr_t *steps, void *data);

/* ---- objects of Python ---- */

/* An object of the library, which is given back with it. */
struct core_handle
{
    PyObject_HEAD void *address;
    void (*destroy)(void *object);
    PyObject *keep; /* what must live as long */
};

/* 0, or -1 with the package's own exception. */
int core_check(cm_status status);

/* A new reference to an array of double in a row: the object itself if it is one, which NumPy takes longer to find out. Texts
 * and complex numbers, which NumPy would read and cut, are refused. */
PyObject *core_doubles(PyObject *object);

/* Of the module: pixels (pixel.c), and angles (vector_angle.c). */
extern PyMethodDef core_methods[];
PyObject *core_angles_to_vector(PyObject *module, PyObject *const *args, Py_ssize_t count);
PyObject *core_angles_to_vectors(PyObject *module, PyObject *const *args, Py_ssize_t count);
PyObject *core_lonlat_to_vector(PyObject *module, PyObject *const *args, Py_ssize_t count);
PyObject *core_vectors_to_angles(PyObject *module, PyObject *const *args, Py_ssize_t count);

extern PyTypeObject core_handle_type;
extern PyTypeObject core_function_type;

#endif
