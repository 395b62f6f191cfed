#include "collision/fcl_detector.hpp"

#include <cstring>
#include <dart/collision/fcl/FCLCollisionGroup.hpp>
#include <dart/collision/fcl/FCLCollisionObject.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PointMass.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/ShapeFrame.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <dart/dynamics/SoftMeshShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/fork.hpp"
#include "collision/fcl_skin.hpp"
#include "engine/protected_members.hpp"
#include "engine/shared_scenes.hpp"

namespace pydart2 {

using namespace dart::collision;
using namespace dart::dynamics;

namespace {

using Geometry = dart::collision::fcl::CollisionGeometry;
using Tree = SkinTree;

void borrow_nodes(Tree& tree, const Tree& lender);
void return_nodes(Tree& tree);

// An explicit instantiation may name private members, as in engine_access.cpp.
template <auto nodes, auto num_nodes>
struct Reveal
{
  friend void borrow_nodes(Tree& tree, const Tree& lender)
  {
    tree.*nodes = lender.*nodes;
    tree.*num_nodes = lender.*num_nodes;
  }

  friend void return_nodes(Tree& tree) { tree.*nodes = nullptr; }
};
template struct Reveal<&Tree::bvs, &Tree::num_bvs>;

/// A tree with the triangles and nodes of another one. FCL only reads those; what it writes when it makes an object, the
/// bounds, each has for itself.
class BorrowedTree : public Tree
{
public:
  explicit BorrowedTree(std::shared_ptr<const Tree> lender) : lender_(std::move(lender))
  {
    vertices = lender_->vertices;
    tri_indices = lender_->tri_indices;
    num_vertices = lender_->num_vertices;
    num_tris = lender_->num_tris;
    build_state = lender_->build_state;
    borrow_nodes(*this, *lender_);
  }

  ~BorrowedTree() override
  {
    vertices = nullptr; // the base class would free them
    tri_indices = nullptr;
    return_nodes(*this);
  }

private:
  std::shared_ptr<const Tree> lender_;
};

/// The engine's detector, to make a tree with.
struct Maker : FCLCollisionDetector
{
  using FCLCollisionDetector::claimFCLCollisionGeometry;
};

/// A tree as the engine makes it, which is known to a detector as long as it lives.
struct Made
{
  Maker maker;
  std::shared_ptr<Geometry> geometry; // goes first
};

/// With as many triangles as the engine's cones have.
std::shared_ptr<const Tree> make_cone(const ConeShape& shape)
{
  auto tree = std::make_shared<Tree>();
  const ::fcl::Cone<double> cone(shape.getRadius(), shape.getHeight());
  ::fcl::generateBVHModel(*tree, cone, ::fcl::Transform3<double>::Identity(), 16, 16);
  return tree;
}

std::shared_ptr<const Tree> make_pyramid(const PyramidShape& shape)
{
  const double x = shape.getBaseWidth() / 2, y = shape.getBaseDepth() / 2, z = shape.getHeight() / 2;
  const std::vector<Eigen::Vector3d> corners{{0.0, 0.0, z}, {-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z}};
  const std::vector<::fcl::Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 3, 2}, {1, 4, 3}};
  auto tree = std::make_shared<Tree>();
  tree->beginModel();
  tree->addSubModel(corners, faces);
  tree->endModel();
  return tree;
}

std::shared_ptr<const Tree> make_tree(const ConstShapePtr& shape)
{
  if (const auto* cone = dynamic_cast<const ConeShape*>(shape.get()))
    return make_cone(*cone);
  if (const auto* pyramid = dynamic_cast<const PyramidShape*>(shape.get()))
    return make_pyramid(*pyramid);
  const auto made = std::make_shared<Made>();
  made->geometry = made->maker.claimFCLCollisionGeometry(shape);
  return {made, static_cast<const Tree*>(made->geometry.get())};
}

/// A tree over the points at rest. Each step moves its triangles and fits its nodes, but which triangle is in which node
/// stays: it does not depend on when the tree was made.
std::shared_ptr<Tree> make_soft(const SoftBodyNode& body)
{
  auto tree = std::make_shared<Tree>();
  tree->beginModel();
  for (std::size_t i = 0; i < body.getNumFaces(); ++i) {
    const auto corner = [&](int k) -> ::fcl::Vector3<double> {
      const auto& at = body.getPointMass(static_cast<std::size_t>(body.getFace(i)[k]))->getRestingPosition();
      return at.cast<float>().cast<double>(); // as Assimp keeps them
    };
    tree->addTriangle(corner(0), corner(1), corner(2));
  }
  tree->endModel();
  return tree;
}

/// All that the engine makes a tree of: kind of shape, imported file, sizes.
using Recipe = std::tuple<std::string, const aiScene*, double, double, double>;

