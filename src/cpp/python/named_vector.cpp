#define PY_ARRAY_UNIQUE_SYMBOL pydart2_ARRAY_API
#define NO_IMPORT_ARRAY
#include "python/named_vector.hpp"

#include <numpy/arrayobject.h>
#include <numpy/arrayscalars.h>

namespace pydart2::named_vector {

namespace {

PyTypeObject* type = nullptr;

/// Where the names are in an instance: behind what NumPy's own struct takes, which depends on its version.
PyObject*& names_of(PyObject* vector)
{
  return *reinterpret_cast<PyObject**>(reinterpret_cast<char*>(vector) + PyArray_Type.tp_basicsize);
}

bool is_named_vector(PyObject* object)
{
  return PyObject_TypeCheck(object, type);
}

void set_names(PyObject* vector, PyObject* names)
{
  PyObject* old = names_of(vector);
  names_of(vector) = names == Py_None ? nullptr : names;
  Py_XINCREF(names_of(vector));
  Py_XDECREF(old);
}

int axes_of(PyObject* vector)
{
  return PyArray_NDIM(reinterpret_cast<PyArrayObject*>(vector));
}

/// The names of the last axis, or null if there are none or the array has been reshaped since.
PyObject* valid_names(PyObject* vector)
{
  PyObject* names = names_of(vector);
  auto* array = reinterpret_cast<PyArrayObject*>(vector);
  const int axes = PyArray_NDIM(array);
  if (names == nullptr || axes == 0 || PyArray_DIM(array, axes - 1) != PyDict_Size(names))
    return nullptr;
  return names;
}

bool is_int(PyObject* key)
{
  return (PyLong_Check(key) && !PyBool_Check(key)) || PyArray_IsScalar(key, Integer);
}

PyObject* shape_of(PyObject* vector)
{
  auto* array = reinterpret_cast<PyArrayObject*>(vector);
  PyObject* shape = PyTuple_New(PyArray_NDIM(array));
  for (int axis = 0; shape != nullptr && axis < PyArray_NDIM(array); ++axis)
    PyTuple_SET_ITEM(shape, axis, PyLong_FromSsize_t(PyArray_DIM(array, axis)));
  return shape;
}

/// (index, names of what it picks) for any key but an int of a vector; null with a Python error set.
PyObject* resolve(PyObject* self, PyObject* names, PyObject* key)
{
  static PyObject* const of_one_axis = PyUnicode_InternFromString("resolve");
  static PyObject* const of_more = PyUnicode_InternFromString("resolve_last");
  PyObject* resolved = nullptr;
  if (axes_of(self) == 1) {
    resolved = PyObject_CallMethodOneArg(names, of_one_axis, key);
  } else if (PyObject* shape = shape_of(self)) {
    resolved = PyObject_CallMethodObjArgs(names, of_more, key, shape, nullptr);
    Py_DECREF(shape);
  }
  if (resolved != nullptr && !(PyTuple_Check(resolved) && PyTuple_GET_SIZE(resolved) == 2)) {
    Py_DECREF(resolved);
    PyErr_SetString(PyExc_TypeError, "Names must return (index, names)");
    return nullptr;
  }
  return resolved;
}

PyObject* subscript(PyObject* self, PyObject* key)
{
  const auto get = PyArray_Type.tp_as_mapping->mp_subscript;
  PyObject* names = valid_names(self);
  const bool is_vector = axes_of(self) == 1;
  if (names == nullptr || (is_vector && is_int(key)))
    return get(self, key);
  if (is_vector && PyUnicode_CheckExact(key)) {
    if (PyObject* index = PyDict_GetItemWithError(names, key))
      return get(self, index);
    if (PyErr_Occurred())
      return nullptr;
  }
  PyObject* resolved = resolve(self, names, key);
  if (resolved == nullptr)
    return nullptr;
  PyObject* result = get(self, PyTuple_GET_ITEM(resolved, 0));
  if (result != nullptr && is_named_vector(result))
    set_names(result, PyTuple_GET_ITEM(resolved, 1));
  Py_DECREF(resolved);
  return result;
}

/// Says so if nobody can see what is set, as in `robot.q[0] = 1`: the interpreter holds the only reference, to numbers of
/// its own. (From Python 3.14 on this cannot be told, as local variables are borrowed.)
bool warn_if_lost(PyObject* self)
{
  if (PY_VERSION_HEX >= 0x030e0000 || Py_REFCNT(self) > 1 || PyArray_BASE(reinterpret_cast<PyArrayObject*>(self)) != nullptr)
    return true;
  return PyErr_WarnEx(
             PyExc_UserWarning,
             "this sets an entry of a copy that is lost: q = robot.q, q['knee'] = 0.4, robot.q = q, or "
             "robot.set_positions({'knee': 0.4})",
             1)
         == 0;
}

int assign_subscript(PyObject* self, PyObject* key, PyObject* value)
{
  const auto set = PyArray_Type.tp_as_mapping->mp_ass_subscript;
  if (!warn_if_lost(self))
    return -1;
  PyObject* names = valid_names(self);
  if (PySlice_Check(key)) { // NumPy takes four times as long for a view of a subclass
    PyObject* plain = PyArray_View(reinterpret_cast<PyArrayObject*>(self), nullptr, &PyArray_Type);
    const int status = plain == nullptr ? -1 : set(plain, key, value);
    Py_XDECREF(plain);
    return status;
  }
  if (names == nullptr || (axes_of(self) == 1 && is_int(key)))
    return set(self, key, value);
  PyObject* resolved = resolve(self, names, key);
  if (resolved == nullptr)
    return -1;
  const int status = set(self, PyTuple_GET_ITEM(resolved, 0), value);
  Py_DECREF(resolved);
  return status;
}

/// NumPy calls this on every new instance; `source` is what the array was made from. Views and results of the same
/// shape keep the names.
int finalize(PyArrayObject* array, PyObject* source)
{
  auto* vector = reinterpret_cast<PyObject*>(array);
  if (source == nullptr || source == Py_None || !is_named_vector(source))
    return 0;
  PyObject* names = valid_names(source);
  const int axes = PyArray_NDIM(array);
  if (names != nullptr && axes == axes_of(source)
      && PyArray_CompareLists(PyArray_DIMS(array), PyArray_DIMS(reinterpret_cast<PyArrayObject*>(source)), axes))
    set_names(vector, names);
  return 0;
}

void dealloc(PyObject* self)
{
  PyTypeObject* self_type = Py_TYPE(self);
  Py_CLEAR(names_of(self));
  PyArray_Type.tp_dealloc(self);
  Py_DECREF(self_type);
}

PyObject* get_names(PyObject* self, void*)
{
  PyObject* names = valid_names(self);
  return Py_NewRef(names == nullptr ? Py_None : names);
}

int assign_names(PyObject* self, PyObject* names, void*)
{
  if (names == nullptr || (names != Py_None && !PyDict_Check(names))) {
    PyErr_SetString(PyExc_TypeError, "names must be a pydart2.indexing.Names or None");
    return -1;
  }
  set_names(self, names);
  return 0;
}

/// NumPy calls this on its results. As the base's, but single numbers are NumPy's scalars: the base makes them arrays
/// without dimensions.
PyObject* array_wrap(PyObject* self, PyObject* const* args, Py_ssize_t count) // array, context, return_scalar
{
  if (count < 1 || count > 3 || !PyArray_Check(args[0])) {
    PyErr_SetString(PyExc_TypeError, "__array_wrap__() takes an array, a context and whether to return a scalar");
    return nullptr;
  }
  auto* array = reinterpret_cast<PyArrayObject*>(args[0]);
  const int return_scalar = count == 3 ? PyObject_IsTrue(args[2]) : 0;
  if (return_scalar < 0)
    return nullptr;
  Py_INCREF(array);
  if (return_scalar != 0)
    return PyArray_Return(array);
  if (Py_TYPE(array) == Py_TYPE(self))
    return reinterpret_cast<PyObject*>(array);
  Py_INCREF(PyArray_DESCR(array));
  PyObject* wrapped = PyArray_NewFromDescr(
      Py_TYPE(self), PyArray_DESCR(array), PyArray_NDIM(array), PyArray_DIMS(array), PyArray_STRIDES(array),
      PyArray_DATA(array), PyArray_FLAGS(array), self);
  if (wrapped == nullptr)
    Py_DECREF(array);
  else if (PyArray_SetBaseObject(
               reinterpret_cast<PyArrayObject*>(wrapped), reinterpret_cast<PyObject*>(array)) < 0) // takes the array
    Py_CLEAR(wrapped);
  return wrapped;
}

PyMethodDef methods[] = {
    {"__array_wrap__", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(array_wrap)), METH_FASTCALL,
     "NumPy's hook for results: those with names stay vectors, single numbers are numbers."},
    {nullptr, nullptr, 0, nullptr}};

PyGetSetDef getset[] = {
    {"_names", get_names, assign_names, "The names of the entries, or None.", nullptr},
    {nullptr, nullptr, nullptr, nullptr, nullptr}};

} // namespace

