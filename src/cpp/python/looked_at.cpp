#include "python/looked_at.hpp"

namespace pydart2::looked_at {

namespace {

PyObject* unlooked_name = nullptr;
PyObject* ask_name = nullptr;

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
  PyObject* unlooked = PyObject_GetAttr(reinterpret_cast<PyObject*>(Py_TYPE(self)), unlooked_name);
  const int found = unlooked == nullptr ? -1 : PySet_Contains(unlooked, name);
  Py_XDECREF(unlooked);
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
  return taken > 0 ? PyObject_GenericSetAttr(self, name, value) : taken;
}

} // namespace

PyObject* make_type()
{
  unlooked_name = PyUnicode_InternFromString("_unlooked");
  ask_name = PyUnicode_InternFromString("_is_taken");
  PyType_Slot slots[] = {
      {Py_tp_setattro, reinterpret_cast<void*>(set)},
      {Py_tp_doc, const_cast<char*>("What looks at the names of attributes that are set; the base of Assignable.")},
      {0, nullptr}};
  PyType_Spec spec = {"pydart2.pydart2_api.LookedAt", 0, 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots};
  return PyType_FromSpec(&spec);
}

} // namespace pydart2::looked_at
