#pragma once

#include <Eigen/Core>
#include <array>
#include <dart/collision/Contact.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <unordered_map>
#include <vector>

#include "collision/native_scene.hpp"
#include "engine/engine_access.hpp"

namespace pydart2 {

/// The impulses of the step before, to begin the next from. A contact is found again by its two shapes and the nearest
/// point in the frame of the first, within 2 % of that shape's size; another constraint by what it is and the body or
/// joint it belongs to. Keys are places in the world, never addresses.
class ContactMemory
{
public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// What a constraint is found again by.
  struct Key
  {
    double a = 0.0, b = 0.0; ///< Places in the world of shapes, bodies or joints.
    Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< In the frame of the first shape.
    double reach = 0.0; ///< m
  };

  /// What was remembered in this step is now what is recalled; `same` if no skeleton has changed since.
  void begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons, bool same);
  void forget() { now_.clear(), before_.clear(); }

  Key key(const dart::collision::Contact& contact);
  Key key(const native::Touch& touch);
  Key key(const engine::Rows& rows) const;

  /// The impulses one step ago, zero if they are not known: a contact's as a vector of the world, the others' row by row.
  Vector6 recall(const Key& key);
  void remember(const Key& key, const Vector6& impulses) { now_.push_back({key, impulses, false}); }

  static constexpr std::size_t numbers_per_entry = 12;

  /// All of it in numbers, and back; false, and nothing changes, if these are other numbers.
  std::vector<double> numbers() const;
  bool restore(const std::vector<double>& numbers);

private:
  struct Entry
  {
    Key key;
    Vector6 impulses = Vector6::Zero();
    bool used = false;
  };
  struct Shape
  {
    const dart::collision::CollisionObject* object = nullptr;
    double place = -1.0, size = 0.0;
  };

  std::vector<Entry>::iterator find(const Key& wanted);
  double place(const dart::dynamics::BodyNode* body, std::size_t part) const;
  double shape_place(const dart::dynamics::ShapeFrame& shape) const;
  Shape look(const dart::collision::CollisionObject& object) const;
  const Shape& look_at(std::size_t side, const dart::collision::CollisionObject& object);
  const Shape& look_at_item(int item, const dart::collision::CollisionObject& object);

  std::vector<Entry> now_, before_; ///< In the order of the places, once they are recalled.
  std::size_t next_ = 0; ///< Near it the next one is that is recalled.
  std::array<Shape, 2> shapes_; ///< Of the last contact: the next one often has the same.
  std::vector<Shape> items_; ///< Of the native scene.
  std::vector<const dart::dynamics::Skeleton*> skeletons_;
  std::unordered_map<const dart::dynamics::Skeleton*, std::size_t> order_; ///< Of these.
};

} // namespace pydart2
