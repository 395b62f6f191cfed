#pragma once

#include <assimp/scene.h>

namespace pydart2 {

/// From now on the engine imports a file of meshes once, and all shapes in all worlds that are made from it have the
/// same scene, which nobody changes. As long as one of them lives and the file stays as it is, it is not imported again.
///
/// What an importer leaves of lines and points is taken out: the engine takes each face for a triangle.
///
/// The engine's own calls of MeshShape::loadMesh() and aiReleaseImport() are redirected. False if it has none.
bool share_scenes();

/// Whether a scene is shared. Then one more owner has it, and frees it as its own, as dart::dynamics::MeshShape does.
bool take_scene(const aiScene* scene);

} // namespace pydart2
