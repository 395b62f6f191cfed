// The module: pydart2/pydart2_api.py and pydart2/_pydart2_api.*.so. One concern a file; no logic here.
%module(package="pydart2") pydart2_api

%{
#define PY_ARRAY_UNIQUE_SYMBOL pydart2_ARRAY_API
#include "engine/assertions.hpp"
#include "engine/boxed_lcp.hpp"
#include "engine/late_ode.hpp"
#include "engine/shared_scenes.hpp"
#include "engine/static_guards.hpp"
#include "numpy_glue.hpp"
#include "python/last_words.hpp"
#include "python/long_form.hpp"
#include "python/looked_at.hpp"
#include "without_gil.hpp"
%}

%init %{
  import_array();
  pydart2::hold_guards_over_fork();
  pydart2::make_assertions_throw();
  pydart2::make_asymmetry_throw();
  if (!pydart2::share_scenes()) {
    PyErr_SetString(PyExc_ImportError, "the engine's libraries do not import meshes as those of DART 6.12 do");
    return nullptr;
  }
  pydart2::LateOde::install();
  pydart2::messages::install();
  pydart2::python::set_last_words();
  on_exit(pydart2::python::WithoutGil::at_exit, nullptr);
  PyModule_AddObject(m, "LookedAt", pydart2::looked_at::make_type());
  PyModule_AddObject(m, "LongForm", pydart2::long_form::make_type());
  PyModule_AddObject(m, "NamedVector", pydart2::named_vector::make_type());
  PyModule_AddObject(m, "ContactRow", pydart2::contact_row::make_type());
%}

%include "exceptions.i"
%include "threads.i"
%include "typemaps.i"

%include "engine_info.i"
%include "dof.i"
%include "joint.i"
%include "marker.i"
%include "mesh.i"
%include "shape.i"
%include "soft_body.i"
%include "bodynode.i"
%include "dynamics.i"
%include "inverse_kinematics.i"
%include "targets.i"
%include "skeleton.i"
%include "model_source.i"
%include "world.i"
%include "queries.i"
%include "batch.i"

%pythoncode %{
from ._pydart2_api import ContactRow, LongForm, LookedAt, NamedVector

# The flat functions are made of the handle classes, when the first is wanted. (__path__ is asked for at import.)
def __getattr__(name):
    if not name.startswith("__"):
        from .flat.api import MEMBERS
        globals().update(MEMBERS)
        if name in MEMBERS:
            return MEMBERS[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

def __dir__():
    from .flat.api import MEMBERS
    return [*globals(), *MEMBERS]
%}
