#pragma once

#include <array>
#include <dart/collision/Contact.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <vector>

#include "collision/native_scene.hpp"
#include "dynamics/free_bodies.hpp"

namespace pydart2 {

/// What the engine's contact constraint makes of a contact between rigid bodies, without making one.
struct ContactTerms
{
  dart::collision::Contact* contact;
  const native::Touch* touch = nullptr; ///< If the native detector found it.
  std::array<dart::dynamics::BodyNode*, 2> bodies;
  std::array<int, 2> free{-1, -1}; ///< Their places among the free bodies.
  Eigen::Vector3d first_direction;           ///< Of friction, of length 1.
  std::array<Eigen::Vector3d, 3> directions; ///< The normal and two tangents, of the world.
  std::array<double, 2> friction{0.0, 0.0}; ///< Coefficients along the tangents.
  std::array<double, 2> slip{0.0, 0.0}; ///< Compliance along the tangents, m/(N s).
  double restitution = 0.0;
  double depth = 0.0; ///< Of which something is taken away, m.

  bool has_friction() const;
  bool bounces() const;
};

/// Reads contacts one after the other; what it knows of the shapes of the last one serves the next, and what it knows of
/// those of the native detector the next step.
class ContactReader
{
public:
  /// A step; `same` if nothing has changed since the one before.
  void begin(bool same, const FreeBodies* free);

  /// `touch` of the native detector, or null.
  ContactTerms read(dart::collision::Contact& contact, const native::Touch* touch);

private:
  struct Shape
  {
    bool known = false;
    int free = -1;
    const dart::collision::CollisionObject* object = nullptr;
    dart::dynamics::BodyNode* body = nullptr;
    std::array<double, 2> friction{1.0, 1.0}, slip{0.0, 0.0};
    double restitution = 0.0;
    Eigen::Vector3d first_direction = Eigen::Vector3d::Zero(); ///< Of friction, in the world; zero: any.
  };

  Shape shape(const dart::collision::CollisionObject& object) const;
  const Shape& of_side(std::size_t side, const dart::collision::CollisionObject& object);
  const Shape& of_item(int item, const dart::collision::CollisionObject& object);

  const FreeBodies* free_ = nullptr;
  std::array<Shape, 2> shapes_;
  std::vector<Shape> items_; ///< Of the native scene.
};

/// The engine's slip compliance is per pair of shapes, not per contact.
void share_slip(std::vector<ContactTerms>& contacts);

/// Right-hand side of the engine: how fast bodies that come nearer at `approach` (m/s) shall part.
double parting_speed(const ContactTerms& contact, double approach, double correction);

/// The velocity with which the engine takes depth away.
double engine_correction(double depth, double time_step);

} // namespace pydart2
