// What a BodyNodeHandle adds to a body: shapes, markers, mass.
#include <cmath>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/SoftMeshShape.hpp>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "handles/bodynode.hpp"
#include "loading/built.hpp"
#include "state/clone.hpp"

namespace pydart2 {

using namespace dart::dynamics;

namespace {

using Tree = Part<BodyNode, BodyNodePtr>;

std::vector<double> copied(const double* data, long size)
{
  return {data, data + size};
}

void check_corners(const MatrixIn& vertices, const MatrixIn& triangles)
{
  check::shape(vertices, static_cast<std::size_t>(vertices.rows), 3, "vertices");
  check::shape(triangles, static_cast<std::size_t>(triangles.rows), 3, "triangles");
  check::finite(VectorIn{vertices.data, 3 * vertices.rows}, "vertices");
  if (vertices.rows < 3 || triangles.rows < 1)
    throw Error(Kind::value, "a mesh needs three vertices or more and a triangle or more");
  for (long i = 0; i < 3 * triangles.rows; ++i)
    if (const double corner = triangles.data[i]; corner != std::floor(corner) || corner < 0 || corner >= vertices.rows)
      throw Error(
          Kind::index,
          "triangles are of the indices 0 to " + std::to_string(vertices.rows - 1) + " of the vertices, got "
              + std::to_string(corner));
}

void check_sizes(const std::string& type, const VectorIn& sizes)
{
  check::finite(sizes, "sizes");
  if (type == "PlaneShape" && sizes.size == 4)
    return check::direction({sizes.data[0], sizes.data[1], sizes.data[2]}, "normal");
  for (long i = 0; i < sizes.size; ++i)
    if (type != "MultiSphereConvexHullShape" || i % 4 == 0)
      check::positive(sizes.data[i], "sizes");
}

int add(
    const Tree& tree, BodyNode& body, const ShapePtr& shape, const std::string& name, bool visible, bool collides)
{
  mark_built(*tree.world, *tree.skeleton);
  const int purposes = (visible ? built::visual : 0) | (collides ? built::collision | built::dynamics : 0);
  const std::string chosen = name.empty() ? body.getName() + "_shape" : name;
  built::add_shape(body, shape, chosen, purposes);
  return static_cast<int>(body.getNumShapeNodes()) - 1;
}

} // namespace

int BodyNodeHandle::add_shape(
    const std::string& type, const VectorIn& sizes, const std::string& name, bool visible, bool collides)
{
  auto& body = *body_;
  check_sizes(type, sizes);
  const auto shape = built::make_shape(type, copied(sizes.data, sizes.size));
  if (!shape)
    throw Error(Kind::value, "no shape '" + type + "' with " + std::to_string(sizes.size) + " sizes");
  return add(body_, body, shape, name, visible, collides);
}

int BodyNodeHandle::add_mesh(
    const MatrixIn& vertices, const MatrixIn& triangles, const std::string& name, bool visible, bool collides)
{
  auto& body = *body_;
  check_corners(vertices, triangles);
  const auto shape = built::make_mesh(copied(vertices.data, 3 * vertices.rows), copied(triangles.data, 3 * triangles.rows));
  return add(body_, body, shape, name, visible, collides);
}

int BodyNodeHandle::add_heightfield(
    const MatrixIn& heights, const Eigen::Vector3d& scale, const std::string& name, bool visible, bool collides)
{
  auto& body = *body_;
  if (heights.rows < 2 || heights.cols < 2)
    throw Error(Kind::value, "a field of heights needs two rows and two columns or more");
  check::finite(VectorIn{heights.data, heights.rows * heights.cols}, "heights");
  for (int i = 0; i < 3; ++i)
    check::positive(scale[i], "scale");
  return add(body_, body, built::make_heightfield(heights, scale), name, visible, collides);
}

void BodyNodeHandle::remove_shape(long index)
{
  auto& body = *body_;
  const auto i = check::index(index, body.getNumShapeNodes(), "shape node");
  if (body.getShapeNodes()[i]->getShape()->is<dart::dynamics::SoftMeshShape>())
    throw Error(Kind::value, "the skin of soft body '" + body.getName() + "' goes with the body: skel.remove_body()");
  mark_built(*body_.world, *body_.skeleton);
  const auto lock = lock_ode();
  auto& solver = *body_.world->world->getConstraintSolver();
  solver.clearLastCollisionResult(); // it points to the shape
  const NodeOwner owner(body.getShapeNodes()[i]);
  owner.remove();
  use_detector(solver, solver.getCollisionDetector());
}

int BodyNodeHandle::add_marker(const std::string& name, const Eigen::Vector3d& position)
{
  auto& body = *body_;
  check::finite(position, "position");
  mark_built(*body_.world, *body_.skeleton);
  body.createMarker(name, position);
  return static_cast<int>(body_.skeleton->skeleton->getNumMarkers()) - 1;
}

void BodyNodeHandle::add_mass(double mass, const Eigen::Vector3d& com, const Eigen::Matrix3d& inertia)
{
  auto& body = *body_;
  check::not_negative(mass, "mass");
  check::finite(com, "centre of mass");
  if (mass > 0.0)
    check::inertia(inertia, "inertia");
  const auto& old = body.getInertia();
  const double total = old.getMass() + mass;
  if (mass == 0.0)
    return;
  if (old.getMass() == 0.0)
    return body.setInertia(Inertia(mass, com, inertia));
  const Eigen::Vector3d centre = (old.getMass() * old.getLocalCOM() + mass * com) / total;
  const auto about_centre = [&](double m, const Eigen::Vector3d& at, const Eigen::Matrix3d& own) -> Eigen::Matrix3d {
    const Eigen::Vector3d d = at - centre;
    return own + m * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  };
  body.setInertia(Inertia(
      total, centre,
      about_centre(old.getMass(), old.getLocalCOM(), old.getMoment()) + about_centre(mass, com, inertia)));
}

} // namespace pydart2
