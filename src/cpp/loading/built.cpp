#include "loading/built.hpp"

#include <algorithm>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/EulerJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Marker.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ScrewJoint.hpp>
#include <dart/dynamics/SoftMeshShape.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/TranslationalJoint2D.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <iomanip>
#include <limits>
#include <sstream>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "base/messages.hpp"
#include "loading/built_shapes.hpp"

namespace pydart2::built {

using namespace dart::dynamics;

namespace {

using Axes = std::vector<Eigen::Vector3d>;

/// Where a joint goes, and what hangs from it: a new body, a new one with a skin, or one that there is.
struct Place
{
  Skeleton& skeleton;
  BodyNode* parent;
  const Skin* skin = nullptr;
  BodyNode* body = nullptr;
};

template <class Joint>
BodyNode& add(const Place& at, const typename Joint::Properties& properties)
{
  if (at.body != nullptr) {
    at.body->moveTo<Joint>(at.skeleton.getPtr(), at.parent, properties);
    return *at.body;
  }
  if (at.skin != nullptr)
    return *at.skeleton
                .createJointAndBodyNodePair<Joint, SoftBodyNode>(
                    at.parent, properties, SoftBodyNode::Properties(BodyNode::Properties(), *at.skin))
                .second;
  return *at.skeleton.createJointAndBodyNodePair<Joint>(at.parent, properties).second;
}

template <class Joint>
typename Joint::Properties named(const NewJoint& joint, std::size_t num_axes)
{
  if (joint.axes.size() != num_axes)
    throw Error(
        Kind::value,
        "a " + joint.type + " has " + std::to_string(num_axes) + " axes, got " + std::to_string(joint.axes.size()));
  typename Joint::Properties properties;
  properties.mName = joint.name;
  return properties;
}

template <class Joint>
BodyNode& add_plain(const Place& at, const NewJoint& joint)
{
  return add<Joint>(at, named<Joint>(joint, 0));
}

template <class Joint>
BodyNode& add_axis(const Place& at, const NewJoint& joint)
{
  auto properties = named<Joint>(joint, 1);
  properties.mAxis = joint.axes[0].normalized();
  return add<Joint>(at, properties);
}

BodyNode& add_universal(const Place& at, const NewJoint& joint)
{
  auto properties = named<UniversalJoint>(joint, 2);
  properties.mAxis = {joint.axes[0].normalized(), joint.axes[1].normalized()};
  return add<UniversalJoint>(at, properties);
}

template <class Joint>
BodyNode& add_plane(const Place& at, const NewJoint& joint)
{
  auto properties = named<Joint>(joint, 2);
  properties.setArbitraryPlane(joint.axes[0], joint.axes[1]);
  return add<Joint>(at, properties);
}

constexpr struct
{
  const char* type;
  BodyNode& (*add)(const Place&, const NewJoint&);
} kinds[] = {
    {"BallJoint", add_plain<BallJoint>},
    {"EulerJoint", add_plain<EulerJoint>},
    {"FreeJoint", add_plain<FreeJoint>},
    {"PlanarJoint", add_plane<PlanarJoint>},
    {"PrismaticJoint", add_axis<PrismaticJoint>},
    {"RevoluteJoint", add_axis<RevoluteJoint>},
    {"ScrewJoint", add_axis<ScrewJoint>},
    {"TranslationalJoint", add_plain<TranslationalJoint>},
    {"TranslationalJoint2D", add_plane<TranslationalJoint2D>},
    {"UniversalJoint", add_universal},
    {"WeldJoint", add_plain<WeldJoint>},
};

BodyNode& add_joint(const Place& at, const NewJoint& joint)
{
  for (const auto& kind : kinds)
    if (joint.type == kind.type)
      return kind.add(at, joint);
  throw Error(Kind::value, "no joint type '" + joint.type + "'");
}

/// The axes that make a joint of the type; their numbers come with visit_model(), but for planes.
Axes axes_of(const Joint& any)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  if (const auto* joint = dynamic_cast<const PlanarJoint*>(&any))
    return {joint->getTranslationalAxis1(), joint->getTranslationalAxis2()};
  if (const auto* joint = dynamic_cast<const TranslationalJoint2D*>(&any))
    return {joint->getTranslationalAxis1(), joint->getTranslationalAxis2()};
  if (dynamic_cast<const UniversalJoint*>(&any) != nullptr)
    return {x, y};
  const bool has_one = dynamic_cast<const RevoluteJoint*>(&any) != nullptr
                       || dynamic_cast<const PrismaticJoint*>(&any) != nullptr
                       || dynamic_cast<const ScrewJoint*>(&any) != nullptr;
  return has_one ? Axes{x} : Axes{};
}

void write_joint(std::ostream& out, const Joint& joint)
{
  out << std::quoted(joint.getType()) << ' ' << std::quoted(joint.getName()) << ' ';
  const auto axes = axes_of(joint);
  out << axes.size();
  for (const auto& axis : axes)
    out << ' ' << axis.x() << ' ' << axis.y() << ' ' << axis.z();
}

NewJoint read_joint(std::istream& in)
{
  NewJoint joint;
  std::size_t num_axes = 0;
  in >> std::quoted(joint.type) >> std::quoted(joint.name) >> num_axes;
  for (std::size_t i = 0; i < num_axes && in; ++i) {
    Eigen::Vector3d axis;
    in >> axis.x() >> axis.y() >> axis.z();
    joint.axes.push_back(axis);
  }
  return joint;
}

void write_body(std::ostream& out, const BodyNode& body)
{
  const auto* parent = body.getParentBodyNode();
  out << '\n' << std::quoted(body.getName()) << ' ' << (parent == nullptr ? -1 : long(parent->getIndexInSkeleton())) << ' ';
  write_joint(out, *body.getParentJoint());
  write_skin(out, body.asSoftBodyNode());
  if (body.asSoftBodyNode() != nullptr)
    out << ' ' << std::quoted(body.getShapeNode(0)->getName());
  auto shapes = body.getShapeNodes();
  const auto is_skin = [](const ShapeNode* node) { return node->getShape()->is<SoftMeshShape>(); };
  shapes.erase(std::remove_if(shapes.begin(), shapes.end(), is_skin), shapes.end()); // comes with the body
  out << ' ' << shapes.size();
  for (const auto* shape : shapes)
    write_shape(out, *shape);
}

void read_body(std::istream& in, Skeleton& skeleton)
{
  std::string name;
  long parent = -1;
  in >> std::quoted(name) >> parent;
  const auto joint = read_joint(in);
  const auto skin = read_skin(in);
  std::string skin_name;
  if (!skin.mPointProps.empty())
    in >> std::quoted(skin_name);
  std::size_t num_shapes = 0;
  in >> num_shapes;
  if (!in || parent >= static_cast<long>(skeleton.getNumBodyNodes()))
    return;
  auto* above = parent < 0 ? nullptr : skeleton.getBodyNode(static_cast<std::size_t>(parent));
  auto& body = add_body(skeleton, above, name, joint, skin.mPointProps.empty() ? nullptr : &skin);
  if (!skin_name.empty())
    body.getShapeNode(0)->setName(skin_name);
  for (std::size_t i = 0; i < num_shapes && in; ++i)
    read_shape(in, body);
}

} // namespace

