#include "state/sleeping.hpp"

#include <algorithm>
#include <cmath>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <numeric>
#include <unordered_map>

#include "base/errors.hpp"
#include "state/contact.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Joint;
using dart::dynamics::Skeleton;

/// Time between two looks at how fast all are, s.
constexpr double pause = 0.05;

/// What rolls has no friction to stop it: one that is slower than so many times what counts as slow loses so much of its
/// speed at each look.
constexpr double slow_enough = 20.0, loss = 0.2;

/// Speeds of a body in units of what counts as slow.
double speed(const BodyNode& body, const Sleep& sleep)
{
  double size = 0.0;
  for (std::size_t i = 0; i < body.getNumShapeNodes(); ++i)
    size = std::max(size, body.getShapeNode(i)->getShape()->getBoundingBox().computeFullExtents().maxCoeff());
  size = size > 0.0 && std::isfinite(size) ? size : 1.0;
  return std::max(
      body.getCOMLinearVelocity().norm() / (sleep.linear * std::sqrt(size)), body.getAngularVelocity().norm() / sleep.angular);
}

double speed(const Skeleton& skeleton, const Sleep& sleep)
{
  double fastest = 0.0;
  for (const auto* body : skeleton.getBodyNodes())
    if (fastest <= slow_enough)
      fastest = std::max(fastest, speed(*body, sleep));
  return fastest;
}

bool is_driven(const Joint& joint)
{
  const auto actuator = joint.getActuatorType();
  return actuator != Joint::FORCE && actuator != Joint::PASSIVE && actuator != Joint::LOCKED;
}

bool can_move(const Skeleton& skeleton)
{
  return skeleton.isMobile() && skeleton.getNumDofs() > 0;
}

bool may_sleep(const SkeletonRecord& item)
{
  const auto& skeleton = *item.skeleton;
  const auto joints = skeleton.getJoints();
  return !item.controlled && !item.motors.targets() && !item.not_numbers && skeleton.getNumSoftBodyNodes() == 0
         && can_move(skeleton)
         && std::none_of(joints.begin(), joints.end(), [](const Joint* joint) { return is_driven(*joint); });
}

bool is_one_free_body(const Skeleton& skeleton)
{
  return skeleton.getNumBodyNodes() == 1 && dynamic_cast<const dart::dynamics::FreeJoint*>(skeleton.getJoint(0)) != nullptr;
}

const Skeleton* skeleton_of(const dart::collision::CollisionObject& object)
{
  const auto* node = object.getShapeFrame()->asShapeNode();
  return node == nullptr ? nullptr : node->getBodyNodePtr()->getSkeleton().get();
}

/// The awake skeletons that can move, in groups that contacts and constraints connect.
class Groups
{
public:
  explicit Groups(const WorldRecord& world)
  {
    for (const auto& item : world.awake())
      if (can_move(*item->skeleton)) {
        numbers_.emplace(item->skeleton.get(), static_cast<int>(members.size()));
        members.push_back(item);
      }
    parents_.resize(members.size());
    std::iota(parents_.begin(), parents_.end(), 0);
    blocked_.resize(members.size(), false);
    for (const auto& contact : world.world->getLastCollisionResult().getContacts())
      join(world, skeleton_of(*contact.collisionObject1), skeleton_of(*contact.collisionObject2));
    for (const auto& constraint : world.constraints)
      if (constraint.enabled)
        join(world, constraint.skeleton1.get(), constraint.skeleton2.get());
  }

  int group_of(int member)
  {
    int& parent = parents_[static_cast<std::size_t>(member)];
    return parent == member ? member : parent = group_of(parent);
  }

  /// That one stays awake, and so do the others.
  void block(int member) { blocked_[static_cast<std::size_t>(group_of(member))] = true; }
  bool is_blocked(int member) { return blocked_[static_cast<std::size_t>(group_of(member))]; }

