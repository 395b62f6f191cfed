#pragma once

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <map>

namespace pydart2 {

/// Rotor inertia by dof, as MuJoCo's armature: what it adds to the diagonal of the mass matrix. Only dofs that have some.
using Armature = std::map<dart::dynamics::DegreeOfFreedom*, double>;

/// Forms the articulated inertias of a skeleton with the armature A of its joints, (J' I J + A)^-1 in place of
/// (J' I J)^-1 (Featherstone, Rigid Body Dynamics Algorithms, section 9.6), where the engine keeps its own: forward dynamics
/// and the response to impulses have them from then on, until positions change or the engine forms its own again. Nothing
/// without armature.
void put_into_inertias(const Armature& armature, dart::dynamics::Skeleton& skeleton);

} // namespace pydart2
