#include "state/model_joints.hpp"

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/EulerJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ScrewJoint.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <cmath>

#include "base/checks.hpp"

namespace pydart2 {

using namespace dart::dynamics;

namespace {

using Dof = DegreeOfFreedom;

constexpr struct
{
  double (Dof::*get)() const;
  void (Dof::*set)(double);
  void (*check)(double, const char*);
} dof_numbers[] = {
    {&Dof::getPositionLowerLimit, &Dof::setPositionLowerLimit, check::lower_limit},
    {&Dof::getPositionUpperLimit, &Dof::setPositionUpperLimit, check::upper_limit},
    {&Dof::getInitialPosition, &Dof::setInitialPosition, check::finite},
    {&Dof::getVelocityLowerLimit, &Dof::setVelocityLowerLimit, check::lower_limit},
    {&Dof::getVelocityUpperLimit, &Dof::setVelocityUpperLimit, check::upper_limit},
    {&Dof::getInitialVelocity, &Dof::setInitialVelocity, check::finite},
    {&Dof::getForceLowerLimit, &Dof::setForceLowerLimit, check::lower_limit},
    {&Dof::getForceUpperLimit, &Dof::setForceUpperLimit, check::upper_limit},
    {&Dof::getSpringStiffness, &Dof::setSpringStiffness, check::not_negative},
    {&Dof::getRestPosition, &Dof::setRestPosition, check::finite},
    {&Dof::getDampingCoefficient, &Dof::setDampingCoefficient, check::not_negative},
    {&Dof::getCoulombFriction, &Dof::setCoulombFriction, check::not_negative},
};

/// A number that stands for one of `count` things.
template <class Enum>
Enum one_of(double value, int count)
{
  if (!(value >= 0.0 && value < count) || value != std::floor(value))
    Archive::refuse();
  return static_cast<Enum>(static_cast<int>(value));
}

Eigen::Matrix<double, 12, 1> rows_of(const Eigen::Isometry3d& transform)
{
  const Eigen::Matrix<double, 3, 4> rows = transform.matrix().topRows<3>();
  return Eigen::Map<const Eigen::Matrix<double, 12, 1>>(rows.data());
}

Eigen::Isometry3d transform_of(const Eigen::VectorXd& rows)
{
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(rows.data());
  check::rigid(transform.matrix(), "the place of a joint");
  return transform;
}

template <class Get, class Set>
void visit_axis(Archive& archive, Get get, Set set)
{
  archive.vector(get, [&](const Eigen::VectorXd& axis) {
    check::direction(axis, "the axis of a joint");
    set(before_normalizing(axis));
  });
}

void visit_axes(Archive& archive, Joint& any)
{
  if (auto* joint = dynamic_cast<RevoluteJoint*>(&any))
    visit_axis(archive, [&] { return joint->getAxis(); }, [&](const auto& axis) { joint->setAxis(axis); });
  if (auto* joint = dynamic_cast<PrismaticJoint*>(&any))
    visit_axis(archive, [&] { return joint->getAxis(); }, [&](const auto& axis) { joint->setAxis(axis); });
  if (auto* joint = dynamic_cast<ScrewJoint*>(&any)) {
    visit_axis(archive, [&] { return joint->getAxis(); }, [&](const auto& axis) { joint->setAxis(axis); });
    archive.number(
        [&] { return joint->getPitch(); },
        [&](double pitch) {
          check::finite(pitch, "the pitch of a joint");
          joint->setPitch(pitch);
        });
  }
  if (auto* joint = dynamic_cast<UniversalJoint*>(&any)) { // its setters do not normalize
    const auto checked = [](const Eigen::Vector3d& axis) {
      check::direction(axis, "the axis of a joint");
      return axis;
    };
    archive.vector([&] { return joint->getAxis1(); }, [&](const auto& axis) { joint->setAxis1(checked(axis)); });
    archive.vector([&] { return joint->getAxis2(); }, [&](const auto& axis) { joint->setAxis2(checked(axis)); });
  }
  if (auto* joint = dynamic_cast<EulerJoint*>(&any))
    archive.number(
        [&] { return static_cast<double>(joint->getAxisOrder()); },
        [&](double order) { joint->setAxisOrder(one_of<EulerJoint::AxisOrder>(order, 2), false); });
}

void visit_mimic(Archive& archive, Skeleton& skeleton, Joint& joint)
{
  const Joint* other = joint.getMimicJoint();
  const auto index = archive.count(other == nullptr ? 0 : other->getJointIndexInSkeleton() + 1); // 0 is none
  double multiplier = joint.getMimicMultiplier(), offset = joint.getMimicOffset();
  archive.number([&] { return multiplier; }, [&](double value) { multiplier = value; });
  archive.number([&] { return offset; }, [&](double value) { offset = value; });
  if (index > skeleton.getNumJoints())
    Archive::refuse();
  check::finite(multiplier, "a mimic multiplier");
  check::finite(offset, "a mimic offset");
  const Joint* const saved = index == 0 ? nullptr : skeleton.getJoint(index - 1);
  if (saved == &joint || (saved != nullptr && saved->getNumDofs() != joint.getNumDofs()))
    Archive::refuse();
  if (archive.is_in())
    joint.setMimicJoint(index == 0 ? nullptr : skeleton.getJoint(index - 1), multiplier, offset);
}

void visit_joint(Archive& archive, Skeleton& skeleton, Joint& joint)
{
  archive.same(joint.getType());
  archive.vector(
      [&] { return rows_of(joint.getTransformFromParentBodyNode()); },
      [&](const auto& rows) { joint.setTransformFromParentBodyNode(transform_of(rows)); });
  archive.vector(
      [&] { return rows_of(joint.getTransformFromChildBodyNode()); },
      [&](const auto& rows) { joint.setTransformFromChildBodyNode(transform_of(rows)); });
  visit_axes(archive, joint);
  visit_mimic(archive, skeleton, joint);
  archive.number(
      [&] { return static_cast<double>(joint.getActuatorType()); },
      [&](double type) {
        const auto actuator = one_of<Joint::ActuatorType>(type, Joint::LOCKED + 1);
        if (actuator == Joint::MIMIC && joint.getMimicJoint() == nullptr)
          Archive::refuse();
        joint.setActuatorType(actuator);
      });
  archive.number(
      [&] { return double(joint.areLimitsEnforced()); }, [&](double on) { joint.setLimitEnforcement(on != 0.0); });
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i) {
    auto& dof = *joint.getDof(i);
    for (const auto& number : dof_numbers)
      archive.number(
          [&] { return (dof.*number.get)(); },
          [&](double value) {
            number.check(value, "a number of a dof");
            (dof.*number.set)(value);
          });
    archive.number([&] { return double(dof.isNamePreserved()); }, [&](double on) { dof.preserveName(on != 0.0); });
  }
}

/// The engine evades names that are taken, so all are freed before the first is given.
void visit_names(Archive& archive, Skeleton& skeleton)
{
  std::vector<std::string> names;
  for (const auto* joint : skeleton.getJoints())
    names.push_back(joint->getName());
  for (const auto* dof : skeleton.getDofs())
    names.push_back(dof->getName());
  bool changed = false;
  for (auto& name : names)
    archive.text([&] { return name; }, [&](const std::string& value) { name = value, changed = true; });
  if (!changed)
    return;
  const auto rename = [&](auto name_of) {
    std::size_t i = 0;
    for (auto* joint : skeleton.getJoints())
      joint->setName(name_of(i++), false);
    for (auto* dof : skeleton.getDofs())
      dof->setName(name_of(i++), dof->isNamePreserved());
  };
  rename([](std::size_t i) { return "\x01 " + std::to_string(i); });
  rename([&](std::size_t i) { return names[i]; });
}

} // namespace

void visit_joints(Archive& archive, Skeleton& skeleton)
{
  for (auto* joint : skeleton.getJoints())
    visit_joint(archive, skeleton, *joint);
  visit_names(archive, skeleton);
}

Eigen::Vector3d before_normalizing(const Eigen::Vector3d& unit)
{
  for (int i = 0; i < 4096; ++i)
    if (const Eigen::Vector3d longer = unit * (1.0 + i / 4096.0); longer.normalized() == unit)
      return longer;
  return unit;
}

} // namespace pydart2
