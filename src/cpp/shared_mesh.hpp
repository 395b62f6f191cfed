#pragma once

#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <memory>

namespace pydart2 {

/// A mesh over what another one has imported from its file. Bounds, volume and version are its own: the engine computes
/// them when they are first asked for, without a lock.
class SharedMesh : public dart::dynamics::MeshShape
{
public:
  using Owner = std::shared_ptr<const dart::dynamics::MeshShape>;

  SharedMesh(
      const Eigen::Vector3d& scale,
      Owner owner,
      const dart::common::Uri& uri = "",
      dart::common::ResourceRetrieverPtr retriever = nullptr);
  ~SharedMesh() override;

  /// The same mesh, of no file.
  std::shared_ptr<const SharedMesh> copy() const;

private:
  const Owner owner_;
};

/// Lets the meshes of a skeleton share with all others of this process what was imported from the same file, if it is
/// the same to the bit. For skeletons in which nothing has been changed yet.
void share_meshes(dart::dynamics::Skeleton& skeleton);

} // namespace pydart2
