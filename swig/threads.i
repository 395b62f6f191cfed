// Long calls run without the interpreter lock; the world is marked busy meanwhile (world_record.hpp).
%define %long_call(METHOD)
%exception METHOD {
  try {
    pydart2::messages::Listening listening;
    pydart2::python::WithoutGil without_gil;
    $action
  } catch (...) {
    pydart2::python::set_error();
    SWIG_fail;
  }
  pydart2::python::log_messages();
}
%enddef

%long_call(pydart2::WorldHandle::load)
%long_call(pydart2::WorldHandle::add_skeleton)
%long_call(pydart2::WorldHandle::clone)
%long_call(pydart2::WorldHandle::rebuild)
%long_call(pydart2::WorldHandle::step)
%long_call(pydart2::WorldHandle::check_collision)
%long_call(pydart2::BatchHandle::step)
%long_call(pydart2::BatchHandle::rollout)
