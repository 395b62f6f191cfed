#include "collision/native_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "collision/native_distance.hpp"
#include "collision/native_mesh.hpp"

namespace pydart2::native {

namespace {

constexpr double loose = 0.3; // sine of the angle up to which an edge or face lies on another face
constexpr double tight = 1e-3; // and up to which a direction is a face's own
constexpr int disc_on = 8, disc_under = 16; // corners of a disc that lies on a face, and that carries one
constexpr double rim = 1e-5; // of the size: how much deeper than its corners a disc may be without a point of its own

/// Two segments' points that are nearest to each other; segments may be points.
std::pair<Vector, Vector> nearest_points(const Feature& a, const Feature& b)
{
  const Vector u = a[a.count - 1] - a[0], v = b[b.count - 1] - b[0], w = a[0] - b[0];
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double square = uu * vv - uv * uv;
  double s = square > 1e-12 * uu * vv ? clamp((uv * vw - vv * uw) / square) : 0.5;
  if (uu == 0)
    s = 0;
  const double t = vv > 0 ? clamp((uv * s + vw) / vv) : 0;
  if (uu > 0)
    s = clamp((uv * t - uw) / uu);
  return {a[0] + s * u, b[0] + t * v};
}

Feature seen(const Geometry& shape, const Pose& pose, const Vector& direction, double slack, int corners)
{
  auto feature = feature_of(shape, pose.linear().transpose() * direction, slack, corners);
  feature.move(pose);
  return feature;
}

/// One point, from the places of the cores that touch.
void add_point(
    const Vector& on_a, const Vector& on_b, const Vector& normal, double radius_a, double radius_b, double margin,
    std::uint32_t code, Points& points)
{
  const double depth = radius_a + radius_b - normal.dot(on_a - on_b);
  if (depth >= -margin)
    points.push_back({(on_a - normal * radius_a + on_b + normal * radius_b) / 2.0, normal, depth, code});
}

/// Where two edges lie along each other: the ends of what they share.
bool add_parallel(
    const Feature& a, const Feature& b, const Vector& normal, double radius_a, double radius_b, double margin,
    Points& points)
{
  if (a.count != 2 || b.count != 2)
    return false;
  const Vector u = a[1] - a[0], v = b[1] - b[0];
  if (u.cross(v).norm() > 0.02 * u.norm() * v.norm())
    return false;
  const double from = u.dot(b[0] - a[0]) / u.squaredNorm(), to = u.dot(b[1] - a[0]) / u.squaredNorm();
  const double begin = std::max(0.0, std::min(from, to)), end = std::min(1.0, std::max(from, to));
  if (end - begin <= 1e-6)
    return false;
  for (const double s : {begin, end}) {
    const Vector on_b = b[0] + (s - from) / (to - from) * v;
    add_point(a[0] + s * u, on_b, normal, radius_a, radius_b, margin, s == begin ? 1 : 2, points);
  }
  return true;
}

/// Spheres and capsules.
void collide_round(const Geometry& a, const Geometry& b, const Pose& pose, double margin, Points& points)
{
  Feature core_a, core_b;
  for (const double side : {-1.0, 1.0}) {
    core_a.add({0.0, 0.0, side * a.half.z()});
    core_b.add(pose * Vector(0.0, 0.0, side * b.half.z()));
  }
  const auto [on_a, on_b] = nearest_points(core_a, core_b);
  const Vector apart = on_a - on_b;
  const double distance = apart.norm();
  if (distance > a.radius + b.radius + margin)
    return;
  Vector normal = Vector::UnitZ();
  if (distance > 1e-12 * (a.radius + b.radius)) {
    normal = apart / distance;
  } else { // the cores cross: any way out across both
    const Vector axis_b = core_b[1] - core_b[0];
    normal = Vector::UnitZ().cross(axis_b);
    normal = normal.norm() > 1e-12 * axis_b.norm() ? normal.normalized() : Vector::UnitX();
  }
  if (a.form == Form::capsule && b.form == Form::capsule
      && add_parallel(core_a, core_b, normal, a.radius, b.radius, margin, points))
    return;
  add_point(on_a, on_b, normal, a.radius, b.radius, margin, 0, points);
}

/// A box or its like whose face may carry another shape: the directions of its faces, in the frame of the first shape.
struct Faces
{
  int count = 0;
  std::array<Vector, 16> normals;
  void add(const Vector& normal) { normals[static_cast<std::size_t>(count++)] = normal; }
};

Faces faces_of(const Geometry& shape, const Pose& pose, const Vector& towards)
{
  Faces faces;
  const auto turn = pose.linear();
  const auto facing = [&](const Vector& axis) { faces.add(axis.dot(towards) < 0 ? Vector(-axis) : axis); };
  switch (shape.form) {
  case Form::box:
    for (int i = 0; i < 3; ++i)
      facing(turn.col(i));
    break;
  case Form::cylinder:
    facing(turn.col(2));
    break;
  case Form::cone:
    faces.add(-turn.col(2));
    break;
  case Form::triangle:
    facing(turn * shape.normal);
    break;
  case Form::hull:
    if (shape.hull->normals.size() <= faces.normals.size()) {
      for (const auto& normal : shape.hull->normals)
        faces.add(turn * normal);
    }
    break;
  default:
    break;
  }
  return faces;
}

/// What the two shapes look like to each other: a and b in the frame of a.
class Pair
{
public:
  Pair(const Geometry& a, const Geometry& b, const Pose& pose, double margin, Points& points)
    : a_(a), b_(b), pose_(pose), margin_(margin), points_(points), size_(std::min(a.size, b.size))
  {
  }

