#include "handles/shape.hpp"

#include <algorithm>
#include <array>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/MultiSphereConvexHullShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "base/checks.hpp"
#include "engine/shared_scenes.hpp"
#include "handles/shape_kinds.hpp"

namespace pydart2 {

using namespace dart::dynamics;

namespace {

using WithRadius = OneOf<SphereShape, CylinderShape, CapsuleShape, ConeShape>;
using WithHeight = OneOf<CylinderShape, CapsuleShape, ConeShape, PyramidShape>;
using Spheres = OneOf<MultiSphereConvexHullShape>;

/// As the engine says, but for cones: there it adds the radius to half of the height.
dart::math::BoundingBox bounding_box(const Shape& shape)
{
  const auto* cone = dynamic_cast<const ConeShape*>(&shape);
  if (cone == nullptr)
    return shape.getBoundingBox();
  const Eigen::Vector3d half(cone->getRadius(), cone->getRadius(), cone->getHeight() / 2);
  return {-half, half};
}

} // namespace

ShapeHandle::ShapeHandle(const Node& node) : node_(node) {}

Shape& ShapeHandle::shape() const
{
  const ShapePtr shape = node_->getShape();
  if (!shape)
    throw Error(Kind::destroyed, "this shape node has no shape any more");
  return *shape; // the node keeps it
}

Shape& ShapeHandle::shape()
{
  node_.get();
  return std::as_const(*this).shape();
}

std::string ShapeHandle::type() const
{
  return shape().getType();
}

long ShapeHandle::id() const
{
  return static_cast<long>(shape().getID());
}

long ShapeHandle::version() const
{
  return static_cast<long>(shape().getVersion());
}

double ShapeHandle::volume() const
{
  return shape().getVolume();
}

Eigen::Vector3d ShapeHandle::bounding_box_min() const
{
  return bounding_box(shape()).getMin();
}

Eigen::Vector3d ShapeHandle::bounding_box_max() const
{
  return bounding_box(shape()).getMax();
}

double ShapeHandle::radius() const
{
  return with(shape(), "radius", WithRadius{}, [](auto& s) { return s.getRadius(); });
}

void ShapeHandle::set_radius(double radius)
{
  check::positive(radius, "radius");
  with(shape(), "radius", WithRadius{}, [&](auto& s) { s.setRadius(radius); });
}

double ShapeHandle::height() const
{
  return with(shape(), "height", WithHeight{}, [](auto& s) { return s.getHeight(); });
}

void ShapeHandle::set_height(double height)
{
  check::positive(height, "height");
  with(shape(), "height", WithHeight{}, [&](auto& s) { s.setHeight(height); });
}

Eigen::Vector3d ShapeHandle::size() const
{
  Shape& any = shape();
  if (auto* ellipsoid = dynamic_cast<EllipsoidShape*>(&any))
    return ellipsoid->getDiameters();
  return with(any, "size", OneOf<BoxShape>{}, [](auto& s) -> Eigen::Vector3d { return s.getSize(); });
}

void ShapeHandle::set_size(const Eigen::Vector3d& size)
{
  for (const double edge : {size.x(), size.y(), size.z()})
    check::positive(edge, "size");
  Shape& any = shape();
  if (auto* ellipsoid = dynamic_cast<EllipsoidShape*>(&any))
    ellipsoid->setDiameters(size);
  else
    with(any, "size", OneOf<BoxShape>{}, [&](auto& s) { s.setSize(size); });
}

double ShapeHandle::base_width() const
{
  return with(shape(), "base width", OneOf<PyramidShape>{}, [](auto& s) { return s.getBaseWidth(); });
}

void ShapeHandle::set_base_width(double width)
{
  check::positive(width, "base width");
  with(shape(), "base width", OneOf<PyramidShape>{}, [&](auto& s) { s.setBaseWidth(width); });
}

double ShapeHandle::base_depth() const
{
  return with(shape(), "base depth", OneOf<PyramidShape>{}, [](auto& s) { return s.getBaseDepth(); });
}

void ShapeHandle::set_base_depth(double depth)
{
  check::positive(depth, "base depth");
  with(shape(), "base depth", OneOf<PyramidShape>{}, [&](auto& s) { s.setBaseDepth(depth); });
}

Eigen::Vector3d ShapeHandle::normal() const
{
  return with(shape(), "normal", OneOf<PlaneShape>{}, [](auto& s) -> Eigen::Vector3d { return s.getNormal(); });
}

void ShapeHandle::set_normal(const Eigen::Vector3d& normal)
{
  check::direction(normal, "normal");
  with(shape(), "normal", OneOf<PlaneShape>{}, [&](auto& s) { s.setNormal(normal); });
}

double ShapeHandle::offset() const
{
  return with(shape(), "offset", OneOf<PlaneShape>{}, [](auto& s) { return s.getOffset(); });
}

void ShapeHandle::set_offset(double offset)
{
  check::finite(offset, "offset");
  with(shape(), "offset", OneOf<PlaneShape>{}, [&](auto& s) { s.setOffset(offset); });
}

int ShapeHandle::num_spheres() const
{
  return with(shape(), "spheres", Spheres{}, [](auto& s) { return static_cast<int>(s.getNumSpheres()); });
}

void ShapeHandle::spheres(Output& out) const
{
  with(shape(), "spheres", Spheres{}, [&](auto& s) {
    double* row = out.matrix(static_cast<long>(s.getNumSpheres()), 4);
    for (const auto& [radius, position] : s.getSpheres()) {
      *row++ = radius;
      row = std::copy(position.data(), position.data() + 3, row);
    }
  });
}

void ShapeHandle::add_sphere(double radius, const Eigen::Vector3d& position)
{
  check::positive(radius, "radius");
  check::finite(position, "position");
  with(shape(), "spheres", Spheres{}, [&](auto& s) { s.addSphere(radius, position); });
}

Eigen::Vector3d ShapeHandle::scale() const
{
  Shape& any = shape();
  if (auto* heightmap = dynamic_cast<HeightmapShaped*>(&any))
    return heightmap->getScale();
  if (auto* heightmap = dynamic_cast<HeightmapShapef*>(&any))
    return heightmap->getScale().cast<double>();
  return with(any, "scale", OneOf<MeshShape>{}, [](auto& s) -> Eigen::Vector3d { return s.getScale(); });
}

std::string ShapeHandle::path() const
{
  return with(shape(), "path", OneOf<MeshShape>{}, [](auto& s) { return s.getMeshPath(); });
}

std::string ShapeHandle::mirrored() const
{
  return with(shape(), "path", OneOf<MeshShape>{}, [](auto& mesh) {
    const std::string scheme = mirror_scheme(mesh.getMeshUri2().toString());
    return scheme.substr(scheme.empty() ? 0 : std::string("mirror-").size());
  });
}

ShapeNodeHandle::ShapeNodeHandle(WorldRef world, SkeletonRef skeleton, ShapeNode* node)
  : node_(std::move(world), std::move(skeleton), node)
{
}

std::string ShapeNodeHandle::name() const
{
  return node_->getName();
}

bool ShapeNodeHandle::has_shape() const
{
  return node_->getShape() != nullptr;
}

ShapeHandle ShapeNodeHandle::shape() const
{
  return ShapeHandle(node_);
}

bool ShapeNodeHandle::has_visual_aspect() const
{
  return node_->hasVisualAspect();
}

bool ShapeNodeHandle::has_collision_aspect() const
{
  return node_->hasCollisionAspect();
}

bool ShapeNodeHandle::has_dynamics_aspect() const
{
  return node_->hasDynamicsAspect();
}

Eigen::Vector4d ShapeNodeHandle::rgba() const
{
  if (!node_->hasVisualAspect())
    throw Error(Kind::value, "shape node '" + name() + "' has no visual aspect, so no colour");
  return node_->getVisualAspect()->getRGBA();
}

void ShapeNodeHandle::set_rgba(const Eigen::Vector4d& rgba)
{
  check::finite(VectorIn{rgba.data(), 4}, "rgba");
  if (!node_->hasVisualAspect())
    throw Error(Kind::value, "shape node '" + name() + "' has no visual aspect, so no colour");
  node_->getVisualAspect()->setRGBA(rgba);
}

bool ShapeNodeHandle::is_hidden() const
{
  return node_->hasVisualAspect() && node_->getVisualAspect()->isHidden();
}

Eigen::Vector3d ShapeNodeHandle::offset() const
{
  return node_->getOffset();
}

void ShapeNodeHandle::set_offset(const Eigen::Vector3d& offset)
{
  check::finite(offset, "offset");
  node_->setOffset(offset);
}

Eigen::Matrix4d ShapeNodeHandle::relative_transform() const
{
  return node_->getRelativeTransform().matrix();
}

void ShapeNodeHandle::set_relative_transform(const Eigen::Matrix4d& transform)
{
  check::rigid(transform, "relative transform");
  Eigen::Isometry3d isometry;
  isometry.matrix() = transform;
  node_->setRelativeTransform(isometry);
}

Eigen::Matrix4d ShapeNodeHandle::world_transform() const
{
  return node_->getWorldTransform().matrix();
}

DynamicsAspect& ShapeNodeHandle::dynamics() const
{
  if (!node_->hasDynamicsAspect())
    throw Error(Kind::value, "shape node '" + name() + "' takes no part in contacts, so it has no coefficients");
  return *node_->getDynamicsAspect();
}

DynamicsAspect& ShapeNodeHandle::dynamics()
{
  node_.get();
  return std::as_const(*this).dynamics();
}

void ShapeNodeHandle::set_friction_coeff(double coefficient)
{
  check::not_negative(coefficient, "friction coefficient");
  dynamics().setFrictionCoeff(coefficient);
}

double ShapeNodeHandle::restitution_coeff() const
{
  return dynamics().getRestitutionCoeff();
}

void ShapeNodeHandle::set_restitution_coeff(double coefficient)
{
  check::not_negative(coefficient, "restitution coefficient");
  dynamics().setRestitutionCoeff(coefficient);
}

Eigen::Vector4d ShapeNodeHandle::tangential_coeffs() const
{
  const auto& surface = dynamics();
  return {
      surface.getPrimaryFrictionCoeff(),
      surface.getSecondaryFrictionCoeff(),
      std::max(surface.getPrimarySlipCompliance(), 0.0), // -1 stands for the engine's default, 0
      std::max(surface.getSecondarySlipCompliance(), 0.0)};
}

void ShapeNodeHandle::set_tangential_coeffs(const Eigen::Vector4d& coefficients)
{
  const std::array<const char*, 4> names{"friction", "secondary_friction", "slip", "secondary_slip"};
  for (std::size_t i = 0; i < names.size(); ++i)
    check::not_negative(coefficients[static_cast<long>(i)], names[i]);
  auto& surface = dynamics();
  surface.setPrimaryFrictionCoeff(coefficients[0]);
  surface.setSecondaryFrictionCoeff(coefficients[1]);
  surface.setPrimarySlipCompliance(coefficients[2]);
  surface.setSecondarySlipCompliance(coefficients[3]);
}

Eigen::Vector3d ShapeNodeHandle::friction_direction() const
{
  return dynamics().getFirstFrictionDirection();
}

void ShapeNodeHandle::set_friction_direction(const Eigen::Vector3d& direction)
{
  check::finite(VectorIn{direction.data(), direction.size()}, "friction_direction");
  dynamics().setFirstFrictionDirection(direction);
}

} // namespace pydart2
