#pragma once

#include <Python.h>
#include <numpy/arrayobject.h>
#include <numpy/arrayscalars.h>

#include <string>
#include <vector>

#include "base/arrays.hpp"
#include "python/contact_row.hpp"
#include "python/named_vector.hpp"
#include "python_errors.hpp"
#include "state/blueprint.hpp"

/// What the typemaps call: NumPy in, NumPy out.
namespace pydart2::python {

/// A new ndarray of float64.
inline PyObject* new_array(int ndim, const npy_intp* shape)
{
  static PyArray_Descr* const doubles = PyArray_DescrFromType(NPY_DOUBLE);
  Py_INCREF(doubles);
  return PyArray_NewFromDescr(&PyArray_Type, doubles, ndim, shape, nullptr, nullptr, 0, nullptr);
}

/// The ndarray that a method fills: a fresh one, or after use(o) what the caller passed. That is a pattern for a fresh
/// one with the same names if it is a named vector that is read-only, else the array to fill.
class NumpyOutput : public Output
{
public:
  NumpyOutput() = default;
  NumpyOutput(const NumpyOutput&) = delete;
  NumpyOutput& operator=(const NumpyOutput&) = delete;
  ~NumpyOutput() override { Py_XDECREF(array_); }

  void use(PyObject* passed) { passed_ = passed == Py_None ? nullptr : passed; }

  double* vector(long size) override
  {
    npy_intp shape = size;
    if (passed_ == nullptr)
      return keep(new_array(1, &shape));
    if (!named_vector::is_pattern(passed_))
      return keep(to_fill(1, &shape));
    double* values = keep(named_vector::new_like(passed_));
    if (PyArray_DIM(as_array(array_), 0) != size) {
      PyErr_SetString(PyExc_ValueError, "the skeleton's dofs have changed; call its build()");
      throw ErrorIsSet{};
    }
    return values;
  }

  double* matrix(long rows, long cols) override
  {
    npy_intp shape[] = {rows, cols};
    return keep(passed_ == nullptr ? new_array(2, shape) : to_fill(2, shape));
  }

  PyObject* release()
  {
    PyObject* array = array_;
    array_ = nullptr;
    return array;
  }

private:
  static PyArrayObject* as_array(PyObject* object) { return reinterpret_cast<PyArrayObject*>(object); }

  double* keep(PyObject* array)
  {
    Py_XSETREF(array_, array);
    if (array_ == nullptr)
      throw ErrorIsSet{};
    return static_cast<double*>(PyArray_DATA(as_array(array_)));
  }

  /// The passed array (new reference) if it has this shape and float64 in C order; null with an error set otherwise.
  PyObject* to_fill(int ndim, const npy_intp* shape) const
  {
    auto* array = as_array(passed_);
    if (!PyArray_Check(passed_) || PyArray_TYPE(array) != NPY_DOUBLE) {
      PyErr_Format(PyExc_TypeError, "out needs to be an array of float64, got %R", passed_);
      return nullptr;
    }
    if (PyArray_ISCARRAY(array) && PyArray_NDIM(array) == ndim && PyArray_CompareLists(PyArray_DIMS(array), shape, ndim))
      return Py_NewRef(passed_);
    const std::string size = std::to_string(shape[0]) + (ndim == 1 ? "," : ", " + std::to_string(shape[1]));
    PyObject* got = PyObject_GetAttrString(passed_, "shape");
    const char* flaw = !PyArray_ISWRITEABLE(array)       ? " that may not be written to"
                       : !PyArray_IS_C_CONTIGUOUS(array) ? " whose numbers do not follow each other in C order"
                       : !PyArray_ISCARRAY(array)        ? " in another byte order or not aligned"
                                                         : "";
    PyErr_Format(
        PyExc_ValueError, "out needs to be a writeable array in C order of shape (%s), got one of shape %S%s", size.c_str(),
        got, flaw);
    Py_XDECREF(got);
    return nullptr;
  }

