// Every call: what the engine prints goes to Python's logging, and a C++ exception becomes the Python exception of its kind (python_errors.hpp, errors.hpp).
%exception {
  try {
    pydart2::messages::Listening listening;
    $action
  } catch (...) {
    pydart2::python::set_error();
    SWIG_fail;
  }
  pydart2::python::log_messages();
}
