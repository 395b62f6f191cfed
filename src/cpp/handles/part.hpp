#pragma once

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <string>
#include <type_traits>
#include <utility>

#include "base/errors.hpp"
#include "engine/protected_members.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// Owns a node of a body. The engine's own pointer lets go of the body first, and a node that goes as the last one takes
/// itself out of what the body was.
template <class Node>
class NodeOwner
{
public:
  explicit NodeOwner(Node* node) : body_(node->getBodyNodePtr()), node_(node) {}

  /// From its body, which it does not follow any more: the step knows what hangs on a body, and not when that is freed.
  void remove() const
  {
    node_->remove();
    HangingMembers::let_go(*node_);
  }

  void check() const
  {
    if (node_->isRemoved())
      throw Error(Kind::destroyed, "'" + node_->getName() + "' was removed from its body");
  }

private:
  dart::dynamics::BodyNodePtr body_;
  dart::dynamics::TemplateNodePtr<Node, dart::dynamics::BodyNode> node_;
};

/// A part of a skeleton (body, joint, dof ...) held by a smart pointer, so that it cannot dangle.
/// Every access first checks that the world is usable and that the tree is still the one this part was taken from.
template <class T, class Pointer>
class Part
{
public:
  Part(WorldRef world, SkeletonRef skeleton, T* part)
    : world(std::move(world)),
      skeleton(std::move(skeleton)),
      owner_(part),
      part_(part),
      structure_(this->skeleton->structure)
  {
  }

  T* get() const
  {
    world->check();
    if (skeleton->structure != structure_)
      throw Error(
          Kind::destroyed,
          "the tree of skeleton '" + skeleton->skeleton->getName()
              + "' has changed since this handle was made; take it from the skeleton again");
    if constexpr (std::is_same_v<Pointer, NodeOwner<T>>)
      owner_.check();
    return part_;
  }

  /// What may change the skeleton is a non-const method of a handle, and wakes it.
  T* get()
  {
    T* const part = std::as_const(*this).get();
    world->about_to_change(*skeleton);
    return part;
  }

  /// The same for a force, unless that is zero.
  T* get_to_push(bool pushes) { return pushes ? get() : std::as_const(*this).get(); }

  T* operator->() const { return get(); }
  T* operator->() { return get(); }
  T& operator*() const { return *get(); }
  T& operator*() { return *get(); }

  const WorldRef world;
  const SkeletonRef skeleton;

private:
  Pointer owner_;
  T* part_;
  int structure_;
};

} // namespace pydart2
