#include "state/model_shapes.hpp"

#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/MultiSphereConvexHullShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <typeinfo>

#include "base/checks.hpp"
#include "state/model_joints.hpp"

namespace pydart2 {

using namespace dart::dynamics;

namespace {

using Vector = const Eigen::VectorXd&;

double finite(double value)
{
  check::finite(value, "a number of a shape");
  return value;
}

Vector finite(Vector values)
{
  check::finite(VectorIn{values.data(), values.size()}, "numbers of a shape");
  return values;
}

double not_negative(double value)
{
  check::not_negative(value, "a coefficient of a shape");
  return value;
}

double length(double value)
{
  check::not_negative(value, "a length of a shape");
  return value;
}

Eigen::Vector3d lengths(Vector values)
{
  for (const double value : values)
    length(value);
  return values;
}

template <class Round>
void visit_radius(Archive& archive, Round& shape)
{
  archive.number([&] { return shape.getRadius(); }, [&](double radius) { shape.setRadius(length(radius)); });
}

template <class Tall>
void visit_height(Archive& archive, Tall& shape)
{
  archive.number([&] { return shape.getHeight(); }, [&](double height) { shape.setHeight(length(height)); });
}

template <class Long>
void visit_long(Archive& archive, Long& shape)
{
  visit_radius(archive, shape);
  visit_height(archive, shape);
}

void visit_pyramid(Archive& archive, PyramidShape& shape)
{
  visit_height(archive, shape);
  archive.number([&] { return shape.getBaseWidth(); }, [&](double width) { shape.setBaseWidth(length(width)); });
  archive.number([&] { return shape.getBaseDepth(); }, [&](double depth) { shape.setBaseDepth(length(depth)); });
}

void visit_plane(Archive& archive, PlaneShape& shape)
{
  archive.vector(
      [&] { return shape.getNormal(); },
      [&](Vector normal) {
        check::direction(normal, "the normal of a plane");
        shape.setNormal(before_normalizing(normal));
      });
  archive.number([&] { return shape.getOffset(); }, [&](double offset) { shape.setOffset(finite(offset)); });
}

void visit_spheres(Archive& archive, MultiSphereConvexHullShape& shape)
{
  auto spheres = shape.getSpheres();
  bool changed = false;
  const auto count = archive.count(spheres.size());
  if (archive.is_in() && count > archive.numbers.size())
    Archive::refuse();
  if (count != spheres.size()) {
    spheres.resize(count, {0.0, Eigen::Vector3d::Zero()});
    changed = true;
  }
  for (auto& [radius, position] : spheres) {
    archive.number([&, &r = radius] { return r; }, [&, &r = radius](double value) { r = length(value), changed = true; });
    archive.vector([&, &p = position] { return p; }, [&, &p = position](Vector value) { p = finite(value), changed = true; });
  }
  if (!changed)
    return;
  shape.removeAllSpheres();
  shape.addSpheres(spheres);
}

/// Null for a shape of another class.
template <class Kind>
Kind* as(Shape& shape)
{
  return typeid(shape) == typeid(Kind) ? static_cast<Kind*>(&shape) : nullptr;
}

void visit_geometry(Archive& archive, Shape& any)
{
  archive.same(any.getType());
  if (auto* box = as<BoxShape>(any))
    archive.vector([&] { return box->getSize(); }, [&](Vector size) { box->setSize(lengths(size)); });
  if (auto* ellipsoid = as<EllipsoidShape>(any))
    archive.vector(
        [&] { return ellipsoid->getDiameters(); }, [&](Vector d) { ellipsoid->setDiameters(lengths(d)); });
  if (auto* sphere = as<SphereShape>(any))
    visit_radius(archive, *sphere);
  if (auto* cylinder = as<CylinderShape>(any))
    visit_long(archive, *cylinder);
  if (auto* capsule = as<CapsuleShape>(any))
    visit_long(archive, *capsule);
  if (auto* cone = as<ConeShape>(any))
    visit_long(archive, *cone);
  if (auto* pyramid = as<PyramidShape>(any))
    visit_pyramid(archive, *pyramid);
  if (auto* plane = as<PlaneShape>(any))
    visit_plane(archive, *plane);
  if (auto* hull = as<MultiSphereConvexHullShape>(any))
    visit_spheres(archive, *hull);
}

void visit_slip(Archive& archive, DynamicsAspect& aspect)
{
  const bool any = aspect.getPrimarySlipCompliance() > 0.0 || aspect.getSecondarySlipCompliance() > 0.0
                   || !aspect.getFirstFrictionDirection().isZero(0.0);
  if (!archive.part("slip and direction of friction", any))
    return;
  archive.number(
      [&] { return aspect.getPrimarySlipCompliance(); }, [&](double value) { aspect.setPrimarySlipCompliance(finite(value)); });
  archive.number(
      [&] { return aspect.getSecondarySlipCompliance(); }, [&](double value) { aspect.setSecondarySlipCompliance(finite(value)); });
  archive.vector(
      [&] { return aspect.getFirstFrictionDirection(); },
      [&](Vector direction) { aspect.setFirstFrictionDirection(finite(direction)); });
}

void visit_contact(Archive& archive, DynamicsAspect& aspect)
{
  archive.number(
      [&] { return aspect.getPrimaryFrictionCoeff(); }, [&](double value) { aspect.setPrimaryFrictionCoeff(not_negative(value)); });
  archive.number(
      [&] { return aspect.getSecondaryFrictionCoeff(); }, [&](double value) { aspect.setSecondaryFrictionCoeff(not_negative(value)); });
  archive.number([&] { return aspect.getRestitutionCoeff(); }, [&](double value) { aspect.setRestitutionCoeff(not_negative(value)); });
  visit_slip(archive, aspect);
}

} // namespace

void visit_shape(Archive& archive, ShapeNode& node)
{
  archive.same(node.getName());
  archive.vector(
      [&] { return Eigen::Map<const Eigen::Matrix<double, 16, 1>>(node.getRelativeTransform().data()); },
      [&](Vector numbers) {
        Eigen::Isometry3d transform;
        transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
        check::rigid(transform.matrix(), "the place of a shape");
        node.setRelativeTransform(transform);
      });
  if (auto* look = node.getVisualAspect()) {
    archive.vector([&] { return look->getRGBA(); }, [&](Vector rgba) { look->setRGBA(Eigen::Vector4d(finite(rgba))); });
    archive.number([&] { return double(look->isHidden()); }, [&](double on) { look->setHidden(on != 0.0); });
  }
  if (auto* contact = node.getDynamicsAspect())
    visit_contact(archive, *contact);
  if (const auto shape = node.getShape())
    visit_geometry(archive, *shape);
}

} // namespace pydart2
