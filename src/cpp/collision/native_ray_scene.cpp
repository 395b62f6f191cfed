#include "collision/native_ray_scene.hpp"

#include <algorithm>

namespace pydart2::native {

const Geometry& RayScene::geometry(const dart::dynamics::ConstShapePtr& shape)
{
  auto& made = made_[shape.get()];
  if (!made.shape || made.version != shape->getVersion())
    made = {shape, shape->getVersion(), geometry_of(*shape)};
  return made.geometry;
}

void RayScene::set(const std::vector<const dart::dynamics::ShapeNode*>& shapes)
{
  items_.clear();
  unbounded_.clear();
  std::vector<Bounds> boxes;
  std::vector<int> leaves;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& made = geometry(shapes[i]->getShape());
    if (made.form == Form::none)
      continue;
    const Pose& pose = shapes[i]->getWorldTransform();
    const int item = static_cast<int>(items_.size());
    (made.form == Form::plane ? unbounded_ : leaves).push_back(item);
    boxes.push_back(made.form == Form::plane ? Bounds{Vector::Zero(), Vector::Zero()} : bounds_of(made, pose));
    items_.push_back({static_cast<int>(i), &made, pose.inverse(Eigen::Isometry)});
  }
  tree_.build(boxes, leaves);
  for (auto it = made_.begin(); it != made_.end();) // what only we still keep
    it = it->second.shape.use_count() == 1 ? made_.erase(it) : std::next(it);
}

void RayScene::cast_at(std::size_t item, const Ray& ray, RayHit& hit, int& which) const
{
  const auto& [index, geometry, to_shape] = items_[item];
  if (!native::cast({to_shape * ray.origin, to_shape.linear() * ray.direction}, *geometry, hit))
    return;
  hit.normal = to_shape.linear().transpose() * hit.normal;
  which = index;
}

int RayScene::cast(const Ray& ray, RayHit& hit) const
{
  int which = -1;
  for (const int item : unbounded_)
    cast_at(static_cast<std::size_t>(item), ray, hit, which);
  // The nearest first: what lies behind a hit is not looked at.
  thread_local std::vector<std::pair<double, int>> kept;
  auto& near = kept; // finding it costs as much as a box
  near.clear();
  const Vector inverse = ray.direction.cwiseInverse();
  double at = 0.0;
  tree_.along(
      [&](const Bounds& box) { return (at = entry(ray, inverse, box)) <= hit.distance; },
      [&](int item) { near.emplace_back(at, item); });
  std::sort(near.begin(), near.end());
  for (const auto& [distance, item] : near) {
    if (distance > hit.distance)
      break;
    cast_at(static_cast<std::size_t>(item), ray, hit, which);
  }
  return which;
}

} // namespace pydart2::native
