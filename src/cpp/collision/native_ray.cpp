#include "collision/native_ray.hpp"

#include <algorithm>
#include <cmath>

#include "collision/native_distance.hpp"
#include "collision/native_mesh.hpp"

namespace pydart2::native {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool sooner(double distance, const Vector& normal, RayHit& hit)
{
  if (!(distance < hit.distance))
    return false;
  hit = {distance, normal};
  return true;
}

/// The part of a ray that is in a solid, and the surface where it comes in.
struct Inside
{
  double from = -never, to = never;
  Vector normal = Vector::Zero();

  /// Keeps what is behind a plane: normal . x <= offset.
  void clip(const Ray& ray, const Vector& outwards, double offset)
  {
    const double speed = outwards.dot(ray.direction), ahead = offset - outwards.dot(ray.origin);
    if (speed == 0.0) {
      if (ahead < 0.0)
        to = -never;
    } else if (speed > 0.0) {
      to = std::min(to, ahead / speed);
    } else if (ahead / speed > from) {
      from = ahead / speed;
      normal = outwards;
    }
  }
  bool hit(RayHit& hit) const { return from <= to && from >= 0.0 && sooner(from, normal, hit); }
};

bool cast_plane(const Ray& ray, const Geometry& plane, RayHit& hit)
{
  Inside inside;
  inside.clip(ray, plane.normal, plane.offset);
  return inside.hit(hit);
}

bool cast_box(const Ray& ray, const Vector& half, RayHit& hit)
{
  double from = -never, to = never;
  int entered = 0;
  for (int i = 0; i < 3; ++i) {
    const double o = ray.origin[i], d = ray.direction[i], ahead = std::copysign(half[i], d);
    if (d == 0.0) {
      if (std::abs(o) > half[i])
        return false;
      continue;
    }
    if (const double enters = (-ahead - o) / d; enters > from) {
      from = enters;
      entered = i;
    }
    to = std::min(to, (ahead - o) / d);
  }
  return from <= to && from >= 0.0 && from < hit.distance
         && sooner(from, std::copysign(1.0, -ray.direction[entered]) * Vector::Unit(entered), hit);
}

bool cast_hull(const Ray& ray, const Hull& hull, RayHit& hit)
{
  Inside inside;
  for (std::size_t i = 0; i < hull.faces.size() && inside.from <= inside.to; ++i) {
    const Vector& normal = hull.normals[i];
    inside.clip(ray, normal, normal.dot(hull.corners[static_cast<std::size_t>(hull.faces[i][0])]));
  }
  return inside.hit(hit);
}

/// Where x in `origin + t direction` enters the ball of a radius about 0; from the nearest point, which keeps its digits far away.
double entry_of_ball(const Vector& origin, const Vector& direction, double radius)
{
  const double square = direction.squaredNorm(), nearest = -origin.dot(direction) / square;
  const double left = radius * radius - (origin + nearest * direction).squaredNorm();
  return left < 0.0 ? never : nearest - std::sqrt(left / square);
}

bool cast_ball(const Ray& ray, const Vector& center, double radius, RayHit& hit)
{
  const double distance = entry_of_ball(ray.origin - center, ray.direction, radius);
  return distance >= 0.0 && distance < hit.distance && sooner(distance, (ray.at(distance) - center) / radius, hit);
}

bool cast_ellipsoid(const Ray& ray, const Vector& half, RayHit& hit)
{
  const double distance = entry_of_ball(ray.origin.cwiseQuotient(half), ray.direction.cwiseQuotient(half), 1.0);
  if (!(distance >= 0.0 && distance < hit.distance))
    return false;
  return sooner(distance, ray.at(distance).cwiseQuotient(half.cwiseAbs2()).normalized(), hit);
}

/// Cylinders, cones: of the radius `middle - slope z` between the heights -half and half.
bool cast_turned(const Ray& ray, double half, double middle, double slope, RayHit& hit)
{
  Inside inside;
  inside.clip(ray, Vector::UnitZ(), half);
  inside.clip(ray, -Vector::UnitZ(), half);
  if (inside.from > inside.to)
    return false;
  // Outside of the mantle: a t² + 2 b t + c > 0, with t from the point nearest to the origin.
  const Vector& d = ray.direction;
  const double start = -ray.origin.dot(d);
  const Vector o = ray.at(start);
  const double radius = middle - slope * o.z(), growth = -slope * d.z();
  const double a = d.head<2>().squaredNorm() - growth * growth;
  const double b = o.head<2>().dot(d.head<2>()) - radius * growth;
  const double c = o.head<2>().squaredNorm() - radius * radius;
  const double from = inside.from - start, to = inside.to - start;
  if (std::isfinite(from) && (a * from + 2.0 * b) * from + c <= 0.0)
    return inside.hit(hit);
  const double root = b * b - a * c;
  if (root < 0.0)
    return false;
  const double q = -(b + std::copysign(std::sqrt(root), b));
  double first = a == 0.0 ? never : q / a, second = q == 0.0 ? never : c / q;
  if (first > second)
    std::swap(first, second);
  const double t = first >= from ? first : second;
  if (!(t >= from && t <= to && t + start >= 0.0 && t + start < hit.distance))
    return false;
  const Vector at = ray.at(t + start);
  const double across = at.head<2>().norm();
  return across > 0.0
         && sooner(t + start, Vector(at.x(), at.y(), slope * across).normalized(), hit);
}

bool cast_capsule(const Ray& ray, const Vector& half, double radius, RayHit& hit)
{
  const Vector nearest(0.0, 0.0, std::clamp(ray.origin.z(), -half.z(), half.z()));
  if ((ray.origin - nearest).squaredNorm() < radius * radius)
    return false;
  RayHit first; // the caps of the mantle lie within the balls
  cast_turned(ray, half.z(), radius, 0.0, first);
  cast_ball(ray, half, radius, first);
  cast_ball(ray, -half, radius, first);
  return sooner(first.distance, first.normal, hit);
}

/// Any convex shape, by its distance: the ray goes on as far as the plane that parts the two allows.
bool cast_convex(const Ray& ray, const Geometry& shape, RayHit& hit)
{
  Geometry point;
  point.form = Form::sphere;
  Pose pose = Pose::Identity();
  double distance = 0.0;
  for (int i = 0; i < 200; ++i) {
    Separation apart;
    pose.translation() = ray.at(distance);
    if (!separation(shape, point, pose, never, apart))
      return false;
    const double gap = apart.distance - shape.radius;
    const Vector outwards = -apart.normal;
    if (i == 0 && gap < 0.0)
      return false;
    if (gap <= 1e-12 * shape.size)
      return sooner(distance, outwards, hit);
    const double speed = -outwards.dot(ray.direction);
    if (speed <= 0.0 || distance + gap / speed >= hit.distance)
      return false;
    distance += gap / speed;
  }
  return false; // it grazes
}

bool cast_triangle(const Ray& ray, const std::array<Vector, 3>& at, const Vector& normal, RayHit& hit)
{
  // Signed volumes with the edges: equal for the two triangles at an edge, so that no ray slips through between them.
  const Vector a = at[0] - ray.origin, b = at[1] - ray.origin, c = at[2] - ray.origin;
  const double u = ray.direction.dot(b.cross(c)), v = ray.direction.dot(c.cross(a)), w = ray.direction.dot(a.cross(b));
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
    return false;
  const double speed = normal.dot(ray.direction);
  if (speed == 0.0)
    return false;
  const double distance = normal.dot(a) / speed;
  return distance >= 0.0 && sooner(distance, speed < 0.0 ? normal : Vector(-normal), hit);
}

bool cast_mesh(const Ray& ray, const TriangleMesh& mesh, RayHit& hit)
{
  bool any = false;
  const BoxRay box_ray(ray);
  mesh.tree.along([&](const Bounds& box) { return box_ray.entry(box); }, hit.distance, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    const auto& corners = mesh.triangles[i];
    const auto corner = [&](std::size_t k) -> const Vector& { return mesh.corners[static_cast<std::size_t>(corners[k])]; };
    any = cast_triangle(ray, {corner(0), corner(1), corner(2)}, mesh.normals[i], hit) || any;
  });
  return any;
}

} // namespace

bool cast(const Ray& ray, const Geometry& shape, RayHit& hit)
{
  const Vector& half = shape.half;
  switch (shape.form) {
  case Form::none:
    return false;
  case Form::plane:
    return cast_plane(ray, shape, hit);
  case Form::sphere:
    return cast_ball(ray, Vector::Zero(), shape.radius, hit);
  case Form::capsule:
    return cast_capsule(ray, half, shape.radius, hit);
  case Form::box:
    return cast_box(ray, half, hit);
  case Form::cylinder:
    return cast_turned(ray, half.z(), half.x(), 0.0, hit);
  case Form::cone:
    return cast_turned(ray, half.z(), half.x() / 2.0, half.x() / (2.0 * half.z()), hit);
  case Form::ellipsoid:
    return cast_ellipsoid(ray, half, hit);
  case Form::hull:
    return cast_hull(ray, *shape.hull, hit);
  case Form::triangle:
    return cast_triangle(ray, shape.triangle, shape.normal, hit);
  case Form::mesh:
    return cast_mesh(ray, *shape.mesh, hit);
  case Form::spheres:
    return cast_convex(ray, shape, hit);
  }
  return false;
}

} // namespace pydart2::native
