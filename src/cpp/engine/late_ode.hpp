#pragma once

namespace pydart2 {

/// While one lives in this thread, a file that asks for ODE gets a detector of that type that does nothing of ODE's: the
/// world's own takes its place (replace_detector()). So files are read without ODE's lock, however long they take.
class LateOde
{
public:
  LateOde();
  ~LateOde();
  LateOde(const LateOde&) = delete;
  LateOde& operator=(const LateOde&) = delete;

  /// Once, before there are other threads.
  static void install();
};

} // namespace pydart2
