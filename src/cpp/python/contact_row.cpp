#define PY_ARRAY_UNIQUE_SYMBOL pydart2_ARRAY_API
#define NO_IMPORT_ARRAY
#include "python/contact_row.hpp"

#include <numpy/arrayobject.h>

#include <algorithm>
#include <limits>

#include "state/contact.hpp"

namespace pydart2::contact_row {

namespace {

constexpr int documented_columns = 10; // point, force and the ids of skeletons and bodies

struct ContactRow
{
  PyObject_HEAD
  PyObject* world;
  PyObject* skeletons; ///< That the ids in the row are about; null for those that the world has now.
  double row[contact_columns];
};

const double* row_of(PyObject* self)
{
  return reinterpret_cast<ContactRow*>(self)->row;
}

/// A new contact of this type; `row` has `size` numbers, `skeletons` may be null.
PyObject* make(PyTypeObject* type, PyObject* world, PyObject* skeletons, const double* row, npy_intp size)
{
  PyObject* self = type->tp_alloc(type, 0);
  if (self == nullptr)
    return nullptr;
  auto* contact = reinterpret_cast<ContactRow*>(self);
  contact->world = Py_NewRef(world);
  contact->skeletons = Py_XNewRef(skeletons);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double rest[] = {-1.0, -1.0, unknown, unknown, unknown, unknown};
  std::copy(rest, rest + 6, contact->row + documented_columns);
  std::copy(row, row + size, contact->row);
  return self;
}

/// The argument as rows of doubles (new reference); null with an error set.
PyArrayObject* read(PyObject* numbers, int dimensions, bool documented_too)
{
  auto* array = reinterpret_cast<PyArrayObject*>(PyArray_FROM_OTF(numbers, NPY_DOUBLE, NPY_ARRAY_CARRAY_RO));
  if (array == nullptr)
    return nullptr;
  const npy_intp size = PyArray_NDIM(array) == dimensions ? PyArray_DIM(array, dimensions - 1) : 0;
  if (size == contact_columns || (documented_too && size == documented_columns))
    return array;
  PyErr_Format(
      PyExc_ValueError, "a contact has %s%d numbers, got %.200R", documented_too ? "10 or " : "", contact_columns, numbers);
  Py_DECREF(array);
  return nullptr;
}

PyObject* create(PyTypeObject* type, PyObject* args, PyObject* keywords)
{
  static const char* names[] = {"_world", "_state", nullptr};
  PyObject *world, *state;
  if (!PyArg_ParseTupleAndKeywords(args, keywords, "OO:Contact", const_cast<char**>(names), &world, &state))
    return nullptr;
  PyArrayObject* array = read(state, 1, true);
  if (array == nullptr)
    return nullptr;
  PyObject* self = make(type, world, nullptr, static_cast<const double*>(PyArray_DATA(array)), PyArray_DIM(array, 0));
  Py_DECREF(array);
  return self;
}

PyObject* from_rows(PyObject* type, PyObject* args)
{
  PyObject *world, *rows, *skeletons = nullptr;
  if (!PyArg_ParseTuple(args, "OO|O:from_rows", &world, &rows, &skeletons))
    return nullptr;
  PyArrayObject* array = read(rows, 2, false);
  if (array == nullptr)
    return nullptr;
  const npy_intp count = PyArray_DIM(array, 0);
  const auto* row = static_cast<const double*>(PyArray_DATA(array));
  PyObject* list = PyList_New(count);
  for (npy_intp i = 0; list != nullptr && i < count; ++i, row += contact_columns) {
    PyObject* contact = make(reinterpret_cast<PyTypeObject*>(type), world, skeletons, row, contact_columns);
    if (contact == nullptr)
      Py_CLEAR(list);
    else
      PyList_SET_ITEM(list, i, contact);
  }
  Py_DECREF(array);
  return list;
}

PyObject* reduce(PyObject* self, PyObject*)
{
  npy_intp size = contact_columns;
  PyObject* row = PyArray_SimpleNew(1, &size, NPY_DOUBLE);
  if (row == nullptr)
    return nullptr;
  std::copy(row_of(self), row_of(self) + size, static_cast<double*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(row))));
  return Py_BuildValue("(O(ON))", Py_TYPE(self), reinterpret_cast<ContactRow*>(self)->world, row);
}

/// Which columns a property shows.
struct Columns
{
  int first, size;
};

PyObject* get_vector(PyObject* self, void* closure)
{
  const auto& columns = *static_cast<const Columns*>(closure);
  npy_intp size = columns.size;
  PyObject* vector = PyArray_SimpleNew(1, &size, NPY_DOUBLE);
  if (vector != nullptr)
    std::copy_n(
        row_of(self) + columns.first, size,
        static_cast<double*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(vector))));
  return vector;
}

