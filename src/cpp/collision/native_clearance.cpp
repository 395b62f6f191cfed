#include "collision/native_clearance.hpp"

#include <algorithm>
#include <limits>

#include "collision/native_distance.hpp"
#include "collision/native_mesh.hpp"

namespace pydart2::native {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Between the first shape and the plane, in the frame of the first.
bool to_plane(const Geometry& a, const Vector& normal, double offset, double most, Clearance& out)
{
  Vector lowest = Vector::Zero();
  if (a.form == Form::mesh) {
    double least = infinity;
    for (const auto& corner : a.mesh->corners)
      if (const double height = normal.dot(corner); height < least) {
        least = height;
        lowest = corner;
      }
  } else {
    lowest = support(a, -normal) - a.radius * normal;
  }
  out.distance = normal.dot(lowest) - offset;
  out.normal = normal;
  out.on_a = lowest;
  out.on_b = lowest - out.distance * normal;
  return out.distance <= most;
}

bool of_convex(const Geometry& a, const Geometry& b, const Pose& pose, double most, Clearance& out)
{
  Separation cores;
  if (!separation(a, b, pose, most + a.radius + b.radius, cores))
    return false;
  out.distance = cores.distance - a.radius - b.radius;
  out.normal = cores.normal;
  out.on_a = cores.on_a - a.radius * cores.normal;
  out.on_b = cores.on_b + b.radius * cores.normal;
  return out.distance <= most;
}

/// Between a convex shape or mesh and the nearest triangle of a mesh, in the frame of the first.
bool to_mesh(const Geometry& a, const TriangleMesh& mesh, const Pose& pose, double most, Clearance& out)
{
  const Bounds around = bounds_of(a, pose.inverse(Eigen::Isometry)); // in the mesh's frame
  bool found = false;
  const auto look = [&](int triangle) {
    Clearance here;
    if (clearance(a, mesh.triangle(triangle), pose, most, here)) {
      here.distance = std::max(here.distance, 0.0); // the depth in one triangle is not that in the whole
      if (!found || here.distance < out.distance)
        out = here;
      found = true;
      most = out.distance;
    }
    return most;
  };
  mesh.tree.nearest(most, [&](const Bounds& box) { return box.distance(around); }, look);
  return found;
}

Clearance turned(const Clearance& other)
{
  return {other.distance, other.on_b, other.on_a, -other.normal};
}

} // namespace

Clearance moved(const Pose& pose, const Clearance& inside)
{
  return {inside.distance, pose * inside.on_a, pose * inside.on_b, pose.linear() * inside.normal};
}

bool clearance(const Geometry& a, const Geometry& b, const Pose& b_in_a, double most, Clearance& out)
{
  if (b.form == Form::plane) {
    const Vector normal = b_in_a.linear() * b.normal;
    return a.form != Form::plane && to_plane(a, normal, b.offset + normal.dot(b_in_a.translation()), most, out);
  }
  if (a.form != Form::plane && b.form == Form::mesh)
    return to_mesh(a, *b.mesh, b_in_a, most, out);
  if (a.form != Form::plane && a.form != Form::mesh)
    return of_convex(a, b, b_in_a, most, out);
  Clearance other;
  if (!clearance(b, a, b_in_a.inverse(Eigen::Isometry), most, other))
    return false;
  out = turned(moved(b_in_a, other));
  return true;
}

} // namespace pydart2::native
