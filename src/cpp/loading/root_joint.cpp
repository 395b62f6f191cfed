#include "loading/root_joint.hpp"

#include <dart/dynamics/EulerJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>

namespace pydart2 {

using namespace dart::dynamics;

namespace {

/// The old joint's frames: at q = 0 the skeleton stands where it stood.
template <class Properties>
Properties with_frames(const Joint& parent, const Joint& child, const std::string& name)
{
  Properties properties;
  properties.mName = name;
  properties.mT_ParentBodyToJoint = parent.getTransformFromParentBodyNode();
  properties.mT_ChildBodyToJoint = child.getTransformFromChildBodyNode();
  return properties;
}

} // namespace

void change_root_to_trans_and_euler(Skeleton& skeleton)
{
  BodyNode* old_root = skeleton.getRootBodyNode();
  const Joint& joint = *old_root->getParentJoint();
  auto translation = with_frames<TranslationalJoint::Properties>(joint, joint, "root_t");
  auto rotation = with_frames<EulerJoint::Properties>(joint, joint, "root_r");
  translation.mT_ChildBodyToJoint.setIdentity();
  rotation.mT_ParentBodyToJoint.setIdentity();
  BodyNode* root = skeleton.createJointAndBodyNodePair<TranslationalJoint>(nullptr, translation).second;
  root->setMass(0.0);
  old_root->moveTo<EulerJoint>(root, rotation);
}

void change_root_to_weld(Skeleton& skeleton)
{
  BodyNode* root = skeleton.getRootBodyNode();
  const Joint& joint = *root->getParentJoint();
  root->changeParentJointType<WeldJoint>(with_frames<WeldJoint::Properties>(joint, joint, joint.getName()));
}

void change_root_to_free(Skeleton& skeleton)
{
  BodyNode* root = skeleton.getRootBodyNode();
  const Eigen::VectorXd stands = FreeJoint::convertToPositions(root->getWorldTransform());
  FreeJoint::Properties properties;
  properties.mName = root->getParentJoint()->getName();
  auto* joint = root->changeParentJointType<FreeJoint>(properties);
  joint->setPositions(stands);
  joint->setInitialPositions(stands);
}

} // namespace pydart2
