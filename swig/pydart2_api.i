// The module: pydart2/pydart2_api.py and pydart2/_pydart2_api.*.so. One concern a file; no logic here.
%module(package="pydart2") pydart2_api

%{
#define PY_ARRAY_UNIQUE_SYMBOL pydart2_ARRAY_API
#include "numpy_glue.hpp"
%}

%init %{
  import_array();
  PyModule_AddObject(m, "NamedVector", pydart2::named_vector::make_type());
%}

%include "exceptions.i"
%include "threads.i"
%include "typemaps.i"

%include "dof.i"
%include "joint.i"
%include "marker.i"
%include "shape.i"
%include "soft_body.i"
%include "bodynode.i"
%include "skeleton.i"
%include "world.i"

%pythoncode %{
from ._pydart2_api import NamedVector
%}
