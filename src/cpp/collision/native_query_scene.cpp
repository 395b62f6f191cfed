#include "collision/native_query_scene.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "collision/native_pairs.hpp"

namespace pydart2::native {

const Geometry& QueryScene::geometry(const dart::dynamics::ConstShapePtr& shape)
{
  auto& made = made_[shape.get()];
  if (!made.shape || made.version != shape->getVersion())
    made = {shape, shape->getVersion(), geometry_of(*shape)};
  return made.geometry;
}

void QueryScene::set(const std::vector<const dart::dynamics::ShapeNode*>& shapes)
{
  items_.assign(shapes.size(), {});
  unbounded_.clear();
  std::vector<Bounds> boxes(shapes.size());
  std::vector<int> leaves;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& made = geometry(shapes[i]->getShape());
    if (made.form == Form::none)
      continue;
    const Pose& pose = shapes[i]->getWorldTransform();
    items_[i] = {&made, pose, pose.inverse(Eigen::Isometry), {}};
    if (made.form == Form::plane) {
      unbounded_.push_back(static_cast<int>(i));
    } else {
      boxes[i] = items_[i].bounds = bounds_of(made, pose);
      if (!boxes[i].is_finite())
        throw Error(Kind::engine, "the position of shape '" + shapes[i]->getName() + "' is not finite");
      leaves.push_back(static_cast<int>(i));
    }
  }
  tree_.build(boxes, leaves);
  for (auto it = made_.begin(); it != made_.end();) // what only we still keep
    it = it->second.shape.use_count() == 1 ? made_.erase(it) : std::next(it);
}

void QueryScene::cast_at(int index, const Ray& ray, RayHit& hit, int& which) const
{
  const auto& to_shape = item(index).to_shape;
  if (!native::cast({to_shape * ray.origin, to_shape.linear() * ray.direction}, *item(index).geometry, hit))
    return;
  hit.normal = to_shape.linear().transpose() * hit.normal;
  which = index;
}

int QueryScene::cast(const Ray& ray, RayHit& hit) const
{
  int which = -1;
  for (const int index : unbounded_)
    cast_at(index, ray, hit, which);
  const BoxRay box_ray(ray);
  tree_.along(
      [&](const Bounds& box) { return box_ray.entry(box); }, hit.distance,
      [&](int index) { cast_at(index, ray, hit, which); });
  return which;
}

int QueryScene::nearest(const Vector& point, Clearance& found) const
{
  Geometry dot;
  dot.form = Form::sphere;
  const Bounds place{point, point};
  int which = -1;
  const auto look = [&](int index) {
    const auto& [geometry, pose, to_shape, bounds] = item(index);
    Clearance here;
    if (native::clearance(*geometry, dot, Pose(Eigen::Translation3d(to_shape * point)), found.distance, here)
        && (which < 0 || here.distance < found.distance)) {
      found = moved(pose, here);
      which = index;
    }
    return found.distance;
  };
  for (const int index : unbounded_)
    look(index);
  // Of boxes that the point is in any may be the nearest, so all of these are looked at.
  const auto least = [&](const Bounds& box) {
    const double apart = box.distance(place);
    return apart > 0.0 ? apart : -std::numeric_limits<double>::infinity();
  };
  tree_.nearest(found.distance, least, look);
  return which;
}

bool QueryScene::clearance(int a, int b, double most, Clearance& found) const
{
  const auto &first = item(a), &second = item(b);
  if (!native::clearance(*first.geometry, *second.geometry, first.to_shape * second.pose, most, found))
    return false;
  found = moved(first.pose, found);
  return true;
}

void QueryScene::collide(int a, int b, Points& points) const
{
  const auto &first = item(a), &second = item(b);
  const auto begin = points.size();
  native::collide(*first.geometry, *second.geometry, first.to_shape * second.pose, 0.0, points);
  for (auto i = begin; i < points.size(); ++i) {
    points[i].at = first.pose * points[i].at;
    points[i].normal = first.pose.linear() * points[i].normal;
  }
}

double QueryScene::least_distance(int a, int b) const
{
  const auto &first = item(a), &second = item(b);
  if (first.geometry == nullptr || second.geometry == nullptr)
    return std::numeric_limits<double>::infinity();
  if (first.geometry->form == Form::plane || second.geometry->form == Form::plane)
    return -std::numeric_limits<double>::infinity();
  return first.bounds.overlaps(second.bounds) ? -std::numeric_limits<double>::infinity()
                                              : first.bounds.distance(second.bounds);
}

} // namespace pydart2::native
