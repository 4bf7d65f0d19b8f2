/* SPDX-License-Identifier: MIT
 *
 * Function: a function of the library, bound to an object of it, as a ufunc of NumPy with a short way for single numbers
 * of Python: these never become arrays. What a point has several of, a Jacobian, is written into a new array.
 */
#include "core.h"

#include <math.h>
#include <string.h>
#include <structmember.h>

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define NO_IMPORT_ARRAY
#define NO_IMPORT_UFUNC
#define PY_ARRAY_UNIQUE_SYMBOL cubemap_array_api
#define PY_UFUNC_UNIQUE_SYMBOL cubemap_ufunc_api
#include <numpy/arrayobject.h>
#include <numpy/ufuncobject.h>

struct function
{
    PyObject_HEAD vectorcallfunc call;
    PyObject *ufunc;
    PyObject *
        result; /* what makes the result of a tuple: a named tuple, or a function; NULL: the tuple itself */
    PyTypeObject *named; /* the named tuple */
    PyObject *
        origin; /* what makes it again, as pickle wants it; NULL if it is bound to what nobody can make */
    const struct core_loop *
        alone; /* the loop of double, which the ufunc owns; NULL if an input has several numbers a point */
    int extents[CORE_OPERANDS_MAX]; /* of each output's point: 0, 1 or 2 */
    int extent[CORE_OPERANDS_MAX][2];
};

static const char numpy_types[CORE_TYPES] = {
    [CORE_DOUBLE] = NPY_DOUBLE, [CORE_FLOAT] = NPY_FLOAT,   [CORE_UINT8] = NPY_UINT8,
    [CORE_INT] = NPY_INT,       [CORE_UINT32] = NPY_UINT32, [CORE_INT64] = NPY_INT64,
    [CORE_UINT64] = NPY_UINT64,
};

/* ---- single numbers ---- */

/* A number as the library has it. */
union number
{
    double real;
    float single;
    uint8_t byte;
    int whole;
    uint32_t natural;
    int64_t signed_long;
    uint64_t unsigned_long;
};

/* A real number, also from a whole one, as read_number. */
static int read_real(enum core_type type, PyObject *object, union number *number)
{
    double real;
    if (PyFloat_Check(object))
    {
        real = PyFloat_AS_DOUBLE(object);
    }
    else if (PyLong_CheckExact(object))
    {
        real = PyLong_AsDouble(object);
        if (real == -1.0 && PyErr_Occurred())
        {
            return -1;
        }
    }
    else
    {
        return 0;
    }
    if (type == CORE_FLOAT)
    {
        number->single = (float)real;
    }
    else
    {
        number->real = real;
    }
    return 1;
}

/* 1; 0 if the object is none of Python's numbers of that kind; -1 with an exception. */
static int read_number(enum core_type type, PyObject *object, union number *number)
{
    if (type == CORE_DOUBLE || type == CORE_FLOAT)
    {
        return read_real(type, object, number);
    }
    if (!PyLong_CheckExact(object))
    {
        return 0;
    }
    int overflow;
    const long long value = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (type == CORE_UINT64 && overflow > 0)
    {
        number->unsigned_long = PyLong_AsUnsignedLongLong(object);
        return number->unsigned_long == UINT64_MAX && PyErr_Occurred() ? -1 : 1;
    }
    if (type == CORE_UINT64 || type == CORE_INT64)
    {
        if (overflow)
        {
            PyErr_SetString(PyExc_OverflowError, "a whole number has more than 64 bits");
            return -1;
        }
        number->signed_long = value; /* of unsigned ones, too: the same bits, as in arrays */
    }
    else if (type == CORE_UINT8)
    {
        number->byte = overflow || value < 0 || value > 255 ? 255 : (uint8_t)value;
    }
    else if (type == CORE_UINT32)
    {
        number->natural =
            overflow || value < 0 || value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
    }
    else
    {
        number->whole = overflow || value < INT32_MIN || value > INT32_MAX ? INT32_MIN : (int)value;
    }
    return 1;
}

