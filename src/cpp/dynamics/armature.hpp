#pragma once

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <map>
#include <vector>

namespace pydart2 {

/// Rotor inertia by dof, as MuJoCo's armature: what it adds to the diagonal of the mass matrix. Only dofs that have some.
using Armature = std::map<dart::dynamics::DegreeOfFreedom*, double>;

/// While one is alive, the engine's forward dynamics solve (M + A + dt D) ddq = f - D dq ... in place of
/// (M + dt D) ddq = ...: D + A/dt is the damping, as which the engine takes it implicitly, and A/dt dq a force that undoes
/// what this damping does to the present velocity. The response to impulses has no armature.
class WithArmature
{
public:
  WithArmature(const Armature& armature, double time_step);
  ~WithArmature();
  WithArmature(const WithArmature&) = delete;
  WithArmature& operator=(const WithArmature&) = delete;

private:
  struct Before
  {
    dart::dynamics::DegreeOfFreedom* dof;
    dart::dynamics::Joint::ActuatorType actuator;
    double damping, force, command;
  };

  std::vector<Before> before_;
};

} // namespace pydart2