/// The recipe of a shape, and a shape for it that belongs to no world; null for shapes that share no tree. The
/// detector's type tells what it makes of boxes and round shapes.
std::pair<Recipe, ConstShapePtr> recipe_of(const Shape& shape, FCLCollisionDetector::PrimitiveShape type)
{
  const auto recipe = [&](const Eigen::Vector3d& sizes, const aiScene* scene = nullptr) {
    return Recipe(shape.getType(), scene, sizes.x(), sizes.y(), sizes.z());
  };
  if (const auto* mesh = dynamic_cast<const MeshShape*>(&shape)) {
    if (!take_scene(mesh->getMesh()))
      return {};
    return {recipe(mesh->getScale(), mesh->getMesh()), std::make_shared<MeshShape>(mesh->getScale(), mesh->getMesh())};
  }
  if (const auto* pyramid = dynamic_cast<const PyramidShape*>(&shape)) {
    const Eigen::Vector3d sizes(pyramid->getBaseWidth(), pyramid->getBaseDepth(), pyramid->getHeight());
    return {recipe(sizes), std::make_shared<PyramidShape>(sizes.x(), sizes.y(), sizes.z())};
  }
  if (type != FCLCollisionDetector::MESH)
    return {};
  if (const auto* box = dynamic_cast<const BoxShape*>(&shape))
    return {recipe(box->getSize()), std::make_shared<BoxShape>(box->getSize())};
  if (const auto* ellipsoid = dynamic_cast<const EllipsoidShape*>(&shape))
    return {recipe(ellipsoid->getDiameters()), std::make_shared<EllipsoidShape>(ellipsoid->getDiameters())};
  if (const auto* sphere = dynamic_cast<const SphereShape*>(&shape))
    return {recipe({sphere->getRadius(), 0.0, 0.0}), std::make_shared<SphereShape>(sphere->getRadius())};
  if (const auto* cylinder = dynamic_cast<const CylinderShape*>(&shape)) {
    const double radius = cylinder->getRadius(), height = cylinder->getHeight();
    return {recipe({radius, height, 0.0}), std::make_shared<CylinderShape>(radius, height)};
  }
  if (const auto* cone = dynamic_cast<const ConeShape*>(&shape)) {
    const double radius = cone->getRadius(), height = cone->getHeight();
    return {recipe({radius, height, 0.0}), std::make_shared<ConeShape>(radius, height)};
  }
  return {};
}

/// The trees of all worlds, each kept as long as one uses it.
class Forest
{
public:
  std::shared_ptr<const Tree> tree(const Recipe& recipe, const ConstShapePtr& shape)
  {
    if (auto found = find(recipe))
      return found;
    const auto made = make_tree(shape); // without the lock: another thread may make the same meanwhile
    const std::lock_guard lock(mutex_);
    trees_[recipe] = made;
    if (trees_.size() > clear_above_)
      clear();
    return made;
  }

private:
  std::shared_ptr<const Tree> find(const Recipe& recipe)
  {
    const std::lock_guard lock(mutex_);
    const auto found = trees_.find(recipe);
    return found == trees_.end() ? nullptr : found->second.lock();
  }

  /// Forgets those that are gone; not at each new one, which would take long with many.
  void clear()
  {
    for (auto it = trees_.begin(); it != trees_.end();)
      it = it->second.expired() ? trees_.erase(it) : std::next(it);
    clear_above_ = 2 * trees_.size() + 100;
  }

  HeldOverFork<std::mutex> mutex_{ForkOrder::innermost};
  std::map<Recipe, std::weak_ptr<const Tree>> trees_;
  std::size_t clear_above_ = 100;
};

Forest forest;

class Object : public FCLCollisionObject
{
public:
  Object(CollisionDetector* detector, const ShapeFrame* frame, const std::shared_ptr<Geometry>& geometry)
    : FCLCollisionObject(detector, frame, geometry), is_skin_(is_skin())
  {
  }

  void set_geometry(const std::shared_ptr<Geometry>& geometry)
  {
    mFCLCollisionObject = std::make_unique<dart::collision::fcl::CollisionObject>(geometry);
    mFCLCollisionObject->setUserData(this);
    is_skin_ = is_skin();
    placed_ = false;
  }

  void place() { updateEngineData(); }

protected:
  /// As the engine's, with less of what skins take. The engine's frame of the shape is not asked where it is, so that it need
  /// not keep that in its memory.
  void updateEngineData() override
  {
    if (is_skin_) {
      const auto& skin = static_cast<const SoftMeshShape&>(*getShape());
      const auto& geometry = *mFCLCollisionObject->collisionGeometry();
      move_skin(const_cast<Tree&>(static_cast<const Tree&>(geometry)), const_cast<SoftMeshShape&>(skin));
    }
    const auto& frame = *getShapeFrame();
    const Eigen::Isometry3d pose = frame.getParentFrame()->getWorldTransform() * frame.getRelativeTransform();
    const auto& before = mFCLCollisionObject->getTransform().matrix();
    if (!is_skin_ && placed_ && std::memcmp(pose.data(), before.data(), sizeof pose) == 0)
      return;
    placed_ = true;
    mFCLCollisionObject->setTransform(pose);
    mFCLCollisionObject->computeAABB();
  }

private:
  bool is_skin() const { return dynamic_cast<const SoftMeshShape*>(getShape().get()) != nullptr; }