  void collide()
  {
    if (a_.form == Form::box && b_.form == Form::box)
      return collide_boxes();
    Best best;
    const Vector towards = pose_ * b_.center - a_.center;
    if (!try_faces(faces_of(a_, Pose::Identity(), towards), true, best)
        || !try_faces(faces_of(b_, pose_, -towards), false, best))
      return;
    if (best.depth > 0.1 * size_ || !add_face(best.normal, best.of_a, best.depth)) {
      Separation apart;
      if (separation(a_, b_, pose_, a_.radius + b_.radius + margin_, apart))
        add(apart);
    }
  }

private:
  struct Best
  {
    double depth = std::numeric_limits<double>::infinity();
    Vector normal = Vector::UnitZ(); ///< Of the face, outwards.
    bool of_a = true;
  };

  double top_of_a(const Vector& direction) const { return direction.dot(support(a_, direction)) + a_.radius; }
  double top_of_b(const Vector& direction) const
  {
    return direction.dot(pose_ * support(b_, pose_.linear().transpose() * direction)) + b_.radius;
  }

  /// How deep the shapes are in each other along a face's normal; false if they are apart there.
  bool try_faces(const Faces& faces, bool of_a, Best& best) const
  {
    for (int i = 0; i < faces.count; ++i) {
      const Vector& normal = faces.normals[static_cast<std::size_t>(i)];
      const double depth = of_a ? top_of_a(normal) + top_of_b(-normal) : top_of_b(normal) + top_of_a(-normal);
      if (depth < -margin_)
        return false;
      if (depth < best.depth - 1e-9 * size_)
        best = {depth, normal, of_a};
    }
    return true;
  }

  /// The points on a face, if what lies deepest is over the face itself.
  bool add_face(const Vector& normal, bool of_a, double depth)
  {
    if (!std::isfinite(depth))
      return false;
    const auto begin = points_.size();
    add_on_face(normal, of_a);
    for (auto i = begin; i < points_.size(); ++i)
      if (points_[i].depth >= depth - rim * size_) {
        keep_four(points_, begin, size_);
        return true;
      }
    points_.resize(begin);
    return false;
  }

  void add_on_face(const Vector& normal, bool of_a)
  {
    const Feature face = of_a ? seen(a_, Pose::Identity(), normal, tight, disc_under) : seen(b_, pose_, normal, tight, disc_under);
    const Vector down = -normal;
    const Feature other = of_a ? seen(b_, pose_, down, loose, disc_on) : seen(a_, Pose::Identity(), down, loose, disc_on);
    const double radius = of_a ? a_.radius : b_.radius, other_radius = of_a ? b_.radius : a_.radius;
    const double sign = of_a ? -1.0 : 1.0;
    if (!face.face)
      return;
    add_clipped(face, radius, other, other_radius, sign, margin_, points_);
    if (!other.round)
      return;
    const Vector lowest = of_a ? Vector(pose_ * support(b_, pose_.linear().transpose() * down)) : support(a_, down);
    const double depth = normal.dot(face[0] - lowest);
    double deepest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < other.count; ++i)
      deepest = std::max(deepest, normal.dot(face[0] - other[i]));
    if (depth > deepest + rim * size_ && depth >= -margin_ && holds(face, lowest, 0.0))
      points_.push_back({lowest + normal * (depth / 2.0), sign * normal, depth, other.code << 12 | 0xfffU});
  }