std::string structure_of(const Skeleton& skeleton)
{
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << std::quoted(skeleton.getName()) << ' ' << skeleton.getNumBodyNodes() << ' ' << skeleton.getNumMarkers();
  for (const auto* body : skeleton.getBodyNodes())
    write_body(out, *body);
  for (std::size_t i = 0; i < skeleton.getNumMarkers(); ++i) {
    const auto& marker = *skeleton.getMarker(i);
    out << '\n' << std::quoted(marker.getName()) << ' ' << marker.getBodyNodePtr()->getIndexInSkeleton();
  }
  return out.str();
}

SkeletonPtr skeleton_of(const std::string& structure)
{
  std::istringstream in(structure);
  std::string name;
  std::size_t num_bodies = 0, num_markers = 0;
  in >> std::quoted(name) >> num_bodies >> num_markers;
  auto skeleton = Skeleton::create(name);
  for (std::size_t i = 0; i < num_bodies && in; ++i)
    read_body(in, *skeleton);
  for (std::size_t i = 0; i < num_markers && in; ++i) {
    std::size_t body = 0;
    in >> std::quoted(name) >> body;
    if (in && body < skeleton->getNumBodyNodes())
      skeleton->getBodyNode(body)->createMarker(name);
  }
  if (!in || skeleton->getNumBodyNodes() != num_bodies || skeleton->getNumMarkers() != num_markers)
    throw Error(Kind::load, "it is not the text of a built skeleton");
  return skeleton;
}

NewJoint new_joint(const std::string& type, const std::string& name, const MatrixIn& axes)
{
  check::shape(axes, static_cast<std::size_t>(axes.rows), 3, "axes");
  NewJoint joint{type, name, {}};
  for (long i = 0; i < axes.rows; ++i) {
    joint.axes.emplace_back(Eigen::Map<const Eigen::Vector3d>(axes.data + 3 * i));
    check::direction(joint.axes.back(), "axis");
  }
  if (joint.axes.size() == 2 && joint.axes[0].cross(joint.axes[1]).norm() < 1e-6)
    throw Error(Kind::value, "the two axes must not be parallel");
  return joint;
}

BodyNode& add_body(
    Skeleton& skeleton, BodyNode* parent, const std::string& name, const NewJoint& joint, const Skin* skin)
{
  auto& body = add_joint({skeleton, parent, skin}, joint);
  body.setName(name);
  if (skin != nullptr)
    body.getShapeNode(0)->setName(name + "_skin");
  const messages::Ignoring ignoring; // those about bodies without mass
  body.setInertia(Inertia(0.0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()));
  return body;
}

void about_to_move(BodyNode& body)
{
  body.dirtyTransform();
}

void hang(Skeleton& skeleton, BodyNode* parent, BodyNode& body, const NewJoint& joint)
{
  about_to_move(body);
  if (parent != nullptr && parent == body.getParentBodyNode()) {
    body.moveTo(skeleton.getPtr(), nullptr); // else it keeps its place among the children, but not among the bodies
    about_to_move(body);
  }
  add_joint({skeleton, parent, nullptr, &body}, joint);
}

} // namespace pydart2::built