  PyObject* array_ = nullptr;
  PyObject* passed_ = nullptr;
};

/// The object as a C-contiguous float64 array (new reference); null with TypeError set, naming the argument.
inline PyArrayObject* to_array(PyObject* object, const char* what)
{
  if (PyArray_Check(object)) {
    auto* array = reinterpret_cast<PyArrayObject*>(object);
    if (PyArray_TYPE(array) == NPY_DOUBLE && PyArray_ISCARRAY_RO(array))
      return reinterpret_cast<PyArrayObject*>(Py_NewRef(object));
  }
  auto* array = reinterpret_cast<PyArrayObject*>(PyArray_FROM_OTF(object, NPY_DOUBLE, NPY_ARRAY_CARRAY_RO));
  if (array == nullptr) {
    PyErr_Clear();
    PyErr_Format(PyExc_TypeError, "%s needs numbers, got %.200R", what, object);
  }
  return array;
}

inline void raise_shape(const char* what, const std::string& expected, PyArrayObject* got)
{
  PyObject* shape = PyObject_GetAttrString(reinterpret_cast<PyObject*>(got), "shape");
  PyErr_Format(PyExc_ValueError, "%s needs shape %s, got %R", what, expected.c_str(), shape);
  Py_XDECREF(shape);
}

/// A 1-D argument of any length; `owner` keeps its memory. False with an error set.
inline bool read_vector(PyObject* object, const char* what, PyArrayObject*& owner, VectorIn& vector)
{
  owner = to_array(object, what);
  if (owner == nullptr)
    return false;
  if (PyArray_NDIM(owner) != 1) {
    raise_shape(what, "(n,)", owner);
    return false;
  }
  vector = {static_cast<const double*>(PyArray_DATA(owner)), static_cast<long>(PyArray_DIM(owner, 0))};
  return true;
}

/// A 2-D argument of any shape; `owner` keeps its memory. False with an error set.
inline bool read_matrix(PyObject* object, const char* what, PyArrayObject*& owner, MatrixIn& matrix)
{
  owner = to_array(object, what);
  if (owner == nullptr)
    return false;
  if (PyArray_NDIM(owner) != 2) {
    raise_shape(what, "(n, m)", owner);
    return false;
  }
  matrix = {static_cast<const double*>(PyArray_DATA(owner)), PyArray_DIM(owner, 0), PyArray_DIM(owner, 1)};
  return true;
}

/// A 2-D array to be filled. False with an error set.
inline bool read_output(PyObject* object, const char* what, MatrixOut& matrix)
{
  auto* array = reinterpret_cast<PyArrayObject*>(object);
  if (!PyArray_Check(object) || PyArray_TYPE(array) != NPY_DOUBLE || !PyArray_ISCARRAY(array) || PyArray_NDIM(array) != 2) {
    PyErr_Format(PyExc_TypeError, "%s needs a writeable 2-D float64 array in C order, got %.200R", what, object);
    return false;
  }
  matrix = {static_cast<double*>(PyArray_DATA(array)), PyArray_DIM(array, 0), PyArray_DIM(array, 1)};
  return true;
}

/// An argument of the fixed size of an Eigen vector or matrix. False with an error set.
template <class Matrix>
bool read_fixed(PyObject* object, const char* what, Matrix& out)
{
  constexpr int rows = Matrix::RowsAtCompileTime, cols = Matrix::ColsAtCompileTime;
  PyArrayObject* array = to_array(object, what);
  if (array == nullptr)
    return false;
  const bool fits = cols == 1 ? PyArray_NDIM(array) == 1 && PyArray_DIM(array, 0) == rows
                              : PyArray_NDIM(array) == 2 && PyArray_DIM(array, 0) == rows && PyArray_DIM(array, 1) == cols;
  if (fits) {
    using Rows = Eigen::Matrix<double, rows, cols, cols == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    out = Eigen::Map<const Rows>(static_cast<const double*>(PyArray_DATA(array)));
  } else {
    const std::string n = std::to_string(rows);
    raise_shape(what, cols == 1 ? "(" + n + ",)" : "(" + n + ", " + std::to_string(cols) + ")", array);
  }
  Py_DECREF(array);
  return fits;
}

/// A fresh ndarray with an Eigen vector (1-D) or matrix (2-D, row-major).
template <class Matrix>
PyObject* to_numpy(const Matrix& matrix)
{
  constexpr int rows = Matrix::RowsAtCompileTime, cols = Matrix::ColsAtCompileTime;
  npy_intp shape[] = {matrix.rows(), matrix.cols()};
  PyObject* array = new_array(cols == 1 ? 1 : 2, shape);
  if (array != nullptr) {
    using Rows = Eigen::Matrix<double, rows, cols, cols == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    auto* values = static_cast<double*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(array)));
    Eigen::Map<Rows>(values, matrix.rows(), matrix.cols()) = matrix;
  }
  return array;
}

inline PyObject* to_list(const std::vector<std::string>& texts)
{
  PyObject* list = PyList_New(static_cast<Py_ssize_t>(texts.size()));
  for (std::size_t i = 0; list != nullptr && i < texts.size(); ++i) {
    PyObject* text = PyUnicode_DecodeUTF8(texts[i].data(), static_cast<Py_ssize_t>(texts[i].size()), "surrogateescape");
    if (text == nullptr)
      Py_CLEAR(list);
    else
      PyList_SET_ITEM(list, static_cast<Py_ssize_t>(i), text);
  }
  return list;
}

