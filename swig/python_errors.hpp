#pragma once

#include <Python.h>

#include <exception>
#include <new>

#include "base/errors.hpp"
#include "base/messages.hpp"

/// Exceptions and messages on their way from C++ to Python.
namespace pydart2::python {

/// Thrown where a Python error is set already.
struct ErrorIsSet
{
};

/// Raises pydart2.errors.<name>.
inline void raise_own(const char* name, const char* message)
{
  PyObject* module = PyImport_ImportModule("pydart2.errors");
  PyObject* type = module == nullptr ? nullptr : PyObject_GetAttrString(module, name);
  if (type != nullptr)
    PyErr_SetString(type, message);
  Py_XDECREF(type);
  Py_XDECREF(module);
}

/// Hands what the engine printed to Python's logging (pydart2/messages.py). An error that is set stays so.
inline void log_messages()
{
  thread_local bool importing = false; // in which the collector may free a world, which may print
  if (importing || !messages::any())
    return;
  PyObject *type, *value, *traceback;
  PyErr_Fetch(&type, &value, &traceback);
  importing = true;
  PyObject* module = PyImport_ImportModule("pydart2.messages");
  importing = false;
  for (const auto& [level, text] : messages::take()) {
    PyObject* message = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
    PyObject* done = module && message ? PyObject_CallMethod(module, "log", "iO", static_cast<int>(level), message) : nullptr;
    if (done == nullptr)
      PyErr_WriteUnraisable(module); // a handler that fails must not fail the call
    Py_XDECREF(done);
    Py_XDECREF(message);
  }
  Py_XDECREF(module);
  PyErr_Restore(type, value, traceback);
}

/// Turns the C++ exception that is being handled into a Python one.
inline void set_error()
{
  try {
    throw;
  } catch (const ErrorIsSet&) {
  } catch (const Error& error) {
    switch (error.kind()) {
    case Kind::value: PyErr_SetString(PyExc_ValueError, error.what()); break;
    case Kind::type: PyErr_SetString(PyExc_TypeError, error.what()); break;
    case Kind::index: PyErr_SetString(PyExc_IndexError, error.what()); break;
    case Kind::load: raise_own("LoadError", error.what()); break;
    case Kind::destroyed: raise_own("DestroyedError", error.what()); break;
    case Kind::simulation: raise_own("SimulationError", error.what()); break;
    case Kind::engine: raise_own("PydartError", error.what()); break;
    }
  } catch (const std::bad_alloc&) {
    PyErr_NoMemory();
  } catch (const std::exception& error) {
    raise_own("PydartError", error.what());
  } catch (...) {
    raise_own("PydartError", "the engine threw something unknown");
  }
  log_messages();
}

} // namespace pydart2::python