static PyObject *write_number(enum core_type type, const union number *number)
{
    switch (type)
    {
    case CORE_DOUBLE:
        return PyFloat_FromDouble(number->real);
    case CORE_FLOAT:
        return PyFloat_FromDouble((double)number->single);
    case CORE_UINT8:
        return PyLong_FromLong(number->byte);
    case CORE_INT:
        return PyLong_FromLong(number->whole);
    case CORE_UINT32:
        return PyLong_FromUnsignedLong(number->natural);
    case CORE_INT64:
        return PyLong_FromLongLong(number->signed_long);
    default:
        return PyLong_FromUnsignedLongLong(number->unsigned_long);
    }
}

/* A new array for what an output has of a point. */
static PyObject *make_array(enum core_type type, int extents, const int extent[2])
{
    npy_intp sizes[2] = {0, 0};
    for (int axis = 0; axis < extents; axis++)
    {
        sizes[axis] = extent[axis];
    }
    return PyArray_SimpleNew(extents, sizes, numpy_types[type]);
}

/* A tuple, or one of the names of a result. */
static PyObject *make_tuple(PyTypeObject *named, Py_ssize_t items)
{
    return named ? named->tp_alloc(named, items) : PyTuple_New(items);
}

/* Inputs from their objects, and places for the outputs: in numbers, or in arrays. 1; 0 if some argument is not a number of
 * Python; -1 with an exception. */
static int place_numbers(const struct function *self, PyObject *const *args, union number *numbers,
                         void **pointers, PyObject **arrays)
{
    const struct core_loop *loop = self->alone;
    const int inputs = loop->function->inputs;
    for (int k = 0; k < inputs; k++)
    {
        pointers[k] = &numbers[k];
        const int is_number = read_number(loop->variant->operand[k].type, args[k], &numbers[k]);
        if (is_number != 1)
        {
            return is_number;
        }
    }
    for (int k = 0; k < loop->function->outputs; k++)
    {
        pointers[inputs + k] = &numbers[inputs + k];
        if (self->extents[k] > 0)
        {
            arrays[k] = make_array(loop->variant->operand[inputs + k].type, self->extents[k],
                                   self->extent[k]);
            if (!arrays[k])
            {
                return -1;
            }
            pointers[inputs + k] = PyArray_DATA((PyArrayObject *)arrays[k]);
        }
    }
    return 1;
}

/* An output as an object: its array, which is taken, or a number. */
static PyObject *take_output(const struct core_loop *loop, int k, const union number *numbers,
                             PyObject **arrays)
{
    PyObject *array = arrays[k];
    const int operand = loop->function->inputs + k;
    arrays[k] = NULL;
    return array ? array : write_number(loop->variant->operand[operand].type, &numbers[operand]);
}

/* The outputs as a tuple, or one output alone. */
static PyObject *take_outputs(const struct function *self, const union number *numbers,
                              PyObject **arrays)
{
    const struct core_loop *loop = self->alone;
    const int outputs = loop->function->outputs;
    if (outputs == 1)
    {
        return take_output(loop, 0, numbers, arrays);
    }
    PyObject *tuple = make_tuple(self->named, outputs);
    for (int k = 0; tuple && k < outputs; k++)
    {
        PyObject *item = take_output(loop, k, numbers, arrays);
        if (!item)
        {
            Py_CLEAR(tuple);
            break;
        }
        PyTuple_SET_ITEM(tuple, k, item);
    }
    return tuple;
}

