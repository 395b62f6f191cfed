#include "loading/loading.hpp"

#include <algorithm>
#include <cmath>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/VskParser.hpp>
#include <dart/utils/mjcf/MjcfParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>
#include <limits>
#include <utility>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "base/messages.hpp"
#include "engine/late_ode.hpp"
#include "engine/late_sizes.hpp"
#include "loading/built.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;
using dart::simulation::WorldPtr;

/// Runs one of DART's parsers; whatever it throws and its null both become a LoadError.
template <class Parse>
auto parse(Parse&& parser)
{
  const messages::Listening listening;
  decltype(parser()) result;
  std::string reason;
  try {
    result = parser();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (result)
    return result;
  const std::string problems = messages::problems();
  if (!problems.empty())
    reason = problems;
  throw Error(Kind::load, reason.empty() ? "the engine finds no valid model in it" : "the engine says: " + reason);
}

void check_body(const BodyNode& body)
{
  const auto refuse = [&](const std::string& what) {
    throw Error(Kind::load, "body '" + body.getName() + "': " + what);
  };
  const auto& inertia = body.getInertia();
  if (!std::isfinite(inertia.getMass()) || inertia.getMass() < 0.0)
    refuse("its mass must be zero or positive, got " + std::to_string(inertia.getMass()));
  if (!inertia.getSpatialTensor().allFinite())
    refuse("its inertia is not finite");
  const auto& joint = *body.getParentJoint();
  if (!joint.getTransformFromParentBodyNode().matrix().allFinite()
      || !joint.getTransformFromChildBodyNode().matrix().allFinite())
    refuse("the transform of its joint '" + joint.getName() + "' is not finite");
  const auto finite = [](const Eigen::VectorXd& values) { return (values.array().abs() <= check::huge).all(); };
  if (!finite(joint.getPositions()) || !finite(joint.getVelocities()))
    refuse("the position or velocity of its joint '" + joint.getName() + "' is not finite");
  for (const auto* node : body.getShapeNodes())
    if (!node->getRelativeTransform().matrix().allFinite())
      refuse("the transform of its shape '" + node->getName() + "' is not finite");
}

/// The parsers leave nodes without a shape where a mesh cannot be read, and have said so.
void remove_empty_shapes(BodyNode& body, bool lenient)
{
  for (auto* node : body.getShapeNodes()) { // a copy of the list
    if (node->getShape())
      continue;
    if (node->getCollisionAspect() != nullptr && !lenient)
      throw Error(
          Kind::load,
          "body '" + body.getName() + "': its collision shape '" + node->getName() + "' cannot be read; "
              + messages::problems());
    node->remove();
  }
}

void check_skeleton(Skeleton& skeleton, bool lenient)
{
  if (skeleton.getNumBodyNodes() == 0)
    throw Error(Kind::load, "skeleton '" + skeleton.getName() + "' has no bodies");
  for (auto* body : skeleton.getBodyNodes()) {
    remove_empty_shapes(*body, lenient);
    check_body(*body);
  }
}

/// What weighs nothing is meant so: the engine's warning about it is dropped.
void forget_zero_masses()
{
  auto said = messages::take();
  said.erase(
      std::remove_if(
          said.begin(),
          said.end(),
          [](const auto& message) { return message.text.find("negative or zero mass [0]") != std::string::npos; }),
      said.end());
  messages::give(std::move(said));
}

/// Not by createFromPath(), which takes '#' and '?' in a path for parts of a URI.
dart::common::Uri uri_of(const ModelSource& source)
{
  dart::common::Uri uri;
  uri.mScheme = "file";
  uri.mAuthority = "";
  uri.mPath = source.path();
  return uri;
}

dart::utils::DartLoader urdf_loader(const ModelSource& source)
{
  return dart::utils::DartLoader(dart::utils::DartLoader::Options(make_retriever(source)));
}

/// urdfdom reads no "inf", so that a number as large stands for it. Between two bounds the engine starts in the middle.
void read_infinite_limits(Skeleton& skeleton)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto lower = [](double limit) { return limit < -check::huge ? -infinity : limit; };
  const auto upper = [](double limit) { return limit > check::huge ? infinity : limit; };
  for (auto* dof : skeleton.getDofs()) {
    dof->setPositionLimits(lower(dof->getPositionLowerLimit()), upper(dof->getPositionUpperLimit()));
    dof->setVelocityLimits(lower(dof->getVelocityLowerLimit()), upper(dof->getVelocityUpperLimit()));
    dof->setForceLimits(lower(dof->getForceLowerLimit()), upper(dof->getForceUpperLimit()));
    if (std::abs(dof->getInitialPosition()) <= check::huge)
      continue;
    const double nearest = std::min(std::max(0.0, dof->getPositionLowerLimit()), dof->getPositionUpperLimit());
    dof->setInitialPosition(nearest);
    dof->setRestPosition(nearest);
    dof->setPosition(nearest);
  }
}

