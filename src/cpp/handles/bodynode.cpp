#include "handles/bodynode.hpp"

#include <dart/dynamics/SoftBodyNode.hpp>

#include "base/checks.hpp"
#include "handles/motion.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;

namespace {

const Eigen::Vector3d origin = Eigen::Vector3d::Zero();

/// Calls `change` with the dynamics aspect of every shape that has one; returns whether there was any.
template <class Change>
bool each_contact_shape(BodyNode& body, Change change)
{
  bool any = false;
  for (auto* node : body.getShapeNodesWith<dart::dynamics::DynamicsAspect>()) {
    change(*node->getDynamicsAspect());
    any = true;
  }
  return any;
}

/// World frame: Frame::getLinearVelocity(point), without what that asks on its way.
Eigen::Vector3d velocity_at(const BodyNode& body, const Eigen::Vector3d& point)
{
  Vector6d V = body.getSpatialVelocity();
  V.tail<3>() += V.head<3>().cross(point);
  return dart::math::AdR(body.getWorldTransform(), V).tail<3>();
}

} // namespace

BodyNodeHandle::BodyNodeHandle(WorldRef world, SkeletonRef skeleton, BodyNode* body)
  : body_(std::move(world), std::move(skeleton), body)
{
}

std::string BodyNodeHandle::name() const
{
  return body_->getName();
}

int BodyNodeHandle::index_in_skeleton() const
{
  return static_cast<int>(body_->getIndexInSkeleton());
}

int BodyNodeHandle::index_in_tree() const
{
  return static_cast<int>(body_->getIndexInTree());
}

int BodyNodeHandle::tree_index() const
{
  return static_cast<int>(body_->getTreeIndex());
}

int BodyNodeHandle::parent_bodynode() const
{
  const BodyNode* parent = body_->getParentBodyNode();
  return parent == nullptr ? -1 : static_cast<int>(parent->getIndexInSkeleton());
}

int BodyNodeHandle::num_child_bodynodes() const
{
  return static_cast<int>(body_->getNumChildBodyNodes());
}

int BodyNodeHandle::child_bodynode(long index) const
{
  const auto i = check::index(index, body_->getNumChildBodyNodes(), "child bodynode");
  return static_cast<int>(body_->getChildBodyNode(i)->getIndexInSkeleton());
}

int BodyNodeHandle::parent_joint() const
{
  return static_cast<int>(body_->getParentJoint()->getJointIndexInSkeleton());
}

int BodyNodeHandle::num_child_joints() const
{
  return static_cast<int>(body_->getNumChildJoints());
}

int BodyNodeHandle::child_joint(long index) const
{
  const auto i = check::index(index, body_->getNumChildJoints(), "child joint");
  return static_cast<int>(body_->getChildJoint(i)->getJointIndexInSkeleton());
}

int BodyNodeHandle::num_dependent_dofs() const
{
  return static_cast<int>(body_->getNumDependentDofs());
}

int BodyNodeHandle::dependent_dof(long index) const
{
  const auto i = check::index(index, body_->getNumDependentDofs(), "dependent dof");
  return static_cast<int>(body_->getDependentDof(i)->getIndexInSkeleton());
}

int BodyNodeHandle::num_shapenodes() const
{
  return static_cast<int>(body_->getNumShapeNodes());
}

ShapeNodeHandle BodyNodeHandle::shapenode(long index) const
{
  const auto i = check::index(index, body_->getNumShapeNodes(), "shapenode");
  return {body_.world, body_.skeleton, body_->getShapeNode(i)};
}

bool BodyNodeHandle::is_soft() const
{
  return body_->asSoftBodyNode() != nullptr;
}

SoftBodyHandle BodyNodeHandle::soft_body() const
{
  auto* soft = body_->asSoftBodyNode();
  if (soft == nullptr)
    throw Error(Kind::type, "body '" + name() + "' is rigid");
  return {body_.world, body_.skeleton, soft};
}

bool BodyNodeHandle::gravity_mode() const
{
  return body_->getGravityMode();
}

void BodyNodeHandle::set_gravity_mode(bool enable)
{
  body_->setGravityMode(enable);
}

bool BodyNodeHandle::is_collidable() const
{
  return body_->isCollidable();
}

void BodyNodeHandle::set_collidable(bool enable)
{
  body_->setCollidable(enable);
}

