#include "collision/native_scene.hpp"

#include <algorithm>
#include <dart/dynamics/ShapeNode.hpp>

#include "base/errors.hpp"
#include "base/fetch.hpp"
#include "collision/native_pairs.hpp"
#include "engine/collision_filter.hpp"
#include "engine/tree_members.hpp"

namespace pydart2::native {

namespace {

/// How far apart shapes may be that touch in the next step.
double margin_of(const Geometry& geometry)
{
  return std::min(5e-4, 0.02 * geometry.size);
}

const Bounds nothing{Vector::Constant(1.0), Vector::Constant(-1.0)}; ///< Contains nothing.

} // namespace

Object::Object(dart::collision::CollisionDetector* detector, const dart::dynamics::ShapeFrame* frame)
  : CollisionObject(detector, frame)
{
  refresh();
}

void Object::refresh()
{
  geometry_ = geometry_of(*getShape());
}

void Scene::set_objects(const std::vector<Object*>& objects)
{
  items_.clear();
  watched_.clear();
  unbounded_.clear();
  pairs_.clear();
  built_ = all_placed_ = false;
  for (auto* object : objects) {
    if (object->geometry().form == Form::none)
      continue;
    const auto* node = object->getShapeFrame()->asShapeNode();
    const auto* body = node == nullptr ? nullptr : node->getBodyNodePtr().get();
    const auto* skeleton = body == nullptr ? nullptr : body->getSkeleton().get();
    const std::size_t place = body == nullptr ? 0 : body->getIndexInSkeleton();
    const bool bounded = object->geometry().form != Form::plane;
    if (!bounded)
      unbounded_.push_back(static_cast<int>(items_.size()));
    watched_.push_back(static_cast<int>(items_.size()));
    items_.push_back({object, body, body, skeleton, place, bounded, {}, false, Pose::Identity(), true, Pose::Identity(), {}, {}, false, false});
    items_.back().pose.translation().setConstant(std::numeric_limits<double>::quiet_NaN()); // equal to no pose
    items_.back().wide = nothing;
  }
}

void Scene::look_again(const PoseOf& pose_of)
{
  for (auto& item : items_) {
    if (item.body == nullptr)
      continue;
    item.placed = pose_of ? pose_of(item.body) : Placed();
    item.on_body = true;
    item.relative = item.object->getShapeFrame()->asShapeNode()->getRelativeTransform();
    item.collidable = item.body->isCollidable();
  }
}

void Scene::set_asleep(const std::unordered_set<const dart::dynamics::Skeleton*>& asleep)
{
  watched_.clear();
  for (std::size_t i = 0; i < items_.size(); ++i) {
    auto& item = items_[i];
    item.asleep = asleep.count(item.skeleton) > 0;
    if (!item.asleep)
      watched_.push_back(static_cast<int>(i));
  }
  all_placed_ = false;
  find_watched_pairs();
}

void Scene::find_watched_pairs()
{
  watched_pairs_.clear();
  if (watched_.size() == items_.size())
    return;
  const auto moves = [](const Item& item) {
    return !item.asleep && (item.skeleton == nullptr || (item.skeleton->isMobile() && item.skeleton->getNumDofs() > 0));
  };
  for (const auto& pair : pairs_) {
    const auto &a = item(pair.first), &b = item(pair.second);
    if ((!a.asleep && !b.asleep) || moves(a) || moves(b))
      watched_pairs_.push_back(pair);
  }
}

bool Scene::reordered() const
{
  return std::any_of(watched_.begin(), watched_.end(), [this](int index) {
    const Item& item = items_[static_cast<std::size_t>(index)];
    return item.body != nullptr && item.body->getIndexInSkeleton() != item.place;
  });
}

/// Looks where the shapes are; those that have left their wide boxes are escaped.
void Scene::place()
{
  escaped_.clear();
  if (!std::exchange(all_placed_, true)) {
    for (std::size_t i = 0; i < items_.size(); ++i)
      place(static_cast<int>(i));
  } else
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      fetch_ahead(i + 2);
      place(watched_[i]);
    }
}