  std::vector<SkeletonRef> members;

private:
  void join(const WorldRecord& world, const Skeleton* a, const Skeleton* b)
  {
    const auto found_a = numbers_.find(a), found_b = numbers_.find(b);
    const bool has_a = found_a != numbers_.end(), has_b = found_b != numbers_.end();
    if (has_a && has_b) {
      const int x = group_of(found_a->second), y = group_of(found_b->second);
      blocked_[static_cast<std::size_t>(y)] = blocked_[static_cast<std::size_t>(x)] || blocked_[static_cast<std::size_t>(y)];
      parents_[static_cast<std::size_t>(x)] = y;
    } else if (has_a || has_b) {
      const Skeleton* carrier = has_a ? b : a;
      if (carrier != nullptr && speed(*carrier, world.sleep) > 1.0)
        block(has_a ? found_a->second : found_b->second);
    }
  }

  std::unordered_map<const Skeleton*, int> numbers_;
  std::vector<int> parents_;
  std::vector<bool> blocked_; ///< Of those that are parents.
};

/// Takes speed from bodies that roll slowly, and measures for how long each has been slow; whether one may sleep.
bool look(WorldRecord& world, double passed)
{
  const auto& sleep = world.sleep;
  bool any = false;
  for (const auto& item : world.awake()) {
    auto& skeleton = *item->skeleton;
    if (!may_sleep(*item)) {
      item->quiet = 0.0;
      continue;
    }
    const double fast = speed(skeleton, sleep);
    item->quiet = fast <= 1.0 ? item->quiet + passed : 0.0;
    any |= item->quiet >= sleep.seconds;
  }
  return any;
}

/// Rolling has no friction: what touches something and is slow anyway is stopped.
void slow_down(WorldRecord& world)
{
  std::unordered_set<const Skeleton*> touching;
  for (const auto& contact : world.world->getLastCollisionResult().getContacts())
    for (const auto* object : {contact.collisionObject1, contact.collisionObject2})
      touching.insert(skeleton_of(*object));
  for (const auto& item : world.awake()) {
    auto& skeleton = *item->skeleton;
    if (touching.count(&skeleton) > 0 && is_one_free_body(skeleton) && may_sleep(*item)
        && speed(skeleton, world.sleep) <= slow_enough)
      skeleton.setVelocities((1.0 - loss) * skeleton.getVelocities());
  }
}

void lay_down(SkeletonRecord& item, int island)
{
  auto& skeleton = *item.skeleton;
  const auto size = static_cast<long>(skeleton.getNumDofs());
  skeleton.setVelocities(Eigen::VectorXd::Zero(size));
  skeleton.setAccelerations(Eigen::VectorXd::Zero(size));
  skeleton.setMobile(false);
  item.island = island;
}

void stand_up(SkeletonRecord& item)
{
  item.skeleton->setMobile(true);
  item.island = 0;
  item.quiet = 0.0;
}

/// The contacts of those that fall asleep, with the forces that carry them. `rows` are all.
void keep_contacts(WorldRecord& world, const std::vector<double>& rows)
{
  for (const double* row = rows.data(); row != rows.data() + rows.size(); row += contact_columns)
    for (const int side : {6, 8}) {
      const int index = static_cast<int>(row[side]);
      const int island = index < 0 ? 0 : world.skeletons[static_cast<std::size_t>(index)]->island;
      if (island == 0)
        continue;
      auto& kept = world.sleep.contacts.emplace_back();
      kept.island = island;
      std::copy(row, row + contact_columns, kept.row.begin());
      break;
    }
}

/// Those of whom this holds stand up.
template <class Which>
std::vector<SkeletonRef> wake_if(WorldRecord& world, Which wakes)
{
  std::vector<SkeletonRef> woken;
  auto& kept = world.sleep.contacts;
  kept.erase(
      std::remove_if(kept.begin(), kept.end(), [&](const auto& contact) { return wakes(contact.island); }), kept.end());
  for (const auto& item : world.skeletons)
    if (item->island != 0 && wakes(item->island)) {
      stand_up(*item);
      woken.push_back(item);
    }
  find_awake(world);
  return woken;
}

} // namespace

