#include "handles/queries.hpp"

#include <cmath>
#include <limits>

#include "base/checks.hpp"
#include "base/errors.hpp"

namespace pydart2 {

namespace {

struct Place
{
  double skeleton, body, shape;
};

native::Ray ray_of(const double* origin, const double* direction)
{
  const Eigen::Map<const Eigen::Vector3d> along(direction);
  check::direction(along, "the direction of a ray");
  return {Eigen::Map<const Eigen::Vector3d>(origin), along.stableNormalized()};
}

} // namespace

QueriesHandle::QueriesHandle(const WorldHandle& world) : world_(world.ref()) {}

void QueriesHandle::raycast(const MatrixIn& origins, const MatrixIn& directions, double max_distance, Output& out)
{
  world_->check();
  check::shape(origins, static_cast<std::size_t>(origins.rows), 3, "the origins");
  check::shape(directions, static_cast<std::size_t>(origins.rows), 3, "the directions");
  check::finite(VectorIn{origins.data, 3 * origins.rows}, "the origins");
  if (!(max_distance >= 0.0))
    throw Error(Kind::value, "the longest distance of a ray is >= 0, got " + std::to_string(max_distance));
  std::vector<native::Ray> cast;
  for (long i = 0; i < origins.rows; ++i)
    cast.push_back(ray_of(origins.data + 3 * i, directions.data + 3 * i));
  std::vector<const dart::dynamics::ShapeNode*> shapes;
  std::vector<Place> places;
  for (std::size_t s = 0; s < world_->skeletons.size(); ++s) {
    const auto& skeleton = *world_->skeletons[s]->skeleton;
    for (std::size_t b = 0; b < skeleton.getNumBodyNodes(); ++b) {
      const auto* body = skeleton.getBodyNode(b);
      for (std::size_t i = 0; i < body->getNumShapeNodes(); ++i)
        if (const auto* node = body->getShapeNode(i); node->getCollisionAspect() != nullptr && node->getShape() != nullptr) {
          shapes.push_back(node);
          places.push_back({double(s), double(b), double(i)});
        }
    }
  }
  rays_.set(shapes);
  auto rows = matrix(out, origins.rows, 10);
  for (long i = 0; i < origins.rows; ++i) {
    const auto& ray = cast[static_cast<std::size_t>(i)];
    native::RayHit hit;
    hit.distance = std::nextafter(max_distance, std::numeric_limits<double>::infinity());
    const int which = rays_.cast(ray, hit);
    if (which < 0) {
      rows.row(i) << std::numeric_limits<double>::infinity(), Eigen::RowVectorXd::Constant(6, std::nan("")), -1.0, -1.0, -1.0;
      continue;
    }
    const auto& place = places[static_cast<std::size_t>(which)];
    rows.row(i) << hit.distance, ray.at(hit.distance).transpose(), hit.normal.transpose(), place.skeleton, place.body, place.shape;
  }
}

} // namespace pydart2