/// What place() reads of the i-th that is watched.
void Scene::fetch_ahead(std::size_t i) const
{
  if (i >= watched_.size())
    return;
  const auto& item = items_[static_cast<std::size_t>(watched_[i])];
  const auto& geometry = item.object->geometry();
  fetch(geometry.form, geometry.center);
  if (item.frame != nullptr)
    fetch(item.frame->*engine::FrameMembers::transform, item.frame->*engine::FrameMembers::velocity);
}

void Scene::place(int index)
{
  auto& item = this->item(index);
  const auto body_pose = [&]() -> const Pose& {
    return item.placed.pose != nullptr ? *item.placed.pose : item.body->getWorldTransform();
  };
  const Pose pose = item.on_body ? body_pose() * item.relative : item.object->getShapeFrame()->getWorldTransform();
  const bool moved = item.pose.matrix() != pose.matrix();
  if (moved) {
    item.pose = pose;
    if (item.bounded)
      item.bounds = bounds_of(item.object->geometry(), pose);
  }
  look_at_motion(item);
  const double reach = margin_of(item.object->geometry()) + item.motion.norm() + item.turning;
  if (!item.bounded || (!moved && reach <= item.reach))
    return;
  item.reach = reach;
  if (!item.wide.contains({item.bounds.low.array() - reach, item.bounds.high.array() + reach})) {
    widen(item);
    escaped_.push_back(index);
  }
}

void Scene::look_at_motion(Item& item)
{
  if (time_step_ == 0.0 || item.body == nullptr || !item.bounded)
    return;
  const bool known = item.placed.pose != nullptr;
  const Pose& body = known ? *item.placed.pose : item.body->getWorldTransform();
  const auto of_body = [&](auto part) -> Vector { return body.linear() * part; };
  const Vector angular = known ? *item.placed.angular : of_body(item.body->getSpatialVelocity().head<3>());
  const Vector linear = known ? *item.placed.linear : of_body(item.body->getSpatialVelocity().tail<3>());
  item.motion = time_step_ * (linear + angular.cross(item.pose.translation() - body.translation()));
  const bool ball = item.object->geometry().form == Form::sphere;
  item.turning = ball ? 0.0 : time_step_ * angular.norm() * (item.bounds.high - item.bounds.low).norm();
}

void Scene::widen(Item& item)
{
  const double more = 0.1 * (item.bounds.high - item.bounds.low).norm() + item.reach;
  item.wide = {item.bounds.low.array() - more, item.bounds.high.array() + more};
  item.escaped = true;
}

/// The tree has no place for what is nowhere. Whoever looks once more finds all out of date.
void Scene::check_places()
{
  const auto nowhere = [this](int index) { return !item(index).wide.is_finite(); };
  const auto found = std::find_if(escaped_.begin(), escaped_.end(), nowhere);
  if (found == escaped_.end())
    return;
  for (auto& item : items_)
    item.wide = nothing;
  pairs_.clear();
  built_ = all_placed_ = false;
  const auto* body = item(*found).body;
  throw Error(Kind::engine, "the position of " + (body == nullptr ? "a shape" : "body '" + body->getName() + "'") + " is not finite");
}

void Scene::update_tree()
{
  if (built_ && !tree_.worn()) {
    for (const int index : escaped_)
      tree_.move(index, item(index).wide);
    return;
  }
  std::vector<Bounds> boxes(items_.size());
  std::vector<int> leaves;
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (items_[i].bounded) {
      boxes[i] = items_[i].wide;
      leaves.push_back(static_cast<int>(i));
    }
  tree_.build(boxes, leaves);
  built_ = true;
}