void find_awake(WorldRecord& world)
{
  auto& sleep = world.sleep;
  world.plan.note_change();
  ++sleep.version;
  sleep.asleep.clear();
  sleep.awake.clear();
  sleep.awake_skeletons.clear();
  for (const auto& item : world.skeletons)
    if (item->island != 0)
      sleep.asleep.insert(item->skeleton.get());
    else {
      sleep.awake.push_back(item);
      sleep.awake_skeletons.push_back(item->skeleton);
    }
}

void fall_asleep(WorldRecord& world)
{
  auto& sleep = world.sleep;
  if (!sleep.enabled)
    return;
  const double dt = world.world->getTimeStep();
  const long every = std::max(1L, std::lround(pause / dt));
  if (world.frame % every != 0)
    return;
  const bool any = look(world, static_cast<double>(every) * dt);
  slow_down(world);
  if (!any)
    return;
  Groups groups(world);
  const int count = static_cast<int>(groups.members.size());
  for (int i = 0; i < count; ++i)
    if (groups.members[static_cast<std::size_t>(i)]->quiet < sleep.seconds)
      groups.block(i);
  std::vector<double> rows(contact_columns * num_contacts(world));
  write_contacts(world, rows.data());
  std::unordered_map<int, int> islands; // of the groups
  for (int i = 0; i < count; ++i) {
    if (groups.is_blocked(i))
      continue;
    const auto [found, is_new] = islands.emplace(groups.group_of(i), sleep.last_island + 1);
    sleep.last_island += is_new ? 1 : 0;
    lay_down(*groups.members[static_cast<std::size_t>(i)], found->second);
  }
  if (islands.empty())
    return;
  rows.resize(rows.size() - contact_columns * sleep.contacts.size()); // those of earlier sleepers come last
  keep_contacts(world, rows);
  find_awake(world);
}

std::vector<SkeletonRef> wake_touched(WorldRecord& world, const dart::collision::CollisionResult& contacts)
{
  std::unordered_set<const Skeleton*> touched;
  const auto touch = [&](const Skeleton* one, const Skeleton* other) {
    if (other != nullptr && can_move(*other) && world.sleep.asleep.count(one) > 0)
      touched.insert(one);
  };
  for (const auto& contact : contacts.getContacts()) {
    if (contact.penetrationDepth < 0.0) // a gap
      continue;
    const auto *a = skeleton_of(*contact.collisionObject1), *b = skeleton_of(*contact.collisionObject2);
    touch(a, b);
    touch(b, a);
  }
  if (touched.empty())
    return {};
  std::unordered_set<int> islands;
  for (const auto& item : world.skeletons)
    if (touched.count(item->skeleton.get()) > 0)
      islands.insert(item->island);
  return wake_if(world, [&](int island) { return islands.count(island) > 0; });
}

void wake(WorldRecord& world, SkeletonRecord& skeleton)
{
  skeleton.quiet = 0.0;
  if (skeleton.island != 0) {
    const int mine = skeleton.island;
    wake_if(world, [mine](int island) { return island == mine; });
  } else if (!can_move(*skeleton.skeleton) && skeleton.skeleton->getNumBodyNodes() > 0)
    wake_all(world);
}

void wake_all(WorldRecord& world)
{
  world.plan.note_change();
  if (!world.sleep.enabled)
    return;
  for (const auto& item : world.skeletons)
    item->quiet = 0.0;
  if (!world.sleep.asleep.empty())
    wake_if(world, [](int) { return true; });
}

