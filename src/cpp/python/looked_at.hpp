#pragma once

#include <Python.h>

/// LookedAt, the base in C of pydart2.assignment.Assignable: an attribute is set as in any object, and only of a name
/// that is not in its class's set `_unlooked` Python is asked first: `_is_taken(name, value)`. A `__setattr__` in Python
/// costs 250 ns at each setting.
namespace pydart2::looked_at {

/// Makes the type; null with a Python error set.
PyObject* make_type();

} // namespace pydart2::looked_at
