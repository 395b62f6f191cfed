// Eigen <-> NumPy and lenient scalars. Shapes are checked here and nowhere else; the work is in numpy_glue.hpp.
%include "std_string.i"

namespace pydart2 {
class Output;
struct Blueprint;
struct VectorIn;
struct MatrixIn;
struct MatrixOut;
}

// Results that an engine method writes straight into an ndarray: a fresh one; one with the names of a pattern, or the
// one that is passed; the one that is passed unless that is None (numpy_glue.hpp).
%typemap(in, numinputs=0) pydart2::Output& out (pydart2::python::NumpyOutput numpy) "$1 = &numpy;"
%typemap(in) pydart2::Output& like (pydart2::python::NumpyOutput numpy), pydart2::Output& into (pydart2::python::NumpyOutput numpy) {
  numpy.use($input);
  $1 = &numpy;
}
%typemap(argout) pydart2::Output& out, pydart2::Output& like, pydart2::Output& into {
  Py_DECREF($result);
  $result = numpy$argnum.release();
}

%typemap(in) const pydart2::VectorIn& (pydart2::VectorIn vector, PyArrayObject* owner = nullptr) {
  if (!pydart2::python::read_vector($input, "$1_name", owner, vector)) SWIG_fail;
  $1 = &vector;
}
%typemap(freearg) const pydart2::VectorIn& "Py_XDECREF(owner$argnum);"
%typemap(in) const pydart2::MatrixIn& (pydart2::MatrixIn matrix, PyArrayObject* owner = nullptr) {
  if (!pydart2::python::read_matrix($input, "$1_name", owner, matrix)) SWIG_fail;
  $1 = &matrix;
}
%typemap(freearg) const pydart2::MatrixIn& "Py_XDECREF(owner$argnum);"

%typemap(in) const pydart2::MatrixOut& (pydart2::MatrixOut matrix) {
  if (!pydart2::python::read_output($input, "$1_name", matrix)) SWIG_fail;
  $1 = &matrix;
}

%define %fixed_size(TYPE)
%feature("novaluewrapper") TYPE;
class TYPE;
%typemap(in) const TYPE& (TYPE fixed) {
  if (!pydart2::python::read_fixed($input, "$1_name", fixed)) SWIG_fail;
  $1 = &fixed;
}
%typemap(in) const TYPE* (TYPE fixed) {
  if ($input == Py_None)
    $1 = nullptr;
  else if (pydart2::python::read_fixed($input, "$1_name", fixed))
    $1 = &fixed;
  else
    SWIG_fail;
}
%typemap(out) TYPE "$result = pydart2::python::to_numpy($1);"
%enddef

%fixed_size(Eigen::Vector3d)
%fixed_size(Eigen::Vector4d)
%fixed_size(Eigen::Matrix3d)
%fixed_size(Eigen::Matrix4d)
%feature("novaluewrapper") pydart2::Vector6d;
%typemap(out) pydart2::Vector6d "$result = pydart2::python::to_numpy($1);"

%typemap(in) const std::string& (std::string text) {
  if (!pydart2::python::read_text($input, "$1_name", text)) SWIG_fail;
  $1 = &text;
}
%typemap(freearg) const std::string& "";
%typemap(in) const std::vector<std::string>& (std::vector<std::string> texts) {
  if (!pydart2::python::read_list($input, "$1_name", texts)) SWIG_fail;
  $1 = &texts;
}
%typemap(out) std::vector<std::string> "$result = pydart2::python::to_list($1);"

%feature("novaluewrapper") pydart2::Blueprint;
%typemap(in) const pydart2::Blueprint& (pydart2::Blueprint blueprint) {
  if (!pydart2::python::read_blueprint($input, "$1_name", blueprint)) SWIG_fail;
  $1 = &blueprint;
}
%typemap(out) pydart2::Blueprint "$result = pydart2::python::to_tuple($1);"

%typemap(in) bool "if (!pydart2::python::read_bool($input, \"$1_name\", $1)) SWIG_fail;"
%typemap(in) long "if (!pydart2::python::read_long($input, \"$1_name\", $1)) SWIG_fail;"
%typemap(in) double "if (!pydart2::python::read_double($input, \"$1_name\", $1)) SWIG_fail;"