double BodyNodeHandle::mass() const
{
  return body_->getMass();
}

void BodyNodeHandle::set_mass(double mass)
{
  check::positive(mass, "mass");
  body_->setMass(mass);
}

Eigen::Vector3d BodyNodeHandle::local_com() const
{
  return body_->getLocalCOM();
}

void BodyNodeHandle::set_local_com(const Eigen::Vector3d& com)
{
  check::finite(com, "local COM");
  body_->setLocalCOM(com);
}

Eigen::Matrix3d BodyNodeHandle::inertia() const
{
  return body_->getInertia().getMoment();
}

void BodyNodeHandle::set_inertia(const Eigen::Matrix3d& inertia)
{
  check::inertia(inertia, "inertia");
  body_->setInertia(dart::dynamics::Inertia(body_->getMass(), body_->getLocalCOM(), inertia));
}

double BodyNodeHandle::friction_coeff() const
{
  const auto nodes = body_->getShapeNodesWith<dart::dynamics::DynamicsAspect>();
  return nodes.empty() ? 1.0 : nodes.front()->getDynamicsAspect()->getFrictionCoeff();
}

double BodyNodeHandle::restitution_coeff() const
{
  const auto nodes = body_->getShapeNodesWith<dart::dynamics::DynamicsAspect>();
  return nodes.empty() ? 0.0 : nodes.front()->getDynamicsAspect()->getRestitutionCoeff();
}

bool BodyNodeHandle::set_friction_coeff(double coefficient)
{
  check::not_negative(coefficient, "friction coefficient");
  return each_contact_shape(*body_, [&](auto& aspect) { aspect.setFrictionCoeff(coefficient); });
}

bool BodyNodeHandle::set_restitution_coeff(double coefficient)
{
  check::not_negative(coefficient, "restitution coefficient");
  return each_contact_shape(*body_, [&](auto& aspect) { aspect.setRestitutionCoeff(coefficient); });
}

BodyNode& BodyNodeHandle::posed() const
{
  BodyNode& body = *body_;
  find_pose(*body_.world, *body_.skeleton, body);
  return body;
}

BodyNode& BodyNodeHandle::moving() const
{
  BodyNode& body = posed();
  find_velocity(*body_.world, *body_.skeleton, body);
  return body;
}

void BodyNodeHandle::transform(Output& into) const
{
  matrix(into, 4, 4) = posed().getWorldTransform().matrix();
}

Eigen::Matrix4d BodyNodeHandle::relative_transform() const
{
  return body_->getRelativeTransform().matrix();
}

Eigen::Vector3d BodyNodeHandle::to_world(const Eigen::Vector3d* offset) const
{
  const auto& T = posed().getWorldTransform();
  return offset == nullptr ? Eigen::Vector3d(T.translation()) : T * *offset;
}

Eigen::Vector3d BodyNodeHandle::to_local(const Eigen::Vector3d& point) const
{
  return posed().getWorldTransform().inverse() * point;
}

Eigen::Vector3d BodyNodeHandle::com() const
{
  return posed().getCOM();
}

Eigen::Vector3d BodyNodeHandle::com_linear_velocity() const
{
  const BodyNode& body = moving();
  return velocity_at(body, body.getLocalCOM());
}

Eigen::Vector3d BodyNodeHandle::com_linear_acceleration() const
{
  return body_->getCOMLinearAcceleration();
}

Vector6d BodyNodeHandle::com_spatial_velocity() const
{
  return moving().getCOMSpatialVelocity();
}

Vector6d BodyNodeHandle::com_spatial_acceleration() const
{
  return body_->getCOMSpatialAcceleration();
}

Eigen::Vector3d BodyNodeHandle::linear_velocity(const Eigen::Vector3d* offset) const
{
  const BodyNode& body = moving();
  return offset == nullptr ? body.getLinearVelocity() : velocity_at(body, *offset);
}

Eigen::Vector3d BodyNodeHandle::linear_acceleration(const Eigen::Vector3d* offset) const
{
  return offset == nullptr ? body_->getLinearAcceleration() : body_->getLinearAcceleration(*offset);
}

Eigen::Vector3d BodyNodeHandle::angular_velocity() const
{
  return moving().getAngularVelocity();
}