  bool is_skin_;
  bool placed_ = false; ///< Where it was last asked to be, with its bounds there.
};

/// FCL balances a new tree at its first object, which moves on the place where the next balancing begins, and one that was
/// emptied not: its pairs would come in another order.
class Group : public FCLCollisionGroup
{
public:
  using FCLCollisionGroup::FCLCollisionGroup;

  /// The old tree goes before they are placed, for it would be fitted to where they are and balanced.
  void put_in_again()
  {
    removeAllCollisionObjectsFromEngine();
    for (const auto& info : mObjectInfoList)
      static_cast<Object&>(*info->mObject).place();
    for (const auto& info : mObjectInfoList)
      addCollisionObjectToEngine(info->mObject.get());
  }

protected:
  void removeAllCollisionObjectsFromEngine() override
  {
    FCLCollisionGroup::removeAllCollisionObjectsFromEngine();
    emptied_ = true;
  }

  void addCollisionObjectToEngine(CollisionObject* object) override
  {
    FCLCollisionGroup::addCollisionObjectToEngine(object);
    if (std::exchange(emptied_, false))
      updateCollisionGroupEngineData();
  }

private:
  bool emptied_ = false;
};

bool names_no_face(const CollisionObject& object, int face)
{
  const auto* skin = dynamic_cast<const SoftMeshShape*>(object.getShape().get());
  return skin != nullptr && (face < 0 || static_cast<std::size_t>(face) >= skin->getSoftBodyNode()->getNumFaces());
}

/// FCL turns a pair of a simple shape and a mesh round; the engine then takes the one's face and normal for the other's.
void turn_back(CollisionResult& result)
{
  for (std::size_t i = 0; i < result.getNumContacts(); ++i) {
    auto& contact = result.getContact(i);
    if (names_no_face(*contact.collisionObject1, contact.triID1) || names_no_face(*contact.collisionObject2, contact.triID2)) {
      std::swap(contact.triID1, contact.triID2);
      contact.normal = -contact.normal;
    }
  }
}

bool fcl_does(ShapeKind a, ShapeKind b)
{
  const auto misses = [](ShapeKind kind) {
    return kind == ShapeKind::capsule || kind == ShapeKind::hull || kind == ShapeKind::plane || kind == ShapeKind::heightmap;
  };
  return !misses(a) && !misses(b);
}

} // namespace

FclDetector::FclDetector() : CompletedDetector(fcl_does) {}

std::shared_ptr<FclDetector> FclDetector::create()
{
  return std::shared_ptr<FclDetector>(new FclDetector());
}

std::shared_ptr<CollisionDetector> FclDetector::cloneWithoutCollisionObjects() const
{
  return create();
}

std::unique_ptr<CollisionGroup> FclDetector::createCollisionGroup()
{
  forget();
  return std::make_unique<Group>(shared_from_this());
}

bool FclDetector::collide(CollisionGroup* group, const CollisionOption& option, CollisionResult* result)
{
  if (option.maxNumContacts == 0)
    GroupMembers::update_engine_data(*group);
  const bool any = CompletedDetector::collide(group, option, result);
  if (result != nullptr && getPrimitiveShapeType() == PRIMITIVE)
    turn_back(*result);
  return any;
}

void FclDetector::put_in_again(CollisionGroup& group)
{
  dynamic_cast<Group&>(group).put_in_again();
}

std::unique_ptr<CollisionObject> FclDetector::createCollisionObject(const ShapeFrame* frame)
{
  forget();
  auto object = std::make_unique<Object>(this, frame, geometry(frame->getShape()));
  if (placed_at_once)
    object->place();
  return object;
}

void FclDetector::refreshCollisionObject(CollisionObject* object)
{
  forget();
  static_cast<Object*>(object)->set_geometry(geometry(object->getShape()));
}

std::shared_ptr<Geometry> FclDetector::geometry(const ConstShapePtr& shape)
{
  if (const auto [recipe, model] = recipe_of(*shape, getPrimitiveShapeType()); model)
    return std::make_shared<BorrowedTree>(forest.tree(recipe, model));
  if (const auto* soft = soft_at_rest ? dynamic_cast<const SoftMeshShape*>(shape.get()) : nullptr)
    return make_soft(*soft->getSoftBodyNode());
  return claimFCLCollisionGeometry(shape);
}

} // namespace pydart2
