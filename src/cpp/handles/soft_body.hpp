#pragma once

#include <dart/dynamics/SoftBodyNode.hpp>

#include "base/arrays.hpp"
#include "handles/part.hpp"

namespace pydart2 {

/// The skin of a dart::dynamics::SoftBodyNode: point masses on springs, and the triangles between them. One row a point.
class SoftBodyHandle
{
public:
  SoftBodyHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::SoftBodyNode* body);

  int num_points() const;
  void point_masses(Output& out) const;

  /// Displacements from rest and their rates, body axes.
  void point_displacements(Output& out) const;
  void set_point_displacements(const MatrixIn& displacements);
  void point_velocities(Output& out) const;
  void set_point_velocities(const MatrixIn& velocities);

  /// Where the points are at rest and now, body frame; and now in the world.
  void point_rest_positions(Output& out) const;
  void point_local_positions(Output& out) const;
  void point_world_positions(Output& out) const;

  /// Forces on the points in the next step, world axes, in addition to others.
  void add_point_forces(const MatrixIn& forces);

  /// Indices of the points of each triangle, as numbers.
  void faces(Output& out) const;

  double vertex_stiffness() const;
  void set_vertex_stiffness(double stiffness);
  double edge_stiffness() const;
  void set_edge_stiffness(double stiffness);
  double damping_coefficient() const;
  void set_damping_coefficient(double coefficient);

private:
  template <class Read>
  void each_point(Output& out, Read read) const;
  template <class Write>
  void set_each_point(const MatrixIn& rows, const char* what, Write write);

  Part<dart::dynamics::SoftBodyNode, dart::dynamics::BodyNodePtr> body_;
};

} // namespace pydart2