/* The result for single numbers; NULL without an exception if some argument is not a number of Python. */
static PyObject *call_alone(const struct function *self, PyObject *const *args)
{
    const struct core_loop *loop = self->alone;
    union number numbers[CORE_OPERANDS_MAX];
    void *pointers[CORE_OPERANDS_MAX];
    PyObject *arrays[CORE_OPERANDS_MAX] = {NULL};
    PyObject *found = NULL;
    if (place_numbers(self, args, numbers, pointers, arrays) == 1)
    {
        loop->variant->call(&loop->context, 1, pointers, 1);
        found = take_outputs(self, numbers, arrays);
    }
    for (int k = 0; k < loop->function->outputs; k++)
    {
        Py_XDECREF(arrays[k]);
    }
    return found;
}

/* A tuple of NumPy's as the result: one of its names, or what a function makes of it. The tuple is taken. */
static PyObject *name_outputs(const struct function *self, PyObject *tuple)
{
    PyObject *made = NULL;
    if (!self->named)
    {
        made = PyObject_CallOneArg(self->result, tuple);
    }
    else
    {
        const Py_ssize_t items = PyTuple_GET_SIZE(tuple);
        made = make_tuple(self->named, items);
        for (Py_ssize_t k = 0; made && k < items; k++)
        {
            PyTuple_SET_ITEM(made, k, Py_NewRef(PyTuple_GET_ITEM(tuple, k)));
        }
    }
    Py_DECREF(tuple);
    return made;
}

/* Is there an array of a subclass, as masked ones are, or a tuple, in which outputs may be some? */
static int has_subclass(PyObject *const *args, Py_ssize_t count)
{
    for (Py_ssize_t k = 0; k < count; k++)
    {
        if (PyTuple_Check(args[k]) || (PyArray_Check(args[k]) && !PyArray_CheckExact(args[k])))
        {
            return 1;
        }
    }
    return 0;
}

/* A call of the ufunc by Python: a module that sees to masks, or to units. */
static PyObject *call_by(const char *name, const struct function *self, PyObject *const *args,
                         Py_ssize_t count, PyObject *names)
{
    PyObject *module = PyImport_ImportModule(name);
    PyObject *keywords = module ? PyDict_New() : NULL;
    PyObject *given = keywords ? PyTuple_New(count) : NULL;
    for (Py_ssize_t k = 0; given && k < count; k++)
    {
        PyTuple_SET_ITEM(given, k, Py_NewRef(args[k]));
    }
    for (Py_ssize_t k = 0; given && names && k < PyTuple_GET_SIZE(names); k++)
    {
        if (PyDict_SetItem(keywords, PyTuple_GET_ITEM(names, k), args[count + k]) != 0)
        {
            Py_CLEAR(given);
        }
    }
    PyObject *found =
        given ? PyObject_CallMethod(module, "call", "OOO", self->ufunc, given, keywords) : NULL;
    Py_XDECREF(given);
    Py_XDECREF(keywords);
    Py_XDECREF(module);
    return found;
}

/* A call of the ufunc. */
static PyObject *call_ufunc(const struct function *self, PyObject *const *args, size_t flagged,
                            PyObject *names)
{
    const Py_ssize_t count = PyVectorcall_NARGS(flagged);
    const Py_ssize_t named = names ? PyTuple_GET_SIZE(names) : 0;
    if (((PyUFuncObject *)self->ufunc)->core_enabled && has_subclass(args, count + named))
    {
        return call_by("cubemap._masked", self, args, count, names);
    }
    return PyObject_Vectorcall(self->ufunc, args, flagged, names);
}

/* As call_ufunc; what refuses because of an array of a subclass is tried again with the numbers of quantities. */
static PyObject *call_general(const struct function *self, PyObject *const *args, size_t flagged,
                              PyObject *names)
{
    PyObject *found = call_ufunc(self, args, flagged, names);
    const Py_ssize_t count = PyVectorcall_NARGS(flagged);
    const Py_ssize_t named = names ? PyTuple_GET_SIZE(names) : 0;
    if (found || !PyErr_ExceptionMatches(PyExc_TypeError) || !has_subclass(args, count + named))
    {
        return found;
    }
    PyObject *type, *value, *traceback;
    PyErr_Fetch(&type, &value, &traceback);
    found = call_by("cubemap._quantities", self, args, count, names);
    if (found != Py_None)
    {
        Py_DECREF(type);
        Py_XDECREF(value);
        Py_XDECREF(traceback);
        return found;
    }
    Py_DECREF(found); /* there are none */
    PyErr_Restore(type, value, traceback);
    return NULL;
}

