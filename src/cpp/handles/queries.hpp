#pragma once

#include "collision/native_query_scene.hpp"
#include "handles/world.hpp"

namespace pydart2 {

/// Questions about the shapes of a world as they stand. They change nothing. Shapes are named by the indices of skeleton,
/// body and shape, bodies by those of skeleton and body, a row for each; -1 where there is none.
class QueriesHandle
{
public:
  explicit QueriesHandle(const WorldHandle& world);

  /// A row for each ray: distance (infinite for none), point, normal, shape. Rays pass through the bodies to `ignore`.
  void raycast(
      const MatrixIn& origins, const MatrixIn& directions, double max_distance, const MatrixIn& ignore, Output& out);

  /// A row for each point: distance (infinite for none), nearest point of a surface, normal, shape.
  void nearest(const MatrixIn& points, double max_distance, const MatrixIn& ignore, Output& out);

  /// A row for each two shapes of two sets of bodies that are no farther apart than `max_distance`, the nearest first:
  /// distance, points of both, normal from the second to the first, shapes.
  void distances(const MatrixIn& a, const MatrixIn& b, double max_distance, bool only_least, Output& out);

  /// The contacts of two sets of bodies, as rows of contacts without force.
  void contacts(const MatrixIn& a, const MatrixIn& b, Output& out);

private:
  struct Place
  {
    int skeleton, body, shape;
    const dart::dynamics::BodyNode* node;
  };
  using Pair = std::pair<int, int>;

  /// Takes the shapes as they stand, without those of some bodies.
  void look(const MatrixIn* ignore);

  /// Those of a set of bodies.
  std::vector<int> shapes_of(const MatrixIn& bodies) const;

  /// The pairs of shapes of two sets of bodies that may touch, each once, with what is not more than their distance.
  std::vector<std::pair<double, Pair>> pairs(const MatrixIn& a, const MatrixIn& b) const;

  WorldRef world_;
  native::QueryScene scene_;
  std::vector<Place> places_;
};

} // namespace pydart2
