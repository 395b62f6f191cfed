#pragma once

#include <Python.h>

/// LookedAt, the base in C of pydart2.assignment.Assignable: an attribute is set as in any object, and only of a name
/// that is not in its class's set `_unlooked` Python is asked first: `_is_taken(name, value)`. Of a name that is not
/// there `_missing(name)` is asked, which gives it or raises. In Python a `__setattr__` would cost 250 ns at each
/// setting, a `__getattr__` 5 ns at each reading. Python 3.11 does not specialise how attributes of such a class are
/// looked up: a property takes 15 ns more than without it, a method 80 ns.
namespace pydart2::looked_at {

/// Makes the type; null with a Python error set.
PyObject* make_type();

/// Whether an object may have an attribute of its own where its class has a function of that name. It may, where such an
/// attribute has been set to something callable in any object (but by way of `__dict__`), or the object is not a LookedAt.
bool may_have_its_own(PyObject* object, PyObject* name);

} // namespace pydart2::looked_at