static PyObject *function_call(PyObject *object, PyObject *const *args, size_t flagged,
                               PyObject *names)
{
    struct function *self = (struct function *)object;
    PyObject *found = NULL;
    if (self->alone && !names && PyVectorcall_NARGS(flagged) == self->alone->function->inputs)
    {
        found = call_alone(self, args);
        if (!found && PyErr_Occurred())
        {
            return NULL;
        }
    }
    if (!found)
    {
        found = call_general(self, args, flagged, names);
    }
    return found && self->result && PyTuple_CheckExact(found) ? name_outputs(self, found) : found;
}

/* ---- making one ---- */

/* What the ufunc owns in one block: its loops, their types and their data. */
struct loops
{
    PyUFuncGenericFunction function[2 * CORE_INTEGERS];
    void *data[2 * CORE_INTEGERS];
    struct core_loop loop[2 * CORE_INTEGERS];
    char types[2 * CORE_INTEGERS * CORE_OPERANDS_MAX];
};

/* The last of core_integers that there is to be a loop for, if there is an input of unsigned numbers. Faces may be of any
 * whole numbers: those that do not fit into a byte are refused. Numbers of cells are the same 64 bits, as which databases have
 * them. */
static unsigned char last_integers(const struct core_function *function)
{
    unsigned char last = CORE_AS_THEY_ARE;
    for (int k = 0; k < function->inputs; k++)
    {
        const unsigned char type = function->variant[0]->operand[k].type;
        if (type == CORE_UINT8)
        {
            return CORE_AS_UNSIGNED;
        }
        last = type == CORE_UINT64 ? CORE_AS_SIGNED : last;
    }
    return last;
}

/* Is there an input of float, of which no other loop takes what has more digits? */
static int has_float_alone(const struct core_function *function)
{
    for (int k = 0; function->variant_count == 1 && k < function->inputs; k++)
    {
        if (function->variant[0]->operand[k].type == CORE_FLOAT)
        {
            return 1;
        }
    }
    return 0;
}

/* A loop for a variant, and the letters of its types. Returns where the next letter goes. */
static char *fill_loop(struct loops *loops, int at, const struct core_loop *loop, char *type)
{
    const struct core_function *function = loop->function;
    loops->loop[at] = *loop;
    loops->function[at] = core_run;
    loops->data[at] = &loops->loop[at];
    for (int k = 0; k < function->inputs + function->outputs; k++)
    {
        *type++ = numpy_types[core_seen_type(loop, k)];
    }
    return type;
}

/* float before double, unsigned before signed whole numbers: NumPy takes the first loop to which all casts are safe. */
static int fill_loops(const struct core_function *function, const struct core_context *context,
                      struct loops *loops)
{
    int count = 0;
    char *type = loops->types;
    for (int variant = 0; variant < function->variant_count; variant++)
    {
        for (unsigned char rounds = 0; rounds <= has_float_alone(function); rounds++)
        {
            for (unsigned char integers = 0; integers <= last_integers(function); integers++)
            {
                const struct core_loop loop = {function, function->variant[variant], *context,
                                               integers, rounds};
                type = fill_loop(loops, count++, &loop, type);
            }
        }
    }
    return count;
}

/* The shapes of the outputs; whether each input has one number a point. */
static int read_shapes(const struct core_function *function, struct function *self)
{
    const char *signature = function->signature;
    int are_single = 1;
    for (int k = 0; signature && k < function->inputs + function->outputs; k++)
    {
        int extents, extent[2] = {0, 0};
        signature = core_read_extents(signature, &extents, extent);
        if (k < function->inputs)
        {
            are_single &= extents == 0;
            continue;
        }
        self->extents[k - function->inputs] = extents;
        memcpy(self->extent[k - function->inputs], extent, sizeof extent);
    }
    return are_single;
}

