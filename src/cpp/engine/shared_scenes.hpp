#pragma once

#include <assimp/scene.h>

#include <string>

namespace pydart2 {

/// From now on the engine imports a file of meshes once, and all shapes in all worlds that are made from it have the
/// same scene, which nobody changes. As long as one of them lives and the file stays as it is, it is not imported again.
///
/// What an importer leaves of lines and points is taken out: the engine takes each face for a triangle.
///
/// A file under the URI mirror-xz:///path comes mirrored along x and z, with its triangles turned so that they face as
/// before: the engine takes no scale below zero.
///
/// The engine's own calls of MeshShape::loadMesh() and aiReleaseImport() are redirected. False if it has none.
bool share_scenes();

/// The scheme of a mirrored mesh's URI, without the colon; empty if it is not one.
std::string mirror_scheme(const std::string& uri);

/// Whether a scene is shared. Then one more owner has it, and frees it as its own, as dart::dynamics::MeshShape does.
bool take_scene(const aiScene* scene);

} // namespace pydart2
