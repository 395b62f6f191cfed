#include "handles/soft_body.hpp"

#include <dart/dynamics/PointMass.hpp>

#include "base/checks.hpp"

namespace pydart2 {

using dart::dynamics::PointMass;

SoftBodyHandle::SoftBodyHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::SoftBodyNode* body)
  : body_(std::move(world), std::move(skeleton), body)
{
}

template <class Read>
void SoftBodyHandle::each_point(Output& out, Read read) const
{
  const auto& points = body_->getPointMasses();
  auto rows = matrix(out, static_cast<long>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<long>(i)) = read(*points[i]).transpose();
}

template <class Write>
void SoftBodyHandle::set_each_point(const MatrixIn& rows, const char* what, Write write)
{
  const auto& points = body_->getPointMasses();
  check::shape(rows, points.size(), 3, what);
  check::finite(VectorIn{rows.data, rows.rows * rows.cols}, what);
  for (std::size_t i = 0; i < points.size(); ++i)
    write(*points[i], Eigen::Vector3d(rows.data + 3 * i));
}

int SoftBodyHandle::num_points() const
{
  return static_cast<int>(body_->getNumPointMasses());
}

void SoftBodyHandle::point_masses(Output& out) const
{
  const auto& points = body_->getPointMasses();
  double* mass = out.vector(static_cast<long>(points.size()));
  for (const auto* point : points)
    *mass++ = point->getMass();
}

void SoftBodyHandle::point_displacements(Output& out) const
{
  each_point(out, [](const PointMass& point) { return point.getPositions(); });
}

void SoftBodyHandle::set_point_displacements(const MatrixIn& displacements)
{
  set_each_point(displacements, "displacements", [](PointMass& point, const auto& value) { point.setPositions(value); });
}

void SoftBodyHandle::point_velocities(Output& out) const
{
  each_point(out, [](const PointMass& point) { return point.getVelocities(); });
}

void SoftBodyHandle::set_point_velocities(const MatrixIn& velocities)
{
  set_each_point(velocities, "velocities", [](PointMass& point, const auto& value) { point.setVelocities(value); });
}

void SoftBodyHandle::point_rest_positions(Output& out) const
{
  each_point(out, [](const PointMass& point) { return point.getRestingPosition(); });
}

void SoftBodyHandle::point_local_positions(Output& out) const
{
  each_point(out, [](const PointMass& point) { return point.getLocalPosition(); });
}

void SoftBodyHandle::point_world_positions(Output& out) const
{
  each_point(out, [](const PointMass& point) { return point.getWorldPosition(); });
}

void SoftBodyHandle::add_point_forces(const MatrixIn& forces)
{
  set_each_point(forces, "forces", [](PointMass& point, const auto& force) { point.addExtForce(force); });
}

void SoftBodyHandle::faces(Output& out) const
{
  auto rows = matrix(out, static_cast<long>(body_->getNumFaces()), 3);
  for (std::size_t i = 0; i < body_->getNumFaces(); ++i)
    rows.row(static_cast<long>(i)) = body_->getFace(i).cast<double>().transpose();
}

double SoftBodyHandle::vertex_stiffness() const
{
  return body_->getVertexSpringStiffness();
}

void SoftBodyHandle::set_vertex_stiffness(double stiffness)
{
  check::not_negative(stiffness, "vertex stiffness");
  body_->setVertexSpringStiffness(stiffness);
}

double SoftBodyHandle::edge_stiffness() const
{
  return body_->getEdgeSpringStiffness();
}

void SoftBodyHandle::set_edge_stiffness(double stiffness)
{
  check::not_negative(stiffness, "edge stiffness");
  body_->setEdgeSpringStiffness(stiffness);
}

double SoftBodyHandle::damping_coefficient() const
{
  return body_->getDampingCoefficient();
}

void SoftBodyHandle::set_damping_coefficient(double coefficient)
{
  check::not_negative(coefficient, "damping coefficient");
  body_->setDampingCoefficient(coefficient);
}

} // namespace pydart2