SkeletonPtr parse_urdf(const ModelSource& source)
{
  const auto skeleton = urdf_loader(source).parseSkeleton(uri_of(source));
  if (skeleton)
    read_infinite_limits(*skeleton);
  return skeleton;
}

/// Where the file places its robots they are after a reset, too.
WorldPtr parse_urdf_world(const ModelSource& source)
{
  const auto world = urdf_loader(source).parseWorld(uri_of(source));
  for (std::size_t i = 0; world && i < world->getNumSkeletons(); ++i) {
    read_infinite_limits(*world->getSkeleton(i));
    for (auto* dof : world->getSkeleton(i)->getDofs())
      dof->setInitialPosition(dof->getPosition());
  }
  return world;
}

WorldPtr parse_world(const ModelSource& source)
{
  using namespace dart::utils;
  const auto uri = uri_of(source);
  const auto retriever = make_retriever(source);
  if (source.kind() == "skel")
    return SkelParser::readWorld(uri, retriever);
  if (source.kind() == "sdf")
    return SdfParser::readWorld(uri, SdfParser::Options(retriever));
  if (source.kind() == "urdf_world")
    return parse_urdf_world(source);
  if (source.kind() == "mjcf")
    return MjcfParser::readWorld(uri, MjcfParser::Options(retriever));
  throw Error(Kind::value, "no worlds of kind '" + source.kind() + "'");
}

/// The one moving skeleton of an MJCF file; its ground and sites are skeletons of their own to DART.
SkeletonPtr parse_mjcf_skeleton(const ModelSource& source)
{
  const auto world = parse_world(source);
  SkeletonPtr found;
  for (std::size_t i = 0; world && i < world->getNumSkeletons(); ++i) {
    const auto skeleton = world->getSkeleton(i);
    if (!skeleton->isMobile())
      continue;
    if (found)
      throw Error(Kind::load, "it is a world of several skeletons; load it with World(step, file)");
    found = skeleton;
  }
  return found;
}

SkeletonPtr parse_skeleton(const ModelSource& source)
{
  using namespace dart::utils;
  const auto uri = uri_of(source);
  const auto retriever = make_retriever(source);
  if (source.kind() == "skel")
    return SkelParser::readSkeleton(uri, retriever);
  if (source.kind() == "sdf")
    return SdfParser::readSkeleton(uri, SdfParser::Options(retriever));
  if (source.kind() == "urdf")
    return parse_urdf(source);
  if (source.kind() == "vsk")
    return VskParser::readSkeleton(uri, VskParser::Options(retriever));
  if (source.kind() == "mjcf")
    return parse_mjcf_skeleton(source);
  throw Error(Kind::value, "no skeletons of kind '" + source.kind() + "'");
}

} // namespace

WorldPtr load_world(const ModelSource& source)
{
  const auto world = parse([&] {
    const LateSizes late;
    const LateOde late_ode;
    const auto read = parse_world(source);
    for (std::size_t i = 0; read && i < read->getNumSkeletons(); ++i)
      LateSizes::give(*read->getSkeleton(i));
    return read;
  });
  if (!world->getGravity().allFinite())
    throw Error(Kind::load, "its gravity is not finite");
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i)
    check_skeleton(*world->getSkeleton(i), source.lenient());
  forget_zero_masses();
  return world;
}

SkeletonPtr load_skeleton(const ModelSource& source)
{
  if (source.kind() == "built")
    return built::skeleton_of(source.texts().at(""));
  auto skeleton = parse([&] {
    const LateSizes late;
    const auto read = parse_skeleton(source);
    if (read)
      LateSizes::give(*read);
    return read;
  });
  check_skeleton(*skeleton, source.lenient());
  forget_zero_masses();
  return skeleton;
}

} // namespace pydart2
