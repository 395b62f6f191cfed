#include "fcl_detector.hpp"

#include <dart/collision/fcl/FCLCollisionObject.hpp>
#include <dart/dynamics/ShapeFrame.hpp>
#include <map>
#include <mutex>
#include <tuple>

#include "shared_mesh.hpp"

namespace pydart2 {

using namespace dart::collision;
using dart::dynamics::ConstShapePtr;
using dart::dynamics::ShapeFrame;

namespace {

using Geometry = dart::collision::fcl::CollisionGeometry;
using Volume = ::fcl::OBBRSS<double>;
using Tree = ::fcl::BVHModel<Volume>;

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

std::shared_ptr<const Tree> make_tree(const ConstShapePtr& mesh)
{
  const auto made = std::make_shared<Made>();
  made->geometry = made->maker.claimFCLCollisionGeometry(mesh);
  return {made, static_cast<const Tree*>(made->geometry.get())};
}

/// The tree of a mesh, kept as long as any world uses it.
std::shared_ptr<const Tree> tree_of(const SharedMesh& mesh)
{
  using Key = std::tuple<const aiScene*, double, double, double>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const Tree>> known;
  const auto& scale = mesh.getScale();
  const std::lock_guard lock(mutex);
  auto& entry = known[{mesh.getMesh(), scale.x(), scale.y(), scale.z()}];
  auto tree = entry.lock();
  if (tree)
    return tree;
  tree = make_tree(mesh.copy());
  entry = tree;
  for (auto it = known.begin(); it != known.end();)
    it = it->second.expired() ? known.erase(it) : std::next(it);
  return tree;
}

class Object : public FCLCollisionObject
{
public:
  Object(CollisionDetector* detector, const ShapeFrame* frame, const std::shared_ptr<Geometry>& geometry)
    : FCLCollisionObject(detector, frame, geometry)
  {
  }

  void set_geometry(const std::shared_ptr<Geometry>& geometry)
  {
    mFCLCollisionObject = std::make_unique<dart::collision::fcl::CollisionObject>(geometry);
    mFCLCollisionObject->setUserData(this);
  }
};

} // namespace

std::shared_ptr<FclDetector> FclDetector::create()
{
  return std::shared_ptr<FclDetector>(new FclDetector());
}

std::shared_ptr<CollisionDetector> FclDetector::cloneWithoutCollisionObjects() const
{
  return create();
}

std::unique_ptr<CollisionObject> FclDetector::createCollisionObject(const ShapeFrame* frame)
{
  return std::make_unique<Object>(this, frame, geometry(frame->getShape()));
}

void FclDetector::refreshCollisionObject(CollisionObject* object)
{
  static_cast<Object*>(object)->set_geometry(geometry(object->getShape()));
}

std::shared_ptr<Geometry> FclDetector::geometry(const ConstShapePtr& shape)
{
  if (const auto* mesh = dynamic_cast<const SharedMesh*>(shape.get()))
    return std::make_shared<BorrowedTree>(tree_of(*mesh));
  return claimFCLCollisionGeometry(shape);
}

} // namespace pydart2
