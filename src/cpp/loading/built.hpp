#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <string>

#include "base/arrays.hpp"
#include "loading/built_skin.hpp"

/// Skeletons that are built in code, and those that a user has given other bodies or shapes than their file.
namespace pydart2::built {

/// The bodies, joints, shapes and markers, without the numbers that visit_model() brings: a text that skeleton_of()
/// makes them of again. ValueError for what has no such text.
std::string structure_of(const dart::dynamics::Skeleton& skeleton);

dart::dynamics::SkeletonPtr skeleton_of(const std::string& structure);

/// What a new body hangs from its parent by. The axes are as many unit vectors as the type has: one for revolute,
/// prismatic and screw joints, two for universal, planar and two-dimensional translational ones.
struct NewJoint
{
  std::string type; ///< The engine's name, as "RevoluteJoint".
  std::string name;
  std::vector<Eigen::Vector3d> axes;
};

/// Axes as rows; ValueError for what are none.
NewJoint new_joint(const std::string& type, const std::string& name, const MatrixIn& axes);

/// A body without mass, and a soft one if there is a skin, whose shape then is its first; the parent is null for the
/// world. ValueError for an unknown type or a wrong number of axes.
dart::dynamics::BodyNode& add_body(
    dart::dynamics::Skeleton& skeleton,
    dart::dynamics::BodyNode* parent,
    const std::string& name,
    const NewJoint& joint,
    const Skin* skin = nullptr);

/// To be called before a body gets another parent, or none. The engine (6.13) takes the body out of its tree and then
/// marks in that tree's memory, which it has no more, that the body has moved; not if the body knows that already.
void about_to_move(dart::dynamics::BodyNode& body);

/// The body, with all that hangs from it, under another parent, of this or another skeleton; else as add_body().
void hang(
    dart::dynamics::Skeleton& skeleton,
    dart::dynamics::BodyNode* parent,
    dart::dynamics::BodyNode& body,
    const NewJoint& joint);

/// A shape of a type with its sizes: box, ellipsoid, pyramid three; cylinder, capsule, cone radius and height; sphere
/// one; plane normal and offset; hull of spheres four a sphere. Null for other types.
dart::dynamics::ShapePtr make_shape(const std::string& type, const std::vector<double>& sizes);

/// A mesh of its own: corners and triangles of their indices, row by row.
dart::dynamics::ShapePtr make_mesh(const std::vector<double>& vertices, const std::vector<double>& triangles);

/// Heights above the shape's xy plane, row 0 at the greatest y; the distances of rows and columns are the scale.
dart::dynamics::ShapePtr make_heightfield(const MatrixIn& heights, const Eigen::Vector3d& scale);

/// What a shape is for.
enum Purpose { visual = 1, collision = 2, dynamics = 4 };

dart::dynamics::ShapeNode& add_shape(
    dart::dynamics::BodyNode& body, const dart::dynamics::ShapePtr& shape, const std::string& name, int purposes);

} // namespace pydart2::built