/// A str, as std_string.i and to_list() make it: bytes that are no UTF-8 come back as they were. False with no error set.
inline bool decode(PyObject* object, std::string& text)
{
  PyObject* bytes = PyUnicode_Check(object) ? PyUnicode_AsEncodedString(object, "utf-8", "surrogateescape") : nullptr;
  if (bytes != nullptr)
    text.assign(PyBytes_AS_STRING(bytes), static_cast<std::size_t>(PyBytes_GET_SIZE(bytes)));
  Py_XDECREF(bytes);
  PyErr_Clear();
  return bytes != nullptr;
}

/// False with TypeError set.
inline bool read_text(PyObject* object, const char* what, std::string& text)
{
  const bool fine = decode(object, text);
  if (!fine)
    PyErr_Format(PyExc_TypeError, "%s must be a string, got %.200R", what, object);
  return fine;
}

/// A list of str, as to_list() makes it. False with an error set.
inline bool read_list(PyObject* object, const char* what, std::vector<std::string>& texts)
{
  PyObject* list = PySequence_Fast(object, "");
  const Py_ssize_t size = list == nullptr ? 0 : PySequence_Fast_GET_SIZE(list);
  bool fine = list != nullptr;
  for (Py_ssize_t i = 0; fine && i < size; ++i)
    fine = decode(PySequence_Fast_GET_ITEM(list, i), texts.emplace_back());
  Py_XDECREF(list);
  if (!fine)
    PyErr_Format(PyExc_TypeError, "%s needs a list of str, got %.200R", what, object);
  return fine;
}

/// (plan, texts, numbers, state): two lists of str, two ndarrays.
inline PyObject* to_tuple(const Blueprint& blueprint)
{
  const auto numpy = [](const std::vector<double>& numbers) {
    return to_numpy(VectorIn{numbers.data(), static_cast<long>(numbers.size())}.eigen());
  };
  return Py_BuildValue(
      "NNNN", to_list(blueprint.plan), to_list(blueprint.texts), numpy(blueprint.numbers), numpy(blueprint.state));
}

/// A tuple as to_tuple() makes it. False with an error set.
inline bool read_blueprint(PyObject* object, const char* what, Blueprint& blueprint)
{
  const auto read_numbers = [](PyObject* passed, const char* name, std::vector<double>& numbers) {
    PyArrayObject* owner = nullptr;
    VectorIn vector;
    const bool fine = read_vector(passed, name, owner, vector);
    if (fine)
      numbers.assign(vector.data, vector.data + vector.size);
    Py_XDECREF(owner);
    return fine;
  };
  if (!PyTuple_Check(object) || PyTuple_GET_SIZE(object) != 4) {
    PyErr_Format(PyExc_TypeError, "%s needs a tuple of plan, texts, numbers and state, got %.200R", what, object);
    return false;
  }
  return read_list(PyTuple_GET_ITEM(object, 0), "plan", blueprint.plan)
         && read_list(PyTuple_GET_ITEM(object, 1), "texts", blueprint.texts)
         && read_numbers(PyTuple_GET_ITEM(object, 2), "numbers", blueprint.numbers)
         && read_numbers(PyTuple_GET_ITEM(object, 3), "state", blueprint.state);
}

/// Python's bool and int, NumPy's bool and integers. False with TypeError set.
inline bool read_bool(PyObject* object, const char* what, bool& out)
{
  if (!PyLong_Check(object) && !PyArray_IsScalar(object, Bool) && !PyArray_IsScalar(object, Integer)) {
    PyErr_Format(PyExc_TypeError, "%s must be True or False, got %.200R", what, object);
    return false;
  }
  out = PyObject_IsTrue(object) == 1;
  return true;
}

inline bool read_long(PyObject* object, const char* what, long& out)
{
  PyObject* index = PyNumber_Index(object);
  if (index == nullptr) {
    PyErr_Format(PyExc_TypeError, "%s must be an integer, got %.200R", what, object);
    return false;
  }
  int overflow = 0;
  out = PyLong_AsLongAndOverflow(index, &overflow);
  Py_DECREF(index);
  if (overflow != 0)
    PyErr_Format(PyExc_IndexError, "%s %.200R is too large", what, object);
  return overflow == 0;
}

inline bool read_double(PyObject* object, const char* what, double& out)
{
  out = PyFloat_AsDouble(object);
  if (out == -1.0 && PyErr_Occurred()) {
    PyErr_Format(PyExc_TypeError, "%s must be a number, got %.200R", what, object);
    return false;
  }
  return true;
}

} // namespace pydart2::python
