#include "collision/native_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pydart2::native {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point of the Minkowski difference, and the points of the shapes that it comes from.
struct Corner
{
  Vector w, a, b;
};

class Difference
{
public:
  Difference(const Geometry& a, const Geometry& b, const Pose& b_in_a) : a_(a), b_(b), pose_(b_in_a) {}

  Corner support(const Vector& direction) const
  {
    const Vector a = native::support(a_, direction);
    const Vector b = pose_ * native::support(b_, -(pose_.linear().transpose() * direction));
    return {a - b, a, b};
  }

private:
  const Geometry& a_;
  const Geometry& b_;
  const Pose& pose_;
};

/// Up to four corners, and the weights that give the point of their hull that is nearest to the origin.
struct Simplex
{
  int count = 0;
  std::array<Corner, 4> corners;
  std::array<double, 4> weights{};

  Corner& operator[](int i) { return corners[static_cast<std::size_t>(i)]; }
  const Corner& operator[](int i) const { return corners[static_cast<std::size_t>(i)]; }
  double& weight(int i) { return weights[static_cast<std::size_t>(i)]; }

  Vector nearest() const
  {
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      sum += weights[i] * corners[i].w;
    return sum;
  }
};

/// The simplex of some corners of `from`, whose weights are settled.
Simplex keep(const Simplex& from, std::initializer_list<int> which, std::initializer_list<double> weights)
{
  Simplex made;
  for (const int i : which)
    made[made.count++] = from[i];
  std::copy(weights.begin(), weights.end(), made.weights.begin());
  return made;
}

Simplex nearest_of_segment(const Simplex& s, int i, int j)
{
  const Vector edge = s[j].w - s[i].w;
  const double along = -s[i].w.dot(edge), length = edge.squaredNorm();
  if (along <= 0)
    return keep(s, {i}, {1.0});
  if (along >= length)
    return keep(s, {j}, {1.0});
  return keep(s, {i, j}, {1.0 - along / length, along / length});
}

Simplex nearer(const Simplex& a, const Simplex& b)
{
  return b.nearest().squaredNorm() < a.nearest().squaredNorm() ? b : a;
}

Simplex nearest_of_triangle(const Simplex& s, int i, int j, int k)
{
  const Vector &a = s[i].w, &b = s[j].w, &c = s[k].w;
  const Vector normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  const double u = normal.dot(b.cross(c)), v = normal.dot(c.cross(a)), w = normal.dot(a.cross(b));
  if (area > 0 && u >= 0 && v >= 0 && w >= 0)
    return keep(s, {i, j, k}, {u / (u + v + w), v / (u + v + w), w / (u + v + w)});
  return nearer(nearer(nearest_of_segment(s, i, j), nearest_of_segment(s, j, k)), nearest_of_segment(s, k, i));
}

