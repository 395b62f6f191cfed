#include "collision/ode_detector.hpp"

#include <assimp/scene.h>
#include <dart/collision/ode/OdeCollisionObject.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <new>
#include <utility>

#include "engine/ode_space.hpp"

namespace pydart2 {

using namespace dart::collision;

namespace {

/// The constructor is protected.
struct Object final : OdeCollisionObject
{
  Object(OdeCollisionDetector* detector, const dart::dynamics::ShapeFrame* frame) : OdeCollisionObject(detector, frame) {}
};
static_assert(sizeof(Object) == sizeof(OdeCollisionObject));

/// The engine reads the normals of a mesh for ODE, and dies where there are none. While one of these is alive there are.
class LentNormals
{
public:
  explicit LentNormals(const dart::dynamics::ShapeFrame& frame)
  {
    const auto* shape = dynamic_cast<const dart::dynamics::MeshShape*>(frame.getShape().get());
    const aiScene* scene = shape == nullptr ? nullptr : shape->getMesh();
    for (unsigned i = 0; scene != nullptr && i < scene->mNumMeshes; ++i)
      if (auto* mesh = scene->mMeshes[i]; mesh->mNormals == nullptr) {
        mesh->mNormals = new aiVector3D[mesh->mNumVertices];
        lent_.push_back(mesh);
      }
  }

  ~LentNormals()
  {
    for (auto* mesh : lent_)
      delete[] std::exchange(mesh->mNormals, nullptr);
  }

  LentNormals(const LentNormals&) = delete;
  LentNormals& operator=(const LentNormals&) = delete;

private:
  std::vector<aiMesh*> lent_;
};

bool ode_does(ShapeKind a, ShapeKind b)
{
  const auto misses = [](ShapeKind kind) {
    return kind == ShapeKind::ellipsoid || kind == ShapeKind::cone || kind == ShapeKind::pyramid || kind == ShapeKind::hull
           || kind == ShapeKind::heightmap;
  };
  return !misses(a) && !misses(b);
}

} // namespace

OdeDetector::OdeDetector() : CompletedDetector(ode_does)
{
  make_ode_throw();
}

std::shared_ptr<OdeDetector> OdeDetector::create()
{
  return std::shared_ptr<OdeDetector>(new OdeDetector());
}

std::shared_ptr<CollisionDetector> OdeDetector::cloneWithoutCollisionObjects() const
{
  return create();
}

bool OdeDetector::collide(CollisionGroup* group, const CollisionOption& option, CollisionResult* result)
{
  try {
    return CompletedDetector::collide(group, option, result);
  } catch (...) {
    unlock_ode_space(*group);
    throw;
  }
}

bool OdeDetector::collide(
    CollisionGroup* group1, CollisionGroup* group2, const CollisionOption& option, CollisionResult* result)
{
  try {
    return OdeCollisionDetector::collide(group1, group2, option, result);
  } catch (...) {
    unlock_ode_space(*group1);
    unlock_ode_space(*group2);
    throw;
  }
}

std::unique_ptr<CollisionObject> OdeDetector::createCollisionObject(const dart::dynamics::ShapeFrame* frame)
{
  const LentNormals normals(*frame);
  return CompletedDetector::createCollisionObject(frame);
}

void OdeDetector::refreshCollisionObject(CollisionObject* object)
{
  forget();
  const auto* frame = object->getShapeFrame();
  const LentNormals normals(*frame);
  const Object tried(this, frame); // if that throws, the old one is whole
  object->~CollisionObject();
  new (object) Object(this, frame);
}

} // namespace pydart2
