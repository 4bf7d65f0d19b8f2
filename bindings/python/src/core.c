/* SPDX-License-Identifier: MIT
 *
 * The module cubemap._core: its types, and what the package has to know of the library that is linked into it.
 */
#include "core.h"

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define PY_ARRAY_UNIQUE_SYMBOL cubemap_array_api
#define PY_UFUNC_UNIQUE_SYMBOL cubemap_ufunc_api
#include <numpy/arrayobject.h>
#include <numpy/ufuncobject.h>

/* What a loop of NumPy is given has the library's types. */
_Static_assert(sizeof(npy_intp) == sizeof(intptr_t), "npy_intp is not intptr_t");

static int add_sizes(PyObject *module)
{
    PyObject *sizes = PyDict_New();
    if (!sizes)
    {
        return -1;
    }
    for (const struct core_size *row = core_sizes; row->name; row++)
    {
        PyObject *size = PyLong_FromSize_t(row->size);
        if (!size || PyDict_SetItemString(sizes, row->name, size) < 0)
        {
            Py_XDECREF(size);
            Py_DECREF(sizes);
            return -1;
        }
        Py_DECREF(size);
    }
    const int status = PyModule_AddObjectRef(module, "sizes", sizes);
    Py_DECREF(sizes);
    return status;
}

static int add_functions(PyObject *module)
{
    PyObject *names = PyList_New(0);
    for (const struct core_function *row = core_functions; names && row->name; row++)
    {
        PyObject *name = PyUnicode_FromString(row->name);
        if (!name || PyList_Append(names, name) < 0)
        {
            Py_CLEAR(names);
        }
        Py_XDECREF(name);
    }
    const int status = names ? PyModule_AddObjectRef(module, "functions", names) : -1;
    Py_XDECREF(names);
    return status;
}

int core_check(cm_status status)
{
    if (status == CM_OK)
    {
        return 0;
    }
    PyObject *errors = PyImport_ImportModule("cubemap._errors");
    PyObject *nothing = errors ? PyObject_CallMethod(errors, "check", "i", (int)status) : NULL;
    Py_XDECREF(nothing);
    Py_XDECREF(errors);
    return -1;
}

static struct PyModuleDef definition = {
    PyModuleDef_HEAD_INIT,
    .m_name = "cubemap._core",
    .m_doc = "The library and its ufuncs. What people use is in the package cubemap.",
    .m_size = -1,
    .m_methods = core_methods,
};

PyMODINIT_FUNC PyInit__core(void);

PyMODINIT_FUNC PyInit__core(void)
{
    import_array();
    import_umath();
    PyObject *module = PyModule_Create(&definition);
    if (!module)
    {
        return NULL;
    }
    if (PyModule_AddType(module, &core_handle_type) < 0 ||
        PyModule_AddType(module, &core_function_type) < 0 || add_sizes(module) < 0 ||
        add_functions(module) < 0)
    {
        Py_DECREF(module);
        return NULL;
    }
    return module;
}