  /// Boxes have fifteen directions in which they may be apart: of their faces, and across an edge of each (Gottschalk, Lin
  /// and Manocha, "OBBTree", SIGGRAPH 1996, section 5).
  void collide_boxes()
  {
    const Eigen::Matrix3d turn = pose_.linear(), size = turn.cwiseAbs();
    const Vector &half_a = a_.half, &half_b = b_.half, &apart = pose_.translation();
    const Vector apart_in_b = turn.transpose() * apart;
    const Vector of_a = half_a + size * half_b - apart.cwiseAbs();
    const Vector of_b = half_b + size.transpose() * half_a - apart_in_b.cwiseAbs();
    if (std::min(of_a.minCoeff(), of_b.minCoeff()) < -margin_)
      return;
    Best face;
    for (int i = 0; i < 3; ++i)
      if (of_a[i] < face.depth - 1e-9 * size_)
        face = {of_a[i], (apart[i] < 0 ? -1.0 : 1.0) * Vector::Unit(i), true};
    for (int i = 0; i < 3; ++i)
      if (of_b[i] < face.depth - 1e-9 * size_)
        face = {of_b[i], (apart_in_b[i] > 0 ? -1.0 : 1.0) * turn.col(i), false};
    double least = face.depth - 1e-3 * std::abs(face.depth) - 1e-6 * size_; // faces carry better than edges
    Vector normal = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const double along = apart[i2] * turn(i1, j) - apart[i1] * turn(i2, j); // of the axes' product, not yet of length 1
        const double most = half_a[i1] * size(i2, j) + half_a[i2] * size(i1, j) + half_b[j1] * size(i, j2)
                            + half_b[j2] * size(i, j1);
        const double scaled = most - std::abs(along);
        if (scaled >= 0.0 && scaled >= least)
          continue;
        const double length = std::hypot(turn(i1, j), turn(i2, j));
        if (length < 1e-4)
          continue;
        const double depth = scaled / length;
        if (depth < -margin_)
          return;
        if (depth < least) {
          least = depth;
          normal = Vector::Unit(i).cross(turn.col(j)) / (along < 0 ? -length : length);
        }
      }
    const auto begin = points_.size();
    if (normal.isZero()) {
      add_on_face(face.normal, face.of_a);
      keep_four(points_, begin, size_);
      return;
    }
    const Vector up = -normal;
    const Feature edge_a = seen(a_, Pose::Identity(), normal, 1e-5, 0), edge_b = seen(b_, pose_, up, 1e-5, 0);
    const auto [on_a, on_b] = nearest_points(edge_a, edge_b);
    add_point(on_a, on_b, up, 0.0, 0.0, margin_, 1 + edge_a.code * 27 + edge_b.code, points_);
  }

  /// The points of shapes whose cores lie so.
  void add(const Separation& apart)
  {
    const Vector down = -apart.normal;
    const Feature of_a = seen(a_, Pose::Identity(), down, tight, disc_under), of_b = seen(b_, pose_, apart.normal, tight, disc_under);
    const double depth = a_.radius + b_.radius - apart.distance;
    if (of_a.face && add_face(of_a.normal, true, depth))
      return;
    if (of_b.face && add_face(of_b.normal, false, depth))
      return;
    if (!add_parallel(of_a, of_b, apart.normal, a_.radius, b_.radius, margin_, points_))
      add_point(
          apart.on_a, apart.on_b, apart.normal, a_.radius, b_.radius, margin_, 3 + of_a.code * 1024 + of_b.code, points_);
  }

  const Geometry& a_;
  const Geometry& b_;
  const Pose& pose_;
  double margin_;
  Points& points_;
  double size_;
};

/// A plane and what is above it.
void collide_plane(const Geometry& plane, const Geometry& b, const Pose& pose, double margin, Points& points)
{
  const Vector down = pose.linear().transpose() * -plane.normal;
  const Vector lowest = pose * support(b, down);
  const double depth = plane.offset + b.radius - plane.normal.dot(lowest);
  if (depth < -margin)
    return;
  const auto begin = points.size();
  Feature feature = feature_of(b, down, loose, disc_on);
  feature.move(pose);
  add_below(plane.normal, plane.offset, feature, b.radius, -1.0, margin, points);
  double deepest = -std::numeric_limits<double>::infinity();
  for (auto i = begin; i < points.size(); ++i)
    deepest = std::max(deepest, points[i].depth);
  if (depth > deepest + rim * b.size) // between the corners of a disc's rim
    points.push_back({lowest + plane.normal * (depth / 2.0 - b.radius), -plane.normal, depth, 0xfffU});
  keep_four(points, begin, b.size);
}

} // namespace

void collide_convex(const Geometry& a, const Geometry& b, const Pose& b_in_a, double margin, Points& points)
{
  const auto round = [](const Geometry& shape) { return shape.form == Form::sphere || shape.form == Form::capsule; };
  if (round(a) && round(b))
    return collide_round(a, b, b_in_a, margin, points);
  Pair(a, b, b_in_a, margin, points).collide();
}

void collide(const Geometry& a, const Geometry& b, const Pose& b_in_a, double margin, Points& points)
{
  if (a.form == Form::none || b.form == Form::none || (a.form == Form::plane && b.form == Form::plane))
    return;
  if (a.form > b.form) { // one order of forms is enough
    const auto begin = points.size();
    collide(b, a, b_in_a.inverse(Eigen::Isometry), margin, points);
    for (auto i = begin; i < points.size(); ++i) {
      points[i].at = b_in_a * points[i].at;
      points[i].normal = -(b_in_a.linear() * points[i].normal);
    }
    return;
  }
  if (b.form == Form::mesh)
    return collide_mesh(a, b, b_in_a, margin, points);
  if (a.form == Form::plane)
    return collide_plane(a, b, b_in_a, margin, points);
  collide_convex(a, b, b_in_a, margin, points);
}

} // namespace pydart2::native