static PyObject *make_ufunc(const struct core_function *function,
                            const struct core_context *context, PyObject *owner,
                            const struct core_loop **alone)
{
    struct loops *loops = PyArray_malloc(sizeof *loops);
    if (!loops)
    {
        return PyErr_NoMemory();
    }
    const int count = fill_loops(function, context, loops);
    PyObject *object = PyUFunc_FromFuncAndDataAndSignature(
        loops->function, loops->data, loops->types, count, function->inputs, function->outputs,
        PyUFunc_None, function->shown, function->doc, 0, function->signature);
    if (!object)
    {
        PyArray_free(loops);
        return NULL;
    }
    PyUFuncObject *ufunc = (PyUFuncObject *)object;
    ufunc->ptr = loops;
    ufunc->obj = Py_NewRef(owner); /* the mapping lives as long as the ufunc */
    *alone = &loops->loop[count - 1];
    return object;
}

/* Whether the object has this operation: what it says to no points. 0, or -1 with the package's own exception. */
static int probe(const struct core_function *function, const struct core_context *context)
{
    void *pointers[CORE_OPERANDS_MAX] = {NULL};
    return core_check(function->variant[0]->call(context, 0, pointers, 0));
}

static const struct core_function *find_function(const char *name)
{
    for (const struct core_function *row = core_functions; row->name; row++)
    {
        if (strcmp(row->name, name) == 0)
        {
            return row;
        }
    }
    PyErr_Format(PyExc_ValueError, "no function %s for many points", name);
    return NULL;
}

/* What is to be made of a result of several outputs. 0; -1 with an exception if it is a named tuple of another number of
 * them, of which some would be no objects, or would be written behind its end. */
static int name_result(struct function *self, PyObject *result, const struct core_function *row)
{
    self->result = result == Py_None ? NULL : Py_NewRef(result);
    const int is_tuple =
        PyType_Check(result) && PyType_IsSubtype((PyTypeObject *)result, &PyTuple_Type);
    self->named = is_tuple ? (PyTypeObject *)result : NULL;
    if (!is_tuple)
    {
        return 0;
    }
    PyObject *fields = PyObject_GetAttrString(result, "_fields");
    const Py_ssize_t count = fields ? PyObject_Length(fields) : -1;
    Py_XDECREF(fields);
    if (count >= 0 && count != row->outputs)
    {
        PyErr_Format(PyExc_TypeError, "result: %R has %zd fields, %s %d outputs", result, count,
                     row->name, row->outputs);
    }
    return count == row->outputs ? 0 : -1;
}

/* What a function is bound to: options, NULL for none, and a handle, None for none. 0; -1 with an exception. */
static int read_context(const struct core_function *row, PyObject *options, PyObject *handle,
                        struct core_context *context)
{
    const Py_ssize_t given = options ? PyTuple_GET_SIZE(options) : 0;
    if (given != row->options)
    {
        PyErr_Format(PyExc_TypeError, "%s has %d options, not %zd", row->name, row->options, given);
        return -1;
    }
    for (Py_ssize_t k = 0; k < given; k++)
    {
        context->option[k] = PyLong_AsLongLong(PyTuple_GET_ITEM(options, k));
        if (context->option[k] == -1 && PyErr_Occurred())
        {
            return -1;
        }
    }
    if (handle == Py_None)
    {
        return 0;
    }
    if (!PyObject_TypeCheck(handle, &core_handle_type))
    {
        PyErr_Format(PyExc_TypeError, "handle: a Handle, not %R", handle);
        return -1;
    }
    context->handle = ((struct core_handle *)handle)->address;
    return context->handle ? probe(row, context) : 0;
}

