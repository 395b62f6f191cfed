#pragma once

#include <Eigen/Core>
#include <dart/constraint/ConstraintBase.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <unordered_map>
#include <vector>

#include "engine/engine_access.hpp"

namespace pydart2 {

/// The impulses of the step before, to begin the next from. A contact is found again by its two shapes and the nearest
/// point in the frame of the first, within 2 % of that shape's size; another constraint by what it is and the body or
/// joint it belongs to. Keys are places in the world, never addresses.
class ContactMemory
{
public:
  using Impulses = Eigen::Ref<Eigen::VectorXd>;

  /// What was remembered in this step is now what is recalled.
  void begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons);
  void forget() { now_.clear(), before_.clear(); }

  /// The impulses of a constraint's rows one step ago; zero if they are not known.
  void recall(const dart::constraint::ConstraintBase& constraint, const engine::Rows& rows, Impulses impulses);
  void remember(const dart::constraint::ConstraintBase& constraint, const engine::Rows& rows, const Impulses& impulses);

  /// All of it in numbers, and back; false, and nothing changes, if these are other numbers.
  std::vector<double> numbers() const;
  bool restore(const std::vector<double>& numbers);

private:
  /// Of a shape, body or joint: places in the world.
  using Place = double;
  struct Entry
  {
    Place a = 0.0, b = 0.0;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 6, 1> impulses = Eigen::Matrix<double, 6, 1>::Zero(); ///< A contact's: a vector of the world.
    double reach = 0.0; ///< m
    bool used = false;
  };

  Place place(const dart::dynamics::BodyNode* body, std::size_t part) const;
  Place shape_place(const dart::dynamics::ShapeFrame& shape) const;
  Entry entry(const dart::constraint::ConstraintBase& constraint, const engine::Rows& rows) const;

  std::vector<Entry> now_, before_; ///< In the order of the places, once they are recalled.
  std::unordered_map<const dart::dynamics::Skeleton*, std::size_t> order_;
};

} // namespace pydart2
