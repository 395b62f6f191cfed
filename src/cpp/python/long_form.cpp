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
  PyObject* method;
  PyObject* given; // the tuple of what a method that only forwards gives the handle when it reads; null for others
};

constexpr Py_ssize_t most_given = 3;

PyObject* handle_name = nullptr;

/// The method, if it is a function of the class that nothing in the object hides (new reference); else null.
PyObject* find_function(PyObject* owner, PyObject* name)
{
  if (looked_at::may_have_its_own(owner, name))
    return nullptr;
  PyObject* found = _PyType_Lookup(Py_TYPE(owner), name);
  return found != nullptr && PyFunction_Check(found) ? Py_NewRef(found) : nullptr;
}

/// Whether the function would only hand on to the handle: what is read, or an array that is set.
bool only_forwards(const LongForm& form, PyObject* function, PyObject* value)
{
  return form.given != nullptr && function == form.method && (value == nullptr || PyObject_CheckBuffer(value));
}

/// What the handle is given for an entry of `given` (new reference): a name's attribute, all else as it is.
PyObject* resolve(PyObject* owner, PyObject* entry)
{
  return PyUnicode_Check(entry) ? PyObject_GetAttr(owner, entry) : Py_NewRef(entry);
}

/// What that function would do.
PyObject* forward(const LongForm& form, PyObject* owner, PyObject* value)
{
  PyObject* args[1 + most_given] = {PyObject_GenericGetAttr(owner, handle_name)};
  const Py_ssize_t num_given = value == nullptr ? PyTuple_GET_SIZE(form.given) : 1;
  Py_ssize_t count = 1;
  for (; args[count - 1] != nullptr && count <= num_given; ++count)
    args[count] = value == nullptr ? resolve(owner, PyTuple_GET_ITEM(form.given, count - 1)) : Py_NewRef(value);
  const bool has_all = args[count - 1] != nullptr;
  PyObject* result
      = has_all ? PyObject_VectorcallMethod(form.name, args, static_cast<std::size_t>(count), nullptr) : nullptr;
  for (PyObject* arg : args)
    Py_XDECREF(arg);
  return result;
}

/// The object, and the value if one is set.
PyObject* call(PyObject* self, PyObject* const* args, std::size_t flagged_count, PyObject* names)
{
  const auto& form = *reinterpret_cast<LongForm*>(self);
  const auto count = PyVectorcall_NARGS(flagged_count);
  if (names != nullptr || count < 1 || count > 2) {
    PyErr_Format(PyExc_TypeError, "%U() takes an object and at most one value", form.name);
    return nullptr;
  }
  if (count == 2 && args[1] == Py_None) { // which the method may take for an argument that is left out
    PyErr_Format(PyExc_TypeError, "%s cannot be None", PyUnicode_AsUTF8(form.name) + std::strlen("set_"));
    return nullptr;
  }
  PyObject* function = find_function(args[0], form.name);
  if (function == nullptr)
    return PyObject_VectorcallMethod(form.name, args, static_cast<std::size_t>(count), nullptr);
  PyObject* value = count == 2 ? args[1] : nullptr;
  PyObject* result = only_forwards(form, function, value)
      ? forward(form, args[0], value)
      : PyObject_Vectorcall(function, args, static_cast<std::size_t>(count), nullptr);
  Py_DECREF(function);
  return result;
}

PyObject* make(PyTypeObject* type, PyObject* args, PyObject*)
{
  PyObject* method = nullptr;
  if (!PyArg_ParseTuple(args, "O!", &PyFunction_Type, &method))
    return nullptr;
  PyObject* attributes = reinterpret_cast<PyFunctionObject*>(method)->func_dict;
  PyObject* given = attributes == nullptr ? nullptr : PyDict_GetItemString(attributes, "forwards");
  if (given != nullptr && (!PyTuple_Check(given) || PyTuple_GET_SIZE(given) > most_given))
    return PyErr_Format(PyExc_TypeError, "what a method forwards is a tuple of at most %zd, not %R", most_given, given);
  auto* made = PyObject_New(LongForm, type);
  if (made == nullptr)
    return nullptr;
  made->call = call;
  made->name = Py_NewRef(reinterpret_cast<PyFunctionObject*>(method)->func_name);
  PyUnicode_InternInPlace(&made->name); // so that the cache of look-ups knows it
  made->method = Py_NewRef(method);
  made->given = Py_XNewRef(given);
  return reinterpret_cast<PyObject*>(made);
}

void dealloc(PyObject* self)
{
  PyTypeObject* type = Py_TYPE(self);
  auto* form = reinterpret_cast<LongForm*>(self);
  Py_DECREF(form->name);
  Py_DECREF(form->method);
  Py_XDECREF(form->given);
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
  handle_name = PyUnicode_InternFromString("_handle");
  PyType_Slot slots[] = {
      {Py_tp_new, reinterpret_cast<void*>(make)},
      {Py_tp_dealloc, reinterpret_cast<void*>(dealloc)},
      {Py_tp_call, reinterpret_cast<void*>(PyVectorcall_Call)},
      {Py_tp_members, members},
      {Py_tp_doc, const_cast<char*>("Calls the method of that name of what it is called with.")},
      {0, nullptr}};
  PyType_Spec spec = {
      "pydart2.pydart2_api.LongForm", sizeof(LongForm), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_VECTORCALL, slots};
  return PyType_FromSpec(&spec);
}

} // namespace pydart2::long_form
