// What DART alone makes of a model file, with the parsers' own defaults: one JSON list, of each skeleton's dofs, q and M.
// Usage: engine_load KIND FILE [PACKAGE=FOLDER ...]; KIND is the root element. Ends with a signal where DART crashes.

#include <iostream>
#include <map>
#include <memory>

#include <dart/utils/CompositeResourceRetriever.hpp>
#include <dart/utils/PackageResourceRetriever.hpp>
#include <dart/utils/SkelParser.hpp>
#include <dart/utils/VskParser.hpp>
#include <dart/utils/mjcf/MjcfParser.hpp>
#include <dart/utils/sdf/SdfParser.hpp>
#include <dart/utils/urdf/DartLoader.hpp>

#include "json.hpp"

using dart::dynamics::SkeletonPtr;
using dart::simulation::WorldPtr;

namespace {

std::vector<SkeletonPtr> skeletons_of(const WorldPtr& world)
{
  std::vector<SkeletonPtr> skeletons;
  for (std::size_t i = 0; world && i < world->getNumSkeletons(); ++i)
    skeletons.push_back(world->getSkeleton(i));
  return skeletons;
}

std::vector<SkeletonPtr> load(
    const std::string& kind, const std::string& path, const std::map<std::string, std::string>& packages)
{
  using namespace dart::utils;
  const auto uri = dart::common::Uri::createFromPath(path);
  const auto local = std::make_shared<dart::common::LocalResourceRetriever>();
  const auto in_packages = std::make_shared<PackageResourceRetriever>(local);
  for (const auto& [name, folder] : packages)
    in_packages->addPackageDirectory(name, folder);
  const auto retriever = std::make_shared<CompositeResourceRetriever>();
  retriever->addSchemaRetriever("file", local);
  retriever->addSchemaRetriever("package", in_packages);
  if (kind == "robot")
    return {DartLoader(DartLoader::Options(retriever)).parseSkeleton(uri)};
  if (kind == "world")
    return skeletons_of(DartLoader(DartLoader::Options(retriever)).parseWorld(uri));
  if (kind == "KinematicModel")
    return {VskParser::readSkeleton(uri)};
  if (kind == "mujoco")
    return skeletons_of(MjcfParser::readWorld(uri));
  if (kind == "skel") {
    const auto world = SkelParser::readWorld(uri);
    return world ? skeletons_of(world) : std::vector{SkelParser::readSkeleton(uri)};
  }
  const auto world = SdfParser::readWorld(uri, SdfParser::Options(retriever));
  return world ? skeletons_of(world) : std::vector{SdfParser::readSkeleton(uri, SdfParser::Options(retriever))};
}

} // namespace

int main(int argc, char* argv[])
{
  std::map<std::string, std::string> packages;
  for (int i = 3; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto equals = argument.find('=');
    packages[argument.substr(0, equals)] = argument.substr(equals + 1);
  }
  std::vector<std::string> found;
  for (const auto& skeleton : load(argv[1], argv[2], packages)) {
    if (!skeleton)
      return 1;
    found.push_back(object(
        {{"dofs", number(static_cast<double>(skeleton->getNumDofs()))},
         {"q", array(skeleton->getPositions())},
         {"M", array(skeleton->getMassMatrix())}}));
  }
  if (found.empty())
    return 1;
  std::cout << "\n" << list(found) << std::endl;
  return 0;
}
