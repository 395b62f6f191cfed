#pragma once

#include <Python.h>

/// ContactRow, the base in C of pydart2.Contact: the world and the numbers of a row of contact.hpp. The engine finds
/// contacts by the dozen in every step, and an object with properties in Python costs four times as much.
namespace pydart2::contact_row {

/// Makes the type; null with a Python error set. NumPy's C API must be imported.
PyObject* make_type();

} // namespace pydart2::contact_row
