#include "handles/inverse_kinematics.hpp"

#include "base/checks.hpp"

namespace pydart2 {

namespace {

/// Puts the positions back that a search changes.
class KeepPositions
{
public:
  explicit KeepPositions(dart::dynamics::Skeleton& skeleton) : skeleton_(skeleton), q_(skeleton.getPositions()) {}
  ~KeepPositions() { skeleton_.setPositions(q_); }
  KeepPositions(const KeepPositions&) = delete;
  KeepPositions& operator=(const KeepPositions&) = delete;

private:
  dart::dynamics::Skeleton& skeleton_;
  Eigen::VectorXd q_;
};

void check_rotation(const Eigen::Matrix3d& rotation)
{
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = rotation;
  check::rigid(pose, "target rotation");
}

} // namespace

InverseKinematicsHandle::InverseKinematicsHandle(WorldRef world, SkeletonRef skeleton)
  : skeleton_(std::move(world), skeleton, skeleton->skeleton.get()), moves_(skeleton->skeleton->getNumDofs(), true)
{
}

void InverseKinematicsHandle::add_target(
    long body,
    const Eigen::Vector3d& offset,
    const Eigen::Vector3d* position,
    const Eigen::Matrix3d* rotation,
    double weight)
{
  auto& skel = *skeleton_;
  IkTarget target;
  check::finite(offset, "offset");
  check::positive(weight, "weight");
  target.offset = offset;
  target.weight = weight;
  if (body >= 0)
    target.body = skel.getBodyNode(check::index(body, skel.getNumBodyNodes(), "bodynode"));
  else if (skel.getMass() == 0) // the engine asserts
    throw Error(Kind::value, "skeleton '" + skel.getName() + "' has no mass, so it has no centre of mass");
  if (position) {
    check::finite(*position, "target position");
    target.position = *position;
  }
  if (rotation) {
    check_rotation(*rotation);
    target.rotation = *rotation;
  }
  targets_.push_back(target);
}

void InverseKinematicsHandle::set_dofs(const VectorIn& indices)
{
  std::fill(moves_.begin(), moves_.end(), false);
  for (long i = 0; i < indices.size; ++i)
    moves_[check::index(static_cast<long>(indices.data[i]), moves_.size(), "dof")] = true;
}

void InverseKinematicsHandle::set_posture(const VectorIn& posture)
{
  check::size(posture.size, moves_.size(), "posture");
  check::finite(posture, "posture");
  posture_ = posture.eigen();
}

Busy InverseKinematicsHandle::claim() const
{
  skeleton_.get(); // refuses one that has changed
  return Busy(*skeleton_.world);
}

void InverseKinematicsHandle::solve(
    const VectorIn& start, double tolerance, long iterations, long restarts, long seed, const MatrixOut& found) const
{
  auto& skel = *skeleton_.skeleton->skeleton;
  check::size(start.size, moves_.size(), "positions to start from");
  check::finite(start, "positions to start from");
  check::positive(tolerance, "tolerance");
  for (const long count : {iterations, restarts, seed})
    if (count < 0 || count > 1'000'000'000)
      throw Error(Kind::value, "iterations, restarts and seed must be 0 to 1e9, got " + std::to_string(count));
  const KeepPositions keep(skel);
  const IkOptions options{
      tolerance, static_cast<int>(iterations), static_cast<int>(restarts), static_cast<unsigned>(seed)};
  const auto result = InverseKinematics(skel, targets_, moves_)
                          .solve(start.eigen(), posture_.size() > 0 ? &posture_ : nullptr, options);
  check::size(found.rows * found.cols, moves_.size() + 4, "what is found");
  Eigen::Map<Eigen::VectorXd> packed(found.data, result.q.size() + 4);
  packed << result.q, result.residual, result.converged, result.restarts, result.iterations;
}

} // namespace pydart2
