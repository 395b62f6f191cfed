#pragma once

#include "base/archive.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// All that a user may have changed since the files were loaded: time step, gravity, detector, names, masses, joint
/// frames, limits, actuators, springs, friction, shapes, flags, pairs that do not collide, constraints. What a file fixes
/// (bodies, joint types, kinds of shapes) must agree on the way in; ValueError otherwise.
///
/// A setter that is added to a handle needs a line here, so that clones have what it sets.
void visit_model(Archive& archive, WorldRecord& world, bool with_skeletons = true);

/// That of a skeleton alone, without its armature.
void visit_skeleton(Archive& archive, SkeletonRecord& record);

/// The digest that was put here last, empty if the model has changed since.
std::string& known_digest(WorldRecord& world);

} // namespace pydart2
