#pragma once

#include <Python.h>

/// NamedVector, the base in C of pydart2.SkelVector: an ndarray with one pointer more, to the names of its entries
/// (pydart2.indexing.Names, a dict name -> index). `v["name"]` and `v[3]` are answered here, every other key is turned
/// into an index by Names.resolve(key). Creating one costs what an ndarray costs.
/// It knows Python, as all of this folder does, because a subclass in Python costs ten times as much.
namespace pydart2::named_vector {

/// Makes the type; null with a Python error set. NumPy's C API must be imported.
PyObject* make_type();

/// Whether it is a named vector that is read-only: it stands for its names only.
bool is_pattern(PyObject* object);

/// A new float64 vector of the type and with the names of `like`; null with a Python error set.
PyObject* new_like(PyObject* like);

} // namespace pydart2::named_vector