/// Brings the pairs whose wide boxes overlap up to date.
void Scene::update()
{
  place();
  if (escaped_.empty())
    return;
  check_places();
  update_tree();
  const auto stale = [&](const Pair& pair) { return item(pair.first).escaped || item(pair.second).escaped; };
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), stale), pairs_.end());
  new_pairs_.clear();
  for (const int index : escaped_)
    find_pairs_of(index);
  std::sort(new_pairs_.begin(), new_pairs_.end());
  const auto middle = static_cast<std::ptrdiff_t>(pairs_.size());
  pairs_.insert(pairs_.end(), new_pairs_.begin(), new_pairs_.end());
  std::inplace_merge(pairs_.begin(), pairs_.begin() + middle, pairs_.end());
  for (const int index : escaped_)
    item(index).escaped = false;
  find_watched_pairs();
}

void Scene::find_pairs_of(int index)
{
  const auto& mine = item(index);
  const auto add = [&](int other) {
    const auto& its = item(other);
    const bool twice = its.escaped && its.bounded && other <= index; // it finds this one too
    if (other != index && !twice && (mine.body == nullptr || mine.body != its.body))
      new_pairs_.emplace_back(std::min(index, other), std::max(index, other));
  };
  tree_.overlaps(mine.wide, add);
  for (const int plane : unbounded_)
    add(plane);
}

void Scene::find(const dart::collision::CollisionFilter* filter, double time_step, std::vector<Touch>& touches)
{
  time_step_ = time_step;
  update();
  const engine::PairFilter fast(filter);
  for (const auto& [first, second] : watched_.size() == items_.size() ? pairs_ : watched_pairs_) {
    auto &a = item(first), &b = item(second);
    if (a.skeleton == b.skeleton && a.skeleton != nullptr && fast.surely_ignores_within(*a.skeleton))
      continue;
    const double least = std::min(margin_of(a.object->geometry()), margin_of(b.object->geometry()));
    const double margin = time_step == 0.0 ? 0.0 : std::max(least, (a.motion - b.motion).norm() + a.turning + b.turning);
    if (a.bounded && b.bounded && !a.bounds.overlaps(b.bounds, margin))
      continue;
    const auto mobile = [](const Item& item) { return item.placed.pose != nullptr || item.skeleton->isMobile(); };
    const bool sure = a.body != nullptr && b.body != nullptr && a.skeleton != b.skeleton && a.collidable && b.collidable
                      && (mobile(a) || mobile(b)) && fast.surely_collide(*a.body, *b.body);
    if (sure || filter == nullptr || !filter->ignoresCollision(a.object, b.object))
      touch(a, b, margin, touches);
  }
}

void Scene::touch(Item& a, Item& b, double margin, std::vector<Touch>& touches)
{
  points_.clear();
  collide(a.object->geometry(), b.object->geometry(), a.pose.inverse(Eigen::Isometry) * b.pose, margin, points_);
  const double least = std::min(margin_of(a.object->geometry()), margin_of(b.object->geometry()));
  const Vector nearer = a.pose.linear().transpose() * (b.motion - a.motion);
  for (const auto& point : points_) {
    if (point.depth < -std::max(least, nearer.dot(point.normal) + a.turning + b.turning))
      continue;
    touches.push_back(
        {{a.pose * point.at, a.pose.linear() * point.normal, point.depth, a.object->getShapeFrame(),
          b.object->getShapeFrame(), point.feature},
         a.object, b.object, static_cast<int>(&a - items_.data()), static_cast<int>(&b - items_.data()), point.at});
  }
}

void Scene::find_between(Scene& other, const dart::collision::CollisionFilter* filter, std::vector<Touch>& touches)
{
  update();
  other.update();
  for (auto& a : items_)
    for (auto& b : other.items_)
      if ((!a.bounded || !b.bounded || a.bounds.overlaps(b.bounds))
          && (filter == nullptr || !filter->ignoresCollision(a.object, b.object)))
        touch(a, b, 0.0, touches);
}

} // namespace pydart2::native
