#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <functional>
#include <unordered_set>

#include "collision/contact_point.hpp"
#include "collision/native_manifold.hpp"
#include "collision/native_tree.hpp"

namespace pydart2::native {

/// A shape of a world, as the engine's filters know it.
class Object : public dart::collision::CollisionObject
{
public:
  Object(dart::collision::CollisionDetector* detector, const dart::dynamics::ShapeFrame* frame);

  /// Reads the shape anew.
  void refresh();
  const Geometry& geometry() const { return geometry_; }

protected:
  void updateEngineData() override {}

private:
  Geometry geometry_;
};

/// A contact point and its two objects.
struct Touch
{
  ContactPoint point;
  Object* a;
  Object* b;
  int item_a, item_b; ///< Their numbers in the scene.
  Vector on_a; ///< The point in the frame of the first.
};

/// Where a body is, and how fast, that the engine's objects do not yet know to be there; null for others.
struct Placed
{
  const Pose* pose = nullptr;
  const Vector* angular = nullptr; ///< Velocities of its origin, in the world's frame.
  const Vector* linear = nullptr;
};
using PoseOf = std::function<Placed(const dart::dynamics::BodyNode*)>;

/// All shapes that may collide with each other, and which are near each other. Its memory of earlier steps saves time
/// only: what it finds depends on the shapes and where they are, not on what was before.
class Scene
{
public:
  /// In the order of the contacts.
  void set_objects(const std::vector<Object*>& objects);

  /// Those of sleepers are where they were, and do not touch each other.
  void set_asleep(const std::unordered_set<const dart::dynamics::Skeleton*>& asleep);

  /// Reads anew what a scene knows of bodies and shapes beside their geometry.
  void look_again(const PoseOf& pose_of);

  /// Whether bodies have another place in their skeletons than when the objects were set.
  bool reordered() const;

  /// The contact points of pairs in the order of their shapes; where there is a time step also of those that are apart: by
  /// 0.5 mm or 2 % of the smaller one's size at most, or by what they come nearer in the step.
  void find(const dart::collision::CollisionFilter* filter, double time_step, std::vector<Touch>& touches);

  /// Those between shapes of two scenes.
  void find_between(Scene& other, const dart::collision::CollisionFilter* filter, std::vector<Touch>& touches);

private:
  struct Item
  {
    Object* object;
    const dart::dynamics::BodyNode* body; ///< Null: a frame of its own.
    const dart::dynamics::Frame* frame;   ///< The body's.
    const dart::dynamics::Skeleton* skeleton;
    std::size_t place; ///< Of the body in its skeleton.
    bool bounded;
    Placed placed; ///< Nothing: the engine knows.
    bool on_body;          ///< That `relative` is read, so that the engine's frame of the shape needs no pose.
    Pose relative;         ///< To the body, in which it is.
    bool collidable; ///< The body is.
    Pose pose;
    Bounds bounds;
    Bounds wide; ///< Within which it may move without being looked for anew.
    bool escaped;
    bool asleep;
    Vector motion = Vector::Zero(); ///< In the time step, of the shape's origin.
    double turning = 0.0;           ///< And how far its other points turn about that, at most.
    double reach = 0.0;             ///< Beyond its bounds that it was looked for.
  };
  using Pair = std::pair<int, int>;

  Item& item(int i) { return items_[static_cast<std::size_t>(i)]; }
  void place();
  void place(int index);
  void fetch_ahead(std::size_t i) const;
  void look_at_motion(Item& item);
  void widen(Item& item);
  void update();
  void check_places();
  void update_tree();
  void find_pairs_of(int index);
  void find_watched_pairs();
  void touch(Item& a, Item& b, double margin, std::vector<Touch>& touches);

  std::vector<Item> items_;
  double time_step_ = 0.0; ///< Zero: without gaps.
  std::vector<int> unbounded_;
  std::vector<int> escaped_;
  BoundsTree tree_;
  bool built_ = false;
  bool all_placed_ = false;
  std::vector<Pair> pairs_, new_pairs_;
  std::vector<int> watched_; ///< The items that are not asleep.
  std::vector<Pair> watched_pairs_; ///< All but those of a sleeper with what cannot move.
  Points points_;
};

} // namespace pydart2::native