static PyObject *function_new(PyTypeObject *type, PyObject *args, PyObject *keywords)
{
    static char *names[] = {"name", "handle", "options", "threads", "result", "origin", NULL};
    const char *name;
    PyObject *handle = Py_None, *options = NULL, *result = Py_None, *origin = NULL;
    struct core_context context = {NULL, {0, 0}, 1};
    if (!PyArg_ParseTupleAndKeywords(args, keywords, "s|OO!IOO!:Function", names, &name, &handle,
                                     &PyTuple_Type, &options, &context.threads, &result,
                                     &PyTuple_Type, &origin))
    {
        return NULL;
    }
    const struct core_function *row = find_function(name);
    if (!row || read_context(row, options, handle, &context) != 0)
    {
        return NULL;
    }
    struct function *self = (struct function *)type->tp_alloc(type, 0);
    if (!self)
    {
        return NULL;
    }
    self->call = function_call;
    self->origin = Py_XNewRef(origin);
    if (name_result(self, result, row) == 0)
    {
        self->ufunc = make_ufunc(row, &context, handle, &self->alone);
    }
    if (!self->ufunc)
    {
        Py_CLEAR(self);
    }
    else if (!read_shapes(row, self))
    {
        self->alone = NULL;
    }
    return (PyObject *)self;
}

static int function_traverse(PyObject *object, visitproc visit, void *arg)
{
    struct function *self = (struct function *)object;
    Py_VISIT(self->ufunc);
    Py_VISIT(self->result);
    Py_VISIT(self->origin);
    return 0;
}

static void function_dealloc(PyObject *object)
{
    struct function *self = (struct function *)object;
    PyObject_GC_UnTrack(object);
    Py_XDECREF(self->origin);
    Py_XDECREF(self->result);
    Py_XDECREF(self->ufunc);
    Py_TYPE(object)->tp_free(object);
}

static PyObject *function_doc(PyObject *object, void *closure)
{
    (void)closure;
    return PyUnicode_FromString(((PyUFuncObject *)((struct function *)object)->ufunc)->doc);
}

static PyObject *function_name(PyObject *object, void *closure)
{
    (void)closure;
    return PyUnicode_FromString(((PyUFuncObject *)((struct function *)object)->ufunc)->name);
}

static PyObject *function_repr(PyObject *object)
{
    return PyUnicode_FromFormat("<function %s of cubemap>",
                                ((PyUFuncObject *)((struct function *)object)->ufunc)->name);
}

static PyObject *function_reduce(PyObject *object, PyObject *nothing)
{
    (void)nothing;
    PyObject *origin = ((struct function *)object)->origin;
    if (!origin)
    {
        PyErr_Format(PyExc_TypeError,
                     "%R cannot be pickled: only methods of what is made of a few numbers can",
                     object);
    }
    return Py_XNewRef(origin);
}

static PyMethodDef function_methods[] = {
    {"__reduce__", function_reduce, METH_NOARGS, "What makes it again, for pickle and copy."},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef function_getters[] = {
    {"__doc__", function_doc, NULL, NULL, NULL},
    {"__name__", function_name, NULL, NULL, NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyMemberDef function_members[] = {
    {"ufunc", T_OBJECT_EX, offsetof(struct function, ufunc), READONLY,
     "The ufunc of NumPy behind it."},
    {NULL, 0, 0, 0, NULL},
};

PyTypeObject core_function_type = {
    PyVarObject_HEAD_INIT(NULL, 0).tp_name = "cubemap._core.Function",
    .tp_basicsize = sizeof(struct function),
    .tp_flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_HAVE_VECTORCALL,
    .tp_vectorcall_offset = offsetof(struct function, call),
    .tp_call = PyVectorcall_Call,
    .tp_new = function_new,
    .tp_traverse = function_traverse,
    .tp_dealloc = function_dealloc,
    .tp_repr = function_repr,
    .tp_methods = function_methods,
    .tp_getset = function_getters,
    .tp_members = function_members,
};
