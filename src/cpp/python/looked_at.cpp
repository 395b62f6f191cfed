#include "python/looked_at.hpp"

namespace pydart2::looked_at {

namespace {

PyObject* called_names = nullptr; // of attributes that are callable
PyObject* unlooked_name = nullptr;
PyObject* ask_name = nullptr;
PyObject* missing_name = nullptr;

bool is_private(PyObject* name)
{
  return PyUnicode_GET_LENGTH(name) > 0 && PyUnicode_READ_CHAR(name, 0) == '_';
}

/// Whether the value is to become the attribute; -1 with an error set.
int is_taken(PyObject* self, PyObject* name, PyObject* value)
{
  const bool deleted = value == nullptr;
  if (deleted || is_private(name))
    return 1;
  PyObject* unlooked = _PyType_Lookup(Py_TYPE(self), unlooked_name);
  const int found = unlooked == nullptr ? 0 : PySet_Contains(unlooked, name);
  if (found != 0)
    return found;
  PyObject* answer = PyObject_CallMethodObjArgs(self, ask_name, name, value, nullptr);
  const int taken = answer == nullptr ? -1 : PyObject_IsTrue(answer);
  Py_XDECREF(answer);
  return taken;
}

int set(PyObject* self, PyObject* name, PyObject* value)
{
  const int taken = is_taken(self, name, value);
  if (taken > 0 && value != nullptr && PyCallable_Check(value) && !is_private(name) && PySet_Add(called_names, name) < 0)
    return -1;
  return taken > 0 ? PyObject_GenericSetAttr(self, name, value) : taken;
}

/// A property that raises an AttributeError of its own is heard; Python is asked only of names that nothing has.
PyObject* get(PyObject* self, PyObject* name)
{
  PyObject* found = PyObject_GenericGetAttr(self, name);
  const bool is_missing = found == nullptr && !is_private(name) && PyErr_ExceptionMatches(PyExc_AttributeError)
    && _PyType_Lookup(Py_TYPE(self), name) == nullptr;
  if (!is_missing)
    return found;
  PyErr_Clear();
  return PyObject_CallMethodObjArgs(self, missing_name, name, nullptr);
}

} // namespace

PyObject* make_type()
{
  called_names = PySet_New(nullptr);
  unlooked_name = PyUnicode_InternFromString("_unlooked");
  ask_name = PyUnicode_InternFromString("_is_taken");
  missing_name = PyUnicode_InternFromString("_missing");
  PyType_Slot slots[] = {
      {Py_tp_getattro, reinterpret_cast<void*>(get)},
      {Py_tp_setattro, reinterpret_cast<void*>(set)},
      {Py_tp_doc, const_cast<char*>("What looks at names that are set, or not there; the base of Assignable.")},
      {0, nullptr}};
  PyType_Spec spec = {"pydart2.pydart2_api.LookedAt", 0, 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots};
  return called_names == nullptr ? nullptr : PyType_FromSpec(&spec);
}

bool may_have_its_own(PyObject* object, PyObject* name)
{
  const bool is_read_here = Py_TYPE(object)->tp_getattro == get; // of a subclass with no such method of its own
  return !is_read_here || (PySet_GET_SIZE(called_names) != 0 && PySet_Contains(called_names, name) != 0);
}

} // namespace pydart2::looked_at
