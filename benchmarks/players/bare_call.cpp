// The least that a step from Python can cost: a function in C that lets go of the interpreter's lock meanwhile.

#include <Python.h>

#include "loop.hpp"

static PyObject* step(PyObject* self, PyObject*)
{
  auto& world = *static_cast<Loop*>(PyCapsule_GetPointer(self, nullptr))->world;
  Py_BEGIN_ALLOW_THREADS
  world.step();
  Py_END_ALLOW_THREADS
  Py_RETURN_NONE;
}

// A Python function that takes one step of a loop.
extern "C" PyObject* bare_step(Loop* loop)
{
  static PyMethodDef method{"step", step, METH_NOARGS, nullptr};
  PyObject* self = PyCapsule_New(loop, nullptr, nullptr);
  PyObject* function = self == nullptr ? nullptr : PyCFunction_New(&method, self);
  Py_XDECREF(self);
  return function;
}