PyObject* get_id(PyObject* self, void* closure)
{
  return PyLong_FromDouble(row_of(self)[static_cast<const Columns*>(closure)->first]);
}

PyObject* get_number(PyObject* self, void* closure)
{
  return PyFloat_FromDouble(row_of(self)[static_cast<const Columns*>(closure)->first]);
}

PyObject* get_world(PyObject* self, void*)
{
  PyObject* world = reinterpret_cast<ContactRow*>(self)->world;
  return Py_NewRef(world == nullptr ? Py_None : world); // none once the collector has cleared a cycle
}

PyObject* get_skeletons(PyObject* self, void*)
{
  PyObject* skeletons = reinterpret_cast<ContactRow*>(self)->skeletons;
  return Py_NewRef(skeletons == nullptr ? Py_None : skeletons);
}

int traverse(PyObject* self, visitproc visit, void* arg)
{
  Py_VISIT(Py_TYPE(self));
  Py_VISIT(reinterpret_cast<ContactRow*>(self)->world);
  Py_VISIT(reinterpret_cast<ContactRow*>(self)->skeletons);
  return 0;
}

int clear(PyObject* self)
{
  Py_CLEAR(reinterpret_cast<ContactRow*>(self)->world);
  Py_CLEAR(reinterpret_cast<ContactRow*>(self)->skeletons);
  return 0;
}

void dealloc(PyObject* self)
{
  PyTypeObject* type = Py_TYPE(self);
  PyObject_GC_UnTrack(self);
  clear(self);
  type->tp_free(self);
  Py_DECREF(type);
}

Columns state{0, 10}, point{0, 3}, force{3, 3}, skeleton1{6, 1}, body1{7, 1}, skeleton2{8, 1}, body2{9, 1};
Columns shape1{10, 1}, shape2{11, 1}, normal{12, 3}, depth{15, 1};

PyGetSetDef getset[] = {
    {"world", get_world, nullptr, "The world.", nullptr},
    {"_skeletons", get_skeletons, nullptr, "Those that the ids are about; None for the world's present ones.", nullptr},
    {"state", get_vector, nullptr, "Point, force and the ids of skeletons and bodies, shape (10,).", &state},
    {"point", get_vector, nullptr, "Where the bodies touch, shape (3,), m.", &point},
    {"p", get_vector, nullptr, "Same as point.", &point},
    {"force", get_vector, nullptr, "Force on the first body, shape (3,), N.", &force},
    {"f", get_vector, nullptr, "Same as force.", &force},
    {"skel_id1", get_id, nullptr, "Id of the first body's skeleton.", &skeleton1},
    {"bodynode_id1", get_id, nullptr, "Id of the first body.", &body1},
    {"skel_id2", get_id, nullptr, "Id of the second body's skeleton.", &skeleton2},
    {"bodynode_id2", get_id, nullptr, "Id of the second body.", &body2},
    {"shape_id1", get_id, nullptr, "Id of the first body's shape node.", &shape1},
    {"shape_id2", get_id, nullptr, "Id of the second body's shape node.", &shape2},
    {"normal", get_vector, nullptr, "Unit normal, from the second body to the first, shape (3,).", &normal},
    {"depth", get_number, nullptr, "Penetration depth, m.", &depth},
    {nullptr, nullptr, nullptr, nullptr, nullptr}};

PyMethodDef methods[] = {
    {"from_rows", from_rows, METH_VARARGS | METH_CLASS, "from_rows(world, rows, skeletons): a list of contacts; rows of shape (n, 16), and what their ids are about."},
    {"__reduce__", reduce, METH_NOARGS, nullptr},
    {nullptr, nullptr, 0, nullptr}};

} // namespace

PyObject* make_type()
{
  PyType_Slot slots[] = {
      {Py_tp_new, reinterpret_cast<void*>(create)},
      {Py_tp_dealloc, reinterpret_cast<void*>(dealloc)},
      {Py_tp_traverse, reinterpret_cast<void*>(traverse)},
      {Py_tp_clear, reinterpret_cast<void*>(clear)},
      {Py_tp_getset, getset},
      {Py_tp_methods, methods},
      {Py_tp_doc, const_cast<char*>("The numbers of a contact; the base of Contact.")},
      {0, nullptr}};
  PyType_Spec spec = {
      "pydart2.pydart2_api.ContactRow",
      sizeof(ContactRow),
      0,
      Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC,
      slots};
  return PyType_FromSpec(&spec);
}

} // namespace pydart2::contact_row
