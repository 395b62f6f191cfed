// Long calls run without the interpreter lock.
%define %without_lock(METHOD, BEFORE)
%exception METHOD {
  try {
    pydart2::messages::Listening listening;
    BEFORE
    pydart2::python::WithoutGil without_gil;
    $action
  } catch (...) {
    pydart2::python::set_error();
    SWIG_fail;
  }
  pydart2::python::log_messages();
}
%enddef

// A world or batch is claimed first, with the lock: no other thread can then be between finding it free and using it.
%define %long_call(METHOD)
%without_lock(METHOD, const auto claim = arg1->claim();)
%enddef

%without_lock(pydart2::WorldHandle::load, )
%without_lock(pydart2::WorldHandle::rebuild, )
%long_call(pydart2::WorldHandle::add_skeleton)
%long_call(pydart2::WorldHandle::step)
%long_call(pydart2::WorldHandle::check_collision)
%long_call(pydart2::BatchHandle::step)
%long_call(pydart2::BatchHandle::rollout)
%long_call(pydart2::InverseKinematicsHandle::solve)
