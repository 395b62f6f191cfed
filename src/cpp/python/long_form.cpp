#include "python/long_form.hpp"

#include <structmember.h>

#include <cstddef>
#include <cstring>

#include "python/looked_at.hpp"

namespace pydart2::long_form {

namespace {

struct LongForm
{
  PyObject_HEAD
  vectorcallfunc call;
  PyObject* name;
};

/// The method, if it is a function of the class that nothing in the object hides (new reference); else null.
PyObject* find_function(PyObject* owner, PyObject* name)
{
  if (looked_at::may_have_its_own(owner, name))
    return nullptr;
  PyObject* found = _PyType_Lookup(Py_TYPE(owner), name);
  return found != nullptr && PyFunction_Check(found) ? Py_NewRef(found) : nullptr;
}

/// The object, and the value if one is set.
PyObject* call(PyObject* self, PyObject* const* args, std::size_t flagged_count, PyObject* names)
{
  PyObject* method = reinterpret_cast<LongForm*>(self)->name;
  const auto count = PyVectorcall_NARGS(flagged_count);
  if (names != nullptr || count < 1 || count > 2) {
    PyErr_Format(PyExc_TypeError, "%U() takes an object and at most one value", method);
    return nullptr;
  }
  if (count == 2 && args[1] == Py_None) { // which the method may take for an argument that is left out
    PyErr_Format(PyExc_TypeError, "%s cannot be None", PyUnicode_AsUTF8(method) + std::strlen("set_"));
    return nullptr;
  }
  PyObject* function = find_function(args[0], method);
  if (function == nullptr)
    return PyObject_VectorcallMethod(method, args, static_cast<std::size_t>(count), nullptr);
  PyObject* result = PyObject_Vectorcall(function, args, static_cast<std::size_t>(count), nullptr);
  Py_DECREF(function);
  return result;
}

PyObject* make(PyTypeObject* type, PyObject* args, PyObject*)
{
  PyObject* name = nullptr;
  if (!PyArg_ParseTuple(args, "U", &name))
    return nullptr;
  auto* made = PyObject_New(LongForm, type);
  if (made == nullptr)
    return nullptr;
  made->call = call;
  made->name = Py_NewRef(name);
  PyUnicode_InternInPlace(&made->name); // so that the cache of look-ups knows it
  return reinterpret_cast<PyObject*>(made);
}

void dealloc(PyObject* self)
{
  PyTypeObject* type = Py_TYPE(self);
  Py_DECREF(reinterpret_cast<LongForm*>(self)->name);
  PyObject_Free(self);
  Py_DECREF(type);
}

PyMemberDef members[] = {
    {const_cast<char*>("__vectorcalloffset__"), T_PYSSIZET, offsetof(LongForm, call), READONLY, nullptr},
    {const_cast<char*>("name"), T_OBJECT, offsetof(LongForm, name), READONLY, const_cast<char*>("The method's name.")},
    {nullptr, 0, 0, 0, nullptr}};

} // namespace

PyObject* make_type()
{
  PyType_Slot slots[] = {
      {Py_tp_new, reinterpret_cast<void*>(make)},
      {Py_tp_dealloc, reinterpret_cast<void*>(dealloc)},
      {Py_tp_call, reinterpret_cast<void*>(PyVectorcall_Call)},
      {Py_tp_members, members},
      {Py_tp_doc, const_cast<char*>("Calls the method of that name of what it is given.")},
      {0, nullptr}};
  PyType_Spec spec = {
      "pydart2.pydart2_api.LongForm", sizeof(LongForm), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_VECTORCALL, slots};
  return PyType_FromSpec(&spec);
}

} // namespace pydart2::long_form
