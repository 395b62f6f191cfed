#include "collision/native_geometry.hpp"
#include "collision/native_mesh.hpp"

#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/MultiSphereConvexHullShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

namespace pydart2::native {

using namespace dart::dynamics;

namespace {

std::shared_ptr<const Hull> pyramid(double x, double y, double z)
{
  auto hull = std::make_shared<Hull>();
  hull->corners = {{-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z}, {0.0, 0.0, z}};
  hull->faces = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (const auto& face : hull->faces) {
    const auto corner = [&](std::size_t i) -> const Vector& { return hull->corners[static_cast<std::size_t>(face[i])]; };
    hull->normals.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized());
  }
  return hull;
}

std::shared_ptr<const Hull> spheres(const MultiSphereConvexHullShape& shape)
{
  auto hull = std::make_shared<Hull>();
  for (const auto& [radius, center] : shape.getSpheres()) {
    hull->corners.push_back(center);
    hull->radii.push_back(radius);
  }
  return hull;
}

Vector support(const Hull& hull, const Vector& direction)
{
  std::size_t best = 0;
  double most = hull.corners[0].dot(direction);
  for (std::size_t i = 1; i < hull.corners.size(); ++i)
    if (const double value = hull.corners[i].dot(direction); value > most) {
      most = value;
      best = i;
    }
  return hull.corners[best];
}

Vector support_of_spheres(const Hull& hull, const Vector& direction)
{
  const double length = direction.norm();
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.corners.size(); ++i)
    if (const double value = hull.corners[i].dot(direction) + length * hull.radii[i]; value > most) {
      most = value;
      best = i;
    }
  return hull.corners[best] + direction * (hull.radii[best] / std::max(length, 1e-300));
}

/// The rim point of a disc of radius `half.x()` at height z.
Vector rim(const Vector& half, const Vector& direction, double z)
{
  const double across = direction.head<2>().norm();
  if (across <= 1e-300)
    return {half.x(), 0.0, z};
  return {half.x() * direction.x() / across, half.x() * direction.y() / across, z};
}

Geometry solid(Form form, const Vector& half, double radius = 0.0)
{
  Geometry made;
  made.form = form;
  made.half = half;
  made.radius = radius;
  made.size = 2.0 * (half.minCoeff() + radius);
  return made;
}

} // namespace

Geometry geometry_of(const Shape& shape)
{
  if (const auto* box = dynamic_cast<const BoxShape*>(&shape))
    return solid(Form::box, box->getSize() / 2.0);
  if (const auto* sphere = dynamic_cast<const SphereShape*>(&shape))
    return solid(Form::sphere, Vector::Zero(), sphere->getRadius());
  if (const auto* capsule = dynamic_cast<const CapsuleShape*>(&shape))
    return solid(Form::capsule, {0.0, 0.0, capsule->getHeight() / 2.0}, capsule->getRadius());
  if (const auto* cylinder = dynamic_cast<const CylinderShape*>(&shape))
    return solid(Form::cylinder, {cylinder->getRadius(), cylinder->getRadius(), cylinder->getHeight() / 2.0});
  if (const auto* cone = dynamic_cast<const ConeShape*>(&shape))
    return solid(Form::cone, {cone->getRadius(), cone->getRadius(), cone->getHeight() / 2.0});
  if (const auto* ellipsoid = dynamic_cast<const EllipsoidShape*>(&shape))
    return solid(Form::ellipsoid, ellipsoid->getRadii());
  Geometry made;
  if (const auto* plane = dynamic_cast<const PlaneShape*>(&shape)) {
    made.form = Form::plane;
    made.normal = plane->getNormal();
    made.offset = plane->getOffset();
    made.size = std::numeric_limits<double>::infinity();
  } else if (const auto* corners = dynamic_cast<const PyramidShape*>(&shape)) {
    const Vector half(corners->getBaseWidth() / 2.0, corners->getBaseDepth() / 2.0, corners->getHeight() / 2.0);
    made = solid(Form::hull, half);
    made.hull = pyramid(half.x(), half.y(), half.z());
  } else if (const auto* balls = dynamic_cast<const MultiSphereConvexHullShape*>(&shape)) {
    made = solid(Form::spheres, Vector::Zero());
    made.hull = spheres(*balls);
    made.size = 2.0 * *std::min_element(made.hull->radii.begin(), made.hull->radii.end());
  } else {
    made = mesh_geometry(shape);
  }
  return made;
}

Vector support(const Geometry& shape, const Vector& d)
{
  const Vector& half = shape.half;
  switch (shape.form) {
  case Form::box:
    return {d.x() < 0 ? -half.x() : half.x(), d.y() < 0 ? -half.y() : half.y(), d.z() < 0 ? -half.z() : half.z()};
  case Form::capsule:
    return {0.0, 0.0, d.z() < 0 ? -half.z() : half.z()};
  case Form::cylinder:
    return rim(half, d, d.z() < 0 ? -half.z() : half.z());
  case Form::cone:
    if (2.0 * half.z() * d.z() >= half.x() * d.head<2>().norm())
      return {0.0, 0.0, half.z()};
    return rim(half, d, -half.z());
  case Form::ellipsoid: {
    const Vector scaled = half.cwiseProduct(d);
    return half.cwiseProduct(scaled) / std::max(scaled.norm(), 1e-300);
  }
  case Form::spheres:
    return support_of_spheres(*shape.hull, d);
  case Form::hull:
    return support(*shape.hull, d);
  case Form::triangle: {
    const double a = d.dot(shape.triangle[0]), b = d.dot(shape.triangle[1]), c = d.dot(shape.triangle[2]);
    return shape.triangle[a >= b ? (a >= c ? 0 : 2) : (b >= c ? 1 : 2)];
  }
  default:
    return Vector::Zero();
  }
}

Bounds bounds_of(const Geometry& shape, const Pose& pose)
{
  const auto turn = pose.linear();
  Vector low, high;
  if (shape.form == Form::box || shape.form == Form::mesh) {
    const Vector center = turn * shape.center, half = turn.cwiseAbs() * shape.half;
    low = center - half;
    high = center + half;
  } else {
    for (int i = 0; i < 3; ++i) {
      const Vector axis = turn.row(i).transpose();
      high[i] = axis.dot(support(shape, axis)) + shape.radius;
      low[i] = axis.dot(support(shape, -axis)) - shape.radius;
    }
  }
  return {pose.translation() + low, pose.translation() + high};
}

} // namespace pydart2::native
