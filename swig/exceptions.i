// Every call: a C++ exception becomes the Python exception of its kind (numpy_glue.hpp, errors.hpp).
%exception {
  try {
    $action
  } catch (...) {
    pydart2::python::set_error();
    SWIG_fail;
  }
}
