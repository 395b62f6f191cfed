#pragma once

#include <Python.h>

/// LongForm, what reads and sets the short names of pydart2.alias: ``LongForm(Skeleton.positions)(robot)`` is
/// ``robot.positions()``, and ``LongForm(Skeleton.set_positions)(robot, value)`` is ``robot.set_positions(value)``, whose
/// value cannot be None. A lambda does the same in 60 ns more: it is one more function, and binds the method. Where the
/// method only hands on to its handle (pydart2.alias.forwards), it is left out, which saves 100 ns.
namespace pydart2::long_form {

/// Makes the type; null with a Python error set.
PyObject* make_type();

} // namespace pydart2::long_form