void wake_held(WorldRecord& world, const ConstraintRecord& constraint)
{
  world.plan.note_change();
  if (!world.sleep.enabled)
    return;
  for (const auto* body : {constraint.body1, constraint.body2})
    if (const int index = body == nullptr ? -1 : world.index_of(body->getSkeleton()); index >= 0)
      if (auto& item = *world.skeletons[static_cast<std::size_t>(index)]; item.island != 0 || item.skeleton->isMobile())
        wake(world, item);
}

void forget_sleeper(WorldRecord& world, int index)
{
  world.plan.note_change();
  for (auto& contact : world.sleep.contacts)
    forget_skeleton(contact.row.data(), index);
  if (world.sleep.enabled)
    find_awake(world);
}

AllMobile::AllMobile(WorldRecord& world) : world_(world)
{
  std::swap(asleep_, world_.sleep.asleep);
  ++world_.sleep.version;
  for (const auto& item : world_.skeletons)
    if (item->island != 0)
      item->skeleton->setMobile(true);
}

AllMobile::~AllMobile()
{
  for (const auto& item : world_.skeletons)
    if (item->island != 0)
      item->skeleton->setMobile(false);
  std::swap(asleep_, world_.sleep.asleep);
  ++world_.sleep.version;
}

std::vector<double> sleep_numbers(const WorldRecord& world)
{
  const auto& sleep = world.sleep;
  if (!sleep.enabled)
    return {};
  std::vector<double> numbers{double(sleep.last_island), double(sleep.contacts.size())};
  for (const auto& item : world.skeletons)
    numbers.insert(numbers.end(), {double(item->island), item->quiet});
  for (const auto& contact : sleep.contacts) {
    numbers.push_back(contact.island);
    numbers.insert(numbers.end(), contact.row.begin(), contact.row.end());
  }
  return numbers;
}

std::size_t count_sleep_numbers(const WorldRecord& world, const std::vector<double>& numbers, std::size_t begin)
{
  if (!world.sleep.enabled)
    return 0;
  const std::size_t fixed = 2 + 2 * world.skeletons.size(), of_contact = 1 + contact_columns;
  const auto whole = [](double value, double most) { return value >= 0.0 && value <= most && value == std::floor(value); };
  const std::size_t left = numbers.size() - std::min(begin, numbers.size());
  bool good = left >= fixed && whole(numbers[begin], 1e9) && whole(numbers[begin + 1], double((left - fixed) / of_contact));
  for (std::size_t i = 0; good && i < world.skeletons.size(); ++i) {
    const double island = numbers[begin + 2 + 2 * i], quiet = numbers[begin + 3 + 2 * i];
    good = whole(island, numbers[begin]) && quiet >= 0.0;
  }
  const std::size_t size = good ? fixed + of_contact * static_cast<std::size_t>(numbers[begin + 1]) : 0;
  for (std::size_t i = fixed; good && i < size; i += of_contact) {
    good = whole(numbers[begin + i], numbers[begin]);
    for (const int side : {7, 9}) // the indices of skeletons
      good = good && whole(numbers[begin + i + static_cast<std::size_t>(side)] + 1.0, double(world.skeletons.size()));
  }
  if (!good)
    throw Error(
        Kind::value, "the snapshot does not say who sleeps in this world: it was taken with sleeping off, or of another world");
  return size;
}

void restore_sleep(WorldRecord& world, const double* numbers)
{
  auto& sleep = world.sleep;
  if (!sleep.enabled)
    return;
  sleep.last_island = static_cast<int>(numbers[0]);
  sleep.contacts.resize(static_cast<std::size_t>(numbers[1]));
  numbers += 2;
  for (const auto& item : world.skeletons) {
    if (const int island = static_cast<int>(numbers[0]); island != 0 && item->skeleton->isMobile())
      lay_down(*item, island);
    item->quiet = numbers[1];
    numbers += 2;
  }
  for (auto& contact : sleep.contacts) {
    contact.island = static_cast<int>(*numbers++);
    std::copy(numbers, numbers + contact_columns, contact.row.begin());
    numbers += contact_columns;
  }
  find_awake(world);
}

} // namespace pydart2
