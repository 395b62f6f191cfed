#include "collision/native_detector.hpp"

#include <dart/dynamics/ShapeNode.hpp>
#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "base/errors.hpp"
#include "engine/collision_filter.hpp"

namespace pydart2 {

using namespace dart::collision;
using namespace dart::dynamics;

bool report(const std::vector<native::Touch>& touches, const CollisionOption& option, CollisionResult* result)
{
  if (result == nullptr)
    return !touches.empty();
  for (const auto& touch : touches) {
    if (result->getNumContacts() >= option.maxNumContacts)
      break;
    Contact contact;
    contact.point = touch.point.point;
    contact.normal = touch.point.normal;
    contact.penetrationDepth = touch.point.depth;
    contact.collisionObject1 = touch.a;
    contact.collisionObject2 = touch.b;
    result->addContact(contact);
  }
  return !touches.empty();
}

namespace {

double no_distance()
{
  dtwarn << "[NativeDetector] The native collision detector measures no distances; the fcl one does.\n";
  return 0.0;
}

std::size_t shape_index(const ShapeNode& node)
{
  const auto body = node.getBodyNodePtr();
  std::size_t index = 0;
  while (index < body->getNumShapeNodes() && body->getShapeNode(index) != &node)
    ++index;
  return index;
}

} // namespace

NativeDetector::NativeDetector()
{
  mCollisionObjectManager = std::make_unique<ManagerForSharableCollisionObjects>(this);
}

std::shared_ptr<NativeDetector> NativeDetector::create()
{
  return std::shared_ptr<NativeDetector>(new NativeDetector());
}

const std::string& NativeDetector::getType() const
{
  static const std::string type = "native";
  return type;
}

std::unique_ptr<CollisionGroup> NativeDetector::createCollisionGroup()
{
  return std::make_unique<NativeGroup>(shared_from_this());
}

bool NativeDetector::collide(CollisionGroup* group, const CollisionOption& option, CollisionResult* result)
{
  if (result != nullptr)
    result->clear();
  if (option.maxNumContacts == 0)
    return false;
  touches_.clear();
  static_cast<NativeGroup*>(group)->scene().find(option.collisionFilter.get(), 0.0, touches_);
  return report(touches_, option, result);
}

bool NativeDetector::collide(
    CollisionGroup* group, CollisionGroup* other, const CollisionOption& option, CollisionResult* result)
{
  if (result != nullptr)
    result->clear();
  if (option.maxNumContacts == 0)
    return false;
  touches_.clear();
  static_cast<NativeGroup*>(group)->scene().find_between(
      static_cast<NativeGroup*>(other)->scene(), option.collisionFilter.get(), touches_);
  return report(touches_, option, result);
}

double NativeDetector::distance(CollisionGroup*, const DistanceOption&, DistanceResult*)
{
  return no_distance();
}

double NativeDetector::distance(CollisionGroup*, CollisionGroup*, const DistanceOption&, DistanceResult*)
{
  return no_distance();
}

std::unique_ptr<CollisionObject> NativeDetector::createCollisionObject(const ShapeFrame* frame)
{
  auto made = std::make_unique<native::Object>(this, frame);
  if (made->geometry().form == native::Form::none)
    dtwarn << "[NativeDetector] The native collision detector does not know of shapes like '"
           << frame->getShape()->getType() << "': it passes through everything. The fcl one may know it.\n";
  return made;
}

void NativeDetector::refreshCollisionObject(CollisionObject* object)
{
  static_cast<native::Object*>(object)->refresh();
}

void NativeGroup::set_order(const std::vector<SkeletonPtr>& skeletons)
{
  const auto same = [](const Skeleton* known, const SkeletonPtr& skeleton) { return known == skeleton.get(); };
  if (std::equal(order_.begin(), order_.end(), skeletons.begin(), skeletons.end(), same))
    return;
  order_.clear();
  for (const auto& skeleton : skeletons)
    order_.push_back(skeleton.get());
  stale_ = true;
}

native::Scene& NativeGroup::scene()
{
  if (stale_ || scene_.reordered()) {
    scene_.set_objects(sorted());
    scene_.look_again(pose_of_);
    scene_.set_asleep(asleep_);
  }
  stale_ = false;
  return scene_;
}

void NativeGroup::look_again(native::PoseOf pose_of)
{
  pose_of_ = std::move(pose_of);
  if (!stale_)
    scene_.look_again(pose_of_);
}

void NativeGroup::find(const CollisionOption& option, double time_step, CollisionResult& result)
{
  touches_.clear();
  (stale_ ? scene() : scene_).find(option.collisionFilter.get(), time_step, touches_);
  auto& contacts = engine::contacts_of(result);
  contacts.resize(std::min(touches_.size(), option.maxNumContacts));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& touch = touches_[i];
    auto& contact = contacts[i];
    contact.point = touch.point.point;
    contact.normal = touch.point.normal;
    contact.force.setZero();
    contact.penetrationDepth = touch.point.depth;
    contact.collisionObject1 = touch.a;
    contact.collisionObject2 = touch.b;
  }
}

void NativeGroup::set_asleep(const std::unordered_set<const Skeleton*>& asleep, int version)
{
  if (version == version_)
    return;
  version_ = version;
  asleep_ = asleep;
  if (!stale_)
    scene_.set_asleep(asleep_);
}

std::vector<native::Object*> NativeGroup::sorted() const
{
  std::unordered_map<const Skeleton*, std::size_t> ranks;
  for (std::size_t i = 0; i < order_.size(); ++i)
    ranks.emplace(order_[i], i);
  using Key = std::tuple<std::size_t, std::size_t, std::size_t>; // skeleton, body, shape
  std::vector<std::pair<Key, native::Object*>> objects;
  for (const auto& info : mObjectInfoList) {
    Key key(order_.size() + objects.size(), 0, 0);
    if (const auto* node = info->mFrame->asShapeNode()) {
      const auto body = node->getBodyNodePtr();
      const auto rank = ranks.emplace(body->getSkeleton().get(), order_.size() + objects.size()).first->second;
      key = {rank, body->getIndexInSkeleton(), shape_index(*node)};
    }
    objects.emplace_back(key, static_cast<native::Object*>(info->mObject.get()));
  }
  std::sort(objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<native::Object*> out;
  for (const auto& [key, object] : objects)
    out.push_back(object);
  return out;
}

NativeGroup* native_group(dart::constraint::ConstraintSolver& solver)
{
  auto* group = dynamic_cast<NativeGroup*>(solver.getCollisionGroup().get());
  if (group != nullptr)
    group->set_order(solver.getSkeletons());
  return group;
}

} // namespace pydart2
