/* SPDX-License-Identifier: MIT
 *
 * Handle: an object of the library as one of Python. It is given back when nobody has it any more: neither a class of the
 * package, nor a ufunc that works with it.
 */
#include "core.h"

#include <string.h>

static PyObject *handle_new(PyTypeObject *type, PyObject *args, PyObject *keywords)
{
    static char *names[] = {"address", "destroy", "keep", NULL};
    PyObject *address, *keep = Py_None;
    const char *destroy;
    if (!PyArg_ParseTupleAndKeywords(args, keywords, "Os|O:Handle", names, &address, &destroy,
                                     &keep))
    {
        return NULL;
    }
    void *pointer = PyLong_AsVoidPtr(address);
    if (!pointer)
    {
        if (!PyErr_Occurred())
        {
            PyErr_SetString(PyExc_ValueError, "a handle of nothing");
        }
        return NULL;
    }
    const struct core_destroyer *row = core_destroyers;
    while (row->name && strcmp(row->name, destroy) != 0)
    {
        row++;
    }
    if (!row->name)
    {
        return PyErr_Format(PyExc_ValueError, "no function %s", destroy);
    }
    struct core_handle *self = (struct core_handle *)type->tp_alloc(type, 0);
    if (self)
    {
        self->address = pointer;
        self->destroy = row->destroy;
        self->keep = Py_NewRef(keep);
    }
    return (PyObject *)self;
}

static void handle_dealloc(PyObject *object)
{
    struct core_handle *self = (struct core_handle *)object;
    self->destroy(self->address);
    Py_XDECREF(self->keep);
    Py_TYPE(object)->tp_free(object);
}

static PyObject *handle_address(PyObject *object, void *closure)
{
    (void)closure;
    return PyLong_FromVoidPtr(((struct core_handle *)object)->address);
}

static PyGetSetDef handle_members[] = {
    {"address", handle_address, NULL, "Where the library has the object.", NULL},
    {"_as_parameter_", handle_address, NULL,
     "For ctypes, which keeps the handle until a call is over.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

PyTypeObject core_handle_type = {
    PyVarObject_HEAD_INIT(NULL, 0).tp_name = "cubemap._core.Handle",
    .tp_doc = "Handle(address, destroy, keep=None): an object of the library, given back by that "
              "function.",
    .tp_basicsize = sizeof(struct core_handle),
    .tp_flags = Py_TPFLAGS_DEFAULT,
    .tp_new = handle_new,
    .tp_dealloc = handle_dealloc,
    .tp_getset = handle_members,
};
