#include "loading/skeleton_copy.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <map>
#include <typeinfo>

#include "engine/shared_scenes.hpp"

namespace pydart2 {

namespace {

using namespace dart::dynamics;

ShapePtr copy_of_mesh(MeshShape& mesh)
{
  if (!take_scene(mesh.getMesh()))
    return nullptr;
  auto copy = std::make_shared<MeshShape>(mesh.getScale(), mesh.getMesh(), mesh.getMeshUri2(), mesh.getResourceRetriever());
  copy->setColorMode(mesh.getColorMode());
  copy->setAlphaMode(mesh.getAlphaMode());
  copy->setColorIndex(mesh.getColorIndex());
  return copy;
}

ShapePtr copy_of(Shape& shape)
{
  const auto& type = typeid(shape);
  if (type == typeid(MeshShape))
    return copy_of_mesh(static_cast<MeshShape&>(shape));
  if (type == typeid(BoxShape))
    return std::make_shared<BoxShape>(static_cast<BoxShape&>(shape).getSize());
  if (type == typeid(SphereShape))
    return std::make_shared<SphereShape>(static_cast<SphereShape&>(shape).getRadius());
  if (type == typeid(EllipsoidShape))
    return std::make_shared<EllipsoidShape>(static_cast<EllipsoidShape&>(shape).getDiameters());
  const auto with_height = [](auto& tall) {
    using Tall = std::decay_t<decltype(tall)>;
    return std::make_shared<Tall>(tall.getRadius(), tall.getHeight());
  };
  if (type == typeid(CylinderShape))
    return with_height(static_cast<CylinderShape&>(shape));
  if (type == typeid(CapsuleShape))
    return with_height(static_cast<CapsuleShape&>(shape));
  if (type == typeid(ConeShape))
    return with_height(static_cast<ConeShape&>(shape));
  if (type != typeid(PlaneShape))
    return nullptr;
  const auto& plane = static_cast<PlaneShape&>(shape);
  return std::make_shared<PlaneShape>(plane.getNormal(), plane.getOffset());
}

} // namespace

SkeletonPtr copy_of(const Skeleton& loaded)
{
  if (loaded.getNumSoftBodyNodes() > 0)
    return nullptr;
  const auto copy = loaded.cloneSkeleton();
  std::map<const Shape*, ShapePtr> copies; // the engine's copy has the same shapes
  for (auto* body : copy->getBodyNodes())
    for (auto* node : body->getShapeNodes()) {
      const auto shape = node->getShape();
      auto& own = copies[shape.get()];
      if (own == nullptr && shape != nullptr && (own = copy_of(*shape)) == nullptr)
        return nullptr;
      if (own == nullptr)
        continue;
      own->setDataVariance(shape->getDataVariance());
      node->setShape(own);
    }
  return copy;
}

} // namespace pydart2