/// With all four corners if the origin is inside.
Simplex nearest_of_tetrahedron(const Simplex& s)
{
  constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
  Simplex best;
  double least = infinity;
  for (const auto& [i, j, k, opposite] : faces) {
    const Vector normal = (s[j].w - s[i].w).cross(s[k].w - s[i].w);
    const double inside = normal.dot(s[opposite].w - s[i].w), origin = -normal.dot(s[i].w);
    if (inside * origin > 0)
      continue;
    const Simplex candidate = nearest_of_triangle(s, i, j, k);
    if (const double distance = candidate.nearest().squaredNorm(); distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best.count > 0 ? best : s;
}

Simplex nearest(const Simplex& s)
{
  switch (s.count) {
  case 1:
    return keep(s, {0}, {1.0});
  case 2:
    return nearest_of_segment(s, 0, 1);
  case 3:
    return nearest_of_triangle(s, 0, 1, 2);
  default:
    return nearest_of_tetrahedron(s);
  }
}

enum class Found { apart, far, overlap };

/// Ends with the nearest points, or where they are too near to tell the direction between them.
Found gilbert(const Difference& difference, const Vector& start, double most, double tiny, Simplex& simplex)
{
  Vector v = start.squaredNorm() > 0 ? start : Vector(Vector::UnitX());
  double squared = infinity;
  for (int round = 0; round < 64; ++round) {
    const Corner corner = difference.support(-v);
    const double along = v.dot(corner.w), length = v.squaredNorm();
    if (along > 0 && along * along > most * most * length)
      return Found::far;
    if (simplex.count > 0 && length - along <= 1e-13 * length)
      return Found::apart;
    for (int i = 0; i < simplex.count; ++i)
      if (simplex[i].w == corner.w)
        return Found::apart;
    Simplex larger = simplex;
    larger[larger.count++] = corner;
    larger = nearest(larger);
    if (larger.count == 4) {
      simplex = larger;
      return Found::overlap;
    }
    const Vector next = larger.nearest();
    if (next.squaredNorm() >= squared)
      return Found::apart; // rounding: no nearer than before
    simplex = larger;
    v = next;
    squared = v.squaredNorm();
    if (squared <= tiny * tiny)
      return Found::overlap;
  }
  return Found::apart;
}

struct Facet
{
  std::array<int, 3> corners;
  Vector normal;
  double distance; ///< Of its plane from the origin; infinite where it has no area.
};

/// A polytope of corners of the difference that grows towards its surface where that is nearest to the origin.
class Polytope
{
public:
  Polytope(const Difference& difference, double size) : difference_(difference), size_(size)
  {
    corners_.clear();
    facets_.clear();
  }

  /// False where the difference is flat.
  bool begin(const Simplex& simplex)
  {
    for (int i = 0; i < simplex.count; ++i)
      corners_.push_back(simplex[i]);
    while (corners_.size() < 4)
      if (!add_across())
        return false;
    const auto w = [&](int i) -> const Vector& { return corners_[static_cast<std::size_t>(i)].w; };
    const bool mirrored = (w(1) - w(0)).cross(w(2) - w(0)).dot(w(3) - w(0)) > 0;
    for (const auto& face : {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 1}, std::array{1, 3, 2}})
      add_facet(face[0], face[mirrored ? 2 : 1], face[mirrored ? 1 : 2]);
    return true;
  }

  Separation grow()
  {
    Facet best = nearest();
    for (int round = 0; round < 128; ++round) {
      const Corner corner = difference_.support(best.normal);
      if (best.normal.dot(corner.w) - best.distance <= 1e-10 * size_ || !add(corner))
        break;
      best = nearest();
    }
    return read(best);
  }

  /// The direction across all corners, which lie in a plane.
  Vector across() const { return across_; }

private:
  /// One more corner, out of the point, line or plane that there is.
  bool add_across()
  {
    const auto& first = corners_[0].w;
    std::vector<Vector> directions;
    if (corners_.size() == 1) {
      directions = {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
    } else if (corners_.size() == 2) {
      const Vector line = (corners_[1].w - first).normalized();
      directions = {line.unitOrthogonal(), line.cross(line.unitOrthogonal())};
    } else {
      directions = {(corners_[1].w - first).cross(corners_[2].w - first).normalized()};
    }
    for (const auto& direction : directions) {
      across_ = direction;
      for (const double side : {1.0, -1.0}) {
        const Corner corner = difference_.support(side * direction);
        if (std::abs(direction.dot(corner.w - first)) > 1e-9 * size_) {
          corners_.push_back(corner);
          return true;
        }
      }
    }
    return false;
  }

  void add_facet(int i, int j, int k)
  {
    const auto w = [&](int n) -> const Vector& { return corners_[static_cast<std::size_t>(n)].w; };
    const Vector normal = (w(j) - w(i)).cross(w(k) - w(i));
    const double area = normal.norm();
    if (area <= 1e-14 * size_ * size_)
      facets_.push_back({{i, j, k}, Vector::Zero(), infinity});
    else
      facets_.push_back({{i, j, k}, normal / area, normal.dot(w(i)) / area});
  }

  static Facet nearest()
  {
    const auto less = [](const Facet& a, const Facet& b) { return a.distance < b.distance; };
    return *std::min_element(facets_.begin(), facets_.end(), less);
  }

  /// Takes away what the corner sees, and joins the rim to it; false if rounding leaves no rim.
  bool add(const Corner& corner)
  {
    edges_.clear();
    kept_.clear();
    for (const auto& facet : facets_) {
      if (facet.normal.dot(corner.w) - facet.distance <= 1e-13 * size_) {
        kept_.push_back(facet);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i)
        toggle(facet.corners[i], facet.corners[(i + 1) % 3]);
    }
    if (edges_.empty() || kept_.size() + edges_.size() > 512)
      return false;
    facets_.swap(kept_);
    const int index = static_cast<int>(corners_.size());
    corners_.push_back(corner);
    for (const auto& [from, to] : edges_)
      add_facet(from, to, index);
    return true;
  }

  /// An edge between two facets that go is none of the rim.
  void toggle(int from, int to)
  {
    const auto back = std::find(edges_.begin(), edges_.end(), std::pair(to, from));
    if (back == edges_.end()) {
      edges_.emplace_back(from, to);
    } else {
      *back = edges_.back();
      edges_.pop_back();
    }
  }

  Separation read(const Facet& facet) const
  {
    const auto corner = [&](std::size_t i) -> const Corner& { return corners_[static_cast<std::size_t>(facet.corners[i])]; };
    const Vector &a = corner(0).w, &b = corner(1).w, &c = corner(2).w;
    const Vector normal = (b - a).cross(c - a);
    const Vector foot = facet.normal * facet.distance;
    const double area = normal.squaredNorm();
    const double u = normal.dot((b - foot).cross(c - foot)) / area, v = normal.dot((c - foot).cross(a - foot)) / area;
    Separation out;
    out.normal = -facet.normal;
    out.distance = -facet.distance;
    out.on_a = u * corner(0).a + v * corner(1).a + (1.0 - u - v) * corner(2).a;
    out.on_b = u * corner(0).b + v * corner(1).b + (1.0 - u - v) * corner(2).b;
    return out;
  }

  const Difference& difference_;
  double size_;
  Vector across_ = Vector::UnitZ();

  // Empty between the uses: what is kept is memory only.
  static thread_local std::vector<Corner> corners_;
  static thread_local std::vector<Facet> facets_, kept_;
  static thread_local std::vector<std::pair<int, int>> edges_;
};

thread_local std::vector<Corner> Polytope::corners_;
thread_local std::vector<Facet> Polytope::facets_;
thread_local std::vector<Facet> Polytope::kept_;
thread_local std::vector<std::pair<int, int>> Polytope::edges_;

} // namespace

bool separation(const Geometry& a, const Geometry& b, const Pose& b_in_a, double most, Separation& out)
{
  const Difference difference(a, b, b_in_a);
  const Vector start = -b_in_a.translation();
  const Corner far = difference.support(start.squaredNorm() > 0 ? start : Vector(Vector::UnitX()));
  const double size = std::max({a.size, b.size, far.w.norm()});
  Simplex simplex;
  const Found found = gilbert(difference, start, most, 1e-7 * size, simplex);
  if (found == Found::far)
    return false;
  const auto read = [&](const Vector& normal, double distance) {
    out = {normal, distance, Vector::Zero(), Vector::Zero()};
    for (int i = 0; i < simplex.count; ++i) {
      out.on_a += simplex.weight(i) * simplex[i].a;
      out.on_b += simplex.weight(i) * simplex[i].b;
    }
  };
  if (found == Found::apart) {
    const Vector v = simplex.nearest();
    read(v.normalized(), v.norm());
    return out.distance <= most;
  }
  Polytope polytope(difference, size);
  if (polytope.begin(simplex))
    out = polytope.grow();
  else
    read(polytope.across(), 0.0);
  return out.distance <= most;
}

} // namespace pydart2::native