PyObject* make_type()
{
  PyType_Slot slots[] = {
      {Py_tp_dealloc, reinterpret_cast<void*>(dealloc)},
      {Py_mp_subscript, reinterpret_cast<void*>(subscript)},
      {Py_mp_ass_subscript, reinterpret_cast<void*>(assign_subscript)},
      {Py_tp_methods, methods},
      {Py_tp_getset, getset},
      {Py_tp_doc, const_cast<char*>("An ndarray that knows the names of its entries; the base of SkelVector.")},
      {0, nullptr}};
  PyType_Spec spec = {
      "pydart2.pydart2_api.NamedVector",
      static_cast<int>(PyArray_Type.tp_basicsize + sizeof(PyObject*)),
      0,
      Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE,
      slots};
  PyObject* made = PyType_FromSpecWithBases(&spec, reinterpret_cast<PyObject*>(&PyArray_Type));
  PyObject* capsule = PyCapsule_New(reinterpret_cast<void*>(finalize), nullptr, nullptr);
  if (made == nullptr || capsule == nullptr || PyObject_SetAttrString(made, "__array_finalize__", capsule) < 0) {
    Py_XDECREF(made);
    Py_XDECREF(capsule);
    return nullptr;
  }
  Py_DECREF(capsule);
  type = reinterpret_cast<PyTypeObject*>(made);
  return Py_NewRef(made);
}

bool is_pattern(PyObject* object)
{
  return is_named_vector(object) && !PyArray_ISWRITEABLE(reinterpret_cast<PyArrayObject*>(object));
}

PyObject* new_like(PyObject* like)
{
  PyObject* names = is_named_vector(like) ? valid_names(like) : nullptr;
  if (names == nullptr) {
    PyErr_SetString(PyExc_TypeError, "expected a vector with names");
    return nullptr;
  }
  npy_intp size = PyDict_Size(names);
  return PyArray_NewFromDescr(
      Py_TYPE(like), PyArray_DescrFromType(NPY_DOUBLE), 1, &size, nullptr, nullptr, 0, like);
}

} // namespace pydart2::named_vector
