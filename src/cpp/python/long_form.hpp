#pragma once

#include <Python.h>

/// LongForm, what reads and sets the short names of pydart2.alias: ``LongForm("positions")(robot)`` is
/// ``robot.positions()``, and with a value, which cannot be None, ``robot.set_positions(value)``. A lambda does the same in
/// 60 ns more: it is one more function, and binds the method.
namespace pydart2::long_form {

/// Makes the type; null with a Python error set.
PyObject* make_type();

} // namespace pydart2::long_form
