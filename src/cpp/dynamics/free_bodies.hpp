#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <unordered_map>
#include <vector>

namespace pydart2 {

/// Rigid bodies that are free and alone, in one array. A step reads of the engine where each is, how it moves and what
/// pushes it, moves it by closed forms, and gives back the result: no virtual calls, no flags, no tree of one body.
///
/// The rule is that of Debian's DART for free joints: semi-implicit Euler for the velocity of the body's origin in the
/// world's frame. Its results differ from those of TreeDynamics and the engine by rounding.
class FreeBodies
{
public:
  using Vector3 = Eigen::Vector3d;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix3 = Eigen::Matrix3d;

  struct Body
  {
    dart::dynamics::Skeleton* skeleton;
    dart::dynamics::BodyNode* node;
    dart::dynamics::FreeJoint* joint;

    // What the model says, in the body's frame.
    double mass;
    Vector3 com;
    Matrix3 inertia, inverse_of_inertia; ///< About the centre of mass.
    bool weighs;
    double reach; ///< At most so far from the origin its shapes are, m.

    // As of the present step, in the world's frame.
    Eigen::Quaterniond turn;
    Eigen::Isometry3d pose;
    Vector3 offset, center; ///< From the origin to the centre of mass, and where that is.
    Matrix3 inverse_inertia;
    double inverse_mass;
    Vector3 angular, linear; ///< Velocities of the origin.
    Vector6 velocity;        ///< Of the centre of mass, angular before linear.
    Vector3 angular_before, linear_before;
    Vector6 correction;      ///< A velocity of the centre of mass for the integration of positions alone.
    Vector6 command;         ///< Of the joint, in the body's frame.
    bool pushed = false;     ///< By a force that is cleared after the step.

    /// The one that all of its mass would have with the same kinetic energy, of a velocity as `velocity` is.
    double speed(const Vector6& of) const
    {
      const Vector3 turning = pose.linear().transpose() * of.head<3>();
      return std::sqrt(of.tail<3>().squaredNorm() + turning.dot(inertia * turning) / mass);
    }
  };

  /// Whether a skeleton is one such body: without limits, springs, dampers or friction in its joint.
  static bool is_one(const dart::dynamics::Skeleton& skeleton);

  void clear() { bodies_.clear(), places_.clear(); }
  void add(dart::dynamics::Skeleton& skeleton);

  /// The model anew.
  void read_model(std::size_t i) { read_model(bodies_[i]); }

  /// The state of all, and the velocities to which forces and weight take them.
  void predict(const Vector3& gravity, double dt);

  /// Changes a velocity, of the centre of mass.
  static void change(Body& body, const Vector6& change);

  /// Where all are after the step.
  void integrate(double dt);

  /// Gives the engine the state after the step, and clears the forces.
  void give_back(double dt);

  std::size_t size() const { return bodies_.size(); }
  Body& operator[](std::size_t i) { return bodies_[i]; }
  const Body& operator[](std::size_t i) const { return bodies_[i]; }

  /// Where a body is in the array, -1 if it is not.
  int find(const dart::dynamics::BodyNode* node) const
  {
    const auto found = places_.find(node);
    return found == places_.end() ? -1 : found->second;
  }

  /// A body as it is now, without forces, where nothing else of it is to be moved in an array.
  static Body read(dart::dynamics::BodyNode& node);

  /// The first whose positions or velocities are beyond `most` or no numbers; size() if there is none.
  std::size_t find_insane(double most) const;

private:
  static void read_model(Body& body);

  std::vector<Body> bodies_;
  std::unordered_map<const dart::dynamics::BodyNode*, int> places_;
};

} // namespace pydart2