Eigen::Vector3d BodyNodeHandle::angular_acceleration() const
{
  return body_->getAngularAcceleration();
}

Vector6d BodyNodeHandle::spatial_velocity(const Eigen::Vector3d* offset) const
{
  using dart::dynamics::Frame;
  return moving().getSpatialVelocity(offset == nullptr ? origin : *offset, Frame::World(), Frame::World());
}

Vector6d BodyNodeHandle::spatial_acceleration(const Eigen::Vector3d* offset) const
{
  using dart::dynamics::Frame;
  return body_->getSpatialAcceleration(offset == nullptr ? origin : *offset, Frame::World(), Frame::World());
}

Eigen::Vector3d BodyNodeHandle::linear_momentum() const
{
  return moving().getLinearMomentum();
}

Eigen::Vector3d BodyNodeHandle::angular_momentum() const
{
  return moving().getAngularMomentum();
}

void BodyNodeHandle::add_ext_force(
    const Eigen::Vector3d& force, const Eigen::Vector3d& offset, bool force_local, bool offset_local)
{
  check::finite(force, "force");
  check::finite(offset, "offset");
  body_.get_to_push(!force.isZero(0.0))->addExtForce(force, offset, force_local, offset_local);
}

void BodyNodeHandle::set_ext_force(
    const Eigen::Vector3d& force, const Eigen::Vector3d& offset, bool force_local, bool offset_local)
{
  check::finite(force, "force");
  check::finite(offset, "offset");
  body_.get_to_push(!force.isZero(0.0))->setExtForce(force, offset, force_local, offset_local);
}

void BodyNodeHandle::add_ext_torque(const Eigen::Vector3d& torque, bool local)
{
  check::finite(torque, "torque");
  body_.get_to_push(!torque.isZero(0.0))->addExtTorque(torque, local);
}

void BodyNodeHandle::set_ext_torque(const Eigen::Vector3d& torque, bool local)
{
  check::finite(torque, "torque");
  body_.get_to_push(!torque.isZero(0.0))->setExtTorque(torque, local);
}

template <class Columns>
void BodyNodeHandle::write(const BodyNode& body, const Columns& dependent, bool full, Output& out) const
{
  if (!full) {
    matrix(out, dependent.rows(), dependent.cols()) = dependent;
    return;
  }
  auto J = matrix(out, dependent.rows(), static_cast<long>(body_.skeleton->skeleton->getNumDofs()));
  J.setZero();
  const auto& dofs = body.getDependentGenCoordIndices();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    J.col(static_cast<long>(dofs[i])) = dependent.col(static_cast<long>(i));
}

void BodyNodeHandle::jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const
{
  const BodyNode& body = *body_;
  if (offset == nullptr)
    write(body, body.getJacobian(), full, into);
  else
    write(body, body.getJacobian(*offset), full, into);
}

void BodyNodeHandle::world_jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const
{
  const BodyNode& body = *body_;
  if (offset == nullptr)
    write(body, body.getWorldJacobian(), full, into);
  else
    write(body, body.getWorldJacobian(*offset), full, into);
}

void BodyNodeHandle::linear_jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const
{
  const BodyNode& body = *body_;
  if (offset == nullptr)
    write(body, body.getWorldJacobian().bottomRows<3>(), full, into);
  else
    write(body, body.getLinearJacobian(*offset), full, into);
}

void BodyNodeHandle::angular_jacobian(bool full, Output& into) const
{
  const BodyNode& body = *body_;
  write(body, body.getWorldJacobian().topRows<3>(), full, into);
}

void BodyNodeHandle::linear_jacobian_deriv(const Eigen::Vector3d* offset, bool full, Output& into) const
{
  const BodyNode& body = *body_;
  write(body, body.getLinearJacobianDeriv(offset == nullptr ? origin : *offset), full, into);
}

void BodyNodeHandle::world_jacobian_classic_deriv(const Eigen::Vector3d* offset, bool full, Output& into) const
{
  const BodyNode& body = *body_;
  write(body, body.getJacobianClassicDeriv(offset == nullptr ? origin : *offset), full, into);
}

void BodyNodeHandle::angular_jacobian_deriv(bool full, Output& into) const
{
  const BodyNode& body = *body_;
  write(body, body.getAngularJacobianDeriv(), full, into);
}

} // namespace pydart2
